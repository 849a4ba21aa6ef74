//! Rims that are noise: spheres with noise, and of voxels, with a cap missing.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use crate::fairing::{Bars, irregular, vector};
use crate::tier::tier;
use fairmesh::{
    Coincident, Error, FillOptions, FillOutcome, Filled, Join, Loops, Options, Outcome, Rim, boundary_loops,
    fill_holes, rim_roughness,
};
use fairmesh_shapes::{sphere_with_hole, sphere_without_band};
use nalgebra::Vector3;

type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// Numbers that are the same on every machine.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn gauss(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
        radius * (TAU * self.unit()).cos()
    }

    fn vector(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.gauss())
    }
}

/// The unit sphere without a cap of 60 degrees, and its mean edge.
fn sphere(n: usize, seed: u64) -> (Mesh, f64) {
    let shape = sphere_with_hole(60.0, n, irregular(seed), 3);
    let is_free = |t: &&[u32; 3]| t.iter().all(|&v| shape.free[v as usize]);
    let triangles = shape.triangles.iter().filter(is_free).copied().collect();
    let edge = shape.mean_edge();
    ((shape.positions, triangles), edge)
}

/// Which vertices are in the first rings around the first loop.
fn rings((x, t): &Mesh, count: usize) -> Vec<bool> {
    let mut is_in = vec![false; x.len()];
    let loops = boundary_loops(x, t).unwrap();
    loops[0].vertices.iter().for_each(|&v| is_in[v as usize] = true);
    for _ in 1..count {
        let before = is_in.clone();
        let near = t.iter().filter(|t| t.iter().any(|&v| before[v as usize]));
        near.flatten().for_each(|&v| is_in[v as usize] = true);
    }
    is_in
}

#[derive(Debug, Clone, Copy)]
struct Noise {
    /// Of each coordinate.
    deviation: f64,
    is_isotropic: bool,
    is_everywhere: bool,
}

fn noisy(mesh: &Mesh, noise: Noise, random: &mut Random) -> Mesh {
    let near = rings(mesh, 3);
    let moved = |(p, is_near): (&[f64; 3], &bool)| {
        let (p, way) = (vector(p), random.vector() * noise.deviation);
        let way = if noise.is_isotropic { way } else { p * way.x };
        match noise.is_everywhere || *is_near {
            true => (p + way).into(),
            false => p.into(),
        }
    };
    let x = mesh.0.iter().zip(&near).map(moved).collect();
    (x, mesh.1.clone())
}

fn options(rim: Rim) -> FillOptions {
    FillOptions {
        rim,
        fairing: Options {
            threads: 1,
            ..Options::default()
        },
        ..FillOptions::default()
    }
}

fn relaxed(relax: usize) -> Rim {
    Rim { relax, within: None }
}

fn fill((x, t): &Mesh, rim: Rim) -> Filled {
    fill_holes(x, t, &options(rim)).unwrap()
}

/// Distances of the new vertices from a sphere.
fn errors(filled: &Filled, centre: Vector3<f64>, radius: f64) -> Vec<f64> {
    let new = filled.loops[0].vertices.clone();
    let new = new.map(|v| vector(&filled.positions[v as usize]));
    new.map(|p| (p - centre).norm() - radius).collect()
}

fn rms(errors: &[f64]) -> f64 {
    (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt()
}

/// The largest angle between the patch and the mesh, in degrees.
fn crease(filled: &Filled) -> f64 {
    let first = filled.loops[0].triangles.start as usize;
    let normal = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| vector(&filled.positions[v as usize]));
        (b - a).cross(&(c - a))
    };
    let mut at = BTreeMap::new();
    for t in &filled.triangles[..first] {
        at.extend((0..3).map(|k| ((t[k], t[(k + 1) % 3]), normal(t))));
    }
    let mut largest: f64 = 0.0;
    for t in &filled.triangles[first..] {
        for k in 0..3 {
            if let Some(other) = at.get(&(t[(k + 1) % 3], t[k])) {
                largest = largest.max(normal(t).angle(other));
            }
        }
    }
    largest.to_degrees()
}

