//! Gives every block and robot a unique name.

use std::collections::{BTreeMap, BTreeSet};

use super::draft::Role;
use super::outline::{Body, Outlines};

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
    let ground = outlines.ground();
    let all: BTreeSet<&str> = outlines.bodies.iter().map(|b| b.name.as_str()).collect();
    // The name "ground" is reserved, because results use it for the ground.
    let mut taken = TakenNames { names: BTreeSet::from(["ground".to_owned()]), ..TakenNames::default() };
    let body = |(i, body): (usize, &Body)| match body.kind {
        Role::Ground => format!("ground[{i}]"),
        _ => taken.name(&body.name, "", i + 1 - ground, &all),
    };
    let bodies = outlines.bodies.iter().enumerate().map(body).collect();
    let all: BTreeSet<&str> = outlines.robots.iter().map(|r| r.name.as_str()).collect();
    let mut taken = TakenNames::default();
    let robots = outlines.robots.iter().enumerate();
    let robots = robots.map(|(i, robot)| taken.name(&robot.name, "r", i, &all)).collect();
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
    /// Returns a unique name: the given one, perhaps with a number; without a given one, `stem` and a number from `from`.
    fn name(&mut self, given: &str, stem: &str, from: usize, all: &BTreeSet<&str>) -> String {
        match given {
            "" => self.first_free(stem, from, all),
            _ if self.names.insert(given.to_owned()) => given.to_owned(),
            _ => self.first_free(&format!("{given}-"), 2, all),
        }
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
