//! The English of a sentence: its words and its holes.

use crate::arguments::Argument;
use proc_macro2::{Span, TokenStream};
use quote::{ToTokens, quote};
use syn::{Error, Ident, LitStr, Result};

/// One hole.
struct Hole {
    name: String,
    /// True if it takes the next argument.
    in_order: bool,
    /// The form of what stands in it, with its colon.
    form: String,
}

/// A sentence with its holes.
pub(crate) struct English {
    /// The sentence as it travels: `{name}` for each hole.
    text: String,
    holes: Vec<Hole>,
    /// The place where it is written.
    at: Span,
}

impl English {
    /// Reads a sentence as it is written.
    pub(crate) fn read(written: &LitStr) -> Result<Self> {
        let (all, at) = (written.value(), written.span());
        let (mut text, mut holes, mut rest) = (String::new(), Vec::new(), all.as_str());
        while let Some(found) = rest.find(['{', '}']) {
            text.push_str(&rest[..found]);
            let (brace, after) = rest[found..].split_at(1);
            if let Some(after) = after.strip_prefix(brace) {
                text.push_str(brace);
                rest = after;
                continue;
            }
            let hole = after.split_once('}').filter(|_| brace == "{");
            let (hole, after) = hole.ok_or_else(|| Error::new(at, "a hole is not closed"))?;
            let nth = holes.iter().filter(|hole: &&Hole| hole.in_order).count();
            let (made, shown) = hole_of(hole, nth);
            text.push_str(&shown);
            holes.push(made);
            rest = after;
        }
        text.push_str(rest);
        Ok(Self { text, holes, at })
    }

    /// The code that makes the phrase; `field` tells how a name of the sentence is written in code.
    pub(crate) fn code(
        &self,
        key: &impl ToTokens,
        arguments: &[Argument],
        field: &dyn Fn(&str) -> Option<Ident>,
    ) -> Result<TokenStream> {
        let (mut told, mut with) = (Vec::new(), Vec::new());
        for hole in &self.holes {
            if told.contains(&hole.name.as_str()) {
                continue;
            }
            told.push(hole.name.as_str());
            let value = self.value(hole, arguments, field)?;
            let (name, form) = (&hole.name, &hole.form);
            with.push(if form.is_empty() {
                quote!((#name, ::phrase::Phrased::phrase(&(#value))))
            } else {
                let format = format!("{{{form}}}");
                quote!((#name, ::phrase::Phrase::text(::std::format!(#format, #value))))
            });
        }
        let text = &self.text;
        Ok(quote!(::phrase::Phrase::of(#key, #text, ::std::vec![#(#with),*])))
    }

    /// The code of what stands in a hole: its argument, else a field or a variable.
    fn value(&self, hole: &Hole, arguments: &[Argument], field: &dyn Fn(&str) -> Option<Ident>) -> Result<TokenStream> {
        let named = arguments.iter().find(|argument| argument.name.as_deref() == Some(hole.name.as_str()));
        let in_order = || {
            let nth = hole.name.parse::<usize>().ok()?;
            arguments.iter().filter(|argument| argument.name.is_none()).nth(nth)
        };
        if let Some(argument) = named.or_else(in_order) {
            return Ok(argument.value.clone());
        }
        let known = field(&hole.name).filter(|_| !hole.in_order);
        let missing = || Error::new(self.at, format!("the hole {{{}}} has no argument", hole.name));
        Ok(known.ok_or_else(missing)?.into_token_stream())
    }
}

/// A variable of this name where the sentence is said; none if no variable can have it.
pub(crate) fn named(name: &str) -> Option<Ident> {
    syn::parse_str::<Ident>(name).ok().map(|name| Ident::new(&name.to_string(), Span::call_site()))
}

/// Of `name`, `name:?`, `^name` (with a capital letter), `.name` (without its full stop), `name|one|many` (by how many) or nothing; and as it travels.
fn hole_of(hole: &str, nth: usize) -> (Hole, String) {
    let bare = hole.trim_start_matches(['^', '.']);
    let (marks, _) = hole.split_at(hole.len() - bare.len());
    let (bare, forms) = bare.split_once('|').map_or((bare, String::new()), |(bare, forms)| (bare, format!("|{forms}")));
    let (name, form) = bare.split_once(':').map_or((bare, String::new()), |(name, form)| (name, format!(":{form}")));
    let in_order = name.is_empty();
    let name = if in_order { nth.to_string() } else { name.to_owned() };
    let shown = format!("{{{marks}{name}{forms}}}");
    (Hole { name, in_order, form }, shown)
}
