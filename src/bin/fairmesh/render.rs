//! A small software renderer: triangles into a z-buffer, supersampled, as PNG.

use rayon::prelude::*;

use crate::failure::Failure;
use crate::normals::{all as vertex_normals, cross, dot, sub, unit};

type V3 = [f64; 3];

/// How a surface is painted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shading {
    /// Every triangle by its own normal.
    Flat,
    /// The mirror image of rings of light around a far sphere, by interpolated vertex normals. A crease breaks the lines,
    /// a jump of curvature kinks them.
    ReflectionLines,
}

/// One picture of one surface.
pub struct View<'a> {
    pub positions: &'a [V3],
    pub triangles: &'a [[u32; 3]],
    pub shading: Shading,
    /// Vertices of the faired region: triangles that have one are tinted. Empty: none.
    pub region: &'a [bool],
}

/// The picture as a whole. All views are seen by the same camera, which shows all of every surface.
pub struct Options {
    /// Width and height of one view, in pixels.
    pub tile: [usize; 2],
    /// Views per row.
    pub columns: usize,
    /// From the surface to the eye; any length.
    pub direction: V3,
    /// What points up in the picture.
    pub up: V3,
    /// Samples per pixel along each axis.
    pub samples: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            tile: [720, 720],
            columns: 2,
            direction: [1.0, 0.7, 0.8],
            up: [0.0, 0.0, 1.0],
            samples: 3,
        }
    }
}

/// Share of a tile that stays empty on each side.
const MARGIN: f64 = 0.06;
/// Distance of the eye from the centre, in radii of the bounding sphere.
const DISTANCE: f64 = 5.0;
/// Twice the number of rings of light from pole to pole. Odd: a pole is all dark or all bright.
const LINES: f64 = 17.0;
/// Linear light where there is no surface.
const BACKDROP: [f32; 3] = [0.90, 0.91, 0.93];

/// Paints the views in rows and encodes the picture.
pub fn render(views: &[View<'_>], options: &Options) -> Result<Vec<u8>, Failure> {
    let camera = Camera::around(views, options);
    let columns = options.columns.clamp(1, views.len().max(1));
    let rows = views.len().div_ceil(columns);
    let [width, height] = options.tile;
    let stride = width * columns;
    let mut pixels = vec![255u8; 3 * stride * height * rows];
    let tiles: Vec<Vec<u8>> = views
        .par_iter()
        .map(|view| Canvas::paint(view, &camera, options).shrunk(options.samples))
        .collect();
    for (number, tile) in tiles.iter().enumerate() {
        let (column, row) = (number % columns, number / columns);
        for (y, line) in tile.chunks_exact(3 * width).enumerate() {
            let start = 3 * ((row * height + y) * stride + column * width);
            pixels[start..start + 3 * width].copy_from_slice(line);
        }
    }
    encode(&pixels, stride, height * rows)
        .map_err(|why| Failure::new(format!("cannot make the picture: {why}")))
}

fn encode(pixels: &[u8], width: usize, height: usize) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width as u32, height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(bytes)
}

/// An eye that looks at a point.
struct Camera {
    centre: V3,
    distance: f64,
    right: V3,
    up: V3,
    /// From the centre to the eye.
    back: V3,
    /// Picture coordinates of the tile's middle, and pixels (with samples) per picture unit.
    middle: [f64; 2],
    scale: f64,
    size: [usize; 2],
}

/// A point of the picture, in pixels; `w` is one over the distance from the eye.
#[derive(Clone, Copy)]
struct Projected {
    x: f64,
    y: f64,
    w: f64,
}

