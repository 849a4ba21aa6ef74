//! All tables of the library, under the names that the C interface gives their enumerations.

use fairmesh::{
    AttemptEnd, BoundaryNormals, Cap, Coincident, Creases, Discretization, Entry, Error, FillOutcome,
    FlatReason, GapKind, InnerFairness, InteriorNormals, Intersections, Join, LoopKind, LooseReason,
    OnFailure, OpenReason, Outcome, OutputPrecision, Place, SharpFate, Target,
};

#[path = "../capi/statuses.rs"]
mod statuses;

/// One enumeration.
pub struct Table {
    /// Its name in C.
    pub name: &'static str,
    /// What it says.
    pub doc: &'static str,
    /// The tables that it is made of, in Rust.
    pub parts: &'static str,
    /// Its values, by their numbers.
    pub entries: Vec<Entry>,
    /// Whether programs can ask for the texts of a value.
    pub has_texts: bool,
}

/// Every outcome once, with whatever it tells left empty.
pub fn outcomes() -> Vec<Outcome> {
    let outcomes = vec![
        Outcome::Converged,
        Outcome::ConvergedPoorTriangles {
            triangles: Vec::new(),
        },
        Outcome::ConvergedLoosely {
            reason: LooseReason::Rounding,
        },
        Outcome::TargetNotReachable { reached: 0.0 },
        Outcome::NotConverged,
        Outcome::IterationLimit,
        Outcome::Cancelled,
        Outcome::BoundaryCrease { vertices: Vec::new() },
        Outcome::SelfIntersecting { pairs: 0 },
        Outcome::PoorWhenRounded {
            triangles: Vec::new(),
        },
        Outcome::NearestMember { weight: 0.0 },
    ];
    let entries: Vec<Entry> = outcomes.iter().map(|outcome| *outcome.entry()).collect();
    assert_eq!(entries, Outcome::TABLE);
    outcomes
}

/// The list of all: of each enumeration what it says, its name, whether programs can ask for the texts of a value, and its tables.
macro_rules! tables {
    ($(#[doc = $doc:literal] $name:ident $(with $texts:ident)?: $($part:expr),+;)*) => {
        vec![$(Table {
            name: stringify!($name),
            doc: $doc.trim(),
            parts: stringify!($($part),+),
            entries: by_number(&[$($part),+]),
            has_texts: stringify!($($texts)?) == "texts",
        }),*]
    };
}

/// All of them.
pub fn all() -> Vec<Table> {
    tables! {
        /// Whether a call did what it was asked. How a solve ended is another matter, see `fairmesh_outcome`. After any status but OK no output was written, except for the `fairmesh_error`.
        fairmesh_status with texts: statuses::STATUSES, Error::TABLE;
        /// How a run ended that did what it was asked. The positions are usable in every case.
        fairmesh_outcome with texts: Outcome::TABLE;
        /// What is to be said of a surface that converged loosely.
        fairmesh_loose_reason with texts: &[statuses::NONE], LooseReason::TABLE;
        /// How an attempt at a surface ended.
        fairmesh_attempt_end with texts: AttemptEnd::TABLE;
        /// How the filling of a loop ended.
        fairmesh_fill_outcome with texts: FillOutcome::TABLE;
        /// Why a loop was left open (numbers below 32) or a patch is flat.
        fairmesh_fill_reason with texts: &[statuses::NONE], OpenReason::TABLE, FlatReason::TABLE;
        /// What kind of gap a boundary loop is.
        fairmesh_loop_kind with texts: LoopKind::TABLE;
        /// Which loops get one patch together.
        fairmesh_join_kind: Join::TABLE;
        /// What lies between loops that are joined.
        fairmesh_gap_kind with texts: GapKind::TABLE;
        /// What became of ends of sharp edges that belong together.
        fairmesh_sharp_fate with texts: SharpFate::TABLE;
        /// What a loop gets whose patch is no success: not fair, creased, intersecting, or with any other reservation.
        fairmesh_on_failure: OnFailure::TABLE;
        /// What closes a loop that lies in a plane.
        fairmesh_cap: Cap::TABLE;
        /// Which creases are rounded.
        fairmesh_creases: Creases::TABLE;
        /// A part of space.
        fairmesh_place_kind: &[statuses::EVERYWHERE], Place::TABLE;
        /// Where the normals at the boundary of the region come from.
        fairmesh_boundary_normals_kind: BoundaryNormals::TABLE;
        /// Normals of fixed vertices inside the region that have none given.
        fairmesh_interior_normals: InteriorNormals::TABLE;
        /// Whether vertices at the same place are one vertex of the surface.
        fairmesh_coincident: Coincident::TABLE;
        /// What the Laplacian of the mean curvature H has to be.
        fairmesh_target_kind: Target::TABLE;
        /// How vertices are distributed within the surface.
        fairmesh_inner_fairness: InnerFairness::TABLE;
        /// The precision of the numbers that a result will be written in.
        fairmesh_output_precision: OutputPrecision::TABLE;
        /// How normals and mean curvature are discretized.
        fairmesh_discretization: Discretization::TABLE;
        /// Whether a surface is checked for triangles that intersect each other or the rest of the mesh.
        fairmesh_intersections: Intersections::TABLE;
    }
}

fn by_number(parts: &[&[Entry]]) -> Vec<Entry> {
    let mut entries = parts.concat();
    entries.sort_by_key(Entry::number);
    entries
}

/// A text of a table as a sentence.
pub fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|c| c.to_ascii_uppercase());
    first.into_iter().chain(letters).chain(['.']).collect()
}

/// The name of a value in Rust: `self_intersecting` is `SelfIntersecting`.
pub fn variant(name: &str) -> String {
    name.split('_')
        .map(|word| word[..1].to_uppercase() + &word[1..])
        .collect()
}
