//! Bridges between two runs of boundary edges.

use super::fill_options::FillOptionsIn;
use super::guard::guarded;
use super::input::{MeshIn, list_in};
use super::memory_bounds;
use super::option_structs::{fairmesh_bridge_options, fairmesh_fill_options, fairmesh_options};
use super::options::{OptionsIn, refused};
use super::outputs::{ResultOut, with_memory};
use super::patch_sizes;
use super::report;
use super::results::Content;
use super::status::*;
use super::types::*;
use super::views::*;
use fairmesh::{
    BoundaryLoop, BridgeOptions, Bridged, FillOptions, Join, Loops, Rim, boundary_loops_joined,
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
    guarded(error, |call| {
        let mesh = MeshIn::new(mesh, Argument(1), call)?;
        let from = list_in(from, Argument(2), call)?;
        let to = list_in(to, Argument(3), call)?;
        let bridge = read_bridge_options(bridge, Argument(4), call)?;
        let fill = FillOptionsIn::new(fill, Argument(5), call)?;
        let asked = OptionsIn::new(options, Argument(6), &mesh, call)?;
        let result = ResultOut::last(result, Argument(7), call)?;

        let (positions, triangles) = mesh.read()?;
        let (from, to) = (from.list()?, to.list()?);
        let chains = [&from[..], &to];
        let filling = FillOptions {
            loops: Loops::Chosen(Vec::new()),
            join: Join::None,
            guides: Vec::new(),
            rim: Rim::default(),
            ..fill.read(asked.read(&mesh)?)?
        };
        let look = memory_bounds::of_whole_mesh(&mesh, 1);
        let sizes = with_memory(look, &asked.callback, |_| {
            let loops = boundary_loops_joined(&positions, &triangles, mesh.coincident)?;
            let as_joined = FillOptions {
                join: Join::Groups(vec![loops_of(&loops, chains)]),
                ..filling.clone()
            };
            patch_sizes::sizes(&positions, &loops, &as_joined)
        })?;
        let sizes = sizes.limited(filling.max_new_vertices);
        let bytes = memory_bounds::of_filling(&mesh, &sizes, &asked, false);
        result.put(bytes, &asked.callback, |tell| {
            let bridge = BridgeOptions { filling, ..bridge };
            let bridged = bridge_with_progress(&positions, &triangles, chains, &bridge, tell)?;
            Ok(content(bridged, [positions.len(), triangles.len()]))
        })
    })
}

fn read_bridge_options(
    options: *const fairmesh_bridge_options,
    argument: Argument,
    call: &mut Call,
) -> CallResult<BridgeOptions> {
    let view = call.read_options(options, argument, fairmesh_bridge_options::standard)?;
    let asked = view.read_bridge_options(argument)?;
    asked
        .validate()
        .map_err(|error| refused(error, argument, fairmesh_bridge_options::place))?;
    Ok(asked)
}

/// The strip, then the holes beside it; the last report is that of all that is new together.
fn content(of: Bridged, given: [usize; 2]) -> Content {
    let bridge = Some(report::bridge(&of));
    let kind = fairmesh_result_kind::Bridged;
    let is_success = of.is_success();
    let mut made = Content::mesh(kind, of.positions, of.triangles, &of.parents, given)
        .judged(is_success)
        .with_patches([of.strip].into_iter().chain(of.rest).collect())
        .each(fairmesh_list::BridgeChain, "chain", of.chains.into())
        .each(fairmesh_list::BridgeSide, "side", of.sides.into());
    let whole = of.whole;
    made.reports
        .push(whole.ok_or("report of all that is new together: it was not faired so"));
    Content { bridge, ..made }
}

/// The loops that vertices of the chains are on.
fn loops_of(loops: &[BoundaryLoop], chains: [&[u32]; 2]) -> Vec<usize> {
    let named = |v: &u32| chains.iter().any(|chain| chain.contains(v));
    (0..loops.len())
        .filter(|&l| loops[l].vertices.iter().any(named))
        .collect()
}
