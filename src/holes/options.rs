//! What filling is asked.

use super::rim::options::Rim;
use crate::fairing::Options;
use crate::support::error::Error;
use crate::support::options::options;
use crate::support::table::{choices, table};

/// Which loops are filled.
#[derive(Debug, Clone, PartialEq)]
pub enum Loops {
    /// All holes of at most this many edges; outer boundaries stay open.
    UpTo(usize),
    /// These, by their numbers in [`boundary_loops`](super::boundary_loops), outer boundaries included.
    Chosen(Vec<usize>),
    /// All holes that meet every bound of these; outer boundaries stay open.
    Where(LoopFilter),
}

/// Which holes, by what they are and where. By default all.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LoopFilter {
    /// Of at most this many edges.
    pub max_edges: Option<usize>,
    /// Not longer than this.
    pub max_length: Option<f64>,
    /// Of no more than this [`BoundaryLoop::area`](super::BoundaryLoop::area).
    pub max_area: Option<f64>,
    /// With a bounding box of no more than this diagonal.
    pub max_diagonal: Option<f64>,
    /// All but so many of the mesh's holes, the longest.
    pub except_longest: usize,
    /// Only those of these [components](super::BoundaryLoop::component).
    pub components: Option<Vec<usize>>,
    /// Only those whose vertices all lie there.
    pub within: Option<Place>,
}

/// A part of space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Place {
    /// Not further than `radius` from the centre.
    Ball {
        /// The centre.
        centre: [f64; 3],
        /// The radius.
        radius: f64,
    },
    /// Between two corners, the faces included.
    Box {
        /// The smallest coordinates.
        low: [f64; 3],
        /// The largest ones.
        high: [f64; 3],
    },
}

impl LoopFilter {
    fn validate(&self) -> Result<(), Error> {
        let bounds = [
            ("max_length", self.max_length),
            ("max_area", self.max_area),
            ("max_diagonal", self.max_diagonal),
        ];
        for (name, bound) in bounds {
            let value = bound.unwrap_or(0.0);
            Error::check_option(name, value, value >= 0.0, "not negative")?;
        }
        self.within.as_ref().map_or(Ok(()), Place::validate)
    }
}

table!(Place {
    1 "ball" Place::Ball { .. } => "not further than a radius from a centre", "";
    2 "box" Place::Box { .. } => "between two corners, the faces included", "";
});

impl Place {
    pub(crate) fn validate(&self) -> Result<(), Error> {
        let number = self.numbers().find(|number| number.is_nan());
        Error::check_option("within", number.unwrap_or(0.0), number.is_none(), "numbers")?;
        match self {
            Self::Ball { radius, .. } => {
                Error::check_option("within", *radius, *radius >= 0.0, "a radius of at least 0")
            }
            Self::Box { low, high } => {
                let reversed = (0..3).find(|&k| low[k] > high[k]);
                let value = reversed.map_or(0.0, |k| low[k]);
                Error::check_option(
                    "within",
                    value,
                    reversed.is_none(),
                    "a low corner that is not above the high one",
                )
            }
        }
    }

    fn numbers(&self) -> impl Iterator<Item = f64> {
        let (points, radius) = match self {
            Self::Ball { centre, radius } => ([*centre, *centre], *radius),
            Self::Box { low, high } => ([*low, *high], 0.0),
        };
        points.into_iter().flatten().chain([radius])
    }

    pub(crate) fn holds(&self, p: &[f64; 3]) -> bool {
        match self {
            Self::Ball { centre, radius } => {
                let square = (0..3).map(|k| (p[k] - centre[k]).powi(2)).sum::<f64>();
                square.sqrt() <= *radius
            }
            Self::Box { low, high } => (0..3).all(|k| low[k] <= p[k] && p[k] <= high[k]),
        }
    }
}

choices! {
    /// What becomes of a loop whose patch is no [success](super::LoopReport::is_success): creased, intersecting, not fair, converged loosely, with
    /// triangles that are poor or have no area, or with a rim that folds.
    #[derive(Default)]
    #[non_exhaustive]
    OnFailure {
        #[default] 0 "best" Best =>
            "the best surface that there is: that of least bending, or the faired one that intersects where all do", "";
        1 "flat" Flat => "the triangulation, refined", "";
        2 "open" Open => "none: it is left open", "";
    }
}

choices! {
    /// What closes a loop that lies in a plane, as where a part was cut off.
    #[derive(Default)]
    #[non_exhaustive]
    Cap {
        #[default] 0 "fair" Fair => "a fair patch, which continues the surroundings and bulges as they do", "";
        1 "flat" Flat => "the plane, with a sharp edge along the loop; loops that are in no plane get a fair patch", "";
    }
}

