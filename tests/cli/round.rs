//! `fairmesh round` on files.

use std::fs;
use std::path::Path;

use crate::common::{directory, expect};
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
    ] {
        let (_, error) = expect(&directory, &[&round[..], flags].concat(), 2);
        assert!(error.contains(said), "{flags:?}: {error}");
        assert!(!directory.join("out.off").exists());
    }
}
