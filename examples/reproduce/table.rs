//! Table 1: seconds of the default solver, of the paper's scheme, and of the paper.

use std::fmt::Write;
use std::io;

use crate::measure::to_mesh;
use crate::short;
use crate::tool::Tool;

/// A row: name in the paper, its vertices, base vertices and seconds, and what stands for it here.
struct Row {
    name: &'static str,
    vertices: usize,
    base: usize,
    seconds: f64,
    /// How many times faster the default solver has to be.
    bar: f64,
    kind: &'static str,
}

const ROWS: [Row; 4] = [
    Row {
        name: "Cylinder blend",
        vertices: 920,
        base: 140,
        seconds: 1.9,
        bar: 50.0,
        kind: "cylinder-blend",
    },
    Row {
        name: "Bust face",
        vertices: 2_926,
        base: 256,
        seconds: 12.0,
        bar: 150.0,
        kind: "cylinder-blend",
    },
    Row {
        name: "Human ear",
        vertices: 4_665,
        base: 248,
        seconds: 21.0,
        bar: 150.0,
        kind: "cylinder-blend",
    },
    Row {
        name: "Tetra thing",
        vertices: 13_308,
        base: 308,
        seconds: 57.0,
        bar: 150.0,
        kind: "tetra-thing",
    },
];

/// The section of the document.
pub fn section(tool: &Tool, runs: usize) -> io::Result<String> {
    let with_paper = tool.can("--solver");
    let mut text = String::from(
        "## Table 1: times\n\n\
        Uniform inner fairness, one thread. \"s\" is the wall clock of the solve, the quickest of several runs; \"CPU s\" the mean of the\n\
        whole program with its files, which \"times faster\" is made of. Bust and ear are cylinder blends of that size. The paper's seconds\n\
        (Java 1.3, Pentium III, 500 MHz) do not include making the hierarchy.\n\n\
        | in the paper | here | vertices | triangles | the paper, s | default solver, s | CPU s | iterations | outcome | times faster | at least |\n\
        |---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    let mut paper = String::new();
    let mut all_met = true;
    for row in ROWS {
        let count = row.vertices.to_string();
        let name = format!("table{count}");
        let case = tool.generate(&name, &[row.kind, "--vertices", &count])?;
        // The smaller the mesh, the more runs the system's coarse count of CPU seconds takes.
        let runs = runs * (13_308 / row.vertices).clamp(1, 8);
        let (run, cpu) = tool.timed(&case, "default", &["--threads", "1"], runs)?;
        let cpu = cpu.unwrap_or(run.seconds());
        let faster = row.seconds / cpu;
        all_met &= faster >= row.bar && run.outcome() == "converged";
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {:.4} | {cpu:.4} | {} | {} | {:.0} | {} |",
            row.name,
            row.kind,
            case.positions.len(),
            case.triangles.len(),
            row.seconds,
            run.seconds(),
            run.iterations(),
            run.outcome(),
            faster,
            row.bar
        );
        if with_paper {
            eprintln!("{}: the paper's own scheme", row.name);
            let own = tool.fair(&case, "paper", &["--solver", "paper", "--threads", "1"])?;
            let levels: Vec<String> = own.levels().iter().map(usize::to_string).collect();
            // What has not converged is no surface to compare with.
            let apart = if own.outcome().starts_with("converged") {
                short(to_mesh(&own.positions, &run.positions, &case.triangles).max)
            } else {
                "-".to_owned()
            };
            let _ = writeln!(
                paper,
                "| {} | {} | {} | {} | {:.2} | {} | {} | {} | {} |",
                row.name,
                row.base,
                levels.first().map_or("-", |base| base),
                if levels.is_empty() {
                    "-".to_owned()
                } else {
                    levels.join(", ")
                },
                own.seconds(),
                own.iterations(),
                short(own.number(&["defect"])),
                own.outcome(),
                apart,
            );
        }
    }
    let _ = writeln!(
        text,
        "\nThe default solver is at least that many times faster than the paper's published seconds in every row: **{}**.\n",
        if all_met {
            "confirmed"
        } else {
            "not confirmed in this run"
        }
    );
    if with_paper {
        text += "The paper's own scheme (`--solver paper`), on the same meshes, machine and run:\n\n\
            | | base in the paper | base here | levels | s | updates | harmonic defect | outcome | largest distance to the default's surface |\n\
            |---|---|---|---|---|---|---|---|---|\n";
        text += &paper;
        text.push('\n');
    }
    Ok(text)
}
