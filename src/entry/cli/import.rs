//! `drystone import`: turns a drawing, a contact list or an assembly of COMPAS into a scene file.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use crate::entry::cli::destination;
use crate::entry::cli::error::{CliError, Ended};
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::page::Page;
use crate::entry::cli::source;
use crate::entry::cli::terminal::Terminal;
use crate::entry::value::{FrameChoice, TimeLimit, seconds};
use crate::mechanics::scene::format::SceneFile;
use crate::mechanics::scene::{Note, NoteCode, Scene};
use crate::pictures::output::attachment::is_picture;
use crate::products::result::import_json;
use crate::products::wording::number::quantity;
use crate::read::file::ending;
use crate::sources::import::{self, Format, Imported, Options, Remark, STONES, Stone};
use crate::text::{Word, shell, typed_word};

/// At most this many bodies whose corners were moved are listed; `--json` lists all.
const MAX_LISTED_BODIES: usize = 12;

/// Turn a drawing (SVG, DXF, GeoJSON, WKT), a contact list or a COMPAS assembly into a scene
///
/// Every closed outline becomes a block, named after its label or id. Layers and elements whose names begin with
/// "ground" become ground. If the names begin with "robot", they become robots, which hold the block that contains
/// their centre. Elements whose names begin with "ignore" or "guide" are left out. Edges that nearly touch are moved
/// so that they touch. Elements that cannot be imported are reported.
///
/// A contact list (.csv, .json) has the centres and masses of bodies, and the points at which they touch. From a
/// COMPAS assembly (.json), the cross-section of its prismatic blocks is imported. A PNG or PDF of drystone render gives
/// back its scene file.
#[derive(Debug, Args)]
#[command(allow_negative_numbers = true)]
pub(crate) struct Import {
    /// The drawing: .svg, .dxf, .geojson, .geojsonl, .json, .wkt, .csv or a figure as .png or .pdf; - reads standard input.
    /// Bodies and contacts in two .csv files are read together
    #[arg(value_name = "DRAWING", required = true)]
    drawings: Vec<PathBuf>,
    /// The scene file to write; - or nothing prints the scene
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Format of the drawing, if its file name does not show it
    #[arg(long, value_parser = typed_word::<Format>(), value_name = "FORMAT")]
    format: Option<Format>,
    /// Replace the scene file if it exists
    #[arg(long, requires = "output")]
    force: bool,
    /// Scale of the drawing as 1:50, or metres per unit of the drawing [default: 1:1]
    #[arg(long, value_name = "1:N", value_parser = scale)]
    scale: Option<ScaleArg>,
    /// Unit of the drawing's coordinates [default: the unit that the drawing states, else m]
    #[arg(long, value_name = "UNIT", value_enum)]
    unit: Option<Unit>,
    /// Pixels per inch of a drawing in pixels; it implies --unit px [default: 96]
    #[arg(long, value_name = "N", value_parser = dpi)]
    dpi: Option<f64>,
    /// What is ground: a layer or element by its name, a body by its number or by a point X,Y in it, or below:Y for all
    /// bodies below a height, in the unit of the drawing with y up; may be given several times [default: names that
    /// begin with ground]
    #[arg(long, alias = "ground-layer", value_name = "LAYER|N|X,Y|below:Y", allow_hyphen_values = true)]
    ground: Vec<String>,
    /// What is left out, such as a title block, given like --ground [default: names that begin with ignore or guide]
    #[arg(long, value_name = "LAYER|N|X,Y|below:Y", allow_hyphen_values = true)]
    ignore: Vec<String>,
    /// Turn the drawing upside down, because its y axis points down, as in pictures
    #[arg(long)]
    flip_y: bool,
    /// Largest distance of a chord from its curve, in metres [default: a thousandth of the drawing's size]
    #[arg(long, value_name = "M")]
    flatten: Option<f64>,
    /// Edges within this distance, in metres, are moved so that they touch; 0 turns this off [default: a thousandth
    /// of the drawing's size, at most a quarter of the thickness of the thinnest body]
    #[arg(long, value_name = "M")]
    gap: Option<f64>,
    /// Frame of a figure that drystone drew, by number from 1 or by its letter [default: the last]
    #[arg(long, value_name = "N")]
    frame: Option<FrameChoice>,
    /// Title of the scene [default: the title of the drawing]
    #[arg(long, value_name = "TEXT")]
    title: Option<String>,
    /// Friction coefficient of all blocks and ground that have none
    #[arg(long, value_name = "MU")]
    friction: Option<f64>,
    /// Density and friction of all blocks and ground that have none, from a table: basalt, concrete, gneiss, granite,
    /// limestone or sandstone; --density and --friction replace its values
    #[arg(long, value_name = "NAME", value_parser = stone)]
    material: Option<Stone>,
    /// Density in kg/m³ of all blocks that have none
    #[arg(long, value_name = "KG/M3")]
    density: Option<f64>,
    /// Thickness of all blocks perpendicular to the plane, in metres
    #[arg(long, value_name = "M")]
    thickness: Option<f64>,
    /// Safety kernel, 0 to 1
    #[arg(long, value_name = "SHARE")]
    kernel: Option<f64>,
    /// Gravity in m/s²: downwards, or as X,Y
    #[arg(long, value_name = "G", value_parser = gravity)]
    gravity: Option<[f64; 2]>,
    /// Write nothing and exit with 2 if any element could not be imported as drawn
    #[arg(long)]
    strict: bool,
    /// Take the scene file that a figure of drystone carries, byte for byte, instead of the shapes of the SVG; a PNG or
    /// PDF needs no option
    #[arg(long)]
    source: bool,
    /// Stop after this many seconds, and write nothing
    #[arg(long, value_name = "SECONDS", env = "DRYSTONE_TIME_LIMIT", hide_env_values = true,
        value_parser = |typed: &str| seconds(typed).map(TimeLimit::started))]
    time_limit: Option<TimeLimit>,
    /// Print the log of the import as JSON; the scene then needs a file (-o)
    #[arg(long, requires = "output")]
    json: bool,
    /// The words of the command line, for remedies.
    #[arg(skip)]
    pub(crate) words: Vec<String>,
}

