//! The blend of three cylinders (paper Figs. 1 and 8): connectivity.
//!
//! Three half-open tubes point away from the origin at 0, 120 and 240 degrees in the plane z = 0. Between
//! them lie two sheets, above and below the plane, glued along three seams. A sheet is a hexagon of the
//! triangular lattice: a triangle with its corners cut off, points (c0, c1, c2) of sum `arc + 2 seam` with
//! `0 <= c_t <= arc + seam`. The side c_t = 0 is half the girth of tube t, the side c_t = arc + seam is the
//! seam opposite to it. Rings of staggered vertices lead from the sheets to the fixed circles.

use super::arithmetic::unit;
use super::blend_start::{BLEND_DISTANCE, BLEND_RADIUS, project, relax, trisect, tube_frame};
use super::irregular::sampled;
use super::sampling::Sampling;
use super::shape::Shape;
use super::size::blend_size;
use std::collections::HashMap;

/// The paper's cylinder blend: 920 vertices, 1,746 triangles, three fixed circles of 32 vertices that are
/// the boundary of the mesh, with the normals of the tubes.
///
/// Symmetric under rotation by 120 degrees and under reflection at z = 0 and at the three planes through
/// an axis and the z axis. The positions are a smooth start, not the solution.
pub fn cylinder_blend() -> Shape {
    let mut net = Net::new(16, 6, 2);
    net.insert_pole(false);
    net.insert_pole(true);
    net.widen_seams();
    net.finish()
}

/// As [`cylinder_blend`], with 118 vertices and circles of 12; not symmetric under z -> -z.
pub fn cylinder_blend_coarse() -> Shape {
    let mut net = Net::new(6, 1, 1);
    net.insert_pole(false);
    net.split_seams();
    net.finish()
}

/// As [`cylinder_blend`], with 13,308 vertices.
pub fn cylinder_blend_fine() -> Shape {
    cylinder_blend_with(52, 33, 8)
}

/// As [`cylinder_blend`], every triangle of the upper sheet in a rectangle beside the centre divided into
/// nine, its neighbours so that the mesh conforms: not symmetric.
pub fn cylinder_blend_refined_patch() -> Shape {
    let mut shape = cylinder_blend();
    refine_patch(&mut shape);
    shape
}

fn refine_patch(shape: &mut Shape) {
    let inside = |p: [f64; 3]| p[2] > 0.0 && (0.0..0.65).contains(&p[0]) && (-0.3..0.35).contains(&p[1]);
    trisect(shape, project, inside);
}

/// The cylinder blend with `arc` edges on half a circle, `seam` edges on a seam and `rings` rings of
/// vertices on every tube beyond the sheets (`arc` 3 to 1,000, `seam` 1 to 1,000, `rings` up to 1,000).
/// It has `arc^2 + 4 arc seam + seam^2 + 6 arc rings + 3 arc - 1` vertices and all the symmetries.
pub fn cylinder_blend_with(arc: usize, seam: usize, rings: usize) -> Shape {
    Net::new(arc.clamp(3, 1_000), seam.clamp(1, 1_000), rings.min(1_000)).finish()
}

/// A cylinder blend of about `n` vertices (50 to 5 million): 118, 920 and 13,308 are the three above.
/// [`Sampling::Irregular`] inserts vertices, flips edges and shakes; [`Sampling::LocallyRefined`] is the patch of
/// [`cylinder_blend_refined_patch`], whatever its fields.
pub fn cylinder_blend_of(n: usize, sampling: Sampling) -> Shape {
    sampled(n, sampling, refine_patch, |n| match n {
        118 => cylinder_blend_coarse(),
        920 => cylinder_blend(),
        13_308 => cylinder_blend_fine(),
        n => {
            let [arc, seam, rings] = blend_size(n);
            cylinder_blend_with(arc, seam, rings)
        }
    })
}

type Triple = [usize; 3];

/// The connectivity under construction.
pub(super) struct Net {
    arc: usize,
    seam: usize,
    /// Vertices of the two sheets by lower sheet or not, c0 and c1.
    sheets: HashMap<(bool, usize, usize), u32>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// The fixed circle of every tube, from the +E side upward.
    pub(super) circles: [Vec<u32>; 3],
    /// Are the circles' vertices half a step further?
    pub(super) staggered: bool,
    pub(super) vertices: u32,
}

