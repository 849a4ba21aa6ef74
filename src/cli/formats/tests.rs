//! Every format: what is read, and that nothing changes but what must.

use proptest::prelude::*;

use super::*;

/// A grid of three by three vertices in the plane z = 0, the middle one moved within the plane.
const MIDDLE: [f64; 3] = [1.25, 0.75, 0.0];

fn grid() -> Vec<[f64; 3]> {
    (0..9)
        .map(|v| [f64::from(v % 3), f64::from(v / 3), 0.0])
        .collect()
}

fn moved() -> Vec<[f64; 3]> {
    let mut positions = grid();
    positions[4] = MIDDLE;
    positions
}

const QUADS: [[u32; 4]; 4] = [[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]];

/// What the quads become.
const FANS: [[u32; 3]; 8] = [
    [0, 1, 4],
    [0, 4, 3],
    [1, 2, 5],
    [1, 5, 4],
    [3, 4, 7],
    [3, 7, 6],
    [4, 5, 8],
    [4, 8, 7],
];

/// Vertices that share one of the triangles with the middle: all but 2 and 6.
const NEAR: [u32; 7] = [0, 1, 3, 4, 5, 7, 8];

fn read(format: Format, bytes: &[u8]) -> MeshFile {
    MeshFile::parse("file", format, bytes.to_vec()).unwrap()
}

fn refused(format: Format, bytes: &[u8]) -> String {
    MeshFile::parse("file", format, bytes.to_vec())
        .err()
        .unwrap()
        .to_string()
}

/// The file is refused in one line that begins so.
fn assert_refused(format: Format, text: &str, message: &str) {
    let told = refused(format, text.as_bytes());
    assert!(told.starts_with(message), "{told:?} should be {message:?}");
    assert!(!told.contains('\n'), "{told:?}");
}

fn check_grid(mesh: &MeshFile) {
    assert_eq!(mesh.geometry.positions, grid());
    assert_eq!(mesh.geometry.triangles, FANS);
    assert_eq!(mesh.geometry.polygon_count, 4);
    assert_eq!(
        (0..8).map(|t| mesh.geometry.polygon_of(t)).collect::<Vec<_>>(),
        [0, 0, 1, 1, 2, 2, 3, 3]
    );
    assert_eq!(mesh.geometry.polygons(), QUADS.map(|quad| quad.to_vec()));
}

/// Files that are cut anywhere are read or refused in one line, and what is read can be written.
fn check_cuts(format: Format, bytes: &[u8]) {
    for length in 0..bytes.len() {
        match MeshFile::parse("file", format, bytes[..length].to_vec()) {
            Ok(mesh) => _ = mesh.with_positions(&mesh.geometry.positions),
            Err(failure) => assert!(failure.to_string().starts_with("file:"), "{failure}"),
        }
    }
}

/// The same file, given unchanged positions, is the same file.
fn check_identity(mesh: &MeshFile, bytes: &[u8]) {
    let written = mesh.with_positions(&mesh.geometry.positions);
    assert_eq!(written.bytes, bytes);
    assert_eq!(written.stale_normals, 0);
}

// ---------------------------------------------------------------- PLY

/// ASCII with everything that should survive; `rows` are the vertices' lines.
fn ascii_ply(rows: &[String]) -> String {
    let header = "ply\nformat ascii 1.0\ncomment  made by   hand\nobj_info any thing\n\
        element camera 1\nproperty list uchar float view\nproperty int id\n\
        element vertex 9\nproperty list uchar int tags\nproperty double  x\nproperty uchar red\nproperty double y\n\
        property double z\nproperty float quality\n\
        element face 4\nproperty uchar flags\nproperty list uchar int vertex_indices\nproperty float area\n\
        element tail 2\nproperty char c\nend_header\n2 1.50 2.50 7\n";
    let faces = "32 4 0 1 4 3 1\n0 4 1 2 5 4  1.0\n33 4 3 4 7 6 1\n\n4 4 4 5 8 7 1e0\n-1\n+2\n";
    format!("{header}{}{faces}", rows.concat()).replace('\n', "\r\n")
}

