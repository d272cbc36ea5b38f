//! Reads the holes of English sentences while they are compiled: `phrase!` and `#[derive(Phrased)]` of the crate `phrase`.
//!
//! A sentence is written like a format string. The names of its holes travel with what stands in them, so a hole is a name
//! (`{by}`), or is numbered in its order (`{}`). What has a form (`{ms:?}`) travels as a text.
#![warn(missing_docs)]

mod arguments;
mod english;
mod variants;

use arguments::PhraseCall;
use english::English;
use proc_macro::TokenStream;
use syn::{DeriveInput, parse_macro_input};

/// Makes a `Phrase` of its key and its English: `phrase!("Refusal.Locked", "{by} is editing {what}.")`.
/// A hole without an argument is filled by the variable of that name.
#[proc_macro]
pub fn phrase(input: TokenStream) -> TokenStream {
    let PhraseCall { key, said } = parse_macro_input!(input as PhraseCall);
    let variable = |name: &str| english::named(name);
    let made = English::read(&said.text).and_then(|read| read.code(&key, &said.arguments, &variable));
    made.unwrap_or_else(syn::Error::into_compile_error).into()
}

/// Makes a `Phrase` of each variant by its `#[error("...")]`, under the key `Enum.Variant`; [`std::fmt::Display`] says it
/// in English.
#[proc_macro_derive(Phrased, attributes(error, from))]
pub fn derive_phrased(input: TokenStream) -> TokenStream {
    let input = parse_macro_input!(input as DeriveInput);
    variants::implementation(&input).unwrap_or_else(syn::Error::into_compile_error).into()
}
