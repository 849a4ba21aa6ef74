//! The generators against what they promise: topology, exactness, counts, determinism.

use fairmesh_shapes::*;
use std::collections::HashMap;

#[macro_use]
#[path = "common/asserts.rs"]
mod asserts;
#[path = "common/tier.rs"]
mod tier;
use tier::tier;

const IRREGULAR: Sampling = Sampling::Irregular { seed: 7 };

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// By its first two corners, the third corner of the triangle on the left of an edge.
type Thirds = HashMap<(u32, u32), u32>;

fn thirds(s: &Shape) -> Thirds {
    let mut thirds = Thirds::new();
    for t in &s.triangles {
        for k in 0..3 {
            assert_ne!(t[k], t[(k + 1) % 3]);
            assert!(
                thirds.insert((t[k], t[(k + 1) % 3]), t[(k + 2) % 3]).is_none(),
                "edge used twice in one direction"
            );
        }
    }
    thirds
}

/// The boundary's next vertex behind each vertex of the boundary.
fn boundary_steps(s: &Shape, thirds: &Thirds) -> HashMap<u32, u32> {
    let mut boundary = HashMap::new();
    for &(a, b) in thirds.keys() {
        if !thirds.contains_key(&(b, a)) {
            assert!(
                boundary.insert(a, b).is_none(),
                "two boundary edges leave vertex {a}"
            );
            assert!(
                !s.free[a as usize] && !s.free[b as usize],
                "a free vertex on the boundary"
            );
        }
    }
    boundary
}

/// One fan at every vertex: as many triangles as a walk around it meets.
fn check_fans(s: &Shape, thirds: &Thirds, boundary: &HashMap<u32, u32>) {
    let mut corners = vec![0usize; s.positions.len()];
    let all = s.triangles.iter().flatten();
    all.for_each(|&v| corners[v as usize] += 1);
    assert!(corners.iter().all(|&c| c > 0), "a vertex without triangle");
    let mut start = HashMap::new();
    for &(a, b) in thirds.keys() {
        if !boundary.contains_key(&a) || boundary[&a] == b {
            start.insert(a, b);
        }
    }
    for (&v, &first) in &start {
        let (mut w, mut met) = (first, 0);
        while let Some(&third) = thirds.get(&(v, w)) {
            (w, met) = (third, met + 1);
            if w == first {
                break;
            }
        }
        assert_eq!(met, corners[v as usize], "two fans at vertex {v}");
    }
}

/// Euler characteristic and boundary loops of a consistently oriented manifold; panics on anything else.
fn topology(s: &Shape) -> (i64, Vec<usize>) {
    let thirds = thirds(s);
    let mut boundary = boundary_steps(s, &thirds);
    check_fans(s, &thirds, &boundary);
    let edges = (thirds.len() + boundary.len()) / 2;
    let euler = s.positions.len() as i64 - edges as i64 + s.triangles.len() as i64;
    let mut loops = Vec::new();
    while let Some(&first) = boundary.keys().min() {
        let (mut v, mut length) = (first, 0);
        while let Some(w) = boundary.remove(&v) {
            (v, length) = (w, length + 1);
        }
        assert_eq!(v, first);
        loops.push(length);
    }
    loops.sort_unstable();
    (euler, loops)
}

