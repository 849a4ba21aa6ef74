//! OpenMesh's triangle meshes and their smoother, safe to use.
//!
//! Coordinates are exchanged as `f64`; a `Mesh<f32>` stores them as floats. Elements have OpenMesh's own numbers, deleted ones
//! included. An index that does not exist panics.

use std::ffi::{CStr, CString};
use std::fmt;
use std::marker::PhantomData;
use std::path::Path;
use std::ptr::NonNull;

use crate::ffi;

/// What OpenMesh refused, in its or the shim's words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Error(String);

impl fmt::Display for Error {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.0)
    }
}

impl std::error::Error for Error {}

fn last_error() -> Error {
    // SAFETY: a string that lives until this thread's next call.
    let text = unsafe { CStr::from_ptr(ffi::om_last_error()) };
    Error(text.to_string_lossy().into_owned())
}

mod sealed {
    pub trait Sealed {
        const SCALAR: u32;
    }
    impl Sealed for f32 {
        const SCALAR: u32 = crate::ffi::OM_FLOAT;
    }
    impl Sealed for f64 {
        const SCALAR: u32 = crate::ffi::OM_DOUBLE;
    }
}

/// The numbers that a mesh stores: `f32` or `f64`.
pub trait Scalar: sealed::Sealed {}
impl Scalar for f32 {}
impl Scalar for f64 {}

/// What has a status.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Element {
    /// A vertex, by its number.
    Vertex(usize),
    /// An edge.
    Edge(usize),
    /// A face.
    Face(usize),
}

/// Bits of a status.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum Flag {
    /// Chosen by the user: if any vertex is, the smoother moves no others.
    Selected = ffi::OM_SELECTED,
    /// Not to be moved.
    Locked = ffi::OM_LOCKED,
    /// Part of a feature.
    Feature = ffi::OM_FEATURE,
}

/// Which part of a step the smoother takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum Component {
    /// Within the surface, equal weights.
    Tangential = ffi::OM_TANGENTIAL,
    /// All of it, cotangent weights of the surface at the start.
    Normal = ffi::OM_NORMAL,
    /// All of it, equal weights.
    Both = ffi::OM_TANGENTIAL_AND_NORMAL,
}

/// The operator that the smoother makes vanish.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum Continuity {
    /// The umbrella.
    C0 = ffi::OM_C0,
    /// The umbrella of umbrellas.
    C1 = ffi::OM_C1,
}

/// What the smoother is asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Smoothing {
    /// Which part of a step.
    pub component: Component,
    /// Which operator.
    pub continuity: Continuity,
    /// How often.
    pub iterations: u32,
    /// Vertices of features stay.
    pub skip_features: bool,
}

impl Smoothing {
    /// C1, whole steps, features ignored.
    pub fn c1(iterations: u32) -> Self {
        Self {
            component: Component::Both,
            continuity: Continuity::C1,
            iterations,
            skip_features: false,
        }
    }
}

/// A `TriMesh_ArrayKernelT` with status and normals.
pub struct Mesh<S: Scalar> {
    handle: NonNull<ffi::om_mesh>,
    scalar: PhantomData<S>,
}

impl<S: Scalar> Drop for Mesh<S> {
    fn drop(&mut self) {
        // SAFETY: made by the shim, and given up here.
        unsafe { ffi::om_mesh_free(self.handle.as_ptr()) }
    }
}

impl<S: Scalar> fmt::Debug for Mesh<S> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            out,
            "Mesh({} vertices, {} faces)",
            self.vertex_count(),
            self.face_count()
        )
    }
}

fn c_path(path: &Path) -> Result<CString, Error> {
    CString::new(path.as_os_str().as_encoded_bytes()).map_err(|_| Error("a path with a NUL in it".to_owned()))
}

impl<S: Scalar> Mesh<S> {
    fn owned(handle: *mut ffi::om_mesh) -> Result<Self, Error> {
        let handle = NonNull::new(handle).ok_or_else(last_error)?;
        Ok(Self {
            handle,
            scalar: PhantomData,
        })
    }

    /// A mesh of these triangles. OpenMesh refuses those that make an edge or vertex that is not a manifold.
    pub fn new(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<Self, Error> {
        // SAFETY: as many coordinates and indices as the counts say; indices are checked there.
        let handle = unsafe {
            ffi::om_mesh_build(
                S::SCALAR,
                positions.as_flattened().as_ptr(),
                positions.len(),
                triangles.as_flattened().as_ptr(),
                triangles.len(),
            )
        };
        Self::owned(handle)
    }

    /// Reads a file; its ending says the format.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let path = c_path(path)?;
        // SAFETY: a string with its NUL.
        Self::owned(unsafe { ffi::om_mesh_read(S::SCALAR, path.as_ptr()) })
    }

