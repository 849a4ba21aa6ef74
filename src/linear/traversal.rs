//! Forward and backward substitution through a whole factor, or through what a sparse right-hand side reaches of it.
//!
//! The two halves below the topmost separator of a large matrix go side by side. What the lower half adds to the rows of
//! the separator is summed apart, for any number of threads.

use std::ops::Range;

use super::parallel;
use super::real::Real;
use super::substitution;
use super::symbolic::Symbolic;
use super::tile::LANES;

/// Matrices with fewer rows are not worth a second thread.
/// Half or double, of 76 cases: none changes.
const SIDE_BY_SIDE: usize = 60_000;

/// The supernodes that a substitution passes through.
#[derive(Debug, Clone, Copy)]
pub enum Passed<'a> {
    /// All: the vector is full.
    All,
    /// These, ascending, with all their ancestors, as [`Symbolic::reach`] finds them: forward where the vector is zero
    /// elsewhere, backward where only its values there are wanted.
    Only(&'a [u32]),
}

impl<'a> Passed<'a> {
    /// Those within a range.
    fn within(self, range: &Range<usize>) -> Supernodes<'a> {
        match self {
            Self::All => Supernodes::Range(range.clone()),
            Self::Only(list) => {
                let at = |s: usize| list.partition_point(|&k| (k as usize) < s);
                Supernodes::List(&list[at(range.start)..at(range.end)])
            }
        }
    }
}

/// The supernodes of one part.
#[derive(Clone)]
enum Supernodes<'a> {
    Range(Range<usize>),
    List(&'a [u32]),
}

impl Supernodes<'_> {
    #[inline(always)]
    fn len(&self) -> usize {
        match self {
            Self::Range(range) => range.len(),
            Self::List(list) => list.len(),
        }
    }

    #[inline(always)]
    fn at(&self, k: usize) -> usize {
        match self {
            Self::Range(range) => range.start + k,
            Self::List(list) => list[k] as usize,
        }
    }
}

/// Vectors to work in, one per half.
#[derive(Debug)]
pub(super) struct Scratch<T> {
    local: [Vec<T>; 2],
    above: Vec<T>,
}

impl<T> Default for Scratch<T> {
    fn default() -> Self {
        Self {
            local: [Vec::new(), Vec::new()],
            above: Vec::new(),
        }
    }
}

impl<T> Scratch<T> {
    pub(super) fn bytes(&self) -> usize {
        let [a, b] = &self.local;
        size_of::<T>() * (a.capacity() + b.capacity() + self.above.capacity())
    }
}

/// The factor that is passed through.
#[derive(Clone, Copy)]
pub(super) struct Factor<'a, T> {
    pub(super) symbolic: &'a Symbolic,
    pub(super) panels: &'a [T],
}

