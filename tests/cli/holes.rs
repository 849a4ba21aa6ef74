//! `fairmesh holes`, `fairmesh fill` and `fairmesh fair --remesh` on files.

use std::fmt::Write;
use std::fs;
use std::ops::Range;
use std::path::Path;

use crate::common::{
    SIDE, directory, expect, fairmesh, is_selected, obj, off_sphere, quads, sheet, size_of_png, write_lists,
};
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
    for (v, [x, y, z]) in sheet().into_iter().enumerate().filter(|(v, _)| used[*v]) {
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
    assert!(out.contains(" hole") && out.contains("outer boundary"), "{out}");
    let list: Value = serde_json::from_slice(&fs::read(directory.join("l.json")).unwrap()).unwrap();
    assert_eq!(list.as_array().unwrap().len(), 2);
    let hole = usize::from(list[1]["kind"] == "hole");
    assert_eq!(list[1 - hole]["kind"], "outer_boundary");
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
    let text = obj(&sheet());
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
    let few = [
        "fill",
        "in.obj",
        "-o",
        "few.obj",
        "--density",
        "3",
        "--max-iterations",
    ];
    let (out, _) = expect(&directory, &[&few[..], &["1"]].concat(), 3);
    assert!(out.contains("iteration limit"), "{out}");
    let (_, err) = expect(&directory, &[&few[..], &["0"]].concat(), 2);
    assert!(err.contains("--max-iterations 0: it must be at least 1"), "{err}");
}

