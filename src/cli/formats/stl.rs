//! STL, ASCII and binary. Corners with exactly equal coordinates are one vertex: the format has no vertices that could be numbered
//! otherwise.

use std::collections::HashMap;
use std::ops::Range;

use crate::failure::Malformed;
use crate::formats::change::Change;
use crate::formats::geometry::Geometry;
use crate::formats::patches::Patches;
use crate::normals;
use crate::text::{self, Words};

/// Bytes before the first triangle of a binary file, the count among them.
const HEADER: usize = 84;
/// Bytes of a triangle of a binary file.
const FACET: usize = 50;

/// No place in the file.
const NONE: usize = usize::MAX;

/// Where the triangles are.
pub enum Stl {
    Binary,
    /// Byte offsets of the numbers of each facet: those of its normal (or [`NONE`]) and of its three vertices.
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
    let length = bytes.len() as u64;
    // Binary files may begin with "solid" too: the length decides, or a zero, which no text has.
    match (count, expected) {
        (Some(count), Some(expected)) if expected == length && count > 0 => Ok(parse_binary(bytes, count)),
        _ if begins_as_text(bytes) => parse_ascii(bytes),
        _ if !head(bytes).contains(&0) => Err(Malformed::binary(
            bytes.len().min(HEADER),
            "this is not an STL file: it is no text that begins with 'solid', and not binary",
        )),
        (Some(0), _) if length > HEADER as u64 => Err(Malformed::binary(
            80,
            "the number of triangles is 0, but more bytes follow",
        )),
        // What stands behind the last triangle stays there.
        (Some(count), Some(expected))
            if expected <= length && !are_triangles(&bytes[expected as usize..]) =>
        {
            Ok(parse_binary(bytes, count))
        }
        (Some(count), Some(expected)) => Err(Malformed::binary(
            80,
            format!("{count} triangles take {expected} bytes, but the file has {length}"),
        )),
        _ => Err(Malformed::binary(
            bytes.len(),
            "this is not an STL file: it is too short",
        )),
    }
}

/// The head of a binary file and its first triangle, which no text looks like: there are zeros in it.
fn head(bytes: &[u8]) -> &[u8] {
    &bytes[..bytes.len().min(HEADER + FACET)]
}

/// Whether the file is a text that begins as STL does, behind comments.
fn begins_as_text(bytes: &[u8]) -> bool {
    let mut words = text::words(bytes, text::start(bytes)..bytes.len());
    let first = words.next();
    !head(bytes).contains(&0) && first.is_some_and(|word| is_one_of(bytes, &word, &["solid", "facet"]))
}

fn is_one_of(bytes: &[u8], word: &Range<usize>, keywords: &[&str]) -> bool {
    let word = &bytes[word.clone()];
    keywords
        .iter()
        .any(|keyword| word.eq_ignore_ascii_case(keyword.as_bytes()))
}

/// Whether bytes behind the last triangle look as if the number of triangles were wrong.
fn are_triangles(bytes: &[u8]) -> bool {
    bytes.len().is_multiple_of(FACET) && bytes.iter().any(|&byte| byte != 0)
}

fn parse_binary(bytes: &[u8], count: u32) -> (Geometry, Stl) {
    let mut geometry = Geometry::default();
    let mut weld = Weld::default();
    for t in 0..count as usize {
        let at = HEADER + FACET * t;
        let corners = [0, 1, 2].map(|k| {
            let position = [0, 1, 2].map(|axis| single(bytes, at + 12 * (k + 1) + 4 * axis));
            weld.vertex(position, &mut geometry.positions)
        });
        geometry.push_polygon(&corners, at);
    }
    (geometry, Stl::Binary)
}

fn single(bytes: &[u8], at: usize) -> f64 {
    f64::from(f32::from_le_bytes([
        bytes[at],
        bytes[at + 1],
        bytes[at + 2],
        bytes[at + 3],
    ]))
}

