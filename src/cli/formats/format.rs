//! The file formats, and which of them a file has.

use std::path::Path;

use clap::ValueEnum;
use fairmesh::OutputPrecision;

use super::packed;
use super::pipes::is_piped;
use crate::failure::Failure;

/// The file formats, told by the extension.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    Ply,
    Obj,
    Off,
    Stl,
}

impl Format {
    /// The format that a path's extension names, before `.gz`; of what is piped, the one that was said.
    pub fn of(path: &Path, piped: Option<Format>) -> Result<Self, Failure> {
        if is_piped(path) {
            return piped.ok_or_else(|| {
                Failure::new(
                    "-: no name tells the format of what is piped; give --format ply, obj, off or stl",
                )
            });
        }
        let inner = packed::inner_name(path);
        let extension = inner
            .extension()
            .map(|e| e.to_string_lossy().to_ascii_lowercase());
        match extension.as_deref() {
            Some("ply") => Ok(Format::Ply),
            Some("obj") => Ok(Format::Obj),
            Some("off" | "coff" | "noff") => Ok(Format::Off),
            Some("stl") => Ok(Format::Stl),
            other => Err(Failure::new(format!(
                "{}: {}",
                path.display(),
                why_unknown(path, other)
            ))),
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Format::Ply => "PLY",
            Format::Obj => "OBJ",
            Format::Off => "OFF",
            Format::Stl => "STL",
        }
    }

    /// The precision of coordinates in a new file of this format.
    pub fn output_precision(self) -> OutputPrecision {
        match self {
            Format::Stl => OutputPrecision::Single,
            Format::Ply | Format::Obj | Format::Off => OutputPrecision::Double,
        }
    }
}

/// What to do with a file of another format.
fn why_unknown(path: &Path, extension: Option<&str>) -> String {
    match extension {
        Some("bz2" | "xz" | "zst" | "zip") => {
            "of compressed files only those ending in .gz are read and written; unpack it first".to_owned()
        }
        _ if packed::is_named_so(path) => {
            "unknown file format; use a name ending in .ply.gz, .obj.gz, .off.gz or .stl.gz".to_owned()
        }
        Some("glb" | "gltf" | "3mf" | "dae") => read_by(path, "trimesh", "load", ", force='mesh').export("),
        Some("vtk" | "vtp" | "vtu" | "vti" | "vts") => {
            read_by(path, "pyvista", "read", ").extract_surface().triangulate().save(")
        }
        _ => "unknown file format; use a name ending in .ply, .obj, .off or .stl".to_owned(),
    }
}

/// The two lines of Python that make a PLY file of it.
fn read_by(path: &Path, package: &str, reads: &str, writes: &str) -> String {
    let (from, to) = (path.display(), path.with_extension("ply"));
    format!(
        "this format is neither read nor written, but Python's {package} reads it: import {package}; \
         {package}.{reads}('{from}'{writes}'{}')",
        to.display()
    )
}
