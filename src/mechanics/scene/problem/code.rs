//! [`Code`]: the kinds of problems. Each kind has a fixed word, so that programs can sort or count problems.

/// Declares an enum of codes, each with its word and its meaning.
macro_rules! codes {
    ($(#[$doc:meta])* $name:ident; $($variant:ident $word:literal $meaning:literal,)*) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[non_exhaustive]
        pub enum $name {
            $(#[doc = $meaning] $variant,)*
        }

        impl $name {
            /// Every code, in the order of the documentation.
            pub const ALL: &'static [$name] = &[$($name::$variant),*];

            /// Returns the fixed word that stands for the code in JSON.
            pub fn word(self) -> &'static str {
                match self {
                    $($name::$variant => $word,)*
                }
            }

            /// Returns a short description of what the code means.
            pub fn meaning(self) -> &'static str {
                match self {
                    $($name::$variant => $meaning,)*
                }
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(self.word())
            }
        }
    };
}
pub(in crate::mechanics::scene) use codes;

codes! {
    /// The kind of a problem. Later versions may add codes, but the word of a code never changes.
    Code;
    NotReadable "not_readable" "the file cannot be read; the message gives the system's reason",
    InternalFault "internal_fault" "an internal error of the program occurred on this scene",
    NoSuchFrame "no_such_frame" "`--frame` names a frame that the scene does not have",
    NotUtf8 "not_utf8" "the bytes are not UTF-8 text",
    EmptyFile "empty_file" "the file is empty or contains only white space",
    EndsEarly "ends_early" "the text ends before its brackets or quotes are closed",
    NestedTooDeep "nested_too_deep" "more than 127 brackets are open at once",
    OtherFormat "other_format" "the text is written in another format, such as YAML, TOML or XML",
    NotJson "not_json" "the text is not valid JSON",
    WrongType "wrong_type" "the value has the wrong type, such as a string where a number is expected",
    WrongLength "wrong_length" "a list has too many or too few entries, such as a point with three coordinates",
    UnknownKey "unknown_key" "the format has no such key in this object",
    DuplicateKey "duplicate_key" "a key occurs twice in one object",
    MissingKey "missing_key" "a required key is missing",
    UnknownChoice "unknown_choice" "a word is not an allowed value, or a contact is between a body and itself",
    UnknownVersion "unknown_version" "the version of the scene format is not known",
    NotFinite "not_finite" "a number is infinite or not a number",
    TooLarge "too_large" "a number, a weight or a lattice coordinate is too large",
    TooSmall "too_small" "a number or an extent is not 0, but too small to calculate with",
    Negative "negative" "a number that must be at least 0 is negative",
    OutOfRange "out_of_range" "the kernel is not between 0 and 1, an angle of friction is not between −90 and 90 degrees, or the edge length of the grid cells is 0 or negative",
    NoColour "no_colour" "a fill is not a colour",
    UnknownName "unknown_name" "no block, robot, material, shape or load has this name",
    DuplicateId "duplicate_id" "two blocks, robots, loads or cases have the same id",
    EmptyId "empty_id" "an id is an empty string",
    ReservedName "reserved_name" "the name is reserved for the ground or for a built-in shape",
    DuplicatePair "duplicate_pair" "a pair of materials has two friction coefficients",
    NoOutline "no_outline" "a body or shape has no outline",
    TwoOutlines "two_outlines" "two keys that exclude each other are given: two of `polygon`, `cells`, `circle` and `shape`, without an outline, `centre` with `at` or `angle`; `pressure` with `force`, `at` or `torque`; `side` with `between`",
    NoEdge "no_edge" "a pressure acts on no edge of a block: the block has no such side, or the points do not lie on one free outline",
    HolesWithoutPolygon "holes_without_polygon" "`holes` are given without a `polygon`",
    TooFewCorners "too_few_corners" "an outline has fewer than three different corners",
    ZeroArea "zero_area" "an outline encloses no area",
    CrossingOutline "crossing_outline" "an outline crosses or touches itself",
    HoleOutside "hole_outside" "a hole does not lie inside its outline, or lies in another hole",
    NeedsGrid "needs_grid" "cells or built-in shapes are used, but the scene does not have the grid that they need",
    WrongCell "wrong_cell" "a cell is written in the notation of the other kind of grid",
    DuplicateCell "duplicate_cell" "a cell is listed twice",
    CellsApart "cells_apart" "the cells of a body are not all connected by common edges",
    OffLattice "off_lattice" "a coordinate or an angle does not fit the lattice",
    Overlap "overlap" "two bodies that are present at the same time overlap",
    TooManyCorners "too_many_corners" "the shapes of all bodies have too many corners in total",
    TooManyPairs "too_many_pairs" "too many bodies lie so close to others that they may touch, such as equal parts of the ground",
    TooManySteps "too_many_steps" "there are too many steps or blocks, the frames contain too many blocks in total, or the load cases too many loads",
    TooManyTips "too_many_tips" "in a scene with `corner_contacts`, corners of too many blocks and ground polygons meet at one point",
    PlacedTwice "placed_twice" "a block is placed or planned although it is already placed",
    NotPlaced "not_placed" "a block is removed or held although it is not placed",
    RemovedWhileHeld "removed_while_held" "a block is removed while a robot holds it",
    HoldsTwo "holds_two" "a robot that still holds a block takes hold of another block",
    MoreProblems "more_problems" "there are more problems than the list contains",
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_has_a_word_of_its_own() {
        let mut words: Vec<&str> = Code::ALL.iter().map(|c| c.word()).collect();
        assert!(
            (words.iter()).all(|w| { w.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'_') })
        );
        words.sort_unstable();
        words.dedup();
        assert_eq!(words.len(), Code::ALL.len());
    }
}
