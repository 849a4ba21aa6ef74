//! How rough rims are, before anything is done about it.

use fairmesh_linear::parallel;
use nalgebra::Vector3;

use super::band::Band;
use super::options::Rim;
use super::report::EVEN;
use super::width::{CLEAN, REACH, SAMPLES, width};
use crate::fairing::{Options, Workers};
use crate::holes::links::Links;
use crate::holes::loop_set::normal;
use crate::holes::loops::BoundaryLoop;
use crate::holes::surroundings::{LAYERS_OF_CREASES, Surroundings};
use crate::mesh::coincident::Coincident;
use crate::mesh::{Joined, NONE};
use crate::support::error::Error;

/// No surface is so flat that less than this (radians) is expected: triangles of a clean mesh have some angle.
/// Half or double, of 2 cases: none changes.
const LEAST: f64 = 0.02;
/// A rim is rough if its angles are wider than expected by this factor, and it is not clean.
/// Half or double, of 2 cases: none changes.
const ROUGH: f64 = 2.0;
/// The rings that are advised to be relaxed.
/// Half or double, of 1 case: 1 changes.
const RINGS: usize = 3;

/// How rough the rim of a loop is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Roughness {
    /// The angle between the normals of the mesh's triangles at consecutive edges of the loop, in degrees, root mean square.
    pub angle: f64,
    /// The angle that is expected there, by the surface fitted to what is around.
    pub expected: f64,
    /// The distance of the mesh around from that surface, root mean square.
    pub noise: f64,
    /// What is advised for [`FillOptions::rim`](crate::FillOptions::rim), if the rim is rough, and not where a sharp edge is.
    pub advice: Option<Rim>,
}

impl Roughness {
    /// The angle over the one expected; not less than a degree or so is expected anywhere. About 1 where the mesh is clean.
    pub fn ratio(&self) -> f64 {
        self.angle / self.expected.max(LEAST.to_degrees())
    }
}

/// Per loop of [`boundary_loops_joined`](crate::boundary_loops_joined) how rough it is; nothing where the mesh around is too small to tell.
///
/// ```
/// use fairmesh::{Coincident, rim_roughness};
/// // A sheet of 12 by 12 squares with a bumpy hole in the middle.
/// let height = |i: u32, j: u32| 0.1 * f64::from((7 * i * i + 5 * j * j * j + i * j) % 5);
/// let at = |i: u32, j: u32| [f64::from(i), f64::from(j), height(i, j)];
/// let positions: Vec<[f64; 3]> = (0..13 * 13).map(|v| at(v / 13, v % 13)).collect();
/// let squares = (0..12 * 12).map(|s| (s / 12, s % 12));
/// let triangles: Vec<[u32; 3]> = squares
///     .filter(|&(i, j)| !(5..7).contains(&i) || !(5..7).contains(&j))
///     .map(|(i, j)| 13 * i + j)
///     .flat_map(|a| [[a, a + 13, a + 14], [a, a + 14, a + 1]])
///     .collect();
/// let rough = rim_roughness(&positions, &triangles, Coincident::default())?;
/// assert!(rough.iter().flatten().all(|of| of.ratio() > 2.0 && of.advice.is_some()));
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// Those of [`boundary_loops_joined`](crate::boundary_loops_joined).
pub fn rim_roughness(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    coincident: Coincident,
) -> Result<Vec<Option<Roughness>>, Error> {
    let joined = Joined::new(positions, triangles, coincident)?;
    let links = Links::new(positions.len(), &joined.triangles)?;
    let room = || vec![NONE; positions.len().max(triangles.len())];
    let loops = links.loops(positions, coincident);
    // Not on the global pool, whose threads would outlive a library that is unloaded.
    Ok(Workers::new(0)?.install(|| {
        let of_loop = |place: &mut Vec<u32>, of: &BoundaryLoop| roughness(&links, positions, of, place);
        parallel::map_with(room, loops.iter(), of_loop)
    }))
}

/// How rough the rim of a loop is. `place` is as long as the mesh has vertices or triangles, all [`NONE`]; it is left so.
pub(super) fn roughness(
    links: &Links<'_>,
    positions: &[[f64; 3]],
    of: &BoundaryLoop,
    place: &mut [u32],
) -> Option<Roughness> {
    let band = Band::new(links, positions, &[of], 1 + REACH, 0, place);
    let edge = band.mean_edge(band.count(2));
    let count = of.vertices.len();
    // A vertex that is not finite is not in the band.
    if band.count(1) != count {
        return None;
    }
    let width = width(&band, edge)?;
    let samples: Vec<usize> = (0..count).step_by(count.div_ceil(SAMPLES)).collect();
    let after: Vec<usize> = samples.iter().map(|v| (v + 1) % count).collect();
    let [here, there] = [&samples, &after].map(|list| band.fits(list, width.radius));
    let triangle = |h: u32| links.triangles[h as usize / 3].map(|v| Vector3::from(positions[v as usize]));
    let (mut squares, mut expected, mut pairs) = (0.0, 0.0, 0.0);
    for ((&v, a), b) in samples.iter().zip(&here).zip(&there) {
        let (Some(a), Some(b)) = (a, b) else { continue };
        let [m, n] = [v, (v + 1) % count].map(|i| normal(&triangle(of.half_edges[i])));
        squares += between(&m, &n).powi(2);
        expected += between(&a.sheet.normal, &b.sheet.normal).powi(2);
        pairs += 1.0;
    }
    let [angle, expected] = [squares, expected].map(|sum| (sum / pairs).sqrt().to_degrees());
    let mut found = Roughness {
        angle,
        expected,
        noise: width.noise,
        advice: None,
    };
    let is_noise = width.noise > CLEAN * edge && width.evenness > EVEN;
    if found.ratio() > ROUGH && is_noise && !is_creased(links, positions, of, place) {
        found.advice = Some(Rim {
            relax: RINGS,
            within: Some(edge),
        });
    }
    angle.is_finite().then_some(found)
}

/// Whether creases arrive at a loop: what bends there is no noise.
fn is_creased(links: &Links<'_>, positions: &[[f64; 3]], of: &BoundaryLoop, place: &mut [u32]) -> bool {
    let around = Surroundings::with_layers(links, positions, &[of], (LAYERS_OF_CREASES, place));
    !around.creases(&Options::default()).is_empty()
}

fn between(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    libm::atan2(a.cross(b).norm(), a.dot(b))
}
