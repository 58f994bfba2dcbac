//! [`Table`]: results as a table for Python: either columns for numpy (numbers as bytes, texts as a list), or an Arrow
//! C stream.

use std::collections::BTreeSet;
use std::sync::Arc;

use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::{ArrayRef, BooleanArray, Float64Array, Int64Array, RecordBatch, RecordBatchIterator, StringArray};
use arrow_schema::{ArrowError, DataType, Field, Schema};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::{PyByteArray, PyCapsule, PyList, PyType};

use crate::geometry::Vector;
use crate::mechanics::analysis::{
    Analysis, Contact, ContactKind, End, Failure, FrameAnalysis, MarginKind, RobotForce, SolvedFrame,
};
use crate::mechanics::scene::{BlockId, BodyId, Scene};

/// One column.
enum Column {
    Real(Vec<f64>),
    Whole(Vec<i64>),
    Flag(Vec<bool>),
    Word(Vec<String>),
}

/// A table: columns of equal length, each with its name.
#[pyclass(frozen, module = "drystone._drystone")]
pub(super) struct Table {
    columns: Vec<(String, Column)>,
    rows: usize,
}

#[pymethods]
impl Table {
    /// Makes a table again from the names and the values of its columns.
    #[new]
    fn restored(names: Vec<String>, columns: Vec<(String, Bound<'_, PyAny>)>, rows: usize) -> PyResult<Table> {
        fn numbers<T>(values: &Bound<'_, PyAny>, number: fn([u8; 8]) -> T) -> PyResult<Vec<T>> {
            let bytes = values.cast::<PyByteArray>()?.to_vec();
            Ok(bytes.as_chunks::<8>().0.iter().map(|bytes| number(*bytes)).collect())
        }
        let columns = names.into_iter().zip(columns).map(|(name, (kind, values))| {
            let column = match kind.as_str() {
                "f8" => Column::Real(numbers(&values, f64::from_ne_bytes)?),
                "i8" => Column::Whole(numbers(&values, i64::from_ne_bytes)?),
                "?" => Column::Flag(values.cast::<PyByteArray>()?.to_vec().iter().map(|flag| *flag != 0).collect()),
                _ => Column::Word(values.extract()?),
            };
            Ok((name, column))
        });
        Ok(Table { columns: columns.collect::<PyResult<_>>()?, rows })
    }

    /// A table is pickled as its columns.
    #[allow(clippy::type_complexity)]
    fn __reduce__<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyType>, (Vec<&str>, Vec<(&'static str, Bound<'py, PyAny>)>, usize))> {
        Ok((py.get_type::<Table>(), (self.names(), self.columns(py)?, self.rows)))
    }

    fn __len__(&self) -> usize {
        self.rows
    }

    /// Returns the names of the columns.
    fn names(&self) -> Vec<&str> {
        self.columns.iter().map(|column| column.0.as_str()).collect()
    }

    /// Returns the numpy type of each column, and its values as a bytearray or a list of texts. A numpy array that
    /// shares the memory of a bytearray is writable.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Vec<(&'static str, Bound<'py, PyAny>)>> {
        let bytes = |bytes: Vec<u8>| PyByteArray::new(py, &bytes).into_any();
        let one = |(_, column): &(String, Column)| {
            Ok(match column {
                Column::Real(all) => {
                    let all = all.iter().flat_map(|x| x.to_ne_bytes());
                    ("f8", bytes(all.collect()))
                }
                Column::Whole(all) => {
                    let all = all.iter().flat_map(|x| x.to_ne_bytes());
                    ("i8", bytes(all.collect()))
                }
                Column::Flag(all) => ("?", bytes(all.iter().copied().map(u8::from).collect())),
                Column::Word(all) => ("U", PyList::new(py, all)?.into_any()),
            })
        };
        self.columns.iter().map(one).collect()
    }

    /// Returns the table as an Arrow C stream. The requested schema is ignored, as the protocol allows.
    #[pyo3(signature = (requested_schema = None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        drop(requested_schema);
        let batch = self.batch().map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
        let schema = batch.schema();
        let batches = RecordBatchIterator::new([Ok(batch)], schema);
        let stream = FFI_ArrowArrayStream::new(Box::new(batches));
        PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
    }
}

