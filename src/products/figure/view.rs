//! [`View`]: what a figure shows, by one name: a kind, such as `mechanism`, or a kind with what it shows of a structure,
//! such as `mechanism-tilt`. It also knows the names that kinds of figures had in the last version.

use super::kind::Kind;
use super::option::{At, Options};
use crate::mechanics::analysis::MarginKind;
use crate::text::Word;

/// A kind of figure, and what it shows of a structure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct View {
    /// The kind of figure.
    pub kind: Kind,
    /// The motion that a figure of a mechanism shows; `None` for the fall of what does not stand.
    pub at: Option<At>,
    name: &'static str,
    /// What to write instead of a name of the last version; empty for a present name.
    now: &'static str,
    with_polygon: bool,
    /// Whether the analysis has to find out which blocks may leave.
    removable: bool,
}

const fn view(name: &'static str, kind: Kind) -> View {
    View { name, kind, at: None, now: "", with_polygon: false, removable: false }
}

const fn moved(name: &'static str, at: At) -> View {
    View { at: Some(at), ..view(name, Kind::Mechanism) }
}

const fn old(name: &'static str, view: View, now: &'static str) -> View {
    View { name, now, ..view }
}

/// The views that are more than a kind, and the names of the last version.
const NAMED: [View; 18] = [
    moved("mechanism-tilt", At::Margin(MarginKind::Tilt)),
    moved("mechanism-load-factor", At::Margin(MarginKind::LoadFactor)),
    moved("mechanism-horizontal-load", At::Margin(MarginKind::HorizontalLoad)),
    moved("mechanism-friction", At::Margin(MarginKind::Friction)),
    moved("mechanism-friction-factor", At::Margin(MarginKind::FrictionFactor)),
    moved("mechanism-movement", At::Movement),
    moved("mechanism-placement", At::Placement),
    moved("mechanism-vehicle", At::Vehicle),
    View { with_polygon: true, ..view("thrust-with-polygon", Kind::Thrust) },
    View { removable: true, ..view("structure-removable", Kind::Structure) },
    old("margin", moved("", At::Margin(MarginKind::Tilt)), "--kind mechanism --at tilt, or another margin"),
    old("movement", moved("", At::Movement), "--kind mechanism --at movement"),
    old("placement", moved("", At::Placement), "--kind mechanism --at placement"),
    old("influence", moved("", At::Vehicle), "--kind mechanism --at vehicle"),
    old("polygon", View { with_polygon: true, ..view("", Kind::Thrust) }, "--kind thrust --with-polygon"),
    old("removable", View { removable: true, ..view("", Kind::Structure) }, "--kind structure --removable"),
    old("kernel", view("joints", Kind::Joints), "--kind joints"),
    old("utilisation", view("joints", Kind::Joints), "--kind joints"),
];

impl View {
    /// Returns the view with this name: that of a kind, of a kind with what it shows, or of the last version. `None` if
    /// there is no such name.
    pub fn from_name(name: &str) -> Option<View> {
        View::from_word(name)
    }

    /// Returns the present name, such as `mechanism-tilt`.
    pub fn name(self) -> &'static str {
        let shown = |view: View| (view.kind, view.at, view.with_polygon, view.removable);
        let same = View::all().into_iter().find(|view| view.now.is_empty() && shown(*view) == shown(self));
        same.map_or(self.name, |view| view.name)
    }

    /// Returns what to write instead, if the name is that of the last version.
    pub fn note(self) -> Option<String> {
        let words = || format!("--kind {} is now {}; the next version does not know the old name", self.name, self.now);
        (!self.now.is_empty()).then(words)
    }

    /// Whether the analysis has to find out which blocks may leave.
    pub(crate) fn needs_removable(self) -> bool {
        self.removable
    }

    /// Returns the options with what the view shows.
    pub fn options(self, options: &Options) -> Options {
        Options {
            at: options.at.or(self.at),
            with_polygon: options.with_polygon || self.with_polygon,
            ..options.clone()
        }
    }
}

impl Default for View {
    fn default() -> View {
        Kind::default().into()
    }
}

impl From<Kind> for View {
    fn from(kind: Kind) -> View {
        view(kind.name(), kind)
    }
}

impl Word for View {
    fn all() -> Vec<View> {
        Kind::ALL.into_iter().map(View::from).chain(NAMED).collect()
    }

    fn word(self) -> &'static str {
        self.name
    }

    fn help(self) -> &'static str {
        self.kind.help()
    }

    fn is_hidden(self) -> bool {
        self.name != self.kind.name()
    }
}
