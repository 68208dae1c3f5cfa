//! Where space is seen from, and what of it falls where on the page.

use crate::math::{Vector, axis};
use crate::shape::Bounds;

use super::super::view::Framing;

/// An eye, and the page behind it.
#[derive(Debug, Clone)]
pub(super) struct Eyepoint {
    /// Where it is.
    pub(super) place: Vector<3>,
    /// Unit vectors to the right and upwards on the page, and from the scene to the eye.
    pub(super) right: Vector<3>,
    pub(super) up: Vector<3>,
    pub(super) back: Vector<3>,
    /// Pixels per tangent of the angle from the middle.
    zoom: f64,
    /// Where on the page the line of sight through the middle of the scene falls.
    middle: [f64; 2],
    /// Width and height of the scene, in tangents.
    pub(super) sides: [f64; 2],
    /// Half the diagonal of the scene.
    pub(super) radius: f64,
}

/// Distance of the eye from the middle of the scene, in half diagonals of the scene: far enough
/// that nothing is distorted, near enough that near things look nearer.
pub(super) const DISTANCE: f64 = 3.2;

impl Eyepoint {
    /// The eye that sees a scene as large as the page allows; one that goes round, from
    /// everywhere as large as the page allows everywhere.
    pub(super) fn new(framing: &Framing<3>) -> Self {
        let camera = framing.camera;
        let mut eye = Self::towards(&framing.bounds, camera.azimuth, camera.elevation);
        let azimuths: Vec<f64> = match camera.orbits {
            true => (0..72).map(|k| f64::from(k) * 5.0).collect(),
            false => vec![camera.azimuth],
        };
        // The rectangle of the page, in tangents, that the corners of the scene fall into.
        let (mut min, mut max) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for azimuth in azimuths {
            let other = Self::towards(&framing.bounds, azimuth, camera.elevation);
            for corner in corners(&framing.bounds) {
                if let Some((tangents, _)) = other.tangents(&corner) {
                    for k in 0..2 {
                        min[k] = min[k].min(tangents[k]);
                        max[k] = max[k].max(tangents[k]);
                    }
                }
            }
        }
        let [width, height] = framing.size;
        eye.sides = [max[0] - min[0], max[1] - min[1]];
        eye.zoom = (width / eye.sides[0]).min(height / eye.sides[1]);
        eye.middle = [
            0.5 * width - eye.zoom * 0.5 * (min[0] + max[0]),
            0.5 * height + eye.zoom * 0.5 * (min[1] + max[1]),
        ];
        eye
    }

    /// An eye in this direction from a scene.
    fn towards((min, max): &Bounds<3>, azimuth: f64, elevation: f64) -> Self {
        let (azimuth, elevation) = (azimuth.to_radians(), elevation.to_radians());
        let back = Vector::<3>::new(
            elevation.cos() * azimuth.cos(),
            elevation.cos() * azimuth.sin(),
            elevation.sin(),
        );
        let right = Vector::<3>::new(-azimuth.sin(), azimuth.cos(), 0.0);
        let radius = 0.5 * (max - min).norm();
        Self {
            place: (min + max) * 0.5 + back * (DISTANCE * radius),
            right,
            up: back.cross(&right),
            back,
            zoom: 1.0,
            middle: [0.0; 2],
            sides: [1.0; 2],
            radius,
        }
    }

    /// Tangents of the angles to the right and upwards at which a point is seen, and how far
    /// it is along the line of sight; nothing where it is beside the eye or behind it.
    fn tangents(&self, point: &Vector<3>) -> Option<([f64; 2], f64)> {
        let way = point - self.place;
        let ahead = -way.dot(&self.back);
        let near = 0.01 * self.radius;
        (ahead > near).then(|| {
            let tangents = [way.dot(&self.right) / ahead, way.dot(&self.up) / ahead];
            (tangents, ahead)
        })
    }

    /// Where a point is seen, in pixels, and how many pixels a length has there.
    pub(super) fn see(&self, point: &Vector<3>) -> Option<([f64; 2], f64)> {
        let ([x, y], ahead) = self.tangents(point)?;
        let at = [
            self.middle[0] + self.zoom * x,
            self.middle[1] - self.zoom * y,
        ];
        Some((at, self.zoom / ahead))
    }

    /// Distance from the eye.
    pub(super) fn distance(&self, point: &Vector<3>) -> f64 {
        (point - self.place).norm()
    }

    /// Pixels per length in the middle of the scene.
    pub(super) fn scale(&self) -> f64 {
        self.zoom / (DISTANCE * self.radius)
    }
}

/// The corners of a box.
fn corners((min, max): &Bounds<3>) -> impl Iterator<Item = Vector<3>> {
    let (min, sides) = (*min, max - min);
    (0..8).map(move |k: usize| {
        let side = |d: usize| match k >> d & 1 {
            0 => Vector::zeros(),
            _ => axis::<3>(d) * sides[d],
        };
        min + side(0) + side(1) + side(2)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Theme;
    use crate::render::Camera;

    fn eye(azimuth: f64, elevation: f64) -> Eyepoint {
        Eyepoint::new(&Framing {
            bounds: (Vector::repeat(-1.0), Vector::repeat(1.0)),
            size: [400.0, 400.0],
            theme: Theme::LIGHT,
            camera: Camera {
                azimuth,
                elevation,
                orbits: false,
            },
            ground: -1.0,
        })
    }

    #[test]
    fn points_fall_where_they_are_seen() {
        // From the side of −y: x to the right, z upwards.
        let eye = eye(-90.0, 0.0);
        let at = |x, y, z| eye.see(&Vector::<3>::new(x, y, z)).expect("before the eye");
        let (middle, _) = at(0.0, 0.0, 0.0);
        assert!((middle[0] - 200.0).abs() < 1e-9 && (middle[1] - 200.0).abs() < 1e-9);
        // The near side fills the page, and the far one is smaller by the ratio of distances.
        let (corner, near) = at(1.0, -1.0, 1.0);
        assert!((corner[0] - 400.0).abs() < 1e-9 && corner[1].abs() < 1e-9);
        let (_, far) = at(0.0, 1.0, 0.0);
        let distance = DISTANCE * 3f64.sqrt();
        assert!((near / far - (distance + 1.0) / (distance - 1.0)).abs() < 1e-9);
        assert!((near - 200.0).abs() < 1e-9);
        assert_eq!(eye.see(&Vector::<3>::new(0.0, -100.0, 0.0)), None);
    }

    #[test]
    fn from_above_north_is_up() {
        let eye = eye(-90.0, 90.0);
        let at = |x, y| {
            eye.see(&Vector::<3>::new(x, y, 0.0))
                .expect("below the eye")
                .0
        };
        let (middle, east, north) = (at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0));
        assert!(east[0] > middle[0] + 50.0 && (east[1] - middle[1]).abs() < 1e-9);
        assert!(north[1] < middle[1] - 50.0 && (north[0] - middle[0]).abs() < 1e-9);
    }
}
