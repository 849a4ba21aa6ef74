//! Triangles between creases that go on and the boundary: some of their vertices are placed, none is free any more, so that they are in no
//! component's region.

use nalgebra::Vector3;

use super::parting::PartedProblem;
use crate::fairing::component_solution::ComponentSolution;
use crate::quality::crease::is_creased;
use crate::quality::{NEEDLE, smallest_angle};

impl PartedProblem {
    /// Takes these triangles into the figures of the components beside them, whose vertices have the numbers of the mesh; `given` is the mesh before.
    pub(crate) fn judge_between(&self, given: &[[f64; 3]], solutions: &mut [ComponentSolution]) {
        let mut is_placed = vec![false; given.len()];
        self.placed
            .iter()
            .for_each(|(v, _)| is_placed[*v as usize] = true);
        let is_between = |t: &[u32; 3]| {
            let is_moved = t.iter().any(|&v| is_placed[self.original(v) as usize]);
            is_moved && !t.iter().any(|&v| self.is_free[v as usize])
        };
        let all = (0..self.triangles.len()).filter(|&t| is_between(&self.triangles[t]));
        let all: Vec<usize> = all.collect();
        if all.is_empty() {
            return;
        }
        for &t in &all {
            let corners = self.triangles[t].map(|v| self.original(v));
            let is_beside =
                |of: &ComponentSolution| of.boundary_normals.iter().any(|(v, _)| corners.contains(v));
            let beside = solutions.iter().position(is_beside).unwrap_or(0);
            self.take(t, &mut solutions[beside]);
        }
        self.judge_kinks(&all, given, solutions);
    }

    /// Takes a triangle into the figures of a component.
    fn take(&self, t: usize, solution: &mut ComponentSolution) {
        let corners = self.triangles[t];
        let x = corners.map(|v| Vector3::from(self.positions[v as usize]));
        let cross = (x[1] - x[0]).cross(&(x[2] - x[0]));
        let normal = |v: u32| {
            let found = self.normals.binary_search_by_key(&v, |of| of.0);
            found.map_or(Vector3::zeros(), |k| self.normals[k].1.into())
        };
        let side = cross.dot(&corners.iter().map(|&v| normal(v)).sum::<Vector3<f64>>());
        let angle = smallest_angle(&x);
        let (is_folded, is_needle) = (side < 0.0 || side.is_nan(), angle < NEEDLE);
        let quality = &mut solution.report.quality;
        if angle < quality.worst_angle {
            (quality.worst_angle, quality.worst_triangle) = (angle, t);
        }
        for (is_so, list) in [
            (is_folded, &mut quality.flipped),
            (is_needle, &mut quality.needles),
        ] {
            if is_so {
                list.push(t as u32);
                list.sort_unstable();
            }
        }
        if is_folded || is_needle {
            solution.report.outcome.reserve_triangle(t as u32);
        }
        solution.triangles.push(t as u32);
        solution.triangles.sort_unstable();
    }

    /// Whether the surface has a crease where such triangles meet the outside.
    fn judge_kinks(&self, between: &[usize], given: &[[f64; 3]], solutions: &mut [ComponentSolution]) {
        let mut x = self.positions.clone();
        for (v, p) in solutions.iter().flat_map(|of| &of.moved) {
            x[*v as usize] = *p;
        }
        let mut is_inside = vec![false; self.triangles.len()];
        between.iter().for_each(|&t| is_inside[t] = true);
        let has_free = |t: &[u32; 3]| t.iter().any(|&v| self.is_free[v as usize]);
        let mut vertices: Vec<u32> = between.iter().flat_map(|&t| self.triangles[t]).collect();
        vertices.sort_unstable();
        vertices.dedup();
        // Sums of cross products at each of them: inside, as it is and was; outside.
        let mut sums = vec![[Vector3::zeros(); 3]; vertices.len()];
        for (t, corners) in self.triangles.iter().enumerate() {
            let found = corners.map(|v| vertices.binary_search(&v).ok());
            if found.iter().all(Option::is_none) {
                continue;
            }
            let cross = |at: &dyn Fn(u32) -> [f64; 3]| {
                let [a, b, c] = corners.map(|v| Vector3::from(at(v)));
                (b - a).cross(&(c - a))
            };
            let now = cross(&|v| x[v as usize]);
            let before = cross(&|v| given[self.original(v) as usize]);
            for k in found.into_iter().flatten() {
                if is_inside[t] || has_free(corners) {
                    sums[k][0] += now;
                    sums[k][1] += before;
                } else {
                    sums[k][2] += now;
                }
            }
        }
        for (&v, [now, before, outside]) in vertices.iter().zip(&sums) {
            let at = self.original(v);
            if is_creased(now, before, outside) {
                let is_beside = |of: &ComponentSolution| of.boundary_normals.iter().any(|(v, _)| *v == at);
                let beside = solutions.iter().position(is_beside).unwrap_or(0);
                solutions[beside].report.outcome.reserve_crease(at);
            }
        }
    }
}
