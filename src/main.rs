//! The `drystone` program: everything is in the library's `cli`.

use std::process::ExitCode;

fn main() -> ExitCode {
    drystone::internals::cli::run()
}
