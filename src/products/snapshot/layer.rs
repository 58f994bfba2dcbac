//! [`Layer`]: the three layers in which a snapshot is compared with its references: facts, SVG and pixels.

/// A form in which a result is stored and compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Layer {
    /// Verdict, interfaces and forces, as text.
    Facts,
    /// The elements of the drawing.
    Svg,
    /// The pixels of the picture.
    Pixels,
}

impl Layer {
    /// All layers, from the results to the picture. A difference in one layer usually explains those in later
    /// layers.
    pub const ALL: [Layer; 3] = [Layer::Facts, Layer::Svg, Layer::Pixels];

    /// Returns the name of the layer in settings and reports.
    pub fn name(self) -> &'static str {
        match self {
            Layer::Facts => "facts",
            Layer::Svg => "svg",
            Layer::Pixels => "pixels",
        }
    }

    /// Returns the layer with this name; `None` if there is no such layer.
    pub fn named(name: &str) -> Option<Layer> {
        Layer::ALL.into_iter().find(|layer| layer.name() == name)
    }
}
