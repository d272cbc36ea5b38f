//! A small number that tells whether two files run alike.

use super::{BehaviourFile, FileConnector, FileHelper, FileStream};
use crate::Engine;

/// FNV-1a with 32 bits (Fowler, Noll, Vo; RFC 9923).
struct Fnv(u32);

impl Fnv {
    fn bytes(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u32::from(*byte)).wrapping_mul(16_777_619);
        }
    }

    /// A text and its end, which no text contains.
    fn text(&mut self, text: &str) {
        self.bytes(text.as_bytes());
        self.bytes(&[0xff]);
    }

    /// Texts and how many there are.
    fn texts<'a>(&mut self, texts: impl IntoIterator<Item = &'a String>) {
        let mut count = 0_u64;
        for text in texts {
            self.text(text);
            count += 1;
        }
        self.number(Some(count));
    }

    fn number(&mut self, number: Option<u64>) {
        self.bytes(&[u8::from(number.is_some())]);
        self.bytes(&number.unwrap_or_default().to_le_bytes());
    }

    fn helper(&mut self, helper: &FileHelper) {
        let FileHelper { name, params, body, says: _, takes: _, gives: _ } = helper;
        self.text(name);
        self.texts(params);
        self.text(body);
    }

    fn stream(&mut self, stream: &FileStream) {
        let FileStream { id, kind, name, device, params, resources, priority, hold_ms } = stream;
        self.texts([id, name]);
        self.bytes(&[*kind as u8]);
        self.texts(device);
        for (param, value) in params.iter().flatten() {
            self.text(param);
            self.text(&value.to_string());
        }
        self.number(resources.as_ref().map(|resources| resources.len() as u64));
        self.texts(resources.iter().flatten());
        self.number(priority.map(i64::cast_unsigned));
        self.number(*hold_ms);
    }

    fn connector(&mut self, connector: &FileConnector) {
        let FileConnector { id, operation, inputs, output, body, args, helper, period_ms, start } = connector;
        self.texts([id, operation, output]);
        self.texts(inputs);
        self.texts(body);
        self.texts(args.iter().flatten());
        self.texts(helper);
        self.number(*period_ms);
        start.iter().for_each(|start| self.text(&start.to_string()));
    }
}

impl BehaviourFile {
    /// A fingerprint of all that a run depends on: streams, connectors, helpers, robot and engine. Names and tags of
    /// behaviours, notes, groups, places and what helpers are for change nothing. Files that run differently have different
    /// fingerprints but for one case in four thousand million.
    #[must_use]
    pub fn fingerprint(&self) -> u32 {
        let mut fnv = Fnv(2_166_136_261);
        fnv.texts(&self.robot);
        fnv.number(match self.engine {
            Some(Engine::Frame { frame_ms }) => Some(frame_ms),
            Some(Engine::Event) | None => None,
        });
        self.helpers.iter().for_each(|helper| fnv.helper(helper));
        self.streams.iter().for_each(|stream| fnv.stream(stream));
        self.connectors.iter().for_each(|connector| fnv.connector(connector));
        fnv.0
    }
}

#[cfg(test)]
mod tests {
    use crate::{Behaviour, BehaviourFile, Helper, Id, Kind, Place, Record, RecordId};

    #[test]
    fn only_what_runs_counts() {
        let text = r#"{"format":"rrp-behaviour/1","name":"x","helpers":[{"name":"h","params":["a"],"body":"a"}],
            "streams":[{"id":"ball","kind":"sensor","name":"Ball"}],"connectors":[]}"#;
        let file: BehaviourFile = serde_json::from_str(text).unwrap();
        let print = file.fingerprint();
        let mut renamed = file.clone();
        renamed.name = "y".to_owned();
        renamed.tags = vec!["group b".to_owned()];
        renamed.helpers[0].says = "the same".to_owned();
        renamed.layout.clear();
        assert_eq!(renamed.fingerprint(), print);
        let mut edited = file.clone();
        edited.helpers[0].body = "a + 1".to_owned();
        assert_ne!(edited.fingerprint(), print);
        let mut edited = file;
        edited.streams[0].name = "Balls".to_owned();
        assert_ne!(edited.fingerprint(), print);
    }

    #[test]
    fn a_file_of_records_has_the_same_wherever_its_streams_stand() {
        let mut behaviour = Behaviour::default();
        let helpers: [&Helper; 0] = [];
        let before = BehaviourFile::of(&behaviour, &helpers).fingerprint();
        let place = RecordId::new(Kind::Place, &Id::new("ball").unwrap());
        behaviour.records.insert(place, Record::Place(Place { x: 1.0, y: 2.0 }));
        assert_eq!(BehaviourFile::of(&behaviour, &helpers).fingerprint(), before);
    }
}
