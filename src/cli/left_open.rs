//! Why a hole was left open, in words.

use fairmesh::OpenReason;

/// And what to do about it, where anything can be done.
pub fn why(reason: OpenReason) -> String {
    match reason {
        OpenReason::NonManifold { a, b } => {
            format!("it runs into edge ({a}, {b}), which has more than two faces")
        }
        OpenReason::Inconsistent { a, b } => {
            format!(
                "it runs into edge ({a}, {b}), whose faces are oriented inconsistently; --orient turns them"
            )
        }
        OpenReason::OuterBoundary => {
            "it encloses the mesh, not a gap; fill it by --loop if you mean it".into()
        }
        OpenReason::Hanging { vertex } => format!(
            "its faces hang at the rest of the mesh by single vertices only (vertex {vertex}); remove them, or fill it by --loop if you mean it"
        ),
        OpenReason::TooManyEdges => "it has more edges than --max-edges".into(),
        OpenReason::NoTriangulation => "every triangulation has an edge or face that is there already".into(),
        OpenReason::NotFinite { vertex } => {
            format!("vertex {vertex} is not finite, or the loop is a single point")
        }
        OpenReason::Cancelled => "the run was stopped".into(),
        OpenReason::OppositeSides { a, b } => format!(
            "loops {a} and {b} fit only if the faces at one of them faced the other way; {}",
            reason.entry().remedy()
        ),
        OpenReason::SharedVertex { vertex } => {
            format!(
                "two of the loops have vertex {vertex}; {}",
                reason.entry().remedy()
            )
        }
        OpenReason::NotAsked => "it is not one of those asked for".into(),
        OpenReason::NotFair | OpenReason::Intersecting => {
            format!("{}; {}", reason.entry().text(), reason.entry().remedy())
        }
        _ => "unknown".into(),
    }
}
