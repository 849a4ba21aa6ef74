//! A chain of creases as a smooth curve, whatever its edges are.

use nalgebra::{Matrix3, Vector3};

/// Points of the curve at equal distances along the chain.
pub(super) struct ChainCurve {
    pub(super) points: Vec<Vector3<f64>>,
    /// Between points along the chain.
    pub(super) spacing: f64,
    pub(super) is_closed: bool,
    /// Whether the nearest place may lie straight before its first point, or behind its last one.
    pub(super) goes_on: [bool; 2],
    /// Per point the edge of the chain that it was on.
    pub(super) edges: Vec<usize>,
    /// Per point how far the surface bends there, radians; at least [`FLATTEST`].
    pub(super) bends: Vec<f64>,
}

/// Points per width of the band. Half or double: of 25 solids cut from each other one has a crease that stays sharp.
pub(super) const PER_WIDTH: f64 = 8.0;
/// What bends less (radians) counts as this much: where nothing bends, a ball touches both sides in one point, and no band would be left.
/// Half or double, of 25 solids cut from each other: nothing changes.
pub(super) const FLATTEST: f64 = 0.1;
/// Points to each side of one that it is fitted to: half a width.
/// Of 12 solids cut from each other, half or double: 11 stay as sound; of the twelfth, where 22 of 24 creases
/// are rounded, all are at half, and 21 at double.
const WINDOW: usize = 4;
/// Points to each side among which the nearest is looked for.
/// Half or double, of 13 solids cut from each other: all stay sound, with as many vertices to 1 %.
pub(super) const NEAR: i64 = 6;

/// Where on a curve a point is nearest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Nearest {
    /// In points from the first.
    pub(super) at: f64,
    pub(super) distance: f64,
}

impl ChainCurve {
    /// Of the vertices of a chain, in their order, and the bends of its edges. The first vertex is not repeated at the end of a closed one.
    pub(super) fn new(vertices: &[Vector3<f64>], bends: &[f64], is_closed: bool, width: f64) -> Self {
        let (points, places, spacing) = even(vertices, is_closed, width / PER_WIDTH);
        let mut curve = Self {
            bends: places.iter().map(|&k| bends[k]).collect(),
            edges: places,
            points,
            spacing,
            is_closed,
            goes_on: [false; 2],
        };
        curve.bends = curve.averaged(&curve.bends);
        let last = curve.points.len() - 1;
        let is_end = |i: usize| !is_closed && (i == 0 || i == last);
        let smooth = |i: usize| {
            if is_end(i) {
                curve.points[i]
            } else {
                curve.fitted(i)
            }
        };
        curve.points = (0..=last).map(smooth).collect();
        curve
    }

    /// The quadratic curve through the points around one, there.
    fn fitted(&self, i: usize) -> Vector3<f64> {
        let count = self.points.len();
        let most = if self.is_closed {
            (count - 1) / 2
        } else {
            i.min(count - 1 - i)
        };
        let window = WINDOW.min(most) as i64;
        if window < 2 {
            return self.points[i];
        }
        let (mut matrix, mut sums) = (Matrix3::zeros(), Matrix3::zeros());
        for k in -window..=window {
            let t = k as f64 / window as f64;
            let row = Vector3::new(1.0, t, t * t);
            matrix += row * row.transpose();
            sums += row * self.point(i as i64 + k).transpose();
        }
        let solved = matrix.cholesky().map(|factor| factor.solve(&sums));
        solved.map_or(self.points[i], |rows| rows.row(0).transpose())
    }

    /// The mean of bends over the points around each.
    fn averaged(&self, values: &[f64]) -> Vec<f64> {
        let window = -(WINDOW as i64)..=WINDOW as i64;
        let mean = |i: i64| {
            let sum: f64 = window.clone().map(|k| values[self.number(i + k)]).sum();
            (sum / (2 * WINDOW + 1) as f64).max(FLATTEST)
        };
        (0..values.len() as i64).map(mean).collect()
    }

    /// The direction of the curve at a point, of any length.
    pub(super) fn tangent(&self, i: usize) -> Vector3<f64> {
        self.point(i as i64 + 1) - self.point(i as i64 - 1)
    }

    /// How far it is along the curve between two points.
    pub(super) fn between_points(&self, i: usize, j: usize) -> f64 {
        let (steps, count) = (i.abs_diff(j), self.points.len());
        let steps = if self.is_closed {
            steps.min(count - steps)
        } else {
            steps
        };
        steps as f64 * self.spacing
    }

