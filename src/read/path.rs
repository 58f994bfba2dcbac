//! [`Path`]: the position of a value in a text, such as `blocks[3].polygon[1]`.
//!
//! A [`Trail`] is a path on the stack: each step borrows the path above it, so that a valid file needs no allocation.

use std::fmt;

/// One part of a path: it leads from an object or a list to one of its values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Segment {
    /// Into an object, by key.
    Key(String),
    /// Into a list, by number from 0.
    Index(usize),
}

/// The position of a value in a text, as a list of segments that begins at the top level.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Path(pub Vec<Segment>);

/// The position of a value in a text while the text is traversed: a path that borrows the path above it.
#[derive(Clone, Copy, Debug)]
pub enum Trail<'a> {
    /// The whole text.
    Top,
    /// A key of an object.
    Key(&'a Trail<'a>, &'a str),
    /// An entry of a list.
    Index(&'a Trail<'a>, usize),
}

impl Path {
    /// True if this path equals `other`, or is the path of something inside the value at `other`.
    pub fn starts_with(&self, other: &[Segment]) -> bool {
        self.0.starts_with(other)
    }
}

impl<'a> Trail<'a> {
    /// Returns the path of the value of the key `name` in the object at this path.
    pub fn key(&'a self, name: &'a str) -> Trail<'a> {
        Trail::Key(self, name)
    }

    /// Returns the path of an entry of the list at this path. `number` is the index of the entry, counted from 0.
    pub fn index(&'a self, number: usize) -> Trail<'a> {
        Trail::Index(self, number)
    }

    /// True if the last part of the path is the key `name`.
    pub fn ends_in(&self, name: &str) -> bool {
        matches!(self, Trail::Key(_, key) if *key == name)
    }

    /// Returns the trail as an owned [`Path`].
    pub fn path(&self) -> Path {
        let mut segments = Vec::new();
        let mut here = self;
        loop {
            match here {
                Trail::Top => break,
                Trail::Key(up, name) => {
                    segments.push(Segment::Key((*name).to_string()));
                    here = up;
                }
                Trail::Index(up, number) => {
                    segments.push(Segment::Index(*number));
                    here = up;
                }
            }
        }
        segments.reverse();
        Path(segments)
    }
}

impl fmt::Display for Path {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, segment) in self.0.iter().enumerate() {
            match segment {
                Segment::Index(number) => write!(f, "[{number}]")?,
                Segment::Key(key) if !is_plain(key) => write!(f, "[{key:?}]")?,
                Segment::Key(key) if i == 0 => f.write_str(key)?,
                Segment::Key(key) => write!(f, ".{key}")?,
            }
        }
        Ok(())
    }
}

/// True if a path can contain the key after a dot without ambiguity. Other keys are written as `["key"]`.
fn is_plain(key: &str) -> bool {
    !key.is_empty() && key.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '$' | '-'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_written_with_dots_and_brackets() {
        let (top, blocks) = (Trail::Top, "blocks");
        let (a, b) = (top.key(blocks), top.key("materials"));
        let c = a.index(3);
        let d = c.key("polygon");
        assert_eq!(d.index(1).path().to_string(), "blocks[3].polygon[1]");
        assert_eq!(b.key("red oak").path().to_string(), "materials[\"red oak\"]");
        assert_eq!(Trail::Top.path().to_string(), "");
    }
}
