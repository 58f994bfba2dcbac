//! The private module `drystone._drystone` of the Python package. It takes scenes as JSON text, calls the library and
//! returns the results.
//!
//! The public names, their arguments and their documentation are in `python/drystone`.

mod figure;
mod session;
mod table;

use std::ffi::OsString;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, OnceLock};
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedStr;
use pyo3::types::PyType;
use rayon::prelude::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::entry::cli;
use crate::entry::cli::error::CliError;
use crate::entry::cli::vary::{Ordinate, Varied};
use crate::entry::request::{CheckArgs, Refused, in_json, read_json};
use crate::mechanics::analysis::{self, MarginKind, Verdict};
use crate::mechanics::certificate::Certificate;
use crate::mechanics::scene::format::SceneFile;
use crate::mechanics::scene::{Scene, SceneError, isolate};
use crate::pictures::drawing::Theme;
use crate::pictures::output::svg;
use crate::products::result::{self, Layout, Timing};
use crate::products::snapshot::assertion;

request! {
    /// What an analysis computes, and how its problems are reported.
    #[derive(Clone, Debug)]
    pub(crate) struct AnalysisRequest(given) {
        what: CheckArgs = CheckArgs::read(given), command(flatten);
        /// Whether problems and notes state their position in the text. This is useful only if the scene was read from
        /// text.
        located: bool = given.flag("located"), arg(skip);
    }
}

/// The options of an analysis, read once and used for many scenes.
#[pyclass(frozen, module = "drystone._drystone")]
#[derive(Clone, Debug)]
struct Options {
    request: AnalysisRequest,
    /// The JSON object that was read, for pickles.
    text: Arc<str>,
}

#[pymethods]
impl Options {
    /// Reads the options from a JSON object, whose keys are the names of the options of `drystone check`.
    #[new]
    fn new(py: Python<'_>, text: &str) -> PyResult<Options> {
        let request = read_json(Some(text), AnalysisRequest::read).map_err(|why| fault(py, &why))?;
        Ok(Options { request, text: text.into() })
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> (Bound<'py, PyType>, (&str,)) {
        (py.get_type::<Options>(), (&self.text,))
    }
}

impl Options {
    /// Analyses a scene, given as JSON text. An internal fault of the program becomes a problem of the scene.
    fn analysis(&self, text: &str) -> Result<analysis::Analysis, Refused> {
        let analysis = isolate("scene", || {
            let mut analysis = self.request.what.analysis(text)?;
            if !self.request.located {
                analysis.notes.iter_mut().for_each(|note| note.line = 0);
            }
            Ok(analysis)
        });
        analysis.map_err(Refused::Scene).flatten()
    }

    /// Returns the Python exception for a scene that was not analysed.
    fn raised(&self, py: Python<'_>, why: Refused) -> PyErr {
        match why {
            Refused::Scene(problems) => refused(py, problems, self.request.located),
            Refused::Option(why) => fault(py, &why),
        }
    }
}

/// A scene and its results.
#[pyclass(frozen, module = "drystone._drystone")]
#[derive(Debug)]
struct Analysis {
    analysis: Arc<analysis::Analysis>,
    /// The text of the scene, which Python keeps too, and the options of the analysis.
    asked: (PyBackedStr, Py<Options>),
}

#[pymethods]
impl Analysis {
    /// An analysis is pickled as the scene and the options, and solved again.
    #[allow(clippy::type_complexity)]
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (&str, &Py<Options>))> {
        let check = py.import("drystone._drystone")?.getattr("check")?;
        Ok((check, (&self.asked.0, &self.asked.1)))
    }

