//! Fairing in steps, for interactive programs: run some iterations, look, change what is asked, go on.
//!
//! The solver runs on a thread of its own and waits there between the steps. So the sequence of means of
//! [`solve`](crate::solve::globalize::solve) needs no second form: in steps it finds the same surface, bit by bit.

use std::cell::{Cell, RefCell};
use std::ops::ControlFlow;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;
use std::time::Instant;

use nalgebra::Vector3;

use super::normals::border_normals;
use super::solvers::Faired;
use super::{
    BorderNormals, Discretization, Frame, Given, InnerFairness, InteriorNormals, Options, Outcome, Progress,
    Seconds, Selection, Solution, Solver, Target, Watcher, check, conclude, with_threads,
};
use crate::discrete::curvature::TILT_RIDGE;
use crate::discrete::equations::FreeCurvature;
use crate::discrete::groups::Groups;
use crate::discrete::inner_fairness::FairnessWeights;
use crate::error::Error;
use crate::mesh::{Region, Rings};
use crate::quality::NEEDLE;
use crate::solve::globalize::{diagonal, resume};
use crate::solve::{Control, Ending, Solved, System, solve};

/// One fairing problem, solved in steps by [`Solver::Fast`]. It owns copies of its input.
///
/// Without changes in between, any sequence of [`run`](Session::run)s finds the surface of [`fair`](super::fair) with the same
/// options, to the last bit. After a change of the border normals or of the target, the next run starts at the surface
/// at hand with the matrices at hand; where that leads to no sound surface, it begins anew, as `fair` does.
pub struct Session {
    commands: Option<Sender<Command>>,
    answers: Receiver<Answer>,
    thread: Option<JoinHandle<()>>,
    /// There from the beginning.
    solution: Option<Solution>,
    /// What the last run failed with.
    broken: Option<Error>,
}

/// Normals that outlive the call.
enum Normals {
    Fitted,
    Averaged,
    Given(Vec<(u32, [f64; 3])>),
}

impl Normals {
    fn new(normals: BorderNormals<'_>) -> Self {
        match normals {
            BorderNormals::Fitted => Self::Fitted,
            BorderNormals::Averaged => Self::Averaged,
            BorderNormals::Given(list) => Self::Given(list.to_vec()),
        }
    }

    fn as_asked(&self) -> BorderNormals<'_> {
        match self {
            Self::Fitted => BorderNormals::Fitted,
            Self::Averaged => BorderNormals::Averaged,
            Self::Given(list) => BorderNormals::Given(list),
        }
    }
}

enum Command {
    /// At most this many iterations.
    Run(usize),
    Normals(Normals),
    Target(Target),
    /// The answer to [`Answer::Progress`].
    GoOn(ControlFlow<()>),
}

enum Answer {
    /// The end of a run or of the setup.
    Surface(Box<Result<Solution, Error>>),
    Changed(Result<(), Error>),
    Progress(Progress),
}

/// What the thread needs, all of it its own.
struct Problem {
    positions: Vec<[f64; 3]>,
    region: Region,
    rings: Rings,
    groups: Groups,
    frame: Frame,
    /// The region's positions, in the frame.
    x: Vec<Vector3<f64>>,
    interior: InteriorNormals,
    inner: InnerFairness,
    curvature: FreeCurvature,
    tolerance: f64,
    max_iterations: usize,
    clock: Instant,
}

/// A change that is known to be right.
enum Change {
    Normals(Vec<Vector3<f64>>, Vec<bool>),
    Target(Target),
}

