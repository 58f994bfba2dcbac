//! [`Refusal`]: why a scene, a drawing or an option was refused, and how JavaScript receives it.

use wasm_bindgen::JsValue;

use crate::mechanics::scene::SceneError;
use crate::products::result::{problem_list, remark_list};
use crate::sources::import::DrawingProblems;

/// Why the input was refused. JavaScript receives an `Error` with this message, whose property `problems` is the list
/// of the problems.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The message, which contains all problems.
    pub(super) message: String,
    /// The problems as a JSON list; empty if an option is not valid.
    pub(super) problems: String,
}

impl Refusal {
    /// Returns the refusal of an option that is not valid. `why` is the message.
    pub(super) fn of_option(why: impl Into<String>) -> Refusal {
        Refusal { message: why.into(), problems: "[]".into() }
    }
}

impl From<SceneError> for Refusal {
    fn from(error: SceneError) -> Refusal {
        Refusal { message: error.to_string(), problems: problem_list(&error.list) }
    }
}

impl From<DrawingProblems> for Refusal {
    fn from(error: DrawingProblems) -> Refusal {
        let messages: Vec<&str> = error.problems.iter().map(|p| p.message.as_str()).collect();
        Refusal { message: messages.join("\n"), problems: remark_list(&error.problems) }
    }
}

impl From<Refusal> for JsValue {
    fn from(refusal: Refusal) -> JsValue {
        let error = js_sys::Error::new(&refusal.message);
        let list = js_sys::JSON::parse(&refusal.problems).unwrap_or_default();
        // Setting a property of a new object cannot fail.
        let _ = js_sys::Reflect::set(&error, &"problems".into(), &list);
        error.into()
    }
}
