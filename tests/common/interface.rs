//! What programs that are linked with the shared library rely on.

/// What the SONAME ends with: the version up to the part that may break programs.
pub(crate) fn interface() -> String {
    let version: Vec<&str> = env!("CARGO_PKG_VERSION").split('.').collect();
    let parts = if version[0] == "0" { 2 } else { 1 };
    version[..parts].join(".")
}
