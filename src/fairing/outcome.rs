//! How a run ended.

#[cfg(doc)]
use super::options::Options;
use crate::support::table::{Entry, choices, table};

/// How the run ended. The positions are usable in every case.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Outcome {
    /// Tolerance met and the surface is sound.
    Converged,
    /// Tolerance met, but some triangles are flipped or have an angle below one degree.
    ConvergedPoorTriangles {
        /// Those triangles.
        triangles: Vec<u32>,
    },
    /// Tolerance met and no triangle is poor, but triangles of the surface intersect each other or the rest of the mesh.
    SelfIntersecting {
        /// How many pairs; [`Report::self_intersections`](crate::Report::self_intersections) names them.
        pairs: usize,
    },
    /// Tolerance met and no triangle is poor, but something else is to be said of the surface.
    ConvergedLoosely {
        /// What.
        reason: LooseReason,
    },
    /// A surface was found only for a part of the right-hand side of [`Options::target`]; that of least bending is returned.
    TargetNotReachable {
        /// The part, 0 to 1: a constant `c` was too large by the inverse.
        reached: f64,
    },
    /// No sound surface was found; that of least bending is returned, tangent to the surroundings as far as it can be.
    NotConverged,
    /// The iteration limit was reached; the best surface so far is returned.
    IterationLimit,
    /// The progress callback stopped the run; the best surface so far is returned, before there is one the input. Of several
    /// components those that were done keep their results, and those not begun yet are as in the input.
    Cancelled,
    /// Tolerance met and the surface is sound, but triangles are flipped or have an angle below one degree once the positions
    /// are rounded to [`Options::output_precision`].
    PoorWhenRounded {
        /// Those triangles.
        triangles: Vec<u32>,
    },
    /// No sound harmonic surface was found between these boundary conditions. The surface solves `Delta_B H = -2 w H (H^2 - K)`
    /// to the tolerance instead, of the family between the harmonic equation (`w` = 0) and that of minimal energy (`w` = 1) the
    /// member nearest to harmonic that was found sound. It meets the boundary normals as a harmonic surface does.
    NearestMember {
        /// Its `w`, over 0 and at most 1.
        weight: f64,
    },
    /// Tolerance met and no triangle is poor, but along the boundary the surface has a crease against the outside, or against
    /// the normals that were given: a kink of more than 45 degrees that exceeds by more than 15 degrees what given normals ask
    /// for and what the input has there (of which no more counts than 45 degrees, or than the outside turns to the next
    /// boundary vertices), or a deviation from the boundary normal of more than 60 degrees.
    BoundaryCrease {
        /// The boundary vertices where it has, ascending.
        vertices: Vec<u32>,
    },
}

choices! {
    /// What is to be said of a surface that [`Outcome::ConvergedLoosely`].
    #[non_exhaustive]
    LooseReason {
        1 "suspicious_normals" SuspiciousNormals =>
            "boundary normals point against the surface beside them: probably flipped",
            "check the suspicious normals that the report names: turn them around, or give none there";
        2 "rounding" Rounding =>
            "max |Delta_B H| is as small as the rounding of the positions allows, but above its limit",
            "set a larger limit, or move the mesh near to the origin and give it in double precision";
        4 "bump" Bump =>
            "the surface has a bump: its curvature inside exceeds what the boundary allows, or it folds at single edges or leaves single normals",
            "look at it; conformal inner fairness, a larger region, or one with a smoother boundary, usually cures it";
        5 "tolerance" Tolerance =>
            "the steps have become as small as double precision allows here, but stay above the tolerance",
            "ask for a larger tolerance: the last step in the report is the smallest that can be met here";
        6 "drawn_normals" DrawnNormals =>
            "no sound surface over this hole has the normals of the mesh: they were drawn towards those of a membrane",
            "look at it; clean the boundary of the hole, or remove faces around it, and fill it again";
        7 "curvature" Curvature =>
            "less than half of the curvature asked for was continued: the surroundings are too rough, or no sound surface has it",
            "look at it; ask for less continuity, or for tangent planes alone, or select a larger region";
        8 "sharp_edge" SharpEdge =>
            "a sharp edge of the surroundings ends at the boundary, at the vertices that the report names, and does not go on",
            "select so much that the edge ends outside, or leaves the region again; or triangulate the region anew";
    }
}

