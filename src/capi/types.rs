//! The structs of the header. Fields of enumerations are plain integers: what comes in is checked.

use core::ffi::{c_char, c_void};

pub use super::records::*;
pub use super::versioned::Versioned;

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

/// Indices to be read: one at every `stride` bytes, or three side by side where triangles are meant.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_indices {
    /// The first index. May be NULL only if `count` is 0.
    pub data: *const u32,
    /// How many indices, or triangles.
    pub count: usize,
    /// Bytes from one index, or triangle, to the next, a multiple of 4; 0: nothing between.
    pub stride: usize,
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
    /// Zero.
    pub reserved: u32,
    /// The vertices, in any unit of length.
    pub positions: fairmesh_points,
    /// The triangles, counter-clockwise seen from the side that normals point to. Indices count from 0.
    pub triangles: fairmesh_indices,
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

/// Where the normals at the boundary of the region come from.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_normals_kind {
    /// Fitted to second order to the surface outside the region; where there is no outside, the region's average.
    Fitted = 0,
    /// The average of the triangles outside the region.
    Averaged = 1,
    /// Given, for some or all boundary vertices; fitted for the others.
    Given = 2,
}

/// Unit normals at the boundary vertices. All zero: fitted.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_normals {
    /// A `fairmesh_normals_kind`.
    pub kind: u32,
    /// Zero.
    pub reserved: u32,
    /// Given normals: unit vectors, pointing to the side that triangles are counter-clockwise seen from.
    pub vectors: fairmesh_points,
    /// The vertex of each vector. NULL (with count 0): there is one vector per vertex of the mesh, and 0 0 0 says that
    /// none is given. Vectors at vertices that are not on the boundary are ignored.
    pub vertices: fairmesh_indices,
}

/// Normals of fixed vertices inside the region that have none given.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_interior_normals {
    /// Those of the surface itself: it passes the vertices smoothly.
    Smooth = 0,
    /// The average of their triangles in the input.
    Input = 1,
}

/// What the Laplacian of the mean curvature H has to be.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_target_kind {
    /// Zero: spheres, cylinders and all surfaces of constant mean curvature are kept.
    Harmonic = 0,
    /// The constant, in 1 / length^3: a positive one pushes the surface out along its normals.
    Constant = 1,
    /// -2 H (H^2 - K): minimal total curvature.
    MinimalEnergy = 2,
}

/// The right-hand side of the equation. All zero: harmonic.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_target {
    /// A `fairmesh_target_kind`.
    pub kind: u32,
    /// Zero.
    pub reserved: u32,
    /// Of `FAIRMESH_TARGET_KIND_CONSTANT`; otherwise not read. Finite.
    pub constant: f64,
}

/// How vertices are distributed within the surface.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_inner_fairness {
    /// Equal weights: a regular distribution.
    Uniform = 0,
    /// Cotangents of the input: least distortion of the input's triangles.
    Conformal = 1,
    /// Mean-value weights of the input: near conformal, and positive for any input.
    Convex = 2,
}

/// How normals and mean curvature are discretized.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_discretization {
    /// Second order on irregular meshes.
    SecondOrder = 0,
    /// That of Schneider and Kobbelt (2001).
    Paper = 1,
}

/// How the equations are solved.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_solver_kind {
    /// Quasi-Newton steps on both equations together.
    Fast = 0,
    /// The scheme of Schneider and Kobbelt (2001): slow, a yardstick. Not for `fairmesh_solver_new`.
    Paper = 1,
}

/// How the paper's scheme estimates the mean curvature before the vertices are updated.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_estimate {
    /// By turns one Gauss-Seidel iteration and some of conjugate gradients.
    Alternating = 0,
    /// Gauss-Seidel.
    GaussSeidel = 1,
    /// Conjugate gradients.
    ConjugateGradients = 2,
}

/// How far a run is.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_progress {
    /// `sizeof(fairmesh_progress)` of the library: what is behind it does not exist.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// Between 0 and 1, never falling.
    pub fraction: f64,
    /// Nonlinear iterations so far.
    pub iterations: u64,
    /// The last step norm, in diagonals of the region; NaN before the first iteration.
    pub step: f64,
    /// What is being done, in a word or two; English. Valid during the callback.
    pub stage: *const c_char,
}

