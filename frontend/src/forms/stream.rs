//! Edit stream sensor, Edit stream actuator: type, name and the device's parameters.

use super::drafting::{self, Preview};
use super::gone::{self, Back, Gone};
use crate::desk::{Desk, DraftedWhat};
use crate::dialogs::{DialogLock, Holding};
use crate::dialogs::{Feet, Frame, Refused, close};
use crate::fields::{ChoiceOptions, ParamFields, ParamForm, Select, TextField};
use crate::forms::words;
use crate::parts::{DeskHold, hold};
use crate::reasons::Unfilled;
use behaviour::{Id, Kind, RecordId, Stream, StreamKind};
use leptos::prelude::*;
use protocol::Refused;

/// The dialog of one stream.
#[component]
pub(crate) fn EditStream(id: Id) -> impl IntoView {
    let desk = hold();
    let record = desk.desk().document.stream(&id).map(|signals| signals.record.get_untracked());
    match record {
        Some(stream) => view! { <StreamForm id stream /> }.into_any(),
        None => {
            let gone = Callback::new(move |()| close(desk));
            view! { <Frame title=words::edit_ordinary() narrow=true save=gone><p class="dialog-body">{words::stream_gone()}</p></Frame> }
                .into_any()
        }
    }
}

#[derive(Clone, Copy)]
struct StreamDialogFields {
    id: StoredValue<Id>,
    stream: StoredValue<Stream>,
    device: RwSignal<String>,
    name: RwSignal<String>,
    params: RwSignal<Option<ParamForm>>,
    refusal: RwSignal<Option<String>>,
    busy: RwSignal<bool>,
}

#[component]
fn StreamForm(id: Id, stream: Stream) -> impl IntoView {
    let desk = hold();
    let (kind, has_device) = (stream.kind, stream.device.is_some());
    let opened = stream.device.clone();
    let fields = StreamDialogFields {
        id: StoredValue::new(id),
        device: RwSignal::new(stream.device.clone().unwrap_or_default()),
        name: RwSignal::new(stream.name.clone()),
        stream: StoredValue::new(stream),
        params: RwSignal::new(None),
        refusal: RwSignal::new(None),
        busy: RwSignal::new(false),
    };
    Effect::new(move |_| fields.params.set(form_of(fields, kind)));
    let id = fields.id.get_value();
    let held = DialogLock::of(desk, Some(RecordId::new(Kind::Stream, &id)));
    follow_saved(desk, fields, held);
    let about = RecordId::new(Kind::Stream, &id);
    drafting::keep(desk, about, move || drafted(desk, fields).filter(|_| !held.reads.get()));
    let gone = gone::gone(desk, id.clone(), move || gone::has_stream(desk, &id));
    let save = Callback::new(move |()| {
        if gone.get_untracked().is_none() && !held.reads.get_untracked() {
            save(desk, fields);
        }
    });
    let back = Back::new(RecordId::new(Kind::Stream, &fields.id.get_value()), save);
    let says = move || robot::device(kind, &fields.device.read()).map(words::device_says).ok();
    view! {
        <Frame title=title(kind, opened.as_deref()) narrow=true save>
            <Holding held written=fields.name />
            <div class="dialog-body" tabindex=move || held.reads.get().then_some("0")>
              <fieldset class="held-fields" disabled=move || held.reads.get()>
                {has_device.then(|| view! {
                    <div class="field">
                        <Select label=words::type_label() options=Signal::stored(types(kind)) value=fields.device />
                        <span class="faint">{says}</span>
                    </div>
                })}
                <TextField label=words::name() value=fields.name />
                {move || fields.params.get().map(|form| view! { <ParamFields form /> })}
              </fieldset>
                <Refused why=fields.refusal />
                <Gone who=gone written=fields.name back=back />
            </div>
            <Preview />
            <Feet busy=fields.busy nothing=Signal::derive(move || gone.read().is_some() || held.reads.get()) />
        </Frame>
    }
}

