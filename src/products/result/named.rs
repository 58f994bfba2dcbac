//! [`Named`]: a JSON object whose keys are known only at run time.

use serde::{Serialize, Serializer};

/// A list of keys and values that is written as a JSON object. The keys keep their order.
pub(super) struct Named<'a, T>(pub Vec<(&'a str, T)>);

impl<T> Named<'_, T> {
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl<T: Serialize> Serialize for Named<'_, T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}
