//! [`DrawArgs`]: draws a figure or an animation of an analysis. `drystone render` and the Python package share it.

use crate::entry::cli::error::CliError;
use crate::entry::cli::picture::{Drawn, Format, Picture, or_split};
use crate::entry::cli::style_args::StyleArgs;
use crate::entry::request::FigureArgs;
use crate::entry::value::{Background, between};
use crate::mechanics::analysis::Analysis;
use crate::pictures::drawing::Theme;
use crate::pictures::output::animation;
use crate::pictures::output::fonts::Fonts;
use crate::products::figure;

/// The width of an animation in pixels, if none is given.
const ANIMATION_WIDTH: u32 = 800;
/// A strip of more frames than this may be too large for a PNG.
const MAX_PNG_FRAMES: usize = 50;
/// A strip higher than this many page heights does not fit on a page.
const MAX_PAGE_HEIGHTS: f64 = 1.02;

request! {
    /// What is drawn, in which style, and as what kind of file.
    #[derive(Clone, Debug)]
    pub(crate) struct DrawArgs(given) {
        picture: Picture = Picture::read(given), command(flatten);
        look: StyleArgs = StyleArgs::read(given), command(flatten);
        figure: FigureArgs = FigureArgs::read(given), command(flatten);
        /// Show the frames one after the other in a GIF or an animated PNG, each for this many seconds; falling blocks
        /// move for this time along their mechanism, as far as no block enters another, and then rest for one second
        animate: Option<f64> = given.value("animate", seconds),
            arg(long, value_name = "SECONDS", value_parser = seconds);
    }
}

impl DrawArgs {
    /// Refuses options that do not fit the kind of figure or the format.
    pub(crate) fn check(&self, format: Format) -> Result<(), CliError> {
        self.picture.check(format)?;
        self.figure.check()?;
        if self.animate.is_some() && (format.animate().is_none() || self.figure.kind().shows_one_block()) {
            return Err(
                "--animate makes a GIF or PNG of the frames of a figure; write a .gif or .png, of any kind but freebody"
                    .into(),
            );
        }
        if self.look.is_auto() && matches!(self.picture.background, Some(Background::Plain(_))) {
            return Err("--theme auto has a light and a dark page; leave out --background, or choose none".into());
        }
        Ok(())
    }

    /// Returns the options of the figure, without the block of `--zoom`, which depends on the scene.
    pub(crate) fn options(&self) -> Result<figure::Options, CliError> {
        Ok(self.figure.options(self.look.light_theme()?, self.picture.page())?)
    }

    /// Draws a figure, or an animation, of an analysis that has all results for it, and returns the bytes of the file.
    /// The second value is true if a figure of several frames is higher than a page.
    pub(crate) fn bytes(
        &self,
        analysis: &Analysis,
        options: &figure::Options,
        format: Format,
        fonts: &Fonts,
    ) -> Result<(Vec<u8>, bool), CliError> {
        let kind = self.figure.kind();
        let steps = if kind.shows_one_block() { 1 } else { analysis.frames.len() };
        let split = |error| or_split(error, steps);
        if let Some(seconds) = self.animate {
            let film = figure::film(analysis, kind, options, seconds);
            let animate = format.animate().unwrap_or(animation::gif);
            let picture = self.picture.clone().or_width(ANIMATION_WIDTH, format);
            return Ok((picture.animated(film, animate, fonts)?, false));
        }
        if format == Format::Png && steps > MAX_PNG_FRAMES {
            // Check the size before the layout, which takes a long time for a figure with many frames.
            self.picture.check_png(figure::least_size(analysis, kind, options)).map_err(split)?;
        }
        let drawing = figure::draw(analysis, kind, options);
        let is_high = steps > 1 && drawing.height > MAX_PAGE_HEIGHTS * self.picture.page_ratio() * drawing.width;
        let dark = self.dark(options).map(|options| figure::draw(analysis, kind, &options));
        Ok((self.picture.bytes(Drawn { drawing, dark }, format, fonts).map_err(split)?, is_high))
    }

    /// Returns the options of the same figure on dark pages if one SVG has both.
    fn dark(&self, options: &figure::Options) -> Option<figure::Options> {
        self.look.is_auto().then(|| figure::Options { theme: Theme::dark(), ..options.clone() })
    }

    /// Draws the pages or the panels of a figure as separate files.
    pub(crate) fn parts(
        &self,
        analysis: &Analysis,
        kind: figure::Kind,
        options: &figure::Options,
        pages: bool,
    ) -> Vec<Drawn> {
        let drawn = |options: &figure::Options| {
            if pages {
                figure::split(analysis, kind, options, self.picture.page_ratio())
            } else {
                figure::panels(analysis, kind, options)
            }
        };
        let mut dark = self.dark(options).map(|options| drawn(&options)).unwrap_or_default().into_iter();
        drawn(options).into_iter().map(|drawing| Drawn { drawing, dark: dark.next() }).collect()
    }
}

fn seconds(typed: &str) -> Result<f64, String> {
    between(typed, [0.01, 600.0], || "it must be a time in seconds, from 0.01 to 600".into())
}
