//! Anderson acceleration of fixed-point iterations (Anderson 1965; type II of Fang & Saad 2009).

use crate::dispatch::vectorized;
use crate::parallel;

/// The longest window.
pub const MAX_WINDOW: usize = 16;

/// Vectors are worked on in blocks of this length, whose sums are added in order: the result does not depend
/// on the number of threads.
/// Of 125 cases, half: 65 change by up to 7e-6 edges; double: 21 change by up to 0.2 edges.
const BLOCK: usize = 2048;
/// Partial sums of a dot product within a block.
const LANES: usize = 8;
/// A difference whose part off the span of the newer ones is smaller than this, in squared norms, is left out.
/// Of 125 cases, half: 1 changes by up to 3e-16 edges; double: none changes.
const INDEPENDENT: f64 = 1e-12;

/// The last differences of the iterates `x` and of the steps `f(x) = g(x) - x` of a fixed-point iteration,
/// and the linear combination of them that leaves the smallest step.
///
/// Differences are kept in single precision: they only say in which directions to go, and are most of the memory.
#[derive(Debug, Clone)]
pub struct Anderson {
    window: usize,
    n: usize,
    /// The last f.
    last: Vec<f64>,
    /// Block after block: the differences of f, the differences of g = x + f.
    history: Vec<f32>,
    /// Block after block: the products of the differences of f with the newest one and with f.
    partial: Vec<[[f64; 2]; MAX_WINDOW]>,
    /// Products of the differences of f with each other, by slot.
    gram: [[f64; MAX_WINDOW]; MAX_WINDOW],
    /// The number of differences in use.
    count: usize,
    /// The slot of the newest difference.
    newest: usize,
    started: bool,
}

impl Anderson {
    /// No history yet, for vectors of length `n` and at most `window` differences; with a window of 0 steps are left as they
    /// are.
    ///
    /// # Panics
    /// If `window` is larger than [`MAX_WINDOW`].
    pub fn new(n: usize, window: usize) -> Self {
        assert!(window <= MAX_WINDOW, "at most {MAX_WINDOW} differences");
        let blocks = if window == 0 { 0 } else { n.div_ceil(BLOCK) };
        Self {
            window,
            n,
            last: vec![0.0; if window == 0 { 0 } else { n }],
            history: vec![0.0; blocks * 2 * window * BLOCK],
            partial: vec![[[0.0; 2]; MAX_WINDOW]; blocks],
            gram: [[0.0; MAX_WINDOW]; MAX_WINDOW],
            count: 0,
            newest: 0,
            started: false,
        }
    }

    /// Forgets the past: the next step is a plain one.
    pub fn clear(&mut self) {
        self.count = 0;
        self.started = false;
    }

    /// Keeps the differences for another function that is much like the one before, but forgets its last step: none is made of it and the
    /// next one.
    pub fn resume(&mut self) {
        self.started = false;
    }

    /// The number of differences in use.
    pub fn depth(&self) -> usize {
        self.count
    }

