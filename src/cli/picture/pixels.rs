//! Pixels of a picture, and the picture as PNG.

use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, Filter};

/// Red, green and blue, sRGB.
pub type Rgb = [u8; 3];

/// Rows of pixels from the top, `size[0]` each.
pub struct Pixels {
    pub size: [u32; 2],
    rgb: Vec<Rgb>,
}

impl Pixels {
    /// One colour all over.
    pub fn filled(size: [u32; 2], colour: Rgb) -> Self {
        let count = size[0] as usize * size[1] as usize;
        Self {
            size,
            rgb: vec![colour; count],
        }
    }

    /// The colour of each pixel by its column and row.
    pub fn from_fn(size: [u32; 2], colour: impl Fn(u32, u32) -> Rgb) -> Self {
        let places = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
        let rgb = places.map(|(x, y)| colour(x, y)).collect();
        Self { size, rgb }
    }

    fn index(&self, x: u32, y: u32) -> usize {
        y as usize * self.size[0] as usize + x as usize
    }

    /// Colours a pixel; nothing outside the picture.
    pub fn set(&mut self, x: u32, y: u32, colour: Rgb) {
        if x < self.size[0] && y < self.size[1] {
            let at = self.index(x, y);
            self.rgb[at] = colour;
        }
    }

    /// Leaves so much of a pixel's light, of 255.
    pub fn darken(&mut self, x: u32, y: u32, share: u8) {
        if x < self.size[0] && y < self.size[1] {
            let at = self.index(x, y);
            self.rgb[at] = self.rgb[at].map(|light| (u16::from(light) * u16::from(share) / 255) as u8);
        }
    }

    /// Draws a rectangle of lines two pixels wide.
    pub fn frame(&mut self, low: [i64; 2], high: [i64; 2], colour: Rgb) {
        let mut dot = |x: i64, y: i64| {
            if let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y)) {
                self.set(x, y, colour);
            }
        };
        for wide in 0..2 {
            for x in low[0]..=high[0] {
                dot(x, low[1] + wide);
                dot(x, high[1] - wide);
            }
            for y in low[1]..=high[1] {
                dot(low[0] + wide, y);
                dot(high[0] - wide, y);
            }
        }
    }

    /// Lays another picture over this one, which it has to fit in, with its upper left corner at this pixel.
    pub fn place(&mut self, picture: &Self, left: u32, top: u32) {
        let [width, height] = picture.size;
        for y in 0..height {
            let (from, to) = (picture.index(0, y), self.index(left, top + y));
            let row = &picture.rgb[from..from + width as usize];
            self.rgb[to..to + width as usize].copy_from_slice(row);
        }
    }

    /// Row after row, three bytes a pixel.
    pub fn bytes(&self) -> &[u8] {
        self.rgb.as_flattened()
    }

    /// An encoder for PNG files of this size.
    pub fn encoder<'a>(&self, bytes: &'a mut Vec<u8>) -> Encoder<'static, &'a mut Vec<u8>> {
        let mut encoder = Encoder::new(bytes, self.size[0], self.size[1]);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::Balanced);
        encoder.set_filter(Filter::Adaptive);
        encoder
    }

    /// The picture as a PNG file.
    pub fn png(&self) -> Result<Vec<u8>, EncodingError> {
        let mut bytes = Vec::new();
        let mut writer = self.encoder(&mut bytes).write_header()?;
        writer.write_image_data(self.bytes())?;
        writer.finish()?;
        Ok(bytes)
    }
}
