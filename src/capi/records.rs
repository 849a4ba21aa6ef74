//! The structs of the header that results are told in.

use core::ffi::c_char;

/// How it went. Where the region has several components, the whole has their worst outcome and largest figures. Set
/// `struct_size` before the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_report {
    /// `sizeof(fairmesh_report)`.
    pub struct_size: u32,
    /// A `fairmesh_outcome`.
    pub outcome: u32,
    /// A `fairmesh_loose_reason`: what the outcome CONVERGED_LOOSELY is about.
    pub loose_reason: u32,
    /// Not 0: the surface is that of least bending.
    pub least_bending: u32,
    /// Nonlinear iterations: the most of any component.
    pub iterations: u64,
    /// Defect of the equation: max_i |sum_j w_ij (H_i - H_j) + (2 A_i / 3) rhs_i| / sum_j |w_ij|, times the diagonal.
    pub defect: f64,
    /// The last step norm, in diagonals; NaN if there was none.
    pub step: f64,
    /// The diagonal of the bounding box, in the unit of the positions; the largest of any component.
    pub diagonal: f64,
    /// How much of the boundary normals or the target was reached, 0 to 1; 1 where all of it.
    pub reached: f64,
    /// Free vertices.
    pub free_vertices: u64,
    /// Free vertices that inner fairness does not spread as asked.
    pub fallback_weights: u64,
    /// Size of the list POOR_TRIANGLES.
    pub poor_triangle_count: u64,
    /// Size of the list FLIPPED_TRIANGLES.
    pub flipped_count: u64,
    /// Size of the list NEEDLES.
    pub needle_count: u64,
    /// Size of the list SUSPICIOUS_NORMALS.
    pub suspicious_normal_count: u64,
    /// The smallest angle of a triangle of the region, in degrees.
    pub worst_angle: f64,
    /// The triangle that has it.
    pub worst_triangle: u64,
    /// The largest angle, in degrees, between two triangles side by side of which one has a free vertex.
    pub sharpest_edge: f64,
    /// The vertex at one end of their edge,
    pub sharpest_edge_from: u64,
    /// and at the other.
    pub sharpest_edge_to: u64,
    /// The smallest and largest mean curvature at free vertices, in 1 / length; negative on a sphere.
    pub h_inside: [f64; 2],
    /// The same at boundary vertices.
    pub h_boundary: [f64; 2],
    /// The largest angle, in degrees, between a boundary normal and the triangles of the region there.
    pub normal_deviation: f64,
    /// The vertex that has it.
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
    /// Pairs of intersecting triangles: the list INTERSECTIONS has two entries for each. The search ends at 10000.
    pub intersection_count: u64,
    /// How many pairs there were in the input among the same triangles and the rest of the mesh; 0 if there are none now.
    pub intersections_in_input: u64,
    /// Not 0: intersections were looked for, which is not done if the options say so or if the run was held up.
    pub intersections_checked: u32,
    /// Zero.
    pub reserved: u32,
    /// The largest kink, in degrees: the angle at a boundary vertex between the mean normals of the triangles of the region and
    /// of those outside, or where nothing is outside, the boundary normal.
    pub boundary_kink: f64,
    /// The same in the input, at the same vertex.
    pub boundary_kink_before: f64,
    /// The vertex that has it; of a surface with a BOUNDARY_CREASE, the worst one of the crease.
    pub boundary_kink_vertex: u64,
    /// Size of the list CREASED_VERTICES.
    pub creased_vertex_count: u64,
    /// Components of the region, at least one; see `fairmesh_result_component`, `fairmesh_solver_component`.
    pub component_count: u64,
    /// Of NEAREST_MEMBER the w of its equation Delta_B H = -2 w H (H^2 - K), over 0 and at most 1, of several components the
    /// largest; otherwise 0.
    pub member_weight: f64,
    /// Bending energy, the integral of H^2 over the free vertices, without unit; the sum of all components.
    pub bending_energy: f64,
    /// Sharp edges that reach the boundary, where the options' `sharp` asks for them, see `fairmesh_result_sharp_edge`.
    pub sharp_edge_count: u64,
}