impl Table {
    fn batch(&self) -> Result<RecordBatch, ArrowError> {
        let mut fields = Vec::new();
        let mut arrays: Vec<ArrayRef> = Vec::new();
        for (name, column) in &self.columns {
            let (kind, array): (DataType, ArrayRef) = match column {
                Column::Real(all) => (DataType::Float64, Arc::new(Float64Array::from_iter_values(all.iter().copied()))),
                Column::Whole(all) => (DataType::Int64, Arc::new(Int64Array::from_iter_values(all.iter().copied()))),
                Column::Flag(all) => (DataType::Boolean, Arc::new(BooleanArray::from(all.clone()))),
                Column::Word(all) => (DataType::Utf8, Arc::new(StringArray::from_iter_values(all))),
            };
            fields.push(Field::new(name, kind, false));
            arrays.push(array);
        }
        RecordBatch::try_new(Arc::new(Schema::new(fields)), arrays)
    }

    /// Returns the table `contacts`, `robots`, `failures` or `blocks`, for one frame or for all frames. Returns `None`
    /// for any other name.
    pub(super) fn new(analysis: &Analysis, name: &str, frame: Option<usize>) -> Option<Table> {
        let numbers = (0..analysis.frames.len()).filter(|n| frame.is_none_or(|f| f == *n));
        let numbers: Vec<usize> = numbers.collect();
        match name {
            "contacts" => Some(contacts(analysis, &numbers)),
            "robots" => Some(robots(analysis, &numbers)),
            "failures" => Some(failures(analysis, &numbers)),
            "blocks" => Some(blocks(analysis, &numbers)),
            _ => None,
        }
    }
}

/// Returns a table with a row for each frame of several analyses. For a scene that is not valid, the list contains
/// `None`, and the table has no row.
#[pyfunction]
pub(super) fn summary(analyses: Vec<Option<Py<super::Analysis>>>) -> Table {
    let valid = analyses.iter().enumerate();
    let valid = valid.filter_map(|(n, a)| Some((n, &*a.as_ref()?.get().analysis)));
    let all = valid.flat_map(|(n, analysis)| analysis.each().map(move |solved| (solved.number, (n, solved))));
    let mut rows = Rows::new(all.collect());
    rows.whole("scene", |row| row.0 as i64);
    rows.columns.rotate_right(1);
    rows.word("title", |row| row.1.frame().title.clone());
    rows.word("verdict", |row| row.1.found.verdict.word().into());
    rows.whole("contacts", |row| row.1.found.contacts.len() as i64);
    rows.whole("failures", |row| row.1.found.failures.len() as i64);
    rows.real("weight", |row| row.1.found.weight);
    rows.real("total_force", |row| row.1.found.total_force);
    rows.real("total_sticking", |row| row.1.found.total_sticking);
    let robots = |solved: &SolvedFrame<'_>| {
        let scene = solved.scene;
        let force = |held: &RobotForce| (scene.robots()[held.robot.0].id.clone(), held.force.norm());
        solved.found.robots.iter().map(force).collect::<Vec<_>>()
    };
    let held = rows.rows.iter().flat_map(|(_, row)| robots(&row.1).into_iter().map(|robot| robot.0));
    for name in held.collect::<BTreeSet<_>>() {
        let force = |solved: &SolvedFrame<'_>| {
            robots(solved).into_iter().find(|robot| robot.0 == name).map_or(f64::NAN, |robot| robot.1)
        };
        rows.real(format!("force_{name}"), |row| force(&row.1));
    }
    let has_margins = rows.rows.iter().any(|(_, row)| row.1.found.margins.is_some());
    for kind in MarginKind::of_frame().filter(|_| has_margins) {
        let (name, ends) = (kind.word(), kind.about().ends);
        for (end, side, sign) in [(0, "left", -1.0), (1, "right", 1.0)] {
            let value = |row: &FrameAnalysis| value(row.margins.as_ref().and_then(|margins| margins.end(kind, end)));
            match ends {
                [true, true] => rows.real(format!("{name}_{side}"), |row| sign * value(row.1.found)),
                _ if ends[end] => rows.real(name, |row| value(row.1.found)),
                _ => {}
            }
        }
    }
    let asked = |kind: MarginKind| {
        let mut margins = rows.rows.iter().filter_map(|(_, row)| row.1.found.margins.as_ref());
        margins.any(|margins| margins.kinds.has(kind))
    };
    for kind in MarginKind::with_sign().filter(|kind| asked(*kind)).collect::<Vec<_>>() {
        rows.real(format!("signed_{}", kind.word()), |row| row.1.signed_margin(kind).unwrap_or(f64::NAN));
    }
    rows.table()
}

