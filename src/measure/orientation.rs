//! Which way the triangles of a mesh face: where neighbours disagree, and which of them have to be turned.

use crate::fairing::Coincident;
use crate::mesh::NONE;
use crate::mesh::halfedge::{next, previous};
use crate::mesh::input;
use crate::mesh::places::places;
use crate::support::error::Error;

/// An edge that its two triangles run through in the same direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct InconsistentEdge {
    /// Its ends in that direction, as the first triangle names them.
    pub vertices: [u32; 2],
    /// The triangles, ascending.
    pub triangles: [u32; 2],
}

/// The edges with exactly two triangles that run through them in the same direction, in the order of these triangles: one of the two faces
/// the wrong way. `positions` is #V by 3, `triangles` #T by 3. Boundary edges with coincident ends are one edge.
///
/// ```
/// use fairmesh::{Coincident, inconsistent_edges};
/// // A square of two triangles, of which one is turned.
/// let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
/// let found = inconsistent_edges(&positions, &[[0, 1, 2], [0, 3, 2]], Coincident::default())?;
/// assert_eq!(found.len(), 1);
/// assert_eq!((found[0].vertices, found[0].triangles), ([2, 0], [0, 1]));
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// Those of [`boundary_loops_joined`](crate::boundary_loops_joined).
pub fn inconsistent_edges(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    coincident: Coincident,
) -> Result<Vec<InconsistentEdge>, Error> {
    let pairs = Pairs::new(positions, triangles, coincident)?;
    let inconsistent = |h: u32| {
        let other = pairs.across[h as usize];
        let is_first = other != NONE && h / 3 < other / 3;
        (is_first && pairs.is_same_way[h as usize]).then(|| InconsistentEdge {
            vertices: [origin(triangles, h), origin(triangles, next(h))],
            triangles: [h / 3, other / 3],
        })
    };
    Ok((0..3 * triangles.len() as u32).filter_map(inconsistent).collect())
}

/// The triangles to turn around (by exchanging two of their corners) so that those that hang together by edges face the same way: of each
/// component as few as possible, ascending. Where that are half of a component, a closed one comes to face outwards, and of an open one the first triangle stays. Edges
/// with three triangles or more connect nothing.
///
/// ```
/// use fairmesh::{Coincident, triangles_to_turn};
/// // A strip of three triangles, of which the middle one is turned.
/// let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [2.0, 0.0, 0.0]];
/// let mut triangles = [[3, 0, 2], [0, 2, 1], [1, 4, 2]];
/// let turned = triangles_to_turn(&positions, &triangles, Coincident::default())?;
/// assert_eq!(turned, [1]);
/// turned.iter().for_each(|&t| triangles[t as usize].swap(1, 2));
/// assert!(triangles_to_turn(&positions, &triangles, Coincident::default())?.is_empty());
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// Those of [`boundary_loops_joined`](crate::boundary_loops_joined), and [`Error::NotOrientable`] for a component that has one side only, as a Moebius strip.
pub fn triangles_to_turn(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    coincident: Coincident,
) -> Result<Vec<u32>, Error> {
    let pairs = Pairs::new(positions, triangles, coincident)?;
    let mut against = vec![None; triangles.len()];
    let mut turned = Vec::new();
    for first in 0..triangles.len() as u32 {
        if against[first as usize].is_some() {
            continue;
        }
        let component = pairs.component(first, &mut against)?;
        let is_against = |&t: &u32| against[t as usize] == Some(true);
        let count = component.iter().filter(|t| is_against(t)).count();
        let turns_those = match (2 * count).cmp(&component.len()) {
            std::cmp::Ordering::Less => true,
            std::cmp::Ordering::Greater => false,
            std::cmp::Ordering::Equal => {
                !pairs.is_closed(&component) || volume(positions, triangles, &component, &against) >= 0.0
            }
        };
        turned.extend(component.iter().copied().filter(|t| is_against(t) == turns_those));
    }
    turned.sort_unstable();
    Ok(turned)
}

fn origin(triangles: &[[u32; 3]], h: u32) -> u32 {
    triangles[h as usize / 3][h as usize % 3]
}

