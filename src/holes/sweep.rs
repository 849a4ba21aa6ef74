//! Between the ends of a tube: rows of vertices along a spine, as many as girth and gap ask for.
//!
//! A triangulation without new vertices puts a lid on each end, with a thread between them, or has edges as long as the gap. Here the loops
//! are carried along a cubic that begins and ends on their axes, turned as little as possible, and one fades into the other. The fairing
//! forgets these positions; what it needs is their connectivity, and edges about as long as they will be.

use std::f64::consts::FRAC_PI_3;

use nalgebra::{Matrix3, Vector3};

use super::loop_set::LoopSet;
use super::patch::Patch;

/// Fewer rows than this are none: what is as narrow as that has no inside that a triangulation of the loops could miss.
/// Half, of 62 pipes: none changes; double: 2 get another triangulation.
const LEAST_ROWS: usize = 2;
/// Vertices of a row, at least: from a triangle, too, a tube becomes round.
/// Half or double, of 62 pipes: none changes.
const LEAST_AROUND: usize = 6;
/// Places around a loop at which it is compared with the other, and steps along the spine in which it is turned.
/// Of 62 pipes, half: 17 get another triangulation, their radii change by up to 0.03; double: 15, by up to 0.03.
const PLACES: usize = 64;

/// Between ends that are further from each other than this many of the longer girth, films have a thread between them at best: a straight pipe
/// that is harmonic is as long as one.
/// Half or double, of 62 pipes as long as 6 radii at most: the same are found.
const LONG: f64 = 1.0;

/// What is between the two loops.
pub(super) struct Sweep {
    /// Without new vertices: where those of the patch come from.
    pub(super) coarse: Patch,
    /// With the rows.
    pub(super) patch: Patch,
}

/// One of both loops, seen along the spine.
struct End {
    centre: Vector3<f64>,
    /// The direction in which the tube goes on from the mesh.
    axis: Vector3<f64>,
    ring: Ring,
    girth: f64,
    /// Per vertex of the loop the length of edges there, and their mean.
    sizes: Vec<f64>,
    size: f64,
}

/// Vertices around the spine, in the direction of the first loop.
struct Ring {
    vertices: Vec<u32>,
    /// How far each one is around, from 0 to 1.
    around: Vec<f64>,
}

/// The rows between two loops that are ends of a tube, or none if they are not, or too near to each other. Edges are wanted as long as
/// `factor` times those of the mesh at each vertex, of no more `sizes` than a loop's own; there are about `most` vertices, at most.
pub(super) fn sweep(set: &LoopSet, sizes: &[f64], factor: f64, most: usize) -> Option<Sweep> {
    Swept::of(set, sizes)?.rows(factor, most)
}

/// Whether the loops are ends of a tube, and far from each other ([`LONG`]).
pub(super) fn is_long(set: &LoopSet) -> bool {
    Swept::of(set, &vec![f64::INFINITY; set.x.len()]).is_some_and(|swept| {
        let girths = swept.ends.iter().map(|end| end.girth);
        swept.spine.length > LONG * girths.fold(0.0, f64::max)
    })
}

/// Whether the mesh has an edge between both loops.
fn is_linked(set: &LoopSet) -> bool {
    let second = set.starts[1] as u32;
    set.taken.iter().any(|&(a, b)| a < second && b >= second)
}

/// Both loops, if they are ends of a tube.
fn ends(set: &LoopSet, sizes: &[f64]) -> Option<[End; 2]> {
    let [first, second] = set.tube_axes([0, 1])?;
    let end = |of: usize, axis| {
        let (ring, girth) = Ring::of_loop(set, of);
        let count = ring.vertices.len() as f64;
        // Quads may be as long as a tube; what it needs is as many rows as its girth asks for.
        let sizes: Vec<f64> = (sizes[set.range(of)].iter())
            .map(|size| size.min(girth / count))
            .collect();
        End {
            centre: set.plane(of).centre,
            axis,
            size: sizes.iter().sum::<f64>() / count,
            sizes,
            ring,
            girth,
        }
    };
    Some([end(0, first), end(1, second)])
}

