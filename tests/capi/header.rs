//! `include/fairmesh.h` is what cbindgen makes of `src/capi`. `FAIRMESH_WRITE_HEADER=1 cargo test --release -p fairmesh-capi --test capi header`
//! writes it.

use std::fs;
use std::path::Path;

const HEADER: &str = "include/fairmesh.h";

fn generated() -> String {
    let root = &Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut builder = cbindgen::Builder::new()
        .with_config(cbindgen::Config::from_file(root.join("cbindgen.toml")).unwrap());
    for file in [
        "status", "types", "records", "about", "fair", "steps", "fill", "reading",
    ] {
        builder = builder.with_src(root.join(format!("src/capi/{file}.rs")));
    }
    let mut header = Vec::new();
    builder.generate().unwrap().write(&mut header);
    String::from_utf8(header).unwrap()
}

#[test]
fn the_header_is_what_the_source_says() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(HEADER);
    let generated = generated();
    if std::env::var_os("FAIRMESH_WRITE_HEADER").is_some() {
        fs::write(&path, &generated).unwrap();
    }
    let committed = fs::read_to_string(&path).unwrap_or_default();
    assert!(
        committed == generated,
        "{HEADER} is old: run FAIRMESH_WRITE_HEADER=1 cargo test --release -p fairmesh-capi --test capi header"
    );
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