impl Net {
    pub(super) fn new(arc: usize, seam: usize, rings: usize) -> Net {
        let mut net = Net {
            arc,
            seam,
            sheets: HashMap::new(),
            triangles: Vec::new(),
            circles: Default::default(),
            staggered: rings % 2 == 1,
            vertices: 0,
        };
        net.lay_sheets();
        for t in 0..3 {
            net.lay_tube(t, rings);
        }
        net
    }

    fn add(&mut self) -> u32 {
        self.vertices += 1;
        self.vertices - 1
    }

    fn size(&self) -> usize {
        self.arc + 2 * self.seam
    }

    fn contains(&self, c: Triple) -> bool {
        c.iter().sum::<usize>() == self.size() && c.iter().all(|&x| x <= self.arc + self.seam)
    }

    fn at(&self, lower: bool, c: Triple) -> u32 {
        self.sheets.get(&(lower, c[0], c[1])).copied().unwrap_or(0)
    }

    /// Adds a triangle that is counter-clockwise seen from above.
    fn push(&mut self, lower: bool, t: [u32; 3]) {
        self.triangles.push(oriented(lower, t));
    }

    fn remove(&mut self, lower: bool, t: [u32; 3]) {
        let sorted = |mut t: [u32; 3]| {
            t.sort_unstable();
            t
        };
        let gone = sorted(oriented(lower, t));
        self.triangles.retain(|&u| sorted(u) != gone);
    }

    fn lay_sheets(&mut self) {
        let n = self.size();
        for lower in [false, true] {
            for (c0, c1) in (0..=n).flat_map(|i| (0..=n - i).map(move |j| (i, j))) {
                let c = [c0, c1, n - c0 - c1];
                if self.contains(c) {
                    let on_seam = c.contains(&(self.arc + self.seam));
                    let v = if lower && on_seam {
                        self.at(false, c)
                    } else {
                        self.add()
                    };
                    self.sheets.insert((lower, c0, c1), v);
                }
            }
            for (i, j) in (0..n).flat_map(|i| (0..n - i).map(move |j| (i, j))) {
                let k = n - 1 - i - j;
                self.lay(lower, [[i + 1, j, k], [i, j + 1, k], [i, j, k + 1]]);
                if k > 0 {
                    self.lay(lower, [[i, j + 1, k], [i + 1, j + 1, k - 1], [i + 1, j, k]]);
                }
            }
        }
    }

    fn lay(&mut self, lower: bool, corners: [Triple; 3]) {
        if corners.iter().all(|&c| self.contains(c)) {
            self.push_ccw(lower, corners);
        }
    }

    fn push_ccw(&mut self, lower: bool, corners: [Triple; 3]) {
        // Corner t of the lattice lies opposite to tube t, so (c0, c1, c2) = corners 0, 1, 2 run
        // counter-clockwise; the area's sign settles the order for every triangle alike.
        let [a, b, c] = corners.map(|c| c.map(|x| x as i64));
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let [a, b, c] = corners.map(|c| self.at(lower, c));
        self.push(lower, if area > 0 { [a, b, c] } else { [a, c, b] });
    }

    fn lay_tube(&mut self, t: usize, rings: usize) {
        let (arc, seam, n) = (self.arc, self.seam, 2 * self.arc);
        let on_side = |q: usize| from_corner(t, [0, seam + q, arc + seam - q]);
        let mut ring: Vec<u32> = (0..arc).map(|q| self.at(false, on_side(q))).collect();
        ring.extend((0..arc).map(|q| self.at(true, on_side(arc - q))));
        for k in 0..rings {
            let next: Vec<u32> = (0..n).map(|_| self.add()).collect();
            for q in 0..n {
                let r = (q + 1) % n;
                self.triangles.extend(if k % 2 == 0 {
                    [[ring[q], ring[r], next[q]], [ring[r], next[r], next[q]]]
                } else {
                    [[ring[q], ring[r], next[r]], [ring[q], next[r], next[q]]]
                });
            }
            ring = next;
        }
        self.circles[t] = ring;
    }

