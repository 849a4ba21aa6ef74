//! The flags of a region and what each says, in the order in which they are given.

use clap::{Arg, ArgAction, ArgMatches, Command, FromArgMatches, error::ErrorKind};
use fairmesh::{Combine, Place, Region, Seed};

/// Edges bend by no more within what `--patch-at` takes, in degrees, unless it says so.
const SHARP: f64 = 30.0;
/// By so much a channel may differ from `--color`, of 255, unless it says so.
const TOLERANCE: f64 = 16.0;

/// What one flag says.
#[derive(Debug, Clone)]
pub enum Part {
    Region(Region),
    /// A colour and how much each channel may differ.
    Colour([f64; 3], f64),
    Grow(usize),
    Shrink(usize),
    Invert,
    /// About how far the bump before it reaches.
    BumpSize(f64),
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

const FLAGS: [Flag; 13] = [
    Flag {
        name: "ball",
        value: Some("X,Y,Z,RADIUS"),
        read: ball,
        help: "Faces entirely inside this ball",
    },
    Flag {
        name: "box",
        value: Some("X,Y,Z,X,Y,Z"),
        read: cuboid,
        help: "Faces entirely inside this box: its smallest, then its largest coordinates",
    },
    Flag {
        name: "halfspace",
        value: Some("X,Y,Z,NX,NY,NZ"),
        read: half_space,
        help: "Faces on the side of the plane through X,Y,Z to which NX,NY,NZ points",
    },
    Flag {
        name: "geodesic",
        value: Some("PLACE,RADIUS"),
        read: geodesic,
        help: "Faces within this distance of a place along the surface. A place is a vertex\nnumber, or X,Y,Z for the nearest point of the surface",
    },
    Flag {
        name: "component-at",
        value: Some("PLACE"),
        read: component,
        help: "The connected component at a place",
    },
    Flag {
        name: "patch-at",
        value: Some("PLACE[,DEGREES]"),
        read: patch,
        help: "Faces around a place, up to edges sharper than this many degrees [30]",
    },
    Flag {
        name: "bump",
        value: Some("PLACE"),
        read: bump,
        help: "All of the bump or dent at a place, the smallest one there; the report says what\nwas taken, and how sure it is",
    },
    Flag {
        name: "bump-size",
        value: Some("RADIUS"),
        read: bump_size,
        help: "The --bump before it is one that reaches about as far as this, as a nose with a\npimple on it",
    },
    Flag {
        name: "color",
        value: Some("R,G,B[,TOLERANCE]"),
        read: colour,
        help: "Faces of this colour, 0 to 255 per channel, or #RRGGBB (PLY and OBJ)",
    },
    Flag {
        name: "grow",
        value: Some("RINGS"),
        read: grow,
        help: "Add this many rings of faces around the selection",
    },
    Flag {
        name: "shrink",
        value: Some("RINGS"),
        read: shrink,
        help: "Remove this many outermost rings of faces",
    },
    Flag {
        name: "invert",
        value: None,
        read: |_| Ok(Part::Invert),
        help: "Select the other faces instead",
    },
    Flag {
        name: "without",
        value: None,
        read: |_| Ok(Part::Combine(Combine::Remove)),
        help: "Remove what the next flag selects, instead of adding it",
    },
];

/// `--and`, which reads best behind `--without`.
const AND: Flag = Flag {
    name: "and",
    value: None,
    read: |_| Ok(Part::Combine(Combine::Intersect)),
    help: "Keep only what the next flag selects as well",
};

fn flags() -> impl Iterator<Item = &'static Flag> {
    FLAGS.iter().chain([&AND])
}

/// Flags of a region, in the order in which they are given: each adds to those before it.
#[derive(Debug, Clone, Default)]
pub struct RegionSteps(pub Vec<(String, Part)>);

