//! README.md and docs/ say what the program does: commands run, outputs are those that are shown, figures those that are
//! measured.
//!
//! Numbers are compared as they are written: whole ones exactly; with decimals to one unit of the last digit; with an
//! exponent, which are remainders of an iteration or rounding, to a factor of ten. Seconds are not compared, nor which
//! of several equally bad vertices or faces is named.
//!
//! `FAIRMESH_WRITE_DOCS=1 cargo test --release --test docs` writes outputs and figures anew.
#![allow(unreachable_pub, reason = "nothing of a test is reachable from outside")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;

#[path = "common/document.rs"]
mod document;
#[path = "common/tier.rs"]
mod tier;

use document::{blocks, same_line, same_number, same_text};
use fairmesh_shapes::{HarmonicProfile, Surface, Unduloid};
use serde_json::Value;
use tier::tier;

const FAIRMESH: &str = env!("CARGO_BIN_EXE_fairmesh");

/// Where README.md is.
fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let has_documents = |folder: &&Path| folder.join("docs/measurements.md").exists();
    here.ancestors().find(has_documents).unwrap().to_path_buf()
}

/// README.md and docs/*.md.
fn documents() -> Vec<PathBuf> {
    let docs = fs::read_dir(root().join("docs")).unwrap();
    let docs = docs.map(|entry| entry.unwrap().path());
    let mut all: Vec<PathBuf> = docs
        .filter(|path| path.extension().is_some_and(|e| e == "md"))
        .collect();
    all.push(root().join("README.md"));
    all.sort();
    all
}

/// An empty directory with the mesh that the documents speak of.
fn scratch(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("docs").join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(path.join("docs")).unwrap();
    fs::copy(root().join("docs/dented.ply"), path.join("docs/dented.ply")).unwrap();
    path
}

/// The words behind `fairmesh` of a line that runs the program.
fn command(line: &str) -> Option<Vec<&str>> {
    let line = line.split(" #").next().unwrap();
    let words = line
        .strip_prefix("fairmesh ")
        .or_else(|| line.strip_prefix("cargo run --release -- "));
    Some(words?.split_whitespace().collect())
}

/// Runs a command line to a good end, and returns what it printed.
fn run(folder: &Path, words: &[&str]) -> String {
    let output = Command::new(FAIRMESH)
        .current_dir(folder)
        .args(words)
        .output()
        .unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "fairmesh {}: {errors}", words.join(" "));
    String::from_utf8(output.stdout).unwrap().replace("\r\n", "\n")
}

/// Held by a test that may write a document.
static WRITING: Mutex<()> = Mutex::new(());

fn writes() -> bool {
    std::env::var_os("FAIRMESH_WRITE_DOCS").is_some()
}

/// README.md and docs/README.md run side by side: the whole path names the folder.
fn folder_name(document: &Path) -> String {
    let from_root = document.strip_prefix(root()).unwrap().with_extension("");
    from_root.to_string_lossy().replace(['/', '\\'], "_")
}

/// Runs what a document shows. Returns its text with the outputs of now, and what differs.
fn replay(path: &Path) -> (String, Vec<String>) {
    let text = fs::read_to_string(path).unwrap();
    let lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let folder = scratch(&folder_name(path));
    let (mut fresh, mut copied, mut wrong) = (Vec::new(), 0, Vec::new());
    let mut printed: Vec<String> = Vec::new();
    for block in blocks(&lines) {
        let inside = &lines[block.begin..block.end];
        if block.language == "sh" {
            let outputs = inside
                .iter()
                .filter_map(|line| Some(run(&folder, &command(line)?)));
            printed = outputs.collect::<String>().lines().map(str::to_owned).collect();
        } else if block.language == "text" {
            assert!(!printed.is_empty(), "{}: an output of nothing", path.display());
            fresh.extend_from_slice(&lines[copied..block.begin]);
            if same_text(inside, &printed) {
                fresh.extend_from_slice(inside);
            } else {
                let (shown, found) = (inside.join("\n"), printed.join("\n"));
                wrong.push(format!("{}: shown\n{shown}\nprinted\n{found}", path.display()));
                fresh.append(&mut printed);
            }
            copied = block.end;
        }
    }
    fresh.extend_from_slice(&lines[copied..]);
    (fresh.join("\n") + "\n", wrong)
}