impl Import {
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        let file = destination::file(self.output.as_ref());
        self.check_options(file)?;

        let name = self.drawings.iter().map(|path| source::name(path)).collect::<Vec<String>>().join(" and ");
        let (format, bytes) = (self.format(), source::bytes(self.drawing()));
        if let Ok(bytes) = &bytes
            && (self.source || is_picture(bytes))
        {
            return Ok(self.bring_back(terminal, file, bytes)?);
        }
        let format = format?;
        let imported = if let [_] = self.drawings.as_slice() {
            // The content of a .json file, and of a file with another ending, decides on its format.
            let text = text(bytes?, &name, format)?;
            let format = match (self.format, format) {
                (None, Some(Format::GeoJson)) => Format::of_json(&text),
                (_, Some(format)) => format,
                (_, None) => Format::of_text(&text).ok_or_else(|| self.unknown_format())?,
            };
            import::import(&text, format, &self.options())
        } else {
            let read =
                |path: &PathBuf| Ok((source::name(path), text(source::bytes(path)?, &source::name(path), None)?));
            let files = self.drawings.iter().map(read).collect::<Result<Vec<(String, String)>, CliError>>()?;
            let files: Vec<(&str, &str)> = files.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
            import::import_files(&files, &self.options())
        };
        let imported = match imported {
            Ok(imported) => imported,
            Err(refusal) => {
                for remark in &refusal.remarks {
                    terminal.notes(&remark_page("warning", &name, remark));
                }
                let mut page = Page::default();
                refusal.notes.iter().for_each(|note| page.line(&format!("  {note}")));
                terminal.notes(&page);
                let mut problems = refusal.problems;
                if let Some(scene) = refusal.overlapping.filter(|_| !self.strict) {
                    self.deliver(terminal, file, scene.to_json().into_bytes())?;
                    if let (Some(path), Some(last)) = (file, problems.last_mut()) {
                        let path = path.display();
                        last.help += &format!("; drystone render --broken {path} -o overlaps.svg shows what overlaps");
                        if !self.force {
                            last.help += &format!("; another import replaces it: {} --force", self.command());
                        }
                    }
                }
                return Err(refused(&name, &problems));
            }
        };
        if self.strict && !imported.remarks.is_empty() {
            return Err(refused(&name, &imported.remarks));
        }
        self.deliver(terminal, file, imported.scene.to_json().into_bytes())?;
        self.print_summary(terminal, &name, &imported);
        if self.json {
            let json = import_json(&imported);
            terminal.print_bytes(json.as_bytes())?;
        }
        Ok(ExitStatus::Done)
    }

    /// Writes the scene file that a picture carries.
    fn bring_back(&self, terminal: &Terminal, file: Option<&Path>, picture: &[u8]) -> Result<ExitStatus, CliError> {
        if self.json || self.format.is_some() || self.options() != Options::default() {
            let why = "the scene file in a picture stays as it is; give no option but -o and --force";
            return Err(CliError::from(why));
        }
        destination::deliver(terminal, file, source::carried(self.drawing(), picture)?, self.force)?;
        Ok(ExitStatus::Done)
    }

    /// Returns an error if the options contradict each other, or if the scene file is a folder or the drawing itself.
    fn check_options(&self, file: Option<&Path>) -> Result<(), CliError> {
        if self.json && file.is_none() {
            let why = "--json and the scene cannot both go to standard output; give the scene a file with -o";
            return Err(CliError::from(why));
        }
        if let Some(file) = file.filter(|f| f.is_dir()) {
            return Err(format!("{} is a folder; name the scene file in it", file.display()).into());
        }
        if let Some(file) = file {
            destination::refuse_overwrites(
                &[file.to_owned()],
                &self.drawings.iter().map(PathBuf::as_path).collect::<Vec<_>>(),
            )?;
        }
        if self.dpi.is_some() && self.unit.is_some_and(|unit| unit != Unit::Px) {
            return Err("--dpi sets the size of a pixel, and the unit is another one; leave out --dpi or --unit".into());
        }
        if let (Some(ScaleArg::Metres(metres)), Some(_)) = (self.scale, self.unit()) {
            return Err(format!(
                "--scale {metres} is already in metres per unit, so --unit has no effect; leave one of them out, or give the scale as 1:50"
            ).into());
        }
        Ok(())
    }

    fn drawing(&self) -> &Path {
        self.drawings.first().map_or(Path::new(""), PathBuf::as_path)
    }

    /// Writes the scene. If the file exists, the error names the command that replaces it.
    fn deliver(&self, terminal: &Terminal, file: Option<&Path>, bytes: Vec<u8>) -> Result<(), CliError> {
        let exists = !self.force && file.is_some_and(Path::exists);
        destination::deliver(terminal, file, bytes, self.force).map_err(|error| match error {
            CliError::NotWritten { what, why } if exists => {
                CliError::NotWritten { what, why: format!("{why}: {} --force", self.command()) }
            }
            error => error,
        })
    }

    /// Returns the command as it was typed.
    fn command(&self) -> String {
        let quoted = |word: &String| {
            let (dashes, rest) = word.split_at(word.len() - word.trim_start_matches('-').len());
            if rest.is_empty() { word.clone() } else { format!("{dashes}{}", shell(rest)) }
        };
        self.words.iter().map(quoted).collect::<Vec<_>>().join(" ")
    }

    fn unit(&self) -> Option<Unit> {
        self.unit.or(self.dpi.map(|_| Unit::Px))
    }

    /// Returns the format that an option or the ending of the name gives; `None` if the content decides.
    fn format(&self) -> Result<Option<Format>, CliError> {
        if self.format.is_some() {
            return Ok(self.format);
        }
        match ending(self.drawing()).as_str() {
            "svg" => Ok(Some(Format::Svg)),
            "dxf" => Ok(Some(Format::Dxf)),
            "geojson" | "geojsonl" | "geojsons" | "jsonl" | "ndjson" | "json" => Ok(Some(Format::GeoJson)),
            "wkt" => Ok(Some(Format::Wkt)),
            "csv" => Ok(Some(Format::Contacts)),
            "svgz" => Err(format!(
                "{} is compressed; unpack it first: gunzip -c drawing.svgz > drawing.svg",
                self.drawing().display()
            )
            .into()),
            "dwg" => Err(format!(
                "{} is a DWG file, which only CAD programs read; save it there as DXF",
                self.drawing().display()
            )
            .into()),
            _ => Ok(None),
        }
    }

    fn unknown_format(&self) -> CliError {
        let formats = crate::text::choice(Format::all().into_iter().map(|format| format.word().to_owned()));
        let shown = self.drawing().display();
        format!("neither the name {shown} nor its content shows the format of the drawing; give --format {formats}")
            .into()
    }

    fn options(&self) -> Options {
        Options {
            scale: match (self.scale, self.unit) {
                (Some(ScaleArg::Metres(metres)), _) => Some(metres),
                _ => self.unit().map(|unit| unit.metres(self.dpi.unwrap_or(96.0))),
            },
            ratio: match self.scale {
                Some(ScaleArg::Ratio(ratio)) => Some(ratio),
                _ => None,
            },
            ground: self.ground.clone(),
            ignore: self.ignore.clone(),
            flip_y: self.flip_y,
            flatten: self.flatten,
            gap: self.gap,
            frame: self.frame.and_then(FrameChoice::number),
            scene: SceneFile {
                title: self.title.clone(),
                friction: self.friction.or(self.material.map(|m| m.friction)),
                density: self.density.or(self.material.map(|m| m.density)),
                thickness: self.thickness,
                kernel: self.kernel,
                gravity: self.gravity,
                ..SceneFile::default()
            },
        }
    }

    /// Prints a summary of the import to standard error: the warnings, the numbers of imported blocks, parts of the
    /// ground and robots, the material of `--material`, the notes, and the bodies whose corners were moved.
    fn print_summary(&self, terminal: &Terminal, name: &str, imported: &Imported) {
        for remark in &imported.remarks {
            terminal.notes(&remark_page("warning", name, remark));
        }
        let count = |n: usize, one: &str, many: &str| match n {
            1 => format!("1 {one}"),
            n => format!("{n} {many}"),
        };
        let scene = &imported.scene;
        let mut page = Page::new(&format!(
            "{name}: {}, {}, {}",
            count(scene.blocks.len(), "block", "blocks"),
            count(scene.ground.len(), "part of the ground", "parts of the ground"),
            count(scene.robots.len(), "robot", "robots"),
        ));
        if let Some(stone) = self.material {
            page.line(&format!(
                "  {}: {} kg/m³, friction coefficient {}; from {}",
                stone.name, stone.density, stone.friction, stone.source
            ));
        }
        for note in imported.notes.iter().chain(&scene_notes(imported)) {
            page.line(&format!("  {note}"));
        }
        for snapped in imported.snapped.iter().take(MAX_LISTED_BODIES) {
            page.line(&format!(
                "  snapped {1} of {0} by up to {2}, to {3}",
                snapped.body,
                count(snapped.corners, "corner", "corners"),
                quantity(snapped.distance, "m"),
                snapped.to.join(", ")
            ));
        }
        if imported.snapped.len() > MAX_LISTED_BODIES {
            let more = imported.snapped.len() - MAX_LISTED_BODIES;
            let most = imported.snapped.iter().map(|s| s.distance).fold(0.0, f64::max);
            let most = quantity(most, "m");
            page.line(&format!("  snapped {more} more; the largest move of all is {most}; --json lists them"));
        }
        if !imported.left_out.is_empty() {
            let what = imported.left_out.iter().map(|(what, n)| count(*n, what, &plural(what)));
            let what = what.collect::<Vec<_>>().join(", ");
            page.line(&format!("{}; left out: {what}", count(scene.blocks.len(), "block", "blocks")));
        }
        terminal.notes(&page);
    }
}

