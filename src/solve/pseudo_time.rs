//! Pseudo-time: the flow `(4A/3) dq/dt = R1` in implicit steps, `(P + (4A/3) / tau) t = R1` with `P` made anew each step,
//! for starts from which the iteration itself diverges.

use nalgebra::Vector3;

use super::control::Control;
use super::system::{Collapsed, System, advance};

/// First and last step size, in diagonals to the fourth.
const TAU: [f64; 2] = [1e-4, 100.0];
/// The edge-relative change that the step size is steered to.
const AIM: f64 = 0.21;
/// Over this change a step is shortened, and for the normal part the step size cut.
const LARGEST: f64 = 0.3;
/// Steps at most.
const STEPS: usize = 60;

/// Follows the flow from `x`. Returns whether the end of the flow was reached.
pub(crate) fn pseudo_time(
    system: &mut System<'_>,
    x: &mut [Vector3<f64>],
    control: &mut Control<'_>,
) -> Result<bool, Collapsed> {
    let mut step = vec![0.0; 3 * system.free()];
    let unit = system.diagonal.powi(4);
    let mut tau = TAU[0];
    let mut next = x.to_vec();
    for _ in 0..STEPS {
        system.evaluate(x);
        let area = system.state.area.clone();
        system.rebuild(x, true, |i| area[i] * 4.0 / (3.0 * tau * unit))?;
        let d = system.step(&mut step, true).total();
        control.iteration(d, "pseudo-time");
        control.show(system, x, d);
        if !d.is_finite() {
            return Err(Collapsed);
        }
        if control.exhausted() {
            return Ok(false);
        }
        system.normal_step(&mut step);
        let change = system.edge_change(x, &step);
        advance(&mut next, &step, (LARGEST / change).min(1.0));
        tau *= if change > LARGEST {
            (LARGEST / change).max(0.1)
        } else {
            (AIM / change).clamp(1.0, 8.0)
        };
        system.tangential_step(&mut step);
        let change = system.edge_change(x, &step);
        advance(&mut next, &step, (LARGEST / change).min(1.0));
        x.copy_from_slice(&next);
        if tau > TAU[1] {
            return Ok(true);
        }
        if tau < TAU[0] * 1e-8 {
            return Ok(false);
        }
    }
    Ok(false)
}
