//! The people in the program, each with a colour; one's own avatar changes one's name.

use super::hold::hold;
use crate::desk::{Dialog, use_desk};
use crate::words;
use leptos::prelude::*;

/// Everyone who is here.
#[component]
pub(super) fn People() -> impl IntoView {
    let desk = use_desk();
    let (people, me) = (desk.document.people.clone(), desk.me.clone());
    let shown = move || {
        let mine = me.get().map(|me| me.client);
        let everyone = if people.read().is_empty() { me.get().into_iter().collect() } else { people.get() };
        let avatar = |person: protocol::Person| {
            let is_me = Some(&person.client) == mine.as_ref();
            view! { <Avatar name=person.name color=person.color is_me /> }
        };
        everyone.into_iter().map(avatar).collect_view()
    };
    let unheard = move || desk.unheard.read().is_some();
    view! { <div class="people" class:unheard=unheard>{shown}</div> }
}

#[component]
fn Avatar(name: String, color: u8, is_me: bool) -> impl IntoView {
    let desk = hold();
    let initials = initials(&name);
    let color = format!("var(--people-{})", color.min(7));
    if is_me {
        let title = format!("{name} ({})", words::you());
        let label = format!("{initials}: {title}");
        view! {
            <button class="avatar" type="button" data-stop="" tabindex="-1" style=("--person", color) title=title
                aria-label=label on:click=move |_| desk.desk().dialog.set(Some(Dialog::MyName))>
                <span aria-hidden="true">{initials}</span>
            </button>
        }
        .into_any()
    } else {
        let label = name.clone();
        view! { <span class="avatar" role="img" style=("--person", color) title=name aria-label=label><span aria-hidden="true">{initials}</span></span> }
            .into_any()
    }
}

/// Two letters for a name: "AK" for Aiko, "YT" for Yuki Tanaka.
pub(super) fn initials(name: &str) -> String {
    let mut words = name.split_whitespace().filter_map(|word| word.chars().next());
    let letters: String = match (words.next(), words.next_back()) {
        (Some(first), Some(last)) => [first, last].into_iter().collect(),
        _ => name.trim().chars().take(2).collect(),
    };
    letters.to_uppercase()
}

#[cfg(test)]
mod tests {
    use super::initials;

    #[test]
    fn initials_are_two_letters() {
        assert_eq!(["Aiko", "Yuki Tanaka", "a b c", "愛子", ""].map(initials), ["AI", "YT", "AC", "愛子", ""]);
    }
}
