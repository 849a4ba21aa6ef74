//! The box around triangles.

/// Its smallest and largest coordinates; infinite around nothing.
pub struct Bounds {
    pub low: [f64; 3],
    pub high: [f64; 3],
}

impl Bounds {
    /// Vertices that no triangle has do not count.
    pub fn of<'a>(positions: &[[f64; 3]], triangles: impl IntoIterator<Item = &'a [u32; 3]>) -> Self {
        let (low, high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        let mut bounds = Self { low, high };
        for &v in triangles.into_iter().flatten() {
            let p = &positions[v as usize];
            bounds.low = std::array::from_fn(|k| bounds.low[k].min(p[k]));
            bounds.high = std::array::from_fn(|k| bounds.high[k].max(p[k]));
        }
        bounds
    }

    /// 0 of nothing.
    pub fn diagonal(&self) -> f64 {
        let sides = (0..3).map(|k| self.high[k] - self.low[k]);
        let length = sides.fold(0.0, f64::hypot);
        match self.low[0] <= self.high[0] && length.is_finite() {
            true => length,
            false => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn around_what_triangles_have() {
        let positions = [[0.0; 3], [3.0, 0.0, 0.0], [0.0, 4.0, 12.0], [99.0; 3]];
        let bounds = Bounds::of(&positions, &[[0, 1, 2]]);
        assert_eq!((bounds.low, bounds.high), ([0.0; 3], [3.0, 4.0, 12.0]));
        assert_eq!(bounds.diagonal(), 13.0);
        assert_eq!(Bounds::of(&positions, &[]).diagonal(), 0.0);
    }
}