table!(Outcome {
    0 "converged" Outcome::Converged => "tolerance met, and the surface is sound", "";
    1 "converged_poor_triangles" Outcome::ConvergedPoorTriangles { .. } =>
        "tolerance met, but triangles are flipped or have an angle below one degree",
        "look at these triangles; remeshing the region, or uniform inner fairness, usually cures them";
    2 "converged_loosely" Outcome::ConvergedLoosely { .. } =>
        "tolerance met, and no triangle is poor, but the surface has a reservation, which the reason names",
        "see the remedy of the reason";
    4 "target_not_reachable" Outcome::TargetNotReachable { .. } =>
        "a surface was found for a part of the target only; that of least bending is returned",
        "ask for a smaller constant, or select a smaller region";
    5 "not_converged" Outcome::NotConverged =>
        "no sound surface was found; that of least bending is returned",
        "select more, check the boundary normals (flipped? noise?) or average them, or remesh the region";
    6 "iteration_limit" Outcome::IterationLimit =>
        "the iterations ran out; the best surface so far is returned",
        "allow more iterations, or fair the result once more";
    7 "cancelled" Outcome::Cancelled =>
        "the progress callback stopped the run; the best surface so far is returned, before there is one the input",
        "run it again, to its end";
    8 "boundary_crease" Outcome::BoundaryCrease { .. } =>
        "tolerance met, but the surface has a crease along the boundary, at the vertices that the report names",
        "move the boundary away from sharp features or noise: select more or less there; or refine the mesh there";
    9 "self_intersecting" Outcome::SelfIntersecting { .. } =>
        "tolerance met, and no triangle is poor, but triangles of the surface intersect each other or the rest of the mesh",
        "look at these triangles; select more, prescribe other normals, or fill the region as a hole";
    10 "poor_when_rounded" Outcome::PoorWhenRounded { .. } =>
        "tolerance met, but rounding the positions to the numbers that are written flips triangles or leaves them without angles",
        "write the mesh in double precision, or move it near to the origin";
    11 "nearest_member" Outcome::NearestMember { .. } =>
        "no harmonic surface was found; a smooth one with the same normals, between harmonic and minimal energy, is returned",
        "look at it: it is fair, but bends by another equation; less extreme normals, or another region, may have a harmonic surface";
});

impl Outcome {
    /// Tolerance met and the surface is sound: the only case without reservation.
    ///
    /// ```
    /// use fairmesh::Outcome;
    ///
    /// assert!(Outcome::Converged.is_success() && Outcome::Converged.remedy().is_empty());
    /// let limit = Outcome::IterationLimit;
    /// println!("{}: {}; {}", limit.name(), limit.text(), limit.remedy());
    /// assert!(!limit.is_success() && !limit.remedy().is_empty());
    /// ```
    pub fn is_success(&self) -> bool {
        matches!(self, Outcome::Converged)
    }

    /// A success becomes one with a reservation: a sharp edge stops at the boundary.
    pub(crate) fn reserve_edge(&mut self) {
        if self.is_success() {
            let reason = LooseReason::SharpEdge;
            *self = Self::ConvergedLoosely { reason };
        }
    }

    /// A success, or one with other poor triangles, becomes one with this poor triangle.
    pub(crate) fn reserve_triangle(&mut self, triangle: u32) {
        match self {
            Self::ConvergedPoorTriangles { triangles } | Self::PoorWhenRounded { triangles } => {
                triangles.push(triangle);
                triangles.sort_unstable();
            }
            _ if self.is_tolerance_met() => {
                *self = Self::ConvergedPoorTriangles {
                    triangles: vec![triangle],
                };
            }
            _ => {}
        }
    }

    /// A success, or a surface with creases elsewhere, becomes one with a crease at this vertex.
    pub(crate) fn reserve_crease(&mut self, vertex: u32) {
        match self {
            Self::BoundaryCrease { vertices } => {
                vertices.push(vertex);
                vertices.sort_unstable();
                vertices.dedup();
            }
            Self::Converged | Self::ConvergedLoosely { .. } | Self::NearestMember { .. } => {
                *self = Self::BoundaryCrease {
                    vertices: vec![vertex],
                };
            }
            _ => {}
        }
    }

    /// Tolerance met, with whatever reservation.
    pub(crate) fn is_tolerance_met(&self) -> bool {
        matches!(
            self,
            Self::Converged
                | Self::ConvergedPoorTriangles { .. }
                | Self::ConvergedLoosely { .. }
                | Self::NearestMember { .. }
                | Self::BoundaryCrease { .. }
                | Self::PoorWhenRounded { .. }
        )
    }