    /// The memory in use, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.last) + size_of_val(&*self.history) + size_of_val(&*self.partial)
    }

    /// Takes the step `f = g(x) - x` of the iterate `x` at hand and writes the accelerated step to `out`, so that
    /// the next iterate is `x + out`. From the iterate before to `x` it was `taken` times what `out` holds: what was written there
    /// last. Non-finite vectors give the plain step and clear the history.
    ///
    /// ```
    /// # use fairmesh_linear::anderson::Anderson;
    /// // The fixed point 2 of g(x) = 3 - x / 2, found in the second step.
    /// let (mut x, mut out) = ([0.0], [0.0]);
    /// let mut anderson = Anderson::new(1, 1);
    /// for _ in 0..2 {
    ///     anderson.accelerate(&[3.0 - 1.5 * x[0]], 1.0, &mut out);
    ///     x[0] += out[0];
    /// }
    /// assert_eq!(x, [2.0]);
    /// ```
    ///
    /// # Panics
    /// If a vector does not have the length `n`.
    pub fn accelerate(&mut self, f: &[f64], taken: f64, out: &mut [f64]) {
        assert!(
            f.len() == self.n && out.len() == self.n,
            "vectors of the length given"
        );
        if self.window == 0 {
            out.copy_from_slice(f);
            return;
        }
        let products = self.record(f, taken, out);
        if self.started {
            let newest = self.newest;
            for (slot, product) in products.iter().enumerate().take(self.count) {
                self.gram[newest][slot] = product[0];
                self.gram[slot][newest] = product[0];
            }
        }
        self.started = true;
        if self.count == 0 {
            out.copy_from_slice(f);
            return;
        }
        let weights = self.weights(&products);
        if weights.iter().all(|w| w.is_finite()) {
            self.combine(&weights, f, out);
        } else {
            self.clear();
            out.copy_from_slice(f);
        }
    }

    /// Stores the differences to the last vectors and returns the products of all differences of f with the
    /// newest one and with f.
    fn record(&mut self, f: &[f64], taken: f64, step: &[f64]) -> [[f64; 2]; MAX_WINDOW] {
        if self.started {
            self.newest = if self.count == 0 {
                0
            } else {
                (self.newest + 1) % self.window
            };
            self.count = (self.count + 1).min(self.window);
        }
        let (window, newest, count) = (self.window, self.newest, self.count);
        let started = self.started;
        let blocks = self
            .history
            .chunks_mut(2 * window * BLOCK)
            .zip(&mut self.partial)
            .zip(self.last.chunks_mut(BLOCK))
            .zip(f.chunks(BLOCK).zip(step.chunks(BLOCK)));
        parallel::for_each(blocks, |_, (((block, partial), last), (f, step))| {
            if count > 0 {
                vectorized(
                    #[inline(always)]
                    || {
                        let (df, dg) = block.split_at_mut(window * BLOCK);
                        let new = newest * BLOCK..newest * BLOCK + f.len();
                        if started {
                            differences(
                                (f, last),
                                taken,
                                step,
                                (&mut df[new.clone()], &mut dg[new.clone()]),
                            );
                        }
                        for (slot, sum) in partial.iter_mut().enumerate().take(count) {
                            *sum = products(&df[slot * BLOCK..][..f.len()], &df[new.clone()], f);
                        }
                    },
                );
            }
            last.copy_from_slice(f);
        });
        let mut sum = [[0.0; 2]; MAX_WINDOW];
        for partial in &self.partial {
            for (sum, part) in sum.iter_mut().zip(partial).take(count) {
                sum[0] += part[0];
                sum[1] += part[1];
            }
        }
        sum
    }

    /// The least squares weights of the differences, by slot. Normal equations with columns of unit length,
    /// from the newest to the oldest; what depends on the newer ones is left out.
    fn weights(&self, products: &[[f64; 2]; MAX_WINDOW]) -> [f64; MAX_WINDOW] {
        let slot = |age: usize| (self.newest + self.window - age) % self.window;
        let mut low = [[0.0; MAX_WINDOW]; MAX_WINDOW];
        let mut used = [0; MAX_WINDOW];
        let mut right = [0.0; MAX_WINDOW];
        let mut k = 0;
        for s in (0..self.count).map(slot) {
            let length = self.gram[s][s].sqrt();
            if length == 0.0 {
                continue;
            }
            let mut rest = 1.0;
            for j in 0..k {
                let other: usize = used[j];
                let mut sum = self.gram[s][other] / (length * self.gram[other][other].sqrt());
                for (a, b) in low[k].iter().zip(&low[j]).take(j) {
                    sum -= a * b;
                }
                low[k][j] = sum / low[j][j];
                rest -= low[k][j] * low[k][j];
            }
            if rest <= INDEPENDENT {
                continue;
            }
            low[k][k] = rest.sqrt();
            right[k] = products[s][1] / length;
            for j in 0..k {
                right[k] -= low[k][j] * right[j];
            }
            right[k] /= low[k][k];
            used[k] = s;
            k += 1;
        }
        let mut weights = [0.0; MAX_WINDOW];
        for j in (0..k).rev() {
            for i in j + 1..k {
                right[j] -= low[i][j] * right[i];
            }
            right[j] /= low[j][j];
        }
        for j in 0..k {
            weights[used[j]] = right[j] / self.gram[used[j]][used[j]].sqrt();
        }
        weights
    }

    /// `out = f - sum w dg`.
    fn combine(&self, weights: &[f64; MAX_WINDOW], f: &[f64], out: &mut [f64]) {
        let (window, count) = (self.window, self.count);
        let blocks = out
            .chunks_mut(BLOCK)
            .zip(f.chunks(BLOCK))
            .zip(self.history.chunks(2 * window * BLOCK));
        parallel::for_each(blocks, |_, ((out, f), block)| {
            out.copy_from_slice(f);
            let columns = block[window * BLOCK..].chunks_exact(BLOCK);
            vectorized(
                #[inline(always)]
                || {
                    columns
                        .zip(weights)
                        .take(count)
                        .for_each(|(dg, &w)| subtract(out, dg, w))
                },
            );
        });
    }
}

