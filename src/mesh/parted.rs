//! A mesh parted along edges: a vertex between two of them, or between one and the boundary, gets a copy for each side.

/// Triangles whose vertices have copies.
#[derive(Debug, Clone)]
pub(crate) struct Parted {
    pub triangles: Vec<[u32; 3]>,
    /// What the copies are of; they are numbered after all vertices.
    pub copy_of: Vec<u32>,
}

/// Parts a mesh of so many vertices along `edges`. Of each vertex the fan with the smallest triangle keeps the number.
pub(crate) fn part(vertices: usize, triangles: &[[u32; 3]], edges: &[[u32; 2]]) -> Parted {
    let mut cut: Vec<[u32; 2]> = edges.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect();
    cut.sort_unstable();
    let mut is_on_cut = vec![false; vertices];
    cut.iter().flatten().for_each(|&v| is_on_cut[v as usize] = true);
    let mut corners: Vec<Corner> = Vec::new();
    for (t, tri) in triangles.iter().enumerate() {
        let on_cut = (0..3).filter(|&k| is_on_cut[tri[k] as usize]);
        corners.extend(on_cut.map(|k| (tri[k], t, k)));
    }
    corners.sort_unstable();
    let mut parted = Parted {
        triangles: triangles.to_vec(),
        copy_of: Vec::new(),
    };
    let is_cut = |v: u32, w: u32| is_on_cut[w as usize] && cut.binary_search(&[v.min(w), v.max(w)]).is_ok();
    for of_vertex in corners.chunk_by(|a, b| a.0 == b.0) {
        let mut numbers = vec![of_vertex[0].0];
        for fan in fans(triangles, of_vertex, is_cut) {
            let number = numbers.pop().unwrap_or_else(|| {
                parted.copy_of.push(of_vertex[0].0);
                (vertices + parted.copy_of.len() - 1) as u32
            });
            for &(_, t, k) in &fan {
                parted.triangles[t][k] = number;
            }
        }
    }
    parted
}

type Corner = (u32, usize, usize);

/// The corners at one vertex, gathered where their triangles share an edge there that is not cut.
fn fans(triangles: &[[u32; 3]], of_vertex: &[Corner], is_cut: impl Fn(u32, u32) -> bool) -> Vec<Vec<Corner>> {
    let beside = |&(v, t, k): &Corner| {
        let other = [triangles[t][(k + 1) % 3], triangles[t][(k + 2) % 3]];
        other.map(|w| (!is_cut(v, w)).then_some(w))
    };
    let mut left: Vec<(Corner, [Option<u32>; 2])> = of_vertex.iter().map(|c| (*c, beside(c))).collect();
    let mut fans = Vec::new();
    while !left.is_empty() {
        let (first, edges) = left.remove(0);
        let (mut fan, mut ends) = (vec![first], vec![edges]);
        while let Some(edges) = ends.pop() {
            left.retain(|(corner, own)| {
                let is_beside = own.iter().any(|w| w.is_some() && edges.contains(w));
                if is_beside {
                    fan.push(*corner);
                    ends.push(*own);
                }
                !is_beside
            });
        }
        fans.push(fan);
    }
    fans
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six triangles around vertex 0.
    fn fan() -> Vec<[u32; 3]> {
        (0..6).map(|k| [0, 1 + k, 1 + (k + 1) % 6]).collect()
    }

    #[test]
    fn a_vertex_between_two_cut_edges_has_two_copies() {
        let parted = part(7, &fan(), &[[1, 0], [0, 4]]);
        assert_eq!(parted.copy_of, [0, 1, 4]);
        let of = parted.triangles.iter().map(|t| t[0]).collect::<Vec<u32>>();
        assert_eq!(of, [0, 0, 0, 7, 7, 7]);
        assert_eq!(parted.triangles[5], [7, 6, 8]);
    }

    #[test]
    fn three_edges_make_three_copies_and_one_ends_inside() {
        let parted = part(7, &fan(), &[[1, 0], [0, 3], [0, 5]]);
        assert_eq!(parted.copy_of.iter().filter(|v| **v == 0).count(), 2);
        // One edge alone parts no closed fan.
        let one = part(7, &fan(), &[[0, 2]]);
        assert_eq!(one.copy_of, [2]);
    }
}
