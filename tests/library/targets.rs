//! Right-hand sides other than zero: known answers, invariances, and honest ends.
//!
//! The known answers are surfaces of revolution whose profile solves the equation as an ordinary differential one.

use crate::fairing::*;
use crate::tier::tier;
use fairmesh::{BoundaryNormals, Discretization, Error, Options, Outcome, Solution, Target};
use fairmesh_shapes::*;

fn asked(target: Target, tolerance: f64) -> Options {
    Options {
        target,
        ..options(tolerance)
    }
}

/// The diagonal of the bounding box of the triangles that have a free vertex.
fn region_diagonal(shape: &Shape) -> f64 {
    let near = shape
        .triangles
        .iter()
        .filter(|t| t.iter().any(|&v| shape.free[v as usize]));
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for p in near.flatten().map(|&v| shape.positions[v as usize]) {
        low = std::array::from_fn(|k| low[k].min(p[k]));
        high = std::array::from_fn(|k| high[k].max(p[k]));
    }
    (vector(&high) - vector(&low)).norm()
}

/// A profile `r, z, phi, H, r H'` by arc length, `(r', z') = (cos phi, sin phi)`: with the normal away from the axis
/// `2 H = -phi' - sin phi / r` and `r Delta_B H = (r H')'`.
#[derive(Debug, Clone)]
struct Profile {
    target: Target,
    /// At `STEP` times the number, from the waist on; the other half is its mirror image.
    table: Vec<[f64; 5]>,
}

const STEP: f64 = 1e-3;

impl Profile {
    /// With a waist of radius 1, the mean curvature `h` there, and this length to each side.
    fn new(target: Target, h: f64, length: f64) -> Self {
        let mut profile = Self {
            target,
            table: vec![[1.0, 0.0, std::f64::consts::FRAC_PI_2, h, 0.0]],
        };
        for k in 0..(length / STEP).ceil() as usize {
            let next = profile.advanced(profile.table[k], STEP);
            profile.table.push(next);
        }
        profile
    }

    fn rates(&self, y: [f64; 5]) -> [f64; 5] {
        let [r, _, phi, h, flux] = y;
        let parallel = -phi.sin() / r;
        let meridian = 2.0 * h - parallel;
        let k = parallel * meridian;
        let right = match self.target {
            Target::Harmonic => 0.0,
            Target::Constant(c) => c,
            Target::MinimalEnergy => -2.0 * h * (h * h - k),
        };
        [phi.cos(), phi.sin(), -meridian, flux / r, right * r]
    }

    /// One step of the classical Runge-Kutta method.
    fn advanced(&self, y: [f64; 5], step: f64) -> [f64; 5] {
        let along = |d: [f64; 5], s: f64| std::array::from_fn(|i| y[i] + s * d[i]);
        let a = self.rates(y);
        let b = self.rates(along(a, 0.5 * step));
        let c = self.rates(along(b, 0.5 * step));
        let d = self.rates(along(c, step));
        std::array::from_fn(|i| y[i] + step / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]))
    }

    fn at(&self, s: f64) -> [f64; 5] {
        let k = ((s.abs() / STEP) as usize).min(self.table.len() - 1);
        let [r, z, phi, h, flux] = self.advanced(self.table[k], s.abs() - k as f64 * STEP);
        if s < 0.0 {
            [r, -z, std::f64::consts::PI - phi, h, -flux]
        } else {
            [r, z, phi, h, flux]
        }
    }

    /// The distance of a point, and the arc length of the foot of its perpendicular.
    fn distance(&self, p: [f64; 3]) -> (f64, f64) {
        let (radius, z) = (p[0].hypot(p[1]), p[2]);
        let mut s = z;
        for _ in 0..50 {
            let [r, height, phi, ..] = self.at(s);
            let step = (radius - r) * phi.cos() + (z - height) * phi.sin();
            s += step;
            if step.abs() < 1e-14 {
                break;
            }
        }
        let [r, height, ..] = self.at(s);
        ((radius - r).hypot(z - height), s)
    }

    /// The band of a cylinder with this profile instead: arc length for height.
    fn band(&self, n: usize, seed: u64) -> Shape {
        let mut shape = cylinder_band(n, irregular(seed), OUTSIDE);
        for (p, normal) in shape.positions.iter_mut().zip(&mut shape.normals) {
            let u = p[1].atan2(p[0]);
            let [r, z, phi, ..] = self.at(p[2]);
            *p = [r * u.cos(), r * u.sin(), z];
            *normal = [phi.sin() * u.cos(), phi.sin() * u.sin(), -phi.cos()];
        }
        shape
    }
}

