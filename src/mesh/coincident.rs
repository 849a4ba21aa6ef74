//! Meshes that name one vertex of the surface by several numbers: triangle soups, texture seams, split normals.
//!
//! The mesh is joined in the caller's own numbers: triangles name the smallest number of each vertex, its other numbers, the copies,
//! have no triangles then. So nothing that is told of the joined mesh has to be renumbered.

use std::borrow::Cow;

use super::input;
use super::selection::Selection;
use super::stitches::representatives;
use crate::support::entries::sort_by_number;
use crate::support::error::Error;
use crate::support::table::table;

/// Whether vertices at the same place are one vertex of the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Coincident {
    /// Two boundary edges of the mesh with coincident ends that run in opposite directions are one edge, and their ends are joined;
    /// -0 equals 0. Edges that more than two triangles would share stay apart, and so do ends around which the triangles would not
    /// form a single fan, and triangles that lie on each other. So sheets that only touch stay apart, and so do the two sides of a
    /// sheet; a slit with coincident lips is closed.
    ///
    /// All copies of a free vertex get the same new position. A fixed vertex stays where it is, and each of its copies.
    /// A list of vertices names a vertex by any of its copies; a mask frees it where it frees all of them. Normals given for
    /// several copies are averaged; they are refused where they cancel.
    Join {
        /// Vertices are coincident up to this distance, in the unit of the positions. It has to be well below the edge lengths:
        /// what is crowded stays apart. Default 0.
        within: f64,
    },
    /// The mesh is as its triangles say.
    Separate,
}

impl Default for Coincident {
    fn default() -> Self {
        Self::Join { within: 0.0 }
    }
}

table!(Coincident {
    0 "join" Coincident::Join { .. } => "boundary edges with coincident ends are one edge of the surface", "";
    1 "separate" Coincident::Separate => "the mesh is as its triangles say", "";
});

impl Coincident {
    /// How far apart vertices at the same place are, at most; none: each has a place of its own.
    pub(crate) fn within(&self) -> Option<f64> {
        match *self {
            Self::Join { within } => Some(within),
            Self::Separate => None,
        }
    }

    /// Checks the distance.
    ///
    /// ```
    /// use fairmesh::Coincident;
    ///
    /// assert!(Coincident::default().validate().is_ok());
    /// assert!(Coincident::Join { within: -1.0 }.validate().is_err());
    /// ```
    ///
    /// # Errors
    /// [`Error::BadOption`] for a distance that is negative or not finite.
    pub fn validate(&self) -> Result<(), Error> {
        let Self::Join { within } = *self else {
            return Ok(());
        };
        let allowed = within >= 0.0 && within.is_finite();
        Error::check_option(
            "coincident_within",
            within,
            allowed,
            "a finite distance, at least 0",
        )
    }
}

/// Which numbers name the same vertex.
#[derive(Debug, Clone, Default)]
pub(crate) struct Copies {
    /// The smallest number of each vertex; empty: every number names a vertex of its own.
    smallest: Vec<u32>,
    /// (smallest number, other number), ascending.
    pairs: Vec<(u32, u32)>,
}

impl Copies {
    fn new(smallest: Vec<u32>) -> Self {
        let others = (0..).zip(&smallest).filter(|(v, s)| *v != **s);
        let mut pairs: Vec<(u32, u32)> = others.map(|(v, &s)| (s, v)).collect();
        pairs.sort_unstable();
        Self { smallest, pairs }
    }

