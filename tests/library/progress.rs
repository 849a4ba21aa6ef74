//! Who watches a run: progress never falls, and ends at 1.

use std::fmt::Debug;
use std::ops::ControlFlow;

use crate::fairing::{irregular, options};
use fairmesh::{
    BridgeOptions, Coincident, Combine, Error, FillOptions, Join, Loops, Options, Progress, ProgressCallback,
    Region, RegionStep, RemeshOptions, Seed, Selection, Solver, bridge_with_progress, carry_over,
    carry_over_with_progress, fair_with_progress, fill_holes_with_progress, remesh_region,
    remesh_region_with_progress, select_region, select_region_with_progress, self_intersections,
    self_intersections_with_progress,
};
use fairmesh_shapes::{cylinder_band, tubes};

type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// Watches a run to its end: what it tells never falls, and is exactly 1 at last.
fn ends_at_one(name: &str, run: impl FnOnce(&mut ProgressCallback<'_>)) {
    let mut told: Vec<f64> = Vec::new();
    run(&mut |p: &Progress| {
        told.push(p.fraction);
        ControlFlow::Continue(())
    });
    assert_eq!(told.last(), Some(&1.0), "{name}");
    assert!(told.is_sorted(), "{name}: {told:?}");
}

/// A plane sheet of `n` by `n` squares, each divided into two triangles, without those whose middles are `gone`.
fn sheet(n: u32, gone: impl Fn(f64, f64) -> bool) -> Mesh {
    let places = (0..=n).flat_map(|i| (0..=n).map(move |j| [f64::from(i), f64::from(j), 0.0]));
    let squares = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let squares = squares.filter(|&(i, j)| !gone(f64::from(i) + 0.5, f64::from(j) + 0.5));
    let triangles = squares.flat_map(|(i, j)| {
        let a = i * (n + 1) + j;
        let d = a + n + 1;
        [[a, d, d + 1], [a, d + 1, a + 1]]
    });
    (places.collect(), triangles.collect())
}

fn filling() -> FillOptions {
    FillOptions {
        fairing: options(Options::default().tolerance),
        ..FillOptions::default()
    }
}

fn fill(name: &str, (x, t): &Mesh, options: &FillOptions) {
    ends_at_one(name, |p| {
        fill_holes_with_progress(x, t, options, p).unwrap();
    });
}

/// An outer boundary, which stays open, was three quarters of the work.
#[test]
fn filling_ends_at_one() {
    let mesh = sheet(20, |i, j| (i - 10.0).hypot(j - 10.0) < 4.0);
    let asked = filling();
    fill("a sheet with a hole", &mesh, &asked);
    let flat = FillOptions {
        fair: false,
        ..asked.clone()
    };
    fill("not faired", &mesh, &flat);
    let nothing = FillOptions {
        loops: Loops::UpTo(1),
        ..asked.clone()
    };
    fill("nothing to be filled", &mesh, &nothing);
    let shape = tubes(&[[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]], 0.5, 500, irregular(1));
    let joined = FillOptions {
        join: Join::Auto,
        ..asked
    };
    fill("a join", &(shape.positions, shape.triangles), &joined);
}

#[test]
fn bridging_ends_at_one() {
    let (x, t) = sheet(20, |i, j| (i - 10.0).abs() < 3.0 && (j - 10.0).abs() < 6.0);
    let ends = [7, 13].map(|i| [8, 9, 10, 11, 12].map(|j| 21 * i + j));
    for fill in [false, true] {
        let asked = BridgeOptions {
            fill,
            filling: filling(),
            ..BridgeOptions::default()
        };
        ends_at_one("a bridge", |p| {
            bridge_with_progress(&x, &t, ends.each_ref().map(|end| &end[..]), &asked, p).unwrap();
        });
    }
}

#[test]
fn fairing_ends_at_one() {
    let shape = cylinder_band(500, irregular(1), 4);
    let (start, mask) = (shape.flat(), Selection::Mask(&shape.free));
    let asked = options(1e-8);
    ends_at_one("a band", |p| {
        fair_with_progress(&start, &shape.triangles, mask, &asked, p).unwrap();
    });
    let mut solver = Solver::new(&start, &shape.triangles, mask, &asked).unwrap();
    let mut most = 0.0;
    let mut note = |p: &Progress| {
        most = p.fraction;
        ControlFlow::Continue(())
    };
    solver.run(2, Some(&mut note)).unwrap();
    assert_below!(most, 1.0, "held up");
    ends_at_one("steps", |p| {
        solver.finish(Some(p)).unwrap();
    });
    ends_at_one("the range of the bulge", |p| {
        solver.bulge_range(Some(p)).unwrap();
    });
}

/// A run that tells its progress, and has no result where it is stopped.
type Stoppable<'r, T> = &'r dyn Fn(&mut ProgressCallback<'_>) -> Result<Option<T>, Error>;

/// Watched it ends at one with what it is unwatched; stopped it has no result.
fn is_watched<T: Debug + PartialEq>(name: &str, unwatched: T, run: Stoppable<'_, T>) {
    let mut watched = None;
    ends_at_one(name, |p| watched = run(p).unwrap());
    assert!(watched == Some(unwatched), "{name}");
    assert_eq!(run(&mut |_| ControlFlow::Break(())), Ok(None), "{name}");
}

#[test]
fn what_only_looks_at_a_mesh_ends_at_one_and_can_be_stopped() {
    let (mut x, t) = sheet(150, |_, _| false);
    for p in &mut x {
        let [i, j, _] = p.map(|c| c - 75.0);
        p[2] = 6.0 * (-(i * i + j * j) / 100.0).exp();
    }
    let all: Vec<u32> = (0..t.len() as u32).collect();
    let carried = carry_over(&x, &t, &all, &x).unwrap();
    is_watched("carrying over", carried, &|p| {
        carry_over_with_progress(&x, &t, &all, &x, p)
    });
    let joined = Coincident::default();
    let steps = [
        RegionStep::With(
            Combine::Add,
            Region::Bump {
                seed: Seed::Vertex(75 * 151 + 75),
                size: None,
            },
        ),
        RegionStep::Grow(2),
    ];
    let selected = select_region(&x, &t, &steps, joined).unwrap();
    is_watched("regions", selected, &|p| {
        select_region_with_progress(&x, &t, &steps, joined, p)
    });
    // Folded over: it meets itself.
    x.iter_mut()
        .for_each(|p| p[0] = (p[0] - 75.0).abs() + 0.01 * p[0]);
    for among in [None, Some(&all[..100])] {
        let pairs = self_intersections(&x, &t, among).unwrap();
        let run: Stoppable<'_, _> = &|p| self_intersections_with_progress(&x, &t, among, p);
        is_watched("intersections", pairs, run);
    }
}

#[test]
fn remeshing_ends_at_one_and_can_be_stopped() {
    let (x, t) = sheet(30, |_, _| false);
    let free: Vec<u32> = (5..25).flat_map(|i| (5..25).map(move |j| 31 * i + j)).collect();
    for density in [0.5, 3.0] {
        let asked = RemeshOptions {
            density,
            ..RemeshOptions::default()
        };
        let free = Selection::Vertices(&free);
        let new = remesh_region(&x, &t, free, &asked).unwrap();
        is_watched("remeshing", (new.positions, new.triangles), &|p| {
            let new = remesh_region_with_progress(&x, &t, free, &asked, p)?;
            Ok(new.map(|new| (new.positions, new.triangles)))
        });
    }
}
