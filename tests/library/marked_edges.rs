//! Edges that are marked sharp are creases however little they bend.

use crate::fairing::*;
use crate::sharp::{EDGE, PLACES, distance, piece, with_hole, worst};
use fairmesh::{FillOptions, Loops, Options, Report, SharpFate, boundary_loops, fill_holes};
use fairmesh_shapes::*;

/// Less than is taken for a crease.
const FLAT: Creased = Creased::Wedge(12.0);

/// The edges along the crease, every other one from its other end.
fn along_crease(shape: &Shape) -> Vec<[u32; 2]> {
    let is_on = |v: u32| shape.positions[v as usize][1..].iter().all(|x| x.abs() < 1e-9);
    let edges = shape
        .triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let on = edges.filter(|edge| edge.iter().all(|&v| is_on(v)));
    (0..)
        .zip(on)
        .map(|(k, [a, b])| if k % 2 == 0 { [a, b] } else { [b, a] })
        .collect()
}

fn asked(sharp: f64, marked_edges: Vec<[u32; 2]>) -> Options {
    Options {
        sharp,
        marked_edges,
        ..options(1e-9)
    }
}

fn fates(report: &Report) -> Vec<SharpFate> {
    report.sharp_edges.iter().map(|edge| edge.fate).collect()
}

#[test]
fn they_go_on_whatever_sharp_is() {
    for seed in 1..=3 {
        let shape = piece(FLAT, PLACES[0], EDGE, seed);
        let start = shape.noise(seed, 0.5);
        let marked = along_crease(&shape);
        for sharp in [0.0, Options::SHARP_AUTO, 90.0] {
            let solution = solve_as_asked(&shape, &start, asked(sharp, marked.clone()));
            assert_success(&solution.report.outcome);
            assert_eq!(fates(&solution.report), [SharpFate::GoesOn], "{sharp} {seed}");
            assert_below!(worst(FLAT, &shape, &solution), 1e-6);
            let without = solve_as_asked(&shape, &start, asked(sharp, Vec::new()));
            assert_eq!(without.report.sharp_edges, []);
        }
    }
}

/// As flat shading marks them, and edges of the boundary say nothing about what arrives there.
#[test]
fn all_edges_of_a_mesh_are_none() {
    let edges = |shape: &Shape| -> Vec<[u32; 2]> {
        let edges = shape
            .triangles
            .iter()
            .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        edges.collect()
    };
    let fairs = |shape: &Shape, marked: Vec<[u32; 2]>| {
        let start = shape.noise(1, 0.5);
        fates(&solve_as_asked(shape, &start, asked(0.0, marked)).report)
    };
    let sphere = sphere_cap(60.0, 400, irregular(1), 6);
    assert_eq!(fairs(&sphere, edges(&sphere)), []);
    let roof = piece(FLAT, PLACES[0], EDGE, 1);
    let mut marked = along_crease(&roof);
    let is_rim = |v: u32| !roof.free[v as usize] && is_beside(&roof, v);
    marked.extend(
        edges(&roof)
            .into_iter()
            .filter(|edge| edge.iter().all(|&v| is_rim(v))),
    );
    assert_eq!(fairs(&roof, marked), [SharpFate::GoesOn]);
}

/// Whether a vertex is in a triangle with a free one.
fn is_beside(shape: &Shape, v: u32) -> bool {
    let mut around = shape.triangles.iter().filter(|tri| tri.contains(&v));
    around.any(|tri| tri.iter().any(|&w| shape.free[w as usize]))
}

/// The shortest way from vertex to vertex over free ones that are not among these.
fn way(shape: &Shape, [from, to]: [u32; 2], without: &[u32]) -> Vec<u32> {
    let mut before = vec![None; shape.positions.len()];
    let mut reached = vec![from];
    let mut next = 0;
    while before[to as usize].is_none() {
        let at = reached[next];
        next += 1;
        let around = shape.triangles.iter().filter(|tri| tri.contains(&at)).flatten();
        for &w in around {
            let is_open = w == to || shape.free[w as usize] && !without.contains(&w);
            if is_open && w != from && before[w as usize].is_none() {
                before[w as usize] = Some(at);
                reached.push(w);
            }
        }
    }
    let mut way = vec![to];
    while let Some(v) = before[way[way.len() - 1] as usize] {
        way.push(v);
    }
    way.reverse();
    way
}

#[test]
fn those_inside_lie_on_an_edge_that_goes_on() {
    for seed in 1..=3 {
        let of = Creased::Wedge(90.0);
        let shape = piece(of, PLACES[0], EDGE, seed);
        let faired = |marked: Vec<[u32; 2]>| {
            let solution = solve_as_asked(&shape, &shape.noise(seed, 0.5), asked(20.0, marked));
            assert_success(&solution.report.outcome);
            assert_below!(worst(of, &shape, &solution), 1e-6);
            solution.report.sharp_edges[0].vertices.clone()
        };
        let chosen = faired(Vec::new());
        let ends = [chosen[0], chosen[chosen.len() - 1]];
        let middle = chosen.len() / 3..2 * chosen.len() / 3;
        let other = way(&shape, ends, &chosen[middle]);
        let marked = other.windows(2).map(|step| [step[1], step[0]]);
        assert_eq!(faired(marked.collect()), other, "{seed}");
        assert_ne!(other, chosen);
    }
}

/// What is inside of the region, or no edge of the mesh at all, is no end, and no vertex has to exist.
#[test]
fn those_that_are_not_outside_are_no_ends() {
    let shape = piece(FLAT, PLACES[0], EDGE, 1);
    let is_inside = |edge: &[u32; 2]| edge.iter().any(|&v| shape.free[v as usize]);
    let mut marked = along_crease(&shape);
    marked.retain(is_inside);
    marked.extend([[0, 0], [0, u32::MAX]]);
    let solution = solve_as_asked(&shape, &shape.positions, asked(0.0, marked));
    assert_eq!(solution.report.sharp_edges, []);
    let without = solve_as_asked(&shape, &shape.positions, asked(0.0, Vec::new()));
    assert_eq!(solution.positions, without.positions);
}

#[test]
fn holes_are_closed_with_them() {
    for seed in 1..=3 {
        let shape = with_hole(FLAT, PLACES[1], EDGE, seed);
        let loops = boundary_loops(&shape.positions, &shape.triangles).unwrap();
        let shortest = (0..loops.len()).min_by(|&a, &b| loops[a].length.total_cmp(&loops[b].length));
        let ask = FillOptions {
            loops: Loops::Chosen(vec![shortest.unwrap()]),
            fairing: asked(0.0, along_crease(&shape)),
            ..FillOptions::default()
        };
        let filled = fill_holes(&shape.positions, &shape.triangles, &ask).unwrap();
        let fairing = filled.loops.iter().find_map(|report| {
            let fairing = report.fairing.as_ref();
            fairing.filter(|fairing| !fairing.sharp_edges.is_empty())
        });
        assert_eq!(
            fates(fairing.expect("sharp edges")),
            [SharpFate::GoesOn],
            "{seed}"
        );
        assert!(
            boundary_loops(&filled.positions, &filled.triangles)
                .unwrap()
                .len()
                <= 1
        );
        let new = filled.positions[shape.positions.len()..].iter();
        assert_below!(new.map(|p| distance(FLAT, *p)).fold(0.0, f64::max), 1e-6);
    }
}
