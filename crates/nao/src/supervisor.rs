//! Keeps the links to the robot: connects, looks what is there, watches, and finds it again after a loss, for ever. After a
//! loss nothing goes on by itself.

use crate::acting::Acting;
use crate::connecting::{EndingTask, find, ping};
use crate::deed::ServiceCall;
use crate::link::{call, try_call};
use crate::link_commands::{LinkCommand, LinkCommands, drain};
use crate::scan::{clean, scan};
use crate::senses::SenseTurns;
use crate::settings::RobotSettings;
use crate::shared::NaoShared;
use crate::{camera, check, identity, inventory, restoring, senses, status, stopping, stranger, voicing};
use futures_util::future::join_all;
use phrase::{Phrase, phrase};
use qi::{Session, Value};
use robot::{Control, Health, Use};
use std::collections::BTreeMap;
use std::hash::{BuildHasher, RandomState};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use tokio::sync::mpsc;
use tokio::task::JoinHandle;
use tokio::time::MissedTickBehavior;
use tokio_util::sync::CancellationToken;

/// Pauses before the next try, in milliseconds: at first, and at most.
const AGAIN_MIN_MS: u64 = 250;
const AGAIN_MAX_MS: u64 = 5_000;
/// The motion cycle of the robot, if it does not tell another, in milliseconds.
const CYCLE_MS: u64 = 20;
/// The longest that waking up and resting may take.
const BODY: Duration = Duration::from_secs(30);
/// Pause before it is looked again what there is, in milliseconds.
const SCAN_MS: u64 = 300;
/// The longest that the last Stop may take at the end, in milliseconds, and one of before until the robot is used all
/// the same.
const LAST_STOP_MS: u64 = 1_000;
const FIRST_STOP_MS: u64 = 3_000;

/// The services that act.
const ACTORS: [&str; 7] =
    ["ALMotion", "ALTextToSpeech", "ALLeds", "ALAudioPlayer", "ALAnimationPlayer", "ALRobotPosture", "ALFaceDetection"];

/// The thread of the link.
pub(crate) fn keep(settings: &RobotSettings, shared: &Arc<NaoShared>, mut orders: LinkCommands, waiting: &AtomicUsize) {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
    match runtime {
        Ok(runtime) => {
            runtime.block_on(work(settings, shared, &mut orders, waiting));
            runtime.shutdown_background();
        }
        Err(error) => {
            shared.state().health =
                Health::Lost(phrase!("nao.there_is_no_runtime_for", "there is no runtime for it ({error})"))
        }
    }
}

async fn work(settings: &RobotSettings, shared: &Arc<NaoShared>, orders: &mut LinkCommands, waiting: &AtomicUsize) {
    let (mut pause_ms, mut tries) = (AGAIN_MIN_MS, 0_u64);
    let chance = RandomState::new();
    // Whether a Stop waits for the robot that was expected.
    let mut owes_stop = false;
    while !shared.is_ended() {
        let found = tokio::select! {
            found = find(settings) => found,
            () = shared.ending.notified() => break,
        };
        let why = match found {
            Ok((address, session)) => {
                let why = match identity::recognise(&session, shared).await {
                    Err(error) => check::sentence(&error),
                    Ok(who) => {
                        if who.is_some() {
                            owes_stop |= shared.put_off_stop();
                        } else if std::mem::take(&mut owes_stop) {
                            shared.stop();
                        }
                        let stopper = tokio::spawn(stopping::keep(address, settings.clone(), Arc::clone(shared)));
                        let why = match who {
                            Some(who) => stranger::meet(&session, shared, orders, waiting, who).await,
                            None => {
                                let why = serve(&session, settings, shared, orders, waiting).await;
                                // The other link may still be there; else it is done as soon as the robot is.
                                shared.stop();
                                end_well(shared, LAST_STOP_MS).await;
                                why
                            }
                        };
                        stopper.abort();
                        why
                    }
                };
                session.link().close();
                // One that was not ready yet, as it has just begun, is not pressed.
                if shared.state().is_linked() {
                    pause_ms = AGAIN_MIN_MS;
                }
                why
            }
            Err(error) => check::sentence(&error),
        };
        lose(shared, why);
        drain(orders, waiting);
        tries += 1;
        // Servers that lost the same robot do not come back at the same moment.
        let jitter = chance.hash_one(tries) % (pause_ms / 4);
        tokio::select! {
            () = tokio::time::sleep(Duration::from_millis(pause_ms + jitter)) => {}
            () = shared.ending.notified() => {}
        }
        pause_ms = (pause_ms * 2).min(AGAIN_MAX_MS);
    }
}

