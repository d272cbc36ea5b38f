//! The commands of the page: what each is called, and how it is done. Their list, with keys and who may do them, is the editor's.

mod language;
mod panel;

pub(crate) use language::{other_language, speak_other};
pub(crate) use panel::{ListedPanel, Panel, know_panels, open_panel, panels};

use crate::desk::{Desk, Dialog, LineUp, OpenPast, Selected};
use crate::keys::PressedKey;
use crate::{focus, words};
use behaviour::{StreamKind, sort_few};
use editor::commands::{ALL, Command, CommandSpec, CommandState};
pub(crate) use editor::commands::{CommandGroup, Needs, On};
use leptos::prelude::*;
use protocol::REPORTS_PATH;
use std::ops::Deref;
use wasm_bindgen::JsCast;
use web_sys::{HtmlElement, KeyboardEvent, KeyboardEventInit};

/// A moment for all of the graph to be in the page before it is printed, in milliseconds.
const PRINTS_MS: i32 = 120;

/// The picker of the browser for a file to open, which nobody sees.
pub(crate) const FILE_PICKER_ID: &str = "file-to-open";

/// A command as the page knows it.
#[derive(Clone, Copy)]
pub(crate) struct PageCommand {
    spec: CommandSpec,
    face: CommandFace,
}

/// Reaches what the editor knows of it.
impl Deref for PageCommand {
    type Target = CommandSpec;
    fn deref(&self) -> &CommandSpec {
        &self.spec
    }
}

/// Returns all commands, group by group: the editor's, then those that open panels.
pub(crate) fn all() -> Vec<PageCommand> {
    let own = ALL.iter().filter_map(|spec| Some(PageCommand { spec: *spec, face: face_of(spec.command)? }));
    let mut all: Vec<PageCommand> = own.chain(panels().iter().map(ListedPanel::command)).collect();
    sort_few(&mut all, |one, other| one.group < other.group);
    all
}

