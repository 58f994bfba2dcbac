//! [`gallery`]: the figures of the source in our hand, drawn from scenes that come with the program.

use super::caption::caption;
use super::freebody::freebody;
use super::option::{Corners, ForceStyle, Normalisation, Options};
use super::ring::ring;
use super::shapes::shapes;
use super::{Kind, draw};
use crate::analysis::Analysis;
use crate::drawing::{Drawing, Theme, beside};
use crate::scene::Scene;

/// Room between two scenes on one page, pixels.
const GAP: f64 = 20.0;

/// A figure of the gallery.
#[derive(Clone, Debug)]
pub struct Plate {
    /// What its files are called, such as `figure-4`.
    pub name: &'static str,
    /// What it shows, in plain words.
    pub caption: String,
    /// The figure.
    pub drawing: Drawing,
}

/// What a plate is made of.
enum Subject {
    /// A block of a scene cut free.
    Freebody(&'static str, &'static str),
    /// The ring of colours.
    Ring,
    /// The sheet of shapes.
    Shapes,
    /// The forces of scenes beside each other.
    Forces(&'static [&'static str]),
}

macro_rules! scene {
    ($name:literal) => {
        include_str!(concat!("../../assets/thesis/", $name, ".json"))
    };
}

/// Figures 1 to 9 of [Vallat23](crate::doc::references), by name.
const PLATES: [(&str, Subject); 13] = [
    ("figure-1", Subject::Freebody(scene!("figure-1"), "a")),
    ("figure-2", Subject::Freebody(scene!("figure-2"), "k")),
    ("figure-3a", Subject::Ring),
    ("figure-3b", Subject::Forces(&[scene!("figure-3b")])),
    ("figure-4", Subject::Forces(&[scene!("figure-4")])),
    ("figure-5", Subject::Forces(&[scene!("figure-5")])),
    (
        "figure-6-kernel-0",
        Subject::Forces(&[scene!("figure-6-kernel-0")]),
    ),
    (
        "figure-6-kernel-02",
        Subject::Forces(&[scene!("figure-6-kernel-02")]),
    ),
    (
        "figure-6-kernel-05",
        Subject::Forces(&[scene!("figure-6-kernel-05")]),
    ),
    ("figure-7", Subject::Shapes),
    (
        "figure-8",
        Subject::Forces(&[
            scene!("figure-8-left"),
            scene!("figure-8-right"),
            scene!("figure-8-right-corners"),
        ]),
    ),
    (
        "figure-9a",
        Subject::Forces(&[scene!("figure-9a"), scene!("figure-9a-corners")]),
    ),
    (
        "figure-9b",
        Subject::Forces(&[scene!("figure-9b"), scene!("figure-9b-torque")]),
    ),
];

/// Every figure of the source, each beside what it refuses with the effect switched on that it leaves out.
///
/// Arrows and their lengths are the source's: normal and friction force apart, the largest single unknown one edge long.
pub fn gallery(theme: &Theme) -> Vec<Plate> {
    PLATES
        .iter()
        .map(|(name, subject)| plate(name, subject, theme))
        .collect()
}

fn plate(name: &'static str, subject: &Subject, theme: &Theme) -> Plate {
    let options = Options {
        style: ForceStyle::Components,
        normalisation: Normalisation::Source,
        theme: theme.clone(),
        ..Options::default()
    };
    let (drawing, caption) = match subject {
        Subject::Ring => {
            let ring = ring(theme);
            let caption = ring.description.clone();
            (ring, caption)
        }
        Subject::Shapes => (
            shapes(theme),
            "The shapes that come with the triangular lattice, each with its cells and its lattice origin.".into(),
        ),
        Subject::Freebody(text, block) => {
            let scene = read(text);
            let id = scene.blocks.iter().position(|b| b.id == *block);
            let id = crate::scene::BlockId(id.expect("the block is in our own scene"));
            // The source's figures name every unknown.
            let options = Options {
                corners: Corners::All,
                ..options
            };
            let drawing = freebody(&Analysis::of(&scene), 0, id, &options);
            let drawing = drawing.expect("the block is placed in our own scene");
            let caption = format!("{}. Block {block} cut free.", scene.title);
            (drawing, caption)
        }
        Subject::Forces(texts) => {
            let scenes: Vec<Scene> = texts.iter().map(|text| read(text)).collect();
            let found: Vec<Analysis> = scenes.iter().map(Analysis::of).collect();
            let drawings = found.iter().map(|a| draw(a, Kind::Forces, &options));
            let captions: Vec<String> = found.iter().map(caption).collect();
            (beside(drawings.collect(), GAP), captions.join(" "))
        }
    };
    Plate {
        name,
        caption,
        drawing,
    }
}

fn read(text: &str) -> Scene {
    Scene::from_json(text).expect("our own scenes are sound, a test reads each")
}
