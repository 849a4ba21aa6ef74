//! What may have been meant by a name that does not exist.

use std::path::{Path, PathBuf};

/// From this likeness on a name is proposed, as by clap for flags.
const ALIKE: f64 = 0.7;

/// The name most like the one that is wanted, if any is like it.
pub fn similar<'a>(wanted: &str, among: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let likeness = |name: &str| strsim::jaro(&wanted.to_lowercase(), &name.to_lowercase());
    among
        .map(|name| (likeness(name), name))
        .filter(|(likeness, _)| *likeness > ALIKE)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| name)
}

/// The file beside a missing one whose name is most like it.
pub fn similar_file(missing: &Path) -> Option<PathBuf> {
    let wanted = missing.file_name()?.to_str()?;
    let folder = missing.parent()?;
    let here = match folder.as_os_str().is_empty() {
        true => Path::new("."),
        false => folder,
    };
    let mut names: Vec<String> = std::fs::read_dir(here)
        .ok()?
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        // A short name is like many.
        .filter(|name| Path::new(name).extension().is_some() == missing.extension().is_some())
        .collect();
    // The order of a folder is not the same everywhere.
    names.sort_unstable();
    similar(wanted, names.iter().map(String::as_str)).map(|name| folder.join(name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_name_or_none() {
        let names = ["selected", "quality", "red"];
        assert_eq!(similar("selectd", names.into_iter()), Some("selected"));
        assert_eq!(similar("QUALITY", names.into_iter()), Some("quality"));
        assert_eq!(similar("thickness", names.into_iter()), None);
    }

    #[test]
    fn a_file_without_a_suffix_is_not_meant_by_one_that_has() {
        let folder = std::env::temp_dir().join(format!("fairmesh-similar-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        for name in ["e", "hope.ply"] {
            std::fs::write(folder.join(name), "").unwrap();
        }
        let missing = |name: &str| similar_file(&folder.join(name));
        assert_eq!(missing("nope.ply"), Some(folder.join("hope.ply")));
        std::fs::remove_file(folder.join("hope.ply")).unwrap();
        assert_eq!(missing("nope.ply"), None);
        std::fs::remove_dir_all(folder).unwrap();
    }
}
