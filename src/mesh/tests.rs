//! The region of a mesh: structure, invariants, and every error with its exact value.

use super::numbering::Numbering;
use super::{NONE, OutsideNeighbours, RegionMesh, Rings, Selection, decimate};
use crate::support::error::Error;
use fairmesh_shapes::{
    OUTSIDE, Sampling, Shape, cylinder_band, cylinder_blend, sphere_cap, tetra_thing_coarse,
};
use nalgebra::Vector3;
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// `n` by `n` vertices, vertex `n * y + x`, two triangles per cell.
fn grid(n: u32) -> Mesh {
    let positions = (0..n * n)
        .map(|v| [f64::from(v % n), f64::from(v / n), 0.0])
        .collect();
    let mut triangles = Vec::new();
    for y in 0..n - 1 {
        for x in 0..n - 1 {
            let v = n * y + x;
            triangles.push([v, v + 1, v + n + 1]);
            triangles.push([v, v + n + 1, v + n]);
        }
    }
    (positions, triangles)
}

/// Grid vertices at least `margin` away from the grid's boundary.
fn inner(n: u32, margin: u32) -> Vec<u32> {
    let inside = |x: u32| (margin..n - margin).contains(&x);
    (0..n * n).filter(|v| inside(v % n) && inside(v / n)).collect()
}

/// A sphere of `m` rings of `n` vertices with two poles, the poles last.
fn sphere(n: u32, m: u32) -> Mesh {
    let mut positions = Vec::new();
    for r in 0..m {
        for s in 0..n {
            let (theta, phi) = (
                std::f64::consts::PI * f64::from(r + 1) / f64::from(m + 1),
                std::f64::consts::TAU * f64::from(s) / f64::from(n),
            );
            positions.push([theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()]);
        }
    }
    positions.extend([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]);
    let (top, bottom) = (n * m, n * m + 1);
    let mut triangles = Vec::new();
    for s in 0..n {
        let t = (s + 1) % n;
        triangles.push([top, s, t]);
        triangles.push([bottom, n * (m - 1) + t, n * (m - 1) + s]);
        for r in 0..m - 1 {
            triangles.push([n * r + s, n * (r + 1) + s, n * (r + 1) + t]);
            triangles.push([n * r + s, n * (r + 1) + t, n * r + t]);
        }
    }
    (positions, triangles)
}

/// A region that must be sound, with all invariants checked.
fn sound(mesh: &Mesh, selection: Selection<'_>) -> (RegionMesh, Rings) {
    let region = RegionMesh::new(&mesh.0, &mesh.1, selection).expect("a sound region");
    let rings = Rings::new(&region);
    check(mesh, &region, &rings);
    (region, rings)
}

fn check(mesh: &Mesh, region: &RegionMesh, rings: &Rings) {
    region.validate().expect("region");
    rings.validate(region).expect("rings");
    check_patterns(rings);
    check_rings(mesh, region, rings);
}

/// What lies around the vertices and edges of a mesh, found by searching all triangles; `bool`: in the region.
#[derive(Default)]
struct Searched {
    /// The third vertices of the triangles at an edge.
    sharing: BTreeMap<[u32; 2], Vec<(u32, bool)>>,
    /// The edges opposite to a vertex.
    link: BTreeMap<u32, BTreeMap<[u32; 2], bool>>,
}

impl Searched {
    fn new(mesh: &Mesh, region: &RegionMesh) -> Self {
        let of_region = &region.half_edges.triangle_ids[..region.half_edges.region_triangles];
        let of_region: BTreeSet<u32> = of_region.iter().copied().collect();
        let mut searched = Self::default();
        for (t, &[a, b, c]) in (0..).zip(&mesh.1) {
            if a == b || b == c || c == a {
                continue;
            }
            let inside = of_region.contains(&t);
            assert!(
                inside || [a, b, c].iter().all(|v| !free_ids(region).contains(v)),
                "{t}"
            );
            for [u, v, w] in [[a, b, c], [b, c, a], [c, a, b]] {
                let edge = [u.min(v), u.max(v)];
                searched.sharing.entry(edge).or_default().push((w, inside));
                searched.link.entry(w).or_default().insert([u, v], inside);
            }
        }
        searched
    }

    /// The edges opposite to a vertex, of triangles on one side.
    fn link_on_side(&self, v: u32, inside: bool) -> BTreeSet<[u32; 2]> {
        let edges = self.link[&v].iter().filter(|e| *e.1 == inside);
        edges.map(|e| *e.0).collect()
    }

    /// The third vertex of the only other triangle at an edge of a triangle at `v`, if that is in the region.
    fn flap(&self, mesh: &Mesh, v: u32, [a, b]: [u32; 2]) -> u32 {
        let sharing = self.sharing[&[a.min(b), a.max(b)]].iter();
        let others: Vec<_> = sharing.filter(|s| s.0 != v).collect();
        match others[..] {
            [&(w, true)] if mesh.0[w as usize].iter().all(|x| x.is_finite()) => w,
            _ => NONE,
        }
    }
}

/// Rings, fans and flaps against their definitions, by searching the whole mesh.
fn check_rings(mesh: &Mesh, region: &RegionMesh, rings: &Rings) {
    let id = |v: u32| match v {
        NONE => NONE,
        _ => region.vertex_ids[v as usize],
    };
    let searched = Searched::new(mesh, region);
    for i in 0..region.free {
        let (v, ring) = (id(i as u32), rings.ring(i));
        let edges: Vec<_> = (0..ring.len())
            .map(|k| [id(ring[k]), id(ring[(k + 1) % ring.len()])])
            .collect();
        assert_eq!(
            searched.link[&v].keys().copied().collect::<BTreeSet<_>>(),
            edges.iter().copied().collect()
        );
        for (k, &edge) in edges.iter().enumerate() {
            let flap = rings.flap[rings.neighbour.range(i).start + k];
            assert_eq!(id(flap), searched.flap(mesh, v, edge));
        }
    }
    for b in 0..region.boundary {
        let v = id((region.free + b) as u32);
        let inside: BTreeSet<_> = rings.boundary_triangles(b).iter().map(|t| t.map(id)).collect();
        let outside: BTreeSet<_> = rings.outside_triangles(b).iter().map(|t| t.map(id)).collect();
        assert_eq!(inside, searched.link_on_side(v, true));
        assert_eq!(outside, searched.link_on_side(v, false));
        assert_eq!(
            inside.iter().flatten().copied().collect::<BTreeSet<_>>(),
            rings.boundary_ring(b).iter().map(|&j| id(j)).collect()
        );
    }
}

