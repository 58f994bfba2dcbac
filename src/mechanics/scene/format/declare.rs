//! The macros that declare the objects and the words of a scene file, each key once.

/// Declares one kind of JSON object as a struct. Each field is a key. From the declaration follow the struct, its
/// list of keys (`KEYS`), how it is read and written, its JSON Schema, and a method for each key that may be absent.
///
/// - `key: Option<T>` may be absent; a method of the same name sets it. `bare Option<T>` has no such method.
/// - `key: Vec<T>` and `key: Map<T>` may be absent, and are then empty.
/// - `key: required T` must be given.
/// - A name in quotes is the key's name in the file, if it differs from the field's.
/// - Attributes of the JSON Schema, such as a range, stand in brackets after the type.
/// - After `as` stands the function that reads the value, if its type does not say how to read it.
macro_rules! entry {
    ($(#[$meta:meta])* pub struct $name:ident {
        $(
            $(#[$doc:meta])*
            $field:ident $($key:literal)?: $(Option<$option:ty>)? $(bare Option<$bare:ty>)?
            $(Vec<$list:ty>)? $(Map<$map:ty>)? $(required $required:ty)?
            $([$($schema:tt)*])? $(as $how:expr)?
        ),* $(,)?
    }) => {
        #[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        $(#[$meta])*
        #[serde(deny_unknown_fields)]
        #[non_exhaustive]
        pub struct $name {
            $(
                $(#[$doc])*
                $(#[serde(rename = $key)])?
                $(#[cfg_attr(feature = "schema", schemars($($schema)*))])?
                $(pub $field: $required,)?
                $(
                    #[serde(skip_serializing_if = "Option::is_none")]
                    pub $field: Option<$option>,
                )?
                $(
                    #[serde(skip_serializing_if = "Option::is_none")]
                    pub $field: Option<$bare>,
                )?
                $(
                    #[serde(default, skip_serializing_if = "Vec::is_empty")]
                    pub $field: Vec<$list>,
                )?
                $(
                    #[serde(default, skip_serializing_if = "Map::is_empty")]
                    pub $field: Map<$map>,
                )?
            )*
        }

        impl $name {
            /// The names of the keys.
            pub(crate) const KEYS: &[&str] = &[$([$($key,)? stringify!($field)][0]),*];

            $($crate::mechanics::scene::format::declare::setter! { $(#[$doc])* $field $(Option<$option>)? })*
        }

        impl $crate::read::Read for $name {
            fn read<'s>(
                r: &mut $crate::read::Reader<'s>,
                node: &'s $crate::read::Node<'s>,
                at: &$crate::read::Trail<'_>,
            ) -> Option<$name> {
                let fields = r.object(node, at, $name::KEYS)?;
                Some($name {
                    $($field: {
                        let is_required = ![$(stringify!($required),)? ""][0].is_empty();
                        let key = [$($key,)? stringify!($field)][0];
                        r.key(fields, at, key, is_required, $crate::read::how!($($how)?))
                    },)*
                })
            }
        }
    };
}

/// Defines the method that sets a key of the type `Option`; nothing for a key of another type.
macro_rules! setter {
    ($(#[$doc:meta])* $field:ident Option<$type:ty>) => {
        $(#[$doc])*
        pub fn $field(mut self, $field: impl Into<$type>) -> Self {
            self.$field = Some($field.into());
            self
        }
    };
    ($(#[$doc:meta])* $field:ident) => {};
}

/// Declares an enum whose values are words in the file.
macro_rules! word {
    ($(#[$meta:meta])* pub enum $name:ident { $($(#[$doc:meta])* $variant:ident = $word:literal),* $(,)? }) => {
        #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        $(#[$meta])*
        pub enum $name {
            $($(#[$doc])* #[serde(rename = $word)] $variant,)*
        }

        impl $crate::read::Read for $name {
            fn read<'s>(
                r: &mut $crate::read::Reader<'s>,
                node: &'s $crate::read::Node<'s>,
                at: &$crate::read::Trail<'_>,
            ) -> Option<$name> {
                r.choice(node, at, &[$(($word, $name::$variant)),*])
            }
        }
    };
}

pub(super) use {entry, setter, word};