/// Everything an exact shape promises, with its topology given.
fn check(name: &str, s: &Shape, n: usize, euler: i64, loops: usize) {
    let (e, l) = topology(s);
    assert_eq!((e, l.len()), (euler, loops), "{name}");
    let count = s.free_count();
    assert!(
        count.abs_diff(n) * 10 <= n.max(100),
        "{name}: {count} free of {n}"
    );
    for t in &s.triangles {
        let [a, b, c] = t.map(|v| s.positions[v as usize]);
        let area = cross(sub(b, a), sub(c, a));
        assert!(dot(area, area) > 0.0, "{name}: no area");
        for v in t {
            assert!(
                dot(area, s.normals[*v as usize]) > 0.0,
                "{name}: a triangle seen from behind"
            );
        }
    }
    for (p, m) in s.positions.iter().zip(&s.normals) {
        assert!((dot(*m, *m).sqrt() - 1.0).abs() < 1e-14, "{name}: normal {m:?}");
        if let Some(surface) = &s.surface {
            let d = surface.distance(*p);
            assert!(d < 1e-13, "{name}: distance {d:e} of {p:?}");
            let n = surface.normal(*p);
            assert!(
                dot(sub(n, *m), sub(n, *m)).sqrt() < 1e-11,
                "{name}: normal {n:?} {m:?}"
            );
        }
    }
    let boundary = s.boundary_normals();
    assert_all!(boundary.iter(), |(v, _)| !s.free[*v as usize]);
    assert_all!(boundary.iter(), |(v, m)| *m == s.normals[*v as usize]);
    assert_above!(boundary.len(), 5);
    assert_eq!(s.free_vertices().len(), count);
}

type Make = fn(usize, Sampling, usize) -> Shape;

/// Every family with its Euler characteristic and number of boundary loops.
fn families() -> Vec<(&'static str, Make, i64, usize)> {
    vec![
        ("cap", |n, s, o| sphere_cap(60.0, n, s, o), 1, 1),
        ("wide cap", |n, s, o| sphere_cap(110.0, n, s, o), 1, 1),
        ("hole 60", |n, s, o| sphere_with_hole(60.0, n, s, o), 1, 1),
        ("hole 45", |n, s, o| sphere_with_hole(45.0, n, s, o), 1, 1),
        ("hole 30", |n, s, o| sphere_with_hole(30.0, n, s, o), 1, 1),
        ("saddle", saddle_graph, 1, 1),
        ("cylinder", cylinder_band, 0, 2),
        ("catenoid", catenoid_band, 0, 2),
        ("zone", |n, s, o| sphere_zone(-50.0, 60.0, n, s, o), 0, 2),
        ("unduloid", |n, s, o| unduloid_band(0.6, 1.0, n, s, o), 0, 2),
        (
            "revolution",
            |n, s, o| revolution(1.0, -1.0, 0.5, 2.0, n, s, o),
            0,
            2,
        ),
        ("biharmonic revolution", biharmonic, 0, 2),
        (
            "ellipsoid",
            |n, s, o| ellipsoid_cap([1.0, 0.8, 0.6], 50.0, n, s, o),
            1,
            1,
        ),
        ("torus", |n, s, o| torus_patch(1.0, 0.4, 1.0, n, s, o), 1, 1),
    ]
}

/// The band of a sound profile.
fn revolution(f0: f64, h0: f64, c: f64, length: f64, n: usize, sampling: Sampling, outside: usize) -> Shape {
    let profile = HarmonicProfile::new(f0, h0, c, length).expect("a sound profile");
    revolution_band(&profile, n, sampling, outside).expect("sound surroundings")
}

/// A band on which the Laplacian of the mean curvature is harmonic and not constant.
fn biharmonic(n: usize, sampling: Sampling, outside: usize) -> Shape {
    let profile = HarmonicProfile::biharmonic(1.2, -0.8, 0.5, [0.7, -0.4], 1.2).expect("a sound profile");
    revolution_band(&profile, n, sampling, outside).expect("sound surroundings")
}

#[test]
fn exact_shapes_keep_their_promises() {
    for (name, make, euler, loops) in families() {
        for n in [500, 3_000] {
            for &outside in tier(&[0, 4][..], &[0, 1, 4]) {
                for sampling in [Sampling::Regular, IRREGULAR, Sampling::locally_refined()] {
                    let name = format!("{name} {n} {outside} {sampling:?}");
                    check(&name, &make(n, sampling, outside), n, euler, loops);
                }
            }
        }
    }
}

