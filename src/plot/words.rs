//! Words in the room that there is.

use crate::picture::text;

/// A text in lines that are no wider than `width` pixels, broken between words; a word that is
/// too wide by itself is broken too, after a sign in it where there is one. No line for an empty text.
pub(super) fn wrap(text: &str, width: f64, size: f64, bold: bool) -> Vec<String> {
    let wide = |line: &str| text::width(line, size, bold) > width;
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        if let Some(line) = lines.last_mut() {
            let longer = format!("{line} {word}");
            if !wide(&longer) {
                *line = longer;
                continue;
            }
        }
        let mut piece = String::new();
        for letter in word.chars() {
            piece.push(letter);
            if wide(&piece) && piece.chars().count() > 1 {
                piece.pop();
                let whole = piece.len();
                let sign = piece
                    .rfind(['.', '_', '/', '-', ']'])
                    .map_or(whole, |at| at + 1);
                let rest = format!("{}{letter}", &piece[sign..]);
                let (end, rest) = match wide(&rest) {
                    true => (whole, letter.to_string()),
                    false => (sign, rest),
                };
                piece.truncate(end);
                lines.push(std::mem::replace(&mut piece, rest));
            }
        }
        lines.push(piece);
    }
    lines
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn lines_break_between_words() {
        let width = text::width("of the agents", 12.0, false);
        assert_eq!(
            wrap("positions  of the agents", width, 12.0, false),
            ["positions of", "the agents"]
        );
        assert_eq!(
            wrap("laws[0].position_error", width, 12.0, false),
            ["laws[0].", "position_", "error"]
        );
        assert_eq!(wrap("", width, 12.0, false), [""; 0]);
    }

    proptest! {
        #[test]
        fn lines_fit_and_lose_no_letter(words in "[a-z._ ]{0,80}", width in 20.0..300.0_f64) {
            let lines = wrap(&words, width, 11.0, false);
            prop_assert!(lines.iter().all(|line| text::width(line, 11.0, false) <= width));
            let letters = |text: &str| text.replace(' ', "");
            prop_assert_eq!(letters(&lines.concat()), letters(&words));
        }
    }
}
