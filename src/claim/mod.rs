//! Claims: what the papers promise, checked on runs.
//!
//! A [`Claim`] is one theorem, lemma or bound: its hypotheses are looked for in the world as
//! given and in the run, its conclusion in the [`Run`] alone, which holds states and what the
//! laws make of them. So a claim knows neither laws nor engines from within. It comes to a
//! [`Finding`]: a verdict with its margin, the time at which it came closest to failing, and
//! the reason. [`Judging`] puts one together.
//!
//! Where a claim is wrong as printed, there are two: as printed and as corrected.

mod about;
mod djokam_rathinam;
mod falling;
mod finding;
mod integral;
mod judging;
mod li_liu_wu;
mod limit;
mod olfati_saber_2003;
mod run;
mod shi_wang_chu;
mod slack;
mod song_2013;
mod undisturbed;

pub use about::{About, Reading};
pub use falling::Falling;
pub use finding::{Curve, Finding, Hypothesis, Quantity, Side, Verdict};
pub use judging::{Bound, Judging};
pub use limit::{Trend, bounded, vanishes};
pub use run::{Closest, MovedBy, Run, closer, closer_between};

use crate::world::World;

/// A claim of a paper.
pub trait Claim<const D: usize>: Send + Sync {
    /// What it says, and where.
    fn about(&self) -> &'static About;

    /// What it comes to on a run; nothing where the run's world has not got what the claim
    /// is about, such as the law of a theorem.
    fn judge(&self, run: &Run<'_, D>) -> Option<Finding>;

    /// Variations of a world whose runs the claim needs besides that of the world itself;
    /// [`Run::companions`] has them.
    fn companions(&self, _world: &World<D>) -> Vec<World<D>> {
        Vec::new()
    }

    /// For claims that exclude collisions: how far they keep any two agents apart in a run
    /// that starts as this one does. Nothing where the claim is not about that, or its
    /// hypotheses are not met at the start.
    fn exclusion(&self, _run: &Run<'_, D>) -> Option<Exclusion> {
        None
    }
}

/// What a claim says of the distance between agents.
#[derive(Debug, Clone, PartialEq)]
pub struct Exclusion {
    /// No two agents ever come closer than this; half of it is a radius of bodies that theory
    /// keeps from touching.
    pub distance: f64,
    /// Why, in a formula.
    pub formula: &'static str,
}

/// All claims, paper by paper.
pub fn claims<const D: usize>() -> Vec<Box<dyn Claim<D>>> {
    let mut claims = djokam_rathinam::claims();
    claims.extend(song_2013::claims());
    claims.extend(li_liu_wu::claims());
    claims.extend(olfati_saber_2003::claims());
    claims.extend(shi_wang_chu::claims());
    claims
}

/// What all claims say, in the order of [`claims`].
pub fn abouts() -> Vec<&'static About> {
    claims::<2>().iter().map(|claim| claim.about()).collect()
}
