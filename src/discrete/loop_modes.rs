//! Smooth functions along a closed curve: the eigenfunctions of its Laplacian, `1, cos(k s), sin(k s)` by its length `s` from 0 to 2 pi.

use std::f64::consts::TAU;

use nalgebra::Vector3;

/// The lowest modes of a loop, orthonormal in the lengths that belong to its vertices.
#[derive(Debug, Clone)]
pub(crate) struct LoopModes {
    /// The length from the first vertex to each, where the whole is 2 pi.
    pub angle: Vec<f64>,
    /// Half of both edges at each vertex, as a part of the whole.
    pub share: Vec<f64>,
    /// Mode after mode, a value for each vertex.
    pub modes: Vec<Vec<f64>>,
}

impl LoopModes {
    /// So many modes (an odd number) of the closed polygon.
    pub(crate) fn new(polygon: &[Vector3<f64>], count: usize) -> Self {
        let n = polygon.len();
        let edges: Vec<f64> = (0..n)
            .map(|k| (polygon[(k + 1) % n] - polygon[k]).norm())
            .collect();
        let length = edges.iter().sum::<f64>().max(f64::MIN_POSITIVE);
        let share = (0..n).map(|k| 0.5 * (edges[k] + edges[(k + n - 1) % n]) / length);
        let mut angle = vec![0.0; n];
        for k in 1..n {
            angle[k] = angle[k - 1] + TAU * edges[k - 1] / length;
        }
        Self::at(angle, share.collect(), count)
    }

    /// The same modes at vertices beside the loop, which have the angles of vertices of it, in any order.
    pub(crate) fn beside(&self, angle: Vec<f64>) -> Self {
        let mut turns = angle.clone();
        turns.sort_unstable_by(f64::total_cmp);
        let share = |a: &f64| {
            let same = turns.partition_point(|t| t < a)..turns.partition_point(|t| t <= a);
            let before = match same.start {
                0 => turns[turns.len() - 1] - TAU,
                first => turns[first - 1],
            };
            let after = turns.get(same.end).copied().unwrap_or(turns[0] + TAU);
            0.5 * (after - before) / TAU / same.len() as f64
        };
        let share = angle.iter().map(share).collect();
        Self::at(angle, share, self.modes.len())
    }

    fn at(angle: Vec<f64>, share: Vec<f64>, count: usize) -> Self {
        let mut this = Self {
            angle,
            share,
            modes: Vec::with_capacity(count),
        };
        for m in 0..count {
            let wave = m.div_ceil(2) as f64;
            let value = |a: &f64| {
                if m % 2 == 1 {
                    libm::cos(wave * a)
                } else {
                    libm::sin(wave * a)
                }
            };
            let mode = if m == 0 {
                vec![1.0; this.angle.len()]
            } else {
                this.angle.iter().map(value).collect()
            };
            this.add(mode);
        }
        this
    }

    /// Gram-Schmidt: with edges of different lengths the waves are not quite orthogonal.
    fn add(&mut self, mut mode: Vec<f64>) {
        for _ in 0..2 {
            for other in &self.modes {
                let part = self.product(other, &mode);
                mode.iter_mut().zip(other).for_each(|(m, o)| *m -= part * o);
            }
        }
        let norm = self.product(&mode, &mode).sqrt().max(f64::MIN_POSITIVE);
        mode.iter_mut().for_each(|m| *m /= norm);
        self.modes.push(mode);
    }

    /// The mean of a product along the loop.
    pub(crate) fn product(&self, a: &[f64], b: &[f64]) -> f64 {
        let vertices = a.iter().zip(b).zip(&self.share);
        vertices.map(|((a, b), share)| a * b * share).sum()
    }

    /// The parts of the modes in a function.
    pub(crate) fn parts(&self, f: &[f64]) -> Vec<f64> {
        self.modes.iter().map(|mode| self.product(mode, f)).collect()
    }

    /// The function with these parts.
    pub(crate) fn sum(&self, parts: &[f64]) -> Vec<f64> {
        let mut sum = vec![0.0; self.share.len()];
        for (mode, part) in self.modes.iter().zip(parts) {
            sum.iter_mut().zip(mode).for_each(|(sum, m)| *sum += part * m);
        }
        sum
    }

    /// The squares of parts, of both waves of a length together.
    pub(crate) fn energies(parts: &[f64]) -> Vec<f64> {
        let square = |m: usize| parts.get(m).map_or(0.0, |p| p * p);
        let of_pair = |m: usize| match m {
            0 => square(0),
            _ => square(m - 1 + m % 2) + square(m + m % 2),
        };
        (0..parts.len()).map(of_pair).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_modes_are_orthonormal_and_reproduce_waves() {
        let at = |k: i32| TAU * (f64::from(k) + 0.3 * f64::from(k).sin()) / 40.0;
        let polygon: Vec<_> = (0..40)
            .map(|k| Vector3::new(at(k).cos(), at(k).sin(), 0.0))
            .collect();
        let modes = LoopModes::new(&polygon, 9);
        for (i, a) in modes.modes.iter().enumerate() {
            for (j, b) in modes.modes.iter().enumerate() {
                let product = modes.product(a, b);
                assert_near!(product, f64::from(u8::from(i == j)), 1e-12);
            }
        }
        let wave: Vec<f64> = (0..40).map(|k| 0.3 + (2.0 * at(k)).cos()).collect();
        let projected = modes.sum(&modes.parts(&wave));
        let error = projected.iter().zip(&wave).map(|(a, b)| (a - b).abs());
        assert_below!(error.fold(0.0, f64::max), 0.01);
    }
}
