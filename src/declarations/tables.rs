//! All tables of the library, under the names that the C interface gives their enumerations.

use fairmesh::{
    AttemptEnd, BoundaryNormals, Coincident, Discretization, Entry, Error, Estimate, FillOutcome, FlatReason,
    GapKind, InnerFairness, InteriorNormals, Intersections, Join, LoopKind, LooseReason, OnFailure,
    OpenReason, Outcome, OutputPrecision, Place, Solver, Target,
};

#[path = "../capi/statuses.rs"]
mod statuses;

/// One enumeration.
pub struct Table {
    /// Its name in C.
    pub name: &'static str,
    /// What it says.
    pub doc: &'static str,
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

/// All of them.
pub fn all() -> Vec<Table> {
    let table = |name, doc, parts: &[&[Entry]], has_texts| {
        let mut entries = parts.concat();
        entries.sort_by_key(Entry::number);
        Table {
            name,
            doc,
            entries,
            has_texts,
        }
    };
    vec![
        table(
            "fairmesh_status",
            "Whether a call did what it was asked. How a solve ended is another matter, see `fairmesh_outcome`. After any \
             status but OK no output was written, except for the `fairmesh_error`.",
            &[statuses::STATUSES, Error::TABLE],
            true,
        ),
        table(
            "fairmesh_outcome",
            "How a run ended that did what it was asked. The positions are usable in every case.",
            &[Outcome::TABLE],
            true,
        ),
        table(
            "fairmesh_loose_reason",
            "What is to be said of a surface that converged loosely.",
            &[&[statuses::NONE], LooseReason::TABLE],
            true,
        ),
        table(
            "fairmesh_attempt_end",
            "How an attempt at a surface ended.",
            &[AttemptEnd::TABLE],
            true,
        ),
        table(
            "fairmesh_fill_outcome",
            "How the filling of a loop ended.",
            &[FillOutcome::TABLE],
            true,
        ),
        table(
            "fairmesh_fill_reason",
            "Why a loop was left open (numbers below 32) or a patch is flat.",
            &[&[statuses::NONE], OpenReason::TABLE, FlatReason::TABLE],
            true,
        ),
        table(
            "fairmesh_loop_kind",
            "What kind of gap a boundary loop is.",
            &[LoopKind::TABLE],
            false,
        ),
        table(
            "fairmesh_join_kind",
            "Which loops get one patch together.",
            &[Join::TABLE],
            false,
        ),
        table(
            "fairmesh_gap_kind",
            "What lies between loops that are joined.",
            &[GapKind::TABLE],
            false,
        ),
        table(
            "fairmesh_on_failure",
            "What a loop gets for which no fair patch is found, or none that does not intersect itself or the mesh.",
            &[OnFailure::TABLE],
            false,
        ),
        table(
            "fairmesh_place_kind",
            "A part of space.",
            &[&[statuses::EVERYWHERE], Place::TABLE],
            false,
        ),
        table(
            "fairmesh_boundary_normals_kind",
            "Where the normals at the boundary of the region come from.",
            &[BoundaryNormals::TABLE],
            false,
        ),
        table(
            "fairmesh_interior_normals",
            "Normals of fixed vertices inside the region that have none given.",
            &[InteriorNormals::TABLE],
            false,
        ),
        table(
            "fairmesh_coincident",
            "Whether vertices at the same place are one vertex of the surface.",
            &[Coincident::TABLE],
            false,
        ),
        table(
            "fairmesh_target_kind",
            "What the Laplacian of the mean curvature H has to be.",
            &[Target::TABLE],
            false,
        ),
        table(
            "fairmesh_inner_fairness",
            "How vertices are distributed within the surface.",
            &[InnerFairness::TABLE],
            false,
        ),
        table(
            "fairmesh_output_precision",
            "The precision of the numbers that a result will be written in.",
            &[OutputPrecision::TABLE],
            false,
        ),
        table(
            "fairmesh_discretization",
            "How normals and mean curvature are discretized.",
            &[Discretization::TABLE],
            false,
        ),
        table(
            "fairmesh_solver_kind",
            "How the equations are solved.",
            &[Solver::TABLE],
            false,
        ),
        table(
            "fairmesh_estimate",
            "How the paper's scheme estimates the mean curvature before the vertices are updated.",
            &[Estimate::TABLE],
            false,
        ),
        table(
            "fairmesh_intersections",
            "Whether a surface is checked for triangles that intersect each other or the rest of the mesh.",
            &[Intersections::TABLE],
            false,
        ),
    ]
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
