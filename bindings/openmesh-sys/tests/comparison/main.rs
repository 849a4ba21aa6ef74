//! OpenMesh's smoother and fairmesh on surfaces that are known: what docs/openmesh.md says holds in any one run. Its tables are
//! what `cargo test --release -p openmesh-sys --test comparison -- --include-ignored --nocapture` prints.
#![allow(unreachable_pub, reason = "nothing of a test is reachable from outside")]
#![allow(clippy::print_stdout, reason = "the tables, for --nocapture")]

mod case;
mod smoother;
mod stationary;

use case::{Case, ITERATIONS, Measured, SURFACES, cases};
use fairmesh_shapes::{OUTSIDE, Sampling, sphere_cap};
use smoother::Smoother;
use stationary::stationary;

/// A case with all that is measured on it.
struct Row {
    case: Case,
    smoother: Vec<Measured>,
    limit: Measured,
    ours: Measured,
}

impl Row {
    fn new(case: Case) -> Self {
        Self {
            smoother: ITERATIONS.map(|n| case.smoothed(n)).into(),
            limit: case.limit(),
            ours: case.ours(),
            case,
        }
    }
}

/// Prints rows, each the case and its cells.
fn print_table<'a>(heading: &str, columns: &str, rows: impl Iterator<Item = (&'a Case, String)>) {
    let rule = "---|".repeat(2 + columns.split(" | ").count());
    println!("\n## {heading}\n\n| surface | triangulation | {columns} |\n|{rule}");
    for (case, cells) in rows {
        println!("| {} | {} | {cells} |", case.surface, case.triangulation);
    }
}

/// Prints a run of the smoother and one of fairmesh for each case.
fn print_times<'a>(heading: &str, runs: impl Iterator<Item = (&'a Case, &'a Measured, &'a Measured)>) {
    const COLUMNS: &str = "smoother, 10,000 | seconds | fairmesh | seconds | times sooner";
    let cells = |m: &Measured| format!("{:.1e} | {:.3}", m.rms, m.seconds);
    let rows = runs.map(|(case, theirs, ours)| {
        let sooner = theirs.seconds / ours.seconds;
        (case, format!("{} | {} | {sooner:.0}", cells(theirs), cells(ours)))
    });
    print_table(heading, COLUMNS, rows);
}

fn print_tables(rows: &[Row]) {
    const COLUMNS: &str = "smoother, 100 | 1,000 | 10,000 | in the limit | fairmesh";
    let cells = |row: &Row, cell: fn(&Measured) -> String| {
        let runs = row.smoother.iter().chain([&row.limit, &row.ours]);
        runs.map(cell).collect::<Vec<_>>().join(" | ")
    };
    let distances = rows.iter().map(|row| {
        (
            &row.case,
            cells(row, |m| format!("{:.1e} ({:.1e})", m.rms, m.max)),
        )
    });
    print_table(
        "Distance to the exact surface, about 1000 free vertices",
        COLUMNS,
        distances,
    );
    let normals = rows.iter().map(|row| {
        let all = cells(row, |m| format!("{:.2}", m.normals));
        (&row.case, format!("{all} | {:.2}", row.case.exact().normals))
    });
    print_table("Boundary normals", &format!("{COLUMNS} | exact mesh"), normals);
}

/// On every surface and triangulation, seeing the same arrays: closer by far.
#[test]
fn ours_is_closer() {
    let rows: Vec<Row> = SURFACES
        .iter()
        .flat_map(|s| cases(s, 1_000))
        .map(Row::new)
        .collect();
    print_tables(&rows);
    let mut missed = Vec::new();
    for row in &rows {
        let what = format!("{}, {}", row.case.surface, row.case.triangulation);
        let bar = if row.case.surface == "sphere" {
            1_000.0
        } else {
            20.0
        };
        // Where the smoother would end is closer than where it is; on a lattice that is conformal, as the regular
        // catenoid's, the linear equations are nearly right.
        let runs = row
            .smoother
            .iter()
            .map(|run| (run, bar))
            .chain([(&row.limit, 1.0)]);
        for (run, bar) in runs {
            for (measure, ratio) in [
                ("largest", run.max / row.ours.max),
                ("rms", run.rms / row.ours.rms),
            ] {
                if ratio.is_nan() || ratio < bar {
                    missed.push(format!("{what}: {measure} distance: {ratio:.1} times closer"));
                }
            }
        }
        if !row.ours.converged {
            missed.push(format!("{what}: not converged"));
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}

mod long {
    use super::*;

    /// The irregular ones of another size, after most iterations.
    #[test]
    #[ignore = "half a minute, for docs/openmesh.md"]
    fn ours_is_closer_on_large_meshes() {
        let runs = SURFACES.map(|surface| {
            let [_, case, _] = cases(surface, 10_000);
            (case.smoothed(ITERATIONS[2]), case.ours(), case)
        });
        let heading = "Times, about 10000 free vertices";
        print_times(
            heading,
            runs.iter().map(|(theirs, ours, case)| (case, theirs, ours)),
        );
        for (theirs, ours, case) in &runs {
            assert!(
                ours.converged && theirs.rms > 1_000.0 * ours.rms,
                "{}",
                case.surface
            );
        }
    }
}

/// The smoother's operator is the square of I - D⁻¹A with equal weights: run until it stands still, it is where a direct
/// solve of that system is.
#[test]
fn the_smoother_ends_where_the_uniform_bilaplacian_vanishes() {
    let distance = |a: &[[f64; 3]], b: &[[f64; 3]]| {
        let apart = a.as_flattened().iter().zip(b.as_flattened());
        apart.map(|(p, q)| (p - q).abs()).fold(0.0, f64::max)
    };
    for seed in 1..4 {
        let shape = sphere_cap(60.0, 60, Sampling::Irregular { seed }, OUTSIDE);
        let direct = stationary(&shape.positions, &shape.triangles, &shape.free);
        let mut mesh = Smoother::new(&shape.flat(), &shape.triangles, &shape.free).unwrap();
        let start = distance(&mesh.positions(), &direct);
        // Till a thousand iterations do nothing but round.
        let mut rounds = 0;
        loop {
            let before = mesh.positions();
            mesh.smooth(1_000);
            rounds += 1;
            if distance(&before, &mesh.positions()) < 1e-14 {
                break;
            }
            assert!(rounds < 1_000, "no end after a million iterations");
        }
        let end = distance(&mesh.positions(), &direct);
        assert!(start > 0.05 && end < 1e-12, "seed {seed}: {end:.1e}");
        // And the sphere is not there.
        let sphere = shape.surface.as_ref().unwrap();
        assert!(direct.iter().any(|p| sphere.distance(*p) > 0.01));
    }
}

#[test]
fn edges_of_three_triangles_are_refused() {
    let positions = [0.0, 1.0, 2.0, 3.0, 4.0].map(|x| [x, 0.0, 0.0]);
    let book = [[0, 1, 2], [1, 0, 3], [0, 1, 4]];
    let why = Smoother::new(&positions, &book, &[true; 5]).err();
    assert_eq!(why.as_deref(), Some("OpenMesh refuses triangle 2"));
}
