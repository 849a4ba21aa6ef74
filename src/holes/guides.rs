//! Guides: pairs of boundary vertices that a patch shall have an edge between.

use super::connections::{CutPolygon, connections};
use super::groups::LoopGroup;
use super::links::Links;
use super::loop_set::LoopSet;
use super::loops::BoundaryLoop;
use super::triangulate::cross;
use crate::mesh::coincident::Copies;
use crate::support::error::Error;

/// The loops that are filled, which guides are looked up in.
pub(super) struct Guides<'m> {
    pub(super) copies: &'m Copies,
    pub(super) links: &'m Links<'m>,
    pub(super) positions: &'m [[f64; 3]],
    pub(super) loops: &'m [BoundaryLoop],
    pub(super) groups: &'m [LoopGroup],
}

/// Where a vertex is on the loops of a group.
#[derive(Debug, Clone, Copy)]
struct GuideEnd {
    group: usize,
    /// Which of the group's loops.
    of: usize,
    /// Its number among the vertices of all of these.
    at: u32,
}

/// A guide as it was given, and the places of its ends.
struct ResolvedGuide {
    given: [u32; 2],
    ends: [GuideEnd; 2],
}

impl Guides<'_> {
    /// Per group its guides, by the numbers of their ends among the vertices of the group's loops.
    pub(super) fn resolved(&self, guides: &[[u32; 2]]) -> Result<Vec<Vec<[u32; 2]>>, Error> {
        let mut by_group: Vec<Vec<ResolvedGuide>> = self.groups.iter().map(|_| Vec::new()).collect();
        for &given in guides {
            let found = self.resolve(given)?;
            by_group[found.ends[0].group].push(found);
        }
        for (group, of_group) in self.groups.iter().zip(&by_group) {
            if !of_group.is_empty() {
                self.check(group, of_group)?;
            }
        }
        let ends = |of_group: &Vec<ResolvedGuide>| of_group.iter().map(local).collect();
        Ok(by_group.iter().map(ends).collect())
    }

    fn resolve(&self, given: [u32; 2]) -> Result<ResolvedGuide, Error> {
        let refused = |why| Err(refusal(given, why));
        if given.iter().any(|&v| v as usize >= self.positions.len()) {
            return refused("it names a vertex that does not exist");
        }
        let [a, b] = given.map(|v| self.copies.smallest(v));
        if a == b {
            return refused("its ends are the same vertex");
        }
        let [of_a, of_b] = [a, b].map(|v| self.places(v));
        if of_a.is_empty() || of_b.is_empty() {
            let nowhere = if of_a.is_empty() { a } else { b };
            let is_on_loop = self.loops.iter().any(|of| of.vertices.contains(&nowhere));
            return refused(match is_on_loop {
                true => "an end of it is on a loop that is not to be filled",
                false => "an end of it is on no boundary loop",
            });
        }
        let pairs = || of_a.iter().flat_map(|&p| of_b.iter().map(move |&q| [p, q]));
        let same_loop = |[p, q]: &[GuideEnd; 2]| p.group == q.group && p.of == q.of;
        let same_group = |[p, q]: &[GuideEnd; 2]| p.group == q.group;
        match pairs().find(same_loop).or_else(|| pairs().find(same_group)) {
            Some(ends) => Ok(ResolvedGuide { given, ends }),
            None => refused("its ends are on loops that are not joined"),
        }
    }

    /// Where a vertex of the joined mesh is on the loops that get patches.
    fn places(&self, v: u32) -> Vec<GuideEnd> {
        let mut found = Vec::new();
        for (group, of_group) in self.groups.iter().enumerate() {
            let mut first = 0;
            for (of, &l) in of_group.loops.iter().enumerate() {
                let vertices = &self.loops[l].vertices;
                let place = |at: usize| GuideEnd {
                    group,
                    of,
                    at: (first + at) as u32,
                };
                found.extend(vertices.iter().position(|&w| w == v).map(place));
                first += vertices.len();
            }
        }
        found
    }

    /// Whether the guides of a group can be followed together.
    fn check(&self, group: &LoopGroup, guides: &[ResolvedGuide]) -> Result<(), Error> {
        let loops: Vec<&BoundaryLoop> = group.loops.iter().map(|&l| &self.loops[l]).collect();
        let mut set = LoopSet::new(self.links, self.positions, &loops);
        let mut used = Vec::new();
        for guide in guides {
            let [a, b] = local(guide);
            if set.after(a as usize) == b as usize || set.after(b as usize) == a as usize {
                return Err(refusal(guide.given, "its ends are neighbours on their loop"));
            }
            if set.taken.binary_search(&(a.min(b), a.max(b))).is_ok() {
                return Err(refusal(guide.given, "the mesh has an edge between its ends"));
            }
            if used.contains(&a) || used.contains(&b) {
                return Err(refusal(guide.given, "an end of it is that of another guide, too"));
            }
            used.extend([a, b]);
        }
        set.guides = guides.iter().map(local).collect();
        let found = connections(&set);
        if found.len() + 1 < set.count() {
            // Nothing can be triangulated, whatever the guides are: the report will say so.
            return Ok(());
        }
        let cut = CutPolygon::new(&set, &found);
        let is_chord = |guide: &&ResolvedGuide| {
            let [a, b] = local(guide);
            !found.iter().any(|c| [c.from, c.to] == [a, b])
        };
        let chords: Vec<(&ResolvedGuide, (u32, u32))> = guides
            .iter()
            .filter(is_chord)
            .zip(cut.guides.iter().copied())
            .collect();
        for (i, (first, chord)) in chords.iter().enumerate() {
            if let Some((second, _)) = chords[..i].iter().find(|(_, other)| cross(*chord, *other)) {
                let ends = |of: &ResolvedGuide| of.given.map(|v| v as usize);
                return Err(Error::GuidesCross {
                    first: ends(second),
                    second: ends(first),
                });
            }
        }
        Ok(())
    }
}