impl Camera {
    fn around(views: &[View<'_>], options: &Options) -> Self {
        let used = || views.iter().flat_map(|view| used_positions(view));
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for p in used() {
            (0..3).for_each(|axis| {
                low[axis] = low[axis].min(p[axis]);
                high[axis] = high[axis].max(p[axis]);
            });
        }
        let centre = [0, 1, 2].map(|axis| 0.5 * (low[axis] + high[axis])).map(finite);
        let radius = used()
            .map(|p| dot(sub(p, centre), sub(p, centre)).sqrt())
            .fold(1e-300, f64::max);
        let back = unit(options.direction).unwrap_or([0.0, 0.0, 1.0]);
        let right = unit(cross(options.up, back)).or_else(|| unit(cross([0.0, 1.0, 0.0], back)));
        let right = right.unwrap_or([1.0, 0.0, 0.0]);
        let mut camera = Self {
            centre,
            distance: DISTANCE * radius,
            right,
            up: cross(back, right),
            back,
            middle: [0.0; 2],
            scale: 1.0,
            size: options.tile.map(|pixels| pixels * options.samples),
        };
        camera.fit(used());
        camera
    }

    /// Places the picture so that all points are in it.
    fn fit(&mut self, points: impl Iterator<Item = V3>) {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for p in points {
            let [x, y, _] = self.plane(p);
            low = [low[0].min(x), low[1].min(y)];
            high = [high[0].max(x), high[1].max(y)];
        }
        let room = self.size.map(|pixels| pixels as f64 * (1.0 - 2.0 * MARGIN));
        self.middle = [0, 1].map(|axis| finite(0.5 * (low[axis] + high[axis])));
        let scales = [0, 1].map(|axis| room[axis] / (high[axis] - low[axis]));
        let scale = scales[0].min(scales[1]);
        self.scale = if scale.is_finite() { scale } else { 1.0 };
    }

    /// Picture coordinates before scaling, and one over the distance.
    fn plane(&self, p: V3) -> V3 {
        let d = sub(p, self.centre);
        let w = 1.0 / (self.distance - dot(d, self.back));
        [
            dot(d, self.right) * self.distance * w,
            dot(d, self.up) * self.distance * w,
            w,
        ]
    }

    fn project(&self, p: V3) -> Projected {
        let [x, y, w] = self.plane(p);
        Projected {
            x: 0.5 * self.size[0] as f64 + self.scale * (x - self.middle[0]),
            y: 0.5 * self.size[1] as f64 - self.scale * (y - self.middle[1]),
            w,
        }
    }

    /// The eye.
    fn eye(&self) -> V3 {
        [0, 1, 2].map(|axis| self.centre[axis] + self.distance * self.back[axis])
    }

    /// A direction given in the picture's right, up and towards the eye.
    fn direction(&self, [r, u, b]: V3) -> V3 {
        let sum = [0, 1, 2].map(|axis| r * self.right[axis] + u * self.up[axis] + b * self.back[axis]);
        unit(sum).unwrap_or(self.back)
    }
}

fn finite(value: f64) -> f64 {
    if value.is_finite() { value } else { 0.0 }
}

/// The positions that triangles use.
fn used_positions<'a>(view: &'a View<'_>) -> impl Iterator<Item = V3> + 'a {
    let positions = view
        .triangles
        .as_flattened()
        .iter()
        .map(|&v| view.positions[v as usize]);
    positions.filter(|p| p.iter().all(|c| c.is_finite()))
}

/// A tile with samples: colour (linear light) and depth.
struct Canvas {
    size: [usize; 2],
    colour: Vec<[f32; 3]>,
    /// One over the distance of what is seen; 0: nothing.
    depth: Vec<f64>,
}

impl Canvas {
    fn paint(view: &View<'_>, camera: &Camera, options: &Options) -> Self {
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

    /// Fills the samples whose centres are in the triangle and that nothing nearer covers.
    fn triangle(&mut self, t: usize, projected: &[Projected], painter: &Painter<'_>) {
        let [a, b, c] = painter.view.triangles[t].map(|v| projected[v as usize]);
        let area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if !area.is_finite() || area == 0.0 {
            return;
        }
        let clip = |low: f64, high: f64, size: usize| {
            let first = (low - 0.5).ceil().clamp(0.0, size as f64) as usize;
            let end = (high - 0.5).floor() + 1.0;
            first..end.clamp(0.0, size as f64) as usize
        };
        let columns = clip(a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x), self.size[0]);
        for row in clip(a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y), self.size[1]) {
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
                let sample = row * self.size[0] + column;
                if w > self.depth[sample] {
                    self.depth[sample] = w;
                    self.colour[sample] = painter.colour(t, weights.map(|weight| weight / w));
                }
            }
        }
    }

    /// The tile's pixels: means of the samples' light, as sRGB.
    fn shrunk(&self, samples: usize) -> Vec<u8> {
        let [width, height] = self.size.map(|size| size / samples);
        let mut pixels = Vec::with_capacity(3 * width * height);
        for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
            let mut sum = [0.0f32; 3];
            for (j, i) in (0..samples).flat_map(|j| (0..samples).map(move |i| (j, i))) {
                let colour = self.colour[(y * samples + j) * self.size[0] + x * samples + i];
                (0..3).for_each(|channel| sum[channel] += colour[channel]);
            }
            pixels.extend(sum.map(|light| srgb(light / (samples * samples) as f32)));
        }
        pixels
    }
}

/// Linear light as an sRGB byte.
fn srgb(light: f32) -> u8 {
    let light = light.clamp(0.0, 1.0);
    let curve = if light <= 0.003_130_8 {
        12.92 * light
    } else {
        1.055 * light.powf(1.0 / 2.4) - 0.055
    };
    (255.0 * curve).round() as u8
}

/// Light and material of one view.
struct Painter<'a> {
    view: &'a View<'a>,
    normals: Vec<V3>,
    eye: V3,
    key: V3,
    fill: V3,
    /// The axis around which the rings of light lie.
    poles: V3,
}

impl<'a> Painter<'a> {
    fn new(view: &'a View<'a>, camera: &Camera) -> Self {
        Self {
            view,
            normals: vertex_normals(view.positions, view.triangles),
            eye: camera.eye(),
            key: camera.direction([-0.55, 0.75, 0.8]),
            fill: camera.direction([0.9, -0.1, 0.45]),
            poles: camera.direction([0.35, 1.0, 0.15]),
        }
    }

