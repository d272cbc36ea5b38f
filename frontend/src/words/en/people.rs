//! Who is here, what they are called, and following them.

sentences! {
    people_here: "People here";
    follow: "Follow";
    end_following: "End";
}

/// The button that is somebody else's sign.
pub(crate) fn follow_person(name: &str) -> String {
    say!(follow_person: "Follow {name}", name)
}

pub(crate) fn no_longer_here(name: &str) -> String {
    say!(no_longer_here: "{name} left. You look around by yourself again.", name)
}
