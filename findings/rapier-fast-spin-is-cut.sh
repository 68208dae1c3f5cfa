#!/usr/bin/env bash
# rapier2d-f64 0.36.1: a free body that spins fast is braked, and loses energy.
#
# Angular velocities are cut to an eighth of a full turn a step, π/4 over the step, unless
# `allow_fast_rotation` is set on the body; the cut stays in `angvel`. One would expect an angular
# velocity that nothing acts on to stay, or a limit on turning to be said with the step's
# parameters. A body of 0.1 that is struck at its rim at 10 a unit of time has more.
#
# Seen: 100 radians a second become 78.54 within one step of 0.01, with the flag they stay.
# Fails if they stay without it, or do not with it.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir src
cat > Cargo.toml <<'TOML'
[package]
name = "finding"
version = "0.0.0"
edition = "2024"

[dependencies]
rapier2d-f64 = "=0.36.1"
TOML
cat > src/main.rs <<'RUST'
use rapier2d_f64::prelude::*;

/// What an angular velocity of 100 becomes in one step.
fn after(allowed: bool) -> f64 {
    let mut world = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
    world.integration_parameters.dt = 0.01;
    let body = RigidBodyBuilder::dynamic()
        .angvel(100.0)
        .allow_fast_rotation(allowed)
        .can_sleep(false);
    let body = world.insert(body, ColliderBuilder::cuboid(1.0, 0.2)).0;
    world.step();
    world.bodies[body].angvel()
}

fn main() {
    let [cut, kept] = [false, true].map(after);
    println!("after one step: {cut}; with fast rotation allowed: {kept}");
    std::process::exit(if (cut - 78.54).abs() < 0.01 && kept == 100.0 { 0 } else { 1 });
}
RUST
cargo run --quiet
