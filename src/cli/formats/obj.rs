//! Wavefront OBJ.

mod grow;
mod lines;
mod materials;
mod only;

use std::ops::Range;

use crate::failure::Malformed;
use crate::formats::change::Change;
use crate::formats::geometry::Geometry;
use crate::formats::patches::Patches;
use crate::text::{self, Words};
use lines::logical_line;

pub use grow::{grown, settings};
pub use materials::materials_and_corners;
pub use only::{has_other_lines, only, turn};

/// A channel of a colour at its brightest, where that is 1 in a file.
pub const FULL: f64 = 255.0;

/// No partner.
const NONE: u32 = u32::MAX;
/// Several partners.
const MANY: u32 = u32::MAX - 1;

/// Where vertices and normals are.
pub struct Obj {
    /// Byte offset of each `v` line.
    vertex_lines: Vec<usize>,
    /// Byte offset of each `vn` line.
    normal_lines: Vec<usize>,
    /// The normal of each vertex, as far as its corners agree.
    normal_of: Vec<u32>,
    /// The vertex of each normal, as far as it is used by one vertex only.
    vertex_of: Vec<u32>,
}

impl Obj {
    /// The three numbers from 0 to 1 that some programs write behind the coordinates, if every vertex has them.
    pub fn colours(&self, bytes: &[u8]) -> Option<Vec<[f64; 3]>> {
        let of = |&at: &usize| {
            let mut words = text::words(bytes, logical_line(bytes, at).0);
            // "v" and the coordinates.
            words.nth(3)?;
            let colour = text::triple(bytes, &mut words, "colour").ok()?;
            Some(colour.map(|channel| channel * FULL))
        };
        self.vertex_lines.iter().map(of).collect()
    }
}

/// Reads a file's bytes.
pub fn parse(bytes: &[u8]) -> Result<(Geometry, Obj), Malformed> {
    let mut geometry = Geometry::default();
    let (mut vertex_lines, mut normal_lines) = (Vec::new(), Vec::new());
    // Vertex and normal of the corners that have both.
    let mut pairs = Vec::new();
    let mut corners = Vec::new();
    let mut at = text::start(bytes);
    while at < bytes.len() {
        let (range, next) = logical_line(bytes, at);
        let mut words = text::words(bytes, range);
        match words.next().map(|word| &bytes[word]) {
            Some(b"v") => {
                geometry
                    .positions
                    .push(text::triple(bytes, &mut words, "vertex")?);
                vertex_lines.push(at);
            }
            Some(b"vn") => normal_lines.push(at),
            Some(b"f") => {
                let counts = [geometry.positions.len(), normal_lines.len()];
                read_face(bytes, words, counts, &mut corners, &mut pairs)?;
                geometry.push_polygon(&corners, at);
            }
            _ => {}
        }
        at = next;
    }
    geometry.check(true)?;
    let normal_of = partners(geometry.positions.len(), pairs.iter().copied());
    let vertex_of = partners(normal_lines.len(), pairs.iter().map(|&(v, n)| (n, v)));
    Ok((
        geometry,
        Obj {
            vertex_lines,
            normal_lines,
            normal_of,
            vertex_of,
        },
    ))
}

/// Reads the corners `v`, `v/vt`, `v//vn` or `v/vt/vn` of a face; negative numbers count backwards.
fn read_face(
    bytes: &[u8],
    words: Words<'_>,
    [vertices, normals]: [usize; 2],
    corners: &mut Vec<u32>,
    pairs: &mut Vec<(u32, u32)>,
) -> Result<(), Malformed> {
    corners.clear();
    for word in words {
        let at = word.start;
        let mut parts = bytes[word.clone()].split(|&byte| byte == b'/').map(<[u8]>::len);
        let length = parts.next().unwrap_or_default();
        let corner = index(bytes, at..at + length, vertices)?;
        corners.push(corner);
        let texture = parts.next();
        if let (Some(texture), Some(normal)) = (texture, parts.next())
            && normal > 0
        {
            let start = at + length + 1 + texture + 1;
            pairs.push((corner, index(bytes, start..start + normal, normals)?));
        }
    }
    Ok(())
}

/// An index, 0-based.
fn index(bytes: &[u8], word: Range<usize>, count: usize) -> Result<u32, Malformed> {
    let at = word.start;
    let value = text::integer(bytes, word, "face")?;
    if value == 0 {
        return Err(Malformed::text(at, "a face names element 0; OBJ counts from 1"));
    }
    let index = if value < 0 {
        value.saturating_add(count as i64)
    } else {
        value - 1
    };
    if index < 0 {
        return Err(Malformed::text(
            at,
            format!("a face names element {value}, but only {count} come before it"),
        ));
    }
    Geometry::corner(index, at, true)
}

/// For each of `count` elements the one partner it is paired with, NONE or MANY.
fn partners(count: usize, pairs: impl Iterator<Item = (u32, u32)>) -> Vec<u32> {
    let mut partners = vec![NONE; count];
    for (element, partner) in pairs {
        if let Some(slot) = partners.get_mut(element as usize) {
            *slot = if *slot == NONE || *slot == partner {
                partner
            } else {
                MANY
            };
        }
    }
    partners
}

impl Obj {
    /// Replaces coordinates of moved vertices, and the normals that belong to one vertex only; returns the
    /// number of vertices whose normals do not.
    pub fn patch(&self, bytes: &[u8], change: &Change<'_>, patches: &mut Patches) -> usize {
        let mut stale = 0;
        let mut replace = |at: usize, values: [f64; 3]| {
            let (range, _) = logical_line(bytes, at);
            let mut words = text::words(bytes, range);
            words.next();
            patches.replace_words(&mut words, values);
        };
        for (v, position, normal) in change.vertices() {
            if let Some(position) = position {
                replace(self.vertex_lines[v], position);
            }
            let partner = self.normal_of[v];
            let is_own = self.vertex_of.get(partner as usize) == Some(&(v as u32));
            match normal {
                Some(normal) if is_own => replace(self.normal_lines[partner as usize], normal),
                _ if partner == NONE => {}
                _ => stale += 1,
            }
        }
        stale
    }
}

/// A file with vertices and faces.
pub fn plain(positions: &[[f64; 3]], polygons: &[impl AsRef<[u32]>]) -> Vec<u8> {
    let mut out = String::new();
    for position in positions {
        let [x, y, z] = position.map(text::double);
        out.push_str(&format!("v {x} {y} {z}\n"));
    }
    for polygon in polygons.iter().map(AsRef::as_ref) {
        out.push('f');
        polygon
            .iter()
            .for_each(|&corner| out.push_str(&format!(" {}", u64::from(corner) + 1)));
        out.push('\n');
    }
    out.into_bytes()
}
