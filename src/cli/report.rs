//! The report at the end of a run: for people and as JSON.

use std::fmt::{Display, Write};

use fairmesh::{ComponentReport, LevelReport, Outcome, Quality, Report, Target};
use serde_json::{Value, json};

use crate::advice;
use crate::attempts;
use crate::component_report;
use crate::continuity::{self, Asked};
use crate::explain;
use crate::figures::{FACES, PAIRS, VERTICES, listed, range, scientific, significant};

use crate::formats::Geometry;
use crate::region::RegionReport;
use crate::sharp_edges;
use crate::surface::target_name;

/// Seconds of the command; `solve` is the library's whole call, `setup` the part of it before any solving.
#[derive(Debug, Clone, Copy, Default)]
pub struct Times {
    pub read: f64,
    pub solve: f64,
    pub write: f64,
    /// Pictures and pages, if any were asked for.
    pub pictures: Option<f64>,
    pub total: f64,
}

/// Everything there is to tell.
pub struct Summary<'a> {
    pub report: &'a Report,
    pub geometry: &'a Geometry,
    pub region: &'a RegionReport,
    pub times: Times,
    /// Vertices whose normals in the file could not be updated.
    pub stale_normals: usize,
    /// Whether the attempts are listed for people, too.
    pub is_verbose: bool,
    /// Whether more than tangent planes was to be continued.
    pub asked: Asked,
    /// Whether the region has a sound surface with other triangles, where that was tried.
    pub has_with_others: Option<bool>,
}

/// The readable report.
struct Table(String);

impl Table {
    fn row(&mut self, name: &str, value: impl Display) {
        let name = if name.is_empty() {
            String::new()
        } else {
            format!("{name}:")
        };
        let _ = writeln!(self.0, "  {name:<20} {value}");
    }

