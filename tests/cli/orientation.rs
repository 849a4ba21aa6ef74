//! Faces that face the wrong way: told once, and turned in every format.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::common::{SIDE, directory, expect, obj, sheet};

/// Runs a command, in words.
fn run(directory: &Path, command: &str, code: i32) -> (String, String) {
    expect(directory, &command.split(' ').collect::<Vec<_>>(), code)
}

/// The quad that is left out.
const GONE: usize = (SIDE - 1) * (SIDE / 2) + SIDE / 2;

/// The cap's quads as the lines of a file, and whether each is turned: every third, and a hole in the middle.
fn turned() -> (String, Vec<usize>) {
    let text = obj(&sheet());
    let mut face = 0;
    let mut kept = 0;
    let mut which = Vec::new();
    let mut lines = String::new();
    for line in text.lines() {
        let Some(corners) = line.strip_prefix("f ") else {
            lines += &format!("{line}\n");
            continue;
        };
        face += 1;
        if face - 1 == GONE {
            continue;
        }
        let corners: Vec<&str> = corners.split(' ').collect();
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| corners[k]);
        if face % 3 == 0 {
            which.push(kept);
            lines += &format!("f {a} {d} {c} {b}\n");
        } else {
            lines += &format!("f {a} {b} {c} {d}\n");
        }
        kept += 1;
    }
    (lines, which)
}

#[test]
fn inconsistent_faces_are_told_once() {
    let directory = directory("oriented_told");
    let (text, _) = turned();
    fs::write(directory.join("in.obj"), &text).unwrap();
    let (out, _) = run(&directory, "fill in.obj -o out.obj --json r.json", 3);
    let told = "faces are oriented inconsistently, at ";
    assert_eq!(out.matches(told).count(), 1, "{out}");
    assert!(out.contains("--orient") && out.lines().count() < 5, "{out}");
    let report: Value = serde_json::from_slice(&fs::read(directory.join("r.json")).unwrap()).unwrap();
    assert!(report["orientation"]["inconsistent_edges"].as_u64().unwrap() > 100);
    let (out, _) = run(&directory, "holes in.obj", 0);
    assert_eq!(out.matches(told).count(), 1, "{out}");
    fs::write(
        directory.join("faces.txt"),
        "30\n31\n32\n44\n45\n46\n58\n59\n60\n",
    )
    .unwrap();
    let (_, err) = run(&directory, "fair in.obj --faces faces.txt -o out.obj", 2);
    assert!(
        err.contains("--orient") && err.contains("edges of the mesh"),
        "{err}"
    );
    run(&directory, "fair in.obj --orient --faces faces.txt -o out.obj", 0);
}

#[test]
fn faces_are_turned_and_all_else_stays() {
    let directory = directory("orient");
    let (text, which) = turned();
    fs::write(directory.join("in.obj"), &text).unwrap();
    let (out, _) = run(&directory, "fill in.obj --orient -o out.obj", 0);
    let first = format!("{} faces were turned around\n", which.len());
    assert!(out.starts_with(&first) && out.contains("triangulated"), "{out}");
    let new = fs::read_to_string(directory.join("out.obj")).unwrap();
    // The faces as they were before any was turned.
    let straight = obj(&sheet());
    let faces: Vec<&str> = straight.lines().filter(|line| line.starts_with("f ")).collect();
    let written: Vec<&str> = new.lines().filter(|line| line.starts_with("f ")).collect();
    let kept = faces.iter().enumerate().filter(|(f, _)| *f != GONE);
    assert!(kept.map(|(_, line)| line).eq(written[..faces.len() - 1].iter()));
    let vertices = |text: &str| -> Vec<String> {
        let lines = text.lines().filter(|line| line.starts_with("v "));
        lines.take(SIDE * SIDE).map(str::to_owned).collect()
    };
    assert_eq!(vertices(&text), vertices(&new));
}

/// What a file is in which faces were turned that hang together with the first one.
fn straightened(directory: &Path, name: &str, bytes: &[u8]) -> Vec<u8> {
    fs::write(directory.join(name), bytes).unwrap();
    fs::write(directory.join("0"), "0\n").unwrap();
    let command = format!("select {name} --orient --faces 0 --grow 9 -q -o out_{name}");
    run(directory, &command, 0);
    fs::read(directory.join(format!("out_{name}"))).unwrap()
}

const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
    element face 2\nproperty uchar red\nproperty list uchar int vertex_indices\n\
    property list uchar float texcoord\nend_header\n";

