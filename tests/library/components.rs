//! Components of the region are independent problems: each has, to the last bit, the result of a call with its free vertices
//! alone.

use std::ops::ControlFlow;

use crate::fairing::*;
use fairmesh::{
    BoundaryNormals, ComponentReport, InnerFairness, InteriorNormals, Options, Outcome, PaperOptions,
    Selection, Solution, Solver, SolverKind, fair, fair_with_progress,
};
use fairmesh_shapes::*;

const TOLERANCE: f64 = 1e-8;

/// A mesh, and the free vertices of its components, each ascending.
struct Case {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    components: Vec<Vec<u32>>,
}

impl Case {
    /// All meshes in one, one after the other.
    fn of(shapes: &[Shape]) -> Self {
        let mut case = Self {
            positions: Vec::new(),
            triangles: Vec::new(),
            components: Vec::new(),
        };
        for shape in shapes {
            let first = case.positions.len() as u32;
            case.positions.extend(&shape.positions);
            let triangles = shape.triangles.iter().map(|t| t.map(|v| v + first));
            case.triangles.extend(triangles);
            let free = shape.free_vertices().into_iter().map(|v| v + first);
            case.components.push(free.collect());
        }
        case
    }

    /// `n` by `n` vertices, vertex `n * y + x`, on a wavy surface; the free ones are pulled off it.
    fn grid(n: u32, components: Vec<Vec<u32>>) -> Self {
        let wave = |v: u32| 0.4 * (f64::from(v % n) / 3.0).sin() * (f64::from(v / n) / 4.0).cos();
        let position = |v: u32| [f64::from(v % n), f64::from(v / n), wave(v)];
        let mut positions: Vec<[f64; 3]> = (0..n * n).map(position).collect();
        for &v in components.iter().flatten() {
            positions[v as usize][2] += 0.3 * f64::from(v * 7 % 5);
        }
        let cell = |c: u32| {
            let v = c / (n - 1) * n + c % (n - 1);
            [[v, v + 1, v + n + 1], [v, v + n + 1, v + n]]
        };
        Self {
            positions,
            triangles: (0..(n - 1) * (n - 1)).flat_map(cell).collect(),
            components,
        }
    }

    fn all(&self) -> Vec<u32> {
        self.components.concat()
    }

    fn fair(&self, free: &[u32], options: &Options) -> Solution {
        fair(
            &self.positions,
            &self.triangles,
            Selection::Vertices(free),
            options,
        )
        .unwrap()
    }

    /// Fairs the whole, and checks that each component is what it is alone.
    fn assert_independent(&self, options: &Options) -> Solution {
        let together = self.fair(&self.all(), options);
        assert_eq!(together.report.components.len(), self.components.len());
        for k in 0..self.components.len() {
            self.assert_as_alone(&together, k, options);
        }
        together
    }

    /// Component `k` of a solution of the whole is that of a call with its free vertices alone.
    fn assert_as_alone(&self, together: &Solution, k: usize, options: &Options) {
        let free = &self.components[k];
        let alone = self.fair(free, options);
        for &v in free {
            let v = v as usize;
            assert_eq!(
                bits(&together.positions[v]),
                bits(&alone.positions[v]),
                "component {k}, vertex {v}"
            );
        }
        let of_whole = |list: &[(u32, f64)]| {
            let own: Vec<_> = list.iter().filter(|(v, _)| free.contains(v)).copied().collect();
            own
        };
        assert_eq!(of_whole(&together.mean_curvature), alone.mean_curvature);
        assert_eq!(of_whole(&together.gaussian_curvature), alone.gaussian_curvature);
        let component = &together.report.components[k];
        assert_eq!(component.vertex, free[0] as usize);
        assert_eq!(told(component), told(&alone.report.components[0]));
        assert_eq!(component.outcome, alone.report.outcome);
        assert_eq!(component.iterations, alone.report.iterations);
        for &(v, n) in &alone.boundary_normals {
            assert_contains!(together.boundary_normals, &(v, n));
        }
    }
}

fn bits(p: &[f64; 3]) -> [u64; 3] {
    p.map(f64::to_bits)
}

/// Everything, such that what is not a number equals itself; but for the kinks: they are against the outside as it will be.
fn told(component: &ComponentReport) -> String {
    let mut component = component.clone();
    let quality = &mut component.quality;
    (quality.boundary_kink, quality.boundary_kink_before) = (0.0, 0.0);
    quality.boundary_kink_vertex = 0;
    format!("{component:?}")
}

