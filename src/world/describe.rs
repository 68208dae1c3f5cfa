//! What the schema of world files allows somewhere, in plain words.

use std::sync::LazyLock;

use schemars::schema_for;
use serde_json::Value;

use super::spec::WorldSpec;
use super::words::{any_of, number};

/// The schema of world files.
pub static SCHEMA: LazyLock<Value> = LazyLock::new(|| schema_for!(WorldSpec).to_value());

/// The part of the schema at a JSON pointer; null where there is none.
pub fn part(pointer: &str) -> &'static Value {
    SCHEMA.pointer(pointer).unwrap_or(&Value::Null)
}

/// The schema itself, or the one that it refers to.
pub fn resolve(schema: &'static Value) -> &'static Value {
    match schema["$ref"].as_str() {
        Some(reference) => resolve(part(reference.trim_start_matches('#'))),
        None => schema,
    }
}

/// The alternatives of a schema, each one resolved.
pub fn alternatives(schema: &'static Value) -> Vec<&'static Value> {
    let schema = resolve(schema);
    let list = schema["oneOf"].as_array().or(schema["anyOf"].as_array());
    list.into_iter().flatten().map(resolve).collect()
}

/// The types that a schema without alternatives names.
fn types(schema: &'static Value) -> Vec<&'static str> {
    match &schema["type"] {
        Value::String(one) => vec![one],
        Value::Array(several) => several.iter().filter_map(Value::as_str).collect(),
        _ => Vec::new(),
    }
}

/// Whether a value is of the type that a schema asks for, whatever it holds.
pub fn fits(schema: &'static Value, value: &Value) -> bool {
    let schema = resolve(schema);
    let alternatives = alternatives(schema);
    if !alternatives.is_empty() {
        return alternatives.iter().any(|one| fits(one, value));
    }
    types(schema).into_iter().any(|name| match name {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "number" | "integer" => value.is_number(),
        "string" => value.is_string(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        _ => false,
    })
}

/// What a schema asks for: "a number or a list of numbers".
pub fn form(schema: &'static Value) -> String {
    let mut forms = Vec::new();
    collect_forms(resolve(schema), &mut forms);
    any_of(&forms)
}

fn collect_forms(schema: &'static Value, forms: &mut Vec<String>) {
    for one in alternatives(schema) {
        collect_forms(one, forms);
    }
    for name in types(schema) {
        let form = match (name, &schema["const"]) {
            // That a field may be null is no help to anyone.
            ("null", _) => continue,
            (_, Value::String(constant)) => format!("\"{constant}\""),
            ("number", _) => "a number".into(),
            ("integer", _) => "a whole number".into(),
            ("string", _) => "a string".into(),
            ("boolean", _) => "true or false".into(),
            ("array", _) => match plural(&schema["items"]) {
                Some(entries) => format!("a list of {entries}"),
                None => "a list".into(),
            },
            (other, _) => format!("an {other}"),
        };
        if !forms.contains(&form) {
            forms.push(form);
        }
    }
}

fn plural(schema: &'static Value) -> Option<String> {
    match resolve(schema)["type"].as_str()? {
        "number" => Some("numbers".into()),
        "string" => Some("strings".into()),
        "object" => Some("objects".into()),
        "array" => Some(format!("lists of {}", plural(&schema["items"])?)),
        _ => None,
    }
}

/// The names of an object's fields; those for editors, such as `$schema`, left out.
pub fn fields(schema: &'static Value) -> Vec<&'static str> {
    let fields = schema["properties"].as_object();
    let names = fields.into_iter().flat_map(|fields| fields.keys());
    names
        .map(String::as_str)
        .filter(|name| !name.starts_with('$'))
        .collect()
}

/// What an alternative of a choice is called: its text, or its only field.
pub fn name(alternative: &'static Value) -> Option<&'static str> {
    match alternative["const"].as_str() {
        Some(text) => Some(text),
        None => fields(alternative).first().copied(),
    }
}

/// The range of a number: "greater than 0", "0 to 1", "2 or 3".
pub fn range(schema: &Value) -> String {
    let limit = |keyword: &str| schema[keyword].as_f64();
    let words = |before: &str, x: f64| format!("{before} {}", number(x));
    let whole = schema["type"] == "integer";
    let least = limit("minimum").map(|x| words("at least", x));
    let most = limit("maximum").map(|x| words("at most", x));
    let above = limit("exclusiveMinimum").map(|x| words("greater than", x));
    let below = limit("exclusiveMaximum").map(|x| words("less than", x));
    match (limit("minimum"), limit("maximum")) {
        (Some(low), Some(high)) if whole && high == low + 1.0 => {
            format!("{} or {}", number(low), number(high))
        }
        (Some(low), Some(high)) => format!("{} to {}", number(low), number(high)),
        _ => {
            let ends: Vec<String> = above.or(least).into_iter().chain(below.or(most)).collect();
            ends.join(" and ")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn says_ranges_in_words() {
        let limit =
            |def: &str, field: &str| range(part(&format!("/$defs/{def}/properties/{field}")));
        assert_eq!(limit("AlphaInteraction", "range"), "greater than 0");
        assert_eq!(
            limit("AlphaInteraction", "bump_start"),
            "greater than 0 and less than 1"
        );
        assert_eq!(limit("Gamma", "offset"), "greater than 0 and at most 1");
        assert_eq!(limit("Physics", "restitution"), "0 to 1");
        assert_eq!(limit("Physics", "friction"), "at least 0");
        assert_eq!(range(part("/properties/dimension")), "2 or 3");
    }

    #[test]
    fn says_forms_in_words() {
        assert_eq!(
            form(part("/$defs/PerAgent")),
            "a number or a list of numbers"
        );
        assert_eq!(
            form(part("/$defs/Obstacle/properties/rotation")),
            "a number or a list of numbers"
        );
        assert_eq!(form(part("/$defs/Velocities")), "\"rest\" or an object");
        assert_eq!(
            form(part("/$defs/Positions/oneOf/0/properties/explicit")),
            "a list of lists of numbers"
        );
        assert_eq!(form(part("/properties/notes")), "a list of strings");
        assert_eq!(form(part("/properties/dimension")), "a whole number");
    }
}
