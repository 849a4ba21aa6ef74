//! Irregular connectivity for shapes that have no chart: vertices inserted, edges flipped, vertices shaken.

use super::arithmetic::{cross, unit};
use super::blend_start::Neighbours;
use super::rng::Rng;
use super::sampling::Sampling;
use super::shape::Shape;
use std::collections::HashMap;

/// Share of the vertices that are inserted at random.
const INSERTED: f64 = 0.15;

/// A shape of about `n` vertices: `make` makes regular ones, `refine` refines a part.
pub(super) fn sampled(
    n: usize,
    sampling: Sampling,
    refine: impl Fn(&mut Shape),
    make: impl Fn(usize) -> Shape,
) -> Shape {
    match sampling {
        Sampling::Regular => make(n),
        Sampling::Irregular { seed } => {
            let mut shape = make((n as f64 / (1.0 + INSERTED)).round() as usize);
            scramble(&mut shape, seed);
            shape
        }
        Sampling::LocallyRefined { .. } => {
            let mut shape = make(n);
            refine(&mut shape);
            shape
        }
    }
}

/// Passes over all edges, and the probability of a flip where it is possible.
const PASSES: usize = 2;
const FLIPPED: f64 = 0.35;
/// The smallest and largest valence and the smallest angle, in degrees, that a flip or a shift may leave.
const VALENCES: (usize, usize) = (4, 10);
const ANGLE: f64 = 14.0;
/// Vertices are displaced by up to this many times the distance of their nearest neighbour.
const SHAKE: f64 = 0.35;

/// Makes the triangulation irregular: valences from 3 to about 10, angles down to about 14 degrees. Edges
/// between two fixed vertices stay. The same seed gives the same bits.
fn scramble(shape: &mut Shape, seed: u64) {
    let mut rng = Rng::new(seed);
    insert(shape, &mut rng);
    let mut net = Net::new(shape);
    for _ in 0..PASSES {
        for e in rng.permutation(3 * net.triangles.len()) {
            if rng.unit() < FLIPPED {
                net.flip(&shape.positions, &shape.free, e as usize);
            }
        }
    }
    shape.triangles = net.triangles;
    shake(shape, &mut rng);
    shape.flattened = shape.positions.clone();
}

/// New vertices in the middle of triangles that have a free vertex: valence 3 until an edge is flipped.
fn insert(shape: &mut Shape, rng: &mut Rng) {
    let count = (INSERTED * shape.free_count() as f64).round() as usize;
    let candidates: Vec<u32> = rng.permutation(shape.triangles.len());
    let free = |t: &u32| {
        shape.triangles[*t as usize]
            .iter()
            .any(|&v| shape.free[v as usize])
    };
    let chosen: Vec<u32> = candidates.into_iter().filter(free).take(count).collect();
    for t in chosen {
        let [a, b, c] = shape.triangles[t as usize];
        let p = [a, b, c].map(|v| shape.positions[v as usize]);
        let m = shape.positions.len() as u32;
        shape
            .positions
            .push(std::array::from_fn(|i| (p[0][i] + p[1][i] + p[2][i]) / 3.0));
        shape.normals.push([0.0; 3]);
        shape.free.push(true);
        shape.triangles[t as usize] = [a, b, m];
        shape.triangles.extend([[b, c, m], [c, a, m]]);
    }
}

/// Triangles, the half-edge of every directed edge, and valences.
struct Net {
    triangles: Vec<[u32; 3]>,
    half_edge: HashMap<(u32, u32), usize>,
    valence: Vec<usize>,
}

impl Net {
    fn new(shape: &Shape) -> Net {
        let mut net = Net {
            triangles: shape.triangles.clone(),
            half_edge: HashMap::new(),
            valence: vec![0; shape.positions.len()],
        };
        for t in 0..net.triangles.len() {
            net.enter(t);
            net.triangles[t]
                .iter()
                .for_each(|&v| net.valence[v as usize] += 1);
        }
        net
    }

    fn enter(&mut self, t: usize) {
        let c = self.triangles[t];
        (0..3).for_each(|k| {
            self.half_edge.insert((c[k], c[(k + 1) % 3]), 3 * t + k);
        });
    }

