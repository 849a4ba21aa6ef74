//! Files as other programs write them: read with nothing else changed, or refused with the cause.

use std::fs;
use std::path::Path;

use crate::common::*;

/// A text in lines, and the flags that select its region.
struct Sample {
    name: &'static str,
    text: String,
    region: [&'static str; 2],
}

fn vertex_lines(end: &str) -> String {
    sheet()
        .iter()
        .map(|[x, y, z]| format!("{x} {y} {z}{end}"))
        .collect()
}

fn face_lines(end: &str) -> String {
    let line = |[a, b, c, d]: &[usize; 4]| format!("4 {a} {b} {c} {d}{end}");
    quads().iter().map(line).collect()
}

fn ply_header() -> String {
    format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        SIDE * SIDE,
        quads().len()
    )
}

fn stl() -> String {
    let positions = sheet();
    let mut text = "solid a cap\n".to_owned();
    for [a, b, c, d] in quads() {
        for corners in [[a, b, c], [a, c, d]] {
            text += "facet normal 0 0 1\nouter loop\n";
            for [x, y, z] in corners.map(|v| positions[v]) {
                text += &format!("vertex {x} {y} {z}\n");
            }
            text += "endloop\nendfacet\n";
        }
    }
    text + "endsolid a cap\n"
}

/// The cap in every format.
fn samples() -> [Sample; 4] {
    let counts = format!("{} {} 0\n", SIDE * SIDE, quads().len());
    let sample = |name, text, region| Sample { name, text, region };
    [
        sample("cap.obj", obj(&sheet()), ["--faces", "faces.txt"]),
        sample(
            "cap.off",
            format!("OFF\n{counts}{}{}", vertex_lines("\n"), face_lines("\n")),
            ["--faces", "faces.txt"],
        ),
        sample(
            "cap.ply",
            ply_header() + &vertex_lines("\n") + &face_lines("\n"),
            ["--faces", "faces.txt"],
        ),
        sample("cap.stl", stl(), ["--faces", "triangles.txt"]),
    ]
}

fn prepared(test: &str) -> std::path::PathBuf {
    let directory = directory(test);
    write_lists(&directory);
    let selected = (0..quads().len()).filter(|&q| is_selected(q));
    let triangles = list(selected.flat_map(|q| [2 * q, 2 * q + 1]));
    fs::write(directory.join("triangles.txt"), triangles).unwrap();
    directory
}

/// What `fair` makes of these bytes.
fn faired(directory: &Path, sample: &Sample, bytes: &[u8]) -> Vec<u8> {
    fs::write(directory.join(sample.name), bytes).unwrap();
    let output = format!("out-{}", sample.name);
    let args = [
        "fair",
        sample.name,
        "-o",
        &output,
        sample.region[0],
        sample.region[1],
        "-q",
    ];
    expect(directory, &args, 0);
    fs::read(directory.join(output)).unwrap()
}

/// Files that are written differently differ in the same way afterwards.
fn check_way(directory: &Path, sample: &Sample, way: impl Fn(&str) -> String) {
    let usual = faired(directory, sample, sample.text.as_bytes());
    assert_ne!(usual, sample.text.as_bytes());
    let odd = faired(directory, sample, way(&sample.text).as_bytes());
    assert!(
        String::from_utf8(odd).unwrap() == way(&String::from_utf8(usual).unwrap()),
        "{}: {:?}...",
        sample.name,
        &way(&sample.text)[..40]
    );
}

#[test]
fn line_ends_of_cr_or_crlf_and_a_mark_of_utf8_hide_nothing() {
    let directory = prepared("line_ends");
    for sample in samples() {
        check_way(&directory, &sample, |text| text.replace('\n', "\r"));
        check_way(&directory, &sample, |text| text.replace('\n', "\r\n"));
        check_way(&directory, &sample, |text| format!("\u{feff}{text}"));
    }
    // Lists, too.
    let sample = &samples()[0];
    let usual = faired(&directory, sample, sample.text.as_bytes());
    let list = fs::read_to_string(directory.join("faces.txt")).unwrap();
    fs::write(
        directory.join("faces.txt"),
        format!("\u{feff}{}", list.replace('\n', "\r")),
    )
    .unwrap();
    assert_eq!(faired(&directory, sample, sample.text.as_bytes()), usual);
}

