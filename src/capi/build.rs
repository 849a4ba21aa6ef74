//! The name that programs remember the shared library by: its major version is that of the C interface.

use std::env;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let os = env::var("CARGO_CFG_TARGET_OS").unwrap_or_default();
    let major = env::var("CARGO_PKG_VERSION_MAJOR").unwrap_or_default();
    match os.as_str() {
        "linux" | "freebsd" | "netbsd" | "openbsd" => {
            println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libfairmesh.so.{major}");
        }
        "macos" => {
            println!("cargo::rustc-cdylib-link-arg=-Wl,-install_name,@rpath/libfairmesh.{major}.dylib")
        }
        _ if env::var("CARGO_CFG_TARGET_FAMILY").is_ok_and(|family| family == "wasm") => {
            // A host adds its progress callback to the table.
            println!("cargo::rustc-cdylib-link-arg=--export-table");
            println!("cargo::rustc-cdylib-link-arg=--growable-table");
        }
        _ => {}
    }
}
