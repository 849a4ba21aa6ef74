//! New lines at the end of an OBJ file: vertices with colours and texture coordinates where the file has them, and faces.

use super::logical_line;
use crate::formats::{Added, average};
use crate::text::{self, Words};

/// What the file says about its vertices besides where they are.
#[derive(Default)]
struct Attributes {
    /// Per vertex the colour behind its position.
    colours: Vec<Option<[f64; 3]>>,
    /// The `vt` lines; None where one cannot be read.
    coordinates: Vec<Option<[f64; 2]>>,
    /// Per vertex the `vt` of its first corner, from 0. A vertex on a seam has several; the first one counts.
    texture_of: Vec<Option<usize>>,
}

/// The file with lines for new vertices and faces behind its own.
pub fn grown(bytes: &[u8], added: &Added<'_>, faces: &[[u32; 3]]) -> Vec<u8> {
    let old = added.old_vertices();
    let mut attributes = Attributes::read(bytes, old);
    let mut out = bytes.to_vec();
    if out.last().is_some_and(|&last| !matches!(last, b'\n' | b'\r')) {
        out.push(b'\n');
    }
    let mut textures = String::new();
    for (position, parents) in added.positions[old..].iter().zip(added.parents) {
        let colour = average(parents, |v| attributes.colours[v]);
        let words = position.iter().chain(colour.iter().flatten());
        let words: Vec<String> = words.map(|&c| text::double(c)).collect();
        out.extend(format!("v {}\n", words.join(" ")).bytes());
        let coordinate = average(parents, |v| attributes.coordinates[attributes.texture_of[v]?]);
        attributes
            .texture_of
            .push(coordinate.map(|_| attributes.coordinates.len()));
        if let Some([u, v]) = coordinate {
            attributes.coordinates.push(coordinate);
            textures += &format!("vt {} {}\n", text::double(u), text::double(v));
        }
    }
    out.extend(textures.bytes());
    for face in faces {
        let textures = face.map(|v| attributes.texture_of[v as usize]);
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

impl Attributes {
    /// The same walk over the lines succeeded when the file was read.
    fn read(bytes: &[u8], vertices: usize) -> Self {
        let mut attributes = Self {
            texture_of: vec![None; vertices],
            ..Self::default()
        };
        let mut at = text::start(bytes);
        while at < bytes.len() {
            let (range, next) = logical_line(bytes, at);
            let mut words = text::words(bytes, range);
            match words.next().map(|word| &bytes[word]) {
                Some(b"v") => attributes.colours.push(colour(bytes, words)),
                Some(b"vt") => {
                    let mut number = || text::number(bytes, words.next()?, "vt").ok();
                    attributes
                        .coordinates
                        .push(number().map(|u| [u, number().unwrap_or(0.0)]));
                }
                Some(b"f") => attributes.corners(bytes, words),
                _ => {}
            }
            at = next;
        }
        attributes
    }

    fn corners(&mut self, bytes: &[u8], words: Words<'_>) {
        let counts = [self.colours.len(), self.coordinates.len()];
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
            if let (Some(v), Some(texture)) = (index(counts[0]), index(counts[1]))
                && let Some(slot) = self.texture_of.get_mut(v)
                && slot.is_none()
                && texture < counts[1]
            {
                *slot = Some(texture);
            }
        }
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
