//! Invite: a link for somebody else, what they may do with it, and who came by which.

mod list;
mod made;
mod making;
mod warning;

use crate::desk::NewInvitation;
use crate::dialogs::{Frame, close};
use crate::link::NoAnswer;
use crate::parts::hold;
use crate::people::words;
use leptos::prelude::*;
use protocol::Refused;

/// Letting others in.
#[component]
pub(crate) fn Invite() -> impl IntoView {
    let desk = hold();
    let no = RwSignal::new(None::<NoAnswer>);
    let made = RwSignal::new(None::<NewInvitation>);
    desk.desk().list_invitations(move |why| {
        no.try_set(Some(why));
    });
    let content = move || match no.get() {
        Some(NoAnswer::Refused(Refused::NobodyComes)) => view! { <Alone /> }.into_any(),
        Some(why) => view! { <p class="refusal" role="alert">{words::not_answered(&why)}</p> }.into_any(),
        None => view! {
            {move || match made.get() {
                Some(invited) => view! { <made::Made invited made /> }.into_any(),
                None => view! { <making::Making made /> }.into_any(),
            }}
            <list::List />
        }
        .into_any(),
    };
    // Enter in a field makes the link: see `making`.
    view! {
        <Frame title=words::invite_somebody() save=Callback::new(move |()| making::submit())>
            <div class="dialog-body invite">{content}</div>
            <div class="dialog-feet">
                <button class="button" type="button" on:click=move |_| close(desk)>{words::close()}</button>
            </div>
        </Frame>
    }
}

/// Nobody else reaches the server: how they would.
#[component]
fn Alone() -> impl IntoView {
    let copied = RwSignal::new(false);
    let copy = move |_| copied.set(crate::browser::copy(words::listen_example()));
    view! {
        <p>{words::only_this_computer()}</p>
        <p>{words::how_to_let_in()}</p>
        <div class="copy-line">
            <code class="code-line">{words::listen_example()}</code>
            <button class="button" type="button" on:click=copy>
                {move || if copied.get() { words::link_copied() } else { words::copy_link() }}
            </button>
        </div>
        <p class="second">{words::listen_says()}</p>
    }
}
