//! Regions of a mesh chosen by place, distance and shape, step by step.

use std::ffi::c_void;

use super::callback::{HostCallback, cancelled, fairmesh_progress_fn};
use super::choices::{choice, choice_of, count};
use super::guard::guarded;
use super::input::MeshIn;
use super::memory_bounds;
use super::outputs::ResultOut;
use super::report;
use super::results::{Content, as_list};
use super::status::*;
use super::types::*;
use super::views::*;
use fairmesh::{Combine, Place, Region, RegionStep, Seed, select_region_with_progress};

use fairmesh_status as Status;

/// What a step of `fairmesh_select_region` names, or does.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_region_kind {
    /// The whole mesh.
    All = 0,
    /// The triangles of `list`.
    Triangles = 1,
    /// The triangles all of whose corners are vertices of `list`, or copies of them.
    Vertices = 2,
    /// The triangles that lie in a ball with all corners: around `point`, of radius `value`.
    Ball = 3,
    /// The triangles that lie in a box with all corners: `point` has its smallest, `vector` its largest coordinates.
    Box = 4,
    /// The triangles all of whose corners lie on a plane through `point`, or on the side that `vector` points to.
    HalfSpace = 5,
    /// The triangles all of whose corners are no further than `value` from the seed, along the surface.
    Geodesic = 6,
    /// The triangles that hang together with the seed by edges.
    Component = 7,
    /// The triangles around the seed, up to edges at which the surface bends by more than `value`, in degrees from 0 to 180.
    Patch = 8,
    /// The bump or dent at the seed: the least region whose fair surface stays what it is when the region grows, see `fairmesh_bump`; the one
    /// that reaches about as far as `value`, or at 0 the smallest. NO_BUMP where none is found.
    Bump = 9,
    /// Adds the triangles that have a vertex in common with the region so far, `rings` times.
    Grow = 32,
    /// Takes the triangles away that have a vertex in common with the rest, `rings` times.
    Shrink = 33,
    /// Takes the rest instead.
    Invert = 34,
}

/// How the triangles that a step names are combined with the region so far.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_combine {
    /// What is in any of the two.
    Add = 0,
    /// What is in the region and not named.
    Remove = 1,
    /// What is in both.
    Intersect = 2,
}

/// Where a region begins.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_seed_kind {
    /// At the point of the surface that is nearest to `point`.
    Point = 0,
    /// At a vertex, `seed_vertex`.
    Vertex = 1,
}

choice_of!(fairmesh_region_kind: All Triangles Vertices Ball Box HalfSpace Geodesic Component Patch Bump Grow Shrink Invert);
choice_of!(fairmesh_combine: Add Remove Intersect);
choice_of!(fairmesh_seed_kind: Point Vertex);

/// A step of `fairmesh_select_region`. Set it to zero first; what its kind does not need is not read. It never grows.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_region_step {
    /// A `fairmesh_region_kind`.
    pub kind: u32,
    /// A `fairmesh_combine`, where the kind names triangles.
    pub combine: u32,
    /// A `fairmesh_seed_kind`, where there is a seed.
    pub seed_kind: u32,
    /// The seed, if it is a vertex.
    pub seed_vertex: u32,
    /// The seed, if it is a point; the centre of a ball, the smallest coordinates of a box, a point of a plane.
    pub point: [f64; 3],
    /// The largest coordinates of a box, the normal of a plane.
    pub vector: [f64; 3],
    /// A radius, an angle in degrees, or about how far a bump reaches.
    pub value: f64,
    /// How many rings to grow or shrink by.
    pub rings: u64,
    /// Triangles or vertices, in any order.
    pub list: fairmesh_indices,
    /// Zero.
    pub reserved: u32,
    /// Zero.
    pub reserved_too: u32,
}

/// Chooses triangles of a mesh by place, distance and shape, step by step, beginning with none; the mesh need not be a manifold.
/// `steps` are `step_count` steps, one after the other in memory; NULL only if there are none. The list REGION_TRIANGLES of the result
/// has the triangles, REGION_COUNTS says per step how many it named by itself, or, of GROW, SHRINK and INVERT, how many there were after
/// it; `fairmesh_result_bump` tells what was taken for bumps. `progress` may be NULL; it gets `user_data`, and where it stops the call the
/// status is CANCELLED. `result` gets a handle; free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_select_region(
    mesh: *const fairmesh_mesh,
    steps: *const fairmesh_region_step,
    step_count: usize,
    progress: fairmesh_progress_fn,
    user_data: *mut c_void,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, |call| {
        let mesh = MeshIn::new(mesh, Argument(1), call)?;
        check_structs(steps, step_count, Argument(2), call, "steps")?;
        let result = ResultOut::last(result, Argument(6), call)?;
        let mut checked = try_with_capacity(step_count)?;
        for k in 0..step_count {
            let step = StepIn::new(read(steps.wrapping_add(k)), k)?;
            call.late_input(step.list.memory())?;
            checked.push(step);
        }
        let (positions, triangles) = mesh.read()?;
        let mut asked = try_with_capacity(step_count)?;
        for step in &checked {
            asked.push(step.read(&mesh)?);
        }
        let lists = checked.iter().map(|step| step.list.count);
        let listed = lists.fold(0, usize::saturating_add);
        let with_bumps = asked
            .iter()
            .any(|step| matches!(step, RegionStep::With(_, Region::Bump { .. })));
        let bytes = memory_bounds::of_selecting(&mesh, step_count, listed, with_bumps);
        result.put(bytes, &HostCallback::new(progress, user_data), |tell| {
            let region = select_region_with_progress(&positions, &triangles, &asked, mesh.coincident, tell)?;
            let region = region.ok_or_else(cancelled)?;
            let sizes = fairmesh_info {
                vertex_count: positions.len() as u64,
                triangle_count: region.triangles.len() as u64,
                ..fairmesh_info::default()
            };
            Ok(Content {
                bumps: region.bumps.iter().map(report::bump).collect(),
                ..Content::new(fairmesh_result_kind::Region, sizes)
                    .one(fairmesh_list::RegionTriangles, region.triangles)
                    .one(fairmesh_list::RegionCounts, as_list(&region.counts))
            })
        })
    })
}

