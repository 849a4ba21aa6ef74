//! Triangulation of a loop in space without new vertices.
//!
//! Up to [`DYNAMIC`] edges: the least (worst dihedral angle, area) by dynamic programming over all triangulations (Barequet
//! and Sharir 1995; Liepa 2003, section 3), where dihedral angles count against the mesh across the boundary, too. That is
//! cubic. A longer loop is first shortened by ears: the triangle over two consecutive edges with the shortest chord,
//! if it bends little and the ball over its chord holds no other vertex of the loop, which makes the chord a Delaunay
//! edge of what is left (a Gabriel edge). Ears that do not fulfil this come last. Time is then quadratic in the worst
//! case with a small factor, memory linear. One with guides is cut at them before.
//!
//! For several loops a sum takes the place of the worst angle: from the end of a tube to the next tube some angle at the
//! boundary is wide in any case, and area would decide between all the rest. Length times angle finds what is plane, narrow or convex;
//! between tubes that are far apart it would put a lid on each, with ribbons between them, which bending energy makes dear.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use fairmesh_linear::interrupt::is_stopped;
use nalgebra::Vector3;

/// Loops of up to this many edges are triangulated by dynamic programming alone.
/// Of 32 cases, half: 9 change, 7 get another triangulation, -7 % iterations; double: 5 change, 5 get another triangulation.
pub(super) const DYNAMIC: usize = 100;
/// The same for sums: a polygon of several loops.
/// Of 14 cases, half: 3 change, 3 get another triangulation; double: 1 changes, 1 get another triangulation.
const DYNAMIC_SUM: usize = 240;
/// Bends (1 - cosine) are compared in steps of one over this; between those in the same step area decides.
/// Half or double, of 32 cases: none changes.
const STEPS: f64 = 1e5;
/// An ear that bends by more than this (1 - cosine, 100 degrees) comes after all that do not.
/// Of 6 cases, half: 1 changes, 1 get another triangulation; double: none changes.
const SHARP: f64 = 1.17;
/// The same for sums: 60 degrees. An ear over the mouth of a tube is none on the way to the next tube.
/// Half or double, of 1 case: none changes.
const SHARP_SUM: f64 = 0.5;
/// What an edge between slender triangles costs beside its bend: on a plane nothing else is to be told.
/// Half or double, of 11 cases: none changes.
const SLENDER: f64 = 1e-4;
/// What an edge costs by its length, beside that times its angle.
/// Half or double, of 14 cases: 2 change, 2 get another triangulation.
const LENGTH: f64 = 1e-3;
/// A flatter triangle (height over longest side) is degenerate: rounding in single precision makes such on straight boundaries.
/// Half or double, of 43 cases: none changes.
const FLAT: f64 = 1e-6;
/// The cost of an ear that shall come later is multiplied by this.
/// Half or double, of 7 cases: none changes.
const LATER: f64 = 1e6;

/// By what triangulations are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Measure {
    /// The worst dihedral angle, then the area.
    WorstBend,
    /// The area.
    Area,
    /// The sum over all edges of length times dihedral angle.
    TotalBend,
    /// The discrete bending energy.
    Energy,
}

impl Measure {
    fn dynamic(self) -> usize {
        match self {
            Self::TotalBend | Self::Energy => DYNAMIC_SUM,
            _ => DYNAMIC,
        }
    }

    fn is_sum(self) -> bool {
        matches!(self, Self::TotalBend | Self::Energy)
    }

    /// The summand of an edge: by its squared length, 1 - cosine of its angle, and the areas of the triangles at it. Of the energy it
    /// is the square of the angle, spread over the width of the two. (Both angles to a few per cent: an inverse cosine would take
    /// most of the time.)
    #[inline]
    pub(super) fn at_edge(self, square: f64, bend: f64, areas: f64) -> f64 {
        if self == Self::Energy {
            let angle = 2.0 * bend * (1.0 + bend / 6.0 + 0.142 * bend * bend * bend);
            return (SLENDER + angle) * square / areas;
        }
        let angle = (2.0 * bend).sqrt() * (1.0 + bend / 12.0 + 0.05 * bend * bend * bend);
        (LENGTH + angle) * square.sqrt()
    }

