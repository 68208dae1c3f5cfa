//! Which cells of the tree are too near for nodes.

use super::tree::Tree;

/// Lists, one for each of some things, one after another.
#[derive(Debug)]
pub(super) struct Lists<T> {
    starts: Vec<usize>,
    items: Vec<T>,
}

impl<T> Default for Lists<T> {
    fn default() -> Self {
        Self {
            starts: vec![0],
            items: Vec::new(),
        }
    }
}

impl<T> Lists<T> {
    pub fn push(&mut self, item: T) {
        self.items.push(item);
    }

    /// Ends the list of one thing, and begins that of the next.
    pub fn end(&mut self) {
        self.starts.push(self.items.len());
    }

    pub fn of(&self, thing: usize) -> &[T] {
        &self.items[self.starts[thing]..self.starts[thing + 1]]
    }

    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }
}

/// Another cell of the same level, and how many sides a cell is beyond it along each axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Near<const D: usize> {
    pub cell: u32,
    pub sides: [i64; D],
}

/// For each level of the tree, the cells that are too near for each of its cells, those only
/// whose parents are no leaves: the root and itself, then children of near cells within the
/// reach of their level, if it has any.
pub(super) fn near<const D: usize>(
    tree: &Tree<D>,
    reach: impl Fn(usize) -> Option<usize>,
) -> Vec<Lists<Near<D>>> {
    let mut root = Lists::default();
    root.push(Near {
        cell: 0,
        sides: [0; D],
    });
    root.end();
    let mut all = vec![root];
    for (level, cells) in tree.levels.iter().enumerate().skip(1) {
        let mut lists = Lists::default();
        let parents = &tree.levels[level - 1];
        for cell in cells {
            if let Some(reach) = reach(level) {
                for near in all[level - 1].of(cell.parent) {
                    for other in parents[near.cell as usize].children.clone() {
                        let at = cells[other].at;
                        let sides: [i64; D] = std::array::from_fn(|axis| cell.at[axis] - at[axis]);
                        if sides
                            .iter()
                            .all(|side| side.unsigned_abs() as usize <= reach)
                        {
                            lists.push(Near {
                                cell: other as u32,
                                sides,
                            });
                        }
                    }
                }
            }
            lists.end();
        }
        all.push(lists);
    }
    all
}
