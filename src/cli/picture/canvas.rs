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

/// What the samples of a tile show.
pub struct Canvas {
    size: [usize; 2],
    /// Samples per pixel along each axis.
    samples: usize,
    /// One over the distance, 0 where there is nothing, and the number of the triangle, which is `u32::MAX` there.
    pub nearest: Vec<(f64, u32)>,
    /// The vertices.
    projected: Vec<Projected>,
}

impl Canvas {
    pub fn of(view: &View<'_>, camera: &Camera, options: &PictureOptions) -> Self {
        let size = options.tile.map(|pixels| pixels * options.samples);
        let mut nearest = vec![(0.0, u32::MAX); size[0] * size[1]];
        let projected: Vec<Projected> = view.positions.iter().map(|&p| camera.project(p)).collect();
        for (t, corners) in (0..).zip(view.triangles) {
            samples(corners.map(|v| projected[v as usize]), size, |sample, w| {
                if w > nearest[sample].0 {
                    nearest[sample] = (w, t);
                }
            });
        }
        Self {
            size,
            samples: options.samples,
            nearest,
            projected,
        }
    }

    /// Whether nothing is before a point of the surface, by more than rounding and the slope within a sample.
    pub fn shows(&self, point: &Projected) -> bool {
        let is_inside = [point.x, point.y]
            .into_iter()
            .zip(self.size)
            .all(|(at, size)| (0.0..size as f64).contains(&at));
        is_inside
            && self.nearest[point.y as usize * self.size[0] + point.x as usize].0 <= point.w * (1.0 + NEAR)
    }

    /// The tile's pixels: means of the samples' light, as sRGB.
    pub fn painted(&self, view: &View<'_>, camera: &Camera) -> Pixels {
        let painter = Painter::new(view, camera);
        let size = self.size.map(|size| (size / self.samples) as u32);
        Pixels::from_fn(size, |x, y| {
            self.light(&painter, [x as usize, y as usize].map(|k| k * self.samples))
                .map(srgb)
        })
    }

    /// The mean light of the samples from this one on. Where they show one triangle, and it changes little within a pixel, that of their middle.
    fn light(&self, painter: &Painter<'_>, [x, y]: [usize; 2]) -> [f32; 3] {
        let n = self.samples;
        let of = |i: usize, j: usize| self.nearest[(y + j) * self.size[0] + x + i].1;
        let pairs = || (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
        let first = of(0, 0);
        if painter.is_even() && pairs().all(|(i, j)| of(i, j) == first) {
            return self.colour(painter, first, [x, y].map(|k| k as f64 + 0.5 * n as f64));
        }
        let mut sum = [0.0f32; 3];
        for (i, j) in pairs() {
            let colour = self.colour(painter, of(i, j), [x + i, y + j].map(|k| k as f64 + 0.5));
            (0..3).for_each(|channel| sum[channel] += colour[channel]);
        }
        sum.map(|light| light / (n * n) as f32)
    }

    fn colour(&self, painter: &Painter<'_>, t: u32, at: [f64; 2]) -> [f32; 3] {
        let Some(corners) = painter.view.triangles.get(t as usize) else {
            return BACKDROP;
        };
        let corners = corners.map(|v| self.projected[v as usize]);
        // One over the distance is linear in the picture; the coordinates on the triangle are not.
        let shares = shares(&corners, at);
        let weights = [0, 1, 2].map(|k| shares[k] * corners[k].w);
        let w = weights[0] + weights[1] + weights[2];
        painter.colour(t as usize, weights.map(|weight| weight / w))
    }
}

/// The barycentric coordinates of a point of the picture in a triangle that has an area there.
fn shares([a, b, c]: &[Projected; 3], [x, y]: [f64; 2]) -> [f64; 3] {
    let area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    let beta = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area;
    let gamma = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
    [1.0 - beta - gamma, beta, gamma]
}

/// The samples whose centres are in a triangle: number, one over the distance.
fn samples([a, b, c]: [Projected; 3], size: [usize; 2], mut see: impl FnMut(usize, f64)) {
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
            let [alpha, beta, gamma] = shares(&[a, b, c], [column as f64 + 0.5, y]);
            if alpha >= 0.0 && beta >= 0.0 && gamma >= 0.0 {
                see(row * size[0] + column, alpha * a.w + beta * b.w + gamma * c.w);
            }
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
