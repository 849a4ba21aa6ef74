//! Where a [`Solver`](super::Solver) stands with one component: the solve that [`fair`](crate::fair) runs through, held up
//! between two iterations.

use std::sync::Arc;

use nalgebra::Vector3;

use crate::discrete::target::Target;
use crate::fairing::component_solution::ComponentSolution;
use crate::fairing::component_weights::ComponentWeights;
use crate::fairing::conclusion::Found;
use crate::fairing::edit::resolved::{Bend, ResolvedEdits};
use crate::fairing::normals::{GivenNormals, boundary_normals};
use crate::fairing::options::{Options, OutputPrecision};
use crate::fairing::prepared::Prepared;
use crate::fairing::report::Seconds;
use crate::mesh::RegionMesh;
use crate::quality::NEEDLE;
use crate::solve::control::Tally;
use crate::solve::factor::Collapsed;
use crate::solve::ladder::{Ladder, LadderState};
use crate::solve::live::{Allowance, Live};
use crate::solve::{Control, Domain, SolveResult, SolveStatus, System};
use crate::support::error::Error;
use crate::support::stopwatch::Stopwatch;

use super::edited::{Prescribed, Turn, Unedited};

/// Where a solve has ended.
#[derive(Clone)]
pub(super) struct SolvedSurface {
    /// None: at that of least bending.
    x: Option<Vec<Vector3<f64>>>,
    prescribed: Prescribed,
    ended: (f64, bool),
}