fn moved(shape: &Shape, scale: f64, by: [f64; 3]) -> Shape {
    shape.transformed(&Similarity::new([0.0, 1.0, 0.0], 0.4, scale, by))
}

/// Caps and a band of the same size, small and far away.
fn scattered() -> Vec<Shape> {
    let cap = sphere_cap(60.0, 300, irregular(1), OUTSIDE);
    let band = cylinder_band(300, irregular(2), OUTSIDE);
    vec![
        cap.clone(),
        moved(&cap, 1e-4, [3.0, 0.0, 0.0]),
        moved(&band, 1.0, [1e6, 0.0, 0.0]),
    ]
}

/// Free vertices with `x` and `y` in these ranges, of a grid.
fn block(n: u32, x: std::ops::RangeInclusive<u32>, y: std::ops::RangeInclusive<u32>) -> Vec<u32> {
    y.flat_map(|y| x.clone().map(move |x| n * y + x)).collect()
}

#[test]
fn sizes_and_distances_of_others_do_not_matter() {
    for inner_fairness in [InnerFairness::Uniform, InnerFairness::Convex] {
        let case = Case::of(&scattered());
        let together = case.assert_independent(&Options {
            inner_fairness,
            ..options(TOLERANCE)
        });
        let report = &together.report;
        assert_eq!(report.outcome, Outcome::Converged);
        for component in &report.components {
            assert_success(&component.outcome);
            assert_below!(component.step, TOLERANCE);
        }
        let most = report.components.iter().map(|c| c.iterations).max();
        assert_eq!(Some(report.iterations), most);
        let free: Vec<usize> = report.components.iter().map(|c| c.free_vertices).collect();
        assert_eq!(free, case.components.iter().map(Vec::len).collect::<Vec<_>>());
        assert_eq!(report.free_vertices, free.iter().sum::<usize>());
        let [first, small, far] = [0, 1, 2].map(|k| &report.components[k]);
        assert_near!(small.diagonal / first.diagonal / 1e-4, 1.0, 0.01);
        assert!(far.diagonal < 10.0, "{}", far.diagonal);
        let worst = report.components.iter().map(|c| c.quality.worst_angle);
        assert_eq!(report.quality.worst_angle, worst.fold(f64::INFINITY, f64::min));
    }
}

/// A component that needs more iterations than are allowed, and one with normals that no surface has.
#[test]
fn a_component_that_fails_spoils_no_other() {
    let shapes = [
        moved(
            &sphere_cap(60.0, 300, irregular(1), OUTSIDE),
            1.0,
            [10.0, 0.0, 0.0],
        ),
        cylinder_band(300, irregular(1), OUTSIDE),
    ];
    let mut case = Case::of(&shapes);
    let rough = shapes[1].noise(1, 0.3);
    case.positions.truncate(shapes[0].positions.len());
    case.positions.extend(rough);
    let limited = |max_iterations| Options {
        max_iterations,
        ..options(TOLERANCE)
    };
    let [a, b] = [0, 1].map(|k| case.fair(&case.components[k], &options(TOLERANCE)).report);
    assert_success(&a.outcome);
    assert_success(&b.outcome);
    assert_ne!(a.iterations, b.iterations);
    let together = case.assert_independent(&limited(a.iterations.min(b.iterations)));
    assert_eq!(together.report.outcome, Outcome::IterationLimit);
    let succeeded = together
        .report
        .components
        .iter()
        .filter(|c| c.outcome.is_success());
    assert_eq!(succeeded.count(), 1);

    // The band's normals point along its boundary, all round.
    let first = shapes[0].positions.len() as u32;
    let turned = shapes[1].boundary_normals().into_iter();
    let normals = turned.map(|(v, [x, y, _])| (v + first, [-y / x.hypot(y), x / x.hypot(y), 0.0]));
    let together = case.assert_independent(&Options {
        boundary_normals: BoundaryNormals::Given(normals.collect()),
        max_iterations: 40,
        ..options(TOLERANCE)
    });
    let components = &together.report.components;
    assert_success(&components[0].outcome);
    assert!(!components[1].outcome.is_success(), "{:?}", components[1].outcome);
    assert_eq!(together.report.outcome, components[1].outcome);
    assert_eq!(together.report.least_bending, components[1].least_bending);
}

