//! What the caller hands over, checked and turned into what the library takes.

use core::mem::offset_of;
use std::borrow::Cow;

use super::status::{CallResult, Failure, fairmesh_element, fairmesh_status as Status};
use super::types::*;
use super::views::{
    AliasCheck, Argument, Array, FieldPath, NumbersIn, PointsIn, check_count, check_pointer, check_reserved,
    entries, indices_in, read_struct, try_with_capacity,
};
use fairmesh::{BoundaryCurvature, BoundaryNormals, Coincident, Selection};

/// A mesh, checked but not read.
pub(crate) struct MeshIn {
    pub positions: PointsIn,
    pub triangles: Array,
    pub coincident: Coincident,
}

fn coincident(view: &fairmesh_mesh, argument: Argument) -> CallResult<Coincident> {
    let join = Coincident::Join {
        within: view.coincident_within,
    };
    let number = view.coincident;
    let chosen = [join, Coincident::Separate]
        .into_iter()
        .find(|coincident| coincident.entry().number() == number)
        .ok_or_else(|| {
            let place = argument.field(offset_of!(fairmesh_mesh, coincident), "coincident");
            place.refuse(
                Status::BadEnum,
                format_args!("{number} is no fairmesh_coincident"),
            )
        })?;
    // The distance has to be one even where it is not used.
    join.validate().map_err(|error| {
        let place = argument.field(offset_of!(fairmesh_mesh, coincident_within), "coincident_within");
        place.blame(Failure::from(error))
    })?;
    Ok(chosen)
}

impl MeshIn {
    pub(crate) fn new(
        mesh: *const fairmesh_mesh,
        argument: Argument,
        aliases: &mut AliasCheck,
    ) -> CallResult<Self> {
        let view = read_struct(mesh, argument)?;
        let coincident = coincident(&view, argument)?;
        let positions = PointsIn::new(
            &view.positions,
            argument.field(offset_of!(fairmesh_mesh, positions), "positions"),
        )?;
        let triangles = indices_in(
            &view.triangles,
            3,
            argument.field(offset_of!(fairmesh_mesh, triangles), "triangles"),
        )?;
        for (count, what) in [
            (positions.array.count, "vertices"),
            (triangles.count, "triangles"),
        ] {
            if count > (u32::MAX / 3) as usize {
                let why = format_args!("{count} {what}: more than 32-bit indices can name");
                return Err(Failure::new(Status::TooLarge, why));
            }
        }
        aliases.input(mesh, size_of::<fairmesh_mesh>());
        aliases.input(positions.array.data, positions.array.bytes);
        aliases.input(triangles.data, triangles.bytes);
        Ok(Self {
            positions,
            triangles,
            coincident,
        })
    }

    pub(crate) fn vertices(&self) -> usize {
        self.positions.array.count
    }
}

/// A selection in the caller's memory.
pub(crate) struct SelectionIn {
    kind: fairmesh_selection_kind,
    array: Array,
}

/// A selection as the library takes it.
pub(crate) enum SelectedBy {
    Mask(Vec<bool>),
    Vertices(Cow<'static, [[u32; 1]]>),
    Faces(Vec<u32>),
}

impl SelectionIn {
    pub(crate) fn new(
        selection: *const fairmesh_selection,
        argument: Argument,
        mesh: &MeshIn,
        aliases: &mut AliasCheck,
    ) -> CallResult<Self> {
        use fairmesh_selection_kind as Kind;
        let nothing = Array {
            data: core::ptr::null_mut(),
            count: 0,
            stride: 1,
            bytes: 0,
        };
        if selection.is_null() {
            return Ok(Self {
                kind: Kind::Interior,
                array: nothing,
            });
        }
        let view = read_struct(selection, argument)?;
        let kind = match view.kind {
            0 => Kind::Interior,
            1 => Kind::FreeMask,
            2 => Kind::FixedMask,
            3 => Kind::FreeVertices,
            4 => Kind::Faces,
            other => {
                let place = argument.field(offset_of!(fairmesh_selection, kind), "kind");
                return Err(place.refuse(
                    Status::BadEnum,
                    format_args!("{other} is no fairmesh_selection_kind"),
                ));
            }
        };
        let place = argument.field(offset_of!(fairmesh_selection, count), "count");
        let array = match kind {
            Kind::Interior => {
                check_count(view.count, 0, place)?;
                nothing
            }
            Kind::FreeMask | Kind::FixedMask => {
                check_count(view.count, mesh.vertices(), place)?;
                entries(&view, 1, argument)?
            }
            Kind::FreeVertices | Kind::Faces => entries(&view, 4, argument)?,
        };
        aliases.input(selection, size_of::<fairmesh_selection>());
        aliases.input(array.data, array.bytes);
        Ok(Self { kind, array })
    }

