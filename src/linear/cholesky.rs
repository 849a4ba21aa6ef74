//! Sparse Cholesky factorization by dense fronts (Duff & Reid 1983), in single or double precision.
//!
//! Two threads share the work by subtrees of the elimination tree. The split is part of [`Symbolic`], so that
//! every number is computed by the same operations in the same order for any number of threads.

use std::sync::Arc;

use super::front;
use super::interrupt::is_stopped;
use super::parallel;
use super::real::Real;
use super::symbolic::{Symbolic, Task};
use super::tile::LANES;
pub use super::traversal::Passed;
use super::traversal::{Factor, Scratch};

/// A pivot that is not positive and finite.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the matrix is not positive definite at row {row}")]
pub struct NotPositiveDefinite {
    /// The row in the numbering of the matrix.
    pub row: usize,
}

/// The factor of a symmetric positive definite matrix in the precision `T`, `f32` or `f64`.
///
/// Its memory is allocated by the first factorization and reused by later ones.
#[derive(Debug)]
pub struct Cholesky<T> {
    symbolic: Arc<Symbolic>,
    panels: Vec<T>,
}

/// The update matrices of a factorization, a third of the factor's size. Factorizations one after the other share them.
#[derive(Debug)]
pub struct UpdateStacks<T>([Vec<T>; 2]);

impl<T> Default for UpdateStacks<T> {
    fn default() -> Self {
        Self([Vec::new(), Vec::new()])
    }
}

impl<T> UpdateStacks<T> {
    /// The memory in use, in bytes.
    pub fn bytes(&self) -> usize {
        size_of::<T>() * (self.0[0].len() + self.0[1].len())
    }
}

/// The vectors that a solve works in. Reuse it: its memory is allocated once.
#[derive(Debug)]
pub struct SolveWork<T> {
    ordered: Vec<T>,
    scratch: Scratch<T>,
}

impl<T> Default for SolveWork<T> {
    fn default() -> Self {
        Self {
            ordered: Vec::new(),
            scratch: Scratch::default(),
        }
    }
}

impl<T> SolveWork<T> {
    /// The memory in use, in bytes.
    pub fn bytes(&self) -> usize {
        size_of::<T>() * self.ordered.capacity() + self.scratch.bytes()
    }
}

impl<T: Real> Cholesky<T> {
    /// A factorization of matrices of this structure, without a factor yet.
    pub fn new(symbolic: Arc<Symbolic>) -> Self {
        Self {
            symbolic,
            panels: Vec::new(),
        }
    }

    /// The structure of the factor.
    pub fn symbolic(&self) -> &Arc<Symbolic> {
        &self.symbolic
    }

    /// The memory of the factor in bytes, without the structure.
    pub fn bytes(&self) -> usize {
        size_of::<T>() * self.panels.len()
    }

    /// What [`Cholesky::bytes`] will be after the first factorization.
    pub fn planned_bytes(&self) -> usize {
        size_of::<T>() * (self.symbolic.panel_size() + LANES)
    }

    /// Factors the matrix with these values, parallel to the columns of the pattern.
    ///
    /// # Errors
    /// The first row whose pivot is not positive and finite; the factor is then useless. The precision `T`
    /// matters: a nearly singular matrix may fail in `f32` alone.
    ///
    /// # Panics
    /// If the number of values is not that of the pattern.
    pub fn factor(&mut self, values: &[f64]) -> Result<(), NotPositiveDefinite> {
        self.factor_in(values, &mut UpdateStacks::default())
    }

