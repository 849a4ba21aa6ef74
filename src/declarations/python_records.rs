//! `_records.py`: Python's classes of what is told of results, made of the structs of `src/capi`, and the functions that read these.

use std::fmt::Write;

use syn::Item;

use crate::python::{class_of, constant};
use crate::python_options::names;
use crate::records::{self, Field};

const HEAD: &str = r#""""What is told of results. Made of src/capi by src/declarations when the package is built."""

# ruff: noqa: D, E501
from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from . import _abi
from ._enums import AttemptEnd, LoopKind, LooseReason, Outcome, SharpFate

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


def element_or_none(number: int) -> int | None:
    """None in place of the library's "no element"."""
    return None if number == _abi.NO_ELEMENT else number
"#;

/// A class: its name, its struct, what is said about it if the struct says something else, and its fields: all but those with a minus,
/// or those that are named, with their names in Python if these are others.
const CLASSES: [[&str; 4]; 11] = [
    ["Report", "report", "", "-component_count -sharp_edge_count"],
    ["Component", "component", "", "-attempt_count -continuity_count"],
    ["Attempt", "attempt", "", ""],
    ["Continuity", "continuity", "", ""],
    [
        "SharpEdge",
        "sharp_edge",
        "",
        "-end_count -vertex_count -first_vertex",
    ],
    ["CreaseEnd", "crease_end", "", ""],
    ["Crease", "crease", "", "-vertex_count"],
    [
        "Loop",
        "loop",
        "A boundary loop of a mesh.",
        "kind length area turn component component_triangle_count=component_faces",
    ],
    [
        "Bends",
        "join_suggestion",
        "Why loops are joined: sums over all edges, those of the loops included, of length times angle in radians, of triangulations without new vertices. Edges inside count half.",
        "gap_kind=kind joint_bend separate_bend joint_area separate_area",
    ],
    [
        "Moved",
        "fill_report",
        "How far the vertices around a loop moved.",
        "moved_count=count moved_rms=rms moved_largest=largest moved_within=within moved_unsound=unsound",
    ],
    [
        "Roughness",
        "loop",
        "How rough the mesh is along a boundary loop.",
        "roughness=ratio rim_angle=angle rim_angle_expected=expected_angle rim_noise=noise is_rough advised_relax_rim advised_relax_within",
    ],
];

/// What some classes have besides.
const REPORT: &str = r#"    components: tuple[Component, ...]
    """The components of the region, by their smallest free vertices; at least one."""
    sharp_edges: tuple[SharpEdge, ...]
    """What became of the sharp edges that reach the boundary, where the option ``sharp`` asks for them."""

    def __repr__(self) -> str:
        # All of the fields are more than anyone reads.
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
const COMPONENT: &str = r#"    attempts: tuple[Attempt, ...]
    """What was tried, in its order: on the coarse mesh, where the component is large, and then on its own."""
    continuity: tuple[Continuity, ...]
    """What came of the option ``continuity`` along each boundary loop; empty where it is 0, no loop has surroundings and vertices enough, or no surface was found to begin with."""
"#;
const SHARP_EDGE: &str = r#"    ends: tuple[CreaseEnd, ...]
    """Where it arrives at the boundary: one, two or three."""
    vertices: NDArray[np.intp] = field(compare=False)
    """The vertices along it, from end to end, or from each end to the corner one after the other; empty where it does not go on. Those that were free have been placed on it."""
"#;
const CREASE: &str = r#"    vertices: NDArray[np.intp] = field(compare=False)
    """Its vertices in the mesh given, one after the other; of a ring the first one is the last one, too."""
"#;
const LOOP: &str = r#"    vertices: NDArray[np.intp]
    """The vertices in the direction of triangles that fill it."""
    touching: NDArray[np.intp]
    """Vertices that belong to another loop, too."""
    edge: tuple[int, int] | None
    """The bad edge of a non-manifold loop, otherwise None."""
    roughness: Roughness | None
    """How rough the mesh is around it, if `boundary_loops` was asked for that and the mesh around tells."""
"#;