/// Returns the name of what commands are about.
pub(crate) fn group_label(group: CommandGroup) -> &'static str {
    match group {
        CommandGroup::Robot => words::robot(),
        CommandGroup::Program => words::program(),
        CommandGroup::Graph => words::graph(),
        CommandGroup::View => words::view(),
        CommandGroup::People => words::people_here(),
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
    /// The panel of this name opens.
    Panel(&'static str),
    /// As if what this selector finds were pressed; what is said where it is not shown.
    Press(&'static str, fn() -> &'static str),
}

/// The name, the sign and the work of a command.
type CommandFace = (fn() -> &'static str, &'static str, CommandWork);

const fn face(label: fn() -> &'static str, icon: &'static str, work: CommandWork) -> CommandFace {
    (label, icon, work)
}

/// Returns how a command looks and is done; nothing for one that opens a panel, of which the list of panels knows.
fn face_of(command: Command) -> Option<CommandFace> {
    Some(match command {
        Command::Start => face(words::start, "bolt", CommandWork::Desk(|desk| desk.robots.start())),
        Command::Apply => face(words::apply, "bolt", CommandWork::Desk(use_changes)),
        Command::Record => {
            face(words::record, "bolt", CommandWork::Desk(|desk| desk.robots.records.update(|it| *it = !*it)))
        }
        Command::Stimulate => face(words::stimulate, "bolt", CommandWork::Desk(send_value)),
        Command::StopThisRobot => face(words::stop_this_robot, "bolt", CommandWork::Desk(press_stop)),
        Command::StopAllRobots => {
            face(words::stop_all_robots, "bolt", CommandWork::Desk(|desk| desk.robots.stop_all()))
        }
        Command::AddRobot => face(words::add_robot, "bolt", CommandWork::Opens(|| Dialog::AddRobot)),
        Command::RenameRobot => face(words::rename_robot, "bolt", CommandWork::Opens(|| Dialog::RenameRobot)),
        Command::RemoveThisRobot => face(words::remove_this_robot, "bolt", CommandWork::Opens(|| Dialog::RemoveRobot)),
        Command::LoadProgram => face(words::load_program, "folder", CommandWork::Opens(|| Dialog::Programs)),
        Command::AddProgram => face(words::add_program, "plus", CommandWork::Opens(|| Dialog::AddProgram)),
        Command::RenameProgram => face(words::rename_program, "bolt", CommandWork::Opens(|| Dialog::RenameProgram)),
        Command::RemoveProgram => face(words::remove_program, "trash", CommandWork::Opens(|| Dialog::RemoveProgram)),
        Command::MakeCopy => face(words::make_copy, "bolt", CommandWork::Desk(copy_open)),
        Command::OpenFile => face(words::open_file, "open", CommandWork::Desk(|_| choose_file())),
        Command::SaveFile => face(words::save_file, "save", CommandWork::Opens(|| Dialog::SaveFile)),
        Command::EditTiles => face(words::edit_tiles, "row", CommandWork::Opens(|| Dialog::Tiles)),
        Command::PrintProgram => face(words::print, "bolt", CommandWork::Desk(print)),
        Command::Undo => face(words::undo, "undo", CommandWork::Desk(Desk::undo)),
        Command::Redo => face(words::redo, "redo", CommandWork::Desk(|desk| desk.document.redo())),
        Command::ShowExercise => face(words::show_exercise, "bolt", CommandWork::Desk(show_exercise)),
        Command::TakeTour => face(words::take_tour, "bolt", CommandWork::Desk(Desk::take_tour)),
        Command::AddSensor => face(words::add_sensor, "eye", CommandWork::Opens(|| Dialog::AddSensor)),
        Command::AddHelper => face(words::add_helper, "plus", CommandWork::Opens(|| Dialog::Helper(None))),
        Command::EditHelper => face(words::edit_helper, "fx", CommandWork::Opens(|| Dialog::Helpers)),
        Command::Problems => face(words::problems, "warn", CommandWork::Opens(|| Dialog::Problems)),
        Command::Edit => face(words::help_edit_says, "pencil", CommandWork::Key("Enter", false)),
        Command::Rename => face(words::rename, "pencil", CommandWork::Key("F2", false)),
        Command::FoldOrUnfold => face(words::fold_or_unfold, "fold", CommandWork::Key("f", false)),
        Command::MakeGroup => face(words::make_group, "group", CommandWork::Key("g", true)),
        Command::Ungroup => face(words::ungroup, "bolt", CommandWork::Desk(ungroup)),
        Command::AddNote => face(words::add_note, "note", CommandWork::Key("n", false)),
        Command::LineUpRow => face(words::line_up_row, "bolt", CommandWork::Desk(|desk| line_up(desk, LineUp::Row))),
        Command::LineUpColumn => {
            face(words::line_up_column, "bolt", CommandWork::Desk(|desk| line_up(desk, LineUp::Column)))
        }
        Command::Connect => face(words::connect, "connect", CommandWork::Key("c", false)),
        Command::AddConnector => face(
            words::add_connector,
            "bolt",
            CommandWork::Press("#stage .strip .bolt > button", words::choose_one_stream),
        ),
        Command::InsertBefore => face(words::insert_before, "bolt", CommandWork::Key("i", false)),
        Command::Remove => face(words::help_remove_says, "trash", CommandWork::Key("Delete", false)),
        Command::SelectAll => face(words::select_all, "bolt", CommandWork::Key("a", true)),
        Command::Copy => face(words::copy, "copy", CommandWork::Key("c", true)),
        Command::Cut => face(words::cut, "trash", CommandWork::Key("x", true)),
        Command::Paste => face(words::paste, "bolt", CommandWork::Key("v", true)),
        Command::Duplicate => face(words::duplicate, "duplicate", CommandWork::Key("d", true)),
        Command::WalkDown => face(words::walk_down, "bolt", CommandWork::Key("ArrowDown", false)),
        Command::WalkUp => face(words::walk_up, "bolt", CommandWork::Key("ArrowUp", false)),
        Command::WalkLeft => face(words::walk_left, "bolt", CommandWork::Key("ArrowLeft", false)),
        Command::WalkRight => face(words::walk_right, "bolt", CommandWork::Key("ArrowRight", false)),
        Command::FindOrAdd => face(words::find_or_add, "bolt", CommandWork::Desk(find)),
        Command::ZoomIn => face(words::zoom_in, "bolt", CommandWork::Key("+", false)),
        Command::ZoomOut => face(words::zoom_out, "bolt", CommandWork::Key("-", false)),
        Command::Fit => face(words::fit, "bolt", CommandWork::Key("0", false)),
        Command::RealSize => face(words::real_size, "bolt", CommandWork::Key("1", false)),
        Command::FoldSentences => {
            face(words::sentences_shown, "bolt", CommandWork::Press(".told .fold", words::no_sentences))
        }
        Command::Tidy => face(words::tidy, "bolt", CommandWork::Desk(|desk| desk.document.tidy(crate::layout::tidy))),
        Command::OverTime => face(words::over_time, "history", CommandWork::Desk(over_time)),
        Command::Recordings => face(words::recordings, "print", CommandWork::Desk(recordings)),
        Command::Operate => face(words::operate, "play", CommandWork::Desk(operate)),
        Command::OtherLanguage => face(words::other_language, "globe", CommandWork::Desk(|_| speak_other())),
        Command::KeysAndGestures => face(words::keys_and_gestures, "help", CommandWork::Opens(|| Dialog::Help)),
        Command::PeopleHere => face(words::people_here, "bolt", CommandWork::Opens(|| Dialog::People)),
        Command::MyName => face(words::my_name, "bolt", CommandWork::Opens(|| Dialog::MyName)),
        Command::Invite => face(words::invite, "invite", CommandWork::Opens(|| Dialog::Invite)),
        Command::Panel(_) => return None,
    })
}

impl PageCommand {
    /// Returns its name.
    pub(crate) fn label(&self) -> &'static str {
        self.face.0()
    }

    /// Returns its sign in menus that have signs.
    pub(crate) fn icon(&self) -> &'static str {
        self.face.1
    }

    /// Returns the name of the panel that it opens, if it opens one.
    pub(crate) fn panel(&self) -> Option<&'static str> {
        if let Command::Panel(name) = self.command { Some(name) } else { None }
    }

    /// Returns true if all words that are looked for are in its name or in what it is about.
    pub(crate) fn is_meant(&self, search: &str) -> bool {
        let (group, label) = (group_label(self.group), self.label());
        let english = words::language::in_english(|| [group_label(self.group), self.label()].join(" "));
        let name = format!("{group} {label} {} {english}", self.keys).to_lowercase();
        search.to_lowercase().split_whitespace().all(|word| name.contains(word))
    }

    /// Does it. Whatever is open is closed already.
    pub(crate) fn run(&self, desk: &Desk) {
        match self.face.2 {
            CommandWork::Opens(dialog) => desk.dialog.set(Some(dialog())),
            CommandWork::Desk(act) => act(desk),
            CommandWork::Key(key, control) => press(key, control),
            CommandWork::Panel(name) => desk.panel.set(Some(name)),
            CommandWork::Press(selector, not_there) => match shown(selector) {
                Some(shown) => shown.click(),
                None => desk.say(not_there(), false),
            },
        }
    }

    /// Returns true if there is what it needs, and who is here is allowed to do it. Reactive.
    pub(crate) fn can_be_done(&self, desk: &Desk) -> bool {
        let can_redo = desk.document.redoable.read().is_some();
        let (role, is_past, can_undo) = (desk.role.get(), desk.is_then(), desk.can_undo());
        let is_open = desk.document.open.read().is_some();
        self.is_allowed(&CommandState { role, is_past, is_open, can_undo, can_redo })
    }

    /// Returns true if it can be done here: with the list in place of the graph there is nothing to zoom, to tidy or to walk
    /// about.
    pub(crate) fn is_here(&self) -> bool {
        !self.on_graph || has_canvas()
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
    focus::by_id("stop").iter().for_each(HtmlElement::click);
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
    let _ = window().open_with_url_and_target(&recordings_address(), "_blank");
}

/// Returns the address of the recordings, in the language of this page.
pub(crate) fn recordings_address() -> String {
    let language = words::language::spoken().code;
    format!("{REPORTS_PATH}?language={language}")
}

/// Asks the person for a file.
pub(crate) fn choose_file() {
    focus::by_id(FILE_PICKER_ID).iter().for_each(HtmlElement::click);
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

/// Ctrl K opens the palette of commands, Ctrl F goes to the field that finds things, and panels have keys of their own; all from
/// anywhere.
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
            key => match panel_of_key(key).filter(|panel| untrack(|| panel.can_be_shown(&desk))) {
                Some(panel) => desk.panel.set(Some(panel.name)),
                None => return,
            },
        }
        event.prevent_default();
    });
}

/// Returns the panel that Control and this key open.
fn panel_of_key(key: &str) -> Option<&'static ListedPanel> {
    let is_it = |keys: &str| keys.strip_prefix("Ctrl ").is_some_and(|own| own.eq_ignore_ascii_case(key));
    panels().iter().find(|panel| is_it(panel.panel.keys))
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
