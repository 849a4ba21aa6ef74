//! What spoils a mesh on purpose: bumps that are raised, and triangles that are cut out.

use super::shape::Shape;

impl Shape {
    /// Raises `positions`, as many as the shape has vertices, along the exact normals by a smooth bump: `height` at the place,
    /// nothing from `radius` away from it on. A negative height makes a dent. Vertices without an exact normal stay.
    pub fn raise(&self, positions: &mut [[f64; 3]], place: [f64; 3], radius: f64, height: f64) {
        for (p, (at, normal)) in positions.iter_mut().zip(self.positions.iter().zip(&self.normals)) {
            // Three times differentiable at its end, so that no edge shows there.
            let part = (1.0 - squared_distance(at, &place) / (radius * radius)).max(0.0);
            let step = height * part.powi(4);
            (0..3).for_each(|k| p[k] += step * normal[k]);
        }
    }

    /// The shape without the triangles that lie in a ball with all corners, and without the vertices that no triangle has any more.
    pub fn cut(&self, centre: [f64; 3], radius: f64) -> Shape {
        let is_inside = |&v: &u32| squared_distance(&self.positions[v as usize], &centre) <= radius * radius;
        let rest = self.triangles.iter().filter(|t| !t.iter().all(is_inside));
        let rest: Vec<[u32; 3]> = rest.copied().collect();
        let mut is_used = vec![false; self.positions.len()];
        rest.iter().flatten().for_each(|&v| is_used[v as usize] = true);
        let mut new = vec![0; is_used.len()];
        let mut shape = Shape {
            surface: self.surface.clone(),
            ..Shape::empty()
        };
        for v in (0..is_used.len()).filter(|&v| is_used[v]) {
            new[v] = shape.positions.len() as u32;
            shape.positions.push(self.positions[v]);
            shape.normals.push(self.normals[v]);
            shape.free.push(self.free[v]);
            shape.flattened.push(self.flattened[v]);
        }
        shape.triangles = rest.iter().map(|t| t.map(|v| new[v as usize])).collect();
        shape
    }
}

fn squared_distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum()
}

#[cfg(test)]
mod tests {
    use crate::{Sampling, sphere_cap, sphere_with_hole};

    fn radius(p: &[f64; 3]) -> f64 {
        p.iter().map(|c| c * c).sum::<f64>().sqrt()
    }

    #[test]
    fn a_bump_is_as_high_as_asked_at_its_place_and_ends() {
        let shape = sphere_with_hole(30.0, 4_000, Sampling::Regular, 4);
        let mut raised = shape.positions.clone();
        shape.raise(&mut raised, [0.0, 0.0, 1.0], 0.4, 0.1);
        let highest = raised.iter().map(radius).fold(0.0, f64::max);
        assert!((highest - 1.1).abs() < 2e-3, "{highest}");
        for (p, q) in raised.iter().zip(&shape.positions) {
            let away = (q[0].powi(2) + q[1].powi(2) + (q[2] - 1.0).powi(2)).sqrt();
            assert_eq!(p == q, away >= 0.4);
        }
    }

    #[test]
    fn what_is_cut_leaves_no_vertex_alone() {
        let shape = sphere_cap(60.0, 1_000, Sampling::Regular, 4);
        let cut = shape.cut([0.0, 0.0, 1.0], 0.3);
        assert_below!(cut.triangles.len(), shape.triangles.len());
        assert_eq!(cut.free.len(), cut.positions.len());
        let mut used = vec![false; cut.positions.len()];
        cut.triangles
            .iter()
            .flatten()
            .for_each(|&v| used[v as usize] = true);
        assert_all!(used.iter(), |&used| used);
        // Nothing else is gone: of a triangle in the ball all corners are.
        let far = |p: &&[f64; 3]| p[2] < 0.9;
        assert_eq!(
            cut.positions.iter().filter(far).count(),
            shape.positions.iter().filter(far).count()
        );
    }
}
