//! The link to the server: one WebSocket that comes back by itself, and the answers that are waited for.

mod editor_link;
mod socket;
mod written;

use crate::browser;
pub(crate) use editor::NoAnswer;
pub(crate) use editor_link::EditorLink;
pub(crate) use written::WrittenRequest;

use protocol::{AnyAnswer, Assembly, Event, Message, Refused, Request, STOPS_PER_START, Unanswered, answer, request};
use socket::Socket;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

/// The first and the longest wait before the next try, in milliseconds.
const BACK_OFF_MS: [f64; 2] = [250.0, 8_000.0];
/// Without a word from the server for so long the link counts as lost, in milliseconds; with the next look that is known
/// within six seconds.
const SILENCE_MS: f64 = 5_700.0;
/// How often it is looked whether the server still speaks, in milliseconds.
const LISTEN_MS: i32 = 200;
/// The number of one's own newest Stop that was answered, as `static/stop.js` leaves it.
const OWN_STOP: &str = "rrpStops";

/// The work that is done with an answer, or without one.
pub(crate) type OnAnyAnswer = Box<dyn FnOnce(Result<AnyAnswer, NoAnswer>)>;

/// The work that is done with every event.
type Ear = Rc<dyn Fn(&Event)>;

/// The reasons why there will be no link again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LinkEnd {
    /// The invitation ended by which this person came.
    Revoked,
    /// Another page of this person has the place of this one.
    GaveWay,
}

/// Hears what the link brings. The link knows nothing else of whoever does.
pub(crate) trait LinkHandler {
    /// Returns the greeting of this page.
    fn greeting(&self) -> request::Hello;
    /// The server greeted back.
    fn greeted(&self, welcome: answer::Welcome);
    /// The server told something unasked.
    fn hear(&self, event: Event);
    /// The server refused something, and nobody waits for that answer.
    fn refused(&self, no: &Refused);
    /// Nothing was heard for so long; 0 with every word.
    fn listen(&self, silent_ms: f64);
    /// The link broke.
    fn lost(&self);
    /// There will be no link again.
    fn end(&self, end: LinkEnd);
}

#[derive(Default)]
struct PageLink {
    handler: Option<Rc<dyn LinkHandler>>,
    socket: Option<Socket>,
    /// Counts sockets, so that the late event of an old one is recognised.
    generation: u32,
    greeted: bool,
    heard_ms: f64,
    /// When the socket was opened.
    opened_ms: f64,
    tries: i32,
    asked: u32,
    /// The newest Stop that was heard of, and on which socket.
    stops: Option<(u32, u64)>,
    answers: BTreeMap<u32, OnAnyAnswer>,
    /// There will be no link again: the invitation ended, or another page has the place of this one.
    is_over: bool,
    /// The listener that hears every event before the handler does.
    ear: Option<Ear>,
    /// What comes in parts.
    assembly: Assembly,
}

thread_local! {
    static LINK: RefCell<PageLink> = RefCell::default();
}

fn with<T>(act: impl FnOnce(&mut PageLink) -> T) -> T {
    LINK.with(|link| act(&mut link.borrow_mut()))
}

/// Starts to connect, and keeps at it.
pub(crate) fn start(handler: impl LinkHandler + 'static) {
    with(|link| link.handler = Some(Rc::new(handler)));
    connect();
    let Some(window) = browser::window() else { return };
    browser::hear(&window, "online", |_| hurry());
    if let Some(document) = window.document() {
        browser::hear(&document, "visibilitychange", |_| hurry());
    }
    browser::every(LISTEN_MS, listen);
}

/// Tells for how long the server has been silent, and gives the link up after too long.
fn listen() {
    let now = browser::now_ms();
    let (silent, handler) = with(|link| {
        let silent = link.socket.is_some() && now - link.heard_ms.max(link.opened_ms) > SILENCE_MS;
        (silent, link.handler.clone().map(|handler| (handler, now - link.heard_ms)))
    });
    if silent {
        lose(with(|link| link.generation));
    }
    if let Some((handler, silent_ms)) = handler {
        handler.listen(silent_ms);
    }
}

/// From now on every event is heard here too, before the handler does.
pub(crate) fn overhear(ear: impl Fn(&Event) + 'static) {
    with(|link| link.ear = Some(Rc::new(ear)));
}

/// True when the server has greeted back.
pub(crate) fn is_up() -> bool {
    with(|link| link.greeted)
}

/// Asks; `then` is called once with the answer, also if the link breaks first. A link that is down is not asked, and nothing is
/// called. Returns whether it was sent.
pub(crate) fn ask<R: Request>(request: R, then: impl FnOnce(Result<R::Answer, NoAnswer>) + 'static) -> bool {
    is_up() && ask_written(stops(), &WrittenRequest::of(&request), typed::<R>(then))
}

