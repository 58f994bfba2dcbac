//! [`apart`]: arrows that lie on one line, set side by side.
//!
//! A block on the ground is pushed up on the very line along which its weight pulls it down; drawn there, the two look
//! like one arrow with two heads. Each arrow is moved across its line by no more than keeps it clear of those before it,
//! and the two arrows of one interface stay centred about their true line. Lengths and directions are untouched.

mod place;

use self::place::Places;
use super::arrow::{ForceArrow, Marks};
use crate::drawing::arrow::{HEAD_WIDTH, head_size};
use crate::geometry::{Bounds, Point, Vector};

/// Arrows whose directions differ by less than this, rad, run side by side.
const PARALLEL: f64 = 0.12;
/// Room between two arrows set side by side, in widths of the wider shaft.
const ROOM: f64 = 0.4;
/// A free place for an arrow is looked for beside those so many of its widths off, and beside all where none is found there.
const NEAR: f64 = 24.0;
/// Above so many arrows in a frame they are texture, and stay where they are.
const MOST: usize = 4000;

/// Moves the arrows of a frame that lie on one line apart.
pub(crate) fn apart(marks: &mut Marks) {
    let arrows = &mut marks.arrows;
    if arrows.len() > MOST {
        return;
    }
    let original = arrows.clone();
    // The rooms of those that were set.
    let mut rooms = Places::sized_for(original.iter().map(around));
    let mut by_place: Vec<(f64, usize)> = original.iter().map(|a| a.at.x).zip(0..).collect();
    by_place.sort_by(|a, b| a.0.total_cmp(&b.0));
    for i in 0..arrows.len() {
        let Some(across) = across(&original[i]) else {
            rooms.put(around(&original[i]));
            continue;
        };
        let moved = |aside: f64| ForceArrow {
            at: original[i].at + across * aside,
            ..original[i]
        };
        // An arrow and its opposite keep their true line between them.
        let opposite = opposites(&by_place, &original, i);
        let ideal = opposite.map_or(0.0, |_| -0.5 * (1.0 + ROOM) * original[i].width);
        let clear = |place: &f64| {
            let there = moved(*place);
            !rooms.any(around(&there), |other| asked(&there, &arrows[other]))
        };
        // Most stand clear where they would stand best.
        if clear(&ideal) {
            arrows[i] = moved(ideal);
            rooms.put(around(&arrows[i]));
            continue;
        }
        // To a millionth of a shaft: of two places as far as each other noise of the forces must not choose.
        let shafts = |far: f64| (far / original[i].width * 1e6).round();
        let far = |place: &f64| shafts((place - ideal).abs());
        let nearest = |within: Option<Bounds>| {
            let mut places = vec![ideal, 0.0];
            for other in rooms.meeting(within) {
                let other = &arrows[other];
                // Just clear of one of those before it, on either side.
                let aside = |at: Point| (at - other.at).dot(&across);
                if let Some((needed, _)) = side_by_side(&original[i], other) {
                    let now = aside(original[i].at);
                    places.extend([needed - now, -needed - now]);
                }
            }
            places.sort_by(|a, b| far(a).total_cmp(&far(b)).then(b.total_cmp(a)));
            places.into_iter().find(clear)
        };
        // Places beside arrows that are farther off than the one that is found are farther off themselves.
        let width = original[i].width;
        let near = nearest(Some(around(&original[i]).grown(NEAR * width)));
        let place = near
            .filter(|place| place.abs() < 0.5 * NEAR * width)
            .or_else(|| nearest(None));
        arrows[i] = moved(place.unwrap_or(ideal));
        rooms.put(around(&arrows[i]));
    }
}

/// A box about an arrow and all the room it asks for: arrows whose boxes are apart do not ask each other for more.
fn around(arrow: &ForceArrow) -> Bounds {
    let tip = arrow.at + arrow.reach();
    let ends = Bounds {
        min: arrow.at.inf(&tip),
        max: arrow.at.sup(&tip),
    };
    ends.grown((HEAD_WIDTH + 2.0 * ROOM) * arrow.width)
}

/// The first of the arrows that begins where arrow `i` does and points the opposite way; `by_place` are their places from
/// left to right.
fn opposites(by_place: &[(f64, usize)], arrows: &[ForceArrow], i: usize) -> Option<usize> {
    let (x, far) = (arrows[i].at.x, 0.5 * arrows[i].width);
    let from = by_place.partition_point(|place| place.0 < x - far);
    let near = by_place[from..]
        .iter()
        .take_while(|place| place.0 <= x + far);
    let found = near.filter(|(_, j)| opposite(&arrows[i], &arrows[*j]));
    found.map(|(_, j)| *j).min()
}

/// Whether two arrows begin at one place and point opposite ways.
fn opposite(a: &ForceArrow, b: &ForceArrow) -> bool {
    let near = (a.at - b.at).norm() <= 0.5 * a.width;
    near && a.reach().dot(&b.reach()) < 0.0 && side_by_side(a, b).is_some()
}

