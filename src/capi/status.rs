//! Status numbers, the error detail, and what of the library's errors becomes which.

use core::ffi::c_char;
use std::fmt::{self, Write};

use fairmesh::Error;

/// Bytes of the text in `fairmesh_error`.
pub(crate) const MESSAGE: usize = 232;

/// Whether a call did what it was asked. How a solve ended is another matter, see `fairmesh_outcome`. Numbers are never
/// reused. After any status but OK no output was written, except for the `fairmesh_error`.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum fairmesh_status {
    /// Done.
    Ok = 0,
    /// A pointer is NULL that may not be. Element: the argument.
    NullPointer = 1,
    /// A pointer or a stride does not have the alignment of what it points to. Element: the argument.
    Misaligned = 2,
    /// `struct_size` is not one that this library knows. Element: the argument.
    BadStructSize = 3,
    /// A number in the options is out of its range. Element: the argument and the field.
    BadOption = 4,
    /// A number is not one of the enumeration that is meant. Element: the argument and the field.
    BadEnum = 5,
    /// A stride is smaller than what it steps over. Element: the argument and the field.
    BadStride = 6,
    /// A count times its stride exceeds the address space. Element: the argument and the field.
    CountOverflow = 7,
    /// Two counts differ that have to be the same. Element: the argument and the field.
    CountMismatch = 8,
    /// An output overlaps an input or another output. Only positions may be written over those that were read, with
    /// the same address, stride and scalar. Element: the argument of the output.
    Aliasing = 9,
    /// Not a living handle of the kind that is meant: never made, or freed before. Element: the argument.
    BadHandle = 10,
    /// The handle is in use: by another thread, or by the call whose callback this call comes from.
    Busy = 11,
    /// Memory ran out. Everything that the call had allocated is free again; a solver stays usable.
    OutOfMemory = 12,
    /// The system gave no more threads.
    Threads = 13,
    /// More vertices or triangles than 32-bit indices can name.
    TooLarge = 14,
    /// A coordinate that is needed is NaN or infinite (or does not fit a float on its way out). Element: the vertex.
    NotFinite = 15,
    /// A triangle names a vertex that does not exist. Element: the triangle; other: the index.
    IndexOutOfRange = 16,
    /// A triangle names a vertex twice. Element: the triangle; other: the vertex.
    RepeatedIndex = 17,
    /// Two triangles have the same vertices. Element: the later triangle; other: the earlier one.
    DuplicateTriangle = 18,
    /// More than two triangles share an edge. Element: the edge.
    NonManifoldEdge = 19,
    /// The triangles around a vertex are not one fan. Element: the vertex.
    NonManifoldVertex = 20,
    /// Two triangles run through an edge in the same direction. Element: the edge.
    InconsistentOrientation = 21,
    /// A free vertex is on the boundary of the mesh. Element: the vertex.
    FreeVertexOnBoundary = 22,
    /// A free vertex has no triangle. Element: the vertex.
    FreeVertexWithoutTriangle = 23,
    /// A component of the region has no fixed vertex. Element: the free vertex with the smallest index in it.
    NothingFixed = 24,
    /// No vertex is free.
    EmptyRegion = 25,
    /// The selection names what does not exist. Element: what it names, a vertex, triangle or loop.
    SelectionOutOfRange = 26,
    /// A normal is not a finite vector of length one (to 0.001). Element: the vertex.
    BadNormal = 27,
    /// No normal can be found for a boundary vertex: give one. Element: the vertex.
    NoNormal = 28,
    /// The result has nothing of this kind, or nothing with this index.
    NotAvailable = 29,
    /// The buffer is too small; the size needed has been told.
    BufferTooSmall = 30,
    /// A number is not what this version asks for: reserved fields have to be zero. Element: the argument and the field.
    BadReserved = 31,
    /// A bug of fairmesh, caught. The handle, if there was one, answers INTERNAL from now on; free it.
    Internal = 99,
}

use fairmesh_status as Status;

