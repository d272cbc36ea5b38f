//! What people may do, and letting others in.

use super::{listed, person_called, somebody};
use protocol::{Lasts, Role};

sentences! {
    invite: "Invite";
    invite_somebody: "Invite somebody";
    who_comes_may: "Whoever comes by it may";
    how_long: "It works";
    for_whom: "For whom";
    for_whom_hint: "A note for yourself, such as “Yuki, tablet”.";
    make_link: "Make a link";
    another_link: "Make another one";
    link: "Link";
    link_copied: "Copied";
    copy_link: "Copy";
    qr_name: "The link as a QR code. A phone’s camera opens it.";
    shown_once: "It is shown only now. Copy it, or let a camera see it.";
    invitations: "Invitations";
    no_invitations: "Nobody is invited yet.";
    invitation_unnamed: "Without a note";
    nobody_came: "Nobody came yet";
    revoke: "Revoke";
    is_revoked: "Revoked";
    is_over: "Over";
    keep_invitation: "Keep it";
    here_now: "here now";
    only_this_computer: "Only this computer reaches this server, so a link would lead nobody here.";
    how_to_let_in: "To let others in, start it with this computer’s address in your network, for example:";
    listen_example: "rrp serve --listen 0.0.0.0:7130";
    listen_says: "It then prints a first link, and this dialog makes more.";
    look_at_it: "Look at it";
    you_look: "You may look";
    you_operate: "You may start and stop";
    nothing_in_it: "This program is empty";
    take_over: "Take over";
    take_it: "Take it over";
    leave_it: "Leave it";
    revoked_title: "Your invitation has ended";
    revoked_says: "You are no longer connected. What you saved stays. If you still want to take part, ask the person who invited you for a new link.";
    gave_way_title: "Open in other pages";
    gave_way_says: "Too many pages of yours are open: each person has eight at once. This one is no longer connected, and what you saved stays. Close some of the others, then go on here.";
    go_on_here: "Go on here";
    is_revoked_unwritten: "Revoked, but not written on the disk yet. Do not restart the server before that: free some space, and it is written by itself.";
}

/// What somebody may do, for who chooses it.
pub(crate) fn may(role: Role) -> &'static str {
    match role {
        Role::Viewer => said!(may_look: "look"),
        Role::Operator => said!(may_start_and_stop: "start and stop"),
        Role::Editor => said!(may_edit: "edit"),
        Role::Host => said!(may_do_everything: "do everything"),
    }
}

/// What follows from that.
pub(crate) fn may_says(role: Role) -> &'static str {
    match role {
        Role::Viewer => {
            said!(may_says_they_see_the_graph: "They see the graph and the robot, change nothing, and can press Stop.")
        }
        Role::Operator => {
            said!(may_says_they_start_and_stop: "They start and stop the robot and use its room, but do not edit.")
        }
        Role::Editor | Role::Host => {
            said!(may_says_they_edit_with_you: "They edit with you, and start and stop the robot.")
        }
    }
}

/// `may edit`
pub(crate) fn may_short(role: Role) -> &'static str {
    match role {
        Role::Viewer => said!(may_short_may_look: "may look"),
        Role::Operator => said!(may_short_may_start_and_stop: "may start and stop"),
        Role::Editor => said!(may_short_may_edit: "may edit"),
        Role::Host => said!(may_short_may_do_everything: "may do everything"),
    }
}

/// Why something cannot be done, and what to do about it.
pub(crate) fn may_not(role: Role) -> &'static str {
    match role {
        Role::Viewer => said!(may_not_you_may_look_ask: "You may look. Ask the person who invited you for more."),
        Role::Operator => {
            said!(may_not_you_may_start_and: "You may start and stop, not edit. Ask the person who invited you for more.")
        }
        Role::Editor | Role::Host => {
            said!(may_not_only_the_person_at: "Only the person at the robot’s computer may do this. Ask them.")
        }
    }
}

/// Over the library. Who may not make programs comes to run or to watch one.
pub(crate) fn library_title(role: Option<Role>) -> &'static str {
    match role {
        Some(Role::Viewer) => said!(library_title_what_do_you_want: "What do you want to watch?"),
        Some(Role::Operator) => said!(library_title_which_program_shall_run: "Which program shall run?"),
        Some(Role::Editor | Role::Host) | None => said!(library_title_what_shall_the_robot: "What shall the robot do?"),
    }
}

/// What to do there.
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

/// How long, for who chooses it.
pub(crate) fn lasts(lasts: Lasts) -> &'static str {
    match lasts {
        Lasts::Once => said!(lasts_once: "once"),
        Lasts::Day => said!(lasts_for_a_day: "for a day"),
        Lasts::UntilRevoked => said!(lasts_until_you_revoke_it: "until you revoke it"),
    }
}

/// What follows from that.
pub(crate) fn lasts_says(lasts: Lasts) -> &'static str {
    match lasts {
        Lasts::Once => {
            said!(lasts_says_for_one_person_within: "For one person, within a day. They may come again until you revoke it.")
        }
        Lasts::Day => {
            said!(lasts_says_for_everybody_who_has: "For everybody who has it. After a day all of them are out.")
        }
        Lasts::UntilRevoked => said!(lasts_says_for_everybody_who_has_2: "For everybody who has it, until you end it."),
    }
}

/// Before an invitation ends.
pub(crate) fn revoke_question(here: usize) -> String {
    match here {
        0 => say!(revoke_question_its_link_stops_working: "Its link stops working, for good. Revoke it?"),
        1 => say!(revoke_question_the_person_who_is: "The person who is here by it is out at once. Revoke it?"),
        many => {
            say!(revoke_question_the_people_who_are: "The {many} people who are here by it are out at once. Revoke it?", many)
        }
    }
}

/// The button that asks that.
pub(crate) fn revoke_named(label: &str) -> String {
    say!(revoke_named: "Revoke: {label}", label)
}

/// `Ben, 3 minutes ago`
pub(crate) fn came(name: &str, when: &str) -> String {
    let name = if name.is_empty() { somebody().to_owned() } else { person_called(name) };
    listed([name.as_str(), when])
}

/// Before one takes what somebody else is editing.
pub(crate) fn take_over_question(name: &str) -> String {
    say!(take_over_question: "{name} cannot save it then; the text stays with {name}. Take it over?", name)
}

/// `Ready for Yuki: may edit, once.`
pub(crate) fn invitation_made(label: &str, role: Role, how_long: Lasts) -> String {
    let (may, lasts) = (may_short(role), lasts(how_long));
    if label.is_empty() {
        say!(invitation_made_the_link_is_ready: "The link is ready. Whoever opens it {may}. It works {lasts}.", may, lasts)
    } else {
        say!(invitation_made_the_link_for_is: "The link for {label} is ready. Whoever opens it {may}. It works {lasts}.", label, may, lasts)
    }
}
