//! What is changed of a solver's boundary: the structs, and how they become the library's.

use core::mem::offset_of;

use super::status::{CallResult, Failure, fairmesh_element, fairmesh_status as Status};
use super::structs::{check_pointer, read};
use super::types::*;
use super::views::*;
use fairmesh::{Budget, Edit};

/// What an edit changes.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_edit_kind {
    /// Turns the boundary normals of the loop of `vertex` about the boundary, by `amount` in radians. With a positive one the surface
    /// leaves the boundary steeper to the side that normals point to.
    Tilt = 1,
    /// The same on one side of `vertex`, and the opposite on the other.
    Twist = 2,
    /// Bulges the region by `amount`, outward if it is positive; see `fairmesh_solver_bulge_range`.
    Bulge = 3,
    /// Moves the fixed vertices of `vertices` rigidly; their normals follow, given or fitted.
    Move = 4,
}

/// A change of what is asked at the boundary. Set it to zero first; what its kind does not need is not read. It never grows.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_edit {
    /// A `fairmesh_edit_kind`.
    pub kind: u32,
    /// A boundary vertex of the region: which loop a tilt or twist concerns, and where it is strongest.
    pub vertex: u32,
    /// An angle in radians, or the amount of a bulge.
    pub amount: f64,
    /// Tilt and twist: how far along the loop from `vertex` they reach, falling off smoothly; 0: the whole loop. Moves: how far along
    /// the mesh other fixed vertices follow in part; 0: none does.
    pub falloff: f64,
    /// The fixed vertices that are moved, in any order.
    pub vertices: fairmesh_indices,
    /// The axis of a rotation, times its angle in radians.
    pub rotation: [f64; 3],
    /// A point on the axis.
    pub centre: [f64; 3],
    /// A translation, after the rotation.
    pub translation: [f64; 3],
}

/// What a frame may cost. Set `struct_size`, all else to zero: no limit.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_budget {
    /// `sizeof(fairmesh_budget)`.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// Evaluations of the equations at most; 0: no limit.
    pub evaluations: u64,
    /// Seconds, about; 0: no limit. With a limit of seconds the surface depends on the machine.
    pub seconds: f64,
    /// The step norm at which a frame is settled, in diagonals; 0: 1e-6.
    pub tolerance: f64,
}

/// The surface of a frame. Set `struct_size` before the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_frame {
    /// `sizeof(fairmesh_frame)`.
    pub struct_size: u32,
    /// 1 if its step norm is within the tolerance everywhere, else 0: further updates go on from here.
    pub is_settled: u32,
    /// Evaluations of the equations that it has cost.
    pub evaluations: u64,
    /// Its step norm, in diagonals of the bounding box: how far from the end it is, about. NaN before there is one.
    pub step: f64,
}

/// The amounts of a bulge between which sound surfaces were found. Set `struct_size` before the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_bulge_range {
    /// `sizeof(fairmesh_bulge_range)`.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// The smallest, not positive.
    pub low: f64,
    /// The largest, not negative.
    pub high: f64,
}

/// Edits, checked; their lists not read.
pub(crate) struct EditsIn(Vec<EditIn>);

struct EditIn {
    view: fairmesh_edit,
    kind: fairmesh_edit_kind,
    vertices: Array,
}

impl EditsIn {
    /// `check` looks at what else the caller handed over, once for every list: there may be more of them than one check has room for.
    pub(crate) fn new(
        edits: *const fairmesh_edit,
        count: usize,
        argument: Argument,
        check: impl Fn(&mut AliasCheck) -> CallResult,
    ) -> CallResult<Self> {
        let bytes = bytes(edits, count, argument)?;
        let mut aliases = AliasCheck::new();
        aliases.input(edits, bytes);
        check(&mut aliases)?;
        let mut checked = try_with_capacity(count)?;
        for k in 0..count {
            let edit = EditIn::new(read(edits.wrapping_add(k)), k, argument)?;
            let mut aliases = AliasCheck::new();
            aliases.input(edit.vertices.data, edit.vertices.bytes);
            check(&mut aliases)?;
            checked.push(edit);
        }
        Ok(Self(checked))
    }

