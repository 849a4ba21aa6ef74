//! The strip of a bridge: its sides, its boundary as a loop of which the mesh has a part, and the patch in it.

use std::f64::consts::{SQRT_2, TAU};

use fairmesh_linear::interrupt::unless_stopped;
use nalgebra::Vector3;

use super::attempts::Check;
use super::bridge_chains::Chain;
use super::bridge_sides::{Corner, End, Side};
use super::bridged::Bridged;
use super::crossing::Neighbours;
use super::fill::crossings;
use super::fill_progress::Tries;
use super::filled::Filled;
use super::groups::LoopGroup;
use super::links::Links;
use super::loops::{BoundaryLoop, LoopKind};
use super::options::{FillOptions, largest_patch};
use super::outcome::{FillOutcome, OpenReason};
use super::parents::{Parents, compose};
use super::surroundings::Surroundings;
use crate::fairing::{BoundaryNormals, Intersections, Options, Progress, ProgressCallback, joined_options};
use crate::holes::local_frame::local_options;
use crate::holes::patch_surface::{PatchSurface, Task};
use crate::mesh::{Joined, NONE};
use crate::support::error::Error;
use crate::support::stopwatch::Stopwatch;

/// A strip that is twisted by more than this (degrees) would have to be turned over: its ends face opposite ways.
/// Half or double, of 6 cases: none changes.
const OPPOSITE: f64 = 120.0;
/// The triangulation begins with edges across the strip at distances of about this part of its width.
/// Of 6 cases, half: 2 change, 2 get another triangulation; double: 4 change, 4 get another triangulation.
const RUNGS: f64 = 0.5;

/// A strip before it is triangulated.
pub(super) struct Strip<'m> {
    links: &'m Links<'m>,
    positions: &'m [[f64; 3]],
    chains: &'m [Chain; 2],
    ends: [End; 2],
    /// Radians.
    twist: f64,
    /// Points and normals on the two sides, from the first chain to the second.
    sides: [Vec<(Vector3<f64>, Vector3<f64>)>; 2],
}

impl<'m> Strip<'m> {
    pub(super) fn new(
        links: &'m Links<'m>,
        positions: &'m [[f64; 3]],
        chains: &'m [Chain; 2],
        filling: &FillOptions,
    ) -> Result<Self, Error> {
        let end = |chain: &Chain| {
            End::new(links, positions, chain).ok_or(Error::NoNormal {
                vertex: chain.vertices[0] as usize,
            })
        };
        let ends = [end(&chains[0])?, end(&chains[1])?];
        let [a, b] = &ends;
        let twist = Side::new(&a.middle, &b.middle).twist(&b.middle.normal);
        let side = |from, to: &Corner| {
            let side = Side::new(from, to);
            let own = side.twist(&to.normal);
            // The whole turns that the strip makes, too.
            side.twisted(own + TAU * ((twist - own) / TAU).round())
        };
        let sides = [side(&a.last, &b.first), side(&a.first, &b.last)];
        let factor = SQRT_2 / filling.density;
        let (from, to) = (factor * a.edge, factor * b.edge);
        let edges = sides.iter().map(|side| side.edges(from, to)).fold(0.0, f64::max);
        // Two at least, so that no side is an edge that the mesh may have.
        let count = (edges.round() as usize).max(2);
        let most = filling.max_new_vertices;
        Error::check_option(
            "max_new_vertices",
            most as f64,
            2 * (count - 1) <= most,
            "at least the number of vertices that the two sides of the bridge need",
        )?;
        Ok(Self {
            links,
            positions,
            chains,
            ends,
            twist,
            sides: sides.map(|side| side.points(count, from, to)),
        })
    }

    /// How many vertices each side has.
    fn count(&self) -> usize {
        self.sides[0].len()
    }

    /// The edges of the chains and the sides.
    pub(super) fn boundary_edges(&self) -> usize {
        self.chains
            .iter()
            .map(|chain| chain.half_edges.len())
            .sum::<usize>()
            + 2 * (self.count() + 1)
    }

    /// The numbers of a side's vertices, from the first chain to the second.
    fn ids(&self, side: usize) -> Vec<u32> {
        let first = self.positions.len() + side * self.count();
        (first..first + self.count()).map(|v| v as u32).collect()
    }