fn ascii_rows(positions: &[[f64; 3]]) -> Vec<String> {
    let row = |(v, [x, y, z]): (usize, &[f64; 3])| format!("1 {v}  {x} 12\t{y} {z} 0.50 \n");
    positions.iter().enumerate().map(row).collect()
}

#[test]
fn ascii_ply_keeps_everything_else() {
    let old = ascii_ply(&ascii_rows(&grid()));
    let mesh = read(Format::Ply, old.as_bytes());
    check_grid(&mesh);
    check_identity(&mesh, old.as_bytes());
    let written = mesh.with_positions(&moved());
    assert_eq!(
        String::from_utf8(written.bytes).unwrap(),
        ascii_ply(&ascii_rows(&moved()))
    );
    check_cuts(Format::Ply, old.as_bytes());
}

#[test]
fn ascii_ply_keeps_the_tokens_of_fixed_vertices() {
    let header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 1\nproperty list uchar int vertex_index\nend_header\n";
    let file = |first: &str| format!("{header}{first}1.000 +0 0e0\n0 1 .0\n3 0 1 2\n");
    let mesh = read(Format::Ply, file("0.0 -0 00\n").as_bytes());
    let mut positions = mesh.geometry.positions.clone();
    positions[0] = [0.1, 1e-9, -1.0 / 3.0];
    let written = String::from_utf8(mesh.with_positions(&positions).bytes).unwrap();
    // Singles in their shortest form.
    assert_eq!(written, file("0.1 1e-9 -0.33333334\n"));
}

/// Binary with lists before the coordinates, normals, and elements on both sides.
fn binary_ply(big: bool, positions: &[[f64; 3]], normals: &[[f32; 3]]) -> Vec<u8> {
    let order = if big { "big" } else { "little" };
    let mut bytes = format!(
        "ply\nformat binary_{order}_endian 1.0\ncomment x\nelement camera 1\nproperty list ushort double view\n\
         element vertex 9\nproperty list uchar short tags\nproperty float nx\nproperty float ny\nproperty float nz\n\
         property float x\nproperty double y\nproperty float z\nproperty uchar flags\n\
         element face 4\nproperty int flags\nproperty list uchar uint vertex_indices\nproperty list int float uv\n\
         element tail 1\nproperty ushort c\nend_header\n"
    )
    .into_bytes();
    let mut put = |little: &[u8]| {
        let mut little = little.to_vec();
        if big {
            little.reverse();
        }
        bytes.extend_from_slice(&little);
    };
    put(&2u16.to_le_bytes());
    put(&1.5f64.to_le_bytes());
    put(&f64::NAN.to_le_bytes());
    for (v, (p, n)) in positions.iter().zip(normals).enumerate() {
        put(&[v as u8 % 3]);
        (0..v % 3).for_each(|tag| put(&(tag as i16 - 1).to_le_bytes()));
        n.iter().for_each(|c| put(&c.to_le_bytes()));
        put(&(p[0] as f32).to_le_bytes());
        put(&p[1].to_le_bytes());
        put(&(p[2] as f32).to_le_bytes());
        put(&[if v == 4 { 0x21 } else { 1 }]);
    }
    for (f, quad) in QUADS.iter().enumerate() {
        put(&(if f > 1 { 0x20i32 } else { -0x21 }).to_le_bytes());
        put(&[4]);
        quad.iter().for_each(|corner| put(&corner.to_le_bytes()));
        put(&1i32.to_le_bytes());
        put(&0.25f32.to_le_bytes());
    }
    put(&0xabcdu16.to_le_bytes());
    bytes.extend_from_slice(b"trailing");
    bytes
}

#[test]
fn binary_ply_keeps_everything_else() {
    for big in [false, true] {
        let tilted = [[0.6f32, 0.0, 0.8]; 9];
        let old = binary_ply(big, &grid(), &tilted);
        let mesh = read(Format::Ply, &old);
        check_grid(&mesh);
        check_identity(&mesh, &old);
        let mut normals = tilted;
        NEAR.iter().for_each(|&v| normals[v as usize] = [0.0, 0.0, 1.0]);
        assert_eq!(
            mesh.with_positions(&moved()).bytes,
            binary_ply(big, &moved(), &normals)
        );
        assert_eq!(mesh.selected(Kind::Vertex, "flags"), Some(vec![4]));
        assert_eq!(mesh.selected(Kind::Face, "flags"), Some(vec![2, 3]));
        assert_eq!(mesh.selected(Kind::Vertex, "nx"), Some((0..9).collect()));
        assert_eq!(mesh.selected(Kind::Vertex, "tags"), None);
        check_cuts(Format::Ply, &old);
    }
}

