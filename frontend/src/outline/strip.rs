//! Under the selected row: the next steps, and what can be done with it.

use crate::browser;
use crate::commands::On;
use crate::desk::{Dialog, Gap, GraphChoice, NewSpot, Selected};
use crate::forms::edit_dialog;
use crate::icons::Icon;
use crate::later::Later;
use crate::layout::chip_words;
use crate::outline::words;
use crate::parts::{DeskHold, MayNot, Menu, RemoveButton, hold, may_edit};
use crate::steps::{Offer, offers_memo, take};
use behaviour::connectors;
use behaviour::{Id, StreamKind};
use leptos::prelude::*;

/// After so long a row that was pressed is brought into view, in milliseconds.
const ROW_MS: i32 = 60;
/// And looked at again after so long each: what is told above the list grows with what was done.
const AGAIN_MS: &[i32] = &[140, 300, 600];
/// Room between what can be done with a row and Start, in pixels.
const BESIDE_FOOT: f64 = 8.0;
/// So many next steps are offered.
const OFFERS_MAX: usize = 4;

/// The strip, while its row is selected.
#[component]
pub(super) fn Strip(what: Selected) -> impl IntoView {
    let desk = hold();
    let mine = what.clone();
    let is_chosen = Memo::new(move |_| desk.desk().document.selected.read().as_ref() == Some(&mine));
    move || is_chosen.get().then(|| view! { <Buttons what=what.clone() /> })
}

#[component]
fn Buttons(what: Selected) -> impl IntoView {
    let desk = hold();
    let may = untrack(|| may_edit(desk));
    let (look, icon) = if may { (words::edit(), "pencil") } else { (words::look_at_it(), "eye") };
    let next = match &what {
        Selected::Stream(id) => may.then(|| view! { <Next id=id.clone() leads_on=gives(desk, id) /> }),
        Selected::Connector(_) | Selected::Note(_) | Selected::Group(_) => None,
    };
    let ways = may.then(|| view! { <Ways what=what.clone() /> });
    let edited = what.clone();
    let edit = move |_| match dialog_of(desk, &edited) {
        Some(dialog) => desk.desk().dialog.set(Some(dialog)),
        None => desk.desk().document.select(None),
    };
    let sheet = matches!(what, Selected::Connector(_)).then(|| what.id().clone());
    let buttons = view! {
        <div class="strip-inline">
            {next}
            {ways}
            <button class="tool icon" type="button" title=look aria-label=look on:click=edit>
                <Icon name=icon />
            </button>
            <RemoveButton what=what.clone() class="tool icon" />
            <More what />
            <MayNot />
        </div>
    };
    match sheet {
        Some(id) => view! { <Sheet id>{buttons}</Sheet> }.into_any(),
        None => {
            browser::after(ROW_MS, || keep_in_view(None, AGAIN_MS));
            buttons.into_any()
        }
    }
}

/// What can be done with a row is not left below Start and Stop, as long as nobody scrolls away from where it was `left`.
fn keep_in_view(left: Option<f64>, again: &'static [i32]) {
    let here = || window().scroll_y().unwrap_or_default();
    if left.is_some_and(|left| (left - here()).abs() > 1.0) {
        return;
    }
    let found = |selector| document().query_selector(selector).ok().flatten();
    if let Some((buttons, foot)) = found(".strip-inline").zip(found(".start-row")) {
        let below = buttons.get_bounding_client_rect().bottom() - foot.get_bounding_client_rect().top();
        if below > 0.0 {
            window().scroll_by_with_x_and_y(0.0, below + BESIDE_FOOT);
        }
        if let Some((ms, again)) = again.split_first() {
            let left = here();
            browser::after(*ms, move || keep_in_view(Some(left), again));
        }
    }
}

/// Everything else that can be done with it: what stands in its menu on the graph.
#[component]
fn More(what: Selected) -> impl IntoView {
    let on = match what {
        Selected::Stream(_) => On::Stream,
        Selected::Connector(_) => On::Connector,
        Selected::Note(_) => On::Note,
        Selected::Group(_) => On::Group,
    };
    view! {
        <Menu label=words::more_commands() icon="more" alone=true icon_only=true class="more">
            <Later show=move |rest| (rest.row_menu)(on) />
        </Menu>
    }
}

