//! Geomview OFF in ASCII, with normals (NOFF), colours (COFF) and texture coordinates (STOFF).

use std::fmt::Arguments;
use std::ops::Range;

use crate::failure::Malformed;
use crate::formats::change::Change;
use crate::formats::geometry::Geometry;
use crate::formats::obj::FULL;
use crate::formats::patches::Patches;
use crate::text::{self, Layout, Words};

/// Where the vertices are.
pub struct Off {
    /// Byte offset of each vertex's row.
    rows: Vec<usize>,
    /// Byte offset of each face's row.
    faces: Vec<usize>,
    layout: Layout,
    /// The three words after the coordinates are a normal.
    has_normals: bool,
    /// The three words after these are a colour.
    has_colours: bool,
}

/// What the first words say.
struct Header {
    vertices: usize,
    faces: usize,
    has_normals: bool,
    has_colours: bool,
    /// The numbers of a vertex, where nothing else stands between them.
    columns: usize,
    /// Where the first row begins, at the earliest.
    end: usize,
}

/// Reads a file's bytes.
pub fn parse(bytes: &[u8]) -> Result<(Geometry, Off), Malformed> {
    let header = read_header(bytes)?;
    Layout::find(|layout| read(bytes, &header, layout))
}

fn read(bytes: &[u8], header: &Header, layout: Layout) -> Result<(Geometry, Off), Malformed> {
    let start = |at: usize, what: Arguments<'_>| {
        let missing = || Malformed::text(bytes.len(), format!("the file ends before {what}"));
        layout.start(bytes, at).ok_or_else(missing)
    };
    // The rest of the counts' line belongs to them.
    let mut at = layout.next(bytes, &text::words(bytes, header.end..bytes.len()));
    let mut geometry = Geometry::default();
    let mut rows = Vec::with_capacity(header.vertices);
    for v in 0..header.vertices {
        at = start(at, format_args!("vertex {v}"))?;
        let mut words = layout.words(bytes, at);
        let position = text::triple(bytes, &mut words, "vertex")?;
        geometry.positions.push(position);
        rows.push(at);
        if layout == Layout::Free {
            for _ in 3..header.columns {
                let word = words.next().unwrap_or(at..at);
                text::number(bytes, word, "vertex")?;
            }
        }
        at = layout.next(bytes, &words);
    }
    let mut corners = Vec::new();
    let mut faces = Vec::with_capacity(header.faces);
    for f in 0..header.faces {
        at = start(at, format_args!("face {f}"))?;
        let mut words = layout.words(bytes, at);
        read_face(bytes, at, &mut words, &mut corners)?;
        if layout == Layout::Free && corners.len() < 3 {
            return Err(Malformed::text(at, "a face of fewer than three corners"));
        }
        geometry.push_polygon(&corners, at);
        faces.push(at);
        at = layout.next(bytes, &words);
    }
    layout.end(bytes, at)?;
    geometry.check(true)?;
    let &Header {
        has_normals,
        has_colours,
        ..
    } = header;
    Ok((
        geometry,
        Off {
            rows,
            faces,
            layout,
            has_normals,
            has_colours,
        },
    ))
}

