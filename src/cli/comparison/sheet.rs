//! Before and after on one sheet: what has changed from near, and where it is on the whole mesh.

use std::rc::Rc;

use super::changes::Comparison;
use super::surface::{MeshSide, V3};
use crate::failure::Failure;
use crate::figures::significant;
use crate::picture::{self, Group, Layout, Palette, PictureOptions, Pixels, Places, Scale, Shading, View};
use crate::render::range::{self, Shown};

/// Width and height of a picture.
const TILE: [usize; 2] = [520, 440];
/// Samples per pixel along each axis. With half of them edges and lines are ragged, for 6 % less time; with double it takes 57 % more, and looks the
/// same (`docs/dented.ply`).
const SAMPLES: usize = 2;
/// Room around what has changed.
const MARGIN: f64 = 0.18;

impl Comparison<'_> {
    fn direction(&self, up: V3) -> V3 {
        let (surface, marked) = self.changed();
        let options = PictureOptions {
            margin: MARGIN,
            up,
            ..PictureOptions::default()
        };
        picture::best_direction(surface.positions, surface.triangles, marked, &options)
    }

    /// Before and after, painted; if asked, with what each pixel shows.
    pub fn sheet(&self, direction: Option<V3>, up: V3, with_places: bool) -> Sheet {
        let direction = direction.unwrap_or_else(|| self.direction(up));
        let [before, after] = [
            self.before.vertices_of(&self.gone),
            self.after.vertices_of(&self.new),
        ];
        let none: &[bool] = &[];
        let focus = match self.is_changed() {
            true => [&before[..], &after[..]],
            false => [none; 2],
        };
        let sides = [&self.before, &self.after];
        let near = |side: usize, shading| view(sides[side], shading, focus[side]);
        let (side, caption, values, scale) = self.values(focus[1]);
        let painted = match &self.moved {
            Some(moved) => MeshSide {
                positions: &moved.painted[side].positions,
                triangles: &moved.painted[side].triangles,
            },
            None => *sides[side],
        };
        let views = [
            near(0, Shading::Flat),
            near(1, Shading::Flat),
            near(0, Shading::ReflectionLines),
            near(1, Shading::ReflectionLines),
            view(&painted, Shading::Values(&values, &scale), focus[side]),
        ];
        let options = PictureOptions {
            tile: TILE,
            margin: MARGIN,
            samples: SAMPLES,
            direction,
            up,
            ..PictureOptions::default()
        };
        let all = PictureOptions {
            margin: PictureOptions::default().margin,
            ..options
        };
        // A place that would be lost on the whole mesh gets a frame.
        let framed: Vec<V3> = (self.after.positions.iter().zip(&after))
            .filter(|(_, is_in)| **is_in)
            .map(|(p, _)| *p)
            .collect();
        let groups = [
            Group {
                views: &views,
                options: &options,
                framed: &[],
                labels: &[],
            },
            Group {
                views: &[view(&self.after, Shading::Marked(&self.new), &[])],
                options: &all,
                framed: &framed,
                labels: &[],
            },
        ];
        let captions = [
            "before",
            "after",
            "before: reflection lines",
            "after: reflection lines",
            caption,
            "the whole mesh: what has changed",
        ];
        Sheet {
            places: if with_places {
                places(&groups, side)
            } else {
                Vec::new()
            },
            tiles: groups.iter().flat_map(picture::tiles).collect(),
            captions: captions.map(str::to_owned),
            scale,
        }
    }

    /// Which side is painted by numbers, what these are, and their scale: how far it has moved, or its mean curvature.
    fn values(&self, focus: &[bool]) -> (usize, &'static str, Vec<f64>, Scale) {
        if let Some(moved) = &self.moved {
            let farthest = moved.farthest();
            let most = farthest.largest;
            let (side, caption) = match std::ptr::eq(farthest, &moved.back) {
                true => (0, "before: distance from the surface after"),
                false => (1, "after: distance from the surface before"),
            };
            let scale = Scale {
                title: "distance".to_owned(),
                range: [0.0, if most > 0.0 { most } else { 1.0 }],
                palette: Palette::Sequential,
            };
            return (side, caption, farthest.vertices.clone(), scale);
        }
        let h = self.curvature(1);
        let shown = Shown {
            positions: self.after.positions,
            triangles: self.after.triangles,
            values: h,
            focus,
        };
        let scale = range::usual("H", &[shown]);
        (1, "after: mean curvature", h.to_vec(), scale)
    }

    /// How much has changed, in a line.
    pub fn told(&self) -> String {
        let [gone, new] = [&self.gone, &self.new].map(|of| of.iter().filter(|&&is| is).count());
        match &self.moved {
            _ if !self.is_changed() => "nothing has changed".to_owned(),
            Some(moved) => {
                let diagonal = self.before.bounds(|_| true).diagonal();
                format!(
                    "moved by at most {} ({} % of the mesh's diagonal), rms {}",
                    significant(moved.farthest().largest),
                    significant(100.0 * moved.farthest().largest / diagonal),
                    significant(moved.rms())
                )
            }
            None if gone == 0 => format!("{new} new triangles"),
            None => format!("{gone} triangles are gone"),
        }
    }
}

/// The pictures of a comparison.
pub struct Sheet {
    tiles: Vec<Pixels>,
    /// What the pixels of each tile show, if that was asked.
    places: Vec<Rc<Places>>,
    captions: [String; 6],
    /// Of the picture that is painted by numbers.
    scale: Scale,
}

/// One of the pictures.
pub struct Picture {
    pub caption: String,
    pub png: Vec<u8>,
    pub places: Option<Rc<Places>>,
}

/// What the pixels of all tiles show: pictures of the same surface by the same camera have theirs in common. `painted` is the side that is painted by
/// numbers.
fn places(groups: &[Group<'_>; 2], painted: usize) -> Vec<Rc<Places>> {
    let near: Vec<Rc<Places>> = picture::places(&groups[0], &[0, 1])
        .into_iter()
        .map(Rc::new)
        .collect();
    let whole = picture::places(&groups[1], &[0]).into_iter().map(Rc::new);
    [0, 1, 0, 1, painted]
        .map(|side| Rc::clone(&near[side]))
        .into_iter()
        .chain(whole)
        .collect()
}

/// Which picture that is.
const PAINTED: usize = 4;

impl Sheet {
    /// All on one sheet as PNG, with lines above.
    pub fn png(&self, head: &[String]) -> Result<Vec<u8>, Failure> {
        let layout = Layout {
            columns: 2,
            head,
            captions: &self.captions,
            scales: &[(2..3, &self.scale)],
        };
        picture::sheet(&self.tiles, &layout)
    }

    /// Each by itself.
    pub fn pictures(&self) -> Result<Vec<Picture>, Failure> {
        let painted = [(0..1, &self.scale)];
        (0..self.tiles.len())
            .map(|k| {
                let layout = Layout {
                    columns: 1,
                    scales: if k == PAINTED { &painted } else { &[] },
                    ..Layout::default()
                };
                let png = picture::sheet(&self.tiles[k..=k], &layout)?;
                Ok(Picture {
                    caption: self.captions[k].clone(),
                    png,
                    places: self.places.get(k).cloned(),
                })
            })
            .collect()
    }
}

fn view<'a>(surface: &MeshSide<'a>, shading: Shading<'a>, focus: &'a [bool]) -> View<'a> {
    View {
        positions: surface.positions,
        triangles: surface.triangles,
        shading,
        focus,
    }
}
