//! The extent of a bump or a dent: where the mean curvature departs from that of the surroundings.
//!
//! Rings around the seed are looked at, ever larger ones, until the curvature in one is that of the next one: then it is that of the
//! surroundings, as a linear function of the place. What departs from it and hangs together with the seed is the bump.

use fairmesh_linear::interrupt::is_stopped;
use nalgebra::Vector3;

use super::geodesic;
use super::neighbours::Neighbours;
use super::robust::{Linear, median, quantile};
use super::seed::Foot;
use super::spread;
use crate::discrete::mesh_curvature;
use crate::support::error::Error;

/// The smallest ring's inner radius, in edges around the seed; each next one is larger by [`STEP`].
/// Of 5 cases, half: 2 change; double: 3 change by up to 1 edge, -4 % iterations.
const FIRST: f64 = 3.0;
/// Growth of the inner radius from ring to ring.
/// Of 5 cases, half: 5 change, -100 % iterations, 5 fail; double: 3 change by up to 1 edge.
const STEP: f64 = 1.15;
/// Outer radius of a ring over its inner one.
/// Half or double, of 5 cases: 5 change, -100 % iterations, 5 fail.
const RING: f64 = 1.5;
/// Outer radius of the ring behind it over the same inner one.
/// Of 5 cases, half: 5 change, -100 % iterations, 5 fail; double: 3 change by up to 1 edge.
const NEXT: f64 = 2.25;
/// Fewer vertices in a ring say nothing.
/// Half or double, of 5 cases: 3 change by up to 0.9 edges.
const LEAST: usize = 24;
/// Passes of averaging over neighbours that are tried, for noise.
/// Of 5 cases, half: 2 change by up to 1 edge; double: 2 change by up to 1 edge, -4 % iterations.
const PASSES: [usize; 5] = [0, 2, 8, 32, 128];
/// Averaging reaches no further than such a part of the radius.
/// Of 5 cases, half: 2 change by up to 1 edge, +4 % iterations; double: 2 change, -42 % iterations, 2 fail.
const REACH: f64 = 2.5;
/// What the bump departs by, at least, and what belongs to it, in scatters of the surroundings.
/// Of 5 cases, half: 2 change by up to 0.9 edges, -4 % iterations; double: none changes.
const PEAK: f64 = 4.0;
const OFF: f64 = 4.0;
/// It is no more than one of so many parts of what hangs together with it.
/// Of 5 cases, half: 2 change by up to 1 edge, +8 % iterations; double: none changes.
const PART: usize = 3;
/// What belongs to it, over the most that it departs by.
/// Of 5 cases, half: 3 change by up to 0.5 edges; double: 3 change by up to 0.6 edges.
const OF_PEAK: f64 = 0.02;
/// A ring of which more is off is not calm.
/// Half or double, of 5 cases: none changes.
const STRAY: f64 = 0.25;
/// A ring scatters no more than so many times the next one.
/// Half or double, of 5 cases: none changes.
const CALM: f64 = 2.5;
/// Between parts that depart to either side there are so many rings that do not.
/// Half or double, of 5 cases: 5 change by up to 1 edge.
const BETWEEN: usize = 2;
/// It ends within the inner radius of the rings, but for so much, and but for such a part, which is chance.
/// Of 5 cases, half: 3 change by up to 1 edge; double: none changes.
const WITHIN: f64 = 1.2;
const STRAGGLERS: f64 = 0.1;
/// What departs by less than can be told apart from noise reaches so far outside, over the radius.
/// Of 2 cases, half: 2 change by up to 1 edge; double: 2 change by up to 1 edge, +10 % iterations.
const MARGIN: f64 = 0.2;
/// The fractions of the progress at which distances and curvature are known, and all rings have been looked at: shares of the time, measured on
/// a sheet of 80,000 triangles.
/// Half or double, of 5 cases: only the progress changes.
const DISTANCES: f64 = 0.01;
const CURVATURE: f64 = 0.03;
const RINGS: f64 = 0.95;

/// What was taken for a bump.
#[derive(Debug, Clone, PartialEq)]
pub struct Bump {
    /// How far its farthest corner is from the seed, along the surface.
    pub radius: f64,
    /// How many triangles it has.
    pub triangles: usize,
    /// By how much its mean curvature departs from that of the surroundings (95 in 100 vertices by less).
    pub departure: f64,
    /// The mean curvature of the surroundings (the median).
    pub surroundings: f64,
    /// How much that scatters (standard deviation).
    pub scatter: f64,
}

