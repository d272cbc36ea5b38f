//! The differences of the versions that are compared, on the graph: a sign on what is new or another, and a shadow of
//! what is not there.

use super::curve::{chip_place, curves};
use crate::desk::{ComparedVersions, Desk, use_desk};
use crate::graph::words;
use crate::icons::Icon;
use crate::layout::{GAP, chip_width, chip_words, stream_width, what_it_was};
use crate::parts::kind_class;
use behaviour::{Behaviour, Connector, Difference, Id, Kind, Place, Record, RecordId, Stream, StreamKind};
use leptos::prelude::*;
use std::collections::BTreeMap;

/// The difference of something, as it is shown.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Differing {
    difference: Difference,
    /// The words beside the sign.
    pub(super) text: String,
}

/// Returns the difference of a record, while versions are compared. Reactive.
pub(super) fn differs_memo(desk: &Desk, id: &RecordId) -> ArcMemo<Option<Differing>> {
    let (desk, id) = (desk.clone(), id.clone());
    ArcMemo::new(move |_| desk.document.compared.with(|compared| difference(&desk, compared.as_deref()?, &id)))
}

fn difference(desk: &Desk, compared: &ComparedVersions, id: &RecordId) -> Option<Differing> {
    let difference = compared.difference.of(id)?;
    let text = match difference {
        Difference::New => words::is_new().to_owned(),
        Difference::Changed => words::was_words(&what_it_was(&compared.was, &compared.is, id)),
        Difference::Removed => words::removed_tag(desk.document.who_removed(compared.since, id).as_deref()),
    };
    Some(Differing { difference, text })
}

/// The sign on something.
#[component]
pub(super) fn Differs(differs: ArcMemo<Option<Differing>>) -> impl IntoView {
    move || {
        differs.get().map(|Differing { difference, text }| {
            let (kind, sign) = match difference {
                Difference::New => ("new", "+"),
                Difference::Changed => ("changed", "≠"),
                Difference::Removed => ("removed", "−"),
            };
            let title = text.clone();
            view! {
                <span class=format!("differs on-graph {kind}") title=title aria-hidden="true">
                    <i>{sign}</i><span class="cut">{text}</span>
                </span>
            }
        })
    }
}

/// Something that one of the versions has and the graph has not.
#[derive(Clone, Debug, PartialEq)]
enum Shadow {
    Stream { id: Id, stream: Stream, place: Place, differs: Option<Differing> },
    Connector { id: Id, connector: Connector, path: String, chip: Place, differs: Option<Differing> },
}

fn missing(desk: &Desk, compared: &ComparedVersions) -> Vec<Shadow> {
    let mut found = Vec::new();
    for (one, other) in [(&compared.was, None), (&compared.is, Some(&compared.was))] {
        let places = NowPlaces { desk, free: desk.document.missing_places(one), behaviour: one };
        for (id, record) in &one.records {
            let known = other.is_some_and(|other| other.records.contains_key(id));
            if !known && !is_there(desk, id) {
                found.extend(places.shadow(id, record, difference(desk, compared, id)));
            }
        }
    }
    found
}

fn is_there(desk: &Desk, id: &RecordId) -> bool {
    match id.kind {
        Kind::Stream => desk.document.stream(&id.id).is_some(),
        Kind::Connector => desk.document.connector(&id.id).is_some(),
        Kind::Settings | Kind::Helper | Kind::Place | Kind::Note | Kind::Group | Kind::Pad => true,
    }
}

/// The places where things stand now, else where they stood.
struct NowPlaces<'a> {
    desk: &'a Desk,
    behaviour: &'a Behaviour,
    free: BTreeMap<Id, Place>,
}