impl Ring {
    /// A loop and its length; the second one the other way around.
    fn of_loop(set: &LoopSet, of: usize) -> (Self, f64) {
        let mut vertices: Vec<u32> = set.range(of).map(|v| v as u32).collect();
        if of == 1 {
            vertices[1..].reverse();
        }
        let at = |i: usize| set.x[vertices[i % vertices.len()] as usize];
        let mut around = Vec::with_capacity(vertices.len());
        let mut girth = 0.0;
        for i in 0..vertices.len() {
            around.push(girth);
            girth += (at(i + 1) - at(i)).norm();
        }
        around.iter_mut().for_each(|around| *around /= girth);
        (Self { vertices, around }, girth)
    }

    /// The vertex at or before a place, the one after it, and how far between them the place is.
    fn between(&self, place: f64) -> ([u32; 2], f64) {
        let place = place - place.floor();
        let i = self.around.partition_point(|&a| a <= place).max(1) - 1;
        let next = (i + 1) % self.vertices.len();
        let end = if next == 0 { 1.0 } else { self.around[next] };
        let part = (place - self.around[i]) / (end - self.around[i]).max(f64::MIN_POSITIVE);
        ([self.vertices[i], self.vertices[next]], part.min(1.0))
    }
}

/// The curve between the centres, and how what is carried along it is turned.
struct Spine {
    /// Hermite's cubic: both ends, and the derivatives there.
    ends: [Vector3<f64>; 2],
    derivatives: [Vector3<f64>; 2],
    length: f64,
    turned: Vec<Matrix3<f64>>,
}

impl Spine {
    fn new(ends: &[End; 2]) -> Self {
        let [a, b] = ends;
        // Derivatives of the cubic that is nearest to an arc.
        let half = (0.5 - 0.5 * a.axis.dot(&b.axis)).max(0.0).sqrt();
        let speed = (b.centre - a.centre).norm() * 2.0 / (1.0 + half);
        let mut spine = Self {
            ends: [a.centre, b.centre],
            derivatives: [a.axis * speed, -b.axis * speed],
            length: 0.0,
            turned: Vec::new(),
        };
        spine.turn();
        spine
    }

    fn at(&self, s: f64) -> Vector3<f64> {
        let (r, [a, b], [da, db]) = (1.0 - s, self.ends, self.derivatives);
        (a * (1.0 + 2.0 * s) + da * s) * r * r + (b * (1.0 + 2.0 * r) - db * r) * s * s
    }

    /// From step to step by the least turn that takes one direction into the next.
    fn turn(&mut self) {
        let step = |k: usize| self.at((k + 1) as f64 / PLACES as f64) - self.at(k as f64 / PLACES as f64);
        let mut turned = vec![Matrix3::identity()];
        let mut before = self.derivatives[0];
        let mut length = 0.0;
        for k in 0..=PLACES {
            let next = if k < PLACES { step(k) } else { self.derivatives[1] };
            length += if k < PLACES { next.norm() } else { 0.0 };
            turned.push(least_turn(&before, &next) * turned[k]);
            before = next;
        }
        (self.turned, self.length) = (turned, length);
    }

    /// The turn from the first end to a place.
    fn turned_at(&self, s: f64) -> &Matrix3<f64> {
        match s >= 1.0 {
            true => &self.turned[PLACES + 1],
            false => &self.turned[(s * PLACES as f64) as usize + usize::from(s > 0.0)],
        }
    }
}

/// The rotation of one direction into another, about the axis across both (Rodrigues).
fn least_turn(from: &Vector3<f64>, to: &Vector3<f64>) -> Matrix3<f64> {
    let unit = |v: &Vector3<f64>| v.try_normalize(0.0);
    let (Some(from), Some(to)) = (unit(from), unit(to)) else {
        return Matrix3::identity();
    };
    let across = from.cross(&to).cross_matrix();
    let cosine = from.dot(&to);
    match cosine > -0.5 {
        true => Matrix3::identity() + across + across * across / (1.0 + cosine),
        // A cubic turns so far between two steps only in a cusp.
        false => Matrix3::identity(),
    }
}

