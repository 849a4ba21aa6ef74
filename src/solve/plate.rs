//! `P^-1` without a factor of `P`.
//!
//! `P = S_ff D_f S_ff + S_fb D_b S_bf`: the first summand is the simply supported plate, whose inverse
//! `A = S_ff^-1 D_f^-1 S_ff^-1` needs a factor of `S_ff` alone, on the one-ring graph: 2.5 to 4 times smaller than that of
//! `P`, a tenth of the operations, and well enough conditioned for 32 bits at any size. The second one has as many
//! columns as there are fixed vertices, and by Sherman, Morrison and Woodbury
//! `P^-1 = A - A S_fb C^-1 S_bf A` with `C = D_b^-1 + S_bf A S_fb`. Richardson's steps with the operator of a
//! [`GradedPlate`] solve with `C`: always as many, so that a solve is linear in its right-hand side, which acceleration counts
//! on.
//!
//! Of a wave of length `l` edges along the boundary, `A` is about `l` times as large as `P^-1`: what is wrong in `C^-1` is so
//! many times larger in the result. An operator that knows a few rows beside the boundary alone is not enough.

use std::sync::Arc;

use nalgebra::Vector3;

use super::bilaplacian::Metric;
use super::factor::Collapsed;
use super::graded_plate::GradedPlate;
use crate::discrete::valence_batches::CHUNK;
use crate::mesh::graded::GradedMesh;
use crate::mesh::{RegionMesh, Rings};
use crate::support::profile::clock;
use fairmesh_linear::cholesky::{Cholesky, Passed, SolveWork, UpdateStacks};
use fairmesh_linear::parallel;
use fairmesh_linear::sparse::SymmetricPattern;
use fairmesh_linear::symbolic::Symbolic;

/// Steps on the boundary.
/// Of 2 cases, half: 2 change by up to 8e-6 edges; double: 2 change by up to 1e-5 edges.
const STEPS: usize = 2;
/// Graded meshes of a larger part of the free vertices save nothing.
/// Of 2 cases, half: 2 change by up to 8e-6 edges; double: 1 changes by up to 6e-12 edges, -4 % iterations.
const LARGEST_PART: f64 = 0.4;
/// The part of an error on the boundary that a step may leave, as square roots of energies.
/// Of 2 cases, half: 1 changes by up to 8e-6 edges; double: 1 changes by up to 0.3 edges, -1 % iterations.
const LEFT: f64 = 0.5;
/// Steps that find out.
/// Of 2 cases, half: none changes; double: 1 changes by up to 8e-6 edges.
const TRIAL: usize = 3;

/// The matrix `P` of one metric by a factor of `S_ff`.
#[derive(Debug)]
pub(crate) struct Plate {
    s: Cholesky<f32>,
    work: SolveWork<f32>,
    /// What the free neighbours of the boundary reach of the factor.
    reach: Vec<u32>,
    coupling: Coupling,
    /// `1 / D_f` in the order of elimination.
    inverse_d: Vec<f32>,
    boundary_d: Vec<f64>,
    graded: GradedPlate,
    vectors: [Vec<f32>; 2],
}

impl Plate {
    /// The graded mesh for the plate of a region, unless it would have hardly fewer vertices.
    pub(crate) fn mesh(region: &RegionMesh, rings: &Rings) -> Option<GradedMesh> {
        let mesh = GradedMesh::new(region, rings);
        (mesh.free() as f64 <= LARGEST_PART * region.free as f64).then_some(mesh)
    }

    /// Room for it; `symbolic` is that of the free one-ring graph.
    pub(crate) fn new(mesh: GradedMesh, rings: &Rings, symbolic: &Arc<Symbolic>) -> Self {
        let beside = rings.boundary_neighbour.values().iter();
        let beside = beside.map(|&j| j as usize).filter(|&j| j < rings.free());
        Self {
            s: Cholesky::new(symbolic.clone()),
            work: SolveWork::default(),
            reach: symbolic.reach(beside),
            coupling: Coupling::default(),
            inverse_d: Vec::new(),
            boundary_d: Vec::new(),
            graded: GradedPlate::new(mesh),
            vectors: Default::default(),
        }
    }

