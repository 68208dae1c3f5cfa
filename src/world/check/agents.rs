//! Checks of groups of agents.

use super::{Check, Motion, size};
use crate::world::problem::Problem;
use crate::world::spec::{BodyShapeSpec, GroupSpec, HeadingSpec, PerAgent, TorqueSpec};
use crate::world::words::number;

impl Check {
    /// Checks a group of agents.
    pub(super) fn group(&mut self, path: &str, group: &GroupSpec) {
        self.bodies(path, group);
        self.positions(path, group);
        let Some(count) = size(group) else {
            self.add(path, "missing field `count`, which these positions need");
            return;
        };
        if let Some(PerAgent::Each(masses)) = &group.mass
            && masses.len() != count
        {
            let what = format!(
                "must list {count} masses, one for each agent, not {}",
                masses.len()
            );
            self.add(format!("{path}.mass"), what);
        }
        if let Some(sensing) = &group.sensing {
            self.sensing(&format!("{path}.sensing"), sensing, count);
        }
        self.velocities(&format!("{path}.velocities"), &group.velocities, count);
    }

    /// Checks what the bodies of a group are: shape, mass, surface, actuators, heading.
    fn bodies(&mut self, path: &str, group: &GroupSpec) {
        for (field, value) in [
            ("radius", group.radius),
            ("density", group.density),
            ("restitution", group.restitution),
            ("friction", group.friction),
            ("force_limit", group.force_limit),
            ("force_rate_limit", group.force_rate_limit),
            ("top_speed", group.top_speed),
        ] {
            self.finite(&format!("{path}.{field}"), value);
        }
        match (group.radius, &group.shape) {
            (None, None) => self.add(path, "must have a `radius` or a `shape`"),
            (Some(_), Some(_)) => self.one_of_two(format!("{path}.shape"), "radius"),
            (None, Some(shape)) => self.body_shape(&format!("{path}.shape"), shape),
            (Some(_), None) => {}
        }
        if group.mass.is_some() && group.density.is_some() {
            self.one_of_two(format!("{path}.density"), "mass");
        }
        let round = group.is_round();
        for (field, given) in [
            ("heading", group.heading.is_some()),
            ("rotation", group.rotation.is_some()),
        ] {
            if given && round {
                let what = "has no meaning for a ball, which heads where it moves";
                self.add(format!("{path}.{field}"), what);
            }
        }
        if let Some(rotation) = &group.rotation {
            self.rotation(&format!("{path}.rotation"), rotation, ["angle", "radians"]);
        }
        let heading = format!("{path}.heading");
        match &group.heading {
            Some(HeadingSpec::Torque(torque)) => self.torque(&format!("{heading}.torque"), torque),
            Some(HeadingSpec::Velocity(turn)) => {
                self.finite(&format!("{heading}.velocity.turn_rate"), turn.turn_rate);
            }
            None if !round => self.torque(&heading, &TorqueSpec::default()),
            None | Some(HeadingSpec::Free | HeadingSpec::Fixed) => {}
        }
    }

    fn one_of_two(&mut self, path: String, other: &str) {
        let problem = Problem::new(path, format!("contradicts the {other}"));
        self.problems.push(problem.hint("keep one of the two"));
    }

    fn body_shape(&mut self, path: &str, shape: &BodyShapeSpec) {
        match shape {
            BodyShapeSpec::Ball { .. } | BodyShapeSpec::Capsule { .. } => {}
            BodyShapeSpec::Cuboid { half_extents } => {
                self.vector(&format!("{path}.cuboid.half_extents"), half_extents);
            }
            BodyShapeSpec::Convex { points } => self.hull(&format!("{path}.convex.points"), points),
        }
    }

    /// With the torque of a step's start held over its n substeps, small swings of gain g
    /// and damping d die out when (n − 1)/(2n) · step · g < d and 2 · step · d + step² g/n < 4.
    fn torque(&mut self, path: &str, torque: &TorqueSpec) {
        self.finite(&format!("{path}.damping"), torque.damping);
        self.finite(&format!("{path}.limit"), torque.limit);
        if self.motion == Motion::OfPoints {
            return;
        }
        let (n, h, damping) = (self.substeps as f64, self.step, torque.damping());
        let least = (n - 1.0) / (2.0 * n) * h * torque.gain;
        let stiffness = 2.0 * h * damping + h * h * torque.gain / n;
        if stiffness >= 4.0 {
            let what = format!(
                "is too stiff for this step: 2 · step · damping + step² · gain / substeps is {}, \
                 and must be below 4",
                number(stiffness)
            );
            self.problems
                .push(Problem::new(path, what).hint("a smaller `time.step`"));
        } else if damping < least {
            let what = format!(
                "must be at least {} to be stable at this step",
                number(least)
            );
            self.add(format!("{path}.damping"), what);
        }
    }
}