/// Free vertices moved to the axis by a part of their distance.
fn pinched(shape: &Shape, amount: f64) -> Vec<[f64; 3]> {
    let moved = |(p, &free): (&[f64; 3], &bool)| {
        let scale = if free { 1.0 - amount } else { 1.0 };
        [p[0] * scale, p[1] * scale, p[2]]
    };
    shape.positions.iter().zip(&shape.free).map(moved).collect()
}

/// Errors of positions (in diagonals), and of `H` times the diagonal and `K` times its square.
fn profile_errors(profile: &Profile, solution: &Solution) -> [f64; 3] {
    let d = solution.report.diagonal;
    let feet: Vec<(f64, f64)> = solution
        .mean_curvature
        .iter()
        .map(|&(v, _)| profile.distance(solution.positions[v as usize]))
        .collect();
    let position = Errors::of(feet.iter().map(|f| f.0 / d)).max;
    let mean = solution.mean_curvature.iter().zip(&feet);
    let mean = Errors::of(mean.map(|((_, h), f)| (h - profile.at(f.1)[3]) * d)).rms;
    let gauss = solution.gaussian_curvature.iter().zip(&feet);
    let gauss = Errors::of(gauss.map(|((_, k), f)| {
        let [r, _, phi, h, _] = profile.at(f.1);
        let parallel = -phi.sin() / r;
        (k - parallel * (2.0 * h - parallel)) * d * d
    }))
    .rms;
    [position, mean, gauss]
}

#[test]
fn the_profiles_are_integrated_to_1e_12() {
    // A profile of constant mean curvature has the first integral r sin phi + H r^2.
    let unduloid = Profile::new(Target::Constant(0.0), -0.45, 2.0);
    for y in &unduloid.table {
        assert_near!(y[0] * y[2].sin() + y[3] * y[0] * y[0], 0.55, 1e-12);
    }
    // With the flux c (enclosed area) / (2 pi) the two routes to (r H')' agree.
    let loaded = Profile::new(Target::Constant(0.4), -0.5, 2.0);
    let n = loaded.table.len() - 1;
    let (n, r) = (n - n % 2, |k: usize| loaded.table[k][0]);
    let odd: f64 = (1..n).step_by(2).map(r).sum();
    let even: f64 = (2..n).step_by(2).map(r).sum();
    let area = (r(0) + 4.0 * odd + 2.0 * even + r(n)) * STEP / 3.0;
    assert_near!(loaded.table[n][4], 0.4 * area, 1e-12);
    // A sphere is of minimal energy.
    let sphere = Profile::new(Target::MinimalEnergy, -1.0, 1.2);
    for y in &sphere.table {
        assert_near!(y[0].hypot(y[1]), 1.0, 1e-12);
        assert_near!(y[3], -1.0, 1e-12);
    }
}

/// Free vertices of the bands below.
const SIZES: [usize; 3] = [1_000, 4_000, 13_000];

/// The target and the curvature at the waist; at every size the largest error of positions, and the rms ones of H and K.
const BANDS: [(Target, f64, [[f64; 3]; 3]); 5] = [
    (
        Target::Constant(0.4),
        -0.5,
        [
            [3.0e-4, 4.9e-3, 0.039],
            [6.4e-5, 1.4e-3, 0.016],
            [1.8e-5, 5.0e-4, 0.0094],
        ],
    ),
    (
        Target::Constant(-0.4),
        -0.5,
        [
            [3.0e-4, 5.0e-3, 0.027],
            [6.6e-5, 1.4e-3, 0.012],
            [1.9e-5, 5.1e-4, 0.0070],
        ],
    ),
    (
        Target::Constant(1.0),
        -0.6,
        [
            [7.0e-4, 7.5e-3, 0.132],
            [1.6e-4, 2.5e-3, 0.054],
            [4.3e-5, 1.0e-3, 0.028],
        ],
    ),
    (
        Target::MinimalEnergy,
        -0.45,
        [
            [2.5e-4, 4.8e-3, 0.030],
            [5.5e-5, 1.3e-3, 0.011],
            [1.6e-5, 4.2e-4, 0.0078],
        ],
    ),
    (
        Target::MinimalEnergy,
        -0.3,
        [
            [2.5e-4, 5.3e-3, 0.079],
            [5.5e-5, 1.4e-3, 0.033],
            [1.5e-5, 4.8e-4, 0.020],
        ],
    ),
];

