//! Regions that are said by place and shape: what is taken, in which order, and what is told where nothing is.

use std::fs;

use crate::common::{SIDE, cap, directory, expect, is_free, off_sphere, quads};
use serde_json::Value;

/// The cap as OBJ, its free vertices red.
fn obj() -> String {
    let colour = |v: usize| if is_free(v) { "1 0 0" } else { "0.2 0.2 0.2" };
    let vertices = cap().into_iter().enumerate();
    let vertices = vertices.map(|(v, [x, y, z])| format!("v {x} {y} {z} {}\n", colour(v)));
    let faces = quads().into_iter();
    let faces = faces.map(|[a, b, c, d]| format!("f {} {} {} {}\n", a + 1, b + 1, c + 1, d + 1));
    vertices.chain(faces).collect()
}

/// The vertices of an OBJ file.
fn vertices(text: &str) -> Vec<[f64; 3]> {
    let lines = text.lines().filter_map(|line| line.strip_prefix("v "));
    let numbers = |line: &str| -> Vec<f64> { line.split(' ').map(|word| word.parse().unwrap()).collect() };
    lines.map(numbers).map(|v| [v[0], v[1], v[2]]).collect()
}

/// The first number in the line of the report that begins so.
fn count(told: &str, begin: &str) -> usize {
    let line = told.lines().find(|line| line.starts_with(begin)).unwrap();
    let words = line[begin.len()..].split_whitespace();
    words.filter_map(|word| word.parse().ok()).next().unwrap()
}

#[test]
fn a_place_is_said_and_shown() {
    let d = directory("a_place_is_said_and_shown");
    fs::write(d.join("cap.obj"), obj()).unwrap();
    let ball = ["select", "cap.obj", "--ball", "0,0,1,0.45"];
    let more = ["-o", "faces.txt", "--picture", "ball.png", "--json", "ball.json"];
    let (told, _) = expect(&d, &[&ball[..], &more].concat(), 0);
    let taken = count(&told, "selected:");
    let list = fs::read_to_string(d.join("faces.txt")).unwrap();
    assert_eq!(list.lines().count(), taken);
    let near = |v: &u32| {
        let [x, y, z] = cap()[*v as usize];
        x * x + y * y + (z - 1.0) * (z - 1.0) <= 0.45 * 0.45
    };
    let whole = quads()
        .into_iter()
        .filter(|quad| quad.iter().all(|&v| near(&(v as u32))));
    assert_eq!(whole.count(), taken);
    let json: Value = serde_json::from_str(&fs::read_to_string(d.join("ball.json")).unwrap()).unwrap();
    assert_eq!(json["faces"].as_array().unwrap().len(), taken);
    assert_eq!(&fs::read(d.join("ball.png")).unwrap()[1..4], b"PNG");
    // Another direction that points up is another picture.
    let turned = ["--picture", "up.png", "--up", "0,1,0", "--view", "1,0,1", "-q"];
    expect(&d, &[&ball[..], &turned].concat(), 0);
    let upright = ["--picture", "upright.png", "--view", "1,0,1", "-q"];
    expect(&d, &[&ball[..], &upright].concat(), 0);
    assert_ne!(
        fs::read(d.join("up.png")).unwrap(),
        fs::read(d.join("upright.png")).unwrap()
    );
    let (_, told) = expect(&d, &[&ball[..], &["--up", "0,1"]].concat(), 2);
    assert!(told.contains("--up 0,1: give x,y,z"), "{told}");
    // The same as a mesh of its own, in both formats.
    for name in ["part.obj", "part.stl"] {
        expect(&d, &[&ball[..], &["-o", name]].concat(), 0);
        let (told, _) = expect(&d, &["select", name, "--ball", "0,0,0,9"], 0);
        let faces = if name == "part.obj" { taken } else { 2 * taken };
        assert_eq!(count(&told, "selected:"), faces);
    }
}

