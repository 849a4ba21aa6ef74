//! What speaks against filling some loops, known before the work.

use crate::holes::groups::LoopGroup;
use crate::holes::loops::{BoundaryLoop, LoopKind};
use crate::holes::options::{FillOptions, Loops};
use crate::holes::outcome::OpenReason;

/// What speaks against filling some loops, known before the work. `asked` is per loop.
pub(super) fn objection(
    options: &FillOptions,
    asked: &[bool],
    group: &LoopGroup,
    (loops, positions): (&[&BoundaryLoop], &[[f64; 3]]),
) -> Option<OpenReason> {
    let bad = loops.iter().find_map(|boundary| match boundary.kind {
        LoopKind::NonManifold { a, b } => Some(OpenReason::NonManifold { a, b }),
        LoopKind::Inconsistent { a, b } => Some(OpenReason::Inconsistent { a, b }),
        _ => None,
    });
    if bad.is_some() {
        return bad;
    }
    if let Some(vertex) = shared_vertex(loops, positions) {
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
    let is_outer = |boundary: &&&BoundaryLoop| boundary.kind == LoopKind::OuterBoundary;
    let outer = loops.iter().find(is_outer)?;
    Some(match outer.hangs_at {
        Some(vertex) => OpenReason::Hanging { vertex },
        None => OpenReason::OuterBoundary,
    })
}

/// A vertex that two of the loops have, or two copies of it.
fn shared_vertex(loops: &[&BoundaryLoop], positions: &[[f64; 3]]) -> Option<u32> {
    if loops.len() == 1 {
        return None;
    }
    let touching = loops.iter().flat_map(|of| of.touching.iter().copied());
    let place = |v: u32| positions[v as usize].map(|c| (c + 0.0).to_bits());
    let mut vertices: Vec<([u64; 3], u32)> = touching.map(|v| (place(v), v)).collect();
    vertices.sort_unstable();
    let pair = vertices.windows(2).find(|pair| pair[0].0 == pair[1].0);
    pair.map(|pair| pair[0].1)
}
