//! Pictures that a mesh is covered with: which ones, and which of their points belong to the corners of each triangle.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use super::carry::Corners;
use super::image::{Image, linear};
use super::mesh_file::{MeshFile, Places};
use super::pipes::is_piped;
use super::{obj, references};
use crate::failure::Failure;
use crate::text;

/// What the surface is made of.
#[derive(Clone)]
pub struct Material {
    /// Where it has no picture: red, green and blue, from 0 to 255.
    pub colour: [f64; 3],
    pub image: Option<usize>,
    /// What lies outside of the picture has the colour of its edge; otherwise the picture is repeated.
    pub is_clamped: bool,
}

/// A mesh's pictures and how they lie on it.
pub struct Textured {
    pub images: Vec<Image>,
    pub materials: Vec<Material>,
    /// Per triangle its material; None: none that the file tells.
    pub material_of: Vec<Option<u32>>,
    /// Per triangle the places of its corners in the picture, from its lower left corner on.
    pub corners: Vec<Option<Corners>>,
}

/// A picture that is named, and by what.
struct Named<'a> {
    name: &'a str,
    by: &'a str,
    folder: &'a Path,
}

const INSTEAD: &str = "--shade flat or colors needs none";

impl MeshFile {
    /// The pictures of a file of this name.
    ///
    /// # Errors
    /// No picture named, or none found, or none that is PNG or JPEG; places of corners that are missing.
    pub fn textured(&self, path: &Path) -> Result<Textured, Failure> {
        let name = path.display();
        if is_piped(path) {
            return Err(Failure::new(format!(
                "-: a mesh from stdin has no folder that its textures could be in; {INSTEAD}"
            )));
        }
        let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
        let folder = parent.unwrap_or(Path::new("."));
        let textured = match &self.places {
            Places::Obj(_) => self.of_obj(&name.to_string(), folder)?,
            Places::Ply(_) => self.of_ply(&name.to_string(), folder)?,
            Places::Off(_) | Places::Stl(_) => {
                return Err(Failure::new(format!(
                    "{name}: {} has no textures; {INSTEAD}",
                    self.format().name()
                )));
            }
        };
        if textured.corners.iter().all(Option::is_none) {
            return Err(Failure::new(format!(
                "{name}: its faces have no texture coordinates; {INSTEAD}"
            )));
        }
        Ok(textured)
    }

    fn of_obj(&self, name: &str, folder: &Path) -> Result<Textured, Failure> {
        let (uses, corners) = obj::materials_and_corners(&self.bytes);
        let mut known = BTreeMap::new();
        let mut textured = Textured {
            images: Vec::new(),
            materials: Vec::new(),
            material_of: Vec::new(),
            corners,
        };
        let libraries = references::named(&self.bytes, self.format(), folder);
        if libraries.is_empty() {
            return Err(Failure::new(format!(
                "{name}: it names no materials (mtllib), and so no texture; {INSTEAD}"
            )));
        }
        for library in libraries {
            let place = folder.join(&library);
            let bytes = fs::read(&place).map_err(|why| {
                Failure::new(format!(
                    "{name}: its materials {library} cannot be read in {}: {why}; {INSTEAD}",
                    folder.display()
                ))
            })?;
            let beside = place.parent().unwrap_or(folder);
            textured.read_library(&bytes, &library, beside, &mut known)?;
        }
        if textured.images.is_empty() {
            return Err(Failure::new(format!(
                "{name}: none of its materials has a texture (map_Kd); {INSTEAD}"
            )));
        }
        textured.material_of = uses.iter().map(|of| known.get(of.as_deref()?).copied()).collect();
        Ok(textured)
    }

    fn of_ply(&self, name: &str, folder: &Path) -> Result<Textured, Failure> {
        let Places::Ply(places) = &self.places else {
            return Err(Failure::new(format!("{name}: this is no PLY file")));
        };
        let names = references::named(&self.bytes, self.format(), folder);
        if names.is_empty() {
            return Err(Failure::new(format!(
                "{name}: it names no texture (comment TextureFile); {INSTEAD}"
            )));
        }
        let (mut images, mut materials) = (Vec::new(), Vec::new());
        for image in &names {
            let named = Named {
                name: image,
                by: name,
                folder,
            };
            materials.push(Material {
                colour: [255.0; 3],
                image: Some(images.len()),
                is_clamped: false,
            });
            images.push(named.read()?);
        }
        Ok(Textured {
            images,
            materials,
            material_of: places.texture_numbers(&self.bytes, &self.geometry),
            corners: places.texture_corners(&self.bytes, &self.geometry),
        })
    }
}