    /// An analysis cannot change, so that it is its own copy.
    fn __deepcopy__<'py>(slf: Bound<'py, Self>, memo: Bound<'py, PyAny>) -> Py<Self> {
        drop(memo);
        slf.unbind()
    }

    /// Returns the verdict of each frame.
    fn verdicts(&self) -> Vec<&'static str> {
        self.analysis.frames.iter().map(|f| f.verdict.word()).collect()
    }

    /// Returns true if every frame stands.
    fn stands(&self) -> bool {
        self.analysis.verdict() == Verdict::Stable
    }

    /// Returns the signed margin of one frame, or the least one of all frames if `frame` is `None`. It is not a number if it
    /// is not known.
    fn signed_margin(&self, py: Python<'_>, kind: &str, frame: Option<usize>) -> PyResult<f64> {
        let Some(kind) = MarginKind::with_sign().find(|own| own.word() == kind) else {
            let known: Vec<&str> = MarginKind::with_sign().map(MarginKind::word).collect();
            return Err(fault(py, &format!("there is no signed margin {kind}; there are {}", known.join(", "))));
        };
        let mut least = f64::INFINITY;
        for solved in self.analysis.each().filter(|solved| frame.is_none_or(|frame| frame == solved.number)) {
            if !solved.found.margins.as_ref().is_some_and(|margins| margins.kinds.has(kind)) {
                let name = kind.word();
                return Err(fault(py, &format!("the margin {name} was not computed; check with margins=\"{name}\"")));
            }
            let number = solved.signed_margin(kind).unwrap_or(f64::NAN);
            least = if number.is_nan() { number } else { least.min(number) };
            if least.is_nan() {
                break;
            }
        }
        Ok(least)
    }

    /// Returns the result in the form that `check --json` prints. The result states `file` as the name of the scene
    /// file. With `timing`, it contains times; with `lines`, the JSON is broken into lines.
    fn to_json(&self, py: Python<'_>, file: Option<&str>, timing: bool, lines: bool) -> String {
        let timing = if timing { Timing::Included } else { Timing::LeftOut };
        let layout = if lines { Layout::Lines } else { Layout::OneLine };
        py.detach(|| match file {
            Some(file) => result::to_json_of(file, &self.analysis, timing, layout),
            None => result::to_json(&self.analysis, timing, layout),
        })
    }

    /// Returns the certificate that `check --certificate` writes; `hash` is the SHA-256 of the scene file.
    fn certificate(&self, py: Python<'_>, hash: String) -> String {
        detached(py, || Certificate::new(&mut (*self.analysis).clone(), hash, true).to_json())
    }

    /// Returns the table `contacts`, `robots`, `failures` or `blocks`, for the frame with the index `frame`, or for all
    /// frames if `frame` is `None`.
    fn table(&self, py: Python<'_>, name: &str, frame: Option<usize>) -> PyResult<table::Table> {
        table::Table::new(&self.analysis, name, frame).ok_or_else(|| fault(py, &format!("there is no table {name}")))
    }

    /// Returns the name and the rings (in metres) of each body. The parts of the ground come first and have no name
    /// (`None`); then come the blocks. The first ring of a body is its outline, and the others are its holes.
    fn outlines(&self) -> Vec<(Option<String>, Vec<Ring>)> {
        figure::outlines(self.analysis.given())
    }

    /// Returns the numbers, counted from 0, of the blocks that are placed in a frame; empty if there is no such frame.
    fn placed(&self, frame: usize) -> Vec<usize> {
        let frame = self.analysis.given().frames().get(frame);
        frame.map_or_else(Vec::new, |f| f.placed.iter().map(|b| b.0).collect())
    }

    /// Returns a caption for a figure: the title, and what stands or falls.
    fn caption(&self) -> String {
        crate::products::figure::caption(&self.analysis)
    }

    /// Draws a figure of all frames, or only of the frame with the index `frame`, and returns the bytes of the picture
    /// file. `request` are options of `render` as JSON, and the file extension `ending` selects the format.
    fn figure(&self, py: Python<'_>, request: &str, ending: &str, frame: Option<usize>) -> PyResult<Vec<u8>> {
        detached(py, || figure::drawn(&self.analysis, request, ending, frame)).map_err(|why| fault(py, &why))
    }

    /// Compares the result with its references: `base.txt`, `base.svg` and `base.png`. Returns the differences in lines,
    /// or, with `accepts`, writes them as references.
    fn snapshot(&self, py: Python<'_>, base: std::path::PathBuf, accepts: bool) -> Vec<String> {
        detached(py, || assertion::analysis(&base, &self.analysis, accepts)).err().unwrap_or_default()
    }

    /// Writes a report on the scene to the file `path`. `name` and `text` are the name and the content of the scene
    /// file.
    fn report(
        &self,
        py: Python<'_>,
        path: &str,
        name: &str,
        text: &str,
        title: Option<String>,
        theme: Option<&str>,
    ) -> PyResult<()> {
        detached(py, || figure::report(&self.analysis, path, [name, text], title, theme)).map_err(|why| fault(py, &why))
    }
}

/// Corners of an outline, metres.
type Ring = Vec<[f64; 2]>;

/// Returns the Python exception `drystone.DrystoneError` with the message `why`.
fn fault(py: Python<'_>, why: &str) -> PyErr {
    raised(py, "DrystoneError", (why,))
}

