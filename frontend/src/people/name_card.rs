//! What others see as one's name, asked once and politely: when somebody else is here for the first time.

use crate::escape;
use crate::icons::Icon;
use crate::later::Later;
use crate::parts::hold;
use crate::people::words;
use leptos::prelude::*;

/// The longest name of a person, in characters.
const NAME_MAX_CHARS: usize = 40;
const FIELD_ID: &str = "name-card-field";

/// A small field that waits in a corner and takes nothing away: neither the keyboard nor what one is doing.
#[component]
pub(crate) fn NameCard() -> impl IntoView {
    let desk = hold();
    let is_asked = Memo::new(move |_| {
        let desk = desk.desk();
        desk.asks_for_name() && desk.dialog.with(Option::is_none)
    });
    let said = move || {
        let me = desk.desk().me.get().map(|me| me.name).unwrap_or_default();
        is_asked.get().then(|| words::others_see_you_as(&me))
    };
    view! {
        <Show when=move || is_asked.get()><Later show=|rest| (rest.asks_name)() /></Show>
        <p class="sr" role="status">{said}</p>
    }
}

/// The field for one's name.
pub(crate) fn asks_name() -> AnyView {
    view! { <Asked /> }.into_any()
}

#[component]
fn Asked() -> impl IntoView {
    let desk = hold();
    let now = desk.desk().me.get_untracked().map(|me| me.name).unwrap_or_default();
    let name = RwSignal::new(now);
    let save = move |event: leptos::ev::SubmitEvent| {
        event.prevent_default();
        desk.desk().set_my_name(&name.get_untracked());
    };
    let keys = move |event: web_sys::KeyboardEvent| {
        escape::ends(&event, || desk.desk().keep_my_name());
    };
    view! {
        <form class="notice name-card" autocomplete="off" aria-label=words::my_name() on:submit=save on:keydown=keys>
            <label class="label" for=FIELD_ID>{words::others_see_you()}</label>
            <input class="input" id=FIELD_ID type="text" maxlength=NAME_MAX_CHARS.to_string() prop:value=move || name.get()
                on:input=move |event| name.set(event_target_value(&event)) />
            <button class="button primary" type="submit">{words::save()}</button>
            <button class="tool icon" type="button" aria-label=words::name_not_now() title=words::name_not_now()
                on:click=move |_| desk.desk().keep_my_name()>
                <Icon name="close" />
            </button>
        </form>
    }
}
