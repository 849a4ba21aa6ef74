//! Every density and every bound on vertices ends, with triangles that can be faired.

use std::collections::HashMap;

use fairmesh::{
    BridgeOptions, Bridged, Error, FillOptions, FillOutcome, Loops, Outcome, RemeshOptions, Remeshed,
    Selection, bridge, fill_holes, remesh_region,
};
use fairmesh_shapes::{Sampling, sphere_with_hole};

const DENSITIES: [f64; 9] = [0.1, 0.3, 1.0, 1.5, 3.0, 5.66, 8.0, 9.0, 10.0];

/// The most triangles at a vertex among those from `first` on.
fn largest_valence(triangles: &[[u32; 3]], first: usize) -> usize {
    let mut valence = HashMap::new();
    for v in triangles[first..].iter().flatten() {
        *valence.entry(v).or_insert(0) += 1;
    }
    valence.into_values().max().unwrap()
}

/// A sphere with a hole of 50 degrees around the pole.
fn open_sphere(seed: u64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let shape = sphere_with_hole(50.0, 1000, Sampling::Irregular { seed }, 0);
    (shape.positions, shape.triangles)
}

fn fill(seed: u64, density: f64, max_vertices: usize) -> (f64, usize) {
    let (x, t) = open_sphere(seed);
    let options = FillOptions {
        density,
        max_new_vertices: max_vertices,
        loops: Loops::UpTo(1000),
        ..FillOptions::default()
    };
    let what = format!("seed {seed}, density {density}, {max_vertices} vertices");
    let filled = fill_holes(&x, &t, &options).unwrap();
    let [report] = &filled.loops[..] else {
        panic!("{what}: {} loops", filled.loops.len());
    };
    let outcome = report.fairing.as_ref().map(|fairing| &fairing.outcome);
    assert!(matches!(outcome, Some(Outcome::Converged)), "{what}: {outcome:?}");
    let off = filled.positions[x.len()..]
        .iter()
        .map(|p| (p.iter().map(|c| c * c).sum::<f64>().sqrt() - 1.0).abs());
    assert_below!(off.fold(0.0, f64::max), 1e-6, "{what}");
    assert_below!(largest_valence(&filled.triangles, t.len()), 20, "{what}");
    (report.worst_angle, filled.positions.len() - x.len())
}

#[test]
fn a_hole_is_filled_at_every_density() {
    for seed in [1, 2] {
        let mut before = 0;
        for density in DENSITIES {
            let (angle, vertices) = fill(seed, density, 200_000);
            assert_at_least!(angle, 15.0, "seed {seed}, density {density}");
            assert_at_least!(vertices, before, "seed {seed}, density {density}");
            before = vertices;
        }
    }
}

#[test]
fn a_hole_is_filled_within_every_bound_on_vertices() {
    for max_vertices in [30, 100, 300, 1000, 3000] {
        let (_, vertices) = fill(1, 10.0, max_vertices);
        assert_at_most!(vertices, max_vertices, "{max_vertices} vertices");
    }
}

/// The middle of a plane grid of 20 by 20 squares, triangulated anew.
fn remeshed_grid(density: f64, max_vertices: usize) -> Remeshed {
    let number = |i: u32, j: u32| 21 * i + j;
    let squares = |n: u32| (0..n).flat_map(move |i| (0..n).map(move |j| (i, j)));
    let x: Vec<[f64; 3]> = squares(21)
        .map(|(i, j)| [f64::from(i), f64::from(j), 0.0])
        .collect();
    let t: Vec<[u32; 3]> = squares(20)
        .flat_map(|(i, j)| {
            let [a, b] = [number(i, j), number(i + 1, j)];
            [[a, b, b + 1], [a, b + 1, a + 1]]
        })
        .collect();
    let free: Vec<u32> = squares(13).map(|(i, j)| number(i + 4, j + 4)).collect();
    let options = RemeshOptions {
        density,
        max_vertices,
        ..RemeshOptions::default()
    };
    remesh_region(&x, &t, Selection::Vertices(&free), &options).unwrap()
}

/// A density of 8 made vertices of thousands of triangles, and walked around them for minutes.
#[test]
fn a_region_is_triangulated_anew_at_every_density() {
    let mut before = 0;
    for density in DENSITIES {
        let new = remeshed_grid(density, 200_000);
        let valence = largest_valence(&new.triangles, new.kept_triangles.len());
        assert_below!(valence, 20, "density {density}");
        assert!(
            new.positions.iter().all(|p| p[2] == 0.0),
            "density {density}: not plane"
        );
        assert_at_least!(new.free.len(), before, "density {density}");
        before = new.free.len();
    }
    // 14 by 14 squares at the grid's own fineness times 100 / 2 but for a margin.
    assert_at_least!(before, 5_000, "density 10");
}

/// A bridge between two plates of 2 by 6 squares, from the four edges in the middle of one to those of the other.
fn bridged_plates(gap: f64, density: f64) -> Result<Bridged, Error> {
    let places = (0..3).flat_map(|i| (0..7).map(move |j| [f64::from(i), f64::from(j), 0.0]));
    let plate: Vec<[f64; 3]> = places.collect();
    let beyond = plate.iter().map(|p| [p[0] + 2.0 + gap, p[1], p[2]]);
    let x: Vec<[f64; 3]> = plate.iter().copied().chain(beyond).collect();
    let squares = |first: u32| (0..12).map(move |k| first + 7 * (k / 6) + k % 6);
    let t: Vec<[u32; 3]> = squares(0)
        .chain(squares(21))
        .flat_map(|a| [[a, a + 7, a + 8], [a, a + 8, a + 1]])
        .collect();
    let options = BridgeOptions {
        filling: FillOptions {
            density,
            ..FillOptions::default()
        },
        ..BridgeOptions::default()
    };
    bridge(&x, &t, [&[15, 16, 17, 18, 19], &[22, 23, 24, 25, 26]], &options)
}

/// A density of 10 counted all vertices again for each that it made.
#[test]
fn a_bridge_is_made_at_every_density() {
    for density in DENSITIES {
        let bridged = bridged_plates(12.0, density).unwrap();
        assert_eq!(bridged.strip.outcome, FillOutcome::Faired, "density {density}");
        assert!(
            bridged.positions.iter().all(|p| p[2].abs() < 1e-9),
            "density {density}"
        );
        let valence = largest_valence(&bridged.triangles, 48);
        assert_below!(valence, 20, "density {density}");
    }
}

/// A gap of a million edges took minutes: chords were compared with all guides, and ears with all vertices.
#[test]
fn a_bridge_over_a_far_gap_ends_soon() {
    let far = bridged_plates(1e6, 2.0f64.sqrt()).map(|bridged| bridged.strip.outcome);
    let refused = Error::BadOption {
        name: "max_new_vertices",
        value: 200_000.0,
        range: "at least the number of vertices that the two sides of the bridge need",
    };
    assert_eq!(far, Err(refused));
    let bridged = bridged_plates(4_000.0, 2.0f64.sqrt()).unwrap();
    assert_eq!(bridged.strip.outcome, FillOutcome::Faired);
    assert_at_least!(bridged.parents.len(), 16_000);
}
