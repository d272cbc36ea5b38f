//! Everything that can be done, with its key: what the palette of commands and the help list.

use crate::desk::{Desk, Dialog, LineUp, OpenPast, Selected};
use crate::keys::PressedKey;
use crate::{panels, words};
use behaviour::StreamKind;
use leptos::prelude::*;
use protocol::Role;
use wasm_bindgen::JsCast;
use web_sys::{HtmlElement, KeyboardEvent, KeyboardEventInit};

/// A moment for all of the graph to be in the page before it is printed, in milliseconds.
const PRINTS_MS: i32 = 120;

/// One thing that can be done.
pub(crate) struct PageCommand {
    pub(crate) group: CommandGroup,
    pub(crate) label: fn() -> &'static str,
    /// Its keys as they are pressed, parted by blanks; empty if it has none.
    pub(crate) keys: &'static str,
    /// What a person must be allowed at least.
    pub(crate) role: Role,
    /// In whose menus it stands.
    pub(crate) on: &'static [On],
    /// What must be there besides, to do it.
    needs: Needs,
    /// Its sign in menus that have signs.
    pub(crate) icon: &'static str,
    /// Whether it is about how the graph lies, so that the list in its place has no use for it.
    needs_graph: bool,
    act: CommandWork,
}

/// What must be there to do a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Needs {
    Nothing,
    OpenProgram,
    SomethingToUndo,
    SomethingToRedo,
}

/// What a menu is about: something on the canvas, or, in the bar, the programs, or all that a phone has no buttons for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum On {
    Programs,
    Phone,
    Ground,
    Stream,
    Connector,
    Note,
    Group,
    Several,
}

/// What commands are about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum CommandGroup {
    Robot,
    Program,
    Graph,
    View,
    People,
}

impl CommandGroup {
    pub(crate) fn label(self) -> &'static str {
        match self {
            Self::Robot => words::robot(),
            Self::Program => words::program(),
            Self::Graph => words::graph(),
            Self::View => words::view(),
            Self::People => words::people_here(),
        }
    }
}

/// How a command is done.
#[derive(Clone, Copy)]
enum CommandWork {
    /// A dialog opens.
    Opens(fn() -> Dialog),
    /// The desk does it.
    Desk(fn(&Desk)),
    /// As if its key were pressed on the graph, with Control or without.
    Key(&'static str, bool),
    /// As if what this selector finds were pressed; what is said where it is not shown.
    Press(&'static str, fn() -> &'static str),
}

const fn command(
    group: CommandGroup,
    label: fn() -> &'static str,
    keys: &'static str,
    role: Role,
    act: CommandWork,
) -> PageCommand {
    PageCommand { group, label, keys, role, on: &[], needs: Needs::Nothing, icon: "bolt", needs_graph: false, act }
}

impl PageCommand {
    const fn on(self, on: &'static [On]) -> Self {
        Self { on, ..self }
    }

    const fn icon(self, icon: &'static str) -> Self {
        Self { icon, ..self }
    }

    const fn needs(self, needs: Needs) -> Self {
        Self { needs, ..self }
    }

