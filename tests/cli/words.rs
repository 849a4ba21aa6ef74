//! What the short helps say is in plain words.

use crate::common::{directory, expect};
use crate::jargon::{said, words_for_experts};

/// Of the program, of each command the first paragraph, and what is said of each command in the list.
#[test]
fn short_helps_say_no_word_for_experts() {
    let directory = directory("words");
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let words = words_for_experts(&root);
    let (all, _) = expect(&directory, &["--help"], 0);
    assert_eq!(said(&all, &words), [""; 0]);
    let (_, list) = all.split_once("Commands:\n").unwrap();
    let (list, _) = list.split_once("\n\n").unwrap();
    let commands: Vec<&str> = list
        .lines()
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert!(commands.len() > 8 && commands.contains(&"fair"), "{commands:?}");
    for command in commands.into_iter().filter(|&command| command != "help") {
        let (help, _) = expect(&directory, &[command, "--help"], 0);
        let about = help.split("\n\n").next().unwrap();
        assert_eq!(said(about, &words), [""; 0], "{command}: {about}");
    }
}
