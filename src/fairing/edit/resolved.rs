//! A list of edits, checked against the mesh: where fixed vertices are now, how far their normals turn, and what tilts the normals of which
//! loops.

use nalgebra::{Matrix3, Vector3};

use super::Edit;
use super::along_loop::Kind;
use super::moves::{Motion, followers};
use crate::mesh::coincident::Copies;
use crate::support::error::{Error, LARGEST_COORDINATE};

/// A fixed vertex that is not where it was.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::fairing) struct MovedVertex {
    pub(in crate::fairing) vertex: u32,
    pub(in crate::fairing) at: [f64; 3],
    /// The rotation of its normal.
    pub(in crate::fairing) turn: Matrix3<f64>,
}

/// A tilt or a twist of the loops through a vertex, by the joined mesh's number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::fairing) struct Bend {
    pub(in crate::fairing) kind: Kind,
    pub(in crate::fairing) vertex: u32,
    pub(in crate::fairing) angle: f64,
    pub(in crate::fairing) falloff: f64,
    /// As the caller names the vertex.
    pub(in crate::fairing) given: u32,
}

/// All edits together.
#[derive(Debug, Clone, Default, PartialEq)]
pub(in crate::fairing) struct ResolvedEdits {
    /// Ascending; each copy by its own number.
    pub(in crate::fairing) moved: Vec<MovedVertex>,
    pub(in crate::fairing) bends: Vec<Bend>,
    /// The angle of all loops.
    pub(in crate::fairing) bulge: f64,
}

/// The mesh that edits are about: joined, as it was given.
#[derive(Clone, Copy)]
pub(in crate::fairing) struct EditedMesh<'a> {
    pub(in crate::fairing) positions: &'a [[f64; 3]],
    pub(in crate::fairing) triangles: &'a [[u32; 3]],
    pub(in crate::fairing) copies: &'a Copies,
    /// The free vertices, ascending.
    pub(in crate::fairing) free: &'a [u32],
}

/// Who follows the vertices of a move, kept from frame to frame: with a falloff it takes a pass over the mesh.
#[derive(Debug, Clone, Default)]
pub(in crate::fairing) struct Followers(Vec<Following>);

#[derive(Debug, Clone)]
struct Following {
    vertices: Vec<u32>,
    falloff: f64,
    parts: Vec<(u32, f64)>,
}

impl Followers {
    /// The parts of these vertices and their followers, ascending.
    fn of(&mut self, mesh: EditedMesh<'_>, vertices: &[u32], falloff: f64) -> &[(u32, f64)] {
        let known = |f: &Following| f.vertices == vertices && f.falloff == falloff;
        let at = self.0.iter().position(known).unwrap_or_else(|| {
            let joined: Vec<u32> = vertices.iter().map(|&v| mesh.copies.smallest(v)).collect();
            let parts = followers(mesh.positions, mesh.triangles, &joined, falloff);
            let fixed = parts.into_iter().filter(|(v, _)| !mesh.is_free(*v));
            self.0.push(Following {
                vertices: vertices.to_vec(),
                falloff,
                parts: fixed.collect(),
            });
            self.0.len() - 1
        });
        &self.0[at].parts
    }

    /// Forgets those that no edit asks for any more.
    fn keep(&mut self, edits: &[Edit]) {
        self.0.retain(|f| {
            edits.iter().any(|edit| match edit {
                Edit::Move {
                    vertices, falloff, ..
                } => *vertices == f.vertices && *falloff == f.falloff,
                _ => false,
            })
        });
    }
}

impl EditedMesh<'_> {
    fn is_free(&self, joined: u32) -> bool {
        self.free.binary_search(&joined).is_ok()
    }

    /// Checks that a vertex exists, and returns its number in the joined mesh.
    fn joined(&self, vertex: u32) -> Result<u32, Error> {
        let count = self.positions.len();
        if vertex as usize >= count {
            let index = vertex as usize;
            return Err(Error::SelectionOutOfRange { index, count });
        }
        Ok(self.copies.smallest(vertex))
    }
}