    /// Replaces the edge of half-edge `h` by the other diagonal, where the result is acceptable.
    fn flip(&mut self, positions: &[[f64; 3]], free: &[bool], h: usize) {
        let (t, k) = (h / 3, h % 3);
        let (a, b, c) = (
            self.triangles[t][k],
            self.triangles[t][(k + 1) % 3],
            self.triangles[t][(k + 2) % 3],
        );
        let Some(&o) = self.half_edge.get(&(b, a)) else {
            return;
        };
        let d = self.triangles[o / 3][(o % 3 + 2) % 3];
        let [va, vb, vc, vd] = [a, b, c, d].map(|v| self.valence[v as usize]);
        let fixed_edge = |v: u32, w: u32| !free[v as usize] && !free[w as usize];
        if fixed_edge(a, b)
            || fixed_edge(c, d)
            || va <= VALENCES.0
            || vb <= VALENCES.0
            || vc >= VALENCES.1
            || vd >= VALENCES.1
            || self.half_edge.contains_key(&(c, d))
            || self.half_edge.contains_key(&(d, c))
        {
            return;
        }
        let at = |t: [u32; 3]| t.map(|v| positions[v as usize]);
        let before = [normal(at([a, b, c])), normal(at([b, a, d]))];
        let (left, right) = ([c, d, b], [d, c, a]);
        let sound = |t: [u32; 3]| {
            let n = normal(at(t));
            smallest_angle(at(t)) > ANGLE && before.iter().all(|m| dot(n, *m) > 0.7)
        };
        if !sound(left) || !sound(right) {
            return;
        }
        self.half_edge.remove(&(a, b));
        self.half_edge.remove(&(b, a));
        (self.triangles[t], self.triangles[o / 3]) = (left, right);
        self.enter(t);
        self.enter(o / 3);
        self.valence[a as usize] -= 1;
        self.valence[b as usize] -= 1;
        self.valence[c as usize] += 1;
        self.valence[d as usize] += 1;
    }
}

/// Displaces every free vertex tangentially, where its triangles stay sound.
fn shake(shape: &mut Shape, rng: &mut Rng) {
    let near = Neighbours::new(&shape.triangles, shape.positions.len());
    let mut around: Vec<Vec<u32>> = vec![Vec::new(); shape.positions.len()];
    for (t, corners) in shape.triangles.iter().enumerate() {
        corners.iter().for_each(|&v| around[v as usize].push(t as u32));
    }
    for (v, around) in around.iter().enumerate() {
        if !shape.free[v] {
            continue;
        }
        let p = shape.positions[v];
        let distance = |w: &u32| length(sub(shape.positions[*w as usize], p));
        let reach = SHAKE * near.of(v).iter().map(distance).fold(f64::INFINITY, f64::min);
        let at = |t: u32| shape.triangles[t as usize].map(|w| shape.positions[w as usize]);
        let normals: Vec<[f64; 3]> = around.iter().map(|&t| normal(at(t))).collect();
        let n = unit(std::array::from_fn(|i| normals.iter().map(|n| n[i]).sum()));
        let by: [f64; 3] = std::array::from_fn(|_| rng.between(-reach, reach));
        let along = dot(by, n);
        shape.positions[v] = std::array::from_fn(|i| p[i] + by[i] - along * n[i]);
        let sound = around.iter().zip(&normals).all(|(&t, before)| {
            let corners = shape.triangles[t as usize].map(|w| shape.positions[w as usize]);
            smallest_angle(corners) > ANGLE && dot(normal(corners), *before) > 0.8
        });
        if !sound {
            shape.positions[v] = p;
        }
    }
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] - b[i])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    unit(cross(sub(b, a), sub(c, a)))
}

/// In degrees.
fn smallest_angle(p: [[f64; 3]; 3]) -> f64 {
    let corner = |k: usize| {
        let (u, v) = (sub(p[(k + 1) % 3], p[k]), sub(p[(k + 2) % 3], p[k]));
        (dot(u, v) / (length(u) * length(v)).max(f64::MIN_POSITIVE))
            .clamp(-1.0, 1.0)
            .acos()
    };
    corner(0).min(corner(1)).min(corner(2)).to_degrees()
}