/// Returns the plural of a noun for what is left out.
fn plural(noun: &str) -> String {
    match noun.strip_suffix('y') {
        Some(stem) => format!("{stem}ies"),
        None if noun.ends_with("ch") => format!("{noun}es"),
        None => format!("{noun}s"),
    }
}

fn text(bytes: Vec<u8>, name: &str, format: Option<Format>) -> Result<String, CliError> {
    // Old DXF files have one byte per character. Only names in them can contain non-ASCII characters. So these files are
    // read as Latin-1, even if some letters of names are then wrong.
    if format == Some(Format::Dxf) && std::str::from_utf8(&bytes).is_err() {
        return Ok(bytes.into_iter().map(char::from).collect());
    }
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        CliError::not_read(name, format!("it is not valid UTF-8 from byte {at} on; save it as UTF-8"))
    })
}

fn refused(name: &str, problems: &[Remark]) -> Vec<CliError> {
    let complaint = |remark: &Remark| CliError::Drawing(remark_page("error", name, remark));
    problems.iter().map(complaint).collect()
}

fn remark_page(severity: &str, name: &str, remark: &Remark) -> Page {
    let mut page = Page::default();
    page.words(&format!("{severity}: {name}: "));
    if !remark.element.is_empty() {
        page.words(&format!("{}: ", remark.element));
    }
    page.line(&remark.message);
    if !remark.help.is_empty() {
        page.line(&format!("  help: {}", remark.help));
    }
    page
}