/// The link is gone: who used the robot has to begin again.
fn lose(shared: &NaoShared, why: Phrase) {
    shared.halt(phrase!("nao.the_connection_to_it_was", "the connection to it was lost"));
    // Who knows who holds it when it is back.
    shared.take_rest();
    let mut state = shared.state();
    state.health = Health::Lost(why);
    state.condition = robot::Condition::default();
    (state.stiff_legs, state.on_ground) = (None, None);
    state.subscribed.take();
    state.forget_reasons();
    state.angles.clear();
    (state.installed, state.faces) = (Arc::default(), Arc::default());
    (state.saying, state.tracking) = (String::new(), String::new());
    state.playing.clear();
    state.animations.clear();
}

/// A Stop that is wanted is still carried out, if that can be.
async fn end_well(shared: &NaoShared, within_ms: u64) {
    let done = async {
        while shared.wants_stop() {
            tokio::time::sleep(Duration::from_millis(10)).await;
        }
    };
    let _its_time = tokio::time::timeout(Duration::from_millis(within_ms), done).await;
}

/// A robot that is there; until it is lost, with the reason.
async fn serve(
    session: &Session,
    settings: &RobotSettings,
    shared: &Arc<NaoShared>,
    orders: &mut LinkCommands,
    waiting: &AtomicUsize,
) -> Phrase {
    match scan(session).await {
        Ok(scanned) => scanned.note(&mut shared.state()),
        Err(error) => return check::sentence(&error),
    }
    camera::clean(session, settings).await;
    if clean(session, settings, shared).await {
        // Whoever left that behind may have left it walking.
        shared.stop();
    }
    voicing::put_back(session, shared, &settings.own_name).await;
    restoring::put_back(session, &settings.own_name, &settings.former).await;
    status::ask(session, shared).await;
    let watch = EndingTask(tokio::spawn(status::watch(session.clone(), Arc::clone(shared))));
    let cycle = try_call(session, &ServiceCall::new("ALMotion", "getMotionCycleTime", [])).await;
    let cycle = cycle.and_then(|value| value.as_i64()).map_or(CYCLE_MS, |ms| ms.clamp(5, 100).cast_unsigned());
    // Known before they are needed: what is called first also comes first.
    join_all(ACTORS.iter().map(|name| session.service(name))).await;
    // A Stop of before is over before anything begins: else it would take what begins for what it ends.
    end_well(shared, FIRST_STOP_MS).await;
    drain(orders, waiting);
    shared.state().health = Health::Ready;
    let (done, mut ended) = mpsc::unbounded_channel();
    let mut acting =
        Acting::new(session.clone(), Arc::clone(shared), done, Duration::from_millis(cycle), &settings.own_name);
    let turns = SenseTurns::default();
    let mut open: BTreeMap<Use, (CancellationToken, JoinHandle<()>)> = BTreeMap::new();
    let (mut controlled, mut _blinking, life) = (None, None, Arc::new(Mutex::new(None)));
    let mut beat = tokio::time::interval(Duration::from_millis(cycle));
    beat.set_missed_tick_behavior(MissedTickBehavior::Delay);
    let looking = EndingTask(tokio::spawn(inventory::keep(session.clone(), Arc::clone(shared))));
    let pinging = EndingTask(tokio::spawn(ping(session.clone(), Arc::clone(shared))));
    let scanning = EndingTask(tokio::spawn(scan_again(session.clone(), Arc::clone(shared))));
    let why = loop {
        tokio::select! {
            biased;
            () = shared.ending.notified() => break phrase!("nao.it_is_not_used_any", "it is not used any more"),
            ending = session.link().ended() => break phrase!("nao.the_connection_ended", "the connection ended: {ending}"),
            order = orders.recv() => match order {
                None => break phrase!("nao.it_is_not_used_any", "it is not used any more"),
                Some(LinkCommand::Open(user, sense)) => {
                    let (cancel, name) = (CancellationToken::new(), format!("{}/{}/{}", settings.own_name, user.run, user.stream));
                    let task = senses::run(session.clone(), Arc::clone(shared), SenseTurns::clone(&turns), name, user.clone(), sense, cancel.clone());
                    open.insert(user, (cancel, tokio::spawn(task)));
                }
                Some(LinkCommand::Close(user)) => {
                    if let Some((cancel, _)) = open.remove(&user) {
                        cancel.cancel();
                    }
                    acting.close(&user);
                }
                Some(LinkCommand::Do(stop_generation, user, deed)) => {
                    waiting.fetch_sub(1, Ordering::SeqCst);
                    acting.act(stop_generation, user, deed);
                }
                Some(LinkCommand::Control(Control::Blink)) => {
                    // A sign that is asked for anew begins anew.
                    _blinking = Some(EndingTask(tokio::spawn(identity::blink(session.clone(), Some(Arc::clone(shared))))));
                }
                Some(LinkCommand::Control(control)) => {
                    let life = Arc::clone(&life);
                    controlled = Some(EndingTask(tokio::spawn(self::control(session.clone(), Arc::clone(shared), life, control))));
                }
            },
            Some(over) = ended.recv() => acting.done(over),
            _ = beat.tick() => acting.cycle(),
        }
    };
    drop((watch, looking, pinging, scanning, controlled));
    open.into_values().for_each(|(cancel, _)| cancel.cancel());
    why
}

