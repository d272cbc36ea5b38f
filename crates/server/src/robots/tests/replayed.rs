//! Tests that a recording gives its own actions again: courses of a run in virtual time, each by its seed, and every
//! recording of it checked alone.

use super::{PATIENCE_S, filtered, id};
use crate::library::templates::templates;
use crate::recordings::{About, Recordings};
use crate::robots::ByHand;
use crate::robots::StartOrder;
use crate::robots::mailbox::{Arrived, Beginning, DoneByHand, Post, RunMailbox, Undone};
use crate::robots::order::RobotOrder;
use crate::robots::refusal::RunFailure;
use crate::robots::runner::{self, RunJob, Runner};
use crate::robots::shared::RobotShared;
use crate::robots::status_feed::StatusFeed;
use crate::robots::successor::{self, RunHandover, Successor};
use behaviour::{BehaviourFile, Engine, Id, StreamKind, Value};
use engine::{Limits, Matching, Run, StreamIx};
use protocol::{MarkSort, RecordedSession, RecordingMark, RobotState};
use recording::{CheckedRecording, Different, Ending};
use std::cell::Cell;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, sync_channel};
use std::time::{Duration, Instant};

/// Courses that are tried.
const COURSES: u64 = 100;
/// Turns of a course.
const TURNS: u64 = 80;

thread_local! {
    static NOW: Cell<Option<Instant>> = const { Cell::new(None) };
}

/// The time of the test that runs on this thread.
pub(super) fn now() -> Instant {
    let now = NOW.get().unwrap_or_else(Instant::now);
    NOW.set(Some(now));
    now
}

pub(super) fn advance(ms: u64) {
    NOW.set(Some(now() + Duration::from_millis(ms)));
}

/// Chance by a seed.
struct Dice(u64);

impl Dice {
    fn below(&mut self, below: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % below.max(1)
    }

    fn one_in(&mut self, many: u64) -> bool {
        self.below(many) == 0
    }

    /// A value like an example, with other numbers.
    fn like(&mut self, example: &Value) -> Value {
        match example {
            Value::Int(_) => Value::Int(self.below(9) as i64),
            Value::Float(_) => Value::Float(self.below(200) as f64 / 64.0 - 1.0),
            Value::List(items) => Value::list(items.iter().map(|item| self.like(item))),
            Value::Map(fields) => {
                let fields: Vec<_> = fields.iter().map(|(name, value)| (name.to_string(), self.like(value))).collect();
                Value::object(fields.iter().map(|(name, value)| (name.as_str(), value.clone())))
            }
            other => other.clone(),
        }
    }
}

/// One robot, what runs on it and where it is recorded.
pub(super) struct Course {
    dice: Dice,
    pub(super) shared: Arc<RobotShared>,
    recordings: Recordings,
    pub(super) file: Arc<BehaviourFile>,
    pub(super) session: RecordedSession,
    revision: u64,
    pub(super) runner: Option<(Runner<'static>, &'static RunJob, Arc<RunMailbox>)>,
    follows: Option<(&'static RunJob, Receiver<RunHandover>)>,
}

impl Course {
    pub(super) fn of(seed: u64, recordings: Recordings) -> Self {
        let feed = Arc::new(StatusFeed::default());
        feed.add(RobotState::connecting(id("nao"), "NAO".to_owned()));
        let shared = Arc::new(RobotShared::new(id("nao"), feed, RobotOrder::default()));
        let mut all: Vec<BehaviourFile> = templates().iter().map(crate::library::templates::Template::file).collect();
        all.push((*filtered("fails", "100 / ball > 30").file).clone());
        let file = all.swap_remove(seed as usize % all.len()).into();
        let (dice, session) = (Dice(seed + 1), RecordedSession::default());
        Self { dice, shared, recordings, file, session, revision: 1, runner: None, follows: None }
    }

    fn job(&self, run: u64, cancel: &Arc<crate::robots::cancel_flag::CancelFlag>, record: bool) -> &'static RunJob {
        let start = StartOrder {
            behaviour: id("b"),
            revision: self.revision,
            file: self.file.clone(),
            record,
            session: self.session.clone(),
            by: "Aiko".to_owned(),
            invitation: None,
        };
        let (cancel, shared, recordings) = (cancel.clone(), self.shared.clone(), self.recordings.clone());
        Box::leak(Box::new(RunJob { run, start, cancel, shared, recordings, limits: Limits::default, clock: now }))
    }

