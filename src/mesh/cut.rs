//! Cuts along curves of fixed vertices inside the region whose normals are prescribed: both sides meet the curve with that
//! normal, each with a curvature of its own, and neither sees the other. To the discretization they are boundary.

use super::NONE;
use super::halfedge::HalfEdges;

/// Half-edges whose boundary vertices have a copy for each side of the curves through them.
#[derive(Debug)]
pub(super) struct Cut {
    /// The triangles in the new local numbers.
    pub triangles: Vec<[u32; 3]>,
    /// The caller's number of each local vertex; copies stand together.
    pub vertex_ids: Vec<u32>,
    /// How many boundary vertices there are now.
    pub boundary: usize,
}

/// Cuts between neighbours that are both `prescribed` (by local number), and at least one of which has a closed ring of
/// region triangles. `None`: there is nothing to cut.
pub(super) fn cut(
    half_edges: &HalfEdges,
    (free, boundary): (usize, usize),
    vertex_ids: &[u32],
    prescribed: impl Fn(usize) -> bool,
) -> Option<Cut> {
    let fans: Vec<Fans> = (free..free + boundary)
        .map(|v| {
            if prescribed(v) {
                Fans::of(half_edges, v)
            } else {
                Fans::Other
            }
        })
        .collect();
    let of = |v: u32| (v as usize).checked_sub(free).and_then(|b| fans.get(b)).copied();
    // Where the curve meets the surroundings, the vertex stays whole: one cut leaves its triangles connected outside.
    let only: Vec<u32> = (0..boundary)
        .map(|b| match fans[b] {
            Fans::Surrounded => first_to_closed(half_edges, free + b, of),
            _ => NONE,
        })
        .collect();
    let is_cut = |h: u32| {
        let o = half_edges.opposite[h as usize];
        if o == NONE || !half_edges.in_region(h) || !half_edges.in_region(o) {
            return false;
        }
        let chosen = |h: u32| only[half_edges.origin(h) as usize - free] == h;
        match (of(half_edges.origin(h)), of(half_edges.target(h))) {
            (Some(Fans::Closed), Some(Fans::Closed | Fans::Open))
            | (Some(Fans::Open), Some(Fans::Closed)) => true,
            (Some(Fans::Surrounded), Some(Fans::Closed)) => chosen(h),
            (Some(Fans::Closed), Some(Fans::Surrounded)) => chosen(o),
            _ => false,
        }
    };
    let mut side = vec![0u32; half_edges.opposite.len()];
    let mut copies = vec![1u32; boundary];
    for b in 0..boundary {
        if !matches!(fans[b], Fans::Closed | Fans::Open) {
            continue;
        }
        let outgoing = half_edges.outgoing.row(free + b);
        let first = outgoing.iter().position(|&h| is_cut(h));
        let Some(first) = first else { continue };
        // Around a closed ring from a cut on; an open fan begins where it begins.
        let turn = if fans[b] == Fans::Closed { first } else { 0 };
        let mut current = 0;
        for k in 0..outgoing.len() {
            let h = outgoing[(k + turn) % outgoing.len()];
            if k > 0 && is_cut(h) {
                current += 1;
            }
            side[h as usize] = current;
        }
        copies[b] = current + 1;
    }
    if copies.iter().all(|&c| c == 1) {
        return None;
    }
    Some(renumbered(
        half_edges,
        (free, boundary),
        vertex_ids,
        &side,
        &copies,
    ))
}

/// The first half-edge inside the region that leads from `v` to a vertex with a closed ring, or [`NONE`].
fn first_to_closed(half_edges: &HalfEdges, v: usize, of: impl Fn(u32) -> Option<Fans>) -> u32 {
    let leads = |&&h: &&u32| {
        let o = half_edges.opposite[h as usize];
        half_edges.in_region(h) && half_edges.in_region(o) && of(half_edges.target(h)) == Some(Fans::Closed)
    };
    half_edges
        .outgoing
        .row(v)
        .iter()
        .find(leads)
        .copied()
        .unwrap_or(NONE)
}

/// What stands around a boundary vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fans {
    /// One closed ring of region triangles.
    Closed,
    /// One open fan of region triangles, and nothing else.
    Open,
    /// One fan of region triangles, closed to a ring by the outside.
    Surrounded,
    /// Anything else; or it does not matter.
    Other,
}

impl Fans {
    fn of(half_edges: &HalfEdges, v: usize) -> Self {
        let outgoing = half_edges.outgoing.row(v);
        let before = |h: u32| half_edges.opposite[h as usize];
        let inside = |h: u32| h != NONE && half_edges.in_region(h);
        let begins = outgoing
            .iter()
            .filter(|&&h| inside(h) && !inside(before(h)))
            .count();
        let is_open = outgoing.iter().any(|&h| before(h) == NONE);
        match (begins, is_open) {
            (0, false) => Fans::Closed,
            (1, true) if outgoing.iter().all(|&h| inside(h)) => Fans::Open,
            (1, false) => Fans::Surrounded,
            _ => Fans::Other,
        }
    }
}

fn renumbered(
    half_edges: &HalfEdges,
    (free, boundary): (usize, usize),
    vertex_ids: &[u32],
    side: &[u32],
    copies: &[u32],
) -> Cut {
    let mut new_ids = vertex_ids[..free].to_vec();
    let mut first = Vec::with_capacity(vertex_ids.len());
    first.extend(0..free as u32);
    for (b, &count) in copies.iter().enumerate() {
        first.push(new_ids.len() as u32);
        new_ids.extend(std::iter::repeat_n(vertex_ids[free + b], count as usize));
    }
    let new_boundary = new_ids.len() - free;
    for &v in &vertex_ids[free + boundary..] {
        first.push(new_ids.len() as u32);
        new_ids.push(v);
    }
    let corner = |h: usize| first[half_edges.origin(h as u32) as usize] + side[h];
    let triangles = (0..half_edges.triangles.len()).map(|t| [3 * t, 3 * t + 1, 3 * t + 2].map(corner));
    Cut {
        triangles: triangles.collect(),
        vertex_ids: new_ids,
        boundary: new_boundary,
    }
}
