//! Curves between two points whose curvature is linear in arc length: of one dimension what a harmonic mean curvature is of two.
//!
//! The unit tangent turns by `T' = (a + b s) x T`, `s` the arc length over the whole. Lines (`a = b = 0`) and circles (`b = 0`) are among them;
//! in a plane they are Euler's spirals. Of all `a`, `b` that lead from end to end the smallest are taken, which do not twist about `T`.

use nalgebra::{SMatrix, SVector, Vector3};

use crate::discrete::boundary_normals::angle;
use crate::discrete::simd::tangents;

/// Pieces along which the turning is constant.
const PIECES: usize = 64;
/// At most this many of Newton's steps.
const STEPS: usize = 40;
/// No step of it turns the curve by more, radians.
const LARGEST: f64 = 1.0;
/// The ends are met to this, in chords and radians.
const MET: f64 = 1e-11;
/// By which derivatives are differences.
const DIFFERENCE: f64 = 1e-5;

/// A point of a curve, and the unit tangent there.
#[derive(Debug, Clone, Copy)]
pub(super) struct CurvePoint {
    pub(super) at: Vector3<f64>,
    pub(super) tangent: Vector3<f64>,
}

/// A curve of finite length.
#[derive(Debug, Clone)]
pub(super) struct Curve {
    start: CurvePoint,
    /// `a` and `b`, radians over the whole curve.
    turning: [Vector3<f64>; 2],
    pub(super) length: f64,
}

impl Curve {
    /// From one end to the other, with these tangents; `None` where none is found.
    pub(super) fn between(start: CurvePoint, end: CurvePoint) -> Option<Self> {
        let chord = (end.at - start.at).norm();
        if chord == 0.0 {
            return None;
        }
        let mut curve = Self::arc(start, end.at)?;
        let [u, v] = tangents(&end.tangent);
        let miss = |curve: &Self| {
            let reached = curve.at(1.0);
            let off = (reached.at - end.at) / chord;
            let [x, y] = [u, v].map(|across| reached.tangent.dot(&across));
            SVector::<f64, 5>::from([off.x, off.y, off.z, x, y])
        };
        for _ in 0..STEPS {
            let now = miss(&curve);
            if now.norm() < MET {
                let forward = curve.at(1.0).tangent.dot(&end.tangent) > 0.0;
                return forward.then_some(curve);
            }
            let columns: Vec<SVector<f64, 5>> = (0..7)
                .map(|k| {
                    let by = |step| curve.changed(&(SVector::<f64, 7>::ith(k, step)), chord);
                    (miss(&by(DIFFERENCE)) - miss(&by(-DIFFERENCE))) / (2.0 * DIFFERENCE)
                })
                .collect();
            let jacobian = SMatrix::<f64, 5, 7>::from_columns(&columns);
            let square = (jacobian * jacobian.transpose()).cholesky()?;
            let step = -(jacobian.transpose() * square.solve(&now));
            let longest = step.amax();
            curve = curve.changed(&(step * (LARGEST / longest).min(1.0)), chord);
            if !(curve.length > 0.0 && curve.length < 20.0 * chord) {
                return None;
            }
        }
        None
    }

    /// The circle, or line, from an end with this curvature.
    pub(super) fn with_curvature(start: CurvePoint, curvature: Vector3<f64>, length: f64) -> Self {
        Self {
            start,
            turning: [start.tangent.cross(&curvature) * length, Vector3::zeros()],
            length,
        }
    }

    /// The circle from an end with its tangent to a point, where it may be already; `None` to one that lies straight behind
    /// it.
    pub(super) fn arc(start: CurvePoint, to: Vector3<f64>) -> Option<Self> {
        let chord = to - start.at;
        let half = angle(&start.tangent, &chord);
        let axis = start.tangent.cross(&chord).try_normalize(1e-12 * chord.norm());
        let stretch = if half < 1e-6 { 1.0 } else { half / libm::sin(half) };
        (half < 3.0).then(|| Self {
            start,
            turning: [axis.unwrap_or_default() * (2.0 * half), Vector3::zeros()],
            length: chord.norm() * stretch,
        })
    }

