//! Fairing in steps, for interactive programs: run some iterations, look, change what is asked, go on.
//!
//! The solver runs on a thread of its own and waits there between the steps. So the sequence of means of
//! [`solve`](crate::solve::globalize::solve) needs no second form: in steps it finds the same surface, bit by bit.

mod input;
mod worker;

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;

use super::{
    BoundaryNormals, Options, Progress, ProgressCallback, Selection, Solution, Solver, Target, with_threads,
};
use crate::error::Error;
use crate::mesh::Region;
use input::Input;
use worker::Problem;

/// One fairing problem, solved in steps by [`Solver::Fast`]. It owns copies of its input.
///
/// Without changes in between, any sequence of [`run`](Session::run)s finds the surface of [`fair`](super::fair) with the same
/// options, to the last bit. After a change of the boundary normals or of the target, the next run starts at the surface
/// at hand with the matrices at hand; where that leads to no sound surface, it begins anew, as `fair` does.
pub struct Session {
    commands: Option<Sender<Command>>,
    answers: Receiver<Answer>,
    thread: Option<JoinHandle<()>>,
    /// There from the beginning.
    solution: Option<Solution>,
    /// What the last run failed with.
    broken: Option<Error>,
    input: Arc<Input>,
    connectivity: Connectivity,
    target: Target,
}

/// What the matrices were made for.
#[derive(PartialEq)]
struct Connectivity {
    vertices: Vec<u32>,
    triangles: Vec<[u32; 3]>,
}

impl Connectivity {
    fn of(region: &Region) -> Self {
        Self {
            vertices: region.vertex_ids.clone(),
            triangles: region.half_edges.triangles.clone(),
        }
    }
}

enum Command {
    /// At most this many iterations.
    Run(usize),
    Normals(BoundaryNormals),
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

impl Session {
    /// Checks the input, and orders and analyses the matrices.
    ///
    /// # Errors
    /// Those of [`fair`](super::fair), and [`Error::BadOption`] for a solver other than [`Solver::Fast`].
    pub fn new(
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        selection: Selection<'_>,
        options: &Options,
    ) -> Result<Self, Error> {
        options.validate()?;
        if options.solver != Solver::Fast {
            return Err(Error::BadOption {
                name: "solver",
                value: 1.0,
                range: "the fast one for a fairing in steps",
            });
        }
        let input = Arc::new(Input::new(positions, triangles, selection, options));
        Self::start(input, &options.boundary_normals, options.target)
    }

    fn start(input: Arc<Input>, normals: &BoundaryNormals, target: Target) -> Result<Self, Error> {
        let threads = input.options.threads;
        let problem = Problem::new(input.clone(), normals)?;
        let normals = problem.normals(normals)?;
        let connectivity = Connectivity::of(&problem.region);
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
            input,
            connectivity,
            target,
        };
        session.wait(None)?;
        Ok(session)
    }

    /// Runs at most this many nonlinear iterations (at least one), and returns the surface: of the last iteration if the
    /// run was held up ([`IterationLimit`](crate::Outcome::IterationLimit), or [`Cancelled`](crate::Outcome::Cancelled) by
    /// the callback), else the final one. The next run goes on from there. Once the end is reached, a further run does
    /// nothing until something is changed.
    ///
    /// # Errors
    /// [`Error::NothingFixed`] where not even a linear surface exists.
    pub fn run(
        &mut self,
        iterations: usize,
        progress: Option<&mut ProgressCallback<'_>>,
    ) -> Result<&Solution, Error> {
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

    /// Asks for other boundary normals from now on. Where a curve of fixed vertices inside the region gets normals, or loses them,
    /// the region is another one, and the session begins anew.
    ///
    /// # Errors
    /// [`Error::BadNormal`], [`Error::NoNormal`]; the normals before then hold on.
    pub fn set_boundary_normals(&mut self, normals: BoundaryNormals) -> Result<(), Error> {
        if self.connectivity != Connectivity::of(&self.input.region(&normals)?) {
            // A curve inside has got its normals, or has lost them: the region is cut there.
            *self = Self::start(self.input.clone(), &normals, self.target)?;
            return Ok(());
        }
        self.change(Command::Normals(normals))
    }

    /// Asks for another right-hand side from now on.
    ///
    /// # Errors
    /// [`Error::BadOption`] for a constant that is not finite; the target before then holds on.
    pub fn set_target(&mut self, target: Target) -> Result<(), Error> {
        Options {
            target,
            ..Options::default()
        }
        .validate()?;
        self.change(Command::Target(target))?;
        self.target = target;
        Ok(())
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

    fn wait(&mut self, mut progress: Option<&mut ProgressCallback<'_>>) -> Result<(), Error> {
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
