//! What is wrong with the input, and with which vertex or triangle.

use thiserror::Error;

use crate::support::table::table;

/// Squares of lengths have to fit a double: at most 12 times the square of this.
pub(crate) const LARGEST_COORDINATE: f64 = 1e153;

/// A vertex of the region may have this many triangles there. The matrix of the normal step has an entry for every two of its
/// neighbours, and factoring takes the cube of their number.
pub(crate) const MOST_VALENCE: usize = 1_000;

/// A number that is not written out with hundreds of zeros.
fn readable(value: f64) -> String {
    if value == 0.0 || (1e-4..1e16).contains(&value.abs()) || !value.is_finite() {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

/// Why a fairing problem was refused. Every number is an index into the caller's own arrays.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} names vertex {index}, but there are only {vertex_count} vertices")]
    IndexOutOfRange {
        /// The triangle.
        triangle: usize,
        /// The index it holds.
        index: u32,
        /// The number of vertices.
        vertex_count: usize,
    },
    /// A coordinate that is needed is NaN or infinite.
    #[error("vertex {vertex} has a coordinate that is not finite")]
    NotFinite {
        /// The vertex.
        vertex: usize,
    },
    /// A coordinate is so large that lengths of the mesh exceed the range of doubles.
    #[error(
        "vertex {vertex} has the coordinate {coordinate:e}: the largest that can be calculated with is {LARGEST_COORDINATE:e}"
    )]
    CoordinateTooLarge {
        /// The vertex.
        vertex: usize,
        /// Its coordinate of the largest magnitude.
        coordinate: f64,
    },
    /// A triangle names the same vertex twice.
    #[error("triangle {triangle} names vertex {vertex} twice")]
    RepeatedIndex {
        /// The triangle.
        triangle: usize,
        /// The vertex.
        vertex: usize,
    },
    /// Two triangles have the same three vertices.
    #[error("triangle {triangle} has the same vertices as triangle {other}")]
    DuplicateTriangle {
        /// The later triangle.
        triangle: usize,
        /// The earlier triangle.
        other: usize,
    },
    /// More than two triangles share an edge.
    #[error("edge ({a}, {b}) has more than two triangles, one of them triangle {triangle}")]
    NonManifoldEdge {
        /// One end of the edge, the smaller index.
        a: usize,
        /// The other end.
        b: usize,
        /// The last of the triangles.
        triangle: usize,
    },
    /// The triangles around a vertex are not one fan (a bow-tie).
    #[error("the triangles around vertex {vertex} do not form a single fan")]
    NonManifoldVertex {
        /// The vertex.
        vertex: usize,
    },
    /// Two neighbouring triangles run through their common edge in the same direction.
    #[error("triangles {other} and {triangle} run through edge ({a}, {b}) in the same direction")]
    InconsistentOrientation {
        /// One end of the edge, the smaller index.
        a: usize,
        /// The other end.
        b: usize,
        /// The later triangle.
        triangle: usize,
        /// The earlier triangle.
        other: usize,
    },
    /// The triangles cannot all face the same way: the surface has one side only.
    #[error(
        "the component of triangle {triangle} has one side only, as a Moebius strip: its triangles cannot be oriented consistently"
    )]
    NotOrientable {
        /// A triangle of that component, at which the contradiction was found.
        triangle: usize,
    },
    /// A free vertex lies on the boundary of the mesh itself.
    #[error("free vertex {vertex} lies on the boundary of the mesh; fix it or leave it out of the selection")]
    FreeVertexOnBoundary {
        /// The vertex.
        vertex: usize,
    },
    /// A free vertex belongs to no triangle.
    #[error("free vertex {vertex} belongs to no triangle")]
    FreeVertexWithoutTriangle {
        /// The vertex.
        vertex: usize,
    },
    /// A connected component of the region has no fixed vertex.
    #[error("nothing is fixed in the component of vertex {vertex}")]
    NothingFixed {
        /// A free vertex of that component, the one with the smallest index.
        vertex: usize,
    },
    /// No vertex is free.
    #[error("no vertex is free: the selection holds no vertex all of whose triangles may move")]
    EmptyRegion,
    /// A selection names a vertex or triangle that does not exist.
    #[error("the selection names element {index}, but there are only {count}")]
    SelectionOutOfRange {
        /// The index named.
        index: usize,
        /// The number of vertices or triangles.
        count: usize,
    },
    /// A mask has another length than what it masks.
    #[error("the mask has {length} entries, but there are {count} elements")]
    MaskLength {
        /// The mask's length.
        length: usize,
        /// The number of vertices or triangles.
        count: usize,
    },
    /// A prescribed normal is not finite or not of length one (to 1e-3), or those of copies of the vertex cancel.
    #[error(
        "the normal given for vertex {vertex} is not a finite unit vector, or contradicts that of a coincident vertex"
    )]
    BadNormal {
        /// The vertex.
        vertex: usize,
    },
    /// A boundary vertex has no normal: none was given, and none can be computed from its triangles.
    #[error("no normal can be found for boundary vertex {vertex}: its triangles have no area; prescribe one")]
    NoNormal {
        /// The vertex.
        vertex: usize,
    },
    /// A number is given for the boundary loop through a vertex, but none goes through it.
    #[error("vertex {vertex} is on no boundary loop of the region")]
    NotOnLoop {
        /// The vertex.
        vertex: usize,
    },
    /// A guide of [`FillOptions::guides`](crate::FillOptions::guides) cannot be followed.
    #[error("guide ({a}, {b}): {why}")]
    BadGuide {
        /// One end of the guide, as given.
        a: usize,
        /// The other end.
        b: usize,
        /// What speaks against it.
        why: &'static str,
    },
    /// A chain that a bridge shall begin or end at is no run of boundary edges.
    #[error("chain {chain}, vertex {vertex}: {why}")]
    BadChain {
        /// 0 for the first chain, 1 for the second.
        chain: usize,
        /// A vertex of it, as given.
        vertex: usize,
        /// What is wrong there.
        why: &'static str,
    },
    /// What is named as an edge that two triangles share is none.
    #[error("({a}, {b}) is no edge between two triangles")]
    NotAnEdge {
        /// One vertex, as given.
        a: usize,
        /// The other one.
        b: usize,
    },
    /// No crease of the mesh is to be rounded.
    #[error("no edge bends enough to be rounded")]
    NoCrease,
    /// An edit of a solver cannot be made.
    #[error("edit {edit}{}: {why}", vertex.map_or(String::new(), |v| format!(", vertex {v}")))]
    BadEdit {
        /// Its place in the list, from 0.
        edit: usize,
        /// The vertex that it is about, if it is about a single one.
        vertex: Option<usize>,
        /// What is wrong with it.
        why: &'static str,
    },
    /// Nothing tells where a bump ends.
    #[error("no bump is found there: {why}")]
    NoBump {
        /// What was missing.
        why: &'static str,
    },
    /// Two guides cross each other in the patch.
    #[error("guides ({}, {}) and ({}, {}) cross each other", first[0], first[1], second[0], second[1])]
    GuidesCross {
        /// One of them, as given.
        first: [usize; 2],
        /// The other one.
        second: [usize; 2],
    },
    /// A vertex has more than 1,000 region triangles: every two of its neighbours are an entry of the solver's matrix.
    #[error(
        "vertex {vertex} has {valence} triangles in the region: more than {}",
        MOST_VALENCE
    )]
    ValenceTooLarge {
        /// The vertex.
        vertex: usize,
        /// How many triangles of the region it has.
        valence: usize,
    },
    /// An option is outside its range.
    #[error("option {name} is {}: it must be {range}", readable(*.value))]
    BadOption {
        /// The option's name: that of its field, after `paper_` where it is one of [`PaperOptions`](crate::PaperOptions).
        name: &'static str,
        /// The value given.
        value: f64,
        /// The values allowed.
        range: &'static str,
    },
    /// The region is too large for 32-bit indices.
    #[error("the mesh has {count} {what}: more than 32-bit indices can name")]
    TooLarge {
        /// "vertices" or "triangles".
        what: &'static str,
        /// How many.
        count: usize,
    },
    /// The worker threads could not be started.
    #[error("could not start {threads} threads: {why}")]
    Threads {
        /// The number asked for.
        threads: usize,
        /// The system's reason.
        why: String,
    },
}

