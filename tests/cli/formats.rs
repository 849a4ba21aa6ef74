//! Every format through the binary: the cap becomes a sphere again, and nothing else changes.

use std::fs;

use crate::common::*;

/// The completed cap is this near the sphere.
const NEAR: f64 = 1e-4;

/// Checks that two texts differ in the numbers 1 to 3 of the lines of free vertices only; returns the new
/// positions. `first` is the line of vertex 0, `skip` the words before the coordinates.
fn compare(old: &str, new: &str, first: usize, skip: usize) -> Vec<[f64; 3]> {
    assert_eq!(old.split('\n').count(), new.split('\n').count());
    let mut positions = Vec::new();
    for (number, (a, b)) in old.split('\n').zip(new.split('\n')).enumerate() {
        let Some(v) = number.checked_sub(first).filter(|&v| v < SIDE * SIDE) else {
            assert_eq!(a, b);
            continue;
        };
        let words: Vec<&str> = b.split(' ').collect();
        positions.push([0, 1, 2].map(|axis| words[skip + axis].parse().unwrap()));
        if is_free(v) {
            let mut old: Vec<&str> = a.split(' ').collect();
            old[skip..skip + 3].copy_from_slice(&words[skip..skip + 3]);
            assert_eq!(old.join(" "), b);
        } else {
            assert_eq!(a, b);
        }
    }
    positions
}

#[test]
fn obj() {
    let directory = directory("obj");
    write_lists(&directory);
    let old = crate::common::obj(&cap())
        .replace("# cap\n", "# cap\ng a b\n")
        .replace('\n', " \r\n");
    fs::write(directory.join("cap.obj"), &old).unwrap();
    expect(
        &directory,
        &["fair", "cap.obj", "-o", "out.obj", "--faces", "faces.txt"],
        0,
    );
    let positions = compare(
        &old,
        &fs::read_to_string(directory.join("out.obj")).unwrap(),
        2,
        1,
    );
    assert!(off_sphere(&positions) < NEAR);
    // The same vertices are free, however they are named; the input may be overwritten.
    expect(
        &directory,
        &[
            "fair", "cap.obj", "-o", "cap.obj", "--free", "free.txt", "--quiet",
        ],
        0,
    );
    assert_eq!(
        fs::read(directory.join("cap.obj")).unwrap(),
        fs::read(directory.join("out.obj")).unwrap()
    );
}

#[test]
fn off_with_colours() {
    let directory = directory("off");
    write_lists(&directory);
    let mut old = format!("COFF\n# cap\n{} {} 0\n", SIDE * SIDE, quads().len());
    cap()
        .iter()
        .for_each(|[x, y, z]| old += &format!("{x} {y} {z} 255 0 0 255\n"));
    quads()
        .iter()
        .for_each(|[a, b, c, d]| old += &format!("4 {a} {b} {c} {d} 1.0 0.5 0\n"));
    fs::write(directory.join("cap.off"), &old).unwrap();
    expect(
        &directory,
        &["fair", "cap.off", "-o", "out.off", "--faces", "faces.txt"],
        0,
    );
    let positions = compare(
        &old,
        &fs::read_to_string(directory.join("out.off")).unwrap(),
        3,
        0,
    );
    assert!(off_sphere(&positions) < NEAR);
}

#[test]
fn ascii_ply_with_a_selection() {
    let directory = directory("ascii_ply");
    let mut old = format!(
        "ply\nformat ascii 1.0\ncomment cap\nelement vertex {}\nproperty double x\nproperty double y\n\
         property double z\nproperty uchar red\nproperty uchar chosen\nelement face {}\n\
         property list uchar int vertex_indices\nproperty int flags\nend_header\n",
        SIDE * SIDE,
        quads().len()
    );
    let first = old.lines().count();
    cap()
        .iter()
        .enumerate()
        .for_each(|(v, [x, y, z])| old += &format!("{x} {y} {z} 200 {}\n", u8::from(is_free(v))));
    let flags = |q: usize| if is_selected(q) { 0x22 } else { 2 };
    quads()
        .iter()
        .enumerate()
        .for_each(|(q, [a, b, c, d])| old += &format!("4 {a} {b} {c} {d} {}\n", flags(q)));
    fs::write(directory.join("cap.ply"), &old).unwrap();
    let ways: [&[&str]; 4] = [
        &[],
        &["--selection", "face:flags"],
        &["--selection", "chosen"],
        &["--selection", "vertex:chosen"],
    ];
    for way in ways {
        expect(
            &directory,
            &[&["fair", "cap.ply", "-o", "out.ply"], way].concat(),
            0,
        );
        let positions = compare(
            &old,
            &fs::read_to_string(directory.join("out.ply")).unwrap(),
            first,
            0,
        );
        assert!(off_sphere(&positions) < NEAR);
    }
}

