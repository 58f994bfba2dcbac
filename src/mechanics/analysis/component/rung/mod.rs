//! The rungs of the ladder, one file each: what is posed, and why there.

mod determinate;
mod least_force;
mod least_residual;
mod least_sticking;

use std::fmt;

use crate::program::Program;
use crate::solve::{Amounts, Choice, Conditioning, Effort, SolverSettings, Stuck};

/// From so many blocks on a program is a large one.
pub(super) const MANY_BLOCKS: usize = 200;

/// How a component was decided, in the order of trust.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Method {
    /// Without a solver.
    ClosedForm,
    /// By the program of least force, through its dual, the kinematic program.
    LeastForce,
    /// By the same, with the solver's own scaling and refinement.
    LeastForceRefined,
    /// By the program of least residual.
    LeastResidual,
    /// By the program of least sticking.
    LeastSticking,
}

impl Method {
    /// Its name in results.
    pub fn name(self) -> &'static str {
        match self {
            Method::ClosedForm => "closed form",
            Method::LeastForce => "kinematic",
            Method::LeastForceRefined => "kinematic, refined",
            Method::LeastResidual => "least residual",
            Method::LeastSticking => "least sticking",
        }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Where a component is, as far as that is known beforehand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::mechanics::analysis) enum Place {
    /// Nothing is known.
    Anywhere,
    /// At the edge of standing.
    AtEdge,
}

/// One program that may decide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Strategy {
    /// The mechanism of what is statically determinate.
    Determinate,
    /// Least force of many blocks, given up early.
    FirstLook(SolverSettings),
    /// Least force.
    Force(SolverSettings),
    /// Any balance, whatever its forces.
    Any,
    /// Least residual.
    Residual,
    /// Least sticking.
    Sticking(SolverSettings),
}

/// What a rung found, in pure numbers and without a proof.
pub(super) struct Attempt {
    /// Forces that should balance.
    pub forces: Option<Amounts>,
    /// A motion that should be a mechanism.
    pub motion: Option<Vec<f64>>,
    /// Of the program of least force: the motion that says how small a sum of forces can balance.
    pub witness: Option<Vec<f64>>,
    /// What the program of least sticking gave, where it was posed.
    pub stuck: Option<Stuck>,
    pub effort: Effort,
}

impl Attempt {
    /// The forces, of the least sticking too.
    pub fn unproved_forces(&self) -> Option<&Amounts> {
        let stuck = self.stuck.as_ref().map(|stuck| &stuck.forces);
        self.forces.as_ref().or(stuck)
    }
}

impl Strategy {
    /// From the quickest to the one that decides nearest to the edge.
    ///
    /// What is statically determinate needs no program: what its forces lack is known, and what gives way. Else
    /// least force first, as nearly every component is decided there; then any balance and the least residual, which have
    /// answers on either side of the edge; then least force with full precision; last the least sticking, whose optimum is the
    /// physical residual.
    ///
    /// What is known to be at its edge begins with any balance: the least force would end without a status there.
    /// So do many blocks where any forces will do: walls of 410 and 915 bricks that fall take it 9 to 20 iterations, and
    /// the least force 9 to 60; where they stand it is the same to either. Where that has no proof the first look comes next:
    /// of a stack of 10 000 neither forces nor motion of any balance convince, those of the least force do, and the least
    /// residual ends without a status.
    ///
    /// What falls wants its least sticking in any case, so that many blocks that have no balance come to it before the least
    /// residual, which takes them nearly as long and says less.
    pub fn ladder(
        program: &Program,
        settings: &[SolverSettings],
        place: Place,
        described: bool,
    ) -> Vec<Strategy> {
        let mut rungs: Vec<Strategy> = settings.iter().copied().map(Strategy::Force).collect();
        let many = program.blocks >= MANY_BLOCKS;
        let any = settings.iter().all(|s| s.choice == Choice::Any);
        let plain = |s: &&SolverSettings| s.conditioning == Conditioning::Plain;
        let quick = settings.iter().find(plain).copied();
        let residual = [Strategy::Any, Strategy::Residual];
        match place {
            Place::Anywhere if many && !any => {
                rungs.splice(0..0, residual);
                if described {
                    rungs.splice(1..1, quick.map(Strategy::Sticking));
                }
                rungs.splice(0..0, quick.map(Strategy::FirstLook));
            }
            Place::Anywhere if many => {
                rungs.splice(0..0, residual);
                let unique = |settings| SolverSettings {
                    choice: Choice::Unique,
                    ..settings
                };
                rungs.splice(1..1, quick.map(unique).map(Strategy::FirstLook));
            }
            Place::Anywhere => {
                let second = 1.min(rungs.len());
                rungs.splice(second..second, residual);
            }
            Place::AtEdge => {
                rungs.splice(0..0, residual);
            }
        }
        rungs.insert(0, Strategy::Determinate);
        for settings in settings.iter().copied().map(Strategy::Sticking) {
            if !rungs.contains(&settings) {
                rungs.push(settings);
            }
        }
        rungs
    }

    pub fn attempt(&self, program: &Program) -> Attempt {
        match self {
            Strategy::Determinate => determinate::attempt(program),
            Strategy::FirstLook(settings) => least_force::first_look(program, *settings),
            Strategy::Force(settings) => least_force::attempt(program, *settings),
            Strategy::Any => least_residual::any(program),
            Strategy::Residual => least_residual::attempt(program),
            Strategy::Sticking(settings) => least_sticking::attempt(program, *settings),
        }
    }

    /// Whether its forces are those of least sum.
    pub fn is_least(&self) -> bool {
        matches!(self, Strategy::Force(_))
    }

    /// Whether its forces come so near to a balance that, where they have no proof, none have.
    pub fn excludes_balance(&self, attempt: &Attempt) -> bool {
        match self {
            Strategy::Determinate | Strategy::FirstLook(_) | Strategy::Force(_) => false,
            Strategy::Any | Strategy::Residual => attempt.forces.is_some(),
            Strategy::Sticking(_) => attempt.stuck.is_some(),
        }
    }

    pub fn method(&self) -> Method {
        match self {
            Strategy::Determinate => Method::ClosedForm,
            Strategy::FirstLook(_) => Method::LeastForce,
            Strategy::Force(settings) if settings.conditioning == Conditioning::Plain => {
                Method::LeastForce
            }
            Strategy::Force(_) => Method::LeastForceRefined,
            Strategy::Any | Strategy::Residual => Method::LeastResidual,
            Strategy::Sticking(_) => Method::LeastSticking,
        }
    }
}
