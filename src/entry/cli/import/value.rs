//! The types of the option values of `drystone import`, and the functions that parse them.

use clap::ValueEnum;

use crate::sources::import::{STONES, Stone};

/// The format of a drawing.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum FormatArg {
    Svg,
    Dxf,
    Geojson,
    Wkt,
    Contacts,
    Compas,
}

/// A unit of length in drawings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Unit {
    Mm,
    Cm,
    M,
    In,
    Ft,
}

impl Unit {
    /// Returns the length of the unit in metres.
    pub(super) fn metres(self) -> f64 {
        match self {
            Unit::Mm => 1e-3,
            Unit::Cm => 1e-2,
            Unit::M => 1.0,
            Unit::In => 0.0254,
            Unit::Ft => 0.3048,
        }
    }
}

/// The value of `--scale`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ScaleArg {
    /// Real lengths divided by drawn lengths.
    Ratio(f64),
    /// Metres per unit of the drawing.
    Metres(f64),
}

/// Parses the name of a material.
pub(super) fn stone(typed: &str) -> Result<Stone, String> {
    Stone::from_name(typed).ok_or_else(|| {
        let names = STONES.map(|stone| stone.name);
        format!("the known materials are {}; for others give --density and --friction", names.join(", "))
    })
}

/// Parses a scale: `1:50` is a ratio, and `0.02` is the number of metres per unit of the drawing.
pub(super) fn scale(typed: &str) -> Result<ScaleArg, String> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|n| n.is_finite());
    let wrong = || "give a ratio such as 1:50, or metres per unit of the drawing such as 0.02".to_owned();
    match typed.split_once(':') {
        Some((drawn, real)) => match (number(drawn), number(real)) {
            (Some(drawn), Some(real)) if drawn > 0.0 && real > 0.0 => Ok(ScaleArg::Ratio(real / drawn)),
            _ => Err(wrong()),
        },
        None => number(typed).map(ScaleArg::Metres).ok_or_else(wrong),
    }
}

/// Parses gravity in m/s²: `9.81` acts downwards, and `0,-9.81` gives both components.
pub(super) fn gravity(typed: &str) -> Result<[f64; 2], String> {
    let numbers: Result<Vec<f64>, _> = typed.split(',').map(|t| t.trim().parse::<f64>()).collect();
    match numbers.as_deref() {
        Ok([g]) => Ok([0.0, -g]),
        Ok([x, y]) => Ok([*x, *y]),
        _ => Err("give gravity in m/s²: the downward value, such as 9.81, or both components, such as 0,-9.81".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scale_is_a_ratio_or_metres() {
        assert_eq!(scale("1:50"), Ok(ScaleArg::Ratio(50.0)));
        assert_eq!(scale("2 : 1"), Ok(ScaleArg::Ratio(0.5)));
        assert_eq!(scale("0.02"), Ok(ScaleArg::Metres(0.02)));
        assert!(scale("1:0").is_err() && scale("1:x").is_err() && scale("big").is_err());
    }

    #[test]
    fn gravity_is_one_number_or_two() {
        assert_eq!(gravity("9.81"), Ok([0.0, -9.81]));
        assert_eq!(gravity("1, -2"), Ok([1.0, -2.0]));
        assert!(gravity("down").is_err() && gravity("1,2,3").is_err());
    }
}
