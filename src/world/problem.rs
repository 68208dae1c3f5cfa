//! What can be wrong with a world.

/// One thing wrong with a world, named by where it stands in the file.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// Path of the field: `laws[0].alpha_interaction.range`; empty for the whole file.
    pub path: String,
    /// What is wrong with it, as the end of the sentence "`path` …".
    pub what: String,
    /// What is allowed there, where a range or a list of names can say it.
    pub allowed: Option<String>,
    /// What the writer may have meant.
    pub hint: Option<String>,
    /// Whether the name of the field is wrong, rather than its value.
    pub name_is_wrong: bool,
}

impl Problem {
    /// A problem with neither range nor hint.
    pub fn new(path: impl Into<String>, what: impl Into<String>) -> Self {
        Self {
            path: path.into(),
            what: what.into(),
            allowed: None,
            hint: None,
            name_is_wrong: false,
        }
    }

    /// A problem with the name of a field rather than its value.
    pub fn with_name(path: impl Into<String>, what: impl Into<String>) -> Self {
        Self {
            name_is_wrong: true,
            ..Self::new(path, what)
        }
    }

    /// The same problem, saying what is allowed.
    pub fn allowed(mut self, allowed: impl Into<String>) -> Self {
        self.allowed = Some(allowed.into());
        self
    }

    /// The same problem, saying what may have been meant.
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }
}
