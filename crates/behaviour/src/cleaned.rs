//! Texts without control characters, before anybody sees or saves them: word processors put a vertical tab where
//! Shift+Enter was pressed, and neither a browser nor XML shows one.

use crate::{Change, Procedure, Record, TileAction, Value, without_control};
use std::borrow::Cow;

impl Change {
    /// The change with its texts as they are kept. Names are not touched: the rules say what is wrong with one.
    pub(crate) fn cleaned(mut self) -> Self {
        self.edits.iter_mut().filter_map(|edit| edit.after.as_mut()).for_each(clean);
        self
    }
}

fn clean(record: &mut Record) {
    match record {
        Record::Note(note) => keep(&mut note.text, '\n'),
        Record::Helper(helper) => {
            keep(&mut helper.says, '\n');
            keep(&mut helper.body, ' ');
        }
        Record::Stream(stream) => stream.params.values_mut().for_each(keep_value),
        Record::Connector(connector) => {
            // A line end within a text of a procedure would break it.
            if let Some(Procedure::Body { body, .. }) = connector.operation.procedure_mut() {
                keep(body, ' ');
            }
        }
        Record::Pad(pad) => pad.tiles.values_mut().for_each(|tile| match &mut tile.does {
            TileAction::Hand { params, value, .. } => params.values_mut().chain([value]).for_each(keep_value),
            TileAction::Pretend { value, .. } => keep_value(value),
            TileAction::Word { .. } => {}
        }),
        Record::Settings(_) | Record::Place(_) | Record::Group(_) => {}
    }
}

fn keep(text: &mut String, line_end: char) {
    if let Cow::Owned(cleaned) = without_control(text, line_end) {
        *text = cleaned;
    }
}

fn keep_value(value: &mut Value) {
    if let Some(Cow::Owned(cleaned)) = value.as_text().map(|text| without_control(text, '\n')) {
        *value = Value::text(cleaned);
    }
}
