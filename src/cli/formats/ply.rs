//! PLY, ASCII and binary of either byte order, with any elements and properties.

mod grow;
mod header;
mod mark;
mod only;
mod rows;
pub mod strips;
mod texture;

use crate::failure::Malformed;
use crate::formats::change::Change;
use crate::formats::geometry::{Geometry, Kind};
use crate::formats::patches::Patches;
use crate::text::Layout;
use header::{Element, Encoding, Header, PropertyKind, Scalar};
use rows::{Field, Rows};

/// The property in which MeshLab (VCG) writes what is selected.
const FLAGS: &str = "flags";
/// Its bit for "selected", of vertices and faces alike.
const SELECTED: i64 = 0x20;

/// Where vertices and faces are.
pub struct Ply {
    encoding: Encoding,
    /// Of a text.
    layout: Layout,
    vertex: Table,
    face: Table,
    /// The properties x, y, z.
    position: [usize; 3],
    /// The properties nx, ny, nz, if the file has them as floats.
    normal: Option<[usize; 3]>,
    /// Rows of other elements.
    has_others: bool,
}

/// An element and the byte offset of each of its rows.
struct Table {
    element: Element,
    rows: Vec<usize>,
}

/// Reads a file's bytes.
pub fn parse(bytes: &[u8]) -> Result<(Geometry, Ply), Malformed> {
    let header = header::parse(bytes)?;
    if header.encoding == Encoding::Ascii {
        Layout::find(|layout| read(bytes, &header, layout))
    } else {
        read(bytes, &header, Layout::Lines)
    }
}

fn read(bytes: &[u8], header: &Header, layout: Layout) -> Result<(Geometry, Ply), Malformed> {
    let mut geometry = Geometry::default();
    let (mut vertex, mut face) = (None, None);
    let mut has_others = false;
    let mut at = header.end;
    for element in &header.elements {
        let rows = Rows::of(bytes, header, layout, element);
        let mut offsets = Vec::new();
        let table = match element.name.as_str() {
            "vertex" => {
                at = read_vertices(&rows, at, &mut geometry, &mut offsets)?;
                &mut vertex
            }
            "face" => {
                at = read_faces(&rows, at, &mut geometry, &mut offsets)?;
                &mut face
            }
            _ => {
                at = pass_over(&rows, at)?;
                has_others |= element.count > 0;
                continue;
            }
        };
        let (element, rows) = (element.clone(), offsets);
        *table = Some(Table { element, rows });
    }
    if header.encoding == Encoding::Ascii {
        layout.end(bytes, at)?;
    }
    let vertex = vertex.ok_or_else(|| Malformed::text(0, "the file has no element 'vertex'"))?;
    let face = face.ok_or_else(|| {
        Malformed::text(
            0,
            "the file has no element 'face': a mesh, not a point cloud, is needed",
        )
    })?;
    geometry.check(header.encoding == Encoding::Ascii)?;
    let position = position_columns(&vertex.element)?;
    let normal = triple(&vertex.element, ["nx", "ny", "nz"], |scalar| !scalar.is_integer()).ok();
    Ok((
        geometry,
        Ply {
            encoding: header.encoding,
            layout,
            vertex,
            face,
            position,
            normal,
            has_others,
        },
    ))
}

impl Ply {
    /// Whether any coordinate is a float.
    pub fn has_single_positions(&self) -> bool {
        let properties = &self.vertex.element.properties;
        self.position
            .iter()
            .any(|&p| properties[p].kind == PropertyKind::Scalar(Scalar::F32))
    }
}

/// The three properties of these names, if they are numbers of which each `is_allowed`.
fn triple(
    element: &Element,
    names: [&str; 3],
    is_allowed: fn(Scalar) -> bool,
) -> Result<[usize; 3], Malformed> {
    let is_number = |&p: &usize| match element.properties[p].kind {
        PropertyKind::Scalar(scalar) => is_allowed(scalar),
        PropertyKind::List { .. } => false,
    };
    let mut found = [0; 3];
    for (slot, name) in found.iter_mut().zip(names) {
        *slot = element.property(name).filter(is_number).ok_or_else(|| {
            let what = format!("element '{}' needs a number '{name}' in every row", element.name);
            Malformed::text(element.at, what)
        })?;
    }
    Ok(found)
}

