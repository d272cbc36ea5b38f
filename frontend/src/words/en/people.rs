//! Who is here, what they are called, and following them.

sentences! {
    others_see_you: "Others see you as";
    name_not_now: "Not now";
    people_here: "People here";
    everyone_here: "Everyone who is here";
    follow: "Follow";
    end_following: "End";
    how_following_ends: "Press Escape or touch the graph to end.";
}

/// Said once, when somebody else is here for the first time.
pub(crate) fn others_see_you_as(name: &str) -> String {
    say!(others_see_you_as: "You are not alone here. Others see you as {name}; a field for another name is below the graph.", name)
}

/// The button that is somebody else's sign.
pub(crate) fn follow_person(name: &str) -> String {
    say!(follow_person: "Follow {name}", name)
}

/// The same button while they look at the past.
pub(crate) fn follow_who_looks_back(name: &str) -> String {
    say!(follow_who_looks_back: "Follow {name}, who looks back", name)
}

pub(crate) fn following(name: &str) -> String {
    say!(following: "Following {name}", name)
}

pub(crate) fn following_said(name: &str) -> String {
    say!(following_said: "Following {name}. Press Escape to end.", name)
}

pub(crate) fn no_longer_here(name: &str) -> String {
    say!(no_longer_here: "{name} left. You look around by yourself again.", name)
}

/// How many more are here than there is room for.
pub(crate) fn more_people(more: usize) -> String {
    if more == 1 {
        say!(more_people_n1_more_person: "1 more person")
    } else {
        say!(more_people_more_people: "{more} more people", more)
    }
}
