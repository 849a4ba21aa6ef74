//! How far the surface continues the curvature of its surroundings: the flags, and what the report says.

use std::path::PathBuf;

use clap::Args;
use fairmesh::{BoundaryCurvature, ComponentReport, CurvatureContinuity, Options};
use serde_json::{Value, json};

use crate::failure::Failure;
use crate::figures::significant;
use crate::selection;

/// At most so many loops are told to people.
const SHOWN: usize = 8;

/// How much is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Asked {
    /// Tangent planes.
    Tangent,
    /// Curvature along loops where it is certain.
    Auto,
    /// Curvature, or a part of it, along some loop.
    Curvature,
}

/// What is asked.
#[derive(Debug, Args)]
pub struct ContinuityArgs {
    /// How smoothly the surface continues its surroundings: 'g1' (tangent planes),
    /// 'g2' (mean curvature, too), a number from 0 (g1) to 1 (g2), or 'auto': g2 along
    /// boundary loops where the curvature of the surroundings is certain, g1 along
    /// others. Less is reached where they are too rough to tell it; the report says
    /// how much for each loop
    #[arg(
        long,
        value_name = "HOW-FAR",
        default_value = "auto",
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
    /// How much is asked for.
    pub fn asked(&self) -> Asked {
        let of_loops = self.continuity_at.iter().map(|(_, blend)| *blend);
        let asked: Vec<f64> = of_loops.chain([self.continuity]).collect();
        if asked.iter().any(|blend| *blend > 0.0) {
            Asked::Curvature
        } else if asked.contains(&Options::CONTINUITY_AUTO) {
            Asked::Auto
        } else {
            Asked::Tangent
        }
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
        "auto" => Ok(Options::CONTINUITY_AUTO),
        "g1" => Ok(0.0),
        "g2" => Ok(1.0),
        _ => text
            .parse()
            .ok()
            .filter(|blend| (0.0..=1.0).contains(blend))
            .ok_or_else(|| "expected auto, g1, g2 or a number between 0 and 1".to_owned()),
    }
}

/// The same of `round`, where nothing is automatic.
pub fn part(text: &str) -> Result<f64, String> {
    how_far(text)
        .ok()
        .filter(|part| *part >= 0.0)
        .ok_or_else(|| "expected g1, g2 or a number between 0 and 1".to_owned())
}

/// Reads `--continuity-at`.
fn at_vertex(text: &str) -> Result<(u32, f64), String> {
    let wrong = || "expected a vertex, '=', and auto, g1, g2 or a number between 0 and 1".to_owned();
    let (vertex, blend) = text.split_once('=').ok_or_else(wrong)?;
    let vertex = vertex.trim().parse().map_err(|_| wrong())?;
    Ok((vertex, how_far(blend.trim()).map_err(|_| wrong())?))
}

/// A line for each boundary loop; why there is none, where there is none and one was asked for.
pub fn lines(components: &[ComponentReport], asked: Asked) -> Vec<String> {
    let loops = components.iter().flat_map(|component| {
        let was_tried = component
            .attempts
            .iter()
            .any(|tried| tried.name == CurvatureContinuity::ATTEMPT);
        component.continuity.iter().map(move |of| line(of, was_tried))
    });
    let told: Vec<String> = loops.collect();
    if told.is_empty() && asked == Asked::Curvature {
        return vec![
            "not reached: no loop has surroundings and vertices enough, or no surface was found".to_owned(),
        ];
    }
    let rest = told.len().saturating_sub(SHOWN);
    let more = (rest > 0).then(|| format!("and {rest} loops more"));
    told.into_iter().take(SHOWN).chain(more).collect()
}

/// The same of a patch. What the program leaves by itself is told to those who look closely: there may be hundreds of holes.
pub fn of_patch(components: &[ComponentReport], asked: Asked, is_verbose: bool) -> Vec<String> {
    let mut of_loops = components.iter().flat_map(|component| &component.continuity);
    if asked == Asked::Auto && !is_verbose && of_loops.all(is_left) {
        return Vec::new();
    }
    lines(components, asked)
}