#[test]
fn a_region_can_be_triangulated_anew_before_it_is_faired() {
    let directory = directory("remesh");
    fs::write(directory.join("in.obj"), obj(&sheet())).unwrap();
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

/// A pole and rings of vertices around the z axis below it, each a radius and a height, as an OBJ of triangles; some of the vertices are free, of
/// which the pole is the first.
fn pole_and_rings(around: usize, rings: &[[f64; 2]], pole: f64, free: Range<usize>, directory: &Path) {
    let mut text = format!("v 0 0 {pole}\n");
    for [radius, z] in rings {
        for i in 0..around {
            let turn = std::f64::consts::TAU * i as f64 / around as f64;
            let _ = writeln!(text, "v {} {} {z}", radius * turn.cos(), radius * turn.sin());
        }
    }
    for i in 0..around {
        let _ = writeln!(text, "f 1 {} {}", 2 + i, 2 + (i + 1) % around);
    }
    for k in 0..around * (rings.len() - 1) {
        let next = k / around * around + (k + 1) % around;
        let [a, b, c, d] = [k, next, next + around, k + around].map(|v| v + 2);
        let _ = writeln!(text, "f {a} {d} {c}\nf {a} {c} {b}");
    }
    fs::write(directory.join("in.obj"), text).unwrap();
    let free: Vec<String> = free.map(|v| v.to_string()).collect();
    fs::write(directory.join("free.txt"), free.join("\n")).unwrap();
}

/// The advice to triangulate anew is given where that has been tried, and holds.
#[test]
fn other_triangles_are_advised_where_they_help() {
    let directory = directory("advice");
    let fair = ["fair", "in.obj", "-o", "out.obj", "--free", "free.txt"];
    // Meridians of a sphere that meet in its pole, at less than a degree.
    let on_sphere = |degrees: f64| [degrees.to_radians().sin(), degrees.to_radians().cos()];
    let cap: Vec<[f64; 2]> = (1..9).map(|k| on_sphere(3.0 * f64::from(k))).collect();
    pole_and_rings(400, &cap, 1.0, 0..801, &directory);
    let (out, _) = expect(&directory, &fair, 3);
    assert!(out.contains("what to do:          give --remesh"), "{out}");
    let (out, _) = expect(&directory, &[&fair[..], &["--remesh"]].concat(), 0);
    assert!(out.starts_with("converged:"), "{out}");
    // No triangles have a harmonic surface between two ends of a tube that are so far from each other.
    let tube: Vec<[f64; 2]> = (0..80).map(|k| [1.0, -0.26 * f64::from(k)]).collect();
    pole_and_rings(24, &tube, 0.5, 1 + 4 * 24..1 + 76 * 24, &directory);
    let (out, _) = expect(&directory, &fair, 3);
    assert!(out.contains("what to do:") && !out.contains("--remesh"), "{out}");
    expect(&directory, &[&fair[..], &["--remesh"]].concat(), 3);
}

/// Texture coordinates that follow the position.
fn texture([x, y, _]: [f64; 3]) -> [f64; 2] {
    [0.5 + 0.5 * x, 0.5 + 0.5 * y]
}

/// The words of a line as numbers.
fn numbers(line: &str) -> Vec<f64> {
    line.split(' ').filter_map(|word| word.parse().ok()).collect()
}

fn near(found: &[f64], position: &[f64]) -> bool {
    let expected = texture([position[0], position[1], position[2]]);
    // Parents are told by the triangulation that the patch was made from, so coordinates follow the place roughly.
    (0..2).all(|k| (found[k] - expected[k]).abs() < 0.05)
}

#[test]
fn obj_gets_colours_and_texture_coordinates_of_the_boundary() {
    let directory = directory("fill_obj_texture");
    let mut text = String::new();
    for [x, y, z] in sheet() {
        let _ = writeln!(text, "v {x} {y} {z} 0.25 {} 1", 0.5 + 0.5 * x);
    }
    for p in sheet() {
        let [u, v] = texture(p);
        let _ = writeln!(text, "vt {u} {v}");
    }
    for (_, q) in quads().iter().enumerate().filter(|(q, _)| !is_selected(*q)) {
        let corners: Vec<String> = q.iter().map(|v| format!("{0}/{0}", v + 1)).collect();
        let _ = writeln!(text, "f {}", corners.join(" "));
    }
    fs::write(directory.join("in.obj"), &text).unwrap();
    expect(&directory, &["fill", "in.obj", "-o", "out.obj", "-q"], 0);
    let new = fs::read_to_string(directory.join("out.obj")).unwrap();
    assert!(new.starts_with(&text));
    let of =
        |kind: &str| -> Vec<Vec<f64>> { new.lines().filter(|l| l.starts_with(kind)).map(numbers).collect() };
    let (vertices, textures) = (of("v "), of("vt "));
    let old = SIDE * SIDE;
    assert!(vertices.len() > old + 10 && textures.len() == vertices.len());
    for row in &vertices[old..] {
        assert!(row.len() == 6 && (row[3] - 0.25).abs() < 1e-9 && (row[5] - 1.0).abs() < 1e-9);
        assert!((row[4] - (0.5 + 0.5 * row[0])).abs() < 0.05, "{row:?}");
    }
    let mut faces = 0;
    for line in new[text.len()..].lines().filter(|l| l.starts_with("f ")) {
        faces += 1;
        for corner in line[2..].split(' ') {
            let (v, t) = corner.split_once('/').unwrap();
            let [v, t] = [v, t].map(|i| i.parse::<usize>().unwrap() - 1);
            assert!(near(&textures[t], &vertices[v]), "{line}");
        }
    }
    assert!(faces > 30);
}

#[test]
fn ply_gets_texture_coordinates_of_wedges() {
    let directory = directory("fill_ply_wedges");
    let kept: Vec<_> = (0..quads().len())
        .filter(|&q| !is_selected(q))
        .map(|q| quads()[q])
        .collect();
    let mut text = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {}\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n",
        SIDE * SIDE,
        kept.len()
    );
    let x = sheet();
    x.iter().for_each(|[x, y, z]| _ = writeln!(text, "{x} {y} {z}"));
    for q in &kept {
        let _ = write!(text, "4 {} {} {} {} 8", q[0], q[1], q[2], q[3]);
        q.iter()
            .flat_map(|&v| texture(x[v]))
            .for_each(|c| _ = write!(text, " {c}"));
        text.push('\n');
    }
    fs::write(directory.join("in.ply"), &text).unwrap();
    expect(&directory, &["fill", "in.ply", "-o", "out.ply", "-q"], 0);
    let new = fs::read_to_string(directory.join("out.ply")).unwrap();
    let rows: Vec<Vec<f64>> = new
        .lines()
        .skip_while(|l| *l != "end_header")
        .skip(1)
        .map(numbers)
        .collect();
    let vertices = rows.iter().take_while(|r| r.len() == 3).count();
    let faces = &rows[vertices + kept.len()..];
    assert!(vertices > SIDE * SIDE + 10 && faces.len() > 30);
    for face in faces {
        assert!(face.len() == 11 && face[0] == 3.0 && face[4] == 6.0, "{face:?}");
        for k in 0..3 {
            assert!(near(&face[5 + 2 * k..7 + 2 * k], &rows[face[1 + k] as usize]));
        }
    }
}

