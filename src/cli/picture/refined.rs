//! Large triangles divided where they lie, so that what is painted by numbers at their corners shows what is inside, too.

/// At most so many parts along the longest edge of a triangle.
const MOST: f64 = 64.0;

/// The same surface; its vertices come first.
pub struct Refined {
    pub positions: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
    /// Per triangle the one that it is a part of.
    pub part_of: Vec<u32>,
}

impl Refined {
    /// Divides triangles with edges longer than this, of those that are chosen.
    pub fn new(
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        is_chosen: impl Fn(usize) -> bool,
        longest: f64,
    ) -> Self {
        let mut refined = Self {
            positions: positions.to_vec(),
            triangles: Vec::with_capacity(triangles.len()),
            part_of: Vec::with_capacity(triangles.len()),
        };
        for (t, corners) in triangles.iter().enumerate() {
            let x = corners.map(|v| positions[v as usize]);
            let edge = |k: usize| {
                let squares = (0..3).map(|axis| (x[(k + 1) % 3][axis] - x[k][axis]).powi(2));
                squares.sum::<f64>().sqrt()
            };
            let most = (0..3).map(edge).fold(0.0, f64::max);
            let parts = (most / longest).ceil();
            // Not finite, or nothing to be measured by: as it is.
            match is_chosen(t) && parts > 1.0 && parts.is_finite() {
                true => refined.divide(*corners, x, parts.min(MOST) as usize),
                false => refined.triangles.push(*corners),
            }
            refined.part_of.resize(refined.triangles.len(), t as u32);
        }
        refined
    }

    /// Adds n² equal parts of a triangle. Points on its edges are its own, not its neighbours'.
    fn divide(&mut self, corners: [u32; 3], x: [[f64; 3]; 3], n: usize) {
        let mut rows: Vec<Vec<u32>> = Vec::with_capacity(n + 1);
        for j in 0..=n {
            let row = (0..=n - j).map(|i| match (i, j) {
                (0, 0) => corners[0],
                _ if i == n => corners[1],
                _ if j == n => corners[2],
                _ => {
                    let [s, t] = [i, j].map(|k| k as f64 / n as f64);
                    let at = |axis: usize| {
                        x[0][axis] + s * (x[1][axis] - x[0][axis]) + t * (x[2][axis] - x[0][axis])
                    };
                    self.positions.push([0, 1, 2].map(at));
                    self.positions.len() as u32 - 1
                }
            });
            rows.push(row.collect());
        }
        for (low, high) in rows.iter().zip(&rows[1..]) {
            for i in 0..high.len() {
                self.triangles.push([low[i], low[i + 1], high[i]]);
                if i + 1 < high.len() {
                    self.triangles.push([low[i + 1], high[i + 1], high[i]]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_cover_their_triangle_and_keep_its_corners() {
        let positions = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.1, 0.0, 1.0]];
        let triangles = [[0, 1, 2], [0, 3, 1]];
        let refined = Refined::new(&positions, &triangles, |t| t == 0, 1.0);
        // The longest edge is 3.6 long: four parts along each.
        assert_eq!(refined.triangles.len(), 16 + 1);
        assert_eq!(refined.positions[..4], positions);
        assert_eq!(refined.positions.len(), 4 + 12);
        assert_eq!(
            (refined.part_of[15], refined.part_of[16], refined.triangles[16]),
            (0, 1, [0, 3, 1])
        );
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| refined.positions[v as usize]);
            0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
        };
        for t in &refined.triangles[..16] {
            assert_near!(area(t), 3.0 / 16.0, 1e-12);
        }
        let same = Refined::new(&positions, &triangles, |_| true, f64::NAN);
        assert_eq!((same.triangles.len(), same.positions.len()), (2, 4));
    }
}
