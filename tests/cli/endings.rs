//! How the program ends when the machine has no more room: full devices, limits of files and memory.

use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Output, Stdio};

use crate::common::*;

fn prepared(test: &str) -> std::path::PathBuf {
    let directory = directory(test);
    write_lists(&directory);
    fs::write(directory.join("cap.obj"), obj(&cap())).unwrap();
    directory
}

const FAIR: [&str; 6] = ["fair", "cap.obj", "-o", "out.obj", "--free", "free.txt"];

/// Runs the program with this stdout; returns the exit code and stderr.
fn with_stdout(directory: &Path, args: &[&str], stdout: impl Into<Stdio>) -> (Option<i32>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_fairmesh"))
        .current_dir(directory)
        .args(args)
        .stdout(stdout)
        .stderr(Stdio::piped())
        .output()
        .unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

/// Runs the program in a shell behind this command.
fn behind(directory: &Path, command: &str, args: &[&str]) -> Output {
    Command::new("sh")
        .current_dir(directory)
        .args([
            "-c",
            &format!("{command}; exec \"$0\" \"$@\""),
            env!("CARGO_BIN_EXE_fairmesh"),
        ])
        .args(args)
        .output()
        .unwrap()
}

/// The files in a directory that no command named.
fn left_behind(directory: &Path) -> Vec<String> {
    let names = fs::read_dir(directory)
        .unwrap()
        .map(|entry| entry.unwrap().file_name());
    let names = names.map(|name| name.to_string_lossy().into_owned());
    names.filter(|name| name.starts_with('.')).collect()
}

#[test]
fn a_report_that_cannot_be_written_is_told_with_what_was() {
    let directory = prepared("full_device");
    let full = || File::options().write(true).open("/dev/full").unwrap();
    let told = "fairmesh: standard output: cannot write: No space left on device (os error 28)";
    for args in [
        &["holes", "cap.obj"][..],
        &["--help"],
        &["fair", "-h"],
        &["--version"],
    ] {
        let (code, err) = with_stdout(&directory, args, full());
        assert_eq!((code, err.trim_end()), (Some(5), told));
    }
    for args in [&FAIR[..], &[&FAIR[..], &["--json", "-"]].concat()] {
        let (code, err) = with_stdout(&directory, args, full());
        let told = format!("{told}; the result was written to out.obj");
        assert_eq!((code, err.trim_end()), (Some(5), told.as_str()));
        assert!(fs::metadata(directory.join("out.obj")).unwrap().len() > 1000);
        fs::remove_file(directory.join("out.obj")).unwrap();
    }
    let (_, err) = expect(&directory, &[&FAIR[..], &["--json", "/dev/full"]].concat(), 5);
    let told = "fairmesh: /dev/full: cannot write: No space left on device (os error 28); the result was written to out.obj";
    assert_eq!(err.trim_end(), told);
    // Whoever closes a pipe has read enough.
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let (code, err) = with_stdout(&directory, &["holes", "cap.obj"], writer);
    assert_eq!((code, err.as_str()), (Some(0), ""));
}

#[test]
fn a_report_goes_to_stdout_as_json() {
    let directory = prepared("json_stdout");
    for args in [
        &[&FAIR[..], &["--json", "-"]].concat()[..],
        &["holes", "cap.obj", "--json", "-"],
    ] {
        let (out, err) = expect(&directory, args, 0);
        let _: serde_json::Value = serde_json::from_str(&out).unwrap();
        assert_eq!(err, "");
    }
    assert!(!directory.join("-").exists());
}

#[test]
fn a_file_that_may_not_grow_is_refused_and_nothing_is_left_behind() {
    let directory = prepared("full_disk");
    fs::write(directory.join("out.obj"), "precious").unwrap();
    let output = behind(&directory, "ulimit -f 2", &FAIR);
    let err = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{err}");
    assert_eq!(
        err,
        "fairmesh: out.obj: cannot write: File too large (os error 27)\n"
    );
    assert_eq!(fs::read_to_string(directory.join("out.obj")).unwrap(), "precious");
    assert_eq!(left_behind(&directory), [""; 0]);
}

#[test]
fn memory_that_runs_out_is_told_in_one_line() {
    let directory = directory("memory");
    let mut args = vec![
        "generate",
        "sphere-cap",
        "--vertices",
        "3000",
        "-o",
        "cap.ply",
        "--start",
        "noise",
    ];
    args.extend(["--free", "free.txt", "--normals", "normals.txt"]);
    expect(&directory, &args, 0);
    let mut args = vec!["fair", "cap.ply", "-o", "out.ply", "--threads", "1"];
    args.extend(["--free", "free.txt", "--normals", "normals.txt"]);
    let mut codes = Vec::new();
    for kilobytes in (10_000..40_000).step_by(6_000) {
        let limit = format!("ulimit -v {kilobytes}");
        // The system cannot start a program in no memory at all.
        if !behind(&directory, &limit, &["--version"]).status.success() {
            continue;
        }
        fs::write(directory.join("out.ply"), "precious").unwrap();
        let output = behind(&directory, &limit, &args);
        let err = String::from_utf8(output.stderr).unwrap();
        let code = output.status.code();
        assert!(
            matches!(code, Some(0 | 4)),
            "{kilobytes} kB: {:?}\n{err}",
            output.status
        );
        if code == Some(4) {
            assert_eq!(err.lines().count(), 1, "{err}");
            assert_eq!(fs::read_to_string(directory.join("out.ply")).unwrap(), "precious");
        }
        codes.push(code);
    }
    assert!(codes.contains(&Some(4)), "{codes:?}");
    assert_eq!(left_behind(&directory), [""; 0]);
}

#[test]
fn promises_of_a_header_take_no_memory() {
    let directory = directory("promises");
    let vertex = "property float x\nproperty float y\nproperty float z\n";
    let face = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    let ply =
        |format: &str| format!("ply\nformat {format} 1.0\nelement vertex 4000000000\n{vertex}{face}0 0 0\n");
    let mut stl = vec![b' '; 80];
    stl.extend_from_slice(&4_000_000_000u32.to_le_bytes());
    stl.extend_from_slice(&[0; 50]);
    let list = ply("binary_little_endian")
        .replace("4000000000", "1")
        .replace("uchar int", "uint int");
    let list = [list.trim_end_matches("0 0 0\n").as_bytes(), &[0; 12], &[255; 4]].concat();
    let cases = [
        ("a.ply", ply("ascii").into_bytes()),
        ("b.ply", ply("binary_big_endian").into_bytes()),
        ("c.ply", list),
        ("d.off", b"OFF\n4000000000 1 0\n0 0 0\n".to_vec()),
        ("e.off", b"OFF\n1 1 0\n0 0 0\n4000000000 0 0 0\n".to_vec()),
        ("f.stl", stl),
        ("g.obj", b"v 0 0 0\nf 1 4000000000 2\n".to_vec()),
    ];
    for (name, bytes) in cases {
        fs::write(directory.join(name), bytes).unwrap();
        let output = behind(&directory, "ulimit -v 200000", &["holes", name]);
        let err = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{name}: {err}");
    }
}

#[test]
fn more_threads_than_any_machine_has_are_refused_by_name() {
    let directory = prepared("many_threads");
    for command in [&FAIR[..], &["fill", "cap.obj", "-o", "out.obj"]] {
        let (_, err) = expect(&directory, &[command, &["--threads", "4294967296"]].concat(), 2);
        assert_eq!(err, "fairmesh: --threads 4294967296: it must be at most 1024\n");
    }
    assert!(!directory.join("out.obj").exists());
}
