//! Checking a JSON value against the schema of world files, in plain words.
//!
//! The schema is made from our own types, so only what these use is understood. The value is
//! gone through once: which alternative of a choice is meant is told by its name or its kind,
//! never by trying all of them, so the work grows with the value and nothing else.

use serde_json::{Number, Value};

use super::check::LARGEST;
use super::describe::{SCHEMA, alternatives, fields, fits, form, name, range, resolve};
use super::limits::MOST_PROBLEMS;
use super::path::{Path, Step};
use super::problem::Problem;
use super::set::kind;
use super::words::{did_you_mean, nearest};

/// Everything in which a value departs from the schema of world files; of very much, the first
/// part.
pub fn problems(world: &Value) -> Vec<Problem> {
    let mut walk = Walk::default();
    walk.look(&Trail::World, &SCHEMA, world);
    walk.problems
}

/// The way to a value, made into a path only where something is wrong with it.
#[derive(Clone, Copy)]
enum Trail<'a> {
    World,
    Field(&'a Trail<'a>, &'a str),
    Entry(&'a Trail<'a>, usize),
}

impl Trail<'_> {
    fn path(&self) -> Path {
        match self {
            Self::World => Path::default(),
            Self::Field(outer, name) => outer.path().field(name),
            Self::Entry(outer, index) => {
                let mut path = outer.path();
                path.0.push(Step::Entry(*index));
                path
            }
        }
    }
}

/// What was found so far.
#[derive(Default)]
struct Walk {
    problems: Vec<Problem>,
}

impl Walk {
    fn is_full(&self) -> bool {
        self.problems.len() >= MOST_PROBLEMS
    }

    /// Adds in what a value departs from a schema.
    fn look(&mut self, trail: &Trail, schema: &'static Value, value: &Value) {
        let schema = resolve(schema);
        if schema["oneOf"].is_array() {
            return self.one_of(trail, schema, value);
        }
        if schema["anyOf"].is_array() {
            return self.any_of(trail, schema, value);
        }
        if !is_of_type(schema, value) {
            self.problems.push(wrong_form(&trail.path(), schema, value));
            return;
        }
        match value {
            Value::Number(number) => self.number(trail, schema, number),
            Value::Array(items) => self.list(trail, schema, items),
            Value::Object(_) => self.object(trail, schema, value),
            _ => {}
        }
    }

    fn number(&mut self, trail: &Trail, schema: &'static Value, number: &Number) {
        if !within(schema, number) {
            let range = range(schema);
            let from = if range.contains(" to ") { "from " } else { "" };
            let problem = Problem::new(trail.path().to_string(), format!("must be {from}{range}"));
            self.problems.push(problem.allowed(range));
        } else if matches!(trail, Trail::Field(..))
            && number.as_f64().is_some_and(|x| x.abs() > LARGEST)
        {
            // Squares and products would not stay finite. Numbers in lists are looked at where
            // it is known what the lists are.
            let problem = Problem::new(trail.path().to_string(), "is too large to compute with");
            self.problems.push(problem.allowed("-1e100 to 1e100"));
        }
    }

    fn list(&mut self, trail: &Trail, schema: &'static Value, items: &[Value]) {
        let here = || trail.path().to_string();
        let limit = |keyword: &str| schema[keyword].as_u64();
        if limit("minItems").is_some_and(|least| (items.len() as u64) < least) {
            let problem = Problem::new(here(), "must have at least one entry");
            self.problems.push(problem);
        }
        if let Some(most) = limit("maxItems").filter(|&most| items.len() as u64 > most) {
            let what = format!("has {} entries", items.len());
            let problem = Problem::new(here(), what).allowed(format!("at most {most}"));
            // Entries beyond what is allowed at all are not worth a word each.
            return self.problems.push(problem);
        }
        let entries = &schema["items"];
        // Long lists are mostly of plain numbers.
        if entries.is_null() || (is_any_number(entries) && items.iter().all(Value::is_number)) {
            return;
        }
        for (index, item) in items.iter().enumerate() {
            if self.is_full() {
                return;
            }
            self.look(&Trail::Entry(trail, index), entries, item);
        }
    }

