//! What rounding is asked.

use crate::fairing::Options;
use crate::support::error::Error;
use crate::support::options::options;
use crate::support::table::choices;

choices! {
    /// Creases by whether material or air is inside them.
    #[derive(Default)]
    Creases {
        #[default] 0 "all" All => "all", "";
        1 "convex" Convex => "edges that stand out", "";
        2 "concave" Concave => "edges that lie in a fold", "";
    }
}

impl Creases {
    /// Whether an edge that bends so, positive where it is convex, is one of them.
    pub(super) fn has(self, bend: f64) -> bool {
        match self {
            Self::All => true,
            Self::Convex => bend > 0.0,
            Self::Concave => bend < 0.0,
        }
    }
}

options! {
    /// What is asked of [`round`](crate::round).
    #[derive(Debug, Clone, PartialEq)]
    RoundOptions {
        /// How far from a crease its blend reaches, along the surface on both sides. 0 (default): `radius` says it.
        width: f64 = 0.0, real "length" in 0.0..=f64::MAX, "finite and at least 0";
        /// The radius of the ball that touches both sides where the blend begins, in place of `width`. 0 (default): the width holds.
        radius: f64 = 0.0, real "length" in 0.0..=f64::MAX, "finite and at least 0";
        /// How many times as far as at its beginning the blend of a chain that is not closed reaches at its end; in between that changes evenly. A chain begins with the first of its `edges`, as it is named; else at the end whose vertex has the smaller number. 1 (default): everywhere alike.
        taper: f64 = 1.0, real "factor" in 0.01..=100.0, "between 0.01 and 100";
        /// Edges that bend by more than so many degrees are creases. 0 (default): the widest gap between the bends of the mesh tells.
        angle: f64 = 0.0, real "degrees" in 0.0..=180.0, "between 0 and 180";
        /// Which creases are rounded. Default: all.
        creases: Creases = Creases::default(), choice "fairmesh_creases";
        /// Edges that are rounded, and no others: pairs of vertices; they are creases however little they bend. Default: none, all creases are.
        edges: Vec<[u32; 2]> = Vec::new(), indices 2;
        /// Blends that would have more vertices than about so many are refused: a slip of the width, most likely. Default 1000000.
        max_blend_vertices: usize = 1_000_000, count "vertices";
        /// Labels of all triangles, one for each, as the numbers of their materials: lines between labels stay where they are, inside flat faces, too. Default: none, all have the same.
        labels: Vec<u32> = Vec::new(), indices 1;
        /// How the blends are faired.
        fairing: Options = Options::default(), elsewhere;
    }
}

impl RoundOptions {
    /// Checks the ranges of all options, those of the fairing included.
    ///
    /// # Errors
    /// [`Error::BadOption`], which names the option.
    pub fn validate(&self) -> Result<(), Error> {
        self.check_ranges()?;
        self.fairing.validate()?;
        let has_width = self.width > 0.0 || self.radius > 0.0;
        Error::check_option("width", self.width, has_width, "above 0, or a radius is")
    }
}
