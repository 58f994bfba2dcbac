//! [`forces`]: how the forces run, one panel per frame.

use super::kind::Kind;
use super::option::Options;
use super::strip::strip;
use crate::analysis::Analysis;
use crate::drawing::Drawing;

/// The figure of an analysis: each frame a panel with its forces, its caption and its verdict, several frames a strip.
///
/// Arrows act on a block and wear its colour; what is missing is thick and red; the colours of blocks tell amplitudes
/// ([Vallat23](crate::doc::references) §2.0.8 and §2.0.9). All panels show the same part of the scene at the same scale.
///
/// Units: the page is in pixels at natural size, some 370 to 1100 wide unless `columns` asks for more.
///
/// # Example
/// ```
/// use drystone::{Analysis, Scene, figure, output};
/// let scene = Scene::from_json(
///     r#"{ "drystone": 1, "title": "A brick",
///          "ground": [ { "polygon": [[-1, -1], [3, -1], [3, 0], [-1, 0]] } ],
///          "blocks": [ { "id": "brick", "polygon": [[0, 0], [2, 0], [2, 1], [0, 1]], "weight": 6 } ] }"#,
/// )?;
/// let drawing = figure::forces(&Analysis::new(&scene), &figure::Options::default());
/// let svg = output::svg::write(&drawing);
/// assert!(svg.contains("Weight of block brick: 6 N at 270°"));
/// let png = output::png::render(&svg, output::png::Size::Width(800))?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn forces(analysis: &Analysis, options: &Options) -> Drawing {
    strip(analysis, Kind::Forces, options)
}
