//! Trying a helper: a value for each argument, and what it makes of them; several in a row as marbles.

use super::HelperFields;
use super::values::{example, fields, fits, sets, typed, written};
use crate::fields::TextField;
use crate::forms::marbles::{ASIDE, Bead, LANE, MarbleLook, NAME, WIDTH, lane};
use crate::forms::trials::{self, Trial, TrialAnswers, TrialLine, TrialQuestion};
use crate::forms::words;
use crate::keys::PressedKey;
use crate::palette::users_of;
use crate::parts::{DeskHold, hold};
use behaviour::{Helper, Id, Value};
use leptos::prelude::*;
use protocol::UnknownName;
use std::collections::BTreeMap;
use web_sys::KeyboardEvent;

/// The longest values of one argument, in characters.
const VALUES_MAX_CHARS: usize = 2_000;
/// The most letters of a marble between others.
const LETTERS_MAX: usize = 6;

/// What is typed for an argument.
#[derive(Clone)]
struct TypedArgument {
    text: ArcRwSignal<String>,
    /// What was proposed; it may be replaced as long as nobody typed.
    proposed: String,
}

/// The values of all arguments that there were, by name.
type All = StoredValue<BTreeMap<String, TypedArgument>>;

/// The fields to try the helper with, and what comes of it.
#[component]
pub(super) fn TryIt(
    fields: HelperFields,
    arguments: Signal<Vec<String>>,
    error: RwSignal<Option<String>>,
    unknown: RwSignal<Option<UnknownName>>,
) -> impl IntoView {
    let desk = hold();
    let all: All = StoredValue::default();
    let helper = Memo::new(move |_| fields.helper());
    let names = Memo::new(move |_| once_each(arguments.get()));
    propose(desk, helper, all);
    let question = Memo::new(move |_| {
        let helper = helper.get();
        let columns: Vec<_> = helper.params.iter().map(|name| typed(&text_of(all, name).get())).collect();
        let (arguments, body) = (helper.params, helper.body);
        (TrialQuestion { arguments, body, inputs: Vec::new(), before: Vec::new(), is_test: false }, sets(&columns))
    });
    let answers = trials::ask_on(question);
    let found = answers.error.clone();
    Effect::new(move |_| error.set(found.get()));
    let wrong = answers.unknown.clone();
    Effect::new(move |_| unknown.set(wrong.get()));
    let field = move |name: String| {
        let text = RwSignal::from(text_of(all, &name));
        view! { <TextField label=words::value_for(&name) value=text mono=true max_chars=VALUES_MAX_CHARS /> }
    };
    view! {
        <section class="field try" aria-labelledby="try-helper" on:keydown=stay>
            <h3 class="label" id="try-helper">{words::try_it()}</h3>
            <div class="try-values"><For each=move || names.get() key=Clone::clone children=field /></div>
            <p class="faint">{words::several_values()}</p>
            <div role="status"><Made names answers /></div>
        </section>
    }
}

pub(super) fn once_each(names: Vec<String>) -> Vec<String> {
    names.iter().enumerate().filter(|(at, name)| !names[..*at].contains(name)).map(|(_, name)| name.clone()).collect()
}

/// Enter saves no helper where one only tries it.
fn stay(event: KeyboardEvent) {
    if event.pressed() == "Enter" && !event.ctrl_key() && !event.meta_key() {
        event.prevent_default();
    }
}

fn text_of(all: All, name: &str) -> ArcRwSignal<String> {
    all.try_update_value(|all| {
        let none = || TypedArgument { text: ArcRwSignal::default(), proposed: String::new() };
        all.entry(name.to_owned()).or_insert_with(none).text.clone()
    })
    .unwrap_or_default()
}

/// Proposes values where nobody has typed: those that flow where the helper is used, else an example.
fn propose(desk: DeskHold, helper: Memo<Helper>, all: All) {
    Effect::new(move |_| {
        let helper = helper.get();
        let real = untrack(|| real(desk, &helper));
        for (at, name) in helper.params.iter().enumerate() {
            let text = text_of(all, name);
            let values = real.as_ref().map(|columns| columns[at].clone());
            let values = values.or_else(|| example(&helper, at).map(|one| vec![one])).unwrap_or_default();
            let proposed = written(&values);
            let new = all.try_update_value(|all| {
                let tried = all.get_mut(name)?;
                let untouched = text.with_untracked(|text| *text == tried.proposed && *text != proposed);
                tried.proposed.clone_from(&proposed);
                untouched.then_some(())
            });
            if new.flatten().is_some() {
                text.set(proposed);
            }
        }
    });
}

