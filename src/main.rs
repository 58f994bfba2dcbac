//! The `drystone` program. It only calls the library's `cli` module.

use std::process::ExitCode;

fn main() -> ExitCode {
    drystone::internals::cli::run()
}
