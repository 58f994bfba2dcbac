//! Tries larger gaps on bodies that overlap or touch nothing, so that a message can name a `--gap` that helps.

use std::collections::BTreeSet;

use super::draft::{Draft, short};
use super::name::Names;
use super::outline::{Body, Outlines};
use super::{Remark, scene_file};
use crate::geometry::{ConvexPieces, Polygon, overlap};
use crate::mechanics::scene::format::SceneFile;
use crate::mechanics::scene::{BlockId, BodyId, Code, Place, Problem, Scene, SceneError};
use crate::mechanics::statics::interface::Interfaces;
use crate::text::first_of;

/// In drawings with more bodies, no gaps are tried, because each trial takes as long as the import.
const MAX_BODIES: usize = 500;
/// The largest number of overlaps that a message lists.
const MAX_LISTED_OVERLAPS: usize = 5;

/// The bodies of a drawing before they are snapped together, with what is needed to make a scene of them.
pub(super) struct Trial<'t> {
    pub(super) drawn: Outlines,
    pub(super) names: &'t Names,
    /// The size of the drawing and the gap that was used, in metres.
    pub(super) size: f64,
    pub(super) gap: f64,
}

/// Checks the text of a scene. Nearby edges are already snapped together, so no overlap beyond the tolerance is allowed.
pub(super) fn checked(text: &str) -> Result<Scene, SceneError> {
    let scene = Scene::from_json(text)?;
    if scene.penetrations.is_empty() { Ok(scene) } else { Scene::from_json_within(text, Some(scene.tolerance.gap)) }
}

impl Trial<'_> {
    /// Returns the scene that an import with another gap gives; `None` if its bodies overlap.
    fn scene(&self, gap: f64) -> Option<Scene> {
        let mut tried = self.drawn.clone();
        tried.snap(&mut Draft::default(), self.names, gap);
        let given = SceneFile::default();
        let scene =
            scene_file::scene(&tried, self.names, &mut Draft::default(), String::new(), [self.size, gap], &given);
        checked(&scene.to_json()).ok()
    }

    /// Returns one problem for all overlaps, which names a gap that closes them. `None` if there are other problems.
    pub(super) fn overlaps(&self, snapped: &Outlines, problems: &[Problem]) -> Option<Remark> {
        let ground = snapped.ground();
        let pair = |problem: &Problem| -> Option<(f64, [&Body; 2])> {
            let (Code::Overlap, Some(Place::Between(_, other))) = (problem.code, problem.place) else {
                return None;
            };
            let number = match other {
                BodyId::Ground(i) => i,
                BodyId::Block(block) => ground + block.0,
            };
            let bodies = [snapped.body_of(problem)?, snapped.bodies.get(number)?];
            let [one, two] = bodies.map(|b| b.polygon());
            let depth = overlap(&ConvexPieces::new(&one?), &ConvexPieces::new(&two?), 0.0).map_or(0.0, |o| o.depth);
            Some((depth, bodies))
        };
        let mut pairs: Vec<(f64, [&Body; 2])> = problems.iter().map(pair).collect::<Option<_>>()?;
        pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
        let deepest = pairs.first()?.0;
        let gaps = [1.1, 1.6, 2.5, 4.0].map(|times| rounded_up(times * deepest));
        let closing = gaps.into_iter().find(|gap| *gap > self.gap && self.may_try() && self.scene(*gap).is_some());
        let help = match closing {
            Some(gap) => format!("--gap {gap} closes them"),
            None => "draw the outlines so that they only touch".into(),
        };
        if let [only] = problems {
            let remark = snapped.located(only);
            return Some(match closing {
                Some(_) => Remark { help: help.replace("them", "it"), ..remark },
                None => remark,
            });
        }
        let named = |(depth, [one, two]): &(f64, [&Body; 2])| {
            format!("{} and {} ({} m)", two.element, one.element, short(*depth))
        };
        let list = first_of(pairs.iter().map(named).collect::<Vec<String>>(), MAX_LISTED_OVERLAPS);
        let message = format!("{} pairs of bodies overlap, by up to {} m: {list}", pairs.len(), short(deepest));
        Some(Remark::new("", message, help))
    }

    /// Returns a note about blocks that touch no other body, which names a gap that would join them. `None` if every
    /// block touches another body or is held by a robot.
    pub(super) fn lonely(&self, scene: &Scene, snapped: &Outlines) -> Option<String> {
        let alone = alone(scene);
        let blocks = scene.blocks.len();
        if alone.is_empty() || snapped.bodies.len() < 2 {
            return None;
        }
        let count = match alone.len() {
            1 if blocks == 1 => "the only block touches".to_owned(),
            1 => format!("1 of {blocks} blocks touches"),
            n => format!("{n} of {blocks} blocks touch"),
        };
        let polygons: Vec<Polygon> = snapped.bodies.iter().filter_map(Body::polygon).collect();
        let mut distances: Vec<f64> = Vec::new();
        if self.may_try() && polygons.len() == snapped.bodies.len() {
            distances.extend(alone.iter().map(|block| nearest(&polygons, snapped.ground() + block)));
        }
        distances.sort_by(f64::total_cmp);
        // Some blocks may be meant to stand apart, so the gap need not join the last tenth.
        let usual = distances.get((9 * distances.len()).div_ceil(10).saturating_sub(1)).copied();
        let gaps = usual.map_or([0.0; 3], |usual| [1.05, 1.5, 2.0].map(|times| rounded_up(times * usual)));
        let tried = gaps.into_iter().filter(|gap| *gap > self.gap);
        let best =
            tried.filter_map(|gap| Some((self::alone(&self.scene(gap)?).len(), gap))).min_by_key(|tried| tried.0);
        Some(match best {
            Some((0, gap)) => {
                let them = if alone.len() == 1 { "it" } else { "them" };
                format!("{count} no other body; --gap {gap} would join {them}")
            }
            Some((left, gap)) if 2 * left <= alone.len() => {
                format!("{count} no other body; --gap {gap} would join all but {left} of them")
            }
            _ => format!("{count} no other body"),
        })
    }

    fn may_try(&self) -> bool {
        self.drawn.bodies.len() <= MAX_BODIES
    }
}

/// Returns the blocks that touch no other body and that no robot holds.
fn alone(scene: &Scene) -> Vec<usize> {
    let mut touching: BTreeSet<BodyId> = Interfaces::new(scene).all.iter().flat_map(|i| i.bodies).collect();
    touching.extend(scene.robots.iter().filter_map(|robot| Some(BodyId::Block(robot.holds?.block))));
    (0..scene.blocks.len()).filter(|i| !touching.contains(&BodyId::Block(BlockId(*i)))).collect()
}

/// Returns the distance of a body from the nearest other body, in metres.
fn nearest(polygons: &[Polygon], own: usize) -> f64 {
    let mine = &polygons[own];
    let mut least = f64::INFINITY;
    for (i, other) in polygons.iter().enumerate() {
        if i != own && mine.bounds().grown(least).intersects(other.bounds()) {
            for (one, two) in [(mine, other), (other, mine)] {
                least = one.rings().iter().flatten().map(|corner| two.distance(*corner)).fold(least, f64::min);
            }
        }
    }
    least
}

/// Rounds a length up to two significant digits.
fn rounded_up(length: f64) -> f64 {
    let step = libm::pow(10.0, libm::floor(libm::log10(length)) - 1.0);
    let rounded = (length / step).ceil() * step;
    format!("{rounded:.1e}").parse().unwrap_or(rounded)
}