/// Called after every iteration, on the thread that made the call. 0 goes on, anything else stops. It may not throw or
/// `longjmp`. It may use other handles; its own solver answers BUSY.
pub type fairmesh_progress_fn =
    Option<unsafe extern "C" fn(progress: *const fairmesh_progress, user_data: *mut c_void) -> i32>;

/// What is asked. Fill it by `fairmesh_options_init`, then change fields: every default exists once, in the library.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_options {
    /// `sizeof(fairmesh_options)`.
    pub struct_size: u32,
    /// A `fairmesh_inner_fairness`. Default: uniform.
    pub inner_fairness: u32,
    /// Boundary normals. Default: fitted.
    pub normals: fairmesh_normals,
    /// What Delta_B H has to be. Default: 0.
    pub target: fairmesh_target,
    /// A `fairmesh_interior_normals`. Default: smooth.
    pub interior_normals: u32,
    /// A `fairmesh_discretization`. Default: second order.
    pub discretization: u32,
    /// A `fairmesh_solver_kind`. Default: fast.
    pub solver: u32,
    /// Worker threads, at most 1024; 0 (default): as many as the machine has. Any number gives the same bits.
    pub threads: u32,
    /// Stop when the step norm (rms normal step + rms tangential step, over the diagonal of the region's bounding
    /// box) is below this. Default 1e-8; 1e-6 is enough for interactive use. Greater than 0, less than 1.
    pub tolerance: f64,
    /// At most this many nonlinear iterations. Default 500. At least 1.
    pub max_iterations: u64,
    /// Told of the progress; may be NULL, the default.
    pub progress: fairmesh_progress_fn,
    /// Handed to `progress`.
    pub user_data: *mut c_void,
    /// A `fairmesh_estimate`. This and what follows: for `FAIRMESH_SOLVER_KIND_PAPER` only. Default: alternating.
    pub paper_estimate: u32,
    /// Iterations of the estimate. Default 10. At least 1.
    pub paper_estimate_iterations: u32,
    /// The part of each normal step that is taken. Default 0.9. Greater than 0, at most 1.
    pub paper_damping: f64,
    /// Levels of the hierarchy; 1: none; 0 (default): as many as make each level four times as large.
    pub paper_levels: u64,
    /// Vertices of the base mesh; 0 (default): two and a half times the boundary.
    pub paper_base: u64,
    /// Stop when `defect` of the report is at most this. Default 1e-6. Greater than 0.
    pub paper_defect: f64,
    /// And when max |Delta_B H| times the cube of the diagonal is at most this. Default: infinite. Greater than 0.
    pub paper_laplacian: f64,
    /// At most this many updates on all levels. Default 20000. At least 1.
    pub paper_max_updates: u64,
}

/// What hole filling does. Fill it by `fairmesh_fill_options_init`. How patches are faired is in a `fairmesh_options`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_fill_options {
    /// `sizeof(fairmesh_fill_options)`.
    pub struct_size: u32,
    /// Not 0 (default): patches are faired.
    pub fair: u32,
    /// Holes of more edges stay open. Default: UINT64_MAX.
    pub max_edges: u64,
    /// These loops only, as `fairmesh_boundary_loops` numbers them, outer boundaries included; NULL with count 0 (default): all
    /// holes. With a count, `max_edges` is not read.
    pub loops: fairmesh_indices,
    /// How dense the new vertices are. At the square root of 2, the default, edges are as long as those beside the boundary; at
    /// twice that, half as long. Between 0.1 and 10.
    pub density: f64,
    /// At most this many new vertices in all. Default 200000. No loop of n edges gets more than 1000 + n^2 of them, times
    /// the square of a density above 1.
    pub max_new_vertices: u64,
}

/// What remeshing does. Fill it by `fairmesh_remesh_options_init`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_remesh_options {
    /// `sizeof(fairmesh_remesh_options)`.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// As in `fairmesh_fill_options`: at the default, edges are as long as those beside the region.
    pub density: f64,
    /// At most this many vertices inside the region. Default 200000.
    pub max_vertices: u64,
}

/// A fairing in steps. One thread at a time; a second one is answered BUSY.
pub struct fairmesh_solver {
    _opaque: [u8; 0],
}

/// Something that was computed. It never changes, and any number of threads may read it at once.
pub struct fairmesh_result {
    _opaque: [u8; 0],
}
