//! [`Colour`]: an opaque colour in sRGB, read from and written as CSS text.

/// A colour with 8 bits per channel: red, green, blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Colour(pub [u8; 3]);

impl Colour {
    /// White.
    pub const WHITE: Colour = Colour([255, 255, 255]);
    /// Black.
    pub const BLACK: Colour = Colour([0, 0, 0]);

    /// Creates the colour with the value 0xrrggbb.
    ///
    /// ```
    /// use drystone::drawing::Colour;
    /// assert_eq!(Colour::hex(0x2f4f50), Colour([47, 79, 80]));
    /// ```
    pub const fn hex(value: u32) -> Colour {
        Colour([(value >> 16) as u8, (value >> 8) as u8, value as u8])
    }

    /// Returns the colour as CSS text: `#rrggbb`.
    pub fn css(self) -> String {
        let [r, g, b] = self.0;
        format!("#{r:02x}{g:02x}{b:02x}")
    }

    /// Reads a colour in the form `#rrggbb` or `#rgb`. Returns `None` for any other text.
    ///
    /// ```
    /// use drystone::drawing::Colour;
    /// assert_eq!(Colour::from_css("#d00"), Some(Colour::hex(0xdd0000)));
    /// assert_eq!(Colour::from_css("#Dd00fF"), Some(Colour::hex(0xdd00ff)));
    /// assert_eq!(Colour::from_css("red"), None);
    /// ```
    pub fn from_css(text: &str) -> Option<Colour> {
        let digits = text.strip_prefix('#')?;
        // `from_str_radix` would accept a sign.
        if !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
            return None;
        }
        let value = u32::from_str_radix(digits, 16).ok()?;
        match digits.len() {
            6 => Some(Colour::hex(value)),
            3 => {
                let twice = |shift: u32| ((value >> shift) & 0xf) as u8 * 0x11;
                Some(Colour([twice(8), twice(4), twice(0)]))
            }
            _ => None,
        }
    }

    /// Returns a mixture of this colour and `other`; `share` (0 to 1) is the fraction of `other`.
    pub fn mixed(self, other: Colour, share: f64) -> Colour {
        let mix = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * share).round() as u8;
        let (a, b) = (self.0, other.0);
        Colour([mix(a[0], b[0]), mix(a[1], b[1]), mix(a[2], b[2])])
    }

    /// Returns the approximate brightness, from 0 (black) to 1 (white). It is the weighted mean of the sRGB channels,
    /// with the weights of Rec. 709.
    pub fn brightness(self) -> f64 {
        let [r, g, b] = self.0;
        (0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)) / 255.0
    }
}
