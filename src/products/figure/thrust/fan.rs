//! Draws the force polygon next to the line of thrust in the classical form: a load line, a pole, and a ray from the
//! pole for each joint. A ray shows the force in the joint with the same number. The weight and the loads of a block
//! connect the tips of the rays of its two joints. The force polygon of one chain of blocks is called a fan.

use super::chain::{Chain, chains};
use crate::geometry::{Bounds, Point, Vector};
use crate::mechanics::analysis::FrameAnalysis;
use crate::mechanics::scene::{AppliedForce, ForceCause, Frame, Scene};
use crate::pictures::drawing::placement::Ink;
use crate::pictures::drawing::{
    Anchor, Camera, Face, Group, Outline, PagePoint, PageRect, Path, Stroke, Text, Theme, text,
};

use super::super::view;
use super::super::words::{force, quantity, round_below_in};
use crate::mechanics::scene::Unit;

/// Largest width of a fan, as a fraction of the structure's width.
const FAN_WIDTH_SHARE: f64 = 0.42;
/// Largest height of all fans together with their gaps, and the gap between two fans, as fractions of the structure's
/// height.
const HEIGHT_AND_GAP_SHARES: (f64, f64) = (0.8, 0.2);
/// For the size of a fan, the width and the height of the structure count as at least this fraction of the larger of
/// both. Otherwise the fan of a high or wide structure would be too small.
const MIN_SIDE_SHARE: f64 = 0.7;
/// Space to the left of the pole and to the right of the load line, as a fraction of the structure's larger side.
const SIDE_SPACE_SHARES: (f64, f64) = (0.1, 0.12);
/// Least width of the fans with their labels, as a fraction of the structure's larger side.
const MIN_WIDTH_SHARE: f64 = 0.34;
/// Font size of the numbers of rays and joints, pixels.
const NUMBER_SIZE: f64 = 9.5;
/// Font size of magnitudes of forces, pixels.
const AMOUNT_SIZE: f64 = 11.5;
/// If the weight and the loads of a block do not balance its two joint forces, the remainder is drawn as the force of
/// robots. A remainder up to this fraction of the resultant of the two joint forces is ignored.
const ROBOT_TOL: f64 = 1e-6;
/// Width of the load line, pixels.
const LOAD_LINE_WIDTH: f64 = 1.8;
/// Least distance of numbers on the load line, pixels.
const MIN_NUMBER_GAP: f64 = 9.0;

/// The force polygon of a chain. Its points are positions in the scene, metres.
struct Fan {
    chain: Chain,
    pole: Point,
    /// The ends of the rays that are not at the pole.
    vertices: Vec<Point>,
    /// The scale of the polygon, metres in the scene per newton.
    metres: f64,
}

/// The fans of a frame.
pub(crate) struct Fans {
    fans: Vec<Fan>,
    /// Newtons per metre.
    newtons_per_metre: f64,
    /// The box around the fans and their labels, metres.
    pub bounds: Bounds,
}

impl Fans {
    /// Computes the force polygons of a frame, one fan of rays for each chain of blocks, to the right of the structure.
    /// Returns `None` if no chain of blocks has a thrust. `unit` is the unit length in metres.
    pub fn new(scene: &Scene, frame: &Frame, frame_analysis: &FrameAnalysis, unit: f64) -> Option<Fans> {
        let blocks = frame.placed.iter();
        let structure = blocks.map(|id| scene.blocks[id.0].body.polygon.bounds()).reduce(Bounds::union)?;
        let chains = chains(scene, frame, frame_analysis);
        let boxes: Vec<Bounds> = chains
            .iter()
            .filter_map(|chain| {
                let tips = chain.forces.iter().map(|f| Point::from(*f));
                Bounds::from_points(tips.chain([Point::origin()]))
            })
            .collect();
        let widest = boxes.iter().map(|b| b.width()).fold(0.0, f64::max);
        let high: f64 = boxes.iter().map(|b| b.height()).sum();
        if chains.is_empty() || widest <= 0.0 || high <= 0.0 {
            return None;
        }
        let side = MIN_SIDE_SHARE * structure.width().max(structure.height());
        let (width, height) = (structure.width().max(side), structure.height().max(side));
        let gaps = HEIGHT_AND_GAP_SHARES.1 * height * (boxes.len() - 1) as f64;
        let metres =
            (FAN_WIDTH_SHARE * width / widest).min((HEIGHT_AND_GAP_SHARES.0 * height - gaps).max(0.2 * height) / high);
        let right = view::ground_shown(scene, unit).map_or(structure.max.x, |ground| structure.max.x.max(ground.max.x));
        let larger = structure.width().max(structure.height());
        let left = right + SIDE_SPACE_SHARES.0 * larger;
        let mut top = structure.max.y;
        let mut fans = Vec::new();
        for (chain, own) in chains.into_iter().zip(boxes) {
            let pole = Point::new(left - metres * own.min.x, top - metres * own.max.y);
            let vertices = chain.forces.iter().map(|f| pole + *f * metres).collect();
            top -= metres * own.height() + HEIGHT_AND_GAP_SHARES.1 * height;
            fans.push(Fan { chain, pole, vertices, metres });
        }
        let bounds = Bounds {
            min: Point::new(right, top.min(structure.min.y)),
            max: Point::new(
                (left + metres * widest + SIDE_SPACE_SHARES.1 * larger).max(right + MIN_WIDTH_SHARE * larger),
                structure.max.y,
            ),
        };
        Some(Fans { fans, newtons_per_metre: 1.0 / metres, bounds })
    }

