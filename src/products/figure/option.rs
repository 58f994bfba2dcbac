//! [`Options`]: the options of a figure, such as its colours, its scale of arrows and its size, and the block that an
//! option names.

use crate::mechanics::analysis::MarginKind;
use crate::mechanics::scene::{BlockId, Scene};
use crate::pictures::drawing::{Colour, Theme};
use crate::text::{self, Word, nearest};

words! {
    /// Whether the force of an interface is drawn as one arrow or as components.
    #[non_exhaustive]
    pub enum ForceStyle {
        /// The sum of normal and friction force as one arrow on each of the two bodies.
        #[default]
        Resultant = "resultant";
        /// Normal and friction force as two arrows, as in the figures of the thesis.
        Components = "components";
    }
}

words! {
    /// The force whose arrow is one unit length long. The unit length is the side of a lattice cell, or a typical size
    /// of a block.
    #[non_exhaustive]
    pub enum Normalisation {
        /// The largest force that is drawn.
        #[default]
        Drawn = "drawn";
        /// The largest weight, load or single unknown of the analysis (normal force of a corner, friction force of an
        /// interface, force component of a robot). Arrows of sums can then be longer than one unit length. Each block
        /// has a separate scale for its missing forces. The figures of the thesis use this scale.
        Source = "source";
    }
}

words! {
    /// Whether each panel has its own scale of arrows or all panels share one scale.
    #[non_exhaustive]
    pub enum ArrowScale {
        /// Each panel has its own scale.
        #[default]
        Panel = "panel";
        /// All panels have the same scale, so that lengths can be compared.
        Strip = "strip";
    }
}

words! {
    /// The quantity that the colours of blocks show.
    #[non_exhaustive]
    pub enum Fill {
        /// The amplitude: the larger of a block's weight and the largest normal force on its interfaces. The scale ends
        /// at the largest amplitude in the figure.
        #[default]
        Amplitude = "amplitude", "The larger of a block's weight and its largest normal force, N";
        /// A value of the last version: [`Kind::Joints`](super::Kind::Joints) shows more. Blocks have one plain colour.
        Stress = "stress", "Now --kind joints";
        /// A value of the last version: [`Kind::Joints`](super::Kind::Joints) shows more. Blocks have one plain colour.
        Friction = "friction", "Now --kind joints";
        /// No quantity: blocks have one plain colour.
        None = "none", "Nothing: plain blocks";
        /// The rule of the thesis, in its colours. A block that a robot holds shows the used fraction of the limits of
        /// this robot. Any other block shows its amplitude as a fraction of the smallest force limit of all robots. If
        /// no robot has a force limit, every block shows its amplitude as a fraction of the largest amplitude.
        Source = "source", "Fractions of the robots' limits, computed and coloured as in Vallat (2023)";
    }
}

/// The motion that a figure of a mechanism shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum At {
    /// How the structure falls just beyond a margin.
    Margin(MarginKind),
    /// How it cracks as a support moves. The option `movement` selects one of several movements.
    Movement,
    /// How it falls if its blocks are off their places.
    Placement,
    /// How it falls under the vehicle of the scene, and the load factor for each position of the vehicle.
    Vehicle,
}

impl At {
    /// Returns the margin beyond which the structure falls; `None` for another motion.
    pub fn margin(self) -> Option<MarginKind> {
        match self {
            At::Margin(kind) => Some(kind),
            _ => None,
        }
    }
}

impl Word for At {
    fn all() -> Vec<At> {
        use MarginKind::{Friction, FrictionFactor, HorizontalLoad, LoadFactor, Overturning, Sliding, Tilt};
        let margins = [Tilt, LoadFactor, HorizontalLoad, Friction, FrictionFactor, Sliding, Overturning];
        let margins = margins.map(At::Margin).into_iter();
        margins.chain([At::Movement, At::Placement, At::Vehicle]).collect()
    }

