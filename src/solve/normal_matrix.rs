//! The matrix `P` of the normal step, on the free two-ring graph, with its factor.

use std::sync::Arc;

use super::bilaplacian::Metric;
use super::factor::{Factor, Stacks};
use super::system::Collapsed;
use crate::mesh::Rings;
use crate::profile::clock;
use fairmesh_linear::interrupt::Interrupt;
use fairmesh_linear::ordering::fill_reducing;
use fairmesh_linear::sparse::SymmetricPattern;
use fairmesh_linear::symbolic::Symbolic;

/// With more free vertices `P` is factored in 64 bits from the start: its condition grows with their square, and the lowest
/// modes of a 32-bit factor are then hardly right to a single digit. (With fewer, the linear start finds out.)
const SINGLE_UP_TO: usize = 250_000;

/// `P` with its factor.
pub(crate) struct NormalMatrix {
    pattern: SymmetricPattern,
    symbolic: Arc<Symbolic>,
    values: Vec<f64>,
    factor: Factor,
    interrupt: Interrupt,
}

impl NormalMatrix {
    /// Orders and analyses `P` of a region; `graph` is the free one-ring graph.
    pub(crate) fn new(rings: &Rings, graph: &SymmetricPattern) -> Self {
        let pattern = rings.two_ring_pattern();
        let order = {
            let _clock = clock("orders");
            fill_reducing(&pattern, graph, 2, None)
        };
        let _clock = clock("symbolic");
        let symbolic = Arc::new(Symbolic::new(&pattern, &order));
        Self {
            values: vec![0.0; pattern.column.len()],
            factor: Factor::new(&symbolic, pattern.order() > SINGLE_UP_TO),
            symbolic,
            pattern,
            interrupt: Interrupt::default(),
        }
    }

    /// Factorizations fail from when this is set.
    pub(crate) fn set_interrupt(&mut self, interrupt: &Interrupt) {
        self.interrupt = interrupt.clone();
        self.factor.set_interrupt(interrupt);
    }

    /// Takes the matrix of a metric, with `mass` on its diagonal, and factors it.
    pub(crate) fn factor(
        &mut self,
        metric: &Metric,
        rings: &Rings,
        mass: Option<&[f64]>,
        stacks: &mut Stacks,
    ) -> Result<(), Collapsed> {
        metric.assemble(rings, &self.pattern, mass, &mut self.values);
        let _clock = clock("factor P");
        let made = self.factor.factor(&self.values, stacks);
        if made.is_err() && !self.interrupt.is_set() {
            return self.factor_double(stacks);
        }
        made.map_err(|_| Collapsed)
    }

    /// Goes over to a 64-bit factor of the same matrix.
    pub(crate) fn factor_double(&mut self, stacks: &mut Stacks) -> Result<(), Collapsed> {
        if self.is_double() {
            return Err(Collapsed);
        }
        self.factor = Factor::new(&self.symbolic, true);
        self.factor.set_interrupt(&self.interrupt);
        let _clock = clock("factor P");
        self.factor.factor(&self.values, stacks).map_err(|_| Collapsed)
    }

    /// Whether the factor is one of 64 bits.
    pub(crate) fn is_double(&self) -> bool {
        self.factor.is_double()
    }

    /// Solves in place.
    pub(crate) fn solve<const K: usize>(&mut self, x: &mut [[f64; K]]) {
        self.factor.solve(x);
    }
}
