//! Accuracy, times, holes and known shortfalls: writes `docs/measurements.md`, which `tests/docs.rs` compares with one
//! seed of its rows.

use std::fmt::{Display, Write};
use std::fs;
use std::io;
use std::ops::RangeInclusive;

use fairmesh_shapes::{HarmonicProfile, Surface, Unduloid};
use nalgebra::Vector3;

use crate::tool::{Case, Run, Tool};

/// Triangulations of every row about accuracy.
const SEEDS: RangeInclusive<u64> = 1..=8;
/// Free vertices of the rows about accuracy.
pub(crate) const SIZES: [usize; 2] = [1_000, 13_000];
/// The surfaces of the rows about accuracy, as `fairmesh generate` calls them.
pub(crate) const KINDS: [&str; 5] = ["sphere-cap", "cylinder", "catenoid", "unduloid", "revolution"];

/// What is measured on one triangulation.
pub(crate) struct Solve {
    /// Largest distance of a free vertex to the exact surface, in diagonals of the region.
    pub(crate) error: f64,
    /// Iterations to the default tolerance.
    pub(crate) iterations: usize,
    converged: bool,
}

/// The whole document.
pub(crate) fn document(tool: &Tool, machine: &str) -> io::Result<String> {
    let mut text = format!(
        "# Measurements\n\n\
        Written by\n\n```sh\n./reproduce.sh measurements\n```\n\n\
        No number in the tables is typed. Machine of this run: {machine}. See [peers.md](peers.md) for other programs,\n\
        [REPRODUCTION.md](../REPRODUCTION.md) for the paper's figures.\n\n"
    );
    for section in [accuracy, times, holes, one_hole, tilted_normals] {
        section(tool, &mut text)?;
    }
    Ok(text.trim_end().to_owned() + "\n")
}

fn exact(kind: &str) -> io::Result<Surface> {
    Ok(match kind {
        "cylinder" => Surface::Cylinder,
        "catenoid" => Surface::Catenoid,
        "unduloid" => Surface::Unduloid(Unduloid::new(0.7, 1.0)),
        // As `fairmesh generate` makes it where nothing else is said: mean curvature varies.
        "revolution" => {
            Surface::Revolution(HarmonicProfile::new(1.0, -1.0, 0.5, 2.0).map_err(io::Error::other)?)
        }
        _ => Surface::Sphere,
    })
}

/// An irregular triangulation with a random interior, faired with exact or fitted boundary normals.
pub(crate) fn solve(tool: &Tool, kind: &str, n: usize, seed: u64, exact_normals: bool) -> io::Result<Solve> {
    let (count, seed) = (n.to_string(), seed.to_string());
    let how = ["--triangulation", "irregular", "--start", "random"];
    let arguments = [&[kind, "--vertices", &count, "--seed", &seed], &how[..]].concat();
    let mut case = tool.generate(&format!("{kind}-{n}-{seed}"), &arguments)?;
    if !exact_normals {
        case.normals_file = None;
    }
    let run = tool.fair(&case, "fair", &[])?;
    let (surface, diagonal) = (exact(kind)?, run.number(&["diagonal"]));
    let distance = |&v: &u32| surface.distance(run.positions[v as usize]) / diagonal;
    Ok(Solve {
        error: case.free.iter().map(distance).fold(0.0, f64::max),
        iterations: run.iterations(),
        converged: run.outcome() == "converged",
    })
}

fn accuracy(tool: &Tool, text: &mut String) -> io::Result<()> {
    *text += "## Accuracy\n\n\
        Irregular triangulations (vertices shaken, dropped and inserted, valences from 3 to about 11), with a random interior. The error\n\
        is the largest distance of a free vertex to the exact surface over the region's diagonal, from the best to the worst of eight\n\
        seeds. Boundary normals are exact, or fitted to four rings of triangles around the region.\n\n\
        | surface | free vertices | boundary normals | largest error | iterations | converged |\n\
        |---|---|---|---|---|---|\n";
    for kind in KINDS {
        for n in SIZES {
            for (normals, given) in [("exact", true), ("fitted", false)] {
                let solves = SEEDS.map(|seed| solve(tool, kind, n, seed, given));
                let solves = solves.collect::<io::Result<Vec<Solve>>>()?;
                let _ = writeln!(
                    text,
                    "| {kind} | {n} | {normals} | {} | {} | {} of {} |",
                    span(solves.iter().map(|s| s.error), |e| format!("{e:.1e}")),
                    span(solves.iter().map(|s| s.iterations), display),
                    solves.iter().filter(|s| s.converged).count(),
                    solves.len()
                );
            }
        }
    }
    text.push('\n');
    Ok(())
}

