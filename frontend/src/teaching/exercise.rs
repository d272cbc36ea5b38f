//! The goal of an exercise, and whether it is reached.

use crate::browser;
use crate::icons::Icon;
use crate::parts::hold;
use crate::teaching::words;
use leptos::prelude::*;
use protocol::{Exercise, ExerciseQuestion, RehearsalResult};
use web_sys::HtmlElement;

/// The id of what folds.
const GOAL_ID: &str = "exercise-goal";

/// The goal, as a view.
pub(crate) fn exercise(exercise: Exercise) -> AnyView {
    view! { <Goal exercise /> }.into_any()
}

/// What was found, in words, and whether it is good.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Verdict {
    says: String,
    good: bool,
}

#[component]
fn Goal(exercise: Exercise) -> impl IntoView {
    let desk = hold();
    let folded = RwSignal::new(false);
    let name = words::exercise_called(&words::template_name(&exercise.start));
    let put_away = move |_| {
        let desk = desk.desk();
        desk.put_away.set(desk.document.open.get_untracked());
        desk.say(words::exercise_put_away(), false);
    };
    let goal = words::shown(&exercise.goal);
    let fold = move || if folded.get() { words::show_goal() } else { words::fold_goal() };
    view! {
        <section class="panel exercise" aria-label=name>
            <div class="exercise-head">
                <h2>{name.clone()}</h2>
                <button class="tool icon fold" class:folded=move || folded.get() type="button" title=fold aria-label=fold
                    aria-expanded=move || (!folded.get()).to_string() aria-controls=GOAL_ID
                    on:click=move |_| folded.update(|folded| *folded = !*folded)>
                    <Icon name="chevron" />
                </button>
                <button class="tool icon" type="button" title=words::put_goal_away() aria-label=words::put_goal_away()
                    on:click=put_away>
                    <Icon name="close" />
                </button>
            </div>
            <div id=GOAL_ID hidden=move || folded.get()>
                <p>{goal}</p>
                <TryIt exercise />
            </div>
        </section>
    }
}

#[component]
fn TryIt(exercise: Exercise) -> impl IntoView {
    let desk = hold();
    let verdict = RwSignal::new(None::<Verdict>);
    // How often it was tried or edited; an answer to what is no more is nothing.
    let number = StoredValue::new(0_u32);
    let busy = RwSignal::new(false);
    let begin = move || {
        number.update_value(|number| *number += 1);
        verdict.set(None);
        busy.set(false);
    };
    Effect::new(move |_| {
        desk.desk().document.edited.track();
        begin();
    });
    let answers = RwSignal::new(vec![None::<u8>; exercise.asks.len()]);
    let asks = exercise.asks.clone();
    let questions = (0..).zip(asks).map(move |(at, question)| view! { <Asked at question answers begin /> });
    let press = move |_| {
        begin();
        let Some(answers) = answers.get_untracked().into_iter().collect::<Option<Vec<u8>>>() else {
            verdict.set(Some(Verdict { says: words::answer_first().to_owned(), good: false }));
            return;
        };
        busy.set(true);
        let mine = number.get_value();
        desk.desk().library.try_exercise(&exercise, answers, move |tried| {
            if number.try_get_value() == Some(mine) {
                busy.set(false);
                verdict.set(Some(
                    tried.map_or_else(|why| Verdict { says: words::not_answered(&why), good: false }, judged),
                ));
            }
        });
    };
    let place = NodeRef::<leptos::html::Div>::new();
    Effect::new(move |_| {
        if verdict.read().is_some() {
            browser::rendered(move || place.try_get_untracked().flatten().iter().for_each(|place| show(place)));
        }
    });
    let said = move || {
        let icon = |good| if good { "check" } else { "warn" };
        verdict.get().map(|Verdict { says, good }| {
            view! { <p class="verdict" class:reached=good><Icon name=icon(good) /><span>{says}</span></p> }
        })
    };
    view! {
        {questions.collect_view()}
        <button class="button" type="button" aria-busy=move || busy.get().to_string() on:click=press>
            <Icon name="play" />
            {words::try_it()}
        </button>
        <div role="status" node_ref=place>{said}{move || busy.get().then(|| view! { <p class="faint">{words::rehearsing()}</p> })}</div>
    }
}

/// Scrolls to what is said, unless all of it is seen.
fn show(place: &HtmlElement) {
    let end = place.get_bounding_client_rect();
    let at = ((end.left() + end.right()) / 2.0, end.bottom() - 2.0);
    let seen = document().element_from_point(at.0 as f32, at.1 as f32);
    if !seen.is_some_and(|seen| place.contains(Some(&seen))) {
        place.scroll_into_view_with_bool(false);
    }
}

/// A question with its answers, of which one is chosen; another choice takes back what was said before.
#[component]
fn Asked(
    at: usize,
    question: ExerciseQuestion,
    answers: RwSignal<Vec<Option<u8>>>,
    begin: impl Fn() + Copy + Send + 'static,
) -> impl IntoView {
    let answer = move |(which, text): (u8, phrase::Phrase)| {
        let chosen = move || answers.read().get(at).copied().flatten() == Some(which);
        let choose = move |_| {
            answers.update(|answers| {
                if let Some(answer) = answers.get_mut(at) {
                    *answer = Some(which);
                }
            });
            begin();
        };
        view! {
            <label class="radio">
                <input type="radio" name=format!("asked-{at}") prop:checked=chosen on:change=choose />
                <span>{words::shown(&text)}</span>
            </label>
        }
    };
    view! {
        <fieldset class="asked">
            <legend>{words::shown(&question.ask)}</legend>
            {(0..).zip(question.answers).map(answer).collect_view()}
        </fieldset>
    }
}

fn judged(tried: RehearsalResult) -> Verdict {
    let missed = |says: String| Verdict { says, good: false };
    match tried {
        RehearsalResult::Reached(says) => Verdict { says: words::goal_reached(&words::shown(&says)), good: true },
        RehearsalResult::Missed { says, fault: None } => missed(words::shown(&says)),
        RehearsalResult::Missed { says, fault: Some(why) } => {
            missed(words::goal_missed_by(&words::shown(&says), &words::shown(&why)))
        }
        RehearsalResult::Empty => missed(words::goal_of_empty().to_owned()),
        RehearsalResult::TooLarge => missed(words::goal_too_large().to_owned()),
        RehearsalResult::CannotRun(why) => missed(words::goal_cannot_run(&words::shown_within(&why))),
        RehearsalResult::TooLong => missed(words::goal_too_long().to_owned()),
    }
}
