//! Meshes that come from stdin or go to stdout: they have no name that could tell their format.

use std::path::Path;

/// Whether this stands for stdin or stdout.
pub fn is_piped(path: &Path) -> bool {
    // Paths compare by their parts: "-/" would be "-".
    path.as_os_str() == "-"
}
