//! Which point of a surface each pixel shows, as a page can read it back.

use serde_json::{Value, json};

use super::camera::Camera;
use super::canvas::Canvas;
use super::pixels::Pixels;
use super::view::{PictureOptions, View};

/// Steps of depth that two bytes can tell; 0 is nothing.
const STEPS: f64 = 65_535.0;

/// One over the distance of what each pixel shows, and the camera that it is seen by.
pub struct Places {
    /// In the first two bytes of a pixel, the higher one first: 0 where nothing is, else from the farthest (1) to the nearest.
    pub depths: Pixels,
    /// What a page needs to find the point: `range` are the values of `depths` 1 and 65535. With x and y of a pixel's middle, from the upper left
    /// corner, w from the depth, and z = 1 / w, the point is
    /// centre + ((x - size_x / 2) / scale + middle_x) z / distance right + ((size_y / 2 - y) / scale + middle_y) z / distance up + (distance - z) back.
    pub camera: Value,
}

impl Places {
    pub fn of(view: &View<'_>, camera: &Camera, options: &PictureOptions) -> Self {
        let size = options.tile.map(|side| side as u32);
        let depths: Vec<f64> = Canvas::of(view, camera, options)
            .nearest
            .into_iter()
            .map(|(w, _)| w)
            .collect();
        let shown = || depths.iter().copied().filter(|&w| w > 0.0);
        let (low, high) = (shown().fold(f64::INFINITY, f64::min), shown().fold(0.0, f64::max));
        let range = if high > low { high - low } else { 1.0 };
        let pixels = Pixels::from_fn(size, |x, y| {
            let w = depths[y as usize * size[0] as usize + x as usize];
            let step = match w > 0.0 {
                true => 1 + ((w - low) / range * (STEPS - 1.0)).round() as u16,
                false => 0,
            };
            let [first, second] = step.to_be_bytes();
            [first, second, 0]
        });
        let mut described = camera.described();
        described["range"] = json!([low, low + range]);
        Self {
            depths: pixels,
            camera: described,
        }
    }
}
