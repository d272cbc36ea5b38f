//! One helper of the library: name, parameters, body, sentence, and where it is used.

mod kinds;
mod trying;
mod used_in;
mod values;

use super::drafting::{self, Preview};
use super::gone::{Gone, gone};
use super::operation::{LooksRight, Meant};
use super::stream::answered;
use crate::desk::DraftedWhat;
use crate::dialogs::{Feet, Frame, Refused};
use crate::fields::{CodeField, TextField};
use crate::forms::words;
use crate::parts::{DeskHold, MayNot, hold, may_edit};
use behaviour::{Helper, Id, Kind, RecordId, Refusal};
use kinds::{KindFields, Kinds};
use leptos::prelude::*;
use protocol::{EditedHelper, UnknownName};
use trying::TryIt;
use used_in::UsedIn;

#[derive(Clone, Copy)]
struct HelperFields {
    /// The helper as it was when the dialog was opened; none for a new one.
    seen: RwSignal<Option<(Id, Helper)>>,
    name: RwSignal<String>,
    params: RwSignal<String>,
    body: RwSignal<String>,
    says: RwSignal<String>,
    kinds: Kinds,
    refusal: RwSignal<Option<String>>,
    busy: RwSignal<bool>,
}

/// A helper, or a new one.
#[component]
pub(crate) fn EditHelper(id: Option<Id>) -> impl IntoView {
    let desk = hold();
    let all = desk.desk().library.helpers.get_untracked();
    let found = all.into_iter().find(|(other, _)| Some(other) == id.as_ref()).map(|(_, helper)| helper);
    let is_there = found.is_some();
    let fields = HelperFields::of(id.zip(found));
    let arguments = Signal::derive(move || params(&fields.params.read()));
    // Why the body cannot run, said while it is typed.
    let error = RwSignal::new(None::<String>);
    let unknown = RwSignal::new(None::<UnknownName>);
    let wrong = Signal::derive(move || unknown.get().map(|unknown| unknown.name));
    let may = untrack(|| may_edit(desk));
    let save = Callback::new(move |()| {
        if may {
            save(desk, fields);
        }
    });
    if let Some((id, _)) = fields.seen.get_untracked().filter(|_| may) {
        drafting::keep(desk, RecordId::new(Kind::Helper, &id), move || drafted(fields));
    }
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
                    <CodeField label=words::body() value=fields.body arguments unknown=wrong described_by="helper-said" />
                    <Meant body=fields.body arguments unknown=Signal::from(unknown) />
                    <LooksRight body=fields.body arguments />
                    <div role="status" id="helper-said">
                        {move || error.get().map(|why| view! { <p class="second bad-text">{why}</p> })}
                    </div>
                </div>
                <KindFields fields arguments />
                <TextField label=words::helper_says() value=fields.says />
              </fieldset>
                <TryIt fields arguments error unknown />
                {is_there.then(|| view! { <UsedIn name=fields.name.get_untracked() /> })}
                <Refused why=fields.refusal />
                <Theirs fields save />
                {fields.seen.get_untracked().map(|(id, _)| view! { <Removed fields id /> })}
            </div>
            <Preview />
            <Feet busy=fields.busy nothing=Signal::stored(!may)>{(is_there && may).then(|| view! { <Remove fields /> })}</Feet>
        </Frame>
    }
}

impl HelperFields {
    fn of(seen: Option<(Id, Helper)>) -> Self {
        let empty = || Helper {
            name: String::new(),
            params: vec!["value".to_owned()],
            body: String::new(),
            ..Helper::default()
        };
        let helper = seen.clone().map_or_else(empty, |(_, helper)| helper);
        Self {
            kinds: Kinds::of(&helper),
            seen: RwSignal::new(seen),
            name: RwSignal::new(helper.name),
            params: RwSignal::new(helper.params.join(", ")),
            body: RwSignal::new(helper.body),
            says: RwSignal::new(helper.says),
            refusal: RwSignal::new(None),
            busy: RwSignal::new(false),
        }
    }

    /// Shows a helper in the place of what is typed.
    fn show(self, helper: &Helper) {
        self.name.set(helper.name.clone());
        self.params.set(helper.params.join(", "));
        self.body.set(helper.body.clone());
        self.says.set(helper.says.clone());
        self.kinds.show(helper);
    }

    /// The helper as it is written now. Reactive.
    fn helper(self) -> Helper {
        let params = params(&self.params.read());
        Helper {
            name: self.name.get().trim().to_owned(),
            takes: self.kinds.takes(&params),
            gives: self.kinds.gives(),
            params,
            body: self.body.get().trim().to_owned(),
            says: self.says.get().trim().to_owned(),
        }
    }
}