    /// All positions with those on the sides.
    fn all_positions(&self) -> Vec<[f64; 3]> {
        let new = self.sides.iter().flatten().map(|(x, _)| (*x).into());
        self.positions.iter().copied().chain(new).collect()
    }

    /// The unit normals at the sides' vertices.
    fn normals(&self) -> Vec<(u32, [f64; 3])> {
        let all = self.sides.iter().flatten();
        let first = self.positions.len() as u32;
        (first..)
            .zip(all)
            .map(|(v, (_, normal))| (v, (*normal).into()))
            .collect()
    }

    /// The options with the normals at the sides.
    pub(super) fn with_normals(&self, options: &Options) -> Options {
        let mut given = match &options.boundary_normals {
            BoundaryNormals::Given(list) => list.clone(),
            _ => Vec::new(),
        };
        given.extend(self.normals());
        Options {
            boundary_normals: BoundaryNormals::Given(given),
            ..options.clone()
        }
    }

    /// The boundary of the strip as a loop; at the sides there is no mesh.
    fn boundary(&self) -> BoundaryLoop {
        let [a, b] = self.chains;
        let (there, mut back) = (self.ids(0), self.ids(1));
        back.reverse();
        let open = vec![NONE; self.count() + 1];
        let component = self.links.components()[a.half_edges[0] as usize / 3] as usize;
        BoundaryLoop {
            vertices: [&a.vertices[..], &there, &b.vertices, &back].concat(),
            half_edges: [&a.half_edges[..], &open, &b.half_edges, &open].concat(),
            length: 0.0,
            area: 0.0,
            turn: 0.0,
            touching: Vec::new(),
            hangs_at: None,
            kind: LoopKind::Hole,
            component,
            component_triangles: 0,
        }
    }

    /// The normals beyond a side's edges, from the first chain to the second.
    fn beyond(&self, side: usize) -> Vec<Vector3<f64>> {
        let [a, b] = &self.ends;
        let corners = [[&a.last, &b.first], [&a.first, &b.last]][side];
        let inner = self.sides[side].iter().map(|(_, normal)| *normal);
        let all: Vec<Vector3<f64>> = std::iter::once(corners[0].normal)
            .chain(inner)
            .chain([corners[1].normal])
            .collect();
        let mean = |pair: &[Vector3<f64>]| {
            (pair[0] + pair[1])
                .try_normalize(0.0)
                .unwrap_or_else(Vector3::zeros)
        };
        all.windows(2).map(mean).collect()
    }

    /// The mesh around with the strip's boundary in it.
    fn surroundings(&self, positions: &[[f64; 3]], boundary: &BoundaryLoop) -> Surroundings {
        let mut place = vec![NONE; self.links.triangles.len()];
        let mut around = Surroundings::new(self.links, positions, &[boundary], &mut place);
        let (first, count) = (self.chains[0].vertices.len(), self.count());
        let second = first + count + self.chains[1].vertices.len();
        for (k, normal) in self.beyond(0).into_iter().enumerate() {
            around.normals[first - 1 + k] = normal;
        }
        for (k, normal) in self.beyond(1).into_iter().rev().enumerate() {
            around.normals[second - 1 + k] = normal;
        }
        let width = (self.ends[0].last.at - self.ends[0].first.at).norm();
        let step = (RUNGS * width / self.ends[0].edge.max(f64::MIN_POSITIVE)).round() as usize;
        let rung = |k: usize| [first + k, second + count - 1 - k].map(|v| v as u32);
        around.guides = (0..count).step_by(step.max(1)).map(rung).collect();
        around
    }

