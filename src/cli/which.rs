//! Which loops are filled: flags by number, size and place.

use clap::{ArgGroup, Args, ValueEnum};
use fairmesh::{Join, LoopFilter, Loops, OnFailure, Place};

use crate::failure::Failure;
use crate::formats::Geometry;
use crate::join::{self, JoinArg};

/// What becomes of a loop whose patch is no success.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum OnFailureKind {
    /// The best surface found; the report says which
    Best,
    /// The triangulation, refined
    Flat,
    /// Leave it open
    Open,
}

/// Flags that choose loops.
#[derive(Debug, Args)]
#[command(next_help_heading = "Which holes", group = ArgGroup::new("which").multiple(true).conflicts_with("loops"))]
pub struct WhichArgs {
    /// Only this loop, by its number in 'fairmesh holes'; may be repeated.
    /// The only way to fill an outer boundary
    #[arg(
        long = "loop",
        visible_alias = "loops",
        value_name = "I",
        verbatim_doc_comment
    )]
    pub loops: Vec<usize>,
    /// Connect these loops by one patch, as in 0,1,2: an island and its hole, the ends
    /// of tubes, the sides of a gap; may be repeated. Other loops stay open unless
    /// other flags choose them. 'auto': join loops whose common patch bends less than
    /// separate ones ('fairmesh holes --suggest' lists them)
    #[arg(long, value_name = "LOOPS", value_parser = join::parse, verbatim_doc_comment)]
    join: Vec<JoinArg>,
    /// Only holes of at most this many edges [default: all]
    #[arg(long, value_name = "N", group = "which")]
    max_edges: Option<usize>,
    /// Only holes of at most this length, or this part of the mesh's diagonal, as 20%
    #[arg(long, value_name = "X", group = "which", value_parser = length)]
    max_length: Option<Length>,
    /// Only holes of at most this area
    #[arg(long, value_name = "X", group = "which")]
    max_area: Option<f64>,
    /// Only holes whose bounding box has at most this diagonal, or this part of the mesh's
    /// diagonal, as 5%
    #[arg(long, value_name = "X", group = "which", value_parser = length, verbatim_doc_comment)]
    max_diagonal: Option<Length>,
    /// All holes except the K longest
    #[arg(long, value_name = "K", group = "which")]
    except_longest: Option<usize>,
    /// Only holes in this component of the mesh, by its number in 'fairmesh holes';
    /// may be repeated
    #[arg(
        long,
        visible_alias = "of-components",
        value_name = "I",
        group = "which",
        verbatim_doc_comment
    )]
    component: Vec<usize>,
    /// Only holes inside a ball, X,Y,Z,RADIUS, or a box, X,Y,Z,X,Y,Z
    /// (smallest, then largest coordinates)
    #[arg(long, value_name = "PLACE", group = "which", value_parser = place, allow_hyphen_values = true, verbatim_doc_comment)]
    within: Option<Place>,
    /// What to do with a hole whose patch is no success: not fair, creased, intersecting, or
    /// with any other reservation that its report names
    #[arg(
        long,
        value_enum,
        value_name = "WHAT",
        default_value = "best",
        verbatim_doc_comment
    )]
    on_failure: OnFailureKind,
}

impl WhichArgs {
    pub fn join(&self) -> Result<Join, Failure> {
        join::asked(&self.join)
    }

    pub fn on_failure(&self) -> OnFailure {
        match self.on_failure {
            OnFailureKind::Best => OnFailure::Best,
            OnFailureKind::Flat => OnFailure::Flat,
            OnFailureKind::Open => OnFailure::Open,
        }
    }

    /// Groups that are named bring no others with them, unless these are asked for, too.
    pub fn loops(&self, join: &Join, geometry: &Geometry) -> Loops {
        let measured = |length: Option<Length>| length.map(|length| length.in_units_of(geometry));
        let filter = LoopFilter {
            max_edges: self.max_edges,
            max_length: measured(self.max_length),
            max_area: self.max_area,
            max_diagonal: measured(self.max_diagonal),
            except_longest: self.except_longest.unwrap_or(0),
            components: (!self.component.is_empty()).then(|| self.component.clone()),
            within: self.within,
        };
        let by_edges = LoopFilter {
            max_edges: self.max_edges,
            ..LoopFilter::default()
        };
        match join {
            _ if !self.loops.is_empty() => Loops::Chosen(self.loops.clone()),
            Join::Groups(_) if filter == LoopFilter::default() => Loops::Chosen(Vec::new()),
            _ if filter == by_edges => Loops::UpTo(self.max_edges.unwrap_or(usize::MAX)),
            _ => Loops::Where(filter),
        }
    }
}

/// A length, in the file's unit or in parts of the mesh.
#[derive(Debug, Clone, Copy)]
enum Length {
    Units(f64),
    /// Of the diagonal of the box around all faces.
    OfDiagonal(f64),
}

impl Length {
    fn in_units_of(self, geometry: &Geometry) -> f64 {
        match self {
            Length::Units(length) => length,
            Length::OfDiagonal(part) => part * geometry.bounds().diagonal(),
        }
    }
}

/// Reads a length: 0.3, or 5%.
fn length(text: &str) -> Result<Length, String> {
    let (digits, unit): (&str, fn(f64) -> Length) = match text.strip_suffix('%') {
        Some(digits) => (digits, |percent| Length::OfDiagonal(0.01 * percent)),
        None => (text, Length::Units),
    };
    let number = digits
        .trim()
        .parse()
        .map_err(|_| "expected a number, or a percentage as 5%")?;
    Ok(unit(number))
}

/// Reads a value of `--within`.
fn place(text: &str) -> Result<Place, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[x, y, z, radius]) => Ok(Place::Ball {
            centre: [x, y, z],
            radius,
        }),
        Ok(&[a, b, c, d, e, f]) => Ok(Place::Box {
            low: [a, b, c],
            high: [d, e, f],
        }),
        _ => Err("expected four numbers, X,Y,Z,RADIUS, or six, X,Y,Z,X,Y,Z".to_owned()),
    }
}
