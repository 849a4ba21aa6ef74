//! Finds OpenMesh, compiles the shim, and with the feature `regenerate` makes the bindings.

use std::path::PathBuf;
use std::process::exit;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=shim");
    // `print_system_cflags` would say `-isystem /usr/include`, with which the compiler loses its own <cstdlib>.
    let found = pkg_config::Config::new()
        .atleast_version("9.0")
        .print_system_cflags(false)
        .probe("openmesh");
    let openmesh = found.unwrap_or_else(|why| {
        eprintln!(
            "OpenMesh 9.0 or newer is needed, and pkg-config does not find it: install the Debian packages \
             libopenmesh-dev and pkg-config (apt-get install libopenmesh-dev pkg-config).\n{why}"
        );
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
    regenerate(PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets it")));
}

#[cfg(feature = "regenerate")]
fn regenerate(out: PathBuf) {
    let bindings = bindgen::Builder::default()
        .header("shim/shim.h")
        .allowlist_item("[oO][mM]_.*")
        .use_core()
        .size_t_is_usize(true)
        .prepend_enum_name(false)
        .raw_line("// Made by bindgen of shim/shim.h: do not edit, see tests/fresh.rs.")
        .disable_header_comment()
        .formatter(bindgen::Formatter::Rustfmt)
        .rustfmt_configuration_file(Some(PathBuf::from(concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../rustfmt.toml"
        ))))
        .generate()
        .unwrap_or_else(|why| {
            eprintln!(
                "no bindings of shim/shim.h (the Debian package libclang-dev has what bindgen needs): {why}"
            );
            exit(1);
        });
    bindings
        .write_to_file(out.join("bindings.rs"))
        .expect("cargo's own directory");
}

#[cfg(not(feature = "regenerate"))]
fn regenerate(_: PathBuf) {}