    /// The same with the memory for update matrices at hand.
    ///
    /// # Errors
    /// As [`Cholesky::factor`].
    ///
    /// # Panics
    /// As [`Cholesky::factor`].
    pub fn factor_in(
        &mut self,
        values: &[f64],
        stacks: &mut UpdateStacks<T>,
    ) -> Result<(), NotPositiveDefinite> {
        let symbolic = &*self.symbolic;
        assert_eq!(values.len(), symbolic.input, "one value per entry of the pattern");
        allocate(&mut self.panels, symbolic.panel_size() + LANES);
        for (stack, size) in stacks.0.iter_mut().zip(symbolic.update_size) {
            if stack.len() < size {
                allocate(stack, size);
            }
        }
        let Some(root) = symbolic.tasks.len().checked_sub(1) else {
            return Ok(());
        };
        let [even, odd] = &mut stacks.0;
        let job = Job { symbolic, values };
        run(job, root, &mut self.panels, [even, odd]).map_err(|column| NotPositiveDefinite {
            row: symbolic.order[column] as usize,
        })
    }

    /// Solves `A X = B` in place for `K` right-hand sides, `x[i]` the values of row `i` of the matrix in its
    /// own numbering. Before a successful [`Cholesky::factor`] the result is meaningless.
    ///
    /// # Panics
    /// If `x` does not have one element per row, or nothing was ever factored.
    pub fn solve<const K: usize>(&self, x: &mut [[f64; K]], work: &mut SolveWork<T>) {
        let n = self.symbolic.n;
        assert_eq!(x.len(), n, "one right-hand side value per row");
        let SolveWork { ordered, scratch } = work;
        ordered.resize(n * K, T::ZERO);
        let (y, _) = ordered.as_chunks_mut::<K>();
        self.enter(x, y);
        let factor = self.checked();
        factor.forward(y, Passed::All, scratch);
        factor.backward(y, Passed::All, scratch);
        self.leave(y, x);
    }

    /// The same in the order of elimination, for right-hand sides that are zero but for the rows that `forward` passes, and
    /// solutions that are wanted only at those that `backward` passes: elsewhere they are meaningless.
    ///
    /// # Panics
    /// As [`Cholesky::solve`].
    pub fn solve_ordered<const K: usize>(
        &self,
        y: &mut [[T; K]],
        [forward, backward]: [Passed<'_>; 2],
        work: &mut SolveWork<T>,
    ) {
        assert_eq!(y.len(), self.symbolic.n, "one right-hand side value per row");
        let factor = self.checked();
        factor.forward(y, forward, &mut work.scratch);
        factor.backward(y, backward, &mut work.scratch);
    }

    /// Puts values into the order of elimination.
    pub fn enter<const K: usize>(&self, x: &[[f64; K]], y: &mut [[T; K]]) {
        for (y, &old) in y.iter_mut().zip(&self.symbolic.order) {
            *y = x[old as usize].map(T::from_f64);
        }
    }

    /// And back.
    pub fn leave<const K: usize>(&self, y: &[[T; K]], x: &mut [[f64; K]]) {
        for (y, &old) in y.iter().zip(&self.symbolic.order) {
            x[old as usize] = y.map(T::to_f64);
        }
    }

    fn checked(&self) -> Factor<'_, T> {
        let symbolic = &*self.symbolic;
        let size = symbolic.panel_size() + LANES;
        assert_eq!(self.panels.len(), size, "factor before solving");
        Factor {
            symbolic,
            panels: &self.panels,
        }
    }
}

/// Gives a vector its length, if it does not have it: with fresh zeros, so that the memory is first touched
/// where it is used.
fn allocate<T: Real>(memory: &mut Vec<T>, size: usize) {
    if memory.len() != size {
        *memory = Vec::new();
        *memory = vec![T::ZERO; size];
    }
}

/// What all tasks share.
#[derive(Clone, Copy)]
struct Job<'a> {
    symbolic: &'a Symbolic,
    values: &'a [f64],
}

