//! How wide bands are: what is asked, as far as there is room for it.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use rstar::RTree;
use rstar::primitives::GeomWithData;

use super::boundaries::Boundaries;
use super::chain_curve::ChainCurve;
use super::crease_graph::{Chain, CreaseGraph};
use super::ends::{Ends, SHARE};
use super::options::RoundOptions;
use super::surface::Surface;
use super::through::Through;

/// Where two bands meet in corners at both ends of a crease their rails take at most this part of it, and a band this part of what is before a boundary.
/// Of 12 solids cut from each other, .5: all others are as sound, with 11 % more vertices, as bands are narrower; .95: one more is sound.
const ALONG: f64 = 0.85;
/// Points of one curve are apart if it is so many times as far along the curve as through space: about as on a half circle.
/// Of 12 solids cut from each other, 1.2 and 2: none changes.
const APART: f64 = 1.4;
/// No band is narrowed below this part of the width asked: its triangles would be without number.
/// Of 12 solids cut from each other, half: all are as sound; double: one has two creases that stay sharp.
const LEAST: f64 = 0.1;
/// What lies in a direction on a face: the cosine.
/// Of 12 solids cut from each other, half: one loses two creases more; double: one more is sound.
const AHEAD: f64 = 0.4;
/// Widths change by at most so much per length.
/// Of 12 solids cut from each other, half and double: one loses two creases, or one, more.
pub(super) const SLOPE: f64 = 0.25;

/// A band that fades out ends so many widths before its crease does, as bands of one corner have no normal in common.
/// Of 12 solids cut from each other, half or double: as sound, 10 do not change.
const BEFORE: f64 = 0.25;

/// Per chain and point of its curve; negative where a band has ended.
pub(super) struct Widths {
    pub(super) at: Vec<Vec<f64>>,
    /// Per chain how much they change per length, as asked.
    slopes: Vec<f64>,
}

/// Where chains begin: with the first of its edges that is named, as it is named, or else at the end with the smaller number.
struct Beginnings(BTreeMap<[u32; 2], usize>);

impl Beginnings {
    fn new(edges: &[[u32; 2]]) -> Self {
        // Of edges that are named twice the first one holds.
        Self((0..edges.len()).rev().map(|i| (edges[i], i)).collect())
    }

    /// Whether a chain that is not closed begins at its last vertex.
    fn is_last(&self, chain: &Chain, surface: &Surface<'_>) -> bool {
        let [first, last] = chain.ends(surface);
        let both_ways = chain.half_edges.iter().flat_map(|&h| {
            let [a, b] = [surface.origin(h), surface.target(h)];
            [([a, b], false), ([b, a], true)]
        });
        let named = both_ways.filter_map(|(edge, is_backward)| Some((self.0.get(&edge)?, is_backward)));
        named.min().map_or(last < first, |(_, is_backward)| is_backward)
    }
}

/// A point of a curve: the chain, and its number there.
type Sample = GeomWithData<[f64; 3], (u32, u32)>;

impl Widths {
    /// What is asked.
    pub(super) fn asked(
        surface: &Surface<'_>,
        graph: &CreaseGraph,
        curves: &[ChainCurve],
        options: &RoundOptions,
    ) -> Self {
        let at = |&bend: &f64| match options.radius > 0.0 {
            true => options.radius * libm::tan(0.5 * bend),
            false => options.width,
        };
        let mut widths = Self {
            at: curves
                .iter()
                .map(|curve| curve.bends.iter().map(at).collect())
                .collect(),
            slopes: vec![0.0; curves.len()],
        };
        let begins = Beginnings::new(&options.edges);
        for (c, chain) in (0..).zip(&graph.chains).filter(|(_, chain)| !chain.is_closed) {
            widths.taper(
                c,
                options.taper,
                begins.is_last(chain, surface),
                chain.length(surface),
            );
        }
        widths
    }