/// Half-edges that are the two of an edge, whichever way they run.
struct Pairs {
    /// Per half-edge the other one of its edge; none where it has no other, or several.
    across: Vec<u32>,
    /// Per half-edge whether the other one runs in the same direction.
    is_same_way: Vec<bool>,
}

impl Pairs {
    fn new(positions: &[[f64; 3]], triangles: &[[u32; 3]], coincident: Coincident) -> Result<Self, Error> {
        coincident.validate()?;
        input::check(positions.len(), triangles)?;
        let count = 3 * triangles.len();
        let mut pairs = Self {
            across: vec![NONE; count],
            is_same_way: vec![false; count],
        };
        let ends = |h: u32| [origin(triangles, h), origin(triangles, next(h))];
        let alone = pairs.pair(0..count as u32, ends, |_, _| true);
        if let Some(within) = coincident.within() {
            let mut open: Vec<u32> = alone.iter().flat_map(|&h| ends(h)).collect();
            open.sort_unstable();
            open.dedup();
            if let Some(place) = places(positions, &open, within) {
                let of = |v: u32| open.binary_search(&v).map_or(v, |i| open[place[i] as usize]);
                // Triangles that lie on each other are no neighbours.
                let apex = |h: u32| positions[origin(triangles, previous(h)) as usize];
                pairs.pair(alone.into_iter(), |h| ends(h).map(of), |g, h| apex(g) != apex(h));
            }
        }
        Ok(pairs)
    }

    /// Pairs those of some half-edges that are two at an edge and may be; those that are alone there.
    fn pair(
        &mut self,
        among: impl Iterator<Item = u32>,
        ends: impl Fn(u32) -> [u32; 2],
        may: impl Fn(u32, u32) -> bool,
    ) -> Vec<u32> {
        let keyed = |h: u32| {
            let [a, b] = ends(h);
            (a != b).then_some(([a.min(b), a.max(b)], h))
        };
        let mut edges: Vec<([u32; 2], u32)> = among.filter_map(keyed).collect();
        edges.sort_unstable();
        let mut alone = Vec::new();
        for same in edges.chunk_by(|a, b| a.0 == b.0) {
            match *same {
                [(_, h)] => alone.push(h),
                [(_, g), (_, h)] if g / 3 != h / 3 && may(g, h) => {
                    let is_same_way = ends(g) == ends(h);
                    for (one, other) in [(g, h), (h, g)] {
                        self.across[one as usize] = other;
                        self.is_same_way[one as usize] = is_same_way;
                    }
                }
                _ => {}
            }
        }
        alone
    }

    /// The triangles that hang together with one; `against` becomes whether each faces the other way than the first.
    fn component(&self, first: u32, against: &mut [Option<bool>]) -> Result<Vec<u32>, Error> {
        let mut found = vec![first];
        against[first as usize] = Some(false);
        let mut done = 0;
        while done < found.len() {
            let t = found[done];
            done += 1;
            let own = against[t as usize] == Some(true);
            for h in 3 * t..3 * t + 3 {
                let other = self.across[h as usize];
                if other == NONE {
                    continue;
                }
                let is_against = own != self.is_same_way[h as usize];
                match &mut against[other as usize / 3] {
                    slot @ None => {
                        *slot = Some(is_against);
                        found.push(other / 3);
                    }
                    Some(known) if *known != is_against => {
                        let triangle = other as usize / 3;
                        return Err(Error::NotOrientable { triangle });
                    }
                    Some(_) => {}
                }
            }
        }
        Ok(found)
    }

    fn is_closed(&self, component: &[u32]) -> bool {
        let mut half_edges = component.iter().flat_map(|&t| 3 * t..3 * t + 3);
        half_edges.all(|h| self.across[h as usize] != NONE)
    }
}

/// Six times the volume that a closed component would have if all its triangles faced as the first one does.
fn volume(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    component: &[u32],
    against: &[Option<bool>],
) -> f64 {
    let from = positions[triangles[component[0] as usize][0] as usize];
    let at = |v: u32| nalgebra::Vector3::from(positions[v as usize]) - nalgebra::Vector3::from(from);
    let part = |&t: &u32| {
        let [a, b, c] = triangles[t as usize].map(at);
        let volume = a.cross(&b).dot(&c);
        if against[t as usize] == Some(true) {
            -volume
        } else {
            volume
        }
    };
    component.iter().map(part).sum()
}
