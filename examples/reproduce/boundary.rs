//! What shows along the boundary of a region, measured alike for the surfaces of all programs: the jump of mean curvature, and how far the
//! surface deviates from the normals of its surroundings.

use std::io;

use fairmesh::{Options, Selection, fair, mean_curvature};
use nalgebra::{Matrix3, Vector3};

use crate::tool::Case;

/// Values are extrapolated from vertices so many edges away. The nearest have neighbours on both sides.
const REACH: std::ops::RangeInclusive<usize> = 2..=4;
/// From so many of them at least.
const FEWEST: usize = 6;

/// The boundary of a region.
pub struct Boundary {
    neighbours: Vec<Vec<u32>>,
    is_free: Vec<bool>,
    /// Where it is, by vertex.
    is_boundary: Vec<bool>,
    /// Its vertices with the normals that `fairmesh` fits to the surroundings.
    normals: Vec<(u32, [f64; 3])>,
}

/// Of a surface along it.
#[derive(Debug, Clone, Copy)]
pub struct Shown {
    /// Jump of mean curvature, over the root mean square of the surroundings' own: root mean square and largest.
    pub jump: [f64; 2],
    /// The largest angle between the surface and the normals there, in degrees.
    pub deviation: f64,
}

impl Boundary {
    /// That of the free vertices of a mesh.
    pub fn new(case: &Case) -> io::Result<Self> {
        let solution = fair(
            &case.positions,
            &case.triangles,
            Selection::Vertices(&case.free),
            &Options::default(),
        );
        let mut neighbours = vec![Vec::new(); case.positions.len()];
        for t in &case.triangles {
            for k in 0..3 {
                neighbours[t[k] as usize].extend([t[(k + 1) % 3], t[(k + 2) % 3]]);
            }
        }
        for list in &mut neighbours {
            list.sort_unstable();
            list.dedup();
        }
        let mut is_free = vec![false; case.positions.len()];
        case.free.iter().for_each(|&v| is_free[v as usize] = true);
        let normals = solution.map_err(io::Error::other)?.boundary_normals;
        let mut is_boundary = vec![false; case.positions.len()];
        normals.iter().for_each(|(v, _)| is_boundary[*v as usize] = true);
        Ok(Self {
            neighbours,
            is_free,
            is_boundary,
            normals,
        })
    }

    /// What a surface of the region shows.
    pub fn shown(&self, case: &Case, positions: &[[f64; 3]]) -> io::Result<Shown> {
        let h = mean_curvature(positions, &case.triangles).map_err(io::Error::other)?;
        let (mut jumps, mut outside) = (Vec::new(), Vec::new());
        for (v, normal) in &self.normals {
            let values = [true, false].map(|free| self.extrapolated(*v, normal, free, positions, &h));
            if let [Some(inside), Some(around)] = values {
                jumps.push(inside - around);
                outside.push(around);
            }
        }
        let rms = |of: &[f64]| (of.iter().map(|x| x * x).sum::<f64>() / of.len().max(1) as f64).sqrt();
        let scale = rms(&outside);
        let largest = jumps.iter().fold(0.0f64, |m, j| m.max(j.abs()));
        Ok(Shown {
            jump: [rms(&jumps), largest].map(|j| j / scale),
            deviation: self.deviation(case, positions),
        })
    }

    /// The value at a vertex of the linear function that fits those on one side of the boundary best.
    fn extrapolated(
        &self,
        v: u32,
        normal: &[f64; 3],
        of_free: bool,
        positions: &[[f64; 3]],
        h: &[f64],
    ) -> Option<f64> {
        let normal = Vector3::from(*normal);
        let across = normal.cross(&if normal.x.abs() < 0.6 {
            Vector3::x()
        } else {
            Vector3::y()
        });
        let across = across.normalize();
        let other = normal.cross(&across);
        let centre = Vector3::from(positions[v as usize]);
        let (mut matrix, mut right, mut count) = (Matrix3::zeros(), Vector3::zeros(), 0);
        for w in self.around(v, of_free) {
            let value = h[w as usize];
            if !value.is_finite() {
                continue;
            }
            let edge = Vector3::from(positions[w as usize]) - centre;
            let row = Vector3::new(1.0, edge.dot(&across), edge.dot(&other));
            matrix += row * row.transpose();
            right += row * value;
            count += 1;
        }
        let solved = (count >= FEWEST).then(|| matrix.lu().solve(&right)).flatten();
        solved.map(|s| s.x)
    }

    /// The vertices within [`REACH`] of a boundary vertex, along edges on one side of it.
    fn around(&self, v: u32, of_free: bool) -> Vec<u32> {
        let is_there = |w: u32| self.is_free[w as usize] == of_free && !self.is_boundary[w as usize];
        let (mut found, mut front, mut reached) = (Vec::new(), vec![v], vec![v]);
        for edges in 1..=*REACH.end() {
            let mut next: Vec<u32> = front
                .iter()
                .flat_map(|w| self.neighbours[*w as usize].iter().copied())
                .filter(|w| is_there(*w) && !reached.contains(w))
                .collect();
            next.sort_unstable();
            next.dedup();
            reached.extend(&next);
            if REACH.contains(&edges) {
                found.extend(&next);
            }
            front = next;
        }
        found
    }

    /// The largest angle between the mean normal of the region's triangles at a boundary vertex and that of its surroundings.
    fn deviation(&self, case: &Case, positions: &[[f64; 3]]) -> f64 {
        let mut sums = vec![Vector3::zeros(); positions.len()];
        for t in &case.triangles {
            if t.iter().any(|&v| self.is_free[v as usize]) {
                let p = t.map(|v| Vector3::from(positions[v as usize]));
                let cross: Vector3<f64> = (p[1] - p[0]).cross(&(p[2] - p[0]));
                t.iter().for_each(|&v| sums[v as usize] += cross);
            }
        }
        let angle = |(v, normal): &(u32, [f64; 3])| {
            let (a, b) = (sums[*v as usize], Vector3::from(*normal));
            a.cross(&b).norm().atan2(a.dot(&b)).to_degrees()
        };
        self.normals.iter().map(angle).fold(0.0, f64::max)
    }
}