/// The elements of a PLY file with one vertex and one face.
const VERTEX: &str = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
const FACE: &str = "element face 1\nproperty list uchar int vertex_indices\n";

#[test]
fn malformed_ply_headers_are_refused_with_their_place() {
    for (text, message) in [
        ("plx\n", "file:1: this is not a PLY file"),
        (
            "ply\nformat ascii 1.0\n",
            "file:3: the file ends within the header",
        ),
        ("ply\nformat text 1.0\n", "file:2: unknown format"),
        (
            "ply\nformat ascii 1.0\u{2}rubbish\n",
            "file:2: the format line has to be 'format ENCODING 1.0'",
        ),
        ("ply\nformat ascii\n", "file:2: the format line has to be"),
    ] {
        assert_refused(Format::Ply, text, message);
    }
    for (elements, message) in [
        ("property int a\n", "file:3: a property before the first element"),
        (
            "element vertex -1\n",
            "file:3: the number of rows of element 'vertex'",
        ),
        (
            "element vertex 1\nproperty flt x\n",
            "file:4: unknown property type 'flt'",
        ),
        ("elephant\n", "file:3: header line 'elephant' is not PLY"),
        (
            "element face 0\nproperty list float int vertex_indices\n",
            "file:4: the length of a list",
        ),
    ] {
        let text = format!("ply\nformat ascii 1.0\n{elements}end_header\n");
        assert_refused(Format::Ply, &text, message);
    }
}

#[test]
fn malformed_ply_rows_are_refused_with_their_place() {
    let both = &format!("{VERTEX}{FACE}");
    let renamed = &VERTEX.replace("float z", "float w");
    let many = &VERTEX.replace('1', "99999999999999");
    for (elements, rows, message) in [
        (VERTEX, "0 0 0\n", "file:1: the file has no element 'face'"),
        (renamed, "0 0 0\n", "file:3: element 'vertex' needs a number 'z'"),
        (
            both,
            "0 0\n3 0 0 0\n",
            "file:10: this row of element 'vertex' ends before 'z'",
        ),
        (both, "0 0 u\n3 0 0 0\n", "file:10: z: 'u' is not a number"),
        (both, "0 0 0\n3 0 0 1\n", "file:11: a face names vertex 1"),
        (both, "0 0 0\n3 0 0 -1\n", "file:11: a face names vertex -1"),
        (both, "0 0 0\n3 0 0\n", "file:11: this row of element 'face' ends"),
        (both, "0 0 0\n-3 0 0\n", "file:11: a list of length -3"),
        (many, "0 0 0\n", "file:8: the header promises 99999999999999 rows"),
    ] {
        let text = format!("ply\nformat ascii 1.0\n{elements}end_header\n{rows}");
        assert_refused(Format::Ply, &text, message);
    }
}

#[test]
fn binary_ply_with_a_list_beyond_its_end_is_refused_with_its_place() {
    let huge = format!("ply\nformat binary_little_endian 1.0\n{VERTEX}{FACE}end_header\n");
    let mut huge = huge.into_bytes();
    let start = huge.len();
    huge.extend_from_slice(&[0; 12]);
    huge.push(255);
    assert_eq!(
        refused(Format::Ply, &huge),
        format!("file: byte {}: the file ends within element 'face'", start + 13)
    );
}

// ---------------------------------------------------------------- OBJ

const OBJ: &str = "# a comment C:\\\nmtllib a.mtl\no thing\nv 0 0 0 1.0\nv  1.0 0 0\nv 2 0 0 0.1 0.2 0.3\nv 0 1 0\n\
    v\t1 1  0 0.5 0.5 0.5 # middle\nv 2 1 0\nvn 0.6 0 0.8\nvn 0 0.6 0.8\nvn 0 0 2\nvt 0 0\ng one\nusemtl m\n\
    v 0 2 0\nv 1 2 0\nv 2 2 0\ns 1\nf 1/1/2 2/1/2 5/1/1 4//2\nf -8 -7 \\\n -4 -5\nf 4 5//1 8 7\nl 1 2\n\
    f 5/1/1 6/1 9 8//3\n";

