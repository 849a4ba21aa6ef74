//! New rows at the end of a PLY file's vertices and faces.

use super::header::{Encoding, PropertyKind, Scalar};
use super::rows::Field;
use super::{FLAGS, Ply, SELECTED, Table, rows};
use crate::formats::added::{Added, average};
use crate::formats::carry::Corners;
use crate::formats::patches::Patches;
use crate::normals;
use crate::text;

/// Properties of vertices that may be averaged. Others are zero at new vertices.
const AVERAGED: [&str; 21] = [
    "red",
    "green",
    "blue",
    "alpha",
    "diffuse_red",
    "diffuse_green",
    "diffuse_blue",
    "r",
    "g",
    "b",
    "a",
    "quality",
    "confidence",
    "intensity",
    "u",
    "v",
    "s",
    "t",
    "texture_u",
    "texture_v",
    "radius",
];

impl Ply {
    /// Rows for what was added; the file's own rows stay as they are. `was` is what attributes are carried over from.
    pub fn grow(
        &self,
        bytes: &[u8],
        added: &Added<'_>,
        was: Option<(&Ply, &[u8])>,
        faces: &[[u32; 3]],
        patches: &mut Patches,
    ) {
        let old_vertices = added.old_vertices();
        let mut new = Vec::new();
        let normals = match self.normal {
            Some(_) => normals::all(added.positions, added.triangles),
            None => Vec::new(),
        };
        let was = added.carry.zip(was);
        for (i, parents) in added.parents.iter().enumerate() {
            let v = old_vertices + i;
            let carried = was.and_then(|(carry, was)| Some((carry.vertices[i].as_ref()?, was)));
            let values = match carried {
                Some((carried, (was, bytes))) => {
                    was.averaged(bytes, carried.parents.vertices, carried.parents.weights)
                }
                None => self.averaged(bytes, parents.vertices, parents.weights),
            };
            self.push_row(&mut new, &self.vertex, |property| {
                if let Some(axis) = self.position.iter().position(|&p| p == property) {
                    return added.positions[v][axis];
                }
                let normal = self
                    .normal
                    .and_then(|columns| columns.iter().position(|&p| p == property));
                normal.map_or(values[property], |axis| normals[v][axis])
            });
        }
        self.insert(bytes, &self.vertex, added.parents.len(), new, patches);
        if let Some((carry, (was, was_bytes))) = was {
            let textures = carry.textures(&was.corners(was_bytes), faces);
            let mut new = Vec::new();
            for (i, ((corners, texture), carried)) in faces.iter().zip(textures).zip(carry.faces).enumerate()
            {
                let polygon = carried
                    .as_ref()
                    .map(|of| carry.geometry.polygon_of(of.triangle as usize));
                let values = polygon.map(|polygon| was.numbers_of_face(was_bytes, polygon));
                let value = |property: usize| {
                    let carried = values.as_ref().map_or(0.0, |values| values[property]);
                    self.mark(property, i, added).unwrap_or(carried)
                };
                self.push_face(
                    &mut new,
                    corners,
                    texture.map_or([None; 3], |of| of.map(Some)),
                    value,
                );
            }
            self.insert(bytes, &self.face, faces.len(), new, patches);
            return;
        }
        let mut wedges = self.wedges(bytes, old_vertices);
        for parents in added.parents {
            let wedge = average(parents, |v| *wedges.get(v)?);
            wedges.push(wedge);
        }
        let mut new = Vec::new();
        for (i, corners) in faces.iter().enumerate() {
            let of = corners.map(|v| *wedges.get(v as usize)?);
            self.push_face(&mut new, corners, of, |property| {
                self.mark(property, i, added).unwrap_or(0.0)
            });
        }
        self.insert(bytes, &self.face, faces.len(), new, patches);
    }

