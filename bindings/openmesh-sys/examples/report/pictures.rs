//! Pictures, drawn by the program `fairmesh`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use fairmesh::{Options, Selection, fair};
use openmesh_sys::openmesh::{Mesh, Smoothing};

use crate::Failure;
use crate::comparison::ITERATIONS;

/// Where the program is and where files go.
pub struct Pictures {
    binary: PathBuf,
    work: PathBuf,
    folder: PathBuf,
}

impl Pictures {
    /// Meshes go to `work`, pictures to `folder`.
    pub fn new(binary: PathBuf, work: PathBuf, folder: PathBuf) -> Result<Self, Failure> {
        fs::create_dir_all(&work)?;
        fs::create_dir_all(&folder)?;
        Ok(Self { binary, work, folder })
    }

    /// One picture of surfaces with the same triangles, side by side with their captions; returns its line for the document.
    pub fn draw(
        &self,
        name: &str,
        triangles: &[[u32; 3]],
        meshes: &[(String, Vec<[f64; 3]>)],
        around: Option<&Path>,
        view: &str,
    ) -> Result<String, Failure> {
        let mut command = Command::new(&self.binary);
        command.arg("render");
        for (k, (caption, positions)) in meshes.iter().enumerate() {
            let file = self.work.join(format!("{name}-{k}.off"));
            Mesh::<f64>::new(positions, triangles)?.write(&file)?;
            command.arg(file).args(["--caption", caption]);
        }
        if let Some(around) = around {
            command.arg("--around").arg(around);
        }
        let picture = self.folder.join(format!("{name}.png"));
        command
            .args([
                "--shade",
                "flat,reflection",
                "--size",
                "220x220",
                "--view",
                view,
                "-o",
            ])
            .arg(&picture);
        let output = command.output()?;
        if !output.status.success() {
            return Err(format!("{command:?}: {}", String::from_utf8_lossy(&output.stderr)).into());
        }
        Ok(format!("![{name}: OpenMesh and fairmesh](openmesh/{name}.png)\n"))
    }
}

/// A region of a scan, given to both; returns the picture's line and what was measured.
pub fn scan(
    pictures: &Pictures,
    number: usize,
    file: &Path,
    free_file: &Path,
    view: &str,
) -> Result<(String, String), Failure> {
    let mut mesh = Mesh::<f64>::read(file)?;
    let (scan, triangles) = (mesh.positions(), mesh.triangles());
    let mut free = vec![false; scan.len()];
    for line in fs::read_to_string(free_file)?.split_whitespace() {
        *free
            .get_mut(line.parse::<usize>()?)
            .ok_or("a free vertex that does not exist")? = true;
    }
    mesh.select(&free);
    let mut meshes = vec![("scan".to_owned(), scan.clone())];
    let (clock, mut done) = (Instant::now(), 0);
    for n in ITERATIONS {
        mesh.smooth(Smoothing::c1(n - done))?;
        done = n;
        meshes.push((format!("OpenMesh, {n}"), mesh.positions()));
    }
    let theirs = clock.elapsed().as_secs_f64();
    let clock = Instant::now();
    let options = Options {
        threads: 1,
        ..Options::default()
    };
    let solution = fair(&scan, &triangles, Selection::Mask(&free), &options)?;
    let figures = format!(
        "{} free vertices, {:.1} s for {done} iterations and {:.2} s ({}, {} iterations)",
        free.iter().filter(|f| **f).count(),
        theirs,
        clock.elapsed().as_secs_f64(),
        solution.report.outcome.name(),
        solution.report.iterations
    );
    meshes.push(("fairmesh".to_owned(), solution.positions));
    let line = pictures.draw(
        &format!("scan{number}"),
        &triangles,
        &meshes,
        Some(free_file),
        view,
    )?;
    Ok((line, figures))
}
