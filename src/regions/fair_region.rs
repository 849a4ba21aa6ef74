//! A region's fair surface, and how far what is there lies above it.

use std::ops::ControlFlow;

use nalgebra::Vector3;

use super::neighbours::Neighbours;
use crate::discrete::normals::normals_by_areas;
use crate::fairing::{Intersections, Options, fair_within};
use crate::mesh::Selection;
use crate::mesh::coincident::Coincident;

/// What is enough to compare surfaces, over their size: no height is told from less. Half or double: no figure changes, see bump.rs.
const TOLERANCE: f64 = 1e-7;
/// A height is surely less if it is by this part, and by so many standard errors of its square. Figures as in bump.rs, half: the
/// same; double: 1.25, 1.04, 1.39, 1.16, and two more are not found.
const FALL: f64 = 0.05;
/// The boundary's noise lifts more than that of single heights, which the error is made of. Half: 1.12, 1.04, 1.55, .94; double: the same;
/// a tenth: a bump on hair is taken that is none.
const SIGNIFICANT: f64 = 100.0;

/// Triangles to be faired.
pub(super) struct FairRegion<'m> {
    mesh: Neighbours<'m>,
    triangles: Vec<u32>,
    /// Whether each vertex is inside, and not where the surface ends.
    moves: Vec<bool>,
    meets_an_end: bool,
    /// How much the normals of the triangles around have in common: 1 where they are parallel, 0 where they point to all sides.
    facing: f64,
}

/// How they are when they are faired.
pub(super) struct Faired {
    pub triangles: Vec<u32>,
    /// Whether each vertex moves.
    moves: Vec<bool>,
    /// Whether the surface ends inside.
    pub meets_an_end: bool,
    positions: Vec<Vector3<f64>>,
    /// Normals and areas of the vertices,
    normals: Vec<Vector3<f64>>,
    area: Vec<f64>,
    /// and how far each was above, along the normal; 0 where it does not move.
    above: Vec<f64>,
    /// Neighbours that move.
    edges: Vec<[u32; 2]>,
}

/// How far a region's vertices lie above its fair surface.
pub(super) struct Heights {
    pub vertices: Vec<u32>,
    pub above: Vec<f64>,
    /// On the fair surface.
    pub area: Vec<f64>,
    /// The root mean square of what neighbours have in common,
    pub rms: f64,
    /// and the mean square of the rest, which each vertex has by itself: noise.
    noise: f64,
}

impl<'m> FairRegion<'m> {
    /// Of a mesh whose triangles are in it or not.
    pub(super) fn new(mesh: Neighbours<'m>, is_in: Vec<bool>) -> Self {
        let triangles: Vec<u32> = (0..is_in.len() as u32).filter(|&t| is_in[t as usize]).collect();
        let mut moves = vec![false; mesh.positions.len()];
        let mut is_at_rim = vec![false; mesh.positions.len()];
        let mut meets_an_end = false;
        for &v in triangles.iter().flat_map(|&t| &mesh.triangles[t as usize]) {
            let is_inside = mesh.at(v).iter().all(|&t| is_in[t as usize]);
            let is_end = is_inside && mesh.is_at_end(v);
            meets_an_end |= is_end;
            moves[v as usize] = is_inside && !is_end;
            is_at_rim[v as usize] = !is_inside;
        }
        let is_beside = |t: &usize| !is_in[*t] && mesh.triangles[*t].iter().any(|&v| is_at_rim[v as usize]);
        let beside = (0..is_in.len()).filter(is_beside);
        let (sum, area) = beside.fold((Vector3::zeros(), 0.0), |(sum, area), t| {
            let [a, b, c] = mesh.triangles[t].map(|v| mesh.place(v));
            let normal = (b - a).cross(&(c - a));
            (sum + normal, area + normal.norm())
        });
        Self {
            facing: sum.norm() / area.max(f64::MIN_POSITIVE),
            mesh,
            triangles,
            moves,
            meets_an_end,
        }
    }

    fn corners(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.triangles.iter().map(|&t| self.mesh.triangles[t as usize])
    }

    pub(super) fn free(&self) -> usize {
        count(&self.moves)
    }

    /// How much the normals around have in common, from 0 to 1.
    pub(super) fn facing(&self) -> f64 {
        self.facing
    }

    /// With its fair surface, through which sharp edges go on, of this continuity; none where there is none.
    pub(super) fn faired(self, continuity: f64) -> Option<Faired> {
        let options = Options {
            tolerance: TOLERANCE,
            continuity,
            intersections: Intersections::Skip,
            coincident: Coincident::Separate,
            ..Options::default()
        };
        let mesh = &self.mesh;
        let selection = Selection::Mask(&self.moves);
        let mut go_on = |_: &_| ControlFlow::Continue(());
        let solution = fair_within(mesh.positions, mesh.triangles, selection, &options, &mut go_on).ok()?;
        let positions: Vec<_> = solution.positions.into_iter().map(Vector3::from).collect();
        let normals = normals_by_areas(&positions, self.corners());
        let before: Vec<_> = (0..positions.len() as u32).map(|v| mesh.place(v)).collect();
        let normals_before = normals_by_areas(&before, self.corners());
        let above = |v: usize| match self.moves[v] {
            true => apart([&positions[v], &before[v]], [&normals[v], &normals_before[v]]),
            false => 0.0,
        };
        let area = areas(&positions, self.corners());
        let sides = self.corners().flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
        let edges = sides
            .filter(|side| side.iter().all(|&v| self.moves[v as usize]))
            .collect();
        Some(Faired {
            above: (0..positions.len()).map(above).collect(),
            triangles: self.triangles,
            moves: self.moves,
            meets_an_end: self.meets_an_end,
            area,
            positions,
            normals,
            edges,
        })
    }
}