    pub(crate) fn read(&self, mesh: &MeshIn) -> CallResult<SelectedBy> {
        use fairmesh_selection_kind as Kind;
        let array = &self.array;
        Ok(match self.kind {
            Kind::Interior => {
                let mut faces = try_with_capacity(mesh.triangles.count)?;
                faces.extend(0..mesh.triangles.count as u32);
                SelectedBy::Faces(faces)
            }
            Kind::FreeMask | Kind::FixedMask => {
                let free = self.kind == Kind::FreeMask;
                let mut mask = try_with_capacity(array.count)?;
                mask.extend((0..array.count).map(|k| (array.byte(k) != 0) == free));
                SelectedBy::Mask(mask)
            }
            Kind::FreeVertices => {
                let list = array.rows::<1>()?;
                Self::check(list.iter().flatten(), mesh.vertices(), fairmesh_element::Vertex)?;
                SelectedBy::Vertices(list)
            }
            Kind::Faces => {
                let mut faces = try_with_capacity(array.count)?;
                faces.extend((0..array.count).map(|k| array.index::<1>(k)[0]));
                Self::check(faces.iter(), mesh.triangles.count, fairmesh_element::Triangle)?;
                SelectedBy::Faces(faces)
            }
        })
    }

    fn check<'a>(list: impl Iterator<Item = &'a u32>, count: usize, kind: fairmesh_element) -> CallResult {
        for &index in list {
            if index as usize >= count {
                let why = format_args!("the selection names element {index}, but there are only {count}");
                return Err(Failure::new(Status::SelectionOutOfRange, why).at(kind, index as usize));
            }
        }
        Ok(())
    }
}

impl SelectedBy {
    pub(crate) fn selection(&self) -> Selection<'_> {
        match self {
            Self::Mask(mask) => Selection::Mask(mask),
            Self::Vertices(list) => Selection::Vertices(list.as_flattened()),
            Self::Faces(list) => Selection::Faces(list),
        }
    }

    /// Marks the vertices that may turn out to be free.
    pub(crate) fn candidates(&self, mesh: &MeshIn) -> CallResult<Vec<bool>> {
        let mut marked = try_with_capacity(mesh.vertices())?;
        match self {
            Self::Mask(mask) => marked.extend_from_slice(mask),
            Self::Vertices(list) => {
                marked.resize(mesh.vertices(), false);
                list.iter().for_each(|v| marked[v[0] as usize] = true);
            }
            Self::Faces(list) => {
                marked.resize(mesh.vertices(), false);
                for v in list.iter().flat_map(|&t| mesh.triangles.index::<3>(t as usize)) {
                    // What is out of range is found later.
                    if let Some(marked) = marked.get_mut(v as usize) {
                        *marked = true;
                    }
                }
            }
        }
        Ok(marked)
    }
}

/// A list of indices that may be left out, checked but not read.
pub(crate) struct IndicesIn(Array);

impl IndicesIn {
    pub(crate) fn optional(
        view: *const fairmesh_indices,
        argument: Argument,
        aliases: &mut AliasCheck,
    ) -> CallResult<Option<Self>> {
        if view.is_null() {
            return Ok(None);
        }
        check_pointer(view, argument)?;
        aliases.input(view, size_of::<fairmesh_indices>());
        // SAFETY: not NULL, aligned.
        let array = indices_in(&unsafe { view.read() }, 1, argument.start())?;
        aliases.input(array.data, array.bytes);
        Ok(Some(Self(array)))
    }

    pub(crate) fn count(&self) -> usize {
        self.0.count
    }

    pub(crate) fn read<'a>(&self) -> CallResult<Cow<'a, [[u32; 1]]>> {
        self.0.rows::<1>()
    }
}

