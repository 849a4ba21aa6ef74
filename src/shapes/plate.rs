//! A start surface for curves inside a closed mesh: the thin plate through them.

use super::blend_start::Neighbours;
use super::conjugate_gradients::conjugate_gradients;
use super::shape::Shape;

/// Gives the free vertices the positions that make the sum of the squares of `q_i - mean of its neighbours`
/// smallest, over free and fixed vertices: linear fairing with uniform weights (paper 2, (3)).
pub(super) fn thin_plate(shape: &mut Shape) {
    let near = Neighbours::new(&shape.triangles, shape.positions.len());
    let free = shape.free_vertices();
    let apply = |x: &[[f64; 3]]| normal_matrix(&near, &shape.free, x);
    let mut fixed = shape.positions.clone();
    free.iter().for_each(|&v| fixed[v as usize] = [0.0; 3]);
    let right = apply(&fixed).into_iter().map(|g| g.map(|g| -g)).collect();
    let solution = conjugate_gradients(apply, right);
    free.iter()
        .for_each(|&v| shape.positions[v as usize] = solution[v as usize]);
    shape.flattened = shape.positions.clone();
}

/// `M^T M x` at the free vertices, zero at the others, with `(M x)_i = x_i - mean of its neighbours`.
fn normal_matrix(near: &Neighbours, free: &[bool], x: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let n = x.len();
    let off: Vec<[f64; 3]> = (0..n)
        .map(|v| {
            let mean = near.mean(x, v);
            std::array::from_fn(|a| x[v][a] - mean[a])
        })
        .collect();
    let shares: Vec<[f64; 3]> = (0..n)
        .map(|v| off[v].map(|x| x / near.of(v).len() as f64))
        .collect();
    let mut image = vec![[0.0; 3]; n];
    for v in (0..n).filter(|&v| free[v]) {
        image[v] = off[v];
        for &w in near.of(v) {
            (0..3).for_each(|a| image[v][a] -= shares[w as usize][a]);
        }
    }
    image
}
