//! The name that programs remember the shared library by: that of the C interface, which changes with the major version, and before 1.0 with
//! the minor one.

use std::env;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let os = env::var("CARGO_CFG_TARGET_OS").unwrap_or_default();
    let part = |name: &str| env::var(format!("CARGO_PKG_VERSION_{name}")).unwrap_or_default();
    let interface = match part("MAJOR").as_str() {
        "0" => format!("0.{}", part("MINOR")),
        major => major.to_owned(),
    };
    match os.as_str() {
        "linux" | "freebsd" | "netbsd" | "openbsd" => {
            println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libfairmesh.so.{interface}");
        }
        "macos" => {
            println!("cargo::rustc-cdylib-link-arg=-Wl,-install_name,@rpath/libfairmesh.{interface}.dylib")
        }
        _ if env::var("CARGO_CFG_TARGET_FAMILY").is_ok_and(|family| family == "wasm") => {
            // A host adds its progress callback to the table.
            println!("cargo::rustc-cdylib-link-arg=--export-table");
            println!("cargo::rustc-cdylib-link-arg=--growable-table");
        }
        _ => {}
    }
}