/// Returns the Python exception `drystone.SceneError` with the problems of a scene. Lines and columns are left out
/// unless `located` is true.
fn refused(py: Python<'_>, mut problems: SceneError, located: bool) -> PyErr {
    if !located {
        // A scene that was made in Python has no file, so the line and column of a problem would mean nothing.
        for problem in &mut problems.list {
            (problem.line, problem.column) = (0, 0);
        }
    }
    let json = result::refusal("", &problems.list, Layout::OneLine);
    raised(py, "SceneError", (problems.to_string(), json))
}

fn raised<'py>(py: Python<'py>, class: &str, arguments: impl pyo3::call::PyCallArgs<'py>) -> PyErr {
    let made =
        py.import("drystone._errors").and_then(|module| module.getattr(class)).and_then(|class| class.call1(arguments));
    match made {
        Ok(error) => PyErr::from_value(error),
        Err(error) => error,
    }
}

/// Does work without blocking the other threads of Python.
///
/// In a process that was forked after its parent has solved something, the threads of the parent do not exist, and waiting
/// for them would never end. Such a process gets its own threads.
fn detached<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> T {
    static FIRST: OnceLock<u32> = OnceLock::new();
    static FORKED: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);
    py.detach(|| {
        let own = std::process::id();
        if *FIRST.get_or_init(|| own) == own {
            return work();
        }
        let Ok(mut forked) = FORKED.lock() else { return work() };
        let pool = match forked.take() {
            Some((process, pool)) if process == own => pool,
            other => {
                // The threads of this pool exist in another process only, so it cannot be closed here.
                std::mem::forget(other);
                let Ok(pool) = ThreadPoolBuilder::new().build() else { return work() };
                Arc::new(pool)
            }
        };
        *forked = Some((own, pool.clone()));
        drop(forked);
        pool.install(work)
    })
}

/// Analyses a scene, given as JSON text. Raises an exception if the scene is not valid, or if the requested capacity
/// does not fit the scene.
#[pyfunction]
fn check(py: Python<'_>, text: PyBackedStr, options: &Bound<'_, Options>) -> PyResult<Analysis> {
    let own = options.get();
    let analysis = detached(py, || own.analysis(&text)).map_err(|why| own.raised(py, why))?;
    Ok(Analysis { analysis: analysis.into(), asked: (text, options.clone().unbind()) })
}

/// Finds the values of one or two numbers at which a structure stands. `text` is a scene as JSON; without it, `name` is a
/// structure of `drystone new`. `shown` has the numbers for a curve and for lines on a map. Returns the data as JSON, and the picture as SVG.
#[pyfunction]
fn vary(
    py: Python<'_>,
    name: &str,
    text: Option<String>,
    numbers: Vec<String>,
    shown: (Option<String>, Option<String>),
    digits: u32,
    options: &Options,
) -> PyResult<(String, String)> {
    let bytes = || text.map(String::into_bytes).ok_or_else(|| format!("there is no structure {name}").into());
    let level = &options.request.what.level;
    let found = detached(py, || {
        let ordinate = Ordinate { curve: shown.0.as_deref(), isolines: shown.1.as_deref() };
        let varied = Varied::read(name, bytes, &numbers, ordinate, &level.started())?;
        let answer = varied.answer(digits.clamp(2, 9), || ());
        let svg = svg::write(&varied.drawing(&answer, &Theme::default(), None));
        Ok((varied.told(&answer).0.to_string(), svg))
    });
    found.map_err(|why| match why {
        CliError::Scene { problems, .. } => refused(py, problems, options.request.located),
        other => fault(py, &in_json(&other.message())),
    })
}

