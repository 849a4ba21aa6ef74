//! Blends that are not sound: where, and what stays sharp for it.

use nalgebra::Vector3;

use super::crease_graph::CreaseGraph;
use super::facets::Facets;
use super::level::Level;
use super::rims::Unlaid;
use super::rounded::Rounded;
use super::surface::Surface;
use crate::fairing::{LooseReason, Outcome};
use crate::mesh::NONE;
use crate::mesh::disjoint_sets::DisjointSets;

/// A corner is to blame for what is so many widths from it.
/// Of 12 solids cut from each other, half: none changes; double: one loses a crease more.
const REACH: f64 = 3.0;

/// Lets corners near these places stay sharp, or else the creases that are nearest; for a second place at the same corner the crease, too.
/// False if there is no such place, or nothing would be left.
pub(super) fn give_up(
    graph: &mut CreaseGraph,
    surface: &Surface<'_>,
    level: &Level,
    places: &[Vector3<f64>],
) -> bool {
    let corners = graph.sharp_corners.len();
    // Creases are given up when all places are seen: two flaws of one are not to be blamed on its neighbour.
    let mut creases = Vec::new();
    for &place in places {
        if let Some(v) = corner(graph, surface, level, &place) {
            graph.sharp_corners.push((v, place));
        } else if let Some(c) = nearest(graph, level, &place) {
            creases.push((c, place));
        }
    }
    for &(c, place) in &creases {
        graph.chains[c].give_up(place);
    }
    let is_any = graph.sharp_corners.len() > corners || !creases.is_empty();
    is_any && graph.chains.iter().any(|chain| chain.is_chosen)
}

/// Lets creases stay sharp whose bands end before they begin. Whether there are any.
pub(super) fn give_up_faded(graph: &mut CreaseGraph, level: &Level) -> bool {
    let mut is_any = false;
    for (c, chain) in graph.chains.iter_mut().enumerate() {
        if chain.is_chosen && level.sides[2 * c].widest <= 0.0 {
            let points = &level.curves[c].points;
            chain.give_up(points[points.len() / 2]);
            is_any = true;
        }
    }
    is_any
}

