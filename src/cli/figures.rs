//! Numbers as people read them.

/// How many numbers a line shows.
const SHOWN: usize = 12;

/// One and several of what is numbered.
pub const VERTICES: [&str; 2] = ["vertex", "vertices"];
pub const FACES: [&str; 2] = ["face", "faces"];
pub const PAIRS: [&str; 2] = ["pair of faces", "pairs of faces"];

/// Two significant digits, for figures of which the order of magnitude counts.
pub fn scientific(value: f64) -> String {
    if value.is_finite() {
        format!("{value:.1e}")
    } else {
        "unknown".into()
    }
}

/// Four significant digits.
pub fn significant(value: f64) -> String {
    if !value.is_finite() {
        return "unknown".into();
    }
    if value == 0.0 || (1e-3..1e6).contains(&value.abs()) {
        let digits = if value == 0.0 {
            0.0
        } else {
            3.0 - value.abs().log10().floor()
        };
        format!("{value:.*}", digits.clamp(0.0, 8.0) as usize)
    } else {
        format!("{value:.3e}")
    }
}

/// The least and the greatest value.
pub fn range([low, high]: [f64; 2]) -> String {
    format!("{} to {}", significant(low), significant(high))
}

/// How many, and the first of them.
pub fn listed(elements: &[impl ToString], [singular, plural]: [&str; 2]) -> String {
    if elements.is_empty() {
        return "none".into();
    }
    let first: Vec<String> = elements.iter().take(SHOWN).map(ToString::to_string).collect();
    let more = if elements.len() > SHOWN { ", ..." } else { "" };
    let noun = if elements.len() == 1 { singular } else { plural };
    format!("{} {noun}: {}{more}", elements.len(), first.join(", "))
}
