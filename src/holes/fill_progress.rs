//! What a run of filling has done, of what it has to do: in new vertices, each of which takes about the same time.

use crate::fairing::Progress;

/// The work of looking at one triangle of the mesh: measured on bowls of 190,000 and 290,000 triangles with a hole of 600 and 720 edges.
/// With .06 the progress of the second is off by .32 of the time, with .08 and [`READ`] by .19.
const PER_TRIANGLE: f64 = 0.08;
/// What of that is finding the loops; the rest is the tree of what patches may intersect.
/// Where nothing is told then, the progress is off by .32 of the time.
const READ: f64 = 0.5;
/// The work of one edge of a loop: what is done once for a small loop.
/// Half or double, of 38 cases: only the progress changes.
const PER_EDGE: f64 = 2.0;

/// What of a patch's share its first fairing is: few are faired more often, and for those it is half of the time.
/// With .9, what is faired twice (a bridge at density 10) is off by .44 of the time and a fill that is faired once by .14; with .8 by .23 and .22.
const FIRST: f64 = 0.8;
/// A fraction that falls by more than this begins anew.
/// Half or double, of 36 cases: none changes.
const ANEW: f64 = 0.3;

/// How far one patch is, that may be faired more than once: each time but the first takes half of what is left.
pub(super) struct Tries {
    from: f64,
    to: f64,
    last: f64,
    reached: f64,
}

impl Tries {
    pub(super) fn new() -> Self {
        Self {
            from: 0.0,
            to: FIRST,
            last: 0.0,
            reached: 0.0,
        }
    }

    /// The fraction of the patch that is done at this fraction of a fairing; it never falls.
    pub(super) fn reached(&mut self, fraction: f64) -> f64 {
        if fraction < self.last - ANEW {
            self.from = self.reached;
            self.to = (1.0 + self.from) / 2.0;
        }
        self.last = fraction;
        self.reached = self.reached.max(self.from + (self.to - self.from) * fraction);
        self.reached
    }
}

/// How far a run is.
pub(super) struct FillProgress {
    density: f64,
    done: f64,
    total: f64,
}

impl FillProgress {
    /// Of groups of loops with so many edges each, in a mesh of so many triangles, which have been looked at.
    pub(super) fn new(triangles: usize, density: f64, edges: impl Iterator<Item = usize>) -> Self {
        let done = PER_TRIANGLE * triangles as f64;
        Self {
            density,
            done,
            total: done + edges.map(|edges| patch(edges, density)).sum::<f64>(),
        }
    }

    /// What is told once the loops are known.
    pub(super) fn loops_known(&self) -> Progress {
        Progress {
            fraction: READ * self.done / self.total,
            iterations: 0,
            step: f64::NAN,
            phase: "setup",
        }
    }

    /// The fraction that is done, and the share of a patch of so many edges.
    pub(super) fn share(&self, edges: usize) -> (f64, f64) {
        (self.done / self.total, patch(edges, self.density) / self.total)
    }

    /// Such a patch is made.
    pub(super) fn end(&mut self, edges: usize) {
        self.done += patch(edges, self.density);
    }
}

/// The new vertices of a disc with so many edges around, each with an area of `sqrt(3)/2` edges squared, and those edges.
fn patch(edges: usize, density: f64) -> f64 {
    let edges = edges as f64;
    let area = edges * edges / (4.0 * std::f64::consts::PI);
    area * density * density * 2.0 / 3.0_f64.sqrt() + PER_EDGE * edges
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shares_make_the_whole() {
        let edges = [5, 40, 12];
        let mut work = FillProgress::new(1000, 1.5, edges.into_iter());
        let mut last = 0.0;
        for edges in edges {
            let (done, share) = work.share(edges);
            assert_above!(done, last);
            assert_above!(share, 0.0);
            last = done;
            work.end(edges);
        }
        assert_near!(work.share(0).0, 1.0, 1e-12);
    }

    #[test]
    fn a_patch_that_is_tried_again_goes_on_and_never_ends_before() {
        let mut tries = Tries::new();
        let told: Vec<f64> = [0.0, 0.5, 1.0, 0.1, 0.9, 0.2, 1.0]
            .map(|f| tries.reached(f))
            .to_vec();
        assert!(told.is_sorted() && told[2] == 0.8, "{told:?}");
        assert!(told[4] > 0.85 && told[6] > told[4] && told[6] < 1.0, "{told:?}");
    }
}
