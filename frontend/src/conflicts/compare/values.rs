//! What both procedures would do with the last real values, each tried once by the server.

use crate::conflicts::words;
use crate::desk::Conflict;
use crate::forms::trials::{self, Trial, TrialMark, TrialQuestion, question_of};
use crate::parts::DeskHold;
use behaviour::{Behaviour, Record};
use leptos::prelude::*;

/// What came of one value.
type TriedValue = [Trial; 2];

/// Both procedures, if both can be tried on the same values.
pub(super) fn questions(desk: DeskHold, conflict: &Conflict, now: &Behaviour) -> Option<[TrialQuestion; 2]> {
    let (_, mine) = conflict.mine_of(&conflict.about)?;
    let (Some(Record::Connector(mine)), Some(Record::Connector(theirs))) = (mine, now.records.get(&conflict.about))
    else {
        return None;
    };
    let both = [question_of(desk, mine)?, question_of(desk, theirs)?];
    (both[0].inputs == both[1].inputs && both[0].is_test == both[1].is_test).then_some(both)
}

/// The rows of the table, one a value; nothing where no real values came yet.
#[component]
pub(super) fn Values(questions: Memo<Option<[TrialQuestion; 2]>>) -> impl IntoView {
    let desk = crate::parts::hold();
    let tried: RwSignal<Vec<TriedValue>> = RwSignal::new(Vec::new());
    let number = StoredValue::new(0_u32);
    Effect::new(move |_| {
        tried.set(Vec::new());
        number.update_value(|number| *number += 1);
        let mine = number.get_value();
        if let Some([one, other]) = questions.get() {
            let sets = untrack(|| trials::real_sets(desk, &one.inputs));
            trials::try_on(desk, one, sets.clone(), move |first| {
                trials::try_on(desk, other, sets, move |second| {
                    if number.try_get_value() == Some(mine) {
                        let _ = tried.try_set(first.into_iter().zip(second).map(|(one, other)| [one, other]).collect());
                    }
                });
            });
        }
    });
    let is_test = move || questions.read().as_ref().is_some_and(|both| both[0].is_test);
    view! {
        {move || {
            let all = tried.get();
            (!all.is_empty()).then(|| view! { <Sum is_test=is_test() all=all.clone() /> {all.into_iter().map(row).collect_view()} })
        }}
    }
}

#[component]
fn Sum(is_test: bool, all: Vec<TriedValue>) -> impl IntoView {
    let count = |at: usize| all.iter().filter(|tried| tried[at].mark == TrialMark::Passes).count();
    let cell = |at: usize| is_test.then(|| words::how_many_pass(count(at), all.len()));
    view! {
        <tr class="sum">
            <th scope="row">{words::the_last(all.len())}</th>
            <td data-side="mine">{cell(0)}</td>
            <td data-side="theirs">{cell(1)}</td>
        </tr>
    }
}

fn row([mine, theirs]: TriedValue) -> impl IntoView {
    let differs = (mine.mark, &mine.result) != (theirs.mark, &theirs.result);
    view! {
        <tr class:unlike=differs>
            <th scope="row" class="cut" title=mine.given()>{mine.given()}</th>
            {cell(mine, "mine")}
            {cell(theirs, "theirs")}
        </tr>
    }
}

fn cell(trial: Trial, side: &'static str) -> impl IntoView {
    let (class, text) = match trial.mark {
        TrialMark::Passes => ("good", format!("✓ {}", words::passes_short())),
        TrialMark::Left => ("", format!("– {}", words::left_out())),
        TrialMark::Plain => ("", trial.result),
        TrialMark::Fails => ("bad-text", trial.result),
    };
    view! { <td data-side=side class=format!("cut {class}") title=text.clone()>{text.clone()}</td> }
}
