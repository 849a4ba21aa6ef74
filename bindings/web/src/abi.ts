/**
 * The C interface in WebAssembly's memory: numbers of enumerations, places of fields, arguments of functions, and the types of what is read.
 * Made of src/capi by src/declarations when the package is built.
 */

export const VERSION_MAJOR = 0;
export const VERSION_MINOR = 1;
export const VERSION_PATCH = 0;

/** Numbers of the C interface by the names that stand for them here. */
export const enums = {
    status: {
        /** Done. */
        ok: 0,
        /** A pointer is null that may not be. */
        null_pointer: 1,
        /** A pointer or a stride does not have the alignment of what it points to. */
        misaligned: 2,
        /** Struct_size is not one that this library knows. */
        bad_struct_size: 3,
        /** An option is out of its range. */
        bad_option: 4,
        /** A number is not one of the enumeration that is meant. */
        bad_enum: 5,
        /** A stride is smaller than what it steps over. */
        bad_stride: 6,
        /** A count times its stride exceeds the address space. */
        count_overflow: 7,
        /** Two counts differ that have to be the same. */
        count_mismatch: 8,
        /** An output overlaps an input or another output. */
        aliasing: 9,
        /** Not a living handle of the kind that is meant: never made, or freed before. */
        bad_handle: 10,
        /** The handle is in use: by another thread, or by the call whose callback this call comes from. */
        busy: 11,
        /** Memory ran out; everything that the call had allocated is free again, and a solver stays usable. */
        out_of_memory: 12,
        /** The system gave no more threads. */
        threads: 13,
        /** More vertices or triangles than 32-bit indices can name. */
        too_large: 14,
        /** A coordinate that is needed is NaN or infinite, or does not fit a float on its way out. */
        not_finite: 15,
        /** A triangle names a vertex that does not exist. */
        index_out_of_range: 16,
        /** A triangle names a vertex twice. */
        repeated_index: 17,
        /** Two triangles have the same vertices. */
        duplicate_triangle: 18,
        /** More than two triangles share an edge. */
        non_manifold_edge: 19,
        /** The triangles around a vertex are not one fan. */
        non_manifold_vertex: 20,
        /** Two triangles run through an edge in the same direction. */
        inconsistent_orientation: 21,
        /** A free vertex is on the boundary of the mesh. */
        free_vertex_on_boundary: 22,
        /** A free vertex has no triangle. */
        free_vertex_without_triangle: 23,
        /** A component of the region has no fixed vertex. */
        nothing_fixed: 24,
        /** No vertex is free. */
        empty_region: 25,
        /** The selection names what does not exist. */
        selection_out_of_range: 26,
        /** A normal is not a finite vector of length one (to 0.001), or contradicts that of a coincident vertex. */
        bad_normal: 27,
        /** No normal can be found for a boundary vertex. */
        no_normal: 28,
        /** The result has nothing of this kind, or nothing with this index. */
        not_available: 29,
        /** The buffer is too small; the size needed has been told. */
        buffer_too_small: 30,
        /** A number is not what this version asks for: reserved fields have to be zero. */
        bad_reserved: 31,
        /** A coordinate is so large that lengths exceed the range of doubles. */
        coordinate_too_large: 32,
        /** A vertex has more than 1,000 triangles in the region. */
        valence_too_large: 33,
        /** A vertex is on no boundary loop of the region. */
        not_on_loop: 34,
        /** A guide does not join two vertices of the boundary that one patch can have an edge between. */
        bad_guide: 35,
        /** Two guides cross each other. */
        guides_cross: 36,
        /** A chain is no run of edges of one boundary loop. */
        bad_chain: 37,
        /** Deleted and filled, a region gets no fair patch that intersects nothing, or it cannot be deleted, or the run was stopped. */
        no_fair_patch: 38,
        /** The curvature does not tell where a bump ends. */
        no_bump: 39,
        /** An edit of a session has a number that is not finite, or moves a free vertex. */
        bad_edit: 40,
        /** A bug of fairmesh, caught; the handle, if there was one, answers so from now on. */
        internal: 99,
    },
    outcome: {
        /** Tolerance met, and the surface is sound. */
        converged: 0,
        /** Tolerance met, but triangles are flipped or have an angle below one degree. */
        converged_poor_triangles: 1,
        /** Tolerance met, and no triangle is poor, but the surface has a reservation, which the reason names. */
        converged_loosely: 2,
        /** A surface was found for a part of the target only; that of the linear problem is returned. */
        target_not_reachable: 4,
        /** No sound surface was found; that of the linear problem is returned. */
        not_converged: 5,
        /** The iterations ran out; the best surface so far is returned. */
        iteration_limit: 6,
        /** The progress callback stopped the run; the best surface so far is returned, before there is one the input. */
        cancelled: 7,
        /** Tolerance met, but the surface has a crease along the boundary, at the vertices that the report names. */
        boundary_crease: 8,
        /** Tolerance met, and no triangle is poor, but triangles of the surface intersect each other or the rest of the mesh. */
        self_intersecting: 9,
        /** Tolerance met, but rounding the positions to the numbers that are written flips triangles or leaves them without angles. */
        poor_when_rounded: 10,
        /** No harmonic surface was found; a smooth one with the same normals, between harmonic and minimal energy, is returned. */
        nearest_member: 11,
    },
    looseReason: {
        /** There is nothing to say. */
        none: 0,
        /** Boundary normals point against the surface beside them: probably flipped. */
        suspicious_normals: 1,
        /** Max |Delta_B H| is as small as the rounding of the positions allows, but above its limit. */
        rounding: 2,
        /** The surface has a bump: its curvature inside exceeds what the boundary allows, or it leaves single boundary normals. */
        bump: 4,
        /** The steps have become as small as double precision allows here, but stay above the tolerance. */
        tolerance: 5,
        /** No sound surface over this hole has the normals of the mesh: they were drawn towards those of a membrane. */
        drawn_normals: 6,
    },
    attemptEnd: {
        /** A sound surface that meets the tolerance of the attempt. */
        sound: 0,
        /** A surface that meets the tolerance, but has poor triangles, a bump or a crease. */
        unsound: 1,
        /** No surface that meets the tolerance. */
        not_converged: 2,
        /** Stopped by the limit of iterations or by the caller. */
        stopped: 3,
    },
    fillOutcome: {
        /** Filled with a faired surface; its report says with which reservations. */
        faired: 0,
        /** Filled with the surface of the linear problem, or the best one when the iterations ran out. */
        linear: 1,
        /** Filled with the triangulation, refined, but not faired; the reason says why. */
        flat: 2,
        /** Left as it was; the reason says why. */
        left_open: 3,
        /** Filled, but the patch intersects itself or the mesh, as did all others that were tried. */
        self_intersecting: 4,
    },
    fillReason: {
        /** There is nothing to say. */
        none: 0,
        /** The boundary runs into an edge with more than two triangles, or with inconsistent ones. */
        non_manifold: 1,
        /** It is the outer boundary of an open surface, and was not named. */
        outer_boundary: 2,
        /** It has more edges than asked for. */
        too_many_edges: 3,
        /** Every triangulation has an edge or a triangle that the mesh has already. */
        no_triangulation: 4,
        /** A vertex of the boundary is NaN or infinite, or all of them are the same point. */
        not_finite: 5,
        /** The run was stopped before this loop was done. */
        cancelled: 6,
        /** Two of the loops to be joined fit only if the triangles at one of them faced the other way. */
        opposite_sides: 7,
        /** Two of the loops to be joined have a vertex in common. */
        shared_vertex: 8,
        /** It is not one of those that were asked for. */
        not_asked_for: 9,
        /** No fair patch was found, and such loops were to stay open. */
        not_fair: 10,
        /** Every patch that was tried intersects itself or the mesh, and such loops were to stay open. */
        intersects: 11,
        /** Fairing was not asked for. */
        not_asked: 32,
        /** The patch has no inner vertex: nothing can move. */
        no_inner_vertex: 33,
        /** The fairing was refused, because the mesh around the hole is defective. */
        refused: 34,
        /** The fairing found no sound surface; its report says how it ended. */
        unsound: 35,
        /** Faired, the patch would intersect itself or the mesh. */
        intersecting: 36,
    },
    loopKind: {
        /** A gap in the surface. */
        hole: 0,
        /** The outer boundary of an open surface: filled only if it is named. */
        outer_boundary: 1,
        /** It meets a bad edge, which is told: never filled. */
        non_manifold: 2,
    },
    joinKind: {
        /** Every loop gets a patch of its own. */
        none: 0,
        /** The loops of each group get one patch. */
        groups: 1,
        /** Loops whose joint patch bends less than patches of their own would get one patch. */
        auto: 2,
    },
    gapKind: {
        /** A gap between parts. */
        gap: 0,
        /** A tunnel: the part gets a handle. */
        tunnel: 1,
        /** A hole with an island in it. */
        island: 2,
    },
    onFailure: {
        /** The best surface that there is: that of the linear problem, or the faired one that intersects where all do. */
        linear: 0,
        /** The triangulation, refined. */
        flat: 1,
        /** None: it is left open. */
        open: 2,
    },
    placeKind: {
        /** Anywhere. */
        everywhere: 0,
        /** Not further than a radius from a centre. */
        ball: 1,
        /** Between two corners, the faces included. */
        box: 2,
    },
    boundaryNormalsKind: {
        /** Fitted to the surface outside the region, to second or third order; where there is no outside, averaged. */
        fitted: 0,
        /** The average of the triangles outside the region. */
        averaged: 1,
        /** Given, for some or all boundary vertices; fitted for the others. */
        given: 2,
    },
    interiorNormals: {
        /** Those of the surface itself, found with it: it passes the vertices smoothly; only their positions are prescribed. */
        smooth: 0,
        /** The average of their triangles in the input, or of the surroundings where they are near (paper 7.5). */
        input: 1,
    },
    coincident: {
        /** Boundary edges with coincident ends are one edge of the surface. */
        join: 0,
        /** The mesh is as its triangles say. */
        separate: 1,
    },
    targetKind: {
        /** Zero: spheres, cylinders and all surfaces of constant mean curvature are kept. */
        harmonic: 0,
        /** The constant, in 1 / length^3: a positive one pushes the surface out along its normals. */
        constant: 1,
        /** -2 H (H^2 - K): minimal total curvature. */
        minimal_energy: 2,
    },
    innerFairness: {
        /** Equal weights: a regular distribution. */
        uniform: 0,
        /** Cotangents of the input mesh: least distortion of the input triangles. */
        conformal: 1,
        /** Mean-value weights of the input mesh (Floater): near conformal, but positive for any input, and exact on a plane. */
        convex: 2,
    },
    outputPrecision: {
        /** Double: 53 bits. */
        double: 0,
        /** Single: 24 bits; far from the origin that is coarse. */
        single: 1,
    },
    discretization: {
        /** Max's normals and the gradient-corrected curvature: second order on irregular meshes. */
        second_order: 0,
        /** The paper's: normals from summed cross products, plain Moreton-Sequin curvature. */
        paper: 1,
    },
    solverKind: {
        /** Quasi-Newton steps on both equations together. */
        fast: 0,
        /** The paper's own scheme: slow, a yardstick; not for fairing in steps. */
        paper: 1,
    },
    estimate: {
        /** By turns one Gauss-Seidel iteration and some of conjugate gradients. */
        alternating: 0,
        /** Gauss-Seidel iterations. */
        gauss_seidel: 1,
        /** Conjugate gradient iterations. */
        conjugate_gradients: 2,
    },
    intersections: {
        /** The surface is checked against itself and the rest of the mesh; one that intersects is no success. */
        check: 0,
        /** Not checked: a surface that intersects may count as a success. */
        skip: 1,
    },
    element: {
        /** Nothing. */
        none: 0,
        /** A vertex of the mesh given. */
        vertex: 1,
        /** A triangle of the mesh given. */
        triangle: 2,
        /** An edge: `element` and `other` are its vertices, the smaller first. */
        edge: 3,
        /** An argument of the function, counted from 1; `other` is the offset of the field in the struct that it points to, or FAIRMESH_NO_ELEMENT for the argument itself. */
        argument: 4,
        /** A boundary loop. */
        loop: 5,
    },
    scalar: {
        /** `float`. */
        float32: 1,
        /** `double`. */
        float64: 2,
    },
    selectionKind: {
        /** Nothing: free are all vertices that are not on the boundary of the mesh. `data` is null, `count` and `stride` 0. */
        interior: 0,
        /** `uint8T`, one per vertex: not zero is free. */
        free_mask: 1,
        /** `uint8T`, one per vertex: not zero is fixed. */
        fixed_mask: 2,
        /** `uint32T`: the free vertices, in any order. */
        free_vertices: 3,
        /** `uint32T`: triangles. Free are the vertices that have no other triangles and are not on the boundary of the mesh. */
        faces: 4,
    },
    boundaryCurvatureKind: {
        /** Fitted to the surface outside the region. */
        estimated: 0,
        /** Given, for some or all boundary vertices; fitted for the others. */
        given: 1,
    },
    resultKind: {
        /** A faired mesh. */
        faired: 0,
        /** Boundary loops. */
        loops: 1,
        /** A mesh with filled holes. */
        filled: 2,
        /** A mesh with a new triangulation of a region. */
        remeshed: 3,
        /** Pairs of intersecting triangles. */
        intersections: 4,
        /** Groups of loops that would be joined. */
        joins: 5,
        /** A mesh without some of its triangles. */
        erased: 6,
        /** The components of a mesh. */
        components: 7,
        /** A mesh with a bridge. */
        bridged: 8,
        /** A mesh without the triangles that spoil the boundaries of holes. */
        trimmed: 9,
        /** Points on the triangles of a mesh. */
        carried: 10,
        /** Triangles chosen by place and shape. */
        region: 11,
    },
    list: {
        /** Triangles that are flipped or have an angle below one degree, where the outcome is about them. */
        poor_triangles: 0,
        /** Triangles whose normal points away from those of their vertices. */
        flipped_triangles: 1,
        /** Triangles with an angle below one degree. */
        needles: 2,
        /** Boundary vertices whose normal contradicts the surface or its neighbours'. */
        suspicious_normals: 3,
        /** Intersecting triangles, two for each pair, the smaller number first; of a filled mesh those of the loop. */
        intersections: 5,
        /** Boundary vertices where the surface has a crease, where the outcome is about them. */
        creased_vertices: 6,
        /** Faired meshes: the boundary vertices, ascending. A vertex where components have different normals stands there with each. */
        boundary_vertices: 16,
        /** Loops: the vertices in the direction of triangles that fill it. */
        loop_vertices: 32,
        /** Loops: vertices that belong to another loop, too. */
        loop_touching: 33,
        /** Filled meshes: new vertices of the loop far outside its bounding box. */
        outside_vertices: 48,
        /** Filled, bridged and remeshed meshes: per new vertex three vertices of the mesh given that it comes from. Carried points: per point the corners of the triangle that it is on. */
        parents: 49,
        /** Filled meshes: the loops that the patch is for, ascending. Joins: the loops of the group with this index, ascending. */
        joined_loops: 50,
        /** Remeshed meshes: the free vertices. */
        free_vertices: 64,
        /** Remeshed meshes: per vertex that is left its number before. */
        kept_vertices: 65,
        /** Remeshed, erased and trimmed meshes: per triangle that is left its number before. */
        kept_triangles: 66,
        /** Erased meshes: the loops that the deleted triangles leave, as `boundaryLoops` numbers those of the mesh that is left. */
        erased_loops: 80,
        /** Components: per triangle the number of its component. */
        triangle_components: 96,
        /** Bridged meshes: the vertices of the chain that the strip begins (0) or ends (1) at, in the direction in which its triangles run through them. */
        bridge_chain: 112,
        /** Bridged meshes: the new vertices on one side of the strip (0: from the first chain to the second; 1: back). */
        bridge_side: 113,
        /** Carried points: per point the triangle that it is on. */
        carried_triangles: 128,
        /** Regions: the triangles, ascending. */
        region_triangles: 144,
        /** Regions: per step how many triangles it named, or how many there were after it. */
        region_counts: 145,
    },
    vectors: {
        /** Faired meshes: the unit normals that were used at the boundary, in the order of the list BOUNDARY_VERTICES. */
        boundary_normals: 0,
        /** Filled, bridged and remeshed meshes: per new vertex the weights of its three parents; their sum is 1. Carried points: per point. */
        parent_weights: 1,
    },
    scalars: {
        /** Mean curvature, in 1 / length: negative on a sphere with outward normals. NaN where no vertex is free. */
        mean_curvature: 0,
        /** Gaussian curvature, in 1 / length^2. NaN where no vertex is free. */
        gaussian_curvature: 1,
    },
    editKind: {
        /** Turns the boundary normals of the loop of `vertex` about the boundary, by `amount` in radians. With a positive one the surface leaves the boundary steeper to the side that normals point to. */
        tilt: 1,
        /** The same on one side of `vertex`, and the opposite on the other. */
        twist: 2,
        /** Bulges the region by `amount`, outward if it is positive; see `solverBulgeRange`. */
        bulge: 3,
        /** Moves the fixed vertices of `vertices` rigidly; their normals follow, given or fitted. */
        move: 4,
    },
    regionKind: {
        /** The whole mesh. */
        all: 0,
        /** The triangles of `list`. */
        triangles: 1,
        /** The triangles all of whose corners are vertices of `list`, or copies of them. */
        vertices: 2,
        /** The triangles that lie in a ball with all corners: around `point`, of radius `value`. */
        ball: 3,
        /** The triangles that lie in a box with all corners: `point` has its smallest, `vector` its largest coordinates. */
        box: 4,
        /** The triangles all of whose corners lie on a plane through `point`, or on the side that `vector` points to. */
        half_space: 5,
        /** The triangles all of whose corners are no further than `value` from the seed, along the surface. */
        geodesic: 6,
        /** The triangles that hang together with the seed by edges. */
        component: 7,
        /** The triangles around the seed, up to edges at which the surface bends by more than `value`, in degrees from 0 to 180. */
        patch: 8,
        /** The bump or dent at the seed: where the mean curvature departs from that of the surroundings, see `bump`. NO_BUMP where none is found. */
        bump: 9,
        /** Adds the triangles that have a vertex in common with the region so far, `rings` times. */
        grow: 32,
        /** Takes the triangles away that have a vertex in common with the rest, `rings` times. */
        shrink: 33,
        /** Takes the rest instead. */
        invert: 34,
    },
    combine: {
        /** What is in any of the two. */
        add: 0,
        /** What is in the region and not named. */
        remove: 1,
        /** What is in both. */
        intersect: 2,
    },
    seedKind: {
        /** At the point of the surface that is nearest to `point`. */
        point: 0,
        /** At a vertex, `seedVertex`. */
        vertex: 1,
    },
} as const;

