//! Pairs that count as near, or as far, whatever their distance is.
//!
//! Where laws jump as a pair comes within a distance, an integration of the equations must be
//! able to look a little beyond without seeing the jump: it holds the pair as it was.

/// A pair of agents that counts as within a distance to some degree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hold {
    /// The agents, by the world's indices, the lower one first.
    pub pair: [u32; 2],
    /// The distance.
    pub distance: f64,
    /// 0 beyond it, 1 within; between, what the whole contribution of each to the other is
    /// multiplied by.
    pub share: f64,
}

impl Hold {
    /// The other agent, where `agent` is one of the pair.
    pub fn other(&self, agent: u32) -> Option<u32> {
        let [i, j] = self.pair;
        match agent {
            _ if agent == i => Some(j),
            _ if agent == j => Some(i),
            _ => None,
        }
    }
}

/// What is held of a pair at a distance, if anything is.
pub(super) fn held(holds: &[Hold], [agent, other]: [u32; 2], distance: f64) -> Option<f64> {
    let of_pair = |hold: &&Hold| hold.distance == distance && hold.other(agent) == Some(other);
    holds.iter().find(of_pair).map(|hold| hold.share)
}

/// The others that `agent` is held with at a distance, to more than nothing.
pub(super) fn held_near(
    holds: &[Hold],
    agent: u32,
    distance: f64,
) -> impl Iterator<Item = (u32, f64)> {
    holds
        .iter()
        .filter(move |hold| hold.distance == distance && hold.share > 0.0)
        .filter_map(move |hold| Some((hold.other(agent)?, hold.share)))
}
