//! Options of hole filling and remeshing: how they become the library's.

use super::callback::HostCallback;
use super::choices::count;
use super::loop_choice::{FilterIn, JoinIn, fairmesh_join, fairmesh_loop_filter, numbers};
use super::option_structs::{FillOptionsLists, fairmesh_fill_options, fairmesh_remesh_options};
use super::options::refused;
use super::status::CallResult;
use super::views::{Argument, Array, Call, FieldPath, check_reserved, field, indices_in};
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
    let filter = field!(argument, fairmesh_fill_options.filter);
    Some(match option {
        "max_length" => field!(filter, fairmesh_loop_filter.max_length),
        "max_area" => field!(filter, fairmesh_loop_filter.max_area),
        "max_diagonal" => field!(filter, fairmesh_loop_filter.max_diagonal),
        "within" => field!(filter, fairmesh_loop_filter.within),
        "join" => field!(field!(argument, fairmesh_fill_options.join), fairmesh_join.loops),
        _ => return fairmesh_fill_options::place(argument, option),
    })
}

impl FillOptionsIn {
    pub(crate) fn new(
        options: *const fairmesh_fill_options,
        argument: Argument,
        call: &mut Call,
    ) -> CallResult<Self> {
        let view = call.read_options(options, argument, fairmesh_fill_options::standard)?;
        let loops = indices_in(&view.loops, 1, field!(argument, fairmesh_fill_options.loops))?;
        call.input(loops.memory());
        let plain = view.read_fill_options(argument)?;
        let join = JoinIn::new(&view.join, field!(argument, fairmesh_fill_options.join), call)?;
        let place = field!(argument, fairmesh_fill_options.filter);
        let filter = FilterIn::new(&view.filter, place, view.max_edges, call)?;
        let lists = view.lists(argument)?;
        for list in &lists {
            call.input(list.memory());
        }
        let plain = FillOptions {
            loops: Loops::Where(filter.checked()),
            rim: view.read_rim(argument)?,
            ..plain
        };
        plain
            .validate()
            .map_err(|error| refused(error, argument, place_of))?;
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
    call: &mut Call,
) -> CallResult<(RemeshOptions, HostCallback)> {
    let view = call.read_options(options, argument, fairmesh_remesh_options::standard)?;
    check_reserved(view.reserved, field!(argument, fairmesh_remesh_options.reserved))?;
    let asked = view.read_remesh_options(argument)?;
    asked
        .validate()
        .map_err(|error| refused(error, argument, fairmesh_remesh_options::place))?;
    Ok((asked, HostCallback::new(view.progress, view.user_data)))
}
