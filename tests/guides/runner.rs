//! Runs a guide as its reader would: its commands one after the other, in an empty folder, with the files that it says to save.
//!
//! A block `sh` is run by bash, all of a guide's in one shell. A block `text` behind it is what it prints: `FAIRMESH_WRITE_DOCS=1`
//! writes it anew. Any other block is a file, whose name ends the line before it: "Save this as `name.py`:". A command that ends with
//! another code than 0 says so behind a `#`: `# exit code 3`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::document::{blocks, same_text};

/// Between what the steps print.
const MARK: char = '\u{1e}';

/// Where README.md is.
pub(crate) fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let has_guides = |folder: &&Path| folder.join("docs/guides").exists();
    here.ancestors().find(has_guides).unwrap().to_path_buf()
}

/// The guides by their names.
pub(crate) fn guides() -> Vec<String> {
    let files = fs::read_dir(root().join("docs/guides")).unwrap();
    let names = files.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let names = names.filter_map(|name| name.strip_suffix(".md").map(str::to_owned));
    let mut names: Vec<String> = names.filter(|name| name != "README").collect();
    names.sort();
    names
}

/// Commands that are run together, the files that are saved before, and the lines that they print, as shown.
#[derive(Default)]
struct Step {
    files: Vec<(String, String)>,
    commands: String,
    shown: Option<[usize; 2]>,
}

/// The name at the end of the line before a block.
fn file_name(lines: &[String], fence: usize) -> Option<&str> {
    let said = lines[..fence].iter().rev().find(|line| !line.is_empty())?;
    let (_, name) = said.strip_suffix("`:")?.rsplit_once('`')?;
    Some(name)
}

fn steps(guide: &str, lines: &[String]) -> Vec<Step> {
    let mut steps = vec![Step::default()];
    for block in blocks(lines) {
        let step = steps.last_mut().unwrap();
        let text = || lines[block.begin..block.end].join("\n") + "\n";
        match block.language.as_str() {
            "sh" => {
                step.commands = text();
                steps.push(Step::default());
            }
            "text" => {
                let at = steps.len().checked_sub(2);
                let at = at.unwrap_or_else(|| panic!("{guide}: an output of nothing"));
                steps[at].shown = Some([block.begin, block.end]);
            }
            _ => {
                let name = file_name(lines, block.begin - 1);
                let name =
                    name.unwrap_or_else(|| panic!("{guide}, line {}: a file without a name", block.begin));
                step.files.push((name.to_owned(), text()));
            }
        }
    }
    let last = steps.pop().unwrap();
    assert!(last.files.is_empty(), "{guide}: a file that nothing uses");
    steps
}

/// The commands of all steps as a script, which finds what is to be saved in `saved`.
fn script(steps: &[Step], saved: &Path) -> String {
    let mut script = String::from("set -euo pipefail\ntrap 'echo \"this failed: $BASH_COMMAND\" >&2' ERR\n");
    for (k, step) in steps.iter().enumerate() {
        for (name, _) in &step.files {
            let from = saved.join(k.to_string()).join(name);
            script += &format!("cp '{}' '{name}'\n", from.display());
        }
        for line in step.commands.lines() {
            script += &match line.split_once("# exit code ") {
                Some((command, code)) => {
                    let code: i32 = code.trim().parse().unwrap();
                    format!("{{ code=0; {command} || code=$?; [ $code = {code} ]; }}\n")
                }
                None => format!("{line}\n"),
            };
        }
        script += &format!("printf '{MARK}'\n");
    }
    script
}

/// A folder outside of the guide's, made anew.
fn fresh(folder: PathBuf) -> PathBuf {
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// Runs all commands of a guide, and compares what they print. Returns the folder with what they have made.
pub(crate) fn run(guide: &str) -> PathBuf {
    let document = root().join("docs/guides").join(format!("{guide}.md"));
    let text = fs::read_to_string(&document).unwrap();
    let lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let steps = steps(guide, &lines);
    let place = Path::new(env!("CARGO_TARGET_TMPDIR")).join("guides").join(guide);
    let (folder, saved) = (fresh(place.join("here")), fresh(place.join("saved")));
    for (k, step) in steps.iter().enumerate() {
        fs::create_dir_all(saved.join(k.to_string())).unwrap();
        for (name, content) in &step.files {
            fs::write(saved.join(k.to_string()).join(name), content).unwrap();
        }
    }
    let printed = bash(
        guide,
        &script(&steps, &saved),
        &folder,
        &fresh(place.join("home")),
    );
    let printed: Vec<&str> = printed.split(MARK).collect();
    let (mut renewed, mut copied, mut wrong) = (Vec::new(), 0, String::new());
    for (step, printed) in steps.iter().zip(printed) {
        let Some([begin, end]) = step.shown else {
            continue;
        };
        let printed: Vec<String> = printed.lines().map(str::to_owned).collect();
        renewed.extend_from_slice(&lines[copied..begin]);
        copied = begin;
        if !same_text(&lines[begin..end], &printed) {
            let (shown, found) = (lines[begin..end].join("\n"), printed.join("\n"));
            wrong += &format!("{guide}: shown\n{shown}\nprinted\n{found}\n");
            renewed.extend(printed);
            copied = end;
        }
    }
    renewed.extend_from_slice(&lines[copied..]);
    if !wrong.is_empty() && std::env::var_os("FAIRMESH_WRITE_DOCS").is_some() {
        fs::write(&document, renewed.join("\n") + "\n").unwrap();
    } else {
        assert!(wrong.is_empty(), "{wrong}");
    }
    folder
}

/// Runs a script in a folder, for a user who has nothing but this program and these sources; returns what it prints.
fn bash(guide: &str, script: &str, folder: &Path, home: &Path) -> String {
    let program = Path::new(env!("CARGO_BIN_EXE_fairmesh")).parent().unwrap();
    let path = std::env::var("PATH").unwrap();
    let old_home = PathBuf::from(std::env::var_os("HOME").unwrap());
    // What cargo and pip have fetched serves every user of this machine.
    let kept =
        |name: &str, default: &str| std::env::var_os(name).unwrap_or_else(|| old_home.join(default).into());
    let output = Command::new("bash")
        .args(["-c", script])
        .current_dir(folder)
        .env("PATH", format!("{}:{path}", program.display()))
        .env("FAIRMESH", root())
        .env("CARGO_HOME", kept("CARGO_HOME", ".cargo"))
        .env("RUSTUP_HOME", kept("RUSTUP_HOME", ".rustup"))
        .env("PIP_CACHE_DIR", kept("PIP_CACHE_DIR", ".cache/pip"))
        .env("HOME", home)
        .env("PIP_DISABLE_PIP_VERSION_CHECK", "1")
        .env_remove("PYTHONPATH")
        .env_remove("VIRTUAL_ENV")
        .env_remove("LD_LIBRARY_PATH")
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stdout).replace("\r\n", "\n");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success(),
        "{guide}: {}\n{said}\n{errors}",
        output.status
    );
    said
}
