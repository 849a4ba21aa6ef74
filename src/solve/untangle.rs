//! Where a vertex of a folded ring ought to be: the place within its ring from which the worst triangle is best.

use nalgebra::Vector3;

use crate::mesh::{RegionMesh, Rings};

/// Times that every marked vertex is moved.
/// Of 41 cases, half: 12 change by up to 0.8 edges, 4 get another triangulation, -2 % iterations;
/// double: 9 change by up to 0.9 edges, 2 get another triangulation, -3 % iterations, 1 fails.
const SWEEPS: usize = 8;
/// Directions that are tried around the vertex.
/// Of 41 cases, half: 24 change by up to 3 edges, 3 get another triangulation, -3 % iterations;
/// double: 22 change by up to 0.5 edges, 1 get another triangulation, -4 % iterations, 1 fails.
const DIRECTIONS: usize = 8;
/// The first and the last distance tried, relative to the ring's mean radius.
/// Of 41 cases, half: 23 change by up to 3 edges, 2 get another triangulation, -6 % iterations;
/// double: 20 change by up to 3 edges, 3 get another triangulation, -4 % iterations, 1 fails.
const DISTANCES: [f64; 2] = [0.5, 0.01];
/// The most moves of a vertex in a sweep: away from a ring of no area every place can be better than the last.
/// Of 41 cases, half: 5 change by up to 0.4 edges, 2 get another triangulation, -2 % iterations, 1 fails;
/// double: 4 change, 2 get another triangulation, +2 % iterations.
const MOVES: usize = 24;

/// Moves the marked free vertices of `x`, one after the other in the caller's order, each within the plane of its ring, so
/// that the least quality of the triangles around it grows. The rest of `x` stays.
pub(crate) fn untangle(region: &RegionMesh, rings: &Rings, marked: &[bool], x: &mut [Vector3<f64>]) {
    let mut order: Vec<usize> = (0..marked.len()).filter(|&i| marked[i]).collect();
    order.sort_unstable_by_key(|&i| region.vertex_ids[i]);
    let mut ring = Vec::new();
    for _ in 0..SWEEPS {
        for &i in &order {
            let neighbours = rings.ring(i);
            let first = first_of(region, neighbours);
            let (end, begin) = neighbours.split_at(first);
            ring.clear();
            ring.extend(begin.iter().chain(end).map(|&j| x[j as usize]));
            x[i] = best_place(&ring, x[i]);
        }
    }
}

/// The place in a ring of the neighbour that comes first with the caller, free ones before others: what is tried around a
/// vertex begins there, and is not to hang on local numbers.
fn first_of(region: &RegionMesh, ring: &[u32]) -> usize {
    let key = |j: u32| (!region.is_free(j), region.vertex_ids[j as usize], j);
    let places = ring.iter().enumerate();
    places.min_by_key(|(_, j)| key(**j)).map_or(0, |(place, _)| place)
}

/// The best place that is found from `p` within the plane of the ring, by trying ever smaller steps around it.
fn best_place(ring: &[Vector3<f64>], mut p: Vector3<f64>) -> Vector3<f64> {
    // The vector area of a closed polygon does not depend on where its apex is, nor on whether that is inside.
    let area: Vector3<f64> = edges(ring).map(|(a, b)| (a - p).cross(&(b - p))).sum();
    let Some(n) = area.try_normalize(0.0) else {
        return p;
    };
    let radius = ring.iter().map(|a| (a - p).norm()).sum::<f64>() / ring.len() as f64;
    let side = ring[1] - ring[0];
    let Some(b_x) = (side - n * n.dot(&side)).try_normalize(0.0) else {
        return p;
    };
    let b_y = n.cross(&b_x);
    let mut quality = least_quality(ring, &p, &n);
    let (mut distance, mut moves) = (DISTANCES[0], 0);
    while distance > DISTANCES[1] && moves < MOVES {
        let tried = (0..DIRECTIONS).map(|k| {
            let phi = k as f64 * std::f64::consts::TAU / DIRECTIONS as f64;
            let place = p + (b_x * libm::cos(phi) + b_y * libm::sin(phi)) * (distance * radius);
            (least_quality(ring, &place, &n), place)
        });
        match tried.max_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((better, place)) if better > quality => (quality, p, moves) = (better, place, moves + 1),
            _ => distance *= 0.5,
        }
    }
    p
}

