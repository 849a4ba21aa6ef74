//! The elimination of one front: a column-major panel `m x p` (pivot block on top) and its update matrix `r x r`, `r = m - p`.
//!
//! Cholesky's method by rows, with groups of rows and columns in the place of numbers: all arithmetic but that within one
//! group goes through the register tile. The blocking is that of Goto & van de Geijn (2008): the columns of a chunk at one
//! group of rows stay in the first-level cache, those at a block of rows in the second.
//!
//! Every element of the result takes its products in the order of the columns, chunk by chunk, whatever the sizes of tile and block:
//! the bits depend on nothing else. Products and sums are rounded one by one: a fused multiply-add, which not every processor has, would save
//! two or three per cent of a solve.

use std::ops::Range;

use super::dispatch::vectorized;
use super::real::Real;
use super::tile::{LANES, Lanes, Tile, minus, minus_product, products};

/// The rows of the factor of one front, packed for the register tile: group after group, and column after column within it.
///
/// The groups end with the pivot block, so that none has pivots and other rows: the first `p % LANES` rows belong to none.
pub(crate) struct PackedRows<T> {
    packed: Vec<Lanes<T>>,
}

impl<T> Default for PackedRows<T> {
    fn default() -> Self {
        Self { packed: Vec::new() }
    }
}

/// Tiles in a block of rows: they share what is read of the rows above.
const TILES: usize = 4;
/// Groups of pivots whose columns are applied together: what a tile reads stays in the first-level cache.
/// Of 126 cases, half: 7 change by up to 6e-6 edges; double: none changes.
const CHUNK: usize = 32;
/// Columns in a tile.
const COLUMNS: usize = 4;

/// `for_tiles!(T, first, G in groups => f::<G>(first))`: `f` for the tiles that groups of rows fall into, with the first group and the
/// number `G` of groups known to the compiler.
macro_rules! for_tiles {
    ($T:ident, $first:ident, $G:ident in $groups:expr => $call:expr) => {
        let groups = $groups;
        for $first in groups.clone().step_by($T::GROUPS) {
            if $T::GROUPS == 2 && groups.end - $first >= 2 {
                const $G: usize = 2;
                $call;
            } else {
                const $G: usize = 1;
                $call;
            }
        }
    };
}

/// Eliminates the pivots of a front: the panel becomes that of the factor, with inverted diagonal, the update matrix (lower triangle,
/// `r x r`, columns padded to whole groups of rows) is diminished by `L21 L21^T`, or overwritten with its negative if `fresh`. The error is the
/// number of the pivot that is not positive.
pub(crate) fn eliminate<T: Real>(
    panel: &mut [T],
    m: usize,
    p: usize,
    update: &mut [T],
    fresh: bool,
    work: &mut PackedRows<T>,
) -> Result<(), usize> {
    let front = Front::new(panel, m, p, update, fresh, work);
    vectorized(
        #[inline(always)]
        || front.eliminate(),
    )
}

struct Front<'a, T> {
    panel: &'a mut [T],
    m: usize,
    p: usize,
    /// Pivots before the first group.
    head: usize,
    groups: usize,
    update: &'a mut [T],
    /// Rows of a column of the update matrix.
    tall: usize,
    fresh: bool,
    packed: &'a mut [Lanes<T>],
}

impl<'a, T: Real> Front<'a, T> {
    fn new(
        panel: &'a mut [T],
        m: usize,
        p: usize,
        update: &'a mut [T],
        fresh: bool,
        work: &'a mut PackedRows<T>,
    ) -> Self {
        let head = p % LANES;
        let groups = (m - head).div_ceil(LANES);
        if work.packed.len() < groups * p {
            work.packed.resize(groups * p, [T::ZERO; LANES]);
        }
        Self {
            panel,
            m,
            p,
            head,
            groups,
            update,
            tall: (m - p).next_multiple_of(LANES),
            fresh,
            packed: &mut work.packed[..groups * p],
        }
    }

    #[inline(always)]
    fn eliminate(mut self) -> Result<(), usize> {
        self.eliminate_head()?;
        for begin in (0..self.groups).step_by(TILES * T::GROUPS) {
            self.eliminate_rows(begin..(begin + TILES * T::GROUPS).min(self.groups))?;
        }
        Ok(())
    }

