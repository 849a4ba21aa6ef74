//! Many triangles, of which the nearest one to a point is asked for: in several trees, so that making them can be stopped in between.

use fairmesh_linear::interrupt::is_stopped;
use rstar::{AABB, Envelope, RTree, RTreeObject};

use super::tree_triangle::Placed;

/// At most so many triangles in a tree: it is made in ten milliseconds.
/// Half or double: none changes but for points that two triangles are equally near to.
const LARGEST: usize = 10_000;

/// Trees, each with what encloses it.
pub(super) struct Grove(Vec<(AABB<[f64; 3]>, RTree<Placed>)>);

impl Grove {
    /// The trees of these triangles. Tells how far it is, from 0 to 1; where the run is stopped, some are missing.
    pub(super) fn new(triangles: Vec<Placed>, tell: &mut dyn FnMut(f64)) -> Self {
        let count = triangles.len().max(1) as f64;
        let (mut trees, mut done) = (Vec::new(), 0);
        let mut left = vec![triangles];
        while let Some(mut part) = left.pop().filter(|_| !is_stopped()) {
            let bounds = part.iter().fold(AABB::new_empty(), |all: AABB<[f64; 3]>, t| {
                all.merged(&t.envelope())
            });
            if part.len() > LARGEST {
                let (low, high) = (bounds.lower(), bounds.upper());
                let extent = |k: &usize| high[*k] - low[*k];
                let axis = (0..3).max_by(|a, b| extent(a).total_cmp(&extent(b))).unwrap_or(0);
                let place = |t: &Placed| t.x.iter().map(|p| p[axis]).sum::<f64>();
                let middle = part.len() / 2;
                part.select_nth_unstable_by(middle, |a, b| {
                    place(a).total_cmp(&place(b)).then(a.number.cmp(&b.number))
                });
                let half = part.split_off(middle);
                left.extend([half, part]);
                continue;
            }
            done += part.len();
            // In one order, however it was divided.
            part.sort_unstable_by_key(|t| t.number);
            trees.push((bounds, RTree::bulk_load(part)));
            tell(done as f64 / count);
        }
        Self(trees)
    }

    /// The triangle that is nearest to a point.
    pub(super) fn nearest(&self, p: &[f64; 3]) -> Option<&Placed> {
        let away = |k: usize| self.0[k].0.distance_2(p);
        let first = (0..self.0.len()).min_by(|&a, &b| away(a).total_cmp(&away(b)))?;
        let in_tree = |k: usize| {
            let found = self.0[k].1.nearest_neighbor(p)?;
            Some((rstar::PointDistance::distance_2(found, p), found))
        };
        let mut best = in_tree(first)?;
        for k in (0..self.0.len()).filter(|&k| k != first) {
            if away(k) < best.0
                && let Some(other) = in_tree(k).filter(|other| other.0 < best.0)
            {
                best = other;
            }
        }
        Some(best.1)
    }
}
