//! The report at the end of a run: for people and as JSON.

use std::fmt::Write;

use fairmesh::{LevelReport, Outcome, Report, Target};
use serde_json::{Map, Value, json};

use crate::explain;
use crate::fair::target_name;
use crate::formats::Geometry;

/// Seconds of the command; `solve` is the library's whole call, `setup` the part of it before any solving.
#[derive(Debug, Clone, Copy, Default)]
pub struct Times {
    pub read: f64,
    pub solve: f64,
    pub write: f64,
    pub total: f64,
}

/// Everything there is to tell.
pub struct Summary<'a> {
    pub report: &'a Report,
    pub geometry: &'a Geometry,
    pub times: Times,
    /// Vertices whose normals in the file could not be updated.
    pub stale_normals: usize,
}

/// How many numbers a line of the readable report shows.
const SHOWN: usize = 12;

impl Summary<'_> {
    /// Triangles in the file's numbering of faces.
    fn faces(&self, triangles: &[u32]) -> Vec<usize> {
        let mut faces: Vec<usize> = triangles
            .iter()
            .map(|&t| self.geometry.polygon_of(t as usize))
            .collect();
        faces.sort_unstable();
        faces.dedup();
        faces
    }

    /// The vertices that an outcome blames.
    fn blamed(&self) -> &[u32] {
        match &self.report.outcome {
            Outcome::NormalsNotReachable { vertices, .. } => vertices,
            _ => &[],
        }
    }

    /// Lines for people.
    pub fn readable(&self) -> String {
        let Report { quality, .. } = self.report;
        let report = self.report;
        let mut text = format!("{}\n", explain::outcome(report));
        let advice = report.outcome.remedy();
        if !advice.is_empty() {
            let _ = writeln!(text, "  what to do:          {advice}");
        }
        let mut row = |name: &str, value: String| {
            let _ = writeln!(text, "  {:<20} {value}", format!("{name}:"));
        };
        row("free vertices", report.free_vertices.to_string());
        row(
            "iterations",
            format!(
                "{}, last step {} of the region's diagonal",
                report.iterations,
                scientific(report.step)
            ),
        );
        if !report.levels.is_empty() {
            row("levels", levels(&report.levels));
        }
        if report.target != Target::Harmonic {
            row("target", target_name(report.target));
        }
        row(
            if report.target == Target::Harmonic {
                "harmonic defect"
            } else {
                "defect"
            },
            scientific(report.defect),
        );
        row("region's diagonal", significant(report.diagonal));
        let worst = self.geometry.polygon_of(quality.worst_triangle);
        row(
            "smallest angle",
            format!("{} degrees, in face {worst}", significant(quality.worst_angle)),
        );
        row("flipped", listed(&self.faces(&quality.flipped), "face"));
        row("needles", listed(&self.faces(&quality.needles), "face"));
        row("curvature inside", range(quality.h_inside));
        row("curvature boundary", range(quality.h_boundary));
        let deviation = significant(quality.normal_deviation);
        let rms = significant(quality.normal_deviation_rms);
        let vertex = quality.normal_deviation_vertex;
        row(
            "normal deviation",
            format!("at most {deviation} degrees (vertex {vertex}), rms {rms}"),
        );
        if report.linear_surface {
            row("surface", "the linear one".into());
        }
        if report.fallback_weights > 0 {
            row(
                "fallback weights",
                format!("{} vertices (poor input triangles)", report.fallback_weights),
            );
        }
        if !self.blamed().is_empty() {
            row("normals far off", listed(self.blamed(), "vertex"));
        }
        if !report.suspicious_normals.is_empty() {
            row(
                "suspicious normals",
                format!(
                    "{} (probably flipped or wrong)",
                    listed(&report.suspicious_normals, "vertex")
                ),
            );
        }
        if self.stale_normals > 0 {
            row(
                "normals not updated",
                format!("{} vertices share theirs with others", self.stale_normals),
            );
        }
        let Times {
            read,
            solve,
            write,
            total,
        } = self.times;
        row(
            "seconds",
            format!("{total:.2} (read {read:.2}, solve {solve:.2}, write {write:.2})"),
        );
        text
    }

    /// The same for programs; numbers that are not finite are null.
    pub fn json(&self) -> Value {
        let report = self.report;
        let reason = match &report.outcome {
            Outcome::Converged => Value::Null,
            _ => Value::from(explain::outcome(report)),
        };
        let reached = match report.outcome {
            Outcome::NormalsNotReachable { reached, .. } | Outcome::TargetNotReachable { reached } => {
                Value::from(reached)
            }
            _ => Value::Null,
        };
        let mut object = Map::new();
        let mut add = |key: &str, value: Value| _ = object.insert(key.to_owned(), value);
        add("outcome", report.outcome.name().into());
        add("reason", reason);
        add(
            "advice",
            Some(report.outcome.remedy())
                .filter(|advice| !advice.is_empty())
                .into(),
        );
        add("target", target_name(report.target).into());
        add("iterations", report.iterations.into());
        let levels = report.levels.iter().map(level);
        add("levels", levels.collect::<Vec<_>>().into());
        add("defect", report.defect.into());
        add("step", report.step.into());
        add("seconds", self.seconds());
        add("quality", self.quality());
        add("free_vertices", report.free_vertices.into());
        add("diagonal", report.diagonal.into());
        add("linear_surface", report.linear_surface.into());
        add("suspicious_normals", report.suspicious_normals.clone().into());
        add("unreachable_normals", self.blamed().to_vec().into());
        add("reached", reached);
        add("fallback_weights", report.fallback_weights.into());
        add("stale_normals", self.stale_normals.into());
        Value::Object(object)
    }

    fn seconds(&self) -> Value {
        let Times {
            read,
            solve,
            write,
            total,
        } = self.times;
        let inner = self.report.seconds;
        json!({
            "read": read, "setup": inner.setup, "solve": solve, "write": write, "total": total,
            "start": inner.start, "iterate": inner.iterate, "quality": inner.quality,
        })
    }

    fn quality(&self) -> Value {
        let quality = &self.report.quality;
        let list = |triangles: &[u32]| {
            let faces = self.faces(triangles);
            json!({ "count": faces.len(), "list": faces })
        };
        json!({
            "worst_angle": quality.worst_angle,
            "worst_triangle": self.geometry.polygon_of(quality.worst_triangle),
            "flipped": list(&quality.flipped),
            "needles": list(&quality.needles),
            "h_inside": quality.h_inside,
            "h_boundary": quality.h_boundary,
            "normal_deviation": quality.normal_deviation,
            "normal_deviation_vertex": quality.normal_deviation_vertex,
            "normal_deviation_rms": quality.normal_deviation_rms,
        })
    }
}

