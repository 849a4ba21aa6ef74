//! Fairing in steps, for interactive programs: run some iterations, look, change what is asked, go on.

mod bulge;
mod cursor;
mod edited;
mod live;

use super::boundary_curvature::BoundaryCurvature;
use super::component_solution::ComponentSolution;
use super::continuity::check_loops;
use super::edit::Edit;
use super::edit::resolved::{Followers, ResolvedEdits};
use super::joined::{in_given, joined_curvature, joined_loops, joined_normals, joined_options, spread};
use super::normals::BoundaryNormals;
use super::normals::GivenNormals;
use super::options::{Options, SolverKind};
use super::outcome::Outcome;
use super::prepared::{Prepared, regions};
use super::report::{ProgressCallback, Solution};
use super::whole_solution::whole;
use crate::discrete::target::Target;
use crate::fairing::component_weights::ComponentWeights;
use crate::fairing::workers::{Workers, relay};
use crate::mesh::selection::Selection;
use std::borrow::Cow;

use crate::mesh::coincident::{Copies, SelectedElements};
use crate::mesh::{Joined, RegionMesh};
use crate::solve::control::Callback;
use crate::support::error::Error;
use crate::support::stopwatch::Stopwatch;
use cursor::Cursor;

/// One fairing problem, solved in steps by [`SolverKind::Fast`]. It owns copies of its input.
///
/// Each component of the region (see [`ComponentReport`](crate::ComponentReport)) is held up and goes on by itself.
/// Without changes in between, any sequence of [`run`](Solver::run)s finds the surface of [`fair`](super::fair) with the same
/// options, to the last bit. After a change of the boundary normals, of continuity or of the target, the next run starts at the surface
/// at hand with the matrices at hand; where that leads to no sound surface, it begins anew, as `fair` does.
///
/// While something is dragged, [`edit`](Solver::edit) changes the boundary, and [`update`](Solver::update) makes frames of
/// [`positions`](Solver::positions); [`finish`](Solver::finish) ends the drag. For a degree of tilt a frame takes two to eight evaluations of
/// the equations. What is finished is the surface of a fresh solve of the edited problem, to 1e-8 of the diagonal with the default tolerance, except
/// where there are several: then it is the one that the drag leads to. Where no surface meets the inner fairness that is asked for
/// ([`fallback_weights`](crate::Report::fallback_weights)), its vertices lie where the drag has left them.
///
/// ```
/// # // A plane of 7 by 7 vertices with a bump; the nine in the middle are free.
/// # let at = |v: u32| [f64::from(v % 7), f64::from(v / 7), if v == 24 { 1.0 } else { 0.0 }];
/// # let positions: Vec<[f64; 3]> = (0..49).map(at).collect();
/// # let cell = |c: u32| { let v = c / 6 * 7 + c % 6; [[v, v + 1, v + 8], [v, v + 8, v + 7]] };
/// # let triangles: Vec<[u32; 3]> = (0..36).flat_map(cell).collect();
/// # let free = [16, 17, 18, 23, 24, 25, 30, 31, 32];
/// use fairmesh::{BoundaryNormals, Budget, Edit, Options, Outcome, Selection, Solver, Target};
///
/// let mut solver = Solver::new(&positions, &triangles, Selection::Vertices(&free), &Options::default())?;
/// let after_one = solver.run(1, None)?;
/// assert_eq!(after_one.report.outcome, Outcome::IterationLimit);
/// let plane = solver.run(100, None)?;
/// assert!(plane.report.outcome.is_success() && plane.positions[24][2].abs() < 1e-7);
///
/// // Other conditions: the next run starts at the surface at hand.
/// solver.set_boundary_normals(BoundaryNormals::Averaged)?;
/// solver.set_target(Target::Constant(0.01))?;
/// assert!(solver.run(100, None)?.report.iterations > 0);
/// assert!(solver.solution().positions[24][2] > 1e-4); // pushed out along the normals
///
/// // A drag: the boundary leans outward, frame by frame.
/// solver.set_target(Target::Harmonic)?;
/// for k in 1..=5 {
///     solver.edit(&[Edit::Bulge { amount: 0.02 * f64::from(k) }])?;
///     let frame = solver.update(&Budget::default())?;
///     assert!(frame.is_settled && solver.positions()[24][2] > 0.01 * f64::from(k));
/// }
/// assert!(solver.finish(None)?.report.outcome.is_success());
/// # Ok::<(), fairmesh::Error>(())
/// ```
pub struct Solver {
    input: Input,
    components: Components,
    /// The free vertices, ascending.
    free: Vec<u32>,
    edited: Edited,
    /// Of all copies.
    solution: Solution,
    /// The positions of the last frame or run, of all copies.
    shown: Vec<[f64; 3]>,
    /// What the last run failed with.
    broken: Option<Error>,
    workers: Workers,
}

