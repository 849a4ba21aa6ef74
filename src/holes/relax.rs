//! Sweeps over a whole patch: vertices to the centres of their neighbours, sizes to the means of theirs.
//!
//! Sums run over the triangles in their order, and all vertices move at once. Around an inner vertex every neighbour is
//! once the next corner of a triangle, so that it counts once.

use fairmesh_linear::interrupt::is_stopped;
use nalgebra::Vector3;

use super::lenses::Lenses;
use super::patch::{GRADE, Patch};
use crate::mesh::NONE;
use crate::mesh::rows::Rows;

/// Vertices whose triangles would turn over are held back in at most so many rounds; if that is not enough, nothing moves.
/// Half or double, of 44 cases: none changes.
const HOLDS: usize = 20;

/// Scratch of the sweeps.
#[derive(Default)]
pub(super) struct Sweeps {
    /// Per vertex: sum of its neighbours and their number.
    centre: Vec<(Vector3<f64>, f64)>,
    /// Per vertex: sum of its triangles' cross products.
    normal: Vec<Vector3<f64>>,
    /// Per triangle: its cross product before the step.
    cross: Vec<Vector3<f64>>,
    /// Per vertex where it goes.
    target: Vec<Vector3<f64>>,
}

impl Sweeps {
    /// One tangential step of every inner vertex to the centre of its neighbours. A vertex stays if one of its triangles
    /// would turn by more than 60 degrees.
    /// Into a lens it goes not at all.
    pub(super) fn relax(&mut self, patch: &mut Patch, lenses: &Lenses) {
        self.gather(patch);
        self.target.clone_from(&patch.x);
        for v in patch.fixed..patch.x.len() {
            let (centre, count) = self.centre[v];
            if let Some(normal) = self.normal[v].try_normalize(0.0)
                && count > 0.0
            {
                let step = centre / count - patch.x[v];
                let target = patch.x[v] + (step - normal * normal.dot(&step));
                if !lenses.are_entered(&patch.x[v], &target) {
                    self.target[v] = target;
                }
            }
        }
        for _ in 0..HOLDS {
            if !self.hold(patch) {
                std::mem::swap(&mut patch.x, &mut self.target);
                return;
            }
        }
    }

    fn gather(&mut self, patch: &Patch) {
        let count = patch.x.len();
        self.centre.clear();
        self.centre.resize(count, (Vector3::zeros(), 0.0));
        self.normal.clear();
        self.normal.resize(count, Vector3::zeros());
        self.cross.clear();
        for t in &patch.triangles {
            if t[0] == NONE {
                self.cross.push(Vector3::zeros());
                continue;
            }
            let x = t.map(|v| patch.x[v as usize]);
            let cross = (x[1] - x[0]).cross(&(x[2] - x[0]));
            self.cross.push(cross);
            for k in 0..3 {
                let v = t[k] as usize;
                self.centre[v].0 += x[(k + 1) % 3];
                self.centre[v].1 += 1.0;
                self.normal[v] += cross;
            }
        }
    }

    /// Holds back the corners of triangles that would turn over; whether there was one.
    fn hold(&mut self, patch: &Patch) -> bool {
        let mut held = false;
        for (t, old) in patch.triangles.iter().zip(&self.cross) {
            if t[0] == NONE {
                continue;
            }
            let x = t.map(|v| self.target[v as usize]);
            let new = (x[1] - x[0]).cross(&(x[2] - x[0]));
            if turns_over(old, &new) {
                for &v in t {
                    let v = v as usize;
                    held |= self.target[v] != patch.x[v];
                    self.target[v] = patch.x[v];
                }
            }
        }
        held
    }

    /// The places on the source surface follow the vertices: each becomes the mean of its neighbours'.
    pub(super) fn settle_sources(&mut self, patch: &mut Patch) {
        self.centre.clear();
        self.centre.resize(patch.x.len(), (Vector3::zeros(), 0.0));
        for t in patch.triangles.iter().filter(|t| t[0] != NONE) {
            for k in 0..3 {
                let (v, w) = (t[k] as usize, t[(k + 1) % 3] as usize);
                self.centre[v].0 += patch.source[w];
                self.centre[v].1 += 1.0;
            }
        }
        for v in patch.fixed..patch.x.len() {
            let (centre, count) = self.centre[v];
            if count > 0.0 {
                patch.source[v] = centre / count;
            }
        }
    }
}

