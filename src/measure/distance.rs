//! How far a surface is from another one.

use fairmesh_linear::parallel;
use nalgebra::Vector3;
use rstar::RTree;

use crate::fairing::Workers;
use crate::holes::{Placed, nearest_on};
use crate::mesh::input;
use crate::support::error::Error;

/// The largest distance is found to this part of itself.
/// Half or double, of 1 case: 1 changes by up to 0.003 edges.
const TOLERANCE: f64 = 0.01;
/// The mean is taken at so many points of large triangles as squares of this side, in diagonals, have room in them.
/// On three regions that were faired half changes the root mean square by 2e-5 to .002 of itself, and double of two by 7e-5.
const SPACING: f64 = 1.0 / 100.0;
/// At most so many points along the side of a triangle.
/// Half or double, of 1 case: none changes.
const MOST_ALONG: f64 = 512.0;
/// After so many points more the search for the largest distance ends with what is certain.
/// Half or double, of 1 case: none changes.
const MOST_POINTS: usize = 1 << 20;
/// Points or triangles in a piece of a loop over all.
/// Half or double, of 1 case: none changes.
const PIECES: usize = 64;
/// Of a triangle's longest edge: how far a point of it is from the nearest corner, at most.
const TO_CORNER: f64 = 0.577_350_27;

/// A surface that others are measured against.
///
/// ```
/// use fairmesh::DistanceTo;
/// // A square, and a roof over it: their corners are the same.
/// let square = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]];
/// let roof = [square[0], square[1], square[2], square[3], [1.0, 1.0, 1.0]];
/// let floor = DistanceTo::new(&square, &[[0, 1, 2], [0, 2, 3]])?;
/// let height = floor.of(&roof, &[[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])?;
/// assert_eq!((height.largest, height.largest_at), (1.0, [1.0, 1.0, 1.0]));
/// assert_eq!(height.vertices, [0.0, 0.0, 0.0, 0.0, 1.0]);
/// # Ok::<(), fairmesh::Error>(())
/// ```
pub struct DistanceTo {
    tree: RTree<Placed>,
    /// The tree's order is its own: triangles by their numbers.
    corners: Vec<[Vector3<f64>; 3]>,
}

/// How far the points of a surface are from the nearest points of another one; never negative.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceDistance {
    /// Of every vertex; NaN where it is not finite.
    pub vertices: Vec<f64>,
    /// The largest that was found, at vertices and inside triangles.
    pub largest: f64,
    /// No point of the surface is farther away than this: 1 % more than `largest`, unless that takes a million points to see.
    pub largest_bound: f64,
    /// Where the largest one is.
    pub largest_at: [f64; 3],
    /// Mean over the area.
    pub mean: f64,
    /// Root mean square over the area.
    pub rms: f64,
}

/// The nearest point: its distance, and the triangle that has it.
type Foot = (f64, u32);

/// A piece of a triangle, with what is nearest to its corners.
#[derive(Clone, Copy)]
struct TriangleSample {
    x: [Vector3<f64>; 3],
    feet: [Foot; 3],
}