#[test]
fn obj_keeps_everything_else() {
    for end in ["\n", "\r\n"] {
        let old = OBJ.replace('\n', end);
        let mesh = read(Format::Obj, old.as_bytes());
        check_grid(&mesh);
        check_identity(&mesh, old.as_bytes());
        let written = mesh.with_positions(&moved());
        // Normal 1 is the middle's and 3 is vertex 7's; 2 is shared by 0, 1 and 3.
        let new = old
            .replace("v\t1 1  0 0.5", "v\t1.25 0.75  0 0.5")
            .replace("vn 0.6 0 0.8", "vn 0 0 1");
        let new = new.replace("vn 0 0 2", "vn 0 0 1");
        assert_eq!(String::from_utf8(written.bytes).unwrap(), new);
        assert_eq!(written.stale_normals, 3);
        check_cuts(Format::Obj, old.as_bytes());
    }
}

#[test]
fn malformed_obj_is_refused_with_its_place() {
    let cases = [
        ("v 1 2\n", "file:1: vertex has 2 of 3 numbers"),
        ("v 0 0 0\n\nv 1 2 z\n", "file:3: vertex: 'z' is not a number"),
        (
            "v 0 0 0\nf 1 1 2\n",
            "file:2: a face names vertex 1 (counted from 0)",
        ),
        ("v 0 0 0\nf 1 0 1\n", "file:2: a face names element 0"),
        ("v 0 0 0\nf 1 1 -2\n", "file:2: a face names element -2"),
        ("v 0 0 0\nf 1 1 a\n", "file:2: face: 'a' is not a whole number"),
        (
            "v 0 0 0\nf 1 1 99999999999\n",
            "file:2: a face names vertex 99999999998",
        ),
        ("v 0 0 0\nf 1 1 99999999999999999999\n", "file:2: face:"),
    ];
    for (text, message) in cases {
        assert_refused(Format::Obj, text, message);
    }
}

// ---------------------------------------------------------------- OFF

fn off(middle: &str, normal: &str, far: &str) -> String {
    format!(
        "# by hand\nCNOFF\n\n9 4 12 # counts\n0 0 0 {normal} 255 0 0 255\n1 0 0 {normal} 1 1 1 1\n2 0 0 {far} 1 1 1 1\n\
         # between\n0 1 0 {normal} 1 1 1 1\n{middle} {normal}  9 9 9 9 # middle\n2 1 0 {normal} 1 1 1 1\n\
         0 2 0 {far} 1 1 1 1\n1 2 0 {normal} 1 1 1 1\n2 2 0 {normal} 1 1 1 1\n\
         4 0 1 4 3 255 0 0\n4  1 2 5 4\n4 3 4 7 6 0.5 0.5 0.5\n4 4 5 8 7"
    )
}

#[test]
fn off_keeps_everything_else() {
    for end in ["\n", "\r\n"] {
        let old = off("1 1 0", "0.6 0 0.8", "0.6 0 0.8").replace('\n', end);
        let mesh = read(Format::Off, old.as_bytes());
        check_grid(&mesh);
        check_identity(&mesh, old.as_bytes());
        let new = off("1.25 0.75 0", "0 0 1", "0.6 0 0.8").replace('\n', end);
        assert_eq!(
            String::from_utf8(mesh.with_positions(&moved()).bytes).unwrap(),
            new
        );
        check_cuts(Format::Off, old.as_bytes());
    }
}