/// Values that really came, a column an argument: at a connector that uses the helper, else of any stream that fits.
fn real(desk: DeskHold, helper: &Helper) -> Option<Vec<Vec<Value>>> {
    let used = users_of(desk, &helper.name).into_iter().find_map(|id| inputs(desk, &id, helper.params.len()));
    let sets = used.map(|inputs| trials::real_sets(desk, &inputs)).filter(|sets| !sets.is_empty());
    let sets = sets.or_else(|| fitting(desk, helper))?;
    // The oldest first, as time runs from left to right.
    Some(
        (0..helper.params.len()).map(|at| sets.iter().rev().filter_map(|set| set.get(at).cloned()).collect()).collect(),
    )
}

/// The streams that a connector takes from, if they are as many as the arguments.
fn inputs(desk: DeskHold, connector: &Id, count: usize) -> Option<Vec<Id>> {
    let inputs = desk.desk().document.connector(connector)?.record.get().inputs;
    (inputs.len() == count).then_some(inputs)
}

/// The values of the first stream that fit the one argument.
fn fitting(desk: DeskHold, helper: &Helper) -> Option<Vec<Vec<Value>>> {
    let [argument] = &helper.params[..] else { return None };
    let wanted = fields(argument, &helper.body);
    let is_meant = |id: &Id| {
        let signals = desk.desk().document.stream(id)?;
        let name = signals.record.get().name;
        let is_named = behaviour::argument_names([&*name]).first() == Some(argument);
        let fits = signals.live.get().value.is_some_and(|value| fits(&value, &wanted));
        (fits && (is_named || !wanted.is_empty())).then(|| id.clone())
    };
    let stream = desk.desk().document.stream_ids.get().iter().find_map(is_meant)?;
    Some(trials::real_sets(desk, &[stream])).filter(|sets| !sets.is_empty())
}

/// What came of it: marbles for several values, and a line each.
#[component]
fn Made(names: Memo<Vec<String>>, answers: TrialAnswers) -> impl IntoView {
    let trials = answers.trials.clone();
    let marbles = move || {
        let (names, trials) = (names.get(), trials.get());
        let fit = trials.len() > 1 && trials.iter().all(|trial| trial.values.len() == names.len());
        fit.then(|| view! { <Marbles names trials /> })
    };
    view! { {marbles} <TrialLine answers /> }
}

#[component]
fn Marbles(names: Vec<String>, trials: Vec<Trial>) -> impl IntoView {
    let columns = || {
        let given = names.iter().enumerate().map(|(at, name)| {
            (name.clone(), trials.iter().map(move |trial| trial.values[at].clone()).collect::<Vec<_>>(), MarbleLook::In)
        });
        let made =
            (words::result().to_owned(), trials.iter().map(|trial| trial.result.clone()).collect(), MarbleLook::Out);
        given.chain(std::iter::once(made)).collect::<Vec<_>>()
    };
    let said = columns().into_iter().map(|(name, values, _)| words::lane_tells(&name, &words::listed(&values)));
    let said = words::one_after_another(&said.collect::<Vec<_>>());
    let height = LANE * (names.len() + 1) as f64;
    let count = trials.len();
    let drawn = columns().into_iter().zip(0_u32..).map(move |((name, values, look), row)| {
        let beads = values.into_iter().enumerate().map(move |(at, text)| Bead {
            x: x(at, count),
            text: cut(&text),
            under: None,
        });
        lane(name, beads, LANE * f64::from(row), look)
    });
    let guides: String = (0..count).map(|at| format!("M{} {}V{height}", x(at, count), NAME + 4.0)).collect();
    view! {
        <svg class="marbles" role="img" viewBox=format!("0 0 {WIDTH} {height}") aria-label=said>
            <path class="marble-guide" d=guides />
            {drawn.collect_view()}
        </svg>
    }
}

/// Where the marble of a value stands among so many.
fn x(at: usize, count: usize) -> f64 {
    let room = WIDTH - 2.0 * ASIDE;
    (ASIDE + room * at as f64 / (count.max(2) - 1) as f64).round()
}

/// What of a value fits on a marble; all of it is in the lines below.
fn cut(text: &str) -> String {
    let mut letters = text.chars();
    let start: String = letters.by_ref().take(LETTERS_MAX).collect();
    if letters.next().is_none() {
        start
    } else {
        format!("{}…", &start.chars().take(LETTERS_MAX - 2).collect::<String>())
    }
}

#[cfg(test)]
mod tests {
    use super::{ASIDE, WIDTH, cut, x};
    use crate::forms::trials::SETS_MAX;

    #[test]
    fn marbles_stand_side_by_side_and_say_what_fits() {
        assert_eq!((x(0, SETS_MAX), x(SETS_MAX - 1, SETS_MAX)), (ASIDE, WIDTH - ASIDE));
        assert_eq!(
            (cut("0.1235"), cut("x 0.08 · y 1"), cut("right")),
            ("0.1235".into(), "x 0.…".into(), "right".into())
        );
    }
}
