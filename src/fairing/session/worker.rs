//! The thread of a [`Session`](super::Session).

use std::cell::{Cell, RefCell};
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender};
use std::time::Instant;

use nalgebra::Vector3;

use super::{Answer, Command, Input};
use crate::discrete::inner_fairness::FairnessWeights;
use crate::discrete::valence_batches::ValenceBatches;
use crate::error::Error;
use crate::fairing::normals::boundary_normals;
use crate::fairing::solvers::Faired;
use crate::fairing::{
    BoundaryNormals, Given, InnerFairness, Normalization, Outcome, Progress, Seconds, Solution, Target,
    conclude,
};
use crate::mesh::{Region, Rings};
use crate::quality::NEEDLE;
use crate::solve::globalize::{diagonal, resume};
use crate::solve::{Control, Ending, Solved, System, solve};

/// What the thread needs, all of it its own or shared.
pub(super) struct Problem {
    input: Arc<Input>,
    pub(super) region: Region,
    rings: Rings,
    batches: ValenceBatches,
    normalization: Normalization,
    /// The region's positions, in the normalization.
    x: Vec<Vector3<f64>>,
    clock: Instant,
}

/// A change that is known to be right.
enum Change {
    Normals(Vec<Vector3<f64>>, Vec<bool>),
    Target(Target),
}

/// Where the solver stands between two steps.
struct Desk<'a> {
    orders: &'a Receiver<Command>,
    answers: &'a Sender<Answer>,
    /// Iterations left of this run.
    left: Cell<usize>,
    /// The callback asked to stop this run.
    stopped: Cell<bool>,
    /// What ended the solve before its time.
    change: RefCell<Option<Change>>,
    /// Nobody waits for the surface any more.
    closed: Cell<bool>,
}

impl Desk<'_> {
    fn tell(&self, progress: Progress) {
        // Who has asked to stop is not asked again.
        if self.stopped.get() {
            return;
        }
        let _ = self.answers.send(Answer::Progress(progress));
        match self.orders.recv() {
            Ok(Command::GoOn(answer)) => self.stopped.set(answer.is_break()),
            _ => self.close(),
        }
    }

    fn close(&self) {
        self.closed.set(true);
        self.stopped.set(true);
    }

    fn deliver(&self, result: Result<Solution, Error>) {
        let _ = self.answers.send(Answer::Surface(Box::new(result)));
    }

    /// Waits for the next run. `Break`: something has been changed, or it is over.
    fn pause(&self, problem: &Problem) -> ControlFlow<()> {
        loop {
            match self.orders.recv() {
                Ok(Command::Run(iterations)) => {
                    self.left.set(iterations);
                    self.stopped.set(false);
                    return ControlFlow::Continue(());
                }
                Ok(Command::GoOn(_)) => {}
                Ok(command) => {
                    let change = problem.prepared(command);
                    let answer = change.as_ref().map(|_| ()).map_err(Clone::clone);
                    let _ = self.answers.send(Answer::Changed(answer));
                    if let Ok(change) = change {
                        self.change.replace(change);
                        return ControlFlow::Break(());
                    }
                }
                Err(_) => {
                    self.close();
                    return ControlFlow::Break(());
                }
            }
        }
    }
}

impl Problem {
    /// Checks and prepares the region.
    pub(super) fn new(input: Arc<Input>, normals: &BoundaryNormals) -> Result<Self, Error> {
        let clock = Instant::now();
        let region = input.region(normals)?;
        let rings = Rings::new(&region);
        let mut x = region.positions(&input.positions);
        let normalization = Normalization::new(&region, &x);
        normalization.enter(&mut x);
        Ok(Self {
            batches: ValenceBatches::new(&rings),
            input,
            region,
            rings,
            normalization,
            x,
            clock,
        })
    }

    pub(super) fn normals(&self, asked: &BoundaryNormals) -> Result<(Vec<Vector3<f64>>, Vec<bool>), Error> {
        let interior = self.input.options.interior_normals;
        boundary_normals(&self.region, &self.rings, &self.x, asked, interior)
    }

    fn prepared(&self, command: Command) -> Result<Option<Change>, Error> {
        match command {
            Command::Normals(normals) => {
                let (normals, smooth_interior) = self.normals(&normals)?;
                Ok(Some(Change::Normals(normals, smooth_interior)))
            }
            Command::Target(target) => Ok(Some(Change::Target(target))),
            Command::Run(_) | Command::GoOn(_) => Ok(None),
        }
    }

