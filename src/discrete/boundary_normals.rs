//! Unit normals at the boundary vertices, estimated from the surface outside the region.
//!
//! The paper averages the outside triangles (7.5); that is wrong by `O(h)`. The gradient-corrected fit of
//! [`super::curvature`] over the outside alone is exact on spheres and wrong by `O(h^2)`, with cubics by `O(h^3)`; but on
//! a rough scan it can turn a normal far away. So the order is chosen and blended with the average by how certain the
//! fits are, judged by their own residuals. Where the coordinates themselves are rounded, a fit to eight rings joins them.

use nalgebra::Vector3;

use super::eight_ring_fit::EightRingSamples;
use super::outside_fit::{Fit, SECOND, Samples, THIRD};
use crate::mesh::disjoint_sets::DisjointSets;
use crate::mesh::{OutsideNeighbours, RegionMesh, Rings};
use crate::support::error::Error;

/// No normal is turned further than this by an uncertain fit, 30 degrees; by none further than this and the angle at which triangles are there: of too few
/// rows of vertices a wrong fit is certain.
/// Of 42 cases, half: 14 change by up to 1 edge, 1 get another triangulation, -4 % iterations, 1 fails;
/// double: 9 change by up to 3 edges, +17 % iterations, 3 fail.
const TURN_CAP: f64 = 30.0 * std::f64::consts::PI / 180.0;
/// A fit with a standard error below this is taken without the cap, 0.1 degrees.
/// Half or double, of 112 cases: none changes.
const CERTAIN: f64 = 0.1 * std::f64::consts::PI / 180.0;

/// The normals of all boundary vertices: fitted, or averaged only. Boundary vertices without outside take what their
/// neighbours on the boundary have outside; where there is nothing either, the average of their triangles in the region
/// (paper 7.5).
///
/// # Errors
/// [`Error::NoNormal`] where all those triangles have no area; `given[b]` vertices are not looked at and keep
/// whatever they have.
pub(crate) fn estimate(
    region: &RegionMesh,
    rings: &Rings,
    x: &[Vector3<f64>],
    fitted: bool,
    given: &[Option<Vector3<f64>>],
) -> Result<Vec<Vector3<f64>>, Error> {
    let mut normals = vec![Vector3::zeros(); region.boundary];
    let mut fits = Fits::new(if fitted { region.boundary } else { 0 });
    let mut eight_rings = EightRingSamples::default();
    let neighbours = fitted.then(|| OutsideNeighbours::new(region));
    let (mut samples, mut found) = (Samples::default(), Vec::new());
    for b in 0..region.boundary {
        if let Some(n) = given[b] {
            normals[b] = n;
            continue;
        }
        normals[b] = average_at(region, rings, x, b).ok_or(Error::NoNormal {
            vertex: region.vertex_ids[region.free + b] as usize,
        })?;
        if let Some(neighbours) = &neighbours {
            samples.gather(neighbours, x, region.free + b, &mut found);
            let most = TURN_CAP + spread(region, rings, x, b, &normals[b]);
            let is_along = |fit: &Fit| angle(&fit.normal, &normals[b]) <= most;
            fits.second[b] = SECOND.fit(&samples, normals[b]).filter(is_along);
            fits.third[b] = THIRD.fit(&samples, normals[b]).filter(is_along);
            if region.is_rounded {
                eight_rings.gather(neighbours, x, region.free + b);
                fits.eight_rings[b] = eight_rings.fit(normals[b]).filter(is_along);
            }
        }
    }
    if let Some(neighbours) = &neighbours {
        for piece in pieces(region, rings) {
            let bends = || {
                piece
                    .iter()
                    .filter_map(|&b| bend(x, region.free + b as usize, rings.outside_triangles(b as usize)))
            };
            let most = if is_one_row(region.free, &piece, neighbours) {
                median_of(bends())
            } else {
                f64::INFINITY
            };
            blend(&piece, fits.of(&piece), most, &mut normals);
        }
    }
    Ok(normals)
}

