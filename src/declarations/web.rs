//! What the npm package repeats of the C interface: `abi.ts` of `src/capi`, with the places of all fields in WebAssembly's memory,
//! where pointers and sizes have four bytes.

use std::collections::BTreeMap;
use std::fmt::Write;

use syn::{FnArg, Item, Type};

use fairmesh::OptionKind;

use crate::options;
use crate::python::{constant, constants, is_c_name, is_opaque, last_name, number};
use crate::records::{self, Field, Record, doc};

const HEAD: &str = "/**
 * The C interface in WebAssembly's memory: numbers of enumerations, places of fields, arguments of functions, and the types of what is read.
 * Made of src/capi by src/declarations when the package is built.
 */

";

/// Structs that programs read, and so have types for.
const READ: [&str; 16] = [
    "report",
    "component",
    "attempt",
    "continuity",
    "sharpEdge",
    "creaseEnd",
    "info",
    "loop",
    "joinSuggestion",
    "fillReport",
    "bridgeReport",
    "crease",
    "bump",
    "progress",
    "frame",
    "bulgeRange",
];

/// Structs whose plain fields programs set by name.
const SET: [&str; 5] = [
    "options",
    "fillOptions",
    "bridgeOptions",
    "roundOptions",
    "remeshOptions",
];

/// The text of `abi.ts`.
pub fn declarations(items: &[Item]) -> String {
    let mut made = HEAD.to_owned();
    constants(&mut made, items, ["export const ", ";"]);
    enumerations(&mut made, items);
    structures(&mut made, items);
    rows(&mut made);
    functions(&mut made, items);
    made
}

/// Options that are lists: how many indices a row has.
fn rows(made: &mut String) {
    let structs: Vec<_> = options::all()
        .iter()
        .map(|of| {
            let lists = of.entries().into_iter().filter_map(|entry| match entry.kind {
                OptionKind::Indices(width) => Some((camel(entry.name), width, entry.text.clone())),
                _ => None,
            });
            (camel(of.name), lists.collect::<Vec<_>>())
        })
        .filter(|(_, lists)| !lists.is_empty())
        .collect();
    made.push_str("\n/** Options that are lists of indices, side by side in rows of so many. */\nexport const rows = {\n");
    for (name, lists) in &structs {
        let widths: Vec<String> = lists
            .iter()
            .map(|(list, width, _)| format!("{list}: {width}"))
            .collect();
        let _ = writeln!(made, "    {name}: {{ {} }},", widths.join(", "));
    }
    made.push_str("} as const;\n");
    for (name, lists) in &structs {
        let _ = write!(
            made,
            "\n/** The lists of {name}: rows, or indices one after the other. */\nexport interface Rows{} {{\n",
            pascal(name)
        );
        for (list, _, text) in lists {
            let _ = writeln!(
                made,
                "    /** {text} */\n    {list}?: ArrayLike<number> | readonly (readonly number[])[] | undefined;"
            );
        }
        made.push_str("}\n");
    }
}

/// `fairmesh_fill_outcome`: `fillOutcome`; `h_inside`: `hInside`.
fn camel(name: &str) -> String {
    let mut made = String::new();
    let mut upper = false;
    for c in name.strip_prefix("fairmesh_").unwrap_or(name).chars() {
        match c {
            '_' => upper = true,
            _ if upper => {
                made.push(c.to_ascii_uppercase());
                upper = false;
            }
            _ => made.push(c),
        }
    }
    made
}

fn pascal(camel: &str) -> String {
    camel[..1].to_uppercase() + &camel[1..]
}

/// What is said about something, in the words of JavaScript.
fn words(text: &str) -> String {
    let is_name = |part: &str| {
        part.chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
    };
    let parts: Vec<String> = text
        .split('`')
        .enumerate()
        .map(|(k, part)| match k % 2 {
            1 if is_name(part) => camel(part),
            _ => part.to_owned(),
        })
        .collect();
    parts.join("`").replace("NULL", "null")
}

fn enumerations(made: &mut String, items: &[Item]) {
    made.push_str("\n/** Numbers of the C interface by the names that stand for them here. */\nexport const enums = {\n");
    let mut types = String::new();
    for item in items {
        let Item::Enum(item) = item else { continue };
        let name = item.ident.to_string();
        if !is_c_name(&name) {
            continue;
        }
        let name = camel(&name);
        let _ = writeln!(made, "    {name}: {{");
        let _ = write!(
            types,
            "\n/** {} */\nexport type {} = keyof typeof enums.{name};\n",
            words(&doc(&item.attrs)),
            pascal(&name)
        );
        for variant in &item.variants {
            let (_, value) = variant.discriminant.as_ref().expect("numbers are written out");
            let key = constant(&variant.ident.to_string()).to_lowercase();
            let _ = writeln!(
                made,
                "        /** {} */\n        {key}: {},",
                words(&doc(&variant.attrs)),
                number(value)
            );
        }
        made.push_str("    },\n");
    }
    made.push_str("} as const;\n");
    made.push_str(&types);
}

/// `usize`: `size`; `fairmesh_fill_outcome`: `fillOutcome`.
fn kind(field: &Field) -> String {
    match field.kind.as_str() {
        "usize" => "size".to_owned(),
        other => camel(other),
    }
}

