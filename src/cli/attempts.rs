//! The attempts at the surfaces of the components in the report.

use fairmesh::{Attempt, ComponentReport};
use serde_json::{Value, json};

use crate::figures::significant;

/// A line for each attempt, in their order; where there are several components, each begins with its smallest free vertex.
pub fn lines(components: &[ComponentReport]) -> Vec<String> {
    let are_several = components.len() > 1;
    let of_component = |component: &ComponentReport| {
        let whose = match are_several {
            true => format!("vertex {}: ", component.vertex),
            false => String::new(),
        };
        let told = component
            .attempts
            .iter()
            .map(|attempt| format!("{whose}{}", line(attempt)));
        told.collect::<Vec<_>>()
    };
    components.iter().flat_map(of_component).collect()
}

fn line(of: &Attempt) -> String {
    let energy = match of.bending_energy.is_finite() {
        true => format!(", bending energy {}", significant(of.bending_energy)),
        false => String::new(),
    };
    format!(
        "{}, {} free vertices: {} after {} iterations{energy}",
        of.name,
        of.free_vertices,
        of.end.name().replace('_', " "),
        of.iterations,
    )
}

/// The same for programs.
pub fn json<'a>(attempts: impl IntoIterator<Item = &'a Attempt>) -> Value {
    let told = attempts.into_iter().map(|of| {
        json!({
            "free_vertices": of.free_vertices,
            "name": of.name,
            "iterations": of.iterations,
            "end": of.end.name(),
            "bending_energy": of.bending_energy,
        })
    });
    told.collect()
}

#[cfg(test)]
mod tests {
    use fairmesh::{AttemptEnd, Outcome, Quality};

    use super::*;

    fn component(vertex: usize) -> ComponentReport {
        let attempt = |name, end, bending_energy| Attempt {
            free_vertices: 117,
            name,
            iterations: 7,
            end,
            bending_energy,
        };
        ComponentReport {
            continuity: Vec::new(),
            vertex,
            free_vertices: 900,
            outcome: Outcome::Converged,
            iterations: 14,
            defect: 0.0,
            step: 0.0,
            diagonal: 1.0,
            least_bending: false,
            attempts: vec![
                attempt("direct", AttemptEnd::NotConverged, f64::NAN),
                attempt("membrane metric", AttemptEnd::Sound, 12.5),
            ],
            quality: Quality::default(),
        }
    }

    #[test]
    fn attempts_are_told_with_their_mesh_and_their_end() {
        let one = lines(&[component(3)]);
        assert_eq!(
            one,
            [
                "direct, 117 free vertices: not converged after 7 iterations",
                "membrane metric, 117 free vertices: sound after 7 iterations, bending energy 12.50",
            ]
        );
        let two = lines(&[component(3), component(8)]);
        assert_eq!(two.len(), 4);
        assert_eq!(two[3], format!("vertex 8: {}", one[1]));
        let told = json(&component(3).attempts);
        assert_eq!(told[0]["bending_energy"], Value::Null);
        assert_eq!(told[1]["end"], "sound");
    }
}
