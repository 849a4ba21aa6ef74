//! Loops with fewer vertices, where they are far from each other.
//!
//! Between the ends of tubes that are further apart than their edges are long, a triangulation has slender triangles, whose
//! bends are those of the loops' small irregularities rather than its own. So the loops are thinned out there for the
//! triangulation, and the vertices left out are put back into the triangles beside them.

use nalgebra::Vector3;

use crate::holes::loop_set::LoopSet;

/// No loop has fewer vertices because of this.
const LEAST: f64 = 16.0;
/// Vertices are kept at distances of no more than this part of the distance to the next loop.
const NARROW: f64 = 0.3;

/// Loops with some of their vertices.
pub(super) struct Thinned {
    /// The loops as they are triangulated.
    pub(super) set: LoopSet,
    /// Per vertex of these its number in the whole loops; ascending.
    kept: Vec<u32>,
}

impl Thinned {
    pub(super) fn new(whole: &LoopSet) -> Self {
        let (mut kept, mut starts) = (Vec::new(), vec![0]);
        // With their neighbours, so that no guide becomes an edge of its loop.
        let is_guided = |v: usize| {
            let near = [whole.before(v), v, whole.after(v)].map(|v| v as u32);
            whole.guides.iter().flatten().any(|v| near.contains(v))
        };
        for of in 0..whole.count() {
            let range = whole.range(of);
            let edge = |v: usize| (whole.x[whole.after(v)] - whole.x[v]).norm();
            let length: f64 = range.clone().map(edge).sum();
            let mut left = 0.0;
            for v in range {
                if left <= 0.0 || is_guided(v) {
                    kept.push(v as u32);
                    left = (length / LEAST).min(NARROW * nearest(whole, of, v));
                }
                left -= edge(v);
            }
            starts.push(kept.len());
        }
        let mut thinned = Self {
            set: LoopSet {
                x: kept.iter().map(|&v| whole.x[v as usize]).collect(),
                normals: Vec::new(),
                starts,
                taken: Vec::new(),
                guides: Vec::new(),
            },
            kept,
        };
        thinned.set.normals = (0..thinned.kept.len())
            .map(|v| {
                let run = thinned.run(whole, v);
                let sum: Vector3<f64> = run.iter().map(|&w| whole.normals[w as usize]).sum();
                sum.try_normalize(0.0).unwrap_or_else(Vector3::zeros)
            })
            .collect();
        let place = |v: u32| thinned.kept.binary_search(&v).ok().map(|at| at as u32);
        let taken = whole.taken.iter();
        thinned.set.taken = taken.filter_map(|&(a, b)| Some((place(a)?, place(b)?))).collect();
        let guides = whole.guides.iter();
        thinned.set.guides = guides
            .filter_map(|&[a, b]| Some([place(a)?, place(b)?]))
            .collect();
        thinned
    }

    /// A kept vertex and those left out between it and the next one, by their numbers in the whole loops.
    fn run(&self, whole: &LoopSet, v: usize) -> Vec<u32> {
        let (first, last) = (self.kept[v], self.kept[self.set.after(v)]);
        let mut run = vec![first];
        let mut at = whole.after(first as usize) as u32;
        while at != last {
            run.push(at);
            at = whole.after(at as usize) as u32;
        }
        run
    }

    /// The triangulation of the whole loops: a triangle at an edge between two kept vertices becomes a fan.
    pub(super) fn whole(&self, whole: &LoopSet, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
        let mut all = Vec::with_capacity(triangles.len() + whole.x.len() - self.kept.len());
        for t in triangles {
            let mut open = vec![t.map(|v| self.kept[v as usize])];
            for k in 0..3 {
                let (a, b) = (t[k] as usize, t[(k + 1) % 3] as usize);
                if self.set.after(a) != b {
                    continue;
                }
                let run = self.run(whole, a);
                let (first, last) = (run[0], self.kept[b]);
                let at = open
                    .iter()
                    .position(|t| (0..3).any(|k| t[k] == first && t[(k + 1) % 3] == last));
                let Some(at) = at else { continue };
                let old = open.swap_remove(at);
                let apex = old
                    .into_iter()
                    .find(|&v| v != first && v != last)
                    .unwrap_or(old[2]);
                let ends = run.iter().skip(1).copied().chain([last]);
                open.extend(run.iter().copied().zip(ends).map(|(p, q)| [p, q, apex]));
            }
            all.extend(open);
        }
        all
    }
}

/// The distance of a vertex to the nearest one of the other loops.
fn nearest(set: &LoopSet, of: usize, v: usize) -> f64 {
    let range = set.range(of);
    let others = (0..set.x.len()).filter(|w| !range.contains(w));
    others
        .map(|w| (set.x[w] - set.x[v]).norm())
        .fold(f64::INFINITY, f64::min)
}