#[test]
fn surfaces_of_revolution_are_found_to_second_order() {
    let mut bars = Bars::default();
    for (target, h, most) in BANDS {
        let profile = Profile::new(target, h, 2.0);
        let mut found = Vec::new();
        let mut vertices = Vec::new();
        for (&n, most) in SIZES.iter().zip(most).take(tier(2, 3)) {
            let shape = profile.band(n, 7);
            let solution = solve(&shape, &pinched(&shape, 0.3), asked(target, 1e-9));
            let report = &solution.report;
            let errors = profile_errors(&profile, &solution);
            println!(
                "{target:?} {h} {n}: errors {errors:?}, {} iterations, {}",
                report.iterations,
                report.outcome.name()
            );
            let what = format!("{target:?} {h} {n}");
            bars.converged(&what, &solution);
            assert_eq!(report.target, target);
            for (error, bar) in errors.into_iter().zip(most) {
                bars.at_most(&what, error, bar);
            }
            found.push(errors[0]);
            vertices.push(report.free_vertices);
        }
        let order = order(&found, &vertices);
        println!("  order {order:.2}");
        bars.at_least(format!("{target:?} {h}: order"), order, 2.1);
    }
    bars.finish();
}

#[test]
fn spheres_are_surfaces_of_minimal_energy() {
    for n in [1_000, 13_000] {
        for seed in [1, 7] {
            let shape = sphere_cap(60.0, n, irregular(seed), OUTSIDE);
            let solution = solve(&shape, &flat(&shape), asked(Target::MinimalEnergy, TIGHT));
            let error = errors(&shape, &solution).max;
            println!(
                "cap {n} {seed}: {error:.1e}, {} iterations",
                solution.report.iterations
            );
            assert_success(&solution.report.outcome);
            assert!(error < 1e-9, "{error}");
            let k = Errors::of(solution.gaussian_curvature.iter().map(|(_, k)| k - 1.0)).max;
            assert!(k < 1e-4, "K off by {k}");
        }
    }
}

#[test]
fn cylinders_are_not() {
    let mut found = Vec::new();
    for n in [1_000, 13_000] {
        let shape = cylinder_band(n, irregular(7), OUTSIDE);
        let solution = solve(&shape, &flat(&shape), asked(Target::MinimalEnergy, TIGHT));
        assert_success(&solution.report.outcome);
        found.push(errors(&shape, &solution).max);
    }
    println!("{found:?} of the diagonal");
    // Visible, and not an error of discretization: 0.6 % of the diagonal on either mesh.
    assert!(found.iter().all(|e| (4e-3..9e-3).contains(e)), "{found:?}");
}

#[test]
fn a_constant_on_the_blend_of_cylinders() {
    let shape = cylinder_blend();
    let unit = region_diagonal(&shape).powi(3).recip();
    for strength in [1.0, 2.0, 5.0, 10.0, 15.0, 20.0] {
        let solved = [strength, -strength].map(|s| {
            let target = Target::Constant(s * unit);
            let solution = solve(&shape, &shape.flat(), asked(target, 1e-8));
            let report = &solution.report;
            println!(
                "{s}: {} iterations, defect {:.1e}",
                report.iterations, report.defect
            );
            assert!(report.outcome.is_success(), "{s}: {:?}", report.outcome);
            assert_at_most!(report.iterations, 15);
            assert_below!(report.defect, 1e-5);
            solution
        });
        // A positive constant pushes outwards: at the poles, the free vertices with the largest |z|, up.
        let height = |s: &Solution| s.positions.iter().map(|p| p[2]).fold(0.0, f64::max);
        assert_above!(height(&solved[0]), height(&solved[1]));
    }
}

#[test]
fn what_is_too_large_ends_honestly() {
    let shape = cylinder_blend();
    let unit = region_diagonal(&shape).powi(3).recip();
    for strength in [300.0, -300.0, 1e4, -1e4, 1e9, -1e100, 1e300] {
        let solution = solve(
            &shape,
            &shape.flat(),
            asked(Target::Constant(strength * unit), 1e-8),
        );
        let outcome = &solution.report.outcome;
        println!(
            "{strength}: {outcome:?}, {} iterations",
            solution.report.iterations
        );
        assert!(!outcome.is_success(), "{outcome:?}");
        if let Outcome::TargetNotReachable { reached } = outcome {
            assert_contains!(0.0..1.0, reached);
            assert!(solution.report.least_bending, "{:?}", solution.report.outcome);
        }
        assert_all!(solution.positions.iter().flatten(), |x| x.is_finite());
        for (v, p) in solution
            .positions
            .iter()
            .enumerate()
            .filter(|(v, _)| !shape.free[*v])
        {
            assert_eq!(p.map(f64::to_bits), shape.positions[v].map(f64::to_bits));
        }
    }
    for c in [f64::NAN, f64::INFINITY] {
        let refused = attempt(&shape, asked(Target::Constant(c), 1e-8));
        assert_matches!(refused, Err(Error::BadOption { name: "target", .. }));
    }
}

