//! A mesh file: read once, written back with nothing changed but what had to.

use std::path::Path;

use fairmesh::OutputPrecision;

use super::added::Added;
use super::change::Change;
use super::format::Format;
use super::geometry::{Geometry, Kind};
use super::patches::Patches;
use super::{obj, off, packed, ply, stl};
use crate::failure::Failure;
use crate::normals;

/// Where the numbers are in the file's bytes.
pub(super) enum Places {
    Ply(ply::Ply),
    Obj(obj::Obj),
    Off(off::Off),
    Stl(stl::Stl),
}

/// A mesh file: its bytes and what they mean.
pub struct MeshFile {
    pub(super) bytes: Vec<u8>,
    pub(super) places: Places,
    /// What the solver needs.
    pub geometry: Geometry,
}

/// The bytes of a changed file.
pub struct Written {
    /// The whole file.
    pub bytes: Vec<u8>,
    /// Vertices whose normals in the file are now out of date, because they could not be matched.
    pub stale_normals: usize,
}

impl MeshFile {
    /// Understands the bytes of a file of this format. `name` is for messages.
    ///
    /// # Errors
    /// Bytes that are no mesh of this format; a mesh without a face.
    pub fn parse(name: &str, format: Format, mut bytes: Vec<u8>) -> Result<Self, Failure> {
        if let Some(why) = packed::packing(&bytes) {
            return Err(Failure::new(format!("{name}: {why}")));
        }
        if format == Format::Ply {
            let faces =
                ply::strips::faces_for_strips(&bytes).map_err(|malformed| malformed.locate(name, &bytes))?;
            bytes = faces.unwrap_or(bytes);
        }
        let parsed = match format {
            Format::Ply => ply::parse(&bytes).map(|(geometry, places)| (geometry, Places::Ply(places))),
            Format::Obj => obj::parse(&bytes).map(|(geometry, places)| (geometry, Places::Obj(places))),
            Format::Off => off::parse(&bytes).map(|(geometry, places)| (geometry, Places::Off(places))),
            Format::Stl => stl::parse(&bytes).map(|(geometry, places)| (geometry, Places::Stl(places))),
        };
        let (geometry, places) = parsed.map_err(|malformed| malformed.locate(name, &bytes))?;
        if geometry.triangles.is_empty() {
            let format = format.name();
            let why = match geometry.positions.len() {
                0 => format!("nothing in this file is a vertex or a face of {format}"),
                n => format!(
                    "no face of three corners or more was found, only vertices ({n}); a mesh is needed"
                ),
            };
            return Err(Failure::new(format!("{name}: {why}")));
        }
        Ok(Self {
            bytes,
            places,
            geometry,
        })
    }

    /// Reads and understands a file; `piped` is the format of one that has no name.
    pub fn read(path: &Path, piped: Option<Format>) -> Result<Self, Failure> {
        let format = Format::of(path, piped)?;
        let bytes = packed::read_mesh(path)?;
        Self::parse(&path.display().to_string(), format, bytes)
    }

    /// Refuses an output of this format if new positions cannot be written into it.
    ///
    /// # Errors
    /// A PLY file whose coordinates are integers, as another PLY file.
    pub fn check_writable(&self, name: &Path, format: Format) -> Result<(), Failure> {
        match &self.places {
            Places::Ply(places) if format == Format::Ply && places.is_whole() => Err(Failure::new(format!(
                "{}: its coordinates are whole numbers by their type, which the result does not fit; name an output of \
                 another format",
                name.display()
            ))),
            _ => Ok(()),
        }
    }

    /// The number that the first added face has in an output of this format, in which it stands behind the file's own.
    pub fn first_added_face(&self, format: Format) -> usize {
        match (&self.places, format) {
            (Places::Ply(_), Format::Ply) | (Places::Obj(_), Format::Obj) => self.geometry.polygon_count,
            (_, Format::Stl) => self.geometry.triangles.len(),
            _ => self.geometry.polygons().len(),
        }
    }

    /// The file's format.
    pub fn format(&self) -> Format {
        match self.places {
            Places::Ply(_) => Format::Ply,
            Places::Obj(_) => Format::Obj,
            Places::Off(_) => Format::Off,
            Places::Stl(_) => Format::Stl,
        }
    }

    /// The precision of the file's own coordinates.
    pub fn output_precision(&self) -> OutputPrecision {
        let is_single = match &self.places {
            Places::Ply(places) => places.has_single_positions(),
            Places::Stl(stl::Stl::Binary) => true,
            Places::Stl(stl::Stl::Ascii(_)) | Places::Obj(_) | Places::Off(_) => false,
        };
        if is_single {
            OutputPrecision::Single
        } else {
            OutputPrecision::Double
        }
    }

    /// The elements for which the property `name` is nonzero (`flags`: has the selection bit); None if the
    /// file has no such property.
    pub fn selected(&self, kind: Kind, name: &str) -> Option<Vec<u32>> {
        match &self.places {
            Places::Ply(places) => places.selected(&self.bytes, kind, name),
            _ => None,
        }
    }

    /// The names that [`MeshFile::selected`] knows.
    pub fn property_names(&self, kind: Kind) -> Vec<&str> {
        match &self.places {
            Places::Ply(places) => places.names(kind).collect(),
            _ => Vec::new(),
        }
    }

