//! From a text, or a [`SceneFile`] made in code, to a checked [`Scene`], or to all its problems at once.
//!
//! A sound file is read once, straight into its types. Only where that fails is the text walked beside what the types
//! expect, so that every misfit is told, and what could be read is still examined for its meaning.

use super::Scene;
use super::expectation;
use super::finding::Doubt;
use super::format::{self, RefusalKind, SceneFile};
use super::problem::{self, Problems};
use super::resolution::resolve;
use super::source::Source;
use super::syntax;

impl Scene {
    /// Reads and checks a scene file.
    ///
    /// # Errors
    /// Everything that is wrong with it, each with line, column and path.
    ///
    /// # Example
    /// ```
    /// use drystone::scene::Scene;
    /// let scene = Scene::from_json(r#"{ "drystone": 1,
    ///     "ground": [{ "polygon": [[-1, -1], [4, -1], [4, 0], [-1, 0]] }],
    ///     "blocks": [{ "id": "a", "polygon": [[0, 0], [2, 0], [2, 1], [0, 1]], "density": 3 }] }"#)?;
    /// assert!((scene.blocks[0].weight - 3.0 * 2.0 * 9.81).abs() < 1e-12);
    ///
    /// let problems = Scene::from_json(r#"{ "drystone": 1, "blokcs": [] }"#).unwrap_err();
    /// assert!(problems.to_string().contains("the nearest known key is `blocks`"));
    /// # Ok::<(), drystone::scene::Problems>(())
    /// ```
    pub fn from_json(text: &str) -> Result<Scene, Problems> {
        Scene::from_json_within(text, None)
    }

    /// Reads and checks a scene file, with a contact tolerance (metres, at least 0) in place of the file's own.
    ///
    /// # Errors
    /// As [`Scene::from_json`].
    pub fn from_json_within(text: &str, tolerance: Option<f64>) -> Result<Scene, Problems> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        match format::parse(text) {
            Ok(mut file) => {
                file.contact_tolerance = tolerance.or(file.contact_tolerance);
                resolve(&file, Doubt::default())
                    .map_err(|findings| Problems::place(findings, Some(&Source::parse(text))))
            }
            Err(refusal) if refusal.kind != RefusalKind::Data => {
                Err(syntax::problem(text, &refusal))
            }
            Err(refusal) => match format::parse_any(text) {
                Err(deeper) => Err(syntax::problem(text, &deeper)),
                Ok(()) => Err(misfits(text, &refusal)),
            },
        }
    }

    /// Reads and checks a scene file as it lies on a disk.
    ///
    /// # Errors
    /// As [`Scene::from_json`], and bytes that are no UTF-8.
    pub fn from_slice(bytes: &[u8]) -> Result<Scene, Problems> {
        Scene::from_slice_within(bytes, None)
    }

    /// Reads and checks a scene file as it lies on a disk, with a contact tolerance (metres, at least 0) in place of the
    /// file's own.
    ///
    /// # Errors
    /// As [`Scene::from_slice`].
    pub fn from_slice_within(bytes: &[u8], tolerance: Option<f64>) -> Result<Scene, Problems> {
        let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
        match std::str::from_utf8(bytes) {
            Ok(text) => Scene::from_json_within(text, tolerance),
            Err(error) => Err(syntax::not_utf8(bytes, error.valid_up_to())),
        }
    }

    /// Checks a scene made in code.
    ///
    /// # Errors
    /// Everything that is wrong with it, each with its path.
    ///
    /// # Example
    /// ```
    /// use drystone::scene::{Scene, format::{BlockEntry, SceneFile}};
    /// let block = BlockEntry { polygon: Some(vec![[0.0, 0.0], [3.0, 0.0], [0.0, 1.0]]), ..BlockEntry::default() };
    /// let scene = Scene::new(SceneFile { blocks: vec![block], density: Some(2.0), ..SceneFile::default() })?;
    /// assert_eq!(scene.blocks[0].id, "1");
    /// # Ok::<(), drystone::scene::Problems>(())
    /// ```
    pub fn new(file: SceneFile) -> Result<Scene, Problems> {
        resolve(&file, Doubt::default()).map_err(|findings| Problems::place(findings, None))
    }
}

/// The problems of a text that is JSON but not of the right types.
fn misfits(text: &str, refusal: &format::Refusal) -> Problems {
    let source = Source::parse(text);
    let checked = source
        .root
        .as_ref()
        .map(|root| expectation::check(&source, root, &format::expected()));
    let Some(checked) = checked.filter(|c| !c.findings.is_empty()) else {
        // The two readers disagree: the first one's words are right, if less kind.
        let byte = source.byte(refusal.line, refusal.column);
        return Problems::of_text(
            &source,
            byte..byte,
            problem::entry::reader_says(&refusal.words),
        );
    };
    let mut findings = checked.findings;
    if let Ok(file) = format::parse(&checked.text)
        && let Err(more) = resolve(&file, checked.doubt)
    {
        findings.extend(more);
    }
    Problems::place(findings, Some(&source))
}