impl NowPlaces<'_> {
    fn of(&self, id: &Id) -> Option<Place> {
        let now = self.desk.document.stream(id).map(|signals| signals.place.get());
        now.or_else(|| self.behaviour.place(id)).or_else(|| self.free.get(id).copied())
    }

    /// Beside the chips that lead to the same action now.
    fn aside(&self, connector: &Connector, inputs: &[Place], output: Place) -> Option<f64> {
        let now = self.desk.document.connector_ids.get().into_iter().filter_map(|id| self.desk.document.connector(&id));
        let same = now.map(|signals| signals.record.get()).filter(|other| other.output == connector.output);
        let half = same.map(|other| chip_width(&chip_words(&other))).reduce(|all, next| all + GAP + next)? / 2.0;
        let from = inputs.iter().map(|place| place.x - output.x).sum::<f64>();
        Some((half + GAP + chip_width(&chip_words(connector)) / 2.0) * if from < 0.0 { -1.0 } else { 1.0 })
    }

    fn shadow(&self, id: &RecordId, record: &Record, differs: Option<Differing>) -> Option<Shadow> {
        let id = id.id.clone();
        match record {
            Record::Stream(stream) => {
                let place = self.of(&id)?;
                Some(Shadow::Stream { id, stream: stream.clone(), place, differs })
            }
            Record::Connector(connector) => {
                let inputs: Vec<Place> = connector.inputs.iter().filter_map(|input| self.of(input)).collect();
                let output = self.of(&connector.output)?;
                let kind = self.behaviour.stream(&connector.output).map_or(StreamKind::Ordinary, |stream| stream.kind);
                let chip = chip_place(&inputs, output, kind, self.aside(connector, &inputs, output));
                let path = curves(&inputs, chip, output);
                Some(Shadow::Connector { id, connector: connector.clone(), path, chip, differs })
            }
            Record::Settings(_)
            | Record::Helper(_)
            | Record::Place(_)
            | Record::Note(_)
            | Record::Group(_)
            | Record::Pad(_) => None,
        }
    }
}

/// Everything that one of the compared versions has and the graph has not.
pub(crate) fn shadows() -> AnyView {
    view! { <Shadows /> }.into_any()
}

#[component]
fn Shadows() -> impl IntoView {
    let desk = use_desk();
    let all = ArcMemo::new(move |_| {
        let compared = desk.document.compared.get();
        compared.map_or_else(Vec::new, |compared| missing(&desk, &compared))
    });
    move || {
        let all = all.get();
        let paths = all.iter().filter_map(|shadow| match shadow {
            Shadow::Connector { path, .. } => Some(path.clone()),
            Shadow::Stream { .. } => None,
        });
        let paths = paths.map(|path| view! { <path class="edge shadow" d=path /> }).collect_view();
        let shapes = all.iter().cloned().map(shape).collect_view();
        view! {
            <svg class="edges" width="1" height="1" aria-hidden="true" focusable="false">{paths}</svg>
            {shapes}
        }
    }
}

fn shape(shadow: Shadow) -> AnyView {
    match shadow {
        Shadow::Stream { id, stream, place, differs } => {
            let device = stream.device.as_deref().and_then(|name| robot::device(stream.kind, name).ok());
            let label = words::with_mark(stream.name.clone(), differs.as_ref().map(|differs| differs.text.as_str()));
            let class = format!("stream shadow {}", kind_class(stream.kind));
            let width = format!("{:.0}px", stream_width(&stream));
            view! {
                <div class=format!("at {}", kind_class(stream.kind)) style:transform=placed(place)>
                    <div class=class role="img" aria-label=label data-shadow=id.to_string()
                        style:min-width=width>
                        {device.map(|device| view! { <span class="icon"><Icon name=device.icon /></span> })}
                        <span class="texts"><span class="name">{stream.name}</span></span>
                    </div>
                    <Differs differs=ArcMemo::new(move |_| differs.clone()) />
                </div>
            }
            .into_any()
        }
        Shadow::Connector { id, connector, chip, differs, .. } => {
            let text = chip_words(&connector);
            let width = format!("{:.0}px", chip_width(&text));
            let label = words::with_mark(text.whole(), differs.as_ref().map(|differs| differs.text.as_str()));
            view! {
                <div class="at of-chip" style:transform=placed(chip)>
                    <div class="chip shadow" role="img" aria-label=label data-shadow=id.to_string()
                        style:min-width=width>
                        <span class="icon"><Icon name=connector.operation.spec().icon.name /></span>
                        <span class="word">{text.word}</span>
                        <span class="detail" class:plain=text.plain>{text.detail}</span>
                    </div>
                    <Differs differs=ArcMemo::new(move |_| differs.clone()) />
                </div>
            }
            .into_any()
        }
    }
}

fn placed(place: Place) -> String {
    format!("translate({:.1}px,{:.1}px) translateX(-50%)", place.x, place.y)
}