/// Which loops get one patch together: an island and the hole around it, the ends of tubes, the two sides of a gap.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Join {
    /// Every loop gets a patch of its own.
    #[default]
    None,
    /// The loops of each group, by their numbers, get one patch; outer boundaries and loops that [`FillOptions::loops`]
    /// does not name, too. No loop is in two groups.
    Groups(Vec<Vec<usize>>),
    /// Of the loops of [`FillOptions::loops`], and of outer boundaries if these are not [`Loops::Chosen`], those whose joint patch bends
    /// less than patches of their own would: by the sum over all edges, those of the loops included, of length times angle, of
    /// triangulations that are not faired. [`LoopReport::joined`](super::LoopReport::joined) tells the sums, and
    /// [`suggest_joins`](super::suggest_joins) does so before anything is filled.
    Auto,
}

table!(Join {
    0 "none" Join::None => "every loop gets a patch of its own", "";
    1 "groups" Join::Groups(_) => "the loops of each group get one patch", "";
    2 "auto" Join::Auto => "loops whose joint patch bends less than patches of their own would get one patch", "";
});

options! {
    /// What is asked. `FillOptions::default()` is right for most uses.
    #[derive(Debug, Clone, PartialEq)]
    FillOptions {
        /// Which loops. Default: all holes of whatever size.
        loops: Loops = Loops::UpTo(usize::MAX), elsewhere;
        /// Which of them get one patch together. Default: none.
        join: Join = Join::None, with "fairmesh_join";
        /// Pairs of vertices of the boundary that the triangulation shall have an edge between, before it is refined. On one loop a
        /// guide divides what is triangulated, as across a long tear; between two loops that are joined it is where their patch is cut
        /// open. No vertex is in two of them. The patch is faired as a whole: it has no crease there. Default: none.
        guides: Vec<[u32; 2]> = Vec::new(), indices 2;
        /// How dense the new vertices are, Liepa's factor as in CGAL: at the default, the square root of 2, edges are as
        /// long as those of the mesh beside the boundary; at twice that, half as long, away from the boundary, whose edges
        /// stay. Between 0.1 and 10.
        density: f64 = std::f64::consts::SQRT_2, real "1" in 0.1..=10.0, "between 0.1 and 10";
        /// At most this many new vertices in all. Where they do not suffice, patches become coarser away from their boundaries.
        /// Smaller loops are served first. Default 200000. No loop of n edges gets more than 1000 + n^2 of them, times the
        /// square of a density above 1: a round hole takes a tenth.
        max_new_vertices: usize = 200_000, count "vertices";
        /// What a loop gets whose patch is no success. Default: the best surface there is.
        on_failure: OnFailure = OnFailure::default(), choice "fairmesh_on_failure";
        /// What closes a loop that lies in a plane, to a thousandth of its diagonal, as where a part was cut off. Default: a fair patch.
        cap: Cap = Cap::default(), choice "fairmesh_cap";
        /// What may happen to the mesh around a loop before it is filled. Default: nothing.
        rim: Rim = Rim::default(), elsewhere;
        /// Whether the patches are faired. Default: yes.
        fair: bool = true, flag;
        /// For the fairing. Boundary normals are those of the mesh's vertices on the loops. Its iterations are each patch's; that of one loop gets no more than 64.
        /// Its `coincident` holds for the whole mesh: loops are those of the joined mesh, and new triangles name of each vertex the
        /// copy in the triangle beside them.
        fairing: Options = Options::default(), elsewhere;
    }
}

/// See [`FillOptions::max_new_vertices`].
pub(super) fn largest_patch(edges: usize, density: f64) -> usize {
    1_000 + (edges as f64 * density.max(1.0)).powi(2).round() as usize
}

impl FillOptions {
    /// Checks the ranges of all options, those of the fairing included.
    ///
    /// # Errors
    /// [`Error::BadOption`], which names the option.
    pub fn validate(&self) -> Result<(), Error> {
        self.check_ranges()?;
        if let Loops::Where(filter) = &self.loops {
            filter.validate()?;
        }
        if let Join::Groups(groups) = &self.join {
            let mut named: Vec<usize> = groups.iter().flatten().copied().collect();
            named.sort_unstable();
            let twice = named.windows(2).find(|pair| pair[0] == pair[1]);
            let value = twice.map_or(0.0, |pair| pair[0] as f64);
            Error::check_option("join", value, twice.is_none(), "each loop in one group, and once")?;
        }
        self.rim.validate()?;
        self.fairing.validate()
    }
}
