//! Changes that came too late: what both made, who was first, and what can be done.

sentences! {
    you_elsewhere: "You, in another window,";
    somebody: "Somebody";
    bring_back: "Bring it back";
    keep_mine: "Keep mine";
    take_theirs: "Take theirs";
    waits_elsewhere: "A change of yours in another program was not saved, as somebody was first. It waits there.";
    yours_waits: "Your change is not saved: somebody was first.";
    waits_here: "Waits here until there is a connection.";
    takes_from: "Takes from";
    not_there: "not there";
}

/// What a quick change is answered that came too late.
pub(crate) fn was_first(name: &str, what: &str) -> String {
    say!(was_first: "{name} changed {what} just before. Look at it and do yours again if you still want it.", name, what)
}

/// Said at once to who types into what somebody else has just changed.
pub(crate) fn changed_while_typing(name: &str) -> String {
    say!(changed_while_typing: "{name} changed this while you were typing. What you typed stays: save it to see both.", name)
}

/// The sentence for a change that waits while somebody else is editing the same.
pub(crate) fn waits_until_free(name: &str) -> String {
    say!(waits_until_free: "{name} is editing this. What you changed is kept, and is saved when it is free.", name)
}

/// Said at once to who types into what somebody else has just removed.
pub(crate) fn removed_while_typing(name: &str) -> String {
    say!(removed_while_typing: "{name} removed this while you were typing. What you typed is kept.", name)
}

pub(crate) fn take_of(name: &str) -> String {
    say!(take_of: "Take {name}’s", name)
}
