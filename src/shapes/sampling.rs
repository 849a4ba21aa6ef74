//! Where the vertices go: a lattice, a disturbed lattice, or a lattice with a finer rectangle.

use super::arithmetic::between;
use super::rng::Rng;
use std::collections::HashMap;

/// How the vertices of a shape are distributed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sampling {
    /// A lattice of (nearly) equilateral triangles; on the sphere with a hole a Fibonacci lattice.
    Regular,
    /// The lattice shaken by up to 0.3 spacings, one vertex in five dropped, 15 % put elsewhere at
    /// random: valences from 3 to about 11, edge lengths that vary by a factor of ten.
    Irregular {
        /// Of the generator; the same seed gives the same bits.
        seed: u64,
    },
    /// The lattice, finer inside a rectangle. The rectangle is given in chart coordinates in which a
    /// disc is the unit disc and a band is (-1, 1) x (-1, 1): angle about the axis over pi, minus 1,
    /// and relative height.
    LocallyRefined {
        /// How many times finer (1 to 10).
        factor: f64,
        /// Lower left corner of the rectangle.
        min: [f64; 2],
        /// Upper right corner.
        max: [f64; 2],
    },
}

impl Sampling {
    /// Three times finer in a rectangle beside the centre, on one side only.
    pub fn locally_refined() -> Self {
        Sampling::LocallyRefined {
            factor: 3.0,
            min: [0.05, -0.25],
            max: [0.5, 0.2],
        }
    }
}

/// A parameter domain that can be filled with points; `base` lattice points fall into its free part.
pub(super) trait Domain {
    type Point: Copy;
    /// Edge length of the lattice, in the metric of `embed`.
    fn spacing(&self) -> f64;
    /// The lattice over the domain, margin included, `factor` times finer.
    fn lattice(&self, factor: f64) -> Vec<Self::Point>;
    /// A place in space such that near points have the distance of the parameter domain.
    fn embed(&self, p: Self::Point) -> [f64; 3];
    /// `p` displaced by up to `amount` in every coordinate.
    fn shake(&self, p: Self::Point, amount: f64, rng: &mut Rng) -> Self::Point;
    /// A uniformly distributed point of the domain, margin included.
    fn draw(&self, rng: &mut Rng) -> Self::Point;
    /// Chart coordinates of [`Sampling::LocallyRefined`].
    fn chart(&self, p: Self::Point) -> [f64; 2];
    /// Share of the free region's area per unit of chart area; zero outside the region.
    fn density(&self, chart: [f64; 2]) -> f64;
}

/// Shares of lattice points dropped and put back elsewhere, and the closest a point may come to another.
const DROPPED: f64 = 0.2;
const INSERTED: f64 = 0.15;
const SHAKE: f64 = 0.3;
const CLOSEST: f64 = 0.15;
/// The largest factor of local refinement.
const FINEST: f64 = 10.0;

/// Number of lattice points in the free region for which the sampled region has about `n`.
pub(super) fn lattice_count<D: Domain>(n: usize, sampling: Sampling, domain: &D) -> f64 {
    let n = n.clamp(12, 50_000_000) as f64;
    match sampling {
        Sampling::Regular => n,
        Sampling::Irregular { .. } => n / (1.0 - DROPPED + INSERTED),
        Sampling::LocallyRefined { factor, min, max } => {
            n / (1.0 + (between(1.0, factor, FINEST).powi(2) - 1.0) * share(domain, min, max))
        }
    }
}

/// Share of the free region's area inside the rectangle (midpoint rule).
fn share<D: Domain>(domain: &D, min: [f64; 2], max: [f64; 2]) -> f64 {
    const M: usize = 128;
    let (w, h) = ((max[0] - min[0]) / M as f64, (max[1] - min[1]) / M as f64);
    let mut sum = 0.0;
    for k in 0..M * M {
        let (i, j) = ((k % M) as f64 + 0.5, (k / M) as f64 + 0.5);
        sum += domain.density([min[0] + i * w, min[1] + j * h]) * w * h;
    }
    // In this order a NaN becomes 0.
    between(0.0, sum, 1.0)
}

/// The points of the domain under a sampling.
pub(super) fn sample<D: Domain>(domain: &D, sampling: Sampling) -> Vec<D::Point> {
    let h = domain.spacing();
    let lattice = domain.lattice(1.0);
    match sampling {
        Sampling::Regular => lattice,
        Sampling::Irregular { seed } => irregular(domain, lattice, h, &mut Rng::new(seed)),
        Sampling::LocallyRefined { factor, min, max } => {
            let factor = between(1.0, factor, FINEST);
            let within = |p: D::Point| {
                let c = domain.chart(p);
                (0..2).all(|i| c[i] > min[i] && c[i] < max[i])
            };
            let mut points: Vec<D::Point> = lattice.into_iter().filter(|&p| !within(p)).collect();
            let mut grid = Grid::new(h);
            points.iter().for_each(|&p| grid.insert(domain.embed(p)));
            let fine = domain.lattice(factor).into_iter();
            points.extend(fine.filter(|&p| within(p) && grid.is_clear(domain.embed(p), 0.7 * h / factor)));
            points
        }
    }
}

fn irregular<D: Domain>(domain: &D, lattice: Vec<D::Point>, h: f64, rng: &mut Rng) -> Vec<D::Point> {
    let inserted = (INSERTED * lattice.len() as f64).round() as usize;
    let mut grid = Grid::new(h);
    let mut points = Vec::with_capacity(lattice.len());
    for p in lattice {
        let (q, kept) = (domain.shake(p, SHAKE * h, rng), rng.unit() >= DROPPED);
        if kept {
            grid.insert(domain.embed(q));
            points.push(q);
        }
    }
    let mut missing = inserted;
    // Most draws succeed: a disc of radius CLOSEST spacings around every point covers a few per cent.
    for _ in 0..4 * inserted {
        if missing == 0 {
            break;
        }
        let q = domain.draw(rng);
        if grid.is_clear(domain.embed(q), CLOSEST * h) {
            grid.insert(domain.embed(q));
            points.push(q);
            missing -= 1;
        }
    }
    points
}

/// Points in cells of a given size, to ask whether a place is clear.
struct Grid {
    cell: f64,
    points: Vec<[f64; 3]>,
    /// The point inserted before in the same cell.
    before: Vec<u32>,
    last: HashMap<[i32; 3], u32>,
}

impl Grid {
    fn new(cell: f64) -> Self {
        Grid {
            cell,
            points: Vec::new(),
            before: Vec::new(),
            last: HashMap::new(),
        }
    }

    fn key(&self, p: [f64; 3]) -> [i32; 3] {
        p.map(|x| (x / self.cell).floor() as i32)
    }

    fn insert(&mut self, p: [f64; 3]) {
        let old = self.last.insert(self.key(p), self.points.len() as u32);
        self.before.push(old.unwrap_or(u32::MAX));
        self.points.push(p);
    }

    /// Is there no point nearer than `radius` (at most the cell size)?
    fn is_clear(&self, p: [f64; 3], radius: f64) -> bool {
        let k = self.key(p);
        (0..27).all(|c| {
            let cell = [k[0] + c % 3 - 1, k[1] + c / 3 % 3 - 1, k[2] + c / 9 - 1];
            let mut i = self.last.get(&cell).copied().unwrap_or(u32::MAX);
            while i != u32::MAX {
                let q = self.points[i as usize];
                let d: f64 = (0..3).map(|a| (p[a] - q[a]).powi(2)).sum();
                if d < radius * radius {
                    return false;
                }
                i = self.before[i as usize];
            }
            true
        })
    }
}
