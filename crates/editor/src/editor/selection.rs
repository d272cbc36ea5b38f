//! The choice of one thing or several, and the part of the graph that has the keyboard. Both follow the records: nothing that
//! is gone stays chosen, and what is folded away gives its place to its group.

use crate::effect::Effect;
use crate::graph::{StepDirection, walk};
use crate::{Editor, FocusTarget, Selected};
use behaviour::{FillFrom, Id, Kind, Place, Record, RecordId};
use std::collections::{BTreeMap, BTreeSet};

/// The part of the graph that has the keyboard, and where it stood then.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct KeyboardPlace {
    part: Selected,
    place: Option<Place>,
}

/// Folded groups as this page shows them.
#[derive(Debug, Default)]
pub(crate) struct Folds {
    /// Groups that are folded for everybody.
    saved: BTreeSet<Id>,
    /// Those of them that are shown open on this page.
    pub(crate) opened: BTreeSet<Id>,
}

impl Editor {
    /// Selects one thing alone, or nothing.
    pub fn select(&mut self, what: Option<Selected>) {
        self.choose(what.into_iter().filled());
    }

    /// Chooses one thing more, or one less; what is chosen alone is the first of several.
    pub fn choose_too(&mut self, what: Selected) {
        let mut these = self.chosen();
        if !these.remove(&what) {
            these.insert(what);
        }
        self.choose(these);
    }

    /// Chooses these, as far as they are there; one alone is what is selected. What is looked for is shown, whatever is folded around it, and who chooses
    /// looks around by themselves.
    pub fn choose(&mut self, mut these: BTreeSet<Selected>) {
        these.retain(|one| self.is_shown(one));
        let one = if these.len() == 1 { these.pop_first() } else { None };
        if let Some(one) = &one {
            self.unfollow();
            if let Some(group) = self.folded_away(one) {
                self.unfold_here(&group);
            }
        }
        self.selected.put(one);
        self.several.put(these);
        self.plan_presence();
    }

    /// Chooses everything that is seen: streams, connectors, notes, and folded groups for what is in them.
    pub fn choose_all(&mut self) {
        let behaviour = self.shown_behaviour();
        let parts = behaviour.records.keys().filter_map(|key| match key.kind {
            Kind::Stream => Some(Selected::Stream(key.id.clone())),
            Kind::Connector => Some(Selected::Connector(key.id.clone())),
            Kind::Note => Some(Selected::Note(key.id.clone())),
            Kind::Group | Kind::Place | Kind::Settings | Kind::Helper | Kind::Pad => None,
        });
        let seen = parts.map(|one| self.seen_as(one)).collect();
        self.choose(seen);
    }

    /// Returns what is chosen, one or several.
    #[must_use]
    pub fn chosen(&self) -> BTreeSet<Selected> {
        if self.several.is_empty() { self.selected.iter().cloned().filled() } else { (*self.several).clone() }
    }

    /// Chooses what is reached by an arrow key from `here`, or from nowhere. With `more` it is chosen beside the rest, and back
    /// over what is chosen already `here` is let go of again. Gives where the keyboard goes.
    pub fn step(&mut self, here: Option<Selected>, way: StepDirection, more: bool) -> Option<Selected> {
        let next = Selected::Stream(self.reached(here.as_ref(), way)?);
        let next = self.seen_as(next);
        let mut these = BTreeSet::new();
        if more {
            these = self.chosen();
            match here {
                Some(here) if these.contains(&next) => drop(these.remove(&here)),
                here => these.extend(here),
            }
        }
        these.insert(next.clone());
        self.choose(these);
        Some(next)
    }

    /// Returns the stream that an arrow key leads to from a stream, a connector or nowhere.
    fn reached(&mut self, here: Option<&Selected>, way: StepDirection) -> Option<Id> {
        match here {
            Some(Selected::Stream(id)) => {
                let (behaviour, places) = self.ground();
                walk(&behaviour, id, way, |id| places.get(id).copied())
            }
            Some(Selected::Connector(id)) => {
                let Some(Record::Connector(connector)) = self.shown(&RecordId::new(Kind::Connector, id)) else {
                    return None;
                };
                match way {
                    StepDirection::Down => Some(connector.output),
                    StepDirection::Up => connector.inputs.into_iter().next(),
                    StepDirection::Left | StepDirection::Right => None,
                }
            }
            Some(Selected::Note(_) | Selected::Group(_)) => None,
            None => self.first_stream(),
        }
    }

    /// Returns true if something is there, as it is shown.
    #[must_use]
    pub fn is_shown(&self, one: &Selected) -> bool {
        self.shown(&one.record()).is_some()
    }

    fn first_stream(&self) -> Option<Id> {
        self.shown_behaviour().streams_in_order().first().map(|(id, _)| (*id).clone())
    }

    /// Returns the part to which the keyboard goes on when this one is removed: what it came from.
    pub fn before_it(&mut self, what: &Selected) -> Option<Selected> {
        let before = match what {
            Selected::Stream(_) | Selected::Connector(_) => self.reached(Some(what), StepDirection::Up),
            Selected::Note(_) | Selected::Group(_) => self.first_stream(),
        };
        before.map(|id| self.seen_as(Selected::Stream(id)))
    }

