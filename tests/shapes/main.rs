//! Projections onto every obstacle, against brute force and central differences.

mod convex;
