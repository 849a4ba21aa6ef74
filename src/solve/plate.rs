//! `P^-1` without a factor of `P`.
//!
//! `P = S_ff D_f S_ff + S_fb D_b S_bf`: the first summand is the simply supported plate, whose inverse
//! `A = S_ff^-1 D_f^-1 S_ff^-1` needs a factor of `S_ff` alone, on the one-ring graph: 2.5 to 4 times smaller than that of
//! `P`, a tenth of the operations, and well enough conditioned for 32 bits at any size. The second one has as many
//! columns as there are fixed vertices, and by Sherman, Morrison and Woodbury
//! `P^-1 = A - A S_fb C^-1 S_bf A` with [`BoundaryOperator`]'s `C`. A few preconditioned steps solve with that.

use std::sync::Arc;

use rayon::prelude::*;

use super::bilaplacian::Metric;
use super::boundary_chains::{Chain, chains};
use super::boundary_operator::{BoundaryOperator, waves};
use super::boundary_steps::{STEPS, Steps};
use super::boundary_strip::Strip;
use crate::discrete::valence_batches::CHUNK;
use crate::mesh::{Region, Rings};
use fairmesh_linear::cholesky::{Cholesky, NotPositiveDefinite, Passed, SolveWork, UpdateStacks};
use fairmesh_linear::interrupt::Interrupt;
use fairmesh_linear::sparse::SymmetricPattern;
use fairmesh_linear::symbolic::Symbolic;

/// A strip of more free vertices, and of more than a quarter of all, would be no less work than `P` itself.
const LARGEST_STRIP: usize = 50_000;
/// Vectors of the coarse space that are solved for at once.
const AT_ONCE: usize = 5;

/// The matrix `P` of one metric by a factor of `S_ff`.
#[derive(Debug)]
pub(crate) struct Plate {
    s: Cholesky<f32>,
    work: SolveWork<f32>,
    chains: Vec<Chain>,
    waves: usize,
    /// What the free neighbours of the boundary reach of the factor.
    reach: Vec<u32>,
    coupling: Coupling,
    /// `1 / D_f` in the order of elimination.
    inverse_d: Vec<f32>,
    boundary_d: Vec<f64>,
    boundary: BoundaryOperator,
    strip: Strip,
    vectors: Vec<Vec<f32>>,
}

impl Plate {
    /// Room for it; `symbolic` is that of the free one-ring graph. `None` where the boundary is in too many pieces, or too long.
    pub(crate) fn new(region: &Region, rings: &Rings, symbolic: &Arc<Symbolic>) -> Option<Self> {
        let chains = chains(region, rings);
        let waves = waves(&chains)?;
        let strip = Strip::new(rings, &chains, waves, LARGEST_STRIP.max(region.free / 4))?;
        let beside = rings.boundary_neighbour.values().iter();
        let beside = beside.map(|&j| j as usize).filter(|&j| j < region.free);
        Some(Self {
            s: Cholesky::new(symbolic.clone()),
            work: SolveWork::default(),
            reach: symbolic.reach(beside),
            strip,
            chains,
            waves,
            coupling: Coupling::default(),
            inverse_d: Vec::new(),
            boundary_d: Vec::new(),
            boundary: BoundaryOperator::default(),
            vectors: Vec::new(),
        })
    }

    /// Factorizations fail from when this is set.
    pub(crate) fn set_interrupt(&mut self, interrupt: &Interrupt) {
        self.s.heed(interrupt);
    }

    /// Takes the matrix of this metric; `pattern` is that of the free one-ring graph.
    pub(crate) fn factor(
        &mut self,
        metric: &Metric,
        rings: &Rings,
        pattern: &SymmetricPattern,
        stacks: &mut UpdateStacks<f32>,
    ) -> Result<(), NotPositiveDefinite> {
        self.s.factor_in(&metric.dirichlet(rings, pattern), stacks)?;
        let order = self.s.symbolic().permutation();
        let d = metric.free_d();
        self.inverse_d.clear();
        let inverse = order.iter().map(|&old| (1.0 / d[old as usize]) as f32);
        self.inverse_d.extend(inverse);
        self.boundary_d = metric.boundary_d().to_vec();
        self.coupling = Coupling::new(metric, rings, order);
        self.strip.factor(metric, rings)?;
        let mut boundary = BoundaryOperator::new(&self.chains, metric, self.waves);
        let basis: Vec<Vec<f64>> = boundary.basis().collect();
        let images = basis
            .chunks(AT_ONCE)
            .flat_map(|part| self.boundary_images(part))
            .collect();
        boundary.complete(images)?;
        self.boundary = boundary;
        Ok(())
    }

