//! A triangle mesh whose edges can be split anywhere; the surface stays where it is.

use nalgebra::Vector3;

use crate::holes::Parents;
use crate::mesh::NONE;
use crate::mesh::half_edge_edits;
use crate::mesh::halfedge::{next, previous};

/// Half-edge `3 t + k` runs from corner `k` of triangle `t` to the next one.
pub(super) struct Sheet {
    pub(super) x: Vec<Vector3<f64>>,
    /// Of which vertices of the mesh given each one consists.
    pub(super) parents: Vec<Parents>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// The half-edge across, or [`NONE`].
    opposite: Vec<u32>,
    /// The triangle of the mesh given that each one is a part of.
    pub(super) source: Vec<u32>,
}

impl Sheet {
    pub(super) fn new(x: Vec<Vector3<f64>>, triangles: Vec<[u32; 3]>, opposite: Vec<u32>) -> Self {
        let own = |v: u32| Parents {
            vertices: [v; 3],
            weights: [1.0, 0.0, 0.0],
        };
        Self {
            parents: (0..x.len() as u32).map(own).collect(),
            source: (0..triangles.len() as u32).collect(),
            x,
            triangles,
            opposite,
        }
    }

    #[inline]
    pub(super) fn origin(&self, h: u32) -> u32 {
        self.triangles[h as usize / 3][h as usize % 3]
    }

    #[inline]
    pub(super) fn target(&self, h: u32) -> u32 {
        self.origin(next(h))
    }

    #[inline]
    pub(super) fn across(&self, h: u32) -> u32 {
        self.opposite[h as usize]
    }

    pub(super) fn squared_length(&self, h: u32) -> f64 {
        (self.x[self.target(h) as usize] - self.x[self.origin(h) as usize]).norm_squared()
    }

    /// The longest half-edge of a triangle; of equal ones that between the largest numbers, so that both triangles at an edge agree.
    pub(super) fn longest(&self, t: u32) -> u32 {
        let key = |h: u32| {
            let (a, b) = (self.origin(h), self.target(h));
            (self.squared_length(h), a.max(b), a.min(b))
        };
        let order = |g: &u32, h: &u32| {
            let (g, h) = (key(*g), key(*h));
            g.0.total_cmp(&h.0).then((g.1, g.2).cmp(&(h.1, h.2)))
        };
        (3 * t..3 * t + 3).max_by(order).unwrap_or(3 * t)
    }

    /// The half-edges that start where `h` does, as far as their triangles hang together there. False if that is on the boundary.
    pub(super) fn fan(&self, h: u32, mut visit: impl FnMut(u32)) -> bool {
        let mut g = h;
        loop {
            visit(g);
            g = self.across(previous(g));
            if g == h {
                return true;
            }
            if g == NONE {
                break;
            }
        }
        g = self.across(h);
        while g != NONE {
            visit(next(g));
            g = self.across(next(g));
        }
        false
    }

    /// Whether a triangle is still there.
    pub(super) fn is_there(&self, t: u32) -> bool {
        self.triangles[t as usize][0] != NONE
    }

    /// Cross product of a triangle's sides, with another place of one vertex.
    pub(super) fn cross(&self, t: u32, moved: u32, to: &Vector3<f64>) -> Vector3<f64> {
        let at = |v: u32| if v == moved { *to } else { self.x[v as usize] };
        let [a, b, c] = self.triangles[t as usize].map(at);
        (b - a).cross(&(c - a))
    }

    /// Whether the surface stays a manifold if the vertex where `h` starts moves onto that where it ends. Both triangles at `h` have to be there.
    pub(super) fn can_collapse(&self, h: u32) -> bool {
        let o = self.across(h);
        if o == NONE {
            return false;
        }
        let (b, mut around, mut common) = (self.target(h), Vec::new(), 0);
        let is_inside = self.fan(h, |g| around.push(self.target(g)));
        self.fan(o, |g| {
            common += usize::from(around.contains(&self.target(g)));
        });
        // At a boundary the last neighbour ends no half-edge that starts there.
        let valence = |h: u32| {
            let mut count = 0;
            let is_inside = self.fan(h, |_| count += 1);
            count + usize::from(!is_inside)
        };
        let apexes = [previous(h), previous(o)];
        is_inside
            && common == 2
            && around.len() > 3
            && around.contains(&b)
            && apexes.iter().all(|&g| valence(g) > 3)
    }

