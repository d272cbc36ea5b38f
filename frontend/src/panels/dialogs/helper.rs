//! One helper of the library: name, parameters, body, sentence, and where it is used.

mod used_in;

use super::frame::{Feet, Frame, Refused};
use super::gone::{Gone, gone};
use super::stream::answered;
use crate::fields::{CodeField, TextField};
use crate::panels::hold::{Hold, Soon, hold};
use crate::panels::may::{MayNot, may_edit};
use crate::words;
use behaviour::{Helper, Id, Refusal};
use leptos::prelude::*;
use protocol::Refused;
use used_in::UsedIn;

/// How soon a body is looked at while it is typed, in milliseconds.
const SOON_MS: i32 = 200;

#[derive(Clone, Copy)]
struct Fields {
    /// The helper as it was when the dialog was opened; none for a new one.
    seen: StoredValue<Option<(Id, Helper)>>,
    name: RwSignal<String>,
    params: RwSignal<String>,
    body: RwSignal<String>,
    says: RwSignal<String>,
    refusal: RwSignal<Option<String>>,
    busy: RwSignal<bool>,
}

/// A helper, or a new one.
#[component]
pub(super) fn EditHelper(id: Option<Id>) -> impl IntoView {
    let desk = hold();
    let all = desk.desk().library.helpers.get_untracked();
    let found = all.into_iter().find(|(other, _)| Some(other) == id.as_ref()).map(|(_, helper)| helper);
    let is_there = found.is_some();
    let fields = Fields::of(id.zip(found));
    let arguments = Signal::derive(move || params(&fields.params.read()));
    let may = untrack(|| may_edit(desk));
    let save = Callback::new(move |()| {
        if may {
            save(desk, fields);
        }
    });
    let title = if is_there { words::edit_helper() } else { words::add_helper() };
    view! {
        <Frame title save>
            {(!may).then(|| view! { <div class="held"><MayNot /></div> })}
            <div class="dialog-body">
              <fieldset class="held-fields" disabled=!may>
                <TextField label=words::helper_name() value=fields.name mono=true first={!is_there} />
                <TextField label=words::helper_params() value=fields.params mono=true />
                <div class="field">
                    <span class="label">{words::body()}</span>
                    <CodeField label=words::body() value=fields.body arguments described_by="helper-said" />
                    <Lint fields arguments />
                </div>
                <TextField label=words::helper_says() value=fields.says />
              </fieldset>
                {is_there.then(|| view! { <UsedIn name=fields.name.get_untracked() /> })}
                <Refused why=fields.refusal />
                {fields.seen.get_value().map(|(id, _)| view! { <Removed fields id /> })}
            </div>
            <Feet busy=fields.busy nothing=Signal::stored(!may)>{(is_there && may).then(|| view! { <Remove fields /> })}</Feet>
        </Frame>
    }
}

impl Fields {
    fn of(seen: Option<(Id, Helper)>) -> Self {
        let empty = || Helper {
            name: String::new(),
            params: vec!["value".to_owned()],
            body: String::new(),
            says: String::new(),
        };
        let helper = seen.clone().map_or_else(empty, |(_, helper)| helper);
        Self {
            seen: StoredValue::new(seen),
            name: RwSignal::new(helper.name),
            params: RwSignal::new(helper.params.join(", ")),
            body: RwSignal::new(helper.body),
            says: RwSignal::new(helper.says),
            refusal: RwSignal::new(None),
            busy: RwSignal::new(false),
        }
    }
}

fn params(text: &str) -> Vec<String> {
    text.split(',').map(str::trim).filter(|name| !name.is_empty()).map(str::to_owned).collect()
}

fn save(desk: Hold, fields: Fields) {
    fields.refusal.set(None);
    let helper = Helper {
        name: fields.name.get_untracked().trim().to_owned(),
        params: params(&fields.params.get_untracked()),
        body: fields.body.get_untracked().trim().to_owned(),
        says: fields.says.get_untracked().trim().to_owned(),
    };
    if let Some(bad) = std::iter::once(&helper.name).chain(&helper.params).find(|name| !behaviour::is_identifier(name))
    {
        fields.refusal.set(Some(Refusal::Identifier(bad.clone()).to_string()));
        return;
    }
    let answered = answered(&desk.desk(), fields.refusal, fields.busy);
    let look_again = move |answer: Result<(), Refused>| {
        if matches!(answer, Err(Refused::Change(Refusal::Stale(_)))) {
            look_again(desk, fields);
        }
        answered(answer);
    };
    desk.desk().library.put_helper(fields.seen.get_value(), helper, look_again);
}

/// After somebody else saved meanwhile: what is typed stays, and saving again puts it on top of theirs.
fn look_again(desk: Hold, fields: Fields) {
    let Some(Some((id, _))) = fields.seen.try_get_value() else { return };
    let now = desk.desk().library.helpers.get_untracked().into_iter().find(|(other, _)| *other == id);
    fields.seen.try_set_value(now);
}

/// Says while typing why the body cannot run.
#[component]
fn Lint(fields: Fields, arguments: Signal<Vec<String>>) -> impl IntoView {
    let desk = hold();
    let why = ArcRwSignal::new(None::<String>);
    let said = why.clone();
    let soon = Soon::new(move || {
        let (Some(body), Some(arguments)) = (fields.body.try_get_untracked(), arguments.try_get_untracked()) else {
            return;
        };
        let said = said.clone();
        if body.trim().is_empty() {
            said.set(None);
        } else {
            desk.desk().document.check_body(arguments, body, Vec::new(), move |(error, _)| said.set(error));
        }
    });
    Effect::new(move |_| {
        fields.body.track();
        arguments.track();
        soon.within(SOON_MS);
    });
    view! {
        <div role="status" id="helper-said">
            {move || why.get().map(|why| view! { <p class="second bad-text">{why}</p> })}
        </div>
    }
}

/// Who removed the helper meanwhile; saved again, it is a new one.
#[component]
fn Removed(fields: Fields, id: Id) -> impl IntoView {
    let desk = hold();
    let known = id.clone();
    let who = gone(desk, id, move || desk.desk().library.helpers.read().iter().any(|(other, _)| *other == known));
    view! { <Gone who written=fields.body /> }
}

#[component]
fn Remove(fields: Fields) -> impl IntoView {
    let desk = hold();
    let remove = move |_| {
        let Some(id) = fields.seen.with_value(|seen| seen.as_ref().map(|(id, _)| id.clone())) else { return };
        let answered = answered(&desk.desk(), fields.refusal, fields.busy);
        desk.desk().library.remove_helper(&id, answered);
    };
    view! {
        <button class="button danger apart" type="button" disabled=move || fields.busy.get() on:click=remove>
            {words::remove()}
        </button>
    }
}

#[cfg(test)]
mod tests {
    use super::params;

    #[test]
    fn parameters_are_read_with_or_without_spaces() {
        assert_eq!(params(" ball,d ,, x"), ["ball", "d", "x"]);
        assert!(params(" ").is_empty());
    }
}
