//! The address of a Neo4j: where it is and who we are there.

use crate::{BadAddress, StoreError};
use std::fmt;

const PASSWORD: &str = "RRP_NEO4J_PASSWORD";
const PASSWORD_FILE: &str = "RRP_NEO4J_PASSWORD_FILE";
/// The name of each scheme of Neo4j when there is one server and no cluster.
const SCHEMES: [(&str, &str); 6] = [
    ("bolt", "bolt"),
    ("bolt+s", "bolt+s"),
    ("bolt+ssc", "bolt+ssc"),
    ("neo4j", "bolt"),
    ("neo4j+s", "bolt+s"),
    ("neo4j+ssc", "bolt+ssc"),
];
const PORT: u16 = 7687;

/// An address in its parts. It shows everything but the password.
pub(super) struct Neo4jAddress {
    /// Without user and password: `bolt://127.0.0.1:7687`.
    pub(super) server: String,
    /// The user that we are.
    pub(super) user: String,
    /// The password by which we prove it.
    pub(super) password: String,
    /// The database, if it is not the default one.
    pub(super) database: Option<String>,
}

impl fmt::Debug for Neo4jAddress {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        write!(to, "{} as {}", self.server, self.user)
    }
}

impl Neo4jAddress {
    /// Reads an address; a missing password is looked for in the variables of `environment`.
    pub(super) fn read(url: &str, environment: &dyn Fn(&str) -> Option<String>) -> Result<Self, StoreError> {
        let wrong = || StoreError::Address(BadAddress::Neo4j);
        let (scheme, rest) = url.split_once("://").ok_or_else(wrong)?;
        let (_, scheme) = SCHEMES.iter().find(|(known, _)| *known == scheme).ok_or_else(wrong)?;
        let (who, place) = rest.rsplit_once('@').unwrap_or(("", rest));
        let (place, database) = place.split_once('/').unwrap_or((place, ""));
        let (user, password) = who.split_once(':').map_or((who, None), |(user, password)| (user, Some(password)));
        let (host, port) = host_and_port(place).ok_or_else(wrong)?;
        let password = match password {
            Some(password) => plain(password).ok_or_else(wrong)?,
            None => secret(environment)?,
        };
        let user = plain(if user.is_empty() { "neo4j" } else { user }).ok_or_else(wrong)?;
        let database = plain(database).ok_or_else(wrong)?;
        let database = Some(database).filter(|name| !name.is_empty());
        Ok(Self { server: format!("{scheme}://{host}:{port}"), user, password, database })
    }
}

fn host_and_port(place: &str) -> Option<(&str, u16)> {
    let has_port = place.rsplit_once(':').filter(|(_, port)| !port.ends_with(']'));
    let (host, port) = match has_port {
        Some((host, port)) => (host, port.parse().ok()?),
        None => (place, PORT),
    };
    let plain = |c: char| c.is_ascii_alphanumeric() || ".-_:[]".contains(c);
    (!host.is_empty() && host.chars().all(plain)).then_some((host, port))
}

fn secret(environment: &dyn Fn(&str) -> Option<String>) -> Result<String, StoreError> {
    if let Some(password) = environment(PASSWORD) {
        return Ok(password);
    }
    let missing = || StoreError::Address(BadAddress::NoPassword { variable: PASSWORD, of_file: PASSWORD_FILE });
    let file = environment(PASSWORD_FILE).ok_or_else(missing)?;
    let unread = |error: std::io::Error| {
        let (file, why) = (file.clone(), error.to_string());
        StoreError::Address(BadAddress::PasswordUnread { file, of_file: PASSWORD_FILE, why })
    };
    let text = std::fs::read_to_string(&file).map_err(unread)?;
    Ok(text.trim_end_matches(['\r', '\n']).to_owned())
}

/// A part of an address with every `%40` as what it stands for.
fn plain(part: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(part.len());
    let mut rest = part;
    while let Some((before, after)) = rest.split_once('%') {
        bytes.extend_from_slice(before.as_bytes());
        let digits = after.get(..2).filter(|digits| digits.bytes().all(|digit| digit.is_ascii_hexdigit()))?;
        bytes.push(u8::from_str_radix(digits, 16).ok()?);
        rest = &after[2..];
    }
    bytes.extend_from_slice(rest.as_bytes());
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::{Neo4jAddress, SCHEMES};
    use crate::StoreError;
    use crate::open::is_neo4j;

    fn read(url: &str) -> Result<Neo4jAddress, StoreError> {
        Neo4jAddress::read(url, &|name| (name == "RRP_NEO4J_PASSWORD").then(|| "from the variable".to_owned()))
    }

    fn parts(url: &str) -> (String, String, String, Option<String>) {
        let read = read(url).expect("an address");
        (read.server, read.user, read.password, read.database)
    }

    #[test]
    fn an_address_is_read_in_its_parts() {
        let text = |words: &str| words.to_owned();
        let local = text("bolt://localhost:7687");
        let from = text("from the variable");
        assert_eq!(parts("neo4j://localhost"), (local.clone(), text("neo4j"), from.clone(), None));
        assert_eq!(parts("bolt://aiko@localhost/lab"), (local.clone(), text("aiko"), from, Some(text("lab"))));
        assert_eq!(parts("bolt://a%40b:p%3A@c%25@localhost"), (local.clone(), text("a@b"), text("p:@c%"), None));
        let [secured, six] = ["neo4j+s://u:p@db.example.org:1", "bolt://u:p@[::1]:9"].map(|url| parts(url).0);
        assert_eq!((secured, six), (text("bolt+s://db.example.org:1"), text("bolt://[::1]:9")));
    }

    #[test]
    fn what_is_no_address_is_refused_without_telling_the_password() {
        for url in [
            "bolt://",
            "http://u:secret@h",
            "bolt://u:secret@h:port",
            "bolt://u:secret%4@h",
            "bolt://u:secret@h h",
            "x",
        ] {
            let refused = read(url).expect_err("no address");
            assert!(!refused.to_string().contains("secret"), "{refused}");
        }
        assert!(!format!("{:?}", read("bolt://u:secret@h").expect("an address")).contains("secret"));
    }

    #[test]
    fn the_password_may_be_in_a_file() {
        let file = tempfile::NamedTempFile::new().expect("a file");
        std::fs::write(file.path(), "in the file\n").expect("written");
        let name = file.path().display().to_string();
        let from = |variable: &str| (variable == "RRP_NEO4J_PASSWORD_FILE").then(|| name.clone());
        assert_eq!(Neo4jAddress::read("bolt://h", &from).expect("an address").password, "in the file");
        let none = Neo4jAddress::read("bolt://h", &|_| None).expect_err("no password");
        assert!(none.to_string().contains("RRP_NEO4J_PASSWORD"), "{none}");
    }

    #[test]
    fn addresses_of_neo4j_are_known_by_their_beginning() {
        assert!(SCHEMES.iter().all(|(scheme, _)| is_neo4j(&format!("{scheme}://h"))));
        assert!(!is_neo4j("sqlite:/x") && !is_neo4j("/x") && !is_neo4j("bolt:h"));
    }
}
