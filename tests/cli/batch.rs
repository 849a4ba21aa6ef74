//! Several meshes in one run.

use std::fs;

use crate::common::*;

/// A directory with two good meshes, and one that is none between them.
fn prepared(test: &str) -> std::path::PathBuf {
    let directory = directory(test);
    write_lists(&directory);
    fs::create_dir_all(directory.join("scans")).unwrap();
    for name in ["a.obj", "scans/c.obj"] {
        fs::write(directory.join(name), obj(&cap())).unwrap();
    }
    fs::write(directory.join("b.obj"), "no mesh\n").unwrap();
    directory
}

/// The words of the table's row of this file.
fn row<'a>(table: &'a str, name: &str) -> Vec<&'a str> {
    let row = table.lines().find(|line| line.starts_with(name));
    row.unwrap_or_else(|| panic!("no {name} in\n{table}"))
        .split_whitespace()
        .collect()
}

#[test]
fn one_failure_stops_no_other_and_the_worst_decides() {
    let directory = prepared("batch");
    expect(
        &directory,
        &["fair", "a.obj", "-o", "one.obj", "--faces", "faces.txt"],
        0,
    );
    let one = fs::read(directory.join("one.obj")).unwrap();
    let args = [
        "fair",
        "a.obj",
        "b.obj",
        "scans/c.obj",
        "-o",
        "out/new/",
        "--faces",
        "faces.txt",
    ];
    let (table, err) = expect(&directory, &args, 2);
    assert_eq!(row(&table, "a.obj")[1], "converged");
    assert_eq!(row(&table, "b.obj")[1], "refused");
    assert_eq!(row(&table, "scans/c.obj")[1], "converged");
    assert!(
        table.ends_with("3 files: 2 as asked, 0 written with a reservation, 1 not written\n"),
        "{table}"
    );
    assert_eq!(err.lines().count(), 1);
    assert!(err.starts_with("fairmesh: b.obj: nothing in this file"), "{err}");
    for name in ["a.obj", "c.obj"] {
        assert_eq!(fs::read(directory.join("out/new").join(name)).unwrap(), one);
    }
    assert_eq!(fs::read_dir(directory.join("out/new")).unwrap().count(), 2);
    // Errors are told in any case.
    let quiet = [&args[..], &["-q"]].concat();
    let (out, again) = expect(&directory, &quiet, 2);
    assert_eq!((out.as_str(), again), ("", err));
}

#[test]
fn a_reservation_is_worse_than_none_and_better_than_a_refusal() {
    let directory = prepared("batch_worst");
    let few = ["--faces", "faces.txt", "--max-iterations", "1"];
    let args = [&["fair", "a.obj", "scans/c.obj", "-o", "out/"][..], &few].concat();
    let (table, err) = expect(&directory, &args, 3);
    assert!(
        table.contains("2 files: 0 as asked, 2 written with a reservation, 0 not written"),
        "{table}"
    );
    assert_eq!(err, "");
    let args = [&["fair", "a.obj", "b.obj", "-o", "out/"][..], &few].concat();
    expect(&directory, &args, 2);
}

#[test]
fn results_take_the_places_of_their_inputs() {
    let directory = prepared("batch_in_place");
    let before = fs::read(directory.join("a.obj")).unwrap();
    expect(
        &directory,
        &[
            "fair",
            "a.obj",
            "scans/c.obj",
            "--in-place",
            "--faces",
            "faces.txt",
        ],
        0,
    );
    let after = fs::read(directory.join("a.obj")).unwrap();
    assert_ne!(after, before);
    assert_eq!(fs::read(directory.join("scans/c.obj")).unwrap(), after);
    // One mesh is told by its own report.
    let (out, _) = expect(
        &directory,
        &["fair", "a.obj", "--in-place", "--faces", "faces.txt"],
        0,
    );
    assert!(out.contains("free vertices:"), "{out}");
}

#[test]
fn one_mesh_goes_into_a_directory_under_its_name() {
    let directory = prepared("batch_of_one");
    let (out, _) = expect(
        &directory,
        &["fair", "scans/c.obj", "-o", ".", "--faces", "faces.txt"],
        0,
    );
    assert!(
        out.contains("free vertices:") && directory.join("c.obj").exists(),
        "{out}"
    );
}

#[test]
fn holes_of_several_files_are_filled() {
    let directory = prepared("batch_fill");
    for name in ["h1.ply", "h2.ply"] {
        expect(
            &directory,
            &["generate", "sphere-hole", "-o", name, "--angle", "30"],
            0,
        );
    }
    let args = [
        "fill",
        "h1.ply",
        "h2.ply",
        "-o",
        "out/",
        "--json",
        "report.json",
        "-v",
    ];
    let (out, _) = expect(&directory, &args, 0);
    assert!(out.starts_with("h1.ply:\nloop 0, "), "{out}");
    assert_eq!(
        row(out.split("file ").nth(1).unwrap(), "h2.ply")[1..3],
        ["1", "filled"]
    );
    let json: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(directory.join("report.json")).unwrap()).unwrap();
    let files = json["files"].as_array().unwrap();
    assert_eq!(files.len(), 2);
    assert_eq!(files[1]["input"], "h2.ply");
    assert_eq!(files[1]["exit_code"], 0);
    assert_eq!(files[1]["report"]["loops"][0]["index"], 0);
    let (out, _) = expect(
        &directory,
        &["fill", "h1.ply", "b.obj", "-o", "out/", "--json", "-"],
        2,
    );
    let json: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!(json["files"][1]["exit_code"], 2);
    assert!(json["files"][1]["error"].as_str().unwrap().contains("b.obj: "));
}

/// Nothing is lost to another result.
#[test]
fn results_that_would_meet_are_refused_before_the_work() {
    let directory = prepared("batch_meeting");
    fs::write(directory.join("scans/a.obj"), obj(&cap())).unwrap();
    let before = fs::read(directory.join("a.obj")).unwrap();
    let rest = ["--faces", "faces.txt"];
    for (args, why) in [
        (
            &["a.obj", "scans/a.obj", "-o", "out/"][..],
            "a.obj and scans/a.obj would both be written to out/a.obj",
        ),
        (&["a.obj", "./a.obj", "--in-place"], "would both be written"),
        (&["scans/a.obj", "a.obj", "-o", "."], "would both be written"),
        (
            &["a.obj", "scans/c.obj", "-o", "out.obj"],
            "several results need a directory",
        ),
        (&["-", "-o", "out/"], "-: this has no name"),
        (&["-", "--in-place", "--format", "obj"], "stdin ('-') is no place"),
        (&["a.obj", "--in-place", "-o", "out/"], "cannot be used with"),
    ] {
        let args = [&["fair"], args, &rest].concat();
        let (_, err) = expect(&directory, &args, 2);
        assert!(err.contains(why), "{args:?}: {err}");
    }
    assert_eq!(fs::read(directory.join("a.obj")).unwrap(), before);
}

#[cfg(unix)]
#[test]
fn a_link_to_another_input_is_seen() {
    let directory = prepared("batch_links");
    fs::create_dir(directory.join("out")).unwrap();
    std::os::unix::fs::symlink("../scans/c.obj", directory.join("out/a.obj")).unwrap();
    let args = [
        "fair",
        "a.obj",
        "scans/c.obj",
        "-o",
        "out",
        "--faces",
        "faces.txt",
    ];
    let (_, err) = expect(&directory, &args, 2);
    assert!(
        err.contains("scans/c.obj: the result of a.obj would be written over it"),
        "{err}"
    );
}
