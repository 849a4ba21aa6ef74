//! The file of a mesh with blends: what is not cut stays as it is, and what is new has the attributes of what was there.

use std::path::Path;

use fairmesh::{Carried, Parents, Rounded, carry_over};

use crate::failure::Failure;
use crate::formats::carry::{Carry, middles};
use crate::formats::{Added, Format, Geometry, MeshFile, plain};
use crate::patches::MarkArgs;

/// The faces of the output: polygons of the file that are not cut, then triangles.
struct Faces {
    /// Per polygon of the file.
    is_whole: Vec<bool>,
    /// The triangles besides: parts of the file's ones, then those of the blends; in the numbers of the mesh with blends.
    new: Vec<[u32; 3]>,
    /// The triangle of the file that each part comes from.
    parts: Vec<u32>,
}

/// The bytes of a mesh with blends, and the number of the first face of these.
pub fn written(
    mesh: &MeshFile,
    (input, format): (&Path, Format),
    rounded: &Rounded,
    mark: &MarkArgs,
) -> Result<(Vec<u8>, usize), Failure> {
    let faces = Faces::of(&mesh.geometry, rounded);
    let geometry = &mesh.geometry;
    let stays = |t: &usize| faces.is_whole[geometry.polygon_of(*t)];
    let whole = match format {
        Format::Ply | Format::Obj => faces.is_whole.iter().filter(|&&whole| whole).count(),
        Format::Off => geometry.first_triangles().iter().filter(|t| stays(t)).count(),
        Format::Stl => (0..geometry.triangles.len()).filter(stays).count(),
    };
    let bytes = match format {
        Format::Ply | Format::Obj => {
            let name = input.display().to_string();
            match mesh.format() == format {
                true => {
                    let carried = faces.carried(geometry, rounded);
                    grown(mesh, &name, rounded, &faces, mark, Some(carried))?
                }
                // There are no attributes in another format.
                false => {
                    let mesh = MeshFile::parse(&name, format, mesh.in_format(format))?;
                    grown(&mesh, &name, rounded, &faces, mark, None)?
                }
            }
        }
        Format::Off | Format::Stl => faces.plain(geometry, format, rounded),
    };
    Ok((bytes, whole + faces.parts.len()))
}

/// The new rows are added to the file, with attributes from where they lie if these are told, then those that they replace are dropped.
fn grown(
    mesh: &MeshFile,
    name: &str,
    rounded: &Rounded,
    faces: &Faces,
    mark: &MarkArgs,
    carried: Option<[Vec<Option<Carried>>; 2]>,
) -> Result<Vec<u8>, Failure> {
    let given = &mesh.geometry;
    let kept: Vec<u32> = (0..given.positions.len() as u32).collect();
    let new = &rounded.positions[rounded.kept_vertices.len()..];
    let number = |v: u32| match (v as usize).checked_sub(rounded.kept_vertices.len()) {
        None => rounded.kept_vertices[v as usize],
        Some(new) => (kept.len() + new) as u32,
    };
    let carry = carried.as_ref().map(|[vertices, faces]| Carry {
        geometry: given,
        vertices,
        faces,
        kept: &kept,
        places: new,
    });
    let triangles = faces.new.iter().map(|t| t.map(number));
    let added = Added {
        positions: &[&given.positions, new].concat(),
        triangles: &given
            .triangles
            .iter()
            .copied()
            .chain(triangles)
            .collect::<Vec<_>>(),
        parents: &rounded.parents,
        carry: carry.as_ref(),
        mark: mark.from(faces.parts.len()),
    };
    let grown = mesh.with_added(mesh.format(), &added, Some(mesh));
    let mut stays = faces.is_whole.clone();
    stays.extend(vec![true; faces.new.len()]);
    let (only, _) = MeshFile::parse(name, mesh.format(), grown)?.only(name, &stays)?;
    Ok(only.in_format(mesh.format()))
}

impl Faces {
    fn of(given: &Geometry, rounded: &Rounded) -> Self {
        let mut is_whole = vec![true; given.polygon_count];
        let mut corners: Vec<Vec<u32>> = vec![Vec::new(); given.polygon_count];
        let mut missing = vec![0_i64; given.polygon_count];
        for (t, triangle) in given.triangles.iter().enumerate() {
            corners[given.polygon_of(t)].extend(triangle);
            missing[given.polygon_of(t)] += 1;
        }
        corners.iter_mut().for_each(|of| of.sort_unstable());
        // A plane polygon may come back with other diagonals.
        for (t, &from) in rounded.triangles.iter().zip(&rounded.kept_triangles) {
            let polygon = given.polygon_of(from as usize);
            let is_corner = |v: u32| {
                let was = rounded.kept_vertices.get(v as usize);
                was.is_some_and(|was| corners[polygon].binary_search(was).is_ok())
            };
            is_whole[polygon] &= t.iter().all(|&v| is_corner(v));
            missing[polygon] -= 1;
        }
        let all = is_whole.iter_mut().zip(missing);
        all.for_each(|(is_whole, missing)| *is_whole &= missing == 0);
        let stays = |from: u32| is_whole[given.polygon_of(from as usize)];
        let (mut new, mut parts) = (Vec::new(), Vec::new());
        for (t, &from) in rounded.triangles.iter().zip(&rounded.kept_triangles) {
            if !stays(from) {
                new.push(*t);
                parts.push(from);
            }
        }
        new.extend(&rounded.triangles[rounded.kept_triangles.len()..]);
        Self { is_whole, new, parts }
    }

    /// Where the new vertices, and the middles of the new triangles, lie on what is cut or gone.
    fn carried(&self, given: &Geometry, rounded: &Rounded) -> [Vec<Option<Carried>>; 2] {
        let among: Vec<u32> = (0..given.triangles.len() as u32)
            .filter(|&t| !self.is_whole[given.polygon_of(t as usize)])
            .collect();
        // What the library has rounded it can read.
        let places = |points: &[[f64; 3]]| {
            carry_over(&given.positions, &given.triangles, &among, points)
                .unwrap_or_else(|_| vec![None; points.len()])
        };
        let part = |&triangle: &u32| {
            let parents = Parents {
                vertices: given.triangles[triangle as usize],
                weights: [1.0 / 3.0; 3],
            };
            Some(Carried { triangle, parents })
        };
        let blends = middles(&rounded.positions, &self.new[self.parts.len()..]);
        let mut faces: Vec<Option<Carried>> = self.parts.iter().map(part).collect();
        faces.extend(places(&blends));
        [places(&rounded.positions[rounded.kept_vertices.len()..]), faces]
    }

    /// Nothing but vertices and faces.
    fn plain(&self, given: &Geometry, format: Format, rounded: &Rounded) -> Vec<u8> {
        let mut number = vec![0; given.positions.len()];
        for (now, &v) in (0..).zip(&rounded.kept_vertices) {
            number[v as usize] = now;
        }
        let mut polygons = Vec::new();
        for (corners, first) in given.polygons().into_iter().zip(given.first_triangles()) {
            if self.is_whole[given.polygon_of(first)] {
                polygons.push(corners.iter().map(|&v| number[v as usize]).collect());
            }
        }
        polygons.extend(self.new.iter().map(|t| t.to_vec()));
        plain(format, &rounded.positions, &polygons)
    }
}
