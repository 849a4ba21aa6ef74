//! Linear systems of the start surfaces.

/// The squared residual, in parts of that of zero, at which a solution is exact enough.
const ENOUGH: f64 = 1e-24;

/// Solves `A x = right` for the three coordinates by conjugate gradients (Hestenes & Stiefel 1952), with `apply` for the
/// symmetric positive definite `A`. Where `right` and the range of `apply` vanish, the solution does.
pub(super) fn conjugate_gradients(
    apply: impl Fn(&[[f64; 3]]) -> Vec<[f64; 3]>,
    right: Vec<[f64; 3]>,
) -> Vec<[f64; 3]> {
    let mut x = vec![[0.0; 3]; right.len()];
    let mut residual = right;
    let mut direction = residual.clone();
    let mut square = dots(&residual, &residual);
    let enough = square.map(|s| s * ENOUGH);
    for _ in 0..10 * x.len() {
        let open: [bool; 3] = std::array::from_fn(|a| square[a] > enough[a]);
        if open == [false; 3] {
            break;
        }
        let image = apply(&direction);
        let curvature = dots(&direction, &image);
        let step: [f64; 3] = std::array::from_fn(|a| if open[a] { square[a] / curvature[a] } else { 0.0 });
        for (i, image) in image.iter().enumerate() {
            for a in 0..3 {
                x[i][a] += step[a] * direction[i][a];
                residual[i][a] -= step[a] * image[a];
            }
        }
        let next = dots(&residual, &residual);
        for (direction, residual) in direction.iter_mut().zip(&residual) {
            for a in (0..3).filter(|&a| open[a]) {
                direction[a] = residual[a] + next[a] / square[a] * direction[a];
            }
        }
        square = next;
    }
    x
}

fn dots(x: &[[f64; 3]], y: &[[f64; 3]]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (x, y) in x.iter().zip(y) {
        (0..3).for_each(|a| sum[a] += x[a] * y[a]);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_discrete_parabola_solves_the_path() {
        // -u'' = 2 with u = 0 beyond both ends: u_i = (i + 1)(n - i).
        let n = 50;
        let second_difference = |x: &[[f64; 3]]| {
            let at = |i: usize, a: usize| x.get(i).map_or(0.0, |x| x[a]);
            let row =
                |i: usize| std::array::from_fn(|a| 2.0 * at(i, a) - at(i.wrapping_sub(1), a) - at(i + 1, a));
            (0..n).map(row).collect()
        };
        let x = conjugate_gradients(second_difference, vec![[2.0, 0.0, -1.0]; n]);
        for (i, x) in x.iter().enumerate() {
            let exact = (i + 1) as f64 * (n - i) as f64;
            let off = [x[0] - exact, x[1], x[2] + 0.5 * exact];
            assert!(off.iter().all(|e| e.abs() < 1e-8), "{i} {off:?}");
        }
    }
}