/// Boundary normals, checked but not read.
pub(crate) struct NormalsIn {
    kind: fairmesh_boundary_normals_kind,
    vectors: Option<PointsIn>,
    vertices: Array,
}

impl NormalsIn {
    pub(crate) fn new(
        view: &fairmesh_boundary_normals,
        base: FieldPath,
        vertices: usize,
        aliases: &mut AliasCheck,
    ) -> CallResult<Self> {
        use fairmesh_boundary_normals_kind as Kind;
        check_reserved(
            view.reserved,
            base.field(offset_of!(fairmesh_boundary_normals, reserved), "reserved"),
        )?;
        let kind = match view.kind {
            0 => Kind::Fitted,
            1 => Kind::Averaged,
            2 => Kind::Given,
            other => {
                let place = base.field(offset_of!(fairmesh_boundary_normals, kind), "kind");
                return Err(place.refuse(
                    Status::BadEnum,
                    format_args!("{other} is no fairmesh_boundary_normals_kind"),
                ));
            }
        };
        let list = indices_in(
            &view.vertices,
            1,
            base.field(offset_of!(fairmesh_boundary_normals, vertices), "vertices"),
        )?;
        if kind != Kind::Given {
            return Ok(Self {
                kind,
                vectors: None,
                vertices: list,
            });
        }
        let place = base.field(offset_of!(fairmesh_boundary_normals, vectors), "vectors");
        let vectors = PointsIn::new(&view.vectors, place)?;
        let count = place.field(offset_of!(fairmesh_points, count), "count");
        check_given(&vectors.array, &list, vertices, count, aliases)?;
        Ok(Self {
            kind,
            vectors: Some(vectors),
            vertices: list,
        })
    }

    pub(crate) fn read(&self, vertices: usize) -> CallResult<BoundaryNormals> {
        let Some(vectors) = &self.vectors else {
            return Ok(match self.kind {
                fairmesh_boundary_normals_kind::Averaged => BoundaryNormals::Averaged,
                _ => BoundaryNormals::Fitted,
            });
        };
        let listed = !self.vertices.data.is_null();
        let count = vectors.array.count;
        let is_given = |n: &[f64; 3]| listed || *n != [0.0; 3];
        let mut given = try_with_capacity((0..count).filter(|&k| is_given(&vectors.get(k))).count())?;
        for k in 0..count {
            let n = vectors.get(k);
            let vertex = if listed {
                self.vertices.index::<1>(k)[0]
            } else {
                k as u32
            };
            if vertex as usize >= vertices {
                let why =
                    format_args!("a normal is given for vertex {vertex}, but there are only {vertices}");
                let failure = Failure::new(Status::SelectionOutOfRange, why);
                return Err(failure.at(fairmesh_element::Vertex, vertex as usize));
            }
            if is_given(&n) {
                given.push((vertex, n));
            }
        }
        Ok(BoundaryNormals::Given(given))
    }
}

/// Checks that there is a row for each vertex of the list, or without a list for each of the mesh, and takes note of both arrays.
fn check_given(
    rows: &Array,
    list: &Array,
    vertices: usize,
    count: FieldPath,
    aliases: &mut AliasCheck,
) -> CallResult {
    let wanted = if list.data.is_null() { vertices } else { list.count };
    check_count(rows.count, wanted, count)?;
    aliases.input(rows.data, rows.bytes);
    aliases.input(list.data, list.bytes);
    Ok(())
}

/// Mean curvatures at the boundary, checked but not read; None: fitted.
pub(crate) struct CurvatureIn(Option<GivenNumbers>);

struct GivenNumbers {
    values: NumbersIn<1>,
    vertices: Array,
}

