//! The load cases of a frame, as written in JSON.

use serde::Serialize;

use super::margin::{End, Sides, end, sides};
use super::{Number, word};
use crate::mechanics::analysis::{self, Margin};

#[derive(Serialize)]
pub(super) struct Case<'a> {
    id: &'a str,
    verdict: &'static str,
    #[serde(skip_serializing_if = "End::is_left_out")]
    load_factor: End,
    #[serde(skip_serializing_if = "Sides::is_left_out")]
    tilt: Sides<End>,
}

#[derive(Serialize)]
pub(super) struct Envelope {
    interface: usize,
    normal: [Number; 2],
    friction: [Number; 2],
}

impl<'a> Case<'a> {
    pub(super) fn new(case: &'a analysis::CaseResult) -> Case<'a> {
        let margins = case.margins.as_ref();
        let none = || Sides { left: end(&Margin::NotAsked), right: end(&Margin::NotAsked) };
        Case {
            id: &case.id,
            verdict: word(case.verdict),
            load_factor: margins.map_or(end(&Margin::NotAsked), |margins| end(&margins.load_factor)),
            tilt: margins.map_or_else(none, |margins| sides(&margins.tilt, end)),
        }
    }
}

impl Envelope {
    pub(super) fn new((interface, range): (usize, &analysis::Envelope)) -> Envelope {
        Envelope { interface, normal: range.normal.map(Number), friction: range.friction.map(Number) }
    }
}
