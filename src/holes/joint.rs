//! One triangulation for several loops: their polygon's, closed along the connections.

use nalgebra::Vector3;

use super::connections::{Connection, CutPolygon, connections};
use super::loop_set::LoopSet;
use super::patch::Patch;
use super::triangulate::{Barred, Measure, Polygon};
use crate::holes::coarse_loops::Thinned;
use crate::mesh::NONE;
use crate::mesh::halfedge::{next, previous};

/// Passes over all edges in which those are flipped that count less afterwards.
/// Half or double, of 13 cases: none changes.
const PASSES: usize = 20;
/// A flip has to gain so much of what there is.
/// Half or double, of 13 cases: none changes.
const GAIN: f64 = 1e-9;
/// What bends inside count beside those at the loops, which no fairing takes away.
/// Half or double, of 14 cases: none changes.
const INSIDE: f64 = 0.5;
/// A loop fits only with the mesh there turned around if that leaves no more than this part of the energy; of two such loops each.
/// Of 10 cases, half: 1 changes, +3 % iterations; double: 1 changes.
const OPPOSED: f64 = 0.7;
/// With less energy all of them fit: half a sphere has four times as much.
/// Half or double, of 11 cases: none changes.
const FITS: f64 = 6.0;

/// A triangulation of the surface that has all these loops for its boundary, or None if each one would have an edge twice or
/// an edge that the mesh has already. Of one loop it is that of its polygon.
pub(super) fn triangulate(set: &LoopSet, measure: Measure, barred: Barred<'_>) -> Option<Vec<[u32; 3]>> {
    if set.count() == 1 {
        let guides: Vec<(u32, u32)> = set.guides.iter().map(|&[a, b]| (a.min(b), a.max(b))).collect();
        let polygon = Polygon {
            x: &set.x,
            normals: &set.normals,
            taken: &set.taken,
            guides: &guides,
            measure,
            barred,
        };
        return polygon.triangulate();
    }
    if measure != Measure::Energy {
        return closed(set, measure, barred);
    }
    let thinned = Thinned::new(set);
    let triangles = closed(&thinned.set, measure, None)?;
    let whole = thinned.whole(set, &triangles);
    let mut patch = Closed::new(set, measure, Patch::new(set.x.clone(), whole, set.x.len()));
    if !patch.is_sound() {
        return closed(set, measure, barred);
    }
    patch.flatten();
    Some(patch.patch.triangles)
}

/// The same for several loops as they are.
fn closed(set: &LoopSet, measure: Measure, barred: Barred<'_>) -> Option<Vec<[u32; 3]>> {
    let connections = connections(set);
    if connections.len() + 1 < set.count() {
        return None;
    }
    let cut = CutPolygon::new(set, &connections);
    let x: Vec<Vector3<f64>> = cut.of.iter().map(|&v| set.x[v as usize]).collect();
    let in_cut = |t: [u32; 3]| barred.is_some_and(|barred| barred(t.map(|v| cut.of[v as usize])));
    let polygon = Polygon {
        x: &x,
        normals: &cut.normals,
        taken: &cut.taken,
        guides: &cut.guides,
        measure,
        barred: barred.is_some().then_some(&in_cut),
    };
    let triangles = polygon.triangulate()?;
    let count = x.len();
    let mut patch = Patch::new(x, triangles, count);
    patch.glue(&cut.sides, &cut.of, &set.x);
    let mut closed = Closed::new(set, measure, patch);
    closed.part_doubles()?;
    closed.flatten();
    Some(closed.patch.triangles)
}

/// How a triangulation lies between its loops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bends {
    /// Sum over all edges of length times angle; edges inside count half.
    pub(super) total: f64,
    /// The triangles' area.
    pub(super) area: f64,
    /// The discrete bending energy.
    energy: f64,
}

