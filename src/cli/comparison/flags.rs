//! The flags of pictures and reports, and where these go: a file, or one for each mesh in a directory.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;

use super::changes::Comparison;
use super::page::{Story, page};
use super::surface::{MeshSide, V3};
use crate::answer::{same_file, untold};
use crate::explain;
use crate::failure::Failure;
use crate::formats::packed;
use crate::formats::pipes::is_piped;
use crate::jobs::is_directory;
use crate::output::Output;
use crate::picture::PictureOptions;
use crate::render;

/// Flags of commands that change a mesh.
#[derive(Debug, Args)]
pub struct PictureArgs {
    /// Picture (.png) of before and after: the changed part, flat shaded and with
    /// reflection lines, how far it moved, and where it is. For several meshes,
    /// give a directory, or a name ending in / (which is created)
    #[arg(
        long,
        value_name = "FILE",
        help_heading = "Pictures and reports",
        verbatim_doc_comment
    )]
    picture: Option<PathBuf>,
    /// Page (.html) about the run: outcome, advice, pictures of before and after, how
    /// far the surface moved, how its curvature is distributed; one self-contained
    /// file. For several meshes as --picture
    #[arg(
        long,
        value_name = "FILE",
        help_heading = "Pictures and reports",
        verbatim_doc_comment
    )]
    report: Option<PathBuf>,
    /// View of the pictures, as in 'fairmesh render' [default: from above what
    /// has changed]
    #[arg(
        long,
        value_name = "VIEW",
        allow_hyphen_values = true,
        help_heading = "Pictures and reports",
        verbatim_doc_comment
    )]
    view: Option<String>,
    /// Up direction of the pictures: x,y,z [default: 0,0,1]
    #[arg(
        long,
        value_name = "X,Y,Z",
        allow_hyphen_values = true,
        help_heading = "Pictures and reports"
    )]
    up: Option<String>,
}

impl PictureArgs {
    /// Finds out what is wrong with the flags for these meshes, and makes the directories, before any work is done.
    pub fn check(&self, inputs: &[PathBuf]) -> Result<(), Failure> {
        let flag = self.view.as_ref().map(|_| "--view");
        let flag = flag.or(self.up.as_ref().map(|_| "--up"));
        if let (None, Some(flag)) = (self.asked().next(), flag) {
            return Err(Failure::new(format!(
                "{flag}: no picture is made; give --picture or --report, too"
            )));
        }
        self.direction()?;
        self.up()?;
        for (flag, path, ending) in self.asked() {
            let mut places: BTreeMap<PathBuf, &Path> = BTreeMap::new();
            if inputs.len() > 1 && !is_directory(path) {
                return Err(Failure::new(format!(
                    "{flag} {}: several meshes need a directory; make it before, or end its name in /",
                    path.display()
                )));
            }
            for input in inputs {
                let place = place(flag, path, ending, input)?;
                if let Some(other) = places.insert(place.clone(), input) {
                    return Err(Failure::new(format!(
                        "{flag}: {} and {} would both be shown in {}; do them one by one",
                        other.display(),
                        input.display(),
                        place.display()
                    )));
                }
            }
            if is_directory(path) {
                fs::create_dir_all(path).map_err(|why| {
                    Failure::new(format!("{}: cannot make this directory: {why}", path.display()))
                })?;
            }
        }
        Ok(())
    }

    /// What is to be made of a mesh; None if nothing is.
    pub fn prepare(&self, input: &Path, output: &Path) -> Result<Option<Pictures>, Failure> {
        let (mut picture, mut report) = (None, None);
        for (flag, path, ending) in self.asked() {
            let path = place(flag, path, ending, input)?;
            if [input, output].iter().any(|mesh| same_file(&path, mesh)) {
                return Err(Failure::new(format!(
                    "{}: {flag} would overwrite the mesh; name another file",
                    path.display()
                )));
            }
            let output = Some(Output::prepare(&path)?);
            match flag {
                "--report" => report = output,
                _ => picture = output,
            }
        }
        if picture.is_none() && report.is_none() {
            return Ok(None);
        }
        Ok(Some(Pictures {
            input: input.to_path_buf(),
            output: output.to_path_buf(),
            picture,
            report,
            direction: self.direction()?,
            up: self.up()?,
        }))
    }

    /// The flags that are given, with the endings of their files.
    fn asked(&self) -> impl Iterator<Item = (&'static str, &Path, &'static str)> {
        [
            ("--picture", &self.picture, "png"),
            ("--report", &self.report, "html"),
        ]
        .into_iter()
        .filter_map(|(flag, path, ending)| Some((flag, path.as_deref()?, ending)))
    }

    fn direction(&self) -> Result<Option<V3>, Failure> {
        self.view.as_deref().map(render::direction).transpose()
    }

    fn up(&self) -> Result<V3, Failure> {
        let up = self.up.as_deref().map(render::upwards).transpose()?;
        Ok(up.unwrap_or(PictureOptions::default().up))
    }
}

/// The file for a mesh: as named, or by the mesh's name in a directory.
fn place(flag: &str, path: &Path, ending: &str, input: &Path) -> Result<PathBuf, Failure> {
    if is_piped(path) {
        return Err(Failure::new(format!(
            "{flag} -: name a file; stdout is for the mesh or the report"
        )));
    }
    if !is_directory(path) {
        let is_right = path.extension().is_some_and(|e| e.eq_ignore_ascii_case(ending));
        return match is_right {
            true => Ok(path.to_path_buf()),
            false => Err(Failure::new(format!(
                "{flag} {}: only .{ending} is written; let the name end so",
                path.display()
            ))),
        };
    }
    if is_piped(input) {
        return Err(Failure::new(format!(
            "{flag} {}: what comes from stdin has no name that it could have in a directory; name a file",
            path.display()
        )));
    }
    let stem = packed::inner_name(input);
    let stem = stem.file_stem().map(OsStr::to_os_string).unwrap_or_default();
    let mut name = stem;
    name.push(".");
    name.push(ending);
    Ok(path.join(name))
}

/// The files about one mesh, prepared.
pub struct Pictures {
    input: PathBuf,
    output: PathBuf,
    picture: Option<Output>,
    report: Option<Output>,
    direction: Option<V3>,
    up: V3,
}

impl Pictures {
    /// Makes and writes them; the seconds that it took. The result stands already: what fails here is the report about it.
    pub fn write(&self, before: MeshSide<'_>, after: MeshSide<'_>, story: &Story) -> Result<f64, Failure> {
        let start = Instant::now();
        let made = self.make(before, after, story);
        made.map_err(|failure| untold(failure, &[&self.output]))?;
        Ok(start.elapsed().as_secs_f64())
    }

    fn make(&self, before: MeshSide<'_>, after: MeshSide<'_>, story: &Story) -> Result<(), Failure> {
        let refused = |error| explain::plain_refusal(self.input.display(), &error);
        let comparison = Comparison::new(before, after).map_err(refused)?;
        let sheet = comparison.sheet(self.direction, self.up, self.report.is_some());
        if let Some(picture) = &self.picture {
            let name = self.input.file_name();
            let name = name.map_or("-".into(), |name| name.to_string_lossy());
            let head = [format!("{name}: {}", story.outcome), comparison.told()];
            picture.write(&sheet.png(&head)?)?;
        }
        if let Some(report) = &self.report {
            let page = page(story, [&self.input, &self.output], &comparison, &sheet)?;
            report.write(page.as_bytes())?;
        }
        Ok(())
    }
}
