//! Files that a mesh names, as its materials and textures: what is written elsewhere names them by a path that leads there.

use std::fs;
use std::ops::Range;
use std::path::{Component, Path, PathBuf};

use super::format::Format;
use super::patches::Patches;
use super::pipes::is_piped;
use crate::text;

/// A result whose names lead to the files of its input, and what there is to say about that.
pub struct Led {
    pub bytes: Vec<u8>,
    pub told: Vec<String>,
}

/// The bytes of a result as they shall stand at `output`, where `input` named other files.
pub fn led(bytes: Vec<u8>, format: Format, input: &Path, output: &Path) -> Led {
    let mut told = Vec::new();
    let names = match format {
        Format::Obj => libraries(&bytes),
        Format::Ply => textures(&bytes),
        Format::Off | Format::Stl => Vec::new(),
    };
    let (from, to) = (folder(input), folder(output));
    if names.is_empty() || from.is_some() && from == to {
        return Led { bytes, told };
    }
    let mut patches = Patches::default();
    for range in names
        .into_iter()
        .flat_map(|range| single(&bytes, range, format, from.as_deref()))
    {
        let Ok(name) = std::str::from_utf8(&bytes[range.clone()]) else {
            let name = String::from_utf8_lossy(&bytes[range]);
            told.push(format!(
                "it names the file {name} as before: the name is not in UTF-8"
            ));
            continue;
        };
        if Path::new(name).is_absolute() {
            continue;
        }
        let (Some(from), true) = (&from, is_there(from.as_deref(), name)) else {
            told.push(format!(
                "it names the file {name}, which was not found beside the input"
            ));
            continue;
        };
        match &to {
            Some(to) => {
                let new = path_from(to, &from.join(name));
                told.push(format!("it names {name} as {new} now, where that is"));
                patches.replace(range, new.as_bytes());
            }
            None => told.push(format!(
                "it names the file {name}, which lies in {}: write it there, or copy that file",
                from.display()
            )),
        }
    }
    Led {
        bytes: patches.apply(&bytes),
        told,
    }
}

/// The names that a mesh in this folder gives to its materials (OBJ) or textures (PLY).
pub fn named(bytes: &[u8], format: Format, folder: &Path) -> Vec<String> {
    let names = match format {
        Format::Obj => libraries(bytes),
        Format::Ply => textures(bytes),
        Format::Off | Format::Stl => Vec::new(),
    };
    let single = names
        .into_iter()
        .flat_map(|range| single(bytes, range, format, Some(folder)));
    single
        .map(|range| String::from_utf8_lossy(&bytes[range]).into_owned())
        .collect()
}

/// The folder of a file, behind links; stdin and stdout have none.
fn folder(path: &Path) -> Option<PathBuf> {
    if is_piped(path) {
        return None;
    }
    let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
    fs::canonicalize(parent.unwrap_or(Path::new("."))).ok()
}

fn is_there(folder: Option<&Path>, name: &str) -> bool {
    folder.is_some_and(|folder| folder.join(name).is_file())
}

/// What stands behind `mtllib` in an OBJ file.
fn libraries(bytes: &[u8]) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut at = text::start(bytes);
    while at < bytes.len() {
        let (line, next) = text::line(bytes, at);
        found.extend(behind(bytes, line, &["mtllib"]));
        at = next;
    }
    found
}

/// What stands behind `comment TextureFile` in the header of a PLY file.
fn textures(bytes: &[u8]) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut at = text::start(bytes);
    while at < bytes.len() {
        let (line, next) = text::line(bytes, at);
        if bytes[line.clone()].trim_ascii_end() == b"end_header" {
            break;
        }
        found.extend(behind(bytes, line, &["comment", "TextureFile"]));
        at = next;
    }
    found
}

/// The rest of a line that begins with these words, without white space around it; None if it is empty.
fn behind(bytes: &[u8], line: Range<usize>, begin: &[&str]) -> Option<Range<usize>> {
    let mut words = text::words(bytes, line.clone());
    for word in begin {
        if bytes[words.next()?] != *word.as_bytes() {
            return None;
        }
    }
    let start = words.next()?.start;
    Some(start..start + bytes[start..line.end].trim_ascii_end().len())
}

/// The single names: a whole line of an OBJ file if there is such a file, its words otherwise; a PLY file has one.
fn single(bytes: &[u8], line: Range<usize>, format: Format, from: Option<&Path>) -> Vec<Range<usize>> {
    let whole = std::str::from_utf8(&bytes[line.clone()]);
    if format == Format::Ply || whole.is_ok_and(|name| is_there(from, name)) {
        return vec![line];
    }
    text::words(bytes, line).collect()
}

/// How a file is named from a folder, both without links; with `/` everywhere, as meshes have it.
fn path_from(folder: &Path, file: &Path) -> String {
    let (from, to): (Vec<Component<'_>>, Vec<Component<'_>>) =
        (folder.components().collect(), file.components().collect());
    let common = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    if common == 0 {
        return file.display().to_string();
    }
    let up = from[common..].iter().map(|_| "..".to_owned());
    let down = to[common..]
        .iter()
        .map(|part| part.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<String>>().join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_go_up_and_down() {
        let named = |folder: &str, file: &str| path_from(Path::new(folder), Path::new(file));
        assert_eq!(named("/a/b", "/a/b/c.mtl"), "c.mtl");
        assert_eq!(named("/a/b/x", "/a/b/c.mtl"), "../c.mtl");
        assert_eq!(named("/a", "/a/b/c.mtl"), "b/c.mtl");
        assert_eq!(named("/tmp/out", "/home/me/t x/c.mtl"), "../../home/me/t x/c.mtl");
    }

    #[test]
    fn names_are_found_where_formats_have_them() {
        let found = |bytes: &[u8], of: fn(&[u8]) -> Vec<Range<usize>>| -> Vec<String> {
            let names = of(bytes).into_iter();
            names
                .map(|range| String::from_utf8_lossy(&bytes[range]).into_owned())
                .collect()
        };
        let obj = b"# mtllib no.mtl\nmtllib a.mtl b c.mtl \r\nv 0 0 0\n  mtllib d.mtl\nmtllib\nmtllibx e\n";
        assert_eq!(found(obj, libraries), ["a.mtl b c.mtl", "d.mtl"]);
        let ply =
            b"ply\ncomment TextureFile a b.png\ncomment Texture c\nend_header\ncomment TextureFile d.png\n";
        assert_eq!(found(ply, textures), ["a b.png"]);
    }
}