/// What came of one component of the region: free vertices that are connected by edges, or lie around a fixed vertex inside
/// the region whose normal is not given. Components are independent problems, each with the result that it has in a call
/// where it alone is selected, but that sharp edges and curvatures are looked for outside of all. Set `struct_size` before
/// the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_component {
    /// `sizeof(fairmesh_component)`.
    pub struct_size: u32,
    /// A `fairmesh_outcome`.
    pub outcome: u32,
    /// A `fairmesh_loose_reason`: what the outcome CONVERGED_LOOSELY is about.
    pub loose_reason: u32,
    /// Not 0: its surface is that of least bending.
    pub least_bending: u32,
    /// Its free vertex with the smallest index.
    pub vertex: u64,
    /// Its free vertices.
    pub free_vertices: u64,
    /// Nonlinear iterations.
    pub iterations: u64,
    /// Defect of the equation, times its diagonal.
    pub defect: f64,
    /// The last step norm, in its diagonals; NaN if there was none.
    pub step: f64,
    /// The diagonal of its bounding box, in the unit of the positions.
    pub diagonal: f64,
    /// How much of the boundary normals or the target was reached, 0 to 1; 1 where all of it.
    pub reached: f64,
    /// Its flipped triangles.
    pub flipped_count: u64,
    /// Its triangles with an angle below one degree.
    pub needle_count: u64,
    /// The smallest angle of its triangles, in degrees.
    pub worst_angle: f64,
    /// The triangle that has it.
    pub worst_triangle: u64,
    /// The largest angle, in degrees, between two triangles side by side of which one has a free vertex.
    pub sharpest_edge: f64,
    /// The vertex at one end of their edge,
    pub sharpest_edge_from: u64,
    /// and at the other.
    pub sharpest_edge_to: u64,
    /// The smallest and largest mean curvature at its free vertices, in 1 / length; negative on a sphere.
    pub h_inside: [f64; 2],
    /// The same at its boundary vertices.
    pub h_boundary: [f64; 2],
    /// The largest angle, in degrees, between a boundary normal and its triangles there.
    pub normal_deviation: f64,
    /// The vertex that has it.
    pub normal_deviation_vertex: u64,
    /// The root mean square of those angles.
    pub normal_deviation_rms: f64,
    /// Of NEAREST_MEMBER the w of its equation Delta_B H = -2 w H (H^2 - K), over 0 and at most 1; otherwise 0.
    pub member_weight: f64,
    /// Its bending energy, the integral of H^2 over its free vertices, without unit.
    pub bending_energy: f64,
    /// Attempts at its surface, see `fairmesh_result_attempt`.
    pub attempt_count: u64,
    /// Boundary loops whose curvature was to be continued, see `fairmesh_result_continuity`, `fairmesh_solver_continuity`; 0 where the
    /// options' `continuity` is 0, no loop has surroundings and vertices enough, or no surface was found to begin with.
    pub continuity_count: u64,
}

/// An attempt at the surface of a component. Those on the coarse mesh decide where the fine one begins; of two sound surfaces
/// there that differ the one of less bending energy is taken. Set `struct_size` before the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_attempt {
    /// `sizeof(fairmesh_attempt)`.
    pub struct_size: u32,
    /// A `fairmesh_attempt_end`.
    pub end: u32,
    /// The free vertices of its mesh: fewer than the component's on the coarse mesh.
    pub free_vertices: u64,
    /// Nonlinear iterations.
    pub iterations: u64,
    /// The bending energy of its surface, without unit; NaN where it has none.
    pub bending_energy: f64,
    /// What was tried, in a few words of English, ending with a NUL.
    pub name: [c_char; 48],
}

/// How far the surface continues the mean curvature of its surroundings along one boundary loop; curvatures in 1 / length. Set
/// `struct_size` before the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_continuity {
    /// `sizeof(fairmesh_continuity)`.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// The boundary vertex of the loop with the smallest index.
    pub vertex: u64,
    /// The vertices of the loop.
    pub vertex_count: u64,
    /// How much of the way to the curvature of the surroundings was asked for; FAIRMESH_CONTINUITY_AUTO: all of it, if it is certain.
    pub asked: f64,
    /// How much of the way from the tangent-continuous surface's mean curvature to that of the surroundings was taken, in the mean
    /// along the loop: from 0 to `continuity` of the options.
    pub reached: f64,
    /// The jump of the mean curvature at the loop of the tangent-continuous surface, root mean square.
    pub jump_before: f64,
    /// The largest such jump.
    pub largest_jump_before: f64,
    /// The jump of the mean curvature at the loop, root mean square.
    pub jump: f64,
    /// The largest jump.
    pub largest_jump: f64,
    /// The root mean square of the mean curvature of the surroundings along the loop.
    pub curvature: f64,
    /// How uncertain that is, root mean square. Where it is no smaller than `jump_before`, there is nothing to be continued; it is infinite
    /// where less than seven rings of triangles are outside to tell it by. Along loops whose jump is too small for
    /// `FAIRMESH_CONTINUITY_AUTO` it is what estimates differ by from each other.
    pub uncertainty: f64,
}

