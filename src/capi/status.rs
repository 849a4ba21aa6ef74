//! Status numbers, the error detail, and what of the library's errors becomes which.

use std::ffi::c_char;
use std::fmt::{self, Write};

use fairmesh::Error;

/// Bytes of the text in `fairmesh_error`.
pub(crate) const MESSAGE: usize = 232;

pub(crate) use super::numbers::fairmesh_status;
use fairmesh_status as Status;

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
pub const FAIRMESH_NO_ELEMENT: u64 = u64::MAX;

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
    /// A second one, or FAIRMESH_NO_ELEMENT: of a triangle the index or the vertex that it names wrongly, or the earlier
    /// triangle; of an edge its other end; of an argument the offset of the field.
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
        let failure = Self::new(
            Status::from_number(error.entry().number()),
            format_args!("{error}"),
        );
        match error {
            Error::IndexOutOfRange { triangle, index, .. } => {
                failure.at(Triangle, triangle).and(index as usize)
            }
            Error::RepeatedIndex { triangle, vertex } => failure.at(Triangle, triangle).and(vertex),
            Error::DuplicateTriangle { triangle, other } => failure.at(Triangle, triangle).and(other),
            Error::NonManifoldEdge { a, b, .. }
            | Error::InconsistentOrientation { a, b, .. }
            | Error::BadGuide { a, b, .. }
            | Error::NotAnEdge { a, b }
            | Error::GuidesCross { first: [a, b], .. } => failure.at(Edge, a).and(b),
            Error::NotFinite { vertex }
            | Error::CoordinateTooLarge { vertex, .. }
            | Error::NonManifoldVertex { vertex }
            | Error::FreeVertexOnBoundary { vertex }
            | Error::FreeVertexWithoutTriangle { vertex }
            | Error::NothingFixed { vertex }
            | Error::SelectionOutOfRange { index: vertex, .. }
            | Error::BadNormal { vertex }
            | Error::NoNormal { vertex }
            | Error::NotOnLoop { vertex }
            | Error::BadChain { vertex, .. }
            | Error::BadEdit {
                vertex: Some(vertex), ..
            }
            | Error::ValenceTooLarge { vertex, .. } => failure.at(Vertex, vertex),
            _ => failure,
        }
    }
}
