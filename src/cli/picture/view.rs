//! What is painted, and how it is seen.

use super::scale::Scale;
use crate::formats::textures::Textured;

pub type V3 = [f64; 3];

/// How a surface is painted.
#[derive(Clone, Copy)]
pub enum Shading<'a> {
    /// Every triangle by its own normal.
    Flat,
    /// The same, with some triangles in another colour.
    Marked(&'a [bool]),
    /// The mirror image of rings of light around a far sphere, by interpolated vertex normals. A crease breaks the lines,
    /// a jump of curvature kinks them.
    ReflectionLines,
    /// Colours of a scale by a value per vertex, which is interpolated.
    Values(&'a [f64], &'a Scale),
    /// Colours of the vertices, from 0 to 255, interpolated.
    VertexColours(&'a [[f64; 3]]),
    /// Colours of the triangles, from 0 to 255.
    FaceColours(&'a [[f64; 3]]),
    /// Covered with pictures.
    Textured(&'a Textured),
}

/// One picture of one surface.
pub struct View<'a> {
    pub positions: &'a [V3],
    pub triangles: &'a [[u32; 3]],
    pub shading: Shading<'a>,
    /// Vertices that have to be in the picture. Empty: all.
    pub focus: &'a [bool],
}

/// How it is seen. All views are seen by the same camera, which shows all of every surface's focus.
pub struct PictureOptions {
    /// Width and height of one view, in pixels.
    pub tile: [usize; 2],
    /// From the surface to the eye; any length.
    pub direction: V3,
    /// What points up in the picture.
    pub up: V3,
    /// Samples per pixel along each axis.
    pub samples: usize,
    /// Share of a tile that stays empty on each side.
    pub margin: f64,
    /// Coordinates are shown at the edges of the box around it.
    pub axes: bool,
}

impl PictureOptions {
    /// With coordinates, and room for them.
    pub fn with_axes(self) -> Self {
        Self {
            margin: 0.13,
            axes: true,
            ..self
        }
    }
}

impl Default for PictureOptions {
    fn default() -> Self {
        Self {
            tile: [720, 720],
            direction: [1.0, 0.7, 0.8],
            up: [0.0, 0.0, 1.0],
            samples: 3,
            margin: 0.06,
            axes: false,
        }
    }
}
