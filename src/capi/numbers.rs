//! The enumerations of the C interface. Made of the library's tables by src/declarations: do not edit.

/// Whether a call did what it was asked. How a solve ended is another matter, see `fairmesh_outcome`. After any status but OK no output was written, except for the `fairmesh_error`. Numbers are never reused.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_status {
    /// Done.
    Ok = 0,
    /// A pointer is NULL that may not be.
    NullPointer = 1,
    /// A pointer or a stride does not have the alignment of what it points to.
    Misaligned = 2,
    /// Struct_size is not one that this library knows.
    BadStructSize = 3,
    /// An option is out of its range.
    BadOption = 4,
    /// A number is not one of the enumeration that is meant.
    BadEnum = 5,
    /// A stride is smaller than what it steps over.
    BadStride = 6,
    /// A count times its stride exceeds the address space.
    CountOverflow = 7,
    /// Two counts differ that have to be the same.
    CountMismatch = 8,
    /// An output overlaps an input or another output.
    Aliasing = 9,
    /// Not a living handle of the kind that is meant: never made, or freed before.
    BadHandle = 10,
    /// The handle is in use: by another thread, or by the call whose callback this call comes from.
    Busy = 11,
    /// Memory ran out; everything that the call had allocated is free again, and a solver stays usable.
    OutOfMemory = 12,
    /// The system gave no more threads.
    Threads = 13,
    /// More vertices or triangles than 32-bit indices can name.
    TooLarge = 14,
    /// A coordinate that is needed is NaN or infinite, or does not fit a float on its way out.
    NotFinite = 15,
    /// A triangle names a vertex that does not exist.
    IndexOutOfRange = 16,
    /// A triangle names a vertex twice.
    RepeatedIndex = 17,
    /// Two triangles have the same vertices.
    DuplicateTriangle = 18,
    /// More than two triangles share an edge.
    NonManifoldEdge = 19,
    /// The triangles around a vertex are not one fan.
    NonManifoldVertex = 20,
    /// Two triangles run through an edge in the same direction.
    InconsistentOrientation = 21,
    /// A free vertex is on the boundary of the mesh.
    FreeVertexOnBoundary = 22,
    /// A free vertex has no triangle.
    FreeVertexWithoutTriangle = 23,
    /// A component of the region has no fixed vertex.
    NothingFixed = 24,
    /// No vertex is free.
    EmptyRegion = 25,
    /// The selection names what does not exist.
    SelectionOutOfRange = 26,
    /// A normal is not a finite vector of length one (to 0.001), or contradicts that of a coincident vertex.
    BadNormal = 27,
    /// No normal can be found for a boundary vertex.
    NoNormal = 28,
    /// The result has nothing of this kind, or nothing with this index.
    NotAvailable = 29,
    /// The buffer is too small; the size needed has been told.
    BufferTooSmall = 30,
    /// A number is not what this version asks for: reserved fields have to be zero.
    BadReserved = 31,
    /// A coordinate is so large that lengths exceed the range of doubles.
    CoordinateTooLarge = 32,
    /// A vertex has more than 1,000 triangles in the region.
    ValenceTooLarge = 33,
    /// A vertex is on no boundary loop of the region.
    NotOnLoop = 34,
    /// A guide does not join two vertices of the boundary that one patch can have an edge between.
    BadGuide = 35,
    /// Two guides cross each other.
    GuidesCross = 36,
    /// A chain is no run of edges of one boundary loop.
    BadChain = 37,
    /// Deleted and filled, a region gets no fair patch that intersects nothing, or it cannot be deleted, or the run was stopped.
    NoFairPatch = 38,
    /// Nothing tells where a bump ends.
    NoBump = 39,
    /// An edit of a solver has a number that is not finite, or moves a free vertex.
    BadEdit = 40,
    /// A component has one side only, as a Moebius strip.
    NotOrientable = 41,
    /// The callback has stopped the call, which has no result then.
    Cancelled = 42,
    /// Two vertices are named as an edge between two triangles, and are none.
    NotAnEdge = 43,
    /// No edge bends enough to be rounded.
    NoCrease = 44,
    /// A bug of fairmesh, caught; the handle, if there was one, answers so from now on.
    Internal = 99,
}

