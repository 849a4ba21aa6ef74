//! Whole solves: seconds per phase, iterations and memory, by size and shape.
//!
//! `cargo bench --bench fairing` runs 1,000, 13,000 and 100,000 free vertices; other sizes, such as 1000000, and
//! `threads=N` go after `--`:
//!
//! ```text
//! cargo bench --bench fairing -- 1000000 threads=1
//! ```
//!
//! Without a size the paper's own solver comes first, beside the default one.
//!
//! Every case is a process of its own that reads its mesh from a file, so that the growth of its peak memory is the
//! solver's. Times are the best of several runs.
#![allow(clippy::print_stdout, reason = "it is what a benchmark does")]

use std::fs;
use std::io;
use std::path::Path;
use std::process::Command;

use fairmesh::{
    BoundaryNormals, Discretization, Options, PaperOptions, Report, Selection, Solution, SolverKind, fair,
};
use fairmesh_shapes::{OUTSIDE, Sampling, Shape, cylinder_band, cylinder_blend_fine, sphere_cap};

const SIZES: [usize; 3] = [1_000, 13_000, 100_000];
const CHILD: &str = "--one-case";

fn main() -> io::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [first, path, name, threads] = &arguments[..]
        && first == CHILD
    {
        return one_case(Path::new(path), name, threads.parse().unwrap_or(0));
    }
    let mut sizes: Vec<usize> = arguments.iter().filter_map(|a| a.parse().ok()).collect();
    if sizes.is_empty() {
        sizes = SIZES.to_vec();
        against_the_papers_solver();
    }
    let threads = arguments
        .iter()
        .find_map(|a| a.strip_prefix("threads="))
        .unwrap_or("0");
    println!(
        "{:9} {:>8} {:>9} {:>9} {:>9} {:>9} {:>9} {:>5} {:>9}  outcome",
        "shape", "free", "setup s", "start s", "iterate s", "quality s", "total s", "iter", "bytes/v"
    );
    for n in sizes {
        let sampling = Sampling::Irregular { seed: 1 };
        for (name, shape) in [
            ("cap", sphere_cap(60.0, n, sampling, OUTSIDE)),
            ("cylinder", cylinder_band(n, sampling, OUTSIDE)),
        ] {
            let path = std::env::temp_dir().join(format!("fairing-bench-{}", std::process::id()));
            fs::write(&path, pack(&shape))?;
            drop(shape);
            let status = Command::new(std::env::current_exe()?)
                .args([CHILD.as_ref(), path.as_os_str(), name.as_ref(), threads.as_ref()])
                .status();
            fs::remove_file(&path)?;
            if !status?.success() {
                return Err(io::Error::other(format!("{name} {n} failed")));
            }
        }
    }
    Ok(())
}

/// The largest mesh of the paper's Table 1, by both solvers.
fn against_the_papers_solver() {
    let shape = cylinder_blend_fine();
    let normals = shape.boundary_normals();
    let paper = PaperOptions {
        defect: 2e-3,
        ..PaperOptions::default()
    };
    let [paper, fast] = [SolverKind::Paper(paper), SolverKind::Fast].map(|solver| {
        let options = Options {
            boundary_normals: BoundaryNormals::Given(normals.clone()),
            discretization: Discretization::Paper,
            solver,
            ..Options::default()
        };
        let selection = Selection::Mask(&shape.free);
        let solution =
            fair(&shape.positions, &shape.triangles, selection, &options).expect("a sound problem");
        solution.report.seconds.total
    });
    println!(
        "blend of {}: the paper's solver {paper:.2} s, the default one {fast:.3} s, {:.0} times",
        shape.free_count(),
        paper / fast
    );
}

/// A mesh with its free vertices and boundary normals.
struct Case {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    free: Vec<u32>,
    normals: Vec<(u32, [f64; 3])>,
}