#[test]
fn malformed_off_is_refused_with_its_place() {
    let cases = [
        ("", "file:1: the file ends before the line 'OFF'"),
        ("FOO\n", "file:1: this is not an OFF file"),
        ("4OFF\n1 1 1\n", "file:1: '4OFF' is not supported"),
        ("OFF BINARY\n", "file:1: binary OFF is not supported"),
        (
            "OFF\n3\n# this is a comment for length",
            "file:2: the number of faces is missing",
        ),
        ("OFF\n-3 1 0\n", "file:2: the number of vertices is -3"),
        (
            "OFF\n3000000000 1 0\n",
            "file:2: the number of vertices is 3000000000, more than the file",
        ),
        ("OFF 1 1 0\n0 0\n", "file:2: vertex has 2 of 3 numbers"),
        ("OFF 1 1 0\n0 0 0\n3 0 0 1\n", "file:3: a face names vertex 1"),
        (
            "OFF 1 1 0\n0 0 0\n3 0 0\n",
            "file:3: this face names 2 vertices; it promises 3",
        ),
        ("OFF 1 1 0\n0 0 0\n", "file:3: the file ends before face 0"),
    ];
    for (text, message) in cases {
        assert_refused(Format::Off, text, message);
    }
}

// ---------------------------------------------------------------- STL

/// A pyramid's four sides around vertex 2, and a triangle elsewhere, each facet with odd normals.
fn stl_corners(apex: [f64; 3]) -> Vec<[[f64; 3]; 3]> {
    let base = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]];
    let mut facets: Vec<_> = (0..4).map(|k| [base[k], base[(k + 1) % 4], apex]).collect();
    facets.push([[5.0, 0.0, 0.0], [6.0, 0.0, 0.0], [5.0, 1.0, -0.0]]);
    facets
}

fn binary_stl(facets: &[[[f64; 3]; 3]], normals: &[[f64; 3]]) -> Vec<u8> {
    let mut bytes = b"solid, though binary".to_vec();
    bytes.resize(80, 7);
    bytes.extend_from_slice(&(facets.len() as u32).to_le_bytes());
    for (t, (facet, normal)) in facets.iter().zip(normals).enumerate() {
        normal
            .iter()
            .chain(facet.as_flattened())
            .for_each(|c| bytes.extend_from_slice(&(*c as f32).to_le_bytes()));
        bytes.extend_from_slice(&(t as u16 * 257).to_le_bytes());
    }
    bytes
}

fn ascii_stl(facets: &[[[f64; 3]; 3]], normals: &[[f64; 3]]) -> String {
    let mut text = "solid any name\n".to_owned();
    for (facet, [x, y, z]) in facets.iter().zip(normals) {
        text += &format!(" facet normal {x} {y} {z}\n  outer loop\n");
        facet
            .iter()
            .for_each(|[x, y, z]| text += &format!("   vertex {x} {y}  {z}\n"));
        text += "  endloop\n endfacet\n";
    }
    text + "endsolid any name\n"
}

