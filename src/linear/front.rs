//! Dense kernels on one front: a column-major panel `m x p` (pivot block on top) and its update matrix.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Sub, SubAssign};

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor as llt;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::reborrow::{Reborrow, ReborrowMut};
use faer::traits::RealField;
use faer::traits::pulp::Arch;
use faer::{Accum, MatMut, Par};

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// The precision of a factorization: `f32` or `f64`.
pub trait Real:
    sealed::Sealed
    + RealField
    + Copy
    + Debug
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// Zero.
    const ZERO: Self;
    /// The nearest number.
    fn from_f64(value: f64) -> Self;
    /// The same number.
    fn to_f64(self) -> f64;
    /// The positive square root.
    fn root(self) -> Self;
    /// Neither infinite nor not a number, and greater than zero.
    fn is_pivot(self) -> bool;
}

macro_rules! real {
    ($t:ty) => {
        impl Real for $t {
            const ZERO: Self = 0.0;
            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                value as $t
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                self as f64
            }
            #[inline(always)]
            fn root(self) -> Self {
                <$t>::sqrt(self)
            }
            #[inline(always)]
            fn is_pivot(self) -> bool {
                self > 0.0 && self.is_finite()
            }
        }
    };
}
real!(f32);
real!(f64);

/// Runs a function compiled for the widest vectors of this processor. No multiply-add is contracted: the
/// results do not depend on the width.
#[inline(always)]
pub(crate) fn vectorized<R>(f: impl FnOnce() -> R) -> R {
    Arch::new().dispatch(f)
}

/// Scratch memory of the dense kernels.
#[derive(Default)]
pub(crate) struct Work {
    buffer: Option<MemBuffer>,
    rows: usize,
}

impl Work {
    fn stack<T: Real>(&mut self, p: usize) -> &mut MemStack {
        if self.buffer.is_none() || self.rows < p {
            self.rows = p.max(256);
            let need = llt::cholesky_in_place_scratch::<T>(self.rows, Par::Seq, Default::default());
            self.buffer = Some(MemBuffer::new(need));
        }
        MemStack::new(self.buffer.get_or_insert_with(|| unreachable!()))
    }
}

/// Fronts with at most this many pivots are eliminated by the loops below: the calls of the blocked kernels
/// would cost more than they gain.
const SMALL: usize = 16;

/// Eliminates the pivots of a front: the panel becomes that of the factor, the update matrix (lower triangle,
/// `r x r`) is diminished by `L21 L21^T`, or overwritten with its negative if `fresh`. The error is the
/// number of the pivot that is not positive.
pub(crate) fn eliminate<T: Real>(
    panel: &mut [T],
    m: usize,
    p: usize,
    update: &mut [T],
    fresh: bool,
    work: &mut Work,
) -> Result<(), usize> {
    if p <= SMALL {
        return vectorized(
            #[inline(always)]
            || eliminate_small(panel, m, p, update, fresh),
        );
    }
    let r = m - p;
    let full = MatMut::from_column_major_slice_mut(panel, m, p);
    let (mut pivot, mut low) = full.split_at_row_mut(p);
    if let Err(llt::LltError::NonPositivePivot { index }) = llt::cholesky_in_place(
        pivot.rb_mut(),
        Default::default(),
        Par::Seq,
        work.stack::<T>(p),
        Default::default(),
    ) {
        return Err(index);
    }
    for k in 0..p {
        if !pivot[(k, k)].is_pivot() {
            return Err(k);
        }
    }
    if r == 0 {
        return Ok(());
    }
    solve_lower_triangular_in_place(pivot.rb(), low.rb_mut().transpose_mut(), Par::Seq);
    let low = low.rb();
    triangular::matmul(
        MatMut::from_column_major_slice_mut(update, r, r),
        BlockStructure::TriangularLower,
        if fresh { Accum::Replace } else { Accum::Add },
        low,
        BlockStructure::Rectangular,
        low.transpose(),
        BlockStructure::Rectangular,
        T::from_f64(-1.0),
        Par::Seq,
    );
    Ok(())
}