/// Single free vertices all over a surface. The callback is not called for each of them.
#[test]
fn a_thousand_tiny_components() {
    let n = 130;
    let places = block(32, 0..=31, 0..=31);
    let single = places
        .iter()
        .map(|p| vec![n * (2 + 4 * (p / 32)) + 2 + 4 * (p % 32)]);
    let case = Case::grid(n, single.collect());
    let mut fractions = Vec::new();
    let together = fair_with_progress(
        &case.positions,
        &case.triangles,
        Selection::Vertices(&case.all()),
        &options(TOLERANCE),
        &mut |progress| {
            fractions.push(progress.fraction);
            ControlFlow::Continue(())
        },
    )
    .unwrap();
    let components = &together.report.components;
    assert_eq!(components.len(), 1024);
    let iterations: usize = components.iter().map(|c| c.iterations).sum();
    let fair = components.iter().filter(|c| c.outcome.is_success()).count();
    println!("tiny components: {fair} fair, {iterations} iterations in all");
    for k in (0..1024).step_by(61) {
        case.assert_as_alone(&together, k, &options(TOLERANCE));
    }
    assert!(fractions.is_sorted(), "{fractions:?}");
    assert_all!(fractions.iter(), |f| (0.0..=1.0).contains(f));
    assert!(fractions.last().is_some_and(|f| *f > 0.99), "{fractions:?}");
    fractions.dedup();
    assert!(fractions.len() <= 1001, "{}", fractions.len());
}

#[test]
fn components_with_a_common_boundary_vertex() {
    // Vertex (6, 6) is fixed, and a corner of both. What is free of one tells no curvature to the other, and does where it is alone.
    let case = Case::grid(14, vec![block(14, 2..=5, 2..=5), block(14, 7..=10, 7..=10)]);
    let tangent = Options {
        continuity: 0.0,
        ..options(TOLERANCE)
    };
    let together = case.assert_independent(&tangent);
    // Each has fitted its own normal there: the other one is outside.
    let common: Vec<_> = together
        .boundary_normals
        .iter()
        .filter(|(v, _)| *v == 14 * 6 + 6)
        .collect();
    assert_eq!(common.len(), 2);
    assert!(
        together.boundary_normals.is_sorted_by_key(|(v, _)| *v),
        "{:?}",
        together.boundary_normals
    );
    let averaged = Options {
        boundary_normals: BoundaryNormals::Averaged,
        ..tangent
    };
    case.assert_independent(&averaged);
}

/// Two blocks and the column of fixed vertices between them.
fn divided() -> (Case, Vec<u32>) {
    let blocks = vec![block(14, 2..=5, 2..=10), block(14, 7..=10, 2..=10)];
    (Case::grid(14, blocks), block(14, 6..=6, 1..=11))
}

#[test]
fn a_curve_with_given_normals_separates() {
    let (case, curve) = divided();
    let given = |vertices: &[u32]| Options {
        boundary_normals: BoundaryNormals::Given(vertices.iter().map(|&v| (v, [0.0, 0.0, 1.0])).collect()),
        ..options(TOLERANCE)
    };
    case.assert_independent(&given(&curve));
    // A gap lets one side know of the other.
    let gap: Vec<u32> = curve.iter().copied().filter(|v| v / 14 != 6).collect();
    let together = case.fair(&case.all(), &given(&gap));
    assert_eq!(together.report.components.len(), 1);
}

#[test]
fn a_curve_without_normals_connects() {
    let (case, _) = divided();
    for interior_normals in [InteriorNormals::Smooth, InteriorNormals::Input] {
        let asked = Options {
            interior_normals,
            ..options(TOLERANCE)
        };
        let together = case.fair(&case.all(), &asked);
        let components = &together.report.components;
        assert_eq!(components.len(), 1);
        assert_eq!(components[0].free_vertices, case.all().len());
        assert_eq!(components[0].vertex, case.components[0][0] as usize);
    }
}

#[test]
fn steps_give_the_bits_of_one_call_for_each_component() {
    let case = Case::of(&scattered());
    let free = case.all();
    let whole = case.fair(&free, &options(TOLERANCE));
    for by in [1, 4, 1000] {
        let selection = Selection::Vertices(&free);
        let mut solver =
            Solver::new(&case.positions, &case.triangles, selection, &options(TOLERANCE)).unwrap();
        let mut runs = 0;
        while solver.run(by, None).unwrap().report.outcome == Outcome::IterationLimit {
            runs += 1;
            assert_at_most!(solver.solution().report.iterations, runs * by);
        }
        assert_at_least!(runs + 1, whole.report.iterations / by);
        let found = solver.solution();
        assert_same_items!(found.positions, whole.positions);
        let of = |solution: &Solution| solution.report.components.iter().map(told).collect::<Vec<_>>();
        assert_eq!(of(found), of(&whole));
    }
}