/// Whether `free` has a sound region by the definitions. All positions are taken to be finite.
fn is_sound(triangles: &[[u32; 3]], free: &BTreeSet<u32>) -> bool {
    let touches = |t: &[u32; 3], set: &BTreeSet<u32>| t.iter().any(|v| set.contains(v));
    let inside: Vec<_> = triangles.iter().filter(|t| touches(t, free)).collect();
    let vertices: BTreeSet<u32> = inside.iter().flat_map(|t| **t).collect();
    let part: Vec<_> = triangles.iter().filter(|t| touches(t, &vertices)).collect();
    let proper = part.iter().all(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
    let corners: BTreeSet<_> = part.iter().map(|t| BTreeSet::from(**t)).collect();
    let directed: BTreeSet<_> = part
        .iter()
        .flat_map(|&&[a, b, c]| [[a, b], [b, c], [c, a]])
        .collect();
    if free.is_empty()
        || !free.is_subset(&vertices)
        || !proper
        || corners.len() != part.len()
        || directed.len() != 3 * part.len()
    {
        return false;
    }
    let one_fan = |v: &u32| {
        let links: BTreeMap<u32, u32> = part
            .iter()
            .flat_map(|&&[a, b, c]| [(a, b, c), (b, c, a), (c, a, b)])
            .filter_map(|(o, a, b)| (o == *v).then_some((a, b)))
            .collect();
        let ends: BTreeSet<u32> = links.values().copied().collect();
        let start = links
            .keys()
            .find(|a| !ends.contains(a))
            .or(links.keys().next())
            .copied();
        let mut at = start;
        let mut length = 0;
        while let Some(&b) = at.and_then(|a| links.get(&a)) {
            length += 1;
            at = (Some(b) != start).then_some(b);
        }
        length == links.len() && (at.is_none() || !free.contains(v))
    };
    let has_fixed = |v: &u32| {
        let mut reached = BTreeSet::from([*v]);
        for _ in 0..vertices.len() {
            let more: Vec<u32> = inside
                .iter()
                .filter(|t| touches(t, &reached))
                .flat_map(|t| **t)
                .collect();
            reached.extend(more);
        }
        !reached.is_subset(free)
    };
    vertices.iter().all(one_fan) && free.iter().all(has_fixed)
}

/// The free vertices of a selection of faces, by definition.
fn enclosed(triangles: &[[u32; 3]], faces: &[u32]) -> BTreeSet<u32> {
    let chosen = |t: usize| faces.contains(&(t as u32));
    let all = |v: &u32| {
        triangles
            .iter()
            .enumerate()
            .all(|(t, tri)| chosen(t) || !tri.contains(v))
    };
    let count = |a, b| {
        triangles
            .iter()
            .filter(|t| t.contains(&a) && t.contains(&b))
            .count()
    };
    let inner = |v: &u32| {
        let at_v = triangles.iter().filter(|t| t.contains(v));
        at_v.flatten().all(|w| w == v || count(*v, *w) > 1)
    };
    faces
        .iter()
        .flat_map(|&t| triangles[t as usize])
        .filter(|v| all(v) && inner(v))
        .collect()
}

/// The two patterns against their definitions, by brute force.
fn check_patterns(rings: &Rings) {
    let free = rings.free();
    let own = |v: usize| {
        rings
            .neighbours(v)
            .iter()
            .copied()
            .filter(|&j| (j as usize) < free)
    };
    let (graph, two) = (rings.graph(), rings.two_ring_pattern());
    assert_eq!((graph.order(), two.order()), (free, free));
    for i in 0..free {
        let mut near: BTreeSet<u32> = own(i).collect();
        near.insert(i as u32);
        let mut far = near.clone();
        rings.ring(i).iter().for_each(|&k| far.extend(own(k as usize)));
        let lower = |s: BTreeSet<u32>| s.into_iter().filter(|&j| j as usize <= i).collect::<Vec<_>>();
        assert_eq!(graph.row(i), lower(near));
        assert_eq!(two.row(i), lower(far));
    }
}

fn error(mesh: &Mesh, selection: Selection<'_>) -> Error {
    RegionMesh::new(&mesh.0, &mesh.1, selection).expect_err("a flaw")
}

/// The free vertices of a region, as the caller numbers them.
fn free_ids(region: &RegionMesh) -> &[u32] {
    &region.vertex_ids[..region.free]
}

/// A wheel of `n` triangles around vertex 0, and a row of quads around it.
fn hub(n: u32) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let at = |k: u32, r: f64| {
        let a = std::f64::consts::TAU * f64::from(k) / f64::from(n);
        [r * a.cos(), r * a.sin(), 0.0]
    };
    let mut x = vec![[0.0; 3]];
    x.extend((0..n).map(|k| at(k, 1.0)));
    x.extend((0..n).map(|k| at(k, 2.0)));
    let quads = (0..n).flat_map(|k| {
        let (a, b) = (1 + k, 1 + (k + 1) % n);
        [[0, a, b], [a, a + n, b + n], [a, b + n, b]]
    });
    (x, quads.collect())
}

#[test]
fn a_hub_of_more_triangles_than_the_matrix_can_hold_is_refused() {
    for n in [5_000, 20_000] {
        let (x, t) = hub(n);
        let all: Vec<u32> = (0..=n).collect();
        let refused = Err(Error::ValenceTooLarge {
            vertex: 0,
            valence: n as usize,
        });
        for free in [&all[..], &all[1..]] {
            let region = RegionMesh::new(&x, &t, Selection::Vertices(free));
            assert_eq!(region.map(|r| r.free), refused);
        }
        // A fixed hub counts with its region triangles only.
        let region = RegionMesh::new(&x, &t, Selection::Vertices(&all[1..500])).unwrap();
        assert_eq!(region.free, 499);
    }
}

