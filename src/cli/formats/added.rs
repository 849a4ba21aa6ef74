//! Vertices and triangles behind a file's own.

use fairmesh::Parents;

use super::carry::Carry;

/// What marks new faces: a property of PLY, a group of OBJ.
#[derive(Debug, Clone, Copy)]
pub struct Mark<'a> {
    /// Its name.
    pub name: &'a str,
    /// The first of the faces that are added which has the mark.
    pub first: usize,
}

/// A mesh with vertices and triangles added behind a file's own.
pub struct Added<'a> {
    /// All positions, the file's first.
    pub positions: &'a [[f64; 3]],
    /// All triangles, the file's first.
    pub triangles: &'a [[u32; 3]],
    /// Where each new vertex comes from.
    pub parents: &'a [Parents],
    /// What attributes are carried over from instead, if that is asked for.
    pub carry: Option<&'a Carry<'a>>,
    /// How new faces are marked.
    pub mark: Option<Mark<'a>>,
}

impl Added<'_> {
    /// How many vertices are the file's.
    pub fn old_vertices(&self) -> usize {
        self.positions.len() - self.parents.len()
    }
}

/// The weighted mean over a vertex's parents; None if a parent has no value.
pub fn average<const N: usize>(
    parents: &Parents,
    value: impl Fn(usize) -> Option<[f64; N]>,
) -> Option<[f64; N]> {
    let mut mean = [0.0; N];
    for (v, w) in parents
        .vertices
        .into_iter()
        .zip(parents.weights)
        .filter(|(_, w)| *w > 0.0)
    {
        let value = value(v as usize)?;
        (0..N).for_each(|k| mean[k] += w * value[k]);
    }
    Some(mean)
}
