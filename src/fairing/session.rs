//! Fairing in steps, for interactive programs: run some iterations, look, change what is asked, go on.

mod cursor;

use super::joined::{in_given, joined_normals, joined_options, spread};
use super::prepared::{Prepared, region};
use super::relay::{Workers, relay};
use super::{BoundaryNormals, Options, ProgressCallback, Selection, Solution, Solver, Target};
use crate::error::Error;
use crate::mesh::coincident::{Copies, Selected};
use crate::mesh::{Joined, Region};
use cursor::Cursor;

/// One fairing problem, solved in steps by [`Solver::Fast`]. It owns copies of its input.
///
/// Without changes in between, any sequence of [`run`](Session::run)s finds the surface of [`fair`](super::fair) with the same
/// options, to the last bit. After a change of the boundary normals or of the target, the next run starts at the surface
/// at hand with the matrices at hand; where that leads to no sound surface, it begins anew, as `fair` does.
///
/// ```
/// # // A plane of 7 by 7 vertices with a bump; the nine in the middle are free.
/// # let at = |v: u32| [f64::from(v % 7), f64::from(v / 7), if v == 24 { 1.0 } else { 0.0 }];
/// # let positions: Vec<[f64; 3]> = (0..49).map(at).collect();
/// # let cell = |c: u32| { let v = c / 6 * 7 + c % 6; [[v, v + 1, v + 8], [v, v + 8, v + 7]] };
/// # let triangles: Vec<[u32; 3]> = (0..36).flat_map(cell).collect();
/// # let free = [16, 17, 18, 23, 24, 25, 30, 31, 32];
/// use fairmesh::{BoundaryNormals, Options, Outcome, Selection, Session, Target};
///
/// let mut session = Session::new(&positions, &triangles, Selection::Vertices(&free), &Options::default())?;
/// let after_one = session.run(1, None)?;
/// assert_eq!(after_one.report.outcome, Outcome::IterationLimit);
/// let plane = session.run(100, None)?;
/// assert!(plane.report.outcome.is_success() && plane.positions[24][2].abs() < 1e-7);
///
/// // Other conditions: the next run starts at the surface at hand.
/// session.set_boundary_normals(BoundaryNormals::Averaged)?;
/// session.set_target(Target::Constant(0.01))?;
/// assert!(session.run(100, None)?.report.iterations > 0);
/// assert!(session.solution().positions[24][2] > 1e-4); // pushed out along the normals
/// # Ok::<(), fairmesh::Error>(())
/// ```
pub struct Session {
    input: Input,
    copies: Copies,
    cursor: Cursor,
    /// Of all copies.
    solution: Solution,
    /// What the last run failed with.
    broken: Option<Error>,
    workers: Workers,
}

/// What was asked, in the session's own memory, of the joined mesh. Changes go into the options.
struct Input {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    selection: Selected<'static>,
    options: Options,
}

impl Input {
    fn selection(&self) -> Selection<'_> {
        self.selection.selection()
    }

    /// The region, cut where these normals ask for it.
    fn region(&self, normals: &BoundaryNormals) -> Result<Region, Error> {
        region(&self.positions, &self.triangles, self.selection(), normals)
    }

    fn prepared(&self) -> Result<Prepared, Error> {
        Prepared::new(&self.positions, &self.triangles, self.selection(), &self.options)
    }
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
        let Joined { triangles, copies } = Joined::new(positions, triangles, options.coincident)?;
        let input = Input {
            positions: positions.to_vec(),
            triangles: triangles.into_owned(),
            selection: copies.selection(selection).into_owned(),
            options: joined_options(&copies, options).into_owned(),
        };
        let workers = Workers::new(options.threads)?;
        let (cursor, mut solution) = workers
            .install(|| Cursor::new(&input))
            .map_err(|error| in_given(error, &copies, &options.boundary_normals))?;
        spread(&mut solution, &copies);
        Ok(Self {
            input,
            copies,
            cursor,
            solution,
            broken: None,
            workers,
        })
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
        if self.cursor.is_over() {
            return Ok(&self.solution);
        }
        let iterations = iterations.max(1);
        let (input, cursor) = (&self.input, &mut self.cursor);
        let ran = match progress {
            None => self.workers.install(|| cursor.run(input, iterations, None)),
            // A run that is held up goes on later: no factorization is to be broken off.
            Some(callback) => relay(&self.workers, callback, |told, _| {
                cursor.run(input, iterations, Some(told))
            })?,
        };
        match ran {
            Ok(solution) => {
                self.solution = solution;
                spread(&mut self.solution, &self.copies);
                Ok(&self.solution)
            }
            Err(error) => {
                self.broken = Some(error.clone());
                Err(error)
            }
        }
    }

    /// Asks for other boundary normals from now on. Where a curve of fixed vertices inside the region gets normals, or loses them,
    /// the region is another one, and the session begins anew.
    ///
    /// # Errors
    /// [`Error::BadNormal`], [`Error::NoNormal`]; the normals before then hold on.
    pub fn set_boundary_normals(&mut self, normals: BoundaryNormals) -> Result<(), Error> {
        if let Some(error) = &self.broken {
            return Err(error.clone());
        }
        let given = normals;
        let normals = joined_normals(&self.copies, &given).into_owned();
        let region = self.input.region(&normals)?;
        let before = std::mem::replace(&mut self.input.options.boundary_normals, normals);
        let (input, cursor) = (&self.input, &mut self.cursor);
        let changed = if cursor.is_of(&region) {
            self.workers.install(|| cursor.set_boundary_normals(input))
        } else {
            let anew = self.workers.install(|| Cursor::new(input));
            anew.map(|(cursor, solution)| {
                (self.cursor, self.solution) = (cursor, solution);
                spread(&mut self.solution, &self.copies);
            })
        };
        if changed.is_err() {
            self.input.options.boundary_normals = before;
        }
        changed.map_err(|error| in_given(error, &self.copies, &given))
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
        self.cursor.set_target(target);
        Ok(())
    }

    /// The surface of the last run; before the first one, the input's.
    pub fn solution(&self) -> &Solution {
        &self.solution
    }
}
