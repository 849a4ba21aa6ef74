//! The structs of the header that tell of boundary loops, and what became of them.

/// A boundary loop. Set `struct_size` before the call.
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
    /// the end of a tube, 180 for the outer boundary of a plane sheet.
    pub turn: f64,
    /// The bad edge of a non-manifold or inconsistent loop, otherwise UINT32_MAX.
    pub edge_a: u32,
    /// Its other end.
    pub edge_b: u32,
    /// The component of the mesh that the loop is on, as `fairmesh_components` numbers them.
    pub component: u64,
    /// How many triangles that has.
    pub component_triangle_count: u64,
    /// Not 0: how rough the rim is was asked for (`fairmesh_rim_roughness`) and could be told, as the next seven say; otherwise these are 0.
    /// Where the mesh around the loop is too small, it cannot be told.
    pub has_roughness: u32,
    /// Not 0: the rim is noise, and the two advised options below draw it to the surface that the mesh has there on average.
    pub is_rough: u32,
    /// `rim_angle` over `rim_angle_expected`, or over a degree or so, if that is more: about 1 where the mesh is clean.
    pub roughness: f64,
    /// The angle between the normals of the triangles at consecutive edges of the loop, in degrees, root mean square.
    pub rim_angle: f64,
    /// The angle that is expected there, by the surface fitted to what is around.
    pub rim_angle_expected: f64,
    /// The distance of the mesh around from that surface, root mean square.
    pub rim_noise: f64,
    /// What is advised for `relax_rim` of the fill options; 0: nothing.
    pub advised_relax_rim: u64,
    /// What is advised for `relax_within`; 0 where nothing is.
    pub advised_relax_within: f64,
}

/// Loops whose joint patch bends less than patches of their own would. Bends are sums over all edges of triangulations without new
/// vertices, those of the loops included, of length times angle (radians); edges inside count half. Set `struct_size` before the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_join_suggestion {
    /// `sizeof(fairmesh_join_suggestion)`.
    pub struct_size: u32,
    /// A `fairmesh_gap_kind`: what lies between the loops.
    pub gap_kind: u32,
    /// Size of the list JOINED_LOOPS.
    pub loop_count: u64,
    /// The bend of one patch for all of the loops.
    pub joint_bend: f64,
    /// That of a patch for each.
    pub separate_bend: f64,
    /// The area of the joint patch.
    pub joint_area: f64,
    /// That of the separate ones.
    pub separate_area: f64,
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
    /// The loop, as `fairmesh_boundary_loops` numbers it; of several that are joined the first.
    pub loop_index: u64,
    /// Its edges; of loops that are joined those of all.
    pub edge_count: u64,
    /// The first new vertex, as an index of the filled mesh.
    pub first_vertex: u64,
    /// New vertices.
    pub vertex_count: u64,
    /// The first new triangle, as an index of the filled mesh.
    pub first_triangle: u64,
    /// New triangles.
    pub triangle_count: u64,
    /// The smallest angle of the new triangles, in degrees.
    pub worst_angle: f64,
    /// New vertices that lie far outside the loop's bounding box: size of the list OUTSIDE_VERTICES.
    pub outside_count: u64,
    /// Not 0: `max_new_vertices` made the patch coarser.
    pub coarsened: u32,
    /// Not 0: there is a report of the fairing, see `fairmesh_result_report`.
    pub has_report: u32,
    /// Not 0: there is nothing to be said of it: a patch that converged without reservation, or was not to be faired; or a loop that stayed open
    /// because it was not asked for.
    pub is_success: u32,
    /// Zero.
    pub reserved: u32,
    /// Wall seconds.
    pub seconds: f64,
    /// Pairs of intersecting triangles, at least one of each of this patch: the list INTERSECTIONS has two entries for each.
    pub intersection_count: u64,
    /// The loops that the patch is for: size of the list JOINED_LOOPS, 1 if the loop is not joined to others.
    pub joined_count: u64,
    /// What the reason names: of NON_MANIFOLD and INCONSISTENT one end of the edge, of NOT_FINITE, SHARED_VERTEX and HANGING the vertex, of OPPOSITE_SIDES one of
    /// the two loops; otherwise FAIRMESH_NO_ELEMENT.
    pub reason_element: u64,
    /// Of NON_MANIFOLD and INCONSISTENT the other end, of OPPOSITE_SIDES the other loop; otherwise FAIRMESH_NO_ELEMENT.
    pub reason_other: u64,
    /// Where loops were joined by `FAIRMESH_JOIN_KIND_AUTO`, the bend of the joint patch, as in `fairmesh_join_suggestion`; otherwise
    /// NaN, as the next three.
    pub joint_bend: f64,
    /// That of a patch for each loop.
    pub separate_bend: f64,
    /// The area of the joint patch.
    pub joint_area: f64,
    /// That of a patch for each loop.
    pub separate_area: f64,
    /// 1 where the boundary normals are those asked for. Less where no sound patch has them: so much of the way from the normals of a
    /// membrane to the averages of the mesh's.
    pub normals_reached: f64,
    /// Where loops were joined by `FAIRMESH_JOIN_KIND_AUTO`, a `fairmesh_gap_kind`: what lies between them.
    pub gap_kind: u32,
    /// Not 0: vertices around the loop were allowed to move (`relax_rim`), and the next five say how far they did; otherwise these are 0.
    pub has_relaxed: u32,
    /// How many vertices of the mesh moved.
    pub moved_count: u64,
    /// How far, root mean square.
    pub moved_rms: f64,
    /// How far the one that moved furthest did.
    pub moved_largest: f64,
    /// The bound: none moved further.
    pub moved_within: f64,
    /// How many triangles at vertices that moved are folded or, of the mesh, intersect since: none in a sound result.
    pub moved_unsound: u64,
}

/// What became of a bridge. Set `struct_size` before the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_bridge_report {
    /// `sizeof(fairmesh_bridge_report)`.
    pub struct_size: u32,
    /// Not 0: there is a report of the fairing of all that is new together. Unless its outcome is CONVERGED, the strip and the patches
    /// beside it are left as they were made.
    pub has_whole: u32,
    /// By how much the strip is twisted from one chain to the other, in degrees between -180 and 180.
    pub twist: f64,
    /// Holes beside the strip that were filled, or tried.
    pub rest_count: u64,
}
