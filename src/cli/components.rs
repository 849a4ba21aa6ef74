//! Parts of a mesh taken away before it is filled: small components, and faces that are to be made anew.

use std::path::Path;

use fairmesh::{
    Carried, Coincident, Filled, LoopKind, TrimLimits, boundary_loops_joined, carry_over, erase_and_clean,
    triangle_components, trim_boundary,
};

use crate::explain;
use crate::failure::Failure;
use crate::formats::MeshFile;
use crate::formats::carry::{Carry, middles};
use crate::selected::Selected;

/// The mesh without the components of fewer than `least` triangles, and how many these are.
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
    let (rest, _) = mesh.only(&name.display().to_string(), &polygons(&mesh, &kept))?;
    Ok((rest, dropped))
}

/// A mesh that some faces were taken from.
pub struct Without {
    /// The mesh as it was.
    pub was: MeshFile,
    /// The loops that are left where they were.
    pub loops: Vec<usize>,
    /// How many triangles more were dropped.
    pub dropped: usize,
    /// How many because they were slender, or fins.
    pub cleaned: usize,
    /// The triangles that are gone, by their numbers before.
    gone: Vec<u32>,
    /// The vertices that are kept, by their numbers before.
    kept: Vec<u32>,
}

/// The mesh without some faces, and without what would hang loose then.
pub fn without_faces(
    name: &Path,
    mesh: MeshFile,
    erased: Selected,
    (coincident, clean): (Coincident, usize),
) -> Result<(MeshFile, Without), Failure> {
    let geometry = &mesh.geometry;
    let mut faces = erased.in_triangles(geometry).elements;
    let named = faces.len();
    let mut cleaned = 0;
    loop {
        let most = clean.saturating_sub(cleaned);
        let erased = erase_and_clean(&geometry.positions, &geometry.triangles, &faces, coincident, most)
            .map_err(|error| explain::refusal(name, &mesh, &error))?;
        cleaned += erased.cleaned;
        let mut kept = vec![false; geometry.triangles.len()];
        erased.kept.iter().for_each(|&t| kept[t as usize] = true);
        // Of a polygon all triangles go, or none.
        let whole = polygons(&mesh, &kept);
        if (0..kept.len()).all(|t| kept[t] == whole[geometry.polygon_of(t)]) {
            let (rest, kept_vertices) = mesh.only(&name.display().to_string(), &whole)?;
            let without = Without {
                loops: erased.loops,
                dropped: (0..kept.len()).filter(|&t| !kept[t]).count() - named - cleaned,
                cleaned,
                gone: (0..kept.len() as u32).filter(|&t| !kept[t as usize]).collect(),
                kept: kept_vertices,
                was: mesh,
            };
            return Ok((rest, without));
        }
        faces = (0..kept.len() as u32)
            .filter(|&t| !whole[geometry.polygon_of(t as usize)])
            .collect();
    }
}

/// The mesh without the triangles that spoil the boundaries of its holes, how many faces these are, and their area.
pub fn trimmed(
    name: &Path,
    mesh: MeshFile,
    limits: &TrimLimits,
    coincident: Coincident,
) -> Result<(MeshFile, usize, f64), Failure> {
    let geometry = &mesh.geometry;
    let (positions, triangles) = (&geometry.positions, &geometry.triangles);
    let refused = |error| explain::refusal(name, &mesh, &error);
    let loops = boundary_loops_joined(positions, triangles, coincident).map_err(refused)?;
    let holes: Vec<usize> = (0..loops.len())
        .filter(|&l| loops[l].kind == LoopKind::Hole)
        .collect();
    let trimmed = trim_boundary(positions, triangles, &holes, limits, coincident).map_err(refused)?;
    if trimmed.kept.len() == triangles.len() {
        return Ok((mesh, 0, 0.0));
    }
    let mut kept = vec![false; triangles.len()];
    trimmed.kept.iter().for_each(|&t| kept[t as usize] = true);
    let whole = polygons(&mesh, &kept);
    let count = whole.iter().filter(|&&whole| !whole).count();
    let (rest, _) = mesh.only(&name.display().to_string(), &whole)?;
    Ok((rest, count, trimmed.area))
}

/// The polygons of which all triangles are kept, and those without triangles.
fn polygons(mesh: &MeshFile, kept: &[bool]) -> Vec<bool> {
    let mut whole = vec![true; mesh.geometry.polygon_count];
    (0..kept.len()).for_each(|t| whole[mesh.geometry.polygon_of(t)] &= kept[t]);
    whole
}

/// Where new vertices and the middles of new triangles lie on what is gone.
type Places = [Vec<Option<Carried>>; 2];

impl Without {
    /// The places of what was added to a mesh of so many triangles.
    pub fn carried(&self, filled: &Filled, triangles: usize) -> Result<Places, fairmesh::Error> {
        let was = &self.was.geometry;
        let middles = middles(&filled.positions, &filled.triangles[triangles..]);
        let places = |points: &[[f64; 3]]| carry_over(&was.positions, &was.triangles, &self.gone, points);
        let old = filled.positions.len() - filled.parents.len();
        Ok([places(&filled.positions[old..])?, places(&middles)?])
    }

    /// What attributes are carried over from.
    pub fn carry<'a>(&'a self, [vertices, faces]: &'a Places, filled: &'a Filled) -> Carry<'a> {
        Carry {
            places: &filled.positions[filled.positions.len() - filled.parents.len()..],
            geometry: &self.was.geometry,
            vertices,
            faces,
            kept: &self.kept,
        }
    }
}
