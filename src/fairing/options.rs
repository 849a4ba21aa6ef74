//! What is asked: plain data, checked in one place.

use super::boundary_curvature::BoundaryCurvature;
use super::normals::{BoundaryNormals, InteriorNormals};
use crate::discrete::target::Target;
use crate::mesh::coincident::Coincident;
use crate::paper::PaperOptions;
use crate::support::error::Error;
use crate::support::table::{choices, table};

choices! {
    /// How vertices are distributed within the surface (paper 7.3).
    #[derive(Default)]
    InnerFairness {
        #[default] 0 "uniform" Uniform => "equal weights: a regular distribution", "";
        1 "conformal" Conformal => "cotangents of the input mesh: least distortion of the input triangles", "";
        2 "convex" Convex =>
            "mean-value weights of the input mesh (Floater): near conformal, but positive for any input, and exact on a plane", "";
    }
}

choices! {
    /// How normals and mean curvature are discretized (paper 5, 6).
    #[derive(Default)]
    Discretization {
        #[default] 0 "second_order" SecondOrder =>
            "Max's normals and the gradient-corrected curvature: second order on irregular meshes", "";
        1 "paper" Paper => "the paper's: normals from summed cross products, plain Moreton-Sequin curvature", "";
    }
}

choices! {
    /// Whether a surface is searched for triangles that intersect each other or the rest of the mesh.
    #[derive(Default)]
    Intersections {
        #[default] 0 "check" Check =>
            "the surface is checked against itself and the rest of the mesh; one that intersects is no success", "";
        1 "skip" Skip => "not checked: a surface that intersects may count as a success", "";
    }
}

choices! {
    /// The precision of the numbers that the result will be written in, to a file or to the arrays of a program. Moved
    /// positions are rounded to it, and figures and outcome of the report are those of the rounded surface.
    #[derive(Default)]
    OutputPrecision {
        #[default] 0 "double" Double => "double: 53 bits", "";
        1 "single" Single => "single: 24 bits; far from the origin that is coarse", "";
    }
}

impl OutputPrecision {
    /// A position in this precision. Coordinates beyond the range of single numbers stay as they are.
    ///
    /// ```
    /// use fairmesh::OutputPrecision;
    ///
    /// assert_eq!(OutputPrecision::Single.round([1e6 + 0.01, 0.5, 0.1])[..2], [1e6, 0.5]);
    /// assert_eq!(OutputPrecision::Double.round([0.1; 3]), [0.1; 3]);
    /// ```
    pub fn round(self, position: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Double => position,
            Self::Single => position.map(|c| {
                let rounded = f64::from(c as f32);
                if rounded.is_finite() { rounded } else { c }
            }),
        }
    }
}

/// How the equations are solved.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Solver {
    /// Quasi-Newton steps on both equations together.
    #[default]
    Fast,
    /// The paper's own scheme (7): slow, kept as a yardstick. Always with [`Discretization::Paper`]; `tolerance` and
    /// `max_iterations` of [`Options`] have no part in it.
    Paper(PaperOptions),
}

table!(Solver {
    0 "fast" Solver::Fast => "quasi-Newton steps on both equations together", "";
    1 "paper" Solver::Paper(_) => "the paper's own scheme: slow, a yardstick; not for fairing in steps", "";
});

/// More threads than any machine of today makes use of: what is beyond is a mistake, which would cost a stack each.
const MOST_THREADS: usize = 1024;
/// The smallest [`Options::tolerance`]: a few roundings of a double.
const LEAST_TOLERANCE: f64 = 1e-15;