fn is_fair(filled: &Filled) -> bool {
    let report = &filled.loops[0];
    let fairing = report.fairing.as_ref();
    report.outcome == FillOutcome::Faired && fairing.is_some_and(|f| f.outcome == Outcome::Converged)
}

/// `most_told`: so many of those whose mesh noise of 0.3 edges in all directions has tangled may be told not to be sound.
fn check_noise(seeds: std::ops::Range<u64>, n: usize, most_told: u32) {
    let mut bars = Bars::default();
    let mut told = 0;
    for seed in seeds {
        let (mesh, edge) = sphere(n, seed);
        let own = crease(&fill(&mesh, Rim::default()));
        for (is_isotropic, is_everywhere) in [(false, false), (false, true), (true, false), (true, true)] {
            for &part in tier(&[0.05, 0.2][..], &[0.05, 0.1, 0.2, 0.3]) {
                let noise = Noise {
                    deviation: part * edge,
                    is_isotropic,
                    is_everywhere,
                };
                let rough = noisy(&mesh, noise, &mut Random(seed + 1000));
                let filled = fill(&rough, relaxed(3));
                let what = format!("seed {seed}, {part} of an edge, {noise:?}");
                let report = filled.loops[0].rim.as_ref().unwrap();
                let rms = rms(&errors(&filled, Vector3::zeros(), 1.0));
                bars.at_most(&what, rms, 0.6 * noise.deviation);
                let is_met = is_fair(&filled) && crease(&filled) <= 1.5 * own;
                let is_told = !is_fair(&filled) || !report.is_sound();
                if is_isotropic && part > 0.25 && !is_met && is_told {
                    told += 1;
                } else {
                    bars.check(&what, is_fair(&filled), format!("{:?}", filled.loops[0].outcome));
                    bars.at_most(format!("{what}: crease"), crease(&filled), 1.5 * own);
                }
                bars.at_most(
                    format!("{what}: largest"),
                    report.largest,
                    report.within * (1.0 + 1e-12),
                );
                if is_everywhere {
                    bars.at_most(format!("{what}: noise"), report.noise, 1.15 * noise.deviation);
                    bars.at_least(format!("{what}: noise"), report.noise, 0.85 * noise.deviation);
                }
            }
        }
    }
    bars.at_most("tangled", f64::from(told), f64::from(most_told));
    bars.finish();
}

#[test]
fn a_noisy_rim_is_drawn_to_the_surface() {
    check_noise(0..1, 1500, 0);
}

#[test]
#[ignore = "full tier: 16 noises of 8 seeds"]
fn noisy_rims_of_more_seeds_are_drawn_to_the_surface() {
    check_noise(0..8, 3000, 2);
}

/// The cubes whose centres lie in a ball: their faces to the outside, as a raw staircase.
fn staircase(radius: f64, centre: Vector3<f64>) -> Mesh {
    let (mut numbers, mut x, mut t) = (BTreeMap::new(), Vec::new(), Vec::new());
    each_cell(radius, |cell| {
        for (axis, side) in [0, 1, 2].into_iter().flat_map(|axis| [(axis, -1), (axis, 1)]) {
            let mut beside = cell;
            beside[axis] += side;
            if !is_in(radius, centre, cell) || is_in(radius, centre, beside) {
                continue;
            }
            let face = square(axis, side).map(|offset| {
                let twice: [i64; 3] = std::array::from_fn(|k| 2 * cell[k] + offset[k]);
                *numbers.entry(twice).or_insert_with(|| {
                    x.push(twice.map(|c| 0.5 * c as f64));
                    x.len() as u32 - 1
                })
            });
            t.extend([[face[0], face[1], face[2]], [face[0], face[2], face[3]]]);
        }
    });
    (x, t)
}

