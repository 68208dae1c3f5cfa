//! Sums over all pairs, one by one.

use rayon::prelude::*;

use crate::math::{Radial, vectorized};
use crate::sum::cloud::{BLOCK, Cloud, Sums};
use crate::sum::tile::{Exchange, Gather, Tally};

/// The sums at the points of one cloud over those of another. Points of the same number are
/// the same one, and count for nothing. Each sum is the same whatever others are asked for.
pub fn at<K: Radial, const D: usize>(
    radial: K,
    targets: &Cloud<D>,
    sources: &Cloud<D>,
) -> Vec<Sums<D>> {
    let mut sums = Vec::with_capacity(targets.count());
    for block in targets.blocks() {
        let count = BLOCK.min(targets.count() - sums.len());
        let mut tally = Tally::ZERO;
        vectorized(Gather {
            radial,
            targets: block,
            count,
            sources: sources.blocks(),
            tally: &mut tally,
        });
        sums.extend((0..count).map(|place| tally.at(place, radial.scale())));
    }
    sums
}

/// The sums at all points of a cloud, in their order. Each pair counts once, for both: what
/// one of them gets, the other gets to the bit with the sign of c_j − c_i turned.
///
/// Pairs of blocks are worked on in rounds, in each of which no block has two: so threads
/// share them without a lock, and each point's sum has one order, however many they are.
pub fn mutual<K: Radial, const D: usize>(radial: K, cloud: &Cloud<D>, sums: &mut Vec<Sums<D>>) {
    let blocks = cloud.blocks();
    let mut tallies = vec![Tally::ZERO; blocks.len()];
    for round in 0..blocks.len() {
        // Blocks whose indices add up to the round, modulo their number: those up to it, and
        // those beyond.
        let (low, high) = tallies.split_at_mut(round + 1);
        let mut meetings = pairs(0, low);
        meetings.extend(pairs(round + 1, high));
        let meet = |meeting: Meeting<'_, D>| meet(radial, cloud, meeting);
        if blocks.len() > 2 {
            meetings.into_par_iter().for_each(meet);
        } else {
            meetings.into_iter().for_each(meet);
        }
    }
    sums.clear();
    sums.extend((0..cloud.count()).map(|k| tallies[k / BLOCK].at(k % BLOCK, radial.scale())));
}

/// One block, or two, with their indices.
struct Meeting<'a, const D: usize> {
    one: (usize, &'a mut Tally<D>),
    other: Option<(usize, &'a mut Tally<D>)>,
}

/// Pairs the first of some blocks with the last, the second with the last but one, and so on.
fn pairs<const D: usize>(first: usize, tallies: &mut [Tally<D>]) -> Vec<Meeting<'_, D>> {
    let mut left = tallies.iter_mut().enumerate();
    let mut meetings = Vec::with_capacity(left.len().div_ceil(2));
    let numbered = |(k, tally)| (first + k, tally);
    while let Some(one) = left.next() {
        meetings.push(Meeting {
            one: numbered(one),
            other: left.next_back().map(numbered),
        });
    }
    meetings
}

/// All pairs of a meeting.
fn meet<K: Radial, const D: usize>(radial: K, cloud: &Cloud<D>, meeting: Meeting<'_, D>) {
    let blocks = cloud.blocks();
    let gather = |to: usize, from: usize, tally| {
        vectorized(Gather {
            radial,
            targets: &blocks[to],
            count: BLOCK,
            sources: &blocks[from..=from],
            tally,
        });
    };
    match (meeting.one, meeting.other) {
        ((k, mine), None) => gather(k, k, mine),
        ((k, mine), Some((l, theirs))) if (l + 1) * BLOCK <= cloud.count() => {
            vectorized(Exchange {
                radial,
                blocks: [&blocks[k], &blocks[l]],
                tallies: [mine, theirs],
            });
        }
        // The last block is not full: each for itself. That gives the same to rounding; which
        // way is taken depends on the number of agents alone.
        ((k, mine), Some((l, theirs))) => {
            gather(k, l, mine);
            gather(l, k, theirs);
        }
    }
}
