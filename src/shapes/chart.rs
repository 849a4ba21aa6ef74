//! Planar (or periodic) triangulations: Delaunay, then the free region with its rings around it.

use delaunator::{Point, triangulate};

/// Rings of fixed triangles around the free region unless there is a reason for another number.
pub const OUTSIDE: usize = 4;

/// The most rings of fixed triangles a generator makes.
pub(super) const MOST_OUTSIDE: usize = 16;

/// A triangulated piece of the parameter plane.
pub(super) struct Chart<P> {
    pub(super) points: Vec<P>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) free: Vec<bool>,
}

/// Delaunay triangles, counter-clockwise.
pub(super) fn delaunay(points: &[[f64; 2]]) -> Vec<[u32; 3]> {
    let plane: Vec<Point> = points.iter().map(|p| Point { x: p[0], y: p[1] }).collect();
    let corners = triangulate(&plane).triangles;
    corners
        .chunks_exact(3)
        .filter_map(|t| counter_clockwise(points, [t[0], t[1], t[2]]))
        .collect()
}

/// Delaunay triangles of points whose first coordinate is periodic and lies in [0, period).
///
/// The strips of width `overlap` at both ends are repeated beyond the other end. Of the copies of a
/// triangle across the seam the one is taken whose vertex of smallest index is in [0, period): a rule in
/// integers, so that rounding can neither lose a triangle nor take one twice.
pub(super) fn delaunay_periodic(points: &[[f64; 2]], period: f64, overlap: f64) -> Vec<[u32; 3]> {
    let n = points.len();
    let mut all = points.to_vec();
    let mut source: Vec<u32> = (0..n as u32).collect();
    for (i, p) in points.iter().enumerate() {
        for (near, shift) in [(p[0] < overlap, period), (p[0] > period - overlap, -period)] {
            if near {
                all.push([p[0] + shift, p[1]]);
                source.push(i as u32);
            }
        }
    }
    let owned = |t: &[u32; 3]| {
        let smallest = *t.iter().min_by_key(|&&v| source[v as usize]).unwrap_or(&0);
        (smallest as usize) < n
    };
    delaunay(&all)
        .into_iter()
        .filter(owned)
        .map(|t| t.map(|v| source[v as usize]))
        .collect()
}

fn counter_clockwise(points: &[[f64; 2]], t: [usize; 3]) -> Option<[u32; 3]> {
    let [a, b, c] = t.map(|v| points[v]);
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let t = t.map(|v| v as u32);
    if area > 0.0 {
        Some(t)
    } else if area < 0.0 {
        Some([t[0], t[2], t[1]])
    } else {
        None
    }
}

const FAR: u32 = u32::MAX;

/// Keeps the triangles within `outside` rings around those that touch a free vertex, and drops the rest.
///
/// Where the jagged boundary of the kept triangles touches itself in a vertex (or encloses a lone triangle)
/// that vertex is counted one ring nearer; with no ring outside it becomes free.
pub(super) fn cut<P: Copy>(points: &[P], all: &[[u32; 3]], free: &[bool], outside: usize) -> Chart<P> {
    let outside = outside.min(MOST_OUTSIDE) as u32;
    let mut ring: Vec<u32> = free.iter().map(|&f| if f { 0 } else { FAR }).collect();
    for k in 0..=outside {
        grow(all, &mut ring, k);
    }
    while let Some(touching) = touching(all, &ring, outside) {
        touching.into_iter().for_each(|v| ring[v as usize] = outside);
        grow(all, &mut ring, outside);
    }
    let mut chart = Chart {
        points: Vec::new(),
        triangles: Vec::new(),
        free: Vec::new(),
    };
    let mut new = vec![FAR; points.len()];
    for v in 0..points.len() {
        if ring[v] != FAR {
            new[v] = chart.points.len() as u32;
            chart.points.push(points[v]);
            chart.free.push(ring[v] == 0);
        }
    }
    let kept = all.iter().filter(|t| nearest(&ring, t) <= outside);
    chart.triangles = kept.map(|t| t.map(|v| new[v as usize])).collect();
    chart
}

fn nearest(ring: &[u32], t: &[u32; 3]) -> u32 {
    t.map(|v| ring[v as usize]).into_iter().fold(FAR, u32::min)
}

/// Gives ring number k + 1 to the vertices of triangles that touch ring k.
fn grow(all: &[[u32; 3]], ring: &mut [u32], k: u32) {
    for t in all {
        if nearest(ring, t) == k {
            for &v in t {
                let r = &mut ring[v as usize];
                *r = (*r).min(k + 1);
            }
        }
    }
}

/// Boundary vertices that make the kept part pinched or perforated; `None` when there are none.
fn touching(all: &[[u32; 3]], ring: &[u32], outside: u32) -> Option<Vec<u32>> {
    let on_boundary = |v: u32| ring[v as usize] == outside + 1;
    let edges = |t: &[u32; 3]| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])];
    let mut run: Vec<(u32, u32)> = Vec::new();
    for t in all.iter().filter(|t| nearest(ring, t) <= outside) {
        run.extend(
            edges(t)
                .into_iter()
                .filter(|&(a, b)| on_boundary(a) && on_boundary(b)),
        );
    }
    run.sort_unstable();
    let boundary: Vec<(u32, u32)> = run
        .iter()
        .copied()
        .filter(|&(a, b)| run.binary_search(&(b, a)).is_err())
        .collect();
    let mut found: Vec<u32> = boundary
        .windows(2)
        .filter(|w| w[0].0 == w[1].0)
        .map(|w| w[0].0)
        .collect();
    for t in all
        .iter()
        .filter(|t| nearest(ring, t) == outside + 1 && t.iter().all(|&v| on_boundary(v)))
    {
        if edges(t)
            .into_iter()
            .all(|(a, b)| boundary.binary_search(&(b, a)).is_ok())
        {
            found.push(t[0]);
        }
    }
    found.dedup();
    (!found.is_empty()).then_some(found)
}