    pub(super) fn make(
        &self,
        joined: &Joined<'_>,
        triangles: &[[u32; 3]],
        filling: &FillOptions,
        tell: &mut ProgressCallback<'_>,
    ) -> Result<Bridged, Error> {
        let clock = Stopwatch::start();
        let positions = self.all_positions();
        let boundary = self.boundary();
        let piece = match self.twist.abs().to_degrees() > OPPOSITE {
            true => {
                let [a, b] = [self.chains[0].of, self.chains[1].of];
                PatchSurface::open(OpenReason::OppositeSides { a, b })
            }
            false => self.piece(joined, (&positions, &boundary), filling, tell)?,
        };
        let is_there = !matches!(piece.outcome, FillOutcome::LeftOpen(_));
        let old = self.positions.len();
        let mut filled = Filled {
            positions: if is_there {
                positions
            } else {
                self.positions.to_vec()
            },
            triangles: triangles.to_vec(),
            parents: if is_there { self.parents() } else { Vec::new() },
            loops: Vec::with_capacity(1),
        };
        let mut piece = piece;
        if !joined.copies.is_empty() && is_there {
            piece.name_copies(&self.copies(triangles));
        }
        let mut loops = self.chains.each_ref().map(|chain| chain.of).to_vec();
        loops.sort_unstable();
        loops.dedup();
        let group = LoopGroup {
            loops,
            is_named: true,
            reason: None,
        };
        let mut pieces = vec![(piece, clock.seconds())];
        let pairs = crossings(&pieces, triangles.len() as u32).pop();
        if let Some((piece, seconds)) = pieces.pop() {
            filled.append(piece, &group, boundary.vertices.len(), seconds);
        }
        compose(
            &mut filled.parents,
            old,
            if is_there { 2 * self.count() } else { 0 },
        );
        let Some(mut strip) = filled.loops.pop() else {
            return Err(Error::EmptyRegion);
        };
        strip.self_intersections = pairs.unwrap_or_default();
        strip.vertices.start = old as u32;
        let mut sides = [Vec::new(), Vec::new()];
        if is_there {
            sides = [self.ids(0), self.ids(1)];
            sides[1].reverse();
        }
        let copies = self.chains.each_ref().map(|chain| chain.copies(triangles));
        Ok(Bridged {
            positions: filled.positions,
            triangles: filled.triangles,
            parents: filled.parents,
            chains: copies,
            sides,
            twist: self.twist.to_degrees(),
            strip,
            rest: Vec::new(),
            whole: None,
        })
    }

    fn piece(
        &self,
        joined: &Joined<'_>,
        (positions, boundary): (&[[f64; 3]], &BoundaryLoop),
        filling: &FillOptions,
        tell: &mut ProgressCallback<'_>,
    ) -> Result<PatchSurface, Error> {
        let surroundings = self.surroundings(positions, boundary);
        let fairing = self.with_normals(&joined_options(&joined.copies, &filling.fairing));
        let edges = surroundings.loop_vertices;
        let most = filling.max_new_vertices.saturating_sub(2 * self.count());
        let task = Task {
            surroundings: &surroundings,
            factor: SQRT_2 / filling.density,
            most: most.min(largest_patch(edges, filling.density)),
            unfaired: filling.unfaired(&surroundings),
            options: local_options(&surroundings, &fairing),
            precision: filling.fairing.output_precision,
        };
        let mut neighbours = (filling.fairing.intersections == Intersections::Check).then(|| {
            let chosen = std::iter::once(vec![boundary]);
            Neighbours::new(positions, &joined.triangles, chosen)
        });
        let check = Check {
            of: 0,
            neighbours: neighbours.as_mut(),
            has_sound_rim: &|_| true,
        };
        let mut tries = Tries::new();
        let mut tell = |progress: &Progress| {
            tell(&Progress {
                fraction: tries.reached(progress.fraction),
                ..*progress
            })
        };
        let piece = unless_stopped(|| task.settled((&[], 1.0), check, filling.on_failure, &mut tell));
        Ok(piece.unwrap_or_else(|| PatchSurface::open(OpenReason::Cancelled)))
    }

    /// Where the sides' vertices come from: from the corners at both their ends.
    fn parents(&self) -> Vec<Parents> {
        let [a, b] = self.chains.each_ref().map(|chain| &chain.vertices);
        let corners = [[a[a.len() - 1], b[0]], [a[0], b[b.len() - 1]]];
        let count = self.count();
        let parent = |ends: [u32; 2], k: usize| {
            let part = (k + 1) as f64 / (count + 1) as f64;
            Parents {
                vertices: [ends[0], ends[1], ends[1]],
                weights: [1.0 - part, part, 0.0],
            }
        };
        let of_side = |ends: [u32; 2]| (0..count).map(move |k| parent(ends, k));
        corners.into_iter().flat_map(of_side).collect()
    }

    /// The copies that stand for the boundary's vertices in the mesh as given.
    fn copies(&self, triangles: &[[u32; 3]]) -> Vec<u32> {
        let (there, mut back) = (self.ids(0), self.ids(1));
        back.reverse();
        let [a, b] = self.chains.each_ref().map(|chain| chain.copies(triangles));
        [a, there, b, back].concat()
    }
}
