//! The invitations: for whom, what they may do, who came by which, and ending one.

use crate::browser;
use crate::parts::hold;
use crate::people::words;
use leptos::prelude::*;
use protocol::{Invitation, InvitedGuest};

/// All of them, newest first.
#[component]
pub(super) fn List() -> impl IntoView {
    let desk = hold();
    let all = Memo::new(move |_| desk.desk().invitations.get());
    // Asked about one at a time; outside of the rows, which are made anew when somebody comes.
    let asked = RwSignal::new(None::<behaviour::Id>);
    let one = move |invitation: Invitation| view! { <One invitation asked /> };
    view! {
        <section class="invitations" aria-labelledby="invitations-title">
            <h3 class="label" id="invitations-title">{words::invitations()}</h3>
            <Show when=move || all.read().is_empty()><p class="second">{words::no_invitations()}</p></Show>
            <ul>
                <For each=move || all.get() key=|one| format!("{one:?}") children=one />
            </ul>
        </section>
    }
}

#[component]
fn One(invitation: Invitation, asked: RwSignal<Option<behaviour::Id>>) -> impl IntoView {
    let name =
        if invitation.label.is_empty() { words::invitation_unnamed().to_owned() } else { invitation.label.clone() };
    let terms = format!("{} · {}", words::may_short(invitation.role), words::lasts(invitation.lasts));
    let ended = ended(&invitation);
    let came = invitation.came.iter().map(|came| view! { <li><Person came=came.clone() /></li> }).collect_view();
    let nobody = invitation.came.is_empty().then(|| view! { <li>{words::nobody_came()}</li> });
    let here = invitation.came.iter().filter(|came| came.here).count();
    view! {
        <li class="invitation" class:ended=ended.is_some()>
            <div class="two"><b class="cut" title=name.clone()>{name.clone()}</b><span class="second">{terms}</span></div>
            {match ended {
                Some(word) => view! { <span class="second">{word}</span> }.into_any(),
                None => view! { <Revoke id=invitation.id name here asked /> }.into_any(),
            }}
            <ul class="came second">{came}{nobody}</ul>
        </li>
    }
}

/// Whether it lets nobody in any more, in a word.
fn ended(invitation: &Invitation) -> Option<&'static str> {
    let is_over = invitation.ends_ms.is_some_and(|ends_ms| (ends_ms as f64) <= browser::today_ms());
    match invitation {
        Invitation { unwritten: true, .. } => Some(words::is_revoked_unwritten()),
        Invitation { revoked: true, .. } => Some(words::is_revoked()),
        _ => is_over.then(words::is_over),
    }
}

#[component]
fn Person(came: InvitedGuest) -> impl IntoView {
    let seconds = (browser::today_ms() as u64).saturating_sub(came.at_ms) / 1_000;
    let day = || words::on_day(&browser::day_words(came.at_ms as f64));
    let when = if came.here { words::here_now().to_owned() } else { words::ago(seconds).unwrap_or_else(day) };
    let here = came.here.then(|| view! { <span class="here-dot" aria-hidden="true"></span> });
    view! { {here}{words::came(&came.name, &when)} }
}

/// Asks once.
#[component]
fn Revoke(id: behaviour::Id, name: String, here: usize, asked: RwSignal<Option<behaviour::Id>>) -> impl IntoView {
    let desk = hold();
    let (mine, wanted) = (id.clone(), id.clone());
    let is_asked = Memo::new(move |_| asked.read().as_ref() == Some(&mine));
    let id = StoredValue::new(id);
    let label = words::revoke_named(&name);
    move || {
        if is_asked.get() {
            view! {
                <div class="revoke-question" role="group" aria-label=label.clone()>
                    <p role="status">{words::revoke_question(here)}</p>
                    <div class="row">
                        <button class="button danger" type="button" on:click=move |_| {
                            desk.desk().revoke(&id.get_value());
                            asked.set(None);
                        }>{words::revoke()}</button>
                        <button class="button" type="button" on:click=move |_| asked.set(None)>{words::keep_invitation()}</button>
                    </div>
                </div>
            }
            .into_any()
        } else {
            let wanted = wanted.clone();
            view! {
                <button class="button small" type="button" aria-label=label.clone() on:click=move |_| asked.set(Some(wanted.clone()))>
                    {words::revoke()}
                </button>
            }
            .into_any()
        }
    }
}