/// Marching cubes over the same: vertices in the middle of edges between inside and outside.
fn marching(radius: f64, centre: Vector3<f64>) -> Mesh {
    let (mut numbers, mut x, mut t) = (BTreeMap::new(), Vec::new(), Vec::new());
    each_cell(radius, |cell| {
        // In each face of the cube whose corner this is, from where its boundary leaves the ball to where it came in.
        let mut onward = BTreeMap::new();
        for (axis, side) in [0, 1, 2].into_iter().flat_map(|axis| [(axis, -1), (axis, 1)]) {
            let face = square(axis, side)
                .map(|offset| -> [i64; 3] { std::array::from_fn(|k| cell[k] + (offset[k] + 1) / 2) });
            let inside = face.map(|corner| is_in(radius, centre, corner));
            let middle =
                |i: usize| -> [i64; 3] { std::array::from_fn(|k| face[i][k] + face[(i + 1) % 4][k]) };
            for i in (0..4).filter(|&i| !inside[i] && inside[(i + 1) % 4]) {
                let last = (i + 1..i + 4).find(|j| !inside[(j + 1) % 4]).unwrap();
                onward.insert(middle(last % 4), middle(i));
            }
        }
        while let Some((first, mut at)) = onward.pop_first() {
            let mut polygon = vec![first];
            while at != first {
                polygon.push(at);
                at = onward.remove(&at).unwrap();
            }
            let number = |twice: [i64; 3]| {
                *numbers.entry(twice).or_insert_with(|| {
                    x.push(twice.map(|c| 0.5 * c as f64));
                    x.len() as u32 - 1
                })
            };
            let polygon: Vec<u32> = polygon.into_iter().map(number).collect();
            t.extend((1..polygon.len() - 1).map(|i| [polygon[0], polygon[i + 1], polygon[i]]));
        }
    });
    (x, t)
}

fn each_cell(radius: f64, mut visit: impl FnMut([i64; 3])) {
    let most = radius.ceil() as i64 + 2;
    for i in -most..=most {
        for j in -most..=most {
            (-most..=most).for_each(|k| visit([i, j, k]));
        }
    }
}

fn is_in(radius: f64, centre: Vector3<f64>, cell: [i64; 3]) -> bool {
    (vector(&cell.map(|c| c as f64)) - centre).norm() < radius
}

/// The corners of a face of the cube from -1 to 1, counter-clockwise seen from outside.
fn square(axis: usize, side: i64) -> [[i64; 3]; 4] {
    let mut corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)].map(|(p, q)| {
        let mut corner = [side; 3];
        corner[(axis + 1) % 3] = p;
        corner[(axis + 2) % 3] = q;
        corner
    });
    if side < 0 {
        corners.reverse();
    }
    corners
}

fn check_voxels(diameters: &[f64], seeds: std::ops::Range<u64>, most_told: u32) {
    let mut bars = Bars::default();
    let mut told = 0;
    type Make = fn(f64, Vector3<f64>) -> Mesh;
    for (kind, make) in [("staircase", staircase as Make), ("marching cubes", marching)] {
        for (&diameter, seed) in diameters.iter().flat_map(|d| seeds.clone().map(move |s| (d, s))) {
            let mut random = Random(seed);
            let (centre, radius) = (random.vector() * 0.3, 0.5 * diameter);
            let axis = random.vector().normalize();
            let whole = make(radius, centre);
            for angle in [30.0f64, 60.0] {
                let is_left = |t: &&[u32; 3]| {
                    let [a, b, c] = t.map(|v| vector(&whole.0[v as usize]));
                    let way = (a + b + c) / 3.0 - centre;
                    way.dot(&axis) < way.norm() * angle.to_radians().cos()
                };
                let t: Vec<[u32; 3]> = whole.1.iter().filter(is_left).copied().collect();
                let loops = boundary_loops(&whole.0, &t).unwrap();
                let longest = (0..loops.len()).max_by_key(|&l| loops[l].vertices.len()).unwrap();
                let options = FillOptions {
                    loops: Loops::Chosen(vec![longest]),
                    ..options(relaxed(3))
                };
                let filled = fill_holes(&whole.0, &t, &options).unwrap();
                let what = format!("{kind}, {diameter} across, seed {seed}, {angle} degrees");
                let errors = errors(&filled, centre, radius);
                told += u32::from(!is_fair(&filled));
                // One that is told may have no new vertices.
                if is_fair(&filled) || !errors.is_empty() {
                    bars.at_most(&what, rms(&errors), 0.25);
                    bars.at_most(&what, errors.iter().fold(0.0, |most, e| e.abs().max(most)), 0.5);
                }
            }
        }
    }
    // Loops of raw faces are jagged, and may overlap themselves when they are drawn together.
    bars.at_most("not faired", f64::from(told), f64::from(most_told));
    bars.finish();
}

