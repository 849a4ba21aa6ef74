//! Things are called what docs/glossary.md calls them.

use std::fs;
use std::path::{Path, PathBuf};

/// What is searched for words, from the root on.
const PLACES: [&str; 8] = [
    "src",
    "include",
    "docs",
    "bindings",
    "meshlab_plugin",
    "README.md",
    "ARCHITECTURE.md",
    "CONTRIBUTING.md",
];
const TEXTS: [&str; 10] = ["rs", "md", "h", "hpp", "cpp", "c", "py", "toml", "sh", "ui"];

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

fn glossary() -> String {
    fs::read_to_string(root().join("docs/glossary.md")).unwrap()
}

/// The first column of the table under a heading, without the two lines of its head.
fn first_column(text: &str, heading: &str) -> Vec<String> {
    let start = text.find(heading).unwrap();
    let rows = text[start..].lines().skip_while(|line| !line.starts_with('|'));
    rows.take_while(|line| line.starts_with('|'))
        .skip(2)
        .map(|line| line.split('|').nth(1).unwrap().trim().to_string())
        .collect()
}

fn words() -> Vec<String> {
    let cells = first_column(&glossary(), "## Words that are not used");
    let words = cells.iter().flat_map(|cell| cell.split(", "));
    words.map(str::to_string).collect()
}

/// The texts of this repository, with their names from the root on.
fn texts() -> Vec<(PathBuf, String)> {
    let mut open: Vec<PathBuf> = PLACES.iter().map(|place| root().join(place)).collect();
    let mut texts = Vec::new();
    while let Some(path) = open.pop() {
        let name = path.file_name().unwrap().to_str().unwrap();
        let is_made = name.starts_with('.') || ["target", "build", "dist", "third_party"].contains(&name);
        if path.is_dir() && !is_made {
            open.extend(fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
        } else if TEXTS
            .iter()
            .any(|end| path.extension().is_some_and(|e| e == *end))
            && name != "glossary.md"
            && let Ok(text) = fs::read_to_string(&path)
        {
            texts.push((path.strip_prefix(root()).unwrap().to_path_buf(), text));
        }
    }
    assert!(texts.len() > 100);
    texts
}

/// The words of a text in lower case; a name falls apart into its words.
fn plain(text: &str) -> String {
    let mut plain = String::new();
    for c in text.chars() {
        if c.is_uppercase() && plain.ends_with(char::is_alphanumeric) && !plain.ends_with(char::is_uppercase)
        {
            plain.push(' ');
        }
        plain.push(if c == '_' || c == '-' { ' ' } else { c });
    }
    plain.to_lowercase()
}

/// Whether a plain text says `word`, perhaps with an s behind it.
fn says(text: &str, word: &str) -> bool {
    let is_letter = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
    text.match_indices(word).any(|(at, _)| {
        let behind = &text[at + word.len()..];
        let behind = behind.strip_prefix('s').unwrap_or(behind);
        !is_letter(text[..at].chars().next_back()) && !is_letter(behind.chars().next())
    })
}

#[test]
fn words_are_found_in_sentences_and_in_names() {
    let said = |text: &str, word: &str| says(&plain(text), word);
    assert!(said("Along the Rims.", "rim") && said("outer_rim_count", "rim") && said("OuterRim", "rim"));
    assert!(said("a wide-fit", "wide fit"));
    assert!(!said("a prime, trimmed, rimless thing", "rim"));
}

#[test]
fn no_text_says_what_the_glossary_has_another_word_for() {
    let words = words();
    assert!(words.len() >= 6, "{words:?}");
    let mut found = Vec::new();
    for (name, text) in texts() {
        for (line, text) in (1..).zip(text.lines()) {
            let text = plain(text);
            let said = words.iter().filter(|word| says(&text, word));
            found.extend(said.map(|word| format!("{}:{line}: {word}", name.display())));
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn entries_stand_once_and_in_alphabetical_order() {
    let names = first_column(&glossary(), "# Glossary");
    assert!(names.len() > 50);
    let unsorted: Vec<_> = names.windows(2).filter(|pair| pair[0] >= pair[1]).collect();
    assert!(unsorted.is_empty(), "{unsorted:?}");
}

#[test]
fn words_in_italics_are_entries() {
    let text = glossary();
    let names = first_column(&text, "# Glossary");
    let italics: Vec<&str> = text.split('*').skip(1).step_by(2).collect();
    assert!(italics.len() > 10);
    for word in italics {
        let is_kind = || {
            names
                .iter()
                .any(|name| name.strip_suffix(" inner fairness") == Some(word))
        };
        let singular = word.strip_suffix('s').unwrap_or(word);
        assert!(
            names.iter().any(|name| name == word || name == singular) || is_kind(),
            "{word}"
        );
    }
}
