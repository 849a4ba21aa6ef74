//! Geomview OFF in ASCII, with normals (NOFF), colours (COFF) and texture coordinates (STOFF).

use std::fmt::Arguments;
use std::ops::Range;

use crate::failure::Malformed;
use crate::formats::patches::Patches;
use crate::formats::{Change, Geometry};
use crate::text::{self, Words};

/// Where the vertices are.
pub struct Off {
    /// Byte offset of each vertex's line.
    lines: Vec<usize>,
    /// The three words after the coordinates are a normal.
    has_normals: bool,
}

/// Lines that hold anything.
struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Lines<'a> {
    /// The next line with words, or what is missing.
    fn next(&mut self, what: Arguments<'_>) -> Result<(usize, Words<'a>), Malformed> {
        while self.at < self.bytes.len() {
            let start = self.at;
            let (range, next) = text::line(self.bytes, start);
            self.at = next;
            let words = text::words(self.bytes, range);
            if words.clone().next().is_some() {
                return Ok((start, words));
            }
        }
        Err(Malformed::text(
            self.bytes.len(),
            format!("the file ends before {what}"),
        ))
    }
}

/// Reads a file's bytes.
pub fn parse(bytes: &[u8]) -> Result<(Geometry, Off), Malformed> {
    let mut lines = Lines { bytes, at: 0 };
    let (at, mut words) = lines.next(format_args!("the line 'OFF'"))?;
    let first = words.next().unwrap_or(at..at);
    let (has_normals, rest) = keyword(bytes, first)?;
    // The counts may stand on the line of the keyword, even without a gap.
    let (_, line_end) = text::line(bytes, at);
    let mut counts = text::words(bytes, rest..line_end);
    if counts.clone().next().is_none() {
        (_, counts) = lines.next(format_args!("the numbers of vertices and faces"))?;
    }
    let vertices = count(bytes, &mut counts, "number of vertices", 6)?;
    let faces = count(bytes, &mut counts, "number of faces", 2)?;
    let mut geometry = Geometry::default();
    let mut offsets = Vec::with_capacity(vertices);
    for v in 0..vertices {
        let (at, mut words) = lines.next(format_args!("vertex {v}"))?;
        geometry
            .positions
            .push(text::triple(bytes, &mut words, "vertex")?);
        offsets.push(at);
    }
    let mut corners = Vec::new();
    for f in 0..faces {
        let (at, mut words) = lines.next(format_args!("face {f}"))?;
        read_face(bytes, at, &mut words, &mut corners)?;
        geometry.push_polygon(&corners, at);
    }
    geometry.check(true)?;
    Ok((
        geometry,
        Off {
            lines: offsets,
            has_normals,
        },
    ))
}

/// `OFF` with its prefixes: whether there are normals, and where the rest of the line begins.
fn keyword(bytes: &[u8], word: Range<usize>) -> Result<(bool, usize), Malformed> {
    let text = &bytes[word.clone()];
    let no_off = || {
        Malformed::text(
            word.start,
            "this is not an OFF file: it does not begin with 'OFF'",
        )
    };
    let length = text
        .windows(3)
        .position(|three| three == b"OFF")
        .ok_or_else(no_off)?;
    let prefix = &text[..length];
    let known = [&b""[..], b"N", b"C", b"CN", b"ST", b"STN", b"STC", b"STCN"];
    if !known.contains(&prefix) {
        let what = format!(
            "{} is not supported; only OFF with prefixes ST, C and N is",
            text::shown(bytes, word.clone())
        );
        return Err(Malformed::text(word.start, what));
    }
    let rest = word.start + length + 3;
    if text::words(bytes, rest..bytes.len())
        .next()
        .is_some_and(|next| &bytes[next] == b"BINARY")
    {
        return Err(Malformed::text(
            word.start,
            "binary OFF is not supported; save it as text",
        ));
    }
    Ok((prefix.ends_with(b"N"), rest))
}

/// A count that the file's length allows, `least` bytes each.
fn count(bytes: &[u8], words: &mut Words<'_>, what: &str, least: usize) -> Result<usize, Malformed> {
    let at = words.offset();
    let word = words
        .next()
        .ok_or_else(|| Malformed::text(at, format!("the {what} is missing")))?;
    let start = word.start;
    let value = text::integer(bytes, word, what)?;
    match usize::try_from(value) {
        Ok(count) if count.saturating_mul(least) <= bytes.len() => Ok(count),
        Ok(_) => Err(Malformed::text(
            start,
            format!("the {what} is {value}, more than the file can hold"),
        )),
        Err(_) => Err(Malformed::text(start, format!("the {what} is {value}"))),
    }
}

fn read_face(
    bytes: &[u8],
    at: usize,
    words: &mut Words<'_>,
    corners: &mut Vec<u32>,
) -> Result<(), Malformed> {
    corners.clear();
    let word = words.next().unwrap_or(at..at);
    let count = text::integer(bytes, word, "number of corners")?;
    for corner in 0..count {
        let word = words.next().ok_or_else(|| {
            Malformed::text(
                at,
                format!("this face names {corner} vertices; it promises {count}"),
            )
        })?;
        corners.push(Geometry::corner(text::integer(bytes, word, "face")?, at, true)?);
    }
    Ok(())
}

impl Off {
    /// Replaces coordinates of moved vertices, and normals; returns the number of normals left behind.
    pub fn patch(&self, bytes: &[u8], change: &Change<'_>, patches: &mut Patches) -> usize {
        let mut stale = 0;
        for (v, position, normal) in change.vertices() {
            let (range, _) = text::line(bytes, self.lines[v]);
            let mut words = text::words(bytes, range);
            match position {
                Some(position) => patches.replace_words(&mut words, position),
                None => (0..3).for_each(|_| _ = words.next()),
            }
            match normal {
                Some(normal) if self.has_normals => patches.replace_words(&mut words, normal),
                None if self.has_normals => stale += 1,
                _ => {}
            }
        }
        stale
    }
}

/// A file with vertices and faces.
pub fn plain(positions: &[[f64; 3]], polygons: &[impl AsRef<[u32]>]) -> Vec<u8> {
    let mut out = format!("OFF\n{} {} 0\n", positions.len(), polygons.len());
    for position in positions {
        let [x, y, z] = position.map(text::double);
        out.push_str(&format!("{x} {y} {z}\n"));
    }
    for polygon in polygons.iter().map(AsRef::as_ref) {
        out.push_str(&polygon.len().to_string());
        polygon
            .iter()
            .for_each(|corner| out.push_str(&format!(" {corner}")));
        out.push('\n');
    }
    out.into_bytes()
}