    /// A vertex of valence 6 in the middle of a sheet, where the lattice has a triangle there: the triangle
    /// and its three neighbours become a fan of six.
    pub(super) fn insert_pole(&mut self, lower: bool) {
        let (n, third) = (self.size(), self.size() / 3);
        let shifted = |t: usize, by: [usize; 3]| from_corner(t, by.map(|x| third + x));
        // Corners of the middle triangle, and the vertex across the side that corner t does not touch.
        let (near, far): (Vec<Triple>, Vec<Option<Triple>>) = match n % 3 {
            1 => (0..3)
                .map(|t| (shifted(t, [1, 0, 0]), opposite(shifted(t, [0, 1, 1]), t)))
                .unzip(),
            2 => (0..3)
                .map(|t| (shifted(t, [0, 1, 1]), Some(shifted(t, [2, 0, 0]))))
                .unzip(),
            _ => return,
        };
        let Some(far) = far.into_iter().collect::<Option<Vec<Triple>>>() else {
            return;
        };
        if !far.iter().all(|&c| self.contains(c)) {
            return;
        }
        let near: Vec<u32> = near.into_iter().map(|c| self.at(lower, c)).collect();
        let far: Vec<u32> = far.into_iter().map(|c| self.at(lower, c)).collect();
        self.remove(lower, [near[0], near[1], near[2]]);
        let pole = self.add();
        for t in 0..3 {
            let (b, c) = (near[(t + 1) % 3], near[(t + 2) % 3]);
            self.remove(lower, [b, c, far[t]]);
            self.push(lower, [pole, b, far[t]]);
            self.push(lower, [pole, far[t], c]);
        }
    }

    /// Doubles the middle vertex of every seam (of even length) along the seam; in both sheets the vertex
    /// two rows off is joined to the two.
    fn widen_seams(&mut self) {
        let (top, half) = (self.arc + self.seam, self.seam / 2);
        for t in 0..3 {
            let place = |x: usize, y: usize, z: usize| from_corner(t, [x, y, z]);
            let middle = self.at(false, place(top, half, half));
            let beyond = self.at(false, place(top, half - 1, half + 1));
            let second = self.add();
            for lower in [false, true] {
                let left = self.at(lower, place(top - 1, half + 1, half));
                let right = self.at(lower, place(top - 1, half, half + 1));
                let deep = self.at(lower, place(top - 2, half + 1, half + 1));
                self.remove(lower, [middle, left, right]);
                self.remove(lower, [left, deep, right]);
                self.remove(lower, [middle, right, beyond]);
                self.push(lower, [middle, left, deep]);
                self.push(lower, [middle, deep, second]);
                self.push(lower, [second, deep, right]);
                self.push(lower, [second, right, beyond]);
            }
        }
    }

    /// Splits the only edge of every seam of length one.
    fn split_seams(&mut self) {
        let top = self.arc + self.seam;
        for t in 0..3 {
            let place = |x: usize, y: usize, z: usize| from_corner(t, [x, y, z]);
            let (left, right) = (self.at(false, place(top, 1, 0)), self.at(false, place(top, 0, 1)));
            let middle = self.add();
            for lower in [false, true] {
                let deep = self.at(lower, place(top - 1, 1, 1));
                self.remove(lower, [left, deep, right]);
                self.push(lower, [left, deep, middle]);
                self.push(lower, [middle, deep, right]);
            }
        }
    }

    /// Circles placed, the rest relaxed between them.
    fn finish(self) -> Shape {
        let n = self.vertices as usize;
        let mut shape = Shape {
            positions: vec![[0.0; 3]; n],
            triangles: self.triangles,
            free: vec![true; n],
            normals: vec![[0.0; 3]; n],
            surface: None,
            flattened: Vec::new(),
        };
        let offset = if self.staggered { 0.5 } else { 0.0 };
        for (t, circle) in self.circles.iter().enumerate() {
            let (axis, side) = tube_frame(t);
            for (q, &v) in circle.iter().enumerate() {
                let (sin, cos) = (std::f64::consts::PI * (q as f64 + offset) / self.arc as f64).sin_cos();
                let normal = unit([side[0] * cos, side[1] * cos, sin]);
                let v = v as usize;
                shape.positions[v] =
                    std::array::from_fn(|i| BLEND_DISTANCE * axis[i] + BLEND_RADIUS * normal[i]);
                shape.normals[v] = normal;
                shape.free[v] = false;
            }
        }
        relax(&mut shape);
        shape
    }
}

/// The lattice point with these coordinates from number t on.
fn from_corner(t: usize, [x, y, z]: Triple) -> Triple {
    let mut c = [0; 3];
    (c[t], c[(t + 1) % 3], c[(t + 2) % 3]) = (x, y, z);
    c
}

/// The lattice point across the side `(c with 1 at t+1), (c with 1 at t+2)` from the corner t.
fn opposite(c: Triple, t: usize) -> Option<Triple> {
    let mut c = c;
    c[t] = c[t].checked_sub(1)?;
    Some(c)
}

fn oriented(lower: bool, t: [u32; 3]) -> [u32; 3] {
    if lower { [t[0], t[2], t[1]] } else { t }
}
