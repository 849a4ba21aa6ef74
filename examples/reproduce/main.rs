//! The paper's figures, table and claims, measured: writes `REPRODUCTION.md` and `docs/reproduction/*.png`; or
//! `docs/measurements.md`; or `docs/g2.md` and `docs/g2/*.png`.
//!
//! ```text
//! reproduce FAIRMESH [--scan NAME MESH FREE-VERTICES VIEW]... [--runs N]
//! reproduce FAIRMESH measurements
//! reproduce FAIRMESH continuity [--python PYTHON] [--scan NAME MESH FREE-VERTICES VIEW]...
//! ```
//!
//! NAME should say where the scan comes from; its picture goes into the document. `FAIRMESH` is the program; it makes the inputs, the surfaces and the pictures. `./reproduce.sh` builds it first.
//! Every number in the document comes from here.
#![allow(unreachable_pub, reason = "nothing of a program is reachable from outside")]
#![allow(clippy::print_stderr, reason = "tells how far it is")]

mod boundary;
mod claims;
mod continuity;
mod figures;
mod machine;
mod measure;
mod measurements;
mod table;
mod tool;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use tool::Tool;

/// What is asked.
struct Arguments {
    binary: PathBuf,
    scans: Vec<Scan>,
    runs: usize,
    measurements: bool,
    continuity: bool,
    /// Runs `benches/continuity_peers.py`.
    python: Option<PathBuf>,
}

/// A scan to be shown, as the paper's Figs. 9 and 10 do.
pub struct Scan {
    /// What it is.
    pub name: String,
    /// The mesh.
    pub mesh: PathBuf,
    /// Its free vertices.
    pub free: PathBuf,
    /// From where they are seen, as `fairmesh render --view` has it.
    pub view: String,
}

fn arguments() -> Option<Arguments> {
    let mut words = std::env::args().skip(1);
    let mut arguments = Arguments {
        binary: words.next()?.into(),
        scans: Vec::new(),
        runs: 5,
        measurements: false,
        continuity: false,
        python: None,
    };
    while let Some(word) = words.next() {
        match word.as_str() {
            "--scan" => arguments.scans.push(Scan {
                name: words.next()?,
                mesh: words.next()?.into(),
                free: words.next()?.into(),
                view: words.next()?,
            }),
            "--runs" => arguments.runs = words.next()?.parse().ok().filter(|n| *n > 0)?,
            "--python" => arguments.python = Some(words.next()?.into()),
            "measurements" => arguments.measurements = true,
            "continuity" => arguments.continuity = true,
            _ => return None,
        }
    }
    Some(arguments)
}

fn main() -> io::Result<()> {
    let Some(arguments) = arguments() else {
        return Err(io::Error::other(
            "usage: reproduce FAIRMESH [--scan NAME MESH FREE-VERTICES VIEW]... [--runs N] | measurements | continuity",
        ));
    };
    let root = &Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let work = root.join("target/reproduction");
    if arguments.continuity {
        let tool = Tool::new(arguments.binary, work, root.join("docs/g2"))?;
        let peers = arguments.python.map(|python| continuity::Peers {
            python,
            script: root.join("benches/continuity_peers.py"),
        });
        let text = continuity::document(&tool, peers.as_ref(), &arguments.scans, &machine())?;
        return fs::write(root.join("docs/g2.md"), text);
    }
    let tool = Tool::new(arguments.binary, work, root.join("docs/reproduction"))?;
    if arguments.measurements {
        let text = measurements::document(&tool, &machine())?;
        return fs::write(root.join("docs/measurements.md"), text);
    }
    let mut text = head();
    for (what, section) in [
        ("table", table::section(&tool, arguments.runs)?),
        ("figures", figures::section(&tool)?),
        ("scans", figures::scans(&tool, &arguments.scans)?),
        ("claims", claims::section(&tool)?),
    ] {
        eprintln!("{what}: done");
        text += &section;
    }
    text += TAIL;
    fs::write(root.join("REPRODUCTION.md"), text)
}

/// What figures in seconds belong to.
fn machine() -> String {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    format!("{}, {threads} threads", machine::processor())
}

fn head() -> String {
    let machine = machine();
    format!(
        "# Reproduction\n\n\
        The figures, the table and the claims of R. Schneider, L. Kobbelt, \"Geometric fairing of irregular meshes for\n\
        free-form surface design\", CAGD 18 (2001), made with this program by\n\n\
        ```sh\n./reproduce.sh\n```\n\n\
        No measured number is typed. Machine of this run: {machine}. Distances are to a surface, over the\n\
        diagonal of its bounding box. Boundary normals are exact, but for the scans.\n\n"
    )
}

const TAIL: &str = r#"## What is not the paper's

- The paper's meshes are not published. Cylinder blend and tetra thing have its numbers of vertices and triangles; radii,
  distances and connectivity are our own. Bust and ear are other scans.
- The "improved bilaplacian" of Fig. 7, another paper's scheme, is not there.
- The linear surfaces are this program's: uniform or cotangent weights, normals as conormal flux through the boundary. The
  paper does not say how normals enter its own.
"#;

/// A number in few digits.
pub fn short(x: f64) -> String {
    // The distance of a surface to itself is rounding.
    if x.abs() < 1e-15 {
        "0".to_owned()
    } else if (0.01..1e4).contains(&x.abs()) {
        let digits = (2 - x.abs().log10().floor() as i32).clamp(0, 4) as usize;
        format!("{x:.digits$}")
    } else {
        format!("{x:.1e}")
    }
}
