//! Computes perceived differences between colours: [`difference()`] (CIEDE2000) and [`lightness()`]. [`seen`] converts
//! a colour to its appearance for colour-blind readers and in grey print.
//!
//! A difference of about 1 is the least that can be seen if two colours are side by side. A difference of 10 is seen
//! at a glance, and black and white differ by 100 ([Sharma05](crate::doc::references)). Colour vision deficiencies
//! follow [Machado09](crate::doc::references), at full severity.

use core::f64::consts::PI;

use super::colour::Colour;

/// The colour vision of a reader, or a grey print.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sight {
    /// Full colour vision.
    Full,
    /// No cones for long wavelengths: red looks dark.
    Protanopia,
    /// No cones for medium wavelengths.
    Deuteranopia,
    /// No cones for short wavelengths.
    Tritanopia,
    /// A grey print: only lightness remains.
    Grey,
}

/// Returns the colour as it looks to a reader with the colour vision `sight`.
///
/// ```
/// use drystone::drawing::{Colour, difference::{Sight, difference, seen}};
/// let (red, green) = (Colour::hex(0xc00000), Colour::hex(0x607000));
/// let apart = |sight| difference(seen(red, sight), seen(green, sight));
/// assert!(apart(Sight::Protanopia) < 0.7 * apart(Sight::Full));
/// ```
pub fn seen(colour: Colour, sight: Sight) -> Colour {
    let rows = match sight {
        Sight::Full => return colour,
        Sight::Protanopia => {
            [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]
        }
        Sight::Deuteranopia => {
            [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]
        }
        Sight::Tritanopia => {
            [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]]
        }
        Sight::Grey => [LUMINANCE_WEIGHTS; 3],
    };
    let light = linear(colour);
    Colour(rows.map(|row| coded(dot(row, light))))
}

/// Returns the CIE lightness L*, from 0 (black) to 100 (white).
pub fn lightness(colour: Colour) -> f64 {
    lab(colour)[0]
}

/// Returns the contrast of two colours as defined by WCAG 2: (L₁ + 0.05) / (L₂ + 0.05) for the luminances L₁ ≥ L₂. The
/// contrast is 1 for equal luminances and 21 for black on white. Small text needs at least 4.5.
///
/// ```
/// use drystone::drawing::{Colour, difference::contrast};
/// assert_eq!(contrast(Colour::BLACK, Colour::WHITE), 21.0);
/// assert!((contrast(Colour::hex(0x767676), Colour::WHITE) - 4.54).abs() < 0.01);
/// ```
pub fn contrast(a: Colour, b: Colour) -> f64 {
    // WCAG rounds the luminance coefficients of sRGB to four digits.
    let luminance = |c: Colour| dot([0.2126, 0.7152, 0.0722], linear(c)) + 0.05;
    let (a, b) = (luminance(a), luminance(b));
    if a > b { a / b } else { b / a }
}

/// Returns the difference ΔE₀₀ of two colours (CIEDE2000); 0 for equal colours.
pub fn difference(a: Colour, b: Colour) -> f64 {
    between(lab(a), lab(b))
}

/// The weights of the linear red, green and blue channels in the luminance.
const LUMINANCE_WEIGHTS: [f64; 3] = [0.212_672_9, 0.715_152_2, 0.072_175_0];

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Converts the three sRGB channels of a colour to linear light, from 0 to 1.
fn linear(colour: Colour) -> [f64; 3] {
    colour.0.map(|channel| {
        let v = f64::from(channel) / 255.0;
        if v <= 0.04045 { v / 12.92 } else { libm::pow((v + 0.055) / 1.055, 2.4) }
    })
}

/// Converts linear light (0 to 1) to an sRGB channel (0 to 255). Values outside 0 to 1 are clamped.
fn coded(light: f64) -> u8 {
    let v = if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * libm::pow(light, 1.0 / 2.4) - 0.055 };
    // The conversion with `as` clamps the value to 0 to 255.
    (255.0 * v).round() as u8
}

