//! Results of 24 small cases against stored ones, so that a change of the arithmetic shows.
//!
//! `golden.txt` was written by this file at commit d9f41a9 (the names of the options were others), and the row of the paper's solver
//! when its hierarchy was left out: which collapse comes first hangs on rounding. Tolerances of 1e-12 make the results sharp: rounding
//! moves them by less than `NEAR`. Renew the table with `FAIRMESH_WRITE_GOLDEN=1` only in a commit
//! that means to change results (another equation, another rule of refinement), and say there by how much they move.

use std::fmt::Write;
use std::fs;

use crate::fairing::*;
use fairmesh::{
    BoundaryNormals, Discretization, Estimate, FillOptions, InnerFairness, InteriorNormals, Loops, Options,
    PaperOptions, RemeshOptions, Selection, Solution, SolverKind, Target, fill_holes, remesh_region,
};
use fairmesh_shapes::*;

/// Coordinates agree to this, in diagonals,
const NEAR: f64 = 1e-11;
/// where the tolerance was not met, to this: the matrices are factored in 32 bits, and what is stopped on the way shows it.
const NEAR_ON_THE_WAY: f64 = 1e-7;
/// Rounding may add or save so many iterations.
const ITERATIONS: usize = 2;

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/library/golden.txt");

/// How a case ends: outcome, iterations, free vertices, diagonal, and a coordinate each of five free vertices.
struct Golden {
    outcome: String,
    iterations: usize,
    vertices: usize,
    diagonal: f64,
    coordinates: [f64; 5],
}

impl Golden {
    fn new(outcome: &str, iterations: usize, diagonal: f64, free: &[[f64; 3]]) -> Self {
        Self {
            outcome: outcome.to_owned(),
            iterations,
            vertices: free.len(),
            diagonal,
            coordinates: std::array::from_fn(|k| free[(2 * k + 1) * free.len() / 10][k % 3]),
        }
    }

    fn of(shape: &Shape, solution: &Solution) -> Self {
        let free: Vec<_> = (shape.free_vertices().into_iter())
            .map(|v| solution.positions[v as usize])
            .collect();
        let report = &solution.report;
        Self::new(report.outcome.name(), report.iterations, report.diagonal, &free)
    }

    fn line(&self, name: &str) -> String {
        let mut line = format!(
            "{name}: {} {} {} {:.6}",
            self.outcome, self.iterations, self.vertices, self.diagonal
        );
        for c in self.coordinates {
            write!(line, " {c:.14}").unwrap();
        }
        line
    }

    /// Of a line without its name.
    fn read(line: &str) -> Self {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [outcome, iterations, vertices, diagonal, coordinates @ ..] = &words[..] else {
            panic!("{line}")
        };
        let coordinates: Vec<f64> = coordinates.iter().map(|c| c.parse().unwrap()).collect();
        Self {
            outcome: (*outcome).to_owned(),
            iterations: iterations.parse().unwrap(),
            vertices: vertices.parse().unwrap(),
            diagonal: diagonal.parse().unwrap(),
            coordinates: coordinates.try_into().unwrap(),
        }
    }
}

fn sharp() -> Options {
    options(1e-12)
}

fn given(name: &str, shape: &Shape, options: Options) -> (String, Golden) {
    let solution = solve(shape, &flat(shape), options);
    (name.to_owned(), Golden::of(shape, &solution))
}

fn surfaces() -> Vec<(String, Golden)> {
    let cap = sphere_cap(60.0, 1_000, irregular(1), OUTSIDE);
    let random = solve(&cap, &cap.random(1), sharp());
    vec![
        ("cap from random".to_owned(), Golden::of(&cap, &random)),
        given(
            "regular cap",
            &sphere_cap(60.0, 1_000, Sampling::Regular, OUTSIDE),
            sharp(),
        ),
        given(
            "zone",
            &sphere_zone(-40.0, 50.0, 1_000, irregular(2), OUTSIDE),
            sharp(),
        ),
        given("cylinder", &cylinder_band(1_000, irregular(3), OUTSIDE), sharp()),
        given("catenoid", &catenoid_band(1_000, irregular(4), OUTSIDE), sharp()),
        given(
            "unduloid",
            &unduloid_band(0.5, 1.0, 1_000, irregular(5), OUTSIDE),
            sharp(),
        ),
        given("saddle", &saddle_graph(1_000, irregular(6), OUTSIDE), sharp()),
        given(
            "large cylinder",
            &cylinder_band(13_000, irregular(2), OUTSIDE),
            sharp(),
        ),
        given("blend", &cylinder_blend(), sharp()),
        given("tetra thing", &tetra_thing_coarse(), sharp()),
    ]
}

fn choices() -> Vec<(String, Golden)> {
    let (blend, tetra) = (cylinder_blend(), tetra_thing_coarse());
    let cylinder = cylinder_band(1_000, irregular(7), OUTSIDE);
    let inner = |inner_fairness| Options {
        inner_fairness,
        ..sharp()
    };
    let target = |target| Options { target, ..sharp() };
    let discretization = Discretization::Paper;
    let max_iterations = 5;
    vec![
        given("conformal blend", &blend, inner(InnerFairness::Conformal)),
        given("convex tetra thing", &tetra, inner(InnerFairness::Convex)),
        given(
            "paper discretization",
            &blend,
            Options {
                discretization,
                ..sharp()
            },
        ),
        given("minimal energy", &cylinder, target(Target::MinimalEnergy)),
        given("constant", &blend, target(Target::Constant(0.05))),
        given("constant too large", &blend, target(Target::Constant(20.0))),
        given(
            "five iterations",
            &cylinder,
            Options {
                max_iterations,
                ..sharp()
            },
        ),
    ]
}

