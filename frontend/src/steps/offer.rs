//! Likely next steps as buttons: picture, label, and what they do in a sentence.

use super::known::StreamKnowledge;
use super::suggest::{Step, suggest};
use super::take::takes_one;
use crate::desk::Desk;
use crate::words;
use behaviour::connectors;
use behaviour::{Helper, Id, Params};
use leptos::prelude::*;
use protocol::Role;

/// One button for a next step.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Offer {
    pub(crate) step: Step,
    pub(crate) icon: &'static str,
    pub(crate) label: String,
}

impl Offer {
    fn of(step: Step, helpers: &[Helper]) -> Self {
        let (icon, label) = match &step {
            Step::Helper(name) => ("fx", called(name, helpers)),
            Step::Connector(spec) => (spec.icon.name, words::connector_word(spec).to_owned()),
            Step::Otherwise(spec, ..) => (spec.icon.name, words::otherwise().to_owned()),
            Step::Action(device, _) => (device.icon, words::label_of(&device.offered_as()).to_owned()),
            Step::Converted(_, _, Some(then)) => {
                let then = Self::of((**then).clone(), helpers);
                (then.icon, then.label)
            }
            Step::Converted(_, to, None) => ("fx", words::convert_to(&words::shown(to))),
        };
        Self { step, icon, label }
    }

    /// Returns the sentence that says what the step does.
    pub(crate) fn says(&self) -> String {
        match &self.step {
            Step::Helper(name) => format!("{} ({name})", words::connector_word(connectors::to_new_value())),
            Step::Connector(spec) => words::connector_says(spec).to_owned(),
            Step::Otherwise(spec, body, _) => format!("{} ({body})", words::connector_word(spec)),
            Step::Action(device, _) => words::device_says(device).to_owned(),
            Step::Converted(from, to, _) => words::converts_first(&words::shown(from), &words::shown(to)),
        }
    }

    /// Returns a few words on the result, which stand beside the label.
    pub(crate) fn brief(&self) -> String {
        match &self.step {
            Step::Helper(_) => words::connector_word(connectors::to_new_value()).to_owned(),
            Step::Connector(spec) => words::label_of(&spec.in_brief()).to_owned(),
            Step::Otherwise(_, body, _) => body.clone(),
            Step::Action(..) => words::an_action().to_owned(),
            Step::Converted(_, to, Some(_)) => words::converts_to(&words::shown(to)),
            Step::Converted(_, _, None) => words::connector_word(connectors::to_new_value()).to_owned(),
        }
    }

    /// True if it can stand between a stream and what takes from it.
    fn fits_into_a_gap(&self) -> bool {
        match &self.step {
            Step::Helper(_) | Step::Converted(_, _, None) => true,
            Step::Converted(_, _, Some(then)) => matches!(**then, Step::Helper(_)),
            Step::Connector(spec) => !spec.acts() && spec.inputs.least() == 1,
            Step::Otherwise(..) | Step::Action(..) => false,
        }
    }
}

/// Returns the words for a helper, by its name.
fn called(name: &str, helpers: &[Helper]) -> String {
    helpers.iter().find(|helper| helper.name == name).map_or_else(|| name.to_owned(), words::helper_name_of)
}

/// The likeliest next steps of a stream, best first. Reactive.
pub(crate) fn offers_memo(desk: &Desk, id: &Id, at_most: usize) -> ArcMemo<Vec<Offer>> {
    let (desk, id) = (desk.clone(), id.clone());
    ArcMemo::new(move |_| {
        desk.document.revision.track();
        desk.document.types.track();
        if !desk.may(Role::Editor) {
            return Vec::new();
        }
        likely(&desk, &id).into_iter().take(at_most).collect()
    })
}

/// Everything that can come after a stream, best first; with `in_gap` what can stand between it and what takes from it.
pub(crate) fn after(desk: &Desk, id: &Id, in_gap: bool) -> Vec<Offer> {
    let mut offers = likely(desk, id);
    for spec in connectors::ALL.iter().copied() {
        if !offers.iter().any(|offer| matches!(&offer.step, Step::Connector(known) if *known == spec)) {
            offers.push(Offer::of(Step::Connector(spec), &[]));
        }
    }
    offers.retain(|offer| !in_gap || offer.fits_into_a_gap());
    offers
}

/// Returns the offers with all helpers and actions, for who looks for something by its name.
pub(crate) fn everything(desk: &Desk, id: &Id, in_gap: bool) -> Vec<Offer> {
    let mut offers = after(desk, id, in_gap);
    let all = helpers(desk);
    let fitting = all.iter().filter(|helper| takes_one(helper));
    let helpers = fitting.map(|helper| Offer::of(Step::Helper(helper.name.clone()), &all));
    let actions = actions(desk, id).into_iter().filter(|_| !in_gap);
    for offer in helpers.chain(actions) {
        if !offers.iter().any(|known| known.step == offer.step || known.label == offer.label) {
            offers.push(offer);
        }
    }
    offers
}

/// Every action that a stream can lead to, the likeliest first.
pub(crate) fn actions(desk: &Desk, id: &Id) -> Vec<Offer> {
    let mut offers = likely(desk, id);
    offers.retain(|offer| matches!(offer.step, Step::Action(..)));
    for device in robot::actuators() {
        if !offers.iter().any(|offer| matches!(offer.step, Step::Action(known, _) if known.name == device.name)) {
            offers.push(Offer::of(Step::Action(device, Params::new()), &[]));
        }
    }
    offers
}

fn helpers(desk: &Desk) -> Vec<Helper> {
    desk.library.helpers.with_untracked(|all| all.iter().map(|(_, helper)| helper.clone()).collect())
}

fn likely(desk: &Desk, id: &Id) -> Vec<Offer> {
    let helpers = helpers(desk);
    let value = desk.document.stream(id).and_then(|signals| signals.live.with_untracked(|live| live.value.clone()));
    let kind = desk.document.types.with_untracked(|types| types.get(id).cloned());
    let known = StreamKnowledge { kind: kind.as_ref(), value: value.as_ref() };
    let steps = suggest(&desk.document.behaviour(), id, &helpers, &known);
    steps.into_iter().map(|step| Offer::of(step, &helpers)).collect()
}
