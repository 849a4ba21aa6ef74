//! `fairmesh fill --erase`: what stays of the file, and what new faces take over from those that are gone.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use crate::common::{
    SIDE, cap, corners, directory, expect, is_free, is_selected, lines_of, numbers, numbers_of, off_sphere,
    quads, write_lists,
};
use serde_json::Value;

/// The cap as PLY: red and quality of every vertex, mark and quality of every face. `extra` stands behind.
fn ply(extra: bool) -> String {
    let mut text = format!(
        "ply\nformat ascii 1.0\ncomment kept\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         property uchar red\nproperty float quality\nelement face {}\nproperty list uchar int vertex_indices\n\
         property int mark\n",
        SIDE * SIDE,
        quads().len()
    );
    text += if extra {
        "element extra 1\nproperty int answer\nend_header\n"
    } else {
        "end_header\n"
    };
    for (v, [x, y, z]) in cap().into_iter().enumerate() {
        let red = if is_free(v) { 240 } else { 10 };
        let _ = writeln!(text, "{x} {y} {z}  {red} {}", 10.0 * x);
    }
    for (q, [a, b, c, d]) in quads().into_iter().enumerate() {
        let _ = writeln!(text, "4 {a} {b} {c} {d}  {}", if is_selected(q) { 7 } else { 1 });
    }
    text + if extra { "42\n" } else { "" }
}

/// Lines of vertices and of faces.
fn rows(text: &str) -> (Vec<&str>, Vec<&str>) {
    let (header, body) = text.split_once("end_header\n").unwrap();
    let count = |name: &str| -> usize {
        let line = header.lines().find_map(|line| line.strip_prefix(name)).unwrap();
        line.trim().parse().unwrap()
    };
    let lines: Vec<&str> = body.lines().collect();
    let (vertices, faces) = (count("element vertex"), count("element face"));
    (
        lines[..vertices].to_vec(),
        lines[vertices..vertices + faces].to_vec(),
    )
}

fn fill(directory: &Path, input: &str, output: &str, more: &[&str]) -> String {
    write_lists(directory);
    let fill = ["fill", input, "-o", output, "--erase", "faces.txt"];
    expect(directory, &[&fill[..], more].concat(), 0);
    fs::read_to_string(directory.join(output)).unwrap()
}

#[test]
fn all_but_what_is_erased_keeps_its_rows() {
    let directory = directory("erase_ply");
    let given = ply(false);
    fs::write(directory.join("in.ply"), &given).unwrap();
    let made = fill(&directory, "in.ply", "out.ply", &[]);
    let (before, after) = (rows(&given), rows(&made));
    let kept: Vec<&str> = (0..SIDE * SIDE)
        .filter(|&v| !is_free(v))
        .map(|v| before.0[v])
        .collect();
    assert_eq!(after.0[..kept.len()], kept);
    let faces: Vec<&str> = (0..quads().len())
        .filter(|&q| !is_selected(q))
        .map(|q| before.1[q])
        .collect();
    for (now, then) in after.1.iter().zip(&faces) {
        let (now, then) = (numbers(now), numbers(then));
        for k in 1..5 {
            assert_eq!(after.0[now[k] as usize], before.0[then[k] as usize]);
        }
        assert_eq!((now[0], now[5]), (then[0], then[5]));
    }
    assert!(made.contains("comment kept\n"));
    let x: Vec<[f64; 3]> = after.0[kept.len()..]
        .iter()
        .map(|row| [0, 1, 2].map(|k| numbers(row)[k]))
        .collect();
    assert!(x.len() > 10 && off_sphere(&x) < 1e-4, "{}", off_sphere(&x));
    // Without being asked, what is new takes its attributes from around the hole.
    assert!(after.0[kept.len()..].iter().all(|row| numbers(row)[3] == 10.0));
    assert!(after.1[faces.len()..].iter().all(|row| numbers(row)[4] == 0.0));

    // Rows of other elements may name vertices: all of them stay.
    fs::write(directory.join("more.ply"), ply(true)).unwrap();
    let made = fill(&directory, "more.ply", "out.ply", &[]);
    assert!(made.ends_with("\n42\n"));
    assert_eq!(rows(&made).0[..SIDE * SIDE], rows(&ply(true)).0);
    assert_eq!(rows(&made).1[..faces.len()], faces);
}

#[test]
fn what_is_new_takes_over_what_was_there() {
    let directory = directory("carry_over");
    fs::write(directory.join("in.ply"), ply(false)).unwrap();
    let made = fill(&directory, "in.ply", "out.ply", &["--carry-over"]);
    let (vertices, faces) = rows(&made);
    let kept = SIDE * SIDE - (0..SIDE * SIDE).filter(|&v| is_free(v)).count();
    let step = 1.2 / (SIDE - 1) as f64;
    for row in &vertices[kept..] {
        let row = numbers(row);
        assert!(
            row[3] >= 10.0 && (row[4] - 10.0 * row[0]).abs() < 10.0 * step,
            "{row:?}"
        );
        // Well inside, where the vertices that are gone are all the same.
        if row[0].abs().max(row[1].abs()) < 1.4 * step {
            assert_eq!(row[3], 240.0, "{row:?}");
        }
    }
    let new = faces.iter().filter(|row| row.starts_with('3'));
    assert!(new.clone().count() > 30);
    assert!(new.into_iter().all(|row| numbers(row)[4] == 7.0));
    let (_, error) = expect(&directory, &["fill", "in.ply", "-o", "no.ply", "--carry-over"], 2);
    assert!(error.contains("--erase"), "{error}");
}

