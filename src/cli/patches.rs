//! What `fill` and `bridge` have in common: the flags of patches, the files that they lead from and to, and the numbers of new faces.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use fairmesh::{Cap, FillOptions, Options, OutputPrecision, Report};
use serde_json::{Value, json};

use crate::answer::Answer;
use crate::attempts;
use crate::batch::Telling;
use crate::continuity;
use crate::failure::Failure;
use crate::formats::pipe_args::Piped;
use crate::formats::{Format, Mark, MeshFile};
use crate::orientation::oriented;
use crate::output::Output;
use crate::report::{creased, member_weight};
use crate::sharp_edges::{self, SharpArgs};
use crate::surface::{IntersectionArgs, MeshArgs};

/// What closes a boundary that lies in a plane.
#[derive(Debug, Clone, Copy, Default, ValueEnum)]
enum CapKind {
    /// A fair patch, which continues what is around it
    #[default]
    Fair,
    /// The plane, with a sharp edge; boundaries in no plane get a fair patch
    Flat,
}

/// How new faces are marked in the output.
#[derive(Debug, Args)]
pub struct MarkArgs {
    /// Mark new faces in the output: in PLY by a property of faces of this name, 1 for new
    /// ones ('flags': as selected in MeshLab), in OBJ by a group. Other formats have none
    #[arg(long, value_name = "NAME", value_parser = mark_name, verbatim_doc_comment)]
    pub mark: Option<String>,
}

/// A name that is one word of a text.
fn mark_name(name: &str) -> Result<String, String> {
    let is_in_word = |c: char| c.is_ascii_graphic() && c != '#';
    match !name.is_empty() && name.chars().all(is_in_word) {
        true => Ok(name.to_owned()),
        false => Err("a name is one word of ASCII without '#'".to_owned()),
    }
}

/// How patches are made and told.
#[derive(Debug, Args)]
pub struct PatchArgs {
    /// Density of new vertices: at 1.414 edges are as long as those beside
    /// the boundary, at twice that half as long
    #[arg(long, value_name = "X", verbatim_doc_comment)]
    density: Option<f64>,
    /// Most new vertices; beyond that, patches are coarser inside
    /// [default: 200000]
    #[arg(long, value_name = "N", verbatim_doc_comment)]
    max_new_vertices: Option<usize>,
    /// Triangulate and refine only, without fairing
    #[arg(long)]
    no_fair: bool,
    #[command(flatten)]
    sharp: SharpArgs,
    /// What closes a boundary that lies in a plane, as where a part was cut off
    #[arg(long, value_name = "WHAT", value_enum, default_value_t)]
    cap: CapKind,
    /// Stop when the vertices move less than this part of the patch's
    /// diagonal, between 0 and 1 [default: 1e-8]
    #[arg(long, value_name = "X", verbatim_doc_comment)]
    tolerance: Option<f64>,
    /// Stop after this many iterations of a patch, at least 1; a hole by itself
    /// never takes more than 64 [default: 500]
    #[arg(long, value_name = "N", verbatim_doc_comment)]
    max_iterations: Option<usize>,
    /// Worker threads; 0: one per processor.
    /// The result does not depend on it
    #[arg(long, value_name = "N", default_value_t = 0, verbatim_doc_comment)]
    threads: usize,
    #[command(flatten)]
    pub mark: MarkArgs,
    #[command(flatten)]
    pub mesh: MeshArgs,
    #[command(flatten)]
    intersections: IntersectionArgs,
    /// Also write the report as JSON; '-': to stdout, instead of the text
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// No progress bar, no report; errors are still printed
    #[arg(short, long)]
    pub quiet: bool,
}

