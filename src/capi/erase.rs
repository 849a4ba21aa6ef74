//! Triangles deleted or trimmed off, and components of a mesh.

use super::callback::HostCallback;
use super::choices::count;
use super::guard::guarded;
use super::input::{MeshIn, list_in, optional_list_in};
use super::memory_bounds;
use super::outputs::{ResultOut, of_whole_mesh};
use super::results::{Content, as_list};
use super::status::*;
use super::types::*;
use super::views::*;
use fairmesh::{
    BoundaryLoop, Error, LoopKind, TrimLimits, boundary_loops_joined, erase_and_clean, triangle_components,
    trim_boundary,
};

/// Deletes triangles, and what would hang loose where they were, so that new patches can take their place. The list KEPT_TRIANGLES of
/// the result is the mesh that is left, its vertices being those given, used or not; the list ERASED_LOOPS has the loops to be filled
/// there, or joined. `triangles` are the triangles to be deleted.
///
/// Up to `cleaned` triangles more go with them, those beside what is erased that would spoil the boundary of a patch: with an angle below 5
/// degrees, or turned by more than 100 degrees against a triangle beside them; 0: none. `cleaned_count` of the info says how many did.
/// `result` gets a handle; free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_erase(
    mesh: *const fairmesh_mesh,
    triangles: *const fairmesh_indices,
    cleaned: u64,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, |call| {
        let mesh = MeshIn::new(mesh, Argument(1), call)?;
        let erased = list_in(triangles, Argument(2), call)?;
        let result = ResultOut::last(result, Argument(4), call)?;
        let (positions, triangles) = mesh.read()?;
        let erased = erased.list()?;
        let bytes = memory_bounds::of_erasing(&mesh);
        result.put(bytes, &HostCallback::none(), |_| {
            let left = erase_and_clean(&positions, &triangles, &erased, mesh.coincident, count(cleaned))
                .map_err(|error| missing(error, fairmesh_element::Triangle))?;
            let sizes = fairmesh_info {
                vertex_count: positions.len() as u64,
                triangle_count: left.kept.len() as u64,
                loop_count: left.loops.len() as u64,
                dropped_count: left.dropped as u64,
                cleaned_count: left.cleaned as u64,
                ..fairmesh_info::default()
            };
            Ok(Content::new(fairmesh_result_kind::Erased, sizes)
                .one(fairmesh_list::KeptTriangles, left.kept)
                .one(fairmesh_list::ErasedLoops, as_list(&left.loops)))
        })
    })
}

/// What the library refuses, where a selection is of triangles or of loops.
pub(crate) fn missing(error: Error, element: fairmesh_element) -> Failure {
    match error {
        Error::SelectionOutOfRange { index, .. } => Failure::from(error).at(element, index),
        other => other.into(),
    }
}

/// Takes away triangles at boundary loops that would spoil a patch: slender ones, with an angle below 5 degrees, spikes and fins, turned by more than
/// 100 degrees against one beside them, and single triangles that hang at the others by one edge; the worst first, then those that this lays
/// bare, in no more than eight passes. No more than `most` triangles, and of no more area than `most_area` together; 0: of any area.
///
/// `loops` are the loops, as `fairmesh_boundary_loops` numbers them; it may be NULL: all holes, not the outer boundaries. The list KEPT_TRIANGLES
/// of the result is the mesh that is left, its vertices being those given, used or not; loops count anew there. `dropped_count` and
/// `dropped_area` of the info say what was taken away. `result` gets a handle; free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_trim_boundary(
    mesh: *const fairmesh_mesh,
    loops: *const fairmesh_indices,
    most: u64,
    most_area: f64,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, |call| {
        let mesh = MeshIn::new(mesh, Argument(1), call)?;
        let listed = optional_list_in(loops, Argument(2), call)?;
        if most_area.is_nan() || most_area < 0.0 {
            return Err(
                refuse!(Argument(4).itself() => BadOption, "most_area is {most_area}: it must be not negative"),
            );
        }
        let result = ResultOut::last(result, Argument(5), call)?;
        let (positions, triangles) = mesh.read()?;
        let lists = (listed.map_or(0, |list| list.count) as u64).saturating_mul(8);
        let bytes = memory_bounds::of_erasing(&mesh).saturating_add(lists);
        result.put(bytes, &HostCallback::none(), |_| {
            let loops = match listed {
                Some(list) => once_each(&list.list()?),
                None => holes(&boundary_loops_joined(&positions, &triangles, mesh.coincident)?),
            };
            let limits = TrimLimits {
                triangles: count(most),
                area: (most_area > 0.0).then_some(most_area),
            };
            let trimmed = trim_boundary(&positions, &triangles, &loops, &limits, mesh.coincident)
                .map_err(|error| missing(error, fairmesh_element::Loop))?;
            let sizes = fairmesh_info {
                vertex_count: positions.len() as u64,
                triangle_count: trimmed.kept.len() as u64,
                dropped_count: (triangles.len() - trimmed.kept.len()) as u64,
                dropped_area: trimmed.area,
                ..fairmesh_info::default()
            };
            Ok(Content::new(fairmesh_result_kind::Trimmed, sizes)
                .one(fairmesh_list::KeptTriangles, trimmed.kept))
        })
    })
}

/// The numbers of a list, none twice.
fn once_each(list: &[u32]) -> Vec<usize> {
    let mut numbers: Vec<usize> = list.iter().map(|l| *l as usize).collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

/// All loops but outer boundaries, and those that are never filled.
fn holes(loops: &[BoundaryLoop]) -> Vec<usize> {
    let is_hole = |l: &usize| loops[*l].kind == LoopKind::Hole;
    (0..loops.len()).filter(is_hole).collect()
}

/// Finds the components of a mesh: triangles that hang together by edges. They count in the order of their first triangles; the list
/// TRIANGLE_COMPONENTS of the result says of each triangle which one it is of. `result` gets a handle; free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_components(
    mesh: *const fairmesh_mesh,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, |call| {
        of_whole_mesh(mesh, result, call, |positions, triangles, coincident| {
            let of = triangle_components(positions, triangles, coincident)?;
            let sizes = fairmesh_info {
                vertex_count: positions.len() as u64,
                triangle_count: of.len() as u64,
                component_count: of.iter().max().map_or(0, |last| u64::from(*last) + 1),
                ..fairmesh_info::default()
            };
            Ok(Content::new(fairmesh_result_kind::Components, sizes)
                .one(fairmesh_list::TriangleComponents, of))
        })
    })
}
