//! The membrane of a region: what its boundary alone makes of it.

use std::sync::Arc;

use fairmesh_linear::cholesky::{Cholesky, SolveWork};
use fairmesh_linear::ordering::fill_reducing;
use fairmesh_linear::symbolic::Symbolic;
use nalgebra::Vector3;

use super::rings::Rings;

/// Moves every free vertex but those that are placed to the mean of its neighbours; `None` where that is not determined.
pub(crate) fn membrane(
    rings: &Rings,
    x: &mut [Vector3<f64>],
    is_placed: impl Fn(usize) -> bool,
) -> Option<()> {
    let free = rings.free();
    let graph = rings.graph();
    let order = fill_reducing(&graph, &graph, 1, None);
    let mut factor = Cholesky::<f64>::new(Arc::new(Symbolic::new(&graph, &order)));
    let mut values = vec![-1.0; graph.column.len()];
    for v in 0..free {
        let row = graph.start[v]..graph.start[v + 1];
        for k in row
            .clone()
            .filter(|&k| is_placed(v) || is_placed(graph.column[k] as usize))
        {
            values[k] = 0.0;
        }
        values[row.end - 1] = if is_placed(v) {
            1.0
        } else {
            rings.ring(v).len() as f64
        };
    }
    factor.factor(&values).ok()?;
    let is_fixed = |w: usize| w >= free || is_placed(w);
    let fixed = |v: usize| rings.ring(v).iter().filter(|w| is_fixed(**w as usize));
    let right = |v: usize| match is_placed(v) {
        true => x[v],
        false => fixed(v).map(|&w| x[w as usize]).sum(),
    };
    let mut solution: Vec<[f64; 3]> = (0..free).map(|v| right(v).into()).collect();
    factor.solve(&mut solution, &mut SolveWork::default());
    for (x, p) in x.iter_mut().zip(&solution) {
        *x = (*p).into();
    }
    Some(())
}