#[test]
fn stl_is_read_by_its_words() {
    let directory = prepared("stl_words");
    let sample = &samples()[3];
    check_way(&directory, sample, |text| text.replace('\n', " "));
    check_way(&directory, sample, |text| format!("# made by hand\n\n{text}"));
    check_way(&directory, sample, |text| {
        format!("{text}some other program's remark\n")
    });
    check_way(&directory, sample, |text| {
        let text = text
            .replace("solid", "SOLID")
            .replace("facet normal", "FACET NORMAL");
        text.replace("vertex", "VERTEX")
            .replace("outer loop", "OUTER LOOP")
    });
}

#[test]
fn off_and_ply_need_no_line_for_each_row() {
    let directory = prepared("rows");
    let [_, off, ply, _] = samples();
    check_way(&directory, &off, |text| text.replacen("OFF\n", "", 1));
    check_way(&directory, &off, |text| text.replacen("OFF", "off", 1));
    check_way(&directory, &off, |text| text.replace("\n4 ", "\n4\n"));
    check_way(&directory, &off, |text| text.replace('\n', " "));
    let body = |text: &str, way: &dyn Fn(&str) -> String| {
        let at = text.find("end_header\n").unwrap() + 11;
        format!("{}{}", &text[..at], way(&text[at..]))
    };
    check_way(&directory, &ply, |text| {
        body(text, &|rows| rows.replace('\n', " "))
    });
    check_way(&directory, &ply, |text| {
        body(text, &|rows| rows.replace(' ', "\n"))
    });
}

/// The sheet's rows as triangle strips: a strip for each, all in one list. With `ending` "big" or "little" in binary.
fn strips(ending: &str) -> Vec<u8> {
    let at = |row: usize, column: usize| (row * SIDE + column) as i32;
    let mut strip = Vec::new();
    for row in 0..SIDE - 1 {
        strip.extend((0..SIDE).flat_map(|column| [at(row + 1, column), at(row, column)]));
        strip.push(-1);
    }
    let header = ply_header().replace(
        &format!("element face {}\nproperty list uchar", quads().len()),
        "element tristrips 1\nproperty list int",
    );
    if ending == "ascii" {
        let rows = strip.iter().map(|v| format!(" {v}"));
        let rows = rows.collect::<String>();
        let text = format!("{header}{}{}{rows}\n", vertex_lines("\n"), strip.len());
        return text.into_bytes();
    }
    let mut bytes = header
        .replace("ascii", &format!("binary_{ending}_endian"))
        .into_bytes();
    let is_big = ending == "big";
    for x in sheet().into_iter().flatten() {
        bytes.extend(if is_big { x.to_be_bytes() } else { x.to_le_bytes() });
    }
    strip.insert(0, strip.len() as i32);
    for v in strip {
        bytes.extend(if is_big { v.to_be_bytes() } else { v.to_le_bytes() });
    }
    bytes
}

