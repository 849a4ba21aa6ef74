//! Meshes that guides have made, read without the program's own code.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Positions and triangles; vertices at the same place are one.
pub(crate) struct Mesh {
    pub(crate) positions: Vec<[f64; 3]>,
    pub(crate) triangles: Vec<[usize; 3]>,
}

impl Mesh {
    pub(crate) fn read(path: &Path) -> Self {
        let bytes = fs::read(path).unwrap_or_else(|why| panic!("{}: {why}", path.display()));
        let end = path.extension().unwrap().to_str().unwrap();
        let corners = match end {
            "stl" => stl(&bytes),
            "ply" => ply(&bytes),
            "off" => off(&String::from_utf8(bytes).unwrap()),
            "obj" => obj(&String::from_utf8(bytes).unwrap()),
            _ => panic!("{}", path.display()),
        };
        assert!(!corners.is_empty(), "{}: no faces", path.display());
        let mut numbers = BTreeMap::new();
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        for triangle in corners {
            triangles.push(triangle.map(|p| {
                *numbers.entry(p.map(f64::to_bits)).or_insert_with(|| {
                    positions.push(p);
                    positions.len() - 1
                })
            }));
        }
        Self { positions, triangles }
    }

    /// The numbers of edges of the boundary loops, in no order; every boundary vertex lies on one.
    pub(crate) fn holes(&self) -> Vec<usize> {
        let sides = |t: &[usize; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
        let edges: Vec<[usize; 2]> = self.triangles.iter().flat_map(sides).collect();
        let known: std::collections::BTreeSet<[usize; 2]> = edges.iter().copied().collect();
        assert_eq!(known.len(), edges.len(), "an edge has two triangles on one side");
        let open = edges.iter().filter(|[a, b]| !known.contains(&[*b, *a]));
        let mut next: BTreeMap<usize, usize> = open.map(|&[a, b]| (a, b)).collect();
        let mut loops = Vec::new();
        while let Some((&begin, _)) = next.first_key_value() {
            let (mut at, mut length) = (begin, 0);
            while let Some(to) = next.remove(&at) {
                (at, length) = (to, length + 1);
            }
            assert_eq!(at, begin, "a boundary that does not close");
            loops.push(length);
        }
        loops
    }

    /// The largest of a figure of all vertices.
    pub(crate) fn largest(&self, figure: impl Fn([f64; 3]) -> f64) -> f64 {
        self.positions.iter().map(|&p| figure(p)).fold(0.0, f64::max)
    }
}

pub(crate) fn off_sphere(p: [f64; 3]) -> f64 {
    (p[0].hypot(p[1]).hypot(p[2]) - 1.0).abs()
}

pub(crate) fn off_cylinder(p: [f64; 3]) -> f64 {
    (p[0].hypot(p[1]) - 1.0).abs()
}

type Corners = Vec<[[f64; 3]; 3]>;

fn stl(bytes: &[u8]) -> Corners {
    let float = |at: usize| f64::from(f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()));
    let count = u32::from_le_bytes(bytes[80..84].try_into().unwrap()) as usize;
    assert_eq!(bytes.len(), 84 + 50 * count, "no binary STL");
    let corner = |at: usize| std::array::from_fn(|k| float(at + 4 * k));
    (0..count)
        .map(|t| std::array::from_fn(|k| corner(84 + 50 * t + 12 + 12 * k)))
        .collect()
}

/// ASCII, or binary and little-endian; vertices begin with x y z, faces with their list.
fn ply(bytes: &[u8]) -> Corners {
    let head_end = b"end_header\n";
    let end = bytes.windows(head_end.len()).position(|w| w == head_end).unwrap() + head_end.len();
    let header = std::str::from_utf8(&bytes[..end]).unwrap();
    let is_ascii = header.contains("format ascii");
    assert!(is_ascii || header.contains("format binary_little_endian"));
    let mut rest = &bytes[end..];
    let mut number = |kind: &str| -> f64 {
        if is_ascii {
            let from = rest.iter().position(|c| !c.is_ascii_whitespace()).unwrap();
            let text = &rest[from..];
            let to = text
                .iter()
                .position(u8::is_ascii_whitespace)
                .unwrap_or(text.len());
            rest = &text[to..];
            return std::str::from_utf8(&text[..to]).unwrap().parse().unwrap();
        }
        let mut take = |n: usize| {
            let (first, others) = rest.split_at(n);
            rest = others;
            first
        };
        match kind {
            "char" | "uchar" | "int8" | "uint8" => f64::from(take(1)[0]),
            "float" | "float32" => f64::from(f32::from_le_bytes(take(4).try_into().unwrap())),
            "int" | "uint" | "int32" | "uint32" => f64::from(u32::from_le_bytes(take(4).try_into().unwrap())),
            "double" | "float64" => f64::from_le_bytes(take(8).try_into().unwrap()),
            _ => panic!("{kind}"),
        }
    };
    let (mut positions, mut corners) = (Vec::new(), Vec::new());
    for element in header.split("\nelement ").skip(1) {
        let mut lines = element.lines();
        let (name, count) = lines.next().unwrap().split_once(' ').unwrap();
        let kinds: Vec<Vec<&str>> = lines
            .filter_map(|line| line.strip_prefix("property "))
            .map(|line| line.split_whitespace().collect())
            .collect();
        for _ in 0..count.trim().parse().unwrap() {
            let row: Vec<Vec<f64>> = kinds
                .iter()
                .map(|kind| match kind[0] {
                    "list" => (0..number(kind[1]) as usize).map(|_| number(kind[2])).collect(),
                    _ => vec![number(kind[0])],
                })
                .collect();
            match name {
                "vertex" => positions.push([row[0][0], row[1][0], row[2][0]]),
                "face" => corners.push([0, 1, 2].map(|k| positions[row[0][k] as usize])),
                _ => {}
            }
        }
    }
    corners
}

fn obj(text: &str) -> Corners {
    let rows = |word: &'static str| {
        text.lines().filter_map(move |line| {
            let mut words = line.split_whitespace();
            (words.next() == Some(word)).then(|| words.map(str::to_owned).collect::<Vec<String>>())
        })
    };
    let positions: Vec<[f64; 3]> = rows("v")
        .map(|row| std::array::from_fn(|k| row[k].parse().unwrap()))
        .collect();
    let vertex = |word: &str| positions[word.split('/').next().unwrap().parse::<usize>().unwrap() - 1];
    rows("f")
        .flat_map(|row| {
            (1..row.len() - 1)
                .map(|k| [vertex(&row[0]), vertex(&row[k]), vertex(&row[k + 1])])
                .collect::<Vec<_>>()
        })
        .collect()
}

/// Triangles alone.
fn off(text: &str) -> Corners {
    let mut words = text.strip_prefix("OFF").unwrap().split_whitespace();
    let mut number = || -> f64 { words.next().unwrap().parse().unwrap() };
    let [vertices, faces, _] = [(); 3].map(|()| number() as usize);
    let positions: Vec<[f64; 3]> = (0..vertices).map(|_| [(); 3].map(|()| number())).collect();
    let mut face = || {
        let [_three, a, b, c] = [(); 4].map(|()| number() as usize);
        [a, b, c].map(|v| positions[v])
    };
    (0..faces).map(|_| face()).collect()
}
