//! Tells why an action came, or why it did not, in what runs or in a recording.

use super::ConsoleCommand;
use crate::console::Console;
use crate::find::find;
use crate::moment::{Moment, Ran};
use crate::refusal::NotDone;
use crate::{ClientError, NoLink};
use behaviour::StreamKind;
use protocol::{
    LaneName, LaneValue, LaneValues, OpenedPast, PastAnswer, PastOf, PastQuestion, PastStream, Recording, WhySentence,
    answer, request,
};

/// The most milliseconds between a time that is typed and the action.
const NEAR_MS: u64 = 1_000;
/// The milliseconds before a time in which the action did not come.
const NOT_MS: u64 = 2_000;
/// The language of the console.
const LANGUAGE: &str = "en";

pub(crate) const COMMAND: ConsoleCommand = ConsoleCommand {
    name: "why",
    words: "ACTION [at TIME] [in RECORDING]",
    help: "Tells why an action came last or at a time (0:04.2 since Start), or why it did not.",
    run: |console, words| Box::pin(run(console, words)),
};

async fn run(console: &mut Console, words: &str) -> Result<String, NotDone> {
    let WhyWords { action, time, recording } = read(words)?;
    let past = match recording {
        Some(name) => recorded(console, name).await?,
        None => running(console).await?,
    };
    let PastAnswer::Opened(about) = ask(console, &past, PastQuestion::Open).await? else { return Err(other_answer()) };
    let (name, stream) = find("action", action, &actions(&about))?;
    let within = match time {
        Some(time) => Some(within(time, &about)?),
        None => None,
    };
    let found = match within {
        Some(within) => near(console, &past, &stream, within).await?,
        None => last(console, &past, &stream, &about).await?,
    };
    let (head, sentences) = match found {
        Some((at_ms, nth)) => {
            let question = PastQuestion::Why { stream: stream.stream, at_ms, nth, language: LANGUAGE.to_owned() };
            let PastAnswer::Why(told) = ask(console, &past, question).await? else { return Err(other_answer()) };
            (format!("{name} came at {}:", since_start(at_ms)), told.sentences)
        }
        None => {
            let (from_ms, until_ms) = within.unwrap_or((about.from_ms, about.until_ms));
            let from_ms = from_ms.saturating_sub(if within.is_some() { NOT_MS } else { 0 }).max(about.from_ms);
            let language = LANGUAGE.to_owned();
            let question = PastQuestion::WhyNot { stream: stream.stream, from_ms, until_ms, language };
            let PastAnswer::WhyNot(told) = ask(console, &past, question).await? else { return Err(other_answer()) };
            (format!("{name} did not come until {}:", since_start(until_ms)), told.sentences)
        }
    };
    let lines = sentences.into_iter().map(|WhySentence { text, .. }| format!("  {text}"));
    Ok(std::iter::once(head).chain(lines).collect::<Vec<_>>().join("\n"))
}

/// The words that were typed.
#[derive(Debug, PartialEq, Eq)]
struct WhyWords<'w> {
    action: &'w str,
    time: Option<&'w str>,
    recording: Option<&'w str>,
}

/// `Say at 0:04.2 in greet`: the last `in` and the last `at` before a time count, as names may have such words too.
fn read(words: &str) -> Result<WhyWords<'_>, NotDone> {
    let is_time = |word: &str| word.starts_with(|first: char| first.is_ascii_digit());
    let (rest, recording) = match words.rsplit_once(" in ") {
        Some((rest, recording)) => (rest, Some(recording.trim())),
        None => (words, None),
    };
    let (action, time) = match rest.rsplit_once(" at ") {
        Some((action, time)) if is_time(time.trim()) => (action, Some(time.trim())),
        _ => (rest, None),
    };
    let action = action.trim();
    if action.is_empty() { Err(NotDone::NoAction) } else { Ok(WhyWords { action, time, recording }) }
}

async fn recorded(console: &mut Console, name: &str) -> Result<PastOf, NotDone> {
    let answer::Recordings { recordings } = console.ask(request::Recordings {}).await?;
    let named = |Recording { file, title, .. }: Recording| (title.unwrap_or_else(|| file.clone()), file);
    let all: Vec<_> = recordings.into_iter().map(named).collect();
    Ok(PastOf::Recording(find("recording", name, &all)?.1))
}

