//! How far rounding is.

use std::ops::ControlFlow;

use crate::fairing::{Progress, ProgressCallback};

/// The part of what is left that each fairing takes: most runs need one or two.
/// Half or double: only the progress changes.
const SHARE: f64 = 0.6;

/// Tells fractions of the whole run.
pub(super) struct Telling<'t, 'c> {
    tell: &'t mut ProgressCallback<'c>,
    /// Where the next fairing begins.
    begins: f64,
}

impl<'t, 'c> Telling<'t, 'c> {
    pub(super) fn new(tell: &'t mut ProgressCallback<'c>) -> Self {
        Self { tell, begins: 0.0 }
    }

    /// What the next fairing tells its progress.
    pub(super) fn fairing(&mut self) -> impl FnMut(&Progress) -> ControlFlow<()> + Send + use<'_, 't, 'c> {
        let share = SHARE * (1.0 - self.begins);
        let begins = self.begins;
        self.begins += share;
        move |progress| {
            (self.tell)(&Progress {
                fraction: begins + share * progress.fraction,
                ..*progress
            })
        }
    }
}