/// The control of a connector at the foot of the page, above Start and Stop, with its row in view.
#[component]
fn Sheet(id: Id, children: Children) -> impl IntoView {
    let desk = hold();
    let Some(signals) = desk.desk().document.connector(&id) else { return ().into_any() };
    let output = Memo::new(move |_| {
        let output = signals.record.with(|connector| connector.output.clone());
        desk.desk().document.stream(&output).map(|stream| stream.record.read().name.clone())
    });
    browser::after(ROW_MS, || {
        let found = |selector| document().query_selector(selector).ok().flatten();
        let rows = found(".twig[aria-current=true]").zip(found(".control-inline"));
        // The styles keep a row that is scrolled to clear of the sheet.
        if let Some((row, sheet)) = rows
            && row.get_bounding_client_rect().bottom() > sheet.get_bounding_client_rect().top()
        {
            row.scroll_into_view_with_bool(false);
        }
    });
    view! {
        <section class="control-inline" aria-label=output>
            <div class="sheet-head">
                <b class="cut">{output}</b>
                <button class="icon" type="button" aria-label=words::close() on:click=move |_| desk.desk().document.select(None)>
                    <Icon name="close" />
                </button>
            </div>
            <Later show=move |rest| (rest.control)(id.clone(), false) />
            {children()}
        </section>
    }
    .into_any()
}

/// A stream can be led elsewhere too, and into each edge of a connector something can be put.
#[component]
fn Ways(what: Selected) -> impl IntoView {
    let desk = hold();
    let choose = move |choice: &GraphChoice| desk.desk().dialog.set(Some(Dialog::Choose(choice.clone())));
    let button = move |(label, icon, choice): (String, &'static str, GraphChoice)| {
        view! {
            <button class="tool icon" type="button" title=label.clone() aria-label=label on:click=move |_| choose(&choice)>
                <Icon name=icon />
            </button>
        }
    };
    let all = match what {
        Selected::Stream(id) => {
            let connects = gives(desk, &id).then(|| (words::connect().to_owned(), "connect", GraphChoice::Ends(id)));
            connects.into_iter().collect()
        }
        Selected::Connector(id) => into_edges(desk, &id),
        Selected::Note(_) | Selected::Group(_) => Vec::new(),
    };
    all.into_iter().map(button).collect_view()
}

fn into_edges(desk: DeskHold, id: &Id) -> Vec<(String, &'static str, GraphChoice)> {
    let document = desk.desk().document.clone();
    let Some(connector) = document.connector(id).map(|signals| signals.record.get_untracked()) else {
        return Vec::new();
    };
    let words = chip_words(&connector).whole();
    let name = |id: &Id| document.stream(id).map(|signals| signals.record.with_untracked(|stream| stream.name.clone()));
    let into = |input: &Id| {
        let gap = Gap { connector: id.clone(), input: input.clone() };
        (words::insert_between(&name(input).unwrap_or_default(), &words), "plus", GraphChoice::Into(gap))
    };
    connector.inputs.iter().map(into).collect()
}

/// Whether something can come out of a stream.
fn gives(desk: DeskHold, id: &Id) -> bool {
    desk.desk().document.stream(id).is_some_and(|signals| signals.record.read_untracked().kind != StreamKind::Actuator)
}

fn dialog_of(desk: DeskHold, what: &Selected) -> Option<Dialog> {
    match what {
        Selected::Stream(id) => Some(Dialog::EditStream(id.clone())),
        Selected::Note(_) | Selected::Group(_) => None,
        Selected::Connector(id) => {
            let connector = desk.desk().document.connector(id)?.record.get_untracked();
            Some(edit_dialog(id, &connector))
        }
    }
}

/// The likely next steps of a stream, as on the canvas.
#[component]
fn Next(
    id: Id,
    /// Whether something can come out of it.
    leads_on: bool,
) -> impl IntoView {
    let desk = hold();
    let offers = offers_memo(&desk.desk(), &id, OFFERS_MAX);
    let id = StoredValue::new(id);
    let all = move |_| {
        let kind = connectors::to_action();
        let dialog = Dialog::Operation { input: id.get_value(), connector: None, kind, spot: NewSpot::default() };
        desk.desk().dialog.set(Some(dialog));
    };
    let button = move |(at, offer): (usize, Offer)| {
        let says = offer.says();
        let Offer { step, icon, label } = offer;
        view! {
            <button class="tool" class:likely=at == 0 type="button" title=says
                on:click=move |_| take(&desk.desk(), &id.get_value(), &step, NewSpot::default())>
                <Icon name=icon />
                <span>{label}</span>
            </button>
        }
    };
    view! {
        {move || offers.get().into_iter().enumerate().map(button).collect_view()}
        {leads_on.then(|| view! {
            <button class="tool" type="button" on:click=all><Icon name="bolt" /><span>{words::more_connectors()}</span></button>
        })}
    }
}
