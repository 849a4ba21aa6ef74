//! Options of hole filling and remeshing: how they become the library's.

use core::mem::offset_of;

use super::choices::count;
use super::loop_choice::{FilterIn, JoinIn, fairmesh_join, fairmesh_loop_filter, numbers};
use super::option_structs::{FillOptionsLists, fairmesh_fill_options, fairmesh_remesh_options};
use super::options::refused;
use super::status::CallResult;
use super::views::{AliasCheck, Argument, Array, FieldPath, check_reserved, indices_in, read_struct};
use fairmesh::{FillOptions, Loops, Options, RemeshOptions};

/// Options of hole filling, checked; the lists in them not read.
pub(crate) struct FillOptionsIn {
    view: fairmesh_fill_options,
    /// All but the lists.
    plain: FillOptions,
    loops: Array,
    join: JoinIn,
    filter: FilterIn,
    lists: FillOptionsLists,
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
        _ => fairmesh_fill_options::place(argument, option),
    }
}

impl FillOptionsIn {
    pub(crate) fn new(
        options: *const fairmesh_fill_options,
        argument: Argument,
        aliases: &mut AliasCheck,
    ) -> CallResult<Self> {
        let view = if options.is_null() {
            fairmesh_fill_options::standard()
        } else {
            read_struct(options, argument)?
        };
        let place = argument.field(offset_of!(fairmesh_fill_options, loops), "loops");
        let loops = indices_in(&view.loops, 1, place)?;
        aliases.input(loops.data, loops.bytes);
        let plain = view.read_fill_options(argument)?;
        let place = argument.field(offset_of!(fairmesh_fill_options, join), "join");
        let join = JoinIn::new(&view.join, place, aliases)?;
        let place = argument.field(offset_of!(fairmesh_fill_options, filter), "filter");
        let filter = FilterIn::new(&view.filter, place, view.max_edges, aliases)?;
        let lists = view.lists(argument)?;
        for list in &lists {
            aliases.input(list.data, list.bytes);
        }
        let plain = FillOptions {
            loops: Loops::Where(filter.checked()),
            rim: view.read_rim(argument)?,
            ..plain
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
            plain,
            loops,
            join,
            filter,
            lists,
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
        let mut options = FillOptions {
            loops,
            join: self.join.read()?,
            fairing,
            ..self.plain.clone()
        };
        fairmesh_fill_options::read_lists(&self.lists, &mut options)?;
        options
            .validate()
            .map_err(|error| refused(error, self.argument, place_of))?;
        Ok(options)
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
    let asked = view.read_remesh_options(argument)?;
    asked
        .validate()
        .map_err(|error| refused(error, argument, fairmesh_remesh_options::place))?;
    Ok(asked)
}