/// Whether it was left to the program, and it has not taken it.
fn is_left(of: &CurvatureContinuity) -> bool {
    of.asked == Options::CONTINUITY_AUTO && of.reached == 0.0
}

/// Of a loop, and whether curvature was continued along any loop of its component, soundly or not.
fn line(of: &CurvatureContinuity, was_tried: bool) -> String {
    if is_left(of) {
        let rest = of.vertices - 1;
        return format!(
            "loop of vertex {} and {rest} more: g1, as {}",
            of.vertex,
            why_left(of, was_tried)
        );
    }
    let [asked, reached] = [of.asked.abs(), of.reached].map(significant);
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

/// Why it was left: by the figures of the report, as the library has decided it.
fn why_left(of: &CurvatureContinuity, was_tried: bool) -> String {
    let [before, curvature, uncertainty] = [of.jump_before, of.curvature, of.uncertainty].map(significant);
    if of.uncertainty.is_infinite() {
        "too little lies outside".to_owned()
    } else if of.uncertainty > of.jump_before {
        format!("H outside is {curvature} +- {uncertainty}, which does not tell its jump of {before}")
    } else if !was_tried {
        format!("H jumps by {before} only")
    } else {
        format!("H jumps by {before} +- {uncertainty} only, or no sound surface has the curvature outside")
    }
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
        let read = [
            ("auto", -1.0),
            ("g1", 0.0),
            ("g2", 1.0),
            ("0.25", 0.25),
            ("0", 0.0),
            ("1", 1.0),
        ];
        read.into_iter()
            .for_each(|(text, value)| assert_eq!(how_far(text), Ok(value)));
        for text in ["g3", "G2", "", "-0.1", "1.01", "nan", "inf"] {
            let why = how_far(text).unwrap_err();
            assert_eq!(why, "expected auto, g1, g2 or a number between 0 and 1", "{text}");
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
            line(&of, true),
            "loop of vertex 12 and 39 more: 0.9000 of 1.000 reached, jump of H 0.1500 -> 0.003500 \
             (largest 0.2500 -> 0.007500), |H| outside 1.200 +- unknown"
        );
        let told = json([&of]);
        assert_eq!(told[0]["largest_jump"], 0.0075);
        assert_eq!(told[0]["uncertainty"], Value::Null);
        assert_begins!(lines(&[], Asked::Curvature)[0], "not reached: ");
        assert_empty!(lines(&[], Asked::Auto));
    }

    /// What is left by itself says why.
    #[test]
    fn a_loop_that_is_left_is_told_with_the_reason() {
        let left = |jump_before: f64, uncertainty: f64, was_tried: bool| {
            let of = CurvatureContinuity {
                vertex: 3,
                vertices: 20,
                asked: Options::CONTINUITY_AUTO,
                reached: 0.0,
                jump_before,
                largest_jump_before: jump_before,
                jump: jump_before,
                largest_jump: jump_before,
                curvature: 1.0,
                uncertainty,
            };
            let told = line(&of, was_tried);
            let begin = "loop of vertex 3 and 19 more: g1, as ";
            told.strip_prefix(begin)
                .expect("its loop and that it is g1")
                .to_owned()
        };
        assert_eq!(left(0.5, f64::INFINITY, true), "too little lies outside");
        let uncertain = "H outside is 1.000 +- 0.6000, which does not tell its jump of 0.5000";
        assert_eq!(left(0.5, 0.6, true), uncertain);
        assert_eq!(left(0.5, 0.1, false), "H jumps by 0.5000 only");
        let other = "H jumps by 0.5000 +- 0.1000 only, or no sound surface has the curvature outside";
        assert_eq!(left(0.5, 0.1, true), other);
    }
}
