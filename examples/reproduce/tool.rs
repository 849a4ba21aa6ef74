//! Runs the program `fairmesh`, and reads back what it wrote.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// Where the program is and where files go.
pub struct Tool {
    binary: PathBuf,
    /// Working files.
    pub work: PathBuf,
    /// Pictures.
    pub pictures: PathBuf,
    help: String,
}

/// A generated mesh with what belongs to it.
pub struct Case {
    /// Also the stem of its files.
    pub name: String,
    /// The mesh file.
    pub file: PathBuf,
    /// The file of its free vertices.
    pub free_file: PathBuf,
    /// The file of its boundary normals, if they are given.
    pub normals_file: Option<PathBuf>,
    /// Positions in the file.
    pub positions: Vec<[f64; 3]>,
    /// Triangles in the file.
    pub triangles: Vec<[u32; 3]>,
    /// The free vertices.
    pub free: Vec<u32>,
}

/// What came of `fairmesh fair`.
pub struct Run {
    /// The mesh file.
    pub file: PathBuf,
    /// Its positions; none of a scan.
    pub positions: Vec<[f64; 3]>,
    report: Value,
}

impl Run {
    /// `converged` or why not.
    pub fn outcome(&self) -> String {
        self.report["outcome"].as_str().unwrap_or("?").to_owned()
    }

    /// A number of the report, by its path of keys.
    pub fn number(&self, path: &[&str]) -> f64 {
        let found = path.iter().fold(&self.report, |value, key| &value[*key]);
        found.as_f64().unwrap_or(f64::NAN)
    }

    /// Seconds from the arrays of the input to those of the result.
    pub fn seconds(&self) -> f64 {
        self.number(&["seconds", "solve"])
    }

    /// Iterations.
    pub fn iterations(&self) -> usize {
        self.number(&["iterations"]) as usize
    }

    /// The smallest and the largest mean curvature, `inside` or on the `boundary`.
    pub fn curvature(&self, place: &str) -> [f64; 2] {
        let pair = &self.report["quality"][place];
        [0, 1].map(|k| pair[k].as_f64().unwrap_or(f64::NAN))
    }

    /// A number of each boundary loop along which curvature is continued.
    pub fn of_loops(&self, name: &str) -> Vec<f64> {
        let components = self.report["components"].as_array().into_iter().flatten();
        let loops = components.flat_map(|c| c["continuity"].as_array().into_iter().flatten());
        loops.map(|l| l[name].as_f64().unwrap_or(f64::NAN)).collect()
    }

    /// Vertices of the levels of the paper's hierarchy, from the base on, where the report has them.
    pub fn levels(&self) -> Vec<usize> {
        let levels = self.report["levels"].as_array().into_iter().flatten();
        levels
            .filter_map(|level| level["vertices"].as_u64().map(|n| n as usize))
            .collect()
    }
}

impl Tool {
    /// The program at this path.
    pub fn new(binary: PathBuf, work: PathBuf, pictures: PathBuf) -> io::Result<Tool> {
        fs::create_dir_all(&work)?;
        fs::create_dir_all(&pictures)?;
        let output = Command::new(&binary).args(["fair", "--help"]).output()?;
        let help = String::from_utf8_lossy(&output.stdout).into_owned();
        Ok(Tool {
            binary,
            work,
            pictures,
            help,
        })
    }

    /// Whether `fairmesh fair` has this option.
    pub fn can(&self, option: &str) -> bool {
        self.help.contains(option)
    }

    /// Runs the program; exit codes 0 and 3 (not converged) are fine.
    fn run(&self, arguments: &[String]) -> io::Result<()> {
        let output = Command::new(&self.binary).args(arguments).output()?;
        match output.status.code() {
            Some(0 | 3) => Ok(()),
            _ => Err(io::Error::other(format!(
                "fairmesh {}: {}",
                arguments.join(" "),
                String::from_utf8_lossy(&output.stderr)
            ))),
        }
    }

    /// `fairmesh generate KIND ...`.
    pub fn generate(&self, name: &str, arguments: &[&str]) -> io::Result<Case> {
        let path = |end: &str| self.work.join(format!("{name}{end}"));
        let (file, free_file, normals_file) = (path(".ply"), path(".free.txt"), path(".normals.txt"));
        let mut all: Vec<String> = vec!["generate".into()];
        all.extend(arguments.iter().map(|&a| a.to_owned()));
        for (option, value) in [
            ("-o", &file),
            ("--free", &free_file),
            ("--normals", &normals_file),
        ] {
            all.extend([option.to_owned(), value.display().to_string()]);
        }
        self.run(&all)?;
        read_case(name, file, free_file, Some(normals_file))
    }

