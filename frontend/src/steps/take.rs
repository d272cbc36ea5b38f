//! Taking a next step: at once where nothing is left to choose, else by way of its dialog.

use super::suggest::Step;
use crate::desk::{ConnectPlan, Desk, Dialog, NewSpot, Output, Selected};
use crate::naming::{NameParts, called};
use crate::words;
use behaviour::connectors::{self, PERIOD_MS, Spec};
use behaviour::{Helper, Id, Operation, Params, Procedure, Unit};
use leptos::prelude::*;
use protocol::Refused;

/// Does what was offered; a new stream goes to `spot`.
pub(crate) fn take(desk: &Desk, input: &Id, step: &Step, spot: NewSpot) {
    match step {
        Step::Connector(kind) if !is_chosen_at_once(kind, &spot) => {
            let dialog = Dialog::Operation { input: input.clone(), connector: None, kind, spot };
            desk.dialog.set(Some(dialog));
        }
        Step::Converted(from, to, then) => {
            let Some(first) = conversion(desk, input, (*from, *to), spot) else { return };
            match then.as_deref().and_then(|then| plan(desk, input, then, NewSpot::Below)) {
                Some((then, asks)) => desk.document.connect_twice(first, then, answered(desk, asks)),
                None => desk.document.connect(first, answered(desk, false)),
            }
        }
        _ => {
            if let Some((plan, asks)) = plan(desk, input, step, spot) {
                desk.document.connect(plan, answered(desk, asks));
            }
        }
    }
}

/// The connector that a step makes, and whether its settings are asked for then; none for one that asks first.
fn plan(desk: &Desk, input: &Id, step: &Step, spot: NewSpot) -> Option<(ConnectPlan, bool)> {
    let input = if let Step::Otherwise(.., tested) = step { tested } else { input };
    let (operation, output, asks) = match step {
        Step::Helper(name) => {
            (by_helper(name), new_output(desk, &words::NameLanguage::Page.helper(name), None, Params::new()), false)
        }
        Step::Connector(kind) => {
            (kind.with(()), new_output(desk, &name_of(desk, input, kind), None, Params::new()), false)
        }
        Step::Otherwise(spec, body, _) => {
            let output = new_output(desk, words::language::spoken().otherwise, None, Params::new());
            (spec.with(Procedure::body(body)), output, false)
        }
        Step::Action(device, params) => {
            let base = words::label_of(&device.next_stream());
            let output = new_output(desk, base, Some(device.name), params.clone());
            (connectors::to_action().with(()), output, device.next_step.asks)
        }
        Step::Converted(..) => return None,
    };
    Some((ConnectPlan { operation, inputs: vec![input.clone()], output, spot }, asks))
}

/// The value of a stream in another unit.
fn conversion(desk: &Desk, input: &Id, (from, to): (Unit, Unit), spot: NewSpot) -> Option<ConnectPlan> {
    let name = desk.document.stream(input)?.record.with_untracked(|stream| stream.name.clone());
    let argument = behaviour::argument_names([name.as_str()]).pop()?;
    let operation = connectors::to_new_value().with(Procedure::body(&from.convert(to, &argument)?));
    let output = new_output(desk, &to.of(&name), None, Params::new());
    Some(ConnectPlan { operation, inputs: vec![input.clone()], output, spot })
}

fn by_helper(name: &str) -> Operation {
    connectors::to_new_value().with(Procedure::Helper(name.to_owned()))
}

/// Leads a stream to a new action.
pub(crate) fn lead_to_action(desk: &Desk, input: Id, device: &'static robot::Device) {
    let name = desk.document.name_for(words::device(device));
    let output = Output::New { name, device: Some(device.name.to_owned()), params: Params::new() };
    let plan = ConnectPlan {
        operation: connectors::to_action().with(()),
        inputs: vec![input],
        output,
        spot: NewSpot::default(),
    };
    desk.document.connect(plan, |_| {});
}

/// Makes a new value of a stream by a helper.
pub(crate) fn lead_to_helper(desk: &Desk, input: &Id, name: &str, spot: NewSpot) {
    take(desk, input, &Step::Helper(name.to_owned()), spot);
}

/// True if a helper can make something of one stream alone.
pub(crate) fn takes_one(helper: &Helper) -> bool {
    helper.params.len() == 1
}

/// True if a connector runs as it is, with what it begins with: chosen at a place of the graph, it is there at once, and
/// its duration can be changed on it.
fn is_chosen_at_once(spec: &Spec, spot: &NewSpot) -> bool {
    let asks = spec.takes.procedure.is_some_and(|takes| !takes.is_optional);
    *spot != NewSpot::Below && !asks && !spec.acts() && spec.inputs.least() == 1
}

/// Names the stream that a connector makes of this one.
fn name_of(desk: &Desk, input: &Id, spec: &Spec) -> String {
    let name = desk.document.stream(input).map(|signals| signals.record.with_untracked(|stream| stream.name.clone()));
    let inputs: Vec<String> = name.into_iter().collect();
    called(
        spec,
        &NameParts { inputs: &inputs, period_ms: spec.takes.period.map(|_| PERIOD_MS), ..NameParts::default() },
    )
}

fn new_output(desk: &Desk, base: &str, device: Option<&str>, params: Params) -> Output {
    Output::New { name: desk.document.name_for(base), device: device.map(str::to_owned), params }
}

/// Handles the answer: a refusal is said, and what was made may ask for its settings.
fn answered(desk: &Desk, then_edit: bool) -> impl FnOnce(Result<(), Refused>) + 'static {
    let after = desk.clone();
    move |answer| {
        let made = if answer.is_ok() && then_edit { after.document.selected.get_untracked() } else { None };
        if let Some(Selected::Stream(made)) = made {
            after.dialog.set(Some(Dialog::EditStream(made)));
        }
        after.say_refusal(answer);
    }
}
