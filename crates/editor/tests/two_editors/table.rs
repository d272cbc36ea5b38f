//! Two people at one program without any chance: every message arrives at once, unless a link is cut or the store holds back.

use crate::page::{Page, text_of};
use crate::server::{Server, StoreAnswer, note};
use behaviour::{Behaviour, Id};
use editor::{Announcement, Editor};
use protocol::Refused;

pub(crate) const AIKO: usize = 0;
pub(crate) const BEN: usize = 1;

pub(crate) struct Table {
    pub(crate) server: Server,
    pub(crate) pages: [Page; 2],
    sessions: u64,
    now_ms: u64,
    /// The server answers so many changes with "too fast".
    pub(crate) too_fast: usize,
}

impl Table {
    /// Both have opened the program, in which one note says "Start".
    pub(crate) fn laid() -> Self {
        let mut table = Self::with(Behaviour::default());
        table.does(AIKO, |page| page.write(0));
        table.forget();
        table
    }

    /// Both have opened a program.
    pub(crate) fn with(first: Behaviour) -> Self {
        let server = Server::new(first);
        let pages = [AIKO, BEN].map(|who| Page::new(who, &server.behaviour));
        let mut table = Self { server, pages, sessions: 0, now_ms: 0, too_fast: 0 };
        [AIKO, BEN].into_iter().for_each(|who| table.connect(who));
        table.forget();
        table
    }

    /// Somebody makes a gesture, and everything comes of it that does so at once.
    pub(crate) fn gesture<T>(&mut self, who: usize, act: impl FnOnce(&mut Editor, Id) -> T) -> T {
        self.does(who, |page| page.gesture(act))
    }

    /// The program as it is saved.
    pub(crate) fn program(&self) -> &Behaviour {
        self.server.room.behaviour()
    }

    /// Forgets what was said until now.
    pub(crate) fn forget(&mut self) {
        for page in &mut self.pages {
            page.said.clear();
            page.focused.clear();
            page.redrawn.clear();
            page.answers.clear();
        }
    }

    pub(crate) fn connect(&mut self, who: usize) {
        self.connect_and_hear(who, 0);
        self.settle();
    }

    pub(crate) fn cut(&mut self, who: usize) {
        if let Some(session) = self.pages[who].link.session {
            self.server.leave(session);
        }
        self.pages[who].lost().expect("it is told");
        self.settle();
    }

    pub(crate) fn reload(&mut self, who: usize) {
        if let Some(session) = self.pages[who].link.session {
            self.server.leave(session);
        }
        self.pages[who].reload().expect("it is loaded");
        self.settle();
    }

    /// The server dies and starts again without anybody's locks.
    pub(crate) fn restart(&mut self) {
        self.server.restart(true);
        for who in [AIKO, BEN] {
            self.pages[who].lost().expect("it is told");
            self.connect(who);
        }
    }

    /// Somebody does something, and everything comes of it that does so at once.
    pub(crate) fn does<T>(&mut self, who: usize, act: impl FnOnce(&mut Page) -> Result<T, String>) -> T {
        let done = act(&mut self.pages[who]).expect("it is done");
        self.settle();
        done
    }

    /// Time passes, and waits end.
    pub(crate) fn pass(&mut self, ms: u64) {
        self.now_ms += ms;
        self.server.tick(self.now_ms);
        for who in [AIKO, BEN] {
            self.pages[who].now_ms = self.now_ms;
            while let Some(due) = self.pages[who].timers.iter().position(|(at, _)| *at <= self.now_ms) {
                let (_, wake) = self.pages[who].timers.remove(due);
                self.does(who, |page| page.input(|editor| editor.wake(wake)));
            }
        }
        self.settle();
    }

    /// Messages go to and fro until there is nothing more to say.
    pub(crate) fn settle(&mut self) {
        loop {
            let mut is_quiet = !self.send();
            while !self.server.is_idle() {
                self.server.saved(StoreAnswer::Saved);
            }
            is_quiet &= !self.hear();
            if is_quiet {
                return;
            }
        }
    }

    /// Brings what was asked to the server. Returns true if anything was.
    pub(crate) fn send(&mut self) -> bool {
        let mut any = false;
        for who in [AIKO, BEN] {
            for (ask, request) in std::mem::take(&mut self.pages[who].link.outbox) {
                any = true;
                let Some(session) = self.pages[who].link.session else { continue };
                let is_change = matches!(request, protocol::AnyRequest::Propose(_) | protocol::AnyRequest::TakeBack(_));
                if is_change && self.too_fast > 0 {
                    self.too_fast -= 1;
                    let no = protocol::Message::No { ask: Some(ask), no: Refused::TooFast };
                    self.server.said.push((session, no));
                } else {
                    self.server.hear(session, ask, request);
                }
            }
        }
        any
    }

    /// Brings what the server said to everybody. Returns true if it said anything.
    pub(crate) fn hear(&mut self) -> bool {
        let said = std::mem::take(&mut self.server.said);
        let any = !said.is_empty();
        for (session, message) in said {
            if let Some(page) = self.pages.iter_mut().find(|page| page.link.session == Some(session)) {
                page.hear(message).expect("it is heard");
            }
        }
        any
    }

    /// Makes a link and lets messages go to and fro only so many times.
    pub(crate) fn connect_and_hear(&mut self, who: usize, times: usize) {
        self.sessions += 1;
        self.server.connect(self.sessions, who);
        self.pages[who].greeted(self.sessions).expect("it is told");
        for _ in 0..times {
            self.send();
            self.hear();
        }
    }

    /// The text of the note as this person's page shows it.
    pub(crate) fn shown(&self, who: usize) -> Option<String> {
        text_of(self.pages[who].editor.record(&note(0)).as_ref()).map(str::to_owned)
    }

    /// The text of the note as it is saved.
    pub(crate) fn saved(&self) -> Option<String> {
        text_of(self.server.room.behaviour().records.get(&note(0))).map(str::to_owned)
    }

    pub(crate) fn said(&mut self, who: usize) -> Vec<Announcement> {
        std::mem::take(&mut self.pages[who].said)
    }

    pub(crate) fn editor(&self, who: usize) -> &Editor {
        &self.pages[who].editor
    }

    /// The number of requests that wait to go to the server and want an answer.
    pub(crate) fn asked(&self, who: usize) -> usize {
        self.pages[who].link.outbox.iter().filter(|(ask, _)| *ask > 0).count()
    }

    /// Types into the note, and says that it is done.
    pub(crate) fn types(&mut self, who: usize) {
        let there = self.server.room.behaviour().clone();
        self.does(who, |page| page.type_on(&there));
    }
}
