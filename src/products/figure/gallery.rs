//! [`gallery`]: reproduces the figures of the thesis from scenes that are part of this crate.

use super::block_arrows::BlockArrows;
use super::description::caption;
use super::option::{Corners, Fill, ForceStyle, Normalisation, Options};
use super::ring::ring;
use super::shapes::shapes;
use super::{Kind, draw, sheet};
use crate::mechanics::analysis::Analysis;
use crate::mechanics::scene::{BlockId, Scene};
use crate::pictures::drawing::{Drawing, Theme};

/// A figure of the gallery.
#[derive(Clone, Debug)]
pub struct Plate {
    /// The name of its files, such as `figure-4`.
    pub name: &'static str,
    /// A description in plain words.
    pub caption: String,
    /// The figure.
    pub drawing: Drawing,
}

/// The content of a plate.
enum Subject {
    /// The free-body diagram of a block of a scene: the scene and the name of the block.
    Freebody(&'static str, &'static str),
    /// The wheel of the colours of arrows.
    Ring,
    /// The overview of the predefined shapes of lattice cells.
    Shapes,
    /// The forces of a scene.
    Forces(&'static str),
    /// The forces of several scenes, in lettered panels.
    Plate { title: &'static str, columns: usize, scenes: &'static [&'static str], panels: &'static [Panel] },
}

/// A panel: the index of its scene, the index of the frame, and the caption.
type Panel = (usize, usize, &'static str);

macro_rules! scene {
    ($name:literal) => {
        include_str!(concat!("../../../assets/thesis/", $name, ".json"))
    };
}

/// Figures 1 to 9 of [Vallat23](crate::doc::references), by name.
const PLATES: [(&str, Subject); 10] = [
    ("figure-1", Subject::Freebody(scene!("figure-1"), "a")),
    ("figure-2", Subject::Freebody(scene!("figure-2"), "k")),
    ("figure-3a", Subject::Ring),
    ("figure-3b", Subject::Forces(scene!("figure-3b"))),
    ("figure-4", Subject::Forces(scene!("figure-4"))),
    ("figure-5", Subject::Forces(scene!("figure-5"))),
    (
        "figure-6",
        Subject::Plate {
            title: "Figure 6: three kernels",
            columns: 3,
            scenes: &[scene!("figure-6-kernel-0"), scene!("figure-6-kernel-02"), scene!("figure-6-kernel-05")],
            panels: &[
                (0, 0, "(a) An upright link, no kernel"),
                (1, 0, "(b) Kernel 0.2"),
                (2, 0, "(c) Kernel 0.5"),
                (0, 1, "(d) A leaning link, no kernel"),
                (1, 1, "(e) Kernel 0.2"),
                (2, 1, "(f) Kernel 0.5"),
            ],
        },
    ),
    ("figure-7", Subject::Shapes),
    (
        "figure-8",
        Subject::Plate {
            title: "Figure 8: bridges of four and of five blocks",
            columns: 3,
            scenes: &[scene!("figure-8-left"), scene!("figure-8-right"), scene!("figure-8-right-corners")],
            panels: &[
                (0, 0, "(a) Four blocks"),
                (1, 0, "(b) Five blocks"),
                (2, 0, "(b′) The same with corner contacts"),
            ],
        },
    ),
    (
        "figure-9",
        Subject::Plate {
            title: "Figure 9: held by corners, held by a torque",
            columns: 2,
            scenes: &[
                scene!("figure-9a"),
                scene!("figure-9a-corners"),
                scene!("figure-9b"),
                scene!("figure-9b-torque"),
            ],
            panels: &[
                (0, 0, "(a) Held by corners, which are left out"),
                (1, 0, "(a′) The same with corner contacts"),
                (2, 0, "(b) Held by a robot that gives no torque"),
                (3, 0, "(b′) The same with a torque"),
            ],
        },
    ),
];

/// Draws figures 1 to 9 of the thesis. Figures 8 and 9 have additional panels with effects that the thesis does not
/// consider.
///
/// Arrows are drawn as in the thesis: normal and friction forces have separate arrows, and the arrow of the largest
/// weight, load or single unknown force is one unit length long.
pub fn gallery(theme: &Theme) -> Vec<Plate> {
    PLATES.iter().map(|(name, subject)| plate(name, subject, theme)).collect()
}

fn plate(name: &'static str, subject: &Subject, theme: &Theme) -> Plate {
    let theme = &theme.for_scene(true);
    let options = Options {
        style: ForceStyle::Components,
        normalisation: Normalisation::Source,
        fill: Fill::Source,
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
            "The predefined shapes on the triangular lattice, each with its cells and its origin.".into(),
        ),
        Subject::Freebody(text, block) => {
            let scene = read(text);
            let id = scene.blocks.iter().position(|b| b.id == *block);
            let id = BlockId(id.expect("the built-in scene has this block"));
            // The figures of the thesis name every unknown.
            let options = Options { corners: Corners::All, block: Some(id), ..options };
            let drawing = draw(&Analysis::new(&scene), Kind::Freebody, &options);
            let caption = format!("{}. Block {block} cut free.", scene.title);
            (drawing, caption)
        }
        Subject::Forces(text) => {
            let scene = read(text);
            let analysis = Analysis::new(&scene);
            (draw(&analysis, Kind::Forces, &options), caption(&analysis))
        }
        Subject::Plate { title, columns, scenes, panels } => {
            let scenes: Vec<Scene> = scenes.iter().map(|text| read(text)).collect();
            let analyses: Vec<Analysis> = scenes.iter().map(Analysis::new).collect();
            let captions: Vec<String> = analyses.iter().map(caption).collect();
            let drawing = sheet::plate(&analyses, &BlockArrows, panels, title, *columns, &options);
            (drawing, captions.join(" "))
        }
    };
    Plate { name, caption, drawing }
}

fn read(text: &str) -> Scene {
    Scene::from_json(text).expect("the built-in scenes are valid, because a test reads each of them")
}
