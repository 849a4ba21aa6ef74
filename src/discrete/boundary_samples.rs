//! The vertices around boundary vertices, on one side of the boundary, ring by ring.

/// For each vertex of a loop its samples and how many edges away they are.
#[derive(Debug, Clone, Default)]
pub(crate) struct BoundarySamples {
    start: Vec<usize>,
    vertex: Vec<u32>,
    reach: Vec<u8>,
}

impl BoundarySamples {
    /// Those within so many edges of each centre, by `neighbours`; vertices by local numbers, of which there are `count`.
    pub(crate) fn new<'n>(
        centres: impl Iterator<Item = u32>,
        rings: usize,
        count: usize,
        neighbours: impl Fn(u32) -> &'n [u32],
    ) -> Self {
        let mut samples = Self {
            start: vec![0],
            ..Self::default()
        };
        let mut is_found = vec![false; count];
        for centre in centres {
            let first = samples.vertex.len();
            is_found[centre as usize] = true;
            let mut before = vec![centre];
            for ring in 1..=rings {
                let begin = samples.vertex.len();
                for &v in &before {
                    for &j in neighbours(v) {
                        if !std::mem::replace(&mut is_found[j as usize], true) {
                            samples.vertex.push(j);
                        }
                    }
                }
                samples.vertex[begin..].sort_unstable();
                samples.reach.resize(samples.vertex.len(), ring as u8);
                before = samples.vertex[begin..].to_vec();
            }
            is_found[centre as usize] = false;
            samples.vertex[first..]
                .iter()
                .for_each(|&j| is_found[j as usize] = false);
            samples.start.push(samples.vertex.len());
        }
        samples
    }

    /// Those of centre `k`, and how many edges away they are.
    pub(crate) fn of(&self, k: usize) -> (&[u32], &[u8]) {
        let range = self.start[k]..self.start[k + 1];
        (&self.vertex[range.clone()], &self.reach[range])
    }

    /// Only those within so many edges of each centre.
    pub(crate) fn within(&self, rings: impl Fn(usize) -> usize) -> Self {
        let mut fewer = Self {
            start: vec![0],
            ..Self::default()
        };
        for k in 0..self.start.len() - 1 {
            let (vertices, reach) = self.of(k);
            let count = reach.partition_point(|r| usize::from(*r) <= rings(k));
            fewer.vertex.extend(&vertices[..count]);
            fewer.reach.extend(&reach[..count]);
            fewer.start.push(fewer.vertex.len());
        }
        fewer
    }
}