/// How a run ended that did what it was asked. The positions are usable in every case. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_outcome {
    /// Tolerance met, and the surface is sound.
    Converged = 0,
    /// Tolerance met, but triangles are flipped or have an angle below one degree.
    ConvergedPoorTriangles = 1,
    /// Tolerance met, and no triangle is poor, but the surface has a reservation, which the reason names.
    ConvergedLoosely = 2,
    /// A surface was found for a part of the target only; that of least bending is returned.
    TargetNotReachable = 4,
    /// No sound surface was found; that of least bending is returned.
    NotConverged = 5,
    /// The iterations ran out; the best surface so far is returned.
    IterationLimit = 6,
    /// The progress callback stopped the run; the best surface so far is returned, before there is one the input.
    Cancelled = 7,
    /// Tolerance met, but the surface has a crease along the boundary, at the vertices that the report names.
    BoundaryCrease = 8,
    /// Tolerance met, and no triangle is poor, but triangles of the surface intersect each other or the rest of the mesh.
    SelfIntersecting = 9,
    /// Tolerance met, but rounding the positions to the numbers that are written flips triangles or leaves them without angles.
    PoorWhenRounded = 10,
    /// No harmonic surface was found; a smooth one with the same normals, between harmonic and minimal energy, is returned.
    NearestMember = 11,
}

/// What is to be said of a surface that converged loosely. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_loose_reason {
    /// There is nothing to say.
    None = 0,
    /// Boundary normals point against the surface beside them: probably flipped.
    SuspiciousNormals = 1,
    /// Max |Delta_B H| is as small as the rounding of the positions allows, but above its limit.
    Rounding = 2,
    /// The surface has a bump: its curvature inside exceeds what the boundary allows, or it folds at single edges or leaves single normals.
    Bump = 4,
    /// The steps have become as small as double precision allows here, but stay above the tolerance.
    Tolerance = 5,
    /// No sound surface over this hole has the normals of the mesh: they were drawn towards those of a membrane.
    DrawnNormals = 6,
    /// Less than half of the curvature asked for was continued: the surroundings are too rough, or no sound surface has it.
    Curvature = 7,
    /// A sharp edge of the surroundings ends at the boundary, at the vertices that the report names, and does not go on.
    SharpEdge = 8,
}

/// How an attempt at a surface ended. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_attempt_end {
    /// A sound surface that meets the tolerance of the attempt.
    Sound = 0,
    /// A surface that meets the tolerance, but has poor triangles, a bump or a crease.
    Unsound = 1,
    /// No surface that meets the tolerance.
    NotConverged = 2,
    /// Stopped by the limit of iterations or by the caller.
    Stopped = 3,
}

/// How the filling of a loop ended. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_fill_outcome {
    /// Filled with a faired surface; its report says with which reservations.
    Faired = 0,
    /// Filled with the surface of least bending, or the best one when the iterations ran out.
    LeastBending = 1,
    /// Filled with the triangulation, refined, but not faired; the reason says why.
    Flat = 2,
    /// Left as it was; the reason says why.
    LeftOpen = 3,
    /// Filled, but the patch intersects itself or the mesh, as did all others that were tried.
    SelfIntersecting = 4,
}

