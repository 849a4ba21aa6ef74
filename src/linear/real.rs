//! The precision of a factorization.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

#[allow(unnameable_types, reason = "nobody else may implement it")]
mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// The precision of a factorization: `f32` or `f64`.
pub trait Real:
    sealed::Sealed
    + Copy
    + Debug
    + PartialOrd
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// Zero.
    const ZERO: Self;
    /// Groups of rows of a register tile: with four columns as many sums as hide the latency of an addition, and registers left.
    #[doc(hidden)]
    const GROUPS: usize;
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
    ($t:ty, $groups:literal) => {
        impl Real for $t {
            const ZERO: Self = 0.0;
            const GROUPS: usize = $groups;
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
real!(f32, 2);
real!(f64, 1);
