//! `fairmesh holes`, `fairmesh fill` and `fairmesh fair --remesh` on files.
#![cfg(feature = "cli")]

mod common;

use std::fmt::Write;
use std::fs;

use common::{SIDE, cap, directory, expect, is_selected, obj, off_sphere, quads, write_lists};
use serde_json::Value;

/// The cap without its middle, as text: its vertices with more properties, and all its quads but the selected ones.
fn holed_ply() -> String {
    let mut vertices = String::new();
    let mut used = vec![false; SIDE * SIDE];
    let kept: Vec<_> = (0..quads().len())
        .filter(|&q| !is_selected(q))
        .map(|q| quads()[q])
        .collect();
    kept.iter().flatten().for_each(|&v| used[v] = true);
    let mut number = vec![0; used.len()];
    let mut count = 0;
    for (v, [x, y, z]) in cap().into_iter().enumerate().filter(|(v, _)| used[*v]) {
        number[v] = count;
        count += 1;
        let red = 100 + v % 2;
        let _ = writeln!(vertices, "{x}  {y} {z} 7 {red} 200 0.5");
    }
    let faces: String = kept
        .iter()
        .map(|q| {
            let [a, b, c, d] = q.map(|v| number[v]);
            format!("4 {a} {b} {c} {d} 9\n")
        })
        .collect();
    format!(
        "ply\nformat ascii 1.0\ncomment a cap\nelement vertex {count}\nproperty double x\nproperty double y\n\
         property double z\nproperty int label\nproperty uchar red\nproperty uchar green\nproperty float quality\n\
         element face {}\nproperty list uchar int vertex_indices\nproperty int mark\nelement extra 1\n\
         property int answer\nend_header\n{vertices}{faces}42\n",
        kept.len()
    )
}

#[test]
fn holes_are_listed_and_filled_with_all_other_bytes_kept() {
    let directory = directory("fill_ply");
    let text = holed_ply();
    fs::write(directory.join("in.ply"), &text).unwrap();
    let (out, _) = expect(&directory, &["holes", "in.ply", "--json", "l.json"], 0);
    assert!(out.contains(" hole") && out.contains("outer border"), "{out}");
    let list: Value = serde_json::from_slice(&fs::read(directory.join("l.json")).unwrap()).unwrap();
    assert_eq!(list.as_array().unwrap().len(), 2);
    let hole = usize::from(list[1]["kind"] == "hole");
    assert_eq!(list[1 - hole]["kind"], "outer_border");
    let (out, _) = expect(
        &directory,
        &["fill", "in.ply", "-o", "out.ply", "--json", "r.json"],
        0,
    );
    assert!(out.contains("converged") && out.contains("left open"), "{out}");
    let report: Value = serde_json::from_slice(&fs::read(directory.join("r.json")).unwrap()).unwrap();
    let (vertices, faces) = (
        report["new_vertices"].as_u64().unwrap() as usize,
        report["new_triangles"].as_u64().unwrap() as usize,
    );
    assert!(vertices > 10);
    assert_eq!(report["loops"][hole]["outcome"], "faired");
    // The old lines but for the counts, and new lines behind each table.
    let new = fs::read_to_string(directory.join("out.ply")).unwrap();
    let (old, new): (Vec<&str>, Vec<&str>) = (text.lines().collect(), new.lines().collect());
    let header = old.iter().position(|l| *l == "end_header").unwrap() + 1;
    let count = |line: &str| line.split(' ').nth(2).unwrap().parse::<usize>().unwrap();
    let (old_vertices, old_faces) = (count(old[3]), count(old[11]));
    assert_eq!(count(new[3]), old_vertices + vertices);
    assert_eq!(count(new[11]), old_faces + faces);
    let body = header + old_vertices;
    assert_eq!(old[header..body], new[header..body]);
    assert_eq!(
        old[body..body + old_faces],
        new[body + vertices..body + vertices + old_faces]
    );
    assert_eq!(new.last(), Some(&"42"));
    assert_eq!(new.len(), old.len() + vertices + faces);
    let rows = new[body..body + vertices].iter().map(|line| {
        line.split(' ')
            .map(|w| w.parse::<f64>().unwrap())
            .collect::<Vec<f64>>()
    });
    for row in rows {
        assert_eq!(row.len(), 7);
        assert!(off_sphere(&[[row[0], row[1], row[2]]]) < 1e-4);
        assert_eq!(row[3], 0.0, "a label is not averaged");
        assert!((100.0..=101.0).contains(&row[4]) && row[5] == 200.0 && (row[6] - 0.5).abs() < 1e-6);
    }
    assert!(
        new[body + vertices + old_faces].starts_with("3 ")
            && new[body + vertices + old_faces].ends_with(" 0")
    );
}

#[test]
fn obj_gets_lines_and_other_formats_are_written_anew() {
    let directory = directory("fill_obj");
    // Without two quads in the middle.
    let text = obj(&cap());
    let middle = SIDE / 2;
    let quad = (SIDE - 1) * middle + middle;
    let lines: Vec<&str> = text.lines().collect();
    let first = lines.iter().position(|l| l.starts_with("f ")).unwrap();
    let kept = lines
        .iter()
        .enumerate()
        .filter(|(i, _)| *i != first + quad && *i != first + quad + 1);
    let text: String = kept.map(|(_, l)| format!("{l}\n")).collect();
    fs::write(directory.join("in.obj"), &text).unwrap();
    expect(
        &directory,
        &["fill", "in.obj", "-o", "out.obj", "--no-fair", "-q"],
        0,
    );
    let new = fs::read_to_string(directory.join("out.obj")).unwrap();
    assert!(new.starts_with(&text) && new.len() > text.len());
    for name in ["out.off", "out.stl", "out.ply"] {
        expect(
            &directory,
            &["fill", "in.obj", "-o", name, "--density", "2", "-q"],
            0,
        );
        let (out, _) = expect(&directory, &["holes", name], 0);
        assert!(!out.contains(" hole"), "{out}");
    }
    let (_, err) = expect(&directory, &["fill", "in.obj", "-o", "x.obj", "--loop", "7"], 2);
    assert!(err.contains("7"), "{err}");
    expect(
        &directory,
        &["fill", "in.obj", "-o", "x.obj", "--density", "0"],
        2,
    );
    assert!(!directory.join("x.obj").exists());
}

#[test]
fn a_region_can_be_triangulated_anew_before_it_is_faired() {
    let directory = directory("remesh");
    fs::write(directory.join("in.obj"), obj(&cap())).unwrap();
    write_lists(&directory);
    let args = [
        "fair",
        "in.obj",
        "-o",
        "out.obj",
        "--faces",
        "faces.txt",
        "--remesh",
    ];
    let (out, _) = expect(&directory, &args, 0);
    assert!(out.starts_with("converged"), "{out}");
    let new = fs::read_to_string(directory.join("out.obj")).unwrap();
    let x: Vec<[f64; 3]> = new
        .lines()
        .filter_map(|l| l.strip_prefix("v "))
        .map(|l| {
            let mut words = l.split(' ').map(|w| w.parse().unwrap());
            [(); 3].map(|()| words.next().unwrap())
        })
        .collect();
    assert!(off_sphere(&x) < 1e-3);
}