    fn sharp(self) -> f64 {
        match self {
            Self::TotalBend | Self::Energy => SHARP_SUM,
            _ => SHARP,
        }
    }
}

/// A loop in space.
pub(super) struct Polygon<'a> {
    /// The vertices.
    pub(super) x: &'a [Vector3<f64>],
    /// The unit normal of the mesh's triangle at each edge from a vertex to the next, zero if it has none.
    pub(super) normals: &'a [Vector3<f64>],
    /// Pairs (smaller, larger) of vertices that have an edge already, sorted.
    pub(super) taken: &'a [(u32, u32)],
    /// Pairs (smaller, larger) of vertices that shall have an edge: no other crosses it.
    pub(super) guides: &'a [(u32, u32)],
    /// What decides.
    pub(super) measure: Measure,
    /// Whether a triangle may not be made.
    pub(super) barred: Barred<'a>,
}

/// Whether a triangle may not be made; none: all may.
pub(super) type Barred<'a> = Option<&'a dyn Fn([u32; 3]) -> bool>;

impl Polygon<'_> {
    fn is_free(&self, a: u32, b: u32) -> bool {
        let edge = (a.min(b), a.max(b));
        let is_crossing = |guide: &(u32, u32)| cross(edge, *guide);
        self.taken.binary_search(&edge).is_err() && !self.guides.iter().any(is_crossing)
    }

    /// The triangles, in numbers of the loop's vertices, or `None` if there is no triangulation without the edges taken, or the run is
    /// stopped.
    pub(super) fn triangulate(&self) -> Option<Vec<[u32; 3]>> {
        if self.x.len() > self.measure.dynamic() && !self.guides.is_empty() {
            return self.triangulate_pieces();
        }
        let mut triangles = Vec::with_capacity(self.x.len().saturating_sub(2));
        let (polygon, normals) = if self.x.len() > self.measure.dynamic() {
            self.shorten(&mut triangles)?
        } else {
            ((0..self.x.len() as u32).collect(), self.normals.to_vec())
        };
        self.optimal(&polygon, &normals, &mut triangles)?;
        Some(triangles)
    }

    /// Whether a triangle may be made.
    #[inline]
    fn may_be(&self, triangle: [u32; 3]) -> bool {
        self.barred.is_none_or(|barred| !barred(triangle))
    }

    fn normal(&self, a: u32, b: u32, c: u32) -> (Vector3<f64>, f64) {
        let (a, b, c) = (self.x[a as usize], self.x[b as usize], self.x[c as usize]);
        let cross = (b - a).cross(&(c - a));
        let twice = cross.norm();
        // A triangle whose height is rounding (single precision's, too) has no direction, and counts as a wide one, so that
        // any other is preferred.
        let longest = (b - a)
            .norm_squared()
            .max((c - a).norm_squared())
            .max((c - b).norm_squared());
        if twice > FLAT * longest && twice > 0.0 {
            (cross / twice, 0.5 * twice)
        } else {
            (Vector3::zeros(), longest)
        }
    }

    /// Cuts ears until the dynamic programme can do the rest; the polygon left and the normals beyond its edges.
    fn shorten(&self, triangles: &mut Vec<[u32; 3]>) -> Option<(Vec<u32>, Vec<Vector3<f64>>)> {
        let mut ears = Ears::new(self);
        while ears.left > self.measure.dynamic() {
            triangles.push(ears.cut()?);
        }
        Some(ears.rest())
    }

    /// The best triangulation of a polygon of these vertices; `beyond` are the normals on the other side of its edges.
    fn optimal(&self, polygon: &[u32], beyond: &[Vector3<f64>], triangles: &mut Vec<[u32; 3]>) -> Option<()> {
        let n = polygon.len();
        if n < 3 {
            return None;
        }
        let mut table = vec![Cell::default(); n * n];
        for i in 0..n - 1 {
            table[i * n + i + 1] = Cell {
                worst: 0,
                area: 0.0,
                apex: 0,
                normal: beyond[i],
                own: 0.0,
            };
        }
        for span in 2..n {
            for i in 0..n - span {
                if is_stopped() {
                    return None;
                }
                let k = i + span;
                // The last chord is an edge of the polygon.
                let last = (span == n - 1).then(|| &beyond[n - 1]);
                if last.is_some() || self.is_free(polygon[i], polygon[k]) {
                    table[i * n + k] = self.best(polygon, &table, (i, k), last);
                }
            }
        }
        if table[n - 1].worst == u32::MAX {
            return None;
        }
        let mut open = vec![(0, n - 1)];
        while let Some((i, k)) = open.pop() {
            if k > i + 1 {
                let m = table[i * n + k].apex as usize;
                triangles.push([polygon[i], polygon[m], polygon[k]]);
                open.push((i, m));
                open.push((m, k));
            }
        }
        Some(())
    }

    /// The best triangulation between two vertices of the polygon, by those of smaller parts in `table`; `beyond` is the
    /// normal on the other side of their chord, where there is a triangle.
    #[inline]
    fn best(
        &self,
        polygon: &[u32],
        table: &[Cell],
        (i, k): (usize, usize),
        beyond: Option<&Vector3<f64>>,
    ) -> Cell {
        let n = polygon.len();
        let mut best = Cell::default();
        for m in i + 1..k {
            let (left, right) = (&table[i * n + m], &table[m * n + k]);
            let below = left.worst.max(right.worst);
            if below > best.worst || below == u32::MAX {
                continue;
            }
            let (normal, area) = self.normal(polygon[i], polygon[m], polygon[k]);
            if self.measure.is_sum() {
                let corners = [polygon[i], polygon[m], polygon[k]];
                let cost =
                    left.area + right.area + self.cost(corners, (&normal, area), [left, right], beyond);
                if cost < best.area && self.may_be(corners) {
                    best = Cell {
                        worst: 0,
                        area: cost,
                        apex: m as u32,
                        normal,
                        own: area,
                    };
                }
                continue;
            }
            let mut bend = bend(&normal, &left.normal).max(bend_at(&normal, &right.normal));
            if let Some(beyond) = beyond {
                bend = bend.max(bend_at(&normal, beyond));
            }
            if self.measure == Measure::Area {
                bend = 0.0;
            }
            let cell = Cell {
                worst: below.max((bend * STEPS) as u32),
                area: left.area + right.area + area,
                apex: m as u32,
                normal,
                own: area,
            };
            let is_better = (cell.worst, cell.area) < (best.worst, best.area);
            if is_better && self.may_be([polygon[i], polygon[m], polygon[k]]) {
                best = cell;
            }
        }
        best
    }

    /// What a triangle costs: the bends over its first two sides, and over the third where the mesh is beyond it.
    #[inline]
    fn cost(
        &self,
        [a, b, c]: [u32; 3],
        (normal, own): (&Vector3<f64>, f64),
        [left, right]: [&Cell; 2],
        beyond: Option<&Vector3<f64>>,
    ) -> f64 {
        let (a, b, c) = (self.x[a as usize], self.x[b as usize], self.x[c as usize]);
        let over = |edge: Vector3<f64>, other: &Vector3<f64>, theirs: f64| {
            // The mesh beyond a boundary edge takes no part of the bend.
            let theirs = if theirs > 0.0 { theirs } else { own };
            let bend = bend(normal, other);
            self.measure.at_edge(edge.norm_squared(), bend, own + theirs)
        };
        let first = over(b - a, &left.normal, left.own) + over(c - b, &right.normal, right.own);
        first + beyond.map_or(0.0, |beyond| over(c - a, beyond, 0.0))
    }
}

