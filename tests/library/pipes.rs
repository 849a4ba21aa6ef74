//! Joins of the ends of two tubes: a pipe between them, whatever their quads.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use fairmesh::{FillOptions, FillOutcome, Filled, Join, Loops, Options, Outcome, boundary_loops, fill_holes};

type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// An open tube, from its mouth at `mouth` back against `axis`, of `rows` rows of quads.
struct Tube {
    around: usize,
    radius: f64,
    mouth: Vector3<f64>,
    axis: Vector3<f64>,
    rows: usize,
    quad: f64,
}

impl Tube {
    fn add_to(&self, (positions, triangles): &mut Mesh) {
        let first = positions.len() as u32;
        let (u, n) = (Vector3::y(), self.around);
        let v = self.axis.cross(&u);
        for k in 0..n * (self.rows + 1) {
            let turn = TAU * (k % n) as f64 / n as f64;
            let back = self.axis * (self.quad * (k / n) as f64);
            let ring = u * turn.cos() + v * turn.sin();
            positions.push((self.mouth - back + ring * self.radius).into());
        }
        for k in 0..n * self.rows {
            let next = k / n * n + (k + 1) % n;
            let [a, b, c, d] = [k, next, next + n, k + n].map(|v| first + v as u32);
            triangles.extend([[a, d, b], [b, d, c]]);
        }
    }
}

/// Two mouths at the ends of an arc of this length and turn, from the origin in the xz plane.
struct Elbow {
    around: [usize; 2],
    radii: [f64; 2],
    length: f64,
    degrees: f64,
    has_long_quads: bool,
}

impl Elbow {
    fn straight(around: usize, length: f64, has_long_quads: bool) -> Self {
        Self {
            around: [around; 2],
            radii: [1.0; 2],
            length,
            degrees: 0.0,
            has_long_quads,
        }
    }

    /// A place on the arc and its direction.
    fn arc(&self, s: f64) -> (Vector3<f64>, Vector3<f64>) {
        let turn = (s * self.degrees).to_radians();
        let direction = Vector3::new(turn.sin(), 0.0, turn.cos());
        let place = match turn {
            0.0 => Vector3::z() * (s * self.length),
            _ => Vector3::new(1.0 - turn.cos(), 0.0, turn.sin()) * (s * self.length / turn),
        };
        (place, direction)
    }

    fn mesh(&self) -> Mesh {
        let mut mesh = Mesh::default();
        for (side, s) in [0.0, 1.0].into_iter().enumerate() {
            let (mouth, direction) = self.arc(s);
            let (around, radius) = (self.around[side], self.radii[side]);
            let (rows, quad) = match self.has_long_quads {
                true => (1, 2.0),
                false => (4, TAU * radius / around as f64),
            };
            let axis = if side == 0 { direction } else { -direction };
            let tube = Tube {
                around,
                radius,
                mouth,
                axis,
                rows,
                quad,
            };
            tube.add_to(&mut mesh);
        }
        mesh
    }

    fn joined(&self, max_iterations: usize) -> (Mesh, Filled) {
        let mesh = self.mesh();
        let loops = boundary_loops(&mesh.0, &mesh.1).unwrap();
        let is_mouth = |l: &usize| {
            let of = loops[*l].vertices.iter();
            let sum: Vector3<f64> = of.map(|&v| Vector3::from(mesh.0[v as usize])).sum();
            let centre = sum / loops[*l].vertices.len() as f64;
            [0.0, 1.0].iter().any(|&s| (self.arc(s).0 - centre).norm() < 1e-6)
        };
        let options = FillOptions {
            loops: Loops::Chosen(Vec::new()),
            join: Join::Groups(vec![(0..loops.len()).filter(is_mouth).collect()]),
            fairing: Options {
                threads: 1,
                max_iterations,
                ..Options::default()
            },
            ..FillOptions::default()
        };
        let filled = fill_holes(&mesh.0, &mesh.1, &options).unwrap();
        (mesh, filled)
    }

