//! [`Collapse`]: how a frame falls, or would fall at its headline margin: the picture, the sentence and the joints.

use super::joints::{name, off_hinge};
use super::unit::Units;
use super::{Grid, TableCell};
use crate::mechanics::analysis::{Analysis, FALLS, FrameAnalysis, MarginKind, Motion, SolvedFrame, Verdict};
use crate::products::figure::{At, Fall, Joint, Kind};
use crate::products::wording::failure::unsupported_phrase;
use crate::products::wording::margin::{OtherFriction, governing};
use crate::products::wording::number::{counted, percent};
use crate::text::line;

/// Largest number of joints in the table.
const MAX_JOINTS: usize = 12;

/// The collapse of a frame that falls, or the one just beyond the headline margin of a frame that stands.
pub(super) struct Collapse {
    /// The motion of the blocks.
    mechanism: Vec<Motion>,
    /// The parameter whose figure shows this collapse; `None` if the frame falls, or if no figure shows it.
    toward: Option<MarginKind>,
    /// The margin in words: `carries 2.8 × its loads`. Empty for a frame that falls.
    margin: String,
    /// The friction coefficient of all joints in this collapse, if it is not the present one.
    friction: Option<OtherFriction>,
}

impl Collapse {
    /// Returns the collapse of the frame with index `number`; `None` if it is not known.
    pub fn new(analysis: &Analysis, number: usize) -> Option<Collapse> {
        let solved @ SolvedFrame { found, .. } = analysis.at(number);
        let governing = governing(solved);
        let (mechanism, toward) = match found.verdict {
            Verdict::Undecided => return None,
            // The elementary mechanism is the one that the figure shows.
            Verdict::Unstable => (analysis.alone(number)?.elementary().frames[0].mechanism.clone(), None),
            Verdict::Stable => {
                // The figure of the vehicle shows its own collapse.
                let toward = governing.kind.filter(|kind| kind.changes_loads() && !has_vehicle(found));
                match toward.and_then(|toward| analysis.edge(number, toward)) {
                    Some((_, mechanism)) => (mechanism, toward),
                    None => (governing.mechanism.to_vec(), None),
                }
            }
        };
        let friction = governing.friction.filter(|_| toward.is_none());
        let margin = governing.kind.and(governing.words.into_iter().next());
        let margin = margin.unwrap_or_default();
        (!mechanism.is_empty()).then_some(Collapse { mechanism, toward, margin, friction })
    }

    /// Returns the kind of the figure that shows the collapse, with the margin beyond which it happens.
    pub fn figure(&self, found: &FrameAnalysis) -> Option<(Kind, Option<At>)> {
        match found.verdict {
            Verdict::Unstable => Some((Kind::Mechanism, None)),
            _ => self.toward.map(|toward| (Kind::Mechanism, Some(At::Margin(toward)))),
        }
    }

    /// Describes the collapse: `It carries 2.8 × its loads; beyond, 7 blocks move, with 4 hinges.`
    pub fn words(&self, analysis: &Analysis, number: usize) -> String {
        let fall = Fall::with_friction(analysis, number, &self.mechanism, self.friction);
        let moving = fall.moving().count();
        let moves = if moving == 1 { "moves" } else { "move" };
        let given = self.joints(&fall);
        let count = |kind: &str, is_it: &dyn Fn(&Joint) -> bool| {
            let count = given.iter().filter(|joint| is_it(joint)).count();
            (count > 0).then(|| counted(count, kind))
        };
        let kinds = [
            count("hinge", &|joint| joint.hinge.is_some()),
            count("sliding joint", &|joint| joint.hinge.is_none() && joint.touch.is_none()),
            count("sliding and tipping joint", &|joint| joint.hinge.is_none() && joint.touch.is_some()),
        ];
        let kinds: Vec<String> = kinds.into_iter().flatten().collect();
        let with = if kinds.is_empty() { String::new() } else { format!(", with {}", kinds.join(", ")) };
        let blocks = format!("{} {moves}{with}", counted(moving, "block"));
        match self.margin.as_str() {
            "" => {
                let lost = unsupported_phrase(analysis.at(number)).map_or(String::new(), |w| format!("{w}; "));
                line(&format!("It {FALLS}: {lost}{blocks}."))
            }
            margin => line(&format!("It {margin}; beyond, {blocks}.")),
        }
    }

