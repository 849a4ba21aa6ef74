//! `--sharp`: edges that reach the boundary go on.

use std::fs;
use std::path::Path;

use crate::common::*;

/// A roof of 15 by 15 vertices, whose ridge is flattened in the middle.
fn roof(slope: f64) -> String {
    let at = |v: usize| {
        let (x, y) = (v % SIDE, v / SIDE);
        let down = slope * y.abs_diff(7) as f64;
        let is_near = x.abs_diff(7) < 3 && y.abs_diff(7) < 3;
        [x as f64, y as f64, if is_near { -3.0 * slope } else { -down }]
    };
    obj(&(0..SIDE * SIDE).map(at).collect::<Vec<_>>())
}

/// How far the file with the result is off the roof.
fn worst(directory: &Path, slope: f64) -> f64 {
    let out = fs::read_to_string(directory.join("out.obj")).unwrap();
    let off = |line: &str| {
        let p: Vec<f64> = line[2..].split(' ').map(|x| x.parse().unwrap()).collect();
        (slope * (p[1] - 7.0).abs() + p[2]).abs()
    };
    let vertices = out.lines().filter(|line| line.starts_with("v "));
    vertices.map(off).fold(0.0, f64::max)
}

/// A ridge of 11 degrees, marked on both sides of the region, in either direction.
#[test]
fn marked_edges_go_on() {
    let directory = directory("marked");
    fs::write(directory.join("roof.obj"), roof(0.1)).unwrap();
    let args = ["fair", "roof.obj", "-o", "out.obj", "--box", "3,3,-9,11,11,9"];
    let told = |more: &[&str]| expect(&directory, &[&args[..], more].concat(), 0).0;
    assert!(!told(&[]).contains("sharp edges:"));
    assert!(worst(&directory, 0.1) > 0.01);
    for sharp in ["auto", "off"] {
        let text = told(&[
            "--sharp",
            sharp,
            "--marked-edges=105,106,107,108",
            "--marked-edges=119,118,117,116",
        ]);
        assert!(text.contains("goes on through the region"), "{text}");
        assert!(worst(&directory, 0.1) < 1e-6);
    }
    let wrong = expect(&directory, &[&args[..], &["--marked-edges", "3"]].concat(), 2).1;
    assert!(
        wrong.contains("expected numbers of two or more vertices"),
        "{wrong}"
    );
}

#[test]
fn a_ridge_goes_on_and_is_told() {
    let directory = directory("sharp");
    fs::write(directory.join("roof.obj"), roof(1.0)).unwrap();
    let args = ["fair", "roof.obj", "-o", "out.obj", "--box", "3,3,-9,11,11,9"];
    let sharp = |more: &[&str]| expect(&directory, &[&args[..], more].concat(), 0).0;
    let told = sharp(&["--sharp", "auto", "--json", "report.json"]);
    let line = told.lines().find(|line| line.contains("sharp edges:")).unwrap();
    assert!(
        line.contains("(90.00 degrees)") && line.contains("goes on through the region"),
        "{line}"
    );
    let json: serde_json::Value =
        serde_json::from_slice(&fs::read(directory.join("report.json")).unwrap()).unwrap();
    let edge = &json["sharp_edges"][0];
    assert_eq!(edge["fate"], "goes_on");
    assert_eq!(edge["ends"].as_array().unwrap().len(), 2);
    assert!(worst(&directory, 1.0) < 1e-6);
    for none in [["--sharp", "off"], ["--sharp", "120"]] {
        assert!(!sharp(&none).contains("sharp edges:"), "{none:?}");
    }
}
