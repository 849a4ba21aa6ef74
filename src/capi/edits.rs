//! What is changed of a solver's boundary: the structs, and how they become the library's.

use super::choices::{choice, choice_of, count};
use super::status::{CallResult, fairmesh_element};
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

choice_of!(fairmesh_edit_kind: Tilt Twist Bulge Move);

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

/// An edit, checked; its list not read.
struct EditIn {
    view: fairmesh_edit,
    kind: fairmesh_edit_kind,
    vertices: Array,
}

/// Reads edits, arguments 2 and 3 of a function whose last one is the error detail, about a mesh of so many vertices.
pub(crate) fn edits(
    edits: *const fairmesh_edit,
    count: usize,
    vertices: usize,
    call: &mut Call,
) -> CallResult<Vec<Edit>> {
    check_structs(edits, count, Argument(2), call, "edits")?;
    call.end(Argument(4))?;
    let mut checked = try_with_capacity(count)?;
    for k in 0..count {
        let place = Argument(2).element::<fairmesh_edit>(k, "edits");
        let edit = EditIn::new(read(edits.wrapping_add(k)), place)?;
        call.late_input(edit.vertices.memory())?;
        checked.push(edit);
    }
    let mut edits = try_with_capacity(count)?;
    for edit in &checked {
        edits.push(edit.read(vertices)?);
    }
    Ok(edits)
}

impl EditIn {
    fn new(view: fairmesh_edit, place: FieldPath) -> CallResult<Self> {
        use fairmesh_edit_kind as Kind;
        let kind = choice(view.kind, field!(place, fairmesh_edit.kind))?;
        let listed = if kind == Kind::Move {
            &view.vertices
        } else {
            &fairmesh_indices::default()
        };
        let vertices = indices_in(listed, 1, field!(place, fairmesh_edit.vertices))?;
        Ok(Self { view, kind, vertices })
    }

    fn read(&self, vertices: usize) -> CallResult<Edit> {
        use fairmesh_edit_kind as Kind;
        const NAMED: &str = "an edit names vertex";
        let fairmesh_edit {
            amount: angle,
            falloff,
            rotation,
            centre,
            translation,
            ..
        } = self.view;
        let vertex = || known(self.view.vertex, vertices, fairmesh_element::Vertex, NAMED);
        Ok(match self.kind {
            Kind::Tilt => Edit::Tilt {
                vertex: vertex()?,
                angle,
                falloff,
            },
            Kind::Twist => Edit::Twist {
                vertex: vertex()?,
                angle,
                falloff,
            },
            Kind::Bulge => Edit::Bulge { amount: angle },
            Kind::Move => Edit::Move {
                vertices: self.vertices.known(vertices, fairmesh_element::Vertex, NAMED)?,
                rotation,
                centre,
                translation,
                falloff,
            },
        })
    }
}

/// What a frame may cost; NULL: no limit.
pub(crate) fn budget(
    view: *const fairmesh_budget,
    argument: Argument,
    call: &mut Call,
) -> CallResult<Budget> {
    if view.is_null() {
        return Ok(Budget::default());
    }
    let given = call.read_struct(view, argument)?;
    check_reserved(given.reserved, field!(argument, fairmesh_budget.reserved))?;
    Ok(Budget {
        evaluations: count(given.evaluations),
        seconds: given.seconds,
        tolerance: given.tolerance,
    })
}
