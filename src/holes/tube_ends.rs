//! Two loops that are the ends of a tube.

use nalgebra::Vector3;

use super::loop_set::LoopSet;

/// Where a loop's mesh goes on to the same side all around, by more than this part of what it is long, that side is the tube's; else the
/// other loop tells it, if the way there is at less than this cosine to the loop's axis: 60 degrees. No axis points away from the other end
/// by more.
/// Half, of 62 pipes: none changes; double: no loop is the end of one, and spheres that face each other are refused.
const ALONG: f64 = 0.5;

impl LoopSet {
    /// The directions in which a tube goes on from two loops that are ends of one: axes towards each other, and the mesh facing the same
    /// side of the tube.
    pub(super) fn tube_axes(&self, ends: [usize; 2]) -> Option<[Vector3<f64>; 2]> {
        let onward = self.onward();
        let planes = ends.map(|of| self.plane(of));
        let way = (planes[1].centre - planes[0].centre).try_normalize(0.0)?;
        let axis = |end: usize| {
            let (normal, way) = (planes[end].normal, if end == 0 { way } else { -way });
            let range = self.range(ends[end]);
            let mean = onward[range.clone()].iter().sum::<Vector3<f64>>() / range.len() as f64;
            let along = [mean.dot(&normal), way.dot(&normal)];
            let side = along.into_iter().find(|along| along.abs() > ALONG)?;
            let axis = normal * side.signum();
            (axis.dot(&way) > -ALONG).then_some((axis, side > 0.0))
        };
        let (first, second) = (axis(0)?, axis(1)?);
        (first.1 == second.1).then_some([first.0, second.0])
    }
}