    const fn of_graph(self) -> Self {
        Self { needs_graph: true, ..self }
    }
}

/// What can be copied.
const COPIED: &[On] = &[On::Stream, On::Note, On::Group, On::Several];

/// About programs: in the bar of a tablet and of a phone.
const PROGRAMS: &[On] = &[On::Programs, On::Phone];

/// All of them, group by group.
pub(crate) static ALL: &[PageCommand] = &[
    command(CommandGroup::Robot, words::start, "", Role::Operator, CommandWork::Desk(|desk| desk.robots.start())),
    command(CommandGroup::Robot, words::apply, "", Role::Operator, CommandWork::Desk(use_changes)),
    command(
        CommandGroup::Robot,
        words::record,
        "",
        Role::Operator,
        CommandWork::Desk(|desk| desk.robots.records.update(|it| *it = !*it)),
    ),
    command(CommandGroup::Robot, words::stimulate, "", Role::Operator, CommandWork::Desk(send_value)).on(&[On::Stream]),
    command(CommandGroup::Robot, words::stop_this_robot, "Esc Esc", Role::Viewer, CommandWork::Desk(press_stop)),
    command(
        CommandGroup::Robot,
        words::stop_all_robots,
        "",
        Role::Viewer,
        CommandWork::Desk(|desk| desk.robots.stop_all()),
    ),
    command(CommandGroup::Robot, words::add_robot, "", Role::Editor, CommandWork::Opens(|| Dialog::AddRobot)),
    command(CommandGroup::Robot, words::rename_robot, "", Role::Operator, CommandWork::Opens(|| Dialog::RenameRobot)),
    command(
        CommandGroup::Robot,
        words::remove_this_robot,
        "",
        Role::Operator,
        CommandWork::Opens(|| Dialog::RemoveRobot),
    ),
    command(CommandGroup::Program, words::load_program, "", Role::Viewer, CommandWork::Opens(|| Dialog::Programs))
        .on(PROGRAMS)
        .icon("folder"),
    command(CommandGroup::Program, words::add_program, "", Role::Editor, CommandWork::Opens(|| Dialog::AddProgram))
        .on(PROGRAMS)
        .icon("plus"),
    command(
        CommandGroup::Program,
        words::rename_program,
        "",
        Role::Editor,
        CommandWork::Opens(|| Dialog::RenameProgram),
    )
    .needs(Needs::OpenProgram),
    command(
        CommandGroup::Program,
        words::remove_program,
        "",
        Role::Editor,
        CommandWork::Opens(|| Dialog::RemoveProgram),
    )
    .on(PROGRAMS)
    .needs(Needs::OpenProgram)
    .icon("trash"),
    command(CommandGroup::Program, words::make_copy, "", Role::Editor, CommandWork::Desk(copy_open))
        .needs(Needs::OpenProgram),
    command(CommandGroup::Program, words::open_file, "", Role::Editor, CommandWork::Desk(|_| panels::choose_file()))
        .on(PROGRAMS)
        .icon("open"),
    command(CommandGroup::Program, words::save_file, "", Role::Viewer, CommandWork::Opens(|| Dialog::SaveFile))
        .on(PROGRAMS)
        .needs(Needs::OpenProgram)
        .icon("save"),
    command(CommandGroup::Program, words::edit_tiles, "", Role::Editor, CommandWork::Opens(|| Dialog::Tiles))
        .on(PROGRAMS)
        .needs(Needs::OpenProgram)
        .icon("row"),
    command(CommandGroup::Program, words::print, "Ctrl P", Role::Viewer, CommandWork::Desk(print)),
    command(CommandGroup::Program, words::undo, "Ctrl Z", Role::Editor, CommandWork::Desk(Desk::undo))
        .on(&[On::Ground, On::Phone])
        .needs(Needs::SomethingToUndo)
        .icon("undo"),
    command(CommandGroup::Program, words::redo, "Ctrl Y", Role::Editor, CommandWork::Desk(|desk| desk.document.redo()))
        .on(&[On::Ground, On::Phone])
        .needs(Needs::SomethingToRedo)
        .icon("redo"),
    command(
        CommandGroup::Program,
        words::history,
        "",
        Role::Viewer,
        CommandWork::Desk(|desk| desk.shows_history.set(true)),
    )
    .on(&[On::Phone])
    .needs(Needs::OpenProgram)
    .icon("history"),
    command(CommandGroup::Program, words::show_exercise, "", Role::Viewer, CommandWork::Desk(show_exercise)),
    command(CommandGroup::Program, words::take_tour, "", Role::Editor, CommandWork::Desk(panels::take_tour)),
    command(CommandGroup::Graph, words::add_sensor, "", Role::Editor, CommandWork::Opens(|| Dialog::AddSensor))
        .on(&[On::Ground, On::Phone])
        .needs(Needs::OpenProgram)
        .icon("eye"),
    command(CommandGroup::Graph, words::add_helper, "", Role::Editor, CommandWork::Opens(|| Dialog::Helper(None)))
        .on(&[On::Phone])
        .icon("plus"),
    command(CommandGroup::Graph, words::edit_helper, "", Role::Viewer, CommandWork::Opens(|| Dialog::Helpers))
        .on(&[On::Phone])
        .icon("fx"),
    command(CommandGroup::Graph, words::problems, "", Role::Viewer, CommandWork::Opens(|| Dialog::Problems))
        .on(&[On::Ground, On::Phone])
        .icon("warn"),
    command(CommandGroup::Graph, words::help_edit_says, "Enter", Role::Viewer, CommandWork::Key("Enter", false))
        .on(&[On::Stream, On::Connector, On::Note])
        .icon("pencil"),
    command(CommandGroup::Graph, words::rename, "F2", Role::Editor, CommandWork::Key("F2", false))
        .on(&[On::Stream, On::Connector, On::Group])
        .icon("pencil"),
    command(CommandGroup::Graph, words::fold_or_unfold, "F", Role::Viewer, CommandWork::Key("f", false))
        .on(&[On::Group])
        .icon("fold"),
    command(CommandGroup::Graph, words::make_group, "Ctrl G", Role::Editor, CommandWork::Key("g", true))
        .on(&[On::Stream, On::Several])
        .icon("group"),
    command(CommandGroup::Graph, words::ungroup, "Ctrl Shift G", Role::Editor, CommandWork::Desk(ungroup))
        .on(&[On::Group, On::Several]),
    command(CommandGroup::Graph, words::add_note, "N", Role::Editor, CommandWork::Key("n", false))
        .on(&[On::Ground])
        .icon("note"),
    command(
        CommandGroup::Graph,
        words::line_up_row,
        "",
        Role::Editor,
        CommandWork::Desk(|desk| line_up(desk, LineUp::Row)),
    )
    .on(&[On::Several])
    .of_graph(),
    command(
        CommandGroup::Graph,
        words::line_up_column,
        "",
        Role::Editor,
        CommandWork::Desk(|desk| line_up(desk, LineUp::Column)),
    )
    .on(&[On::Several])
    .of_graph(),
    command(CommandGroup::Graph, words::connect, "C", Role::Editor, CommandWork::Key("c", false))
        .on(&[On::Stream])
        .icon("connect"),
    command(
        CommandGroup::Graph,
        words::add_connector,
        "",
        Role::Editor,
        CommandWork::Press("#stage .strip .bolt > button", words::choose_one_stream),
    )
    .on(&[On::Stream]),
    command(CommandGroup::Graph, words::insert_before, "I", Role::Editor, CommandWork::Key("i", false))
        .on(&[On::Stream, On::Connector]),
    command(CommandGroup::Graph, words::help_remove_says, "Delete", Role::Editor, CommandWork::Key("Delete", false))
        .on(&[On::Stream, On::Connector, On::Note, On::Group, On::Several])
        .icon("trash"),
    command(CommandGroup::Graph, words::select_all, "Ctrl A", Role::Viewer, CommandWork::Key("a", true))
        .on(&[On::Ground]),
    command(CommandGroup::Graph, words::copy, "Ctrl C", Role::Viewer, CommandWork::Key("c", true))
        .on(COPIED)
        .icon("copy"),
    command(CommandGroup::Graph, words::cut, "Ctrl X", Role::Editor, CommandWork::Key("x", true))
        .on(COPIED)
        .icon("trash"),
    command(CommandGroup::Graph, words::paste, "Ctrl V", Role::Editor, CommandWork::Key("v", true)).on(&[On::Ground]),
    command(CommandGroup::Graph, words::duplicate, "Ctrl D", Role::Editor, CommandWork::Key("d", true))
        .on(COPIED)
        .icon("duplicate"),
    command(CommandGroup::Graph, words::walk_down, "↓", Role::Viewer, CommandWork::Key("ArrowDown", false)),
    command(CommandGroup::Graph, words::walk_up, "↑", Role::Viewer, CommandWork::Key("ArrowUp", false)),
    command(CommandGroup::Graph, words::walk_left, "←", Role::Viewer, CommandWork::Key("ArrowLeft", false)),
    command(CommandGroup::Graph, words::walk_right, "→", Role::Viewer, CommandWork::Key("ArrowRight", false)),
    command(CommandGroup::View, words::find_or_add, "Ctrl F", Role::Viewer, CommandWork::Desk(find)),
    command(CommandGroup::View, words::zoom_in, "+", Role::Viewer, CommandWork::Key("+", false)),
    command(CommandGroup::View, words::zoom_out, "-", Role::Viewer, CommandWork::Key("-", false)),
    command(CommandGroup::View, words::fit, "0", Role::Viewer, CommandWork::Key("0", false)).on(&[On::Ground]),
    command(CommandGroup::View, words::real_size, "1", Role::Viewer, CommandWork::Key("1", false)),
    command(
        CommandGroup::View,
        words::sentences_shown,
        "",
        Role::Viewer,
        CommandWork::Press(".told .fold", words::no_sentences),
    ),
    command(
        CommandGroup::View,
        words::tidy,
        "",
        Role::Editor,
        CommandWork::Desk(|desk| desk.document.tidy(crate::layout::tidy)),
    )
    .on(&[On::Ground])
    .of_graph(),
    command(CommandGroup::View, words::over_time, "L", Role::Viewer, CommandWork::Desk(over_time))
        .on(&[On::Programs, On::Phone, On::Stream])
        .icon("history"),
    command(CommandGroup::View, words::recordings, "", Role::Viewer, CommandWork::Desk(recordings))
        .on(PROGRAMS)
        .icon("print"),
    command(CommandGroup::View, words::operate, "", Role::Viewer, CommandWork::Desk(operate))
        .on(&[On::Phone])
        .icon("play"),
    command(CommandGroup::View, words::other_language, "", Role::Viewer, CommandWork::Desk(|_| panels::speak_other()))
        .on(&[On::Phone])
        .icon("globe"),
    command(CommandGroup::View, words::keys_and_gestures, "Ctrl K", Role::Viewer, CommandWork::Opens(|| Dialog::Help))
        .on(&[On::Phone])
        .icon("help"),
    command(CommandGroup::People, words::people_here, "", Role::Viewer, CommandWork::Opens(|| Dialog::People)),
    command(CommandGroup::People, words::my_name, "", Role::Viewer, CommandWork::Opens(|| Dialog::MyName)),
    command(CommandGroup::People, words::invite, "", Role::Host, CommandWork::Opens(|| Dialog::Invite))
        .on(&[On::Phone])
        .icon("invite"),
];

impl PageCommand {
    /// Whether all words that are looked for are in its name or in what it is about.
    pub(crate) fn is_meant(&self, search: &str) -> bool {
        let (group, label) = (self.group.label(), (self.label)());
        let english = words::language::in_english(|| [self.group.label(), (self.label)()].join(" "));
        let name = format!("{group} {label} {} {english}", self.keys).to_lowercase();
        search.to_lowercase().split_whitespace().all(|word| name.contains(word))
    }

