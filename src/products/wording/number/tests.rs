//! Tests of printed numbers and units.

use super::*;

#[test]
fn quantities_have_three_significant_digits_and_a_prefix() {
    let cases = [
        (0.0, "0 N"),
        (24.0, "24 N"),
        (43.372, "43.4 N"),
        (433.72, "434 N"),
        (999.7, "1 kN"),
        (-12_000.0, "−12 kN"),
        (0.000_25, "250 µN"),
        (0.1348, "0.135 N"),
        (0.0123, "0.0123 N"),
        (0.00456, "4.56 mN"),
        (9.995e5, "1 MN"),
        (4.125 - 1e-9, "4.13 N"),
        (4.125 + 1e-9, "4.13 N"),
        (1e-9, "1 nN"),
        (2.5e14, "2.5×10¹⁴ N"),
        (3e-15, "3×10⁻¹⁵ N"),
    ];
    for (value, expected) in cases {
        assert_eq!(quantity(value, "N"), expected);
    }
}

#[test]
fn a_chosen_unit_has_no_prefix() {
    use crate::mechanics::scene::format::{ForceUnit, LengthUnit};
    let units = UnitsEntry::default().of_length(LengthUnit::Millimetre).of_force(ForceUnit::Kilonewton);
    let cases = [
        (2400.0, units.force(), "2.4 kN"),
        (-2.4, units.force(), "−0.0024 kN"),
        (0.012_345, units.force(), "1.23×10⁻⁵ kN"),
        (12.3456, units.length(), "12300 mm"),
        (0.0, units.length(), "0 mm"),
        (2.5e6, units.stress(), "0.0025 kN/mm²"),
        (3.0, units.torque(), "3 kN·mm"),
    ];
    for (value, unit, expected) in cases {
        assert_eq!(quantity(value, unit), expected);
    }
    assert_eq!(place(Point::new(0.25, -1.0), units), "(250, -1000) mm");
    assert_eq!(round_below_in(7.0, units.length()), 5.0);
    assert_eq!(amount(1500.0, units.force()), "1.5 kN");
}

#[test]
fn a_column_has_one_prefix() {
    assert_eq!(prefixed(184_439.0, "N"), ("kN".to_owned(), 1e-3));
    assert_eq!(prefixed(60.0, "N"), ("N".to_owned(), 1.0));
}

#[test]
fn only_full_utilisation_is_written_as_100_percent() {
    let plain = |share: f64| percent(share).replace(NO_BREAK, " ");
    assert_eq!(plain(1.0 - 1e-9), "100 %");
    assert_eq!(plain(0.9999), "over 99 %");
    assert_eq!(plain(0.974), "97 %");
    assert_eq!(plain(1e-4), "under 1 %");
    assert_eq!((plain(0.0), plain(1e-12)), ("0 %".into(), "0 %".into()));
}

#[test]
fn directions_are_measured_anticlockwise_from_the_x_axis() {
    assert_eq!(force(Vector::new(0.0, -6.0), UnitsEntry::default()), "6 N at 270°");
    assert_eq!(force(Vector::new(3.0, 3.0), UnitsEntry::default()), "4.24 N at 45°");
    assert_eq!(force(Vector::new(1.0, -1e-9), UnitsEntry::default()), "1 N at 0°");
}

#[test]
fn round_numbers_are_never_above_the_value() {
    for (value, expected) in [(9.99, 5.0), (5.0, 5.0), (4.9, 2.0), (0.013, 0.01), (1e9, 1e9), (0.0, 0.0)] {
        assert_eq!(round_below(value), expected);
    }
    assert_eq!((letter(0), letter(25), letter(26)), ("a".into(), "z".into(), "aa".into()));
    assert_eq!(listed(&["a".into(), "b".into(), "c".into()]), "a, b and c");
}

#[test]
fn ends_of_margins_are_rounded_to_the_safe_side_and_keep_their_exponents() {
    assert_eq!([three_down(2.4999), three_up(2.4921), three_down(2.5)], ["2.49", "2.5", "2.5"]);
    assert_eq!([three_down(1_032_587.2), three_up(1_032_587.2)], ["1.032×10⁶", "1.033×10⁶"]);
    assert_eq!([three_down(1e10), three_up(2e20)], ["1×10¹⁰", "2×10²⁰"]);
}

#[test]
fn numbers_are_short_and_keep_four_digits() {
    let cases = [
        (0.0, "0"),
        (-0.0, "0"),
        (43.371_94, "43.37"),
        (24.0, "24"),
        (1234.56, "1235"),
        (-0.5, "-0.5"),
        (0.054_12, "0.05412"),
        (0.001_234_56, "0.001235"),
        (9.999_99, "10"),
        (123_456.0, "123456"),
        (1e9, "1×10⁹"),
        (1e-6, "1×10⁻⁶"),
        (f64::INFINITY, "inf"),
    ];
    for (x, text) in cases {
        assert_eq!(digits(x), text, "{x}");
    }
}
