//! Forward and backward substitution with one front.
//!
//! Vectors go one after the other: what each reads of the front stays in the cache, and their number need not be known to the compiler, which
//! would make all of this once more for each number.

use super::dispatch::vectorized;
use super::real::Real;
use super::tile::LANES;

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

/// `L11 v1 = v1` in place and `v2 -= L21 v1` for vectors of length `m`, `stride` apart in `local`. Up to
/// `LANES` elements after each vector are overwritten. `panel` goes on beyond the front by as many.
#[inline(never)]
pub(crate) fn forward<T: Real>(panel: &[T], m: usize, p: usize, local: &mut [T], stride: usize) {
    vectorized(
        #[inline(always)]
        || {
            in_blocks!(j, C in p => {
                for v in local.chunks_exact_mut(stride) {
                    forward_block::<T, C>(panel, m, j, v);
                }
            });
        },
    );
}

/// The columns `j..j + C` of the forward substitution.
#[inline(always)]
fn forward_block<T: Real, const C: usize>(panel: &[T], m: usize, j: usize, v: &mut [T]) {
    let column: [&[T]; C] = std::array::from_fn(|l| &panel[(j + l) * m + j..]);
    let (top, v) = v[j..].split_at_mut(C);
    let mut f = [T::ZERO; C];
    for a in 0..C {
        let mut sum = top[a];
        for b in 0..a {
            sum -= column[b][a] * f[b];
        }
        f[a] = sum * column[a][a];
        top[a] = f[a];
    }
    let groups = (m - j - C).div_ceil(LANES);
    let column = column.map(|c| &c[C..][..groups * LANES].as_chunks::<LANES>().0[..groups]);
    let v = &mut v.as_chunks_mut::<LANES>().0[..groups];
    for i in 0..groups {
        let mut sum = scaled(column[0][i], f[0]);
        for l in 1..C {
            sum = plus(sum, scaled(column[l][i], f[l]));
        }
        // The sum through memory, or the compiler transposes the columns.
        v[i] = minus(v[i], std::hint::black_box(sum));
    }
}

/// `v1 -= L21^T v2` and `L11^T v1 = v1` in place for vectors of length `m`, followed by `LANES` zeros each.
#[inline(never)]
pub(crate) fn backward<T: Real>(panel: &[T], m: usize, p: usize, local: &mut [T], stride: usize) {
    let whole = p / 4 * 4;
    vectorized(
        #[inline(always)]
        || {
            for v in local.chunks_exact_mut(stride) {
                match p - whole {
                    3 => backward_block::<T, 3>(panel, m, whole, v),
                    2 => backward_block::<T, 2>(panel, m, whole, v),
                    1 => backward_block::<T, 1>(panel, m, whole, v),
                    _ => {}
                }
            }
            for j in (0..whole).step_by(4).rev() {
                for v in local.chunks_exact_mut(stride) {
                    backward_block::<T, 4>(panel, m, j, v);
                }
            }
        },
    );
}

/// The columns `j..j + C` of the backward substitution.
#[inline(always)]
fn backward_block<T: Real, const C: usize>(panel: &[T], m: usize, j: usize, v: &mut [T]) {
    let column: [&[T]; C] = std::array::from_fn(|l| &panel[(j + l) * m + j..]);
    let groups = (m - j - C).div_ceil(LANES);
    let below = column.map(|c| &c[C..][..groups * LANES].as_chunks::<LANES>().0[..groups]);
    let (top, v) = v[j..].split_at_mut(C);
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

#[inline(always)]
fn scaled<T: Real>(mut a: [T; LANES], f: T) -> [T; LANES] {
    for a in &mut a {
        *a *= f;
    }
    a
}

#[inline(always)]
fn times<T: Real>(mut a: [T; LANES], b: [T; LANES]) -> [T; LANES] {
    for l in 0..LANES {
        a[l] *= b[l];
    }
    a
}

#[inline(always)]
fn plus<T: Real>(mut a: [T; LANES], b: [T; LANES]) -> [T; LANES] {
    for l in 0..LANES {
        a[l] += b[l];
    }
    a
}

#[inline(always)]
fn minus<T: Real>(mut a: [T; LANES], b: [T; LANES]) -> [T; LANES] {
    for l in 0..LANES {
        a[l] -= b[l];
    }
    a
}