#[test]
fn one_free_vertex_in_a_grid() {
    let mesh = grid(5);
    let (region, rings) = sound(&mesh, Selection::Vertices(&[12, 12]));
    assert_eq!(region.vertex_ids[..7], [12, 6, 7, 11, 13, 17, 18]);
    assert_eq!((region.free, region.boundary, region.components), (1, 6, 1));
    assert_eq!(region.half_edges.triangle_ids[..6], [10, 11, 13, 18, 20, 21]);
    // Counter-clockwise from the smallest: 6, 7, 13, 18, 17, 11.
    assert_eq!(rings.ring(0), [1, 2, 4, 6, 5, 3]);
    assert_eq!(rings.flap, [NONE; 6]);
    assert_eq!(rings.twin, [NONE; 6]);
    assert_eq!(rings.boundary_half_edges.len(), 6);
    // All 32 triangles but four in each of the two corners away from the diagonal, which touch no boundary
    // vertex.
    assert_eq!(region.half_edges.triangles.len(), 24);
    // Vertex 6: two region triangles; outside it has four and a fan of five neighbours.
    let caller = |v: &[u32]| {
        v.iter()
            .map(|&v| region.vertex_ids[v as usize])
            .collect::<Vec<_>>()
    };
    assert_eq!(caller(rings.boundary_ring(0)), [7, 12, 11]);
    let outside: Vec<_> = rings.outside_triangles(0).iter().map(|e| caller(e)).collect();
    assert_eq!(outside, [[11, 5], [5, 0], [0, 1], [1, 7]]);
    assert_eq!(caller(&rings.boundary_triangles(0)[0]), [7, 12]);
    assert_all!(rings.closed.iter(), |c| !c);
}

#[test]
fn surroundings_are_three_rings_of_neighbours() {
    let mesh = grid(13);
    let (region, _) = sound(&mesh, Selection::Vertices(&[84]));
    let surroundings = OutsideNeighbours::new(&region);
    // By the definition: breadth first along the edges of triangles that are not of the region.
    let outside: Vec<_> = mesh.1.iter().filter(|t| !t.contains(&84)).collect();
    let mut found = Vec::new();
    for b in region.free..region.region_vertices() {
        let ends = surroundings.rings::<3>(b as u32, &mut found);
        let mut wanted = BTreeSet::from([region.vertex_ids[b]]);
        for end in ends {
            let at = |t: &&&[u32; 3]| t.iter().any(|v| wanted.contains(v));
            let next: BTreeSet<u32> = outside.iter().filter(at).flat_map(|t| **t).collect();
            wanted.extend(next);
            let ids: BTreeSet<u32> = found[..end]
                .iter()
                .map(|&v| region.vertex_ids[v as usize])
                .collect();
            assert_eq!(ids.len(), end);
            assert_eq!(
                ids,
                wanted
                    .iter()
                    .copied()
                    .filter(|&v| v != region.vertex_ids[b])
                    .collect()
            );
        }
    }
}

#[test]
fn broken_surroundings_are_left_out() {
    let mut mesh = grid(13);
    let all = |mesh: &Mesh| {
        let (region, _) = sound(mesh, Selection::Vertices(&[84]));
        let mut found = Vec::new();
        OutsideNeighbours::new(&region).rings::<3>(region.free as u32, &mut found);
        found
            .iter()
            .map(|&v| region.vertex_ids[v as usize])
            .collect::<BTreeSet<u32>>()
    };
    let before = all(&mesh);
    // Two rings from boundary vertex 70: without a place, in a triangle that is none, and in one too many.
    assert_contains!(before, &42);
    assert_contains!(before, &43);
    assert_contains!(before, &31);
    mesh.0[42][1] = f64::NAN;
    mesh.1.push([43, 43, 0]);
    mesh.1.push([43, 44, 168]);
    let after = all(&mesh);
    assert!(!after.contains(&42), "{after:?}");
    assert_contains!(after, &43);
    assert!(!after.contains(&0), "{after:?}");
    assert_contains!(after, &168);
}

#[test]
fn faces_free_what_they_enclose() {
    let mesh = grid(6);
    let all: Vec<u32> = (0..mesh.1.len() as u32).collect();
    let (region, _) = sound(&mesh, Selection::Faces(&all));
    assert_eq!(free_ids(&region), inner(6, 1));
    assert_eq!(region.half_edges.region_triangles, mesh.1.len() - 2);
    let around: Vec<u32> = all
        .iter()
        .copied()
        .filter(|&t| mesh.1[t as usize].contains(&14))
        .chain([0, 0])
        .collect();
    let (region, _) = sound(&mesh, Selection::Faces(&around));
    assert_eq!(free_ids(&region), [14]);
    assert_eq!(error(&mesh, Selection::Faces(&around[1..])), Error::EmptyRegion);
}

#[test]
fn mask_and_list_agree() {
    let mesh = grid(8);
    let list = inner(8, 2);
    let mask: Vec<bool> = (0..64).map(|v| list.contains(&v)).collect();
    let reversed: Vec<u32> = list.iter().rev().copied().collect();
    let (a, ra) = sound(&mesh, Selection::Mask(&mask));
    let (b, rb) = sound(&mesh, Selection::Vertices(&reversed));
    assert_eq!(a.vertex_ids, b.vertex_ids);
    assert_eq!(a.half_edges.opposite, b.half_edges.opposite);
    assert_eq!((ra.neighbour, ra.flap, ra.twin), (rb.neighbour, rb.flap, rb.twin));
}

#[test]
fn closed_fixed_vertex_inside_the_region() {
    let mesh = grid(9);
    let mut list = inner(9, 2);
    list.retain(|&v| v != 40);
    let (region, rings) = sound(&mesh, Selection::Vertices(&list));
    let at = region.vertex_ids.iter().position(|&v| v == 40).unwrap() - region.free;
    assert!(rings.closed[at]);
    assert_eq!(rings.closed.iter().filter(|c| **c).count(), 1);
    assert_eq!(rings.boundary_ring(at).len(), 6);
    assert_eq!(rings.boundary_triangles(at).len(), 6);
    assert_empty!(rings.outside_triangles(at));
    // V - E + F = 1 of the disc that is left.
    let faces = region.half_edges.region_triangles as i64;
    let edges = (3 * faces + rings.boundary_half_edges.len() as i64) / 2;
    assert_eq!(region.region_vertices() as i64 - edges + faces, 1);
}