    /// Whether every number names a vertex of its own.
    pub(crate) fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }

    /// The number by which the joined mesh names `v`.
    #[inline]
    pub(crate) fn smallest(&self, v: u32) -> u32 {
        self.smallest.get(v as usize).copied().unwrap_or(v)
    }

    /// The other numbers of the vertex whose smallest one is `v`.
    pub(crate) fn others(&self, v: u32) -> impl Iterator<Item = u32> + '_ {
        let first = self.pairs.partition_point(|p| p.0 < v);
        let of_v = self.pairs[first..].iter().take_while(move |p| p.0 == v);
        of_v.map(|p| p.1)
    }

    /// (smallest number, other number) of all copies, ascending.
    pub(crate) fn pairs(&self) -> &[(u32, u32)] {
        &self.pairs
    }

    /// A list of what vertices have, by the joined mesh's numbers, repeated for their copies; ascending.
    pub(crate) fn repeat<T: Copy>(&self, list: &mut Vec<(u32, T)>) {
        let of = |entry: &(u32, T)| self.others(entry.0).map(|v| (v, entry.1)).collect::<Vec<_>>();
        let more: Vec<_> = list.iter().flat_map(of).collect();
        list.extend(more);
        sort_by_number(list);
    }

    /// A selection in the joined mesh's numbers. What it names wrongly is left for the checks that follow.
    pub(crate) fn selection<'s>(&self, selection: Selection<'s>) -> SelectedElements<'s> {
        if self.is_empty() {
            return SelectedElements::of(selection);
        }
        match selection {
            Selection::Mask(mask) if mask.len() == self.smallest.len() => {
                let mut joined = mask.to_vec();
                for &(v, copy) in &self.pairs {
                    joined[v as usize] &= mask[copy as usize];
                    joined[copy as usize] = false;
                }
                SelectedElements::Mask(joined.into())
            }
            Selection::Vertices(list) => {
                SelectedElements::Vertices(list.iter().map(|&v| self.smallest(v)).collect())
            }
            other => SelectedElements::of(other),
        }
    }
}

/// A selection that may have its own memory.
#[derive(Debug, Clone)]
pub(crate) enum SelectedElements<'s> {
    Mask(Cow<'s, [bool]>),
    Vertices(Cow<'s, [u32]>),
    Faces(Cow<'s, [u32]>),
}

impl<'s> SelectedElements<'s> {
    fn of(selection: Selection<'s>) -> Self {
        match selection {
            Selection::Mask(mask) => Self::Mask(mask.into()),
            Selection::Vertices(list) => Self::Vertices(list.into()),
            Selection::Faces(list) => Self::Faces(list.into()),
        }
    }

    pub(crate) fn selection(&self) -> Selection<'_> {
        match self {
            Self::Mask(mask) => Selection::Mask(mask),
            Self::Vertices(list) => Selection::Vertices(list),
            Self::Faces(list) => Selection::Faces(list),
        }
    }

    /// The same, in its own memory.
    pub(crate) fn into_owned(self) -> SelectedElements<'static> {
        match self {
            Self::Mask(mask) => SelectedElements::Mask(mask.into_owned().into()),
            Self::Vertices(list) => SelectedElements::Vertices(list.into_owned().into()),
            Self::Faces(list) => SelectedElements::Faces(list.into_owned().into()),
        }
    }
}

/// A mesh whose coincident vertices are joined.
#[derive(Debug, Clone)]
pub(crate) struct Joined<'a> {
    /// In the smallest numbers of the vertices.
    pub(crate) triangles: Cow<'a, [[u32; 3]]>,
    pub(crate) copies: Copies,
}

impl<'a> Joined<'a> {
    /// Joins what is asked. A mesh that names vertices that do not exist is left for the checks that follow.
    ///
    /// # Errors
    /// [`Error::BadOption`] for the distance.
    pub(crate) fn new(
        positions: &[[f64; 3]],
        triangles: &'a [[u32; 3]],
        coincident: Coincident,
    ) -> Result<Self, Error> {
        coincident.validate()?;
        let unjoined = Self {
            triangles: triangles.into(),
            copies: Copies::default(),
        };
        let Coincident::Join { within } = coincident else {
            return Ok(unjoined);
        };
        if input::check(positions.len(), triangles).is_err() {
            return Ok(unjoined);
        }
        Ok(match representatives(positions, triangles, within) {
            None => unjoined,
            Some(smallest) => Self {
                triangles: triangles
                    .iter()
                    .map(|t| t.map(|v| smallest[v as usize]))
                    .collect(),
                copies: Copies::new(smallest),
            },
        })
    }
}
