//! Corners at the boundary: two creases of the surroundings end there, and a third one leads into the region.

use nalgebra::Vector3;

use super::branch::between_planes;
use super::outside::Outside;
use crate::discrete::boundary_normals::angle;
use crate::fairing::sharp_edge::CreaseEnd;

/// The third crease leads into the region, not past it: the cosine of its angle with the middle of the region is no less.
/// Half: of 165 regions across edges of parts none changes; double: one fewer is good.
const INWARD: f64 = 0.2;

/// The crease between the sides that the two at a boundary vertex do not have in common; `None` where it is not certain where that leads.
pub(super) fn third(outside: &Outside<'_>, [a, b]: [CreaseEnd; 2]) -> Option<CreaseEnd> {
    let apart = |left: &CreaseEnd, right: &CreaseEnd| angle(&normal(left, 1), &normal(right, 0));
    let [left, right] = if apart(&a, &b) <= apart(&b, &a) {
        [a, b]
    } else {
        [b, a]
    };
    let half = 0.5 * left.angle.abs().min(right.angle.abs());
    if apart(&left, &right).to_degrees() > half {
        return None;
    }
    let normals = [normal(&left, 0), normal(&right, 1)];
    let inward = inward(outside, left.vertex)?;
    let (tangent, angle) = between_planes(&normals, &inward)?;
    (tangent.dot(&inward) >= INWARD).then(|| CreaseEnd {
        vertex: left.vertex,
        direction: tangent.into(),
        curvature: [0.0; 3],
        curvature_error: f64::INFINITY,
        normals: normals.map(Into::into),
        angle,
        error: libm::hypot(left.error, right.error),
        chains: [left.chains, right.chains].concat(),
    })
}

/// On the left (0) or on the right, seen into the region.
fn normal(end: &CreaseEnd, side: usize) -> Vector3<f64> {
    end.normals[side].into()
}

/// The direction midway between the edges of the boundary at a vertex that has two.
fn inward(outside: &Outside<'_>, v: u32) -> Option<Vector3<f64>> {
    let [p, q] = outside.beside(v)?;
    let way = |w: u32| (outside.position(w) - outside.position(v)).try_normalize(0.0);
    (way(p)? + way(q)?).try_normalize(0.1)
}