#[test]
fn a_constant_of_zero_is_harmonic_to_the_bit() {
    let shape = cylinder_band(1_000, irregular(1), OUTSIDE);
    let start = flat(&shape);
    for discretization in [Discretization::SecondOrder, Discretization::Paper] {
        let [a, b, c] = [Target::Harmonic, Target::Constant(0.0), Target::Constant(-0.0)].map(|target| {
            let options = Options {
                discretization,
                ..asked(target, 1e-8)
            };
            solve(&shape, &start, options)
        });
        for other in [b, c] {
            assert_eq!(a.positions, other.positions);
            assert_eq!(a.mean_curvature, other.mean_curvature);
            assert_eq!(a.report.defect.to_bits(), other.report.defect.to_bits());
        }
    }
}

#[test]
fn the_unit_of_length_does_not_matter() {
    let shape = cylinder_blend();
    let unit = region_diagonal(&shape).powi(3).recip();
    let in_unit = |target: Target, s: f64| match target {
        Target::Constant(c) => Target::Constant(c / (s * s * s)),
        other => other,
    };
    for target in [Target::Constant(10.0 * unit), Target::MinimalEnergy] {
        let one = solve(&shape, &shape.flat(), asked(target, TIGHT));
        for s in [8.0, 1e-3, 3.7e5] {
            let mut larger = shape.clone();
            larger.positions.iter_mut().flatten().for_each(|x| *x *= s);
            let start: Vec<[f64; 3]> = shape.flat().iter().map(|p| p.map(|x| x * s)).collect();
            let other = solve(&larger, &start, asked(in_unit(target, s), TIGHT));
            let back: Vec<[f64; 3]> = other.positions.iter().map(|p| p.map(|x| x / s)).collect();
            let off = apart(&one.positions, &back);
            let h = one.mean_curvature.iter().zip(&other.mean_curvature);
            let h = Errors::of(h.map(|(a, b)| a.1 - b.1 * s)).max;
            let k = one.gaussian_curvature.iter().zip(&other.gaussian_curvature);
            let k = Errors::of(k.map(|(a, b)| a.1 - b.1 * s * s)).max;
            println!("{target:?} x {s}: {off:.1e}, H {h:.1e}, K {k:.1e}");
            assert_below!(off, 1e-8);
            assert_below!(h, 1e-5);
            assert_below!(k, 1e-5);
            assert_eq!(one.report.outcome, other.report.outcome);
            if s == 8.0 {
                assert_eq!(one.positions, back, "powers of two round nothing");
            }
        }
    }
}

#[test]
fn turning_the_surface_inside_out_changes_the_sign_of_the_constant() {
    let shape = cylinder_band(1_000, irregular(3), OUTSIDE);
    let mut turned = shape.clone();
    turned.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    turned.normals.iter_mut().flatten().for_each(|x| *x = -*x);
    let start = flat(&shape);
    for (target, other) in [
        (Target::Harmonic, Target::Harmonic),
        (Target::MinimalEnergy, Target::MinimalEnergy),
        (Target::Constant(0.3), Target::Constant(-0.3)),
    ] {
        let a = solve(&shape, &start, asked(target, TIGHT));
        let b = solve(&turned, &start, asked(other, TIGHT));
        let off = apart(&a.positions, &b.positions);
        println!("{target:?}: {off:.1e}");
        assert_below!(off, 1e-8);
        let opposite = a.mean_curvature.iter().zip(&b.mean_curvature);
        assert_below!(Errors::of(opposite.map(|(a, b)| a.1 + b.1)).max, 1e-4);
    }
}

#[test]
fn the_papers_discretization_takes_targets_too() {
    let shape = cylinder_blend();
    let unit = region_diagonal(&shape).powi(3).recip();
    for target in [
        Target::MinimalEnergy,
        Target::Constant(10.0 * unit),
        Target::Constant(-10.0 * unit),
    ] {
        let [second, paper] = [Discretization::SecondOrder, Discretization::Paper].map(|discretization| {
            let options = Options {
                discretization,
                ..asked(target, 1e-8)
            };
            solve(&shape, &shape.flat(), options)
        });
        let off = apart(&second.positions, &paper.positions) / second.report.diagonal;
        println!("{target:?}: {} apart {off:.1e}", paper.report.outcome.name());
        assert_success(&paper.report.outcome);
        assert!(off < 2.5e-4, "{off:.1e}");
    }
}

#[test]
fn fitted_boundary_normals_and_targets() {
    // What is outside decides the normals, whatever the target.
    let shape = sphere_cap(60.0, 1_000, irregular(5), OUTSIDE);
    let options = Options {
        boundary_normals: BoundaryNormals::Fitted,
        ..asked(Target::MinimalEnergy, TIGHT)
    };
    let solution = solve_as_asked(&shape, &flat(&shape), options);
    assert_success(&solution.report.outcome);
    assert_below!(errors(&shape, &solution).max, 1e-9);
}
