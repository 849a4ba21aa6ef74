//! `fairmesh round` on files.

use std::fs;
use std::path::{Path, PathBuf};

use crate::common::{corners, directory, expect, numbers_of};
use serde_json::Value;

/// A cube of side 2 around the origin.
fn cube(directory: &Path) {
    let faces = [
        "0 2 1", "0 3 2", "4 5 6", "4 6 7", "0 1 5", "0 5 4", "1 2 6", "1 6 5", "2 3 7", "2 7 6", "3 0 4",
        "3 4 7",
    ];
    let corners = ["-1 -1", "1 -1", "1 1", "-1 1"];
    let mut text = format!("OFF\n8 {} 0\n", faces.len());
    for z in ["-1", "1"] {
        corners
            .iter()
            .for_each(|corner| text += &format!("{corner} {z}\n"));
    }
    faces.iter().for_each(|face| text += &format!("3 {face}\n"));
    fs::write(directory.join("cube.off"), text).unwrap();
}

fn report(directory: &Path) -> Value {
    serde_json::from_slice(&fs::read(directory.join("r.json")).unwrap()).unwrap()
}

#[test]
fn all_edges_of_a_cube_or_some_are_rounded() {
    let directory = directory("round");
    cube(&directory);
    let round = ["round", "cube.off", "-o", "out.off", "--json", "r.json"];
    let (text, _) = expect(&directory, &[&round[..], &["--radius", "0.2"]].concat(), 0);
    assert!(text.starts_with("12 of 12 creases rounded"), "{text}");
    let told = report(&directory);
    assert_eq!(told["fairing"]["outcome"], "converged");
    assert_eq!(told["kept_vertices"], 0);
    let (text, _) = expect(
        &directory,
        &[&round[..], &["--width", "0.2", "--edges", "0,1"]].concat(),
        0,
    );
    assert!(text.starts_with("1 of 12 creases rounded"), "{text}");
    let told = report(&directory);
    let chains = told["chains"].as_array().unwrap();
    let rounded: Vec<&Value> = chains.iter().filter(|chain| chain["rounded"] == true).collect();
    assert_eq!(rounded.len(), 1);
    assert!((rounded[0]["bend"].as_f64().unwrap() - 90.0).abs() < 1e-9);
}

#[test]
fn what_cannot_be_rounded_is_refused() {
    let directory = directory("round-refused");
    cube(&directory);
    let round = ["round", "cube.off", "-o", "out.off"];
    for (flags, said) in [
        (&["--width", "0.2", "--creases", "concave"][..], "--angle says"),
        (&["--width", "0"], "width"),
        (&[], "--width"),
        (&["--width", "0.2", "--radius", "0.2"], "--radius"),
        (&["--width", "0.2", "--taper", "0"], "--taper"),
        (
            &["--width", "0.2", "--max-blend-vertices", "100"],
            "--max-blend-vertices",
        ),
    ] {
        let (_, error) = expect(&directory, &[&round[..], flags].concat(), 2);
        assert!(error.contains(said), "{flags:?}: {error}");
        assert!(!directory.join("out.off").exists());
    }
}

/// The corners of a cube of side 2, and its sides, which face outwards.
const CORNERS: [[i32; 3]; 8] = [
    [-1, -1, -1],
    [1, -1, -1],
    [-1, 1, -1],
    [1, 1, -1],
    [-1, -1, 1],
    [1, -1, 1],
    [-1, 1, 1],
    [1, 1, 1],
];
const SIDES: [[usize; 4]; 6] = [
    [0, 2, 3, 1],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 4, 6, 2],
    [1, 3, 7, 5],
];

/// Where in the texture a place on a side lies: its corners are those of the unit square.
fn texture(side: usize, p: &[f64]) -> [f64; 2] {
    let [a, b, _, d] = SIDES[side].map(|v| CORNERS[v].map(f64::from));
    let along = |to: [f64; 3]| (0..3).map(|k| (p[k] - a[k]) * (to[k] - a[k])).sum::<f64>() / 4.0;
    [along(b), along(d)]
}

fn is_on(side: usize, p: &[f64]) -> bool {
    let [a, b, c, _] = SIDES[side].map(|v| CORNERS[v].map(f64::from));
    (0..3).all(|k| a[k] != b[k] || a[k] != c[k] || (p[k] - a[k]).abs() < 1e-12)
}

