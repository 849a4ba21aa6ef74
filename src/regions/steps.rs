//! A region made step by step: shapes and spreads, added, taken away, cut with each other.

use nalgebra::Vector3;

use super::bump::{self, Bump};
use super::neighbours::Neighbours;
use super::seed::{Foot, Seed};
use super::{geodesic, spread};
use crate::fairing::{ProgressCallback, Workers, on_workers_unless_stopped};
use crate::holes::Place;
use crate::mesh::coincident::Coincident;
use crate::mesh::{Joined, input};
use crate::support::error::Error;

/// The fraction of the progress at which the mesh is read: its share of the time, measured on a sheet of 80,000 triangles.
/// Half or double, of 5 cases: only the progress changes.
const READ: f64 = 0.02;

/// Triangles of a mesh.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Region {
    /// These triangles, by their numbers.
    Triangles(Vec<u32>),
    /// Those all of whose corners are among these vertices (or copies of them).
    Vertices(Vec<u32>),
    /// Those that lie in a ball or box with all corners.
    Within(Place),
    /// Those all of whose corners lie on the side of a plane that its normal points to, or on the plane.
    HalfSpace {
        /// A point of the plane.
        point: [f64; 3],
        /// Its normal, of any length but zero.
        normal: [f64; 3],
    },
    /// Those all of whose corners are no further than `radius` from the seed, along the surface.
    Geodesic {
        /// The middle.
        seed: Seed,
        /// The largest distance.
        radius: f64,
    },
    /// Those that hang together with the seed by edges.
    Component(Seed),
    /// Those around the seed, up to edges at which the surface bends by more than an angle.
    Patch {
        /// A place in it.
        seed: Seed,
        /// The angle between normals, in degrees, from 0 to 180.
        angle: f64,
    },
    /// A bump or dent: the least region whose fair surface stays what it is when the region grows, see [`Bump`].
    Bump {
        /// A place on it.
        seed: Seed,
        /// About how far it reaches, within a factor of 1.5; none: the smallest one there.
        size: Option<f64>,
    },
    /// The whole mesh.
    All,
}

/// What a step does with the region so far.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum RegionStep {
    /// Combines it with another one.
    With(Combine, Region),
    /// Adds the triangles that have a vertex in common with it, so often.
    Grow(usize),
    /// Takes the triangles away that have a vertex in common with the rest, so often.
    Shrink(usize),
    /// Takes the rest instead.
    Invert,
}

/// How two regions become one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Combine {
    /// What is in any of them.
    #[default]
    Add,
    /// What is in the first and not in the second.
    Remove,
    /// What is in both.
    Intersect,
}

/// What [`select_region`] returns.
#[derive(Debug, Clone, PartialEq)]
pub struct SelectedRegion {
    /// The triangles, ascending.
    pub triangles: Vec<u32>,
    /// Per step how many triangles it named by itself; of [`RegionStep::Grow`], [`RegionStep::Shrink`] and [`RegionStep::Invert`] how many there were after it.
    pub counts: Vec<usize>,
    /// What was taken for each [`Region::Bump`], in their order.
    pub bumps: Vec<Bump>,
    /// How far each [`Seed::Point`] is from the surface, in their order.
    pub misses: Vec<f64>,
}

/// Chooses triangles of a mesh step by step, beginning with none. `positions` is #V by 3, `triangles` #T by 3; the mesh need not be a
/// manifold. Triangles hang together across `coincident` vertices.
///
/// ```
/// use fairmesh::{Coincident, Combine, Place, Region, RegionStep, select_region};
/// // A sheet of 4 by 4 squares, each divided into two triangles.
/// let positions: Vec<[f64; 3]> = (0..25).map(|k| [(k / 5) as f64, (k % 5) as f64, 0.0]).collect();
/// let triangles: Vec<[u32; 3]> = (0..16)
///     .map(|k| 5 * (k / 4) + k % 4)
///     .flat_map(|a| [[a, a + 5, a + 6], [a, a + 6, a + 1]])
///     .collect();
/// let left = Region::Within(Place::Box { low: [0.0; 3], high: [2.0, 4.0, 0.0] });
/// let chosen = select_region(&positions, &triangles, &[RegionStep::With(Combine::Add, left), RegionStep::Shrink(1)], Coincident::default())?;
/// assert_eq!(chosen.counts, [16, 8]);
/// assert_eq!(chosen.triangles, [0, 1, 2, 3, 4, 5, 6, 7]);
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// [`Error::TooLarge`], [`Error::IndexOutOfRange`], [`Error::NotFinite`], [`Error::SelectionOutOfRange`] for what does not exist,
/// [`Error::BadOption`] for numbers out of range, [`Error::FreeVertexWithoutTriangle`] for a seed, [`Error::NoBump`].
pub fn select_region(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    steps: &[RegionStep],
    coincident: Coincident,
) -> Result<SelectedRegion, Error> {
    // Not on the global pool, whose threads would outlive a library that is unloaded.
    Workers::new(0)?.install(|| select(positions, triangles, steps, coincident, &mut |_| ()))
}

/// [`select_region`], which calls `progress` on the calling thread, as [`fair_with_progress`](crate::fair_with_progress) does. `Break`
/// stops the run: then there is no result.
///
/// # Errors
/// Those of [`select_region`].
pub fn select_region_with_progress(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    steps: &[RegionStep],
    coincident: Coincident,
    progress: &mut ProgressCallback<'_>,
) -> Result<Option<SelectedRegion>, Error> {
    on_workers_unless_stopped(0, progress, "region", |tell| {
        select(positions, triangles, steps, coincident, tell)
    })
}

