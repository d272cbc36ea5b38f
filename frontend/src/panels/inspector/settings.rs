//! The name and the settings of a selected stream, changed where they stand: one change each.

use crate::desk::Dialog;
use crate::escape;
use crate::fields::{ParamFields, ParamForm, TextField, Unfilled};
use crate::icons::Icon;
use crate::panels::hold::{Hold, hold};
use crate::panels::may::may_edit;
use crate::words;
use behaviour::{Id, Kind, NAME_MAX_CHARS, RecordId, Stream};
use leptos::prelude::*;
use web_sys::KeyboardEvent;

/// The fields of one stream. A copy is the same.
#[derive(Clone, Copy)]
struct Fields {
    desk: Hold,
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
}

/// The fields of a stream; not while its dialog is open, which has them too.
#[component]
pub(super) fn Settings(id: Id, record: Memo<Stream>) -> impl IntoView {
    let desk = hold();
    let name = record.with_untracked(|stream| stream.name.clone());
    let key = RecordId::new(Kind::Stream, &id);
    let editor = Memo::new(move |_| desk.desk().document.editor_of(&key));
    let dialog = Dialog::EditStream(id.clone());
    let elsewhere = Memo::new(move |_| desk.desk().dialog.read().as_ref() == Some(&dialog));
    let fields = Fields {
        desk,
        id: StoredValue::new(id),
        record,
        name: RwSignal::new(name.clone()),
        named: StoredValue::new(name),
        form: RwSignal::new(None),
        refusal: RwSignal::new(None),
        busy: StoredValue::new(false),
        again: StoredValue::new(false),
    };
    follow(fields);
    let reads = move || !may_edit(desk) || editor.read().is_some();
    let key = move |event: KeyboardEvent| {
        if escape::ends(&event, || fields.take_back()) {
            event.stop_propagation();
        }
    };
    view! {
        <Show when=move || !elsewhere.get()>
            <fieldset class="held-fields settings" disabled=reads on:change=move |_| fields.save() on:keydown=key>
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
fn follow(fields: Fields) {
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
        if fields.name.get_untracked() == named {
            fields.name.set(stream.name.clone());
        }
        fields.named.set_value(stream.name);
        fields.form.with_untracked(|form| form.iter().for_each(|form| form.follow(&stream.params)));
    });
}

impl Fields {
    fn take_back(self) {
        self.refusal.set(None);
        self.name.set(self.named.get_value());
        self.form.with_untracked(|form| form.iter().for_each(ParamForm::take_back));
    }

    /// The stream as it is written here.
    fn written(self) -> Result<Stream, Unfilled> {
        let mut stream = self.record.get_untracked();
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
        if self.busy.get_value() && self.desk.desk().document.can_save() {
            return self.again.set_value(true);
        }
        self.refusal.set(None);
        let stream = match self.written() {
            Ok(stream) => stream,
            Err(why) => return self.refusal.set(Some(words::unfilled(&why))),
        };
        let seen = self.record.get_untracked();
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