/// Sizes and alignments, by the rules of C for WebAssembly with 32 bits.
struct Layouts<'a> {
    structs: &'a [Record],
    known: BTreeMap<String, (usize, usize)>,
}

impl Layouts<'_> {
    fn of(&mut self, kind: &str) -> (usize, usize) {
        match kind {
            "u64" | "f64" | "orNone" => return (8, 8),
            "chars" => return (1, 1),
            _ => {}
        }
        if !is_struct(self.structs, kind) {
            return (4, 4);
        }
        if let Some(known) = self.known.get(kind) {
            return *known;
        }
        let found = self.places(kind).1;
        self.known.insert(kind.to_owned(), found);
        found
    }

    /// Where the fields of a struct are, and its size and alignment.
    fn places(&mut self, name: &str) -> (Vec<usize>, (usize, usize)) {
        let structs = self.structs;
        let record = structs.iter().find(|s| camel(&s.name) == name).expect("a struct");
        let (mut end, mut largest) = (0_usize, 1);
        let mut places = Vec::new();
        for field in &record.fields {
            let (size, align) = self.of(&kind(field));
            end = end.next_multiple_of(align);
            places.push(end);
            end += size * field.count;
            largest = largest.max(align);
        }
        (places, (end.next_multiple_of(largest), largest))
    }
}

fn structures(made: &mut String, items: &[Item]) {
    let structs = records::all(items);
    let mut layouts = Layouts {
        structs: &structs,
        known: BTreeMap::new(),
    };
    made.push_str(
        "\n/** Structs: their sizes, and of each field its place, what it is, and of arrays how many it has. */\nexport const structs = {\n",
    );
    for Record { name, fields, .. } in &structs {
        let name = camel(name);
        let (places, (size, align)) = layouts.places(&name);
        let _ = writeln!(
            made,
            "    {name}: {{\n        size: {size},\n        align: {align},\n        fields: {{"
        );
        for (field, at) in fields.iter().zip(places) {
            let count = if field.count > 1 {
                format!(", {}", field.count)
            } else {
                String::new()
            };
            let _ = writeln!(
                made,
                "            {}: [{at}, \"{}\"{count}],",
                camel(&field.name),
                kind(field)
            );
        }
        made.push_str("        },\n    },\n");
    }
    made.push_str("} as const;\n");
    for Record { name, doc, fields } in &structs {
        let name = camel(name);
        if READ.contains(&name.as_str()) {
            let said = words(doc);
            let _ = write!(made, "\n/** {said} */\nexport interface {} {{\n", pascal(&name));
            fields.iter().for_each(|field| property(made, field, "", ""));
            made.push_str("}\n");
        } else if SET.contains(&name.as_str()) {
            let _ = write!(
                made,
                "\n/** The plain ones of {name}. */\nexport interface Plain{} {{\n",
                pascal(&name)
            );
            let plain = |field: &&Field| !is_struct(&structs, &kind(field)) && field.kind != "pointer";
            fields
                .iter()
                .filter(plain)
                .for_each(|field| property(made, field, "?", " | undefined"));
            made.push_str("}\n");
        }
    }
}

fn is_struct(structs: &[Record], kind: &str) -> bool {
    structs.iter().any(|s| camel(&s.name) == kind)
}

fn property(made: &mut String, field: &Field, optional: &str, or: &str) {
    if !field.is_told() {
        return;
    }
    let of = match (field.kind.as_str(), field.count) {
        ("u32" | "u64" | "usize" | "f64", 1) => "number".to_owned(),
        ("f64", count) => format!("[{}]", vec!["number"; count].join(", ")),
        ("or_none", _) => "number | null".to_owned(),
        ("flag", _) => "boolean".to_owned(),
        ("text" | "chars", _) => "string".to_owned(),
        ("status", _) => "Status | null".to_owned(),
        (other, _) => pascal(&camel(other)),
    };
    let said = words(&field.said());
    let _ = writeln!(
        made,
        "    /** {said} */\n    {}{optional}: {of}{or};",
        camel(&field.name)
    );
}

fn functions(made: &mut String, items: &[Item]) {
    made.push_str("\n/** What functions take: structs by their addresses, results by the address of their place. */\nexport const functions = {\n");
    for item in items {
        let Item::Fn(item) = item else { continue };
        let name = item.sig.ident.to_string();
        if !is_c_name(&name) || item.sig.abi.is_none() {
            continue;
        }
        let parameters: Vec<String> = item
            .sig
            .inputs
            .iter()
            .map(|input| match input {
                FnArg::Typed(input) => format!("\"{}\"", parameter(&input.ty)),
                FnArg::Receiver(_) => panic!("C has no receivers"),
            })
            .collect();
        let _ = writeln!(made, "    {name}: [{}],", parameters.join(", "));
    }
    made.push_str("} as const;\n");
}

fn parameter(of: &Type) -> String {
    let Type::Ptr(pointer) = of else {
        return match last_name(of).as_str() {
            "usize" => "size".to_owned(),
            "fairmesh_log_fn" => "pointer".to_owned(),
            other => other.to_owned(),
        };
    };
    let to = last_name(&pointer.elem);
    if to.starts_with("fairmesh_") && !is_opaque(&to) {
        camel(&to)
    } else {
        "pointer".to_owned()
    }
}
