//! The list of everything that can be done: with its key, who may do it, what has to be there for it, and in which menus it
//! stands. What each is called and how it is done is the page's.

use protocol::Role;

/// One thing that can be done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[expect(missing_docs, reason = "each is called what it does")]
pub enum Command {
    Start,
    Apply,
    Record,
    Stimulate,
    StopThisRobot,
    StopAllRobots,
    AddRobot,
    RenameRobot,
    RemoveThisRobot,
    LoadProgram,
    AddProgram,
    RenameProgram,
    RemoveProgram,
    MakeCopy,
    OpenFile,
    SaveFile,
    EditTiles,
    PrintProgram,
    Undo,
    Redo,
    ShowExercise,
    TakeTour,
    AddSensor,
    AddHelper,
    EditHelper,
    Problems,
    Edit,
    Rename,
    FoldOrUnfold,
    MakeGroup,
    Ungroup,
    AddNote,
    LineUpRow,
    LineUpColumn,
    Connect,
    AddConnector,
    InsertBefore,
    Remove,
    SelectAll,
    Copy,
    Cut,
    Paste,
    Duplicate,
    WalkDown,
    WalkUp,
    WalkLeft,
    WalkRight,
    FindOrAdd,
    ZoomIn,
    ZoomOut,
    Fit,
    RealSize,
    FoldSentences,
    Tidy,
    OverTime,
    Recordings,
    Operate,
    OtherLanguage,
    KeysAndGestures,
    PeopleHere,
    MyName,
    Invite,
    /// Opens the panel of this name. Panels are the page's, and so are the rows of these.
    Panel(&'static str),
}

/// The subjects of commands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum CommandGroup {
    /// Of robots and what runs.
    Robot,
    /// Of programs.
    Program,
    /// Of what is in a program.
    Graph,
    /// Of what is seen.
    View,
    /// Of people.
    People,
}

/// The things that a menu is about: something on the canvas, or, in the bar, the programs, or all that a phone has no buttons
/// for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum On {
    /// The programs, in the bar of a tablet.
    Programs,
    /// The bar of a phone.
    Phone,
    /// The paper.
    Ground,
    /// A stream.
    Stream,
    /// A connector.
    Connector,
    /// A note.
    Note,
    /// A group.
    Group,
    /// Several things that are chosen.
    Several,
}

/// The things that must be there to do a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Needs {
    /// Nothing.
    Nothing,
    /// An open program.
    OpenProgram,
    /// A change of one's own, or a program that was removed.
    SomethingToUndo,
    /// A change that was taken back.
    SomethingToRedo,
}

/// All that is known of a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CommandSpec {
    /// The command.
    pub command: Command,
    /// The subject under which it stands.
    pub group: CommandGroup,
    /// The keys as they are pressed, parted by blanks; empty if it has none.
    pub keys: &'static str,
    /// The least role of who may do it.
    pub role: Role,
    /// The menus in which it stands.
    pub on: &'static [On],
    /// The thing that must be there besides.
    pub needs: Needs,
    /// True if it is about how the graph lies, so that the list in its place has no use for it.
    pub on_graph: bool,
}

/// The state of a page as far as commands depend on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CommandState {
    /// The role of who is here; none before the server said so, which decides itself then.
    pub role: Option<Role>,
    /// True while a moment of the past is shown, in which nothing is edited.
    pub is_past: bool,
    /// True while a program is open.
    pub is_open: bool,
    /// True if there is something to take back.
    pub can_undo: bool,
    /// True if there is something to do again.
    pub can_redo: bool,
}

impl CommandSpec {
    const fn on(self, on: &'static [On]) -> Self {
        Self { on, ..self }
    }

    const fn needs(self, needs: Needs) -> Self {
        Self { needs, ..self }
    }

    const fn on_graph(self) -> Self {
        Self { on_graph: true, ..self }
    }

