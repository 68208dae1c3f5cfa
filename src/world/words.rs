//! Words of the messages: names that were meant, numbers, lists, long values.

/// The name that is nearest to a misspelt one, if any is near enough: at most a
/// third of its letters may differ, and at least one may.
pub fn nearest<'a>(word: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    /// Names of the format are far shorter; comparing takes the product of both lengths.
    const LONGEST: usize = 100;
    if word.len() > LONGEST {
        return None;
    }
    let word = word.to_lowercase();
    let near = |name: &&str| word.len().abs_diff(name.len()) <= 4 * (name.len() / 3 + 1);
    names
        .into_iter()
        .filter(near)
        .map(|name| {
            let wrong = strsim::damerau_levenshtein(&word, &name.to_lowercase());
            (wrong, name.chars().count(), name)
        })
        .filter(|&(wrong, length, _)| wrong <= (length / 3).max(1) && wrong < length)
        .min_by_key(|&(wrong, ..)| wrong)
        .map(|(.., name)| name)
}

/// The name of the form `folder/name` that is nearest to one that does not exist, if any is near
/// enough, or has the given name as a part of it.
pub fn nearest_path<'a>(word: &str, names: &[&'a str]) -> Option<&'a str> {
    let all = || names.iter().copied();
    nearest(word, all())
        .or_else(|| all().find(|full| !word.is_empty() && full.contains(word)))
        .or_else(|| all().find(|full| nearest(word, full.rsplit('/').next()).is_some()))
}

/// The hint that names what was meant, if anything is near enough.
pub fn did_you_mean<'a>(word: &str, names: impl IntoIterator<Item = &'a str>) -> Option<String> {
    nearest(word, names).map(|name| format!("did you mean `{name}`?"))
}

/// A number as a person would write it: rounded to twelve digits, with an exponent
/// only where it is very large or small.
pub fn number(x: f64) -> String {
    let x = format!("{x:.11e}").parse().unwrap_or(x);
    if x == 0.0 || (1e-5..1e12).contains(&x.abs()) {
        format!("{x}")
    } else {
        format!("{x:e}")
    }
}

/// "a", "a or b", "a, b or c".
pub fn any_of<S: AsRef<str>>(words: &[S]) -> String {
    let words: Vec<&str> = words.iter().map(AsRef::as_ref).collect();
    match words.as_slice() {
        [] => String::new(),
        [one] => (*one).to_owned(),
        [most @ .., last] => format!("{} or {last}", most.join(", ")),
    }
}

/// A value on one line, cut where it is longer than about forty characters.
pub fn shorten(value: &str) -> String {
    const LONGEST: usize = 40;
    let mut line = String::new();
    let mut length = 0;
    // The value may be as long as a file, so no more of it is looked at than is shown.
    for word in value.split_whitespace() {
        let gap = (!line.is_empty()).then_some(' ');
        for c in gap.into_iter().chain(word.chars()) {
            if length == LONGEST {
                line.push('…');
                return line;
            }
            line.push(c);
            length += 1;
        }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_needs_some_likeness() {
        let names = ["range", "spacing", "damping"];
        assert_eq!(nearest("rnage", names), Some("range"));
        assert_eq!(nearest("Spacing", names), Some("spacing"));
        assert_eq!(nearest("damping_", names), Some("damping"));
        assert_eq!(nearest("velocity", names), None);
        assert_eq!(nearest("b", ["a"]), None);
    }

    #[test]
    fn numbers_read_well() {
        assert_eq!(number(60.0), "60");
        assert_eq!(number(0.1 + 0.2), "0.3");
        assert_eq!(number(-1e300), "-1e300");
        assert_eq!(number(1e-9), "1e-9");
        assert_eq!(number(10_000_000.0), "10000000");
    }

    #[test]
    fn long_values_are_cut_between_characters() {
        assert_eq!(shorten("[1,\n  2]"), "[1, 2]");
        assert_eq!(shorten(&"ä".repeat(40)), "ä".repeat(40));
        assert_eq!(shorten(&"ä".repeat(41)), format!("{}…", "ä".repeat(40)));
    }
}
