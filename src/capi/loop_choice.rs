//! Which loops are filled, and which of them together: the structs, and how they become the library's.

use super::choices::{choose, count};
use super::status::CallResult;
use super::types::*;
use super::views::{Array, Call, FieldPath, check_reserved, field, indices_in, refuse, try_with_capacity};
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
    pub(crate) fn new(view: &fairmesh_join, base: FieldPath, call: &mut Call) -> CallResult<Self> {
        check_reserved(view.reserved, field!(base, fairmesh_join.reserved))?;
        let kind = choose(
            [Join::None, Join::Groups(Vec::new()), Join::Auto],
            |kind| kind.entry().number(),
            view.kind,
            "fairmesh_join_kind",
            field!(base, fairmesh_join.kind),
        )?;
        let place = field!(base, fairmesh_join.starts);
        let (mut loops, mut starts) = Default::default();
        if let Join::Groups(_) = kind {
            (loops, starts) = (view.loops, view.starts);
        }
        let loops = indices_in(&loops, 1, field!(base, fairmesh_join.loops))?;
        let starts = indices_in(&starts, 1, place)?;
        call.input(loops.memory());
        call.input(starts.memory());
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
            return Err(
                refuse!(self.place => BadOption, "they ascend from 0 to the count of the loops, {count}"),
            );
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
        call: &mut Call,
    ) -> CallResult<Self> {
        let components = indices_in(&view.components, 1, field!(base, fairmesh_loop_filter.components))?;
        call.input(components.memory());
        let bound = |value: f64| (value != 0.0).then_some(value);
        let filter = LoopFilter {
            max_edges: (max_edges != u64::MAX).then(|| count(max_edges)),
            max_length: bound(view.max_length),
            max_area: bound(view.max_area),
            max_diagonal: bound(view.max_diagonal),
            except_longest: count(view.except_longest),
            components: None,
            within: within(&view.within, field!(base, fairmesh_loop_filter.within))?,
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
    check_reserved(view.reserved, field!(base, fairmesh_place.reserved))?;
    let (centre, radius) = (view.centre, view.radius);
    let (low, high) = (view.low, view.high);
    let everywhere = fairmesh_place_kind::Everywhere as u32;
    choose(
        [
            None,
            Some(Place::Ball { centre, radius }),
            Some(Place::Box { low, high }),
        ],
        |kind| kind.map_or(everywhere, |place| place.entry().number()),
        view.kind,
        "fairmesh_place_kind",
        field!(base, fairmesh_place.kind),
    )
}
