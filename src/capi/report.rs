//! Reports as structs of the header.

use super::status::{FAIRMESH_NO_ELEMENT, Failure, Text, fairmesh_status};
use super::types::*;
use fairmesh::{Attempt, ComponentReport, CreaseEnd, CurvatureContinuity};
use fairmesh::{BoundaryLoop, FillOutcome, FlatReason, LoopKind, LoopReport, OpenReason};
use fairmesh::{Bridged, CreaseChain, JoinReason, JoinSuggestion};
use fairmesh::{Bump, Outcome, Report, Rim, Roughness, SharpEdge};

/// The report of a fairing.
pub(crate) fn report(of: &Report) -> fairmesh_report {
    let quality = &of.quality;
    fairmesh_report {
        struct_size: size_of::<fairmesh_report>() as u32,
        outcome: of.outcome.entry().number(),
        loose_reason: loose_reason(&of.outcome),
        least_bending: u32::from(of.least_bending),
        iterations: of.iterations as u64,
        defect: of.defect,
        step: of.step,
        diagonal: of.diagonal,
        reached: reached(&of.outcome),
        free_vertices: of.free_vertices as u64,
        fallback_weights: of.fallback_weights as u64,
        poor_triangle_count: poor(of).len() as u64,
        flipped_count: quality.flipped.len() as u64,
        needle_count: quality.needles.len() as u64,
        suspicious_normal_count: of.suspicious_normals.len() as u64,
        worst_angle: quality.worst_angle,
        worst_triangle: quality.worst_triangle as u64,
        sharpest_edge: quality.sharpest_edge,
        sharpest_edge_from: quality.sharpest_edge_vertices[0] as u64,
        sharpest_edge_to: quality.sharpest_edge_vertices[1] as u64,
        h_inside: quality.h_inside,
        h_boundary: quality.h_boundary,
        normal_deviation: quality.normal_deviation,
        normal_deviation_vertex: quality.normal_deviation_vertex as u64,
        normal_deviation_rms: quality.normal_deviation_rms,
        seconds_setup: of.seconds.setup,
        seconds_start: of.seconds.start,
        seconds_iterate: of.seconds.iterate,
        seconds_quality: of.seconds.quality,
        seconds_total: of.seconds.total,
        intersection_count: intersections(of).len() as u64,
        intersections_in_input: of.self_intersections.as_ref().map_or(0, |found| found.in_input) as u64,
        intersections_checked: u32::from(of.self_intersections.is_some()),
        reserved: 0,
        boundary_kink: quality.boundary_kink,
        boundary_kink_before: quality.boundary_kink_before,
        boundary_kink_vertex: quality.boundary_kink_vertex as u64,
        creased_vertex_count: creased(of).len() as u64,
        component_count: of.components.len() as u64,
        member_weight: member_weight(&of.outcome),
        bending_energy: quality.bending_energy,
        sharp_edge_count: of.sharp_edges.len() as u64,
    }
}

/// One component of the region.
pub(crate) fn component(of: &ComponentReport) -> fairmesh_component {
    let quality = &of.quality;
    fairmesh_component {
        struct_size: size_of::<fairmesh_component>() as u32,
        outcome: of.outcome.entry().number(),
        loose_reason: loose_reason(&of.outcome),
        least_bending: u32::from(of.least_bending),
        vertex: of.vertex as u64,
        free_vertices: of.free_vertices as u64,
        iterations: of.iterations as u64,
        defect: of.defect,
        step: of.step,
        diagonal: of.diagonal,
        reached: reached(&of.outcome),
        flipped_count: quality.flipped.len() as u64,
        needle_count: quality.needles.len() as u64,
        worst_angle: quality.worst_angle,
        worst_triangle: quality.worst_triangle as u64,
        sharpest_edge: quality.sharpest_edge,
        sharpest_edge_from: quality.sharpest_edge_vertices[0] as u64,
        sharpest_edge_to: quality.sharpest_edge_vertices[1] as u64,
        h_inside: quality.h_inside,
        h_boundary: quality.h_boundary,
        normal_deviation: quality.normal_deviation,
        normal_deviation_vertex: quality.normal_deviation_vertex as u64,
        normal_deviation_rms: quality.normal_deviation_rms,
        member_weight: member_weight(&of.outcome),
        bending_energy: quality.bending_energy,
        attempt_count: of.attempts.len() as u64,
        continuity_count: of.continuity.len() as u64,
    }
}

/// One attempt at the surface of a component.
pub(crate) fn attempt(of: &Attempt) -> fairmesh_attempt {
    fairmesh_attempt {
        struct_size: size_of::<fairmesh_attempt>() as u32,
        end: of.end.entry().number(),
        free_vertices: of.free_vertices as u64,
        iterations: of.iterations as u64,
        bending_energy: of.bending_energy,
        name: Text::new(format_args!("{}", of.name)).characters(),
    }
}

