//! The arguments of a sentence as they are written: `"{by} is editing {what}.", by = name`.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::parse::{Parse, ParseStream};
use syn::{Expr, Ident, LitStr, Member, Token};

/// An argument that is handed in for a hole.
pub(crate) struct Argument {
    /// The name of the hole, if it is said.
    pub(crate) name: Option<String>,
    /// The code of its value.
    pub(crate) value: TokenStream,
}

/// A sentence with its arguments.
pub(crate) struct SaidSentence {
    pub(crate) text: LitStr,
    pub(crate) arguments: Vec<Argument>,
}

/// A key, and the sentence under it.
pub(crate) struct PhraseCall {
    pub(crate) key: Expr,
    pub(crate) said: SaidSentence,
}

impl Parse for PhraseCall {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let key = input.parse()?;
        input.parse::<Token![,]>()?;
        Ok(Self { key, said: input.parse()? })
    }
}

impl Parse for SaidSentence {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let text = input.parse()?;
        let mut arguments = Vec::new();
        while !input.is_empty() {
            input.parse::<Token![,]>()?;
            if !input.is_empty() {
                arguments.push(input.parse()?);
            }
        }
        Ok(Self { text, arguments })
    }
}

impl Parse for Argument {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let is_named = input.peek(Ident) && input.peek2(Token![=]) && !input.peek2(Token![==]);
        let name = if is_named { Some(input.parse::<Ident>()?.to_string()) } else { None };
        if is_named {
            input.parse::<Token![=]>()?;
        }
        let value = if input.peek(Token![.]) { of_field(input)? } else { input.parse::<Expr>()?.into_token_stream() };
        Ok(Self { name, value })
    }
}

/// `.0` and `.name` are fields of the variant, and what follows is done to them.
fn of_field(input: ParseStream) -> syn::Result<TokenStream> {
    input.parse::<Token![.]>()?;
    let field = bound(&input.parse()?);
    let mut rest = TokenStream::new();
    while !input.is_empty() && !input.peek(Token![,]) {
        rest.extend([input.parse::<proc_macro2::TokenTree>()?]);
    }
    Ok(syn::parse2::<Expr>(quote!(#field #rest))?.into_token_stream())
}

/// The name that a field has where its variant is said.
pub(crate) fn bound(field: &Member) -> Ident {
    match field {
        Member::Named(name) => name.clone(),
        Member::Unnamed(nth) => quote::format_ident!("_{}", nth.index),
    }
}
