//! [`entries`]: makes the legend of the figure of force flow.

use super::super::arrow::Marks;
use super::super::context::FigureContext;
use super::super::legend::{self, Entry, MissingWords};
use super::super::option::ArrowScale;
use super::super::words::{quantity, round_below_in};
use super::strand::{Strand, StrandKind, strands};
use super::{
    MAX_SINGLE_STRANDS, MIN_BAND_WIDTH, MISSING_SIGN, carried, colour, dot_symbol, largest, missing_symbol, widest,
};
use crate::mechanics::analysis::Verdict;

/// Returns the legend entries of a figure of force flow. `unit` is the unit length in pixels.
pub(super) fn entries(context: &FigureContext<'_>, unit: f64) -> Vec<Entry> {
    let scene = &*context.analysis.scene;
    let frames = || scene.frames.iter().zip(&context.analysis.frames);
    let all: Vec<(Verdict, Strand)> = frames()
        .flat_map(|(frame, frame_analysis)| {
            let strands = strands(scene, frame, frame_analysis, 0.0).into_iter();
            strands.map(|strand| (frame_analysis.verdict, strand))
        })
        .collect();
    let mut entries = Vec::new();
    if context.options.scale == ArrowScale::Strip {
        entries.extend(legend::shared_scale(context, unit));
    }
    entries.extend(bands(context, unit, &all));
    let most = scene.frames.iter().map(|f| f.placed.len()).max();
    if !all.is_empty() && most.unwrap_or(0) <= MAX_SINGLE_STRANDS {
        let words = if context.options.is_column() { "resultant" } else { "resultant of a joint" };
        entries.push(Entry::Symbol(dot_symbol, 8.0, words.to_owned()));
        entries.extend(legend::limits(context));
    }
    entries.extend(legend::loads(context));
    entries.extend(legend::robots(context));
    if all.iter().any(|s| !s.1.exact) {
        let words = if context.options.is_column() {
            "paths inside blocks are schematic, widths to scale"
        } else {
            "inside a block, paths are schematic and widths are to scale"
        };
        entries.push(Entry::Note(words.to_owned()));
    }
    entries
}

/// True if the arrows of the missing forces of a frame do not all have one scale, because those of small forces have a
/// least length.
fn has_lengthened(marks: &Marks) -> bool {
    let missing = marks.arrows.iter().filter(|a| a.kind.is_failure());
    let scales = missing.map(|a| a.vector.norm() / a.force.norm());
    let (least, most) =
        scales.fold((f64::INFINITY, 0.0), |(least, most), scale| (f64::min(least, scale), f64::max(most, scale)));
    most > 1.01 * least
}

/// Returns the legend entries for the bands. `all` contains each strand of the figure with the verdict of its frame.
/// `unit` is the unit length in pixels.
fn bands(context: &FigureContext<'_>, unit: f64, all: &[(Verdict, Strand)]) -> Vec<Entry> {
    let theme = &context.options.theme;
    let mut entries = Vec::new();
    let any = |kind: StrandKind| all.iter().find(|s| s.1.kind == kind).map(|s| s.0);
    let largest = largest(context);
    let newtons = context.analysis.scene.units.force();
    let amount = round_below_in(largest, newtons);
    if let Some(verdict) = any(StrandKind::Carried).or(any(StrandKind::Weight)) {
        let width = widest(unit) * amount / largest.max(f64::MIN_POSITIVE);
        let what = match verdict {
            Verdict::Stable => "force",
            _ => "carried force",
        };
        let thin = MIN_BAND_WIDTH / widest(unit) * largest;
        let thinner = |s: &Strand| s.widths.iter().any(|w| *w < thin);
        let least = match all.iter().any(|s| thinner(&s.1)) {
            true if context.options.is_column() => {
                format!("; one width under {}", quantity(thin, newtons))
            }
            true => format!("; all forces under {} have the same width", quantity(thin, newtons)),
            false => String::new(),
        };
        let words = format!("{what}; this width shows {}{least}", quantity(amount, newtons));
        entries.push(Entry::Line(carried(theme, verdict), width, words));
    }
    if let Some(verdict) = any(StrandKind::Weight) {
        let light = colour(theme, verdict, StrandKind::Weight);
        entries.push(Entry::Line(light, 2.5, "weight".into()));
    }
    if any(StrandKind::Missing).is_some() {
        let words = "force that cannot be carried".to_owned();
        entries.push(Entry::Symbol(missing_symbol, MISSING_SIGN, words));
        entries.push(Entry::Missing(MissingWords::Usual));
    }
    if context.marks.iter().any(has_lengthened) {
        let words = "small missing forces are drawn larger".to_owned();
        entries.push(Entry::Note(words));
    }
    entries
}
