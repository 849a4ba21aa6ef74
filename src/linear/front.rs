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

#[allow(unnameable_types, reason = "nobody else may implement it")]
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
pub(crate) struct Work<T> {
    buffer: Option<MemBuffer>,
    rows: usize,
    low: Vec<[T; LANES]>,
}

impl<T: Real> Work<T> {
    fn stack(&mut self, p: usize) -> &mut MemStack {
        if self.buffer.is_none() || self.rows < p {
            self.rows = p.max(256);
            let need = llt::cholesky_in_place_scratch::<T>(self.rows, Par::Seq, Default::default());
            self.buffer = Some(MemBuffer::new(need));
        }
        MemStack::new(self.buffer.get_or_insert_with(|| unreachable!()))
    }
}

impl<T> Default for Work<T> {
    fn default() -> Self {
        Self {
            buffer: None,
            rows: 0,
            low: Vec::new(),
        }
    }
}

/// `in_blocks!(j, C in p => f::<C>(j))`: for the columns `0..p` from the left, four at a time, `f` with the first column `j`
/// and the number `C` of columns known to the compiler.
macro_rules! in_blocks {
    ($j:ident, $C:ident in $p:expr => $call:expr) => {
        let mut $j = 0;
        while $j + 4 <= $p {
            const $C: usize = 4;
            $call;
            $j += $C;
        }
        match $p - $j {
            3 => {
                const $C: usize = 3;
                $call;
            }
            2 => {
                const $C: usize = 2;
                $call;
            }
            1 => {
                const $C: usize = 1;
                $call;
            }
            _ => {}
        }
    };
}

/// Fronts with at most this many pivots are eliminated by the loops below: the calls of the blocked kernels
/// would cost more than they gain.
const SMALL: usize = 16;

