//! The ends of a scale that shows the surface, whatever a few vertices have.

use crate::picture::{Palette, Scale};

/// Shares of the area that may lie below and above the scale.
const BEYOND: f64 = 0.01;
/// The ends are not farther from the median than this many times what the middle 80 per cent of the area are: a few
/// places of strong curvature would take all colours.
const FARTHEST: f64 = 4.0;
/// Where the end that is nearer to zero is less than this share of the other one, zero belongs to the scale.
const NEAR: f64 = 0.3;

/// Values of a mesh's vertices, and what of it is in the picture.
pub struct Shown<'a> {
    pub positions: &'a [[f64; 3]],
    pub triangles: &'a [[u32; 3]],
    pub values: &'a [f64],
    /// Empty: all.
    pub focus: &'a [bool],
}

/// A value and how much of all surfaces has it.
type Share = (f64, f64);

/// A scale for all meshes together, each of which counts as much as the others.
pub fn usual(title: &str, shown: &[Shown<'_>]) -> Scale {
    let mut shares: Vec<Share> = shown.iter().flat_map(shares).collect();
    shares.sort_by(|a, b| a.0.total_cmp(&b.0));
    let total: f64 = shares.iter().map(|share| share.1).sum();
    let at = |wanted: f64| {
        let mut sum = 0.0;
        let reached = shares.iter().find(|share| {
            sum += share.1;
            sum >= wanted * total
        });
        reached.or(shares.last()).map_or(0.0, |share| share.0)
    };
    let median = at(0.5);
    let low = at(BEYOND).max(median - FARTHEST * (median - at(0.1)));
    let high = at(1.0 - BEYOND).min(median + FARTHEST * (at(0.9) - median));
    let (range, palette) = ends([low, high], median);
    Scale {
        title: title.to_owned(),
        range,
        palette,
    }
}

/// A scale with ends that were asked for.
pub fn asked(title: &str, range: [f64; 2]) -> Scale {
    Scale {
        title: title.to_owned(),
        range,
        palette: match range[0] < 0.0 && range[1] > 0.0 {
            true => Palette::Diverging,
            false => Palette::Sequential,
        },
    }
}

/// Zero is the middle where both signs occur, or nearly; a surface of constant curvature is all in the middle of a scale that does not show
/// rounding.
fn ends([low, high]: [f64; 2], median: f64) -> ([f64; 2], Palette) {
    let largest = low.abs().max(high.abs());
    if largest == 0.0 {
        return ([-1.0, 1.0], Palette::Diverging);
    }
    let has_both = low < 0.0 && high > 0.0;
    if has_both || low.abs().min(high.abs()) < NEAR * largest {
        return ([-largest, largest], Palette::Diverging);
    }
    let least = 1e-3 * largest;
    if high - low < least {
        return ([median - 0.5 * least, median + 0.5 * least], Palette::Sequential);
    }
    ([low, high], Palette::Sequential)
}

/// The finite values inside a mesh, as shares of its area. At its boundary the curvature is that of one side, and rough.
fn shares(of: &Shown<'_>) -> Vec<Share> {
    let mut areas = vec![0.0; of.positions.len()];
    for t in of.triangles {
        let [a, b, c] = t.map(|v| of.positions[v as usize]);
        let cross = crate::normals::cross(crate::normals::sub(b, a), crate::normals::sub(c, a));
        let area = crate::normals::dot(cross, cross).sqrt();
        if area.is_finite() {
            t.iter().for_each(|&v| areas[v as usize] += area);
        }
    }
    let is_boundary = boundary(of);
    let with = |skips_boundary: bool| -> Vec<Share> {
        let is_shown = |v: &usize| {
            (of.focus.is_empty() || of.focus[*v])
                && of.values[*v].is_finite()
                && !(skips_boundary && is_boundary[*v])
        };
        let shown = (0..of.values.len()).filter(is_shown);
        shown
            .map(|v| (of.values[v], areas[v]))
            .filter(|share| share.1 > 0.0)
            .collect()
    };
    let mut shares = with(true);
    if shares.is_empty() {
        shares = with(false);
    }
    let total: f64 = shares.iter().map(|share| share.1).sum();
    shares.iter_mut().for_each(|share| share.1 /= total);
    shares
}

/// Whether each vertex is at an edge that has one triangle only.
fn boundary(of: &Shown<'_>) -> Vec<bool> {
    let mut edges: Vec<[u32; 2]> = Vec::with_capacity(3 * of.triangles.len());
    for t in of.triangles {
        for k in 0..3 {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            edges.push([a.min(b), a.max(b)]);
        }
    }
    edges.sort_unstable();
    let mut is_boundary = vec![false; of.positions.len()];
    for same in edges.chunk_by(|a, b| a == b) {
        if let [edge] = same {
            edge.iter().for_each(|&v| is_boundary[v as usize] = true);
        }
    }
    is_boundary
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formats::Geometry;

    /// A strip of squares, ten by so many.
    fn strip(length: usize) -> Geometry {
        let width = 10;
        let at = |v: usize| [(v % width) as f64, (v / width) as f64, 0.0];
        let mut triangles = Vec::new();
        for j in 0..length - 1 {
            for i in 0..width - 1 {
                let v = (j * width + i) as u32;
                triangles.push([v, v + 1, v + 11]);
                triangles.push([v, v + 11, v + 10]);
            }
        }
        Geometry::of_triangles((0..width * length).map(at).collect(), triangles)
    }

    fn scale(values: impl Fn(usize) -> f64) -> Scale {
        let mesh = strip(50);
        let values: Vec<f64> = (0..mesh.positions.len()).map(values).collect();
        let shown = Shown {
            positions: &mesh.positions,
            triangles: &mesh.triangles,
            values: &values,
            focus: &[],
        };
        usual("H", &[shown])
    }

    #[test]
    fn a_few_wild_vertices_and_the_boundary_do_not_count() {
        let calm = |v: usize| (v % 7) as f64 - 3.0;
        let usual = scale(calm);
        assert_eq!((usual.range, usual.palette), ([-3.0, 3.0], Palette::Diverging));
        let spoilt = scale(|v| match v {
            123 => 1e9,
            234 => f64::NAN,
            _ if v % 10 == 0 || v % 10 == 9 => -5e4,
            _ => calm(v),
        });
        assert_eq!(spoilt, usual);
        // A tenth of the surface is a sharp edge.
        let edge = scale(|v| if (220..260).contains(&v) { 1000.0 } else { calm(v) });
        assert!(edge.range[1] <= 12.0, "{edge:?}");
    }

    #[test]
    fn the_scale_is_about_zero_or_about_what_all_have() {
        let sphere = scale(|v| -1.0 + 1e-9 * (v % 3) as f64);
        assert_eq!(sphere.palette, Palette::Sequential);
        let [low, high] = sphere.range;
        assert_near!(low, -1.0005, 1e-6);
        assert_near!(high, -0.9995, 1e-6);
        let one_sided = scale(|v| 2.0 + (v % 5) as f64);
        assert_eq!(
            (one_sided.range, one_sided.palette),
            ([2.0, 6.0], Palette::Sequential)
        );
        let nearly = scale(|v| -0.5 - (v % 5) as f64);
        assert_eq!((nearly.range, nearly.palette), ([-4.5, 4.5], Palette::Diverging));
        let skewed = scale(|v| (v % 7) as f64 - 1.0);
        assert_eq!((skewed.range, skewed.palette), ([-5.0, 5.0], Palette::Diverging));
        assert_eq!(scale(|_| 0.0).range, [-1.0, 1.0]);
    }
}