/// Continuity of curvature may be asked for later: the regions are the same then.
const IS_WIDE: bool = true;

/// The edits in force.
#[derive(Default)]
struct Edited {
    list: Vec<Edit>,
    resolved: ResolvedEdits,
    followers: Followers,
}

/// What was asked, in the solver's own memory, of the joined mesh. Changes go into the options.
struct Input {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    selection: SelectedElements<'static>,
    options: Options,
    copies: Copies,
}

impl Input {
    fn selection(&self) -> Selection<'_> {
        self.selection.selection()
    }

    /// The regions of the components, cut where these normals ask for it.
    fn regions(&self, given: &GivenNormals) -> Result<Vec<RegionMesh>, Error> {
        regions(
            &self.positions,
            &self.triangles,
            self.selection(),
            given,
            (&self.options.solver, IS_WIDE),
        )
    }

    fn prepared(&self) -> Result<Vec<Prepared>, Error> {
        Prepared::of_components(
            &self.positions,
            &self.triangles,
            self.selection(),
            &self.options,
            IS_WIDE,
        )
    }

    /// All components at their beginning, and their solution.
    fn begin(&self) -> Result<(Components, Solution), Error> {
        let components = Components::new(self)?;
        let solution = self.whole(&components, &ResolvedEdits::default());
        Ok((components, solution))
    }

    /// All components so many iterations on, and their solution.
    fn run<'t>(
        &self,
        components: &mut Components,
        edits: &ResolvedEdits,
        iterations: usize,
        told: Option<&'t mut Callback<'t>>,
    ) -> Result<Solution, Error> {
        components.run(self, iterations, told)?;
        Ok(self.whole(components, edits))
    }

    /// The positions with what edits have moved.
    fn edited(&self, edits: &ResolvedEdits) -> Cow<'_, [[f64; 3]]> {
        let mut positions = Cow::Borrowed(&self.positions[..]);
        for moved in &edits.moved {
            positions.to_mut()[moved.vertex as usize] = moved.at;
        }
        positions
    }

    /// The solution of all components. On the workers: it looks for intersections on all of them.
    fn whole(&self, components: &Components, edits: &ResolvedEdits) -> Solution {
        let edited = self.edited(edits);
        let mut solution = whole(&edited, &self.triangles, &self.options, &components.solutions);
        spread(&mut solution, &edited, &self.copies);
        solution
    }
}

/// All components: where each stands, and what came of it so far.
struct Components {
    cursors: Vec<Cursor>,
    solutions: Vec<ComponentSolution>,
}

impl Components {
    fn new(input: &Input) -> Result<Self, Error> {
        let clock = Stopwatch::start();
        let prepared = input.prepared()?;
        let seconds = clock.seconds() / prepared.len() as f64;
        let begun = prepared
            .into_iter()
            .map(|prepared| Cursor::new(prepared, input.options.output_precision, seconds));
        let (cursors, solutions) = begun.unzip();
        Ok(Self { cursors, solutions })
    }

    /// Nothing is left to be done, until something is changed.
    fn are_over(&self) -> bool {
        self.cursors.iter().all(Cursor::is_over)
    }