/// Lets an end at the boundary, or a crease whose band reaches too far, stay sharp.
pub(super) fn give_up_unlaid(graph: &mut CreaseGraph, unlaid: Unlaid) {
    match unlaid {
        Unlaid::End { vertex, place } => graph.sharp_corners.push((vertex, place)),
        Unlaid::Beside { chain, place } => graph.chains[chain].give_up(place),
    }
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

/// Where blends that are not sound are worst, from this centre: one place of each component.
pub(super) fn worst_places(result: &Rounded, centre: &Vector3<f64>) -> Vec<Vector3<f64>> {
    let Ok(facets) = Facets::new(&result.positions, &result.triangles) else {
        return Vec::new();
    };
    let of_triangle = |t: u32| facets.at(result.triangles[t as usize][0]);
    let crossing = result.report.self_intersections.iter();
    let crossing = crossing.flat_map(|all| all.pairs.first());
    let mut places: Vec<Vector3<f64>> = crossing.map(|pair| of_triangle(pair[0])).collect();
    let components = components(result);
    // Whether a component has a triangle at a vertex of its boundary.
    let is_at = |component: usize, v: u32| {
        let around = facets.links.outgoing.row(v as usize).iter();
        let mut corners = around.flat_map(|&h| result.triangles[h as usize / 3]);
        corners.any(|corner| components[corner as usize] as usize == component)
    };
    let mut bends = None;
    for component in &result.report.components {
        places.extend(match &component.outcome {
            Outcome::BoundaryCrease { vertices } => vertices.first().map(|&v| facets.at(v)),
            Outcome::ConvergedPoorTriangles { triangles } | Outcome::PoorWhenRounded { triangles } => {
                triangles.first().map(|&t| of_triangle(t))
            }
            Outcome::ConvergedLoosely {
                reason: LooseReason::SuspiciousNormals,
            } => {
                let mut all = result.report.suspicious_normals.iter();
                let own = all.find(|&&v| is_at(component.vertex, v));
                own.map(|&v| facets.at(v))
            }
            Outcome::NotConverged
            | Outcome::NearestMember { .. }
            | Outcome::ConvergedLoosely {
                reason: LooseReason::Bump,
            } => {
                let bends = bends.get_or_insert_with(|| worst_bends(result, &components, &facets));
                let (bend, place) = bends[component.vertex];
                (bend > 0.0).then_some(place)
            }
            _ => None,
        });
    }
    places.iter().map(|place| place - centre).collect()
}

/// Per vertex the component whose free vertex it is, named by the smallest of them; [`NONE`] of others.
fn components(result: &Rounded) -> Vec<u32> {
    let mut is_free = vec![false; result.positions.len()];
    result.free.iter().for_each(|&v| is_free[v as usize] = true);
    // Components end at arcs.
    let on_arcs = result.report.sharp_edges.iter().flat_map(|edge| &edge.vertices);
    on_arcs.for_each(|&v| is_free[v as usize] = false);
    let is_free = |v: u32| is_free[v as usize];
    let mut sets = DisjointSets::new(result.positions.len());
    for triangle in &result.triangles {
        let mut free = triangle.iter().copied().filter(|&v| is_free(v));
        if let Some(first) = free.next() {
            free.for_each(|v| sets.unite(first, v));
        }
    }
    let all = 0..result.positions.len() as u32;
    all.map(|v| if is_free(v) { sets.smallest(v) } else { NONE })
        .collect()
}

/// Per component the largest bend between its triangles, and the middle of the edge.
fn worst_bends(result: &Rounded, components: &[u32], facets: &Facets<'_>) -> Vec<(f64, Vector3<f64>)> {
    let mut worst = vec![(0.0, Vector3::zeros()); result.positions.len()];
    for h in 0..3 * result.triangles.len() as u32 {
        let of_corners = result.triangles[h as usize / 3].map(|v| components[v as usize]);
        let component = of_corners.into_iter().find(|of| *of != NONE);
        if let (Some(v), Some(bend)) = (component, facets.bend(h)) {
            let of = &mut worst[v as usize];
            if bend > of.0 {
                *of = (bend, facets.at(facets.links.origin(h)) + facets.edge(h) * 0.5);
            }
        }
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blends::chain_curve::ChainCurve;
    use crate::blends::crease_graph::Chain;
    use crate::blends::level::Side;
    use crate::blends::{RoundOptions, round};

    const TETRAHEDRON: [[f64; 3]; 4] = [
        [1.0, 1.0, 1.0],
        [1.0, -1.0, -1.0],
        [-1.0, 1.0, -1.0],
        [-1.0, -1.0, 1.0],
    ];
    const FACES: [[u32; 3]; 4] = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];

    #[test]
    fn two_flaws_of_one_crease_are_not_blamed_on_another() {
        let surface = Surface::new(&TETRAHEDRON, &FACES).unwrap();
        let mut graph = CreaseGraph::new(&surface, &RoundOptions::default());
        let ends = |chain: &Chain| chain.ends(&surface).map(|v| surface.x[v as usize]);
        let side = |i: u32| Side {
            face: 0,
            curve: i / 2,
            widths: Vec::new(),
            widest: 0.1,
            with: [None; 2],
        };
        let chains = graph.chains.iter();
        let level = Level {
            curves: chains
                .map(|chain| ChainCurve::new(&ends(chain), &[1.0], false, 0.1))
                .collect(),
            sides: (0..2 * graph.chains.len() as u32).map(side).collect(),
            corners: Vec::new(),
            least: Vec::new(),
        };
        let [a, b] = ends(&graph.chains[0]);
        let places = [0.45, 0.55].map(|t| a + (b - a) * t);
        assert!(give_up(&mut graph, &surface, &level, &places));
        let unsolved: Vec<_> = graph.chains.iter().map(|chain| chain.unsolved).collect();
        assert_eq!(unsolved, [Some(places[0]), None, None, None, None, None]);
        assert!(graph.sharp_corners.is_empty());
    }

    /// Two far tetrahedra; the blends of the second are said to be loose.
    #[test]
    fn loose_blends_have_a_worst_place() {
        let mut positions = TETRAHEDRON.to_vec();
        positions.extend(TETRAHEDRON.map(|[x, y, z]| [x + 9.0, y, z]));
        let mut triangles = FACES.to_vec();
        triangles.extend(FACES.map(|t| t.map(|v| v + 4)));
        let options = RoundOptions {
            width: 0.1,
            ..RoundOptions::default()
        };
        let rounded = round(&positions, &triangles, &options).unwrap();
        assert!(worst_places(&rounded, &Vector3::zeros()).is_empty());
        let second = |v: usize| rounded.positions[v][0] > 4.5;
        for reason in [LooseReason::Bump, LooseReason::SuspiciousNormals] {
            let mut loose = rounded.clone();
            let normal = |of_second| {
                loose
                    .free
                    .iter()
                    .copied()
                    .find(|&v| second(v as usize) == of_second)
            };
            loose.report.suspicious_normals = [false, true].into_iter().filter_map(normal).collect();
            let components = &mut loose.report.components;
            let of = components.iter_mut().find(|of| second(of.vertex)).unwrap();
            of.outcome = Outcome::ConvergedLoosely { reason };
            let places = worst_places(&loose, &Vector3::zeros());
            assert_eq!(places.len(), 1, "{reason:?}");
            assert!(places[0].x > 7.5, "{reason:?}: {}", places[0]);
        }
    }
}