#[test]
fn small_islands_belong_to_the_region() {
    let mesh = grid(11);
    // The centre of a hexagon and its corners, one after the other.
    let hexagon = [60, 48, 49, 61, 72, 71, 59];
    for count in 0..=7 {
        let fixed: Vec<u32> = hexagon.iter().copied().take(count).collect();
        let mut list = inner(11, 1);
        list.retain(|v| !fixed.contains(v));
        let (region, rings) = sound(&mesh, Selection::Vertices(&list));
        let closed = rings.closed.iter().filter(|c| **c).count();
        // From seven vertices on there is something that a normal can be fitted to.
        let island = count < 7;
        assert_eq!(closed, if island { count } else { 0 }, "{count} vertices");
        let fixed_triangles = region
            .triangles()
            .iter()
            .filter(|t| t.iter().all(|&v| !region.is_free(v)));
        // The two corners of the grid have triangles that no free vertex touches.
        let among = mesh
            .1
            .iter()
            .filter(|t| t.iter().all(|v| fixed.contains(v)))
            .count();
        assert_eq!(fixed_triangles.count(), if island { among } else { 0 });
        assert_eq!(among > 0, count > 2);
    }
}

/// Cuts along a curve with prescribed normals, however it begins and ends.
#[test]
fn curves_with_prescribed_normals_are_cut() {
    let n = 13;
    let mesh = grid(n);
    let at = |i: u32, j: u32| j * 13 + i;
    let row = |first: u32, last: u32| (first..=last).map(|i| at(i, 6)).collect::<Vec<_>>();
    // With the copies that come, and the edges that are cut.
    let lines = [
        // Inside from end to end, from the boundary inwards, from boundary to boundary.
        (row(5, 7), 1, 2),
        (row(4, 7), 2, 3),
        (row(4, 8), 3, 4),
        // A hexagon around a free vertex.
        (
            [(5, 5), (6, 5), (7, 6), (7, 7), (6, 7), (5, 6)]
                .map(|(i, j)| at(i, j))
                .to_vec(),
            6,
            6,
        ),
        (vec![at(6, 6)], 0, 0),
    ];
    for (line, added, edges) in lines {
        let mut list = inner(n, 4);
        list.retain(|v| !line.contains(v));
        let (whole, _) = sound(&mesh, Selection::Vertices(&list));
        let boundary: Vec<u32> = whole.vertex_ids[whole.free..whole.region_vertices()].to_vec();
        // All boundary vertices have normals, those on the outer boundary too.
        let region = RegionMesh::with_normals(&mesh.0, &mesh.1, Selection::Vertices(&list), |v| {
            boundary.contains(&v)
        })
        .unwrap();
        region.validate().unwrap();
        let rings = Rings::new(&region);
        rings.validate(&region).unwrap();
        assert_eq!(region.boundary, whole.boundary + added, "{line:?}");
        assert_eq!(region.triangles().len(), whole.triangles().len());
        let back = |t: &[u32; 3]| t.map(|v| region.vertex_ids[v as usize]);
        let before: Vec<_> = whole
            .triangles()
            .iter()
            .map(|t| t.map(|v| whole.vertex_ids[v as usize]))
            .collect();
        assert_eq!(region.triangles().iter().map(back).collect::<Vec<_>>(), before);
        let cut = rings.boundary_half_edges.len() - Rings::new(&whole).boundary_half_edges.len();
        assert_eq!(cut, 2 * edges, "{line:?}");
    }
}

#[test]
fn islands_at_the_boundary_of_the_mesh_stay_outside() {
    // The grid's corner triangles have fixed vertices only, but edges without a neighbour.
    let mesh = grid(6);
    let (region, _) = sound(&mesh, Selection::Vertices(&inner(6, 1)));
    assert_eq!(region.half_edges.region_triangles, mesh.1.len() - 2);
}

#[test]
fn sphere_with_a_hole_and_sphere_with_one_fixed_vertex() {
    let mut mesh = sphere(12, 7);
    let top = 12 * 7;
    let all: Vec<u32> = (0..top + 2).filter(|&v| v != top).collect();
    let (region, rings) = sound(&mesh, Selection::Vertices(&all));
    assert_eq!((region.boundary, rings.closed.as_slice()), (1, &[true][..]));
    assert_empty!(rings.boundary_half_edges);
    let faces = mesh.1.len() as i64;
    assert_eq!(region.region_vertices() as i64 - faces / 2, 2);
    // Now a hole in place of the pole: its boundary is fixed and has no outside.
    mesh.1.retain(|t| !t.contains(&top));
    let all: Vec<u32> = (12..top).chain([top + 1]).collect();
    let (region, rings) = sound(&mesh, Selection::Vertices(&all));
    assert_eq!(region.boundary, 12);
    assert_eq!(rings.boundary_half_edges.len(), 12);
    let boundary_opposite = |h: &u32| region.half_edges.opposite[*h as usize];
    assert_all!(rings.boundary_half_edges.iter(), |h| boundary_opposite(h) == NONE);
    assert_empty!(rings.outside_triangle.values());
}

#[test]
fn components_join_along_edges_only() {
    let mesh = grid(12);
    let (region, _) = sound(&mesh, Selection::Vertices(&[26, 116, 117]));
    assert_eq!(
        (region.component.as_slice(), region.components),
        (&[0, 1, 1][..], 2)
    );
    // (2, 2) and (4, 4) have the fixed vertex (3, 3) in common, which then has two region fans.
    let (region, rings) = sound(&mesh, Selection::Vertices(&[26, 52]));
    assert_eq!(region.components, 2);
    let at = region.vertex_ids.iter().position(|&v| v == 39).unwrap() - region.free;
    assert_eq!((rings.boundary_ring(at).len(), rings.closed[at]), (6, false));
    assert_eq!(rings.boundary_triangles(at).len(), 4);
    assert_eq!(rings.outside_triangles(at).len(), 2);
    // The common boundary vertex connects the two in S_I D S_I^T, though they are no neighbours.
    assert_eq!(rings.two_ring_pattern().row(1), [0, 1]);
    assert_eq!(rings.graph().row(1), [1]);
}