    /// Writes a file; its ending says the format.
    pub fn write(&self, path: &Path) -> Result<(), Error> {
        let path = c_path(path)?;
        // SAFETY: a living mesh, a string with its NUL.
        let done = unsafe { ffi::om_mesh_write(self.handle.as_ptr(), path.as_ptr()) };
        done.then_some(()).ok_or_else(last_error)
    }

    fn count(&self, element: u32) -> usize {
        // SAFETY: a living mesh.
        unsafe { ffi::om_mesh_count(self.handle.as_ptr(), element) }
    }

    /// Vertices, deleted ones included.
    pub fn vertex_count(&self) -> usize {
        self.count(ffi::OM_VERTEX)
    }

    /// Edges, deleted ones included.
    pub fn edge_count(&self) -> usize {
        self.count(ffi::OM_EDGE)
    }

    /// Faces, deleted ones included.
    pub fn face_count(&self) -> usize {
        self.count(ffi::OM_FACE)
    }

    /// All positions.
    pub fn positions(&self) -> Vec<[f64; 3]> {
        let mut all = vec![[0.0; 3]; self.vertex_count()];
        // SAFETY: room for all vertices.
        unsafe { ffi::om_mesh_positions(self.handle.as_ptr(), all.as_flattened_mut().as_mut_ptr()) }
        all
    }

    /// Moves all vertices.
    pub fn set_positions(&mut self, positions: &[[f64; 3]]) {
        assert_eq!(positions.len(), self.vertex_count());
        // SAFETY: as many as there are vertices.
        unsafe { ffi::om_mesh_set_positions(self.handle.as_ptr(), positions.as_flattened().as_ptr()) }
    }

    /// All triangles.
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        let mut all = vec![[0; 3]; self.face_count()];
        // SAFETY: room for all faces, which have three corners each.
        unsafe { ffi::om_mesh_triangles(self.handle.as_ptr(), all.as_flattened_mut().as_mut_ptr()) }
        all
    }

    /// The edge between two vertices.
    pub fn edge(&self, a: usize, b: usize) -> Option<usize> {
        assert!(a.max(b) < self.vertex_count());
        // SAFETY: a living mesh, vertices of it.
        let edge = unsafe { ffi::om_mesh_edge(self.handle.as_ptr(), a, b) };
        (edge != usize::MAX).then_some(edge)
    }

    fn checked(&self, element: Element) -> (u32, usize) {
        let (kind, index) = match element {
            Element::Vertex(index) => (ffi::OM_VERTEX, index),
            Element::Edge(index) => (ffi::OM_EDGE, index),
            Element::Face(index) => (ffi::OM_FACE, index),
        };
        assert!(index < self.count(kind), "{element:?} does not exist");
        (kind, index)
    }

    /// A bit of a status.
    pub fn status(&self, element: Element, flag: Flag) -> bool {
        let (kind, index) = self.checked(element);
        // SAFETY: an element of a living mesh.
        unsafe { ffi::om_mesh_status(self.handle.as_ptr(), kind, index, flag as u32) }
    }

    /// Sets a bit of a status.
    pub fn set_status(&mut self, element: Element, flag: Flag, value: bool) {
        let (kind, index) = self.checked(element);
        // SAFETY: an element of a living mesh.
        unsafe { ffi::om_mesh_set_status(self.handle.as_ptr(), kind, index, flag as u32, value) }
    }

    /// Selects these vertices and no others.
    pub fn select(&mut self, vertices: &[bool]) {
        assert_eq!(vertices.len(), self.vertex_count());
        for (v, &chosen) in vertices.iter().enumerate() {
            self.set_status(Element::Vertex(v), Flag::Selected, chosen);
        }
    }

    /// Computes the normals of faces and vertices.
    pub fn update_normals(&mut self) {
        // SAFETY: a living mesh.
        unsafe { ffi::om_mesh_update_normals(self.handle.as_ptr()) }
    }

    /// Vertex normals as they were computed last; zero before.
    pub fn normals(&self) -> Vec<[f64; 3]> {
        let mut all = vec![[0.0; 3]; self.vertex_count()];
        // SAFETY: room for all vertices.
        unsafe { ffi::om_mesh_normals(self.handle.as_ptr(), all.as_flattened_mut().as_mut_ptr()) }
        all
    }

    /// Smooths the selected vertices, or all if none is selected; never those of the mesh's boundary, nor locked ones. C1
    /// leaves their neighbours, too.
    pub fn smooth(&mut self, asked: Smoothing) -> Result<(), Error> {
        // SAFETY: a living mesh; the numbers are those of the shim.
        let done = unsafe {
            ffi::om_mesh_smooth(
                self.handle.as_ptr(),
                asked.component as u32,
                asked.continuity as u32,
                asked.iterations,
                asked.skip_features,
            )
        };
        done.then_some(()).ok_or_else(last_error)
    }
}
