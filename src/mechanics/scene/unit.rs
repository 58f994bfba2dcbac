//! [`Unit`]: the units in which a scene file gives lengths and forces, and in which results are written for people.
//!
//! A scene is resolved in the units of its file, because tolerances depend on how coordinates are written. It is then
//! converted to metres and newtons ([`to_si`]), so that all other modules compute in SI units.

use super::format::{ForceUnit, LengthUnit, UnitsEntry};
use super::{Body, Scene};
use crate::geometry::{Point, Polygon};

/// A unit in which a scene file or a result gives a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Unit {
    /// The parts of its symbol, for example `kN`, `·` and `mm`.
    symbol: [&'static str; 3],
    /// Its size in SI units.
    pub(crate) size: f64,
    /// Whether the scene file sets this unit. Otherwise it is an SI unit, and large or small numbers are written with
    /// a prefix such as k for 1000.
    pub(crate) is_chosen: bool,
}

impl Unit {
    /// Returns the symbol of the unit, such as `kN·mm`.
    pub(crate) fn symbol(&self) -> String {
        self.symbol.concat()
    }

    /// Converts a value from the SI unit to this unit.
    pub(crate) fn value_from_si(&self, value: f64) -> f64 {
        value / self.size
    }
}

/// An SI unit, such as `"N"`.
impl From<&'static str> for Unit {
    fn from(symbol: &'static str) -> Unit {
        Unit { symbol: [symbol, "", ""], size: 1.0, is_chosen: false }
    }
}

impl LengthUnit {
    /// Returns the symbol of the unit, the symbol of its square, and the size of the unit in metres.
    pub(super) fn parts(self) -> (&'static str, &'static str, f64) {
        match self {
            LengthUnit::Metre => ("m", "m²", 1.0),
            LengthUnit::Centimetre => ("cm", "cm²", 1e-2),
            LengthUnit::Millimetre => ("mm", "mm²", 1e-3),
            LengthUnit::Inch => ("in", "in²", 0.0254),
            LengthUnit::Foot => ("ft", "ft²", 0.3048),
        }
    }
}

impl ForceUnit {
    /// Returns the symbol of the unit, and its size in newtons.
    pub(super) fn parts(self) -> (&'static str, f64) {
        match self {
            ForceUnit::Newton => ("N", 1.0),
            ForceUnit::Kilonewton => ("kN", 1e3),
            ForceUnit::Meganewton => ("MN", 1e6),
            ForceUnit::PoundForce => ("lbf", 4.448_221_615_260_5),
        }
    }
}

impl UnitsEntry {
    /// Returns the unit of lengths in the scene file. The default is metres.
    pub fn length(&self) -> Unit {
        let (symbol, _, size) = self.length.unwrap_or_default().parts();
        Unit { symbol: [symbol, "", ""], size, is_chosen: self.length.is_some() }
    }

    /// Writes a small length with its unit and a power of ten, such as `6.71×10⁻³ mm`. `digits` is the number of digits
    /// after the point.
    pub(crate) fn small_length(&self, metres: f64, digits: usize) -> String {
        let unit = self.length();
        format!("{} {}", crate::text::power_of_ten(unit.value_from_si(metres), digits), unit.symbol())
    }

    /// Writes a length as a value to be typed, such as `6.71e-3 mm`.
    pub(crate) fn typed_length(&self, metres: f64) -> String {
        let unit = self.length();
        format!("{:.2e} {}", unit.value_from_si(metres), unit.symbol())
    }

    /// Writes the coordinates of a point in the unit of length, with four digits after the point and without the unit.
    pub(crate) fn coordinates(&self, at: Point) -> String {
        let [x, y] = [at.x, at.y].map(|v| self.length().value_from_si(v));
        format!("({x:.4}, {y:.4})")
    }

    /// Returns the unit of forces and weights; newtons if the file gives none.
    pub fn force(&self) -> Unit {
        let (symbol, size) = self.force.unwrap_or_default().parts();
        Unit { symbol: [symbol, "", ""], size, is_chosen: self.force.is_some() }
    }

    /// Returns the unit of torques: the unit of forces times the unit of lengths.
    pub fn torque(&self) -> Unit {
        let (length, force) = (self.length(), self.force());
        Unit {
            symbol: [force.symbol[0], "·", length.symbol[0]],
            size: force.size * length.size,
            is_chosen: force.is_chosen || length.is_chosen,
        }
    }

