//! Who is within some distances of whom, and how near that is to changing.

use crate::math::Vector;
use crate::sense::Cells;

/// How far beyond a distance others are looked for, as a share of it.
const REACH: f64 = 1.5;

/// The pairs of agents within each of some distances, at which laws jump.
#[derive(Debug, Default)]
pub(super) struct Links<const D: usize> {
    /// Each with its pairs, the lower index first, in order.
    within: Vec<(f64, Vec<[u32; 2]>)>,
    cells: Cells<D>,
}

impl<const D: usize> Links<D> {
    /// Without any pair yet.
    pub(super) fn new(distances: &[f64]) -> Self {
        Self {
            within: distances.iter().map(|it| (*it, Vec::new())).collect(),
            cells: Cells::default(),
        }
    }

    /// Whether there is nothing to look for.
    pub(super) fn is_empty(&self) -> bool {
        self.within.is_empty()
    }

    /// Notes the pairs as they are.
    pub(super) fn settle(&mut self, positions: &[Vector<D>]) {
        for (distance, pairs) in &mut self.within {
            pairs.clear();
            self.cells.rebuild(positions, *distance);
            each_pair(&self.cells, *distance, |pair, _| pairs.push(pair));
            pairs.sort_unstable();
        }
    }

    /// How far the next pair is from coming or going, as a share of the distance's square;
    /// negative once one has since [`Links::settle`].
    pub(super) fn margin(&mut self, positions: &[Vector<D>]) -> f64 {
        let mut least = f64::INFINITY;
        for (distance, pairs) in &self.within {
            let limit = distance * distance;
            // A pair at the very distance counts as within, for laws as well.
            for &[i, j] in pairs {
                let squared = (positions[j as usize] - positions[i as usize]).norm_squared();
                least = least.min((limit - squared) / limit);
            }
            let reach = REACH * distance;
            least = least.min(REACH * REACH - 1.0);
            self.cells.rebuild(positions, reach);
            each_pair(&self.cells, reach, |pair, squared| {
                if pairs.binary_search(&pair).is_err() {
                    let apart = (squared - limit) / limit;
                    least = least.min(if squared <= limit {
                        apart.min(-f64::MIN_POSITIVE)
                    } else {
                        apart
                    });
                }
            });
        }
        least
    }
}

/// Calls `visit` with each pair of agents within a distance, and the square of theirs.
fn each_pair<const D: usize>(
    cells: &Cells<D>,
    distance: f64,
    mut visit: impl FnMut([u32; 2], f64),
) {
    let (order, positions) = (cells.order(), cells.sorted());
    for (place, position) in positions.iter().enumerate() {
        cells.for_each_within(position, distance, |other, _, squared| {
            if order[place] < order[other] {
                visit([order[place], order[other]], squared);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(places: [f64; 3]) -> Vec<Vector<2>> {
        places.map(|x| Vector::<2>::new(x, 0.0)).to_vec()
    }

    #[test]
    fn the_margin_is_that_of_the_next_pair_to_come_or_go() {
        let mut links = Links::<2>::new(&[2.0]);
        links.settle(&row([0.0, 1.0, 3.5]));
        let margin = |places| links.margin(&row(places));
        let near = |a: f64, b: f64| (a - b).abs() < 1e-14;
        let mut margin = margin;
        // The second and the third are 2.5 apart: (6.25 − 4)/4.
        assert!(near(margin([0.0, 1.0, 3.5]), 0.5625));
        assert!(near(margin([0.0, 1.9, 100.0]), 1.0 - 1.9 * 1.9 / 4.0));
        assert!(near(margin([0.0, 2.2, 100.0]), 1.0 - 2.2 * 2.2 / 4.0));
        assert!(near(margin([0.0, 1.0, 2.8]), 1.8 * 1.8 / 4.0 - 1.0));
        // At the very distance who was within still is, and who was not has come.
        assert!(margin([0.0, 2.0, 100.0]) == 0.0);
        assert!(margin([0.0, 1.0, 3.0]) < 0.0);
        // Nobody is around.
        assert!(near(margin([0.0, 0.0, 1e9]), 1.0));
    }
}
