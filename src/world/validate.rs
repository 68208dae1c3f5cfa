//! Checking a JSON value against the schema of world files, in plain words.

use std::sync::LazyLock;

use jsonschema::error::ValidationErrorKind as Kind;
use jsonschema::paths::LocationSegment;
use jsonschema::{ValidationError, Validator};
use serde_json::Value;

use super::check::LARGEST;
use super::describe::{SCHEMA, alternatives, fields, fits, form, name, part, range};
use super::path::{Path, Step};
use super::problem::Problem;
use super::set::kind;
use super::words::{did_you_mean, nearest};

static VALIDATOR: LazyLock<Validator> = LazyLock::new(|| {
    jsonschema::validator_for(&SCHEMA).expect("the schema is made from our own types")
});

/// Everything in which a value departs from the schema of world files.
pub fn problems(world: &Value) -> Vec<Problem> {
    let mut problems = Vec::new();
    for error in VALIDATOR.iter_errors(world) {
        explain(&error, &mut problems);
    }
    let mut large = Vec::new();
    too_large(world, String::new(), &mut large);
    large.retain(|new| problems.iter().all(|known| known.path != new.path));
    problems.extend(large);
    problems
}

/// Numbers of fields whose squares and products would not stay finite. Those in lists are
/// looked at where it is known what the lists are.
fn too_large(value: &Value, path: String, problems: &mut Vec<Problem>) {
    match value {
        Value::Object(fields) => {
            for (name, field) in fields {
                let path = match path.is_empty() {
                    true => name.clone(),
                    false => format!("{path}.{name}"),
                };
                if field.as_f64().is_some_and(|x| x.abs() > LARGEST) {
                    let problem = Problem::new(path, "is too large to compute with");
                    problems.push(problem.allowed("-1e100 to 1e100"));
                } else {
                    too_large(field, path, problems);
                }
            }
        }
        Value::Array(items) => {
            for (index, item) in items.iter().enumerate() {
                too_large(item, format!("{path}[{index}]"), problems);
            }
        }
        _ => {}
    }
}

/// Adds what one error of the validator means.
fn explain(error: &ValidationError, problems: &mut Vec<Problem>) {
    let path = path_of(error);
    let here = path.to_string();
    let value: &Value = error.instance();
    // The error names a keyword, `…/range/exclusiveMinimum`; its owner says more.
    let keyword = error.schema_path().as_str();
    let schema = part(keyword.rsplit_once('/').map_or("", |(owner, _)| owner));
    match error.kind() {
        Kind::Type { .. } => problems.push(wrong_form(&path, schema, value)),
        Kind::Minimum { .. }
        | Kind::Maximum { .. }
        | Kind::ExclusiveMinimum { .. }
        | Kind::ExclusiveMaximum { .. } => {
            let range = range(schema);
            let from = if range.contains(" to ") { "from " } else { "" };
            problems.push(Problem::new(here, format!("must be {from}{range}")).allowed(range));
        }
        Kind::MinItems { limit: 1 } => {
            problems.push(Problem::new(here, "must have at least one entry"));
        }
        Kind::Required { property } => {
            let name = property.as_str().unwrap_or_default();
            if !is_misspelt(name, value, &fields(schema)) {
                problems.push(Problem::new(here, format!("missing field `{name}`")));
            }
        }
        Kind::AdditionalProperties { unexpected } => {
            let known = fields(schema);
            problems.extend(unexpected.iter().map(|name| {
                let problem = Problem::with_name(path.field(name).to_string(), "unknown field");
                one_of_names(problem, name, &known)
            }));
        }
        Kind::AnyOf { context } => {
            let fitting = alternatives(schema).iter().position(|one| fits(one, value));
            match fitting.and_then(|index| context.get(index)) {
                Some(errors) => errors.iter().for_each(|error| explain(error, problems)),
                None => problems.push(wrong_form(&path, schema, value)),
            }
        }
        Kind::OneOfNotValid { context } => match choose(&path, schema, value) {
            Ok(chosen) => context
                .get(chosen)
                .into_iter()
                .flatten()
                .for_each(|error| explain(error, problems)),
            Err(problem) => problems.push(problem),
        },
        _ => problems.push(Problem::new(here, error.to_string())),
    }
}

/// Which alternative of a choice a value means: the one that its only field
/// names. Otherwise, what is wrong with the choice itself.
fn choose(path: &Path, schema: &'static Value, value: &Value) -> Result<usize, Problem> {
    let alternatives = alternatives(schema);
    let known: Vec<&str> = alternatives.iter().filter_map(|one| name(one)).collect();
    let noun = noun(path);
    let here = path.to_string();
    match value {
        Value::Object(object) if object.len() == 1 => {
            let chosen = object.keys().next().map_or("", String::as_str);
            let index = alternatives
                .iter()
                .position(|one| name(one) == Some(chosen));
            match index {
                Some(index) if alternatives[index]["const"].is_null() => Ok(index),
                Some(_) => Err(Problem::new(
                    here,
                    format!("must be just \"{chosen}\", without fields"),
                )),
                None => {
                    let at = path.field(chosen).to_string();
                    let problem = Problem::with_name(at, format!("unknown {noun}"));
                    Err(one_of_names(problem, chosen, &known))
                }
            }
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

fn path_of(error: &ValidationError) -> Path {
    let steps = error.instance_path().iter();
    Path(
        steps
            .map(|step| match step {
                LocationSegment::Property(name) => Step::Field(name.into_owned()),
                LocationSegment::Index(index) => Step::Entry(index),
            })
            .collect(),
    )
}
