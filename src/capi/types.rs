//! The structs of the header. Fields of enumerations are plain integers: what comes in is checked.

use std::ffi::c_void;

use super::choices::choice_of;
pub use super::hole_records::*;
pub use super::numbers::*;
pub use super::records::*;

/// The kind of numbers in an array.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_scalar {
    /// `float`.
    Float32 = 1,
    /// `double`.
    Float64 = 2,
}

/// Points or vectors to be read: x, y, z, three numbers side by side at every `stride` bytes.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_points {
    /// The first x, aligned as its type. May be NULL only if `count` is 0.
    pub data: *const c_void,
    /// How many points.
    pub count: usize,
    /// Bytes from one point to the next, a multiple of the number's size; 0: three numbers, nothing between.
    pub stride: usize,
    /// A `fairmesh_scalar`.
    pub scalar: u32,
    /// Zero.
    pub reserved: u32,
}

/// Numbers to be read, one at every `stride` bytes.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_numbers {
    /// The first number, aligned as its type. May be NULL only if `count` is 0.
    pub data: *const c_void,
    /// How many numbers.
    pub count: usize,
    /// Bytes from one number to the next, a multiple of the number's size; 0: nothing between.
    pub stride: usize,
    /// A `fairmesh_scalar`.
    pub scalar: u32,
    /// Zero.
    pub reserved: u32,
}

/// Nothing, of doubles.
macro_rules! nothing_by_default {
    ($($view:ident)*) => { $(
        impl Default for $view {
            fn default() -> Self {
                Self {
                    data: core::ptr::null(),
                    count: 0,
                    stride: 0,
                    scalar: fairmesh_scalar::Float64 as u32,
                    reserved: 0,
                }
            }
        }
    )* };
}
nothing_by_default! { fairmesh_points fairmesh_numbers }

/// Points or vectors to be written, as `fairmesh_points`. What lies between them is not touched.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_points_out {
    /// The first x, aligned as its type. May be NULL only if `count` is 0.
    pub data: *mut c_void,
    /// How many points there is room for.
    pub count: usize,
    /// Bytes from one point to the next, a multiple of the number's size; 0: three numbers, nothing between.
    pub stride: usize,
    /// A `fairmesh_scalar`.
    pub scalar: u32,
    /// Zero.
    pub reserved: u32,
}

/// One number per vertex to be written.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_scalars_out {
    /// The first number, aligned as its type. May be NULL only if `count` is 0.
    pub data: *mut c_void,
    /// How many numbers there is room for.
    pub count: usize,
    /// Bytes from one number to the next, a multiple of the number's size; 0: nothing between.
    pub stride: usize,
    /// A `fairmesh_scalar`.
    pub scalar: u32,
    /// Zero.
    pub reserved: u32,
}

/// Indices to be read: one at every `stride` bytes, or three side by side where triangles are meant, two where pairs are.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_indices {
    /// The first index. May be NULL only if `count` is 0.
    pub data: *const u32,
    /// How many indices, or triangles, or pairs.
    pub count: usize,
    /// Bytes from one index, or triangle, to the next, a multiple of 4; 0: nothing between.
    pub stride: usize,
}

impl Default for fairmesh_indices {
    fn default() -> Self {
        Self {
            data: core::ptr::null(),
            count: 0,
            stride: 0,
        }
    }
}

/// Triangles to be written: three indices at every `stride` bytes.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_indices_out {
    /// The first index. May be NULL only if `count` is 0.
    pub data: *mut u32,
    /// How many triangles there is room for.
    pub count: usize,
    /// Bytes from one triangle to the next, a multiple of 4; 0: nothing between.
    pub stride: usize,
}

/// A triangle mesh. Set `struct_size` and the two arrays, all else to zero.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_mesh {
    /// `sizeof(fairmesh_mesh)`.
    pub struct_size: u32,
    /// A `fairmesh_coincident`: whether vertices at the same place are one vertex of the surface. Zero: they are. Then all copies
    /// of a free vertex move alike. A list of vertices names a vertex by any of its copies; a mask frees it where it frees all.
    pub coincident: u32,
    /// The vertices, in any unit of length.
    pub positions: fairmesh_points,
    /// The triangles, counter-clockwise seen from the side that normals point to. Indices count from 0.
    pub triangles: fairmesh_indices,
    /// Vertices are at the same place up to this distance, in the unit of the positions. Zero: where their coordinates are equal.
    /// Not negative, and well below the edge lengths.
    pub coincident_within: f64,
}