    fn word(self) -> &'static str {
        match self {
            At::Margin(kind) => Word::word(kind),
            At::Movement => "movement",
            At::Placement => "placement",
            At::Vehicle => "vehicle",
        }
    }

    fn alias(self) -> Option<&'static str> {
        self.margin().and_then(Word::alias)
    }
}

/// Which forces of interfaces a free-body diagram shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Corners {
    /// For a block with at most three interfaces, the forces at both ends of each interface. For a block with more
    /// interfaces, one force for each interface. Forces that are zero are left out.
    #[default]
    Few,
    /// Every unknown force at every end of an interface with its name, even if it is zero. The lengths of arrows then
    /// show no magnitudes.
    All,
}

impl From<bool> for Corners {
    fn from(all: bool) -> Corners {
        if all { Corners::All } else { Corners::Few }
    }
}

request! {
    /// The options of a figure.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Options(given) {
        /// Whether the force of an interface is drawn as one arrow or as components.
        pub style: ForceStyle = given.word("arrows").unwrap_or_default(),
            arg(id = "arrows", long = "arrows", value_name = "ARROWS", default_value = "resultant",
                value_parser = crate::text::typed_word::<ForceStyle>(),
                help = "One resultant arrow for each interface and block, or separate arrows for normal and friction \
                        force");
        /// Which force has an arrow that is one unit length long.
        pub normalisation: Normalisation = given.word("normalise").unwrap_or_default(),
            arg(id = "normalise", long = "normalise", value_name = "NORMALISE", default_value = "drawn",
                value_parser = crate::text::typed_word::<Normalisation>(),
                help = "The force whose arrow has unit length: the largest drawn force, or the largest single unknown, \
                        as in Vallat (2023)");
        /// Whether each panel has its own scale of arrows or all panels share one scale.
        pub scale: ArrowScale = given.word("arrow_scale").unwrap_or_default(),
            arg(id = "arrow_scale", long = "arrow-scale", value_name = "ARROW_SCALE", default_value = "panel",
                value_parser = crate::text::typed_word::<ArrowScale>(),
                help = "One scale of arrows for each panel, or for the whole strip");
        /// Which forces of interfaces a free-body diagram shows.
        pub corners: Corners = given.flag("corners").into(),
            arg(long, action = clap::ArgAction::SetTrue,
                value_parser = clap::builder::TypedValueParser::map(clap::builder::BoolValueParser::new(), Corners::from),
                help = "In a free-body diagram, name all forces that may act at the ends of its interfaces, even those \
                        that are zero");
        /// Whether all arrows have labels with their magnitudes, in frames with at most 60 blocks. If a frame has more
        /// than 200 magnitudes, only the largest are written.
        pub amounts: bool = given.flag("amounts"),
            arg(long, help = "Write the magnitude of the force next to every arrow");
        /// The quantity that the colours of blocks show.
        pub fill: Fill = given.word("fill").unwrap_or_default(),
            arg(long, default_value = "amplitude", value_parser = crate::text::typed_word::<Fill>());
        /// Whether the title of the figure is drawn.
        pub titles: bool = !given.flag("no_title"),
            arg(long = "no-title", action = clap::ArgAction::SetFalse, help = "Leave out the figure's title");
        /// Whether the captions of frames are drawn.
        pub captions: bool = !given.flag("no_caption"),
            arg(long = "no-caption", action = clap::ArgAction::SetFalse, help = "Leave out the frames' captions");
        /// Whether verdicts and the texts below them are drawn.
        pub verdicts: bool = !given.flag("no_verdict"),
            arg(long = "no-verdict", action = clap::ArgAction::SetFalse,
                help = "Leave out the verdicts and the text below them");
        /// Whether the scale of arrows and the legend are drawn; in a figure of a free body also the notes and the list
        /// of forces.
        pub keys: bool = !given.flag("no_key"),
            arg(long = "no-key", action = clap::ArgAction::SetFalse, help = "Leave out the key and the scale of arrows");
        /// Whether blocks and robots have labels with their names, and loads, missing forces and the largest forces
        /// have labels with their magnitudes. In frames with more than 60 blocks, most blocks have no names.
        pub labels: bool = !given.flag("no_labels"),
            arg(skip = true);
        /// Whether blocks have labels with their names. Only with `labels`.
        pub names: bool = !given.flag("no_names"),
            arg(long = "no-names", action = clap::ArgAction::SetFalse, help = "Leave out the names of blocks");
        /// Whether loads, missing forces, robots and the largest force have labels with their magnitudes. Only with
        /// `labels`.
        pub main_amounts: bool = !given.flag("no_amounts"),
            arg(long = "no-amounts", action = clap::ArgAction::SetFalse,
                help = "Leave out the magnitudes of loads, missing forces, robots and the largest force");
        /// Whether the line of the verdict gives the most important margin, if the analysis has computed it.
        pub verdict_margin: bool = !given.flag("no_margin"),
            arg(long = "no-margin", action = clap::ArgAction::SetFalse,
                help = "Leave out the margin from the line of the verdict");
        /// Whether a scale bar in metres is drawn.
        pub scale_bar: bool = given.flag("scale_bar"),
            arg(long, help = "Show a scale bar with a round number of metres");
        /// Whether dimension lines show the width and height of all blocks of a frame.
        pub dimensions: bool = given.flag("dimensions"),
            arg(long, help = "Draw dimension lines at the edges of each panel: width and height of all blocks, or of \
                              the block of --zoom");
        /// Whether [`Kind::Thrust`](super::Kind::Thrust) also shows the force polygon next to the structure: the load line
        /// and the reactions, in an arch also the pole and a ray for each joint.
        pub with_polygon: bool = given.flag("with_polygon"),
            arg(long, help = "Draw the force polygon next to the line of thrust of --kind thrust: loads and reactions, in \
                              an arch also the pole and a ray for each joint");
        /// The number of panels in a row; `None` to choose it by the shape of the panels.
        pub columns: Option<usize> = given.whole("columns", [1, 65535]).map(|columns| columns as usize),
            arg(long, value_name = "N", help = "Panels per row of a strip",
                value_parser = clap::builder::TypedValueParser::map(clap::value_parser!(u16).range(1..), usize::from));
        /// The movement of the scene that a mechanism [at](At::Movement) a movement shows, from 1; `None` for the first
        /// one that the structure follows.
        pub movement: Option<usize> = given.whole("movement", [1, 65535]).map(|number| number as usize),
            arg(long, value_name = "N", help = "The movement of a support that --at movement shows, from 1",
                value_parser = clap::builder::TypedValueParser::map(clap::value_parser!(u16).range(1..), usize::from));
        /// Whether [`Kind::Joints`](super::Kind::Joints) shows the forces of the largest kernel.
        pub central: bool = false, arg(skip);
        /// The motion that [`Kind::Mechanism`](super::Kind::Mechanism) shows; `None` for the fall of what does not stand.
        pub at: Option<At> = given.word("at"),
            arg(long, value_name = "AT", value_parser = crate::text::typed_word::<At>(),
                help = "What --kind mechanism shows: how a structure that stands falls just beyond a margin, with errors \
                        of placement or under its vehicle, or how it cracks as a support moves");
        /// How far the blocks of a mechanism are drawn along their paths: 0 at the beginning, 1 at the end.
        pub motion_progress: f64 = given.number("way").map_or(1.0, |way| way.clamp(0.0, 1.0)), arg(skip = 1.0);
        /// Whether the picture belongs to an animation: the blocks of a mechanism then move until it is clear what falls.
        pub film: bool = false, arg(skip);
        /// The block of [`Kind::Freebody`](super::Kind::Freebody); `None` for the block with the largest contact force.
        pub block: Option<BlockId> = None, arg(skip);
        /// The block in the centre of a zoomed picture. The picture only shows this block and its surroundings. `None`
        /// for the whole structure.
        pub zoom: Option<BlockId> = None, arg(skip);
        /// Colours, widths and font sizes.
        pub theme: Theme = Theme::default(), arg(skip);
        /// Width of the page, pixels; `None` to choose it by the content. Font sizes do not depend on this width. Only
        /// on a page as narrow as a column of print, the texts around the picture become smaller if they would need
        /// more space than the picture.
        pub width: Option<f64> = None, arg(skip);
        /// Largest height of the picture of a frame without its legend, pixels. `None` to choose it by the number of
        /// frames.
        pub height: Option<f64> = None, arg(skip);
    }
}

