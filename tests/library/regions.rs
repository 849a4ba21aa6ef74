//! Regions that are chosen by place, distance and shape: known answers, and bumps that are found and taken away.

use std::f64::consts::PI;

use crate::fairing::{assert_success, irregular};
use crate::tier::tier;
use fairmesh::{
    Coincident, Combine, Error, Options, Outcome, Place, Region, RegionStep, Seed, SelectedRegion, Selection,
    fair, select_region,
};
use fairmesh_shapes::*;

fn select(shape: &Shape, steps: &[RegionStep]) -> SelectedRegion {
    select_region(&shape.positions, &shape.triangles, steps, Coincident::default()).unwrap()
}

fn add(region: Region) -> RegionStep {
    RegionStep::With(Combine::Add, region)
}

/// The unit sphere but for a small hole around the north pole.
/// The bump in the east.
fn bump(size: Option<f64>) -> Region {
    Region::Bump { seed: EAST, size }
}

fn sphere(n: usize, sampling: Sampling) -> Shape {
    sphere_with_hole(0.2, n, sampling, 0)
}

const EAST: Seed = Seed::Point([1.0, 0.0, 0.0]);

/// Great circles on a sphere, straight lines on a plane.
#[test]
fn distances_along_the_surface_are_those_of_the_smooth_surface() {
    let shape = sphere(8000, irregular(1));
    let near = shape.mean_edge();
    for radius in [0.3, 1.0, 2.0] {
        let chosen = select(&shape, &[add(Region::Geodesic { seed: EAST, radius })]);
        let angle = |v: u32| shape.positions[v as usize][0].clamp(-1.0, 1.0).acos();
        let mut is_in = vec![false; shape.triangles.len()];
        chosen.triangles.iter().for_each(|&t| is_in[t as usize] = true);
        for (t, corners) in shape.triangles.iter().enumerate() {
            let farthest = corners.map(angle).into_iter().fold(0.0, f64::max);
            assert!(
                !is_in[t] || farthest < radius + 0.5 * near,
                "{radius}: {farthest}"
            );
            assert!(is_in[t] || farthest > radius - 0.5 * near, "{radius}: {farthest}");
        }
    }
    let sheet = plate(3000, irregular(2));
    let middle = sheet.positions[0];
    let chosen = select(
        &sheet,
        &[add(Region::Geodesic {
            seed: Seed::Point(middle),
            radius: 0.2,
        })],
    );
    for &t in &chosen.triangles {
        for &v in &sheet.triangles[t as usize] {
            let p = sheet.positions[v as usize];
            let distance = (0..3).map(|k| (p[k] - middle[k]).powi(2)).sum::<f64>().sqrt();
            assert!(distance < 0.2 + 1e-9, "{distance}");
        }
    }
}

/// A cube of so many squares along each edge, its corners and edges not rounded; every square of two triangles.
pub(crate) fn cube(n: u32) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for side in 0..6 {
        let first = positions.len() as u32;
        for i in 0..=n {
            for j in 0..=n {
                let [a, b] = [i, j].map(|k| f64::from(k) / f64::from(n));
                let (axis, at) = (side / 2, f64::from(side as u8 % 2));
                let mut p = [0.0; 3];
                (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (at, a, b);
                positions.push(p);
            }
        }
        for i in 0..n {
            for j in 0..n {
                let a = first + i * (n + 1) + j;
                let [b, c, d] = [a + n + 1, a + n + 2, a + 1];
                let quad = [[a, b, c], [a, c, d]];
                triangles.extend(quad.map(|t| if side % 2 == 0 { [t[0], t[2], t[1]] } else { t }));
            }
        }
    }
    (positions, triangles)
}

