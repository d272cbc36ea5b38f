//! A behaviour as the server has it, kept by what the server tells.

use super::NoLink;
use behaviour::{Accepted, Behaviour, Id};
use protocol::{AnyAnswer, Event, LIBRARY, Message, RobotState, answer};

/// One behaviour at one revision.
#[derive(Clone, Debug, PartialEq)]
pub struct Mirror {
    /// The id of the behaviour.
    pub behaviour: Id,
    /// The revision of the behaviour.
    pub revision: u64,
    /// The records of the behaviour.
    pub records: Behaviour,
}

/// The open behaviour, the library and the robots.
#[derive(Clone, Debug)]
pub(super) struct Mirrors {
    pub(super) open: Option<Mirror>,
    pub(super) library: Mirror,
    pub(super) robots: Vec<RobotState>,
}

impl Mirrors {
    pub(super) fn empty() -> Result<Self, NoLink> {
        let behaviour = Id::new(LIBRARY).map_err(|reason| NoLink::Id(reason.to_string()))?;
        let library = Mirror { behaviour, revision: 0, records: Behaviour::default() };
        Ok(Self { open: None, library, robots: Vec::new() })
    }

    /// Takes over what a message says of them.
    pub(super) fn hear(&mut self, message: &Message) {
        match message {
            Message::Answer { answer, .. } => self.hear_answer(answer),
            Message::Event(event) => self.hear_event(event),
            Message::No { .. } | Message::Records { .. } => {}
        }
    }

    fn hear_answer(&mut self, answer: &AnyAnswer) {
        match answer {
            AnyAnswer::Welcome(answer::Welcome { library, library_revision, .. }) => {
                self.library.records = (**library).clone();
                self.library.revision = *library_revision;
            }
            AnyAnswer::Opened(answer::Opened { behaviour, revision, records, .. }) => {
                let (behaviour, records) = (behaviour.clone(), (**records).clone());
                self.open = Some(Mirror { behaviour, revision: *revision, records });
            }
            AnyAnswer::Missed(answer::Missed { behaviour, changes, .. }) => {
                changes.iter().for_each(|change| self.accept(behaviour, change))
            }
            _ => {}
        }
    }

    fn hear_event(&mut self, event: &Event) {
        match event {
            Event::Robots { robots } => self.robots.clone_from(robots),
            Event::Accepted { behaviour, accepted } => self.accept(behaviour, accepted),
            Event::Removed { behaviour, .. } if self.open.as_ref().is_some_and(|open| open.behaviour == *behaviour) => {
                self.open = None;
            }
            _ => {}
        }
    }

    /// Only the next revision is taken: one that came before changes nothing.
    fn accept(&mut self, behaviour: &Id, accepted: &Accepted) {
        for mirror in self.open.iter_mut().chain([&mut self.library]) {
            if mirror.behaviour == *behaviour && accepted.revision == mirror.revision + 1 {
                mirror.records.apply(&accepted.change);
                mirror.revision = accepted.revision;
            }
        }
    }

    /// Returns what a ping, or a page of missed changes with more behind it, shows to be missing: the behaviour and the
    /// last revision known.
    pub(super) fn missing(&self, message: &Message) -> Vec<(Id, u64)> {
        if let Message::Answer { answer: AnyAnswer::Missed(answer::Missed { behaviour, more: true, .. }), .. } = message
        {
            let known = self.open.iter().chain([&self.library]).find(|mirror| mirror.behaviour == *behaviour);
            return known.map(|mirror| (behaviour.clone(), mirror.revision)).into_iter().collect();
        }
        let Message::Event(Event::Ping { behaviour, library_revision }) = message else { return Vec::new() };
        let library = (&self.library.behaviour, *library_revision);
        let told = behaviour.iter().map(|(id, revision)| (id, *revision)).chain([library]);
        let behind = told.filter_map(|(id, revision)| {
            let mirror = self.open.iter().chain([&self.library]).find(|mirror| mirror.behaviour == *id)?;
            (mirror.revision < revision).then(|| (id.clone(), mirror.revision))
        });
        behind.collect()
    }
}