#[test]
fn off_and_stl_are_filled_in_their_own_format() {
    let directory = directory("fill_own_format");
    let lines: Vec<String> = obj(&sheet()).lines().map(str::to_owned).collect();
    let first = lines.iter().position(|l| l.starts_with("f ")).unwrap();
    let kept = lines
        .iter()
        .enumerate()
        .filter(|(i, _)| *i < first || !is_selected(i - first));
    let text: String = kept.map(|(_, l)| format!("{l}\n")).collect();
    fs::write(directory.join("in.obj"), text).unwrap();
    for format in ["off", "stl"] {
        let (cut, filled) = (format!("cut.{format}"), format!("filled.{format}"));
        // Written without a new face, then filled.
        expect(
            &directory,
            &["fill", "in.obj", "-o", &cut, "--max-edges", "3", "-q"],
            0,
        );
        let (out, _) = expect(&directory, &["holes", &cut], 0);
        assert!(out.contains(" hole"), "{out}");
        let (out, _) = expect(&directory, &["fill", &cut, "-o", &filled], 0);
        assert!(out.contains("converged"), "{out}");
        let (out, _) = expect(&directory, &["holes", &filled], 0);
        assert!(!out.contains(" hole") && out.contains("outer boundary"), "{out}");
    }
}

#[test]
fn continuity_of_a_filled_hole_is_told() {
    let directory = directory("fill_continuity");
    fs::write(directory.join("in.ply"), holed_ply()).unwrap();
    let fill = ["fill", "in.ply", "-o", "out.ply"];
    let (out, _) = expect(&directory, &fill, 0);
    assert!(!out.contains("jump of H"), "{out}");
    let (out, _) = expect(&directory, &[&fill[..], &["--continuity", "g2"]].concat(), 0);
    assert!(
        out.contains("\n  loop of vertex ") && out.contains("jump of H"),
        "{out}"
    );
}

/// Two tubes of 16 sides and three rings of edges of length about 0.4, one above the other, and a triangle by itself; `turned`: the faces of the upper
/// one face inwards.
fn two_tubes(turned: bool) -> String {
    let mut text = String::new();
    for z in [0.0, 0.4, 0.8, 1.2, 2.4, 2.8, 3.2, 3.6] {
        for i in 0..16 {
            let (sin, cos) = (f64::from(i) * std::f64::consts::TAU / 16.0).sin_cos();
            let _ = writeln!(text, "v {cos} {sin} {z}");
        }
    }
    text += "v 9 0 0\nv 9.1 0 0\nv 9 0.1 0\n";
    for ring in [0, 1, 2, 4, 5, 6] {
        for i in 0..16 {
            let [a, b] = [16 * ring + i + 1, 16 * ring + (i + 1) % 16 + 1];
            let (c, d) = (b + 16, a + 16);
            let _ = match turned && ring > 3 {
                false => writeln!(text, "f {a} {b} {c}\nf {a} {c} {d}"),
                true => writeln!(text, "f {a} {c} {b}\nf {a} {d} {c}"),
            };
        }
    }
    text + "f 129 130 131\n"
}

