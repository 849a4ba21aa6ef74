//! New coordinates and normals for a file's vertices.

/// The coordinates and normals to be written.
pub struct Change<'a> {
    /// All positions.
    pub positions: &'a [[f64; 3]],
    /// The vertices whose positions differ from the file's.
    pub moved: &'a [bool],
    /// New normals of the moved vertices and their neighbours, by vertex, ascending.
    pub normals: &'a [(u32, [f64; 3])],
}

impl Change<'_> {
    /// The vertices with anything to write: number, new position if moved, new normal if there is one.
    pub fn vertices(&self) -> impl Iterator<Item = (usize, Option<[f64; 3]>, Option<[f64; 3]>)> + '_ {
        let mut normals = self.normals.iter().peekable();
        self.moved.iter().enumerate().filter_map(move |(v, &moved)| {
            let normal = normals
                .next_if(|(w, _)| *w as usize == v)
                .map(|&(_, normal)| normal);
            let position = moved.then(|| self.positions[v]);
            (position.is_some() || normal.is_some()).then_some((v, position, normal))
        })
    }
}
