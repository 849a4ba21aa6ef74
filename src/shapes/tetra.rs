//! The "tetra thing" (paper Fig. 8): six circles about the edges of a tetrahedron, and the tubes through them.
//!
//! The circles lie in the planes that halve the edges, centred on them, with the normals of tubes along the
//! edges. At every corner of the tetrahedron three tubes meet, as in the blend of three cylinders, and the
//! connectivity there is the same: four such nets, glued along the circles. The surface is closed, of genus 3
//! (Euler characteristic -4), and the circles are closed curves of fixed vertices inside it.

use super::arithmetic::{cross, unit};
use super::blend::Net;
use super::blend_start::trisect;
use super::irregular::sampled;
use super::plate::thin_plate;
use super::sampling::Sampling;
use super::shape::Shape;
use super::size::tetra_size;

/// Radius of the six circles of the tetra thing. The tetrahedron's edges have length 2.
pub const TETRA_RADIUS: f64 = 0.35;

/// The paper's larger tetra thing: 13,308 vertices, 26,624 triangles, circles of 58.
///
/// Symmetric under all rotations and reflections of the tetrahedron; its corners lie at `(1, 1, 1)`,
/// `(1, -1, -1)`, `(-1, 1, -1)`, `(-1, -1, 1)` over the root of 2, its circles about the six half axes at the
/// same distance from the origin. The positions are a smooth start, not the solution.
pub fn tetra_thing() -> Shape {
    tetra_thing_with(29, 15, 3)
}

/// The paper's smaller tetra thing: 500 vertices, 1,008 triangles, circles of 10.
pub fn tetra_thing_coarse() -> Shape {
    glue(5, 3, 1, true)
}

/// A tetra thing of about `n` vertices (50 to 5 million), 500 and 13,308 exactly. [`Sampling::Irregular`] inserts
/// vertices, flips edges and shakes; [`Sampling::LocallyRefined`] divides the triangles on one side of a corner
/// into nine each, whatever its fields.
pub fn tetra_thing_of(n: usize, sampling: Sampling) -> Shape {
    sampled(n, sampling, refine_corner, |n| match n {
        500 => tetra_thing_coarse(),
        n => {
            let [arc, seam, rings] = tetra_size(n);
            tetra_thing_with(arc, seam, rings)
        }
    })
}

/// The tetra thing with `arc` edges on half a circle, `seam` edges on each of the curves that three tubes
/// meet in, and `rings` rings of vertices between those and a circle; for the ranges see
/// [`cylinder_blend_with`](super::cylinder_blend_with).
/// It has `4 (arc^2 + 4 arc seam + seam^2 + 6 arc rings - 1)` vertices.
pub fn tetra_thing_with(arc: usize, seam: usize, rings: usize) -> Shape {
    glue(arc.clamp(3, 1_000), seam.clamp(1, 1_000), rings.min(1_000), false)
}

/// Corners of the tetrahedron.
fn corners() -> [[f64; 3]; 4] {
    const S: f64 = std::f64::consts::FRAC_1_SQRT_2;
    [[S, S, S], [S, -S, -S], [-S, S, -S], [-S, -S, S]]
}

/// The other corners, counter-clockwise seen from outside at this one.
const OTHERS: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// The edges with their two ends, and the number of the edge between two corners.
const EDGES: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

fn edge_between(a: usize, b: usize) -> usize {
    let ends = [a.min(b), a.max(b)];
    EDGES.iter().position(|e| *e == ends).unwrap_or(0)
}

/// Refines one side of the first corner, away from the circles.
fn refine_corner(shape: &mut Shape) {
    let inside = |p: [f64; 3]| p[0] + p[1] + p[2] > 1.35 && p[0] > p[1];
    trisect(shape, |p| p, inside);
}

/// Four nets, one per corner, with common circles.
fn glue(arc: usize, seam: usize, rings: usize, poles: bool) -> Shape {
    let mut net = Net::new(arc, seam, rings);
    if poles {
        net.insert_pole(false);
        net.insert_pole(true);
    }
    let round = 2 * arc;
    let mut shape = Shape::empty();
    for _ in 0..6 * round {
        add(&mut shape, false);
    }
    for (corner, others) in OTHERS.iter().enumerate() {
        let mut global = vec![u32::MAX; net.vertices as usize];
        for (circle, &other) in net.circles.iter().zip(others) {
            let edge = edge_between(corner, other);
            for (q, &v) in circle.iter().enumerate() {
                // Seen from the other end the circle runs the other way.
                let turned = arc + round - usize::from(net.staggered) - q;
                let q = if corner < other { q } else { turned % round };
                global[v as usize] = (edge * round + q) as u32;
            }
        }
        for v in &mut global {
            if *v == u32::MAX {
                *v = add(&mut shape, true);
            }
        }
        let glued = net.triangles.iter().map(|t| t.map(|v| global[v as usize]));
        shape.triangles.extend(glued);
    }
    place_circles(&mut shape, arc, net.staggered);
    thin_plate(&mut shape);
    shape
}

fn add(shape: &mut Shape, free: bool) -> u32 {
    shape.positions.push([0.0; 3]);
    shape.normals.push([0.0; 3]);
    shape.free.push(free);
    shape.positions.len() as u32 - 1
}

/// Vertex q of a circle as the first end of its edge sees it: from the side counter-clockwise of the tube, upward.
fn place_circles(shape: &mut Shape, arc: usize, staggered: bool) {
    let corners = corners();
    let offset = if staggered { 0.5 } else { 0.0 };
    for (edge, [a, b]) in EDGES.into_iter().enumerate() {
        let centre: [f64; 3] = std::array::from_fn(|i| 0.5 * (corners[a][i] + corners[b][i]));
        let axis = unit(std::array::from_fn(|i| corners[b][i] - corners[a][i]));
        let up = unit(centre);
        let side = cross(up, axis);
        for q in 0..2 * arc {
            let (sin, cos) = (std::f64::consts::PI * (q as f64 + offset) / arc as f64).sin_cos();
            let normal = unit(std::array::from_fn(|i| cos * side[i] + sin * up[i]));
            let v = 2 * arc * edge + q;
            shape.positions[v] = std::array::from_fn(|i| centre[i] + TETRA_RADIUS * normal[i]);
            shape.normals[v] = normal;
        }
    }
}
