//! [`sheet`]: the two main sections of a report, about one frame. First what the structure is, with its inputs, reactions
//! and margins, then its forces, the governing collapse and the balance of forces as a check.

use super::collapse::{Collapse, has_vehicle, other_way};
use super::joints::{Ranking, base_joints, robots};
use super::part::FigureCount;
use super::unit::Units;
use super::{Badge, Figure, Grid, MarginBar, ReportOptions, Section, SheetPart, TableCell, balance, bullet, inputs};
use crate::mechanics::analysis::{
    self, Analysis, CaseResult, EffectName, FrameAnalysis, Influence, MarginKind, MovementOutcome, SolvedFrame,
    SupportMovement, Verdict,
};
use crate::mechanics::scene::Scene;
use crate::pictures::drawing::{Drawing, Theme};
use crate::products::figure::{self, At, Kind, Options};
use crate::products::wording::margin::headline;
use crate::products::wording::number::{letter, three_down};
use crate::products::wording::question::{self, thrust_range};
use crate::products::wording::{answer, sensitivity, verdict};
use crate::text::{capitalised, line};

/// Width of a figure of the whole page, pixels, the height of its picture, and that of the outline on the first page.
const WIDE: f64 = 680.0;
const WIDE_HEIGHT: f64 = 170.0;
const OUTLINE_HEIGHT: f64 = 230.0;
/// Width of a figure, in pixels. It is half a page, so that labels are legible in print and on a phone.
const FIGURE_WIDTH: f64 = 440.0;
/// Height of the picture in a figure, in pixels.
const FIGURE_HEIGHT: f64 = 300.0;
/// Largest number of positions of a vehicle in a table, and of movements and load cases with a figure, unless the report is
/// full.
const MAX_POSITIONS: usize = 12;
const MAX_DRAWN: usize = 4;
/// A table of more loads is as wide as the page.
const MAX_NARROW_LOADS: usize = 3;

/// Returns the options for figures in a report. The figures have no titles and no verdicts, because the page shows
/// both.
pub(super) fn options(report_options: &ReportOptions) -> Options {
    Options {
        theme: report_options.theme.clone(),
        titles: false,
        captions: false,
        verdicts: false,
        width: Some(FIGURE_WIDTH),
        height: Some(FIGURE_HEIGHT),
        ..Options::default()
    }
}

/// Makes a section without parts for the step with index `number`. Its title is the title of the step. If there are
/// several steps, the section also has a letter, and a step without a title is called `Step 1`, `Step 2`, ….
pub(super) fn empty(scene: &Scene, number: usize, verdict: Verdict) -> Section {
    let several = scene.frames.len() > 1;
    let title = line(&scene.frames[number].title);
    Section {
        letter: if several { letter(number) } else { String::new() },
        title: if title.is_empty() && several { format!("Step {}", number + 1) } else { title },
        verdict,
        begins_page: false,
        parts: Vec::new(),
    }
}

