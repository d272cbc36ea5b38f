//! Stops in a row under load: from `Robot::stop` until head and arms are held and the legs were told to stop, as the stand-in
//! notes the calls, and until it tells that nothing moves, speaks, plays or is measured. It stands when its step is over.

use crate::driver::Driver;
use crate::figures::{Times, Verdict, micros, monotonic_us, title};
use crate::peer::{PATIENCE, Peer};
use crate::proxy::Proxy;
use behaviour::Value;
use futures_util::FutureExt;
use robot::{Health, Millis, Robot, Use};
use serde_json::{Value as Json, json};
use std::panic::{AssertUnwindSafe, resume_unwind};
use std::time::{Duration, Instant};

/// Half of them while the link by which the robot is driven leads nowhere.
const STOPS: usize = 200;
/// The bar of the slowest, in microseconds.
const BAR_US: f64 = 300_000.0;
/// Steps after which the ways by which a link came again are counted: both are there then.
const SETTLED: usize = 40;
/// More joints than anything but a Stop holds at once.
const UPPER_MIN: usize = 8;
/// It walks at nearly full speed, in metres a second; from there the stand-in comes to rest when its foot is down.
const FULL_MPS: f64 = 0.049;
/// Pause before the state is asked for.
const LOOK: Duration = Duration::from_millis(2);

/// With a black hole and without, in turn.
pub(crate) async fn measure(verdict: &mut Verdict) {
    let Some(peer) = Peer::start("the benchmark of Stops", &[]).await else { return };
    // Else it tells that it lives, which is no loss.
    peer.world(json!({"life": "disabled", "life_disabled_rests": false})).await;
    let proxy = Proxy::before(&peer.address).await;
    let mut driver = Driver::at(&proxy.address).await;
    let (mut plain, mut holed) = (Ends::default(), Ends::default());
    let stopping = AssertUnwindSafe(all(&mut driver, &peer, &proxy, [&mut plain, &mut holed]));
    let done = stopping.catch_unwind().await;
    title("from Stop until the robot is calm, as it tells itself", "");
    plain.print("while it does all of this");
    holed.print("the same, the other link in a black hole");
    verdict.at_most("Stop, worst", plain.held.within(100), BAR_US);
    verdict.at_most("Stop with a black hole, worst", holed.held.within(100), BAR_US);
    done.unwrap_or_else(|why| resume_unwind(why));
    assert_eq!((plain.held.0.len(), holed.held.0.len()), (STOPS / 2, STOPS / 2));
    peer.was_safe().await;
}

/// All Stops, of each kind in turn.
async fn all(driver: &mut Driver, peer: &Peer, proxy: &Proxy, [plain, holed]: [&mut Ends; 2]) {
    for number in 0..STOPS {
        let users = load(driver, peer).await;
        if number % 2 == 0 {
            stop(driver, peer, plain).await;
        } else {
            black_hole(driver, peer, proxy).await;
            stop(driver, peer, holed).await;
            cut(driver, proxy).await;
        }
        users.iter().for_each(|user| driver.nao.close(user));
        driver.wait(2).await;
    }
}

/// It walks, speaks, plays, follows the ball with its head and looks for it.
async fn load(driver: &mut Driver, peer: &Peer) -> Vec<Use> {
    let file = [("sound", Value::text("file")), ("file", Value::text("/usr/share/naoqi/wav/random.wav"))];
    // Away from the wall that it walked to.
    peer.world(json!({"pose": [0, 0, 0]})).await;
    let walk = driver.open("walk", "Walk", &[]);
    let say = driver.open("say", "SayParameter", &[("text", Value::text("word ".repeat(150)))]);
    let sound = driver.open("file", "Sound", &file);
    let gesture = driver.open("hey", "Animation", &[]);
    let follow = driver.open("follow", "Tracker", &[]);
    let ball = driver.open("ball", "RedBall", &[]);
    let words = driver.open("words", "WordRecognized", &[("words", Value::text("yes, no"))]);
    let busy = |state: &Json| {
        state["velocity"][0].as_f64().unwrap() > FULL_MPS
            && state["speaking"].is_string()
            && follows(state)
            && state["sounding"].as_array().is_some_and(|sounding| !sounding.is_empty())
            && used_by_us(state) == 2
    };
    let end = Instant::now() + PATIENCE;
    loop {
        for user in [&walk, &say, &sound, &gesture, &follow] {
            driver.tell(user, 1.0);
        }
        let state = peer.state().await;
        if busy(&state) {
            return vec![walk, say, sound, gesture, follow, ball, words];
        }
        assert!(Instant::now() < end, "never busy: {state}");
        driver.step().await;
    }
}

