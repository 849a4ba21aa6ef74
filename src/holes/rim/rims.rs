//! The rims of all patches.

use std::borrow::Cow;

use nalgebra::Vector3;

use super::options::Rim;
use super::relax::{RelaxedRim, RimVertex, relaxed};
use super::report::RimReport;
use super::roughness::roughness;
use crate::fairing::{BoundaryNormals, Intersections, Options, SelfIntersections};
use crate::holes::links::Links;
use crate::holes::loop_set::normal;
use crate::holes::loops::BoundaryLoop;
use crate::holes::options::FillOptions;
use crate::holes::surroundings::Surroundings;
use crate::intersections::of_some;
use crate::mesh::NONE;
use crate::mesh::coincident::Copies;
use crate::support::entries::sort_by_number;

/// A triangle whose normal has less than this of the fitted one is folded: 60 degrees.
/// Of 3 cases, half: none changes; double: 0 change, 3 fail.
const TURNED: f64 = 0.5;

/// The loops of a patch that are rough, and what is advised for them.
fn advised<'l>(
    rim: Rim,
    links: &Links<'_>,
    positions: &[[f64; 3]],
    loops: &[&'l BoundaryLoop],
    place: &mut [u32],
) -> (Rim, Vec<&'l BoundaryLoop>) {
    let advice = |of: &&BoundaryLoop| roughness(links, positions, of, place)?.advice;
    let advice: Vec<_> = loops.iter().map(advice).collect();
    let rough = loops.iter().zip(&advice).filter(|(_, advice)| advice.is_some());
    let relax = advice.iter().flatten().map(|advice| advice.relax).max();
    let relax = relax.unwrap_or(0);
    (Rim { relax, ..rim }, rough.map(|(of, _)| *of).collect())
}

/// What became of the vertices around the loops of all patches.
pub(in crate::holes) struct Rims<'m> {
    /// Where the vertices are now.
    pub(in crate::holes) positions: Cow<'m, [[f64; 3]]>,
    /// Which vertices moved, and for which patch; ascending.
    owners: Vec<(u32, usize)>,
    of: Vec<Option<RelaxedRim>>,
}

impl<'m> Rims<'m> {
    /// Nothing moves for so many patches.
    pub(in crate::holes) fn none(patches: usize, positions: &'m [[f64; 3]]) -> Self {
        Self {
            positions: positions.into(),
            owners: Vec::new(),
            of: vec![None; patches],
        }
    }

    /// Moves what is around the loops of these patches.
    pub(in crate::holes) fn relax<'l>(
        &mut self,
        options: &FillOptions,
        links: &Links<'_>,
        patches: impl Iterator<Item = (usize, Vec<&'l BoundaryLoop>)>,
    ) {
        let given = self.positions.to_vec();
        let mut place = vec![NONE; given.len().max(links.triangles.len())];
        let mut wanted: Vec<(RimVertex, usize)> = Vec::new();
        let is_auto = options.rim.relax == Rim::AUTO;
        for (i, loops) in patches {
            let (rim, loops) = match is_auto {
                true => advised(options.rim, links, &given, &loops, &mut place),
                false => (options.rim, loops),
            };
            if loops.is_empty() {
                continue;
            }
            let moved = relaxed(&rim, links, &given, &loops, &mut place);
            wanted.extend(moved.places.iter().map(|&of| (of, i)));
            self.of[i] = Some(moved);
        }
        // Of a vertex near several loops the nearest one decides.
        wanted.sort_by_key(|(of, _)| (of.vertex, of.ring));
        wanted.dedup_by_key(|(of, _)| of.vertex);
        for (of, i) in wanted {
            let v = of.vertex as usize;
            self.positions.to_mut()[v] = options.fairing.output_precision.round(of.x.into());
            if self.positions[v] != given[v] {
                self.owners.push((of.vertex, i));
            }
        }
        self.measure(&given);
        if options.fairing.intersections == Intersections::Check {
            self.intersect(&given, links.triangles);
        }
        if is_auto {
            self.put_back(&given);
        }
    }

    /// Leaves what would be folded or intersect as it is.
    fn put_back(&mut self, given: &[[f64; 3]]) {
        let of = &self.of;
        let is_bad = |i: usize| of[i].as_ref().is_some_and(|of| !of.report.is_sound());
        let (bad, good) = self.owners.iter().partition(|(_, i)| is_bad(*i));
        let bad: Vec<(u32, usize)> = bad;
        for (v, i) in bad {
            self.positions.to_mut()[v as usize] = given[v as usize];
            self.of[i] = None;
        }
        self.owners = good;
    }

