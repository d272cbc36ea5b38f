//! What a procedure makes of the newest real values: asked of the server while somebody writes or looks.

use crate::forms::words;
pub(crate) use crate::live::LAST_MAX as SETS_MAX;
use crate::live::short_value;
use crate::parts::{DeskHold, Soon, hold};
use behaviour::{Connector, Id, Procedure, StreamKind, Value};
use leptos::prelude::*;
use phrase::Phrase;
use protocol::UnknownName;

/// How long a person may type before the procedure is looked at, in milliseconds.
const SOON_MS: i32 = 200;

/// A procedure and the streams it takes from.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TrialQuestion {
    pub(crate) arguments: Vec<String>,
    pub(crate) body: String,
    pub(crate) inputs: Vec<Id>,
    /// The values of the arguments before those of the inputs.
    pub(crate) before: Vec<Value>,
    /// Whether its result only says if the value passes.
    pub(crate) is_test: bool,
}

/// Returns the question that tries a connector's procedure; none where it has no procedure, or its helper does not fit. Reactive.
pub(crate) fn question_of(desk: DeskHold, connector: &Connector) -> Option<TrialQuestion> {
    let desk = desk.desk();
    let spec = connector.operation.spec();
    let is_test = spec.is_test();
    let inputs = connector.inputs.clone();
    let before: Vec<Value> = connector.operation.start().cloned().into_iter().collect();
    match connector.operation.procedure()? {
        Procedure::Body { body, args } => {
            let names = inputs.iter().filter_map(|id| Some(desk.document.stream(id)?.record.read().name.clone()));
            let names: Vec<String> = names.collect();
            let derived = || spec.argument_names(names.iter().map(String::as_str));
            let arguments = args.clone().unwrap_or_else(derived);
            Some(TrialQuestion { arguments, body: body.clone(), inputs, before, is_test })
        }
        Procedure::Helper(name) => {
            let helpers = desk.library.helpers.get();
            let (_, helper) = helpers.into_iter().find(|(_, helper)| helper.name == *name)?;
            let fits = helper.params.len() == spec.argument_count(inputs.len());
            fits.then_some(TrialQuestion { arguments: helper.params, body: helper.body, inputs, before, is_test })
        }
    }
}

/// One set of values and what came of it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Trial {
    /// The values, one an argument.
    pub(crate) values: Vec<String>,
    pub(crate) from: TrialOrigin,
    pub(crate) result: String,
    /// Whether the value passes, or that it failed.
    pub(crate) mark: TrialMark,
}

impl Trial {
    /// All of them in one line.
    pub(crate) fn given(&self) -> String {
        words::listed(self.values.iter().cloned())
    }
}

/// Where the values of a trial are from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TrialOrigin {
    /// What flows now.
    Now,
    /// What flowed last, before it was stopped.
    Last,
    /// What came before the newest.
    Earlier,
    /// Nothing came yet; a value such as the sense gives.
    Example,
}

