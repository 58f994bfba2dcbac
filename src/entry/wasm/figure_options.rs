//! [`FigureOptions`]: the options of a figure, read from JSON.

use serde::Deserialize;

use super::Refusal;
use super::option::{FrameChoice, Level, SensitivityMargin};
use crate::mechanics::analysis::{MarginKind, Toward};
use crate::mechanics::scene::BlockId;
use crate::pictures::drawing::style::format::Notation;
use crate::pictures::drawing::{Colour, Drawing, Theme};
use crate::pictures::output::{page_width, svg};
use crate::products::figure::{self, ArrowScale, Corners, FREEBODY, Fill, ForceStyle, Kind, Normalisation};

/// The least and the largest width in print, millimetres.
const WIDTHS_MM: std::ops::RangeInclusive<f64> = 2.0..=5080.0;
/// The least and the largest width of a page, pixels.
const WIDTHS_PX: std::ops::RangeInclusive<f64> = 100.0..=20_000.0;

/// The options of a figure, with the names of the options of `drystone render`.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct FigureOptions {
    kind: Option<String>,
    pub(super) block: Option<String>,
    pub(super) frame: Option<FrameChoice>,
    theme: Option<String>,
    /// The text of a style file, which changes the theme.
    style: Option<String>,
    width_mm: Option<f64>,
    width_px: Option<f64>,
    background: Option<String>,
    arrows: Arrows,
    normalise: Normalise,
    arrow_scale: Scale,
    fill: Colours,
    margin: Option<SensitivityMargin>,
    corners: bool,
    amounts: bool,
    no_title: bool,
    no_caption: bool,
    no_verdict: bool,
    no_key: bool,
    no_labels: bool,
    scale_bar: bool,
    dimensions: bool,
    with_polygon: bool,
    pub(super) zoom: Option<String>,
    columns: Option<u16>,
    /// The fraction of their paths, from 0 to 1, that the moving blocks of a mechanism have covered.
    way: Option<f64>,
    pub(super) broken: bool,
    pub(super) accuracy: Level,
    pub(super) wedging: bool,
    pub(super) contact_tolerance: Option<f64>,
    pub(super) time_limit: Option<f64>,
    pub(super) capacity: Option<String>,
    pub(super) for_all: Option<String>,
}

impl FigureOptions {
    /// Returns the kind of the figure; `None` for a free-body diagram. The error names the known kinds.
    pub(super) fn kind(&self) -> Result<Option<Kind>, Refusal> {
        match self.kind.as_deref() {
            None => Ok(Some(Kind::default())),
            Some(name) if name == FREEBODY => Ok(None),
            Some(name) => Kind::from_name(name).map(Some).ok_or_else(|| {
                let known = Kind::ALL.map(Kind::name).join(", ");
                Refusal::of_option(format!("kind must be {known} or {}, not {name:?}", FREEBODY))
            }),
        }
    }

    fn theme(&self) -> Result<Theme, Refusal> {
        let base = match self.theme.as_deref() {
            None => None,
            Some(name) => Some(Theme::named(name).ok_or_else(|| {
                let known = Theme::NAMES.join(", ");
                Refusal::of_option(format!("theme must be one of {known}, not {name:?}"))
            })?),
        };
        match &self.style {
            None => Ok(base.unwrap_or_default()),
            Some(text) => Theme::read(text, Notation::Json, base.as_ref())
                .map_err(|problems| Refusal::of_option(format!("style: {problems}"))),
        }
    }

