//! Where creases of the surroundings arrive at the boundary of a region.
//!
//! The bend of one edge is none on a scan, whose every edge bends. So the surroundings are parted along the chain of edges that may be
//! a crease, and tangent planes fitted on both sides of it: they have to differ by far more than the fits are uncertain, and
//! by as much at the next vertices of the chain.

use nalgebra::{Matrix2, Matrix2x3, Vector2, Vector3};

use super::along_chain::LONG;
use super::boundary_corner::third;
use super::outside::Outside;
use super::sides::{AROUND, SideFit, Sides};
use crate::discrete::boundary_normals::angle;
use crate::fairing::options::Options;
use crate::fairing::sharp_edge::CreaseEnd;

/// An angle is wider than asked for by so many standard errors of the fits: less may be a fold of what is rough. Of ten right angles in noise of a tenth
/// of an edge nine are followed from end to end. Half: of 80 regions of scans one has an edge, and of 165 regions across edges of parts one is a false
/// success; double: one of 33 holes is no success.
const SIGNIFICANT: f64 = 20.0;
/// Fits with larger standard errors tell nothing, degrees.
const UNCERTAIN: f64 = 9.0;
/// The edges of a crease bend by this part of the angle between the planes beside it: elsewhere the bends are not on the chain.
/// Half: of 60 parts none changes, of 80 regions of four scans 24 have ends in place of 5; double: 53 parts have none.
const OF_EDGES: f64 = 0.6;
/// Along the edges that tell a crease its angle, where it is certain, is no less than this part of that at the boundary: else it is a fold that runs out.
/// Half: none of 60 parts and 80 regions of scans changes; double: 53 parts have no ends.
const LASTS: f64 = 0.7;
/// Fewer edges of a chain tell no curvature.
/// Half or double, of 60 parts: none changes.
const STRAIGHT: usize = 4;
/// A curvature of fewer standard errors is none.
/// Half or double, of 60 parts: none changes.
const BENT: f64 = 6.0;
/// A curvature is taken to be off by no more standard errors. Half: of 66 holes and regions of parts none changes; three times as many: of 165 regions
/// across edges of parts one more is a false success.
const CERTAIN: f64 = 2.0;
/// Where a side is one strip of triangles, its facets may be those of something round: only wider ones are taken for planes unless less is asked for,
/// degrees: between a nonagon's and an octagon's. Half: tubes of 10 and 12 sides have an edge at every vertex, of 66 regions across edges of parts one
/// is nearer and one less near; a quarter more: chamfers of 45 degrees are not found, and of 33 regions across edges of parts one
/// fewer is good; at 105 edges of 72 degrees around a strip are not.
const FACETS: f64 = 42.5;
/// An edge that bends by less than this part of the angle asked for is in no chain.
const FIRST_BEND: f64 = 0.5;
/// A chain turns by no more than this from edge to edge, degrees.
const TURN: f64 = 50.0;

/// The ends of creases of at least so many degrees at the boundary vertices of one component, by their vertices: one crease may end at another
/// component a few edges on.
pub(crate) fn crease_ends(outside: &Outside<'_>, mut boundary: Vec<u32>, least: f64) -> Vec<CreaseEnd> {
    boundary.sort_unstable();
    let found = boundary.into_iter().filter_map(|v| end_at(outside, v, least));
    without_doubles(outside, found.collect())
}

/// Normals at boundary vertices near to these ends: of their own side.
pub(super) fn normals_near(outside: &Outside<'_>, ends: &[&CreaseEnd], least: f64) -> Vec<(u32, [f64; 3])> {
    let near =
        |end: &&CreaseEnd| Sides::new(outside, &end.chains, least).boundary_normals(outside, &end.chains);
    ends.iter().flat_map(near).collect()
}