    /// Lets the widths of a chain change evenly, by this factor from its beginning, which may be its last vertex, to its end.
    fn taper(&mut self, c: usize, factor: f64, is_backward: bool, length: f64) {
        let widths = &mut self.at[c];
        let last = widths.len() - 1;
        for (i, width) in widths.iter_mut().enumerate() {
            let steps = if is_backward { last - i } else { i };
            let before = *width;
            *width *= 1.0 + (factor - 1.0) * steps as f64 / last as f64;
            self.slopes[c] = self.slopes[c].max((factor - 1.0).abs() * before / length);
        }
    }

    /// Narrows them where bands would meet. Per curve the least part of the width that there is room for, and where that is.
    pub(super) fn fit(
        &mut self,
        surface: &Surface<'_>,
        graph: &CreaseGraph,
        curves: &[ChainCurve],
        (angles, through): (&[[f64; 2]], &[Through]),
    ) -> Vec<(f64, Vector3<f64>)> {
        let points = (0..).zip(curves).flat_map(|(c, curve)| {
            let of = (0..).zip(&curve.points);
            of.map(move |(i, p)| Sample::new((*p).into(), (c, i)))
        });
        let tree = RTree::bulk_load(points.collect());
        let room = Room {
            surface,
            graph,
            curves,
            tree: &tree,
            across: through
                .iter()
                .filter_map(|of| Some(((of.at.chain, of.at.end), of.face?)))
                .collect(),
        };
        let boundaries = Boundaries::new(surface, graph);
        let mut least = vec![(1.0, Vector3::zeros()); curves.len()];
        for (c, chain) in graph
            .chains
            .iter()
            .enumerate()
            .filter(|(_, chain)| chain.is_chosen)
        {
            let cotangents = |side: usize| angles[side].map(|a| 1.0 / libm::tan(0.5 * a)).iter().sum::<f64>();
            let cotangent = cotangents(2 * c).max(cotangents(2 * c + 1));
            let longest = if cotangent > 1e-9 {
                ALONG * chain.length(surface) / cotangent
            } else {
                f64::INFINITY
            };
            for (i, width) in self.at[c].iter_mut().enumerate() {
                let fits = longest
                    .min(SHARE * room.at(c, i, *width / SHARE))
                    .min(ALONG * room.before(&boundaries, c, i, *width / ALONG));
                let part = (fits / *width).clamp(LEAST, 1.0);
                *width *= part;
                if part < least[c].0 {
                    least[c] = (part, curves[c].points[i]);
                }
            }
        }
        self.even_out(surface, graph, curves);
        least
    }

    /// Lets widths change slowly along chains, and from one to the next.
    fn even_out(&mut self, surface: &Surface<'_>, graph: &CreaseGraph, curves: &[ChainCurve]) {
        let mut at_vertex = vec![f64::INFINITY; surface.x.len()];
        for _ in 0..2 {
            for (c, chain) in graph
                .chains
                .iter()
                .enumerate()
                .filter(|(_, chain)| chain.is_chosen)
            {
                let (widths, step) = (&mut self.at[c], (SLOPE + self.slopes[c]) * curves[c].spacing);
                let (last, ends) = (widths.len() - 1, chain.ends(surface).map(|v| v as usize));
                if !chain.is_closed {
                    widths[0] = widths[0].min(at_vertex[ends[0]]);
                    widths[last] = widths[last].min(at_vertex[ends[1]]);
                }
                // Twice around closes a ring.
                for i in 1..=2 * last {
                    let (here, before) = (i % (last + 1), (i - 1) % (last + 1));
                    if here > 0 || chain.is_closed {
                        widths[here] = widths[here].min(widths[before] + step);
                    }
                }
                for i in (0..2 * last).rev() {
                    let (here, after) = (i % (last + 1), (i + 1) % (last + 1));
                    if here < last || chain.is_closed {
                        widths[here] = widths[here].min(widths[after] + step);
                    }
                }
                if !chain.is_closed {
                    at_vertex[ends[0]] = at_vertex[ends[0]].min(widths[0]);
                    at_vertex[ends[1]] = at_vertex[ends[1]].min(widths[last]);
                }
            }
        }
    }

