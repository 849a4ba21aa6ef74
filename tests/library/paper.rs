//! The paper's own scheme (7.1 to 7.4, Figure 6): what it reaches, how it compares with the default solver, its hierarchy.

use std::ops::ControlFlow;

use crate::fairing::*;
use crate::tier::tier;
use fairmesh::{
    BoundaryNormals, Discretization, Error, Estimate, InnerFairness, LooseReason, Options, Outcome,
    PaperOptions, Progress, Selection, Solution, SolverKind, Target, fair_with_progress,
};
use fairmesh_shapes::*;

fn paper(shape: &Shape, options: PaperOptions, inner: InnerFairness) -> Solution {
    solve(
        shape,
        &shape.positions,
        Options {
            solver: SolverKind::Paper(options),
            inner_fairness: inner,
            ..crate::fairing::options(TIGHT)
        },
    )
}

/// The default solver on the paper's discretization.
fn fast(shape: &Shape, inner: InnerFairness) -> Solution {
    solve(
        shape,
        &shape.positions,
        Options {
            discretization: Discretization::Paper,
            inner_fairness: inner,
            ..crate::fairing::options(TIGHT)
        },
    )
}

const SINGLE: PaperOptions = PaperOptions {
    estimate: Estimate::Alternating { iterations: 10 },
    damping: 0.9,
    levels: 1,
    base: 0,
    defect: 1e-6,
    laplacian: f64::INFINITY,
    max_updates: 20_000,
};

fn told(name: &str, s: &Solution) {
    let r = &s.report;
    println!(
        "{name}: {} after {} updates, {:.2} s, defect {:.1e}, step {:.1e}, inside {:.4?}, boundary {:.4?}",
        r.outcome.name(),
        r.iterations,
        r.seconds.total,
        r.defect,
        r.step,
        r.quality.h_inside,
        r.quality.h_boundary
    );
    for l in &r.levels {
        println!("    {l:?}");
    }
}

/// The paper's first example, with and without hierarchy, to the surface that the default solver finds on the same
/// discretization.
#[test]
fn the_blend_of_920_vertices() {
    let shape = cylinder_blend();
    let mut bars = Bars::default();
    let both = [InnerFairness::Uniform, InnerFairness::Conformal];
    for &inner in tier(&both[..1], &both) {
        let reference = fast(&shape, inner);
        bars.converged("the default solver", &reference);
        for levels in [0, 1] {
            let name = format!("{inner:?}, levels {levels}");
            let one = paper(&shape, PaperOptions { levels, ..SINGLE }, inner);
            told(&name, &one);
            bars.converged(&name, &one);
            bars.at_most(format!("{name}: updates"), one.report.iterations as f64, 1_000.0);
            bars.at_most(format!("{name}: defect"), one.report.defect, 1e-6);
            let tight = PaperOptions {
                levels,
                defect: 1e-8,
                ..SINGLE
            };
            let two = paper(&shape, tight, inner);
            let gap = apart(&two.positions, &reference.positions) / reference.report.diagonal;
            println!(
                "    at a defect of 1e-8: {} updates, {gap:.1e} from the default solver",
                two.report.iterations
            );
            bars.converged(&name, &two);
            bars.at_most(format!("{name}: from the default solver"), gap, 1e-6);
        }
    }
    bars.finish();
}

/// Other right-hand sides: both solvers find the same surface.
#[test]
fn targets_in_both_solvers() {
    let mut bars = Bars::default();
    let shape = cylinder_blend();
    let diagonal = fast(&shape, InnerFairness::Uniform).report.diagonal;
    let constants = tier(&[-20.0, 5.0][..], &[-20.0, -5.0, 5.0, 20.0]).iter();
    let constants = constants.map(|c| Target::Constant(c / diagonal.powi(3)));
    for target in constants.chain([Target::MinimalEnergy]) {
        let [slow, fast] = [
            (
                SolverKind::Paper(PaperOptions {
                    levels: 0,
                    defect: 1e-8,
                    ..SINGLE
                }),
                Discretization::SecondOrder,
            ),
            (SolverKind::Fast, Discretization::Paper),
        ]
        .map(|(solver, discretization)| {
            let options = Options {
                solver,
                discretization,
                target,
                ..crate::fairing::options(TIGHT)
            };
            solve(&shape, &shape.positions, options)
        });
        told(&format!("{target:?}"), &slow);
        bars.converged(format!("{target:?}, paper"), &slow);
        bars.converged(format!("{target:?}, default"), &fast);
        let gap = apart(&slow.positions, &fast.positions) / diagonal;
        println!("    {gap:.1e} apart");
        bars.at_most(format!("{target:?}: apart"), gap, 1e-6);
    }
    bars.finish();
}

