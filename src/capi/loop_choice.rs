//! Which loops are filled, and which of them together: the structs, and how they become the library's.

use core::mem::offset_of;

use super::choices::{chosen, count};
use super::status::{CallResult, fairmesh_status as Status};
use super::types::*;
use super::views::{AliasCheck, Array, FieldPath, check_reserved, indices_in, try_with_capacity};
use fairmesh::{Join, LoopFilter, Place};

/// Loops that get one patch together: ends of tubes, the two sides of a gap, a hole and the island in it. All zero: none.
#[repr(C)]
#[derive(Clone, Copy, Default)]
pub struct fairmesh_join {
    /// A `fairmesh_join_kind`.
    pub kind: u32,
    /// Zero.
    pub reserved: u32,
    /// Of `FAIRMESH_JOIN_KIND_GROUPS` the loops, as `fairmesh_boundary_loops` numbers them, outer boundaries included: one group after
    /// the other, no loop twice. They are filled whatever else says which loops are. Otherwise not read.
    pub loops: fairmesh_indices,
    /// Where each group begins in `loops`, ascending from 0; a group ends where the next one begins. NULL with count 0: all of them are
    /// one group.
    pub starts: fairmesh_indices,
}

/// A part of space. All zero: everywhere.
#[repr(C)]
#[derive(Clone, Copy, Default)]
pub struct fairmesh_place {
    /// A `fairmesh_place_kind`.
    pub kind: u32,
    /// Zero.
    pub reserved: u32,
    /// The centre of a ball.
    pub centre: [f64; 3],
    /// Its radius.
    pub radius: f64,
    /// The smallest coordinates of a box.
    pub low: [f64; 3],
    /// The largest ones.
    pub high: [f64; 3],
}

/// Which holes, by what they are and where: those that meet every bound. All zero: all of them.
#[repr(C)]
#[derive(Clone, Copy, Default)]
pub struct fairmesh_loop_filter {
    /// Not longer than this; 0: of any length.
    pub max_length: f64,
    /// Of no more than this area, as `fairmesh_loop` has it; 0: of any area.
    pub max_area: f64,
    /// With a bounding box of no more than this diagonal; 0: of any.
    pub max_diagonal: f64,
    /// All but so many holes of the mesh, the longest.
    pub except_longest: u64,
    /// Only those of these components, as `fairmesh_components` numbers them; NULL with count 0: of all.
    pub components: fairmesh_indices,
    /// Only those whose vertices all lie there.
    pub within: fairmesh_place,
}

/// The numbers of a list.
pub(crate) fn numbers(list: &Array) -> CallResult<Vec<usize>> {
    let mut numbers = try_with_capacity(list.count)?;
    numbers.extend((0..list.count).map(|k| list.index::<1>(k)[0] as usize));
    Ok(numbers)
}

/// What is joined, checked; the lists not read.
pub(crate) struct JoinIn {
    kind: Join,
    loops: Array,
    starts: Array,
    place: FieldPath,
}

impl JoinIn {
    pub(crate) fn new(view: &fairmesh_join, base: FieldPath, aliases: &mut AliasCheck) -> CallResult<Self> {
        check_reserved(
            view.reserved,
            base.field(offset_of!(fairmesh_join, reserved), "reserved"),
        )?;
        let kinds = [Join::None, Join::Groups(Vec::new()), Join::Auto];
        let kind = kinds.into_iter().find(|kind| kind.entry().number() == view.kind);
        let place = base.field(offset_of!(fairmesh_join, kind), "kind");
        let kind = chosen(kind, view.kind, "fairmesh_join_kind", place)?;
        let is_listed = matches!(kind, Join::Groups(_));
        let read = |list: &fairmesh_indices, place| {
            let list = if is_listed {
                *list
            } else {
                fairmesh_indices::default()
            };
            indices_in(&list, 1, place)
        };
        let loops = read(&view.loops, base.field(offset_of!(fairmesh_join, loops), "loops"))?;
        let place = base.field(offset_of!(fairmesh_join, starts), "starts");
        let starts = read(&view.starts, place)?;
        aliases.input(loops.data, loops.bytes);
        aliases.input(starts.data, starts.bytes);
        Ok(Self {
            kind,
            loops,
            starts,
            place,
        })
    }

