//! What the caller hands over, checked and turned into what the library takes.

use std::borrow::Cow;

use super::choices::{choice, choose};
use super::status::{CallResult, Failure, fairmesh_element, fairmesh_status as Status};
use super::types::*;
use super::views::{
    Argument, Array, Call, FieldPath, Numbers, Points, check_count, check_reserved, entries, field,
    indices_in, known, try_with_capacity,
};
use fairmesh::{BoundaryCurvature, BoundaryNormals, Coincident, Selection};

/// A mesh, checked but not read.
pub(crate) struct MeshIn {
    pub positions: Points,
    pub triangles: Array,
    pub coincident: Coincident,
}

fn coincident(view: &fairmesh_mesh, argument: Argument) -> CallResult<Coincident> {
    let join = Coincident::Join {
        within: view.coincident_within,
    };
    let chosen = choose(
        [join, Coincident::Separate],
        |choice| choice.entry().number(),
        view.coincident,
        "fairmesh_coincident",
        field!(argument, fairmesh_mesh.coincident),
    )?;
    // The distance has to be one even where it is not used.
    let place = field!(argument, fairmesh_mesh.coincident_within);
    join.validate()
        .map_err(|error| place.blame(Failure::from(error)))?;
    Ok(chosen)
}

impl MeshIn {
    pub(crate) fn new(mesh: *const fairmesh_mesh, argument: Argument, call: &mut Call) -> CallResult<Self> {
        let view = call.read_struct(mesh, argument)?;
        let coincident = coincident(&view, argument)?;
        let positions = Points::points_in(&view.positions, field!(argument, fairmesh_mesh.positions))?;
        let triangles = indices_in(&view.triangles, 3, field!(argument, fairmesh_mesh.triangles))?;
        for (count, what) in [
            (positions.array.count, "vertices"),
            (triangles.count, "triangles"),
        ] {
            if count > (u32::MAX / 3) as usize {
                let why = format_args!("{count} {what}: more than 32-bit indices can name");
                return Err(Failure::new(Status::TooLarge, why));
            }
        }
        call.input(positions.array.memory());
        call.input(triangles.memory());
        Ok(Self {
            positions,
            triangles,
            coincident,
        })
    }

    pub(crate) fn vertices(&self) -> usize {
        self.positions.array.count
    }

    /// Positions and triangles as the library wants them.
    #[allow(clippy::type_complexity, reason = "two arrays")]
    pub(crate) fn read<'a>(&self) -> CallResult<(Cow<'a, [[f64; 3]]>, Cow<'a, [[u32; 3]]>)> {
        Ok((self.positions.read()?, self.triangles.rows()?))
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
    Vertices(Cow<'static, [u32]>),
    Faces(Vec<u32>),
}

impl SelectionIn {
    pub(crate) fn new(
        selection: *const fairmesh_selection,
        argument: Argument,
        mesh: &MeshIn,
        call: &mut Call,
    ) -> CallResult<Self> {
        use fairmesh_selection_kind as Kind;
        let nothing = indices_in(&fairmesh_indices::default(), 1, argument.start())?;
        if selection.is_null() {
            return Ok(Self {
                kind: Kind::Interior,
                array: nothing,
            });
        }
        let view = call.read_struct(selection, argument)?;
        let kind = choice(view.kind, field!(argument, fairmesh_selection.kind))?;
        let place = field!(argument, fairmesh_selection.count);
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
        call.input(array.memory());
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
                let list = array.list()?;
                for &v in &*list {
                    known(v, mesh.vertices(), fairmesh_element::Vertex, NAMED)?;
                }
                SelectedBy::Vertices(list)
            }
            Kind::Faces => {
                SelectedBy::Faces(array.known(mesh.triangles.count, fairmesh_element::Triangle, NAMED)?)
            }
        })
    }
}

const NAMED: &str = "the selection names element";

