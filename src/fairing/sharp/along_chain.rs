//! The normal beside a chain of edges, of the triangles that touch it: two rows of vertices have no second derivative across, so that a fit to
//! heights tells no tangent plane of a strip; its triangles do.

use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::discrete::outside_fit::Fit;

/// So many edges tell a crease; of fewer, before a corner, more certainty is asked in proportion.
/// Half: of 60 parts none changes; double: 2 change, and 2 of 80 regions of scans have ends in place of 5.
pub(super) const LONG: usize = 5;
/// Unknowns of a linear function along and across; twice as many samples tell its error.
const UNKNOWNS: usize = 3;
/// Vertices stand off a plane by no more than this part of their distance, and normals of one side by no more radians. With ten times as much a cylinder's side is taken for a plane, and one of 30 rims
/// is off by 8e-4 radii in place of 1e-4.
pub(super) const FLAT: f64 = 1e-4;

/// Frames along a chain that turn with it and not around it: at the first vertex, in the middle of the first edge, at the second vertex, and so on.
pub(super) struct Frames {
    /// Tangent and two normals.
    at: Vec<[Vector3<f64>; 3]>,
    /// The length of the chain up to there, of that of all.
    s: Vec<f64>,
    length: f64,
}

/// A triangle at a chain.
pub(super) struct Beside {
    /// Where it touches the chain: the number of the frame.
    pub(super) frame: usize,
    pub(super) normal: Vector3<f64>,
    /// From the chain to its middle.
    pub(super) offset: Vector3<f64>,
}

/// A normal at the first vertex of a chain.
pub(super) struct AlongChain {
    pub(super) fit: Fit,
    /// How far those of the triangles are off, radians.
    pub(super) spread: f64,
}

impl Frames {
    /// Along the edges between these points; `None` if one has no length.
    pub(super) fn along(points: &[Vector3<f64>]) -> Option<Self> {
        let edges = points.windows(2).map(|p| p[1] - p[0]);
        let edges: Vec<Vector3<f64>> = edges.collect();
        let chords: Option<Vec<_>> = edges.iter().map(|e| e.try_normalize(0.0)).collect();
        let chords = chords?;
        let mut tangents = Vec::with_capacity(2 * points.len() - 1);
        tangents.push(first_tangent(&edges, &chords));
        for (k, chord) in chords.iter().enumerate() {
            tangents.push(*chord);
            let next = chords.get(k + 1).unwrap_or(chord);
            tangents.push((chord + next).try_normalize(1e-6)?);
        }
        let length = edges.iter().map(|e| e.norm()).sum();
        let mut s = vec![0.0];
        for e in &edges {
            let before = s[s.len() - 1];
            let step = e.norm() / length;
            s.extend([before + 0.5 * step, before + step]);
        }
        let mut at = vec![frame(tangents[0])];
        for t in tangents.windows(2) {
            let turn = Rotation3::rotation_between(&t[0], &t[1])?;
            let [_, u, w] = at[at.len() - 1];
            at.push([t[1], turn * u, turn * w]);
        }
        Some(Self { at, s, length })
    }

    /// The normal at the first vertex on the side of these triangles, whose angles around the chain are taken to be linear along and across.
    pub(super) fn normal(&self, triangles: &[Beside]) -> Option<AlongChain> {
        let first = triangles.first()?;
        let [_, u, w] = self.at[first.frame];
        let start = libm::atan2(first.normal.dot(&w), first.normal.dot(&u));
        let (sin, cos) = libm::sincos(start);
        let samples = triangles.iter().map(|tri| {
            let [t, u, w] = self.at[tri.frame];
            let [x, y] = [u * cos + w * sin, w * cos - u * sin].map(|axis| tri.normal.dot(&axis));
            let across = (tri.offset - t * tri.offset.dot(&t)).norm() / self.length;
            (Vector3::new(1.0, self.s[tri.frame], across), libm::atan2(y, x))
        });
        let samples: Vec<(Vector3<f64>, f64)> = samples.collect();
        let (turn, error) = at_zero(&samples)?;
        let spread = samples
            .iter()
            .map(|(_, psi)| (psi - turn).abs())
            .fold(0.0, f64::max);
        let (sin, cos) = libm::sincos(start + turn);
        let [_, u, w] = self.at[0];
        Some(AlongChain {
            fit: Fit {
                normal: u * cos + w * sin,
                error,
            },
            spread,
        })
    }
}

/// The tangent where the first of these edges starts, of the circle through the first two.
fn first_tangent(edges: &[Vector3<f64>], chords: &[Vector3<f64>]) -> Vector3<f64> {
    if edges.len() < 2 {
        return chords[0];
    }
    let weight = edges[0].norm() / (edges[0].norm() + edges[1].norm());
    let turn = Rotation3::scaled_rotation_between(&chords[1], &chords[0], weight);
    turn.map_or(chords[0], |turn| turn * chords[0])
}

/// A tangent and two directions across.
fn frame(t: Vector3<f64>) -> [Vector3<f64>; 3] {
    let least = Vector3::ith(t.iamin(), 1.0);
    let u = t.cross(&least).normalize();
    [t, u, t.cross(&u)]
}

/// The value of a linear function at zero by least squares, and its standard error; that of all, where they are one.
fn at_zero(samples: &[(Vector3<f64>, f64)]) -> Option<(f64, f64)> {
    let mean = samples.iter().map(|(_, psi)| psi).sum::<f64>() / samples.len() as f64;
    let spread = samples
        .iter()
        .map(|(_, psi)| (psi - mean).abs())
        .fold(0.0, f64::max);
    if samples.len() > 1 && spread < FLAT {
        return Some((mean, spread));
    }
    if samples.len() < 2 * UNKNOWNS {
        return None;
    }
    let matrix: Matrix3<f64> = samples.iter().map(|(phi, _)| phi * phi.transpose()).sum();
    let right: Vector3<f64> = samples.iter().map(|(phi, psi)| phi * *psi).sum();
    let inverse = matrix.try_inverse()?;
    let y = inverse * right;
    let square: f64 = samples.iter().map(|(phi, psi)| (psi - phi.dot(&y)).powi(2)).sum();
    let variance = square / (samples.len() - UNKNOWNS) as f64;
    Some((y[0], (variance * inverse[(0, 0)]).sqrt()))
}