/// Why a loop was left open (numbers below 32) or a patch is flat. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_fill_reason {
    /// There is nothing to say.
    None = 0,
    /// The boundary runs into an edge with more than two triangles.
    NonManifold = 1,
    /// It is the outer boundary of an open surface, and was not named.
    OuterBoundary = 2,
    /// It has more edges than asked for.
    TooManyEdges = 3,
    /// Every triangulation has an edge or a triangle that the mesh has already.
    NoTriangulation = 4,
    /// A vertex of the boundary is NaN or infinite, or all of them are the same point.
    NotFinite = 5,
    /// The run was stopped before this loop was done.
    Cancelled = 6,
    /// Two of the loops to be joined fit only if the triangles at one of them faced the other way.
    OppositeSides = 7,
    /// Two of the loops to be joined have a vertex in common.
    SharedVertex = 8,
    /// It is not one of those that were asked for.
    NotAskedFor = 9,
    /// No patch was found that is fair and without reservations, and such loops were to stay open.
    NotFair = 10,
    /// Every patch that was tried intersects itself or the mesh, and such loops were to stay open.
    Intersects = 11,
    /// It is the outer boundary of triangles that hang at the rest of the mesh by single vertices only, one of which is told.
    Hanging = 12,
    /// The boundary runs into an edge whose two triangles face opposite ways: they are oriented inconsistently.
    Inconsistent = 13,
    /// Fairing was not asked for.
    NotAsked = 32,
    /// The patch has no inner vertex: nothing can move.
    NoInnerVertex = 33,
    /// The fairing was refused, because the mesh around the hole is defective.
    Refused = 34,
    /// The fairing found no sound surface; its report says how it ended.
    Unsound = 35,
    /// Faired, the patch would intersect itself or the mesh.
    Intersecting = 36,
    /// The boundary lies in a plane, which closes it, as asked.
    Planar = 37,
}

/// What kind of gap a boundary loop is. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_loop_kind {
    /// A gap in the surface.
    Hole = 0,
    /// The outer boundary of an open surface: filled only if it is named.
    OuterBoundary = 1,
    /// It meets an edge with more than two triangles, which is told: never filled.
    NonManifold = 2,
    /// It meets an edge, which is told, whose two triangles face opposite ways: never filled.
    Inconsistent = 3,
}

/// Which loops get one patch together. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_join_kind {
    /// Every loop gets a patch of its own.
    None = 0,
    /// The loops of each group get one patch.
    Groups = 1,
    /// Loops whose joint patch bends less than patches of their own would get one patch.
    Auto = 2,
}

/// What lies between loops that are joined. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_gap_kind {
    /// A gap between parts.
    Gap = 0,
    /// A tunnel: the part gets a handle.
    Tunnel = 1,
    /// A hole with an island in it.
    Island = 2,
}

/// What became of ends of sharp edges that belong together. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_sharp_fate {
    /// The crease goes on through the region, from end to end.
    GoesOn = 0,
    /// Creases go on to a corner in the region, or to two that a crease joins.
    Corner = 1,
    /// No other end fits it: the region is smooth there.
    Alone = 2,
    /// No path of edges, or no sound patch, can follow the crease: the surface is smooth there.
    NoPath = 3,
}

/// What a loop gets whose patch is no success: not fair, creased, intersecting, or with any other reservation. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_on_failure {
    /// The best surface that there is: that of least bending, or the faired one that intersects where all do.
    Best = 0,
    /// The triangulation, refined.
    Flat = 1,
    /// None: it is left open.
    Open = 2,
}

/// What closes a loop that lies in a plane. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_cap {
    /// A fair patch, which continues the surroundings and bulges as they do.
    Fair = 0,
    /// The plane, with a sharp edge along the loop; loops that are in no plane get a fair patch.
    Flat = 1,
}

/// Which creases are rounded. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_creases {
    /// All.
    All = 0,
    /// Edges that stand out.
    Convex = 1,
    /// Edges that lie in a fold.
    Concave = 2,
}

/// A part of space. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_place_kind {
    /// Anywhere.
    Everywhere = 0,
    /// Not further than a radius from a centre.
    Ball = 1,
    /// Between two corners, the faces included.
    Box = 2,
}

/// Where the normals at the boundary of the region come from. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_boundary_normals_kind {
    /// Fitted to the surface outside the region, to second or third order; where there is no outside, averaged.
    Fitted = 0,
    /// The average of the triangles outside the region.
    Averaged = 1,
    /// Given, for some or all boundary vertices; fitted for the others.
    Given = 2,
}

