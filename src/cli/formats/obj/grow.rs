//! New lines at the end of an OBJ file: vertices with colours and texture coordinates where the file has them, and faces.

use std::collections::BTreeMap;
use std::ops::Range;

use super::lines::logical_line;
use crate::formats::added::{Added, average};
use crate::formats::carry::Corners;
use crate::text::{self, Words};

/// What the file says about its vertices besides where they are.
#[derive(Default)]
pub(super) struct Attributes {
    /// Per vertex the colour behind its position.
    colours: Vec<Option<[f64; 3]>>,
    /// The `vt` lines; None where one cannot be read.
    coordinates: Vec<Option<[f64; 2]>>,
    /// Per vertex the `vt` of its first corner, from 0. A vertex on a seam has several; the first one counts.
    texture_of: Vec<Option<usize>>,
    /// Per triangle the texture coordinates of its corners.
    pub(super) wedges: Vec<Option<Corners>>,
    /// Per triangle the lines that say its group, material and smoothing.
    settings: Vec<Settings>,
    /// The last of these lines.
    last: Settings,
}

/// Lines that hold for the faces behind them.
const SETTINGS: [&[u8]; 3] = [b"g", b"usemtl", b"s"];

/// The last such lines.
pub type Settings = [Option<Range<usize>>; SETTINGS.len()];

/// The file with lines for new vertices and faces behind its own. `was` is what attributes are carried over from.
pub fn grown(bytes: &[u8], added: &Added<'_>, was: Option<&[u8]>, faces: &[[u32; 3]]) -> Vec<u8> {
    let old = added.old_vertices();
    let mut attributes = Attributes::read(bytes, old);
    let mut out = bytes.to_vec();
    if out.last().is_some_and(|&last| !matches!(last, b'\n' | b'\r')) {
        out.push(b'\n');
    }
    let mut textures = String::new();
    let was = added.carry.zip(was).map(|(carry, bytes)| {
        let count = carry.geometry.positions.len();
        (carry, bytes, Attributes::read(bytes, count))
    });
    for (i, (position, parents)) in added.positions[old..].iter().zip(added.parents).enumerate() {
        let carried = was
            .as_ref()
            .and_then(|(carry, _, was)| Some((carry.vertices[i].as_ref()?, was)));
        let colour = match carried {
            Some((carried, was)) => average(&carried.parents, |v| was.colours[v]),
            None => average(parents, |v| attributes.colours[v]),
        };
        let words = position.iter().chain(colour.iter().flatten());
        let words: Vec<String> = words.map(|&c| text::double(c)).collect();
        out.extend(format!("v {}\n", words.join(" ")).bytes());
        if was.is_some() {
            continue;
        }
        let coordinate = average(parents, |v| attributes.coordinates[attributes.texture_of[v]?]);
        attributes
            .texture_of
            .push(coordinate.map(|_| attributes.coordinates.len()));
        if let Some([u, v]) = coordinate {
            attributes.coordinates.push(coordinate);
            textures += &format!("vt {} {}\n", text::double(u), text::double(v));
        }
    }
    let mut corners: Vec<[Option<usize>; 3]> = Vec::with_capacity(faces.len());
    match &was {
        None => corners.extend(
            faces
                .iter()
                .map(|face| face.map(|v| attributes.texture_of[v as usize])),
        ),
        Some((carry, _, was)) => {
            let mut known = BTreeMap::new();
            for (face, texture) in faces.iter().zip(carry.textures(&was.wedges, faces)) {
                let mut named = [None; 3];
                for (k, [u, v]) in texture.iter().flatten().enumerate() {
                    let place = known.entry((face[k], [u.to_bits(), v.to_bits()]));
                    named[k] = Some(*place.or_insert_with(|| {
                        textures += &format!("vt {} {}\n", text::double(*u), text::double(*v));
                        attributes.coordinates.push(Some([*u, *v]));
                        attributes.coordinates.len() - 1
                    }));
                }
                corners.push(named);
            }
        }
    }
    out.extend(textures.bytes());
    // What holds at the end of the file.
    let mut now = attributes
        .last
        .clone()
        .map(|line| line.map_or(&b""[..], |line| &bytes[line]));
    for (i, (face, textures)) in faces.iter().zip(corners).enumerate() {
        // The first setting is the group.
        let is_marked = added.mark.is_some_and(|mark| i >= mark.first);
        if let Some(mark) = added.mark.filter(|mark| i == mark.first) {
            out.extend(format!("g {}\n", mark.name).bytes());
        }
        if let Some((carry, bytes, was)) = &was
            && let Some(carried) = &carry.faces[i]
        {
            let of_face = &was.settings[carried.triangle as usize];
            for (now, then) in now.iter_mut().zip(of_face).skip(usize::from(is_marked)) {
                let then = then.clone().map_or(*now, |line| &bytes[line]);
                if then != *now {
                    out.extend(then);
                    out.push(b'\n');
                    *now = then;
                }
            }
        }
        let is_textured = textures.iter().all(Option::is_some);
        out.push(b'f');
        for (v, texture) in face.iter().zip(textures) {
            match texture {
                Some(texture) if is_textured => out.extend(format!(" {}/{}", v + 1, texture + 1).bytes()),
                _ => out.extend(format!(" {}", v + 1).bytes()),
            }
        }
        out.push(b'\n');
    }
    out
}

