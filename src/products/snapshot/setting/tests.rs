//! Tests of the settings of snapshots.

use super::*;

#[test]
fn every_problem_is_reported_with_its_position() {
    let text =
        "layers = []\nwidths = [640, 640, -3, 1.5]\nthemes = \"dark\"\ndigits = 99\n\nignore = [1]\ncolour = 1\n";
    let described = Settings::read(text).expect_err("wrong");
    let places: Vec<&str> = described.iter().filter_map(|t| t.split(": ").next()).collect();
    assert_eq!(places, ["1:10", "2:10", "2:21", "2:25", "3:10", "4:10", "6:11", "7:1"], "{described:#?}");
    assert!(Settings::read("kinds = [\"forces\"").expect_err("cut")[0].contains("not TOML"));
    assert_eq!(Settings::read(""), Ok(Settings::default()));
}

#[test]
fn a_star_matches_any_characters() {
    for (pattern, name) in [("*", ""), ("a*", "abc"), ("*c", "abc"), ("a*c*e", "abcde"), ("abc", "abc"), ("a*a", "aa")]
    {
        assert!(matches_pattern(pattern, name), "{pattern} {name}");
    }
    for (pattern, name) in [("a", "ab"), ("a*a", "a"), ("b*", "ab"), ("a*c", "acd"), ("", "a")] {
        assert!(!matches_pattern(pattern, name), "{pattern} {name}");
    }
}