/// Asks like [`ask`]; a link that is down is unreachable at once.
pub(crate) fn ask_even_down<R: Request>(request: R, then: impl FnOnce(Result<R::Answer, NoAnswer>) + 'static) {
    ask_any(&WrittenRequest::of(&request), typed::<R>(then));
}

/// Asks like [`ask_even_down`] what is written already.
pub(crate) fn ask_any(request: &WrittenRequest, then: OnAnyAnswer) {
    ask_pressed(stops(), request, then);
}

/// Asks like [`ask_any`] for what was pressed when so many Stops had been heard of: a robot that was stopped since refuses it.
pub(crate) fn ask_pressed(stops: Option<u64>, request: &WrittenRequest, then: OnAnyAnswer) {
    if is_up() {
        ask_written(stops, request, then);
    } else {
        then(Err(NoAnswer::Unreachable));
    }
}

/// Says something that is not answered.
pub(crate) fn tell<R: Request<Answer = Unanswered>>(request: R) {
    tell_written(&WrittenRequest::of(&request));
}

fn tell_written(request: &WrittenRequest) {
    if is_up() {
        send(0, stops(), request);
    }
}

/// Another answer than that of the request counts as none.
fn typed<R: Request>(then: impl FnOnce(Result<R::Answer, NoAnswer>) + 'static) -> OnAnyAnswer {
    Box::new(move |answer| then(editor::typed(answer)))
}

fn ask_written(stops: Option<u64>, request: &WrittenRequest, then: OnAnyAnswer) -> bool {
    let number = with(|link| {
        link.asked = link.asked.wrapping_add(1);
        link.answers.insert(link.asked, then);
        link.asked
    });
    let sent = send(number, stops, request);
    if !sent {
        answered(number, Err(NoAnswer::Unreachable));
    }
    sent
}

/// Calls whoever waits for this answer; false if nobody does.
fn answered(number: u32, answer: Result<AnyAnswer, NoAnswer>) -> bool {
    let then = with(|link| link.answers.remove(&number));
    let waits = then.is_some();
    if let Some(then) = then {
        then(answer);
    }
    waits
}

fn send(number: u32, stops: Option<u64>, request: &WrittenRequest) -> bool {
    let text = request.message(number, stops);
    text.len() <= protocol::MESSAGE_MAX_BYTES && with(|link| link.socket.as_ref().is_some_and(|s| s.send(&text)))
}

/// The newest Stop of which the person at this page could know, be it by the link or by the answer to their own press of Stop.
/// A request that makes a robot move is refused where one came since.
pub(crate) fn stops() -> Option<u64> {
    let own = browser::global_number(OWN_STOP);
    with(|link| {
        link.stops = with_own_stop(link.stops, own);
        link.stops.map(|(_, stops)| stops)
    })
}

/// The answer to one's own Stop counts where the server that gave it is still the one of the link. Pure.
fn with_own_stop(known: Option<(u32, u64)>, own: Option<u64>) -> Option<(u32, u64)> {
    let start_of = |stops: u64| stops / STOPS_PER_START;
    let own = |known: u64| own.filter(|own| start_of(*own) == start_of(known));
    known.map(|(of, stops)| (of, own(stops).map_or(stops, |own| own.max(stops))))
}

/// The first of a socket counts as it is, as the server may be another one; later ones may come out of order.
fn newest_stop(known: Option<(u32, u64)>, (of, stops): (u32, u64)) -> (u32, u64) {
    let before = known.filter(|known| known.0 == of).map_or(0, |known| known.1);
    (of, stops.max(before))
}

fn connect() {
    let Some(url) = browser::socket_url() else { return };
    let generation = with(|link| {
        link.generation += 1;
        link.opened_ms = browser::now_ms();
        link.generation
    });
    let socket = Socket::open(
        &url,
        move || greet(generation),
        move |text| hear(generation, text),
        move |code| closed(generation, code),
    );
    match socket {
        Some(socket) => with(|link| link.socket = Some(socket)),
        None => lose(generation),
    }
}

/// Tries at once if there is no link and there may be one.
fn hurry() {
    if with(|link| link.socket.is_none() && !link.is_over) {
        connect();
    }
}

fn greet(generation: u32) {
    if let Some(handler) = with(|link| link.handler.clone().filter(|_| link.generation == generation)) {
        let greeting = handler.greeting();
        let then = typed::<request::Hello>(move |answer| greeted(&*handler, answer));
        ask_written(stops(), &WrittenRequest::of(&greeting), then);
    }
}

