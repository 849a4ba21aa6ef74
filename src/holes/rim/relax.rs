//! Rims drawn to the surface that the mesh around them has on average.

use nalgebra::Vector3;

use super::band::Band;
use super::fit::{Fit, Sheet};
use super::options::Rim;
use super::report::RimReport;
use super::untangle::Untangling;
use super::width::{CLEAN, REACH, width};
use crate::holes::links::Links;
use crate::holes::loops::BoundaryLoop;
use crate::support::entries::sort_by_number;

/// Above this, in edges, noise has hardly left a triangle its shape.
/// Of 3 cases, half: none changes; double: 2 change, 2 get another triangulation, -4 % iterations.
const ROUGH: f64 = 0.1;
/// The quality below which triangles are mended for either.
/// Half or double, of 3 cases: 3 change, 3 get another triangulation.
const POOR: [f64; 2] = [0.3, 0.6];

/// What relaxing the rim of one patch comes to.
#[derive(Debug, Clone)]
pub(super) struct RelaxedRim {
    /// Vertices that move.
    pub(super) places: Vec<RimVertex>,
    /// The normals that the patch shall have at the loops' vertices, by their numbers.
    pub(super) normals: Vec<(u32, [f64; 3])>,
    pub(super) report: RimReport,
}

/// A vertex that moves, in which ring it is, and where to.
#[derive(Debug, Clone, Copy)]
pub(super) struct RimVertex {
    pub(super) vertex: u32,
    pub(super) ring: usize,
    pub(super) x: Vector3<f64>,
}

/// The first rings around the loops of a patch on the surface that is fitted to what is around each vertex; `place` is scratch as
/// long as the mesh has vertices.
pub(super) fn relaxed(
    rim: &Rim,
    links: &Links<'_>,
    positions: &[[f64; 3]],
    loops: &[&BoundaryLoop],
    place: &mut [u32],
) -> RelaxedRim {
    // No mesh has more of them.
    let rings = rim.relax.min(positions.len());
    let band = Band::new(links, positions, loops, rings + REACH, rings, place);
    let edge = band.mean_edge(band.count(rings + 1));
    let Some(width) = width(&band, edge) else {
        return RelaxedRim {
            places: Vec::new(),
            normals: Vec::new(),
            report: RimReport::default(),
        };
    };
    let within = rim.within.unwrap_or(edge);
    let moving: Vec<usize> = (0..band.count(rings)).collect();
    let fits = band.fits(&moving, width.radius);
    let sheet = |fit: &Fit, v: usize| {
        let height = fit.height.clamp(-within, within);
        fit.sheet.through(band.x[v] + fit.sheet.normal * height)
    };
    let sheets: Vec<Option<Sheet>> = moving
        .iter()
        .map(|&v| fits[v].as_ref().map(|fit| sheet(fit, v)))
        .collect();
    let mut x = band.x.clone();
    for (x, sheet) in x.iter_mut().zip(&sheets) {
        *x = sheet.map_or(*x, |sheet| sheet.at);
    }
    let rough = (width.noise / edge - CLEAN) / (ROUGH - CLEAN);
    let mut untangling = Untangling {
        band: &band,
        sheets: &sheets,
        x,
        within,
        edge,
        poor: POOR[0] + (POOR[1] - POOR[0]) * rough.clamp(0.0, 1.0),
        on_loops: band.count(1),
    };
    if rough > 0.0 {
        untangling.run();
    }
    let mut moved = RelaxedRim {
        places: Vec::with_capacity(moving.len()),
        normals: Vec::new(),
        report: RimReport {
            folded: untangling.folded(),
            within,
            noise: width.noise,
            evenness: width.evenness,
            radius: width.radius,
            ..RimReport::default()
        },
    };
    for v in moving {
        let Some(fit) = &fits[v] else { continue };
        let (vertex, ring) = (band.ids[v], band.ring(v));
        let is_bounded = fit.height.abs() > within;
        moved.report.bounded += usize::from(is_bounded);
        if ring == 0 && !is_bounded {
            moved.normals.push((vertex, fit.sheet.normal.into()));
        }
        let x = untangling.x[v];
        moved.places.push(RimVertex { vertex, ring, x });
    }
    sort_by_number(&mut moved.normals);
    moved
}