fn position_columns(element: &Element) -> Result<[usize; 3], Malformed> {
    triple(element, ["x", "y", "z"], |_| true)
}

fn read_vertices(
    rows: &Rows<'_>,
    at: usize,
    geometry: &mut Geometry,
    offsets: &mut Vec<usize>,
) -> Result<usize, Malformed> {
    let wanted = position_columns(rows.element)?;
    let count = rows.check_count(at)?;
    offsets.reserve_exact(count);
    geometry.positions.reserve_exact(count);
    let mut at = at;
    for _ in 0..count {
        let mut position = [0.0; 3];
        at = rows.start(at)?;
        offsets.push(at);
        at = rows.walk(at, &mut |property, field: Field| {
            if let Some(axis) = wanted.iter().position(|&w| w == property) {
                position[axis] = rows.scalar(property, &field)?;
            }
            Ok(())
        })?;
        geometry.positions.push(position);
    }
    Ok(at)
}

fn read_faces(
    rows: &Rows<'_>,
    at: usize,
    geometry: &mut Geometry,
    offsets: &mut Vec<usize>,
) -> Result<usize, Malformed> {
    let element = rows.element;
    let is_list = |&p: &usize| match element.properties[p].kind {
        PropertyKind::List { item, .. } => item.is_integer(),
        PropertyKind::Scalar(_) => false,
    };
    let wanted = element.vertex_indices().filter(is_list).ok_or_else(|| {
        Malformed::text(
            element.at,
            "element 'face' needs a list of integers 'vertex_indices'",
        )
    })?;
    let count = rows.check_count(at)?;
    offsets.reserve_exact(count);
    let (mut values, mut corners) = (Vec::new(), Vec::new());
    let mut at = at;
    for _ in 0..count {
        at = rows.start(at)?;
        let row = at;
        offsets.push(row);
        at = rows.walk(row, &mut |property, field: Field| {
            if property != wanted {
                return Ok(());
            }
            rows.integers(property, &field, &mut values)?;
            corners.clear();
            for &value in &values {
                corners.push(Geometry::corner(value, row, rows.encoding == Encoding::Ascii)?);
            }
            if rows.layout == Layout::Free && corners.len() < 3 {
                return Err(rows.malformed(row, "a face of fewer than three corners"));
            }
            geometry.push_polygon(&corners, row);
            Ok(())
        })?;
    }
    Ok(at)
}

/// Checks an element that means nothing here.
fn pass_over(rows: &Rows<'_>, at: usize) -> Result<usize, Malformed> {
    let mut at = at;
    for _ in 0..rows.check_count(at)? {
        at = rows.walk(rows.start(at)?, &mut |_, _| Ok(()))?;
    }
    Ok(at)
}

impl Ply {
    fn is_text(&self) -> bool {
        self.encoding == Encoding::Ascii
    }

    fn rows<'a>(&self, bytes: &'a [u8], table: &'a Table) -> Rows<'a> {
        Rows {
            bytes,
            encoding: self.encoding,
            layout: self.layout,
            element: &table.element,
        }
    }

    /// Whether a coordinate is a whole number by its type, so that no result can be written in its place.
    pub fn is_whole(&self) -> bool {
        let properties = &self.vertex.element.properties;
        let is_integer = |&p: &usize| matches!(properties[p].kind, PropertyKind::Scalar(s) if s.is_integer());
        self.position.iter().any(is_integer)
    }

