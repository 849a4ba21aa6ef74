//! From a mesh with creases to one with blends.

use fairmesh_linear::interrupt::unless_stopped;
use nalgebra::Vector3;

use super::arcs::arcs;
use super::bands::Bands;
use super::chain_curve::{ChainCurve, PER_WIDTH};
use super::corners::corners;
use super::crease_graph::{Chain, CreaseGraph};
use super::cut::Cut;
use super::endings::Endings;
use super::face_normals::FaceNormals;
use super::legs::divide;
use super::level::{Level, Side};
use super::mitres::trace;
use super::options::RoundOptions;
use super::rims::rims;
use super::rounded::{CreaseChain, Rounded};
use super::sheet::Sheet;
use super::surface::Surface;
use super::telling::Telling;
use super::through::Through;
use super::tidy::tidy;
use super::unsolved::{give_up, give_up_faded, give_up_unlaid, worst_places};
use super::widths::Widths;
use crate::fairing::{Options, ProgressCallback, on_workers};
use crate::mesh::Joined;
use crate::mesh::coincident::Copies;
use crate::mesh::edge_set::EdgeSet;
use crate::mesh::halfedge::next;
use crate::support::error::Error;

/// Rounds the creases of a mesh: in place of each there is a blend, tangent to the faces beside it. Outside of the blends the surface stays
/// where it is; triangles that reach into one are cut. Where one crease of a corner of three is rounded, and the other two are ridges or grooves both, its
/// blend runs through to the face across, which then ends in an arc; at the boundary of the mesh it runs out with its profile, and the boundary's corner
/// becomes an arc. Where two creases of such three are rounded, the third one goes on between their blends to where their rails cross. Elsewhere a blend
/// fades out where its crease ends or no other one is rounded.
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
/// [`Error::BadOption`]; [`Error::NotAnEdge`] for one that is named; [`Error::NonManifoldEdge`] and the like for a flaw anywhere; [`Error::NoCrease`] where there is nothing to be rounded, and
/// those of [`fair`](crate::fair) for the bands.
pub fn round(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    options: &RoundOptions,
) -> Result<Rounded, Error> {
    options.validate()?;
    on_workers(options.fairing.threads, None, |progress| {
        rounded(positions, triangles, options, progress)
    })
}

/// [`round`], which calls `progress` on the calling thread, as [`fair_with_progress`](crate::fair_with_progress) does. `Break` stops the run: then there
/// is no result.
///
/// # Errors
/// Those of [`round`].
pub fn round_with_progress(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    options: &RoundOptions,
    progress: &mut ProgressCallback<'_>,
) -> Result<Option<Rounded>, Error> {
    options.validate()?;
    on_workers(options.fairing.threads, Some(progress), |progress| {
        unless_stopped(|| rounded(positions, triangles, options, progress)).transpose()
    })
}

/// About how many vertices the blends that [`round`] would make have; what is tried on the way may have a few times as many.
///
/// # Errors
/// Those of [`round`], but for what the fairing finds.
pub fn blend_vertices(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    options: &RoundOptions,
) -> Result<usize, Error> {
    options.validate()?;
    check_labels(triangles, options)?;
    let joined = Joined::new(positions, triangles, options.fairing.coincident)?;
    let surface = Surface::new(positions, &joined.triangles)?;
    let options = &named_edges(&joined.copies, &surface, options)?;
    let graph = CreaseGraph::new(&surface, options);
    check_size(&surface, &graph, options)?;
    let level = level(&surface, &graph, &Endings::new(&surface, &graph), options);
    let expected = level.vertices(&graph.chains);
    check_count(expected, options)?;
    Ok(expected as usize)
}

/// The creases of a mesh, as [`round`] finds them, with those that it would round; and the angle in degrees that edges of creases bend by more than.
///
/// # Errors
/// Those of [`round`] for the mesh and the edges that are named.
pub fn find_creases(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    options: &RoundOptions,
) -> Result<(Vec<CreaseChain>, f64), Error> {
    let joined = Joined::new(positions, triangles, options.fairing.coincident)?;
    let surface = Surface::new(positions, &joined.triangles)?;
    let graph = CreaseGraph::new(&surface, &named_edges(&joined.copies, &surface, options)?);
    let chains = graph.chains.iter();
    Ok((
        chains.map(|chain| CreaseChain::new(chain, &surface)).collect(),
        graph.least,
    ))
}

