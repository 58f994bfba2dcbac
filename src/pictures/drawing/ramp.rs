//! Colour ramps: [built-in ramps](named), and ramps that are [interpolated between some colours](between).

mod cividis;
mod plasma;
mod viridis;

use super::colour::Colour;

pub use plasma::PLASMA;

/// The names of the built-in ramps.
pub const NAMES: [&str; 4] = ["plasma", "viridis", "cividis", "grey"];

/// Number of colours in a ramp.
pub const LENGTH: usize = 256;

/// Returns the ramp of 256 colours with this name. Its first colour shows the smallest value, and its last colour the
/// largest. Returns `None` for a name that is not in [`NAMES`].
///
/// `plasma`, `viridis` and `cividis` come from matplotlib. `grey` goes from nearly white to a light grey on which black
/// text is readable.
pub fn named(name: &str) -> Option<Vec<Colour>> {
    let table = |values: &[u32; LENGTH]| values.iter().map(|v| Colour::hex(*v)).collect();
    match name {
        "plasma" => Some(table(&PLASMA)),
        "viridis" => Some(table(&viridis::VIRIDIS)),
        "cividis" => Some(table(&cividis::CIVIDIS)),
        "grey" => Some(between(&[Colour::hex(0xf7f7f7), Colour::hex(0xbdbdbd)])),
        _ => None,
    }
}

/// Returns a ramp of 256 colours. It is interpolated linearly in each channel between the colours `stops`, which are
/// evenly spaced along the ramp. Returns an empty list if there are no stops.
pub fn between(stops: &[Colour]) -> Vec<Colour> {
    let Some(last) = stops.len().checked_sub(1) else {
        return Vec::new();
    };
    let at = |entry: usize| {
        // Compute the position with integers, so that 256 stops give exactly these 256 colours.
        let (stop, rest) = (entry * last / (LENGTH - 1), entry * last % (LENGTH - 1));
        let next = stops[(stop + 1).min(last)];
        stops[stop].mixed(next, rest as f64 / (LENGTH - 1) as f64)
    };
    (0..LENGTH).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_known_names_have_a_ramp() {
        for name in NAMES {
            let ramp = named(name).expect(name);
            assert_eq!(ramp.len(), LENGTH, "{name}");
        }
        assert_eq!(named("jet"), None);
        // The first and the last colour as printed by matplotlib.
        let ends = |name| named(name).map(|r| (r[0], r[255]));
        assert_eq!(ends("viridis"), Some((Colour::hex(0x440154), Colour::hex(0xfde725))));
        assert_eq!(ends("cividis"), Some((Colour::hex(0x00224e), Colour::hex(0xfee838))));
    }

    #[test]
    fn a_ramp_contains_its_stops() {
        let viridis = named("viridis").expect("known");
        assert_eq!(between(&viridis), viridis);
        let two = between(&[Colour::BLACK, Colour::WHITE]);
        assert!((0..LENGTH).all(|i| two[i] == Colour([i as u8; 3])));
        assert_eq!(between(&[Colour::BLACK]), vec![Colour::BLACK; LENGTH]);
        assert_eq!(between(&[]), Vec::new());
        let three = between(&[Colour::WHITE, Colour::hex(0xff0000), Colour::BLACK]);
        assert_eq!((three[0], three[51].0[0], three[255]), (Colour::WHITE, 255, Colour::BLACK));
    }
}
