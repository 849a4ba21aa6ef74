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
    pub(crate) fn new<N: IntoIterator<Item = u32>>(
        centres: impl Iterator<Item = u32>,
        rings: usize,
        count: usize,
        neighbours: impl Fn(u32) -> N,
    ) -> Self {
        let mut samples = Self {
            start: vec![0],
            ..Self::default()
        };
        let mut is_found = vec![false; count];
        for centre in centres {
            let first = samples.vertex.len();
            is_found[centre as usize] = true;
            samples.add(neighbours(centre), &mut is_found);
            samples.end_ring(1, first);
            let mut before = first;
            for ring in 2..=rings {
                let begin = samples.vertex.len();
                for i in before..begin {
                    samples.add(neighbours(samples.vertex[i]), &mut is_found);
                }
                samples.end_ring(ring as u8, begin);
                before = begin;
            }
            is_found[centre as usize] = false;
            samples.vertex[first..]
                .iter()
                .for_each(|&j| is_found[j as usize] = false);
            samples.start.push(samples.vertex.len());
        }
        samples
    }

    /// Those that are not found yet.
    fn add(&mut self, vertices: impl IntoIterator<Item = u32>, is_found: &mut [bool]) {
        for j in vertices {
            if !std::mem::replace(&mut is_found[j as usize], true) {
                self.vertex.push(j);
            }
        }
    }

    /// All from here on are so many edges away.
    fn end_ring(&mut self, ring: u8, begin: usize) {
        self.vertex[begin..].sort_unstable();
        self.reach.resize(self.vertex.len(), ring);
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