/** Whether a call did what it was asked. How a solve ended is another matter, see `outcome`. After any status but OK no output was written, except for the `error`. Numbers are never reused. */
export type Status = keyof typeof enums.status;

/** How a run ended that did what it was asked. The positions are usable in every case. Numbers are never reused. */
export type Outcome = keyof typeof enums.outcome;

/** What is to be said of a surface that converged loosely. Numbers are never reused. */
export type LooseReason = keyof typeof enums.looseReason;

/** How an attempt at a surface ended. Numbers are never reused. */
export type AttemptEnd = keyof typeof enums.attemptEnd;

/** How the filling of a loop ended. Numbers are never reused. */
export type FillOutcome = keyof typeof enums.fillOutcome;

/** Why a loop was left open (numbers below 32) or a patch is flat. Numbers are never reused. */
export type FillReason = keyof typeof enums.fillReason;

/** What kind of gap a boundary loop is. Numbers are never reused. */
export type LoopKind = keyof typeof enums.loopKind;

/** Which loops get one patch together. Numbers are never reused. */
export type JoinKind = keyof typeof enums.joinKind;

/** What lies between loops that are joined. Numbers are never reused. */
export type GapKind = keyof typeof enums.gapKind;

/** What a loop gets for which no fair patch is found, or none that does not intersect itself or the mesh. Numbers are never reused. */
export type OnFailure = keyof typeof enums.onFailure;