/// Around an island and around fixed vertices inside, all belongs together, unless they have normals.
#[test]
fn components_join_around_fixed_vertices_inside() {
    let mesh = grid(13);
    let count = |fixed: &[u32], given: &[u32]| {
        let mut list = inner(13, 2);
        list.retain(|v| !fixed.contains(v));
        let region = RegionMesh::with_normals(&mesh.0, &mesh.1, Selection::Vertices(&list), |v| {
            given.contains(&v)
        });
        region.unwrap().components
    };
    // A column that ends at the boundary; its outermost vertices are not inside.
    let column: Vec<u32> = (1..12).map(|y| 13 * y + 6).collect();
    assert_eq!(count(&column, &[]), 1);
    assert_eq!(count(&column, &column), 2);
    // One vertex of it without a normal.
    assert_eq!(count(&column, &column[..6]), 1);
    // A ring around the vertex (6, 6), and around the island of (6, 6), (7, 6) and (7, 7).
    let ring = [
        5 * 13 + 5,
        5 * 13 + 6,
        6 * 13 + 7,
        7 * 13 + 7,
        7 * 13 + 6,
        6 * 13 + 5,
    ];
    assert_eq!(count(&ring, &[]), 1);
    assert_eq!(count(&ring, &ring), 2);
    let island = [6 * 13 + 6, 6 * 13 + 7, 7 * 13 + 7];
    assert_eq!(count(&island, &[]), 1);
    assert_eq!(count(&island, &island), 1);
}

/// Far from the origin the surroundings reach further.
#[test]
fn regions_of_components_far_from_the_origin() {
    let mut mesh = grid(24);
    for p in &mut mesh.0 {
        *p = p.map(|c| f64::from((1e4 + 0.001 * c) as f32));
    }
    let list = [24 * 11 + 11, 24 * 11 + 12, 24 * 14 + 15];
    let regions = agree_alone(&mesh, &list, |_| false);
    assert_eq!(regions.len(), 2);
    assert_all!(regions.iter(), |r| r.is_rounded);
}

/// The regions of components, each of which is that of its free vertices alone.
fn agree_alone(mesh: &Mesh, list: &[u32], given: impl Fn(u32) -> bool) -> Vec<RegionMesh> {
    agree_alone_numbered(mesh, list, &given, Numbering::BreadthFirst);
    agree_alone_numbered(mesh, list, &given, Numbering::AsGiven)
}

fn agree_alone_numbered(
    mesh: &Mesh,
    list: &[u32],
    given: impl Fn(u32) -> bool,
    numbering: Numbering,
) -> Vec<RegionMesh> {
    let list_of = |list| Selection::Vertices(list);
    let regions =
        RegionMesh::of_components(&mesh.0, &mesh.1, list_of(list), &given, (numbering, false)).unwrap();
    let mut free: Vec<u32> = Vec::new();
    for region in &regions {
        assert_eq!(region.components, 1);
        let own = free_ids(region);
        let alone = RegionMesh::numbered(&mesh.0, &mesh.1, list_of(own), &given, (numbering, false)).unwrap();
        alone.validate().unwrap();
        // All but what the others move.
        let mut here = region.clone();
        here.moves_elsewhere.clone_from(&alone.moves_elsewhere);
        assert!(format!("{here:?}") == format!("{alone:?}"), "{own:?}");
        free.extend(own);
    }
    free.sort_unstable();
    let mut asked = list.to_vec();
    asked.sort_unstable();
    assert_eq!(free, asked);
    assert!(regions.is_sorted_by_key(RegionMesh::first_free));
    regions
}

#[test]
fn annulus() {
    let mesh = grid(13);
    let mut list = inner(13, 2);
    let hole = inner(13, 5);
    list.retain(|v| !hole.contains(v));
    let (region, rings) = sound(&mesh, Selection::Vertices(&list));
    let faces = region.half_edges.region_triangles as i64;
    let edges = (3 * faces + rings.boundary_half_edges.len() as i64) / 2;
    assert_eq!(region.region_vertices() as i64 - edges + faces, 0);
    assert_eq!(region.components, 1);
    assert_all!(rings.closed.iter(), |c| !c);
}

#[test]
fn corners_of_valence_two_on_a_boundary_are_outside() {
    // A fan around vertex 0 with nothing outside: every boundary vertex has one triangle left and one right.
    let positions = vec![
        [0.0; 3],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [-1.0, -1.0, 0.0],
        [2.0, 2.0, 0.0],
    ];
    let mut mesh = (positions, vec![[0, 1, 2], [0, 2, 3], [0, 3, 1]]);
    let (_, rings) = sound(&mesh, Selection::Vertices(&[0]));
    assert_eq!(rings.boundary_triangle.values().len(), 6);
    assert_eq!(rings.outside_triangle.values().len(), 0);
    // A tooth: vertex 4 has only the triangle over the boundary edge (1, 2). No corner of it is free, so it is no
    // region triangle, and vertex 4 no boundary vertex.
    mesh.1.push([2, 1, 4]);
    for selection in [Selection::Vertices(&[0]), Selection::Faces(&[0, 1, 2, 3])] {
        let (region, rings) = sound(&mesh, selection);
        assert_eq!((region.half_edges.region_triangles, region.boundary), (3, 3));
        assert_eq!(rings.outside_triangle.values(), [[4, 2], [1, 4]]);
    }
}

