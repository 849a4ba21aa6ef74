//! Vertices moved along the fitted surface, where noise has folded their triangles or left them hardly any width.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use super::band::Band;
use super::fit::Sheet;

/// The gap's angle at a vertex of a loop counts as a triangle's quality, over this one.
/// Of 3 cases, half: 2 change by up to 0.8 edges, 1 get another triangulation;
/// double: 3 change, 2 get another triangulation, -22 % iterations, 1 fails.
const WIDE: f64 = 100.0 / 360.0 * TAU;
/// Rounds over all vertices.
/// Of 3 cases, half: 1 changes by up to 0.09 edges; double: none changes.
const ROUNDS: usize = 40;
/// The lengths of steps that are tried, in edges.
/// Of 3 cases, half: 3 change by up to 0.2 edges, 2 get another triangulation, +4 % iterations;
/// double: 3 change by up to 0.3 edges, 2 get another triangulation, +4 % iterations.
const STEPS: [f64; 4] = [0.4, 0.2, 0.1, 0.04];
/// Directions in which they are tried.
/// Half or double, of 3 cases: 3 change by up to 0.2 edges, 2 get another triangulation.
const DIRECTIONS: usize = 12;

/// The first vertices of a band, which move.
pub(super) struct Untangling<'a> {
    pub(super) band: &'a Band,
    /// Per vertex that may move the surface it stays on; none if it stays.
    pub(super) sheets: &'a [Option<Sheet>],
    /// Where all are now.
    pub(super) x: Vec<Vector3<f64>>,
    /// No vertex goes further than this from where the mesh has it.
    pub(super) within: f64,
    pub(super) edge: f64,
    /// Triangles of less quality than this are mended.
    pub(super) poor: f64,
    /// The first vertices are on the loops.
    pub(super) on_loops: usize,
}

impl Untangling<'_> {
    /// Moves vertices until no triangle can be bettered.
    pub(super) fn run(&mut self) {
        for _ in 0..ROUNDS {
            let mut is_done = true;
            for v in 0..self.sheets.len() {
                if let Some(sheet) = self.sheets[v]
                    && let Some(better) = self.better(v, &sheet)
                {
                    self.x[v] = better;
                    is_done = false;
                }
            }
            if is_done {
                return;
            }
        }
    }

    /// How many triangles at vertices that may move are folded.
    pub(super) fn folded(&self) -> usize {
        let is_folded = |t: &&[u32; 3]| {
            let sheet = t
                .iter()
                .find_map(|&v| self.sheets.get(v as usize).copied().flatten());
            let corners = t.map(|v| self.x[v as usize]);
            sheet.is_some_and(|sheet| quality(corners, &sheet.normal) <= 0.0)
        };
        self.band.triangles.iter().filter(is_folded).count()
    }

    /// A place for a vertex with a poor triangle where the worst of them is better.
    fn better(&self, v: usize, sheet: &Sheet) -> Option<Vector3<f64>> {
        let mut best = (self.worst(v, self.x[v], sheet), None);
        if best.0 >= self.poor {
            return None;
        }
        // Directions count from a neighbour, so that they turn with the mesh.
        let neighbour = self.band.neighbours.row(v).first()?;
        let first = sheet.direction(self.x[*neighbour as usize] - self.x[v]);
        for step in STEPS {
            for k in 0..DIRECTIONS {
                let (sin, cos) = libm::sincos(first + TAU * k as f64 / DIRECTIONS as f64);
                let x = sheet.near(self.x[v], [cos, sin].map(|c| c * step * self.edge));
                if (x - self.band.x[v]).norm() <= self.within {
                    let worst = self.worst(v, x, sheet);
                    if worst > best.0 + 1e-6 {
                        best = (worst, Some(x));
                    }
                }
            }
        }
        best.1
    }

    /// The least quality at a vertex, if it were at `x`.
    fn worst(&self, v: usize, x: Vector3<f64>, sheet: &Sheet) -> f64 {
        let at = |w: u32| if w as usize == v { x } else { self.x[w as usize] };
        let normal = &sheet.normal;
        let (mut worst, mut sum) = (1.0f64, 0.0);
        for &t in self.band.stars.row(v) {
            let corners = self.band.triangles[t as usize];
            worst = worst.min(quality(corners.map(at), normal));
            let k = corners.iter().position(|&w| w as usize == v).unwrap_or(0);
            let [a, b] = [1, 2].map(|i| {
                let d = at(corners[(k + i) % 3]) - x;
                d - normal * d.dot(normal)
            });
            sum += libm::atan2(normal.dot(&a.cross(&b)), a.dot(&b));
        }
        // What the triangles leave of a full turn.
        match v < self.on_loops {
            true => worst.min((TAU - sum) / WIDE),
            false => worst,
        }
    }
}

/// 1 for an equilateral triangle, 0.6 for one with angles of 30, 30 and 120 degrees, 0 for one without area, less if it is turned over.
fn quality([a, b, c]: [Vector3<f64>; 3], normal: &Vector3<f64>) -> f64 {
    let squares = (b - a).norm_squared() + (c - b).norm_squared() + (a - c).norm_squared();
    let area = normal.dot(&(b - a).cross(&(c - a)));
    12f64.sqrt() * area / squares.max(f64::MIN_POSITIVE)
}
