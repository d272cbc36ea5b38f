//! The check of what is said of a session before it is recorded: a code that is no name.

use super::NotRecorded;
use protocol::{CODE_MAX_CHARS, RecordedSession, SESSION_MAX_CHARS};

/// Returns what was said of a session, tidied.
///
/// # Errors
/// If the code has other signs than letters, digits, `-`, `_` and `.`, or if something is too long.
pub(crate) fn checked(session: RecordedSession) -> Result<RecordedSession, NotRecorded> {
    let tidy = |text: Option<String>| text.map(|text| text.trim().to_owned()).filter(|text| !text.is_empty());
    let (participant, name) = (tidy(session.participant), tidy(session.session));
    let may_stand = |letter: char| letter.is_alphanumeric() || "-_.".contains(letter);
    let is_code = |code: &String| code.chars().count() <= CODE_MAX_CHARS && code.chars().all(may_stand);
    if !participant.as_ref().is_none_or(is_code) {
        return Err(NotRecorded::StrangeCode);
    }
    let fits = |name: &String| name.chars().count() <= SESSION_MAX_CHARS && !name.chars().any(char::is_control);
    if !name.as_ref().is_none_or(fits) {
        return Err(NotRecorded::LongSession);
    }
    Ok(RecordedSession { participant, session: name, records: session.records })
}

#[cfg(test)]
mod tests {
    use super::checked;
    use protocol::RecordedSession;

    #[test]
    fn a_code_is_no_name() {
        let code = |code: &str| {
            let session = RecordedSession { participant: Some(code.to_owned()), ..RecordedSession::default() };
            checked(session).map(|session| session.participant).map_err(|why| why.to_string())
        };
        assert_eq!(code(" C-07.b "), Ok(Some("C-07.b".to_owned())));
        assert_eq!(code("子01"), Ok(Some("子01".to_owned())));
        assert_eq!(code("  "), Ok(None));
        let why = "a code has letters, digits, “-”, “_” and “.” alone, at most 32 of them, and is no name";
        for wrong in ["Emma Smith", "a/b", &"x".repeat(33)] {
            assert_eq!(code(wrong), Err(why.to_owned()));
        }
    }
}
