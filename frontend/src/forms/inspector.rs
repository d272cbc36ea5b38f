//! What is selected: its name, what it does, what can be done with it, its problems and its last value. What grows while
//! values flow stands last, so that no button moves away from who is about to press it.

mod settings;

use super::chosen::{GroupPanel, NotePanel};
use super::control::ConnectorControl;
use super::insight::{AlsoUsed, Below};
use super::operation::edit_dialog;
use super::problems::Problems;
use super::trials::{self, TrialTable, question_of};
use super::uses::Uses;
use crate::desk::{ConnectorSignals, Dialog, Selected, StreamSignals};
use crate::focus;
use crate::forms::words;
use crate::icons::Icon;
use crate::later::Later;
use crate::layout::what_it_is;
use crate::live::rate_words;
use crate::parts::{
    MayNot, ProblemList, RemoveButton, device_icon, hold, kind_class, may_edit, may_operate, problem_count,
};
use behaviour::{Connector, Id, Procedure, Stream, StreamKind};
use leptos::prelude::*;
use settings::Settings;

/// The inspector: what is selected, and beside it all problems, counted; several things chosen are listed, with nothing
/// selected the problems alone.
#[component]
pub(crate) fn Inspector() -> impl IntoView {
    let desk = hold();
    let chosen = Memo::new(move |_| desk.desk().document.selected.get());
    let several = Memo::new(move |_| !desk.desk().document.several.read().is_empty());
    let lists = RwSignal::new(false);
    Effect::new(move |_| {
        chosen.track();
        several.track();
        lists.set(false);
    });
    let nothing = Memo::new(move |_| chosen.read().is_none() && !several.get());
    let shown = Memo::new(move |_| chosen.get().filter(|_| !lists.get()));
    let opened = Memo::new(move |_| desk.desk().document.open.read().is_some());
    view! {
        <Show when=move || opened.get()><Tabs nothing lists /></Show>
        {move || match shown.get() {
            Some(chosen) => view! { <Later show=move |rest| (rest.selected)(chosen.clone()) /> }.into_any(),
            None if several.get() && !lists.get() => view! { <Later show=|rest| (rest.chosen)() /> }.into_any(),
            None if opened.get() => view! { <Later show=|rest| (rest.problems)() /> }.into_any(),
            None => ().into_any(),
        }}
    }
}

/// Which of both is shown; arrow keys go from one to the other.
#[component]
fn Tabs(nothing: Memo<bool>, lists: RwSignal<bool>) -> impl IntoView {
    let desk = hold();
    let listed = move || lists.get() || nothing.get();
    let count = Memo::new(move |_| problem_count(desk));
    let stop = |it: bool| if it { "0" } else { "-1" };
    view! {
        <div class="tabs" role="tablist" aria-label=words::inspector_tabs() on:keydown=|event| focus::walk(&event, "ArrowRight", "ArrowLeft")>
            <button type="button" role="tab" data-stop="" tabindex=move || stop(!listed()) aria-selected=move || (!listed()).to_string()
                disabled=move || nothing.get() on:click=move |_| lists.set(false)>
                {words::is_selected()}
            </button>
            <button type="button" role="tab" id="problems-tab" data-stop="" tabindex=move || stop(listed())
                aria-selected=move || listed().to_string() on:click=move |_| lists.set(true)>
                {words::problems()}
                {move || (count.get() > 0).then(|| view! { " " <span class="number">{count.get()}</span> })}
            </button>
        </div>
    }
}

/// What is selected; all problems if it is gone.
pub(crate) fn selected(selected: Selected) -> AnyView {
    let document = hold().desk().document;
    let shown = match selected {
        Selected::Stream(id) => document.stream(&id).map(|signals| view! { <StreamPanel id signals /> }.into_any()),
        Selected::Connector(id) => {
            document.connector(&id).map(|signals| view! { <ConnectorPanel id signals /> }.into_any())
        }
        Selected::Note(id) => document.note_signals(&id).map(|signals| view! { <NotePanel id signals /> }.into_any()),
        Selected::Group(id) => document.group(&id).map(|signals| view! { <GroupPanel id signals /> }.into_any()),
    };
    shown.unwrap_or_else(|| view! { <Problems /> }.into_any())
}

#[component]
fn StreamPanel(id: Id, signals: StreamSignals) -> impl IntoView {
    let record = Memo::new({
        let record = signals.record.clone();
        move |_| record.get()
    });
    let is_sensor = move || record.read().kind == StreamKind::Sensor;
    let has_device = record.with_untracked(|stream| stream.device.is_some());
    let stimulated = id.clone();
    let desk = hold();
    view! {
        <section class="panel" aria-label=words::inspector_name()>
            <h2>
                <span class=move || format!("kind {}", kind_class(record.read().kind))>
                    {move || device_icon(&record.read()).map(|name| view! { <Icon name /> })}
                </span>
                <span class="cut" title=move || record.read().name.clone()>{move || record.read().name.clone()}</span>
            </h2>
            <p class="second">{move || says(&record.read())}</p>
            <p class="second">{move || what_it_is(&record.read())}</p>
            <Settings id=id.clone() record />
            <div class="row">
                <Edit dialog=Dialog::EditStream(id.clone()) />
                <Show when=is_sensor>
                    <button class="button small" type="button" disabled=move || !may_operate(desk) on:click={
                        let id = stimulated.clone();
                        move |_| desk.desk().dialog.set(Some(Dialog::Stimulate(id.clone())))
                    }>
                        <Icon name="bolt" />
                        {words::stimulate()}
                    </button>
                </Show>
                <RemoveButton what=Selected::Stream(id.clone()) class="button small" in_words=true />
            </div>
            <MayNot />
            {has_device.then(|| view! { <Uses id=id.clone() instead=|| None /> })}
            <StreamLive id=id.clone() signals />
            <Undecided id=id.clone() />
            <ProblemList of=Some(id.clone()) />
            <Below id />
            <AlsoUsed record />
        </section>
    }
}