/// The sides have vertices of their own: what lies at the same place is one vertex.
#[test]
fn a_patch_ends_at_sharp_edges_and_a_component_does_not() {
    let (positions, triangles) = cube(4);
    let of = |region| {
        let chosen = select_region(&positions, &triangles, &[add(region)], Coincident::default());
        chosen.unwrap().triangles
    };
    let seed = Seed::Point([0.3, 0.4, 1.2]);
    let side = of(Region::Patch { seed, angle: 30.0 });
    assert_eq!(side.len(), 32);
    for &t in &side {
        assert_all!(triangles[t as usize].iter(), |&v| positions[v as usize][2] == 1.0);
    }
    assert_eq!(of(Region::Patch { seed, angle: 95.0 }).len(), triangles.len());
    assert_eq!(of(Region::Component(seed)).len(), triangles.len());
    let apart = Coincident::Separate;
    let alone = select_region(&positions, &triangles, &[add(Region::Component(seed))], apart);
    assert_eq!(alone.unwrap().triangles, side);
}

#[test]
fn steps_add_take_away_and_cut() {
    let (positions, triangles) = cube(4);
    let of =
        |steps: &[RegionStep]| select_region(&positions, &triangles, steps, Coincident::default()).unwrap();
    let patch = |point| Region::Patch {
        seed: Seed::Point(point),
        angle: 30.0,
    };
    let (top, front) = (patch([0.5, 0.5, 1.0]), patch([0.5, 0.0, 0.5]));
    let half = Region::HalfSpace {
        point: [0.5; 3],
        normal: [1.0, 0.0, 0.0],
    };
    let both = of(&[add(top.clone()), add(front)]);
    assert_eq!((both.triangles.len(), both.counts), (64, vec![32, 32]));
    let cut = of(&[
        add(top.clone()),
        RegionStep::With(Combine::Intersect, half.clone()),
    ]);
    let rest = of(&[add(top.clone()), RegionStep::With(Combine::Remove, half)]);
    assert_eq!((cut.triangles.len(), rest.triangles.len()), (16, 16));
    // A ring more: the squares beside the side, and the other half of theirs at the corners.
    let grown = of(&[add(top.clone()), RegionStep::Grow(1), RegionStep::Shrink(1)]);
    assert_eq!(grown.counts[0], 32);
    assert!(grown.counts[1] > 32 + 4 * 8 - 1, "{:?}", grown.counts);
    assert_eq!(grown.triangles, of(&[add(top.clone())]).triangles);
    let others = of(&[add(top.clone()), RegionStep::Invert]);
    assert_eq!(others.triangles.len(), triangles.len() - 32);
    // The same by vertices, of which any copy will do.
    let top_vertices = (0..positions.len() as u32).filter(|&v| positions[v as usize][2] == 1.0);
    let by_vertices = of(&[add(Region::Vertices(top_vertices.collect()))]);
    assert_eq!(by_vertices.triangles, of(&[add(top)]).triangles);
    assert_eq!(of(&[add(Region::All)]).triangles.len(), triangles.len());
}

#[test]
fn what_cannot_be_chosen_is_refused_by_name() {
    let (positions, triangles) = cube(2);
    let refused = |region| {
        let chosen = select_region(&positions, &triangles, &[add(region)], Coincident::default());
        chosen.unwrap_err()
    };
    let count = positions.len();
    assert_eq!(
        refused(Region::Component(Seed::Vertex(count as u32))),
        Error::SelectionOutOfRange { index: count, count }
    );
    let ball = Region::Within(Place::Ball {
        centre: [f64::NAN, 0.0, 0.0],
        radius: 1.0,
    });
    assert_matches!(refused(ball), Error::BadOption { .. });
    let flat = Region::HalfSpace {
        point: [0.0; 3],
        normal: [0.0; 3],
    };
    let range = "a vector that is not zero";
    let (name, value) = ("normal", 0.0);
    assert_eq!(refused(flat), Error::BadOption { name, value, range });
    assert_matches!(refused(bump(None)), Error::NoBump { .. });
    let geodesic = Region::Geodesic {
        seed: Seed::Point([0.0, f64::INFINITY, 0.0]),
        radius: 1.0,
    };
    assert_matches!(refused(geodesic), Error::BadOption { name: "point", .. });
    // No distance to such a place is a number, and without triangles there is none.
    let far = Region::Component(Seed::Point([1e200, 0.0, 0.0]));
    assert_matches!(refused(far), Error::BadOption { name: "point", .. });
    let nowhere = [add(Region::Component(EAST))];
    let refused = select_region(&positions, &[], &nowhere, Coincident::default()).unwrap_err();
    assert_matches!(refused, Error::BadOption { name: "point", .. });
}

