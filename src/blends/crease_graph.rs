//! The creases of a mesh as a graph: chains of edges between corners and ends.

use nalgebra::Vector3;

use super::crease_ends::{TURN, connect};
use super::options::RoundOptions;
use super::surface::{Surface, between};
use super::triangle_normals::normals;
use crate::mesh::disjoint_sets::DisjointSets;
use crate::mesh::edge_set::EdgeSet;
use crate::mesh::halfedge::previous;
use crate::mesh::rows::Rows;

/// What bends, and how the mesh falls into faces between.
pub(super) struct CreaseGraph {
    /// Per triangle the face it belongs to.
    pub(super) faces: Vec<u32>,
    pub(super) chains: Vec<Chain>,
    /// Corners that stay sharp, and the place for which they do.
    pub(super) sharp_corners: Vec<(u32, Vector3<f64>)>,
    /// Edges that bend by more than so many degrees are creases.
    pub(super) least: f64,
    /// Unit normals of triangles, of those without area that of a neighbour.
    pub(super) normals: Vec<Vector3<f64>>,
}

/// Edges one after the other.
pub(super) struct Chain {
    /// From vertex to vertex; the face on the left is the triangle's.
    pub(super) half_edges: Vec<u32>,
    /// Whether the last one ends where the first begins, and no corner is there.
    pub(super) is_closed: bool,
    /// The mean bend, degrees; positive where the surface is convex.
    pub(super) bend: f64,
    /// Whether it is to be rounded.
    pub(super) is_chosen: bool,
    /// Where no sound blend was found, if it was to be rounded.
    pub(super) unsolved: Option<Vector3<f64>>,
}

impl Chain {
    pub(super) fn length(&self, surface: &Surface<'_>) -> f64 {
        self.half_edges.iter().map(|&h| surface.edge(h).norm()).sum()
    }

    /// It stays sharp, as no sound blend was found: there first.
    pub(super) fn give_up(&mut self, place: Vector3<f64>) {
        self.is_chosen = false;
        self.unsolved.get_or_insert(place);
    }

    /// Its first vertex and its last one.
    pub(super) fn ends(&self, surface: &Surface<'_>) -> [u32; 2] {
        let last = self.half_edges[self.half_edges.len() - 1];
        [surface.origin(self.half_edges[0]), surface.target(last)]
    }
}

/// Where a surface bends by so many degrees and more, its sides lie almost on each other: the ball between them vanishes, and so do the edges of a blend.
/// Edges of a prism alone: of 14 degrees between its sides and less none gets a sound blend, after 15 to 59 s with up to 210,000 triangles; of 15 and 20 they
/// do. Half as much between the sides (173): these are tried, and 54 of 59 solids cut from each other are sound in place of 55. Double (152): edges of 15 to 28
/// degrees stay sharp that need not.
const FOLDED: f64 = 166.0;

impl CreaseGraph {
    pub(super) fn new(surface: &Surface<'_>, options: &RoundOptions) -> Self {
        let normals = normals(surface);
        let bends = bends(surface, &normals);
        let least = if options.angle > 0.0 {
            options.angle
        } else {
            gap(&bends)
        };
        let edges = EdgeSet::new(&options.edges);
        let is_named = |h: u32| edges.has(surface.origin(h), surface.target(h));
        let bends_enough =
            |h: u32| bends[h as usize].abs() > least || surface.across(h).is_some() && is_named(h);
        let mut creased: Vec<bool> = (0..surface.half_edges()).map(bends_enough).collect();
        if options.angle == 0.0 {
            connect(surface, &bends, least, &mut creased);
        }
        let is_crease = |h: u32| creased[h as usize];
        let is_asked =
            |h: u32| options.creases.has(bends[h as usize]) && (options.edges.is_empty() || is_named(h));
        let is_chosen = |h: u32| is_asked(h) && bends[h as usize].abs() < FOLDED;
        let mut sets = DisjointSets::new(normals.len());
        for h in 0..surface.half_edges() {
            if let Some(o) = surface.across(h)
                && h < o
                && !is_crease(h)
            {
                sets.unite(h / 3, o / 3);
            }
        }
        let faces = sets.numbers(normals.len()).0;
        let mut chains = chains(surface, &bends, is_crease, is_chosen);
        for chain in chains.iter_mut().filter(|chain| !chain.is_chosen) {
            let middle = chain.half_edges[chain.half_edges.len() / 2];
            chain.unsolved = is_asked(middle).then(|| surface.x[surface.origin(middle) as usize]);
        }
        Self {
            faces,
            chains,
            sharp_corners: Vec::new(),
            least,
            normals,
        }
    }
}

