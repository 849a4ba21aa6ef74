//! Supernodes: groups of columns of equal structure, merged where that costs few zeros (Ashcraft & Grimes 1989).

use super::elimination::NONE;
use super::elimination::{children, postorder};

/// Groups of columns while they are formed and merged.
pub(super) struct Supernodes {
    /// The columns of group `g` are `post_first[g]..post_first[g + 1]` of the postorder.
    post: Vec<u32>,
    post_first: Vec<u32>,
    parent: Vec<u32>,
    /// The group that a group was merged into.
    merged: Vec<u32>,
}

/// The final numbering of columns and supernodes.
pub(super) struct Layout {
    pub(super) column_order: Vec<u32>,
    pub(super) first: Vec<u32>,
    pub(super) parent: Vec<u32>,
}

impl Supernodes {
    /// Groups the columns of an elimination tree, given by parents, postorder and column counts.
    pub(super) fn new(parent: &[u32], post: &[u32], count: &[u32]) -> Self {
        let n = post.len();
        let mut group_of = vec![0_u32; n];
        let mut post_first = Vec::new();
        for k in 0..n {
            let joins = k > 0 && {
                let (a, b) = (post[k - 1] as usize, post[k] as usize);
                parent[a] == b as u32 && count[a] == count[b] + 1
            };
            if !joins {
                post_first.push(k as u32);
            }
            group_of[post[k] as usize] = post_first.len() as u32 - 1;
        }
        post_first.push(n as u32);
        let ng = post_first.len() - 1;
        let last = |g: usize| post[post_first[g + 1] as usize - 1] as usize;
        let up: Vec<u32> = (0..ng)
            .map(|g| match parent[last(g)] {
                NONE => NONE,
                p => group_of[p as usize],
            })
            .collect();
        let below: Vec<u32> = (0..ng).map(|g| count[last(g)] - 1).collect();
        let mut this = Self {
            post: post.to_vec(),
            post_first,
            parent: up,
            merged: vec![NONE; ng],
        };
        this.merge(&below);
        this
    }

    /// Merges groups with their parents where that costs few explicit zeros: larger fronts are faster per
    /// operation, and there is less to assemble.
    fn merge(&mut self, below: &[u32]) {
        let ng = self.parent.len();
        let (start, child) = children(&self.parent);
        let mut width: Vec<u64> = (0..ng)
            .map(|g| u64::from(self.post_first[g + 1] - self.post_first[g]))
            .collect();
        let mut zeros = vec![0_u64; ng];
        let mut candidates = Vec::new();
        for g in 0..ng {
            candidates.clear();
            // Those with the most rows below first; of equals the smaller number.
            let key = |&c: &u32| u64::from(!below[c as usize]) << 32 | u64::from(c);
            candidates.extend(child[start[g]..start[g + 1]].iter().map(key));
            candidates.sort_unstable();
            for &key in &candidates {
                let c = key as u32 as usize;
                let rows = width[g] + u64::from(below[g]);
                let extra = zeros[c] + zeros[g] + width[c] * (rows - u64::from(below[c]));
                let total = width[c] + width[g];
                let size = total * (total + 1) / 2 + total * u64::from(below[g]);
                let part = extra as f64 / size as f64;
                let accept = match total {
                    0..=8 => part < 0.5,
                    9..=24 => part < 0.25,
                    25..=64 => part < 0.12,
                    _ => part < 0.05,
                };
                if accept {
                    self.merged[c] = g as u32;
                    width[g] = total;
                    zeros[g] = extra;
                }
            }
        }
    }

    /// Numbers the merged groups in postorder of their tree, the columns of each in the old order.
    pub(super) fn layout(self) -> Layout {
        let ng = self.parent.len();
        let mut owner: Vec<u32> = (0..ng as u32).collect();
        for g in (0..ng).rev() {
            if self.merged[g] != NONE {
                owner[g] = owner[self.merged[g] as usize];
            }
        }
        // The tree of the owners; merged groups hang nowhere.
        let mut tree = vec![NONE; ng];
        let (mut member_start, mut members) = (vec![0_usize; ng + 2], vec![0_u32; ng]);
        for g in 0..ng {
            if owner[g] == g as u32 && self.parent[g] != NONE {
                tree[g] = owner[self.parent[g] as usize];
            }
            member_start[owner[g] as usize + 2] += 1;
        }
        for g in 0..ng {
            member_start[g + 2] += member_start[g + 1];
        }
        for g in 0..ng {
            let slot = &mut member_start[owner[g] as usize + 1];
            members[*slot] = g as u32;
            *slot += 1;
        }
        let order = postorder(&tree);
        let mut number = vec![NONE; ng];
        let mut layout = Layout {
            column_order: Vec::with_capacity(self.post.len()),
            first: vec![],
            parent: vec![],
        };
        for g in order.into_iter().filter(|&g| owner[g as usize] == g) {
            number[g as usize] = layout.first.len() as u32;
            layout.first.push(layout.column_order.len() as u32);
            layout.parent.push(tree[g as usize]);
            for &part in &members[member_start[g as usize]..member_start[g as usize + 1]] {
                let part = part as usize;
                let columns = self.post_first[part] as usize..self.post_first[part + 1] as usize;
                layout.column_order.extend_from_slice(&self.post[columns]);
            }
        }
        layout.first.push(layout.column_order.len() as u32);
        for parent in layout.parent.iter_mut().filter(|p| **p != NONE) {
            *parent = number[*parent as usize];
        }
        layout
    }
}
