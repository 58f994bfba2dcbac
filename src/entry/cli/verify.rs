//! `drystone verify`: checks a certificate in exact rational arithmetic. Also writes the certificate of `check
//! --certificate`.

use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::entry::cli::destination;
use crate::entry::cli::error::{CliError, Ended};
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::page::Page;
use crate::entry::cli::source;
use crate::entry::cli::terminal::Terminal;
use crate::entry::request::AnalysisArgs;
use crate::mechanics::analysis::{Analysis, Verdict};
use crate::mechanics::certificate::{Certificate, Checked};
use crate::pictures::output::file::Existing;

/// Check a certificate of check --certificate in exact arithmetic
///
/// Prints for each frame whether its forces or its motion prove the verdict exactly. With the scene, the certificate must
/// also be about this scene. The exit code is 0 if every verdict is proved and stable, 1 if every verdict is proved and
/// one is unstable, 2 if the certificate is wrong, and 3 if a verdict is not proved exactly.
#[derive(Debug, Args)]
pub(crate) struct Verify {
    /// The certificate
    #[arg(value_name = "FILE")]
    certificate: PathBuf,
    /// The scene that the certificate is about
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,
}

impl Verify {
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        self.checked(terminal).map_err(|c| vec![c])
    }

    fn checked(&self, terminal: &Terminal) -> Result<ExitStatus, CliError> {
        let shown = self.certificate.display();
        let bytes = bytes_of(&self.certificate)?;
        let certificate = Certificate::from_json(&bytes).map_err(|why| {
            CliError::CommandLine(format!("{shown} is not a certificate of drystone check --certificate: {why}"))
        })?;
        if let Some(scene) = &self.scene {
            let own = source::read(std::slice::from_ref(scene), None, &AnalysisArgs::default());
            let own = own.map_err(|mut errors| errors.swap_remove(0))?;
            let mut analysis = Analysis::new(own[0].scene.clone());
            let differs = certificate.differs_from(&Certificate::new(&mut analysis, hash(&bytes_of(scene)?), false));
            if let Some(what) = differs {
                let scene = scene.display();
                return Err(CliError::CommandLine(format!("{shown} is not about {scene}: {what}")));
            }
        }
        let checked = certificate
            .check()
            .map_err(|errors| CliError::CommandLine(format!("{shown} proves nothing: {}", errors.join("; "))))?;
        terminal.print(&page(&certificate, &checked))?;
        Ok(match &checked.frames[..] {
            _ if !checked.is_exact() => ExitStatus::Undecided,
            frames if frames.iter().any(|frame| frame.verdict == Verdict::Unstable.word()) => ExitStatus::Unstable,
            _ => ExitStatus::Done,
        })
    }
}

/// Writes the result of a check: a line for each frame, and what is assumed.
fn page(certificate: &Certificate, checked: &Checked) -> Page {
    let mut page = Page::default();
    let plain = |word: &str| match word {
        "stable" => Verdict::Stable.plain().to_owned(),
        "unstable" => Verdict::Unstable.plain().to_owned(),
        other => other.to_owned(),
    };
    let mut line = |name: String, verdict: &str, faults: &[String]| {
        let verdict = plain(verdict);
        if faults.is_empty() {
            page.line(&format!("{name}: {verdict}, exactly"));
        } else {
            page.line(&format!("{name}: {verdict}, not proved exactly"));
            faults.iter().for_each(|fault| page.line(&format!("  {fault}")));
        }
    };
    for frame in &checked.frames {
        line(format!("frame {}", frame.frame), &frame.verdict, &frame.faults);
    }
    for (limit, form) in checked.limits.iter().zip(&certificate.limits) {
        let side = if limit.verdict == Verdict::Stable.word() { "inside" } else { "beyond" };
        // The change is what is proved; the words before it are only what the certificate says about it.
        let turned = limit.turned.map(|angle| format!(", gravity turned by {angle:.9}°")).unwrap_or_default();
        let name = format!("frame {}, just {side} {} ({}{turned})", limit.frame, limit.of, form.change.to_json());
        line(name, &limit.verdict, &limit.faults);
    }
    if certificate.listed {
        page.line("The scene gives the contacts; their positions are not checked against the outlines.");
    } else {
        page.line(&format!("The farthest contact point lies {:.1e} m from an outline.", checked.farthest));
    }
    page.end();
    page
}

/// Writes the certificate of an analysis to a file, `with_margins` if its margins were requested.
pub(crate) fn write(analysis: &mut Analysis, scene: &Path, output: &Path, with_margins: bool) -> Result<(), CliError> {
    destination::refuse_overwrites(&[output.to_owned()], &[scene])?;
    let hash = if scene == Path::new("-") { String::new() } else { hash(&bytes_of(scene)?) };
    let certificate = Certificate::new(analysis, hash, with_margins);
    destination::write(&[(output.to_owned(), certificate.to_json().into_bytes())], Existing::Replace)
}

fn bytes_of(path: &Path) -> Result<Vec<u8>, CliError> {
    fs::read(path).map_err(|error| CliError::NotRead { what: path.display().to_string(), why: error.to_string() })
}

/// The SHA-256 of bytes in hexadecimal digits.
fn hash(bytes: &[u8]) -> String {
    hmac_sha256::Hash::hash(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}
