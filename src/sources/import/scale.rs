//! [`Scale`]: computes the length of a unit of the drawing in metres.

/// The options for the size of the drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Scale {
    /// Metres per unit of the drawing.
    pub(super) metres: Option<f64>,
    /// Real lengths divided by drawn lengths: 50 for a drawing at 1:50.
    pub(super) ratio: Option<f64>,
}

impl Scale {
    /// Returns the number of metres per unit of the drawing, and a sentence that explains it. `stated` is the unit that
    /// the drawing states, in metres, with an explanation. `silent` is the explanation if the drawing states no unit.
    ///
    /// # Errors
    /// Returns a message if the options have only a ratio and the drawing states no unit.
    pub(super) fn of(self, stated: Option<(f64, String)>, silent: &str) -> Result<(f64, String), String> {
        let ratio = self.ratio.unwrap_or(1.0);
        let drawn_at =
            self.ratio.map_or(String::new(), |ratio| format!(" and the drawing is at 1:{}", six_digits(ratio)));
        let unit = |metres: f64| format!("a unit of the drawing is {} m", six_digits(metres));
        match (self.metres, stated) {
            (Some(metres), _) => {
                let metres = metres * ratio;
                Ok((metres, format!("{} (set by an option)", unit(metres))))
            }
            (None, Some((metres, reason))) => {
                let metres = metres * ratio;
                Ok((metres, format!("{}, because {reason}{drawn_at}", unit(metres))))
            }
            (None, None) if self.ratio.is_some() => Err(format!(
                "a scale of 1:{} needs the unit of the drawing, because {silent}; add --unit mm, cm, m, in or ft",
                six_digits(ratio)
            )),
            (None, None) => Ok((
                1.0,
                format!("a unit of the drawing is 1 m, because {silent}; --unit or --scale sets another unit"),
            )),
        }
    }
}

/// Returns a length as text with three significant digits.
pub(super) fn short(x: f64) -> String {
    rounded(format!("{x:.2e}"))
}

/// Returns a scale as text with six significant digits.
pub(super) fn six_digits(x: f64) -> String {
    rounded(format!("{x:.5e}"))
}

fn rounded(text: String) -> String {
    text.parse::<f64>().map_or(text, |x| x.to_string())
}