#[test]
fn commands_print_what_is_shown() {
    let alone = WRITING.lock().unwrap();
    let mut wrong = Vec::new();
    let paths = documents();
    let replayed = std::thread::scope(|scope| {
        let all: Vec<_> = paths.iter().map(|path| scope.spawn(|| replay(path))).collect();
        all.into_iter().map(|one| one.join().unwrap()).collect::<Vec<_>>()
    });
    for (path, (fresh, differs)) in paths.iter().zip(replayed) {
        if writes() && !differs.is_empty() {
            fs::write(path, fresh).unwrap();
        } else {
            wrong.extend(differs);
        }
    }
    drop(alone);
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

/// Two documents in one folder would remove each other's files while they run.
#[test]
fn documents_run_in_folders_of_their_own() {
    let folders: BTreeSet<String> = documents().iter().map(|path| folder_name(path)).collect();
    assert_eq!(folders.len(), documents().len(), "folders: {folders:?}");
}

/// The number behind this label in a report.
fn reported(report: &str, label: &str) -> String {
    let line = report.lines().find_map(|line| line.trim().strip_prefix(label));
    let number = line.unwrap_or_else(|| panic!("no '{label}' in\n{report}"));
    number.trim().split(',').next().unwrap().to_owned()
}

/// Largest distance of a vertex of an ASCII PLY file from the unit sphere.
fn off_sphere(path: &Path) -> f64 {
    let text = fs::read_to_string(path).unwrap();
    let (header, body) = text.split_once("end_header\n").unwrap();
    let count = header
        .lines()
        .find_map(|line| line.strip_prefix("element vertex "));
    let radius = |line: &str| {
        let numbers = line
            .split_whitespace()
            .take(3)
            .map(|word| word.parse::<f64>().unwrap());
        numbers.map(|x| x * x).sum::<f64>().sqrt()
    };
    let vertices = body.lines().take(count.unwrap().parse().unwrap());
    vertices
        .map(|line| (radius(line) - 1.0).abs())
        .fold(0.0, f64::max)
}

/// The figures that sentences in the documents refer to.
fn figures() -> BTreeMap<&'static str, String> {
    let folder = scratch("figures");
    let demo = run(&folder, &["demo", "out"]);
    let dent = [
        "fair",
        "docs/dented.ply",
        "-o",
        "sphere.ply",
        "--selection",
        "free",
    ];
    run(&folder, &dent);
    BTreeMap::from([
        ("demo.free_vertices", reported(&demo, "free vertices:")),
        ("demo.iterations", reported(&demo, "iterations:")),
        (
            "dented.off_sphere",
            format!("{:.0e}", off_sphere(&folder.join("sphere.ply"))),
        ),
    ])
}

/// A sentence marks a figure as `12<!--demo.iterations-->`.
#[test]
fn figures_in_sentences_are_measured() {
    let alone = WRITING.lock().unwrap();
    let figures = figures();
    let (mut used, mut wrong) = (Vec::new(), Vec::new());
    for path in documents() {
        let text = fs::read_to_string(&path).unwrap();
        let mut fresh = text.clone();
        for (at, _) in text.match_indices("<!--") {
            let (key, _) = text[at + 4..].split_once("-->").unwrap();
            if key.starts_with('[') {
                // A part that ./reproduce.sh renews.
                continue;
            }
            let found = figures
                .get(key)
                .unwrap_or_else(|| panic!("{}: no figure {key}", path.display()));
            let shown = text[..at].split_whitespace().next_back().unwrap();
            used.push(key.to_owned());
            if same_number(shown, found) != Some(true) {
                wrong.push(format!("{}: {shown} for {key}, {found} measured", path.display()));
                fresh = fresh.replace(&format!("{shown}<!--{key}-->"), &format!("{found}<!--{key}-->"));
            }
        }
        if writes() && fresh != text {
            fs::write(&path, fresh).unwrap();
            wrong.clear();
        }
    }
    drop(alone);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    for key in figures.keys() {
        assert!(used.iter().any(|used| used == key), "no sentence has {key}");
    }
}

