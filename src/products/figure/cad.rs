//! [`dxf`]: writes a frame as a DXF drawing in metres, for CAD programs.
//!
//! The file has the version R12 (AC1009), which nearly all CAD programs read. It contains closed polylines, circles, lines,
//! points and text. Holes, names, the line of thrust and the mechanism lie on layers whose names begin with `guide`.
//! `drystone import` ignores these layers, so that the drawing can be edited and imported again.

use std::fmt::Write as _;

use super::displacement::Course;
use super::fall::Fall;
use super::{design, funicular};
use crate::geometry::Point;
use crate::mechanics::analysis::{Analysis, SolvedFrame, Verdict};
use crate::mechanics::scene::{Body, Frame, Scene};

/// The layers with their AutoCAD colour numbers.
const LAYERS: [(&str, i32); 7] = [
    (GROUND_LAYER, 8),
    (BLOCK_LAYER, 7),
    (HOLE_LAYER, 9),
    (ROBOT_LAYER, 2),
    (NAME_LAYER, 8),
    (THRUST_LAYER, 5),
    (MECHANISM_LAYER, 1),
];
const GROUND_LAYER: &str = "ground";
const BLOCK_LAYER: &str = "blocks";
/// The layer for holes. Version R12 has no outlines with holes.
const HOLE_LAYER: &str = "guide holes";
const ROBOT_LAYER: &str = "robots";
const NAME_LAYER: &str = "guide names";
const THRUST_LAYER: &str = "guide thrust line";
const MECHANISM_LAYER: &str = "guide mechanism";
/// The height of letters, as a fraction of the unit length of the scene (a typical size of its blocks).
const LETTER_SHARE: f64 = 0.15;

/// Writes a frame as DXF. The drawing shows the ground, the blocks with their names, and the grip points of robots. If
/// the frame stands, the drawing also shows the line of thrust; if the frame falls, the displaced blocks. Coordinates
/// are in metres with y up.
///
/// `frame` is the index of the frame, from 0. The result is empty if the frame does not exist.
///
/// # Example
/// ```
/// use drystone::{Analysis, Scene, figure};
/// let scene = Scene::from_json(drystone::scene::starter())?;
/// let text = figure::dxf(&Analysis::new(&scene), 0);
/// assert!(text.contains("AC1009") && text.trim_end().ends_with("EOF"));
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
pub fn dxf(analysis: &Analysis, frame: usize) -> String {
    let Some(solved @ SolvedFrame { scene, found, .. }) = analysis.each().nth(frame) else { return String::new() };
    let placed = solved.frame();
    let unit = design::unit(scene, None);
    let mut file = DxfWriter::default();
    file.head();
    for ground in &scene.ground {
        file.outline(GROUND_LAYER, &ground.body);
    }
    file.blocks(scene, placed, LETTER_SHARE * unit);
    for hold in &placed.holds {
        file.entity("POINT", ROBOT_LAYER);
        file.point(10, hold.at);
    }
    if found.verdict == Verdict::Stable {
        for segment in funicular::segments(solved) {
            file.entity("LINE", THRUST_LAYER);
            file.point(10, segment.from);
            file.point(11, segment.to);
        }
    }
    let displaced = Course::new(&Fall::of(analysis, frame), unit).at(1.0);
    for (block, displacement) in scene.blocks.iter().zip(&displaced) {
        if let Some(displacement) = displacement {
            let outline = block.body.polygon.outline().iter();
            let corners: Vec<Point> = outline.map(|p| displacement.moved(*p)).collect();
            file.polyline(MECHANISM_LAYER, &corners);
        }
    }
    file.group(0, "ENDSEC");
    file.group(0, "EOF");
    file.text
}

#[derive(Default)]
struct DxfWriter {
    text: String,
}

impl DxfWriter {
    fn group(&mut self, code: i32, value: &str) {
        // Writing to a `String` cannot fail.
        let _ = writeln!(self.text, "{code:3}\n{value}");
    }

    fn number(&mut self, code: i32, value: f64) {
        self.group(code, &format!("{value:?}"));
    }

    fn point(&mut self, code: i32, at: Point) {
        self.number(code, at.x);
        self.number(code + 10, at.y);
    }

    fn entity(&mut self, kind: &str, layer: &str) {
        self.group(0, kind);
        self.group(8, layer);
    }

    /// Writes the beginning of the file: the header with the version and the unit (metres), the layers, and the start
    /// of the section of entities.
    fn head(&mut self) {
        let header = [
            (0, "SECTION"),
            (2, "HEADER"),
            (9, "$ACADVER"),
            (1, "AC1009"),
            (9, "$INSUNITS"),
            (70, "6"),
            (0, "ENDSEC"),
            (0, "SECTION"),
            (2, "TABLES"),
            (0, "TABLE"),
            (2, "LAYER"),
        ];
        for (code, value) in header {
            self.group(code, value);
        }
        self.group(70, &LAYERS.len().to_string());
        for (name, colour) in LAYERS {
            self.group(0, "LAYER");
            self.group(2, name);
            self.group(70, "0");
            self.group(62, &colour.to_string());
            self.group(6, "CONTINUOUS");
        }
        for (code, value) in [(0, "ENDTAB"), (0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")] {
            self.group(code, value);
        }
    }

    fn blocks(&mut self, scene: &Scene, frame: &Frame, letters: f64) {
        for id in &frame.placed {
            let block = &scene.blocks[id.0];
            self.outline(BLOCK_LAYER, &block.body);
            self.entity("TEXT", NAME_LAYER);
            self.point(10, block.body.centroid());
            self.number(40, letters);
            self.group(1, &ascii(&block.id));
        }
    }

    fn outline(&mut self, layer: &str, body: &Body) {
        if let Some(circle) = body.circle {
            self.entity("CIRCLE", layer);
            self.point(10, circle.centre);
            self.number(40, circle.radius);
            return;
        }
        self.polyline(layer, body.polygon.outline());
        for hole in body.polygon.holes() {
            self.polyline(HOLE_LAYER, hole);
        }
    }

    /// Writes a closed polyline.
    fn polyline(&mut self, layer: &str, corners: &[Point]) {
        self.entity("POLYLINE", layer);
        self.group(66, "1");
        self.group(70, "1");
        for corner in corners {
            self.entity("VERTEX", layer);
            self.point(10, *corner);
        }
        self.entity("SEQEND", layer);
    }
}

/// Returns the text as one line of ASCII, because a line break would end the value. Characters outside ASCII are
/// written as `\U+XXXX`, and CAD programs then show the characters.
fn ascii(text: &str) -> String {
    let mut line = String::new();
    for c in crate::text::line(text).chars() {
        match c {
            ' '..='~' => line.push(c),
            c => {
                let mut units = [0; 2];
                for unit in c.encode_utf16(&mut units) {
                    let _ = write!(line, "\\U+{unit:04X}");
                }
            }
        }
    }
    line
}
