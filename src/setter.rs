//! Methods that set a field and give back what they were called on, for types that callers fill and that will grow.
//!
//! Such a type is `#[non_exhaustive]`: from outside it begins with its default.

/// Methods that set a field.
macro_rules! setters {
    ($($field:ident: $type:ty, $doc:literal;)*) => {
        $(
            #[doc = $doc]
            pub fn $field(mut self, $field: $type) -> Self {
                self.$field = $field;
                self
            }
        )*
    };
}

/// Methods that set a field that may be left out.
macro_rules! optional_setters {
    ($($field:ident: $type:ty, $doc:literal;)*) => {
        $(
            #[doc = $doc]
            pub fn $field(mut self, $field: $type) -> Self {
                self.$field = Some($field);
                self
            }
        )*
    };
}

pub(crate) use {optional_setters, setters};
