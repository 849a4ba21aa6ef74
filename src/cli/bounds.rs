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

    /// The box around both.
    pub fn with(&self, other: &Self) -> Self {
        Self {
            low: std::array::from_fn(|k| self.low[k].min(other.low[k])),
            high: std::array::from_fn(|k| self.high[k].max(other.high[k])),
        }
    }

    /// Larger by so much on each side.
    pub fn grown(&self, by: f64) -> Self {
        Self {
            low: self.low.map(|x| x - by),
            high: self.high.map(|x| x + by),
        }
    }

    /// Whether the box around these points has a point of this one.
    pub fn meets(&self, points: [[f64; 3]; 3]) -> bool {
        (0..3).all(|k| {
            let reaches =
                |is_beyond: fn(f64, f64) -> bool, end: f64| points.iter().any(|p| is_beyond(p[k], end));
            reaches(|x, low| x >= low, self.low[k]) && reaches(|x, high| x <= high, self.high[k])
        })
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

    #[test]
    fn a_triangle_that_reaches_into_a_box_meets_it() {
        let positions = [[0.0; 3], [1.0, 2.0, 3.0]];
        let bounds = Bounds::of(&positions, &[[0, 0, 1]]).grown(0.5);
        assert_eq!((bounds.low, bounds.high), ([-0.5; 3], [1.5, 2.5, 3.5]));
        let corner = [[1.4, 2.4, 3.4], [9.0; 3], [9.0, 9.0, 8.0]];
        assert!(bounds.meets(corner));
        assert!(!bounds.meets(corner.map(|p| p.map(|x| x + 0.2))));
        let across = [[-9.0, 0.0, 0.0], [9.0, 0.0, 0.0], [9.0, 1.0, 0.0]];
        assert!(bounds.meets(across));
    }
}