/// The keyword, which some files lack, and the numbers of vertices, faces and edges, the last of which may be missing.
fn read_header(bytes: &[u8]) -> Result<Header, Malformed> {
    let begin = text::start(bytes);
    let mut words = text::words(bytes, begin..bytes.len());
    let missing = || Malformed::text(bytes.len(), "the file ends before the line 'OFF'");
    let first = words.next().ok_or_else(missing)?;
    let (prefix, end) = if text::integer(bytes, first.clone(), "").is_ok() {
        ("", first.start)
    } else {
        keyword(bytes, first)?
    };
    // The counts may stand on the line of the keyword, even without a gap.
    let mut words = text::words(bytes, end..bytes.len());
    let vertices = count(bytes, &mut words, "number of vertices", 6)?;
    let faces = count(bytes, &mut words, "number of faces", 2)?;
    let mut end = words.offset();
    // The number of edges, on the same line or where the numbers have a line each.
    let mut line = text::words(bytes, text::line(bytes, end).0);
    if line.next().is_some() {
        end = line.offset();
    } else {
        let at = Layout::Lines.start(bytes, end).unwrap_or(end);
        let mut alone = text::words(bytes, text::line(bytes, at).0);
        let is_edges = alone
            .next()
            .is_some_and(|word| text::integer(bytes, word, "").is_ok());
        if is_edges && alone.next().is_none() {
            end = alone.offset();
        }
    }
    let columns = |letter, count| if prefix.contains(letter) { count } else { 0 };
    Ok(Header {
        vertices,
        faces,
        has_normals: prefix.ends_with('N'),
        has_colours: prefix.contains('C'),
        columns: 3 + columns("ST", 2) + columns("C", 4) + columns("N", 3),
        end,
    })
}

/// `OFF` in any case: its prefixes, and where the rest of the line begins.
fn keyword(bytes: &[u8], word: Range<usize>) -> Result<(&'static str, usize), Malformed> {
    let text = bytes[word.clone()].to_ascii_uppercase();
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
    let known = ["", "N", "C", "CN", "ST", "STN", "STC", "STCN"];
    let Some(prefix) = known
        .into_iter()
        .find(|known| known.as_bytes() == &text[..length])
    else {
        let what = format!(
            "{} is not supported; only OFF with prefixes ST, C and N is",
            text::shown(bytes, word.clone())
        );
        return Err(Malformed::text(word.start, what));
    };
    let rest = word.start + length + 3;
    if text::words(bytes, rest..bytes.len())
        .next()
        .is_some_and(|next| bytes[next].eq_ignore_ascii_case(b"BINARY"))
    {
        return Err(Malformed::text(
            word.start,
            "binary OFF is not supported; save it as text",
        ));
    }
    Ok((prefix, rest))
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
    let start = word.start;
    let count = text::integer(bytes, word, "number of corners")?;
    if count < 0 {
        return Err(Malformed::text(
            start,
            format!("the number of corners is {count}"),
        ));
    }
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
    /// The colours of the vertices, from 0 to 255: if none of their channels is above 1, they are shares of that.
    pub fn colours(&self, bytes: &[u8]) -> Option<Vec<[f64; 3]>> {
        let before = if self.has_normals { 6 } else { 3 };
        let of = |&at: &usize| {
            let mut words = self.layout.words(bytes, at);
            words.nth(before - 1)?;
            text::triple(bytes, &mut words, "colour").ok()
        };
        let rows = self.rows.iter().filter(|_| self.has_colours);
        let mut colours: Vec<[f64; 3]> = rows.map(of).collect::<Option<_>>()?;
        if !colours.as_flattened().iter().any(|&channel| channel > 1.0) {
            colours.iter_mut().flatten().for_each(|channel| *channel *= FULL);
        }
        (!colours.is_empty()).then_some(colours)
    }

    /// Turns these faces around.
    pub fn turn(&self, bytes: &[u8], faces: &[bool], patches: &mut Patches) {
        for (&at, _) in self.faces.iter().zip(faces).filter(|(_, turned)| **turned) {
            let mut words = self.layout.words(bytes, at);
            let count = words.next().and_then(|word| text::integer(bytes, word, "").ok());
            let count = count.and_then(|count| usize::try_from(count).ok()).unwrap_or(0);
            patches.reverse(bytes, &words.take(count).collect::<Vec<_>>(), 1);
        }
    }

    /// Replaces coordinates of moved vertices, and normals; returns the number of normals left behind.
    pub fn patch(&self, bytes: &[u8], change: &Change<'_>, patches: &mut Patches) -> usize {
        let mut stale = 0;
        for (v, position, normal) in change.vertices() {
            let mut words = self.layout.words(bytes, self.rows[v]);
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