impl SelectedBy {
    pub(crate) fn selection(&self) -> Selection<'_> {
        match self {
            Self::Mask(mask) => Selection::Mask(mask),
            Self::Vertices(list) => Selection::Vertices(list),
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
                list.iter().for_each(|v| marked[*v as usize] = true);
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

/// A list of indices, checked but not read.
pub(crate) fn list_in(
    view: *const fairmesh_indices,
    argument: Argument,
    call: &mut Call,
) -> CallResult<Array> {
    let array = indices_in(&call.read(view, argument)?, 1, argument.start())?;
    call.input(array.memory());
    Ok(array)
}

/// One that may be left out.
pub(crate) fn optional_list_in(
    view: *const fairmesh_indices,
    argument: Argument,
    call: &mut Call,
) -> CallResult<Option<Array>> {
    (!view.is_null())
        .then(|| list_in(view, argument, call))
        .transpose()
}

/// Rows of `N` numbers, each for a vertex: of a list, or without one for all vertices of the mesh. Checked but not read.
struct Given<const N: usize> {
    values: Numbers<N>,
    vertices: Array,
}

impl<const N: usize> Given<N> {
    /// `count` is the place of the rows' count, which is `wanted`.
    fn new(
        values: Numbers<N>,
        vertices: Array,
        wanted: usize,
        count: FieldPath,
        call: &mut Call,
    ) -> CallResult<Self> {
        check_count(values.array.count, wanted, count)?;
        call.input(values.array.memory());
        call.input(vertices.memory());
        Ok(Self { values, vertices })
    }

    /// As many as the list has, or as the mesh has vertices.
    fn wanted(list: &Array, vertices: usize) -> usize {
        if list.data.is_null() { vertices } else { list.count }
    }

    /// The rows, of those without a list only what `is_given`; `what` says what a vertex gets.
    fn read(
        &self,
        vertices: usize,
        what: &str,
        is_given: impl Fn(&[f64; N]) -> bool,
    ) -> CallResult<Vec<(u32, [f64; N])>> {
        let listed = !self.vertices.data.is_null();
        let count = self.values.array.count;
        let is_row = |k: &usize| listed || is_given(&self.values.get(*k));
        let mut given = try_with_capacity((0..count).filter(is_row).count())?;
        for k in (0..count).filter(is_row) {
            let vertex = if listed {
                self.vertices.index::<1>(k)[0]
            } else {
                k as u32
            };
            known(vertex, vertices, fairmesh_element::Vertex, what)?;
            given.push((vertex, self.values.get(k)));
        }
        Ok(given)
    }
}

/// Single numbers, all of which have to be such; otherwise `why` stands around the vertex.
fn checked(
    given: Vec<(u32, [f64; 1])>,
    is_good: fn(f64) -> bool,
    why: [&str; 2],
) -> CallResult<Vec<(u32, f64)>> {
    if let Some((vertex, _)) = given.iter().find(|(_, [x])| !is_good(*x)) {
        let [before, behind] = why;
        let failure = Failure::new(Status::BadOption, format_args!("{before} {vertex} {behind}"));
        return Err(failure.at(fairmesh_element::Vertex, *vertex as usize));
    }
    Ok(given.into_iter().map(|(vertex, [x])| (vertex, x)).collect())
}

/// Boundary normals, checked but not read.
pub(crate) struct NormalsIn {
    kind: fairmesh_boundary_normals_kind,
    given: Option<Given<3>>,
}

impl NormalsIn {
    pub(crate) fn new(
        view: &fairmesh_boundary_normals,
        base: FieldPath,
        vertices: usize,
        call: &mut Call,
    ) -> CallResult<Self> {
        use fairmesh_boundary_normals_kind as Kind;
        check_reserved(view.reserved, field!(base, fairmesh_boundary_normals.reserved))?;
        let kind = choice(view.kind, field!(base, fairmesh_boundary_normals.kind))?;
        let list = indices_in(
            &view.vertices,
            1,
            field!(base, fairmesh_boundary_normals.vertices),
        )?;
        let mut given = None;
        if kind == Kind::Given {
            let place = field!(base, fairmesh_boundary_normals.vectors);
            let vectors = Points::points_in(&view.vectors, place)?;
            let (count, wanted) = (
                field!(place, fairmesh_points.count),
                Given::<3>::wanted(&list, vertices),
            );
            given = Some(Given::new(vectors, list, wanted, count, call)?);
        }
        Ok(Self { kind, given })
    }

    pub(crate) fn read(&self, vertices: usize) -> CallResult<BoundaryNormals> {
        Ok(match (&self.given, self.kind) {
            (Some(given), _) => {
                let is_given = |n: &[f64; 3]| *n != [0.0; 3];
                BoundaryNormals::Given(given.read(vertices, "a normal is given for vertex", is_given)?)
            }
            (None, fairmesh_boundary_normals_kind::Averaged) => BoundaryNormals::Averaged,
            (None, _) => BoundaryNormals::Fitted,
        })
    }
}

/// Mean curvatures at the boundary, checked but not read; None: fitted.
pub(crate) struct CurvatureIn(Option<Given<1>>);

impl CurvatureIn {
    pub(crate) fn new(
        view: &fairmesh_boundary_curvature,
        base: FieldPath,
        vertices: usize,
        call: &mut Call,
    ) -> CallResult<Self> {
        use fairmesh_boundary_curvature_kind as Kind;
        check_reserved(view.reserved, field!(base, fairmesh_boundary_curvature.reserved))?;
        let list = indices_in(
            &view.vertices,
            1,
            field!(base, fairmesh_boundary_curvature.vertices),
        )?;
        let kind: Kind = choice(view.kind, field!(base, fairmesh_boundary_curvature.kind))?;
        if kind == Kind::Estimated {
            return Ok(Self(None));
        }
        let place = field!(base, fairmesh_boundary_curvature.values);
        let values = Numbers::numbers_in(&view.values, place)?;
        let (count, wanted) = (
            field!(place, fairmesh_numbers.count),
            Given::<1>::wanted(&list, vertices),
        );
        Given::new(values, list, wanted, count, call).map(|given| Self(Some(given)))
    }

    pub(crate) fn read(&self, vertices: usize) -> CallResult<BoundaryCurvature> {
        let Some(given) = &self.0 else {
            return Ok(BoundaryCurvature::Estimated);
        };
        let given = given.read(vertices, "a curvature is given for vertex", |[h]| !h.is_nan())?;
        let why = ["the mean curvature given for vertex", "is not finite"];
        checked(given, f64::is_finite, why).map(BoundaryCurvature::Given)
    }
}

/// Numbers for single boundary loops, checked but not read; None: there are none.
pub(crate) struct LoopsIn(Option<Given<1>>);

impl LoopsIn {
    pub(crate) fn new(view: &fairmesh_loop_continuity, base: FieldPath, call: &mut Call) -> CallResult<Self> {
        let vertices = indices_in(&view.vertices, 1, field!(base, fairmesh_loop_continuity.vertices))?;
        if view.values.count == 0 && vertices.count == 0 {
            return Ok(Self(None));
        }
        let place = field!(base, fairmesh_loop_continuity.values);
        let values = Numbers::numbers_in(&view.values, place)?;
        let count = field!(place, fairmesh_numbers.count);
        Given::new(values, vertices, vertices.count, count, call).map(|given| Self(Some(given)))
    }

    /// Whether there is any.
    pub(crate) fn are_given(&self) -> bool {
        self.0.is_some()
    }

    pub(crate) fn read(&self, vertices: usize) -> CallResult<Vec<(u32, f64)>> {
        let Some(given) = &self.0 else {
            return Ok(Vec::new());
        };
        let what = "a continuity is given for the loop of vertex";
        let given = given.read(vertices, what, |_| true)?;
        let why = [
            "the continuity given for the loop of vertex",
            "is not between 0 and 1",
        ];
        checked(given, |blend| (0.0..=1.0).contains(&blend), why)
    }
}
