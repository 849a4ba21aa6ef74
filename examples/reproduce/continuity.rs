//! Curvature continuity beside tangent continuity and the linear surfaces of other programs: writes `docs/g2.md` and its pictures.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use fairmesh_shapes::{Sampling, Shape, Surface, ellipsoid_cap, torus_patch};
use serde_json::Value;

use crate::boundary::{Boundary, Shown};
use crate::measure::Distance;
use crate::tool::{Case, Tool, read_ply};
use crate::{Scan, short};

const IRREGULAR: Sampling = Sampling::Irregular { seed: 7 };
/// Rings of triangles around generated regions.
const AROUND: usize = 10;
/// What is asked for in the tables.
const ASKED: [(&str, &str); 3] = [("G1", "g1"), ("continuity 0.5", "0.5"), ("G2", "g2")];
/// Noise of the surroundings, in edge lengths.
const NOISE: [f64; 4] = [0.0, 0.003, 0.01, 0.03];

/// The other programs.
pub struct Peers {
    /// With libigl, numpy and scipy.
    pub python: PathBuf,
    /// `benches/continuity_peers.py`.
    pub script: PathBuf,
}

/// A surface to be compared.
struct Made {
    name: String,
    file: PathBuf,
    positions: Vec<[f64; 3]>,
    /// How much of the way was reached, loop by loop; of this program's surfaces alone.
    reached: Vec<f64>,
    iterations: Option<usize>,
    seconds: f64,
}

/// What is faired, and how it is shown.
struct Subject<'a> {
    title: &'a str,
    what: String,
    /// The stem of its files.
    stem: &'a str,
    case: Case,
    surface: Option<Surface>,
    view: &'a str,
}

/// The whole document.
pub fn document(tool: &Tool, peers: Option<&Peers>, scans: &[Scan], machine: &str) -> io::Result<String> {
    let mut text = format!("{HEAD}Machine of this run: {machine}.\n\n{WHAT}");
    let ellipsoid = ellipsoid_cap([1.0, 0.8, 0.6], 50.0, 4_000, IRREGULAR, AROUND);
    let torus = torus_patch(1.0, 0.4, 1.0, 4_000, IRREGULAR, AROUND);
    let mut subjects = vec![
        of_shape(
            tool,
            &ellipsoid,
            ("A cap of an ellipsoid", "g2-ellipsoid", "0.6,-0.7,0.75"),
            "Semi-axes 1, 0.8, 0.6; the image of the cap of 50 degrees of a sphere is free.",
        )?,
        of_shape(
            tool,
            &torus,
            ("A patch of a torus", "g2-torus", "1,-0.5,0.6"),
            "Radii 1 and 0.4, on the outer side; both angles below one radian are free.",
        )?,
        rod_in_ball(tool)?,
    ];
    for (k, scan) in scans.iter().enumerate() {
        subjects.extend(of_scan(tool, peers, scan, k)?);
    }
    for subject in &subjects {
        text += &section(tool, peers, subject)?;
    }
    overview(tool, &subjects[0])?;
    text += &sizes(tool)?;
    text += &noise(tool)?;
    text += TAIL;
    Ok(text)
}

fn of_shape<'a>(
    tool: &Tool,
    shape: &Shape,
    (title, stem, view): (&'a str, &'a str, &'a str),
    what: &str,
) -> io::Result<Subject<'a>> {
    let case = tool.put(stem, &shape.positions, &shape.triangles, &shape.free_vertices())?;
    let what = format!(
        "{what} {} free vertices, irregular triangulation.",
        case.free.len()
    );
    Ok(Subject {
        title,
        what,
        stem,
        case,
        surface: shape.surface.clone(),
        view,
    })
}

