//! What the Python package repeats of the C interface: `_abi.py` of `src/capi`, `_enums.py` of the tables.

use std::collections::BTreeSet;
use std::fmt::Write;

use syn::{Expr, Fields, FnArg, Item, Lit, ReturnType, Type, UnOp};

use fairmesh::{Entry, Error, Outcome};

use crate::tables::{self, sentence, variant};

const ABI_HEAD: &str = r#""""The C interface, declared: every enumeration, struct and function of ``include/fairmesh.h``, under its C name.

Made of src/capi by src/declarations when the package is built.
"""

from __future__ import annotations

import enum
from ctypes import (
    CFUNCTYPE,
    POINTER,
    Structure,
    c_char,
    c_char_p,
    c_double,
    c_int32,
    c_int64,
    c_size_t,
    c_uint32,
    c_uint64,
    c_void_p,
)
from typing import Any

NO_ELEMENT = 2**64 - 1
"#;

const ENUMS_HEAD: &str = r#""""What the library answers with. Made of the library's tables by src/declarations when the package is built."""

# ruff: noqa: E501
from __future__ import annotations

from ._named import Named, Numbered
"#;

/// The text of `_abi.py`.
pub fn declarations(items: &[Item]) -> String {
    let mut made = ABI_HEAD.to_owned();
    constants(&mut made, items, [""; 2]);
    items.iter().for_each(|item| enumeration(&mut made, item));
    let mut known = BTreeSet::new();
    items
        .iter()
        .for_each(|item| structure(&mut made, item, items, &mut known));
    made.push_str("\n\nfairmesh_log_fn = CFUNCTYPE(None, c_char_p, c_void_p)\n");
    made.push_str("\n\n# A function's name: what it returns, and its parameters. Handles, and arrays in parameters, are plain addresses.\nFUNCTIONS: dict[str, tuple[Any, tuple[Any, ...]]] = {\n");
    items.iter().for_each(|item| function(&mut made, item));
    made.push_str("}\n");
    made
}

/// The text of `_enums.py`.
pub fn enumerations() -> String {
    let mut made = ENUMS_HEAD.to_owned();
    let all = tables::all();
    // What lies between loops is a word in Python.
    let told = all
        .iter()
        .filter(|t| t.has_texts && t.name != "fairmesh_gap_kind");
    for table in told {
        let class = class_of(table.name);
        let base = if class == "Status" { "Numbered" } else { "Named" };
        let doc = table.doc.replace("`fairmesh_outcome`", "`Outcome`");
        let doc = doc.replace("`fairmesh_error`", "error");
        let _ = write!(made, "\n\nclass {class}({base}):\n    \"\"\"{doc}\"\"\"\n\n");
        for entry in &table.entries {
            let texts = [entry.name(), entry.text(), entry.remedy()];
            member(&mut made, entry.number(), texts, base);
        }
        if base != "Numbered" {
            let text = "a value that this version of the package does not know";
            member(&mut made, u32::MAX, ["other", text, ""], base);
        }
        match class.as_str() {
            "Outcome" => successes(&mut made),
            "Status" => refusals_of_input(&mut made),
            _ => {}
        }
    }
    made
}

/// The class of an enumeration: `fairmesh_fill_outcome` is `FillOutcome`.
pub(crate) fn class_of(name: &str) -> String {
    variant(name.trim_start_matches("fairmesh_"))
}

/// Which outcomes are successes, as `fairmesh::Outcome::is_success` says it.
fn successes(made: &mut String) {
    let outcomes = tables::outcomes();
    let names = outcomes
        .iter()
        .filter(|outcome| outcome.is_success())
        .map(Outcome::name);
    let doc = "Whether the tolerance is met and the surface is sound, without reservation.";
    question(made, "is_success", doc, "Outcome", names);
}

/// Which statuses blame what was given: all errors of the library but one, and a number of C's enumerations that is none.
fn refusals_of_input(made: &mut String) {
    let errors = Error::TABLE
        .iter()
        .map(Entry::name)
        .filter(|name| *name != "threads");
    let doc = "Whether the mesh, the selection, a normal or an option is wrong.";
    question(made, "is_input_error", doc, "Status", errors.chain(["bad_enum"]));
}

/// A property that some members have.
fn question<'a>(
    made: &mut String,
    name: &str,
    doc: &str,
    class: &str,
    members: impl Iterator<Item = &'a str>,
) {
    let members: String = members
        .map(|member| format!("{class}.{}, ", member.to_uppercase()))
        .collect();
    let _ = write!(
        made,
        "\n    @property\n    def {name}(self) -> bool:\n        \"\"\"{doc}\"\"\"\n        return self in ({})\n",
        members.trim_end()
    );
}

fn member(made: &mut String, number: u32, [name, text, remedy]: [&str; 3], base: &str) {
    let constant = name.to_uppercase();
    let name = match base {
        "Numbered" => String::new(),
        _ => format!("        \"{name}\",\n"),
    };
    let doc = sentence(text);
    let _ = write!(
        made,
        "    #: {doc}\n    {constant} = (\n        {number},\n{name}        {text:?},\n        {remedy:?},\n    )\n"
    );
}

pub(crate) fn is_c_name(name: &str) -> bool {
    name.starts_with("fairmesh_") && !name.starts_with("fairmesh_test_")
}