/// Looks again whenever services come or go: a robot that starts has them one by one.
async fn scan_again(session: Session, shared: Arc<NaoShared>) {
    let (Ok(mut added), Ok(mut removed)) = (session.added().await, session.removed().await) else { return };
    loop {
        if let Ok(scanned) = scan(&session).await {
            scanned.note(&mut shared.state());
        }
        tokio::select! {
            change = added.next() => if change.is_err() { return },
            change = removed.next() => if change.is_err() { return },
        }
        // Many come at once.
        tokio::time::sleep(Duration::from_millis(SCAN_MS)).await;
    }
}

/// Takes control or gives it back, unless a Stop comes between: then what is left is not done.
async fn control(session: Session, shared: Arc<NaoShared>, life: Arc<Mutex<Option<String>>>, control: Control) {
    let stop_generation = shared.stop_generation();
    let stopped = async {
        while shared.stop_generation() == stop_generation {
            tokio::time::sleep(Duration::from_millis(10)).await;
        }
    };
    tokio::select! {
        () = take(&session, &shared, &life, control) => {}
        () = stopped => {}
    }
    status::ask(&session, &shared).await;
}

async fn take(session: &Session, shared: &NaoShared, before: &Mutex<Option<String>>, control: Control) {
    let say = async |wanted: ServiceCall, within| {
        let done = call(session, &wanted, within).await;
        done.inspect_err(|error| tracing::warn!(method = wanted.method, %error, "the robot did not do it")).is_ok()
    };
    let posture = |name: &str| ServiceCall::new("ALRobotPosture", "goToPosture", [name.into(), Value::F32(0.5)]);
    let life = |state: &str| ServiceCall::new("ALAutonomousLife", "setState", [state.into()]);
    let kept = || before.lock().unwrap_or_else(PoisonError::into_inner);
    match control {
        Control::Take => {
            let now = try_call(session, &ServiceCall::new("ALAutonomousLife", "getState", [])).await;
            let now = now.and_then(|state| state.as_text().map(|state| state.into_owned()));
            if let Some(state) = now.filter(|state| state != "safeguard") {
                *kept() = Some(state);
            }
            say(life("disabled"), BODY).await;
            // The end of its own life may end in a rest.
            say(ServiceCall::new("ALMotion", "wakeUp", []), BODY).await;
            if shared.state().posture != "Standing" {
                say(posture("Stand"), BODY).await;
            }
        }
        Control::GiveBack => {
            // Its own life as it was before control was taken here; calm if that is not known.
            let state = kept().take().unwrap_or_else(|| "solitary".to_owned());
            say(life(&state), BODY).await;
        }
        Control::WakeUp => drop(say(ServiceCall::new("ALMotion", "wakeUp", []), BODY).await),
        Control::Stand => drop(say(posture("Stand"), BODY).await),
        Control::Sit => drop(say(posture("Sit"), BODY).await),
        Control::ForgetFaces => {
            say(ServiceCall::new("ALFaceDetection", "clearDatabase", []), BODY).await;
            shared.looking.notify_one();
        }
        Control::ForgetFace(name) => {
            say(ServiceCall::new("ALFaceDetection", "forgetPerson", [name.into()]), BODY).await;
            shared.looking.notify_one();
        }
        // By the link of Stop, or by lights.
        Control::Rest | Control::Blink => {}
    }
}
