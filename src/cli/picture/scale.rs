//! What colours mean: a range of values and the colours that run over it.

use crate::figures;

/// Colours from the least to the greatest value; all can be told apart without telling red from green.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Palette {
    /// From pale to dark: of amounts; what has none shows its shape.
    Sequential,
    /// From blue over white to red: of what lies on both sides of a middle.
    Diverging,
}

/// A range of values with its colours.
#[derive(Debug, Clone, PartialEq)]
pub struct Scale {
    pub title: String,
    pub range: [f64; 2],
    pub palette: Palette,
}

impl Scale {
    /// Linear light of a value; grey where there is none.
    pub fn light(&self, value: f64) -> [f32; 3] {
        let [low, high] = self.range;
        self.share((value - low) / (high - low))
    }

    /// Linear light of a place on the scale, from 0 to 1.
    pub fn share(&self, share: f64) -> [f32; 3] {
        if share.is_nan() {
            return [0.3; 3];
        }
        let share = share.clamp(0.0, 1.0);
        let colour = match self.palette {
            // The darker, the farther from zero.
            Palette::Sequential => colorous::YELLOW_ORANGE_RED.eval_continuous(match self.range[1] <= 0.0 {
                true => 1.0 - share,
                false => share,
            }),
            Palette::Diverging => colorous::RED_BLUE.eval_continuous(1.0 - share),
        };
        [colour.r, colour.g, colour.b].map(|byte| (f32::from(byte) / 255.0).powf(2.2))
    }

    /// A value with as many digits as tell it from others on the scale.
    pub fn number(&self, value: f64) -> String {
        let extent = self.range[1] - self.range[0];
        let digits = (2.0 - extent.log10()).ceil();
        if (0.0..=7.0).contains(&digits) && value.abs() < 1e5 {
            format!("{value:.*}", digits as usize)
        } else if value == 0.0 {
            figures::significant(value)
        } else {
            format!("{value:.2e}")
        }
    }
}
