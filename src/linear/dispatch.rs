//! Functions compiled for the widest vectors of the processor that they run on.

use multiversion::multiversion;

/// Runs `f` compiled for the widest vectors of this processor. Only what is inlined into `f` is: every function on
/// the way down to the arithmetic is `#[inline(always)]`. Rust never contracts a product and a sum into one rounding,
/// so the results are those of calling `f` itself, bit by bit.
#[multiversion(targets("x86_64+avx2+fma"))]
pub fn vectorized<R, F: FnOnce() -> R>(f: F) -> R {
    f()
}