    /// The values of every property, weighted over three vertices; zero where that means nothing.
    fn averaged(&self, bytes: &[u8], vertices: [u32; 3], weights: [f64; 3]) -> Vec<f64> {
        let element = &self.vertex.element;
        let rows = self.rows(bytes, &self.vertex);
        let mut values = vec![0.0; element.properties.len()];
        for (v, w) in vertices.into_iter().zip(weights).filter(|(_, w)| *w > 0.0) {
            // The same walk succeeded when the file was read.
            let _ = rows.walk(self.vertex.rows[v as usize], &mut |property, field: Field| {
                let described = &element.properties[property];
                let name = described.name.as_str();
                let is_averaged = AVERAGED.contains(&name) || name.starts_with("scalar_");
                if is_averaged && let PropertyKind::Scalar(_) = described.kind {
                    values[property] += w * rows.scalar(property, &field)?;
                }
                Ok(())
            });
        }
        values
    }

    fn push_row(&self, out: &mut Vec<u8>, table: &Table, value: impl Fn(usize) -> f64) {
        for (property, described) in table.element.properties.iter().enumerate() {
            match described.kind {
                PropertyKind::Scalar(scalar) => self.push(out, scalar, value(property)),
                PropertyKind::List { count, .. } => self.push(out, count, 0.0),
            }
        }
        self.end_row(out);
    }

    /// Per vertex the texture coordinates that the faces' `texcoord` has for its first corner; a vertex on a seam has
    /// several.
    fn wedges(&self, bytes: &[u8], vertices: usize) -> Vec<Option<[f64; 2]>> {
        let element = &self.face.element;
        let (Some(texture), Some(wanted)) = (element.property("texcoord"), element.vertex_indices()) else {
            return Vec::new();
        };
        let rows = self.rows(bytes, &self.face);
        let mut wedges = vec![None; vertices];
        let (mut corners, mut coordinates) = (Vec::new(), Vec::new());
        for &row in &self.face.rows {
            corners.clear();
            coordinates.clear();
            // The same walk succeeded when the file was read.
            let _ = rows.walk(row, &mut |property, field: Field| {
                if property == wanted {
                    rows.integers(property, &field, &mut corners)?;
                } else if property == texture {
                    coordinates = rows.numbers(property, &field)?;
                }
                Ok(())
            });
            for (&v, pair) in corners.iter().zip(coordinates.chunks_exact(2)) {
                let slot = usize::try_from(v).ok().and_then(|v| wedges.get_mut(v));
                if let Some(slot @ None) = slot {
                    *slot = Some([pair[0], pair[1]]);
                }
            }
        }
        wedges
    }

    /// Per triangle the texture coordinates of its corners.
    pub(super) fn corners(&self, bytes: &[u8]) -> Vec<Option<Corners>> {
        let element = &self.face.element;
        let texture = element.property("texcoord");
        let rows = self.rows(bytes, &self.face);
        let mut all = Vec::new();
        for &row in &self.face.rows {
            let (mut corners, mut coordinates) = (Vec::new(), Vec::new());
            // The same walk succeeded when the file was read.
            let _ = rows.walk(row, &mut |property, field: Field| {
                if Some(property) == element.vertex_indices() {
                    rows.integers(property, &field, &mut corners)?;
                } else if Some(property) == texture {
                    coordinates = rows.numbers(property, &field)?;
                }
                Ok(())
            });
            let pair = |i: usize| Some([*coordinates.get(2 * i)?, *coordinates.get(2 * i + 1)?]);
            let of_triangle = |i: usize| Some([pair(0)?, pair(i)?, pair(i + 1)?]);
            all.extend((1..corners.len().saturating_sub(1)).map(of_triangle));
        }
        all
    }

    /// The values of a face's properties that are numbers; zero for the others.
    pub fn numbers_of_face(&self, bytes: &[u8], face: usize) -> Vec<f64> {
        let properties = &self.face.element.properties;
        let rows = self.rows(bytes, &self.face);
        let mut values = vec![0.0; properties.len()];
        // The same walk succeeded when the file was read.
        let _ = rows.walk(self.face.rows[face], &mut |property, field: Field| {
            if let PropertyKind::Scalar(_) = properties[property].kind {
                values[property] = rows.scalar(property, &field)?;
            }
            Ok(())
        });
        values
    }