/// The sphere with a bump (or a dent) in the east, of this width and height over the width, and noise over the edge.
fn spoiled(shape: &Shape, width: f64, height: f64, noise: f64, seed: u64) -> Vec<[f64; 3]> {
    let mut x = shape.noise(seed, noise);
    for p in &mut x {
        let d = (p[0] - 1.0).hypot(p[1].hypot(p[2]));
        let by = 1.0 + height * width * (-0.5 * (d / width).powi(2)).exp();
        *p = p.map(|c| c * by);
    }
    x
}

/// The bump is found and faired: what is left of it, over its height, and how far it was found to reach, over its width.
fn left(shape: &Shape, x: &[[f64; 3]], width: f64, height: f64) -> (f64, f64) {
    let steps = [add(bump(None))];
    let chosen = select_region(x, &shape.triangles, &steps, Coincident::default()).unwrap();
    let options = Options {
        threads: 1,
        ..Options::default()
    };
    let solution = fair(x, &shape.triangles, Selection::Faces(&chosen.triangles), &options).unwrap();
    assert_eq!(solution.report.outcome, Outcome::Converged);
    let off = |p: &[f64; 3]| (p.iter().map(|c| c * c).sum::<f64>().sqrt() - 1.0).abs();
    let near = |p: &&[f64; 3]| p[0] > (3.0 * width).cos();
    let worst = solution
        .positions
        .iter()
        .filter(near)
        .map(off)
        .fold(0.0, f64::max);
    (worst / (height * width).abs(), chosen.bumps[0].radius / width)
}

/// Without noise nothing is left of bumps and dents of any width but what a fair surface over half the sphere is off by: the rings
/// on a wide flank, on which the curvature does not change, are no ends.
#[test]
fn bumps_and_dents_are_found_whole() {
    are_found_whole(&[(2000, irregular(1))]);
}

#[test]
#[ignore = "full tier: 8,000 vertices"]
fn bumps_and_dents_of_finer_meshes_are_found_whole() {
    are_found_whole(&[(8000, irregular(2)), (8000, Sampling::Regular)]);
}

fn are_found_whole(cases: &[(usize, Sampling)]) {
    for &(n, sampling) in cases {
        let shape = sphere(n, sampling);
        for width in [0.08, 0.15, 0.3] {
            for height in [0.03, -0.1, 0.3] {
                let x = spoiled(&shape, width, height, 0.0, 0);
                let (left, reach) = left(&shape, &x, width, height);
                let off = (left * height * width).abs();
                assert!(
                    left < 0.02 || off < 4e-3,
                    "{n}, width {width}, height {height}: {left}"
                );
                assert!(
                    reach * width < 0.75 * PI,
                    "{n}, width {width}, height {height}: {reach}"
                );
            }
        }
    }
}

/// Noise, that of each vertex by itself, hides neither flanks nor ends.
#[test]
fn bumps_are_found_among_noise() {
    let shape = sphere(8000, irregular(3));
    let cases = [
        (1, 0.15, 0.5),
        (2, 0.15, -0.5),
        (3, 0.3, 0.5),
        (4, 0.08, 0.5),
        (5, 0.3, 0.1),
    ];
    for &(seed, width, height) in tier(&cases[..2], &cases) {
        for noise in [0.002, 0.01] {
            let x = spoiled(&shape, width, height, noise, seed);
            let (left, reach) = left(&shape, &x, width, height);
            println!("width {width}, height {height}, noise {noise}: {left:.3} left, reach {reach:.2}");
            assert!(
                left < if noise < 0.005 { 0.1 } else { 0.2 },
                "width {width}, height {height}, noise {noise}: {left}"
            );
        }
    }
}

