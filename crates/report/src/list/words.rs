//! The words of the list of recordings: English here, other languages by the same keys in their catalogues.

use crate::words::{Words, said};
use phrase::phrase;

said! {
    "list";
    all_codes: "All codes";
    all_programs: "All programs";
    around: "Around the list";
    back_to_list: "Back to the recordings";
    bin: "Bin";
    bin_is_empty: "The bin is empty.";
    bring_back: "Bring it back";
    cannot_come_back: "It cannot be brought back after that. Download it first if anybody may need it.";
    chosen: "The recording you look at";
    code: "Code";
    ends_early: "ends early";
    find: "Find";
    find_hint: "Code, program, person, name or day …";
    look_back: "Look back";
    marks_and_actions_only: "marks only";
    name_hint: "A name for this recording";
    no_code: "no code";
    none_found: "No recording is found. Switch on Record before Start, or look for something else.";
    not_done_title: "That was not done";
    not_looked_at: "not checked yet";
    note: "Note";
    old_file: "old file: no program";
    operate: "Operator’s page";
    program: "Program";
    programs: "Programs";
    recording_now: "recording now";
    recordings: "Recordings";
    remove_for_good: "Remove it for good";
    remove_mark: "Remove";
    rename: "Rename";
    report: "Report";
    save: "Save";
    size: "Size";
    stop_all: "Stop all robots";
    to_the_bin: "To the bin";
}

impl Words {
    pub(super) fn show_more(self, count: usize) -> String {
        self.0.say(&phrase!("list.show_more", "Show more ({count})"))
    }

    pub(super) fn so_many(self, count: usize, bytes: &str, most: &str) -> String {
        self.0.say(&phrase!("list.so_many", "{count} recordings · {bytes} of {most}"))
    }
}
