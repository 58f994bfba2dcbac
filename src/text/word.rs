//! [`Word`]: a value that users choose by its name, such as `--fill stress` or `"fill": "stress"`.

/// A value with a name. A user chooses one of a few such values.
pub trait Word: Copy + Send + Sync + 'static {
    /// Returns all values, in the order in which help lists them.
    fn all() -> Vec<Self>;

    /// Returns the name of the value. Words in a name are joined by hyphens.
    fn word(self) -> &'static str;

    /// Returns a line of help; empty if the name says enough.
    fn help(self) -> &'static str {
        ""
    }

    /// Returns the name with underscores, as results write it, if this differs from [`Word::word`].
    fn alias(self) -> Option<&'static str> {
        None
    }

    /// Returns the value with this name. An underscore counts as a hyphen, and capital letters count as small letters.
    fn from_word(word: &str) -> Option<Self> {
        let word = word.replace('_', "-").to_ascii_lowercase();
        Self::all().into_iter().find(|value| value.word() == word)
    }
}

/// Returns the parser of the command line for the name of a value.
#[cfg(feature = "cli")]
pub(crate) fn typed_word<T: Word>() -> impl clap::builder::TypedValueParser<Value = T> {
    use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
    let shown = |value: T| {
        let shown = PossibleValue::new(value.word()).aliases(value.alias());
        if value.help().is_empty() { shown } else { shown.help(value.help()) }
    };
    let values = T::all().into_iter().map(shown);
    PossibleValuesParser::new(values).try_map(|typed| T::from_word(&typed).ok_or("there is no such value"))
}