impl PatchArgs {
    /// Where the report goes.
    pub fn telling(&self, is_verbose: bool) -> Telling<'_> {
        Telling {
            json: self.json.as_deref(),
            is_quiet: self.quiet,
            is_verbose,
        }
    }

    /// The files of a run.
    pub fn open(&self, input: &Path, output: &Path, piped: Piped) -> Result<Files, Failure> {
        Files::open(input, output, piped, &self.mesh, &self.mark)
    }

    /// The same of a command that takes one mesh.
    pub fn answer(&self, output: &Path, input: &Path) -> Result<Answer, Failure> {
        Answer::prepare(self.json.as_deref(), self.quiet, Some(output), &[input])
    }

    /// The library's options, where no other flag says more.
    pub fn options(&self, output_precision: OutputPrecision) -> FillOptions {
        let defaults = FillOptions::default();
        FillOptions {
            density: self.density.unwrap_or(defaults.density),
            max_new_vertices: self.max_new_vertices.unwrap_or(defaults.max_new_vertices),
            fair: !self.no_fair,
            cap: match self.cap {
                CapKind::Fair => Cap::Fair,
                CapKind::Flat => Cap::Flat,
            },
            fairing: Options {
                tolerance: self.tolerance.unwrap_or(defaults.fairing.tolerance),
                max_iterations: self.max_iterations.unwrap_or(defaults.fairing.max_iterations),
                output_precision,
                threads: self.threads,
                intersections: self.intersections.intersections(),
                coincident: self.mesh.coincident,
                sharp: self.sharp.sharp,
                marked_edges: self.sharp.marked_edges(),
                ..Options::default()
            },
            ..defaults
        }
    }
}

/// The files, read and prepared.
pub struct Files {
    pub format: Format,
    pub mesh: MeshFile,
    /// How many faces were turned around.
    pub turned: usize,
    pub precision: OutputPrecision,
    pub output: Output,
}

impl Files {
    pub fn open(
        input: &Path,
        output: &Path,
        piped: Piped,
        args: &MeshArgs,
        mark: &MarkArgs,
    ) -> Result<Self, Failure> {
        let format = Format::of(output, piped.output)?;
        let (mut mesh, turned) = oriented(input, MeshFile::read(input, piped.input)?, args)?;
        let precision = match (mesh.format(), format) {
            (Format::Ply, Format::Ply) => mesh.output_precision(),
            _ => format.output_precision(),
        };
        mesh.check_writable(input, format)?;
        if let Some(name) = &mark.mark {
            mesh = mesh.markable(&input.display().to_string(), format, name)?;
        }
        Ok(Self {
            format,
            mesh,
            turned,
            precision,
            output: Output::prepare_or_stdout(output)?,
        })
    }
}

impl MarkArgs {
    /// How faces are marked of which the first ones are not new.
    pub fn from(&self, first: usize) -> Option<Mark<'_>> {
        self.mark.as_deref().map(|name| Mark { name, first })
    }
}

/// The number in a written file of the first face that was added to a mesh, and of a triangle's face.
pub fn face_numbers(mesh: &MeshFile, format: Format) -> (usize, impl Fn(u32) -> usize + Copy) {
    let first = mesh.first_added_face(format);
    let geometry = &mesh.geometry;
    let face = move |t: u32| match (t as usize).checked_sub(geometry.triangles.len()) {
        Some(added) => first + added,
        None => geometry.polygon_of(t as usize),
    };
    (first, face)
}

/// A patch's report of its fairing, for programs.
pub fn fairing(f: &Report) -> Value {
    json!({ "outcome": f.outcome.name(), "creased_vertices": creased(f), "iterations": f.iterations, "step": f.step, "defect": f.defect,
            "h_inside": f.quality.h_inside, "h_boundary": f.quality.h_boundary,
            "normal_deviation": f.quality.normal_deviation, "suspicious_normals": f.suspicious_normals,
            "member_weight": member_weight(&f.outcome), "bending_energy": f.quality.bending_energy,
            "attempts": attempts::json(f.components.iter().flat_map(|c| &c.attempts)),
            "continuity": continuity::json(f.components.iter().flat_map(|c| &c.continuity)),
            "sharp_edges": sharp_edges::json(&f.sharp_edges) })
}