/// A level of the paper's scheme.
fn level(level: &LevelReport) -> Value {
    json!({
        "vertices": level.vertices,
        "triangles": level.triangles,
        "updates": level.updates,
        "defect": level.defect,
    })
}

/// Vertices and updates of all levels.
fn levels(levels: &[LevelReport]) -> String {
    let told = levels
        .iter()
        .map(|l| format!("{} vertices ({} updates)", l.vertices, l.updates));
    told.collect::<Vec<_>>().join(", ")
}

/// Two significant digits, for figures of which the order of magnitude counts.
fn scientific(value: f64) -> String {
    if value.is_finite() {
        format!("{value:.1e}")
    } else {
        "unknown".into()
    }
}

/// Four significant digits.
fn significant(value: f64) -> String {
    if !value.is_finite() {
        return "unknown".into();
    }
    if value == 0.0 || (1e-3..1e6).contains(&value.abs()) {
        let digits = if value == 0.0 {
            0.0
        } else {
            3.0 - value.abs().log10().floor()
        };
        format!("{value:.*}", digits.clamp(0.0, 8.0) as usize)
    } else {
        format!("{value:.3e}")
    }
}

fn range([low, high]: [f64; 2]) -> String {
    format!("{} to {}", significant(low), significant(high))
}

/// How many, and the first of them.
fn listed(elements: &[impl ToString], singular: &str) -> String {
    if elements.is_empty() {
        return "none".into();
    }
    let plural = if singular == "vertex" { "vertices" } else { "faces" };
    let first: Vec<String> = elements.iter().take(SHOWN).map(ToString::to_string).collect();
    let more = if elements.len() > SHOWN { ", ..." } else { "" };
    let noun = if elements.len() == 1 { singular } else { plural };
    format!("{} {noun}: {}{more}", elements.len(), first.join(", "))
}

