//! Documents that are run: their fenced blocks, and outputs that are compared with those shown.

/// A fenced block: its language, and its lines from the one behind the fence to the closing fence.
pub(crate) struct Block {
    pub(crate) language: String,
    pub(crate) begin: usize,
    pub(crate) end: usize,
}

pub(crate) fn blocks(lines: &[String]) -> Vec<Block> {
    let fences: Vec<usize> = (0..lines.len())
        .filter(|&i| lines[i].starts_with("```"))
        .collect();
    assert!(fences.len().is_multiple_of(2), "a fence is not closed");
    let block = |pair: &[usize]| Block {
        language: lines[pair[0]][3..].to_owned(),
        begin: pair[0] + 1,
        end: pair[1],
    };
    fences.chunks(2).map(block).collect()
}

/// Whether two numbers agree as far as they are written; None if they are not numbers.
pub(crate) fn same_number(shown: &str, found: &str) -> Option<bool> {
    let (a, b): (f64, f64) = (shown.parse().ok()?, found.parse().ok()?);
    let decimals = |text: &str| text.split_once('.').map_or(0, |(_, digits)| digits.len() as i32);
    Some(if shown.contains('e') && found.contains('e') {
        a == b || (0.1..10.0).contains(&(a / b))
    } else if shown.contains('.') && found.contains('.') {
        (a - b).abs() < 1.01 * 10f64.powi(-decimals(shown).min(decimals(found)))
    } else {
        shown == found
    })
}

/// `...` stands for any word.
pub(crate) fn same_line(shown: &str, found: &str) -> bool {
    let inner = |word: &str| word.trim_matches(['(', ')', ',', ';']).to_owned();
    let words = |line: &str| line.split_whitespace().map(inner).collect::<Vec<String>>();
    let (shown, found) = (words(shown), words(found));
    if shown.first().is_some_and(|word| word == "seconds:") {
        return found.first() == shown.first();
    }
    let same = |i: usize| {
        let named = i > 0 && ["face", "vertex"].contains(&shown[i - 1].as_str());
        named || shown[i] == "..." || same_number(&shown[i], &found[i]).unwrap_or(shown[i] == found[i])
    };
    shown.len() == found.len() && (0..shown.len()).all(same)
}

/// Without the last column of a table that ends with seconds.
fn untimed(lines: &[String]) -> Vec<String> {
    let mut is_timed = false;
    let untimed = lines.iter().map(|line| {
        is_timed |= line.ends_with(" seconds");
        match line.rsplit_once(' ') {
            Some((rest, seconds)) if is_timed && seconds.parse::<f64>().is_ok() => rest.to_owned(),
            _ => line.clone(),
        }
    });
    untimed.collect()
}

/// A line of `...` alone stands for any lines.
pub(crate) fn same_text(shown: &[String], found: &[String]) -> bool {
    same_lines(&untimed(shown), &untimed(found))
}

fn same_lines(shown: &[String], found: &[String]) -> bool {
    match shown.split_first() {
        None => found.is_empty(),
        Some((dots, rest)) if dots.trim() == "..." => {
            (0..=found.len()).any(|k| same_lines(rest, &found[k..]))
        }
        Some((line, rest)) => found
            .split_first()
            .is_some_and(|(first, others)| same_line(line, first) && same_lines(rest, others)),
    }
}