    /// Returns something as it is seen: itself, or the folded group that it is in.
    #[must_use]
    pub fn seen_as(&self, one: Selected) -> Selected {
        self.folded_away(&one).map_or(one, Selected::Group)
    }

    /// Returns the folded group that something is not seen for: a connector is with the stream that it leads to.
    #[must_use]
    pub fn folded_away(&self, what: &Selected) -> Option<Id> {
        match what {
            Selected::Stream(id) => self.hidden.get(id).cloned(),
            Selected::Connector(id) => match self.shown(&RecordId::new(Kind::Connector, id)) {
                Some(Record::Connector(connector)) => self.hidden.get(&connector.output).cloned(),
                _ => None,
            },
            Selected::Note(_) | Selected::Group(_) => None,
        }
    }

    /// Shows what is in a folded group on this page, for something in it is looked for; for others it stays as it is.
    pub fn unfold_here(&mut self, id: &Id) {
        self.folds.opened.insert(id.clone());
        self.see_groups();
    }

    /// Reads which groups are folded, and what is not seen for them. What was chosen of it is given to its group.
    pub(crate) fn see_groups(&mut self) {
        let shown = self.past.as_ref().map_or_else(|| self.groups_now(), |past| past.groups().map(owned).collect());
        let saved: BTreeSet<Id> = shown.iter().filter(|(_, group)| group.folded).map(|(id, _)| id.clone()).filled();
        let folded_anew: Vec<Id> = saved.difference(&self.folds.saved).cloned().collect();
        self.folds.opened.retain(|id| !folded_anew.contains(id));
        let folded: BTreeSet<Id> = saved.difference(&self.folds.opened).cloned().filled();
        let inside = shown.iter().filter(|(id, _)| folded.contains(id));
        let hidden: BTreeMap<Id, Id> = inside
            .flat_map(|(id, group)| group.streams.iter().map(move |stream| (stream.clone(), id.clone())))
            .filled();
        self.folds.saved = saved;
        self.folded.set(folded);
        self.hidden.set(hidden);
        let chosen = self.chosen();
        let still: BTreeSet<Selected> = chosen.iter().map(|one| self.seen_as(one.clone())).filled();
        if still != chosen {
            self.choose(still);
        }
    }

    /// Tells which part of the graph has the keyboard; none if it is elsewhere.
    pub fn keyboard_at(&mut self, part: Option<Selected>) {
        self.keyboard = part.filter(|part| self.is_shown(part)).map(|part| {
            let place = self.part_place(&part);
            KeyboardPlace { part, place }
        });
    }

    /// Returns the part of the graph that has the keyboard.
    #[must_use]
    pub fn keyboard(&self) -> Option<&Selected> {
        self.keyboard.as_ref().map(|keyboard| &keyboard.part)
    }

    fn part_place(&mut self, part: &Selected) -> Option<Place> {
        match part {
            Selected::Stream(id) | Selected::Note(id) => self.stands_at(id),
            Selected::Connector(id) => match self.shown(&RecordId::new(Kind::Connector, id)) {
                Some(Record::Connector(connector)) => self.stands_at(&connector.output),
                _ => None,
            },
            Selected::Group(id) => self.shown_group(id).and_then(|group| self.box_place(id, &group)),
        }
    }

    /// Some records are others than before: nothing that is gone stays chosen or keeps the keyboard.
    pub(crate) fn follow_records(&mut self) {
        if self.news.touched.is_empty() && !self.news.is_whole {
            return;
        }
        if self.news.is_whole || self.news.touched.iter().any(|key| key.kind == Kind::Group) {
            self.see_groups();
        }
        if self.selected.as_ref().is_some_and(|one| !self.is_shown(one)) {
            self.selected.set(None);
            self.plan_presence();
        }
        if self.several.iter().any(|one| !self.is_shown(one)) {
            let still = self.several.iter().filter(|one| self.is_shown(one)).cloned().collect();
            self.several.set(still);
        }
        self.follow_keyboard();
    }

    /// The keyboard leaves what is gone or folded away: to its group, else to what stands nearest.
    fn follow_keyboard(&mut self) {
        let Some(KeyboardPlace { part, place }) = self.keyboard.clone() else { return };
        let next = if self.is_shown(&part) {
            let seen = self.seen_as(part.clone());
            if seen == part {
                return;
            }
            Some(seen)
        } else {
            self.nearest(place)
        };
        let target = next.clone().map_or(FocusTarget::Graph, FocusTarget::Part);
        self.keyboard_at(next);
        self.effect(Effect::Focus(target));
    }

    fn nearest(&mut self, to: Option<Place>) -> Option<Selected> {
        let (behaviour, places) = self.ground();
        let far = |id: &Id| {
            let (at, to) = (places.get(id)?, to?);
            Some((at.x - to.x).hypot(at.y - to.y))
        };
        let streams = behaviour.streams_in_order().into_iter().map(|(id, _)| id);
        let nearest = streams.min_by(|one, other| far(one).unwrap_or(0.0).total_cmp(&far(other).unwrap_or(0.0)));
        nearest.map(|id| self.seen_as(Selected::Stream(id.clone())))
    }
}

fn owned((id, group): (&Id, &behaviour::Group)) -> (Id, behaviour::Group) {
    (id.clone(), group.clone())
}