    fn point(&self, i: i64) -> Vector3<f64> {
        self.points[self.number(i)]
    }

    fn number(&self, i: i64) -> usize {
        let count = self.points.len() as i64;
        let i = if self.is_closed {
            i.rem_euclid(count)
        } else {
            i.clamp(0, count - 1)
        };
        i as usize
    }

    /// The nearest place, from a place that is near on.
    pub(super) fn nearest(&self, p: &Vector3<f64>, near: f64) -> Nearest {
        let start = self.segment(near);
        let mut best = Nearest {
            at: near,
            distance: f64::INFINITY,
        };
        let (mut low, mut high) = (start - NEAR, start + NEAR);
        let mut seen = low..low;
        loop {
            for i in (low..=high).filter(|i| !seen.contains(i)) {
                if !self.is_closed && !(0..self.points.len() as i64 - 1).contains(&i) {
                    continue;
                }
                let found = self.on_segment(p, i);
                if found.distance < best.distance {
                    best = found;
                }
            }
            seen = low..high + 1;
            let found = self.segment(best.at);
            let is_inside = found > low && found < high;
            if is_inside || seen.clone().count() > 2 * self.points.len() {
                break;
            }
            (low, high) = (low.min(found - NEAR), high.max(found + NEAR));
            if seen == (low..high + 1) {
                break;
            }
        }
        if self.is_closed {
            let count = self.points.len() as f64;
            best.at -= count * libm::floor(best.at / count);
        }
        best
    }

    /// The number of the point before a place; places before the first point and behind the last one are on the segments there.
    fn segment(&self, at: f64) -> i64 {
        let before = libm::floor(at) as i64;
        match self.is_closed {
            true => before,
            false => before.clamp(0, self.points.len() as i64 - 2),
        }
    }

    fn on_segment(&self, p: &Vector3<f64>, i: i64) -> Nearest {
        let (a, b) = (self.point(i), self.point(i + 1));
        let e = b - a;
        let last = self.points.len() as i64 - 2;
        let low = if i == 0 && self.goes_on[0] {
            f64::NEG_INFINITY
        } else {
            0.0
        };
        let high = if i == last && self.goes_on[1] {
            f64::INFINITY
        } else {
            1.0
        };
        let t = (e.dot(&(p - a)) / e.norm_squared().max(f64::MIN_POSITIVE)).clamp(low, high);
        Nearest {
            at: i as f64 + t,
            distance: (a + e * t - p).norm(),
        }
    }

    /// A function of the points between them.
    pub(super) fn between(&self, values: &[f64], at: f64) -> f64 {
        let i = libm::floor(at) as i64;
        let t = at - i as f64;
        values[self.number(i)] * (1.0 - t) + values[self.number(i + 1)] * t
    }

    /// How far a point is along the chain from its beginning and from its end.
    pub(super) fn to_ends(&self, i: usize) -> [f64; 2] {
        [i, self.points.len() - 1 - i].map(|steps| steps as f64 * self.spacing)
    }
}

/// Points on a line of vertices at equal distances of about `step`, the edges that they are on, and that distance.
fn even(vertices: &[Vector3<f64>], is_closed: bool, step: f64) -> (Vec<Vector3<f64>>, Vec<usize>, f64) {
    let mut line = vertices.to_vec();
    if is_closed {
        line.extend(vertices.first());
    }
    let mut along = vec![0.0];
    for pair in line.windows(2) {
        along.push(along[along.len() - 1] + (pair[1] - pair[0]).norm());
    }
    let length = along[along.len() - 1];
    let parts = libm::ceil(length / step).max(if is_closed { 8.0 } else { 2.0 }) as usize;
    let spacing = length / parts as f64;
    let (mut points, mut places) = (Vec::with_capacity(parts + 1), Vec::with_capacity(parts + 1));
    let mut k = 0;
    for i in 0..parts + usize::from(!is_closed) {
        let s = spacing * i as f64;
        while k + 2 < along.len() && along[k + 1] < s {
            k += 1;
        }
        let part = along[k + 1] - along[k];
        let t = if part > 0.0 {
            ((s - along[k]) / part).clamp(0.0, 1.0)
        } else {
            0.0
        };
        places.push(k);
        points.push(line[k] + (line[k + 1] - line[k]) * t);
    }
    if !is_closed {
        points[parts] = line[line.len() - 1];
    }
    (points, places, spacing)
}