/// The dent is found and taken away, by place, by colour and as a bump.
#[test]
fn what_is_selected_is_faired() {
    let d = directory("what_is_selected_is_faired");
    fs::write(d.join("cap.obj"), obj()).unwrap();
    for region in [
        &["--ball", "0,0,1,0.45"][..],
        &["--color", "255,0,0", "--grow", "2"],
        &["--color", "#ff0000", "--grow", "2"],
        &["--geodesic", "0,0,1,0.5"],
        &["--box", "-0.4,-0.4,0,0.4,0.4,1"],
        &["--bump", "0,0,0.9"],
    ] {
        let fair = ["fair", "cap.obj", "-o", "fair.obj"];
        let (told, _) = expect(&d, &[&fair[..], region].concat(), 0);
        assert!(told.contains(&region[..2].join(" ")), "{told}");
        let off = off_sphere(&vertices(&fs::read_to_string(d.join("fair.obj")).unwrap()));
        assert!(off < 1e-6, "{region:?}: {off}");
    }
    expect(
        &d,
        &[
            "fill",
            "cap.obj",
            "-o",
            "filled.obj",
            "--erase",
            "--ball",
            "0,0,1,0.45",
        ],
        0,
    );
    // Without --erase this might be taken for a choice of holes.
    let (_, told) = expect(
        &d,
        &["fill", "cap.obj", "-o", "no.obj", "--ball", "0,0,1,0.45"],
        2,
    );
    assert!(
        told.contains("--ball 0,0,1,0.45: this names faces; give --erase, too"),
        "{told}"
    );
}

#[test]
fn the_order_of_the_flags_counts() {
    let d = directory("the_order_of_the_flags_counts");
    fs::write(d.join("cap.obj"), obj()).unwrap();
    let taken = |flags: &[&str]| {
        let (told, _) = expect(&d, &[&["select", "cap.obj"], flags].concat(), 0);
        count(&told, "selected:")
    };
    let all = (SIDE - 1) * (SIDE - 1);
    let left = ["--halfspace", "0,0,0,-1,0,0"];
    assert_eq!(taken(&left), all / 2);
    let ball = ["--ball", "0,0,1,0.45"];
    let [alone, half] = [taken(&ball), taken(&[&ball[..], &["--and"], &left].concat())];
    assert_eq!(2 * half, alone);
    assert_eq!(taken(&[&ball[..], &["--without"], &left].concat()), half);
    assert_eq!(taken(&[&ball[..], &left].concat()), all / 2 + alone - half);
    assert_eq!(taken(&[&ball[..], &["--invert"]].concat()), all - alone);
    let grown = taken(&[&ball[..], &["--grow", "1"], &left].concat());
    assert_ne!(grown, taken(&[&ball[..], &left, &["--grow", "1"]].concat()));
    assert_eq!(taken(&["--component-at", "0"]), all);
    assert_eq!(taken(&["--patch-at", "0,0,1,180"]), all);
}

#[test]
fn where_nothing_is_taken_it_is_told_why() {
    let d = directory("where_nothing_is_taken_it_is_told_why");
    fs::write(d.join("cap.obj"), obj()).unwrap();
    for (flags, why) in [
        (
            &["--ball", "5,0,0,1"][..],
            "no face lies in it with all corners; vertex ",
        ),
        (
            &["--box", "5,0,0,6,1,1"],
            "the mesh lies between -0.6000 -0.6000 ",
        ),
        (&["--color", "0,255,0"], "no face is that"),
        (
            &["--component-at", "900"],
            "vertex 900 does not exist; cap.obj has 225 vertices, counted from 0",
        ),
        (
            &["--ball", "0,0,1"],
            "expected X,Y,Z,RADIUS, with commas and without blanks",
        ),
        (
            &["--ball", "0,0,1,2", "--without", "--ball", "0,0,1,2"],
            "nothing is left selected",
        ),
        (
            &["--ball", "0,0,1,2", "--and"],
            "--and: a flag that names a region has to follow",
        ),
        (&["--grow", "1"], "nothing says which vertices may move"),
        (&["--bump", "0.5,0.5,0.7"], "no bump is found there"),
    ] {
        let (_, told) = expect(&d, &[&["select", "cap.obj"], flags].concat(), 2);
        assert!(told.contains(why), "{flags:?}: {told}");
    }
    let (told, _) = expect(&d, &["select", "cap.obj", "--ball", "0,0,1,2"], 0);
    assert!(told.contains("this is the whole mesh"), "{told}");
    // Blanks are as good as commas, if the shell leaves them in.
    let (blanks, _) = expect(&d, &["select", "cap.obj", "--ball", "0 0 1 2"], 0);
    assert_eq!(blanks.replace("0 0 1 2", "0,0,1,2"), told);
}