    /// Starts, or goes on where the robot interrupted it.
    pub(super) fn start(&mut self, record: bool) {
        let (run, cancel) = (self.shared.feed.next_run(), self.shared.cancel_flags.add(&id("b")));
        assert!(self.shared.table.lock().unwrap().announce(run, &id("b"), &cancel));
        let job = self.job(run, &cancel, record);
        let clock = Rc::new(Cell::new(now()));
        let built = runner::build(job, &clock).map_err(|why| why.to_string()).unwrap();
        let (mailbox, devices) = (Arc::new(RunMailbox::default()), runner::devices(&built, &job.start.file));
        let begun = runner::begin(job, built, mailbox.clone(), &devices, clock);
        let (runner, _) = begun.map_err(|why| why.to_string()).unwrap();
        self.runner = Some((runner, job, mailbox));
    }

    fn readings(&mut self) -> Vec<Arrived> {
        let is_sense = |stream: &behaviour::FileStream| stream.kind == StreamKind::Sensor;
        let streams = self.file.streams.iter().enumerate().filter(|(_, stream)| is_sense(stream));
        let all: Vec<(usize, Value)> = streams
            .map(|(at, stream)| {
                let device = robot::device(StreamKind::Sensor, stream.device.as_deref().unwrap());
                (at, serde_json::from_str(device.unwrap().example).unwrap())
            })
            .collect();
        let mut readings = Vec::new();
        for _ in 0..self.dice.below(4) {
            let (at, example) = all[self.dice.below(all.len() as u64) as usize].clone();
            let value = if self.file.name == "fails" {
                Value::Int(self.dice.below(5) as i64)
            } else {
                self.dice.like(&example)
            };
            let by: Option<Arc<str>> = self.dice.one_in(4).then(|| "Ben".into());
            readings.push(Arrived { stream: StreamIx::of(at), at: now(), value, by });
        }
        readings
    }

    /// Returns the post of one turn.
    fn post(&mut self) -> Post {
        let mut post = Post { readings: self.readings(), ..Post::default() };
        if self.dice.one_in(20) {
            let (id, t) =
                (Id::from_uuid(uuid::Uuid::from_u128(u128::from(self.dice.below(u64::MAX)))), self.dice.below(500));
            let [word, at] = [const { String::new() }; 2];
            let (sort, note, by) = (MarkSort::Note, "he laughs".to_owned(), "Ben".to_owned());
            post.marks.push(RecordingMark { id, t, until: None, word, sort, note, by, at, open: false, gone: false });
        }
        if self.dice.one_in(15) {
            let (device, params, by) = ("Print".to_owned(), behaviour::Params::default(), "Ben".to_owned());
            let hand = ByHand { device, params, value: Value::Int(1), by };
            post.hands.push(DoneByHand::of(hand, None));
        }
        if self.dice.one_in(10) {
            let undone = Undone { stream: id("s"), why: "the head is held".to_owned(), with: Some("Greet".to_owned()) };
            post.undone.insert(undone, (now(), 1 + self.dice.below(3)));
        }
        post
    }

    /// Another version of what runs, if this one can be edited so.
    fn edit(&mut self) {
        let mut file = (*self.file).clone();
        if self.dice.one_in(5) {
            let frame = Engine::Frame { frame_ms: 40 };
            file.engine = Some(if file.engine == Some(frame) { Engine::Event } else { frame });
        }
        let many = file.connectors.len() as u64;
        let connector = &mut file.connectors[self.dice.below(many) as usize];
        connector.period_ms.iter_mut().for_each(|ms| *ms += 10);
        connector.body.iter_mut().for_each(|body| *body = with_another_number(body));
        file.helpers.iter_mut().for_each(|helper| helper.body = with_another_number(&helper.body));
        if Run::build(&file, Limits::default()).is_ok() {
            (self.file, self.revision) = (file.into(), self.revision + 1);
        }
    }

    fn turn(&mut self) {
        advance(self.dice.below(90));
        let mut post = self.post();
        let (runner, job, _) = self.runner.as_ref().unwrap();
        let (job, is_recorded) = (*job, runner.is_recorded());
        if self.follows.is_none() && self.dice.one_in(25) {
            let before = self.file.clone();
            self.edit();
            let (hand, handed) = sync_channel(1);
            post.successor = Some(Successor(hand));
            self.follows = Some((self.job(job.run, &job.cancel, false), handed));
            // The readings of this turn are for what runs.
            assert_eq!(before.streams.len(), self.file.streams.len());
        }
        if !is_recorded && self.dice.one_in(6) {
            post.begin_recording = Some(self.beginning(job));
        }
        let (mut runner, job, mailbox) = self.runner.take().unwrap();
        assert!(runner.turn(post).is_none());
        if let Some(successor) = runner.follower() {
            runner.hand_over(successor);
            let (next, handed) = self.follows.take().unwrap();
            self.followed((job, next), handed.recv().unwrap(), mailbox);
        } else {
            self.runner = Some((runner, job, mailbox));
        }
    }

