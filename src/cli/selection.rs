//! Which vertices may move, and the normals given for the boundary.

use std::path::{Path, PathBuf};

use clap::Args;
use fairmesh::{BoundaryNormals, Coincident};

use crate::failure::{Failure, Malformed};
use crate::formats::packed;
use crate::formats::{Kind, MeshFile};
use crate::normals;
use crate::region::{Found, RegionReport, RegionSteps};
use crate::selected::Selected;
use crate::similar::similar;
use crate::text::{self, Words};

/// Flags of the region.
#[derive(Debug, Args)]
pub struct RegionArgs {
    #[command(flatten)]
    listed: ListArgs,
    #[command(flatten)]
    steps: RegionSteps,
}

/// Flags of a region that was chosen before.
#[derive(Debug, Args)]
#[command(next_help_heading = "Region")]
#[group(multiple = false)]
struct ListArgs {
    /// Vertices that may move: a text file, one number per line, from 0
    #[arg(long, value_name = "FILE")]
    free: Option<PathBuf>,
    /// Faces to fair: a text file, one number per line, from 0;
    /// a vertex moves if all faces around it are listed
    #[arg(long, visible_alias = "free-faces", value_name = "FILE", verbatim_doc_comment)]
    faces: Option<PathBuf>,
    /// PLY property that is nonzero where selected:
    /// NAME, vertex:NAME or face:NAME
    #[arg(long, value_name = "NAME", verbatim_doc_comment)]
    selection: Option<String>,
}

/// Finds the selection in the mesh of a file: what was chosen before, and what the steps make of it.
pub fn find(
    mesh: &MeshFile,
    path: &Path,
    args: &RegionArgs,
    coincident: Coincident,
) -> Result<Found, Failure> {
    let RegionArgs { listed, steps } = args;
    if steps.is_empty() {
        return Ok(Found {
            selected: before(mesh, path, listed)?,
            report: RegionReport::default(),
        });
    }
    let is_listed = listed.free.is_some() || listed.faces.is_some() || listed.selection.is_some();
    let first = match is_listed || !steps.begins_with_a_region() {
        true => Some(before(mesh, path, listed)?),
        false => None,
    };
    steps.find(mesh, path, first, coincident)
}

/// The faces to be erased: those of a list or of the file, or what the steps make of them.
pub fn to_erase(
    mesh: &MeshFile,
    path: &Path,
    (list, steps): (Option<&Path>, &RegionSteps),
    coincident: Coincident,
) -> Result<Found, Failure> {
    let count = mesh.geometry.polygon_count;
    let faces = |list| {
        let kind = Kind::Face;
        indices(list, count, "faces").map(|elements| Selected { kind, elements })
    };
    let first = match list {
        Some(list) => Some(faces(list)?),
        None if steps.begins_with_a_region() => None,
        None => Some(marked_faces(mesh, path)?),
    };
    match first {
        Some(selected) if steps.is_empty() => Ok(Found {
            selected,
            report: RegionReport::default(),
        }),
        first => steps.find(mesh, path, first, coincident),
    }
}

/// The faces that MeshLab has marked in a file.
fn marked_faces(mesh: &MeshFile, path: &Path) -> Result<Selected, Failure> {
    let elements = mesh.selected(Kind::Face, "flags").unwrap_or_default();
    match elements.is_empty() {
        false => Ok(Selected {
            kind: Kind::Face,
            elements,
        }),
        true => Err(Failure::new(format!(
            "{}: nothing says which faces are to be erased; list them in a file, say a place (--ball, --geodesic, --bump, ...), or \
             save a PLY with selected faces",
            path.display()
        ))),
    }
}

