//! Where a blend runs through to the face across, its edge with that face: from one of the other two creases to the other, in place of their corner. At the
//! boundary of the surface it is the boundary's.
//!
//! A ball that rolls between two planes leaves a circular cylinder, and another plane that cuts all three does so along two lines and an ellipse
//! between, the affine image of a circle. With tangents of equal length a circle that turns by t is, from a corner c to points p and q,
//! c + a (p - c) + b (q - c), with a = (sin((t - s) / 2) / sin(t / 2))^2 and b = (sin(s / 2) / sin(t / 2))^2, where it has turned by s; and so are its images. Where
//! these edges are curved, their points before and behind the corner stand for those of lines.

use nalgebra::Vector3;

use super::cut::Cut;
use super::face_normals::FaceNormals;
use super::legs::{Leg, Sense, outgoing};
use super::surface::between;
use super::through::Through;
use crate::fairing::{CreaseEnd, CreasePoint, GivenCrease};

/// Faces that bend by less (radians) have a line between rails.
const FLAT: f64 = 1e-6;

/// From rail to rail: vertices and where they are to lie. The blend is on the left, and the face across on the right.
pub(super) type Arc = Vec<(u32, CreasePoint)>;

/// The arcs on faces across from these ends, as creases; none where a corner was not cut as it should be.
pub(super) fn arcs(cut: &Cut<'_>, through: &[Through], normals: &FaceNormals<'_>) -> Vec<GivenCrease> {
    let outgoing = outgoing(cut, through);
    let crease = |of: &Through| {
        let legs = [Sense::Away, Sense::Towards].map(|sense| Leg::new(cut, of, sense, &outgoing));
        let [Some(first), Some(last)] = legs else {
            return None;
        };
        let (vertices, points) = arc(cut, [&first, &last], normals)?.into_iter().unzip();
        Some(GivenCrease {
            ends: [
                end(cut, &first, Sense::Away, normals)?,
                end(cut, &last, Sense::Towards, normals)?,
            ],
            vertices,
            points,
        })
    };
    let all = through.iter().filter(|of| of.face.is_some());
    all.filter_map(crease).collect()
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
        let [done, left] = [along / length, 1.0 - along / length];
        let [a, b] = [left, done].map(|part| turns[0].part(part));
        let ([p, towards_p], [q, towards_q]) = (legs[0].at(a[0]), legs[1].at(b[0]));
        let tangent = towards_q * b[1] - towards_p * a[1];
        let [blend, across] = [0, 1].map(|side| {
            let normal = turns[side].normal(done);
            normal - tangent * (normal.dot(&tangent) / tangent.norm_squared())
        });
        let point = CreasePoint {
            place: corner + p + q,
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
            angle: between(&from, &to).max(FLAT),
        }
    }

    /// The factor `a` where so much of the turn is left, or `b` where it is done, and how fast it changes with the angle.
    fn part(&self, part: f64) -> [f64; 2] {
        let whole = libm::sin(0.5 * self.angle);
        let angle = part * self.angle;
        [
            (libm::sin(0.5 * angle) / whole).powi(2),
            0.5 * libm::sin(angle) / whole.powi(2),
        ]
    }

    /// The normal where so much of it is done, of any length.
    fn normal(&self, done: f64) -> Vector3<f64> {
        let at = |part: f64| libm::sin(part * self.angle);
        self.normals[0] * at(1.0 - done) + self.normals[1] * at(done)
    }
}

/// How the crease arrives at the rail, along whose last step it comes in.
fn end(cut: &Cut<'_>, leg: &Leg, sense: Sense, normals: &FaceNormals<'_>) -> Option<CreaseEnd> {
    let [inside, h] = *leg.steps.last_chunk()?;
    let [v, outside] = sense.ends(cut, h);
    let at = |v: u32| cut.sheet.x[v as usize];
    let direction = (at(sense.ends(cut, inside)[0]) - at(v)).try_normalize(0.0)?;
    let of = |side: usize| normals.between(&cut.sheet.parents[v as usize], leg.faces[side]);
    // On the left of the way from the corner is right of the way to it.
    let [left, right] = match sense {
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
        chains: vec![vec![v, outside]],
    })
}
