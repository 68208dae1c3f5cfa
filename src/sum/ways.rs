//! Ways to sum, as objects: their loops are compiled here once, for the plane and for space,
//! and not again in each program that has a law.

use std::any::Any;
use std::fmt::Debug;
use std::sync::Arc;

use crate::math::{Influence, Potential, Radial, Repulsion, Vector, WithRadial};
use crate::sum::fast::{FastSums, Kernel};
use crate::sum::{Cloud, Sums, at, mutual};

/// Sums over pairs one by one.
pub trait Direct<const D: usize>: Send + Sync {
    /// As [`mutual`].
    fn mutual(&self, cloud: &Cloud<D>, sums: &mut Vec<Sums<D>>);

    /// As [`at`].
    fn at(&self, targets: &Cloud<D>, sources: &Cloud<D>) -> Vec<Sums<D>>;
}

struct Of<K>(K);

impl<K: Radial, const D: usize> Direct<D> for Of<K> {
    fn mutual(&self, cloud: &Cloud<D>, sums: &mut Vec<Sums<D>>) {
        mutual(self.0, cloud, sums);
    }

    fn at(&self, targets: &Cloud<D>, sources: &Cloud<D>) -> Vec<Sums<D>> {
        at(self.0, targets, sources)
    }
}

/// Fast sums, as [`FastSums`].
pub trait Fast<const D: usize>: Debug + Send + Sync {
    /// As [`FastSums::run`].
    fn run(
        &mut self,
        positions: &[Vector<D>],
        carried: &[Vector<D>],
        sums: &mut Vec<Sums<D>>,
    ) -> bool;

    /// The same, to be used on its own.
    fn boxed(&self) -> Box<dyn Fast<D>>;
}

impl<const D: usize> Fast<D> for FastSums<D> {
    fn run(
        &mut self,
        positions: &[Vector<D>],
        carried: &[Vector<D>],
        sums: &mut Vec<Sums<D>>,
    ) -> bool {
        FastSums::run(self, positions, carried, sums)
    }

    fn boxed(&self) -> Box<dyn Fast<D>> {
        Box::new(self.clone())
    }
}

impl<const D: usize> Clone for Box<dyn Fast<D>> {
    fn clone(&self) -> Self {
        self.as_ref().boxed()
    }
}

/// What there is for the plane and for space.
#[derive(Debug)]
pub struct Ways<P, S> {
    plane: P,
    space: S,
}

impl<P: 'static, S: 'static> Ways<P, S> {
    /// That for D axes, 2 or 3.
    fn within<const D: usize, T: 'static>(self) -> Option<T> {
        let way: Box<dyn Any> = match D {
            2 => Box::new(self.plane),
            _ => Box::new(self.space),
        };
        way.downcast().ok().map(|way| *way)
    }
}

/// Direct sums of one function.
pub type DirectWays = Ways<Arc<dyn Direct<2>>, Arc<dyn Direct<3>>>;

/// Makes direct sums of a radial function.
struct Both;

impl WithRadial for Both {
    type Output = DirectWays;

    fn with<K: Radial>(self, radial: K) -> DirectWays {
        Ways {
            plane: Arc::new(Of(radial)),
            space: Arc::new(Of(radial)),
        }
    }
}

/// A function of the distance that can be summed over pairs.
pub trait Summable {
    /// Its direct sums; nothing where it is not known on lanes.
    fn ways(&self) -> Option<DirectWays>;
}

impl Summable for Influence {
    fn ways(&self) -> Option<DirectWays> {
        self.with_radial(Both)
    }
}

impl Summable for Potential {
    fn ways(&self) -> Option<DirectWays> {
        self.with_radial(Both)
    }
}

impl Summable for Repulsion {
    fn ways(&self) -> Option<DirectWays> {
        self.with_radial(Both)
    }
}

/// Direct sums of a function in D axes, 2 or 3; nothing where it is not known on lanes.
pub fn direct<const D: usize>(function: &impl Summable) -> Option<Arc<dyn Direct<D>>> {
    function.ways()?.within::<D, _>()
}

/// Fast sums of a kernel in D axes, 2 or 3, as [`FastSums::new`].
pub fn fast<const D: usize>(kernel: Kernel, relative_error: f64) -> Option<Box<dyn Fast<D>>> {
    fast_ways(kernel, relative_error)?.within::<D, _>()
}

fn fast_ways(
    kernel: Kernel,
    relative_error: f64,
) -> Option<Ways<Box<dyn Fast<2>>, Box<dyn Fast<3>>>> {
    Some(Ways {
        plane: Box::new(FastSums::new(kernel.clone(), relative_error)?),
        space: Box::new(FastSums::new(kernel, relative_error)?),
    })
}