    /// The mesh with what was added, in this format. PLY and OBJ of the same format: the file as it is, with rows added;
    /// otherwise the vertices and faces and nothing else. `was` is the mesh that attributes are carried over from.
    pub fn with_added(&self, format: Format, added: &Added<'_>, was: Option<&MeshFile>) -> Vec<u8> {
        let new = &added.triangles[self.geometry.triangles.len()..];
        match &self.places {
            Places::Ply(places) if format == Format::Ply => {
                let mut patches = Patches::default();
                places.grow(
                    &self.bytes,
                    added,
                    was.and_then(MeshFile::as_ply),
                    new,
                    &mut patches,
                );
                patches.apply(&self.bytes)
            }
            Places::Obj(_) if format == Format::Obj => {
                obj::grown(&self.bytes, added, was.and_then(MeshFile::as_obj), new)
            }
            _ => {
                let mut polygons = self.geometry.polygons();
                polygons.extend(new.iter().map(|t| t.to_vec()));
                plain(format, added.positions, &polygons)
            }
        }
    }

    /// Where things are in a PLY file, and its bytes.
    pub(super) fn as_ply(&self) -> Option<(&ply::Ply, &[u8])> {
        match &self.places {
            Places::Ply(places) => Some((places, &self.bytes)),
            _ => None,
        }
    }

    /// The bytes of an OBJ file.
    pub(super) fn as_obj(&self) -> Option<&[u8]> {
        match &self.places {
            Places::Obj(_) => Some(&self.bytes),
            _ => None,
        }
    }

    /// The mesh with some of its polygons, by the file's numbers, and without the vertices that none of these uses and others did; and the
    /// numbers of the vertices that are kept. In PLY and OBJ all else stays as it is; unless it may name vertices besides: then all of them stay.
    ///
    /// # Errors
    /// If no polygon is left.
    pub fn only(&self, name: &str, is_kept: &[bool]) -> Result<(Self, Vec<u32>), Failure> {
        let geometry = &self.geometry;
        let (mut was_used, mut is_used) = (vec![false; geometry.positions.len()], Vec::new());
        is_used.clone_from(&was_used);
        for (t, corners) in geometry.triangles.iter().enumerate() {
            for &v in corners {
                was_used[v as usize] = true;
                is_used[v as usize] |= is_kept[geometry.polygon_of(t)];
            }
        }
        if !is_used.contains(&true) {
            return Err(Failure::new(format!("{name}: nothing would be left of the mesh")));
        }
        // Polygons without triangles may name any vertex.
        let has_others = geometry.polygons().len() < geometry.polygon_count;
        let keeps_all = has_others
            || match &self.places {
                Places::Ply(places) => places.has_other_rows(),
                Places::Obj(_) => obj::has_other_lines(&self.bytes),
                Places::Off(_) | Places::Stl(_) => false,
            };
        let stays = |v: usize| keeps_all || is_used[v] || !was_used[v];
        let vertices: Vec<bool> = (0..is_used.len()).map(stays).collect();
        let kept: Vec<u32> = (0..)
            .zip(&vertices)
            .filter(|(_, stays)| **stays)
            .map(|(v, _)| v)
            .collect();
        let (format, bytes) = match &self.places {
            Places::Ply(places) => {
                let mut patches = Patches::default();
                places.only(&self.bytes, &vertices, is_kept, &mut patches);
                (Format::Ply, patches.apply(&self.bytes))
            }
            Places::Obj(_) => (Format::Obj, obj::only(&self.bytes, &vertices, is_kept)),
            Places::Off(_) | Places::Stl(_) => (Format::Off, self.plain_of(&kept, is_kept)),
        };
        Ok((Self::parse(name, format, bytes)?, kept))
    }

    /// These vertices and polygons as an OFF file.
    fn plain_of(&self, kept: &[u32], is_kept: &[bool]) -> Vec<u8> {
        let geometry = &self.geometry;
        let mut number = vec![0; geometry.positions.len()];
        for (new, &v) in (0..).zip(kept) {
            number[v as usize] = new;
        }
        let mut polygons = Vec::new();
        for (corners, t) in geometry.polygons().into_iter().zip(geometry.first_triangles()) {
            if is_kept[geometry.polygon_of(t)] {
                let corners: Vec<u32> = corners.iter().map(|&v| number[v as usize]).collect();
                polygons.push(corners);
            }
        }
        let positions: Vec<[f64; 3]> = kept.iter().map(|&v| geometry.positions[v as usize]).collect();
        plain(Format::Off, &positions, &polygons)
    }

    /// The file with these positions. Only what belongs to the vertices that differ is changed.
    pub fn with_positions(&self, positions: &[[f64; 3]]) -> Written {
        let old = &self.geometry.positions;
        let same = |a: &[f64; 3], b: &[f64; 3]| (0..3).all(|axis| a[axis].to_bits() == b[axis].to_bits());
        let moved: Vec<bool> = old.iter().zip(positions).map(|(a, b)| !same(a, b)).collect();
        let normals = normals::around(positions, &self.geometry.triangles, &moved);
        let change = Change {
            positions,
            moved: &moved,
            normals: &normals,
        };
        let mut patches = Patches::default();
        let stale_normals = match &self.places {
            Places::Ply(places) => places.patch(&self.bytes, &change, &mut patches),
            Places::Obj(places) => places.patch(&self.bytes, &change, &mut patches),
            Places::Off(places) => places.patch(&self.bytes, &change, &mut patches),
            Places::Stl(places) => places.patch(&self.bytes, &self.geometry.triangles, &change, &mut patches),
        };
        Written {
            bytes: patches.apply(&self.bytes),
            stale_normals,
        }
    }
}

/// A new file of this format that holds these positions and polygons and nothing else.
pub fn plain(format: Format, positions: &[[f64; 3]], polygons: &[impl AsRef<[u32]>]) -> Vec<u8> {
    match format {
        Format::Ply => ply::plain(positions, polygons),
        Format::Obj => obj::plain(positions, polygons),
        Format::Off => off::plain(positions, polygons),
        Format::Stl => stl::plain(positions, polygons),
    }
}