    /// The rows whose property `name` is nonzero; of `flags`, only the bit for "selected" counts.
    pub fn selected(&self, bytes: &[u8], kind: Kind, name: &str) -> Option<Vec<u32>> {
        let is_selected = |value: f64| match name {
            FLAGS => value as i64 & SELECTED != 0,
            _ => value != 0.0,
        };
        let (values, _) = self.numbers(bytes, kind, name)?;
        let numbered = (0..).zip(values);
        Some(
            numbered
                .filter(|(_, value)| is_selected(*value))
                .map(|(i, _)| i)
                .collect(),
        )
    }

    /// The names of the properties with one number per row.
    pub fn names(&self, kind: Kind) -> impl Iterator<Item = &str> {
        let table = match kind {
            Kind::Vertex => &self.vertex,
            Kind::Face => &self.face,
        };
        let is_scalar = |kind: &PropertyKind| matches!(kind, PropertyKind::Scalar(_));
        let properties = table.element.properties.iter();
        properties
            .filter(move |of| is_scalar(&of.kind))
            .map(|of| of.name.as_str())
    }

    /// The property `name` of every row, and whether it is a floating-point number by its type.
    pub fn numbers(&self, bytes: &[u8], kind: Kind, name: &str) -> Option<(Vec<f64>, bool)> {
        let table = match kind {
            Kind::Vertex => &self.vertex,
            Kind::Face => &self.face,
        };
        let wanted = table.element.property(name)?;
        let PropertyKind::Scalar(scalar) = table.element.properties[wanted].kind else {
            return None;
        };
        let rows = self.rows(bytes, table);
        let value_of = |&row: &usize| {
            let mut value = 0.0;
            // The row was walked before; only a word that is no number can fail, and is zero.
            let _ = rows.walk(row, &mut |property, field: Field| {
                if property == wanted {
                    value = rows.scalar(property, &field)?;
                }
                Ok(())
            });
            value
        };
        let is_float = matches!(scalar, Scalar::F32 | Scalar::F64);
        Some((table.rows.iter().map(value_of).collect(), is_float))
    }

    /// Replaces coordinates of moved vertices, and normals; returns the number of normals left behind.
    pub fn patch(&self, bytes: &[u8], change: &Change<'_>, patches: &mut Patches) -> usize {
        let element = &self.vertex.element;
        let rows = self.rows(bytes, &self.vertex);
        for (v, position, normal) in change.vertices() {
            let mut write = |columns: &[usize; 3], property: usize, field: &Field, values: [f64; 3]| {
                if let Some(axis) = columns.iter().position(|&column| column == property)
                    && let PropertyKind::Scalar(scalar) = element.properties[property].kind
                {
                    patches.replace(field.clone(), &rows::encode(self.encoding, scalar, values[axis]));
                }
            };
            // The same walk succeeded when the file was read.
            let _ = rows.walk(self.vertex.rows[v], &mut |property, field: Field| {
                if let Some(position) = position {
                    write(&self.position, property, &field, position);
                }
                if let (Some(columns), Some(normal)) = (&self.normal, normal) {
                    write(columns, property, &field, normal);
                }
                Ok(())
            });
        }
        0
    }
}

/// A binary file with doubles. Numbers of corners have one byte, if that is enough: MeshLab reads no others.
pub fn plain(positions: &[[f64; 3]], polygons: &[impl AsRef<[u32]>]) -> Vec<u8> {
    let is_short = polygons
        .iter()
        .all(|polygon| u8::try_from(polygon.as_ref().len()).is_ok());
    let header = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\n\
         property double z\nelement face {}\nproperty list {} int vertex_indices\nend_header\n",
        positions.len(),
        polygons.len(),
        if is_short { "uchar" } else { "uint" }
    );
    let mut bytes = header.into_bytes();
    for coordinate in positions.iter().flatten() {
        bytes.extend_from_slice(&coordinate.to_le_bytes());
    }
    for polygon in polygons.iter().map(AsRef::as_ref) {
        let count = (polygon.len() as u32).to_le_bytes();
        bytes.extend_from_slice(&count[..if is_short { 1 } else { 4 }]);
        polygon
            .iter()
            .for_each(|corner| bytes.extend_from_slice(&corner.to_le_bytes()));
    }
    bytes
}