#[test]
fn renumbering_gives_the_isomorphic_structure() {
    let mesh = grid(9);
    let list = inner(9, 2);
    // 32 and 81 are coprime, as are 37 and 128.
    let vertex = |v: u32| (v * 32 + 5) % 81;
    let mut other: Mesh = (vec![[0.0; 3]; 81], vec![[0; 3]; 128]);
    (0..81).for_each(|v| other.0[vertex(v) as usize] = mesh.0[v as usize]);
    for (t, tri) in mesh.1.iter().enumerate() {
        let [a, b, c] = tri.map(vertex);
        other.1[(t * 37 + 11) % 128] = [[a, b, c], [b, c, a], [c, a, b]][t % 3];
    }
    let moved: Vec<u32> = list.iter().map(|&v| vertex(v)).collect();
    let (a, ra) = sound(&mesh, Selection::Vertices(&list));
    let (b, rb) = sound(&other, Selection::Vertices(&moved));
    assert_eq!(
        (a.free, a.boundary, a.components),
        (b.free, b.boundary, b.components)
    );
    assert_eq!(a.vertex_ids.len(), b.vertex_ids.len());
    let local = |v: u32| b.vertex_ids.iter().position(|&w| w == vertex(v)).unwrap();
    let flap_id = |region: &RegionMesh, f: u32| {
        if f == NONE {
            NONE
        } else {
            region.vertex_ids[f as usize]
        }
    };
    for i in 0..a.region_vertices() {
        let j = local(a.vertex_ids[i]);
        let mut left: Vec<_> = ra
            .neighbours(i)
            .iter()
            .map(|&k| vertex(a.vertex_ids[k as usize]))
            .collect();
        let right: Vec<_> = rb
            .neighbours(j)
            .iter()
            .map(|&k| b.vertex_ids[k as usize])
            .collect();
        if i < a.free {
            let begin = left.iter().position(|&k| k == right[0]).unwrap();
            left.rotate_left(begin);
            let mut flaps: Vec<_> = ra.flap[ra.neighbour.range(i)].to_vec();
            flaps.rotate_left(begin);
            let flaps: Vec<_> = flaps.iter().map(|&f| flap_id(&a, f)).collect();
            let flaps: Vec<_> = flaps
                .iter()
                .map(|&f| if f == NONE { f } else { vertex(f) })
                .collect();
            let same = &rb.flap[rb.neighbour.range(j)];
            assert_eq!(flaps, same.iter().map(|&f| flap_id(&b, f)).collect::<Vec<_>>());
        }
        assert_eq!(left, right);
    }
}

#[test]
fn flaws_far_away_are_harmless() {
    let mut mesh = grid(20);
    let list = [105u32, 106, 125];
    let (clean, _) = sound(&mesh, Selection::Vertices(&list));
    mesh.0[399] = [f64::NAN; 3];
    mesh.1.push([379, 398, 5]); // a third triangle on an edge
    mesh.1.push(mesh.1[700]); // a duplicate
    mesh.1.push([390, 390, 391]); // a repeated index
    mesh.1[650].swap(0, 1); // flipped
    mesh.1.push([300, 19, 280]); // bow-ties
    let (region, _) = sound(&mesh, Selection::Vertices(&list));
    assert_eq!(region.vertex_ids, clean.vertex_ids);
    assert_eq!(region.half_edges.opposite, clean.half_edges.opposite);
}

#[test]
fn triangles_without_area_are_legal() {
    let mut mesh = grid(7);
    mesh.0.iter_mut().for_each(|p| *p = [1.0, 2.0, 3.0]);
    sound(&mesh, Selection::Vertices(&inner(7, 2)));
}

// ---- errors ---------------------------------------------------------------------------------------------

#[test]
fn selection_errors() {
    let mesh = grid(4);
    let none = [false; 16];
    assert_eq!(
        error(&mesh, Selection::Mask(&none[1..])),
        Error::MaskLength {
            length: 15,
            count: 16
        }
    );
    assert_eq!(error(&mesh, Selection::Mask(&none)), Error::EmptyRegion);
    assert_eq!(error(&mesh, Selection::Vertices(&[])), Error::EmptyRegion);
    assert_eq!(error(&mesh, Selection::Faces(&[0])), Error::EmptyRegion);
    let out = Error::SelectionOutOfRange { index: 16, count: 16 };
    assert_eq!(error(&mesh, Selection::Vertices(&[5, 99, 16])), out);
    let out = Error::SelectionOutOfRange { index: 18, count: 18 };
    assert_eq!(error(&mesh, Selection::Faces(&[u32::MAX, 18])), out);
    assert_eq!(error(&(vec![], vec![]), Selection::Mask(&[])), Error::EmptyRegion);
}

#[test]
fn an_index_out_of_range_is_found_anywhere() {
    let mut mesh = grid(20);
    mesh.1[700][1] = 400;
    mesh.1[701][1] = 777;
    let expected = Error::IndexOutOfRange {
        triangle: 700,
        index: 400,
        vertex_count: 400,
    };
    assert_eq!(error(&mesh, Selection::Vertices(&[105])), expected);
    assert_eq!(error(&mesh, Selection::Faces(&[1])), expected);
}

#[test]
fn free_vertex_without_triangle() {
    let mut mesh = grid(5);
    mesh.0.extend([[0.0; 3]; 2]);
    let expected = Error::FreeVertexWithoutTriangle { vertex: 25 };
    assert_eq!(error(&mesh, Selection::Vertices(&[12, 26, 25])), expected);
}

#[test]
fn free_vertex_on_the_boundary_of_the_mesh() {
    let mesh = grid(5);
    let expected = Error::FreeVertexOnBoundary { vertex: 2 };
    assert_eq!(error(&mesh, Selection::Vertices(&[12, 7, 3, 2])), expected);
}

#[test]
fn not_finite() {
    // 44 is free, 34 boundary, 23 of the outside ring, the others elsewhere.
    for (vertex, harmful) in [(44, true), (34, true), (23, true), (0, false), (90, false)] {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut mesh = grid(10);
            mesh.0[vertex][2] = bad;
            let found = RegionMesh::new(&mesh.0, &mesh.1, Selection::Vertices(&[44])).err();
            assert_eq!(found, harmful.then_some(Error::NotFinite { vertex }));
        }
    }
}

#[test]
fn repeated_index() {
    let mut mesh = grid(6);
    mesh.1.push([14, 20, 14]);
    mesh.1.push([15, 15, 15]);
    let expected = Error::RepeatedIndex {
        triangle: 50,
        vertex: 14,
    };
    assert_eq!(error(&mesh, Selection::Vertices(&[14])), expected);
}