    /// At most this many iterations of each component. After the callback has asked to stop, the others stay where they are.
    fn run<'a>(
        &mut self,
        input: &Input,
        iterations: usize,
        told: Option<&'a mut Callback<'a>>,
    ) -> Result<(), Error> {
        let stand = self.cursors.iter().map(|c| (c.free(), c.fraction()));
        let mut shares = ComponentWeights::new(told, 0.0, stand);
        for (cursor, solution) in self.cursors.iter_mut().zip(&mut self.solutions) {
            if cursor.is_over() {
                continue;
            }
            if shares.is_stopped() {
                solution.report.outcome = Outcome::Cancelled;
                continue;
            }
            shares.begin(cursor.free(), cursor.fraction());
            *solution = cursor.run(&input.options, iterations, &mut shares)?;
            shares.end(cursor.free(), cursor.fraction());
        }
        Ok(())
    }

    /// Takes the boundary normals of the options, on the same regions, with the edits in force.
    fn set_boundary_normals(
        &mut self,
        options: &Options,
        given: &GivenNormals,
        edits: &ResolvedEdits,
    ) -> Result<(), Error> {
        let normals = self.cursors.iter().map(|c| c.boundary_normals(options, given));
        let normals: Vec<_> = normals.collect::<Result<_, _>>()?;
        for (cursor, normals) in self.cursors.iter_mut().zip(normals) {
            cursor.ask_normals(given, normals);
        }
        self.edit(edits)
    }

    /// The same on other regions, where all begins anew.
    fn begun_anew(input: &Input, edits: &ResolvedEdits) -> Result<(Self, Solution), Error> {
        let (mut components, solution) = input.begin()?;
        components.edit(edits)?;
        Ok((components, solution))
    }
}

impl Solver {
    /// Checks the input, and orders and analyses the matrices.
    ///
    /// # Errors
    /// Those of [`fair`](super::fair), and [`Error::BadOption`] for a solver other than [`SolverKind::Fast`].
    pub fn new(
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        selection: Selection<'_>,
        options: &Options,
    ) -> Result<Self, Error> {
        options.validate()?;
        if options.solver != SolverKind::Fast {
            return Err(Error::BadOption {
                name: "solver",
                value: 1.0,
                range: "the fast one for a fairing in steps",
            });
        }
        let Joined { triangles, copies } = Joined::new(positions, triangles, options.coincident)?;
        let input = Input {
            positions: positions.to_vec(),
            triangles: triangles.into_owned(),
            selection: copies.selection(selection).into_owned(),
            options: joined_options(&copies, options).into_owned(),
            copies,
        };
        let workers = Workers::new(options.threads)?;
        let (components, solution) = workers
            .install(|| input.begin())
            .map_err(|error| in_given(error, &input.copies, options))?;
        Ok(Self {
            free: components.free(),
            edited: Edited::default(),
            shown: solution.positions.clone(),
            solution,
            input,
            components,
            broken: None,
            workers,
        })
    }