    fn followed(
        &mut self,
        (job, next): (&'static RunJob, &'static RunJob),
        handed: RunHandover,
        mailbox: Arc<RunMailbox>,
    ) {
        let clock = Rc::new(Cell::new(now()));
        let run = runner::build(next, &clock).map_err(|why| why.to_string()).unwrap();
        let matching = Matching::between(&job.start.file, &next.start.file);
        self.shared.applied(next.run, &next.start);
        let runner = successor::go_on(next, run, handed, &matching, mailbox.clone(), clock);
        self.runner = Some((runner, next, mailbox));
    }

    fn beginning(&self, job: &RunJob) -> Beginning {
        let StartOrder { behaviour, revision, file, by, session, .. } = &job.start;
        let about = About { run: job.run, robot: "NAO", behaviour, revision: *revision, by, file, session };
        Beginning {
            recorder: self.recordings.begin(&about).map_err(|why| why.to_string()).unwrap(),
            file: file.clone(),
        }
    }

    /// The robot falls, and somebody presses Continue.
    fn interrupt(&mut self) {
        self.shared.pause_all(&RunFailure::Halt("it fell".into()));
        self.end();
        if self.dice.one_in(2) {
            self.edit();
        }
        advance(self.dice.below(5_000));
        let record = !self.dice.one_in(4);
        self.start(record);
    }

    pub(super) fn end(&mut self) {
        let (runner, ..) = self.runner.take().unwrap();
        self.follows = None;
        runner.finish(None);
    }

    fn run(&mut self) {
        let record = !self.dice.one_in(3);
        self.start(record);
        for _ in 0..TURNS {
            self.turn();
            if self.follows.is_none() && self.dice.one_in(40) {
                self.interrupt();
            }
        }
        self.shared.stop_now(None, "Ben");
        self.end();
    }
}

/// The same with its first number that stands alone one larger.
fn with_another_number(body: &str) -> String {
    let bytes = body.as_bytes();
    let part_of_word = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'.' || byte == b'_' || byte == b'"';
    let found = (0..bytes.len()).find(|&at| {
        let before = at.checked_sub(1).is_some_and(|before| part_of_word(bytes[before]));
        let after = bytes.get(at + 1).is_some_and(|&after| part_of_word(after));
        bytes[at].is_ascii_digit() && bytes[at] != b'9' && !before && !after
    });
    let mut bytes = bytes.to_vec();
    found.into_iter().for_each(|at| bytes[at] += 1);
    String::from_utf8(bytes).unwrap()
}

/// The texts of all recordings, once they are written.
pub(super) fn texts(recordings: &Recordings) -> Vec<String> {
    let began = Instant::now();
    while recordings.is_writing() {
        assert!(began.elapsed().as_secs() < PATIENCE_S, "they are never written");
        std::thread::yield_now();
    }
    let list = recordings.list();
    list.iter().map(|one| std::fs::read_to_string(recordings.find(&one.file).unwrap()).unwrap()).collect()
}

fn checked(seed: u64, text: &str) -> CheckedRecording {
    recording::check(text).unwrap_or_else(|why| panic!("seed {seed}: {why}\n{text}"))
}

/// A cut at any byte leaves the beginning of a recording, which says where it ends.
fn cut_anywhere(dice: &mut Dice, text: &str) {
    let whole = text.lines().take(2).map(|line| line.len() + 1).sum::<usize>();
    let at = whole + dice.below((text.len() - whole) as u64) as usize;
    let at = (at..).find(|at| text.is_char_boundary(*at)).unwrap();
    let cut = recording::check(&text[..at]).unwrap_or_else(|why| panic!("cut at {at}: {why}\n{}", &text[..at]));
    assert!(cut.ends == Ending::CutOff || at + 1 >= text.len(), "{:?}", cut.ends);
    assert!(cut.to_string().contains("cut off") || at + 1 >= text.len());
    let early = dice.below(whole as u64 - 1) as usize;
    let early = (early..).find(|at| text.is_char_boundary(*at)).unwrap();
    let why = recording::check(&text[..early]).unwrap_err();
    assert!(matches!(why, Different::NoRecording | Different::Lacks(recording::Lack::Everything)), "{why}");
}

