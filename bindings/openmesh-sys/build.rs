//! Finds OpenMesh, compiles the shim, and with the feature `regenerate` makes the bindings.

use std::process::exit;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=shim");
    // `print_system_cflags` would say `-isystem /usr/include`, with which the compiler loses its own <cstdlib>.
    let mut wanted = pkg_config::Config::new();
    wanted.atleast_version("9.0").print_system_cflags(false);
    let openmesh = wanted.probe("openmesh").unwrap_or_else(|why| {
        eprintln!("OpenMesh 9.0 or newer is needed: apt-get install libopenmesh-dev pkg-config\n{why}");
        exit(1);
    });
    cc::Build::new()
        .cpp(true)
        .std("c++17")
        .includes(&openmesh.include_paths)
        // Its assertions stand in the innermost loops; the comparison measures time.
        .define("NDEBUG", None)
        // Inlined, OpenMesh's vectors without a value worry GCC.
        .flag_if_supported("-Wno-maybe-uninitialized")
        .file("shim/shim.cpp")
        .compile("openmesh_shim");
    #[cfg(feature = "regenerate")]
    bindings();
}

/// `src/bindings.rs` has to be what bindgen makes of the header; with `OPENMESH_WRITE_BINDINGS` it becomes that.
#[cfg(feature = "regenerate")]
fn bindings() {
    use std::{env, fs};

    const COMMITTED: &str = "src/bindings.rs";
    println!("cargo::rerun-if-changed={COMMITTED}");
    println!("cargo::rerun-if-env-changed=OPENMESH_WRITE_BINDINGS");
    let made = bindgen::Builder::default()
        .header("shim/shim.h")
        .allowlist_item("om_.*")
        .use_core()
        .size_t_is_usize(true)
        .raw_line("// Made by bindgen of shim/shim.h: do not edit, see tests/fresh.rs.")
        .disable_header_comment()
        .merge_extern_blocks(true)
        .rustfmt_configuration_file(Some(
            std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rustfmt.toml"),
        ))
        .generate()
        .unwrap_or_else(|why| {
            eprintln!("no bindings of shim/shim.h: bindgen needs the Debian package libclang-dev.\n{why}");
            exit(1);
        })
        .to_string();
    if env::var_os("OPENMESH_WRITE_BINDINGS").is_some() {
        fs::write(COMMITTED, &made).expect("src/ can be written");
    }
    if fs::read_to_string(COMMITTED).unwrap_or_default() != made {
        eprintln!("{COMMITTED} is old: see the head of tests/fresh.rs");
        exit(1);
    }
}
