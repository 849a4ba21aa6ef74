//! `_records.py`: Python's classes of what is told of results, made of the structs of `src/capi`, and the functions that read these.

use std::fmt::Write;

use syn::Item;

use crate::python::class_of;
use crate::records::{self, Field, Record};
use crate::tables;

const HEAD: &str = r#""""What is told of results. Made of src/capi by src/declarations when the package is built."""

# ruff: noqa: D, E501
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from . import _abi
from ._enums import AttemptEnd, LooseReason, Outcome


def element_or_none(number: int) -> int | None:
    """None in place of the library's "no element"."""
    return None if number == _abi.NO_ELEMENT else number
"#;

/// What tells the texts of an outcome, and a short name in place of all fields, which are more than anyone reads.
const TEXTS: &str = r#"
    def __repr__(self) -> str:
        return f"<fairmesh.Report: {self.outcome}, {self.free_vertices} free vertices, {self.iterations} iterations>"

    @property
    def text(self) -> str:
        """What the outcome means, or its reason: English, begins in lower case, ends without a full stop."""
        return self._telling.text

    @property
    def remedy(self) -> str:
        """What can be done about it, written like the text; empty if there is nothing to do."""
        return self._telling.remedy

    @property
    def _telling(self) -> Outcome | LooseReason:
        return self.loose_reason if self.outcome is Outcome.CONVERGED_LOOSELY else self.outcome
"#;

/// Which fields of a struct a class has, and their names in it.
enum Taken {
    /// All but these.
    AllBut(&'static [&'static str]),
    /// These.
    These(&'static [(&'static str, &'static str)]),
}

/// A class of Python.
struct Class {
    name: &'static str,
    /// The struct.
    of: &'static str,
    /// What is said about it, if the struct says something else.
    doc: &'static str,
    taken: Taken,
    /// What it has besides: name, type and text.
    besides: &'static [[&'static str; 3]],
    /// Whether it has `TEXTS`.
    has_text: bool,
}

/// All fields of a struct, and nothing else.
const PLAIN: Class = Class {
    name: "",
    of: "",
    doc: "",
    taken: Taken::AllBut(&[]),
    besides: &[],
    has_text: false,
};

const CLASSES: [Class; 8] = [
    Class {
        name: "Report",
        of: "fairmesh_report",
        taken: Taken::AllBut(&["component_count"]),
        besides: &[[
            "components",
            "tuple[Component, ...]",
            "The components of the region, by their smallest free vertices; at least one.",
        ]],
        has_text: true,
        ..PLAIN
    },
    Class {
        name: "Component",
        of: "fairmesh_component",
        taken: Taken::AllBut(&["attempt_count", "continuity_count"]),
        besides: &[
            [
                "attempts",
                "tuple[Attempt, ...]",
                "What was tried, in its order: on the coarse mesh, where the component is large, and then on its own. Empty for the paper's solver.",
            ],
            [
                "continuity",
                "tuple[Continuity, ...]",
                "What came of the option ``continuity`` along each boundary loop; empty where it is 0, no loop has surroundings and vertices enough, or no surface was found to begin with.",
            ],
        ],
        ..PLAIN
    },
    Class {
        name: "Attempt",
        of: "fairmesh_attempt",
        ..PLAIN
    },
    Class {
        name: "Continuity",
        of: "fairmesh_continuity",
        ..PLAIN
    },
    Class {
        name: "Level",
        of: "fairmesh_level",
        ..PLAIN
    },
    Class {
        name: "Bends",
        of: "fairmesh_join_suggestion",
        doc: "Why loops are joined: sums over all edges, those of the loops included, of length times angle in radians, of triangulations without new vertices. Edges inside count half.",
        taken: Taken::These(&[
            ("gap_kind", "kind"),
            ("joint_bend", "joint_bend"),
            ("separate_bend", "separate_bend"),
            ("joint_area", "joint_area"),
            ("separate_area", "separate_area"),
        ]),
        ..PLAIN
    },
    Class {
        name: "Moved",
        of: "fairmesh_fill_report",
        doc: "How far the vertices around a loop moved.",
        taken: Taken::These(&[
            ("moved_count", "count"),
            ("moved_rms", "rms"),
            ("moved_largest", "largest"),
            ("moved_within", "within"),
            ("moved_unsound", "unsound"),
        ]),
        ..PLAIN
    },
    Class {
        name: "Roughness",
        of: "fairmesh_loop",
        doc: "How rough the mesh is along a boundary loop.",
        taken: Taken::These(&[
            ("roughness", "ratio"),
            ("rim_angle", "angle"),
            ("rim_angle_expected", "expected_angle"),
            ("rim_noise", "noise"),
            ("is_rough", "is_rough"),
            ("advised_relax_rim", "advised_relax_rim"),
            ("advised_relax_within", "advised_relax_within"),
        ]),
        ..PLAIN
    },
];

