//! How a structure falls if its blocks are off their places: each block has an arrow in the direction of its error.

use crate::mechanics::analysis::{SolvedFrame, Verdict};
use crate::mechanics::scene::BodyId;
use crate::pictures::drawing::{PagePoint, Path};
use crate::products::figure::canvas::Canvas;
use crate::products::figure::design::{Key, Layer, Mark, direction};
use crate::products::wording::number::{three_down, three_up};
use crate::products::wording::question::{placement_length, placement_proved};

/// The length of the arrow of the largest error in unit lengths, with its least and largest length in mm.
const ERROR: (f64, f64, f64) = (0.7, 1.5, 4.0);
/// Errors below this share of the largest have no arrow.
const NEGLIGIBLE: f64 = 0.02;

/// States up to which error the structure stands, and the error with which it falls.
pub(super) fn words(solved: SolvedFrame<'_>) -> Vec<String> {
    let SolvedFrame { scene, found, .. } = solved;
    let Some(placement) = &found.placement else {
        return match found.verdict {
            Verdict::Stable => vec!["every block is in its place".to_owned()],
            Verdict::Unstable => vec!["no error is allowed, because no forces balance the structure".to_owned()],
            Verdict::Undecided => Vec::new(),
        };
    };
    let stands = placement_length(scene, placement.proved, three_down);
    let falls = placement.falls_at.map(|at| match placement_length(scene, at, three_up) {
        at if at == stands => "falls just beyond".to_owned(),
        at => format!("falls with {at}"),
    });
    std::iter::once(placement_proved(scene, placement)).chain(falls).collect()
}

/// Draws the errors of the centres of gravity with which the structure falls, all in one scale.
pub(super) fn draw(canvas: &mut Canvas<'_>) {
    let Some(placement) = &canvas.found().placement else { return };
    let (scene, theme) = (canvas.scene(), canvas.theme());
    let largest = placement.pattern.iter().map(|error| error.offset.norm()).fold(0.0, f64::max);
    let longest = canvas.in_units(ERROR);
    let arrow = |canvas: &Canvas<'_>, at: PagePoint, u: (f64, f64), length: f64| {
        let outline = canvas.arrow(length, [0.3, 1.1, 1.1], 0.6).outline(at, u);
        vec![Path::filled(outline, theme.ink).cased(theme.page, canvas.mm(0.12)), canvas.disc(at, 0.4, theme.ink)]
    };
    let symbol = arrow(canvas, PagePoint::new(canvas.mm(0.4), 0.0), (1.0, 0.0), canvas.mm(3.4));
    let words = format!("errors of the centres, up to {}", placement_length(scene, largest, three_up));
    let key = Key::new(12, words, symbol, canvas.mm(3.8));
    for error in placement.pattern.iter().filter(|error| error.offset.norm() > NEGLIGIBLE * largest) {
        let block = &scene.blocks[error.block.0];
        let at = canvas.place_on(BodyId::Block(error.block), block.centroid);
        let shapes = arrow(canvas, at, direction(error.offset), longest * error.offset.norm() / largest);
        let off = placement_length(scene, error.offset.norm(), three_up);
        let mark = Mark::new(Layer::Symbol, "error", shapes).titled(format!("Block {}: off by {off}", block.id));
        canvas.put(mark.keyed(&key).avoided(0.2));
    }
}
