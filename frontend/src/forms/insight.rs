//! What a stream has to do with the rest: what hangs below it, who else uses its action, and whether the robot has all.

use crate::desk::Selected;
use crate::forms::words;
use crate::icons::Icon;
use crate::parts::hold;
use behaviour::{Graph, Id, Stream, StreamKind};
use leptos::prelude::*;
use protocol::{ActionDriver, answer, request};
use robot::UnfitStream;

/// How many streams or programs are named.
const SHOWN_MAX: usize = 5;
const BELOW_MAX: usize = 40;

/// The streams that values of this one reach, with links; nothing if there are none.
#[component]
pub(crate) fn Below(id: Id) -> impl IntoView {
    let desk = hold();
    let below = Memo::new(move |_| {
        let desk = desk.desk();
        desk.document.revision.track();
        desk.document.stream_ids.track();
        desk.document.connector_ids.track();
        let behaviour = desk.document.behaviour();
        let found = Graph::of(&behaviour).below(&id);
        let in_order = behaviour.streams_in_order().into_iter().filter(|(id, _)| found.contains(id));
        in_order.map(|(id, stream)| (id.clone(), stream.name.clone())).collect::<Vec<_>>()
    });
    let link = move |(id, name): (Id, String)| {
        let select = move |_| desk.desk().document.select(Some(Selected::Stream(id.clone())));
        view! { <li><button class="link" type="button" on:click=select>{name}</button></li> }
    };
    let links = move || below.get().into_iter().take(BELOW_MAX).map(link).collect_view();
    let more = move || below.read().len().saturating_sub(BELOW_MAX) as u64;
    view! {
        <Show when=move || !below.read().is_empty()>
            <details class="insight">
                <summary>{move || words::hangs_below(below.read().len())}</summary>
                <ul class="links">{links}</ul>
                <Show when=move || { more() > 0 }><p class="faint">{move || words::and_more(more())}</p></Show>
            </details>
        </Show>
    }
}

/// Other programs that use the action of this stream, and from which senses; nothing if it is no action.
#[component]
pub(crate) fn AlsoUsed(record: Memo<Stream>) -> impl IntoView {
    let action = Memo::new(move |_| {
        let stream = record.read();
        stream.device.clone().filter(|_| stream.kind == StreamKind::Actuator)
    });
    move || action.get().map(|action| view! { <OtherPrograms action /> })
}

#[component]
fn OtherPrograms(action: String) -> impl IntoView {
    let desk = hold();
    let found: RwSignal<(Vec<ActionDriver>, u64)> = RwSignal::new((Vec::new(), 0));
    let open = desk.desk().document.open.get_untracked();
    desk.desk().look_up(request::Drivers { actuator: action.clone() }, move |answer| {
        if let Ok(answer::Drivers { drivers, total }) = answer {
            let others: Vec<_> =
                drivers.iter().filter(|driver| Some(&driver.behaviour) != open.as_ref()).cloned().collect();
            let here = (drivers.len() - others.len()) as u64;
            found.try_set((others, total.saturating_sub(here)));
        }
    });
    let line = move |driver: ActionDriver| {
        let from = (!driver.sensors.is_empty()).then(|| words::from_senses(&words::listed(&driver.sensors)));
        let open = move |_| desk.desk().document.open_program(&driver.behaviour);
        view! {
            <li>
                <button class="link" type="button" on:click=open>{driver.name}</button>
                {from.map(|from| view! { <span class="faint">" "{from}</span> })}
            </li>
        }
    };
    let title = words::also_use(&action);
    let lines = move || found.get().0.into_iter().take(SHOWN_MAX).map(line).collect_view();
    let more = move || found.read().1.saturating_sub(SHOWN_MAX as u64);
    view! {
        <Show when=move || !found.read().0.is_empty()>
            <section class="insight">
                <h3 class="label">{title.clone()}</h3>
                <ul class="links">{lines}</ul>
                <Show when=move || { more() > 0 }><p class="faint">{move || words::and_more(more())}</p></Show>
            </section>
        </Show>
    }
}

/// Whether the robot has all that the open program needs; what it lacks, stream by stream.
#[component]
pub(crate) fn OnThisRobot() -> impl IntoView {
    let desk = hold();
    let missing = Memo::new(move |_| {
        let desk = desk.desk();
        desk.document.revision.track();
        desk.document.stream_ids.track();
        let robot = desk.robots.chosen.get()?;
        let is_known = !robot.devices.is_empty() && !desk.document.stream_ids.read().is_empty();
        is_known.then(|| {
            let behaviour = desk.document.behaviour();
            let mut missing = robot::missing(&behaviour, &robot.devices, &robot.lacking);
            missing.extend(robot::not_installed(&behaviour, &robot.installed));
            missing
        })
    });
    let line = move |missing: UnfitStream| {
        let (text, id) = (words::told_by(&missing), missing.stream);
        let label = words::titled(words::select(), &text);
        let select = move |_| desk.desk().document.select(Some(Selected::Stream(id.clone())));
        view! {
            <li class="problem" data-blocks="true">
                <Icon name="warn" />
                <span>
                    {text} " "
                    <button class="link" type="button" aria-label=label on:click=select>{words::select()}</button>
                </span>
            </li>
        }
    };
    let said = move || {
        let missing = missing.get()?;
        if missing.is_empty() {
            let name = desk.desk().robots.name();
            return Some(view! { <p class="faint">{words::has_all(&name)}</p> }.into_any());
        }
        Some(view! { <ul class="big-list">{missing.into_iter().map(line).collect_view()}</ul> }.into_any())
    };
    view! { {said} }
}