/// The crease that arrives at a boundary vertex, or starts where two do; `None` where more do.
fn end_at(outside: &Outside<'_>, v: u32, least: f64) -> Option<CreaseEnd> {
    let mut first = bent(outside, v, least);
    if first.iter().any(|w| outside.is_marked(v, *w)) {
        first.retain(|w| outside.is_marked(v, *w));
    }
    let chains = first.into_iter().map(|w| chain(outside, v, w, least));
    // Edges between boundary vertices lead into the region, or around a face of boundary vertices alone.
    let leads_out = |chain: &Vec<u32>| chain.iter().any(|&v| !outside.is_boundary[v as usize]);
    let chains: Vec<Vec<u32>> = chains
        .filter(|chain| leads_out(chain) && may_be_crease(outside, chain, least))
        .collect();
    if let Some(two) = both(outside, &chains, least) {
        let is_wide = |end: &CreaseEnd| end.angle.abs() >= least + SIGNIFICANT * end.error;
        return third(outside, two).filter(|end| is_marked(outside, end) || is_wide(end));
    }
    let mut alone = chains
        .chunks(1)
        .filter_map(|chain| along(outside, chain, 0, least));
    let end = alone.next()?;
    alone.next().is_none().then_some(end)
}

/// Whether the edges along a chain bend as much as those of a crease, or are marked.
fn may_be_crease(outside: &Outside<'_>, chain: &[u32], least: f64) -> bool {
    outside.is_marked(chain[0], chain[1]) || mean_bend(outside, chain).abs() >= OF_EDGES * least
}

/// Whether the edges from an end are marked sharp.
fn is_marked(outside: &Outside<'_>, end: &CreaseEnd) -> bool {
    end.chains
        .iter()
        .all(|chain| outside.is_marked(chain[0], chain[1]))
}

/// The creases along two chains, each of whose sides reach as far as the other.
fn both(outside: &Outside<'_>, chains: &[Vec<u32>], least: f64) -> Option<[CreaseEnd; 2]> {
    let end = |k: usize| along(outside, chains, k, least);
    if chains.len() != 2 {
        return None;
    }
    Some([end(0)?, end(1)?])
}

/// The mean bend of the edges that tell a crease along a chain.
fn mean_bend(outside: &Outside<'_>, chain: &[u32]) -> f64 {
    let bends = chain
        .windows(2)
        .take(LONG)
        .map(|step| outside.bend(step[0], step[1]));
    bends.sum::<f64>() / (chain.len() - 1).min(LONG) as f64
}

/// Where the edges at a vertex lead to that may be in a chain.
pub(super) fn bent(outside: &Outside<'_>, v: u32, least: f64) -> Vec<u32> {
    let mut others = outside.neighbours(v);
    others.retain(|w| outside.is_sharp(v, *w, FIRST_BEND * least));
    others
}

/// The end of a crease along one of the chains at a vertex, if there is one.
fn along(outside: &Outside<'_>, chains: &[Vec<u32>], which: usize, least: f64) -> Option<CreaseEnd> {
    let chain = &chains[which];
    let steps = (chain.len() - 1).min(LONG);
    let count = steps as f64;
    let bend = mean_bend(outside, chain);
    let sides = Sides::new(outside, chains, least);
    let outward = outside.position(chain[chain.len().min(3) - 1]) - outside.position(chain[0]);
    let fold = |step: usize, most: f64| Fold::of(sides.fits(&chain[step..], most)?, outward);
    let significant = SIGNIFICANT * LONG as f64 / count;
    let is_marked = outside.is_marked(chain[0], chain[1]);
    // With larger errors an angle is not certain that these bends allow.
    let most = match is_marked {
        true => UNCERTAIN,
        false => (bend.abs() / OF_EDGES - least) / significant,
    };
    let is_crease = |fold: &Fold| match is_marked {
        true => fold.angle.abs() > fold.error,
        false => fold.is_certain(significant, least) && fold.is_wide(least),
    };
    let here = fold(0, most.to_radians()).filter(is_crease)?;
    let lasts = |fold: Option<Fold>| {
        fold.is_some_and(|fold| {
            !fold.is_certain(SIGNIFICANT, least)
                || fold.angle * here.angle.signum() >= LASTS * here.angle.abs()
        })
    };
    let is_along_edges = bend * here.angle.signum() >= OF_EDGES * here.angle.abs();
    let goes_on = is_marked || is_along_edges && (1..steps).all(|step| lasts(fold(step, f64::INFINITY)));
    let (curvature, curvature_error) = curvature(outside, chain, here.direction);
    goes_on.then(|| CreaseEnd {
        vertex: chain[0],
        curvature: curvature.into(),
        curvature_error,
        direction: here.direction.into(),
        normals: here.normals.map(Into::into),
        angle: here.angle,
        error: here.error,
        chains: vec![chain.clone()],
    })
}

