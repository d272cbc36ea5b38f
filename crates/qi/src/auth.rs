//! Saying hello: what both ends can do, and user and password where they are wanted.
//!
//! From NAOqi 2.3 on it is one call to service 0. In 2.1 both ends send a message with what they can do as soon as they
//! are connected, that call is refused, and there is no login.

use std::fmt;
use std::time::Duration;

use crate::agreed::{Agreed, Generation};
use crate::error::{ConnectError, QiError};
use crate::link::{MemberTarget, QiLink};
use crate::signature::ValueSignature;
use crate::value::{Layout, Value, decode, encode};
use crate::wire::MessageKind;

const AUTHENTICATE: MemberTarget = MemberTarget { service: 0, object: 0, action: 8 };
const GREETING: MemberTarget = MemberTarget { service: 0, object: 0, action: 0 };
const STATE: &str = "__qi_auth_state";
const STATE_CONTINUE: u32 = 2;
const STATE_DONE: u32 = 3;
/// The most times that a peer may ask for one more step.
const STEPS_MAX: usize = 3;

/// User and password. Their text is in no error and no log.
#[derive(Clone, PartialEq, Eq)]
pub struct Credentials {
    /// The user.
    pub user: String,
    /// The password.
    pub password: String,
}

impl fmt::Debug for Credentials {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        to.debug_struct("Credentials").field("user", &self.user).finish_non_exhaustive()
    }
}

/// Returns our capabilities. `MetaObjectCache` would change how objects are written.
fn ours() -> Vec<(&'static str, Value)> {
    let can = [
        ("ClientServerSocket", true),
        ("MessageFlags", true),
        ("MetaObjectCache", false),
        ("ObjectPtrUID", true),
        ("RelativeEndpointURI", true),
        ("RemoteCancelableCalls", true),
    ];
    can.map(|(name, is)| (name, Value::dynamic(is))).to_vec()
}

/// Says hello on a new link.
pub(crate) async fn greet(
    link: &QiLink,
    credentials: Option<&Credentials>,
    within: Duration,
) -> Result<(), ConnectError> {
    let mut credentials = credentials.cloned();
    let mut new_token = None;
    for _ in 0..STEPS_MAX {
        let answer = match ask(link, credentials.as_ref(), within).await {
            Ok(answer) => answer,
            Err(QiError::Remote { text, .. }) => return greet_2014(link, text),
            Err(QiError::Timeout { within, .. }) => return Err(ConnectError::Timeout(within)),
            Err(other) => return Err(ConnectError::Call(Box::new(other))),
        };
        if let Some(token) = answer.get("auth_newToken").and_then(Value::as_text) {
            new_token = Some(token.into_owned());
        }
        match answer.get(STATE).and_then(Value::as_u32) {
            Some(STATE_DONE) => {
                link.agree(agreed(&answer, Generation::Authenticate, new_token));
                return Ok(());
            }
            Some(STATE_CONTINUE) => match (&new_token, &mut credentials) {
                (Some(token), Some(credentials)) => credentials.password.clone_from(token),
                _ => return Err(ConnectError::UnknownLogin),
            },
            _ => return Err(ConnectError::Refused("no reason was given".to_owned())),
        }
    }
    Err(ConnectError::UnknownLogin)
}

async fn ask(link: &QiLink, credentials: Option<&Credentials>, within: Duration) -> Result<Value, QiError> {
    let mut said = ours();
    if let Some(Credentials { user, password }) = credentials {
        said.push(("auth_user", Value::dynamic(user.as_str())));
        said.push(("auth_token", Value::dynamic(password.as_str())));
    }
    let payload = encode(&Value::map(said), &capabilities(), Layout::default())?;
    let answer = link.call(AUTHENTICATE, 0, payload, within, "authenticate").await?;
    answer.value(&capabilities(), Layout::default())
}

/// A refusal of somebody who greeted us first is no refusal: it does not know that call.
fn greet_2014(link: &QiLink, refusal: String) -> Result<(), ConnectError> {
    let Some(greeting) = link.greeting() else { return Err(ConnectError::Refused(refusal)) };
    let call = |error: QiError| ConnectError::Call(Box::new(error));
    let theirs = decode(greeting, &capabilities(), Layout::default()).map_err(|error| call(error.into()))?;
    let payload =
        encode(&Value::map(ours()), &capabilities(), Layout::default()).map_err(|error| call(error.into()))?;
    link.send(MessageKind::Capability, 0, 0, GREETING, payload).map_err(call)?;
    link.agree(agreed(&theirs, Generation::Capabilities, None));
    Ok(())
}

fn agreed(theirs: &Value, generation: Generation, new_token: Option<String>) -> Agreed {
    let can = |name: &str| theirs.get(name).and_then(Value::as_bool).unwrap_or(false);
    Agreed {
        generation,
        object_uid: can("ObjectPtrUID"),
        relative_endpoints: can("RelativeEndpointURI"),
        cancelable: can("RemoteCancelableCalls"),
        new_token,
    }
}

/// `{sm}`: names and whatever belongs to them.
fn capabilities() -> ValueSignature {
    ValueSignature::Map(Box::new(ValueSignature::Str), Box::new(ValueSignature::Dynamic))
}