#[test]
fn parts_of_faces_keep_their_material_group_and_texture_and_blends_are_marked() {
    let directory = directory("round-obj");
    let mut text = String::from("mtllib m.mtl\n");
    let words = |v: [i32; 3]| v.map(|c| c.to_string()).join(" ");
    CORNERS.iter().for_each(|&v| text += &format!("v {}\n", words(v)));
    text += "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    for (side, [a, b, c, d]) in SIDES.map(|of| of.map(|v| v + 1)).iter().enumerate() {
        text += &format!("g side{side}\nusemtl m{side}\nf {a}/1 {b}/2 {c}/3 {d}/4\n");
    }
    fs::write(directory.join("in.obj"), text).unwrap();
    fs::write(directory.join("m.mtl"), "newmtl m0\n").unwrap();
    let round = [
        "round", "in.obj", "-o", "out.obj", "--width", "0.2", "--edges", "0,1", "--mark", "blend",
    ];
    expect(&directory, &[&round[..], &["--json", "r.json"]].concat(), 0);
    let made = fs::read_to_string(directory.join("out.obj")).unwrap();
    let (vertices, textures) = (numbers_of(&made, "v "), numbers_of(&made, "vt "));
    // Only the far sides have nothing to do with the edge, whose ends are gone.
    assert!(made.contains("g side3\nusemtl m3\nf 1/1 5/2 6/3 2/4\n") && made.contains("f 3/1 4/2 6/3 5/4\n"));
    let (mut group, mut side, mut blends, mut parts) = ("", 0, 0, [0; 6]);
    for line in made.lines() {
        match line.split_once(' ') {
            Some(("g", name)) => group = name,
            Some(("usemtl", name)) => side = name[1..].parse().unwrap(),
            Some(("f", face)) => {
                let corners = corners(face);
                if group == "blend" {
                    blends += 1;
                    assert!([0, 2, 4, 5].contains(&side), "{line}");
                    continue;
                }
                parts[side] += 1;
                assert_eq!(group, format!("side{side}"));
                for [v, vt] in corners {
                    let expected = texture(side, &vertices[v]);
                    assert!(is_on(side, &vertices[v]), "{line}");
                    assert!(
                        (0..2).all(|k| (textures[vt][k] - expected[k]).abs() < 1e-12),
                        "{line}"
                    );
                }
            }
            _ => {}
        }
    }
    assert_eq!(blends, report(&directory)["new_triangles"]);
    assert!(
        parts[0] > 1 && parts[2] > 1 && parts[1] == 1 && parts[3] == 1,
        "{parts:?}"
    );
}

#[test]
fn new_faces_are_marked_by_a_property() {
    let directory = directory("round-mark");
    cube(&directory);
    let text = fs::read_to_string(directory.join("cube.off")).unwrap();
    let rows = text.split_once('\n').unwrap().1.split_once('\n').unwrap().1;
    let head = "ply\nformat ascii 1.0\nelement vertex 8\nproperty double x\nproperty double y\nproperty double z\n\
        element face 12\nproperty list uchar int vertex_indices\nend_header\n";
    fs::write(directory.join("in.ply"), format!("{head}{rows}")).unwrap();
    for (name, marked) in [("blend", "1"), ("flags", "32")] {
        let round = [
            "--width", "0.2", "--edges", "0,1", "--json", "r.json", "--mark", name,
        ];
        expect(
            &directory,
            &[&["round", "in.ply", "-o", "out.ply"], &round[..]].concat(),
            0,
        );
        let made = fs::read_to_string(directory.join("out.ply")).unwrap();
        let told = report(&directory);
        let faces: Vec<&str> = made.lines().filter(|line| line.starts_with("3 ")).collect();
        let first = told["first_new_face"].as_u64().unwrap() as usize;
        assert_eq!(faces.len() - first, told["new_triangles"]);
        for (i, face) in faces.iter().enumerate() {
            let is_new = face.split(' ').next_back() == Some(marked);
            assert_eq!(is_new, i >= first, "{face}");
        }
        // Of another format a binary file is made, which tells the same faces.
        expect(
            &directory,
            &[&["round", "cube.off", "-o", "binary.ply"], &round[..]].concat(),
            0,
        );
        let select = ["select", "binary.ply", "-o", "faces.txt", "--selection", name];
        expect(&directory, &select, 0);
        let list = fs::read_to_string(directory.join("faces.txt")).unwrap();
        let selected: Vec<usize> = list
            .split_whitespace()
            .map(|word| word.parse().unwrap())
            .collect();
        assert_eq!(selected, (first..faces.len()).collect::<Vec<usize>>());
    }
    let round = [
        "round", "cube.off", "-o", "out.off", "--width", "0.2", "--mark", "blend",
    ];
    let (_, error) = expect(&directory, &round, 2);
    assert!(error.contains("--mark needs an output in PLY or OBJ"), "{error}");
    let (_, error) = expect(&directory, &[&round[..7], &["two words"]].concat(), 2);
    assert!(error.contains("one word"), "{error}");
}

