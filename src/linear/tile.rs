//! The register tile that all dense arithmetic of a front goes through.
//!
//! `G` groups of [`LANES`] rows times `N` columns stay in registers while the columns of the factor stream by, as in the
//! inner kernel of Goto & van de Geijn, "Anatomy of high-performance matrix multiplication", ACM TOMS 34 (2008). The rows of
//! the factor are packed by groups for it: column after column, the `LANES` rows of a group are contiguous.

use super::real::Real;

/// Rows are worked on in groups of this number.
pub(crate) const LANES: usize = 8;

/// `LANES` rows of one column.
pub(crate) type Lanes<T> = [T; LANES];

/// `G` groups of rows times `N` columns.
pub(crate) type Tile<T, const G: usize, const N: usize> = [[Lanes<T>; N]; G];

/// `A B^T`, where `a` has the packed groups of rows of A and `b` the packed group of rows of B, of which the `part`-th `N` are
/// taken. The products are added in the order of the columns.
///
/// They are taken from a front by [`minus`] as one sum: a sum of many small products would lose its last digits in the large
/// numbers that it is taken from, one by one, and a 32-bit factor its lowest modes.
#[inline(always)]
pub(crate) fn products<T: Real, const G: usize, const N: usize>(
    a: [&[Lanes<T>]; G],
    b: &[Lanes<T>],
    part: usize,
) -> Tile<T, G, N> {
    let columns = b.len();
    let a = a.map(|a| &a[..columns]);
    let mut sum = [[[T::ZERO; LANES]; N]; G];
    for k in 0..columns {
        let b = &b[k].as_chunks::<N>().0[part];
        for n in 0..N {
            for g in 0..G {
                sum[g][n] = plus_product(sum[g][n], a[g][k], b[n]);
            }
        }
    }
    sum
}

/// `a - b`. By loops: a tile that `from_fn` makes goes through memory, and elimination takes twice as long.
#[inline(always)]
pub(crate) fn minus<T: Real, const G: usize, const N: usize>(
    mut a: Tile<T, G, N>,
    b: &Tile<T, G, N>,
) -> Tile<T, G, N> {
    for g in 0..G {
        for n in 0..N {
            for l in 0..LANES {
                a[g][n][l] -= b[g][n][l];
            }
        }
    }
    a
}

/// `c + a f`.
#[inline(always)]
fn plus_product<T: Real>(mut c: Lanes<T>, a: Lanes<T>, f: T) -> Lanes<T> {
    for l in 0..LANES {
        c[l] += a[l] * f;
    }
    c
}

/// `c - a f`.
#[inline(always)]
pub(crate) fn minus_product<T: Real>(mut c: Lanes<T>, a: Lanes<T>, f: T) -> Lanes<T> {
    for l in 0..LANES {
        c[l] -= a[l] * f;
    }
    c
}