    /// With other `a`, `b` and length, the last in chords.
    fn changed(&self, by: &SVector<f64, 7>, chord: f64) -> Self {
        let [a, b] = self.turning;
        Self {
            turning: [a + by.fixed_rows::<3>(0), b + by.fixed_rows::<3>(3)],
            length: self.length + by[6] * chord,
            ..*self
        }
    }

    /// The point at this part of the length.
    pub(super) fn at(&self, part: f64) -> CurvePoint {
        let whole = (part * PIECES as f64).clamp(0.0, PIECES as f64);
        let mut point = self.start;
        for piece in 0..PIECES {
            let share = (whole - piece as f64).min(1.0);
            if share <= 0.0 {
                break;
            }
            point = self.advanced(point, piece, share);
        }
        point
    }

    /// Points so many pieces apart, from end to end.
    pub(super) fn points(&self) -> Vec<CurvePoint> {
        let mut points = vec![self.start];
        for piece in 0..PIECES {
            points.push(self.advanced(points[piece], piece, 1.0));
        }
        points
    }

    /// Which part of the length is before the point nearest to `x`, and how far that is.
    pub(super) fn nearest(&self, x: &Vector3<f64>) -> (f64, f64) {
        let points = self.points();
        let pieces = points.windows(2).enumerate().map(|(k, ends)| {
            let chord = ends[1].at - ends[0].at;
            let share = (x - ends[0].at).dot(&chord) / chord.norm_squared().max(f64::MIN_POSITIVE);
            let share = share.clamp(0.0, 1.0);
            let off = (ends[0].at + chord * share - x).norm();
            ((k as f64 + share) / PIECES as f64, off)
        });
        let nearest = pieces.min_by(|a, b| a.1.total_cmp(&b.1));
        nearest.unwrap_or((0.0, f64::INFINITY))
    }

    /// A share of a piece on, along a circle or a helix.
    fn advanced(&self, from: CurvePoint, piece: usize, share: f64) -> CurvePoint {
        let [a, b] = self.turning;
        let part = share / PIECES as f64;
        let turn = (a + b * ((piece as f64 + 0.5) / PIECES as f64)) * part;
        let (t, way) = (from.tangent, self.length * part);
        let theta = turn.norm();
        if theta < 1e-9 {
            let half = turn.cross(&t) * 0.5;
            return CurvePoint {
                at: from.at + (t + half) * way,
                tangent: (t + half * 2.0).normalize(),
            };
        }
        let axis = turn / theta;
        let (sin, cos) = (libm::sin(theta), libm::cos(theta));
        let (across, along) = (axis.cross(&t), axis * axis.dot(&t));
        let mean = t * (sin / theta) + across * ((1.0 - cos) / theta) + along * (1.0 - sin / theta);
        CurvePoint {
            at: from.at + mean * way,
            tangent: (t * cos + across * sin + along * (1.0 - cos)).normalize(),
        }
    }

    /// The curvatures at both ends.
    pub(super) fn curvatures(&self) -> [Vector3<f64>; 2] {
        let [a, b] = self.turning;
        let last = self.at(1.0).tangent;
        [a.cross(&self.start.tangent), (a + b).cross(&last)].map(|turn| turn / self.length)
    }

    /// The mean square of the turning, radians over the whole curve.
    pub(super) fn bending(&self) -> f64 {
        let [a, b] = self.turning;
        a.norm_squared() + a.dot(&b) + b.norm_squared() / 3.0
    }

    /// Unit vectors along the curve that turn with it and no more, from one across it at the start to one at the end; what is missing then is
    /// spread over the length. One for each of [`points`](Self::points).
    pub(super) fn carried(&self, from: Vector3<f64>, to: Vector3<f64>) -> Vec<Vector3<f64>> {
        let carried = self.transported(from);
        let last = self.at(1.0);
        let reached = carried[PIECES];
        let missing = libm::atan2(reached.cross(&to).dot(&last.tangent), reached.dot(&to));
        let turned = (0..).zip(self.points()).zip(&carried).map(|((k, point), n)| {
            let phi = missing * f64::from(k) / PIECES as f64;
            n * libm::cos(phi) + point.tangent.cross(n) * libm::sin(phi)
        });
        turned.collect()
    }

