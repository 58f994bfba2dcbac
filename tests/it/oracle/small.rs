//! Random towers and walls with small stones on them, next to them and in them. Each number always gives the same
//! scene.
//!
//! All corners are binary fractions, in axes that may be turned by a Pythagorean angle, so bodies touch exactly.

use serde_json::{Value, json};

use crate::random::Random;

/// The directions of the courses of a pile: horizontal, twice as often as the slope of 3 in 4. The latter has length
/// 5/8.
const AXES: [[f64; 2]; 3] = [[1.0, 0.0], [1.0, 0.0], [0.5, 0.375]];

struct Pile {
    along: [f64; 2],
    blocks: Vec<Value>,
}

impl Pile {
    fn outline(&self, x: f64, y: f64, width: f64, height: f64) -> Value {
        let [c, s] = self.along;
        let place = |x: f64, y: f64| json!([x * c - y * s, x * s + y * c]);
        json!([place(x, y), place(x + width, y), place(x + width, y + height), place(x, y + height)])
    }

    fn add(&mut self, x: f64, y: f64, width: f64, height: f64, weight: f64) {
        let polygon = self.outline(x, y, width, height);
        let id = format!("{}", self.blocks.len());
        self.blocks.push(json!({ "id": id, "polygon": polygon, "weight": weight }));
    }
}

/// The file of the scene with this number.
pub fn scene(number: u64) -> Value {
    let mut chance = Random::new(number ^ 0x5a11);
    let along = chance.one_of(&AXES);
    let mut pile = Pile { along, blocks: Vec::new() };
    let weight = |chance: &mut Random| chance.whole(1, 9) as f64;
    // The lightest stones weigh 10⁻¹² times as much as bricks.
    let light = |chance: &mut Random| {
        let exponent = chance.one_of(&[0, 1, 2, 3, 4, 6, 8, 10, 12]);
        chance.whole(1, 9) as f64 * libm::exp10(-f64::from(exponent))
    };
    // Sizes from 1 down to about a millionth.
    let binary = |chance: &mut Random| libm::exp2(-(chance.whole(0, 20) as f64));
    let courses = chance.whole(1, 6);
    let mut x = 0.0;
    for k in 0..courses {
        x += chance.whole(-3, 3) as f64 / 8.0;
        let own = if chance.percent(15) { light(&mut chance) } else { weight(&mut chance) };
        pile.add(x, k as f64, 2.0, 1.0, own);
    }
    let top = courses as f64;
    // The fraction of a stone's width that lies beyond the edge.
    let shares = [0.25, 0.484375, 0.5, 0.515625, 0.5625, 0.75, 0.984375];
    for stone in 0..chance.whole(1, 2) {
        let (size, beyond) = (binary(&mut chance), chance.one_of(&shares));
        let own = light(&mut chance);
        match chance.whole(0, 4) {
            // The first stone on the right edge of the top, the second on the left edge.
            0 | 1 if stone == 0 => pile.add(x + 2.0 - size * (1.0 - beyond), top, size, size, own),
            0 | 1 => pile.add(x - size * beyond, top, size, size, own),
            // In a joint between two bricks on the top course, resting on that course or above it, sometimes below
            // another brick.
            2 if stone == 0 => {
                let gap = size.min(0.25);
                pile.add(x, top, 0.75, 0.5, weight(&mut chance));
                pile.add(x + 0.75 + gap, top, 0.75, 0.5, weight(&mut chance));
                let lift = chance.one_of(&[0.0, 0.0, 0.125]);
                pile.add(x + 0.75, top + lift, gap, 0.125, own);
                if chance.percent(50) {
                    pile.add(x, top + 0.5, 1.5, 0.5, weight(&mut chance));
                }
                break;
            }
            // As one of two supports of a brick.
            3 if stone == 0 => {
                let height = size.min(0.5);
                pile.add(x + 0.125, top, height, height, own);
                let other = light(&mut chance);
                pile.add(x + 1.5, top, height, height, other);
                let reach = chance.one_of(&[0.0, 0.5, 1.0, 1.5]);
                pile.add(x + reach - 0.5, top + height, 2.0, 1.0, weight(&mut chance));
                break;
            }
            // Next to a post of ground. The stone touches only the side of the post, or also stands on the floor.
            _ => {
                let y = chance.one_of(&[0.0, 0.25, 0.5]);
                pile.add(-8.0 - size, y, size, size, own);
            }
        }
    }
    let mut ground = vec![json!({ "polygon": pile.outline(-16.0, -1.0, 32.0, 1.0) })];
    // The post.
    ground.push(json!({ "polygon": pile.outline(-8.0, 0.0, 1.0, 2.0) }));
    let friction = chance.one_of(&[0.0, 0.25, 0.5, 0.75, 0.7499, 0.7501, 1.0, 3.0]);
    let kernel = chance.one_of(&[0.0, 0.0, 0.2]);
    json!({ "drystone": 1, "friction": friction, "kernel": kernel, "ground": ground, "blocks": pile.blocks })
}