    fn owner(&self, v: u32) -> Option<usize> {
        let at = self.owners.binary_search_by_key(&v, |owner| owner.0).ok()?;
        Some(self.owners[at].1)
    }

    fn measure(&mut self, given: &[[f64; 3]]) {
        let mut squares = vec![0.0; self.of.len()];
        for &(v, i) in &self.owners {
            let [a, b] = [given, &self.positions[..]].map(|x| Vector3::from(x[v as usize]));
            let length = (b - a).norm();
            squares[i] += length * length;
            if let Some(moved) = &mut self.of[i] {
                moved.report.moved += 1;
                moved.report.largest = moved.report.largest.max(length);
            }
        }
        for (moved, squares) in self.of.iter_mut().zip(squares) {
            if let Some(report) = moved.as_mut().map(|of| &mut of.report) {
                report.rms = f64::sqrt(squares / report.moved.max(1) as f64);
            }
        }
    }

    /// Looks for triangles that intersect and did not before.
    fn intersect(&mut self, given: &[[f64; 3]], triangles: &[[u32; 3]]) {
        let has_moved = |t: &u32| triangles[*t as usize].iter().any(|&v| self.owner(v).is_some());
        let asked: Vec<u32> = (0..triangles.len() as u32).filter(has_moved).collect();
        let most = SelfIntersections::MOST;
        let found = of_some(&self.positions, triangles, &asked, most);
        if found.is_empty() {
            return;
        }
        let before = of_some(given, triangles, &asked, usize::MAX);
        for pair in found
            .into_iter()
            .filter(|pair| before.binary_search(pair).is_err())
        {
            let corners = pair.iter().flat_map(|&t| triangles[t as usize]);
            let mut owners: Vec<usize> = corners.filter_map(|v| self.owner(v)).collect();
            owners.sort_unstable();
            owners.dedup();
            for i in owners {
                if let Some(moved) = &mut self.of[i] {
                    moved.report.self_intersections.push(pair);
                }
            }
        }
    }

    /// The options with the normals that were fitted at the loops of a patch; those that are given hold.
    pub(in crate::holes) fn with_normals(
        &self,
        patch: usize,
        around: &Surroundings,
        options: Options,
    ) -> Options {
        let Some(moved) = self.of[patch].as_ref().filter(|of| !of.normals.is_empty()) else {
            return options;
        };
        let given = match &options.boundary_normals {
            BoundaryNormals::Given(list) => &list[..],
            _ => &[],
        };
        let mut all = given.to_vec();
        let is_free = |v: u32| given.binary_search_by_key(&v, |entry| entry.0).is_err();
        for (v, id) in (0..).zip(&around.ids[..around.loop_vertices]) {
            if let Ok(at) = moved.normals.binary_search_by_key(id, |entry| entry.0)
                && is_free(v)
            {
                all.push((v, moved.normals[at].1));
            }
        }
        sort_by_number(&mut all);
        Options {
            boundary_normals: BoundaryNormals::Given(all),
            ..options
        }
    }

    /// Where the mesh's vertices are if these patches are left open: what moved for those alone is where it was.
    pub(in crate::holes) fn written(
        &self,
        given: &[[f64; 3]],
        open: &[usize],
        copies: &Copies,
    ) -> Vec<[f64; 3]> {
        let mut positions = given.to_vec();
        for &(v, patch) in &self.owners {
            if open.binary_search(&patch).is_err() {
                let x = self.positions[v as usize];
                positions[v as usize] = x;
                copies.others(v).for_each(|w| positions[w as usize] = x);
            }
        }
        positions
    }

    /// How many of these triangles of a patch are turned away from the surface fitted at one of their vertices on the loops. `name` has the
    /// joined mesh's numbers.
    pub(in crate::holes) fn turned(
        &self,
        patch: usize,
        x: &[[f64; 3]],
        triangles: &[[u32; 3]],
        name: impl Fn(u32) -> u32,
    ) -> usize {
        let Some(moved) = &self.of[patch] else { return 0 };
        let fitted = |v: &u32| {
            let v = name(*v);
            let at = moved.normals.binary_search_by_key(&v, |entry| entry.0);
            at.ok().map(|at| Vector3::from(moved.normals[at].1))
        };
        let is_turned = |t: &&[u32; 3]| {
            let own = normal(&t.map(|v| Vector3::from(x[v as usize])));
            let mut fitted = t.iter().filter_map(fitted);
            fitted.any(|fitted| own.dot(&fitted) < TURNED)
        };
        triangles.iter().filter(is_turned).count()
    }

    /// What became of the rim of a patch; nothing if none was to move.
    pub(in crate::holes) fn report(&self, patch: usize) -> Option<RimReport> {
        self.of[patch].as_ref().map(|of| of.report.clone())
    }
}