/// The cells of the rows of a table under this heading of docs/measurements.md.
fn table(heading: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(root().join("docs/measurements.md")).unwrap();
    let section = text.split(&format!("\n## {heading}\n")).nth(1).unwrap();
    let section = section.split("\n## ").next().unwrap();
    let rows = section.lines().filter(|line| line.starts_with('|')).skip(2);
    let cells = |row: &str| {
        row.trim_matches('|')
            .split('|')
            .map(|cell| cell.trim().to_owned())
            .collect()
    };
    rows.map(cells).collect()
}

/// Of a cell "1.0 to 2.0", or "1.0".
fn range(cell: &str) -> [f64; 2] {
    let (least, greatest) = cell.split_once(" to ").unwrap_or((cell, cell));
    [least, greatest].map(|number| number.parse().unwrap())
}

/// Within what is stated, as far as two digits say. What is left where a surface is met exactly varies by machine.
fn is_stated(figure: f64, cell: &str) -> bool {
    const ROUNDING: f64 = 1e-8;
    let [least, greatest] = range(cell);
    if greatest < ROUNDING {
        figure < 10.0 * greatest
    } else {
        (0.95 * least..=1.05 * greatest).contains(&figure)
    }
}

/// The first seed of a row: the report, all vertices, and which were free in the generated mesh.
fn first_seed(test: &str, generate: &str, command: &str) -> (Value, Vec<[f64; 3]>, BTreeSet<usize>) {
    let folder = scratch(test);
    let files = "-o in.off --free free.txt --normals normals.txt";
    let run = |line: &str| run(&folder, &line.split(' ').collect::<Vec<_>>());
    run(&format!(
        "generate {generate} --seed 1 --triangulation irregular {files}"
    ));
    let report = run(&format!("{command} in.off -o out.off --json -"));
    let [free, mesh] = ["free.txt", "out.off"].map(|name| fs::read_to_string(folder.join(name)).unwrap());
    let mut rows = mesh.lines().skip(1).map(|line| line.split_whitespace());
    let count = rows.next().unwrap().next().unwrap().parse().unwrap();
    let vertices = rows
        .take(count)
        .map(|mut words| [0; 3].map(|_| words.next().unwrap().parse().unwrap()));
    let free = free.lines().map(|line| line.parse().unwrap());
    (
        serde_json::from_str(&report).unwrap(),
        vertices.collect(),
        free.collect(),
    )
}

/// What `fairmesh generate` makes by this name.
fn surface(kind: &str) -> Surface {
    match kind {
        "sphere-cap" => Surface::Sphere,
        "cylinder" => Surface::Cylinder,
        "catenoid" => Surface::Catenoid,
        "unduloid" => Surface::Unduloid(Unduloid::new(0.7, 1.0)),
        "revolution" => Surface::Revolution(HarmonicProfile::new(1.0, -1.0, 0.5, 2.0).unwrap()),
        _ => panic!("{kind}"),
    }
}