/// Reads a text by its words, wherever its lines end: there are files of one line.
fn parse_ascii(bytes: &[u8]) -> Result<(Geometry, Stl), Malformed> {
    let mut geometry = Geometry::default();
    let mut weld = Weld::default();
    let mut facets = Vec::new();
    let mut words = text::words(bytes, text::start(bytes)..bytes.len());
    let mut is_open = false;
    while let Some(word) = words.next() {
        if is_one_of(bytes, &word, &["facet"]) {
            let (corners, numbers) = read_facet(bytes, &mut words)?;
            let corners = corners.map(|corner| weld.vertex(corner, &mut geometry.positions));
            geometry.push_polygon(&corners, word.start);
            facets.push(numbers);
            is_open = true;
        } else if is_open && !is_one_of(bytes, &word, &["solid", "endsolid"]) {
            return Err(misplaced(bytes, word));
        } else {
            // Between solids stands what others pass over, too.
            is_open = is_one_of(bytes, &word, &["solid"]);
            pass_name(bytes, &mut words);
        }
    }
    // Some readers take it, but it looks as a file does that was cut off behind a facet.
    if is_open {
        return Err(Malformed::text(
            bytes.len(),
            "the file ends before 'endsolid': some of it may be missing",
        ));
    }
    Ok((geometry, Stl::Ascii(facets)))
}

fn misplaced(bytes: &[u8], word: Range<usize>) -> Malformed {
    let what = format!("{} is out of place here", text::shown(bytes, word.clone()));
    Malformed::text(word.start, what)
}

/// The corners of a facet, and where its numbers are, up to `endfacet`.
fn read_facet(bytes: &[u8], words: &mut Words<'_>) -> Result<([[f64; 3]; 3], [usize; 4]), Malformed> {
    let mut corners = [[0.0; 3]; 3];
    let mut numbers = [NONE; 4];
    let mut count = 0;
    while let Some(word) = words.next() {
        let is = |keywords| is_one_of(bytes, &word, keywords);
        if is(&["endfacet"]) && count == 3 {
            return Ok((corners, numbers));
        } else if is(&["vertex"]) && count < 3 {
            numbers[count + 1] = words.offset();
            corners[count] = text::triple(bytes, words, "vertex")?;
            count += 1;
        } else if is(&["normal"]) && count == 0 {
            numbers[0] = words.offset();
            skip(words, 3);
        } else if !is(&["outer", "loop", "endloop"]) {
            return Err(misplaced(bytes, word));
        }
    }
    Err(Malformed::text(bytes.len(), "the file ends within a facet"))
}

/// Passes over the name of a solid: the rest of its line, up to the first facet.
fn pass_name<'a>(bytes: &'a [u8], words: &mut Words<'a>) {
    let (line, _) = text::line(bytes, words.offset());
    let mut name = text::words(bytes, line.clone());
    let mut end = line.end;
    while let Some(word) = name.next() {
        let mut behind = name.clone();
        let is_facet = is_one_of(bytes, &word, &["facet"])
            && behind
                .next()
                .is_some_and(|word| is_one_of(bytes, &word, &["normal"]))
            && behind
                .next()
                .is_some_and(|word| text::number(bytes, word, "").is_ok());
        if is_facet || is_one_of(bytes, &word, &["endsolid"]) {
            end = word.start;
            break;
        }
    }
    *words = text::words(bytes, end..bytes.len());
}

/// Passes over words.
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

    /// Turns these triangles around, and their normals.
    pub fn turn(&self, bytes: &[u8], triangles: &[bool], patches: &mut Patches) {
        for (t, _) in triangles.iter().enumerate().filter(|(_, turned)| **turned) {
            let normal = self.facet(bytes, t, 0).map(|c| 0.0 - c);
            self.patch_facet(bytes, t, 0, normal, patches);
            for (to, from) in [(2, 3), (3, 2)] {
                self.patch_facet(bytes, t, to, self.facet(bytes, t, from), patches);
            }
        }
    }

    /// One of the four triples of numbers of a triangle.
    fn facet(&self, bytes: &[u8], t: usize, row: usize) -> [f64; 3] {
        match self {
            Stl::Binary => [0, 1, 2].map(|axis| single(bytes, HEADER + FACET * t + 12 * row + 4 * axis)),
            Stl::Ascii(facets) if facets[t][row] == NONE => [0.0; 3],
            Stl::Ascii(facets) => {
                let mut words = text::words(bytes, facets[t][row]..bytes.len());
                text::triple(bytes, &mut words, "").unwrap_or_default()
            }
        }
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
                let at = facets[t][row];
                if at == NONE {
                    return;
                }
                let mut words = text::words(bytes, at..bytes.len());
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
