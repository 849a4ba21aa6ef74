//! Surfaces that turn: frame after frame of a picture, as GIF or animated PNG.

use rayon::prelude::*;

use super::camera::Camera;
use super::canvas::Canvas;
use super::pixels::Pixels;
use super::sheet::{self, Layout};
use super::view::{PictureOptions, View};

/// A whole turn takes so long, in hundredths of a second.
const TURN: usize = 600;
/// What players show faithfully, in the same unit.
const DELAYS: [usize; 2] = [2, 50];
/// So many frames are painted before they are encoded.
const AT_ONCE: usize = 8;
/// From 1, the best palette, to 30.
const GIF_SPEED: i32 = 10;

/// How an animation is encoded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Animation {
    Gif,
    Png,
}

/// The views from so many directions around the vertical of the picture, all from the same distance.
pub fn turning(
    views: &[Vec<View<'_>>],
    options: &PictureOptions,
    layout: &Layout<'_>,
    (frames, animation): (usize, Animation),
) -> Result<Vec<u8>, String> {
    let cameras: Vec<Vec<Camera>> = views
        .iter()
        .map(|views| Camera::turning(views, options, frames))
        .collect();
    let delay = (TURN / frames.max(1)).clamp(DELAYS[0], DELAYS[1]) as u16;
    let numbers: Vec<usize> = (0..frames).collect();
    let painted = numbers.chunks(AT_ONCE).flat_map(|some| -> Vec<Pixels> {
        let paint = |&frame: &usize| {
            let lists = views.iter().zip(&cameras).map(|(views, cameras)| {
                let tile = |view| Canvas::of(view, &cameras[frame], options).painted(view, &cameras[frame]);
                views.iter().map(tile).collect()
            });
            sheet::arrange(&sheet::in_turns(lists.collect()), layout)
        };
        some.par_iter().map(paint).collect()
    });
    match animation {
        Animation::Gif => gif(painted, delay),
        Animation::Png => png(painted, frames as u32, delay).map_err(|why| why.to_string()),
    }
}

fn gif(frames: impl Iterator<Item = Pixels>, delay: u16) -> Result<Vec<u8>, String> {
    let told = |why: gif::EncodingError| why.to_string();
    let mut bytes = Vec::new();
    let mut frames = frames.peekable();
    let Some(first) = frames.peek() else {
        return Ok(bytes);
    };
    let [Ok(width), Ok(height)] = first.size.map(u16::try_from) else {
        return Err("GIF is at most 65535 pixels wide and high".to_owned());
    };
    let mut encoder = gif::Encoder::new(&mut bytes, width, height, &[]).map_err(told)?;
    encoder.set_repeat(gif::Repeat::Infinite).map_err(told)?;
    for frame in frames {
        let mut frame = gif::Frame::from_rgb_speed(width, height, frame.bytes(), GIF_SPEED);
        frame.delay = delay;
        encoder.write_frame(&frame).map_err(told)?;
    }
    drop(encoder);
    Ok(bytes)
}

fn png(frames: impl Iterator<Item = Pixels>, count: u32, delay: u16) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut frames = frames.peekable();
    let Some(first) = frames.peek() else {
        return Ok(bytes);
    };
    let mut encoder = first.encoder(&mut bytes);
    encoder.set_animated(count, 0)?;
    encoder.set_frame_delay(delay, 100)?;
    let mut writer = encoder.write_header()?;
    for frame in frames {
        writer.write_image_data(frame.bytes())?;
    }
    writer.finish()?;
    Ok(bytes)
}
