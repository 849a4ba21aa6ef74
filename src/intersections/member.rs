//! A triangle whose intersections are looked for, and its box.

use rstar::{AABB, Envelope, RTreeObject};

use super::triangles::Corners;

/// An upright box in space.
pub(crate) type Bounds = AABB<[f64; 3]>;

/// A triangle with its number, and whether its intersections are asked for.
#[derive(Clone)]
pub(crate) struct Member {
    /// Finite.
    pub(crate) corners: Corners,
    pub(crate) number: u32,
    pub(crate) is_asked: bool,
    /// Which sides it shows: see [`facing`]. Known in [`pairs`](super::search::pairs).
    pub(super) facing: u8,
}

impl Member {
    pub(crate) fn bounds(&self) -> Bounds {
        AABB::from_points(&self.corners)
    }
}

impl RTreeObject for Member {
    type Envelope = Bounds;

    fn envelope(&self) -> Bounds {
        self.bounds()
    }
}

/// A triangle of a mesh, if its vertices exist and are finite.
pub(crate) fn member(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    number: u32,
    is_asked: bool,
) -> Option<Member> {
    let mut corners = [[0.0; 3]; 3];
    for (corner, &v) in corners.iter_mut().zip(&triangles[number as usize]) {
        *corner = *positions.get(v as usize)?;
    }
    let is_finite = corners.iter().flatten().all(|x| x.is_finite());
    is_finite.then_some(Member {
        corners,
        number,
        is_asked,
        facing: 0,
    })
}

/// The box around some triangles.
pub(crate) fn bounds_of(members: &[Member]) -> Bounds {
    let mut all = Bounds::new_empty();
    members.iter().for_each(|member| all.merge(&member.bounds()));
    all
}
