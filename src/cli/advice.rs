//! What to do about a fairing, in the flags of this program.

use fairmesh::{LooseReason, Outcome};

/// Whether other triangles may change such an outcome.
pub fn may_depend_on_triangles(outcome: &Outcome) -> bool {
    match outcome {
        Outcome::ConvergedLoosely { reason } => *reason == LooseReason::Bump,
        Outcome::Converged
        | Outcome::Cancelled
        | Outcome::IterationLimit
        | Outcome::PoorWhenRounded { .. }
        | Outcome::TargetNotReachable { .. } => false,
        _ => true,
    }
}

/// Empty after a success. `has_with_others`: whether the region has a sound surface with other triangles, where that was tried.
pub fn of_fairing(outcome: &Outcome, has_with_others: Option<bool>) -> &'static str {
    if has_with_others == Some(true) {
        return "give --remesh: with other triangles this region has a sound surface";
    }
    match outcome {
        Outcome::NotConverged => {
            "select more, or give other boundary normals: --normals averaged, or a file (flipped? noise?)"
        }
        Outcome::ConvergedPoorTriangles { .. } => {
            "look at these triangles; --inner-fairness uniform usually cures them"
        }
        Outcome::IterationLimit => "allow more --max-iterations, or fair the result once more",
        Outcome::TargetNotReachable { .. } => {
            "give a smaller constant to --target, or select a smaller region"
        }
        Outcome::ConvergedLoosely { reason } => match reason {
            LooseReason::Bump => {
                "look at it; --inner-fairness conformal, a larger region, or one with a smoother boundary, usually cures it"
            }
            LooseReason::Tolerance => {
                "give a larger --tolerance: the last step is the smallest that can be met here"
            }
            LooseReason::Curvature => {
                "look at it; give a smaller --continuity, or none, or select a larger region"
            }
            LooseReason::SharpEdge => {
                "select so much that the sharp edge ends outside, or leaves the region again; or give --remesh, or --sharp off"
            }
            _ => outcome.remedy(),
        },
        _ => outcome.remedy(),
    }
}

/// The same for a patch that 'fill' or 'bridge' has made, in the flags that these have.
pub fn of_patch(is_bridge: bool, outcome: &Outcome) -> &'static str {
    match outcome {
        Outcome::Converged | Outcome::Cancelled | Outcome::PoorWhenRounded { .. } => outcome.remedy(),
        Outcome::IterationLimit => {
            "allow more --max-iterations (of a bridge, or a patch of several loops), or fair the result once more"
        }
        Outcome::NearestMember { .. } => "look at it: it is fair, but bends by another equation",
        Outcome::ConvergedLoosely {
            reason: LooseReason::Tolerance,
        } => of_fairing(outcome, None),
        Outcome::ConvergedLoosely {
            reason: LooseReason::Curvature,
        } if !is_bridge => "look at it; give a smaller --continuity, or none",
        Outcome::ConvergedLoosely {
            reason: LooseReason::SharpEdge,
        } if !is_bridge => {
            "--erase so much around it that the sharp edge leaves the hole again, or give --sharp off"
        }
        _ if is_bridge => "look at it; begin or end the bridge elsewhere, or give another --width",
        _ => {
            "look at it; --relax-rim auto smooths a rough boundary, --trim takes slender faces there away, --erase more around it"
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_triangles_are_advised_where_they_are_known_to_help_and_nowhere_else() {
        let bump = Outcome::ConvergedLoosely {
            reason: LooseReason::Bump,
        };
        for outcome in [Outcome::NotConverged, bump] {
            assert!(may_depend_on_triangles(&outcome));
            assert!(of_fairing(&outcome, Some(true)).contains("--remesh"));
            for tried in [None, Some(false)] {
                let told = of_fairing(&outcome, tried);
                assert!(told.contains("--") && !told.contains("remesh"), "{told}");
            }
        }
        assert!(!may_depend_on_triangles(&Outcome::Converged));
        assert_eq!(of_patch(false, &Outcome::Converged), "");
        assert_eq!(of_fairing(&Outcome::Converged, None), "");
    }
}
