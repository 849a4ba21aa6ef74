//! Triangles into a z-buffer.
//!
//! Own code, because there is no kept crate for it: of the pure-Rust rasterizers, `euc` has had no release by its
//! author since 2021, takes depth in 32 bits and panics where its buffers do not fit, and the others draw without
//! depth (`tiny-skia`, `imageproc`) or need a graphics card. What is needed is the one loop of [`samples`].

use super::camera::{Camera, Projected};
use super::paint::Painter;
use super::pixels::Pixels;
use super::view::{PictureOptions, View};

/// Linear light where there is no surface.
pub const BACKDROP: [f32; 3] = [0.90, 0.91, 0.93];

/// What is nearer to the eye by more than this part of the distance hides a point.
const NEAR: f64 = 0.01;

/// A tile with samples: colour (linear light) and depth.
pub struct Canvas {
    size: [usize; 2],
    colour: Vec<[f32; 3]>,
    /// One over the distance of what is seen; 0: nothing.
    depth: Vec<f64>,
}

impl Canvas {
    pub fn paint(view: &View<'_>, camera: &Camera, options: &PictureOptions) -> Self {
        let mut canvas = Self::empty(options.tile.map(|pixels| pixels * options.samples));
        let painter = Painter::new(view, camera);
        let projected: Vec<Projected> = view.positions.iter().map(|&p| camera.project(p)).collect();
        for t in 0..view.triangles.len() {
            canvas.triangle(t, &projected, &painter);
        }
        canvas
    }

    /// Nothing but the backdrop.
    fn empty(size: [usize; 2]) -> Self {
        let samples = size[0] * size[1];
        Self {
            size,
            colour: vec![BACKDROP; samples],
            depth: vec![0.0; samples],
        }
    }

    /// Whether nothing is before a point of the surface, by more than rounding and the slope within a sample.
    pub fn shows(&self, point: &Projected) -> bool {
        let is_inside = [point.x, point.y]
            .into_iter()
            .zip(self.size)
            .all(|(at, size)| (0.0..size as f64).contains(&at));
        is_inside && self.depth[point.y as usize * self.size[0] + point.x as usize] <= point.w * (1.0 + NEAR)
    }

    /// What each sample shows: one over its distance, 0 where there is nothing, and the number of the triangle, which is `u32::MAX` there.
    pub fn nearest(view: &View<'_>, camera: &Camera, options: &PictureOptions) -> Vec<(f64, u32)> {
        let size = options.tile.map(|pixels| pixels * options.samples);
        let mut nearest = vec![(0.0, u32::MAX); size[0] * size[1]];
        let projected: Vec<Projected> = view.positions.iter().map(|&p| camera.project(p)).collect();
        for (t, corners) in (0..).zip(view.triangles) {
            samples(corners.map(|v| projected[v as usize]), size, |sample, w, _| {
                if w > nearest[sample].0 {
                    nearest[sample] = (w, t);
                }
            });
        }
        nearest
    }

    /// Fills the samples that nothing nearer covers.
    fn triangle(&mut self, t: usize, projected: &[Projected], painter: &Painter<'_>) {
        let corners = painter.view.triangles[t].map(|v| projected[v as usize]);
        samples(corners, self.size, |sample, w, weights| {
            if w > self.depth[sample] {
                self.depth[sample] = w;
                self.colour[sample] = painter.colour(t, weights);
            }
        });
    }

    /// The tile's pixels: means of the samples' light, as sRGB.
    pub fn shrunk(&self, samples: usize) -> Pixels {
        let size = self.size.map(|size| (size / samples) as u32);
        Pixels::from_fn(size, |x, y| {
            let mut sum = [0.0f32; 3];
            let (x, y) = (x as usize * samples, y as usize * samples);
            for (j, i) in (0..samples).flat_map(|j| (0..samples).map(move |i| (j, i))) {
                let colour = self.colour[(y + j) * self.size[0] + x + i];
                (0..3).for_each(|channel| sum[channel] += colour[channel]);
            }
            sum.map(|light| srgb(light / (samples * samples) as f32))
        })
    }
}

/// The samples whose centres are in a triangle: number, one over the distance, coordinates on the triangle.
fn samples([a, b, c]: [Projected; 3], size: [usize; 2], mut see: impl FnMut(usize, f64, [f64; 3])) {
    let area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    // What reaches behind the eye is left out.
    if !area.is_finite() || area == 0.0 || [a, b, c].iter().any(|p| p.w <= 0.0) {
        return;
    }
    let clip = |low: f64, high: f64, size: usize| {
        let first = (low - 0.5).ceil().clamp(0.0, size as f64) as usize;
        let end = (high - 0.5).floor() + 1.0;
        first..end.clamp(0.0, size as f64) as usize
    };
    let columns = clip(a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x), size[0]);
    for row in clip(a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y), size[1]) {
        let y = row as f64 + 0.5;
        for column in columns.clone() {
            let x = column as f64 + 0.5;
            let beta = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area;
            let gamma = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
            let alpha = 1.0 - beta - gamma;
            if alpha < 0.0 || beta < 0.0 || gamma < 0.0 {
                continue;
            }
            // One over the distance is linear in the picture; the coordinates on the triangle are not.
            let weights = [alpha * a.w, beta * b.w, gamma * c.w];
            let w = weights[0] + weights[1] + weights[2];
            see(row * size[0] + column, w, weights.map(|weight| weight / w));
        }
    }
}

/// Linear light as an sRGB byte.
pub fn srgb(light: f32) -> u8 {
    let light = light.clamp(0.0, 1.0);
    let curve = if light <= 0.003_130_8 {
        12.92 * light
    } else {
        1.055 * light.powf(1.0 / 2.4) - 0.055
    };
    (255.0 * curve).round() as u8
}
