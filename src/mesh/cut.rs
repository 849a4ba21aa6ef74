//! Cuts along curves of fixed vertices inside the region whose normals are prescribed: both sides meet the curve with that
//! normal, each with a curvature of its own, and neither sees the other. To the discretization they are boundary.

use super::halfedge::HalfEdges;
use super::halfedge::NONE;

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
    let curves = Curves::new(half_edges, (free, boundary), prescribed);
    let mut side = vec![0u32; half_edges.opposite.len()];
    let mut copies = vec![1u32; boundary];
    for (b, around) in curves.around.iter().enumerate() {
        if !matches!(around, Neighbourhood::Closed | Neighbourhood::Open) {
            continue;
        }
        let outgoing = half_edges.outgoing.row(free + b);
        let first = outgoing.iter().position(|&h| curves.is_cut(h));
        let Some(first) = first else { continue };
        // Around a closed ring from a cut on; an open fan begins where it begins.
        let turn = if *around == Neighbourhood::Closed {
            first
        } else {
            0
        };
        let mut current = 0;
        for k in 0..outgoing.len() {
            let h = outgoing[(k + turn) % outgoing.len()];
            if k > 0 && curves.is_cut(h) {
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

/// Where the mesh may be cut.
struct Curves<'a> {
    half_edges: &'a HalfEdges,
    free: usize,
    /// Per boundary vertex; `Other` where the normal is not prescribed.
    around: Vec<Neighbourhood>,
    /// Per boundary vertex where the curve meets the surroundings the only half-edge that is cut, else [`NONE`]. Such a
    /// vertex stays whole: one cut leaves its triangles connected outside.
    only: Vec<u32>,
}

impl<'a> Curves<'a> {
    fn new(
        half_edges: &'a HalfEdges,
        (free, boundary): (usize, usize),
        prescribed: impl Fn(usize) -> bool,
    ) -> Self {
        let around = (free..free + boundary).map(|v| {
            if prescribed(v) {
                Neighbourhood::of(half_edges, v)
            } else {
                Neighbourhood::Other
            }
        });
        let mut curves = Self {
            half_edges,
            free,
            around: around.collect(),
            only: Vec::new(),
        };
        curves.only = (0..boundary)
            .map(|b| match curves.around[b] {
                Neighbourhood::Surrounded => curves.first_to_closed(free + b),
                _ => NONE,
            })
            .collect();
        curves
    }

    /// What stands around a vertex; `None` of a free vertex or one outside.
    fn at(&self, v: u32) -> Option<Neighbourhood> {
        let b = (v as usize).checked_sub(self.free)?;
        self.around.get(b).copied()
    }

    /// Whether `h` lies between two triangles of the region.
    fn is_inside(&self, h: u32) -> bool {
        let o = self.half_edges.opposite[h as usize];
        o != NONE && self.half_edges.in_region(h) && self.half_edges.in_region(o)
    }

    /// The first half-edge inside the region that leads from `v` to a vertex with a closed ring, or [`NONE`].
    fn first_to_closed(&self, v: usize) -> u32 {
        let leads = |h: &&u32| {
            self.is_inside(**h) && self.at(self.half_edges.target(**h)) == Some(Neighbourhood::Closed)
        };
        let mut outgoing = self.half_edges.outgoing.row(v).iter();
        outgoing.find(leads).copied().unwrap_or(NONE)
    }

    fn is_cut(&self, h: u32) -> bool {
        let (origin, target) = (self.half_edges.origin(h), self.half_edges.target(h));
        let is_only = |v: u32, h: u32| self.only[v as usize - self.free] == h;
        self.is_inside(h)
            && match (self.at(origin), self.at(target)) {
                (Some(Neighbourhood::Closed), Some(Neighbourhood::Closed | Neighbourhood::Open))
                | (Some(Neighbourhood::Open), Some(Neighbourhood::Closed)) => true,
                (Some(Neighbourhood::Surrounded), Some(Neighbourhood::Closed)) => is_only(origin, h),
                (Some(Neighbourhood::Closed), Some(Neighbourhood::Surrounded)) => {
                    is_only(target, self.half_edges.opposite[h as usize])
                }
                _ => false,
            }
    }
}

/// What stands around a boundary vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Neighbourhood {
    /// One closed ring of region triangles.
    Closed,
    /// One open fan of region triangles, and nothing else.
    Open,
    /// One fan of region triangles, closed to a ring by the outside.
    Surrounded,
    /// Anything else; or it does not matter.
    Other,
}

impl Neighbourhood {
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
            (0, false) => Neighbourhood::Closed,
            (1, true) if outgoing.iter().all(|&h| inside(h)) => Neighbourhood::Open,
            (1, false) => Neighbourhood::Surrounded,
            _ => Neighbourhood::Other,
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
