// Made by bindgen of shim/shim.h: do not edit, see tests/fresh.rs.

#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct om_mesh {
    _unused: [u8; 0],
}
pub const OM_FLOAT: om_scalar = 0;
pub const OM_DOUBLE: om_scalar = 1;
#[doc = " The numbers that a mesh stores."]
pub type om_scalar = ::core::ffi::c_uint;
pub const OM_VERTEX: om_element = 0;
pub const OM_EDGE: om_element = 1;
pub const OM_FACE: om_element = 2;
#[doc = " What has a status."]
pub type om_element = ::core::ffi::c_uint;
pub const OM_SELECTED: om_flag = 0;
pub const OM_LOCKED: om_flag = 1;
pub const OM_FEATURE: om_flag = 2;
pub const OM_DELETED: om_flag = 3;
#[doc = " Bits of a status."]
pub type om_flag = ::core::ffi::c_uint;
pub const OM_TANGENTIAL: om_component = 0;
pub const OM_NORMAL: om_component = 1;
pub const OM_TANGENTIAL_AND_NORMAL: om_component = 2;
#[doc = " JacobiLaplaceSmootherT: which part of a step is taken. NORMAL takes cotangent weights, the others equal ones."]
pub type om_component = ::core::ffi::c_uint;
pub const OM_C0: om_continuity = 0;
pub const OM_C1: om_continuity = 1;
#[doc = " JacobiLaplaceSmootherT: the umbrella (C0) or its square (C1)."]
pub type om_continuity = ::core::ffi::c_uint;
unsafe extern "C" {
    #[doc = " What the last call on this thread failed with. Never NULL; valid until the next call."]
    pub fn om_last_error() -> *const ::core::ffi::c_char;
}
unsafe extern "C" {
    #[doc = " `3 * vertices` coordinates, `3 * faces` indices."]
    pub fn om_mesh_build(
        scalar: u32,
        positions: *const f64,
        vertices: usize,
        triangles: *const u32,
        faces: usize,
    ) -> *mut om_mesh;
}
unsafe extern "C" {
    #[doc = " Any format that OpenMesh reads, by the file's ending."]
    pub fn om_mesh_read(scalar: u32, path: *const ::core::ffi::c_char) -> *mut om_mesh;
}
unsafe extern "C" {
    pub fn om_mesh_write(mesh: *const om_mesh, path: *const ::core::ffi::c_char) -> bool;
}
unsafe extern "C" {
    #[doc = " NULL is allowed."]
    pub fn om_mesh_free(mesh: *mut om_mesh);
}
unsafe extern "C" {
    #[doc = " Elements, deleted ones included."]
    pub fn om_mesh_count(mesh: *const om_mesh, element: u32) -> usize;
}
unsafe extern "C" {
    pub fn om_mesh_positions(mesh: *const om_mesh, out: *mut f64);
}
unsafe extern "C" {
    pub fn om_mesh_set_positions(mesh: *mut om_mesh, positions: *const f64);
}
unsafe extern "C" {
    #[doc = " Three indices per face."]
    pub fn om_mesh_triangles(mesh: *const om_mesh, out: *mut u32);
}
unsafe extern "C" {
    #[doc = " The edge between two vertices, SIZE_MAX if there is none."]
    pub fn om_mesh_edge(mesh: *const om_mesh, a: usize, b: usize) -> usize;
}
unsafe extern "C" {
    pub fn om_mesh_status(mesh: *const om_mesh, element: u32, index: usize, flag: u32) -> bool;
}
unsafe extern "C" {
    #[doc = " OM_DELETED cannot be set here."]
    pub fn om_mesh_set_status(mesh: *mut om_mesh, element: u32, index: usize, flag: u32, value: bool);
}
unsafe extern "C" {
    #[doc = " Computes face and vertex normals."]
    pub fn om_mesh_update_normals(mesh: *mut om_mesh);
}
unsafe extern "C" {
    #[doc = " Vertex normals, as they are stored."]
    pub fn om_mesh_normals(mesh: *const om_mesh, out: *mut f64);
}
unsafe extern "C" {
    #[doc = " JacobiLaplaceSmootherT: selected vertices move, or all where none is selected; not those of the boundary, nor locked\n ones; with `skip_features` not those of features either."]
    pub fn om_mesh_smooth(
        mesh: *mut om_mesh,
        component: u32,
        continuity: u32,
        iterations: u32,
        skip_features: bool,
    ) -> bool;
}