/// Factors the supernodes of a task. `panels` and `updates` are the task's own parts of the memory. The
/// error is the column of the failing pivot.
fn run<T: Real>(job: Job<'_>, task: usize, panels: &mut [T], updates: [&mut [T]; 2]) -> Result<(), usize> {
    let Job { symbolic, values, .. } = job;
    let Task {
        range,
        top,
        parts,
        area,
    } = &symbolic.tasks[task];
    let [even, odd] = updates;
    if let &Some([left, right]) = parts {
        let next = &symbolic.tasks[right];
        let base = symbolic.panel_start[range.start];
        let (first, rest) = panels.split_at_mut(symbolic.panel_start[next.range.start] - base);
        let (even_left, even_right) = even.split_at_mut(next.area[0].start - area[0].start);
        let (odd_left, odd_right) = odd.split_at_mut(next.area[1].start - area[1].start);
        let (a, b) = parallel::join(
            || run(job, left, first, [even_left, odd_left]),
            || run(job, right, rest, [even_right, odd_right]),
        );
        a.and(b)?;
    }
    let base = symbolic.panel_start[range.start];
    let mut work = front::PackedRows::default();
    for s in *top..range.end {
        if is_stopped() {
            return Err(symbolic.first[s] as usize);
        }
        let panel = &mut panels[symbolic.panel_start[s] - base..symbolic.panel_start[s + 1] - base];
        let (own, below, own_base, below_base) = if symbolic.stack[s] == 0 {
            (&mut *even, &*odd, area[0].start, area[1].start)
        } else {
            (&mut *odd, &*even, area[1].start, area[0].start)
        };
        let r = symbolic.rows(s).len();
        let start = symbolic.update_start[s] - own_base;
        let update = &mut own[start..start + r * r.next_multiple_of(LANES)];
        assemble(symbolic, values, s, panel, update, below, below_base);
        let p = symbolic.columns(s).len();
        let fresh = symbolic.children(s).is_empty();
        front::eliminate(panel, p + r, p, update, fresh, &mut work)
            .map_err(|k| symbolic.first[s] as usize + k)?;
    }
    Ok(())
}