/// Returns the number of extractors that measure for us.
fn used_by_us(state: &Json) -> usize {
    let subscribers = state["subscribers"].as_object().unwrap();
    subscribers.values().filter(|names| names.to_string().contains("rrp-test")).count()
}

fn follows(state: &Json) -> bool {
    state["subscribers"].to_string().contains("rrp-test/follow/")
}

/// A part that has to end, and a test whether it goes on.
type Part = (&'static str, fn(&Json) -> bool);

const PARTS: [Part; 7] = [
    ("walking", |state| state["moving"] != json!(false)),
    ("speaking", |state| !state["speaking"].is_null() || has(state, "waiting_texts")),
    ("following", follows),
    ("playing a gesture", |state| has(state, "playing")),
    ("playing a sound", |state| has(state, "sounding")),
    ("measuring for us", |state| used_by_us(state) > 0),
    ("calls that block", |state| has(state, "blocked")),
];

fn has(state: &Json, name: &str) -> bool {
    !state[name].as_array().unwrap().is_empty()
}

/// When each part was over, and all of them.
#[derive(Default)]
struct Ends {
    parts: [Times; PARTS.len()],
    all: Times,
    /// When head and arms were held and the legs were told to stop.
    held: Times,
}

impl Ends {
    fn print(&self, what: &str) {
        self.held.print(&format!("{what}: held, and told to stop"), None);
        self.all.print(what, None);
        for ((part, _), times) in PARTS.iter().zip(&self.parts) {
            times.print(&format!("  {part}"), None);
        }
    }
}

/// The state is asked for again and again; what was still there counts until the next answer.
async fn stop(driver: &mut Driver, peer: &Peer, ends: &mut Ends) {
    let mut ended = [None; PARTS.len()];
    peer.clear().await;
    let (began, began_us) = (Instant::now(), monotonic_us());
    driver.nao.stop(Millis(0));
    while ended.contains(&None) {
        tokio::time::sleep(LOOK).await;
        let state = peer.state().await;
        let now = micros(began.elapsed());
        for ((_, goes_on), ended) in PARTS.iter().zip(&mut ended) {
            *ended = if goes_on(&state) { None } else { ended.or(Some(now)) };
        }
        assert!(began.elapsed() < PATIENCE, "never calm: {state}");
    }
    let ended = ended.map(Option::unwrap_or_default);
    ends.all.0.push(ended.into_iter().fold(0.0, f64::max));
    ended.into_iter().zip(&mut ends.parts).for_each(|(ended, times)| times.0.push(ended));
    let first = |calls: &[Json], is_it: &dyn Fn(&Json) -> bool| {
        let at = calls.iter().find(|call| is_it(call)).and_then(|call| call["monotonic_us"].as_f64());
        at.map_or(f64::INFINITY, |at| at - began_us)
    };
    let all_held = |call: &Json| {
        let joints = call["args"][0].as_array().map_or(0, Vec::len);
        call["method"] == "setAngles" && joints > UPPER_MIN && call["args"][0][0] == "HeadYaw"
    };
    let stopped = |call: &Json| call["service"] == "ALMotion" && call["method"] == "stopMove";
    // A part that stood and was silent already is calm before it is held.
    let held = loop {
        let calls = peer.calls_since(0).await;
        let held = first(&calls, &all_held).max(first(&calls, &stopped));
        if held.is_finite() || began.elapsed() > PATIENCE {
            break held;
        }
        tokio::time::sleep(LOOK).await;
    };
    ends.held.0.push(held);
}

/// From now on nothing comes by the link that drives the robot: the one before the last, which is for Stop alone.
async fn black_hole(driver: &mut Driver, peer: &Peer, proxy: &Proxy) {
    proxy.swallow(Some(proxy.connections() - 2));
    driver.wait(4).await;
    // Joints are read by that link all the time.
    peer.clear().await;
    driver.wait(20).await;
    assert!(peer.calls("ALMotion.getAngles").await.is_empty(), "it still comes by");
}

/// The link is cut, and comes back.
async fn cut(driver: &mut Driver, proxy: &Proxy) {
    proxy.swallow(None);
    let before = proxy.connections();
    proxy.cut();
    let mut is_told = false;
    driver
        .until("it is there again, by both links", |driver| {
            is_told |= driver.nao.take_halt().is_some();
            is_told && driver.nao.health() == Health::Ready && proxy.connections() >= before + 2
        })
        .await;
    driver.wait(SETTLED).await;
}
