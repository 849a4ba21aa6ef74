//! Attributes carried over from a mesh as it was to faces that take the place of some of its own.

use std::collections::BTreeMap;

use fairmesh::Carried;

use super::geometry::Geometry;
use crate::normals::{cross, dot, sub};

/// Texture coordinates of a face's corners.
pub type Corners = [[f64; 2]; 3];

/// Where what is new comes from.
pub struct Carry<'a> {
    /// The mesh as it was.
    pub geometry: &'a Geometry,
    /// Per new vertex its place there.
    pub vertices: &'a [Option<Carried>],
    /// Per new triangle that of its middle.
    pub faces: &'a [Option<Carried>],
    /// Per vertex that is kept its number there.
    pub kept: &'a [u32],
    /// The new vertices.
    pub places: &'a [[f64; 3]],
}

impl Carry<'_> {
    /// Per new face the texture coordinates of its corners. `wedges` are those of every triangle of the mesh as it was; what hangs together
    /// by edges with the same coordinates on both sides is a chart. A face has the chart of its middle, whose triangle is continued to corners
    /// in others.
    pub fn textures(&self, wedges: &[Option<Corners>], faces: &[[u32; 3]]) -> Vec<Option<Corners>> {
        let triangles = &self.geometry.triangles;
        let charts = charts(triangles, wedges);
        let mut at: BTreeMap<(u32, usize), [f64; 2]> = BTreeMap::new();
        for ((t, wedge), chart) in triangles.iter().zip(wedges).zip(&charts) {
            for (v, uv) in t.iter().zip(wedge.iter().flatten()) {
                at.entry((*v, *chart)).or_insert(*uv);
            }
        }
        let corner = |v: u32, chart: usize| match (v as usize).checked_sub(self.kept.len()) {
            None => at.get(&(self.kept[v as usize], chart)).copied(),
            Some(new) => {
                let carried = self.vertices.get(new)?.as_ref()?;
                let of = wedges[carried.triangle as usize]
                    .filter(|_| charts[carried.triangle as usize] == chart)?;
                let sum = |k: usize| (0..3).map(|i| carried.parents.weights[i] * of[i][k]).sum();
                Some([sum(0), sum(1)])
            }
        };
        let of_face = |(t, carried): (&[u32; 3], &Option<Carried>)| {
            let triangle = carried.as_ref()?.triangle as usize;
            let wedge = wedges[triangle]?;
            let [a, b, c] =
                t.map(|v| corner(v, charts[triangle]).or_else(|| self.continued(triangle, &wedge, v)));
            Some([a?, b?, c?])
        };
        faces.iter().zip(self.faces).map(of_face).collect()
    }

    /// The texture coordinates of a triangle, continued linearly to a vertex. None if it has no area.
    fn continued(&self, triangle: usize, wedge: &Corners, v: u32) -> Option<[f64; 2]> {
        let at = |v: u32| self.geometry.positions[v as usize];
        let p = match (v as usize).checked_sub(self.kept.len()) {
            None => at(self.kept[v as usize]),
            Some(new) => self.places[new],
        };
        let [a, b, c] = self.geometry.triangles[triangle].map(at);
        let normal = cross(sub(b, a), sub(c, a));
        let part = |x, y| dot(cross(sub(y, x), sub(p, x)), normal) / dot(normal, normal);
        let weights = [part(b, c), part(c, a), part(a, b)];
        let sum = |k: usize| (0..3).map(|i| weights[i] * wedge[i][k]).sum();
        (dot(normal, normal) > 0.0).then(|| [sum(0), sum(1)])
    }
}

/// The middles of triangles.
pub fn middles(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<[f64; 3]> {
    let middle = |t: &[u32; 3]| {
        let corners = t.map(|v| positions[v as usize]);
        [0, 1, 2].map(|k| corners.iter().map(|p| p[k]).sum::<f64>() / 3.0)
    };
    triangles.iter().map(middle).collect()
}

/// Per triangle the number of its chart.
fn charts(triangles: &[[u32; 3]], wedges: &[Option<Corners>]) -> Vec<usize> {
    // Sides with the coordinates of their ends, in the order of these, so that both triangles have the same.
    let mut sides: BTreeMap<[(u32, [u64; 2]); 2], usize> = BTreeMap::new();
    let mut parent: Vec<usize> = (0..triangles.len()).collect();
    for (i, (t, wedge)) in triangles.iter().zip(wedges).enumerate() {
        let Some(wedge) = wedge else { continue };
        for k in 0..3 {
            let end = |k: usize| (t[k % 3], wedge[k % 3].map(f64::to_bits));
            let mut side = [end(k), end(k + 1)];
            side.sort_unstable();
            if let Some(other) = sides.insert(side, i) {
                let (a, b) = (root(&mut parent, i), root(&mut parent, other));
                parent[a.max(b)] = a.min(b);
            }
        }
    }
    (0..triangles.len()).map(|i| root(&mut parent, i)).collect()
}

fn root(parent: &mut [usize], i: usize) -> usize {
    let mut at = i;
    while parent[at] != at {
        parent[at] = parent[parent[at]];
        at = parent[at];
    }
    at
}
