//! The half-edges of a mesh, sound or not: which lie side by side, and which bound a gap.

use crate::mesh::halfedge::{next, previous};
use crate::mesh::input;
use crate::mesh::rows::Rows;
use crate::support::error::Error;

/// No half-edge on the other side: the boundary.
pub(super) const BOUNDARY: u32 = u32::MAX;
/// Three triangles or more at the edge, or two in the same direction.
const NON_MANIFOLD: u32 = u32::MAX - 1;

/// Which half-edges lie side by side, and the triangles at each vertex.
pub(crate) struct Links<'a> {
    pub(crate) triangles: &'a [[u32; 3]],
    /// The half-edge across, [`BOUNDARY`], or more than one.
    pub(crate) opposite: Vec<u32>,
    /// The half-edges that start at each vertex, ascending.
    pub(crate) outgoing: Rows<u32>,
}

impl<'a> Links<'a> {
    pub(crate) fn new(vertices: usize, triangles: &'a [[u32; 3]]) -> Result<Self, Error> {
        input::check(vertices, triangles)?;
        let corners = (0..).zip(triangles.iter().flatten());
        let mut links = Self {
            triangles,
            opposite: vec![BOUNDARY; 3 * triangles.len()],
            outgoing: Rows::collect(vertices, corners.map(|(h, &v)| (v, h))),
        };
        links.pair();
        Ok(links)
    }

    /// Pairs half-edges: per vertex the edges to larger numbers, in both directions, sorted.
    fn pair(&mut self) {
        let mut edges: Vec<[u32; 2]> = Vec::new();
        for v in 0..self.outgoing.len() as u32 {
            edges.clear();
            for &h in self.outgoing.row(v as usize) {
                if repeats(&self.triangles[h as usize / 3]) {
                    self.opposite[h as usize] = NON_MANIFOLD;
                    continue;
                }
                for (other, half_edge) in [(self.origin(next(h)), h), (self.origin(previous(h)), previous(h))]
                {
                    if other > v {
                        edges.push([other, half_edge]);
                    }
                }
            }
            edges.sort_unstable();
            for same in edges.chunk_by(|a, b| a[0] == b[0]) {
                match *same {
                    [_] => {}
                    [[_, g], [_, h]] if (self.origin(g) == v) != (self.origin(h) == v) => {
                        self.opposite[g as usize] = h;
                        self.opposite[h as usize] = g;
                    }
                    _ => same
                        .iter()
                        .for_each(|&[_, h]| self.opposite[h as usize] = NON_MANIFOLD),
                }
            }
        }
    }

    /// The half-edges that start at a vertex; of one that is not the mesh's none.
    pub(super) fn at(&self, v: u32) -> &[u32] {
        match (v as usize) < self.outgoing.len() {
            true => self.outgoing.row(v as usize),
            false => &[],
        }
    }

    #[inline]
    pub(crate) fn origin(&self, h: u32) -> u32 {
        self.triangles[h as usize / 3][h as usize % 3]
    }

    /// The half-edge across an edge with two consistent triangles.
    #[inline]
    pub(crate) fn across(&self, h: u32) -> Option<u32> {
        Some(self.opposite[h as usize]).filter(|&o| o < NON_MANIFOLD)
    }

    /// That every edge has one triangle, or two that run through it in opposite directions.
    ///
    /// # Errors
    /// For the first half-edge that is not so: [`Error::RepeatedIndex`], [`Error::InconsistentOrientation`], [`Error::NonManifoldEdge`].
    pub(crate) fn check(&self) -> Result<(), Error> {
        let is_bad = |h: &u32| self.opposite[*h as usize] == NON_MANIFOLD;
        let Some(h) = (0..self.opposite.len() as u32).find(is_bad) else {
            return Ok(());
        };
        let triangle = self.triangles[h as usize / 3];
        if repeats(&triangle) {
            let vertex = if triangle[1] == triangle[2] {
                triangle[1]
            } else {
                triangle[0]
            };
            return Err(Error::RepeatedIndex {
                triangle: h as usize / 3,
                vertex: vertex as usize,
            });
        }
        let (u, v) = (self.origin(h), self.origin(next(h)));
        let (a, b) = (u.min(v) as usize, u.max(v) as usize);
        let along = |from: u32, to: u32| {
            let is_along = move |g: &&u32| self.origin(next(**g)) == to;
            self.at(from).iter().filter(is_along).map(|g| *g as usize / 3)
        };
        let mut beside: Vec<usize> = along(u, v).chain(along(v, u)).collect();
        beside.sort_unstable();
        let triangle = beside[beside.len() - 1];
        Err(match self.is_inconsistent(u, v) {
            true => Error::InconsistentOrientation {
                a,
                b,
                triangle,
                other: beside[0],
            },
            false => Error::NonManifoldEdge { a, b, triangle },
        })
    }

    /// Whether a bad edge has two triangles, which run through it in the same direction.
    pub(super) fn is_inconsistent(&self, a: u32, b: u32) -> bool {
        let of = |v: u32, end: u32| {
            let is_along = move |h: &&u32| self.origin(next(**h)) == end;
            self.at(v).iter().filter(is_along)
        };
        let is_sound = |h: &u32| !repeats(&self.triangles[*h as usize / 3]);
        let [along, back] = [of(a, b).count(), of(b, a).count()];
        along.max(back) == 2 && along.min(back) == 0 && of(a, b).chain(of(b, a)).all(is_sound)
    }

    /// Whether a half-edge has no triangle on the other side.
    pub(super) fn is_boundary(&self, h: u32) -> bool {
        self.opposite[h as usize] == BOUNDARY
    }

    /// The boundary half-edge after `h` along the gap: around `h`'s origin, through its fan. `Err`: a bad edge. `visit` sees
    /// the half-edges of the fan that end at the origin.
    pub(super) fn follow(&self, h: u32, mut visit: impl FnMut(u32)) -> Result<u32, u32> {
        let mut g = previous(h);
        loop {
            visit(g);
            match self.opposite[g as usize] {
                BOUNDARY => return Ok(g),
                NON_MANIFOLD => return Err(g),
                o => g = previous(o),
            }
        }
    }

    /// The same, but where the triangles at `h`'s origin are two fans, on to the other fan: the gap between them ends there.
    /// With more fans nobody can tell which ones are neighbours.
    pub(super) fn follow_gap(&self, h: u32) -> Result<u32, u32> {
        let along = self.follow(h, |_| {})?;
        let mut others = self
            .at(self.origin(h))
            .iter()
            .filter(|&&g| g != h && self.opposite[g as usize] == BOUNDARY);
        match (others.next(), others.next()) {
            (Some(&other), None) => Ok(self.follow(other, |_| {}).unwrap_or(along)),
            _ => Ok(along),
        }
    }
}

fn repeats([a, b, c]: &[u32; 3]) -> bool {
    a == b || b == c || c == a
}
