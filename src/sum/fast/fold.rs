//! Numbers at the nodes of a cell, as sums and differences of opposite nodes.
//!
//! Cosines see no more than the sums, and sines the differences: so Fourier's transform costs
//! half as much along each axis.

use super::gemm::padded;

/// Places along an axis that hold sums, the node in the middle among them. Differences follow.
pub(super) fn sums_of(nodes: usize) -> usize {
    nodes.div_ceil(2)
}

/// Turns the numbers at the nodes into sums and differences along each axis: the sum of two
/// opposite nodes takes the place of the one before the middle, their difference that of the
/// one beyond.
pub(super) fn fold<const D: usize>(nodes: usize, values: &mut [f64]) {
    along_all::<D>(nodes, values, |before, beyond| {
        (beyond + before, beyond - before)
    });
}

/// Turns halves of sums and of differences back into the numbers at the nodes, times `factor`.
pub(super) fn unfold<const D: usize>(nodes: usize, values: &mut [f64], factor: f64) {
    along_all::<D>(nodes, values, |sum, difference| {
        (factor * (sum - difference), factor * (sum + difference))
    });
}

/// Puts what `change` makes of the numbers of two opposite nodes into their places, along one
/// axis after the other.
#[inline(always)]
fn along_all<const D: usize>(
    nodes: usize,
    values: &mut [f64],
    change: impl Fn(f64, f64) -> (f64, f64) + Copy,
) {
    let short = padded(nodes);
    let mut row = short;
    for _ in 1..D {
        for plane in values.chunks_exact_mut(nodes * row) {
            let (before, beyond) = plane.split_at_mut(nodes / 2 * row);
            let opposite = before
                .chunks_exact_mut(row)
                .zip(beyond.chunks_exact_mut(row).rev());
            for (before, beyond) in opposite {
                for (before, beyond) in before.iter_mut().zip(beyond) {
                    (*before, *beyond) = change(*before, *beyond);
                }
            }
        }
        row *= nodes;
    }
    for line in values.chunks_exact_mut(short) {
        let (before, beyond) = line[..nodes].split_at_mut(nodes / 2);
        for (before, beyond) in before.iter_mut().zip(beyond.iter_mut().rev()) {
            (*before, *beyond) = change(*before, *beyond);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unfolding_undoes_folding() {
        for nodes in [4, 5, 11] {
            let size = nodes * nodes * padded(nodes);
            let values: Vec<f64> = (0..size).map(|k| ((k * 37) % 64) as f64).collect();
            let mut folded = values.clone();
            fold::<3>(nodes, &mut folded);
            // Nodes 0 and 1 of the first line, and those opposite to them along all axes.
            let corners: f64 = (0..8)
                .map(|corner| {
                    let at = |axis: usize| (corner >> axis & 1) * (nodes - 1);
                    values[(at(0) * nodes + at(1)) * padded(nodes) + at(2)]
                })
                .sum();
            assert_eq!(folded[0], corners);
            unfold::<3>(nodes, &mut folded, 0.5);
            for (line, before) in folded
                .chunks(padded(nodes))
                .zip(values.chunks(padded(nodes)))
            {
                assert_eq!(line[..nodes], before[..nodes]);
            }
        }
    }
}
