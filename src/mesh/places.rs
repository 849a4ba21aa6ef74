//! Which vertices lie at the same place.

use super::disjoint_sets::DisjointSets;

/// So many different positions in a cube whose side is the distance asked for are crowded: none of them is joined to another one. In a soup a vertex
/// has as many copies as triangles, and the pole of a globe has 24 or 48.
/// Half or double, of 4 cases: half leaves a pole of 48 open; double changes none.
const CROWD: usize = 64;
/// The least side of such a cube, in extents of all positions: places in the grid stay whole numbers.
/// Half or double, of 2 cases: none changes.
const FINEST: f64 = 1.0 / (1u64 << 40) as f64;

/// Numbers that vertices at the same place have in common, or nothing where each has a place of its own. `vertices` may not
/// repeat.
pub(crate) fn places(positions: &[[f64; 3]], vertices: &[u32], within: f64) -> Option<Vec<u32>> {
    let mut sets = DisjointSets::new(vertices.len());
    let finite = |v: u32| Some(&positions[v as usize]).filter(|p| p.iter().all(|c| c.is_finite()));
    let keyed = |(i, &v): (u32, &u32)| Some((exact(finite(v)?), i));
    let mut order: Vec<([u64; 3], u32)> = (0..).zip(vertices).filter_map(keyed).collect();
    order.sort_unstable();
    let mut is_shared = false;
    let mut firsts = Vec::new();
    for same in order.chunk_by(|a, b| a.0 == b.0) {
        same[1..].iter().for_each(|entry| sets.unite(same[0].1, entry.1));
        is_shared |= same.len() > 1;
        firsts.push(same[0].1);
    }
    if within > 0.0 {
        let at = |i: u32| positions[vertices[i as usize] as usize];
        is_shared |= unite_near(&firsts, at, within, &mut sets);
    }
    is_shared.then(|| (0..vertices.len() as u32).map(|i| sets.smallest(i)).collect())
}

/// Equal for equal coordinates: -0 is 0.
fn exact(position: &[f64; 3]) -> [u64; 3] {
    position.map(|c| (c + 0.0).to_bits())
}

/// Unites those that lie within a distance of each other; whether there are any.
fn unite_near(vertices: &[u32], at: impl Fn(u32) -> [f64; 3], within: f64, sets: &mut DisjointSets) -> bool {
    let far = [f64::INFINITY; 3];
    let low = vertices.iter().fold(far, |low, &i| least(low, at(i)));
    let high = vertices
        .iter()
        .fold(far, |high, &i| least(high, at(i).map(|c| -c)))
        .map(|c| -c);
    let extent = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
    let side = within.max(extent * FINEST);
    let cell = |i: u32| {
        let p = at(i);
        // From 1 on, so that every cell has neighbours.
        [0, 1, 2].map(|k| ((p[k] - low[k]) / side) as u64 + 1)
    };
    let mut cells: Vec<([u64; 3], u32)> = vertices.iter().map(|&i| (cell(i), i)).collect();
    cells.sort_unstable();
    let of = |c: [u64; 3]| {
        let first = cells.partition_point(|entry| entry.0 < c);
        let length = cells[first..]
            .iter()
            .take(CROWD + 1)
            .take_while(|e| e.0 == c)
            .count();
        &cells[first..first + if length > CROWD { 0 } else { length }]
    };
    let mut any = false;
    for own in cells.chunk_by(|a, b| a.0 == b.0).filter(|own| own.len() <= CROWD) {
        let [x, y, z] = own[0].0;
        let around = (0..27).map(|k| [x + k / 9 - 1, y + k / 3 % 3 - 1, z + k % 3 - 1]);
        for &(_, j) in around.flat_map(of) {
            for &(_, i) in own
                .iter()
                .filter(|(_, i)| *i < j && distance(at(*i), at(j)) <= within)
            {
                sets.unite(i, j);
                any = true;
            }
        }
    }
    any
}

fn least(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k].min(b[k]))
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    // Squares would overflow far away.
    let [x, y, z] = [0, 1, 2].map(|k| a[k] - b[k]);
    libm::hypot(libm::hypot(x, y), z)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(x: &[f64], within: f64) -> Option<Vec<u32>> {
        let positions: Vec<[f64; 3]> = x.iter().map(|&x| [x, 0.0, -0.0]).collect();
        places(&positions, &(0..x.len() as u32).collect::<Vec<_>>(), within)
    }

    #[test]
    fn equal_positions_are_one_place_and_nan_is_none() {
        assert_eq!(of(&[1.0, 0.0, 2.0, -0.0, 1.0], 0.0), Some(vec![0, 1, 2, 1, 0]));
        assert_eq!(of(&[1.0, 2.0, f64::NAN, f64::NAN], 0.0), None);
    }

    #[test]
    fn places_reach_as_far_as_the_distance() {
        // Either side of the faces of the grid's cells.
        assert_eq!(of(&[0.0, 0.99, 1.01, 3.0, 4.5], 1.0), Some(vec![0, 0, 0, 3, 4]));
        assert_eq!(of(&[0.0, 2.0], 1.0), None);
        assert_eq!(of(&[0.0, 1e-9, 1e9], 1e-8), Some(vec![0, 0, 2]));
        assert_eq!(of(&[0.0, 1e300], f64::MAX), Some(vec![0, 0]));
    }

    #[test]
    fn a_crowd_stays_apart() {
        let x: Vec<f64> = (0..1000).map(|i| f64::from(i) * 1e-3).collect();
        assert_eq!(of(&x, 10.0), None);
    }
}