// The numbers are those of the C interface's statuses, which has more of its own.
table!(Error {
    4 "bad_option" Error::BadOption { .. } => "an option is out of its range", "";
    8 "count_mismatch" Error::MaskLength { .. } => "two counts differ that have to be the same", "";
    13 "threads" Error::Threads { .. } => "the system gave no more threads", "ask for fewer, or close other programs";
    14 "too_large" Error::TooLarge { .. } => "more vertices or triangles than 32-bit indices can name", "";
    15 "not_finite" Error::NotFinite { .. } =>
        "a coordinate that is needed is NaN or infinite, or does not fit a float on its way out",
        "repair the vertex, or choose a region away from it";
    16 "index_out_of_range" Error::IndexOutOfRange { .. } =>
        "a triangle names a vertex that does not exist", "repair the mesh";
    17 "repeated_index" Error::RepeatedIndex { .. } => "a triangle names a vertex twice", "remove the degenerate triangles first";
    18 "duplicate_triangle" Error::DuplicateTriangle { .. } =>
        "two triangles have the same vertices", "remove the duplicate triangles first";
    19 "non_manifold_edge" Error::NonManifoldEdge { .. } =>
        "more than two triangles share an edge", "repair the mesh there, or choose a region away from it";
    20 "non_manifold_vertex" Error::NonManifoldVertex { .. } =>
        "the triangles around a vertex are not one fan", "repair the mesh there, or choose a region away from it";
    21 "inconsistent_orientation" Error::InconsistentOrientation { .. } =>
        "two triangles run through an edge in the same direction", "turn triangles around, so that all face the same way";
    22 "free_vertex_on_boundary" Error::FreeVertexOnBoundary { .. } =>
        "a free vertex is on the boundary of the mesh", "leave it out of the selection";
    23 "free_vertex_without_triangle" Error::FreeVertexWithoutTriangle { .. } =>
        "a free vertex has no triangle", "leave it out of the selection";
    24 "nothing_fixed" Error::NothingFixed { .. } =>
        "a component of the region has no fixed vertex", "leave some of its vertices out of the selection";
    25 "empty_region" Error::EmptyRegion =>
        "no vertex is free", "select more faces: a vertex is free if all faces around it are selected";
    26 "selection_out_of_range" Error::SelectionOutOfRange { .. } => "the selection names what does not exist", "";
    27 "bad_normal" Error::BadNormal { .. } => "a normal is not a finite vector of length one (to 0.001), or contradicts that of a coincident vertex", "";
    28 "no_normal" Error::NoNormal { .. } => "no normal can be found for a boundary vertex", "give one";
    32 "coordinate_too_large" Error::CoordinateTooLarge { .. } =>
        "a coordinate is so large that lengths exceed the range of doubles", "scale the mesh down";
    33 "valence_too_large" Error::ValenceTooLarge { .. } =>
        "a vertex has more than 1,000 triangles in the region", "split some of its edges, or leave its neighbours out of the selection";
    34 "not_on_loop" Error::NotOnLoop { .. } => "a vertex is on no boundary loop of the region", "name a fixed vertex beside a free one";
    35 "bad_guide" Error::BadGuide { .. } =>
        "a guide does not join two vertices of the boundary that one patch can have an edge between",
        "name two vertices of one loop that are no neighbours, or of two loops that are joined, each in one guide";
    36 "guides_cross" Error::GuidesCross { .. } => "two guides cross each other", "leave one of them out";
    37 "bad_chain" Error::BadChain { .. } =>
        "a chain is no run of edges of one boundary loop", "name the vertices of a run of boundary edges, one after the other";
    39 "no_bump" Error::NoBump { .. } =>
        "nothing tells where a bump ends", "say the region by its radius or by a list";
    40 "bad_edit" Error::BadEdit { .. } =>
        "an edit of a solver has a number that is not finite, or moves a free vertex", "name fixed vertices";
    41 "not_orientable" Error::NotOrientable { .. } =>
        "a component has one side only, as a Moebius strip", "cut it open, or leave it out";
    43 "not_an_edge" Error::NotAnEdge { .. } =>
        "two vertices are named as an edge between two triangles, and are none", "name neighbouring vertices";
    44 "no_crease" Error::NoCrease => "no edge bends enough to be rounded", "say from which angle on edges are creases, or name them";
});