/** A part of space. Numbers are never reused. */
export type PlaceKind = keyof typeof enums.placeKind;

/** Where the normals at the boundary of the region come from. Numbers are never reused. */
export type BoundaryNormalsKind = keyof typeof enums.boundaryNormalsKind;

/** Normals of fixed vertices inside the region that have none given. Numbers are never reused. */
export type InteriorNormals = keyof typeof enums.interiorNormals;

/** Whether vertices at the same place are one vertex of the surface. Numbers are never reused. */
export type Coincident = keyof typeof enums.coincident;

/** What the Laplacian of the mean curvature H has to be. Numbers are never reused. */
export type TargetKind = keyof typeof enums.targetKind;

/** How vertices are distributed within the surface. Numbers are never reused. */
export type InnerFairness = keyof typeof enums.innerFairness;

/** The precision of the numbers that a result will be written in. Numbers are never reused. */
export type OutputPrecision = keyof typeof enums.outputPrecision;

/** How normals and mean curvature are discretized. Numbers are never reused. */
export type Discretization = keyof typeof enums.discretization;

/** How the equations are solved. Numbers are never reused. */
export type SolverKind = keyof typeof enums.solverKind;

/** How the paper's scheme estimates the mean curvature before the vertices are updated. Numbers are never reused. */
export type Estimate = keyof typeof enums.estimate;

/** Whether a surface is checked for triangles that intersect each other or the rest of the mesh. Numbers are never reused. */
export type Intersections = keyof typeof enums.intersections;

/** What `element` of a `error` counts. */
export type Element = keyof typeof enums.element;

/** The kind of numbers in an array. */
export type Scalar = keyof typeof enums.scalar;

/** What `selection` holds. */
export type SelectionKind = keyof typeof enums.selectionKind;

/** Where the mean curvature comes from that the surface is to continue. */
export type BoundaryCurvatureKind = keyof typeof enums.boundaryCurvatureKind;

/** What a result is of. */
export type ResultKind = keyof typeof enums.resultKind;

/** Lists of indices in a result. The first block is of faired meshes, and of loops of filled ones. */
export type List = keyof typeof enums.list;

/** Vectors in a result. */
export type Vectors = keyof typeof enums.vectors;

/** Numbers per vertex in a result. */
export type Scalars = keyof typeof enums.scalars;

/** What an edit changes. */
export type EditKind = keyof typeof enums.editKind;

/** What a step of `selectRegion` names, or does. */
export type RegionKind = keyof typeof enums.regionKind;

/** How the triangles that a step names are combined with the region so far. */
export type Combine = keyof typeof enums.combine;

/** Where a region begins. */
export type SeedKind = keyof typeof enums.seedKind;

