//! A PLY file with one more property of its faces.

use super::grow::integer;
use super::header::{PropertyKind, Scalar};
use super::rows::Field;
use super::{FLAGS, Ply};
use crate::formats::patches::Patches;
use crate::text;

impl Ply {
    /// Whether a face can be marked by a property of this name: it is a number, or there is none yet.
    pub fn can_mark(&self, name: &str) -> bool {
        let element = &self.face.element;
        let of = element.property(name).map(|p| element.properties[p].kind);
        of.is_none_or(|kind| matches!(kind, PropertyKind::Scalar(_)))
    }

    /// Declares a property of faces, zero for all; nothing where it is declared.
    pub fn declare(&self, bytes: &[u8], name: &str, patches: &mut Patches) {
        let element = &self.face.element;
        if element.property(name).is_some() {
            return;
        }
        let (kind, scalar) = match name {
            FLAGS => ("int", Scalar::I32),
            _ => ("uchar", Scalar::U8),
        };
        // Behind the last line of the element.
        let (line, mut at) = text::line(bytes, element.at);
        let end_of_line = bytes[line.end..at].to_vec();
        let mut last = at;
        loop {
            let (line, next) = text::line(bytes, at);
            let word = text::words(bytes, line).next();
            match word.map_or(&b""[..], |word| &bytes[word]) {
                b"property" => last = next,
                b"element" | b"end_header" => break,
                _ => {}
            }
            at = next;
        }
        let declared = [format!("property {kind} {name}").as_bytes(), &end_of_line].concat();
        patches.replace(last..last, &declared);
        let gap = if self.is_text() { &b" "[..] } else { b"" };
        let zero = [gap, &integer(self.encoding, scalar, 0.0)].concat();
        let rows = self.rows(bytes, &self.face);
        for &row in &self.face.rows {
            let mut end = row;
            // The same walk succeeded when the file was read.
            let _ = rows.walk(row, &mut |_, field: Field| {
                end = field.end;
                Ok(())
            });
            patches.replace(end..end, &zero);
        }
    }
}