#[test]
fn a_sphere_of_voxels_is_filled_to_half_a_voxel() {
    check_voxels(&[tier(30.0, 40.0)], 0..1, 0);
}

#[test]
#[ignore = "full tier: spheres of up to 100 voxels"]
fn spheres_of_voxels_are_filled_to_half_a_voxel() {
    check_voxels(&[40.0, 55.0, 70.0, 100.0], 0..4, 4);
}

#[test]
fn an_exact_rim_stays() {
    let (mesh, _) = sphere(1000, 3);
    let without = fill(&mesh, Rim::default());
    assert_eq!(without.positions[..mesh.0.len()], mesh.0);
    assert!(without.loops[0].rim.is_none(), "{:?}", without.loops[0].rim);
    let filled = fill(&mesh, relaxed(3));
    let report = filled.loops[0].rim.as_ref().unwrap();
    assert!(report.largest < 1e-12 && report.noise < 1e-12, "{report:?}");
    assert_below!(rms(&errors(&filled, Vector3::zeros(), 1.0)), 1e-8);
    let near = rings(&mesh, 3);
    for v in (0..mesh.0.len()).filter(|&v| !near[v]) {
        assert_eq!(filled.positions[v], mesh.0[v]);
    }
}

#[test]
fn no_vertex_moves_further_than_it_may() {
    let (mesh, edge) = sphere(1000, 3);
    let noise = Noise {
        deviation: 0.2 * edge,
        is_isotropic: true,
        is_everywhere: true,
    };
    let mesh = noisy(&mesh, noise, &mut Random(5));
    let within = 0.15 * edge;
    let rim = Rim {
        relax: 2,
        within: Some(within),
    };
    let filled = fill(&mesh, rim);
    let report = filled.loops[0].rim.as_ref().unwrap();
    let near = rings(&mesh, 2);
    let moved: Vec<f64> = (0..mesh.0.len())
        .map(|v| (vector(&filled.positions[v]) - vector(&mesh.0[v])).norm())
        .collect();
    assert_all!(0..mesh.0.len(), |v| near[v] || moved[v] == 0.0);
    let count = moved.iter().filter(|&&way| way > 0.0).count();
    let largest = moved.iter().copied().fold(0.0, f64::max);
    assert_at_most!(largest, within * (1.0 + 1e-12));
    assert_eq!(
        (report.moved, report.largest, report.within),
        (count, largest, within)
    );
    let mean = (moved.iter().map(|way| way * way).sum::<f64>() / count as f64).sqrt();
    assert_near!(report.rms / mean, 1.0, 1e-12);
    // A normal distribution has 45 of 100 beyond three quarters of its deviation.
    let part = report.bounded as f64 / near.iter().filter(|&&near| near).count() as f64;
    assert!((0.35..0.55).contains(&part), "{part}");
}

#[test]
fn what_is_left_open_keeps_its_rim() {
    let (mesh, edge) = sphere(1000, 3);
    let noise = Noise {
        deviation: 0.1 * edge,
        is_isotropic: false,
        is_everywhere: true,
    };
    let mesh = noisy(&mesh, noise, &mut Random(5));
    let options = FillOptions {
        loops: Loops::UpTo(10),
        ..options(relaxed(3))
    };
    let filled = fill_holes(&mesh.0, &mesh.1, &options).unwrap();
    assert_eq!(filled.positions, mesh.0);
    assert!(filled.loops[0].rim.is_none(), "{:?}", filled.loops[0].rim);
}