/// Makes the two main sections of a report, about the frame with index `number`. The first is what the structure is and
/// how far it is from falling, the second how forces run, how it falls, and the check. `steps` is the table of all steps
/// if the scene has several, otherwise `None`.
pub(super) fn sheet(
    analysis: &Analysis,
    number: usize,
    steps: Option<Grid>,
    report_options: &ReportOptions,
    count: &mut FigureCount,
) -> [Section; 2] {
    let solved @ SolvedFrame { scene, found, .. } = analysis.at(number);
    let mut first = empty(scene, number, found.verdict);
    let mut second = Section { letter: String::new(), title: String::new(), ..first.clone() };
    let collapse = Collapse::new(analysis, number);
    first.parts.push(SheetPart::Badge(Box::new(badge(solved))));
    let outline = drawn(analysis, number, report_options, &|options| {
        options.dimensions = true;
        (options.width, options.height) = (Some(WIDE), Some(OUTLINE_HEIGHT));
        Kind::Structure
    });
    let is_loaded = scene.loads.iter().any(|load| scene.frames[number].placed.contains(&load.block));
    let outline = outline.map(|(drawing, dark)| Figure {
        caption: if is_loaded {
            "The structure, its loads and its supports."
        } else {
            "The structure and its supports."
        }
        .to_owned(),
        drawing,
        dark,
        touches: Vec::new(),
        subject: Some((Kind::Structure, number)),
    });
    let mut outline: Vec<Figure> = outline.into_iter().collect();
    count.number(&mut outline);
    first.parts.push(SheetPart::Figures(outline));
    first.parts.extend(given(analysis.given(), solved, report_options.full));
    let reactions = balance::support_forces(analysis, number);
    first.parts.extend(titled("Reactions", reactions, other_balances(analysis, number)));
    first.parts.extend(titled("Margins", margins(solved), Some(bullet::SHAPES_LEGEND.to_owned())));
    first.parts.extend(titled("Load cases", cases(analysis.given(), solved), None));
    let notes = found.margins.iter().flat_map(|margins| &margins.notes);
    first.parts.extend(notes.map(|note| SheetPart::Note(line(&format!("Note: {note}.")))));

    let parts = &mut second.parts;
    let mut figures = figures(analysis, number, report_options, collapse.as_ref());
    let shown = count.number(&mut figures);
    // Wide structures are drawn below each other, others next to each other.
    let across = if is_wide(scene, number) { 1 } else { 2 };
    let level = scene.bounds(&scene.frames[number].placed).map_or(0.0, |bounds| bounds.min.y);
    let rows = |figures: &[Figure]| -> Vec<SheetPart> {
        figures.chunks(across).map(|row| SheetPart::row(row, level)).collect()
    };
    parts.extend(rows(&figures));
    if let Some(collapse) = &collapse {
        let falls = found.verdict == Verdict::Unstable;
        let heading = if falls { "Where it fails" } else { "Where it would fail first" };
        let (table, note) = collapse.table(analysis, number);
        parts.push(SheetPart::Heading(heading.to_owned()));
        parts.push(SheetPart::Text(format!("{} See {shown}.", collapse.words(analysis, number))));
        parts.push(SheetPart::Table(table));
        parts.push(SheetPart::Note(note));
    }
    if let Some(influence) = &found.vehicle {
        parts.push(SheetPart::Heading("Vehicle".to_owned()));
        parts.push(SheetPart::Text(format!("It {}.", line(&question::vehicle_sentence(scene, influence)))));
        parts.push(SheetPart::Table(positions(solved, influence, report_options.full)));
    }
    let mut cases = case_figures(analysis, number, report_options);
    if !cases.is_empty() {
        let shown = count.number(&mut cases);
        parts.push(SheetPart::Heading("Other load cases".to_owned()));
        parts.push(SheetPart::Text(format!("The load cases that do not govern: see {shown}.")));
        parts.extend(rows(&cases));
    }
    // The table is for loaded walls and dams. In a frame that falls, the listed forces do not balance.
    let has_loads = !scene.loads_on(&scene.frames[number].placed).is_empty();
    if found.verdict == Verdict::Stable && (report_options.full || has_loads) {
        let (beds, note) = base_joints(solved, report_options.full);
        parts.extend(titled("Base and bed joints", beds, Some(note)));
    }
    parts.push(SheetPart::Table(robots(solved)));
    parts.extend(movements(solved));
    let mut moved = movement_figures(analysis, number, report_options);
    if !moved.is_empty() {
        let shown = count.number(&mut moved);
        parts.push(SheetPart::Note(format!("See {shown}.")));
        parts.extend(rows(&moved));
    }
    parts.extend(titled("Blocks that may leave", removable(solved), None));
    if let Some(own) = &found.sensitivity {
        parts.push(SheetPart::Heading(format!("Sensitivity of the {}", sensitivity::name(own.kind, true))));
        parts.extend(sensitivity::lines(solved, own).iter().map(|words| SheetPart::Text(line(words))));
    }
    parts.push(SheetPart::Heading("Balance of forces".to_owned()));
    parts.push(SheetPart::Table(balance::whole(analysis, number)));
    parts.push(SheetPart::Note(balance::check_words(found)));
    let mut last = vec![assumptions(solved), verdict::proof_sentence(found.proof)];
    last.extend(remarks(solved));
    parts.push(SheetPart::Heading("Assumptions and proof".to_owned()));
    parts.push(SheetPart::Note(last.join(" ")));
    parts.extend(steps.into_iter().flat_map(|steps| titled("Steps", steps, None)));
    parts.retain(|part| !matches!(part, SheetPart::Note(words) if words.is_empty()));
    [first, second]
}

