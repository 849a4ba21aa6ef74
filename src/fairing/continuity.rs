//! How far the surface continues the curvature of its surroundings: what is asked, and what came of it.

use super::boundary_curvature::BoundaryCurvature;
use super::options::Options;
use crate::mesh::RegionMesh;
use crate::mesh::boundary_loops::boundary_loops;
use crate::solve::{AskedContinuity, Blend, Domain, LoopContinuity};
use crate::support::entries::sort_by_number;
use crate::support::error::Error;

/// What is asked of a region whose unit of length is `scale` of the input's, at some of whose boundary vertices the normal or place is the
/// caller's; nothing, where tangent planes alone are to be continued.
pub(super) fn asked_continuity(
    region: &RegionMesh,
    options: &Options,
    scale: f64,
    is_given: &[bool],
) -> Option<AskedContinuity> {
    if !options.asks_continuity() {
        return None;
    }
    let given = match &options.boundary_curvature {
        BoundaryCurvature::Estimated => Vec::new(),
        BoundaryCurvature::Given(list) => {
            let scaled = list.iter().map(|(v, h)| (*v, h * scale));
            at_boundary(region, scaled.collect())
        }
    };
    let blend = |continuity: f64| match continuity == Options::CONTINUITY_AUTO {
        true if options.may_continue() => Blend::Auto,
        true => Blend::Part(0.0),
        false => Blend::Part(continuity),
    };
    let of_loops = options.loop_continuity.iter().enumerate();
    let of_loops: Vec<_> = of_loops
        .map(|(place, (v, of_loop))| (*v, (place, blend(*of_loop))))
        .collect();
    Some(AskedContinuity {
        blend: blend(options.continuity),
        of_loops: if of_loops.is_empty() {
            Vec::new()
        } else {
            at_boundary(region, of_loops)
        },
        given,
        is_given: is_given.to_vec(),
    })
}

/// What is given for vertices, by boundary vertex. Of repeated ones the last holds.
fn at_boundary<T: Copy>(region: &RegionMesh, mut list: Vec<(u32, T)>) -> Vec<Option<T>> {
    sort_by_number(&mut list);
    let boundary = region.vertex_ids[region.free..region.region_vertices()].iter();
    boundary
        .map(|v| {
            let after = list.partition_point(|entry| entry.0 <= *v);
            let last = after.checked_sub(1).map(|k| list[k])?;
            (last.0 == *v).then_some(last.1)
        })
        .collect()
}

/// The vertices of all boundary loops, by the caller's numbers.
pub(super) fn on_loops(domain: &Domain) -> impl Iterator<Item = u32> + '_ {
    let region = &domain.region;
    let loops = boundary_loops(region, &domain.rings).into_iter();
    loops
        .flatten()
        .map(move |b| region.vertex_ids[region.free + b as usize])
}

/// Checks that the loops exist that numbers are given for. Nothing is looked for where none are.
pub(crate) fn check_loops(list: &[(u32, f64)], on_loops: impl Iterator<Item = u32>) -> Result<(), Error> {
    if list.is_empty() {
        return Ok(());
    }
    let mut vertices: Vec<u32> = on_loops.collect();
    vertices.sort_unstable();
    let astray = list.iter().find(|(v, _)| vertices.binary_search(v).is_err());
    astray.map_or(Ok(()), |(v, _)| Err(Error::NotOnLoop { vertex: *v as usize }))
}

/// What came of the continuity of curvature along one boundary loop, in the unit of the positions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvatureContinuity {
    /// The boundary vertex of the loop with the smallest number.
    pub vertex: usize,
    /// How many vertices the loop has.
    pub vertices: usize,
    /// How much of the way to the curvature of the surroundings was asked for; -1: all of it, if it is certain.
    pub asked: f64,
    /// How much of the way from the tangent-continuous surface's mean curvature to that of the surroundings was taken, in the mean along the
    /// loop: from 0 (the surroundings are too rough or uncertain, their curvature is the surface's already, or no sound surface has it) to
    /// [`Options::continuity`](crate::Options::continuity).
    pub reached: f64,
    /// The jump of the mean curvature at the loop of the tangent-continuous surface, root mean square.
    pub jump_before: f64,
    /// The largest such jump.
    pub largest_jump_before: f64,
    /// The jump of the mean curvature at the loop, root mean square.
    pub jump: f64,
    /// The largest jump.
    pub largest_jump: f64,
    /// The root mean square of the mean curvature of the surroundings along the loop.
    pub curvature: f64,
    /// How uncertain that is, root mean square: the square root of ten times what estimates of its kind miss three to eight edges outside,
    /// where the curvature is known from the other side, too. Where this is no smaller than [`jump_before`](Self::jump_before), there is
    /// nothing to be continued, and infinite where less than seven rings of triangles are outside to tell it by; where it is small and
    /// [`reached`](Self::reached) is small as well, no sound surface has that curvature. Along loops whose jump is too small
    /// for [`Options::CONTINUITY_AUTO`](crate::Options::CONTINUITY_AUTO) it is what estimates differ by from each other.
    pub uncertainty: f64,
}

impl CurvatureContinuity {
    /// The [name](super::Attempt::name) of the attempts to continue curvature.
    pub const ATTEMPT: &'static str = crate::solve::CONTINUATION;

    /// In the host's numbers and unit.
    pub(super) fn new(of_loop: &LoopContinuity, region: &RegionMesh, scale: f64) -> Self {
        Self {
            vertex: region.vertex_ids[region.free + of_loop.vertex as usize] as usize,
            vertices: of_loop.vertices,
            asked: match of_loop.asked {
                Blend::Auto => Options::CONTINUITY_AUTO,
                Blend::Part(part) => part,
            },
            reached: of_loop.reached,
            jump_before: of_loop.jump_before[0] / scale,
            largest_jump_before: of_loop.jump_before[1] / scale,
            jump: of_loop.jump[0] / scale,
            largest_jump: of_loop.jump[1] / scale,
            curvature: of_loop.curvature / scale,
            uncertainty: of_loop.uncertainty / scale,
        }
    }
}
