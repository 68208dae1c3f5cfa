//! How a scene is to look.

use crate::picture::Theme;
use crate::render::Layers;

/// How a scene is to look.
#[derive(Debug, Clone, PartialEq)]
pub struct Look {
    /// The colours of the page.
    pub theme: Theme,
    /// What the colours of bodies tell.
    pub coloring: Coloring,
    /// What is shown; absent means [`Layers::usual`].
    pub layers: Option<Layers>,
    /// Width and height of a picture.
    pub size: Size,
    /// In the plane: the lower left and the upper right corner of what is seen; absent means
    /// all that happens, and what obstacles are near to it.
    pub window: Option<[[f64; 2]; 2]>,
    /// Whether what is seen moves along with the flock, its mean position in the middle.
    pub follow: bool,
    /// In space: where it is seen from.
    pub camera: Camera,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            theme: Theme::LIGHT,
            coloring: Coloring::Group,
            layers: None,
            size: Size::Within([800.0, 600.0]),
            window: None,
            follow: false,
            camera: Camera::default(),
        }
    }
}

/// Width and height of a picture in pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Size {
    /// These.
    Exact([f64; 2]),
    /// As much of these as a scene fills that is long or tall, and up to 1.4 times as much for
    /// several moments side by side.
    Within([f64; 2]),
}

/// What the colours of bodies tell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Coloring {
    /// The group.
    #[default]
    Group,
    /// The speed, from 0 to the largest of the run.
    Speed,
    /// The connected component of the proximity net, the largest first.
    Component,
    /// The heading: a body's first axis, of balls the direction of the velocity; in space that of
    /// its part along the ground.
    Heading,
}

/// Where a world in space is seen from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Direction in which the camera stands, seen from the middle of the scene, as the angle from
    /// the first axis to it along the ground, in degrees.
    pub azimuth: f64,
    /// Angle of that direction above the ground, −90 to 90 degrees.
    pub elevation: f64,
    /// Whether it goes round, so that the scene must fit on the page from every azimuth.
    pub orbits: bool,
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            azimuth: -60.0,
            elevation: 25.0,
            orbits: false,
        }
    }
}