/// States that the listed forces are one balance among many, with the range of the horizontal thrust if it takes little
/// time to compute, or what the forces of a frame that does not stand are worth.
fn other_balances(analysis: &Analysis, number: usize) -> Option<String> {
    let found = &analysis.frames[number];
    match found.verdict {
        Verdict::Stable => {}
        Verdict::Unstable if found.failures.is_empty() => return None,
        Verdict::Unstable => return Some("These forces hold only together with the missing forces.".to_owned()),
        Verdict::Undecided => return Some("These forces are not proved.".to_owned()),
    }
    let range = thrust_range(analysis, number).map_or(String::new(), |range| format!(" {range}."));
    Some(format!("One possible balance, that of least forces; others may exist.{range}"))
}

/// True if the blocks of a frame are more than twice as wide as high.
fn is_wide(scene: &Scene, number: usize) -> bool {
    scene.bounds(&scene.frames[number].placed).is_some_and(|bounds| bounds.width() > 2.0 * bounds.height())
}

/// Draws steps that do not stand. `numbers` has the indices of the steps. Each step has its first figure, whose caption gives
/// the reason for its verdict.
pub(super) fn others(analysis: &Analysis, numbers: &[usize], report_options: &ReportOptions) -> Vec<SheetPart> {
    let one = |number: &usize| {
        let solved = analysis.at(*number);
        let own = empty(solved.scene, *number, solved.found.verdict);
        let collapse = Collapse::new(analysis, *number);
        let figure = figures(analysis, *number, report_options, collapse.as_ref()).into_iter().next()?;
        let caption = format!("({}) {}: {}. {}", own.letter, own.title, own.verdict.plain(), sentence(solved));
        Some(Figure { caption, touches: Vec::new(), ..figure })
    };
    let figures: Vec<Figure> = numbers.iter().filter_map(one).collect();
    let level = analysis.given().bounds(&analysis.given().frames[0].placed).map_or(0.0, |bounds| bounds.min.y);
    figures.chunks(2).map(|row| SheetPart::row(row, level)).collect()
}

/// Returns a sentence with the verdict and its reasons.
fn sentence(solved: SolvedFrame<'_>) -> String {
    line(&verdict::sentence(solved))
}

/// Makes the verdict with the headline margin. The sentence with the reasons is left out if the frame stands without any.
fn badge(solved: SolvedFrame<'_>) -> Badge {
    let found = solved.found;
    let is_plain = found.verdict == Verdict::Stable && found.only_by_wedging != Some(true);
    Badge {
        verdict: found.verdict,
        headline: line(&headline(solved)),
        sentence: if is_plain { String::new() } else { sentence(solved) },
    }
}

/// Draws a figure for light pages and, if requested, for dark pages. `change` sets the options and returns the kind.
fn drawn(
    analysis: &Analysis,
    number: usize,
    report_options: &ReportOptions,
    change: &dyn Fn(&mut Options) -> Kind,
) -> Option<(Drawing, Option<Drawing>)> {
    let one = |theme: &Theme| {
        let mut options = Options { theme: theme.clone(), ..options(report_options) };
        let kind = change(&mut options);
        figure::panels_of(analysis, kind, &options, &[number]).into_iter().next()
    };
    Some((one(&report_options.theme)?, report_options.dark.as_ref().and_then(one)))
}

/// Draws the forces of a frame, and how it falls or would fall. A falling frame begins with its fall.
fn figures(
    analysis: &Analysis,
    number: usize,
    report_options: &ReportOptions,
    collapse: Option<&Collapse>,
) -> Vec<Figure> {
    let solved @ SolvedFrame { found, .. } = analysis.at(number);
    let forces = match found.verdict {
        Verdict::Stable => "The forces of one possible balance.",
        Verdict::Unstable if found.failures.is_empty() => "The forces.",
        Verdict::Unstable => "The forces; missing forces have the colour of failures.",
        Verdict::Undecided => "Forces that are not proved.",
    };
    let mut kinds = vec![(Kind::Forces, None, forces)];
    let shown = collapse.and_then(|collapse| collapse.figure(found));
    let other = || {
        let toward = other_way(analysis, number).filter(|_| !has_vehicle(found));
        toward.map(|toward| (Kind::Mechanism, Some(At::Margin(toward))))
    };
    match shown.or_else(other) {
        Some((kind, None)) => kinds.insert(0, (kind, None, "How it begins to fall.")),
        Some((kind, at)) => kinds.push((
            kind,
            at,
            match at.and_then(At::margin) {
                Some(MarginKind::Tilt) => "How it would fall if gravity turned further than its margin.",
                Some(MarginKind::HorizontalLoad) => "How it would fall under a larger push to the side.",
                _ => "How it would fall under more than its margin of loads.",
            },
        )),
        None => {}
    }
    if found.vehicle.is_some() {
        let caption =
            "The load factor for each position of the first axle, and the collapse at the governing position.";
        kinds.insert(0, (Kind::Mechanism, Some(At::Vehicle), caption));
    }
    let mut figures = Vec::new();
    for (kind, at, caption) in kinds {
        let figure = figure(analysis, number, report_options, (kind, &|options| options.at = at), caption.to_owned());
        if let Some(figure) = figure {
            let touches = if figures.is_empty() { Ranking::new(solved).touches() } else { Vec::new() };
            figures.push(Figure { touches, ..figure });
        }
    }
    figures
}