    /// Whether two vertices have an edge; a half-edge that starts at the first is known.
    fn are_neighbours(&self, h: u32, v: u32) -> bool {
        let mut found = false;
        self.fan(h, |g| {
            found |= self.target(g) == v || self.origin(previous(g)) == v
        });
        found
    }

    /// Turns an edge to the other two corners of its triangles; false if these have one already.
    pub(super) fn flip(&mut self, h: u32) -> bool {
        let opposite_corner = self.origin(previous(self.across(h)));
        let can_be = !self.are_neighbours(previous(h), opposite_corner);
        if can_be {
            half_edge_edits::flip(&mut self.triangles, &mut self.opposite, h);
        }
        can_be
    }

    /// Moves the vertex where `h` starts onto that where it ends.
    pub(super) fn collapse(&mut self, h: u32) {
        let mut outgoing = Vec::new();
        self.fan(h, |g| outgoing.push(g));
        half_edge_edits::collapse(&mut self.triangles, &mut self.opposite, h, &outgoing);
    }

    /// Moves the vertex where `h` starts by a fraction of the way along `h`.
    pub(super) fn slide(&mut self, h: u32, t: f64) {
        let [a, b] = [self.origin(h), self.target(h)].map(|v| v as usize);
        self.x[a] = self.x[a] + (self.x[b] - self.x[a]) * t;
        self.parents[a] = between(&self.parents[a], &self.parents[b], t);
    }

    fn link(&mut self, g: u32, h: u32) {
        half_edge_edits::link(&mut self.opposite, g, h);
    }

    /// Splits an edge at the fraction `t` of the way along `h`; the new vertex. `h` then ends there, and the half-edge behind it is the first of the
    /// last triangle but one, or of the last at the boundary.
    pub(super) fn split(&mut self, h: u32, t: f64) -> u32 {
        let (a, b, o) = (self.origin(h), self.target(h), self.across(h));
        let m = self.x.len() as u32;
        let (p, q) = (self.x[a as usize], self.x[b as usize]);
        self.x.push(p + (q - p) * t);
        self.parents
            .push(between(&self.parents[a as usize], &self.parents[b as usize], t));
        let behind = self.halve(h, m);
        if o == NONE {
            self.link(behind, NONE);
            self.opposite[h as usize] = NONE;
            return m;
        }
        let before = self.halve(o, m);
        self.link(h, before);
        self.link(behind, o);
        m
    }

    /// Divides the triangle of `h` at a vertex on `h`: the half-edge from that vertex on, in a new triangle.
    fn halve(&mut self, h: u32, m: u32) -> u32 {
        let (b, c, bc) = (self.target(h), self.origin(previous(h)), self.across(next(h)));
        let t = self.triangles.len() as u32;
        self.triangles.push([m, b, c]);
        self.source.push(self.source[h as usize / 3]);
        self.opposite.extend([NONE; 3]);
        self.triangles[h as usize / 3][next(h) as usize % 3] = m;
        self.link(3 * t + 1, bc);
        self.link(3 * t + 2, next(h));
        3 * t
    }
}

/// The place at a fraction of the way from one to the other, on one triangle.
fn between(a: &Parents, b: &Parents, t: f64) -> Parents {
    let mut of = Parents {
        vertices: [NONE; 3],
        weights: [0.0; 3],
    };
    let mut count = 0;
    for (from, share) in [(a, 1.0 - t), (b, t)] {
        for (v, w) in from.vertices.into_iter().zip(from.weights) {
            if w == 0.0 {
                continue;
            }
            let known = of.vertices[..count].iter().position(|&u| u == v);
            let k = known.unwrap_or(count.min(2));
            count = count.max(k + 1);
            of.vertices[k] = v;
            of.weights[k] += w * share;
        }
    }
    for k in count..3 {
        of.vertices[k] = of.vertices[0];
    }
    of
}
