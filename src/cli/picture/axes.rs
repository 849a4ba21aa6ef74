//! Edges of the box around a surface, with coordinates.

use super::camera::Camera;
use super::letters::{LETTER, LINE, write};
use super::pixels::{Pixels, Rgb};
use super::view::V3;

const INK: Rgb = [70; 3];
/// Pixels from one number to the next, at least, and of a mark.
const APART: f64 = 70.0;
const MARK: f64 = 6.0;
/// Across edges that are steeper than about 80 degrees is to the left.
const UPRIGHT: f64 = 0.2;

/// One edge of the box for each axis, where it hides nothing: the outermost below, or to the left of one that is upright. Edges that are seen
/// end on have none.
pub fn draw(tile: &mut Pixels, camera: &Camera, bounds: [V3; 2], samples: usize) {
    let project = |p: V3| {
        let seen = camera.project(p);
        [seen.x / samples as f64, seen.y / samples as f64]
    };
    for axis in 0..3 {
        let edges: Vec<[[f64; 2]; 2]> = (0..4)
            .map(|which| edge(bounds, axis, which).map(project))
            .collect();
        let Some(out) = outward(&edges) else { continue };
        let place = |[a, b]: &[[f64; 2]; 2]| (a[0] + b[0]) * out[0] + (a[1] + b[1]) * out[1];
        let outermost = edges
            .iter()
            .max_by(|one, other| place(one).total_cmp(&place(other)));
        if let Some(&ends) = outermost {
            let range = bounds.map(|corner| corner[axis]);
            draw_axis(tile, ["x", "y", "z"][axis], (ends, out), range);
        }
    }
}

/// Across parallel edges, as they are seen: down, or to the left.
fn outward(edges: &[[[f64; 2]; 2]]) -> Option<[f64; 2]> {
    let sum = |k: usize| edges.iter().map(|[a, b]| b[k] - a[k]).sum::<f64>();
    let (x, y) = (sum(0), sum(1));
    let length = x.hypot(y);
    let across = [-y / length, x / length];
    let is_out = match across[1].abs() > UPRIGHT {
        true => across[1] > 0.0,
        false => across[0] < 0.0,
    };
    let sign = if is_out { 1.0 } else { -1.0 };
    (length > 0.0 && length.is_finite()).then(|| across.map(|c| sign * c))
}

/// The ends of one of the four edges along an axis.
fn edge(bounds: [V3; 2], axis: usize, which: usize) -> [V3; 2] {
    let mut ends = [[0.0; 3]; 2];
    for (end, place) in ends.iter_mut().enumerate() {
        place[axis] = bounds[end][axis];
        for (bit, other) in (1..3).map(|k| (axis + k) % 3).enumerate() {
            place[other] = bounds[which >> bit & 1][other];
        }
    }
    ends
}

fn draw_axis(tile: &mut Pixels, name: &str, ([low, high], out): ([[f64; 2]; 2], [f64; 2]), range: [f64; 2]) {
    let length = (high[0] - low[0]).hypot(high[1] - low[1]);
    let count = (length / APART).floor();
    let extent = range[1] - range[0];
    if !(count >= 1.0 && extent > 0.0) {
        return;
    }
    let at = |value: f64| {
        let part = (value - range[0]) / extent;
        [0, 1].map(|k| low[k] + part * (high[k] - low[k]))
    };
    line(tile, low, high);
    let step = round(extent / count);
    let decimals = (-step.log10().floor()).clamp(0.0, 17.0) as usize;
    let mut widest = 0;
    for k in (range[0] / step).ceil() as i64..=(range[1] / step).floor() as i64 {
        let value = k as f64 * step;
        let (from, number) = (at(value), format!("{value:.decimals$}"));
        line(tile, from, [0, 1].map(|k| from[k] + MARK * out[k]));
        text(tile, from, out, &number);
        widest = widest.max(number.len());
    }
    // Outside of the numbers.
    let room = [LETTER * widest as u32, LINE].map(f64::from);
    let away = MARK + out[0].abs() * room[0] + out[1].abs() * room[1];
    text(
        tile,
        [0, 1].map(|k| 0.5 * (low[k] + high[k]) + away * out[k]),
        out,
        name,
    );
}

/// The next larger of 1, 2 and 5 times a power of ten.
fn round(step: f64) -> f64 {
    let power = 10f64.powf(step.log10().floor());
    let times = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .find(|times| times * power >= step);
    times.unwrap_or(10.0) * power
}

/// Beside a point, in this direction.
fn text(tile: &mut Pixels, at: [f64; 2], out: [f64; 2], text: &str) {
    let size = [LETTER * text.chars().count() as u32, LINE].map(f64::from);
    let away = 1.5 * MARK + 0.5 * (out[0].abs() * size[0] + out[1].abs() * size[1]);
    let corner = [0, 1].map(|k| {
        let place = at[k] + away * out[k] - 0.5 * size[k];
        place
            .round()
            .clamp(0.0, (f64::from(tile.size[k]) - size[k]).max(0.0)) as u32
    });
    write(tile, corner, text);
}

fn line(tile: &mut Pixels, a: [f64; 2], b: [f64; 2]) {
    let steps = (b[0] - a[0]).abs().max((b[1] - a[1]).abs()).ceil().max(1.0);
    for k in 0..=steps as u32 {
        let part = f64::from(k) / steps;
        let [x, y] = [0, 1].map(|c| (a[c] + part * (b[c] - a[c])).round());
        if x >= 0.0 && y >= 0.0 {
            tile.set(x as u32, y as u32, INK);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round() {
        let steps = [0.9, 1.0, 1.1, 2.3, 5.1, 0.0012, 3e4].map(round);
        let wanted = [1.0, 1.0, 2.0, 5.0, 10.0, 0.002, 5e4];
        assert_all!(steps.iter().zip(wanted), |(step, wanted)| (*step / wanted - 1.0)
            .abs()
            < 1e-12);
    }

    #[test]
    fn outward_is_below_or_left_of_what_is_upright() {
        let along = |x: f64, y: f64| outward(&[[[5.0, 5.0], [5.0 + x, 5.0 + y]]]);
        assert_eq!(along(2.0, 0.0), Some([0.0, 1.0]));
        assert_eq!(along(-2.0, 0.0), Some([0.0, 1.0]));
        assert_eq!(along(0.0, 3.0), Some([-1.0, 0.0]));
        assert_eq!(along(0.0, -3.0), Some([-1.0, 0.0]));
        assert_eq!(along(3.0, 4.0), Some([-0.8, 0.6]));
        assert_eq!(along(0.0, 0.0), None);
    }

    #[test]
    fn an_edge_runs_along_its_axis() {
        let bounds = [[0.0, 10.0, 20.0], [1.0, 12.0, 23.0]];
        for axis in 0..3 {
            let mut starts: Vec<V3> = Vec::new();
            for which in 0..4 {
                let [a, b] = edge(bounds, axis, which);
                let differs: Vec<usize> = (0..3).filter(|&k| a[k] != b[k]).collect();
                assert_eq!(differs, [axis]);
                assert!(!starts.contains(&a));
                starts.push(a);
            }
        }
    }
}