/// The server greeted back, or said why not.
fn greeted(handler: &dyn LinkHandler, answer: Result<answer::Welcome, NoAnswer>) {
    match answer {
        Ok(welcome) => {
            with(|link| (link.greeted, link.tries) = (true, 0));
            handler.greeted(welcome);
        }
        Err(NoAnswer::Refused(no)) => handler.refused(&no),
        Err(NoAnswer::Unreachable) => {}
    }
}

fn hear(generation: u32, text: &str) {
    let handler = with(|link| {
        link.heard_ms = browser::now_ms();
        link.handler.clone().filter(|_| link.generation == generation)
    });
    let (Some(handler), Ok(message)) = (handler, crate::json::read::<Message>(text)) else { return };
    let message = match with(|link| link.assembly.take(message)) {
        Ok(Some(message)) => message,
        Ok(None) => return,
        Err(_) => return lose(generation),
    };
    handler.listen(0.0);
    if let Some(stops) = message.stops() {
        with(|link| link.stops = Some(newest_stop(link.stops, (generation, stops))));
    }
    match message {
        Message::Answer { ask, answer } => drop(answered(ask, Ok(answer))),
        Message::No { ask, no } => {
            if !ask.is_some_and(|ask| answered(ask, Err(NoAnswer::Refused(no.clone())))) {
                handler.refused(&no);
            }
        }
        Message::Event(event) => {
            if let Some(ear) = with(|link| link.ear.clone()) {
                ear(&event);
            }
            handler.hear(event);
        }
        // They were put together.
        Message::Records { .. } => {}
    }
}

/// The server closed the socket, or it broke.
fn closed(generation: u32, code: u16) {
    let end = match code {
        protocol::CLOSE_REVOKED => Some(LinkEnd::Revoked),
        // Coming back by itself, it would take the place back, again and again.
        protocol::CLOSE_GAVE_WAY => Some(LinkEnd::GaveWay),
        _ => None,
    };
    let handler = with(|link| link.handler.clone().filter(|_| link.generation == generation));
    if let (Some(end), Some(handler)) = (end, handler) {
        with(|link| link.is_over = true);
        handler.end(end);
    }
    lose(generation);
}

/// The socket of this generation is gone: whoever waits is told, and the next try is planned.
fn lose(generation: u32) {
    if with(|link| link.generation != generation) {
        return;
    }
    let (answers, handler, tries) = with(|link| {
        link.socket = None;
        link.greeted = false;
        link.assembly = Assembly::default();
        link.generation += 1;
        link.tries += 1;
        (std::mem::take(&mut link.answers), link.handler.clone(), link.tries)
    });
    if let Some(handler) = handler {
        handler.lost();
    }
    answers.into_values().for_each(|then| then(Err(NoAnswer::Unreachable)));
    let wait = wait_ms(tries, browser::random());
    browser::after(wait, hurry);
}

/// How long to wait before a try, with chance from 0 to 1 so that many pages do not come at once.
fn wait_ms(tries: i32, chance: f64) -> i32 {
    let [first, longest] = BACK_OFF_MS;
    let doubled = first * f64::from(1 << tries.clamp(1, 10).saturating_sub(1));
    (doubled.min(longest) * (0.6 + 0.4 * chance)) as i32
}

#[cfg(test)]
mod tests {
    use super::{newest_stop, wait_ms, with_own_stop};

    #[test]
    fn the_answer_to_ones_own_stop_counts_before_the_link_tells_of_it() {
        let known = Some((1, 7_000_002));
        assert_eq!(with_own_stop(known, Some(7_000_003)), Some((1, 7_000_003)));
        assert_eq!(with_own_stop(known, Some(7_000_001)), known, "an answer that came late");
        assert_eq!(with_own_stop(known, Some(8_000_001)), known, "of another start of the server");
        assert_eq!(with_own_stop(known, None), known);
        assert_eq!(with_own_stop(None, Some(7_000_003)), None, "the link has told of no server yet");
    }

    #[test]
    fn the_newest_stop_is_of_the_server_that_is_there_now() {
        let first = newest_stop(None, (1, 7_000_002));
        assert_eq!(first, (1, 7_000_002));
        assert_eq!(newest_stop(Some(first), (1, 7_000_001)), first, "said before, but later here");
        assert_eq!(newest_stop(Some(first), (1, 7_000_003)), (1, 7_000_003));
        assert_eq!(newest_stop(Some(first), (2, 3_000_000)), (2, 3_000_000), "a store that was put back");
    }

    #[test]
    fn waits_grow_up_to_a_bound() {
        assert_eq!(wait_ms(1, 1.0), 250);
        assert_eq!(wait_ms(4, 1.0), 2_000);
        assert_eq!(wait_ms(60, 1.0), 8_000);
        assert!(wait_ms(60, 0.0) >= 4_000);
    }
}
