//! Requests as they are sent.

use editor::EditorRequest;
use protocol::{Request, request};
use serde::Serialize;

/// A request as JSON. Each is written where it is asked, so that code which loads later brings its own; from there on all
/// requests share their code.
pub(crate) struct WrittenRequest {
    name: &'static str,
    fields: String,
}

impl WrittenRequest {
    /// Writes a request.
    #[inline(never)]
    pub(crate) fn of<R: Request>(request: &R) -> Self {
        Self::named(R::NAME, request)
    }

    /// Writes a request of the editor, which is data.
    pub(super) fn of_editor(request: &EditorRequest) -> Self {
        Self::named(request.name(), request)
    }

    fn named(name: &'static str, request: &impl Serialize) -> Self {
        let mut fields = Vec::new();
        // A text that could not be written is no request, and the server says so.
        let _ = request.serialize(&mut serde_json::Serializer::new(&mut fields));
        Self { name, fields: String::from_utf8(fields).unwrap_or_default() }
    }

    /// The message that [`protocol::Ask`] is, with its number and the newest Stop.
    pub(super) fn message(&self, number: u32, stops: Option<u64>) -> String {
        let (name, rest) = (request::wire_name(self.name), self.fields.strip_prefix('{').unwrap_or("}"));
        let comma = if rest == "}" { "" } else { "," };
        let stops = stops.map(|stops| format!(r#""stops":{stops},"#)).unwrap_or_default();
        format!(r#"{{"ask":{number},{stops}"request":{{"is":"{name}"{comma}{rest}}}"#)
    }
}

#[cfg(test)]
mod tests {
    use super::WrittenRequest;
    use behaviour::Id;
    use protocol::{AnyRequest, Ask, Request, request};

    /// Compares what is sent with what the protocol says.
    fn is_as_the_protocol_says<R: Request + Clone>(request: &R) {
        for stops in [None, Some(7_000_001)] {
            let text = WrittenRequest::of(request).message(7, stops);
            let request: AnyRequest = request.clone().into();
            assert_eq!(text, serde_json::to_string(&Ask { stops, ..Ask::new(7, request) }).unwrap());
        }
    }

    #[test]
    fn a_request_is_sent_as_the_protocol_says() {
        let behaviour = Id::new("b").unwrap();
        is_as_the_protocol_says(&request::Tags {});
        is_as_the_protocol_says(&request::Open { behaviour: behaviour.clone() });
        is_as_the_protocol_says(&request::TakeBack {
            behaviour: behaviour.clone(),
            op: behaviour,
            again: true,
            tokens: vec![],
        });
        is_as_the_protocol_says(&request::CallMe { name: "\"Aiko\" {}".to_owned() });
    }
}
