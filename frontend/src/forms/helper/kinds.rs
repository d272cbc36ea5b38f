//! What a helper takes for each parameter and what it gives, chosen in plain words; at first it is found out by itself.

use super::HelperFields;
use crate::fields::{ChoiceOptions, Select};
use crate::forms::words;
use behaviour::{Declared, Helper};
use leptos::prelude::*;

/// The word of what is chosen for each parameter, by its name: it stays with the name while others are typed.
#[derive(Clone, Copy)]
pub(super) struct Kinds {
    takes: StoredValue<Vec<(String, RwSignal<String>)>>,
    gives: RwSignal<String>,
}

impl Kinds {
    pub(super) fn of(helper: &Helper) -> Self {
        let chosen = |(at, name): (usize, &String)| (name.clone(), RwSignal::new(helper.taken(at).word().to_owned()));
        let takes = helper.params.iter().enumerate().map(chosen).collect();
        Self { takes: StoredValue::new(takes), gives: RwSignal::new(helper.gives.word().to_owned()) }
    }

    /// Shows what is chosen in a helper.
    pub(super) fn show(self, helper: &Helper) {
        for (at, name) in helper.params.iter().enumerate() {
            self.of_argument(name).set(helper.taken(at).word().to_owned());
        }
        self.gives.set(helper.gives.word().to_owned());
    }

    fn of_argument(self, name: &str) -> RwSignal<String> {
        let known = |all: &mut Vec<(String, RwSignal<String>)>| {
            let found = all.iter().find(|(one, _)| one == name).map(|(_, chosen)| *chosen);
            found.unwrap_or_else(|| {
                let new = RwSignal::new(Declared::Auto.word().to_owned());
                all.push((name.to_owned(), new));
                new
            })
        };
        self.takes.try_update_value(known).unwrap_or_default()
    }

    /// What is chosen for these parameters; those at the end of which nobody said anything are left out. Reactive.
    pub(super) fn takes(self, params: &[String]) -> Vec<Declared> {
        let mut takes: Vec<_> = params.iter().map(|name| chosen(self.of_argument(name))).collect();
        while takes.last().is_some_and(Declared::is_auto) {
            takes.pop();
        }
        takes
    }

    /// What is chosen for the result. Reactive.
    pub(super) fn gives(self) -> Declared {
        chosen(self.gives)
    }
}

fn chosen(word: RwSignal<String>) -> Declared {
    Declared::of_word(&word.read()).unwrap_or_default()
}

/// A list for each parameter, and one for the result.
#[component]
pub(super) fn KindFields(fields: HelperFields, arguments: Signal<Vec<String>>) -> impl IntoView {
    let names = Memo::new(move |_| super::trying::once_each(arguments.get()));
    let field = move |name: String| {
        view! { <Select label=words::helper_takes(&name) options=options() value=fields.kinds.of_argument(&name) /> }
    };
    view! {
        <div class="try-values">
            <For each=move || names.get() key=Clone::clone children=field />
            <Select label=words::helper_gives() options=options() value=fields.kinds.gives />
        </div>
    }
}

fn options() -> ChoiceOptions {
    Declared::all().into_iter().map(|one| (one.word().to_owned(), words::declared(one))).collect()
}
