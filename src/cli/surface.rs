//! The choice of the surface: its equation, and what it leaves open.

use clap::{Args, ValueEnum};
use fairmesh::{Coincident, Discretization, InnerFairness, InteriorNormals, Intersections, Target};

/// How vertices are distributed within the surface.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum InnerFairnessKind {
    /// A regular distribution
    Uniform,
    /// The least distortion of the input's triangles
    Conformal,
    /// Nearly that, by positive weights for any triangles
    Convex,
}

/// Normals of fixed vertices inside the region.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum InteriorNormalsKind {
    /// The surface passes through them smoothly
    Smooth,
    /// From their triangles in the input
    Input,
}

/// How normals and mean curvature are discretized.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum DiscretizationKind {
    /// Second order on irregular meshes
    SecondOrder,
    /// As Schneider and Kobbelt 2001
    Paper,
}

/// Whether surfaces are checked for self-intersections.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum IntersectionsKind {
    /// Against themselves and the rest of the mesh
    Check,
    /// Not at all
    Skip,
}

/// The flag of the check for self-intersections.
#[derive(Debug, Args)]
pub struct IntersectionArgs {
    /// Check the result for triangles that intersect each other or the rest of the mesh
    #[arg(long, value_enum, value_name = "WHETHER", default_value = "check")]
    intersections: IntersectionsKind,
}

impl IntersectionArgs {
    pub fn intersections(&self) -> Intersections {
        match self.intersections {
            IntersectionsKind::Check => Intersections::Check,
            IntersectionsKind::Skip => Intersections::Skip,
        }
    }
}

/// Flags of the surface.
#[derive(Debug, Args)]
#[command(next_help_heading = "Surface")]
pub struct SurfaceArgs {
    /// Normals of fixed vertices inside the region
    #[arg(long, value_enum, value_name = "WHICH", default_value = "smooth")]
    interior_normals: InteriorNormalsKind,
    /// How vertices are distributed within the surface
    #[arg(long, value_enum, value_name = "HOW", default_value = "uniform")]
    inner_fairness: InnerFairnessKind,
    /// The equation: the Laplacian of the mean curvature H is 0 ('harmonic'),
    /// C per cubic length, which pushes outward if positive ('constant=C'),
    /// or -2 H (H^2 - K) ('minimal-energy')
    #[arg(
        long,
        value_name = "WHAT",
        default_value = "harmonic",
        value_parser = target,
        verbatim_doc_comment
    )]
    pub target: Target,
    /// How normals and mean curvature are discretized
    #[arg(long, value_enum, value_name = "HOW", default_value = "second-order")]
    discretization: DiscretizationKind,
}

impl SurfaceArgs {
    pub fn interior_normals(&self) -> InteriorNormals {
        match self.interior_normals {
            InteriorNormalsKind::Smooth => InteriorNormals::Smooth,
            InteriorNormalsKind::Input => InteriorNormals::Input,
        }
    }

    pub fn inner_fairness(&self) -> InnerFairness {
        match self.inner_fairness {
            InnerFairnessKind::Uniform => InnerFairness::Uniform,
            InnerFairnessKind::Conformal => InnerFairness::Conformal,
            InnerFairnessKind::Convex => InnerFairness::Convex,
        }
    }

    pub fn discretization(&self) -> Discretization {
        match self.discretization {
            DiscretizationKind::SecondOrder => Discretization::SecondOrder,
            DiscretizationKind::Paper => Discretization::Paper,
        }
    }
}

/// Flags of the mesh.
#[derive(Debug, Args)]
pub struct MeshArgs {
    /// Which vertices count as one vertex of the surface: 'join', those with equal
    /// coordinates; a distance (in the file's unit), also those as near as that;
    /// 'separate', none
    #[arg(
        long,
        value_name = "WHICH",
        default_value = "join",
        value_parser = coincident,
        verbatim_doc_comment
    )]
    pub coincident: Coincident,
    /// First turn faces around, as few as possible, so that those that hang together by edges
    /// face the same way. The output has them turned, too
    #[arg(long, verbatim_doc_comment)]
    pub orient: bool,
}

/// Reads `--coincident`.
fn coincident(text: &str) -> Result<Coincident, String> {
    match text {
        "join" => Ok(Coincident::default()),
        "separate" => Ok(Coincident::Separate),
        _ => {
            let within = text.parse::<f64>().map(|within| Coincident::Join { within });
            within
                .ok()
                .filter(|coincident| coincident.validate().is_ok())
                .ok_or_else(|| "expected join, separate or a distance, at least 0".to_owned())
        }
    }
}

/// Reads `--target`.
fn target(text: &str) -> Result<Target, String> {
    match text {
        "harmonic" => Ok(Target::Harmonic),
        "minimal-energy" => Ok(Target::MinimalEnergy),
        _ => text
            .strip_prefix("constant=")
            .and_then(|c| c.parse::<f64>().ok())
            .filter(|c| c.is_finite())
            .map(Target::Constant)
            .ok_or_else(|| "expected harmonic, constant=NUMBER or minimal-energy".to_owned()),
    }
}

/// The same as text.
pub fn target_name(target: Target) -> String {
    match target {
        Target::Harmonic => "harmonic".to_owned(),
        Target::Constant(c) => format!("constant={c}"),
        Target::MinimalEnergy => "minimal-energy".to_owned(),
    }
}
