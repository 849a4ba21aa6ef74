//! Assertions that say what was found, beside what was asked.
#![allow(dead_code, unused_macros, reason = "each program of tests uses some")]

/// Compares two values by an operator, perhaps with what they are of.
macro_rules! assert_compared {
    ($left:expr, $operator:tt, $right:expr $(, $of:literal)?) => {
        match (&$left, &$right) {
            (left, right) => assert!(
                *left $operator *right,
                "`{} {} {}` does not hold{}\n  left: {left:?}\n right: {right:?}",
                stringify!($left),
                stringify!($operator),
                stringify!($right),
                String::new() $(+ ": " + &format!($of))?
            ),
        }
    };
}

/// `a < b`
macro_rules! assert_below {
    ($left:expr, $right:expr $(, $of:literal)? $(,)?) => {
        assert_compared!($left, <, $right $(, $of)?)
    };
}

/// `a <= b`
macro_rules! assert_at_most {
    ($left:expr, $right:expr $(, $of:literal)? $(,)?) => {
        assert_compared!($left, <=, $right $(, $of)?)
    };
}

/// `a > b`
macro_rules! assert_above {
    ($left:expr, $right:expr $(, $of:literal)? $(,)?) => {
        assert_compared!($left, >, $right $(, $of)?)
    };
}

/// `a >= b`
macro_rules! assert_at_least {
    ($left:expr, $right:expr $(, $of:literal)? $(,)?) => {
        assert_compared!($left, >=, $right $(, $of)?)
    };
}

/// Two numbers differ by less than a bar.
macro_rules! assert_near {
    ($left:expr, $right:expr, $bar:expr $(,)?) => {
        match (&$left, &$right, &$bar) {
            (left, right, bar) => assert!(
                (*left - *right).abs() < *bar,
                "`{}` is not `{}` to {bar:e}\n  left: {left:?}\n right: {right:?}\n apart: {:e}",
                stringify!($left),
                stringify!($right),
                (*left - *right).abs()
            ),
        }
    };
}

/// A text, a list or a range contains something.
macro_rules! assert_contains {
    ($whole:expr, $part:expr $(,)?) => {
        match (&$whole, $part) {
            (whole, part) => assert!(whole.contains(part), "{part:?} is not in {whole:?}"),
        }
    };
}

/// A text begins so.
macro_rules! assert_begins {
    ($text:expr, $begin:expr $(,)?) => {
        match (&$text, $begin) {
            (text, begin) => assert!(text.starts_with(begin), "{text:?} does not begin with {begin:?}"),
        }
    };
}

/// A value is of a pattern.
macro_rules! assert_matches {
    ($value:expr, $pattern:pat $(if $guard:expr)? $(,)?) => {
        match &$value {
            value => assert!(
                matches!(value, $pattern $(if $guard)?),
                "{value:?} is not {}",
                stringify!($pattern $(if $guard)?)
            ),
        }
    };
}

/// Nothing is in a list.
macro_rules! assert_empty {
    ($list:expr $(,)?) => {
        match &$list {
            list => assert!(list.is_empty(), "`{}` has {list:?}", stringify!($list)),
        }
    };
}

/// All items of an iterator are as asked.
macro_rules! assert_all {
    ($items:expr, $asked:expr $(,)?) => {
        if let Some((k, item)) = $crate::asserts::first_unlike($items, $asked) {
            panic!("item {k} is {item:?}, and not all are `{}`", stringify!($asked));
        }
    };
}

/// Two long lists are the same; the first items that differ are shown, not all.
macro_rules! assert_same_items {
    ($left:expr, $right:expr $(,)?) => {
        match (&$left, &$right) {
            (left, right) => {
                assert_eq!(left.len(), right.len());
                let pairs = left.iter().zip(right.iter());
                assert_all!(pairs, |(left, right)| left == right);
            }
        }
    };
}

/// The first item that is not as asked, with its place.
pub(crate) fn first_unlike<I: IntoIterator<Item: Copy>>(
    items: I,
    asked: impl Fn(I::Item) -> bool,
) -> Option<(usize, I::Item)> {
    items.into_iter().enumerate().find(|(_, item)| !asked(*item))
}