/// Finds the bump at a point of the surface, and whether each triangle belongs to it.
///
/// # Errors
/// [`Error::NoBump`].
pub(super) fn find(
    mesh: &Neighbours<'_>,
    foot: &Foot,
    tell: &mut dyn FnMut(f64),
) -> Result<(Bump, Vec<bool>), Error> {
    let distance = geodesic::distances(mesh, foot);
    let mut order: Vec<u32> = (0..distance.len() as u32)
        .filter(|&v| distance[v as usize].is_finite())
        .collect();
    order.sort_unstable_by(|&a, &b| {
        distance[a as usize]
            .total_cmp(&distance[b as usize])
            .then(a.cmp(&b))
    });
    tell(DISTANCES);
    let curvature = mesh_curvature::mean_curvature(mesh.positions, mesh.triangles)?;
    tell(CURVATURE);
    let around = Around {
        mesh,
        foot,
        distance,
        order,
        curvature,
    };
    let edge = around.edge();
    let mut found: Vec<(Rings, Vec<Calm>)> = Vec::new();
    let mut radius = FIRST * edge;
    let all = around.order.len() as f64;
    while let Some(rings) = around.rings(radius).filter(|_| !is_stopped()) {
        // Time goes with the sum over all rings, a geometric series: with the last one.
        tell(CURVATURE + (RINGS - CURVATURE) * (PART as f64 * rings.ends[0] as f64 / all).min(1.0));
        // Averaging reaches as far as the root of its passes.
        let most = (radius / (REACH * edge)).powi(2) as usize;
        let passes = PASSES.into_iter().filter(|&passes| passes <= most);
        let calm: Vec<Calm> = passes.filter_map(|passes| around.calm(&rings, passes)).collect();
        found.push((rings, calm));
        radius *= STEP;
    }
    let clearness = |calm: &[Calm]| calm.iter().map(Calm::clearness).fold(0.0, f64::max);
    // On the flank of a wide bump, too, there are rings along which the curvature does not change; but it stands out less from these.
    found.retain(|(_, calm)| !calm.is_empty());
    // Of two that are about as clear the smaller one: other features are farther away.
    let merit = |(rings, calm): &(Rings, Vec<Calm>)| clearness(calm) / rings.radius.sqrt();
    found.sort_by(|a, b| merit(b).total_cmp(&merit(a)));
    let mut ends = found
        .iter()
        .filter_map(|(rings, calm)| around.extent(rings, calm));
    let why = "the curvature nowhere settles around it";
    ends.next().ok_or(Error::NoBump { why })
}

/// The surface around the seed.
struct Around<'m> {
    mesh: &'m Neighbours<'m>,
    foot: &'m Foot,
    distance: Vec<f64>,
    /// The vertices that can be reached, by their distance.
    order: Vec<u32>,
    curvature: Vec<f64>,
}

/// Two rings around the seed.
struct Rings {
    radius: f64,
    /// How many vertices of the order lie inside, up to the end of the first ring, and up to that of the second.
    ends: [usize; 3],
}

impl Calm {
    /// How far the bump stands out from rings that it does not reach into.
    fn clearness(&self) -> f64 {
        (1.0 - self.stray).powi(2) * self.peak / self.scatter.max(f64::MIN_POSITIVE)
    }

    /// What departs by more belongs to the bump.
    fn least(&self) -> f64 {
        (OFF * self.scatter).max(OF_PEAK * self.top)
    }

    /// Whether what belongs to it may depart by less than what is chance.
    fn hides_flanks(&self) -> bool {
        OFF * self.scatter > OF_PEAK * self.top
    }
}

/// The curvature in a disk, and that of the surroundings.
struct Calm {
    /// By how much each vertex of the order departs.
    off: Vec<f64>,
    peak: f64,
    /// What its vertices depart by at most.
    top: f64,
    surroundings: f64,
    scatter: f64,
    /// Which part of the first ring departs.
    stray: f64,
}