#[inline(always)]
fn eliminate_small<T: Real>(
    panel: &mut [T],
    m: usize,
    p: usize,
    update: &mut [T],
    fresh: bool,
) -> Result<(), usize> {
    let one = T::from_f64(1.0);
    for k in 0..p {
        let (column, right) = panel[k * m..].split_at_mut(m);
        let pivot = column[k];
        if !pivot.is_pivot() {
            return Err(k);
        }
        let root = pivot.root();
        let inverse = one / root;
        column[k] = root;
        for a in &mut column[k + 1..] {
            *a *= inverse;
        }
        for (j, target) in right.chunks_exact_mut(m).enumerate() {
            let j = k + 1 + j;
            let factor = column[j];
            for (t, &a) in target[j..].iter_mut().zip(&column[j..]) {
                *t -= a * factor;
            }
        }
    }
    let r = m - p;
    if fresh {
        for j in 0..r {
            update[j * r + j..(j + 1) * r].fill(T::ZERO);
        }
    }
    let mut k = 0;
    while k + 4 <= p {
        let four: [&[T]; 4] = std::array::from_fn(|l| &panel[(k + l) * m + p..(k + l + 1) * m]);
        for j in 0..r {
            let f = four.map(|c| c[j]);
            let t = &mut update[j * r + j..(j + 1) * r];
            let [a, b, c, d] = four.map(|c| &c[j..j + t.len()]);
            for i in 0..t.len() {
                t[i] -= a[i] * f[0] + b[i] * f[1] + (c[i] * f[2] + d[i] * f[3]);
            }
        }
        k += 4;
    }
    for k in k..p {
        let column = &panel[k * m + p..(k + 1) * m];
        for j in 0..r {
            let f = column[j];
            for (t, &a) in update[j * r + j..(j + 1) * r].iter_mut().zip(&column[j..]) {
                *t -= a * f;
            }
        }
    }
    Ok(())
}

/// `L11 v1 = v1` in place and `v2 -= L21 v1` for `K` vectors of length `m`, one after the other in `local`.
#[inline(always)]
pub(crate) fn forward<T: Real, const K: usize>(panel: &[T], m: usize, p: usize, local: &mut [T]) {
    let mut j = 0;
    while j + 4 <= p {
        let column: [&[T]; 4] = std::array::from_fn(|l| &panel[(j + l) * m..(j + l + 1) * m]);
        for v in local.chunks_exact_mut(m) {
            let mut f = [T::ZERO; 4];
            for a in 0..4 {
                let mut sum = v[j + a];
                for b in 0..a {
                    sum -= column[b][j + a] * f[b];
                }
                f[a] = sum / column[a][j + a];
                v[j + a] = f[a];
            }
            let v = &mut v[j + 4..];
            let [a, b, c, d] = column.map(|c| &c[j + 4..][..v.len()]);
            for i in 0..v.len() {
                v[i] -= a[i] * f[0] + b[i] * f[1] + (c[i] * f[2] + d[i] * f[3]);
            }
        }
        j += 4;
    }
    for j in j..p {
        let column = &panel[j * m..(j + 1) * m];
        for v in local.chunks_exact_mut(m) {
            let f = v[j] / column[j];
            v[j] = f;
            for (v, &a) in v[j + 1..].iter_mut().zip(&column[j + 1..]) {
                *v -= a * f;
            }
        }
    }
}

/// `v1 -= L21^T v2` and `L11^T v1 = v1` in place for `K` vectors of length `m`.
#[inline(always)]
pub(crate) fn backward<T: Real, const K: usize>(panel: &[T], m: usize, p: usize, local: &mut [T]) {
    let whole = p / 4 * 4;
    for j in (whole..p).rev() {
        let column = &panel[j * m..(j + 1) * m];
        for v in local.chunks_exact_mut(m) {
            let [dot] = dots([&column[j + 1..]], &v[j + 1..]);
            v[j] = (v[j] - dot) / column[j];
        }
    }
    for j in (0..whole).step_by(4).rev() {
        let column: [&[T]; 4] = std::array::from_fn(|l| &panel[(j + l) * m..(j + l + 1) * m]);
        for v in local.chunks_exact_mut(m) {
            let dot = dots(column.map(|c| &c[j + 4..]), &v[j + 4..]);
            for a in (0..4).rev() {
                let mut sum = v[j + a] - dot[a];
                for b in a + 1..4 {
                    sum -= column[a][j + b] * v[j + b];
                }
                v[j + a] = sum / column[a][j + a];
            }
        }
    }
}

/// The dot products of columns with a vector, in eight partial sums each.
#[inline(always)]
fn dots<T: Real, const C: usize>(column: [&[T]; C], v: &[T]) -> [T; C] {
    const LANES: usize = 8;
    let mut sum = [[T::ZERO; LANES]; C];
    let (v8, tail) = v.as_chunks::<LANES>();
    let column8 = column.map(|c| &c.as_chunks::<LANES>().0[..v8.len()]);
    for (i, v) in v8.iter().enumerate() {
        for c in 0..C {
            for l in 0..LANES {
                sum[c][l] += column8[c][i][l] * v[l];
            }
        }
    }
    std::array::from_fn(|c| {
        let s = sum[c];
        let mut total = ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
        for (i, &v) in tail.iter().enumerate() {
            total += column[c][v8.len() * LANES + i] * v;
        }
        total
    })
}
