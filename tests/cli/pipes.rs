//! Meshes that are piped, and files packed by gzip.

use std::fs;
use std::io::{Read, Write};
use std::path::Path;
use std::process::{Command, Output, Stdio};

use flate2::Compression;
use flate2::read::MultiGzDecoder;
use flate2::write::GzEncoder;

use crate::common::*;

/// Runs the binary with this as stdin.
fn piped(directory: &Path, args: &[&str], input: &[u8]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_fairmesh"))
        .current_dir(directory)
        .args(args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let (mut stdin, input) = (child.stdin.take().unwrap(), input.to_vec());
    // What is refused is not read to its end.
    let feeding = std::thread::spawn(move || drop(stdin.write_all(&input)));
    let output = child.wait_with_output().unwrap();
    feeding.join().unwrap();
    output
}

fn pack(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

fn unpack(bytes: &[u8]) -> Vec<u8> {
    let mut inner = Vec::new();
    MultiGzDecoder::new(bytes).read_to_end(&mut inner).unwrap();
    inner
}

fn prepared(test: &str) -> std::path::PathBuf {
    let directory = directory(test);
    write_lists(&directory);
    fs::write(directory.join("cap.obj"), obj(&cap())).unwrap();
    directory
}

#[test]
fn a_pipe_has_the_bytes_of_the_file() {
    let directory = prepared("pipe");
    let input = fs::read(directory.join("cap.obj")).unwrap();
    for (name, format) in [
        ("a.obj", "obj"),
        ("a.ply", "ply"),
        ("a.off", "off"),
        ("a.stl", "stl"),
    ] {
        let (report, _) = expect(
            &directory,
            &["fair", "cap.obj", "-o", name, "--faces", "faces.txt"],
            0,
        );
        let args = [
            "fair",
            "-",
            "-o",
            "-",
            "--faces",
            "faces.txt",
            "--format",
            format,
            "--input-format",
            "obj",
        ];
        let output = piped(&directory, &args, &input);
        assert_eq!(output.stdout, fs::read(directory.join(name)).unwrap(), "{name}");
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(told.lines().next(), report.lines().next());
        assert_eq!(output.status.code(), Some(0));
    }
    assert!(!directory.join("-").exists());
}

#[test]
fn every_command_reads_and_writes_pipes() {
    let directory = prepared("pipes");
    let made = piped(
        &directory,
        &["generate", "sphere-hole", "-o", "-", "--format", "ply"],
        b"",
    );
    assert!(made.stdout.starts_with(b"ply\n") && !made.stderr.is_empty());
    let holed = made.stdout;
    let holes = piped(&directory, &["holes", "-", "--format", "ply"], &holed);
    assert!(String::from_utf8(holes.stdout).unwrap().contains("loop "));
    for command in [
        &["fill", "-", "-o", "-", "--format", "ply"][..],
        &[
            "select",
            "-",
            "--format",
            "ply",
            "--halfspace",
            "0,0,0,0,0,1",
            "-o",
            "-",
        ],
    ] {
        let output = piped(&directory, command, &holed);
        let told = String::from_utf8(output.stderr).unwrap();
        assert!(output.stdout.starts_with(b"ply\n"), "{command:?}: {told}");
        assert!(!told.is_empty());
    }
    let picture = piped(
        &directory,
        &["render", "-", "--format", "ply", "-o", "-", "--size", "32x32"],
        &holed,
    );
    assert!(picture.stdout.starts_with(b"\x89PNG"));
    let quiet = [
        "fair",
        "-",
        "-o",
        "-",
        "--format",
        "obj",
        "--faces",
        "faces.txt",
        "-q",
        "--json",
        "r.json",
    ];
    let output = piped(&directory, &quiet, obj(&cap()).as_bytes());
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
    assert!(
        fs::read_to_string(directory.join("r.json"))
            .unwrap()
            .contains("\"outcome\"")
    );
}

#[test]
fn what_makes_no_sense_of_pipes_is_refused() {
    let directory = prepared("pipes_refused");
    let cases: [(&[&str], &str); 6] = [
        (
            &[
                "fair",
                "cap.obj",
                "-o",
                "-",
                "--format",
                "obj",
                "--json",
                "-",
                "--faces",
                "faces.txt",
            ],
            "--json -: stdout is where the mesh goes",
        ),
        (
            &["fair", "cap.obj", "-o", "-"],
            "give --format ply, obj, off or stl",
        ),
        (
            &["fair", "cap.obj", "-o", "a.obj", "--format", "ply"],
            "--format: no mesh",
        ),
        (
            &[
                "fair",
                "cap.obj",
                "-o",
                "-",
                "--format",
                "obj",
                "--input-format",
                "ply",
            ],
            "--input-format: no mesh",
        ),
        (
            &["render", "-", "-", "-o", "a.png", "--format", "obj"],
            "stdin is one mesh",
        ),
        (
            &["holes", "-", "--format", "obj"],
            "-: nothing in this file is a vertex or a face",
        ),
    ];
    for (args, why) in cases {
        let output = piped(&directory, args, b"");
        let told = String::from_utf8(output.stderr).unwrap();
        assert!(told.contains(why), "{args:?}: {told}");
        assert_eq!(
            (output.status.code(), output.stdout.len()),
            (Some(2), 0),
            "{args:?}"
        );
    }
}

/// A mesh that did not arrive is no success.
#[cfg(unix)]
#[test]
fn a_closed_pipe_loses_the_mesh() {
    let directory = prepared("pipe_closed");
    let program = "\"$0\" fair cap.obj -o - --format obj --faces faces.txt 2>told | true; \
        exit \"${PIPESTATUS[0]}\"";
    // The mesh is smaller than what a pipe holds: whether it is lost depends on who is first.
    let run = Command::new("bash")
        .current_dir(&directory)
        .args(["-c", program, env!("CARGO_BIN_EXE_fairmesh")])
        .status();
    let Ok(run) = run else { return };
    let told = fs::read_to_string(directory.join("told")).unwrap();
    let is_lost = told.contains("standard output: cannot write");
    assert_eq!(run.code(), Some(if is_lost { 2 } else { 0 }), "{told}");
}

#[test]
fn packed_files_are_read_and_written() {
    let directory = prepared("packed");
    let plain = fs::read(directory.join("cap.obj")).unwrap();
    let (first, second) = plain.split_at(1000);
    fs::write(directory.join("cap.obj.gz"), pack(&plain)).unwrap();
    fs::write(
        directory.join("parts.OBJ.GZ"),
        [pack(first), pack(second)].concat(),
    )
    .unwrap();
    fs::write(
        directory.join("f.txt.gz"),
        pack(&fs::read(directory.join("faces.txt")).unwrap()),
    )
    .unwrap();
    expect(
        &directory,
        &["fair", "cap.obj", "-o", "a.obj", "--faces", "faces.txt"],
        0,
    );
    let expected = fs::read(directory.join("a.obj")).unwrap();
    for input in ["cap.obj.gz", "parts.OBJ.GZ"] {
        let args = ["fair", input, "-o", "b.obj.gz", "--faces", "f.txt.gz"];
        expect(&directory, &args, 0);
        let packed = fs::read(directory.join("b.obj.gz")).unwrap();
        assert_eq!(unpack(&packed), expected);
        expect(&directory, &args, 0);
        assert_eq!(fs::read(directory.join("b.obj.gz")).unwrap(), packed);
    }
    // Stdin says by its first bytes that it is packed.
    let args = [
        "fair",
        "-",
        "-o",
        "c.obj",
        "--format",
        "obj",
        "--faces",
        "faces.txt",
    ];
    let output = piped(&directory, &args, &pack(&plain));
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(fs::read(directory.join("c.obj")).unwrap(), expected);
}

#[test]
fn damaged_packed_files_are_refused() {
    let directory = prepared("packed_damaged");
    let whole = pack(obj(&cap()).as_bytes());
    let mut wrong = whole.clone();
    let middle = wrong.len() / 2;
    wrong[middle] ^= 0x55;
    let cut = &whole[..whole.len() - 4];
    for (name, bytes, why) in [
        ("cut.obj.gz", cut, "cannot be unpacked: it is cut off"),
        ("wrong.obj.gz", &wrong[..], "cannot be unpacked"),
        ("no.obj.gz", b"v 0 0 0\n", "this is not compressed by gzip"),
        ("mesh.gz", &whole, "use a name ending in .ply.gz"),
        ("mesh.ply.xz", b"", "only those ending in .gz"),
        ("mesh.obj", &whole, "let its name end in .gz"),
    ] {
        fs::write(directory.join(name), bytes).unwrap();
        let (_, err) = expect(&directory, &["holes", name], 2);
        assert!(
            err.starts_with(&format!("fairmesh: {name}: ")) && err.contains(why),
            "{err}"
        );
    }
}
