//! The head of the panel: which moment is looked at, playing, how much is seen, more lanes, and the way back to now.

use super::compare_view::CompareButton;
use super::marks::MarksButton;
use super::signs::{BACK, FORWARD, PAUSE, Sign};
use super::{PastShared, clock, close, filling, then};
use crate::browser;
use crate::focus;
use crate::icons::Icon;
use crate::past::words;
use lanes::LaneAct;
use leptos::prelude::*;
use protocol::{LaneName, OpenedPast, PastOf};

/// The id of the field that adds a lane.
const ADD_ID: &str = "past-add";

/// The head of the panel.
#[component]
pub(super) fn Head(past: PastShared) -> impl IntoView {
    let is_there = move || past.opened.read().is_some();
    let of = Memo::new(move |_| past.opened.get().map(|opened| about(past, &opened)));
    view! {
        <div class="past-head">
            <h2>{move || title(past)}</h2>
            <p class="past-of cut" title=of>{of}</p>
            <Show when=is_there><Play past /><Zoom past /><More past /><CompareButton past /></Show>
            <then::Folding past />
            <button class="past-close button" type="button" aria-label=words::back_to_now() title=words::back_to_now() on:click=move |_| close(past)>
                <Icon name="close" /><span>{words::back_to_now()}</span>
            </button>
        </div>
    }
}

/// The time under the cursor, and whether it is recorded or now. Reactive.
fn title(past: PastShared) -> String {
    let Some(opened) = past.opened.get() else { return words::over_time().to_owned() };
    let viewer = past.viewer.read();
    if viewer.follows() {
        return words::over_time().to_owned();
    }
    let time = clock::time(&opened, viewer.cursor(), false);
    if viewer.is_live() { words::moment_earlier(&time) } else { words::moment_recorded(&time) }
}

/// Tells what is looked at: the program, the day and the length.
fn about(past: PastShared, opened: &OpenedPast) -> String {
    let length = clock::length((opened.until_ms - opened.from_ms) as f64);
    match past.of.get_value() {
        Some(PastOf::Recording(_)) => {
            [opened.name.clone(), browser::date_words(clock::began(opened)), length].join(" · ")
        }
        Some(PastOf::Run(_)) | None => opened.name.clone(),
    }
}

#[component]
fn Play(past: PastShared) -> impl IntoView {
    let plays = move || past.viewer.read().plays();
    let is_live = move || past.viewer.read().is_live();
    let play_words = move || if plays() { words::rest_playing() } else { words::play() };
    let tool = move |label: &'static str, strokes: &'static [&'static str], act: LaneAct| {
        view! {
            <button class="past-tool" type="button" aria-label=label title=label on:click=move |_| past.act(act)>
                <Sign strokes />
            </button>
        }
    };
    view! {
        <div class="past-play" role="group" aria-label=words::playing_name()>
            {tool(words::mark_before(), BACK, LaneAct::NextMark(false))}
            <button class="past-tool" type="button" aria-label=play_words title=play_words on:click=move |_| past.act(LaneAct::Play)>
                {move || if plays() { view! { <Sign strokes=PAUSE /> }.into_any() } else { view! { <Icon name="play" /> }.into_any() }}
            </button>
            {tool(words::mark_after(), FORWARD, LaneAct::NextMark(true))}
            <button class="past-tool past-speed" type="button" title=words::speed_of_playing()
                aria-label=move || words::speed_now(past.viewer.read().speed())
                on:click=move |_| past.act(LaneAct::Faster)>
                {move || format!("{}×", past.viewer.read().speed())}
            </button>
            <Show when=is_live>
                <button class="past-now" type="button" aria-pressed=move || past.viewer.read().follows().to_string()
                    on:click=move |_| past.act(LaneAct::Now)>
                    <i aria-hidden="true"></i>{words::to_now()}
                </button>
            </Show>
        </div>
    }
}

#[component]
fn Zoom(past: PastShared) -> impl IntoView {
    view! {
        <div class="past-zoom" role="group" aria-label=words::stretch_name()>
            <button class="past-tool" type="button" aria-label=words::show_less_time() title=words::show_less_time()
                on:click=move |_| past.act(LaneAct::ZoomHere(0.5))><Icon name="minus" /></button>
            <span>{move || words::stretch((past.viewer.read().axis().span() / 1_000.0 * 10.0).round() / 10.0)}</span>
            <button class="past-tool" type="button" aria-label=words::show_more_time() title=words::show_more_time()
                on:click=move |_| past.act(LaneAct::ZoomHere(2.0))><Icon name="plus" /></button>
        </div>
    }
}

/// More lanes, and the table.
#[component]
fn More(past: PastShared) -> impl IntoView {
    let shown = Memo::new(move |_| {
        let viewer = past.viewer.read();
        viewer.lanes().iter().map(|lane| lane.key.clone()).collect::<Vec<_>>()
    });
    let changed = Memo::new(move |_| past.changed_streams());
    let options = move || {
        let opened = past.opened.get()?;
        let all = filling::all_lanes(&opened).into_iter().filter(|name| !shown.read().contains(&filling::key(name)));
        let is_changed = |name: &LaneName| name.field.is_none() && changed.read().contains(&name.stream);
        let (first, others): (Vec<LaneName>, Vec<LaneName>) = all.partition(is_changed);
        let option = |name| view! { <option value=filling::key(&name)>{filling::label(&opened, &name)}</option> };
        let first = (!first.is_empty()).then(|| {
            view! { <optgroup label=words::changed_lanes()>{first.into_iter().map(option).collect_view()}</optgroup> }
        });
        Some((first, others.into_iter().map(option).collect_view()))
    };
    let add = move |event: web_sys::Event| {
        let key = event_target_value(&event);
        if !key.is_empty() {
            past.add_lane(&filling::name(&key));
        }
    };
    view! {
        <select id=ADD_ID class="past-select" aria-label=words::add_lane() prop:value="" on:change=add>
            <option value="">{words::add_lane()}</option>
            {options}
        </select>
        <MarksButton past />
        <button class="past-tool past-values" type="button" aria-pressed=move || past.shows_table.get().to_string()
            on:click=move |_| past.shows_table.update(|shows| *shows = !*shows)>
            {words::values_shown()}
        </button>
    }
}

/// The keyboard goes to the field that adds a lane.
pub(super) fn to_add_lane() {
    if let Some(field) = focus::by_id(ADD_ID) {
        focus::focus(&field);
    }
}