    /// Returns the joints that open or slide.
    fn joints(&self, fall: &Fall<'_>) -> Vec<Joint> {
        fall.joints.iter().copied().filter(|joint| joint.hinge.is_some() || joint.slip != 0.0).collect()
    }

    /// Makes the table of the joints of the collapse, the nearest to acting first, with a note on its numbers.
    pub fn table(&self, analysis: &Analysis, number: usize) -> (Grid, String) {
        let solved @ SolvedFrame { scene, found, .. } = analysis.at(number);
        let stands = found.verdict == Verdict::Stable;
        let fall = Fall::with_friction(analysis, number, &self.mechanism, self.friction);
        // How far each joint is from acting: 0 if it acts with the listed forces, 1 if it is as far as possible.
        let away = |joint: &Joint| {
            let contact = &found.contacts[joint.contact];
            match joint.hinge {
                Some(hinge) => off_hinge(contact, hinge).unwrap_or(1.0),
                None => 1.0 - contact.friction_used,
            }
        };
        let mut joints: Vec<(Joint, f64)> = self.joints(&fall).into_iter().map(|j| (j, away(&j))).collect();
        if stands {
            joints.sort_by(|a, b| a.1.total_cmp(&b.1));
        }
        let more = joints.len().saturating_sub(MAX_JOINTS);
        joints.truncate(MAX_JOINTS);
        let contacts = || joints.iter().map(|(joint, _)| &found.contacts[joint.contact]);
        let units = Units::new(solved);
        let newtons = units.newtons(contacts().flat_map(|c| [c.normal_force(), c.friction_force]));
        let places = units.lengths(joints.iter().flat_map(|(joint, _)| [joint.at.x, joint.at.y]));
        let point = |joint: &Joint| joint.hinge.unwrap_or(joint.at);
        let mut heads = vec!["joint".to_owned(), "in the collapse".to_owned(), places.head("x"), places.head("y")];
        if stands {
            heads.extend([newtons.head("normal N"), newtons.head("friction T"), "distance to the limit".to_owned()]);
        }
        let mut grid = Grid::new("", &heads);
        for (joint, away) in &joints {
            let contact = &found.contacts[joint.contact];
            let (how, room) = match (joint.hinge, joint.touch) {
                (Some(_), _) => ("hinge", format!("{} of the joint’s length from the hinge", percent(*away))),
                (None, None) => ("slides", format!("{} of the friction unused", percent(*away))),
                (None, Some(_)) => ("slides and tips", format!("{} of the friction unused", percent(*away))),
            };
            let mut cells: Vec<TableCell> = vec![
                name(scene, contact).into(),
                how.into(),
                places.write(point(joint).x).into(),
                places.write(point(joint).y).into(),
            ];
            if stands {
                let room = if contact.normal_force() == 0.0 { "no force".to_owned() } else { room };
                let forces = [contact.normal_force(), contact.friction_force].map(|force| newtons.write(force).into());
                cells.extend(forces);
                cells.push(room.into());
            }
            grid.add(format!("i{}", joint.contact), cells);
        }
        let more = if more > 0 { format!("And {}. ", counted(more, "more joint")) } else { String::new() };
        let note = if stands {
            format!(
                "{more}They act together just beyond the margin. N, T and the distance are those of one possible balance, that of least forces."
            )
        } else {
            more
        };
        (grid, note)
    }
}

/// True if the headline margin of a frame that stands is that of its vehicle.
pub(super) fn has_vehicle(found: &FrameAnalysis) -> bool {
    found.verdict == Verdict::Stable && found.vehicle.as_ref().is_some_and(|own| own.governing.is_some())
}

/// Returns a parameter whose figure shows a collapse, if the headline margin has none: factor on the loads, tilt, or
/// horizontal load.
pub(super) fn other_way(analysis: &Analysis, number: usize) -> Option<MarginKind> {
    let all = [MarginKind::LoadFactor, MarginKind::Tilt, MarginKind::HorizontalLoad];
    all.into_iter().find(|toward| analysis.edge(number, *toward).is_some())
}
