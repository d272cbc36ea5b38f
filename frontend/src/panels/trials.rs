//! What a procedure makes of the newest real values: asked of the server while somebody writes or looks.

use super::hold::{Hold, Soon, hold};
use crate::live::short_value;
use crate::words;
use behaviour::{Id, StreamKind, Value};
use leptos::prelude::*;

/// How many sets of values are tried.
const SETS_MAX: usize = 5;
/// How long a person may type before the procedure is looked at, in milliseconds.
const SOON_MS: i32 = 200;

/// A procedure and the streams it takes from.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Question {
    pub(crate) arguments: Vec<String>,
    pub(crate) body: String,
    pub(crate) inputs: Vec<Id>,
    /// The values of the arguments before those of the inputs.
    pub(crate) before: Vec<Value>,
    /// Whether its result only says if the value passes.
    pub(crate) is_test: bool,
}

/// One set of values and what came of it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Trial {
    pub(crate) given: String,
    pub(crate) from: Origin,
    pub(crate) result: String,
    /// Whether the value passes, or that it failed.
    pub(crate) mark: Mark,
}

/// Where the values of a trial are from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Origin {
    /// What flows now.
    Now,
    /// What flowed last, before it was stopped.
    Last,
    /// What came before the newest.
    Earlier,
    /// Nothing came yet; a value such as the sense gives.
    Example,
}

impl Origin {
    fn words(self) -> &'static str {
        match self {
            Self::Now => words::now(),
            Self::Last => words::last(),
            Self::Example => words::for_example(),
            Self::Earlier => "",
        }
    }
}

/// How a trial went.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mark {
    Passes,
    /// It does not pass.
    Left,
    Plain,
    Fails,
}

/// The answers so far.
#[derive(Clone)]
pub(crate) struct Answers {
    /// Why the procedure cannot run at all.
    pub(crate) error: ArcRwSignal<Option<String>>,
    pub(crate) trials: ArcRwSignal<Vec<Trial>>,
    number: ArcRwSignal<u32>,
}

/// Keeps asking while the question or the values change.
pub(crate) fn ask(question: Memo<Option<Question>>) -> Answers {
    let answers =
        Answers { error: ArcRwSignal::new(None), trials: ArcRwSignal::default(), number: ArcRwSignal::new(0) };
    let desk = hold();
    let told = answers.clone();
    let soon = Soon::new(move || {
        if let Some(asked) = question.try_get_untracked() {
            told.ask(desk, asked);
        }
    });
    Effect::new(move |_| {
        // What flows now is only the last value once it stops.
        desk.desk().robots.runs.track();
        if let Some(question) = question.get() {
            for input in &question.inputs {
                if let Some(signals) = desk.desk().document.stream(input) {
                    signals.live.track();
                }
            }
        }
        soon.within(SOON_MS);
    });
    answers
}

impl Answers {
    fn ask(&self, desk: Hold, question: Option<Question>) {
        let number = self.number.get_untracked() + 1;
        self.number.set(number);
        let Some(question) = question.filter(|question| !question.body.trim().is_empty()) else {
            self.error.set(None);
            self.trials.set(Vec::new());
            return;
        };
        let (froms, sets): (Vec<Origin>, Vec<Vec<Value>>) = sets(desk, &question.inputs).into_iter().unzip();
        let me = self.clone();
        let whole = |set: &Vec<Value>| question.before.iter().chain(set).cloned().collect();
        let asked = (question.arguments.clone(), question.body.clone(), sets.iter().map(whole).collect());
        desk.desk().document.check_body(asked.0, asked.1, asked.2, move |(error, results)| {
            if me.number.get_untracked() == number {
                let given = froms.into_iter().zip(&sets).zip(results);
                let trials = given.map(|((from, set), result)| trial(from, set, result, question.is_test));
                me.trials.set(trials.collect());
                me.error.set(error);
            }
        });
    }
}

fn trial(from: Origin, set: &[Value], result: Result<Value, String>, is_test: bool) -> Trial {
    let given = set.iter().map(short_value).collect::<Vec<_>>().join(", ");
    let (result, mark) = match result {
        Ok(Value::Bool(true)) if is_test => (words::passes().to_owned(), Mark::Passes),
        Ok(_) if is_test => (words::stopped().to_owned(), Mark::Left),
        Ok(value) => (short_value(&value), Mark::Plain),
        Err(reason) => (reason, Mark::Fails),
    };
    Trial { given, from, result, mark }
}

