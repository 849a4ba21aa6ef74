//! What the npm package repeats of the C interface: `abi.ts` of `src/capi`, with the places of all fields in WebAssembly's memory,
//! where pointers and sizes have four bytes.

use std::collections::BTreeMap;
use std::fmt::Write;

use syn::{Attribute, Expr, Fields, FnArg, Item, Lit, Meta, Type};

use fairmesh::OptionKind;

use crate::options;
use crate::python::{constant, is_c_name, is_opaque, last_name, number};

const HEAD: &str = "/**
 * The C interface in WebAssembly's memory: numbers of enumerations, places of fields, arguments of functions, and the types of what is read.
 * Made of src/capi by src/declarations when the package is built.
 */

";

/// Structs that programs read, and so have types for.
const READ: [&str; 14] = [
    "report",
    "component",
    "attempt",
    "continuity",
    "level",
    "info",
    "loop",
    "joinSuggestion",
    "fillReport",
    "bridgeReport",
    "bump",
    "progress",
    "frame",
    "bulgeRange",
];

/// Structs whose plain fields programs set by name.
const SET: [&str; 4] = ["options", "fillOptions", "bridgeOptions", "remeshOptions"];

/// 64 bits that may say that there is nothing.
const MAY_BE_NONE: [&str; 7] = [
    "worst_triangle",
    "normal_deviation_vertex",
    "boundary_kink_vertex",
    "reason_element",
    "reason_other",
    "element",
    "other",
];

/// A field: its name, its kind in `abi.ts`, how many of it, and what is said about it.
struct Field {
    name: String,
    kind: String,
    count: usize,
    doc: String,
}