/// The differences of f, and of g = x + f, where x has gone `taken` times `step`.
#[inline(always)]
fn differences((f, last): (&[f64], &[f64]), taken: f64, step: &[f64], (df, dg): (&mut [f32], &mut [f32])) {
    let before = last.iter().zip(step);
    for ((df, dg), (f, (last, step))) in df.iter_mut().zip(dg).zip(f.iter().zip(before)) {
        let d = f - last;
        *df = d as f32;
        *dg = (d + taken * step) as f32;
    }
}

/// The products of a column with the newest one, and with f.
#[inline(always)]
fn products(column: &[f32], newest: &[f32], f: &[f64]) -> [f64; 2] {
    let mut sums = [[0.0; LANES]; 2];
    let (columns, column_tail) = column.as_chunks::<LANES>();
    let (newests, newest_tail) = newest.as_chunks::<LANES>();
    let (fs, f_tail) = f.as_chunks::<LANES>();
    for (column, (newest, f)) in columns.iter().zip(newests.iter().zip(fs)) {
        for l in 0..LANES {
            let d = f64::from(column[l]);
            sums[0][l] += d * f64::from(newest[l]);
            sums[1][l] += d * f[l];
        }
    }
    let mut sums = sums.map(|sum| sum.iter().sum::<f64>());
    for (d, (newest, f)) in column_tail.iter().zip(newest_tail.iter().zip(f_tail)) {
        sums[0] += f64::from(*d) * f64::from(*newest);
        sums[1] += f64::from(*d) * f;
    }
    sums
}

