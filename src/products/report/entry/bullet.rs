//! [`MarginBar`]: a margin as a bar: the range in which the structure stands, and its present value.

use crate::analysis::{FrameAnalysis, Margin, Margins, Sides};
use crate::scene::Scene;
use crate::text;
use crate::wording::margin::{NONE, UNTURNED, value};
use crate::wording::number::digits;

/// A margin as a bar.
#[derive(Clone, Debug, PartialEq)]
pub struct MarginBar {
    /// The quantity that varies, with its unit.
    pub name: String,
    /// A description of the range in which it stands.
    pub words: String,
    /// The ends of the scale.
    pub scale: (f64, f64),
    /// The range in which it stands; `None` if there is none.
    pub safe: Option<(f64, f64)>,
    /// The present value, if it is on the scale.
    pub now: Option<f64>,
    /// The remaining share up to the nearer limit: 0 at the limit, 1 without a limit.
    pub reserve: f64,
    /// A short description for the table of all scenes.
    pub short: String,
}

/// The bars for the margins of a frame that were computed.
pub fn margin_bars(scene: &Scene, found: &FrameAnalysis) -> Vec<MarginBar> {
    let Some(margins) = &found.margins else {
        return Vec::new();
    };
    let share = &margins.horizontal_load;
    let mut bars = vec![
        friction(found, margins),
        sided("tilt of gravity", "°", &margins.tilt, 90.0, UNTURNED),
        sided("horizontal share of the weights", "", share, 1.0, NONE),
        upwards("safety kernel", &margins.kernel, scene.kernel, Some(1.0)),
    ];
    if !scene.loads.is_empty() {
        let factor = &margins.load_factor;
        bars.push(upwards("factor on the loads", factor, 1.0, None));
    }
    for robot in &margins.robots {
        let arm = &scene.robots[robot.robot.0];
        let id = text::line(&arm.id);
        for (name, unit, margin, limit) in [
            ("horizontal force", "N", &robot.fx, arm.limits.fx),
            ("vertical force", "N", &robot.fy, arm.limits.fy),
            ("torque", "N·m", &robot.torque, arm.limits.torque),
        ] {
            let name = format!("{name} of robot {id}, {unit}");
            bars.push(needed(&name, unit, margin, limit));
        }
    }
    bars.into_iter().flatten().collect()
}

/// The value up to which a frame is known to stand: the margin, or the last confirmed value if the margin is not confirmed.
fn known(margin: &Margin) -> Option<f64> {
    match margin {
        Margin::Value { at, .. } | Margin::Unconfirmed { stands: at, .. } => Some(*at),
        Margin::None | Margin::Unbounded | Margin::NotAsked | Margin::NotApplicable => None,
    }
}

/// The bar with the smallest reserve.
pub fn closest(bars: &[MarginBar]) -> Option<&MarginBar> {
    bars.iter().min_by(|a, b| a.reserve.total_cmp(&b.reserve))
}

fn friction(found: &FrameAnalysis, margins: &Margins) -> Option<MarginBar> {
    let all = found.contacts.iter().map(|c| c.interface.friction);
    let least = all.fold(f64::INFINITY, f64::min);
    let have = if least.is_finite() { least } else { 0.0 };
    let needed = needed("friction coefficient, least", "", &margins.friction, have)?;
    Some(MarginBar {
        name: "friction coefficient".into(),
        ..needed
    })
}