/// A solve under way.
pub(super) struct Cursor {
    prepared: Prepared,
    system: System,
    ladder: Ladder,
    tally: Tally,
    /// What frames are made of, from the first change after there is a surface.
    live: Option<Live>,
    /// Something was changed, and what has happened since are frames: the next run begins at their surface.
    is_live: bool,
    unedited: Unedited,
    /// Where the surface passes smoothly in place of having a prescribed normal; empty: nowhere.
    smooth_interior: Vec<bool>,
    /// Which boundary vertices have a normal from the caller, without edits.
    has_given_normal: Vec<bool>,
    prescribed: Prescribed,
    /// The domain has other positions of the fixed vertices than those prescribed.
    is_domain_old: bool,
    /// What a frame has ended with, until a run tells of it.
    untold: Option<SolveResult>,
    /// The step norm of the last end, and whether its surface solves what was asked, unfolded.
    ended: (f64, bool),
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
        let unedited = Unedited::new(&prepared.domain, prepared.problem().boundary_normals);
        let cursor = Self {
            smooth_interior: prepared.problem().smooth_interior.to_vec(),
            has_given_normal: prepared.has_given_normal.clone(),
            prescribed: unedited.prescribed.clone(),
            unedited,
            live: None,
            is_live: false,
            is_domain_old: false,
            untold: None,
            ended: (f64::INFINITY, false),
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

    /// Nothing is left to be done, nor to be told, until something is changed.
    pub(super) fn is_over(&self) -> bool {
        self.is_over && self.untold.is_none()
    }

    /// Whether the matrices are those of this region.
    pub(super) fn is_of(&self, region: &RegionMesh) -> bool {
        let own = &self.prepared.domain.region;
        own.vertex_ids == region.vertex_ids && own.half_edges.triangles == region.half_edges.triangles
    }

    /// At most this many iterations, or one if the callback asks to stop.
    pub(super) fn run(
        &mut self,
        options: &Options,
        iterations: usize,
        shares: &mut ComponentWeights<'_>,
    ) -> Result<ComponentSolution, Error> {
        let clock = Stopwatch::start();
        self.leave_frames();
        let result = match self.untold.take() {
            Some(result) => result,
            None => self.advance(options, iterations, shares)?,
        };
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
        shares: &mut ComponentWeights<'_>,
    ) -> Result<SolveResult, Error> {
        let free = self.free();
        // Given normals, edits and the target have their say in it, and may be other ones than in the last run.
        let (fixed, before) = (&self.prescribed.fixed, &self.unedited.prescribed.fixed);
        let asked = self.prepared.asked_continuity(options, |b| fixed[b] != before[b]);
        self.system.ask_continuity(asked);
        let mut tell =
            |fraction, iterations, step, phase| shares.tell(free, (fraction, iterations, step, phase));
        let mut control = Control::new(options.tolerance, options.max_iterations, Some(&mut tell));
        control.tally = self.tally;
        // The solve itself is never stopped by the callback, but held up after the next iteration.
        control.hold_after(iterations);
        let step = self.ladder.run(&mut self.system, &mut control);
        let step = step.map_err(|Collapsed| self.prepared.nothing_fixed())?;
        self.tally = control.tally;
        Ok(match step {
            LadderState::Ended(result) => {
                self.end(&result);
                result
            }
            _ if control.is_asked_to_hold() => self.at_hand(SolveStatus::Cancelled),
            _ => self.at_hand(SolveStatus::IterationLimit),
        })
    }

    /// After the end: the next solve begins at its surface, if that is not that of least bending. The limit of iterations of the
    /// options may be hit again from there.
    fn end(&mut self, result: &SolveResult) {
        self.is_over = result.status != SolveStatus::IterationLimit;
        let is_folded = || !self.system.poor(&result.x, 0.0).is_empty();
        self.ended = (
            result.step,
            self.is_over && !result.status.is_least_bending() && !is_folded(),
        );
        self.tally = Tally::default();
        self.ladder = if result.status.is_least_bending() {
            Ladder::default()
        } else {
            std::mem::take(&mut self.ladder).resumed_after(result)
        };
    }

    /// The surface of the last iteration.
    fn at_hand(&mut self, status: SolveStatus) -> SolveResult {
        self.ladder.evaluate_at_hand(&mut self.system);
        let formulation = self.ladder.formulation(&self.system);
        let x = self.ladder.x().unwrap_or_default().to_vec();
        SolveResult {
            poor: self.system.poor(&x, NEEDLE),
            x,
            status,
            step: self.tally.step,
            defect: self.system.defect(&formulation),
            iterations: self.tally.iterations,
            spread_otherwise: formulation.spreads_otherwise(),
            along_normals: formulation.along_normals,
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

    /// Takes other boundary normals, of which these are given, as those without edits.
    pub(super) fn ask_normals(
        &mut self,
        given: &GivenNormals,
        (normals, smooth_interior): (Vec<Vector3<f64>>, Vec<bool>),
    ) {
        self.has_given_normal = given.at_boundary(&self.prepared.domain.region);
        self.unedited.prescribed.normals = normals;
        self.smooth_interior = smooth_interior;
    }

    /// What is prescribed where these edits have moved fixed vertices.
    pub(super) fn moved(&self, edits: &ResolvedEdits) -> Prescribed {
        let Prepared {
            domain,
            normalization,
            ..
        } = &self.prepared;
        self.unedited.moved(edits, domain, normalization)
    }

    /// The first of its boundary loops through a vertex.
    pub(super) fn loop_of(&self, vertex: u32) -> Option<usize> {
        self.unedited.loop_of(&self.prepared.domain, vertex)
    }

    /// How the normals turn along all loops, by the bends of single ones, and by as much more everywhere.
    pub(super) fn turns(
        &self,
        bends: &[(usize, Bend)],
        bulge: f64,
        prescribed: &Prescribed,
    ) -> impl Iterator<Item = Turn> {
        let place = (&*self.prepared.domain, &self.prepared.normalization);
        (0..self.unedited.loops()).flat_map(move |k| {
            let of_loop = bends.iter().filter(|(l, _)| *l == k);
            let of_loop: Vec<Bend> = of_loop.map(|(_, bend)| *bend).collect();
            if of_loop.is_empty() && bulge == 0.0 {
                return Vec::new();
            }
            self.unedited.turns(k, &of_loop, bulge, place, prescribed)
        })
    }

    /// The boundary vertices, by the caller's numbers.
    pub(super) fn boundary(&self) -> &[u32] {
        let region = &self.prepared.domain.region;
        &region.vertex_ids[region.free..region.region_vertices()]
    }

    /// Follows what is prescribed. Where it is what was prescribed before, nothing is changed.
    pub(super) fn follow(&mut self, prescribed: Prescribed) {
        self.tell_given(&prescribed);
        let before = self.system.problem();
        if prescribed == self.prescribed && self.smooth_interior == before.smooth_interior {
            return;
        }
        let before = before.boundary_normals.to_vec();
        self.change();
        self.system
            .prescribe(prescribed.normals.clone(), self.smooth_interior.clone());
        self.is_domain_old |= prescribed.fixed != self.prescribed.fixed;
        self.prescribed = prescribed;
        self.aim(&before);
    }

    /// What is turned by edits is as the caller wants it.
    fn tell_given(&mut self, prescribed: &Prescribed) {
        let normals = self.has_given_normal.iter().zip(&prescribed.is_turned);
        self.prepared.has_given_normal = normals.map(|(given, turned)| given | turned).collect();
    }

    /// Takes another right-hand side.
    pub(super) fn set_target(&mut self, target: Target) {
        self.change();
        let scale = self.prepared.normalization.scale;
        self.system.ask_right_hand_side(target.right_hand_side(scale));
        self.aim(&[]);
    }

    /// The next run takes what its options say of the curvature along the boundary loops.
    pub(super) fn change_continuity(&mut self) {
        self.change();
        self.aim(&[]);
    }

    /// The vertices of its boundary loops, by the caller's numbers.
    pub(super) fn on_loops(&self) -> impl Iterator<Item = u32> + '_ {
        self.unedited.on_loops(&self.prepared.domain)
    }

    /// The region with its rings.
    pub(super) fn domain(&self) -> &Domain {
        &self.prepared.domain
    }

    /// From here on it is another problem, close to the last.
    fn change(&mut self) {
        self.ladder = std::mem::take(&mut self.ladder).renewed();
        self.tally = Tally::default();
        self.is_over = false;
        self.untold = None;
        let Some(x) = self.ladder.at_hand().filter(|_| !self.is_live) else {
            return;
        };
        match &mut self.live {
            Some(live) => live.take(x),
            None => {
                self.live = Some({
                    let (formulation, x) = (self.ladder.left(&self.system), x.to_vec());
                    Live::new(&mut self.system, formulation, x)
                })
            }
        }
        self.is_live = true;
    }

    /// The surface at hand sets out for what is prescribed now; `normals` were those before.
    fn aim(&mut self, normals: &[Vector3<f64>]) {
        if let Some(live) = self.live.as_mut().filter(|_| self.is_live) {
            let boundary = &self.prescribed.fixed[..self.prepared.domain.region.boundary];
            let formulation = self.ladder.left(&self.system);
            live.aim(&mut self.system, formulation, boundary, normals);
        }
    }

    /// One frame. Returns the step norm of its surface, and whether that has settled.
    pub(super) fn update(
        &mut self,
        options: &Options,
        tolerance: f64,
        allowance: &mut Allowance,
    ) -> Result<(f64, bool), Error> {
        if self.is_over {
            return Ok(self.ended);
        }
        if let Some(live) = self.live.as_mut().filter(|_| self.is_live) {
            live.frame(&mut self.system, tolerance, allowance);
            return Ok((live.step_norm(), live.is_settled(tolerance)));
        }
        self.sync_domain();
        while allowance.left() > 0 && !self.is_over {
            allowance.spent += 1;
            let mut nobody = ComponentWeights::new(None, 0.0, std::iter::empty());
            let result = self.advance(options, 1, &mut nobody)?;
            if self.is_over {
                self.untold = Some(result);
            } else if self.tally.iterations == 0 {
                // The limit of iterations was hit. A frame without a limit of its own would go on for ever where they lead nowhere.
                break;
            }
        }
        let step = if self.is_over {
            self.ended.0
        } else {
            self.tally.step
        };
        let step = if step.is_nan() { f64::INFINITY } else { step };
        Ok((step, self.is_over && self.ended.1))
    }

    /// The surface at hand, if there is one.
    fn x(&self) -> Option<&[Vector3<f64>]> {
        match &self.live {
            Some(live) if self.is_live => Some(live.shown()),
            _ => {
                let untold = self.untold.as_ref().map(|result| &result.x[..]);
                untold.or(self.ladder.x()).or(self.ladder.at_hand())
            }
        }
    }

    /// Writes the free vertices of the surface at hand to the host's; where they have not moved, as they were given.
    pub(super) fn show(&self, precision: OutputPrecision, given: &[[f64; 3]], shown: &mut [[f64; 3]]) {
        let Prepared {
            domain,
            normalization,
            ..
        } = &self.prepared;
        let Some(x) = self.x() else { return };
        let free = x.iter().zip(&domain.input).take(domain.region.free);
        for ((p, before), &v) in free.zip(&domain.region.vertex_ids) {
            shown[v as usize] = if p == before {
                given[v as usize]
            } else {
                precision.round(normalization.leave(p))
            };
        }
    }

    /// Where it stands, after a run to the end.
    pub(super) fn surface(&self) -> SolvedSurface {
        SolvedSurface {
            x: self.x().map(<[_]>::to_vec),
            prescribed: self.prescribed.clone(),
            ended: self.ended,
        }
    }

    /// Back to where it stood.
    pub(super) fn restore(&mut self, surface: SolvedSurface) {
        self.change();
        self.tell_given(&surface.prescribed);
        let normals = surface.prescribed.normals.clone();
        self.system.prescribe(normals, self.smooth_interior.clone());
        self.is_domain_old |= surface.prescribed.fixed != self.prescribed.fixed;
        self.prescribed = surface.prescribed;
        self.ended = surface.ended;
        (self.is_over, self.is_live) = (true, false);
        let ladder = std::mem::take(&mut self.ladder);
        self.ladder = match surface.x {
            Some(x) => ladder.resumed(x),
            None => Ladder::default(),
        };
    }

    /// The next run begins at the surface of the last frame.
    fn leave_frames(&mut self) {
        self.sync_domain();
        if std::mem::take(&mut self.is_live) {
            if let Some(live) = &mut self.live {
                live.refresh(&mut self.system);
            }
            let x = live_surface(&self.live).to_vec();
            self.ladder = std::mem::take(&mut self.ladder).resumed(x);
        }
    }

    /// The surroundings are where they are prescribed from now on.
    fn sync_domain(&mut self) {
        if std::mem::take(&mut self.is_domain_old) {
            let moved = Arc::new(self.prepared.domain.with_fixed(&self.prescribed.fixed));
            self.system.take_domain(&moved);
            self.prepared.domain = moved;
        }
    }
}

fn live_surface(live: &Option<Live>) -> &[Vector3<f64>] {
    live.as_ref().map_or(&[], Live::shown)
}