/// Rows of vertices around an axis: a ball of radius 1, a rod of radius 0.4 that stands a little off its centre, and a cone between, which is free.
fn rod_in_ball(tool: &Tool) -> io::Result<Subject<'static>> {
    const COUNT: usize = 90;
    const ROD: f64 = 0.4;
    let height = |radius: f64| 0.5 * 3f64.sqrt() * TAU * radius / COUNT as f64;
    let (mut rows, mut is_free) = (Vec::new(), Vec::new());
    // Radius, height and offset of the axis of each row.
    let end = 55f64.to_radians();
    let mut angle = end;
    while angle < 0.6 * PI {
        rows.push([angle.sin(), angle.cos(), 0.0]);
        is_free.push(false);
        angle += height(angle.sin());
    }
    rows.reverse();
    let (from, to) = ([end.sin(), end.cos(), 0.0], [ROD, 1.5, 0.2]);
    let length = (from[0] - to[0]).hypot(from[1] - to[1]);
    let mut parts = vec![0.0];
    while parts[parts.len() - 1] < 1.0 {
        let t: f64 = parts[parts.len() - 1];
        parts.push(t + height(from[0] + t * (to[0] - from[0])) / length);
    }
    let last = parts[parts.len() - 1];
    for t in parts[1..parts.len() - 1].iter().map(|t| t / last) {
        rows.push([0, 1, 2].map(|k: usize| from[k] + t * (to[k] - from[k])));
        is_free.push(true);
    }
    for k in 0..16 {
        rows.push([ROD, to[1] + k as f64 * height(ROD), to[2]]);
        is_free.push(false);
    }
    let mut positions = Vec::new();
    for (i, [radius, z, offset]) in rows.iter().enumerate() {
        for k in 0..COUNT {
            let (sin, cos) = (TAU * (k as f64 + 0.5 * (i % 2) as f64) / COUNT as f64).sin_cos();
            positions.push([offset + radius * cos, radius * sin, *z]);
        }
    }
    let vertex = |i: usize, k: usize| (i * COUNT + k % COUNT) as u32;
    let mut triangles = Vec::new();
    for i in 0..rows.len() - 1 {
        for k in 0..COUNT {
            let [low, high] = [i, i + 1].map(|row| [vertex(row, k), vertex(row, k + 1)]);
            if i % 2 == 0 {
                triangles.extend([[low[0], low[1], high[0]], [high[0], low[1], high[1]]]);
            } else {
                triangles.extend([[low[0], high[1], high[0]], [low[0], low[1], high[1]]]);
            }
        }
    }
    let free: Vec<u32> = (0..positions.len() as u32)
        .filter(|&v| is_free[v as usize / COUNT])
        .collect();
    let case = tool.put("g2-blend", &positions, &triangles, &free)?;
    let what = format!(
        "A rod of radius 0.4 on a ball of radius 1, a little off its centre, joined by a cone whose {} vertices are free. Two loops.",
        free.len()
    );
    Ok(Subject {
        title: "A blend of given surfaces",
        what,
        stem: "g2-blend",
        case,
        surface: None,
        view: "0.5,-1,0.35",
    })
}

/// A mesh of somebody else's, where there is a Python to read it.
fn of_scan<'a>(
    tool: &Tool,
    peers: Option<&Peers>,
    scan: &'a Scan,
    number: usize,
) -> io::Result<Option<Subject<'a>>> {
    let Some(peers) = peers else { return Ok(None) };
    let file = tool.work.join(format!("g2-scan{number}.ply"));
    let converting = Command::new(&peers.python)
        .arg(&peers.script)
        .arg("--convert")
        .args([&scan.mesh, &file])
        .status()?;
    if !converting.success() {
        return Err(io::Error::other(format!(
            "{} cannot be read",
            scan.mesh.display()
        )));
    }
    let stem = ["g2-scan0", "g2-scan1", "g2-scan2"][number.min(2)];
    let case = tool.read(stem, &file, &scan.free)?;
    Ok(Some(Subject {
        title: &scan.name,
        what: format!("{} free vertices.", case.free.len()),
        stem,
        case,
        surface: None,
        view: &scan.view,
    }))
}

