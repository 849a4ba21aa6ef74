//! Work shared by the threads of the pool that it is called in.
//!
//! What rayon's iterators are made of is compiled anew for every loop, to kilobytes of machine code each. Here a loop is a list of pieces, each
//! worth a call through a pointer, and all loops share one instance of what hands them out.

use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use crate::interrupt::checkpoint;

/// `work(k, item)` for every item, the `k`-th of them.
pub fn for_each<T: Send>(items: impl Iterator<Item = T>, work: impl Fn(usize, T) + Sync) {
    let items: Vec<Mutex<Option<T>>> = items.map(|item| Mutex::new(Some(item))).collect();
    each(items.len(), &|k| {
        checkpoint();
        let item = items[k].lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(item) = item {
            work(k, item);
        }
    });
}

/// What `work(k, item)` makes of every item, in their order.
pub fn map<T: Send, R: Send>(items: impl Iterator<Item = T>, work: impl Fn(usize, T) -> R + Sync) -> Vec<R> {
    let items: Vec<T> = items.collect();
    let mut made: Vec<Option<R>> = Vec::new();
    made.resize_with(items.len(), || None);
    for_each(items.into_iter().zip(&mut made), |k, (item, made)| {
        *made = Some(work(k, item));
    });
    made.into_iter().flatten().collect()
}

/// The same where `work` needs room, which is made anew only where other threads have what is there.
pub fn map_with<T: Send, R: Send, S: Send>(
    room: impl Fn() -> S + Sync,
    items: impl Iterator<Item = T>,
    work: impl Fn(&mut S, T) -> R + Sync,
) -> Vec<R> {
    let rooms = Mutex::new(Vec::new());
    let idle = || rooms.lock().unwrap_or_else(PoisonError::into_inner);
    map(items, |_, item| {
        let free = idle().pop();
        let mut own = free.unwrap_or_else(&room);
        let made = work(&mut own, item);
        idle().push(own);
        made
    })
}

/// What `work` makes of every number below `count`, so many of them in a piece.
pub fn map_each<R: Send>(count: usize, piece: usize, work: impl Fn(usize) -> R + Sync) -> Vec<R> {
    let pieces = map(runs(count, piece), |_, run| run.map(&work).collect::<Vec<_>>());
    let mut made = Vec::with_capacity(count);
    pieces.into_iter().for_each(|piece| made.extend(piece));
    made
}

/// Cheap items that a thread takes at once: enough that handing them out costs nothing beside them.
/// Half or double, of 131 cases: none changes.
pub const RUN: usize = 4096;

/// Ranges of `0..count`, `length` numbers each and what is left in the last.
pub fn runs(count: usize, length: usize) -> impl Iterator<Item = std::ops::Range<usize>> {
    (0..count)
        .step_by(length)
        .map(move |begin| begin..count.min(begin + length))
}

/// Both, side by side.
///
/// # Panics
/// If one of them does.
pub fn join<A: Send, B: Send>(a: impl FnOnce() -> A + Send, b: impl FnOnce() -> B + Send) -> (A, B) {
    let (mut a, mut b) = (Once::Not(a), Once::Not(b));
    both(&mut || a.run(), &mut || b.run());
    (a.result(), b.result())
}

/// `work` on the threads of this pool.
///
/// # Panics
/// If `work` does.
pub fn install<R: Send>(pool: &rayon::ThreadPool, work: impl FnOnce() -> R + Send) -> R {
    let mut work = Once::Not(work);
    within(pool, &mut || work.run());
    work.result()
}

/// A call before and after it.
enum Once<F, R> {
    Not(F),
    Done(R),
    Now,
}

impl<R, F: FnOnce() -> R> Once<F, R> {
    fn run(&mut self) {
        if let Self::Not(work) = std::mem::replace(self, Self::Now) {
            *self = Self::Done(work());
        }
    }

    fn result(self) -> R {
        match self {
            Self::Done(result) => result,
            _ => unreachable!("both have run"),
        }
    }
}

#[inline(never)]
fn each(count: usize, work: &(dyn Fn(usize) + Sync)) {
    if count == 1 {
        work(0);
    } else {
        (0..count).into_par_iter().for_each(work);
    }
}

#[inline(never)]
fn within(pool: &rayon::ThreadPool, work: &mut (dyn FnMut() + Send)) {
    pool.install(work);
}

#[inline(never)]
fn both(a: &mut (dyn FnMut() + Send), b: &mut (dyn FnMut() + Send)) {
    rayon::join(a, b);
}

#[cfg(test)]
mod tests {
    use super::{for_each, join, map, map_each, map_with, runs};

    #[test]
    fn every_item_is_worked_on_once() {
        let mut numbers: Vec<usize> = (0..1000).collect();
        for_each(numbers.chunks_mut(7), |k, chunk| {
            chunk.iter_mut().for_each(|n| *n = 1000 * *n + k);
        });
        assert_all!(numbers.iter().enumerate(), |(i, n)| *n == 1000 * i + i / 7);
    }

    #[test]
    fn results_are_in_the_order_of_the_items() {
        let lengths = map(runs(10_001, 10), |k, run| (k, run.start, run.len()));
        assert_eq!(lengths.len(), 1001);
        for (k, of) in lengths[..1000].iter().enumerate() {
            assert_eq!(*of, (k, 10 * k, 10));
        }
        assert_eq!(lengths[1000], (1000, 10_000, 1));
        assert_empty!(map(runs(0, 10), |k, _| k));
    }

    #[test]
    fn room_is_there_for_every_item() {
        let sums = map_with(Vec::new, 0..1000, |room: &mut Vec<usize>, item| {
            room.clear();
            room.extend(0..item);
            room.iter().sum::<usize>()
        });
        assert_eq!(sums, map_each(1000, 17, |item| item * item.saturating_sub(1) / 2));
    }

    #[test]
    fn both_results_come_back_and_panics_as_well() {
        assert_eq!(join(|| "a".repeat(3), || 7), ("aaa".to_string(), 7));
        for second in [false, true] {
            let panics = move |it: bool| {
                std::panic::catch_unwind(move || join(|| assert!(second || !it), || assert!(!second || !it)))
            };
            assert!(panics(false).is_ok());
            assert!(panics(true).is_err());
        }
    }
}