    /// A mesh with what is free in it, as files.
    pub fn put(
        &self,
        name: &str,
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        free: &[u32],
    ) -> io::Result<Case> {
        let (file, free_file) = (
            self.work.join(format!("{name}.ply")),
            self.work.join(format!("{name}.free.txt")),
        );
        fs::write(&file, ply(positions, triangles))?;
        let lines: String = free.iter().map(|v| format!("{v}\n")).collect();
        fs::write(&free_file, lines)?;
        read_case(name, file, free_file, None)
    }

    /// A mesh file that this program or its like has written, with its free vertices.
    pub fn read(&self, name: &str, mesh: &Path, free: &Path) -> io::Result<Case> {
        read_case(name, mesh.to_path_buf(), free.to_path_buf(), None)
    }

    /// A mesh file of somebody else's: its positions are not read here.
    pub fn scan(&self, name: &str, mesh: &Path, free: &Path) -> Case {
        Case {
            name: name.to_owned(),
            file: mesh.to_path_buf(),
            free_file: free.to_path_buf(),
            normals_file: None,
            positions: Vec::new(),
            triangles: Vec::new(),
            free: Vec::new(),
        }
    }

    /// `fairmesh fair ...`; `name` is added to the mesh's for the result.
    pub fn fair(&self, case: &Case, name: &str, arguments: &[&str]) -> io::Result<Run> {
        let file = self.work.join(format!("{}.{name}.ply", case.name));
        let report = self.work.join(format!("{}.{name}.json", case.name));
        let mut all: Vec<String> = ["fair", "--quiet"].map(str::to_owned).to_vec();
        all.push(case.file.display().to_string());
        for (option, value) in [("-o", &file), ("--free", &case.free_file), ("--json", &report)] {
            all.extend([option.to_owned(), value.display().to_string()]);
        }
        if let Some(normals) = &case.normals_file {
            all.extend(["--normals".to_owned(), normals.display().to_string()]);
        }
        all.extend(arguments.iter().map(|&a| a.to_owned()));
        self.run(&all)?;
        let report = serde_json::from_slice(&fs::read(&report)?).map_err(io::Error::other)?;
        let positions = if case.positions.is_empty() {
            Vec::new()
        } else {
            read_ply(&file)?.0
        };
        Ok(Run {
            file,
            positions,
            report,
        })
    }

    /// `fairmesh fill ...` of a mesh with holes.
    pub fn fill(&self, case: &Case, name: &str, arguments: &[&str]) -> io::Result<Run> {
        let file = self.work.join(format!("{}.{name}.ply", case.name));
        let report = self.work.join(format!("{}.{name}.json", case.name));
        let mut all: Vec<String> = ["fill", "--quiet"].map(str::to_owned).to_vec();
        all.push(case.file.display().to_string());
        for (option, value) in [("-o", &file), ("--json", &report)] {
            all.extend([option.to_owned(), value.display().to_string()]);
        }
        all.extend(arguments.iter().map(|&a| a.to_owned()));
        self.run(&all)?;
        Ok(Run {
            positions: read_ply(&file)?.0,
            report: serde_json::from_slice(&fs::read(&report)?).map_err(io::Error::other)?,
            file,
        })
    }

    /// The same `times` times: the quickest of them, and the mean CPU seconds of the whole program, files included,
    /// where the system tells.
    pub fn timed(
        &self,
        case: &Case,
        name: &str,
        arguments: &[&str],
        times: usize,
    ) -> io::Result<(Run, Option<f64>)> {
        let before = cpu_of_children();
        let mut best = self.fair(case, name, arguments)?;
        for _ in 1..times {
            let run = self.fair(case, name, arguments)?;
            if run.seconds() < best.seconds() {
                best = run;
            }
        }
        let used = cpu_of_children()
            .zip(before)
            .map(|(after, before)| after - before);
        Ok((best, used.map(|seconds| seconds / times as f64)))
    }

