//! What the output stream is called until a person types a name: it follows what is chosen in the dialog.

use super::form::{OperationForm, milliseconds};
use crate::naming::{NameParts, called};
use leptos::prelude::*;

/// The name before it is made unique. Reactive.
pub(super) fn name_base(form: OperationForm) -> String {
    let desk = form.desk.desk();
    let inputs = form.inputs.get();
    let names: Vec<String> =
        inputs.iter().filter_map(|id| Some(desk.document.stream(id)?.record.read().name.trim().to_owned())).collect();
    let period_ms = milliseconds(&form.period.get());
    let by_helper = form.way.get() == "helper";
    let (helper, body) = (form.helper.get(), form.body.get());
    let arguments = form.arguments();
    let skipped = arguments.len().saturating_sub(names.len());
    let helper = by_helper.then_some(helper.as_str());
    let body = (!by_helper).then_some((body.as_str(), &arguments[skipped..]));
    called(form.kind.get(), &NameParts { inputs: &names, helper, body, period_ms })
}
