//! What is checked on any mesh before it is looked at.

use crate::support::error::Error;

/// Vertices and half-edges are numbered in 32 bits, and the two largest numbers are taken.
const LARGEST: usize = u32::MAX as usize - 1;

/// That all numbers fit, and that every triangle names vertices that exist.
///
/// # Errors
/// [`Error::TooLarge`], [`Error::IndexOutOfRange`].
pub(crate) fn check(vertices: usize, triangles: &[[u32; 3]]) -> Result<(), Error> {
    check_size(vertices, triangles.len())?;
    check_indices(vertices, triangles)
}

/// That the vertices of all triangles are finite; the triangles name vertices that exist.
///
/// # Errors
/// [`Error::NotFinite`].
pub(crate) fn check_finite(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<(), Error> {
    let is_finite = |&&v: &&u32| positions[v as usize].iter().all(|x| x.is_finite());
    match triangles.iter().flatten().find(|v| !is_finite(v)) {
        Some(&v) => Err(Error::NotFinite { vertex: v as usize }),
        None => Ok(()),
    }
}

/// # Errors
/// [`Error::TooLarge`].
pub(super) fn check_size(vertices: usize, triangles: usize) -> Result<(), Error> {
    for (what, count, largest) in [
        ("vertices", vertices, LARGEST),
        ("triangles", triangles, LARGEST / 3),
    ] {
        if count > largest {
            return Err(Error::TooLarge { what, count });
        }
    }
    Ok(())
}

/// # Errors
/// [`Error::IndexOutOfRange`].
pub(super) fn check_indices(vertex_count: usize, triangles: &[[u32; 3]]) -> Result<(), Error> {
    let is_outside = |&v: &u32| v as usize >= vertex_count;
    let of = |tri: &[u32; 3]| tri.iter().copied().find(is_outside);
    match (0..).zip(triangles).find_map(|(t, tri)| Some((t, of(tri)?))) {
        Some((triangle, index)) => Err(Error::IndexOutOfRange {
            triangle,
            index,
            vertex_count,
        }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_that_fit_into_32_bits() {
        assert_eq!(check_size(LARGEST, LARGEST / 3), Ok(()));
        let vertices = Error::TooLarge {
            what: "vertices",
            count: LARGEST + 1,
        };
        assert_eq!(check_size(LARGEST + 1, 0), Err(vertices));
        let triangles = Error::TooLarge {
            what: "triangles",
            count: LARGEST / 3 + 1,
        };
        assert_eq!(check_size(0, LARGEST / 3 + 1), Err(triangles));
    }
}
