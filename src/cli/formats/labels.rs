//! What faces are told apart by: materials, groups, colours and other values of their own.

use std::collections::BTreeMap;

use super::mesh_file::{MeshFile, Places};
use super::obj;

impl MeshFile {
    /// Per triangle a number that it has in common with others whose faces have the same values in the file. None if all have.
    pub fn labels(&self) -> Vec<u32> {
        let geometry = &self.geometry;
        match &self.places {
            Places::Ply(places) => {
                let of_polygon = numbered((0..geometry.polygon_count).map(|polygon| {
                    let values = places.numbers_of_face(&self.bytes, polygon).into_iter();
                    values.map(f64::to_bits).collect::<Vec<u64>>()
                }));
                let triangles = 0..geometry.triangles.len();
                let label = |t: usize| of_polygon.get(geometry.polygon_of(t)).copied();
                triangles.filter_map(label).collect()
            }
            Places::Obj(_) => numbered(
                obj::settings(&self.bytes)
                    .into_iter()
                    .map(|lines| lines.map(|line| line.map(|line| &self.bytes[line]))),
            ),
            Places::Off(_) | Places::Stl(_) => Vec::new(),
        }
    }
}

/// Numbers of the keys in the order of their first places. None if there is one only.
fn numbered<K: Ord>(keys: impl Iterator<Item = K>) -> Vec<u32> {
    let mut known = BTreeMap::new();
    let mut number = |key: K| {
        let next = known.len() as u32;
        *known.entry(key).or_insert(next)
    };
    let labels: Vec<u32> = keys.map(&mut number).collect();
    if known.len() > 1 { labels } else { Vec::new() }
}
