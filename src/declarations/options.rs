//! The option structs of the C interface, made of the library's schemas: `src/capi/option_structs.rs`.

use std::fmt::Write;

use fairmesh::{
    BridgeOptions, FillOptions, OptionDefault, OptionEntry, OptionKind, Options, RemeshOptions, Rim,
    RoundOptions,
};

use crate::tables::variant;

const HEAD: &str = "\
//! The options of the C interface. Made of the library's schemas by src/declarations: do not edit.

use std::ffi::c_void;

use super::callback::fairmesh_progress_fn;
use super::choices::{chosen, count};
use super::loop_choice::{fairmesh_join, fairmesh_loop_filter};
use super::status::CallResult;
use super::types::*;
use super::views::{Argument, Array, FieldPath, field, field_named, indices_in};
use fairmesh::{
    BridgeOptions, Cap, Creases, Discretization, FillOptions, InnerFairness, InteriorNormals, Intersections, OnFailure, Options, OutputPrecision,
    RemeshOptions, Rim, RoundOptions,
};
";

/// Options that have come since the structs were published stand at their ends, where zero means what was before.
const LATER: [&str; 2] = ["cap", "sharp"];

/// A struct of the C interface.
pub struct OptionStruct {
    /// Its name.
    pub name: &'static str,
    /// What it says.
    text: &'static str,
    /// The library's structs that it is made of, with their schemas.
    parts: Vec<(&'static str, Vec<OptionEntry>)>,
    /// What C has besides: name, type, text and default.
    besides: Vec<[&'static str; 4]>,
}

/// The list of all: of each struct what it says, its name, the library's structs that it is made of, and what C has besides.
macro_rules! structs {
    ($(
        #[doc = $text:literal] $name:ident: $($part:ident = $schema:expr),+ => {
            $(#[doc = $said:literal] $field:ident: $kind:ty = $default:expr;)*
        }
    )*) => {
        [$(OptionStruct {
            name: stringify!($name),
            text: $text.trim(),
            parts: vec![$((stringify!($part), $schema)),+],
            besides: vec![$([stringify!($field), stringify!($kind), $said.trim(), stringify!($default)]),*],
        }),*]
    };
}

/// All of them.
pub fn all() -> [OptionStruct; 5] {
    structs! {
        /// What is asked. Fill it by `fairmesh_options_init`, then change fields: every default exists once, in the library.
        fairmesh_options: Options = Options::schema() => {
            /// Called with the progress; may be NULL, the default.
            progress: fairmesh_progress_fn = None;
            /// Handed to `progress`.
            user_data: *mut c_void = core::ptr::null_mut();
        }
        /// What hole filling does. Fill it by `fairmesh_fill_options_init`. How patches are faired is in a `fairmesh_options`.
        fairmesh_fill_options: FillOptions = FillOptions::schema(), Rim = Rim::schema() => {
            /// Holes of more edges stay open. Default: UINT64_MAX.
            max_edges: u64 = u64::MAX;
            /// These loops only, as `fairmesh_boundary_loops` numbers them, outer boundaries included; NULL with count 0 (default): all holes. With a count, `max_edges` and `filter` are not read.
            loops: fairmesh_indices = fairmesh_indices::default();
            /// Not 0: the loops of the list `loops` only, also where it is empty: then nothing is filled but groups of loops that are joined.
            only_listed: u32 = 0;
            /// Which holes, if `loops` does not say it. All zero (default): all of them.
            filter: fairmesh_loop_filter = fairmesh_loop_filter::default();
        }
        /// What a bridge shall be. Fill it by `fairmesh_bridge_options_init`. How dense it is, and what becomes of one that is not fair, is in a `fairmesh_fill_options`.
        fairmesh_bridge_options: BridgeOptions = BridgeOptions::schema() => {}
        /// What rounding does. Fill it by `fairmesh_round_options_init`; then set `width` or `radius`. How blends are faired is in a `fairmesh_options`.
        fairmesh_round_options: RoundOptions = RoundOptions::schema() => {}
        /// What remeshing does. Fill it by `fairmesh_remesh_options_init`.
        fairmesh_remesh_options: RemeshOptions = RemeshOptions::schema() => {
            /// Called with the progress; may be NULL, the default. Where it stops the call, the status is CANCELLED.
            progress: fairmesh_progress_fn = None;
            /// Handed to `progress`.
            user_data: *mut c_void = core::ptr::null_mut();
        }
    }
}

/// The text of `src/capi/option_structs.rs`.
pub fn structs() -> String {
    let mut made = HEAD.to_owned();
    let _ = write!(
        made,
        "\n/// The value of the option `sharp` at which only edges that are certain go on, in degrees.\npub const FAIRMESH_SHARP_AUTO: f64 = {:?};\n",
        Options::SHARP_AUTO
    );
    let _ = write!(
        made,
        "\n/// The value of the option `continuity` at which curvature is continued where it is certain.\npub const FAIRMESH_CONTINUITY_AUTO: f64 = {:?};\n",
        Options::CONTINUITY_AUTO
    );
    let _ = write!(
        made,
        "\n/// The value of the option `relax_rim` at which as many rings may move as are advised.\npub const FAIRMESH_RELAX_AUTO: u64 = {};\n",
        Rim::AUTO
    );
    all().iter().for_each(|of| declaration(&mut made, of));
    made
}

impl OptionStruct {
    /// The options that C has, in their order: first those of four bytes, so that there are no gaps.
    pub fn entries(&self) -> Vec<&OptionEntry> {
        let all = self.parts.iter().flat_map(|(_, entries)| entries);
        all.filter(|entry| entry.kind != OptionKind::Elsewhere).collect()
    }

    /// Name, type, text and default of all fields but the size.
    fn fields(&self) -> Vec<[String; 4]> {
        let options = self.entries().into_iter().map(|entry| {
            [
                entry.name.to_owned(),
                c_type(entry.kind),
                c_text(entry),
                c_default(entry),
            ]
        });
        let besides = self.besides.iter().map(|field| field.map(str::to_owned));
        let (later, first): (Vec<_>, Vec<_>) = options
            .chain(besides)
            .partition(|field| LATER.contains(&field[0].as_str()));
        // The size is one more of four bytes.
        let mut fields = in_eights(first, 1);
        fields.extend(in_eights(later, 0));
        fields
    }
}

/// First those of four bytes, besides as many that are there, in pairs.
fn in_eights(fields: Vec<[String; 4]>, there: usize) -> Vec<[String; 4]> {
    let (mut small, large): (Vec<_>, Vec<_>) = fields.into_iter().partition(|field| field[1] == "u32");
    if (small.len() + there) % 2 == 1 {
        small.push(["reserved", "u32", "Zero.", "0"].map(str::to_owned));
    }
    small.extend(large);
    small
}

fn c_type(kind: OptionKind) -> String {
    match kind {
        OptionKind::Real(_) => "f64",
        OptionKind::Count(_) => "u64",
        OptionKind::SmallCount(_) | OptionKind::Flag | OptionKind::Choice(_) => "u32",
        OptionKind::Indices(_) => "fairmesh_indices",
        OptionKind::Struct(of) => of,
        OptionKind::Elsewhere => unreachable!("no field of C"),
    }
    .to_owned()
}

/// The text of an option in the words of C.
fn c_text(entry: &OptionEntry) -> String {
    let lower = || entry.text[..1].to_lowercase() + &entry.text[1..];
    match (entry.kind, entry.default) {
        (OptionKind::Choice(of), _) => format!("A `{of}`: {}", lower()),
        (OptionKind::Flag, _) => format!("Not 0: {}", lower().trim_start_matches("whether ")),
        (OptionKind::Real(_), OptionDefault::Nothing) => format!("{} 0 stands for the default.", entry.text),
        (OptionKind::Indices(2), _) => format!("{} Two indices side by side.", entry.text),
        _ => entry.text.clone(),
    }
}

fn c_default(entry: &OptionEntry) -> String {
    match (entry.default, entry.kind) {
        (OptionDefault::Name(name), OptionKind::Choice(of)) => format!("{of}::{} as u32", variant(name)),
        (OptionDefault::Number(number), OptionKind::Real(_)) if number.is_infinite() => {
            "f64::INFINITY".to_owned()
        }
        (OptionDefault::Number(number), OptionKind::Real(_)) => format!("{number:?}"),
        (OptionDefault::Number(number), _) => format!("{number}"),
        (OptionDefault::Flag(is_set), _) => u32::from(is_set).to_string(),
        (_, OptionKind::Real(_)) => "0.0".to_owned(),
        (_, kind) => format!("{}::default()", c_type(kind)),
    }
}

fn declaration(made: &mut String, of: &OptionStruct) {
    let (name, fields) = (of.name, of.fields());
    for (part, entries) in &of.parts {
        let lists = entries
            .iter()
            .filter(|entry| matches!(entry.kind, OptionKind::Indices(_)))
            .count();
        if lists > 0 {
            let _ = write!(
                made,
                "\n/// The lists of `{part}`, checked.\npub(crate) type {part}Lists = [Array; {lists}];\n"
            );
        }
    }
    let _ = write!(
        made,
        "\n/// {}\n#[repr(C)]\n#[derive(Clone, Copy)]\npub struct {name} {{\n    /// `sizeof({name})`.\n    pub struct_size: u32,\n",
        of.text
    );
    for [field, kind, text, _] in &fields {
        let _ = writeln!(made, "    /// {text}\n    pub {field}: {kind},");
    }
    let _ = write!(
        made,
        "}}\n\nimpl {name} {{\n    /// The library's defaults.\n    pub(crate) fn standard() -> Self {{\n        Self {{\n            struct_size: size_of::<Self>() as u32,\n"
    );
    for [field, _, _, default] in &fields {
        let _ = writeln!(made, "            {field}: {default},");
    }
    let names = fields.iter().map(|[field, ..]| field.as_str());
    let names: Vec<&str> = names.filter(|name| *name != "reserved").collect();
    let _ = write!(
        made,
        "        }}\n    }}\n\n    /// Where an option is in this argument.\n    pub(crate) fn place(argument: Argument, option: &str) -> Option<FieldPath> {{\n        field_named!(argument, option, Self: {})\n    }}\n",
        names.join(" ")
    );
    for (part, entries) in &of.parts {
        reading(made, part, entries);
        lists(made, part, entries);
    }
    made.push_str("}\n");
}

/// The functions that check the lists of indices, and read them.
fn lists(made: &mut String, part: &str, entries: &[OptionEntry]) {
    let lists = entries.iter().filter_map(|entry| match entry.kind {
        OptionKind::Indices(width) => Some((entry.name, entry.field, width)),
        _ => None,
    });
    let lists: Vec<_> = lists.collect();
    if lists.is_empty() {
        return;
    }
    let (mut checks, mut reads) = (String::new(), String::new());
    for (k, (name, field, width)) in lists.iter().enumerate() {
        let _ = writeln!(
            checks,
            "            indices_in(&self.{name}, {width}, field!(argument, Self.{name}))?,"
        );
        let read = match width {
            1 => "list()".to_owned(),
            _ => format!("rows::<{width}>()"),
        };
        let _ = writeln!(reads, "        into.{field} = lists[{k}].{read}?.into_owned();");
    }
    let _ = write!(
        made,
        "\n    /// The lists of indices, checked and not read.\n    pub(crate) fn lists(&self, argument: Argument) -> CallResult<{part}Lists> {{\n        Ok([\n{checks}        ])\n    }}\n\n    /// Reads them.\n    pub(crate) fn read_lists(lists: &{part}Lists, into: &mut {part}) -> CallResult {{\n{reads}        Ok(())\n    }}\n"
    );
}

/// The function that reads what needs no arrays.
fn reading(made: &mut String, part: &str, entries: &[OptionEntry]) {
    let lower: String = part
        .chars()
        .flat_map(|c| {
            if c.is_uppercase() {
                vec!['_', c.to_ascii_lowercase()]
            } else {
                vec![c]
            }
        })
        .collect();
    let lines: Vec<String> = entries.iter().filter_map(|entry| {
        let (name, field) = (entry.name, entry.field);
        let value = match (entry.kind, entry.default) {
            (OptionKind::Real(_), OptionDefault::Nothing) => format!("(self.{name} != 0.0).then_some(self.{name})"),
            (OptionKind::Real(_), _) => format!("self.{name}"),
            (OptionKind::Count(_), _) => format!("count(self.{name})"),
            (OptionKind::SmallCount(_), _) => format!("self.{name} as usize"),
            (OptionKind::Flag, _) => format!("self.{name} != 0"),
            (OptionKind::Choice(of), _) => {
                let rust = variant(of.trim_start_matches("fairmesh_"));
                format!("chosen({rust}::from_number(self.{name}), self.{name}, \"{of}\", field!(argument, Self.{name}))?")
            }
            _ => return None,
        };
        Some(format!("            {field}: {value},\n"))
    }).collect();
    let needs_argument = lines.iter().any(|line| line.contains("argument"));
    let argument = if needs_argument { "argument" } else { "_" };
    let _ = write!(
        made,
        "\n    /// What needs no arrays and has no values of its own; all else as it is by default.\n    pub(crate) fn read{lower}(&self, {argument}: Argument) -> CallResult<{part}> {{\n        Ok({part} {{\n{}            ..{part}::default()\n        }})\n    }}\n",
        lines.concat()
    );
}
