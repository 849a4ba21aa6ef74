//! The structs of the header. Fields of enumerations are plain integers: what comes in is checked.

use core::ffi::{c_char, c_void};

use super::status::{FAIRMESH_NO_ELEMENT, fairmesh_error};

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
    /// Nothing: free are all vertices that are not on the border of the mesh. `data` is NULL, `count` and `stride` 0.
    Interior = 0,
    /// `uint8_t`, one per vertex: not zero is free.
    FreeMask = 1,
    /// `uint8_t`, one per vertex: not zero is fixed.
    FixedMask = 2,
    /// `uint32_t`: the free vertices, in any order.
    FreeVertices = 3,
    /// `uint32_t`: triangles. Free are the vertices that have no other triangles and are not on the border of the mesh.
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

/// Where the normals at the border of the region come from.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_normals_kind {
    /// Fitted to second order to the surface outside the region; where there is no outside, the region's average.
    Fitted = 0,
    /// The average of the triangles outside the region.
    Averaged = 1,
    /// Given, for some or all border vertices; fitted for the others.
    Given = 2,
}

/// Unit normals at the border vertices. All zero: fitted.
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
    /// none is given. Vectors at vertices that are not on the border are ignored.
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
    /// Border normals. Default: fitted.
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
    /// Vertices of the base mesh; 0 (default): two and a half times the border.
    pub paper_base: u64,
    /// Stop when `defect` of the report is at most this. Default 1e-6. Greater than 0.
    pub paper_defect: f64,
    /// And when max |Delta_B H| times the cube of the diagonal is at most this. Default: infinite. Greater than 0.
    pub paper_laplacian: f64,
    /// At most this many updates on all levels. Default 20000. At least 1.
    pub paper_max_updates: u64,
}

/// How a run ended that did what it was asked. Numbers are never reused. The positions are usable in every case.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_outcome {
    /// Tolerance met, and the surface is sound: the only case without reservation.
    Converged = 0,
    /// Tolerance met, but triangles are flipped or have an angle below one degree (list POOR_TRIANGLES).
    ConvergedPoorTriangles = 1,
    /// A sound surface with a reservation, told in `reason`.
    ConvergedLoosely = 2,
    /// No surface with these border normals was found; the surface of the linear problem is returned. `reached` of the
    /// way was possible; the normals farthest away are in the list UNREACHED_VERTICES.
    NormalsNotReachable = 3,
    /// A surface was found for the part `reached` of the target only; that of the linear problem is returned.
    TargetNotReachable = 4,
    /// No sound surface was found; that of the linear problem is returned.
    NotConverged = 5,
    /// The iterations ran out; the best surface so far is returned.
    IterationLimit = 6,
    /// The callback stopped the run; the best surface so far is returned.
    Cancelled = 7,
    /// An outcome that this version of the header does not know.
    Other = 255,
}

/// How it went. Set `struct_size` before the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_report {
    /// `sizeof(fairmesh_report)`.
    pub struct_size: u32,
    /// A `fairmesh_outcome`.
    pub outcome: u32,
    /// Nonlinear iterations.
    pub iterations: u64,
    /// Defect of the equation: max_i |sum_j w_ij (H_i - H_j) + (2 A_i / 3) rhs_i| / sum_j |w_ij|, times the diagonal.
    pub defect: f64,
    /// The last step norm, in diagonals; NaN if there was none.
    pub step: f64,
    /// The diagonal of the region's bounding box, in the unit of the positions.
    pub diagonal: f64,
    /// How much of the border normals or the target was reached, 0 to 1; 1 where all of it.
    pub reached: f64,
    /// Free vertices.
    pub free_vertices: u64,
    /// Not 0: the surface is that of the linear problem.
    pub linear_surface: u32,
    /// Levels of the paper's scheme; 0 for the fast solver.
    pub level_count: u32,
    /// Free vertices that took fallback weights of inner fairness.
    pub fallback_weights: u64,
    /// Sizes of the lists POOR_TRIANGLES, FLIPPED_TRIANGLES, NEEDLES, SUSPICIOUS_NORMALS, UNREACHED_VERTICES.
    pub poor_triangle_count: u64,
    /// See above.
    pub flipped_count: u64,
    /// See above.
    pub needle_count: u64,
    /// See above.
    pub suspicious_normal_count: u64,
    /// See above.
    pub unreached_vertex_count: u64,
    /// The smallest angle of a triangle of the region, in degrees, and the triangle.
    pub worst_angle: f64,
    /// See above.
    pub worst_triangle: u64,
    /// The smallest and largest mean curvature at free vertices, in 1 / length; negative on a sphere.
    pub h_inside: [f64; 2],
    /// The same at border vertices.
    pub h_border: [f64; 2],
    /// The largest angle, in degrees, between a border normal and the triangles of the region there, and the vertex.
    pub normal_deviation: f64,
    /// See above.
    pub normal_deviation_vertex: u64,
    /// The root mean square of those angles.
    pub normal_deviation_rms: f64,
    /// Wall seconds: half-edges and normals.
    pub seconds_setup: f64,
    /// The start surface.
    pub seconds_start: f64,
    /// The iterations.
    pub seconds_iterate: f64,
    /// The figures.
    pub seconds_quality: f64,
    /// All of it.
    pub seconds_total: f64,
    /// What `FAIRMESH_OUTCOME_CONVERGED_LOOSELY` is about; otherwise empty. English, UTF-8.
    pub reason: [c_char; 160],
}