/// The curvature at the first vertex of a chain, of the curve through its vertices with this tangent there, against which they run: by least
/// squares, `x(s) = x + t s + k s^2 / 2 + d s^3 / 6`. Zero where the vertices are not that near to it. And
/// how far it may be off.
fn curvature(outside: &Outside<'_>, chain: &[u32], tangent: Vector3<f64>) -> (Vector3<f64>, f64) {
    let from = outside.position(chain[0]);
    let mut s = 0.0;
    let samples = chain[1..].iter().zip(chain).map(|(&v, &before)| {
        let x = outside.position(v);
        s -= (x - outside.position(before)).norm();
        let off = x - from - tangent * s;
        (s, off - tangent * off.dot(&tangent))
    });
    let samples: Vec<(f64, Vector3<f64>)> = samples.collect();
    let unknown = (Vector3::zeros(), f64::INFINITY);
    if samples.len() < STRAIGHT {
        return unknown;
    }
    let basis = |s: f64| Vector2::new(s * s / 2.0, s.powi(3) / 6.0);
    let mut matrix = Matrix2::zeros();
    let mut right = Matrix2x3::zeros();
    for (s, off) in &samples {
        matrix += basis(*s) * basis(*s).transpose();
        right += basis(*s) * off.transpose();
    }
    let Some(inverse) = matrix.try_inverse() else {
        return unknown;
    };
    let found = inverse * right;
    let residual =
        |(s, off): &(f64, Vector3<f64>)| (off.transpose() - basis(*s).transpose() * found).norm_squared();
    let square: f64 = samples.iter().map(residual).sum();
    let error = (square / (samples.len() - 2) as f64 * inverse[(0, 0)]).sqrt();
    let k = found.row(0).transpose();
    let is_bent = k.norm() > BENT * error;
    (if is_bent { k } else { Vector3::zeros() }, CERTAIN * error)
}

/// How the surface is folded at a vertex of a crease.
struct Fold {
    direction: Vector3<f64>,
    normals: [Vector3<f64>; 2],
    angle: f64,
    error: f64,
    has_facet: bool,
}

impl Fold {
    /// Between the planes left and right of the direction outward.
    fn of(sides: [SideFit; 2], outward: Vector3<f64>) -> Option<Self> {
        let has_facet = sides.iter().any(|side| side.is_facet);
        let fits = sides.map(|side| side.fit);
        let [left, right] = fits.map(|fit| fit.normal);
        let along = left.cross(&right).try_normalize(1e-9)?;
        let sign = along.dot(&outward).signum();
        Some(Self {
            direction: -along * sign,
            normals: [right, left],
            angle: sign * angle(&left, &right).to_degrees(),
            error: libm::hypot(fits[0].error, fits[1].error).to_degrees(),
            has_facet,
        })
    }

    /// Whether it is as wide as a crease has to be.
    fn is_wide(&self, least: f64) -> bool {
        let of_facets = self.has_facet && least == Options::SHARP_AUTO;
        self.angle.abs() >= if of_facets { FACETS } else { least }
    }

    /// Whether it is wider than asked for by so many standard errors.
    fn is_certain(&self, significant: f64, least: f64) -> bool {
        self.error <= UNCERTAIN && self.angle.abs() >= least + significant * self.error
    }
}

/// The edges that bend most, one after the other, from `v` over `w` as far as fits reach, or until none bends by enough: at a corner.
fn chain(outside: &Outside<'_>, v: u32, w: u32, least: f64) -> Vec<u32> {
    let mut chain = vec![v, w];
    let sign = outside.bend(v, w).signum();
    let is_marked = outside.is_marked(v, w);
    let straightest = libm::cos(TURN.to_radians());
    while chain.len() < AROUND {
        let [before, last] = [chain[chain.len() - 2], chain[chain.len() - 1]];
        let direction = (outside.position(last) - outside.position(before)).normalize();
        let sharpness = |next: u32| {
            let step = (outside.position(next) - outside.position(last)).normalize();
            let straight = step.dot(&direction);
            let bend = match is_marked {
                true => f64::from(u8::from(outside.is_marked(last, next))),
                false => outside.bend(last, next) * sign,
            };
            let is_in = bend > 0.0 && (is_marked || bend >= FIRST_BEND * least);
            (straight > straightest && is_in).then_some((straight * bend, next))
        };
        let neighbours = outside.neighbours(last).into_iter().filter_map(sharpness);
        match neighbours.max_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((_, next)) => chain.push(next),
            None => break,
        }
    }
    chain
}

