//! Frames in extended XYZ.

use super::cast::{Cast, distinct};
use crate::csv::write_number;
use crate::math::sin_cos;
use crate::trace::record::Frame;
use crate::world::spec::Rotation;

/// Writes frames in extended XYZ.
#[derive(Debug)]
pub(super) struct XyzWriter {
    cast: Cast,
    /// Name of each agent's species: its group as one word.
    species: Vec<String>,
}

impl XyzWriter {
    pub fn new(cast: Cast) -> Self {
        let mut groups = cast.groups.clone();
        groups.sort();
        groups.dedup();
        let words = distinct(groups.iter().map(|group| word(group)));
        let of_group = |group: &String| {
            let place = groups.binary_search(group).unwrap_or_default();
            words[place].clone()
        };
        Self {
            species: cast.groups.iter().map(of_group).collect(),
            cast,
        }
    }

    /// Adds one frame, which must fit the cast.
    pub fn write(&self, frame: &Frame, text: &mut Vec<u8>) {
        let orientation = match frame.rotations {
            Some(_) => ":orientation:R:4",
            None => "",
        };
        let head = format!(
            "{}\nProperties=species:S:1:pos:R:3:velo:R:3:id:I:1:radius:R:1:mass:R:1{orientation} Time=",
            self.species.len()
        );
        text.extend_from_slice(head.as_bytes());
        write_number(text, frame.time);
        text.extend_from_slice(format!(" Step={} pbc=\"F F F\"\n", frame.step).as_bytes());
        for (agent, species) in self.species.iter().enumerate() {
            text.extend_from_slice(species.as_bytes());
            put(text, spatial(&frame.positions[agent]));
            put(text, spatial(&frame.velocities[agent]));
            text.extend_from_slice(format!(" {agent}").as_bytes());
            put(text, [self.cast.radii[agent], self.cast.masses[agent]]);
            if let Some(rotations) = &frame.rotations {
                put(text, quaternion(&rotations[agent]));
            }
            text.push(b'\n');
        }
    }

    /// The agents of the trace.
    pub fn cast(&self) -> &Cast {
        &self.cast
    }
}

fn put<const N: usize>(text: &mut Vec<u8>, numbers: [f64; N]) {
    for number in numbers {
        text.push(b' ');
        write_number(text, number);
    }
}

/// A vector in space; that of a plane lies in z = 0.
fn spatial(vector: &[f64]) -> [f64; 3] {
    std::array::from_fn(|axis| vector.get(axis).copied().unwrap_or(0.0))
}

/// A rotation as a unit quaternion x, y, z, w.
fn quaternion(rotation: &Rotation) -> [f64; 4] {
    let [x, y, z] = match rotation {
        Rotation::Angle(angle) => [0.0, 0.0, *angle],
        Rotation::Vector(turn) => spatial(turn),
    };
    let angle = x.hypot(y).hypot(z);
    let (sin, cos) = sin_cos(0.5 * angle);
    // Half of sin(a/2)/(a/2), whose limit at no rotation is a half.
    let share = if angle > 0.0 { sin / angle } else { 0.5 };
    [x * share, y * share, z * share, cos]
}

/// A name as one word that no reader takes for a number or for syntax.
fn word(name: &str) -> String {
    let plain = |c: char| {
        if c.is_alphanumeric() || "_-.".contains(c) {
            c
        } else {
            '_'
        }
    };
    let word: String = name.chars().map(plain).collect();
    match word.starts_with(char::is_alphabetic) {
        true => word,
        false => format!("_{word}"),
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, PI};

    use super::*;

    #[test]
    fn names_become_words() {
        for (name, expected) in [
            ("flock", "flock"),
            ("the \"big\" one", "the__big__one"),
            ("2", "_2"),
            ("", "_"),
            ("vögel-1.a", "vögel-1.a"),
        ] {
            assert_eq!(word(name), expected);
        }
    }

    #[test]
    fn groups_stay_apart_as_species() {
        let cast = Cast {
            name: "t".to_owned(),
            dimension: 2,
            groups: ["a b", "a_b", "a b"].map(str::to_owned).into(),
            radii: vec![1.0; 3],
            masses: vec![1.0; 3],
        };
        assert_eq!(XyzWriter::new(cast).species, ["a_b", "a_b_2", "a_b"]);
    }

    #[test]
    fn rotations_become_unit_quaternions() {
        let close = |rotation: Rotation, expected: [f64; 4]| {
            let found = quaternion(&rotation);
            for (a, b) in found.iter().zip(expected) {
                assert!((a - b).abs() < 1e-15, "{rotation:?}: {found:?}");
            }
        };
        close(Rotation::Angle(0.0), [0.0, 0.0, 0.0, 1.0]);
        let quarter = [0.0, 0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2];
        close(Rotation::Angle(FRAC_PI_2), quarter);
        close(
            Rotation::Angle(-FRAC_PI_2),
            [0.0, 0.0, -FRAC_1_SQRT_2, FRAC_1_SQRT_2],
        );
        let half = vec![0.6 * PI, 0.0, -0.8 * PI];
        close(Rotation::Vector(half), [0.6, 0.0, -0.8, 0.0]);
        close(
            Rotation::Vector(vec![1e-200, 0.0, 0.0]),
            [5e-201, 0.0, 0.0, 1.0],
        );
    }
}