/// Normals on the curve make two of one; without them it is one again.
#[test]
fn a_solver_divides_and_unites_its_components() {
    let (case, curve) = divided();
    let free = case.all();
    let selection = Selection::Vertices(&free);
    let mut solver = Solver::new(&case.positions, &case.triangles, selection, &options(TOLERANCE)).unwrap();
    assert_eq!(solver.solution().report.components.len(), 1);
    let given = BoundaryNormals::Given(curve.iter().map(|&v| (v, [0.0, 0.0, 1.0])).collect());
    solver.set_boundary_normals(given.clone()).unwrap();
    let divided = solver.run(500, None).unwrap();
    let asked = Options {
        boundary_normals: given,
        ..options(TOLERANCE)
    };
    assert_same_items!(divided.positions, case.fair(&free, &asked).positions);
    solver.set_boundary_normals(BoundaryNormals::Fitted).unwrap();
    let united = solver.run(500, None).unwrap();
    assert_same_items!(united.positions, case.fair(&free, &options(TOLERANCE)).positions);
}

#[test]
fn the_order_of_the_selection_does_not_matter() {
    let case = Case::of(&scattered());
    let whole = case.fair(&case.all(), &options(TOLERANCE));
    let mut free = case.all();
    free.reverse();
    free.extend_from_slice(&case.components[1]);
    let again = case.fair(&free, &options(TOLERANCE));
    assert_same_items!(again.positions, whole.positions);
    assert_eq!(again.mean_curvature, whole.mean_curvature);
    assert_eq!(again.report.components, whole.report.components);
}

/// Components whose vertices stand in the mesh by turns.
#[test]
fn the_order_of_the_vertices_does_not_matter() {
    let cap = sphere_cap(60.0, 200, irregular(1), OUTSIDE);
    let other = moved(&cap, 0.01, [5.0, 0.0, 0.0]);
    let straight = Case::of(&[cap.clone(), other.clone()]);
    let n = cap.positions.len() as u32;
    // Vertex v of the first becomes 2 v, of the second 2 v + 1.
    let turn = |v: u32| if v < n { 2 * v } else { 2 * (v - n) + 1 };
    let mut mixed = Case {
        positions: vec![[0.0; 3]; 2 * n as usize],
        triangles: straight.triangles.iter().map(|t| t.map(turn)).collect(),
        components: straight
            .components
            .iter()
            .map(|c| c.iter().map(|&v| turn(v)).collect())
            .collect(),
    };
    for (v, p) in (0..).zip(&straight.positions) {
        mixed.positions[turn(v) as usize] = *p;
    }
    let a = straight.assert_independent(&options(TOLERANCE));
    let b = mixed.assert_independent(&options(TOLERANCE));
    for v in 0..2 * n {
        assert_eq!(
            bits(&a.positions[v as usize]),
            bits(&b.positions[turn(v) as usize])
        );
    }
}

/// What is done stays, what is not begun is as it was.
#[test]
fn a_run_that_is_stopped_keeps_the_components_that_are_done() {
    let case = Case::of(&scattered());
    let free = case.all();
    let mut most = 0;
    let stopped = fair_with_progress(
        &case.positions,
        &case.triangles,
        Selection::Vertices(&free),
        &options(TOLERANCE),
        // The iterations are counted anew when the second one begins.
        &mut |progress| match progress.iterations < most {
            true => ControlFlow::Break(()),
            false => {
                most = progress.iterations;
                ControlFlow::Continue(())
            }
        },
    )
    .unwrap();
    assert_eq!(stopped.report.outcome, Outcome::Cancelled);
    case.assert_as_alone(&stopped, 0, &options(TOLERANCE));
    let components = &stopped.report.components;
    assert_eq!(components[0].outcome, Outcome::Converged);
    assert_eq!(components[1].outcome, Outcome::Cancelled);
    assert_eq!(
        (&components[2].outcome, components[2].iterations),
        (&Outcome::Cancelled, 0)
    );
    for &v in &case.components[2] {
        let v = v as usize;
        assert_eq!(bits(&stopped.positions[v]), bits(&case.positions[v]));
    }
}

