//! Where in a file's text a path's name and value stand.

use std::ops::Range;

use jsonc_parser::ast::{ObjectProp, Value};
use jsonc_parser::common::Ranged;

use super::path::{Path, Step};

/// Where a path leads, as far as the file goes along.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Spot {
    /// The name of the field; that of the list for an entry of one.
    pub name: Option<Range<usize>>,
    /// The value.
    pub value: Range<usize>,
    /// Whether the file has the whole path, rather than a part of it.
    pub whole: bool,
}

/// The spot of a path in a parsed file.
pub fn find(root: &Value, path: &Path) -> Spot {
    let mut spot = Spot {
        name: None,
        value: bytes(root),
        whole: true,
    };
    let mut value = root;
    for step in &path.0 {
        let next = match (step, value) {
            (Step::Field(name), Value::Object(object)) => {
                // The last of two fields with one name is the one that counts.
                let found = object
                    .properties
                    .iter()
                    .rev()
                    .find(|field| field.name.as_str() == name);
                found.map(|field| {
                    spot.name = Some(name_of(field));
                    &field.value
                })
            }
            (Step::Entry(index), Value::Array(array)) => array.elements.get(*index),
            _ => None,
        };
        let Some(next) = next else {
            spot.whole = false;
            break;
        };
        value = next;
        spot.value = bytes(value);
    }
    spot
}

/// The bytes of a field's name, quotes included.
pub fn name_of(field: &ObjectProp) -> Range<usize> {
    let range = field.name.range();
    range.start..range.end
}

/// The bytes of a part of the parsed file.
pub fn bytes(part: &impl Ranged) -> Range<usize> {
    let range = part.range();
    range.start..range.end
}

/// Line and column of a byte, both counted from 1, columns in characters.
pub fn line_and_column(text: &str, byte: usize) -> (usize, usize) {
    let before = &text[..text.floor_char_boundary(byte)];
    let start = before.rfind('\n').map_or(0, |newline| newline + 1);
    let line = before.bytes().filter(|&b| b == b'\n').count() + 1;
    (line, before[start..].chars().count() + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "{\n  \"é\": 1, \"Größe\": [10,\n    {\"b\": \"ü\"}]\n}\n";

    fn spot(path: &str) -> Spot {
        let parsed = jsonc_parser::parse_to_ast(TEXT, &Default::default(), &Default::default());
        find(&parsed.unwrap().value.unwrap(), &path.parse().unwrap())
    }

    #[test]
    fn finds_names_and_values() {
        let at = spot("Größe[1].b");
        assert_eq!(&TEXT[at.value], "\"ü\"");
        assert_eq!(&TEXT[at.name.unwrap()], "\"b\"");
        assert!(at.whole);
        assert_eq!(spot("").value.start, 0);
    }

    #[test]
    fn goes_as_far_as_the_file() {
        let at = spot("Größe[1].c.d[0]");
        assert_eq!(&TEXT[at.value.clone()], "{\"b\": \"ü\"}");
        assert!(!at.whole);
        assert!(!spot("Größe[2]").whole);
        assert!(!spot("é.x").whole);
    }

    #[test]
    fn counts_characters_not_bytes() {
        let column = |text: &str| line_and_column(TEXT, TEXT.find(text).unwrap());
        assert_eq!(column("{"), (1, 1));
        assert_eq!(column("1,"), (2, 8));
        assert_eq!(column("10,"), (2, 21));
        assert_eq!(column("\"ü\""), (3, 11));
        assert_eq!(line_and_column(TEXT, TEXT.len()), (5, 1));
        // In the middle of a character, and past the end.
        assert_eq!(line_and_column("é", 1), (1, 1));
        assert_eq!(line_and_column("é", 9), (1, 2));
    }
}
