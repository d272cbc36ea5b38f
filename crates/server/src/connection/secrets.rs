//! What proves who a client is: made from its id with a key of this server, so that it holds after a restart too, and
//! nothing is kept about anybody.

use crate::support::atomic_file;
use behaviour::Id;
use protocol::Credential;
use sha2::{Digest, Sha256};
use std::path::Path;
use uuid::Uuid;

/// The key, beside the store.
const FILE: &str = "people-key.json";
/// The characters of a secret, each four bits.
const SECRET_CHARS: usize = 32;

/// Makes secrets.
#[derive(Debug)]
pub(crate) struct Secrets {
    key: String,
}

impl Default for Secrets {
    /// With a key that lasts as long as they do.
    fn default() -> Self {
        Self { key: format!("{}{}", Uuid::new_v4().simple(), Uuid::new_v4().simple()) }
    }
}

impl Secrets {
    /// With the key of a data folder, which only its user can read; without a folder they last as long as the server.
    pub(crate) fn within(data: Option<&Path>) -> Self {
        let Some(path) = data.map(|data| data.join(FILE)) else { return Self::default() };
        let new = Self::default();
        if let Some(key) = atomic_file::read::<String>(&path).filter(|key| key.len() == new.key.len()) {
            return Self { key };
        }
        if let Err(error) = atomic_file::put(&path, &format!("{:?}", new.key)) {
            tracing::warn!(path = %path.display(), %error, "nobody is known again after the next start");
        }
        new
    }

    /// A new client with its secret.
    pub(crate) fn new_client(&self) -> Credential {
        let client = Id::from_uuid(Uuid::new_v4());
        Credential { secret: self.of(&client), client }
    }

    /// Whether somebody is who they say.
    pub(crate) fn proves(&self, said: &Credential) -> bool {
        let (said, made) = (said.secret.as_str().as_bytes(), self.of(&said.client));
        // As long for every guess.
        let differ = said.iter().zip(made.as_str().as_bytes()).fold(0, |differ, (said, made)| differ | (said ^ made));
        said.len() == SECRET_CHARS && differ == 0
    }

    /// Key and id have no characters in common with what would make another pair look the same.
    fn of(&self, client: &Id) -> Id {
        let digest = Sha256::new().chain_update(&self.key).chain_update("/").chain_update(client.as_str()).finalize();
        let text: String = digest.iter().map(|byte| format!("{byte:02x}")).take(SECRET_CHARS / 2).collect();
        Id::new(&text).unwrap_or_else(|_| Id::from_uuid(Uuid::new_v4()))
    }
}

#[cfg(test)]
mod tests {
    use super::{FILE, Secrets};
    use behaviour::Id;
    use protocol::Credential;

    #[test]
    fn who_somebody_is_holds_after_a_restart_and_nowhere_else() {
        let folder = tempfile::tempdir().unwrap();
        let aiko = Secrets::within(Some(folder.path())).new_client();
        let again = Secrets::within(Some(folder.path()));
        assert!(again.proves(&aiko));
        assert!(!Secrets::within(None).proves(&aiko), "another server has another key");
        let ben = again.new_client();
        assert_ne!((&ben.client, &ben.secret), (&aiko.client, &aiko.secret));
        for secret in [ben.secret.as_str(), aiko.client.as_str(), &aiko.secret.as_str()[..31], "x"] {
            let forged = Credential { client: aiko.client.clone(), secret: Id::new(secret).unwrap() };
            assert!(!again.proves(&forged), "{secret}");
        }
        let kept = std::fs::read_to_string(folder.path().join(FILE)).unwrap();
        assert!(!kept.contains(aiko.secret.as_str()));
    }

    #[test]
    fn a_key_that_cannot_be_read_is_made_anew() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(FILE), "\"short\"").unwrap();
        let aiko = Secrets::within(Some(folder.path())).new_client();
        assert!(Secrets::within(Some(folder.path())).proves(&aiko));
    }
}
