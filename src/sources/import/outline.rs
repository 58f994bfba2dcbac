//! [`Outlines`]: the bodies and robots of a draft, their curves cut, each one outline with its holes.

use super::draft::{Draft, Form, Part, Role, Values};
use super::name::Names;
use super::region::regions;
use super::track::Track;
use super::{Remark, Snapped, crowd};
use crate::geometry::snap::{self, Corner, Rings, polygon};
use crate::geometry::{Bounds, Point, Polygon, PolygonError, Tolerance};
use crate::scene::Problem;

/// Places farther from the origin than this, in metres, are no places.
const FARTHEST: f64 = 1e12;

/// More bodies than this are not named one by one.
const MANY: usize = 12;

/// What a draft comes to.
pub(super) struct Outlines {
    /// The ground's parts first, then the blocks, each in the drawing's order.
    pub(super) bodies: Vec<Body>,
    pub(super) robots: Vec<Robot>,
}

/// A block or a part of the ground.
pub(super) struct Body {
    pub(super) kind: Role,
    pub(super) name: String,
    pub(super) element: String,
    pub(super) rings: Rings,
    pub(super) fill: Option<[u8; 3]>,
    pub(super) values: Values,
}

/// A robot and where it grips.
pub(super) struct Robot {
    pub(super) name: String,
    pub(super) element: String,
    pub(super) at: Point,
}

/// How large the blocks of a draft are together, in metres: the diagonal of the box around them. Parts with places that
/// are none are taken out.
pub(super) fn size(draft: &mut Draft) -> f64 {
    let hull = |part: &Part| match &part.form {
        Form::Tracks(tracks, _) => tracks.iter().flat_map(Track::hull).collect(),
        Form::Spot(at) => vec![*at],
    };
    let mut around: Option<Bounds> = None;
    let (mut kept, mut out) = (Vec::new(), Vec::new());
    for part in std::mem::take(&mut draft.parts) {
        let hull = hull(&part);
        // Written so that NaN is far.
        if hull
            .iter()
            .all(|p| p.x.abs() <= FARTHEST && p.y.abs() <= FARTHEST)
        {
            if part.kind == Role::Block {
                let own = Bounds::from_points(hull);
                around = around.into_iter().chain(own).reduce(Bounds::union);
            }
            kept.push(part);
        } else {
            out.push(part.element);
        }
    }
    draft.parts = kept;
    for element in out {
        let message = format!("it reaches farther than {FARTHEST:e} m from the origin; left out");
        draft.remark(element, message, "");
    }
    around.map_or(0.0, Bounds::diagonal)
}

impl Outlines {
    /// Takes the parts of a draft.
    pub(super) fn new(draft: &mut Draft, flatten: f64, close: f64) -> Outlines {
        let mut outlines = Outlines {
            bodies: Vec::new(),
            robots: Vec::new(),
        };
        for part in std::mem::take(&mut draft.parts) {
            match part.form {
                Form::Spot(at) => outlines.robots.push(Robot {
                    name: part.name,
                    element: part.element,
                    at,
                }),
                Form::Tracks(ref tracks, rule) => {
                    let rings = closed(draft, &part, tracks, flatten, close);
                    if crowd::is_tangle(&rings) {
                        let message = format!(
                            "its {} outlines are too many to tell which lies in which; left out",
                            rings.len()
                        );
                        draft.remark(&part.element, message, "break it apart into several paths");
                        continue;
                    }
                    for rings in regions(rings, rule) {
                        outlines.take(draft, &part, rings);
                    }
                }
            }
        }
        outlines.bodies.sort_by_key(|b| b.kind == Role::Block);
        outlines
    }

    fn take(&mut self, draft: &mut Draft, part: &Part, rings: Rings) {
        let polygon = match polygon(&rings) {
            Ok(polygon) => polygon,
            Err(flaws) => {
                flawed(draft, part, &flaws);
                return;
            }
        };
        if part.kind == Role::Robot {
            self.robots.push(Robot {
                name: part.name.clone(),
                element: part.element.clone(),
                at: polygon.centroid(),
            });
        } else {
            self.bodies.push(Body {
                kind: part.kind,
                name: part.name.clone(),
                element: part.element.clone(),
                rings,
                fill: part.fill,
                values: part.values,
            });
        }
    }

    /// The thickness of the thinnest body, in metres, as that of a long strip of its area and circumference.
    pub(super) fn thinnest(&self) -> f64 {
        let thickness = |body: &Body| {
            let polygon = polygon(&body.rings).ok()?;
            let around: f64 = polygon.edges().map(|e| e.length()).sum();
            Some(2.0 * polygon.area() / around)
        };
        let all = self.bodies.iter().filter_map(thickness);
        all.fold(f64::INFINITY, f64::min)
    }