/// Makes a figure of a frame; wide structures have a wide one. The function sets the options.
fn figure(
    analysis: &Analysis,
    number: usize,
    report_options: &ReportOptions,
    (kind, change): (Kind, &dyn Fn(&mut Options)),
    caption: String,
) -> Option<Figure> {
    let change = |options: &mut Options| {
        change(options);
        if is_wide(analysis.given(), number) {
            (options.width, options.height) = (Some(WIDE), Some(WIDE_HEIGHT));
        }
        kind
    };
    let (drawing, dark) = drawn(analysis, number, report_options, &change)?;
    Some(Figure { caption, drawing, dark, touches: Vec::new(), subject: Some((kind, number)) })
}

/// Draws how the structure cracks as each of its supports moves.
fn movement_figures(analysis: &Analysis, number: usize, report_options: &ReportOptions) -> Vec<Figure> {
    let SolvedFrame { scene, found, .. } = analysis.at(number);
    let follows = |moved: &&SupportMovement| matches!(moved.outcome, MovementOutcome::Follows(_));
    let all = found.movements.iter().enumerate().filter(|(_, moved)| follows(moved));
    let all = all.take(if report_options.full { usize::MAX } else { MAX_DRAWN });
    let drawn = all.filter_map(|(place, moved)| {
        let change = |options: &mut Options| (options.at, options.movement) = (Some(At::Movement), Some(place + 1));
        let caption =
            format!("How the structure cracks if {}, enlarged.", line(&question::movement(scene, moved.number)));
        figure(analysis, number, report_options, (Kind::Mechanism, &change), caption)
    });
    drawn.collect()
}

/// Draws the frame in each load case but the governing one: its forces, or how it falls.
fn case_figures(analysis: &Analysis, number: usize, report_options: &ReportOptions) -> Vec<Figure> {
    let given = analysis.given();
    let Some(cases) = &analysis.frames[number].cases else { return Vec::new() };
    let others = given.in_cases().enumerate().filter(|(place, _)| *place != cases.governing);
    let others = others.take(if report_options.full { usize::MAX } else { MAX_DRAWN });
    let drawn = others.filter_map(|(_, (case, scene))| {
        let frames = vec![given.frames[number].clone()];
        let alone = Scene { frames, movements: Vec::new(), vehicle: None, ..scene };
        let found = Analysis::with(alone, &analysis::Options::default());
        let (kind, what) = match found.verdict() {
            Verdict::Unstable => (Kind::Mechanism, "how it begins to fall"),
            Verdict::Undecided => (Kind::Forces, "forces that are not proved"),
            Verdict::Stable => (Kind::Forces, "the forces of one possible balance"),
        };
        let caption = format!("Load case {}: {what}.", line(&case.id));
        // The step is that of the page, which an interactive figure shows.
        Some(Figure { subject: None, ..figure(&found, 0, report_options, (kind, &|_| ()), caption)? })
    });
    drawn.collect()
}

/// Returns a table with its heading and a note; empty if the table has no rows.
fn titled(heading: &str, grid: Grid, note: Option<String>) -> Vec<SheetPart> {
    if grid.lines.is_empty() {
        return Vec::new();
    }
    let mut parts = vec![SheetPart::Heading(heading.to_owned()), SheetPart::Table(grid)];
    parts.extend(note.map(SheetPart::Note));
    parts
}

