// Made by bindgen of shim/shim.h: do not edit, see tests/fresh.rs.

#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct om_mesh {
    _unused: [u8; 0],
}
unsafe extern "C" {
    #[doc = " What the last call on this thread failed with. Never NULL; valid until the next call."]
    pub fn om_last_error() -> *const ::core::ffi::c_char;
    #[doc = " `3 * vertices` coordinates, `3 * faces` indices."]
    pub fn om_mesh_build(
        positions: *const f64,
        vertices: usize,
        triangles: *const u32,
        faces: usize,
    ) -> *mut om_mesh;
    #[doc = " NULL is allowed."]
    pub fn om_mesh_free(mesh: *mut om_mesh);
    #[doc = " Three coordinates per vertex."]
    pub fn om_mesh_positions(mesh: *const om_mesh, out: *mut f64);
    #[doc = " Selects the vertices whose flag is set, and no others."]
    pub fn om_mesh_select(mesh: *mut om_mesh, vertices: *const bool);
    #[doc = " JacobiLaplaceSmootherT with C1, tangential and normal: selected vertices move, or all where none is selected; not those of\n the boundary."]
    pub fn om_mesh_smooth(mesh: *mut om_mesh, iterations: u32) -> bool;
}