/// What came of the continuity of curvature along one boundary loop.
pub(crate) fn continuity(of: &CurvatureContinuity) -> fairmesh_continuity {
    fairmesh_continuity {
        struct_size: size_of::<fairmesh_continuity>() as u32,
        reserved: 0,
        vertex: of.vertex as u64,
        vertex_count: of.vertices as u64,
        asked: of.asked,
        reached: of.reached,
        jump_before: of.jump_before,
        largest_jump_before: of.largest_jump_before,
        jump: of.jump,
        largest_jump: of.largest_jump,
        curvature: of.curvature,
        uncertainty: of.uncertainty,
    }
}

/// What became of one sharp edge, by its number.
pub(crate) fn sharp_edge(of: &[SharpEdge], number: usize) -> fairmesh_sharp_edge {
    let edge = &of[number];
    fairmesh_sharp_edge {
        struct_size: size_of::<fairmesh_sharp_edge>() as u32,
        fate: edge.fate.entry().number(),
        end_count: edge.ends.len() as u64,
        vertex_count: edge.vertices.len() as u64,
        first_vertex: sharp_vertices(&of[..number]).len() as u64,
    }
}

/// Where it arrives at the boundary.
pub(crate) fn crease_end(of: &CreaseEnd) -> fairmesh_crease_end {
    let [normal_left, normal_right] = of.normals;
    fairmesh_crease_end {
        struct_size: size_of::<fairmesh_crease_end>() as u32,
        reserved: 0,
        vertex: u64::from(of.vertex),
        angle: of.angle,
        error: of.error,
        direction: of.direction,
        normal_left,
        normal_right,
    }
}

/// The vertices along sharp edges, one after the other.
pub(crate) fn sharp_vertices(of: &[SharpEdge]) -> Vec<u32> {
    of.iter().flat_map(|edge| &edge.vertices).copied().collect()
}

pub(crate) fn poor(of: &Report) -> &[u32] {
    match &of.outcome {
        Outcome::ConvergedPoorTriangles { triangles } | Outcome::PoorWhenRounded { triangles } => triangles,
        _ => &[],
    }
}

/// Pairs of intersecting triangles.
pub(crate) fn intersections(of: &Report) -> &[[u32; 2]] {
    of.self_intersections.as_ref().map_or(&[], |found| &found.pairs)
}

pub(crate) fn creased(of: &Report) -> &[u32] {
    match &of.outcome {
        Outcome::BoundaryCrease { vertices } => vertices,
        _ => &[],
    }
}

/// How much of the target was reached.
fn reached(of: &Outcome) -> f64 {
    match of {
        Outcome::TargetNotReachable { reached } => *reached,
        Outcome::NotConverged => 0.0,
        _ => 1.0,
    }
}

/// Which member of the family between the harmonic target and that of minimal energy the surface is; 0: harmonic.
fn member_weight(of: &Outcome) -> f64 {
    match of {
        Outcome::NearestMember { weight } => *weight,
        _ => 0.0,
    }
}

/// The number of a `fairmesh_loose_reason`.
fn loose_reason(of: &Outcome) -> u32 {
    match of {
        Outcome::ConvergedLoosely { reason } => reason.entry().number(),
        _ => fairmesh_loose_reason::None as u32,
    }
}

/// A loop, and how rough its rim is, where that is known.
pub(crate) fn boundary_loop(of: &BoundaryLoop, rough: Option<&Roughness>) -> fairmesh_loop {
    let told = |value: fn(&Roughness) -> f64| rough.map_or(0.0, value);
    let advice = rough.and_then(|rough| rough.advice).unwrap_or_default();
    let (edge_a, edge_b) = match of.kind {
        LoopKind::NonManifold { a, b } | LoopKind::Inconsistent { a, b } => (a, b),
        _ => (u32::MAX, u32::MAX),
    };
    fairmesh_loop {
        struct_size: size_of::<fairmesh_loop>() as u32,
        kind: of.kind.entry().number(),
        vertex_count: of.vertices.len() as u64,
        touching_count: of.touching.len() as u64,
        length: of.length,
        area: of.area,
        turn: of.turn,
        edge_a,
        edge_b,
        component: of.component as u64,
        component_triangle_count: of.component_triangles as u64,
        has_roughness: u32::from(rough.is_some()),
        is_rough: u32::from(advice != Rim::default()),
        roughness: told(Roughness::ratio),
        rim_angle: told(|rough| rough.angle),
        rim_angle_expected: told(|rough| rough.expected),
        rim_noise: told(|rough| rough.noise),
        advised_relax_rim: advice.relax as u64,
        advised_relax_within: advice.within.unwrap_or(0.0),
    }
}