/// The text of `abi.ts`.
pub fn declarations(items: &[Item]) -> String {
    let mut made = HEAD.to_owned();
    versions(&mut made, items);
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

fn versions(made: &mut String, items: &[Item]) {
    for item in items {
        if let Item::Const(item) = item
            && let Some(part) = item.ident.to_string().strip_prefix("FAIRMESH_VERSION_")
        {
            let _ = writeln!(made, "export const VERSION_{part} = {};", number(&item.expr));
        }
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

/// What is said about an item, in the words of JavaScript.
fn doc(attributes: &[Attribute]) -> String {
    let mut lines = Vec::new();
    for attribute in attributes {
        if let Meta::NameValue(pair) = &attribute.meta
            && pair.path.is_ident("doc")
            && let Expr::Lit(literal) = &pair.value
            && let Lit::Str(text) = &literal.lit
        {
            lines.push(text.value().trim().to_owned());
        }
    }
    let text = lines.join(" ");
    let text = text.replace(" Set `struct_size` before the call.", "");
    let parts: Vec<String> = text
        .split('`')
        .enumerate()
        .map(|(k, part)| match k % 2 {
            1 if part
                .chars()
                .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_') =>
            {
                camel(part)
            }
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
            doc(&item.attrs),
            pascal(&name)
        );
        for variant in &item.variants {
            let (_, value) = variant.discriminant.as_ref().expect("numbers are written out");
            let key = constant(&variant.ident.to_string()).to_lowercase();
            let _ = writeln!(
                made,
                "        /** {} */\n        {key}: {},",
                doc(&variant.attrs),
                number(value)
            );
        }
        made.push_str("    },\n");
    }
    made.push_str("} as const;\n");
    made.push_str(&types);
}

fn kind(field: &syn::Field) -> (String, usize) {
    let name = field.ident.as_ref().expect("named").to_string();
    let said = doc(&field.attrs);
    match &field.ty {
        Type::Ptr(pointer) if last_name(&pointer.elem) == "c_char" => ("text".to_owned(), 1),
        Type::Ptr(_) => ("pointer".to_owned(), 1),
        Type::Array(array) => {
            let count = number(&array.len).parse().expect("a length");
            match last_name(&array.elem).as_str() {
                "c_char" => ("chars".to_owned(), count),
                "f64" => ("f64".to_owned(), count),
                other => panic!("an array of {other}"),
            }
        }
        of => {
            let plain = match last_name(of).as_str() {
                _ if name == "status" || name == "refused_status" => "status".to_owned(),
                "u32" if name == "gap_kind" => "gapKind".to_owned(),
                "u32" if said.starts_with("Not 0") => "flag".to_owned(),
                "u32" => match said.strip_prefix("A `").and_then(|rest| rest.split_once('`')) {
                    Some((named, _)) => named.to_owned(),
                    None => "u32".to_owned(),
                },
                "u64" if MAY_BE_NONE.contains(&name.as_str()) => "orNone".to_owned(),
                "usize" => "size".to_owned(),
                "fairmesh_progress_fn" => "pointer".to_owned(),
                other => camel(other),
            };
            (plain, 1)
        }
    }
}

fn fields_of(item: &Item) -> Option<(String, String, Vec<Field>)> {
    let Item::Struct(item) = item else { return None };
    let name = item.ident.to_string();
    let Fields::Named(fields) = &item.fields else {
        return None;
    };
    if !is_c_name(&name) || is_opaque(&name) {
        return None;
    }
    let fields = fields
        .named
        .iter()
        .map(|field| {
            let (kind, count) = kind(field);
            Field {
                name: field.ident.as_ref().expect("named").to_string(),
                kind,
                count,
                doc: doc(&field.attrs),
            }
        })
        .collect();
    Some((camel(&name), doc(&item.attrs), fields))
}

/// Sizes and alignments, by the rules of C for WebAssembly with 32 bits.
struct Layouts<'a> {
    structs: &'a [(String, String, Vec<Field>)],
    known: BTreeMap<String, (usize, usize)>,
}

impl Layouts<'_> {
    fn of(&mut self, kind: &str) -> (usize, usize) {
        match kind {
            "u64" | "f64" | "orNone" => return (8, 8),
            "chars" => return (1, 1),
            _ => {}
        }
        if !self.structs.iter().any(|s| s.0 == kind) {
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
        let (_, _, fields) = structs.iter().find(|s| s.0 == name).expect("a struct");
        let (mut end, mut largest) = (0_usize, 1);
        let mut places = Vec::new();
        for field in fields {
            let (size, align) = self.of(&field.kind);
            end = end.next_multiple_of(align);
            places.push(end);
            end += size * field.count;
            largest = largest.max(align);
        }
        (places, (end.next_multiple_of(largest), largest))
    }
}

fn structures(made: &mut String, items: &[Item]) {
    let structs: Vec<_> = items.iter().filter_map(fields_of).collect();
    let mut layouts = Layouts {
        structs: &structs,
        known: BTreeMap::new(),
    };
    made.push_str(
        "\n/** Structs: their sizes, and of each field its place, what it is, and of arrays how many it has. */\nexport const structs = {\n",
    );
    for (name, _, fields) in &structs {
        let (places, (size, align)) = layouts.places(name);
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
                field.kind
            );
        }
        made.push_str("        },\n    },\n");
    }
    made.push_str("} as const;\n");
    for (name, said, fields) in &structs {
        if READ.contains(&name.as_str()) {
            let _ = write!(made, "\n/** {said} */\nexport interface {} {{\n", pascal(name));
            fields.iter().for_each(|field| property(made, field, "", ""));
            made.push_str("}\n");
        } else if SET.contains(&name.as_str()) {
            let _ = write!(
                made,
                "\n/** The plain ones of {name}. */\nexport interface Plain{} {{\n",
                pascal(name)
            );
            let plain =
                |field: &&Field| !structs.iter().any(|s| s.0 == field.kind) && field.kind != "pointer";
            fields
                .iter()
                .filter(plain)
                .for_each(|field| property(made, field, "?", " | undefined"));
            made.push_str("}\n");
        }
    }
}

fn property(made: &mut String, field: &Field, optional: &str, or: &str) {
    if field.name == "struct_size" || field.name.starts_with("reserved") {
        return;
    }
    let of = match (field.kind.as_str(), field.count) {
        ("u32" | "u64" | "size" | "f64", 1) => "number".to_owned(),
        ("f64", count) => format!("[{}]", vec!["number"; count].join(", ")),
        ("orNone", _) => "number | null".to_owned(),
        ("flag", _) => "boolean".to_owned(),
        ("text" | "chars", _) => "string".to_owned(),
        ("status", _) => "Status | null".to_owned(),
        (other, _) => pascal(other),
    };
    let said = field
        .doc
        .strip_prefix(&format!("A `{}`: ", field.kind))
        .or_else(|| field.doc.strip_prefix("Not 0: "))
        .unwrap_or(&field.doc);
    let said = said[..1].to_uppercase() + &said[1..];
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
