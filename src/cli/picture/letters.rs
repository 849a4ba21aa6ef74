//! Letters of one width.

use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

use super::pixels::Pixels;

const FONT: (FontWeight, RasterHeight) = (FontWeight::Regular, RasterHeight::Size16);
/// Width of a letter and height of a line of text, in pixels.
pub const LETTER: u32 = get_raster_width(FONT.0, FONT.1) as u32;
pub const LINE: u32 = FONT.1 as u32;

/// Writes letters in black over what is there.
pub fn write(picture: &mut Pixels, [left, top]: [u32; 2], text: &str) {
    for (k, c) in (0..).zip(text.chars()) {
        let glyph = get_raster(c, FONT.0, FONT.1).or_else(|| get_raster('?', FONT.0, FONT.1));
        let Some(glyph) = glyph else { continue };
        for (y, row) in (top..).zip(glyph.rows()) {
            for (x, &ink) in (left + k * LETTER..).zip(row.iter()) {
                picture.darken(x, y, 255 - ink);
            }
        }
    }
}
