//! Draws the lower part of a free-body diagram: the verdict, the scale of the arrows, notes, and the list of forces.

use super::arrow::SHAFT_WIDTH;
use super::diagram::{NOISE, least_length, longest};
use super::force::largest;
use super::table::Table;
use super::value::{self, Piece, rows};
use super::{LIST_SIZE, MARGIN, Sheet};
use crate::pictures::drawing::{Anchor, Face, Group, Item, PagePoint, Text, text};
use crate::products::figure::arrow::round_above;
use crate::products::figure::legend;
use crate::products::figure::option::Corners;
use crate::products::figure::unit::unit;
use crate::products::figure::verdict;
use crate::products::figure::words::{listed, quantity, round_below_in};

impl Sheet<'_> {
    /// Returns the table of the forces on the block, with their moments about the centroid of the block.
    pub(super) fn table(&self) -> Table {
        let body = &self.analysis.scene.blocks[self.block.0];
        let size = body.body.polygon.bounds().diagonal();
        Table::new(&self.forces, body.centroid, size, self.analysis.scene.units)
    }

    /// Draws the verdict, the scale, the notes and the list of forces, downwards from the y coordinate `top` (pixels).
    /// If the diagram has coordinates, their values follow. Draws nothing if the option `keys` is off. `nameless` is
    /// the number of names for which the picture has no space. Also returns the y coordinate below the last line, in
    /// pixels.
    pub(super) fn values(&self, top: f64, nameless: usize) -> (Group, f64) {
        let theme = &self.options.theme;
        let mut group = Group::with_class("values");
        if !self.options.keys {
            return (group, top);
        }
        let (middle, room) = (self.width / 2.0, self.width - 2.0 * MARGIN);
        group.items.extend(self.verdict_and_scale(top + 10.0));
        let mut y = top + 28.0;
        let size = theme.sizes.reason;
        for note in self.notes(nameless) {
            for line in text::wrap(&note, Face::Sans, size, room) {
                y += 1.36 * size;
                let at = PagePoint::new(middle, y);
                let words = Text::new(at, line, Face::Sans, size, theme.faint);
                group.items.push(words.anchored(Anchor::Middle).into());
            }
        }
        y += 12.0;
        let top = PagePoint::new(middle, y);
        let (list, height) = self.table().draw(top, room, LIST_SIZE, theme);
        group.items.push(list.into());
        y += height + 6.0;
        if self.guides() {
            let values = value::places(self.analysis, self.block, &self.contacts);
            for row in rows(&values, LIST_SIZE, room) {
                y += 1.55 * LIST_SIZE;
                let wide: f64 = value::width(&row, LIST_SIZE);
                let mut at = PagePoint::new(middle - wide / 2.0, y);
                for piece in row {
                    let (items, width) = piece.draw(at, LIST_SIZE, theme);
                    group.items.extend(items);
                    at = at.moved(width, 0.0);
                }
            }
        }
        (group, y)
    }

    /// Draws the symbol and the text of the verdict, and the scale of the arrows, in one line. `y` is the y coordinate
    /// of this line on the page, in pixels.
    fn verdict_and_scale(&self, y: f64) -> Vec<Item> {
        let theme = &self.options.theme;
        let frame_analysis = &self.analysis.frames[self.frame];
        let word = verdict::word(frame_analysis.verdict);
        let what = if self.analysis.scene.frames[self.frame].placed.len() > 1 {
            format!("the structure {word}")
        } else {
            word.to_owned()
        };
        let wide = text::width(&what, Face::SansBold, 13.5);
        let scale = self.scale();
        let scaled = scale.as_ref().map_or(0.0, |s| 22.0 + legend::widest(std::slice::from_ref(s), theme));
        let start = self.width / 2.0 - (wide + 21.0 + scaled) / 2.0 + 7.5;
        let start = PagePoint::new(start, y);
        let colour = verdict::colour(frame_analysis.verdict, theme);
        let at = start.moved(13.5, 0.35 * 13.5);
        let mut items: Vec<Item> = vec![
            verdict::mark(frame_analysis.verdict, start, 7.5, theme).into(),
            Text::new(at, what, Face::SansBold, 13.5, colour).into(),
        ];
        if let Some(scale) = scale {
            let at = start.moved(13.5 + wide + 22.0, 0.0);
            items.extend(legend::single(&scale, at, theme));
        }
        items
    }

    /// Returns the legend entry for the scale of the arrows: an arrow for a round number of newtons. Returns `None` if
    /// the lengths of the arrows do not show magnitudes.
    fn scale(&self) -> Option<legend::Entry> {
        let largest = largest(&self.forces, unit(&self.analysis.scene, None), self.options);
        let amount = round_below_in(largest, self.analysis.scene.units.force());
        let longest = longest(self.analysis, self.block, &self.camera);
        (amount > 0.0).then(|| {
            let length = amount / largest * longest;
            legend::Entry::Scale(length, SHAFT_WIDTH, quantity(amount, self.analysis.scene.units.force()))
        })
    }

    /// Returns the notes below the picture. They say if lengths show no magnitudes, which small forces have enlarged
    /// arrows, how many forces and names are left out, and if the forces on the block do not balance.
    fn notes(&self, nameless: usize) -> Vec<String> {
        let mut notes = Vec::new();
        if self.options.corners == Corners::All {
            notes.push("arrows name forces; their lengths show no amounts".to_owned());
        }
        let edge = unit(&self.analysis.scene, None);
        let largest = largest(&self.forces, edge, self.options);
        let newtons = self.analysis.scene.units.force();
        notes.extend(self.enlarged(largest, edge));
        let unseen = self.arrows.iter().filter(|a| !Sheet::seen(a)).count();
        if unseen > 0 {
            let amount = quantity(round_above(largest * NOISE), newtons);
            let forces = if unseen == 1 { "force" } else { "forces" };
            notes.push(format!("{unseen} {forces} under {amount} not drawn"));
        }
        if nameless > 0 {
            let names = if nameless == 1 { "name has" } else { "names have" };
            notes.push(format!("{nameless} {names} no room"));
        }
        let frame_analysis = &self.analysis.frames[self.frame];
        if frame_analysis.unsupported.contains(&self.block) {
            notes.push("the forces on this block do not balance: it falls even if all contacts could stick".to_owned());
        }
        notes
    }

    /// Returns a note on small forces whose arrows are longer than in proportion to their magnitudes. Returns `None`
    /// if there is no such arrow. `largest` is the force of the longest arrow, N, and `edge` the unit length in metres.
    fn enlarged(&self, largest: f64, edge: f64) -> Option<String> {
        let units = self.analysis.scene.units;
        let longest = longest(self.analysis, self.block, &self.camera);
        let mut small: Vec<String> = Vec::new();
        for force in &self.forces {
            let limit = largest * least_length(force) / longest;
            let is_small = |amount: f64| amount > NOISE * largest && amount < limit;
            let what = if force.is_missing() { "missing " } else { "" };
            if is_small(force.force.norm()) {
                let limit = quantity(limit, units.force());
                small.push(format!("{what}forces under {limit}"));
            }
            if is_small(force.torque.abs() / edge) {
                let limit = quantity(limit * edge, units.torque());
                small.push(format!("{what}torques under {limit}"));
            }
        }
        small.sort();
        small.dedup();
        (!small.is_empty()).then(|| format!("{} are drawn larger", listed(&small)))
    }

    /// Returns the description of the diagram for screen readers: its arrows, the list of forces and, if the diagram
    /// has coordinates, the points where forces act.
    pub(super) fn described(&self) -> String {
        let arrows: Vec<&str> = self.arrows.iter().map(|a| a.title.as_str()).collect();
        let mut stated = self.table().stated();
        if self.guides() {
            let places = value::places(self.analysis, self.block, &self.contacts);
            stated.extend(places.iter().map(|p| p.iter().map(Piece::stated).collect()));
        }
        format!("{}. {}.", arrows.join(". "), stated.join("; "))
    }
}