/// Of ends of one fold that are within two edges of each other's chains the one that is farthest in, or else the most certain one. Those on both
/// sides of a narrow strip are two folds.
fn without_doubles(outside: &Outside<'_>, ends: Vec<CreaseEnd>) -> Vec<CreaseEnd> {
    let certainty = |end: &CreaseEnd| match is_marked(outside, end) {
        true => f64::INFINITY,
        false => end.angle.abs() / end.error.max(1e-9),
    };
    let near = |end: &CreaseEnd| {
        let around = end
            .chains
            .iter()
            .flatten()
            .flat_map(|&v| outside.within(v, 1).vertices);
        let mut around: Vec<u32> = around.collect();
        around.sort_unstable();
        around
    };
    let near: Vec<Vec<u32>> = ends.iter().map(near).collect();
    let meet = |i: usize, j: usize| near[i].iter().any(|v| near[j].binary_search(v).is_ok());
    let is_one_fold = |i: usize, j: usize| {
        let half = 0.5 * ends[i].angle.abs().min(ends[j].angle.abs());
        let apart = |side: usize| {
            let [a, b] = [i, j].map(|end| Vector3::from(ends[end].normals[side]));
            angle(&a, &b).to_degrees()
        };
        apart(0).max(apart(1)) < half
    };
    let is_best = |&i: &usize| {
        let better = |j: usize| {
            let [is_beyond, goes_beyond] = [(i, j), (j, i)]
                .map(|(a, b)| ends[b].chains.iter().any(|chain| chain.contains(&ends[a].vertex)));
            is_beyond || !goes_beyond && certainty(&ends[j]) > certainty(&ends[i])
        };
        let goes_on = |j: usize| goes_on(&ends[i], &ends[j]);
        !(0..ends.len()).any(|j| j != i && (goes_on(j) || meet(i, j) && is_one_fold(i, j) && better(j)))
    };
    (0..ends.len()).filter(is_best).map(|i| ends[i].clone()).collect()
}

/// Whether the first end is on the way out from another one, which may be a corner at the boundary.
fn goes_on(end: &CreaseEnd, other: &CreaseEnd) -> bool {
    let [chain] = &end.chains[..] else {
        return false;
    };
    let has_its_edge = |way: &Vec<u32>| way.windows(2).any(|step| *step == chain[..2]);
    other.chains.iter().any(has_its_edge)
}

#[cfg(test)]
mod tests {
    use super::*;
    use fairmesh_shapes::{Creased, Sampling, Shape, creased, plate, sphere_cap};

    fn piece(of: Creased, seed: u64) -> Shape {
        creased(of, ([0.1, 0.05], 0.5), 250, Sampling::Irregular { seed }, 6)
    }

    fn ends_of(shape: &Shape, noise: f64, seed: u64) -> Vec<CreaseEnd> {
        let mut all = shape.clone();
        all.free.fill(true);
        let x = all.noise(seed, noise);
        ends_around(&Outside::new(&x, &shape.triangles, &shape.free, &[]), 20.0)
    }

    fn ends_around(outside: &Outside<'_>, least: f64) -> Vec<CreaseEnd> {
        crease_ends(outside, outside.boundary(), least)
    }

    #[test]
    fn an_edge_of_two_planes_has_exact_ends() {
        for degrees in [30.0, -30.0, 90.0, -90.0, 150.0] {
            for seed in 1..=5 {
                let ends = ends_of(&piece(Creased::Wedge(degrees), seed), 0.0, 0);
                assert_eq!(ends.len(), 2, "{degrees} {seed}");
                for end in &ends {
                    assert_near!(end.angle, degrees, 1e-9);
                    assert_near!(end.direction[0].abs(), 1.0, 1e-12);
                }
            }
        }
    }