/// The surface of this program.
fn faired(tool: &Tool, case: &Case, name: &str, continuity: &str) -> io::Result<Made> {
    let asked = ["--continuity", continuity, "--threads", "1"];
    let run = tool.fair(case, continuity, &asked)?;
    Ok(Made {
        name: name.to_owned(),
        file: run.file.clone(),
        reached: run.of_loops("reached"),
        iterations: Some(run.iterations()),
        seconds: run.seconds(),
        positions: run.positions,
    })
}

/// Those of the other programs.
fn of_peers(tool: &Tool, peers: &Peers, case: &Case) -> io::Result<Vec<Made>> {
    let output = Command::new(&peers.python)
        .arg(&peers.script)
        .args([&case.file, &case.free_file, &tool.work.join(&case.name)])
        .output()?;
    if !output.status.success() {
        let why = String::from_utf8_lossy(&output.stderr).into_owned();
        return Err(io::Error::other(why));
    }
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let made = text.lines().map(|line| {
        let told: Value = serde_json::from_str(line).map_err(io::Error::other)?;
        let file = PathBuf::from(told["file"].as_str().unwrap_or_default());
        Ok(Made {
            name: told["name"].as_str().unwrap_or("?").to_owned(),
            positions: read_ply(&file)?.0,
            file,
            reached: Vec::new(),
            iterations: None,
            seconds: told["seconds"].as_f64().unwrap_or(f64::NAN),
        })
    });
    made.collect()
}

/// Table and picture of one subject.
fn section(tool: &Tool, peers: Option<&Peers>, subject: &Subject<'_>) -> io::Result<String> {
    let case = &subject.case;
    let boundary = Boundary::new(case)?;
    let mut all = match peers {
        Some(peers) => of_peers(tool, peers, case)?,
        None => Vec::new(),
    };
    for (name, continuity) in ASKED {
        all.push(faired(tool, case, name, continuity)?);
    }
    let mut text = format!("## {}\n\n{}\n\n", subject.title, subject.what);
    text += &picture(tool, subject, &all)?;
    text += "\n| surface | rms error | jump of H, rms | largest | reached | deviation of normals | iterations | seconds |\n\
        |---|---|---|---|---|---|---|---|\n";
    if subject.surface.is_some() {
        let shown = boundary.shown(case, &case.positions)?;
        let _ = writeln!(text, "| the exact one | 0 | {} | | |", shown_cells(&shown, ""));
    }
    for made in &all {
        let shown = boundary.shown(case, &made.positions)?;
        let error = subject.surface.as_ref().map_or_else(String::new, |surface| {
            short(error(case, surface, &made.positions))
        });
        let reached: Vec<String> = made.reached.iter().map(|r| format!("{r:.2}")).collect();
        let iterations = made.iterations.map_or_else(String::new, |n| n.to_string());
        let _ = writeln!(
            text,
            "| {} | {error} | {} | {iterations} | {:.2} |",
            made.name,
            shown_cells(&shown, &reached.join(", ")),
            made.seconds
        );
    }
    text.push('\n');
    Ok(text)
}

fn shown_cells(shown: &Shown, reached: &str) -> String {
    let [rms, largest] = shown.jump.map(|j| format!("{j:.3}"));
    format!("{rms} | {largest} | {reached} | {:.1}", shown.deviation)
}

/// Root mean square of the distances of the free vertices, over the diagonal of what is free.
fn error(case: &Case, surface: &Surface, positions: &[[f64; 3]]) -> f64 {
    let region: Vec<[f64; 3]> = case.free.iter().map(|&v| case.positions[v as usize]).collect();
    let distances = case.free.iter().map(|&v| surface.distance(positions[v as usize]));
    Distance::of(distances).rms / crate::measure::diagonal(&region)
}

