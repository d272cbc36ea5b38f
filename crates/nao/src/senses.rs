//! A sense at work: a task of its own that prepares it, hears events or asks, reads, and cleans up after itself.

use crate::deed::Call;
use crate::devices::Sense;
use crate::link::{CALL, call, try_call};
use crate::shared::Shared;
use qi::{Keep, QiError, Session, Value};
use robot::{Health, Use};
use std::sync::Arc;
use std::time::{Duration, Instant};
use tokio::sync::mpsc;
use tokio::task::JoinSet;
use tokio::time::MissedTickBehavior;
use tokio_util::sync::CancellationToken;

/// Events of one key that may wait.
const EVENTS_MAX: usize = 256;
/// How often a joint is read, in milliseconds.
const JOINT_MS: u64 = 50;
/// The period that extractors are asked for, in milliseconds, and their precision, which is not used.
const PERIOD_MS: i32 = 33;
/// A period that no sense has.
const NEVER_MS: u64 = 3_600_000;

/// Runs a sense until it is cancelled.
pub(crate) async fn run(
    session: Session,
    shared: Arc<Shared>,
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
    let ready = tokio::select! {
        ready = prepare(&session, &shared, &name, &*sense, &events, &mut listeners) => ready,
        () = cancel.cancelled() => Ok(()),
    };
    if let Err(error) = ready {
        let why = format!("a sense could not be started ({error})");
        tracing::warn!(stream = %user.stream, %error, "a sense could not be started");
        let mut state = shared.state();
        if state.is_linked() {
            state.health = Health::Degraded(why);
        }
    }
    let first = sense.first();
    let period = sense.poll().map_or_else(|| sense.joint().map_or(NEVER_MS, |_| JOINT_MS), |(_, period)| period);
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
            _ = beat.tick() => ask(&session, &shared, &user, &mut *sense).await,
        }
    }
    drop(listeners);
    if let Some(service) = sense.extractor()
        && shared.state().subscribed.remove(&(service, name.clone()))
    {
        let _ = try_call(&session, &Call::new(service, "unsubscribe", [name.into()])).await;
    }
}

async fn prepare(
    session: &Session,
    shared: &Shared,
    name: &str,
    sense: &dyn Sense,
    events: &mpsc::Sender<(&'static str, Value, Instant)>,
    listeners: &mut JoinSet<()>,
) -> Result<(), QiError> {
    for wanted in sense.begin() {
        call(session, &wanted, CALL).await?;
    }
    if let Some(service) = sense.extractor() {
        shared.state().subscribed.insert((service, name.to_owned()));
        let with_period = [name.into(), PERIOD_MS.into(), 0.0_f32.into()];
        let done = call(session, &Call::new(service, "subscribe", with_period), CALL).await;
        if matches!(done, Err(QiError::NoMethod { .. })) {
            call(session, &Call::new(service, "subscribe", [name.into()]), CALL).await?;
        } else {
            done?;
        }
    }
    for key in sense.keys() {
        listen(session, key, events.clone(), listeners).await?;
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
    let mut signal = subscriber.subscribe("signal", Keep::All(EVENTS_MAX)).await?;
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
async fn ask(session: &Session, shared: &Shared, user: &Use, sense: &mut dyn Sense) {
    if let Some(joint) = sense.joint() {
        let angle = shared.state().angles.get(joint).copied();
        if let Some(angle) = angle {
            read(shared, user, sense, "poll", &Value::F64(angle), Instant::now());
        }
    } else if let Some((wanted, _)) = sense.poll()
        && let Some(value) = try_call(session, &wanted).await
    {
        read(shared, user, sense, "poll", &value, Instant::now());
    }
}

fn read(shared: &Shared, user: &Use, sense: &mut dyn Sense, key: &str, value: &Value, at: Instant) {
    let at_ms = shared.state().time_at(at);
    if let Some(read) = sense.read(key, value, at_ms) {
        shared.state().put_reading(user, read);
    }
}