/// The surface that the loops are carried along.
struct Swept<'a> {
    set: &'a LoopSet,
    ends: [End; 2],
    spine: Spine,
    /// How far around the second loop is what is at the start of the first.
    shift: f64,
}

impl<'a> Swept<'a> {
    /// That between two loops that are ends of a tube.
    fn of(set: &'a LoopSet, sizes: &[f64]) -> Option<Self> {
        if set.count() != 2 || !set.guides.is_empty() || is_linked(set) {
            return None;
        }
        let ends = ends(set, sizes)?;
        let spine = Spine::new(&ends);
        let mut swept = Self {
            set,
            ends,
            spine,
            shift: 0.0,
        };
        swept.shift = swept.least_twist();
        Some(swept)
    }

    /// A place on one of both loops, from its centre, as it is at the first end.
    fn offset(&self, of: usize, around: f64) -> Vector3<f64> {
        let end = &self.ends[of];
        let ([a, b], part) = end.ring.between(around);
        let [a, b] = [a, b].map(|v| self.set.x[v as usize]);
        let offset = a + (b - a) * part - end.centre;
        match of {
            0 => offset,
            _ => self.spine.turned_at(1.0).tr_mul(&offset),
        }
    }

    /// The shift at which the loops lie nearest to each other.
    fn least_twist(&self) -> f64 {
        let place = |k: usize| (k % PLACES) as f64 / PLACES as f64;
        let around = |of| (0..PLACES).map(|k| self.offset(of, place(k))).collect::<Vec<_>>();
        let (first, second) = (around(0), around(1));
        let apart = |shift: usize| -> f64 {
            let pairs = first.iter().zip(second.iter().cycle().skip(shift));
            pairs.map(|(a, b)| (b - a).norm_squared()).sum()
        };
        let best = (0..PLACES)
            .map(|k| (apart(k), k))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        place(best.map_or(0, |best| best.1))
    }

    fn at(&self, around: f64, along: f64) -> Vector3<f64> {
        let offset = self.offset(0, around) * (1.0 - along) + self.offset(1, around + self.shift) * along;
        self.spine.at(along) + self.spine.turned_at(along) * offset
    }

    /// Between both loops themselves.
    fn ruled(&self, around: f64, along: f64) -> Vector3<f64> {
        let on = |of: usize, around| {
            let ([a, b], part) = self.ends[of].ring.between(around);
            let [a, b] = [a, b].map(|v| self.set.x[v as usize]);
            a + (b - a) * part
        };
        on(0, around) * (1.0 - along) + on(1, around + self.shift) * along
    }

    fn rows(&self, factor: f64, most: usize) -> Option<Sweep> {
        let [a, b] = &self.ends;
        let mean = |of: fn(&End) -> f64, along: f64| of(a) * (1.0 - along) + of(b) * along;
        let length = self.mean_length();
        let height = libm::sin(FRAC_PI_3) * factor;
        let expected = length * mean(|end| end.girth / (end.size * end.size), 0.5) / (height * factor);
        let coarser = (expected / most.max(1) as f64).sqrt().max(1.0);
        let strips = length / (height * coarser * mean(|end| end.size, 0.5));
        let strips = strips.round() as usize;
        if strips <= LEAST_ROWS {
            return None;
        }
        let last = self.last_ring();
        let (coarse, near) = self.direct(&last);
        let mut rings = Vec::new();
        let mut patch = coarse.clone();
        patch.size = [&a.sizes[..], &b.sizes[..]].concat();
        for row in 1..strips {
            let along = row as f64 / strips as f64;
            let size = mean(|end| end.size, along) * factor * coarser;
            let count = (mean(|end| end.girth, along) / size).round() as usize;
            let count = count.max(LEAST_AROUND);
            let start = 0.5 * (row % 2) as f64;
            let around: Vec<f64> = (0..count).map(|i| (i as f64 + start) / count as f64).collect();
            let first = patch.x.len() as u32;
            for &around in &around {
                patch.x.push(self.at(around, along));
                patch.source.push(self.ruled(around, along));
                let before = near.partition_point(|&(place, _)| place <= around).max(1) - 1;
                patch.hint.push(near[before].1);
                patch.size.push(mean(|end| end.size, along));
            }
            let vertices = (first..first + count as u32).collect();
            rings.push(Ring { vertices, around });
        }
        let chain: Vec<&Ring> = [&a.ring].into_iter().chain(&rings).chain([&last]).collect();
        let triangles = chain
            .windows(2)
            .flat_map(|pair| strip(pair[0], pair[1]))
            .collect();
        let (source, hint, size) = (patch.source, patch.hint, patch.size);
        let mut patch = Patch::new(patch.x, triangles, coarse.fixed);
        (patch.source, patch.hint, patch.size) = (source, hint, size);
        Some(Sweep { coarse, patch })
    }