pub(crate) fn number(expression: &Expr) -> String {
    match expression {
        Expr::Lit(literal) => match &literal.lit {
            Lit::Int(number) => number.base10_digits().to_owned(),
            Lit::Float(number) => number.base10_digits().to_owned(),
            _ => panic!("a number is needed"),
        },
        Expr::Unary(negative) if matches!(negative.op, UnOp::Neg(_)) => {
            format!("-{}", number(&negative.expr))
        }
        _ => panic!("a literal is needed"),
    }
}

/// The numbers that have names: the version, and values of options.
pub(crate) fn constants(made: &mut String, items: &[Item], [before, after]: [&str; 2]) {
    for item in items {
        let Item::Const(item) = item else { continue };
        let name = item.ident.to_string();
        match name.strip_prefix("FAIRMESH_") {
            Some(name) if name != "NO_ELEMENT" => {
                let _ = writeln!(made, "{before}{name} = {}{after}", number(&item.expr));
            }
            _ => {}
        }
    }
}

fn enumeration(made: &mut String, item: &Item) {
    let Item::Enum(item) = item else { return };
    let name = item.ident.to_string();
    if !is_c_name(&name) {
        return;
    }
    let _ = write!(made, "\n\nclass {name}(enum.IntEnum):\n");
    for variant in &item.variants {
        let (_, value) = variant.discriminant.as_ref().expect("numbers are written out");
        let _ = writeln!(
            made,
            "    {} = {}",
            constant(&variant.ident.to_string()),
            number(value)
        );
    }
}

/// `FreeMask`: `FREE_MASK`; `Float32`: `FLOAT32`.
pub(crate) fn constant(variant: &str) -> String {
    let mut made = String::new();
    for c in variant.chars() {
        if c.is_ascii_uppercase() && !made.is_empty() {
            made.push('_');
        }
        made.push(c.to_ascii_uppercase());
    }
    made
}

/// A struct, and before it those that it is made of.
fn structure(made: &mut String, item: &Item, items: &[Item], known: &mut BTreeSet<String>) {
    let Item::Struct(item) = item else { return };
    let name = item.ident.to_string();
    let Fields::Named(fields) = &item.fields else {
        return;
    };
    if !is_c_name(&name) || known.contains(&name) || is_opaque(&name) {
        return;
    }
    for field in &fields.named {
        let of = last_name(&field.ty);
        let needed = items
            .iter()
            .find(|i| matches!(i, Item::Struct(s) if s.ident == of));
        if let Some(needed) = needed {
            structure(made, needed, items, known);
        }
    }
    let _ = write!(made, "\n\nclass {name}(Structure):\n    _fields_ = (\n");
    for field in &fields.named {
        let field_name = field.ident.as_ref().expect("named");
        let _ = writeln!(made, "        (\"{field_name}\", {}),", field_type(&field.ty));
    }
    made.push_str("    )\n");
    if name == "fairmesh_progress" {
        made.push_str(
            "\n\nfairmesh_progress_fn = CFUNCTYPE(c_int32, POINTER(fairmesh_progress), c_void_p)\n",
        );
    }
    known.insert(name);
}

pub(crate) fn is_opaque(name: &str) -> bool {
    matches!(name, "fairmesh_solver" | "fairmesh_result")
}

pub(crate) fn last_name(of: &Type) -> String {
    match of {
        Type::Path(path) => path.path.segments.last().expect("a name").ident.to_string(),
        _ => String::new(),
    }
}

fn plain(name: &str) -> String {
    match name {
        "u32" => "c_uint32",
        "i32" | "fairmesh_status" => "c_int32",
        "u64" => "c_uint64",
        "i64" => "c_int64",
        "usize" => "c_size_t",
        "f64" => "c_double",
        "c_char" => "c_char",
        other => other,
    }
    .to_owned()
}

fn field_type(of: &Type) -> String {
    match of {
        Type::Ptr(pointer) if last_name(&pointer.elem) == "c_char" => "c_char_p".to_owned(),
        Type::Ptr(_) => "c_void_p".to_owned(),
        Type::Array(array) => format!("{} * {}", plain(&last_name(&array.elem)), number(&array.len)),
        other => plain(&last_name(other)),
    }
}

fn function(made: &mut String, item: &Item) {
    let Item::Fn(item) = item else { return };
    let name = item.sig.ident.to_string();
    if !is_c_name(&name) || item.sig.abi.is_none() {
        return;
    }
    let result = match &item.sig.output {
        ReturnType::Type(_, of) => field_type(of),
        ReturnType::Default => "None".to_owned(),
    };
    let parameters: Vec<String> = item
        .sig
        .inputs
        .iter()
        .map(|input| match input {
            FnArg::Typed(input) => parameter_type(&input.ty),
            FnArg::Receiver(_) => panic!("C has no receivers"),
        })
        .collect();
    let parameters: String = parameters.iter().map(|of| format!("{of}, ")).collect();
    let _ = writeln!(made, "    \"{name}\": ({result}, ({parameters})),");
}

fn parameter_type(of: &Type) -> String {
    let Type::Ptr(pointer) = of else {
        return plain(&last_name(of));
    };
    if let Type::Ptr(inner) = &*pointer.elem {
        assert!(is_opaque(&last_name(&inner.elem)));
        return "POINTER(c_void_p)".to_owned();
    }
    match last_name(&pointer.elem).as_str() {
        "c_char" => "c_char_p".to_owned(),
        "c_void" | "u32" => "c_void_p".to_owned(),
        name if is_opaque(name) => "c_void_p".to_owned(),
        name => format!("POINTER({})", plain(name)),
    }
}