#[test]
fn relaxing_depends_neither_on_threads_nor_on_unit_and_place() {
    let (mesh, edge) = sphere(1000, 3);
    let noise = Noise {
        deviation: 0.2 * edge,
        is_isotropic: true,
        is_everywhere: true,
    };
    let mesh = noisy(&mesh, noise, &mut Random(5));
    let one = fill(&mesh, relaxed(3));
    for threads in [2, 3] {
        let mut options = options(relaxed(3));
        options.fairing.threads = threads;
        let several = fill_holes(&mesh.0, &mesh.1, &options).unwrap();
        assert_eq!(
            (several.positions, several.triangles),
            (one.positions.clone(), one.triangles.clone())
        );
    }
    let large = (
        mesh.0.iter().map(|p| p.map(|c| 1024.0 * c)).collect(),
        mesh.1.clone(),
    );
    let scaled = fill(&large, relaxed(3));
    let pairs = scaled.positions.iter().zip(&one.positions);
    assert_all!(pairs, |(a, b)| *a == b.map(|c| 1024.0 * c));
    let turn = nalgebra::Rotation3::from_euler_angles(0.3, 1.1, -2.0);
    let by = Vector3::new(0.7, -0.2, 0.4);
    let moved = |p: &[f64; 3]| -> [f64; 3] { (turn * vector(p) + by).into() };
    let turned = fill(&(mesh.0.iter().map(moved).collect(), mesh.1.clone()), relaxed(3));
    let apart = |v: usize| (vector(&moved(&one.positions[v])) - vector(&turned.positions[v])).norm();
    assert_below!((0..mesh.0.len()).map(apart).fold(0.0, f64::max), 1e-9);
}

#[test]
fn the_rims_of_joined_loops_are_relaxed() {
    let shape = sphere_without_band(2500, irregular(1), 40.0);
    let edge = shape.mean_edge();
    let mut random = Random(7);
    let rough = |p: &[f64; 3]| -> [f64; 3] { (vector(p) * (1.0 + 0.1 * edge * random.gauss())).into() };
    let x: Vec<[f64; 3]> = shape.positions.iter().map(rough).collect();
    let loops = boundary_loops(&x, &shape.triangles).unwrap();
    let mut order: Vec<usize> = (0..loops.len()).collect();
    order.sort_by_key(|&l| std::cmp::Reverse(loops[l].vertices.len()));
    let options = FillOptions {
        loops: Loops::Chosen(Vec::new()),
        join: Join::Groups(vec![order[..2].to_vec()]),
        ..options(relaxed(3))
    };
    let filled = fill_holes(&x, &shape.triangles, &options).unwrap();
    assert!(is_fair(&filled), "{:?}", filled.loops[0]);
    let rms = rms(&errors(&filled, Vector3::zeros(), 1.0));
    assert!(rms < 0.06 * edge, "{}", rms / edge);
    for l in &order[..2] {
        let stays = |&&v: &&u32| filled.positions[v as usize] == x[v as usize];
        assert_eq!(loops[*l].vertices.iter().filter(stays).count(), 0);
    }
}

#[test]
fn what_is_too_small_to_fit_says_so() {
    let x = [
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
    ];
    let t = [
        [0, 1, 4],
        [1, 2, 4],
        [2, 3, 4],
        [3, 0, 4],
        [1, 0, 5],
        [2, 1, 5],
        [3, 2, 5],
    ];
    let filled = fill(&(x.to_vec(), t.to_vec()), relaxed(2));
    let report = filled.loops[0].rim.as_ref().unwrap();
    assert_eq!((report.radius, report.moved), (0.0, 0));
    assert_eq!(filled.positions[..6], x);
}