/// Whether two chords of a polygon cross; each is a pair (smaller, larger) of its vertices.
pub(super) fn cross((a, b): (u32, u32), (c, d): (u32, u32)) -> bool {
    let is_inside = |v: u32| a < v && v < b;
    let is_outside = |v: u32| v < a || v > b;
    is_inside(c) && is_outside(d) || is_inside(d) && is_outside(c)
}

/// The best triangulation between two vertices of a polygon: its worst bend in steps, its area (of least energy: that
/// it costs), and the triangle at the chord.
#[derive(Clone, Copy)]
struct Cell {
    worst: u32,
    area: f64,
    apex: u32,
    normal: Vector3<f64>,
    /// The area of that triangle; zero at an edge of the polygon.
    own: f64,
}

impl Default for Cell {
    fn default() -> Self {
        Self {
            worst: u32::MAX,
            area: f64::INFINITY,
            apex: 0,
            normal: Vector3::zeros(),
            own: 0.0,
        }
    }
}

/// 1 - cosine of the angle between the normals of neighbours; 2 if the first has none, 0 if only the second has none.
#[inline]
fn bend(normal: &Vector3<f64>, other: &Vector3<f64>) -> f64 {
    if *normal == Vector3::zeros() {
        2.0
    } else {
        bend_at(normal, other)
    }
}

