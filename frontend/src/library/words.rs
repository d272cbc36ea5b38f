//! Sentences that only the library says.

use crate::reasons::NoPicture;
pub(crate) use crate::words::*;
use protocol::Role;

sentences! {
    open_pasted: "Open what you pasted?";
    pasted_is_whole: "It is a whole program. It opens as a new one; the one that you see now stays as it is.";
    open_as_new: "Open it";
    new_behaviour: "New program";
    behaviours: "Programs";
    no_programs: "There are no programs yet. Begin with a template, or with an empty one.";
    programs: "Programs";
    bin: "Bin";
    shelf: "Show";
    search: "Search …";
    search_programs: "Search in names, streams and procedures";
    order: "Order";
    by_change: "Last changed";
    by_name: "By name";
    whose: "Whose";
    everyones: "Everyone’s";
    mine: "Mine";
    loading_list: "Loading …";
    show_templates: "Show templates";
    clear_search: "Clear the search";
    show_everyones: "Show everyone’s";
    none_mine: "You have not made a program yet.";
    bin_empty: "The bin is empty. What is removed stays here for 30 days.";
    restore: "Restore";
    back_to_list: "Back to the list";
    open_program: "Open";
    similar_programs: "Similar programs";
    none_similar: "No other program uses the same senses or actions.";
    file_json: "Program (JSON)";
    file_json_says: "Everything, to open it again here or elsewhere.";
    file_xml: "Program (XML)";
    file_xml_says: "The same for programs that read XML.";
    file_svg: "Drawing (SVG)";
    file_svg_says: "The graph as a picture, for a report or a wall.";
    drop_here: "Drop the file to open it as a program of its own.";
    all_of_them: "All programs …";
    to_the_bin: "It goes to the bin for 30 days. Nobody can edit it there.";
    runs_now: "runs now";
    no_programs_yet: "There is no program yet. As soon as somebody makes one, it is here.";
    begin_empty: "Start with an empty program";
    begin_with_sense: "Add a sense to begin";
    begin_says: "What should the robot notice? Everything else follows from it.";
    more_senses: "More senses …";
    // The picture
    file_png: "Picture (PNG)";
    file_png_says: "The drawing in pixels, for slides and messages.";
    png_goes: "Making the picture …";
    png_done: "The picture is in your downloads.";
    no_drawing: "The server did not give the drawing. Check the connection and try again.";
    png_refused: "This browser could not make the picture. Save the drawing (SVG) instead, or try another browser.";
    // The library
    rename_it: "Rename";
    tags: "Tags";
    tag: "Tag";
    all_tags: "All tags";
    show_all_tags: "Show all tags";
    add_tag: "Add a tag";
    add_it: "Add";
    nothing_in_it: "This program is empty";
    // Exercises
    exercises: "Tasks";
}

pub(crate) fn remove_running(robot: &str) -> String {
    say!(remove_running: "It runs on “{robot}”; stop it there first.", robot)
}

pub(crate) fn changed_by(name: &str) -> String {
    say!(changed_by: "last changed by {name}", name)
}

/// Describes a program below its name in the list: `Aiko · 6 streams · 2 hours ago`.
pub(crate) fn program_line(owner: &str, count: u32, when: &str, by: &str) -> String {
    let changed = if by == owner || by.is_empty() {
        when.to_owned()
    } else {
        say!(program_line: "changed {when} by {by}", when, by)
    };
    let owner = if owner.is_empty() { String::new() } else { format!("{owner} · ") };
    format!("{owner}{} · {changed}", streams(count))
}

/// Describes a program below its name in the bin: `removed 2 hours ago by Aiko · stays 27 more days`.
pub(crate) fn removed_line(when: &str, by: &str, days_left: u64) -> String {
    let left = match days_left {
        0 => say!(removed_line_goes_today: "goes today"),
        1 => say!(removed_line_stays_1_more_day: "stays 1 more day"),
        many => say!(removed_line_stays_more_days: "stays {many} more days", many),
    };
    say!(removed_line_removed_by: "removed {when} by {by} · {left}", when, by, left)
}

pub(crate) fn nothing_fits(words: &str) -> String {
    say!(nothing_fits: "Nothing fits “{words}”.", words)
}

pub(crate) fn more_about(name: &str) -> String {
    say!(more_about: "More about {name}", name)
}

pub(crate) fn restore_named(name: &str) -> String {
    say!(restore_named: "Restore {name}", name)
}

pub(crate) fn shared_devices(count: u32) -> String {
    if count == 1 {
        say!(shared_devices_n1_sense_or_action: "1 sense or action in common")
    } else {
        say!(shared_devices_senses_and_actions_in: "{count} senses and actions in common", count)
    }
}

/// So many programs were found; perhaps more.
pub(crate) fn programs_found(count: usize, more: bool) -> String {
    match (count, more) {
        (0, _) => say!(programs_found_none_found: "None found"),
        (_, true) => say!(programs_found_found_so_far: "{count} found so far", count),
        (_, false) => say!(programs_found_found: "{count} found", count),
    }
}

pub(crate) fn programs_in_all(count: u64) -> String {
    if count == 1 {
        say!(programs_in_all_n1_program: "1 program")
    } else {
        say!(programs_in_all_programs: "{count} programs", count)
    }
}

/// Says why there is no picture.
pub(crate) fn no_png(why: NoPicture) -> &'static str {
    match why {
        NoPicture::NoDrawing => no_drawing(),
        NoPicture::Refused => png_refused(),
    }
}

pub(crate) fn rename_named(name: &str) -> String {
    say!(rename_named: "Rename “{name}”", name)
}

/// A tag among those to choose from: `group b (3)`.
pub(crate) fn tag_and_count(tag: &str, count: u64) -> String {
    format!("{tag} ({count})")
}

pub(crate) fn drop_tag(tag: &str) -> String {
    say!(drop_tag: "Take the tag “{tag}” away", tag)
}

pub(crate) fn none_tagged(tag: &str) -> String {
    say!(none_tagged: "No program has the tag “{tag}”.", tag)
}

/// Over the library. Who may not make programs comes to run or to watch one.
pub(crate) fn library_title(role: Option<Role>) -> &'static str {
    match role {
        Some(Role::Viewer) => said!(library_title_what_do_you_want: "What do you want to watch?"),
        Some(Role::Operator) => said!(library_title_which_program_shall_run: "Which program shall run?"),
        Some(Role::Editor | Role::Host) | None => said!(library_title_what_shall_the_robot: "What shall the robot do?"),
    }
}

/// Says what to do there.
pub(crate) fn library_says(role: Option<Role>) -> &'static str {
    match role {
        Some(Role::Viewer) => {
            said!(library_says_open_a_program_to: "Open a program to see what it does. You change nothing, and Stop works for you too.")
        }
        Some(Role::Operator) => {
            said!(library_says_open_a_program_then: "Open a program, then press Start. You change nothing in it.")
        }
        Some(Role::Editor | Role::Host) | None => {
            said!(library_says_open_a_program_begin: "Open a program, begin with a template, or start with an empty program.")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{program_line, removed_line};

    #[test]
    fn a_line_names_a_person_once() {
        assert_eq!(program_line("Aiko", 1, "just now", "Aiko"), "Aiko · 1 stream · just now");
        assert_eq!(program_line("Aiko", 6, "yesterday", "Ben"), "Aiko · 6 streams · changed yesterday by Ben");
        assert_eq!(removed_line("yesterday", "Ben", 29), "removed yesterday by Ben · stays 29 more days");
    }
}