#[test]
fn irregular_seeds_stay_manifold() {
    for (name, make, euler, loops) in families() {
        for seed in 0..tier(5, 15) {
            for outside in [0, 4] {
                let s = make(700, Sampling::Irregular { seed }, outside);
                check(
                    &format!("{name} seed {seed} outside {outside}"),
                    &s,
                    700,
                    euler,
                    loops,
                );
            }
        }
    }
}

#[test]
fn valences() {
    for (name, make, ..) in families() {
        let s = make(10_000, IRREGULAR, 4);
        let (low, high) = s.valence_range();
        assert!(
            low == 3 && (10..=13).contains(&high),
            "{name}: valences {low} to {high}"
        );
        let regular = make(10_000, Sampling::Regular, 4).valence_range();
        assert_eq!(
            regular,
            if name.starts_with("hole") { (5, 7) } else { (6, 6) },
            "{name}"
        );
    }
}

#[test]
fn same_seed_same_bits() {
    for (_, make, ..) in families() {
        let (a, b) = (make(2_000, IRREGULAR, 2), make(2_000, IRREGULAR, 2));
        assert_eq!(a, b);
        assert_eq!(a.noise(3, 0.4), b.noise(3, 0.4));
        assert_eq!(a.random(3), b.random(3));
        assert_eq!(a.renumbered(5), b.renumbered(5));
        assert_ne!(
            a.positions,
            make(2_000, Sampling::Irregular { seed: 8 }, 2).positions
        );
        assert_ne!(a.noise(3, 0.4), b.noise(4, 0.4));
    }
}

#[test]
fn wrong_starts_leave_the_fixed_vertices_alone() {
    for (name, make, ..) in families() {
        let s = make(3_000, IRREGULAR, 2);
        for start in [s.flat(), s.noise(1, 0.5), s.random(1)] {
            let same = |v: &usize| start[*v] == s.positions[*v];
            assert_all!((0..s.free.len()).filter(|&v| !s.free[v]), |v| same(&v));
            let far = (0..s.free.len())
                .filter(|&v| s.free[v])
                .map(|v| dot(sub(start[v], s.positions[v]), sub(start[v], s.positions[v])));
            assert!(far.fold(0.0, f64::max).sqrt() > 0.02, "{name}");
        }
        let (noise, count) = (s.noise(1, 0.5), s.free_count() as f64);
        let sum: f64 = noise
            .iter()
            .zip(&s.positions)
            .map(|(a, b)| dot(sub(*a, *b), sub(*a, *b)))
            .sum();
        let deviation = (sum / (3.0 * count)).sqrt() / s.mean_edge();
        assert!((deviation - 0.5).abs() < 0.03, "{name}: {deviation}");
    }
    let pinched = cylinder_band(3_000, Sampling::Regular, 2).flat();
    let waist = pinched.iter().map(|p| p[0].hypot(p[1])).fold(1.0, f64::min);
    assert!((waist - 0.6).abs() < 0.01, "{waist}");
}

#[test]
fn renumbering_and_placing() {
    let s = unduloid_band(0.5, 1.2, 1_000, IRREGULAR, 2);
    let (t, new) = s.renumbered(9);
    check("renumbered", &t, 1_000, 0, 2);
    for (old, &v) in new.iter().enumerate() {
        assert_eq!(t.positions[v as usize], s.positions[old]);
        assert_eq!(t.flat()[v as usize], s.flat()[old]);
    }
    assert_eq!(t.valence_range(), s.valence_range());
    let by = Similarity::new([1.0, 2.0, -0.5], 0.7, 3.0, [5.0, -1.0, 2.0]);
    let moved = s.transformed(&by);
    let surface = moved.surface.as_ref().unwrap();
    for (p, n) in moved.positions.iter().zip(&moved.normals) {
        assert_below!(surface.distance(*p), 2e-14);
        let off = std::array::from_fn(|i| p[i] + 0.3 * n[i]);
        assert_near!(surface.signed_distance(off), 0.3, 2e-14);
        assert_below!((surface.mean_curvature(*p) + 1.0 / (1.7 * 3.0)).abs(), 1e-15);
        assert_near!(by.apply(by.undo(*p))[0], p[0], 1e-14);
    }
}