/// What was done on one level of the paper's scheme. Set `struct_size` before the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_level {
    /// `sizeof(fairmesh_level)`.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// Vertices of the region: free and border.
    pub vertices: u64,
    /// Triangles of the region.
    pub triangles: u64,
    /// Updates of the mesh.
    pub updates: u64,
    /// The defect at the end.
    pub defect: f64,
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
    /// These loops only, as `fairmesh_border_loops` numbers them, outer borders included; NULL with count 0 (default): all
    /// holes. With a count, `max_edges` is not read.
    pub loops: fairmesh_indices,
    /// How dense the new vertices are. At the square root of 2, the default, edges are as long as those beside the rim; at
    /// twice that, half as long. Between 0.1 and 10.
    pub density: f64,
    /// At most this many new vertices. Default 200000.
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

/// What kind of gap a border loop is.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_loop_kind {
    /// A gap in the surface.
    Hole = 0,
    /// The outline of an open surface. Filled only if it is named.
    OuterBorder = 1,
    /// It meets a bad edge, (`edge_a`, `edge_b`). Never filled.
    NonManifold = 2,
    /// A kind that this version of the header does not know.
    Other = 255,
}

/// A border loop. Set `struct_size` before the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_loop {
    /// `sizeof(fairmesh_loop)`.
    pub struct_size: u32,
    /// A `fairmesh_loop_kind`.
    pub kind: u32,
    /// Size of the list LOOP_VERTICES.
    pub vertex_count: u64,
    /// Size of the list LOOP_TOUCHING.
    pub touching_count: u64,
    /// The sum of the edge lengths.
    pub length: f64,
    /// The length of the vector area.
    pub area: f64,
    /// The mean angle, in degrees, by which a smooth surface over the loop has to turn back: 0 for a hole in a plane, 90 for
    /// the end of a tube, 180 for the outline of a plane sheet.
    pub turn: f64,
    /// The bad edge of a non-manifold loop, otherwise UINT32_MAX.
    pub edge_a: u32,
    /// Its other end.
    pub edge_b: u32,
}

/// How the filling of a loop ended. Numbers are never reused.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_fill_outcome {
    /// Filled with a faired surface; its report says with which reservations.
    Faired = 0,
    /// Filled with the surface of the linear problem, or the best one when the iterations ran out.
    Linear = 1,
    /// Filled with the triangulation, refined, but not faired; `reason` says why.
    Flat = 2,
    /// Left as it was; `reason` says why.
    LeftOpen = 3,
    /// An outcome that this version of the header does not know.
    Other = 255,
}

/// Why a patch is flat or a loop open. Numbers are never reused.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_fill_reason {
    /// There is nothing to say.
    None = 0,
    /// Open: the loop runs into a bad edge.
    NonManifold = 1,
    /// Open: the loop encloses the mesh and was not named.
    OuterBorder = 2,
    /// Open: the loop has more than `max_edges`.
    TooManyEdges = 3,
    /// Open: every triangulation has an edge or triangle that the mesh has already.
    NoTriangulation = 4,
    /// Open: a vertex is NaN or infinite, or all are the same point.
    NotFinite = 5,
    /// Open: the callback stopped the run before.
    Cancelled = 6,
    /// Flat: `fair` was 0.
    NotAsked = 32,
    /// Flat: the patch has no inner vertex.
    NoInnerVertex = 33,
    /// Flat: the fairing was refused with `refused_status`.
    Refused = 34,
    /// Flat: the fairing found no sound surface; the report says how.
    Unsound = 35,
    /// A reason that this version of the header does not know.
    Other = 255,
}

/// What became of a loop. Set `struct_size` before the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_fill_report {
    /// `sizeof(fairmesh_fill_report)`.
    pub struct_size: u32,
    /// A `fairmesh_fill_outcome`.
    pub outcome: u32,
    /// A `fairmesh_fill_reason`.
    pub reason: u32,
    /// The `fairmesh_status` that the fairing was refused with, or OK.
    pub refused_status: i32,
    /// The loop, as `fairmesh_border_loops` numbers it.
    pub loop_index: u64,
    /// Its edges.
    pub edge_count: u64,
    /// The first new vertex, and how many. Indices of the filled mesh.
    pub first_vertex: u64,
    /// See above.
    pub vertex_count: u64,
    /// The first new triangle, and how many.
    pub first_triangle: u64,
    /// See above.
    pub triangle_count: u64,
    /// The smallest angle of the new triangles, in degrees.
    pub worst_angle: f64,
    /// New vertices that lie far outside the loop's bounding box: size of the list OUTSIDE_VERTICES.
    pub outside_count: u64,
    /// Not 0: `max_new_vertices` made the patch coarser.
    pub coarsened: u32,
    /// Not 0: there is a report of the fairing, see `fairmesh_result_report`.
    pub has_report: u32,
    /// Wall seconds.
    pub seconds: f64,
}