    /// How far it is from one loop to the other, along the surface.
    fn mean_length(&self) -> f64 {
        let place = |k: usize| k as f64 / PLACES as f64;
        let apart = |k: usize| (self.ruled(place(k), 1.0) - self.ruled(place(k), 0.0)).norm();
        let straight = (0..PLACES).map(apart).sum::<f64>() / PLACES as f64;
        self.spine.length.max(straight)
    }

    /// The second loop by places of the first.
    fn last_ring(&self) -> Ring {
        let ring = &self.ends[1].ring;
        let place = |around: f64| around - self.shift - (around - self.shift).floor();
        let mut order: Vec<(f64, u32)> = (ring.around.iter().map(|&around| place(around)))
            .zip(ring.vertices.iter().copied())
            .collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ring {
            vertices: order.iter().map(|of| of.1).collect(),
            around: order.iter().map(|of| of.0).collect(),
        }
    }

    /// Without rows; and where around its triangles begin.
    fn direct(&self, last: &Ring) -> (Patch, Vec<(f64, u32)>) {
        let first = &self.ends[0].ring;
        let triangles = strip(first, last);
        let mut near: Vec<(f64, u32)> = Vec::new();
        for (t, of) in (0..).zip(&triangles) {
            near.push((first.around[of[0] as usize], t));
        }
        near.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let count = self.set.x.len();
        (Patch::new(self.set.x.clone(), triangles, count), near)
    }
}

/// Triangles between a ring and the next one: from pair to pair of vertices the shorter way around.
fn strip(below: &Ring, above: &Ring) -> Vec<[u32; 3]> {
    let (n, m) = (below.vertices.len(), above.vertices.len());
    let unrolled =
        |ring: &Ring, i: usize| ring.around[i % ring.around.len()] + (i / ring.around.len()) as f64;
    let from = |j: usize| {
        let apart = above.around[j] - below.around[0];
        (apart - apart.round()).abs()
    };
    let nearest = (0..m).min_by(|&a, &b| from(a).total_cmp(&from(b))).unwrap_or(0);
    // So that the first pair is on the same turn.
    let turn = (above.around[nearest] - below.around[0]).round();
    let up = |j: usize| unrolled(above, nearest + j) - turn;
    let (mut i, mut j) = (0, 0);
    let mut triangles = Vec::with_capacity(n + m);
    while i < n || j < m {
        let [a, b] = [i, i + 1].map(|i| below.vertices[i % n]);
        let [c, d] = [j, j + 1].map(|j| above.vertices[(nearest + j) % m]);
        let along_below = (unrolled(below, i + 1) - up(j)).abs();
        let along_above = (up(j + 1) - unrolled(below, i)).abs();
        if j == m || i < n && along_below <= along_above {
            triangles.push([a, b, c]);
            i += 1;
        } else {
            triangles.push([a, d, c]);
            j += 1;
        }
    }
    triangles
}