/** Structs: their sizes, and of each field its place, what it is, and of arrays how many it has. */
export const structs = {
    error: {
        size: 256,
        align: 8,
        fields: {
            status: [0, "status"],
            elementKind: [4, "element"],
            element: [8, "orNone"],
            other: [16, "orNone"],
            message: [24, "chars", 232],
        },
    },
    points: {
        size: 20,
        align: 4,
        fields: {
            data: [0, "pointer"],
            count: [4, "size"],
            stride: [8, "size"],
            scalar: [12, "scalar"],
            reserved: [16, "u32"],
        },
    },
    numbers: {
        size: 20,
        align: 4,
        fields: {
            data: [0, "pointer"],
            count: [4, "size"],
            stride: [8, "size"],
            scalar: [12, "scalar"],
            reserved: [16, "u32"],
        },
    },
    pointsOut: {
        size: 20,
        align: 4,
        fields: {
            data: [0, "pointer"],
            count: [4, "size"],
            stride: [8, "size"],
            scalar: [12, "scalar"],
            reserved: [16, "u32"],
        },
    },
    scalarsOut: {
        size: 20,
        align: 4,
        fields: {
            data: [0, "pointer"],
            count: [4, "size"],
            stride: [8, "size"],
            scalar: [12, "scalar"],
            reserved: [16, "u32"],
        },
    },
    indices: {
        size: 12,
        align: 4,
        fields: {
            data: [0, "pointer"],
            count: [4, "size"],
            stride: [8, "size"],
        },
    },
    indicesOut: {
        size: 12,
        align: 4,
        fields: {
            data: [0, "pointer"],
            count: [4, "size"],
            stride: [8, "size"],
        },
    },
    mesh: {
        size: 48,
        align: 8,
        fields: {
            structSize: [0, "u32"],
            coincident: [4, "coincident"],
            positions: [8, "points"],
            triangles: [28, "indices"],
            coincidentWithin: [40, "f64"],
        },
    },
    selection: {
        size: 20,
        align: 4,
        fields: {
            structSize: [0, "u32"],
            kind: [4, "selectionKind"],
            data: [8, "pointer"],
            count: [12, "size"],
            stride: [16, "size"],
        },
    },
    boundaryNormals: {
        size: 40,
        align: 4,
        fields: {
            kind: [0, "boundaryNormalsKind"],
            reserved: [4, "u32"],
            vectors: [8, "points"],
            vertices: [28, "indices"],
        },
    },
    boundaryCurvature: {
        size: 40,
        align: 4,
        fields: {
            kind: [0, "boundaryCurvatureKind"],
            reserved: [4, "u32"],
            values: [8, "numbers"],
            vertices: [28, "indices"],
        },
    },
    loopContinuity: {
        size: 32,
        align: 4,
        fields: {
            values: [0, "numbers"],
            vertices: [20, "indices"],
        },
    },
    target: {
        size: 16,
        align: 8,
        fields: {
            kind: [0, "targetKind"],
            reserved: [4, "u32"],
            constant: [8, "f64"],
        },
    },
    report: {
        size: 304,
        align: 8,
        fields: {
            structSize: [0, "u32"],
            outcome: [4, "outcome"],
            looseReason: [8, "looseReason"],
            linearSurface: [12, "flag"],
            iterations: [16, "u64"],
            defect: [24, "f64"],
            step: [32, "f64"],
            diagonal: [40, "f64"],
            reached: [48, "f64"],
            freeVertices: [56, "u64"],
            levelCount: [64, "u64"],
            fallbackWeights: [72, "u64"],
            poorTriangleCount: [80, "u64"],
            flippedCount: [88, "u64"],
            needleCount: [96, "u64"],
            suspiciousNormalCount: [104, "u64"],
            worstAngle: [112, "f64"],
            worstTriangle: [120, "orNone"],
            hInside: [128, "f64", 2],
            hBoundary: [144, "f64", 2],
            normalDeviation: [160, "f64"],
            normalDeviationVertex: [168, "orNone"],
            normalDeviationRms: [176, "f64"],
            secondsSetup: [184, "f64"],
            secondsStart: [192, "f64"],
            secondsIterate: [200, "f64"],
            secondsQuality: [208, "f64"],
            secondsTotal: [216, "f64"],
            intersectionCount: [224, "u64"],
            intersectionsInInput: [232, "u64"],
            intersectionsChecked: [240, "flag"],
            reserved: [244, "u32"],
            boundaryKink: [248, "f64"],
            boundaryKinkBefore: [256, "f64"],
            boundaryKinkVertex: [264, "orNone"],
            creasedVertexCount: [272, "u64"],
            componentCount: [280, "u64"],
            memberWeight: [288, "f64"],
            bendingEnergy: [296, "f64"],
        },
    },
    component: {
        size: 192,
        align: 8,
        fields: {
            structSize: [0, "u32"],
            outcome: [4, "outcome"],
            looseReason: [8, "looseReason"],
            linearSurface: [12, "flag"],
            vertex: [16, "u64"],
            freeVertices: [24, "u64"],
            iterations: [32, "u64"],
            defect: [40, "f64"],
            step: [48, "f64"],
            diagonal: [56, "f64"],
            reached: [64, "f64"],
            flippedCount: [72, "u64"],
            needleCount: [80, "u64"],
            worstAngle: [88, "f64"],
            worstTriangle: [96, "orNone"],
            hInside: [104, "f64", 2],
            hBoundary: [120, "f64", 2],
            normalDeviation: [136, "f64"],
            normalDeviationVertex: [144, "orNone"],
            normalDeviationRms: [152, "f64"],
            memberWeight: [160, "f64"],
            bendingEnergy: [168, "f64"],
            attemptCount: [176, "u64"],
            continuityCount: [184, "u64"],
        },
    },
    attempt: {
        size: 80,
        align: 8,
        fields: {
            structSize: [0, "u32"],
            end: [4, "attemptEnd"],
            freeVertices: [8, "u64"],
            iterations: [16, "u64"],
            bendingEnergy: [24, "f64"],
            name: [32, "chars", 48],
        },
    },
    continuity: {
        size: 80,
        align: 8,
        fields: {
            structSize: [0, "u32"],
            reserved: [4, "u32"],
            vertex: [8, "u64"],
            vertexCount: [16, "u64"],
            reached: [24, "f64"],
            jumpBefore: [32, "f64"],
            largestJumpBefore: [40, "f64"],
            jump: [48, "f64"],
            largestJump: [56, "f64"],
            curvature: [64, "f64"],
            uncertainty: [72, "f64"],
        },
    },
    level: {
        size: 40,
        align: 8,
        fields: {
            structSize: [0, "u32"],
            reserved: [4, "u32"],
            vertices: [8, "u64"],
            triangles: [16, "u64"],
            updates: [24, "u64"],
            defect: [32, "f64"],
        },
    },
    info: {
        size: 88,
        align: 8,
        fields: {
            structSize: [0, "u32"],
            kind: [4, "resultKind"],
            vertexCount: [8, "u64"],
            triangleCount: [16, "u64"],
            newVertexCount: [24, "u64"],
            newTriangleCount: [32, "u64"],
            loopCount: [40, "u64"],
            boundaryVertexCount: [48, "u64"],
            droppedCount: [56, "u64"],
            componentCount: [64, "u64"],
            cleanedCount: [72, "u64"],
            droppedArea: [80, "f64"],
        },
    },
    bump: {
        size: 48,
        align: 8,
        fields: {
            structSize: [0, "u32"],
            reserved: [4, "u32"],
            triangleCount: [8, "u64"],
            radius: [16, "f64"],
            departure: [24, "f64"],
            surroundings: [32, "f64"],
            scatter: [40, "f64"],
        },
    },
    loop: {
        size: 128,
        align: 8,
        fields: {
            structSize: [0, "u32"],
            kind: [4, "loopKind"],
            vertexCount: [8, "u64"],
            touchingCount: [16, "u64"],
            length: [24, "f64"],
            area: [32, "f64"],
            turn: [40, "f64"],
            edgeA: [48, "u32"],
            edgeB: [52, "u32"],
            component: [56, "u64"],
            componentTriangleCount: [64, "u64"],
            hasRoughness: [72, "flag"],
            isRough: [76, "flag"],
            roughness: [80, "f64"],
            rimAngle: [88, "f64"],
            rimAngleExpected: [96, "f64"],
            rimNoise: [104, "f64"],
            advisedRelaxRings: [112, "u64"],
            advisedRelaxWithin: [120, "f64"],
        },
    },
    joinSuggestion: {
        size: 48,
        align: 8,
        fields: {
            structSize: [0, "u32"],
            gapKind: [4, "gapKind"],
            loopCount: [8, "u64"],
            jointBend: [16, "f64"],
            separateBend: [24, "f64"],
            jointArea: [32, "f64"],
            separateArea: [40, "f64"],
        },
    },
    fillReport: {
        size: 216,
        align: 8,
        fields: {
            structSize: [0, "u32"],
            outcome: [4, "fillOutcome"],
            reason: [8, "fillReason"],
            refusedStatus: [12, "status"],
            loopIndex: [16, "u64"],
            edgeCount: [24, "u64"],
            firstVertex: [32, "u64"],
            vertexCount: [40, "u64"],
            firstTriangle: [48, "u64"],
            triangleCount: [56, "u64"],
            worstAngle: [64, "f64"],
            outsideCount: [72, "u64"],
            coarsened: [80, "flag"],
            hasReport: [84, "flag"],
            seconds: [88, "f64"],
            intersectionCount: [96, "u64"],
            joinedCount: [104, "u64"],
            reasonElement: [112, "orNone"],
            reasonOther: [120, "orNone"],
            jointBend: [128, "f64"],
            separateBend: [136, "f64"],
            jointArea: [144, "f64"],
            separateArea: [152, "f64"],
            normalsReached: [160, "f64"],
            gapKind: [168, "gapKind"],
            hasRelaxed: [172, "flag"],
            movedCount: [176, "u64"],
            movedRms: [184, "f64"],
            movedLargest: [192, "f64"],
            movedWithin: [200, "f64"],
            movedUnsound: [208, "u64"],
        },
    },
    bridgeReport: {
        size: 32,
        align: 8,
        fields: {
            structSize: [0, "u32"],
            isClean: [4, "flag"],
            hasWhole: [8, "flag"],
            reserved: [12, "u32"],
            twist: [16, "f64"],
            restCount: [24, "u64"],
        },
    },
    progress: {
        size: 40,
        align: 8,
        fields: {
            structSize: [0, "u32"],
            reserved: [4, "u32"],
            fraction: [8, "f64"],
            iterations: [16, "u64"],
            step: [24, "f64"],
            phase: [32, "text"],
        },
    },
    options: {
        size: 248,
        align: 8,
        fields: {
            structSize: [0, "u32"],
            innerFairness: [4, "innerFairness"],
            boundaryNormals: [8, "boundaryNormals"],
            target: [48, "target"],
            interiorNormals: [64, "interiorNormals"],
            discretization: [68, "discretization"],
            solver: [72, "solverKind"],
            threads: [76, "u32"],
            tolerance: [80, "f64"],
            maxIterations: [88, "u64"],
            progress: [96, "pointer"],
            userData: [100, "pointer"],
            paperEstimate: [104, "estimate"],
            paperEstimateIterations: [108, "u32"],
            paperDamping: [112, "f64"],
            paperLevels: [120, "u64"],
            paperBase: [128, "u64"],
            paperDefect: [136, "f64"],
            paperLaplacian: [144, "f64"],
            paperMaxUpdates: [152, "u64"],
            intersections: [160, "intersections"],
            outputPrecision: [164, "outputPrecision"],
            continuity: [168, "f64"],
            boundaryCurvature: [176, "boundaryCurvature"],
            loopContinuity: [216, "loopContinuity"],
        },
    },
    join: {
        size: 32,
        align: 4,
        fields: {
            kind: [0, "joinKind"],
            reserved: [4, "u32"],
            loops: [8, "indices"],
            starts: [20, "indices"],
        },
    },
    place: {
        size: 88,
        align: 8,
        fields: {
            kind: [0, "placeKind"],
            reserved: [4, "u32"],
            centre: [8, "f64", 3],
            radius: [32, "f64"],
            low: [40, "f64", 3],
            high: [64, "f64", 3],
        },
    },
    loopFilter: {
        size: 136,
        align: 8,
        fields: {
            maxLength: [0, "f64"],
            maxArea: [8, "f64"],
            maxDiagonal: [16, "f64"],
            exceptLongest: [24, "u64"],
            components: [32, "indices"],
            within: [48, "place"],
        },
    },
    fillOptions: {
        size: 256,
        align: 8,
        fields: {
            structSize: [0, "u32"],
            fair: [4, "flag"],
            maxEdges: [8, "u64"],
            loops: [16, "indices"],
            density: [32, "f64"],
            maxNewVertices: [40, "u64"],
            onFailure: [48, "onFailure"],
            onlyListed: [52, "flag"],
            join: [56, "join"],
            filter: [88, "loopFilter"],
            guides: [224, "indices"],
            relaxRim: [240, "u64"],
            relaxWithin: [248, "f64"],
        },
    },
    remeshOptions: {
        size: 24,
        align: 8,
        fields: {
            structSize: [0, "u32"],
            reserved: [4, "u32"],
            density: [8, "f64"],
            maxVertices: [16, "u64"],
        },
    },
    edit: {
        size: 112,
        align: 8,
        fields: {
            kind: [0, "editKind"],
            vertex: [4, "u32"],
            amount: [8, "f64"],
            falloff: [16, "f64"],
            vertices: [24, "indices"],
            rotation: [40, "f64", 3],
            centre: [64, "f64", 3],
            translation: [88, "f64", 3],
        },
    },
    budget: {
        size: 32,
        align: 8,
        fields: {
            structSize: [0, "u32"],
            reserved: [4, "u32"],
            evaluations: [8, "u64"],
            seconds: [16, "f64"],
            tolerance: [24, "f64"],
        },
    },
    frame: {
        size: 24,
        align: 8,
        fields: {
            structSize: [0, "u32"],
            isSettled: [4, "u32"],
            evaluations: [8, "u64"],
            step: [16, "f64"],
        },
    },
    bulgeRange: {
        size: 24,
        align: 8,
        fields: {
            structSize: [0, "u32"],
            reserved: [4, "u32"],
            low: [8, "f64"],
            high: [16, "f64"],
        },
    },
    regionStep: {
        size: 104,
        align: 8,
        fields: {
            kind: [0, "regionKind"],
            combine: [4, "combine"],
            seedKind: [8, "seedKind"],
            seedVertex: [12, "u32"],
            point: [16, "f64", 3],
            vector: [40, "f64", 3],
            value: [64, "f64"],
            rings: [72, "u64"],
            list: [80, "indices"],
            reserved: [92, "u32"],
            reservedToo: [96, "u32"],
        },
    },
    bridgeOptions: {
        size: 16,
        align: 8,
        fields: {
            structSize: [0, "u32"],
            fill: [4, "flag"],
            width: [8, "f64"],
        },
    },
} as const;