/// What is asked. `Options::default()` is right for most uses.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Normals at the boundary vertices. Default: fitted to the surroundings.
    pub boundary_normals: BoundaryNormals,
    /// Normals of fixed vertices inside the region that have none given. Default: the surface passes smoothly.
    pub interior_normals: InteriorNormals,
    /// How far the surface continues the mean curvature of its surroundings, from 0 (default: tangent planes alone, G1) to 1 (curvature,
    /// G2): part of the way between those surfaces. What is solved then is `Delta_B^2 H = 0`, with a target that of `Delta_B H` less the target. Only as
    /// far as the surroundings are smooth enough to tell their curvature, see [`ComponentReport::continuity`](crate::ComponentReport::continuity). For
    /// the fast solver.
    pub continuity: f64,
    /// The same for single boundary loops, `(vertex, number)`: for the loop through this vertex in place of `continuity`. Of several numbers
    /// for one loop the last one holds. A loop with 0 has tangent planes alone, and `Delta_B H` is zero along it. Default: none.
    pub loop_continuity: Vec<(u32, f64)>,
    /// Where that curvature comes from. Default: fitted to the surroundings.
    pub boundary_curvature: BoundaryCurvature,
    /// What `Delta_B H` has to be. Default: zero.
    pub target: Target,
    /// How vertices are distributed within the surface. Default: uniform.
    pub inner_fairness: InnerFairness,
    /// Discretization. Default: second order.
    pub discretization: Discretization,
    /// Solver. Default: the fast one.
    pub solver: Solver,
    /// Stop when the step norm (rms normal step + rms tangential step, over the component's bounding-box
    /// diagonal) is below this. Default 1e-8; 1e-6 is enough for interactive use. Between 1e-15 (a few roundings) and 1; what the
    /// mesh allows may be a hundred times that, which the outcome says ([`LooseReason::Tolerance`](crate::LooseReason::Tolerance)).
    pub tolerance: f64,
    /// At most this many nonlinear iterations for each component of the region. Default 500. At least 1.
    pub max_iterations: usize,
    /// What the result will be written in. Default: double.
    pub output_precision: OutputPrecision,
    /// Worker threads, at most 1024; 0 (default): as many as the machine has. Any number gives the same bits.
    pub threads: usize,
    /// Whether the final surface is checked for self-intersections. Default: yes; it takes about a tenth of the run, at most a fifth.
    pub intersections: Intersections,
    /// Whether vertices at the same place are one. Default: yes, where their coordinates are equal.
    pub coincident: Coincident,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            boundary_normals: BoundaryNormals::default(),
            interior_normals: InteriorNormals::default(),
            continuity: 0.0,
            loop_continuity: Vec::new(),
            boundary_curvature: BoundaryCurvature::default(),
            target: Target::default(),
            inner_fairness: InnerFairness::default(),
            discretization: Discretization::default(),
            solver: Solver::default(),
            tolerance: 1e-8,
            max_iterations: 500,
            output_precision: OutputPrecision::default(),
            threads: 0,
            intersections: Intersections::default(),
            coincident: Coincident::default(),
        }
    }
}

impl Options {
    /// Checks the ranges of all options. Given normals are checked against the mesh, when it is faired.
    ///
    /// ```
    /// use fairmesh::{Error, Options};
    ///
    /// assert!(Options::default().validate().is_ok());
    /// let wrong = Options { tolerance: 2.0, ..Options::default() };
    /// assert!(matches!(wrong.validate(), Err(Error::BadOption { name: "tolerance", .. })));
    /// let wrong = Options { threads: 1025, ..Options::default() };
    /// assert!(matches!(wrong.validate(), Err(Error::BadOption { name: "threads", .. })));
    /// ```
    ///
    /// # Errors
    /// [`Error::BadOption`], which names the option.
    pub fn validate(&self) -> Result<(), Error> {
        if let Target::Constant(c) = self.target {
            Error::check_option("target", c, c.is_finite(), "a finite constant")?;
        }
        if let Solver::Paper(options) = &self.solver {
            options.validate()?;
        }
        self.validate_continuity()?;
        self.coincident.validate()?;
        let t = self.tolerance;
        Error::check_option(
            "tolerance",
            t,
            (LEAST_TOLERANCE..1.0).contains(&t),
            "at least 1e-15, the precision of double numbers, and less than 1",
        )?;
        Error::check_option("max_iterations", 0.0, self.max_iterations > 0, "at least 1")?;
        let threads = self.threads;
        Error::check_option("threads", threads as f64, threads <= MOST_THREADS, "at most 1024")
    }

    fn validate_continuity(&self) -> Result<(), Error> {
        let range = "between 0 and 1; 0 for the paper's solver";
        let is_fast = self.solver == Solver::Fast;
        let check = |name, blend: f64| {
            let is_fine = (0.0..=1.0).contains(&blend) && (is_fast || blend == 0.0);
            Error::check_option(name, blend, is_fine, range)
        };
        check("continuity", self.continuity)?;
        let mut of_loops = self.loop_continuity.iter();
        of_loops.try_for_each(|(_, blend)| check("loop_continuity", *blend))?;
        self.boundary_curvature.validate()
    }

    /// Whether curvature is to be continued along any loop.
    pub(crate) fn asks_continuity(&self) -> bool {
        self.continuity > 0.0 || self.loop_continuity.iter().any(|(_, blend)| *blend > 0.0)
    }
}
