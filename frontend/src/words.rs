//! Every sentence of the page. One language is one file; a second file with the same names makes a second language.

/// Sentences without holes: a function each, so that a language can be chosen while the page runs.
macro_rules! sentences {
    ($($name:ident: $text:literal;)*) => {
        $(pub(crate) fn $name() -> &'static str { $text })*
    };
}

mod en;

pub(crate) use en::*;
