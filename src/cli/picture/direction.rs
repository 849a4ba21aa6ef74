//! From where a part of a surface is seen best.

use super::camera::Camera;
use super::canvas::Canvas;
use super::view::{PictureOptions, Shading, V3, View};
use crate::normals::{cross, dot, sub, unit};

/// Directions that are tried besides straight above, evenly spread (a spiral): any direction has one within 22 degrees, and a tube is seen from
/// at most 6.3 degrees beside its flank. With half of them 31 and 11, with double 15 and 3.4.
const DIRECTIONS: usize = 48;
/// Straight above, or where there is none the usual direction, is left for one that shows more than this many times as much area. With half or
/// double the surplus none of 16 pictures changes (regions of scans, tubes); without it a closed surface, which all directions show alike, is seen from one of them by chance.
const MORE: f64 = 1.1;
/// Where more than this share of the part is in front of the rest, no other direction is tried. Half: none of the 16 changes; at .95 one does, a neck of
/// a cow behind its head.
const ENOUGH: f64 = 0.7;
/// So many are looked at, of those that are more than 37 degrees (cosine) apart, the one with most area first: a look costs as much as a small
/// picture of the whole mesh. With half or double of them none of the 16 changes.
const LOOKS: usize = 6;
const APART: f64 = 0.8;
/// Pixels of such a look: enough to tell shares by a hundredth.
const LOOK: [usize; 2] = [96, 96];

/// The direction to the eye from which marked triangles show most area, and most of it is in front of the rest. For a part that looks to one side it
/// is straight above; for a tube it is beside its axis.
pub fn best_direction(
    positions: &[V3],
    triangles: &[[u32; 3]],
    marked: &[bool],
    options: &PictureOptions,
) -> V3 {
    let of = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| positions[v as usize]);
        cross(sub(b, a), sub(c, a))
    };
    let is_in = triangles.iter().zip(marked).filter(|(_, is_in)| **is_in);
    let areas: Vec<V3> = is_in
        .clone()
        .map(|(t, _)| of(t))
        .filter(|area| area.iter().all(|x| x.is_finite()))
        .collect();
    let usual = PictureOptions::default().direction;
    let mut sorted: Vec<(f64, V3)> = (above(&areas).or(unit(usual)).into_iter().map(|d| (MORE, d)))
        .chain((0..DIRECTIONS).map(|k| (1.0, spiral(k))))
        .map(|(weight, d)| {
            (
                weight * areas.iter().map(|area| dot(*area, d).max(0.0)).sum::<f64>(),
                d,
            )
        })
        .collect();
    sorted.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut focus = vec![false; positions.len()];
    is_in.flat_map(|(t, _)| t).for_each(|&v| focus[v as usize] = true);
    let view = View {
        positions,
        triangles,
        shading: Shading::Marked(marked),
        focus: &focus,
    };
    most_seen(&sorted, &view, options, marked).unwrap_or(usual)
}

/// Of directions with the areas that face them, one that shows enough of it, or else the most.
fn most_seen(sorted: &[(f64, V3)], view: &View<'_>, options: &PictureOptions, marked: &[bool]) -> Option<V3> {
    let (mut looked, mut best): (Vec<V3>, Option<(f64, V3)>) = (Vec::new(), None);
    for &(facing, direction) in sorted {
        if looked.len() == LOOKS || looked.iter().any(|other| dot(*other, direction) > APART) {
            continue;
        }
        looked.push(direction);
        let options = PictureOptions {
            tile: LOOK,
            samples: 1,
            direction,
            axes: false,
            ..*options
        };
        let share = seen(view, &options, marked);
        if share > ENOUGH {
            return Some(direction);
        }
        if best.is_none_or(|(most, _)| share * facing > most) {
            best = Some((share * facing, direction));
        }
    }
    best.map(|(_, direction)| direction)
}

/// Which share of the pixels that marked triangles would have alone they have in front of all others; 0 if none.
pub(super) fn seen(view: &View<'_>, options: &PictureOptions, marked: &[bool]) -> f64 {
    let camera = Camera::around(std::slice::from_ref(view), options);
    let triangles: Vec<[u32; 3]> = (view.triangles.iter().zip(marked))
        .filter(|(_, marked)| **marked)
        .map(|(t, _)| *t)
        .collect();
    let alone = View {
        triangles: &triangles,
        ..*view
    };
    let count = |view: &View<'_>, is_counted: &dyn Fn(usize) -> bool| {
        let nearest = Canvas::of(view, &camera, options).nearest.into_iter();
        nearest
            .filter(|&(_, t)| t != u32::MAX && is_counted(t as usize))
            .count() as f64
    };
    let most = count(&alone, &|_| true);
    match most > 0.0 {
        true => count(view, &|t| marked[t]) / most,
        false => 0.0,
    }
}

/// The mean normal; None where it looks in all directions.
fn above(areas: &[V3]) -> Option<V3> {
    let total: f64 = areas.iter().map(|area| dot(*area, *area).sqrt()).sum();
    let sum = areas
        .iter()
        .fold([0.0; 3], |sum, area| [0, 1, 2].map(|k| sum[k] + area[k]));
    unit(sum).filter(|_| dot(sum, sum).sqrt() > DECIDED * total)
}

/// A mean normal below this share of the area is noise.
const DECIDED: f64 = 0.05;

/// Points on the unit sphere at equal steps of height, a golden angle apart.
fn spiral(k: usize) -> V3 {
    let height = 1.0 - (2 * k + 1) as f64 / DIRECTIONS as f64;
    let (radius, angle) = ((1.0 - height * height).sqrt(), 2.399_963_229_728_653 * k as f64);
    [radius * angle.cos(), radius * angle.sin(), height]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cylinder around z with a floor, open above; the first faces are the flank's.
    fn bowl(height: f64) -> (Vec<V3>, Vec<[u32; 3]>) {
        const N: u32 = 24;
        let ring = |z: f64| {
            (0..N).map(move |k| {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(N)).sin_cos();
                [cos, sin, z]
            })
        };
        let mut positions: Vec<V3> = ring(0.0).chain(ring(height)).collect();
        positions.push([0.0; 3]);
        let flank = (0..N).flat_map(|k| {
            let (next, up) = ((k + 1) % N, N + k);
            [[k, next, up], [next, N + next, up]]
        });
        let floor = (0..N).map(|k| [2 * N, k, (k + 1) % N]);
        (positions, flank.chain(floor).collect())
    }

    fn seen_from(height: f64, is_marked: impl Fn(usize) -> bool) -> V3 {
        let (positions, triangles) = bowl(height);
        let marked: Vec<bool> = (0..triangles.len()).map(is_marked).collect();
        unit(best_direction(
            &positions,
            &triangles,
            &marked,
            &PictureOptions::default(),
        ))
        .unwrap()
    }

    #[test]
    fn a_tube_is_not_seen_along_its_axis() {
        let direction = seen_from(4.0, |t| t < 48);
        assert_all!([direction], |d| d[2].abs() < 0.3);
    }

    #[test]
    fn what_looks_to_one_side_is_seen_from_straight_above() {
        let flank = seen_from(1.0, |t| t < 6);
        let around = std::f64::consts::TAU * 1.5 / 24.0;
        assert_near!(dot(flank, [around.cos(), around.sin(), 0.0]), 1.0, 1e-3);
        assert_eq!(seen_from(0.3, |t| t >= 48), [0.0, 0.0, 1.0]);
    }

    #[test]
    fn a_floor_below_high_walls_is_seen_from_above_still() {
        let direction = seen_from(3.0, |t| t >= 48);
        assert_all!([direction], |d| d[2] > 0.9);
    }
}