impl Session {
    /// Checks the input, and orders and analyses the matrices. `progress` of the options is not used.
    ///
    /// # Errors
    /// Those of [`fair`](super::fair), and [`Error::BadOption`] for a solver other than [`Solver::Fast`].
    pub fn new(
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        selection: Selection<'_>,
        options: &Options<'_>,
    ) -> Result<Self, Error> {
        check(options)?;
        if options.solver != Solver::Fast {
            return Err(Error::BadOption {
                name: "solver",
                value: 1.0,
                range: "the fast one for a fairing in steps",
            });
        }
        let clock = Instant::now();
        let region = Region::new(positions, triangles, selection)?;
        let rings = Rings::new(&region);
        let mut x = region.positions(positions);
        let frame = Frame::new(&region, &x);
        frame.enter(&mut x);
        let problem = Problem {
            positions: positions.to_vec(),
            groups: Groups::new(&rings),
            region,
            rings,
            frame,
            x,
            interior: options.interior,
            inner: options.inner,
            curvature: match options.discretization {
                Discretization::SecondOrder => FreeCurvature::GradientCorrected {
                    tilt_ridge: TILT_RIDGE,
                },
                Discretization::Paper => FreeCurvature::Paper,
            },
            tolerance: options.tolerance,
            max_iterations: options.max_iterations,
            clock,
        };
        let normals = problem.normals(options.normals)?;
        let (target, threads) = (options.target, options.threads);
        let ((commands, orders), (answer, answers)) = (channel(), channel());
        let failed = answer.clone();
        let thread = std::thread::Builder::new().spawn(move || {
            let served = with_threads(threads, |pool| {
                pool.install(move || problem.serve(normals, target, &orders, &answer));
            });
            if let Err(error) = served {
                let _ = failed.send(Answer::Surface(Box::new(Err(error))));
            }
        });
        let thread = thread.map_err(|e| Error::Threads {
            threads: 1,
            why: e.to_string(),
        })?;
        let mut session = Self {
            commands: Some(commands),
            answers,
            thread: Some(thread),
            solution: None,
            broken: None,
        };
        session.wait(None)?;
        Ok(session)
    }

    /// Runs at most this many nonlinear iterations (at least one), and returns the surface: of the last iteration if the
    /// run was held up ([`Outcome::IterationLimit`], or [`Outcome::Cancelled`] by the callback), else the final one. The next
    /// run goes on from there. Once the end is reached, a further run does nothing until something is changed.
    ///
    /// # Errors
    /// [`Error::NothingFixed`] where not even a linear surface exists.
    pub fn run(&mut self, iterations: usize, progress: Option<&mut Watcher<'_>>) -> Result<&Solution, Error> {
        if let Some(error) = &self.broken {
            return Err(error.clone());
        }
        self.send(Command::Run(iterations.max(1)));
        if let Err(error) = self.wait(progress) {
            self.broken = Some(error.clone());
            return Err(error);
        }
        Ok(self.solution())
    }

    /// Asks for other border normals from now on.
    ///
    /// # Errors
    /// [`Error::BadNormal`], [`Error::NoNormal`]; the normals before then hold on.
    pub fn set_border_normals(&mut self, normals: BorderNormals<'_>) -> Result<(), Error> {
        self.change(Command::Normals(Normals::new(normals)))
    }

    /// Asks for another right-hand side from now on.
    ///
    /// # Errors
    /// [`Error::BadOption`] for a constant that is not finite; the target before then holds on.
    pub fn set_target(&mut self, target: Target) -> Result<(), Error> {
        check(&Options {
            target,
            ..Options::default()
        })?;
        self.change(Command::Target(target))
    }

    /// The surface of the last run; before the first one, the input's.
    pub fn solution(&self) -> &Solution {
        match &self.solution {
            Some(solution) => solution,
            None => unreachable!("the setup ends with a surface"),
        }
    }

    fn change(&mut self, command: Command) -> Result<(), Error> {
        if let Some(error) = &self.broken {
            return Err(error.clone());
        }
        self.send(command);
        match self.answers.recv() {
            Ok(Answer::Changed(answer)) => answer,
            _ => self.gone(),
        }
    }

    fn send(&mut self, command: Command) {
        // A thread that is gone is noticed where its answer is missing.
        let _ = self.commands.as_ref().map(|c| c.send(command));
    }

    fn wait(&mut self, mut progress: Option<&mut Watcher<'_>>) -> Result<(), Error> {
        loop {
            match self.answers.recv() {
                Ok(Answer::Progress(told)) => {
                    let answer = progress
                        .as_mut()
                        .map_or(ControlFlow::Continue(()), |callback| callback(&told));
                    self.send(Command::GoOn(answer));
                }
                Ok(Answer::Surface(result)) => {
                    self.solution = Some((*result)?);
                    return Ok(());
                }
                Ok(Answer::Changed(_)) | Err(_) => return self.gone(),
            }
        }
    }