/// Noise along the boundary of a small region lifts its fair surface, so that one region alone may seem to have all of a bump.
#[test]
fn bumps_are_found_whole_whatever_the_noise_of_a_flank() {
    let shape = sphere(8000, irregular(3));
    for seed in 10..18 {
        let x = spoiled(&shape, 0.22, 0.8, 0.005, seed);
        let (left, reach) = left(&shape, &x, 0.22, 0.8);
        println!("seed {seed}: {left:.3} left, reach {reach:.2}");
        assert_below!(left, 0.05);
    }
}

/// A sphere has none, with noise or without.
#[test]
fn where_no_bump_is_none_is_found() {
    for (noise, seed) in [(0.0, 0), (0.02, 5), (0.1, 6)] {
        let shape = sphere(4000, irregular(4));
        let x = shape.noise(seed, noise);
        let found = select_region(&x, &shape.triangles, &[add(bump(None))], Coincident::default());
        assert!(matches!(found, Err(Error::NoBump { .. })), "{noise}: {found:?}");
    }
}

/// Nor has a plane beside a bump, of which regions around the place have nothing but rounding until they meet it.
#[test]
fn a_plane_beside_a_bump_has_none() {
    const N: u32 = 61;
    let at = |v: u32| {
        let [x, y] = [v % N, v / N].map(|k| f64::from(k) - 30.0);
        let inside = (1.0 - (x * x + y * y) / 64.0).max(0.0);
        [x, y, 3.0 * inside.powi(3)]
    };
    let positions: Vec<[f64; 3]> = (0..N * N).map(at).collect();
    let cell = |c: u32| {
        let v = c / (N - 1) * N + c % (N - 1);
        [[v, v + 1, v + N + 1], [v, v + N + 1, v + N]]
    };
    let triangles: Vec<[u32; 3]> = (0..(N - 1) * (N - 1)).flat_map(cell).collect();
    let found = |seed: u32| {
        let named = Region::Bump {
            seed: Seed::Vertex(seed),
            size: None,
        };
        select_region(&positions, &triangles, &[add(named)], Coincident::default())
    };
    assert_matches!(found(12 * N + 12), Err(Error::NoBump { .. }));
    let bump = &found(30 * N + 30).unwrap().bumps[0];
    assert!(
        (2.5..3.5).contains(&bump.height) && bump.radius < 16.0,
        "{bump:?}"
    );
}

/// A bump that ends, on a sphere of equal triangles: nothing of it is missed, and not much more is taken than it has.
#[test]
fn a_bump_that_ends_is_not_taken_for_more_than_it_is() {
    let shape = sphere(8000, Sampling::Regular);
    for reach in [0.2, 0.3, 0.5] {
        let angle = |p: &[f64; 3]| p[0].clamp(-1.0, 1.0).acos();
        let lifted = |p: &[f64; 3]| {
            let inside = (1.0 - (angle(p) / reach).powi(2)).max(0.0);
            p.map(|c| c * (1.0 + 0.1 * reach * inside.powi(3)))
        };
        let x: Vec<[f64; 3]> = shape.positions.iter().map(lifted).collect();
        let steps = [add(bump(None))];
        let chosen = select_region(&x, &shape.triangles, &steps, Coincident::default()).unwrap();
        let mut is_in = vec![false; x.len()];
        for &t in &chosen.triangles {
            shape.triangles[t as usize]
                .iter()
                .for_each(|&v| is_in[v as usize] = true);
        }
        let missed = (0..x.len()).filter(|&v| angle(&shape.positions[v]) < 0.9 * reach && !is_in[v]);
        let taken = chosen.bumps[0].radius / reach;
        println!("reach {reach}: {taken:.2} of it taken");
        assert_eq!((missed.count(), taken < 2.0), (0, true), "reach {reach}: {taken}");
    }
}

/// How far free vertices are from the surface at most, after what is found in the middle of a spoiled shape is faired.
fn off_after(shape: &Shape, x: &[[f64; 3]], seed: [f64; 3], size: Option<f64>) -> f64 {
    let named = Region::Bump {
        seed: Seed::Point(seed),
        size,
    };
    let chosen = select_region(x, &shape.triangles, &[add(named)], Coincident::default()).unwrap();
    let selection = Selection::Faces(&chosen.triangles);
    let solution = fair(x, &shape.triangles, selection, &Options::default()).unwrap();
    assert_success(&solution.report.outcome);
    let surface = shape.surface.as_ref().expect("an exact surface");
    let off = solution.positions.iter().map(|p| surface.distance(*p));
    off.fold(0.0, f64::max)
}

