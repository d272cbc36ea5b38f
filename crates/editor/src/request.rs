//! The requests of an editor: few of all that there are, so that a page which brings no more is small.

use protocol::{AnyAnswer, AnyRequest, Refused, Request, RequestAnswer, request};
use serde::Serialize;

macro_rules! requests {
    ($($name:ident,)*) => {
        /// A request of an editor as data. It is written as its fields alone.
        #[derive(Clone, Debug, PartialEq, Serialize)]
        #[serde(untagged)]
        pub enum EditorRequest {$(
            #[doc = concat!("See [`request::", stringify!($name), "`].")]
            $name(request::$name),
        )*}

        impl EditorRequest {
            /// Returns the name of its type.
            #[must_use]
            pub fn name(&self) -> &'static str {
                match self {$(
                    Self::$name(_) => request::$name::NAME,
                )*}
            }
        }

        impl From<EditorRequest> for AnyRequest {
            fn from(request: EditorRequest) -> Self {
                match request {$(
                    EditorRequest::$name(request) => request.into(),
                )*}
            }
        }

        $(
            impl From<request::$name> for EditorRequest {
                fn from(request: request::$name) -> Self {
                    Self::$name(request)
                }
            }
        )*
    };
}

requests! {
    Open,
    Leave,
    Propose,
    TakeBack,
    GoBack,
    BringBack,
    Since,
    History,
    Lock,
    Unlock,
    Typing,
    Present,
    TakeOver,
    AskFor,
    Withdraw,
    HandOver,
}

/// Why there is no answer to what was asked.
#[derive(Clone, Debug, PartialEq)]
pub enum NoAnswer {
    /// The server says no.
    Refused(Refused),
    /// There is no link, or it broke.
    Unreachable,
}

/// Returns the answer that a request has. Another one counts as none.
///
/// # Errors
/// If there is none.
#[inline(never)]
pub fn typed<A: RequestAnswer>(answer: Result<AnyAnswer, NoAnswer>) -> Result<A, NoAnswer> {
    answer.and_then(|any| A::of(any).ok_or(NoAnswer::Unreachable))
}

#[cfg(test)]
mod tests {
    use super::EditorRequest;
    use protocol::{AnyRequest, request};

    #[test]
    fn a_request_is_written_as_its_fields() {
        let (behaviour, op) = ("b".parse().unwrap(), "o".parse().unwrap());
        let all: [EditorRequest; 2] =
            [request::Leave {}.into(), request::TakeBack { behaviour, op, again: true, tokens: Vec::new() }.into()];
        for request in all {
            let fields = serde_json::to_value(&request).unwrap();
            let mut whole = serde_json::to_value(AnyRequest::from(request.clone())).unwrap();
            let name = whole.as_object_mut().unwrap().remove("is").unwrap();
            assert_eq!((fields, name), (whole, request::wire_name(request.name()).into()));
        }
    }
}
