//! The edges with which blends end, in place of a corner between two lines from there to rails: where a blend runs through to the face across these are the
//! other two creases, at the boundary of the surface its two parts, and at a mitre the third crease and the line between both bands.
//!
//! A ball that rolls between two planes leaves a circular cylinder, and another plane that cuts all three does so along two lines and an ellipse
//! between, the affine image of a circle. With tangents of equal length a circle that turns by t is, from a corner c to points p and q,
//! c + a (p - c) + b (q - c), with a = (sin((t - s) / 2) / sin(t / 2))^2 and b = (sin(s / 2) / sin(t / 2))^2, where it has turned by s; and so are its images. Where
//! these edges are curved, their points before and behind the corner stand for those of lines.
//!
//! Two such cylinders, along u and v from a corner, meet in c + a (q - c) + b' x u + b y v, where p - c = x u + y v is where their rails cross on the plane between
//! them, q where the other ones do, and b and b' are those of the first cylinder and of the second where a is the same.

use nalgebra::Vector3;

use super::chain_curve::FLATTEST;
use super::cut::Cut;
use super::face_normals::FaceNormals;
use super::legs::{Leg, Sense, Way, outgoing};
use super::surface::between;
use crate::fairing::{CreaseEnd, CreasePoint, GivenCrease};

/// From rail to rail: vertices and where they are to lie. The blend is on the left, and the face across on the right.
pub(super) type Arc = Vec<(u32, CreasePoint)>;

/// The arcs around corners, from one line to the other, as creases; none where a corner was not cut as it should be.
pub(super) fn arcs(cut: &Cut<'_>, lines: &[(u32, [Way; 2])], normals: &FaceNormals<'_>) -> Vec<GivenCrease> {
    let outgoing = outgoing(cut, lines.iter().map(|of| of.0));
    let crease = |(corner, ways): &(u32, [Way; 2])| {
        let [first, last] = ways.map(|way| Leg::new(cut, *corner, way, &outgoing));
        let legs = [&first?, &last?];
        let (vertices, points) = arc(cut, legs, normals)?.into_iter().unzip();
        let [first, last] = legs.map(|leg| end(cut, leg, normals));
        Some(GivenCrease {
            ends: [first?, last?],
            vertices,
            points,
        })
    };
    lines.iter().filter_map(crease).collect()
}

/// The arc from the rail of one leg to that of the other.
pub(super) fn arc(cut: &Cut<'_>, legs: [&Leg; 2], normals: &FaceNormals<'_>) -> Option<Arc> {
    let normal = |leg: &Leg, face: u32| normals.between(&cut.sheet.parents[leg.rail() as usize], face);
    let mut turns = Vec::new();
    for side in [0, 1] {
        turns.push(Turn::new(
            normal(legs[0], legs[0].faces[side])?,
            normal(legs[1], legs[1].faces[side])?,
        ));
    }
    let corner = legs[0].vertices[0].1;
    let length = legs[0].length() + legs[1].length();
    let point = |(v, along): (u32, f64)| {
        let left = 1.0 - along / length;
        let a = turns[0].factor(left);
        // Both cylinders of a mitre are at the same a.
        let left = match legs[1].aside {
            Some(_) => [left, turns[1].part(a)],
            None => [left; 2],
        };
        let [b, other] = [0, 1].map(|side| turns[side].factor(1.0 - left[side]));
        let ([to_q, along_q], [to_p, along_p]) = (legs[0].at(a), legs[1].at(b));
        let aside = legs[1].aside.unwrap_or_default();
        // How b and the other b change with a, times the sine of what is left.
        let sines = turns[0].sine(left[0]);
        let by = turns[0].sine(1.0 - left[0]);
        let by_other = turns[1].sine(1.0 - left[1]) * turns[0].over(left[0], &turns[1], left[1]);
        let tangent = along_q * sines - along_p * by + aside * (by - by_other);
        let [blend, across] = [0, 1].map(|side| {
            let normal = turns[side].normal(1.0 - left[side]);
            normal - tangent * (normal.dot(&tangent) / tangent.norm_squared())
        });
        let point = CreasePoint {
            place: corner + to_q + to_p + aside * (other - b),
            normals: [blend.try_normalize(0.0)?, across.try_normalize(0.0)?],
        };
        Some((v, point))
    };
    let first = legs[0]
        .vertices
        .iter()
        .rev()
        .map(|of| (of.0, legs[0].length() - of.2));
    let last = legs[1]
        .vertices
        .iter()
        .skip(1)
        .map(|of| (of.0, legs[0].length() + of.2));
    first.chain(last).map(point).collect()
}

/// From one normal to another one.
struct Turn {
    normals: [Vector3<f64>; 2],
    angle: f64,
}

impl Turn {
    fn new(from: Vector3<f64>, to: Vector3<f64>) -> Self {
        Self {
            normals: [from, to],
            angle: between(&from, &to).max(FLATTEST),
        }
    }

    /// The factor `a` where so much of the turn is left, or `b` where it is done.
    fn factor(&self, part: f64) -> f64 {
        (libm::sin(0.5 * part * self.angle) / libm::sin(0.5 * self.angle)).powi(2)
    }

    /// The part at which this is the factor.
    fn part(&self, factor: f64) -> f64 {
        2.0 * libm::asin((factor.sqrt() * libm::sin(0.5 * self.angle)).min(1.0)) / self.angle
    }

    fn sine(&self, part: f64) -> f64 {
        libm::sin(part * self.angle)
    }

    /// The sine of a part of this turn over that of a part of another one, where both have the same factor, which may be zero.
    fn over(&self, part: f64, other: &Self, of_other: f64) -> f64 {
        let half = |turn: &Self, part: f64| libm::sin(0.5 * turn.angle) * libm::cos(0.5 * part * turn.angle);
        half(self, part) / half(other, of_other)
    }

    /// The normal where so much of it is done, of any length.
    fn normal(&self, done: f64) -> Vector3<f64> {
        self.normals[0] * self.sine(1.0 - done) + self.normals[1] * self.sine(done)
    }
}

/// How the crease arrives at the rail.
fn end(cut: &Cut<'_>, leg: &Leg, normals: &FaceNormals<'_>) -> Option<CreaseEnd> {
    let [(_, inside, _), (v, rail, _)] = *leg.vertices.last_chunk()?;
    let direction = (inside - rail).try_normalize(0.0)?;
    let of = |side: usize| normals.between(&cut.sheet.parents[v as usize], leg.faces[side]);
    // On the left of the way from the corner is right of the way to it.
    let [left, right] = match leg.sense {
        Sense::Away => [of(0)?, of(1)?],
        Sense::Towards => [of(1)?, of(0)?],
    };
    Some(CreaseEnd {
        vertex: v,
        direction: direction.into(),
        curvature: [0.0; 3],
        curvature_error: f64::INFINITY,
        normals: [left, right].map(Into::into),
        angle: between(&left, &right).to_degrees() * left.cross(&right).dot(&direction).signum(),
        error: 0.0,
        chains: vec![std::iter::once(v).chain(leg.outside).collect()],
    })
}