/// Points at a known distance along the exact normal, inside the focal distance.
#[test]
fn distances() {
    for (name, make, ..) in families() {
        let s = make(800, IRREGULAR, 3);
        let Some(surface) = &s.surface else { continue };
        for (p, n) in s.positions.iter().zip(&s.normals) {
            for d in [-0.2, -1e-3, 1e-7, 0.1, 0.4] {
                let off = std::array::from_fn(|i| p[i] + d * n[i]);
                let got = surface.signed_distance(off);
                assert!((got - d).abs() < 1e-14, "{name}: {got} for {d} at {p:?}");
                assert_eq!(surface.distance(off), got.abs());
            }
        }
    }
    assert_eq!(Surface::Sphere.mean_curvature([0.0, 0.0, 1.0]), -1.0);
    assert_eq!(Surface::Cylinder.mean_curvature([1.0, 0.0, 0.0]), -0.5);
    assert_eq!(Surface::Catenoid.mean_curvature([1.0, 0.0, 0.0]), 0.0);
}

/// The surfaces of constant mean curvature among those of harmonic mean curvature.
#[test]
fn revolutions_are_spheres_cylinders_and_catenoids() {
    let along = std::f64::consts::FRAC_PI_2;
    for sampling in [Sampling::Regular, IRREGULAR] {
        for (h0, length, surface) in [
            (-1.0, 1.0, Surface::Sphere),
            (-0.5, 2.0, Surface::Cylinder),
            (0.0, 2.0, Surface::Catenoid),
        ] {
            let s = revolution(along, h0, 0.0, length, 1_000, sampling, 4);
            for (p, n) in s.positions.iter().zip(&s.normals) {
                assert!(surface.distance(*p) < 1e-13, "{h0} {p:?}");
                let difference = sub(surface.normal(*p), *n);
                assert!(dot(difference, difference).sqrt() < 1e-12, "{h0} {p:?}");
            }
        }
    }
}

/// The flux of H through a circle about the axis is `2 pi c`, whatever the circle.
#[test]
fn mean_curvature_of_a_revolution_is_harmonic() {
    let profile = HarmonicProfile::new(2.0, 0.3, -0.6, 1.0).unwrap();
    let s = revolution_band(&profile, 1_000, IRREGULAR, 4).unwrap();
    let surface = s.surface.as_ref().unwrap();
    let d = 1e-3;
    for (p, n) in s.positions.iter().zip(&s.normals) {
        let r = p[0].hypot(p[1]);
        // The direction of the profile, upwards, and its curvature, to stay on it in third order.
        let along = [-n[2] * p[0] / r, -n[2] * p[1] / r, n[0].hypot(n[1])];
        let h = |t: f64| surface.mean_curvature(std::array::from_fn(|i| p[i] + t * along[i]));
        let flux = r * (h(d) - h(-d)) / (2.0 * d);
        assert!((flux + 0.6).abs() < 1e-4, "{flux} at {p:?}");
    }
}

#[test]
fn what_is_no_revolution_is_refused() {
    // A sphere has a pole; with rings outside it is met before the surface ends.
    let along = std::f64::consts::FRAC_PI_2;
    let beyond = HarmonicProfile::new(along, -1.0, 0.0, 1.6);
    assert_matches!(beyond, Err(ProfileError::Axis(_)));
    let profile = HarmonicProfile::new(along, -1.0, 0.0, 1.5).unwrap();
    assert!(revolution_band(&profile, 300, Sampling::Regular, 4).is_err());
    let nodoid = HarmonicProfile::new(along, 2.0, 0.0, 6.0);
    let text = nodoid.unwrap_err().to_string();
    assert!(text.contains("crosses itself"), "{text}");
    assert!(HarmonicProfile::new(f64::INFINITY, 0.0, 0.0, 1.0).is_err());
}

