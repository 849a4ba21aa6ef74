//! Bridges between two runs of boundary edges.

use core::mem::offset_of;
use std::sync::Arc;

use super::fill_options::{FillOptionsIn, fairmesh_fill_options};
use super::guard::{guarded, point};
use super::input::{IndicesIn, MeshIn};
use super::memory_bounds;
use super::options::{OptionsIn, fairmesh_options, fields, refused};
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

/// What a bridge shall be. Fill it by `fairmesh_bridge_options_init`. How dense it is, and what becomes of one that is not fair, is in a
/// `fairmesh_fill_options`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_bridge_options {
    /// `sizeof(fairmesh_bridge_options)`.
    pub struct_size: u32,
    /// Not 0: the holes that the strip leaves beside it are filled, too, and all that is new is faired together. Default: 0.
    pub fill: u32,
    /// How long the chains shall be: each is made longer or shorter about its middle along its loop, to the vertices where that is met
    /// best. 0 (default): they are as given.
    pub width: f64,
}

pub(crate) fn default_bridge_options() -> fairmesh_bridge_options {
    let options = BridgeOptions::default();
    fairmesh_bridge_options {
        struct_size: size_of::<fairmesh_bridge_options>() as u32,
        fill: u32::from(options.fill),
        width: options.width.unwrap_or(0.0),
    }
}

/// Connects two runs of boundary edges by a strip that is tangent to the mesh at both, and faired. Each chain is given by its vertices,
/// one after the other, in either direction: at least two, or one if the options have a width. They may be on one loop or on two.
///
/// `bridge`, `fill` and `options` may be NULL; of `fill` the loops, groups, guides and `relax_rings` are not looked at. `result` gets a handle, whose
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
    let asked = BridgeOptions {
        width: (view.width != 0.0).then_some(view.width),
        fill: view.fill != 0,
        ..BridgeOptions::default()
    };
    let fields = fields!(fairmesh_bridge_options: width);
    asked
        .validate()
        .map_err(|error| refused(error, argument, fields))?;
    Ok(asked)
}

/// The loops that vertices of the chains are on.
fn loops_of(loops: &[BoundaryLoop], chains: &[Vec<u32>; 2]) -> Vec<usize> {
    let named = |v: &u32| chains.iter().any(|chain| chain.contains(v));
    (0..loops.len())
        .filter(|&l| loops[l].vertices.iter().any(named))
        .collect()
}