fn params(text: &str) -> Vec<String> {
    text.split(',').map(str::trim).filter(|name| !name.is_empty()).map(str::to_owned).collect()
}

/// The helper as it would be saved, if it is another one. Reactive.
fn drafted(fields: HelperFields) -> Option<DraftedWhat> {
    let (helper, is_busy) = (fields.helper(), fields.busy.get());
    let (_, seen) = fields.seen.get().filter(|(_, seen)| *seen != helper && !is_busy)?;
    Some(match bad_name(&helper) {
        Some(why) => DraftedWhat::Unready(words::told_by(&why)),
        None => DraftedWhat::Helper(Box::new(EditedHelper { name: seen.name, helper })),
    })
}

/// Returns the reason why its name or one of its parameters is none that a procedure can have.
fn bad_name(helper: &Helper) -> Option<Refusal> {
    let mut names = std::iter::once(&helper.name).chain(&helper.params);
    names.find(|name| !behaviour::is_identifier(name)).map(|bad| Refusal::Identifier(bad.clone()))
}

fn save(desk: DeskHold, fields: HelperFields) {
    fields.refusal.set(None);
    let helper = untrack(|| fields.helper());
    if let Some(why) = bad_name(&helper) {
        fields.refusal.set(Some(why.to_string()));
        return;
    }
    let renamed = fields.seen.get_untracked().filter(|(_, seen)| seen.name != helper.name);
    if renamed.is_some() && !desk.desk().document.can_save() {
        // All programs that use it are asked, which cannot wait in the queue.
        fields.refusal.set(Some(words::unreachable().to_owned()));
        return;
    }
    let answered = answered(&desk.desk(), fields.refusal, fields.busy);
    let library = desk.desk().library;
    match renamed {
        Some(seen) => library.rename_helper(seen, helper, answered),
        None => library.put_helper(fields.seen.get_untracked(), helper, answered),
    }
}

/// Who else saved the helper since it was opened here, and how it is by now. Reactive.
fn theirs(desk: DeskHold, fields: HelperFields) -> Option<(String, Helper)> {
    let library = desk.desk().library;
    let (id, seen) = fields.seen.get()?;
    let (_, now) = library.helpers.get().into_iter().find(|(other, _)| *other == id)?;
    let by = || library.changed_by(&id).unwrap_or_else(|| words::somebody().to_owned());
    (now != seen && !fields.busy.get()).then(|| (by(), now))
}

/// What somebody else saved meanwhile: one's own goes on top of that, or gives way to it.
#[component]
fn Theirs(fields: HelperFields, save: Callback<()>) -> impl IntoView {
    let desk = hold();
    let theirs = Memo::new(move |_| theirs(desk, fields));
    let seen_now = move || {
        let (_, now) = theirs.get_untracked()?;
        fields.refusal.set(None);
        fields.seen.update(|seen| {
            if let Some((_, seen)) = seen {
                seen.clone_from(&now);
            }
        });
        Some(now)
    };
    let take = move |_| seen_now().iter().for_each(|now| fields.show(now));
    let keep = move |_| {
        if seen_now().is_some() {
            save.run(());
        }
    };
    view! {
        <div role="alert">
            {move || theirs.get().map(|(name, helper)| view! {
                <p class="refusal">{words::helper_changed_too(&name)}</p>
                <pre class="code-line"><code>{format!("{}({})\n{}", helper.name, helper.params.join(", "), helper.body)}</code></pre>
                <p class="row">
                    <button class="button small" type="button" on:click=take>{words::take_of(&name)}</button>
                    <button class="button small" type="button" on:click=keep>{words::keep_mine()}</button>
                </p>
            })}
        </div>
    }
}

/// Who removed the helper meanwhile; saved again, it is a new one.
#[component]
fn Removed(fields: HelperFields, id: Id) -> impl IntoView {
    let desk = hold();
    let known = id.clone();
    let who = gone(desk, id, move || desk.desk().library.helpers.read().iter().any(|(other, _)| *other == known));
    Effect::new(move |_| {
        if who.read().is_some() {
            fields.seen.set(None);
        }
    });
    view! { <Gone who written=fields.body /> }
}

#[component]
fn Remove(fields: HelperFields) -> impl IntoView {
    let desk = hold();
    let remove = move |_| {
        let Some(id) = fields.seen.with_untracked(|seen| seen.as_ref().map(|(id, _)| id.clone())) else { return };
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
