//! Labels, tooltips, first lines of help and first paragraphs say no word for experts, unless it is linked to what it means.

use std::fs;
use std::path::{Path, PathBuf};

#[path = "common/jargon.rs"]
mod jargon;

use jargon::{said, words_for_experts};

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// Files of a folder with this ending, sorted.
fn files(folder: &str, end: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(root().join(folder)).unwrap();
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == end))
        .collect();
    files.sort();
    files
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|why| panic!("{}: {why}", path.display()))
}

/// Fails with the texts that say a word for experts.
fn none_says(texts: impl Iterator<Item = (String, String)>) {
    let words = words_for_experts(root());
    let (mut count, mut found) = (0, Vec::new());
    for (place, text) in texts {
        count += 1;
        for word in said(&text, &words) {
            found.push(format!("{place}: '{word}' in: {text}"));
        }
    }
    assert!(count > 4, "only {count} texts were found");
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// The string literals of a source in C++ or Python, those that follow each other as one. Comments are passed over.
fn literals(source: &str, comment: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    let (mut rest, mut follows) = (source, false);
    while let Some(c) = rest.chars().next() {
        if rest.starts_with(comment) {
            rest = &rest[rest.find('\n').unwrap_or(rest.len())..];
        } else if c == '"' {
            let quote = if rest.starts_with("\"\"\"") {
                "\"\"\""
            } else {
                "\""
            };
            let mut end = quote.len();
            while !rest[end..].starts_with(quote) {
                let step = rest[end..].chars().next().expect("a string that ends");
                end += step.len_utf8() + usize::from(step == '\\');
            }
            let text = &rest[quote.len()..end];
            match found.last_mut() {
                Some(last) if follows => last.push_str(text),
                _ => found.push(text.to_owned()),
            }
            follows = true;
            rest = &rest[end + quote.len()..];
        } else {
            follows &= c.is_whitespace();
            rest = &rest[c.len_utf8()..];
        }
    }
    found
}

/// The first paragraph: what stands behind the title, up to an empty line; pictures and remarks in the source are none.
fn first_paragraph(page: &str) -> String {
    let mut lines = page
        .lines()
        .skip_while(|line| line.is_empty() || line.starts_with(['#', '!', '<']));
    lines
        .by_ref()
        .take_while(|line| !line.is_empty())
        .collect::<Vec<_>>()
        .join(" ")
}

/// A text without its links to the glossary, and with the words alone of other links, but for names of pages.
fn without_explained(text: &str) -> String {
    let (mut plain, mut rest) = (String::new(), text);
    while let Some(middle) = rest.find("](") {
        let close = middle + rest[middle..].find(')').unwrap();
        let begin = rest[..middle].rfind('[').unwrap();
        let (words, target) = (&rest[begin + 1..middle], &rest[middle + 2..close]);
        plain += &rest[..begin];
        if !target.contains("glossary.md") && !words.ends_with(".md") {
            plain += words;
        }
        rest = &rest[close + 1..];
    }
    plain + rest
}

#[test]
fn links_to_the_glossary_explain() {
    let text =
        "A [harmonic](../glossary.md#words) surface, [other](a.md), [g2.md](g2.md) and [G1](glossary.md).";
    assert_eq!(without_explained(text), "A  surface, other,  and .");
    let page = "# Title\n\n![G2](a.png)\n\nOne\ntwo.\n\nThree.\n";
    assert_eq!(first_paragraph(page), "One two.");
    assert_eq!(
        literals("f(\"a \" // \"no\"\n \"b\", \"c\\\"\")", "//"),
        ["a b", "c\\\""]
    );
    let words = words_for_experts(root());
    assert_eq!(
        said("solves Δ<sub>B</sub>H = 0 (G1), a half-edge", &words).len(),
        3
    );
    assert!(said("G10, harmonics_of, inharmonic", &words).is_empty());
}

#[test]
fn first_paragraphs_of_pages() {
    let mut pages = vec![
        root().join("README.md"),
        root().join("bindings/python/README.md"),
        root().join("bindings/blender/README.md"),
        root().join("bindings/python/examples/gallery/README.md"),
        root().join("meshlab_plugin/README.md"),
    ];
    pages.extend(files("docs", "md"));
    pages.extend(files("docs/guides", "md"));
    none_says(
        pages
            .iter()
            .filter(|page| !page.ends_with("glossary.md"))
            .map(|page| {
                let text = without_explained(&first_paragraph(&read(page)));
                (page.display().to_string(), text)
            }),
    );
}

/// What the add-on shows: every text with a space in it.
#[test]
fn labels_and_tooltips_of_blender() {
    none_says(files("bindings/blender/addon", "py").iter().flat_map(|file| {
        let texts = literals(&read(file), "#")
            .into_iter()
            .filter(|text| text.contains(' '));
        let name = file.file_name().unwrap().to_str().unwrap().to_owned();
        texts
            .map(move |text| (name.clone(), without_names(&text)))
            .collect::<Vec<_>>()
    }));
}

/// A text without what stands for a label (`{option.CHOICE}`), and without Blender's own name of a menu.
fn without_names(text: &str) -> String {
    let mut pieces = text.split('{');
    let first = pieces.next().unwrap_or_default().to_owned();
    let rest = pieces.map(|piece| piece.split_once('}').map_or(piece, |(_, behind)| behind));
    rest.fold(first, |text, piece| text + piece)
        .replace("Non Manifold", "")
}

/// Names of filters, labels and tooltips of parameters, and the sentence in bold that a help text begins with.
#[test]
fn names_labels_and_tooltips_of_meshlab() {
    let read = |name: &str| read(&root().join("meshlab_plugin/src").join(name));
    let texts = literals(&read("texts.cpp"), "//").into_iter();
    let heads = texts.map(|text| match text.split_once("</b>") {
        Some((head, _)) if text.starts_with("<b>") => head.to_owned(),
        _ if text.contains('.') => String::new(),
        _ => text,
    });
    let parameters = [
        "parameters.cpp",
        "fair_selection.cpp",
        "close_holes.cpp",
        "erase_and_fill.cpp",
        "bridge_boundaries.cpp",
        "round_edges.cpp",
    ];
    let shown = parameters.iter().flat_map(|name| literals(&read(name), "//"));
    // Dialogs of MeshLab 2020.09 show two lines of a tooltip, of some 42 letters.
    let tooltips = literals(&read("parameters.cpp"), "//").into_iter();
    let long: Vec<String> = tooltips.filter(|text| text.chars().count() > 84).collect();
    assert_eq!(long, [""; 0]);
    // Names of choices in Python are the library's.
    let shown = shown.filter(|text| text.contains(' ') || text.starts_with(char::is_uppercase));
    none_says(heads.chain(shown).map(|text| ("MeshLab".to_owned(), text)));
}

/// The dialogs of MeshLab 2020.09 show two lines of a help text: its first sentence says what the filter is for, and fits.
#[test]
fn helps_of_meshlab_begin_with_what_the_filter_is_for() {
    let texts = literals(&read(&root().join("meshlab_plugin/src/texts.cpp")), "//");
    let helps: Vec<&String> = texts.iter().filter(|text| text.starts_with("<b>")).collect();
    assert_eq!(helps.len(), 6);
    for help in helps {
        let (first, _) = help["<b>".len()..].split_once("</b>").unwrap();
        assert!(first.ends_with('.') && first.len() < 100, "{first}");
    }
}

/// Functions and classes that users see; not what is made of the C header when the package is built.
#[test]
fn first_lines_of_help_in_python() {
    let ignored = read(&root().join(".gitignore"));
    let is_made = |file: &&PathBuf| ignored.contains(&format!("/{}\n", file.file_name().unwrap().display()));
    none_says(
        files("bindings/python/src/fairmesh", "py")
            .iter()
            .filter(|file| !is_made(file))
            .flat_map(|file| {
                let name = file.file_name().unwrap().to_str().unwrap().to_owned();
                let source = read(file);
                let lines = source.split("\"\"\"").skip(1).step_by(2);
                let lines = lines.map(|text| text.lines().next().unwrap_or_default().to_owned());
                lines.map(move |line| (name.clone(), line)).collect::<Vec<_>>()
            }),
    );
}
