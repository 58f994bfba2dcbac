//! The values of options that are no numbers or texts: frames, margins, themes, backgrounds and time limits, and the
//! parsers of numbers with a range.

use std::str::FromStr;
use std::time::Duration;

use crate::clock::Instant;
use crate::mechanics::analysis::MarginKind;
use crate::mechanics::scene::Scene;
use crate::pictures::drawing::{Colour, Drawing, Theme};
use crate::text::Word;

/// A time limit. On the command line it counts from the start of the command, and all parts of the command keep this one
/// end. In JSON, whose options serve for many scenes, it counts from the start of each analysis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TimeLimit {
    /// The duration that was asked for.
    pub given: Duration,
    /// When it began; `None` before the work begins.
    began: Option<Instant>,
}

impl TimeLimit {
    /// Returns the same limit, counted from now.
    #[cfg(feature = "cli")]
    pub(crate) fn started(self) -> TimeLimit {
        TimeLimit { began: Some(Instant::now()), ..self }
    }

    /// Returns the time that is left until the end, and so much longer.
    #[cfg(feature = "cli")]
    pub(crate) fn left(self, longer: Duration) -> Duration {
        let end = self.end().and_then(|end| end.checked_add(longer));
        end.map_or(Duration::MAX, |end| end.saturating_duration_since(Instant::now()))
    }

    /// Returns the time at which the work ends. `None` if no clock can show it.
    pub(crate) fn end(self) -> Option<Instant> {
        self.began.unwrap_or_else(Instant::now).checked_add(self.given)
    }
}

/// A margin whose sensitivity can be computed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SensitivityMargin(pub MarginKind);

impl Word for SensitivityMargin {
    fn all() -> Vec<SensitivityMargin> {
        use MarginKind::{Friction, FrictionFactor, HorizontalLoad, Kernel, LoadFactor, Tilt};
        [LoadFactor, Tilt, HorizontalLoad, FrictionFactor, Friction, Kernel].map(SensitivityMargin).to_vec()
    }

    fn word(self) -> &'static str {
        Word::word(self.0)
    }

    fn alias(self) -> Option<&'static str> {
        self.0.alias()
    }
}

/// The name of a theme.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ThemeName(pub &'static str);

impl ThemeName {
    /// Returns the theme.
    pub(crate) fn theme(self) -> Theme {
        Theme::named(self.0).unwrap_or_default()
    }
}

impl Word for ThemeName {
    fn all() -> Vec<ThemeName> {
        Theme::NAMES.map(ThemeName).to_vec()
    }

    fn word(self) -> &'static str {
        self.0
    }
}

/// The colour of the page of a figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Background {
    /// A transparent page.
    Clear,
    /// A page of one colour.
    Plain(Colour),
}

impl Background {
    /// Returns the drawing on this page; without a choice, on the page of its theme.
    pub(crate) fn under(choice: Option<Background>, drawing: Drawing) -> Drawing {
        let background = match choice {
            None => drawing.background,
            Some(Background::Clear) => None,
            Some(Background::Plain(colour)) => Some(colour),
        };
        Drawing { background, ..drawing }
    }
}

impl FromStr for Background {
    type Err = String;

    fn from_str(typed: &str) -> Result<Background, String> {
        match typed {
            "none" => Ok(Background::Clear),
            "white" => Ok(Background::Plain(Colour::WHITE)),
            _ => match Colour::from_css(typed).filter(|_| typed.len() == 7) {
                Some(colour) => Ok(Background::Plain(colour)),
                None => {
                    Err("give none, white or #rrggbb, such as #f4f1ea; in a shell, put the colour in quotes".into())
                }
            },
        }
    }
}

/// One frame of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FrameChoice {
    /// The frame with this number, counted from 0.
    Number(usize),
    /// The last frame.
    Last,
}

impl FrameChoice {
    /// Returns the number of the frame, from 0; `None` for the last frame.
    pub(crate) fn number(self) -> Option<usize> {
        match self {
            FrameChoice::Number(number) => Some(number),
            FrameChoice::Last => None,
        }
    }

