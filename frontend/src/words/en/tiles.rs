//! Choosing the tiles of the operator's page.

sentences! {
    edit_tiles: "Tiles of the operator’s page";
    tiles_says: "The operator presses these, also with the keys 1 to 9. Choose one to change it.";
    tiles_are_usual: "Nobody chose tiles yet: these follow from the program. The first change makes them its own.";
    usual_tiles: "Back to the usual ones";
    usual_tiles_back: "The usual tiles are back. Undo brings yours back.";
    add_tile: "Add a tile";
    tile_does: "A press";
    tile_by_hand: "has the robot do something";
    tile_pretends: "pretends a sense";
    tile_marks: "marks the moment";
    tile_action: "Action";
    tile_sense: "Sense";
    no_sense_here: "This program has no sense. Close this and add one first.";
    sense_is_gone: "A sense that is gone";
    tile_word: "Word of the mark";
    mark_lasts: "The mark is";
    mark_moment: "a moment";
    mark_span: "a span; a second press ends it";
    tile_words: "Words on the tile";
    tile_asks: "Ask first: only a second press does it";
    tile_earlier: "Earlier";
    tile_later: "Later";
    take_tile_away: "Take away";
    back_to_tiles: "All tiles";
    decide_tile_first: "Choose one of both first.";
    tile_taken_meanwhile: "Somebody took this tile away meanwhile.";
    change_tiles: "Change the tiles …";
    tile_of: "tile";
    write_label: "Write the words that the tile shows.";
    write_word: "Write the word that the tile marks with.";
    choose_sense: "Choose the sense that the tile pretends.";
}

/// The place of a tile, which is its key.
pub(crate) fn tile_key(key: u8) -> String {
    say!(tile_key: "Key {key}", key)
}

/// The place of the tile that is edited.
pub(crate) fn tile_place(key: u8, all: u8) -> String {
    say!(tile_place: "Key {key} of {all}", key, all)
}

/// Says that somebody else changed the tile that is edited.
pub(crate) fn tile_changed_meanwhile(label: &str) -> String {
    say!(tile_changed_meanwhile: "Somebody changed this tile meanwhile. Now it is “{label}”.", label)
}

/// Says to who does not see it what became of a tile.
pub(crate) fn tile_is_saved(label: &str, key: u8) -> String {
    say!(tile_is_saved: "{label}: key {key}", label, key)
}

/// Says to who does not see it that a place is empty now.
pub(crate) fn tile_is_away(key: u8) -> String {
    say!(tile_is_away: "Key {key} is empty.", key)
}

/// In a comparison: the tile of a key.
pub(crate) fn tile_on(key: u8) -> String {
    say!(tile_on: "Tile {key}", key)
}

/// The longest words of a tile.
pub(crate) fn at_most_chars(most: usize) -> String {
    say!(at_most_chars: "At most {most} characters.", most)
}
