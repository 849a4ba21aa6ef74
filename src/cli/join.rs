//! Which loops get one patch together: the flag, and how the reasons are told.

use fairmesh::{Join, JoinReason};
use serde_json::{Value, json};

use crate::failure::Failure;

/// One value of `--join`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum JoinArg {
    Auto,
    Loops(Vec<usize>),
}

/// Reads a value of `--join`.
pub fn parse(text: &str) -> Result<JoinArg, String> {
    if text == "auto" {
        return Ok(JoinArg::Auto);
    }
    let numbers: Result<Vec<usize>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    match numbers {
        Ok(loops) if loops.len() > 1 => Ok(JoinArg::Loops(loops)),
        _ => Err("expected 'auto', or two or more numbers of 'fairmesh holes' as in 0,1,2".to_owned()),
    }
}

/// Reads a value of `--guide`.
pub fn parse_pair(text: &str) -> Result<[u32; 2], String> {
    let numbers: Result<Vec<u32>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[a, b]) => Ok([a, b]),
        _ => Err("expected two numbers of vertices, counted from 0, as in 12,57".to_owned()),
    }
}

/// What the flags say together.
pub fn asked(values: &[JoinArg]) -> Result<Join, Failure> {
    let groups: Vec<Vec<usize>> = values
        .iter()
        .filter_map(|value| match value {
            JoinArg::Loops(loops) => Some(loops.clone()),
            JoinArg::Auto => None,
        })
        .collect();
    match (groups.is_empty(), groups.len() < values.len()) {
        (true, false) => Ok(Join::None),
        (true, true) => Ok(Join::Auto),
        (false, false) => Ok(Join::Groups(groups)),
        (false, true) => Err(Failure::new(
            "--join auto chooses the groups itself; name all of them, or none",
        )),
    }
}

/// The reason in words.
pub fn told(reason: &JoinReason) -> String {
    format!(
        "{}; together they bend by {:.4e}, by themselves by {:.4e} (edge length times angle); area {:.4e} against {:.4e}",
        reason.kind.entry().text(),
        reason.joint_bend,
        reason.separate_bend,
        reason.joint_area,
        reason.separate_area
    )
}

/// The reason for programs.
pub fn json(reason: &JoinReason) -> Value {
    json!({
        "kind": reason.kind.name(), "joint_bend": reason.joint_bend, "separate_bend": reason.separate_bend,
        "joint_area": reason.joint_area, "separate_area": reason.separate_area,
    })
}

/// The numbers of loops, with commas.
pub fn list(loops: &[usize]) -> String {
    let numbers: Vec<String> = loops.iter().map(usize::to_string).collect();
    numbers.join(",")
}