/// The unit vector to the left of an arrow; `None` for an arrow of no length.
fn across(arrow: &ForceArrow) -> Option<Vector> {
    let reach = arrow.reach();
    let length = reach.norm();
    (length > 0.0).then(|| Vector::new(-reach.y, reach.x) / length)
}

/// Whether two arrows lie on one line and are nearer than they may be.
fn asked(a: &ForceArrow, b: &ForceArrow) -> bool {
    side_by_side(a, b).is_some_and(|(needed, apart)| apart < needed * (1.0 - 1e-6))
}

/// How far apart the axes of two nearly parallel arrows that stand beside each other have to be, and how far they are.
fn side_by_side(a: &ForceArrow, b: &ForceArrow) -> Option<(f64, f64)> {
    let (u, v) = (a.reach(), b.reach());
    let (long, other) = (u.norm(), v.norm());
    if !(long > 0.0 && other > 0.0) {
        return None;
    }
    let along = u / long;
    let sine = (along.x * v.y - along.y * v.x) / other;
    if sine.abs() > PARALLEL {
        return None;
    }
    let place = |d: Vector| d.dot(&along);
    let from = place(b.at - a.at);
    let sense = place(v).signum();
    let room = ROOM * a.width.max(b.width);
    let needed = parts(a)
        .iter()
        .flat_map(|p| parts(b).map(|q| (*p, q)))
        .filter(|(p, q)| {
            let (low, high) = (from + sense * q.0, from + sense * q.1);
            let (low, high) = (low.min(high), low.max(high));
            low < p.1 + room && high > p.0 - room
        })
        .map(|(p, q)| p.2 + q.2 + room)
        .fold(0.0, f64::max);
    let cross = |d: Vector| along.x * d.y - along.y * d.x;
    // Where they lie beside each other the axes are nearest at an end of the shared stretch.
    let ends = [
        from.max(0.0).min(long),
        (from + place(v)).max(0.0).min(long),
    ];
    let beside = ends.map(|at| {
        let share = ((at - from) / place(v)).clamp(0.0, 1.0);
        cross(b.at + v * share - a.at).abs()
    });
    (needed > 0.0).then_some((needed, beside[0].min(beside[1])))
}

/// Shaft and head: where each begins and ends along the arrow, and half its width, metres.
fn parts(arrow: &ForceArrow) -> [(f64, f64, f64); 2] {
    let length = arrow.reach().norm();
    let (long, wide) = head_size(length, arrow.width);
    let neck = length - long;
    let half = (arrow.width / 2.0).min(wide / 2.0 / HEAD_WIDTH);
    [(0.0, neck.max(0.0), half), (neck, length, wide / 2.0)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Analysis;
    use crate::figure::{Options, marks};
    use crate::scene::Scene;

    fn spread(text: &str) -> Vec<ForceArrow> {
        let scene = Scene::from_json(text).unwrap_or_else(|problems| panic!("{problems}"));
        let found = Analysis::new(&scene);
        let options = Options::default();
        let largest = crate::figure::mark::largest(&found, 0, &options);
        let mut marks = marks(&found, 0, &options, largest);
        let before = marks.clone();
        apart(&mut marks);
        for (a, b) in marks.arrows.iter().zip(&before.arrows) {
            assert_eq!((a.vector, a.force), (b.vector, b.force));
            // Never farther than a few widths from the line along which the force acts.
            assert!((a.at - b.at).norm() < 12.0 * a.width, "{a:?} {b:?}");
        }
        let overlaps = |arrows: &[ForceArrow]| {
            let pairs = (0..arrows.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
            pairs
                .filter(|(i, j)| asked(&arrows[*i], &arrows[*j]))
                .count()
        };
        assert!(overlaps(&before.arrows) > 0, "nothing to set apart");
        assert_eq!(overlaps(&marks.arrows), 0);
        marks.arrows
    }

    #[test]
    fn forces_on_one_line_stand_side_by_side() {
        let arrows = spread(include_str!("../../../tests/scenes/one.json"));
        assert_eq!(arrows.len(), 2);
        assert!((arrows[0].at.x - arrows[1].at.x).abs() > arrows[0].width);
        let mut column = String::from(
            r#"{ "drystone": 1, "ground": [{ "polygon": [[-1,-1],[3,-1],[3,0],[-1,0]] }], "blocks": ["#,
        );
        for y in 0..9 {
            let comma = if y > 0 { "," } else { "" };
            let up = y + 1;
            column.push_str(&format!(
                r#"{comma}{{ "polygon": [[0,{y}],[2,{y}],[2,{up}],[0,{up}]], "weight": {up} }}"#
            ));
        }
        spread(&(column + "] }"));
        spread(include_str!("../../../tests/scenes/lintel.json"));
        spread(include_str!("../../../tests/scenes/pin.json"));
    }
}