/// Normals of fixed vertices inside the region that have none given. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_interior_normals {
    /// Those of the surface itself, found with it: it passes the vertices smoothly; only their positions are prescribed.
    Smooth = 0,
    /// The average of their triangles in the input, or of the surroundings where they are near (paper 7.5).
    Input = 1,
}

/// Whether vertices at the same place are one vertex of the surface. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_coincident {
    /// Boundary edges with coincident ends are one edge of the surface.
    Join = 0,
    /// The mesh is as its triangles say.
    Separate = 1,
}

/// What the Laplacian of the mean curvature H has to be. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_target_kind {
    /// Zero: spheres, cylinders and all surfaces of constant mean curvature are kept.
    Harmonic = 0,
    /// The constant, in 1 / length^3: a positive one pushes the surface out along its normals.
    Constant = 1,
    /// -2 H (H^2 - K): minimal total curvature.
    MinimalEnergy = 2,
}

/// How vertices are distributed within the surface. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_inner_fairness {
    /// Equal weights: a regular distribution.
    Uniform = 0,
    /// Cotangents of the input mesh: least distortion of the input triangles.
    Conformal = 1,
    /// Mean-value weights of the input mesh (Floater): near conformal, but positive for any input, and exact on a plane.
    Convex = 2,
}

/// The precision of the numbers that a result will be written in. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_output_precision {
    /// Double: 53 bits.
    Double = 0,
    /// Single: 24 bits; far from the origin that is coarse.
    Single = 1,
}

/// How normals and mean curvature are discretized. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_discretization {
    /// Max's normals and the gradient-corrected curvature: second order on irregular meshes.
    SecondOrder = 0,
    /// The paper's: normals from summed cross products, plain Moreton-Sequin curvature.
    Paper = 1,
}

/// Whether a surface is checked for triangles that intersect each other or the rest of the mesh. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = "numbers for C")]
pub enum fairmesh_intersections {
    /// The surface is checked against itself and the rest of the mesh; one that intersects is no success.
    Check = 0,
    /// Not checked: a surface that intersects may count as a success.
    Skip = 1,
}

impl fairmesh_status {
    /// The status with this number.
    pub(crate) const fn from_number(number: u32) -> Self {
        match number {
            0 => Self::Ok,
            1 => Self::NullPointer,
            2 => Self::Misaligned,
            3 => Self::BadStructSize,
            4 => Self::BadOption,
            5 => Self::BadEnum,
            6 => Self::BadStride,
            7 => Self::CountOverflow,
            8 => Self::CountMismatch,
            9 => Self::Aliasing,
            10 => Self::BadHandle,
            11 => Self::Busy,
            12 => Self::OutOfMemory,
            13 => Self::Threads,
            14 => Self::TooLarge,
            15 => Self::NotFinite,
            16 => Self::IndexOutOfRange,
            17 => Self::RepeatedIndex,
            18 => Self::DuplicateTriangle,
            19 => Self::NonManifoldEdge,
            20 => Self::NonManifoldVertex,
            21 => Self::InconsistentOrientation,
            22 => Self::FreeVertexOnBoundary,
            23 => Self::FreeVertexWithoutTriangle,
            24 => Self::NothingFixed,
            25 => Self::EmptyRegion,
            26 => Self::SelectionOutOfRange,
            27 => Self::BadNormal,
            28 => Self::NoNormal,
            29 => Self::NotAvailable,
            30 => Self::BufferTooSmall,
            31 => Self::BadReserved,
            32 => Self::CoordinateTooLarge,
            33 => Self::ValenceTooLarge,
            34 => Self::NotOnLoop,
            35 => Self::BadGuide,
            36 => Self::GuidesCross,
            37 => Self::BadChain,
            38 => Self::NoFairPatch,
            39 => Self::NoBump,
            40 => Self::BadEdit,
            41 => Self::NotOrientable,
            42 => Self::Cancelled,
            43 => Self::NotAnEdge,
            44 => Self::NoCrease,
            99 => Self::Internal,
            _ => Self::Internal,
        }
    }
}
