//! What is asked: plain data, checked in one place.

use super::boundary_curvature::BoundaryCurvature;
use super::normals::{BoundaryNormals, InteriorNormals};
use crate::discrete::target::Target;
use crate::mesh::coincident::Coincident;
use crate::paper::PaperOptions;
use crate::support::error::Error;
use crate::support::options::options;
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
pub enum SolverKind {
    /// Quasi-Newton steps on both equations together.
    #[default]
    Fast,
    /// The paper's own scheme (7): slow, kept as a yardstick. Always with [`Discretization::Paper`]; `tolerance` and
    /// `max_iterations` of [`Options`] have no part in it.
    Paper(PaperOptions),
}

table!(SolverKind {
    0 "fast" SolverKind::Fast => "quasi-Newton steps on both equations together", "";
    1 "paper" SolverKind::Paper(_) => "the paper's own scheme: slow, a yardstick; not for fairing in steps", "";
});

/// More threads than any machine of today makes use of: what is beyond is a mistake, which would cost a stack each.
/// Half or double, of 132 cases: none changes.
const MOST_THREADS: f64 = 1024.0;
/// The smallest [`Options::tolerance`]: a few roundings of a double.
/// Half or double, of 132 cases: none changes.
const LEAST_TOLERANCE: f64 = 1e-15;

options! {
    /// What is asked. `Options::default()` is right for most uses.
    #[derive(Debug, Clone, PartialEq)]
    Options {
        /// Normals at the boundary vertices. Default: fitted to the surroundings.
        boundary_normals: BoundaryNormals = BoundaryNormals::default(), with "fairmesh_boundary_normals";
        /// Normals of fixed vertices inside the region that have none given. Default: the surface passes smoothly.
        interior_normals: InteriorNormals = InteriorNormals::default(), choice "fairmesh_interior_normals";
        /// How far the surface continues the mean curvature of its surroundings: from 0 (tangent planes alone, G1) to 1 (curvature, too,
        /// G2), part of the way between those surfaces, where `Delta_B^2 H = 0`. Only as far as the surroundings are smooth enough to tell
        /// their curvature; the report says how far. Default auto, -1: 1 along loops where the curvature is certain, 0 along others. For
        /// the fast solver. Auto is 0 with the paper's, for another target, while rounding, and along loops with given normals or moved by edits
        /// that have no given curvature.
        continuity: f64 = Self::CONTINUITY_AUTO, real "1" in -1.0..=1.0, "between 0 and 1, or -1";
        /// The same for single boundary loops, each named by a vertex on it, in place of `continuity`. Of several numbers for one loop
        /// the last one holds. A loop with 0 has tangent planes alone, and `Delta_B H` is zero along it. Default: none.
        loop_continuity: Vec<(u32, f64)> = Vec::new(), with "fairmesh_loop_continuity";
        /// Where that curvature comes from. Default: fitted to the surroundings.
        boundary_curvature: BoundaryCurvature = BoundaryCurvature::default(), with "fairmesh_boundary_curvature";
        /// What `Delta_B H` has to be. Default: zero.
        target: Target = Target::default(), with "fairmesh_target";
        /// How vertices are distributed within the surface. Default: uniform; where nothing leads to a sound surface so, as conformal
        /// (`fallback_weights` of the report counts such vertices).
        inner_fairness: InnerFairness = InnerFairness::default(), choice "fairmesh_inner_fairness";
        /// How normals and mean curvature are discretized. Default: second order.
        discretization: Discretization = Discretization::default(), choice "fairmesh_discretization";
        /// How the equations are solved. Default: fast.
        solver: SolverKind = SolverKind::default(), elsewhere;
        /// Stop when the step norm (rms normal step + rms tangential step, over the diagonal of the component's bounding box) is
        /// below this. Default 1e-8; 1e-6 is enough for interactive use. At least 1e-15, a few roundings, and less than 1. What the mesh
        /// allows may be a hundred times that, which the outcome says.
        tolerance: f64 = 1e-8, real "1" in LEAST_TOLERANCE..1.0, "at least 1e-15, the precision of double numbers, and less than 1";
        /// At most this many nonlinear iterations for each component of the region. Default 500. At least 1.
        max_iterations: usize = 500, count "iterations" in 1.0.., "at least 1";
        /// The precision of what the result will be written in; moved positions are rounded to it, and the report is of the rounded
        /// surface. Default: double.
        output_precision: OutputPrecision = OutputPrecision::default(), choice "fairmesh_output_precision";
        /// Worker threads, at most 1024; 0 (default): as many as the machine has. Any number gives the same bits.
        threads: usize = 0, small_count "threads" in 0.0..=MOST_THREADS, "at most 1024";
        /// Whether the final surface is checked for self-intersections. Default: it is; that takes about a tenth of the run, at most
        /// a fifth.
        intersections: Intersections = Intersections::default(), choice "fairmesh_intersections";
        /// Whether vertices at the same place are one. Default: yes, where their coordinates are equal.
        coincident: Coincident = Coincident::default(), elsewhere;
        /// Creases of the surroundings of at least so many degrees that reach the boundary go on through the region, if another one fits there:
        /// vertices are placed along them, and each side is a surface of its own. Default auto: those that are certain. 0: none. Not for
        /// fairing in steps.
        sharp: f64 = Self::SHARP_AUTO, real "degrees" in 0.0..=180.0, "between 0 and 180";
        /// Edges that are sharp however little they bend, as marked by hand: pairs of vertices. Where they reach the boundary from outside, creases
        /// arrive, too, whatever `sharp` is; inside they say which edges are to lie on one that goes on. Default: none.
        marked_edges: Vec<[u32; 2]> = Vec::new(), indices 2;
    }
}