    /// Several lines under one name.
    fn rows(&mut self, name: &str, lines: Vec<String>) {
        let names = std::iter::once(name).chain(std::iter::repeat(""));
        names.zip(lines).for_each(|(name, line)| self.row(name, line));
    }
}

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

    /// What to do about the outcome; empty after a success.
    pub fn advice(&self) -> &'static str {
        advice::of_fairing(&self.report.outcome, self.has_with_others)
    }

    /// Lines for people.
    pub fn readable(&self) -> String {
        let mut table = Table(format!("{}\n", explain::outcome(self.report)));
        let advice = self.advice();
        if !advice.is_empty() {
            table.row("what to do", advice);
        }
        table.rows("region", self.region.told.clone());
        self.tell_run(&mut table);
        self.tell_quality(&mut table);
        self.tell_remarks(&mut table);
        let Times {
            read,
            solve,
            write,
            pictures,
            total,
        } = self.times;
        let pictures = pictures.map_or(String::new(), |pictures| format!(", pictures {pictures:.2}"));
        table.row(
            "seconds",
            format_args!("{total:.2} (read {read:.2}, solve {solve:.2}, write {write:.2}{pictures})"),
        );
        table.0
    }

    fn tell_run(&self, table: &mut Table) {
        let report = self.report;
        table.row("free vertices", report.free_vertices);
        for (name, line) in component_report::lines(&report.components) {
            table.row(name, line);
        }
        let (iterations, step) = (report.iterations, scientific(report.step));
        table.row(
            "iterations",
            format_args!("{iterations}, last step {step} of the region's diagonal"),
        );
        if self.is_verbose {
            self.tell_attempts(table);
        }
        if !report.levels.is_empty() {
            table.row("levels", levels(&report.levels));
        }
        if report.target == Target::Harmonic {
            table.row("harmonic defect", scientific(report.defect));
        } else {
            table.row("target", target_name(report.target));
            table.row("defect", scientific(report.defect));
        }
        table.row("region's diagonal", significant(report.diagonal));
    }

    fn tell_attempts(&self, table: &mut Table) {
        table.rows("attempts", attempts::lines(&self.report.components));
        let energy = self.report.quality.bending_energy;
        table.row("bending energy", significant(energy));
    }

    fn tell_quality(&self, table: &mut Table) {
        let quality = &self.report.quality;
        let angle = significant(quality.worst_angle);
        let worst = self.geometry.polygon_of(quality.worst_triangle);
        table.row("smallest angle", format_args!("{angle} degrees, in face {worst}"));
        let (edge, [a, b]) = (significant(quality.sharpest_edge), quality.sharpest_edge_vertices);
        table.row(
            "sharpest edge",
            format_args!("{edge} degrees, between vertices {a} and {b}"),
        );
        table.row("flipped", listed(&self.faces(&quality.flipped), FACES));
        table.row("needles", listed(&self.faces(&quality.needles), FACES));
        table.row("curvature inside", range(quality.h_inside));
        table.row("curvature boundary", range(quality.h_boundary));
        let deviation = significant(quality.normal_deviation);
        let rms = significant(quality.normal_deviation_rms);
        let vertex = quality.normal_deviation_vertex;
        table.row(
            "normal deviation",
            format_args!("at most {deviation} degrees (vertex {vertex}), rms {rms}"),
        );
        let (kink, before) = (
            significant(quality.boundary_kink),
            significant(quality.boundary_kink_before),
        );
        let vertex = quality.boundary_kink_vertex;
        table.row(
            "boundary kink",
            format_args!("at most {kink} degrees (vertex {vertex}, {before} in the input)"),
        );
        table.rows(
            "continuity",
            continuity::lines(&self.report.components, self.asked),
        );
    }

    /// Intersecting triangles as pairs of faces of the file.
    fn intersections(&self) -> Option<Vec<[usize; 2]>> {
        let found = self.report.self_intersections.as_ref()?;
        let face = |t: u32| self.geometry.polygon_of(t as usize);
        let mut pairs: Vec<[usize; 2]> = found.pairs.iter().map(|pair| pair.map(face)).collect();
        // Two triangles of one quad may cross another face.
        pairs.sort_unstable();
        pairs.dedup();
        Some(pairs)
    }

    fn tell_intersections(&self, table: &mut Table) {
        let (Some(pairs), Some(found)) = (self.intersections(), &self.report.self_intersections) else {
            return;
        };
        let shown: Vec<String> = pairs.iter().map(|[a, b]| format!("{a} and {b}")).collect();
        let mut told = listed(&shown, PAIRS);
        if !pairs.is_empty() {
            let _ = write!(told, " (in the input {} pairs of triangles)", found.in_input);
        }
        table.row("intersections", told);
    }

    /// What is not so in every run.
    fn tell_remarks(&self, table: &mut Table) {
        self.tell_intersections(table);
        let report = self.report;
        table.rows("sharp edges", sharp_edges::lines(&report.sharp_edges));
        if report.least_bending {
            table.row("surface", "that of least bending");
        }
        let count = report.fallback_weights;
        if count > 0 {
            table.row(
                "fallback weights",
                format_args!("{count} vertices (inner fairness does not spread them as asked)"),
            );
        }
        if !creased(self.report).is_empty() {
            table.row("crease at", listed(creased(self.report), VERTICES));
        }
        if !report.suspicious_normals.is_empty() {
            let vertices = listed(&report.suspicious_normals, VERTICES);
            table.row(
                "suspicious normals",
                format_args!("{vertices} (probably flipped or wrong)"),
            );
        }
        let count = self.stale_normals;
        if count > 0 {
            table.row(
                "normals not updated",
                format_args!("{count} vertices share theirs with others"),
            );
        }
    }

    /// The same for programs; numbers that are not finite are null.
    pub fn json(&self) -> Value {
        let report = self.report;
        let reason = (report.outcome != Outcome::Converged).then(|| explain::outcome(report));
        let advice = Some(self.advice()).filter(|advice| !advice.is_empty());
        let reached = match report.outcome {
            Outcome::TargetNotReachable { reached } => Some(reached),
            _ => None,
        };
        json!({
            "outcome": report.outcome.name(),
            "reason": reason,
            "advice": advice,
            "region": self.region.json(),
            "target": target_name(report.target),
            "iterations": report.iterations,
            "levels": report.levels.iter().map(level).collect::<Vec<_>>(),
            "defect": report.defect,
            "step": report.step,
            "seconds": self.seconds(),
            "quality": self.quality(&report.quality),
            "components": report.components.iter().map(|c| self.component(c)).collect::<Vec<_>>(),
            "free_vertices": report.free_vertices,
            "diagonal": report.diagonal,
            "least_bending": report.least_bending,
            "suspicious_normals": report.suspicious_normals,
            "creased_vertices": creased(self.report),
            "reached": reached,
            "member_weight": member_weight(&report.outcome),
            "fallback_weights": report.fallback_weights,
            "sharp_edges": sharp_edges::json(&report.sharp_edges),
            "stale_normals": self.stale_normals,
            "intersections": self.intersections().map(|pairs| json!({
                "count": pairs.len(),
                "list": pairs,
                "in_input": report.self_intersections.as_ref().map(|found| found.in_input),
            })),
        })
    }

    fn seconds(&self) -> Value {
        let Times {
            read,
            solve,
            write,
            pictures,
            total,
        } = self.times;
        let inner = self.report.seconds;
        json!({
            "read": read, "setup": inner.setup, "solve": solve, "write": write, "pictures": pictures,
            "total": total,
            "start": inner.start, "iterate": inner.iterate, "quality": inner.quality,
        })
    }

    fn component(&self, of: &ComponentReport) -> Value {
        json!({
            "vertex": of.vertex,
            "free_vertices": of.free_vertices,
            "outcome": of.outcome.name(),
            "iterations": of.iterations,
            "defect": of.defect,
            "step": of.step,
            "diagonal": of.diagonal,
            "least_bending": of.least_bending,
            "member_weight": member_weight(&of.outcome),
            "attempts": attempts::json(&of.attempts),
            "continuity": continuity::json(&of.continuity),
            "quality": self.quality(&of.quality),
        })
    }

    fn quality(&self, quality: &Quality) -> Value {
        let list = |triangles: &[u32]| {
            let faces = self.faces(triangles);
            json!({ "count": faces.len(), "list": faces })
        };
        json!({
            "worst_angle": quality.worst_angle,
            "worst_triangle": self.geometry.polygon_of(quality.worst_triangle),
            "sharpest_edge": quality.sharpest_edge,
            "sharpest_edge_vertices": quality.sharpest_edge_vertices,
            "flipped": list(&quality.flipped),
            "needles": list(&quality.needles),
            "h_inside": quality.h_inside,
            "h_boundary": quality.h_boundary,
            "normal_deviation": quality.normal_deviation,
            "normal_deviation_vertex": quality.normal_deviation_vertex,
            "normal_deviation_rms": quality.normal_deviation_rms,
            "boundary_kink": quality.boundary_kink,
            "boundary_kink_vertex": quality.boundary_kink_vertex,
            "boundary_kink_before": quality.boundary_kink_before,
            "bending_energy": quality.bending_energy,
        })
    }
}