/// Eliminates the pivots of a front: the panel becomes that of the factor, with inverted diagonal, the update matrix (lower triangle,
/// `r x r`, columns padded to whole groups of rows) is diminished by `L21 L21^T`, or overwritten with its negative if `fresh`. The error is the
/// number of the pivot that is not positive.
pub(crate) fn eliminate<T: Real>(
    panel: &mut [T],
    m: usize,
    p: usize,
    update: &mut [T],
    fresh: bool,
    work: &mut Work<T>,
) -> Result<(), usize> {
    if p <= SMALL {
        return vectorized(
            #[inline(always)]
            || eliminate_small(panel, m, p, update, fresh, &mut work.low),
        );
    }
    let r = m - p;
    let full = MatMut::from_column_major_slice_mut(panel, m, p);
    let (mut pivot, mut low) = full.split_at_row_mut(p);
    if let Err(llt::LltError::NonPositivePivot { index }) = llt::cholesky_in_place(
        pivot.rb_mut(),
        Default::default(),
        Par::Seq,
        work.stack(p),
        Default::default(),
    ) {
        return Err(index);
    }
    for k in 0..p {
        if !pivot[(k, k)].is_pivot() {
            return Err(k);
        }
    }
    if r > 0 {
        solve_lower_triangular_in_place(pivot.rb(), low.rb_mut().transpose_mut(), Par::Seq);
    }
    for k in 0..p {
        pivot[(k, k)] = T::from_f64(1.0) / pivot[(k, k)];
    }
    if r == 0 {
        return Ok(());
    }
    let low = low.rb();
    triangular::matmul(
        MatMut::from_column_major_slice_with_stride_mut(update, r, r, r.next_multiple_of(LANES)),
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
    low: &mut Vec<[T; LANES]>,
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
        column[k] = inverse;
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
    let groups = r.div_ceil(LANES);
    low.clear();
    low.resize(p * groups, [T::ZERO; LANES]);
    for (k, low) in low.chunks_exact_mut(groups.max(1)).enumerate() {
        low.as_flattened_mut()[..r].copy_from_slice(&panel[k * m + p..(k + 1) * m]);
    }
    let (update, _) = update.as_chunks_mut::<LANES>();
    for (j, target) in update.chunks_exact_mut(groups.max(1)).enumerate() {
        // From the group of the diagonal on.
        let skip = j / LANES;
        let target = &mut target[skip..];
        if fresh {
            target.fill([T::ZERO; LANES]);
        }
        in_blocks!(k, C in p => diminish::<T, C>(target, low, groups, k, j));
    }
    Ok(())
}

/// Takes the columns `k..k + C` of `L21 L21^T` from the end of column `j` of an update matrix.
#[inline(always)]
fn diminish<T: Real, const C: usize>(
    target: &mut [[T; LANES]],
    low: &[[T; LANES]],
    groups: usize,
    k: usize,
    j: usize,
) {
    let skip = groups - target.len();
    let column: [&[[T; LANES]]; C] =
        std::array::from_fn(|l| &low[(k + l) * groups + skip..(k + l + 1) * groups][..target.len()]);
    let f: [T; C] = std::array::from_fn(|l| column[l][0][j % LANES]);
    for (i, t) in target.iter_mut().enumerate() {
        let mut sum = scaled(column[0][i], f[0]);
        for l in 1..C {
            sum = plus(sum, scaled(column[l][i], f[l]));
        }
        *t = minus(*t, sum);
    }
}

/// Rows are worked on in groups of this number. The last group of a column runs over into what follows it.
pub(crate) const LANES: usize = 8;

/// `L11 v1 = v1` in place and `v2 -= L21 v1` for `K` vectors of length `m`, `stride` apart in `local`. Up to
/// `LANES` elements after each vector are overwritten. `panel` goes on beyond the front by as many.
#[inline(always)]
pub(crate) fn forward<T: Real, const K: usize>(
    panel: &[T],
    m: usize,
    p: usize,
    local: &mut [T],
    stride: usize,
) {
    in_blocks!(j, C in p => forward_block::<T, K, C>(panel, m, j, local, stride));
}

/// The columns `j..j + C` of the forward substitution.
#[inline(always)]
fn forward_block<T: Real, const K: usize, const C: usize>(
    panel: &[T],
    m: usize,
    j: usize,
    local: &mut [T],
    stride: usize,
) {
    let column: [&[T]; C] = std::array::from_fn(|l| &panel[(j + l) * m + j..]);
    let mut f = [[T::ZERO; C]; K];
    for k in 0..K {
        let v = &mut local[k * stride + j..][..C];
        for a in 0..C {
            let mut sum = v[a];
            for b in 0..a {
                sum -= column[b][a] * f[k][b];
            }
            f[k][a] = sum * column[a][a];
            v[a] = f[k][a];
        }
    }
    let groups = (m - j - C).div_ceil(LANES);
    let column = column.map(|c| &c[C..][..groups * LANES].as_chunks::<LANES>().0[..groups]);
    let mut rest = local;
    let v: [&mut [[T; LANES]]; K] = std::array::from_fn(|_| {
        let (own, other) = std::mem::take(&mut rest).split_at_mut(stride);
        rest = other;
        &mut own[j + C..].as_chunks_mut::<LANES>().0[..groups]
    });
    for i in 0..groups {
        let a: [[T; LANES]; C] = std::array::from_fn(|l| column[l][i]);
        for k in 0..K {
            let mut sum = scaled(a[0], f[k][0]);
            for l in 1..C {
                sum = plus(sum, scaled(a[l], f[k][l]));
            }
            v[k][i] = minus(v[k][i], sum);
        }
    }
}

/// `v1 -= L21^T v2` and `L11^T v1 = v1` in place for `K` vectors of length `m`, followed by `LANES` zeros each.
#[inline(always)]
pub(crate) fn backward<T: Real, const K: usize>(
    panel: &[T],
    m: usize,
    p: usize,
    local: &mut [T],
    stride: usize,
) {
    let whole = p / 4 * 4;
    match p - whole {
        3 => backward_block::<T, K, 3>(panel, m, whole, local, stride),
        2 => backward_block::<T, K, 2>(panel, m, whole, local, stride),
        1 => backward_block::<T, K, 1>(panel, m, whole, local, stride),
        _ => {}
    }
    for j in (0..whole).step_by(4).rev() {
        backward_block::<T, K, 4>(panel, m, j, local, stride);
    }
}

/// The columns `j..j + C` of the backward substitution.
#[inline(always)]
fn backward_block<T: Real, const K: usize, const C: usize>(
    panel: &[T],
    m: usize,
    j: usize,
    local: &mut [T],
    stride: usize,
) {
    let column: [&[T]; C] = std::array::from_fn(|l| &panel[(j + l) * m + j..]);
    let groups = (m - j - C).div_ceil(LANES);
    let below = column.map(|c| &c[C..][..groups * LANES].as_chunks::<LANES>().0[..groups]);
    for k in 0..K {
        let (top, v) = local[k * stride + j..(k + 1) * stride].split_at_mut(C);
        let v = &v.as_chunks::<LANES>().0[..groups];
        let mut sum = [[T::ZERO; LANES]; C];
        for i in 0..groups {
            for l in 0..C {
                sum[l] = plus(sum[l], times(below[l][i], v[i]));
            }
        }
        // Through memory, or the compiler transposes the loop above to suit the sums below.
        let sum = std::hint::black_box(sum);
        for a in (0..C).rev() {
            let s = sum[a];
            let dot = ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
            let mut value = top[a] - dot;
            for b in a + 1..C {
                value -= column[a][b] * top[b];
            }
            top[a] = value * column[a][a];
        }
    }
}

#[inline(always)]
fn scaled<T: Real>(a: [T; LANES], f: T) -> [T; LANES] {
    std::array::from_fn(|l| a[l] * f)
}

#[inline(always)]
fn times<T: Real>(a: [T; LANES], b: [T; LANES]) -> [T; LANES] {
    std::array::from_fn(|l| a[l] * b[l])
}

#[inline(always)]
fn plus<T: Real>(a: [T; LANES], b: [T; LANES]) -> [T; LANES] {
    std::array::from_fn(|l| a[l] + b[l])
}

#[inline(always)]
fn minus<T: Real>(a: [T; LANES], b: [T; LANES]) -> [T; LANES] {
    std::array::from_fn(|l| a[l] - b[l])
}