/// Analyses scenes on several threads. Returns an analysis or an exception for each scene, in the order of the scenes.
/// Repeatedly calls `progress` with the number of finished scenes. If `progress` raises an exception or the user
/// interrupts Python, the work ends with this exception.
#[pyfunction]
fn check_many(
    py: Python<'_>,
    texts: Vec<PyBackedStr>,
    options: &Bound<'_, Options>,
    progress: Option<Py<PyAny>>,
    threads: usize,
) -> PyResult<Vec<Py<PyAny>>> {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    let (own, texts_read) = (options.get(), &texts);
    let stop = AtomicBool::new(false);
    let mut stopped = None;
    let answers = py.detach(|| {
        let (sender, done) = channel();
        std::thread::scope(|scope| {
            let stop = &stop;
            let work = scope.spawn(move || {
                let answer = |(number, text): (usize, &PyBackedStr)| {
                    if stop.load(Ordering::Relaxed) {
                        return None;
                    }
                    let answer = own.analysis(text);
                    let _ = sender.send(number);
                    Some(answer)
                };
                let texts = texts_read.par_iter().enumerate();
                pool.install(|| texts.map(answer).collect::<Vec<_>>())
            });
            let mut count = 0;
            let mut reported = 0;
            loop {
                // Wait at most 50 ms, so that Python can handle an interrupt while the threads work.
                let heard = done.recv_timeout(Duration::from_millis(50));
                if heard.is_ok() {
                    count += 1 + done.try_iter().count();
                }
                if count > reported || heard == Err(RecvTimeoutError::Timeout) {
                    reported = count;
                    let heard = Python::attach(|py| {
                        py.check_signals()?;
                        progress.as_ref().map_or(Ok(()), |p| p.call1(py, (count,)).map(drop))
                    });
                    if let Err(error) = heard {
                        stopped = Some(error);
                        stop.store(true, Ordering::Relaxed);
                        break;
                    }
                }
                if heard == Err(RecvTimeoutError::Disconnected) {
                    break;
                }
            }
            work.join()
        })
    });
    if let Some(error) = stopped {
        return Err(error);
    }
    let answers = answers.map_err(|_| PyRuntimeError::new_err("a thread of check_many failed"))?;
    let one = |(answer, text): (Result<analysis::Analysis, Refused>, PyBackedStr)| match answer {
        Ok(analysis) => {
            let asked = (text, options.clone().unbind());
            Ok(Py::new(py, Analysis { analysis: analysis.into(), asked })?.into_any())
        }
        Err(why) => Ok(own.raised(py, why).into_value(py).into_any()),
    };
    answers.into_iter().flatten().zip(texts).map(one).collect()
}

/// Checks a scene, given as JSON text, and raises an exception if it is not valid.
#[pyfunction]
fn read(py: Python<'_>, text: &str, located: bool) -> PyResult<()> {
    match py.detach(|| Scene::from_json(text)) {
        Ok(_) => Ok(()),
        Err(problems) => Err(refused(py, problems, located)),
    }
}

/// Returns the text of a scene file with the line breaks and spaces that drystone uses.
#[pyfunction]
fn formatted(py: Python<'_>, text: &str) -> PyResult<String> {
    let file = SceneFile::from_json(text).map_err(|why| fault(py, &why.to_string()))?;
    Ok(file.to_json())
}

/// Reads an assembly of `compas_assembly`, given as JSON. Returns the text of a scene file with the sections of its blocks
/// in a coordinate plane such as `xz`. `thickness`, in metres, replaces that of the blocks.
#[pyfunction]
fn compas(py: Python<'_>, text: &str, plane: &str, thickness: Option<f64>) -> PyResult<String> {
    let scene = SceneFile { thickness, ..SceneFile::default() };
    let sections = crate::sources::import::sections(text, plane, scene);
    sections.map(|scene| scene.to_json()).map_err(|why| fault(py, &why))
}

/// Returns the JSON Schema of scene files.
#[pyfunction]
fn schema() -> String {
    crate::mechanics::scene::schema()
}

/// Returns the names of the kinds of figures of a whole structure, each with a line of help. The figure of one block is
/// not in this list.
#[pyfunction]
fn kinds() -> Vec<(&'static str, &'static str)> {
    let all = crate::products::figure::Kind::ALL.into_iter();
    all.filter(|kind| !kind.shows_one_block()).map(|kind| (kind.name(), kind.help())).collect()
}

/// Returns the names of the themes.
#[pyfunction]
fn themes() -> Vec<&'static str> {
    Theme::NAMES.to_vec()
}

/// Runs the command line `words`, whose first word is the name of the program. Returns the exit code.
#[pyfunction]
fn run(py: Python<'_>, words: Vec<OsString>) -> u8 {
    py.detach(|| cli::run_with(words.into_iter()))
}

#[pymodule]
mod _drystone {
    #[pymodule_export]
    use crate::entry::python::figure::{new_name, sketch};
    #[pymodule_export]
    use crate::entry::python::session::Session;
    #[pymodule_export]
    use crate::entry::python::table::{Table, summary};
    #[pymodule_export]
    use crate::entry::python::{
        Analysis, Options, check, check_many, compas, formatted, kinds, read, run, schema, themes, vary,
    };

    /// The version of drystone.
    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "Python's name for it")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
