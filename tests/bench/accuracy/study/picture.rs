//! [`picture`]: draws an accuracy study as one picture. Each row shows one method: its time, its error and its
//! numbers of wrong and undecided verdicts at every tolerance.

use drystone::analysis::Accuracy;
use drystone::drawing::{Anchor, Colour, Drawing, Face, Item, Outline, PagePoint, PageRect, Path, Stroke, Text, Theme};
use drystone::internals::solve::TOLERANCE;
use drystone::output::svg::{self, OutlineError, Words};

use super::{Method, Summary};

pub const WIDTH: f64 = 920.0;
/// Height of a row, pixels.
const ROW_HEIGHT: f64 = 32.0;
/// y coordinate of the top of the first row, pixels.
const FIRST_ROW_TOP: f64 = 138.0;
/// x coordinates of the left and the right end of the time axis, pixels.
const TIME_AXIS: (f64, f64) = (220.0, 350.0);
/// x coordinates of the left and the right end of the error axis, pixels.
const ERROR_AXIS: (f64, f64) = (395.0, 550.0);
/// x coordinates of the first and the last column of numbers of wrong verdicts, pixels. Each tolerance has a column.
const WRONG_COLUMNS: (f64, f64) = (600.0, 730.0);
/// x coordinates of the first and the last column of numbers of undecided verdicts, pixels.
const UNDECIDED_COLUMNS: (f64, f64) = (764.0, 894.0);
/// Font sizes in pixels: first of method names and numbers of verdicts, then of all explanations and axis labels.
const FONT_SIZES: (f64, f64) = (15.0, 13.0);
/// Errors below this value are drawn at this value, because they are rounding errors of f64.
const MIN_DRAWN_ERROR: f64 = 1e-16;

/// Draws the summary of a study as SVG, with text as outlines. `frames` is the number of frames of the study.
///
/// # Errors
/// [`OutlineError`] if the text cannot be laid out.
pub fn picture(lines: &[Summary], frames: usize) -> Result<String, OutlineError> {
    let options = svg::Options::default().words(Words::Outlines);
    svg::write_with(&drawing(lines, frames), &options)
}

pub fn drawing(lines: &[Summary], frames: usize) -> Drawing {
    let theme = Theme::thesis();
    let mut tolerances: Vec<f64> = lines.iter().map(|l| l.tolerance).collect();
    tolerances.sort_by(|a, b| b.total_cmp(a));
    tolerances.dedup();
    let methods: Vec<Method> =
        Method::ALL.into_iter().filter(|method| lines.iter().any(|l| l.method == *method)).collect();
    let times = lines.iter().map(|l| l.time).filter(|t| *t > 0.0);
    let (fastest, slowest) = times.fold((1.0_f64, 1.0_f64), |(a, b), t| (a.min(t), b.max(t)));
    let page = Page {
        theme: &theme,
        times: (0.9 * fastest, 1.1 * slowest),
        tolerances: &tolerances,
        bottom: FIRST_ROW_TOP + ROW_HEIGHT * methods.len() as f64,
    };
    let mut items = page.head(frames);
    for (row, method) in methods.iter().enumerate() {
        let of = lines.iter().filter(|l| l.method == *method);
        items.extend(page.row(row, *method, &of.collect::<Vec<_>>()));
    }
    let sentence = "A dot is one tolerance of the solver, from loose (pale) to tight (dark); the default is ringed. Red: \
                    some verdict is wrong.";
    let at = PagePoint::new(24.0, page.bottom + 34.0);
    items.push(page.words(at, sentence, Face::Sans));
    Drawing {
        width: WIDTH,
        height: page.bottom + 52.0,
        title: "What accuracy costs".into(),
        description: described(lines, frames),
        background: Some(theme.page),
        items,
    }
}

/// Describes the picture for readers who cannot see it: the time of each method, and its wrong and undecided verdicts,
/// at the default tolerance.
fn described(lines: &[Summary], frames: usize) -> String {
    let at = |line: &&Summary| is_default(line.tolerance);
    let described = lines.iter().filter(at).map(|line| {
        format!(
            "{}: {:.2} times the time of standard, {} of {frames} verdicts wrong and {} undecided",
            line.method.name(),
            line.time,
            line.wrong,
            line.undecided
        )
    });
    let described: Vec<String> = described.collect();
    format!("At the default tolerance, {}.", described.join("; "))
}

