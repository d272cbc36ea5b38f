//! Every sentence of the page, in English where it is made; `language` has the others.

/// Sentences without holes, a function each.
macro_rules! sentences {
    ($($name:ident: $text:literal;)*) => {
        $(pub(crate) fn $name() -> &'static str { $crate::words::language::said($text) })*
    };
}

/// A sentence with holes, each with a name, in the language of the page.
macro_rules! say {
    (@of $name:ident) => { $name };
    (@of $name:ident $value:expr) => { $value };
    ($text:literal $(, $name:ident $(= $value:expr)?)* $(,)?) => {
        match $crate::words::language::told($text) {
            Some(told) => $crate::words::language::fill(told, &[$((stringify!($name), &say!(@of $name $($value)?))),*]),
            None => format!($text, $($name = say!(@of $name $($value)?)),*),
        }
    };
}

#[cfg(test)]
mod complete_tests;
mod en;
pub(crate) mod language;
#[cfg(test)]
mod others_tests;

pub(crate) use en::*;
pub(crate) use language::translated;
