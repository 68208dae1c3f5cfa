//! Nets: the graphs that agents induce by where they are, and their analysis.
//!
//! R. Olfati-Saber, "Flocking with Obstacle Avoidance", 2003, §§2 to 9. Everything here is
//! a pure function of positions, and of headings or velocities where they enter.
//!
//! | question | answer |
//! |---|---|
//! | who sees whom? | [`neighborhood`], weighted or not, directed or not: [`Adjacency`] |
//! | who is joined to whom? | [`Net`], undirected without weights |
//! | is it one flock? | [`Components`], with density (7) |
//! | is it balanced? how well connected? | [`Adjacency`], [`algebraic_connectivity`] |
//! | and where it is directed? | [`is_strongly_connected`], [`symmetric_connectivity`] |
//! | how much energy is in its structure? | [`structural_potential`], [`structural_energy`] |
//! | is it a lattice? | [`realisation_error`] (20), [`defect`] (46), [`normalised_defect`] (47) |
//! | which links came and went? | [`LinkChanges`] |
//! | does it hold its shape? | [`Rigidity`] |
//! | is it planar? is its drawing? | [`is_planar`], [`crossings`] |
//! | what do the neighbours want? | [`votes`] (38) to (45) |
//!
//! Six agents on a triangular lattice, and one far away:
//!
//! ```
//! use volary::math::Vector;
//! use volary::net::{
//!     Adjacency, Net, Rigidity, algebraic_connectivity, crossings, is_planar, realisation_error,
//! };
//!
//! let row = 0.75f64.sqrt();
//! let positions = [
//!     (0.0, 0.0), (1.0, 0.0), (2.0, 0.0),
//!     (0.5, row), (1.5, row),
//!     (1.0, 2.0 * row),
//!     (9.0, 9.0),
//! ].map(|(x, y)| Vector::<2>::new(x, y));
//!
//! let net = Net::new(&positions, 1.2);
//! assert_eq!(net.edges().len(), 9);
//! assert_eq!(net.partition().sizes(), [6, 1]);
//! assert!(net.partition().is_quasi_flock(0.2));
//! assert!(realisation_error(&positions, &net, 1.0) < 1e-12);
//! assert!(is_planar(&net) && crossings(&positions, &net) == 0);
//!
//! // The lone agent moves freely, and cuts the connection; the lattice alone is rigid.
//! assert_eq!(Rigidity::new(&positions, &net).freedoms(), 2);
//! assert_eq!(algebraic_connectivity(&Adjacency::from(&net)), Some(0.0));
//! let lattice = &positions[..6];
//! assert!(Rigidity::new(lattice, &Net::new(lattice, 1.2)).is_rigid());
//! ```

mod adjacency;
mod components;
mod crossing;
mod digraph;
mod energy;
mod links;
pub mod neighborhood;
mod planarity;
mod realisation;
mod rigidity;
mod spectrum;
mod uniform;
mod vote;

pub use adjacency::Adjacency;
pub use components::Components;
pub use crossing::crossings;
pub use digraph::is_strongly_connected;
pub use energy::{link_energy, potential_gradient, structural_energy, structural_potential};
pub use links::LinkChanges;
pub use planarity::is_planar;
pub use realisation::{defect, is_realisation, normalised_defect, realisation_error};
pub use rigidity::{RANK_TOLERANCE, Rigidity};
pub use spectrum::{algebraic_connectivity, symmetric_connectivity};
pub use uniform::Net;
pub use vote::{Verdict, Vote, vote_weight, votes};
