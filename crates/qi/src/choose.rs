//! Choosing between methods of one name by the types of the arguments.

use crate::meta::{MetaMethod, MetaObject};
use crate::signature::ValueSignature;
use crate::value::{Value, fit};

/// The method that takes the arguments best.
#[derive(Debug, Clone, Copy)]
pub struct ChosenMethod<'a> {
    /// The method that was chosen.
    pub method: &'a MetaMethod,
    /// The score of the fit of all arguments together; see [`crate::fit`].
    pub score: u32,
}

impl MetaObject {
    /// The method of this name that takes these arguments best; of equals, the one with the lowest number.
    pub fn choose(&self, name: &str, arguments: &[Value]) -> Option<ChosenMethod<'_>> {
        let named = self.methods.iter().filter(|method| method.name == name);
        let fitting = named.filter_map(|method| Some(ChosenMethod { method, score: score(method, arguments)? }));
        fitting.reduce(|best, next| {
            let better = (next.score, best.method.uid) > (best.score, next.method.uid);
            if better { next } else { best }
        })
    }

    /// The methods of this name, as `name(parameters)`.
    pub fn candidates(&self, name: &str) -> Vec<String> {
        let named = self.methods.iter().filter(|method| method.name == name);
        named.map(|method| format!("{name}{}", method.parameters)).collect()
    }
}

fn score(method: &MetaMethod, arguments: &[Value]) -> Option<u32> {
    match &method.parameters {
        ValueSignature::Tuple(fields, _) if fields.len() == arguments.len() => {
            let scores = arguments.iter().zip(fields).map(|(argument, field)| fit(argument, field));
            scores.sum::<Option<u32>>()
        }
        // It takes anything, and loses against whatever says what it takes.
        ValueSignature::Dynamic => Some(0),
        _ => None,
    }
}