#[cfg(test)]
mod tests {
    use fairmesh::{LooseReason, Quality, Seconds};

    use super::*;
    use crate::formats::{Format, MeshFile};

    /// Two quads: triangles 0 and 1 are face 0, 2 and 3 are face 1.
    fn quads() -> MeshFile {
        let text = "OFF 6 2 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\n4 0 1 4 3\n4 1 2 5 4\n";
        MeshFile::parse("quads.off", Format::Off, text.as_bytes().to_vec()).unwrap()
    }

    fn report(outcome: Outcome) -> Report {
        Report {
            target: Target::Constant(0.5),
            outcome,
            iterations: 7,
            defect: f64::NAN,
            step: f64::INFINITY,
            seconds: Seconds {
                setup: 0.25,
                ..Seconds::default()
            },
            quality: Quality {
                worst_angle: 0.5,
                worst_triangle: 3,
                flipped: vec![2, 3],
                needles: vec![0, 3],
                h_inside: [f64::NAN, 1.0],
                ..Quality::default()
            },
            levels: Vec::new(),
            free_vertices: 1,
            diagonal: 2.0,
            linear_surface: true,
            suspicious_normals: vec![4],
            fallback_weights: 0,
        }
    }

    #[test]
    fn faces_have_the_numbers_of_the_file_and_json_has_no_nan() {
        let (mesh, report) = (quads(), report(Outcome::NotConverged));
        let times = Times {
            read: 1.0,
            solve: 2.0,
            write: 3.0,
            total: 6.5,
        };
        let summary = Summary {
            report: &report,
            geometry: &mesh.geometry,
            times,
            stale_normals: 2,
        };
        let json = summary.json();
        assert_eq!(json["outcome"], "not_converged");
        assert_eq!(json["target"], "constant=0.5");
        assert_eq!(json["quality"]["worst_triangle"], 1);
        assert_eq!(json["quality"]["flipped"], json!({ "count": 1, "list": [1] }));
        assert_eq!(json["quality"]["needles"], json!({ "count": 2, "list": [0, 1] }));
        assert_eq!(json["quality"]["h_inside"], json!([null, 1.0]));
        assert_eq!((&json["defect"], &json["step"]), (&Value::Null, &Value::Null));
        assert_eq!(json["suspicious_normals"], json!([4]));
        assert_eq!(json["seconds"]["setup"], 0.25);
        assert_eq!(json["seconds"]["total"], 6.5);
        assert!(json["reason"].is_string() && json["advice"].is_string());
        let text = summary.readable();
        assert!(text.contains("0.5000 degrees, in face 1\n"), "{text}");
        assert!(text.contains("needles:             2 faces: 0, 1\n"), "{text}");
        assert!(!text.contains("NaN") && !text.contains("inf "), "{text}");
    }

    #[test]
    fn every_outcome_but_the_best_says_what_to_do() {
        let mesh = quads();
        let outcomes = [
            Outcome::ConvergedPoorTriangles { triangles: vec![1] },
            Outcome::ConvergedLoosely {
                reason: LooseReason::Bump,
            },
            Outcome::NormalsNotReachable {
                reached: 0.4,
                vertices: vec![5, 1],
            },
            Outcome::TargetNotReachable { reached: 0.25 },
            Outcome::NotConverged,
            Outcome::IterationLimit,
            Outcome::Cancelled,
        ];
        for outcome in outcomes {
            let report = report(outcome);
            let times = Times::default();
            let summary = Summary {
                report: &report,
                geometry: &mesh.geometry,
                times,
                stale_normals: 0,
            };
            assert!(summary.readable().contains("\n  what to do:"));
        }
        assert_eq!(Outcome::Converged.remedy(), "");
    }
}