/// Mean curvature and reflections of some of the surfaces.
fn picture(tool: &Tool, subject: &Subject<'_>, all: &[Made]) -> io::Result<String> {
    let shown = all.iter().filter(|made| {
        let name = made.name.as_str();
        name.contains("k = 3") || made.iterations.is_some()
    });
    let meshes: Vec<(&Path, &str)> = shown
        .map(|made| (made.file.as_path(), made.name.as_str()))
        .collect();
    let free = subject.case.free_file.display().to_string();
    let (view, up) = subject.view.split_once('/').unwrap_or((subject.view, "0,0,1"));
    let mut arguments = vec!["--view", view, "--up", up, "--shade", "curvature,reflection"];
    arguments.extend(["--size", "240x220"]);
    // Of somebody else's mesh only what is faired.
    if subject.stem.contains("scan") {
        arguments.extend(["--around", &free]);
    }
    let name = subject.stem.trim_start_matches("g2-");
    tool.render(&format!("{name}.png"), subject.title, &meshes, &arguments)?;
    Ok(format!(
        "![{}: mean curvature above, reflection lines below](g2/{name}.png)\n",
        subject.title
    ))
}

/// What the pages of other hosts show: one surface with tangent planes alone, and with continuous curvature.
fn overview(tool: &Tool, subject: &Subject<'_>) -> io::Result<()> {
    let [tangent, curved] = [("G1", "g1"), ("G2", "g2")].map(|(n, c)| faired(tool, &subject.case, n, c));
    let (tangent, curved) = (tangent?, curved?);
    let meshes = [
        (&*tangent.file, "continuity 0 (G1)"),
        (&*curved.file, "continuity 1 (G2)"),
    ];
    let arguments = [
        "--view",
        subject.view,
        "--shade",
        "curvature",
        "--size",
        "300x260",
    ];
    tool.render("g1-g2.png", "", &meshes, &arguments)?;
    Ok(())
}

/// Errors and jumps by size.
fn sizes(tool: &Tool) -> io::Result<String> {
    let mut text = String::from(
        "## By size\n\nThe same two surfaces, G1 and G2.\n\n\
        | surface | free vertices | rms error | jump of H, rms | reached | iterations | seconds |\n\
        |---|---|---|---|---|---|---|\n",
    );
    for n in [1_000, 4_000, 13_000, 50_000] {
        let shapes = [
            (
                "ellipsoid",
                ellipsoid_cap([1.0, 0.8, 0.6], 50.0, n, IRREGULAR, AROUND),
            ),
            ("torus", torus_patch(1.0, 0.4, 1.0, n, IRREGULAR, AROUND)),
        ];
        for (name, shape) in shapes {
            let Some(surface) = &shape.surface else { continue };
            let stem = format!("g2-{name}-{n}");
            let case = tool.put(&stem, &shape.positions, &shape.triangles, &shape.free_vertices())?;
            let boundary = Boundary::new(&case)?;
            let [tangent, curved] = [("G1", "g1"), ("G2", "g2")].map(|(n, c)| faired(tool, &case, n, c));
            let (tangent, curved) = (tangent?, curved?);
            let errors = [&tangent, &curved].map(|made| short(error(&case, surface, &made.positions)));
            let jump = |made: &Made| boundary.shown(&case, &made.positions).map(|shown| shown.jump[0]);
            let count = |made: &Made| made.iterations.unwrap_or_default();
            let _ = writeln!(
                text,
                "| {name} | {} | {} → {} | {:.3} → {:.3} | {} | {} → {} | {:.2} → {:.2} |",
                case.free.len(),
                errors[0],
                errors[1],
                jump(&tangent)?,
                jump(&curved)?,
                list(&curved.reached),
                count(&tangent),
                count(&curved),
                tangent.seconds,
                curved.seconds
            );
        }
    }
    text.push('\n');
    Ok(text)
}

fn list(reached: &[f64]) -> String {
    let all: Vec<String> = reached.iter().map(|r| format!("{r:.2}")).collect();
    all.join(", ")
}

