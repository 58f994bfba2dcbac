//! How far apart the colours of each theme are that can meet, and style files that are right and wrong.

use super::super::difference::{Sight, contrast, difference, lightness, seen};
use super::super::ramp;
use super::format::Notation;
use super::*;

/// Least distances of a theme's colours that can meet.
#[derive(Clone, Copy, Debug)]
struct LeastDistances {
    /// Arrows of blocks placed one after the other.
    neighbours: f64,
    /// A force's arrow and a robot's.
    robots: f64,
    /// What fails and any other arrow.
    failure: f64,
    /// An arrow, or its seam where that is farther, and whatever can lie below it.
    ground: f64,
    /// Letters and what can lie below them.
    letters: f64,
}

impl LeastDistances {
    fn all(self) -> [f64; 5] {
        [
            self.neighbours,
            self.robots,
            self.failure,
            self.ground,
            self.letters,
        ]
    }
}

/// The least distances of a theme as eyes of this sort see it, by ΔE or, in grey, by lightness.
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
        neighbours: closest(
            &mut (0..arrows.len()).map(|i| apart(theme.arrow(i), theme.arrow(i + 1))),
        ),
        robots: closest(
            &mut arrows
                .iter()
                .flat_map(|a| robots.iter().map(move |r| apart(*a, *r))),
        ),
        failure: closest(&mut moving().map(|a| apart(failure, a))),
        ground: closest(
            &mut moving().chain([failure]).flat_map(|a| {
                below().map(move |b| apart(a, b).max(apart(theme.casing_on(b, a), b)))
            }),
        ),
        letters: closest(&mut below().map(|b| apart(theme.letters_on(b, None), b))),
    }
}

/// The least of several sights, one by one.
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
const ALL: &[Sight] = &[
    Sight::Full,
    Sight::Protanopia,
    Sight::Deuteranopia,
    Sight::Tritanopia,
];

