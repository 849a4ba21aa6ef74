//! `fairmesh bridge` and guides of `fairmesh fill`, on files.

use std::fs;
use std::path::Path;

use crate::common::{directory, expect};
use serde_json::Value;

/// A sphere with a hole, and the vertices of the hole's boundary.
fn sphere_with_hole(directory: &Path) -> Vec<u64> {
    let generate = [
        "generate",
        "sphere-hole",
        "--angle",
        "35",
        "--vertices",
        "1500",
        "-o",
        "in.ply",
    ];
    expect(directory, &generate, 0);
    let (list, _) = expect(directory, &["holes", "in.ply", "--json", "-"], 0);
    let list: Value = serde_json::from_str(&list).unwrap();
    let vertices = list[0]["vertices"].as_array().unwrap().iter();
    vertices.map(|v| v.as_u64().unwrap()).collect()
}

fn named(vertices: &[u64]) -> String {
    let names: Vec<String> = vertices.iter().map(u64::to_string).collect();
    names.join(",")
}

#[test]
fn a_hole_is_bridged_and_then_filled() {
    let directory = directory("bridge");
    let hole = sphere_with_hole(&directory);
    let half = hole.len() / 2;
    let (from, to) = (named(&hole[..4]), named(&hole[half..half + 4]));
    let chains = ["--from", &from, "--to", &to];
    let bridge = ["bridge", "in.ply", "-o", "out.ply", "--json", "r.json"];
    let (out, _) = expect(&directory, &[&bridge[..], &chains].concat(), 0);
    assert!(
        out.contains("bridge from 3 edges to 3") && out.contains("converged"),
        "{out}"
    );
    let report: Value = serde_json::from_slice(&fs::read(directory.join("r.json")).unwrap()).unwrap();
    assert_eq!(report["chains"][0].as_array().unwrap().len(), 4);
    assert_eq!(report["strip"]["outcome"], "faired");
    assert!(report["whole"].is_null());
    let (given, made) = ["in.ply", "out.ply"]
        .map(|name| fs::read(directory.join(name)).unwrap())
        .into();
    assert!(made.len() > given.len());
    let (list, _) = expect(&directory, &["holes", "out.ply"], 0);
    assert_eq!(
        list.lines().filter(|line| line.contains("  hole")).count(),
        2,
        "{list}"
    );

    // One vertex at either end and a width, and the rest filled.
    let (from, to) = (named(&hole[..1]), named(&hole[half..=half]));
    let chains = [
        "--from", &from, "--to", &to, "--width", "0.3", "--fill", "--quiet",
    ];
    let bridge = ["bridge", "in.ply", "-o", "whole.off", "--json", "w.json"];
    expect(&directory, &[&bridge[..], &chains].concat(), 0);
    let report: Value = serde_json::from_slice(&fs::read(directory.join("w.json")).unwrap()).unwrap();
    assert_eq!(report["whole"], "converged");
    assert_eq!(report["loops"].as_array().unwrap().len(), 2);
    let (list, _) = expect(&directory, &["holes", "whole.off"], 0);
    assert!(list.contains("the mesh is closed"), "{list}");
}

#[test]
fn a_bridge_that_cannot_be_made_is_refused_by_the_flag_and_nothing_is_written() {
    let directory = directory("no_bridge");
    let hole = sphere_with_hole(&directory);
    let inner = (0..).find(|v| !hole.contains(v)).unwrap();
    let (good, bad) = (named(&hole[..3]), named(&[inner, hole[0]]));
    for (chains, flag, why) in [
        ([&good, &bad], "--to", "it is on no boundary loop"),
        ([&bad, &good], "--from", "it is on no boundary loop"),
        ([&good, &good], "--from", "both chains have it"),
    ] {
        let chains = ["--from", chains[0], "--to", chains[1]];
        let bridge = ["bridge", "in.ply", "-o", "out.ply"];
        let (_, error) = expect(&directory, &[&bridge[..], &chains].concat(), 2);
        assert!(error.contains(flag) && error.contains(why), "{error}");
        assert!(!directory.join("out.ply").exists());
    }
}

#[test]
fn a_guide_is_followed_or_refused_by_its_numbers() {
    let directory = directory("guide");
    let hole = sphere_with_hole(&directory);
    let half = hole.len() / 2;
    let guide = |a: usize, b: usize| named(&[hole[a], hole[b]]);
    let (first, second) = (guide(0, half), guide(3, half - 3));
    let fill = [
        "fill", "in.ply", "-o", "out.ply", "--guide", &first, "--guide", &second,
    ];
    let (out, _) = expect(&directory, &fill, 0);
    assert!(out.contains("converged"), "{out}");
    let crossing = guide(half - 2, half + 2);
    let fill = [
        "fill", "in.ply", "-o", "no.ply", "--guide", &first, "--guide", &crossing,
    ];
    let (_, error) = expect(&directory, &fill, 2);
    assert!(
        error.contains("cross each other") && error.contains(&hole[half + 2].to_string()),
        "{error}"
    );
    let neighbours = guide(4, 5);
    let (_, error) = expect(
        &directory,
        &["fill", "in.ply", "-o", "no.ply", "--guide", &neighbours],
        2,
    );
    assert!(error.contains("neighbours on their loop"), "{error}");
    let (_, error) = expect(&directory, &["fill", "in.ply", "-o", "no.ply", "--guide", "7"], 2);
    assert!(error.contains("12,57"), "{error}");
    assert!(!directory.join("no.ply").exists());
}
