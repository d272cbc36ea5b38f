//! Reads the holes of English sentences while they are compiled: `phrase!` and `#[derive(Phrased)]` of the crate `phrase`.
//!
//! A sentence is written like a format string. The names of its holes travel with what stands in them, so a hole is a name
//! (`{by}`), or is numbered in its order (`{}`). What has a form (`{ms:?}`) travels as a text.
#![warn(missing_docs)]

mod english;
mod faults;
mod variants;

use english::{Argument, English};
use faults::SentenceFault;
use proc_macro::{Delimiter, TokenStream, TokenTree};
use std::fmt::Display;

/// Makes a `Phrase` of its key and its English: `phrase!("Refusal.Locked", "{by} is editing {what}.")`.
/// A hole without an argument is filled by the variable of that name.
#[proc_macro]
pub fn phrase(input: TokenStream) -> TokenStream {
    let mut parts = arguments(input).into_iter();
    let (Some(Argument { code: key, .. }), Some(Argument { code: text, .. })) = (parts.next(), parts.next()) else {
        return compile_error("phrase! takes a key and a sentence");
    };
    let Some(text) = english::unquoted(&text) else { return compile_error(SentenceFault::NoText) };
    let rest: Vec<Argument> = parts.collect();
    let unnamed: Vec<&Argument> = rest.iter().filter(|argument| argument.name.is_none()).collect();
    let value = |name: &str| match name.parse::<usize>() {
        Ok(nth) => unnamed.get(nth).map(|argument| argument.code.clone()),
        Err(_) => Some(name.to_owned()),
    };
    let made = English::read(&text).and_then(|read| read.code(&key, &rest, &value));
    made.map_or_else(compile_error, |code| parsed(&code))
}

/// Makes a `Phrase` of each variant by its `#[error("...")]`, under the key `Enum.Variant`; [`std::fmt::Display`] says it
/// in English.
#[proc_macro_derive(Phrased, attributes(error, from))]
pub fn derive_phrased(input: TokenStream) -> TokenStream {
    variants::implementation(input).map_or_else(compile_error, |code| parsed(&code))
}

fn parsed(code: &str) -> TokenStream {
    code.parse().unwrap_or_else(compile_error)
}

fn compile_error(why: impl Display) -> TokenStream {
    format!("::core::compile_error!({:?})", why.to_string()).parse().unwrap_or_default()
}

/// The parts of a list with commas; of `name = value` both.
fn arguments(input: TokenStream) -> Vec<Argument> {
    let mut parts: Vec<Vec<TokenTree>> = vec![Vec::new()];
    for token in input {
        match &token {
            TokenTree::Punct(punct) if punct.as_char() == ',' => parts.push(Vec::new()),
            _ => {
                if let Some(last) = parts.last_mut() {
                    last.push(token);
                }
            }
        }
    }
    parts.into_iter().filter(|part| !part.is_empty()).map(argument).collect()
}

fn argument(mut tokens: Vec<TokenTree>) -> Argument {
    // A literal out of another macro comes in a group that nobody sees.
    if let [TokenTree::Group(group)] = tokens.as_slice()
        && group.delimiter() == Delimiter::None
    {
        tokens = group.stream().into_iter().collect();
    }
    let is_named = matches!(tokens.as_slice(), [TokenTree::Ident(_), TokenTree::Punct(is), second, ..]
        if is.as_char() == '=' && !matches!(second, TokenTree::Punct(also) if also.as_char() == '='));
    let name = is_named.then(|| tokens.drain(..2).next().map(|name| name.to_string())).flatten();
    Argument { name, code: tokens.into_iter().collect::<TokenStream>().to_string() }
}
