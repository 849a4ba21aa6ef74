//! Descent on the bending energy ([`Bending`]) from any surface: each step lowers it, so that it cannot diverge. Directions are those of
//! the limited memory quasi-Newton method (J. Nocedal, "Updating quasi-Newton matrices with limited storage", 1980) over the inverse of the
//! linear start's matrix: a Sobolev metric, in which smooth steps are short.

use std::collections::VecDeque;

use nalgebra::Vector3;

use super::bending::Bending;
use super::control::Control;
use super::factor::Collapsed;
use super::formulation::Formulation;
use super::limited_step::{advance, limited_part};
use super::system::System;

/// Steps at most. Of 244 regions that the direct way does not solve, half or double: 1 fewer succeeds.
const STEPS: usize = 150;
/// It is over when as many steps as [`MEMORY`] have gained less than this part of the energy.
/// Of the 244 regions, a third: 3 fewer succeed, +40 % time; three times: 2 fewer, -25 % time.
const GAIN: f64 = 1e-2;
/// Steps that the direction looks back on. Of the 244 regions, half: none fewer succeeds; double: 1.
const MEMORY: usize = 12;
/// No vertex moves farther in a step than so many times the median edge. Of the 244 regions, half or double: 1 more succeeds.
const FARTHEST: f64 = 1.5;
/// A step has to gain this part of what the gradient promises (J. Nocedal, S. Wright, "Numerical optimization", 3.1).
const SUFFICIENT: f64 = 1e-4;
/// So often a step is halved. Of the 244 regions, half or double: none fewer succeeds.
const HALVINGS: usize = 20;
/// What it is called in progress reports.
const PHASE: &str = "least bending";

/// A surface on the way down.
struct Descent<'a> {
    bending: Bending<'a>,
    x: Vec<Vector3<f64>>,
    energy: f64,
    gradient: Vec<f64>,
    /// The last steps, the newest first.
    taken: VecDeque<Taken>,
}

/// A step that was taken.
struct Taken {
    step: Vec<f64>,
    /// By how much it has changed the gradient,
    change: Vec<f64>,
    /// and the product of both.
    product: f64,
    /// The product of the step with `P` times itself, over that: what the inverse of `P` is to be scaled by.
    scale: f64,
}

impl System {
    /// A surface of less bending energy than `x`; where the run is stopped meanwhile, one on the way there.
    pub(crate) fn descend(
        &mut self,
        x: Vec<Vector3<f64>>,
        formulation: &Formulation,
        control: &mut Control<'_>,
    ) -> Result<Vec<Vector3<f64>>, Collapsed> {
        self.factor_connectivity(formulation)?;
        let (domain, normals) = (self.domain.clone(), self.boundary_normals().to_vec());
        let mut descent = Descent::new(Bending::new(&domain, &normals), x, self.free());
        let mut energies = vec![descent.energy];
        for step in 1..=STEPS {
            if !control.checkpoint(PHASE) || !descent.advance(self) {
                break;
            }
            energies.push(descent.energy);
            if step >= MEMORY && energies[step - MEMORY] - descent.energy < GAIN * descent.energy {
                break;
            }
        }
        Ok(descent.x)
    }

    /// The square of a step's length in the metric of `P`.
    fn square(&self, step: &[f64]) -> f64 {
        let mut whole: Vec<[f64; 3]> = step.as_chunks().0.to_vec();
        let mut image = whole.clone();
        whole.resize(self.domain.region.region_vertices(), [0.0; 3]);
        let mut scratch = whole.clone();
        self.metric
            .apply(&self.domain.rings, &whole, None, &mut scratch, &mut image);
        dot(step, image.as_flattened())
    }

    /// The median length of the region's edges.
    fn median_edge(&self, x: &[Vector3<f64>]) -> f64 {
        let rings = &self.domain.rings;
        let mut squares: Vec<f64> = (0..self.free())
            .flat_map(|i| rings.ring(i).iter().map(move |&j| (i, j as usize)))
            .map(|(i, j)| (x[i] - x[j]).norm_squared())
            .collect();
        let middle = squares.len() / 2;
        squares.select_nth_unstable_by(middle, f64::total_cmp).1.sqrt()
    }
}