#[test]
fn duplicate_triangle() {
    let mut mesh = grid(6);
    // Whichever way it runs, a triangle with the same corners is a duplicate.
    let first = mesh.1.iter().position(|t| t.contains(&14)).unwrap();
    let [a, b, c] = mesh.1[first];
    for copy in [[b, c, a], [b, a, c]] {
        let mut mesh = mesh.clone();
        mesh.1.push(copy);
        let expected = Error::DuplicateTriangle {
            triangle: 50,
            other: first,
        };
        assert_eq!(error(&mesh, Selection::Vertices(&[14])), expected);
    }
    // A pillow: two triangles back to back.
    mesh = (vec![[0.0; 3]; 3], vec![[0, 1, 2], [2, 1, 0]]);
    let expected = Error::DuplicateTriangle {
        triangle: 1,
        other: 0,
    };
    assert_eq!(error(&mesh, Selection::Vertices(&[0])), expected);
}

#[test]
fn three_triangles_on_an_edge() {
    let mut mesh = grid(6);
    mesh.0.push([9.0; 3]);
    mesh.1.push([14, 15, 36]);
    let expected = Error::NonManifoldEdge {
        a: 14,
        b: 15,
        triangle: 50,
    };
    assert_eq!(error(&mesh, Selection::Vertices(&[14])), expected);
}

#[test]
fn flipped_triangle() {
    let mut mesh = grid(6);
    let flipped = mesh.1.iter().position(|t| *t == [14, 15, 21]).unwrap();
    mesh.1[flipped] = [15, 14, 21];
    let found = error(&mesh, Selection::Vertices(&[14]));
    let below = mesh.1.iter().position(|t| *t == [8, 15, 14]).unwrap();
    let expected = Error::InconsistentOrientation {
        a: 14,
        b: 15,
        triangle: flipped,
        other: below,
    };
    assert_eq!(found, expected);
}

#[test]
fn bow_ties() {
    // Two grids joined at one vertex, which is free or boundary.
    let (mut positions, mut triangles) = grid(5);
    let (p, t) = grid(5);
    positions.extend(p);
    triangles.extend(t.iter().map(|t| t.map(|v| if v == 12 { 12 } else { v + 25 })));
    let mesh = (positions, triangles);
    let expected = Error::NonManifoldVertex { vertex: 12 };
    assert_eq!(error(&mesh, Selection::Vertices(&[12])), expected);
    assert_eq!(error(&mesh, Selection::Vertices(&[13])), expected);
    // Two open fans at a boundary vertex.
    let mut mesh = grid(4);
    mesh.0.extend([[8.0; 3]; 2]);
    mesh.1.push([1, 16, 17]);
    let expected = Error::NonManifoldVertex { vertex: 1 };
    assert_eq!(error(&mesh, Selection::Vertices(&[5])), expected);
}