#[test]
fn tubes_are_joined_where_they_are_told_to_be_and_where_it_bends_less() {
    let directory = directory("join");
    fs::write(directory.join("in.obj"), two_tubes(false)).unwrap();
    let (out, _) = expect(&directory, &["holes", "in.obj", "--suggest"], 0);
    assert!(
        out.contains("--join 1,2: a gap between parts; together they bend by"),
        "{out}"
    );
    for which in ["1,2", "auto"] {
        let args = [
            "fill", "in.obj", "-o", "out.obj", "--join", which, "--json", "r.json",
        ];
        let (out, _) = expect(&directory, &args, 0);
        assert!(out.contains("loops 1,2 joined, 32 edges: converged"), "{out}");
        let report: Value = serde_json::from_slice(&fs::read(directory.join("r.json")).unwrap()).unwrap();
        let loops = report["loops"].as_array().unwrap();
        let joint = loops
            .iter()
            .find(|of| of["loops"].as_array().unwrap().len() == 2)
            .unwrap();
        assert_eq!(
            (joint["index"].as_u64(), joint["joined"].is_object()),
            (Some(1), which == "auto")
        );
        assert_eq!(loops.len(), if which == "auto" { 4 } else { 1 });
    }
    let (_, err) = expect(
        &directory,
        &["fill", "in.obj", "-o", "out.obj", "--join", "1,9"],
        2,
    );
    assert!(err.contains("--join 9"), "{err}");
    let (_, err) = expect(
        &directory,
        &[
            "fill", "in.obj", "-o", "out.obj", "--join", "0,1", "--join", "1,2",
        ],
        2,
    );
    assert!(err.contains("loop 1 is named twice"), "{err}");
    fs::write(directory.join("turned.obj"), two_tubes(true)).unwrap();
    let (out, _) = expect(
        &directory,
        &["fill", "turned.obj", "-o", "out.obj", "--join", "1,2"],
        3,
    );
    assert!(
        out.contains("loops 1 and 2 fit only if") && out.contains("turn the triangles"),
        "{out}"
    );
}

#[test]
fn holes_are_chosen_by_what_they_are_and_where() {
    let directory = directory("which");
    fs::write(directory.join("in.obj"), two_tubes(false)).unwrap();
    let filled = |flags: &[&str]| {
        let args = [&["fill", "in.obj", "-o", "out.obj", "--json", "-"], flags].concat();
        // Not every patch of so few faces is sound; here it matters which there are.
        let out = fairmesh(&directory, &args).stdout;
        let report: Value = serde_json::from_slice(&out).unwrap();
        let of = report["loops"].as_array().unwrap().iter();
        let filled = of
            .filter(|of| of["outcome"] != "left_open")
            .map(|of| of["index"].as_u64().unwrap());
        (
            filled.collect::<Vec<u64>>(),
            report["dropped_components"].as_u64().unwrap(),
        )
    };
    assert_eq!(filled(&[]), (vec![0, 1, 2, 3], 0));
    assert_eq!(filled(&["--max-length", "1%"]).0, [0; 0]);
    assert_eq!(filled(&["--max-diagonal", "10%"]).0, [0; 0]);
    assert_eq!(filled(&["--max-diagonal", "99%"]).0, [0, 1, 2, 3]);
    let unknown = ["fill", "in.obj", "-o", "out.obj", "--max-diagonal", "5mm"];
    let (_, err) = expect(&directory, &unknown, 2);
    assert!(err.contains("expected a number, or a percentage as 5%"), "{err}");
    assert_eq!(
        filled(&["--drop-components-below", "2", "--loop", "3"]),
        (vec![3], 1)
    );
}

