//! Tiles in rows with captions and a scale of colours, as one picture.

use std::ops::Range;

use super::canvas::srgb;
use super::letters::{LETTER, LINE, write};
use super::pixels::{Pixels, Rgb};
use super::scale::Scale;

/// Room for a caption, in pixels.
const CAPTION: u32 = LINE + 8;
/// Room for the scale: bar, gap, and numbers of nine letters.
const SCALE: u32 = 30 + 9 * LETTER;
/// A bar is not longer than this.
const TALLEST: u32 = 600;
/// Numbers beside the bar.
const MARKS: u32 = 5;
const WHITE: Rgb = [255; 3];

/// What is put around the tiles.
#[derive(Debug, Clone, Copy, Default)]
pub struct Layout<'a> {
    /// Tiles per row.
    pub columns: usize,
    /// Lines above the tiles.
    pub head: &'a [String],
    /// One per tile, or none at all.
    pub captions: &'a [String],
    /// What the colours of some rows mean.
    pub scales: &'a [(Range<usize>, &'a Scale)],
}

/// Where the tiles are on a sheet.
struct Grid {
    tile: [u32; 2],
    columns: usize,
    rows: usize,
    /// Height of the head, and of a row's captions.
    head: u32,
    caption: u32,
}

impl Grid {
    fn new(tiles: &[Pixels], layout: &Layout<'_>) -> Self {
        let columns = layout.columns.clamp(1, tiles.len().max(1));
        let lines = layout.head.len() as u32;
        Self {
            tile: tiles.first().map_or([0, 0], |tile| tile.size),
            columns,
            rows: tiles.len().div_ceil(columns),
            head: if lines > 0 { lines * (LINE + 2) + 12 } else { 0 },
            caption: if layout.captions.is_empty() { 0 } else { CAPTION },
        }
    }

    /// Width of all tiles of a row.
    fn width(&self) -> u32 {
        self.tile[0] * self.columns as u32
    }

    /// Where a row begins.
    fn top(&self, row: usize) -> u32 {
        self.head + (self.tile[1] + self.caption) * row as u32
    }
}

/// The tiles in rows, with what is put around them.
pub fn arrange(tiles: &[Pixels], layout: &Layout<'_>) -> Pixels {
    let grid = Grid::new(tiles, layout);
    let scale = if layout.scales.is_empty() { 0 } else { SCALE };
    let mut sheet = Pixels::filled([grid.width() + scale, grid.top(grid.rows)], WHITE);
    for (k, line) in (0..).zip(layout.head) {
        let text = shortened(line, (sheet.size[0].saturating_sub(16) / LETTER) as usize);
        write(&mut sheet, [8, 8 + k * (LINE + 2)], &text);
    }
    for (number, tile) in tiles.iter().enumerate() {
        let (x, y) = (
            (number % grid.columns) as u32 * grid.tile[0],
            grid.top(number / grid.columns),
        );
        sheet.place(tile, x, y);
        if let Some(text) = layout.captions.get(number) {
            let text = shortened(text, (grid.tile[0] / LETTER).max(1) as usize);
            let letters = text.chars().count() as u32;
            let left = x + grid.tile[0].saturating_sub(letters * LETTER) / 2;
            write(&mut sheet, [left, y + grid.tile[1] + 4], &text);
        }
    }
    for (rows, scale) in layout.scales {
        let (top, bottom) = (grid.top(rows.start), grid.top(rows.end) - grid.caption);
        draw_scale(&mut sheet, grid.width() + 10, top..bottom, scale);
    }
    sheet
}

/// The first of each list, then the second ones, and so on.
pub fn in_turns<T>(lists: Vec<Vec<T>>) -> Vec<T> {
    let mut lists: Vec<_> = lists.into_iter().map(Vec::into_iter).collect();
    let mut all = Vec::new();
    while let Some(first) = lists.first_mut().and_then(Iterator::next) {
        all.push(first);
        all.extend(lists[1..].iter_mut().filter_map(Iterator::next));
    }
    all
}

/// Text of so many letters at most; three points stand for what is left out.
fn shortened(text: &str, most: usize) -> String {
    let letters = text.chars().count();
    if letters <= most || most < 8 {
        return text.chars().take(most).collect();
    }
    text.chars().take(most - 3).chain("...".chars()).collect()
}

/// A bar of all colours from the bottom up, with numbers.
fn draw_scale(sheet: &mut Pixels, left: u32, within: Range<u32>, scale: &Scale) {
    write(sheet, [left, within.start + 4], &shortened(&scale.title, 11));
    let (top, bottom) = (
        within.start + LINE + 16,
        within
            .end
            .saturating_sub(LINE)
            .min(within.start + LINE + 16 + TALLEST),
    );
    if bottom <= top + 1 {
        return;
    }
    let length = bottom - top - 1;
    for y in 0..=length {
        let share = 1.0 - f64::from(y) / f64::from(length);
        let colour = scale.share(share).map(srgb);
        (0..14).for_each(|x| sheet.set(left + x, top + y, colour));
    }
    let [low, high] = scale.range;
    // Numbers that would lie on each other are left out.
    let marks = MARKS.min(length / LINE + 1).max(2);
    for mark in 0..marks {
        let share = f64::from(mark) / f64::from(marks - 1);
        let y = top + ((1.0 - share) * f64::from(length)).round() as u32;
        let number = scale.number(low + share * (high - low));
        write(sheet, [left + 20, y - LINE / 2], &shortened(&number, 9));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_take_turns() {
        assert_eq!(
            in_turns(vec![vec![1, 4], vec![2, 5], vec![3, 6]]),
            [1, 2, 3, 4, 5, 6]
        );
        assert_eq!(in_turns::<i32>(Vec::new()), [0; 0]);
    }
}
