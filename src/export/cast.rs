//! Who and what the frames of a trace are about, as its header has it.

use super::ExportError;
use crate::trace::record::{BetaAgent, Contact, Frame, Header, ObstaclePose};
use crate::world::spec::Rotation;

/// Names of the axes.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

/// The agents of a trace.
#[derive(Debug)]
pub(super) struct Cast {
    /// What errors call the trace.
    pub name: String,
    /// Number of dimensions, 2 or 3.
    pub dimension: usize,
    /// Name of each agent's group.
    pub groups: Vec<String>,
    pub radii: Vec<f64>,
    pub masses: Vec<f64>,
}

impl Cast {
    /// The agents of a trace's header.
    pub fn new(name: &str, header: &Header) -> Result<Self, ExportError> {
        let dimension = header.world.dimension;
        let uneven = |problem| ExportError::Uneven {
            name: name.to_owned(),
            record: "the header".to_owned(),
            problem,
        };
        if !(2..=3).contains(&dimension) {
            return Err(uneven("has a world of other than 2 or 3 dimensions"));
        }
        let names = header
            .world
            .agents
            .iter()
            .enumerate()
            .map(|(place, group)| {
                let unnamed = || format!("group_{place}");
                group.name.clone().unwrap_or_else(unnamed)
            });
        let names = distinct(names);
        let bodies = &header.bodies;
        let groups = bodies.group.iter().map(|&group| names.get(group).cloned());
        let cast = groups.collect::<Option<Vec<_>>>().map(|groups| Self {
            name: name.to_owned(),
            dimension,
            groups,
            radii: bodies.radius.clone(),
            masses: bodies.mass.clone(),
        });
        cast.filter(|it| it.radii.len() == it.groups.len() && it.masses.len() == it.groups.len())
            .ok_or_else(|| uneven("does not tell group, radius and mass of each agent"))
    }

    /// Refuses a frame that does not tell the same of each agent.
    pub fn check(&self, frame: &Frame) -> Result<(), ExportError> {
        let vector = |vector: &Vec<f64>| vector.len() == self.dimension;
        let each =
            |vectors: &[Vec<f64>]| vectors.len() == self.groups.len() && vectors.iter().all(vector);
        let turn = |rotation: &Rotation| match rotation {
            Rotation::Angle(_) => self.dimension == 2,
            Rotation::Vector(turn) => self.dimension == 3 && turn.len() == 3,
        };
        let turns =
            |turns: &Vec<Rotation>| turns.len() == self.groups.len() && turns.iter().all(turn);
        let beta = |beta: &BetaAgent| vector(&beta.position) && vector(&beta.velocity);
        let pose = |pose: &ObstaclePose| vector(&pose.position) && turn(&pose.rotation);
        let fits = each(&frame.positions)
            && each(&frame.velocities)
            && frame.rotations.iter().all(turns)
            && frame
                .accelerations
                .iter()
                .flatten()
                .all(|law| each(&law.values))
            && frame.beta_agents.iter().flatten().all(beta)
            && frame.obstacles.iter().flatten().all(pose);
        match fits {
            true => Ok(()),
            false => Err(self.uneven(
                frame,
                "does not have one entry of the right size for each agent",
            )),
        }
    }

    /// Refuses a contact at a place that is none.
    pub fn check_contact(&self, contact: &Contact) -> Result<(), ExportError> {
        match contact.position.len() == self.dimension {
            true => Ok(()),
            false => Err(ExportError::Uneven {
                name: self.name.clone(),
                record: format!(
                    "the contact of agent {} at time {}",
                    contact.agent, contact.begin
                ),
                problem: "has a position of another dimension",
            }),
        }
    }

    /// The error of a frame.
    pub fn uneven(&self, frame: &Frame, problem: &'static str) -> ExportError {
        ExportError::Uneven {
            name: self.name.clone(),
            record: format!("the frame at step {}", frame.step),
            problem,
        }
    }

    /// A name for each axis, with something in front of it.
    pub fn axes(&self, before: &str) -> impl Iterator<Item = String> {
        AXES[..self.dimension]
            .iter()
            .map(move |axis| format!("{before}{axis}"))
    }
}

/// The names, with numbers behind those that came before: `a, a_2, a_3`.
pub(super) fn distinct(names: impl IntoIterator<Item = String>) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    for name in names {
        let numbered = (2..).map(|number| format!("{name}_{number}"));
        let mut candidates = std::iter::once(name.clone()).chain(numbered);
        let free = candidates.find(|candidate| !all.contains(candidate));
        all.extend(free);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::distinct;

    #[test]
    fn no_name_comes_twice() {
        let names = ["a", "a", "a_2", "b", "a"].map(str::to_owned);
        assert_eq!(distinct(names), ["a", "a_2", "a_2_2", "b", "a_3"]);
    }
}
