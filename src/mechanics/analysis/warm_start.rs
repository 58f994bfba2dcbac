//! Route 0 (warm start): decides a frame quickly, starting from the active set of the previous frame.
//!
//! The balance is a nonnegative least-squares problem ([`BoundedNnls`]). If its residual is 0, its solution balances
//! the frame. Otherwise the negative residual is a motion by which the frame falls. The active set of one frame is
//! the start for the next, so a small change costs little time. Forces and motion are proved as in a complete
//! analysis. Without a proof the frame is analysed as in [`Analysis`]. A warm start therefore saves
//! time, but cannot change a verdict.

use super::analyse::{ResultCache, analyse_frame};
use super::decide::Candidate;
use super::{Analysis, Options, Verdict};
use crate::mechanics::program::{Column, Force, Program, Scale};
use crate::mechanics::scene::{BlockId, BodyId, Frame, RobotId, Scene, ToleranceSource};
use crate::mechanics::solve::{Amounts, BoundedNnls, generators};
use crate::mechanics::statics::assembly::Assembly;
use crate::mechanics::statics::effect::{self, FrameContext};
use crate::mechanics::statics::interface::{Interface, Interfaces};

/// Without an active set to start from, a conic solver is faster than an active-set method for more bodies than this.
const MAX_NEW_BODIES: usize = 40;
/// With an active set to start from, a conic solver is faster for more bodies than this.
const MAX_BODIES: usize = 500;

/// The units of the program are chosen again if lengths or loads become this many times larger or smaller.
const MAX_SCALE_RATIO: f64 = 100.0;

/// Returns only the verdicts of all frames. They are equal to the verdicts of [`Analysis::with`].
///
/// ```
/// use drystone::{Scene, analysis::{Options, Verdict, verdicts}};
/// let scene = Scene::from_json(r#"{ "drystone": 1, "friction": 0.5,
///     "ground": [{ "polygon": [[0, 0], [9, 0], [9, -1], [0, -1]] }],
///     "blocks": [{ "id": "a", "polygon": [[1, 0], [4, 0], [4, 2], [1, 2]] },
///                { "id": "b", "polygon": [[3, 2], [8, 2], [8, 3], [3, 3]] }],
///     "steps": [{ "place": ["a"] }, { "place": ["b"] }] }"#)?;
/// assert_eq!(verdicts(&scene, &Options::default()), [Verdict::Stable, Verdict::Unstable]);
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
pub fn verdicts(scene: &Scene, options: &Options) -> Vec<Verdict> {
    let options = &options.verdict_only(true);
    let found = Interfaces::new(scene);
    if hinges_on_gaps(scene, &found) || scene.has_conditions() {
        let frames = Analysis::with(scene, &options.only_verdict()).frames;
        return frames.iter().map(|frame| frame.verdict).collect();
    }
    let mut warm_start = WarmStart::default();
    let frames = scene.frames.iter();
    frames
        .map(|frame| {
            let interfaces = found.in_frame(frame);
            warm_start.verdict(scene, frame, &interfaces, options).0
        })
        .collect()
}

/// True if verdicts may depend on narrow gaps, overlaps or very short contacts. The analysis must then decide every
/// frame twice: with and without them.
pub(crate) fn hinges_on_gaps(scene: &Scene, found: &Interfaces) -> bool {
    let none = found.near_misses.is_empty() && found.slivers.is_empty() && scene.penetrations.is_empty();
    scene.healed.source != ToleranceSource::Given && !none
}

/// How a verdict was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Source {
    /// From the active set of the previous frame, updated for the changes.
    WarmStart,
    /// By a complete analysis.
    Examined,
}

/// The state that one frame passes to the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct WarmStart {
    active_set: BoundedNnls,
    /// The columns to which the active set refers, and the first column of each contact and grip.
    columns: Vec<Column>,
    begins: Vec<(usize, Origin)>,
    scale: Option<Scale>,
}

/// Identifies the contact or grip of a column in every frame. A contact has two bodies and one end of their
/// interface; a grip has a robot, its block and the grip point. Coordinates are compared by their bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Origin {
    Contact([BodyId; 2], [u64; 2]),
    Grip(RobotId, BlockId, [u64; 2]),
}