/// A text without the lines of a mark, and without the files that follow one.
fn without(text: &str, mark: &str) -> String {
    let files = if mark == "applied" { "\"mark\":\"file\"" } else { "\n" };
    let is_left = |(number, line): &(usize, &str)| {
        !line.contains(&format!("\"mark\":\"{mark}\"")) && (*number < 2 || !line.contains(files))
    };
    text.lines().enumerate().filter(is_left).map(|(_, line)| format!("{line}\n")).collect()
}

#[test]
fn every_recording_alone_gives_its_own_actions_again() {
    let (mut actions, mut kinds, mut needed) = (0, [0; 7], [0; 2]);
    for seed in 0..COURSES {
        let folder = tempfile::tempdir().unwrap();
        let recordings = Recordings::within(Some(folder.path()));
        Course::of(seed, recordings.clone()).run();
        let mut dice = Dice(seed);
        for text in texts(&recordings) {
            let is = checked(seed, &text);
            assert!(matches!(is.ends, Ending::Whole(_)), "{:?}", is.ends);
            actions += is.actions;
            let words =
                ["\"applied\"", "\"memory\"", "\"by\":\"Ben\"}", "\"refused\"", "\"error\"", "it fell", "\"hand\""];
            kinds.iter_mut().zip(words).for_each(|(count, word)| *count += usize::from(text.contains(word)));
            needed.iter_mut().zip(["memory", "applied"]).for_each(|(count, mark)| {
                *count += usize::from(recording::check(&without(&text, mark)) != Ok(is.clone()));
            });
            cut_anywhere(&mut dice, &text);
            let unknown =
                text.replacen("\n{\"t\":", "\n{\"t\":1,\"smells\":\"of\"}\n{\"mark\":\"news\",\"file\":7}\n{\"t\":", 3);
            assert_eq!(recording::check(&unknown), Ok(is), "what is not known is left out");
        }
    }
    assert!(actions > 2_000, "{actions} actions were compared");
    assert!(needed.iter().all(|many| *many >= 5), "what was remembered and applied counts: {needed:?}");
    assert!(kinds.iter().all(|many| *many >= 10), "each kind comes often: {kinds:?}");
}

#[test]
fn the_first_difference_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = Recordings::within(Some(folder.path()));
    let mut course = Course::of(templates().len() as u64, recordings.clone());
    course.start(true);
    for value in [2, 0, 3, 50] {
        advance(100);
        let reading = Arrived { stream: StreamIx::of(0), at: now(), value: Value::Int(value), by: None };
        let (runner, ..) = course.runner.as_mut().unwrap();
        assert!(runner.turn(Post { readings: vec![reading], ..Post::default() }).is_none());
    }
    course.end();
    let text = texts(&recordings).remove(0);
    assert_eq!(
        checked(0, &text).to_string(),
        "It gives its own actions again: 2 from 4 readings, until 0:00.400. It ends there: it was stopped."
    );
    let said = |text: &str| recording::check(text).unwrap_err().to_string();
    let edited = text.replacen("100 / ball > 30", "100 / ball > 40", 1);
    assert_eq!(
        said(&edited),
        "The replay differs: the robot was told “page” 3 at 0:00.300, and the replay gives nothing."
    );
    let other = text.replace("\"stream\":\"page\",\"value\":2", "\"stream\":\"page\",\"value\":7");
    assert_eq!(
        said(&other),
        "The replay differs: the robot was told “page” 7 at 0:00.100, and the replay gives “page” 2 at 0:00.100."
    );
    let without: String =
        text.lines().filter(|line| !line.contains("\"page\",\"value\":3")).map(|line| format!("{line}\n")).collect();
    assert_eq!(said(&without), "The replay differs: it gives “page” 3 at 0:00.300, and the robot was told nothing.");
    let gap = text.replacen("\n{\"t\":300", "\n{\"mark\":\"gap\",\"lost\":3}\n{\"t\":300", 1);
    assert!(said(&gap).starts_with("3 lines are missing after 0:00.200, "), "{}", said(&gap));
    let old = text.replacen("rrp-recording/2", "rrp-recording/1", 1);
    assert!(said(&old).contains("it lacks the program that ran, as older recordings do"), "{}", said(&old));
}