    pub(crate) fn read(&self) -> CallResult<Join> {
        let Join::Groups(_) = self.kind else {
            return Ok(self.kind.clone());
        };
        let loops = numbers(&self.loops)?;
        let mut starts = numbers(&self.starts)?;
        if starts.is_empty() {
            starts.push(0);
        }
        let ascends = starts.windows(2).all(|pair| pair[0] <= pair[1]);
        if starts[0] != 0 || !ascends || starts[starts.len() - 1] > loops.len() {
            let count = loops.len();
            let why = format_args!("they ascend from 0 to the count of the loops, {count}");
            return Err(self.place.refuse(Status::BadOption, why));
        }
        let mut groups = try_with_capacity(starts.len())?;
        for (k, &start) in starts.iter().enumerate() {
            let end = starts.get(k + 1).copied().unwrap_or(loops.len());
            let mut group = try_with_capacity(end - start)?;
            group.extend_from_slice(&loops[start..end]);
            groups.push(group);
        }
        Ok(Join::Groups(groups))
    }
}

/// What holes are asked for, checked; the list of components not read.
pub(crate) struct FilterIn {
    filter: LoopFilter,
    components: Array,
}

impl FilterIn {
    pub(crate) fn new(
        view: &fairmesh_loop_filter,
        base: FieldPath,
        max_edges: u64,
        aliases: &mut AliasCheck,
    ) -> CallResult<Self> {
        let place = base.field(offset_of!(fairmesh_loop_filter, components), "components");
        let components = indices_in(&view.components, 1, place)?;
        aliases.input(components.data, components.bytes);
        let bound = |value: f64| (value != 0.0).then_some(value);
        let filter = LoopFilter {
            max_edges: (max_edges != u64::MAX).then(|| count(max_edges)),
            max_length: bound(view.max_length),
            max_area: bound(view.max_area),
            max_diagonal: bound(view.max_diagonal),
            except_longest: count(view.except_longest),
            components: None,
            within: within(
                &view.within,
                base.field(offset_of!(fairmesh_loop_filter, within), "within"),
            )?,
        };
        Ok(Self { filter, components })
    }

    /// The filter, without its components.
    pub(crate) fn checked(&self) -> LoopFilter {
        self.filter.clone()
    }

    /// None if the number of edges is all that is asked.
    pub(crate) fn read(&self) -> CallResult<Option<LoopFilter>> {
        let components = match self.components.count {
            0 => None,
            _ => Some(numbers(&self.components)?),
        };
        let filter = LoopFilter {
            components,
            ..self.filter.clone()
        };
        let by_edges = LoopFilter {
            max_edges: filter.max_edges,
            ..LoopFilter::default()
        };
        Ok((filter != by_edges).then_some(filter))
    }
}

fn within(view: &fairmesh_place, base: FieldPath) -> CallResult<Option<Place>> {
    let reserved = base.field(offset_of!(fairmesh_place, reserved), "reserved");
    check_reserved(view.reserved, reserved)?;
    let (centre, radius) = (view.centre, view.radius);
    let (low, high) = (view.low, view.high);
    let kinds = [
        None,
        Some(Place::Ball { centre, radius }),
        Some(Place::Box { low, high }),
    ];
    let number = |kind: &Option<Place>| {
        kind.map_or(fairmesh_place_kind::Everywhere as u32, |place| {
            place.entry().number()
        })
    };
    let kind = kinds.into_iter().find(|kind| number(kind) == view.kind);
    let place = base.field(offset_of!(fairmesh_place, kind), "kind");
    chosen(kind, view.kind, "fairmesh_place_kind", place)
}
