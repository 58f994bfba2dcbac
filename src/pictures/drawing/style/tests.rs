//! Tests of the distances between a theme's colours that can meet, and of valid and invalid style files.

use super::super::difference::{Sight, contrast, difference, lightness, seen};
use super::super::ramp;
use super::format::Notation;
use super::*;

/// The least distances between colours of a theme that can meet.
#[derive(Clone, Copy, Debug)]
struct LeastDistances {
    /// Between the arrows of blocks placed one after the other.
    neighbours: f64,
    /// Between the arrow of a force and the arrow of a robot.
    robots: f64,
    /// Between the colour of failures and any other arrow.
    failure: f64,
    /// Between an arrow and anything below it. If the distance of the casing is larger, it counts instead.
    ground: f64,
    /// Between letters and anything below them.
    letters: f64,
}

impl LeastDistances {
    fn all(self) -> [f64; 5] {
        [self.neighbours, self.robots, self.failure, self.ground, self.letters]
    }
}

/// Returns the least distances of a theme for this colour vision: ΔE, or the difference in lightness for a grey
/// print.
fn least(theme: &Theme, sight: Sight) -> LeastDistances {
    let apart = |a: Colour, b: Colour| match sight {
        Sight::Grey => (lightness(a) - lightness(b)).abs(),
        _ => difference(seen(a, sight), seen(b, sight)),
    };
    let closest = |list: &mut dyn Iterator<Item = f64>| list.fold(f64::INFINITY, f64::min);
    let (arrows, robots, failure) = (&theme.arrows, &theme.robots, theme.failure);
    let moving = || arrows.iter().chain(robots).copied();
    let below = || {
        let others = [theme.block, theme.ground, theme.page];
        theme.amplitudes.iter().copied().chain(others)
    };
    LeastDistances {
        neighbours: closest(&mut (0..arrows.len()).map(|i| apart(theme.arrow(i), theme.arrow(i + 1)))),
        robots: closest(&mut arrows.iter().flat_map(|a| robots.iter().map(move |r| apart(*a, *r)))),
        failure: closest(&mut moving().map(|a| apart(failure, a))),
        ground: closest(
            &mut moving()
                .chain([failure])
                .flat_map(|a| below().map(move |b| apart(a, b).max(apart(theme.casing_on(b, a), b)))),
        ),
        letters: closest(&mut below().map(|b| apart(theme.letters_on(b, None), b))),
    }
}

/// Returns the least value of each distance over several kinds of colour vision.
fn least_of(theme: &Theme, sights: &[Sight]) -> [f64; 5] {
    let mut all = [f64::INFINITY; 5];
    for sight in sights {
        for (so_far, now) in all.iter_mut().zip(least(theme, *sight).all()) {
            *so_far = f64::min(*so_far, now);
        }
    }
    all
}

const FULL: &[Sight] = &[Sight::Full];
const ALL: &[Sight] = &[Sight::Full, Sight::Protanopia, Sight::Deuteranopia, Sight::Tritanopia];

/// Checks the numbers in the table at [`Theme`]. A change of a colour may change them.
#[test]
fn distances_between_colours_are_those_of_the_documentation() {
    let described = [
        (Theme::thesis(), FULL, [13.1, 24.9, 35.5, 33.1, 38.8]),
        (Theme::paper(), &[Sight::Grey][..], [14.7, 35.5, 17.0, 36.9, 44.1]),
        (Theme::colourblind(), ALL, [12.1, 17.9, 12.5, 27.0, 35.7]),
        (Theme::dark(), FULL, [23.6, 17.7, 34.7, 30.0, 38.2]),
    ];
    for (theme, sights, described) in described {
        let found = least_of(&theme, sights);
        for (found, described) in found.iter().zip(described) {
            assert!((found - described).abs() < 0.051, "{found:?} {theme:?}");
        }
    }
}

/// Checks simple bounds: all colours differ in a grey print of `paper`, and for every kind of colour vision with
/// `colourblind`.
#[test]
fn colours_that_can_meet_differ_clearly_in_each_theme() {
    for theme in [Theme::paper(), Theme::colourblind(), Theme::dark()] {
        assert!(least_of(&theme, FULL).iter().all(|d| *d > 15.0), "{theme:?}");
    }
    for (theme, sights) in [(Theme::paper(), &[Sight::Grey][..]), (Theme::colourblind(), ALL)] {
        assert!(least_of(&theme, sights).iter().all(|d| *d > 12.0), "{theme:?}");
    }
    // The distances show a bad theme: pure red has the same lightness as one of the greens of the thesis.
    let printed = Theme { failure: Colour::hex(0xff0000), ..Theme::thesis() };
    assert!(least(&printed, Sight::Grey).failure < 0.5);
    assert!(least(&Theme::thesis(), Sight::Grey).failure > 12.0);
    // Two robots next to each other differ too, and the arrows appear black on the page of `paper`.
    let paper = Theme::paper();
    assert!((lightness(paper.robot(0)) - lightness(paper.robot(1))).abs() > 13.0);
    assert!(paper.arrows.iter().all(|a| lightness(*a) < 35.0));
    let ends = [0, 255].map(|i| lightness(paper.amplitudes[i]));
    assert!((ends[0] - 95.0).abs() < 1.0 && (ends[1] - 35.0).abs() < 1.0, "{ends:?}");
}