    /// Draws the force polygons, and the numbers of the joints on the structure. Adds both to `ink`, so that labels do
    /// not cover them.
    pub fn draw(
        &self,
        scene: &Scene,
        frame_analysis: &FrameAnalysis,
        camera: &Camera,
        theme: &Theme,
        ink: &mut Ink,
    ) -> Group {
        let mut group = Group::with_class("polygon").titled("Force polygon");
        let mut number = 0;
        let middle = 0.5 * (self.bounds.min.x + self.bounds.max.x);
        let page = camera.rect(self.bounds);
        ink.rect(page);
        for fan in &self.fans {
            fan.draw(scene, number, (camera, page), theme, &mut group);
            fan.number_joints(frame_analysis, number, middle, (camera, theme), ink, &mut group);
            number += fan.vertices.len();
        }
        self.draw_scale(camera, theme, page, scene.units.force(), &mut group);
        group
    }

    /// Draws a scale bar for a round force below the force polygons. A bar that is wider than the page is left out.
    fn draw_scale(&self, camera: &Camera, theme: &Theme, page: PageRect, unit: Unit, group: &mut Group) {
        let points = self.fans.iter().flat_map(|f| &f.vertices);
        let all = points.chain(self.fans.iter().map(|fan| &fan.pole)).copied();
        let Some(all) = Bounds::from_points(all) else {
            return;
        };
        let newtons = round_below_in(0.7 * all.width() * self.newtons_per_metre, unit);
        let amount = quantity(newtons, unit);
        let length = camera.length(newtons / self.newtons_per_metre);
        let low = camera.place(Point::new(all.min.x, all.min.y));
        let wide = length + 5.0 + text::width(&amount, Face::Sans, AMOUNT_SIZE);
        let at = PagePoint::new(fit_to_page(low.x, wide, page), low.y + 2.4 * AMOUNT_SIZE);
        if wide > page.width {
            return;
        }
        let mut bar = Outline::line([at, at.moved(length, 0.0)]);
        for x in [0.0, length] {
            bar.extend(Outline::line([at.moved(x, -3.0), at.moved(x, 3.0)]));
        }
        group.items.push(Path::stroked(bar, Stroke::new(theme.faint, 1.2)).into());
        let words = at.moved(length + 5.0, 0.36 * AMOUNT_SIZE);
        let words = Text::new(words, amount, Face::Sans, AMOUNT_SIZE, theme.faint);
        group.items.push(words.into());
    }
}

impl Fan {
    /// Draws the load line, the rays with their numbers, and the thrust H. The number of the first ray is `before` + 1.
    fn draw(
        &self,
        scene: &Scene,
        before: usize,
        (camera, page): (&Camera, PageRect),
        theme: &Theme,
        group: &mut Group,
    ) {
        let pole = camera.place(self.pole);
        let last = self.vertices.len() - 1;
        for (k, (vertex, ray)) in self.vertices.iter().zip(&self.chain.forces).enumerate() {
            let width = if k == 0 || k == last { 1.8 } else { 0.9 };
            let line = Outline::line([pole, camera.place(*vertex)]);
            let title = format!("Ray {}: {}", before + k + 1, force(*ray, scene.units));
            let drawn = Group::with_class("ray").titled(title);
            let path = Path::stroked(line, Stroke::new(theme.motion, width));
            group.items.push(drawn.with(path).into());
        }
        self.draw_load_line(scene, camera, theme, group);
        let words = |at: PagePoint, words: String, size: f64, anchor: Anchor| {
            Text::new(at, words, Face::Sans, size, theme.ink).anchored(anchor)
        };
        let o = words(pole.moved(-4.0, 0.36 * NUMBER_SIZE), "O".into(), NUMBER_SIZE, Anchor::End);
        group.items.push(o.into());
        let mut below = f64::NEG_INFINITY;
        for (k, vertex) in self.vertices.iter().enumerate() {
            let at = camera.place(*vertex).moved(6.0, 0.36 * NUMBER_SIZE);
            let free = at.y - below >= MIN_NUMBER_GAP;
            let reserved = camera.place(self.vertices[last]).y + 0.36 * NUMBER_SIZE - at.y;
            if free && (k == last || reserved >= MIN_NUMBER_GAP) {
                let number = (before + k + 1).to_string();
                group.items.push(words(at, number, NUMBER_SIZE, Anchor::Start).into());
                below = at.y;
            }
        }
        // If all loads are vertical, the thrust H is the distance of the pole from the load line, at the scale of the
        // polygon.
        let thrust = quantity(self.chain.crown_thrust, scene.units.force());
        let ends = self.vertices.iter().copied().chain([self.pole]);
        let Some(all) = Bounds::from_points(ends) else {
            return;
        };
        let at = camera.place(Point::new(all.min.x, all.min.y));
        let thrust = format!("H = {thrust}");
        let wide = text::width(&thrust, Face::Sans, AMOUNT_SIZE);
        let at = PagePoint::new(fit_to_page(at.x, wide, page), at.y + 1.25 * AMOUNT_SIZE);
        let label = words(at, thrust, AMOUNT_SIZE, Anchor::Start);
        if wide <= page.width {
            group.items.push(label.into());
        }
    }

