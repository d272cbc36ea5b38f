//! Random secrets.

use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use ring::rand::{SecureRandom, SystemRandom};

/// How long a secret is, in bytes.
const SECRET_BYTES: usize = 32;

/// A secret that nobody can guess, in letters that fit into a link and a cookie; none if the system has no randomness.
pub(super) fn random() -> Option<String> {
    let mut bytes = [0; SECRET_BYTES];
    SystemRandom::new().fill(&mut bytes).ok()?;
    Some(URL_SAFE_NO_PAD.encode(bytes))
}
