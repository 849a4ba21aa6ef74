//! The fixed vertices of the region along the curves that they form.

use crate::mesh::{Region, Rings};

/// Fixed vertices one after the other, by their boundary numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Chain {
    /// Each fixed vertex of the region stands in one chain.
    pub vertices: Vec<u32>,
    /// The last one is followed by the first.
    pub is_closed: bool,
    /// The region lies on both sides.
    pub is_two_sided: bool,
}

/// The chains of a region: its boundary loops, then the curves of fixed vertices inside it that are not cut, down to single
/// vertices. Where curves branch, and where a loop touches itself, a chain ends.
pub(crate) fn chains(region: &Region, rings: &Rings) -> Vec<Chain> {
    let boundary = rings.boundary();
    let mut walk = Walk {
        next: vec![Vec::new(); boundary],
        is_taken: vec![false; boundary],
    };
    let local = |v: u32| v as usize - region.free;
    for &h in &rings.boundary_half_edges {
        let (a, b) = (region.half_edges.origin(h), region.half_edges.target(h));
        walk.next[local(a)].push(local(b) as u32);
    }
    let mut chains = Vec::new();
    for b in (0..boundary).filter(|&b| !rings.closed[b]) {
        chains.extend(walk.from(b, false));
    }
    for b in (0..boundary).filter(|&b| rings.closed[b]) {
        let fixed = rings.boundary_ring(b).iter().filter(|&&j| !region.is_free(j));
        let inside = fixed.map(|&j| local(j)).filter(|&j| rings.closed[j]);
        walk.next[b] = inside.map(|j| j as u32).collect();
    }
    // From the ends of curves and where they branch, at last around those without.
    for is_ring in [false, true] {
        for b in (0..boundary).filter(|&b| rings.closed[b]) {
            if (walk.next[b].len() == 2) == is_ring {
                chains.extend(walk.from(b, true));
            }
        }
    }
    chains
}

/// A walk along edges that takes no vertex twice.
struct Walk {
    next: Vec<Vec<u32>>,
    is_taken: Vec<bool>,
}

impl Walk {
    fn from(&mut self, first: usize, is_two_sided: bool) -> Option<Chain> {
        if std::mem::replace(&mut self.is_taken[first], true) {
            return None;
        }
        let mut vertices = vec![first as u32];
        let mut at = first;
        while let Some(&next) = self.next[at].iter().find(|&&n| !self.is_taken[n as usize]) {
            at = next as usize;
            self.is_taken[at] = true;
            vertices.push(next);
        }
        Some(Chain {
            is_closed: vertices.len() > 2 && self.next[at].contains(&(first as u32)),
            vertices,
            is_two_sided,
        })
    }
}
