//! Reading JSON strictly: what is no JSON, what is named twice, what is no number.
//!
//! The parser that knows where things stand finds the problems; `serde_json`,
//! which is quicker and stricter, has the last word and makes the value.

use std::collections::HashMap;
use std::ops::Range;

use jsonc_parser::ast;
use jsonc_parser::errors::{ParseError, ParseErrorKind};
use jsonc_parser::{ParseOptions, ParseStringErrorKind, parse_to_ast};
use serde_json::Value;

use super::limits::{MOST_BYTES, MOST_PROBLEMS, MOST_VALUES};
use super::path::{Path, Step};
use super::problem::Problem;
use super::span::{Lines, bytes, name_of};
use super::strict;
use super::words::did_you_mean;

/// A problem and the bytes that it is about.
pub type Found = (Problem, Range<usize>);

/// JSON and nothing else: no comments, no trailing commas, no loose names.
const STRICT: ParseOptions = ParseOptions {
    allow_comments: false,
    allow_loose_object_property_names: false,
    allow_trailing_commas: false,
    allow_missing_commas: false,
    allow_single_quoted_strings: false,
    allow_hexadecimal_numbers: false,
    allow_unary_plus_numbers: false,
    allow_bare_decimal_point_numbers: false,
    allow_non_finite_numbers: false,
    allow_extended_string_escapes: false,
};

/// The value of a JSON text, or everything that keeps it from having one.
pub fn value(text: &str) -> Result<Value, Vec<Found>> {
    size(text).map_err(|found| vec![found])?;
    // What is sound needs no parser that knows where things stand, which takes far more memory.
    if let Ok(sound) = strict::value(text) {
        return Ok(sound);
    }
    let root = tree(text).map_err(|found| vec![found])?;
    let mut found = Vec::new();
    look(&root, &Lines::new(text), &mut Path::default(), &mut found);
    if !found.is_empty() {
        return Err(found);
    }
    serde_json::from_str(text).map_err(|error| vec![last_word(text, &error)])
}

/// Refuses a text that holds too much.
fn size(text: &str) -> Result<(), Found> {
    let too_large = |what: String, most: String| {
        let problem = Problem::new("", what).allowed(format!("at most {most}"));
        Err((problem, 0..0))
    };
    if text.len() > MOST_BYTES {
        return too_large(
            format!("the file is {} bytes long", text.len()),
            format!("{MOST_BYTES} (256 MiB)"),
        );
    }
    // Each begins at the start, behind an opening bracket or behind a comma.
    let (mut values, mut in_text, mut escaped) = (1, false, false);
    for byte in text.bytes() {
        match byte {
            _ if escaped => escaped = false,
            b'\\' if in_text => escaped = true,
            b'"' => in_text = !in_text,
            b',' | b'[' | b'{' if !in_text => values += 1,
            _ => {}
        }
    }
    if values > MOST_VALUES {
        return too_large(
            format!("the file holds {values} values: numbers, texts, lists and objects"),
            MOST_VALUES.to_string(),
        );
    }
    Ok(())
}

/// The parsed text, whose parts know where they stand.
pub fn tree(text: &str) -> Result<ast::Value<'_>, Found> {
    let whole_file = |what: &str| (Problem::new("", what), 0..0);
    if text.starts_with('\u{feff}') {
        let what = "the file begins with a byte order mark; save it as plain UTF-8";
        return Err(whole_file(what));
    }
    match parse_to_ast(text, &Default::default(), &STRICT) {
        Ok(parsed) => parsed.value.ok_or_else(|| whole_file("the file is empty")),
        Err(error) => Err(syntax_error(text, &error)),
    }
}

/// Collects names given twice and numbers too large for a double.
fn look(value: &ast::Value, lines: &Lines, path: &mut Path, found: &mut Vec<Found>) {
    if found.len() >= MOST_PROBLEMS {
        return;
    }
    match value {
        ast::Value::Object(object) => {
            let mut first = HashMap::new();
            for field in &object.properties {
                path.0.push(Step::Field(field.name.as_str().to_owned()));
                let at = name_of(field);
                if let Some(earlier) = first.insert(field.name.as_str(), at.start) {
                    let (line, _) = lines.place(earlier);
                    let what = format!("is given twice, first on line {line}");
                    found.push((Problem::with_name(path.to_string(), what), at));
                }
                look(&field.value, lines, path, found);
                path.0.pop();
            }
        }
        ast::Value::Array(array) => {
            for (index, entry) in array.elements.iter().enumerate() {
                path.0.push(Step::Entry(index));
                look(entry, lines, path, found);
                path.0.pop();
            }
        }
        ast::Value::NumberLit(number) if number.value.parse().is_ok_and(f64::is_infinite) => {
            let problem = Problem::new(path.to_string(), "is too large for a number")
                .allowed("-1.79e308 to 1.79e308");
            found.push((problem, bytes(number)));
        }
        _ => {}
    }
}