/// One step, checked; its list not read.
struct StepIn {
    view: fairmesh_region_step,
    kind: fairmesh_region_kind,
    combine: Combine,
    seed: Seed,
    list: Array,
}

impl StepIn {
    fn new(view: fairmesh_region_step, number: usize) -> CallResult<Self> {
        use fairmesh_region_kind as Kind;
        let place = Argument(2).element::<fairmesh_region_step>(number, "steps");
        check_reserved(view.reserved, field!(place, fairmesh_region_step.reserved))?;
        check_reserved(
            view.reserved_too,
            field!(place, fairmesh_region_step.reserved_too),
        )?;
        let kind = choice(view.kind, field!(place, fairmesh_region_step.kind))?;
        let combine = match kind {
            Kind::Grow | Kind::Shrink | Kind::Invert => Combine::Add,
            _ => match choice(view.combine, field!(place, fairmesh_region_step.combine))? {
                fairmesh_combine::Add => Combine::Add,
                fairmesh_combine::Remove => Combine::Remove,
                fairmesh_combine::Intersect => Combine::Intersect,
            },
        };
        let begins = matches!(kind, Kind::Geodesic | Kind::Component | Kind::Patch | Kind::Bump);
        let seed_kind = || choice(view.seed_kind, field!(place, fairmesh_region_step.seed_kind));
        let seed = match begins.then(seed_kind).transpose()? {
            Some(fairmesh_seed_kind::Vertex) => Seed::Vertex(view.seed_vertex),
            _ => Seed::Point(view.point),
        };
        check_extent(kind, &view, place)?;
        let is_listed = matches!(kind, Kind::Triangles | Kind::Vertices);
        let none = fairmesh_indices::default();
        let at = field!(place, fairmesh_region_step.list);
        let list = indices_in(if is_listed { &view.list } else { &none }, 1, at)?;
        Ok(Self {
            view,
            kind,
            combine,
            seed,
            list,
        })
    }

    fn read(&self, mesh: &MeshIn) -> CallResult<RegionStep> {
        use fairmesh_region_kind as Kind;
        let (view, seed) = (&self.view, self.seed);
        let rings = count(view.rings);
        let listed = |limit, element| self.list.known(limit, element, "a step names element");
        let region = match self.kind {
            Kind::Grow => return Ok(RegionStep::Grow(rings)),
            Kind::Shrink => return Ok(RegionStep::Shrink(rings)),
            Kind::Invert => return Ok(RegionStep::Invert),
            Kind::All => Region::All,
            Kind::Triangles => Region::Triangles(listed(mesh.triangles.count, fairmesh_element::Triangle)?),
            Kind::Vertices => Region::Vertices(listed(mesh.vertices(), fairmesh_element::Vertex)?),
            Kind::Ball => Region::Within(Place::Ball {
                centre: view.point,
                radius: view.value,
            }),
            Kind::Box => Region::Within(Place::Box {
                low: view.point,
                high: view.vector,
            }),
            Kind::HalfSpace => Region::HalfSpace {
                point: view.point,
                normal: view.vector,
            },
            Kind::Geodesic => Region::Geodesic {
                seed,
                radius: view.value,
            },
            Kind::Component => Region::Component(seed),
            Kind::Patch => Region::Patch {
                seed,
                angle: view.value,
            },
            Kind::Bump => Region::Bump {
                seed,
                size: Some(view.value).filter(|size| *size != 0.0),
            },
        };
        Ok(RegionStep::With(self.combine, region))
    }
}

/// Refuses radii, angles and boxes that nothing can lie in: the caller has mistaken something.
fn check_extent(kind: fairmesh_region_kind, view: &fairmesh_region_step, place: FieldPath) -> CallResult {
    use fairmesh_region_kind as Kind;
    let value = view.value;
    let (holds, what) = match kind {
        Kind::Ball | Kind::Geodesic | Kind::Bump => (value >= 0.0, "a radius is at least 0"),
        Kind::Patch => (
            (0.0..=180.0).contains(&value),
            "an angle is from 0 to 180 degrees",
        ),
        Kind::Box => {
            let is_box = (0..3).all(|k| view.point[k] <= view.vector[k]);
            let at = field!(place, fairmesh_region_step.vector);
            let why = format_args!("the largest coordinates of a box are not less than the smallest");
            return if is_box {
                Ok(())
            } else {
                Err(at.refuse(Status::BadOption, why))
            };
        }
        _ => (true, ""),
    };
    let at = field!(place, fairmesh_region_step.value);
    if holds {
        Ok(())
    } else {
        Err(refuse!(at => BadOption, "{value}: {what}"))
    }
}