#[test]
fn the_first_seed_is_as_accurate_as_its_row() {
    let rows = table("Accuracy");
    assert_eq!(rows.len(), 20, "five surfaces, two sizes, two kinds of normals");
    let mut wrong = Vec::new();
    for row in rows {
        let (kind, n) = (&row[0], &row[1]);
        if n.parse::<usize>().unwrap() > tier(4_000, usize::MAX) {
            continue;
        }
        let normals = if row[2] == "exact" {
            " --normals normals.txt"
        } else {
            ""
        };
        let generate = format!("{kind} --vertices {n} --start random");
        let (report, vertices, free) =
            first_seed("accuracy", &generate, &format!("fair --free free.txt{normals}"));
        let surface = surface(kind);
        let error = free
            .iter()
            .map(|&v| surface.distance(vertices[v]))
            .fold(0.0, f64::max);
        let error = error / report["diagonal"].as_f64().unwrap();
        let iterations = report["iterations"].as_f64().unwrap();
        let [least, most] = range(&row[4]);
        if !is_stated(error, &row[3]) || !(least..=most).contains(&iterations) {
            wrong.push(format!("{row:?}: {error:.1e}, {iterations} iterations"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_first_seed_is_filled_as_its_row_says() {
    let row = &table("Holes")[0];
    let generate = format!("sphere-hole --vertices {} --outside 1", row[0]);
    let (report, vertices, _) = first_seed("filling", &generate, "fill --threads 1");
    let new = report["new_vertices"].as_u64().unwrap() as usize;
    assert!(is_stated(new as f64, &row[1]), "{row:?}: {new}");
    let off = vertices[vertices.len() - new..]
        .iter()
        .map(|p| Surface::Sphere.distance(*p));
    let off = off.fold(0.0, f64::max);
    assert!(is_stated(off, &row[2]), "{row:?}: {off:.1e}");
}

/// The part of an address that a heading gets.
fn anchor(heading: &str) -> String {
    let kept = heading
        .chars()
        .filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    kept.collect::<String>().trim().to_lowercase().replace(' ', "-")
}

#[test]
fn links_lead_somewhere() {
    for path in documents() {
        let text = fs::read_to_string(&path).unwrap();
        // Code may hold brackets and parentheses of its own.
        let prose: String = text.split("```").step_by(2).collect();
        let links = prose
            .split("](")
            .skip(1)
            .map(|rest| rest.split(')').next().unwrap());
        for link in links.filter(|link| !link.contains("://")) {
            let (file, section) = link.split_once('#').unwrap_or((link, ""));
            let target = path.parent().unwrap().join(file);
            assert!(target.exists(), "{}: {link}", path.display());
            if !section.is_empty() {
                let target = fs::read_to_string(target).unwrap();
                let mut headings = target.lines().filter(|line| line.starts_with('#'));
                let found = headings.any(|line| anchor(line.trim_start_matches('#')) == section);
                assert!(found, "{}: {link}", path.display());
            }
        }
    }
}

#[test]
fn the_readme_is_short() {
    let text = fs::read_to_string(root().join("README.md")).unwrap();
    let words = text.split_whitespace().count();
    assert!(words < 900, "{words} words");
}

/// What the other tests rely on.
#[test]
fn differences_are_seen() {
    assert!(same_line(
        "  iterations:  7, last step 7.0e-11 of",
        "iterations: 7, last step 2.1e-10 of"
    ));
    assert!(!same_line(
        "iterations: 7, last step 7.0e-11",
        "iterations: 6, last step 7.0e-11"
    ));
    assert!(!same_line("last step 7.0e-11", "last step 9.0e-10"));
    assert!(!same_line("last step 7.0e-11", "last step -7.0e-11"));
    assert!(same_line(
        "angle: 42.61 degrees, in face 169",
        "angle: 42.62 degrees, in face 631"
    ));
    assert!(!same_line("angle: 42.61 degrees", "angle: 42.64 degrees"));
    assert!(same_line("-1.000 to -1.0000", "-1.0000 to -0.9999"));
    assert!(same_line(
        "seconds: 0.02 (read 0.00)",
        "seconds: 1.02 (read 0.01)"
    ));
    assert!(!same_line("flipped: none", "flipped: 3"));
    assert!(!same_line("flipped: none", "flipped: none at all"));
    let lines = |text: &str| -> Vec<String> { text.lines().map(str::to_owned).collect() };
    let same = |shown: &str, found: &str| same_text(&lines(shown), &lines(found));
    assert!(same("a\n  ...\nd", "a\nb\nc\nd") && same("a\n...", "a") && !same("a\n...\nd", "a\nb"));
    assert!(same("at ... of 7", "at 0.1 of 7") && !same("at ... of 7", "at 0.1 of 8"));
    let table = "file  outcome  seconds\na.ply  filled  0.02\nb.ply  refused  0.10";
    assert!(same(table, &table.replace("0.10", "7.00")) && !same(table, &table.replace("refused", "filled")));
    assert!(is_stated(1.04e-5, "1.0e-5 to 2.0e-5") && !is_stated(2.2e-5, "1.0e-5 to 2.0e-5"));
    assert!(is_stated(9e-10, "1.0e-10 to 2.0e-10") && !is_stated(9e-10, "5.0e-11"));
}
