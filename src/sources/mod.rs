//! Other ways to a scene file than writing it: from a drawing, or from a few measures.

#[cfg(feature = "import")]
pub mod import;

pub mod starter;