/// What `fairmesh_selection` holds.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_selection_kind {
    /// Nothing: free are all vertices that are not on the boundary of the mesh. `data` is NULL, `count` and `stride` 0.
    Interior = 0,
    /// `uint8_t`, one per vertex: not zero is free.
    FreeMask = 1,
    /// `uint8_t`, one per vertex: not zero is fixed.
    FixedMask = 2,
    /// `uint32_t`: the free vertices, in any order.
    FreeVertices = 3,
    /// `uint32_t`: triangles. Free are the vertices that have no other triangles and are not on the boundary of the mesh.
    Faces = 4,
}

/// Which vertices may move. All others stay, to the last bit.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_selection {
    /// `sizeof(fairmesh_selection)`.
    pub struct_size: u32,
    /// A `fairmesh_selection_kind`.
    pub kind: u32,
    /// The first entry, of the type that the kind says.
    pub data: *const c_void,
    /// How many entries. Of a mask as many as vertices.
    pub count: usize,
    /// Bytes from one entry to the next; 0: nothing between.
    pub stride: usize,
}

/// Unit normals at the boundary vertices. All zero: fitted.
#[repr(C)]
#[derive(Clone, Copy, Default)]
pub struct fairmesh_boundary_normals {
    /// A `fairmesh_boundary_normals_kind`.
    pub kind: u32,
    /// Zero.
    pub reserved: u32,
    /// Given normals: unit vectors, pointing to the side that triangles are counter-clockwise seen from.
    pub vectors: fairmesh_points,
    /// The vertex of each vector. NULL (with count 0): there is one vector per vertex of the mesh, and 0 0 0 says that
    /// none is given. Vectors at vertices that are not on the boundary are ignored.
    pub vertices: fairmesh_indices,
}

/// Where the mean curvature comes from that the surface is to continue.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_boundary_curvature_kind {
    /// Fitted to the surface outside the region.
    Estimated = 0,
    /// Given, for some or all boundary vertices; fitted for the others.
    Given = 1,
}

/// Mean curvature at the boundary vertices. All zero: fitted.
#[repr(C)]
#[derive(Clone, Copy, Default)]
pub struct fairmesh_boundary_curvature {
    /// A `fairmesh_boundary_curvature_kind`.
    pub kind: u32,
    /// Zero.
    pub reserved: u32,
    /// Given mean curvatures, in 1 / length; negative on a sphere with outward normals.
    pub values: fairmesh_numbers,
    /// The vertex of each number, which is finite then. NULL (with count 0): there is one number per vertex of the mesh, and NaN
    /// says that none is given. Numbers at vertices that are not on the boundary are ignored.
    pub vertices: fairmesh_indices,
}

/// How far curvature is continued along single boundary loops. All zero: along all loops alike.
#[repr(C)]
#[derive(Clone, Copy, Default)]
pub struct fairmesh_loop_continuity {
    /// From 0 (tangent planes alone) to 1 (curvature) each.
    pub values: fairmesh_numbers,
    /// For each number a vertex of the loop that it holds for. Of several numbers for one loop the last one holds.
    pub vertices: fairmesh_indices,
}

/// The right-hand side of the equation. All zero: harmonic.
#[repr(C)]
#[derive(Clone, Copy, Default)]
pub struct fairmesh_target {
    /// A `fairmesh_target_kind`.
    pub kind: u32,
    /// Zero.
    pub reserved: u32,
    /// Of `FAIRMESH_TARGET_KIND_CONSTANT`; otherwise not read. Finite.
    pub constant: f64,
}

/// A fairing in steps. One thread at a time; a second one is answered BUSY.
pub struct fairmesh_solver {
    _opaque: [u8; 0],
}

/// Something that was computed. It never changes, and any number of threads may read it at once.
pub struct fairmesh_result {
    _opaque: [u8; 0],
}

choice_of!(fairmesh_selection_kind: Interior FreeMask FixedMask FreeVertices Faces);
choice_of!(fairmesh_boundary_normals_kind: Fitted Averaged Given);
choice_of!(fairmesh_boundary_curvature_kind: Estimated Given);