    /// The least and the largest mean distance from the arc, over the radius interpolated there, of the new vertices in eight parts of it; and
    /// how the fairing ended.
    fn radii_reached(&self) -> ([f64; 2], Outcome) {
        let ((positions, _), filled) = self.joined(500);
        let mut sums = [(0.0, 0.0); 8];
        for p in &filled.positions[positions.len()..] {
            let p = Vector3::from(*p);
            let from = |s: f64| (p - self.arc(s).0).norm();
            let places = (0..=400).map(|k| f64::from(k) / 400.0);
            let s = places.min_by(|a, b| from(*a).total_cmp(&from(*b))).unwrap();
            let wanted = self.radii[0] * (1.0 - s) + self.radii[1] * s;
            let sum = &mut sums[((8.0 * s) as usize).min(7)];
            *sum = (sum.0 + from(s) / wanted, sum.1 + 1.0);
        }
        let means = sums.iter().map(|(sum, count)| sum / count);
        let reached = [
            means.clone().fold(f64::INFINITY, f64::min),
            means.fold(0.0, f64::max),
        ];
        let fairing = filled.loops[0].fairing.as_ref().expect("a patch");
        (reached, fairing.outcome.clone())
    }
}

#[test]
fn between_coaxial_tubes_a_straight_one_is_found() {
    for (around, length) in [(16, 1.0), (16, 4.0), (32, 2.0), (32, 6.0), (64, 4.0), (96, 1.0)] {
        for has_long_quads in [false, true] {
            let (reached, outcome) = Elbow::straight(around, length, has_long_quads).radii_reached();
            println!("{around} around, {length}, {has_long_quads}: {reached:?} {outcome:?}");
            assert_eq!(
                outcome,
                Outcome::Converged,
                "{around}, {length}, {has_long_quads}"
            );
            assert!(reached.iter().all(|r| (r - 1.0).abs() < 0.01), "{reached:?}");
        }
    }
}

/// The ends of an elbow are as wide as the tubes, and it has no neck.
#[test]
fn between_tubes_at_an_angle_an_elbow_is_found() {
    for (degrees, length) in [(30.0, 4.0), (60.0, 2.0), (60.0, 4.0), (90.0, 3.0)] {
        for around in [32, 64] {
            let elbow = Elbow {
                degrees,
                ..Elbow::straight(around, length, true)
            };
            let (reached, outcome) = elbow.radii_reached();
            println!("{degrees} degrees, {around} around, {length}: {reached:?} {outcome:?}");
            assert_eq!(outcome, Outcome::Converged, "{degrees}, {around}, {length}");
            assert!(reached[0] > 0.8 && reached[1] < 1.05, "{reached:?}");
        }
    }
}

#[test]
fn tubes_of_other_widths_and_numbers_of_vertices_are_joined() {
    for (around, radii, degrees) in [([32, 20], [1.0, 0.6], 0.0), ([24, 40], [0.7, 1.0], 45.0)] {
        let elbow = Elbow {
            around,
            radii,
            degrees,
            ..Elbow::straight(32, 2.0, false)
        };
        let (reached, outcome) = elbow.radii_reached();
        println!("{around:?} {radii:?}: {reached:?} {outcome:?}");
        assert_eq!(outcome, Outcome::Converged, "{around:?}");
        assert!(reached[0] > 0.9 && reached[1] < 1.1, "{reached:?}");
    }
}

/// A sphere goes through both ends of a tube of one row of quads. Its normals are half a right angle off those of the tube.
#[test]
fn a_tube_of_one_row_is_not_taken_for_a_sphere() {
    let (mesh, filled) = Elbow::straight(32, 2.0, true).joined(500);
    let off = |p: &[f64; 3]| (p[0].hypot(p[1]) - 1.0).abs();
    let worst = filled.positions[mesh.0.len()..]
        .iter()
        .map(off)
        .fold(0.0, f64::max);
    assert!(worst < 0.005, "{worst}");
}

/// A tube that is longer than it is around is left as one, not as lids with a thread between them.
#[test]
fn no_film_is_tried_where_the_ends_are_too_far_from_each_other() {
    let (_, filled) = Elbow::straight(32, 12.0, false).joined(500);
    let report = &filled.loops[0];
    assert_eq!(report.outcome, FillOutcome::LeastBending);
    assert!(!filled.is_success());
    // Rows of 32, .17 from each other.
    assert!(
        (2000..2500).contains(&report.vertices.len()),
        "{:?}",
        report.vertices
    );
}

/// A patch that cannot be found in so few iterations is not called one that is.
#[test]
fn iterations_of_a_patch_are_bounded_by_what_is_asked() {
    let (_, filled) = Elbow::straight(32, 6.0, false).joined(3);
    let fairing = filled.loops[0].fairing.as_ref().expect("a patch");
    assert_eq!(fairing.outcome, Outcome::IterationLimit);
    assert!(fairing.iterations <= 4, "{}", fairing.iterations);
    assert!(!filled.is_success());
}
