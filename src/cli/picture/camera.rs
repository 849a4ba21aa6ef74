//! Where the eye is, and where it sees a point.

use serde_json::{Value, json};

use super::view::{PictureOptions, V3, View};
use crate::normals::{cross, dot, sub, unit};

/// Distance of the eye from the centre, in radii of the bounding sphere.
const DISTANCE: f64 = 5.0;

/// An eye that looks at a point.
pub struct Camera {
    /// The box around what is seen.
    pub bounds: [V3; 2],
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
pub struct Projected {
    pub x: f64,
    pub y: f64,
    pub w: f64,
}

impl Camera {
    pub fn around(views: &[View<'_>], options: &PictureOptions) -> Self {
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
            bounds: [low, high],
            centre,
            distance: DISTANCE * radius,
            right,
            up: cross(back, right),
            back,
            middle: [0.0; 2],
            scale: 1.0,
            size: options.tile.map(|pixels| pixels * options.samples),
        };
        let extent = camera.extent(views);
        camera.fit(extent, options.margin);
        camera
    }

    /// So many around the picture's vertical, at equal angles, the first as [`around`](Self::around) has it. Nothing changes its size or
    /// its height from one to the next, and the middle stays where it is.
    pub fn turning(views: &[View<'_>], options: &PictureOptions, count: usize) -> Vec<Self> {
        let axis = unit(options.up).unwrap_or([0.0, 0.0, 1.0]);
        let mut cameras: Vec<Self> = (0..count)
            .map(|k| {
                let angle = std::f64::consts::TAU * k as f64 / count as f64;
                let direction = turned(options.direction, axis, angle);
                Self::around(
                    views,
                    &PictureOptions {
                        direction,
                        ..*options
                    },
                )
            })
            .collect();
        let (mut wide, mut low, mut high) = (0.0f64, f64::INFINITY, f64::NEG_INFINITY);
        for [[left, bottom], [right, top]] in cameras.iter().map(|camera| camera.extent(views)) {
            wide = wide.max(-left).max(right);
            (low, high) = (low.min(bottom), high.max(top));
        }
        for camera in &mut cameras {
            camera.fit([[-wide, low], [wide, high]], options.margin);
        }
        cameras
    }

    /// The least and greatest picture coordinates.
    fn extent(&self, views: &[View<'_>]) -> [[f64; 2]; 2] {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for p in views.iter().flat_map(used_positions) {
            let [x, y, _] = self.plane(p);
            low = [low[0].min(x), low[1].min(y)];
            high = [high[0].max(x), high[1].max(y)];
        }
        [low, high]
    }

    /// Places the picture so that all of this extent is in it.
    fn fit(&mut self, [low, high]: [[f64; 2]; 2], margin: f64) {
        let room = self.size.map(|pixels| pixels as f64 * (1.0 - 2.0 * margin));
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

    pub fn project(&self, p: V3) -> Projected {
        let [x, y, w] = self.plane(p);
        Projected {
            x: 0.5 * self.size[0] as f64 + self.scale * (x - self.middle[0]),
            y: 0.5 * self.size[1] as f64 - self.scale * (y - self.middle[1]),
            w,
        }
    }

    /// Its numbers, as [`Places`](super::places::Places) says.
    pub fn described(&self) -> Value {
        json!({
            "centre": self.centre, "distance": self.distance, "right": self.right, "up": self.up, "back": self.back,
            "middle": self.middle, "scale": self.scale, "size": self.size,
        })
    }

    /// The eye.
    pub fn eye(&self) -> V3 {
        [0, 1, 2].map(|axis| self.centre[axis] + self.distance * self.back[axis])
    }

    /// A direction given in the picture's right, up and towards the eye.
    pub fn direction(&self, [r, u, b]: V3) -> V3 {
        let sum = [0, 1, 2].map(|axis| r * self.right[axis] + u * self.up[axis] + b * self.back[axis]);
        unit(sum).unwrap_or(self.back)
    }
}

/// A direction turned around a unit axis, counter-clockwise seen from its end.
fn turned(v: V3, axis: V3, angle: f64) -> V3 {
    let (sin, cos) = angle.sin_cos();
    let along = (1.0 - cos) * dot(axis, v);
    let across = cross(axis, v);
    [0, 1, 2].map(|k| cos * v[k] + sin * across[k] + along * axis[k])
}

fn finite(value: f64) -> f64 {
    if value.is_finite() { value } else { 0.0 }
}

/// The positions that triangles use; if the view is about some vertices, those.
fn used_positions<'a>(view: &'a View<'_>) -> impl Iterator<Item = V3> + 'a {
    let corners = view.triangles.as_flattened().iter();
    let shown = corners.filter(|&&v| view.focus.is_empty() || view.focus.get(v as usize) == Some(&true));
    shown
        .map(|&v| view.positions[v as usize])
        .filter(|p| p.iter().all(|c| c.is_finite()))
}