impl Textured {
    /// Linear light of a point of a triangle, given by its barycentric coordinates.
    pub fn light(&self, triangle: usize, weights: [f64; 3]) -> [f32; 3] {
        const NONE: [f32; 3] = [0.3; 3];
        let number = self.material_of.get(triangle).copied().flatten();
        let Some(material) = number.and_then(|number| self.materials.get(number as usize)) else {
            return NONE;
        };
        let Some(image) = material.image else {
            return material.colour.map(linear);
        };
        let Some(corners) = &self.corners[triangle] else {
            return NONE;
        };
        let place = [0, 1].map(|k| (0..3).map(|i| weights[i] * corners[i][k]).sum());
        self.images[image].light(place, material.is_clamped)
    }

    /// The materials of a library, each with its picture.
    fn read_library(
        &mut self,
        bytes: &[u8],
        library: &str,
        folder: &Path,
        known: &mut BTreeMap<String, u32>,
    ) -> Result<(), Failure> {
        let mut images: BTreeMap<String, usize> = BTreeMap::new();
        let mut at = text::start(bytes);
        let first = self.materials.len();
        while at < bytes.len() {
            let (line, next) = text::line(bytes, at);
            at = next;
            let line = String::from_utf8_lossy(&bytes[line]).trim().to_owned();
            let (key, rest) = line.split_once(char::is_whitespace).unwrap_or((&line, ""));
            let rest = rest.trim();
            if key == "newmtl" {
                known.insert(rest.to_owned(), self.materials.len() as u32);
                self.materials.push(Material {
                    colour: [255.0; 3],
                    image: None,
                    is_clamped: false,
                });
                continue;
            }
            let Some(material) = self.materials[first..].last_mut() else {
                continue;
            };
            match key {
                "Kd" => {
                    let numbers: Vec<f64> = rest.split_whitespace().filter_map(|w| w.parse().ok()).collect();
                    if let &[r, g, b] = &numbers[..] {
                        material.colour = [r, g, b].map(|channel: f64| 255.0 * channel.clamp(0.0, 1.0));
                    }
                }
                "map_Kd" => {
                    let (name, is_clamped) = map_name(rest);
                    let number = match images.get(&name) {
                        Some(&number) => number,
                        None => {
                            let named = Named {
                                name: &name,
                                by: library,
                                folder,
                            };
                            self.images.push(named.read()?);
                            images.insert(name, self.images.len() - 1);
                            self.images.len() - 1
                        }
                    };
                    (material.image, material.is_clamped) = (Some(number), is_clamped);
                }
                _ => {}
            }
        }
        Ok(())
    }
}

/// The file that `map_Kd` names behind its options, and whether it is not to be repeated.
fn map_name(rest: &str) -> (String, bool) {
    let mut words = rest.split_whitespace().peekable();
    let (mut is_clamped, mut rest) = (false, rest);
    while let Some(option) = words.next_if(|word| word.starts_with('-')) {
        rest = rest.trim_start()[option.len()..].trim_start();
        let most = match option {
            "-o" | "-s" | "-t" => 3,
            "-mm" => 2,
            _ => 1,
        };
        for k in 0..most {
            // One to three numbers may stand behind some of them.
            let is_value = |word: &&str| k == 0 || word.parse::<f64>().is_ok();
            let Some(value) = words.next_if(is_value) else {
                break;
            };
            is_clamped |= option == "-clamp" && value == "on";
            rest = rest[value.len()..].trim_start();
        }
    }
    (rest.to_owned(), is_clamped)
}

impl Named<'_> {
    fn read(&self) -> Result<Image, Failure> {
        let Self { name, by, folder } = self;
        // Meshes from Windows name their files with its separator.
        let places: [PathBuf; 2] = [folder.join(name), folder.join(name.replace('\\', "/"))];
        let place = places.iter().find(|place| place.is_file()).ok_or_else(|| {
            Failure::new(format!(
                "{by}: the texture {name} was not found in {}; put it there, or correct its name in {by}; {INSTEAD}",
                folder.display()
            ))
        })?;
        let bytes = fs::read(place)
            .map_err(|why| Failure::new(format!("{}: cannot read: {why}", place.display())))?;
        Image::decode(&bytes).map_err(|why| Failure::new(format!("{}: {why}", place.display())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_textures_stand_behind_their_options() {
        let read = |text: &str| map_name(text);
        assert_eq!(read("wood.png"), ("wood.png".to_owned(), false));
        assert_eq!(
            read("-s 1 1 1 -clamp on my wood.png"),
            ("my wood.png".to_owned(), true)
        );
        assert_eq!(read("-blendu off -o 0.5 a.jpg"), ("a.jpg".to_owned(), false));
        assert_eq!(read(""), (String::new(), false));
    }
}