    /// Takes the matrix of this metric, that of the surface `x` or of connectivity; `pattern` is that of the free
    /// one-ring graph. Fails, too, where steps on the boundary gain too little.
    pub(crate) fn factor(
        &mut self,
        metric: &Metric,
        rings: &Rings,
        x: Option<&[Vector3<f64>]>,
        pattern: &SymmetricPattern,
        stacks: &mut UpdateStacks<f32>,
    ) -> Result<(), Collapsed> {
        let _clock = clock("factor P");
        self.s
            .factor_in(&metric.dirichlet(rings, pattern), stacks)
            .map_err(|_| Collapsed)?;
        let order = self.s.symbolic().permutation();
        let d = metric.free_d();
        self.inverse_d.clear();
        let inverse = order.iter().map(|&old| (1.0 / d[old as usize]) as f32);
        self.inverse_d.extend(inverse);
        self.boundary_d = metric.boundary_d().to_vec();
        self.coupling = Coupling::new(metric, rings, order);
        self.graded.factor(metric, rings, x).map_err(|_| Collapsed)?;
        if self.gains() { Ok(()) } else { Err(Collapsed) }
    }

    /// Whether steps on the boundary take enough of an error away that is as large everywhere.
    fn gains(&mut self) -> bool {
        let signs = (0..).map(|k: u32| {
            if k.count_ones().is_multiple_of(2) {
                1.0
            } else {
                -1.0
            }
        });
        let of = |(d, sign): (&f64, f64)| sign / d.sqrt();
        let mut rest = [self.boundary_d.iter().zip(signs).map(of).collect::<Vec<f64>>()];
        let mut memory = Vec::new();
        let z = zeros::<1>(&mut memory, self.inverse_d.len());
        for _ in 0..TRIAL {
            let d = rest.each_ref().map(|r| self.graded.solve(r));
            self.step(&d, &mut rest, z);
        }
        let left: f64 = rest[0].iter().zip(&self.boundary_d).map(|(r, d)| r * r * d).sum();
        left <= LEFT.powi(2 * TRIAL as i32) * self.boundary_d.len() as f64
    }

    /// `rest = rest - C d`; `z` is scratch.
    fn step<const K: usize>(&mut self, d: &[Vec<f64>; K], rest: &mut [Vec<f64>; K], z: &mut [[f32; K]]) {
        let near = Passed::Only(&self.reach);
        self.coupling.spread(d, z);
        self.s.solve_ordered(z, [near, Passed::All], &mut self.work);
        scale(z, &self.inverse_d);
        self.s.solve_ordered(z, [Passed::All, near], &mut self.work);
        let images = self.coupling.gather(z);
        for ((rest, d), image) in rest.iter_mut().zip(d).zip(images) {
            for (b, rest) in rest.iter_mut().enumerate() {
                *rest -= d[b] / self.boundary_d[b] + image[b];
            }
        }
    }

    /// Solves `P x = r` in place, column by column side by side.
    pub(crate) fn solve<const K: usize>(&mut self, x: &mut [[f64; K]]) {
        let mut vectors = std::mem::take(&mut self.vectors);
        let [y, z] = &mut vectors;
        let (y, z) = (zeros::<K>(y, x.len()), zeros::<K>(z, x.len()));
        self.s.enter(x, y);
        self.s.solve_ordered(y, [Passed::All; 2], &mut self.work);
        z.copy_from_slice(y);
        scale(z, &self.inverse_d);
        let near = [Passed::All, Passed::Only(&self.reach)];
        self.s.solve_ordered(z, near, &mut self.work);
        let mut rest = self.coupling.gather(z);
        let mut d = rest.each_ref().map(|r| self.graded.solve(r));
        let mut sum = d.clone();
        for _ in 1..STEPS {
            self.step(&d, &mut rest, z);
            d = rest.each_ref().map(|r| self.graded.solve(r));
            for (sum, d) in sum.iter_mut().flatten().zip(d.iter().flatten()) {
                *sum += d;
            }
        }
        self.coupling.spread(&sum, z);
        let near = [Passed::Only(&self.reach), Passed::All];
        self.s.solve_ordered(z, near, &mut self.work);
        subtract(y, z);
        scale(y, &self.inverse_d);
        self.s.solve_ordered(y, [Passed::All; 2], &mut self.work);
        self.s.leave(y, x);
        // Three columns are solved for at the start only.
        if K == 1 {
            self.vectors = vectors;
        }
    }
}

