//! Materials and textures that a mesh names, from wherever it is written.

use std::fs;
use std::path::Path;

use crate::common::*;

/// `in/cap.obj` with a material library, and a folder beside.
fn prepared(test: &str, head: &str) -> std::path::PathBuf {
    let directory = directory(test);
    write_lists(&directory);
    for folder in ["in/sub", "out/deep"] {
        fs::create_dir_all(directory.join(folder)).unwrap();
    }
    for file in ["in/a.mtl", "in/sub/b.mtl", "in/two words.mtl"] {
        fs::write(directory.join(file), "newmtl red\n").unwrap();
    }
    fs::write(directory.join("in/cap.obj"), head.to_owned() + &obj(&cap())).unwrap();
    directory
}

/// The first line of the cap, faired to this file; and what was told.
fn faired(directory: &Path, output: &str) -> (String, String) {
    let args = ["fair", "in/cap.obj", "-o", output, "--faces", "faces.txt"];
    let (told, _) = expect(directory, &args, 0);
    let text = fs::read_to_string(directory.join(output)).unwrap();
    (text.lines().next().unwrap().to_owned(), told)
}

#[test]
fn libraries_are_found_from_another_folder() {
    let head = "mtllib a.mtl sub/b.mtl none.mtl /tmp/x.mtl\nusemtl red\n";
    let directory = prepared("references", head);
    let (line, told) = faired(&directory, "in/other.obj");
    assert_eq!(line, "mtllib a.mtl sub/b.mtl none.mtl /tmp/x.mtl");
    assert!(!told.contains("mtl"), "{told}");
    let (line, told) = faired(&directory, "out/deep/cap.obj");
    assert_eq!(
        line,
        "mtllib ../../in/a.mtl ../../in/sub/b.mtl none.mtl /tmp/x.mtl"
    );
    assert!(told.contains("it names a.mtl as ../../in/a.mtl now"), "{told}");
    assert!(
        told.contains("the file none.mtl, which was not found beside the input"),
        "{told}"
    );
    assert!(directory.join("out/deep/../../in/sub/b.mtl").exists());
    let (line, _) = faired(&directory, "cap.obj");
    assert_eq!(line, "mtllib in/a.mtl in/sub/b.mtl none.mtl /tmp/x.mtl");
    // Nothing else of the file is another one.
    let text = |name: &str| fs::read_to_string(directory.join(name)).unwrap();
    let rest = |name: &str| text(name).split_once('\n').unwrap().1.to_owned();
    assert_eq!(rest("cap.obj"), rest("in/other.obj"));
}

#[test]
fn a_name_of_two_words_is_one_file() {
    let directory = prepared("references_words", "mtllib two words.mtl\n");
    assert_eq!(faired(&directory, "out/cap.obj").0, "mtllib ../in/two words.mtl");
}

#[test]
fn the_reader_of_a_pipe_is_told_where_files_are() {
    let directory = prepared("references_pipe", "mtllib a.mtl\n");
    let args = [
        "fair",
        "in/cap.obj",
        "-o",
        "-",
        "--format",
        "obj",
        "--faces",
        "faces.txt",
    ];
    let (out, err) = expect(&directory, &args, 0);
    assert!(out.starts_with("mtllib a.mtl\n"));
    assert!(err.contains("it names the file a.mtl, which lies in "), "{err}");
}

#[test]
fn fill_and_select_lead_there_too() {
    let directory = prepared("references_others", "mtllib a.mtl\n");
    let args = [
        "fill",
        "in/cap.obj",
        "-o",
        "out/f.obj",
        "--erase",
        "faces.txt",
        "--json",
        "r.json",
    ];
    expect(&directory, &args, 0);
    let json = fs::read_to_string(directory.join("r.json")).unwrap();
    assert!(json.contains("it names a.mtl as ../in/a.mtl now"), "{json}");
    let ball = ["select", "in/cap.obj", "--ball", "0,0,1,0.5", "-o", "out/s.obj"];
    let (told, _) = expect(&directory, &ball, 0);
    assert!(told.contains("it names a.mtl as ../in/a.mtl now"), "{told}");
    for name in ["out/f.obj", "out/s.obj"] {
        let text = fs::read_to_string(directory.join(name)).unwrap();
        assert!(text.contains("mtllib ../in/a.mtl\n"), "{name}");
    }
}

#[test]
fn textures_of_ply_are_found_from_another_folder() {
    let directory = prepared("references_ply", "");
    expect(
        &directory,
        &["generate", "sphere-cap", "-o", "in/s.ply", "--free", "free.txt"],
        0,
    );
    // A binary file, whose header is a text.
    let mut bytes = fs::read(directory.join("in/s.ply")).unwrap();
    let at = bytes
        .windows(14)
        .position(|word| word == b"element vertex")
        .unwrap();
    bytes.splice(at..at, *b"comment TextureFile my skin.png\n");
    fs::write(directory.join("in/s.ply"), bytes).unwrap();
    fs::write(directory.join("in/my skin.png"), "").unwrap();
    let args = ["fair", "in/s.ply", "-o", "out/s.ply", "--free", "free.txt"];
    expect(&directory, &args, 0);
    let bytes = fs::read(directory.join("out/s.ply")).unwrap();
    let header = String::from_utf8_lossy(&bytes);
    assert!(
        header.contains("\ncomment TextureFile ../in/my skin.png\nelement vertex"),
        "{}",
        &header[..300]
    );
}