/// Makes two columns with the inputs of the frame with index `number`, and below them a long table of loads. The weights
/// are those of the scene as it is `given`. The loads are those of the condition that governs, in which `scene` has them. A
/// `full` report lists all of them.
fn given(given: &Scene, solved: SolvedFrame<'_>, full: bool) -> Vec<SheetPart> {
    let SolvedFrame { scene, found, number, .. } = solved;
    let units = Units::new(solved);
    let mut left = titled("Materials", inputs::materials(given, number, units), None);
    let most = if full { usize::MAX } else { inputs::MAX_ROWS };
    left.extend(titled("Vehicle", inputs::vehicle(given, units), None));
    let loads = inputs::loads(given, solved, most);
    // In a narrow column, a row of loads has three lines.
    let is_long = loads.lines.len() > MAX_NARROW_LOADS;
    let governing = found.cases.as_ref().and_then(|cases| given.cases().get(cases.governing));
    let note = governing.map(|case| {
        format!("The amounts are those in the load case {}: {}.", line(&case.id), inputs::factors(given, case))
    });
    let loads = titled("Loads", loads, note);
    let below = if is_long {
        loads
    } else {
        left.extend(loads);
        Vec::new()
    };
    left.extend(titled("Robots", inputs::robots(scene, number, most), None));
    let right = titled("Supports and settings", inputs::facts(given, number, most), None);
    let columns = SheetPart::Columns(vec![left, right]);
    std::iter::once(columns).chain(below).collect()
}

/// Makes the table of the margins and of the placement tolerance, each as a bar with numbers at both ends and the
/// present value.
fn margins(solved: SolvedFrame<'_>) -> Grid {
    let mut grid = Grid::new("", &["margin", "#lower limit", "range", "upper limit", "#present value"]);
    let margins = bullet::margin_bars(solved);
    for bar in margins.into_iter().chain(bullet::placement_bar(solved)) {
        let [from, to, now] = bar.ends_and_present.clone().map(TableCell::from);
        grid.add("", [TableCell::from(bar.name.clone()), from, TableCell::bar(bar), to, now]);
    }
    grid
}

/// Makes the table of the load cases. Each row has the headline margin of its case as a bar, and the worst case is
/// emphasised. If all rows show the same margin, their bars have one scale.
fn cases(given: &Scene, solved: SolvedFrame<'_>) -> Grid {
    let frame_analysis = solved.found;
    let mut grid =
        Grid::new("", &["load case", "consists of", "verdict", "margin", "#lower limit", "range", "upper limit"]);
    let Some(cases) = &frame_analysis.cases else { return grid };
    let of = |case: &CaseResult| {
        let (margins, verdict) = (case.margins.clone(), case.verdict);
        bullet::margin_bars(solved.with_results(&FrameAnalysis { margins, verdict, ..frame_analysis.clone() }))
            .into_iter()
            .next()
    };
    let bars: Vec<Option<MarginBar>> = cases.each.iter().map(of).collect();
    let is_alike = |name: &str| bars.iter().flatten().all(|bar| bar.name == name);
    let scales = || bars.iter().flatten().map(|bar| bar.scale);
    let scale = scales().fold((0.0_f64, 0.0_f64), |(low, high), scale| (low.min(scale.0), high.max(scale.1)));
    let has_worst = cases.each.len() > 1 && question::worst_case(frame_analysis).is_some();
    for (number, (case, bar)) in cases.each.iter().zip(&bars).enumerate() {
        let name = TableCell::strong_if(has_worst && number == cases.governing, line(&case.id));
        let verdict = TableCell::from(case.verdict.plain());
        let [margin, from, shown, to] = match bar.clone() {
            Some(mut bar) => {
                if is_alike(&bar.name) {
                    bar.scale = scale;
                }
                let [from, to, _] = bar.ends_and_present.clone().map(TableCell::from);
                [TableCell::from(bar.name.clone()), from, TableCell::bar(bar), to]
            }
            None => ["–", "", "", ""].map(TableCell::from),
        };
        let parts = given.cases().get(number).map_or(String::new(), |case| inputs::factors(given, case));
        grid.add("", [name, TableCell::from(parts), verdict, margin, from, shown, to]);
    }
    grid
}

