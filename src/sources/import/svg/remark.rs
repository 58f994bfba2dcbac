//! The kinds of remarks about SVG elements. Of each kind, only the first 20 remarks are listed, and the others are
//! counted.

/// At most this many remarks of one kind are listed; the others are counted.
pub(super) const MAX_LISTED_REMARKS: usize = 20;

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
    /// Returns the plural noun with which a summary counts the remarks of this kind. `None` for elements that are
    /// hidden or that are ignored because of their names.
    pub(super) fn plural(self) -> Option<&'static str> {
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