/// `n` vectors of `K` zeros.
fn zeros<const K: usize>(memory: &mut Vec<f32>, n: usize) -> &mut [[f32; K]] {
    memory.clear();
    memory.resize(n * K, 0.0);
    memory.as_chunks_mut().0
}

/// `y = D^-1 y`.
fn scale<const K: usize>(y: &mut [[f32; K]], inverse_d: &[f32]) {
    let chunks = y.chunks_mut(CHUNK).zip(inverse_d.chunks(CHUNK));
    parallel::for_each(chunks, |_, (y, d)| {
        for (y, d) in y.iter_mut().zip(d) {
            y.iter_mut().for_each(|y| *y *= d);
        }
    });
}

/// `y = y - z`.
fn subtract<const K: usize>(y: &mut [[f32; K]], z: &[[f32; K]]) {
    let chunks = y.chunks_mut(CHUNK).zip(z.chunks(CHUNK));
    parallel::for_each(chunks, |_, (y, z)| {
        for (y, z) in y.iter_mut().zip(z) {
            y.iter_mut().zip(z).for_each(|(y, z)| *y -= z);
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

    /// `y = S_fb d`.
    fn spread<const K: usize>(&self, d: &[Vec<f64>; K], y: &mut [[f32; K]]) {
        y.fill([0.0; K]);
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

    use crate::discrete::equations::FreeCurvature;
    use crate::discrete::inner_fairness::FairnessWeights;
    use crate::discrete::target::RightHandSide;
    use crate::mesh::{RegionMesh, Selection};
    use crate::solve::ladder::{Ladder, LadderState};
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
    fn cases(free: usize) -> Vec<Case> {
        let sampling = Sampling::Irregular { seed: 3 };
        let cap = sphere_cap(60.0, free, sampling, 3);
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
            ("two loops", cylinder_band(free, sampling, 3), vec![]),
            ("lattice", cylinder_band(free, Sampling::Regular, 3), vec![]),
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
        let region = RegionMesh::with_normals(&positions, &shape.triangles, selection, prescribed).unwrap();
        let x = region.positions(&positions);
        let domain = Arc::new(Domain::new(region, x));
        let (region, free) = (&domain.region, domain.region.free);
        let fixed = region.vertex_ids[free..region.region_vertices()].iter();
        let surface = shape.surface.as_ref().unwrap();
        let normal = |&v: &u32| Vector3::from(surface.normal(shape.positions[v as usize]));
        let closed = domain.rings.closed.iter();
        call(&Problem {
            continuity: None,
            domain: &domain,
            boundary_normals: &fixed.clone().map(normal).collect::<Vec<_>>(),
            smooth_interior: &fixed
                .zip(closed)
                .map(|(v, c)| *c && !prescribed(*v))
                .collect::<Vec<_>>(),
            weights: &Arc::new(FairnessWeights::uniform()),
            weigh: None,
            curvature: FreeCurvature::GradientCorrected,
            right_hand_side: RightHandSide::default(),
        })
    }

    /// `P` on the metric of connectivity, or at the surface.
    fn system(problem: &Problem<'_>, means: Means, on_surface: bool) -> System {
        let domain = problem.domain;
        let mut system = System::by_means(problem, means);
        if on_surface {
            let asked = system.asked().clone();
            system.rebuild(domain.surface(), &asked).unwrap();
        } else {
            let mut metric = std::mem::take(&mut system.metric);
            metric.combinatorial(&domain.rings, &domain.batches, problem.weights);
            system.metric = metric;
            system.refactor().unwrap();
        }
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
        let mut count = 0;
        for case in cases(4000) {
            // Where there are many pieces of boundary the factor is used.
            let is_by_plate = with_problem(&case, |p| system(p, Means::Plate, false).is_by_plate());
            count += usize::from(is_by_plate);
            for on_surface in [false, true] {
                let error = error(&case, on_surface);
                assert!(error < 0.1, "{} {on_surface} {error}", case.0);
            }
        }
        assert!(count >= 8, "{count}");
    }

    #[test]
    fn errors_do_not_grow_with_the_number_of_vertices() {
        let errors = [3000, 12_000].map(|free| {
            let shape = sphere_cap(60.0, free, Sampling::Irregular { seed: 5 }, 3);
            error(&("larger", shape, vec![]), true)
        });
        assert!(errors.iter().all(|&e| e < 0.1), "{errors:?}");
    }

    /// Both are linear in the right-hand side, to the rounding of 32 bits.
    #[test]
    fn a_solve_is_linear_and_symmetric() {
        with_problem(&cases(3000)[3], |problem| {
            let mut plate = system(problem, Means::Plate, true);
            let r = right_hand_sides(&plate);
            let mut x = r.clone();
            plate.solve_p(&mut x);
            let mut sum: Vec<[f64; 1]> = r.iter().map(|r| [r[0] - 3.0 * r[1]]).collect();
            plate.solve_p(&mut sum);
            let size = x
                .iter()
                .map(|x| x[0].abs() + 3.0 * x[1].abs())
                .fold(0.0, f64::max);
            for (x, sum) in x.iter().zip(&sum) {
                assert_near!(x[0] - 3.0 * x[1], sum[0], 1e-4 * size);
            }
            let product = |a: usize, b: usize| x.iter().zip(&r).map(|(x, r)| x[a] * r[b]).sum::<f64>();
            let [ab, ba, aa, bb] = [product(0, 1), product(1, 0), product(0, 0), product(1, 1)];
            assert!((ab - ba).abs() < 1e-4 * (aa * bb).sqrt(), "{ab} {ba}");
        });
    }

    /// Where a large part of the vertices is fixed, the graded mesh would be nearly all.
    #[test]
    fn a_boundary_in_hundreds_of_pieces_is_left_to_the_factor() {
        let mut shape = cases(3000).swap_remove(0).1;
        (0..shape.free.len())
            .step_by(4)
            .for_each(|v| shape.free[v] = false);
        with_problem(&("pieces", shape, vec![]), |problem| {
            let mut system = System::by_means(problem, Means::Plate);
            let asked = system.asked().clone();
            let mut control = Control::new(1e-9, 100, None);
            assert!(system.linear_surface(&asked, &mut control).is_ok());
            assert!(!system.is_by_plate());
        });
    }

    #[test]
    fn one_column_is_one_of_three() {
        with_problem(&cases(3000)[6], |problem| {
            let mut plate = system(problem, Means::Plate, true);
            let mut three = right_hand_sides(&plate);
            let mut one = three.iter().map(|r| [r[1]]).collect::<Vec<_>>();
            three.iter_mut().for_each(|r| *r = [r[1]; 3]);
            plate.solve_p(&mut three);
            let mut again = one.clone();
            plate.solve_p(&mut one);
            assert_all!(three.iter().zip(&one), |(a, b)| *a == [b[0]; 3]);
            plate.solve_p(&mut again);
            assert_eq!(one, again);
        });
    }

    /// The surface and the iterations of a whole solve.
    fn faired(problem: &Problem<'_>, means: Means) -> (Vec<Vector3<f64>>, usize) {
        let mut control = Control::new(1e-9, 100, None);
        let mut system = System::by_means(problem, means);
        let Ok(LadderState::Ended(result)) = Ladder::default().run(&mut system, &mut control) else {
            panic!("nothing stops it");
        };
        assert_eq!(result.status, SolveStatus::Converged);
        (result.x, result.iterations)
    }

    #[test]
    fn whole_solves_end_where_those_with_a_factor_do() {
        for case in cases(3000) {
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
