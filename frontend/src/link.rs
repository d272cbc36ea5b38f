//! The link to the server: one WebSocket that comes back by itself, and the answers that are waited for.

mod socket;

use crate::browser;
use crate::desk::{Desk, LinkEnd};
use protocol::{Ask, Assembly, Message, Refused, Reply, Request};
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

/// Why there is no answer to what was asked.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum NoAnswer {
    /// The server says no.
    Refused(Refused),
    /// There is no link, or it broke.
    Unreachable,
}

/// What is done with a reply; none when the link broke before it came.
type OnReply = Box<dyn FnOnce(Option<&Reply>)>;

/// The work that is done with every message.
type Ear = Rc<dyn Fn(&Reply)>;

#[derive(Default)]
struct PageLink {
    desk: Option<Desk>,
    socket: Option<Socket>,
    /// Counts sockets, so that the late event of an old one is recognised.
    generation: u32,
    greeted: bool,
    heard_ms: f64,
    /// When the socket was opened.
    opened_ms: f64,
    tries: i32,
    asked: u32,
    answers: BTreeMap<u32, OnReply>,
    /// There will be no link again: the invitation ended, or another page has the place of this one.
    is_over: bool,
    /// The listener that hears every message before the desk does.
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
pub(crate) fn start(desk: Desk) {
    with(|link| link.desk = Some(desk));
    connect();
    let Some(window) = browser::window() else { return };
    browser::hear(&window, "online", |_| hurry());
    if let Some(document) = window.document() {
        browser::hear(&document, "visibilitychange", |_| hurry());
    }
    browser::every(LISTEN_MS, listen);
}

/// Tells the desk for how long the server has been silent, and gives the link up after too long.
fn listen() {
    let now = browser::now_ms();
    let (silent, desk) = with(|link| {
        let silent = link.socket.is_some() && now - link.heard_ms.max(link.opened_ms) > SILENCE_MS;
        (silent, link.desk.clone().map(|desk| (desk, now - link.heard_ms)))
    });
    if silent {
        lose(with(|link| link.generation));
    }
    if let Some((desk, silent_ms)) = desk {
        desk.listen(silent_ms);
    }
}

/// From now on every message is heard here too, before the desk hears it.
pub(crate) fn overhear(ear: impl Fn(&Reply) + 'static) {
    with(|link| link.ear = Some(Rc::new(ear)));
}

/// True when the server has greeted back.
pub(crate) fn is_up() -> bool {
    with(|link| link.greeted)
}

/// Asks; the answer is called once, with none if the link is down or breaks. Returns whether it was sent.
pub(crate) fn ask(request: Request, answer: impl FnOnce(Option<&Reply>) + 'static) -> bool {
    let number = with(|link| {
        link.asked = link.asked.wrapping_add(1);
        link.greeted.then_some(link.asked)
    });
    let sent = number.is_some_and(|number| {
        with(|link| link.answers.insert(number, Box::new(answer)));
        send(number, request)
    });
    if let (Some(number), false) = (number, sent)
        && let Some(answer) = with(|link| link.answers.remove(&number))
    {
        answer(None);
    }
    sent
}

/// Asks like [`ask`]; a link that is down is answered with none at once.
pub(crate) fn ask_even_down(request: Request, answer: impl FnOnce(Option<&Reply>) + 'static) {
    if is_up() {
        ask(request, answer);
    } else {
        answer(None);
    }
}

/// Says something without waiting for an answer.
pub(crate) fn tell(request: Request) {
    if is_up() {
        send(0, request);
    }
}

fn send(number: u32, request: Request) -> bool {
    let Ok(text) = serde_json::to_string(&Ask { ask: number, request }) else { return false };
    text.len() <= protocol::MESSAGE_MAX_BYTES && with(|link| link.socket.as_ref().is_some_and(|s| s.send(&text)))
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
    if let Some(desk) = with(|link| link.desk.clone().filter(|_| link.generation == generation)) {
        send(0, desk.greeting());
    }
}

fn hear(generation: u32, text: &str) {
    let desk = with(|link| {
        link.heard_ms = browser::now_ms();
        link.desk.clone().filter(|_| link.generation == generation)
    });
    let (Some(desk), Ok(message)) = (desk, crate::json::read::<Message>(text)) else { return };
    let message = match with(|link| link.assembly.take(message)) {
        Ok(Some(message)) => message,
        Ok(None) => return,
        Err(_) => return lose(generation),
    };
    if matches!(message.reply, Reply::Welcome { .. }) {
        with(|link| (link.greeted, link.tries) = (true, 0));
        desk.link_up();
    }
    desk.listen(0.0);
    let answer = message.ask.and_then(|number| with(|link| link.answers.remove(&number)));
    let unasked_no = answer.is_none();
    if let Some(answer) = answer {
        answer(Some(&message.reply));
    }
    if let Some(ear) = with(|link| link.ear.clone()) {
        ear(&message.reply);
    }
    match message.reply {
        Reply::No { no } if unasked_no => desk.say_no(&no),
        reply => desk.hear(reply),
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
    if let (Some(end), Some(desk)) = (end, with(|link| link.desk.clone().filter(|_| link.generation == generation))) {
        with(|link| link.is_over = true);
        desk.end(end);
    }
    lose(generation);
}

/// The socket of this generation is gone: whoever waits is told, and the next try is planned.
fn lose(generation: u32) {
    if with(|link| link.generation != generation) {
        return;
    }
    let (answers, desk, tries) = with(|link| {
        link.socket = None;
        link.greeted = false;
        link.assembly = Assembly::default();
        link.generation += 1;
        link.tries += 1;
        (std::mem::take(&mut link.answers), link.desk.clone(), link.tries)
    });
    if let Some(desk) = desk {
        desk.link_lost();
    }
    answers.into_values().for_each(|answer| answer(None));
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
    use super::wait_ms;

    #[test]
    fn waits_grow_up_to_a_bound() {
        assert_eq!(wait_ms(1, 1.0), 250);
        assert_eq!(wait_ms(4, 1.0), 2_000);
        assert_eq!(wait_ms(60, 1.0), 8_000);
        assert!(wait_ms(60, 0.0) >= 4_000);
    }
}