/// While somebody else is editing the stream, what is saved of it is shown.
fn follow_saved(desk: DeskHold, fields: StreamDialogFields, held: DialogLock) {
    Effect::new(move |_| {
        let signals = desk.desk().document.stream(&fields.id.get_value()).filter(|_| held.follows.get());
        if let Some(signals) = signals {
            let stream = signals.record.get();
            fields.name.set(stream.name.clone());
            let device = stream.device.clone().unwrap_or_default();
            fields.stream.set_value(stream);
            fields.device.set(device);
        }
    });
}

/// `Tracker settings`, by what it was when this was opened.
fn title(kind: StreamKind, device: Option<&str>) -> String {
    let device = device.and_then(|device| robot::device(kind, device).ok());
    device.map_or_else(|| words::edit_ordinary().to_owned(), |device| words::settings_of(words::device(device)))
}

/// Devices as `(name in files, name in the thesis)`.
fn types(kind: StreamKind) -> ChoiceOptions {
    let option = |device: &'static robot::Device| (device.name.to_owned(), words::device(device).to_owned());
    match kind {
        StreamKind::Sensor => robot::sensors().map(option).collect(),
        StreamKind::Actuator => robot::actuators().map(option).collect(),
        StreamKind::Ordinary => ChoiceOptions::new(),
    }
}

/// The parameters of the chosen device; those of the stream while it is the same device. Reactive.
fn form_of(fields: StreamDialogFields, kind: StreamKind) -> Option<ParamForm> {
    let name = fields.device.get();
    let device = robot::device(kind, &name).ok()?;
    let stream = fields.stream.get_value();
    let given = if stream.device.as_deref() == Some(&name) { stream.params } else { behaviour::Params::new() };
    Some(ParamForm::new(device, &given))
}

/// The stream as it would be saved, if it is another one. Reactive.
fn drafted(desk: DeskHold, fields: StreamDialogFields) -> Option<DraftedWhat> {
    if let Some(form) = fields.params.get() {
        form.track();
    }
    let is_busy = fields.busy.get();
    let (edited, id) = (edited(fields), fields.id.get_value());
    match edited {
        Ok(stream) if stream != fields.stream.get_value() && !is_busy => {
            Some(DraftedWhat::Records(desk.desk().document.stream_drafted(&id, stream)))
        }
        Ok(_) => None,
        Err(why) => Some(DraftedWhat::Unready(words::unfilled(&why))),
    }
}

/// The stream as it is chosen and typed. Reactive.
fn edited(fields: StreamDialogFields) -> Result<Stream, Unfilled> {
    let name = fields.name.get().trim().to_owned();
    if name.is_empty() {
        return Err(Unfilled::Name);
    }
    let mut stream = Stream { name, ..fields.stream.get_value() };
    if let Some(form) = fields.params.get() {
        stream.device = Some(fields.device.get());
        stream.params = form.read()?;
    }
    Ok(stream)
}

fn save(desk: DeskHold, fields: StreamDialogFields) {
    fields.refusal.set(None);
    match untrack(|| edited(fields)) {
        Ok(stream) => {
            let answered = answered(&desk.desk(), fields.refusal, fields.busy);
            desk.desk().document.edit_stream((&fields.id.get_value(), fields.stream.get_value()), stream, answered);
        }
        Err(why) => fields.refusal.set(Some(words::unfilled(&why))),
    }
}

/// What a dialog does with the answer: it closes, or says why not. While nothing can be saved it closes at once.
pub(super) fn answered(
    desk: &Desk,
    refusal: RwSignal<Option<String>>,
    busy: RwSignal<bool>,
) -> impl FnOnce(Result<(), Refused>) + 'static {
    let (desk, mine) = (desk.clone(), desk.dialog.get_untracked());
    if desk.document.can_save() {
        busy.set(true);
    } else {
        desk.dialog.set(None);
    }
    move |answer| {
        let still_open = mine.is_some() && desk.dialog.get_untracked() == mine;
        match answer {
            Ok(()) if still_open => desk.dialog.set(None),
            Ok(()) => {}
            Err(no) if still_open => {
                busy.try_set(false);
                refusal.try_set(Some(words::told_by(&no)));
                desk.notice.set(None);
            }
            Err(no) => desk.say(&words::told_by(&no), true),
        }
    }
}
