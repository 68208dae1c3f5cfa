//! A pair of agents near a distance at which some law jumps.

use crate::math::Vector;
use crate::sense::Hold;

/// How often a pair may cross a distance in quick succession. After that it either slides, or
/// its crossings are not waited for.
pub(super) const MOST_CROSSINGS: u32 = 200;

/// Crossings are in quick succession that follow each other within this share of the step that
/// would be taken without.
const QUICK: f64 = 2e-3;

/// The share of such a step after which pairs are looked at whose crossings are not waited for.
pub(super) const LOOKS: f64 = 0.05;

/// Where a pair stands to a distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Side {
    Within,
    Beyond,
    /// At the distance, held there by what the laws do on both sides.
    Sliding,
}

impl Side {
    pub fn of(within: bool) -> Self {
        match within {
            true => Self::Within,
            false => Self::Beyond,
        }
    }
}

/// A pair near a distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Watched {
    pub pair: [u32; 2],
    pub distance: f64,
    pub side: Side,
    /// How often it has crossed the distance in quick succession, and when last.
    pub crossings: u32,
    pub crossed: f64,
    /// Until when its crossings are not waited for.
    pub blurred: Option<f64>,
    /// Whether its last jump was too small to look for its place.
    pub faint: bool,
}

impl Watched {
    /// A pair on the side on which it is.
    pub fn new(pair: [u32; 2], distance: f64, within: bool) -> Self {
        Self {
            pair,
            distance,
            side: Side::of(within),
            crossings: 0,
            crossed: f64::NEG_INFINITY,
            blurred: None,
            faint: false,
        }
    }

    /// Takes it to the other side at a time; a step without jumps would be about `free` long.
    pub fn cross(&mut self, time: f64, free: f64, faint: bool) {
        self.side = Side::of(self.side == Side::Beyond);
        let quick = time - self.crossed <= QUICK * free && !faint;
        self.crossings = if quick { self.crossings + 1 } else { 1 };
        (self.crossed, self.faint) = (time, faint);
        if self.crosses_too_often() {
            self.blurred = Some(time + free);
        }
    }

    /// Whether it has crossed so often that it is no longer waited for.
    pub fn crosses_too_often(&self) -> bool {
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
        self.side != Side::Sliding && self.blurred.is_none()
    }
}
