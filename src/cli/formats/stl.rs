//! STL, ASCII and binary. Corners with exactly equal coordinates are one vertex: the format has no vertices that could be numbered
//! otherwise.

use std::collections::HashMap;

use crate::failure::Malformed;
use crate::formats::patches::Patches;
use crate::formats::{Change, Geometry};
use crate::normals;
use crate::text::{self, Words};

/// Bytes before the first triangle of a binary file, the count among them.
const HEADER: usize = 84;
/// Bytes of a triangle of a binary file.
const FACET: usize = 50;

/// Where the triangles are.
pub enum Stl {
    Binary,
    /// Byte offsets of the lines `facet normal` and three times `vertex`.
    Ascii(Vec<[usize; 4]>),
}

/// Gives equal corners the same number, in the order of their first appearance.
#[derive(Default)]
struct Weld {
    numbers: HashMap<[u64; 3], u32>,
}

impl Weld {
    fn vertex(&mut self, position: [f64; 3], positions: &mut Vec<[f64; 3]>) -> u32 {
        // Adding zero makes -0 and 0 the same.
        let key = position.map(|c| (c + 0.0).to_bits());
        *self.numbers.entry(key).or_insert_with(|| {
            positions.push(position);
            positions.len() as u32 - 1
        })
    }
}

/// Reads a file's bytes.
pub fn parse(bytes: &[u8]) -> Result<(Geometry, Stl), Malformed> {
    let count = bytes
        .get(80..HEADER)
        .map(|count| u32::from_le_bytes([count[0], count[1], count[2], count[3]]));
    let expected = count.map(|count| HEADER as u64 + FACET as u64 * u64::from(count));
    let looks_ascii = bytes.trim_ascii_start().starts_with(b"solid");
    match (count, expected) {
        // Binary files may begin with "solid" too; the length decides.
        (Some(count), Some(expected)) if expected == bytes.len() as u64 => Ok(parse_binary(bytes, count)),
        _ if looks_ascii => parse_ascii(bytes),
        (Some(count), Some(expected)) => Err(Malformed::binary(
            80,
            format!(
                "{count} triangles take {expected} bytes, but the file has {}",
                bytes.len()
            ),
        )),
        _ => Err(Malformed::binary(
            bytes.len(),
            "this is not an STL file: it is too short and has no 'solid'",
        )),
    }
}

fn parse_binary(bytes: &[u8], count: u32) -> (Geometry, Stl) {
    let mut geometry = Geometry::default();
    let mut weld = Weld::default();
    for t in 0..count as usize {
        let at = HEADER + FACET * t;
        let corners = [0, 1, 2].map(|k| {
            let position = [0, 1, 2].map(|axis| {
                let at = at + 12 * (k + 1) + 4 * axis;
                f64::from(f32::from_le_bytes([
                    bytes[at],
                    bytes[at + 1],
                    bytes[at + 2],
                    bytes[at + 3],
                ]))
            });
            weld.vertex(position, &mut geometry.positions)
        });
        geometry.push_polygon(&corners, at);
    }
    (geometry, Stl::Binary)
}

fn parse_ascii(bytes: &[u8]) -> Result<(Geometry, Stl), Malformed> {
    let mut geometry = Geometry::default();
    let mut weld = Weld::default();
    let mut facets = Vec::new();
    let (mut facet, mut corners) = (None, Vec::new());
    let mut lines = [0; 4];
    let mut at = 0;
    while at < bytes.len() {
        let (range, next) = text::line(bytes, at);
        let mut words = text::words(bytes, range);
        let word = words
            .next()
            .map(|word| bytes[word].to_ascii_lowercase())
            .unwrap_or_default();
        match (word.as_slice(), facet) {
            (b"facet", None) => {
                facet = Some(at);
                lines[0] = at;
                corners.clear();
            }
            (b"vertex", Some(_)) if corners.len() < 3 => {
                let position = text::triple(bytes, &mut words, "vertex")?;
                corners.push(weld.vertex(position, &mut geometry.positions));
                lines[corners.len()] = at;
            }
            (b"endfacet", Some(start)) if corners.len() == 3 => {
                geometry.push_polygon(&corners, start);
                facets.push(lines);
                facet = None;
            }
            (b"outer" | b"endloop", Some(_)) | (b"solid" | b"endsolid" | b"", None) | (b"", Some(_)) => {}
            _ => {
                let what = format!("{} is out of place here", text::shown(&word, 0..word.len()));
                return Err(Malformed::text(at, what));
            }
        }
        at = next;
    }
    match facet {
        Some(_) => Err(Malformed::text(bytes.len(), "the file ends within a facet")),
        None => Ok((geometry, Stl::Ascii(facets))),
    }
}

/// Passes over the first words of a line.
fn skip(words: &mut Words<'_>, count: usize) {
    (0..count).for_each(|_| _ = words.next());
}

impl Stl {
    /// Replaces the corners that moved and the normals of their triangles; none is left behind.
    pub fn patch(
        &self,
        bytes: &[u8],
        triangles: &[[u32; 3]],
        change: &Change<'_>,
        patches: &mut Patches,
    ) -> usize {
        for (t, corners) in triangles.iter().enumerate() {
            if !corners.iter().any(|&v| change.moved[v as usize]) {
                continue;
            }
            let places = corners.map(|v| change.positions[v as usize]);
            let normal = normals::of_triangle(places).unwrap_or_default();
            self.patch_facet(bytes, t, 0, normal, patches);
            for (k, &v) in corners.iter().enumerate() {
                if change.moved[v as usize] {
                    self.patch_facet(bytes, t, k + 1, change.positions[v as usize], patches);
                }
            }
        }
        0
    }

    /// Replaces one of the four triples of numbers of a triangle.
    fn patch_facet(&self, bytes: &[u8], t: usize, row: usize, values: [f64; 3], patches: &mut Patches) {
        match self {
            Stl::Binary => {
                let at = HEADER + FACET * t + 12 * row;
                patches.replace(
                    at..at + 12,
                    &values.map(|value| (value as f32).to_le_bytes()).concat(),
                );
            }
            Stl::Ascii(facets) => {
                let (range, _) = text::line(bytes, facets[t][row]);
                let mut words = text::words(bytes, range);
                skip(&mut words, if row == 0 { 2 } else { 1 });
                patches.replace_words(&mut words, values);
            }
        }
    }
}

/// A binary file.
pub fn plain(positions: &[[f64; 3]], polygons: &[impl AsRef<[u32]>]) -> Vec<u8> {
    let mut bytes = b"fairmesh".to_vec();
    bytes.resize(HEADER, 0);
    let mut count = 0u32;
    for polygon in polygons.iter().map(AsRef::as_ref) {
        for pair in polygon[1..].windows(2) {
            let [a, b, c] = [polygon[0], pair[0], pair[1]].map(|v| positions[v as usize]);
            let normal = normals::of_triangle([a, b, c]).unwrap_or_default();
            for value in [normal, a, b, c].as_flattened() {
                bytes.extend_from_slice(&(*value as f32).to_le_bytes());
            }
            bytes.extend_from_slice(&[0, 0]);
            count += 1;
        }
    }
    bytes[80..HEADER].copy_from_slice(&count.to_le_bytes());
    bytes
}