/// Returns the notes on the scene that concern the import: on weights, sizes and heights.
fn scene_notes(imported: &Imported) -> Vec<String> {
    let Ok(scene) = Scene::new(imported.scene.clone()) else { return Vec::new() };
    let line = |note: &Note| {
        let remedy = match note.code {
            NoteCode::DefaultDensity => "give --density in kg/m³ or --material limestone",
            NoteCode::NoWeight => "give --density, and a --gravity that is not 0",
            NoteCode::ImplausibleSize => "give the unit of the drawing with --unit, or its scale with --scale",
            NoteCode::BelowGround => "if y points down in the drawing, as in pictures, give --flip-y",
            _ => return None,
        };
        Some(format!("{}; {remedy}", note.message))
    };
    scene.notes().iter().filter_map(line).collect()
}

impl Word for Format {
    fn all() -> Vec<Format> {
        vec![Format::Svg, Format::Dxf, Format::GeoJson, Format::Wkt, Format::Contacts, Format::Boxes, Format::Compas]
    }

    fn word(self) -> &'static str {
        match self {
            Format::Svg => "svg",
            Format::Dxf => "dxf",
            Format::GeoJson => "geojson",
            Format::Wkt => "wkt",
            Format::Contacts => "contacts",
            Format::Boxes => "boxes",
            Format::Compas => "compas",
        }
    }
}

