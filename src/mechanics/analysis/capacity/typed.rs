//! Parses capacity requests that a user types: block, point and ranges. The command line, Python and JavaScript accept
//! this text.

use super::request::{CapacityRequest, Cases, ForceAt};
use crate::geometry::Point;
use crate::mechanics::scene::{Scene, Unit};
use crate::text::{line, nearest};

/// Parses the values of two options: `--capacity` (`BLOCK`, `BLOCK@x,y` or `BLOCK@x,y..x,y`, in the scene's unit of
/// length) and `--for-all` (ranges).
///
/// # Errors
/// Returns a message for the user if a text is not valid, or if the scene has no such block.
pub(crate) fn typed_capacity(scene: &Scene, typed: &str, for_all: Option<&str>) -> Result<CapacityRequest, String> {
    let cases = for_all.map_or(Ok(Cases::default()), cases)?;
    cases.check().map_err(|why| format!("--for-all: {why}"))?;
    // The name of a block may contain @, so the whole text is first tried as a name.
    if let Some(block) = scene.block_named(typed) {
        return Ok(CapacityRequest::of_block(block).cases(cases));
    }
    let (name, places) = match typed.rsplit_once('@') {
        Some((name, places)) => (name, Some(places)),
        None => (typed, None),
    };
    let block = scene.block_named(name).ok_or_else(|| unknown(scene, name))?;
    let request = CapacityRequest::of_block(block).cases(cases);
    match places {
        None => Ok(request),
        Some(places) => Ok(request.at(force_at(places, scene.units.length())?)),
    }
}

fn unknown(scene: &Scene, name: &str) -> String {
    let names = || scene.blocks.iter().map(|b| b.id.as_str());
    let hint = match nearest(name, names()) {
        Some(near) => format!("; did you mean {}?", line(near)),
        None => match names().next() {
            Some(first) => format!("; the blocks are {}, …", line(first)),
            None => "; there are no blocks".into(),
        },
    };
    format!("--capacity: the scene has no block {}{hint}", line(name))
}

/// Parses one point `x,y`, or two different points `x,y..x,y`, in the unit `unit`. The error is a message for the user.
fn force_at(places: &str, unit: Unit) -> Result<ForceAt, String> {
    let wrong = || {
        let unit = if unit.is_chosen { unit.symbol() } else { "metres".into() };
        format!(
            "--capacity: {} is not a point; write x,y in {unit}, such as 1.5,2, or two points, such as 1,2..3,2",
            line(places)
        )
    };
    let point = |text: &str| {
        let (x, y) = text.split_once(',')?;
        let read = |v: &str| v.trim().parse::<f64>().ok().filter(|v| v.abs() <= 1e12);
        Some(Point::new(unit.size * read(x)?, unit.size * read(y)?))
    };
    match places.split_once("..") {
        None => point(places).map(ForceAt::Point),
        Some((a, b)) => point(a).zip(point(b)).filter(|(a, b)| a != b).map(|(a, b)| ForceAt::Contact([a, b])),
    }
    .ok_or_else(wrong)
}

/// Parses the ranges of `--for-all`, such as `tilt=±2,horizontal=±0.05,friction=0.5..0.7`. The error is a message for
/// the user.
fn cases(typed: &str) -> Result<Cases, String> {
    let mut cases = Cases::default();
    for part in typed.split(',') {
        let (name, values) = part.split_once('=').ok_or_else(|| {
            format!("--for-all: {} has no range; write for example tilt=±2 or friction=0.5..0.7", line(part))
        })?;
        let range = range(values.trim())
            .ok_or_else(|| format!("--for-all: {} is not a range; write for example ±2 or 0.5..0.7", line(values)))?;
        match name.trim() {
            "tilt" => cases.tilt = Some(range),
            "horizontal" | "horizontal_load" | "horizontal-load" => cases.horizontal_load = Some(range),
            "friction" => cases.friction = Some(range),
            other => {
                return Err(format!(
                    "--for-all: {} is not one of tilt, horizontal and friction. For other quantities the \
                     extreme values do not show what happens between them",
                    line(other)
                ));
            }
        }
    }
    Ok(cases)
}

/// Parses a range: `±2`, `+-2`, `0.5..0.7`, or a single number as a range of one value. `None` for any other text.
fn range(text: &str) -> Option<[f64; 2]> {
    let number = |v: &str| v.trim().parse::<f64>().ok().filter(|v| v.is_finite());
    if let Some(size) = text.strip_prefix('±').or_else(|| text.strip_prefix("+-")) {
        let size = number(size).filter(|v| *v >= 0.0)?;
        return Some([-size, size]);
    }
    match text.split_once("..") {
        Some((low, high)) => Some([number(low)?, number(high)?]),
        None => number(text).map(|v| [v, v]),
    }
}
