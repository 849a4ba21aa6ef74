//! Where a [`Session`](super::Session) stands with one component: the solve that [`fair`](crate::fair) runs through, held up
//! between two iterations.

use std::cell::Cell;
use std::ops::ControlFlow;

use nalgebra::Vector3;

use crate::discrete::target::Target;
use crate::error::Error;
use crate::fairing::component_solution::ComponentSolution;
use crate::fairing::conclusion::Found;
use crate::fairing::normals::{GivenNormals, boundary_normals};
use crate::fairing::prepared::Prepared;
use crate::fairing::shares::Shares;
use crate::fairing::{Options, OutputPrecision, Seconds};
use crate::mesh::Region;
use crate::quality::NEEDLE;
use crate::solve::control::Tally;
use crate::solve::ladder::{Ladder, Step};
use crate::solve::system::Collapsed;
use crate::solve::{Control, Domain, SolveResult, SolveStatus, System};
use crate::stopwatch::Stopwatch;

/// A solve under way.
pub(super) struct Cursor {
    prepared: Prepared,
    system: System,
    ladder: Ladder,
    tally: Tally,
    /// Nothing is left to be done, until something is changed.
    is_over: bool,
    seconds: Seconds,
}

impl Cursor {
    /// Orders and analyses the matrices, and measures the given surface. It was prepared in so many seconds.
    pub(super) fn new(
        prepared: Prepared,
        output_precision: OutputPrecision,
        preparation: f64,
    ) -> (Self, ComponentSolution) {
        let clock = Stopwatch::start();
        let problem = prepared.problem();
        let (result, state) = problem.unmoved();
        let system = System::new(&problem);
        let seconds = Seconds {
            setup: preparation + clock.seconds(),
            ..Seconds::default()
        };
        let found = Found {
            prepared: &prepared,
            output_precision,
            result: &SolveResult {
                status: SolveStatus::IterationLimit,
                ..result
            },
            state: &state,
            levels: Vec::new(),
            seconds,
        };
        let solution = found.conclude();
        let cursor = Self {
            prepared,
            system,
            ladder: Ladder::default(),
            tally: Tally::default(),
            is_over: false,
            seconds,
        };
        (cursor, solution)
    }

    /// How many vertices of the component are free.
    pub(super) fn free(&self) -> usize {
        self.prepared.free()
    }

    /// How far it is, from 0 to 1.
    pub(super) fn fraction(&self) -> f64 {
        if self.is_over { 1.0 } else { self.tally.fraction }
    }

    /// Nothing is left to be done, until something is changed.
    pub(super) fn is_over(&self) -> bool {
        self.is_over
    }

    /// Whether the matrices are those of this region.
    pub(super) fn is_of(&self, region: &Region) -> bool {
        let own = &self.prepared.domain.region;
        own.vertex_ids == region.vertex_ids && own.half_edges.triangles == region.half_edges.triangles
    }

    /// At most this many iterations, or one if the callback asks to stop.
    pub(super) fn run(
        &mut self,
        options: &Options,
        iterations: usize,
        shares: &mut Shares<'_>,
    ) -> Result<ComponentSolution, Error> {
        let clock = Stopwatch::start();
        let result = self.advance(options, iterations, shares);
        let result = result.map_err(|Collapsed| self.prepared.nothing_fixed())?;
        self.seconds.start += result.start_seconds;
        self.seconds.iterate += clock.seconds() - result.start_seconds;
        let found = Found {
            prepared: &self.prepared,
            output_precision: options.output_precision,
            result: &result,
            state: self.system.state(),
            levels: Vec::new(),
            seconds: self.seconds,
        };
        Ok(found.conclude())
    }

    fn advance(
        &mut self,
        options: &Options,
        iterations: usize,
        shares: &mut Shares<'_>,
    ) -> Result<SolveResult, Collapsed> {
        let free = self.free();
        let is_held = Cell::new(false);
        // The solve itself is never stopped by the callback, but held up after the next iteration.
        let mut tell = |fraction, iterations, step, phase| {
            let told = shares.tell(free, (fraction, iterations, step, phase));
            is_held.set(told.is_break());
            ControlFlow::Continue(())
        };
        let mut control = Control::new(options.tolerance, options.max_iterations, Some(&mut tell));
        control.tally = self.tally;
        let before = self.tally.iterations;
        loop {
            let step = self.ladder.advance(&mut self.system, &mut control)?;
            self.tally = control.tally;
            let done = self.tally.iterations - before;
            match step {
                Step::Ended(result) => {
                    self.end(&result);
                    return Ok(result);
                }
                Step::Iterated | Step::Unmoved if done == 0 => {}
                Step::Iterated | Step::Unmoved => {
                    if is_held.get() {
                        return Ok(self.at_hand(SolveStatus::Cancelled));
                    }
                    if done >= iterations {
                        return Ok(self.at_hand(SolveStatus::IterationLimit));
                    }
                }
            }
        }
    }

    /// After the end: the next solve begins at its surface, if that is not the linear one. The limit of iterations of the
    /// options may be hit again from there.
    fn end(&mut self, result: &SolveResult) {
        self.is_over = result.status != SolveStatus::IterationLimit;
        self.tally = Tally::default();
        self.ladder = if result.status.is_linear() {
            Ladder::default()
        } else {
            Ladder::resume(result.x.clone(), result.uniform_weights, result.along_normals)
        };
    }

    /// The surface of the last iteration.
    fn at_hand(&self, status: SolveStatus) -> SolveResult {
        let x = self.ladder.x().unwrap_or_default().to_vec();
        SolveResult {
            poor: self.system.poor(&x, NEEDLE),
            x,
            status,
            step: self.tally.step,
            defect: self.system.defect(),
            iterations: self.tally.iterations,
            uniform_weights: self.ladder.has_uniform_weights(),
            along_normals: self.ladder.is_along_normals(),
            trials: self.ladder.trials().to_vec(),
            continuity: Vec::new(),
            start_seconds: 0.0,
        }
    }

    /// The boundary normals of the options, on the same region, and where the surface passes smoothly instead.
    pub(super) fn boundary_normals(
        &self,
        options: &Options,
        given: &GivenNormals,
    ) -> Result<(Vec<Vector3<f64>>, Vec<bool>), Error> {
        let domain = &self.prepared.domain;
        boundary_normals(domain, &options.boundary_normals, given, options.interior_normals)
    }

    /// Takes other boundary normals, of which these are given.
    pub(super) fn prescribe(
        &mut self,
        given: &GivenNormals,
        (normals, smooth_interior): (Vec<Vector3<f64>>, Vec<bool>),
    ) {
        self.change();
        self.prepared.has_given_normal = given.at_boundary(&self.prepared.domain.region);
        self.system.prescribe(normals, smooth_interior);
    }

    /// Takes another right-hand side.
    pub(super) fn set_target(&mut self, target: Target) {
        self.change();
        let scale = self.prepared.normalization.scale;
        self.system.ask_right_hand_side(target.right_hand_side(scale));
    }

    /// Takes what the options say of the curvature along the boundary loops.
    pub(super) fn set_continuity(&mut self, options: &Options) {
        self.change();
        self.system
            .ask_continuity(self.prepared.asked_continuity(options));
    }

    /// The region with its rings.
    pub(super) fn domain(&self) -> &Domain {
        &self.prepared.domain
    }

    /// From here on it is another problem, close to the last.
    fn change(&mut self) {
        self.system.reset();
        self.ladder = std::mem::take(&mut self.ladder).renewed();
        self.tally = Tally::default();
        self.is_over = false;
    }
}