/// A unit of length in drawings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Unit {
    Mm,
    Cm,
    M,
    In,
    Ft,
    Pt,
    Px,
}

impl Unit {
    /// Returns the length of the unit in metres. `dpi` is the number of pixels in an inch.
    fn metres(self, dpi: f64) -> f64 {
        match self {
            Unit::Mm => 1e-3,
            Unit::Cm => 1e-2,
            Unit::M => 1.0,
            Unit::In => 0.0254,
            Unit::Ft => 0.3048,
            Unit::Pt => 0.0254 / 72.0,
            Unit::Px => 0.0254 / dpi,
        }
    }
}

/// The value of `--scale`.
#[derive(Clone, Copy, Debug, PartialEq)]
enum ScaleArg {
    /// Real lengths divided by drawn lengths.
    Ratio(f64),
    /// Metres per unit of the drawing.
    Metres(f64),
}

/// Parses the name of a material.
fn stone(typed: &str) -> Result<Stone, String> {
    Stone::from_name(typed).ok_or_else(|| {
        let names = STONES.map(|stone| stone.name);
        format!("the known materials are {}; for others give --density and --friction", names.join(", "))
    })
}

/// Parses a scale: `1:50` is a ratio, and `0.02` is the number of metres per unit of the drawing.
fn scale(typed: &str) -> Result<ScaleArg, String> {
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

/// Parses a number of pixels per inch.
fn dpi(typed: &str) -> Result<f64, String> {
    let number = typed.trim().parse::<f64>().ok().filter(|n| n.is_finite() && *n > 0.0);
    number.ok_or_else(|| "give the number of pixels in an inch, such as 96 or 300".to_owned())
}

/// Parses gravity in m/s²: `9.81` acts downwards, and `0,-9.81` gives both components.
fn gravity(typed: &str) -> Result<[f64; 2], String> {
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