/// What a result is of.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_result_kind {
    /// A faired mesh.
    Faired = 0,
    /// Border loops.
    Loops = 1,
    /// A mesh with filled holes.
    Filled = 2,
    /// A mesh with a new triangulation of a region.
    Remeshed = 3,
}

/// The sizes of a result. Set `struct_size` before the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_info {
    /// `sizeof(fairmesh_result_info)`.
    pub struct_size: u32,
    /// A `fairmesh_result_kind`.
    pub kind: u32,
    /// Vertices of the mesh; 0 for loops.
    pub vertex_count: u64,
    /// Triangles of the mesh; 0 for loops, and where they are those given.
    pub triangle_count: u64,
    /// The last so many of the vertices are new.
    pub new_vertex_count: u64,
    /// The last so many of the triangles are new.
    pub new_triangle_count: u64,
    /// Loops found, or filled.
    pub loop_count: u64,
    /// Border vertices with their normals, see FAIRMESH_VECTORS_BORDER_NORMALS.
    pub border_vertex_count: u64,
}

/// Lists of indices in a result. The first block is of faired meshes, and of loops of filled ones.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_list {
    /// Triangles that are flipped or have an angle below one degree, where the outcome is about them.
    PoorTriangles = 0,
    /// Triangles whose normal points away from those of their vertices.
    FlippedTriangles = 1,
    /// Triangles with an angle below one degree.
    Needles = 2,
    /// Border vertices whose normal contradicts the surface or its neighbours'.
    SuspiciousNormals = 3,
    /// Border vertices whose normals stood farthest away, worst first.
    UnreachedVertices = 4,
    /// Faired meshes: the border vertices, ascending.
    BorderVertices = 16,
    /// Loops: the vertices in the direction of triangles that fill it.
    LoopVertices = 32,
    /// Loops: vertices that belong to another loop, too.
    LoopTouching = 33,
    /// Filled meshes: new vertices of the loop far outside its bounding box.
    OutsideVertices = 48,
    /// Filled and remeshed meshes: per new vertex three vertices of the mesh given that it comes from.
    Parents = 49,
    /// Remeshed meshes: the free vertices.
    FreeVertices = 64,
    /// Remeshed meshes: per vertex that is left its number before.
    KeptVertices = 65,
    /// Remeshed meshes: per triangle that is left its number before.
    KeptTriangles = 66,
}

/// Vectors in a result.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_vectors {
    /// Faired meshes: the unit normals that were used at the border, in the order of the list BORDER_VERTICES.
    BorderNormals = 0,
    /// Filled and remeshed meshes: per new vertex the weights of its three parents; their sum is 1.
    ParentWeights = 1,
}

/// Numbers per vertex in a result.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_scalars {
    /// Mean curvature, in 1 / length: negative on a sphere with outward normals. NaN where no vertex is free.
    MeanCurvature = 0,
    /// Gaussian curvature, in 1 / length^2. NaN where no vertex is free.
    GaussianCurvature = 1,
}

/// A fairing in steps. One thread at a time; a second one is answered BUSY.
pub struct fairmesh_solver {
    _opaque: [u8; 0],
}

/// Something that was computed. It never changes, and any number of threads may read it at once.
pub struct fairmesh_result {
    _opaque: [u8; 0],
}

/// A struct that begins with its size.
///
/// # Safety
/// `repr(C)`, the first field the `u32` of its size, every bit pattern a value.
pub unsafe trait Versioned: Copy {
    /// Its size in the first version that had it.
    const FIRST: usize;
}

macro_rules! versioned {
    ($($name:ident $first:expr),* $(,)?) => { $(
        // SAFETY: see the definition: integers, floats, pointers, and functions that may be NULL.
        unsafe impl Versioned for $name { const FIRST: usize = $first; }
    )* };
}

const WORD: usize = size_of::<usize>();

versioned! {
    fairmesh_mesh 16 + 6 * WORD,
    fairmesh_selection 8 + 3 * WORD,
    fairmesh_options size_of::<fairmesh_options>(),
    fairmesh_report size_of::<fairmesh_report>(),
    fairmesh_level 40,
    fairmesh_fill_options size_of::<fairmesh_fill_options>(),
    fairmesh_remesh_options 24,
    fairmesh_loop 56,
    fairmesh_fill_report 96,
    fairmesh_info 56,
}

const _: () = {
    assert!(size_of::<fairmesh_error>() == 256);
    assert!(FAIRMESH_NO_ELEMENT == u64::MAX);
    assert!(size_of::<fairmesh_mesh>() == fairmesh_mesh::FIRST);
    assert!(size_of::<fairmesh_level>() == 40 && size_of::<fairmesh_loop>() == 56);
    assert!(size_of::<fairmesh_fill_report>() == 96 && size_of::<fairmesh_info>() == 56);
};