/// `out -= w dg`.
#[inline(always)]
fn subtract(out: &mut [f64], dg: &[f32], w: f64) {
    for (out, &d) in out.iter_mut().zip(dg) {
        *out -= w * f64::from(d);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sparse::tests::Noise;

    /// g(x) = A x + b with A of rank `rank`, in `n` dimensions: the fixed point lies in b + range(A).
    struct Linear {
        left: Vec<Vec<f64>>,
        right: Vec<Vec<f64>>,
        b: Vec<f64>,
    }

    impl Linear {
        fn new(n: usize, rank: usize) -> Self {
            let mut noise = Noise(5);
            let mut vector = |scale: f64| (0..n).map(|_| scale * (noise.next() - 0.5)).collect::<Vec<_>>();
            let left = (0..rank).map(|_| vector(4.0)).collect();
            let right = (0..rank).map(|_| vector(4.0 / n as f64)).collect();
            Self {
                left,
                right,
                b: vector(1.0),
            }
        }

        fn step(&self, x: &[f64]) -> Vec<f64> {
            let mut f: Vec<f64> = self.b.iter().zip(x).map(|(b, x)| b - x).collect();
            for (l, r) in self.left.iter().zip(&self.right) {
                let s: f64 = r.iter().zip(x).map(|(r, x)| r * x).sum();
                for (f, l) in f.iter_mut().zip(l) {
                    *f += s * l;
                }
            }
            f
        }
    }

    /// The norms of the steps of an accelerated iteration, and the last iterate.
    fn iterate(map: &Linear, window: usize, steps: usize) -> (Vec<f64>, Vec<f64>) {
        let n = map.b.len();
        let mut anderson = Anderson::new(n, window);
        let (mut x, mut out, mut norms) = (vec![0.0; n], vec![0.0; n], vec![]);
        for _ in 0..steps {
            let f = map.step(&x);
            norms.push(f.iter().map(|f| f * f).sum::<f64>().sqrt());
            anderson.accelerate(&f, 1.0, &mut out);
            for (x, d) in x.iter_mut().zip(&out) {
                *x += d;
            }
        }
        (norms, x)
    }

    #[test]
    fn a_linear_map_of_the_rank_of_the_window_is_solved_exactly() {
        for (n, m) in [(1, 1), (2, 2), (5, 5), (7000, 3), (5000, 5)] {
            let (norms, _) = iterate(&Linear::new(n, m), m, m + 3);
            // The plain first step leaves a step in range(A), of dimension m.
            assert!(norms[m + 2] < 1e-8 * norms[0], "{n} {m} {norms:?}");
        }
    }

    #[test]
    #[should_panic = "at most 16 differences"]
    fn a_window_that_is_too_long_is_refused() {
        Anderson::new(10, MAX_WINDOW + 1);
    }

    #[test]
    fn without_a_window_steps_are_plain() {
        let map = Linear::new(50, 2);
        let (_, x) = iterate(&map, 0, 4);
        let mut y = vec![0.0; 50];
        for _ in 0..4 {
            let f = map.step(&y);
            y.iter_mut().zip(&f).for_each(|(y, f)| *y += f);
        }
        assert_eq!(x, y);
    }

    #[test]
    fn the_first_step_and_that_after_clear_are_plain() {
        let map = Linear::new(3000, 2);
        let mut anderson = Anderson::new(3000, 5);
        let (mut x, mut out) = (vec![0.0; 3000], vec![0.0; 3000]);
        for k in 0..4 {
            let f = map.step(&x);
            anderson.accelerate(&f, 1.0, &mut out);
            assert_eq!(out == f, k == 0);
            x.iter_mut().zip(&out).for_each(|(x, d)| *x += d);
        }
        assert_eq!(anderson.depth(), 3);
        anderson.clear();
        let f = map.step(&x);
        anderson.accelerate(&f, 1.0, &mut out);
        assert_eq!(out, f);
        assert_eq!(anderson.depth(), 0);
    }

    #[test]
    fn repeated_and_infinite_steps_are_harmless() {
        let mut anderson = Anderson::new(3, 4);
        let mut out = [0.0; 3];
        for _ in 0..6 {
            // The same x and f again: all differences vanish.
            anderson.accelerate(&[0.5, 0.0, 0.25], 0.0, &mut out);
            assert_eq!(out, [0.5, 0.0, 0.25]);
        }
        anderson.accelerate(&[f64::INFINITY, 0.0, 0.25], 0.0, &mut out);
        assert_eq!(anderson.depth(), 0);
        anderson.accelerate(&[0.5, 0.0, 0.25], 0.0, &mut out);
        assert_eq!(out, [0.5, 0.0, 0.25]);
    }

    #[test]
    fn the_bits_do_not_depend_on_the_number_of_threads() {
        let map = Linear::new(100_000, 8);
        let run = |threads| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            pool.install(|| iterate(&map, 5, 8)).1
        };
        let one = run(1);
        assert_same_items!(one, run(2));
        assert_same_items!(one, run(3));
    }
}
