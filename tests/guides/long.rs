//! Guides for other programs: Python, Blender, MeshLab, a C compiler. What is missing is installed by the guides, or an error.

use crate::assert_picture;
use crate::mesh::{Mesh, off_sphere};
use crate::runner;

#[test]
#[ignore = "long tier: builds the Python package and fetches others"]
pub(crate) fn python_textured_obj() {
    let folder = runner::run("python-textured-obj");
    let read = |name: &str| Mesh::read(&folder.join(name));
    assert!(read("dented.obj").largest(off_sphere) > 0.1);
    assert!(read("mended.obj").largest(off_sphere) < 1e-5);
    assert_picture(&folder.join("both.png"), Some("python-textured-obj"));
}

#[test]
#[ignore = "long tier: builds the add-on, needs Blender"]
pub(crate) fn blender_headless() {
    let folder = runner::run("blender-headless");
    let mended = Mesh::read(&folder.join("mended.stl"));
    assert!(mended.holes().is_empty());
    assert!(mended.largest(off_sphere) < 1e-3);
}

#[test]
#[ignore = "long tier: builds the plugin, fetches PyMeshLab"]
pub(crate) fn meshlab_script() {
    let folder = runner::run("meshlab-script");
    let closed = Mesh::read(&folder.join("closed.ply"));
    assert!(closed.holes().is_empty());
    assert!(closed.largest(off_sphere) < 1e-4);
}

#[test]
#[ignore = "long tier: installs the C library"]
pub(crate) fn c_program() {
    let folder = runner::run("c-program");
    let closed = Mesh::read(&folder.join("closed.off"));
    assert!(closed.holes().is_empty());
    assert!(closed.largest(off_sphere) < 1e-3);
}