#[test]
fn a_solver_that_is_stopped_leaves_the_others_where_they_are() {
    let case = Case::of(&scattered());
    let free = case.all();
    let selection = Selection::Vertices(&free);
    let mut solver = Solver::new(&case.positions, &case.triangles, selection, &options(TOLERANCE)).unwrap();
    let held = solver.run(500, Some(&mut |_| ControlFlow::Break(()))).unwrap();
    assert_eq!(held.report.outcome, Outcome::Cancelled);
    let iterations: Vec<usize> = held.report.components.iter().map(|c| c.iterations).collect();
    assert_eq!(iterations, [1, 0, 0]);
    let whole = case.fair(&free, &options(TOLERANCE));
    assert_same_items!(solver.run(500, None).unwrap().positions, whole.positions);
}

#[test]
fn components_of_the_papers_scheme() {
    let shapes = [
        sphere_cap(60.0, 150, irregular(1), OUTSIDE),
        moved(
            &sphere_cap(40.0, 100, irregular(2), OUTSIDE),
            1e-3,
            [4.0, 0.0, 0.0],
        ),
    ];
    let case = Case::of(&shapes);
    let paper = PaperOptions {
        defect: 1e-4,
        ..PaperOptions::default()
    };
    let together = case.assert_independent(&Options {
        solver: SolverKind::Paper(paper),
        ..options(TOLERANCE)
    });
    let finest = together.report.levels.last().unwrap();
    let alone = [0, 1].map(|k| {
        let asked = Options {
            solver: SolverKind::Paper(paper),
            ..options(TOLERANCE)
        };
        case.fair(&case.components[k], &asked)
            .report
            .levels
            .last()
            .copied()
            .unwrap()
    });
    assert_eq!(finest.vertices, alone[0].vertices + alone[1].vertices);
    assert_eq!(finest.defect, alone[0].defect.max(alone[1].defect));
}

/// Refusals name the caller's vertices, whatever component they are of.
#[test]
fn refusals_of_any_component() {
    let mut case = Case::of(&scattered());
    let (v, last) = (case.components[2][5] as usize, case.components[1].clone());
    case.positions[v][1] = f64::NAN;
    let refused = |case: &Case| {
        let free = case.all();
        let selection = Selection::Vertices(&free);
        fair(&case.positions, &case.triangles, selection, &options(TOLERANCE)).unwrap_err()
    };
    assert_eq!(refused(&case), fairmesh::Error::NotFinite { vertex: v });
    // One triangle twice, in the component before.
    let t = case.triangles.iter().position(|t| t.contains(&last[3])).unwrap();
    case.triangles.push(case.triangles[t]);
    let twice = fairmesh::Error::DuplicateTriangle {
        triangle: case.triangles.len() - 1,
        other: t,
    };
    assert_eq!(refused(&case), twice);
}

/// Loops of all components continue what is around them, each as if it were alone.
#[test]
fn curvature_is_continued_component_by_component() {
    let cap = ellipsoid_cap([1.0, 0.8, 0.6], 50.0, 600, irregular(1), 8);
    let patch = torus_patch(1.0, 0.4, 1.0, 600, irregular(2), 8);
    let case = Case::of(&[
        cap,
        moved(&patch, 1e-3, [5.0, 0.0, 0.0]),
        moved(&sphere_cap(60.0, 300, irregular(3), 8), 1.0, [0.0, 9.0, 0.0]),
    ]);
    let asked = Options {
        continuity: 1.0,
        ..options(TOLERANCE)
    };
    let solution = case.assert_independent(&asked);
    assert_success(&solution.report.outcome);
    for (component, least) in solution.report.components.iter().zip([0.5, 0.5, 0.0]) {
        let [of_loop] = component.continuity[..] else {
            panic!("one loop each")
        };
        assert_at_least!(of_loop.reached, least);
        assert_at_most!(of_loop.jump, of_loop.jump_before);
    }
    // A number for one loop concerns its component alone.
    let vertex = solution.report.components[1].continuity[0].vertex as u32;
    let one = Options {
        continuity: 0.0,
        loop_continuity: vec![(vertex, 1.0)],
        ..options(TOLERANCE)
    };
    let one = case.fair(&case.all(), &one);
    let told = one.report.components.iter().map(|c| c.continuity.len());
    assert_eq!(told.collect::<Vec<_>>(), [0, 1, 0]);
    assert_eq!(
        one.report.components[1].continuity,
        solution.report.components[1].continuity
    );
}
