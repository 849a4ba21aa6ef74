//! Which vertices may move, and the normals given for the boundary.

use std::path::Path;

use crate::failure::{Failure, Malformed};
use crate::formats::{Kind, MeshFile};
use crate::normals;
use crate::text::{self, Words};

/// What the user selected, in the file's numbering.
#[derive(Debug, Clone, PartialEq)]
pub struct Selected {
    pub kind: Kind,
    /// Vertices or polygons.
    pub elements: Vec<u32>,
}

/// How the user says it.
#[derive(Debug, Clone, Copy, Default)]
pub struct Ways<'a> {
    /// A file of vertex numbers.
    pub free: Option<&'a Path>,
    /// A file of face numbers.
    pub faces: Option<&'a Path>,
    /// A property of the mesh file.
    pub property: Option<&'a str>,
}

/// Finds the selection.
pub fn find(mesh: &MeshFile, name: &str, ways: Ways<'_>) -> Result<Selected, Failure> {
    let selected = if let Some(path) = ways.free {
        let elements = indices(path, mesh.geometry.positions.len(), "vertices")?;
        Selected {
            kind: Kind::Vertex,
            elements,
        }
    } else if let Some(path) = ways.faces {
        Selected {
            kind: Kind::Face,
            elements: indices(path, mesh.geometry.polygon_count, "faces")?,
        }
    } else if let Some(property) = ways.property {
        named(mesh, name, property)?
    } else {
        stored(mesh, name)?
    };
    Ok(selected)
}

/// The selection of a property `NAME`, `vertex:NAME` or `face:NAME`.
fn named(mesh: &MeshFile, name: &str, property: &str) -> Result<Selected, Failure> {
    let (kinds, bare): (&[Kind], &str) = if let Some(bare) = property.strip_prefix("vertex:") {
        (&[Kind::Vertex], bare)
    } else if let Some(bare) = property.strip_prefix("face:") {
        (&[Kind::Face], bare)
    } else {
        (&[Kind::Vertex, Kind::Face], property)
    };
    let found = kinds
        .iter()
        .find_map(|&kind| Some((kind, mesh.selected(kind, bare)?)));
    match found {
        Some((kind, elements)) if !elements.is_empty() => Ok(Selected { kind, elements }),
        Some(_) => Err(Failure::new(format!(
            "{name}: nothing is selected in property '{property}'"
        ))),
        None => Err(Failure::new(format!(
            "{name}: there is no property '{property}' with one number per vertex or face (only PLY files have them)"
        ))),
    }
}

/// The selection that MeshLab stores in `flags`.
fn stored(mesh: &MeshFile, name: &str) -> Result<Selected, Failure> {
    let found = [Kind::Face, Kind::Vertex].into_iter().find_map(|kind| {
        let elements = mesh.selected(kind, "flags")?;
        (!elements.is_empty()).then_some(Selected { kind, elements })
    });
    found.ok_or_else(|| {
        Failure::new(format!(
            "{name}: nothing says which vertices may move; give --free FILE (vertex numbers), --faces FILE (face \
             numbers) or --selection NAME (a property of a PLY file), or save a PLY with selected faces"
        ))
    })
}

/// Reads a text file for parsing by lines.
fn read(path: &Path) -> Result<(String, Vec<u8>), Failure> {
    let name = path.display().to_string();
    let bytes = std::fs::read(path).map_err(|why| Failure::new(format!("{name}: cannot read: {why}")))?;
    Ok((name, bytes))
}

/// Calls `each` with the words of every line that has any.
fn lines(
    bytes: &[u8],
    mut each: impl FnMut(&mut Words<'_>) -> Result<(), Malformed>,
) -> Result<(), Malformed> {
    let mut at = 0;
    while at < bytes.len() {
        let (range, next) = text::line(bytes, at);
        let mut words = text::words(bytes, range);
        if words.clone().next().is_some() {
            each(&mut words)?;
            if let Some(more) = words.next() {
                let what = format!(
                    "{} is more than this line should have",
                    text::shown(bytes, more.clone())
                );
                return Err(Malformed::text(more.start, what));
            }
        }
        at = next;
    }
    Ok(())
}

/// An index below `count`; `what` is the plural of what it counts.
fn index(bytes: &[u8], words: &mut Words<'_>, count: usize, what: &str) -> Result<u32, Malformed> {
    let at = words.offset();
    let word = words.next().unwrap_or(at..at);
    let start = word.start;
    let index = text::integer(bytes, word, "index")?;
    match u32::try_from(index) {
        Ok(index) if (index as usize) < count => Ok(index),
        _ => {
            let what = format!("index {index} is out of range: the mesh has {count} {what}, counted from 0");
            Err(Malformed::text(start, what))
        }
    }
}

/// Indices below `count`, one per line; `what` is the plural of what they number.
pub fn indices(path: &Path, count: usize, what: &str) -> Result<Vec<u32>, Failure> {
    let (name, bytes) = read(path)?;
    let mut indices = Vec::new();
    lines(&bytes, |words| {
        indices.push(index(&bytes, words, count, what)?);
        Ok(())
    })
    .map_err(|malformed| malformed.locate(&name, &bytes))?;
    if indices.is_empty() {
        return Err(Failure::new(format!(
            "{name}: the file names no {what}; write one number per line, from 0"
        )));
    }
    Ok(indices)
}

/// Normals, `index nx ny nz` per line, brought to length one.
pub fn boundary_normals(path: &Path, vertex_count: usize) -> Result<Vec<(u32, [f64; 3])>, Failure> {
    let (name, bytes) = read(path)?;
    let mut given = Vec::new();
    lines(&bytes, |words| {
        let vertex = index(&bytes, words, vertex_count, "vertices")?;
        let at = words.offset();
        let normal = text::triple(&bytes, words, "normal")?;
        let unit = normals::unit(normal).ok_or_else(|| {
            Malformed::text(at, format!("the normal of vertex {vertex} is zero or not finite"))
        })?;
        given.push((vertex, unit));
        Ok(())
    })
    .map_err(|malformed| malformed.locate(&name, &bytes))?;
    Ok(given)
}