/// The bends of a triangulation.
pub(super) fn bends(set: &LoopSet, triangles: Vec<[u32; 3]>) -> Bends {
    let patch = Patch::new(set.x.clone(), triangles, set.x.len());
    let (mut inside, mut at_loops, mut energy) = (0.0, 0.0, 0.0);
    for h in 0..patch.half_edges() {
        let o = patch.across(h);
        if o != NONE && o < h {
            continue;
        }
        let cross = patch.cross(h as usize / 3);
        let beyond = match o {
            NONE => set.normals[patch.origin(h) as usize],
            o => patch.cross(o as usize / 3),
        };
        let angle = libm::atan2(cross.cross(&beyond).norm(), cross.dot(&beyond));
        let bend = patch.length(h) * angle;
        let theirs = if o == NONE { cross.norm() } else { beyond.norm() };
        let areas = 0.5 * (cross.norm() + theirs);
        energy += bend * bend / areas.max(f64::MIN_POSITIVE);
        if o == NONE {
            at_loops += bend;
        } else {
            inside += bend;
        }
    }
    let area = (0..patch.triangles.len()).map(|t| 0.5 * patch.cross(t).norm());
    Bends {
        total: INSIDE * inside + at_loops,
        area: area.sum(),
        energy,
    }
}

/// Two loops side by side of which one fits only if the mesh there faced the other way.
pub(super) fn opposed(set: &LoopSet) -> Option<[usize; 2]> {
    let set = &set.without_guides();
    let energy = |set: &LoopSet| {
        let means = [Measure::TotalBend, Measure::Energy].into_iter();
        let energies = means.filter_map(|by| Some(bends(set, triangulate(set, by, None)?).energy));
        energies.fold(f64::INFINITY, f64::min)
    };
    let given = energy(set);
    if given < FITS {
        return None;
    }
    let is_turned = |of: &usize| energy(&set.clone().with_reversed(*of)) < OPPOSED * given;
    // Of two either may be turned: the second one is named as well as the first.
    let turned = (0..set.count()).rev().find(is_turned)?;
    let beside = |connection: &Connection| {
        let ends = [connection.from, connection.to].map(|v| set.loop_of(v as usize));
        ends.contains(&turned).then_some(ends)
    };
    let [a, b] = connections(set).iter().find_map(beside)?;
    // The ends of a tube fit however far they are from each other, where the energy of a thin triangulation tells nothing.
    set.tube_axes([a, b]).is_none().then_some([a.min(b), a.max(b)])
}

/// A triangulation that is closed along the connections.
struct Closed<'a> {
    patch: Patch,
    set: &'a LoopSet,
    measure: Measure,
    outgoing: Vec<u32>,
}

impl<'a> Closed<'a> {
    fn new(set: &'a LoopSet, measure: Measure, patch: Patch) -> Self {
        Self {
            patch,
            set,
            measure,
            outgoing: Vec::new(),
        }
    }

    /// Whether no edge is there twice, or in the mesh.
    fn is_sound(&self) -> bool {
        let is_taken = |h: u32| {
            let (a, b) = (self.patch.origin(h), self.patch.target(h));
            self.set.taken.binary_search(&(a.min(b), a.max(b))).is_ok()
        };
        let mut inner = (0..self.patch.half_edges()).filter(|&h| self.patch.across(h) != NONE);
        let boundary = (0..self.patch.half_edges()).filter(|&h| self.patch.across(h) == NONE);
        boundary.count() == self.set.x.len() && !inner.any(is_taken) && self.doubles().is_empty()
    }

    /// Two copies of a vertex may have edges to the same vertex, or to copies of it: each such edge but one is flipped. None
    /// if one cannot be.
    fn part_doubles(&mut self) -> Option<()> {
        for _ in 0..self.patch.half_edges() {
            let doubles = self.doubles();
            if doubles.is_empty() {
                return Some(());
            }
            let mut best: Option<(f64, u32)> = None;
            for h in doubles {
                if self.can_flip(h) {
                    let (before, after) = self.costs(h);
                    if best.is_none_or(|best| after - before < best.0) {
                        best = Some((after - before, h));
                    }
                }
            }
            self.patch.flip(best?.1);
        }
        None
    }