/// The text of `_records.py`.
pub fn records(items: &[Item]) -> String {
    let records = records::all(items);
    let mut made = HEAD.to_owned();
    for [class, of, doc, taken] in CLASSES {
        let record = records.iter().find(|r| r.name == format!("fairmesh_{of}"));
        let record = record.expect("a struct");
        let doc = if doc.is_empty() { record.doc.as_str() } else { doc };
        let (besides, arguments) = match class {
            "Report" => (REPORT, ", repr=False"),
            "Component" => (COMPONENT, ""),
            "SharpEdge" => (SHARP_EDGE, ""),
            "Crease" => (CREASE, ""),
            "Loop" => (LOOP, ""),
            _ => ("", ""),
        };
        let (mut attributes, mut values) = (String::new(), String::new());
        for (name, field) in fields(&record.fields, taken) {
            let _ = writeln!(attributes, "    {name}: {}", annotation(field));
            let said = said(field, taken);
            if !said.is_empty() {
                let _ = writeln!(attributes, "    \"\"\"{said}\"\"\"");
            }
            let _ = writeln!(values, "        {name}={},", value(field));
        }
        let function = constant(class).to_lowercase();
        let _ = write!(
            made,
            "\n\n@dataclass(frozen=True{arguments})\nclass {class}:\n    \"\"\"{doc}\"\"\"\n\n{attributes}{besides}\n\ndef {function}_of(struct: Any, **more: Any) -> {class}:\n    \"\"\"What a struct tells, with what it does not.\"\"\"\n    return {class}(\n{values}        **more,\n    )\n"
        );
    }
    made
}

/// The fields of a class, with their names in Python.
fn fields<'a>(all: &'a [Field], taken: &'a str) -> Vec<(&'a str, &'a Field)> {
    if taken.is_empty() || taken.starts_with('-') {
        let left_out = |field: &&Field| {
            taken
                .split(' ')
                .any(|word| word.strip_prefix('-') == Some(&field.name))
        };
        let told = all.iter().filter(|field| field.is_told() && !left_out(field));
        return told.map(|field| (field.name.as_str(), field)).collect();
    }
    let renamed = taken
        .split(' ')
        .map(|word| word.split_once('=').unwrap_or((word, word)));
    let named = |name| all.iter().find(|field| field.name == name).expect("a field");
    renamed.map(|(c, python)| (python, named(c))).collect()
}

/// What is said about a field, in the words of Python.
fn said(field: &Field, taken: &str) -> String {
    let mut said = field.said().replace(", ending with a NUL", "");
    for (c, python) in taken.split(' ').filter_map(|word| word.split_once('=')) {
        said = said.replace(&format!("`{c}`"), &format!("`{python}`"));
    }
    said = said.replace(
        "the list INTERSECTIONS has two entries for each",
        "`Result.intersections` has them",
    );
    if let Some((before, list)) = said.split_once("the list ") {
        said = format!("{before}`Result.{}`.", list.trim_end_matches('.').to_lowercase());
    }
    match field.kind.as_str() {
        // Its type says the rest.
        of if said == format!("A `{of}`.") => String::new(),
        "or_none" => said.replace('.', "; None: there is none."),
        "fairmesh_gap_kind" => format!("{said} {}.", names(&field.kind)),
        _ => said.replace("`fairmesh_", "`"),
    }
}

/// The type of a field.
fn annotation(field: &Field) -> String {
    match (field.kind.as_str(), field.count) {
        ("u32" | "u64", _) => "int",
        ("f64", 1) => "float",
        ("f64", count) => return format!("tuple[{}]", vec!["float"; count].join(", ")),
        ("flag", _) => "bool",
        ("or_none", _) => "int | None",
        ("chars" | "fairmesh_gap_kind", _) => "str",
        (other, _) => return class_of(other),
    }
    .to_owned()
}

/// How it is read.
fn value(field: &Field) -> String {
    let value = format!("struct.{}", field.name);
    match annotation(field).as_str() {
        "int" | "float" => value,
        "bool" => format!("bool({value})"),
        "int | None" => format!("element_or_none({value})"),
        of if of.starts_with("tuple[") => format!("tuple({value})"),
        "str" if field.kind == "chars" => format!("{value}.decode()"),
        "str" => format!("_abi.{}({value}).name.lower()", field.kind),
        class => format!("{class}.of({value})"),
    }
}
