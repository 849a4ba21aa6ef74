//! From a mesh with creases to one with blends.

use nalgebra::Vector3;

use super::bands::Bands;
use super::chain_curve::ChainCurve;
use super::corners::corners;
use super::crease_graph::{Chain, CreaseGraph};
use super::cut::Cut;
use super::ends::Ends;
use super::face_normals::FaceNormals;
use super::level::{Level, Side};
use super::options::RoundOptions;
use super::rounded::Rounded;
use super::sheet::Sheet;
use super::surface::Surface;
use super::tidy::tidy;
use crate::mesh::Joined;
use crate::mesh::halfedge::next;
use crate::support::error::Error;

/// Rounds the creases of a mesh: in place of each there is a blend, tangent to the faces beside it. Outside of the blends the surface stays
/// where it is; triangles that reach into one are cut.
///
/// ```
/// use fairmesh::{RoundOptions, round};
/// // A tetrahedron.
/// let positions = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
/// let triangles = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
/// let rounded = round(&positions, &triangles, &RoundOptions { width: 0.1, ..RoundOptions::default() })?;
/// assert!(rounded.report.outcome.is_success());
/// assert_eq!(rounded.chains.len(), 6);
/// assert!(rounded.kept_vertices.is_empty()); // nothing of its corners is left
/// # Ok::<(), fairmesh::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadOption`]; [`Error::NonManifoldEdge`] and the like for a flaw anywhere; [`Error::EmptyRegion`] where there is nothing to be rounded, and
/// those of [`fair`](crate::fair) for the bands.
pub fn round(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    options: &RoundOptions,
) -> Result<Rounded, Error> {
    options.validate()?;
    let joined = Joined::new(positions, triangles, options.fairing.coincident)?;
    let surface = Surface::new(positions, &joined.triangles)?;
    let graph = CreaseGraph::new(&surface, options);
    let level = level(&surface, &graph, options);
    let sheet = Sheet::new(
        surface.x.clone(),
        joined.triangles.to_vec(),
        surface.links.opposite.clone(),
    );
    let mut cut = Cut::new(sheet, &level, &graph.faces);
    seed(&mut cut, &surface, &graph);
    cut.spread();
    cut.cut();
    tidy(&mut cut, positions.len());
    let normals = FaceNormals {
        surface: &surface,
        graph: &graph,
    };
    Bands::new(&cut, &normals).fair(positions, &surface.centre, &options.fairing)
}

/// The sides of all chains, with their widths.
fn level(surface: &Surface<'_>, graph: &CreaseGraph, options: &RoundOptions) -> Level {
    let width = if options.radius > 0.0 {
        options.radius
    } else {
        options.width
    };
    let mut of = Level {
        curves: Vec::new(),
        sides: Vec::new(),
        corners: corners(surface, graph, width),
    };
    let ends = Ends::new(surface, graph);
    for (number, chain) in (0..).zip(&graph.chains) {
        let bends: Vec<f64> = chain.half_edges.iter().map(|&h| graph.bend(surface, h)).collect();
        let curve = ChainCurve::new(&vertices(chain, surface), &bends, chain.is_closed, width);
        let asked = widths(&curve, options);
        let fades = ends.fade(chain, surface);
        let at =
            |i: usize| asked[i] * (curve.along(i, fades) / (FADE * asked[i]).max(f64::MIN_POSITIVE)).min(1.0);
        let widths: Vec<f64> = (0..asked.len()).map(at).collect();
        let widest = asked.iter().copied().fold(0.0, f64::max);
        of.sides
            .extend(faces_beside(chain, surface, graph).map(|face| Side {
                face,
                curve: number,
                widest,
                widths: widths.clone(),
            }));
        of.curves.push(curve);
    }
    of
}

/// Over so many widths a band fades out where its crease ends.
const FADE: f64 = 2.0;

/// The widths asked at the points of a curve.
fn widths(curve: &ChainCurve, options: &RoundOptions) -> Vec<f64> {
    let at = |&bend: &f64| match options.radius > 0.0 {
        true => options.radius * libm::tan(0.5 * bend),
        false => options.width,
    };
    curve.bends.iter().map(at).collect()
}

/// The places of a chain's vertices; of a closed one the first is not repeated.
fn vertices(chain: &Chain, surface: &Surface<'_>) -> Vec<Vector3<f64>> {
    let first = chain.half_edges.iter().map(|&h| surface.origin(h));
    let last = chain.half_edges.iter().map(|&h| surface.target(h)).next_back();
    let all = first.chain(last.filter(|_| !chain.is_closed));
    all.map(|v| surface.x[v as usize]).collect()
}

/// The faces on the left and on the right of a chain.
fn faces_beside(chain: &Chain, surface: &Surface<'_>, graph: &CreaseGraph) -> [u32; 2] {
    let h = chain.half_edges[0];
    [h, surface.across(h).unwrap_or(h)].map(|g| graph.faces[g as usize / 3])
}

/// Tells the vertices of all chains where on them they are.
fn seed(cut: &mut Cut<'_>, surface: &Surface<'_>, graph: &CreaseGraph) {
    let all = (0..).zip(&graph.chains);
    for (number, chain) in all.filter(|(_, chain)| chain.is_chosen) {
        let spacing = cut.level.curves[number as usize].spacing;
        let mut along = 0.0;
        for &h in &chain.half_edges {
            let at = along / spacing;
            along += surface.edge(h).norm();
            let then = along / spacing;
            cut.seed(h, 2 * number, at);
            cut.seed(next(h), 2 * number, then);
            if let Some(o) = surface.across(h) {
                cut.seed(o, 2 * number + 1, then);
                cut.seed(next(o), 2 * number + 1, at);
            }
        }
    }
}
