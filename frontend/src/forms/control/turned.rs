//! What was turned or typed in a control and is not saved yet: a change of the connector as it was when that began.

use crate::browser;
use crate::desk::{Desk, EditSession};
use crate::focus;
use crate::parts::DeskHold;
use behaviour::{Connector, Id, Kind, Operation, Procedure, Record, RecordId};
use leptos::html::Div;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{Element, FocusEvent, Node};

/// After so long without another press, what was turned is saved, in milliseconds.
const SAVE_AFTER_MS: i32 = 500;
/// Where a connector is turned; what stands beside it is said of it, or asks for it.
const TURNS: &str = ".control-row, .slider";

/// What was turned and is not saved yet. A copy is the same.
#[derive(Clone, Copy)]
pub(super) struct Turned {
    pub(super) desk: DeskHold,
    id: StoredValue<Id>,
    root: NodeRef<Div>,
    operation: RwSignal<Option<Operation>>,
    presses: StoredValue<u32>,
    session: StoredValue<EditSession>,
    /// Whether one only reads: for who may not edit, and while somebody else is editing it.
    pub(super) reads: Memo<bool>,
}

impl Turned {
    pub(super) fn new(
        desk: DeskHold,
        (id, root): (Id, NodeRef<Div>),
        reads: impl Fn() -> bool + Send + Sync + 'static,
    ) -> Self {
        let session = desk.desk().document.session(RecordId::new(Kind::Connector, &id));
        let turned = Self {
            desk,
            id: StoredValue::new(id),
            root,
            operation: RwSignal::new(None),
            presses: StoredValue::new(0),
            session: StoredValue::new(session.clone()),
            reads: Memo::new(move |_| reads()),
        };
        // What waits when the control goes away is saved too, also where somebody removed what it turns.
        let (late, id, operation) = (desk.desk(), turned.id.get_value(), turned.operation);
        on_cleanup(move || {
            if let Some(operation) = operation.try_get_untracked().flatten().filter(|_| session.is_here()) {
                save(&late, &id, &session, operation);
            }
            late.document.forget_draft(&RecordId::new(Kind::Connector, &id));
            session.end();
        });
        turned
    }

    /// The keyboard came: what is turned here is locked.
    pub(super) fn came(self, event: &FocusEvent) {
        let target = event.target().and_then(|target| target.dyn_into::<Element>().ok());
        let turns = target.is_some_and(|target| target.closest(TURNS).ok().flatten().is_some());
        if turns && !self.reads.get_untracked() {
            self.session.with_value(EditSession::begin);
        }
    }

    /// The keyboard left: what waits is saved, and others may edit it.
    pub(super) fn left(self, event: &FocusEvent) {
        // What goes out of the page loses the keyboard last; what waited was saved before.
        if self.presses.try_get_value().is_none() {
            return;
        }
        let to = event.related_target().and_then(|to| to.dyn_into::<Node>().ok());
        if !self.has(to.as_ref()) {
            self.save();
            self.session.with_value(EditSession::end);
        }
    }

    fn record(self) -> RecordId {
        self.id.with_value(|id| RecordId::new(Kind::Connector, id))
    }

    fn has(self, node: Option<&Node>) -> bool {
        self.root.get_untracked().is_some_and(|root| root.contains(node) && node.is_some())
    }

    /// As it would be saved: what was turned last, else what is there. Reactive.
    pub(super) fn now(self, record: Memo<Connector>) -> Operation {
        self.operation.get().unwrap_or_else(|| record.read().operation.clone())
    }

    pub(super) fn body(self, record: Memo<Connector>) -> String {
        match self.now(record).procedure() {
            Some(Procedure::Body { body, .. }) => body.clone(),
            Some(Procedure::Helper(_)) | None => String::new(),
        }
    }

    /// Somebody types, and nothing is known of it yet.
    pub(super) fn typing(self) {
        self.session.with_value(EditSession::typing);
    }

    /// Another operation, saved at once or a moment after the last press.
    pub(super) fn turn(self, operation: Operation, at_once: bool) {
        if self.reads.get_untracked() {
            return;
        }
        self.typing();
        if let Some(Record::Connector(seen)) = self.session.with_value(EditSession::seen) {
            let drafted = Connector { operation: operation.clone(), ..seen };
            self.desk.desk().document.draft(self.record(), Record::Connector(drafted));
        }
        self.operation.set(Some(operation));
        let mine = self.presses.get_value() + 1;
        self.presses.set_value(mine);
        let rests = move || self.presses.try_get_value() == Some(mine);
        let save = move || {
            if rests() {
                self.save();
            }
        };
        if at_once { save() } else { browser::after(SAVE_AFTER_MS, save) }
    }

    pub(super) fn save(self) {
        if let Some(operation) = self.operation.get_untracked() {
            self.operation.set(None);
            let session = self.session.get_value();
            save(&self.desk.desk(), &self.id.get_value(), &session, operation);
            self.desk.desk().document.forget_draft(&self.record());
            // Where buttons take no keyboard, nobody leaves.
            if !self.has(focus::active().as_deref().map(AsRef::as_ref)) {
                session.end();
            }
        }
    }
}

fn save(desk: &Desk, id: &Id, session: &EditSession, operation: Operation) {
    let Some(Record::Connector(seen)) = session.seen() else { return };
    if seen.operation == operation {
        return;
    }
    let (inputs, after) = (seen.inputs.clone(), desk.clone());
    desk.document.edit_connector((id, seen), operation, inputs, None, move |answer| after.say_refusal(answer));
}