/// The text of `_records.py`.
pub fn records(items: &[Item]) -> String {
    let records = records::all(items);
    let mut made = HEAD.to_owned();
    for class in &CLASSES {
        let record = records.iter().find(|r| r.name == class.of).expect("a struct");
        class.declare(&mut made, record);
        class.read(&mut made, record);
    }
    made
}

impl Class {
    /// The fields, with their names in Python.
    fn fields<'a>(&self, record: &'a Record) -> Vec<(&'a str, &'a Field)> {
        match self.taken {
            Taken::AllBut(left_out) => {
                let told = record.fields.iter().filter(|field| field.is_told());
                let taken = told.filter(|field| !left_out.contains(&field.name.as_str()));
                taken.map(|field| (field.name.as_str(), field)).collect()
            }
            Taken::These(names) => {
                let named = |name| record.fields.iter().find(|f| f.name == name).expect("a field");
                names.iter().map(|(c, python)| (*python, named(*c))).collect()
            }
        }
    }

    fn declare(&self, made: &mut String, record: &Record) {
        let doc = if self.doc.is_empty() {
            &record.doc
        } else {
            self.doc
        };
        let arguments = if self.has_text { ", repr=False" } else { "" };
        let _ = write!(
            made,
            "\n\n@dataclass(frozen=True{arguments})\nclass {}:\n    \"\"\"{doc}\"\"\"\n\n",
            self.name
        );
        for (name, field) in self.fields(record) {
            attribute(made, name, annotation(field), &self.said(field));
        }
        for [name, of, text] in self.besides {
            attribute(made, name, of, text);
        }
        if self.has_text {
            made.push_str(TEXTS);
        }
    }

    /// What is said about a field, in the words of Python.
    fn said(&self, field: &Field) -> String {
        let mut said = field.said();
        if said.starts_with("A `fairmesh_") {
            return String::new();
        }
        if let Taken::These(names) = self.taken {
            for (c, python) in names {
                said = said.replace(&format!("`{c}`"), &format!("`{python}`"));
            }
        }
        said = said.replace(
            "the list INTERSECTIONS has two entries for each",
            "`Result.intersections` has them",
        );
        if let Some((before, list)) = said.split_once("the list ") {
            said = format!("{before}`Result.{}`.", list.trim_end_matches('.').to_lowercase());
        }
        if field.kind == "or_none" {
            said = format!("{}; None: there is none.", said.trim_end_matches('.'));
        }
        if field.kind == "fairmesh_gap_kind" {
            let tables = tables::all();
            let table = tables
                .iter()
                .find(|table| table.name == field.kind)
                .expect("an enumeration");
            let names = table
                .entries
                .iter()
                .map(|e| format!("\"{}\", {}", e.name(), e.text()));
            said = format!(
                "What lies between them: {}.",
                names.collect::<Vec<_>>().join("; ")
            );
        }
        said
    }

    fn read(&self, made: &mut String, record: &Record) {
        let parameters: String = self
            .besides
            .iter()
            .map(|[name, of, _]| format!(", {name}: {of}"))
            .collect();
        let _ = write!(
            made,
            "\n\ndef {}_of(struct: Any{parameters}) -> {}:\n    \"\"\"What a struct tells.\"\"\"\n    return {}(\n",
            self.name.to_lowercase(),
            self.name,
            self.name
        );
        for (name, field) in self.fields(record) {
            let value = format!("struct.{}", field.name);
            let value = match annotation(field) {
                "int" | "float" => value,
                "bool" => format!("bool({value})"),
                "int | None" => format!("element_or_none({value})"),
                "tuple[float, float]" => format!("tuple({value})"),
                "str" if field.kind == "chars" => format!("{value}.decode()"),
                "str" => format!("_abi.{}({value}).name.lower()", field.kind),
                class => format!("{class}.of({value})"),
            };
            let _ = writeln!(made, "        {name}={value},");
        }
        for [name, ..] in self.besides {
            let _ = writeln!(made, "        {name}={name},");
        }
        made.push_str("    )\n");
    }
}

/// An attribute with what is said about it below, where IDEs and pdoc look for it.
fn attribute(made: &mut String, name: &str, of: &str, said: &str) {
    let _ = writeln!(made, "    {name}: {of}");
    if !said.is_empty() {
        let _ = writeln!(made, "    \"\"\"{said}\"\"\"");
    }
}

/// The type of a field.
fn annotation(field: &Field) -> &str {
    match (field.kind.as_str(), field.count) {
        ("u32" | "u64", _) => "int",
        ("f64", 1) => "float",
        ("f64", _) => "tuple[float, float]",
        ("flag", _) => "bool",
        ("or_none", _) => "int | None",
        ("chars" | "fairmesh_gap_kind", _) => "str",
        (other, _) => class_of(other),
    }
}
