//! [`Row`]: a scene's line in the table of all scenes.

use super::bullet;
use crate::analysis::{Analysis, Verdict};
use crate::drawing::Camera;
use crate::drawing::{Outline, PagePoint, Segment};
use crate::geometry::Bounds;
use crate::text;
use crate::wording::failure;
use crate::wording::number::{percent, quantity};

/// Width and height of a thumbnail, pixels.
const THUMBNAIL: (f64, f64) = (96.0, 60.0);
/// Of more blocks than this a thumbnail shows every so manyth.
const MOST: usize = 400;

/// A scene at a glance.
#[derive(Clone, Debug)]
pub struct Row {
    /// The file as it was given.
    pub name: String,
    /// The scene's title, its file's name where it has none.
    pub title: String,
    /// The worst verdict of its steps.
    pub verdict: Verdict,
    /// What it was before, where two scenes are compared.
    pub before: Option<Verdict>,
    /// How many of its steps stand, and how many there are.
    pub stand: (usize, usize),
    /// How many blocks its steps place, all together.
    pub blocks: usize,
    /// The closest margin of all steps: in words, and what is left in parts of what there is.
    pub closest: Option<(String, f64)>,
    /// The largest share of the friction available that an interface uses, in the steps that stand; `None` where none does:
    /// there missing forces would be counted among those that press and rub.
    pub friction: Option<f64>,
    /// The largest force of one interface or robot in the steps that stand, N; `None` where none does: there missing forces
    /// would be counted among those that press and rub.
    pub largest: Option<f64>,
    /// What fails first, in words; empty where all stands. Of a comparison what changed.
    pub fails: String,
    /// How it looks.
    pub thumbnail: Thumbnail,
}

/// Outlines in a small picture, as steps of SVG paths.
#[derive(Clone, Debug, Default)]
pub struct Thumbnail {
    /// The blocks.
    pub blocks: String,
    /// The ground.
    pub ground: String,
}

impl Row {
    /// The row of an analysis.
    pub fn new(name: &str, analysis: &Analysis) -> Row {
        let scene = &analysis.scene;
        let frames = &analysis.frames;
        let mut bullets = Vec::new();
        for frame in frames {
            bullets.extend(bullet::of(scene, frame));
        }
        let standing = || frames.iter().filter(|f| f.verdict == Verdict::Stable);
        let mut placed: Vec<usize> = scene
            .frames
            .iter()
            .flat_map(|f| f.placed.iter().map(|id| id.0))
            .collect();
        placed.sort_unstable();
        placed.dedup();
        let fails = frames.iter().find(|f| f.verdict != Verdict::Stable);
        let fails = fails.map_or(String::new(), |found| {
            let uncarried = failure::uncarried(scene, found);
            let largest = failure::by_amount(found).into_iter().next();
            let largest = largest.map(|f| failure::missing(scene, f));
            uncarried.or(largest).unwrap_or_else(|| found.doubt())
        });
        let title = match scene.title.trim() {
            "" => file_name(name),
            title => text::line(title),
        };
        Row {
            name: text::line(name),
            title,
            verdict: analysis.verdict(),
            before: None,
            stand: (standing().count(), frames.len()),
            blocks: placed.len(),
            closest: match (bullet::closest(&bullets), analysis.verdict()) {
                (None, _) => None,
                (Some(_), Verdict::Unstable) => Some(("none: it falls".into(), -1.0)),
                (Some(b), _) => Some((text::line(&b.short), b.reserve)),
            },
            friction: standing()
                .map(|f| f.contacts.iter().map(|c| c.friction_used))
                .map(|shares| shares.fold(0.0, f64::max))
                .reduce(f64::max),
            largest: standing()
                .map(|f| {
                    let contacts = f.contacts.iter().map(|c| c.resultant.force.norm());
                    let robots = f.robots.iter().map(|r| r.force.norm());
                    contacts.chain(robots).fold(0.0, f64::max)
                })
                .reduce(f64::max),
            fails: text::line(&fails),
            thumbnail: thumbnail(analysis, &placed),
        }
    }
}

impl Row {
    /// How much of the friction available is used, in words.
    pub(crate) fn friction_words(&self) -> String {
        self.friction.map_or_else(|| "none stands".into(), percent)
    }

    /// The largest force, in words.
    pub(crate) fn largest_words(&self) -> String {
        let words = |largest| quantity(largest, "N");
        self.largest.map_or_else(|| "none stands".into(), words)
    }
}

/// A file's name without its folders and ending.
pub(super) fn file_name(name: &str) -> String {
    let last = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let stem = last.strip_suffix(".json").unwrap_or(last);
    text::line(if stem == "-" { "standard input" } else { stem })
}

fn thumbnail(analysis: &Analysis, placed: &[usize]) -> Thumbnail {
    let scene = &analysis.scene;
    let polygon = |id: usize| &scene.blocks[id].body.polygon;
    let bounds = placed.iter().map(|id| polygon(*id).bounds());
    let Some(bounds) = bounds.reduce(Bounds::union) else {
        return Thumbnail::default();
    };
    let (width, height) = THUMBNAIL;
    let size = f64::max(
        bounds.width() / (width - 6.0),
        bounds.height() / (height - 8.0),
    );
    if !(size > 0.0 && size.is_finite()) {
        return Thumbnail::default();
    }
    let scale = 1.0 / size;
    let at = PagePoint::new(
        (width - scale * bounds.width()) / 2.0,
        height - 5.0 - scale * bounds.height(),
    );
    let camera = Camera::new(bounds, at, scale);
    let every = placed.len().div_ceil(MOST).max(1);
    let mut blocks = String::new();
    for id in placed.iter().step_by(every) {
        blocks.push_str(&steps(&camera.polygon(polygon(*id))));
    }
    let mut ground = String::new();
    for part in scene.ground.iter().take(MOST) {
        ground.push_str(&steps(&camera.polygon(&part.body.polygon)));
    }
    Thumbnail { blocks, ground }
}

/// Steps of a path to a tenth of a pixel; what lies far outside is drawn in to the edge.
fn steps(outline: &Outline) -> String {
    let (width, height) = THUMBNAIL;
    let number = |x: f64| {
        let tenths = (x * 10.0).round() / 10.0 + 0.0;
        format!("{tenths}")
    };
    let point = |p: &PagePoint| {
        format!(
            "{} {}",
            number(p.x.clamp(-9.0, width + 9.0)),
            number(p.y.clamp(-9.0, height + 9.0))
        )
    };
    let step = |segment: &Segment| match segment {
        Segment::Move(p) => format!("M{}", point(p)),
        Segment::Line(p) => format!("L{}", point(p)),
        Segment::Curve(_, _, p) => format!("L{}", point(p)),
        Segment::Close => "Z".into(),
    };
    outline.segments.iter().map(step).collect()
}