    /// `S_bf A S_fb v` of up to [`AT_ONCE`] vectors.
    fn boundary_images(&mut self, vectors: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let mut memory = Vec::new();
        let y = zeros::<AT_ONCE>(&mut memory, self.inverse_d.len());
        self.coupling.spread(vectors, y);
        let near = Passed::Only(&self.reach);
        self.s.solve_ordered(y, [near, Passed::All], &mut self.work);
        scale(y, &self.inverse_d);
        self.s.solve_ordered(y, [Passed::All, near], &mut self.work);
        let mut images = self.coupling.gather(y).to_vec();
        images.truncate(vectors.len());
        images
    }

    /// Solves `P x = r` in place, column by column side by side.
    pub(crate) fn solve<const K: usize>(&mut self, x: &mut [[f64; K]]) {
        let n = x.len();
        let mut free_memory = std::mem::take(&mut self.vectors);
        let mut memory = || free_memory.pop().unwrap_or_default();
        let mut vectors = vec![memory()];
        let first = zeros::<K>(&mut vectors[0], n);
        self.s.enter(x, first);
        let energy = self.supported(first);
        let rho = self.coupling.gather(first);
        let mut steps: [Steps; K] = std::array::from_fn(|c| Steps::new(energy[c], rho[c].clone()));
        while vectors.len() <= STEPS {
            let d: Vec<Vec<f64>> = (steps.iter())
                .map(|s| self.boundary.apply(&s.rest, &mut self.strip))
                .collect();
            let mut next = memory();
            let v = zeros::<K>(&mut next, n);
            self.coupling.spread(&d, v);
            self.supported_near(v);
            let w = self.coupling.gather(v);
            vectors.push(next);
            let mut is_done = true;
            for ((steps, d), w) in steps.iter_mut().zip(d).zip(w) {
                steps.add(d, w, &self.boundary_d);
                is_done &= steps.is_done(&self.boundary_d);
            }
            if is_done {
                break;
            }
        }
        sum_up(&mut vectors, &steps.each_ref().map(|s| &*s.coefficients));
        self.s.leave(vectors[0].as_chunks::<K>().0, x);
        // Three columns are solved for at the start only.
        if K == 1 {
            free_memory.append(&mut vectors);
            self.vectors = free_memory;
        }
    }

    /// `y = A y`. Returns `y . A y`.
    fn supported<const K: usize>(&mut self, y: &mut [[f32; K]]) -> [f64; K] {
        self.s.solve_ordered(y, [Passed::All; 2], &mut self.work);
        let energy = scale(y, &self.inverse_d);
        self.s.solve_ordered(y, [Passed::All; 2], &mut self.work);
        energy
    }

    /// `y = A y` where `y` is zero but for the neighbours of the boundary.
    fn supported_near<const K: usize>(&mut self, y: &mut [[f32; K]]) {
        let near = Passed::Only(&self.reach);
        self.s.solve_ordered(y, [near, Passed::All], &mut self.work);
        scale(y, &self.inverse_d);
        self.s.solve_ordered(y, [Passed::All; 2], &mut self.work);
    }
}

/// `n` vectors of `K` zeros.
fn zeros<const K: usize>(memory: &mut Vec<f32>, n: usize) -> &mut [[f32; K]] {
    memory.clear();
    memory.resize(n * K, 0.0);
    memory.as_chunks_mut().0
}

