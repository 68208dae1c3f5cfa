//! Sums over all pairs, one by one.

use std::ops::Range;

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

/// Parts of a cloud, at most, that meet each other as wholes: enough to keep a dozen threads at
/// work, and few enough that what each part is told by each other one takes little memory.
const PARTS: usize = 16;

/// The sums at all points of a cloud, in their order. Each pair counts once, for both: what
/// one of them gets, the other gets to the bit with the sign of c_j − c_i turned.
///
/// All pairs of parts are worked on at once, each by one thread and each with sums of its own,
/// which are added up afterwards: so no thread waits for another, and each point's sum has one
/// order, however many they are.
pub fn mutual<K: Radial, const D: usize>(radial: K, cloud: &Cloud<D>, sums: &mut Vec<Sums<D>>) {
    let blocks = cloud.blocks().len();
    let parts = blocks.min(PARTS);
    let part = |k: usize| blocks * k / parts..blocks * (k + 1) / parts;
    let pairs = (0..parts).flat_map(|other| (0..=other).map(move |one| [one, other]));
    let meet = |pair: [usize; 2]| meet(radial, cloud, pair.map(part));
    let told: Vec<_> = match blocks > 2 {
        true => {
            let pairs: Vec<_> = pairs.collect();
            pairs.into_par_iter().with_max_len(1).map(meet).collect()
        }
        false => pairs.map(meet).collect(),
    };
    sums.clear();
    for k in 0..parts {
        let mut tallies = vec![Tally::ZERO; part(k).len()];
        for other in 0..parts {
            let [low, high] = [k.min(other), k.max(other)];
            let told = &told[high * (high + 1) / 2 + low][usize::from(k > other)];
            let blocks = tallies.iter_mut().zip(told);
            blocks.for_each(|(tally, more)| tally.add(more));
        }
        for tally in &tallies {
            let count = BLOCK.min(cloud.count() - sums.len());
            sums.extend((0..count).map(|place| tally.at(place, radial.scale())));
        }
    }
}

/// All pairs of two parts, or within one: what the blocks of each are told.
fn meet<K: Radial, const D: usize>(
    radial: K,
    cloud: &Cloud<D>,
    [one, other]: [Range<usize>; 2],
) -> [Vec<Tally<D>>; 2] {
    let mut mine = vec![Tally::ZERO; one.len()];
    let mut theirs = Vec::new();
    if one == other {
        for k in 0..mine.len() {
            let (before, rest) = mine.split_at_mut(k);
            gather(radial, cloud, [one.start + k; 2], &mut rest[0]);
            for (l, tally) in before.iter_mut().enumerate() {
                let pair = [one.start + l, one.start + k];
                exchange(radial, cloud, pair, [tally, &mut rest[0]]);
            }
        }
    } else {
        theirs = vec![Tally::ZERO; other.len()];
        for (k, mine) in one.zip(&mut mine) {
            for (l, theirs) in other.clone().zip(&mut theirs) {
                exchange(radial, cloud, [k, l], [mine, theirs]);
            }
        }
    }
    [mine, theirs]
}

/// The pairs of two blocks, the first of which comes first in the cloud.
fn exchange<K: Radial, const D: usize>(
    radial: K,
    cloud: &Cloud<D>,
    [one, other]: [usize; 2],
    tallies: [&mut Tally<D>; 2],
) {
    if (other + 1) * BLOCK <= cloud.count() {
        vectorized(Exchange {
            radial,
            blocks: [one, other].map(|block| &cloud.blocks()[block]),
            tallies,
        });
    } else {
        // The last block is not full: each for itself. That gives the same to rounding; which
        // way is taken depends on the number of agents alone.
        let [mine, theirs] = tallies;
        gather(radial, cloud, [one, other], mine);
        gather(radial, cloud, [other, one], theirs);
    }
}

/// What the points of one block are told by those of one, be it the same.
fn gather<K: Radial, const D: usize>(
    radial: K,
    cloud: &Cloud<D>,
    [to, from]: [usize; 2],
    tally: &mut Tally<D>,
) {
    vectorized(Gather {
        radial,
        targets: &cloud.blocks()[to],
        count: BLOCK,
        sources: &cloud.blocks()[from..=from],
        tally,
    });
}