/// Returns the value at an end of an interval: infinity if the interval is unbounded there, and NaN if it has no value.
fn value(end: Option<&End>) -> f64 {
    match end {
        Some(End::Unbounded) => f64::INFINITY,
        end => end.and_then(End::value).unwrap_or(f64::NAN),
    }
}

/// Rows, each with the number of its frame, and the columns that were computed from the rows.
struct Rows<T> {
    rows: Vec<(usize, T)>,
    columns: Vec<(String, Column)>,
}

impl<T> Rows<T> {
    fn new(rows: Vec<(usize, T)>) -> Rows<T> {
        let frames = rows.iter().map(|(frame, _)| *frame as i64).collect();
        Rows { rows, columns: vec![("frame".into(), Column::Whole(frames))] }
    }

    fn real(&mut self, name: impl Into<String>, of: impl Fn(&T) -> f64) {
        // Adding 0 turns −0 into 0, as in the JSON result.
        let all = self.rows.iter().map(|(_, row)| of(row) + 0.0).collect();
        self.columns.push((name.into(), Column::Real(all)));
    }

    fn pair(&mut self, names: [&'static str; 2], of: impl Fn(&T) -> Vector) {
        self.real(names[0], |row| of(row).x);
        self.real(names[1], |row| of(row).y);
    }

    fn whole(&mut self, name: &'static str, of: impl Fn(&T) -> i64) {
        let all = self.rows.iter().map(|(_, row)| of(row)).collect();
        self.columns.push((name.into(), Column::Whole(all)));
    }

    fn flag(&mut self, name: &'static str, of: impl Fn(&T) -> bool) {
        let all = self.rows.iter().map(|(_, row)| of(row)).collect();
        self.columns.push((name.into(), Column::Flag(all)));
    }

    fn word(&mut self, name: &'static str, of: impl Fn(&T) -> String) {
        let all = self.rows.iter().map(|(_, row)| of(row));
        self.columns.push((name.into(), Column::Word(all.collect())));
    }

    /// Adds columns with the names of two bodies and their indices among the blocks. The index is −1 for the ground. If
    /// there is no body, the name is empty and the index is −1.
    fn bodies(&mut self, scene: &Scene, of: impl Fn(&T) -> [Option<BodyId>; 2]) {
        let name = |id: Option<BodyId>| id.map_or_else(String::new, |id| scene.name(id).to_owned());
        self.word("body_0", |row| name(of(row)[0]));
        self.word("body_1", |row| name(of(row)[1]));
        let number = |id: Option<BodyId>| match id {
            Some(BodyId::Block(BlockId(number))) => number as i64,
            _ => -1,
        };
        self.whole("block_0", |row| number(of(row)[0]));
        self.whole("block_1", |row| number(of(row)[1]));
    }

    fn table(self) -> Table {
        Table { rows: self.rows.len(), columns: self.columns }
    }
}

fn contacts(analysis: &Analysis, numbers: &[usize]) -> Table {
    let scene = analysis.given();
    let of = |n: usize| analysis.frames[n].contacts.iter().map(move |c| (n, c));
    let all: Vec<(usize, &Contact)> = numbers.iter().copied().flat_map(of).collect();
    let mut rows = Rows::new(all);
    rows.bodies(scene, |c| c.interface.bodies.map(Some));
    rows.word("kind", |c| match c.interface.kind {
        ContactKind::Corner => "corner".into(),
        _ => "edge".into(),
    });
    rows.pair(["end_0_x", "end_0_y"], |c| c.interface.ends[0].coords);
    rows.pair(["end_1_x", "end_1_y"], |c| c.interface.ends[1].coords);
    rows.pair(["normal_x", "normal_y"], |c| c.interface.normal);
    rows.real("mu", |c| c.interface.friction);
    rows.real("normal_force_0", |c| c.normal_forces[0]);
    rows.real("normal_force_1", |c| c.normal_forces[1]);
    rows.real("friction_force", |c| c.friction_force);
    rows.pair(["x", "y"], |c| c.resultant.at.coords);
    rows.pair(["force_x", "force_y"], |c| c.resultant.force);
    rows.real("friction_used", |c| c.friction_used);
    rows.table()
}

fn robots(analysis: &Analysis, numbers: &[usize]) -> Table {
    let scene = analysis.given();
    let of = |n: usize| analysis.frames[n].robots.iter().map(move |r| (n, r));
    let all: Vec<(usize, &RobotForce)> = numbers.iter().copied().flat_map(of).collect();
    let mut rows = Rows::new(all);
    rows.word("id", |r| scene.robots()[r.robot.0].id.clone());
    rows.word("holds", |r| scene.blocks()[r.block.0].id.clone());
    rows.whole("block", |r| r.block.0 as i64);
    rows.pair(["x", "y"], |r| r.at.coords);
    rows.pair(["force_x", "force_y"], |r| r.force);
    rows.real("torque", |r| r.torque);
    rows.real("limit_used", |r| r.limit_used);
    rows.table()
}

fn failures(analysis: &Analysis, numbers: &[usize]) -> Table {
    let scene = analysis.given();
    let of = |n: usize| analysis.frames[n].failures.iter().map(move |f| (n, f));
    let all: Vec<(usize, &Failure)> = numbers.iter().copied().flat_map(of).collect();
    let mut rows = Rows::new(all);
    rows.word("kind", |f| f.word().into());
    rows.bodies(scene, |f| {
        let (first, second) = f.bodies();
        [Some(first), second]
    });
    rows.word("robot", |f| {
        let robot = f.robot().map(|r| scene.robots()[r.0].id.clone());
        robot.unwrap_or_default()
    });
    rows.pair(["x", "y"], |f| f.at().coords);
    rows.pair(["force_x", "force_y"], |f| f.force());
    rows.real("torque", |f| f.torque());
    rows.real("amount", |f| f.amount());
    rows.table()
}

fn blocks(analysis: &Analysis, numbers: &[usize]) -> Table {
    let scene = analysis.given();
    let of = |n: usize| {
        let placed = scene.frames()[n].placed.iter();
        placed.map(move |b| (n, (n, b.0)))
    };
    let all: Vec<(usize, (usize, usize))> = numbers.iter().copied().flat_map(of).collect();
    let mut rows = Rows::new(all);
    let motion = |row: &(usize, usize)| {
        let motions = analysis.frames[row.0].mechanism.iter();
        motions.into_iter().find(|m| m.block.0 == row.1)
    };
    rows.word("id", |row| scene.blocks()[row.1].id.clone());
    rows.whole("block", |row| row.1 as i64);
    rows.real("weight", |row| analysis.at(row.0).scene.blocks()[row.1].weight);
    rows.real("area", |row| scene.blocks()[row.1].body.polygon.area());
    rows.pair(["x", "y"], |row| scene.blocks()[row.1].centroid.coords);
    rows.pair(["velocity_x", "velocity_y"], |row| motion(row).map_or_else(Vector::zeros, |m| m.velocity));
    rows.real("spin", |row| motion(row).map_or(0.0, |m| m.spin));
    rows.flag("unsupported", |row| analysis.frames[row.0].unsupported.contains(&BlockId(row.1)));
    rows.word("robot", |row| {
        let holds = scene.frames()[row.0].holds.iter();
        let robots = holds.filter(|h| h.block.0 == row.1);
        let names: Vec<&str> = robots.map(|h| scene.robots()[h.robot.0].id.as_str()).collect();
        names.join(", ")
    });
    rows.table()
}