/// Binary PLY with normals and a colour; also returns the offset of vertex 0 and the bytes per vertex.
fn binary_ply(big: bool, positions: &[[f64; 3]]) -> (Vec<u8>, usize, usize) {
    let order = if big { "big" } else { "little" };
    let mut bytes = format!(
        "ply\nformat binary_{order}_endian 1.0\nelement vertex {}\nproperty uchar red\nproperty float x\n\
         property float y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float nz\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        SIDE * SIDE,
        quads().len()
    )
    .into_bytes();
    let start = bytes.len();
    let mut put = |mut little: Vec<u8>| {
        if big {
            little.reverse();
        }
        bytes.append(&mut little);
    };
    for p in positions {
        put(vec![77]);
        p.iter()
            .chain(&[0.0; 3])
            .for_each(|&c| put((c as f32).to_le_bytes().to_vec()));
    }
    for quad in quads() {
        put(vec![4]);
        quad.iter()
            .for_each(|&corner| put((corner as i32).to_le_bytes().to_vec()));
    }
    (bytes, start, 25)
}

#[test]
fn binary_ply_of_both_orders() {
    let directory = directory("binary_ply");
    write_lists(&directory);
    for big in [false, true] {
        let (old, start, stride) = binary_ply(big, &cap());
        fs::write(directory.join("cap.ply"), &old).unwrap();
        expect(
            &directory,
            &["fair", "cap.ply", "-o", "out.ply", "--free", "free.txt"],
            0,
        );
        let new = fs::read(directory.join("out.ply")).unwrap();
        assert_eq!((&old[..start], old.len()), (&new[..start], new.len()));
        let float = |at: usize| {
            let mut bytes: [u8; 4] = new[at..at + 4].try_into().unwrap();
            if big {
                bytes.reverse();
            }
            f64::from(f32::from_le_bytes(bytes))
        };
        for v in 0..SIDE * SIDE {
            let at = start + stride * v;
            let triple = |at: usize| [0, 4, 8].map(|offset| float(at + offset));
            assert!(off_sphere(&[triple(at + 1)]) < NEAR);
            if is_free(v) {
                // On the sphere the normal is the position.
                let (p, n) = (triple(at + 1), triple(at + 13));
                assert!(
                    p.iter().zip(n).all(|(p, n)| (p - n).abs() < 0.01),
                    "{v}: {p:?} {n:?}"
                );
                assert_eq!(new[at], old[at]);
            } else {
                assert_eq!(new[at..at + 13], old[at..at + 13]);
            }
        }
        let end = start + stride * SIDE * SIDE;
        assert_eq!(old[end..], new[end..]);
    }
}

#[test]
fn stl_by_way_of_conversion() {
    let directory = directory("stl");
    let mut corners = Vec::new();
    let mut faces = Vec::new();
    for (q, [a, b, c, d]) in quads().into_iter().enumerate() {
        if is_selected(q) {
            faces.extend([corners.len() / 3, corners.len() / 3 + 1]);
        }
        corners.extend([a, b, c, a, c, d]);
    }
    let mut old = b"made here".to_vec();
    old.resize(80, 32);
    old.extend_from_slice(&(corners.len() as u32 / 3).to_le_bytes());
    let positions = cap();
    for facet in corners.chunks(3) {
        old.extend_from_slice(&[0; 12]);
        let values = facet.iter().flat_map(|&v| positions[v]);
        values.for_each(|c| old.extend_from_slice(&(c as f32).to_le_bytes()));
        old.extend_from_slice(&[1, 2]);
    }
    fs::write(directory.join("cap.stl"), &old).unwrap();
    fs::write(directory.join("faces.txt"), list(faces.into_iter())).unwrap();
    expect(
        &directory,
        &["fair", "cap.stl", "-o", "out.stl", "--faces", "faces.txt"],
        0,
    );
    let new = fs::read(directory.join("out.stl")).unwrap();
    assert_eq!((&old[..84], old.len()), (&new[..84], new.len()));
    for (t, facet) in corners.chunks(3).enumerate() {
        let at = 84 + 50 * t;
        assert_eq!(new[at + 48..at + 50], [1, 2]);
        for (k, &v) in facet.iter().enumerate() {
            let range = at + 12 * (k + 1)..at + 12 * (k + 2);
            assert_eq!(old[range.clone()] == new[range], !is_free(v));
        }
    }
    // To another format: vertices and triangles, and nothing else.
    expect(
        &directory,
        &["fair", "cap.stl", "-o", "out.off", "--faces", "faces.txt"],
        0,
    );
    let off = fs::read_to_string(directory.join("out.off")).unwrap();
    assert!(off.starts_with(&format!("OFF\n{} {} 0\n", SIDE * SIDE, corners.len() / 3)));
    let rows = off.lines().skip(2).take(SIDE * SIDE);
    let positions: Vec<[f64; 3]> = rows
        .map(|row| {
            let values: Vec<f64> = row.split(' ').map(|word| word.parse().unwrap()).collect();
            [values[0], values[1], values[2]]
        })
        .collect();
    assert!(off_sphere(&positions) < NEAR);
}
