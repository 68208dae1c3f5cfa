//! Where in a file's text a path's name and value stand.

use std::collections::HashMap;
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

/// A parsed file, to look many paths up in.
pub struct Spots<'a> {
    root: &'a Value<'a>,
    /// The fields of the objects that were looked into, by name. An object is told by where it
    /// begins, for none begins where another does.
    fields: HashMap<usize, HashMap<&'a str, &'a ObjectProp<'a>>>,
}

impl<'a> Spots<'a> {
    /// Of a parsed file.
    pub fn new(root: &'a Value<'a>) -> Self {
        Self {
            root,
            fields: HashMap::new(),
        }
    }

    /// The spot of a path.
    pub fn find(&mut self, path: &Path) -> Spot {
        let mut spot = Spot {
            name: None,
            value: bytes(self.root),
            whole: true,
        };
        let mut value = self.root;
        for step in &path.0 {
            let next = match (step, value) {
                (Step::Field(name), Value::Object(object)) => {
                    let fields = self.fields.entry(bytes(object).start).or_insert_with(|| {
                        let fields = object.properties.iter();
                        // The last of two fields with one name is the one that counts.
                        fields.map(|field| (field.name.as_str(), field)).collect()
                    });
                    fields.get(name.as_str()).map(|field| {
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
}

/// The places in a text where lines begin, to tell the lines of many bytes.
pub struct Lines<'a> {
    text: &'a str,
    starts: Vec<usize>,
}

impl<'a> Lines<'a> {
    /// Of a text.
    pub fn new(text: &'a str) -> Self {
        let newlines = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        Self {
            text,
            starts: std::iter::once(0)
                .chain(newlines.map(|(at, _)| at + 1))
                .collect(),
        }
    }

    /// Line and column of a byte, both counted from 1, columns in characters.
    pub fn place(&self, byte: usize) -> (usize, usize) {
        let byte = self.text.floor_char_boundary(byte);
        let line = self.starts.partition_point(|&start| start <= byte);
        let start = self.starts[line - 1];
        (line, self.text[start..byte].chars().count() + 1)
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "{\n  \"é\": 1, \"Größe\": [10,\n    {\"b\": \"ü\"}]\n}\n";

    fn spot(path: &str) -> Spot {
        let parsed = jsonc_parser::parse_to_ast(TEXT, &Default::default(), &Default::default());
        let root = parsed.unwrap().value.unwrap();
        Spots::new(&root).find(&path.parse().unwrap())
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
        let column = |text: &str| Lines::new(TEXT).place(TEXT.find(text).unwrap());
        assert_eq!(column("{"), (1, 1));
        assert_eq!(column("1,"), (2, 8));
        assert_eq!(column("10,"), (2, 21));
        assert_eq!(column("\"ü\""), (3, 11));
        assert_eq!(Lines::new(TEXT).place(TEXT.len()), (5, 1));
        // In the middle of a character, and past the end.
        assert_eq!(Lines::new("é").place(1), (1, 1));
        assert_eq!(Lines::new("é").place(9), (1, 2));
    }
}