/// Every way to estimate `H`, and every damping, ends on one surface.
#[test]
fn estimates_and_damping_change_the_way_only() {
    let shape = cylinder_blend_coarse();
    let reference = fast(&shape, InnerFairness::Uniform);
    let mut bars = Bars::default();
    for estimate in [
        Estimate::Alternating { iterations: 30 },
        Estimate::GaussSeidel { sweeps: 1 },
        Estimate::GaussSeidel { sweeps: 3 },
        Estimate::ConjugateGradients { iterations: 20 },
    ] {
        for damping in [0.9, 0.5] {
            let options = PaperOptions {
                estimate,
                damping,
                defect: 1e-9,
                ..SINGLE
            };
            let s = paper(&shape, options, InnerFairness::Uniform);
            let gap = apart(&s.positions, &reference.positions) / reference.report.diagonal;
            let name = format!("{estimate:?}, s = {damping}");
            println!("{name}: {} updates, {gap:.1e}", s.report.iterations);
            bars.converged(&name, &s);
            bars.at_most(name, gap, 1e-7);
        }
    }
    bars.finish();
}

fn cases(n: usize) -> Vec<(&'static str, Shape)> {
    vec![
        ("sphere", sphere_cap(60.0, n, irregular(1), OUTSIDE)),
        ("regular sphere", sphere_cap(60.0, n, Sampling::Regular, OUTSIDE)),
        ("cylinder", cylinder_band(n, irregular(2), OUTSIDE)),
        ("catenoid", catenoid_band(n, irregular(3), OUTSIDE)),
        ("unduloid", unduloid_band(0.5, 1.0, n, irregular(4), OUTSIDE)),
        ("saddle", saddle_graph(n, irregular(5), OUTSIDE)),
        ("blend", cylinder_blend()),
        ("tetra thing", tetra_thing_coarse()),
    ]
}

/// A harmonic function has its extremes on the boundary (3); so has the discrete `H`.
#[test]
fn the_maximum_principle() {
    let mut bars = Bars::default();
    for (name, shape) in cases(tier(200, 500)) {
        let s = paper(
            &shape,
            PaperOptions { levels: 0, ..SINGLE },
            InnerFairness::Uniform,
        );
        told(name, &s);
        bars.converged(name, &s);
        let ([low, high], [boundary_low, boundary_high]) =
            (s.report.quality.h_inside, s.report.quality.h_boundary);
        let over = (high - boundary_high).max(boundary_low - low) * s.report.diagonal;
        println!("    beyond the boundary's range by {over:.1e} of 1 / diagonal");
        bars.at_most(format!("{name}: H inside beyond the boundary's range"), over, 0.0);
        let reference = fast(&shape, InnerFairness::Uniform);
        bars.converged(format!("{name}, the default solver"), &reference);
        let gap = apart(&s.positions, &reference.positions) / reference.report.diagonal;
        println!("    {gap:.1e} from the default solver");
        bars.at_most(format!("{name}: from the default solver"), gap, 5e-5);
    }
    bars.finish();
}

/// Levels grow exponentially, from a base of at least 2.5 times the boundary.
#[test]
fn levels_are_reported() {
    let shape = cylinder_blend();
    let s = paper(
        &shape,
        PaperOptions {
            levels: 3,
            defect: 1e-2,
            ..SINGLE
        },
        InnerFairness::Uniform,
    );
    told("three levels", &s);
    let levels = &s.report.levels;
    assert_eq!(levels.len(), 3);
    assert_eq!((levels[0].vertices, levels[2].vertices), (240, 920));
    assert_near!(levels[1].vertices as f64 / (240.0f64 * 920.0).sqrt(), 1.0, 0.01);
    assert_eq!(levels[2].triangles, 1746);
    assert_eq!(
        levels.iter().map(|l| l.updates).sum::<usize>(),
        s.report.iterations
    );
}

#[test]
fn a_limit_on_the_laplacian_is_met_or_rounding_is_told() {
    let shape = cylinder_blend_coarse();
    let met = paper(
        &shape,
        PaperOptions {
            defect: 1.0,
            laplacian: 1e-2,
            ..SINGLE
        },
        InnerFairness::Uniform,
    );
    told("1e-2", &met);
    assert_eq!(met.report.outcome, Outcome::Converged);
    assert_below!(met.report.defect, 1e-3);
    let hopeless = paper(
        &shape,
        PaperOptions {
            laplacian: 1e-14,
            ..SINGLE
        },
        InnerFairness::Uniform,
    );
    told("1e-14", &hopeless);
    let reason = LooseReason::Rounding;
    assert_eq!(hopeless.report.outcome, Outcome::ConvergedLoosely { reason });
}