#[test]
fn nothing_fixed() {
    let mut mesh = sphere(6, 3);
    let all: Vec<u32> = (0..20).collect();
    assert_eq!(
        error(&mesh, Selection::Vertices(&all)),
        Error::NothingFixed { vertex: 0 }
    );
    // A second sphere, sound, before it.
    let (p, t) = sphere(6, 3);
    mesh.0.extend(p);
    mesh.1.extend(t.iter().map(|t| t.map(|v| v + 20)));
    let all: Vec<u32> = (1..40).collect();
    assert_eq!(
        error(&mesh, Selection::Vertices(&all)),
        Error::NothingFixed { vertex: 20 }
    );
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_selection_of_a_jittered_grid(
        n in 3u32..9,
        bits in prop::collection::vec(any::<bool>(), 128),
        dense in any::<bool>(),
        jitter in prop::collection::vec(-0.3f64..0.3, 64),
        kind in 0..3,
    ) {
        let mut mesh = grid(n);
        mesh.0.iter_mut().zip(&jitter).for_each(|(p, j)| { p[0] += j; p[2] -= j });
        let pick = |k: u32| bits[k as usize] || (dense && bits[(k as usize * 7 + 1) % 128]);
        let interior = |v: u32| (1..n - 1).contains(&(v % n)) && (1..n - 1).contains(&(v / n));
        let list: Vec<u32> = (0..n * n).filter(|&v| pick(v) && (kind == 0 || interior(v))).collect();
        let faces: Vec<u32> = (0..mesh.1.len() as u32).filter(|&t| pick(t)).collect();
        let selection = if kind == 2 { Selection::Faces(&faces) } else { Selection::Vertices(&list) };
        match RegionMesh::new(&mesh.0, &mesh.1, selection) {
            Ok(region) => check(&mesh, &region, &Rings::new(&region)),
            Err(Error::FreeVertexOnBoundary { .. }) => prop_assert_eq!(kind, 0),
            Err(found) => prop_assert_eq!(found, Error::EmptyRegion),
        }
    }

    /// Cuts never make a sound region unsound, whatever has normals.
    #[test]
    fn any_normals_of_any_selection(
        n in 5u32..11,
        bits in prop::collection::vec(any::<bool>(), 128),
        dense in any::<bool>(),
        most in any::<bool>(),
    ) {
        let mesh = grid(n);
        let pick = |k: u32| bits[(k as usize * 3) % 128] || (dense && bits[(k as usize * 7 + 1) % 128]);
        let given = |k: u32| bits[(k as usize * 5 + 3) % 128] || (most && bits[(k as usize * 11 + 2) % 128]);
        let list: Vec<u32> = inner(n, 1).into_iter().filter(|&v| pick(v)).collect();
        let Ok(whole) = RegionMesh::new(&mesh.0, &mesh.1, Selection::Vertices(&list)) else { return Ok(()) };
        for all in [false, true] {
            let region = RegionMesh::with_normals(&mesh.0, &mesh.1, Selection::Vertices(&list), |v| all || given(v));
            let region = region.map_err(|e| TestCaseError::fail(e.to_string()))?;
            prop_assert_eq!(region.validate(), Ok(()));
            prop_assert_eq!(Rings::new(&region).validate(&region), Ok(()));
            prop_assert_eq!(region.free, whole.free);
            prop_assert!(region.boundary >= whole.boundary);
            let mut ids = region.vertex_ids[region.free..region.region_vertices()].to_vec();
            ids.dedup();
            prop_assert_eq!(&ids[..], &whole.vertex_ids[whole.free..whole.region_vertices()]);
        }
    }

    /// The regions of components are those of their vertices alone, whatever is selected and has normals.
    #[test]
    fn any_selection_has_independent_components(
        n in 5u32..12,
        bits in prop::collection::vec(any::<bool>(), 128),
        dense in any::<bool>(),
        most in any::<bool>(),
    ) {
        let mesh = grid(n);
        let pick = |k: u32| bits[(k as usize * 3) % 128] || (dense && bits[(k as usize * 7 + 1) % 128]);
        let given = |k: u32| most && bits[(k as usize * 5 + 3) % 128];
        let list: Vec<u32> = inner(n, 1).into_iter().filter(|&v| pick(v)).collect();
        if !list.is_empty() {
            agree_alone(&mesh, &list, given);
        }
    }

    #[test]
    fn any_triangles_give_a_region_exactly_if_they_are_sound(
        triangles in prop::collection::vec(prop::array::uniform3(0u32..7), 1..16),
        free in prop::collection::vec(0u32..7, 1..5),
    ) {
        agrees(&triangles, Selection::Vertices(&free), &free.iter().copied().collect());
    }

    #[test]
    fn a_few_changed_triangles_of_a_sphere(
        changes in prop::collection::vec((0usize..40, 0usize..3, 0u32..20), 0..3),
        flips in prop::collection::vec(0usize..40, 0..2),
        removed in prop::collection::vec(0usize..30, 0..3),
        picks in prop::collection::vec(0u32..30, 1..30),
    ) {
        let (_, mut triangles) = sphere(6, 3);
        changes.iter().for_each(|&(t, k, v)| triangles[t % 36][k] = v);
        flips.iter().for_each(|&t| triangles[t % 36].swap(0, 1));
        for &t in &removed {
            triangles.swap_remove(t);
        }
        let vertices: Vec<u32> = picks.iter().map(|v| v % 20).collect();
        agrees(&triangles, Selection::Vertices(&vertices), &vertices.iter().copied().collect());
        let proper = triangles.iter().all(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
        if proper {
            let faces: Vec<u32> =
                (0..triangles.len() as u32).filter(|t| !picks.contains(t) || picks.len() < 9).collect();
            agrees(&triangles, Selection::Faces(&faces), &enclosed(&triangles, &faces));
        }
    }
}

/// A region is found exactly if it is sound by definition; then it has these free vertices.
fn agrees(triangles: &[[u32; 3]], selection: Selection<'_>, free: &BTreeSet<u32>) {
    let mesh = (vec![[0.0; 3]; 20], triangles.to_vec());
    match RegionMesh::new(&mesh.0, &mesh.1, selection) {
        Ok(region) => {
            assert!(is_sound(triangles, free));
            assert_eq!(free_ids(&region), free.iter().copied().collect::<Vec<_>>());
            check(&mesh, &region, &Rings::new(&region));
        }
        Err(found) => assert!(!is_sound(triangles, free), "{found}"),
    }
}

/// Shapes to be decimated.
fn hierarchy_cases() -> [(&'static str, Shape); 4] {
    let irregular = |seed| Sampling::Irregular { seed };
    [
        ("sphere", sphere_cap(60.0, 600, irregular(1), OUTSIDE)),
        ("cylinder", cylinder_band(600, irregular(2), OUTSIDE)),
        ("blend", cylinder_blend()),
        ("tetra thing", tetra_thing_coarse()),
    ]
}

/// The region of a shape and its positions.
fn region(shape: &Shape) -> (RegionMesh, Vec<Vector3<f64>>) {
    let region = RegionMesh::new(&shape.positions, &shape.triangles, Selection::Mask(&shape.free)).unwrap();
    let x = region.positions(&shape.positions);
    (region, x)
}

/// Down to the base and back up: valid after every collapse and every split, and the same triangles in the end, corner by
/// corner; no boundary vertex is ever collapsed.
#[test]
fn decimation_and_refinement() {
    for (name, shape) in hierarchy_cases() {
        let (region, x) = region(&shape);
        let count = region.region_vertices();
        let target = region.boundary * 2;
        let before: Vec<_> = decimate(&region, &x, count).mesh().triangles().collect();
        assert_eq!(before.len(), region.half_edges.triangles.len());
        // One vertex less each time: every mesh on the way down.
        let base = decimate(&region, &x, target);
        assert!(base.vertices() < count / 2, "{name}");
        let mut up = base.clone();
        let mut meshes = vec![];
        loop {
            up.mesh()
                .validate()
                .unwrap_or_else(|why| panic!("{name}, {} vertices: {why}", up.vertices()));
            let triangles: Vec<_> = up.mesh().triangles().collect();
            let named: BTreeSet<u32> = triangles.iter().flat_map(|t| t.1).collect();
            let boundary = region.free as u32..count as u32;
            assert!(
                boundary.clone().all(|b| named.contains(&b)),
                "{name}: a boundary vertex is gone"
            );
            assert_eq!(named.iter().filter(|v| **v < count as u32).count(), up.vertices());
            meshes.push(triangles);
            let Some(split) = up.refine() else { break };
            assert!(region.is_free(split.vertex), "{name}: {split:?}");
            assert!(
                !named.contains(&split.vertex) && named.contains(&split.parent),
                "{name}: {split:?}"
            );
        }
        assert_eq!(up.mesh().triangles().collect::<Vec<_>>(), before, "{name}");
        for k in [0, meshes.len() / 3, meshes.len() - 1] {
            // Stopped there on the way down, it is the same mesh as on the way up.
            let down = decimate(&region, &x, base.vertices() + k);
            down.mesh().validate().unwrap();
            assert_eq!(down.mesh().triangles().collect::<Vec<_>>(), meshes[k], "{name}");
            let level = down.region(&x).unwrap();
            level.validate().unwrap();
            assert_eq!(
                (level.region_vertices(), level.boundary),
                (down.vertices(), region.boundary)
            );
        }
    }
}

/// Not every mesh on the way down is the way up seen from the other end: each is checked as it is made.
#[test]
fn every_collapse_leaves_a_valid_mesh() {
    let (region, x) = region(&cylinder_blend());
    let count = region.region_vertices();
    for target in (region.boundary + 60..count).rev().step_by(7) {
        let mesh = decimate(&region, &x, target);
        assert_eq!(mesh.vertices(), target);
        mesh.mesh().validate().unwrap();
    }
}