impl Error {
    /// Refuses an option that is not `allowed`.
    pub(crate) fn check_option(
        name: &'static str,
        value: f64,
        allowed: bool,
        range: &'static str,
    ) -> Result<(), Self> {
        match allowed {
            true => Ok(()),
            false => Err(Self::BadOption { name, value, range }),
        }
    }

    /// The same error, with other numbers of vertices and triangles.
    pub(crate) fn renumbered(
        mut self,
        vertex_id: impl Fn(usize) -> usize,
        triangle_id: impl Fn(usize) -> usize,
    ) -> Self {
        match &mut self {
            Self::NotFinite { vertex }
            | Self::NonManifoldVertex { vertex }
            | Self::FreeVertexOnBoundary { vertex }
            | Self::FreeVertexWithoutTriangle { vertex }
            | Self::NothingFixed { vertex }
            | Self::BadNormal { vertex }
            | Self::NoNormal { vertex }
            | Self::NotOnLoop { vertex }
            | Self::CoordinateTooLarge { vertex, .. }
            | Self::ValenceTooLarge { vertex, .. } => *vertex = vertex_id(*vertex),
            Self::NotOrientable { triangle } => *triangle = triangle_id(*triangle),
            Self::RepeatedIndex { triangle, vertex } => {
                (*triangle, *vertex) = (triangle_id(*triangle), vertex_id(*vertex));
            }
            Self::DuplicateTriangle { triangle, other } => {
                (*triangle, *other) = (triangle_id(*triangle), triangle_id(*other));
            }
            Self::NonManifoldEdge { a, b, triangle } => {
                (*a, *b, *triangle) = (vertex_id(*a), vertex_id(*b), triangle_id(*triangle));
            }
            Self::InconsistentOrientation {
                a,
                b,
                triangle,
                other,
            } => {
                (*a, *b) = (vertex_id(*a), vertex_id(*b));
                (*triangle, *other) = (triangle_id(*triangle), triangle_id(*other));
            }
            Self::IndexOutOfRange { .. }
            | Self::EmptyRegion
            | Self::SelectionOutOfRange { .. }
            | Self::MaskLength { .. }
            | Self::BadOption { .. }
            | Self::BadGuide { .. }
            | Self::NotAnEdge { .. }
            | Self::NoCrease
            | Self::GuidesCross { .. }
            | Self::BadChain { .. }
            | Self::NoBump { .. }
            | Self::BadEdit { .. }
            | Self::TooLarge { .. }
            | Self::Threads { .. } => {}
        }
        self
    }
}
