//! Creases become blends: bands around them, cut out along rails, triangulated anew and faired.

mod arcs;
mod bands;
mod boundaries;
mod chain_curve;
mod chords;
mod corners;
mod crease_ends;
mod crease_graph;
mod cut;
mod endings;
mod ends;
mod face_normals;
mod facets;
mod legs;
mod level;
mod meetings;
mod mitres;
mod options;
mod rails;
mod resolution;
mod rims;
mod round;
mod rounded;
mod sheet;
mod stopped;
mod surface;
mod telling;
mod through;
mod tidy;
mod triangle_normals;
mod unsolved;
mod widths;

pub use options::{Creases, RoundOptions};
pub use round::{blend_vertices, find_creases, round, round_with_progress};
pub use rounded::{CreaseChain, Narrowing, Rounded, SharpCorner};