    /// Draws the load line: the weight, the loads and the robot forces of each block, from the tip of one ray to the
    /// tip of the next.
    fn draw_load_line(&self, scene: &Scene, camera: &Camera, theme: &Theme, group: &mut Group) {
        let applied = scene.applied_forces();
        for (k, id) in self.chain.blocks.iter().enumerate() {
            let block = &scene.blocks[id.0];
            let piece = |applied: &AppliedForce| match applied.cause {
                ForceCause::Weight => (applied.force, theme.ink, "Weight"),
                ForceCause::Load(_) => (applied.force, theme.load, "Load"),
            };
            let mut pieces: Vec<_> = applied[id.0].iter().map(piece).collect();
            let sum = self.chain.forces[k + 1] - self.chain.forces[k];
            let held: Vector = sum - pieces.iter().map(|p| p.0).sum::<Vector>();
            if held.norm() > ROBOT_TOL * sum.norm() {
                pieces.push((held, theme.faint, "Robots"));
            }
            let mut at = self.vertices[k];
            for (amount, colour, what) in pieces {
                let end = at + amount * self.metres;
                let line = Outline::line([at, end].map(|p| camera.place(p)));
                let title = format!("{what} on block {}: {}", block.id, force(amount, scene.units));
                let path = Path::stroked(line, Stroke::new(colour, LOAD_LINE_WIDTH));
                let drawn = Group::with_class("load").titled(title).with(path);
                group.items.push(drawn.into());
                at = end;
            }
        }
        for vertex in &self.vertices {
            let dot = Outline::circle(camera.place(*vertex), 0.8 * LOAD_LINE_WIDTH);
            group.items.push(Path::filled(dot, theme.ink).into());
        }
    }

    /// Writes the number of each joint on the structure, next to the outer or upper end of the joint. The first number
    /// is `before` + 1. `middle` is the x coordinate, in metres, that is used as the middle of a chain without joints.
    fn number_joints(
        &self,
        frame_analysis: &FrameAnalysis,
        before: usize,
        middle: f64,
        (camera, theme): (&Camera, &Theme),
        ink: &mut Ink,
        group: &mut Group,
    ) {
        let points = self.chain.joints.iter();
        let points = points.map(|j| frame_analysis.contacts[*j].resultant.at);
        let own = Bounds::from_points(points).map_or(middle, |b| 0.5 * (b.min.x + b.max.x));
        for (k, joint) in self.chain.joints.iter().enumerate() {
            let ends = frame_analysis.contacts[*joint].interface.ends;
            let outward = |p: &Point| p.y + 0.5 * (p.x - own).abs();
            let [inner, outer] = if outward(&ends[0]) < outward(&ends[1]) { ends } else { [ends[1], ends[0]] };
            let number = (before + k + 1).to_string();
            let wide = text::width(&number, Face::Sans, NUMBER_SIZE);
            let along: Vector = outer - inner;
            let (x, y) = camera.turn(along);
            let length = libm::hypot(x, y).max(f64::MIN_POSITIVE);
            let (x, y) = (x / length, y / length);
            let centre = camera.place(outer).moved((4.0 + 0.6 * wide) * x, 8.5 * y);
            ink.rect(PageRect { at: centre.moved(-0.5 * wide, -0.5 * NUMBER_SIZE), width: wide, height: NUMBER_SIZE });
            let at = centre.moved(0.0, 0.36 * NUMBER_SIZE);
            let label = Text::new(at, number, Face::Sans, NUMBER_SIZE, theme.motion);
            let label = label.anchored(Anchor::Middle).with_halo(theme.page, 1.6);
            group.items.push(label.into());
        }
    }
}

/// Returns the x coordinate of the left end of a text that is `wide` pixels wide: `x` if the text fits on the page
/// there, otherwise the position at which it ends at the right edge of the page.
fn fit_to_page(x: f64, wide: f64, page: PageRect) -> f64 {
    x.min(page.at.x + page.width - wide)
}
