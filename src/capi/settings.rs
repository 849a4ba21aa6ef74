//! The options that a solver can be asked for anew.

use super::choices::choice_of;
use super::input::{CurvatureIn, LoopsIn, NormalsIn};
use super::option_structs::fairmesh_options;
use super::options::target;
use super::status::CallResult;
use super::views::{Argument, Call, field};
use fairmesh::{BoundaryCurvature, BoundaryNormals, Target};

/// What `fairmesh_solver_set` changes.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_setting {
    /// The field `boundary_normals`.
    BoundaryNormals = 0,
    /// The fields `continuity` and `loop_continuity`.
    Continuity = 1,
    /// The field `boundary_curvature`.
    BoundaryCurvature = 2,
    /// The field `target`.
    Target = 3,
}

choice_of!(fairmesh_setting: BoundaryNormals Continuity BoundaryCurvature Target);

/// A setting, checked; arrays in it not read.
pub(crate) enum Setting {
    Normals(NormalsIn),
    Continuity(LoopsIn),
    Curvature(CurvatureIn),
    Target(Target),
}

/// The same for the library.
pub(crate) enum Change {
    Normals(BoundaryNormals),
    Continuity(f64, Vec<(u32, f64)>),
    Curvature(BoundaryCurvature),
    Target(Target),
}

impl Setting {
    /// Of options that are the third argument.
    pub(crate) fn new(
        which: fairmesh_setting,
        view: &fairmesh_options,
        vertices: usize,
        call: &mut Call,
    ) -> CallResult<Self> {
        let at = Argument(3);
        Ok(match which {
            fairmesh_setting::BoundaryNormals => {
                let place = field!(at, fairmesh_options.boundary_normals);
                Self::Normals(NormalsIn::new(&view.boundary_normals, place, vertices, call)?)
            }
            fairmesh_setting::Continuity => {
                let place = field!(at, fairmesh_options.loop_continuity);
                Self::Continuity(LoopsIn::new(&view.loop_continuity, place, call)?)
            }
            fairmesh_setting::BoundaryCurvature => {
                let place = field!(at, fairmesh_options.boundary_curvature);
                Self::Curvature(CurvatureIn::new(&view.boundary_curvature, place, vertices, call)?)
            }
            fairmesh_setting::Target => {
                Self::Target(target(&view.target, field!(at, fairmesh_options.target))?)
            }
        })
    }

    pub(crate) fn read(&self, view: &fairmesh_options, vertices: usize) -> CallResult<Change> {
        Ok(match self {
            Self::Normals(normals) => Change::Normals(normals.read(vertices)?),
            Self::Continuity(of_loops) => Change::Continuity(view.continuity, of_loops.read(vertices)?),
            Self::Curvature(curvature) => Change::Curvature(curvature.read(vertices)?),
            Self::Target(target) => Change::Target(*target),
        })
    }
}