/// Vertices and corners of faces.
fn read_off(text: &str) -> (Vec<Vec<f64>>, Vec<Vec<usize>>) {
    let mut lines = text.lines().skip(1);
    let counts: Vec<usize> = lines
        .next()
        .unwrap()
        .split_whitespace()
        .map(|n| n.parse().unwrap())
        .collect();
    let vertices = lines.by_ref().take(counts[0]).map(numbers).collect();
    let corners = |line: &str| {
        line.split_whitespace()
            .skip(1)
            .map(|v| v.parse().unwrap())
            .collect()
    };
    (vertices, lines.take(counts[1]).map(corners).collect())
}

#[test]
fn a_rough_rim_is_told_and_relaxed() {
    let directory = directory("rim");
    let cap = ["generate", "sphere-hole", "-o", "clean.off", "--vertices", "1500"];
    expect(&directory, &cap, 0);
    let (vertices, faces) = read_off(&fs::read_to_string(directory.join("clean.off")).unwrap());
    // Up and down by about a fifth of an edge, without a pattern.
    let noise = |v: usize| 0.02 * (1.7 * (v * v % 97) as f64).sin();
    let mut text = format!("OFF\n{} {} 0\n", vertices.len(), faces.len());
    for (v, p) in vertices.iter().enumerate() {
        let p: Vec<String> = p.iter().map(|c| (c * (1.0 + noise(v))).to_string()).collect();
        let _ = writeln!(text, "{}", p.join(" "));
    }
    for face in &faces {
        let _ = writeln!(text, "3 {} {} {}", face[0], face[1], face[2]);
    }
    fs::write(directory.join("in.off"), text).unwrap();
    let (out, _) = expect(&directory, &["holes", "clean.off"], 0);
    assert!(!out.contains("is rough"), "{out}");
    let (out, _) = expect(&directory, &["holes", "in.off", "--json", "l.json"], 0);
    assert!(
        out.contains("loop 0 is rough: ") && out.contains("--relax-rim auto"),
        "{out}"
    );
    let list: Value = serde_json::from_slice(&fs::read(directory.join("l.json")).unwrap()).unwrap();
    assert!(list[0]["roughness"]["ratio"].as_f64().unwrap() > 2.0);
    assert_eq!(list[0]["roughness"]["advice"]["relax_rim"], 3);
    let args = [
        "fill",
        "in.off",
        "-o",
        "out.off",
        "--json",
        "r.json",
        "--relax-rim",
        "auto",
    ];
    let (out, _) = expect(&directory, &args, 0);
    assert!(out.contains("vertices moved by"), "{out}");
    let report: Value = serde_json::from_slice(&fs::read(directory.join("r.json")).unwrap()).unwrap();
    let rim = &report["loops"][0]["rim"];
    let (filled, _) = read_off(&fs::read_to_string(directory.join("out.off")).unwrap());
    let (rough, _) = read_off(&fs::read_to_string(directory.join("in.off")).unwrap());
    let moved = (0..rough.len()).filter(|&v| filled[v] != rough[v]).count();
    assert_eq!(rim["moved"], moved);
    assert!(rim["largest"].as_f64().unwrap() <= rim["within"].as_f64().unwrap());
}

