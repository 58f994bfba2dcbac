//! [`Arch`]: a round arch.

use super::{STONE_DENSITY, block, floor, rounded};
use crate::mechanics::scene::format::{Pair, SceneFile};

/// A semicircular arch of equal voussoirs on level ground.
///
/// A thin arch falls. With sufficient friction and many voussoirs, an arch stands if its thickness is at least 0.1075
/// times the radius of its centre line.
///
/// # Example
/// ```
/// use drystone::{Analysis, Scene, analysis::Verdict, starter::Arch};
/// let arch = |thickness| Scene::new(Arch { thickness, ..Arch::default() }.scene());
/// assert_eq!(Analysis::new(&arch(0.4)?).verdict(), Verdict::Stable);
/// assert_eq!(Analysis::new(&arch(0.15)?).verdict(), Verdict::Unstable);
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arch {
    /// The number of voussoirs, at least 2.
    pub voussoirs: usize,
    /// Clear width, in metres.
    pub span: f64,
    /// The thickness from the inner to the outer face, in metres.
    pub thickness: f64,
    /// Friction coefficient.
    pub friction: f64,
}

impl Default for Arch {
    /// Returns an arch of 13 voussoirs with a clear width of 4 m, 0.4 m thick, with a friction coefficient of 0.7. It
    /// stands.
    fn default() -> Arch {
        Arch { voussoirs: 13, span: 4.0, thickness: 0.4, friction: 0.7 }
    }
}

impl Arch {
    /// Returns a scene file with the arch on the ground, of stone with 2500 kg/m³.
    pub fn scene(&self) -> SceneFile {
        let (inner, outer) = (0.5 * self.span, 0.5 * self.span + self.thickness);
        let least = self.thickness.min(self.span);
        let joint = |number: usize, radius: f64| -> Pair {
            // Both springings are at the height 0 exactly, without rounding errors.
            let angle = match number {
                0 => return [rounded(-radius, least), 0.0],
                n if n == self.voussoirs => return [rounded(radius, least), 0.0],
                n => core::f64::consts::PI * (1.0 - n as f64 / self.voussoirs as f64),
            };
            let (sin, cos) = libm::sincos(angle);
            [rounded(radius * cos, least), rounded(radius * sin, least)]
        };
        let voussoir = |i: usize| {
            let corners = vec![joint(i, inner), joint(i, outer), joint(i + 1, outer), joint(i + 1, inner)];
            block((i + 1).to_string(), corners)
        };
        let aside = rounded(outer + self.thickness, least);
        SceneFile {
            title: Some(format!(
                "A round arch of {} voussoirs over {} m, {} m thick",
                self.voussoirs, self.span, self.thickness
            )),
            friction: Some(self.friction),
            density: Some(STONE_DENSITY),
            ground: vec![floor(-aside, aside, self.thickness)],
            blocks: (0..self.voussoirs).map(voussoir).collect(),
            ..SceneFile::default()
        }
    }
}
