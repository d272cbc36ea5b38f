//! The dialog about one's own name.

use crate::dialogs::OneName;
use crate::parts::hold;
use crate::people::words;
use leptos::prelude::*;

/// The longest name of a person, in characters.
const MY_NAME_MAX_CHARS: usize = 40;

/// A dialog for the name that the others see.
#[component]
pub(crate) fn MyName() -> impl IntoView {
    let desk = hold();
    let now = desk.desk().me.get_untracked().map(|me| me.name).unwrap_or_default();
    let done = Callback::new(move |name: String| desk.desk().set_my_name(&name));
    view! { <OneName title=words::my_name() now hint=words::my_name_hint() max_chars=MY_NAME_MAX_CHARS done /> }
}