impl Status {
    const ALL: [Status; 33] = {
        use Status::*;
        [
            Ok,
            NullPointer,
            Misaligned,
            BadStructSize,
            BadOption,
            BadEnum,
            BadStride,
            CountOverflow,
            CountMismatch,
            Aliasing,
            BadHandle,
            Busy,
            OutOfMemory,
            Threads,
            TooLarge,
            NotFinite,
            IndexOutOfRange,
            RepeatedIndex,
            DuplicateTriangle,
            NonManifoldEdge,
            NonManifoldVertex,
            InconsistentOrientation,
            FreeVertexOnBoundary,
            FreeVertexWithoutTriangle,
            NothingFixed,
            EmptyRegion,
            SelectionOutOfRange,
            BadNormal,
            NoNormal,
            NotAvailable,
            BufferTooSmall,
            BadReserved,
            Internal,
        ]
    };

    /// The name for people, of any number.
    pub fn name(number: i32) -> &'static core::ffi::CStr {
        match Self::ALL.into_iter().find(|s| *s as i32 == number) {
            Some(Self::Ok) => c"ok",
            Some(Self::NullPointer) => c"null pointer",
            Some(Self::Misaligned) => c"misaligned",
            Some(Self::BadStructSize) => c"bad struct size",
            Some(Self::BadOption) => c"bad option",
            Some(Self::BadEnum) => c"bad enum",
            Some(Self::BadStride) => c"bad stride",
            Some(Self::CountOverflow) => c"count overflow",
            Some(Self::CountMismatch) => c"count mismatch",
            Some(Self::Aliasing) => c"aliasing",
            Some(Self::BadHandle) => c"bad handle",
            Some(Self::Busy) => c"busy",
            Some(Self::OutOfMemory) => c"out of memory",
            Some(Self::Threads) => c"threads",
            Some(Self::TooLarge) => c"too large",
            Some(Self::NotFinite) => c"not finite",
            Some(Self::IndexOutOfRange) => c"index out of range",
            Some(Self::RepeatedIndex) => c"repeated index",
            Some(Self::DuplicateTriangle) => c"duplicate triangle",
            Some(Self::NonManifoldEdge) => c"non-manifold edge",
            Some(Self::NonManifoldVertex) => c"non-manifold vertex",
            Some(Self::InconsistentOrientation) => c"inconsistent orientation",
            Some(Self::FreeVertexOnBoundary) => c"free vertex on boundary",
            Some(Self::FreeVertexWithoutTriangle) => c"free vertex without triangle",
            Some(Self::NothingFixed) => c"nothing fixed",
            Some(Self::EmptyRegion) => c"empty region",
            Some(Self::SelectionOutOfRange) => c"selection out of range",
            Some(Self::BadNormal) => c"bad normal",
            Some(Self::NoNormal) => c"no normal",
            Some(Self::NotAvailable) => c"not available",
            Some(Self::BufferTooSmall) => c"buffer too small",
            Some(Self::BadReserved) => c"bad reserved",
            Some(Self::Internal) => c"internal",
            None => c"unknown status",
        }
    }
}

/// What `element` of a `fairmesh_error` counts.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum fairmesh_element {
    /// Nothing.
    None = 0,
    /// A vertex of the mesh given.
    Vertex = 1,
    /// A triangle of the mesh given.
    Triangle = 2,
    /// An edge: `element` and `other` are its vertices, the smaller first.
    Edge = 3,
    /// An argument of the function, counted from 1; `other` is the offset of the field in the struct that it points
    /// to, or FAIRMESH_NO_ELEMENT for the argument itself.
    Argument = 4,
    /// A boundary loop.
    Loop = 5,
}

/// In place of an index: there is none.
pub(crate) const FAIRMESH_NO_ELEMENT: u64 = u64::MAX;

/// What went wrong. 256 bytes for ever; the caller's. A parameter of this type may be NULL. Every call writes it (unless it
/// overlaps something else), with
/// status OK, NO_ELEMENT and an empty message when it succeeds.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_error {
    /// The status that the call returned.
    pub status: i32,
    /// A `fairmesh_element`: what the next two numbers count.
    pub element_kind: u32,
    /// The offending element, or FAIRMESH_NO_ELEMENT.
    pub element: u64,
    /// A second one where the status says so, or FAIRMESH_NO_ELEMENT.
    pub other: u64,
    /// A sentence in English, ending with a NUL; UTF-8.
    pub message: [c_char; 232],
}

/// Why a call fails. Needs no memory but its own.
#[derive(Clone, Copy)]
pub(crate) struct Failure {
    pub status: Status,
    pub kind: fairmesh_element,
    pub element: u64,
    pub other: u64,
    pub message: Text<MESSAGE>,
    /// The error detail itself is in the way.
    pub silent: bool,
}

