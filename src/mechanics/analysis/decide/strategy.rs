//! The strategies that decide a component by linear programs (route 3), and their order. The first strategy is a closed
//! form. Each other strategy solves one program for forces, a motion, or both.

use std::fmt;

use crate::mechanics::program::Program;
use crate::mechanics::solve::{
    Balance, Choice, Conditioning, SolverSettings, any_balance, balance_at_first_look, balance_in, collapse,
    least_adhesion_in, least_residual,
};

/// How a component was decided. The variants are ordered: the result of a frame names the last method among those of
/// its components.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Method {
    /// Without a solver: balance alone determines the forces, or no force is needed.
    ClosedForm,
    /// By the program of least force, solved through its dual, the kinematic program. Its name in results is
    /// `kinematic`.
    LeastForce,
    /// By the same program with the solver's own scaling and refinement.
    LeastForceRefined,
    /// By the program of least residual, or by the program that finds any balancing forces.
    LeastResidual,
    /// By the program of least adhesion. Its name in results is `least sticking`.
    LeastSticking,
}

impl Method {
    /// Returns the name of this method in results, such as `least residual`.
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

/// What is known beforehand about a component's distance from its limit of stability.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::mechanics::analysis) enum LimitDistance {
    /// Nothing is known.
    Unknown,
    /// The component is at its limit of stability, or very near it.
    AtLimit,
}

/// One way to decide a component: a closed form or a program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Strategy {
    /// Closed form: forces that balance alone determines, and the mechanism if they are not admissible.
    Determinate,
    /// The program of least force, stopped after a few iterations; for large programs.
    FirstLook(SolverSettings),
    /// The program of least force, solved to the end.
    Force(SolverSettings),
    /// The program of any balance: forces that balance, regardless of their sum, or a motion.
    AnyBalance,
    /// The program of least residual: the forces with the least imbalance, and a motion.
    Residual,
    /// The program of least adhesion.
    Adhesion(SolverSettings),
}

impl Strategy {
    /// Returns the strategies in the order in which they are tried: from the fastest strategy to the strategy that
    /// decides closest to the limit.
    ///
    /// 1. Closed form, if the equilibrium equations alone determine all forces.
    /// 2. Least force. It decides nearly every component, and figures show its forces.
    /// 3. Any balance, then least residual. They have an optimum on both sides of the limit, where least force may end
    ///    without a result.
    /// 4. Least force with full conditioning, only for few blocks.
    /// 5. Least adhesion, first with plain and then with full conditioning. Its optimum is the sum of the missing forces.
    ///    It distinguishes best between a sum of 0 and a sum of almost 0.
    ///
    /// Three cases differ:
    ///
    /// - At the limit (`LimitDistance::AtLimit`) step 3 comes first.
    /// - Large programs begin with a short attempt with least force. If failures are requested, least adhesion comes
    ///   before least residual: a large component that falls needs least adhesion in any case, and least residual takes
    ///   nearly as long.
    /// - If only the verdict is requested, large programs begin with any balance. For falling walls of 410 and 915
    ///   bricks, any balance takes 9 to 20 iterations and least force takes 9 to 60. The short attempt with least force
    ///   comes next, because any balance gives no strong proof for a stack of 10 000 blocks.
    ///
    /// `settings` have plain and full conditioning.
    pub fn in_order(program: &Program, settings: [SolverSettings; 2], limit_distance: LimitDistance) -> Vec<Strategy> {
        use Strategy::{Adhesion, AnyBalance, Determinate, FirstLook, Force, Residual};
        let [plain, full] = settings;
        let only_verdict = plain.choice == Choice::Any;
        let unique = SolverSettings { choice: Choice::Unique, ..plain };
        match limit_distance {
            LimitDistance::AtLimit => {
                vec![Determinate, AnyBalance, Residual, Force(plain), Force(full), Adhesion(plain), Adhesion(full)]
            }
            _ if !program.has_many_blocks() => {
                vec![Determinate, Force(plain), AnyBalance, Residual, Force(full), Adhesion(plain), Adhesion(full)]
            }
            _ if only_verdict => vec![
                Determinate,
                AnyBalance,
                FirstLook(unique),
                Residual,
                Force(plain),
                Adhesion(plain),
                Adhesion(full),
            ],
            _ => {
                vec![Determinate, FirstLook(plain), AnyBalance, Adhesion(plain), Residual, Force(plain), Adhesion(full)]
            }
        }
    }

    /// Solves the program of this strategy, or evaluates its closed form. The result is in the program's units and not
    /// yet proved.
    pub fn attempt(&self, program: &Program) -> Balance {
        match self {
            Strategy::Determinate => collapse(program).unwrap_or_default(),
            Strategy::FirstLook(settings) => balance_at_first_look(program, *settings),
            Strategy::Force(settings) => balance_in(program, *settings),
            Strategy::AnyBalance => any_balance(program),
            Strategy::Residual => least_residual(program),
            Strategy::Adhesion(settings) => least_adhesion_in(program, *settings),
        }
    }

    /// True if an attempt whose forces could not be proved shows that no forces balance the loads. Only the programs of
    /// any balance, least residual and least adhesion can show this. They always have an optimum, and this optimum
    /// balances the loads if any forces do.
    pub fn excludes_balance(&self, attempt: &Balance) -> bool {
        match self {
            Strategy::Determinate | Strategy::FirstLook(_) | Strategy::Force(_) => false,
            Strategy::AnyBalance | Strategy::Residual => attempt.forces.is_some(),
            // If the solver ended without a result, the attempt shows nothing.
            Strategy::Adhesion(_) => attempt.motion.is_some(),
        }
    }

    /// True if the attempt gives the least adhesion and its motion. The motion of the closed form has fewer moving
    /// joints.
    pub fn finds_adhesion(&self) -> bool {
        matches!(self, Strategy::Adhesion(_))
    }

    pub fn method(&self) -> Method {
        match self {
            Strategy::Determinate => Method::ClosedForm,
            Strategy::Force(settings) if settings.conditioning == Conditioning::Full => Method::LeastForceRefined,
            Strategy::FirstLook(_) | Strategy::Force(_) => Method::LeastForce,
            Strategy::AnyBalance | Strategy::Residual => Method::LeastResidual,
            Strategy::Adhesion(_) => Method::LeastSticking,
        }
    }
}
