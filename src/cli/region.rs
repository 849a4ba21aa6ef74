//! A region chosen by flags, step by step in the order in which they are given.

mod flags;

use std::path::Path;

use fairmesh::{Bump, Coincident, Combine, Error, Place, Region, RegionStep, SelectedRegion, select_region};
use serde_json::{Value, json};

use crate::explain;
use crate::failure::Failure;
use crate::figures::significant;
use crate::formats::{Geometry, Kind, MeshFile};
use crate::selected::Selected;
use flags::Part;
pub use flags::RegionSteps;

/// A place further than this from the surface is told, in diagonals of the mesh.
const OFF: f64 = 0.02;

/// A bump of more than this part of the mesh may be no bump.
const LARGE: f64 = 0.2;
const TOO_LARGE: &str = "this is a large part of the mesh for a bump: look at it ('fairmesh select --picture'), or say the region by --geodesic PLACE,RADIUS";

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
        let bump = |of: &Bump| json!({ "radius": of.radius, "faces": of.triangles, "height": of.height, "uncertainty": of.uncertainty });
        json!({ "steps": self.told, "bumps": self.bumps.iter().map(bump).collect::<Vec<Value>>() })
    }
}

impl RegionSteps {
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
                // It has become the bump's.
                Part::BumpSize(_) => {}
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
        let misses: Vec<String> = found.misses.iter().filter_map(|&miss| self.miss(miss)).collect();
        self.report.told.extend(misses);
        let count = self.mesh.geometry.triangles.len();
        self.report.told.extend(found.bumps.iter().map(taken));
        let is_large = |of: &Bump| of.triangles as f64 > LARGE * count as f64;
        if found.bumps.iter().any(is_large) {
            self.report.told.push(TOO_LARGE.to_owned());
        }
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

    /// That a place is not on the surface.
    fn miss(&self, distance: f64) -> Option<String> {
        let diagonal = self.mesh.geometry.bounds().diagonal();
        let said = || {
            let distance = significant(distance);
            format!("its place is {distance} from the surface; the nearest point there was taken")
        };
        (distance > OFF * diagonal).then(said)
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
pub fn polygons(geometry: &Geometry, triangles: &[u32]) -> [Vec<bool>; 2] {
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
fn taken(bump: &Bump) -> String {
    format!(
        "bump: {} faces up to {} from its place along the surface, up to {} {} the smooth one, which is certain to {} % of that",
        bump.triangles,
        significant(bump.radius),
        significant(bump.height.abs()),
        if bump.height < 0.0 { "below" } else { "above" },
        significant(100.0 * bump.uncertainty)
    )
}

/// Why a step names no face.
fn nothing(told: &str, step: &RegionStep, geometry: &Geometry) -> String {
    let bounds = geometry.bounds();
    let point = |p: [f64; 3]| p.map(significant).join(" ");
    let bounds = format!(
        "the mesh lies between {} and {}",
        point(bounds.low),
        point(bounds.high)
    );
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
            format!("{told}: no face lies in it with all corners{near}; {bounds}")
        }
        RegionStep::With(_, Region::Within(_) | Region::HalfSpace { .. }) => {
            format!("{told}: no face lies in it with all corners; {bounds}")
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