/// Whether all that is known lies on two curves, the piece itself and what is one edge away. A sphere goes through any two circles, those of a
/// cylinder made of one row of quads, too.
fn is_one_row(free: usize, piece: &[u32], neighbours: &OutsideNeighbours) -> bool {
    let mut near: Vec<u32> = piece.iter().map(|&b| free as u32 + b).collect();
    let around = |of: &[u32]| {
        let mut around: Vec<u32> = of.iter().flat_map(|&v| neighbours.of(v)).copied().collect();
        around.sort_unstable();
        around.dedup();
        around
    };
    let next = around(&near);
    near.extend(&next);
    near.sort_unstable();
    around(&next).iter().all(|v| near.binary_search(v).is_ok())
}

/// How far the outside triangles at a boundary vertex and those beside it are off a normal, radians.
fn spread(region: &RegionMesh, rings: &Rings, x: &[Vector3<f64>], b: usize, normal: &Vector3<f64>) -> f64 {
    let beside = rings.boundary_ring(b).iter().map(|&j| j as usize);
    let beside = beside.filter_map(|j| j.checked_sub(region.free).filter(|j| *j < region.boundary));
    let off = |c: usize| {
        let triangles = rings.outside_triangles(c).iter();
        triangles.map(move |tri| angle(&across(x, region.free + c, tri), normal))
    };
    beside.chain([b]).flat_map(off).fold(0.0, f64::max)
}

/// The largest angle between triangles side by side at vertex `v`, of those with these other corners.
fn bend(x: &[Vector3<f64>], v: usize, triangles: &[[u32; 2]]) -> Option<f64> {
    let pairs = triangles.iter().flat_map(|first| {
        let beside = triangles.iter().filter(move |second| first[1] == second[0]);
        beside.map(move |second| angle(&across(x, v, first), &across(x, v, second)))
    });
    pairs.reduce(f64::max)
}

/// The fits of both orders, and to eight rings, at every boundary vertex, where there are enough samples.
struct Fits {
    second: Vec<Option<Fit>>,
    third: Vec<Option<Fit>>,
    eight_rings: Vec<Option<Fit>>,
}

impl Fits {
    fn new(boundary: usize) -> Self {
        Self {
            second: vec![None; boundary],
            third: vec![None; boundary],
            eight_rings: vec![None; boundary],
        }
    }

    /// The fits to be used on a piece of the boundary: those that are most certain there; on noise that is the lower order.
    fn of(&mut self, piece: &[u32]) -> &[Option<Fit>] {
        prefer_certain(&mut self.second, &self.third, piece);
        prefer_certain(&mut self.second, &self.eight_rings, piece);
        &self.second
    }
}

/// Replaces the fits on a piece of the boundary by others if those are more certain, by the medians of where there are both.
fn prefer_certain(fits: &mut [Option<Fit>], others: &[Option<Fit>], piece: &[u32]) {
    let (mut errors, mut other_errors) = (Vec::new(), Vec::new());
    for &b in piece {
        if let (Some(fit), Some(other)) = (&fits[b as usize], &others[b as usize]) {
            errors.push(fit.error);
            other_errors.push(other.error);
        }
    }
    if !errors.is_empty() && median(&mut other_errors) < median(&mut errors) {
        for &b in piece {
            fits[b as usize] = others[b as usize].or(fits[b as usize]);
        }
    }
}

/// The average at boundary vertex `b`, of the triangles that [`estimate`] names.
fn average_at(region: &RegionMesh, rings: &Rings, x: &[Vector3<f64>], b: usize) -> Option<Vector3<f64>> {
    match rings.outside_triangles(b) {
        [] => average_beside(region, rings, x, b)
            .or_else(|| average(x, region.free + b, rings.boundary_triangles(b))),
        outside => average(x, region.free + b, outside),
    }
}

/// The normalized sum of the outside triangles' cross products of the boundary vertices beside `b`: for a fixed vertex in
/// the second row of the region, which has no outside itself.
fn average_beside(region: &RegionMesh, rings: &Rings, x: &[Vector3<f64>], b: usize) -> Option<Vector3<f64>> {
    let boundary = region.free..region.region_vertices();
    let beside = rings
        .boundary_ring(b)
        .iter()
        .filter(|j| boundary.contains(&(**j as usize)));
    let sum: Vector3<f64> = beside
        .filter_map(|&j| average(x, j as usize, rings.outside_triangles(j as usize - region.free)))
        .sum();
    sum.try_normalize(1e-6)
}

