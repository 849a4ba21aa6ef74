//! Pictures of surfaces: a small software renderer, supersampled, as PNG.

mod animation;
mod axes;
mod camera;
mod canvas;
mod direction;
mod label;
mod letters;
mod paint;
mod pixels;
mod places;
mod refined;
mod scale;
mod sheet;
mod view;

use rayon::prelude::*;

use crate::failure::Failure;
pub use animation::Animation;
use camera::Camera;
use canvas::Canvas;
pub use direction::best_direction;
pub use label::Label;
pub use pixels::Pixels;
pub use places::Places;
pub use refined::Refined;
pub use scale::{Palette, Scale};
pub use sheet::Layout;
use view::V3;
pub use view::{PictureOptions, Shading, View};

/// Views that are seen by the same camera.
pub struct Group<'a> {
    pub views: &'a [View<'a>],
    pub options: &'a PictureOptions,
    /// Points that a frame is drawn around, if they would be lost in the picture.
    pub framed: &'a [V3],
    /// Words on every view.
    pub labels: &'a [Label],
}

/// Paints views and encodes the picture. Those of one list are seen by the same camera; the lists take turns in the rows.
pub fn render(
    views: &[Vec<View<'_>>],
    options: &PictureOptions,
    layout: &Layout<'_>,
) -> Result<Vec<u8>, Failure> {
    let painted = views.iter().map(|views| {
        tiles(&Group {
            views,
            options,
            framed: &[],
            labels: &[],
        })
    });
    sheet(&sheet::in_turns(painted.collect()), layout)
}

/// The views, as in [`render`], as they turn around the picture's vertical, in so many frames.
pub fn turning(
    views: &[Vec<View<'_>>],
    options: &PictureOptions,
    layout: &Layout<'_>,
    frames: (usize, Animation),
) -> Result<Vec<u8>, Failure> {
    animation::turning(views, options, layout, frames)
        .map_err(|why| Failure::new(format!("cannot make the picture: {why}")))
}

/// Tiles of one size in rows, as PNG.
pub fn sheet(tiles: &[Pixels], layout: &Layout<'_>) -> Result<Vec<u8>, Failure> {
    sheet::arrange(tiles, layout)
        .png()
        .map_err(|why| Failure::new(format!("cannot make the picture: {why}")))
}

/// Paints the views.
pub fn tiles(group: &Group<'_>) -> Vec<Pixels> {
    let options = group.options;
    let camera = Camera::around(group.views, options);
    let frame = frame(&camera, group);
    let paint = |view: &View<'_>| {
        let canvas = Canvas::of(view, &camera, options);
        let mut tile = canvas.painted(view, &camera);
        if options.axes {
            axes::draw(&mut tile, &camera, camera.bounds, options.samples);
        }
        for label in group.labels {
            label.write(&mut tile, &canvas, &camera, options.samples);
        }
        if let Some([low, high]) = frame {
            tile.frame(low, high, paint::MARK.map(canvas::srgb));
        }
        tile
    };
    group.views.par_iter().map(paint).collect()
}

/// Where the pixels of a group's views are, for those that are chosen.
pub fn places(group: &Group<'_>, chosen: &[usize]) -> Vec<Places> {
    let options = PictureOptions {
        samples: 1,
        ..*group.options
    };
    let camera = Camera::around(group.views, &options);
    chosen
        .par_iter()
        .map(|&k| Places::of(&group.views[k], &camera, &options))
        .collect()
}

/// The corners of the frame, in pixels; none where the points fill a good part of the picture.
fn frame(camera: &Camera, group: &Group<'_>) -> Option<[[i64; 2]; 2]> {
    let samples = group.options.samples as f64;
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for p in group.framed.iter().map(|&p| camera.project(p)) {
        for (k, place) in [p.x / samples, p.y / samples].into_iter().enumerate() {
            (low[k], high[k]) = (low[k].min(place), high[k].max(place));
        }
    }
    let is_small = (0..2).all(|k| high[k] - low[k] < LOST * group.options.tile[k] as f64);
    let corner = |at: [f64; 2], room: i64| at.map(|place| place.round() as i64 + room);
    is_small.then(|| [corner(low, -FRAME), corner(high, FRAME)])
}

/// What takes less than this share of a picture is lost in it: it gets a frame, so many pixels around it, or a camera of its own. Of 17 pairs of scans
/// 9 have cameras of their own; at half 7, at double 15, among them parts beside their own mesh that fill half of the picture.
pub const LOST: f64 = 0.3;
const FRAME: i64 = 8;

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::canvas::{BACKDROP, srgb};
    use super::direction::seen;
    use super::*;

    fn h(range: [f64; 2]) -> Scale {
        Scale {
            title: "H".to_owned(),
            range,
            palette: Palette::Diverging,
        }
    }

    /// The pixels of an encoded picture.
    fn decode(bytes: &[u8]) -> (Vec<u8>, [usize; 2]) {
        let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        assert_eq!(info.color_type, png::ColorType::Rgb);
        (pixels, [info.width as usize, info.height as usize])
    }

    /// A square seen from the front, and one half its size before (`near` > 0) or behind it.
    fn squares(near: f64) -> (Vec<V3>, Vec<[u32; 3]>) {
        let mut positions = Vec::new();
        for (side, z) in [(1.0, 0.0), (0.5, near)] {
            positions.extend([
                [-side, -side, z],
                [side, -side, z],
                [side, side, z],
                [-side, side, z],
            ]);
        }
        // The inner one faces away, so that it is painted differently.
        (positions, vec![[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6]])
    }

    fn flat<'a>(positions: &'a [V3], triangles: &'a [[u32; 3]]) -> View<'a> {
        View {
            positions,
            triangles,
            shading: Shading::Flat,
            focus: &[],
        }
    }

    fn from_above() -> PictureOptions {
        PictureOptions {
            tile: [50, 50],
            direction: [0.0, 0.0, 1.0],
            up: [0.0, 1.0, 0.0],
            ..PictureOptions::default()
        }
    }

    fn picture(near: f64, shading: Shading<'_>) -> (Vec<u8>, [usize; 2]) {
        let (positions, triangles) = squares(near);
        let view = View {
            positions: &positions,
            triangles: &triangles,
            shading,
            focus: &[],
        };
        decode(&render(&[vec![view]], &from_above(), &Layout::default()).unwrap())
    }

    fn pixel((pixels, [width, _]): &(Vec<u8>, [usize; 2]), x: usize, y: usize) -> [u8; 3] {
        let at = 3 * (y * width + x);
        [pixels[at], pixels[at + 1], pixels[at + 2]]
    }

    #[test]
    fn what_is_nearer_hides_what_is_behind() {
        let (front, behind) = (picture(0.1, Shading::Flat), picture(-0.1, Shading::Flat));
        let backdrop = BACKDROP.map(srgb);
        for shown in [&front, &behind] {
            assert_eq!(pixel(shown, 0, 0), backdrop);
            assert_ne!(pixel(shown, 10, 25), backdrop);
        }
        assert_ne!(pixel(&front, 25, 25), pixel(&front, 8, 8));
        assert_eq!(pixel(&behind, 25, 25), pixel(&behind, 24, 26));
        assert_eq!(pixel(&front, 8, 8), pixel(&behind, 8, 8));
    }

    #[test]
    fn what_others_hide_is_not_seen() {
        let share = |near: f64, is_marked: [bool; 4]| {
            let (positions, triangles) = squares(near);
            let view = flat(&positions, &triangles);
            seen(&view, &from_above(), &is_marked)
        };
        let inner = [false, false, true, true];
        assert_eq!((share(0.1, inner), share(-0.1, inner)), (1.0, 0.0));
        // The inner square has a quarter of the outer one's area, and a little more, as it is nearer.
        let outer = share(0.01, [true, true, false, false]);
        assert!((outer - 0.75).abs() < 0.02, "{outer}");
        assert_eq!(share(0.1, [false; 4]), 0.0);
    }

    #[test]
    fn a_label_stands_where_its_points_are_and_nowhere_if_they_are_hidden() {
        let white = |near: f64| {
            let (positions, triangles) = squares(near);
            let view = flat(&positions, &triangles);
            let label = Label {
                text: "7".to_owned(),
                points: positions[4..].to_vec(),
            };
            let group = Group {
                views: &[view],
                options: &from_above(),
                framed: &[],
                labels: &[label],
            };
            let pixels = tiles(&group)[0].bytes().as_chunks::<3>().0.to_vec();
            let at = |&k: &usize| pixels[k] == [255; 3];
            (0..pixels.len())
                .filter(at)
                .map(|k| [k % 50, k / 50])
                .collect::<Vec<_>>()
        };
        let front = white(0.1);
        assert_above!(front.len(), 50);
        assert_all!(front, |[x, y]| (15..35).contains(&x) && (10..40).contains(&y));
        assert!(white(-0.1).is_empty());
    }

    #[test]
    fn coordinates_stand_below_and_to_the_left() {
        let tile = |options: PictureOptions| {
            let (positions, triangles) = squares(-0.1);
            let view = flat(&positions, &triangles);
            let group = Group {
                views: &[view],
                options: &PictureOptions {
                    tile: [300, 300],
                    ..options
                },
                framed: &[],
                labels: &[],
            };
            let pixels = tiles(&group)[0].bytes().as_chunks::<3>().0.to_vec();
            let is_ink = |&k: &usize| pixels[k].iter().all(|light| *light < 80);
            (0..pixels.len())
                .filter(is_ink)
                .map(|k| [k % 300, k / 300])
                .collect::<Vec<_>>()
        };
        assert_eq!(tile(from_above()), [[0; 2]; 0]);
        let inked = tile(from_above().with_axes());
        let count = |is_there: fn(&&[usize; 2]) -> bool| inked.iter().filter(is_there).count();
        let (left, below) = (count(|at| at[0] < 50), count(|at| at[1] > 250));
        assert!(left > 200 && below > 200, "{left}, {below}");
        assert_eq!(count(|at| at[0] > 50 && at[1] < 250), 0);
    }

    #[test]
    fn the_surface_fills_the_tile_up_to_the_margin() {
        let shown = picture(-0.1, Shading::Flat);
        let covered = (0..50)
            .filter(|&x| pixel(&shown, x, 25) != BACKDROP.map(srgb))
            .count();
        assert_eq!(covered, 44);
    }

    #[test]
    fn odd_input_makes_a_picture_too() {
        let options = PictureOptions {
            tile: [8, 8],
            ..PictureOptions::default()
        };
        let positions = [[f64::NAN; 3], [0.0; 3], [1.0; 3], [1e308; 3]];
        let triangles = [[0, 1, 2], [1, 1, 1], [1, 2, 3]];
        let two = Layout {
            columns: 2,
            ..Layout::default()
        };
        let values = [f64::NAN, 1.0, f64::INFINITY, 2.0];
        for shading in [
            Shading::Flat,
            Shading::ReflectionLines,
            Shading::Values(&values, &h([1.0, 1.0])),
        ] {
            let view = || View {
                positions: &positions,
                triangles: &triangles,
                shading,
                focus: &[],
            };
            let (_, size) = decode(&render(&[vec![view(), view(), view()]], &options, &two).unwrap());
            assert_eq!(size, [16, 16]);
        }
        render(&[], &options, &two).unwrap_err();
    }

    #[test]
    fn colours_run_over_the_scale_and_the_sheet_has_room_for_it() {
        let (positions, triangles) = squares(-0.1);
        let values: Vec<f64> = positions.iter().map(|p| p[0]).collect();
        let scale = h([-1.0, 1.0]);
        let view = View {
            positions: &positions,
            triangles: &triangles,
            shading: Shading::Values(&values, &scale),
            focus: &[],
        };
        let options = PictureOptions {
            tile: [60, 60],
            direction: [0.0, 0.0, 1.0],
            up: [0.0, 1.0, 0.0],
            ..PictureOptions::default()
        };
        let captions = ["one".to_owned()];
        let layout = Layout {
            columns: 1,
            captions: &captions,
            scales: &[(0..1, &scale)],
            ..Layout::default()
        };
        let shown = decode(&render(&[vec![view]], &options, &layout).unwrap());
        let (low, high) = (pixel(&shown, 6, 30), pixel(&shown, 53, 30));
        assert!(low[2] > 2 * low[1] || low[2] > low[0], "{low:?}");
        assert!(high[0] > 2 * high[2], "{high:?}");
        assert_above!(shown.1[0], 60);
        assert_above!(shown.1[1], 60);
        // Ink below the tile, and the bar beside it.
        assert!((0..60).any(|x| (62..shown.1[1]).any(|y| pixel(&shown, x, y)[0] < 128)));
        assert_ne!(pixel(&shown, 75, 40), [255; 3]);
    }
}
