//! OpenMesh's smoother and fairmesh on the same meshes: writes `docs/openmesh.md` and `docs/openmesh/*.png`.
//!
//! ```text
//! report FAIRMESH [--vertices N] [--scan NAME MESH FREE-VERTICES VIEW]...
//! ```
//!
//! `FAIRMESH` is the program, which makes the pictures. `./report.sh` builds both. Every number in the document comes
//! from here.
#![allow(clippy::print_stderr, reason = "tells how far it is")]

#[path = "../../comparison/mod.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod comparison;
#[path = "../../../../examples/reproduce/machine.rs"]
mod machine;
mod pictures;

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use comparison::*;
use pictures::Pictures;

type Failure = Box<dyn std::error::Error>;

/// A scan to be shown.
struct Scan {
    name: String,
    mesh: PathBuf,
    free: PathBuf,
    view: String,
}

/// What is asked.
struct Arguments {
    binary: PathBuf,
    vertices: usize,
    scans: Vec<Scan>,
}

fn arguments() -> Option<Arguments> {
    let mut words = std::env::args().skip(1);
    let mut arguments = Arguments {
        binary: words.next()?.into(),
        vertices: 10_000,
        scans: Vec::new(),
    };
    while let Some(word) = words.next() {
        match word.as_str() {
            "--vertices" => arguments.vertices = words.next()?.parse().ok().filter(|n| *n > 100)?,
            "--scan" => arguments.scans.push(Scan {
                name: words.next()?,
                mesh: words.next()?.into(),
                free: words.next()?.into(),
                view: words.next()?,
            }),
            _ => return None,
        }
    }
    Some(arguments)
}

fn main() -> Result<(), Failure> {
    let Some(arguments) = arguments() else {
        return Err("usage: report FAIRMESH [--vertices N] [--scan NAME MESH FREE-VERTICES VIEW]...".into());
    };
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let pictures = Pictures::new(
        arguments.binary.clone(),
        root.join("target/openmesh"),
        root.join("docs/openmesh"),
    )?;
    let mut text = head();
    text += &surfaces(1_000);
    eprintln!("small meshes: done");
    text += &large(arguments.vertices);
    eprintln!("large meshes: done");
    text += &shown(&pictures)?;
    text += &scans(&pictures, &arguments.scans)?;
    text += TAIL;
    let file = root.join("docs/openmesh.md");
    let before = fs::read_to_string(&file)?;
    // What stands before is written by hand.
    let (guide, _) = before
        .split_once(TITLE)
        .ok_or("docs/openmesh.md has lost its second title")?;
    fs::write(file, format!("{guide}{text}"))?;
    Ok(())
}

/// Where the comparison begins in the file.
const TITLE: &str = "# Beside OpenMesh's smoother";

fn head() -> String {
    let model = machine::processor();
    format!(
        "{TITLE}\n\n\
        `OpenMesh::Smoother::JacobiLaplaceSmootherT` with C1 (the umbrella of umbrellas, equal weights, damped Jacobi steps) and\n\
        fairmesh, on the same arrays with the same free vertices. Neither is given normals: both see four rings of exact triangles around the\n\
        free part. Both begin with the same wrong interior (a flat disc, a pinched or straight tube). From here on this file is written by\n\n\
        ```sh\nbindings/openmesh-sys/report.sh\n```\n\n\
        and no measured number in it is typed. Machine of this run: {model}, one thread each, wall seconds from arrays to arrays.\n\
        Distances are those of free vertices to the exact surface, over the diagonal of the free part's bounding box. \"In the limit\" is the\n\
        smoother run for ever: its equations, solved directly.\n\n"
    )
}

/// A distance and, in parentheses, the largest.
fn distances(m: &Measured) -> String {
    format!("{:.1e} ({:.1e})", m.rms, m.max)
}

const COLUMNS: &str = "smoother, 100 | 1,000 | 10,000 | in the limit | fairmesh";