#[test]
fn triangle_strips_are_read_as_the_faces_they_stand_for() {
    let directory = prepared("strips");
    let [_, _, ply, stl] = samples();
    let triangle = |[a, b, c]: [usize; 3]| format!("3 {a} {b} {c}\n");
    let faces = quads()
        .into_iter()
        .flat_map(|[a, b, c, d]| [[d, a, c], [c, a, b]]);
    let faces: String = faces.map(triangle).collect();
    let old = format!("element face {}", quads().len());
    let header = ply_header().replace(&old, &format!("element face {}", 2 * quads().len()));
    let text = format!("{header}{}{faces}", vertex_lines("\n"));
    let sample = Sample {
        region: stl.region,
        ..ply
    };
    let usual = faired(&directory, &sample, text.as_bytes());
    assert!(usual == faired(&directory, &sample, &strips("ascii")));
    let ending_at = |bytes: &[u8]| bytes.windows(11).position(|w| w == b"end_header\n").unwrap() + 11;
    let mut answers = ["little", "big"].map(|ending| faired(&directory, &sample, &strips(ending)));
    let begin = ending_at(&answers[0]);
    let vertices = 24 * SIDE * SIDE;
    for number in answers[1][begin - 3..][..vertices].chunks_exact_mut(8) {
        number.reverse();
    }
    assert!(answers[0][begin..][..vertices] == answers[1][begin - 3..][..vertices]);
    let first: [u8; 8] = answers[0][begin..][..8].try_into().unwrap();
    let line = String::from_utf8_lossy(&usual[ending_at(&usual)..]).into_owned();
    let x: f64 = line.split(' ').next().unwrap().parse().unwrap();
    assert!((f64::from_le_bytes(first) - x).abs() < 1e-12);
}

#[test]
fn new_rows_stand_behind_rows_without_lines() {
    let directory = prepared("fill_rows");
    let kept: Vec<_> = quads()
        .into_iter()
        .enumerate()
        .filter(|(q, _)| !is_selected(*q))
        .collect();
    let faces: String = kept
        .iter()
        .map(|(_, [a, b, c, d])| format!("4 {a} {b} {c} {d} "))
        .collect();
    let header = ply_header().replace(
        &format!("face {}", quads().len()),
        &format!("face {}", kept.len()),
    );
    let text = format!("{header}{} {faces}", vertex_lines(" "));
    fs::write(directory.join("in.ply"), &text).unwrap();
    expect(&directory, &["fill", "in.ply", "-o", "out.ply", "-q"], 0);
    let (out, _) = expect(&directory, &["holes", "out.ply"], 0);
    assert!(!out.contains(" hole") && out.contains("outer boundary"), "{out}");
}

/// A binary STL with these bytes behind its triangles, and this number of triangles in its head.
fn binary_stl(count: impl Fn(u32) -> u32, behind: &[u8]) -> Vec<u8> {
    let positions = sheet();
    let mut bytes = b"solid, though binary".to_vec();
    bytes.resize(80, b' ');
    bytes.extend_from_slice(&count(2 * quads().len() as u32).to_le_bytes());
    for [a, b, c, d] in quads() {
        for corners in [[a, b, c], [a, c, d]] {
            bytes.extend_from_slice(&[0; 12]);
            let values = corners.iter().flat_map(|&v| positions[v]);
            values.for_each(|c| bytes.extend_from_slice(&(c as f32).to_le_bytes()));
            bytes.extend_from_slice(&[0, 0]);
        }
    }
    bytes.extend_from_slice(behind);
    bytes
}

#[test]
fn bytes_behind_the_last_triangle_of_stl_stay() {
    let directory = prepared("stl_behind");
    let sample = &samples()[3];
    let usual = faired(&directory, sample, &binary_stl(|n| n, b""));
    for behind in [&b"made by a scanner"[..], &[0; 100]] {
        let longer = faired(&directory, sample, &binary_stl(|n| n, behind));
        assert_eq!(longer, [&usual, behind].concat());
    }
}