fn times(tool: &Tool, text: &mut String) -> io::Result<()> {
    *text += "## Times\n\n\
        The irregular sphere cap as above, exact normals: seconds of the solve, the quickest of three runs.\n\n\
        | free vertices | one thread | two threads | iterations |\n\
        |---|---|---|---|\n";
    for n in [1_000, 13_000, 100_000] {
        let count = n.to_string();
        let arguments = [
            "sphere-cap",
            "--vertices",
            &count,
            "--triangulation",
            "irregular",
            "--start",
            "random",
        ];
        let case = tool.generate(&format!("time-{n}"), &arguments)?;
        let run = |threads| {
            tool.timed(&case, "fair", &["--threads", threads], 3)
                .map(|(run, _)| run)
        };
        let (one, two) = (run("1")?, run("2")?);
        let _ = writeln!(
            text,
            "| {n} | {:.3} | {:.3} | {} |",
            one.seconds(),
            two.seconds(),
            one.iterations()
        );
    }
    text.push('\n');
    Ok(())
}

/// The unit sphere without a cap, filled; and the largest distance of a new vertex from the sphere.
pub(crate) fn fill(tool: &Tool, n: usize, seed: u64) -> io::Result<(Run, f64)> {
    let (count, seed) = (n.to_string(), seed.to_string());
    let arguments = ["sphere-hole", "--vertices", &count, "--seed", &seed];
    let how = ["--triangulation", "irregular", "--outside", "1"];
    let case = tool.generate(&format!("hole-{n}-{seed}"), &[&arguments, &how[..]].concat())?;
    let run = tool.fill(&case, "fill", &["--threads", "1"])?;
    let off = |p: &[f64; 3]| (Vector3::from(*p).norm() - 1.0).abs();
    let new = run.positions[case.positions.len()..].iter();
    let worst = new.map(off).fold(0.0, f64::max);
    Ok((run, worst))
}

fn holes(tool: &Tool, text: &mut String) -> io::Result<()> {
    *text += "## Holes\n\n\
        The irregular unit sphere without a cap of 60 degrees half-angle, no normals given, default density, one thread; three seeds.\n\n\
        | vertices | new vertices | off the sphere | seconds |\n\
        |---|---|---|---|\n";
    for n in [13_000, 30_000, 100_000] {
        let fills = (1..=3)
            .map(|seed| fill(tool, n, seed))
            .collect::<io::Result<Vec<_>>>()?;
        let _ = writeln!(
            text,
            "| {n} | {} | {} | {} |",
            span(
                fills.iter().map(|(run, _)| run.number(&["new_vertices"])),
                display
            ),
            span(fills.iter().map(|(_, off)| *off), |off| format!("{off:.1e}")),
            span(fills.iter().map(|(run, _)| run.seconds()), |s| format!("{s:.2}")),
        );
    }
    text.push('\n');
    Ok(())
}