/// The least of the triangles' `area / sum of squared edges` around `p`, negative where one is turned over.
fn least_quality(ring: &[Vector3<f64>], p: &Vector3<f64>, n: &Vector3<f64>) -> f64 {
    let of = |(a, b): (&Vector3<f64>, &Vector3<f64>)| {
        let (u, v) = (a - p, b - p);
        let squares = u.norm_squared() + v.norm_squared() + (a - b).norm_squared();
        u.cross(&v).dot(n) / squares.max(f64::MIN_POSITIVE)
    };
    edges(ring).map(of).fold(f64::INFINITY, f64::min)
}

fn edges(ring: &[Vector3<f64>]) -> impl Iterator<Item = (&Vector3<f64>, &Vector3<f64>)> {
    ring.iter().zip(ring.iter().cycle().skip(1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Selection;
    use crate::mesh::numbering::Numbering;
    use fairmesh_shapes::{OUTSIDE, Sampling, sphere_cap};

    fn polygon(corners: &[[f64; 2]]) -> Vec<Vector3<f64>> {
        corners.iter().map(|c| Vector3::new(c[0], c[1], 0.3)).collect()
    }

    #[test]
    fn the_best_place_in_a_regular_polygon_is_its_centre() {
        let corners: Vec<_> = (0..6)
            .map(|k| (f64::from(k) * std::f64::consts::TAU / 6.0).sin_cos())
            .map(|(s, c)| [c, s])
            .collect();
        let found = best_place(&polygon(&corners), Vector3::new(0.7, 0.5, 0.3));
        assert!((found - Vector3::new(0.0, 0.0, 0.3)).norm() < 0.05, "{found}");
    }

    #[test]
    fn a_crumpled_ring_without_area_ends_as_well() {
        // A figure of eight: one half of its triangles is turned over wherever the vertex is.
        let ring = polygon(&[[1.0, 1.0], [-1.0, -1.0], [-1.0, 1.0], [1.0, -1.000_001]]);
        let found = best_place(&ring, Vector3::new(0.1, 0.0, 0.3));
        assert!(
            found.iter().all(|c| c.is_finite()) && found.norm() < 30.0,
            "{found}"
        );
    }

    #[test]
    fn a_vertex_outside_a_notched_ring_comes_back_into_its_kernel() {
        // A chevron: its centroid is outside.
        let ring = polygon(&[[0.0, 0.0], [4.0, 3.0], [0.0, 1.0], [-4.0, 3.0]]);
        let start = Vector3::new(0.0, 1.75, 0.3);
        let up = Vector3::z();
        assert_below!(least_quality(&ring, &start, &up), 0.0);
        let found = best_place(&ring, start);
        assert!(least_quality(&ring, &found, &up) > 0.02, "{found}");
        assert_near!(found.z, 0.3, 1e-12);
    }

    /// Where vertices go decides on weights: local numbers breadth first once changed the surface by a thousandth.
    #[test]
    fn places_do_not_hang_on_local_numbers() {
        let shape = sphere_cap(60.0, 200, Sampling::Irregular { seed: 2 }, OUTSIDE);
        let positions = shape.noise(3, 0.4);
        let untangled = [Numbering::AsGiven, Numbering::BreadthFirst].map(|numbering| {
            let selection = Selection::Mask(&shape.free);
            let regions = RegionMesh::of_components(
                &positions,
                &shape.triangles,
                selection,
                &|_| false,
                (numbering, false),
            );
            let region = &regions.unwrap()[0];
            let mut x = region.positions(&positions);
            untangle(region, &Rings::new(region), &vec![true; region.free], &mut x);
            let mut places: Vec<_> = region.vertex_ids.iter().zip(x).collect();
            places.sort_by_key(|(v, _)| **v);
            places.into_iter().map(|(_, p)| p).collect::<Vec<_>>()
        });
        assert!(untangled[0] != positions.iter().map(|p| Vector3::from(*p)).collect::<Vec<_>>());
        assert_same_items!(untangled[0], untangled[1]);
    }
}