/// Sums the entries of the matrix and the children's update matrices into a front. The update matrix of a
/// front without children is not touched: the elimination overwrites it.
fn assemble<T: Real>(
    symbolic: &Symbolic,
    values: &[f64],
    s: usize,
    panel: &mut [T],
    update: &mut [T],
    below: &[T],
    below_base: usize,
) {
    panel.fill(T::ZERO);
    let entries = symbolic.entry_start[s]..symbolic.entry_start[s + 1];
    for (&t, &target) in symbolic.entry_value[entries.clone()]
        .iter()
        .zip(&symbolic.entry_target[entries])
    {
        panel[target as usize] = T::from_f64(values[t as usize]);
    }
    let children = symbolic.children(s);
    if children.is_empty() {
        return;
    }
    let (p, r) = (symbolic.columns(s).len(), symbolic.rows(s).len());
    let (m, tall) = (p + r, r.next_multiple_of(LANES));
    for j in 0..r {
        update[j * tall + j..j * tall + r].fill(T::ZERO);
    }
    for &c in children {
        let rows = symbolic.row_start[c as usize]..symbolic.row_start[c as usize + 1];
        let relative = &symbolic.relative[rows];
        let size = relative.len();
        let start = symbolic.update_start[c as usize] - below_base;
        let height = size.next_multiple_of(LANES);
        let source = &below[start..start + size * height];
        for (j, &to) in relative.iter().enumerate() {
            let column = &source[j * height + j..j * height + size];
            let to = to as usize;
            if to < p {
                let target = &mut panel[to * m..(to + 1) * m];
                for (&i, &a) in relative[j..].iter().zip(column) {
                    let target = &mut target[i as usize];
                    *target += a;
                }
            } else {
                let target = &mut update[(to - p) * tall..(to - p) * tall + r];
                for (&i, &a) in relative[j..].iter().zip(column) {
                    let target = &mut target[i as usize - p];
                    *target += a;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interrupt::Interrupt;
    use crate::ordering::{amd, landmark_coordinates, nested_dissection};
    use crate::sparse::SymmetricPattern;
    use crate::sparse::tests::{Noise, grid, laplacian};

    fn factored<T: Real>(pattern: &SymmetricPattern, order: &[u32], values: &[f64]) -> Cholesky<T> {
        let mut factor = Cholesky::new(Arc::new(Symbolic::new(pattern, order)));
        factor.factor(values).unwrap();
        factor
    }

    fn right_hand_side<const K: usize>(n: usize) -> Vec<[f64; K]> {
        let mut noise = Noise(3);
        (0..n)
            .map(|_| std::array::from_fn(|_| noise.next() - 0.5))
            .collect()
    }

    /// max |A x - b| / max |b|.
    fn residual<T: Real, const K: usize>(
        pattern: &SymmetricPattern,
        values: &[f64],
        factor: &Cholesky<T>,
    ) -> (Vec<[f64; K]>, f64) {
        let b = right_hand_side::<K>(pattern.order());
        let mut x = b.clone();
        factor.solve(&mut x, &mut SolveWork::default());
        let mut ax = b.clone();
        pattern.multiply(values, &x, &mut ax);
        let defect = ax
            .iter()
            .flatten()
            .zip(b.iter().flatten())
            .map(|(a, b)| (a - b).abs());
        (x, defect.fold(0.0, f64::max) / 0.5)
    }

    /// Pattern of the matrix, order by nested dissection.
    fn meshes() -> Vec<(SymmetricPattern, Vec<u32>)> {
        let mut all = Vec::new();
        for (side, shuffle) in [(2, false), (3, true), (12, true), (45, false), (70, true)] {
            let (graph, coords) = grid(side, shuffle);
            all.push((graph.clone(), nested_dissection(&graph, 1, &coords)));
            all.push((
                graph.square(),
                nested_dissection(&graph, 2, &landmark_coordinates(&graph)),
            ));
        }
        all
    }

    #[test]
    fn solutions_satisfy_the_system_in_every_order() {
        for (pattern, order) in meshes() {
            let values = laplacian(&pattern, 0.01);
            let natural: Vec<u32> = (0..pattern.order() as u32).collect();
            let dissected = factored::<f64>(&pattern, &order, &values);
            let (x, defect) = residual::<f64, 3>(&pattern, &values, &dissected);
            assert!(defect < 1e-11, "{defect}");
            for order in [amd(&pattern), natural] {
                let factor = factored::<f64>(&pattern, &order, &values);
                let (y, defect) = residual::<f64, 3>(&pattern, &values, &factor);
                assert!(defect < 1e-11, "{defect}");
                let scale = x.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
                for (a, b) in x.iter().flatten().zip(y.iter().flatten()) {
                    assert_near!(a, b, 1e-10 * scale);
                }
            }
        }
    }

    #[test]
    fn single_precision_keeps_six_digits_of_the_residual() {
        for (pattern, order) in meshes() {
            let values = laplacian(&pattern, 0.5);
            let factor = factored::<f32>(&pattern, &order, &values);
            let (_, defect) = residual::<f32, 1>(&pattern, &values, &factor);
            assert!(defect < 1e-4, "{defect}");
        }
    }

    #[test]
    fn one_right_hand_side_is_one_of_three() {
        let (pattern, order) = meshes().swap_remove(7);
        let values = laplacian(&pattern, 0.1);
        let factor = factored::<f64>(&pattern, &order, &values);
        let mut three = right_hand_side::<3>(pattern.order());
        let mut one: Vec<[f64; 1]> = three.iter().map(|b| [b[2]]).collect();
        factor.solve(&mut three, &mut SolveWork::default());
        factor.solve(&mut one, &mut SolveWork::default());
        assert_all!(three.iter().zip(&one), |(a, b)| a[2] == b[0]);
    }

    #[test]
    fn the_discrete_parabola_solves_the_path() {
        // -u'' = 2 with u = 0 beyond both ends: u_i = (i + 1)(n - i), exact for the second difference.
        let n = 1000;
        let edges: Vec<[u32; 2]> = (1..n).map(|i| [i - 1, i]).collect();
        let pattern = SymmetricPattern::from_edges(n as usize, &edges);
        let mut values = Vec::new();
        for i in 0..n as usize {
            values.extend(
                pattern
                    .row(i)
                    .iter()
                    .map(|&j| if j as usize == i { 2.0 } else { -1.0 }),
            );
        }
        for order in [amd(&pattern), (0..n).collect()] {
            let factor = factored::<f64>(&pattern, &order, &values);
            let mut x = vec![[2.0]; n as usize];
            factor.solve(&mut x, &mut SolveWork::default());
            for (i, [x]) in x.iter().enumerate() {
                let exact = (i + 1) as f64 * (n as usize - i) as f64;
                assert_near!(x, exact, 1e-9 * 250_000.0);
            }
        }
    }

    #[test]
    fn a_linear_field_is_harmonic_on_the_square_grid() {
        // Five-point Laplacian with the boundary values 3 + 2 c - r eliminated.
        let side = 41_i64;
        let id = |r: i64, c: i64| (r * side + c) as u32;
        let mut edges = Vec::new();
        let mut x = Vec::new();
        for r in 0..side {
            for c in 0..side {
                edges.extend((c > 0).then(|| [id(r, c - 1), id(r, c)]));
                edges.extend((r > 0).then(|| [id(r - 1, c), id(r, c)]));
                let outside = [(r - 1, c), (r + 1, c), (r, c - 1), (r, c + 1)]
                    .into_iter()
                    .filter(|(r, c)| *r < 0 || *c < 0 || *r >= side || *c >= side);
                x.push([outside.map(|(r, c)| (3 + 2 * c - r) as f64).sum::<f64>()]);
            }
        }
        let pattern = SymmetricPattern::from_edges((side * side) as usize, &edges);
        let mut values = vec![-1.0; pattern.column.len()];
        for i in 0..pattern.order() {
            values[pattern.start[i + 1] - 1] = 4.0;
        }
        let order = nested_dissection(&pattern, 1, &landmark_coordinates(&pattern));
        factored::<f64>(&pattern, &order, &values).solve(&mut x, &mut SolveWork::default());
        for r in 0..side {
            for c in 0..side {
                assert_near!(x[id(r, c) as usize][0], (3 + 2 * c - r) as f64, 1e-11);
            }
        }
    }

    #[test]
    fn the_failing_row_is_named() {
        for (pattern, order) in meshes() {
            let n = pattern.order();
            for bad in [0, n / 2, n - 1] {
                for value in [-1e6, 0.0, f64::NAN, f64::INFINITY] {
                    let mut values = laplacian(&pattern, 0.1);
                    values[pattern.start[bad + 1] - 1] = value;
                    let mut factor = Cholesky::<f64>::new(Arc::new(Symbolic::new(&pattern, &order)));
                    assert_eq!(
                        factor.factor(&values),
                        Err(NotPositiveDefinite { row: bad }),
                        "{value}"
                    );
                    // The memory of a failed factorization is as good as new.
                    let good = laplacian(&pattern, 0.1);
                    factor.factor(&good).unwrap();
                    assert!(residual::<f64, 1>(&pattern, &good, &factor).1 < 1e-11);
                }
            }
        }
    }

    #[test]
    fn an_interrupt_ends_it_and_another_one_does_not() {
        let (pattern, order) = meshes().swap_remove(4);
        let values = laplacian(&pattern, 0.5);
        let mut factor = factored::<f64>(&pattern, &order, &values);
        let interrupt = Interrupt::default();
        let before = interrupt.heed();
        assert_eq!(factor.factor(&values), Ok(()));
        interrupt.set();
        assert!(factor.factor(&values).is_err());
        before.heed();
        assert_eq!(factor.factor(&values), Ok(()));
    }

    #[test]
    fn a_sparse_right_hand_side_needs_only_what_it_reaches() {
        for (pattern, order) in meshes() {
            let n = pattern.order();
            let factor = factored::<f64>(&pattern, &order, &laplacian(&pattern, 0.01));
            let rows = || (0..n).step_by(n.div_ceil(5));
            let reach = factor.symbolic().reach(rows());
            let mut work = SolveWork::default();
            let mut x = vec![[0.0; 2]; n];
            rows().for_each(|i| x[i] = [1.0, i as f64]);
            let mut y = vec![[0.0; 2]; n];
            factor.enter(&x, &mut y);
            factor.solve(&mut x, &mut work);
            let mut part = y.clone();
            factor.solve_ordered(&mut y, [Passed::Only(&reach), Passed::All], &mut work);
            factor.solve_ordered(&mut part, [Passed::Only(&reach); 2], &mut work);
            let mut found = x.clone();
            factor.leave(&y, &mut found);
            assert_eq!(found, x);
            factor.leave(&part, &mut found);
            assert_all!(rows(), |i| found[i] == x[i]);
            assert!(n < 100 || reach.len() < factor.symbolic().supernodes());
        }
    }

    #[test]
    fn the_two_halves_of_a_large_matrix_solve_the_same_system() {
        let (graph, _) = grid(246, true);
        let values = laplacian(&graph, 0.01);
        let order = nested_dissection(&graph, 1, &landmark_coordinates(&graph));
        let factor = factored::<f64>(&graph, &order, &values);
        assert!(residual::<f64, 1>(&graph, &values, &factor).1 < 1e-11);
        let bits = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let solve = || residual::<f64, 2>(&graph, &values, &factor).0;
            pool.build().unwrap().install(solve)
        };
        assert_eq!(bits(1), bits(2));
    }

    #[test]
    fn components_are_solved_side_by_side() {
        // Three copies of a grid, and vertices without neighbours.
        let (one, _) = grid(20, true);
        let mut edges = Vec::new();
        for copy in 0..3 {
            for i in 0..400 {
                edges.extend(
                    one.row(i)
                        .iter()
                        .map(|&j| [copy * 405 + i as u32, copy * 405 + j]),
                );
            }
        }
        let graph = SymmetricPattern::from_edges(3 * 405, &edges);
        let pattern = graph.square();
        let values = laplacian(&pattern, 0.2);
        for order in [
            amd(&pattern),
            nested_dissection(&graph, 2, &landmark_coordinates(&graph)),
        ] {
            let factor = factored::<f64>(&pattern, &order, &values);
            assert!(residual::<f64, 3>(&pattern, &values, &factor).1 < 1e-11);
        }
    }

    #[test]
    fn one_unknown_and_none() {
        for n in [0, 1] {
            let pattern = SymmetricPattern::from_edges(n, &[]);
            let order = nested_dissection(&pattern, 2, &landmark_coordinates(&pattern));
            assert_eq!(order, amd(&pattern));
            let factor = factored::<f64>(&pattern, &order, &vec![4.0; n]);
            let mut x = vec![[2.0, 4.0, 8.0]; n];
            factor.solve(&mut x, &mut SolveWork::default());
            assert_eq!(x, vec![[0.5, 1.0, 2.0]; n]);
        }
    }

    #[test]
    fn the_bits_do_not_depend_on_the_number_of_threads() {
        let (graph, coords) = grid(120, true);
        let pattern = graph.square();
        let values = laplacian(&pattern, 0.01);
        let bits: Vec<Vec<u64>> = (1..=3)
            .map(|threads| {
                let pool = rayon::ThreadPoolBuilder::new()
                    .num_threads(threads)
                    .build()
                    .unwrap();
                pool.install(|| {
                    let order = nested_dissection(&graph, 2, &coords);
                    let factor = factored::<f32>(&pattern, &order, &values);
                    assert_above!(factor.symbolic().tasks.len(), 4);
                    let (x, _) = residual::<f32, 3>(&pattern, &values, &factor);
                    x.iter().flatten().map(|x| x.to_bits()).collect()
                })
            })
            .collect();
        assert_eq!(bits[0], bits[1]);
        assert_eq!(bits[0], bits[2]);
    }
}