#[test]
fn teeth_at_a_hole_are_taken_away_before_it_is_filled() {
    let directory = directory("trim");
    let sphere = ["generate", "sphere-hole", "-o", "clean.off", "--vertices", "1500"];
    expect(&directory, &sphere, 0);
    let (mut vertices, mut faces) = read_off(&fs::read_to_string(directory.join("clean.off")).unwrap());
    let (loops, _) = expect(&directory, &["holes", "clean.off", "--json", "-"], 0);
    let loops: Value = serde_json::from_str(&loops).unwrap();
    let at = |i: usize| loops[0]["vertices"][i].as_u64().unwrap() as usize;
    let (a, b) = (at(0), at(1));
    // Over an edge of the boundary, and out of the sphere.
    let tooth: Vec<f64> = (0..3).map(|k| 0.6 * (vertices[a][k] + vertices[b][k])).collect();
    vertices.push(tooth.clone());
    faces.push(vec![a, b, vertices.len() - 1]);
    let mut text = format!("OFF\n{} {} 0\n", vertices.len(), faces.len());
    for p in &vertices {
        writeln!(text, "{} {} {}", p[0], p[1], p[2]).unwrap();
    }
    for f in &faces {
        writeln!(text, "3 {} {} {}", f[0], f[1], f[2]).unwrap();
    }
    fs::write(directory.join("in.off"), text).unwrap();
    let fill = |more: &[&str]| {
        let command = [
            &["fill", "in.off", "-o", "out.off", "--json", "out.json"][..],
            more,
        ]
        .concat();
        expect(&directory, &command, 0);
        let report: Value =
            serde_json::from_str(&fs::read_to_string(directory.join("out.json")).unwrap()).unwrap();
        let (filled, _) = read_off(&fs::read_to_string(directory.join("out.off")).unwrap());
        (report["trimmed_faces"].as_u64().unwrap(), filled)
    };
    let (trimmed, filled) = fill(&["--trim", "8"]);
    assert!((1..=8).contains(&trimmed));
    assert!(!filled.contains(&tooth));
    let small = ["fill", "in.off", "-o", "no.off", "--trim", "8", "--trim-area=-1"];
    let (_, error) = expect(&directory, &small, 2);
    assert!(error.contains("trim"), "{error}");
}

#[test]
fn a_soup_is_named() {
    let directory = directory("soup");
    let mut text = "OFF\n36 12 0\n".to_owned();
    for k in 0..12 {
        writeln!(text, "{k} 0 0\n{k}.5 0 0\n{k} 1 0").unwrap();
    }
    (0..12).for_each(|k| writeln!(text, "3 {} {} {}", 3 * k, 3 * k + 1, 3 * k + 2).unwrap());
    fs::write(directory.join("soup.off"), text).unwrap();
    let (told, _) = expect(&directory, &["holes", "soup.off"], 0);
    assert!(
        told.contains("12 of 12 loops") && told.contains("--coincident"),
        "{told}"
    );
}

/// The sheet without a quad in its middle, each quad with corners of its own, which are off by up to so many edges; and how many corners.
fn loose_quads(jitter: f64) -> (String, usize) {
    let middle = (SIDE - 1) * (SIDE / 2) + SIDE / 2;
    let edge = 0.8 / (SIDE - 1) as f64;
    let off = |i: usize| jitter * edge * ((i * 7919 % 1000) as f64 / 500.0 - 1.0);
    let (mut vertices, mut faces, mut count) = (String::new(), String::new(), 0);
    for q in (0..quads().len()).filter(|&q| q != middle) {
        for &v in &quads()[q] {
            let [x, y, z] = sheet()[v];
            writeln!(vertices, "{} {} {z}", x + off(2 * count), y + off(2 * count + 1)).unwrap();
            count += 1;
        }
        writeln!(faces, "4 {} {} {} {}", count - 4, count - 3, count - 2, count - 1).unwrap();
    }
    (format!("OFF\n{count} {} 0\n{vertices}{faces}", count / 4), count)
}

/// Corners that agree within much less than an edge, but not to the last bit: what joins them is named, and does.
#[test]
fn a_soup_with_jitter_is_told_what_joins_it() {
    let directory = directory("jitter");
    let run = |command: &str, code: i32| {
        let (out, err) = expect(&directory, &command.split(' ').collect::<Vec<_>>(), code);
        out + &err
    };
    let named =
        |told: &str| told.contains("60 if vertices within 1e-6") && told.contains("--coincident 1e-6");
    for jitter in [1e-9, 1e-7] {
        let (text, corners) = loose_quads(jitter);
        fs::write(directory.join("in.off"), text).unwrap();
        let list: String = (0..corners).map(|v| format!("{v}\n")).collect();
        fs::write(directory.join("all.txt"), list).unwrap();
        fs::write(
            directory.join("faces.txt"),
            "30\n31\n32\n44\n45\n46\n58\n59\n60\n",
        )
        .unwrap();
        for (command, code) in [
            ("holes in.off", 0),
            ("fill in.off -o out.off", 3),
            ("fair in.off --free all.txt -o out.off", 2),
            ("fair in.off --faces faces.txt -o out.off", 2),
        ] {
            let told = run(command, code);
            assert!(named(&told), "{told}");
        }
        let told = run("fill in.off -o out.off --coincident 1e-6", 0);
        assert!(told.contains("triangulated") && !named(&told), "{told}");
        run("fair in.off --faces faces.txt -o out.off --coincident 1e-6", 0);
    }
}

