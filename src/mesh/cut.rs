//! Cuts along curves of fixed vertices inside the region whose normals are prescribed: both sides meet the curve with that
//! normal, each with a curvature of its own, and neither sees the other. To the discretization they are border.

use super::NONE;
use super::halfedge::HalfEdges;

/// Half-edges whose border vertices have a copy for each side of the curves through them.
#[derive(Debug)]
pub(super) struct Cut {
    /// The triangles in the new local numbers.
    pub triangles: Vec<[u32; 3]>,
    /// The caller's number of each local vertex; copies stand together.
    pub vertex_ids: Vec<u32>,
    /// How many border vertices there are now.
    pub border: usize,
}

/// Cuts between neighbours that are both `prescribed` (by local number), and at least one of which has a closed ring of
/// region triangles. `None`: there is nothing to cut.
pub(super) fn cut(
    half_edges: &HalfEdges,
    (free, border): (usize, usize),
    vertex_ids: &[u32],
    prescribed: impl Fn(usize) -> bool,
) -> Option<Cut> {
    let fans: Vec<Fans> = (free..free + border)
        .map(|v| {
            if prescribed(v) {
                Fans::of(half_edges, v)
            } else {
                Fans::Several
            }
        })
        .collect();
    let of = |v: u32| (v as usize).checked_sub(free).and_then(|b| fans.get(b));
    let is_cut = |h: u32| {
        let o = half_edges.opposite[h as usize];
        let ends = (of(half_edges.origin(h)), of(half_edges.target(h)));
        let joined = matches!(
            ends,
            (Some(Fans::Closed), Some(Fans::Closed | Fans::Open)) | (Some(Fans::Open), Some(Fans::Closed))
        );
        joined && half_edges.in_region(h) && o != NONE && half_edges.in_region(o)
    };
    let mut side = vec![0u32; half_edges.opposite.len()];
    let mut copies = vec![1u32; border];
    for b in 0..border {
        let spokes = half_edges.spokes(free + b);
        let first = spokes.iter().position(|&h| is_cut(h));
        let Some(first) = first else { continue };
        // Around a closed ring from a cut on; an open fan begins where it begins.
        let turn = if fans[b] == Fans::Closed { first } else { 0 };
        let mut current = 0;
        for k in 0..spokes.len() {
            let h = spokes[(k + turn) % spokes.len()];
            if k > 0 && is_cut(h) {
                current += 1;
            }
            side[h as usize] = if half_edges.in_region(h) { current } else { 0 };
        }
        copies[b] = current + 1;
    }
    if copies.iter().all(|&c| c == 1) {
        return None;
    }
    Some(renumbered(half_edges, (free, border), vertex_ids, &side, &copies))
}

/// How the region's triangles stand around a border vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fans {
    /// In one closed ring.
    Closed,
    /// In one run, the first of the spokes.
    Open,
    /// In several runs; or it does not matter.
    Several,
}

impl Fans {
    fn of(half_edges: &HalfEdges, v: usize) -> Self {
        let begins = |&&h: &&u32| {
            let o = half_edges.opposite[h as usize];
            half_edges.in_region(h) && (o == NONE || !half_edges.in_region(o))
        };
        let spokes = half_edges.spokes(v);
        match spokes.iter().filter(begins).count() {
            0 => Fans::Closed,
            1 if begins(&&spokes[0]) => Fans::Open,
            _ => Fans::Several,
        }
    }
}

fn renumbered(
    half_edges: &HalfEdges,
    (free, border): (usize, usize),
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
    let new_border = new_ids.len() - free;
    for &v in &vertex_ids[free + border..] {
        first.push(new_ids.len() as u32);
        new_ids.push(v);
    }
    let corner = |h: usize| first[half_edges.origin(h as u32) as usize] + side[h];
    let triangles = (0..half_edges.triangles.len()).map(|t| [3 * t, 3 * t + 1, 3 * t + 2].map(corner));
    Cut {
        triangles: triangles.collect(),
        vertex_ids: new_ids,
        border: new_border,
    }
}