/** How it went. Where the region has several components, the whole has their worst outcome and largest figures. */
export interface Report {
    /** A `outcome`. */
    outcome: Outcome;
    /** What the outcome CONVERGED_LOOSELY is about. */
    looseReason: LooseReason;
    /** The surface is that of the linear problem. */
    linearSurface: boolean;
    /** Nonlinear iterations: the most of any component. */
    iterations: number;
    /** Defect of the equation: max_i |sum_j w_ij (H_i - H_j) + (2 A_i / 3) rhs_i| / sum_j |w_ij|, times the diagonal. */
    defect: number;
    /** The last step norm, in diagonals; NaN if there was none. */
    step: number;
    /** The diagonal of the bounding box, in the unit of the positions; the largest of any component. */
    diagonal: number;
    /** How much of the boundary normals or the target was reached, 0 to 1; 1 where all of it. */
    reached: number;
    /** Free vertices. */
    freeVertices: number;
    /** Levels of the paper's scheme; 0 for the fast solver. */
    levelCount: number;
    /** Free vertices that inner fairness does not spread as asked. */
    fallbackWeights: number;
    /** Size of the list POOR_TRIANGLES. */
    poorTriangleCount: number;
    /** Size of the list FLIPPED_TRIANGLES. */
    flippedCount: number;
    /** Size of the list NEEDLES. */
    needleCount: number;
    /** Size of the list SUSPICIOUS_NORMALS. */
    suspiciousNormalCount: number;
    /** The smallest angle of a triangle of the region, in degrees. */
    worstAngle: number;
    /** The triangle that has it. */
    worstTriangle: number | null;
    /** The smallest and largest mean curvature at free vertices, in 1 / length; negative on a sphere. */
    hInside: [number, number];
    /** The same at boundary vertices. */
    hBoundary: [number, number];
    /** The largest angle, in degrees, between a boundary normal and the triangles of the region there. */
    normalDeviation: number;
    /** The vertex that has it. */
    normalDeviationVertex: number | null;
    /** The root mean square of those angles. */
    normalDeviationRms: number;
    /** Wall seconds: half-edges and normals. */
    secondsSetup: number;
    /** The start surface. */
    secondsStart: number;
    /** The iterations. */
    secondsIterate: number;
    /** The figures. */
    secondsQuality: number;
    /** All of it. */
    secondsTotal: number;
    /** Pairs of intersecting triangles: the list INTERSECTIONS has two entries for each. The search ends at 10000. */
    intersectionCount: number;
    /** How many pairs there were in the input among the same triangles and the rest of the mesh; 0 if there are none now. */
    intersectionsInInput: number;
    /** Intersections were looked for, which is not done if the options say so or if the run was held up. */
    intersectionsChecked: boolean;
    /** The largest kink, in degrees: the angle at a boundary vertex between the mean normals of the triangles of the region and of those outside, or where nothing is outside, the boundary normal. */
    boundaryKink: number;
    /** The same in the input, at the same vertex. */
    boundaryKinkBefore: number;
    /** The vertex that has it; of a surface with a BOUNDARY_CREASE, the worst one of the crease. */
    boundaryKinkVertex: number | null;
    /** Size of the list CREASED_VERTICES. */
    creasedVertexCount: number;
    /** Components of the region, at least one; see `resultComponent`, `solverComponent`. */
    componentCount: number;
    /** Of NEAREST_MEMBER the w of its equation Delta_B H = -2 w H (H^2 - K), over 0 and at most 1, of several components the largest; otherwise 0. */
    memberWeight: number;
    /** Bending energy, the integral of H^2 over the free vertices, without unit; the sum of all components. */
    bendingEnergy: number;
}