/// Returns the CIE L*, a* and b* of a colour for the white point D65.
fn lab(colour: Colour) -> [f64; 3] {
    let light = linear(colour);
    let bent = |t: f64| {
        if t > 216.0 / 24389.0 { libm::cbrt(t) } else { (24389.0 / 27.0 * t + 16.0) / 116.0 }
    };
    let x = bent(dot([0.412_456_4, 0.357_576_1, 0.180_437_5], light) / 0.95047);
    let y = bent(dot(LUMINANCE_WEIGHTS, light));
    let z = bent(dot([0.019_333_9, 0.119_192_0, 0.950_304_1], light) / 1.08883);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Returns the difference ΔE₀₀ of two colours, given as L*, a* and b*. It is computed as in
/// [Sharma05](crate::doc::references).
fn between([l1, a1, b1]: [f64; 3], [l2, a2, b2]: [f64; 3]) -> f64 {
    let seventh = |c: f64| {
        let c7 = libm::pow(c, 7.0);
        libm::sqrt(c7 / (c7 + libm::pow(25.0, 7.0)))
    };
    let mean = (libm::hypot(a1, b1) + libm::hypot(a2, b2)) / 2.0;
    let stretch = 1.0 + 0.5 * (1.0 - seventh(mean));
    let (a1, a2) = (stretch * a1, stretch * a2);
    let (c1, c2) = (libm::hypot(a1, b1), libm::hypot(a2, b2));
    let hue = |a: f64, b: f64| {
        let angle = libm::atan2(b, a);
        if angle < 0.0 { angle + 2.0 * PI } else { angle }
    };
    let (h1, h2) = (hue(a1, b1), hue(a2, b2));
    // Hues are angles. The hue of a grey is set to 0, so the sum is the hue of the other colour.
    let (turn, middle) = if c1 * c2 == 0.0 {
        (0.0, h1 + h2)
    } else if (h1 - h2).abs() <= PI {
        (h2 - h1, (h1 + h2) / 2.0)
    } else {
        let round = if h2 > h1 { -2.0 * PI } else { 2.0 * PI };
        let over = if h1 + h2 < 2.0 * PI { PI } else { -PI };
        (h2 - h1 + round, (h1 + h2) / 2.0 + over)
    };
    let (dl, dc) = (l2 - l1, c2 - c1);
    let dh = 2.0 * libm::sqrt(c1 * c2) * libm::sin(turn / 2.0);
    let (l, c) = ((l1 + l2) / 2.0 - 50.0, (c1 + c2) / 2.0);
    let degrees = PI / 180.0;
    let t = 1.0 - 0.17 * libm::cos(middle - 30.0 * degrees)
        + 0.24 * libm::cos(2.0 * middle)
        + 0.32 * libm::cos(3.0 * middle + 6.0 * degrees)
        - 0.20 * libm::cos(4.0 * middle - 63.0 * degrees);
    let blue = (middle / degrees - 275.0) / 25.0;
    let turned = libm::sin(60.0 * degrees * libm::exp(-blue * blue));
    let l = dl / (1.0 + 0.015 * l * l / libm::sqrt(20.0 + l * l));
    let h = dh / (1.0 + 0.015 * c * t);
    let chroma = dc / (1.0 + 0.045 * c);
    let mixed = -turned * 2.0 * seventh(c) * chroma * h;
    libm::sqrt((l * l + chroma * chroma + h * h + mixed).max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pairs of colours from the supplement to Sharma, Wu and Dalal (2005), for the special cases of the formula:
    /// blue, hues on either side of 0, greys, large distances, and near black.
    #[test]
    fn differences_equal_the_published_values() {
        let pairs = [
            ([50.0, 2.6772, -79.7751], [50.0, 0.0, -82.7485], 2.0425),
            ([50.0, 3.1571, -77.2803], [50.0, 0.0, -82.7485], 2.8615),
            ([50.0, -1.3802, -84.2814], [50.0, 0.0, -82.7485], 1.0),
            ([50.0, 0.0, 0.0], [50.0, -1.0, 2.0], 2.3669),
            ([50.0, 2.4900, -0.0010], [50.0, -2.4900, 0.0009], 7.1792),
            ([50.0, 2.4900, -0.0010], [50.0, -2.4900, 0.0011], 7.2195),
            ([50.0, 2.5, 0.0], [73.0, 25.0, -18.0], 27.1492),
            ([50.0, 2.5, 0.0], [61.0, -5.0, 29.0], 22.8977),
            ([50.0, 2.5, 0.0], [56.0, -27.0, -3.0], 31.9030),
            ([50.0, 2.5, 0.0], [58.0, 24.0, 15.0], 19.4535),
            ([60.2574, -34.0099, 36.2677], [60.4626, -34.1751, 39.4387], 1.2644),
            ([6.7747, -0.2908, -2.4247], [5.8714, -0.0985, -2.2286], 0.6377),
            ([2.0776, 0.0795, -1.1350], [0.9033, -0.0636, -0.5514], 0.9082),
        ];
        for (a, b, published) in pairs {
            assert!((between(a, b) - published).abs() < 5e-5, "{a:?} {b:?}");
            assert!((between(b, a) - published).abs() < 5e-5, "{b:?} {a:?}");
        }
    }

    #[test]
    fn lightness_runs_from_black_to_white() {
        assert!(lightness(Colour::BLACK).abs() < 1e-9);
        assert!((lightness(Colour::WHITE) - 100.0).abs() < 1e-4);
        // Red, from published tables of sRGB.
        let [l, a, b] = lab(Colour::hex(0xff0000));
        assert!((l - 53.24).abs() < 0.01 && (a - 80.09).abs() < 0.02 && (b - 67.20).abs() < 0.02);
        assert!(
            (difference(Colour::BLACK, Colour::WHITE) - 100.0).abs() < 0.01,
            "{}",
            difference(Colour::BLACK, Colour::WHITE)
        );
    }

    #[test]
    fn greys_look_the_same_with_every_colour_vision_and_a_grey_print_keeps_the_lightness() {
        use Sight::{Deuteranopia, Full, Grey, Protanopia, Tritanopia};
        for value in [0, 40, 128, 200, 255] {
            let grey = Colour([value; 3]);
            for sight in [Full, Protanopia, Deuteranopia, Tritanopia, Grey] {
                assert_eq!(seen(grey, sight), grey, "{sight:?}");
            }
        }
        for value in [0xd55e00, 0x0072b2, 0xf0e442, 0x123456] {
            let colour = Colour::hex(value);
            let grey = seen(colour, Grey);
            assert!(grey.0[0] == grey.0[1] && grey.0[1] == grey.0[2]);
            assert!((lightness(grey) - lightness(colour)).abs() < 0.3);
        }
    }
}