    /// Returns true if there is what it needs, and who is here may do it.
    #[must_use]
    pub fn is_allowed(&self, state: &CommandState) -> bool {
        let is_there = match self.needs {
            Needs::Nothing => true,
            Needs::OpenProgram => state.is_open,
            Needs::SomethingToUndo => state.can_undo,
            Needs::SomethingToRedo => state.can_redo,
        };
        let edits_past = self.role == Role::Editor && state.is_past;
        is_there && !edits_past && state.role.is_none_or(|role| role >= self.role)
    }
}

const fn row(command: Command, group: CommandGroup, keys: &'static str, role: Role) -> CommandSpec {
    CommandSpec { command, group, keys, role, on: &[], needs: Needs::Nothing, on_graph: false }
}

/// The menus of all that can be copied.
const COPIED: &[On] = &[On::Stream, On::Note, On::Group, On::Several];

/// About programs: in the bar of a tablet and of a phone.
const PROGRAMS: &[On] = &[On::Programs, On::Phone];

/// All of them, group by group.
pub static ALL: &[CommandSpec] = &[
    row(Command::Start, CommandGroup::Robot, "", Role::Operator),
    row(Command::Apply, CommandGroup::Robot, "", Role::Operator),
    row(Command::Record, CommandGroup::Robot, "", Role::Operator),
    row(Command::Stimulate, CommandGroup::Robot, "", Role::Operator).on(&[On::Stream]),
    row(Command::StopThisRobot, CommandGroup::Robot, "Esc Esc", Role::Viewer),
    row(Command::StopAllRobots, CommandGroup::Robot, "", Role::Viewer),
    row(Command::AddRobot, CommandGroup::Robot, "", Role::Editor),
    row(Command::RenameRobot, CommandGroup::Robot, "", Role::Operator),
    row(Command::RemoveThisRobot, CommandGroup::Robot, "", Role::Operator),
    row(Command::LoadProgram, CommandGroup::Program, "", Role::Viewer).on(PROGRAMS),
    row(Command::AddProgram, CommandGroup::Program, "", Role::Editor).on(PROGRAMS),
    row(Command::RenameProgram, CommandGroup::Program, "", Role::Editor).needs(Needs::OpenProgram),
    row(Command::RemoveProgram, CommandGroup::Program, "", Role::Editor).on(PROGRAMS).needs(Needs::OpenProgram),
    row(Command::MakeCopy, CommandGroup::Program, "", Role::Editor).needs(Needs::OpenProgram),
    row(Command::OpenFile, CommandGroup::Program, "", Role::Editor).on(PROGRAMS),
    row(Command::SaveFile, CommandGroup::Program, "", Role::Viewer).on(PROGRAMS).needs(Needs::OpenProgram),
    row(Command::EditTiles, CommandGroup::Program, "", Role::Editor).on(PROGRAMS).needs(Needs::OpenProgram),
    row(Command::PrintProgram, CommandGroup::Program, "Ctrl P", Role::Viewer),
    row(Command::Undo, CommandGroup::Program, "Ctrl Z", Role::Editor)
        .on(&[On::Ground, On::Phone])
        .needs(Needs::SomethingToUndo),
    row(Command::Redo, CommandGroup::Program, "Ctrl Y", Role::Editor)
        .on(&[On::Ground, On::Phone])
        .needs(Needs::SomethingToRedo),
    row(Command::ShowExercise, CommandGroup::Program, "", Role::Viewer),
    row(Command::TakeTour, CommandGroup::Program, "", Role::Editor),
    row(Command::AddSensor, CommandGroup::Graph, "", Role::Editor)
        .on(&[On::Ground, On::Phone])
        .needs(Needs::OpenProgram),
    row(Command::AddHelper, CommandGroup::Graph, "", Role::Editor).on(&[On::Phone]),
    row(Command::EditHelper, CommandGroup::Graph, "", Role::Viewer).on(&[On::Phone]),
    row(Command::Problems, CommandGroup::Graph, "", Role::Viewer).on(&[On::Ground, On::Phone]),
    row(Command::Edit, CommandGroup::Graph, "Enter", Role::Viewer).on(&[On::Stream, On::Connector, On::Note]),
    row(Command::Rename, CommandGroup::Graph, "F2", Role::Editor).on(&[On::Stream, On::Connector, On::Group]),
    row(Command::FoldOrUnfold, CommandGroup::Graph, "F", Role::Viewer).on(&[On::Group]).on_graph(),
    row(Command::MakeGroup, CommandGroup::Graph, "Ctrl G", Role::Editor).on(&[On::Stream, On::Several]),
    row(Command::Ungroup, CommandGroup::Graph, "Ctrl Shift G", Role::Editor).on(&[On::Group, On::Several]),
    row(Command::AddNote, CommandGroup::Graph, "N", Role::Editor).on(&[On::Ground]).on_graph(),
    row(Command::LineUpRow, CommandGroup::Graph, "", Role::Editor).on(&[On::Several]).on_graph(),
    row(Command::LineUpColumn, CommandGroup::Graph, "", Role::Editor).on(&[On::Several]).on_graph(),
    row(Command::Connect, CommandGroup::Graph, "C", Role::Editor).on(&[On::Stream]).on_graph(),
    row(Command::AddConnector, CommandGroup::Graph, "", Role::Editor).on(&[On::Stream]).on_graph(),
    row(Command::InsertBefore, CommandGroup::Graph, "I", Role::Editor).on(&[On::Stream, On::Connector]).on_graph(),
    row(Command::Remove, CommandGroup::Graph, "Delete", Role::Editor).on(&[
        On::Stream,
        On::Connector,
        On::Note,
        On::Group,
        On::Several,
    ]),
    row(Command::SelectAll, CommandGroup::Graph, "Ctrl A", Role::Viewer).on(&[On::Ground]),
    row(Command::Copy, CommandGroup::Graph, "Ctrl C", Role::Viewer).on(COPIED),
    row(Command::Cut, CommandGroup::Graph, "Ctrl X", Role::Editor).on(COPIED),
    row(Command::Paste, CommandGroup::Graph, "Ctrl V", Role::Editor).on(&[On::Ground]),
    row(Command::Duplicate, CommandGroup::Graph, "Ctrl D", Role::Editor).on(COPIED),
    row(Command::WalkDown, CommandGroup::Graph, "↓", Role::Viewer).on_graph(),
    row(Command::WalkUp, CommandGroup::Graph, "↑", Role::Viewer).on_graph(),
    row(Command::WalkLeft, CommandGroup::Graph, "←", Role::Viewer).on_graph(),
    row(Command::WalkRight, CommandGroup::Graph, "→", Role::Viewer).on_graph(),
    row(Command::FindOrAdd, CommandGroup::View, "Ctrl F", Role::Viewer),
    row(Command::ZoomIn, CommandGroup::View, "+", Role::Viewer).on_graph(),
    row(Command::ZoomOut, CommandGroup::View, "-", Role::Viewer).on_graph(),
    row(Command::Fit, CommandGroup::View, "0", Role::Viewer).on(&[On::Ground]).on_graph(),
    row(Command::RealSize, CommandGroup::View, "1", Role::Viewer).on_graph(),
    row(Command::FoldSentences, CommandGroup::View, "", Role::Viewer),
    row(Command::Tidy, CommandGroup::View, "", Role::Editor).on(&[On::Ground]).on_graph(),
    row(Command::OverTime, CommandGroup::View, "L", Role::Viewer).on(&[On::Programs, On::Phone, On::Stream]),
    row(Command::Recordings, CommandGroup::View, "", Role::Viewer).on(PROGRAMS),
    row(Command::Operate, CommandGroup::View, "", Role::Viewer).on(&[On::Phone]),
    row(Command::OtherLanguage, CommandGroup::View, "", Role::Viewer).on(&[On::Phone]),
    row(Command::KeysAndGestures, CommandGroup::View, "Ctrl K", Role::Viewer).on(&[On::Phone]),
    row(Command::PeopleHere, CommandGroup::People, "", Role::Viewer),
    row(Command::MyName, CommandGroup::People, "", Role::Viewer),
    row(Command::Invite, CommandGroup::People, "", Role::Host).on(&[On::Phone]),
];

