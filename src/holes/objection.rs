//! What speaks against filling some loops, known before the work.

use super::groups::Group;
use super::loops::{BoundaryLoop, LoopKind};
use super::options::{FillOptions, Loops};
use super::outcome::OpenReason;

/// What speaks against filling some loops, known before the work. `asked` is per loop.
pub(super) fn objection(
    options: &FillOptions,
    asked: &[bool],
    group: &Group,
    loops: &[&BoundaryLoop],
) -> Option<OpenReason> {
    let bad = loops.iter().find_map(|boundary| match boundary.kind {
        LoopKind::NonManifold { a, b } => Some(OpenReason::NonManifold { a, b }),
        _ => None,
    });
    if bad.is_some() {
        return bad;
    }
    if let Some(vertex) = shared_vertex(loops) {
        return Some(OpenReason::SharedVertex { vertex });
    }
    if group.is_named {
        return None;
    }
    if !group.loops.iter().all(|&l| asked[l]) {
        return Some(match options.loops {
            Loops::UpTo(_) => OpenReason::TooManyEdges,
            _ => OpenReason::NotAsked,
        });
    }
    let is_outer = |boundary: &&BoundaryLoop| boundary.kind == LoopKind::OuterBoundary;
    loops.iter().any(is_outer).then_some(OpenReason::OuterBoundary)
}

/// A vertex that two of the loops have.
fn shared_vertex(loops: &[&BoundaryLoop]) -> Option<u32> {
    if loops.len() == 1 {
        return None;
    }
    let mut vertices: Vec<u32> = loops.iter().flat_map(|of| of.vertices.iter().copied()).collect();
    vertices.sort_unstable();
    vertices
        .windows(2)
        .find(|pair| pair[0] == pair[1])
        .map(|pair| pair[0])
}