/// The numbers of the table at [`Theme`], which this keeps true: a colour that is changed changes them, for better or worse.
#[test]
fn colours_that_can_meet_are_as_far_apart_as_told() {
    let described = [
        (Theme::thesis(), FULL, [13.1, 24.9, 35.5, 33.1, 38.8]),
        (
            Theme::paper(),
            &[Sight::Grey][..],
            [14.7, 35.5, 17.0, 36.9, 44.1],
        ),
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

/// What the themes are for, in plain bounds: a grey print of `paper` and any eyes on `colourblind` tell everything apart.
#[test]
fn the_themes_keep_what_they_promise() {
    for theme in [Theme::paper(), Theme::colourblind(), Theme::dark()] {
        assert!(
            least_of(&theme, FULL).iter().all(|d| *d > 15.0),
            "{theme:?}"
        );
    }
    for (theme, sights) in [
        (Theme::paper(), &[Sight::Grey][..]),
        (Theme::colourblind(), ALL),
    ] {
        assert!(
            least_of(&theme, sights).iter().all(|d| *d > 12.0),
            "{theme:?}"
        );
    }
    // The measure sees what is wrong: the source's red is one of its greens in grey.
    let printed = Theme {
        failure: Colour::hex(0xff0000),
        ..Theme::thesis()
    };
    assert!(least(&printed, Sight::Grey).failure < 0.5);
    assert!(least(&Theme::thesis(), Sight::Grey).failure > 12.0);
    // Robots beside each other too, and arrows that read as black on the page of `paper`.
    let paper = Theme::paper();
    assert!((lightness(paper.robot(0)) - lightness(paper.robot(1))).abs() > 13.0);
    assert!(paper.arrows.iter().all(|a| lightness(*a) < 35.0));
    let ends = [0, 255].map(|i| lightness(paper.amplitudes[i]));
    assert!(
        (ends[0] - 95.0).abs() < 1.0 && (ends[1] - 35.0).abs() < 1.0,
        "{ends:?}"
    );
}

#[test]
fn more_is_darker_on_a_light_page_and_lighter_on_a_dark_one() {
    for name in Theme::NAMES {
        let theme = Theme::named(name).expect(name);
        let towards = (lightness(theme.ink) - lightness(theme.page)).signum();
        for pair in theme.amplitudes.windows(2) {
            // Half a step of a channel is rounding.
            let step = towards * (lightness(pair[1]) - lightness(pair[0]));
            assert!(step > -0.4, "{name}: {pair:?}");
        }
        let whole = lightness(theme.amplitudes[255]) - lightness(theme.amplitudes[0]);
        assert!(towards * whole > 50.0, "{name}: {whole}");
        // The mark of what falls is told from that of what stands in a grey print.
        let marks = lightness(theme.stands) - lightness(theme.falls);
        assert!(marks.abs() > 10.0, "{name}: {marks}");
        assert!(
            theme
                .arrows
                .iter()
                .all(|a| difference(*a, theme.load) > 15.0),
            "{name}"
        );
    }
}

#[test]
fn letters_are_legible_on_whatever_they_can_lie_on() {
    for name in Theme::NAMES {
        let theme = Theme::named(name).expect(name);
        let plain = [theme.page, theme.ground, theme.block];
        let motion = theme.page.mixed(theme.motion, 0.38);
        let below = theme.amplitudes.iter().chain(&plain).chain([&motion]);
        let of = || {
            theme
                .arrows
                .iter()
                .chain(&theme.robots)
                .chain([&theme.failure, &theme.load])
        };
        for below in below.copied().chain(ramp::named("plasma").expect("known")) {
            for of in of().map(|c| Some(*c)).chain([None]) {
                let reads = contrast(theme.letters_on(below, of), below);
                assert!(reads >= 4.5, "{name}: {reads} on {}", below.css());
            }
        }
        for words in [
            theme.ink,
            theme.faint,
            theme.stands,
            theme.falls,
            theme.undecided,
        ] {
            let reads = contrast(words, theme.page);
            assert!(reads >= 4.5, "{name}: {reads} of {}", words.css());
        }
    }
    // The measure sees letters that do not read.
    assert!(contrast(Colour::hex(0x999999), Colour::WHITE) < 4.5);
}

#[test]
fn what_stands_and_what_falls_can_be_read_on_every_page() {
    for name in Theme::NAMES {
        let theme = Theme::named(name).expect(name);
        for mark in [
            theme.stands,
            theme.falls,
            theme.undecided,
            theme.ink,
            theme.faint,
        ] {
            let contrast = (lightness(mark) - lightness(theme.page)).abs();
            assert!(contrast > 50.0, "{name}: {} {contrast}", mark.css());
        }
    }
}

#[test]
fn every_theme_reads_back_from_what_is_written_of_it() {
    for name in Theme::NAMES {
        let theme = Theme::named(name).expect(name);
        let text = theme.to_json();
        assert_eq!(
            Theme::read(&text, Notation::Json, None),
            Ok(theme.clone()),
            "{text}"
        );
        // Everything is reported: the theme it is read upon makes no difference.
        for base in Theme::NAMES {
            let base = Theme::named(base);
            assert_eq!(
                Theme::read(&text, Notation::Json, base.as_ref()),
                Ok(theme.clone())
            );
        }
        assert!(text.len() < 2000, "{text}");
    }
    let own = Theme {
        failure: Colour::hex(0x123456),
        sizes: Sizes {
            caption: 11.25,
            ..Sizes::DEFAULT
        },
        ..Theme::dark()
    };
    let text = own.to_json();
    assert!(!text.contains("theme"), "{text}");
    assert_eq!(Theme::read(&text, Notation::Json, None), Ok(own));
}

#[test]
fn a_file_changes_what_it_tells_and_nothing_else() {
    let json = r##"{ "theme": "paper", "failure": "#d00", "robots": ["#abcdef"], "amplitudes": ["#000", "#ffffff"],
        "widths": { "casing": 0, "force": 0.08 }, "sizes": { "title": 30 } }"##;
    let toml = "theme = \"paper\"\nfailure = '#d00'\nrobots = ['#abcdef'] # one\namplitudes = ['#000', '#ffffff']\n\
        widths.casing = 0\nwidths.force = 0.08\n[sizes]\ntitle = 30.0\n";
    let expected = Theme {
        failure: Colour::hex(0xdd0000),
        robots: vec![Colour::hex(0xabcdef)],
        amplitudes: ramp::between(&[Colour::BLACK, Colour::WHITE]),
        widths: Widths {
            casing: 0.0,
            force: 0.08,
            ..Widths::DEFAULT
        },
        sizes: Sizes {
            title: 30.0,
            ..Sizes::DEFAULT
        },
        ..Theme::paper()
    };
    for (text, notation) in [(json, Notation::Json), (toml, Notation::Toml)] {
        assert_eq!(Theme::read(text, notation, None), Ok(expected.clone()));
    }
    // A theme that is asked for goes before the one that the file names.
    let dark = Theme::read(json, Notation::Json, Some(&Theme::dark())).expect("sound");
    assert_eq!(
        (dark.page, dark.failure),
        (Theme::dark().page, expected.failure)
    );
    let grey = Theme::read("amplitudes = 'viridis'", Notation::Toml, None).expect("sound");
    assert_eq!(Some(grey.amplitudes), ramp::named("viridis"));
    assert_eq!(Theme::read("{}", Notation::Json, None), Ok(Theme::thesis()));
}

#[test]
fn all_that_is_wrong_is_told_at_once_with_its_place() {
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
        "the nearest is dark",
        "the nearest known key is `failure`",
        "the text \"white\" is not a colour",
        "the number 7 is not a colour",
        "the nearest is viridis",
        "the nearest known key is `force`",
        "the number 0 cannot be drawn",
        "from 0.005 to 0.5",
        "given twice",
    ] {
        assert!(described.contains(words), "{words}\n{described}");
    }
}

#[test]
fn texts_that_are_no_style_are_refused_in_words() {
    for (text, notation, words) in [
        ("{ \"page\": }", Notation::Json, "line 1"),
        ("a = 1\nb = ", Notation::Toml, "line 2"),
        ("[]", Notation::Json, "not a style"),
        ("", Notation::Json, "not JSON"),
        ("ink = 2020-01-01", Notation::Toml, "not a colour"),
        ("[widths]\nforce = nan", Notation::Toml, "cannot be drawn"),
        (
            "{ \"sizes\": { \"key\": 1e999 } }",
            Notation::Json,
            "not JSON",
        ),
    ] {
        let described = Theme::read(text, notation, None)
            .expect_err(text)
            .to_string();
        assert!(described.contains(words), "{text}: {described}");
    }
    let deep = "[".repeat(100_000);
    assert!(Theme::read(&deep, Notation::Json, None).is_err());
    assert!(Theme::read(&format!("a = {deep}"), Notation::Toml, None).is_err());
}