    /// Lets bands end where their creases do.
    pub(super) fn fade(
        &mut self,
        surface: &Surface<'_>,
        graph: &CreaseGraph,
        curves: &[ChainCurve],
        through: &[Through],
    ) {
        let ends = Ends::new(surface, graph);
        for ((widths, chain), curve) in self.at.iter_mut().zip(&graph.chains).zip(curves) {
            let slopes = ends.slopes(chain, through);
            let begins = [0, widths.len() - 1].map(|i| BEFORE * widths[i]);
            for (i, width) in widths.iter_mut().enumerate() {
                let from = curve.to_ends(i);
                let grown = |k: usize, slope: f64| slope * (from[k] - begins[k]);
                let least = |k: usize| slopes[k].map_or(f64::INFINITY, |slope| grown(k, slope));
                *width = width.min(least(0)).min(least(1));
            }
        }
    }
}

/// How far it is to other creases.
struct Room<'a> {
    surface: &'a Surface<'a>,
    graph: &'a CreaseGraph,
    curves: &'a [ChainCurve],
    tree: &'a RTree<Sample>,
    /// The faces that blends run through to, per chain and end.
    across: BTreeMap<(usize, usize), u32>,
}

impl Room<'_> {
    /// The distance from a point of a curve over either face beside it, or that across from its end, to the next crease of the face that does not meet
    /// this one; infinite if none is nearer than `most`.
    fn at(&self, c: usize, i: usize, most: f64) -> f64 {
        let (chain, curve) = (&self.graph.chains[c], &self.curves[c]);
        let p = curve.points[i];
        let faces = self.graph.beside(chain, self.surface);
        let inward = self.inward(c, i);
        let across = match i {
            0 => self.across.get(&(c, 0)),
            _ if i + 1 == curve.points.len() => self.across.get(&(c, 1)),
            _ => None,
        };
        let mut nearest = f64::INFINITY;
        for sample in self.tree.locate_within_distance(p.into(), most * most) {
            let (d, j) = (sample.data.0 as usize, sample.data.1 as usize);
            let to = Vector3::from(*sample.geom()) - p;
            let distance = to.norm();
            let other = &self.graph.chains[d];
            let is_apart = match c == d {
                true => curve.between_points(i, j) > APART * distance,
                false => !self.meet(c, d),
            };
            if distance >= nearest || !is_apart {
                continue;
            }
            let others = self.graph.beside(other, self.surface);
            let is_ahead = |k: usize| others.contains(&faces[k]) && to.dot(&inward[k]) > AHEAD * distance;
            let is_across = across.is_some_and(|face| others.contains(face));
            if is_ahead(0) || is_ahead(1) || is_across {
                nearest = distance;
            }
        }
        nearest
    }

    /// The distance over either face beside it to the boundary, but for where the chain ends; infinite if it is no nearer than `most`.
    fn before(&self, boundaries: &Boundaries, c: usize, i: usize, most: f64) -> f64 {
        let faces = self.graph.beside(&self.graph.chains[c], self.surface);
        let inward = self.inward(c, i);
        let is_ahead = |h: u32, to: &Vector3<f64>| {
            let face = self.graph.faces[h as usize / 3];
            (0..2).any(|k| faces[k] == face && to.dot(&inward[k]) > AHEAD * to.norm())
        };
        boundaries.distance(c as u32, &self.curves[c].points[i], most, is_ahead)
    }

    /// Whether two chains end at the same vertex.
    fn meet(&self, c: usize, d: usize) -> bool {
        let [here, there] = [c, d].map(|c| self.graph.chains[c].ends(self.surface));
        here.iter().any(|v| there.contains(v))
    }

    /// Unit vectors from a curve into the faces on its left and on its right.
    fn inward(&self, c: usize, i: usize) -> [Vector3<f64>; 2] {
        let (chain, curve) = (&self.graph.chains[c], &self.curves[c]);
        let h = chain.half_edges[curve.edges[i]];
        let normals = [h, self.surface.across(h).unwrap_or(h)].map(|g| self.graph.normals[g as usize / 3]);
        let along = curve.tangent(i);
        [normals[0].cross(&along), along.cross(&normals[1])].map(|v| v.try_normalize(0.0).unwrap_or_default())
    }
}
