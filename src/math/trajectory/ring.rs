//! The plane of a circle.

use crate::math::{Vector, axis, direction};

/// Two unit vectors at right angles that span the plane across an axis, so that they and the
/// axis are a right-handed frame: e₁ and e₂, turned by the smallest rotation that takes e₃ to
/// the axis. In the plane, and for an axis of length 0, they are e₁ and e₂.
///
/// T. Duff et al., "Building an Orthonormal Basis, Revisited", 2017.
pub fn plane_across<const D: usize>(along: &Vector<D>) -> [Vector<D>; 2] {
    let unit = direction(along);
    if D < 3 || unit.norm_squared() == 0.0 {
        return [axis(0), axis(1)];
    }
    let (x, y, z) = (unit[0], unit[1], unit[2]);
    let sign = 1f64.copysign(z);
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    let from = |coordinates: [f64; 3]| Vector::from_fn(|k, _| coordinates[k]);
    [
        from([1.0 + sign * x * x * a, sign * b, -sign * x]),
        from([b, sign + y * y * a, -y]),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_right_handed_and_square_for_any_axis() {
        let mut axes = vec![
            Vector::<3>::new(0.0, 0.0, 1.0),
            Vector::<3>::new(0.0, 0.0, -2.0),
        ];
        for k in 0..500 {
            let t = f64::from(k);
            axes.push(Vector::<3>::new(t.sin(), (2.3 * t).cos(), (0.7 * t).sin()) * (t + 0.1));
        }
        for along in axes {
            let [u, w] = plane_across(&along);
            let unit = along.normalize();
            assert!((u.cross(&w) - unit).norm() < 1e-14, "{along}");
            assert!((u.norm() - 1.0).abs() + (w.norm() - 1.0).abs() < 1e-14);
            assert!(u.dot(&w).abs() < 1e-14);
        }
        let [u, w] = plane_across(&Vector::<3>::new(0.0, 0.0, 5.0));
        assert_eq!((u, w), (axis(0), axis(1)));
        let plane = [axis::<2>(0), axis::<2>(1)];
        assert_eq!(plane_across(&Vector::<2>::zeros()), plane);
    }
}
