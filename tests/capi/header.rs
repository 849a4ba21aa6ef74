//! `include/fairmesh.h` is what cbindgen makes of `src/capi`.

use fairmesh_declarations::source;

use crate::committed::path;

pub(crate) fn generated() -> String {
    let mut builder =
        cbindgen::Builder::new().with_config(cbindgen::Config::from_file(path("cbindgen.toml")).unwrap());
    for file in source::SOURCES {
        builder = builder.with_src(source::path(file));
    }
    let mut header = Vec::new();
    builder.generate().unwrap().write(&mut header);
    String::from_utf8(header).unwrap()
}

#[test]
fn generated_header_is_what_the_source_says() {
    crate::committed::check("include/fairmesh.h", &generated());
}

/// cbindgen leaves out what no function mentions, unless cbindgen.toml names it.
#[test]
fn every_enumeration_is_in_the_header() {
    let header = generated();
    let mut seen = 0;
    for file in source::SOURCES {
        let text = std::fs::read_to_string(source::path(file)).unwrap();
        for name in text.lines().filter_map(|line| line.strip_prefix("pub enum ")) {
            let name = name.trim_end_matches([' ', '{']);
            assert!(
                header.contains(&format!("enum {name}\n")),
                "{name} is not in cbindgen.toml"
            );
            seen += 1;
        }
    }
    assert!(seen > 15, "{seen}");
}

#[test]
fn every_function_struct_and_field_of_the_header_is_described() {
    let header = generated();
    let lines: Vec<&str> = header.lines().collect();
    let mut described = 0;
    for (k, line) in lines.iter().enumerate() {
        let text = line.trim();
        let field = line.starts_with("    ")
            && !line.starts_with("     ")
            && text.ends_with(';')
            && !text.ends_with(");");
        let variant = text.starts_with("FAIRMESH_") && text.ends_with(',');
        let function = line.starts_with("FAIRMESH_API");
        if field || variant || function {
            let before = lines[k - 1].trim();
            assert!(before.ends_with("*/"), "no description of: {text}");
            described += 1;
        }
    }
    assert!(described > 200, "{described}");
}
