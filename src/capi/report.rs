//! Reports as structs of the header.

use core::ffi::c_char;

use super::status::{Failure, Text, fairmesh_status};
use super::types::*;
use fairmesh::LevelReport;
use fairmesh::{BoundaryLoop, FillOutcome, FlatReason, LoopKind, LoopReport, OpenReason};
use fairmesh::{Outcome, Report};

/// The report of a fairing.
pub(crate) fn report(of: &Report) -> fairmesh_report {
    let (outcome, reached, reason) = outcome(&of.outcome);
    let quality = &of.quality;
    fairmesh_report {
        struct_size: size_of::<fairmesh_report>() as u32,
        outcome: outcome as u32,
        iterations: of.iterations as u64,
        defect: of.defect,
        step: of.step,
        diagonal: of.diagonal,
        reached,
        free_vertices: of.free_vertices as u64,
        linear_surface: u32::from(of.linear_surface),
        level_count: of.levels.len() as u32,
        fallback_weights: of.fallback_weights as u64,
        poor_triangle_count: poor(of).len() as u64,
        flipped_count: quality.flipped.len() as u64,
        needle_count: quality.needles.len() as u64,
        suspicious_normal_count: of.suspicious_normals.len() as u64,
        unreached_vertex_count: unreached(of).len() as u64,
        worst_angle: quality.worst_angle,
        worst_triangle: quality.worst_triangle as u64,
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
        reason,
    }
}

pub(crate) fn poor(of: &Report) -> &[u32] {
    match &of.outcome {
        Outcome::ConvergedPoorTriangles { triangles } => triangles,
        _ => &[],
    }
}

pub(crate) fn unreached(of: &Report) -> &[u32] {
    match &of.outcome {
        Outcome::NormalsNotReachable { vertices, .. } => vertices,
        _ => &[],
    }
}

fn outcome(of: &Outcome) -> (fairmesh_outcome, f64, [c_char; 160]) {
    use fairmesh_outcome as C;
    let nothing = [0; 160];
    match of {
        Outcome::Converged => (C::Converged, 1.0, nothing),
        Outcome::ConvergedPoorTriangles { .. } => (C::ConvergedPoorTriangles, 1.0, nothing),
        Outcome::ConvergedLoosely { reason } => (
            C::ConvergedLoosely,
            1.0,
            Text::new(format_args!("{}", reason.text())).characters(),
        ),
        Outcome::NormalsNotReachable { reached, .. } => (C::NormalsNotReachable, *reached, nothing),
        Outcome::TargetNotReachable { reached } => (C::TargetNotReachable, *reached, nothing),
        Outcome::NotConverged => (C::NotConverged, 0.0, nothing),
        Outcome::IterationLimit => (C::IterationLimit, 1.0, nothing),
        Outcome::Cancelled => (C::Cancelled, 1.0, nothing),
        _ => (C::Other, 0.0, nothing),
    }
}

/// The name of any outcome number.
pub(crate) fn outcome_name(number: u32) -> &'static core::ffi::CStr {
    match number {
        0 => c"converged",
        1 => c"converged_poor_triangles",
        2 => c"converged_loosely",
        3 => c"normals_not_reachable",
        4 => c"target_not_reachable",
        5 => c"not_converged",
        6 => c"iteration_limit",
        7 => c"cancelled",
        _ => c"unknown_outcome",
    }
}

/// One level of the paper's scheme.
pub(crate) fn level(of: &LevelReport) -> fairmesh_level {
    fairmesh_level {
        struct_size: size_of::<fairmesh_level>() as u32,
        reserved: 0,
        vertices: of.vertices as u64,
        triangles: of.triangles as u64,
        updates: of.updates as u64,
        defect: of.defect,
    }
}

pub(crate) fn boundary_loop(of: &BoundaryLoop) -> fairmesh_loop {
    let (kind, edge_a, edge_b) = match of.kind {
        LoopKind::Hole => (fairmesh_loop_kind::Hole, u32::MAX, u32::MAX),
        LoopKind::OuterBoundary => (fairmesh_loop_kind::OuterBoundary, u32::MAX, u32::MAX),
        LoopKind::NonManifold { a, b } => (fairmesh_loop_kind::NonManifold, a, b),
        _ => (fairmesh_loop_kind::Other, u32::MAX, u32::MAX),
    };
    fairmesh_loop {
        struct_size: size_of::<fairmesh_loop>() as u32,
        kind: kind as u32,
        vertex_count: of.vertices.len() as u64,
        touching_count: of.touching.len() as u64,
        length: of.length,
        area: of.area,
        turn: of.turn,
        edge_a,
        edge_b,
    }
}

pub(crate) fn filled_loop(of: &LoopReport) -> fairmesh_fill_report {
    use fairmesh_fill_outcome as C;
    use fairmesh_fill_reason as Why;
    let mut refused = fairmesh_status::Ok;
    let (outcome, reason) = match &of.outcome {
        FillOutcome::Faired => (C::Faired, Why::None),
        FillOutcome::Linear => (C::Linear, Why::None),
        FillOutcome::Flat { reason } => {
            let why = match reason {
                FlatReason::NotAsked => Why::NotAsked,
                FlatReason::NoInnerVertex => Why::NoInnerVertex,
                FlatReason::Refused(error) => {
                    refused = Failure::from(error.clone()).status;
                    Why::Refused
                }
                FlatReason::Unsound => Why::Unsound,
                _ => Why::Other,
            };
            (C::Flat, why)
        }
        FillOutcome::LeftOpen(reason) => {
            let why = match reason {
                OpenReason::NonManifold { .. } => Why::NonManifold,
                OpenReason::OuterBoundary => Why::OuterBoundary,
                OpenReason::TooManyEdges => Why::TooManyEdges,
                OpenReason::NoTriangulation => Why::NoTriangulation,
                OpenReason::NotFinite { .. } => Why::NotFinite,
                OpenReason::Cancelled => Why::Cancelled,
                _ => Why::Other,
            };
            (C::LeftOpen, why)
        }
        _ => (C::Other, Why::Other),
    };
    fairmesh_fill_report {
        struct_size: size_of::<fairmesh_fill_report>() as u32,
        outcome: outcome as u32,
        reason: reason as u32,
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
        seconds: of.seconds,
    }
}
