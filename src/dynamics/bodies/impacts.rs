//! What touches in a step: what the engine holds together, and what bounces.

use rayon::prelude::*;

use super::touch::{set_speeds, sort};
use super::{Bodies, small};
use crate::dynamics::contact::{Change, Contacts, Flight, Start};
use crate::dynamics::{Failure, Touch, Touched};
use crate::math::Vector;
use crate::parallel::{CHUNK, for_each};
use crate::shape::Pose;

impl<const D: usize> Bodies<D> {
    /// Looks around where bodies stand.
    pub(super) fn look_around(&mut self) {
        let time = self.time();
        let (contacts, start) = self.start();
        contacts.begin(start, time);
    }

    /// Decides which contacts the engine is to hold in the step to come.
    pub(super) fn hold(&mut self) {
        let (contacts, start) = self.start();
        contacts.hold(start);
        self.stood.clear();
        let poses = self.obstacles.iter().map(|obstacle| obstacle.pose.clone());
        self.stood.extend(poses);
    }

    /// The contacts of the present positions, ordered by who touches what: those that
    /// no step has answered yet, so without impulse.
    pub fn touches_now(&mut self) -> Vec<Touch<D>> {
        let time = self.time();
        let (contacts, start) = self.start();
        let mut touches = contacts.overlaps(start, time);
        sort(&mut touches);
        touches
    }

    fn start(&mut self) -> (&mut Contacts<D>, Start<'_, D>) {
        let start = Start {
            step: self.step_size,
            positions: &self.positions,
            rotations: self
                .attitudes
                .as_ref()
                .map(|they| &they.stances.rotations[..]),
            spins: self.attitudes.as_ref().map(|they| &they.stances.spins[..]),
            velocities: &self.velocities,
            accelerations: &self.applied,
            obstacles: &self.obstacles,
        };
        (&mut self.contacts, start)
    }

    /// Reads the contacts that the engine held in the step just taken; positions and velocities
    /// are still those before it.
    pub(super) fn find_touches(&mut self) {
        self.touches.clear();
        self.physics.touches(&mut self.touches);
        self.pressed.fill(false);
        let time = self.time();
        for touch in &mut self.touches {
            touch.time = time;
            touch.position = self.positions[touch.agent];
            set_speeds(touch, &self.velocities, &self.obstacles);
            if touch.press > 0.0 {
                self.pressed[touch.agent] = true;
                if let Touched::Agent(other) = touch.touched {
                    self.pressed[other] = true;
                }
            }
        }
    }

    /// Follows the bounces of the step just taken, and reads the velocities at its end.
    pub(super) fn bounce(&mut self) -> Result<(), Failure> {
        if let Some(attitudes) = &self.attitudes {
            self.stood_turned.clone_from(&attitudes.stances.rotations);
        }
        if let Some(attitudes) = &mut self.attitudes {
            attitudes.read(&*self.physics);
        }
        let stances = self.attitudes.as_ref().map(|it| &it.stances);
        let before = &self.stood_turned[..];
        let straight = !self.pulls.is_empty();
        let flight = Flight {
            begin: self.time(),
            step: self.step_size,
            from: &self.positions,
            to: &self.next.0,
            velocities: &self.engine_velocities,
            lag: self.lag(),
            accelerations: (!straight).then_some(&self.applied[..]),
            pressed: &self.pressed,
            turns: stances.map(|now| (before, &now.rotations[..], &now.spins[..])),
            obstacles: &self.obstacles,
            stood: &self.stood,
        };
        let lag = self.lag();
        let changes = self.contacts.sweep(flight, &mut self.touches);
        let sound = |change: &&Change<D>| small(&change.position) && small(&change.velocity);
        if let Some(change) = changes.iter().find(|change| !sound(change)) {
            if let Some(attitudes) = &mut self.attitudes {
                attitudes.stances.rotations.clone_from(&self.stood_turned);
            }
            return Err(self.broken(change.agent));
        }
        sort(&mut self.touches);
        self.read_velocities();
        if !self.late.is_empty() {
            for agent in (0..self.pressed.len()).filter(|&agent| self.pressed[agent]) {
                self.late[agent] = Vector::zeros();
                self.earlier[agent] = None;
            }
        }
        for change in &changes {
            let agent = change.agent;
            self.physics.place(change);
            self.next.0[agent] = change.position;
            self.engine_velocities[agent] = change.velocity;
            let ahead = match (self.pressed[agent], straight) {
                (true, _) => Vector::zeros(),
                (false, true) => self.ahead[agent],
                (false, false) => self.applied[agent] * lag,
            };
            self.next.1[agent] = change.velocity + ahead;
            if !self.late.is_empty() {
                // What was applied before tells nothing of what comes after.
                self.late[agent] = Vector::zeros();
                self.earlier[agent] = None;
            }
            if let Some(attitudes) = &mut self.attitudes {
                attitudes.stances.rotations[agent] = change.rotation;
                attitudes.stances.spins[agent] = change.spin;
            }
        }
        let rotations = self.attitudes.as_ref().map(|it| &it.stances.rotations[..]);
        let ways = [&self.positions[..], &self.next.0[..]];
        let times = [self.time(), self.time() + self.step_size];
        let poses = |agent: usize| {
            let turned = rotations.map_or_else(nalgebra::SMatrix::identity, |all| all[agent]);
            Pose::from_matrix(ways[1][agent], turned)
        };
        self.contacts.note(&self.touches);
        self.contacts.closest(ways, &self.obstacles, &poses, times);
        self.contacts.travel(ways);
        Ok(())
    }

    /// Reads the velocities at the end of the step. Those of bodies that were pressed are what
    /// the engine has.
    fn read_velocities(&mut self) {
        let chunks = self.next.1.par_chunks_mut(CHUNK);
        let engine = self.engine_velocities.par_chunks(CHUNK);
        let ahead = self
            .ahead
            .par_chunks(CHUNK)
            .zip(self.pressed.par_chunks(CHUNK));
        let agents = self.masses.len();
        for_each(
            agents,
            chunks.zip(engine.zip(ahead)),
            |(out, (engine, (ahead, pressed)))| {
                for (k, velocity) in out.iter_mut().enumerate() {
                    *velocity = match pressed[k] {
                        true => engine[k],
                        false => engine[k] + ahead[k],
                    };
                }
            },
        );
    }
}
