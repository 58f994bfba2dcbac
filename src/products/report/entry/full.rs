//! [`appendix`]: the results of a frame that only a full report shows.

use super::cost::cost;
use super::joints::{Ranking, missing};
use super::sheet::empty;
use super::unit::Units;
use super::{Chart, Grid, ReportOptions, Section, SheetPart};
use crate::mechanics::analysis::{Analysis, FrameAnalysis};
use crate::mechanics::scene::Scene;
use crate::pictures::chart::{self, Bars};
use crate::products::wording::number::{place, prefixed};
use crate::products::wording::{failure, proof};
use crate::text::line;

/// Frames with fewer joints have no charts, because a short table is easier to read than a chart.
const MIN_CHART_JOINTS: usize = 8;

/// Makes the appendix of a frame: all joints that carry force, all failures, effects with their cost, the proof in
/// numbers, and charts. `number` is the index of the frame.
pub(super) fn appendix(analysis: &Analysis, number: usize, report_options: &ReportOptions) -> Section {
    let (scene, frame_analysis) = (&analysis.scene, &analysis.frames[number]);
    let mut section = empty(scene, number, frame_analysis.verdict);
    section.title = format!("Appendix {}", section.title).trim_end().to_owned();
    let grids = [
        Ranking::new(scene, frame_analysis).table(true),
        failures(scene, frame_analysis),
        cost(frame_analysis, report_options.timing),
        proved(frame_analysis),
    ];
    section.begins_page = true;
    section.parts.extend(grids.map(SheetPart::Table));
    section.parts.push(SheetPart::Charts(charts(frame_analysis)));
    section
}

fn failures(scene: &Scene, frame_analysis: &FrameAnalysis) -> Grid {
    let mut grid = Grid::new("What fails", &["what", "at"]);
    for what in failure::unsupported(scene, frame_analysis, usize::MAX) {
        grid.add("", [line(&what), String::new()]);
    }
    let units = Units::new(scene, frame_analysis);
    for (number, failed) in frame_analysis.failures.iter().enumerate() {
        let cells = [line(&missing(scene, failed, units)), place(failed.at(), scene.units)];
        grid.add(format!("f{number}"), cells);
    }
    grid
}

fn proved(frame_analysis: &FrameAnalysis) -> Grid {
    let mut grid = Grid::new("The proof in numbers", &["what", "#how much"]);
    for (what, much) in proof::numbers(frame_analysis.proof) {
        grid.add("", [what.to_owned(), much]);
    }
    grid
}

fn charts(frame_analysis: &FrameAnalysis) -> Vec<Chart> {
    if frame_analysis.contacts.len() < MIN_CHART_JOINTS {
        return Vec::new();
    }
    let sizes = || frame_analysis.contacts.iter().map(|c| c.resultant.force.norm());
    let (unit, factor) = prefixed(sizes().fold(0.0, f64::max), "N");
    let forces: Vec<f64> = sizes().map(|size| size * factor).collect();
    let loaded = frame_analysis.contacts.iter().filter(|c| c.resultant.force.norm() > 0.0);
    let used: Vec<f64> = loaded.map(|c| 100.0 * c.friction_used).collect();
    let kinds = [
        ("Number of joints by force", format!("force at a joint, {unit}"), Bars::counted(&forces, None)),
        (
            "Number of loaded joints by share of friction used",
            "friction used, %".to_owned(),
            Bars::counted(&used, Some(100.0)),
        ),
    ];
    let drawn = kinds.into_iter().filter_map(|(caption, x, bars)| {
        let chart = Bars { title: caption.to_owned(), x, y: "joints".to_owned(), ..bars };
        // `chart::bars` returns an error if there are no values. The chart is then left out.
        let svg = chart::bars(&chart).ok()?;
        Some(Chart { caption: caption.to_owned(), svg, wide: false })
    });
    drawn.collect()
}