impl<T: Real> Factor<'_, T> {
    /// `L y = y` in the order of elimination.
    pub(super) fn forward<const K: usize>(
        self,
        y: &mut [[T; K]],
        passed: Passed<'_>,
        scratch: &mut Scratch<T>,
    ) {
        let local = self.locals::<K>(scratch);
        let Some(parts) = self.halves() else {
            let all = 0..self.symbolic.supernodes();
            self.forward_part(passed.within(&all), y, 0, &mut [], local[0]);
            return;
        };
        let [low, high, top] = &parts;
        let starts = [high.start, top.start].map(|s| self.symbolic.first[s] as usize);
        let (below, y_top) = y.split_at_mut(starts[1]);
        let (y_low, y_high) = below.split_at_mut(starts[0]);
        scratch.above.clear();
        scratch.above.resize(y_top.len() * K, T::ZERO);
        let above = scratch.above.as_chunks_mut::<K>().0;
        let [a, b] = &mut scratch.local;
        parallel::join(
            || self.forward_part(passed.within(low), y_low, 0, above, a),
            || self.forward_part(passed.within(high), y_high, starts[0], y_top, b),
        );
        for (y, above) in y_top.iter_mut().zip(above) {
            for c in 0..K {
                y[c] += above[c];
            }
        }
        self.forward_part(passed.within(top), y_top, starts[1], &mut [], a);
    }

    /// `L^T y = y` in the order of elimination. Where not [`Passed::All`] the other values are left as they are.
    pub(super) fn backward<const K: usize>(
        self,
        y: &mut [[T; K]],
        passed: Passed<'_>,
        scratch: &mut Scratch<T>,
    ) {
        self.locals::<K>(scratch);
        let [a, b] = &mut scratch.local;
        let Some(parts) = self.halves() else {
            let all = 0..self.symbolic.supernodes();
            self.backward_part(passed.within(&all), y, 0, &[], a);
            return;
        };
        let [low, high, top] = &parts;
        let starts = [high.start, top.start].map(|s| self.symbolic.first[s] as usize);
        let (below, y_top) = y.split_at_mut(starts[1]);
        let (y_low, y_high) = below.split_at_mut(starts[0]);
        self.backward_part(passed.within(top), y_top, starts[1], &[], a);
        let y_top = &*y_top;
        parallel::join(
            || self.backward_part(passed.within(low), y_low, 0, y_top, a),
            || self.backward_part(passed.within(high), y_high, starts[0], y_top, b),
        );
    }

    /// Two independent ranges of supernodes and the rest, of a large matrix.
    fn halves(self) -> Option<[Range<usize>; 3]> {
        let root = self.symbolic.tasks.last()?;
        let [low, high] = root.parts?;
        let part = |task: usize| self.symbolic.tasks[task].range.clone();
        (self.symbolic.n >= SIDE_BY_SIDE).then(|| [part(low), part(high), root.top..root.range.end])
    }

    fn locals<const K: usize>(self, scratch: &mut Scratch<T>) -> [&mut Vec<T>; 2] {
        for local in &mut scratch.local {
            local.resize((self.symbolic.largest + LANES) * K, T::ZERO);
        }
        scratch.local.each_mut()
    }

    /// Forward through some supernodes whose columns stand in `y`, from column `first` on; the last rows of the matrix, behind
    /// them, stand in `above`.
    fn forward_part<const K: usize>(
        self,
        supernodes: Supernodes<'_>,
        y: &mut [[T; K]],
        first: usize,
        above: &mut [[T; K]],
        local: &mut [T],
    ) {
        let Factor { symbolic, panels } = self;
        let (end, top) = (first + y.len(), symbolic.n - above.len());
        for k in 0..supernodes.len() {
            let s = supernodes.at(k);
            let (columns, rows) = (symbolic.columns(s), symbolic.rows(s));
            let (p, m) = (columns.len(), columns.len() + rows.len());
            let panel = &panels[symbolic.panel_start[s]..symbolic.panel_start[s + 1] + LANES];
            let stride = m + LANES;
            let local = &mut local[..K * stride];
            let mut vectors = split::<T, K>(local, stride, m);
            let own = columns.start - first..columns.end - first;
            load(&y[own.clone()], &mut vectors);
            for v in &mut vectors {
                v[p..].fill(T::ZERO);
            }
            substitution::forward(panel, m, p, local, stride);
            let vectors = split::<T, K>(local, stride, m);
            store(&vectors, &mut y[own]);
            let below = vectors.map(|v| &v[p..][..rows.len()]);
            for (k, &i) in rows.iter().enumerate() {
                let i = i as usize;
                let y = if i < end {
                    &mut y[i - first]
                } else {
                    &mut above[i - top]
                };
                for c in 0..K {
                    y[c] += below[c][k];
                }
            }
        }
    }

    /// Backward through some supernodes, as [`Factor::forward_part`].
    fn backward_part<const K: usize>(
        self,
        supernodes: Supernodes<'_>,
        y: &mut [[T; K]],
        first: usize,
        above: &[[T; K]],
        local: &mut [T],
    ) {
        let Factor { symbolic, panels } = self;
        let (end, top) = (first + y.len(), symbolic.n - above.len());
        for k in (0..supernodes.len()).rev() {
            let s = supernodes.at(k);
            let (columns, rows) = (symbolic.columns(s), symbolic.rows(s));
            let (p, m) = (columns.len(), columns.len() + rows.len());
            let panel = &panels[symbolic.panel_start[s]..symbolic.panel_start[s + 1] + LANES];
            let stride = m + LANES;
            let local = &mut local[..K * stride];
            let mut vectors = split::<T, K>(local, stride, stride);
            let own = columns.start - first..columns.end - first;
            load(&y[own.clone()], &mut vectors);
            for v in &mut vectors {
                v[m..].fill(T::ZERO);
            }
            let below = vectors.map(|v| &mut v[p..][..rows.len()]);
            for (k, &i) in rows.iter().enumerate() {
                let i = i as usize;
                let y = if i < end { y[i - first] } else { above[i - top] };
                for c in 0..K {
                    below[c][k] = y[c];
                }
            }
            substitution::backward(panel, m, p, local, stride);
            let vectors = split::<T, K>(local, stride, p);
            store(&vectors, &mut y[own]);
        }
    }
}

/// Takes a supernode's own rows into `K` vectors.
#[inline(always)]
fn load<T: Real, const K: usize>(y: &[[T; K]], vectors: &mut [&mut [T]; K]) {
    for (k, y) in y.iter().enumerate() {
        for c in 0..K {
            vectors[c][k] = y[c];
        }
    }
}

/// And back.
#[inline(always)]
fn store<T: Real, const K: usize>(vectors: &[&mut [T]; K], y: &mut [[T; K]]) {
    for (k, y) in y.iter_mut().enumerate() {
        *y = std::array::from_fn(|c| vectors[c][k]);
    }
}

/// The first `length` elements of `K` vectors that are `stride` apart.
#[inline(always)]
fn split<T, const K: usize>(local: &mut [T], stride: usize, length: usize) -> [&mut [T]; K] {
    let mut rest = local.chunks_exact_mut(stride);
    std::array::from_fn(|_| &mut rest.next().unwrap_or_default()[..length])
}
