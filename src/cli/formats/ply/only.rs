//! A PLY file without some of its vertices and faces, or with faces turned around.

use super::grow::integer;
use super::rows::Field;
use super::{Ply, Table};
use crate::formats::patches::Patches;
use crate::text;

impl Ply {
    /// Whether there are rows that may name vertices besides faces: then no vertex can be dropped.
    pub fn has_other_rows(&self) -> bool {
        self.has_others
    }

    /// Drops rows, and renumbers the vertices of the faces that are left. All other bytes stay.
    pub fn only(&self, bytes: &[u8], vertices: &[bool], faces: &[bool], patches: &mut Patches) {
        self.drop_rows(bytes, &self.vertex, vertices, patches);
        self.drop_rows(bytes, &self.face, faces, patches);
        if vertices.iter().all(|&kept| kept) {
            return;
        }
        let mut number = Vec::with_capacity(vertices.len());
        let mut next = 0_u32;
        for &kept in vertices {
            number.push(next);
            next += u32::from(kept);
        }
        let rows = self.rows(bytes, &self.face);
        let wanted = self.face.element.vertex_indices();
        for (&row, _) in self.face.rows.iter().zip(faces).filter(|(_, kept)| **kept) {
            // The same walk succeeded when the file was read.
            let _ = rows.walk(row, &mut |property, field: Field| {
                if Some(property) == wanted {
                    self.renumber(bytes, property, field, &number, patches);
                }
                Ok(())
            });
        }
    }

    /// Turns these faces around, with their texture coordinates.
    pub fn turn(&self, bytes: &[u8], faces: &[bool], patches: &mut Patches) {
        let rows = self.rows(bytes, &self.face);
        let element = &self.face.element;
        let (wanted, texture) = (element.vertex_indices(), element.property("texcoord"));
        for (&row, _) in self.face.rows.iter().zip(faces).filter(|(_, turned)| **turned) {
            let (mut corners, mut lists) = (0, Vec::new());
            // The same walk succeeded when the file was read.
            let _ = rows.walk(row, &mut |property, field: Field| {
                let is_list = element.properties[property].kind.item().is_some();
                if is_list && (Some(property) == wanted || Some(property) == texture) {
                    let items = self.items(bytes, property, field);
                    if Some(property) == wanted {
                        corners = items.len();
                    }
                    lists.push(items);
                }
                Ok(())
            });
            for items in lists.iter().filter(|_| corners > 0) {
                patches.reverse(bytes, items, items.len() / corners);
            }
        }
    }

    /// The places of a list's items.
    fn items(&self, bytes: &[u8], property: usize, field: Field) -> Vec<Field> {
        match self.face.element.properties[property].kind.item() {
            _ if self.is_text() => text::words(bytes, field).collect(),
            Some(item) => {
                let starts = field.clone().step_by(item.size());
                starts.map(|start| start..start + item.size()).collect()
            }
            None => Vec::new(),
        }
    }

    fn renumber(&self, bytes: &[u8], property: usize, field: Field, number: &[u32], patches: &mut Patches) {
        let Some(item) = self.face.element.properties[property].kind.item() else {
            return;
        };
        let rows = self.rows(bytes, &self.face);
        let mut values = Vec::new();
        if rows.integers(property, &field, &mut values).is_err() {
            return;
        }
        let words = self.items(bytes, property, field);
        for (word, value) in words.into_iter().zip(values) {
            let new = usize::try_from(value).ok().and_then(|v| number.get(v));
            if let Some(&new) = new.filter(|new| i64::from(**new) != value) {
                patches.replace(word, &integer(self.encoding, item, f64::from(new)));
            }
        }
    }

    fn drop_rows(&self, bytes: &[u8], table: &Table, kept: &[bool], patches: &mut Patches) {
        let dropped = kept.iter().filter(|kept| !**kept).count();
        if dropped == 0 {
            return;
        }
        let rows = self.rows(bytes, table);
        for (&row, _) in table.rows.iter().zip(kept).filter(|(_, kept)| !**kept) {
            if let Ok(end) = rows.walk(row, &mut |_, _| Ok(())) {
                patches.replace(row..end, b"");
            }
        }
        let (line, _) = text::line(bytes, table.element.at);
        if let Some(word) = text::words(bytes, line).nth(2) {
            patches.replace(word, (table.rows.len() - dropped).to_string().as_bytes());
        }
    }
}
