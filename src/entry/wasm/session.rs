//! [`Session`]: keeps a scene with its analysis, so that the verdict, the result and most figures need only one
//! analysis.

use wasm_bindgen::prelude::wasm_bindgen;

use super::Refusal;
use super::request::{PageArgs, ResultArgs};
use crate::entry::request::read_json;
use crate::mechanics::analysis::Analysis;
use crate::products::result::word;

/// A scene that is changed often, for example while a block is dragged. It is analysed once for each change. The
/// verdict, the result and the figures come from this analysis, unless a figure needs results that it lacks.
#[wasm_bindgen]
#[derive(Clone, Debug)]
pub struct Session {
    args: ResultArgs,
    analysis: Analysis,
}

#[wasm_bindgen]
impl Session {
    /// Analyses a first scene with the options of `check`. Later scenes get the same options.
    ///
    /// # Errors
    /// Returns the problems of the scene, or a message about an option that is not valid.
    #[wasm_bindgen(constructor)]
    pub fn new(scene: &str, options: Option<String>) -> Result<Session, Refusal> {
        let args = read_json(options.as_deref(), ResultArgs::read)?;
        let analysis = args.what.analysis(scene)?;
        Ok(Session { args, analysis })
    }

    /// Replaces the scene and analyses it. Returns the worst verdict of its frames; from best to worst: stable,
    /// undecided, unstable.
    ///
    /// # Errors
    /// Returns the problems of the scene, or a message about an option that does not fit the scene, such as a frame
    /// that does not exist. The session then keeps the previous scene.
    pub fn set(&mut self, scene: &str) -> Result<String, Refusal> {
        self.analysis = self.args.what.analysis(scene)?;
        Ok(self.verdict())
    }

    /// Returns the worst verdict of all frames; from best to worst: stable, undecided, unstable.
    pub fn verdict(&self) -> String {
        word(self.analysis.verdict()).to_owned()
    }

    /// Returns the result of the analysis as JSON, as the function `check` does.
    pub fn result(&self) -> String {
        self.args.written(&self.analysis)
    }

    /// Draws a figure of the scene as SVG. `options` are those of the function `figure`; `frame`, `broken`, `accuracy`,
    /// `wedging`, `contact_tolerance` and `time_limit` have no effect. If the figure needs results that the session
    /// lacks, the scene is analysed again with the default accuracy and without a time limit.
    ///
    /// # Errors
    /// Returns a message about an option that is not valid.
    pub fn figure(&self, options: Option<String>) -> Result<String, Refusal> {
        read_json(options.as_deref(), PageArgs::read)?.drawn(&self.analysis)
    }
}