pub(crate) fn suggestion(of: &JoinSuggestion) -> fairmesh_join_suggestion {
    fairmesh_join_suggestion {
        struct_size: size_of::<fairmesh_join_suggestion>() as u32,
        gap_kind: of.reason.kind.entry().number(),
        loop_count: of.loops.len() as u64,
        joint_bend: of.reason.joint_bend,
        separate_bend: of.reason.separate_bend,
        joint_area: of.reason.joint_area,
        separate_area: of.reason.separate_area,
    }
}

pub(crate) fn bridge(of: &Bridged) -> fairmesh_bridge_report {
    fairmesh_bridge_report {
        struct_size: size_of::<fairmesh_bridge_report>() as u32,
        has_whole: u32::from(of.whole.is_some()),
        twist: of.twist,
        rest_count: of.rest.len() as u64,
    }
}

/// What of the mesh the reason for leaving a loop open is about.
fn named(reason: &OpenReason) -> [u64; 2] {
    match reason {
        OpenReason::NonManifold { a, b } | OpenReason::Inconsistent { a, b } => {
            [u64::from(*a), u64::from(*b)]
        }
        OpenReason::NotFinite { vertex }
        | OpenReason::SharedVertex { vertex }
        | OpenReason::Hanging { vertex } => [u64::from(*vertex), FAIRMESH_NO_ELEMENT],
        OpenReason::OppositeSides { a, b } => [*a as u64, *b as u64],
        _ => [FAIRMESH_NO_ELEMENT; 2],
    }
}

pub(crate) fn crease(of: &CreaseChain) -> fairmesh_crease {
    let narrowed = of.narrowed;
    fairmesh_crease {
        struct_size: size_of::<fairmesh_crease>() as u32,
        is_rounded: u32::from(of.is_rounded),
        is_unsolved: u32::from(of.unsolved.is_some()),
        reserved: 0,
        vertex_count: of.vertices.len() as u64,
        bend: of.bend,
        part: narrowed.map_or(1.0, |of| of.part),
        narrowest: narrowed.map_or([0.0; 3], |of| of.place),
        unsolved: of.unsolved.unwrap_or_default(),
    }
}

pub(crate) fn filled_loop(of: &LoopReport) -> fairmesh_fill_report {
    let mut refused = fairmesh_status::Ok;
    let rim = of.rim.clone().unwrap_or_default();
    let [reason_element, reason_other] = match &of.outcome {
        FillOutcome::LeftOpen(reason) => named(reason),
        _ => [FAIRMESH_NO_ELEMENT; 2],
    };
    let bend = |value: fn(&JoinReason) -> f64| of.joined.as_ref().map_or(f64::NAN, value);
    let reason = match &of.outcome {
        FillOutcome::Flat { reason } => {
            if let FlatReason::Refused(error) = reason {
                refused = Failure::from(error.clone()).status;
            }
            reason.entry().number()
        }
        FillOutcome::LeftOpen(reason) => reason.entry().number(),
        _ => fairmesh_fill_reason::None as u32,
    };
    fairmesh_fill_report {
        struct_size: size_of::<fairmesh_fill_report>() as u32,
        outcome: of.outcome.entry().number(),
        reason,
        refused_status: refused as i32,
        loop_index: of.index as u64,
        edge_count: of.edges as u64,
        first_vertex: u64::from(of.vertices.start),
        vertex_count: u64::from(of.vertices.end - of.vertices.start),
        first_triangle: u64::from(of.triangles.start),
        triangle_count: u64::from(of.triangles.end - of.triangles.start),
        worst_angle: of.worst_angle,
        outside_count: of.outside.len() as u64,
        coarsened: u32::from(of.coarsened),
        has_report: u32::from(of.fairing.is_some()),
        is_success: u32::from(of.is_success()),
        reserved: 0,
        seconds: of.seconds,
        intersection_count: of.self_intersections.len() as u64,
        joined_count: of.loops.len() as u64,
        reason_element,
        reason_other,
        joint_bend: bend(|reason| reason.joint_bend),
        separate_bend: bend(|reason| reason.separate_bend),
        joint_area: bend(|reason| reason.joint_area),
        separate_area: bend(|reason| reason.separate_area),
        normals_reached: of.normals_reached,
        gap_kind: of
            .joined
            .as_ref()
            .map_or(0, |reason| reason.kind.entry().number()),
        has_relaxed: u32::from(of.rim.is_some()),
        moved_count: rim.moved as u64,
        moved_rms: rim.rms,
        moved_largest: rim.largest,
        moved_within: rim.within,
        moved_unsound: (rim.folded + 2 * rim.self_intersections.len()) as u64,
    }
}

/// What is told of a bump.
pub(crate) fn bump(of: &Bump) -> fairmesh_bump {
    fairmesh_bump {
        struct_size: size_of::<fairmesh_bump>() as u32,
        reserved: 0,
        triangle_count: of.triangles as u64,
        radius: of.radius,
        height: of.height,
        uncertainty: of.uncertainty,
    }
}