impl Around<'_> {
    /// The median length of the edges near the seed.
    fn edge(&self) -> f64 {
        let near = &self.order[..self.order.len().min(2 * LEAST)];
        let lengths = near.iter().flat_map(|&v| {
            let around = self.mesh.around(v);
            around.map(move |w| (self.mesh.place(w) - self.mesh.place(v)).norm())
        });
        median(&lengths.collect::<Vec<f64>>())
    }

    /// The rings of a radius; None where the surface ends within the first one, or much of it lies inside.
    fn rings(&self, radius: f64) -> Option<Rings> {
        let within = |limit: f64| self.order.partition_point(|&v| self.distance[v as usize] < limit);
        let ends = [radius, RING * radius, NEXT * radius].map(within);
        let is_part = PART * ends[0] <= self.order.len() && ends[1] < self.order.len();
        (radius > 0.0 && is_part).then_some(Rings { radius, ends })
    }

    /// The curvature up to the end of the second ring, averaged so often over neighbours there.
    fn averaged(&self, end: usize, passes: usize) -> Vec<f64> {
        let disk = &self.order[..end];
        let mut of: Vec<f64> = disk.iter().map(|&v| self.curvature[v as usize]).collect();
        if passes == 0 {
            return of;
        }
        let mut at = vec![u32::MAX; self.distance.len()];
        (0..).zip(disk).for_each(|(i, &v)| at[v as usize] = i);
        for _ in (0..passes).take_while(|_| !is_stopped()) {
            let average = |(i, &v): (usize, &u32)| {
                let near = self.mesh.around(v).map(|w| at[w as usize]);
                let (mut sum, mut count) = (of[i], 1.0);
                for j in near.filter(|&j| j != u32::MAX) {
                    // Each neighbour inside comes twice, by two triangles.
                    sum += 0.5 * of[j as usize];
                    count += 0.5;
                }
                sum / count
            };
            of = disk.iter().enumerate().map(average).collect();
        }
        of
    }

    /// The curvature of the surroundings, if the rings are calm and what is inside departs from it.
    fn calm(&self, rings: &Rings, passes: usize) -> Option<Calm> {
        let [inner, first, second] = rings.ends;
        if first - inner < LEAST || second - first < LEAST {
            return None;
        }
        let place = |&v: &u32| (self.mesh.place(v) - self.foot.place) / rings.radius;
        let places: Vec<Vector3<f64>> = self.order[..second].iter().map(place).collect();
        let values = self.averaged(second, passes);
        if values.iter().any(|h| !h.is_finite()) {
            return None;
        }
        let (model, scatter) = Linear::fit(&places[inner..], &values[inner..]);
        let off: Vec<f64> = places
            .iter()
            .zip(&values)
            .map(|(x, value)| (value - model.at(x)).abs())
            .collect();
        let peak = quantile(&off[..inner], 0.95);
        let top = off[..inner].iter().copied().fold(0.0, f64::max);
        let scatters = [
            model.scatter(&places[inner..first], &values[inner..first]),
            model.scatter(&places[first..], &values[first..]),
        ];
        let least = (OFF * scatter).max(OF_PEAK * top);
        let stray =
            off[inner..first].iter().filter(|&&off| off > least).count() as f64 / (first - inner) as f64;
        let is_calm = peak > PEAK * scatter
            && scatters[0] <= CALM * scatters[1].max(OF_PEAK * top / OFF)
            && stray < STRAY;
        is_calm.then(|| Calm {
            off,
            peak,
            top,
            surroundings: median(&values[inner..]),
            scatter,
            stray,
        })
    }

    /// What departs and hangs together with the seed; None if that reaches into the rings.
    fn extent(&self, rings: &Rings, scales: &[Calm]) -> Option<(Bump, Vec<bool>)> {
        let count = self.distance.len();
        let disk = &self.order[..rings.ends[1]];
        let mut departs = vec![false; count];
        // What is sharp shows without averaging, what is gentle with; which spreads it, and so is done no more than is needed.
        let needed = scales.iter().position(|calm| !calm.hides_flanks());
        for calm in &scales[..needed.map_or(scales.len(), |last| last + 1)] {
            for (&v, &off) in disk.iter().zip(&calm.off) {
                departs[v as usize] |= off > calm.least();
            }
        }
        let mut joined = departs.clone();
        for _ in 0..BETWEEN {
            joined = self.widened(&joined);
        }
        // The seed may lie where the curvature is by chance that of the surroundings.
        let first = disk.iter().copied().find(|&v| joined[v as usize]);
        let none = vec![false; count];
        let around = |v| self.mesh.around(v);
        let mut bump = first.map_or(none.clone(), |v| {
            spread::flood(none, vec![v], around, |_, w| joined[w as usize])
        });
        let is_far = |v: usize| self.distance[v] > WITHIN * rings.radius;
        let (members, far) = (0..count)
            .filter(|&v| bump[v] && departs[v])
            .fold((0, 0), |(all, far), v| (all + 1, far + usize::from(is_far(v))));
        if far as f64 > STRAGGLERS * members as f64 {
            return None;
        }
        // One ring more than departs: the curvature at a vertex is that of its ring, too.
        bump = self.narrowed(&bump);
        if scales.iter().all(Calm::hides_flanks) {
            let reach = (0..count).filter(|&v| bump[v]).map(|v| self.distance[v]);
            let margin = MARGIN * reach.fold(0.0, f64::max) / self.edge();
            for _ in 0..margin.round() as usize {
                bump = self.widened(&bump);
            }
        }
        // What it encloses belongs to it.
        let beyond = self.distance.iter().map(|&d| d >= RING * rings.radius).collect();
        let front = self.order[rings.ends[1]..].to_vec();
        let outside = spread::flood(beyond, front, around, |_, w| !bump[w as usize]);
        let region = spread::whole(self.mesh, |v| {
            !outside[v as usize] && self.distance[v as usize].is_finite()
        });
        let corners = self
            .mesh
            .triangles
            .iter()
            .zip(&region)
            .filter(|(_, is_in)| **is_in);
        let radius = corners.flat_map(|(t, _)| t).map(|&v| self.distance[v as usize]);
        let calm = &scales[0];
        let found = Bump {
            radius: radius.fold(0.0, f64::max),
            triangles: region.iter().filter(|&&is_in| is_in).count(),
            departure: calm.peak,
            surroundings: calm.surroundings,
            scatter: calm.scatter,
        };
        Some((found, region))
    }

    fn widened(&self, is_in: &[bool]) -> Vec<bool> {
        let near = |v: u32| is_in[v as usize] || self.mesh.around(v).any(|w| is_in[w as usize]);
        (0..is_in.len() as u32).map(near).collect()
    }

    fn narrowed(&self, is_in: &[bool]) -> Vec<bool> {
        let inside = |v: u32| is_in[v as usize] && self.mesh.around(v).all(|w| is_in[w as usize]);
        (0..is_in.len() as u32).map(inside).collect()
    }
}