    /// The value of a property of the new face of this number that marks it.
    fn mark(&self, property: usize, face: usize, added: &Added<'_>) -> Option<f64> {
        let mark = added.mark.filter(|mark| face >= mark.first)?;
        let name = &self.face.element.properties[property].name;
        let value = match mark.name {
            FLAGS => SELECTED as f64,
            _ => 1.0,
        };
        (name == mark.name).then_some(value)
    }

    fn push_face(
        &self,
        out: &mut Vec<u8>,
        corners: &[u32; 3],
        wedges: [Option<[f64; 2]>; 3],
        value: impl Fn(usize) -> f64,
    ) {
        let element = &self.face.element;
        let (wanted, texture) = (element.vertex_indices(), element.property("texcoord"));
        for (property, described) in element.properties.iter().enumerate() {
            match described.kind {
                PropertyKind::Scalar(scalar) => self.push(out, scalar, value(property)),
                PropertyKind::List { count, item } if Some(property) == wanted => {
                    self.push(out, count, 3.0);
                    corners.iter().for_each(|&v| self.push(out, item, f64::from(v)));
                }
                PropertyKind::List { count, item }
                    if Some(property) == texture && wedges.iter().all(Option::is_some) =>
                {
                    self.push(out, count, 6.0);
                    wedges
                        .iter()
                        .flatten()
                        .flatten()
                        .for_each(|&c| self.push(out, item, c));
                }
                PropertyKind::List { count, .. } => self.push(out, count, 0.0),
            }
        }
        self.end_row(out);
    }

    fn push(&self, out: &mut Vec<u8>, scalar: Scalar, value: f64) {
        if scalar.is_integer() {
            out.extend(integer(self.encoding, scalar, value));
        } else {
            out.extend(rows::encode(self.encoding, scalar, value));
        }
        if self.is_text() {
            out.push(b' ');
        }
    }

    fn end_row(&self, out: &mut Vec<u8>) {
        if self.is_text() {
            out.pop();
            out.push(b'\n');
        }
    }

    /// Puts rows behind the table's last one and corrects the count in the header.
    fn insert(&self, bytes: &[u8], table: &Table, count: usize, mut new: Vec<u8>, patches: &mut Patches) {
        let Some(&last) = table.rows.last() else { return };
        if count == 0 {
            return;
        }
        let Ok(end) = self.rows(bytes, table).walk(last, &mut |_, _| Ok(())) else {
            return;
        };
        if self.is_text() && !matches!(bytes.get(end - 1), Some(b'\n' | b'\r')) {
            new.insert(0, b'\n');
        }
        patches.replace(end..end, &new);
        let (line, _) = text::line(bytes, table.element.at);
        if let Some(word) = text::words(bytes, line).nth(2) {
            patches.replace(word, (table.rows.len() + count).to_string().as_bytes());
        }
    }
}

/// A whole number as the file writes it: rounded and moved into the type's range.
pub(super) fn integer(encoding: Encoding, scalar: Scalar, value: f64) -> Vec<u8> {
    let value = value.round();
    let mut bytes = match scalar {
        Scalar::I8 => (value as i8).to_le_bytes().to_vec(),
        Scalar::U8 => (value as u8).to_le_bytes().to_vec(),
        Scalar::I16 => (value as i16).to_le_bytes().to_vec(),
        Scalar::U16 => (value as u16).to_le_bytes().to_vec(),
        Scalar::I32 => (value as i32).to_le_bytes().to_vec(),
        _ => (value as u32).to_le_bytes().to_vec(),
    };
    match encoding {
        Encoding::Ascii => (value as i64).to_string().into_bytes(),
        Encoding::Little => bytes,
        Encoding::Big => {
            bytes.reverse();
            bytes
        }
    }
}
