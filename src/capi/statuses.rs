//! What only the C interface has of the tables: the statuses beside those of [`fairmesh::Error`], the reason that is none, and the
//! place that is no part of space but all of it.

use fairmesh::{Entry, table_entry};

/// As the library's tables are written: number, name, text and remedy.
macro_rules! entries {
    ($($number:literal $name:literal => $text:literal, $remedy:literal;)*) => {
        &[$(table_entry!($number, $name, $text, $remedy)),*]
    };
}

pub(crate) const STATUSES: &[Entry] = entries! {
    0 "ok" => "done", "";
    1 "null_pointer" => "a pointer is NULL that may not be", "";
    2 "misaligned" => "a pointer or a stride does not have the alignment of what it points to", "";
    3 "bad_struct_size" => "struct_size is not one that this library knows",
        "set it to the size of the struct, or use a library as new as the header";
    5 "bad_enum" => "a number is not one of the enumeration that is meant", "";
    6 "bad_stride" => "a stride is smaller than what it steps over", "";
    7 "count_overflow" => "a count times its stride exceeds the address space", "";
    9 "aliasing" => "an output overlaps an input or another output",
        "only positions may be written over those that were read, with the same address, stride and scalar";
    10 "bad_handle" => "not a living handle of the kind that is meant: never made, or freed before", "";
    11 "busy" => "the handle is in use: by another thread, or by the call whose callback this call comes from",
        "wait until that call has returned";
    12 "out_of_memory" => "memory ran out; everything that the call had allocated is free again, and a solver stays usable",
        "select a smaller region, or close other programs";
    29 "not_available" => "the result has nothing of this kind, or nothing with this index", "";
    30 "buffer_too_small" => "the buffer is too small; the size needed has been told", "";
    31 "bad_reserved" => "a number is not what this version asks for: reserved fields have to be zero", "";
    38 "no_fair_patch" => "deleted and filled, a region gets no fair patch that intersects nothing, or it cannot be deleted, or the run was stopped",
        "remesh the region, or fair it as it is; or erase it, and fill the holes with what there is";
    42 "cancelled" => "the callback has stopped the call, which has no result then", "";
    99 "internal" => "a bug of fairmesh, caught; the handle, if there was one, answers so from now on",
        "free the handle, and report the bug";
};

/// In place of a reason: there is none.
pub(crate) const NONE: Entry = table_entry!(0, "none", "there is nothing to say", "");

/// In place of a part of space: all of it.
#[allow(dead_code, reason = "of the C interface only the numbers are made of it")]
pub(crate) const EVERYWHERE: Entry = table_entry!(0, "everywhere", "anywhere", "");
