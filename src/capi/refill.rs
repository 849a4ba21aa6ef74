//! Regions deleted and filled.

use super::fill_options::FillOptionsIn;
use super::guard::guarded;
use super::input::{MeshIn, SelectedBy, SelectionIn};
use super::memory_bounds;
use super::option_structs::{fairmesh_fill_options, fairmesh_options};
use super::options::OptionsIn;
use super::outputs::{ResultOut, with_memory};
use super::patch_sizes::{self, PatchSizes};
use super::results::Content;
use super::status::*;
use super::types::*;
use super::views::*;
use fairmesh::{FillOptions, Join, Loops, boundary_loops_joined, refill_region_with_progress};

use fairmesh_status as Status;

/// Deletes a region, and fills the loops that are left, those of each component of the region with one patch: where the shape that it has is of no
/// use, such as an ear of many vertices behind a short boundary. The result is read like that of `fairmesh_remesh`; its new vertices are fair
/// already.
///
/// NO_FAIR_PATCH where that leads to no fair patch that intersects nothing, where a vertex would be lost that is fixed (inside the region, or
/// without another triangle), where the region lies at a boundary of the mesh, and where the run was stopped.
///
/// `selection`, `fill` and `options` may be NULL; of `fill` the loops, groups and guides are not looked at. `result` gets a handle; free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_refill(
    mesh: *const fairmesh_mesh,
    selection: *const fairmesh_selection,
    fill: *const fairmesh_fill_options,
    options: *const fairmesh_options,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, |call| {
        let mesh = MeshIn::new(mesh, Argument(1), call)?;
        let selection = SelectionIn::new(selection, Argument(2), &mesh, call)?;
        let fill = FillOptionsIn::new(fill, Argument(3), call)?;
        let asked = OptionsIn::new(options, Argument(4), &mesh, call)?;
        let result = ResultOut::last(result, Argument(5), call)?;

        let selected = selection.read(&mesh)?;
        let (positions, triangles) = mesh.read()?;
        let filling = FillOptions {
            loops: Loops::Chosen(Vec::new()),
            join: Join::None,
            guides: Vec::new(),
            ..fill.read(asked.read(&mesh)?)?
        };
        let look = memory_bounds::of_whole_mesh(&mesh, 1);
        let sizes = with_memory(look, &asked.callback, |_| {
            sizes_of(&mesh, &selected, &positions, &triangles, &filling)
        })?;
        let sizes = sizes.limited(filling.max_new_vertices);
        let bytes = memory_bounds::of_filling(&mesh, &sizes, &asked, filling.rim.relax > 0);
        result.put(bytes.saturating_add(look), &asked.callback, |tell| {
            let selection = selected.selection();
            refill_region_with_progress(&positions, &triangles, selection, &filling, tell)?
                .map(Content::from)
                .ok_or_else(|| {
                    let why = format_args!(
                        "deleted and filled, the region gets no fair patch that intersects nothing"
                    );
                    Failure::new(Status::NoFairPatch, why)
                })
        })
    })
}

/// How large the patches will be, as if all loops that the region leaves were joined.
fn sizes_of(
    mesh: &MeshIn,
    selected: &SelectedBy,
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    filling: &FillOptions,
) -> CallResult<PatchSizes> {
    let free = selected.candidates(mesh)?;
    let is_free = |v: u32| free.get(v as usize).copied().unwrap_or(false);
    let mut beside = try_with_capacity(free.len())?;
    beside.resize(free.len(), false);
    let mut left = try_with_capacity(triangles.len())?;
    for t in triangles {
        match t.iter().any(|&v| is_free(v)) {
            false => left.push(*t),
            // What is out of range is found later.
            true => (t.iter()).for_each(|&v| beside.get_mut(v as usize).into_iter().for_each(|b| *b = true)),
        }
    }
    // What is wrong is found later, and told by its number in the whole mesh.
    let Ok(loops) = boundary_loops_joined(positions, &left, mesh.coincident) else {
        return Ok(PatchSizes::default());
    };
    let mut group = try_with_capacity(loops.len())?;
    let is_beside = |l: &usize| loops[*l].vertices.iter().any(|&v| beside[v as usize]);
    group.extend((0..loops.len()).filter(is_beside));
    let asked = match group.len() {
        1 => FillOptions {
            loops: Loops::Chosen(group),
            ..filling.clone()
        },
        _ => FillOptions {
            join: Join::Groups(vec![group]),
            ..filling.clone()
        },
    };
    patch_sizes::sizes(positions, &loops, &asked)
}
