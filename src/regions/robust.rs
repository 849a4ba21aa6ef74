//! A linear function fitted to values of which some belong to something else.

use nalgebra::{Matrix4, Vector3, Vector4};

use crate::discrete::trace::RIDGE;

/// How often the weights of a fit are made anew.
/// Of 5 cases, half: 1 changes; double: none changes.
const PASSES: usize = 8;
/// Tukey's biweight: what is so many times the scatter off has no weight.
/// Half or double, of 5 cases: 2 change.
const BIWEIGHT: f64 = 4.685;
/// From the median of magnitudes to the standard deviation of a normal distribution.
const TO_DEVIATION: f64 = 1.4826;

/// `a + b . x` at places.
#[derive(Debug, Clone, Copy)]
pub(super) struct Linear(Vector4<f64>);

impl Linear {
    /// Fits it (iterated least squares, Tukey's biweight), and returns it with the scatter of what is left.
    pub(super) fn fit(places: &[Vector3<f64>], values: &[f64]) -> (Self, f64) {
        let mut of = Self(Vector4::new(median(values), 0.0, 0.0, 0.0));
        let mut scatter = of.scatter(places, values);
        for _ in 0..PASSES {
            if scatter == 0.0 {
                break;
            }
            let (mut matrix, mut right) = (Matrix4::zeros(), Vector4::zeros());
            for (x, value) in places.iter().zip(values) {
                let off = (value - of.at(x)) / (BIWEIGHT * scatter);
                let weight = (1.0 - off * off).max(0.0).powi(2);
                let row = Vector4::new(1.0, x.x, x.y, x.z);
                matrix += row * row.transpose() * weight;
                right += row * (value * weight);
            }
            // For directions in which the places do not differ.
            matrix += Matrix4::identity() * (RIDGE * matrix.trace());
            let Some(factor) = matrix.cholesky() else { break };
            of = Self(factor.solve(&right));
            scatter = of.scatter(places, values);
        }
        (of, scatter)
    }

    pub(super) fn at(&self, x: &Vector3<f64>) -> f64 {
        self.0[0] + self.0.fixed_rows::<3>(1).dot(x)
    }

    /// The standard deviation of what is off, by the median.
    pub(super) fn scatter(&self, places: &[Vector3<f64>], values: &[f64]) -> f64 {
        let off = places
            .iter()
            .zip(values)
            .map(|(x, value)| (value - self.at(x)).abs());
        TO_DEVIATION * median(&off.collect::<Vec<f64>>())
    }
}

/// The value in the middle, 0 of none.
pub(super) fn median(values: &[f64]) -> f64 {
    quantile(values, 0.5)
}

/// The value that such a part of the others is below, 0 of none.
pub(super) fn quantile(values: &[f64], part: f64) -> f64 {
    let mut values = values.to_vec();
    let Some(last) = values.len().checked_sub(1) else {
        return 0.0;
    };
    let at = (part * last as f64) as usize;
    *values.select_nth_unstable_by(at, f64::total_cmp).1
}