    /// Returns the scene with only this frame. The error is a message that ends with `place`, which names the scene.
    pub(crate) fn of(self, scene: &Scene, place: &str) -> Result<Scene, String> {
        let count = scene.frames().len();
        let number = self.number().unwrap_or(count - 1);
        scene.alone(number).ok_or_else(|| {
            let has = if count == 1 { "one frame".into() } else { format!("{count} frames") };
            format!("there is no frame {} in {place}: it has {has}", number + 1)
        })
    }
}

impl FromStr for FrameChoice {
    type Err = String;

    /// Parses a frame: its number, counted from 1, its letter in the figure (`a`, `b`, … `z`, `aa`, …), or `last`.
    fn from_str(typed: &str) -> Result<FrameChoice, String> {
        if typed == "last" {
            return Ok(FrameChoice::Last);
        }
        let number = match typed.parse::<usize>() {
            Ok(number) => Some(number),
            Err(_) if typed.is_empty() || typed.len() > 3 || !typed.bytes().all(|b| b.is_ascii_lowercase()) => None,
            Err(_) => Some(typed.bytes().fold(0, |sum, b| 26 * sum + usize::from(b - b'a') + 1)),
        };
        match number {
            Some(number) if number > 0 => Ok(FrameChoice::Number(number - 1)),
            _ => Err("give a frame: its number, counted from 1, its letter, or `last`".into()),
        }
    }
}

/// Parses a number in a range. The error says that it must be `what`.
pub(crate) fn between(typed: &str, [least, most]: [f64; 2], error: impl Fn() -> String) -> Result<f64, String> {
    typed.parse::<f64>().ok().filter(|number| (least..=most).contains(number)).ok_or_else(error)
}

pub(super) fn length(typed: &str) -> Result<f64, String> {
    between(typed, [0.0, 1e12], || "give a length in metres, from 0 to 1e12".into())
}

pub(crate) fn seconds(typed: &str) -> Result<TimeLimit, String> {
    let seconds = between(typed, [0.0, 1e6], || "give a time in seconds, from 0 to 1000000".into());
    seconds.map(|seconds| TimeLimit { given: Duration::from_secs_f64(seconds), began: None })
}

/// Parses a width in print.
pub(crate) fn millimetres(typed: &str) -> Result<f64, String> {
    let wrong = || "it must be a width in millimetres, such as 84 or 174, from 2 to 5080".into();
    between(typed, [2.0, 5080.0], wrong)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_chosen_by_number_or_letter() {
        for (typed, number) in [("1", 0), ("12", 11), ("a", 0), ("f", 5), ("z", 25), ("aa", 26), ("ab", 27)] {
            assert_eq!(typed.parse(), Ok(FrameChoice::Number(number)), "{typed}");
        }
        assert_eq!("last".parse(), Ok(FrameChoice::Last));
        // The letters of a longer word are not the number of a frame.
        for typed in ["0", "", "-1", "A", "1.5", "abcde", "é", "next", "first"] {
            assert!(typed.parse::<FrameChoice>().is_err(), "{typed}");
        }
    }

    #[test]
    fn a_background_is_none_or_a_colour_of_six_digits() {
        assert_eq!("none".parse(), Ok(Background::Clear));
        assert_eq!("#F4f1ea".parse(), Ok(Background::Plain(Colour([0xf4, 0xf1, 0xea]))));
        for wrong in ["", "#", "#fff", "#+12345", "f4f1ea", "#f4f1e", "#f4f1eag", "red", "#ünï"] {
            assert!(wrong.parse::<Background>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn widths_are_limited_to_possible_pages() {
        assert_eq!(millimetres("84"), Ok(84.0));
        for wrong in ["0", "-84", "nan", "inf", "84mm", "1e9", ""] {
            let refused = millimetres(wrong).expect_err(wrong);
            assert!(refused.contains("from 2 to 5080"), "{refused}");
        }
    }
}