/// A bump has no end that shows in the curvature, whose sign changes on its flank. What is left is what a fair surface misses of an ellipsoid.
#[test]
fn bumps_on_other_surfaces_are_taken_with_their_flanks() {
    let shapes = [
        ellipsoid_cap([1.0, 0.8, 0.6], 100.0, 3_000, irregular(1), 10),
        torus_patch(1.0, 0.4, 1.6, 3_000, irregular(2), 10),
        cylinder_band(3_000, irregular(3), 10),
    ];
    for (shape, width) in shapes.iter().zip([0.15, 0.08, 0.2]) {
        let surface = shape.surface.as_ref().expect("an exact surface");
        let middle = shape.free_vertices()[shape.free_count() / 2] as usize;
        let middle = shape.positions[middle];
        let raised = |p: &[f64; 3]| {
            let d = (0..3).map(|k| (p[k] - middle[k]).powi(2)).sum::<f64>() / (width * width);
            let (n, by) = (surface.normal(*p), 0.5 * width * (-d).exp());
            [0, 1, 2].map(|k| p[k] + by * n[k])
        };
        let x: Vec<[f64; 3]> = shape.positions.iter().map(raised).collect();
        let left = off_after(shape, &x, raised(&middle), None) / (0.5 * width);
        println!("width {width}: {left:.4} left");
        assert_below!(left, 0.01);
    }
}

/// A cylinder that ends so many widths from the middle of a bump, with it, and that middle.
fn bump_near_an_end(away: f64) -> (Shape, Vec<[f64; 3]>, [f64; 3]) {
    let shape = cylinder_band(8_000, irregular(3), 2);
    let end = shape.positions.iter().map(|p| p[2]).fold(f64::MIN, f64::max);
    let middle = [1.0, 0.0, end - away * 0.2];
    let raised = |p: &[f64; 3]| {
        let d = (0..3).map(|k| (p[k] - middle[k]).powi(2)).sum::<f64>() / 0.04;
        let by = 1.0 + 0.1 * (-d).exp();
        [p[0] * by, p[1] * by, p[2]]
    };
    let x = shape.positions.iter().map(raised).collect();
    (shape, x, raised(&middle))
}

/// Where the surface ends near a bump its vertices there stay, and the bump is found as elsewhere.
#[test]
fn a_bump_near_the_end_of_a_surface_is_found() {
    for away in [2.5, 3.0] {
        let (shape, x, place) = bump_near_an_end(away);
        let left = off_after(&shape, &x, place, None) / 0.1;
        println!("{away} widths from the end: {left:.4} left");
        assert_below!(left, 0.04);
    }
}

/// What lies at the end stays, so that a surface beneath would be none that was there.
#[test]
fn a_bump_that_is_cut_by_the_end_of_a_surface_is_none() {
    for away in [0.3, 0.7, 1.0, 1.4] {
        let (shape, x, place) = bump_near_an_end(away);
        let named = Region::Bump {
            seed: Seed::Point(place),
            size: None,
        };
        let chosen = select_region(&x, &shape.triangles, &[add(named)], Coincident::default());
        assert_matches!(chosen, Err(Error::NoBump { .. }));
    }
}

/// Twice as long as wide, and its place is at one end.
#[test]
fn a_scar_of_about_a_size_is_taken_whole_from_its_end() {
    let shape = sphere(16_000, irregular(7));
    let scarred = |p: &[f64; 3]| {
        let (along, across) = (p[1].abs() - 0.2, p[2] / 0.15);
        let d = across.powi(2) + (along.max(0.0) / 0.15).powi(2);
        match p[0] > 0.0 {
            true => p.map(|c| c * (1.0 - 0.04 * (-d).exp())),
            false => *p,
        }
    };
    let x: Vec<[f64; 3]> = shape.positions.iter().map(scarred).collect();
    let left = off_after(&shape, &x, scarred(&[0.98, 0.2, 0.0]), Some(0.6));
    println!("{:.3} left", left / 0.04);
    assert_below!(left, 0.02 * 0.04);
}

