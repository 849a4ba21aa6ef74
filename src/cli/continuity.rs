//! How far the surface continues the curvature of its surroundings: the flags, and what the report says.

use std::path::PathBuf;

use clap::Args;
use fairmesh::{BoundaryCurvature, ComponentReport, CurvatureContinuity};
use serde_json::{Value, json};

use crate::failure::Failure;
use crate::figures::significant;
use crate::selection;

/// At most so many loops are told to people.
const SHOWN: usize = 8;

/// What is asked.
#[derive(Debug, Args)]
pub struct ContinuityArgs {
    /// How smoothly the surface continues its surroundings: 'g1' (tangent planes),
    /// 'g2' (mean curvature, too), or a number from 0 (g1) to 1 (g2). Less is reached
    /// where the surroundings are too rough to tell their curvature; the report says
    /// how much for each boundary loop
    #[arg(
        long,
        value_name = "HOW-FAR",
        default_value = "g1",
        value_parser = how_far,
        help_heading = "Surface",
        verbatim_doc_comment
    )]
    pub continuity: f64,
    /// The same for the boundary loop through a vertex, instead of
    /// --continuity; may be repeated
    #[arg(
        long,
        visible_alias = "loop-continuity",
        value_name = "VERTEX=HOW-FAR",
        value_parser = at_vertex,
        help_heading = "Surface",
        verbatim_doc_comment
    )]
    pub continuity_at: Vec<(u32, f64)>,
    /// Mean curvatures to continue, instead of those of the surroundings:
    /// a text file with 'vertex H' per line
    #[arg(
        long,
        value_name = "FILE",
        requires = "continuity",
        help_heading = "Surface",
        verbatim_doc_comment
    )]
    boundary_curvature: Option<PathBuf>,
}

impl ContinuityArgs {
    /// Whether more than tangent planes is asked for.
    pub fn is_asked(&self) -> bool {
        self.continuity > 0.0 || self.continuity_at.iter().any(|(_, blend)| *blend > 0.0)
    }

    /// Where the curvature of the surroundings comes from.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn boundary_curvature(&self, vertex_count: usize) -> Result<BoundaryCurvature, Failure> {
        match &self.boundary_curvature {
            None => Ok(BoundaryCurvature::Estimated),
            Some(file) => selection::given_curvature(file, vertex_count).map(BoundaryCurvature::Given),
        }
    }
}

/// Reads `--continuity`.
pub fn how_far(text: &str) -> Result<f64, String> {
    match text {
        "g1" => Ok(0.0),
        "g2" => Ok(1.0),
        _ => text
            .parse()
            .ok()
            .filter(|blend| (0.0..=1.0).contains(blend))
            .ok_or_else(|| "expected g1, g2 or a number between 0 and 1".to_owned()),
    }
}

/// Reads `--continuity-at`.
fn at_vertex(text: &str) -> Result<(u32, f64), String> {
    let wrong = || "expected a vertex, '=', and g1, g2 or a number between 0 and 1".to_owned();
    let (vertex, blend) = text.split_once('=').ok_or_else(wrong)?;
    let vertex = vertex.trim().parse().map_err(|_| wrong())?;
    Ok((vertex, how_far(blend.trim()).map_err(|_| wrong())?))
}

/// A line for each boundary loop; why there is none, where there is none.
pub fn lines(components: &[ComponentReport]) -> Vec<String> {
    let told: Vec<String> = components
        .iter()
        .flat_map(|component| component.continuity.iter().map(line))
        .collect();
    if told.is_empty() {
        return vec![
            "not reached: no loop has surroundings and vertices enough, or no surface was found".to_owned(),
        ];
    }
    let rest = told.len().saturating_sub(SHOWN);
    let more = (rest > 0).then(|| format!("and {rest} loops more"));
    told.into_iter().take(SHOWN).chain(more).collect()
}

fn line(of: &CurvatureContinuity) -> String {
    let [asked, reached] = [of.asked, of.reached].map(significant);
    let [before, after] = [of.jump_before, of.jump].map(significant);
    let [largest_before, largest] = [of.largest_jump_before, of.largest_jump].map(significant);
    let [curvature, uncertainty] = [of.curvature, of.uncertainty].map(significant);
    format!(
        "loop of vertex {} and {} more: {reached} of {asked} reached, jump of H {before} -> {after} \
         (largest {largest_before} -> {largest}), |H| outside {curvature} +- {uncertainty}",
        of.vertex,
        of.vertices - 1,
    )
}

/// The same for programs.
pub fn json<'a>(loops: impl IntoIterator<Item = &'a CurvatureContinuity>) -> Value {
    let told = loops.into_iter().map(|of| {
        json!({
            "vertex": of.vertex,
            "vertices": of.vertices,
            "asked": of.asked,
            "reached": of.reached,
            "jump_before": of.jump_before,
            "largest_jump_before": of.largest_jump_before,
            "jump": of.jump,
            "largest_jump": of.largest_jump,
            "curvature": of.curvature,
            "uncertainty": of.uncertainty,
        })
    });
    told.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_numbers_of_the_way() {
        let read = [("g1", 0.0), ("g2", 1.0), ("0.25", 0.25), ("0", 0.0), ("1", 1.0)];
        read.into_iter()
            .for_each(|(text, value)| assert_eq!(how_far(text), Ok(value)));
        for text in ["g3", "G2", "", "-0.1", "1.01", "nan", "inf"] {
            let why = how_far(text).unwrap_err();
            assert_eq!(why, "expected g1, g2 or a number between 0 and 1", "{text}");
        }
    }

    #[test]
    fn a_vertex_and_a_part_of_the_way() {
        assert_eq!(at_vertex("7=g2"), Ok((7, 1.0)));
        assert_eq!(at_vertex("0 = 0.25"), Ok((0, 0.25)));
        for text in ["7", "=1", "-1=1", "7=g3", "7=1=1", "x=g2", "7=1.5"] {
            assert!(at_vertex(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_loop_is_told_with_both_jumps() {
        let of = CurvatureContinuity {
            vertex: 12,
            vertices: 40,
            asked: 1.0,
            reached: 0.9,
            jump_before: 0.15,
            largest_jump_before: 0.25,
            jump: 0.0035,
            largest_jump: 0.0075,
            curvature: 1.2,
            uncertainty: f64::NAN,
        };
        assert_eq!(
            line(&of),
            "loop of vertex 12 and 39 more: 0.9000 of 1.000 reached, jump of H 0.1500 -> 0.003500 \
             (largest 0.2500 -> 0.007500), |H| outside 1.200 +- unknown"
        );
        let told = json([&of]);
        assert_eq!(told[0]["largest_jump"], 0.0075);
        assert_eq!(told[0]["uncertainty"], Value::Null);
        assert_begins!(lines(&[])[0], "not reached: ");
    }
}