    /// Does it. Whatever is open is closed already.
    pub(crate) fn run(&self, desk: &Desk) {
        match self.act {
            CommandWork::Opens(dialog) => desk.dialog.set(Some(dialog())),
            CommandWork::Desk(act) => act(desk),
            CommandWork::Key(key, control) => press(key, control),
            CommandWork::Press(selector, not_there) => match shown(selector) {
                Some(shown) => shown.click(),
                None => desk.say(not_there(), false),
            },
        }
    }

    /// Whether there is what it needs, and who is here is allowed to do it. Reactive.
    pub(crate) fn can_be_done(&self, desk: &Desk) -> bool {
        let is_there = match self.needs {
            Needs::Nothing => true,
            Needs::OpenProgram => desk.document.open.read().is_some(),
            Needs::SomethingToUndo => desk.can_undo(),
            Needs::SomethingToRedo => desk.document.redoable.read().is_some(),
        };
        is_there && desk.may_not(self.role).is_none()
    }

    /// Whether it can be done here: with the list in place of the graph there is nothing to zoom, to tidy or to walk about.
    pub(crate) fn is_here(&self) -> bool {
        let on_graph = match self.act {
            CommandWork::Key(key, control) => !control && !matches!(key, "Enter" | "F2" | "Delete"),
            CommandWork::Press(selector, _) => selector.starts_with("#stage"),
            CommandWork::Opens(_) | CommandWork::Desk(_) => self.needs_graph,
        };
        !on_graph || has_canvas()
    }
}

/// Whether the graph is drawn, and not told as a list.
fn has_canvas() -> bool {
    document().query_selector("#stage .world").is_ok_and(|world| world.is_some())
}

/// What a selector finds, if it is shown.
fn shown(selector: &str) -> Option<HtmlElement> {
    let found = document().query_selector(selector).ok().flatten()?.dyn_into::<HtmlElement>().ok()?;
    (found.offset_width() > 0).then_some(found)
}

/// Goes to the field that finds things; where that is not shown, the dialog that does the same opens.
pub(crate) fn find(desk: &Desk) {
    match shown("#find") {
        Some(field) => drop(field.focus()),
        None => desk.dialog.set(Some(Dialog::Find)),
    }
}

/// Presses the page's Stop, which stops the robot that is looked at.
fn press_stop(_: &Desk) {
    panels::focus::by_id("stop").iter().for_each(HtmlElement::click);
}

/// Lets the run go on with what was changed since.
fn use_changes(desk: &Desk) {
    match untrack(|| desk.robots.running().filter(|run| desk.robots.runs_older(run))) {
        Some(_) => desk.robots.apply(),
        None => desk.say(words::nothing_to_use(), false),
    }
}

/// Asks for a value for the chosen sense.
fn send_value(desk: &Desk) {
    let chosen = desk.document.selected.get_untracked();
    let sense = chosen.filter(|one| {
        let signals = desk.document.stream(one.id());
        signals.is_some_and(|signals| signals.record.with_untracked(|stream| stream.kind == StreamKind::Sensor))
    });
    match sense {
        Some(Selected::Stream(id)) => desk.dialog.set(Some(Dialog::Stimulate(id))),
        _ => desk.say(words::choose_sense_first(), false),
    }
}

fn copy_open(desk: &Desk) {
    if let Some(open) = desk.document.open.get_untracked() {
        desk.library.copy_program(&open, &desk.document.name.get_untracked());
    }
}

fn line_up(desk: &Desk, how: LineUp) {
    let chosen = desk.document.chosen();
    if chosen.len() < 2 {
        return desk.say(words::choose_several_first(), false);
    }
    desk.document.line_up(&chosen, how);
}

/// Goes to the operator's page, with the robot that is looked at and the program that is open.
fn operate(desk: &Desk) {
    let robot = desk.robots.chosen_id().map(|robot| format!("/{robot}")).unwrap_or_default();
    let _ = window().location().set_href(&format!("{}{robot}{}", protocol::OPERATE_PATH, crate::browser::hash()));
}

/// Shows what runs over time, with the lane of the selected stream.
pub(crate) fn over_time(desk: &Desk) {
    let selected = desk.document.selected.get_untracked();
    let stream = if let Some(Selected::Stream(id)) = selected { Some(id) } else { None };
    desk.past.set(Some(OpenPast::Running(stream)));
}

/// Opens the recordings beside this page.
fn recordings(_: &Desk) {
    let _ = window().open_with_url_and_target(&panels::recordings_address(), "_blank");
}

/// Prints once all of the graph is in the page: the browser waits for nothing that comes later.
fn print(desk: &Desk) {
    desk.printing.set(true);
    let printing = desk.printing.clone();
    crate::browser::after(PRINTS_MS, move || {
        let _ = window().print();
        printing.set(false);
    });
}

/// Ctrl K opens the palette of commands, Ctrl F goes to the field that finds things; both from anywhere.
pub(crate) fn keys(desk: &Desk) {
    let desk = desk.clone();
    crate::browser::hear(&window(), "keydown", move |event| {
        let Ok(event) = event.dyn_into::<KeyboardEvent>() else { return };
        let control = (event.ctrl_key() || event.meta_key()) && !event.alt_key() && !event.shift_key();
        if !control || desk.dialog.with_untracked(Option::is_some) {
            return;
        }
        match event.pressed().as_str() {
            "k" | "K" => desk.dialog.set(Some(Dialog::Help)),
            "f" | "F" => find(&desk),
            _ => return,
        }
        event.prevent_default();
    });
}

/// Shows the goal of the open program again, if it has one.
fn show_exercise(desk: &Desk) {
    desk.put_away.set(None);
    if untrack(|| desk.library.exercise()).is_none() {
        desk.say(words::no_exercise(), false);
    }
}

fn ungroup(desk: &Desk) {
    desk.document.ungroup(&desk.document.chosen());
}

/// Presses a key on what has the keyboard in the graph, else on the graph.
fn press(key: &str, control: bool) {
    let inside = document().active_element().filter(|active| active.closest("#stage").ok().flatten().is_some());
    let target = inside.or_else(|| document().query_selector("#stage .stream[tabindex='0'], #stage").ok().flatten());
    let how = KeyboardEventInit::new();
    how.set_key(key);
    how.set_ctrl_key(control);
    how.set_bubbles(true);
    how.set_cancelable(true);
    if let (Some(target), Ok(event)) = (target, KeyboardEvent::new_with_keyboard_event_init_dict("keydown", &how)) {
        let _ = target.dispatch_event(&event);
    }
}