impl ResolvedEdits {
    /// Checks the edits, but for the loops.
    pub(in crate::fairing) fn new(
        edits: &[Edit],
        mesh: EditedMesh<'_>,
        followers: &mut Followers,
    ) -> Result<Self, Error> {
        followers.keep(edits);
        let mut all = Self::default();
        for (number, edit) in edits.iter().enumerate() {
            edit.validate(number)?;
            match edit {
                Edit::Tilt {
                    vertex,
                    angle,
                    falloff,
                } => all.bend(mesh, Kind::Tilt, *vertex, (*angle, *falloff))?,
                Edit::Twist {
                    vertex,
                    angle,
                    falloff,
                } => all.bend(mesh, Kind::Twist, *vertex, (*angle, *falloff))?,
                Edit::Bulge { amount } => all.bulge += amount,
                Edit::Move {
                    vertices,
                    rotation,
                    centre,
                    translation,
                    falloff,
                } => {
                    for &v in vertices {
                        if mesh.is_free(mesh.joined(v)?) {
                            return Err(Error::BadEdit {
                                edit: number,
                                vertex: Some(v as usize),
                                why: "only fixed vertices are moved, and this one is free",
                            });
                        }
                    }
                    let motion = Motion {
                        rotation: (*rotation).into(),
                        centre: (*centre).into(),
                        translation: (*translation).into(),
                    };
                    all.follow(mesh, motion, followers.of(mesh, vertices, *falloff))?;
                }
            }
        }
        Ok(all)
    }

    fn bend(
        &mut self,
        mesh: EditedMesh<'_>,
        kind: Kind,
        given: u32,
        (angle, falloff): (f64, f64),
    ) -> Result<(), Error> {
        self.bends.push(Bend {
            kind,
            vertex: mesh.joined(given)?,
            angle,
            falloff,
            given,
        });
        Ok(())
    }

    /// Moves these vertices by parts of a motion, from where they are, with all of their copies.
    fn follow(&mut self, mesh: EditedMesh<'_>, motion: Motion, parts: &[(u32, f64)]) -> Result<(), Error> {
        let copies = |&(v, part): &(u32, f64)| {
            let all = std::iter::once(v).chain(mesh.copies.others(v));
            all.map(move |v| (v, part)).collect::<Vec<_>>()
        };
        for (v, part) in parts.iter().flat_map(copies) {
            let place = self.moved.binary_search_by_key(&v, |m| m.vertex);
            let (before, turned) = match place {
                Ok(k) => (self.moved[k].at, self.moved[k].turn),
                Err(_) => (mesh.positions[v as usize], Matrix3::identity()),
            };
            let (at, turn) = motion.part(part, Vector3::from(before));
            let at: [f64; 3] = at.into();
            check(v, at)?;
            let moved = MovedVertex {
                vertex: v,
                at,
                turn: turn * turned,
            };
            match place {
                Ok(k) => self.moved[k] = moved,
                Err(k) => self.moved.insert(k, moved),
            }
        }
        Ok(())
    }

    /// What is known of a vertex that has moved, by any of its numbers.
    pub(in crate::fairing) fn at(&self, vertex: u32) -> Option<&MovedVertex> {
        let place = self.moved.binary_search_by_key(&vertex, |m| m.vertex).ok()?;
        Some(&self.moved[place])
    }
}

fn check(vertex: u32, at: [f64; 3]) -> Result<(), Error> {
    let vertex = vertex as usize;
    if !at.iter().all(|x| x.is_finite()) {
        return Err(Error::NotFinite { vertex });
    }
    match at.into_iter().find(|x| x.abs() > LARGEST_COORDINATE) {
        Some(coordinate) => Err(Error::CoordinateTooLarge { vertex, coordinate }),
        None => Ok(()),
    }
}