fn local(guide: &ResolvedGuide) -> [u32; 2] {
    guide.ends.map(|place| place.at)
}

fn refusal([a, b]: [u32; 2], why: &'static str) -> Error {
    let [a, b] = [a as usize, b as usize];
    Error::BadGuide { a, b, why }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::holes::joint::triangulate;
    use crate::holes::triangulate::Measure;

    /// A gap in a plane between a circle of `n` vertices and, if asked for, a smaller one of `n` in it.
    fn gap(n: usize, has_island: bool, guides: Vec<[u32; 2]>) -> LoopSet {
        let circle = |radius: f64, turn: f64| {
            (0..n).map(move |i| {
                let (sin, cos) = (turn * std::f64::consts::TAU * i as f64 / n as f64).sin_cos();
                radius * Vector3::new(cos, sin, 0.0)
            })
        };
        let mut x: Vec<Vector3<f64>> = circle(2.0, 1.0).collect();
        let mut starts = vec![0, n];
        if has_island {
            x.extend(circle(1.0, -1.0));
            starts.push(2 * n);
        }
        LoopSet {
            normals: vec![Vector3::z(); x.len()],
            x,
            starts,
            taken: Vec::new(),
            guides,
        }
    }

    fn has_edge(triangles: &[[u32; 3]], [a, b]: [u32; 2]) -> bool {
        triangles.iter().any(|t| t.contains(&a) && t.contains(&b))
    }

    #[test]
    fn every_guide_is_an_edge_of_the_triangulation() {
        for n in [12, 60, 130, 300] {
            let m = n as u32;
            let across = vec![[1, m / 2], [m - 2, m / 2 + 3]];
            for measure in [Measure::WorstBend, Measure::Area] {
                let triangles = triangulate(&gap(n, false, across.clone()), measure, None).unwrap();
                assert_eq!(triangles.len(), n - 2);
                assert!(across.iter().all(|guide| has_edge(&triangles, *guide)), "{n}");
            }
            // From circle to circle, askew, and one on the outer circle that cuts a corner off.
            let between = vec![[0, m + 2], [m / 2, m + m / 2 + 1], [m / 4 - 1, m / 4 + 1]];
            for measure in [Measure::TotalBend, Measure::Energy] {
                let triangles = triangulate(&gap(n, true, between.clone()), measure, None).unwrap();
                assert_eq!(triangles.len(), 2 * n);
                assert!(
                    between.iter().all(|guide| has_edge(&triangles, *guide)),
                    "{n} {measure:?}"
                );
            }
        }
    }
}
