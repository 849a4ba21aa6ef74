//! How far a point of the surface is outside the bands around creases: zero on the rails, negative in the band.

use nalgebra::Vector3;

use super::chain_curve::ChainCurve;
use super::crease_graph::Chain;

/// Edges across a blend, at least. Blends of a cube of side 2, .2 wide, are off cylinders by 1.2e-3 of the width at 6 and 6e-4 at 7; at double, with four times
/// the vertices, by 8e-4, three widths from corners, and 3e-5 where these are six away. At half [`TURN`] asks for 4.5 there, and they are off by 3e-4; creases that bend by
/// less than 70 degrees get fewer.
const PARTS: f64 = 7.0;
/// By how much a blend turns at most at each edge across, in radians: 20 degrees. At 15 a prism with edges of 15 degrees between their faces stays
/// sharp at two corners and an edge (its triangles are too small beside the rails); at 28, and without a bound, of eight solids with such edges, cut
/// from each other, two more do not converge.
const TURN: f64 = 0.35;
/// Widths below this part of the largest of a side count as that: towards an end they vanish.
/// Half or double, of 13 solids cut from each other: none changes.
const LEAST: f64 = 0.1;

/// One side of a chain: a band on one face.
pub(super) struct Side {
    /// The face it lies on.
    pub(super) face: u32,
    pub(super) curve: u32,
    /// Per point of the curve how far away the rail is.
    pub(super) widths: Vec<f64>,
    /// The largest of them.
    pub(super) widest: f64,
    /// Before the beginning of the curve and behind its end: the side that places have to be near as well there, if they do not count alone.
    pub(super) with: [Option<u32>; 2],
}

/// Two sides that meet in a corner on one face: the rail goes around it smoothly.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corner {
    /// The smaller number first.
    pub(super) sides: [u32; 2],
    /// How far from where the rails would cross it leaves them, in widths.
    pub(super) radius: f64,
}

/// A side near a vertex.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry {
    pub(super) side: u32,
    /// Where on the curve the nearest place is.
    pub(super) at: f64,
    pub(super) distance: f64,
    /// The distance minus the width there.
    pub(super) excess: f64,
}

/// What a band asks for near a place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Size {
    /// How long edges are to be.
    pub(super) edge: f64,
    /// How wide the band is; towards an end it does not vanish.
    pub(super) width: f64,
}

/// All sides and corners.
pub(super) struct Level {
    pub(super) curves: Vec<ChainCurve>,
    /// Two of each curve, in their order, then those on faces across from ends.
    pub(super) sides: Vec<Side>,
    /// Sorted by their sides.
    pub(super) corners: Vec<Corner>,
    /// Per curve the least part of the width asked, and where that is.
    pub(super) least: Vec<(f64, Vector3<f64>)>,
}

impl Level {
    /// How far a point is from a side, from a place on its curve that is near on.
    pub(super) fn entry(&self, side: u32, p: &Vector3<f64>, near: f64) -> Entry {
        let of = &self.sides[side as usize];
        let curve = &self.curves[of.curve as usize];
        let found = curve.nearest(p, near);
        Entry {
            side,
            at: found.at,
            distance: found.distance,
            excess: found.distance - curve.between(&of.widths, found.at),
        }
    }

    /// The value where these sides are near.
    pub(super) fn value(&self, entries: &[Entry]) -> f64 {
        let mut value = f64::INFINITY;
        for (i, a) in entries.iter().enumerate() {
            let with = self.with(a).map(|side| entries.iter().find(|b| b.side == side));
            value = value.min(match with {
                None => a.excess,
                Some(Some(b)) if self.with(b) == Some(a.side) => a.excess.max(b.excess),
                Some(_) => continue,
            });
            for b in &entries[i + 1..] {
                if let Some(radius) = self.radius(a.side, b.side) {
                    let radius = radius * (a.distance - a.excess).min(b.distance - b.excess);
                    if radius <= 0.0 {
                        continue;
                    }
                    let [s, t] = [a, b].map(|e| (1.0 - e.excess / radius).max(0.0));
                    value = value.min(radius * (1.0 - (s * s + t * t).sqrt()));
                }
            }
        }
        value
    }

    /// The side that a place has to be near as well, if it does not count alone.
    fn with(&self, entry: &Entry) -> Option<u32> {
        let side = &self.sides[entry.side as usize];
        let last = self.curves[side.curve as usize].points.len() as f64 - 1.0;
        match entry.at {
            at if at < 0.0 => side.with[0],
            at if at > last => side.with[1],
            _ => None,
        }
    }

    /// The value at a point, and the sides near it: those near other points close by.
    pub(super) fn value_at(&self, p: &Vector3<f64>, near: &[Entry], entries: &mut Vec<Entry>) -> f64 {
        entries.clear();
        for of in near {
            if !entries.iter().any(|e| e.side == of.side) {
                entries.push(self.entry(of.side, p, of.at));
            }
        }
        self.value(entries)
    }

    /// The nearest of some sides.
    pub(super) fn nearest<'e>(&self, entries: &'e [Entry]) -> Option<&'e Entry> {
        entries.iter().min_by(|a, b| a.excess.total_cmp(&b.excess))
    }

    /// What the nearest of some sides asks for: the arc of a ball that touches both faces there is divided into [`PARTS`].
    pub(super) fn size(&self, entries: &[Entry]) -> Option<Size> {
        let entry = self.nearest(entries)?;
        let side = &self.sides[entry.side as usize];
        let curve = &self.curves[side.curve as usize];
        let width = (entry.distance - entry.excess).max(LEAST * side.widest);
        let bend = curve.between(&curve.bends, entry.at);
        let edge = width * bend / libm::tan(0.5 * bend) / PARTS.max(bend / TURN);
        Some(Size { edge, width })
    }

    /// Which part of the way from the chord between its rails to the crease the arc of that ball bulges.
    pub(super) fn bulge(&self, entry: &Entry) -> f64 {
        let curve = &self.curves[self.sides[entry.side as usize].curve as usize];
        let cosine = libm::cos(0.5 * curve.between(&curve.bends, entry.at));
        cosine / (1.0 + cosine)
    }

    /// About how many vertices the blends of the chains chosen have.
    pub(super) fn vertices(&self, chains: &[Chain]) -> f64 {
        let chosen = (0..chains.len()).filter(|&c| chains[c].is_chosen);
        chosen.map(|c| self.vertices_along(c)).sum()
    }

    /// About how many the blend along a curve has: rows across at each of its points. None where its bands end before they begin.
    fn vertices_along(&self, curve: usize) -> f64 {
        let (side, curve) = (&self.sides[2 * curve], &self.curves[curve]);
        if side.widest <= 0.0 {
            return 0.0;
        }
        let rows = |bend: f64| PARTS.max(bend / TURN);
        let at = |(width, bend): (&f64, &f64)| {
            let arc = width.max(LEAST * side.widest) * bend / libm::tan(0.5 * bend);
            rows(*bend).powi(2) * curve.spacing / arc
        };
        side.widths.iter().zip(&curve.bends).map(at).sum()
    }

    fn radius(&self, a: u32, b: u32) -> Option<f64> {
        let pair = [a.min(b), a.max(b)];
        let of = |corner: &Corner| corner.sides.cmp(&pair);
        let found = self.corners.binary_search_by(of).ok()?;
        Some(self.corners[found].radius)
    }
}
