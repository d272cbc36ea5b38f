//! The variants of an enum of faults, and the sentence of each.

use crate::arguments;
use crate::english::{Argument, English, unquoted};
use crate::faults::SentenceFault;
use proc_macro::{Delimiter, Group, TokenStream, TokenTree};
use std::iter::Peekable;

type Tokens = Peekable<proc_macro::token_stream::IntoIter>;

/// The code that says an enum.
pub(crate) fn implementation(input: TokenStream) -> Result<String, SentenceFault> {
    let mut tokens = input.into_iter().peekable();
    let is_enum = tokens.by_ref().any(|token| token.to_string() == "enum");
    let name = tokens.next().filter(|_| is_enum).ok_or(SentenceFault::NoEnum)?.to_string();
    let body = tokens.find_map(|token| braced(&token)).ok_or(SentenceFault::NoVariants)?;
    let mut variants = body.stream().into_iter().peekable();
    let (mut arms, mut froms) = (String::new(), String::new());
    while let Some((said, variant, fields)) = next(&mut variants)? {
        let key = format!("\"{name}.{variant}\"");
        arms.push_str(&arm(&variant, fields.as_ref(), &said, &key)?);
        froms.push_str(&from(&name, &variant, fields.as_ref()));
    }
    Ok(format!(
        "impl ::phrase::Phrased for {name} {{
            #[allow(unused_variables)]
            fn phrase(&self) -> ::phrase::Phrase {{ match self {{ {arms} }} }}
        }}
        ::phrase::shown!({name});
        impl ::std::error::Error for {name} {{}}
        {froms}"
    ))
}

fn braced(token: &TokenTree) -> Option<Group> {
    if let TokenTree::Group(group) = token {
        return (group.delimiter() == Delimiter::Brace).then(|| group.clone());
    }
    None
}

/// The sentence, the name and the fields of the next variant.
fn next(tokens: &mut Tokens) -> Result<Option<(TokenStream, String, Option<Group>)>, SentenceFault> {
    let mut said = None;
    while let Some(token) = tokens.next() {
        match token {
            TokenTree::Punct(_) => {}
            TokenTree::Group(group) => said = said.or_else(|| sentence(&group)),
            TokenTree::Ident(name) => {
                let fields = match tokens.peek() {
                    Some(TokenTree::Group(fields)) => Some(fields.clone()),
                    _ => None,
                };
                if fields.is_some() {
                    tokens.next();
                }
                let said = said.ok_or_else(|| SentenceFault::NoSentence(name.to_string()))?;
                return Ok(Some((said, name.to_string(), fields)));
            }
            TokenTree::Literal(_) => return Err(SentenceFault::Numbered),
        }
    }
    Ok(None)
}

/// Returns the tokens in `[error(...)]`.
fn sentence(attribute: &Group) -> Option<TokenStream> {
    let mut tokens = attribute.stream().into_iter();
    let is_error = tokens.next()?.to_string() == "error";
    match tokens.next()? {
        TokenTree::Group(group) if is_error => Some(group.stream()),
        _ => None,
    }
}

fn arm(variant: &str, fields: Option<&Group>, said: &TokenStream, key: &str) -> Result<String, SentenceFault> {
    let mut parts = arguments(said.clone()).into_iter();
    let text = parts.next().and_then(|text| unquoted(&text.code)).ok_or(SentenceFault::NoText)?;
    let rest: Vec<Argument> = parts.map(|part| Argument { name: part.name, code: bound(&part.code) }).collect();
    let binding = match fields {
        None => String::new(),
        Some(group) if group.delimiter() == Delimiter::Brace => format!("{{ {}, .. }}", names(group).join(", ")),
        Some(group) => {
            let many = arguments(group.stream()).len();
            format!("({})", (0..many).map(|nth| format!("_{nth}")).collect::<Vec<_>>().join(", "))
        }
    };
    let field = |name: &str| Some(if name.parse::<usize>().is_ok() { format!("_{name}") } else { name.to_owned() });
    let made = English::read(&text)?.code(key, &rest, &field)?;
    Ok(format!("Self::{variant}{binding} => {made},"))
}

/// The code that makes the fault of what stands in it, where `#[from]` says so.
fn from(name: &str, variant: &str, fields: Option<&Group>) -> String {
    let mut tokens = fields.into_iter().flat_map(|fields| fields.stream());
    match (tokens.next(), tokens.next()) {
        (Some(TokenTree::Punct(mark)), Some(TokenTree::Group(word)))
            if mark.as_char() == '#' && word.stream().to_string() == "from" =>
        {
            let what: TokenStream = tokens.collect();
            format!("impl From<{what}> for {name} {{ fn from(what: {what}) -> Self {{ Self::{variant}(what) }} }}")
        }
        _ => String::new(),
    }
}

/// The names of fields: each stands before the colon.
fn names(fields: &Group) -> Vec<String> {
    let (mut names, mut last, mut begins) = (Vec::new(), None, true);
    for token in fields.stream() {
        match &token {
            TokenTree::Punct(punct) if punct.as_char() == ',' => begins = true,
            TokenTree::Punct(punct) if punct.as_char() == ':' && begins => {
                names.extend(last.take());
                begins = false;
            }
            TokenTree::Ident(name) => last = Some(name.to_string()),
            _ => {}
        }
    }
    names
}

/// `.0` and `.name` are fields of the variant.
fn bound(code: &str) -> String {
    let code = code.trim();
    let Some(rest) = code.strip_prefix('.') else { return code.to_owned() };
    let rest = rest.trim_start();
    if rest.starts_with(|first: char| first.is_ascii_digit()) { format!("_{rest}") } else { rest.to_owned() }
}
