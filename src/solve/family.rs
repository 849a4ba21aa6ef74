//! The family `Delta_B H = -2 w H (H^2 - K)` between the harmonic equation (`w` = 0) and that of minimal energy (`w` = 1,
//! paper (1)): where no harmonic surface is found, its member nearest to harmonic is the answer.

use nalgebra::Vector3;

use super::candidate::Candidate;
use super::control::Control;
use super::formulation::Formulation;
use super::iterate_options::IterateOptions;
use super::result::SolveStatus;
use super::system::System;
use crate::solve::transition::Transition;

/// Members are told apart to this.
/// Of 4 cases, half: 1 changes, +4 % iterations, 1 fails; double: 1 changes, 1 fails.
const RESOLUTION: f64 = 1.0 / 32.0;

/// The search for the nearest member.
#[derive(Debug)]
pub(crate) struct Family {
    formulation: Formulation,
    options: IterateOptions,
    /// Where the next member begins.
    x: Vec<Vector3<f64>>,
    /// The best member so far.
    best: Option<Candidate>,
    /// No member was found up to this `w`,
    missing: f64,
    /// and one at this.
    found: f64,
    tried: f64,
    /// Members nearer to harmonic are looked for, from the one at hand; else the first one found will do.
    approaches: bool,
}

impl Family {
    /// From the surface `x` of minimal energy towards harmonic, whose surface is not found from there.
    pub(crate) fn approach(
        formulation: Formulation,
        x: Vec<Vector3<f64>>,
        options: IterateOptions,
        system: &System,
        control: &Control<'_>,
    ) -> (Self, Transition) {
        Self::begin(formulation, x, options, 0.5, true, system, control)
    }

    /// From a start `x` for member `w`; a greater `w` where that has none on this mesh.
    pub(crate) fn retreat(
        formulation: Formulation,
        x: Vec<Vector3<f64>>,
        options: IterateOptions,
        w: f64,
        system: &System,
        control: &Control<'_>,
    ) -> (Self, Transition) {
        Self::begin(formulation, x, options, w, false, system, control)
    }

    fn begin(
        formulation: Formulation,
        x: Vec<Vector3<f64>>,
        options: IterateOptions,
        w: f64,
        approaches: bool,
        system: &System,
        control: &Control<'_>,
    ) -> (Self, Transition) {
        let mut family = Self {
            formulation,
            options,
            x,
            best: None,
            missing: 0.0,
            found: 1.0,
            tried: w,
            approaches,
        };
        let next = family.run(w, system, control);
        (family, next)
    }

    /// After the iteration with the member that was tried.
    pub(crate) fn next(&mut self, last: Candidate, system: &System, control: &Control<'_>) -> Transition {
        if last.is_stopped() {
            return Transition::Done(self.best.take().unwrap_or(last));
        }
        if last.is_sound() {
            self.found = self.tried;
            self.x.clone_from(&last.x);
            self.best = Some(last);
            if !self.approaches {
                return self.end();
            }
        } else {
            self.missing = self.tried;
        }
        if self.tried == 0.0 || self.found == 0.0 {
            return self.end();
        }
        if self.approaches {
            let between = 0.5 * (self.missing + self.found);
            if self.found - self.missing > RESOLUTION {
                return self.run(between, system, control);
            }
            // From so near a harmonic surface may be found after all.
            if self.best.is_some() {
                return if self.missing > 0.0 {
                    self.end()
                } else {
                    self.run(0.0, system, control)
                };
            }
        }
        if self.missing < 1.0 {
            let farther = if self.approaches || self.missing > 1.0 - RESOLUTION {
                1.0
            } else {
                0.5 * (self.missing + 1.0)
            };
            return self.run(farther, system, control);
        }
        Transition::Short(SolveStatus::Failed)
    }

    fn end(&mut self) -> Transition {
        match self.best.take() {
            Some(best) if self.found == 0.0 => Transition::Done(best),
            Some(best) => Transition::Member(best, self.found),
            None => Transition::Short(SolveStatus::Failed),
        }
    }

    fn run(&mut self, w: f64, system: &System, control: &Control<'_>) -> Transition {
        self.tried = w;
        let formulation = self.formulation.member(w);
        Transition::iterate(system, formulation, self.x.clone(), self.options, control)
    }
}
