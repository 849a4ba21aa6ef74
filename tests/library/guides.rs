//! Guides: pairs of boundary vertices that a patch has an edge between before it is refined.

use crate::fairing::{irregular, vector};
use fairmesh::{
    Error, FillOptions, FillOutcome, Filled, Join, Loops, Options, Outcome, boundary_loops, fill_holes,
};
use fairmesh_shapes::{Shape, in_parts, sphere_with_hole, sphere_without_band};

fn fill(shape: &Shape, join: Join, guides: Vec<[u32; 2]>) -> Result<Filled, Error> {
    let options = FillOptions {
        loops: match join {
            Join::None => Loops::UpTo(usize::MAX),
            _ => Loops::Chosen(Vec::new()),
        },
        join,
        guides,
        fairing: Options {
            threads: 1,
            ..Options::default()
        },
        ..FillOptions::default()
    };
    fill_holes(&shape.positions, &shape.triangles, &options)
}

fn loops(shape: &Shape) -> Vec<Vec<u32>> {
    let loops = boundary_loops(&shape.positions, &shape.triangles).unwrap();
    loops.into_iter().map(|of| of.vertices).collect()
}

/// The unit sphere of about `n` vertices without a cap of this many degrees from its pole.
fn sphere_hole(n: usize, seed: u64, half_angle: f64) -> Shape {
    let low = -half_angle.to_radians().cos();
    in_parts(&sphere_with_hole(1.0, n, irregular(seed), 0), |p| {
        (p[2] > low).then_some(0)
    })
}

/// The largest distance of a new vertex from the unit sphere; the only patch has converged.
fn off_sphere(shape: &Shape, filled: &Filled) -> f64 {
    let report = &filled.loops[0];
    let ended = report.fairing.as_ref().map(|fairing| &fairing.outcome);
    assert_eq!(
        (&report.outcome, ended),
        (&FillOutcome::Faired, Some(&Outcome::Converged))
    );
    assert_empty!(report.self_intersections);
    let new = &filled.positions[shape.positions.len()..];
    new.iter()
        .map(|p| (vector(p).norm() - 1.0).abs())
        .fold(0.0, f64::max)
}

#[test]
fn a_guided_patch_is_one_fair_surface() {
    let shape = sphere_hole(3_000, 3, 40.0);
    let hole = &loops(&shape)[0];
    let n = hole.len();
    let plain = off_sphere(&shape, &fill(&shape, Join::None, Vec::new()).unwrap());
    // Across, and two that cut off small parts; one guide the wrong way around.
    let guides = vec![
        [hole[0], hole[n / 2]],
        [hole[n / 4 + 3], hole[n / 4]],
        [hole[n - 2], hole[n - 5]],
    ];
    let guided = off_sphere(&shape, &fill(&shape, Join::None, guides).unwrap());
    println!("off the sphere: {plain:.1e}, with guides {guided:.1e}");
    assert!(guided < 2.0 * plain, "{guided} {plain}");
}

#[test]
fn guides_lead_from_loop_to_loop() {
    let shape = sphere_without_band(3_000, irregular(1), 20.0);
    let [north, south] = &loops(&shape)[..] else {
        panic!("two loops")
    };
    let near = |v: u32, others: &[u32]| {
        let distance = |w: &u32| {
            let [p, q] = [v, *w].map(|v| vector(&shape.positions[v as usize]));
            (p - q).norm()
        };
        *others
            .iter()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .unwrap()
    };
    let guides: Vec<[u32; 2]> = [0, 7, 14].map(|i| [north[i], near(north[i], south)]).to_vec();
    let filled = fill(&shape, Join::Groups(vec![vec![0, 1]]), guides.clone()).unwrap();
    let error = off_sphere(&shape, &filled);
    println!("off the sphere: {error:.1e}");
    assert!(error < 1e-8, "{error}");

    // In the wrong order around the two loops.
    let [a, b, c] = guides[..] else {
        panic!("three guides")
    };
    let crossed = vec![a, [b[0], c[1]], [c[0], b[1]]];
    let refused = fill(&shape, Join::Groups(vec![vec![0, 1]]), crossed.clone());
    let [first, second] = [crossed[1], crossed[2]].map(|g| g.map(|v| v as usize));
    assert_eq!(refused.unwrap_err(), Error::GuidesCross { first, second });

    // Without a patch for both.
    let refused = fill(&shape, Join::None, vec![a]).unwrap_err();
    assert!(
        refused
            .to_string()
            .ends_with("its ends are on loops that are not joined"),
        "{refused}"
    );
}

#[test]
fn guides_that_cannot_be_followed_are_refused_by_name() {
    let shape = sphere_hole(800, 2, 30.0);
    let hole = &loops(&shape)[0];
    let inner = (0..).find(|v| !hole.contains(v)).unwrap();
    let count = shape.positions.len() as u32;
    let last = hole[hole.len() - 1];
    for (guide, why) in [
        ([hole[1], hole[1]], "its ends are the same vertex"),
        ([hole[1], inner], "an end of it is on no boundary loop"),
        ([hole[1], count], "it names a vertex that does not exist"),
        ([hole[2], hole[1]], "its ends are neighbours on their loop"),
        ([hole[0], last], "its ends are neighbours on their loop"),
    ] {
        let refused = fill(&shape, Join::None, vec![guide]).unwrap_err();
        let [a, b] = guide.map(|v| v as usize);
        assert_eq!(refused, Error::BadGuide { a, b, why });
        assert!(refused.to_string().contains(&format!("({a}, {b})")), "{refused}");
    }
    let twice = vec![[hole[0], hole[5]], [hole[5], hole[9]]];
    let refused = fill(&shape, Join::None, twice).unwrap_err();
    assert!(refused.to_string().contains("that of another guide"), "{refused}");
    let crossed = vec![[hole[0], hole[5]], [hole[2], hole[9]]];
    let refused = fill(&shape, Join::None, crossed.clone()).unwrap_err();
    let [first, second] = [crossed[0], crossed[1]].map(|g| g.map(|v| v as usize));
    assert_eq!(refused, Error::GuidesCross { first, second });
    let options = FillOptions {
        loops: Loops::Chosen(Vec::new()),
        guides: vec![[hole[0], hole[5]]],
        ..FillOptions::default()
    };
    let refused = fill_holes(&shape.positions, &shape.triangles, &options).unwrap_err();
    assert!(refused.to_string().contains("not to be filled"), "{refused}");
}
