//! The neighbours' vote: protocol (34) read as Reynolds' rules.
//!
//! R. Olfati-Saber, "Flocking with Obstacle Avoidance", 2003, §7, (38) to (45).

use crate::math::{Action, AlphaPair, Vector};
use crate::net::Adjacency;

/// What the neighbours of an agent i vote: with w_ij = φ_α(|q_j − q_i| − d_α)/|q_j − q_i|,
/// a neighbour farther than d_α votes positively, for coming closer, a nearer one
/// negatively.
#[derive(Debug, Clone, PartialEq)]
pub struct Vote<const D: usize> {
    /// The sum S_i of all votes.
    pub total: f64,
    /// The sum S_i⁺ of the positive votes, 0 or more.
    pub positive: f64,
    /// The sum S_i⁻ of the negative votes, 0 or less.
    pub negative: f64,
    /// The weighted mean position q_i^ave of the neighbours, (40); `None` where S_i is 0.
    /// Weights of both signs may put it far away from all of them.
    pub average: Option<Vector<D>>,
    /// The weighted mean q_i^ave(+) of those who vote positively, (43); `None` where nobody
    /// does.
    pub positive_average: Option<Vector<D>>,
    /// The weighted mean q_i^ave(−) of those who vote negatively, (43); `None` where nobody
    /// does.
    pub negative_average: Option<Vector<D>>,
    /// The acceleration û_i = Σ_j w_ij (q_j − q_i), (39): protocol (34) without damping.
    pub acceleration: Vector<D>,
}

/// The three cases of the vote.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Case i, S_i > 0: towards q_i^ave, (41).
    Positive,
    /// Case ii, S_i < 0: away from q_i^ave, (42).
    Negative,
    /// Case iii, S_i = 0: along q_i^ave(+) − q_i^ave(−), (45); or nobody votes at all.
    Zero,
}

impl<const D: usize> Vote<D> {
    /// Which of the three cases this is. Votes that cancel to 1e-12 of their absolute sum
    /// count as zero.
    pub fn verdict(&self) -> Verdict {
        if self.total.abs() <= 1e-12 * (self.positive - self.negative) {
            Verdict::Zero
        } else if self.total > 0.0 {
            Verdict::Positive
        } else {
            Verdict::Negative
        }
    }
}

/// The weight w_ij at a distance above 0, (38).
pub fn vote_weight(action: &Action, spacing: f64, distance: f64) -> f64 {
    action.force(distance - spacing) / distance
}

/// The vote on each agent by those that it sees, with the action function and the spacing
/// of `pair`; weights of the net do not count. A neighbour at the agent's own point has no
/// vote, as it exerts no force.
pub fn votes<const D: usize>(
    positions: &[Vector<D>],
    net: &Adjacency,
    pair: &AlphaPair,
) -> Vec<Vote<D>> {
    let vote = |i: usize| {
        let (mut positive, mut negative) = (0.0, 0.0);
        let (mut closer, mut farther) = (Vector::zeros(), Vector::zeros());
        for &(j, _) in net.row(i) {
            let offset = positions[j] - positions[i];
            let distance = offset.norm();
            if distance > 0.0 {
                let weight = vote_weight(&pair.action, pair.spacing, distance);
                if weight > 0.0 {
                    positive += weight;
                    closer += offset * weight;
                } else {
                    negative += weight;
                    farther += offset * weight;
                }
            }
        }
        let (total, acceleration) = (positive + negative, closer + farther);
        let place = |sum: f64, pull: Vector<D>| (sum != 0.0).then(|| positions[i] + pull / sum);
        Vote {
            total,
            positive,
            negative,
            average: place(total, acceleration),
            positive_average: place(positive, closer),
            negative_average: place(negative, farther),
            acceleration,
        }
    };
    (0..positions.len()).map(vote).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fade;
    use crate::net::neighborhood;

    fn ballot(at: &[f64]) -> Vec<Vote<2>> {
        let at: Vec<_> = at.iter().map(|&x| Vector::<2>::new(x, 0.0)).collect();
        let pair = AlphaPair {
            action: Action::new(1.0, 5.0),
            spacing: 2.0,
            range: 3.0,
            fade: Fade::Sharp,
        };
        votes(&at, &neighborhood::uniform(&at, 3.0), &pair)
    }

    #[test]
    fn far_neighbours_vote_for_coming_closer_and_near_ones_against() {
        let verdicts = |at: &[f64]| ballot(at).iter().map(Vote::verdict).collect::<Vec<_>>();
        assert_eq!(verdicts(&[0.0, 2.5]), [Verdict::Positive; 2]);
        assert_eq!(verdicts(&[0.0, 1.5]), [Verdict::Negative; 2]);
        // At the desired distance, at the same point, out of range: nobody votes.
        assert_eq!(verdicts(&[0.0, 2.0]), [Verdict::Zero; 2]);
        assert_eq!(verdicts(&[0.0, 0.0]), [Verdict::Zero; 2]);
        assert_eq!(verdicts(&[0.0, 9.0]), [Verdict::Zero; 2]);
    }

    #[test]
    fn equal_votes_of_opposite_sign_still_move_the_agent() {
        // A far neighbour on the right, and on the left a near one just as heavy, found by
        // halving: case iii of the paper, which none of Reynolds' rules has.
        let action = Action::new(1.0, 5.0);
        let far = vote_weight(&action, 2.0, 2.9);
        let (mut low, mut high) = (0.5, 2.0);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if vote_weight(&action, 2.0, middle) < -far {
                low = middle;
            } else {
                high = middle;
            }
        }
        let vote = &ballot(&[0.0, 2.9, -high])[0];
        assert_eq!(vote.verdict(), Verdict::Zero);
        let (plus, minus) = (
            vote.positive_average.unwrap(),
            vote.negative_average.unwrap(),
        );
        assert!((plus.x - 2.9).abs() < 1e-14 && (minus.x + high).abs() < 1e-14);
        let along = (plus - minus) * vote.positive;
        assert!((vote.acceleration - along).norm() < 1e-12 && along.x > 0.1);
    }
}
