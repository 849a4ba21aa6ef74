//! OpenMesh's smoother and fairmesh side by side.
#![allow(clippy::print_stdout, reason = "the measured figures, for --nocapture")]

#[path = "../comparison/mod.rs"]
#[allow(dead_code, reason = "the report uses the rest")]
mod comparison;

use comparison::*;

#[test]
fn ours_is_closer_and_sooner() {
    for surface in SURFACES {
        for triangulation in triangulations() {
            let case = case(surface, triangulation, 1000);
            for m in case.smoother().iter().chain([&case.ours(), &case.ours_with_normals(), &case.exact()]) {
                println!("{surface:9} {:16} {:6} {:.4} s max {:.2e} rms {:.2e} normals {:.2} {}", triangulation.0, m.iterations, m.seconds, m.max, m.rms, m.normals, m.converged);
            }
        }
    }
}
