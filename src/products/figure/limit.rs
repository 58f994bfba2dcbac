//! Finds joints at their limit in the forces shown: all friction is used, or the resultant acts at an edge.

use super::bearing::{Bearing, bearings};
use super::context::FigureContext;
use super::description;
use super::words::{FULL, percent};
use crate::analysis::{Contact, FrameAnalysis, Verdict};
use crate::drawing::{Item, Outline, PagePoint, Path, Theme};
use crate::interface::ContactKind;
use crate::scene::Scene;

/// A resultant acts at the edge if its distance from an end of the joint is below this share of the joint's length.
const AT_EDGE: f64 = 0.01;

/// How near a joint is to its limit.
struct Nearness<'a> {
    contact: &'a Contact,
    /// The used share of the available friction; 0 if no friction is available.
    friction: f64,
    /// The distance of the resultant from the middle, as a share of the distance to the edge; 0 for a corner.
    edge: f64,
}

impl Nearness<'_> {
    fn reached(&self) -> bool {
        self.friction >= FULL || self.edge >= 1.0 - 2.0 * AT_EDGE
    }

    fn share(&self) -> f64 {
        self.friction.max(self.edge)
    }
}

fn nearness<'a>(scene: &Scene, found: &'a FrameAnalysis) -> Vec<Nearness<'a>> {
    if found.verdict != Verdict::Stable {
        return Vec::new();
    }
    let bearings = bearings(scene, found);
    let pressed = found.contacts.iter().zip(bearings);
    let near = |(contact, bearing): (&'a Contact, Option<Bearing>)| {
        let friction = bearing?.friction.unwrap_or(0.0);
        let [from, to] = contact.interface.ends;
        let at = contact.resultant.at;
        let off = ((at - from).norm() - (at - to).norm()).abs();
        let edge = match contact.interface.kind {
            ContactKind::Corner => 0.0,
            _ => off / contact.interface.length(),
        };
        Some(Nearness {
            contact,
            friction,
            edge,
        })
    };
    pressed.filter_map(near).collect()
}

/// Returns the joints of a frame that are at their limit. There are none if the frame does not stand.
pub(crate) fn reached<'a>(scene: &Scene, found: &'a FrameAnalysis) -> Vec<&'a Contact> {
    let all = nearness(scene, found).into_iter();
    all.filter(Nearness::reached).map(|n| n.contact).collect()
}

/// Shares whose relative difference is below this count as equal.
const SAME_SHARE: f64 = 1e-6;

/// A joint with a smaller share than this is not named, because it would be shown as 0 % or be noise.
const MIN_NAMED_SHARE: f64 = 0.01;

/// Describes the joints at their limit, or else the joint nearest to its limit. Empty if no joint is near its limit,
/// for printed or zoomed figures, and for several frames, whose panels have no space for it.
pub(crate) fn sentence(context: &FigureContext<'_>, frame: usize) -> String {
    let (scene, found) = (&context.analysis.scene, &context.analysis.frames[frame]);
    let options = context.options;
    if context.analysis.frames.len() > 1 || options.printed() || options.zoom.is_some() {
        return String::new();
    }
    let all = nearness(scene, found);
    let at_limit = all.iter().filter(|n| n.reached()).count();
    // If several shares are equal except for rounding, take the first, so that noise does not change the name.
    let farther = |a: &Nearness, b: &Nearness| b.share() > (1.0 + SAME_SHARE) * a.share();
    let nearest = all.iter().reduce(|a, b| if farther(a, b) { b } else { a });
    let Some(nearest) = nearest.filter(|n| n.share() >= MIN_NAMED_SHARE) else {
        return String::new();
    };
    let pair = description::pair(scene, nearest.contact.interface.bodies);
    let how = match nearest.friction >= nearest.edge {
        true => format!("{} of its friction is used", percent(nearest.friction)),
        false if nearest.reached() => "its resultant acts at the edge".to_owned(),
        false => format!(
            "its resultant is {} of the way from the middle to the edge",
            percent(nearest.edge)
        ),
    };
    match at_limit {
        0 => format!("nearest to its limit: the joint between {pair}, {how}"),
        1 => format!("at its limit in the forces shown: the joint between {pair}, {how}"),
        n => format!("{n} joints are at their limit in the forces shown"),
    }
}

/// Returns the sign of a joint at its limit: a diamond. `radius` is in pixels.
pub(crate) fn sign(at: PagePoint, radius: f64, theme: &Theme) -> Path {
    let r = 1.5 * radius;
    let corners = [(0.0, -r), (r, 0.0), (0.0, r), (-r, 0.0)];
    let outline = Outline::ring(corners.map(|(x, y)| at.moved(x, y)));
    Path::filled(outline, theme.ink).cased(theme.page, 0.35 * radius)
}

/// Draws the sign for the legend.
pub(crate) fn key_sign(at: PagePoint, theme: &Theme) -> Vec<Item> {
    vec![sign(at.moved(5.5, 0.0), 3.2, theme).into()]
}

/// The meaning of the sign in the legend.
pub(crate) const MEANING: &str = "joint at its limit: friction used up, or force at the edge";
