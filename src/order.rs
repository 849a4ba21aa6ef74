//! Lists in the order of a number.
//!
//! The standard library's stable sort is compiled anew for every kind of entry and key, to about ten kilobytes of machine code. Lists that are
//! sorted once or a few times in a run share one instance of its unstable sort here.

/// Sorts by a number; equals stay in their order, so that sorting by the last number first sorts by several.
pub(crate) fn by_number<T>(list: &mut [T], number: impl Fn(&T) -> u64) {
    let mut from: Vec<(u64, usize)> = list.iter().map(number).zip(0..).collect();
    from.sort_unstable();
    permute(list, &mut from);
}

/// Sorts pairs.
pub(crate) fn pairs(list: &mut [(u32, u32)]) {
    by_number(list, |&(a, b)| pair(a, b));
}

/// The numbers of these are in the order of the pairs.
pub(crate) fn pair(a: u32, b: u32) -> u64 {
    u64::from(a) << 32 | u64::from(b)
}

/// Brings to each place the entry from the place that stands there.
fn permute<T>(list: &mut [T], from: &mut [(u64, usize)]) {
    for first in 0..list.len() {
        let mut place = first;
        loop {
            let next = std::mem::replace(&mut from[place].1, place);
            if next == first {
                break;
            }
            list.swap(place, next);
            place = next;
        }
    }
}

/// The numbers of these are in the order of `f64::total_cmp`; `!ascending(x)` are in the opposite one.
pub(crate) fn ascending(x: f64) -> u64 {
    let bits = x.to_bits();
    if x.is_sign_negative() {
        !bits
    } else {
        bits | 1 << 63
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::{ascending, by_number, pairs};

    proptest! {
        #[test]
        fn equals_stay_in_their_order(numbers in prop::collection::vec(0_u64..20, 0..200)) {
            let mut list: Vec<(u64, usize)> = numbers.into_iter().zip(0..).collect();
            let mut expected = list.clone();
            expected.sort_by_key(|entry| entry.0);
            by_number(&mut list, |entry| entry.0);
            prop_assert_eq!(list, expected);
        }

        #[test]
        fn pairs_are_sorted(pairs_ in prop::collection::vec((0_u32..9, any::<u32>()), 0..200)) {
            let (mut list, mut expected) = (pairs_.clone(), pairs_);
            expected.sort_unstable();
            pairs(&mut list);
            prop_assert_eq!(list, expected);
        }

        #[test]
        fn numbers_are_in_the_order_of_what_they_stand_for(a in any::<f64>(), b in any::<f64>()) {
            prop_assert_eq!(ascending(a).cmp(&ascending(b)), a.total_cmp(&b));
            prop_assert_eq!((!ascending(a)).cmp(&!ascending(b)), b.total_cmp(&a));
        }
    }

    #[test]
    fn special_values_have_their_places() {
        let values = [
            f64::NEG_INFINITY,
            -1.0,
            -f64::MIN_POSITIVE,
            -0.0,
            0.0,
            1.0,
            f64::INFINITY,
            f64::NAN,
        ];
        assert!(
            values
                .windows(2)
                .all(|pair| ascending(pair[0]) < ascending(pair[1]))
        );
    }
}
