//! Vertex normals of a triangle mesh.

/// `a - b`.
pub fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `a x b`.
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// `a . b`.
pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The unit vector along `a`, or None if it has no direction.
pub fn unit(a: [f64; 3]) -> Option<[f64; 3]> {
    let largest = a.iter().fold(0.0f64, |m, c| m.max(c.abs()));
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    // Scaled first, so that neither tiny nor huge vectors lose their direction.
    let a = a.map(|c| c / largest);
    let length = dot(a, a).sqrt();
    // Adding zero turns -0 into 0, which reads better in text.
    Some(a.map(|c| c / length + 0.0))
}

/// The unit normal of a triangle, or None if it has no direction.
pub fn of_triangle([a, b, c]: [[f64; 3]; 3]) -> Option<[f64; 3]> {
    unit(cross(sub(b, a), sub(c, a)))
}

/// Unit normals of the marked vertices; zero where there is no direction.
fn of(positions: &[[f64; 3]], triangles: &[[u32; 3]], marked: &[bool]) -> Vec<[f64; 3]> {
    let sums = sums(positions, triangles, marked);
    sums.into_iter()
        .map(|sum| unit(sum).unwrap_or_default())
        .collect()
}

/// Normals of the marked vertices by Max's weights: the sums of `e1 x e2 / (|e1|^2 |e2|^2)` over the corners, exact on spheres.
fn sums(positions: &[[f64; 3]], triangles: &[[u32; 3]], marked: &[bool]) -> Vec<[f64; 3]> {
    let mut sums = vec![[0.0; 3]; positions.len()];
    for triangle in triangles {
        let corners = triangle.map(|v| positions[v as usize]);
        for k in 0..3 {
            let v = triangle[k] as usize;
            if !marked[v] {
                continue;
            }
            let e1 = sub(corners[(k + 1) % 3], corners[k]);
            let e2 = sub(corners[(k + 2) % 3], corners[k]);
            let weight = 1.0 / (dot(e1, e1) * dot(e2, e2));
            if weight.is_finite() {
                let normal = cross(e1, e2);
                (0..3).for_each(|axis| sums[v][axis] += weight * normal[axis]);
            }
        }
    }
    sums
}

/// Unit normals of all vertices as a surface is seen: copies of a vertex, as along texture seams, have one normal, unless
/// they differ by more than 60 degrees, as the two sides of a sheet do.
pub fn all_seen(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<[f64; 3]> {
    const ALIKE: f64 = 0.5;
    let sums = sums(positions, triangles, &vec![true; positions.len()]);
    let own: Vec<[f64; 3]> = sums.iter().map(|&sum| unit(sum).unwrap_or_default()).collect();
    // Adding zero makes -0 equal to 0.
    let place = |v: u32| positions[v as usize].map(|c| (c + 0.0).to_bits());
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    order.sort_unstable_by_key(|&v| (place(v), v));
    let mut seen = own.clone();
    for copies in order
        .chunk_by(|&a, &b| place(a) == place(b))
        .filter(|c| c.len() > 1)
    {
        for &v in copies {
            let alike = copies
                .iter()
                .filter(|&&w| dot(own[v as usize], own[w as usize]) > ALIKE);
            let sum = alike.fold([0.0; 3], |sum, &w| {
                std::array::from_fn(|axis| sum[axis] + sums[w as usize][axis])
            });
            seen[v as usize] = unit(sum).unwrap_or(own[v as usize]);
        }
    }
    seen
}

/// Unit normals of all vertices; zero where there is no direction.
pub fn all(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<[f64; 3]> {
    of(positions, triangles, &vec![true; positions.len()])
}

/// Unit normals of the moved vertices and their neighbours, ascending by vertex; vertices without a
/// direction are left out.
pub fn around(positions: &[[f64; 3]], triangles: &[[u32; 3]], moved: &[bool]) -> Vec<(u32, [f64; 3])> {
    let mut marked = moved.to_vec();
    for triangle in triangles {
        if triangle.iter().any(|&v| moved[v as usize]) {
            triangle.iter().for_each(|&v| marked[v as usize] = true);
        }
    }
    let normals = of(positions, triangles, &marked);
    let found = normals
        .into_iter()
        .enumerate()
        .filter(|(v, normal)| marked[*v] && *normal != [0.0; 3]);
    found.map(|(v, normal)| (v as u32, normal)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles with a bend between them, whose common edge is there twice; and a third one, on the back of the first.
    #[test]
    fn copies_are_seen_as_one_vertex_unless_they_are_sides_of_a_sheet() {
        let edge = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let positions = [
            edge[0],
            edge[1],
            [-1.0, 0.0, 0.1],
            [-0.0, 0.0, 0.0],
            edge[1],
            [1.0, 0.0, 0.1],
        ];
        let halves = [[0, 1, 2], [3, 5, 4]];
        let seen = all_seen(&positions, &halves);
        assert_eq!(seen[0], seen[3]);
        assert_eq!(seen[0], [0.0, 0.0, 1.0]);
        assert_ne!(all(&positions, &halves)[0], seen[0]);
        let sides = [[0, 1, 2], [3, 2, 4]];
        assert_eq!(all_seen(&positions, &sides), all(&positions, &sides));
    }
}