fn says(stream: &Stream) -> &'static str {
    let device = stream.device.as_deref().and_then(|name| robot::device(stream.kind, name).ok());
    device.map_or(words::says_ordinary(), words::device_says)
}

#[component]
fn StreamLive(id: Id, signals: StreamSignals) -> impl IntoView {
    let desk = hold();
    let live = signals.live;
    let value = move || {
        let live = live.read();
        let value = live.value.as_ref().map(|value| desk.desk().document.measured(&id, value));
        value.map(|value| (value, live.rate, live.count))
    };
    let rows = move || match value() {
        Some((value, _, _)) if desk.desk().robots.running().is_none() => {
            view! { <p class="faint cut" title=value.clone()>{words::last_was(&value)}</p> }.into_any()
        }
        Some((value, rate, count)) => view! {
            <dl class="row second">
                <dt class="sr">{words::last_value()}</dt><dd class="cut" title=value.clone()><b>{value.clone()}</b></dd>
                <dt class="sr">{words::rate()}</dt><dd>{rate_words(rate)}</dd>
                <dt>{words::carried()}</dt><dd>{count}</dd>
            </dl>
        }
        .into_any(),
        None => {
            let runs = desk.desk().robots.running().is_some();
            let text = if runs { words::no_value_yet() } else { words::starts_to_see() };
            view! { <p class="faint">{text}</p> }.into_any()
        }
    };
    view! { {rows} }
}

#[component]
fn ConnectorPanel(id: Id, signals: ConnectorSignals) -> impl IntoView {
    let desk = hold();
    let record = Memo::new({
        let record = signals.record.clone();
        move |_| record.get()
    });
    let spec = move || record.read().operation.spec();
    let question = Memo::new(move |_| question_of(desk, &record.read()));
    let answers = trials::ask(question);
    let unit = Signal::derive(move || desk.desk().document.unit(&record.read().output));
    let removed = Selected::Connector(id.clone());
    let problems = Some(id.clone());
    let dialog = edit_dialog(&id, &record.get_untracked());
    view! {
        <section class="panel" aria-label=words::inspector_name()>
            <h2>{move || view! { <Icon name=spec().icon.name /> }} {move || words::connector_word(spec())}</h2>
            <p class="second">{move || words::connector_says(spec())}</p>
            {move || procedure_text(&record.read()).map(|text| view! { <pre class="code-line"><code>{text}</code></pre> })}
            <ConnectorControl id=id.clone() />
            <div class="row">
                <Edit dialog />
                <RemoveButton what=removed class="button small" in_words=true />
            </div>
            <MayNot />
            <Undecided id=id.clone() />
            <ProblemList of=problems />
            <TrialTable answers unit />
            <ConnectorLive id=id.clone() signals />
        </section>
    }
}

/// The procedure of a connector as text.
fn procedure_text(connector: &Connector) -> Option<String> {
    match connector.operation.procedure()? {
        Procedure::Body { body, .. } => Some(body.clone()),
        Procedure::Helper(name) => Some(name.clone()),
    }
}

#[component]
fn ConnectorLive(id: Id, signals: ConnectorSignals) -> impl IntoView {
    let (desk, live, record) = (hold(), signals.live, signals.record);
    let unused = Memo::new(move |_| desk.desk().robots.unused.read().contains(&id));
    let counts = {
        let live = live.clone();
        move || {
            let worked = words::worked(live.read().fired, live.read().faults);
            let over = desk.desk().robots.running().is_none().then(|| format!("{} ", words::last_run()));
            view! { <p class="faint">{over}{worked}</p> }
        }
    };
    let any = {
        let live = live.clone();
        Memo::new(move |_| live.read().fired + live.read().faults > 0)
    };
    let counts = move || any.get().then(|| counts.clone());
    let error = move || live.read().error.clone().map(|text| view! { <p class="refusal">{words::shown(&text)}</p> });
    let held = move || record.with(|connector| desk.desk().robots.held(&connector.output));
    let held = move || held().map(|text| view! { <p class="second">{text}</p> });
    // The counts are those of the version that runs, not of what is written here.
    move || (!unused.get()).then(|| view! { {counts.clone()} {error.clone()} {held.clone()} })
}

/// That a change of one's own to it was refused and waits, with the way to decide.
#[component]
fn Undecided(id: Id) -> impl IntoView {
    let desk = hold();
    let op = Memo::new(move |_| desk.desk().document.conflict_about(&id).map(|conflict| conflict.mine.op));
    let look = move |_| desk.desk().dialog.set(op.get_untracked().map(Dialog::Conflict));
    view! {
        <Show when=move || op.read().is_some()>
            <p class="undecided-line">
                {words::yours_waits()}
                " "
                <button class="link" type="button" on:click=look>{words::look_at_both()}</button>
            </p>
        </Show>
    }
}

#[component]
fn Edit(dialog: Dialog) -> impl IntoView {
    let desk = hold();
    let may = untrack(|| may_edit(desk));
    view! {
        <button class="button small" type="button" on:click=move |_| desk.desk().dialog.set(Some(dialog.clone()))>
            <Icon name=if may { "pencil" } else { "eye" } />
            {if may { words::edit() } else { words::look_at_it() }}
        </button>
    }
}