    /// Runs at most this many nonlinear iterations (at least one) of each component, and returns the surface: of the last iteration if the
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
        if self.components.are_over() {
            return Ok(&self.solution);
        }
        let iterations = iterations.max(1);
        let (input, components, edits) = (&self.input, &mut self.components, &self.edited.resolved);
        let ran = match progress {
            None => self
                .workers
                .install(|| input.run(components, edits, iterations, None)),
            // A run that is held up goes on later: no factorization is to be broken off.
            Some(callback) => {
                relay(
                    &self.workers,
                    callback,
                    false,
                    |told| {
                        let ran = input.run(components, edits, iterations, Some(told));
                        (ran, components.are_over())
                    },
                    |(ran, is_over)| ran.is_ok() && *is_over,
                )?
                .0
            }
        };
        match ran {
            Ok(solution) => {
                self.shown.clone_from(&solution.positions);
                self.solution = solution;
                Ok(&self.solution)
            }
            Err(error) => {
                self.broken = Some(error.clone());
                Err(error)
            }
        }
    }

    /// Asks for other boundary normals from now on. Where a curve of fixed vertices inside the region gets normals, or loses them,
    /// the region is another one, and the solver begins anew.
    ///
    /// # Errors
    /// [`Error::BadNormal`], [`Error::NoNormal`]; the normals before then hold on.
    pub fn set_boundary_normals(&mut self, normals: BoundaryNormals) -> Result<(), Error> {
        if let Some(error) = &self.broken {
            return Err(error.clone());
        }
        let given = Options {
            boundary_normals: normals,
            ..Options::default()
        };
        let normals = joined_normals(&self.input.copies, &given.boundary_normals).into_owned();
        let prescribed = GivenNormals::new(&normals);
        let regions = self.input.regions(&prescribed)?;
        let before = std::mem::replace(&mut self.input.options.boundary_normals, normals);
        let (input, cursors, edits) = (&self.input, &self.components.cursors, &self.edited.resolved);
        let is_same = cursors.len() == regions.len() && cursors.iter().zip(&regions).all(|(c, r)| c.is_of(r));
        let changed = if is_same {
            let components = &mut self.components;
            self.workers
                .install(|| components.set_boundary_normals(&input.options, &prescribed, edits))
        } else {
            let anew = self.workers.install(|| Components::begun_anew(input, edits));
            anew.map(|anew| (self.components, self.solution) = anew)
        };
        if changed.is_err() {
            self.input.options.boundary_normals = before;
        }
        changed.map_err(|error| in_given(error, &self.input.copies, &given))
    }

    /// Asks for another [`continuity`](Options::continuity) from now on, and for that of single loops, see
    /// [`Options::loop_continuity`].
    ///
    /// # Errors
    /// [`Error::BadOption`], [`Error::NotOnLoop`]; what was asked before then holds on.
    pub fn set_continuity(&mut self, continuity: f64, of_loops: &[(u32, f64)]) -> Result<(), Error> {
        self.change_continuity(Options {
            continuity,
            loop_continuity: of_loops.to_vec(),
            ..self.continuity_asked()
        })
    }

    /// Asks for the continuation of another [`boundary_curvature`](Options::boundary_curvature) from now on.
    ///
    /// # Errors
    /// [`Error::BadOption`] for a number that is not finite; what was asked before then holds on.
    pub fn set_boundary_curvature(&mut self, curvature: BoundaryCurvature) -> Result<(), Error> {
        let joined = joined_curvature(&self.input.copies, &curvature).into_owned();
        curvature.validate()?;
        self.change_continuity(Options {
            boundary_curvature: joined,
            ..self.continuity_asked()
        })
    }

    /// The options that concern curvature, in the numbers of the joined mesh.
    fn continuity_asked(&self) -> Options {
        let options = &self.input.options;
        Options {
            continuity: options.continuity,
            loop_continuity: options.loop_continuity.clone(),
            boundary_curvature: options.boundary_curvature.clone(),
            ..Options::default()
        }
    }

    /// Takes these of the options; loops by any of the copies of their vertices.
    fn change_continuity(&mut self, asked: Options) -> Result<(), Error> {
        if let Some(error) = &self.broken {
            return Err(error.clone());
        }
        asked.validate()?;
        let loops = joined_loops(&self.input.copies, &asked.loop_continuity);
        let vertices = self.components.cursors.iter().flat_map(Cursor::on_loops);
        check_loops(&loops, vertices).map_err(|error| in_given(error, &self.input.copies, &asked))?;
        self.input.options.continuity = asked.continuity;
        self.input.options.loop_continuity = loops;
        self.input.options.boundary_curvature = asked.boundary_curvature;
        let cursors = self.components.cursors.iter_mut();
        cursors.for_each(Cursor::change_continuity);
        Ok(())
    }

    /// Asks for another right-hand side from now on.
    ///
    /// # Errors
    /// [`Error::BadOption`] for a constant that is not finite; the target before then holds on.
    pub fn set_target(&mut self, target: Target) -> Result<(), Error> {
        if let Some(error) = &self.broken {
            return Err(error.clone());
        }
        Options {
            target,
            ..Options::default()
        }
        .validate()?;
        self.input.options.target = target;
        self.components
            .cursors
            .iter_mut()
            .for_each(|c| c.set_target(target));
        Ok(())
    }

    /// The surface of the last run; before the first one, the input's.
    pub fn solution(&self) -> &Solution {
        &self.solution
    }
}