#[test]
fn arguments_out_of_range_are_moved_into_it() {
    for n in [0, 1, 20] {
        for sampling in [Sampling::Regular, IRREGULAR, Sampling::locally_refined()] {
            for x in [f64::NAN, -1.0, 1e9] {
                let refined = Sampling::LocallyRefined {
                    factor: x,
                    min: [x, -0.5],
                    max: [0.5, x],
                };
                assert_above!(cylinder_band(n, refined, 1).free_count(), 3);
                assert!(Surface::Catenoid.distance([x; 3]).is_nan() == x.is_nan());
                assert_above!(sphere_cap(x, n, sampling, 0).free_count(), 3);
                assert_above!(sphere_with_hole(x, n, sampling, 0).free_count(), 3);
                assert_above!(sphere_zone(x, x, n, sampling, 0).free_count(), 3);
                assert_above!(unduloid_band(x, x, n, sampling, 1_000_000).free_count(), 3);
            }
        }
    }
}

/// Blend: topology of a pair of pants, circles on the tubes, no triangle degenerate or turned inside out.
fn check_blend(s: &Shape, vertices: usize, triangles: usize, circle: usize) {
    assert_eq!((s.positions.len(), s.triangles.len()), (vertices, triangles));
    assert_eq!(topology(s), (-1, vec![circle; 3]));
    assert_eq!(s.free_count(), vertices - 3 * circle);
    for v in 0..s.free.len() {
        let (p, n) = (s.positions[v], s.normals[v]);
        if s.free[v] {
            assert_eq!(n, [0.0; 3]);
            continue;
        }
        let radial: [f64; 3] = std::array::from_fn(|i| p[i] - BLEND_RADIUS * n[i]);
        assert_near!(dot(n, n), 1.0, 1e-15);
        assert_below!(dot(n, radial).abs(), 1e-15);
        assert_near!(dot(radial, radial).sqrt(), BLEND_DISTANCE, 1e-15);
        assert_eq!(radial[2], 0.0);
    }
    let mut worst = 1.0f64;
    for t in &s.triangles {
        let [a, b, c] = t.map(|v| s.positions[v as usize]);
        let area = cross(sub(b, a), sub(c, a));
        let square: f64 = [sub(b, a), sub(c, b), sub(a, c)]
            .iter()
            .map(|e| dot(*e, *e))
            .sum();
        worst = worst.min(2.0 * 3f64.sqrt() * dot(area, area).sqrt() / square);
        let mid = [0, 1, 2].map(|i| (a[i] + b[i] + c[i]) / 3.0);
        let out = (0..3).map(|k| {
            let angle = k as f64 * std::f64::consts::TAU / 3.0;
            let d = [angle.cos(), angle.sin(), 0.0];
            let along = dot(mid, d).max(0.0);
            sub(mid, d.map(|x| along * x))
        });
        let out = out.min_by(|a, b| dot(*a, *a).total_cmp(&dot(*b, *b))).unwrap();
        assert!(dot(out, area) > 0.0, "inside out at {mid:?}");
        for v in t {
            assert!(s.free[*v as usize] || dot(area, s.normals[*v as usize]) > 0.0);
        }
    }
    // 1 for an equilateral triangle.
    assert!(worst > 0.35, "{worst}");
}