    /// The edges whose ends have another edge between them.
    fn doubles(&self) -> Vec<u32> {
        let mut edges: Vec<(u32, u32, u32)> = (0..self.patch.half_edges())
            .filter(|&h| self.patch.across(h) == NONE || h < self.patch.across(h))
            .map(|h| {
                let (a, b) = (self.patch.origin(h), self.patch.target(h));
                (a.min(b), a.max(b), h)
            })
            .collect();
        edges.sort_unstable();
        let same = edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1));
        same.filter(|same| same.len() > 1)
            .flatten()
            .map(|edge| edge.2)
            .collect()
    }

    fn can_flip(&mut self, h: u32) -> bool {
        let o = self.patch.across(h);
        if o == NONE {
            return false;
        }
        if self.set.is_guide(self.patch.origin(h), self.patch.target(h)) {
            return false;
        }
        let (c, d) = (self.patch.apex(h), self.patch.apex(o));
        let taken = (c.min(d), c.max(d));
        c != d
            && self.set.taken.binary_search(&taken).is_err()
            && !self.patch.are_neighbours(c, d, &mut self.outgoing)
    }

    /// Flips edges while that lowers the sum: nothing had looked over the connections.
    fn flatten(&mut self) {
        for _ in 0..PASSES {
            let mut is_done = true;
            for h in 0..self.patch.half_edges() {
                let o = self.patch.across(h);
                if o == NONE || o < h {
                    continue;
                }
                let (before, after) = self.costs(h);
                if after < (1.0 - GAIN) * before && self.can_flip(h) {
                    self.patch.flip(h);
                    is_done = false;
                }
            }
            if is_done {
                return;
            }
        }
    }

    /// What an edge and the four around it count, before it is flipped and after.
    fn costs(&self, h: u32) -> (f64, f64) {
        let o = self.patch.across(h);
        let corners = [
            self.patch.origin(h),
            self.patch.target(h),
            self.patch.apex(h),
            self.patch.apex(o),
        ];
        let [a, b, c, d] = corners.map(|v| self.set.x[v as usize]);
        let around = [next(h), previous(h), next(o), previous(o)].map(|g| self.beyond(g));
        let sides = [c - b, a - c, d - a, b - d];
        let sum = |of: [&Side; 4], middle: f64| {
            let bends = (0..4).map(|k| self.over(&sides[k], of[k], &around[k]));
            middle + bends.sum::<f64>()
        };
        let (old0, old1) = (Side::new([a, b, c]), Side::new([b, a, d]));
        let before = sum([&old0, &old0, &old1, &old1], self.over(&(b - a), &old0, &old1));
        let (new0, new1) = (Side::new([c, a, d]), Side::new([d, b, c]));
        let after = sum([&new1, &new0, &new0, &new1], self.over(&(d - c), &new0, &new1));
        (before, after)
    }

    /// What the edge of a triangle of the patch counts.
    fn over(&self, edge: &Vector3<f64>, own: &Side, other: &Side) -> f64 {
        let theirs = if other.area > 0.0 { other.area } else { own.area };
        let bend = (1.0 - own.normal.dot(&other.normal)).max(0.0);
        self.measure.at_edge(edge.norm_squared(), bend, own.area + theirs)
    }

    /// What is on the other side of an edge.
    fn beyond(&self, h: u32) -> Side {
        match self.patch.across(h) {
            NONE => Side {
                normal: self.set.normals[self.patch.origin(h) as usize],
                area: 0.0,
            },
            o => Side::new(self.patch.triangles[o as usize / 3].map(|v| self.set.x[v as usize])),
        }
    }
}

/// A triangle at an edge: its unit normal and its area, zero for one of the mesh.
struct Side {
    normal: Vector3<f64>,
    area: f64,
}

impl Side {
    fn new([a, b, c]: [Vector3<f64>; 3]) -> Self {
        let cross = (b - a).cross(&(c - a));
        Self {
            normal: cross.try_normalize(0.0).unwrap_or_else(Vector3::zeros),
            area: (0.5 * cross.norm()).max(f64::MIN_POSITIVE),
        }
    }
}
