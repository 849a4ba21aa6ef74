//! The free sides of a bridge: curves that leave the mesh tangentially, and the normals along them.
//!
//! A side is a cubic with given end tangents, as long as make it a circle of the fourth order where the ends lie
//! symmetrically. Normals are carried along without turning about the curve (double reflection: Wang, Jüttler, Zheng, Liu
//! 2008); what is missing at the other end is a twist in proportion to the way.

use nalgebra::{Matrix5, Unit, Vector3, Vector5};

use super::bridge_chains::Chain;
use super::links::Links;
use super::loop_set::normal;
use crate::mesh::halfedge::{next, previous};

/// Curves are measured in so many steps.
/// Of 6 cases, half: 5 change by up to 4e-4 edges, 1 get another triangulation; double: 5 change by up to 1e-4 edges.
const STEPS: usize = 256;
/// The direction of a side may differ by so much from the perpendicular to the chain at its end (radians, 45 degrees).
/// Of 6 cases, half: 3 change, 3 get another triangulation; double: 3 change, 3 get another triangulation, 1 more succeeds.
const ASKEW: f64 = std::f64::consts::FRAC_PI_4;
/// Where a boundary turns by more than this (radians, 30 degrees) to one side and then to the other, it is one of teeth.
/// Of 5 cases, half: 3 change, 3 get another triangulation, -11 % iterations; double: none changes.
const TOOTH: f64 = std::f64::consts::FRAC_PI_6;
/// Tangents are no longer than for this sum of 1 + cosine of the angles between chord and tangent: curves that lead
/// back make no wide bows.
/// Half or double, of 6 cases: none changes.
const LEAST_COSINE: f64 = 0.5;
/// Normals at corners are fitted to the vertices within so many edges.
/// Of 6 cases, half: 6 change by up to 0.01 edges, 4 get another triangulation; double: 6 change, 6 get another triangulation.
const RINGS: usize = 3;
/// They are fitted so often, each time from the one before.
/// Of 6 cases, half: 5 change by up to 7e-4 edges, 1 get another triangulation; double: 5 change by up to 8e-5 edges.
const FITS: usize = 4;

/// A corner of the strip: where it is, which way a side leaves the mesh there, and the mesh's normal.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corner {
    pub(super) at: Vector3<f64>,
    pub(super) onward: Vector3<f64>,
    pub(super) normal: Vector3<f64>,
}

/// What a strip begins or ends with: its first and last corner, and its middle.
#[derive(Debug, Clone, Copy)]
pub(super) struct End {
    pub(super) first: Corner,
    pub(super) last: Corner,
    pub(super) middle: Corner,
    /// The mean length of the chain's edges.
    pub(super) edge: f64,
}

impl End {
    /// That of a chain; None if its triangles have no area.
    pub(super) fn new(links: &Links<'_>, positions: &[[f64; 3]], chain: &Chain) -> Option<Self> {
        let at = |v: u32| Vector3::from(positions[v as usize]);
        let edge = |&h: &u32| Edge::new(links, positions, h);
        let edges: Vec<Edge> = chain.half_edges.iter().map(edge).collect();
        let beside = chain
            .beside
            .each_ref()
            .map(|list| list.iter().map(edge).collect::<Vec<_>>());
        let sum = sum_of(&edges);
        let is_tooth = is_tooth(&sum, &beside);
        let mean = match is_tooth {
            true => sum_of(edges.iter().chain(beside.iter().flatten())),
            false => sum,
        };
        let mean = mean.onward.try_normalize(0.0)?;
        let corner = |v: u32, edge: &Edge| {
            let normal = fitted_normal(links, positions, v)?;
            let local = normal.cross(&edge.along).try_normalize(0.0)?;
            let most = if is_tooth {
                std::f64::consts::FRAC_PI_2
            } else {
                ASKEW
            };
            Some(Corner {
                at: at(v),
                onward: turned_towards(&local, &mean, &normal, most),
                normal,
            })
        };
        let (first, last) = (edges.first()?, edges.last()?);
        let first = corner(*chain.vertices.first()?, first)?;
        let last = corner(*chain.vertices.last()?, last)?;
        let normal = (first.normal + last.normal).try_normalize(0.0)?;
        let middle = Corner {
            at: 0.5 * (first.at + last.at),
            onward: (mean - normal * normal.dot(&mean)).try_normalize(0.0)?,
            normal,
        };
        let length: f64 = edges.iter().map(|edge| edge.along.norm()).sum();
        let edge = length / edges.len() as f64;
        (edge > 0.0).then_some(Self {
            first,
            last,
            middle,
            edge,
        })
    }
}