/// Does the isometry map vertices to vertices (to 1e-14) and triangles to triangles?
fn is_symmetric(s: &Shape, map: impl Fn([f64; 3]) -> [f64; 3]) -> bool {
    let image: Option<Vec<u32>> = s
        .positions
        .iter()
        .map(|&p| {
            let q = map(p);
            let near = |r: &[f64; 3]| (0..3).all(|i| (r[i] - q[i]).abs() < 1e-14);
            s.positions.iter().position(near).map(|v| v as u32)
        })
        .collect();
    let Some(image) = image else { return false };
    let sorted = |mut t: [u32; 3]| {
        t.sort_unstable();
        t
    };
    let known: std::collections::HashSet<[u32; 3]> = s.triangles.iter().map(|t| sorted(*t)).collect();
    s.triangles
        .iter()
        .all(|t| known.contains(&sorted(t.map(|v| image[v as usize]))))
}

fn third_turn(p: [f64; 3]) -> [f64; 3] {
    let s = 0.75f64.sqrt();
    [-0.5 * p[0] - s * p[1], s * p[0] - 0.5 * p[1], p[2]]
}

#[test]
fn the_blend_of_three_cylinders() {
    let s = cylinder_blend();
    check_blend(&s, 920, 1_746, 32);
    assert!(is_symmetric(&s, third_turn));
    assert!(is_symmetric(&s, |p| [p[0], p[1], -p[2]]));
    assert!(is_symmetric(&s, |p| [p[0], -p[1], p[2]]));
    assert_eq!(s.boundary_normals().len(), 96);
    assert_eq!(s.flat(), s.positions);
}

#[test]
fn the_blend_at_other_resolutions() {
    let coarse = cylinder_blend_coarse();
    check_blend(&coarse, 118, 2 * (118 + 1) - 36, 12);
    assert!(is_symmetric(&coarse, third_turn));
    let fine = cylinder_blend_fine();
    check_blend(&fine, 13_308, 2 * (13_308 + 1) - 312, 104);
    for (arc, seam, rings) in [(3, 1, 0), (8, 3, 1), (16, 6, 2), (20, 8, 3)] {
        let n = arc * arc + 4 * arc * seam + seam * seam + 6 * arc * rings + 3 * arc - 1;
        let s = cylinder_blend_with(arc, seam, rings);
        check_blend(&s, n, 2 * (n + 1) - 6 * arc, 2 * arc);
        assert!(is_symmetric(&s, third_turn));
    }
}

#[test]
fn the_blend_with_a_refined_patch() {
    let (whole, s) = (cylinder_blend(), cylinder_blend_refined_patch());
    let n = s.positions.len();
    check_blend(&s, n, 2 * (n + 1) - 96, 32);
    assert_above!(n, 1_250);
    assert!(s.positions[..920] == whole.positions[..]);
    assert!(!is_symmetric(&s, third_turn));
    assert_eq!(s, cylinder_blend_refined_patch());
}

/// Every family at one size.
fn large_shapes(vertices: usize) {
    for (name, make, euler, loops) in families() {
        for sampling in [Sampling::Regular, IRREGULAR, Sampling::locally_refined()] {
            check(name, &make(vertices, sampling, 4), vertices, euler, loops);
        }
    }
}

#[test]
fn thousands_of_vertices() {
    large_shapes(tier(5_000, 10_000));
}

#[test]
#[ignore = "full tier: 25 s"]
fn a_hundred_thousand_vertices() {
    large_shapes(100_000);
}

/// Blends are spheres with three holes, tetra things closed surfaces of genus 3, whatever the triangulation.
#[test]
fn blends_and_tetra_things_of_any_size() {
    let samplings = [
        Sampling::Regular,
        Sampling::Irregular { seed: 3 },
        Sampling::locally_refined(),
    ];
    for sampling in samplings {
        for n in [200, 500, 1_500] {
            let (blend, tetra) = (cylinder_blend_of(n, sampling), tetra_thing_of(n, sampling));
            for (name, s, euler, loops) in [("blend", &blend, -1, 3), ("tetra", &tetra, -4, 0)] {
                let (e, l) = topology(s);
                assert_eq!((e, l.len()), (euler, loops), "{name} {n} {sampling:?}");
                // A patch comes on top of the wished number.
                if !matches!(sampling, Sampling::LocallyRefined { .. }) {
                    let missed = s.positions.len().abs_diff(n);
                    assert!(missed * 10 <= n, "{name} {n} {sampling:?}: {}", s.positions.len());
                }
                sound(name, s);
            }
            assert_eq!(blend, cylinder_blend_of(n, sampling));
        }
    }
    let (low, high) = cylinder_blend_of(1_500, samplings[1]).valence_range();
    assert!(low <= 4 && high >= 9, "{low} to {high}");
    assert_ne!(
        cylinder_blend_of(500, Sampling::Irregular { seed: 1 }),
        cylinder_blend_of(500, Sampling::Irregular { seed: 2 })
    );
}

