//! The light that a point of the surface sends to the eye.

use super::camera::Camera;
use super::view::{Shading, V3, View};
use crate::formats::image::linear;
use crate::normals::{all_seen, dot, of_triangle, sub, unit};

/// Twice the number of rings of light from pole to pole. Odd: a pole is all dark or all bright.
const LINES: f64 = 17.0;

/// Linear light of what is marked.
pub const MARK: [f32; 3] = [0.85, 0.25, 0.03];

/// Light and material of one view.
pub struct Painter<'a> {
    pub view: &'a View<'a>,
    normals: Vec<V3>,
    eye: V3,
    key: V3,
    fill: V3,
    /// The axis around which the rings of light lie.
    poles: V3,
}

impl<'a> Painter<'a> {
    pub fn new(view: &'a View<'a>, camera: &Camera) -> Self {
        Self {
            view,
            normals: match view.shading {
                Shading::Flat | Shading::Marked(_) => Vec::new(),
                _ => all_seen(view.positions, view.triangles),
            },
            eye: camera.eye(),
            key: camera.direction([-0.55, 0.75, 0.8]),
            fill: camera.direction([0.9, -0.1, 0.45]),
            poles: camera.direction([0.35, 1.0, 0.15]),
        }
    }

    /// Whether the light of a triangle changes little within a pixel.
    pub fn is_even(&self) -> bool {
        !matches!(self.view.shading, Shading::ReflectionLines | Shading::Textured(_))
    }

    /// The light that comes from a point of a triangle, given by its barycentric coordinates.
    pub fn colour(&self, t: usize, weights: V3) -> [f32; 3] {
        let corners = self.view.triangles[t];
        let [a, b, c] = corners.map(|v| self.view.positions[v as usize]);
        let point = [0, 1, 2].map(|axis| weights[0] * a[axis] + weights[1] * b[axis] + weights[2] * c[axis]);
        let eye = unit(sub(self.eye, point)).unwrap_or([0.0, 0.0, 1.0]);
        let flat = of_triangle([a, b, c]).unwrap_or(eye);
        let is_back = dot(flat, eye) < 0.0;
        let mut normal = match self.view.shading {
            Shading::Flat | Shading::Marked(_) => flat,
            _ => self.smooth_normal(corners, weights).unwrap_or(flat),
        };
        if is_back {
            normal = normal.map(|c| -c);
        }
        match self.view.shading {
            Shading::Flat => self.matte(normal, eye, is_back),
            Shading::Marked(is_marked) if is_marked[t] => self.tinted(MARK, normal, is_back),
            Shading::Marked(_) => self.matte(normal, eye, is_back),
            Shading::ReflectionLines => self.mirror(normal, eye, is_back),
            Shading::Values(values, scale) => {
                let value = (0..3).map(|k| weights[k] * values[corners[k] as usize]).sum();
                self.tinted(scale.light(value), normal, is_back)
            }
            Shading::VertexColours(values) => {
                let light = corners.map(|v| values[v as usize].map(linear));
                let mix =
                    [0, 1, 2].map(|channel| (0..3).map(|k| weights[k] as f32 * light[k][channel]).sum());
                self.tinted(mix, normal, is_back)
            }
            Shading::FaceColours(values) => self.tinted(values[t].map(linear), normal, is_back),
            Shading::Textured(textured) => self.tinted(textured.light(t, weights), normal, is_back),
        }
    }

    fn smooth_normal(&self, corners: [u32; 3], weights: V3) -> Option<V3> {
        let [a, b, c] = corners.map(|v| self.normals[v as usize]);
        unit([0, 1, 2].map(|axis| weights[0] * a[axis] + weights[1] * b[axis] + weights[2] * c[axis]))
    }

    /// Two lamps and an even sky.
    fn light(&self, normal: V3) -> f64 {
        0.10 + 0.82 * dot(normal, self.key).max(0.0) + 0.16 * dot(normal, self.fill).max(0.0)
    }

    fn matte(&self, normal: V3, eye: V3, is_back: bool) -> [f32; 3] {
        let grey = if is_back {
            [0.36, 0.31, 0.27]
        } else {
            [0.36, 0.47, 0.60]
        };
        let half = unit([0, 1, 2].map(|axis| self.key[axis] + eye[axis])).unwrap_or(eye);
        let gloss = 0.06 * dot(normal, half).max(0.0).powi(24);
        let light = self.light(normal);
        grey.map(|channel| (channel * light * 1.1 + gloss) as f32)
    }

    /// A colour of the scale, hardly shaded, so that it can be read off.
    fn tinted(&self, colour: [f32; 3], normal: V3, is_back: bool) -> [f32; 3] {
        let shade = (0.55 + 0.5 * self.light(normal)) * if is_back { 0.35 } else { 1.0 };
        colour.map(|channel| channel * shade as f32)
    }

    fn mirror(&self, normal: V3, eye: V3, is_back: bool) -> [f32; 3] {
        let along = 2.0 * dot(normal, eye);
        let mirrored = [0, 1, 2].map(|axis| along * normal[axis] - eye[axis]);
        let wave = (LINES * dot(mirrored, self.poles).clamp(-1.0, 1.0).asin()).sin();
        // Soft edges; the samples do the rest.
        let stripe = ((wave / 0.25).clamp(-1.0, 1.0) + 1.0) / 2.0;
        let shade = (0.55 + 0.6 * self.light(normal)) * if is_back { 0.45 } else { 1.0 };
        let (dark, bright) = ([0.025, 0.035, 0.06], [0.80, 0.82, 0.84]);
        [0, 1, 2].map(|channel| (shade * (dark[channel] + stripe * (bright[channel] - dark[channel]))) as f32)
    }
}