impl clap::Args for RegionSteps {
    fn augment_args(command: Command) -> Command {
        flags().fold(command, |command, flag| {
            let arg = Arg::new(flag.name)
                .long(flag.name)
                .help(flag.help)
                .help_heading("Region by place and shape (in the order given; each adds to those before it)")
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
        let mut steps: Vec<(String, Part)> = Vec::new();
        for (_, told, part) in found {
            let Part::BumpSize(radius) = part else {
                steps.push((told, part));
                continue;
            };
            let Some((before, Part::Region(Region::Bump { size, .. }))) = steps.last_mut() else {
                let why = format!("{told}: --bump PLACE has to come before it\n");
                return Err(clap::Error::raw(ErrorKind::ValueValidation, why));
            };
            *size = Some(radius);
            *before = format!("{before} {told}");
        }
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
}

/// Finite numbers, separated by commas, or all by blanks.
fn numbers(text: &str) -> Result<Vec<f64>, String> {
    let words: Vec<&str> = match text.contains(',') {
        true => text.split(',').map(str::trim).collect(),
        false => text.split_whitespace().collect(),
    };
    let number = |word: &&str| word.parse().ok().filter(|x: &f64| x.is_finite());
    let numbers = words
        .iter()
        .map(|word| number(word).ok_or_else(|| format!("'{word}' is no number")));
    numbers.collect()
}

/// The shell takes what follows a blank for another argument.
fn expected<T>(form: &str) -> Result<T, String> {
    Err(format!("expected {form}, with commas and without blanks"))
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
        [_, _, _, radius] => Err(format!("the radius {radius} is below 0")),
        _ => expected("X,Y,Z,RADIUS"),
    }
}

fn cuboid(text: &str) -> Result<Part, String> {
    match numbers(text)?[..] {
        [a, b, c, d, e, f] if a <= d && b <= e && c <= f => Ok(Part::Region(Region::Within(Place::Box {
            low: [a, b, c],
            high: [d, e, f],
        }))),
        [_, _, _, _, _, _] => Err("the smallest coordinates come first".to_owned()),
        _ => expected("X,Y,Z,X,Y,Z"),
    }
}

fn half_space(text: &str) -> Result<Part, String> {
    match numbers(text)?[..] {
        [_, _, _, 0.0, 0.0, 0.0] => Err("the direction NX,NY,NZ is zero".to_owned()),
        [a, b, c, x, y, z] => Ok(Part::Region(Region::HalfSpace {
            point: [a, b, c],
            normal: [x, y, z],
        })),
        _ => expected("X,Y,Z,NX,NY,NZ"),
    }
}

fn geodesic(text: &str) -> Result<Part, String> {
    let numbers = numbers(text)?;
    match numbers.split_last() {
        Some((&radius, at)) if matches!(at.len(), 1 | 3) && radius < 0.0 => {
            Err(format!("the radius {radius} is below 0"))
        }
        Some((&radius, at)) if matches!(at.len(), 1 | 3) => {
            let seed = place(at)?;
            Ok(Part::Region(Region::Geodesic { seed, radius }))
        }
        _ => expected("X,Y,Z,RADIUS or VERTEX,RADIUS"),
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
        _ => return expected("X,Y,Z or VERTEX, and perhaps DEGREES"),
    };
    if !(0.0..=180.0).contains(&angle) {
        return Err(format!("{angle} is no angle from 0 to 180 degrees"));
    }
    let seed = place(at)?;
    Ok(Part::Region(Region::Patch { seed, angle }))
}

fn bump(text: &str) -> Result<Part, String> {
    Ok(Part::Region(Region::Bump {
        seed: place(&numbers(text)?)?,
        size: None,
    }))
}

fn bump_size(text: &str) -> Result<Part, String> {
    let radius = text
        .parse()
        .ok()
        .filter(|radius: &f64| *radius > 0.0 && radius.is_finite());
    radius
        .map(Part::BumpSize)
        .ok_or_else(|| "expected a radius above 0".to_owned())
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
