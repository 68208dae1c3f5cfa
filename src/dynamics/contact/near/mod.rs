//! Who may touch whom in a step, and who came closest so far.
//!
//! Both are lists that serve many steps. Each agent has a budget: the way that it may go before
//! its entries must be found anew. Pairs are listed whose gap is within their budgets, so no
//! other pair can have met while nobody has used up the own one. A fast or a large agent thus
//! makes its own list longer, and nobody else's. Lists decide who is looked at, never what is
//! found: results do not tell when they were made.

mod agents;
mod walls;

pub(super) use agents::Agents;
pub(super) use walls::Walls;

/// Budgets are this many times the way of the step in which lists are made.
const STEPS: f64 = 8.0;