    /// Brings a block of rows to its final state, those above being there.
    #[inline(always)]
    fn eliminate_rows(&mut self, block: Range<usize>) -> Result<(), usize> {
        let pivots = self.pivots().min(block.end);
        let mut done = 0;
        for chunk in (0..pivots.max(1)).step_by(CHUNK) {
            let next = (chunk + CHUNK).min(pivots);
            for j in chunk..next {
                if block.contains(&j) {
                    self.factor(j, done)?;
                }
                for_tiles!(T, first, G in block.start.max(j + 1)..block.end => self.solve::<G>(first, j, done));
            }
            let columns = done..self.row(next);
            for j in next..block.end {
                for_tiles!(T, first, G in block.start.max(j)..block.end => self.diminish::<G>(first, j, columns.clone()));
            }
            done = columns.end;
        }
        Ok(())
    }

    /// The number of groups of pivots.
    #[inline(always)]
    fn pivots(&self) -> usize {
        (self.p - self.head) / LANES
    }

    /// The first row of a group.
    #[inline(always)]
    fn row(&self, group: usize) -> usize {
        self.head + group * LANES
    }

    /// Eliminates the pivots before the first group, column by column, and packs their columns.
    #[inline(always)]
    fn eliminate_head(&mut self) -> Result<(), usize> {
        let Self { m, p, head, .. } = *self;
        for k in 0..head {
            let (column, right) = self.panel[k * m..head * m].split_at_mut(m);
            let inverse = inverse_root(column[k]).ok_or(k)?;
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
        for k in 0..head {
            let (whole, rest) = self.panel[k * m + head..(k + 1) * m].as_chunks::<LANES>();
            for (g, rows) in whole.iter().enumerate() {
                self.packed[g * p + k] = *rows;
            }
            if !rest.is_empty() {
                let last = &mut self.packed[whole.len() * p + k];
                *last = [T::ZERO; LANES];
                last[..rest.len()].copy_from_slice(rest);
            }
        }
        Ok(())
    }

    /// Factors the pivot block of group `j`, from which the products of the columns before `done` are taken.
    #[inline(always)]
    fn factor(&mut self, j: usize, done: usize) -> Result<(), usize> {
        let Self { m, p, .. } = *self;
        let column = self.row(j);
        let (before, own) = self.packed[j * p..(j + 1) * p].split_at_mut(column);
        let panel = &mut self.panel[column * m + column..];
        for part in 0..LANES / COLUMNS {
            let sum = products::<T, 1, COLUMNS>([&before[done..]], &before[done..], part);
            let [tile] = minus(load(&panel[part * COLUMNS * m..], m, LANES, COLUMNS), &sum);
            own[part * COLUMNS..][..COLUMNS].copy_from_slice(&tile);
        }
        for k in 0..LANES {
            let inverse = inverse_root(own[k][k]).ok_or(column + k)?;
            own[k] = own[k].map(|a| a * inverse);
            for i in k + 1..LANES {
                own[i] = minus_product(own[i], own[k], own[k][i]);
            }
            own[k][k] = inverse;
            panel[k * m + k..k * m + LANES].copy_from_slice(&own[k][k..]);
        }
        Ok(())
    }

    /// The columns of group `j` of the factor at `G` groups of rows from `first` on, from which the products of the columns
    /// before `done` are taken.
    #[inline(always)]
    fn solve<const G: usize>(&mut self, first: usize, j: usize, done: usize) {
        let Self { m, p, .. } = *self;
        let (begin, row) = (self.row(j), self.row(first));
        let (above, rows) = self.packed.split_at_mut(first * p);
        let pivot = &above[j * p..(j + 1) * p];
        for part in 0..LANES / COLUMNS {
            let column = begin + part * COLUMNS;
            let panel = &mut self.panel[column * m + row..];
            let a: [&[Lanes<T>]; G] = std::array::from_fn(|g| &rows[g * p + done..g * p + column]);
            let sum = products::<T, G, COLUMNS>(a, &pivot[done..column], part);
            let mut tile = minus(load(panel, m, m - row, COLUMNS), &sum);
            let block = &pivot[column..column + COLUMNS];
            for g in 0..G {
                for n in 0..COLUMNS {
                    for i in 0..n {
                        tile[g][n] = minus_product(tile[g][n], tile[g][i], block[i][part * COLUMNS + n]);
                    }
                    tile[g][n] = tile[g][n].map(|a| a * block[n][part * COLUMNS + n]);
                }
                rows[g * p + column..][..COLUMNS].copy_from_slice(&tile[g]);
            }
            store(panel, m, m - row, COLUMNS, &tile);
        }
    }

    /// Takes the products of these columns of the factor from the columns of group `j`, of the panel or of the update matrix, at `G`
    /// groups of rows from `first` on.
    #[inline(always)]
    fn diminish<const G: usize>(&mut self, first: usize, j: usize, columns: Range<usize>) {
        let Self { m, p, tall, .. } = *self;
        let (column, row) = (self.row(j), self.row(first));
        let packed = |group: usize| &self.packed[group * p..][columns.clone()];
        let a: [&[Lanes<T>]; G] = std::array::from_fn(|g| packed(first + g));
        let b = packed(j);
        let (target, stride, width) = if column < p {
            (&mut self.panel[column * m + row..], m, LANES)
        } else {
            (
                &mut self.update[(column - p) * tall + (row - p)..],
                tall,
                m - column,
            )
        };
        let height = if column < p { m - row } else { tall - (row - p) };
        let fresh = self.fresh && column >= p && columns.start == 0;
        for part in 0..width.min(LANES).div_ceil(COLUMNS) {
            let target = &mut target[part * COLUMNS * stride..];
            let width = width - part * COLUMNS;
            let sum = products::<T, G, COLUMNS>(a, b, part);
            let tile = if fresh {
                [[[T::ZERO; LANES]; COLUMNS]; G]
            } else {
                load(target, stride, height, width)
            };
            store(target, stride, height, width, &minus(tile, &sum));
        }
    }
}

/// One over the root of a pivot, unless it is not positive and finite.
#[inline(always)]
fn inverse_root<T: Real>(pivot: T) -> Option<T> {
    let root = pivot.root();
    (pivot.is_pivot()).then(|| T::from_f64(1.0) / root)
}

/// A tile of a column-major matrix, of which `rows` rows and `columns` columns are left.
#[inline(always)]
fn load<T: Real, const G: usize, const N: usize>(
    matrix: &[T],
    stride: usize,
    rows: usize,
    columns: usize,
) -> Tile<T, G, N> {
    let mut tile = [[[T::ZERO; LANES]; N]; G];
    for n in 0..columns.min(N) {
        let column = &matrix[n * stride..];
        if rows >= G * LANES {
            let column = &column[..G * LANES].as_chunks::<LANES>().0;
            for g in 0..G {
                tile[g][n] = column[g];
            }
        } else {
            for g in 0..G {
                let rows = rows.saturating_sub(g * LANES).min(LANES);
                tile[g][n][..rows].copy_from_slice(&column[g * LANES..][..rows]);
            }
        }
    }
    tile
}

/// The reverse of [`load`].
#[inline(always)]
fn store<T: Real, const G: usize, const N: usize>(
    matrix: &mut [T],
    stride: usize,
    rows: usize,
    columns: usize,
    tile: &Tile<T, G, N>,
) {
    for n in 0..columns.min(N) {
        let column = &mut matrix[n * stride..];
        if rows >= G * LANES {
            let column = &mut column[..G * LANES].as_chunks_mut::<LANES>().0;
            for g in 0..G {
                column[g] = tile[g][n];
            }
        } else {
            for g in 0..G {
                let rows = rows.saturating_sub(g * LANES).min(LANES);
                column[g * LANES..][..rows].copy_from_slice(&tile[g][n][..rows]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sparse::tests::Noise;

    /// A front with a dominant diagonal: `m x m`, column-major, lower triangle.
    fn matrix<T: Real>(m: usize) -> Vec<T> {
        let mut noise = Noise(m as u64 + 1);
        let mut a = vec![T::ZERO; m * m];
        for j in 0..m {
            for i in j..m {
                let diagonal = if i == j { m as f64 } else { 0.0 };
                a[j * m + i] = T::from_f64(diagonal + noise.next() - 0.5);
            }
        }
        a
    }

    /// Eliminates the first `p` columns by the definition, in 64 bits, with inverted diagonal.
    fn plain<T: Real>(a: &[T], m: usize, p: usize) -> Vec<f64> {
        let mut a: Vec<f64> = a.iter().map(|a| a.to_f64()).collect();
        for k in 0..p {
            let root = a[k * m + k].sqrt();
            for i in k + 1..m {
                a[k * m + i] /= root;
            }
            for j in k + 1..m {
                for i in j..m {
                    a[j * m + i] -= a[k * m + i] * a[k * m + j];
                }
            }
            a[k * m + k] = 1.0 / root;
        }
        a
    }

    /// The largest error of [`eliminate`] in parts of the largest number. The update matrix begins as that of `a`, or, if fresh, as
    /// rubbish.
    fn error<T: Real>(m: usize, p: usize, fresh: bool, work: &mut PackedRows<T>) -> f64 {
        let mut a = matrix::<T>(m);
        let (r, tall) = (m - p, (m - p).next_multiple_of(LANES));
        let mut update = vec![T::from_f64(f64::NAN); r * tall];
        for j in 0..r {
            for i in j..r {
                let entry = &mut a[(p + j) * m + p + i];
                if fresh {
                    *entry = T::ZERO;
                } else {
                    update[j * tall + i] = *entry;
                }
            }
        }
        let exact = plain(&a, m, p);
        let mut panel = a[..m * p].to_vec();
        eliminate(&mut panel, m, p, &mut update, fresh, work).unwrap();
        let mut worst = 0.0_f64;
        for j in 0..m {
            for i in j..m {
                let found = if j < p {
                    panel[j * m + i]
                } else {
                    update[(j - p) * tall + i - p]
                };
                // A NaN would be lost by max.
                assert!(found.to_f64().is_finite(), "{m} {p} {i} {j}");
                worst = worst.max((found.to_f64() - exact[j * m + i]).abs());
            }
        }
        worst / m as f64
    }

    #[test]
    fn all_small_fronts_are_those_of_the_definition() {
        let (mut single, mut double) = (PackedRows::default(), PackedRows::default());
        for m in 1..=70 {
            for p in 1..=m {
                for fresh in [false, true] {
                    let (found, found_double) = (
                        error::<f32>(m, p, fresh, &mut single),
                        error::<f64>(m, p, fresh, &mut double),
                    );
                    assert!(found < 8.0 * f64::from(f32::EPSILON), "{m} {p} {found:e}");
                    assert!(found_double < 8.0 * f64::EPSILON, "{m} {p} {found_double:e}");
                }
            }
        }
    }

    #[test]
    fn fronts_of_several_chunks_are_those_of_the_definition() {
        for (m, p) in [(300, 263), (300, 264), (300, 265), (613, 520), (600, 600)] {
            for fresh in [false, true] {
                let single = error::<f32>(m, p, fresh, &mut PackedRows::default());
                let double = error::<f64>(m, p, fresh, &mut PackedRows::default());
                assert!(single < 1e-5 && double < 2e-14, "{m} {p} {single} {double}");
            }
        }
    }

    #[test]
    fn the_failing_pivot_is_named() {
        for (m, p) in [(5, 5), (40, 30), (330, 300)] {
            for bad in [0, p / 2, p - 1] {
                for value in [-1.0, 0.0, f64::NAN, f64::INFINITY] {
                    let mut panel = matrix::<f64>(m)[..m * p].to_vec();
                    panel[bad * m + bad] = value;
                    let r = m - p;
                    let mut update = vec![0.0; r * r.next_multiple_of(LANES)];
                    let end = eliminate(&mut panel, m, p, &mut update, true, &mut PackedRows::default());
                    assert_eq!(end, Err(bad), "{m} {p} {value}");
                }
            }
        }
    }
}
