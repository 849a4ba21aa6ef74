//! A start surface for curves inside a closed mesh: the thin plate through them.

use super::blend_start::{Neighbours, place_free};
use super::shape::Shape;
use faer::Mat;
use faer::sparse::Triplet;

/// Gives the free vertices the positions that make the sum of the squares of `q_i - mean of its neighbours`
/// smallest, over free and fixed vertices: linear fairing with uniform weights (paper 2, (3)).
pub(super) fn thin_plate(shape: &mut Shape) {
    let near = Neighbours::new(&shape.triangles, shape.positions.len());
    let free = shape.free_vertices();
    let mut unknown = vec![usize::MAX; shape.positions.len()];
    free.iter()
        .enumerate()
        .for_each(|(i, &v)| unknown[v as usize] = i);
    let mut entries = Vec::with_capacity(49 * free.len());
    let mut right = Mat::<f64>::zeros(free.len(), 3);
    for v in 0..shape.positions.len() {
        let share = -1.0 / near.of(v).len() as f64;
        let row: Vec<(usize, f64)> = std::iter::once((v, 1.0))
            .chain(near.of(v).iter().map(|&w| (w as usize, share)))
            .collect();
        let mut fixed = [0.0; 3];
        for &(w, c) in row.iter().filter(|(w, _)| !shape.free[*w]) {
            (0..3).for_each(|a| fixed[a] += c * shape.positions[w][a]);
        }
        for &(w, c) in row.iter().filter(|(w, _)| shape.free[*w]) {
            (0..3).for_each(|a| right[(unknown[w], a)] -= c * fixed[a]);
            let others = row.iter().filter(|(x, _)| shape.free[*x]);
            entries.extend(others.map(|&(x, d)| Triplet::new(unknown[w], unknown[x], c * d)));
        }
    }
    place_free(shape, free.iter().map(|&v| v as usize), &entries, &right);
    shape.flattened = shape.positions.clone();
}
