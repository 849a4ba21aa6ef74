//! Frames: what a drag costs, in evaluations of the equations and in milliseconds, beside a whole solve of the same problem.
//!
//! ```text
//! cargo bench --bench live                  # all shapes, one thread
//! cargo bench --bench live -- blend threads=2
//! ```
//!
//! A drag is 30 frames of one degree (or of a thirtieth of the movement) from the fair surface outward, and 30 back. `p50`, `p95` and `most` are
//! evaluations and milliseconds of a frame; `away` is how far the finished surface is from that of a fresh solve of the same data, in
//! diagonals.
#![allow(clippy::print_stdout, reason = "it is what a benchmark does")]

use std::time::Instant;

use fairmesh::{BoundaryNormals, Budget, Edit, Options, Selection, Solver, fair};
use fairmesh_shapes::{
    OUTSIDE, Sampling, Shape, catenoid_band, cylinder_blend_of, sphere_cap, sphere_with_hole, tetra_thing_of,
};

const FRAMES: u32 = 30;
const DEGREE: f64 = std::f64::consts::PI / 180.0;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let threads = arguments.iter().find_map(|a| a.strip_prefix("threads="));
    let threads = threads.and_then(|t| t.parse().ok()).unwrap_or(1);
    let wanted: Vec<&String> = arguments.iter().filter(|a| !a.contains('=')).collect();
    println!(
        "{:24} {:>6} {:10} {:>13} {:>17} {:>6} {:>8} {:>8} {:>8}",
        "shape", "free", "drag", "evaluations", "ms", "open", "cold it", "cold ms", "away"
    );
    for (name, shape) in shapes() {
        if wanted.is_empty() || wanted.iter().any(|w| name.contains(w.as_str())) {
            for drag in drags(&shape) {
                measure(&name, &shape, &drag, threads);
            }
        }
    }
}

fn shapes() -> Vec<(String, Shape)> {
    let irregular = Sampling::Irregular { seed: 1 };
    let mut shapes: Vec<(String, Shape)> = [1_000, 5_000, 13_308]
        .map(|n| (format!("blend {n}"), cylinder_blend_of(n, Sampling::Regular)))
        .into();
    shapes.push(("blend 5000 irregular".into(), cylinder_blend_of(5_000, irregular)));
    shapes.push(("tetra 5000".into(), tetra_thing_of(5_000, Sampling::Regular)));
    shapes.push((
        "cap 5000".into(),
        sphere_cap(60.0, 5_000, Sampling::Irregular { seed: 2 }, OUTSIDE),
    ));
    shapes.push(("catenoid 5000".into(), catenoid_band(5_000, irregular, OUTSIDE)));
    shapes.push(("hole 5000".into(), sphere_with_hole(150.0, 5_000, irregular, 0)));
    shapes
}

/// The edits at a share of the way.
struct Drag {
    name: &'static str,
    at: Box<dyn Fn(f64) -> Edit>,
}

/// The boundary vertices, and the vertices of one loop of them.
fn first_loop(shape: &Shape) -> (u32, Vec<u32>) {
    let boundary: Vec<u32> = shape.boundary_normals().iter().map(|n| n.0).collect();
    let mut is_boundary = vec![false; shape.positions.len()];
    boundary.iter().for_each(|&v| is_boundary[v as usize] = true);
    let mut ring = vec![boundary[0]];
    let mut k = 0;
    while k < ring.len() {
        let at = ring[k];
        for t in shape.triangles.iter().filter(|t| t.contains(&at)) {
            for &v in t {
                if is_boundary[v as usize] && !ring.contains(&v) {
                    ring.push(v);
                }
            }
        }
        k += 1;
    }
    (boundary[0], ring)
}