#[cfg(test)]
mod tests {
    use super::{ALL, Command, CommandState, On};
    use crate::keys::{KeyPress, graph_chord, graph_key};
    use protocol::Role;
    use std::collections::BTreeSet;

    fn allowed(state: CommandState) -> BTreeSet<Command> {
        ALL.iter().filter(|spec| spec.is_allowed(&state)).map(|spec| spec.command).collect()
    }

    fn state(role: Option<Role>) -> CommandState {
        CommandState { role, is_past: false, is_open: true, can_undo: true, can_redo: true }
    }

    #[test]
    fn every_command_is_listed_once_and_no_key_means_two() {
        let commands: BTreeSet<Command> = ALL.iter().map(|spec| spec.command).collect();
        let keys: Vec<&str> = ALL.iter().map(|spec| spec.keys).filter(|keys| !keys.is_empty()).collect();
        assert_eq!(commands.len(), ALL.len());
        assert_eq!(keys.iter().collect::<BTreeSet<_>>().len(), keys.len(), "{keys:?}");
    }

    #[test]
    fn each_role_may_do_what_the_one_below_may_and_more() {
        let roles = [Role::Viewer, Role::Operator, Role::Editor, Role::Host];
        let all = roles.map(|role| allowed(state(Some(role))));
        for pair in all.windows(2) {
            assert!(pair[0].is_subset(&pair[1]) && pair[0].len() < pair[1].len(), "{pair:?}");
        }
        assert_eq!((all[3].len(), allowed(state(None)).len()), (ALL.len(), ALL.len()));
        assert!(all[0].contains(&Command::StopThisRobot), "everybody stops");
        assert!(!all[0].contains(&Command::Start) && !all[1].contains(&Command::Undo));
        let past = allowed(CommandState { is_past: true, ..state(Some(Role::Host)) });
        assert!(
            !past.contains(&Command::Paste) && past.contains(&Command::Copy) && past.contains(&Command::StopThisRobot)
        );
    }