impl WarmStart {
    /// Returns the verdict of a frame, and how it was found: by the warm start or by a complete analysis.
    pub(crate) fn verdict(
        &mut self,
        scene: &Scene,
        frame: &Frame,
        interfaces: &[&Interface],
        options: &Options,
    ) -> (Verdict, Source) {
        let context = FrameContext { scene, frame, interfaces };
        if !options.is_late() {
            let (assembly, _) = effect::assemble(&context);
            if let Some(verdict) = self.decide_verdict(&assembly, *options) {
                return (verdict, Source::WarmStart);
            }
        }
        let options = options.only_verdict();
        let verdict = analyse_frame(&context, options, &mut ResultCache::default()).verdict;
        (verdict, Source::Examined)
    }

    /// Decides an assembly by the warm start alone. `None` if the assembly has too many bodies, or if neither forces
    /// nor a motion are proved.
    fn decide_verdict(&mut self, assembly: &Assembly, options: Options) -> Option<Verdict> {
        // Without an active set from an earlier frame, the warm start is fast only for few bodies.
        let most = if self.columns.is_empty() { MAX_NEW_BODIES } else { MAX_BODIES };
        if assembly.bodies.len() > most {
            *self = WarmStart::default();
            return None;
        }
        // Write the equilibrium equations in dimensionless numbers, in the scale of the earlier frames.
        let scale = self.scale(assembly);
        let program = Program::new(assembly, scale);
        let columns = generators(&program);
        self.move_to(assembly, columns);
        // Find the forces with the least residual. If the residual is 0, the frame stands. Otherwise the negative
        // residual is a motion by which the frame falls.
        let Some(residual) = self.active_set.find(&program.loads, &self.columns) else {
            *self = WarmStart::default();
            return None;
        };
        let amounts: Amounts = self.active_set.to_forces(&program, &self.columns);
        Candidate::new(assembly, scale, options).verdict(&amounts, &residual)
    }

    /// Returns the scale of the earlier frames. If it does not suit this assembly, discards the warm start and returns
    /// the scale of the assembly.
    fn scale(&mut self, assembly: &Assembly) -> Scale {
        let own = Scale::from_assembly(assembly);
        let near = |a: f64, b: f64| a <= MAX_SCALE_RATIO * b && b <= MAX_SCALE_RATIO * a;
        match self.scale {
            Some(scale) if near(scale.length, own.length) && near(scale.force, own.force) => scale,
            _ => {
                *self = WarmStart { scale: Some(own), ..WarmStart::default() };
                own
            }
        }
    }

    /// Transfers the active set to the columns of the next frame. Keeps a column only if its coefficients are
    /// unchanged.
    fn move_to(&mut self, assembly: &Assembly, columns: Vec<Column>) {
        let begins = begins(assembly, &columns);
        let mut new: Vec<(Origin, usize)> = begins.iter().map(|(k, origin)| (*origin, *k)).collect();
        new.sort_unstable();
        let (old, old_begins) = (&self.columns, &self.begins);
        self.active_set.renumber(|k| {
            // Find the contact or grip that the old column belongs to. Then find the corresponding column of this
            // contact or grip in the new frame.
            let place = old_begins.partition_point(|(begin, _)| *begin <= k);
            let (begin, origin) = old_begins.get(place.checked_sub(1)?)?;
            let place = new.binary_search_by(|(other, _)| other.cmp(origin)).ok()?;
            let number = new[place].1 + (k - begin);
            let (was, is) = (old.get(k)?, columns.get(number)?);
            was.has_values_of(is).then_some(number)
        });
        self.columns = columns;
        self.begins = begins;
    }
}

/// Returns, for each contact and grip, the index of its first column, in the order of the columns.
fn begins(assembly: &Assembly, columns: &[Column]) -> Vec<(usize, Origin)> {
    let bits = |p: crate::geometry::Point| [p.x.to_bits(), p.y.to_bits()];
    let mut begins: Vec<(usize, Origin)> = Vec::new();
    for (k, column) in columns.iter().enumerate() {
        let origin = match column.force {
            Force::Ray { contact, .. } => {
                let contact = &assembly.contacts[contact];
                Origin::Contact(contact.bodies, bits(contact.ends[0]))
            }
            Force::Grip { grip, .. } => {
                let grip = &assembly.grips[grip];
                Origin::Grip(grip.robot, assembly.bodies[grip.body].block, bits(grip.at))
            }
            // The warm start has only columns of contacts and of grips, without adhesion.
            _ => continue,
        };
        if begins.last().is_none_or(|(_, last)| *last != origin) {
            begins.push((k, origin));
        }
    }
    begins
}