/// `y = D^-1 y`. Returns `y . D^-1 y`.
fn scale<const K: usize>(y: &mut [[f32; K]], inverse_d: &[f32]) -> [f64; K] {
    let chunks = y.par_chunks_mut(CHUNK).zip(inverse_d.par_chunks(CHUNK));
    let scaled = chunks.map(|(y, d)| {
        let mut sum = [0.0; K];
        for (y, d) in y.iter_mut().zip(d) {
            for c in 0..K {
                let before = y[c];
                y[c] *= d;
                sum[c] += f64::from(before) * f64::from(y[c]);
            }
        }
        sum
    });
    let sums: Vec<[f64; K]> = scaled.collect();
    let mut total = [0.0; K];
    for sum in sums {
        for c in 0..K {
            total[c] += sum[c];
        }
    }
    total
}

/// Puts the sum of the vectors times their coefficients in place of the first.
fn sum_up<const K: usize>(vectors: &mut [Vec<f32>], coefficients: &[&[f64]; K]) {
    let Some((first, others)) = vectors.split_first_mut() else {
        return;
    };
    let chunks = first.as_chunks_mut::<K>().0.par_chunks_mut(CHUNK).enumerate();
    chunks.for_each(|(chunk, first)| {
        let begin = chunk * CHUNK;
        for y in first.iter_mut() {
            for c in 0..K {
                y[c] *= coefficients[c][0] as f32;
            }
        }
        for (k, other) in others.iter().enumerate() {
            let other = &other.as_chunks::<K>().0[begin..];
            for (y, v) in first.iter_mut().zip(other) {
                for c in 0..K {
                    y[c] += coefficients[c][k + 1] as f32 * v[c];
                }
            }
        }
    });
}

/// The entries of `S_bf`, row by row: free neighbours in the order of elimination.
#[derive(Debug, Default)]
struct Coupling {
    start: Vec<usize>,
    neighbour: Vec<u32>,
    weight: Vec<f64>,
}

impl Coupling {
    fn new(metric: &Metric, rings: &Rings, order: &[u32]) -> Self {
        let mut place = vec![0_u32; order.len()];
        for (new, &old) in (0..).zip(order) {
            place[old as usize] = new;
        }
        let mut this = Self {
            start: vec![0],
            ..Self::default()
        };
        for b in 0..rings.boundary() {
            for (j, w) in metric.boundary_row(rings, b) {
                this.neighbour.push(place[j]);
                this.weight.push(-w);
            }
            this.start.push(this.neighbour.len());
        }
        this
    }

    fn row(&self, b: usize) -> impl Iterator<Item = (usize, f64)> {
        let range = self.start[b]..self.start[b + 1];
        let neighbours = self.neighbour[range.clone()].iter().map(|&j| j as usize);
        neighbours.zip(self.weight[range].iter().copied())
    }

    /// `S_bf y`, column by column.
    fn gather<const K: usize>(&self, y: &[[f32; K]]) -> [Vec<f64>; K] {
        let rows = 0..self.start.len() - 1;
        std::array::from_fn(|c| {
            let product = |b| self.row(b).map(|(j, w)| w * f64::from(y[j][c])).sum();
            rows.clone().map(product).collect()
        })
    }

