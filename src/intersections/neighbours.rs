//! Which triangles lie across each other's edges, told by positions alone.

use fairmesh_linear::interrupt::checkpoint;

use super::triangles::Corners;

/// Nothing is across.
pub(super) const NONE: u32 = u32::MAX;

/// Edges with the same hash that are looked at; those beyond stay without a neighbour, which is never wrong.
/// Half or double, of 129 cases: none changes.
const MOST: usize = 16;

/// Triangles after which it is told how far it is: two milliseconds.
/// Half or double: only the progress changes.
const TELLING: usize = 8192;

/// For the edges of each triangle, from its corner k to the next one, a triangle that has the same edge the other way round.
/// Each edge is paired once: where more than two triangles meet in one, the others have none. Coordinates have no negative zeros.
/// Tells how far it is, from 0 to 1.
pub(super) fn neighbours<'t>(
    triangles: impl ExactSizeIterator<Item = &'t Corners> + Clone,
    tell: &mut dyn FnMut(f64),
) -> Vec<[u32; 3]> {
    let count = 3 * triangles.len();
    let edges: Vec<[&[f64; 3]; 2]> = triangles
        .clone()
        .flat_map(|t| [0, 1, 2].map(|k| [&t[k], &t[(k + 1) % 3]]))
        .collect();
    let shift = 64 - count.next_power_of_two().trailing_zeros().max(1);
    let mut last = vec![NONE; 1 << (64 - shift)];
    // The edge of the same hash before each one.
    let mut before = vec![NONE; count];
    let mut across = vec![[NONE; 3]; triangles.len()];
    for (t, corners) in triangles.enumerate() {
        checkpoint();
        if t.is_multiple_of(TELLING) {
            tell(3.0 * t as f64 / count as f64);
        }
        let hashes = corners.each_ref().map(hash);
        for k in 0..3 {
            let edge = 3 * t + k;
            let bucket = (hashes[k].wrapping_add(hashes[(k + 1) % 3]) >> shift) as usize;
            let [from, to] = edges[edge];
            let is_opposite = |&other: &usize| {
                across[other / 3][other % 3] == NONE && *edges[other][0] == *to && *edges[other][1] == *from
            };
            let same = std::iter::successors(Some(last[bucket]), |&e| before.get(e as usize).copied());
            let mut same = same.take_while(|&e| e != NONE).map(|e| e as usize).take(MOST);
            if let Some(other) = same.find(is_opposite) {
                across[other / 3][other % 3] = t as u32;
                across[t][k] = (other / 3) as u32;
            } else {
                before[edge] = last[bucket];
                last[bucket] = edge as u32;
            }
        }
    }
    across
}

/// Of a position.
fn hash(p: &[f64; 3]) -> u64 {
    p.iter().fold(0, |hash: u64, x| {
        (hash.rotate_left(21) ^ x.to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15)
    })
}
