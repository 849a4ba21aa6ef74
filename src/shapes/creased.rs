//! Pieces of solids around a sharp edge, or around a corner where three meet.

use super::planar::disc_chart_along;
use super::sampling::Sampling;
use super::shape::{Lifted, Shape};

/// The solid whose edge it is. Of an edge the chart has the part beside it, `y < 0` on one side, `y > 0` on the other; lengths in the
/// chart are those on the surface, on one side at least.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Creased {
    /// Two planes, whose normals are so many degrees apart: above 0 a ridge, below 0 a groove.
    Wedge(f64),
    /// The rim of a cylinder of radius 1 with a flat cap.
    CappedCylinder,
    /// The rim of a cone's base, of radius 1; its side leans by so many degrees from the axis.
    Cone(f64),
    /// Where a cylinder of this radius (below 1) comes out of one of radius 1, at right angles: a curve in space.
    Tee(f64),
    /// Three planes of a cube, whose edges run from the origin of the chart.
    CubeCorner,
}

/// A piece free within `radius` of the point `centre` of the chart, where the creases are chains of edges. About `n` vertices are free.
pub fn creased(
    of: Creased,
    (centre, radius): ([f64; 2], f64),
    n: usize,
    sampling: Sampling,
    outside: usize,
) -> Shape {
    let chart = disc_chart_along(&of.rays(), (centre, radius), n, sampling, outside);
    Shape::lifted(chart, None, |p| {
        let [position, normal] = of.lift(p);
        Lifted {
            position,
            normal,
            flat: position,
        }
    })
}

impl Creased {
    /// The directions of the creases from the origin of the chart, degrees.
    fn rays(self) -> Vec<f64> {
        match self {
            Self::CubeCorner => vec![90.0, 210.0, 330.0],
            _ => vec![0.0, 180.0],
        }
    }

    /// The point of the surface and its outward normal; on a crease that of one side.
    fn lift(self, [x, y]: [f64; 2]) -> [[f64; 3]; 2] {
        let (sin, cos) = x.sin_cos();
        let below = y < 0.0;
        match self {
            Self::Wedge(_) if below => [[x, y, 0.0], [0.0, 0.0, 1.0]],
            Self::Wedge(degrees) => {
                let (s, c) = degrees.to_radians().sin_cos();
                [[x, y * c, -y * s], [0.0, s, c]]
            }
            Self::CappedCylinder if below => [[cos, sin, y], [cos, sin, 0.0]],
            Self::Cone(degrees) if below => {
                let (s, c) = degrees.to_radians().sin_cos();
                let r = 1.0 + y * s;
                [[r * cos, r * sin, y * c], [c * cos, c * sin, -s]]
            }
            Self::CappedCylinder | Self::Cone(_) => {
                let r = 1.0 - y;
                [[r * cos, r * sin, 0.0], [0.0, 0.0, 1.0]]
            }
            Self::Tee(radius) => tee(radius, [x / radius, y]),
            Self::CubeCorner => corner([x, y]),
        }
    }
}

/// The small cylinder runs along the first axis, the large one along the third. `u` is the angle around the small one.
fn tee(radius: f64, [u, v]: [f64; 2]) -> [[f64; 3]; 2] {
    let r = radius + v.max(0.0);
    let (sin, cos) = u.sin_cos();
    let [y, z] = [r * sin, r * cos];
    let x = (1.0 - y * y).max(0.0).sqrt();
    match v < 0.0 {
        // The angle runs clockwise seen from outside.
        true => [[x - v, y, z], [0.0, sin, cos]],
        false => [[x, y, z], [x, y, 0.0]],
    }
}

/// The faces `x = 0`, `y = 0` and `z = 0` of the cube below them; in each two edges are the sides of the sector.
fn corner(p: [f64; 2]) -> [[f64; 3]; 2] {
    let edges: Vec<[f64; 2]> = [90.0f64, 210.0, 330.0]
        .map(|degrees| [degrees.to_radians().cos(), degrees.to_radians().sin()])
        .into();
    let area = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    for k in 0..3 {
        let (a, b) = (edges[k], edges[(k + 1) % 3]);
        let whole = area(a, b);
        let (s, t) = (area(p, b) / whole, area(a, p) / whole);
        if s >= -1e-12 && t >= -1e-12 {
            let mut position = [0.0; 3];
            (position[k], position[(k + 1) % 3]) = (-s.max(0.0), -t.max(0.0));
            let mut normal = [0.0; 3];
            normal[(k + 2) % 3] = 1.0;
            return [position, normal];
        }
    }
    [[0.0; 3], [0.0, 0.0, 1.0]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::{cross, unit};

    #[test]
    fn normals_are_those_of_the_triangles() {
        let all = [
            Creased::Wedge(30.0),
            Creased::Wedge(-90.0),
            Creased::CappedCylinder,
            Creased::Cone(30.0),
            Creased::Tee(0.6),
            Creased::CubeCorner,
        ];
        for of in all {
            let shape = creased(of, ([0.1, 0.05], 0.4), 400, Sampling::Irregular { seed: 3 }, 3);
            for t in &shape.triangles {
                let [a, b, c] = t.map(|v| shape.positions[v as usize]);
                let edge = |p: [f64; 3]| std::array::from_fn(|i| p[i] - a[i]);
                let normal = unit(cross(edge(b), edge(c)));
                let along = |v: u32| {
                    (0..3)
                        .map(|i| normal[i] * shape.normals[v as usize][i])
                        .sum::<f64>()
                };
                let best = t.map(along).into_iter().fold(f64::NEG_INFINITY, f64::max);
                assert!(best > 0.95, "{of:?}: {best}");
            }
        }
    }
}