impl DistanceTo {
    /// `positions` is #V by 3, `triangles` #T by 3. Any triangles will do: they need not fit together.
    ///
    /// # Errors
    /// [`Error::TooLarge`], [`Error::IndexOutOfRange`], [`Error::NotFinite`] for a vertex of a triangle.
    pub fn new(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<Self, Error> {
        input::check(positions.len(), triangles)?;
        input::check_finite(positions, triangles)?;
        let placed = (0..triangles.len() as u32).filter_map(|t| Placed::of(positions, triangles, t));
        let placed: Vec<Placed> = placed.collect();
        Ok(Self {
            corners: placed.iter().map(|t| t.x).collect(),
            tree: RTree::bulk_load(placed),
        })
    }

    /// How far another surface is from this one. Distances of points are exact; the largest is searched for over whole triangles,
    /// so that coarse ones hide nothing, and the means are taken at one point of every triangle or more. Without a triangle on
    /// either side there is nothing to measure: distances are infinite, and of no triangles 0.
    ///
    /// # Errors
    /// As of [`new`](Self::new), for this surface; [`Error::Threads`].
    pub fn of(&self, positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<SurfaceDistance, Error> {
        input::check(positions.len(), triangles)?;
        input::check_finite(positions, triangles)?;
        // Not on the global pool, whose threads would outlive a library that is unloaded.
        Ok(Workers::new(0)?.install(|| self.measure(positions, triangles)))
    }

    fn measure(&self, positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> SurfaceDistance {
        let feet = parallel::map_each(positions.len(), PIECES, |v| self.foot(&positions[v].into()));
        let mut found = SurfaceDistance {
            vertices: feet.iter().map(|foot| foot.0).collect(),
            largest: 0.0,
            largest_bound: 0.0,
            largest_at: triangles.first().map_or([0.0; 3], |t| positions[t[0] as usize]),
            mean: 0.0,
            rms: 0.0,
        };
        for &v in triangles.as_flattened() {
            found.see(feet[v as usize].0, positions[v as usize]);
        }
        let pieces: Vec<TriangleSample> = triangles
            .iter()
            .map(|t| TriangleSample {
                x: t.map(|v| positions[v as usize].into()),
                feet: t.map(|v| feet[v as usize]),
            })
            .collect();
        self.average(&pieces, &mut found);
        self.search(pieces, &mut found);
        found
    }

    /// What is nearest to a point; NaN for one that is not finite.
    fn foot(&self, p: &Vector3<f64>) -> Foot {
        if !p.iter().all(|c| c.is_finite()) {
            return (f64::NAN, 0);
        }
        let nearest = self.tree.nearest_neighbor(&(*p).into());
        nearest.map_or((f64::INFINITY, 0), |t| (nearest_on(&t.x, p).0.sqrt(), t.number))
    }

    /// Means over the area, by the midpoint rule on equal parts of every triangle.
    fn average(&self, pieces: &[TriangleSample], found: &mut SurfaceDistance) {
        let cell = (SPACING * diagonal(pieces)).powi(2);
        let sums = parallel::map_each(pieces.len(), PIECES, |k| {
            let piece = &pieces[k];
            let area = piece.area();
            let along = (area / cell).sqrt().ceil().clamp(1.0, MOST_ALONG) as usize;
            let (mut sum, mut largest, mut at) = ([0.0; 2], (-1.0, 0), [0.0; 3]);
            for p in piece.middles(along) {
                let foot = self.foot(&p);
                sum = [sum[0] + foot.0, sum[1] + foot.0 * foot.0];
                if foot.0 > largest.0 {
                    (largest, at) = (foot, p.into());
                }
            }
            (area, sum.map(|s| s / (along * along) as f64), largest, at)
        });
        let (mut total, mut sum) = (0.0, [0.0; 2]);
        for (area, means, largest, at) in sums {
            total += area;
            (0..2).for_each(|k| sum[k] += area * means[k]);
            found.see(largest.0, at);
        }
        if total > 0.0 {
            (found.mean, found.rms) = (sum[0] / total, (sum[1] / total).sqrt());
        }
    }

    /// Divides the pieces that may hold a larger distance, until none does, or it takes too long.
    fn search(&self, pieces: Vec<TriangleSample>, found: &mut SurfaceDistance) {
        let least = 1e-12 * diagonal(&pieces);
        let mut open = pieces;
        let mut points = 0;
        loop {
            let enough = found.largest * (1.0 + TOLERANCE) + least;
            let bounds = parallel::map_each(open.len(), PIECES, |k| self.bound(&open[k], enough));
            let bound = bounds.iter().fold(found.largest, |most, &bound| most.max(bound));
            let mut bounds = bounds.into_iter();
            open.retain(|_| bounds.next().is_some_and(|bound| bound > enough));
            points += open.len();
            if open.is_empty() || points > MOST_POINTS || !bound.is_finite() {
                found.largest_bound = bound;
                return;
            }
            let halves = parallel::map_each(open.len(), PIECES, |k| self.halves(&open[k]));
            for [half, _] in &halves {
                found.see(half.feet[1].0, half.x[1].into());
            }
            open = halves.into_iter().flatten().collect();
        }
    }

    /// No point of the piece is farther away than this; no sharper than whether that is `enough`.
    fn bound(&self, piece: &TriangleSample, enough: f64) -> f64 {
        let farthest = piece.feet.iter().fold(0.0f64, |most, foot| most.max(foot.0));
        let mut bound = farthest + TO_CORNER * piece.longest().1;
        for (_, t) in piece.feet {
            if bound <= enough {
                break;
            }
            // The distance from one triangle is convex: on the piece it is largest at a corner.
            let Some(corners) = self.corners.get(t as usize) else {
                return f64::INFINITY;
            };
            let from_one = piece.x.iter().map(|p| nearest_on(corners, p).0);
            bound = bound.min(from_one.fold(0.0, f64::max).sqrt());
        }
        bound
    }

    /// The piece divided at the middle of its longest edge, which is corner 1 of the first half.
    fn halves(&self, piece: &TriangleSample) -> [TriangleSample; 2] {
        let (k, _) = piece.longest();
        let [a, b, c] = [k, (k + 1) % 3, (k + 2) % 3];
        let middle = (piece.x[a] + piece.x[b]) * 0.5;
        let foot = self.foot(&middle);
        let part = |first: (Vector3<f64>, Foot), second: (Vector3<f64>, Foot)| TriangleSample {
            x: [first.0, second.0, piece.x[c]],
            feet: [first.1, second.1, piece.feet[c]],
        };
        let end = |k: usize| (piece.x[k], piece.feet[k]);
        [part(end(a), (middle, foot)), part((middle, foot), end(b))]
    }
}

impl SurfaceDistance {
    fn see(&mut self, distance: f64, at: [f64; 3]) {
        if distance > self.largest {
            (self.largest, self.largest_at) = (distance, at);
        }
    }
}

impl TriangleSample {
    fn area(&self) -> f64 {
        0.5 * (self.x[1] - self.x[0]).cross(&(self.x[2] - self.x[0])).norm()
    }

    /// The longest edge: the corner it begins at, and its length.
    fn longest(&self) -> (usize, f64) {
        let length = |k: usize| (self.x[(k + 1) % 3] - self.x[k]).norm();
        (1..3).map(|k| (k, length(k))).fold(
            (0, length(0)),
            |most, edge| if edge.1 > most.1 { edge } else { most },
        )
    }

    /// The middles of n² equal triangles.
    fn middles(&self, n: usize) -> impl Iterator<Item = Vector3<f64>> + '_ {
        let [along, across] = [self.x[1] - self.x[0], self.x[2] - self.x[0]];
        let scale = 1.0 / (3 * n) as f64;
        let at = move |i: usize, j: usize, third: usize| {
            let [s, t] = [i, j].map(|k| (3 * k + third) as f64 * scale);
            self.x[0] + along * s + across * t
        };
        (0..n)
            .flat_map(move |j| (0..n - j).map(move |i| (i, j)))
            .flat_map(move |(i, j)| {
                let is_inside = i + j + 1 < n;
                let opposite = is_inside.then(|| at(i, j, 2));
                std::iter::once(at(i, j, 1)).chain(opposite)
            })
    }
}

/// That of the bounding box; at least the least number that has a square.
fn diagonal(pieces: &[TriangleSample]) -> f64 {
    let (mut low, mut high) = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    for p in pieces.iter().flat_map(|piece| &piece.x) {
        (low, high) = (low.inf(p), high.sup(p));
    }
    let diagonal = (high - low).norm();
    if diagonal > 1e-150 { diagonal } else { 1e-150 }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [[f64; 3]; 4] = [
        [-1.0, -1.0, 0.0],
        [1.0, -1.0, 0.0],
        [1.0, 1.0, 0.0],
        [-1.0, 1.0, 0.0],
    ];
    const HALVES: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

    #[test]
    fn parallel_squares_are_equally_far_everywhere() {
        let above = SQUARE.map(|[x, y, _]| [x, y, 0.3]);
        let found = DistanceTo::new(&SQUARE, &HALVES).unwrap().of(&above, &HALVES);
        let found = found.unwrap();
        for figure in [found.largest, found.largest_bound, found.mean, found.rms] {
            assert!((figure - 0.3).abs() < 1e-12, "{found:?}");
        }
        let same = DistanceTo::new(&SQUARE, &HALVES).unwrap().of(&SQUARE, &HALVES);
        let same = same.unwrap();
        assert_eq!((same.largest, same.mean, same.rms), (0.0, 0.0, 0.0));
        assert!(same.largest_bound < 1e-11, "{same:?}");
    }

    #[test]
    fn what_lies_between_the_vertices_of_a_coarse_mesh_counts() {
        // A narrow spike: no vertex of the square and no middle of its triangles is near it.
        let mut spiked = SQUARE.to_vec();
        let [x, y, side] = [0.41, -0.13, 0.05];
        spiked.extend([
            [x, y, 0.8],
            [x - side, y, 0.0],
            [x + side, y, 0.0],
            [x, y + side, 0.0],
        ]);
        // The square without its place: nothing there but the spike.
        let around = [
            [0, 1, 5],
            [1, 6, 5],
            [1, 2, 6],
            [2, 7, 6],
            [2, 3, 7],
            [3, 5, 7],
            [3, 0, 5],
        ];
        let spike = [[5, 6, 4], [6, 7, 4], [7, 5, 4]];
        let all: Vec<[u32; 3]> = around.into_iter().chain(spike).collect();
        let onto = DistanceTo::new(&spiked, &all)
            .unwrap()
            .of(&SQUARE, &HALVES)
            .unwrap();
        // The middle of the hole under the spike is as far from its sides as from the rim at most.
        assert!(onto.largest > 0.01 && onto.largest < side, "{onto:?}");
        assert!(onto.largest_bound <= onto.largest * 1.01 + 1e-9, "{onto:?}");
        let back = DistanceTo::new(&SQUARE, &HALVES)
            .unwrap()
            .of(&spiked, &all)
            .unwrap();
        assert_near!(back.largest, 0.8, 1e-12);
        assert_eq!(back.largest_at, [x, y, 0.8]);
        assert!(back.rms < 0.8 && back.mean < back.rms, "{back:?}");
    }

    #[test]
    fn means_of_a_slope_are_those_of_the_integral() {
        let slope = SQUARE.map(|[x, y, _]| [x, y, 0.5 * (x + 1.0)]);
        let floor = [
            [-9.0, -9.0, 0.0],
            [9.0, -9.0, 0.0],
            [9.0, 9.0, 0.0],
            [-9.0, 9.0, 0.0],
        ];
        let found = DistanceTo::new(&floor, &HALVES).unwrap().of(&slope, &HALVES);
        let found = found.unwrap();
        assert!((found.mean - 0.5).abs() < 1e-9, "{found:?}");
        assert!((found.rms - (1.0f64 / 3.0).sqrt()).abs() < 1e-4, "{found:?}");
        assert_eq!(found.largest, 1.0);
    }

    #[test]
    fn odd_input_is_refused_or_measured() {
        assert_eq!(
            DistanceTo::new(&SQUARE, &[[0, 1, 9]]).err(),
            Some(Error::IndexOutOfRange {
                triangle: 0,
                index: 9,
                vertex_count: 4
            })
        );
        let nothing = DistanceTo::new(&SQUARE, &[]).unwrap();
        assert_eq!(nothing.of(&SQUARE, &HALVES).unwrap().largest, f64::INFINITY);
        assert_eq!(nothing.of(&SQUARE, &[]).unwrap().largest, 0.0);
        let huge = SQUARE.map(|p| p.map(|c| c * 1e307));
        let found = DistanceTo::new(&huge, &HALVES)
            .unwrap()
            .of(&SQUARE, &HALVES)
            .unwrap();
        assert_at_least!(found.largest, 0.0);
        let point = DistanceTo::new(&SQUARE, &[[1, 1, 1]]).unwrap();
        let found = point.of(&SQUARE, &HALVES).unwrap();
        assert!(
            (found.largest - 8f64.sqrt()).abs() < 1e-12 && found.mean > 0.0,
            "{found:?}"
        );
    }
}
