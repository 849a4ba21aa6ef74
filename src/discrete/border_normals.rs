//! Unit normals at the border vertices, estimated from the surface outside the region.
//!
//! The paper averages the outside triangles (7.5); that is wrong by `O(h)`. The gradient-corrected fit of
//! [`super::curvature`] over the outside alone is wrong by `O(h^2)` and exact on spheres, but on a rough scan it can
//! turn a normal far away. So both are blended by how certain the fit is, judged by its own residuals.

use nalgebra::Vector3;

use super::curvature::{FLAP_WEIGHT, Frame, NormalEquations, TILT_RIDGE, back_substitute};
use super::lanes::{Lanes, Vec3, lane, one};
use crate::error::Error;
use crate::mesh::{NONE, Region, Rings};

/// The repeated fit stops when the normal turns by less than this (radians).
const STANDS: f64 = 1e-13;
/// At most this many fits per vertex.
const MAX_FITS: usize = 300;
/// Fewer samples than this cannot judge a fit of five unknowns: the average is taken.
const FEWEST_SAMPLES: usize = 6;
/// With fewer outside neighbours than this, what lies behind them counts as much as they do, and reaches a ring further.
const SMALL_RING: usize = 4;
/// No normal is turned further than this by an uncertain fit, 30 degrees.
const TURN_CAP: f64 = 30.0 * std::f64::consts::PI / 180.0;
/// A fit with a standard error below this is taken without the cap, 0.1 degrees.
const CERTAIN: f64 = 0.1 * std::f64::consts::PI / 180.0;
/// Ridge of the fit: see [`super::curvature`].
const RIDGES: [f64; 5] = [0.0, 1e-6, 1e-6, TILT_RIDGE, TILT_RIDGE];

/// A fitted normal.
#[derive(Debug, Clone, Copy)]
struct Fit {
    normal: Vector3<f64>,
    /// Standard error of the tilt, radians.
    error: f64,
}

/// The normals of all border vertices: fitted, or averaged only. Border vertices without outside take what their
/// neighbours on the border have outside; where there is nothing either, the average of their triangles in the region
/// (paper 7.5).
///
/// # Errors
/// [`Error::NoNormal`] where all those triangles have no area; `given[b]` vertices are not looked at and keep
/// whatever they have.
pub fn estimate(
    region: &Region,
    rings: &Rings,
    x: &[Vector3<f64>],
    fitted: bool,
    given: &[Option<Vector3<f64>>],
) -> Result<Vec<Vector3<f64>>, Error> {
    let mut normals = vec![Vector3::zeros(); region.border];
    let mut fits = vec![None; region.border];
    for b in 0..region.border {
        if let Some(n) = given[b] {
            normals[b] = n;
            continue;
        }
        let outside = rings.outside_triangles(b);
        let average = if outside.is_empty() {
            average_beside(region, rings, x, b)
                .or_else(|| average(x, region.free + b, inside_edges(rings, b)))
        } else {
            average(x, region.free + b, outside)
        };
        normals[b] = average.ok_or(Error::NoNormal {
            vertex: region.vertex_ids[region.free + b] as usize,
        })?;
        if fitted {
            fits[b] = fit(region, rings, x, b, normals[b]);
        }
    }
    if fitted {
        for rim in rims(region, rings) {
            blend(&rim, &fits, &mut normals);
        }
    }
    Ok(normals)
}

fn inside_edges(rings: &Rings, b: usize) -> &[[u32; 2]] {
    &rings.border_edge[rings.border_edge_start[b] as usize..rings.border_edge_start[b + 1] as usize]
}

/// The normalized sum of the outside triangles' cross products of the border vertices beside `b`: for a fixed vertex in
/// the second row of the region, which has no outside itself.
fn average_beside(region: &Region, rings: &Rings, x: &[Vector3<f64>], b: usize) -> Option<Vector3<f64>> {
    let border = region.free..region.region_vertices();
    let beside = rings
        .border_ring(b)
        .iter()
        .filter(|j| border.contains(&(**j as usize)));
    let sum: Vector3<f64> = beside
        .filter_map(|&j| average(x, j as usize, rings.outside_triangles(j as usize - region.free)))
        .sum();
    sum.try_normalize(1e-6)
}

/// The normalized sum of the cross products of the triangles at vertex `v` with these ring edges.
pub fn average(x: &[Vector3<f64>], v: usize, edges: &[[u32; 2]]) -> Option<Vector3<f64>> {
    let q = x[v];
    let sum: Vector3<f64> = edges
        .iter()
        .map(|&[a, c]| (x[a as usize] - q).cross(&(x[c as usize] - q)))
        .sum();
    sum.try_normalize(f64::MIN_POSITIVE)
}

/// Samples around border vertex `b`: its outside ring with weight 1, the vertices behind it with [`FLAP_WEIGHT`]. Those
/// are the flaps and, for a vertex in a notch that has one or two outside triangles only, the outside rings of the
/// border vertices beside it.
fn samples(region: &Region, rings: &Rings, x: &[Vector3<f64>], b: usize) -> Vec<(Vec3<1>, f64)> {
    let own = (region.free + b) as u32;
    let q = x[region.free + b];
    let at = |j: u32| one(&(x[j as usize] - q));
    let range = |start: &[u32], b: usize| start[b] as usize..start[b + 1] as usize;
    let ring = &rings.outside_neighbour[range(&rings.outside_start, b)];
    let mut behind: Vec<u32> = rings.outside_flap[range(&rings.outside_edge_start, b)].to_vec();
    let mut beside: Vec<u32> = ring.iter().chain(rings.border_ring(b)).copied().collect();
    for _ in 0..if ring.len() < SMALL_RING { 2 } else { 1 } {
        for j in std::mem::take(&mut beside) {
            if (region.free..region.region_vertices()).contains(&(j as usize)) {
                behind.push(j);
                behind
                    .extend(&rings.outside_neighbour[range(&rings.outside_start, j as usize - region.free)]);
            }
        }
        beside.clone_from(&behind);
    }
    behind.sort_unstable();
    behind.dedup();
    behind.retain(|j| *j != NONE && *j != own && !ring.contains(j));
    let weight = if ring.len() < SMALL_RING { 1.0 } else { FLAP_WEIGHT };
    let near = ring.iter().map(|&j| (at(j), 1.0));
    near.chain(behind.into_iter().map(|j| (at(j), weight))).collect()
}