/** What came of one component of the region: free vertices that are connected by edges, or lie around a fixed vertex inside the region whose normal is not given. Components are independent problems, each with the result that it has in a call where it alone is selected. */
export interface Component {
    /** A `outcome`. */
    outcome: Outcome;
    /** What the outcome CONVERGED_LOOSELY is about. */
    looseReason: LooseReason;
    /** Its surface is that of the linear problem. */
    linearSurface: boolean;
    /** Its free vertex with the smallest index. */
    vertex: number;
    /** Its free vertices. */
    freeVertices: number;
    /** Nonlinear iterations. */
    iterations: number;
    /** Defect of the equation, times its diagonal. */
    defect: number;
    /** The last step norm, in its diagonals; NaN if there was none. */
    step: number;
    /** The diagonal of its bounding box, in the unit of the positions. */
    diagonal: number;
    /** How much of the boundary normals or the target was reached, 0 to 1; 1 where all of it. */
    reached: number;
    /** Its flipped triangles. */
    flippedCount: number;
    /** Its triangles with an angle below one degree. */
    needleCount: number;
    /** The smallest angle of its triangles, in degrees. */
    worstAngle: number;
    /** The triangle that has it. */
    worstTriangle: number | null;
    /** The smallest and largest mean curvature at its free vertices, in 1 / length; negative on a sphere. */
    hInside: [number, number];
    /** The same at its boundary vertices. */
    hBoundary: [number, number];
    /** The largest angle, in degrees, between a boundary normal and its triangles there. */
    normalDeviation: number;
    /** The vertex that has it. */
    normalDeviationVertex: number | null;
    /** The root mean square of those angles. */
    normalDeviationRms: number;
    /** Of NEAREST_MEMBER the w of its equation Delta_B H = -2 w H (H^2 - K), over 0 and at most 1; otherwise 0. */
    memberWeight: number;
    /** Its bending energy, the integral of H^2 over its free vertices, without unit. */
    bendingEnergy: number;
    /** Attempts at its surface, see `resultAttempt`, `solverAttempt`; 0 for the paper's scheme. */
    attemptCount: number;
    /** Boundary loops whose curvature was to be continued, see `resultContinuity`, `solverContinuity`; 0 where the options' `continuity` is 0, no loop has surroundings and vertices enough, or no surface was found to begin with. */
    continuityCount: number;
}

/** An attempt at the surface of a component. Those on the coarse mesh decide where the fine one begins; of two sound surfaces there that differ the one of less bending energy is taken. */
export interface Attempt {
    /** A `attemptEnd`. */
    end: AttemptEnd;
    /** The free vertices of its mesh: fewer than the component's on the coarse mesh. */
    freeVertices: number;
    /** Nonlinear iterations. */
    iterations: number;
    /** The bending energy of its surface, without unit; NaN where it has none. */
    bendingEnergy: number;
    /** What was tried, in a few words of English, ending with a NUL. */
    name: string;
}

/** How far the surface continues the mean curvature of its surroundings along one boundary loop; curvatures in 1 / length. */
export interface Continuity {
    /** The boundary vertex of the loop with the smallest index. */
    vertex: number;
    /** The vertices of the loop. */
    vertexCount: number;
    /** How much of the way from the tangent-continuous surface's mean curvature to that of the surroundings was taken, in the mean along the loop: from 0 to `continuity` of the options. */
    reached: number;
    /** The jump of the mean curvature at the loop of the tangent-continuous surface, root mean square. */
    jumpBefore: number;
    /** The largest such jump. */
    largestJumpBefore: number;
    /** The jump of the mean curvature at the loop, root mean square. */
    jump: number;
    /** The largest jump. */
    largestJump: number;
    /** The root mean square of the mean curvature of the surroundings along the loop. */
    curvature: number;
    /** How uncertain that is, root mean square. Where it is no smaller than `jumpBefore`, there is nothing to be continued. */
    uncertainty: number;
}

/** What was done on one level of the paper's scheme. */
export interface Level {
    /** Vertices of the region: free and boundary. */
    vertices: number;
    /** Triangles of the region. */
    triangles: number;
    /** Updates of the mesh. */
    updates: number;
    /** The defect at the end. */
    defect: number;
}

/** The sizes of a result. */
export interface Info {
    /** A `resultKind`. */
    kind: ResultKind;
    /** Vertices of the mesh; 0 for loops, and for groups of them. */
    vertexCount: number;
    /** Triangles of the mesh; 0 for loops and groups of them, and where they are those given. */
    triangleCount: number;
    /** The last so many of the vertices are new. Of carried points how many there are. */
    newVertexCount: number;
    /** The last so many of the triangles are new. */
    newTriangleCount: number;
    /** Loops found, or filled (those that are joined count once), or left where triangles were erased; of joins the groups, of a bridged mesh the strip and the holes beside it. */
    loopCount: number;
    /** Boundary vertices with their normals, see FAIRMESH_VECTORS_BOUNDARY_NORMALS. */
    boundaryVertexCount: number;
    /** Of an erased mesh the triangles that were dropped besides those named, because they hung loose; of a trimmed one all that were taken away. */
    droppedCount: number;
    /** Of components how many there are. */
    componentCount: number;
    /** Of an erased mesh the triangles that were dropped because they would spoil the boundary of a patch. */
    cleanedCount: number;
    /** Of a trimmed mesh the area of what was taken away. */
    droppedArea: number;
}

/** What was taken for a bump or dent. Curvatures in 1 / length. */
export interface Bump {
    /** How many triangles it has. */
    triangleCount: number;
    /** How far its farthest corner is from the seed, along the surface. */
    radius: number;
    /** By how much its mean curvature departs from that of the surroundings (95 in 100 vertices by less). */
    departure: number;
    /** The mean curvature of the surroundings (the median). */
    surroundings: number;
    /** How much that scatters (standard deviation). */
    scatter: number;
}

/** A boundary loop. */
export interface Loop {
    /** A `loopKind`. */
    kind: LoopKind;
    /** Size of the list LOOP_VERTICES. */
    vertexCount: number;
    /** Size of the list LOOP_TOUCHING. */
    touchingCount: number;
    /** The sum of the edge lengths. */
    length: number;
    /** The length of the vector area. */
    area: number;
    /** The mean angle, in degrees, by which a smooth surface over the loop has to turn back: 0 for a hole in a plane, 90 for the end of a tube, 180 for the outer boundary of a plane sheet. */
    turn: number;
    /** The bad edge of a non-manifold loop, otherwise UINT32_MAX. */
    edgeA: number;
    /** Its other end. */
    edgeB: number;
    /** The component of the mesh that the loop is on, as `components` numbers them. */
    component: number;
    /** How many triangles that has. */
    componentTriangleCount: number;
    /** How rough the rim is was asked for (`rimRoughness`) and could be told, as the next seven say; otherwise these are 0. Where the mesh around the loop is too small, it cannot be told. */
    hasRoughness: boolean;
    /** The rim is noise, and the two advised options below draw it to the surface that the mesh has there on average. */
    isRough: boolean;
    /** `rimAngle` over `rimAngleExpected`, or over a degree or so, if that is more: about 1 where the mesh is clean. */
    roughness: number;
    /** The angle between the normals of the triangles at consecutive edges of the loop, in degrees, root mean square. */
    rimAngle: number;
    /** The angle that is expected there, by the surface fitted to what is around. */
    rimAngleExpected: number;
    /** The distance of the mesh around from that surface, root mean square. */
    rimNoise: number;
    /** What is advised for `relaxRim` of the fill options; 0: nothing. */
    advisedRelaxRings: number;
    /** What is advised for `relaxWithin`; 0 where nothing is. */
    advisedRelaxWithin: number;
}

