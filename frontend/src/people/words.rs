//! Sentences that only the views of people say.

pub(crate) use crate::words::*;
use protocol::{Lasts, Role};
use std::fmt::Write;

sentences! {
    you: "you";
    my_name_hint: "The others see it beside your pointer and your edits.";
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
    is_revoked_unwritten: "Revoked, but not written on the disk yet. Do not restart the server before that: free some space, and it is written by itself.";
    others_see_you: "Others see you as";
    name_not_now: "Not now";
    everyone_here: "Everyone who is here";
    warning_title: "Their browser warns once, because this server made its certificate itself. What to press there:";
    warning_device: "Their device";
    fingerprint_of: "SHA-256 fingerprint:";
    fingerprint_compare: "It is this server if all of it is the same. Colons, blanks and capitals do not count. If it differs, close the page and do not go on.";
    copy_message: "Copy the link with these steps";
}

/// Names what somebody may do, for who chooses it.
pub(crate) fn may(role: Role) -> &'static str {
    match role {
        Role::Viewer => said!(may_look: "look"),
        Role::Operator => said!(may_start_and_stop: "start and stop"),
        Role::Editor => said!(may_edit: "edit"),
        Role::Host => said!(may_do_everything: "do everything"),
    }
}

/// Says what follows from that.
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

/// Says how long, for who chooses it.
pub(crate) fn lasts(lasts: Lasts) -> &'static str {
    match lasts {
        Lasts::Once => said!(lasts_once: "once"),
        Lasts::Day => said!(lasts_for_a_day: "for a day"),
        Lasts::UntilRevoked => said!(lasts_until_you_revoke_it: "until you revoke it"),
    }
}

/// Says what follows from that.
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

/// `Ready for Yuki: may edit, once.`
pub(crate) fn invitation_made(label: &str, role: Role, how_long: Lasts) -> String {
    let (may, lasts) = (may_short(role), lasts(how_long));
    if label.is_empty() {
        say!(invitation_made_the_link_is_ready: "The link is ready. Whoever opens it {may}. It works {lasts}.", may, lasts)
    } else {
        say!(invitation_made_the_link_for_is: "The link for {label} is ready. Whoever opens it {may}. It works {lasts}.", label, may, lasts)
    }
}

/// Said once, when somebody else is here for the first time.
pub(crate) fn others_see_you_as(name: &str) -> String {
    say!(others_see_you_as: "You are not alone here. Others see you as {name}; a field for another name is below the graph.", name)
}

/// The same button while they look at the past.
pub(crate) fn follow_who_looks_back(name: &str) -> String {
    say!(follow_who_looks_back: "Follow {name}, who looks back", name)
}

/// Counts those who are here beyond the room for them.
pub(crate) fn more_people(more: usize) -> String {
    if more == 1 {
        say!(more_people_n1_more_person: "1 more person")
    } else {
        say!(more_people_more_people: "{more} more people", more)
    }
}

/// The devices that somebody comes with. Each warns in its own words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WarnedDevice {
    AppleTouch,
    Android,
    Windows,
    Mac,
}

impl WarnedDevice {
    /// All of them, the most common one with a robot first.
    pub(crate) const ALL: [Self; 4] = [Self::AppleTouch, Self::Android, Self::Windows, Self::Mac];
}

/// Names a device.
pub(crate) fn device_named(device: WarnedDevice) -> &'static str {
    match device {
        WarnedDevice::AppleTouch => said!(device_named_ipad_iphone: "iPad, iPhone"),
        WarnedDevice::Android => said!(device_named_android: "Android"),
        WarnedDevice::Windows => said!(device_named_windows: "Windows"),
        WarnedDevice::Mac => said!(device_named_mac: "Mac"),
    }
}

/// Lists what to press there, in order.
pub(crate) fn warning_steps(device: WarnedDevice, host: &str) -> Vec<String> {
    let open =
        said!(warning_steps_open_the_link_a: "Open the link. A warning comes that the connection is not private.")
            .to_owned();
    let compare = match device {
        WarnedDevice::AppleTouch => said!(
            warning_steps_press_show_details_then: "Press “Show Details”, then “view the certificate”, then “More Details”. Compare the fingerprint below, and press “Done”.",
        ),
        WarnedDevice::Mac => said!(
            warning_steps_in_safari_press_show: "In Safari press “Show Details”, then “view the certificate”. Compare the fingerprint below, and press “OK”.",
        ),
        WarnedDevice::Android | WarnedDevice::Windows => said!(
            warning_steps_press_the_sign_left: "Press the sign left of the address, then the line that says the connection is not secure, then the certificate. Compare the fingerprint below.",
        ),
    };
    let go_on = match device {
        WarnedDevice::AppleTouch | WarnedDevice::Mac => {
            said!(warning_steps_press_visit_this_website: "Press “visit this website”, and “Visit Website” once more.")
                .to_owned()
        }
        WarnedDevice::Android => {
            say!(warning_steps_press_advanced_then_proceed: "Press “Advanced”, then “Proceed to {host} (unsafe)”.", host)
        }
        WarnedDevice::Windows => {
            say!(warning_steps_press_advanced_then_continue: "Press “Advanced”, then “Continue to {host} (unsafe)”; Chrome says “Proceed to”.", host)
        }
    };
    vec![
        open,
        compare.to_owned(),
        go_on,
        said!(warning_steps_the_page_of_the: "The page of the invitation says who invites. Press “Come in”.")
            .to_owned(),
    ]
}

/// The link with its steps, as a text to send.
pub(crate) fn warning_message(device: WarnedDevice, link: &str, host: &str, fingerprint: &str) -> String {
    let mut message = format!(
        "{link}\n\n{}\n",
        said!(warning_message: "Your browser warns once, because this server made its certificate itself. What to press:")
    );
    for (at, step) in warning_steps(device, host).iter().enumerate() {
        let _ = writeln!(message, "{}. {step}", at + 1);
    }
    let _ = writeln!(message, "\n{} {fingerprint}\n{}", fingerprint_of(), fingerprint_compare());
    message
}
