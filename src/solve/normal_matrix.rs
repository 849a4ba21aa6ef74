//! The matrix `P` of the normal step, ready to be solved with: factored itself, or by way of the simply supported plate.

use std::sync::Arc;

use nalgebra::Vector3;

use super::bilaplacian::Metric;
use super::factor::Collapsed;
use super::factor::{Factor, Stacks};
use super::plate::Plate;
use crate::mesh::Rings;
use crate::mesh::graded::GradedMesh;
use crate::support::profile::clock;
use fairmesh_linear::cholesky::NotPositiveDefinite;
use fairmesh_linear::interrupt::is_stopped;
use fairmesh_linear::ordering::fill_reducing;
use fairmesh_linear::sparse::SymmetricPattern;
use fairmesh_linear::symbolic::Symbolic;

/// With more free vertices `P` is factored in 64 bits from the start: its condition grows with their square, and the lowest
/// modes of a 32-bit factor are then hardly right to a single digit. With fewer, the linear start finds out.
/// Half or double, of 128 cases: none changes.
const SINGLE_UP_TO: usize = 250_000;

/// From this number of free vertices on the plate is used: with fewer it takes longer, here a tenth, and the memory that it saves is little.
/// Half or double, of 128 cases: none changes.
const PLATE_FROM: usize = 90_000;

/// How `P` is solved with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Means {
    /// By its factor, on the two-ring graph.
    Factor,
    /// By the plate, where nothing forbids it.
    Plate,
}

impl Means {
    /// What is best for a region of so many free vertices.
    pub(crate) fn of(free: usize) -> Self {
        if free < PLATE_FROM {
            Self::Factor
        } else {
            Self::Plate
        }
    }
}

/// `P`, solved with by its factor where that is there, else by the plate.
pub(crate) struct NormalMatrix {
    factored: Option<FactoredMatrix>,
    plate: Option<Plate>,
}

impl NormalMatrix {
    /// `P` on the two-ring graph of a region.
    pub(crate) fn by_factor(rings: &Rings, graph: &SymmetricPattern) -> Self {
        Self {
            factored: Some(FactoredMatrix::new(rings, graph)),
            plate: None,
        }
    }

    /// `P` by the plate; `symbolic` is that of the free one-ring graph.
    pub(crate) fn by_plate(mesh: GradedMesh, rings: &Rings, symbolic: &Arc<Symbolic>) -> Self {
        Self {
            factored: None,
            plate: Some(Plate::new(mesh, rings, symbolic)),
        }
    }

    /// Takes the matrix of a metric, that of the surface `x` or of connectivity.
    /// `graph` is the free one-ring graph.
    pub(crate) fn factor(
        &mut self,
        metric: &Metric,
        rings: &Rings,
        x: Option<&[Vector3<f64>]>,
        graph: &SymmetricPattern,
        stacks: &mut Stacks,
    ) -> Result<(), Collapsed> {
        if let Some(plate) = &mut self.plate {
            let made = plate.factor(metric, rings, x, graph, &mut stacks.single);
            if made.is_ok() {
                self.factored = None;
                return Ok(());
            }
            if is_stopped() {
                return Err(Collapsed);
            }
            // The next surface is not far from this one.
            self.plate = None;
        }
        let factored = self.factored_matrix(rings, graph);
        metric.assemble(rings, &factored.pattern, &mut factored.values);
        let made = factored.factor(stacks);
        if made.is_err() && !is_stopped() {
            return self.factor_double(metric, rings, graph, stacks);
        }
        made.map_err(|_| Collapsed)
    }

    /// Goes over to a 64-bit factor of the same matrix.
    pub(crate) fn factor_double(
        &mut self,
        metric: &Metric,
        rings: &Rings,
        graph: &SymmetricPattern,
        stacks: &mut Stacks,
    ) -> Result<(), Collapsed> {
        if self.is_double() {
            return Err(Collapsed);
        }
        let factored = self.factored_matrix(rings, graph);
        metric.assemble(rings, &factored.pattern, &mut factored.values);
        factored.factor = Factor::new(&factored.symbolic, true);
        factored.factor(stacks).map_err(|_| Collapsed)
    }

    fn factored_matrix(&mut self, rings: &Rings, graph: &SymmetricPattern) -> &mut FactoredMatrix {
        self.factored
            .get_or_insert_with(|| FactoredMatrix::new(rings, graph))
    }

    /// Whether a 64-bit factor of `P` is in use.
    pub(crate) fn is_double(&self) -> bool {
        self.factored.as_ref().is_some_and(|f| f.factor.is_double())
    }

    /// Whether the plate is in use.
    #[cfg(test)]
    pub(crate) fn is_by_plate(&self) -> bool {
        self.factored.is_none()
    }

    /// Solves in place.
    pub(crate) fn solve<const K: usize>(&mut self, x: &mut [[f64; K]]) {
        match (&mut self.factored, &mut self.plate) {
            (Some(factored), _) => factored.factor.solve(x),
            (None, Some(plate)) => plate.solve(x),
            (None, None) => {}
        }
    }
}

/// `P` with its factor.
struct FactoredMatrix {
    pattern: SymmetricPattern,
    symbolic: Arc<Symbolic>,
    values: Vec<f64>,
    factor: Factor,
}

impl FactoredMatrix {
    fn new(rings: &Rings, graph: &SymmetricPattern) -> Self {
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
        }
    }

    fn factor(&mut self, stacks: &mut Stacks) -> Result<(), NotPositiveDefinite> {
        let _clock = clock("factor P");
        self.factor.factor(&self.values, stacks)
    }
}