/// The newest run of the loaded program.
async fn running(console: &mut Console) -> Result<PastOf, NotDone> {
    let (behaviour, robot) = (console.program()?.behaviour, console.robot.clone());
    let answer::Runs { runs, .. } = console.ask(request::Runs {}).await?;
    let is_it =
        runs.iter().filter(|run| run.behaviour == behaviour && robot.as_ref().is_none_or(|robot| run.robot == *robot));
    is_it.map(|run| run.run).max().map(PastOf::Run).ok_or(NotDone::NeverRan)
}

async fn ask(console: &mut Console, past: &PastOf, question: PastQuestion) -> Result<PastAnswer, NotDone> {
    let question = Box::new(question);
    let answer::Past { answer } = console.ask(request::LookBack { past: past.clone(), question }).await?;
    serde_json::from_str(&answer).map_err(|_| other_answer())
}

fn other_answer() -> NotDone {
    ClientError::from(NoLink::OtherAnswer).into()
}

/// The actions by their names.
fn actions(about: &OpenedPast) -> Vec<(String, PastStream)> {
    let is_action = |stream: &&PastStream| stream.kind == StreamKind::Actuator;
    about.streams.iter().filter(is_action).map(|stream| (stream.name.clone(), stream.clone())).collect()
}

/// The first and the last millisecond that a time may be.
fn within(time: &str, about: &OpenedPast) -> Result<(u64, u64), NotDone> {
    let moment: Moment = time.parse().map_err(|_| NotDone::NoTime(time.to_owned()))?;
    moment.within(&Ran::of(&about.began, about.until_ms)).map_err(|_| NotDone::NotThen)
}

/// The value nearest to a time, with its number of that millisecond.
async fn near(
    console: &mut Console,
    past: &PastOf,
    stream: &PastStream,
    (from_ms, until_ms): (u64, u64),
) -> Result<Option<(u64, usize)>, NotDone> {
    let lanes = vec![LaneName { stream: stream.stream.clone(), field: None }];
    let (first_ms, to_ms) = (from_ms.saturating_sub(NEAR_MS), until_ms + NEAR_MS + 1);
    let question = PastQuestion::Lanes { lanes, from_ms: first_ms, to_ms, columns: 1 };
    let PastAnswer::Lanes(lanes) = ask(console, past, question).await? else { return Err(other_answer()) };
    let values = match lanes.into_iter().next().map(|lane| lane.values) {
        Some(LaneValues::Each(values)) => values,
        // So many values that one came then.
        _ => return Ok(Some((from_ms, 0))),
    };
    let distance = |value: &LaneValue| from_ms.saturating_sub(value.t) + value.t.saturating_sub(until_ms);
    Ok(values.iter().min_by_key(|value| distance(value)).map(|value| (value.t, value.nth)))
}

/// The last value, if any came. Of several in its millisecond it is the first.
async fn last(
    console: &mut Console,
    past: &PastOf,
    stream: &PastStream,
    about: &OpenedPast,
) -> Result<Option<(u64, usize)>, NotDone> {
    let question = PastQuestion::Seek { at_ms: about.until_ms };
    let PastAnswer::Moment(moment) = ask(console, past, question).await? else { return Err(other_answer()) };
    let sample = moment.values.streams.iter().find(|sample| sample.stream.as_str() == stream.stream);
    Ok(sample.map(|sample| (sample.at_ms, 0)))
}

/// A time since Start: `0:04.2`.
fn since_start(ms: u64) -> String {
    format!("{}:{:02}.{}", ms / 60_000, ms / 1_000 % 60, ms % 1_000 / 100)
}

#[cfg(test)]
mod tests {
    use super::{WhyWords, read};

    #[test]
    fn words_like_those_of_the_command_may_be_part_of_a_name() {
        let words = |action, time, recording| WhyWords { action, time, recording };
        for (typed, wanted) in [
            ("Say", words("Say", None, None)),
            ("Say at 0:04.2", words("Say", Some("0:04.2"), None)),
            ("Say in greet", words("Say", None, Some("greet"))),
            (
                "Look at ball at 12:04:17 in greet at noon",
                words("Look at ball", Some("12:04:17"), Some("greet at noon")),
            ),
            ("Look at ball", words("Look at ball", None, None)),
        ] {
            assert_eq!(read(typed).unwrap(), wanted);
        }
        assert_eq!(read("").unwrap_err().to_string().split('.').next(), Some("Type “why ACTION”, “why ACTION at 0:04"));
    }
}