#[inline]
fn bend_at(normal: &Vector3<f64>, other: &Vector3<f64>) -> f64 {
    if *other == Vector3::zeros() {
        0.0
    } else {
        (1.0 - normal.dot(other)).max(0.0)
    }
}

/// A loop that is being shortened.
struct Ears<'a> {
    polygon: &'a Polygon<'a>,
    next: Vec<u32>,
    prev: Vec<u32>,
    /// The normal beyond the edge to the next vertex.
    normals: Vec<Vector3<f64>>,
    alive: Vec<bool>,
    left: usize,
    queue: BinaryHeap<Reverse<Ear>>,
}

/// Cost (bits of a number that is not negative), vertex, its neighbours then, whether its ball was looked at.
type Ear = (u64, u32, u32, u32, bool);

impl<'a> Ears<'a> {
    fn new(polygon: &'a Polygon<'a>) -> Self {
        let n = polygon.x.len() as u32;
        let mut ears = Self {
            polygon,
            next: (0..n).map(|i| (i + 1) % n).collect(),
            prev: (0..n).map(|i| (i + n - 1) % n).collect(),
            normals: polygon.normals.to_vec(),
            alive: vec![true; n as usize],
            left: n as usize,
            queue: BinaryHeap::new(),
        };
        (0..n).for_each(|v| ears.push(v));
        ears
    }

    fn push(&mut self, v: u32) {
        let (a, b) = (self.prev[v as usize], self.next[v as usize]);
        if !self.polygon.is_free(a, b) {
            return;
        }
        let (normal, _) = self.polygon.normal(a, v, b);
        let chord = (self.polygon.x[b as usize] - self.polygon.x[a as usize]).norm();
        let bend = bend(&normal, &self.normals[a as usize]).max(bend_at(&normal, &self.normals[v as usize]));
        let mut cost = chord * (1.0 + bend);
        if bend > self.polygon.measure.sharp() {
            cost *= LATER * LATER;
        }
        if normal == Vector3::zeros() {
            cost *= LATER;
        }
        self.queue.push(Reverse((cost.to_bits(), v, a, b, false)));
    }

    fn cut(&mut self) -> Option<[u32; 3]> {
        while !is_stopped() {
            let Reverse((cost, v, a, b, looked)) = self.queue.pop()?;
            let i = v as usize;
            if !self.alive[i] || self.prev[i] != a || self.next[i] != b {
                continue;
            }
            if !self.polygon.may_be([a, v, b]) {
                continue;
            }
            if !looked && self.is_crowded(v, a, b) {
                let later = f64::from_bits(cost) * LATER;
                self.queue.push(Reverse((later.to_bits(), v, a, b, true)));
                continue;
            }
            self.alive[i] = false;
            self.left -= 1;
            self.next[a as usize] = b;
            self.prev[b as usize] = a;
            self.normals[a as usize] = self.polygon.normal(a, v, b).0;
            self.push(a);
            self.push(b);
            return Some([a, v, b]);
        }
        None
    }

    /// Whether the ball over the chord holds another vertex of what is left.
    fn is_crowded(&self, v: u32, a: u32, b: u32) -> bool {
        let (p, q) = (self.polygon.x[a as usize], self.polygon.x[b as usize]);
        let mut w = self.next[b as usize];
        while w != a {
            let x = self.polygon.x[w as usize];
            if w != v && (p - x).dot(&(q - x)) < 0.0 {
                return true;
            }
            w = self.next[w as usize];
        }
        false
    }