    /// A tube of so many strips of triangles, and which vertices of it are free: those of its middle, around.
    fn tube(sides: u32) -> Shape {
        let at = |v: u32| {
            let turn = std::f64::consts::TAU / f64::from(sides);
            let (sin, cos) = libm::sincos(f64::from(v % sides) * turn);
            [cos, sin, f64::from(v / sides) * turn]
        };
        let quads = (0..12).flat_map(|i| (0..sides).map(move |j| [i, j].map(|k| (k, (k + 1) % sides))));
        let triangles = quads.flat_map(|[(i, _), (j, next)]| {
            let [a, b, c, d] = [
                i * sides + j,
                i * sides + next,
                (i + 1) * sides + next,
                (i + 1) * sides + j,
            ];
            [[a, b, c], [a, c, d]]
        });
        let count = 13 * sides;
        let mut shape = plate(100, Sampling::Regular);
        shape.positions = (0..count).map(at).collect();
        shape.triangles = triangles.collect();
        shape.free = (0..count).map(|v| (5..8).contains(&(v / sides))).collect();
        shape
    }

    #[test]
    fn facets_of_something_round_have_no_edges_but_where_they_are_asked_for() {
        for (sides, least, count) in [
            (12, 20.0, 0),
            (9, 20.0, 0),
            (8, 20.0, 16),
            (6, 20.0, 12),
            (12, 25.0, 24),
        ] {
            let shape = tube(sides);
            let outside = Outside::new(&shape.positions, &shape.triangles, &shape.free, &[]);
            assert_eq!(ends_around(&outside, least).len(), count, "{sides} {least}");
        }
    }

    #[test]
    fn vertices_without_a_place_hide_no_edge() {
        let shape = piece(Creased::CappedCylinder, 1);
        let outside = Outside::new(&shape.positions, &shape.triangles, &shape.free, &[]);
        let end = &ends_around(&outside, 20.0)[0];
        let beside = |v: &u32| {
            let around = outside.within(*v, 2).vertices;
            !around
                .iter()
                .any(|w| outside.is_boundary[*w as usize] || end.chains[0].contains(w))
        };
        let near = outside.within(end.vertex, 4).vertices;
        for v in near.into_iter().filter(beside) {
            let mut positions = shape.positions.clone();
            positions[v as usize] = [f64::NAN; 3];
            let ends = ends_around(
                &Outside::new(&positions, &shape.triangles, &shape.free, &[]),
                20.0,
            );
            assert_eq!(ends.len(), 2, "{v}");
        }
    }

    /// The tangents of the rims are off by .03 degrees at most.
    #[test]
    fn edges_of_curved_solids_have_ends_and_corners_have_three() {
        let solids = [
            (Creased::CappedCylinder, 2),
            (Creased::Cone(30.0), 2),
            (Creased::Tee(0.6), 2),
            (Creased::CubeCorner, 3),
        ];
        for (of, count) in solids {
            for seed in 1..=5 {
                let shape = piece(of, seed);
                let ends = ends_of(&shape, 0.0, 0);
                assert_eq!(ends.len(), count, "{of:?} {seed}");
                for end in ends
                    .iter()
                    .filter(|_| matches!(of, Creased::CappedCylinder | Creased::Cone(_)))
                {
                    let [x, y, z] = shape.positions[end.vertex as usize];
                    assert_near!(end.direction[0] * x + end.direction[1] * y, 0.0, 5e-4);
                    let off = Vector3::from(end.curvature) + Vector3::new(x, y, z);
                    assert_below!(off.norm(), 0.1);
                }
            }
        }
    }

