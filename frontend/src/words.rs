//! The sentences of the page that several views say, in English where they are made; `language` has the others. What one view
//! alone says stands in a `words.rs` beside it, which hands on these too.

/// Sentences without holes, a function each, of which the name is the key.
macro_rules! sentences {
    ($($name:ident: $text:literal;)*) => {
        $(pub(crate) fn $name() -> &'static str { $crate::words::said!($name: $text) })*
    };
}

/// A sentence without holes by its key, in the language of the page.
macro_rules! said {
    ($key:ident: $text:literal $(,)?) => {
        $crate::words::language::keyed(const { ::phrase::key_of(stringify!($key)) }, $text)
    };
}

/// A sentence with holes by its key, each hole with a name, in the language of the page.
macro_rules! say {
    (@of $name:ident) => { $name };
    (@of $name:ident $value:expr) => { $value };
    ($key:ident: $text:literal $(,)?) => { $crate::words::said!($key: $text).to_owned() };
    ($key:ident: $text:literal $(, $name:ident $(= $value:expr)?)+ $(,)?) => {
        $crate::words::language::fill_keyed(
            const { ::phrase::key_of(stringify!($key)) },
            $text,
            &[$((stringify!($name), &$crate::words::say!(@of $name $($value)?))),+],
        )
    };
}

pub(crate) use {said, say, sentences};

#[cfg(test)]
mod complete_tests;
mod en;
pub(crate) mod language;
#[cfg(test)]
mod others_tests;

pub(crate) use en::*;
pub(crate) use language::{label_of, shown, shown_within};