fn rounded(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    options: &RoundOptions,
    progress: &mut ProgressCallback<'_>,
) -> Result<Rounded, Error> {
    check_labels(triangles, options)?;
    let mut telling = Telling::new(progress);
    let joined = Joined::new(positions, triangles, options.fairing.coincident)?;
    let surface = Surface::new(positions, &joined.triangles)?;
    let options = &named_edges(&joined.copies, &surface, options)?;
    let mut graph = CreaseGraph::new(&surface, options);
    check_size(&surface, &graph, options)?;
    let mut given_up = 0;
    loop {
        let endings = Endings::new(&surface, &graph);
        let level = level(&surface, &graph, &endings, options);
        if give_up_faded(&mut graph, &level) {
            check_size(&surface, &graph, options)?;
            continue;
        }
        check_count(level.vertices(&graph.chains), options)?;
        let cut = cut_out(
            (&surface, &joined.triangles),
            (&graph, &options.labels),
            &endings,
            &level,
        );
        let normals = FaceNormals {
            surface: &surface,
            graph: &graph,
        };
        let rims = match rims(&cut, &endings.through, &normals) {
            Ok(rims) => rims,
            Err(unlaid) => {
                unlaid.into_iter().for_each(|of| give_up_unlaid(&mut graph, of));
                check_size(&surface, &graph, options)?;
                continue;
            }
        };
        let fairing = tangent_unless_asked(&options.fairing);
        let bands = Bands::new(
            &cut,
            &normals,
            (arcs(&cut, &endings.creases(), &normals), &rims),
            fairing.asks_continuity(),
        )?;
        let rounded = match bands.fair(positions, &surface.centre, &fairing, &mut telling)? {
            Ok(rounded) => rounded,
            Err(place) => {
                give_up(&mut graph, &surface, &level, &[place]);
                check_size(&surface, &graph, options)?;
                continue;
            }
        };
        let worst = worst_places(&rounded, &surface.centre);
        if given_up == GIVEN_UP || !give_up(&mut graph, &surface, &level, &worst) {
            return Ok(rounded);
        }
        given_up += 1;
    }
}

/// Between planes, whose curvature is certain, a blend is expected to be a cylinder.
fn tangent_unless_asked(fairing: &Options) -> Options {
    // Auto is below all that can be asked.
    let of_loops = fairing.loop_continuity.iter();
    Options {
        continuity: fairing.continuity.max(0.0),
        loop_continuity: of_loops.map(|(v, blend)| (*v, blend.max(0.0))).collect(),
        ..fairing.clone()
    }
}

/// Times that what is not sound stays sharp, and the rest is done again.
/// Of 12 solids cut from each other, one has to give up at all. Half: one more crease of it is rounded; double: four fewer, after twice the time.
const GIVEN_UP: usize = 4;

/// Bands along the creases chosen, cut out.
fn cut_out<'l>(
    (surface, triangles): (&Surface<'_>, &[[u32; 3]]),
    (graph, labels): (&'l CreaseGraph, &'l [u32]),
    endings: &Endings,
    level: &'l Level,
) -> Cut<'l> {
    let sheet = Sheet::new(
        surface.x.clone(),
        triangles.to_vec(),
        surface.links.opposite.clone(),
    );
    let mut cut = Cut::new(sheet, level, (&graph.faces, labels));
    seed(&mut cut, surface, graph);
    seed_across(&mut cut, surface, graph, &endings.through);
    cut.spread();
    trace(&mut cut, &endings.mitres);
    divide(&mut cut, &endings.lines());
    cut.cut();
    tidy(&mut cut);
    cut
}

/// Widths below this part of the mesh's extent are lost in the rounding of its coordinates. A cube beside a triangle that is far away is rounded alike
/// down to 2e-13, splits edges without end at 2e-15, and bands may be narrowed to a tenth; half or double changes nothing.
const FINEST: f64 = 1e-11;

/// # Errors
/// [`Error::NoCrease`] if none is rounded, [`Error::BadOption`] for a width that would take too many vertices or that coordinates do not tell.
fn check_size(surface: &Surface<'_>, graph: &CreaseGraph, options: &RoundOptions) -> Result<(), Error> {
    let chosen = || graph.chains.iter().filter(|chain| chain.is_chosen);
    if chosen().next().is_none() {
        return Err(Error::NoCrease);
    }
    let (name, width) = match options.radius > 0.0 {
        true => ("radius", options.radius),
        false => ("width", options.width),
    };
    let length: f64 = chosen().map(|chain| chain.length(surface)).sum();
    let is_told = width * options.taper.min(1.0) >= FINEST * surface.extent();
    Error::check_option(name, width, is_told, "larger, for a mesh as large as this")?;
    // Of blends with any room for them: at each point of a curve there are a few vertices.
    check_count(PER_WIDTH * length / width, options)
}

