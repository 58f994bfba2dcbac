//! Gives every block and robot a unique name.

use std::collections::{BTreeMap, BTreeSet};

use super::draft::Role;
use super::outline::Outlines;

/// The names of bodies and robots in the scene and in messages.
pub(super) struct Names {
    /// One name for each body: the id of a block, or `ground[0]` for a part of the ground.
    pub(super) bodies: Vec<String>,
    pub(super) robots: Vec<String>,
}

/// Returns a unique name for each body and robot. If a name is already used, a number is added to it. A block without a
/// name is named by its number, from 1. A robot without a name is named by `r` and its number, from 0. The first part
/// of the ground is `ground[0]`.
pub(super) fn unique_names(outlines: &Outlines) -> Names {
    // The name "ground" is reserved, because results use it for the ground.
    let mut taken = TakenNames::with("ground");
    let given_names: BTreeSet<&str> = outlines.bodies.iter().map(|b| b.name.as_str()).collect();
    let ground = outlines.ground();
    let mut bodies = Vec::new();
    for (i, body) in outlines.bodies.iter().enumerate() {
        bodies.push(match (body.kind, body.name.as_str()) {
            (Role::Ground, _) => format!("ground[{i}]"),
            (_, "") => taken.first_free("", i + 1 - ground, &given_names),
            (_, name) if taken.names.insert(name.to_owned()) => name.to_owned(),
            (_, name) => taken.first_free(&format!("{name}-"), 2, &given_names),
        });
    }
    let mut taken = TakenNames::default();
    let given_names: BTreeSet<&str> = outlines.robots.iter().map(|r| r.name.as_str()).collect();
    let mut robots = Vec::new();
    for (i, robot) in outlines.robots.iter().enumerate() {
        robots.push(match robot.name.as_str() {
            "" => taken.first_free("r", i, &given_names),
            name if taken.names.insert(name.to_owned()) => name.to_owned(),
            name => taken.first_free(&format!("{name}-"), 2, &given_names),
        });
    }
    Names { bodies, robots }
}

#[derive(Default)]
struct TakenNames {
    names: BTreeSet<String>,
    /// The next number to try for each stem. Smaller numbers are not tried again, so naming n duplicates takes about n
    /// steps.
    last: BTreeMap<String, usize>,
}

impl TakenNames {
    fn with(name: &str) -> TakenNames {
        TakenNames { names: BTreeSet::from([name.to_owned()]), ..TakenNames::default() }
    }

    /// Returns `stem` with the first number, from `from` on, that makes a free name. A name is free if it is neither
    /// taken nor in `given_names`.
    fn first_free(&mut self, stem: &str, from: usize, given_names: &BTreeSet<&str>) -> String {
        let last = self.last.entry(stem.to_owned()).or_default();
        let mut number = from.max(*last);
        loop {
            let name = format!("{stem}{number}");
            if !given_names.contains(name.as_str()) && self.names.insert(name.clone()) {
                *last = number + 1;
                return name;
            }
            number += 1;
        }
    }
}
