//! `--sharp`: edges that reach the boundary go on.

use std::fs;

use crate::common::*;

/// A roof of 15 by 15 vertices, whose ridge is flattened in the middle.
fn roof() -> String {
    let at = |v: usize| {
        let (x, y) = (v % SIDE, v / SIDE);
        let down = y.abs_diff(7) as f64;
        let is_near = x.abs_diff(7) < 3 && y.abs_diff(7) < 3;
        [x as f64, y as f64, if is_near { -3.0 } else { -down }]
    };
    obj(&(0..SIDE * SIDE).map(at).collect::<Vec<_>>())
}

#[test]
fn a_ridge_goes_on_and_is_told() {
    let directory = directory("sharp");
    fs::write(directory.join("roof.obj"), roof()).unwrap();
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
    let out = fs::read_to_string(directory.join("out.obj")).unwrap();
    let off = |line: &str| {
        let p: Vec<f64> = line[2..].split(' ').map(|x| x.parse().unwrap()).collect();
        ((p[1] - 7.0).abs() + p[2]).abs()
    };
    let worst = out
        .lines()
        .filter(|line| line.starts_with("v "))
        .map(off)
        .fold(0.0, f64::max);
    assert!(worst < 1e-6, "{worst}");
    for none in [["--sharp", "off"], ["--sharp", "120"]] {
        assert!(!sharp(&none).contains("sharp edges:"), "{none:?}");
    }
}