/// What becomes of it where the surroundings are noisy.
fn noise(tool: &Tool) -> io::Result<String> {
    let mut text = String::from(
        "## Noisy surroundings\n\nThe cap of the ellipsoid with 4,000 free vertices; its surroundings are moved at random (standard deviation in edge lengths).\n\n\
        | noise | rms error, G1 | G2 | reached |\n|---|---|---|---|\n",
    );
    let shape = ellipsoid_cap([1.0, 0.8, 0.6], 50.0, 4_000, IRREGULAR, AROUND);
    let Some(surface) = &shape.surface else {
        return Ok(String::new());
    };
    for (k, size) in NOISE.into_iter().enumerate() {
        let mut all = shape.clone();
        all.free.fill(true);
        let moved = all.noise(3, size);
        let pairs = shape.positions.iter().zip(moved).zip(&shape.free);
        let positions: Vec<[f64; 3]> = pairs.map(|((p, q), free)| if *free { *p } else { q }).collect();
        let case = tool.put(
            &format!("g2-noise{k}"),
            &positions,
            &shape.triangles,
            &shape.free_vertices(),
        )?;
        let [tangent, curved] = [("G1", "g1"), ("G2", "g2")].map(|(n, c)| faired(tool, &case, n, c));
        let (tangent, curved) = (tangent?, curved?);
        let [before, after] = [&tangent, &curved].map(|made| short(error(&case, surface, &made.positions)));
        let _ = writeln!(
            text,
            "| {size} | {before} | {after} | {} |",
            list(&curved.reached)
        );
    }
    text.push('\n');
    Ok(text)
}

const HEAD: &str = "# Continuous curvature (G2)\n\nWritten by\n\n```sh\n./reproduce.sh continuity\n```\n\n\
    No number in the tables is typed; `--scan` gives other meshes. ";

const WHAT: &str = r#"By default a faired surface has the tangent planes of its surroundings, and its own mean curvature H: it solves Δ<sub>B</sub>H = 0. A jump of H to the surroundings
shows as kinks in reflection lines. `--continuity g2` (`continuity` in every host, from 0 to 1) takes H of the surroundings as one more condition:

Δ<sub>B</sub><sup>2</sup>H = 0, with positions, normals and H = H\* along the boundary.

- **H\*** is fitted to three to eight rings of triangles outside, whichever is most certain along the loop; or given (`--boundary-curvature`: a file with a vertex
  and H in each line).
- **A number between 0 and 1** goes part of the way from the G1 surface's own H to H\*. `--continuity-at VERTEX=NUMBER` sets it for the loop through a vertex. `fill`
  takes these options, too.
- **`reached`** in the report says for each loop how much of the way was gone, in the mean: what is not certain is left out. `uncertainty` is the standard error of H\*; `jump_before` and `jump` are the jumps of H without and with it.

**When to use it**: for visible surfaces whose surroundings are smooth for some ten edges beyond the boundary: subdivision surfaces, CAD surfaces, smoothed scans. It
takes 1.5 to 3 times as long as G1.

**When it stays with G1**, and says so by a small `reached`: where H\* is no more certain than the jump is large (rough scans, creases, fewer than eight vertices on
the loop, no triangles outside), where the jump is only the discretization's error (spheres, cylinders, minimal surfaces), and where the surface would be less sound
than the G1 one: fold triangles, have a crease, or deviate from the boundary's normals by over half a degree and a tenth more. So coarse meshes get less of the way. Beside
another component, and along a curve of fixed vertices with normals, only a given curvature is continued.

In the tables only the mesh is given. Errors are distances of the free vertices over the diagonal of what is free. Jumps are over the root mean square of H outside; H
at the vertices two to four edges from the boundary (`fairmesh::mean_curvature`) is extrapolated to it linearly from both sides. The deviation is the largest angle, in
degrees, between the mean normal of the region's triangles at a boundary vertex and the normal fitted to its surroundings. Seconds are of one thread: the nonlinear
solve, and the one linear solve of the others, which see only the fixed vertices' positions.

"#;

const TAIL: &str = r#"## What the others do

`igl::harmonic` with k = 3 and CGAL's `fair` with continuity 2 solve Δ³x = 0, coordinate by coordinate, with the Laplacian of the given mesh. That is linear and
quick, but it knows normals and curvatures only from a few rows of fixed vertices, and with the same boundary another triangulation gives another surface. They
continue noise, too: with rough surroundings their jump may be the smaller one. MeshLib and Blender end at tangent continuity.
"#;
