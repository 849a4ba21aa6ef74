//! `_schema.py`: the options of Python's functions, made of the library's schemas.

use std::fmt::Write;

use fairmesh::{
    BridgeOptions, FillOptions, OptionDefault, OptionEntry, OptionKind, Options, RemeshOptions, Rim,
    RoundOptions,
};

use crate::tables;

const HEAD: &str = r#""""The options of all functions, with their defaults.

Made of the library's schemas by src/declarations when the package is built.
"""

# ruff: noqa: D, E501
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, TypedDict

if TYPE_CHECKING:
    from ._forms import ArrayLike, Curvature, HowFar, LoopContinuity, Normals, Rings, Sharp, Target
"#;

/// The list of options that Python takes in another form than C: what is to be said of the form, the name, the type, the default (empty: the
/// library's).
macro_rules! forms {
    ($(#[doc = $said:literal] $name:ident: $of:literal = $default:literal;)*) => {
        [$([stringify!($name), $of, $default, $said.trim_ascii()]),*]
    };
}

const FORMS: [[&str; 4]; 8] = forms! {
    /// "fitted"; "averaged" over the faces outside; unit vectors (n, 3), zeros or NaN where none is given; or a pair (indices (k,), vectors (k, 3)). They point to the side that faces are counter-clockwise seen from. Where none is given they are fitted. Length 1 to 0.001.
    boundary_normals: "Normals" = "\"fitted\"";
    /// "auto" is the default; "g1" is 0, "g2" is 1.
    continuity: "HowFar" = "";
    /// A mapping from vertices to "g1", "g2" or numbers.
    loop_continuity: "LoopContinuity" = "{}";
    /// "estimated"; mean curvatures in 1 / length, negative where the normals point outward of a sphere: a mapping from vertices, a pair (indices (k,), values (k,)), or an array (n,), NaN where none is given. Where none is given it is estimated.
    boundary_curvature: "Curvature" = "\"estimated\"";
    /// "harmonic", zero; a number in 1 / length^3, a positive one pushes the surface out along its normals; or "minimal_energy", -2 H (H^2 - K).
    target: "Target" = "\"harmonic\"";
    /// "auto" is the angle from which on edges are certain, "off" is 0.
    sharp: "Sharp" = "";
    /// "auto": as many as are advised, and none where none are.
    relax_rim: "Rings" = "";
    /// None: that of the array of vertices.
    output_precision: "Literal[\"double\", \"single\"]" = "None";
};

/// The text of `_schema.py`.
pub fn options() -> String {
    let fairing = fields(&Options::schema());
    let (rows, patches): (Vec<_>, Vec<_>) = fields(&FillOptions::schema())
        .into_iter()
        .partition(|field| matches!(field.kind, OptionKind::Indices(_)));
    let rims = [rows, fields(&Rim::schema())].concat();
    let classes = [
        (
            "FairingOptions",
            "TypedDict",
            "How fairing is done: the keywords that all functions which fair have in common. None is the default.",
            fairing.clone(),
        ),
        (
            "PatchOptions",
            "FairingOptions",
            "How patches are made, besides.",
            patches.clone(),
        ),
        (
            "FillingOptions",
            "PatchOptions",
            "How holes are filled, besides.",
            rims.clone(),
        ),
        (
            "BridgeOptions",
            "PatchOptions",
            "How bridges are made, besides.",
            fields(&BridgeOptions::schema()),
        ),
        (
            "RemeshOptions",
            "TypedDict",
            "How regions are triangulated anew.",
            fields(&RemeshOptions::schema()),
        ),
        (
            "RoundOptions",
            "TypedDict",
            "Which edges are rounded, and how far.",
            fields(&RoundOptions::schema()),
        ),
    ];
    let mut made = HEAD.to_owned();
    for (name, base, text, fields) in &classes {
        class(&mut made, [name, base, text], fields);
    }
    made.push_str("\n\n#: Of each struct of the library its options, and how they are read.\nKINDS: dict[str, dict[str, str]] = {\n");
    let structs = [
        ("fairmesh_options", fairing),
        ("fairmesh_fill_options", [patches, rims].concat()),
        ("fairmesh_bridge_options", classes[3].3.clone()),
        ("fairmesh_remesh_options", classes[4].3.clone()),
        ("fairmesh_round_options", classes[5].3.clone()),
    ];
    for (name, fields) in structs {
        let _ = writeln!(made, "    \"{name}\": {{");
        for field in &fields {
            let _ = writeln!(made, "        \"{}\": \"{}\",", field.name, field.how);
        }
        made.push_str("    },\n");
    }
    made.push_str("}\n");
    made
}

/// An option in Python.
#[derive(Clone)]
struct Field {
    name: &'static str,
    kind: OptionKind,
    /// Its type, None left out.
    of: String,
    default: String,
    text: String,
    /// How it is read.
    how: String,
}

fn fields(schema: &[OptionEntry]) -> Vec<Field> {
    // A struct without a form of Python's has a keyword that is read by hand.
    let is_formed = |entry: &&OptionEntry| match entry.kind {
        OptionKind::Elsewhere => false,
        OptionKind::Struct(_) => FORMS.iter().any(|form| form[0] == entry.name),
        _ => true,
    };
    let own = schema.iter().filter(is_formed);
    own.map(field).collect()
}

fn field(entry: &OptionEntry) -> Field {
    let (of, how) = match entry.kind {
        OptionKind::Real(_) if entry.default == OptionDefault::Nothing => {
            ("float".to_owned(), "positive".to_owned())
        }
        OptionKind::Real(_) => ("float".to_owned(), "real".to_owned()),
        OptionKind::Count(_) => ("int".to_owned(), "count 64".to_owned()),
        OptionKind::SmallCount(_) => ("int".to_owned(), "count 32".to_owned()),
        OptionKind::Flag => ("bool".to_owned(), "flag".to_owned()),
        OptionKind::Choice(of) => (format!("Literal[{}]", names(of)), format!("choice {of}")),
        OptionKind::Indices(2) => ("ArrayLike".to_owned(), "pairs".to_owned()),
        OptionKind::Indices(_) => ("ArrayLike".to_owned(), "indices".to_owned()),
        OptionKind::Struct(_) | OptionKind::Elsewhere => (String::new(), "form".to_owned()),
    };
    let text = entry.text.replace("triangles", "faces");
    let default = match entry.default {
        OptionDefault::Number(number) if number.is_infinite() => "float(\"inf\")".to_owned(),
        OptionDefault::Number(number) if of == "float" => format!("{number:?}"),
        OptionDefault::Number(number) => format!("{number}"),
        OptionDefault::Flag(is_set) => if is_set { "True" } else { "False" }.to_owned(),
        OptionDefault::Name(name) => format!("\"{name}\""),
        OptionDefault::Nothing => "None".to_owned(),
    };
    let (name, kind) = (entry.name, entry.kind);
    let Some([_, of, formed, said]) = FORMS.iter().find(|form| form[0] == name) else {
        return Field {
            name,
            kind,
            of,
            default,
            text,
            how,
        };
    };
    Field {
        name,
        kind,
        of: (*of).to_owned(),
        default: if formed.is_empty() {
            default
        } else {
            (*formed).to_owned()
        },
        text: format!("{text} {said}"),
        how: how.replace("real", "form").replace("count 64", "rings"),
    }
}

/// The names of an enumeration.
pub(crate) fn names(of: &str) -> String {
    let tables = tables::all();
    let table = tables
        .iter()
        .find(|table| table.name == of)
        .expect("an enumeration");
    let names: Vec<String> = table
        .entries
        .iter()
        .map(|entry| format!("\"{}\"", entry.name()))
        .collect();
    names.join(", ")
}

/// A class, and its defaults.
fn class(made: &mut String, [name, base, text]: [&str; 3], fields: &[Field]) {
    let _ = write!(
        made,
        "\n\nclass {name}({base}, total=False):\n    \"\"\"{text}\n\n    Keywords:\n"
    );
    for field in fields {
        let _ = writeln!(made, "        {}: {}", field.name, field.text);
    }
    made.push_str("    \"\"\"\n\n");
    for field in fields {
        let _ = writeln!(made, "    {}: {} | None", field.name, field.of);
    }
    let inherited = if base == "TypedDict" {
        String::new()
    } else {
        format!("    **{},\n", defaults(base))
    };
    let _ = write!(made, "\n\n{}: dict[str, Any] = {{\n{inherited}", defaults(name));
    for field in fields {
        let _ = writeln!(made, "    \"{}\": {},", field.name, field.default);
    }
    made.push_str("}\n");
}

/// `FairingOptions`: `FAIRING_DEFAULTS`.
fn defaults(class: &str) -> String {
    format!("{}_DEFAULTS", class.trim_end_matches("Options").to_uppercase())
}
