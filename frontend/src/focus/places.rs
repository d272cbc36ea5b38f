//! The places of the keyboard by their names: only here it is said which elements of the page they are.

use super::{all, document, focus, focusable};
use behaviour::Id;
use wasm_bindgen::JsCast;
use web_sys::{Element, HtmlElement};

/// The items of a menu, and where arrow keys stop.
const ITEM: &str = "[role^='menuitem']:not(:disabled)";
const STOP: &str = "[data-stop]";

/// A place where the keyboard can be, whether it is in the page yet or not.
#[derive(Debug)]
pub(crate) enum FocusPlace {
    /// The graph, or the list in place of it.
    Graph,
    /// The stream of the graph that Tab comes to.
    GraphStop,
    /// A stream, connector, note or group on the graph, or its row in the list.
    Part(Id),
    /// A stream, note or group on the graph.
    Shape(Id),
    /// A connector on the graph.
    Chip(Id),
    /// The control beside a connector, and the first field in it.
    Control,
    ControlField,
    /// The first item of what is offered on the graph, and the field in which more is looked for.
    Offer,
    OfferField,
    /// The button that removes the chosen stream, on the graph and in the list, and the one of its menu there.
    Remove,
    RemoveRow,
    MoreOfRow,
    /// The answer to why something happened, or not.
    Answer,
    /// While a robot is operated: a verdict, the newest mark's note, the button that marks, and the participant's code.
    Verdict,
    MarkNote,
    MarkButton,
    ParticipantCode,
    /// The first command in the dialog that lists them, and the first thing that a search in a dialog found.
    Command,
    Found,
    /// The version of the history that Tab comes to, the field for the name of one, and what goes back to one.
    Version,
    VersionName,
    GoBack,
    /// The link of a new invitation.
    InvitationLink,
    /// The title of the page that has no link and will have none.
    EndedTitle,
    /// The first of an element that Tab reaches, that arrow keys reach, or that is an item of its menu.
    First(Element),
    FirstStop(Element),
    FirstItem(Element),
    /// One of the phrases of a row, or the last one.
    Phrase(Element, usize),
    /// A child of an element by its number.
    Child(Element, u32),
}

impl FocusPlace {
    /// Returns the place of what comes in the place of an element.
    pub(crate) fn instead_of(element: &Element) -> Option<Self> {
        let around = element.parent_element()?;
        let children = around.children();
        let at = (0..children.length()).find(|at| children.item(*at).as_ref() == Some(element))?;
        Some(Self::Child(around, at))
    }

    /// Gives it the keyboard now; nothing if it is not there.
    pub(crate) fn take(&self) -> Option<HtmlElement> {
        self.element().inspect(focus)
    }

    /// The element, if it is in the page.
    pub(crate) fn element(&self) -> Option<HtmlElement> {
        let selector = match self {
            Self::First(root) => return focusable(root).into_iter().next(),
            Self::FirstStop(root) => return all(root, STOP).into_iter().next(),
            Self::FirstItem(root) => return all(root, ITEM).into_iter().next(),
            Self::Phrase(row, at) => {
                let mut phrases = all(row, ".phrase");
                phrases.truncate(at + 1);
                let phrase = phrases.pop()?;
                return all(&phrase, STOP).into_iter().next();
            }
            Self::Child(around, at) => return around.children().item(*at)?.dyn_into().ok(),
            Self::ControlField => {
                let fields = [".flyout .stepper input", ".flyout select:enabled", ".flyout .held .button.primary"];
                return fields.into_iter().find_map(first);
            }
            Self::Part(id) => return first(&marked(id, &["node", "chip", "note", "group", "row"])),
            Self::Shape(id) => return first(&marked(id, &["node", "note", "group"])),
            Self::Chip(id) => return first(&marked(id, &["chip"])),
            Self::Graph => "#stage",
            Self::GraphStop => "#stage .stream[tabindex='0']",
            Self::Control => ".flyout .control",
            Self::Offer => ".offer [role=menuitem]",
            Self::OfferField => ".offer input",
            Self::Remove => ".strip .remove > button",
            Self::RemoveRow => ".strip-inline .remove > button",
            Self::MoreOfRow => ".strip-inline .more > button",
            Self::Answer => "#why-answer",
            Self::Verdict => ".op-verdict button",
            Self::MarkNote => "#op-note",
            Self::MarkButton => ".op-mark",
            Self::ParticipantCode => "#op-code",
            Self::Command => ".commands-list .menu-item:not(:disabled)",
            Self::Found => ".dialog .found :is(.item:not([aria-disabled='true']), .menu-item:not(:disabled))",
            Self::Version => ".history [data-stop][tabindex='0']",
            Self::VersionName => "#version-name",
            Self::GoBack => "#go-back-yes",
            Self::InvitationLink => "#invitation-link",
            Self::EndedTitle => "#ended-title",
        };
        first(selector)
    }

    /// Returns true for what comes with the second piece of the page, however long that takes.
    pub(super) fn is_of_second_piece(&self) -> bool {
        matches!(
            self,
            Self::Control | Self::Offer | Self::OfferField | Self::Remove | Self::RemoveRow | Self::MoreOfRow
        )
    }
}

fn first(selector: &str) -> Option<HtmlElement> {
    document()?.query_selector(selector).ok()??.dyn_into().ok()
}

/// Selects what has an id on the graph as one of these.
fn marked(id: &Id, marks: &[&str]) -> String {
    let marks: Vec<String> = marks.iter().map(|mark| format!("[data-{mark}='{id}']")).collect();
    format!("#stage :is({})", marks.join(","))
}

#[cfg(test)]
mod tests {
    use super::{FocusPlace, marked};
    use behaviour::Id;

    #[test]
    fn what_has_an_id_is_looked_for_on_the_graph_alone() {
        let id = Id::new("a").unwrap();
        assert_eq!(marked(&id, &["node", "note"]), "#stage :is([data-node='a'],[data-note='a'])");
    }

    #[test]
    fn only_what_comes_later_waits_for_the_second_piece() {
        assert!(
            [FocusPlace::Offer, FocusPlace::Control, FocusPlace::MoreOfRow].iter().all(FocusPlace::is_of_second_piece)
        );
        assert!(![FocusPlace::Graph, FocusPlace::Answer].iter().any(FocusPlace::is_of_second_piece));
    }
}