/// The cap as OBJ with texture coordinates: (x, y) on the left half and 5 more on the right one. Red is by x, blue a half.
fn two_charts() -> String {
    let mut text = String::from("# two charts\nmtllib a.mtl\n");
    for [x, y, z] in cap() {
        let _ = writeln!(text, "v {x} {y} {z} {} 0 0.5", 0.5 + 0.5 * x);
    }
    for shift in [0.0, 5.0] {
        for [x, y, _] in cap() {
            let _ = writeln!(text, "vt {} {y}", x + shift);
        }
    }
    text += "g all\n";
    for [a, b, c, d] in quads() {
        let shift = if a % SIDE < SIDE / 2 { 1 } else { 1 + SIDE * SIDE };
        let corners = [a, b, c, d].map(|v| format!("{}/{}", v + 1, v + shift));
        let _ = writeln!(text, "f {}", corners.join(" "));
    }
    text
}

#[test]
fn texture_coordinates_are_carried_over_on_either_side_of_a_seam() {
    let directory = directory("carry_texture");
    fs::write(directory.join("in.obj"), two_charts()).unwrap();
    let made = fill(&directory, "in.obj", "out.obj", &["--carry-over"]);
    let (vertices, textures) = (numbers_of(&made, "v "), numbers_of(&made, "vt "));
    let kept = SIDE * SIDE - (0..SIDE * SIDE).filter(|&v| is_free(v)).count();
    for v in &vertices[kept..] {
        assert!(
            (v[3] - (0.5 + 0.5 * v[0])).abs() < 0.05 && (v[5] - 0.5).abs() < 1e-12,
            "{v:?}"
        );
    }
    let new = &lines_of(&made, "f ")[quads().len() - 36..];
    let mut textured = [0, 0];
    for face in new.iter().filter(|face| face.contains('/')) {
        let corners = corners(face);
        let charts: Vec<usize> = corners
            .iter()
            .map(|c| usize::from(textures[c[1]][0] > 2.0))
            .collect();
        assert!(charts.windows(2).all(|pair| pair[0] == pair[1]), "{face}");
        textured[charts[0]] += 1;
        for [v, vt] in corners {
            let u = textures[vt][0] - 5.0 * charts[0] as f64;
            assert!((u - vertices[v][0]).abs() < 0.06 && (textures[vt][1] - vertices[v][1]).abs() < 0.06);
        }
    }
    println!("{} new faces, {textured:?} textured", new.len());
    assert!(
        textured.iter().all(|&count| 4 * count > new.len()),
        "{textured:?}"
    );
    textured_faces_stay(&made);
}

/// The faces of the file name the same points as before, and the lines around them are there.
fn textured_faces_stay(made: &str) {
    let (before, after) = (two_charts(), lines_of(made, "f "));
    let (before, vertices) = (lines_of(&before, "f "), numbers_of(made, "v "));
    let stay = (0..quads().len()).filter(|&q| !is_selected(q));
    for (q, now) in stay.zip(after) {
        for ([v, vt], [old, same]) in corners(now).into_iter().zip(corners(before[q])) {
            assert_eq!(vt, same);
            let [x, y, _] = cap()[old];
            assert_eq!(vertices[v][..2], [x, y]);
        }
    }
    assert!(made.starts_with("# two charts\nmtllib a.mtl\n") && made.contains("g all\n"));
}

#[test]
fn dropping_components_leaves_the_rows_of_the_others() {
    let directory = directory("drop_rows");
    let given = ply(false)
        .replace("element vertex 225", "element vertex 228")
        .replace("element face 196", "element face 197");
    let (head, faces) = given.split_at(given.find("4 0 1 16 15").unwrap());
    let given = format!("{head}8 8 8  1 1\n9 8 8  1 1\n8 9 8  1 1\n{faces}3 225 226 227  5\n");
    fs::write(directory.join("in.ply"), &given).unwrap();
    let fill = [
        "fill",
        "in.ply",
        "-o",
        "out.ply",
        "--drop-components-below",
        "2",
        "--max-edges",
        "3",
        "--json",
        "r.json",
    ];
    expect(&directory, &fill, 0);
    let made = fs::read_to_string(directory.join("out.ply")).unwrap();
    assert_eq!(made, ply(false));
    let report: Value = serde_json::from_slice(&fs::read(directory.join("r.json")).unwrap()).unwrap();
    assert_eq!(report["dropped_components"], 1);
}
