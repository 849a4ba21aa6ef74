//! What `src/capi` takes of the library's tables: `numbers.rs`, the enumerations, and `texts.rs`, their texts; and the page of
//! outcomes.

use std::fmt::Write;

use crate::tables::{self, Table, sentence, variant};

const NUMBERS: &str = "\
//! The enumerations of the C interface. Made of the library's tables by src/declarations: do not edit.
";

const TEXTS: &str = "\
//! What the enumerations of the C interface mean. Made of the library's tables by src/declarations: do not edit.

use super::statuses::{NONE, STATUSES};
use fairmesh::{AttemptEnd, Entry, Error, FillOutcome, FlatReason, GapKind, LoopKind, LooseReason, OpenReason, Outcome, SharpFate};

/// The enumerations that `fairmesh_describe` knows. Numbers are never reused.
#[repr(u32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(dead_code, reason = \"numbers for C\")]
pub enum fairmesh_answer {
";

/// The text of `src/capi/numbers.rs`.
pub fn numbers() -> String {
    let mut made = NUMBERS.to_owned();
    let tables = tables::all();
    tables.iter().for_each(|table| enumeration(&mut made, table));
    status_from_number(&mut made, &tables[0]);
    made
}

/// The text of `src/capi/texts.rs`.
pub fn texts() -> String {
    let all = tables::all();
    let told = all.iter().filter(|table| table.has_texts);
    let (mut values, mut texts) = (String::new(), String::new());
    for (number, table) in told.enumerate() {
        let short = table.name.trim_start_matches("fairmesh_");
        let parts = table.parts.replace("statuses::", "");
        let _ = writeln!(
            values,
            "    /// A `{}`.\n    {} = {number},",
            table.name,
            variant(short)
        );
        let _ = writeln!(texts, "    &[{parts}],");
    }
    format!(
        "{TEXTS}{values}}}\n\n/// By the numbers of a `fairmesh_answer`.\npub(crate) const ANSWERS: &[&[&[Entry]]] = &[\n{texts}];\n"
    )
}

/// The text of `docs/outcomes.md`.
pub fn page() -> String {
    let mut made =
        "# What the library answers\n\nMade of the library's tables by src/declarations: do not edit.\n"
            .to_owned();
    for table in tables::all().iter().filter(|t| t.has_texts) {
        let _ = write!(made, "\n## {}\n\n{}\n\n", table.name, table.doc);
        made.push_str("| number | name | meaning | what to do |\n|---|---|---|---|\n");
        for entry in &table.entries {
            let cells = [entry.name(), entry.text(), entry.remedy()].map(|text| text.replace('|', "\\|"));
            let [name, text, remedy] = cells;
            let _ = writeln!(made, "| {} | `{name}` | {text} | {remedy} |", entry.number());
        }
    }
    made
}

fn enumeration(made: &mut String, table: &Table) {
    let repr = if table.name == "fairmesh_status" {
        "i32"
    } else {
        "u32"
    };
    let _ = write!(
        made,
        "\n/// {} Numbers are never reused.\n#[repr({repr})]\n#[derive(Debug, Clone, Copy, PartialEq, Eq)]\n#[allow(dead_code, reason = \"numbers for C\")]\npub enum {} {{\n",
        table.doc, table.name
    );
    for entry in &table.entries {
        let doc = sentence(entry.text());
        let _ = writeln!(
            made,
            "    /// {doc}\n    {} = {},",
            variant(entry.name()),
            entry.number()
        );
    }
    made.push_str("}\n");
}

fn status_from_number(made: &mut String, statuses: &Table) {
    made.push_str(
        "\nimpl fairmesh_status {\n    /// The status with this number.\n    pub(crate) const fn from_number(number: u32) -> Self {\n        match number {\n",
    );
    for entry in &statuses.entries {
        let _ = writeln!(
            made,
            "            {} => Self::{},",
            entry.number(),
            variant(entry.name())
        );
    }
    made.push_str("            _ => Self::Internal,\n        }\n    }\n}\n");
}
