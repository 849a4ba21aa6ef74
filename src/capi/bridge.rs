//! Bridges between two runs of boundary edges.

use std::sync::Arc;

use super::fill_options::FillOptionsIn;
use super::guard::{guarded, point};
use super::input::{IndicesIn, MeshIn};
use super::memory_bounds;
use super::option_structs::{fairmesh_bridge_options, fairmesh_fill_options, fairmesh_options};
use super::options::{OptionsIn, refused};
use super::outputs::publish;
use super::patch_sizes;
use super::results::Content;
use super::status::*;
use super::types::*;
use super::views::*;
use fairmesh::{
    BoundaryLoop, BridgeOptions, FillOptions, Join, Loops, Progress, Rim, boundary_loops_joined,
    bridge_with_progress,
};

/// Connects two runs of boundary edges by a strip that is tangent to the mesh at both, and faired. Each chain is given by its vertices,
/// one after the other, in either direction: at least two, or one if the options have a width. They may be on one loop or on two.
///
/// `bridge`, `fill` and `options` may be NULL; of `fill` the loops, groups, guides and `relax_rim` are not looked at. `result` gets a handle, whose
/// reports count on from that of the strip, 0, to those of the holes beside it; with `loop_count` of the info
/// `fairmesh_result_report` tells how the fairing of all that is new together went. Free it.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_bridge(
    mesh: *const fairmesh_mesh,
    from: *const fairmesh_indices,
    to: *const fairmesh_indices,
    bridge: *const fairmesh_bridge_options,
    fill: *const fairmesh_fill_options,
    options: *const fairmesh_options,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, || {
        let mut aliases = AliasCheck::new();
        let mesh = MeshIn::new(mesh, Argument(1), &mut aliases)?;
        check_pointer(from, Argument(2))?;
        let from = IndicesIn::optional(from, Argument(2), &mut aliases)?;
        check_pointer(to, Argument(3))?;
        let to = IndicesIn::optional(to, Argument(3), &mut aliases)?;
        let bridge = read_bridge_options(bridge, Argument(4), &mut aliases)?;
        let fill = FillOptionsIn::new(fill, Argument(5), &mut aliases)?;
        let asked = OptionsIn::new(options, Argument(6), mesh.vertices(), &mut aliases)?;
        check_slot(result, Argument(7), &mut aliases)?;
        aliases.error(error, Argument(8))?;

        let options = asked.read(mesh.vertices(), mesh.coincident)?;
        let positions = mesh.positions.read()?;
        let triangles = mesh.triangles.rows::<3>()?;
        let chains = [from, to].map(|list| list.map(|list| list.read()).transpose());
        let [from, to] = chains;
        let (from, to) = (from?, to?);
        let chain = |list: &Option<std::borrow::Cow<'_, [[u32; 1]]>>| -> Vec<u32> {
            list.as_deref()
                .map_or_else(Vec::new, |rows| rows.as_flattened().to_vec())
        };
        let chains = [chain(&from), chain(&to)];
        let filling = FillOptions {
            loops: Loops::Chosen(Vec::new()),
            join: Join::None,
            guides: Vec::new(),
            rim: Rim::default(),
            ..fill.read(options)?
        };
        let callback = asked.callback.fresh();
        let sizes = {
            let _reserve = memory_bounds::reserve(memory_bounds::of_whole_mesh(&mesh, 1))?;
            let loops = boundary_loops_joined(&positions, &triangles, mesh.coincident)?;
            let group = loops_of(&loops, &chains);
            let as_joined = FillOptions {
                join: Join::Groups(vec![group]),
                ..filling.clone()
            };
            callback.memory()?;
            patch_sizes::sizes(&positions, &loops, &as_joined)?.limited(filling.max_new_vertices)
        };
        let bytes = memory_bounds::of_filling(&mesh, &sizes, &asked, false);
        let _reserve = memory_bounds::reserve(bytes)?;
        point();
        let bridge = BridgeOptions { filling, ..bridge };
        let mut tell = |progress: &Progress| callback.tell(progress);
        let chains = [&chains[0][..], &chains[1]];
        let bridged = bridge_with_progress(&positions, &triangles, chains, &bridge, &mut tell)?;
        callback.memory()?;
        let content = Content::Bridged {
            bridged,
            vertices: positions.len(),
            triangles: triangles.len(),
        };
        publish(Arc::new(content), result, &callback)
    })
}

fn read_bridge_options(
    options: *const fairmesh_bridge_options,
    argument: Argument,
    aliases: &mut AliasCheck,
) -> CallResult<BridgeOptions> {
    if options.is_null() {
        return Ok(BridgeOptions::default());
    }
    let view = read_struct(options, argument)?;
    aliases.input(options, size_of::<fairmesh_bridge_options>());
    let asked = view.read_bridge_options(argument)?;
    asked
        .validate()
        .map_err(|error| refused(error, argument, fairmesh_bridge_options::place))?;
    Ok(asked)
}

/// The loops that vertices of the chains are on.
fn loops_of(loops: &[BoundaryLoop], chains: &[Vec<u32>; 2]) -> Vec<usize> {
    let named = |v: &u32| chains.iter().any(|chain| chain.contains(v));
    (0..loops.len())
        .filter(|&l| loops[l].vertices.iter().any(named))
        .collect()
}
