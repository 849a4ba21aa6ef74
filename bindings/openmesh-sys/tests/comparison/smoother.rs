//! OpenMesh's smoother, safe to call.

use std::ffi::CStr;
use std::ptr::NonNull;

use openmesh_sys::*;

/// A mesh of OpenMesh with its selected vertices.
pub struct Smoother {
    handle: NonNull<om_mesh>,
    count: usize,
}

impl Drop for Smoother {
    fn drop(&mut self) {
        // SAFETY: made by the shim, and given up here.
        unsafe { om_mesh_free(self.handle.as_ptr()) }
    }
}

fn last_error() -> String {
    // SAFETY: a string that lives until this thread's next call.
    let text = unsafe { CStr::from_ptr(om_last_error()) };
    text.to_string_lossy().into_owned()
}

impl Smoother {
    /// A mesh whose `free` vertices move. OpenMesh refuses triangles that make an edge or vertex that is not a manifold.
    pub fn new(positions: &[[f64; 3]], triangles: &[[u32; 3]], free: &[bool]) -> Result<Self, String> {
        assert_eq!(positions.len(), free.len());
        let (coordinates, corners) = (positions.as_flattened(), triangles.as_flattened());
        // SAFETY: as many coordinates, corners and flags as the counts say; indices are checked there.
        unsafe {
            let mesh = om_mesh_build(
                coordinates.as_ptr(),
                positions.len(),
                corners.as_ptr(),
                triangles.len(),
            );
            let handle = NonNull::new(mesh).ok_or_else(last_error)?;
            om_mesh_select(mesh, free.as_ptr());
            let count = positions.len();
            Ok(Self { handle, count })
        }
    }

    /// So many iterations.
    pub fn smooth(&mut self, iterations: u32) {
        // SAFETY: a living mesh.
        let done = unsafe { om_mesh_smooth(self.handle.as_ptr(), iterations) };
        assert!(done, "{}", last_error());
    }

    /// All positions.
    pub fn positions(&self) -> Vec<[f64; 3]> {
        let mut all = vec![[0.0; 3]; self.count];
        // SAFETY: room for all vertices.
        unsafe { om_mesh_positions(self.handle.as_ptr(), all.as_flattened_mut().as_mut_ptr()) }
        all
    }
}