#[test]
fn stl_keeps_everything_else() {
    let (flat, raised) = (stl_corners([1.0, 1.0, 0.0]), stl_corners([1.0, 1.0, 0.75]));
    let odd = [[0.5; 3]; 5];
    // Sides of slope 3/4: normals (0, -3, 4) / 5 and so on.
    let new = [
        [0.0, -0.6, 0.8],
        [0.6, 0.0, 0.8],
        [0.0, 0.6, 0.8],
        [-0.6, 0.0, 0.8],
        [0.5; 3],
    ];
    let binary = binary_stl(&flat, &odd);
    let ascii = ascii_stl(&flat, &odd).replace('\n', "\r\n").into_bytes();
    let ascii_new = ascii_stl(&raised, &new).replace('\n', "\r\n").into_bytes();
    for (old, new) in [(binary, binary_stl(&raised, &new)), (ascii, ascii_new)] {
        let mesh = read(Format::Stl, &old);
        assert_eq!(mesh.geometry.positions.len(), 8);
        assert_eq!(
            mesh.geometry.triangles,
            [[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [5, 6, 7]]
        );
        check_identity(&mesh, &old);
        let mut positions = mesh.geometry.positions.clone();
        positions[2] = [1.0, 1.0, 0.75];
        assert_eq!(mesh.with_positions(&positions).bytes, new);
        check_cuts(Format::Stl, &old);
    }
}

#[test]
fn malformed_stl_is_refused_with_its_place() {
    let mut long = binary_stl(&stl_corners([1.0, 1.0, 0.0]), &[[0.5; 3]; 5]);
    long[0] = b'x';
    long.pop();
    assert_eq!(
        refused(Format::Stl, &long),
        "file: byte 80: 5 triangles take 334 bytes, but the file has 333"
    );
    assert_begins!(
        refused(Format::Stl, b"sol"),
        "file: byte 3: this is not an STL file"
    );
    let text = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\nendfacet\n";
    assert_eq!(
        refused(Format::Stl, text.as_bytes()),
        "file:6: 'endfacet' is out of place here"
    );
    assert_eq!(
        refused(Format::Stl, &text.as_bytes()[..44]),
        "file:4: vertex has 1 of 3 numbers"
    );
}

// ---------------------------------------------------------------- all

#[test]
fn plain_files_read_back_the_same() {
    let polygons = QUADS.map(|quad| quad.to_vec());
    for format in [Format::Ply, Format::Obj, Format::Off] {
        let mut positions = moved();
        positions[0] = [0.1, -1e-300, 1e22 / 3.0];
        let mesh = read(format, &plain(format, &positions, &polygons));
        assert_eq!(mesh.geometry.positions, positions);
        assert_eq!(mesh.geometry.polygons(), polygons);
    }
    let mesh = read(Format::Stl, &plain(Format::Stl, &moved(), &polygons));
    assert_eq!(mesh.geometry.polygon_count, 8);
    let corners = |positions: &[[f64; 3]], triangles: &[[u32; 3]]| -> Vec<[f64; 3]> {
        triangles
            .as_flattened()
            .iter()
            .map(|&v| positions[v as usize])
            .collect()
    };
    let Geometry {
        positions, triangles, ..
    } = &mesh.geometry;
    assert_eq!(corners(positions, triangles), corners(&moved(), &FANS));
}

/// MeshLab opens no PLY file whose numbers of corners have more than a byte.
#[test]
fn corners_are_counted_in_a_byte_where_that_is_enough() {
    let round: Vec<[f64; 3]> = (0..300).map(|k| [f64::from(k), f64::from(k * k), 1.0]).collect();
    for (corners, kind) in [
        (3, "list uchar int"),
        (255, "list uchar int"),
        (256, "list uint int"),
    ] {
        let polygons = [(0..corners).collect::<Vec<u32>>()];
        let bytes = plain(Format::Ply, &round, &polygons);
        assert_contains!(String::from_utf8_lossy(&bytes), kind);
        assert_eq!(read(Format::Ply, &bytes).geometry.polygons(), polygons);
    }
}

#[test]
fn degenerate_polygons_count_but_have_no_triangles() {
    let text = "OFF 4 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n1 0\n3 0 1 2\n0\n4 0 1 2 3\n";
    let mesh = read(Format::Off, text.as_bytes());
    assert_eq!(mesh.geometry.polygon_count, 4);
    assert_eq!(mesh.geometry.triangles.len(), 3);
    assert_eq!(
        (0..3).map(|t| mesh.geometry.polygon_of(t)).collect::<Vec<_>>(),
        [1, 3, 3]
    );
}

#[test]
fn polygons_keep_their_numbers_behind_leading_degenerate_ones() {
    let text = "OFF 4 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 1\n4 0 1 2 3\n3 0 1 2\n1 3\n";
    let mesh = read(Format::Off, text.as_bytes());
    let polygons = (0..3).map(|t| mesh.geometry.polygon_of(t)).collect::<Vec<_>>();
    assert_eq!(polygons, [1, 1, 2]);
    assert_eq!(mesh.geometry.polygons(), [vec![0, 1, 2, 3], vec![0, 1, 2]]);
}

/// A file that is cut is refused, and never read as a smaller mesh: in every format that says how much there is. What may
/// be missing are the last `spare` bytes.
#[test]
fn cut_files_are_no_smaller_meshes() {
    let polygons = QUADS.map(|quad| quad.to_vec());
    let facets = stl_corners([1.0; 3]);
    let odd = [[0.5; 3]; 5];
    let ascii = ascii_stl(&facets, &odd);
    let rows = ascii_ply(&ascii_rows(&grid()));
    let cases = [
        (Format::Ply, plain(Format::Ply, &grid(), &polygons), 0),
        (Format::Ply, rows.into_bytes(), "2\r\n".len()),
        (Format::Off, plain(Format::Off, &grid(), &polygons), "\n".len()),
        (Format::Stl, binary_stl(&facets, &odd), 0),
        (
            Format::Stl,
            ascii.replace('\n', " ").into_bytes(),
            " any name ".len(),
        ),
        (Format::Stl, ascii.into_bytes(), " any name\n".len()),
    ];
    for (format, bytes, spare) in cases {
        read(format, &bytes);
        for length in 0..bytes.len() - spare {
            let told = refused(format, &bytes[..length]);
            assert!(told.starts_with("file:"), "{told}");
        }
    }
}

/// Reads whatever it is; if it is a mesh, writes it.
fn survive(format: Format, bytes: Vec<u8>) {
    if let Ok(mesh) = MeshFile::parse("file", format, bytes) {
        let raised: Vec<_> = mesh
            .geometry
            .positions
            .iter()
            .map(|[x, y, z]| [*x, *y, z + 1.0])
            .collect();
        let written = mesh.with_positions(&raised);
        assert!(!written.bytes.is_empty() || raised.is_empty());
        mesh.selected(Kind::Vertex, "flags");
        mesh.selected(Kind::Face, "flags");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn garbage_after_a_header_never_panics(garbage in prop::collection::vec(any::<u8>(), 0..400), which in 0..5usize) {
        let cut = |bytes: Vec<u8>| {
            let end = bytes.windows(10).position(|w| w == b"end_header").unwrap() + 11;
            bytes[..end].to_vec()
        };
        let normals = [[0.0; 3]; 9];
        let (format, mut bytes) = match which {
            0 => (Format::Ply, cut(binary_ply(false, &grid(), &normals))),
            1 => (Format::Ply, cut(binary_ply(true, &grid(), &normals))),
            2 => (Format::Obj, b"v 0 0 0\n".to_vec()),
            3 => (Format::Off, b"OFF 1 1 0\n".to_vec()),
            _ => (Format::Stl, b"solid\n".to_vec()),
        };
        bytes.extend_from_slice(&garbage);
        survive(format, bytes);
    }

    #[test]
    fn spoiled_bytes_never_panic(spoiled in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6), which in 0..7usize) {
        let normals = [[0.0; 3]; 9];
        let odd = [[0.5; 3]; 5];
        let (format, mut bytes) = match which {
            0 => (Format::Ply, binary_ply(false, &grid(), &normals)),
            1 => (Format::Ply, binary_ply(true, &grid(), &normals)),
            2 => (Format::Ply, ascii_ply(&ascii_rows(&grid())).into_bytes()),
            3 => (Format::Obj, OBJ.as_bytes().to_vec()),
            4 => (Format::Off, off("1 1 0", "0 0 1", "0 0 1").into_bytes()),
            5 => (Format::Stl, binary_stl(&stl_corners([1.0; 3]), &odd)),
            _ => (Format::Stl, ascii_stl(&stl_corners([1.0; 3]), &odd).into_bytes()),
        };
        for (index, byte) in spoiled {
            let at = index.index(bytes.len());
            bytes[at] = byte;
        }
        survive(format, bytes);
    }

    #[test]
    fn words_of_garbage_never_panic(
        words in prop::collection::vec(
            prop::sample::select(vec![
                "v", "vn", "f", "1", "-1", "0", "1//1", "-1//-2", "1/", "\n", "\r\n", "\\\n", "\\", "OFF", "NOFF", "3 0 0 0",
                "#", "solid", "facet", "normal", "vertex", "1 2 3", "endfacet", "nan", "inf", "1e999", "9999999999",
                "ply\n", "format ascii 1.0\n", "element vertex 1\n", "property float x\n", "element face 1\n",
                "property list uchar int vertex_indices\n", "end_header\n", "element e 18446744073709551615\n",
            ]),
            0..40,
        ),
    ) {
        for format in [Format::Ply, Format::Obj, Format::Off, Format::Stl] {
            survive(format, words.join(" ").into_bytes());
            survive(format, words.concat().into_bytes());
        }
    }
}