/// A bar for a quantity that must not fall below a limit, such as friction.
fn needed(name: &str, unit: &str, margin: &Margin, have: f64) -> Option<MarginBar> {
    if *margin == Margin::NotAsked {
        return None;
    }
    let gap = if unit.is_empty() { "" } else { " " };
    let needed = known(margin);
    let top = [Some(have), needed]
        .into_iter()
        .flatten()
        .filter(|v| v.is_finite())
        .fold(0.0, f64::max);
    let top = if top > 0.0 { 1.25 * top } else { 1.0 };
    let unbounded = *margin == Margin::Unbounded;
    let safe = needed.or(unbounded.then_some(0.0)).map(|from| (from, top));
    let has = if have.is_finite() {
        format!("has {}{gap}{unit}", digits(have))
    } else {
        "has no limit".into()
    };
    let reserve = match needed {
        Some(needed) if needed <= 0.0 || have.is_infinite() => 1.0,
        Some(needed) if have > 0.0 => (1.0 - needed / have).max(0.0),
        Some(_) => 0.0,
        None if unbounded => 1.0,
        None => 0.0,
    };
    let shown = value(margin, &format!("{gap}{unit}"), NONE);
    Some(MarginBar {
        name: name.into(),
        words: match margin {
            Margin::None => format!("falls at any; {has}"),
            _ => format!("needs {shown}; {has}"),
        },
        scale: (0.0, top),
        safe,
        now: Some(have).filter(|v| v.is_finite()),
        reserve,
        short: format!(
            "{}: needs {shown}, {has}",
            name.split(',').next().unwrap_or(name)
        ),
    })
}

/// A bar for a quantity that may grow from 0 to both sides, such as a tilt.
fn sided(name: &str, unit: &str, sides: &Sides, all: f64, none: &str) -> Option<MarginBar> {
    if sides.left == Margin::NotAsked {
        return None;
    }
    let [left, right] = [&sides.left, &sides.right];
    let most = [left, right]
        .into_iter()
        .filter_map(known)
        .fold(0.0, f64::max);
    let top = if most > 0.0 { 1.25 * most } else { all };
    let ends = |margin: &Margin, endless: f64| match margin {
        Margin::Unbounded => endless,
        _ => known(margin).unwrap_or(0.0),
    };
    let falls = *left == Margin::None && *right == Margin::None;
    let share = |margin: &Margin| (ends(margin, all) / all).min(1.0);
    let (least, side) = if share(left) <= share(right) {
        (left, "left")
    } else {
        (right, "right")
    };
    let [to_left, to_right] = [left, right].map(|m| value(m, unit, none));
    Some(MarginBar {
        name: if unit.is_empty() {
            name.into()
        } else {
            format!("{name}, {unit}")
        },
        words: if falls {
            "falls as it is".into()
        } else {
            format!("{to_left} to the left, {to_right} to the right")
        },
        scale: (-top, top),
        safe: (!falls).then(|| (-ends(left, top), ends(right, top))),
        now: Some(0.0),
        reserve: share(least),
        short: format!("{name}: {} {side}", value(least, unit, none)),
    })
}

/// A bar for a quantity that may grow from its present value, such as a load.
fn upwards(name: &str, margin: &Margin, now: f64, end: Option<f64>) -> Option<MarginBar> {
    if matches!(margin, Margin::NotAsked | Margin::NotApplicable) {
        return None;
    }
    let at = known(margin);
    let top = end.unwrap_or_else(|| 1.25 * at.unwrap_or(now).max(now));
    let reserve = match (at, end) {
        (Some(at), Some(end)) => ((at - now) / (end - now).max(1e-9)).max(0.0),
        (Some(at), None) => (1.0 - now / at.max(1e-300)).max(0.0),
        (None, _) if *margin == Margin::Unbounded => 1.0,
        (None, _) => 0.0,
    };
    let shown = value(margin, "", NONE);
    Some(MarginBar {
        name: name.into(),
        words: match margin {
            Margin::None => format!("falls at any; has {}", digits(now)),
            _ => format!("up to {shown}; has {}", digits(now)),
        },
        scale: (0.0, top),
        safe: match margin {
            Margin::Unbounded => Some((0.0, top)),
            _ => at.map(|at| (0.0, at)),
        },
        now: Some(now),
        reserve: reserve.min(1.0),
        short: format!("{name}: up to {shown}, has {}", digits(now)),
    })
}