/// The normalized sum of the cross products of the triangles at vertex `v` with these other corners.
pub(crate) fn average(x: &[Vector3<f64>], v: usize, triangles: &[[u32; 2]]) -> Option<Vector3<f64>> {
    let sum: Vector3<f64> = triangles.iter().map(|tri| across(x, v, tri)).sum();
    sum.try_normalize(f64::MIN_POSITIVE)
}

/// The cross product of the triangle at vertex `v` with these other corners.
fn across(x: &[Vector3<f64>], v: usize, &[a, c]: &[u32; 2]) -> Vector3<f64> {
    (x[a as usize] - x[v]).cross(&(x[c as usize] - x[v]))
}

/// Blends fits and averages over one piece of the boundary: `t` says how far its fits are to be trusted at all, as the
/// typical turn against the typical error. Where that turn is more than `most`, the averages stay.
fn blend(piece: &[u32], fits: &[Option<Fit>], most: f64, normals: &mut [Vector3<f64>]) {
    let mut turns: Vec<f64> = Vec::with_capacity(piece.len());
    let mut errors: Vec<f64> = Vec::with_capacity(piece.len());
    for &b in piece {
        if let Some(fit) = &fits[b as usize] {
            turns.push(angle(&normals[b as usize], &fit.normal).powi(2));
            errors.push(fit.error.powi(2));
        }
    }
    if turns.is_empty() {
        return;
    }
    let (turn, error) = (median(&mut turns), median(&mut errors));
    if turn > most * most {
        return;
    }
    let t = turn / (turn + 4.0 * error).max(f64::MIN_POSITIVE);
    for &b in piece {
        let Some(fit) = &fits[b as usize] else { continue };
        let average = normals[b as usize];
        let delta = angle(&average, &fit.normal);
        let cap = if fit.error < CERTAIN {
            1.0
        } else {
            TURN_CAP / (t * delta).max(f64::MIN_POSITIVE)
        };
        let w = t * cap.min(1.0);
        if let Some(n) = (average * (1.0 - w) + fit.normal * w).try_normalize(1e-6) {
            normals[b as usize] = n;
        }
    }
}

/// The angle between two vectors; zero where one of them is.
pub(crate) fn angle(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    // Products with a zero may be -0, of which the arc tangent is half a turn.
    libm::atan2(a.cross(b).norm(), a.dot(b) + 0.0)
}

/// The unit vector a fraction `s` of the way from `a` to `b` along their great circle.
pub(crate) fn slerp(a: &Vector3<f64>, b: &Vector3<f64>, s: f64) -> Vector3<f64> {
    let phi = angle(a, b);
    if phi < 1e-9 || s >= 1.0 {
        return *b;
    }
    let mixed = a * libm::sin((1.0 - s) * phi) + b * libm::sin(s * phi);
    mixed.try_normalize(1e-12).unwrap_or(*b)
}

fn median_of(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    if values.is_empty() {
        0.0
    } else {
        median(&mut values)
    }
}

fn median(values: &mut [f64]) -> f64 {
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// The boundary vertices, gathered into connected pieces of the boundary.
fn pieces(region: &RegionMesh, rings: &Rings) -> Vec<Vec<u32>> {
    let mut sets = DisjointSets::new(region.boundary);
    for &half_edge in &rings.boundary_half_edges {
        let local = |v: u32| v - region.free as u32;
        sets.unite(
            local(region.half_edges.origin(half_edge)),
            local(region.half_edges.target(half_edge)),
        );
    }
    let mut pieces: Vec<Vec<u32>> = vec![Vec::new(); region.boundary];
    for b in 0..region.boundary as u32 {
        pieces[sets.smallest(b) as usize].push(b);
    }
    pieces.retain(|p| !p.is_empty());
    pieces
}