    /// Returns the options of the figure. With `zoom`, the figure shows only the surroundings of this block.
    pub(super) fn figure(&self, zoom: Option<BlockId>) -> Result<figure::Options, Refusal> {
        if let Some(millimetres) = self.width_mm
            && !WIDTHS_MM.contains(&millimetres)
        {
            return Err(Refusal::of_option("width_mm is a width in millimetres, from 2 to 5080"));
        }
        if self.width_px.is_some_and(|width| !WIDTHS_PX.contains(&width)) {
            let why = "width_px is a width in pixels, from 100 to 20000";
            return Err(Refusal::of_option(why));
        }
        Ok(figure::Options {
            style: self.arrows.value(),
            normalisation: self.normalise.value(),
            scale: self.arrow_scale.value(),
            fill: self.fill.value(),
            toward: self.toward()?,
            titles: !self.no_title,
            captions: !self.no_caption,
            verdicts: !self.no_verdict,
            keys: !self.no_key,
            labels: !self.no_labels,
            scale_bar: self.scale_bar,
            dimensions: self.dimensions,
            with_polygon: self.with_polygon,
            corners: match self.corners {
                true => Corners::All,
                false => Corners::Few,
            },
            columns: self.columns.filter(|n| *n > 0).map(usize::from),
            amounts: self.amounts,
            width: self.width_px.or(self.width_mm.map(page_width)),
            motion_progress: self.way.unwrap_or(1.0).clamp(0.0, 1.0),
            theme: self.theme()?,
            zoom,
            ..figure::Options::default()
        })
    }

    /// Returns the margin that the option `margin` names; `None` without this option, which means the default margin.
    pub(super) fn margin(&self) -> Option<MarginKind> {
        self.margin.map(|margin| margin.0)
    }

    /// Returns the parameter that a margin figure varies. Returns an error for the margins friction and kernel, except
    /// in a sensitivity figure, which does not use the parameter.
    fn toward(&self) -> Result<Toward, Refusal> {
        let is_sensitivity = self.kind()?.is_some_and(Kind::needs_sensitivity);
        match self.margin().map(Toward::from_margin) {
            None => Ok(Toward::default()),
            Some(Some(toward)) => Ok(toward),
            Some(None) if is_sensitivity => Ok(Toward::default()),
            Some(None) => Err(Refusal::of_option(
                "the figure `margin` cannot show the margins friction and kernel; choose the kind sensitivity",
            )),
        }
    }

    /// Returns a drawing as SVG, with the background and the width that the options select.
    pub(super) fn svg(&self, drawing: Drawing) -> Result<String, Refusal> {
        let background = match self.background.as_deref() {
            None => drawing.background,
            Some("none") => None,
            Some("white") => Some(Colour::WHITE),
            Some(text) => Some(
                Colour::from_css(text)
                    .ok_or_else(|| Refusal::of_option("background is none, white or #rrggbb, such as #f4f1ea"))?,
            ),
        };
        let page = Drawing { background, ..drawing };
        let options = svg::Options { width_mm: self.width_mm, ..svg::Options::default() };
        svg::write_with(&page, &options).map_err(|error| Refusal::of_option(error.to_string()))
    }
}

/// Declares an enum for each option with a fixed set of words. Each variant is a word that the option accepts, with its
/// value for figures. The first variant is the default.
macro_rules! choices {
    ($($name:ident: $target:ty { $first:ident => $default:expr $(, $word:ident => $value:expr)* })*) => {
        $(
            #[derive(Clone, Copy, Debug, Default, Deserialize)]
            #[serde(rename_all = "kebab-case")]
            enum $name {
                #[default]
                $first,
                $($word),*
            }

            impl $name {
                fn value(self) -> $target {
                    match self {
                        $name::$first => $default,
                        $($name::$word => $value),*
                    }
                }
            }
        )*
    };
}

choices! {
    Arrows: ForceStyle { Resultant => ForceStyle::Resultant, Components => ForceStyle::Components }
    Normalise: Normalisation { Drawn => Normalisation::Drawn, Source => Normalisation::Source }
    Scale: ArrowScale { Panel => ArrowScale::Panel, Strip => ArrowScale::Strip }
    Colours: Fill {
        Amplitude => Fill::Amplitude, Stress => Fill::Stress, Friction => Fill::Friction, None => Fill::None,
        Source => Fill::Source
    }
}