/// The vertices of a crease along the boundary.
pub fn creased(report: &Report) -> &[u32] {
    match &report.outcome {
        Outcome::BoundaryCrease { vertices } => vertices,
        _ => &[],
    }
}

/// Which member of the family the surface is, where no harmonic one was found.
pub fn member_weight(of: &Outcome) -> Option<f64> {
    match of {
        Outcome::NearestMember { weight } => Some(*weight),
        _ => None,
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

#[cfg(test)]
mod tests {
    use fairmesh::{LooseReason, Quality, Seconds, SelfIntersections};

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
            least_bending: true,
            suspicious_normals: vec![4],
            fallback_weights: 0,
            self_intersections: Some(SelfIntersections {
                pairs: vec![[0, 2], [1, 2], [1, 3]],
                in_input: 1,
            }),
            sharp_edges: Vec::new(),
            components: Vec::new(),
        }
    }

    fn component(vertex: usize, outcome: Outcome) -> ComponentReport {
        ComponentReport {
            continuity: Vec::new(),
            vertex,
            free_vertices: 5,
            outcome,
            iterations: 3,
            defect: 0.5,
            step: f64::NAN,
            diagonal: 2.0,
            least_bending: false,
            attempts: Vec::new(),
            quality: Quality {
                worst_angle: 31.0,
                worst_triangle: 3,
                ..Quality::default()
            },
        }
    }

    #[test]
    fn components_are_listed_where_there_are_several() {
        let mesh = quads();
        let mut report = report(Outcome::NotConverged);
        let told = |components: Vec<ComponentReport>, report: &mut Report| {
            report.components = components;
            let summary = Summary {
                report,
                geometry: &mesh.geometry,
                region: &RegionReport::default(),
                times: Times::default(),
                stale_normals: 0,
                is_verbose: false,
                asked: Asked::Tangent,
                has_with_others: None,
            };
            (summary.readable(), summary.json())
        };
        let (text, json) = told(vec![component(0, Outcome::NotConverged)], &mut report);
        assert!(!text.contains("components"), "{text}");
        assert_eq!(json["components"][0]["free_vertices"], 5);
        let both = vec![
            component(0, Outcome::Converged),
            component(7, Outcome::NotConverged),
        ];
        let (text, json) = told(both, &mut report);
        assert!(
            text.contains("components:          2: 1 converged, 1 not converged\n"),
            "{text}"
        );
        assert!(
            text.contains("vertex 7 and 4 more: not converged, 3 iterations"),
            "{text}"
        );
        assert_eq!(json["components"][1]["quality"]["worst_triangle"], 1);
        assert_eq!(json["components"][1]["step"], Value::Null);
        // Of many only those that need a look.
        let many = (0..30).map(|v| {
            let outcome = if v % 3 == 0 {
                Outcome::NotConverged
            } else {
                Outcome::Converged
            };
            component(v, outcome)
        });
        let (text, _) = told(many.collect(), &mut report);
        assert!(
            text.contains("components:          30: 20 converged, 10 not converged\n"),
            "{text}"
        );
        assert!(
            text.contains("vertex 0 and 4") && !text.contains("vertex 1 and 4"),
            "{text}"
        );
        assert!(text.contains("and 2 more\n"), "{text}");
    }

    #[test]
    fn faces_have_the_numbers_of_the_file_and_json_has_no_nan() {
        let (mesh, report) = (quads(), report(Outcome::NotConverged));
        let times = Times {
            read: 1.0,
            solve: 2.0,
            write: 3.0,
            pictures: None,
            total: 6.5,
        };
        let summary = Summary {
            report: &report,
            geometry: &mesh.geometry,
            region: &RegionReport::default(),
            times,
            stale_normals: 2,
            is_verbose: false,
            asked: Asked::Tangent,
            has_with_others: None,
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
        assert!(json["reason"].is_string(), "{json}");
        assert!(json["advice"].is_string(), "{json}");
        let pairs = json!({ "count": 1, "list": [[0, 1]], "in_input": 1 });
        assert_eq!(json["intersections"], pairs);
        let text = summary.readable();
        assert!(
            text.contains("1 pair of faces: 0 and 1 (in the input 1 pairs of triangles)\n"),
            "{text}"
        );
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
            Outcome::TargetNotReachable { reached: 0.25 },
            Outcome::SelfIntersecting { pairs: 3 },
            Outcome::NotConverged,
            Outcome::IterationLimit,
            Outcome::Cancelled,
            Outcome::BoundaryCrease { vertices: vec![2, 5] },
            Outcome::PoorWhenRounded { triangles: vec![1] },
            Outcome::NearestMember { weight: 0.25 },
        ];
        for outcome in outcomes {
            let report = report(outcome);
            let times = Times::default();
            let summary = Summary {
                report: &report,
                geometry: &mesh.geometry,
                region: &RegionReport::default(),
                times,
                stale_normals: 0,
                is_verbose: false,
                asked: Asked::Tangent,
                has_with_others: None,
            };
            let text = summary.readable();
            assert_contains!(text, "\n  what to do:");
            let is_member = matches!(report.outcome, Outcome::NearestMember { .. });
            assert_eq!(text.contains("with w = 0.2500; w is 0 for harmonic"), is_member);
        }
        assert_eq!(Outcome::Converged.remedy(), "");
    }
}