    /// The same without an end to be met.
    pub(super) fn transported(&self, from: Vector3<f64>) -> Vec<Vector3<f64>> {
        let across = |n: Vector3<f64>, t: &Vector3<f64>| {
            let n = n - t * n.dot(t);
            n.try_normalize(1e-12).unwrap_or(n)
        };
        let mut last = from;
        let mut before = self.start.tangent;
        let carried = self.points().into_iter().map(|point| {
            // The least turn from tangent to tangent: two reflections.
            let t = point.tangent;
            let sum = before + t;
            let flipped = last - sum * (2.0 * last.dot(&sum) / sum.norm_squared());
            last = across(flipped - t * (2.0 * flipped.dot(&t)), &t);
            before = t;
            last
        });
        carried.collect()
    }
}

/// What is known at the points of a curve, at this part of the length: of unit vectors.
pub(super) fn between_points(vectors: &[Vector3<f64>], part: f64) -> Vector3<f64> {
    let whole = part.clamp(0.0, 1.0) * (vectors.len() - 1) as f64;
    let k = (whole as usize).min(vectors.len() - 2);
    let share = whole - k as f64;
    (vectors[k] * (1.0 - share) + vectors[k + 1] * share).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(at: [f64; 3], tangent: [f64; 3]) -> CurvePoint {
        CurvePoint {
            at: at.into(),
            tangent: Vector3::from(tangent).normalize(),
        }
    }

    #[test]
    fn lines_and_circles_are_exact() {
        let line = Curve::between(
            point([1.0, 2.0, 3.0], [1.0, 1.0, 0.0]),
            point([3.0, 4.0, 3.0], [1.0, 1.0, 0.0]),
        );
        let line = line.unwrap();
        assert_near!(line.length, 8f64.sqrt(), 1e-12);
        assert!((line.at(0.25).at - Vector3::new(1.5, 2.5, 3.0)).norm() < 1e-12);
        for degrees in [10.0f64, 90.0, 200.0] {
            let angle = degrees.to_radians();
            let on = |phi: f64| point([phi.cos(), phi.sin(), 0.5], [-phi.sin(), phi.cos(), 0.0]);
            let circle = Curve::between(on(0.3), on(0.3 + angle)).unwrap();
            assert_near!(circle.length, angle, 1e-9);
            for part in [0.1, 0.5, 0.77] {
                assert!((circle.at(part).at - on(0.3 + part * angle).at).norm() < 1e-9);
            }
        }
    }

    /// Where the curve of two cylinders, of radii 1 and .6, is met with its tangents, it is off by a few thousandths inside.
    #[test]
    fn curves_in_space_are_near_to_what_they_replace() {
        let on = |u: f64| {
            let (y, z) = (0.6 * u.sin(), 0.6 * u.cos());
            let x = (1.0 - y * y).sqrt();
            point([x, y, z], [-y * z / x, z, -y])
        };
        let curve = Curve::between(on(0.4), on(1.4)).unwrap();
        let off = |part: f64| {
            let near = |k: u32| (on(0.4 + f64::from(k) * 1e-3).at - curve.at(part).at).norm();
            (0..1000).map(near).fold(f64::INFINITY, f64::min)
        };
        assert_below!((1..10).map(|k| off(0.1 * f64::from(k))).fold(0.0, f64::max), 4e-3);
    }

    #[test]
    fn normals_of_a_rim_turn_with_it() {
        let on = |phi: f64| point([phi.cos(), phi.sin(), 0.0], [-phi.sin(), phi.cos(), 0.0]);
        let rim = Curve::between(on(0.0), on(1.2)).unwrap();
        let cap = rim.carried(Vector3::z(), Vector3::z());
        let side = rim.carried(on(0.0).at, on(1.2).at);
        for (k, point) in rim.points().iter().enumerate() {
            assert!((cap[k] - Vector3::z()).norm() < 1e-9);
            assert!((side[k] - point.at).norm() < 1e-9);
        }
        // A quarter of the missing angle at a quarter of the way.
        let half = Vector3::new(0.0, 1.0, 1.0).normalize();
        let line = Curve::between(
            point([0.0; 3], [1.0, 0.0, 0.0]),
            point([1.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        );
        let turned = line.unwrap().carried(Vector3::z(), half);
        assert_near!(
            angle(&between_points(&turned, 0.25), &Vector3::z()).to_degrees(),
            45.0 / 4.0,
            1e-9
        );
    }
}