#[test]
fn a_place_far_from_the_surface_is_told() {
    let d = directory("a_place_far_from_the_surface_is_told");
    fs::write(d.join("cap.obj"), obj()).unwrap();
    let (told, _) = expect(&d, &["select", "cap.obj", "--geodesic", "0,0,5,0.45"], 0);
    let line = "its place is 4.042 from the surface; the nearest point there was taken\n";
    assert!(told.contains(line), "{told}");
    let (told, _) = expect(&d, &["select", "cap.obj", "--geodesic", "0,0,0.91,0.45"], 0);
    assert!(!told.contains("from the surface"), "{told}");
    let (told, _) = expect(&d, &["select", "cap.obj", "--ball", "0,0,1,0.45", "--quiet"], 0);
    assert_eq!(told, "");
}

/// What may have been meant is said: files, properties, numbers below zero.
#[test]
fn errors_propose_what_there_is() {
    let d = directory("errors_propose_what_there_is");
    fs::write(d.join("cap.obj"), obj()).unwrap();
    let refused = |args: &[&str], message: &str| {
        let (_, told) = expect(&d, args, 2);
        assert!(told.contains(message), "{told}");
    };
    refused(
        &["fair", "cup.obj", "-o", "out.obj", "--ball", "0,0,1,0.45"],
        "cup.obj: cannot read: No such file or directory (os error 2); did you mean 'cap.obj'?\n",
    );
    refused(
        &[
            "fair",
            "cap.obj",
            "-o",
            "out.obj",
            "--ball",
            "0,0,1,0.45",
            "--tolerance",
            "-1",
        ],
        "--tolerance -1: it must be at least 1e-15",
    );
    refused(
        &["select", "cap.obj", "--ball", "0,0,1,-1"],
        "the radius -1 is below 0",
    );
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
               property int chosen\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
               0 0 0 1\n1 0 0 0\n0 1 0 0\n3 0 1 2\n";
    fs::write(d.join("one.ply"), ply).unwrap();
    refused(
        &["fair", "one.ply", "-o", "out.ply", "--selection", "choosen"],
        "one.ply: there is no property 'choosen' with one number per vertex or face (only PLY files have them); did you \
         mean 'chosen'?\n",
    );
}

#[test]
fn a_bump_that_is_a_large_part_of_the_mesh_is_told() {
    let d = directory("a_bump_that_is_a_large_part_of_the_mesh_is_told");
    for (radius, is_large) in [("0.1", false), ("0.36", true)] {
        let raise = format!("0,0,1,{radius},0.05");
        let cap = [
            "generate",
            "sphere-cap",
            "--angle",
            "30",
            "--vertices",
            "2000",
            "-q",
        ];
        expect(&d, &[&cap[..], &["-o", "cap.ply", "--raise", &raise]].concat(), 0);
        let (told, _) = expect(&d, &["select", "cap.ply", "--bump", "0,0,1.05"], 0);
        assert_eq!(
            told.contains("this is a large part of the mesh for a bump"),
            is_large,
            "{told}"
        );
    }
}

/// Regions around a place on its flank reach the end of the surface before they have all of it.
#[test]
fn a_bump_near_an_end_is_found_from_its_flank() {
    let directory = directory("bump-from-its-flank");
    let sphere = [
        "generate",
        "sphere-hole",
        "--vertices",
        "5000",
        "--angle",
        "35",
        "-o",
        "bumps.ply",
    ];
    let bumps = [
        "--raise=0.95,0.2,-0.24,0.6,0.4",
        "--raise=-0.5,0.8,-0.33,0.6,-0.35",
        "--raise=-0.2,-0.9,-0.4,0.5,0.3",
    ];
    expect(&directory, &[&sphere[..], &bumps].concat(), 0);
    let select = [
        "select",
        "bumps.ply",
        "-o",
        "faces.txt",
        "--bump",
        "1.1212,0.4195,-0.4344",
    ];
    let (out, _) = expect(&directory, &select, 0);
    // That of the first bump is 0.4.
    let before = out.split(" above the smooth one").next().unwrap_or_default();
    let height = before
        .rsplit(' ')
        .next()
        .and_then(|word| word.parse::<f64>().ok());
    assert!(
        height.is_some_and(|height| (0.396..0.404).contains(&height)),
        "{out}"
    );
}