/// An edge of a loop, or the sum of several.
#[derive(Debug, Clone, Copy)]
struct Edge {
    /// From its first vertex to its second, in the direction of the loop.
    along: Vector3<f64>,
    /// As long, and perpendicular to it away from the mesh.
    onward: Vector3<f64>,
    /// The normal of the mesh's triangle there.
    normal: Vector3<f64>,
}

impl Edge {
    /// The one at a half-edge of the mesh, which runs the other way.
    fn new(links: &Links<'_>, positions: &[[f64; 3]], h: u32) -> Self {
        let at = |v: u32| Vector3::from(positions[v as usize]);
        let along = at(links.origin(h)) - at(links.origin(next(h)));
        let normal = normal(&links.triangles[h as usize / 3].map(at));
        Self {
            along,
            onward: normal.cross(&along),
            normal,
        }
    }
}

fn sum_of<'e>(edges: impl IntoIterator<Item = &'e Edge>) -> Edge {
    let zero = Edge {
        along: Vector3::zeros(),
        onward: Vector3::zeros(),
        normal: Vector3::zeros(),
    };
    edges.into_iter().fold(zero, |sum, edge| Edge {
        along: sum.along + edge.along,
        onward: sum.onward + edge.onward,
        normal: sum.normal + edge.normal,
    })
}

/// Whether a boundary turns to one side before a chain and to the other behind it, as a saw's does. Which way the surface goes on is then told
/// by more of the boundary than the chain.
fn is_tooth(chain: &Edge, beside: &[Vec<Edge>; 2]) -> bool {
    let turn = |a: &Edge, b: &Edge| {
        let across = chain.normal.dot(&a.along.cross(&b.along));
        libm::atan2(across, chain.normal.norm() * a.along.dot(&b.along))
    };
    let [Some(before), Some(behind)] = beside.each_ref().map(|list| list.first()) else {
        return false;
    };
    let turns = [turn(before, chain), turn(chain, behind)];
    turns[0] * turns[1] < 0.0 && turns.iter().all(|turn| turn.abs() > TOOTH)
}

/// A direction perpendicular to `normal` turned about it towards another one, by no more than an angle.
fn turned_towards(from: &Vector3<f64>, to: &Vector3<f64>, normal: &Vector3<f64>, most: f64) -> Vector3<f64> {
    let across = normal.cross(from);
    let angle = libm::atan2(to.dot(&across), to.dot(from)).clamp(-most, most);
    from * libm::cos(angle) + across * libm::sin(angle)
}

/// The normal of the mesh at a boundary vertex: that of a paraboloid through it, fitted to what is around. Where there is too little
/// around, the mean of its triangles; None if these have no area.
fn fitted_normal(links: &Links<'_>, positions: &[[f64; 3]], v: u32) -> Option<Vector3<f64>> {
    let at = |v: u32| Vector3::from(positions[v as usize]);
    let cross = |h: u32| {
        let [a, b, c] = links.triangles[h as usize / 3].map(at);
        (b - a).cross(&(c - a))
    };
    let sum: Vector3<f64> = links.at(v).iter().map(|&h| cross(h)).sum();
    let mean = sum.try_normalize(0.0)?;
    let mut found = vec![v];
    let mut from = 0;
    for _ in 0..RINGS {
        let end = found.len();
        for i in from..end {
            for &h in links.at(found[i]) {
                for w in [next(h), previous(h)].map(|g| links.origin(g)) {
                    if !found.contains(&w) {
                        found.push(w);
                    }
                }
            }
        }
        from = end;
    }
    let around: Vec<Vector3<f64>> = found[1..].iter().map(|&w| at(w) - at(v)).collect();
    let mut normal = mean;
    for _ in 0..FITS {
        match tilted(&around, &normal).filter(|fitted| fitted.dot(&mean) > 0.5) {
            Some(fitted) => normal = fitted,
            None => return Some(mean),
        }
    }
    Some(normal)
}

