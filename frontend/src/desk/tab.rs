//! The state of this tab alone: how the link is, who sits here, the open dialog and the last sentence.

use super::{CarriedItem, Pasted};
use crate::link::{self, LinkEnd, NoAnswer, WrittenRequest};
use crate::{browser, words};
use editor::FocusTarget;
pub(crate) use editor::LinkState;
use editor::graph::{Gap, NewSpot};

use behaviour::Id;
use behaviour::connectors::Spec;
use leptos::prelude::*;
use protocol::{AnyAnswer, Invitation, Person, Refused, Request, RequestAnswer, Role};
use std::ops::Deref;
use std::sync::Arc;

/// The time until something that could not be done just now is asked again.
pub(super) const AGAIN_MS: i32 = 1_000;

/// Something of the graph to choose from a list, where the graph is shown.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum GraphChoice {
    /// An action for this stream.
    Action(Id),
    /// The gap between a stream and a connector that takes from it.
    Into(Gap),
    /// The streams to which the values of this stream shall go too.
    Ends(Id),
    /// From where this stream gets its values.
    Sources(Id),
}

/// The open dialog.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Dialog {
    /// The thesis's Operation dialog: a new connector out of `input`, or the existing `connector`. `kind` is the one
    /// that is chosen at first; a new one goes to `spot`.
    Operation { input: Id, connector: Option<Id>, kind: &'static Spec, spot: NewSpot },
    /// Choosing what comes next at a place of the graph.
    Choose(GraphChoice),
    /// Name and parameters of a stream.
    EditStream(Id),
    /// Choosing a sense.
    AddSensor,
    /// Finding or adding anything, where the left list is not shown.
    Find,
    /// A helper of the library, or a new one.
    Helper(Option<Id>),
    /// Choosing which helper to edit.
    Helpers,
    /// Load program.
    Programs,
    /// Save as file.
    SaveFile,
    /// Add a program.
    AddProgram,
    /// Remove the open program.
    RemoveProgram,
    /// Rename the open program.
    RenameProgram,
    /// Opening a whole program that was pasted, as a text.
    OpenPasted(Pasted),
    /// The tiles of the operator's page.
    Tiles,
    /// Sending a value to a sensor stream by hand.
    Stimulate(Id),
    /// A change of one's own, by its name, beside what somebody else saved.
    Conflict(Id),
    /// The changes that wait to be sent.
    Waiting,
    /// All problems.
    Problems,
    /// Adding a simulated robot.
    AddRobot,
    /// Adding a real robot.
    AddRealRobot,
    /// Giving the robot that this tab looks at another address.
    ChangeAddress,
    /// Giving the robot that this tab looks at another name.
    RenameRobot,
    /// Removing the robot that this tab looks at.
    RemoveRobot,
    /// Having the robot that this tab looks at forget faces.
    ForgetFaces,
    /// The name that others see.
    MyName,
    /// Everyone who is here.
    People,
    /// Letting others in.
    Invite,
    /// Keys and gestures.
    Help,
}

/// The part of the address that names a recording to look back on, before its name.
pub(crate) const PAST_QUERY: &str = "past=";

/// The part of the address of the page with the graph that opens the tiles of its program.
pub(crate) const TILES_QUERY: &str = "tiles";

/// A past on which somebody looks back.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum OpenPast {
    /// The recording that the address of the page names.
    Address,
    /// The running program, with the lane of this stream.
    Running(Option<Id>),
    /// The past at which somebody else looks, who is [`TabFields::looks_with`].
    Theirs,
}

/// One sentence for the person.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Notice {
    /// Grows with every notice, so that the same sentence twice is two notices.
    pub(crate) number: u32,
    pub(crate) text: String,
    /// True for refusals and faults.
    pub(crate) bad: bool,
    /// A program in the bin that can be brought back.
    pub(crate) gone: Option<Gone>,
}

/// A program that was moved to the bin just now.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Gone {
    pub(crate) id: Id,
    pub(crate) name: String,
}

/// This tab. A clone is the same tab.
#[derive(Clone, Default)]
pub(crate) struct Tab(Arc<TabFields>);

