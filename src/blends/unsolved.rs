//! Blends that are not sound: where, and what stays sharp for it.

use nalgebra::Vector3;

use super::crease_graph::CreaseGraph;
use super::level::Level;
use super::rounded::Rounded;
use super::surface::{Surface, between};
use crate::fairing::Outcome;
use crate::holes::Links;
use crate::mesh::halfedge::{next, previous};

/// A corner is to blame for what is so many widths from it.
const REACH: f64 = 3.0;

/// Lets corners near the worst places of a result stay sharp, or else the creases that are nearest. False if there is no such place, or nothing would
/// be left.
pub(super) fn give_up(
    graph: &mut CreaseGraph,
    surface: &Surface<'_>,
    level: &Level,
    result: &Rounded,
) -> bool {
    let mut is_any = false;
    for place in worst_places(result) {
        let place = place - surface.centre;
        if let Some(v) = corner(graph, surface, level, &place) {
            graph.sharp_corners.push((v, place));
            is_any = true;
        } else if let Some(c) = nearest(graph, level, &place) {
            graph.chains[c].is_chosen = false;
            graph.chains[c].unsolved = Some(place);
            is_any = true;
        }
    }
    is_any && graph.chains.iter().any(|chain| chain.is_chosen)
}

/// The crease that is nearest to a place.
fn nearest(graph: &CreaseGraph, level: &Level, place: &Vector3<f64>) -> Option<usize> {
    let chosen = (0..graph.chains.len()).filter(|&c| graph.chains[c].is_chosen);
    let distance = |c: usize| {
        let all = level.curves[c].points.iter().map(|p| (p - place).norm());
        all.fold(f64::INFINITY, f64::min)
    };
    chosen.min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
}

/// The nearest corner that is to blame for a place.
fn corner(graph: &CreaseGraph, surface: &Surface<'_>, level: &Level, place: &Vector3<f64>) -> Option<u32> {
    let chosen = graph
        .chains
        .iter()
        .enumerate()
        .filter(|(_, chain)| chain.is_chosen && !chain.is_closed);
    let ends = chosen.flat_map(|(c, chain)| {
        let widest = level.sides[2 * c].widest;
        chain
            .ends(surface)
            .map(|v| (v, (surface.x[v as usize] - place).norm() / widest))
    });
    let is_round = |v: u32| !graph.is_sharp(v);
    let near = ends.filter(|&(v, distance)| distance < REACH && is_round(v));
    near.min_by(|a, b| a.1.total_cmp(&b.1)).map(|of| of.0)
}

/// Where blends that are not sound are worst: one place of each component.
fn worst_places(result: &Rounded) -> Vec<Vector3<f64>> {
    let Ok(links) = Links::new(result.positions.len(), &result.triangles) else {
        return Vec::new();
    };
    let at = |v: u32| Vector3::from(result.positions[v as usize]);
    let crossing = result
        .report
        .self_intersections
        .iter()
        .flat_map(|all| all.pairs.first());
    let mut places: Vec<Vector3<f64>> = crossing
        .map(|pair| at(result.triangles[pair[0] as usize][0]))
        .collect();
    let mut is_free = vec![false; result.positions.len()];
    result.free.iter().for_each(|&v| is_free[v as usize] = true);
    for component in &result.report.components {
        let place = match &component.outcome {
            Outcome::BoundaryCrease { vertices } => vertices.first().map(|&v| at(v)),
            Outcome::ConvergedPoorTriangles { triangles } | Outcome::PoorWhenRounded { triangles } => {
                triangles.first().map(|&t| at(result.triangles[t as usize][0]))
            }
            Outcome::NotConverged | Outcome::NearestMember { .. } => {
                let free = connected(&links, &is_free, component.vertex as u32);
                worst_bend(&links, &at, &free)
            }
            _ => None,
        };
        places.extend(place);
    }
    places
}

/// The free vertices that hang together with one.
fn connected(links: &Links<'_>, is_free: &[bool], first: u32) -> Vec<u32> {
    let mut is_seen = vec![false; is_free.len()];
    is_seen[first as usize] = true;
    let mut all = vec![first];
    let mut next_one = 0;
    while let Some(&v) = all.get(next_one) {
        next_one += 1;
        for &h in links.outgoing.row(v as usize) {
            let to = links.origin(next(h));
            if is_free[to as usize] && !std::mem::replace(&mut is_seen[to as usize], true) {
                all.push(to);
            }
        }
    }
    all
}

/// The middle of the edge at one of these vertices where the surface bends most.
fn worst_bend(links: &Links<'_>, at: &dyn Fn(u32) -> Vector3<f64>, free: &[u32]) -> Option<Vector3<f64>> {
    let x = |h: u32| at(links.origin(h));
    let normal = |h: u32| (x(next(h)) - x(h)).cross(&(x(previous(h)) - x(h)));
    let of_vertices = free.iter().flat_map(|&v| links.outgoing.row(v as usize));
    let around = of_vertices.flat_map(|&h| [h, next(h)]);
    let bend = |h: u32| Some((between(&normal(h), &normal(links.across(h)?)), h));
    let (_, h) = around.filter_map(bend).max_by(|a, b| a.0.total_cmp(&b.0))?;
    Some((x(h) + x(next(h))) * 0.5)
}