fn normals() -> Vec<(String, Golden)> {
    let (cylinder, blend) = (cylinder_band(1_000, irregular(8), OUTSIDE), cylinder_blend());
    let fitted = solve_as_asked(&cylinder, &flat(&cylinder), sharp());
    let boundary_normals = BoundaryNormals::Averaged;
    let averaged = solve_as_asked(
        &cylinder,
        &flat(&cylinder),
        Options {
            boundary_normals,
            ..sharp()
        },
    );
    let mut points = sphere_cap(60.0, 1_000, irregular(9), OUTSIDE);
    let outer = points.boundary_normals();
    (points.free.iter_mut())
        .step_by(97)
        .for_each(|free| *free = false);
    let smooth = solve_given(&points, &flat(&points), &outer, sharp());
    let interior_normals = InteriorNormals::Input;
    let input = solve_given(
        &points,
        &flat(&points),
        &outer,
        Options {
            interior_normals,
            ..sharp()
        },
    );
    let paper = SolverKind::Paper(PaperOptions {
        estimate: Estimate::Alternating { iterations: 10 },
        levels: 1,
        max_updates: 100,
        ..PaperOptions::default()
    });
    vec![
        ("fitted normals".to_owned(), Golden::of(&cylinder, &fitted)),
        ("averaged normals".to_owned(), Golden::of(&cylinder, &averaged)),
        ("smooth points inside".to_owned(), Golden::of(&points, &smooth)),
        (
            "points with the input's normals".to_owned(),
            Golden::of(&points, &input),
        ),
        given(
            "paper solver",
            &blend,
            Options {
                solver: paper,
                ..sharp()
            },
        ),
    ]
}

/// The mesh around the region, filled; and the region, triangulated anew.
fn holes() -> Vec<(String, Golden)> {
    let shape = sphere_cap(60.0, 1_000, irregular(10), 4);
    let is_outside = |t: &&[u32; 3]| t.iter().all(|&v| !shape.free[v as usize]);
    let around: Vec<_> = shape.triangles.iter().filter(is_outside).copied().collect();
    let asked = FillOptions {
        fairing: sharp(),
        loops: Loops::UpTo(usize::MAX),
        ..FillOptions::default()
    };
    let filled = fill_holes(&shape.positions, &around, &asked).unwrap();
    let report = filled.loops.iter().min_by_key(|l| l.edges).unwrap();
    let fairing = report.fairing.as_ref().unwrap();
    let new = &filled.positions[report.vertices.start as usize..report.vertices.end as usize];
    let filling = Golden::new(fairing.outcome.name(), fairing.iterations, fairing.diagonal, new);

    let selection = Selection::Mask(&shape.free);
    let coarser = RemeshOptions {
        density: 1.0,
        ..RemeshOptions::default()
    };
    let remeshed = remesh_region(&shape.positions, &shape.triangles, selection, &coarser).unwrap();
    let inside = remeshed.free.iter().map(|&v| remeshed.positions[v as usize]);
    let inside: Vec<_> = inside.collect();
    vec![
        ("filling".to_owned(), filling),
        (
            "new triangulation".to_owned(),
            Golden::new("none", 0, 2.0, &inside),
        ),
    ]
}

#[test]
fn results_are_the_stored_ones() {
    let found: Vec<_> = [surfaces(), choices(), normals(), holes()]
        .into_iter()
        .flatten()
        .collect();
    if std::env::var_os("FAIRMESH_WRITE_GOLDEN").is_some() {
        let lines: String = found
            .iter()
            .map(|(name, golden)| golden.line(name) + "\n")
            .collect();
        return fs::write(FILE, lines).unwrap();
    }
    let table = fs::read_to_string(FILE).unwrap();
    assert_eq!(table.lines().count(), found.len());
    let mut bars = Bars::default();
    for (line, (name, now)) in table.lines().zip(&found) {
        let (stored_name, stored) = line.split_once(": ").unwrap();
        let stored = Golden::read(stored);
        assert_eq!(stored_name, name);
        println!("{}", now.line(name));
        let ends = |g: &Golden| format!("{}, {} vertices", g.outcome, g.vertices);
        let differ = now.iterations.abs_diff(stored.iterations);
        bars.check(
            name,
            ends(now) == ends(&stored) && differ <= ITERATIONS,
            format!(
                "{} after {}, was {} after {}",
                ends(now),
                now.iterations,
                ends(&stored),
                stored.iterations
            ),
        );
        let near = match now.outcome.as_str() {
            "converged" | "none" => NEAR,
            _ => NEAR_ON_THE_WAY,
        };
        let off = now
            .coordinates
            .iter()
            .zip(stored.coordinates)
            .map(|(a, b)| (a - b).abs());
        bars.at_most(name, off.fold(0.0, f64::max) / stored.diagonal, near);
    }
    bars.finish();
}