/// The normal at the origin of the paraboloid over the plane perpendicular to `normal` that fits some points best.
fn tilted(around: &[Vector3<f64>], normal: &Vector3<f64>) -> Option<Vector3<f64>> {
    let least = (0..3).min_by(|&i, &j| normal[i].abs().total_cmp(&normal[j].abs()))?;
    let mut axis = Vector3::zeros();
    axis[least] = 1.0;
    let e = normal.cross(&axis).try_normalize(0.0)?;
    let f = normal.cross(&e);
    let scale = around.iter().map(Vector3::norm).fold(0.0, f64::max);
    let (mut matrix, mut right) = (Matrix5::zeros(), Vector5::zeros());
    for p in around.iter().filter(|p| p.iter().all(|c| c.is_finite())) {
        let [x, y, z] = [p.dot(&e), p.dot(&f), p.dot(normal)].map(|c| c / scale);
        let basis = Vector5::new(x, y, x * x, x * y, y * y);
        let weight = 1.0 / (x * x + y * y + z * z).max(f64::MIN_POSITIVE);
        matrix += weight * basis * basis.transpose();
        right += weight * z * basis;
    }
    let solution = matrix.cholesky()?.solve(&right);
    (normal - e * solution[0] - f * solution[1]).try_normalize(0.0)
}

/// A side from one corner of the strip to another.
#[derive(Debug, Clone)]
pub(super) struct Side {
    x: Vec<Vector3<f64>>,
    tangents: Vec<Vector3<f64>>,
    normals: Vec<Vector3<f64>>,
    /// The way to each of these points.
    way: Vec<f64>,
}

impl Side {
    pub(super) fn new(from: &Corner, to: &Corner) -> Self {
        let chord = to.at - from.at;
        let distance = chord.norm();
        let cosines = [from.onward.dot(&chord), -to.onward.dot(&chord)];
        let mean = 0.5 * cosines.iter().sum::<f64>() / distance.max(f64::MIN_POSITIVE);
        let length = 2.0 * distance / (1.0 + mean).max(LEAST_COSINE);
        let (leave, arrive) = (from.onward * length, -to.onward * length);
        let (mut x, mut tangents) = (Vec::new(), Vec::new());
        for i in 0..=STEPS {
            let s = i as f64 / STEPS as f64;
            let (a, b) = (s * s * (3.0 - 2.0 * s), s * s * (s - 1.0));
            x.push(from.at + chord * a + leave * (s * (1.0 - s) * (1.0 - s)) + arrive * b);
            let slope = chord * (6.0 * s * (1.0 - s))
                + leave * ((1.0 - s) * (1.0 - 3.0 * s))
                + arrive * (s * (3.0 * s - 2.0));
            tangents.push(slope.try_normalize(0.0).unwrap_or_else(Vector3::zeros));
        }
        let mut way = vec![0.0];
        for i in 0..STEPS {
            way.push(way[i] + (x[i + 1] - x[i]).norm());
        }
        let mut normals = vec![from.normal];
        for i in 0..STEPS {
            let carried = carried(&normals[i], [&x[i], &x[i + 1]], [&tangents[i], &tangents[i + 1]]);
            normals.push(carried);
        }
        Self {
            x,
            tangents,
            normals,
            way,
        }
    }

    /// The angle about the curve from the normal that is carried along it to that at its end.
    pub(super) fn twist(&self, end: &Vector3<f64>) -> f64 {
        let (normal, tangent) = (&self.normals[STEPS], &self.tangents[STEPS]);
        libm::atan2(normal.cross(end).dot(tangent), normal.dot(end))
    }

    /// Twists the normals by this angle in all.
    pub(super) fn twisted(mut self, twist: f64) -> Self {
        let total = self.way[STEPS].max(f64::MIN_POSITIVE);
        for i in 0..=STEPS {
            let angle = twist * self.way[i] / total;
            let (normal, tangent) = (self.normals[i], self.tangents[i]);
            self.normals[i] = normal * libm::cos(angle) + tangent.cross(&normal) * libm::sin(angle);
        }
        self
    }

    /// How many edges there are along it, if they grow from one length to another.
    pub(super) fn edges(&self, from: f64, to: f64) -> f64 {
        self.count(from, to)[STEPS]
    }

