//! Whoever watches a world being prepared, which takes long where it is large.

use std::fmt;
use std::ops::ControlFlow;
use std::sync::Arc;

use super::problem::Problem;

/// How far a world has come on the way from its file to its agents.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stage {
    /// The file is read and checked.
    Reading,
    /// Obstacles are built.
    Building,
    /// Agents are given their places.
    Placing {
        /// So many have one.
        placed: usize,
        /// So many are to have one.
        of: usize,
    },
}

/// What is told of each stage, and while agents are placed again and again; it says whether to go
/// on.
type Tell = dyn Fn(Stage) -> ControlFlow<()> + Send + Sync;

/// Someone who watches, or nobody.
#[derive(Clone, Default)]
pub struct Watch(Option<Arc<Tell>>);

impl Watch {
    /// Someone who is told of each stage, and while agents are placed again and again, and who may
    /// break it off.
    pub fn new(tell: impl Fn(Stage) -> ControlFlow<()> + Send + Sync + 'static) -> Self {
        Self(Some(Arc::new(tell)))
    }

    /// Tells of a stage.
    pub(super) fn tell(&self, stage: Stage) -> Result<(), Problem> {
        match self.0.as_ref().map(|tell| tell(stage)) {
            Some(ControlFlow::Break(())) => {
                Err(Problem::new("", "was stopped before it was ready"))
            }
            Some(ControlFlow::Continue(())) | None => Ok(()),
        }
    }
}

impl fmt::Debug for Watch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Watch").field(&self.0.is_some()).finish()
    }
}
