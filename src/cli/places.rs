//! Where boundary loops are, and what is near.

use fairmesh::BoundaryLoop;

use crate::normals::{dot, sub};

/// Loops whose balls are nearest are measured, so many of them, by so many of their vertices. A loop has a handful of neighbours, and the
/// distance is for reading.
const CANDIDATES: usize = 8;
const SAMPLES: usize = 200;

/// Of more loops nobody reads which is near which, and all pairs are looked at: half take a few ms, double .1 s, 40,000 of a soup 11 s.
const MOST: usize = 2_000;

/// A ball around a loop, and the loop that comes nearest.
#[derive(Debug, Clone)]
pub struct LoopPlace {
    /// The middle of its vertices.
    pub centre: [f64; 3],
    /// The distance of the farthest one.
    pub radius: f64,
    /// Its number, and the distance between vertices of both; not told of more than [`MOST`] loops.
    pub nearest: Option<(usize, f64)>,
}

/// Of each loop.
pub fn places(positions: &[[f64; 3]], loops: &[BoundaryLoop]) -> Vec<LoopPlace> {
    let mut places: Vec<LoopPlace> = loops.iter().map(|of| ball(positions, &of.vertices)).collect();
    let few = if loops.len() <= MOST { loops.len() } else { 0 };
    for of in 0..few {
        places[of].nearest = nearest(positions, loops, &places, of);
    }
    places
}

fn ball(positions: &[[f64; 3]], vertices: &[u32]) -> LoopPlace {
    let at = |v: &u32| positions[*v as usize];
    let count = vertices.len().max(1) as f64;
    let mut centre = [0.0; 3];
    for p in vertices.iter().map(at) {
        (0..3).for_each(|k| centre[k] += p[k] / count);
    }
    let radius = vertices
        .iter()
        .map(|v| distance(at(v), centre))
        .fold(0.0, f64::max);
    LoopPlace {
        centre,
        radius,
        nearest: None,
    }
}

fn nearest(
    positions: &[[f64; 3]],
    loops: &[BoundaryLoop],
    places: &[LoopPlace],
    of: usize,
) -> Option<(usize, f64)> {
    let own = &places[of];
    let gap = |other: usize| distance(own.centre, places[other].centre) - own.radius - places[other].radius;
    let mut others: Vec<(f64, usize)> = (0..loops.len())
        .filter(|&other| other != of)
        .map(|other| (gap(other), other))
        .collect();
    if others.len() > CANDIDATES {
        others.select_nth_unstable_by(CANDIDATES, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        others.truncate(CANDIDATES);
    }
    let sampled = |of: usize| {
        let vertices = &loops[of].vertices;
        let sampled = vertices.iter().step_by(vertices.len().div_ceil(SAMPLES));
        sampled.map(|&v| positions[v as usize])
    };
    let own: Vec<[f64; 3]> = sampled(of).collect();
    let to = |other: usize| {
        let pairs = sampled(other).flat_map(|q| own.iter().map(move |&p| distance(p, q)));
        pairs.fold(f64::INFINITY, f64::min)
    };
    let measured = others.into_iter().map(|(_, other)| (other, to(other)));
    measured.min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)))
}

fn distance(p: [f64; 3], q: [f64; 3]) -> f64 {
    let d = sub(p, q);
    dot(d, d).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use fairmesh::boundary_loops;

    /// Squares in a plane, each a loop of its own: its corner and its side.
    fn squares(of: &[([f64; 2], f64)]) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        let corners = of.iter().flat_map(|&([x, y], side)| {
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[a, b]| [x + side * a, y + side * b, 2.0])
        });
        let triangles =
            (0..of.len() as u32).flat_map(|k| [[0, 1, 2], [0, 2, 3]].map(|t| t.map(|v| 4 * k + v)));
        (corners.collect(), triangles.collect())
    }

    #[test]
    fn a_loop_is_in_a_ball_and_has_a_nearest_one() {
        let (positions, triangles) = squares(&[([0.0, 0.0], 2.0), ([5.0, 0.0], 1.0), ([5.0, 3.0], 1.0)]);
        let loops = boundary_loops(&positions, &triangles).unwrap();
        let places = places(&positions, &loops);
        assert_eq!(places[0].centre, [1.0, 1.0, 2.0]);
        assert!((places[0].radius - 2f64.sqrt()).abs() < 1e-12);
        let nearest: Vec<_> = places.iter().map(|place| place.nearest.unwrap()).collect();
        assert_eq!(nearest, [(1, 3.0), (2, 2.0), (1, 2.0)]);
    }

    #[test]
    fn a_single_loop_has_none() {
        let (positions, triangles) = squares(&[([0.0, 0.0], 1.0)]);
        let loops = boundary_loops(&positions, &triangles).unwrap();
        assert_eq!(places(&positions, &loops)[0].nearest, None);
    }

    #[test]
    fn of_a_soup_it_is_not_told_what_is_near() {
        let many: Vec<([f64; 2], f64)> = (0..=MOST).map(|k| ([2.0 * k as f64, 0.0], 1.0)).collect();
        let (positions, triangles) = squares(&many);
        let loops = boundary_loops(&positions, &triangles).unwrap();
        let places = places(&positions, &loops);
        assert_eq!(places.len(), MOST + 1);
        assert!(
            places
                .iter()
                .all(|place| place.nearest.is_none() && place.radius > 0.7)
        );
    }
}
