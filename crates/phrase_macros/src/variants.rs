//! The variants of an enum of faults, and the sentence of each.

use crate::arguments::{SaidSentence, bound};
use crate::english::{English, named};
use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::{Data, DeriveInput, Error, Fields, Ident, Index, Member, Result, Variant};

/// The code that says an enum.
pub(crate) fn implementation(input: &DeriveInput) -> Result<TokenStream> {
    let Data::Enum(data) = &input.data else {
        return Err(Error::new_spanned(input, "only an enum is said by its variants"));
    };
    let name = &input.ident;
    let arms = data.variants.iter().map(|variant| arm(name, variant)).collect::<Result<Vec<_>>>()?;
    let froms = data.variants.iter().filter_map(|variant| from(name, variant));
    Ok(quote! {
        impl ::phrase::Phrased for #name {
            #[allow(unused_variables)]
            fn phrase(&self) -> ::phrase::Phrase {
                match self { #(#arms)* }
            }
        }
        ::phrase::shown!(#name);
        impl ::std::error::Error for #name {}
        #(#froms)*
    })
}

fn arm(name: &Ident, variant: &Variant) -> Result<TokenStream> {
    let (variant_name, key) = (&variant.ident, format!("{name}.{}", variant.ident));
    let said = variant.attrs.iter().find(|attribute| attribute.path().is_ident("error"));
    let said = said.ok_or_else(|| Error::new_spanned(variant, format!("{variant_name} has no sentence")))?;
    let said: SaidSentence = said.parse_args()?;
    let field = |name: &str| name.parse::<usize>().map_or_else(|_| named(name), |nth| Some(format_ident!("_{nth}")));
    let made = English::read(&said.text)?.code(&key, &said.arguments, &field)?;
    let binding = binding(&variant.fields);
    Ok(quote!(Self::#variant_name #binding => #made,))
}

/// The pattern that gives each field its name in the sentence.
fn binding(fields: &Fields) -> TokenStream {
    match fields {
        Fields::Unit => TokenStream::new(),
        Fields::Named(fields) => {
            let names = fields.named.iter().filter_map(|field| field.ident.as_ref());
            quote!({ #(#names),* })
        }
        Fields::Unnamed(fields) => {
            let names = (0..fields.unnamed.len()).map(|nth| bound(&Member::Unnamed(Index::from(nth))));
            quote!((#(#names),*))
        }
    }
}

/// The code that makes the fault of what stands in it, where `#[from]` says so.
fn from(name: &Ident, variant: &Variant) -> Option<TokenStream> {
    let field = variant.fields.iter().next()?;
    field.attrs.iter().find(|attribute| attribute.path().is_ident("from"))?;
    let (variant, what) = (&variant.ident, &field.ty);
    Some(quote! {
        impl From<#what> for #name {
            fn from(what: #what) -> Self { Self::#variant(what) }
        }
    })
}
