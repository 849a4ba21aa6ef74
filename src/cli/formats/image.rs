//! Pictures that surfaces are covered with.

use std::io::Cursor;

use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// Rows of pixels from the top.
pub struct Image {
    size: [usize; 2],
    /// Red, green and blue, sRGB.
    rgb: Vec<[u8; 3]>,
}

impl Image {
    /// Of the bytes of a PNG or JPEG file.
    ///
    /// # Errors
    /// What is wrong, in words.
    pub fn decode(bytes: &[u8]) -> Result<Self, String> {
        let image = if bytes.starts_with(b"\x89PNG") {
            of_png(bytes)
        } else if bytes.starts_with(b"\xff\xd8") {
            of_jpeg(bytes)
        } else {
            return Err("only PNG and JPEG are read as textures; convert it".to_owned());
        };
        let image = image.map_err(|why| format!("this picture cannot be read: {why}"))?;
        match image.rgb.is_empty() || image.rgb.len() != image.size[0] * image.size[1] {
            true => Err("this picture has no pixels".to_owned()),
            false => Ok(image),
        }
    }

    /// Linear light at a place: (0, 0) is the lower left corner, (1, 1) the upper right one. Between the middles of pixels it is
    /// interpolated.
    pub fn light(&self, place: [f64; 2], is_clamped: bool) -> [f32; 3] {
        let within = |x: f64| match is_clamped {
            true => x.clamp(0.0, 1.0),
            false => x - x.floor(),
        };
        let [u, v] = place.map(|x| if x.is_finite() { within(x) } else { 0.0 });
        let along = [
            u * self.size[0] as f64 - 0.5,
            (1.0 - v) * self.size[1] as f64 - 0.5,
        ];
        let neighbour = |k: usize, by: i64| {
            let (at, size) = (along[k].floor() as i64 + by, self.size[k] as i64);
            (match is_clamped {
                true => at.clamp(0, size - 1),
                false => at.rem_euclid(size),
            }) as usize
        };
        let part = along.map(|x| (x - x.floor()) as f32);
        let mut light = [0.0; 3];
        for (i, wide) in [(0, 1.0 - part[0]), (1, part[0])] {
            for (j, high) in [(0, 1.0 - part[1]), (1, part[1])] {
                let pixel = self.rgb[neighbour(1, j) * self.size[0] + neighbour(0, i)];
                (0..3).for_each(|k| light[k] += wide * high * linear(f64::from(pixel[k])));
            }
        }
        light
    }
}

/// Linear light of an sRGB channel from 0 to 255.
pub fn linear(channel: f64) -> f32 {
    let share = (channel / 255.0).clamp(0.0, 1.0);
    match share <= 0.040_45 {
        true => (share / 12.92) as f32,
        false => ((share + 0.055) / 1.055).powf(2.4) as f32,
    }
}

fn of_png(bytes: &[u8]) -> Result<Image, String> {
    let told = |why: png::DecodingError| why.to_string();
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(told)?;
    let size = reader.output_buffer_size().ok_or("it is too large")?;
    let mut pixels = vec![0; size];
    let info = reader.next_frame(&mut pixels).map_err(told)?;
    let channels = info.color_type.samples();
    Ok(Image {
        size: [info.width as usize, info.height as usize],
        rgb: pixels[..info.buffer_size()]
            .chunks_exact(channels)
            .map(|of| match channels {
                1 | 2 => [of[0]; 3],
                _ => [of[0], of[1], of[2]],
            })
            .collect(),
    })
}

fn of_jpeg(bytes: &[u8]) -> Result<Image, String> {
    let options = DecoderOptions::default().jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = JpegDecoder::new_with_options(Cursor::new(bytes), options);
    let pixels = decoder.decode().map_err(|why| why.to_string())?;
    let (width, height) = decoder.dimensions().ok_or("its size is missing")?;
    Ok(Image {
        size: [width, height],
        rgb: pixels.chunks_exact(3).map(|of| [of[0], of[1], of[2]]).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_counted_from_the_lower_left_corner() {
        let image = Image {
            size: [2, 2],
            rgb: vec![[255, 0, 0], [0, 255, 0], [0, 0, 255], [255; 3]],
        };
        let at = |u: f64, v: f64, clamp: bool| image.light([u, v], clamp);
        assert_eq!(at(0.25, 0.75, false), [1.0, 0.0, 0.0]);
        assert_eq!(at(0.75, 0.75, false), [0.0, 1.0, 0.0]);
        assert_eq!(at(0.25, 0.25, false), [0.0, 0.0, 1.0]);
        assert_eq!(at(3.75, -0.75, false), [1.0, 1.0, 1.0]);
        // Beyond the edge: repeated, or as at the edge.
        assert_eq!(at(-0.25, 0.75, false), [0.0, 1.0, 0.0]);
        assert_eq!(at(-0.25, 0.75, true), [1.0, 0.0, 0.0]);
        assert_eq!(at(0.0, 0.75, true), [1.0, 0.0, 0.0]);
        assert_eq!(at(0.0, 0.75, false), [0.5, 0.5, 0.0]);
        assert!(at(f64::NAN, f64::INFINITY, false)[0].is_finite());
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        let why = |bytes: &[u8]| Image::decode(bytes).err().unwrap();
        assert_begins!(why(b"GIF89a"), "only PNG and JPEG");
        assert_begins!(why(b"\x89PNG\r\n\x1a\n"), "this picture cannot be read: ");
        assert_begins!(why(b"\xff\xd8\xff"), "this picture cannot be read: ");
    }
}
