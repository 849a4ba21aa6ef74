//! Options of hole filling and remeshing: the structs, their defaults, and how they become the library's.

use core::mem::offset_of;

use super::options::{NO_INDICES, count, fields, refused};
use super::status::CallResult;
use super::types::*;
use super::views::try_with_capacity;
use super::views::{AliasCheck, Argument, Array, check_reserved, indices_in, read_struct};
use fairmesh::{FillOptions, Loops, Options, RemeshOptions};

/// What hole filling does. Fill it by `fairmesh_fill_options_init`. How patches are faired is in a `fairmesh_options`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_fill_options {
    /// `sizeof(fairmesh_fill_options)`.
    pub struct_size: u32,
    /// Not 0 (default): patches are faired.
    pub fair: u32,
    /// Holes of more edges stay open. Default: UINT64_MAX.
    pub max_edges: u64,
    /// These loops only, as `fairmesh_boundary_loops` numbers them, outer boundaries included; NULL with count 0 (default): all
    /// holes. With a count, `max_edges` is not read.
    pub loops: fairmesh_indices,
    /// How dense the new vertices are. At the square root of 2, the default, edges are as long as those beside the boundary; at
    /// twice that, half as long. Between 0.1 and 10.
    pub density: f64,
    /// At most this many new vertices in all. Default 200000. No loop of n edges gets more than 1000 + n^2 of them, times
    /// the square of a density above 1.
    pub max_new_vertices: u64,
}

/// What remeshing does. Fill it by `fairmesh_remesh_options_init`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_remesh_options {
    /// `sizeof(fairmesh_remesh_options)`.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// As in `fairmesh_fill_options`: at the default, edges are as long as those beside the region.
    pub density: f64,
    /// At most this many vertices inside the region. Default 200000.
    pub max_vertices: u64,
}

pub(crate) fn default_fill_options() -> fairmesh_fill_options {
    let options = FillOptions::default();
    fairmesh_fill_options {
        struct_size: size_of::<fairmesh_fill_options>() as u32,
        fair: u32::from(options.fair),
        max_edges: u64::MAX,
        loops: NO_INDICES,
        density: options.density,
        max_new_vertices: options.max_new_vertices as u64,
    }
}

pub(crate) fn default_remesh_options() -> fairmesh_remesh_options {
    let options = RemeshOptions::default();
    fairmesh_remesh_options {
        struct_size: size_of::<fairmesh_remesh_options>() as u32,
        reserved: 0,
        density: options.density,
        max_vertices: options.max_vertices as u64,
    }
}

/// Options of hole filling, checked; the list of loops not read.
pub(crate) struct FillOptionsIn {
    view: fairmesh_fill_options,
    loops: Array,
}

impl FillOptionsIn {
    pub(crate) fn new(
        options: *const fairmesh_fill_options,
        argument: Argument,
        aliases: &mut AliasCheck,
    ) -> CallResult<Self> {
        if options.is_null() {
            let view = default_fill_options();
            let loops = indices_in(&view.loops, 1, argument.itself())?;
            return Ok(Self { view, loops });
        }
        let view = read_struct(options, argument)?;
        let place = argument.field(offset_of!(fairmesh_fill_options, loops), "loops");
        let loops = indices_in(&view.loops, 1, place)?;
        let plain = FillOptions {
            density: view.density,
            ..FillOptions::default()
        };
        let fields = fields!(fairmesh_fill_options: density max_new_vertices);
        plain
            .validate()
            .map_err(|error| refused(error, argument, fields))?;
        aliases.input(options, size_of::<fairmesh_fill_options>());
        aliases.input(loops.data, loops.bytes);
        Ok(Self { view, loops })
    }

    pub(crate) fn read(&self, fairing: Options) -> CallResult<FillOptions> {
        let view = &self.view;
        let mut numbers = try_with_capacity(self.loops.count)?;
        numbers.extend((0..self.loops.count).map(|k| self.loops.index::<1>(k)[0] as usize));
        Ok(FillOptions {
            loops: match self.loops.count {
                0 => Loops::UpTo(count(view.max_edges)),
                _ => Loops::Chosen(numbers),
            },
            density: view.density,
            max_new_vertices: count(view.max_new_vertices),
            fair: view.fair != 0,
            fairing,
            ..FillOptions::default()
        })
    }
}

/// Options of remeshing.
pub(crate) fn read_remesh_options(
    options: *const fairmesh_remesh_options,
    argument: Argument,
    aliases: &mut AliasCheck,
) -> CallResult<RemeshOptions> {
    if options.is_null() {
        return Ok(RemeshOptions::default());
    }
    let view = read_struct(options, argument)?;
    let place = argument.field(offset_of!(fairmesh_remesh_options, reserved), "reserved");
    check_reserved(view.reserved, place)?;
    aliases.input(options, size_of::<fairmesh_remesh_options>());
    let asked = RemeshOptions {
        density: view.density,
        max_vertices: count(view.max_vertices),
        // The mesh says it.
        ..RemeshOptions::default()
    };
    let fields = fields!(fairmesh_remesh_options: density max_vertices);
    asked
        .validate()
        .map_err(|error| refused(error, argument, fields))?;
    Ok(asked)
}