/// # Errors
/// [`Error::BadOption`] if blends have more vertices than are wanted.
fn check_count(vertices: f64, options: &RoundOptions) -> Result<(), Error> {
    let most = options.max_blend_vertices as f64;
    let range = "at least the number of vertices that blends of this width need";
    Error::check_option("max_blend_vertices", most, vertices <= most, range)
}

/// # Errors
/// [`Error::BadOption`] if there are labels, but not one for each triangle.
fn check_labels(triangles: &[[u32; 3]], options: &RoundOptions) -> Result<(), Error> {
    let count = options.labels.len();
    let is_right = count == 0 || count == triangles.len();
    Error::check_option("labels", count as f64, is_right, "one for each triangle")
}

/// The options, with the edges as the joined mesh has them.
///
/// # Errors
/// [`Error::NotAnEdge`] for one that does not exist or has one triangle only.
fn named_edges(
    copies: &Copies,
    surface: &Surface<'_>,
    options: &RoundOptions,
) -> Result<RoundOptions, Error> {
    let half_edges = 0..surface.half_edges();
    let inside = half_edges.filter(|&h| surface.across(h).is_some());
    let all: Vec<[u32; 2]> = match options.edges.is_empty() {
        true => Vec::new(),
        false => inside.map(|h| [surface.origin(h), surface.target(h)]).collect(),
    };
    let all = EdgeSet::new(&all);
    let count = surface.x.len() as u32;
    let named = |&[a, b]: &[u32; 2]| {
        let known = (a < count && b < count).then(|| [copies.smallest(a), copies.smallest(b)]);
        known
            .filter(|edge| all.has(edge[0], edge[1]))
            .ok_or(Error::NotAnEdge {
                a: a as usize,
                b: b as usize,
            })
    };
    Ok(RoundOptions {
        edges: options.edges.iter().map(named).collect::<Result<_, _>>()?,
        ..options.clone()
    })
}

/// The sides of all chains, with their widths.
fn level(surface: &Surface<'_>, graph: &CreaseGraph, endings: &Endings, options: &RoundOptions) -> Level {
    let Endings { through, mitres } = endings;
    let mitred: Vec<u32> = mitres.iter().map(|of| of.vertex).collect();
    let base = options.radius.max(options.width);
    let curve = |chain: &Chain| {
        let bends: Vec<f64> = chain.half_edges.iter().map(|&h| graph.bend(surface, h)).collect();
        ChainCurve::new(&vertices(chain, surface), &bends, chain.is_closed, base)
    };
    let mut curves: Vec<ChainCurve> = graph.chains.iter().map(curve).collect();
    for of in endings.ends() {
        curves[of.chain].goes_on[of.end] = true;
    }
    let (corners, angles) = corners(surface, graph, &mitred);
    let mut widths = Widths::asked(surface, graph, &curves, options);
    let least = widths.fit(surface, graph, &curves, (&angles, through));
    widths.fade(surface, graph, &curves, through);
    let mut sides = Vec::new();
    let side = |face: u32, curve: usize| Side {
        face,
        curve: curve as u32,
        widest: widths.at[curve].iter().copied().fold(0.0, f64::max),
        widths: widths.at[curve].clone(),
        with: [None; 2],
    };
    for (number, chain) in graph.chains.iter().enumerate() {
        sides.extend(graph.beside(chain, surface).map(|face| side(face, number)));
    }
    for of in mitres {
        of.taper(&curves, &mut sides);
        of.join(&mut sides);
    }
    sides.extend(through.iter().filter_map(|of| Some(side(of.face?, of.at.chain))));
    Level {
        curves,
        sides,
        corners,
        least,
    }
}

/// The places of a chain's vertices; of a closed one the first is not repeated.
fn vertices(chain: &Chain, surface: &Surface<'_>) -> Vec<Vector3<f64>> {
    let first = chain.half_edges.iter().map(|&h| surface.origin(h));
    let last = chain.half_edges.iter().map(|&h| surface.target(h)).next_back();
    let all = first.chain(last.filter(|_| !chain.is_closed));
    all.map(|v| surface.x[v as usize]).collect()
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

/// Tells the ends of chains that they are on the faces across from them.
fn seed_across(cut: &mut Cut<'_>, surface: &Surface<'_>, graph: &CreaseGraph, through: &[Through]) {
    let across = through.iter().filter(|of| of.face.is_some());
    for (side, of) in (2 * graph.chains.len() as u32..).zip(across) {
        let last = cut.level.curves[of.at.chain].points.len() - 1;
        let at = [0, last][of.at.end] as f64;
        let around = surface.links.outgoing.row(of.vertex as usize);
        around.iter().take(1).for_each(|&h| cut.seed(h, side, at));
    }
}
