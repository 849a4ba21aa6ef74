//! What `src/capi` and the documents take of the library's tables and schemas is what stands there.

use fairmesh_declarations::{numbers, options, tables};

#[test]
fn generated_sources_are_those_of_the_tables() {
    let check = crate::committed::check;
    check("src/capi/numbers.rs", &numbers::numbers());
    check("src/capi/texts.rs", &numbers::texts());
    check("src/capi/option_structs.rs", &options::structs());
    check("docs/outcomes.md", &numbers::page());
}

#[test]
fn numbers_and_names_are_used_once() {
    for table in tables::all() {
        let entries = &table.entries;
        assert!(
            entries.windows(2).all(|w| w[0].number() < w[1].number()),
            "{}",
            table.name
        );
        for (k, entry) in entries.iter().enumerate() {
            let is_name = |c: char| c.is_ascii_lowercase() || c == '_';
            assert!(entry.name().chars().all(is_name), "{}", entry.name());
            assert!(
                entries[..k].iter().all(|e| e.name() != entry.name()),
                "{}",
                entry.name()
            );
            let text = entry.text();
            assert!(!text.is_empty() && !text.ends_with('.'), "{text}");
            assert!(!entry.remedy().ends_with('.'), "{}", entry.remedy());
        }
    }
}

#[test]
fn every_option_says_what_it_is_and_its_default() {
    for of in options::all() {
        for entry in of.entries() {
            let says = |word: &str| entry.text.contains(word);
            assert!(
                says("efault") || says("default"),
                "{}: {} has no default",
                of.name,
                entry.name
            );
            assert!(entry.text.ends_with('.'), "{}: {}", of.name, entry.name);
        }
    }
}
