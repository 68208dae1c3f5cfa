//! Where third agents are that mask some pairs.

use crate::law::alignment::masking::clusters::Eight;
use crate::math::Vector;

/// A region about the ways from one point to up to eight others: rotationally symmetric about
/// an axis through the point, bounded by a cone from the point, a narrower one between, a cone
/// towards the far ends and a plane beyond them.
///
/// It holds the double cones of all the ways, as the module of masking has them, for a way
/// that leaves the axis by the angle θ and ends e away from it:
///
/// - Seen from the point, no direction is farther from the axis than θ and the cone's angle.
/// - The foot on the way is at most e from the axis, and at most sin θ times its distance from
///   the point, which is at most t_l + sin θ h_l; the rest is at most W d/2.
/// - The rest is also at most T times what is left of the way, (x_j − x_l)·w_j, which is at most
///   t_j − t_l, along the axis, and sin θ (e + h_l).
#[derive(Debug, Clone, Copy)]
pub(super) struct Region<const D: usize> {
    start: Vector<D>,
    axis: Vector<D>,
    /// From where and how far along the axis it reaches.
    begin: f64,
    length: f64,
    /// Width over distance along the axis.
    opening: f64,
    /// Width between the cones, at the point and over the distance from it.
    waist: f64,
    widening: f64,
    /// Width at the far ends, and over the distance from them.
    end: f64,
    closing: f64,
    /// Against rounding.
    slack: f64,
}

/// Rounding is far below this share of the lengths at hand.
const SLACK: f64 = 1e-7;

impl<const D: usize> Region<D> {
    /// About the ways from `start` to `ends`: with T, `cone`, and W, `waist`.
    pub(super) fn new(start: &Vector<D>, ends: &[Vector<D>], [cone, waist]: [f64; 2]) -> Self {
        let ways = || ends.iter().map(|end| end - start);
        let axis = crate::math::direction(&ways().sum());
        // The largest sine and tangent of θ, e, and d.
        let (mut sine, mut tangent, mut aside, mut longest) = (0.0f64, 0.0f64, 0.0f64, 0.0f64);
        for way in ways() {
            let distance = way.norm();
            let along = way.dot(&axis);
            let across = (way - axis * along).norm();
            longest = longest.max(distance);
            aside = aside.max(across);
            sine = sine.max(across / distance);
            tangent = match along > 0.0 {
                true => tangent.max(across / along),
                false => f64::INFINITY,
            };
        }
        // Where a cone is all round, or more, it does not bound.
        let bound = |width: f64, margin: f64| match margin > 0.0 && width.is_finite() {
            true => width / margin,
            false => f64::INFINITY,
        };
        let [mut open, mut close] = [1.0 - cone * tangent, 1.0 - cone * sine];
        if tangent.is_infinite() {
            (open, close, sine) = (0.0, 0.0, 1.0);
        }
        let end = bound(aside * (1.0 + cone * sine), close);
        let closing = match end.is_finite() {
            true => cone / close,
            false => 0.0,
        };
        let waist = 0.5 * waist * longest;
        // No farther from the point than the end of the way, if the cones are narrow; in wide
        // ones, beside a way that leaves the axis, the farthest may lie beyond its end.
        let length = match cone < 1.0 {
            true => longest,
            false => longest + sine * waist,
        };
        let (waist, widening) = match open > 0.0 {
            true => {
                let share = 1.0 - sine * sine;
                (waist / share, sine / share)
            }
            false => (aside + waist, 0.0),
        };
        Self {
            start: *start,
            axis,
            begin: if open > 0.0 { 0.0 } else { -length },
            length,
            opening: bound(cone + tangent, open),
            waist,
            widening,
            end: end + closing * length,
            closing,
            slack: SLACK * longest,
        }
    }

    /// Which of eight balls may meet it: 1 for those, 0 for the others.
    #[inline(always)]
    pub(super) fn sieve(&self, points: &[Eight; D], radii: &Eight) -> [u8; 8] {
        let mut met = [0; 8];
        for k in 0..8 {
            let (mut along, mut squared) = (0.0, 0.0);
            for (axis, column) in points.iter().enumerate() {
                let offset = column[k] - self.start[axis];
                along += offset * self.axis[axis];
                squared += offset * offset;
            }
            let radius = radii[k] + self.slack;
            let reach = along - self.begin + radius;
            let width = least(self.opening * reach, self.waist + self.widening * reach);
            let ahead = self.end - self.closing * least(along - radius, self.length);
            let width = least(ahead, width) + radius;
            let outside = (along < self.begin - radius)
                | (along > self.length + radius)
                | (width < 0.0)
                | (squared - along * along > width * width);
            met[k] = u8::from(!outside);
        }
        met
    }
}

/// The lesser of two; the second where the first is no number.
#[inline(always)]
fn least(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}