/// Sizes of inner vertices become more harmonic in every sweep; limits and depths are made anew from the neighbours'.
pub(super) fn settle_sizes(patch: &mut Patch, sweeps: usize) {
    let x = &patch.x;
    let edges = patch.triangles.iter().filter(|t| t[0] != NONE).flat_map(|&t| {
        let along = move |k: usize| (t[k], t[(k + 1) % 3]);
        (0..3).map(along).filter(|(v, _)| *v as usize >= patch.fixed)
    });
    let neighbours = Rows::collect(
        x.len(),
        edges.map(|(v, w)| (v, (w, (x[w as usize] - x[v as usize]).norm()))),
    );
    let at = |v: usize| [patch.size[v], patch.limit[v], patch.depth[v]];
    let mut settled: Vec<_> = (0..x.len()).map(at).collect();
    let mut next = settled.clone();
    for _ in (0..sweeps).take_while(|_| !is_stopped()) {
        for v in (patch.fixed..x.len()).filter(|&v| !neighbours.row(v).is_empty()) {
            let mut of = [0.0, f64::INFINITY, f64::INFINITY];
            for &(w, length) in neighbours.row(v) {
                let [size, limit, depth] = settled[w as usize];
                of = [
                    of[0] + size,
                    of[1].min(limit + GRADE * length),
                    of[2].min(depth + length),
                ];
            }
            next[v] = [
                of[0] / neighbours.row(v).len() as f64,
                of[1].min(patch.own[v]),
                of[2],
            ];
        }
        std::mem::swap(&mut settled, &mut next);
    }
    for (v, of) in settled.into_iter().enumerate().skip(patch.fixed) {
        [patch.size[v], patch.limit[v], patch.depth[v]] = of;
    }
}

/// Whether a triangle turns by more than 60 degrees; cross products before and after.
pub(super) fn turns_over(old: &Vector3<f64>, new: &Vector3<f64>) -> bool {
    let dot = old.dot(new);
    dot <= 0.0 || dot * dot < 0.25 * old.norm_squared() * new.norm_squared()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of 5 by 5 vertices, its boundary first; inner ones at `place`.
    fn square(place: impl Fn(f64, f64) -> Vector3<f64>) -> Patch {
        let is_boundary = |i: usize, j: usize| i == 0 || j == 0 || i == 4 || j == 4;
        let all: Vec<(usize, usize)> = (0..25).map(|v| (v % 5, v / 5)).collect();
        let mut order: Vec<_> = all.iter().copied().filter(|&(i, j)| is_boundary(i, j)).collect();
        order.extend(all.iter().copied().filter(|&(i, j)| !is_boundary(i, j)));
        let number = |i, j| order.iter().position(|&o| o == (i, j)).unwrap() as u32;
        let x = order.iter().map(|&(i, j)| {
            let (a, b) = (i as f64, j as f64);
            if is_boundary(i, j) {
                Vector3::new(a, b, 0.0)
            } else {
                place(a, b)
            }
        });
        let mut triangles = Vec::new();
        for (i, j) in all.iter().copied().filter(|&(i, j)| i < 4 && j < 4) {
            let [a, b, c, d] = [
                number(i, j),
                number(i + 1, j),
                number(i + 1, j + 1),
                number(i, j + 1),
            ];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
        Patch::new(x.collect(), triangles, 16)
    }

    fn relax(patch: &mut Patch) {
        Sweeps::default().relax(patch, &Lenses::new(patch));
    }

    #[test]
    fn a_regular_square_stays_and_a_disturbed_one_comes_back() {
        let regular = square(|a, b| Vector3::new(a, b, 0.0));
        let mut patch = regular.clone();
        relax(&mut patch);
        assert_all!(patch.x.iter().zip(&regular.x), |(p, q)| (p - q).norm() < 1e-15);
        let mut patch = square(|a, b| Vector3::new(a + 0.2 * (3.0 * b).sin(), b + 0.2 * a.cos(), 0.0));
        (0..60).for_each(|_| relax(&mut patch));
        assert_all!(patch.x.iter().zip(&regular.x), |(p, q)| (p - q).norm() < 1e-6);
    }

    #[test]
    fn no_triangle_turns_over() {
        // The inner vertices are crowded in a corner.
        let mut patch = square(|a, b| Vector3::new(3.2 + 0.2 * a, 3.2 + 0.2 * b, 0.0));
        for _ in 0..20 {
            let before: Vec<f64> = (0..patch.triangles.len()).map(|t| patch.cross(t).z).collect();
            relax(&mut patch);
            let turned = (0..patch.triangles.len()).filter(|&t| before[t] > 0.0 && patch.cross(t).z <= 0.0);
            assert_eq!(turned.count(), 0);
        }
    }

    #[test]
    fn sizes_become_the_mean_of_the_neighbours_and_depths_the_distance_to_the_boundary() {
        let mut patch = square(|a, b| Vector3::new(a, b, 0.0));
        for v in 0..25 {
            patch.size[v] = patch.x[v].x + 2.0 * patch.x[v].y;
        }
        let sizes = patch.size.clone();
        settle_sizes(&mut patch, 3);
        // A linear function is harmonic here.
        assert_all!(patch.size.iter().zip(&sizes), |(a, b)| (a - b).abs() < 1e-12);
        assert_near!(patch.depth[24], 1.0, 1e-12);
    }
}
