//! Words of a command line, as they can be typed into a shell again.

/// In quotes, where a shell would take it for something else.
pub fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "/._-,=:+@%".contains(c);
    match !word.is_empty() && word.chars().all(is_plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', "'\\''")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_stay_words() {
        assert_eq!(
            ["a.ply", "a b", "it's", "", "-1,2"].map(quoted),
            ["a.ply", "'a b'", "'it'\\''s'", "''", "-1,2"]
        );
    }
}