/// A page narrower than this, pixels, is a column of print. In print, this width is 110 mm.
const PRINT_COLUMN: f64 = 520.0;

impl Options {
    /// Returns the options with the theme for this scene.
    pub(crate) fn for_scene(&self, scene: &Scene) -> Options {
        Options { theme: self.theme.for_scene(scene.lattice.is_some()), ..self.clone() }
    }

    /// True if arrows look as in the printed figures of the thesis: separate arrows for the components of forces, at
    /// the scale of the thesis.
    pub(crate) fn printed(&self) -> bool {
        self.normalisation == Normalisation::Source && self.style == ForceStyle::Components
    }

    /// Returns the colour of missing forces: in printed figures with the theme of the thesis its red, otherwise that of
    /// the theme, so that red and green differ in a grey print.
    pub(crate) fn failure(&self) -> Colour {
        if self.printed() && self.theme == Theme::thesis() { Colour::hex(0xff0000) } else { self.theme.failure }
    }

    /// True if the page is as narrow as a column of print. Texts are then shorter, and lines closer together.
    pub(crate) fn is_column(&self) -> bool {
        self.width.is_some_and(|width| width < PRINT_COLUMN)
    }
}

/// Largest number of blocks that a message lists.
const MAX_LISTED_BLOCKS: usize = 12;