    /// Points along it with the normals there, the ends left out: `count` edges in all, which grow from one length to another.
    pub(super) fn points(&self, count: usize, from: f64, to: f64) -> Vec<(Vector3<f64>, Vector3<f64>)> {
        let counts = self.count(from, to);
        let total = counts[STEPS];
        let point = |k: usize| {
            let wanted = total * k as f64 / count as f64;
            let i = counts.partition_point(|&c| c < wanted).clamp(1, STEPS);
            let part = (wanted - counts[i - 1]) / (counts[i] - counts[i - 1]).max(f64::MIN_POSITIVE);
            let normal = self.normals[i - 1] * (1.0 - part) + self.normals[i] * part;
            let at = self.x[i - 1] * (1.0 - part) + self.x[i] * part;
            (at, Unit::new_normalize(normal).into_inner())
        };
        (1..count).map(point).collect()
    }

    /// The number of edges up to each point.
    fn count(&self, from: f64, to: f64) -> Vec<f64> {
        let total = self.way[STEPS].max(f64::MIN_POSITIVE);
        let size = |i: usize| from + (to - from) * self.way[i] / total;
        let mut counts = vec![0.0];
        for i in 0..STEPS {
            let mean = 0.5 * (size(i) + size(i + 1));
            counts.push(counts[i] + (self.way[i + 1] - self.way[i]) / mean);
        }
        counts
    }
}

/// A normal carried to the next point of a curve by reflections in two planes.
fn carried(normal: &Vector3<f64>, x: [&Vector3<f64>; 2], tangents: [&Vector3<f64>; 2]) -> Vector3<f64> {
    let reflected = |p: &Vector3<f64>, v: &Vector3<f64>| {
        let square = v.norm_squared();
        if square > 0.0 {
            p - v * (2.0 / square * v.dot(p))
        } else {
            *p
        }
    };
    let way = x[1] - x[0];
    let second = tangents[1] - reflected(tangents[0], &way);
    let normal = reflected(&reflected(normal, &way), &second);
    let across = normal - tangents[1] * tangents[1].dot(&normal);
    across.try_normalize(0.0).unwrap_or(normal)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on_sphere(longitude: f64, latitude: f64, onward: f64) -> Corner {
        let (s, c) = longitude.sin_cos();
        let (t, d) = latitude.sin_cos();
        let normal = Vector3::new(c * d, s * d, t);
        let east = Vector3::new(-s, c, 0.0);
        Corner {
            at: normal,
            onward: east * onward,
            normal,
        }
    }

    #[test]
    fn sides_on_a_parallel_of_a_sphere_stay_on_it_with_its_normals() {
        let (from, to) = (on_sphere(0.0, 0.3, 1.0), on_sphere(1.0, 0.3, -1.0));
        let side = Side::new(&from, &to);
        assert_below!(side.twist(&to.normal).abs(), 1e-4);
        for (x, n) in side.points(10, 0.1, 0.1) {
            assert!((x.norm() - 1.0).abs() < 2e-4, "{}", x.norm() - 1.0);
            assert!(
                (x.normalize() - n).norm() < 2e-3,
                "{}",
                (x.normalize() - n).norm()
            );
        }
    }

    #[test]
    fn edges_grow_from_one_length_to_the_other() {
        let corner = |x: f64, onward: f64| Corner {
            at: Vector3::x() * x,
            onward: Vector3::x() * onward,
            normal: Vector3::z(),
        };
        let side = Side::new(&corner(0.0, 1.0), &corner(10.0, -1.0));
        let count = side.edges(0.1, 1.0).round() as usize;
        let points = side.points(count, 0.1, 1.0);
        assert_eq!(points.len() + 1, count);
        let first = points[0].0.x;
        let last = 10.0 - points[count - 2].0.x;
        assert!(
            (first - 0.1).abs() < 0.02 && (last - 1.0).abs() < 0.2,
            "{first} {last}"
        );
        assert_all!(points.iter(), |(x, _)| x.y == 0.0 && x.z == 0.0);
        assert_all!(points.iter(), |(_, n)| *n == Vector3::z());
    }

    #[test]
    fn a_way_back_is_half_a_circle() {
        let corner = |z: f64, normal: f64| Corner {
            at: Vector3::z() * z,
            onward: Vector3::x(),
            normal: Vector3::z() * normal,
        };
        let side = Side::new(&corner(1.0, 1.0), &corner(-1.0, -1.0));
        assert_below!(side.twist(&-Vector3::z()).abs(), 1e-9);
        assert_near!(side.way[STEPS], std::f64::consts::PI, 0.06);
        // Facing the same way, the strip would have to be turned over.
        assert_near!(side.twist(&Vector3::z()).abs(), std::f64::consts::PI, 1e-9);
    }
}
