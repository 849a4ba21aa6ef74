//! Numbers of the C interface as values of the library.

use super::status::CallResult;
use super::structs::{FieldPath, refuse};

/// A choice by its number.
pub(crate) fn chosen<T>(value: Option<T>, number: u32, of: &str, place: FieldPath) -> CallResult<T> {
    value.ok_or_else(|| refuse!(place => BadEnum, "{number} is no {of}"))
}

/// The one of these that has the number.
pub(crate) fn choose<T>(
    choices: impl IntoIterator<Item = T>,
    number_of: impl Fn(&T) -> u32,
    number: u32,
    of: &str,
    place: FieldPath,
) -> CallResult<T> {
    let found = choices.into_iter().find(|choice| number_of(choice) == number);
    chosen(found, number, of, place)
}

/// An enumeration that the header alone has.
pub(crate) trait Choice: Copy + 'static {
    const ALL: &'static [Self];
    const NAME: &'static str;
    fn number(self) -> u32;
}

macro_rules! choice_of {
    ($name:ident: $($variant:ident)*) => {
        impl super::choices::Choice for $name {
            const ALL: &'static [Self] = &[$(Self::$variant),*];
            const NAME: &'static str = stringify!($name);
            fn number(self) -> u32 {
                self as u32
            }
        }
    };
}
pub(crate) use choice_of;

/// The one of them that has the number.
pub(crate) fn choice<T: Choice>(number: u32, place: FieldPath) -> CallResult<T> {
    choose(
        T::ALL.iter().copied(),
        |choice| choice.number(),
        number,
        T::NAME,
        place,
    )
}

/// A number that may exceed what this machine counts.
pub(crate) fn count(n: u64) -> usize {
    usize::try_from(n).unwrap_or(usize::MAX)
}
