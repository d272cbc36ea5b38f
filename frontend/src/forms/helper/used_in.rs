//! Where a helper is used: in the open program, in other programs, and by other helpers.

use crate::desk::Dialog;
use crate::dialogs::close;
use crate::forms::words;
use crate::palette::users_of;
use crate::parts::{DeskHold, hold};
use behaviour::Id;
use leptos::prelude::*;
use protocol::{HelperUse, LIBRARY, request};

/// How many programs and helpers are named.
const SHOWN_MAX: usize = 6;

/// Everything that uses the helper, with links to it.
#[component]
pub(super) fn UsedIn(name: String) -> impl IntoView {
    let desk = hold();
    let others: RwSignal<Option<Vec<HelperUse>>> = RwSignal::new(None);
    desk.desk().look_up(request::WhereUsed { helper: name.clone() }, move |answer| {
        let uses = answer.map_or_else(|_| Vec::new(), |answer| once_each(&answer.uses));
        others.try_set(Some(uses));
    });
    let here = Memo::new(move |_| connectors_here(desk, &name));
    let elsewhere = move || {
        let open = desk.desk().document.open.get();
        let all = others.get().unwrap_or_default();
        all.into_iter().filter(|used| Some(&used.behaviour) != open.as_ref()).collect::<Vec<_>>()
    };
    let nowhere = move || here.read().is_empty() && others.read().is_some() && elsewhere().is_empty();
    let more = move || elsewhere().len().saturating_sub(SHOWN_MAX) as u64;
    let links = move || elsewhere().into_iter().take(SHOWN_MAX).map(|used| view! { <Link used /> }).collect_view();
    view! {
        <section class="field">
            <h3 class="label">{words::used_in()}</h3>
            <Show when=nowhere><p class="second">{words::used_nowhere()}</p></Show>
            <Show when=move || !here.read().is_empty()>
                <p class="second">{move || words::titled(words::this_program(), &words::listed(here.get()))}</p>
            </Show>
            <ul class="links" aria-label=words::used_in()>{links}</ul>
            <Show when=move || { more() > 0 }><p class="faint">{move || words::and_more(more())}</p></Show>
        </section>
    }
}

#[component]
fn Link(used: HelperUse) -> impl IntoView {
    let desk = hold();
    let is_helper = used.behaviour.as_str() == LIBRARY;
    let text = if is_helper { words::helper_called(&used.name) } else { used.name.clone() };
    let through = used.through.as_deref().map(words::through);
    let open = move |_| {
        if is_helper {
            desk.desk().dialog.set(Some(Dialog::Helper(Some(used.record.id.clone()))));
        } else {
            close(desk);
            desk.desk().document.open_program(&used.behaviour);
        }
    };
    view! {
        <li>
            <button class="link" type="button" on:click=open>{text}</button>
            {through.map(|through| view! { <span class="faint">" "{through}</span> })}
        </li>
    }
}

/// Every program and helper once, by its nearest use.
fn once_each(uses: &[HelperUse]) -> Vec<HelperUse> {
    let mut kept: Vec<HelperUse> = Vec::new();
    for used in uses {
        let is_same = |other: &HelperUse| {
            let helper = used.behaviour.as_str() == LIBRARY;
            other.behaviour == used.behaviour && (!helper || other.record == used.record)
        };
        if !kept.iter().any(is_same) {
            kept.push(used.clone());
        }
    }
    kept
}

/// The connectors of the open program that use the helper. Reactive.
fn connectors_here(desk: DeskHold, helper: &str) -> Vec<String> {
    let now = desk.desk();
    let label = |id: Id| {
        let connector = now.document.connector(&id)?.record.get();
        let output = now.document.stream(&connector.output)?.record.get().name;
        Some(format!("{} → {output}", words::connector_word(connector.operation.spec())))
    };
    users_of(desk, helper).into_iter().filter_map(label).collect()
}

#[cfg(test)]
mod tests {
    use super::{HelperUse, LIBRARY, once_each};
    use behaviour::{Id, Kind, RecordId};

    #[test]
    fn a_program_is_named_once_and_every_helper() {
        let used = |behaviour: &str, record: &str, through: Option<&str>| HelperUse {
            behaviour: Id::new(behaviour).unwrap(),
            name: behaviour.to_owned(),
            record: RecordId::new(Kind::Connector, &Id::new(record).unwrap()),
            through: through.map(str::to_owned),
        };
        let all = [
            used("a", "1", None),
            used("a", "2", None),
            used(LIBRARY, "h", None),
            used(LIBRARY, "i", None),
            used("a", "3", Some("h")),
        ];
        assert_eq!(once_each(&all), [all[0].clone(), all[2].clone(), all[3].clone()]);
    }
}