    /// Brings together what lies within `gap`, and tells what moved.
    pub(super) fn snap(&mut self, draft: &mut Draft, names: &Names, gap: f64) -> Vec<Snapped> {
        if !(gap > 0.0) {
            return Vec::new();
        }
        let rings: Vec<Rings> = self.bodies.iter().map(|b| b.rings.clone()).collect();
        let (gaps, fixed) = (vec![gap; rings.len()], vec![false; rings.len()]);
        let outcome = snap::snapped(
            &rings,
            snap::Gaps::new(&gaps),
            &fixed,
            0.5 * self.tolerance() / gap,
        );
        if outcome.kept.len() > MANY {
            let message = format!(
                "{} bodies would lose their shape, or lie deeper in their neighbours, if they were snapped; left as they are drawn",
                outcome.kept.len()
            );
            draft.remark(
                "",
                message,
                "draw them closer to what they touch, or give another --gap",
            );
        }
        for body in outcome
            .kept
            .iter()
            .copied()
            .filter(|_| outcome.kept.len() <= MANY)
        {
            draft.remark(
                &self.bodies[body].element,
                "snapped to its neighbours it would lose its shape or lie deeper in them; left as it is drawn",
                "draw it closer to what it touches, or give a smaller --gap",
            );
        }
        let described = |moved: &snap::Moved| Snapped {
            body: names.bodies[moved.body].clone(),
            element: self.bodies[moved.body].element.clone(),
            corners: moved.corners,
            distance: moved.distance,
            to: moved.to.iter().map(|b| names.bodies[*b].clone()).collect(),
        };
        let snapped = outcome.moved.iter().map(described).collect();
        for (body, rings) in self.bodies.iter_mut().zip(outcome.bodies.into_owned()) {
            body.rings = rings;
        }
        snapped
    }

    /// How deep an overlap a scene of these blocks takes for noise, in metres.
    fn tolerance(&self) -> f64 {
        let blocks = self.bodies.iter().filter(|b| b.kind == Role::Block);
        let boxes: Vec<Bounds> = blocks
            .filter_map(|b| Bounds::from_points(b.rings.iter().flatten().map(|c| c.at)))
            .collect();
        let mut sizes: Vec<f64> = boxes.iter().map(|b| b.diagonal()).collect();
        sizes.sort_by(f64::total_cmp);
        let typical = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
        let all = boxes.into_iter().reduce(Bounds::union);
        Tolerance::new(all.map_or(0.0, Bounds::diagonal), typical).gap
    }

    /// The parts of the ground.
    pub(super) fn ground(&self) -> usize {
        self.bodies
            .iter()
            .filter(|b| b.kind == Role::Ground)
            .count()
    }

    /// A problem of the scene, told of the elements it comes from.
    pub(super) fn located(&self, problem: &Problem) -> Remark {
        let ground = self.ground();
        let number = |list: &str| -> Option<usize> {
            let rest = problem.path.strip_prefix(list)?.strip_prefix('[')?;
            rest.split(']').next()?.parse().ok()
        };
        let body = number("blocks")
            .map(|i| ground + i)
            .or_else(|| number("ground"))
            .and_then(|i| self.bodies.get(i))
            .map(|b| b.element.clone());
        let robot = || {
            number("robots")
                .and_then(|i| self.robots.get(i))
                .map(|r| r.element.clone())
        };
        // The drawing knows no numbers.
        let mut message = String::new();
        let mut pieces = problem.message.split("ground[");
        message.extend(pieces.next());
        for piece in pieces {
            let named = piece.split_once(']').and_then(|(number, rest)| {
                let number: usize = number.parse().ok()?;
                let body = self.bodies[..ground].get(number)?;
                Some(format!("the ground's {}{rest}", body.element))
            });
            message += &named.unwrap_or_else(|| format!("ground[{piece}"));
        }
        Remark {
            element: body.or_else(robot).unwrap_or_else(|| problem.path.clone()),
            message,
            help: problem.help.clone(),
        }
    }
}

/// The closed outlines of a part; of the others it is reported that they are open.
fn closed(
    draft: &mut Draft,
    part: &Part,
    tracks: &[Track],
    flatten: f64,
    close: f64,
) -> Vec<Vec<Corner>> {
    let mut rings = Vec::new();
    let mut open = 0;
    for track in tracks {
        match track.flattened(flatten, close) {
            Some(ring) => rings.push(ring),
            None => open += 1,
        }
    }
    if open > 0 {
        let message = match (open, tracks.len()) {
            (1, 1) => "it is open; left out".into(),
            (open, all) if open == all => format!("all {open} of its outlines are open; left out"),
            (open, all) => format!("{open} of its {all} outlines are open; these are left out"),
        };
        let help = "close it, or name its layer ignore if it is no block";
        draft.remark(&part.element, message, help);
    } else if rings.is_empty() {
        draft.remark(&part.element, "it has no outline; left out", "");
    }
    rings
}

fn flawed(draft: &mut Draft, part: &Part, flaws: &[PolygonError]) {
    let point = |p: &Point| format!("({:.4}, {:.4}) m", p.x, p.y);
    let (message, help) = match flaws.first() {
        Some(PolygonError::Crossing { at, .. }) => {
            let more = match flaws.len() {
                1 => String::new(),
                n => format!(", and in {} more places", n - 1),
            };
            (
                format!(
                    "its outline crosses or touches itself at {}{more}; left out",
                    point(at)
                ),
                "draw it without crossings, or in parts",
            )
        }
        Some(PolygonError::HoleOutside { .. }) => (
            "its holes lie in each other or outside it; left out".into(),
            "draw them apart",
        ),
        _ => ("it encloses no area; left out".into(), "give it one"),
    };
    draft.remark(&part.element, message, help);
}

impl Body {
    /// Its polygon, known to be sound.
    pub(super) fn polygon(&self) -> Option<Polygon> {
        polygon(&self.rings).ok()
    }
}