impl Options {
    /// The value of `continuity` at which curvature is continued where it is certain: a name, no quantity.
    pub const CONTINUITY_AUTO: f64 = -1.0;

    /// The value of `sharp` at which only edges that are certain go on, degrees: less than those of 30 on parts, more than 50 beside strips of single
    /// triangles, which may be the facets of something round. Half or double, of 33 regions across
    /// edges of parts: 1 changes; none changes.
    pub const SHARP_AUTO: f64 = 20.0;

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
        if let SolverKind::Paper(options) = &self.solver {
            options.validate()?;
        }
        self.validate_continuity()?;
        self.coincident.validate()?;
        self.check_ranges()
    }

    fn validate_continuity(&self) -> Result<(), Error> {
        let is_fast = self.solver == SolverKind::Fast;
        let range = ["0 or -1 for the paper's solver", "between 0 and 1, or -1"][usize::from(is_fast)];
        let check = |name, blend: f64| {
            let is_auto = blend == Self::CONTINUITY_AUTO;
            let is_fine = is_auto || (0.0..=1.0).contains(&blend) && (is_fast || blend == 0.0);
            Error::check_option(name, blend, is_fine, range)
        };
        check("continuity", self.continuity)?;
        let mut of_loops = self.loop_continuity.iter();
        of_loops.try_for_each(|(_, blend)| check("loop_continuity", *blend))?;
        self.boundary_curvature.validate()
    }

    /// Whether creases of the surroundings are looked for.
    pub(crate) fn asks_sharp(&self) -> bool {
        self.sharp > 0.0 || !self.marked_edges.is_empty()
    }

    /// Whether curvature is to be continued along any loop.
    pub(crate) fn asks_continuity(&self) -> bool {
        let is_asked = |blend: f64| blend > 0.0 || blend == Self::CONTINUITY_AUTO && self.may_continue();
        is_asked(self.continuity) || self.loop_continuity.iter().any(|(_, blend)| is_asked(*blend))
    }

    /// Whether auto is more than nothing: who asks for another equation does not mean the shape of the surroundings.
    pub(super) fn may_continue(&self) -> bool {
        self.solver == SolverKind::Fast && self.target == Target::default()
    }
}