impl TrialOrigin {
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
pub(crate) enum TrialMark {
    Passes,
    /// It does not pass.
    Left,
    Plain,
    Fails,
}

/// The answers so far.
#[derive(Clone)]
pub(crate) struct TrialAnswers {
    /// Why the procedure cannot run at all.
    pub(crate) error: ArcRwSignal<Option<String>>,
    pub(crate) trials: ArcRwSignal<Vec<Trial>>,
    /// A name in it that means nothing.
    pub(crate) unknown: ArcRwSignal<Option<UnknownName>>,
    number: ArcRwSignal<u32>,
    /// Whether they come while values flow; ones that read alike are told once.
    flow: bool,
}

/// Keeps asking while the question or the values change.
pub(crate) fn ask(question: Memo<Option<TrialQuestion>>) -> TrialAnswers {
    let answers = TrialAnswers::none(true);
    let desk = hold();
    let told = answers.clone();
    let soon = Soon::new(move || {
        if let Some(asked) = question.try_get_untracked() {
            let sets = asked.as_ref().map_or_else(Vec::new, |asked| sets(desk, &asked.inputs));
            told.ask(desk, asked, sets);
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

/// Keeps asking about values that somebody writes down.
pub(crate) fn ask_on(question: Memo<(TrialQuestion, Vec<Vec<Value>>)>) -> TrialAnswers {
    let answers = TrialAnswers::none(false);
    let desk = hold();
    let told = answers.clone();
    let soon = Soon::new(move || {
        if let (Some((asked, sets)), Some(_)) = (question.try_get_untracked(), desk.if_there()) {
            told.ask(desk, Some(asked), sets.into_iter().map(|set| (TrialOrigin::Earlier, set)).collect());
        }
    });
    Effect::new(move |_| {
        question.track();
        soon.within(SOON_MS);
    });
    answers
}

impl TrialAnswers {
    fn none(flow: bool) -> Self {
        Self {
            error: ArcRwSignal::new(None),
            trials: ArcRwSignal::default(),
            unknown: ArcRwSignal::new(None),
            number: ArcRwSignal::new(0),
            flow,
        }
    }

    fn ask(&self, desk: DeskHold, question: Option<TrialQuestion>, sets: Vec<(TrialOrigin, Vec<Value>)>) {
        let number = self.number.get_untracked() + 1;
        self.number.set(number);
        let Some(question) = question.filter(|question| !question.body.trim().is_empty()) else {
            self.error.set(None);
            self.trials.set(Vec::new());
            self.unknown.set(None);
            return;
        };
        let (froms, sets): (Vec<TrialOrigin>, Vec<Vec<Value>>) = sets.into_iter().unzip();
        let me = self.clone();
        let whole = |set: &Vec<Value>| question.before.iter().chain(set).cloned().collect();
        let asked = (question.arguments.clone(), question.body.clone(), sets.iter().map(whole).collect());
        desk.desk().document.check_body(asked.0, asked.1, asked.2, move |(error, results, unknown)| {
            if me.number.get_untracked() == number {
                let given = froms.into_iter().zip(&sets).zip(results);
                let written = |set: &Vec<Value>| written(desk, &question.inputs, set);
                let trials = given.map(|((from, set), result)| trial(from, written(set), result, question.is_test));
                me.trials.set(if me.flow { read_once(trials) } else { trials.collect() });
                me.error.set(error.map(|error| match &unknown {
                    Some(unknown) => words::no_such_name(&unknown.name),
                    None => words::shown(&error),
                }));
                me.unknown.set(unknown);
            }
        });
    }
}

/// The trials without those that read like an earlier one, as values do that differ in what is not shown of them.
fn read_once(trials: impl Iterator<Item = Trial>) -> Vec<Trial> {
    let mut once: Vec<Trial> = Vec::new();
    for trial in trials {
        if once.iter().all(|known| (&known.values, &known.result) != (&trial.values, &trial.result)) {
            once.push(trial);
        }
    }
    once
}

/// Values of streams, with their units.
fn written(desk: DeskHold, inputs: &[Id], set: &[Value]) -> Vec<String> {
    let one = |(at, value): (usize, &Value)| match inputs.get(at) {
        Some(id) => untrack(|| desk.desk().document.measured(id, value)),
        None => short_value(value),
    };
    set.iter().enumerate().map(one).collect()
}

fn trial(from: TrialOrigin, values: Vec<String>, result: Result<Value, Phrase>, is_test: bool) -> Trial {
    let (result, mark) = match result {
        Ok(Value::Bool(true)) if is_test => (words::passes().to_owned(), TrialMark::Passes),
        Ok(_) if is_test => (words::stopped().to_owned(), TrialMark::Left),
        Ok(value) => (short_value(&value), TrialMark::Plain),
        Err(reason) => (words::shown(&reason), TrialMark::Fails),
    };
    Trial { values, from, result, mark }
}

/// The newest values of all inputs, then the ones before of a single input; examples where nothing came yet.
fn sets(desk: DeskHold, inputs: &[Id]) -> Vec<(TrialOrigin, Vec<Value>)> {
    let newest: Option<Vec<(bool, Value)>> = inputs.iter().map(|id| newest(desk, id)).collect();
    let Some(newest) = newest.filter(|set| !set.is_empty()) else { return Vec::new() };
    let runs = untrack(|| desk.desk().robots.running().is_some() && desk.desk().unheard.read().is_none());
    let from = match (newest.iter().any(|(example, _)| *example), runs) {
        (true, _) => TrialOrigin::Example,
        (false, true) => TrialOrigin::Now,
        (false, false) => TrialOrigin::Last,
    };
    let newest: Vec<Value> = newest.into_iter().map(|(_, value)| value).collect();
    let mut sets = vec![(from, newest)];
    if let [input] = inputs
        && let Some(signals) = desk.desk().document.stream(input)
    {
        for value in signals.live.read_untracked().last.iter().rev() {
            let set = vec![value.clone()];
            if sets.len() < SETS_MAX && sets.iter().all(|(_, known)| *known != set) {
                sets.push((TrialOrigin::Earlier, set));
            }
        }
    }
    sets
}

/// At most five sets of values that really came; none where only examples are known.
pub(crate) fn real_sets(desk: DeskHold, inputs: &[Id]) -> Vec<Vec<Value>> {
    let sets = sets(desk, inputs);
    if sets.iter().any(|(from, _)| *from == TrialOrigin::Example) {
        return Vec::new();
    }
    sets.into_iter().map(|(_, set)| set).collect()
}

/// Tries a procedure once on sets of values. Not answered where there are none, without a link, or if it cannot run.
pub(crate) fn try_on(
    desk: DeskHold,
    question: TrialQuestion,
    sets: Vec<Vec<Value>>,
    then: impl FnOnce(Vec<Trial>) + 'static,
) {
    if sets.is_empty() {
        return;
    }
    let whole = sets.iter().map(|set| question.before.iter().chain(set).cloned().collect()).collect();
    let inputs = question.inputs;
    desk.desk().document.check_body(question.arguments, question.body, whole, move |(_, results, _)| {
        let given = sets.iter().map(|set| written(desk, &inputs, set)).zip(results);
        then(given.map(|(values, result)| trial(TrialOrigin::Earlier, values, result, question.is_test)).collect());
    });
}

/// The newest value of a stream, or an example, which the first part tells.
fn newest(desk: DeskHold, id: &Id) -> Option<(bool, Value)> {
    let signals = desk.desk().document.stream(id)?;
    if let Some(value) = signals.live.read_untracked().value.clone() {
        return Some((false, value));
    }
    let stream = signals.record.get_untracked();
    let device = robot::device(StreamKind::Sensor, stream.device.as_deref()?).ok()?;
    crate::json::read(device.example).ok().map(|example| (true, example))
}

/// The trials in one line: "now 14.2 → passes". While values flow it is always as high, so that nothing under it moves
/// away from who is about to press it; the earliest are left out where they do not fit.
#[component]
pub(crate) fn TrialLine(answers: TrialAnswers) -> impl IntoView {
    let desk = hold();
    let flow = answers.flow;
    let steady = move || flow && desk.desk().robots.running().is_some();
    let shown = move || {
        let trial = |trial: Trial| {
            let from = trial.from.words();
            view! { <span class=class(trial.mark)>{from}" "{words::trial(&trial.given(), &trial.result)}</span> }
        };
        answers.trials.get().into_iter().map(trial).collect_view()
    };
    view! { <div class="trials" class:steady=steady>{shown}</div> }
}

/// The trials as a table, for the inspector; `unit` is that of what comes out, if it is a number of one.
#[component]
pub(crate) fn TrialTable(answers: TrialAnswers, unit: Signal<&'static str>) -> impl IntoView {
    let trials = answers.trials;
    let any = trials.clone();
    let row = move |trial: Trial| {
        let mark = if trial.mark == TrialMark::Passes { "✓ " } else { "" };
        let not_now = matches!(trial.from, TrialOrigin::Example | TrialOrigin::Last);
        let from = not_now.then(|| view! { <span class="faint">{trial.from.words()}" "</span> });
        let given = trial.given();
        let result = words::with_unit(trial.result, if trial.mark == TrialMark::Plain { unit.get() } else { "" });
        view! {
            <tr>
                <td class="cut" title=given.clone()>{from}{given.clone()}</td>
                <td class=format!("cut {}", class(trial.mark)) title=result.clone()>{mark}{result.clone()}</td>
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

fn class(mark: TrialMark) -> &'static str {
    match mark {
        TrialMark::Passes => "good",
        TrialMark::Plain | TrialMark::Left => "",
        TrialMark::Fails => "bad-text",
    }
}

#[cfg(test)]
mod tests {
    use super::{Trial, TrialMark, TrialOrigin, read_once};

    #[test]
    fn what_reads_alike_is_told_once() {
        let trial = |from, given: &str, result: &str| Trial {
            values: vec![given.to_owned()],
            from,
            result: result.to_owned(),
            mark: TrialMark::Plain,
        };
        let now = trial(TrialOrigin::Now, "20", "stopped");
        let other = trial(TrialOrigin::Earlier, "20", "passes");
        let alike = trial(TrialOrigin::Earlier, "20", "stopped");
        let told = read_once([now.clone(), alike, other.clone(), other.clone()].into_iter());
        assert_eq!(told, [now, other], "the newest stays, and what came out differently");
    }
}
