//! The name and the settings of a selected stream, changed where they stand: one change each.

use crate::desk::{Dialog, EditSession};
use crate::escape;
use crate::fields::{ParamFields, ParamForm, TextField};
use crate::forms::words;
use crate::icons::Icon;
use crate::parts::{DeskHold, hold, may_edit};
use crate::reasons::Unfilled;
use behaviour::{Id, Kind, NAME_MAX_CHARS, Record, RecordId, Stream};
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{FocusEvent, KeyboardEvent, Node};

/// The fields of one stream. A copy is the same.
#[derive(Clone, Copy)]
struct StreamFields {
    desk: DeskHold,
    id: StoredValue<Id>,
    record: Memo<Stream>,
    name: RwSignal<String>,
    /// The name as it is saved.
    named: StoredValue<String>,
    form: RwSignal<Option<ParamForm>>,
    refusal: RwSignal<Option<String>>,
    /// A change is under way; what is chosen meanwhile follows it.
    busy: StoredValue<bool>,
    again: StoredValue<bool>,
    session: StoredValue<EditSession>,
    /// Moves when the keyboard leaves: what others saved meanwhile is shown then.
    left: RwSignal<u32>,
}

/// The fields of a stream; not while its dialog is open, which has them too.
#[component]
pub(super) fn Settings(id: Id, record: Memo<Stream>) -> impl IntoView {
    let desk = hold();
    let name = record.with_untracked(|stream| stream.name.clone());
    let key = RecordId::new(Kind::Stream, &id);
    let session = desk.desk().document.session(key.clone());
    let editor = Memo::new(move |_| desk.desk().document.editor_of(&key));
    let dialog = Dialog::EditStream(id.clone());
    let elsewhere = Memo::new(move |_| desk.desk().dialog.read().as_ref() == Some(&dialog));
    let fields = StreamFields {
        desk,
        id: StoredValue::new(id),
        record,
        name: RwSignal::new(name.clone()),
        named: StoredValue::new(name),
        form: RwSignal::new(None),
        refusal: RwSignal::new(None),
        busy: StoredValue::new(false),
        again: StoredValue::new(false),
        session: StoredValue::new(session),
        left: RwSignal::new(0),
    };
    follow(fields);
    on_cleanup(move || fields.close());
    let came = move |_| fields.session.with_value(EditSession::begin);
    let left = move |event: FocusEvent| {
        let own = event.current_target().and_then(|own| own.dyn_into::<Node>().ok());
        let to = event.related_target().and_then(|to| to.dyn_into::<Node>().ok());
        if !own.is_some_and(|own| to.is_some() && own.contains(to.as_ref())) {
            fields.leave();
        }
    };
    let reads = move || !may_edit(desk) || editor.read().is_some();
    let key = move |event: KeyboardEvent| {
        if escape::ends(&event, || fields.take_back()) {
            event.stop_propagation();
        }
    };
    view! {
        <Show when=move || !elsewhere.get()>
            <fieldset class="held-fields settings" disabled=reads on:change=move |_| fields.save() on:keydown=key
                on:focusin=came on:focusout=left on:input=move |_| fields.session.with_value(EditSession::typing)>
                <TextField label=words::stream_name_label() value=fields.name max_chars=NAME_MAX_CHARS />
                {move || fields.form.get().map(|form| view! { <ParamFields form side_by_side=true /> })}
            </fieldset>
            {move || editor.get().map(|editor| view! {
                <p class="held-line" style=("--person", format!("var(--people-{})", editor.color))>
                    <Icon name="lock" />{words::is_editing(&editor.name)}
                </p>
            })}
            <p class="refusal" role="alert" hidden=move || fields.refusal.read().is_none()>{move || fields.refusal.get()}</p>
        </Show>
    }
}

