//! What is selected: its name, what it does, its last value, its problems, and what can be done with it.

use super::hold::{Hold, hold};
use super::insight::{AlsoUsed, Below};
use super::may::{MayNot, may_edit, may_operate};
use super::problems::{ProblemList, Problems};
use super::trials::{self, Question, TrialTable};
use crate::desk::{ConnectorSignals, Dialog, Selected, StreamSignals};
use crate::icons::Icon;
use crate::layout::what_it_is;
use crate::live::{rate_words, short_value};
use crate::words;
use behaviour::{Connector, Id, Procedure, Stream, StreamKind, Value};
use leptos::prelude::*;

/// The inspector; with nothing selected it lists the problems.
#[component]
pub(crate) fn Inspector() -> impl IntoView {
    let desk = hold();
    let chosen = Memo::new(move |_| desk.desk().document.selected.get());
    let shown = move || match chosen.get() {
        Some(Selected::Stream(id)) => {
            desk.desk().document.stream(&id).map(|signals| view! { <StreamPanel id signals /> }.into_any())
        }
        Some(Selected::Connector(id)) => {
            desk.desk().document.connector(&id).map(|signals| view! { <ConnectorPanel id signals /> }.into_any())
        }
        None => None,
    };
    view! { {move || shown().unwrap_or_else(|| view! { <Problems /> }.into_any())} }
}

#[component]
fn StreamPanel(id: Id, signals: StreamSignals) -> impl IntoView {
    let record = Memo::new({
        let record = signals.record.clone();
        move |_| record.get()
    });
    let is_sensor = move || record.read().kind == StreamKind::Sensor;
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
            <StreamLive signals />
            <Undecided id=id.clone() />
            <ProblemList of=Some(id.clone()) />
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
                <Remove what=Selected::Stream(id.clone()) />
            </div>
            <MayNot />
            <Below id />
            <AlsoUsed record />
        </section>
    }
}

/// The class of a kind of stream.
pub(crate) fn kind_class(kind: StreamKind) -> &'static str {
    match kind {
        StreamKind::Sensor => "sensor",
        StreamKind::Ordinary => "ordinary",
        StreamKind::Actuator => "actuator",
    }
}

/// The icon of a stream's device.
pub(crate) fn device_icon(stream: &Stream) -> Option<&'static str> {
    robot::device(stream.kind, stream.device.as_deref()?).ok().map(|device| device.icon)
}

fn says(stream: &Stream) -> &'static str {
    let device = stream.device.as_deref().and_then(|name| robot::device(stream.kind, name).ok());
    device.map_or(words::says_ordinary(), |device| device.says)
}

#[component]
fn StreamLive(signals: StreamSignals) -> impl IntoView {
    let desk = hold();
    let live = signals.live;
    let value =
        move || live.read().value.as_ref().map(|value| (short_value(value), live.read().rate, live.read().count));
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
    let removed = Selected::Connector(id.clone());
    let problems = Some(id.clone());
    let dialog = edit_dialog(&id, &record.get_untracked());
    view! {
        <section class="panel" aria-label=words::inspector_name()>
            <h2>{move || view! { <Icon name=spec().icon.name /> }} {move || spec().name}</h2>
            <p class="second">{move || spec().says}</p>
            {move || procedure_text(&record.read()).map(|text| view! { <pre class="code-line"><code>{text}</code></pre> })}
            <TrialTable answers />
            <Undecided id=id.clone() />
            <ConnectorLive id=id.clone() signals />
            <ProblemList of=problems />
            <div class="row">
                <Edit dialog />
                <Remove what=removed />
            </div>
            <MayNot />
        </section>
    }
}

/// The Operation dialog of a connector that is there.
pub(crate) fn edit_dialog(id: &Id, connector: &Connector) -> Dialog {
    let kind = connector.operation.spec();
    let input = connector.inputs.first().unwrap_or(&connector.output).clone();
    Dialog::Operation { input, connector: Some(id.clone()), kind }
}

/// The procedure of a connector as text.
fn procedure_text(connector: &Connector) -> Option<String> {
    match connector.operation.procedure()? {
        Procedure::Body { body, .. } => Some(body.clone()),
        Procedure::Helper(name) => Some(name.clone()),
    }
}

/// What a connector's procedure is asked. Reactive.
pub(super) fn question_of(desk: Hold, connector: &Connector) -> Option<Question> {
    let desk = desk.desk();
    let spec = connector.operation.spec();
    let is_test = spec.is_test();
    let inputs = connector.inputs.clone();
    let before: Vec<Value> = connector.operation.start().cloned().into_iter().collect();
    match connector.operation.procedure()? {
        Procedure::Body { body, args } => {
            let names = inputs.iter().filter_map(|id| Some(desk.document.stream(id)?.record.read().name.clone()));
            let names: Vec<String> = names.collect();
            let derived = || spec.argument_names(names.iter().map(String::as_str));
            let arguments = args.clone().unwrap_or_else(derived);
            Some(Question { arguments, body: body.clone(), inputs, before, is_test })
        }
        Procedure::Helper(name) => {
            let helpers = desk.library.helpers.get();
            let (_, helper) = helpers.into_iter().find(|(_, helper)| helper.name == *name)?;
            let fits = helper.params.len() == spec.argument_count(inputs.len());
            fits.then_some(Question { arguments: helper.params, body: helper.body, inputs, before, is_test })
        }
    }
}

#[component]
fn ConnectorLive(id: Id, signals: ConnectorSignals) -> impl IntoView {
    let (desk, live, record) = (hold(), signals.live, signals.record);
    let unused = Memo::new(move |_| desk.desk().robots.unused.read().contains(&id));
    let counts = {
        let live = live.clone();
        move || {
            let (fired, faults) = (words::count(live.read().fired), words::count(live.read().faults));
            let over = desk.desk().robots.running().is_none().then(words::last_run);
            view! { <p class="faint">{over}{words::fired()}" "{fired}" · "{words::faults()}" "{faults}</p> }
        }
    };
    let any = {
        let live = live.clone();
        Memo::new(move |_| live.read().fired + live.read().faults > 0)
    };
    let counts = move || any.get().then(|| counts.clone());
    let error = move || live.read().error.clone().map(|text| view! { <p class="refusal">{text}</p> });
    let held = move || record.with(|connector| desk.desk().robots.held(&connector.output));
    let held = move || held().map(|text| view! { <p class="second">{text}</p> });
    // The counts are those of the version that runs, not of what is written here.
    move || {
        if unused.get() {
            view! { <p class="second unused-line"><span class="unused" aria-hidden="true"></span>{words::runs_before()}</p> }
                .into_any()
        } else {
            view! { {counts.clone()} {error.clone()} {held.clone()} }.into_any()
        }
    }
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

#[component]
fn Remove(what: Selected) -> impl IntoView {
    let desk = hold();
    view! {
        <button class="button small" type="button" disabled=move || !may_edit(desk)
            on:click=move |_| desk.desk().document.remove(&what)>
            <Icon name="trash" />
            {words::remove()}
        </button>
    }
}