    pub(crate) fn read(&self, vertices: usize) -> CallResult<Vec<Edit>> {
        let mut edits = try_with_capacity(self.0.len())?;
        for edit in &self.0 {
            edits.push(edit.read(vertices)?);
        }
        Ok(edits)
    }
}

/// Checks where the edits are; how many bytes they have.
fn bytes(edits: *const fairmesh_edit, count: usize, argument: Argument) -> CallResult<usize> {
    if count > 0 {
        check_pointer(edits, argument)?;
    }
    let bytes = count.checked_mul(size_of::<fairmesh_edit>());
    let fits =
        |bytes: &usize| *bytes <= isize::MAX as usize && (edits as usize).checked_add(*bytes).is_some();
    bytes.filter(fits).ok_or_else(|| {
        let why = format_args!("{count} edits are more than memory has room for");
        Argument(argument.0 + 1)
            .itself()
            .refuse(Status::CountOverflow, why)
    })
}

impl EditIn {
    fn new(view: fairmesh_edit, number: usize, argument: Argument) -> CallResult<Self> {
        use fairmesh_edit_kind as Kind;
        let place = argument.field(number.wrapping_mul(size_of::<fairmesh_edit>()), "edits");
        let kinds = [Kind::Tilt, Kind::Twist, Kind::Bulge, Kind::Move];
        let at = place.field(offset_of!(fairmesh_edit, kind), "kind");
        let kind = kinds.into_iter().find(|kind| *kind as u32 == view.kind);
        let kind = kind.ok_or_else(|| {
            let number = view.kind;
            at.refuse(Status::BadEnum, format_args!("{number} is no fairmesh_edit_kind"))
        })?;
        let at = place.field(offset_of!(fairmesh_edit, vertices), "vertices");
        let listed = if kind == Kind::Move {
            &view.vertices
        } else {
            &fairmesh_indices::default()
        };
        let vertices = indices_in(listed, 1, at)?;
        Ok(Self { view, kind, vertices })
    }

    fn read(&self, vertices: usize) -> CallResult<Edit> {
        use fairmesh_edit_kind as Kind;
        let fairmesh_edit {
            vertex,
            amount,
            falloff,
            rotation,
            centre,
            translation,
            ..
        } = self.view;
        let known = |vertex: u32| {
            if (vertex as usize) < vertices {
                return Ok(vertex);
            }
            let why = format_args!("an edit names vertex {vertex}, but there are only {vertices}");
            let failure = Failure::new(Status::SelectionOutOfRange, why);
            Err(failure.at(fairmesh_element::Vertex, vertex as usize))
        };
        Ok(match self.kind {
            Kind::Tilt => Edit::Tilt {
                vertex: known(vertex)?,
                angle: amount,
                falloff,
            },
            Kind::Twist => Edit::Twist {
                vertex: known(vertex)?,
                angle: amount,
                falloff,
            },
            Kind::Bulge => Edit::Bulge { amount },
            Kind::Move => {
                let mut moved = try_with_capacity(self.vertices.count)?;
                for k in 0..self.vertices.count {
                    moved.push(known(self.vertices.index::<1>(k)[0])?);
                }
                Edit::Move {
                    vertices: moved,
                    rotation,
                    centre,
                    translation,
                    falloff,
                }
            }
        })
    }
}

/// What a frame may cost; NULL: no limit.
pub(crate) fn budget(
    view: *const fairmesh_budget,
    argument: Argument,
    aliases: &mut AliasCheck,
) -> CallResult<Budget> {
    if view.is_null() {
        return Ok(Budget::default());
    }
    let given = read_struct(view, argument)?;
    check_reserved(
        given.reserved,
        argument.field(offset_of!(fairmesh_budget, reserved), "reserved"),
    )?;
    aliases.input(view, given.struct_size as usize);
    Ok(Budget {
        evaluations: super::choices::count(given.evaluations),
        seconds: given.seconds,
        tolerance: given.tolerance,
    })
}