/// Shows what is saved, from whoever it comes, wherever nobody has written anything else.
fn follow(fields: StreamFields) {
    let device = Memo::new(move |_| fields.record.with(|stream| (stream.kind, stream.device.clone())));
    // Either may still run when the panel has just gone.
    Effect::new(move |_| {
        let Some((kind, device)) = device.try_get() else { return };
        let Some(record) = fields.record.try_get_untracked() else { return };
        let device = device.and_then(|device| robot::device(kind, &device).ok());
        let form = |device| ParamForm::new(device, &record.params);
        fields.form.set(device.filter(|device| !device.params.is_empty()).map(form));
    });
    Effect::new(move |_| {
        let Some((stream, named)) = fields.record.try_get().zip(fields.named.try_get_value()) else { return };
        fields.left.track();
        // A field that has the keyboard is its owner's: what others save is shown when they leave.
        let is_seen = |session: &EditSession| {
            !session.is_begun() || session.seen().is_some_and(|seen| seen == Record::Stream(stream.clone()))
        };
        if !fields.session.with_value(is_seen) {
            return;
        }
        if fields.name.get_untracked() == named {
            fields.name.set(stream.name.clone());
        }
        fields.named.set_value(stream.name);
        fields.form.with_untracked(|form| form.iter().for_each(|form| form.follow(&stream.params)));
    });
    // What came too late waits beside what somebody else saved, and is typed here no more.
    Effect::new(move |_| {
        let id = fields.id.try_get_value();
        if id.and_then(|id| fields.desk.if_there()?.document.conflict_about(&id)).is_some() {
            fields.leave();
            fields.show_saved();
        }
    });
}

impl StreamFields {
    fn show_saved(self) {
        let Some(stream) = self.record.try_get_untracked() else { return };
        self.named.set_value(stream.name);
        self.form.with_untracked(|form| form.iter().for_each(|form| form.follow(&stream.params)));
        self.take_back();
    }

    fn take_back(self) {
        let Some(named) = self.named.try_get_value() else { return };
        self.refusal.set(None);
        self.name.set(named);
        self.form.with_untracked(|form| form.iter().for_each(ParamForm::take_back));
    }

    /// The keyboard left, and with it what is typed here is somebody else's again.
    fn leave(self) {
        // What goes out of the page loses the keyboard last, and was closed before.
        let Some(session) = self.session.try_get_value() else { return };
        session.end();
        self.busy.set_value(false);
        self.left.update(|left| *left += 1);
    }

    /// These fields go. What is typed under somebody who removed the stream is kept.
    fn close(self) {
        let Some(session) = self.session.try_get_value() else { return };
        let document = self.desk.desk().document;
        let is_removed = self.id.with_value(|id| document.stream(id).is_none());
        if session.is_begun() && session.is_here() && is_removed {
            self.save();
        }
        session.end();
    }

    /// The stream as it is written here, on top of what its author saw.
    fn written(self, seen: &Stream) -> Result<Stream, Unfilled> {
        let mut stream = seen.clone();
        self.name.get_untracked().trim().clone_into(&mut stream.name);
        if stream.name.is_empty() {
            return Err(Unfilled::Name);
        }
        if let Some(form) = self.form.get_untracked() {
            let given = form.read()?;
            // What is as the catalogue has it need not be said.
            let chosen = given
                .into_iter()
                .filter(|(name, value)| stream.params.contains_key(name) || !form.is_default(name, value));
            stream.params = chosen.collect();
        }
        Ok(stream)
    }

    fn save(self) {
        // A field that goes out of the page tells of its change once more, when these are gone: they were closed before.
        let Some(busy) = self.busy.try_get_value() else { return };
        if busy && self.desk.desk().document.can_save() {
            return self.again.set_value(true);
        }
        self.refusal.set(None);
        let Some(Record::Stream(seen)) = self.session.with_value(EditSession::seen) else { return };
        let stream = match self.written(&seen) {
            Ok(stream) => stream,
            Err(why) => return self.refusal.set(Some(words::unfilled(&why))),
        };
        if stream == seen {
            return;
        }
        let document = self.desk.desk().document;
        self.busy.set_value(document.can_save());
        let desk = self.desk.desk();
        document.edit_stream((&self.id.get_value(), seen), stream, move |answer| {
            self.busy.try_set_value(false);
            match answer {
                Err(no) if self.refusal.is_disposed() => desk.say(&words::told_by(&no), true),
                Err(no) => self.refusal.set(Some(words::told_by(&no))),
                Ok(()) => {}
            }
            if self.again.try_get_value().unwrap_or_default() {
                self.again.set_value(false);
                self.save();
            }
        });
    }
}
