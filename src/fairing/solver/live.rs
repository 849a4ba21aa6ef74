//! Edits and frames: what an interactive program does while something is dragged.

use super::cursor::{Cursor, SolvedSurface};
use super::edited::{Prescribed, united};
use super::{Components, Input, Solver};
use crate::fairing::edit::resolved::{Bend, EditedMesh, ResolvedEdits};
use crate::fairing::edit::{Budget, Edit, Frame};
use crate::fairing::report::ProgressCallback;
use crate::fairing::report::Solution;
use crate::solve::live::Allowance;
use crate::support::error::Error;
use crate::support::stopwatch::Stopwatch;

impl Components {
    /// Takes these edits.
    pub(super) fn edit(&mut self, edits: &ResolvedEdits) -> Result<(), Error> {
        let bends = self.bends(&edits.bends)?;
        let moved = self.cursors.iter().map(|cursor| cursor.moved(edits));
        let mut prescribed: Vec<Prescribed> = moved.collect();
        let of_cursors = self.cursors.iter().zip(&bends).zip(&prescribed);
        let turns = of_cursors.flat_map(|((c, bends), prescribed)| c.turns(bends, edits.bulge, prescribed));
        let turns = united(turns.collect());
        for (cursor, mut prescribed) in self.cursors.iter_mut().zip(prescribed.drain(..)) {
            prescribed.turn(cursor.boundary(), &turns);
            cursor.follow(prescribed);
        }
        Ok(())
    }

    /// The loop that each bend is of, by components: the first one through its vertex.
    fn bends(&self, bends: &[Bend]) -> Result<Vec<Vec<(usize, Bend)>>, Error> {
        let mut found = vec![Vec::new(); self.cursors.len()];
        for bend in bends {
            let of_cursors = self.cursors.iter().zip(&mut found);
            let mut loops = of_cursors.filter_map(|(c, found)| Some((c.loop_of(bend.vertex)?, found)));
            let Some((of_loop, found)) = loops.next() else {
                let vertex = bend.given as usize;
                return Err(Error::NotOnLoop { vertex });
            };
            found.push((of_loop, *bend));
        }
        Ok(found)
    }

    /// One frame of all components, written to the host's positions.
    fn update(&mut self, input: &Input, budget: &Budget, shown: &mut [[f64; 3]]) -> Result<Frame, Error> {
        let clock = Stopwatch::start();
        let mut frame = Frame {
            step: 0.0,
            evaluations: 0,
            is_settled: true,
        };
        for cursor in &mut self.cursors {
            let mut allowance = Allowance::new(budget.evaluations, budget.seconds, clock);
            let (step, is_settled) = cursor.update(&input.options, budget.step(), &mut allowance)?;
            cursor.show(input.options.output_precision, &input.positions, shown);
            frame.step = frame.step.max(step);
            frame.evaluations = frame.evaluations.max(allowance.spent);
            frame.is_settled &= is_settled;
        }
        Ok(frame)
    }

    /// Where all components stand.
    pub(super) fn surfaces(&self) -> Vec<SolvedSurface> {
        self.cursors.iter().map(Cursor::surface).collect()
    }

    /// Back to where they stood, with what was asked there.
    pub(super) fn restore(&mut self, surfaces: Vec<SolvedSurface>) {
        let cursors = self.cursors.iter_mut().zip(surfaces);
        cursors.for_each(|(cursor, surface)| cursor.restore(surface));
    }

    /// The free vertices, ascending.
    pub(super) fn free(&self) -> Vec<u32> {
        let domains = self.cursors.iter().map(|c| &c.domain().region);
        let mut free: Vec<u32> = domains
            .flat_map(|region| &region.vertex_ids[..region.free])
            .copied()
            .collect();
        free.sort_unstable();
        free
    }
}

impl Solver {
    /// Asks for these edits of the boundary in place of those before. All are relative to what is asked without edits: the empty list
    /// is the problem as it was given, and a shorter list takes the last edit back. What no edit concerns stays as it is, to the last bit.
    /// The next frame, or run, starts at the surface at hand.
    ///
    /// Inner fairness that comes from the given mesh ([`InnerFairness`](crate::InnerFairness)) stays that of the mesh as it was given.
    ///
    /// # Errors
    /// [`Error::BadEdit`], [`Error::NotOnLoop`], [`Error::SelectionOutOfRange`] for a vertex that does not exist, [`Error::NotFinite`] and
    /// [`Error::CoordinateTooLarge`] for where a vertex would be moved to. The edits before then hold on.
    pub fn edit(&mut self, edits: &[Edit]) -> Result<(), Error> {
        if let Some(error) = &self.broken {
            return Err(error.clone());
        }
        let mesh = EditedMesh {
            positions: &self.input.positions,
            triangles: &self.input.triangles,
            copies: &self.input.copies,
            free: &self.free,
        };
        let resolved = ResolvedEdits::new(edits, mesh, &mut self.edited.followers)?;
        let components = &mut self.components;
        self.workers.install(|| components.edit(&resolved))?;
        let before = std::mem::replace(&mut self.edited.resolved, resolved);
        self.edited.list = edits.to_vec();
        for moved in &before.moved {
            self.shown[moved.vertex as usize] = self.input.positions[moved.vertex as usize];
        }
        for moved in &self.edited.resolved.moved {
            self.shown[moved.vertex as usize] = moved.at;
        }
        Ok(())
    }

    /// One frame: goes on from the surface at hand towards the one that is asked for, as far as the budget reaches, and no further than
    /// to its tolerance. No solution is made and nothing is checked but for folded triangles: [`finish`](Self::finish) does that.
    ///
    /// Frames find the tangent-continuous surface; [continuity](crate::Options::continuity) of the curvature comes with
    /// [`finish`](Self::finish). Before there is any surface, frames are iterations of the first solve, each of which counts as one
    /// evaluation. Where evaluations lead no further, a frame makes none and is not settled.
    ///
    /// # Errors
    /// [`Error::BadOption`] for a budget that is none; [`Error::NothingFixed`] as [`run`](Self::run).
    pub fn update(&mut self, budget: &Budget) -> Result<Frame, Error> {
        if let Some(error) = &self.broken {
            return Err(error.clone());
        }
        budget.validate()?;
        let (input, components, shown) = (&self.input, &mut self.components, &mut self.shown);
        let updated = self.workers.install(|| components.update(input, budget, shown));
        match updated {
            Ok(frame) => {
                self.spread_shown();
                Ok(frame)
            }
            Err(error) => {
                self.broken = Some(error.clone());
                Err(error)
            }
        }
    }

    /// Copies of free vertices are where these are.
    fn spread_shown(&mut self) {
        for &(v, copy) in self.input.copies.pairs() {
            if self.free.binary_search(&v).is_ok() {
                self.shown[copy as usize] = self.shown[v as usize];
            }
        }
    }

    /// The positions of all vertices in the last frame or run; fixed vertices are where the edits have moved them.
    pub fn positions(&self) -> &[[f64; 3]] {
        &self.shown
    }

    /// The edits in force.
    pub fn edits(&self) -> &[Edit] {
        &self.edited.list
    }

    /// Runs to the end: the surface that is asked for, to the tolerance of the options, with its report. Where the frames have led to no sound
    /// surface, it begins anew, as [`fair`](crate::fair) does.
    ///
    /// # Errors
    /// Those of [`run`](Self::run).
    pub fn finish(&mut self, progress: Option<&mut ProgressCallback<'_>>) -> Result<&Solution, Error> {
        self.run(usize::MAX, progress)
    }
}