    /// Tolerance met, but some triangles are poor, or will be once they are written.
    pub(crate) fn has_poor_triangles(&self) -> bool {
        matches!(
            self,
            Self::ConvergedPoorTriangles { .. } | Self::PoorWhenRounded { .. }
        )
    }

    /// What the outcome means: its text in the table, or that of its reason.
    pub fn text(&self) -> &'static str {
        self.most_telling().text()
    }

    /// What the user can do about it; empty if there is nothing to do.
    pub fn remedy(&self) -> &'static str {
        self.most_telling().remedy()
    }

    /// The outcome of a whole: the worst of its parts', with what all parts of that outcome tell of it. From bad to good:
    /// cancelled, iteration limit, not converged, target not reachable, poor triangles, boundary crease, intersecting,
    /// nearest member, loosely, converged.
    pub(crate) fn of_all(parts: &[&Self]) -> Self {
        let first = parts
            .iter()
            .copied()
            .reduce(|a, b| if b.severity() > a.severity() { b } else { a });
        let mut whole = first.cloned().unwrap_or(Self::Converged);
        let all = |list: fn(&Self) -> &[u32]| {
            let mut all: Vec<u32> = parts.iter().flat_map(|o| list(o)).copied().collect();
            all.sort_unstable();
            all.dedup();
            all
        };
        match &mut whole {
            Self::ConvergedPoorTriangles { triangles } => *triangles = all(Self::poor),
            Self::PoorWhenRounded { triangles } => *triangles = all(Self::poor_when_rounded),
            Self::BoundaryCrease { vertices } => *vertices = all(Self::creased),
            Self::TargetNotReachable { reached: least } => {
                for part in parts {
                    if let Self::TargetNotReachable { reached } = part {
                        *least = least.min(*reached);
                    }
                }
            }
            Self::NearestMember { weight: most } => {
                for part in parts {
                    if let Self::NearestMember { weight } = part {
                        *most = most.max(*weight);
                    }
                }
            }
            _ => {}
        }
        whole
    }

    /// The larger the worse.
    fn severity(&self) -> u32 {
        match self {
            Self::Converged => 0,
            Self::ConvergedLoosely { reason } => match reason {
                LooseReason::Curvature => 2,
                LooseReason::Rounding => 3,
                LooseReason::Tolerance => 4,
                LooseReason::SuspiciousNormals => 5,
                LooseReason::Bump => 6,
                LooseReason::DrawnNormals => 7,
                LooseReason::SharpEdge => 8,
            },
            Self::NearestMember { .. } => 9,
            Self::SelfIntersecting { .. } => 10,
            Self::BoundaryCrease { .. } => 11,
            Self::PoorWhenRounded { .. } => 12,
            Self::ConvergedPoorTriangles { .. } => 13,
            Self::TargetNotReachable { .. } => 14,
            Self::NotConverged => 15,
            Self::IterationLimit => 16,
            Self::Cancelled => 17,
        }
    }

    fn poor(&self) -> &[u32] {
        match self {
            Self::ConvergedPoorTriangles { triangles } => triangles,
            _ => &[],
        }
    }

    fn poor_when_rounded(&self) -> &[u32] {
        match self {
            Self::PoorWhenRounded { triangles } => triangles,
            _ => &[],
        }
    }

    fn creased(&self) -> &[u32] {
        match self {
            Self::BoundaryCrease { vertices } => vertices,
            _ => &[],
        }
    }

    fn most_telling(&self) -> &'static Entry {
        match self {
            Outcome::ConvergedLoosely { reason } => reason.entry(),
            outcome => outcome.entry(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_whole_is_as_far_from_harmonic_as_its_farthest_component() {
        let member = |weight| Outcome::NearestMember { weight };
        let bump = Outcome::ConvergedLoosely {
            reason: LooseReason::Bump,
        };
        let parts = [
            &Outcome::Converged,
            &member(0.25),
            &bump,
            &member(0.5),
            &member(0.125),
        ];
        assert_eq!(Outcome::of_all(&parts), member(0.5));
        let crossing = Outcome::SelfIntersecting { pairs: 1 };
        assert_eq!(Outcome::of_all(&[&member(0.25), &crossing]), crossing);
    }
}
