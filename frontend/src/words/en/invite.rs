//! What people may do, and letting others in.

use protocol::Role;

sentences! {
    invite: "Invite";
    look_at_it: "Look at it";
    leave_it: "Leave it";
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