fn pack(shape: &Shape) -> Vec<u8> {
    let (positions, free, normals) = (shape.flat(), shape.free_vertices(), shape.boundary_normals());
    let mut bytes = Vec::new();
    for count in [positions.len(), shape.triangles.len(), free.len(), normals.len()] {
        bytes.extend((count as u32).to_le_bytes());
    }
    let indices = shape.triangles.as_flattened().iter().chain(&free);
    indices.for_each(|v| bytes.extend(v.to_le_bytes()));
    positions
        .as_flattened()
        .iter()
        .for_each(|x| bytes.extend(x.to_le_bytes()));
    for (v, n) in normals {
        bytes.extend(v.to_le_bytes());
        n.iter().for_each(|x| bytes.extend(x.to_le_bytes()));
    }
    bytes
}

fn unpack(mut bytes: &[u8]) -> Option<Case> {
    let counts: [u32; 4] = [
        index(&mut bytes)?,
        index(&mut bytes)?,
        index(&mut bytes)?,
        index(&mut bytes)?,
    ];
    let mut case = Case {
        positions: Vec::new(),
        triangles: Vec::new(),
        free: Vec::new(),
        normals: Vec::new(),
    };
    for _ in 0..counts[1] {
        case.triangles
            .push([index(&mut bytes)?, index(&mut bytes)?, index(&mut bytes)?]);
    }
    for _ in 0..counts[2] {
        case.free.push(index(&mut bytes)?);
    }
    for _ in 0..counts[0] {
        case.positions.push(point(&mut bytes)?);
    }
    for _ in 0..counts[3] {
        case.normals.push((index(&mut bytes)?, point(&mut bytes)?));
    }
    Some(case)
}

fn index(bytes: &mut &[u8]) -> Option<u32> {
    let (first, rest) = bytes.split_first_chunk()?;
    *bytes = rest;
    Some(u32::from_le_bytes(*first))
}

fn point(bytes: &mut &[u8]) -> Option<[f64; 3]> {
    let mut point = [0.0; 3];
    for x in &mut point {
        let (first, rest) = bytes.split_first_chunk()?;
        *bytes = rest;
        *x = f64::from_le_bytes(*first);
    }
    Some(point)
}

fn one_case(path: &Path, name: &str, threads: usize) -> io::Result<()> {
    let case = unpack(&fs::read(path)?).ok_or(io::ErrorKind::UnexpectedEof)?;
    let before = memory("VmRSS:");
    // Linux: the peak from now on. Without it the peak includes reading the file.
    let _ = fs::write("/proc/self/clear_refs", "5");
    let first = solve(&case, threads)?;
    let peak = memory("VmHWM:");
    let n = first.report.free_vertices;
    let runs = (100_000 / n).clamp(1, 10);
    let mut best: Report = first.report;
    for _ in 1..runs {
        let report = solve(&case, threads)?.report;
        if report.seconds.total < best.seconds.total {
            best = report;
        }
    }
    let bytes = match (before, peak) {
        (Some(before), Some(peak)) => format!("{:.0}", (peak - before) / n as f64),
        _ => "?".to_owned(),
    };
    let s = &best.seconds;
    println!(
        "{name:9} {n:8} {:9.4} {:9.4} {:9.4} {:9.4} {:9.4} {:5} {bytes:>9}  {}",
        s.setup,
        s.start,
        s.iterate,
        s.quality,
        s.total,
        best.iterations,
        best.outcome.name()
    );
    Ok(())
}

fn solve(case: &Case, threads: usize) -> io::Result<Solution> {
    let options = Options {
        boundary_normals: BoundaryNormals::Given(case.normals.clone()),
        threads,
        ..Options::default()
    };
    fair(
        &case.positions,
        &case.triangles,
        Selection::Vertices(&case.free),
        &options,
    )
    .map_err(io::Error::other)
}

/// A size in bytes from the status that Linux keeps of this process.
fn memory(entry: &str) -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(entry))?;
    Some(1024.0 * line.split_whitespace().next()?.parse::<f64>().ok()?)
}