impl<'a> Descent<'a> {
    fn new(bending: Bending<'a>, x: Vec<Vector3<f64>>, free: usize) -> Self {
        let mut gradient = vec![0.0; 3 * free];
        Self {
            energy: bending.evaluate(&x, gradient.as_chunks_mut().0),
            bending,
            x,
            gradient,
            taken: VecDeque::new(),
        }
    }

    /// Takes a step. Returns whether there is one that leads down.
    fn advance(&mut self, system: &mut System) -> bool {
        let mut step = self.direction(system);
        let farthest = step.as_chunks::<3>().0.iter().map(length).fold(0.0, f64::max);
        let largest = FARTHEST * system.median_edge(&self.x);
        // The first direction has no length of its own.
        let scale = if self.taken.is_empty() {
            largest / farthest
        } else {
            limited_part(farthest, largest)
        };
        step.iter_mut().for_each(|d| *d *= scale);
        let Some((x, energy, gradient)) = self.search(&mut step) else {
            // Perhaps along the gradient alone.
            let has_memory = !self.taken.is_empty();
            self.taken.clear();
            return has_memory;
        };
        let before = std::mem::replace(&mut self.gradient, gradient);
        (self.x, self.energy) = (x, energy);
        self.remember(step, &before, system);
        true
    }

    /// Halves `step` until it leads far enough down. Returns where that is, with energy and gradient.
    fn search(&self, step: &mut [f64]) -> Option<(Vec<Vector3<f64>>, f64, Vec<f64>)> {
        let mut gradient = self.gradient.clone();
        let mut promised = SUFFICIENT * dot(step, &self.gradient);
        for _ in 0..HALVINGS {
            let mut x = self.x.clone();
            advance(&mut x, step, 1.0);
            let energy = self.bending.evaluate(&x, gradient.as_chunks_mut().0);
            if energy <= self.energy + promised {
                return Some((x, energy, gradient));
            }
            step.iter_mut().for_each(|s| *s *= 0.5);
            promised *= 0.5;
        }
        None
    }

    /// Keeps a step, where the energy is convex along it. `before` is the gradient that it began with.
    fn remember(&mut self, step: Vec<f64>, before: &[f64], system: &System) {
        let change: Vec<f64> = self.gradient.iter().zip(before).map(|(a, b)| a - b).collect();
        let product = dot(&change, &step);
        if product > 0.0 {
            self.taken.truncate(MEMORY - 1);
            self.taken.push_front(Taken {
                scale: system.square(&step) / product,
                step,
                change,
                product,
            });
        }
    }

    /// Downhill: the gradient times the matrix that the last steps make of the inverse of `P`, in two loops over them.
    fn direction(&self, system: &mut System) -> Vec<f64> {
        let mut direction: Vec<f64> = self.gradient.iter().map(|g| -g).collect();
        let mut parts = Vec::with_capacity(self.taken.len());
        for taken in &self.taken {
            let part = dot(&taken.step, &direction) / taken.product;
            add(&mut direction, -part, &taken.change);
            parts.push(part);
        }
        system.solve_p::<3>(direction.as_chunks_mut().0);
        let scale = self.taken.front().map_or(1.0, |last| last.scale);
        direction.iter_mut().for_each(|d| *d *= scale);
        for (taken, part) in self.taken.iter().zip(parts).rev() {
            let back = dot(&taken.change, &direction) / taken.product;
            add(&mut direction, part - back, &taken.step);
        }
        direction
    }
}

fn length(v: &[f64; 3]) -> f64 {
    Vector3::from(*v).norm()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn add(a: &mut [f64], factor: f64, b: &[f64]) {
    a.iter_mut().zip(b).for_each(|(a, b)| *a += factor * b);
}
