//! Remarks about elements of an SVG, with a limit for each kind.

use roxmltree::Node;

use super::walk::{Context, Walk};

/// At most this many remarks of one kind are listed; the others are counted.
pub(super) const MAX_LISTED: usize = 20;

/// The kind of a remark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum RemarkKind {
    Skipped,
    TooDeep,
    TooManyElements,
    ClipPath,
    Mask,
    Text,
    Image,
    MissingCopy,
    Gradient,
    BadFill,
    BadTransform,
    BrokenOutline,
    Unknown,
}

impl RemarkKind {
    /// The plural for a summary; `None` for elements that the user asked to leave out.
    fn plural(self) -> Option<&'static str> {
        Some(match self {
            RemarkKind::Skipped => return None,
            RemarkKind::TooDeep => "groups that are nested too deep",
            RemarkKind::TooManyElements => "elements beyond the limit",
            RemarkKind::ClipPath => "clip paths",
            RemarkKind::Mask => "masks",
            RemarkKind::Text => "texts",
            RemarkKind::Image => "images",
            RemarkKind::MissingCopy => "copies of elements that do not exist",
            RemarkKind::Gradient => "gradients and patterns",
            RemarkKind::BadFill => "fills that are not valid colours",
            RemarkKind::BadTransform => "transforms that cannot be read",
            RemarkKind::BrokenOutline => "outlines that cannot be read",
            RemarkKind::Unknown => "unknown elements",
        })
    }
}

impl<'a, 'd> Walk<'a, 'd> {
    /// Notes that an element is left out, and why.
    pub(super) fn skip(&mut self, node: Node<'a, 'd>, around: &Context, why: &str) {
        let times = self.remarked.entry(RemarkKind::Skipped).or_default();
        *times += 1;
        if *times <= MAX_LISTED {
            let note = format!("{} is left out: {why}", self.element_label(node, around));
            self.draft.notes.push(note);
        }
    }

    /// Adds a remark about an element.
    pub(super) fn remark(
        &mut self,
        kind: RemarkKind,
        node: Node<'a, 'd>,
        around: &Context,
        message: &str,
        help: &str,
    ) {
        let times = self.remarked.entry(kind).or_default();
        *times += 1;
        if *times <= MAX_LISTED {
            let element = self.element_label(node, around);
            self.draft.remark(element, message, help);
        }
    }

    /// Adds a remark with the number of unlisted remarks of each kind.
    pub(super) fn count_unlisted(&mut self) {
        for (kind, times) in &self.remarked {
            let Some(more) = times.checked_sub(MAX_LISTED).filter(|more| *more > 0) else {
                continue;
            };
            match kind.plural() {
                None => {
                    let note = format!("{more} more elements are left out for the same reasons");
                    self.draft.notes.push(note);
                }
                Some(plural) => self.draft.remark("", format!("{more} more {plural}"), ""),
            }
        }
    }
}
