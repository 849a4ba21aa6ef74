//! Sizes of the three-cylinder blend and of the tetra thing for a wished number of vertices.

/// A net's `arc`, `seam` and `rings`; see [`cylinder_blend_with`](super::cylinder_blend_with).
type Size = [usize; 3];

/// What a good size looks like, for one family of nets.
struct Family {
    /// Number of vertices of a size.
    count: fn(f64, f64, f64) -> f64,
    /// Wished `seam / arc` and `rings / arc`.
    shape: [f64; 2],
}

/// A count that is off by the share x costs as much as proportions that are off by the factor exp(MISS x).
const MISS: f64 = 30.0;
/// An exact count is worth proportions that are off by 25 %.
const EXACT: f64 = 0.05;

/// A cylinder blend of about `n` vertices, exactly as many where a net of good proportions has them.
pub(super) fn blend_size(n: usize) -> Size {
    let count = |a: f64, s: f64, r: f64| a * a + 4.0 * a * s + s * s + 6.0 * a * r + 3.0 * a - 1.0;
    best(
        n,
        &Family {
            count,
            shape: [0.5, 0.14],
        },
    )
}

/// A tetra thing of about `n` vertices.
pub(super) fn tetra_size(n: usize) -> Size {
    let count = |a: f64, s: f64, r: f64| 4.0 * (a * a + 4.0 * a * s + s * s + 6.0 * a * r - 1.0);
    best(
        n,
        &Family {
            count,
            shape: [0.52, 0.1],
        },
    )
}

fn best(n: usize, family: &Family) -> Size {
    let n = n.clamp(50, 5_000_000) as f64;
    let [seam, rings] = family.shape;
    // The number of vertices goes with arc^2.
    let ideal = (n / (family.count)(1e3, 1e3 * seam, 1e3 * rings)).sqrt() * 1e3;
    let about = |x: f64, least: usize| {
        let (low, high) = ((0.6 * x) as usize, (1.5 * x) as usize + 1);
        (low.max(least)..=high.max(least)).map(|k| k as f64)
    };
    let mut found = (f64::INFINITY, [3, 1, 0]);
    for a in about(ideal, 3) {
        for s in about(seam * ideal, 1) {
            // With these two the count is linear in the rings.
            let (none, one) = ((family.count)(a, s, 0.0), (family.count)(a, s, 1.0));
            let r = ((n - none) / (one - none)).round().max(0.0);
            let missed = ((family.count)(a, s, r) - n).abs() / n;
            let far = |x: f64, wished: f64| ((x + 0.5) / (wished * a + 0.5)).ln().powi(2);
            let exact = if missed == 0.0 { 0.0 } else { EXACT };
            let cost = far(s, seam) + far(r, rings) + exact + (MISS * missed).powi(2);
            if cost < found.0 {
                found = (cost, [a as usize, s as usize, r as usize]);
            }
        }
    }
    found.1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_met() {
        for n in [100, 300, 920, 2_926, 4_665, 13_308, 50_000, 200_000] {
            let [a, s, r] = blend_size(n);
            let count = a * a + 4 * a * s + s * s + 6 * a * r + 3 * a - 1;
            assert!(count.abs_diff(n) * 50 <= n, "blend of {n}: {count}");
            let [a, s, r] = tetra_size(n);
            let count = 4 * (a * a + 4 * a * s + s * s + 6 * a * r - 1);
            assert!(
                count.abs_diff(n) * 20 <= n.max(400),
                "tetra thing of {n}: {count}"
            );
        }
        assert_eq!(tetra_size(13_308), [29, 15, 3]);
    }
}
