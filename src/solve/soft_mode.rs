//! A second surface with the same boundary data. Two harmonic surfaces that come near each other, and meet where the boundary moves
//! a little, differ by the mode in which the equation hardly answers: along it the residual vanishes once more.

use nalgebra::Vector3;

use super::candidate::bending_energy;
use super::control::Control;
use super::formulation::Formulation;
use super::system::System;

/// What it is called in progress reports.
pub(crate) const PHASE: &str = "second surface";
/// Rounds of power iteration for the mode.
/// Of 21 cases, half: 1 changes by up to 5e-10 edges; double: 1 changes by up to 3e-10 edges.
const ROUNDS: usize = 16;
/// Rounds of power iteration after which the mode has a shape.
/// Half or double, of 21 cases: none changes.
const SETTLING: usize = 4;
/// Part of the mode that is left by a round; less says that the equation answers to every mode.
/// Half or double, of 21 cases: none changes.
const SOFT: f64 = 0.7;
/// Displacement, in diagonals, for finite differences.
/// Of 21 cases, half: 1 changes by up to 6e-9 edges; double: 1 changes by up to 1e-8 edges.
const DIFFERENCE: f64 = 1e-4;
/// The nearest displacement, in diagonals, at which the second surface is looked for.
/// Of 10 cases, half: 1 changes by up to 2e-8 edges; double: 1 changes by up to 1e-8 edges.
const NEAREST: f64 = 0.002;
/// The farthest displacement, in diagonals, at which it is looked for.
/// Half or double, of 10 cases: none changes.
const FARTHEST: f64 = 0.2;
/// The next displacement over the last one.
/// Of 10 cases, half: 2 change by up to 3e-8 edges, 1 fails; double: 1 changes by up to 3e-8 edges.
const FACTOR: f64 = 1.4;
/// A residual that falls to this part, by the displacement, and grows again may vanish beside the straight way.
/// Of 10 cases, half: none changes; double: 0 change, +8 % iterations.
const NEARLY: f64 = 0.8;

/// Displacements along the normals of a surface.
struct Displaced {
    formulation: Formulation,
    x: Vec<Vector3<f64>>,
    normal: Vec<Vector3<f64>>,
}

impl Displaced {
    /// The surface moved by `scale * mode`.
    fn at(&self, mode: &[f64], scale: f64) -> Vec<Vector3<f64>> {
        let mut x = self.x.clone();
        for ((x, n), m) in x.iter_mut().zip(&self.normal).zip(mode) {
            *x += n * (scale * m);
        }
        x
    }

    /// The normal step `P^-1 R1` there.
    fn step(&self, mode: &[f64], scale: f64, system: &mut System) -> Vec<f64> {
        system.evaluate(&self.at(mode, scale), &self.formulation);
        let mut step = vec![0.0; 3 * mode.len()];
        system.step(&mut step, &self.formulation);
        system.normal_step(&mut step);
        let steps = step.as_chunks().0.iter();
        steps
            .zip(&self.normal)
            .map(|(s, n)| Vector3::from(*s).dot(n))
            .collect()
    }
}

/// Where the second surface is to be expected, if it has less bending energy than the solution `x`. `P` is made there.
pub(crate) fn second_surface(
    x: &[Vector3<f64>],
    formulation: &Formulation,
    system: &mut System,
    control: &mut Control<'_>,
) -> Option<Vec<Vector3<f64>>> {
    system.rebuild(x, formulation).ok()?;
    system.evaluate(x, formulation);
    let surface = Displaced {
        formulation: formulation.clone(),
        x: x.to_vec(),
        normal: system.state().normal[..system.free()].to_vec(),
    };
    let energy = bending_energy(system.state());
    let mode = softest_mode(&surface, system, control)?;
    let places = [1.0, -1.0].map(|side| beyond(&surface, &mode, side, system));
    let lower = places.into_iter().flatten().filter(|place| place.energy < energy);
    let least = lower.min_by(|a, b| a.energy.total_cmp(&b.energy))?;
    Some(surface.at(&mode, least.scale))
}

/// The normal displacement, at most one diagonal, that a plain step changes least: power iteration on `1 + d(P^-1 R1)`. `None` where
/// the equation answers to every one.
fn softest_mode(surface: &Displaced, system: &mut System, control: &mut Control<'_>) -> Option<Vec<f64>> {
    let mut mode: Vec<f64> = system.state().area.clone();
    normalize(&mut mode, system.diagonal);
    let rest = surface.step(&mode, 0.0, system);
    for round in 1..=ROUNDS {
        if !control.checkpoint(PHASE) {
            return None;
        }
        let moved = surface.step(&mode, DIFFERENCE, system);
        for ((m, a), b) in mode.iter_mut().zip(&moved).zip(&rest) {
            *m += (a - b) / DIFFERENCE;
        }
        let left = normalize(&mut mode, system.diagonal);
        if !left.is_finite() || round > SETTLING && left < SOFT {
            return None;
        }
    }
    Some(mode)
}

/// Makes the largest displacement `largest`. Returns what it was, in that unit.
fn normalize(mode: &mut [f64], largest: f64) -> f64 {
    let before = mode.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    mode.iter_mut().for_each(|m| *m *= largest / before);
    before / largest
}

/// A place along the mode.
struct ModeOffset {
    scale: f64,
    energy: f64,
}

/// The place to one side where the residual in `mode` vanishes once more, or nearly: the way there is not quite straight.
fn beyond(surface: &Displaced, mode: &[f64], side: f64, system: &mut System) -> Option<ModeOffset> {
    let along = |scale: f64, system: &mut System| {
        system.evaluate(&surface.at(mode, scale), &surface.formulation);
        let residuals = system.state().outer.iter().zip(mode);
        residuals.map(|(r, m)| r * m).sum::<f64>()
    };
    let own = along(0.0, system);
    let mut last = (0.0, 0.0);
    let mut first = 0.0f64;
    let mut scale = side * NEAREST;
    while scale.abs() < FARTHEST {
        let slope = (along(scale, system) - own) / scale;
        let (before, was) = last;
        let place = if was * slope < 0.0 {
            Some(before + (scale - before) * was / (was - slope))
        } else if slope.abs() > was.abs() && was.abs() < NEARLY * first.abs() {
            Some(before)
        } else {
            None
        };
        if let Some(scale) = place {
            along(scale, system);
            let energy = bending_energy(system.state());
            return Some(ModeOffset { scale, energy });
        }
        first = if first == 0.0 { slope } else { first };
        last = (scale, slope);
        scale *= FACTOR;
    }
    None
}