#[test]
fn a_leading_face_of_two_corners_shifts_nothing() {
    let directory = prepared("leading_face");
    let sample = &samples()[0];
    let usual = faired(&directory, sample, sample.text.as_bytes());
    let faces = (0..quads().len()).filter(|&q| is_selected(q)).map(|q| q + 1);
    fs::write(directory.join("faces.txt"), list(faces)).unwrap();
    let first = sample.text.find("f ").unwrap();
    let with_edge = |text: &str| format!("{}f 1 2\n{}", &text[..first], &text[first..]);
    let odd = faired(&directory, sample, with_edge(&sample.text).as_bytes());
    let old = String::from_utf8(usual).unwrap();
    let at = old.find("f ").unwrap();
    assert_eq!(
        String::from_utf8(odd).unwrap(),
        format!("{}f 1 2\n{}", &old[..at], &old[at..])
    );
    // To another format, in which it has no place: the faces are those of the file, and new ones are numbered behind them.
    let args = ["fill", "cap.obj", "-o", "out.off", "-q", "--json", "-"];
    let (out, _) = expect(&directory, &args, 3);
    let report: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!(
        (&report["success"], &report["loops"][0]["success"]),
        (&false.into(), &true.into())
    );
    assert_eq!(
        report["loops"][0]["faces"],
        serde_json::json!([quads().len(), quads().len()])
    );
    let off = fs::read_to_string(directory.join("out.off")).unwrap();
    assert!(off.ends_with(&face_lines("\n")), "{off}");
}

#[test]
fn what_has_no_face_is_refused_and_left_alone() {
    let directory = directory("no_face");
    let mut state = 1u64;
    let random: Vec<u8> = (0..5000)
        .map(|_| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 56) as u8
        })
        .collect();
    let mut no_triangle = vec![b' '; 80];
    no_triangle.extend_from_slice(&[0; 4]);
    let cases: [(&str, &[u8], &str); 10] = [
        ("a.obj", b"", "nothing in this file is a vertex or a face of OBJ"),
        ("b.obj", &[0; 1000], "nothing in this file is a vertex or a face of OBJ"),
        ("c.obj", &random, "nothing in this file"),
        ("d.obj", b"v 0 0 0\nv 1 0 0\nl 1 2\nf 1 2\n", "no face of three corners or more was found"),
        ("e.stl", b"", "this is not an STL file"),
        ("f.stl", &no_triangle, "nothing in this file is a vertex or a face of STL"),
        ("g.stl", b"solid x\nendsolid x\n", "nothing in this file is a vertex"),
        ("h.stl", &random, "triangles take"),
        ("i.off", b"OFF\n1 0 0\n0 0 0\n", "no face of three corners or more was found"),
        ("j.ply", b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
            element face 0\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n", "no face of three corners"),
    ];
    for (name, bytes, why) in cases {
        fs::write(directory.join(name), bytes).unwrap();
        for args in [
            &["fill", name, "-o", name][..],
            &["holes", name],
            &["render", name, "-o", "a.png"],
        ] {
            let (_, err) = expect(&directory, args, 2);
            assert!(
                err.starts_with(&format!("fairmesh: {name}: ")) && err.contains(why),
                "{err}"
            );
        }
        assert_eq!(fs::read(directory.join(name)).unwrap(), bytes);
    }
    assert_eq!(fs::read_dir(&directory).unwrap().count(), cases.len());
}

/// Expects that each of these files is refused, and what is said of it.
fn refused_with_their_causes(test: &str, cases: &[(&str, &[u8], &str)]) {
    let directory = directory(test);
    for (name, bytes, why) in cases {
        fs::write(directory.join(name), bytes).unwrap();
        let (_, err) = expect(&directory, &["holes", name], 2);
        assert!(
            err.starts_with(&format!("fairmesh: {name}:")) && err.contains(why),
            "{err}"
        );
    }
}

#[test]
fn what_is_no_text_of_a_known_format_is_refused_with_its_cause() {
    let utf16: Vec<u8> = "\u{feff}v 0 0 0"
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    let cases: [(&str, &[u8], &str); 7] = [
        (
            "a.ply.gz",
            b"ply",
            "this is not compressed by gzip, as its name says",
        ),
        (
            "a.ply",
            b"\x1f\x8b\x08",
            "this file is compressed (gzip); unpack it first",
        ),
        ("a.stl", b"PK\x03\x04", "this file is compressed (zip)"),
        ("a.obj", &utf16, "this text is encoded as UTF-16"),
        ("mesh", b"", "unknown file format"),
        ("a.glb", b"glTF", "trimesh.load('a.glb', force='mesh')"),
        ("a.vtp", b"<?xml", "pyvista.read('a.vtp').extract_surface()"),
    ];
    refused_with_their_causes("causes-formats", &cases);
}

