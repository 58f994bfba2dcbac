//! [`caption`]: describes a figure in words. The functions that format numbers and lists are those of
//! [`wording`](crate::products::wording).

use super::verdict::word;
use crate::mechanics::analysis::{Analysis, Verdict};
pub use crate::products::wording::number::quantity;
pub(crate) use crate::products::wording::number::{
    FULL_UTILISATION, counted, force, letter, listed, percent, round_below, round_below_in,
};
use crate::products::wording::verdict::reasons;

/// Returns the caption of a figure: the title, followed by the verdict and its reasons for every frame.
///
/// ```
/// use drystone::{Analysis, Scene, figure};
/// let scene = Scene::from_json(r#"{ "drystone": 1, "title": "An overhang",
///     "ground": [{ "polygon": [[0, 0], [2, 0], [2, -1], [0, -1]] }],
///     "blocks": [{ "id": "plank", "polygon": [[1, 0], [5, 0], [5, 1], [1, 1]], "weight": 8 }] }"#)?;
/// let words = figure::caption(&Analysis::new(&scene));
/// assert_eq!(words, "An overhang. It falls: block plank would have to stick to the ground with 8 N.");
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
pub fn caption(analysis: &Analysis) -> String {
    let scene = &analysis.scene;
    let mut sentences = Vec::new();
    if !scene.title.is_empty() {
        sentences.push(format!("{}.", scene.title.trim_end_matches('.')));
    }
    let several = analysis.frames.len() > 1;
    for (number, frame_analysis) in analysis.frames.iter().enumerate() {
        let verdict = word(frame_analysis.verdict);
        let verdict = match frame_analysis.verdict {
            Verdict::Undecided => format!("is {verdict}"),
            _ => verdict.to_owned(),
        };
        let reasons = reasons(scene, frame_analysis);
        let reasons = if reasons.is_empty() { String::new() } else { format!(": {reasons}") };
        let title = &scene.frames[number].title;
        sentences.push(match (several, title.as_str()) {
            (false, _) => format!("It {verdict}{reasons}."),
            (true, "") => format!("({}) It {verdict}{reasons}.", letter(number)),
            (true, title) => format!("({}) {title}: it {verdict}{reasons}.", letter(number)),
        });
    }
    sentences.join(" ")
}