/// Finds the block for a free-body diagram by its name. The name may be left out if the scene has only one block. The
/// error is a message for the user.
pub(crate) fn free_block(scene: &Scene, name: Option<&str>) -> Result<BlockId, String> {
    let is_placed = |id: BlockId| scene.frames.iter().any(|frame| frame.placed.contains(&id));
    let Some(name) = name else {
        if scene.blocks.len() == 1 && is_placed(BlockId(0)) {
            return Ok(BlockId(0));
        }
        return Err(format!(
            "a free-body diagram shows one block; add --block with one of these names: {}",
            first_names(scene)
        ));
    };
    let block = named_block(scene, name)?;
    if is_placed(block) { Ok(block) } else { Err(format!("block {name} is not placed in any of the frames")) }
}

/// Finds the block with this name. If there is none, the error suggests a similar name or lists the blocks.
pub(crate) fn named_block(scene: &Scene, name: &str) -> Result<BlockId, String> {
    let number = scene.blocks.iter().position(|b| b.id == name);
    number.map(BlockId).ok_or_else(|| {
        let known = scene.blocks.iter().map(|b| b.id.as_str());
        let near = nearest(name, known).map_or_else(|| listed(scene), |near| format!("; did you mean {near}?"));
        format!("there is no block {name}{near}")
    })
}

/// Lists the blocks of a scene for an error message: `; the blocks are a, b, …`. At most [`MAX_LISTED_BLOCKS`] are
/// named.
fn listed(scene: &Scene) -> String {
    if scene.blocks.is_empty() {
        "; the scene has no blocks".into()
    } else {
        format!("; the blocks are {}", first_names(scene))
    }
}

fn first_names(scene: &Scene) -> String {
    let ids = scene.blocks.iter().map(|b| text::line(&b.id));
    let mut names: Vec<String> = ids.take(MAX_LISTED_BLOCKS).collect();
    if scene.blocks.len() > MAX_LISTED_BLOCKS {
        names.push("…".into());
    }
    names.join(", ")
}
