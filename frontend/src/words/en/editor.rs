//! Carrying things from the list to the graph, the drawing as a picture, and names and tags in the library.

use crate::reasons::NoPicture;

sentences! {
    // From the list to the graph
    carried_here: "Let go to add it here.";
    carried_to_ground: "Drop it on the graph.";
    carried_to_stream: "Drop it on a stream.";
    carried_no_stream: "There is no stream yet that it could follow.";
    help_carry: "Drag from the list; with a finger, rest on it first";
    help_carry_says: "A sense where you drop it, an action or a helper after a stream";
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
}

/// What is carried would follow that stream.
pub(crate) fn carried_after(name: &str) -> String {
    say!(carried_after: "after {name}", name)
}

/// A helper that one stream is not enough for.
pub(crate) fn carried_takes_more(count: usize) -> String {
    match count {
        0 => say!(carried_takes_more_it_takes_no_value: "It takes no value, so it cannot follow a stream."),
        _ => {
            say!(carried_takes_more_it_takes_values_choose: "It takes {count} values. Choose it where streams are combined.", count)
        }
    }
}

/// Why there is no picture.
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
