//! A polygon cut at its guides: the pieces between them are triangulated one after the other, in time proportional to their number.

use nalgebra::Vector3;

use super::triangulate::Polygon;
use crate::mesh::NONE;

impl Polygon<'_> {
    /// The triangles of the pieces between the guides, or `None` if there are none for one of them.
    pub(super) fn triangulate_pieces(&self) -> Option<Vec<[u32; 3]>> {
        let mut triangles = Vec::with_capacity(self.x.len().saturating_sub(2));
        let mut place = vec![NONE; self.x.len()];
        for (vertices, normals) in self.pieces() {
            (0..).zip(&vertices).for_each(|(i, &v)| place[v as usize] = i);
            let made = self.piece(&vertices, &normals, &place)?;
            triangles.extend(made.into_iter().map(|t| t.map(|i| vertices[i as usize])));
            vertices.iter().for_each(|&v| place[v as usize] = NONE);
        }
        Some(triangles)
    }

    /// The triangles of one piece, in its own numbers; `place` has those of its vertices.
    fn piece(&self, vertices: &[u32], normals: &[Vector3<f64>], place: &[u32]) -> Option<Vec<[u32; 3]>> {
        let x: Vec<Vector3<f64>> = vertices.iter().map(|&v| self.x[v as usize]).collect();
        let inside = |&(a, b): &(u32, u32)| {
            let [a, b] = [a, b].map(|v| place[v as usize]);
            (a != NONE && b != NONE).then_some((a.min(b), a.max(b)))
        };
        let mut taken: Vec<(u32, u32)> = self.taken.iter().filter_map(inside).collect();
        taken.sort_unstable();
        let barred = |t: [u32; 3]| {
            self.barred
                .is_some_and(|barred| barred(t.map(|i| vertices[i as usize])))
        };
        let piece = Polygon {
            x: &x,
            normals,
            taken: &taken,
            guides: &[],
            measure: self.measure,
            barred: self.barred.is_some().then_some(&barred),
        };
        piece.triangulate()
    }

    /// The vertices of each piece, and the normals beyond its edges: none beyond a guide.
    fn pieces(&self) -> Vec<(Vec<u32>, Vec<Vector3<f64>>)> {
        let mut guides: Vec<(u32, u32)> = self.guides.to_vec();
        guides.retain(|guide| self.taken.binary_search(guide).is_err());
        // What a guide encloses is cut off before it.
        guides.sort_unstable_by_key(|(a, b)| (b - a, *a));
        let mut normals = self.normals.to_vec();
        let mut next: Vec<u32> = (1..=self.x.len() as u32).collect();
        let mut pieces = Vec::with_capacity(guides.len() + 1);
        for (first, last) in guides.into_iter().chain([(0, self.x.len() as u32 - 1)]) {
            let mut vertices = vec![first];
            while vertices[vertices.len() - 1] < last {
                vertices.push(next[vertices[vertices.len() - 1] as usize]);
            }
            let mut beyond: Vec<Vector3<f64>> = vertices.iter().map(|&v| normals[v as usize]).collect();
            if (first, last) != (0, self.x.len() as u32 - 1) {
                beyond[vertices.len() - 1] = Vector3::zeros();
            }
            normals[first as usize] = Vector3::zeros();
            next[first as usize] = last;
            pieces.push((vertices, beyond));
        }
        pieces
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::holes::triangulate::Measure;

    #[test]
    fn a_ladder_of_a_hundred_thousand_rungs_is_triangulated_at_once() {
        let count = 100_000;
        let side = |y: f64, k: u32| Vector3::new(f64::from(k), y, 0.0);
        let x: Vec<_> = (0..count)
            .map(|k| side(0.0, k))
            .chain((0..count).rev().map(|k| side(1.0, k)))
            .collect();
        let guides: Vec<(u32, u32)> = (1..count - 1)
            .step_by(3)
            .map(|k| (k, 2 * count - 1 - k))
            .collect();
        let polygon = Polygon {
            x: &x,
            normals: &vec![Vector3::zeros(); x.len()],
            taken: &[],
            guides: &guides,
            measure: Measure::WorstBend,
            barred: None,
        };
        let triangles = polygon.triangulate().unwrap();
        assert_eq!(triangles.len(), x.len() - 2);
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| x[v as usize]);
            0.5 * (b - a).cross(&(c - a)).z
        };
        assert_all!(triangles.iter(), |t| area(t) > 0.0);
        let sum: f64 = triangles.iter().map(area).sum();
        assert_near!(sum, f64::from(count - 1), 1e-6);
    }
}
