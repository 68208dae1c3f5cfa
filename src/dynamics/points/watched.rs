//! A pair of agents near a distance at which some law jumps.

use crate::math::Vector;
use crate::sense::Hold;

/// How often a pair may cross a distance within one step of the world. After that it either
/// slides or is looked at as often as that only.
pub(super) const MOST_CROSSINGS: u32 = 200;

/// Where a pair stands to a distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Side {
    Within,
    Beyond,
    /// At the distance, held there by what the laws do on both sides.
    Sliding,
}

/// A pair near a distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Watched {
    pub pair: [u32; 2],
    pub distance: f64,
    pub side: Side,
    /// How often it has crossed the distance within this step of the world.
    pub crossings: u32,
    /// Whether its last jump was too small to look for its place.
    pub faint: bool,
}

impl Watched {
    /// Whether it has crossed so often that it is no longer waited for.
    pub fn is_blurred(&self) -> bool {
        self.crossings > MOST_CROSSINGS
    }

    /// Of the pair's way squared over the distance squared, less 1, the value and its first two
    /// derivatives, the latter halved; from what two vectors of each agent are.
    pub fn course<const D: usize>(&self, [x, v, a]: [&[Vector<D>]; 3]) -> [f64; 3] {
        let [i, j] = self.pair.map(|agent| agent as usize);
        let (way, rate, bend) = (x[j] - x[i], v[j] - v[i], a[j] - a[i]);
        let square = self.distance * self.distance;
        [
            (way.norm_squared() - square) / square,
            2.0 * way.dot(&rate) / square,
            (rate.norm_squared() + way.dot(&bend)) / square,
        ]
    }

    /// For laws to see it within its distance to this degree.
    pub fn held(&self, share: f64) -> Hold {
        Hold {
            pair: self.pair,
            distance: self.distance,
            share,
        }
    }

    /// The first of these.
    pub fn excess<const D: usize>(&self, x: &[Vector<D>]) -> f64 {
        let [i, j] = self.pair.map(|agent| agent as usize);
        let square = self.distance * self.distance;
        ((x[j] - x[i]).norm_squared() - square) / square
    }

    /// 1 where it is before the distance from within, −1 from beyond; 0 where it slides.
    pub fn sign(&self) -> f64 {
        match self.side {
            Side::Within => -1.0,
            Side::Beyond => 1.0,
            Side::Sliding => 0.0,
        }
    }

    /// Whether its crossings are waited for.
    pub fn counts(&self) -> bool {
        self.side != Side::Sliding && !self.is_blurred()
    }
}