    /// A tube with triangles across half of its end that have vertices alone in common, as faces of many corners leave them, and a free vertex in the middle.
    #[test]
    fn triangles_that_meet_in_vertices_are_no_side() {
        let count = 24;
        let at = |v: u32| {
            let (sin, cos) = libm::sincos(f64::from(v % count) * std::f64::consts::TAU / f64::from(count));
            [cos, sin, -0.3 * f64::from(v / count)]
        };
        let mut x: Vec<[f64; 3]> = (0..4 * count).map(at).collect();
        x.push([0.0, 0.0, 0.2]);
        let wall = (0..3).flat_map(|i| (0..count).map(move |j| [i * count + j, i * count + (j + 1) % count]));
        let wall = wall.flat_map(|[a, b]| [[b, a, a + count], [b, a + count, b + count]]);
        let end = (0..count).step_by(2).flat_map(|j| {
            let (next, middle) = ((j + 2) % count, 4 * count);
            match j < 14 {
                true => [[j, j + 1, next], [j, next, middle]],
                false => [[j, j + 1, middle], [j + 1, next, middle]],
            }
        });
        let triangles: Vec<[u32; 3]> = wall.chain(end).collect();
        let free: Vec<bool> = (0..=4 * count).map(|v| v == 4 * count).collect();
        let ends = ends_around(&Outside::new(&x, &triangles, &free, &[]), Options::SHARP_AUTO);
        assert_eq!(ends, []);
    }

    /// As where an edge touches the boundary shortly before it ends in a corner there.
    #[test]
    fn an_end_on_the_way_out_from_another_is_none() {
        let ends = ends_of(&piece(Creased::Wedge(90.0), 1), 0.0, 0);
        let with = |chains: &[&[u32]]| CreaseEnd {
            chains: chains.iter().map(|chain| chain.to_vec()).collect(),
            ..ends[0].clone()
        };
        let corner = with(&[&[5, 4, 3], &[5, 8, 9]]);
        for (chain, is_one) in [
            ([4, 3, 2], true),
            ([8, 9, 1], true),
            ([4, 7, 6], false),
            ([4, 5, 8], false),
        ] {
            assert_eq!(goes_on(&with(&[&chain]), &corner), is_one, "{chain:?}");
        }
    }

    /// A plate with a round hole whose wall is one strip of triangles, and where some vertices of its rim are free.
    #[test]
    fn a_wall_of_one_strip_has_the_normals_of_its_triangles() {
        let count = 24;
        let at = |v: u32| {
            let (sin, cos) = libm::sincos(f64::from(v % count) * std::f64::consts::TAU / f64::from(count));
            let [radius, z] = [[2.0, 0.0], [1.0, 0.0], [1.0, -1.0]][(v / count) as usize];
            [radius * cos, radius * sin, z]
        };
        let quads =
            (0..2).flat_map(|i| (0..count).map(move |j| [i * count + j, i * count + (j + 1) % count]));
        let triangles = quads.flat_map(|[a, b]| [[a, b, b + count], [a, b + count, a + count]]);
        let x: Vec<[f64; 3]> = (0..3 * count).map(at).collect();
        let free: Vec<bool> = (0..3 * count).map(|v| (count..count + 4).contains(&v)).collect();
        let triangles: Vec<[u32; 3]> = triangles.collect();
        let ends = ends_around(&Outside::new(&x, &triangles, &free, &[]), Options::SHARP_AUTO);
        let [first, last] = [count + 4, 2 * count - 1];
        assert_eq!(
            ends.iter().map(|end| end.vertex).collect::<Vec<_>>(),
            [first, last]
        );
        for end in &ends {
            let [x, y, _] = x[end.vertex as usize];
            assert_near!(end.angle.abs(), 90.0, 1e-9);
            assert_near!(end.direction[0] * x + end.direction[1] * y, 0.0, 1e-9);
        }
    }

    #[test]
    fn noise_hides_no_right_angle_and_makes_none() {
        for seed in 1..=5 {
            let ends = ends_of(&piece(Creased::Wedge(90.0), seed), 0.1, seed);
            assert_eq!(ends.len(), 2, "{seed}");
            for noise in [0.1, 0.2, 0.3, 0.5] {
                let mut smooth = [
                    sphere_cap(60.0, 600, Sampling::Irregular { seed }, 6),
                    plate(1_200, Sampling::Irregular { seed }),
                ];
                let within = |p: &[f64; 3]| p[0].hypot(p[1]) < 0.5;
                smooth[1].free = smooth[1].positions.iter().map(within).collect();
                for shape in &smooth {
                    assert_eq!(ends_of(shape, noise, seed), [], "{noise} {seed}");
                }
            }
        }
    }
}