#[test]
fn larger_amplitudes_are_darker_on_a_light_page_and_lighter_on_a_dark_page() {
    for name in Theme::NAMES {
        let theme = Theme::named(name).expect(name);
        let towards = (lightness(theme.ink) - lightness(theme.page)).signum();
        for pair in theme.amplitudes.windows(2) {
            // The rounding of the channels may reverse the lightness by up to 0.4.
            let step = towards * (lightness(pair[1]) - lightness(pair[0]));
            assert!(step > -0.4, "{name}: {pair:?}");
        }
        let range = lightness(theme.amplitudes[255]) - lightness(theme.amplitudes[0]);
        assert!(towards * range > 50.0, "{name}: {range}");
        // In a grey print, the mark of unstable blocks differs from the mark of stable blocks.
        let marks = lightness(theme.stands) - lightness(theme.falls);
        assert!(marks.abs() > 10.0, "{name}: {marks}");
        assert!(theme.arrows.iter().all(|a| difference(*a, theme.load) > 15.0), "{name}");
    }
}

#[test]
fn letters_are_legible_on_every_possible_background() {
    for name in Theme::NAMES {
        let theme = Theme::named(name).expect(name);
        let plain = [theme.page, theme.ground, theme.block];
        let motion = theme.page.mixed(theme.motion, 0.38);
        let below = theme.amplitudes.iter().chain(&plain).chain([&motion]);
        let of = || theme.arrows.iter().chain(&theme.robots).chain([&theme.failure, &theme.load]);
        for below in below.copied().chain(ramp::named("plasma").expect("known")) {
            for of in of().map(|c| Some(*c)).chain([None]) {
                let reads = contrast(theme.letters_on(below, of), below);
                assert!(reads >= 4.5, "{name}: {reads} on {}", below.css());
            }
        }
        for words in [theme.ink, theme.faint, theme.stands, theme.falls, theme.undecided] {
            let reads = contrast(words, theme.page);
            assert!(reads >= 4.5, "{name}: {reads} of {}", words.css());
        }
    }
    // Letters that are hard to read have a lower contrast.
    assert!(contrast(Colour::hex(0x999999), Colour::WHITE) < 4.5);
}

#[test]
fn the_marks_of_verdicts_are_legible_on_every_page() {
    for name in Theme::NAMES {
        let theme = Theme::named(name).expect(name);
        for mark in [theme.stands, theme.falls, theme.undecided, theme.ink, theme.faint] {
            let contrast = (lightness(mark) - lightness(theme.page)).abs();
            assert!(contrast > 50.0, "{name}: {} {contrast}", mark.css());
        }
    }
}

#[test]
fn every_theme_can_be_written_and_read_again() {
    for name in Theme::NAMES {
        let theme = Theme::named(name).expect(name);
        let text = theme.to_json();
        assert_eq!(Theme::read(&text, Notation::Json, None), Ok(theme.clone()), "{text}");
        // The file contains every value, so the base theme has no influence.
        for base in Theme::NAMES {
            let base = Theme::named(base);
            assert_eq!(Theme::read(&text, Notation::Json, base.as_ref()), Ok(theme.clone()));
        }
        assert!(text.len() < 2000, "{text}");
    }
    let own =
        Theme { failure: Colour::hex(0x123456), sizes: Sizes { caption: 11.25, ..Sizes::PLAIN }, ..Theme::dark() };
    let text = own.to_json();
    assert!(!text.contains("theme"), "{text}");
    assert_eq!(Theme::read(&text, Notation::Json, None), Ok(own));
}

