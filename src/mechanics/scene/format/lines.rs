//! [`Lines`]: a JSON formatter that starts a new line for each entry of the outer objects and for each object in a
//! list, so that people can read the file.

use std::io;

use serde_json::ser::Formatter;

/// A JSON formatter that writes the outer objects with one line for each entry, and each deeper object on one line.
pub(crate) struct Lines {
    /// The number of levels of objects, from the outside, whose entries are on separate lines.
    depth: usize,
    /// For every open bracket: whether it opens an array, and whether its entries are on separate lines.
    open: Vec<(bool, bool)>,
    /// The number of open objects.
    objects: usize,
}

impl Lines {
    /// Creates a formatter. Objects at the `depth` outermost levels get one line for each entry. Each object further
    /// inside is written on one line, unless it contains a list of objects.
    pub(crate) fn new(depth: usize) -> Lines {
        Lines { depth, open: Vec::new(), objects: 0 }
    }

    fn line<W: ?Sized + io::Write>(&self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b"\n")?;
        (0..self.open.iter().filter(|o| o.1).count()).try_for_each(|_| writer.write_all(b"  "))
    }

    fn close<W: ?Sized + io::Write>(&mut self, writer: &mut W, bracket: &[u8]) -> io::Result<()> {
        if let Some((_, true)) = self.open.pop() {
            self.line(writer)?;
        }
        writer.write_all(bracket)
    }
}

impl Formatter for Lines {
    fn begin_array<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.open.push((true, false));
        writer.write_all(b"[")
    }

    fn end_array<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer, b"]")
    }

    fn begin_object<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        if let Some(array) = self.open.last_mut().filter(|o| o.0) {
            array.1 = true;
            self.line(writer)?;
        }
        self.open.push((false, self.objects < self.depth));
        self.objects += 1;
        writer.write_all(b"{")
    }

    fn end_object<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.objects -= 1;
        self.close(writer, b"}")
    }

    fn begin_object_key<W: ?Sized + io::Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        if !first {
            writer.write_all(b",")?;
        }
        match self.open.last() {
            Some((_, true)) => self.line(writer),
            _ if first => Ok(()),
            _ => writer.write_all(b" "),
        }
    }

    fn begin_object_value<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }
}
