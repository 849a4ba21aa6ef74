//! Words at places of a surface.

use super::camera::{Camera, Projected};
use super::canvas::Canvas;
use super::letters::{LETTER, LINE, write};
use super::pixels::Pixels;
use super::view::V3;

/// Room around the letters, in pixels.
const ROOM: u32 = 3;
/// A label is left out where less than this share of its points is in front of everything else.
const SEEN: f64 = 0.5;

/// Words in the middle of those points of a surface that are seen.
pub struct Label {
    pub text: String,
    pub points: Vec<V3>,
}

impl Label {
    /// Writes it, if its points are seen.
    pub fn write(&self, tile: &mut Pixels, canvas: &Canvas, camera: &Camera, samples: usize) {
        let places = self.points.iter().map(|&p| camera.project(p));
        let seen: Vec<_> = places.filter(|place| canvas.shows(place)).collect();
        if seen.is_empty() || (seen.len() as f64) < SEEN * self.points.len() as f64 {
            return;
        }
        let sum = |at: fn(&Projected) -> f64| seen.iter().map(at).sum::<f64>();
        let middle = [sum(|place| place.x), sum(|place| place.y)];
        let size = [LETTER * self.text.chars().count() as u32, LINE].map(|length| length + 2 * ROOM);
        let corner = [0, 1].map(|k| {
            let at = middle[k] / (seen.len() * samples) as f64 - 0.5 * f64::from(size[k]);
            at.round()
                .clamp(0.0, f64::from(tile.size[k].saturating_sub(size[k]))) as u32
        });
        tile.place(&Pixels::filled(size, [255; 3]), corner[0], corner[1]);
        write(tile, corner.map(|at| at + ROOM), &self.text);
        let [low, high] = [corner, [0, 1].map(|k| corner[k] + size[k] - 1)].map(|at| at.map(i64::from));
        tile.frame(low, high, [0; 3]);
    }
}
