//! What comes of rounding.

use crate::fairing::Report;
use crate::holes::Parents;

/// A mesh with blends in place of creases.
#[derive(Debug, Clone)]
pub struct Rounded {
    /// The vertices given that are left, in their order, then the new ones.
    pub positions: Vec<[f64; 3]>,
    /// The triangles outside the blends, in the order of those that they are parts of, then the blends'.
    pub triangles: Vec<[u32; 3]>,
    /// Per vertex that is left its number before; ascending.
    pub kept_vertices: Vec<u32>,
    /// Per triangle outside the blends that of the mesh given that it is, or is a part of.
    pub kept_triangles: Vec<u32>,
    /// Where the new vertices come from: vertices of the mesh given.
    pub parents: Vec<Parents>,
    /// The vertices of the blends, without their rails; ascending.
    pub free: Vec<u32>,
    /// Edges that bend by more than so many degrees were taken for creases.
    pub angle: f64,
    /// The creases of the mesh given.
    pub chains: Vec<CreaseChain>,
    /// How the blends were faired.
    pub report: Report,
}

/// A crease from one corner or end to the next.
#[derive(Debug, Clone, PartialEq)]
pub struct CreaseChain {
    /// Its vertices in the mesh given, one after the other; those of a closed one end with the first.
    pub vertices: Vec<u32>,
    /// By how many degrees the surface bends there, in the mean; positive where it is convex.
    pub bend: f64,
    /// Whether it was rounded.
    pub is_rounded: bool,
}
