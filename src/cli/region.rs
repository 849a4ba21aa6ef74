//! A region chosen by flags, step by step in the order in which they are given.

use std::path::Path;

use clap::{Arg, ArgAction, ArgMatches, Command, FromArgMatches, error::ErrorKind};
use fairmesh::{
    Bump, Coincident, Combine, Error, Place, Region, RegionStep, Seed, SelectedRegion, select_region,
};

use crate::explain;
use crate::failure::Failure;
use crate::figures::significant;
use crate::formats::{Geometry, Kind, MeshFile};
use crate::selection::Selected;
use serde_json::{Value, json};

/// Edges bend by no more within what `--patch-at` takes, in degrees, unless it says so.
const SHARP: f64 = 30.0;
/// By so much a channel may differ from `--color`, of 255, unless it says so.
const TOLERANCE: f64 = 16.0;

/// What one flag says.
#[derive(Debug, Clone)]
enum Part {
    Region(Region),
    /// A colour and how much each channel may differ.
    Colour([f64; 3], f64),
    Grow(usize),
    Shrink(usize),
    Invert,
    /// How the next region is combined with those before it.
    Combine(Combine),
}

/// One flag.
struct Flag {
    name: &'static str,
    value: Option<&'static str>,
    read: fn(&str) -> Result<Part, String>,
    help: &'static str,
}

const FLAGS: [Flag; 12] = [
    Flag {
        name: "ball",
        value: Some("X,Y,Z,RADIUS"),
        read: ball,
        help: "Faces that lie in this ball with all corners",
    },
    Flag {
        name: "box",
        value: Some("X,Y,Z,X,Y,Z"),
        read: cuboid,
        help: "Faces that lie in this box with all corners: its smallest and its largest\ncoordinates",
    },
    Flag {
        name: "halfspace",
        value: Some("X,Y,Z,NX,NY,NZ"),
        read: half_space,
        help: "Faces on the side of the plane through X,Y,Z that NX,NY,NZ points to",
    },
    Flag {
        name: "geodesic",
        value: Some("PLACE,RADIUS"),
        read: geodesic,
        help: "Faces no further from a place than this along the surface. A place is a\nvertex by its number, or X,Y,Z: the point of the surface that is nearest",
    },
    Flag {
        name: "component-at",
        value: Some("PLACE"),
        read: component,
        help: "Faces that hang together with a place",
    },
    Flag {
        name: "patch-at",
        value: Some("PLACE[,DEGREES]"),
        read: patch,
        help: "Faces around a place up to edges that bend by more than so many degrees [30]",
    },
    Flag {
        name: "bump",
        value: Some("PLACE"),
        read: bump,
        help: "The bump or dent at a place: as far as the curvature departs from that of\nthe surroundings; the report says what that is",
    },
    Flag {
        name: "color",
        value: Some("R,G,B[,TOLERANCE]"),
        read: colour,
        help: "Faces of this colour, 0 to 255 per channel, or #RRGGBB; of PLY and OBJ",
    },
    Flag {
        name: "grow",
        value: Some("RINGS"),
        read: grow,
        help: "Adds the faces around what is selected so far, so often",
    },
    Flag {
        name: "shrink",
        value: Some("RINGS"),
        read: shrink,
        help: "Takes the outermost faces away, so often",
    },
    Flag {
        name: "invert",
        value: None,
        read: |_| Ok(Part::Invert),
        help: "Takes the other faces instead",
    },
    Flag {
        name: "without",
        value: None,
        read: |_| Ok(Part::Combine(Combine::Remove)),
        help: "Takes away what the next flag names, instead of adding it",
    },
];

/// `--and`, which reads best behind `--without`.
const AND: Flag = Flag {
    name: "and",
    value: None,
    read: |_| Ok(Part::Combine(Combine::Intersect)),
    help: "Keeps only what the next flag names, too",
};

fn flags() -> impl Iterator<Item = &'static Flag> {
    FLAGS.iter().chain([&AND])
}

/// Flags of a region, in the order in which they are given: each adds to those before it.
#[derive(Debug, Clone, Default)]
pub struct RegionSteps(Vec<(String, Part)>);