    #[test]
    fn without_an_open_program_or_something_to_take_back_there_is_less() {
        let host = state(Some(Role::Host));
        let (none, nothing) = (CommandState { is_open: false, ..host }, CommandState { can_undo: false, ..host });
        let missing = |now: CommandState| allowed(host).difference(&allowed(now)).copied().collect::<BTreeSet<_>>();
        assert_eq!(missing(nothing), [Command::Undo].into());
        assert_eq!(missing(CommandState { can_redo: false, ..host }), [Command::Redo].into());
        assert!(missing(none).is_superset(&[Command::SaveFile, Command::AddSensor, Command::RenameProgram].into()));
        assert!(!missing(none).contains(&Command::LoadProgram));
    }

    #[test]
    fn what_a_key_says_beside_a_command_is_what_it_does_on_the_graph() {
        for spec in ALL.iter().filter(|spec| spec.on_graph && !spec.keys.is_empty()) {
            let key = match spec.keys {
                "↓" => "ArrowDown",
                "↑" => "ArrowUp",
                "←" => "ArrowLeft",
                "→" => "ArrowRight",
                key => key,
            };
            assert!(graph_key(KeyPress { key, shift: false, on_button: false }).is_some(), "{key}");
        }
        for key in ["A", "C", "X", "V", "D", "G"] {
            let listed = |spec: &&super::CommandSpec| spec.keys == format!("Ctrl {key}");
            let spec = ALL.iter().find(listed).expect("it is listed");
            let looks = graph_chord(key, false, false).is_some();
            assert_eq!((graph_chord(key, false, true).is_some(), looks), (true, spec.role == Role::Viewer), "{key}");
        }
    }

    #[test]
    fn every_menu_has_something_in_it() {
        use On::{Connector, Ground, Group, Note, Phone, Programs, Several, Stream};
        for on in [Programs, Phone, Ground, Stream, Connector, Note, Group, Several] {
            assert!(ALL.iter().filter(|spec| spec.on.contains(&on)).count() >= 3, "{on:?}");
        }
    }
}