const NO_NUMBERS: &str = "infinity and NaN are no numbers in JSON";

fn syntax_error(text: &str, error: &ParseError) -> Found {
    use ParseErrorKind::*;
    let at = bytes(&error.range());
    let written = word(text, at.start);
    let after_zero = text
        .get(..at.start)
        .is_some_and(|before| before.ends_with('0'));
    let digit = |c: char| c.is_ascii_digit();
    let mut hint = None;
    let what = match error.kind() {
        CommentsNotAllowed => {
            hint = Some("remarks have a place in `notes`".to_owned());
            "JSON has no comments".to_owned()
        }
        TrailingCommasNotAllowed => "a comma must not stand before a closing bracket".into(),
        ExpectedComma if after_zero && written.starts_with(digit) => {
            "a number must not begin with 0".into()
        }
        ExpectedComma => "a comma is missing here".into(),
        ExpectedColonAfterObjectKey => "a colon must follow the name of a field".into(),
        ExpectedObjectValue => "a value must follow the colon".into(),
        ExpectedStringObjectProperty => "the name of a field must stand in double quotes".into(),
        SingleQuotedStringsNotAllowed => {
            "text must stand in double quotes, not in single ones".into()
        }
        MultipleRootJsonValues => "nothing may follow the end of the world".into(),
        UnterminatedObject => "this `{` is never closed".into(),
        UnterminatedArray => "this `[` is never closed".into(),
        String(ParseStringErrorKind::UnterminatedStringLiteral) => {
            "this text has no closing double quote".into()
        }
        String(_) => "this text has an escape that JSON does not know".into(),
        NonFiniteNumbersNotAllowed => NO_NUMBERS.into(),
        HexadecimalNumbersNotAllowed => "numbers must be decimal".into(),
        UnaryPlusNumbersNotAllowed => "a number must not begin with a plus sign".into(),
        BareDecimalPointNumbersNotAllowed => {
            "a number must have digits on both sides of its point".into()
        }
        ExpectedDigit
        | ExpectedDigitFollowingNegativeSign
        | ExpectedPlusMinusOrDigitInNumberLiteral => "this number is incomplete".into(),
        UnexpectedWord => {
            hint = did_you_mean(written, ["true", "false", "null"]);
            format!("`{written}` means nothing in JSON; text must stand in double quotes")
        }
        NestingDepthExceeded => "brackets are nested too deeply".into(),
        _ if ["NaN", "Infinity"].contains(&written) => NO_NUMBERS.into(),
        _ if written.is_empty() => "the file ends too early".into(),
        _ => format!("`{written}` must not stand here"),
    };
    let at = match error.kind() {
        // The range is the whole rest of the file; its bracket says enough.
        UnterminatedObject | UnterminatedArray | NestingDepthExceeded => at.start..at.start + 1,
        _ => at,
    };
    let problem = Problem {
        hint,
        ..Problem::new("", what)
    };
    (problem, at)
}

/// The word that begins at a byte, or the one character there that begins none.
fn word(text: &str, start: usize) -> &str {
    let rest = text.get(start..).unwrap_or_default();
    let first = rest.chars().next().map_or(0, char::len_utf8);
    let end = rest
        .find(|c: char| !c.is_alphanumeric())
        .unwrap_or(rest.len());
    &rest[..end.max(first)]
}

/// What `serde_json` refuses although the other parser took it.
fn last_word(text: &str, error: &serde_json::Error) -> Found {
    let line_start: usize = text
        .split_inclusive('\n')
        .take(error.line().saturating_sub(1))
        .map(str::len)
        .sum();
    let at = text.floor_char_boundary((line_start + error.column()).saturating_sub(1));
    let message = error.to_string();
    let message = message.split(" at line ").next().unwrap_or_default();
    let what = match message {
        "recursion limit exceeded" => "brackets are nested too deeply".to_owned(),
        other if other.starts_with("control character") => {
            "text must not hold line ends, tabs or other control characters; write them as \\n, \\t"
                .into()
        }
        other => format!("this is not JSON: {other}"),
    };
    (Problem::new("", what), at..at)
}
