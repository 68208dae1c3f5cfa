//! Places in a record, by path.

use serde_json::Value;

/// What a path such as `laws[0].position_error` leads to.
pub(super) fn lookup<'a>(tree: &'a Value, path: &str) -> Option<&'a Value> {
    let path = path.replace('[', ".").replace(']', "");
    path.split('.').try_fold(tree, |value, step| match value {
        Value::Array(entries) => entries.get(step.parse::<usize>().ok()?),
        _ => value.get(step),
    })
}

/// A number, a truth as 1 or 0; nothing for what is none, such as null.
pub(super) fn number(value: &Value) -> Option<f64> {
    match value {
        Value::Bool(truth) => Some(f64::from(u8::from(*truth))),
        _ => value.as_f64().filter(|it| it.is_finite()),
    }
}

/// Calls `found` with the path and the value of every number, truth and null in a tree.
pub(super) fn each_leaf(tree: &Value, path: &str, found: &mut impl FnMut(&str, &Value)) {
    match tree {
        Value::Object(fields) => {
            for (name, value) in fields {
                let path = match path {
                    "" => name.clone(),
                    _ => format!("{path}.{name}"),
                };
                each_leaf(value, &path, found);
            }
        }
        Value::Array(entries) => {
            for (place, value) in entries.iter().enumerate() {
                each_leaf(value, &format!("{path}[{place}]"), found);
            }
        }
        Value::String(_) => {}
        leaf => found(path, leaf),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn every_leaf_is_found_by_its_path() {
        let tree = json!({
            "metrics": { "density": 0.5, "edges": null },
            "laws": { "mean": [1.0, 2.0], "laws": [{ "law": "tracking", "error": 3 }] },
            "rigid": true
        });
        let mut leaves = Vec::new();
        each_leaf(&tree, "", &mut |path, value| {
            assert_eq!(lookup(&tree, path), Some(value));
            leaves.push((path.to_owned(), number(value)));
        });
        let leaves: Vec<_> = leaves
            .iter()
            .map(|(path, it)| (path.as_str(), *it))
            .collect();
        assert_eq!(
            leaves,
            [
                ("laws.laws[0].error", Some(3.0)),
                ("laws.mean[0]", Some(1.0)),
                ("laws.mean[1]", Some(2.0)),
                ("metrics.density", Some(0.5)),
                ("metrics.edges", None),
                ("rigid", Some(1.0)),
            ]
        );
        for nowhere in [
            "density",
            "laws.laws[1].error",
            "laws.mean[-1]",
            "rigid.x",
            "",
        ] {
            assert_eq!(lookup(&tree, nowhere), None, "{nowhere}");
        }
    }
}
