//! Markov chains in continuous time.

use nalgebra::DMatrix;

/// The stationary distribution of the chain that jumps from i to j at the rate q_ij ≥ 0: the π
/// with πQ = 0 and Σπ_i = 1. The diagonal is not read. Nothing where there are several, or no
/// states at all: where there are two sets of states that are never left.
///
/// By the elimination of W. K. Grassmann, M. I. Taksar and D. P. Heyman, "Regenerative analysis
/// and steady state distributions for Markov chains", 1985, which subtracts nothing, so that
/// each entry is exact but for a few roundings, however small.
pub fn stationary(rates: &DMatrix<f64>) -> Option<Vec<f64>> {
    let states = recurrent(rates)?;
    let n = states.len();
    let mut left = DMatrix::from_fn(n, n, |i, j| rates[(states[i], states[j])]);
    for last in (1..n).rev() {
        let away: f64 = (0..last).map(|j| left[(last, j)]).sum();
        for i in 0..last {
            left[(i, last)] /= away;
        }
        for j in 0..last {
            let back = left[(last, j)];
            for i in 0..last {
                left[(i, j)] += left[(i, last)] * back;
            }
        }
    }
    let mut own = vec![1.0];
    for k in 1..n {
        own.push((0..k).map(|i| own[i] * left[(i, k)]).sum());
    }
    let total: f64 = own.iter().sum();
    let mut all = vec![0.0; rates.nrows()];
    for (state, share) in states.into_iter().zip(own) {
        all[state] = share / total;
    }
    all.iter().all(|share| share.is_finite()).then_some(all)
}

/// The states that the chain comes back to again and again, in order, where they all lead to
/// each other; nothing where they do not.
fn recurrent(rates: &DMatrix<f64>) -> Option<Vec<usize>> {
    let n = rates.nrows();
    let leads = |i: usize, j: usize| i != j && rates[(i, j)] > 0.0;
    // Going backwards, the last start from which anything new is found is one from which
    // everything is, if there is any such state.
    let mut seen = vec![false; n];
    let mut last = None;
    for state in 0..n {
        if !seen[state] {
            walk(state, &mut seen, |from, to| leads(to, from));
            last = Some(state);
        }
    }
    let state = last?;
    let mut lead_there = vec![false; n];
    walk(state, &mut lead_there, |from, to| leads(to, from));
    if lead_there.contains(&false) {
        return None;
    }
    let mut reached = vec![false; n];
    walk(state, &mut reached, leads);
    Some((0..n).filter(|&state| reached[state]).collect())
}

/// Marks everything that some steps lead to.
fn walk(start: usize, seen: &mut [bool], leads: impl Fn(usize, usize) -> bool) {
    let mut open = vec![start];
    seen[start] = true;
    while let Some(from) = open.pop() {
        for (to, seen) in seen.iter_mut().enumerate() {
            if !*seen && leads(from, to) {
                *seen = true;
                open.push(to);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn balance_holds_for_random_chains() {
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (seed >> 33) as f64 / 2f64.powi(31)
        };
        for n in [1, 2, 5, 30] {
            // Rates over many orders of magnitude.
            let rates = DMatrix::from_fn(n, n, |_, _| 10f64.powf(8.0 * random() - 4.0));
            let shares = stationary(&rates).expect("one chain");
            assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-14);
            for j in 0..n {
                let flows = |from: usize, to: usize| shares[from] * rates[(from, to)];
                let others = || (0..n).filter(|&i| i != j);
                let arrives: f64 = others().map(|i| flows(i, j)).sum();
                let leaves: f64 = others().map(|i| flows(j, i)).sum();
                assert!((arrives - leaves).abs() <= 1e-12 * leaves, "{n}: {j}");
            }
        }
    }

    #[test]
    fn who_leads_alone_has_all_and_two_leaders_have_no_flock() {
        let chain = |pairs: &[(usize, usize)]| {
            let mut rates = DMatrix::zeros(4, 4);
            pairs.iter().for_each(|&pair| rates[pair] = 2.0);
            stationary(&rates)
        };
        // 0 follows 1, which follows 3, as 2 does.
        let alone = chain(&[(0, 1), (1, 3), (2, 3)]);
        assert_eq!(alone, Some(vec![0.0, 0.0, 0.0, 1.0]));
        // 2 and 3 lead together, each follows the other.
        let pair = chain(&[(0, 2), (1, 0), (2, 3), (3, 2)]);
        assert_eq!(pair, Some(vec![0.0, 0.0, 0.5, 0.5]));
        assert_eq!(chain(&[(0, 1), (1, 2)]), None);
        assert_eq!(chain(&[(0, 1), (1, 0), (2, 3), (3, 2)]), None);
        assert_eq!(stationary(&DMatrix::zeros(0, 0)), None);
    }
}
