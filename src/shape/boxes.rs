//! Boxes, and those among many that may be near.

use crate::math::Vector;
use crate::shape::Tree;

/// Lowest and highest corner of an axis-parallel box; infinite for what has no bounds.
pub type Bounds<const D: usize> = (Vector<D>, Vector<D>);

/// What makes a tree of the bounded ones among some boxes.
pub(super) type Plant<const D: usize> = fn(&[Bounds<D>]) -> Box<dyn Tree<D>>;

/// From this number of bounded boxes on there is a tree of them.
const MANY: usize = 9;

/// Up to this number of boxes, looking at all of them is quicker than asking the tree.
const FEW: usize = 24;

/// How often a tree is fitted to boxes that move before it is made anew.
const FITS: u32 = 64;

/// Where boxes are looked for. Whatever reaches a box reaches every box about that box, to the
/// last bit: so a tree finds what a look at all boxes does.
#[derive(Debug, Clone, Copy)]
pub enum Reach<const D: usize> {
    /// At most so far from a point, along each axis.
    Around {
        /// The point.
        point: Vector<D>,
        /// The distance.
        range: f64,
    },
    /// Within a box.
    Within {
        /// Its lowest corner.
        min: Vector<D>,
        /// Its highest corner.
        max: Vector<D>,
    },
    /// On the way from a point to another.
    Along {
        /// The point.
        from: Vector<D>,
        /// One over the way, coordinate by coordinate.
        inverse: Vector<D>,
        /// By how much boxes are taken to be larger, against rounding.
        slack: f64,
    },
}

/// Share of a solid's size by which queries may be off, with a margin: for hulls it is 1e-7.
const SLACK: f64 = 1e-6;

impl<const D: usize> Reach<D> {
    /// The way between two points.
    pub(crate) fn along(from: &Vector<D>, to: &Vector<D>) -> Self {
        let inverse = |way: f64| match way.abs() > 1e-300 {
            true => 1.0 / way,
            // Whatever is not beside it is far outside of the way.
            false => 1e300,
        };
        Self::Along {
            from: *from,
            inverse: (to - from).map(inverse),
            slack: 1e-12 * from.amax().max(to.amax()),
        }
    }

    /// Whether it reaches a box; where a way hardly misses it, it may.
    #[inline(always)]
    pub(super) fn meets(&self, min: &Vector<D>, max: &Vector<D>) -> bool {
        match self {
            Self::Around { point, range } => {
                (0..D).all(|k| point[k] >= min[k] - range && point[k] <= max[k] + range)
            }
            Self::Within {
                min: low,
                max: high,
            } => (0..D).all(|k| high[k] >= min[k] && low[k] <= max[k]),
            Self::Along {
                from,
                inverse,
                slack,
            } => {
                let sides = (0..D).fold(0.0, |sum, k| sum + (max[k] - min[k]));
                let slack = SLACK * sides + slack;
                let (mut begin, mut end) = (0.0f64, 1.0f64);
                for k in 0..D {
                    let a = (min[k] - slack - from[k]) * inverse[k];
                    let b = (max[k] + slack - from[k]) * inverse[k];
                    begin = begin.max(a.min(b));
                    end = end.min(a.max(b));
                }
                begin <= end
            }
        }
    }
}

/// Some boxes, in an order.
#[derive(Debug, Default)]
pub(crate) struct Boxes<const D: usize> {
    all: Vec<Bounds<D>>,
    /// The bounded ones, where there are many of them.
    tree: Option<Box<dyn Tree<D>>>,
    /// The others.
    unbounded: Vec<u32>,
    fits: u32,
}

impl<const D: usize> Boxes<D> {
    /// Takes these boxes instead of those before, in little time where few things changed.
    pub(super) fn follow(
        &mut self,
        boxes: impl ExactSizeIterator<Item = Bounds<D>>,
        plant: Plant<D>,
    ) {
        let mut fits = self.all.len() == boxes.len();
        let mut moved = !fits;
        if fits {
            for (kept, now) in self.all.iter_mut().zip(boxes) {
                fits &= is_bounded(kept) == is_bounded(&now);
                moved |= *kept != now;
                *kept = now;
            }
        } else {
            self.all = boxes.collect();
        }
        if !moved {
            return;
        }
        match &mut self.tree {
            Some(tree) if fits && self.fits < FITS => {
                tree.fit(&self.all);
                self.fits += 1;
            }
            _ => {
                let unbounded = (0..self.all.len()).filter(|&k| !is_bounded(&self.all[k]));
                self.unbounded = unbounded.map(|k| k as u32).collect();
                let many = self.all.len() - self.unbounded.len() >= MANY;
                self.tree = many.then(|| plant(&self.all));
                self.fits = 0;
            }
        }
    }

