//! A sense at work: a task of its own that prepares it, hears events or asks, reads, and cleans up after itself.

use crate::deed::ServiceCall;
use crate::devices::{Sense, SenseTurn};
use crate::hearing;
use crate::link::{CALL, call, is_silent, try_call};
use crate::local_time;
use crate::outcome;
use crate::shared::NaoShared;
use phrase::phrase;
use qi::{EventChoice, QiError, Session, Value};
use robot::Use;
use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::{Duration, Instant};
use tokio::sync::mpsc;
use tokio::task::JoinSet;
use tokio::time::MissedTickBehavior;
use tokio_util::sync::CancellationToken;

/// Events of one key that may wait.
const EVENTS_MAX: usize = 256;
/// Words that are listened for at once.
const WORDS_MAX: usize = 200;
/// The period at which a joint is read, in milliseconds.
const JOINT_MS: u64 = 50;
/// The period at which the clock is looked at for a new minute, in milliseconds.
const CLOCK_MS: u64 = 1_000;
/// The period that extractors are asked for, in milliseconds, and their precision, which is not used.
const PERIOD_MS: i32 = 33;
/// A period that no sense has.
const NEVER_MS: u64 = 3_600_000;

/// Whose turn it is at what there is one of only, on one link, and since when that is set.
pub(crate) type SenseTurns = Arc<tokio::sync::Mutex<Option<(SenseTurn, Instant)>>>;

/// The values that are heard of keys of ALMemory, with the moment at which they came.
type HeardKeys = mpsc::Receiver<(&'static str, Value, Instant)>;

/// Runs a sense until it is cancelled.
pub(crate) async fn run(
    session: Session,
    shared: Arc<NaoShared>,
    turns: SenseTurns,
    name: String,
    user: Use,
    mut sense: Box<dyn Sense>,
    cancel: CancellationToken,
) {
    if sense.beat_us().is_some() {
        return;
    }
    let (events, mut heard) = mpsc::channel(EVENTS_MAX);
    let mut listeners = JoinSet::new();
    let mut measuring = Measuring { session: &session, shared: &shared, name: &name, asked: None, is_known: false };
    // Whole, whatever comes: what is paused for it goes on again.
    let begun = begin(&session, &shared, &turns, (&name, &user), &*sense).await;
    let ready = tokio::select! {
        ready = prepare(begun, &mut measuring, &*sense, &events, &mut listeners) => ready,
        () = cancel.cancelled() => Ok(()),
    };
    if let Err(error) = ready {
        tracing::warn!(stream = %user.stream, %error, "a sense could not be started");
        let label = shared.state().labels.get(&user).copied().unwrap_or_default();
        let why = phrase!("nao.does_not_work", "“{label}” does not work: {why}", why = outcome::why(&error));
        shared.state().note_silent(&user, Some(why));
    }
    let first = sense.first();
    let by_itself = || {
        if sense.needs_clock() { CLOCK_MS } else { sense.joint().map_or(NEVER_MS, |_| JOINT_MS) }
    };
    let period = sense.poll().map_or_else(by_itself, |(_, period)| period);
    let mut beat = tokio::time::interval(Duration::from_millis(period));
    beat.set_missed_tick_behavior(MissedTickBehavior::Delay);
    if !cancel.is_cancelled()
        && let Some(wanted) = first
        && let Some(value) = try_call(&session, &wanted).await
    {
        read(&shared, &user, &mut *sense, "first", &value, Instant::now());
    }
    loop {
        tokio::select! {
            () = cancel.cancelled() => break,
            event = heard.recv() => match event {
                Some((key, value, at)) => read(&shared, &user, &mut *sense, key, &value, at),
                None => break,
            },
            _ = beat.tick() => tokio::select! {
                () = ask(&session, &shared, &turns, (&user, &mut heard), &mut *sense) => {}
                () = cancel.cancelled() => break,
            },
        }
    }
    drop(listeners);
    measuring.end().await;
    let was_last = {
        let mut state = shared.state();
        state.note_silent(&user, None);
        state.words.remove(&user).is_some() && state.words.is_empty()
    };
    if was_last {
        // Nobody begins to listen meanwhile.
        let _alone = turns.lock().await;
        hearing::put_back(&session, own_name(&name, &user)).await;
    }
}

/// Returns the name by which this server subscribes: the beginning of the name of a use.
fn own_name<'a>(name: &'a str, user: &Use) -> &'a str {
    name.strip_suffix(&format!("/{}/{}", user.run, user.stream)).unwrap_or(name)
}

async fn begin(
    session: &Session,
    shared: &NaoShared,
    turns: &SenseTurns,
    (name, user): (&str, &Use),
    sense: &dyn Sense,
) -> Result<(), QiError> {
    let (mut calls, mut _alone) = (sense.begin(), None);
    if let Some((language, words)) = sense.words() {
        // One after the other, so that the last one sets the words of all.
        _alone = Some(turns.lock().await);
        hearing::note(session, own_name(name, user)).await;
        let mut state = shared.state();
        state.words.insert(user.clone(), words.to_vec());
        let all: BTreeSet<&String> = state.words.values().flatten().take(WORDS_MAX).collect();
        let all = Value::List(all.into_iter().map(|word| word.as_str().into()).collect());
        let hears = |method: &'static str, arguments: Vec<Value>| ServiceCall::new(hearing::SERVICE, method, arguments);
        calls.extend([
            // They cannot be set otherwise; spotted among others.
            hears("pause", vec![true.into()]),
            hears("setLanguage", vec![language.into()]),
            hears("setVocabulary", vec![all, true.into()]),
            hears("pause", vec![false.into()]),
        ]);
    }
    let mut begun = Ok(());
    for wanted in calls {
        begun = begun.and(call(session, &wanted, CALL).await.map(drop));
    }
    begun
}

