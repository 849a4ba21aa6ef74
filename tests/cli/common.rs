//! A spherical cap with a dented middle, and the program.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::Mutex;

/// Vertices along a side of the grid.
pub const SIDE: usize = 15;
/// Rows of quads around the region that are not selected.
pub const FRAME: usize = 4;

/// An empty directory of a test. Two tests that share one would take it away from each other while programs start in it.
pub fn directory(test: &str) -> PathBuf {
    static TAKEN: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
    let is_first = TAKEN.lock().unwrap().insert(test.to_owned());
    assert!(is_first, "two tests use the directory {test}");
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

/// Runs the binary in a directory.
pub fn fairmesh(directory: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_fairmesh"))
        .current_dir(directory)
        .args(args)
        .output()
        .unwrap()
}

/// Runs it and expects this exit code; returns stdout and stderr.
pub fn expect(directory: &Path, args: &[&str], code: i32) -> (String, String) {
    let output = fairmesh(directory, args);
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    let (out, err) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(code), "{args:?}\n{out}\n{err}");
    (out, err)
}

/// Whether a vertex has all its quads in the region.
pub fn is_free(v: usize) -> bool {
    let inside = |k: usize| (FRAME + 1..SIDE - FRAME - 1).contains(&k);
    inside(v % SIDE) && inside(v / SIDE)
}

/// A grid on the unit sphere; the free vertices are pushed inwards and sideways.
pub fn cap() -> Vec<[f64; 3]> {
    cap_of(0.6)
}

/// A smaller one: its boundary encloses a sheet, and no hole.
pub fn sheet() -> Vec<[f64; 3]> {
    cap_of(0.4)
}

fn cap_of(half: f64) -> Vec<[f64; 3]> {
    let at = |k: usize| 2.0 * half * k as f64 / (SIDE - 1) as f64 - half;
    let vertex = |v: usize| {
        let (x, y) = (at(v % SIDE), at(v / SIDE));
        let z = (1.0 - x * x - y * y).sqrt();
        let dent = if is_free(v) {
            0.9 + 0.004 * (v % 7) as f64
        } else {
            1.0
        };
        [x, y, z].map(|c| c * dent)
    };
    (0..SIDE * SIDE).map(vertex).collect()
}

/// Quads, counter-clockwise seen from outside.
pub fn quads() -> Vec<[usize; 4]> {
    let squares = (0..SIDE - 1).flat_map(|j| (0..SIDE - 1).map(move |i| j * SIDE + i));
    squares.map(|v| [v, v + 1, v + SIDE + 1, v + SIDE]).collect()
}

/// Whether a quad is selected.
pub fn is_selected(quad: usize) -> bool {
    let inside = |k: usize| (FRAME..SIDE - 1 - FRAME).contains(&k);
    inside(quad % (SIDE - 1)) && inside(quad / (SIDE - 1))
}

/// The lines of a list of indices.
pub fn list(indices: impl Iterator<Item = usize>) -> String {
    indices.map(|index| format!("{index}\n")).collect()
}

/// `faces.txt` and `free.txt` in the directory.
pub fn write_lists(directory: &Path) {
    fs::write(
        directory.join("faces.txt"),
        list((0..quads().len()).filter(|&q| is_selected(q))),
    )
    .unwrap();
    fs::write(
        directory.join("free.txt"),
        list((0..SIDE * SIDE).filter(|&v| is_free(v))),
    )
    .unwrap();
}

/// The cap as OBJ.
pub fn obj(positions: &[[f64; 3]]) -> String {
    let mut text = String::from("# cap\n");
    positions
        .iter()
        .for_each(|[x, y, z]| text += &format!("v {x} {y} {z}\n"));
    quads()
        .iter()
        .for_each(|[a, b, c, d]| text += &format!("f {} {} {} {}\n", a + 1, b + 1, c + 1, d + 1));
    text
}

/// Largest distance of a vertex from the unit sphere.
pub fn off_sphere(positions: &[[f64; 3]]) -> f64 {
    let distance = |p: &[f64; 3]| (p.iter().map(|c| c * c).sum::<f64>().sqrt() - 1.0).abs();
    positions.iter().map(distance).fold(0.0, f64::max)
}

/// Width and height of a PNG, after its signature.
pub fn size_of_png(path: &Path) -> [u32; 2] {
    let png = fs::read(path).unwrap();
    assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"));
    [16, 20].map(|at| u32::from_be_bytes(png[at..at + 4].try_into().unwrap()))
}

/// The words of a line, as numbers.
pub fn numbers(line: &str) -> Vec<f64> {
    line.split_whitespace()
        .map(|word| word.parse().unwrap())
        .collect()
}

/// What stands behind this name in the lines of an OBJ.
pub fn lines_of<'t>(text: &'t str, name: &str) -> Vec<&'t str> {
    text.lines().filter_map(|line| line.strip_prefix(name)).collect()
}

/// The same as numbers.
pub fn numbers_of(text: &str, name: &str) -> Vec<Vec<f64>> {
    lines_of(text, name).into_iter().map(numbers).collect()
}

/// The vertex and the texture coordinate of each corner of a face, as counted from 0.
pub fn corners(face: &str) -> Vec<[usize; 2]> {
    let corner = |word: &str| {
        let (v, vt) = word.split_once('/').unwrap();
        [v, vt].map(|n| n.parse::<usize>().unwrap() - 1)
    };
    face.split_whitespace().map(corner).collect()
}
