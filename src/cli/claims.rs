//! `volary claims`: what the papers claim, and how it is judged.

use clap::Args;
use serde_json::{Value, json};
use volary::claim::{About, abouts};
use volary::validate::form;
use volary::world::nearest_path;

use super::{Refusal, print};

/// Arguments of `volary claims`.
#[derive(Debug, Args)]
pub(super) struct ClaimsArguments {
    /// Print these in full: names of claims, or of papers for all of theirs
    #[arg(value_name = "NAME")]
    names: Vec<String>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// Lists all claims, or prints some in full.
pub(super) fn claims(arguments: &ClaimsArguments) -> Result<(), Refusal> {
    let all = abouts();
    let names = &arguments.names;
    for name in names {
        if !all.iter().any(|about| is_named(about, name)) {
            return Err(unknown(&all, name));
        }
    }
    let asked = |about: &&About| names.is_empty() || names.iter().any(|it| is_named(about, it));
    let chosen: Vec<&About> = all.into_iter().filter(asked).collect();
    if arguments.json {
        let claims: Value = chosen.iter().map(|about| object(about)).collect();
        print(&format!("{claims:#}\n"))
    } else if names.is_empty() {
        print(&form::list(&chosen))
    } else {
        let whole: Vec<_> = chosen.iter().map(|about| form::describe(about)).collect();
        print(&whole.join("\n"))
    }
}

/// Whether a name is that of the claim, or of its paper.
fn is_named(about: &About, name: &str) -> bool {
    about.name == name || about.name.split('/').next() == Some(name.trim_end_matches('/'))
}

fn unknown(all: &[&About], name: &str) -> Refusal {
    let papers = all.iter().filter_map(|about| about.name.split('/').next());
    let names: Vec<&str> = papers.chain(all.iter().map(|about| about.name)).collect();
    let hint = match nearest_path(name, &names) {
        Some(near) => format!("did you mean {near}?"),
        None => "`volary claims` lists them".to_owned(),
    };
    Refusal::bad_input(format!("{name}: no claim or paper of that name; {hint}"))
}

fn object(about: &About) -> Value {
    json!({
        "name": about.name,
        "source": about.source,
        "reading": about.reading,
        "statement": about.statement,
        "hypotheses": about.hypotheses,
        "measured": about.measured,
        "tolerance": about.tolerance,
    })
}