/// A measurement that the robot makes for a sense only, from when it is asked to until it no longer is.
struct Measuring<'a> {
    session: &'a Session,
    shared: &'a NaoShared,
    name: &'a str,
    /// The service that was asked, and the number of that among all that is measured for us.
    asked: Option<(&'static str, u64)>,
    /// True if the robot has answered; until then a Stop may come by its own link before the question does.
    is_known: bool,
}

impl Measuring<'_> {
    async fn begin(&mut self, service: &'static str) -> Result<(), QiError> {
        let stop_generation = self.shared.stop_generation();
        let number = self.shared.state().subscribed.add(service, self.name);
        self.asked = Some((service, number));
        let with_period = [self.name.into(), PERIOD_MS.into(), 0.0_f32.into()];
        let done = call(self.session, &ServiceCall::new(service, "subscribe", with_period), CALL).await;
        if matches!(done, Err(QiError::NoMethod { .. })) {
            call(self.session, &ServiceCall::new(service, "subscribe", [self.name.into()]), CALL).await?;
        } else {
            done?;
        }
        // A Stop that came meanwhile may have ended what had not begun.
        let is_ours = self.shared.state().subscribed.has(service, self.name, number);
        self.is_known = is_ours && self.shared.stop_generation() == stop_generation;
        if !self.is_known {
            self.end().await;
        }
        Ok(())
    }

    /// Ends it, unless a Stop has. Where the robot does not say so, a Stop ends it by its own link.
    async fn end(&mut self) {
        let Some((service, number)) = self.asked.take() else { return };
        let is_ours = self.shared.state().subscribed.has(service, self.name, number);
        if !is_ours && self.is_known {
            return;
        }
        let done = call(self.session, &ServiceCall::new(service, "unsubscribe", [self.name.into()]), CALL).await;
        if matches!(is_silent(&done), Ok(false)) {
            self.shared.state().subscribed.end(service, self.name, number);
        }
    }
}

async fn prepare(
    begun: Result<(), QiError>,
    measuring: &mut Measuring<'_>,
    sense: &dyn Sense,
    events: &mpsc::Sender<(&'static str, Value, Instant)>,
    listeners: &mut JoinSet<()>,
) -> Result<(), QiError> {
    begun?;
    if let Some(service) = sense.extractor() {
        measuring.begin(service).await?;
    }
    for key in sense.keys() {
        listen(measuring.session, key, events.clone(), listeners).await?;
    }
    Ok(())
}

/// Hears a key of ALMemory for as long as the task lasts.
pub(crate) async fn listen(
    session: &Session,
    key: &'static str,
    events: mpsc::Sender<(&'static str, Value, Instant)>,
    listeners: &mut JoinSet<()>,
) -> Result<(), QiError> {
    let memory = session.service("ALMemory").await?;
    let subscriber = memory.call_object("subscriber", &[key.into()]).await?;
    let mut signal = subscriber.subscribe("signal", EventChoice::All(EVENTS_MAX)).await?;
    listeners.spawn(async move {
        // The object lives on the robot for as long as it is held here.
        let _held = subscriber;
        loop {
            match signal.next().await {
                Ok(event) => {
                    let value = event.arguments.into_iter().next().unwrap_or(Value::Unit);
                    if events.send((key, value, event.at)).await.is_err() {
                        return;
                    }
                }
                Err(QiError::Disconnected(_)) => return,
                Err(error) => tracing::debug!(key, %error, "an event could not be read"),
            }
        }
    });
    Ok(())
}

/// Asks what is asked again and again.
async fn ask(
    session: &Session,
    shared: &NaoShared,
    turns: &SenseTurns,
    (user, heard): (&Use, &mut HeardKeys),
    sense: &mut dyn Sense,
) {
    // Held until it has its answer: the others wait, each in its order.
    let mut whose = None;
    if let Some(turn) = sense.turn() {
        let mut now = turns.lock().await;
        if now.as_ref().is_none_or(|(set, _)| *set != turn) {
            *now = None;
            for wanted in &turn.calls {
                if try_call(session, wanted).await.is_none() {
                    return;
                }
            }
            let since = Instant::now();
            tokio::time::sleep(Duration::from_millis(turn.wait_ms)).await;
            *now = Some((turn, since));
        }
        if let Some((_, since)) = &*now {
            sense.turned(shared.state().time_at(*since));
        }
        // What came while it waited for its turn.
        while let Ok((key, value, at)) = heard.try_recv() {
            read(shared, user, sense, key, &value, at);
        }
        whose = Some(now);
    }
    if sense.needs_clock() {
        read(shared, user, sense, "poll", &Value::I64(local_time::minutes()), Instant::now());
    } else if let Some(joint) = sense.joint() {
        let angle = shared.state().angles.get(joint).copied();
        if let Some(angle) = angle {
            read(shared, user, sense, "poll", &Value::F64(angle), Instant::now());
        }
    } else if let Some((wanted, _)) = sense.poll()
        && let Some(value) = try_call(session, &wanted).await
    {
        read(shared, user, sense, "poll", &value, Instant::now());
    }
    drop(whose);
}

fn read(shared: &NaoShared, user: &Use, sense: &mut dyn Sense, key: &str, value: &Value, at: Instant) {
    let at_ms = shared.state().time_at(at);
    if let Some(read) = sense.read(key, value, at_ms) {
        shared.sensed(user, read);
    }
}