/// The newest values of all inputs, then older numbers of a single input; examples where nothing came yet.
fn sets(desk: Hold, inputs: &[Id]) -> Vec<(Origin, Vec<Value>)> {
    let newest: Option<Vec<(bool, Value)>> = inputs.iter().map(|id| newest(desk, id)).collect();
    let Some(newest) = newest.filter(|set| !set.is_empty()) else { return Vec::new() };
    let runs = untrack(|| desk.desk().robots.running().is_some() && desk.desk().unheard.read().is_none());
    let from = match (newest.iter().any(|(example, _)| *example), runs) {
        (true, _) => Origin::Example,
        (false, true) => Origin::Now,
        (false, false) => Origin::Last,
    };
    let newest: Vec<Value> = newest.into_iter().map(|(_, value)| value).collect();
    let mut sets = vec![(from, newest)];
    if let [input] = inputs
        && let Some(signals) = desk.desk().document.stream(input)
    {
        for number in signals.live.read_untracked().recent.iter().rev() {
            let set = vec![Value::Float(*number)];
            if sets.len() < SETS_MAX && sets.iter().all(|(_, known)| *known != set) {
                sets.push((Origin::Earlier, set));
            }
        }
    }
    sets
}

/// At most five sets of values that really came; none where only examples are known.
pub(crate) fn real_sets(desk: Hold, inputs: &[Id]) -> Vec<Vec<Value>> {
    let sets = sets(desk, inputs);
    if sets.iter().any(|(from, _)| *from == Origin::Example) {
        return Vec::new();
    }
    sets.into_iter().map(|(_, set)| set).collect()
}

/// Tries a procedure once on sets of values. Not answered where there are none, without a link, or if it cannot run.
pub(crate) fn try_on(desk: Hold, question: Question, sets: Vec<Vec<Value>>, then: impl FnOnce(Vec<Trial>) + 'static) {
    if sets.is_empty() {
        return;
    }
    let whole = sets.iter().map(|set| question.before.iter().chain(set).cloned().collect()).collect();
    desk.desk().document.check_body(question.arguments, question.body, whole, move |(_, results)| {
        let given = sets.iter().zip(results);
        then(given.map(|(set, result)| trial(Origin::Earlier, set, result, question.is_test)).collect());
    });
}

/// The newest value of a stream, or an example, which the first part tells.
fn newest(desk: Hold, id: &Id) -> Option<(bool, Value)> {
    let signals = desk.desk().document.stream(id)?;
    if let Some(value) = signals.live.read_untracked().value.clone() {
        return Some((false, value));
    }
    let stream = signals.record.get_untracked();
    let device = robot::device(StreamKind::Sensor, stream.device.as_deref()?).ok()?;
    crate::json::read(device.example).ok().map(|example| (true, example))
}

/// The trials in one line: "now 14.2 → passes".
#[component]
pub(crate) fn TrialLine(answers: Answers) -> impl IntoView {
    let shown = move || {
        let trial = |trial: Trial| {
            let from = trial.from.words();
            view! { <span class=class(trial.mark)>{from}" "{words::trial(&trial.given, &trial.result)}</span> }
        };
        answers.trials.get().into_iter().map(trial).collect_view()
    };
    view! { <div class="trials">{shown}</div> }
}

/// The trials as a table, for the inspector.
#[component]
pub(crate) fn TrialTable(answers: Answers) -> impl IntoView {
    let trials = answers.trials;
    let any = trials.clone();
    let row = |trial: Trial| {
        let mark = if trial.mark == Mark::Passes { "✓ " } else { "" };
        let not_now = matches!(trial.from, Origin::Example | Origin::Last);
        let from = not_now.then(|| view! { <span class="faint">{trial.from.words()}" "</span> });
        view! {
            <tr>
                <td class="cut" title=trial.given.clone()>{from}{trial.given.clone()}</td>
                <td class=format!("cut {}", class(trial.mark)) title=trial.result.clone()>{mark}{trial.result.clone()}</td>
            </tr>
        }
    };
    view! {
        <Show when=move || !any.read().is_empty()>
            <table class="values">
                <thead><tr><th scope="col">{words::last_inputs()}</th><th scope="col">{words::result()}</th></tr></thead>
                <tbody>{
                    let trials = trials.clone();
                    move || trials.get().into_iter().map(row).collect_view()
                }</tbody>
            </table>
        </Show>
    }
}

fn class(mark: Mark) -> &'static str {
    match mark {
        Mark::Passes => "good",
        Mark::Plain | Mark::Left => "",
        Mark::Fails => "bad-text",
    }
}