#[test]
fn two_materials_inside_a_flat_face_meet_where_they_did() {
    let directory = directory("round-materials");
    // A cube from -1 to 1 whose upper face is two, divided where x is 0.
    let mut text = String::new();
    for [x, y, z] in [
        [-1, -1, -1],
        [1, -1, -1],
        [1, 1, -1],
        [-1, 1, -1],
        [-1, -1, 1],
        [1, -1, 1],
        [1, 1, 1],
        [-1, 1, 1],
        [0, -1, 1],
        [0, 1, 1],
    ] {
        text += &format!("v {x} {y} {z}\n");
    }
    text += "usemtl side\nf 4 3 2 1\nf 1 2 6 9 5\nf 2 3 7 6\nf 3 4 8 10 7\nf 4 1 5 8\n";
    text += "usemtl left\nf 5 9 10 8\nusemtl right\nf 9 6 7 10\n";
    fs::write(directory.join("in.obj"), text).unwrap();
    expect(
        &directory,
        &["round", "in.obj", "-o", "out.obj", "--width", "0.2"],
        0,
    );
    let made = fs::read_to_string(directory.join("out.obj")).unwrap();
    let vertices = numbers_of(&made, "v ");
    let (mut material, mut reach) = ("", [f64::NEG_INFINITY; 2]);
    for line in made.lines() {
        match line.split_once(' ') {
            Some(("usemtl", name)) => material = name,
            Some(("f", face)) => {
                let numbers = face.split(' ').map(|v| v.parse::<usize>().unwrap());
                let corners: Vec<&Vec<f64>> = numbers.map(|v| &vertices[v - 1]).collect();
                if corners.iter().all(|p| p[2] == 1.0) {
                    let side = ["left", "right"]
                        .iter()
                        .position(|&name| name == material)
                        .unwrap();
                    let sign = [1.0, -1.0][side];
                    reach[side] = corners.iter().fold(reach[side], |most, p| most.max(sign * p[0]));
                }
            }
            _ => {}
        }
    }
    assert_eq!(reach, [0.0; 2]);
}

/// A cube without attributes, as in.obj.
fn plain_cube(name: &str) -> PathBuf {
    let directory = directory(name);
    let mut text = String::new();
    for [x, y, z] in CORNERS {
        text += &format!("v {x} {y} {z}\n");
    }
    for [a, b, c, d] in SIDES.map(|of| of.map(|v| v + 1)) {
        text += &format!("f {a} {b} {c} {d}\n");
    }
    fs::write(directory.join("in.obj"), text).unwrap();
    directory
}

/// What is said of a rounding of it on stderr.
fn told_of_rounding(directory: &Path, more: &[&str], code: i32) -> String {
    let first = ["round", "in.obj", "-o", "out.obj", "--json", "r.json"];
    expect(directory, &[&first[..], more].concat(), code).1
}

#[test]
fn creases_are_chosen_by_places_and_regions() {
    let directory = plain_cube("round-chosen");
    let ends = |more: &[&str]| -> Vec<Vec<i64>> {
        told_of_rounding(&directory, &[&["--width", "0.2"], more].concat(), 0);
        let told = report(&directory);
        let done = told["chains"].as_array().unwrap().iter();
        let numbers = |of: &Value| {
            of.as_array()
                .unwrap()
                .iter()
                .map(|v| v.as_i64().unwrap())
                .collect()
        };
        let done = done.filter(|chain| chain["rounded"] == true);
        let mut all: Vec<Vec<i64>> = done.map(|chain| numbers(&chain["vertices"])).collect();
        all.iter_mut().for_each(|ends| ends.sort_unstable());
        all
    };
    assert_eq!(ends(&["--near", "0,-1,-1"]), [[0, 1]]);
    assert_eq!(ends(&["--near", "0,-1,-1", "--near", "0,1,1"]), [[0, 1], [6, 7]]);
    // Everything; and a side alone, which has no edge inside.
    assert_eq!(ends(&["--component-at", "0"]).len(), 12);
    let side = ["--width", "0.2", "--halfspace", "0,0,-1,0,0,-1"];
    let told = told_of_rounding(&directory, &side, 2);
    assert!(
        told.contains("no edge that bends enough lies between two of these faces"),
        "{told}"
    );
}

/// The edge between (-1, -1, -1) and (1, -1, -1), from either end.
#[test]
fn a_blend_widens_away_from_the_place_by_which_its_crease_is_chosen() {
    let directory = plain_cube("round-taper");
    for (near, wide) in [("-0.9,-1,-1", 1.0), ("0.9,-1,-1", -1.0)] {
        told_of_rounding(&directory, &["--width", "0.2", "--taper", "2", "--near", near], 0);
        let text = fs::read_to_string(directory.join("out.obj")).unwrap();
        let numbers = |line: &str| -> Vec<f64> { line.split(' ').map(|x| x.parse().unwrap()).collect() };
        let points: Vec<Vec<f64>> = text
            .lines()
            .filter_map(|line| Some(numbers(line.strip_prefix("v ")?)))
            .collect();
        for (end, radius) in [(wide, 0.4), (-wide, 0.2)] {
            let there = points.iter().filter(|p| p[0] == end);
            let nearest = there.map(|p| (p[1] + 1.0).hypot(p[2] + 1.0)).fold(9.0, f64::min);
            let expected = radius * (2_f64.sqrt() - 1.0);
            assert!(
                (nearest / expected - 1.0).abs() < 0.02,
                "{near}, {end}: {nearest}"
            );
        }
    }
}

#[test]
fn too_little_room_is_refused_on_wish() {
    let directory = plain_cube("round-fit");
    told_of_rounding(&directory, &["--width", "0.2", "--fit"], 0);
    let told = told_of_rounding(&directory, &["--width", "3", "--fit"], 2);
    assert!(
        told.contains("12 creases have less room than that") && told.contains("--fit refuses that"),
        "{told}"
    );
}