#[test]
fn a_run_stops_within_one_update() {
    let shape = cylinder_blend_with(31, 19, 5);
    for stop in [1, 50, 200] {
        let mut last = 0;
        let mut after = 0;
        let mut watch = |p: &Progress| {
            after += usize::from(last >= stop);
            last = p.iterations;
            if p.iterations >= stop {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        let options = Options {
            solver: SolverKind::Paper(PaperOptions::default()),
            boundary_normals: BoundaryNormals::Given(shape.boundary_normals()),
            ..options(TIGHT)
        };
        let (positions, triangles) = (&shape.positions, &shape.triangles);
        let selection = Selection::Mask(&shape.free);
        let s = fair_with_progress(positions, triangles, selection, &options, &mut watch).unwrap();
        assert_eq!(s.report.outcome, Outcome::Cancelled);
        assert_eq!((s.report.iterations, after), (stop, 0));
        let levels = &s.report.levels;
        assert_eq!(levels.iter().map(|l| l.updates).sum::<usize>(), stop);
        assert_all!(s.positions.iter().flatten(), |c| c.is_finite());
    }
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let shape = cylinder_blend_with(25, 13, 4);
    let run = |threads| {
        let options = Options {
            solver: SolverKind::Paper(PaperOptions {
                max_updates: 100,
                ..PaperOptions::default()
            }),
            threads,
            ..options(TIGHT)
        };
        solve(&shape, &shape.positions, options)
    };
    let (one, three) = (run(1), run(3));
    assert_eq!(one.report.outcome, Outcome::IterationLimit);
    assert_eq!(one.positions, three.positions);
}

#[test]
fn options_out_of_range_are_refused() {
    let shape = cylinder_blend_coarse();
    let bad = [
        (
            "paper_damping",
            PaperOptions {
                damping: 0.0,
                ..SINGLE
            },
        ),
        (
            "paper_damping",
            PaperOptions {
                damping: f64::NAN,
                ..SINGLE
            },
        ),
        (
            "paper_defect",
            PaperOptions {
                defect: 0.0,
                ..SINGLE
            },
        ),
        (
            "paper_laplacian",
            PaperOptions {
                laplacian: -1.0,
                ..SINGLE
            },
        ),
        (
            "paper_max_updates",
            PaperOptions {
                max_updates: 0,
                ..SINGLE
            },
        ),
        (
            "paper_estimate_iterations",
            PaperOptions {
                estimate: Estimate::GaussSeidel { sweeps: 0 },
                ..SINGLE
            },
        ),
    ];
    for (option, paper) in bad {
        let options = Options {
            solver: SolverKind::Paper(paper),
            ..options(TIGHT)
        };
        let refused = attempt(&shape, options).unwrap_err();
        let Error::BadOption { name, .. } = refused else {
            panic!("{refused}")
        };
        assert_eq!(name, option);
    }
}

/// The interior of the given mesh decides on the hierarchy, but not on the result.
#[test]
fn the_start_does_not_matter() {
    let shape = cylinder_blend();
    let asked = |start: &[[f64; 3]]| {
        let solver = SolverKind::Paper(PaperOptions {
            levels: 0,
            defect: 1e-8,
            ..SINGLE
        });
        let options = Options {
            solver,
            ..options(TIGHT)
        };
        solve(&shape, start, options)
    };
    let reference = fast(&shape, InnerFairness::Uniform);
    let mut bars = Bars::default();
    for (name, start) in starts(&shape, 3).into_iter().take(tier(2, 3)) {
        let s = asked(&start);
        told(name, &s);
        let gap = apart(&s.positions, &reference.positions) / reference.report.diagonal;
        bars.converged(name, &s);
        bars.at_most(format!("{name}: from the default solver"), gap, 1e-6);
    }
    bars.finish();
}

/// The sizes of the paper's Table 1.
#[test]
#[ignore = "full tier: up to 13,308 vertices by the paper's solver"]
fn table_1() {
    let mut bars = Bars::default();
    let shapes = [
        (cylinder_blend(), 1e-3),
        (cylinder_blend_with(25, 14, 4), 1e-3),
        (cylinder_blend_with(31, 19, 5), 1e-3),
        (cylinder_blend_fine(), 2e-3),
    ];
    for (shape, defect) in &shapes {
        let vertices = shape.free_count() + shape.boundary_normals().len();
        let s = paper(
            shape,
            PaperOptions {
                defect: *defect,
                ..PaperOptions::default()
            },
            InnerFairness::Uniform,
        );
        let name = format!("{vertices} vertices");
        told(&name, &s);
        bars.converged(&name, &s);
    }
    bars.finish();
}
