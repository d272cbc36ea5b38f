//! The link of an editor to its server.

use crate::effect::Purpose;
use crate::request::EditorRequest;

/// Sends what an editor wants sent. The page does so over its WebSocket, and tests over links that are slow, break and lose what
/// is on its way. Whoever performs [`crate::Effect::Send`] has one, and nothing else of an editor reaches a server.
pub trait Link {
    /// Sends a request. Its answer, or its lack where the link is down or breaks, goes to [`crate::Editor::hear_answer`] with
    /// `purpose`, once. A request without a purpose is not answered, and lost where the link is down.
    fn send(&mut self, request: EditorRequest, purpose: Option<Purpose>);
}
