//! Tiles in rows with captions and a scale of colours, as one picture.

use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

use super::canvas::srgb;
use super::paint::scale_colour;
use super::pixels::{Pixels, Rgb};

const FONT: (FontWeight, RasterHeight) = (FontWeight::Regular, RasterHeight::Size16);
/// Width of a letter, height of a line of text, and room for a caption, in pixels.
const LETTER: u32 = get_raster_width(FONT.0, FONT.1) as u32;
const LINE: u32 = FONT.1 as u32;
const CAPTION: u32 = LINE + 8;
/// Room for the scale: bar, gap, and numbers of nine letters.
const SCALE: u32 = 30 + 9 * LETTER;
/// Numbers beside the bar.
const MARKS: u32 = 5;
const WHITE: Rgb = [255; 3];

/// What is put around the tiles.
#[derive(Debug, Clone, Copy, Default)]
pub struct Layout<'a> {
    /// Tiles per row.
    pub columns: usize,
    /// One per tile, or none at all.
    pub captions: &'a [String],
    /// What the colours mean: title and range.
    pub scale: Option<(&'a str, [f64; 2])>,
}

/// The tiles in rows, with what is put around them.
pub fn arrange(tiles: &[Pixels], layout: &Layout<'_>) -> Pixels {
    let [width, height] = tiles.first().map_or([0, 0], |tile| tile.size);
    let columns = layout.columns.clamp(1, tiles.len().max(1));
    let rows = tiles.len().div_ceil(columns) as u32;
    let caption = if layout.captions.is_empty() { 0 } else { CAPTION };
    let scale = if layout.scale.is_some() { SCALE } else { 0 };
    let mut sheet = Pixels::filled([width * columns as u32 + scale, (height + caption) * rows], WHITE);
    for (number, tile) in tiles.iter().enumerate() {
        let (x, y) = (
            (number % columns) as u32 * width,
            (number / columns) as u32 * (height + caption),
        );
        sheet.place(tile, x, y);
        if let Some(text) = layout.captions.get(number) {
            let letters = text.chars().count() as u32;
            let shown = letters.min((width / LETTER).max(1));
            let left = x + width.saturating_sub(shown * LETTER) / 2;
            write(&mut sheet, [left, y + height + 4], text, shown);
        }
    }
    if let Some((title, range)) = layout.scale {
        let [left, bottom] = [width * columns as u32 + 10, (height + caption) * rows - caption];
        draw_scale(&mut sheet, left, bottom, title, range);
    }
    sheet
}

/// A bar of all colours from the bottom up, with numbers.
fn draw_scale(sheet: &mut Pixels, left: u32, bottom: u32, title: &str, [low, high]: [f64; 2]) {
    write(sheet, [left, 4], title, 9);
    let (top, bottom) = (LINE + 16, bottom.saturating_sub(LINE));
    if bottom <= top + 1 {
        return;
    }
    let length = bottom - top - 1;
    for y in 0..=length {
        let share = 1.0 - f64::from(y) / f64::from(length);
        let colour = scale_colour(share, [0.0, 1.0]).map(srgb);
        (0..14).for_each(|x| sheet.set(left + x, top + y, colour));
    }
    for mark in 0..MARKS {
        let share = f64::from(mark) / f64::from(MARKS - 1);
        let y = top + ((1.0 - share) * f64::from(length)).round() as u32;
        write(
            sheet,
            [left + 20, y - LINE / 2],
            &number(low + share * (high - low), high - low),
            9,
        );
    }
}

/// A number with as many digits as tell the marks apart.
fn number(value: f64, extent: f64) -> String {
    let digits = (2.0 - extent.log10()).ceil();
    if (0.0..=7.0).contains(&digits) && value.abs() < 1e5 {
        format!("{value:.*}", digits as usize)
    } else {
        format!("{value:.2e}")
    }
}

/// Writes up to `most` letters in black on white.
fn write(sheet: &mut Pixels, [left, top]: [u32; 2], text: &str, most: u32) {
    for (k, c) in (0..most).zip(text.chars()) {
        let glyph = get_raster(c, FONT.0, FONT.1).or_else(|| get_raster('?', FONT.0, FONT.1));
        let Some(glyph) = glyph else { continue };
        for (y, row) in (top..).zip(glyph.rows()) {
            for (x, &ink) in (left + k * LETTER..).zip(row.iter()) {
                sheet.set(x, y, [255 - ink; 3]);
            }
        }
    }
}