    /// `y = S_fb d`, from zeros.
    fn spread<const K: usize>(&self, d: &[Vec<f64>], y: &mut [[f32; K]]) {
        for (c, d) in d.iter().enumerate() {
            for (b, d) in d.iter().enumerate() {
                for (j, w) in self.row(b) {
                    y[j][c] += (w * d) as f32;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use nalgebra::Vector3;

    use super::{Chain, chains, waves};
    use crate::discrete::curvature::TILT_RIDGE;
    use crate::discrete::equations::FreeCurvature;
    use crate::discrete::inner_fairness::FairnessWeights;
    use crate::discrete::target::RightHandSide;
    use crate::mesh::{Region, Selection};
    use crate::solve::ladder::{Ladder, Step};
    use crate::solve::normal_matrix::Means;
    use crate::solve::{Control, Domain, Problem, SolveStatus, System};
    use fairmesh_shapes::{Sampling, Shape, cylinder_band, sphere_cap};

    /// The neighbour after neighbour nearest to `to`, from the vertex nearest to `from`.
    fn path(shape: &Shape, from: [f64; 2], to: [f64; 2]) -> Vec<usize> {
        let at = |v: usize| [shape.positions[v][0], shape.positions[v][1]];
        let distance = |v: usize, p: [f64; 2]| (at(v)[0] - p[0]).hypot(at(v)[1] - p[1]);
        let all = 0..shape.positions.len();
        let nearest = |p| {
            all.clone()
                .min_by(|&a, &b| distance(a, p).total_cmp(&distance(b, p)))
        };
        let (mut here, end) = (nearest(from).unwrap(), nearest(to).unwrap());
        let mut path = vec![here];
        while here != end {
            let around = shape.triangles.iter().filter(|t| t.contains(&(here as u32)));
            let ring = around.flatten().map(|&v| v as usize);
            let next = ring.min_by(|&a, &b| distance(a, to).total_cmp(&distance(b, to)));
            here = next.unwrap();
            path.push(here);
        }
        path
    }

    /// A shape, and which of its fixed vertices inside have given normals.
    type Case = (&'static str, Shape, Vec<usize>);

    fn fix(mut shape: Shape, fixed: &[usize]) -> Shape {
        fixed.iter().for_each(|&v| shape.free[v] = false);
        shape
    }

    /// One and two loops, holes, single fixed vertices, an open and a closed curve of fixed vertices; those with given normals,
    /// so that they are cut, or without.
    fn cases() -> Vec<Case> {
        let sampling = Sampling::Irregular { seed: 3 };
        let cap = sphere_cap(60.0, 1500, sampling, 3);
        let within = |c: [f64; 2], r: f64| -> Vec<usize> {
            let places = cap.positions.iter().enumerate();
            let inside = places.filter(|(_, p)| (p[0] - c[0]).hypot(p[1] - c[1]) < r);
            inside.map(|(v, _)| v).collect()
        };
        let curve = path(&cap, [-0.4, -0.1], [0.3, 0.2]);
        let corners = [[-0.3, -0.3], [0.3, -0.2], [0.0, 0.4], [-0.3, -0.3]];
        let ring: Vec<usize> = corners.windows(2).flat_map(|w| path(&cap, w[0], w[1])).collect();
        let centres = [-0.4, -0.1, 0.2].map(|a| [-0.3, 0.1, 0.4].map(|b| [a, b]));
        let holes: Vec<usize> = centres.iter().flatten().flat_map(|c| within(*c, 0.08)).collect();
        let points: Vec<usize> = (3..cap.positions.len()).step_by(97).collect();
        vec![
            ("one loop", cap.clone(), vec![]),
            ("two loops", cylinder_band(1500, sampling, 3), vec![]),
            ("lattice", cylinder_band(1500, Sampling::Regular, 3), vec![]),
            ("hole", fix(cap.clone(), &within([0.2, 0.1], 0.25)), vec![]),
            ("many holes", fix(cap.clone(), &holes), vec![]),
            ("points", fix(cap.clone(), &points), vec![]),
            ("open curve", fix(cap.clone(), &curve), vec![]),
            ("closed curve", fix(cap.clone(), &ring), vec![]),
            ("open cut", fix(cap.clone(), &curve), curve),
            ("closed cut", fix(cap.clone(), &ring), ring),
        ]
    }

    /// Calls with the problem of a case.
    fn with_problem<R>((_, shape, given): &Case, call: impl FnOnce(&Problem<'_>) -> R) -> R {
        let positions = shape.flat();
        let prescribed = |v: u32| given.contains(&(v as usize));
        let selection = Selection::Mask(&shape.free);
        let region = Region::with_normals(&positions, &shape.triangles, selection, prescribed).unwrap();
        let x = region.positions(&positions);
        let domain = Arc::new(Domain::new(region, x));
        let (region, free) = (&domain.region, domain.region.free);
        let fixed = region.vertex_ids[free..region.region_vertices()].iter();
        let surface = shape.surface.as_ref().unwrap();
        let normal = |&v: &u32| Vector3::from(surface.normal(shape.positions[v as usize]));
        let closed = domain.rings.closed.iter();
        call(&Problem {
            domain: &domain,
            boundary_normals: &fixed.clone().map(normal).collect::<Vec<_>>(),
            smooth_interior: &fixed
                .zip(closed)
                .map(|(v, c)| *c && !prescribed(*v))
                .collect::<Vec<_>>(),
            weights: &Arc::new(FairnessWeights::uniform()),
            weigh: None,
            curvature: FreeCurvature::GradientCorrected {
                tilt_ridge: TILT_RIDGE,
            },
            right_hand_side: RightHandSide::default(),
        })
    }

    /// `P` on the metric of connectivity, or at the surface.
    fn system(problem: &Problem<'_>, means: Means, on_surface: bool) -> System {
        let domain = problem.domain;
        let mut system = System::by_means(problem, means);
        if on_surface {
            system.evaluate(domain.surface());
            system.rebuild(domain.surface(), true, None).unwrap();
        } else {
            let mut metric = std::mem::take(&mut system.metric);
            metric.combinatorial(&domain.rings, &domain.batches, problem.weights);
            system.metric = metric;
            system.refactor(None).unwrap();
        }
        assert_eq!(system.varies(), means == Means::Plate);
        system
    }

    /// A smooth, a rough and a local right-hand side.
    fn right_hand_sides(system: &System) -> Vec<[f64; 3]> {
        let surface = system.domain.surface();
        let of = |(i, p): (usize, &Vector3<f64>)| {
            let noise = (i as u32).wrapping_mul(2_654_435_761) as f64 / f64::from(u32::MAX) - 0.5;
            [
                (3.0 * p.x + p.y).sin(),
                noise,
                f64::from(u8::from(i == system.free() / 3)),
            ]
        };
        surface[..system.free()].iter().enumerate().map(of).collect()
    }

    /// The energies `x . P x`, column by column.
    fn energies(system: &System, x: &[[f64; 3]]) -> [f64; 3] {
        let mut full = vec![[0.0; 3]; system.region().region_vertices()];
        full[..x.len()].copy_from_slice(x);
        let (mut scratch, mut image) = (full.clone(), x.to_vec());
        let rings = &system.domain.rings;
        system.metric.apply(rings, &full, None, &mut scratch, &mut image);
        std::array::from_fn(|c| x.iter().zip(&image).map(|(x, y)| x[c] * y[c]).sum())
    }

    /// The largest error of a solve in the norm of the energy, relative.
    fn error(case: &Case, on_surface: bool) -> f64 {
        with_problem(case, |problem| {
            let mut exact = system(problem, Means::Factor, on_surface);
            let mut plate = system(problem, Means::Plate, on_surface);
            let mut x = right_hand_sides(&exact);
            let mut y = x.clone();
            exact.solve_p(&mut x);
            plate.solve_p(&mut y);
            let whole = energies(&exact, &x);
            for (y, x) in y.iter_mut().zip(&x) {
                *y = std::array::from_fn(|c| y[c] - x[c]);
            }
            let error = energies(&exact, &y);
            (0..3).fold(0.0, |m: f64, c| m.max((error[c] / whole[c]).sqrt()))
        })
    }

    #[test]
    fn solves_as_a_factor_of_p_does() {
        for case in cases() {
            for on_surface in [false, true] {
                let error = error(&case, on_surface);
                assert!(error < 0.03, "{} {on_surface} {error}", case.0);
            }
        }
    }

    #[test]
    fn a_strip_over_all_the_region_leaves_nothing_to_the_steps() {
        let sampling = Sampling::Irregular { seed: 5 };
        for shape in [sphere_cap(60.0, 80, sampling, 3), cylinder_band(120, sampling, 3)] {
            for on_surface in [false, true] {
                let error = error(&("all", shape.clone(), vec![]), on_surface);
                assert!(error < 1e-4, "{on_surface} {error}");
            }
        }
    }

    #[test]
    fn each_fixed_vertex_stands_in_one_chain() {
        let loops = [1, 2, 2, 2, 9, 1, 1, 1, 2];
        for (case, loops) in cases().iter().zip(loops) {
            let (chains, boundary) = with_problem(case, |p| {
                let region = &p.domain.region;
                (chains(region, &p.domain.rings), region.boundary as u32)
            });
            let found = chains.iter().filter(|c| c.is_closed && !c.is_two_sided);
            assert_eq!(found.count(), loops, "{}", case.0);
            let mut all: Vec<u32> = chains.iter().flat_map(|c| c.vertices.clone()).collect();
            all.sort_unstable();
            assert!(all.iter().copied().eq(0..boundary), "{}", case.0);
            let longest = chains
                .iter()
                .filter(|c| c.is_two_sided)
                .map(|c| c.vertices.len())
                .max();
            let is_open = chains
                .iter()
                .any(|c| c.is_two_sided && !c.is_closed && c.vertices.len() > 1);
            match case.0 {
                "open curve" => assert!(longest > Some(10) && is_open),
                "closed curve" => assert!(longest > Some(30)),
                // One of them is an island.
                "many holes" => {}
                _ => assert!(!is_open && longest <= Some(1)),
            }
        }
    }

    #[test]
    fn a_boundary_in_hundreds_of_pieces_is_left_to_the_factor() {
        let chain = |length| Chain {
            vertices: (0..length).collect(),
            is_closed: true,
            is_two_sided: false,
        };
        assert_eq!(waves(&vec![chain(100); 3]), Some(15));
        assert_eq!(waves(&vec![chain(100); 30]), Some(7));
        assert_eq!(waves(&vec![chain(1); 256]), Some(15));
        assert_eq!(waves(&vec![chain(1); 257]), None);
        let mut shape = cases().swap_remove(0).1;
        (0..shape.free.len())
            .step_by(4)
            .for_each(|v| shape.free[v] = false);
        with_problem(&("pieces", shape, vec![]), |problem| {
            let mut system = System::by_means(problem, Means::Plate);
            assert!(system.linear_surface(&mut Control::new(1e-9, 100, None)).is_ok());
            assert!(!system.varies());
        });
    }

    /// Pseudo-time adds to the diagonal, which the plate cannot do.
    #[test]
    fn with_mass_a_factor_takes_its_place() {
        with_problem(&cases()[0], |problem| {
            let [mut factor, mut plate] = [Means::Factor, Means::Plate].map(|m| system(problem, m, true));
            let mass: Vec<f64> = (0..plate.free()).map(|i| 1.0 + i as f64).collect();
            factor.refactor(Some(&mass)).unwrap();
            plate.refactor(Some(&mass)).unwrap();
            assert!(!plate.varies());
            let mut x = right_hand_sides(&plate);
            let mut y = x.clone();
            factor.solve_p(&mut x);
            plate.solve_p(&mut y);
            assert_eq!(x, y);
            plate.refactor(None).unwrap();
            assert!(plate.varies());
        });
    }

    #[test]
    fn one_column_is_one_of_three() {
        with_problem(&cases()[6], |problem| {
            let mut plate = system(problem, Means::Plate, true);
            let mut three = right_hand_sides(&plate);
            let mut one = three.iter().map(|r| [r[1]]).collect::<Vec<_>>();
            three.iter_mut().for_each(|r| *r = [r[1]; 3]);
            plate.solve_p(&mut three);
            let mut again = one.clone();
            plate.solve_p(&mut one);
            assert!(three.iter().zip(&one).all(|(a, b)| *a == [b[0]; 3]));
            plate.solve_p(&mut again);
            assert_eq!(one, again);
        });
    }

    /// The surface and the iterations of a whole solve.
    fn faired(problem: &Problem<'_>, means: Means) -> (Vec<Vector3<f64>>, usize) {
        let mut control = Control::new(1e-9, 100, None);
        let mut system = System::by_means(problem, means);
        let mut ladder = Ladder::default();
        loop {
            match ladder.advance(&mut system, &mut control).unwrap() {
                Step::Iterated => {}
                Step::Ended(result) => {
                    assert_eq!(result.status, SolveStatus::Converged);
                    return (result.x, result.iterations);
                }
                Step::Unmoved => unreachable!("nothing stops it"),
            }
        }
    }

    #[test]
    fn whole_solves_end_where_those_with_a_factor_do() {
        for case in cases() {
            let (far, before, after) = with_problem(&case, |problem| {
                let (x, before) = faired(problem, Means::Factor);
                let (y, after) = faired(problem, Means::Plate);
                let far = x.iter().zip(&y).map(|(x, y)| (x - y).norm());
                (far.fold(0.0, f64::max), before, after)
            });
            assert!(
                far < 1e-9 && after <= before + 1,
                "{}: {far} {before} {after}",
                case.0
            );
        }
    }
}