    /// The thread has panicked: so does the caller.
    fn gone<T>(&mut self) -> T {
        self.commands = None;
        match self.thread.take().map(JoinHandle::join) {
            Some(Err(panic)) => std::panic::resume_unwind(panic),
            _ => panic!("the solver's thread has ended"),
        }
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        self.commands = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
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
        let _ = self.answers.send(Answer::Progress(progress));
        match self.orders.recv() {
            Ok(Command::GoOn(answer)) => self.stopped.set(self.stopped.get() | answer.is_break()),
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
    fn normals(&self, asked: BorderNormals<'_>) -> Result<(Vec<Vector3<f64>>, Vec<bool>), Error> {
        border_normals(&self.region, &self.rings, &self.x, asked, self.interior)
    }

    fn prepared(&self, command: Command) -> Result<Option<Change>, Error> {
        match command {
            Command::Normals(normals) => {
                let (normals, passing) = self.normals(normals.as_asked())?;
                Ok(Some(Change::Normals(normals, passing)))
            }
            Command::Target(target) => Ok(Some(Change::Target(target))),
            Command::Run(_) | Command::GoOn(_) => Ok(None),
        }
    }

    /// The life of the thread.
    fn serve(
        &self,
        (normals, passing): (Vec<Vector3<f64>>, Vec<bool>),
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
        let weights = match self.inner {
            InnerFairness::Uniform => FairnessWeights::uniform(),
            InnerFairness::Conformal => FairnessWeights::conformal(&self.groups, &self.x),
            InnerFairness::Convex => FairnessWeights::convex(&self.groups, &self.x),
        };
        let mut seconds = Seconds {
            setup: self.clock.elapsed().as_secs_f64(),
            ..Seconds::default()
        };
        let mut system = System::new(
            &self.region,
            &self.rings,
            &self.groups,
            &self.x,
            normals,
            weights.clone(),
            self.curvature,
        );
        system.passing = passing;
        system.right_hand_side = target.right_hand_side(self.frame.scale);
        let mut x = self.x[..self.region.region_vertices()].to_vec();
        system.diagonal = diagonal(&x);
        system.evaluate(&x);
        let given = |target| Given {
            positions: &self.positions,
            target,
            region: &self.region,
            rings: &self.rings,
            input: &self.x,
            frame: &self.frame,
            fallback_weights: weights.clamped,
        };
        let first = measured(&system, &x, 0, f64::NAN);
        let mut first = conclude(&given(target), first, seconds, self.clock);
        // Without the rounding of the frame.
        first.positions.clone_from(&self.positions);
        desk.deliver(Ok(first));
        // Whether x is a surface to start from.
        let (mut warm, mut ended) = (false, None::<Solution>);
        loop {
            if desk.change.borrow().is_none() && desk.pause(self).is_continue() {
                if let Some(solution) = &ended {
                    desk.deliver(Ok(solution.clone()));
                    continue;
                }
                seconds.setup = seconds.setup.min(self.clock.elapsed().as_secs_f64());
                let clock = Instant::now();
                system.curvature = self.curvature;
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
                let mut control = Control::new(self.tolerance, self.max_iterations, Some(&mut progress));
                control.watch = Some(&mut watch);
                let resumed = if warm {
                    resume(&mut system, &x, &mut control)
                } else {
                    None
                };
                let solved = match resumed {
                    Some(solved) => Ok(solved),
                    None => {
                        let _ = system.set_weights(weights.clone());
                        system.curvature = self.curvature;
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
                Some(Change::Normals(normals, passing)) => {
                    system.border_normals = normals;
                    system.passing = passing;
                    ended = None;
                }
                Some(Change::Target(asked)) => {
                    target = asked;
                    system.right_hand_side = asked.right_hand_side(self.frame.scale);
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
        },
        defect: defect * system.diagonal,
        state: system.state.clone(),
        border_normals: system.border_normals.clone(),
        iterations,
        cancelled: false,
        levels: Vec::new(),
        rounding: false,
    }
}
