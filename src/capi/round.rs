//! Creases that become blends.

use super::callback::cancelled;
use super::guard::guarded;
use super::input::MeshIn;
use super::memory_bounds;
use super::option_structs::{RoundOptionsLists, fairmesh_options, fairmesh_round_options};
use super::options::{OptionsIn, refused};
use super::outputs::{ResultOut, with_memory};
use super::report;
use super::results::Content;
use super::status::*;
use super::types::*;
use super::views::*;
use fairmesh::{RoundOptions, Rounded, blend_vertices, round_with_progress};

/// Rounds the creases of a mesh: in place of each there is a blend, tangent to the faces beside it. Outside of the blends the surface stays where it
/// is; triangles that reach into one are cut. Vertices that are left come first, in their order, then new ones; triangles outside the blends, then
/// those of the blends.
///
/// `round` needs a width or a radius. `options` may be NULL; its normals, curvature, target, `sharp` and marked edges are not looked at. `result` gets a
/// handle, with one report, 0, of the fairing of all blends. Free it. NO_CREASE where there is nothing to be rounded.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_round(
    mesh: *const fairmesh_mesh,
    round: *const fairmesh_round_options,
    options: *const fairmesh_options,
    result: *mut *mut fairmesh_result,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, |call| {
        let mesh = MeshIn::new(mesh, Argument(1), call)?;
        let (asked_round, lists) = read_round_options(round, Argument(2), call)?;
        let asked = OptionsIn::new(options, Argument(3), &mesh, call)?;
        let result = ResultOut::last(result, Argument(4), call)?;

        let (positions, triangles) = mesh.read()?;
        let mut rounding = RoundOptions {
            fairing: asked.read(&mesh)?,
            ..asked_round
        };
        fairmesh_round_options::read_lists(&lists, &mut rounding)?;
        rounding
            .validate()
            .map_err(|error| refused(error, Argument(2), fairmesh_round_options::place))?;
        let look = memory_bounds::of_whole_mesh(&mesh, 1);
        let expected = with_memory(look, &asked.callback, |_| {
            Ok(blend_vertices(&positions, &triangles, &rounding)?)
        })?;
        let bytes = memory_bounds::of_rounding(&mesh, expected, &asked);
        result.put(bytes, &asked.callback, |tell| {
            let rounded = round_with_progress(&positions, &triangles, &rounding, tell)?;
            rounded.map(Content::from).ok_or_else(cancelled)
        })
    })
}

fn read_round_options(
    options: *const fairmesh_round_options,
    argument: Argument,
    call: &mut Call,
) -> CallResult<(RoundOptions, RoundOptionsLists)> {
    let view = call.read_options(options, argument, fairmesh_round_options::standard)?;
    Ok((view.read_round_options(argument)?, view.lists(argument)?))
}

impl From<Rounded> for Content {
    fn from(of: Rounded) -> Self {
        let is_success = of.is_complete();
        let kept = [of.kept_vertices.len(), of.kept_triangles.len()];
        let kind = fairmesh_result_kind::Rounded;
        let mut made = Self::mesh(kind, of.positions, of.triangles, &of.parents, kept)
            .judged(is_success)
            .one(fairmesh_list::FreeVertices, of.free)
            .one(fairmesh_list::KeptVertices, of.kept_vertices)
            .one(fairmesh_list::KeptTriangles, of.kept_triangles);
        made.info.crease_count = of.chains.len() as u64;
        made.info.crease_angle = of.angle;
        made.creases = of.chains.iter().map(report::crease).collect();
        made.reports.push(Ok(of.report));
        let corners = of.sharp_corners.iter().map(|corner| corner.vertex).collect();
        let vertices = of.chains.into_iter().map(|chain| chain.vertices).collect();
        made.one(fairmesh_list::SharpCorners, corners)
            .each(fairmesh_list::CreaseVertices, "crease", vertices)
    }
}
