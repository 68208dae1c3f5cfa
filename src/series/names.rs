//! What runs are called beside one another.

use std::path::Path;

use super::{Run, SeriesError};

/// The shortest names that tell runs apart: by world, seed and dynamics where these differ, by
/// file where they do not tell all. A single run needs no name.
pub fn apart(runs: &[Run]) -> Vec<Option<String>> {
    if runs.len() < 2 {
        return vec![None; runs.len()];
    }
    let parts: [Vec<String>; 3] = [
        runs.iter().map(|it| it.header.name.clone()).collect(),
        runs.iter()
            .map(|it| format!("seed {}", it.header.world.seed))
            .collect(),
        runs.iter().map(|it| it.header.dynamics.clone()).collect(),
    ];
    let differ = parts
        .iter()
        .filter(|part| part.iter().any(|it| *it != part[0]));
    let differ: Vec<&Vec<String>> = differ.collect();
    let joined = (0..runs.len()).map(|k| {
        let own = differ.iter().map(|part| part[k].as_str());
        own.collect::<Vec<_>>().join(", ")
    });
    let stem = |it: &Run| {
        let name = Path::new(&it.name).file_name().unwrap_or_default();
        let name = name.to_string_lossy();
        name.split('.').next().unwrap_or_default().to_owned()
    };
    let choices: [Vec<String>; 3] = [
        joined.collect(),
        runs.iter().map(stem).collect(),
        runs.iter().map(|it| it.name.clone()).collect(),
    ];
    let distinct = |names: &&Vec<String>| {
        let others = |k: usize| names[..k].contains(&names[k]);
        !(0..names.len()).any(others) && names.iter().all(|it| !it.is_empty())
    };
    let names = choices.iter().find(distinct).unwrap_or(&choices[2]);
    names.iter().cloned().map(Some).collect()
}

/// The agents to draw: those asked for, or all.
///
/// # Errors
/// An agent that a trace, which messages call by its `name`, has not got, or no agents at all.
pub fn agents_of(
    name: &str,
    count: usize,
    asked: Option<&[usize]>,
) -> Result<Vec<usize>, SeriesError> {
    let name = || name.to_owned();
    let Some(last) = count.checked_sub(1) else {
        return Err(SeriesError::NoAgents { name: name() });
    };
    let Some(asked) = asked else {
        return Ok((0..count).collect());
    };
    match asked.iter().find(|&&agent| agent > last) {
        Some(&agent) => Err(SeriesError::NoAgent {
            name: name(),
            agent,
            last,
        }),
        None => Ok(asked.to_vec()),
    }
}