    /// The life of the thread.
    pub(super) fn serve(
        &self,
        (normals, smooth_interior): (Vec<Vector3<f64>>, Vec<bool>),
        mut target: Target,
        orders: &Receiver<Command>,
        answers: &Sender<Answer>,
    ) {
        let desk = Desk {
            orders,
            answers,
            left: Cell::new(0),
            stopped: Cell::new(false),
            change: RefCell::new(None),
            closed: Cell::new(false),
        };
        let weights = match self.input.options.inner_fairness {
            InnerFairness::Uniform => FairnessWeights::uniform(),
            InnerFairness::Conformal => FairnessWeights::conformal(&self.batches, &self.x),
            InnerFairness::Convex => FairnessWeights::convex(&self.batches, &self.x),
        };
        let mut seconds = Seconds {
            setup: self.clock.elapsed().as_secs_f64(),
            ..Seconds::default()
        };
        let mut system = System::new(
            &self.region,
            &self.rings,
            &self.batches,
            &self.x,
            normals,
            weights.clone(),
            self.input.curvature(),
        );
        system.smooth_interior = smooth_interior;
        system.right_hand_side = target.right_hand_side(self.normalization.scale);
        let mut x = self.x[..self.region.region_vertices()].to_vec();
        system.diagonal = diagonal(&x);
        system.evaluate(&x);
        let given = |target| Given {
            positions: &self.input.positions,
            target,
            region: &self.region,
            rings: &self.rings,
            input: &self.x,
            normalization: &self.normalization,
            fallback_weights: weights.clamped,
        };
        let first = measured(&system, &x, 0, f64::NAN);
        let first = conclude(&given(target), first, seconds, self.clock);
        desk.deliver(Ok(first));
        // Whether x is a surface to start from.
        let (mut warm, mut even, mut ended) = (false, false, None::<Solution>);
        loop {
            if desk.change.borrow().is_none() && desk.pause(self).is_continue() {
                if let Some(solution) = &ended {
                    desk.deliver(Ok(solution.clone()));
                    continue;
                }
                seconds.setup = seconds.setup.min(self.clock.elapsed().as_secs_f64());
                let clock = Instant::now();
                system.curvature = self.input.curvature();
                let mut progress = |fraction, iterations, step, stage| {
                    desk.tell(Progress {
                        fraction,
                        iterations,
                        step,
                        stage,
                    });
                    // Before the first iteration there is nothing to hold up at.
                    if desk.closed.get() {
                        ControlFlow::Break(())
                    } else {
                        ControlFlow::Continue(())
                    }
                };
                let mut watch = |system: &System<'_>, x: &[Vector3<f64>], iterations, step| {
                    desk.left.set(desk.left.get().saturating_sub(1));
                    if desk.left.get() > 0 && !desk.stopped.get() {
                        return ControlFlow::Continue(());
                    }
                    let faired = measured(system, x, iterations, step);
                    let mut solution = conclude(&given(target), faired, seconds, clock);
                    if desk.stopped.get() {
                        solution.report.outcome = Outcome::Cancelled;
                    }
                    desk.deliver(Ok(solution));
                    desk.pause(self)
                };
                let mut control = Control::new(
                    self.input.options.tolerance,
                    self.input.options.max_iterations,
                    Some(&mut progress),
                );
                control.watch = Some(&mut watch);
                // The weights stay what they have become.
                let resumed = if warm {
                    resume(&mut system, &x, &mut control)
                } else {
                    None
                };
                let solved = match resumed {
                    Some(solved) => Ok(Solved { even, ..solved }),
                    None => {
                        let _ = system.set_weights(weights.clone());
                        system.curvature = self.input.curvature();
                        solve(&mut system, &mut control)
                    }
                };
                let iterations = control.iterations;
                let Ok(solved) = solved else {
                    desk.deliver(Err(Error::NothingFixed { vertex: 0 }));
                    return;
                };
                if desk.closed.get() {
                    return;
                }
                warm = !matches!(
                    solved.ending,
                    Ending::Failed | Ending::Partly(..) | Ending::Loaded(..)
                );
                even = solved.even;
                x.clone_from(&solved.x);
                if desk.change.borrow().is_none() {
                    system.evaluate(&x);
                    // The limit of the options may be hit again from here.
                    let over = solved.ending != Ending::Stopped;
                    let faired = Faired {
                        solved,
                        ..measured(&system, &x, iterations, f64::NAN)
                    };
                    let solution = conclude(&given(target), faired, seconds, clock);
                    ended = over.then(|| solution.clone());
                    desk.deliver(Ok(solution));
                }
            }
            if desk.closed.get() {
                return;
            }
            match desk.change.take() {
                Some(Change::Normals(normals, smooth_interior)) => {
                    system.boundary_normals = normals;
                    system.smooth_interior = smooth_interior;
                    ended = None;
                }
                Some(Change::Target(asked)) => {
                    target = asked;
                    system.right_hand_side = asked.right_hand_side(self.normalization.scale);
                    ended = None;
                }
                None => {}
            }
        }
    }
}

/// The surface `x`, evaluated last, as one that the iteration was stopped at.
fn measured(system: &System<'_>, x: &[Vector3<f64>], iterations: usize, step: f64) -> Faired {
    let (defect, _) = system.equations().defect(&system.state);
    Faired {
        solved: Solved {
            x: x.to_vec(),
            ending: Ending::Stopped,
            step,
            poor: system.poor(x, NEEDLE),
            start_seconds: 0.0,
            even: false,
        },
        defect: defect * system.diagonal,
        state: system.state.clone(),
        boundary_normals: system.boundary_normals.clone(),
        iterations,
        cancelled: false,
        levels: Vec::new(),
        rounding: false,
    }
}
