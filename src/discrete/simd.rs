//! `L` numbers at once: the same formula on `L` vertices of equal valence.
//!
//! Plain arrays that the compiler turns into vector instructions. Every operation is the IEEE one, lane by
//! lane and without fused multiply-add, so that results do not depend on the instruction set.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

pub(crate) use fairmesh_linear::dispatch::vectorized;

/// `L` numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(32))]
pub(crate) struct Simd<const L: usize>(pub [f64; L]);

/// `L` vectors, by coordinate.
pub(crate) type Vec3<const L: usize> = [Simd<L>; 3];

impl<const L: usize> Simd<L> {
    /// The same number in every lane.
    #[inline(always)]
    pub(crate) fn splat(x: f64) -> Self {
        Self([x; L])
    }

    /// Zero in every lane.
    #[inline(always)]
    pub(crate) fn zero() -> Self {
        Self::splat(0.0)
    }

    /// Lane by lane.
    #[inline(always)]
    pub(crate) fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut r = self.0;
        for x in &mut r {
            *x = f(*x);
        }
        Self(r)
    }

    // `Iterator::zip` is a call where the crate is compiled in many units.
    #[allow(clippy::needless_range_loop)]
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut r = self.0;
        for l in 0..L {
            r[l] = f(r[l], other.0[l]);
        }
        Self(r)
    }

    /// Square root.
    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    /// The larger of the two.
    #[inline(always)]
    pub(crate) fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    /// One over each.
    #[inline(always)]
    pub(crate) fn recip(self) -> Self {
        self.map(|x| 1.0 / x)
    }

    /// The sum of all lanes, from the first.
    #[inline(always)]
    pub(crate) fn sum(self) -> Simd<1> {
        let mut sum = 0.0;
        for l in 0..L {
            sum += self.0[l];
        }
        Simd([sum])
    }

    /// Magnitude of `self`, sign of `sign`.
    #[inline(always)]
    pub(crate) fn copysign(self, sign: Self) -> Self {
        self.zip(sign, f64::copysign)
    }

    /// Absolute value.
    #[inline(always)]
    pub(crate) fn abs(self) -> Self {
        self.map(f64::abs)
    }
}

/// `unrolled!(i in range => { .. })`: the loop over a range within `0..9`, written out. With constants known here, no
/// loop and no index is left, and small matrices live in registers; the optimizer gives up on nested triangles.
macro_rules! unrolled {
    ($i:ident in $range:expr => $body:block) => {
        unrolled!(@step $i, $range, $body, 0 1 2 3 4 5 6 7 8)
    };
    (@step $i:ident, $range:expr, $body:block, $($value:literal)*) => {
        $(if $range.contains(&$value) {
            let $i: usize = $value;
            $body
        })*
    };
}
pub(crate) use unrolled;

macro_rules! operator {
    ($trait:ident, $method:ident, $op:tt) => {
        impl<const L: usize> $trait for Simd<L> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.zip(other, |a, b| a $op b)
            }
        }
        impl<const L: usize> $trait<f64> for Simd<L> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: f64) -> Self {
                self.map(|a| a $op other)
            }
        }
    };
}
operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl<const L: usize> Neg for Simd<L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|x| -x)
    }
}

impl<const L: usize> AddAssign for Simd<L> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

/// `<a, b>`.
#[inline(always)]
pub(crate) fn dot<const L: usize>(a: &Vec3<L>, b: &Vec3<L>) -> Simd<L> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `a x b`.
#[inline(always)]
pub(crate) fn cross<const L: usize>(a: &Vec3<L>, b: &Vec3<L>) -> Vec3<L> {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// `a - b`.
#[inline(always)]
pub(crate) fn minus<const L: usize>(a: &Vec3<L>, b: &Vec3<L>) -> Vec3<L> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `a + b`.
#[inline(always)]
pub(crate) fn plus<const L: usize>(a: &Vec3<L>, b: &Vec3<L>) -> Vec3<L> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// `s a`.
#[inline(always)]
pub(crate) fn scaled<const L: usize>(a: &Vec3<L>, s: Simd<L>) -> Vec3<L> {
    [a[0] * s, a[1] * s, a[2] * s]
}

/// `a / |a|`; the zero vector stays zero.
#[inline(always)]
pub(crate) fn normalized<const L: usize>(a: &Vec3<L>) -> Vec3<L> {
    let length = dot(a, a).sqrt().max(Simd::splat(f64::MIN_POSITIVE));
    scaled(a, length.recip())
}

/// Two unit vectors that complete the unit vector `n` to a right-handed orthonormal basis.
/// Duff et al., "Building an orthonormal basis, revisited", JCGT 6 (2017).
#[inline(always)]
pub(crate) fn tangent_basis<const L: usize>(n: &Vec3<L>) -> (Vec3<L>, Vec3<L>) {
    let one = Simd::splat(1.0);
    let sign = one.copysign(n[2]);
    let a = -(sign + n[2]).recip();
    let b = n[0] * n[1] * a;
    (
        [one + sign * n[0] * n[0] * a, sign * b, -(sign * n[0])],
        [b, sign + n[1] * n[1] * a, -n[1]],
    )
}

/// The same of a single normal.
pub(crate) fn tangents(n: &nalgebra::Vector3<f64>) -> [nalgebra::Vector3<f64>; 2] {
    let (x, y) = tangent_basis(&one(n));
    [lane(&x, 0), lane(&y, 0)]
}

/// One vector as one lane.
#[inline(always)]
pub(crate) fn one(v: &nalgebra::Vector3<f64>) -> Vec3<1> {
    [Simd([v.x]), Simd([v.y]), Simd([v.z])]
}

/// Puts one vector into one lane.
#[inline(always)]
pub(crate) fn set_lane<const L: usize>(to: &mut Vec3<L>, l: usize, v: &nalgebra::Vector3<f64>) {
    to[0].0[l] = v.x;
    to[1].0[l] = v.y;
    to[2].0[l] = v.z;
}

/// One lane as a vector.
#[inline(always)]
pub(crate) fn lane<const L: usize>(v: &Vec3<L>, l: usize) -> nalgebra::Vector3<f64> {
    nalgebra::Vector3::new(v[0].0[l], v[1].0[l], v[2].0[l])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tangent_basis_is_orthonormal_and_right_handed() {
        for n in [
            [0.0, 0.0, 1.0],
            [0.0, 0.0, -1.0],
            [0.6, -0.8, 0.0],
            [0.48, 0.6, -0.64],
        ] {
            let n: Vec3<1> = n.map(Simd::splat);
            let (x, y) = tangent_basis(&n);
            for (a, b, want) in [
                (&x, &x, 1.0),
                (&y, &y, 1.0),
                (&x, &y, 0.0),
                (&x, &n, 0.0),
                (&y, &n, 0.0),
            ] {
                assert_near!(dot(a, b).0[0], want, 1e-15);
            }
            assert_near!(dot(&cross(&x, &y), &n).0[0], 1.0, 1e-15);
        }
    }
}