/** Loops whose joint patch bends less than patches of their own would. Bends are sums over all edges of triangulations without new vertices, those of the loops included, of length times angle (radians); edges inside count half. */
export interface JoinSuggestion {
    /** What lies between the loops. */
    gapKind: GapKind;
    /** Size of the list JOINED_LOOPS. */
    loopCount: number;
    /** The bend of one patch for all of the loops. */
    jointBend: number;
    /** That of a patch for each. */
    separateBend: number;
    /** The area of the joint patch. */
    jointArea: number;
    /** That of the separate ones. */
    separateArea: number;
}

/** What became of a loop. */
export interface FillReport {
    /** A `fillOutcome`. */
    outcome: FillOutcome;
    /** A `fillReason`. */
    reason: FillReason;
    /** The `status` that the fairing was refused with, or OK. */
    refusedStatus: Status | null;
    /** The loop, as `boundaryLoops` numbers it; of several that are joined the first. */
    loopIndex: number;
    /** Its edges; of loops that are joined those of all. */
    edgeCount: number;
    /** The first new vertex, as an index of the filled mesh. */
    firstVertex: number;
    /** New vertices. */
    vertexCount: number;
    /** The first new triangle, as an index of the filled mesh. */
    firstTriangle: number;
    /** New triangles. */
    triangleCount: number;
    /** The smallest angle of the new triangles, in degrees. */
    worstAngle: number;
    /** New vertices that lie far outside the loop's bounding box: size of the list OUTSIDE_VERTICES. */
    outsideCount: number;
    /** `maxNewVertices` made the patch coarser. */
    coarsened: boolean;
    /** There is a report of the fairing, see `resultReport`. */
    hasReport: boolean;
    /** Wall seconds. */
    seconds: number;
    /** Pairs of intersecting triangles, at least one of each of this patch: the list INTERSECTIONS has two entries for each. */
    intersectionCount: number;
    /** The loops that the patch is for: size of the list JOINED_LOOPS, 1 if the loop is not joined to others. */
    joinedCount: number;
    /** What the reason names: of NON_MANIFOLD one end of the edge, of NOT_FINITE and SHARED_VERTEX the vertex, of OPPOSITE_SIDES one of the two loops; otherwise FAIRMESH_NO_ELEMENT. */
    reasonElement: number | null;
    /** Of NON_MANIFOLD the other end, of OPPOSITE_SIDES the other loop; otherwise FAIRMESH_NO_ELEMENT. */
    reasonOther: number | null;
    /** Where loops were joined by `FAIRMESH_JOIN_KIND_AUTO`, the bend of the joint patch, as in `joinSuggestion`; otherwise NaN, as the next three. */
    jointBend: number;
    /** That of a patch for each loop. */
    separateBend: number;
    /** The area of the joint patch. */
    jointArea: number;
    /** That of a patch for each loop. */
    separateArea: number;
    /** 1 where the boundary normals are those asked for. Less where no sound patch has them: so much of the way from the normals of a membrane to the averages of the mesh's. */
    normalsReached: number;
    /** Where loops were joined by `FAIRMESH_JOIN_KIND_AUTO`, a `gapKind`: what lies between them. */
    gapKind: GapKind;
    /** Vertices around the loop were allowed to move (`relaxRim`), and the next five say how far they did; otherwise these are 0. */
    hasRelaxed: boolean;
    /** How many vertices of the mesh moved. */
    movedCount: number;
    /** How far, root mean square. */
    movedRms: number;
    /** How far the one that moved furthest did. */
    movedLargest: number;
    /** The bound: none moved further. */
    movedWithin: number;
    /** How many triangles at vertices that moved are folded or, of the mesh, intersect since: none in a sound result. */
    movedUnsound: number;
}

/** What became of a bridge. */
export interface BridgeReport {
    /** There is nothing to be said of the result: what was to be faired converged, and no hole that was to be filled is open. */
    isClean: boolean;
    /** There is a report of the fairing of all that is new together. Unless its outcome is CONVERGED, the strip and the patches beside it are left as they were made. */
    hasWhole: boolean;
    /** By how much the strip is twisted from one chain to the other, in degrees between -180 and 180. */
    twist: number;
    /** Holes beside the strip that were filled, or tried. */
    restCount: number;
}

/** How far a run is. */
export interface Progress {
    /** Between 0 and 1, never falling. */
    fraction: number;
    /** Nonlinear iterations so far, of the component of the region that is at work. */
    iterations: number;
    /** Its last step norm, in its diagonals; NaN before the first iteration. */
    step: number;
    /** What is being done, in a word or two; English. Valid during the callback. */
    phase: string;
}

/** The plain ones of options. */
export interface PlainOptions {
    /** A `innerFairness`. Default: uniform. */
    innerFairness?: InnerFairness | undefined;
    /** A `interiorNormals`. Default: smooth. */
    interiorNormals?: InteriorNormals | undefined;
    /** A `discretization`. Default: second order. */
    discretization?: Discretization | undefined;
    /** A `solverKind`. Default: fast. */
    solver?: SolverKind | undefined;
    /** Worker threads, at most 1024; 0 (default): as many as the machine has. Any number gives the same bits. */
    threads?: number | undefined;
    /** Stop when the step norm (rms normal step + rms tangential step, over the diagonal of the component's bounding box) is below this. Default 1e-8; 1e-6 is enough for interactive use. At least 1e-15, less than 1. */
    tolerance?: number | undefined;
    /** At most this many nonlinear iterations for each component of the region. Default 500. At least 1. */
    maxIterations?: number | undefined;
    /** A `estimate`. This and what follows: for `FAIRMESH_SOLVER_KIND_PAPER` only. Default: alternating. */
    paperEstimate?: Estimate | undefined;
    /** Iterations of the estimate. Default 10. At least 1. */
    paperEstimateIterations?: number | undefined;
    /** The part of each normal step that is taken. Default 0.9. Greater than 0, at most 1. */
    paperDamping?: number | undefined;
    /** Levels of the hierarchy; 1: none; 0 (default): as many as make each level four times as large. */
    paperLevels?: number | undefined;
    /** Vertices of the base mesh; 0 (default): two and a half times the boundary. */
    paperBase?: number | undefined;
    /** Stop when `defect` of the report is at most this. Default 1e-6. Greater than 0. */
    paperDefect?: number | undefined;
    /** And when max |Delta_B H| times the cube of the diagonal is at most this. Default: infinite. Greater than 0. */
    paperLaplacian?: number | undefined;
    /** At most this many updates on all levels. Default 20000. At least 1. */
    paperMaxUpdates?: number | undefined;
    /** Whether the final surface is checked for self-intersections. Default: it is; that takes about a tenth of the run, at most a fifth. */
    intersections?: Intersections | undefined;
    /** What the result will be written in; moved positions are rounded to it, and the report is of the rounded surface. Default: double. Where `positionsOut` has floats, `fair` takes single. */
    outputPrecision?: OutputPrecision | undefined;
    /** How far the surface continues the mean curvature of its surroundings: from 0 (default: tangent planes alone, G1) to 1 (curvature, G2), as far as the surroundings are smooth enough to tell it; see `resultContinuity`. 0 for the paper's scheme. */
    continuity?: number | undefined;
}