    /// Returns the unit of stresses: the unit of forces divided by the square of the unit of lengths.
    pub fn stress(&self) -> Unit {
        let (length, force) = (self.length(), self.force());
        let (_, square, _) = self.length.unwrap_or_default().parts();
        Unit {
            symbol: [force.symbol[0], "/", square],
            size: force.size / (length.size * length.size),
            is_chosen: force.is_chosen || length.is_chosen,
        }
    }
}

/// Converts a scene from the units of its file to metres and newtons. The weights are in newtons already.
pub(super) fn to_si(scene: &mut Scene) {
    let [length, force, torque] = [scene.units.length().size, scene.units.force().size, scene.units.torque().size];
    if length == 1.0 && force == 1.0 {
        return;
    }
    for x in [
        &mut scene.thickness,
        &mut scene.misfit,
        &mut scene.healed.within,
        &mut scene.healed.distance,
        &mut scene.tolerance.gap,
        &mut scene.tolerance.min_length,
        &mut scene.tolerance.rounding,
    ] {
        *x *= length;
    }
    if let Some(lattice) = &mut scene.lattice {
        lattice.side *= length;
    }
    let grounds = scene.ground.iter_mut().map(|g| &mut g.body);
    let blocks = scene.blocks.iter_mut().map(|b| &mut b.body);
    let lattice = scene.lattice.filter(|_| scene.exact);
    for body in grounds.chain(blocks) {
        convert(body, length);
        // All modules compute the corners of lattice cells with the converted lattice. Compute these corners in the
        // same way, so that they are rounded in the same way.
        let cells = body.cells.as_ref().zip(lattice);
        if let Some(polygon) = cells.and_then(|(cells, lattice)| lattice.polygon(cells)) {
            body.polygon = polygon;
        }
    }
    let points = (scene.blocks.iter_mut().map(|b| &mut b.centroid))
        .chain(scene.loads.iter_mut().map(|l| &mut l.at))
        .chain(scene.contacts.iter_mut().map(|c| &mut c.at))
        .chain(scene.penetrations.iter_mut().map(|p| &mut p.at))
        .chain((scene.robots.iter_mut()).filter_map(|r| r.holds.as_mut().map(|g| &mut g.at)))
        .chain((scene.frames.iter_mut()).flat_map(|f| f.holds.iter_mut().map(|h| &mut h.at)));
    for point in points {
        *point = Point::from(point.coords * length);
    }
    for movement in &mut scene.movements {
        movement.translation *= length;
        movement.about = Point::from(movement.about.coords * length);
    }
    if let Some(vehicle) = &mut scene.vehicle {
        vehicle.step *= length;
        for axle in &mut vehicle.axles {
            axle.weight *= force;
            axle.offset *= length;
        }
    }
    for penetration in &mut scene.penetrations {
        penetration.depth *= length;
    }
    for load in &mut scene.loads {
        load.force *= force;
        load.torque *= torque;
        if let Some(spread) = &mut load.spread {
            spread.ends = spread.ends.map(|end| Point::from(end.coords * length));
            spread.force = spread.force.map(|along| along * (force / length));
        }
    }
    for limits in scene.robots.iter_mut().map(|r| &mut r.limits) {
        limits.fx *= force;
        limits.fy *= force;
        limits.torque *= torque;
    }
}

fn convert(body: &mut Body, length: f64) {
    let ring = |ring: &Vec<Point>| ring.iter().map(|p| Point::from(p.coords * length)).collect();
    body.polygon = Polygon::from_valid_rings(body.polygon.rings().iter().map(ring).collect());
    if let Some(circle) = &mut body.circle {
        (circle.centre, circle.radius) = (Point::from(circle.centre.coords * length), circle.radius * length);
    }
    body.gap *= length;
    body.rounding *= length;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn torques_and_stresses_combine_both_units() {
        let units = UnitsEntry { length: Some(LengthUnit::Millimetre), force: Some(ForceUnit::Kilonewton) };
        assert_eq!((units.torque().symbol(), units.torque().size), ("kN·mm".into(), 1.0));
        assert_eq!((units.stress().symbol(), units.stress().size), ("kN/mm²".into(), 1e9));
        let si = UnitsEntry::default();
        assert_eq!(si.torque().symbol(), "N·m");
        assert!(!si.stress().is_chosen);
    }
}