impl CreaseGraph {
    /// The faces on the left and on the right of a chain.
    pub(super) fn beside(&self, chain: &Chain, surface: &Surface<'_>) -> [u32; 2] {
        let h = chain.half_edges[0];
        [h, surface.across(h).unwrap_or(h)].map(|g| self.faces[g as usize / 3])
    }

    /// Whether a corner stays sharp.
    pub(super) fn is_sharp(&self, v: u32) -> bool {
        self.sharp_corners.iter().any(|of| of.0 == v)
    }

    /// How far the surface bends at an edge, radians.
    pub(super) fn bend(&self, surface: &Surface<'_>, h: u32) -> f64 {
        let other = surface.across(h).unwrap_or(h);
        between(&self.normals[h as usize / 3], &self.normals[other as usize / 3])
    }
}

/// Per half-edge how far the surface bends there, degrees; positive where it is convex.
fn bends(surface: &Surface<'_>, normals: &[Vector3<f64>]) -> Vec<f64> {
    let bend = |h: u32| {
        let Some(o) = surface.across(h) else {
            return 0.0;
        };
        let [m, n] = [h, o].map(|g| normals[g as usize / 3]);
        let angle = between(&m, &n).to_degrees();
        let away = surface.x[surface.origin(previous(o)) as usize] - surface.x[surface.origin(h) as usize];
        if m.dot(&away) <= 0.0 { angle } else { -angle }
    };
    (0..surface.half_edges()).map(bend).collect()
}

/// Bends that are as good as none, and those at which a gap is looked for, degrees.
/// Half or double, of 13 solids cut from each other: none changes.
const SMOOTH: f64 = 10.0;
const GAP: [f64; 2] = [15.0, 60.0];

/// The angle in the middle of the widest gap between bends of the mesh: above are creases, below is what approximates something round.
fn gap(bends: &[f64]) -> f64 {
    let mut all: Vec<f64> = bends.iter().map(|b| b.abs()).filter(|b| *b > SMOOTH).collect();
    all.push(SMOOTH);
    all.push(180.0);
    all.sort_unstable_by(f64::total_cmp);
    let pairs = all
        .windows(2)
        .map(|pair| (pair[1] / pair[0], (pair[0] * pair[1]).sqrt()));
    let within = pairs.filter(|(_, middle)| (GAP[0]..=GAP[1]).contains(middle));
    let widest = within.max_by(|a, b| a.0.total_cmp(&b.0));
    widest.map_or(GAP[1], |(_, middle)| middle)
}

/// Creases from corner to corner.
fn chains(
    surface: &Surface<'_>,
    bends: &[f64],
    is_crease: impl Fn(u32) -> bool,
    is_chosen: impl Fn(u32) -> bool,
) -> Vec<Chain> {
    let all = 0..surface.half_edges();
    let creases = all.filter(|&h| is_crease(h));
    let from = Rows::collect(surface.x.len(), creases.clone().map(|h| (surface.origin(h), h)));
    let goes_on = |h: u32| {
        let [a, b] = *from.row(surface.target(h) as usize) else {
            return None;
        };
        let on = if surface.across(a) == Some(h) { b } else { a };
        let [e, f] = [h, on].map(|g| surface.edge(g));
        let is_like = bends[h as usize] * bends[on as usize] >= 0.0 && is_chosen(h) == is_chosen(on);
        (is_like && e.dot(&f) > TURN * (e.norm() * f.norm())).then_some(on)
    };
    let mut is_used = vec![false; surface.half_edges() as usize];
    let mut chains = Vec::new();
    let mut walk = |first: u32, is_used: &mut Vec<bool>| {
        let mut half_edges = vec![first];
        let mut is_closed = false;
        let mut h = first;
        while let Some(on) = goes_on(h) {
            is_closed = on == first;
            if is_closed {
                break;
            }
            half_edges.push(on);
            h = on;
        }
        for &h in &half_edges {
            is_used[h as usize] = true;
            surface
                .across(h)
                .into_iter()
                .for_each(|o| is_used[o as usize] = true);
        }
        let length: f64 = half_edges.iter().map(|&h| surface.edge(h).norm()).sum();
        let sum = |h: &u32| surface.edge(*h).norm() * bends[*h as usize];
        chains.push(Chain {
            bend: half_edges.iter().map(sum).sum::<f64>() / length,
            is_chosen: is_chosen(first),
            unsolved: None,
            half_edges,
            is_closed,
        });
    };
    // Open ones first: they begin where nothing comes before.
    for h in creases.clone() {
        let begins = surface.across(h).is_some_and(|back| goes_on(back).is_none());
        if !is_used[h as usize] && begins {
            walk(h, &mut is_used);
        }
    }
    for h in creases {
        if !is_used[h as usize] {
            walk(h, &mut is_used);
        }
    }
    chains
}