    /// `fairmesh render ...` of files with captions; returns the picture's line for the document.
    pub fn render(
        &self,
        picture: &str,
        what: &str,
        meshes: &[(&Path, &str)],
        arguments: &[&str],
    ) -> io::Result<String> {
        let mut all = vec!["render".to_owned()];
        all.extend(meshes.iter().map(|(file, _)| file.display().to_string()));
        for (_, caption) in meshes {
            all.extend(["--caption".to_owned(), (*caption).to_owned()]);
        }
        let path = self.pictures.join(picture);
        all.extend(["-o".to_owned(), path.display().to_string()]);
        all.extend(arguments.iter().map(|&a| a.to_owned()));
        self.run(&all)?;
        Ok(format!("![{what}](docs/reproduction/{picture})\n"))
    }

    /// Writes other positions of a mesh, to be shown.
    pub fn write(&self, case: &Case, name: &str, positions: &[[f64; 3]]) -> io::Result<PathBuf> {
        let file = self.work.join(format!("{}.{name}.ply", case.name));
        fs::write(&file, ply(positions, &case.triangles))?;
        Ok(file)
    }
}

fn read_case(
    name: &str,
    file: PathBuf,
    free_file: PathBuf,
    normals_file: Option<PathBuf>,
) -> io::Result<Case> {
    let (positions, triangles) = read_ply(&file)?;
    let text = fs::read_to_string(&free_file)?;
    let free = text.lines().filter_map(|line| line.trim().parse().ok()).collect();
    Ok(Case {
        name: name.to_owned(),
        file,
        free_file,
        normals_file,
        positions,
        triangles,
        free,
    })
}

/// User and system seconds of the processes that were waited for, as Linux counts them: in hundredths.
fn cpu_of_children() -> Option<f64> {
    let stat = fs::read_to_string("/proc/self/stat").ok()?;
    // The name, in parentheses, may hold anything.
    let fields: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    let [user, system] = [13, 14].map(|k| fields.get(k).and_then(|f| f.parse::<f64>().ok()));
    Some((user? + system?) / 100.0)
}

fn header(bytes: &[u8]) -> io::Result<(String, &[u8])> {
    let end = b"end_header\n";
    let at = bytes
        .windows(end.len())
        .position(|w| w == end)
        .ok_or_else(|| io::Error::other("no PLY header"))?;
    Ok((
        String::from_utf8_lossy(&bytes[..at]).into_owned(),
        &bytes[at + end.len()..],
    ))
}

/// Positions and triangles.
type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// A PLY file as this program writes it: doubles, then triangles with counts of one byte and 32-bit numbers.
pub fn read_ply(path: &Path) -> io::Result<Mesh> {
    let bytes = fs::read(path)?;
    let (text, mut body) = header(&bytes)?;
    let count = |element: &str| {
        let line = text.lines().find_map(|line| line.strip_prefix(element));
        line.and_then(|n| n.trim().parse::<usize>().ok())
            .ok_or_else(|| io::Error::other(format!("no '{element}' in {}", path.display())))
    };
    let (vertices, faces) = (count("element vertex")?, count("element face")?);
    let mut take = |size: usize| {
        let (head, rest) = body.split_at_checked(size).ok_or(io::ErrorKind::UnexpectedEof)?;
        body = rest;
        io::Result::Ok(head)
    };
    let mut positions = Vec::with_capacity(vertices);
    for _ in 0..vertices {
        let p = take(24)?;
        positions.push([0, 1, 2].map(|k| {
            let mut eight = [0; 8];
            eight.copy_from_slice(&p[8 * k..8 * k + 8]);
            f64::from_le_bytes(eight)
        }));
    }
    let mut triangles = Vec::with_capacity(faces);
    for _ in 0..faces {
        let t = &take(13)?[1..];
        triangles.push([0, 1, 2].map(|k| {
            let mut four = [0; 4];
            four.copy_from_slice(&t[4 * k..4 * k + 4]);
            u32::from_le_bytes(four)
        }));
    }
    Ok((positions, triangles))
}

fn ply(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\n\
         property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        positions.len(),
        triangles.len()
    )
    .into_bytes();
    positions
        .as_flattened()
        .iter()
        .for_each(|x| bytes.extend(x.to_le_bytes()));
    for t in triangles {
        bytes.push(3);
        t.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
    }
    bytes
}