/// Ends of sharp edges that belong together, and what became of them. Set `struct_size` before the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_sharp_edge {
    /// `sizeof(fairmesh_sharp_edge)`.
    pub struct_size: u32,
    /// A `fairmesh_sharp_fate`.
    pub fate: u32,
    /// Its ends, one to three, see `fairmesh_result_crease_end`.
    pub end_count: u64,
    /// The vertices along it, from end to end, or from each end to the corner one after the other; 0 where it does not go on. They
    /// stand in the list SHARP_VERTICES,
    pub vertex_count: u64,
    /// from this place on.
    pub first_vertex: u64,
}

/// Where a sharp edge of the surroundings arrives at the boundary of the region. Set `struct_size` before the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_crease_end {
    /// `sizeof(fairmesh_crease_end)`.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// The boundary vertex at which it arrives.
    pub vertex: u64,
    /// The angle between the normals, in degrees: above 0 on a ridge, below on a groove.
    pub angle: f64,
    /// The standard error of the angle, in degrees.
    pub error: f64,
    /// Unit tangent, into the region.
    pub direction: [f64; 3],
    /// Unit normal of the surface left of it,
    pub normal_left: [f64; 3],
    /// and right of it.
    pub normal_right: [f64; 3],
}

/// What a result is of.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_result_kind {
    /// A faired mesh.
    Faired = 0,
    /// Boundary loops.
    Loops = 1,
    /// A mesh with filled holes.
    Filled = 2,
    /// A mesh with a new triangulation of a region.
    Remeshed = 3,
    /// Pairs of intersecting triangles.
    Intersections = 4,
    /// Groups of loops that would be joined.
    Joins = 5,
    /// A mesh without some of its triangles.
    Erased = 6,
    /// The components of a mesh.
    Components = 7,
    /// A mesh with a bridge.
    Bridged = 8,
    /// A mesh without the triangles that spoil the boundaries of holes.
    Trimmed = 9,
    /// Points on the triangles of a mesh.
    Carried = 10,
    /// Triangles chosen by place and shape.
    Region = 11,
    /// A mesh with blends in place of creases.
    Rounded = 12,
}

