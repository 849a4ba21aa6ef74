//! Options of hole filling and remeshing: the structs, their defaults, and how they become the library's.

use core::mem::offset_of;

use super::loop_choice::{
    FilterIn, JoinIn, NO_FILTER, NO_JOIN, fairmesh_join, fairmesh_loop_filter, numbers,
};
use super::options::{NO_INDICES, chosen, count, fields, refused};
use super::status::CallResult;
use super::types::*;
use super::views::{AliasCheck, Argument, Array, FieldPath, check_reserved, indices_in, read_struct};
use fairmesh::{FillOptions, Loops, OnFailure, Options, RemeshOptions, Rim};

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
    /// holes. With a count, `max_edges` and `filter` are not read.
    pub loops: fairmesh_indices,
    /// How dense the new vertices are. At the square root of 2, the default, edges are as long as those beside the boundary; at
    /// twice that, half as long. Between 0.1 and 10.
    pub density: f64,
    /// At most this many new vertices in all. Default 200000. No loop of n edges gets more than 1000 + n^2 of them, times
    /// the square of a density above 1.
    pub max_new_vertices: u64,
    /// A `fairmesh_on_failure`: what a loop gets for which no fair patch is found. Zero (default): the best surface there is.
    pub on_failure: u32,
    /// Not 0: the loops of the list `loops` only, also where it is empty: then nothing is filled but groups of loops that are joined.
    pub only_listed: u32,
    /// Loops that get one patch together. All zero (default): none.
    pub join: fairmesh_join,
    /// Which holes, if `loops` does not say it. All zero (default): all of them.
    pub filter: fairmesh_loop_filter,
    /// Pairs of vertices of the boundary, two indices side by side, that the triangulation shall have an edge between before it is
    /// refined: across a long tear, or between two loops that are joined. No vertex is in two of them. NULL with count 0 (default): none.
    pub guides: fairmesh_indices,
    /// So many rings of vertices around a loop, its own counted, may move onto the surface that the mesh has there on average, before it
    /// is filled: for boundaries that are noise. Zero (default): none.
    pub relax_rings: u64,
    /// No vertex moves further than this, in the unit of the positions. Zero (default): the mean length of the edges around the loop.
    pub relax_within: f64,
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
        on_failure: options.on_failure.entry().number(),
        only_listed: 0,
        join: NO_JOIN,
        filter: NO_FILTER,
        guides: NO_INDICES,
        relax_rings: 0,
        relax_within: 0.0,
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

/// Options of hole filling, checked; the lists in them not read.
pub(crate) struct FillOptionsIn {
    view: fairmesh_fill_options,
    on_failure: OnFailure,
    loops: Array,
    join: JoinIn,
    filter: FilterIn,
    guides: Array,
    argument: Argument,
}

/// Where the options are that the library's errors name.
fn place_of(argument: Argument, option: &str) -> Option<FieldPath> {
    let filter = argument.field(offset_of!(fairmesh_fill_options, filter), "filter");
    let in_filter = |offset, name| Some(filter.field(offset, name));
    match option {
        "max_length" => in_filter(offset_of!(fairmesh_loop_filter, max_length), "max_length"),
        "max_area" => in_filter(offset_of!(fairmesh_loop_filter, max_area), "max_area"),
        "max_diagonal" => in_filter(offset_of!(fairmesh_loop_filter, max_diagonal), "max_diagonal"),
        "within" => in_filter(offset_of!(fairmesh_loop_filter, within), "within"),
        "join" => {
            let join = argument.field(offset_of!(fairmesh_fill_options, join), "join");
            Some(join.field(offset_of!(fairmesh_join, loops), "loops"))
        }
        _ => FIELDS(argument, option),
    }
}

const FIELDS: fn(Argument, &str) -> Option<FieldPath> =
    fields!(fairmesh_fill_options: density max_new_vertices relax_within);

impl FillOptionsIn {
    pub(crate) fn new(
        options: *const fairmesh_fill_options,
        argument: Argument,
        aliases: &mut AliasCheck,
    ) -> CallResult<Self> {
        let view = if options.is_null() {
            default_fill_options()
        } else {
            read_struct(options, argument)?
        };
        let place = argument.field(offset_of!(fairmesh_fill_options, loops), "loops");
        let loops = indices_in(&view.loops, 1, place)?;
        aliases.input(loops.data, loops.bytes);
        let place = argument.field(offset_of!(fairmesh_fill_options, on_failure), "on_failure");
        let choices = [OnFailure::Linear, OnFailure::Flat, OnFailure::Open];
        let on_failure = choices
            .into_iter()
            .find(|choice| choice.entry().number() == view.on_failure);
        let on_failure = chosen(on_failure, view.on_failure, "fairmesh_on_failure", place)?;
        let place = argument.field(offset_of!(fairmesh_fill_options, join), "join");
        let join = JoinIn::new(&view.join, place, aliases)?;
        let place = argument.field(offset_of!(fairmesh_fill_options, filter), "filter");
        let filter = FilterIn::new(&view.filter, place, view.max_edges, aliases)?;
        let place = argument.field(offset_of!(fairmesh_fill_options, guides), "guides");
        let guides = indices_in(&view.guides, 2, place)?;
        aliases.input(guides.data, guides.bytes);
        let plain = FillOptions {
            loops: Loops::Where(filter.checked()),
            density: view.density,
            rim: rim(&view),
            ..FillOptions::default()
        };
        plain
            .validate()
            .map_err(|error| refused(error, argument, place_of))?;
        aliases.input(
            options,
            size_of::<fairmesh_fill_options>() * usize::from(!options.is_null()),
        );
        Ok(Self {
            view,
            on_failure,
            loops,
            join,
            filter,
            guides,
            argument,
        })
    }

    pub(crate) fn read(&self, fairing: Options) -> CallResult<FillOptions> {
        let view = &self.view;
        let loops = if self.loops.count > 0 || view.only_listed != 0 {
            Loops::Chosen(numbers(&self.loops)?)
        } else {
            self.filter
                .read()?
                .map_or_else(|| Loops::UpTo(count(view.max_edges)), Loops::Where)
        };
        let options = FillOptions {
            loops,
            join: self.join.read()?,
            guides: self.guides.rows::<2>()?.into_owned(),
            density: view.density,
            max_new_vertices: count(view.max_new_vertices),
            on_failure: self.on_failure,
            rim: rim(view),
            fair: view.fair != 0,
            fairing,
        };
        options
            .validate()
            .map_err(|error| refused(error, self.argument, place_of))?;
        Ok(options)
    }
}

/// What may happen to the mesh around loops.
fn rim(view: &fairmesh_fill_options) -> Rim {
    Rim {
        relax: count(view.relax_rings),
        within: (view.relax_within != 0.0).then_some(view.relax_within),
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