impl clap::Args for RegionSteps {
    fn augment_args(command: Command) -> Command {
        flags().fold(command, |command, flag| {
            let arg = Arg::new(flag.name)
                .long(flag.name)
                .help(flag.help)
                .help_heading("Region by place and shape (in this order; each adds to those before it)")
                .action(ArgAction::Append)
                .allow_hyphen_values(flag.value.is_some())
                .value_parser(flag.read);
            command.arg(match flag.value {
                Some(value) => arg.value_name(value),
                None => arg.num_args(0).default_missing_value(""),
            })
        })
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for RegionSteps {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut found = Vec::new();
        for flag in flags() {
            let (Some(parts), Some(places)) =
                (matches.get_many::<Part>(flag.name), matches.indices_of(flag.name))
            else {
                continue;
            };
            let raw = matches.get_raw(flag.name).into_iter().flatten();
            for ((part, place), raw) in parts.zip(places).zip(raw) {
                let told = match flag.value {
                    Some(_) => format!("--{} {}", flag.name, raw.to_string_lossy()),
                    None => format!("--{}", flag.name),
                };
                found.push((place, told, part.clone()));
            }
        }
        found.sort_by_key(|entry| entry.0);
        let steps: Vec<(String, Part)> = found.into_iter().map(|(_, told, part)| (told, part)).collect();
        let names_a_region = |part: &Part| matches!(part, Part::Region(_) | Part::Colour(..));
        for (k, (told, part)) in steps.iter().enumerate() {
            let next = steps.get(k + 1).map(|(_, next)| next);
            if matches!(part, Part::Combine(_)) && !next.is_some_and(names_a_region) {
                let why = format!("{told}: a flag that names a region has to follow, like --ball\n");
                return Err(clap::Error::raw(ErrorKind::ValueValidation, why));
            }
        }
        Ok(Self(steps))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// What the steps have come to.
pub struct Found {
    pub selected: Selected,
    pub report: RegionReport,
}

/// How a region was found.
#[derive(Debug, Clone, Default)]
pub struct RegionReport {
    /// One line per step, for people.
    pub told: Vec<String>,
    bumps: Vec<Bump>,
}

impl RegionReport {
    /// The same for programs.
    pub fn json(&self) -> Value {
        let bump = |of: &Bump| {
            json!({ "radius": of.radius, "faces": of.triangles, "departure": of.departure,
                "surroundings": of.surroundings, "scatter": of.scatter })
        };
        json!({ "steps": self.told, "bumps": self.bumps.iter().map(bump).collect::<Vec<Value>>() })
    }
}

impl RegionSteps {
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The flags as they were given.
    pub fn told(&self) -> String {
        let told = self.0.iter().map(|(told, _)| told.as_str());
        told.collect::<Vec<&str>>().join(" ")
    }

    /// Whether the first flag names a region, and changes none that is there already.
    pub fn begins_with_a_region(&self) -> bool {
        matches!(self.0.first(), Some((_, Part::Region(_) | Part::Colour(..))))
    }

    /// Chooses faces, beginning with those of `first`.
    pub fn find(
        &self,
        mesh: &MeshFile,
        name: &Path,
        first: Option<Selected>,
        coincident: Coincident,
    ) -> Result<Found, Failure> {
        let mut faces = Faces {
            mesh,
            name,
            coincident,
            is_in: vec![false; mesh.geometry.polygon_count],
            report: RegionReport::default(),
        };
        if let Some(first) = first {
            let listed = first.in_triangles(&mesh.geometry);
            let region = match listed.kind {
                Kind::Vertex => Region::Vertices(listed.elements),
                Kind::Face => Region::Triangles(listed.elements),
            };
            faces.combine("what was selected before", Combine::Add, &region)?;
        }
        let mut how = Combine::Add;
        for (told, part) in &self.0 {
            match part {
                Part::Combine(next) => how = *next,
                Part::Region(region) => faces.combine(told, std::mem::take(&mut how), region)?,
                Part::Colour(colour, tolerance) => {
                    let none = || Failure::new(format!("{told}: {} has no colours", name.display()));
                    let region = of_colour(mesh, *colour, *tolerance).ok_or_else(none)?;
                    faces.combine(told, std::mem::take(&mut how), &region)?;
                }
                Part::Grow(rings) => faces.change(told, &RegionStep::Grow(*rings))?,
                Part::Shrink(rings) => faces.change(told, &RegionStep::Shrink(*rings))?,
                Part::Invert => faces.change(told, &RegionStep::Invert)?,
            }
        }
        let elements = faces.list();
        match elements.is_empty() {
            true => Err(Failure::new(format!("{}: nothing is left selected", self.told()))),
            false => Ok(Found {
                selected: Selected {
                    kind: Kind::Face,
                    elements,
                },
                report: faces.report,
            }),
        }
    }
}

/// The faces selected so far: polygons, of which all triangles are in or none.
struct Faces<'a> {
    mesh: &'a MeshFile,
    name: &'a Path,
    coincident: Coincident,
    is_in: Vec<bool>,
    report: RegionReport,
}

impl Faces<'_> {
    /// Combines them with a region: the polygons that lie in it with all triangles.
    fn combine(&mut self, told: &str, how: Combine, region: &Region) -> Result<(), Failure> {
        let step = RegionStep::With(Combine::Add, region.clone());
        let found = self.select(told, std::slice::from_ref(&step))?;
        let [some, all] = polygons(&self.mesh.geometry, &found.triangles);
        if !some.contains(&true) {
            return Err(Failure::new(nothing(told, &step, &self.mesh.geometry)));
        }
        self.tell(told, &all);
        self.report.told.extend(found.bumps.iter().map(extent));
        self.report.bumps.extend(found.bumps);
        for (is_in, named) in self.is_in.iter_mut().zip(all) {
            *is_in = match how {
                Combine::Add => *is_in || named,
                Combine::Remove => *is_in && !named,
                Combine::Intersect => *is_in && named,
            };
        }
        Ok(())
    }

    /// Makes other faces of them: a polygon grows into what any of its triangles does.
    fn change(&mut self, told: &str, step: &RegionStep) -> Result<(), Failure> {
        let kind = Kind::Face;
        let elements = self.list();
        let now = Selected { kind, elements }.in_triangles(&self.mesh.geometry);
        let now = RegionStep::With(Combine::Add, Region::Triangles(now.elements));
        let found = self.select(told, &[now, step.clone()])?;
        let [some, all] = polygons(&self.mesh.geometry, &found.triangles);
        self.is_in = match step {
            RegionStep::Grow(_) => some,
            _ => all,
        };
        if !self.is_in.contains(&true) {
            return Err(Failure::new(nothing(told, step, &self.mesh.geometry)));
        }
        let is_in = self.is_in.clone();
        self.tell(told, &is_in);
        Ok(())
    }

    fn select(&self, told: &str, steps: &[RegionStep]) -> Result<SelectedRegion, Failure> {
        let geometry = &self.mesh.geometry;
        select_region(&geometry.positions, &geometry.triangles, steps, self.coincident)
            .map_err(|error| refusal(self.name, self.mesh, told, &error))
    }

    fn tell(&mut self, told: &str, faces: &[bool]) {
        let count = faces.iter().filter(|&&is_in| is_in).count();
        self.report.told.push(format!("{told}: {count} faces"));
    }

    fn list(&self) -> Vec<u32> {
        let all = (0..).zip(&self.is_in);
        all.filter(|(_, is_in)| **is_in).map(|(p, _)| p).collect()
    }
}

/// The polygons with any triangle among these, and those with all.
fn polygons(geometry: &Geometry, triangles: &[u32]) -> [Vec<bool>; 2] {
    let mut is_in = vec![false; geometry.triangles.len()];
    triangles.iter().for_each(|&t| is_in[t as usize] = true);
    let (mut some, mut others) = (
        vec![false; geometry.polygon_count],
        vec![false; geometry.polygon_count],
    );
    for (t, &is_in) in is_in.iter().enumerate() {
        let of = if is_in { &mut some } else { &mut others };
        of[geometry.polygon_of(t)] = true;
    }
    let all = some.iter().zip(&others).map(|(&some, &other)| some && !other);
    let all = all.collect();
    [some, all]
}

/// What was taken for a bump.
fn extent(bump: &Bump) -> String {
    format!(
        "bump: {} faces up to {} from its place along the surface; H departs by up to {} from {} around it (which scatters by {})",
        bump.triangles,
        significant(bump.radius),
        significant(bump.departure),
        significant(bump.surroundings),
        significant(bump.scatter)
    )
}

/// Why a step names no face.
fn nothing(told: &str, step: &RegionStep, geometry: &Geometry) -> String {
    let used = geometry.triangles.iter().flatten();
    let places = used.map(|&v| geometry.positions[v as usize]);
    let mut ends = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for p in places {
        for k in 0..3 {
            ends[0][k] = ends[0][k].min(p[k]);
            ends[1][k] = ends[1][k].max(p[k]);
        }
    }
    let point = |p: [f64; 3]| p.map(significant).join(" ");
    let extent = format!("the mesh lies between {} and {}", point(ends[0]), point(ends[1]));
    match step {
        RegionStep::With(_, Region::Within(Place::Ball { centre, .. })) => {
            let distance = |p: &[f64; 3]| (0..3).map(|k| (p[k] - centre[k]).powi(2)).sum::<f64>().sqrt();
            let used = geometry.triangles.iter().flatten();
            let nearest = used.min_by(|&&a, &&b| {
                let [a, b] = [a, b].map(|v| distance(&geometry.positions[v as usize]));
                a.total_cmp(&b)
            });
            let near = nearest.map_or(String::new(), |&v| {
                let p = geometry.positions[v as usize];
                format!(
                    "; vertex {v} at {} is nearest to its middle, {} away",
                    point(p),
                    significant(distance(&p))
                )
            });
            format!("{told}: no face lies in it with all corners{near}; {extent}")
        }
        RegionStep::With(_, Region::Within(_) | Region::HalfSpace { .. }) => {
            format!("{told}: no face lies in it with all corners; {extent}")
        }
        RegionStep::With(_, Region::Geodesic { .. }) => {
            format!("{told}: no face lies within it with all corners; give a larger radius")
        }
        RegionStep::With(..) => format!("{told}: no face is that"),
        RegionStep::Shrink(_) => format!("{told}: nothing is left; shrink less"),
        RegionStep::Invert => format!("{told}: all faces were selected"),
        _ => format!("{told}: nothing was selected before"),
    }
}

fn refusal(name: &Path, mesh: &MeshFile, told: &str, error: &Error) -> Failure {
    match error {
        Error::NoBump { .. } => Failure::new(format!(
            "{told}: {error}; say the region by --geodesic PLACE,RADIUS or --ball instead"
        )),
        Error::SelectionOutOfRange { index, count } => Failure::new(format!(
            "{told}: vertex {index} does not exist; {} has {count} vertices, counted from 0",
            name.display()
        )),
        Error::FreeVertexWithoutTriangle { vertex } => {
            Failure::new(format!("{told}: vertex {vertex} belongs to no face"))
        }
        _ => explain::refusal(name, mesh, error),
    }
}

/// The faces of a colour: by their own, or where their corners have it.
fn of_colour(mesh: &MeshFile, colour: [f64; 3], tolerance: f64) -> Option<Region> {
    let colours = mesh.colours()?;
    let is_near = |of: &[f64; 3]| (0..3).all(|k| (of[k] - colour[k]).abs() <= tolerance);
    let elements = (0..)
        .zip(&colours.values)
        .filter(|(_, of)| is_near(of))
        .map(|(i, _)| i);
    let elements: Vec<u32> = elements.collect();
    Some(match colours.kind {
        Kind::Vertex => Region::Vertices(elements),
        Kind::Face => {
            let kind = Kind::Face;
            Region::Triangles(Selected { kind, elements }.in_triangles(&mesh.geometry).elements)
        }
    })
}

/// Finite numbers, separated by commas.
fn numbers(text: &str) -> Result<Vec<f64>, String> {
    let number = |word: &str| word.trim().parse().ok().filter(|x: &f64| x.is_finite());
    let numbers = text
        .split(',')
        .map(|word| number(word).ok_or_else(|| format!("'{}' is no number", word.trim())));
    numbers.collect()
}

/// A vertex, or a point of the surface.
fn place(numbers: &[f64]) -> Result<Seed, String> {
    match *numbers {
        [v] if v >= 0.0 && v.fract() == 0.0 && v < f64::from(u32::MAX) => Ok(Seed::Vertex(v as u32)),
        [v] => Err(format!(
            "{v} is no number of a vertex; give one, from 0, or X,Y,Z"
        )),
        [x, y, z] => Ok(Seed::Point([x, y, z])),
        _ => Err("a place is a vertex by its number, or X,Y,Z".to_owned()),
    }
}

fn ball(text: &str) -> Result<Part, String> {
    match numbers(text)?[..] {
        [x, y, z, radius] if radius >= 0.0 => Ok(Part::Region(Region::Within(Place::Ball {
            centre: [x, y, z],
            radius,
        }))),
        _ => Err("expected X,Y,Z,RADIUS".to_owned()),
    }
}

fn cuboid(text: &str) -> Result<Part, String> {
    match numbers(text)?[..] {
        [a, b, c, d, e, f] if a <= d && b <= e && c <= f => Ok(Part::Region(Region::Within(Place::Box {
            low: [a, b, c],
            high: [d, e, f],
        }))),
        [_, _, _, _, _, _] => Err("the smallest coordinates come first".to_owned()),
        _ => Err("expected X,Y,Z,X,Y,Z".to_owned()),
    }
}

fn half_space(text: &str) -> Result<Part, String> {
    match numbers(text)?[..] {
        [_, _, _, 0.0, 0.0, 0.0] => Err("the direction NX,NY,NZ is zero".to_owned()),
        [a, b, c, x, y, z] => Ok(Part::Region(Region::HalfSpace {
            point: [a, b, c],
            normal: [x, y, z],
        })),
        _ => Err("expected X,Y,Z,NX,NY,NZ".to_owned()),
    }
}

fn geodesic(text: &str) -> Result<Part, String> {
    let numbers = numbers(text)?;
    match numbers.split_last() {
        Some((&radius, at)) if matches!(at.len(), 1 | 3) && radius >= 0.0 => {
            let seed = place(at)?;
            Ok(Part::Region(Region::Geodesic { seed, radius }))
        }
        _ => Err("expected X,Y,Z,RADIUS or VERTEX,RADIUS".to_owned()),
    }
}

fn component(text: &str) -> Result<Part, String> {
    Ok(Part::Region(Region::Component(place(&numbers(text)?)?)))
}

fn patch(text: &str) -> Result<Part, String> {
    let numbers = numbers(text)?;
    let (at, angle) = match numbers.len() {
        1 | 3 => (&numbers[..], SHARP),
        2 | 4 => (&numbers[..numbers.len() - 1], numbers[numbers.len() - 1]),
        _ => return Err("expected X,Y,Z or VERTEX, and perhaps DEGREES".to_owned()),
    };
    if !(0.0..=180.0).contains(&angle) {
        return Err(format!("{angle} is no angle from 0 to 180 degrees"));
    }
    let seed = place(at)?;
    Ok(Part::Region(Region::Patch { seed, angle }))
}

fn bump(text: &str) -> Result<Part, String> {
    Ok(Part::Region(Region::Bump(place(&numbers(text)?)?)))
}

fn colour(text: &str) -> Result<Part, String> {
    let form = "expected R,G,B from 0 to 255, and perhaps TOLERANCE, or #RRGGBB";
    if let Some(digits) = text.strip_prefix('#') {
        let channel = |k: usize| u8::from_str_radix(digits.get(2 * k..2 * k + 2)?, 16).ok();
        return match (digits.len(), channel(0), channel(1), channel(2)) {
            (6, Some(r), Some(g), Some(b)) => Ok(Part::Colour([r, g, b].map(f64::from), TOLERANCE)),
            _ => Err(form.to_owned()),
        };
    }
    match numbers(text)?[..] {
        [r, g, b] => Ok(Part::Colour([r, g, b], TOLERANCE)),
        [r, g, b, tolerance] if tolerance >= 0.0 => Ok(Part::Colour([r, g, b], tolerance)),
        _ => Err(form.to_owned()),
    }
}

fn rings(text: &str) -> Result<usize, String> {
    text.parse()
        .map_err(|_| "expected how many rings of faces".to_owned())
}

fn grow(text: &str) -> Result<Part, String> {
    rings(text).map(Part::Grow)
}

fn shrink(text: &str) -> Result<Part, String> {
    rings(text).map(Part::Shrink)
}