/// The sizes of a result. Set `struct_size` before the call.
#[repr(C)]
#[derive(Clone, Copy, Default)]
pub struct fairmesh_info {
    /// `sizeof(fairmesh_result_info)`.
    pub struct_size: u32,
    /// A `fairmesh_result_kind`.
    pub kind: u32,
    /// Vertices of the mesh; 0 for loops, and for groups of them.
    pub vertex_count: u64,
    /// Triangles of the mesh; 0 for loops and groups of them, and where they are those given.
    pub triangle_count: u64,
    /// The last so many of the vertices are new. Of carried points how many there are.
    pub new_vertex_count: u64,
    /// The last so many of the triangles are new.
    pub new_triangle_count: u64,
    /// Loops found, or filled (those that are joined count once), or left where triangles were erased; of
    /// joins the groups, of a bridged mesh the strip and the holes beside it.
    pub loop_count: u64,
    /// Boundary vertices with their normals, see FAIRMESH_VECTORS_BOUNDARY_NORMALS.
    pub boundary_vertex_count: u64,
    /// Of an erased mesh the triangles that were dropped besides those named, because they hung loose; of a trimmed one all that were
    /// taken away.
    pub dropped_count: u64,
    /// Of components how many there are.
    pub component_count: u64,
    /// Of an erased mesh the triangles that were dropped because they would spoil the boundary of a patch.
    pub cleaned_count: u64,
    /// Of a trimmed mesh the area of what was taken away.
    pub dropped_area: f64,
    /// Not 0: there is nothing to be said of the whole result: what was to be faired converged without reservation, holes that were to be
    /// filled are, and not all loops were passed over as outer boundaries; all that was to be rounded is.
    pub is_success: u32,
    /// Zero.
    pub reserved: u32,
    /// Of a rounded mesh its creases before, see `fairmesh_result_crease`.
    pub crease_count: u64,
    /// Of a rounded mesh: edges that bend by more than so many degrees were taken for creases.
    pub crease_angle: f64,
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
    /// Boundary vertices whose normal contradicts the surface or its neighbours'.
    SuspiciousNormals = 3,
    /// Intersecting triangles, two for each pair, the smaller number first; of a filled mesh those of the loop.
    Intersections = 5,
    /// Boundary vertices where the surface has a crease, where the outcome is about them.
    CreasedVertices = 6,
    /// The vertices along sharp edges, one edge after the other. Those that were free have been placed on them.
    SharpVertices = 7,
    /// Faired meshes: the boundary vertices, ascending. A vertex where components have different normals stands there with each.
    BoundaryVertices = 16,
    /// Loops: the vertices in the direction of triangles that fill it.
    LoopVertices = 32,
    /// Loops: vertices that belong to another loop, too.
    LoopTouching = 33,
    /// Filled meshes: new vertices of the loop far outside its bounding box.
    OutsideVertices = 48,
    /// Filled, bridged, remeshed and rounded meshes: per new vertex three vertices of the mesh given that it comes from. Carried points: per
    /// point the corners of the triangle that it is on.
    Parents = 49,
    /// Filled meshes: the loops that the patch is for, ascending. Joins: the loops of the group with this index, ascending.
    JoinedLoops = 50,
    /// Remeshed meshes: the free vertices. Rounded ones: those of the blends, without their rails.
    FreeVertices = 64,
    /// Remeshed and rounded meshes: per vertex that is left its number before.
    KeptVertices = 65,
    /// Remeshed, erased and trimmed meshes: per triangle that is left its number before. Rounded ones: per triangle outside the blends, which come
    /// last, that of the one that it is, or is a part of.
    KeptTriangles = 66,
    /// Erased meshes: the loops that the deleted triangles leave, as `fairmesh_boundary_loops` numbers those of the mesh that is left.
    ErasedLoops = 80,
    /// Components: per triangle the number of its component.
    TriangleComponents = 96,
    /// Bridged meshes: the vertices of the chain that the strip begins (0) or ends (1) at, in the direction in which its triangles run
    /// through them.
    BridgeChain = 112,
    /// Bridged meshes: the new vertices on one side of the strip (0: from the first chain to the second; 1: back).
    BridgeSide = 113,
    /// Carried points: per point the triangle that it is on.
    CarriedTriangles = 128,
    /// Regions: the triangles, ascending.
    RegionTriangles = 144,
    /// Regions: per step how many triangles it named, or how many there were after it.
    RegionCounts = 145,
    /// Rounded meshes: the vertices of the crease with this index, one after the other, in the mesh given; those of a closed one end with the first.
    CreaseVertices = 160,
    /// Rounded meshes: the corners, vertices of the mesh given, that stay sharp, as no sound blend was found there: blends fade out towards them.
    SharpCorners = 161,
}

/// Vectors in a result.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_vectors {
    /// Faired meshes: the unit normals that were used at the boundary, in the order of the list BOUNDARY_VERTICES.
    BoundaryNormals = 0,
    /// Filled, bridged, remeshed and rounded meshes: per new vertex the weights of its three parents; their sum is 1. Carried points: per point.
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

/// What `fairmesh_describe` tells of a number.
#[repr(u32)]
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_text {
    /// What it is called, such as "poor_triangles".
    Name = 0,
    /// What it means.
    Meaning = 1,
    /// What can be done about it; empty if there is nothing to do.
    Remedy = 2,
}

/// A crease of a mesh that was rounded, from one corner or end to the next. Set `struct_size` before the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_crease {
    /// `sizeof(fairmesh_crease)`.
    pub struct_size: u32,
    /// Not 0: it was rounded.
    pub is_rounded: u32,
    /// Not 0: it was to be rounded and stays sharp, as no sound blend was found.
    pub is_unsolved: u32,
    /// Zero.
    pub reserved: u32,
    /// Size of the list CREASE_VERTICES.
    pub vertex_count: u64,
    /// By how many degrees the surface bends there, in the mean; positive where it is convex.
    pub bend: f64,
    /// The least part of the width asked that there is room for along it; 1: all of it.
    pub part: f64,
    /// Where that is, on the crease; zero where there is room for all.
    pub narrowest: [f64; 3],
    /// Of an unsolved one the worst place of what was tried, otherwise zero.
    pub unsolved: [f64; 3],
}

/// What was taken for a bump or dent. Set `struct_size` before the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_bump {
    /// `sizeof(fairmesh_bump)`.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// How many triangles it has.
    pub triangle_count: u64,
    /// How far its farthest corner is from the seed, along the surface.
    pub radius: f64,
    /// How far the surface lies above the fair one at most, along the normal; a dent's is negative.
    pub height: f64,
    /// By how much the fair surface disagrees with that of a slightly larger region and with what surrounds it, over the root mean square of the
    /// height: near 0 the bump is told from all around it, from 0.5 on there is none.
    pub uncertainty: f64,
}