/// Makes the table of the positions of the vehicle, in the order of travel: those with the least factors, all in a `full` report.
fn positions(solved: SolvedFrame<'_>, influence: &Influence, full: bool) -> Grid {
    let scene = solved.scene;
    let factor = |number: &usize| influence.positions[*number].factor.unwrap_or(f64::INFINITY);
    let mut shown: Vec<usize> = (0..influence.positions.len()).collect();
    shown.sort_by(|a, b| factor(a).total_cmp(&factor(b)));
    shown.truncate(if full { usize::MAX } else { MAX_POSITIONS });
    shown.sort_unstable();
    let several = shown.len() < influence.positions.len();
    let caption = if several { "The positions with the least load factors" } else { "" };
    let places = shown.iter().map(|number| influence.positions[*number].at);
    let metres = Units::new(solved).lengths(places);
    let heads = [metres.head("first axle at x"), "travels".into(), "axles on".into(), "#load factor".into()];
    let mut grid = Grid::new(caption, &heads);
    for number in shown {
        let own = &influence.positions[number];
        let on = own.axles.iter().map(|(axle, block, _)| format!("{}: {}", axle + 1, line(&scene.blocks[block.0].id)));
        let cells = [
            metres.write(own.at),
            if own.to_right { "to the right" } else { "to the left" }.to_owned(),
            on.collect::<Vec<_>>().join(", "),
            own.factor.map_or("no limit".to_owned(), three_down),
        ];
        let governs = influence.governing == Some(number);
        grid.add("", cells.map(|words| TableCell::strong_if(governs, words)));
    }
    grid
}

/// Returns the table of the movements of supports, if there are any.
fn movements(solved: SolvedFrame<'_>) -> Vec<SheetPart> {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let mut grid = Grid::new("", &["movement of the support", "force on the support", "joints that open most"]);
    let cases = frame_analysis.cases.iter();
    let of_cases =
        cases.flat_map(|cases| cases.each.iter().map(|case| (format!("case {}: ", case.id), &case.movements)));
    let mut each: Vec<(String, &Vec<SupportMovement>)> = of_cases.collect();
    if each.is_empty() {
        each.push((String::new(), &frame_analysis.movements));
    }
    for (case, moved) in each.iter().flat_map(|(case, all)| all.iter().map(move |moved| (case, moved))) {
        let [force, joints] = match &moved.outcome {
            MovementOutcome::Follows(cracked) => {
                [question::movement_force(scene, cracked), question::cracks(solved, cracked)]
            }
            other => [String::new(), question::without_state(other).to_owned()],
        };
        grid.add(
            "",
            [format!("{case}{}", question::movement(scene, moved.number)), force, joints].map(|words| line(&words)),
        );
    }
    let note = "Of all forces that balance the structure, those whose force on the support does least work on the \
                movement (H to the right, V upwards). Small displacements, per millimetre of the movement; a joint that \
                slides also opens, by μ times the slip.";
    titled("Movements of supports", grid, Some(note.to_owned()))
}

/// Makes the table of the blocks that may leave, if they were asked for.
fn removable(solved: SolvedFrame<'_>) -> Grid {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let mut grid = Grid::new("", &["block", "may leave", "#least force of a robot that holds it"]);
    for cells in question::removable_rows(scene, frame_analysis.removable.as_deref().unwrap_or_default()) {
        grid.add("", cells.map(|words| line(&words)));
    }
    grid
}

fn assumptions(solved: SolvedFrame<'_>) -> String {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let order = if scene.frames.len() == 1 { ", the order of construction" } else { "" };
    let least = match (frame_analysis.verdict, frame_analysis.least_force) {
        (Verdict::Stable, false) => " It was not proved that the balance shown has the least sum of forces.",
        _ => "",
    };
    format!(
        "Rigid blocks in one plane, at rest, dry joints: compression and Coulomb friction, no tension. Not considered: \
         strength of the stone, settlement, impact, earthquakes{order}.{least}"
    )
}

/// Returns the remarks at the end of the main section. They are the placement tolerance, the blocks that may leave, the
/// result of the test for wedging, if the test was made and did not show that the structure stands without wedging, and
/// the notices of the analysis.
fn remarks(solved: SolvedFrame<'_>) -> Vec<String> {
    let SolvedFrame { found: frame_analysis, .. } = solved;
    // Movements and a vehicle have tables.
    let answers = answer::sentences(solved).into_iter().filter(|(name, _)| !["movement", "vehicle"].contains(name));
    let answers = answers.map(|(name, words)| format!("{}: {}.", capitalised(name), line(&words)));
    let wedging = frame_analysis
        .effects
        .iter()
        .find(|e| e.effect == EffectName::Wedging && e.simulated)
        .filter(|_| frame_analysis.only_by_wedging != Some(false));
    let wedging = wedging.map(|w| format!("Wedging: {}.", line(&w.why)));
    let notices = frame_analysis.notices.iter().map(|n| format!("Note: {}.", line(n)));
    answers.chain(wedging).chain(notices).collect()
}