    /// The light that comes from a point of a triangle, given by its barycentric coordinates.
    fn colour(&self, t: usize, weights: V3) -> [f32; 3] {
        let corners = self.view.triangles[t];
        let [a, b, c] = corners.map(|v| self.view.positions[v as usize]);
        let point = [0, 1, 2].map(|axis| weights[0] * a[axis] + weights[1] * b[axis] + weights[2] * c[axis]);
        let eye = unit(sub(self.eye, point)).unwrap_or([0.0, 0.0, 1.0]);
        let flat = unit(cross(sub(b, a), sub(c, a))).unwrap_or(eye);
        let is_back = dot(flat, eye) < 0.0;
        let mut normal = match self.view.shading {
            Shading::Flat => flat,
            Shading::ReflectionLines => self.smooth_normal(corners, weights).unwrap_or(flat),
        };
        if is_back {
            normal = normal.map(|c| -c);
        }
        let in_region = corners
            .iter()
            .any(|&v| self.view.region.get(v as usize) == Some(&true));
        match self.view.shading {
            Shading::Flat => self.matte(normal, eye, is_back, in_region),
            Shading::ReflectionLines => self.mirror(normal, eye, is_back),
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

    fn matte(&self, normal: V3, eye: V3, is_back: bool, in_region: bool) -> [f32; 3] {
        let grey = match (is_back, in_region) {
            (true, _) => [0.36, 0.31, 0.27],
            (false, true) => [0.60, 0.60, 0.58],
            (false, false) => [0.36, 0.47, 0.60],
        };
        let half = unit([0, 1, 2].map(|axis| self.key[axis] + eye[axis])).unwrap_or(eye);
        let gloss = 0.06 * dot(normal, half).max(0.0).powi(24);
        let light = self.light(normal);
        grey.map(|channel| (channel * light * 1.1 + gloss) as f32)
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The pixels of an encoded picture.
    fn decode(bytes: &[u8]) -> (Vec<u8>, [usize; 2]) {
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes))
            .read_info()
            .unwrap();
        let size = [reader.info().width as usize, reader.info().height as usize];
        let mut pixels = vec![0; 3 * size[0] * size[1]];
        reader.next_frame(&mut pixels).unwrap();
        (pixels, size)
    }

    /// A square seen from the front, and one half its size before (`near` > 0) or behind it.
    fn squares(near: f64) -> (Vec<V3>, Vec<[u32; 3]>) {
        let mut positions = Vec::new();
        for (side, z) in [(1.0, 0.0), (0.5, near)] {
            positions.extend([
                [-side, -side, z],
                [side, -side, z],
                [side, side, z],
                [-side, side, z],
            ]);
        }
        // The inner one faces away, so that it is painted differently.
        (positions, vec![[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6]])
    }

    fn picture(near: f64, shading: Shading) -> (Vec<u8>, [usize; 2]) {
        let (positions, triangles) = squares(near);
        let view = View {
            positions: &positions,
            triangles: &triangles,
            shading,
            region: &[],
        };
        let options = Options {
            tile: [50, 50],
            direction: [0.0, 0.0, 1.0],
            up: [0.0, 1.0, 0.0],
            ..Options::default()
        };
        decode(&render(&[view], &options).unwrap())
    }

    fn pixel((pixels, [width, _]): &(Vec<u8>, [usize; 2]), x: usize, y: usize) -> [u8; 3] {
        let at = 3 * (y * width + x);
        [pixels[at], pixels[at + 1], pixels[at + 2]]
    }

    #[test]
    fn what_is_nearer_hides_what_is_behind() {
        let (front, behind) = (picture(0.1, Shading::Flat), picture(-0.1, Shading::Flat));
        let backdrop = BACKDROP.map(srgb);
        for shown in [&front, &behind] {
            assert_eq!(pixel(shown, 0, 0), backdrop);
            assert_ne!(pixel(shown, 10, 25), backdrop);
        }
        assert_ne!(pixel(&front, 25, 25), pixel(&front, 8, 8));
        assert_eq!(pixel(&behind, 25, 25), pixel(&behind, 24, 26));
        assert_eq!(pixel(&front, 8, 8), pixel(&behind, 8, 8));
    }

    #[test]
    fn the_surface_fills_the_tile_up_to_the_margin() {
        let shown = picture(-0.1, Shading::Flat);
        let covered = (0..50)
            .filter(|&x| pixel(&shown, x, 25) != BACKDROP.map(srgb))
            .count();
        assert_eq!(covered, 44);
    }

    #[test]
    fn odd_input_makes_a_picture_too() {
        let options = Options {
            tile: [8, 8],
            ..Options::default()
        };
        let positions = [[f64::NAN; 3], [0.0; 3], [1.0; 3], [1e308; 3]];
        let triangles = [[0, 1, 2], [1, 1, 1], [1, 2, 3]];
        for shading in [Shading::Flat, Shading::ReflectionLines] {
            let view = || View {
                positions: &positions,
                triangles: &triangles,
                shading,
                region: &[],
            };
            let (_, size) = decode(&render(&[view(), view(), view()], &options).unwrap());
            assert_eq!(size, [16, 16]);
        }
        render(&[], &options).unwrap_err();
    }
}