fn drags(shape: &Shape) -> Vec<Drag> {
    let (vertex, ring) = first_loop(shape);
    let size = shape.mean_edge() * (shape.free_count() as f64).sqrt();
    let full = 30.0 * DEGREE;
    let handle = ring.clone();
    let centre = shape.positions[vertex as usize];
    vec![
        Drag {
            name: "tilt +",
            at: Box::new(move |s| Edit::Tilt {
                vertex,
                angle: s * full,
                falloff: 0.0,
            }),
        },
        Drag {
            name: "tilt -",
            at: Box::new(move |s| Edit::Tilt {
                vertex,
                angle: -s * full,
                falloff: 0.0,
            }),
        },
        Drag {
            name: "tilt near",
            at: Box::new(move |s| Edit::Tilt {
                vertex,
                angle: s * full,
                falloff: 0.3 * size,
            }),
        },
        Drag {
            name: "twist",
            at: Box::new(move |s| Edit::Twist {
                vertex,
                angle: s * full,
                falloff: 0.0,
            }),
        },
        Drag {
            name: "bulge",
            at: Box::new(move |s| Edit::Bulge { amount: s * full }),
        },
        Drag {
            name: "move",
            at: Box::new(move |s| Edit::Move {
                vertices: ring.clone(),
                rotation: [0.0; 3],
                centre: [0.0; 3],
                translation: [0.1 * s * size, 0.05 * s * size, 0.1 * s * size],
                falloff: 0.0,
            }),
        },
        Drag {
            name: "turn",
            at: Box::new(move |s| Edit::Move {
                vertices: handle.clone(),
                rotation: [0.1 * s * full, s * full, 0.2 * s * full],
                centre,
                translation: [0.0; 3],
                falloff: 0.0,
            }),
        },
    ]
}

fn measure(name: &str, shape: &Shape, drag: &Drag, threads: usize) {
    let options = Options {
        boundary_normals: BoundaryNormals::Given(shape.boundary_normals()),
        threads,
        ..Options::default()
    };
    let selection = Selection::Mask(&shape.free);
    let mut solver =
        Solver::new(&shape.positions, &shape.triangles, selection, &options).expect("a sound problem");
    solver.finish(None).expect("a sound problem");
    let (mut evaluations, mut times, mut open) = (Vec::new(), Vec::new(), 0);
    let there = (1..=FRAMES).map(|k| f64::from(k) / f64::from(FRAMES));
    let back = (0..FRAMES).rev().map(|k| f64::from(k) / f64::from(FRAMES));
    let mut away = f64::NAN;
    let mut cold = (0, f64::NAN);
    for (k, s) in there.chain(back).enumerate() {
        let clock = Instant::now();
        solver.edit(&[(drag.at)(s)]).expect("a sound edit");
        let frame = solver.update(&Budget::default()).expect("a frame");
        times.push(1e3 * clock.elapsed().as_secs_f64());
        evaluations.push(frame.evaluations as f64);
        open += usize::from(!frame.is_settled);
        if k + 1 == FRAMES as usize {
            (away, cold) = against_cold(&mut solver, shape, &options);
        }
    }
    println!(
        "{name:24} {:6} {:10} {} {} {open:6} {:8} {:8.1} {away:8.1e}",
        shape.free_count(),
        drag.name,
        spread(&mut evaluations, 4, 0),
        spread(&mut times, 5, 1),
        cold.0,
        cold.1
    );
}

/// Finishes, and solves the same data afresh. Returns the largest distance, the iterations and milliseconds of the fresh solve.
fn against_cold(solver: &mut Solver, shape: &Shape, options: &Options) -> (f64, (usize, f64)) {
    let finished = solver.finish(None).expect("a surface");
    let edited = Options {
        boundary_normals: BoundaryNormals::Given(finished.boundary_normals.clone()),
        ..options.clone()
    };
    let mut positions = shape.positions.clone();
    for (v, p) in positions.iter_mut().enumerate().filter(|(v, _)| !shape.free[*v]) {
        *p = finished.positions[v];
    }
    let clock = Instant::now();
    let cold = fair(
        &positions,
        &shape.triangles,
        Selection::Mask(&shape.free),
        &edited,
    )
    .expect("a sound problem");
    let seconds = clock.elapsed().as_secs_f64();
    let pairs = cold
        .positions
        .iter()
        .flatten()
        .zip(finished.positions.iter().flatten());
    let away = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / cold.report.diagonal;
    (away, (cold.report.iterations, 1e3 * seconds))
}

/// Median, 95th percentile and largest.
fn spread(values: &mut [f64], width: usize, digits: usize) -> String {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| values[((values.len() as f64 * share).ceil() as usize).clamp(1, values.len()) - 1];
    format!(
        "{:width$.digits$}{:width$.digits$}{:width$.digits$}",
        at(0.5),
        at(0.95),
        at(1.0)
    )
}
