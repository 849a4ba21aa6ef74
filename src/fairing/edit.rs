//! What a solver is asked to change of its boundary, frame by frame: [`Edit`], and what a frame may cost: [`Budget`].

pub(super) mod along_loop;
pub(super) mod moves;
pub(super) mod resolved;

use crate::support::error::Error;

/// A change of the boundary that a [`Solver`](crate::Solver) is asked for, relative to what was asked of it without edits.
///
/// Vertices are named by any of their copies, see [`Coincident`](crate::Coincident). Lengths are in the unit of the positions, and are
/// measured on the mesh as it was given.
#[derive(Debug, Clone, PartialEq)]
pub enum Edit {
    /// Turns the boundary normals of the loop that a vertex lies on about the boundary curve: with `n` the normal and `m` the direction from
    /// the boundary into the region, both orthogonal to the curve, `m' = cos(a) m + sin(a) n` and `n' = cos(a) n - sin(a) m`. Angles of
    /// several edits add up. A vertex has one normal: on a curve between two parts of the region, the surfaces of both sides turn with it.
    Tilt {
        /// A vertex of the loop: fixed, beside a free one. On a curve inside the region it is the loop of the side whose
        /// component has the smaller free vertex.
        vertex: u32,
        /// The angle `a` at the vertex, in radians. Positive: the surface leaves the boundary steeper towards its normal side, it bulges outward.
        angle: f64,
        /// The arc length along the loop, to both sides of the vertex, at which the effect has gone smoothly to zero; 0, or the length of the
        /// loop or more: the whole loop is turned alike. Where both sides meet before, they add up.
        falloff: f64,
    },
    /// The same with opposite angles on both sides of the vertex, and zero there: the ribbon of tangent planes is twisted. The angle is largest
    /// a third of the falloff away, and is positive ahead of the vertex, in the direction that has the region on its left seen
    /// from the normal side.
    Twist {
        /// A vertex of the loop.
        vertex: u32,
        /// The largest angle, in radians.
        angle: f64,
        /// As that of a tilt. For the whole loop the angle goes as the sine of the arc length from the vertex, once around.
        falloff: f64,
    },
    /// All boundary loops tilted alike, but for curves between two parts of the region, where that cancels. 0: the fair surface between the
    /// boundaries as they are. See
    /// [`Solver::bulge_range`](crate::Solver::bulge_range). (The other number that bulges a surface is
    /// [`Target::Constant`](crate::Target::Constant). On caps, tubes and blends angles give up to six times the volume before the surface is
    /// unsound, and they need no unit.)
    Bulge {
        /// The angle, in radians.
        amount: f64,
    },
    /// Moves fixed vertices rigidly, on the boundary or off it: a rotation about `centre`, then a translation. Interior points are moved in the same way.
    /// Boundary normals, given or fitted, turn with their vertices. One edit after the other, and all before normals are tilted.
    Move {
        /// The vertices; each is fixed.
        vertices: Vec<u32>,
        /// The axis times the angle in radians.
        rotation: [f64; 3],
        /// The point that stays where it is in the rotation.
        centre: [f64; 3],
        /// How far they are moved.
        translation: [f64; 3],
        /// The distance from the vertices, along the edges of the mesh, at which other fixed vertices cease to follow; nearer ones follow in part.
        /// 0: none follow.
        falloff: f64,
    },
}

impl Edit {
    /// Checks the numbers of the edit at a place of the list.
    pub(super) fn validate(&self, edit: usize) -> Result<(), Error> {
        let (numbers, falloff): (&[&[f64]], f64) = match self {
            Self::Tilt { angle, falloff, .. } | Self::Twist { angle, falloff, .. } => {
                (&[&[*angle]], *falloff)
            }
            Self::Bulge { amount } => (&[&[*amount]], 0.0),
            Self::Move {
                rotation,
                centre,
                translation,
                falloff,
                ..
            } => (&[rotation, centre, translation], *falloff),
        };
        let refuse = |why| {
            Err(Error::BadEdit {
                edit,
                vertex: None,
                why,
            })
        };
        if !numbers.iter().all(|list| list.iter().all(|x| x.is_finite())) {
            return refuse("a number is not finite");
        }
        if !(falloff >= 0.0 && falloff.is_finite()) {
            return refuse("the falloff has to be finite, and at least 0");
        }
        Ok(())
    }
}

/// What a frame of a [`Solver`](crate::Solver) may cost. By evaluations alone frames are the same in every run; by the clock they are not.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Budget {
    /// At most so many evaluations of the equations, for each component of the region; 0: no limit.
    pub evaluations: usize,
    /// No evaluation is begun after so many seconds, but the first one of each component; 0: no limit. In WebAssembly there is no clock, and
    /// none.
    pub seconds: f64,
    /// The step norm, in diagonals, at which the surface has settled; 0: 1e-6, less than can be seen.
    pub tolerance: f64,
}

/// The tolerance of frames that none is given for.
/// Of 5 cases, half: 3 change by up to 8e-9 edges; double: 3 change by up to 6e-9 edges, +3 % iterations.
const INTERACTIVE: f64 = 1e-6;

impl Budget {
    /// Checks the numbers.
    ///
    /// # Errors
    /// [`Error::BadOption`] for a number that is negative or not finite, or a tolerance above 0.1.
    pub(super) fn validate(&self) -> Result<(), Error> {
        let (s, t) = (self.seconds, self.tolerance);
        Error::check_option("seconds", s, s >= 0.0 && s.is_finite(), "finite, at least 0")?;
        Error::check_option("tolerance", t, (0.0..=0.1).contains(&t), "from 0 to 0.1")
    }

    /// The step norm to reach.
    pub(super) fn step(&self) -> f64 {
        if self.tolerance > 0.0 {
            self.tolerance
        } else {
            INTERACTIVE
        }
    }
}

/// What a frame has come to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// The step norm of the surface shown, in diagonals: about how far it is from the fair one, root mean square. Infinite before the first
    /// step of the solver.
    pub step: f64,
    /// How often the equations were evaluated, for the component for which it was most.
    pub evaluations: usize,
    /// The step norm is within the tolerance, and no triangle is folded. Whether the surface is sound otherwise, as to creases or
    /// intersections, is told by [`Solver::finish`](crate::Solver::finish).
    pub is_settled: bool,
}