/// In each format the second of two faces is turned, with what belongs to its corners.
#[test]
fn faces_are_turned_in_every_format_of_text() {
    let directory = directory("orient_text");
    let last = |name: &str, text: &str, row: &str| {
        let new = String::from_utf8(straightened(&directory, name, text.as_bytes())).unwrap();
        assert!(new.ends_with(row), "{new}");
    };
    let off = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 3 2\n";
    last("a.off", off, "3 0 2 3\n");
    let lines = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n";
    let faces = "f 1/1 2/2 3/3\nf -4/1 -1/2 -2/3 # turned\n";
    last("a.obj", &format!("{lines}{faces}"), "f -4/1 -2/3 -1/2 # turned\n");
    let rows = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n7 3 0 1 2 6 1 2 3 4 5 6\n7 3 0 3 2 6 1 2 3 4 5 6\n";
    last("a.ply", &format!("{PLY}{rows}"), "7 3 0 2 3 6 1 2 5 6 3 4\n");
}

#[test]
fn faces_are_turned_in_binary_ply() {
    let directory = directory("orient_ply");
    let mut binary = PLY.replace("ascii", "binary_big_endian").into_bytes();
    for coordinate in [0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.] {
        binary.extend_from_slice(&f32::to_be_bytes(coordinate));
    }
    let row = |corners: [i32; 3], texture: [f32; 6]| {
        let corners = corners.map(i32::to_be_bytes).concat();
        [
            &[7, 3],
            &corners[..],
            &[6],
            &texture.map(f32::to_be_bytes).concat(),
        ]
        .concat()
    };
    binary.extend(row([0, 1, 2], [1., 2., 3., 4., 5., 6.]));
    let expected = [&binary[..], &row([0, 2, 3], [1., 2., 5., 6., 3., 4.])].concat();
    binary.extend(row([0, 3, 2], [1., 2., 3., 4., 5., 6.]));
    assert_eq!(straightened(&directory, "b.ply", &binary), expected);
}

/// Vertices of STL are numbered as corners come: those of the file as it was hold.
#[test]
fn faces_are_turned_in_stl() {
    let directory = directory("orient_stl");
    let facet = |n: &str, corners: [&str; 3]| {
        let vertices = corners.map(|corner| format!("vertex {corner}\n")).concat();
        format!("facet normal {n}\nouter loop\n{vertices}endloop\nendfacet\n")
    };
    let [a, b, c, d] = ["0 0 0", "1 0 0", "1 1 0", "0 1 0"];
    let first = facet("0 0 1", [a, b, c]);
    let second = facet("0 0 -1", [a, d, c]);
    let text = format!("solid x\n{first}{second}endsolid x\n");
    fs::write(directory.join("a.stl"), text).unwrap();
    for (from, to) in [("a", "b"), ("b", "c")] {
        let command = format!("fill {from}.stl --orient -q -o {to}.stl");
        run(&directory, &command, 3);
        let binary = fs::read(directory.join(format!("{to}.stl"))).unwrap();
        let numbers: Vec<f32> = binary[134..182]
            .chunks(4)
            .map(|c| f32::from_le_bytes([c[0], c[1], c[2], c[3]]))
            .collect();
        assert_eq!(numbers, [0., 0., 1., 0., 0., 0., 1., 1., 0., 0., 1., 0.]);
    }
}

#[test]
fn a_moebius_strip_is_refused_with_a_face() {
    let directory = directory("moebius");
    // Five rungs, the last one joined to the first upside down; places do not matter.
    let vertices: String = (0..10)
        .map(|i| format!("{} {} {}\n", i / 2, i % 2, (i * i) % 7))
        .collect();
    let faces: String = (0..5)
        .map(|i| {
            let [c, d] = if i < 4 { [2 * i + 2, 2 * i + 3] } else { [1, 0] };
            format!("3 {} {c} {}\n3 {} {c} {d}\n", 2 * i, 2 * i + 1, 2 * i + 1)
        })
        .collect();
    fs::write(
        directory.join("in.off"),
        format!("OFF\n10 10 0\n{vertices}{faces}"),
    )
    .unwrap();
    let (_, err) = run(&directory, "fill in.off --orient -o out.off", 2);
    assert!(
        err.contains("triangle ") && err.contains("one side only"),
        "{err}"
    );
    assert!(!directory.join("out.off").exists());
}