/// On a nose with a pimple the pimple is the smallest bump, and the nose is had by its size.
#[test]
fn of_two_bumps_the_smaller_one_is_taken_or_that_of_the_size() {
    let shape = sphere(16_000, irregular(8));
    let bump = |p: &[f64; 3], width: f64, height: f64| {
        let d = (p[0] - 1.0).hypot(p[1].hypot(p[2])) / width;
        height * (-d * d).exp()
    };
    let nose = |p: &[f64; 3]| 1.0 + bump(p, 0.35, 0.15);
    let spoiled = |p: &[f64; 3]| p.map(|c| c * (nose(p) + bump(p, 0.07, 0.04)));
    let x: Vec<[f64; 3]> = shape.positions.iter().map(spoiled).collect();
    let found = |size: Option<f64>| {
        let named = Region::Bump {
            seed: Seed::Point([1.19, 0.0, 0.0]),
            size,
        };
        select_region(&x, &shape.triangles, &[add(named)], Coincident::default()).unwrap()
    };
    let [pimple, whole] = [found(None), found(Some(0.6))];
    println!("{:?} {:?}", pimple.bumps, whole.bumps);
    assert_below!(pimple.bumps[0].radius, 0.3);
    assert_at_least!(pimple.bumps[0].height, 0.03);
    assert_above!(whole.bumps[0].radius, 0.5);
    assert_at_least!(whole.bumps[0].height, 0.15);
}

#[test]
fn a_place_beside_the_surface_is_taken_on_it_and_told() {
    let shape = sphere(2000, irregular(3));
    let east = |x: f64| {
        add(Region::Geodesic {
            seed: Seed::Point([x, 0.0, 0.0]),
            radius: 0.3,
        })
    };
    let on = select(&shape, &[east(1.0)]);
    let beside = select(&shape, &[east(4.0), add(Region::Component(Seed::Vertex(0)))]);
    // The nearest points of a polyhedron to both are a little apart.
    assert_below!(on.counts[0].abs_diff(beside.counts[0]) * 10, on.counts[0]);
    assert!(on.misses[0] < 0.01, "{:?}", on.misses);
    assert_eq!(beside.misses.len(), 1);
    assert!((beside.misses[0] - 3.0).abs() < 0.01, "{:?}", beside.misses);
}

#[test]
fn balls_and_boxes_turned_inside_out_are_refused() {
    let shape = sphere(500, irregular(1));
    let refused = |place: Place| {
        let steps = [add(Region::Within(place))];
        select_region(&shape.positions, &shape.triangles, &steps, Coincident::default()).unwrap_err()
    };
    let error = refused(Place::Ball {
        centre: [0.0; 3],
        radius: -1.0,
    });
    assert_eq!(
        error.to_string(),
        "option within is -1: it must be a radius of at least 0"
    );
    let error = refused(Place::Box {
        low: [0.0, 2.0, 0.0],
        high: [1.0; 3],
    });
    assert_eq!(
        error.to_string(),
        "option within is 2: it must be a low corner that is not above the high one"
    );
}

/// The surroundings of its top face all sides: the dome that is fair there was never beneath it. Near its edges they go on through regions.
#[test]
fn a_cube_has_no_bump() {
    for cells in [6, 8, 12, 20] {
        let (positions, triangles) = cube(cells);
        for place in [[0.5, 0.5, 1.0], [0.8, 0.8, 1.0], [0.6, 0.9, 1.0]] {
            let named = Region::Bump {
                seed: Seed::Point(place),
                size: None,
            };
            let found = select_region(&positions, &triangles, &[add(named)], Coincident::default());
            assert!(
                matches!(found, Err(Error::NoBump { .. })),
                "{cells}, {place:?}: {found:?}"
            );
        }
    }
}