#[test]
fn a_style_file_changes_only_the_values_it_contains() {
    let json = r##"{ "theme": "paper", "failure": "#d00", "robots": ["#abcdef"], "amplitudes": ["#000", "#ffffff"],
        "widths": { "casing": 0, "force": 0.08 }, "sizes": { "title": 30 } }"##;
    let toml = "theme = \"paper\"\nfailure = '#d00'\nrobots = ['#abcdef'] # one\namplitudes = ['#000', '#ffffff']\n\
        widths.casing = 0\nwidths.force = 0.08\n[sizes]\ntitle = 30.0\n";
    let expected = Theme {
        failure: Colour::hex(0xdd0000),
        robots: vec![Colour::hex(0xabcdef)],
        amplitudes: ramp::between(&[Colour::BLACK, Colour::WHITE]),
        widths: Widths { casing: 0.0, force: 0.08, ..Widths::DEFAULT },
        sizes: Sizes { title: 30.0, ..Sizes::PLAIN },
        ..Theme::paper()
    };
    for (text, notation) in [(json, Notation::Json), (toml, Notation::Toml)] {
        assert_eq!(Theme::read(text, notation, None), Ok(expected.clone()));
    }
    // A requested theme takes precedence over the theme that the file names.
    let dark = Theme::read(json, Notation::Json, Some(&Theme::dark())).expect("valid");
    assert_eq!((dark.page, dark.failure), (Theme::dark().page, expected.failure));
    let grey = Theme::read("amplitudes = 'viridis'", Notation::Toml, None).expect("valid");
    assert_eq!(Some(grey.amplitudes), ramp::named("viridis"));
    assert_eq!(Theme::read("{}", Notation::Json, None), Ok(Theme::default()));
    let blocks = Theme::read("forces = 'blocks'", Notation::Toml, None).expect("valid");
    assert_eq!(blocks, Theme { forces: ForceMarks::Blocks, ..Theme::plain() });
}

#[test]
fn a_scene_on_a_lattice_has_another_default() {
    assert_eq!(Theme::default().for_scene(false), Theme::plain());
    assert_eq!(Theme::default().for_scene(true), Theme::thesis());
    let own = Theme { page: Colour::BLACK, ..Theme::default() };
    assert_eq!(own.for_scene(true), Theme { forces: ForceMarks::Blocks, ..own });
    assert!(Theme::NAMES.iter().filter_map(|name| Theme::named(name)).all(|theme| theme.for_scene(true) == theme));
}

#[test]
fn all_problems_of_a_style_file_are_reported_at_once_with_their_paths() {
    let text = r##"{ "theme": "drak", "failur": "#d00", "page": "white", "ink": 7, "arrows": [], "robots": ["#12", "#123456"],
        "amplitudes": "virdis", "widths": { "forec": 1, "force": 0, "robot": "thick" }, "sizes": 12, "page": "#fff" }"##;
    let problems = Theme::read(text, Notation::Json, None).expect_err("wrong");
    let paths: Vec<&str> = problems.0.iter().map(|p| p.path.as_str()).collect();
    assert_eq!(
        paths,
        [
            "theme",
            "failur",
            "page",
            "ink",
            "arrows",
            "robots[0]",
            "amplitudes",
            "widths.forec",
            "widths.force",
            "widths.robot",
            "sizes",
            "page"
        ]
    );
    let described = problems.to_string();
    for words in [
        "did you mean \"dark\"?",
        "the nearest known key is `failure`",
        "line 1, column 46, page: expected a colour such as \"#d55e00\" or \"#d50\", found the string \"white\"",
        "found the number 7",
        "did you mean \"viridis\"?",
        "the nearest known key is `force`",
        "expected a number of unit lengths from 0.005 to 0.5, found the number 0",
        "occurs twice",
    ] {
        assert!(described.contains(words), "{words}\n{described}");
    }
}

#[test]
fn texts_that_are_not_a_style_are_refused_with_a_reason() {
    for (text, notation, words) in [
        ("{ \"page\": }", Notation::Json, "line 1"),
        ("a = 1\nb = ", Notation::Toml, "line 2"),
        ("[]", Notation::Json, "expected an object"),
        ("", Notation::Json, "empty"),
        ("ink = '#fff'", Notation::Json, "must end in .toml"),
        ("{ \"ink\": 1 }", Notation::Toml, "must end in .json"),
        ("ink = 2020-01-01", Notation::Toml, "found the date 2020-01-01"),
        ("[widths]\nforce = nan", Notation::Toml, "line 2, column 9, widths.force"),
        ("{ \"sizes\": { \"key\": 1e999 } }", Notation::Json, "from 8 to 100"),
    ] {
        let described = Theme::read(text, notation, None).expect_err(text).to_string();
        assert!(described.contains(words), "{text}: {described}");
    }
    let deep = "[".repeat(100_000);
    assert!(Theme::read(&deep, Notation::Json, None).is_err());
    assert!(Theme::read(&format!("a = {deep}"), Notation::Toml, None).is_err());
}