fn one_hole(tool: &Tool, text: &mut String) -> io::Result<()> {
    *text += "## A sphere from what is around one hole\n\n\
        All of the unit sphere is free but four rings inside a hole; ten irregular triangulations.\n\n\
        | half-angle of the hole | free vertices | completed | largest error of these |\n\
        |---|---|---|---|\n";
    for angle in ["45", "30", "20"] {
        for n in ["1000", "5000"] {
            let mut errors = Vec::new();
            for seed in 1..=10 {
                let seed = seed.to_string();
                let arguments = ["sphere-hole", "--angle", angle, "--vertices", n, "--seed", &seed];
                let how = ["--triangulation", "irregular", "--start", "flat"];
                let name = format!("one-hole-{angle}-{n}-{seed}");
                let case = tool.generate(&name, &[&arguments, &how[..]].concat())?;
                let run = tool.fair(&case, "fair", &[])?;
                if run.outcome() == "converged" {
                    let off = |&v: &u32| (Vector3::from(run.positions[v as usize]).norm() - 1.0).abs();
                    let worst = case.free.iter().map(off).fold(0.0, f64::max);
                    errors.push(worst / run.number(&["diagonal"]));
                }
            }
            let worst = match errors.iter().copied().reduce(f64::max) {
                Some(worst) => format!("{worst:.1e}"),
                None => "-".to_owned(),
            };
            let _ = writeln!(text, "| {angle} | {n} | {} of 10 | {worst} |", errors.len());
        }
    }
    text.push('\n');
    Ok(())
}

fn tilted_normals(tool: &Tool, text: &mut String) -> io::Result<()> {
    *text += "## The blend with tilted normals\n\n\
        The normals at the ends of the three tubes are tilted outward, so that the tubes narrow towards their ends, or inward, so that\n\
        they widen.\n\n\
        | vertices | tilt | degrees that converge, of 5, 10, ..., 60 |\n\
        |---|---|---|\n";
    for n in ["920", "13308"] {
        let mut case = tool.generate(&format!("tilt-{n}"), &["cylinder-blend", "--vertices", n])?;
        for (direction, sign) in [("outward", 1.0), ("inward", -1.0)] {
            let mut last = 0;
            for degrees in (5..=60).step_by(5) {
                let given = tilted(&case, sign * f64::from(degrees).to_radians())?;
                case.normals_file = Some(tool.work.join("tilted.txt"));
                fs::write(tool.work.join("tilted.txt"), given)?;
                let converged = tool.fair(&case, "tilted", &[])?.outcome() == "converged";
                case.normals_file = Some(tool.work.join(format!("{}.normals.txt", case.name)));
                if !converged {
                    break;
                }
                last = degrees;
            }
            let _ = writeln!(text, "| {n} | {direction} | up to {last} |");
        }
    }
    text.push('\n');
    Ok(())
}

/// The file of normals with every normal turned towards its tube's axis, which points away from the middle.
fn tilted(case: &Case, angle: f64) -> io::Result<String> {
    let path = case.normals_file.as_ref().ok_or(io::ErrorKind::NotFound)?;
    let mut given = Vec::new();
    for line in fs::read_to_string(path)?.lines() {
        let words: Vec<f64> = line.split_whitespace().filter_map(|w| w.parse().ok()).collect();
        let [v, x, y, z] = words[..] else {
            continue;
        };
        let v = v as usize;
        given.push((v, Vector3::from(case.positions[v]), Vector3::new(x, y, z)));
    }
    let mut text = String::new();
    for (v, p, n) in &given {
        // Normals of neighbours on one circle span its plane.
        let others = given.iter().filter(|(w, ..)| w != v);
        let nearest = others.min_by(|a, b| (a.1 - p).norm().total_cmp(&(b.1 - p).norm()));
        let Some((_, _, beside)) = nearest else {
            continue;
        };
        let axis = n.cross(beside).normalize();
        let axis = axis * axis.dot(p).signum();
        let t = n * angle.cos() + axis * angle.sin();
        let _ = writeln!(text, "{v} {} {} {}", t.x, t.y, t.z);
    }
    Ok(text)
}

fn display(x: impl Display) -> String {
    x.to_string()
}

/// The least and the greatest, or the one that all are.
fn span<T: PartialOrd + Copy>(all: impl Iterator<Item = T>, shown: impl Fn(T) -> String) -> String {
    let all: Vec<T> = all.collect();
    let least = all.iter().copied().reduce(|a, b| if b < a { b } else { a });
    let greatest = all.iter().copied().reduce(|a, b| if b > a { b } else { a });
    match (least.map(&shown), greatest.map(&shown)) {
        (Some(least), Some(greatest)) if least != greatest => format!("{least} to {greatest}"),
        (Some(one), _) => one,
        _ => "-".to_owned(),
    }
}
