//! Triangle strips (Stanford's scans) as the faces that they stand for.

use std::ops::Range;

use super::header::{self, Element, Encoding, Header, PropertyKind, Scalar};
use super::pass_over;
use super::rows::{Field, Rows};
use crate::failure::Malformed;
use crate::formats::patches::Patches;
use crate::text::{self, Layout};

/// The element's name. A row is a list of vertices, each of which makes a triangle with the two before it; -1 begins a new strip.
const NAME: &str = "tristrips";

/// The file with faces in place of its strips; None if it has none.
///
/// # Errors
/// A file with faces, too: no element may be declared twice. What is no list of integers.
pub fn faces_for_strips(bytes: &[u8]) -> Result<Option<Vec<u8>>, Malformed> {
    let header = header::parse(bytes)?;
    let Some(strips) = header.elements.iter().find(|e| e.name == NAME && e.count > 0) else {
        return Ok(None);
    };
    if header.elements.iter().any(|element| element.name == "face") {
        let what = "faces beside triangle strips are not supported; save the file with faces alone";
        return Err(Malformed::text(strips.at, what));
    }
    if header.encoding == Encoding::Ascii {
        Layout::find(|layout| replaced(bytes, &header, layout))
    } else {
        replaced(bytes, &header, Layout::Lines)
    }
    .map(Some)
}

fn replaced(bytes: &[u8], header: &Header, layout: Layout) -> Result<Vec<u8>, Malformed> {
    let mut patches = Patches::default();
    let mut at = header.end;
    for element in &header.elements {
        let rows = Rows::of(bytes, header, layout, element);
        let begin = at;
        if element.name != NAME {
            at = pass_over(&rows, at)?;
            continue;
        }
        let (triangles, end) = read(&rows, at, vertex_count(header))?;
        let faces = format!(
            "element face {}\nproperty list uchar int vertex_indices\n",
            triangles.len()
        );
        patches.replace(declaration(bytes, element), faces.as_bytes());
        patches.replace(begin..end, &written(header.encoding, &triangles));
        at = end;
    }
    if header.encoding == Encoding::Ascii {
        layout.end(bytes, at)?;
    }
    Ok(patches.apply(bytes))
}

fn vertex_count(header: &Header) -> u64 {
    let vertices = header.elements.iter().find(|element| element.name == "vertex");
    vertices.map_or(0, |element| element.count)
}

/// The triangles of an element's rows, and where these end.
fn read(rows: &Rows<'_>, at: usize, vertices: u64) -> Result<(Vec<[i64; 3]>, usize), Malformed> {
    let is_list = |&p: &usize| match rows.element.properties[p].kind {
        PropertyKind::List { item, .. } => item.is_integer(),
        PropertyKind::Scalar(_) => false,
    };
    let wanted = rows.element.vertex_indices().filter(is_list).ok_or_else(|| {
        let what = format!("element '{NAME}' needs a list of integers 'vertex_indices'");
        Malformed::text(rows.element.at, what)
    })?;
    let (mut strip, mut triangles) = (Vec::new(), Vec::new());
    let is_vertex = |v: i64| u64::try_from(v).is_ok_and(|v| v < vertices);
    let mut at = at;
    for _ in 0..rows.check_count(at)? {
        let row = rows.start(at)?;
        at = rows.walk(row, &mut |property, field: Field| {
            if property == wanted {
                rows.integers(property, &field, &mut strip)?;
                if let Some(v) = strip.iter().find(|&&v| v != -1 && !is_vertex(v)) {
                    let what = format!(
                        "a strip names vertex {v} (counted from 0), but there are only {vertices} vertices"
                    );
                    return Err(rows.malformed(row, what));
                }
                strip
                    .split(|&v| v == -1)
                    .for_each(|one| push(one, &mut triangles));
            }
            Ok(())
        })?;
    }
    Ok((triangles, at))
}

/// Every second triangle of a strip has its corners the other way round. Those that only turn a corner name a vertex twice.
fn push(strip: &[i64], triangles: &mut Vec<[i64; 3]>) {
    for (i, corners) in strip.windows(3).enumerate() {
        let [a, b, c] = [corners[i % 2], corners[1 - i % 2], corners[2]];
        if a != b && b != c && c != a {
            triangles.push([a, b, c]);
        }
    }
}

/// Where an element and its properties are declared.
fn declaration(bytes: &[u8], element: &Element) -> Range<usize> {
    let mut end = text::line(bytes, element.at).1;
    while bytes[end..].starts_with(b"property") {
        end = text::line(bytes, end).1;
    }
    element.at..end
}

/// Rows of faces.
fn written(encoding: Encoding, triangles: &[[i64; 3]]) -> Vec<u8> {
    let mut rows = Vec::new();
    for corners in triangles {
        if encoding == Encoding::Ascii {
            rows.extend(format!("3 {} {} {}\n", corners[0], corners[1], corners[2]).bytes());
        } else {
            rows.push(3);
            let mut push = |&v: &i64| rows.extend(super::grow::integer(encoding, Scalar::I32, v as f64));
            corners.iter().for_each(&mut push);
        }
    }
    rows
}
