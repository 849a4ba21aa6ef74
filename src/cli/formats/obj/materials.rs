//! Which material each triangle of an OBJ file has, and where its corners lie in the texture.

use super::grow::Attributes;
use super::lines::logical_line;
use crate::formats::carry::Corners;
use crate::text;

/// Per triangle the name behind the last `usemtl` before it, and its texture coordinates.
pub fn materials_and_corners(bytes: &[u8]) -> (Vec<Option<String>>, Vec<Option<Corners>>) {
    let (mut uses, mut material) = (Vec::new(), None);
    let mut at = text::start(bytes);
    while at < bytes.len() {
        let (range, next) = logical_line(bytes, at);
        let mut words = text::words(bytes, range.clone());
        match words.next().map(|word| &bytes[word]) {
            Some(b"usemtl") => {
                let name = words.next().map(|word| word.start..range.end);
                material =
                    name.map(|name| String::from_utf8_lossy(bytes[name].trim_ascii_end()).into_owned());
            }
            Some(b"f") => {
                let triangles = words.count().saturating_sub(2);
                uses.extend(std::iter::repeat_n(material.clone(), triangles));
            }
            _ => {}
        }
        at = next;
    }
    (uses, Attributes::read(bytes, 0).wedges)
}