    /// The tree of the bounded boxes, where there are many, by their indices.
    pub(super) fn tree(&self) -> Option<&dyn Tree<D>> {
        self.tree.as_deref()
    }

    /// The boxes that are not in the tree.
    pub(super) fn outside_the_tree(&self) -> impl Iterator<Item = usize> {
        let all = match self.tree {
            None => 0..self.all.len(),
            Some(_) => 0..0,
        };
        let unbounded = match self.tree {
            None => &[][..],
            Some(_) => &self.unbounded,
        };
        all.chain(unbounded.iter().map(|&k| k as usize))
    }

    /// A box about all that are in the tree, where there is one.
    pub(super) fn hull(&self) -> Option<Bounds<D>> {
        self.tree.as_ref()?;
        let bounded = self.all.iter().filter(|it| is_bounded(it)).copied();
        bounded.reduce(about_both)
    }

    /// The indices of the boxes that something reaches, in their order.
    pub(crate) fn reached(&self, reach: Reach<D>) -> Reached<'_, D> {
        Reached {
            boxes: self,
            reach,
            next: 0,
            batch: [0; BATCH],
            waiting: 0..0,
            more: true,
            asks: 4,
        }
    }
}

/// Boxes that the tree is asked for at once.
const BATCH: usize = 16;

/// What [`Boxes::reached`] finds. It takes no memory: what a tree finds comes in no order, so it
/// is asked for some of the lowest indices, and asked again for the next.
#[derive(Debug)]
pub(crate) struct Reached<'a, const D: usize> {
    boxes: &'a Boxes<D>,
    reach: Reach<D>,
    /// The lowest index that was not looked at yet.
    next: usize,
    batch: [u32; BATCH],
    waiting: std::ops::Range<usize>,
    more: bool,
    /// How often the tree may still be asked. So much is reached then that a look at all is as
    /// quick.
    asks: u32,
}

impl<const D: usize> Iterator for Reached<'_, D> {
    type Item = usize;

    #[inline]
    fn next(&mut self) -> Option<usize> {
        let all = &self.boxes.all;
        match self.boxes.tree() {
            Some(tree) if all.len() > FEW && (self.asks > 0 || !self.waiting.is_empty()) => {
                if self.waiting.is_empty() && self.more {
                    self.asks -= 1;
                    self.ask(tree);
                }
                self.waiting.next().map(|k| self.batch[k] as usize)
            }
            _ => {
                let mut left = self.next..all.len();
                let found = left.find(|&k| self.meets(k));
                self.next = left.start;
                found
            }
        }
    }
}

impl<const D: usize> Reached<'_, D> {
    #[inline(always)]
    fn meets(&self, index: usize) -> bool {
        let (min, max) = &self.boxes.all[index];
        self.reach.meets(min, max)
    }

    /// Takes the next batch from the tree, and from the boxes that are not in it.
    fn ask(&mut self, tree: &dyn Tree<D>) {
        let (mut batch, mut count, mut more) = (self.batch, 0, false);
        let next = self.next;
        let mut put = |index: usize| {
            let index = index as u32;
            if (index as usize) < next {
                return;
            }
            if count == BATCH {
                more = true;
                if index > batch[BATCH - 1] {
                    return;
                }
                count -= 1;
            }
            let mut place = count;
            while place > 0 && batch[place - 1] > index {
                batch[place] = batch[place - 1];
                place -= 1;
            }
            batch[place] = index;
            count += 1;
        };
        tree.search(&self.reach, &mut put);
        let unbounded = self.boxes.unbounded.iter().map(|&k| k as usize);
        unbounded.filter(|&k| self.meets(k)).for_each(put);
        self.batch = batch;
        self.waiting = 0..count;
        self.more = more;
        self.next = self.batch[..count]
            .last()
            .map_or(self.boxes.all.len(), |&last| last as usize + 1);
    }
}

fn is_bounded<const D: usize>((min, max): &Bounds<D>) -> bool {
    (0..D).all(|k| min[k].is_finite() && max[k].is_finite())
}

/// The box about two boxes.
pub(super) fn about_both<const D: usize>(
    (min, max): Bounds<D>,
    (low, high): Bounds<D>,
) -> Bounds<D> {
    (min.inf(&low), max.sup(&high))
}