#[test]
fn what_off_and_ply_have_but_is_not_read_is_refused_with_its_cause() {
    let longer = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 2\n";
    let both = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 0\nproperty list uchar int vertex_indices\nelement tristrips 1\n\
        property list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let beyond = both.replace("element face 0\nproperty list uchar int vertex_indices\n", "");
    let beyond = beyond.replace("3 0 1 2\n", "3 0 1 3\n");
    let cases: [(&str, &[u8], &str); 6] = [
        ("b.off", b"OFF BINARY\n\0\0\0\x03", "binary OFF is not supported"),
        ("c.off", b"4OFF\n1 1 1\n", "'4OFF' is not supported"),
        (
            "d.off",
            b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n-1 0 0\n",
            "the number of corners is -1",
        ),
        (
            "c.ply",
            longer.as_bytes(),
            "this row of element 'face' has more numbers than the header says",
        ),
        (
            "b.ply",
            both.as_bytes(),
            "faces beside triangle strips are not supported",
        ),
        ("d.ply", beyond.as_bytes(), "d.ply:13: a strip names vertex 3"),
    ];
    refused_with_their_causes("causes-rows", &cases);
}

#[test]
fn stl_that_is_not_whole_is_refused_with_its_cause() {
    let no_end = stl().replace("endsolid a cap\n", "");
    let fewer = binary_stl(|n| n - 3, b"");
    let more = binary_stl(|n| n + 1, b"");
    let none = binary_stl(|_| 0, b"");
    let cases: [(&str, &[u8], &str); 5] = [
        ("b.stl", no_end.as_bytes(), "the file ends before 'endsolid'"),
        ("c.stl", &fewer, "triangles take"),
        ("d.stl", &more, "triangles take"),
        (
            "e.stl",
            &none,
            "the number of triangles is 0, but more bytes follow",
        ),
        (
            "f.stl",
            b"hello, this is a letter and no mesh",
            "this is not an STL file",
        ),
    ];
    refused_with_their_causes("causes-stl", &cases);
}

#[test]
fn what_is_piped_without_a_format_is_refused_with_its_cause() {
    let directory = directory("causes-piped");
    // Before the file is read, which is not whole.
    let no_end = stl().replace("endsolid a cap\n", "");
    fs::write(directory.join("b.stl"), no_end).unwrap();
    for args in [&["holes", "-"][..], &["fill", "b.stl", "-o", "-"]] {
        let (_, err) = expect(&directory, args, 2);
        assert!(
            err.contains("-: no name tells the format of what is piped"),
            "{err}"
        );
    }
    assert!(!directory.join("-").exists());
}

#[test]
fn whole_numbers_as_coordinates_are_read_but_not_written_in_place() {
    let directory = directory("whole_numbers");
    let text = "ply\nformat ascii 1.0\nelement vertex 5\nproperty int x\nproperty int y\nproperty int z\n\
        element face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n9 0 0\n9 9 0\n0 9 0\n4 4 3\n\
        3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";
    fs::write(directory.join("in.ply"), text).unwrap();
    fs::write(directory.join("free.txt"), "4\n").unwrap();
    for args in [
        &["fill", "in.ply", "-o", "in.ply"][..],
        &["fair", "in.ply", "-o", "in.ply", "--free", "free.txt"],
    ] {
        let (_, err) = expect(&directory, args, 2);
        assert!(
            err.contains("its coordinates are whole numbers by their type"),
            "{err}"
        );
        assert_eq!(fs::read_to_string(directory.join("in.ply")).unwrap(), text);
    }
    expect(
        &directory,
        &[
            "fill",
            "in.ply",
            "-o",
            "out.off",
            "-q",
            "--loop",
            "0",
            "--no-fair",
        ],
        0,
    );
    let off = fs::read_to_string(directory.join("out.off")).unwrap();
    assert!(off.contains("\n4 4 3\n"), "{off}");
}