    fn object(&mut self, trail: &Trail, schema: &'static Value, value: &Value) {
        let (Some(object), properties) = (value.as_object(), &schema["properties"]) else {
            return;
        };
        let known = fields(schema);
        for (name, field) in object {
            if self.is_full() {
                return;
            }
            match properties.get(name) {
                Some(schema) => self.look(&Trail::Field(trail, name), schema, field),
                None => {
                    let path = trail.path().field(name).to_string();
                    let problem = Problem::with_name(path, "unknown field");
                    self.problems.push(one_of_names(problem, name, &known));
                }
            }
        }
        for name in schema["required"].as_array().into_iter().flatten() {
            let name = name.as_str().unwrap_or_default();
            if !object.contains_key(name) && !is_misspelt(name, value, &known) {
                let what = format!("missing field `{name}`");
                self.problems
                    .push(Problem::new(trail.path().to_string(), what));
            }
        }
    }

    fn any_of(&mut self, trail: &Trail, schema: &'static Value, value: &Value) {
        let alternatives = alternatives(schema);
        let mut fitting = alternatives.into_iter().filter(|one| fits(one, value));
        let Some(first) = fitting.next() else {
            let problem = wrong_form(&trail.path(), schema, value);
            return self.problems.push(problem);
        };
        let before = self.problems.len();
        self.look(trail, first, value);
        // Of several that are of the same kind, such as rows of numbers and lists of rows,
        // one that has nothing to complain of is meant, or else the first.
        let sound = |one: &'static Value| {
            let mut walk = Self::default();
            walk.look(trail, one, value);
            walk.problems.is_empty()
        };
        if self.problems.len() > before && fitting.any(sound) {
            self.problems.truncate(before);
        }
    }

    fn one_of(&mut self, trail: &Trail, schema: &'static Value, value: &Value) {
        let alternatives = alternatives(schema);
        if alternatives
            .iter()
            .any(|one| !one["const"].is_null() && one["const"] == *value)
        {
            return;
        }
        match choose(trail, schema, &alternatives, value) {
            Ok(chosen) => self.look(trail, chosen, value),
            Err(problem) => self.problems.push(problem),
        }
    }
}

/// Whether a value is of a type that a schema without alternatives names.
fn is_of_type(schema: &'static Value, value: &Value) -> bool {
    fits(schema, value)
        && match (&schema["type"], value) {
            (Value::String(one), Value::Number(number)) if one == "integer" => is_whole(number),
            (Value::Array(several), Value::Number(number)) => {
                several.iter().any(|one| one == "number") || is_whole(number)
            }
            _ => true,
        }
}

/// Whether a schema takes every number.
fn is_any_number(schema: &Value) -> bool {
    schema["type"] == "number"
        && ["minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum"]
            .iter()
            .all(|limit| schema[limit].is_null())
}

fn is_whole(number: &Number) -> bool {
    !number.is_f64() || number.as_f64().is_some_and(|x| x.fract() == 0.0)
}

/// Whether a number is within the limits of a schema.
fn within(schema: &'static Value, number: &Number) -> bool {
    let against = |keyword: &str| match &schema[keyword] {
        Value::Number(limit) => compare(number, limit),
        _ => None,
    };
    use std::cmp::Ordering::{Greater, Less};
    let above = |keyword| against(keyword).is_none_or(|it| it == Greater);
    let below = |keyword| against(keyword).is_none_or(|it| it == Less);
    above("exclusiveMinimum")
        && below("exclusiveMaximum")
        && against("minimum") != Some(Less)
        && against("maximum") != Some(Greater)
}

/// Compares two numbers: whole ones exactly, for doubles skip some of those above 2^53.
fn compare(a: &Number, b: &Number) -> Option<std::cmp::Ordering> {
    let whole = |number: &Number| -> Option<i128> {
        let small = |x: f64| (x.fract() == 0.0 && x.abs() < 1e37).then_some(x as i128);
        let signed = number.as_i64().map(i128::from);
        let whole = signed.or_else(|| number.as_u64().map(i128::from));
        whole.or_else(|| small(number.as_f64()?))
    };
    match (whole(a), whole(b)) {
        (Some(a), Some(b)) => Some(a.cmp(&b)),
        _ => a.as_f64()?.partial_cmp(&b.as_f64()?),
    }
}

