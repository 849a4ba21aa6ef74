//! An OBJ file without some of its vertices and faces, or with faces turned around.

use super::lines::logical_line;
use crate::formats::patches::Patches;
use crate::text::{self, Words};

/// Lines that name vertices besides faces.
const OTHERS: [&[u8]; 5] = [b"l", b"p", b"curv", b"surf", b"fo"];

/// Whether there are such lines: then no vertex can be dropped.
pub fn has_other_lines(bytes: &[u8]) -> bool {
    let mut at = text::start(bytes);
    while at < bytes.len() {
        let (range, next) = logical_line(bytes, at);
        let first = text::words(bytes, range).next();
        if first.is_some_and(|word| OTHERS.contains(&&bytes[word])) {
            return true;
        }
        at = next;
    }
    false
}

/// The file without the lines of these vertices and faces. The vertices of the faces that are left are renumbered; all other bytes stay, texture
/// coordinates and normals that nothing uses any more, too.
pub fn only(bytes: &[u8], vertices: &[bool], faces: &[bool]) -> Vec<u8> {
    let mut number = Vec::with_capacity(vertices.len());
    let mut next_number = 0;
    for &kept in vertices {
        number.push(next_number);
        next_number += i64::from(kept);
    }
    let is_renumbered = vertices.iter().any(|kept| !kept);
    let mut patches = Patches::default();
    let (mut vertex, mut face) = (0, 0);
    let mut at = text::start(bytes);
    while at < bytes.len() {
        let (range, next) = logical_line(bytes, at);
        let mut words = text::words(bytes, range);
        match words.next().map(|word| &bytes[word]) {
            Some(b"v") => {
                if !vertices[vertex] {
                    patches.replace(at..next, b"");
                }
                vertex += 1;
            }
            Some(b"f") => {
                if !faces[face] {
                    patches.replace(at..next, b"");
                } else if is_renumbered {
                    renumber(bytes, words, &number, vertex, &mut patches);
                }
                face += 1;
            }
            _ => {}
        }
        at = next;
    }
    patches.apply(bytes)
}

/// Turns these faces around.
pub fn turn(bytes: &[u8], faces: &[bool], patches: &mut Patches) {
    let mut face = 0;
    let mut at = text::start(bytes);
    while at < bytes.len() {
        let (range, next) = logical_line(bytes, at);
        let mut words = text::words(bytes, range);
        if words.next().is_some_and(|word| &bytes[word] == b"f") {
            if faces[face] {
                patches.reverse(bytes, &words.collect::<Vec<_>>(), 1);
            }
            face += 1;
        }
        at = next;
    }
}

/// The corners' vertices, of which `seen` come before this line.
fn renumber(bytes: &[u8], words: Words<'_>, number: &[i64], seen: usize, patches: &mut Patches) {
    for word in words {
        let length = bytes[word.clone()]
            .iter()
            .take_while(|&&byte| byte != b'/')
            .count();
        let place = word.start..word.start + length;
        let Ok(old) = text::integer(bytes, place.clone(), "face") else {
            continue;
        };
        let index = if old < 0 { old + seen as i64 } else { old - 1 };
        let new = usize::try_from(index).ok().and_then(|v| number.get(v));
        if let Some(new) = new.filter(|new| **new + 1 != old) {
            patches.replace(place, (new + 1).to_string().as_bytes());
        }
    }
}
