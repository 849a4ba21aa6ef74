//! Parts of a mesh taken away before it is filled: small components, and faces that are to be made anew.

use std::path::Path;

use fairmesh::{Coincident, erase, triangle_components};

use crate::explain;
use crate::failure::Failure;
use crate::formats::{self, Format, Kind, MeshFile};
use crate::selection::{Selected, indices};

/// The mesh without the components of fewer than `least` triangles, and how many these are. If there are any, nothing is left of
/// the file but vertices and faces.
pub fn without_small(
    name: &Path,
    mesh: MeshFile,
    least: usize,
    coincident: Coincident,
) -> Result<(MeshFile, usize), Failure> {
    let geometry = &mesh.geometry;
    let components = triangle_components(&geometry.positions, &geometry.triangles, coincident)
        .map_err(|error| explain::refusal(name, &mesh, &error))?;
    let mut sizes = vec![0; components.iter().max().map_or(0, |&last| last as usize + 1)];
    components.iter().for_each(|&c| sizes[c as usize] += 1);
    let dropped = sizes.iter().filter(|&&size| size < least).count();
    if dropped == 0 {
        return Ok((mesh, 0));
    }
    let kept: Vec<bool> = components.iter().map(|&c| sizes[c as usize] >= least).collect();
    Ok((only(name, &mesh, &kept)?, dropped))
}

/// The mesh without the faces that a file lists, and without what would hang loose then; the loops where they were, and how many
/// faces more were dropped.
pub fn without_faces(
    name: &Path,
    mesh: &MeshFile,
    list: &Path,
    coincident: Coincident,
) -> Result<(MeshFile, Vec<usize>, usize), Failure> {
    let geometry = &mesh.geometry;
    let listed = Selected {
        kind: Kind::Face,
        elements: indices(list, geometry.polygon_count, "faces")?,
    };
    let mut faces = listed.in_triangles(geometry).elements;
    let named = faces.len();
    loop {
        let erased = erase(&geometry.positions, &geometry.triangles, &faces, coincident)
            .map_err(|error| explain::refusal(name, mesh, &error))?;
        let mut kept = vec![false; geometry.triangles.len()];
        erased.kept.iter().for_each(|&t| kept[t as usize] = true);
        // Of a polygon all triangles go, or none.
        let mut whole = vec![true; geometry.polygon_count];
        (0..kept.len()).for_each(|t| whole[geometry.polygon_of(t)] &= kept[t]);
        if (0..kept.len()).all(|t| kept[t] == whole[geometry.polygon_of(t)]) {
            return Ok((
                only(name, mesh, &kept)?,
                erased.loops,
                faces.len() + erased.dropped - named,
            ));
        }
        faces = (0..kept.len() as u32)
            .filter(|&t| !whole[geometry.polygon_of(t as usize)])
            .collect();
    }
}

/// A mesh of the polygons of these triangles, and the vertices that they use.
fn only(name: &Path, mesh: &MeshFile, kept: &[bool]) -> Result<MeshFile, Failure> {
    let geometry = &mesh.geometry;
    let mut polygons = geometry.polygons();
    let mut is_kept: Vec<bool> = Vec::with_capacity(polygons.len());
    let mut last = None;
    for (t, &kept) in kept.iter().enumerate() {
        if last.replace(geometry.polygon_of(t)) != Some(geometry.polygon_of(t)) {
            is_kept.push(kept);
        }
    }
    let mut keep = is_kept.iter();
    polygons.retain(|_| *keep.next().unwrap_or(&false));
    if polygons.is_empty() {
        return Err(Failure::new(format!(
            "{}: nothing would be left of the mesh",
            name.display()
        )));
    }
    let mut is_used = vec![false; geometry.positions.len()];
    polygons
        .iter()
        .flatten()
        .for_each(|&v| is_used[v as usize] = true);
    let (mut number, mut positions) = (vec![0; is_used.len()], Vec::new());
    for v in (0..is_used.len()).filter(|&v| is_used[v]) {
        number[v] = positions.len() as u32;
        positions.push(geometry.positions[v]);
    }
    polygons
        .iter_mut()
        .flatten()
        .for_each(|v| *v = number[*v as usize]);
    let bytes = formats::plain(Format::Off, &positions, &polygons);
    MeshFile::parse(&name.display().to_string(), Format::Off, bytes)
}