    fn rest(&self) -> (Vec<u32>, Vec<Vector3<f64>>) {
        (0..self.next.len())
            .scan(None, |at: &mut Option<u32>, _| {
                let first = || self.alive.iter().position(|&alive| alive).unwrap_or(0) as u32;
                let v = match *at {
                    None => first(),
                    Some(v) => self.next[v as usize],
                };
                *at = Some(v);
                Some((v, self.normals[v as usize]))
            })
            .take(self.left)
            .unzip()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangulate(x: &[[f64; 3]], taken: &[(u32, u32)]) -> Option<Vec<[u32; 3]>> {
        let x: Vec<_> = x.iter().map(|&p| Vector3::from(p)).collect();
        let normals = vec![Vector3::zeros(); x.len()];
        Polygon {
            x: &x,
            normals: &normals,
            taken,
            guides: &[],
            measure: Measure::WorstBend,
            barred: None,
        }
        .triangulate()
    }

    fn signed_area(x: &[[f64; 3]], t: &[u32; 3]) -> f64 {
        let [a, b, c] = t.map(|v| Vector3::from(x[v as usize]));
        0.5 * (b - a).cross(&(c - a)).z
    }

    #[test]
    fn a_polygon_with_a_notch_is_triangulated_without_folds() {
        let x = [[0., 0.], [2., 0.], [2., 2.], [1., 0.5], [0., 2.]].map(|[x, y]| [x, y, 0.0]);
        let triangles = triangulate(&x, &[]).unwrap();
        let areas: Vec<f64> = triangles.iter().map(|t| signed_area(&x, t)).collect();
        assert_all!(areas.iter(), |&a| a > 0.0);
        assert_near!(areas.iter().sum::<f64>(), 2.5, 1e-12);
    }

    #[test]
    fn edges_that_are_there_already_are_not_made_again() {
        let x = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];
        let has = |t: &[[u32; 3]], v| t.iter().filter(|t| t.contains(&v)).count() == 2;
        assert!(has(&triangulate(&x, &[(0, 2)]).unwrap(), 1));
        assert!(has(&triangulate(&x, &[(1, 3)]).unwrap(), 0));
        assert_eq!(triangulate(&x, &[(0, 2), (1, 3)]), None);
    }

    #[test]
    fn the_bend_counts_before_the_area() {
        // The diagonal of a folded square that keeps the worst angle small is the ridge's own.
        let x = [[0., 0., 0.], [1., 0., 1.], [0., 1., 0.], [-1., 0., 1.]];
        let triangles = triangulate(&x, &[]).unwrap();
        let bend = |t: &[[u32; 3]]| {
            let normal = |t: &[u32; 3]| {
                let [a, b, c] = t.map(|v| Vector3::from(x[v as usize]));
                (b - a).cross(&(c - a)).normalize()
            };
            normal(&t[0]).dot(&normal(&t[1]))
        };
        assert_at_least!(bend(&triangles), bend(&[[0, 1, 2], [0, 2, 3]]) - 1e-12);
        assert_at_least!(bend(&triangles), bend(&[[0, 1, 3], [1, 2, 3]]) - 1e-12);
    }

    #[test]
    fn a_long_loop_is_shortened_and_covered_once() {
        let n = 1_000;
        let x: Vec<[f64; 3]> = (0..n)
            .map(|i| {
                let a = std::f64::consts::TAU * f64::from(i) / f64::from(n);
                let r = 1.0 + 0.2 * (9.0 * a).sin() + if i % 2 == 0 { 0.003 } else { 0.0 };
                [r * a.cos(), r * a.sin(), 0.0]
            })
            .collect();
        // Without the mesh's normals nothing would tell an ear from a notch.
        let at: Vec<_> = x.iter().map(|&p| Vector3::from(p)).collect();
        let normals = vec![Vector3::z(); n as usize];
        let loop_in_plane = Polygon {
            x: &at,
            normals: &normals,
            taken: &[],
            guides: &[],
            measure: Measure::WorstBend,
            barred: None,
        };
        let triangles = loop_in_plane.triangulate().unwrap();
        assert_eq!(triangles.len(), x.len() - 2);
        let exact: f64 = (0..x.len())
            .map(|i| {
                let (p, q) = (x[i], x[(i + 1) % x.len()]);
                0.5 * (p[0] * q[1] - p[1] * q[0])
            })
            .sum();
        let areas: Vec<f64> = triangles.iter().map(|t| signed_area(&x, t)).collect();
        assert_near!(areas.iter().sum::<f64>(), exact, 1e-9);
        assert_all!(areas.iter(), |&a| a > -1e-12);
    }
}
