//! What all languages say of an option: each is declared once, where the library's struct of it is.

/// One option: what the C interface, Python, npm and the tables of the documents take over.
#[derive(Debug, Clone, PartialEq)]
pub struct OptionEntry {
    /// The name in every language: lower case, words joined by `_`.
    pub name: &'static str,
    /// The field of the library's struct.
    pub field: &'static str,
    /// What it is, in sentences.
    pub text: String,
    /// What values it takes.
    pub kind: OptionKind,
    /// Which of them are allowed, for example "at least 1"; empty: all.
    pub range: &'static str,
    /// The value if nothing is said.
    pub default: OptionDefault,
}

/// What values an option takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OptionKind {
    /// A real number in this unit.
    Real(&'static str),
    /// A number of such things, 64 bits.
    Count(&'static str),
    /// A number of such things, 32 bits.
    SmallCount(&'static str),
    /// Yes or no.
    Flag,
    /// A value of the enumeration that has this name in C.
    Choice(&'static str),
    /// Rows of so many indices each.
    Indices(usize),
    /// A struct that has this name in C.
    Struct(&'static str),
    /// None that hosts set here: it is an option of the mesh, or has options of its own.
    Elsewhere,
}

/// The default of an option.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum OptionDefault {
    /// A number.
    Number(f64),
    /// Yes or no.
    Flag(bool),
    /// The name of a choice.
    Name(&'static str),
    /// Nothing: an empty list, or no bound.
    Nothing,
}

/// A value of an option, as a default of the schema and for the check of its range.
pub(crate) trait OptionValue {
    /// The same for every language.
    fn shown(&self) -> OptionDefault;
}

impl OptionValue for f64 {
    fn shown(&self) -> OptionDefault {
        OptionDefault::Number(*self)
    }
}

impl OptionValue for usize {
    fn shown(&self) -> OptionDefault {
        OptionDefault::Number(*self as f64)
    }
}

impl OptionValue for bool {
    fn shown(&self) -> OptionDefault {
        OptionDefault::Flag(*self)
    }
}

impl<T: OptionValue> OptionValue for Option<T> {
    fn shown(&self) -> OptionDefault {
        self.as_ref().map_or(OptionDefault::Nothing, T::shown)
    }
}

impl<T> OptionValue for Vec<T> {
    fn shown(&self) -> OptionDefault {
        OptionDefault::Nothing
    }
}

/// The number of a value, for the check of its range; None: there is nothing to be checked.
pub(crate) fn number(value: &impl OptionValue) -> Option<f64> {
    match value.shown() {
        OptionDefault::Number(number) => Some(number),
        _ => None,
    }
}

/// The [`OptionKind`](crate::OptionKind) of an option by its word.
macro_rules! option_kind {
    (real $unit:literal) => {
        $crate::OptionKind::Real($unit)
    };
    (count $unit:literal) => {
        $crate::OptionKind::Count($unit)
    };
    (small_count $unit:literal) => {
        $crate::OptionKind::SmallCount($unit)
    };
    (flag) => {
        $crate::OptionKind::Flag
    };
    (choice $of:literal) => {
        $crate::OptionKind::Choice($of)
    };
    (indices $per_row:literal) => {
        $crate::OptionKind::Indices($per_row)
    };
    (with $of:literal) => {
        $crate::OptionKind::Struct($of)
    };
    (elsewhere) => {
        $crate::OptionKind::Elsewhere
    };
}
pub(crate) use option_kind;

/// The name of an option: that of the field, unless another one is said.
macro_rules! option_name {
    ($field:ident) => {
        stringify!($field)
    };
    ($field:ident $name:literal) => {
        $name
    };
}
pub(crate) use option_name;

/// The value of an option as the schema shows it; one that is set elsewhere shows nothing.
macro_rules! option_default {
    (elsewhere $value:expr) => {
        $crate::OptionDefault::Nothing
    };
    (with $value:expr) => {
        $crate::OptionDefault::Nothing
    };
    ($kind:ident $value:expr) => {
        $crate::support::options::OptionValue::shown($value)
    };
}
pub(crate) use option_default;

/// Refuses a value out of its range.
macro_rules! option_check {
    ($name:expr, $value:expr) => {};
    ($name:expr, $value:expr, $range:expr, $said:literal) => {
        if let Some(number) = $crate::support::options::number($value) {
            $crate::support::error::Error::check_option($name, number, ($range).contains(&number), $said)?;
        }
    };
}
pub(crate) use option_check;

/// Defines a struct of options with its defaults, its ranges and its schema. Of each option: the text, which documents the field;
/// `field "name in other languages": type = default,`, and behind it what it is (`real "unit"`, `count "of what"`, `choice "C name"`, ...),
/// the range of its numbers and the range in words.
macro_rules! options {
    ($(#[$of:meta])* $type:ident {
        $(
            $(#[doc = $text:literal])*
            $field:ident $($name:literal)?: $of_type:ty = $default:expr,
            $kind:ident $($detail:literal)? $(in $range:expr, $said:literal)?;
        )*
    }) => {
        $(#[$of])*
        pub struct $type {
            $($(#[doc = $text])* pub $field: $of_type,)*
        }

        impl Default for $type {
            fn default() -> Self {
                Self { $($field: $default,)* }
            }
        }

        impl $type {
            /// Every option as all languages declare it.
            pub fn schema() -> Vec<$crate::OptionEntry> {
                let default = Self::default();
                vec![$($crate::OptionEntry {
                    name: $crate::support::options::option_name!($field $($name)?),
                    field: stringify!($field),
                    text: [$($text),*].concat().trim().to_owned(),
                    kind: $crate::support::options::option_kind!($kind $($detail)?),
                    range: concat!($($said)?),
                    default: $crate::support::options::option_default!($kind &default.$field),
                }),*]
            }

            /// Checks the ranges of single numbers.
            fn check_ranges(&self) -> Result<(), $crate::support::error::Error> {
                $($crate::support::options::option_check!(
                    $crate::support::options::option_name!($field $($name)?),
                    &self.$field $(, $range, $said)?
                );)*
                Ok(())
            }
        }
    };
}
pub(crate) use options;