pub(crate) type CallResult<T = ()> = Result<T, Failure>;

/// Text in a fixed array; too long a text is cut.
#[derive(Clone, Copy)]
pub(crate) struct Text<const N: usize> {
    bytes: [u8; N],
    length: usize,
}

impl<const N: usize> Text<N> {
    pub(crate) fn new(what: fmt::Arguments<'_>) -> Self {
        let mut text = Self {
            bytes: [0; N],
            length: 0,
        };
        let _ = text.write_fmt(what);
        text
    }

    pub(crate) fn characters(&self) -> [c_char; N] {
        self.bytes.map(|b| b as c_char)
    }
}

impl<const N: usize> Write for Text<N> {
    fn write_str(&mut self, s: &str) -> fmt::Result {
        for c in s.chars() {
            // One byte stays zero.
            if self.length + c.len_utf8() >= N {
                return Err(fmt::Error);
            }
            c.encode_utf8(&mut self.bytes[self.length..]);
            self.length += c.len_utf8();
        }
        Ok(())
    }
}

impl Failure {
    pub(crate) fn new(status: Status, message: fmt::Arguments<'_>) -> Self {
        Self {
            status,
            kind: fairmesh_element::None,
            element: FAIRMESH_NO_ELEMENT,
            other: FAIRMESH_NO_ELEMENT,
            message: Text::new(message),
            silent: false,
        }
    }

    pub(crate) fn at(self, kind: fairmesh_element, element: usize) -> Self {
        Self {
            kind,
            element: element as u64,
            ..self
        }
    }

    pub(crate) fn and(self, other: usize) -> Self {
        Self {
            other: other as u64,
            ..self
        }
    }

    pub(crate) fn out_of_memory() -> Self {
        Self::new(Status::OutOfMemory, format_args!("memory ran out"))
    }

    pub(crate) fn detail(&self) -> fairmesh_error {
        fairmesh_error {
            status: self.status as i32,
            element_kind: self.kind as u32,
            element: self.element,
            other: self.other,
            message: self.message.characters(),
        }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        use fairmesh_element::{Edge, Triangle, Vertex};
        let of = |status| Self::new(status, format_args!("{error}"));
        match error {
            Error::IndexOutOfRange { triangle, index, .. } => of(Status::IndexOutOfRange)
                .at(Triangle, triangle)
                .and(index as usize),
            Error::NotFinite { vertex } => of(Status::NotFinite).at(Vertex, vertex),
            Error::RepeatedIndex { triangle, vertex } => {
                of(Status::RepeatedIndex).at(Triangle, triangle).and(vertex)
            }
            Error::DuplicateTriangle { triangle, other } => {
                of(Status::DuplicateTriangle).at(Triangle, triangle).and(other)
            }
            Error::NonManifoldEdge { a, b, .. } => of(Status::NonManifoldEdge).at(Edge, a).and(b),
            Error::NonManifoldVertex { vertex } => of(Status::NonManifoldVertex).at(Vertex, vertex),
            Error::InconsistentOrientation { a, b, .. } => {
                of(Status::InconsistentOrientation).at(Edge, a).and(b)
            }
            Error::FreeVertexOnBoundary { vertex } => of(Status::FreeVertexOnBoundary).at(Vertex, vertex),
            Error::FreeVertexWithoutTriangle { vertex } => {
                of(Status::FreeVertexWithoutTriangle).at(Vertex, vertex)
            }
            Error::NothingFixed { vertex } => of(Status::NothingFixed).at(Vertex, vertex),
            Error::EmptyRegion => of(Status::EmptyRegion),
            Error::SelectionOutOfRange { index, .. } => of(Status::SelectionOutOfRange).at(Vertex, index),
            Error::MaskLength { .. } => of(Status::CountMismatch),
            Error::BadNormal { vertex } => of(Status::BadNormal).at(Vertex, vertex),
            Error::NoNormal { vertex } => of(Status::NoNormal).at(Vertex, vertex),
            Error::BadOption { .. } => of(Status::BadOption),
            Error::TooLarge { .. } => of(Status::TooLarge),
            Error::Threads { .. } => of(Status::Threads),
            _ => of(Status::Internal),
        }
    }
}
