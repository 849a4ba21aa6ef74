//! How much memory a call will take.

use super::fill::sizes_of;
use super::fill_options::FillOptionsIn;
use super::guard::guarded;
use super::input::{MeshIn, SelectionIn};
use super::memory_bounds;
use super::memory_use::Bytes;
use super::option_structs::{fairmesh_fill_options, fairmesh_options};
use super::options::OptionsIn;
use super::status::*;
use super::types::*;
use super::views::*;

/// How much memory a call takes at most, about, in bytes: `fairmesh_fill_holes` with these arguments, or where `fill` is NULL `fairmesh_fair`,
/// whose `selection` may be NULL, too. As much again is set aside before it works, as address space that is not touched while there is
/// memory; in WebAssembly, where address space is memory, at most 256 MB. What the caller's own arrays take comes on top.
#[unsafe(no_mangle)]
pub extern "C" fn fairmesh_memory_needed(
    mesh: *const fairmesh_mesh,
    selection: *const fairmesh_selection,
    fill: *const fairmesh_fill_options,
    options: *const fairmesh_options,
    bytes: *mut u64,
    error: *mut fairmesh_error,
) -> fairmesh_status {
    guarded(error, |call| {
        let mesh = MeshIn::new(mesh, Argument(1), call)?;
        let selection = SelectionIn::new(selection, Argument(2), &mesh, call)?;
        let is_filling = !fill.is_null();
        let fill = FillOptionsIn::new(fill, Argument(3), call)?;
        let asked = OptionsIn::new(options, Argument(4), &mesh, call)?;
        check_pointer(bytes, Argument(5))?;
        call.output(Bytes::block(bytes, size_of::<u64>()), Argument(5))?;
        call.end(Argument(6))?;
        let needed = if is_filling {
            let (positions, triangles) = mesh.read()?;
            let fill = fill.read(asked.read(&mesh)?)?;
            let sizes = sizes_of(&mesh, &positions, &triangles, &fill)?.limited(fill.max_new_vertices);
            memory_bounds::of_filling(&mesh, &sizes, &asked, fill.rim.relax > 0)
        } else {
            memory_bounds::of_fairing(&mesh, &selection.read(&mesh)?, &asked, false)?
        };
        write(bytes, needed);
        Ok(())
    })
}