/// True if a tolerance equals the default of the solver up to about 2 %.
fn is_default(tolerance: f64) -> bool {
    libm::log10(tolerance / TOLERANCE).abs() < 0.01
}

/// The layout of the picture.
struct Page<'p> {
    theme: &'p Theme,
    /// The least and the largest time on the time axis, relative to the time of the method `standard`.
    times: (f64, f64),
    /// The tolerances of the study, the loosest first.
    tolerances: &'p [f64],
    /// y coordinate of the bottom of the last row, pixels.
    bottom: f64,
}

impl Page<'_> {
    fn words(&self, at: PagePoint, words: &str, face: Face) -> Item {
        Text::new(at, words, face, FONT_SIZES.1, self.theme.faint).into()
    }

    /// Draws the title and the column heads, with the ticks below them.
    fn head(&self, frames: usize) -> Vec<Item> {
        let theme = self.theme;
        let title = "What accuracy costs";
        let title = Text::new(PagePoint::new(24.0, 36.0), title, Face::SerifBold, 22.0, theme.ink);
        let under = format!("{frames} frames, drystone {}", env!("CARGO_PKG_VERSION"));
        let mut items: Vec<Item> = vec![title.into(), self.words(PagePoint::new(24.0, 58.0), &under, Face::Sans)];
        let heads = [
            (TIME_AXIS.0, ["time, relative", "to standard"]),
            (ERROR_AXIS.0, ["worst error of", "the total force"]),
            (WRONG_COLUMNS.0 - 10.0, ["wrong verdicts,", "tolerance 10ⁿ, n ="]),
            (UNDECIDED_COLUMNS.0 - 10.0, ["undecided,", "tolerance 10ⁿ, n ="]),
        ];
        for (x, [upper, lower]) in heads {
            items.push(self.words(PagePoint::new(x, FIRST_ROW_TOP - 50.0), upper, Face::SansBold));
            items.push(self.words(PagePoint::new(x, FIRST_ROW_TOP - 34.0), lower, Face::SansBold));
        }
        items.extend(self.ticks());
        items
    }

    /// Draws the ticks of the two axes, and above each column the exponent of its tolerance.
    fn ticks(&self) -> Vec<Item> {
        let theme = self.theme;
        let mut items: Vec<Item> = Vec::new();
        let mut tick = |x: f64, words: String, line: bool| {
            let at = PagePoint::new(x, FIRST_ROW_TOP - 10.0);
            let text = Text::new(at, words, Face::Sans, FONT_SIZES.1, theme.faint).anchored(Anchor::Middle);
            items.push(text.into());
            if line {
                let line = Outline::line([PagePoint::new(x, FIRST_ROW_TOP - 4.0), PagePoint::new(x, self.bottom)]);
                items.push(Path::stroked(line, Stroke::new(theme.rule, 1.0)).into());
            }
        };
        for time in [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0] {
            if (self.times.0..=self.times.1).contains(&time) {
                tick(self.time(time), format!("{time}"), true);
            }
        }
        for power in [-16, -8, 0] {
            tick(self.error(libm::pow(10.0, f64::from(power))), power_of_ten(power), true);
        }
        for (column, tolerance) in self.tolerances.iter().enumerate() {
            let power = libm::round(libm::log10(*tolerance)) as i32;
            let power = power.to_string().replace('-', "−");
            tick(self.column(column, WRONG_COLUMNS), power.clone(), false);
            tick(self.column(column, UNDECIDED_COLUMNS), power, false);
        }
        items
    }

    fn time(&self, time: f64) -> f64 {
        place(time, self.times, TIME_AXIS)
    }

    fn error(&self, error: f64) -> f64 {
        place(error.clamp(MIN_DRAWN_ERROR, 1.0), (MIN_DRAWN_ERROR, 1.0), ERROR_AXIS)
    }

    /// Returns the x coordinate, in pixels, of the column for one tolerance. `column` is the index of the tolerance,
    /// and `from` and `to` are the x coordinates of the first and the last column.
    fn column(&self, column: usize, (from, to): (f64, f64)) -> f64 {
        let last = self.tolerances.len().saturating_sub(1).max(1) as f64;
        from + (to - from) * column as f64 / last
    }

    /// Returns the index, in `tolerances`, of the tolerance of a summary line.
    fn place(&self, line: &Summary) -> usize {
        let found = self.tolerances.iter().position(|t| *t == line.tolerance);
        found.unwrap_or(0)
    }

    /// Draws the row of a method. `row` is the index of the row, from 0. `lines` has one summary for each tolerance.
    fn row(&self, row: usize, method: Method, lines: &[&Summary]) -> Vec<Item> {
        let theme = self.theme;
        let y = FIRST_ROW_TOP + ROW_HEIGHT * (row as f64 + 0.5);
        let mut items: Vec<Item> = Vec::new();
        let chosen = method == Method::Level(Accuracy::Standard);
        if row.is_multiple_of(2) {
            let band =
                PageRect { at: PagePoint::new(16.0, y - ROW_HEIGHT / 2.0), width: WIDTH - 32.0, height: ROW_HEIGHT };
            let band = Path::filled(Outline::rounded(band, 3.0), theme.block);
            items.push(band.with_opacity(0.55).into());
        }
        let face = if chosen { Face::SansBold } else { Face::Sans };
        let name = Text::new(PagePoint::new(24.0, y + 4.5), method.name(), face, FONT_SIZES.0, theme.ink);
        items.push(name.into());
        let mut dots: Vec<(f64, &Summary)> = Vec::new();
        dots.extend(lines.iter().map(|l| (self.time(l.time), *l)));
        dots.extend(lines.iter().filter_map(|l| Some((self.error(l.total_error?), *l))));
        for (x, line) in dots {
            let at = PagePoint::new(x, y);
            let ring = chosen && is_default(line.tolerance);
            if ring {
                let circle = Outline::circle(at, 8.5);
                items.push(Path::stroked(circle, Stroke::new(theme.ink, 1.6)).into());
            }
            let dot = Path::filled(Outline::circle(at, 4.6), self.shade(self.place(line), line.wrong > 0));
            items.push(dot.cased(theme.page, 0.8).into());
        }
        for line in lines {
            items.extend(self.counts(line, y));
            if chosen && is_default(line.tolerance) {
                let at = PagePoint::new(self.column(self.place(line), WRONG_COLUMNS), y);
                let circle = Outline::circle(at, 11.0);
                items.push(Path::stroked(circle, Stroke::new(theme.ink, 1.6)).into());
            }
        }
        items
    }

    /// Draws the numbers of wrong and of undecided verdicts of a summary line. `y` is the middle of its row, in
    /// pixels.
    fn counts(&self, line: &Summary, y: f64) -> [Item; 2] {
        let counts =
            [(line.wrong, WRONG_COLUMNS, self.theme.falls), (line.undecided, UNDECIDED_COLUMNS, self.theme.ink)];
        counts.map(|(count, block, full)| {
            let at = PagePoint::new(self.column(self.place(line), block), y + 5.0);
            let (face, colour) = match count {
                0 => (Face::Sans, self.theme.faint),
                _ => (Face::SansBold, full),
            };
            let words = Text::new(at, count.to_string(), face, FONT_SIZES.0, colour);
            words.anchored(Anchor::Middle).into()
        })
    }

    /// Returns the colour of a dot. It is darker for a tighter tolerance, and red if some verdict is wrong. `place`
    /// is the index of the tolerance, from 0 for the loosest.
    fn shade(&self, place: usize, wrong: bool) -> Colour {
        let last = self.tolerances.len().saturating_sub(1).max(1) as f64;
        let full = if wrong { self.theme.falls } else { self.theme.motion };
        self.theme.page.mixed(full, 0.3 + 0.7 * place as f64 / last)
    }
}

/// Returns the pixel position of a value on a logarithmic axis. The axis shows `least` at the position `from` and
/// `most` at `to`. Values outside are moved to the nearer end.
fn place(value: f64, (least, most): (f64, f64), (from, to): (f64, f64)) -> f64 {
    let share = libm::log10(value.max(least) / least) / libm::log10(most / least).max(1e-9);
    from + (to - from) * share.clamp(0.0, 1.0)
}

/// Formats a power of ten: `10⁻⁹`, `1`.
fn power_of_ten(power: i32) -> String {
    if power == 0 {
        return "1".into();
    }
    let raised = |c: char| match c {
        '-' => '⁻',
        digit => "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(digit.to_digit(10).unwrap_or(0) as usize).unwrap_or(digit),
    };
    format!("10{}", power.to_string().chars().map(raised).collect::<String>())
}