/// The state of the tab that the page shows.
#[derive(Default)]
pub(crate) struct TabFields {
    pub(crate) online: ArcRwSignal<LinkState>,
    /// For how many seconds nothing was heard from the server, if that is too long to claim anything.
    pub(crate) unheard: ArcRwSignal<Option<u32>>,
    /// The start of the server that greeted last; 0 before any did. Its runs are counted from it.
    pub(crate) epoch: ArcRwSignal<u64>,
    pub(crate) me: ArcRwSignal<Option<Person>>,
    /// The role of this person, once the server said so.
    pub(crate) role: ArcRwSignal<Option<Role>>,
    /// The invitations, newest first; only who may invite hears of them.
    pub(crate) invitations: ArcRwSignal<Vec<Invitation>>,
    /// The reason why there will be no link again, once that is so.
    pub(crate) ended: ArcRwSignal<Option<LinkEnd>>,
    /// True if this person has not said yet what the others shall see as their name.
    pub(crate) name_wanted: ArcRwSignal<bool>,
    pub(crate) dialog: ArcRwSignal<Option<Dialog>>,
    /// True while a tile is written that is not sent yet: nothing takes the place of its dialog.
    pub(crate) writes_tile: ArcRwSignal<bool>,
    pub(crate) notice: ArcRwSignal<Option<Notice>>,
    /// The past on which somebody looks back, while they do.
    pub(crate) past: ArcRwSignal<Option<OpenPast>>,
    /// The person with whom this one looks back, while they do.
    pub(crate) looks_with: ArcRwSignal<Option<Id>>,
    /// The moment that the graph shows in place of now, in milliseconds since Start.
    pub(crate) then: ArcRwSignal<Option<u64>>,
    /// The words that only screen readers are told, as everybody else sees it.
    pub(crate) whisper: ArcRwSignal<String>,
    /// A choice that is to be offered where the graph is shown.
    pub(crate) asked: ArcRwSignal<Option<GraphChoice>>,
    /// The thing that a hand takes out of the left list.
    pub(crate) carried: ArcRwSignal<Option<CarriedItem>>,
    /// The program of which the exercise is put away.
    pub(crate) put_away: ArcRwSignal<Option<Id>>,
    /// At which step of the tour this person is, while they take it.
    pub(crate) tour: ArcRwSignal<Option<usize>>,
    /// The panel that is open in the right column, by its name in the list of panels.
    pub(crate) panel: ArcRwSignal<Option<&'static str>>,
    /// True if the keyboard goes to the graph as soon as the program is there that somebody here has chosen.
    pub(crate) to_graph: ArcRwSignal<bool>,
    /// The program that this tab asked to be removed, until that is answered.
    pub(super) removing: ArcRwSignal<Option<Id>>,
    /// The part that gets the keyboard, as the one that had it is gone.
    pub(crate) keyboard: ArcRwSignal<Option<FocusTarget>>,
    /// True if the page is being printed: all of the graph is shown then.
    pub(crate) printing: ArcRwSignal<bool>,
}

impl Deref for Tab {
    type Target = TabFields;
    fn deref(&self) -> &TabFields {
        &self.0
    }
}

impl Tab {
    /// Shows one sentence; `bad` for refusals and faults.
    pub(crate) fn say(&self, text: &str, bad: bool) {
        self.say_and_offer(text, bad, None);
    }

    /// Shows that a program is gone, and offers to bring it back.
    pub(super) fn say_gone(&self, text: &str, gone: Gone) {
        self.say_and_offer(text, false, Some(gone));
    }

    fn say_and_offer(&self, text: &str, bad: bool, gone: Option<Gone>) {
        let number = self.notice.with_untracked(|now| now.as_ref().map_or(0, |notice| notice.number)) + 1;
        self.notice.set(Some(Notice { number, text: text.to_owned(), bad, gone }));
    }

    /// Forgets good news of a link that was there, as they are not true any more.
    pub(super) fn forget_good_news(&self) {
        if self.notice.with_untracked(|notice| notice.as_ref().is_some_and(|notice| !notice.bad)) {
            self.notice.set(None);
        }
    }

    /// Shows what follows from something that is being refused just now: after the reason, where one is shown.
    pub(super) fn say_beside_reason(&self, text: String) {
        let number = |notice: &Option<Notice>| notice.as_ref().map_or(0, |notice| notice.number);
        let (tab, before) = (self.clone(), self.notice.with_untracked(number));
        browser::after(0, move || {
            let reason = tab.notice.get_untracked().filter(|notice| notice.bad && notice.number > before);
            let text = reason.map_or(text.clone(), |reason| words::one_after_other(&reason.text, &text));
            tab.say(&text, true);
        });
    }