/// Distances, normals and times of small meshes, all triangulations.
fn surfaces(n: usize) -> String {
    let cases: Vec<_> = SURFACES
        .iter()
        .flat_map(|&surface| triangulations().map(|t| case(surface, t, n)))
        .collect();
    let runs: Vec<_> = cases
        .iter()
        .map(|c| (c.smoother(), c.limit(), c.ours(), c.exact()))
        .collect();
    let mut text = format!(
        "## Distance to the exact surface, about {n} free vertices\n\nRoot mean square, and the largest. The columns are iterations.\n\n\
        | surface | triangulation | {COLUMNS} |\n|---|---|---|---|---|---|---|\n"
    );
    for (case, (smoother, limit, ours, _)) in cases.iter().zip(&runs) {
        let _ = write!(text, "| {} | {} ", case.surface, case.triangulation);
        for m in smoother.iter().chain([limit, ours]) {
            let _ = write!(text, "| {} ", distances(m));
        }
        text += "|\n";
    }
    text += "\nThe smoother's surface depends on the iterations and on the triangulation, also in the limit: the umbrella is about the mesh, not\n\
        about the surface. It is nearly right in the limit where the lattice is conformal to the surface, as the regular catenoid's.\n\n";
    let _ = write!(
        text,
        "## Boundary normals\n\nRoot mean square angle, in degrees, between the exact normals at the boundary and the free triangles there. Exact \
        triangles\nturn from the normals at their corners, too: last column.\n\n\
        | surface | triangulation | {COLUMNS} | exact mesh |\n|---|---|---|---|---|---|---|---|\n"
    );
    for (case, (smoother, limit, ours, exact)) in cases.iter().zip(&runs) {
        let _ = write!(text, "| {} | {} ", case.surface, case.triangulation);
        for m in smoother.iter().chain([limit, ours, exact]) {
            let _ = write!(text, "| {:.2} ", m.normals);
        }
        text += "|\n";
    }
    text += "\n";
    text + &times(
        &format!(
            "## Time to the smoother's best distance, about {n} free vertices\n\nThe best of its three runs, by root mean square, and how long \
            it took. fairmesh's time is that of its whole solve."
        ),
        cases
            .iter()
            .zip(&runs)
            .map(|(c, (smoother, _, ours, _))| (c, best(smoother), ours)),
    )
}

/// A table of times; fairmesh's are those of the whole solve, which ends far below the smoother's distance.
fn times<'a>(heading: &str, rows: impl Iterator<Item = (&'a Case, &'a Measured, &'a Measured)>) -> String {
    let mut text = format!(
        "{heading}\n\n\
        | surface | triangulation | its best | iterations | its seconds | fairmesh | iterations | seconds | times closer | times sooner |\n\
        |---|---|---|---|---|---|---|---|---|---|\n"
    );
    for (case, theirs, ours) in rows {
        let _ = writeln!(
            text,
            "| {} | {} | {:.1e} | {} | {:.3} | {:.1e} | {} | {:.3} | {:.1e} | {:.0} |",
            case.surface,
            case.triangulation,
            theirs.rms,
            theirs.iterations,
            theirs.seconds,
            ours.rms,
            ours.iterations,
            ours.seconds,
            theirs.rms / ours.rms,
            theirs.seconds / ours.seconds
        );
    }
    text + "\n"
}

/// Distances and times of large irregular meshes.
fn large(n: usize) -> String {
    let cases = SURFACES.map(|surface| case(surface, triangulations()[1], n));
    let runs: Vec<_> = cases.iter().map(|c| (c.smoothed(10_000), c.ours())).collect();
    times(
        &format!("## The same with about {n} free vertices, 10,000 iterations"),
        cases
            .iter()
            .zip(&runs)
            .map(|(c, (theirs, ours))| (c, theirs, ours)),
    )
}

/// The surfaces of one case as pictures.
fn shown(pictures: &Pictures) -> Result<String, Failure> {
    let case = case("sphere", triangulations()[1], 1_000);
    let smoother = case.smoother();
    let mut meshes = vec![("start".to_owned(), case.start.clone())];
    for m in &smoother {
        meshes.push((format!("OpenMesh, {}", m.iterations), m.positions.clone()));
    }
    meshes.push(("fairmesh".to_owned(), case.ours().positions));
    let line = pictures.draw("sphere", &case.shape.triangles, &meshes, None, "0.6,-1,0.9")?;
    Ok(format!(
        "## Pictures\n\nThe irregular sphere, flat-shaded and as a mirror: the start, the smoother after 100, 1,000 and 10,000 iterations, fairmesh.\n\n{line}\n"
    ))
}

fn scans(pictures: &Pictures, scans: &[Scan]) -> Result<String, Failure> {
    if scans.is_empty() {
        return Ok("Scans: not in this run, see the head of report.sh.\n\n".to_owned());
    }
    let mut text = String::from(
        "Regions of scans, smoothed from what they are: the scan, the smoother after 100, 1,000 and 10,000 iterations, fairmesh. The scans\n\
        are not part of the project.\n\n",
    );
    for (k, scan) in scans.iter().enumerate() {
        let (line, figures) = pictures::scan(pictures, k + 1, &scan.mesh, &scan.free, &scan.view)?;
        let _ = write!(text, "{}, {figures}:\n\n{line}\n", scan.name);
        eprintln!("{}: done", scan.name);
    }
    Ok(text)
}

const TAIL: &str = r#"## What is tested

`tests/comparison.rs` of `bindings/openmesh-sys` measures the small meshes anew and asserts, as ratios within that one run: on every row
fairmesh is at least 1,000 times (sphere) or 20 times (cylinder, catenoid) closer than the smoother after any of the three counts, in both
measures, closer than the limit, and done before the smoother has reached its best. The limit is what we say: run until it stands still, the
smoother is within 1e-12 of the direct solution of the squared umbrella with equal weights.
"#;
