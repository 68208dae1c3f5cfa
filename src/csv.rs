//! Tables as text, in CSV (RFC 4180, with line feeds).

use std::borrow::Cow;
use std::io::Write;

use serde_json::Value;

/// What stands in one cell.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Cell<'a> {
    /// Nothing.
    Empty,
    /// A finite number, in the fewest digits that read back bit for bit; always with a point
    /// or an exponent, so that nobody takes its column for one of whole numbers.
    Number(f64),
    Count(u64),
    Truth(bool),
    /// Quoted only where it must be.
    Text(Cow<'a, str>),
}

impl From<f64> for Cell<'_> {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<u64> for Cell<'_> {
    fn from(count: u64) -> Self {
        Self::Count(count)
    }
}

impl From<usize> for Cell<'_> {
    fn from(count: usize) -> Self {
        Self::Count(count as u64)
    }
}

impl<'a> From<&'a str> for Cell<'a> {
    fn from(text: &'a str) -> Self {
        Self::Text(text.into())
    }
}

/// JSON, as it stands in a record; lists and objects as their text.
impl From<&Value> for Cell<'_> {
    fn from(value: &Value) -> Self {
        match value {
            Value::Null => Self::Empty,
            Value::Bool(truth) => Self::Truth(*truth),
            Value::Number(number) => match (number.as_u64(), number.as_f64()) {
                (Some(count), _) => Self::Count(count),
                (None, Some(number)) => Self::Number(number),
                (None, None) => Self::Text(number.to_string().into()),
            },
            Value::String(text) => Self::Text(text.clone().into()),
            Value::Array(_) | Value::Object(_) => Self::Text(value.to_string().into()),
        }
    }
}

/// Adds one line to a table.
pub(crate) fn write_row<'a>(table: &mut Vec<u8>, cells: impl IntoIterator<Item = Cell<'a>>) {
    for (place, cell) in cells.into_iter().enumerate() {
        if place > 0 {
            table.push(b',');
        }
        match cell {
            Cell::Empty => {}
            Cell::Number(number) => write_number(table, number),
            Cell::Count(count) => write(table, count),
            Cell::Truth(truth) => write(table, truth),
            Cell::Text(text) => match text.contains([',', '"', '\n', '\r']) {
                true => write(table, format_args!("\"{}\"", text.replace('"', "\"\""))),
                false => table.extend_from_slice(text.as_bytes()),
            },
        }
    }
    table.push(b'\n');
}

/// Writes a finite number as JSON and so as a trace has it.
pub(crate) fn write_number(text: &mut Vec<u8>, number: f64) {
    debug_assert!(number.is_finite(), "{number}");
    serde_json::to_writer(text, &number).expect("memory takes all that is written to it");
}

fn write(text: &mut Vec<u8>, what: impl std::fmt::Display) {
    write!(text, "{what}").expect("memory takes all that is written to it");
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use serde_json::json;

    use super::*;

    fn row<'a>(cells: impl IntoIterator<Item = Cell<'a>>) -> String {
        let mut table = Vec::new();
        write_row(&mut table, cells);
        String::from_utf8(table).unwrap()
    }

    #[test]
    fn cells_look_like_what_they_are() {
        let cells = [
            Cell::Empty,
            2.0.into(),
            (-0.0).into(),
            1e300.into(),
            5e-324.into(),
            7_u64.into(),
            Cell::Truth(true),
            "a b".into(),
            "a,\"b\"\n".into(),
        ];
        let expected = ",2.0,-0.0,1e+300,5e-324,7,true,a b,\"a,\"\"b\"\"\n\"\n";
        assert_eq!(row(cells), expected);
        assert_eq!(row([]), "\n");
    }

    #[test]
    fn json_keeps_whole_numbers_and_others_apart() {
        let values = [json!(null), json!(3), json!(3.0), json!(false), json!("x")];
        assert_eq!(row(values.iter().map(Cell::from)), ",3,3.0,false,x\n");
        assert_eq!(
            row([Cell::from(&json!(u64::MAX))]),
            format!("{}\n", u64::MAX)
        );
    }

    proptest! {
        #[test]
        fn numbers_read_back(bits: u64) {
            let number = f64::from_bits(bits);
            prop_assume!(number.is_finite());
            let text = row([Cell::Number(number)]);
            prop_assert_eq!(text.trim().parse::<f64>().unwrap().to_bits(), bits);
            prop_assert!(text.contains(['.', 'e']), "{}", text);
        }
    }
}