impl Faired {
    pub(super) fn free(&self) -> usize {
        count(&self.moves)
    }

    /// By how much the surface differs from that of a larger region, and that one from what lies in the larger region alone, over the height:
    /// but for noise, and with it. The larger one has the same vertices, and more.
    pub(super) fn disagreement(&self, larger: &Self) -> [f64; 2] {
        let step = |v: usize| {
            let positions = [&self.positions[v], &larger.positions[v]];
            apart(positions, [&self.normals[v], &larger.normals[v]])
        };
        let change = mean(&self.area, |v| self.moves[v], |v| step(v) * step(v));
        let is_beyond = |v: usize| larger.moves[v] && !self.moves.get(v).copied().unwrap_or(false);
        let common = larger.common(is_beyond);
        let all = mean(&larger.area, is_beyond, |v| larger.above[v] * larger.above[v]);
        let height = self.common(|_| true).max(f64::MIN_POSITIVE);
        [common, all.max(common)].map(|beyond| ((change + beyond) / height).sqrt().min(f64::MAX))
    }

    /// The heights, by other numbers of the vertices.
    pub(super) fn heights(&self, name: impl Fn(u32) -> u32) -> Heights {
        let vertices = || (0..self.moves.len()).filter(|v| self.moves[*v]);
        let common = self.common(|_| true);
        let all = mean(&self.area, |v| self.moves[v], |v| self.above[v] * self.above[v]);
        Heights {
            vertices: vertices().map(|v| name(v as u32)).collect(),
            above: vertices().map(|v| self.above[v]).collect(),
            area: vertices().map(|v| self.area[v]).collect(),
            rms: common.sqrt(),
            noise: (all - common).max(0.0),
        }
    }

    /// The mean product of the heights of neighbours, of some vertices.
    fn common(&self, counts: impl Fn(usize) -> bool) -> f64 {
        let edges = self.edges.iter().map(|e| e.map(|v| v as usize));
        let edges = edges.filter(|[v, w]| counts(*v) && counts(*w));
        let (sum, area) = edges.fold((0.0, 0.0), |(sum, area), [v, w]| {
            let weight = self.area[v] + self.area[w];
            (sum + weight * self.above[v] * self.above[w], area + weight)
        });
        (sum / f64::max(area, f64::MIN_POSITIVE)).max(0.0)
    }
}

impl Heights {
    /// The largest, with its sign.
    pub(super) fn most(&self) -> f64 {
        let larger = |a: f64, b: f64| if b.abs() > a.abs() { b } else { a };
        self.above.iter().copied().fold(0.0, larger)
    }

    /// Whether the fair surface is solved no better than they are large.
    pub(super) fn are_rounding(&self) -> bool {
        self.rms <= TOLERANCE * self.area.iter().sum::<f64>().sqrt()
    }

    /// Whether they are surely less than others.
    pub(super) fn are_below(&self, others: &Self) -> bool {
        let error = self.noise.max(others.noise) / (others.vertices.len() as f64).sqrt();
        let least = (1.0 - FALL) * others.rms;
        self.rms * self.rms < least * least - SIGNIFICANT * error
    }
}

/// The areas of the vertices of some triangles.
fn areas(positions: &[Vector3<f64>], triangles: impl Iterator<Item = [u32; 3]>) -> Vec<f64> {
    let mut area = vec![0.0; positions.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|v| positions[v as usize]);
        let sixth = (b - a).cross(&(c - a)).norm() / 6.0;
        triangle.iter().for_each(|&v| area[v as usize] += sixth);
    }
    area
}

/// The mean over what belongs to some vertices.
fn mean(area: &[f64], counts: impl Fn(usize) -> bool, of: impl Fn(usize) -> f64) -> f64 {
    let some = (0..area.len()).filter(|v| counts(*v));
    let (sum, area) = some.fold((0.0, 0.0), |(sum, all), v| (sum + area[v] * of(v), all + area[v]));
    sum / f64::max(area, f64::MIN_POSITIVE)
}

/// How far a surface lies above another one, by a vertex that has slid along it: on a sphere chords are orthogonal to the mean of both normals.
fn apart([from, to]: [&Vector3<f64>; 2], [n, m]: [&Vector3<f64>; 2]) -> f64 {
    (to - from).dot(&(n + m).try_normalize(0.0).unwrap_or_default())
}

fn count(moves: &[bool]) -> usize {
    moves.iter().filter(|moves| **moves).count()
}
