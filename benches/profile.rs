//! Where the time of a solve goes: seconds of a solve by size, then the share of each part, on one thread.
//!
//! ```text
//! cargo bench --bench profile --features profile
//! FAIRMESH_BENCH_SIZES=1000000 cargo bench --bench profile --features profile
//! ```
//!
//! `benches/peers.py` compares whole solves with those of other libraries.
#![allow(clippy::print_stdout, reason = "it is what a benchmark does")]

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use divan::Bencher;
use fairmesh::{BoundaryNormals, Options, Report, Selection, fair, take_profile};
use fairmesh_shapes::{OUTSIDE, Sampling, sphere_cap};

/// What the solves of one size have taken.
struct Solved {
    last: Report,
    solves: f64,
    /// Of all solves.
    seconds: f64,
    parts: BTreeMap<&'static str, f64>,
}

static SOLVED: Mutex<Vec<Solved>> = Mutex::new(Vec::new());

fn main() {
    divan::main();
    let solved = SOLVED.lock().unwrap_or_else(PoisonError::into_inner);
    if !solved.is_empty() {
        print(&solved);
    }
}

fn sizes() -> Vec<usize> {
    let asked = std::env::var("FAIRMESH_BENCH_SIZES").unwrap_or_default();
    let sizes: Vec<usize> = asked.split(',').filter_map(|size| size.parse().ok()).collect();
    if sizes.is_empty() {
        vec![1_000, 13_000, 100_000]
    } else {
        sizes
    }
}

#[divan::bench(args = sizes(), sample_size = 1, max_time = 10)]
fn solve(bencher: Bencher<'_, '_>, n: usize) {
    let shape = sphere_cap(60.0, n, Sampling::Irregular { seed: 1 }, OUTSIDE);
    let options = Options {
        boundary_normals: BoundaryNormals::Given(shape.boundary_normals()),
        threads: 1,
        ..Options::default()
    };
    let positions = shape.flat();
    let (mut solves, mut seconds, mut last) = (0.0, 0.0, None);
    take_profile();
    bencher.bench_local(|| {
        let selection = Selection::Mask(&shape.free);
        let report = fair(&positions, &shape.triangles, selection, &options)
            .expect("a sound problem")
            .report;
        solves += 1.0;
        seconds += report.seconds.total;
        last = Some(report);
    });
    let parts = take_profile();
    SOLVED
        .lock()
        .unwrap_or_else(PoisonError::into_inner)
        .extend(last.map(|last| Solved {
            last,
            solves,
            seconds,
            parts,
        }));
}

/// One column for each size.
fn print(solved: &[Solved]) {
    let row = |name: &str, value: &dyn Fn(&Solved) -> String| {
        let columns: Vec<String> = solved.iter().map(|s| format!("{:>10}", value(s))).collect();
        println!("{name:28}{}", columns.concat());
    };
    row("free vertices", &|s| s.last.free_vertices.to_string());
    row("iterations", &|s| s.last.iterations.to_string());
    row("seconds of a solve", &|s| format!("{:.4}", s.seconds / s.solves));
    let mut names: Vec<&str> = solved.iter().flat_map(|s| s.parts.keys().copied()).collect();
    names.sort_unstable();
    names.dedup();
    for name in names {
        row(name, &|s| {
            let share = s.parts.get(name).copied().unwrap_or(0.0) / s.seconds;
            format!("{:.1} %", 100.0 * share)
        });
    }
    let counted = |s: &Solved| s.parts.values().sum::<f64>();
    row("not counted", &|s| {
        format!("{:.1} %", 100.0 * (1.0 - counted(s) / s.seconds))
    });
}