/// Per triangle the lines that say its group, material and smoothing.
pub fn settings(bytes: &[u8]) -> Vec<Settings> {
    Attributes::read(bytes, 0).settings
}

impl Attributes {
    /// The same walk over the lines succeeded when the file was read.
    pub(super) fn read(bytes: &[u8], vertices: usize) -> Self {
        let mut attributes = Self {
            texture_of: vec![None; vertices],
            ..Self::default()
        };
        let mut at = text::start(bytes);
        while at < bytes.len() {
            let (range, next) = logical_line(bytes, at);
            let mut words = text::words(bytes, range.clone());
            match words.next().map(|word| &bytes[word]) {
                Some(b"v") => attributes.colours.push(colour(bytes, words)),
                Some(b"vt") => {
                    let mut number = || text::number(bytes, words.next()?, "vt").ok();
                    attributes
                        .coordinates
                        .push(number().map(|u| [u, number().unwrap_or(0.0)]));
                }
                Some(b"f") => attributes.corners(bytes, words),
                Some(word) => {
                    if let Some(which) = SETTINGS.iter().position(|&name| name == word) {
                        attributes.last[which] = Some(range);
                    }
                }
                None => {}
            }
            at = next;
        }
        attributes
    }

    fn corners(&mut self, bytes: &[u8], words: Words<'_>) {
        let counts = [self.colours.len(), self.coordinates.len()];
        let mut of_corners = Vec::new();
        for word in words {
            let mut parts = bytes[word].split(|&byte| byte == b'/');
            let mut index = |count: usize| -> Option<usize> {
                let number: i64 = std::str::from_utf8(parts.next()?).ok()?.parse().ok()?;
                let index = if number < 0 {
                    number + count as i64
                } else {
                    number - 1
                };
                usize::try_from(index).ok()
            };
            let (vertex, texture) = (index(counts[0]), index(counts[1]));
            of_corners.push(texture.and_then(|texture| *self.coordinates.get(texture)?));
            if let (Some(v), Some(texture)) = (vertex, texture)
                && let Some(slot) = self.texture_of.get_mut(v)
                && slot.is_none()
                && texture < counts[1]
            {
                *slot = Some(texture);
            }
        }
        let of_triangle = |i: usize| Some([of_corners[0]?, of_corners[i]?, of_corners[i + 1]?]);
        let triangles = 1..of_corners.len().saturating_sub(1);
        self.settings.extend(triangles.clone().map(|_| self.last.clone()));
        self.wedges.extend(triangles.map(of_triangle));
    }
}

/// Three numbers behind a position: its colour. Fewer (a weight) or more are none.
fn colour(bytes: &[u8], words: Words<'_>) -> Option<[f64; 3]> {
    let numbers: Vec<f64> = words
        .skip(3)
        .map(|word| text::number(bytes, word, "colour").ok())
        .collect::<Option<_>>()?;
    numbers.try_into().ok()
}
