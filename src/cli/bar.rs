//! The progress bar.

use std::ops::ControlFlow;

use fairmesh::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// It shows itself on a terminal only.
pub struct Bar(ProgressBar);

impl Bar {
    /// Steps of the bar.
    const LENGTH: u64 = 1000;

    /// A bar from 0 to 1; nothing is shown if `quiet`.
    pub fn new(quiet: bool) -> Self {
        let target = if quiet {
            ProgressDrawTarget::hidden()
        } else {
            ProgressDrawTarget::stderr()
        };
        let bar = ProgressBar::with_draw_target(Some(Self::LENGTH), target);
        if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} %  {elapsed}  {wide_msg}") {
            bar.set_style(style);
        }
        Self(bar)
    }

    /// Takes it away.
    pub fn finish(&self) {
        self.0.finish_and_clear();
    }

    /// Shows how far the run is.
    pub fn show(&mut self, progress: &Progress) -> ControlFlow<()> {
        self.0
            .set_position((progress.fraction.clamp(0.0, 1.0) * Self::LENGTH as f64) as u64);
        self.0
            .set_message(format!("{}, iteration {}", progress.phase, progress.iterations));
        ControlFlow::Continue(())
    }
}