/// A closed mesh and a triangle that has one of its vertices: nothing to fill, and what to do is said.
#[test]
fn faces_that_hang_at_a_vertex_are_named() {
    let directory = directory("hanging");
    let octahedron = "OFF 8 9 0\n1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n0 0 1\n0 0 -1\n2 0 0\n2 1 0\n\
        3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n3 1 0 5\n3 2 1 5\n3 3 2 5\n3 0 3 5\n3 0 6 7\n";
    fs::write(directory.join("in.off"), octahedron).unwrap();
    let (out, _) = expect(&directory, &["holes", "in.off", "--json", "l.json"], 0);
    assert!(
        out.contains("1 faces that hang at the rest of the mesh by single vertices only (vertex 0)"),
        "{out}"
    );
    let list: Value = serde_json::from_slice(&fs::read(directory.join("l.json")).unwrap()).unwrap();
    assert_eq!(list[0]["hangs_at"], 0);
    let (out, _) = expect(&directory, &["fill", "in.off", "-o", "out.off"], 3);
    assert!(out.contains("vertex 0") && out.contains("remove them"), "{out}");
}

/// Two tubes along the z axis, of radius 1, from 0 to 1 and from 3 to 4.
#[test]
fn loops_have_places_and_their_numbers_stand_in_a_picture() {
    let directory = directory("places");
    let count = 24;
    let ring = |z: f64| {
        (0..count).map(move |k| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(count)).sin_cos();
            format!("v {cos} {sin} {z}\n")
        })
    };
    let mut text: String = [0.0, 1.0, 3.0, 4.0].into_iter().flat_map(ring).collect();
    for tube in [0, 2 * count] {
        for k in 0..count {
            let [a, b] = [k, (k + 1) % count].map(|k| tube + k + 1);
            let _ = writeln!(text, "f {a} {b} {} {}", b + count, a + count);
        }
    }
    fs::write(directory.join("tubes.obj"), text).unwrap();
    let listed = ["holes", "tubes.obj", "--picture", "two.png", "--json", "l.json"];
    let (out, _) = expect(&directory, &listed, 0);
    for line in [
        "   1      24   6.26526e0   3.10583e0    90      -  0.000,0.000,1.000,1.000  hole; loop 0 is 1.000 away",
        "turn: degrees by which",
    ] {
        assert!(out.contains(line), "{out}");
    }
    let list: Value = serde_json::from_slice(&fs::read(directory.join("l.json")).unwrap()).unwrap();
    assert_eq!(list[0]["nearest"]["loop"], 1);
    assert!((list[3]["centre"][2].as_f64().unwrap() - 4.0).abs() < 1e-12);
    assert!((list[3]["radius"].as_f64().unwrap() - 1.0).abs() < 1e-12);
    assert_eq!(size_of_png(&directory.join("two.png")), [1440, 720]);
    let one = [
        "holes",
        "tubes.obj",
        "--picture",
        "one.png",
        "--view",
        "top",
        "-q",
    ];
    expect(&directory, &one, 0);
    assert_eq!(size_of_png(&directory.join("one.png")), [720, 720]);
    expect(&directory, &["holes", "tubes.obj", "--view", "top"], 2);
}
