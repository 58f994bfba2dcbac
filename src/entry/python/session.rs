//! [`Session`]: the Python class for a structure under construction. Each step, such as placing a block, returns the
//! verdict.

use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::PyType;

use super::{Options, Ring, detached, fault, refused};
use crate::entry::request::in_json;
use crate::geometry::Point;
use crate::mechanics::analysis;
use crate::mechanics::scene::Scene;
use crate::mechanics::scene::format::{BlockEntry, SceneFile};
use crate::mechanics::session::{self, SessionError};
use crate::products::result;
use crate::read::{Dialect, Notation, Read, from_text};

/// A structure under construction; every step returns the verdict.
#[pyclass(module = "drystone._drystone")]
#[derive(Clone, Debug)]
pub(super) struct Session {
    inner: session::Session,
    options: Arc<str>,
}

#[pymethods]
impl Session {
    /// Starts a session. `done` has the steps to repeat, as in a pickle.
    #[new]
    #[pyo3(signature = (text, options, done = None))]
    fn new(py: Python<'_>, text: &str, options: &Options, done: Option<&str>) -> PyResult<Session> {
        // Check the text first, because only `Scene::from_json` reports the lines of problems.
        Scene::from_json(text).map_err(|problems| refused(py, problems, options.request.located))?;
        let file = SceneFile::from_json(text).map_err(|why| fault(py, &why.to_string()))?;
        let done = done.map(SceneFile::from_json).transpose().map_err(|why| fault(py, &why.to_string()))?;
        let base = options.request.what.level.options();
        let inner = detached(py, || match done {
            None => session::Session::with(file, base),
            Some(done) => session::Session::repeated(file, done, base),
        });
        let inner = inner.map_err(|error| complaint(py, error))?;
        Ok(Session { inner, options: options.text.clone() })
    }

    /// A session is pickled as its start and its steps.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyType>, (String, Options, String))> {
        let (start, done) = self.inner.done();
        let options = Options::new(py, &self.options)?;
        Ok((py.get_type::<Session>(), (start.to_json(), options, done.to_json())))
    }

    /// Returns the scene file with the steps of the session, or without them, as the blocks are placed now.
    fn scene(&self, steps: bool) -> String {
        if steps { self.inner.scene_file() } else { self.inner.placed_file() }.to_json()
    }

    /// Places a block with these rings, in the scene's unit of length (by default metres), and returns the verdict.
    /// `keys` are the other keys of the block as JSON text. Without `polygon`, one of these keys must define the
    /// outline.
    fn place(
        &mut self,
        py: Python<'_>,
        id: Option<String>,
        polygon: Option<Ring>,
        holes: Vec<Ring>,
        keys: Option<&str>,
    ) -> PyResult<&'static str> {
        let mut block: BlockEntry = match keys {
            None => BlockEntry::default(),
            Some(keys) => from_text(keys, Notation::Json, &Dialect::plain("block"), BlockEntry::read)
                .map_err(|problems| fault(py, &format!("block: {problems}")))?,
        };
        (block.id, block.polygon, block.holes) = (id, polygon, holes);
        self.step(py, |inner| inner.place(block))
    }

    fn remove(&mut self, py: Python<'_>, block: &str) -> PyResult<&'static str> {
        self.step(py, |inner| inner.remove(block))
    }

    fn hold(&mut self, py: Python<'_>, robot: &str, block: &str, at: Option<[f64; 2]>) -> PyResult<&'static str> {
        let at = at.map(|[x, y]| Point::new(x, y));
        self.step(py, |inner| inner.hold(robot, block, at))
    }

    fn release(&mut self, py: Python<'_>, robot: &str) -> PyResult<&'static str> {
        self.step(py, |inner| inner.release(robot))
    }

    #[getter]
    fn verdict(&self) -> &'static str {
        self.inner.verdict().word()
    }

    /// Returns the ids of the placed blocks, in the order in which they were placed.
    #[getter]
    fn blocks(&self) -> Vec<&str> {
        let scene = self.inner.scene();
        let placed = scene.frames().first().into_iter().flat_map(|f| &f.placed);
        placed.map(|b| scene.blocks()[b.0].id.as_str()).collect()
    }

    /// Returns pairs of ids: a robot, and the block that it holds.
    #[getter]
    fn holds(&self) -> Vec<(&str, &str)> {
        let scene = self.inner.scene();
        let holds = scene.frames().first().into_iter().flat_map(|f| &f.holds);
        holds
            .map(|h| {
                let robot = scene.robots()[h.robot.0].id.as_str();
                (robot, scene.blocks()[h.block.0].id.as_str())
            })
            .collect()
    }

    /// Computes all forces that a placed block can carry, and returns them as JSON. `typed` and `for_all` are written
    /// like the values of `--capacity` and `--for-all`.
    fn capacity(&self, py: Python<'_>, typed: &str, for_all: Option<&str>) -> PyResult<String> {
        let request = analysis::typed_capacity(self.inner.scene(), typed, for_all);
        let request = request.map_err(|why| fault(py, &in_json(&why)))?;
        let found = detached(py, || self.inner.capacity(&request));
        let found = found.map_err(|why| fault(py, &why.to_string()))?;
        Ok(result::capacity_json(self.inner.scene(), &found))
    }

    fn copy(&self) -> Session {
        self.clone()
    }
}

impl Session {
    fn step(
        &mut self,
        py: Python<'_>,
        work: impl FnOnce(&mut session::Session) -> Result<analysis::Verdict, SessionError> + Send,
    ) -> PyResult<&'static str> {
        let inner = &mut self.inner;
        match detached(py, || work(inner)) {
            Ok(verdict) => Ok(verdict.word()),
            Err(error) => Err(complaint(py, error)),
        }
    }
}

fn complaint(py: Python<'_>, error: SessionError) -> PyErr {
    match error {
        SessionError::SceneError(problems) => refused(py, problems, false),
        other => fault(py, &other.to_string()),
    }
}