/// What was chosen before.
fn before(mesh: &MeshFile, path: &Path, args: &ListArgs) -> Result<Selected, Failure> {
    if let Some(path) = &args.free {
        let count = mesh.geometry.positions.len();
        let elements = indices(path, count, "vertices")?;
        let kind = Kind::Vertex;
        return Ok(Selected { kind, elements });
    }
    if let Some(path) = &args.faces {
        let elements = indices(path, mesh.geometry.polygon_count, "faces")?;
        let kind = Kind::Face;
        return Ok(Selected { kind, elements });
    }
    let found = match &args.selection {
        Some(property) => named(mesh, property),
        None => stored(mesh).map_err(str::to_owned),
    };
    found.map_err(|why| Failure::new(format!("{}: {why}", path.display())))
}

/// The selection of a property `NAME`, `vertex:NAME` or `face:NAME`.
fn named(mesh: &MeshFile, property: &str) -> Result<Selected, String> {
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
        Some(_) => Err(format!("nothing is selected in property '{property}'")),
        None => Err(no_property(mesh, kinds, property, bare)),
    }
}

/// That there is none of this name, and which one may have been meant.
fn no_property(mesh: &MeshFile, kinds: &[Kind], property: &str, bare: &str) -> String {
    let names = kinds.iter().flat_map(|&kind| mesh.property_names(kind));
    let meant = similar(bare, names).map_or(String::new(), |meant| format!("; did you mean '{meant}'?"));
    format!(
        "there is no property '{property}' with one number per vertex or face (only PLY files have them){meant}"
    )
}

/// The selection that MeshLab stores in `flags`.
fn stored(mesh: &MeshFile) -> Result<Selected, &'static str> {
    let found = [Kind::Face, Kind::Vertex].into_iter().find_map(|kind| {
        let elements = mesh.selected(kind, "flags")?;
        (!elements.is_empty()).then_some(Selected { kind, elements })
    });
    found.ok_or(
        "nothing says which vertices may move; say a place (--ball, --geodesic, --bump, ...), give --free FILE (vertex \
         numbers), --faces FILE (face numbers) or --selection NAME (a property of a PLY file), or save a PLY with selected faces",
    )
}

/// Reads a text file for parsing by lines.
fn read(path: &Path) -> Result<(String, Vec<u8>), Failure> {
    Ok((path.display().to_string(), packed::read(path)?))
}

/// Calls `each` with the words of every line that has any.
fn lines(
    bytes: &[u8],
    mut each: impl FnMut(&mut Words<'_>) -> Result<(), Malformed>,
) -> Result<(), Malformed> {
    let mut at = text::start(bytes);
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

/// `fitted`, `averaged`, or the normals of a file.
pub fn boundary_normals(which: &Path, vertex_count: usize) -> Result<BoundaryNormals, Failure> {
    match which.to_str() {
        Some("fitted") => Ok(BoundaryNormals::Fitted),
        Some("averaged") => Ok(BoundaryNormals::Averaged),
        _ => given_normals(which, vertex_count).map(BoundaryNormals::Given),
    }
}

/// Mean curvatures, `index H` per line.
pub fn given_curvature(path: &Path, vertex_count: usize) -> Result<Vec<(u32, f64)>, Failure> {
    let (name, bytes) = read(path)?;
    let mut given = Vec::new();
    lines(&bytes, |words| {
        let vertex = index(&bytes, words, vertex_count, "vertices")?;
        let at = words.offset();
        let wrong = |why| Malformed::text(at, format!("the mean curvature of vertex {vertex} is {why}"));
        let word = words.next().ok_or_else(|| wrong("missing"))?;
        let curvature = text::number(&bytes, word, "mean curvature")?;
        if !curvature.is_finite() {
            return Err(wrong("not finite"));
        }
        given.push((vertex, curvature));
        Ok(())
    })
    .map_err(|malformed| malformed.locate(&name, &bytes))?;
    Ok(given)
}

/// Normals, `index nx ny nz` per line, brought to length one.
fn given_normals(path: &Path, vertex_count: usize) -> Result<Vec<(u32, [f64; 3])>, Failure> {
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
