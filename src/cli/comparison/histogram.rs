//! How the mean curvature is spread over what has changed, before and after, as SVG.

use std::fmt::Write;

use super::changes::Comparison;
use super::markup;
use super::surface::MeshSide;
use crate::normals::{cross, dot, sub};
use crate::render::range::{self, Shown};

/// Bars of the histogram.
const BARS: usize = 48;
/// Width and height of the plot, room for the axis, and for what stands beside it.
const PLOT: [f64; 2] = [620.0, 200.0];
const EDGE: [f64; 2] = [16.0, 28.0];

/// Shares of the area in each bar; those beyond the axis are in the first and last one.
type Bars = [f64; BARS];

/// The histogram; None where there is no curvature to be shown.
pub fn histogram(of: &Comparison<'_>) -> Option<String> {
    let sides = [(&of.before, &of.gone), (&of.after, &of.new)];
    let values = [0, 1].map(|side| of.curvature(side));
    let focus = sides.map(|(surface, marked)| surface.vertices_of(marked));
    let shown: Vec<Shown<'_>> = (0..2)
        .filter(|&k| focus[k].contains(&true))
        .map(|k| Shown {
            positions: sides[k].0.positions,
            triangles: sides[k].0.triangles,
            values: values[k],
            focus: &focus[k],
        })
        .collect();
    let ends = range::usual("H", &shown).range;
    let bars = [0, 1].map(|k| bars(sides[k].0, sides[k].1, values[k], ends));
    bars.iter().any(|bars| bars.is_some()).then(|| svg(&bars, ends))
}

/// Every changed triangle counts by its area, with the mean of its corners.
fn bars(surface: &MeshSide<'_>, marked: &[bool], values: &[f64], [low, high]: [f64; 2]) -> Option<Bars> {
    let (mut bars, mut total) = ([0.0; BARS], 0.0);
    for t in (0..marked.len()).filter(|&t| marked[t]) {
        let [a, b, c] = surface.corners(t);
        let normal = cross(sub(b, a), sub(c, a));
        let area = dot(normal, normal).sqrt();
        let corners = surface.triangles[t].map(|v| values[v as usize]);
        let share = (corners.iter().sum::<f64>() / 3.0 - low) / (high - low);
        if area.is_finite() && share.is_finite() {
            // The cast keeps to the range.
            bars[((share * BARS as f64) as usize).min(BARS - 1)] += area;
            total += area;
        }
    }
    (total > 0.0).then(|| bars.map(|bar| bar / total))
}

fn svg(bars: &[Option<Bars>; 2], [low, high]: [f64; 2]) -> String {
    let most = bars
        .iter()
        .flatten()
        .flatten()
        .fold(0.0f64, |most, &bar| most.max(bar));
    let ([width, height], [left, below]) = (PLOT, EDGE);
    let mut out = format!(
        "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"Histogram of the mean curvature before and after\">\n",
        width + 2.0 * left,
        height + below + 8.0
    );
    for (bars, class) in bars.iter().zip(["before", "after"]) {
        let Some(bars) = bars else { continue };
        let mut path = format!("M{left} {:.1}", height + 8.0);
        for (k, bar) in bars.iter().enumerate() {
            let y = 8.0 + height * (1.0 - bar / most);
            let x = |k: usize| left + width * k as f64 / BARS as f64;
            let _ = write!(path, "V{y:.1}H{:.1}", x(k + 1));
        }
        let _ = writeln!(out, "<path class=\"{class}\" d=\"{path}V{:.1}Z\"/>", height + 8.0);
    }
    let _ = writeln!(
        out,
        "<path class=\"axis\" d=\"M{left} {y:.1}H{:.1}\"/>",
        left + width,
        y = height + 8.0
    );
    let scale = range::asked("H", [low, high]);
    for (share, anchor) in [(0.0, "start"), (0.5, "middle"), (1.0, "end")] {
        let number = markup::escaped(&scale.number(low + share * (high - low)));
        let (x, y) = (left + share * width, height + below);
        let _ = writeln!(
            out,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{number}</text>"
        );
    }
    out + "</svg>\n"
}
