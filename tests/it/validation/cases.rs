//! The published values, and the functions that compute the values of drystone. Each case is one row of the page.

use super::{arches, blocks, panels, stacks, walls};

/// How a value is written.
#[derive(Clone, Copy, PartialEq)]
pub enum Unit {
    Ratio,
    Degrees,
    Newtons,
    /// 1 for yes, 0 for no.
    Answer,
}

/// A published value, and the function that computes it with drystone.
pub struct Case {
    /// The section of the page.
    pub group: &'static str,
    /// The structure and the quantity.
    pub what: &'static str,
    pub unit: Unit,
    /// The value as published, with all its digits.
    pub published: &'static str,
    /// A key of `SOURCES`.
    pub source: &'static str,
    /// Whether the value was found in a text, either by its authors or about their work.
    pub seen: bool,
    /// The largest allowed difference, percent.
    pub within: f64,
    /// Computes the value with drystone.
    pub ours: fn() -> f64,
}

const fn row(
    (group, what): (&'static str, &'static str),
    (published, unit): (&'static str, Unit),
    (source, seen): (&'static str, bool),
    within: f64,
    ours: fn() -> f64,
) -> Case {
    Case { group, what, unit, published, source, seen, within, ours }
}

use Unit::{Answer, Degrees, Newtons, Ratio};

const ARCH: &str = "arch";
const PUSHED: &str = "pushed arch";
const WALL: &str = "wall";
const STACK: &str = "stack";
const FIGURE: &str = "figure of the source";
const COLUMN: &str = "column";
const TOPPLING: &str = "toppling rock";
const WEDGE: &str = "wedging";

/// All cases, in the order of the page.
#[rustfmt::skip]
pub const CASES: &[Case] = &[
    row((ARCH, "semicircle, least thickness over mean radius"), ("0.1075", Ratio), ("Milankovitch07", true), 0.1, arches::least_thickness),
    row((ARCH, "the same, its weight on the mean radius"), ("0.107426", Ratio), ("Cocchetti20", true), 0.05, arches::least_thickness_on_the_line),
    row((ARCH, "the same, approximate theory"), ("0.106", Ratio), ("Heyman69", true), 2.0, arches::least_thickness),
    row((ARCH, "the same, hinge assumed at 45°"), ("0.101", Ratio), ("Couplet1730", false), 7.0, arches::least_thickness),
    row((ARCH, "the same, vertical joints"), ("0.1095", Ratio), ("MakrisAlexakis13", true), 0.2, arches::least_thickness_cut_vertically),
    row((ARCH, "thinnest semicircle, angle of the hinge from the crown"), ("54.4963", Degrees), ("Cocchetti20", true), 0.1, arches::hinge_of_the_thinnest),
    row((ARCH, "the same, thrust over weight per length and radius"), ("0.621772", Ratio), ("Cocchetti20", true), 0.02, arches::thrust_of_the_thinnest),
    row((ARCH, "the same, least thrust that balances it"), ("0.621772", Ratio), ("Cocchetti20", true), 0.02, arches::least_thrust_of_the_thinnest),
    row((ARCH, "the same, greatest thrust that balances it"), ("0.621772", Ratio), ("Cocchetti20", true), 0.02, arches::greatest_thrust_of_the_thinnest),
    row((ARCH, "the same, least friction"), ("0.395832", Ratio), ("Cocchetti20", true), 0.02, arches::friction_of_the_thinnest),
    row((ARCH, "the same, least friction"), ("0.395", Ratio), ("Sinopoli97", false), 0.4, arches::friction_of_the_thinnest),
    row((ARCH, "semicircle of any thickness, least friction"), ("0.309215", Ratio), ("Cocchetti20", true), 0.1, arches::friction_of_a_thick_arch),
    row((ARCH, "the same"), ("0.31", Ratio), ("Sinopoli97", false), 0.5, arches::friction_of_a_thick_arch),
    row((ARCH, "least thickness with that friction"), ("0.200637", Ratio), ("Cocchetti20", true), 0.2, arches::thickness_at_least_friction),
    row((PUSHED, "seven voussoirs over 157.5°, horizontal load over weight"), ("0.37", Ratio), ("Oppenheim92", false), 1.5, arches::oppenheim_pushed),
    row((PUSHED, "25 voussoirs on a tilting table, φ = 30°"), ("17.10", Degrees), ("Hua25", true), 0.1, arches::lact3_tilted),
    row((WALL, "wall 1, horizontal load over weight, associated friction"), ("0.64286", Ratio), ("Gilbert06", false), 0.002, walls::pushed::<1>),
    row((WALL, "wall 2, the same"), ("0.58000", Ratio), ("Gilbert06", false), 0.002, walls::pushed::<2>),
    row((WALL, "wall 3, the same"), ("0.40369", Ratio), ("Gilbert06", false), 0.003, walls::pushed::<3>),
    row((WALL, "wall 4, the same"), ("0.33195", Ratio), ("Gilbert06", false), 0.003, walls::pushed::<4>),
    row((WALL, "wall 5, the same"), ("0.23964", Ratio), ("Gilbert06", false), 0.003, walls::pushed::<5>),
    row((WALL, "wall 1, friction without dilatancy"), ("0.63982", Ratio), ("Ferris01", false), 0.6, walls::pushed::<1>),
    row((WALL, "wall 2, friction without dilatancy"), ("0.56262", Ratio), ("Ferris01", false), 3.2, walls::pushed::<2>),
    row((STACK, "2 blocks, one on one, reach over length"), ("0.75", Ratio), ("Weisstein", true), 1e-4, stacks::one_on_one::<2>),
    row((STACK, "3 blocks, one on one"), ("0.91667", Ratio), ("Weisstein", true), 1e-3, stacks::one_on_one::<3>),
    row((STACK, "4 blocks, one on one"), ("1.04167", Ratio), ("Weisstein", true), 1e-3, stacks::one_on_one::<4>),
    row((STACK, "51 blocks, one on one"), ("2.25940659", Ratio), ("Weisstein", true), 1e-4, stacks::one_on_one::<51>),
    row((STACK, "3 blocks, two on one"), ("1", Ratio), ("Paterson09", true), 1e-4, stacks::several_on_one::<3>),
    row((STACK, "4 blocks, several on one"), ("1.16789", Ratio), ("Paterson09", true), 1e-3, stacks::several_on_one::<4>),
    row((STACK, "the same"), ("1.168", Ratio), ("Ainley79", true), 0.02, stacks::several_on_one::<4>),
    row((STACK, "5 blocks, several on one"), ("1.30455", Ratio), ("Paterson09", true), 1e-3, stacks::several_on_one::<5>),
    row((STACK, "6 blocks, several on one"), ("1.4367", Ratio), ("Paterson09", true), 1e-3, stacks::several_on_one::<6>),
    row((FIGURE, "figure 3b, sum of all contact forces"), ("38.983472", Newtons), ("Vallat23", true), 1e-5, panels::figure_3b),
    row((FIGURE, "figure 4, third step, with robots"), ("48.831177", Newtons), ("Vallat23", true), 1e-5, panels::figure_4c),
    row((FIGURE, "figure 5, second step, with a robot"), ("439.48647", Newtons), ("Vallat23", true), 1e-5, panels::figure_5b),
    row((FIGURE, "figure 6, bottom, kernel 0.2"), ("20.306101", Newtons), ("Vallat23", true), 1e-5, panels::figure_6e),
    row((FIGURE, "figure 8, left"), ("63.984279", Newtons), ("Vallat23", true), 1e-5, panels::figure_8_left),
    row((FIGURE, "figure 8, right, sum of missing forces"), ("2.391686", Newtons), ("Vallat23", true), 1e-4, panels::figure_8_right),
    row((FIGURE, "figure 9a, sum of missing forces"), ("4.705486", Newtons), ("Vallat23", true), 1e-4, panels::figure_9a),
    row((COLUMN, "column 1 m by 4 m, horizontal load over weight: b/h"), ("0.25", Ratio), ("Housner63", true), 1e-4, blocks::column_pushed),
    row((COLUMN, "the same on a tilting table: arctan b/h"), ("14.0362", Degrees), ("Housner63", true), 1e-3, blocks::column_tilted),
    row((COLUMN, "beam on two columns 0.4 m by 2 m, the same load: b/h"), ("0.2", Ratio), ("MakrisVassiliou13", false), 1e-4, blocks::frame_pushed),
    row((COLUMN, "ladder of 3 m and 20 kg, force of the wall"), ("34.6", Newtons), ("NCERT", true), 0.2, blocks::ladder_on_its_wall),
    row((COLUMN, "block on a plane of 34°, φ = 31°: tan φ / tan 34°"), ("0.891", Ratio), ("HoekBray81", true), 0.05, blocks::plane_safety),
    row((TOPPLING, "16 rock columns, least friction"), ("0.7855", Ratio), ("Goodman76", true), 17.0, blocks::toppling_alone),
    row((TOPPLING, "the same, supported by 2013 kN"), ("0.6500", Ratio), ("Goodman76", true), 11.0, blocks::toppling_supported),
    row((TOPPLING, "16 rock columns, φ = 38.15°, factor of safety by distinct elements"), ("0.99", Ratio), ("RS2", true), 21.0, blocks::toppling_safety),
    row((WEDGE, "model H, a bar between two fixed columns, stands only by wedging"), ("yes", Answer), ("Kao22", false), 0.0, blocks::h_model_wedges),
    row((WEDGE, "model A, the same with columns that lean together"), ("yes", Answer), ("Kao22", false), 0.0, blocks::a_model_wedges),
];
