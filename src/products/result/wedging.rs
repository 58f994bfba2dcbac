//! The proof that a frame stands only by wedging, as written in JSON.
//!
//! Each motion includes the point of the block to which its velocity refers. The motion can therefore be checked
//! against the interfaces and forces in the same result, without the scene.

use serde::Serialize;

use super::{Number, Pair, arrow, place};
use crate::mechanics::analysis::{FrameAnalysis, Motion, RuledOut, Slide, Wedged};
use crate::mechanics::scene::Scene;

#[derive(Serialize)]
pub(super) struct Wedging<'a> {
    /// The interfaces at which a normal force must act in every balance.
    must_press: Vec<Face<'a>>,
    /// A lower bound of the sum of the normal forces at these interfaces, N.
    #[serde(skip_serializing_if = "Option::is_none")]
    normal_force_at_least: Option<Number>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    bound: Vec<Moving<'a>>,
    gives_way: Vec<Moving<'a>>,
    presses_nothing: bool,
    cases: usize,
    /// The cases that were excluded. If each contact is a spring, they cover all ways in which contacts at rest can
    /// press and slide.
    ruled_out: Vec<Case>,
}

#[derive(Serialize)]
struct Case {
    points: Vec<PointCase>,
    faces: Vec<FaceCase>,
}

#[derive(Serialize)]
struct PointCase {
    /// The index of the interface in `interfaces`, from 0.
    interface: usize,
    /// The index of the application point, 0 or 1.
    point: usize,
    presses: bool,
}

#[derive(Serialize)]
struct FaceCase {
    /// The index of the interface in `interfaces`, from 0.
    interface: usize,
    /// The direction of sliding: `forth` along (−n_y, n_x) of the normal n, `back` opposite to it, or `sticks`
    /// without sliding.
    slides: &'static str,
}

#[derive(Serialize)]
struct Face<'a> {
    /// The index of the interface in `interfaces`, from 0.
    interface: usize,
    bodies: [&'a str; 2],
}

#[derive(Serialize)]
struct Moving<'a> {
    block: &'a str,
    at: Pair,
    velocity: Pair,
    spin: Number,
}

impl Case {
    fn new(case: &RuledOut) -> Case {
        let points =
            case.points.iter().map(|p| PointCase { interface: p.interface, point: p.point, presses: p.presses });
        let faces = case.faces.iter().map(|f| FaceCase {
            interface: f.interface,
            slides: match f.slides {
                Slide::Forth => "forth",
                Slide::Back => "back",
                Slide::Sticks => "sticks",
            },
        });
        Case { points: points.collect(), faces: faces.collect() }
    }
}

impl<'a> Wedging<'a> {
    pub(super) fn new(scene: &'a Scene, frame: &FrameAnalysis, wedged: &Wedged) -> Wedging<'a> {
        let motion = |motions: &[Motion]| {
            let moving = motions.iter().map(|motion| {
                let block = &scene.blocks[motion.block.0];
                Moving {
                    block: &block.id,
                    at: place(block.centroid),
                    velocity: arrow(motion.velocity),
                    spin: Number(motion.spin),
                }
            });
            moving.collect::<Vec<_>>()
        };
        let faces = wedged.interfaces.iter().map(|number| Face {
            interface: *number,
            bodies: frame.contacts[*number].interface.bodies.map(|b| scene.name(b)),
        });
        let least = wedged.at_least.as_ref();
        Wedging {
            must_press: faces.collect(),
            normal_force_at_least: least.map(|(force, _)| Number(*force)),
            bound: least.map_or_else(Vec::new, |(_, bound)| motion(bound)),
            gives_way: motion(&wedged.gives_way),
            presses_nothing: wedged.presses_nothing,
            cases: wedged.ruled_out.len(),
            ruled_out: wedged.ruled_out.iter().map(Case::new).collect(),
        }
    }
}
