//! The words for experts that docs/glossary.md explains.

use std::fs;
use std::path::Path;

/// In lower case, without markup.
pub(crate) fn words_for_experts(root: &Path) -> Vec<String> {
    let glossary = fs::read_to_string(root.join("docs/glossary.md")).unwrap();
    let (_, section) = glossary.split_once("\n## Words for experts\n").unwrap();
    let section = section.split("\n## ").next().unwrap();
    let rows = section.lines().filter(|line| line.starts_with("| ")).skip(1);
    let cells = rows.map(|row| row.split('|').nth(1).unwrap());
    let words: Vec<String> = cells
        .flat_map(|cell| cell.split(", "))
        .map(|word| plain(word.trim()))
        .collect();
    assert!(
        words.len() > 15 && words.contains(&"harmonic".to_owned()),
        "{words:?}"
    );
    words
}

/// A text in lower case, without markup, dashes as spaces.
fn plain(text: &str) -> String {
    let tags = ["<sub>", "</sub>", "<sup>", "</sup>", "`", "*"];
    let text = tags
        .iter()
        .fold(text.to_lowercase(), |text, tag| text.replace(tag, ""));
    text.replace('-', " ")
}

/// Which of the words a text says, as words of their own.
pub(crate) fn said<'a>(text: &str, words: &'a [String]) -> Vec<&'a str> {
    let text = plain(text);
    let is_letter = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    let says = |word: &str| {
        text.match_indices(word).any(|(at, _)| {
            let behind = &text[at + word.len()..];
            // Its letter H belongs to the word.
            let ends = word.ends_with('b') && behind.starts_with('h') || !is_letter(behind.chars().next());
            !is_letter(text[..at].chars().next_back()) && ends
        })
    };
    let said = words.iter().filter(|word| says(word));
    said.map(String::as_str).collect()
}
