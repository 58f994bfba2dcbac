//! [`script`]: the script that makes the figures of a report interactive.

use std::fs;
use std::path::Path;

use crate::entry::cli::error::CliError;

/// The name of the script file that `examples/playground/build.sh` makes.
const NAME: &str = "interactive.js";
/// How to make the file, for error messages.
const MADE: &str = "examples/playground/build.sh in the repository of drystone makes it";

/// Reads the script. `path` is the file, or the folder that contains it.
///
/// # Errors
/// Returns an error if the file cannot be read, is not this script, or belongs to another version of drystone.
pub(super) fn script(path: &Path) -> Result<String, CliError> {
    let path = match path.is_dir() {
        true => path.join(NAME),
        false => path.to_owned(),
    };
    let shown = path.display();
    let script = fs::read_to_string(&path)
        .map_err(|error| CliError::NotRead { what: shown.to_string(), why: format!("{error}; {MADE}") })?;
    let version = env!("CARGO_PKG_VERSION");
    let found = script
        .strip_prefix("// drystone ")
        .and_then(|rest| rest.split_once(": interactive figures\n"))
        .filter(|(_, rest)| !rest.contains("</script") && !rest.contains("<!--"));
    match found {
        Some((own, _)) if own == version => Ok(script),
        Some((own, _)) if own.len() < 40 && !own.contains('\n') => Err(CliError::CommandLine(format!(
            "{shown} belongs to drystone {own}, and this is drystone {version}; {MADE} for its own version"
        ))),
        _ => Err(CliError::CommandLine(format!("{shown} is not the script of interactive figures, {NAME}; {MADE}"))),
    }
}