fn select(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    steps: &[RegionStep],
    coincident: Coincident,
    tell: &mut dyn FnMut(f64),
) -> Result<SelectedRegion, Error> {
    input::check(positions.len(), triangles)?;
    input::check_finite(positions, triangles)?;
    let joined = Joined::new(positions, triangles, coincident)?;
    let mesh = Neighbours::new(positions, &joined.triangles);
    let mut region = vec![false; triangles.len()];
    let mut counts = Vec::new();
    let mut found = Seeds::default();
    let count = |region: &[bool]| region.iter().filter(|&&is_in| is_in).count();
    for (k, step) in steps.iter().enumerate() {
        let mut part = |fraction: f64| tell(READ + (1.0 - READ) * (k as f64 + fraction) / steps.len() as f64);
        part(0.0);
        match step {
            RegionStep::With(how, named) => {
                let named = find((&mesh, &joined), named, &mut found, &mut part)?;
                counts.push(count(&named));
                combine(&mut region, *how, &named);
                continue;
            }
            RegionStep::Grow(rings) => region = spread::grow(&mesh, region, *rings),
            RegionStep::Shrink(rings) => region = spread::shrink(&mesh, region, *rings),
            RegionStep::Invert => region = spread::not(region),
        }
        counts.push(count(&region));
    }
    let all = 0..triangles.len() as u32;
    Ok(SelectedRegion {
        triangles: all.filter(|&t| region[t as usize]).collect(),
        counts,
        bumps: found.bumps,
        misses: found.misses,
    })
}

/// What was found at seeds.
#[derive(Default)]
struct Seeds {
    bumps: Vec<Bump>,
    misses: Vec<f64>,
}

impl Seeds {
    /// Where a region begins.
    fn foot(&mut self, seed: &Seed, mesh: &Neighbours<'_>) -> Result<Foot, Error> {
        let foot = seed.foot(mesh)?;
        if let Seed::Point(point) = seed {
            self.misses.push((foot.place - Vector3::from(*point)).norm());
        }
        Ok(foot)
    }
}

fn combine(region: &mut [bool], how: Combine, named: &[bool]) {
    for (is_in, named) in region.iter_mut().zip(named) {
        *is_in = match how {
            Combine::Add => *is_in || *named,
            Combine::Remove => *is_in && !named,
            Combine::Intersect => *is_in && *named,
        };
    }
}

/// Whether each triangle is in a region.
fn find(
    (mesh, joined): (&Neighbours<'_>, &Joined<'_>),
    region: &Region,
    seeds: &mut Seeds,
    tell: &mut dyn FnMut(f64),
) -> Result<Vec<bool>, Error> {
    Ok(match region {
        Region::Triangles(list) => listed(list.iter().copied(), mesh.triangles.len())?,
        Region::Vertices(list) => {
            let copies = &joined.copies;
            listed(list.iter().copied(), mesh.positions.len())?;
            let joined = list.iter().map(|&v| copies.smallest(v));
            let is_in = listed(joined, mesh.positions.len())?;
            spread::whole(mesh, |v| is_in[v as usize])
        }
        Region::Within(place) => {
            place.validate()?;
            spread::whole(mesh, |v| place.holds(&mesh.positions[v as usize]))
        }
        Region::HalfSpace { point, normal } => {
            let length = normal.iter().map(|x| x * x).sum::<f64>();
            Error::check_option(
                "normal",
                length.sqrt(),
                length > 0.0 && length.is_finite(),
                "a vector that is not zero",
            )?;
            for &x in point {
                Error::check_option("point", x, x.is_finite(), "finite")?;
            }
            let height = |x: &[f64; 3]| (0..3).map(|k| (x[k] - point[k]) * normal[k]).sum::<f64>();
            spread::whole(mesh, |v| height(&mesh.positions[v as usize]) >= 0.0)
        }
        Region::Geodesic { seed, radius } => {
            Error::check_option("radius", *radius, *radius >= 0.0, "at least 0")?;
            let distance = geodesic::distances(mesh, &seeds.foot(seed, mesh)?);
            spread::whole(mesh, |v| distance[v as usize] <= *radius)
        }
        Region::Component(seed) => spread::connected(mesh, seeds.foot(seed, mesh)?.triangle, |_, _| true),
        Region::Patch { seed, angle } => {
            Error::check_option(
                "angle",
                *angle,
                (0.0..=180.0).contains(angle),
                "from 0 to 180 degrees",
            )?;
            spread::patch(mesh, seeds.foot(seed, mesh)?.triangle, *angle)
        }
        Region::Bump { seed, size } => {
            if let Some(size) = *size {
                Error::check_option("size", size, size > 0.0 && size.is_finite(), "above 0")?;
            }
            let foot = seeds.foot(seed, mesh)?;
            let (found, region) = bump::find(mesh, &foot, *size, tell)?;
            seeds.bumps.push(found);
            region
        }
        Region::All => vec![true; mesh.triangles.len()],
    })
}

/// Whether each of `count` elements is in a list.
fn listed(list: impl Iterator<Item = u32>, count: usize) -> Result<Vec<bool>, Error> {
    let mut is_in = vec![false; count];
    for element in list {
        let index = element as usize;
        *is_in
            .get_mut(index)
            .ok_or(Error::SelectionOutOfRange { index, count })? = true;
    }
    Ok(is_in)
}