#[test]
fn a_bound_has_to_be_one() {
    let (mesh, _) = sphere(500, 3);
    for value in [0.0, -1.0, f64::INFINITY] {
        let rim = Rim {
            relax: 2,
            within: Some(value),
        };
        let error = fill_holes(&mesh.0, &mesh.1, &options(rim)).unwrap_err();
        let (name, range) = ("relax_within", "positive and finite");
        assert_eq!(error, Error::BadOption { name, value, range });
    }
}

/// Bumps of so many heights beside each other, along the boundary of a square hole in a sheet: in the whole of it, or at one side only.
fn bumpy_sheet(is_everywhere: bool) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let at = |i: u32, j: u32| {
        let is_bumpy = is_everywhere || (i < 28 && (20..28).contains(&j));
        let height = 0.25 * f64::from((7 * i + 5 * j + i * j) % 5) - 0.5;
        [f64::from(i), f64::from(j), if is_bumpy { height } else { 0.0 }]
    };
    let positions = (0..81 * 81).map(|v| at(v / 81, v % 81)).collect();
    let squares = (0..80 * 80).map(|s| (s / 80, s % 80));
    let triangles = squares
        .filter(|&(i, j)| !(24..56).contains(&i) || !(24..56).contains(&j))
        .map(|(i, j)| 81 * i + j)
        .flat_map(|a| [[a, a + 81, a + 82], [a, a + 82, a + 1]])
        .collect();
    (positions, triangles)
}

#[test]
#[ignore = "full tier: 6 s"]
fn a_feature_beside_a_hole_is_not_advised_to_be_smoothed() {
    let rough = |is_everywhere: bool| {
        let (x, t) = bumpy_sheet(is_everywhere);
        let loops = boundary_loops(&x, &t).unwrap();
        let hole = (0..loops.len()).min_by_key(|&l| loops[l].vertices.len()).unwrap();
        let found = rim_roughness(&x, &t, Coincident::default()).unwrap()[hole].unwrap();
        let asked = FillOptions {
            rim: Rim {
                relax: 3,
                within: None,
            },
            ..FillOptions::default()
        };
        let report = fill_holes(&x, &t, &asked).unwrap().loops.swap_remove(hole);
        (found, report.rim.unwrap())
    };
    let (noisy, report) = rough(true);
    assert_above!(noisy.ratio(), 2.0);
    assert!(noisy.advice.is_some());
    assert!(report.is_even(), "{}", report.evenness);
    let (feature, report) = rough(false);
    assert!(feature.ratio() > 2.0, "{}", feature.ratio());
    assert_eq!(feature.advice, None);
    assert!(!report.is_even(), "{}", report.evenness);
}

/// With as much noise as an edge is long, relaxing folds what is around.
#[test]
fn automatic_relaxing_is_what_is_advised_where_that_is_sound() {
    let (mesh, edge) = sphere(1500, 3);
    let clean = fill(&mesh, relaxed(Rim::AUTO));
    assert_eq!(clean.positions[..mesh.0.len()], mesh.0);
    assert!(clean.loops[0].rim.is_none());
    for (part, is_followed) in [(0.2, true), (0.6, false)] {
        let noise = Noise {
            deviation: part * edge,
            is_isotropic: true,
            is_everywhere: true,
        };
        let rough = noisy(&mesh, noise, &mut Random(1));
        let found = rim_roughness(&rough.0, &rough.1, Coincident::default()).unwrap();
        let advice = found[0].unwrap().advice.unwrap();
        let [auto, followed] = [Rim::AUTO, advice.relax].map(|relax| fill(&rough, relaxed(relax)));
        let report = followed.loops[0].rim.as_ref().unwrap();
        assert_eq!(report.is_sound(), is_followed, "{report:?}");
        if is_followed {
            assert_eq!(auto.positions, followed.positions);
        } else {
            assert_eq!(auto.positions[..mesh.0.len()], rough.0);
        }
        assert_eq!(auto.loops[0].rim.is_some(), is_followed);
    }
}
