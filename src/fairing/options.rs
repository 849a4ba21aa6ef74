//! What is asked: plain data, checked in one place.

use super::normals::{BoundaryNormals, InteriorNormals};
use crate::discrete::target::Target;
use crate::error::Error;
use crate::paper::PaperOptions;
use crate::table::{choices, table};

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

/// What is asked. `Options::default()` is right for most uses.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Normals at the boundary vertices. Default: fitted to the surroundings.
    pub boundary_normals: BoundaryNormals,
    /// Normals of fixed vertices inside the region that have none given. Default: the surface passes smoothly.
    pub interior_normals: InteriorNormals,
    /// What `Delta_B H` has to be. Default: zero.
    pub target: Target,
    /// How vertices are distributed within the surface. Default: uniform.
    pub inner_fairness: InnerFairness,
    /// Discretization. Default: second order.
    pub discretization: Discretization,
    /// Solver. Default: the fast one.
    pub solver: Solver,
    /// Stop when the step norm (rms normal step + rms tangential step, over the component's bounding-box
    /// diagonal) is below this. Default 1e-8; 1e-6 is enough for interactive use. In (0, 1).
    pub tolerance: f64,
    /// At most this many nonlinear iterations for each component of the region. Default 500. At least 1.
    pub max_iterations: usize,
    /// Worker threads; 0 (default): as many as the machine has. Any number gives the same bits.
    pub threads: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            boundary_normals: BoundaryNormals::default(),
            interior_normals: InteriorNormals::default(),
            target: Target::default(),
            inner_fairness: InnerFairness::default(),
            discretization: Discretization::default(),
            solver: Solver::default(),
            tolerance: 1e-8,
            max_iterations: 500,
            threads: 0,
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
        let t = self.tolerance;
        Error::check_option(
            "tolerance",
            t,
            t > 0.0 && t < 1.0,
            "greater than 0 and less than 1",
        )?;
        Error::check_option("max_iterations", 0.0, self.max_iterations > 0, "at least 1")
    }
}