    /// Shows why something was not done.
    pub(crate) fn say_no(&self, no: &Refused) {
        let only_looks = matches!(no, Refused::Role(Role::Editor)) && untrack(|| self.is_then());
        let why = if only_looks { words::only_look_back().to_owned() } else { words::told_by(no) };
        self.say(&why, true);
    }

    /// Shows a refusal as a notice.
    pub(crate) fn say_refusal(&self, answer: Result<(), Refused>) {
        if let Err(no) = answer {
            self.say_no(&no);
        }
    }

    pub(super) fn say_unreachable(&self) {
        self.say(words::unreachable(), true);
    }

    /// Asks something; a no, or a missing link, is shown as a notice.
    pub(super) fn ask_or_say<R: Request>(&self, request: R, on_yes: impl FnOnce(R::Answer) + 'static) {
        self.ask_or_say_as_of(link::stops(), request, on_yes);
    }

    /// Asks for what was pressed when so many Stops had been heard of; a no, or a missing link, is shown as a notice.
    pub(super) fn ask_or_say_as_of<R: Request>(
        &self,
        stops: Option<u64>,
        request: R,
        on_yes: impl FnOnce(R::Answer) + 'static,
    ) {
        let on_any = move |any| R::Answer::of(any).map(on_yes).is_some();
        self.ask_any_or_say(stops, &WrittenRequest::of(&request), Box::new(on_any));
    }

    /// Asks for something of which only a no, or a missing link, is shown.
    pub(super) fn ask_or_say_no(&self, request: impl Request) {
        self.ask_any_or_say_no(&WrittenRequest::of(&request));
    }

    fn ask_any_or_say_no(&self, request: &WrittenRequest) {
        self.ask_any_or_say(link::stops(), request, Box::new(|_| true));
    }

    /// Asks; `on_yes` tells whether it was the answer to that.
    fn ask_any_or_say(&self, stops: Option<u64>, request: &WrittenRequest, on_yes: Box<dyn FnOnce(AnyAnswer) -> bool>) {
        let tab = self.clone();
        let then = move |answer: Result<AnyAnswer, NoAnswer>| match answer {
            Ok(any) => {
                if !on_yes(any) {
                    tab.say_unreachable();
                }
            }
            Err(why) => tab.say_no_answer(why),
        };
        link::ask_pressed(stops, request, Box::new(then));
    }

    /// Shows why there is no answer.
    pub(super) fn say_no_answer(&self, why: NoAnswer) {
        match why {
            NoAnswer::Refused(no) => self.say_no(&no),
            NoAnswer::Unreachable => self.say_unreachable(),
        }
    }

    /// Asks something that changes nothing; a no or a missing link is answered with that.
    pub(crate) fn look_up<R: Request>(&self, request: R, then: impl FnOnce(Result<R::Answer, NoAnswer>) + 'static) {
        link::ask_even_down(request, then);
    }

    /// The name of who sits here, empty before the server has greeted back.
    pub(super) fn my_name(&self) -> String {
        self.me.with_untracked(|me| me.as_ref().map_or_else(String::new, |me| me.name.clone()))
    }
}

/// Sets a signal only if that changes something, so that nothing is drawn twice.
pub(super) fn set_if_new<T: PartialEq + Send + Sync + 'static>(signal: &ArcRwSignal<T>, value: T) {
    if signal.with_untracked(|now| *now != value) {
        signal.set(value);
    }
}

/// Returns the result of `compute` as a signal that tells only of other values. Thousands may follow it: a memo would
/// ask each of them anew whenever something changes that it is made of.
pub(crate) fn settled<T: PartialEq + Send + Sync + 'static>(
    compute: impl Fn() -> T + Send + Sync + 'static,
) -> ArcRwSignal<T> {
    let settled = ArcRwSignal::new(untrack(&compute));
    let signal = settled.clone();
    Effect::new(move |_| set_if_new(&signal, compute()));
    settled
}

pub(crate) fn new_id() -> Id {
    Id::from_uuid(uuid::Uuid::new_v4())
}
