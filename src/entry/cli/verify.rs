//! `drystone verify`: checks a certificate in exact rational arithmetic. Also writes the certificate of `check
//! --certificate`.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::clock::Instant;
use crate::entry::cli::destination;
use crate::entry::cli::error::{CliError, Ended};
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::page::Page;
use crate::entry::cli::source;
use crate::entry::cli::terminal::Terminal;
use crate::entry::request::AnalysisArgs;
use crate::entry::value::{TimeLimit, seconds};
use crate::mechanics::analysis::{Analysis, FrameAnalysis, Options, Verdict};
use crate::mechanics::certificate::{Certificate, Checked};
use crate::mechanics::solve::DeadlineGuard;
use crate::pictures::output::file::Existing;
use crate::text::power_of_ten;

/// Check a certificate of check --certificate in exact arithmetic
///
/// Prints for each frame whether its forces or its motion prove the verdict exactly. With the scene, the certificate must
/// also be about this scene. The exit code is 0 if every verdict is proved and stable, 1 if every verdict is proved and
/// one is unstable, 2 if the certificate is wrong, and 3 if a verdict is not proved exactly.
#[derive(Clone, Debug, Args)]
pub(crate) struct Verify {
    /// The certificate
    #[arg(value_name = "FILE")]
    certificate: PathBuf,
    /// The scene that the certificate is about
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,
    /// Stop after this many seconds; verdicts that are not checked by then are not proved
    #[arg(long, value_name = "SECONDS", env = "DRYSTONE_TIME_LIMIT", hide_env_values = true,
        value_parser = |typed: &str| seconds(typed).map(TimeLimit::started))]
    time_limit: Option<TimeLimit>,
}

impl Verify {
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        let (page, status) = self.checked()?;
        terminal.print(&page)?;
        Ok(status)
    }

    fn checked(&self) -> Result<(Page, ExitStatus), CliError> {
        let shown = self.certificate.display();
        if let Some(scene) = &self.scene {
            source::refuse_streams(&[self.certificate.clone(), scene.clone()])?;
        }
        let bytes = source::bytes(&self.certificate)?;
        let certificate = Certificate::from_json(&bytes).map_err(|why| {
            CliError::CommandLine(format!("{shown} is not a certificate of drystone check --certificate: {why}"))
        })?;
        if let Some(scene) = &self.scene {
            let own = source::read(std::slice::from_ref(scene), None, &AnalysisArgs::default());
            let own = own.map_err(|mut errors| errors.swap_remove(0))?;
            // Which condition governs may depend on margins.
            let is_plain = !own[0].scene.has_conditions();
            let mut analysis = Analysis::with(own[0].scene.clone(), &Options::default().verdict_only(is_plain));
            // The proofs are not compared, so no time is spent on them.
            let _none = DeadlineGuard::new(Some(Instant::now()));
            let own = Certificate::new(&mut analysis, hash(&source::bytes(scene)?), false);
            let differs = certificate.differs_from(&own);
            if let Some(what) = differs {
                let scene = scene.display();
                return Err(CliError::CommandLine(format!("{shown} is not about {scene}: {what}")));
            }
        }
        let _until = DeadlineGuard::new(self.time_limit.and_then(TimeLimit::end));
        let checked = certificate
            .check()
            .map_err(|errors| CliError::CommandLine(format!("{shown} proves nothing: {}", errors.join("; "))))?;
        let status = match &checked.frames[..] {
            _ if !checked.is_exact() => ExitStatus::Undecided,
            frames if frames.iter().any(|frame| frame.verdict == Verdict::Unstable.word()) => ExitStatus::Unstable,
            _ => ExitStatus::Done,
        };
        Ok((page(&certificate, &checked), status))
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
        let side = if form.change.loads.is_some() { String::new() } else { format!("just {side} ") };
        let name = format!("frame {}, {side}{} ({}{turned})", limit.frame, limit.of, form.change.to_json());
        line(name, &limit.verdict, &limit.faults);
    }
    if checked.frames.is_empty() {
        page.line("The certificate has no frames, so nothing is proved.");
    }
    if certificate.listed {
        page.line("The scene gives the contacts; their positions are not checked against the outlines.");
    } else {
        page.line(&format!("The farthest contact point lies {} m from an outline.", power_of_ten(checked.farthest, 1)));
    }
    page.end();
    page
}

/// The largest number of blocks in all frames and conditions of a certificate. Each takes about 500 bytes, and a larger file is not read.
const MAX_BLOCKS: usize = 100_000;

/// Writes the certificate of an analysis to a file, `with_margins` if its margins were requested.
/// A proof that is not found by the deadline is left out.
pub(crate) fn write(
    analysis: &mut Analysis,
    scene: &Path,
    output: &Path,
    with_margins: bool,
    deadline: Option<Instant>,
) -> Result<(), CliError> {
    destination::refuse_overwrites(&[output.to_owned()], &[scene])?;
    // What was read from a pipe cannot be read again.
    let is_stream = scene == Path::new("-") || source::refuse_streams(&[scene.to_owned()]).is_err();
    let hash = if is_stream { String::new() } else { hash(&source::bytes(scene)?) };
    let conditions = |found: &FrameAnalysis| {
        let positions = found.vehicle.as_ref().map_or(0, |line| line.positions.len());
        analysis.given().cases().len().max(1) * (1 + positions)
    };
    let frames = analysis.given().frames().iter().zip(&analysis.frames);
    let count: usize = frames.map(|(frame, found)| frame.placed.len() * conditions(found)).sum();
    if count > MAX_BLOCKS {
        return Err(CliError::CommandLine(format!(
            "{count} blocks in all frames and conditions are too many for a certificate, at most {MAX_BLOCKS} are written; choose one \
             frame with --frame"
        )));
    }
    let _until = DeadlineGuard::new(deadline);
    let certificate = Certificate::new(analysis, hash, with_margins);
    let output = output.to_owned();
    destination::write(&[(output.clone(), certificate.to_json().into_bytes())], Existing::Replace, &[output])
}

/// The SHA-256 of bytes in hexadecimal digits.
fn hash(bytes: &[u8]) -> String {
    hmac_sha256::Hash::hash(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}