impl CurvatureIn {
    pub(crate) fn new(
        view: &fairmesh_boundary_curvature,
        base: FieldPath,
        vertices: usize,
        aliases: &mut AliasCheck,
    ) -> CallResult<Self> {
        use fairmesh_boundary_curvature_kind as Kind;
        check_reserved(
            view.reserved,
            base.field(offset_of!(fairmesh_boundary_curvature, reserved), "reserved"),
        )?;
        let place = base.field(offset_of!(fairmesh_boundary_curvature, vertices), "vertices");
        let list = indices_in(&view.vertices, 1, place)?;
        if view.kind == Kind::Estimated as u32 {
            return Ok(Self(None));
        }
        if view.kind != Kind::Given as u32 {
            let place = base.field(offset_of!(fairmesh_boundary_curvature, kind), "kind");
            let why = format_args!("{} is no fairmesh_boundary_curvature_kind", view.kind);
            return Err(place.refuse(Status::BadEnum, why));
        }
        let place = base.field(offset_of!(fairmesh_boundary_curvature, values), "values");
        let values = NumbersIn::<1>::new(&view.values, place)?;
        let count = place.field(offset_of!(fairmesh_numbers, count), "count");
        check_given(&values.array, &list, vertices, count, aliases)?;
        let vertices = list;
        Ok(Self(Some(GivenNumbers { values, vertices })))
    }

    pub(crate) fn read(&self, vertices: usize) -> CallResult<BoundaryCurvature> {
        let Some(view) = &self.0 else {
            return Ok(BoundaryCurvature::Estimated);
        };
        let listed = !view.vertices.data.is_null();
        let count = view.values.array.count;
        let is_given = |h: f64| listed || !h.is_nan();
        let value = |k| view.values.get(k)[0];
        let mut given = try_with_capacity((0..count).filter(|&k| is_given(value(k))).count())?;
        for k in (0..count).filter(|&k| is_given(value(k))) {
            let (h, vertex) = match listed {
                true => (value(k), view.vertices.index::<1>(k)[0]),
                false => (value(k), k as u32),
            };
            let refused = |status, why| {
                let failure = Failure::new(status, why);
                Err(failure.at(fairmesh_element::Vertex, vertex as usize))
            };
            if vertex as usize >= vertices {
                let why =
                    format_args!("a curvature is given for vertex {vertex}, but there are only {vertices}");
                return refused(Status::SelectionOutOfRange, why);
            }
            if !h.is_finite() {
                let why = format_args!("the mean curvature given for vertex {vertex} is not finite");
                return refused(Status::BadOption, why);
            }
            given.push((vertex, h));
        }
        Ok(BoundaryCurvature::Given(given))
    }
}

/// Numbers for single boundary loops, checked but not read; None: there are none.
pub(crate) struct LoopsIn(Option<GivenNumbers>);

impl LoopsIn {
    pub(crate) fn new(
        view: &fairmesh_loop_continuity,
        base: FieldPath,
        aliases: &mut AliasCheck,
    ) -> CallResult<Self> {
        let place = base.field(offset_of!(fairmesh_loop_continuity, vertices), "vertices");
        let vertices = indices_in(&view.vertices, 1, place)?;
        if view.values.count == 0 && vertices.count == 0 {
            return Ok(Self(None));
        }
        let place = base.field(offset_of!(fairmesh_loop_continuity, values), "values");
        let values = NumbersIn::<1>::new(&view.values, place)?;
        let count = place.field(offset_of!(fairmesh_numbers, count), "count");
        check_count(values.array.count, vertices.count, count)?;
        aliases.input(values.array.data, values.array.bytes);
        aliases.input(vertices.data, vertices.bytes);
        Ok(Self(Some(GivenNumbers { values, vertices })))
    }

    /// Whether there is any.
    pub(crate) fn are_given(&self) -> bool {
        self.0.is_some()
    }

    pub(crate) fn read(&self, vertices: usize) -> CallResult<Vec<(u32, f64)>> {
        let Some(view) = &self.0 else {
            return Ok(Vec::new());
        };
        let mut given = try_with_capacity(view.vertices.count)?;
        for k in 0..view.vertices.count {
            let (vertex, [blend]) = (view.vertices.index::<1>(k)[0], view.values.get(k));
            let refused = |status, why| {
                let failure = Failure::new(status, why);
                Err(failure.at(fairmesh_element::Vertex, vertex as usize))
            };
            if vertex as usize >= vertices {
                let why = format_args!(
                    "a continuity is given for the loop of vertex {vertex}, but there are only {vertices}"
                );
                return refused(Status::SelectionOutOfRange, why);
            }
            if !(0.0..=1.0).contains(&blend) {
                let why = format_args!(
                    "the continuity given for the loop of vertex {vertex} is not between 0 and 1"
                );
                return refused(Status::BadOption, why);
            }
            given.push((vertex, blend));
        }
        Ok(given)
    }
}
