//! What is checked of a region before its triangles are linked.

use crate::support::error::{Error, LARGEST_COORDINATE, MOST_VALENCE};

pub(super) fn repeated([a, b, c]: [u32; 3]) -> Option<u32> {
    if a == b || a == c {
        Some(a)
    } else if b == c {
        Some(b)
    } else {
        None
    }
}

/// That the corners of these triangles differ.
///
/// # Errors
/// [`Error::RepeatedIndex`].
pub(super) fn check_corners(triangles: &[[u32; 3]], ids: &[u32]) -> Result<(), Error> {
    let broken = ids
        .iter()
        .filter_map(|&t| repeated(triangles[t as usize]).map(|v| (t, v)));
    match broken.min() {
        Some((t, v)) => Err(Error::RepeatedIndex {
            triangle: t as usize,
            vertex: v as usize,
        }),
        None => Ok(()),
    }
}

pub(super) fn finite(position: &[f64; 3]) -> bool {
    position.iter().all(|x| x.is_finite())
}

/// That these vertices have coordinates that can be squared.
///
/// # Errors
/// [`Error::NotFinite`], [`Error::CoordinateTooLarge`].
pub(super) fn check_finite(positions: &[[f64; 3]], ids: &[u32]) -> Result<(), Error> {
    match ids.iter().filter(|&&v| !finite(&positions[v as usize])).min() {
        Some(&v) => Err(Error::NotFinite { vertex: v as usize }),
        None => check_range(positions, ids),
    }
}

fn check_range(positions: &[[f64; 3]], ids: &[u32]) -> Result<(), Error> {
    let largest = |v: u32| {
        let [x, y, z] = positions[v as usize];
        [y, z]
            .into_iter()
            .fold(x, |a, b| if b.abs() > a.abs() { b } else { a })
    };
    match ids
        .iter()
        .filter(|&&v| largest(v).abs() > LARGEST_COORDINATE)
        .min()
    {
        Some(&v) => Err(Error::CoordinateTooLarge {
            vertex: v as usize,
            coordinate: largest(v),
        }),
        None => Ok(()),
    }
}

/// That no vertex has too many of these triangles; they have local numbers, whose vertices are `ids`.
///
/// # Errors
/// [`Error::ValenceTooLarge`].
pub(super) fn check_valence(triangles: &[[u32; 3]], ids: &[u32]) -> Result<(), Error> {
    let mut valence = vec![0; ids.len()];
    for &v in triangles.iter().flatten() {
        valence[v as usize] += 1;
    }
    let crowded = ids
        .iter()
        .zip(valence)
        .filter(|(_, valence)| *valence > MOST_VALENCE);
    match crowded.min() {
        Some((&v, valence)) => Err(Error::ValenceTooLarge {
            vertex: v as usize,
            valence,
        }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repeated_corners() {
        assert_eq!(repeated([1, 2, 3]), None);
        assert_eq!(
            [[4, 4, 1], [4, 1, 4], [1, 4, 4], [4; 3]].map(repeated),
            [Some(4); 4]
        );
    }
}