/** The plain ones of fillOptions. */
export interface PlainFillOptions {
    /** Not 0 (default): patches are faired. */
    fair?: boolean | undefined;
    /** Holes of more edges stay open. Default: UINT64_MAX. */
    maxEdges?: number | undefined;
    /** How dense the new vertices are. At the square root of 2, the default, edges are as long as those beside the boundary; at twice that, half as long. Between 0.1 and 10. */
    density?: number | undefined;
    /** At most this many new vertices in all. Default 200000. No loop of n edges gets more than 1000 + n^2 of them, times the square of a density above 1. */
    maxNewVertices?: number | undefined;
    /** What a loop gets for which no fair patch is found. Zero (default): the best surface there is. */
    onFailure?: OnFailure | undefined;
    /** The loops of the list `loops` only, also where it is empty: then nothing is filled but groups of loops that are joined. */
    onlyListed?: boolean | undefined;
    /** So many rings of vertices around a loop, its own counted, may move onto the surface that the mesh has there on average, before it is filled: for boundaries that are noise. Zero (default): none. */
    relaxRim?: number | undefined;
    /** No vertex moves further than this, in the unit of the positions. Zero (default): the mean length of the edges around the loop. */
    relaxWithin?: number | undefined;
}

/** The plain ones of remeshOptions. */
export interface PlainRemeshOptions {
    /** As in `fillOptions`: at the default, edges are as long as those beside the region. */
    density?: number | undefined;
    /** At most this many vertices inside the region. Default 200000. */
    maxVertices?: number | undefined;
}

/** The surface of a frame. */
export interface Frame {
    /** 1 if its step norm is within the tolerance everywhere, else 0: further updates go on from here. */
    isSettled: number;
    /** Evaluations of the equations that it has cost. */
    evaluations: number;
    /** Its step norm, in diagonals of the bounding box: how far from the end it is, about. NaN before there is one. */
    step: number;
}

/** The amounts of a bulge between which sound surfaces were found. */
export interface BulgeRange {
    /** The smallest, not positive. */
    low: number;
    /** The largest, not negative. */
    high: number;
}

/** The plain ones of bridgeOptions. */
export interface PlainBridgeOptions {
    /** The holes that the strip leaves beside it are filled, too, and all that is new is faired together. Default: 0. */
    fill?: boolean | undefined;
    /** How long the chains shall be: each is made longer or shorter about its middle along its loop, to the vertices where that is met best. 0 (default): they are as given. */
    width?: number | undefined;
}

/** What functions take: structs by their addresses, results by the address of their place. */
export const functions = {
    fairmesh_status_name: ["i32"],
    fairmesh_status_text: ["i32"],
    fairmesh_status_remedy: ["i32"],
    fairmesh_outcome_name: ["u32"],
    fairmesh_outcome_text: ["u32"],
    fairmesh_outcome_remedy: ["u32"],
    fairmesh_loose_reason_name: ["u32"],
    fairmesh_loose_reason_text: ["u32"],
    fairmesh_loose_reason_remedy: ["u32"],
    fairmesh_attempt_end_name: ["u32"],
    fairmesh_attempt_end_text: ["u32"],
    fairmesh_attempt_end_remedy: ["u32"],
    fairmesh_fill_outcome_name: ["u32"],
    fairmesh_fill_outcome_text: ["u32"],
    fairmesh_fill_outcome_remedy: ["u32"],
    fairmesh_fill_reason_name: ["u32"],
    fairmesh_fill_reason_text: ["u32"],
    fairmesh_fill_reason_remedy: ["u32"],
    fairmesh_version: [],
    fairmesh_version_string: [],
    fairmesh_options_init: ["options", "size"],
    fairmesh_fill_options_init: ["fillOptions", "size"],
    fairmesh_bridge_options_init: ["bridgeOptions", "size"],
    fairmesh_remesh_options_init: ["remeshOptions", "size"],
    fairmesh_fair: ["mesh", "selection", "options", "pointsOut", "report", "pointer", "error"],
    fairmesh_mean_curvature: ["mesh", "scalarsOut", "error"],
    fairmesh_self_intersections: ["mesh", "indices", "pointer", "error"],
    fairmesh_solver_new: ["mesh", "selection", "options", "pointer", "error"],
    fairmesh_solver_run: ["pointer", "u64", "report", "error"],
    fairmesh_solver_set_boundary_normals: ["pointer", "boundaryNormals", "error"],
    fairmesh_solver_set_target: ["pointer", "target", "error"],
    fairmesh_solver_set_continuity: ["pointer", "f64", "loopContinuity", "error"],
    fairmesh_solver_set_boundary_curvature: ["pointer", "boundaryCurvature", "error"],
    fairmesh_solver_positions: ["pointer", "pointsOut", "error"],
    fairmesh_solver_mean_curvature: ["pointer", "scalarsOut", "error"],
    fairmesh_solver_report: ["pointer", "report", "error"],
    fairmesh_solver_component: ["pointer", "u64", "component", "error"],
    fairmesh_solver_attempt: ["pointer", "u64", "u64", "attempt", "error"],
    fairmesh_solver_continuity: ["pointer", "u64", "u64", "continuity", "error"],
    fairmesh_solver_result: ["pointer", "pointer", "error"],
    fairmesh_solver_free: ["pointer"],
    fairmesh_solver_edit: ["pointer", "edit", "size", "error"],
    fairmesh_solver_update: ["pointer", "budget", "frame", "error"],
    fairmesh_solver_finish: ["pointer", "report", "error"],
    fairmesh_solver_bulge_range: ["pointer", "bulgeRange", "error"],
    fairmesh_boundary_loops: ["mesh", "pointer", "error"],
    fairmesh_rim_roughness: ["mesh", "pointer", "error"],
    fairmesh_fill_holes: ["mesh", "fillOptions", "options", "pointer", "error"],
    fairmesh_suggest_joins: ["mesh", "fillOptions", "pointer", "error"],
    fairmesh_remesh: ["mesh", "selection", "remeshOptions", "pointer", "error"],
    fairmesh_refill: ["mesh", "selection", "fillOptions", "options", "pointer", "error"],
    fairmesh_erase: ["mesh", "indices", "pointer", "error"],
    fairmesh_erase_and_clean: ["mesh", "indices", "u64", "pointer", "error"],
    fairmesh_trim_boundary: ["mesh", "indices", "u64", "f64", "pointer", "error"],
    fairmesh_components: ["mesh", "pointer", "error"],
    fairmesh_carry_over: ["mesh", "indices", "points", "pointer", "error"],
    fairmesh_select_region: ["mesh", "regionStep", "size", "pointer", "error"],
    fairmesh_bridge: ["mesh", "indices", "indices", "bridgeOptions", "fillOptions", "options", "pointer", "error"],
    fairmesh_result_info: ["pointer", "info", "error"],
    fairmesh_result_report: ["pointer", "u64", "report", "error"],
    fairmesh_result_level: ["pointer", "u64", "level", "error"],
    fairmesh_result_component: ["pointer", "u64", "u64", "component", "error"],
    fairmesh_result_attempt: ["pointer", "u64", "u64", "u64", "attempt", "error"],
    fairmesh_result_continuity: ["pointer", "u64", "u64", "u64", "continuity", "error"],
    fairmesh_result_loop: ["pointer", "u64", "loop", "error"],
    fairmesh_result_fill_report: ["pointer", "u64", "fillReport", "error"],
    fairmesh_result_suggestion: ["pointer", "u64", "joinSuggestion", "error"],
    fairmesh_result_bridge: ["pointer", "bridgeReport", "error"],
    fairmesh_result_bump: ["pointer", "u64", "bump", "error"],
    fairmesh_result_positions: ["pointer", "pointsOut", "error"],
    fairmesh_result_triangles: ["pointer", "indicesOut", "error"],
    fairmesh_result_scalars: ["pointer", "u32", "scalarsOut", "error"],
    fairmesh_result_vectors: ["pointer", "u32", "pointsOut", "error"],
    fairmesh_result_list: ["pointer", "u32", "u64", "pointer", "size", "pointer", "error"],
    fairmesh_result_free: ["pointer"],
} as const;
