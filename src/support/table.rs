//! What all languages say of a value of an enumeration: each is said once, in a table beside the enumeration.

use std::ffi::CStr;

/// One value of an enumeration, as the C interface numbers it and as every language names and explains it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Entry {
    number: u32,
    name: &'static CStr,
    text: &'static CStr,
    remedy: &'static CStr,
}

impl Entry {
    /// The number in the C interface; never reused.
    pub const fn number(&self) -> u32 {
        self.number
    }

    /// The name: lower case, words joined by `_`.
    pub const fn name(&self) -> &'static str {
        text_of(self.name)
    }

    /// What it means: English, begins in lower case, ends without a full stop.
    pub const fn text(&self) -> &'static str {
        text_of(self.text)
    }

    /// What the user can do about it, written like the text; empty if there is nothing to do.
    pub const fn remedy(&self) -> &'static str {
        text_of(self.remedy)
    }

    /// The name, ending with a NUL.
    pub const fn c_name(&self) -> &'static CStr {
        self.name
    }

    /// The text, ending with a NUL.
    pub const fn c_text(&self) -> &'static CStr {
        self.text
    }

    /// The remedy, ending with a NUL.
    pub const fn c_remedy(&self) -> &'static CStr {
        self.remedy
    }

    /// All texts end with a NUL and have no other.
    #[doc(hidden)]
    pub const fn new(number: u32, name: &'static str, text: &'static str, remedy: &'static str) -> Self {
        Self {
            number,
            name: terminated(name),
            text: terminated(text),
            remedy: terminated(remedy),
        }
    }
}

const fn terminated(text: &'static str) -> &'static CStr {
    match CStr::from_bytes_with_nul(text.as_bytes()) {
        Ok(text) => text,
        Err(_) => panic!("one NUL, at the end"),
    }
}

const fn text_of(text: &'static CStr) -> &'static str {
    match text.to_str() {
        Ok(text) => text,
        Err(_) => panic!("tables are written in UTF-8"),
    }
}

/// An [`Entry`](crate::Entry) of literals.
#[doc(hidden)]
#[macro_export]
macro_rules! table_entry {
    ($number:literal, $name:literal, $text:literal, $remedy:literal) => {
        $crate::Entry::new(
            $number,
            concat!($name, "\0"),
            concat!($text, "\0"),
            concat!($remedy, "\0"),
        )
    };
}

/// Gives an enumeration its table: `number "name" pattern => "text", "remedy";` for each value.
macro_rules! table {
    ($type:ident { $($number:literal $name:literal $pattern:pat => $text:literal, $remedy:literal;)* }) => {
        impl $type {
            /// All values, by their numbers in the C interface.
            pub const TABLE: &'static [$crate::Entry] =
                &[$($crate::table_entry!($number, $name, $text, $remedy)),*];

            /// Number, name, text and remedy of this value.
            pub const fn entry(&self) -> &'static $crate::Entry {
                match self {
                    $($pattern => const { &$crate::table_entry!($number, $name, $text, $remedy) },)*
                }
            }

            /// A stable name: lower case, words joined by `_`.
            pub const fn name(&self) -> &'static str {
                self.entry().name()
            }
        }

        impl $crate::support::options::OptionValue for $type {
            fn shown(&self) -> $crate::OptionDefault {
                $crate::OptionDefault::Name(self.name())
            }
        }
    };
}
pub(crate) use table;

/// Defines an enumeration without data, and its table; the texts document the values.
macro_rules! choices {
    ($(#[$of:meta])* $type:ident {
        $($(#[$meta:meta])* $number:literal $name:literal $value:ident => $text:literal, $remedy:literal;)*
    }) => {
        $(#[$of])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum $type {
            $(#[doc = $text] $(#[$meta])* $value,)*
        }

        $crate::support::table::table!($type {
            $($number $name $type::$value => $text, $remedy;)*
        });

        impl $type {
            /// The value with this number.
            pub fn from_number(number: u32) -> Option<Self> {
                match number {
                    $($number => Some(Self::$value),)*
                    _ => None,
                }
            }
        }
    };
}
pub(crate) use choices;
