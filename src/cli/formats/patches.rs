//! A list of replacements in a file's bytes.

use std::ops::Range;

use crate::text::{self, Words};

/// Replacements that do not overlap, in any order.
#[derive(Default)]
pub struct Patches {
    /// Range of the original bytes, and range of `new` that replaces it.
    list: Vec<(Range<usize>, Range<usize>)>,
    new: Vec<u8>,
}

impl Patches {
    /// Replaces `old` by `new`.
    pub fn replace(&mut self, old: Range<usize>, new: &[u8]) {
        let start = self.new.len();
        self.new.extend_from_slice(new);
        self.list.push((old, start..self.new.len()));
    }

    /// Replaces the next three words by numbers.
    pub fn replace_words(&mut self, words: &mut Words<'_>, values: [f64; 3]) {
        // The values first: zip must not take a fourth word.
        for (value, word) in values.into_iter().zip(words) {
            self.replace(word, text::double(value).as_bytes());
        }
    }

    /// Puts the items of a list, so many to a corner, in the reverse order of the corners, of which the first one stays first.
    pub fn reverse(&mut self, bytes: &[u8], items: &[Range<usize>], each: usize) {
        let corners = items.len() / each.max(1);
        for k in 1..corners {
            let (to, from) = (&items[each * k..], &items[each * (corners - k)..]);
            for (to, from) in to.iter().zip(from).take(each) {
                self.replace(to.clone(), &bytes[from.clone()]);
            }
        }
    }

    /// The bytes with all replacements.
    pub fn apply(mut self, bytes: &[u8]) -> Vec<u8> {
        self.list.sort_unstable_by_key(|(old, _)| old.start);
        let mut out = Vec::with_capacity(bytes.len() + self.new.len());
        let mut at = 0;
        for (old, new) in &self.list {
            out.extend_from_slice(&bytes[at..old.start]);
            out.extend_from_slice(&self.new[new.clone()]);
            at = old.end;
        }
        out.extend_from_slice(&bytes[at..]);
        out
    }
}
