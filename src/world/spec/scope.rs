//! Scopes in a world file: laws for some groups only.

use std::collections::HashSet;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{GroupSpec, LawSpec};

/// Laws that act on the agents of some groups only, or see only some groups as neighbours.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Scope")]
pub struct ScopeSpec {
    /// Names of the groups on whose agents the laws act; absent means all.
    #[serde(default)]
    #[schemars(length(min = 1))]
    pub agents: Option<Vec<String>>,
    /// Names of the groups that the laws see as neighbours; absent means all.
    #[serde(default)]
    #[schemars(length(min = 1))]
    pub neighbours: Option<Vec<String>>,
    /// The laws; none of them a scope.
    #[schemars(length(min = 1))]
    pub laws: Vec<LawSpec>,
}

impl ScopeSpec {
    /// Whether the laws act on the agents of a group.
    pub fn acts_on(&self, group: &GroupSpec) -> bool {
        is_named(&self.agents, group)
    }

    /// Whether the laws see the agents of a group as neighbours.
    pub fn sees(&self, group: &GroupSpec) -> bool {
        is_named(&self.neighbours, group)
    }
}

/// For each group, whether laws in a scope, or in none, act on its agents.
pub fn acting_on(scope: Option<&ScopeSpec>, groups: &[GroupSpec]) -> Vec<bool> {
    match scope {
        Some(scope) => among(&scope.agents, groups),
        None => vec![true; groups.len()],
    }
}

/// For each group, whether laws in a scope, or in none, see its agents as neighbours.
pub fn seen_by(scope: Option<&ScopeSpec>, groups: &[GroupSpec]) -> Vec<bool> {
    match scope {
        Some(scope) => among(&scope.neighbours, groups),
        None => vec![true; groups.len()],
    }
}

/// For each group, whether it is named, or no group is. As groups have names, those are many
/// where these are.
fn among(names: &Option<Vec<String>>, groups: &[GroupSpec]) -> Vec<bool> {
    let Some(names) = names else {
        return vec![true; groups.len()];
    };
    let names: HashSet<&str> = names.iter().map(String::as_str).collect();
    let named = |group: &GroupSpec| group.name.as_ref().is_some_and(|it| names.contains(&**it));
    groups.iter().map(named).collect()
}

fn is_named(names: &Option<Vec<String>>, group: &GroupSpec) -> bool {
    names.as_ref().is_none_or(|names| {
        let name = group.name.as_ref();
        name.is_some_and(|name| names.contains(name))
    })
}

/// Whether laws in a scope, or in none, act on the agents of a group.
pub fn acts_on(scope: Option<&ScopeSpec>, group: &GroupSpec) -> bool {
    scope.is_none_or(|scope| scope.acts_on(group))
}

/// Every law of a list in its order, those inside scopes in the place of the scope, each
/// with the scope that it stands in.
pub fn each_law(laws: &[LawSpec]) -> impl Iterator<Item = (Option<&ScopeSpec>, &LawSpec)> {
    laws.iter().flat_map(|law| {
        let (scope, inner) = match law {
            LawSpec::Scope(scope) => (Some(scope), scope.laws.as_slice()),
            law => (None, std::slice::from_ref(law)),
        };
        inner.iter().map(move |law| (scope, law))
    })
}

/// The path in the file of every law, in the order of [`each_law`].
pub(in crate::world) fn each_path(laws: &[LawSpec]) -> impl Iterator<Item = String> {
    laws.iter().enumerate().flat_map(|(index, law)| {
        let paths: Vec<String> = match law {
            LawSpec::Scope(scope) => (0..scope.laws.len())
                .map(|inner| format!("laws[{index}].scope.laws[{inner}]"))
                .collect(),
            _ => vec![format!("laws[{index}]")],
        };
        paths
    })
}

/// As [`each_law`], to be changed, without the scopes.
pub(in crate::world) fn each_law_mut(laws: &mut [LawSpec]) -> impl Iterator<Item = &mut LawSpec> {
    laws.iter_mut().flat_map(|law| match law {
        LawSpec::Scope(scope) => scope.laws.as_mut_slice(),
        law => std::slice::from_mut(law),
    })
}
