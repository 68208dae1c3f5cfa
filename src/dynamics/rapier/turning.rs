//! What the engine's turning lacks.
//!
//! In each substep the engine turns a body along the tangent of its turn: by the angle whose
//! tangent is θ in the plane, in space by twice that of θ/2, for an angular velocity that comes
//! to θ in the substep. So a body that spins at 10 in steps of 0.01 would be late by a third of a
//! percent.

use super::D;
use crate::math::{Vector, sin_cos};

/// The axis, and sine and cosine of the angle, by which a body that spins alike in all substeps
/// has still to be turned after them; nothing where it does not spin.
pub(super) fn lacking(
    spin: &Vector<3>,
    substep: f64,
    substeps: usize,
) -> Option<([f64; 3], (f64, f64))> {
    let rate = spin.norm();
    if rate == 0.0 {
        return None;
    }
    // As complex numbers, of the half angle in space: what should be over what is.
    let angle = rate * substep / (D - 1) as f64;
    let (sine, cosine) = sin_cos(angle);
    let length = (1.0 + angle * angle).sqrt();
    let once = (
        (cosine + sine * angle) / length,
        (sine - cosine * angle) / length,
    );
    let times = |a: (f64, f64), b: (f64, f64)| (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0);
    let all = (1..substeps).fold(once, |all, _| times(all, once));
    let (cosine, sine) = if D == 2 { all } else { times(all, all) };
    Some(((spin / rate).into(), (sine, cosine)))
}
