//! Scenes of finding: things by their names, commands by the menus and keys in which they stand.

use crate::known::BALLS;
use crate::table::{AIKO, Table};
use editor::commands::{ALL, Command, CommandState, On};
use editor::find::nearest;
use editor::keys::{GraphChord, graph_chord, key_name};
use editor::{Editor, Put, Selected};
use protocol::Role;

/// The stream that Enter goes to after somebody typed this.
fn goes_to(table: &mut Table, typed: &str) -> Option<String> {
    let streams = table.editor(AIKO).shown_behaviour();
    let named = streams.streams_in_order().into_iter().map(|(id, one)| (one.name.clone(), id.clone()));
    let found = nearest(typed, false, named)?;
    table.does(AIKO, |page| page.input(|editor| editor.choose([Selected::Stream(found.clone())].into())));
    streams.stream(&found).map(|one| one.name.clone())
}

#[test]
fn things_are_found_by_a_part_of_their_name_and_chosen() {
    let mut table = Table::knowing(BALLS);
    for (typed, name) in [("close ball", "Close ball"), ("far", "Far ball"), ("ball", "Ball"), ("head", "Head tracker")]
    {
        assert_eq!(goes_to(&mut table, typed).as_deref(), Some(name), "{typed}");
        assert_eq!(table.selected(AIKO), Some(Selected::Stream(table.named(name))));
    }
    assert_eq!(goes_to(&mut table, "face"), None);
    table.does(AIKO, |page| page.input(Editor::choose_all));
    assert_eq!(table.editor(AIKO).several.len(), 11);
}

/// The commands of a menu with those that cannot be done now, and a line between those about different things. Panels have theirs
/// in the page's own list.
fn menu(on: On, state: &CommandState) -> Vec<String> {
    let mut told = Vec::new();
    let mut before = None;
    for spec in ALL.iter().filter(|spec| spec.on.contains(&on)) {
        if before.is_some_and(|before| before != spec.group) {
            told.push("-".to_owned());
        }
        before = Some(spec.group);
        told.push(format!("{:?}{}", spec.command, if spec.is_allowed(state) { "" } else { " (off)" }));
    }
    told
}

#[test]
fn the_menus_of_the_bar_are_drawn_from_the_list_of_commands() {
    let role = Some(Role::Host);
    let fresh = CommandState { role, is_past: false, is_open: true, can_undo: false, can_redo: false };
    let phone = "LoadProgram, AddProgram, RemoveProgram, OpenFile, SaveFile, EditTiles, Undo (off), Redo (off), -, \
                 AddSensor, AddHelper, EditHelper, Problems, -, OverTime, Recordings, Operate, OtherLanguage, \
                 KeysAndGestures, -, Invite";
    assert_eq!(menu(On::Phone, &fresh).join(", "), phone);
    let tablet = "LoadProgram, AddProgram, RemoveProgram, OpenFile, SaveFile, EditTiles, -, OverTime, Recordings";
    assert_eq!(menu(On::Programs, &fresh).join(", "), tablet);
    let stop = ALL.iter().filter(|spec| spec.keys == "Esc Esc").map(|spec| spec.command).collect::<Vec<_>>();
    assert_eq!(stop, [Command::StopThisRobot], "what is said beside Escape is what it does");
}

#[test]
fn without_a_role_to_edit_a_guest_is_offered_only_what_they_may_do() {
    let state =
        |role: Role| CommandState { role: Some(role), is_past: false, is_open: true, can_undo: true, can_redo: true };
    let may =
        |role: Role, command: Command| ALL.iter().any(|spec| spec.command == command && spec.is_allowed(&state(role)));
    for command in [Command::AddProgram, Command::AddHelper, Command::AddSensor, Command::Tidy, Command::Remove] {
        assert_eq!([Role::Viewer, Role::Operator, Role::Editor].map(|role| may(role, command)), [false, false, true]);
    }
    for command in [Command::Start, Command::Stimulate] {
        assert_eq!([Role::Viewer, Role::Operator].map(|role| may(role, command)), [false, true], "{command:?}");
    }
    assert!([Role::Viewer, Role::Operator, Role::Editor].iter().all(|role| !may(*role, Command::Invite)));
    assert!(may(Role::Viewer, Command::StopThisRobot) && may(Role::Viewer, Command::Edit), "it is looked at");
}

#[test]
fn keys_of_the_program_work_on_every_layout() {
    let mut table = Table::knowing(BALLS);
    let chord = |key: &str, code: &str| graph_chord(&key_name(key.to_owned(), code, false, false), false, true);
    // Russian, Greek, Arabic and Hebrew: D doubles, Z takes back.
    for (double, undo) in [("в", "я"), ("δ", "ζ"), ("ي", "ئ"), ("ג", "ז")] {
        assert_eq!(chord(double, "KeyD"), Some(GraphChord::Duplicate));
        table.does(AIKO, |page| page.input(|editor| editor.select(Some(crate::sketch::stream("far")))));
        table.gesture(AIKO, |editor, op| {
            let part = editor.part(&editor.chosen(), &[]);
            editor.put_in(op, part, Put::Beside, &[]);
        });
        assert_eq!(table.names().len(), 7, "{double}");
        let name = key_name(undo.to_owned(), "KeyZ", false, false).to_uppercase();
        let undoes = ALL.iter().find(|spec| spec.keys == format!("Ctrl {name}")).map(|spec| spec.command);
        assert_eq!(undoes, Some(Command::Undo), "{undo}");
        table.undo(AIKO);
        assert_eq!(table.names().len(), 6, "{undo}");
    }
    assert_eq!(chord("ф", "KeyA"), Some(GraphChord::ChooseAll));
    // On a French keyboard what is written on a key counts.
    assert_eq!([chord("z", "KeyW"), chord("a", "KeyQ")], [None, Some(GraphChord::ChooseAll)]);
}