/// Triangles with angles, and unit normals at the fixed vertices, which stand off the surface.
fn sound(name: &str, s: &Shape) {
    for t in &s.triangles {
        let p = t.map(|v| s.positions[v as usize]);
        for k in 0..3 {
            let (a, b) = (sub(p[(k + 1) % 3], p[k]), sub(p[(k + 2) % 3], p[k]));
            let angle = dot(cross(a, b), cross(a, b)).sqrt().atan2(dot(a, b));
            assert!(angle.to_degrees() > 5.0, "{name}: {} degrees", angle.to_degrees());
        }
    }
    for (v, n) in s.boundary_normals() {
        assert!((dot(n, n).sqrt() - 1.0).abs() < 1e-14, "{name}: normal of {v}");
    }
}

/// The paper's two sizes (Table 1, Fig. 8), and six circles of the right radius, in the planes that halve the edges.
#[test]
fn tetra_things_of_the_paper() {
    for (s, vertices, triangles, round) in [
        (tetra_thing_coarse(), 500, 1_008, 10),
        (tetra_thing(), 13_308, 26_624, 58),
    ] {
        assert_eq!((s.positions.len(), s.triangles.len()), (vertices, triangles));
        let fixed: Vec<usize> = (0..vertices).filter(|&v| !s.free[v]).collect();
        assert_eq!(fixed.len(), 6 * round);
        let mut centres: Vec<[i64; 3]> = Vec::new();
        for v in fixed {
            let (p, n) = (s.positions[v], s.normals[v]);
            let centre: [f64; 3] = std::array::from_fn(|i| p[i] - TETRA_RADIUS * n[i]);
            let height = dot(centre, centre).sqrt();
            assert!(
                (height - std::f64::consts::FRAC_1_SQRT_2).abs() < 1e-12,
                "{height}"
            );
            centres.push(centre.map(|x| (10.0 * x).round() as i64));
        }
        centres.sort_unstable();
        centres.dedup();
        assert_eq!(centres.len(), 6);
        let (euler, loops) = topology(&s);
        assert_eq!((euler, loops.len()), (-4, 0));
        // The start has the symmetries of the tetrahedron.
        for image in [|p: [f64; 3]| [p[1], p[2], p[0]], |p: [f64; 3]| [p[1], p[0], p[2]]] {
            symmetric(&s, image);
        }
    }
}

fn symmetric(s: &Shape, image: impl Fn([f64; 3]) -> [f64; 3]) {
    let key = |p: [f64; 3]| p.map(|x| (1e4 * x).round() as i64);
    let mut at: HashMap<[i64; 3], [f64; 3]> = HashMap::new();
    for p in &s.positions {
        at.insert(key(*p), *p);
    }
    for p in &s.positions {
        let (q, k) = (image(*p), key(image(*p)));
        // Rounding may put the image into the next cell.
        let found = (0..27).any(|c| {
            let cell = [k[0] + c % 3 - 1, k[1] + c / 3 % 3 - 1, k[2] + c / 9 - 1];
            at.get(&cell)
                .is_some_and(|r| dot(sub(*r, q), sub(*r, q)).sqrt() < 1e-8)
        });
        assert!(found, "no vertex at {q:?}");
    }
}
