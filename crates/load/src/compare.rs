//! The test that all have the same in the end, byte by byte, and nothing that was acknowledged is lost.

use crate::patience::patiently;
use behaviour::{Behaviour, Id};
use protocol::Refused;
use shell::{Client, ClientError, Mirror};
use std::collections::BTreeMap;
use std::fmt;

/// Behaviours as they have to be: each one's revision and bytes.
pub type ExpectedBehaviours = BTreeMap<Id, (u64, Vec<u8>)>;

/// Something that must not be. [`std::fmt::Display`] says it in one English sentence.
#[derive(Clone, Debug, PartialEq)]
pub enum Wrong {
    /// Somebody has something else than the server.
    Differs {
        /// The one who has it so.
        who: String,
        /// In which behaviour.
        behaviour: Id,
        /// At which revision.
        revision: u64,
        /// The revision that the server has.
        wanted: u64,
    },
    /// An edit that was acknowledged is not there, or another one is that nobody made.
    Lost {
        /// Of which client.
        client: usize,
        /// The number of edits that were acknowledged.
        acknowledged: u64,
        /// The number of edits that are there.
        there: u64,
    },
    /// There are more or fewer changes than were acknowledged.
    Changes {
        /// In which behaviour.
        behaviour: Id,
        /// The revision that is there.
        revision: u64,
        /// The revision that should be there.
        wanted: u64,
    },
    /// An edit was refused.
    Refused {
        /// Of which client.
        client: usize,
        /// The refusal.
        no: Box<Refused>,
    },
    /// Nobody knows what became of an edit: no answer came in time.
    Unanswered {
        /// Of which client.
        client: usize,
    },
}

impl fmt::Display for Wrong {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Differs { who, behaviour, revision, wanted } => {
                write!(to, "{who} has {behaviour} at revision {revision} not as the server has it at {wanted}.")
            }
            Self::Lost { client, acknowledged, there } => {
                write!(to, "Client {client} was told that {acknowledged} edits are saved, and {there} are there.")
            }
            Self::Changes { behaviour, revision, wanted } => {
                write!(to, "{behaviour} is at revision {revision}, and at {wanted} if each edit is saved once.")
            }
            Self::Refused { client, no } => write!(to, "An edit of client {client} was refused: {no}"),
            Self::Unanswered { client } => write!(to, "An edit of client {client} was never answered."),
        }
    }
}

/// Returns a behaviour as bytes.
pub(crate) fn bytes(records: &Behaviour) -> Vec<u8> {
    serde_json::to_vec(records).unwrap_or_default()
}

/// Returns the difference between what somebody has and what they should.
pub(crate) fn differs(who: &str, has: &Mirror, known: &ExpectedBehaviours) -> Option<Wrong> {
    let (wanted, wanted_bytes) = known.get(&has.behaviour)?;
    let is_same = has.revision == *wanted && bytes(&has.records) == *wanted_bytes;
    let (who, behaviour, revision, wanted) = (who.to_owned(), has.behaviour.clone(), has.revision, *wanted);
    (!is_same).then_some(Wrong::Differs { who, behaviour, revision, wanted })
}

/// Opens behaviours as somebody who comes anew and says which are not as they have to be.
///
/// # Errors
/// If the server says no, or the link ends.
pub async fn compare(url: &str, who: &str, known: &ExpectedBehaviours) -> Result<Vec<Wrong>, ClientError> {
    let client = patiently(|| Client::connect(url, who)).await?;
    let mut wrong = Vec::new();
    for behaviour in known.keys() {
        let has = patiently(|| client.load(behaviour)).await?;
        wrong.extend(differs(who, &has, known));
    }
    Ok(wrong)
}
