//! [`Destination`]: where pictures are written: a file, a folder or standard output.

use std::path::{Path, PathBuf};
use std::{fs, io};

use crate::entry::cli::error::CliError;
use crate::entry::cli::picture::Format;
use crate::entry::cli::source::name;
use crate::entry::cli::terminal::{self, Terminal};
use crate::pictures::output::file::{Existing, same, write_whole};
use crate::read::file::ending;
use crate::text;

/// The destination of pictures.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Destination {
    /// Standard output, `-`.
    Stdout,
    /// A single file.
    File(PathBuf),
    /// A folder, which is created if it does not exist. Each picture is a file in it, named after its scene.
    Folder(PathBuf),
}

impl Destination {
    /// Interprets the argument of `-o`. The argument `-` is standard output. An existing folder, or a path with a slash
    /// at its end, is a folder. Any other path is a file.
    pub(crate) fn from_path(typed: &Path) -> Destination {
        let text = typed.to_string_lossy();
        if text == "-" {
            Destination::Stdout
        } else if text.ends_with(['/', std::path::MAIN_SEPARATOR]) || typed.is_dir() {
            Destination::Folder(typed.to_owned())
        } else {
            Destination::File(typed.to_owned())
        }
    }

    /// Returns the path of the file that the user typed; empty for a folder and for standard output.
    pub(crate) fn typed(&self) -> &[PathBuf] {
        match self {
            Destination::File(path) => std::slice::from_ref(path),
            Destination::Stdout | Destination::Folder(_) => &[],
        }
    }

    /// Returns the format of the picture. For a file, its extension decides, and `--format` must agree with it.
    /// Otherwise `--format` decides, and the default is SVG.
    pub(crate) fn format(&self, requested: Option<Format>) -> Result<Format, CliError> {
        let Destination::File(path) = self else {
            return Ok(requested.unwrap_or(Format::Svg));
        };
        let Some(by_name) = Format::from_ending(&ending(path)) else {
            let shown = path.display();
            let endings = Format::ALL.map(|format| format!(".{}", format.ending()));
            return Err(format!(
                "{shown}: the name of a picture ends in {}; for a folder, end the name with a slash",
                text::choice(endings)
            )
            .into());
        };
        match requested {
            Some(format) if format != by_name => {
                let (shown, requested) = (path.display(), format.ending());
                Err(format!(
                    "the extension of {shown} and --format {requested} contradict each other; leave out --format"
                )
                .into())
            }
            _ => Ok(by_name),
        }
    }
}

/// Returns an error if an output would overwrite an input or another output. Different paths to the same file, also
/// through links, count as the same file.
pub(crate) fn refuse_overwrites(outputs: &[PathBuf], inputs: &[&Path]) -> Result<(), CliError> {
    // If a shell redirects a file to standard input, `/dev/stdin` is this file. On systems without `/dev/stdin`, this
    // input is not compared.
    let stdin = Path::new("/dev/stdin");
    let is_stdin = |input: &Path| input == Path::new("-");
    for (number, output) in outputs.iter().enumerate() {
        let shown = output.display();
        let clash = |input: &Path| same(output, if is_stdin(input) { stdin } else { input });
        if let Some(input) = inputs.iter().find(|input| clash(input)) {
            let input = name(input);
            return Err(format!(
                "the output {shown} and the input {input} are the same file; give the output another name"
            )
            .into());
        }
        let twice = |other: &&PathBuf| *other == output || same(other, output);
        if let Some(other) = outputs[..number].iter().find(twice) {
            return Err(format!(
                "the outputs {} and {shown} are the same file; give one of them another name",
                other.display()
            )
            .into());
        }
    }
    Ok(())
}

/// Writes all files or none. `existing` says whether existing files are replaced. If they are not, an existing file is
/// an error, and its message mentions `--force`. Only the paths in `typed`, which the user wrote, may be links.
pub(crate) fn write(files: &[(PathBuf, Vec<u8>)], existing: Existing, typed: &[PathBuf]) -> Result<(), CliError> {
    terminal::deliver();
    write_whole(files, existing, typed).map_err(|unwritten| CliError::NotWritten {
        what: unwritten.path.display().to_string(),
        why: match unwritten.why.kind() {
            io::ErrorKind::AlreadyExists => "the file exists; --force replaces it".into(),
            _ => unwritten.why.to_string(),
        },
    })
}

/// Returns the file of an option `-o` that names a file; `None` for standard output.
pub(crate) fn file(output: Option<&PathBuf>) -> Option<&Path> {
    output.map(PathBuf::as_path).filter(|path| *path != Path::new("-"))
}

/// Writes `bytes` to a file, or prints them without a file. An existing file is an error, unless `force` is true.
pub(crate) fn deliver(terminal: &Terminal, file: Option<&Path>, bytes: Vec<u8>, force: bool) -> Result<(), CliError> {
    let existing = if force { Existing::Replace } else { Existing::Keep };
    match file {
        Some(path) => write(&[(path.to_owned(), bytes)], existing, &[path.to_owned()]),
        None => terminal.print_bytes(&bytes),
    }
}

/// Creates a folder and its parents, if they do not exist. Only `typed`, this folder or one above it, may be a link.
pub(crate) fn make_folder(folder: &Path, typed: &Path) -> Result<(), CliError> {
    if let Some(link) = folder.ancestors().take_while(|above| *above != typed).find(|above| above.is_symlink()) {
        let why = "it is a link, which may lead anywhere; delete it, or write to another place";
        return Err(CliError::not_written(link.display(), why));
    }
    fs::create_dir_all(folder).map_err(|error| CliError::not_written(folder.display(), error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_file_extension_selects_the_format_and_must_agree_with_the_format_option() {
        let file = |name: &str| Destination::from_path(Path::new(name));
        assert_eq!(file("a/b.PNG").format(None).ok(), Some(Format::Png));
        assert_eq!(file("b.svg").format(Some(Format::Svg)).ok(), Some(Format::Svg));
        assert_eq!(file("b.Pdf").format(None).ok(), Some(Format::Pdf));
        assert!(file("b.svg").format(Some(Format::Png)).is_err());
        assert!(file("b.pdf").format(Some(Format::Svg)).is_err());
        assert!(file("b.jpeg").format(None).is_err());
        assert!(file("b").format(Some(Format::Png)).is_err());
        assert_eq!(file("nowhere/").format(Some(Format::Png)).ok(), Some(Format::Png));
        assert_eq!(file("-").format(None).ok(), Some(Format::Svg));
    }
}