/// Fits again and again from the tilted normal, which takes the bias of the ridge away.
fn fit(region: &Region, rings: &Rings, x: &[Vector3<f64>], b: usize, start: Vector3<f64>) -> Option<Fit> {
    let samples = samples(region, rings, x, b);
    if samples.len() < FEWEST_SAMPLES {
        return None;
    }
    let ring: Vec<f64> = samples
        .iter()
        .filter(|s| s.1 == 1.0)
        .map(|s| super::lanes::dot(&s.0, &s.0).0[0])
        .collect();
    let l = (ring.iter().sum::<f64>() / ring.len() as f64).sqrt();
    let mut current = Fit {
        normal: start,
        error: 0.0,
    };
    for _ in 0..MAX_FITS {
        let next = fit_once(&samples, l, &current.normal);
        let turn = (next.normal - current.normal).norm();
        current = next;
        if turn < STANDS {
            break;
        }
    }
    current.normal.iter().all(|c| c.is_finite()).then_some(current)
}

fn fit_once(samples: &[(Vec3<1>, f64)], l: f64, n: &Vector3<f64>) -> Fit {
    let frame = Frame::new(one(n));
    let l = Lanes([l]);
    let mut normal_equations = NormalEquations::<1, 5>::new();
    let mut squared = NormalEquations::<1, 5>::new();
    for (e, weight) in samples {
        let (phi, kappa) = frame.sample(e, l);
        normal_equations.add(&phi, kappa, Lanes([*weight]));
        squared.add(&phi, kappa, Lanes([weight * weight]));
    }
    let factor = normal_equations.cholesky(&RIDGES);
    let y = back_substitute(&factor, normal_equations.right());
    let residual = |(e, weight): &(Vec3<1>, f64)| {
        let (phi, kappa) = frame.sample(e, l);
        let fitted: f64 = phi.iter().zip(&y).map(|(p, y)| p.0[0] * y.0[0]).sum();
        weight * (kappa.0[0] - fitted).powi(2)
    };
    let count = samples.len() as f64;
    let mean: f64 = samples.iter().map(residual).sum::<f64>() / normal_equations.weight().0[0];
    let variance = mean * count / (count - 5.0).max(0.5);
    let tilt_variance: f64 = (3..5).map(|r| covariance(&factor, &squared, r)).sum();
    Fit {
        normal: lane(&frame.tilted(l * y[3], l * y[4]), 0),
        error: l.0[0] * (variance * tilt_variance).sqrt(),
    }
}

/// Diagonal entry `r` of `M^-1 (sum w^2 phi phi^T) M^-1`.
fn covariance(factor: &[[Lanes<1>; 5]; 5], squared: &NormalEquations<1, 5>, r: usize) -> f64 {
    let mut unit = [Lanes([0.0]); 5];
    unit[r] = Lanes([1.0]);
    let z = back_substitute(factor, unit);
    squared.quadratic_form(&z).0[0]
}

/// Blends fits and averages over one rim: `t` says how far the fits of this rim are to be trusted at all, as the typical
/// turn against the typical error.
fn blend(rim: &[u32], fits: &[Option<Fit>], normals: &mut [Vector3<f64>]) {
    let mut turns: Vec<f64> = Vec::with_capacity(rim.len());
    let mut errors: Vec<f64> = Vec::with_capacity(rim.len());
    for &b in rim {
        if let Some(fit) = &fits[b as usize] {
            turns.push(angle(&normals[b as usize], &fit.normal).powi(2));
            errors.push(fit.error.powi(2));
        }
    }
    if turns.is_empty() {
        return;
    }
    let (turn, error) = (median(&mut turns), median(&mut errors));
    let t = turn / (turn + 4.0 * error).max(f64::MIN_POSITIVE);
    for &b in rim {
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

/// The angle between two unit vectors.
pub fn angle(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    a.cross(b).norm().atan2(a.dot(b))
}

fn median(values: &mut [f64]) -> f64 {
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// The border vertices, gathered into connected pieces of the border.
fn rims(region: &Region, rings: &Rings) -> Vec<Vec<u32>> {
    let mut parent: Vec<u32> = (0..region.border as u32).collect();
    fn root(parent: &mut [u32], mut i: u32) -> u32 {
        while parent[i as usize] != i {
            parent[i as usize] = parent[parent[i as usize] as usize];
            i = parent[i as usize];
        }
        i
    }
    for &half_edge in &rings.border_half_edges {
        let local = |v: u32| v - region.free as u32;
        let a = root(&mut parent, local(region.half_edges.origin(half_edge)));
        let b = root(&mut parent, local(region.half_edges.target(half_edge)));
        parent[a.max(b) as usize] = a.min(b);
    }
    let mut pieces: Vec<Vec<u32>> = vec![Vec::new(); region.border];
    for b in 0..region.border as u32 {
        pieces[root(&mut parent, b) as usize].push(b);
    }
    pieces.retain(|p| !p.is_empty());
    pieces
}