/// Which alternative of a choice a value means: the one that its only field
/// names. Otherwise, what is wrong with the choice itself.
fn choose(
    trail: &Trail,
    schema: &'static Value,
    alternatives: &[&'static Value],
    value: &Value,
) -> Result<&'static Value, Problem> {
    let named = |chosen: &str| {
        let named = alternatives.iter().find(|one| name(one) == Some(chosen));
        named.copied()
    };
    if let Value::Object(object) = value
        && object.len() == 1
        && let Some(chosen) = object.keys().next().and_then(|chosen| named(chosen))
        && chosen["const"].is_null()
    {
        return Ok(chosen);
    }
    let path = &trail.path();
    let known: Vec<&str> = alternatives.iter().filter_map(|one| name(one)).collect();
    let noun = noun(path);
    let here = path.to_string();
    match value {
        Value::Object(object) if object.len() == 1 => {
            let chosen = object.keys().next().map_or("", String::as_str);
            Err(match named(chosen) {
                Some(_) => Problem::new(here, format!("must be just \"{chosen}\", without fields")),
                None => {
                    let at = path.field(chosen).to_string();
                    let problem = Problem::with_name(at, format!("unknown {noun}"));
                    one_of_names(problem, chosen, &known)
                }
            })
        }
        Value::Object(object) if object.is_empty() => {
            let problem = Problem::new(here, format!("must name a {noun}"));
            Err(problem.allowed(known.join(", ")))
        }
        Value::Object(object) => {
            let what = format!("must hold just one {noun}, not {}", object.len());
            let problem = Problem::new(here, what).allowed(known.join(", "));
            Err(match path.0.last() {
                Some(Step::Entry(_)) => problem.hint("give each an entry of its own"),
                _ => problem,
            })
        }
        Value::String(text) if known.contains(&text.as_str()) => Err(Problem::new(
            here,
            format!("must be an object: {{\"{text}\": …}}"),
        )),
        Value::String(text) => {
            let problem = Problem::new(here, format!("unknown {noun}"));
            Err(one_of_names(problem, text, &known))
        }
        _ => Err(wrong_form(path, schema, value).allowed(known.join(", "))),
    }
}

/// A value of the wrong type: what it must be, and what it is.
fn wrong_form(path: &Path, schema: &'static Value, value: &Value) -> Problem {
    let form = form(schema);
    let what = match kind(value) {
        // That 2.5 is a number is not news where a whole number is wanted.
        "a number" if form == "a whole number" => format!("must be {form}"),
        found => format!("must be {form}, not {found}"),
    };
    let problem = Problem::new(path.to_string(), what);
    match value.as_str() {
        Some(text) if form.contains("number") && text.trim().parse().is_ok_and(f64::is_finite) => {
            problem.hint("write it without quotes")
        }
        _ => problem,
    }
}

/// Whether an object has an unknown field that likely means this one. Then that
/// field is reported, and what it leaves missing is no second mistake.
fn is_misspelt(name: &str, object: &Value, known: &[&str]) -> bool {
    let fields = object.as_object();
    let mut unknown = fields
        .into_iter()
        .flat_map(|fields| fields.keys())
        .filter(|field| !known.contains(&field.as_str()));
    unknown.any(|field| nearest(field, known.iter().copied()) == Some(name))
}

/// The same problem with the known names, and the one that was likely meant.
fn one_of_names(problem: Problem, word: &str, known: &[&str]) -> Problem {
    Problem {
        hint: did_you_mean(word, known.iter().copied()),
        ..problem.allowed(known.join(", "))
    }
}

/// What a place holds, in one word: `laws[0]` holds a law.
fn noun(path: &Path) -> String {
    let field = path.last_field().unwrap_or("name");
    match (path.0.last(), field.strip_suffix('s')) {
        (Some(Step::Entry(_)), Some(singular)) => singular.to_owned(),
        (_, Some(_)) => format!("kind of {field}"),
        _ => field.to_owned(),
    }
}
