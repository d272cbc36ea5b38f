//! The first thing that somebody says who wants TLS, read so far that the ticket in it is found. It is read again by the
//! library that agrees on TLS, so nothing is decided here about what is wrong with it.

/// The longest hello, in bytes: as long as one record may be.
const HELLO_MAX_BYTES: usize = 16 << 10;
/// A record that is part of a handshake.
const HANDSHAKE: u8 = 22;
/// A message of a handshake: the client's hello.
const CLIENT_HELLO: u8 = 1;
/// An extension: tickets of earlier connections.
const PRE_SHARED_KEY: u16 = 41;

/// A hello, as far as it tells of earlier connections.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Hello {
    /// Not all of it is there yet.
    Begun,
    /// There is no ticket in it, or it is no hello.
    Unknown,
    /// The first ticket in it: browsers show one.
    Again(Vec<u8>),
}

impl Hello {
    /// Reads what came so far.
    pub(super) fn of(bytes: &[u8]) -> Self {
        match message(bytes) {
            Ok(message) => ticket(&message).map_or(Self::Unknown, |ticket| Self::Again(ticket.to_vec())),
            Err(MissingHello::More) if bytes.len() < HELLO_MAX_BYTES => Self::Begun,
            Err(MissingHello::More | MissingHello::Hello) => Self::Unknown,
        }
    }
}

/// A reason why there is no message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum MissingHello {
    /// More has to come.
    More,
    /// It is no hello.
    Hello,
}

/// The hello, put together of as many records as it came in.
fn message(bytes: &[u8]) -> Result<Vec<u8>, MissingHello> {
    let (mut records, mut message) = (Bytes(bytes), Vec::new());
    loop {
        if let [kind, a, b, c, body @ ..] = &message[..] {
            let length = usize::from(*a) << 16 | usize::from(*b) << 8 | usize::from(*c);
            if *kind != CLIENT_HELLO || length > HELLO_MAX_BYTES {
                return Err(MissingHello::Hello);
            }
            if let Some(body) = body.get(..length) {
                return Ok(body.to_vec());
            }
        }
        let kind = records.number(1).ok_or(MissingHello::More)?;
        let major = records.number(1).ok_or(MissingHello::More)?;
        if kind != usize::from(HANDSHAKE) || major != 3 {
            return Err(MissingHello::Hello);
        }
        records.number(1).ok_or(MissingHello::More)?;
        let part = records.counted(2).ok_or(MissingHello::More)?;
        if part.is_empty() {
            return Err(MissingHello::Hello);
        }
        message.extend_from_slice(part);
    }
}

/// The first ticket of a hello. It has to stand in the last extension.
fn ticket(message: &[u8]) -> Option<&[u8]> {
    let mut hello = Bytes(message);
    let (_version, _random) = (hello.take(2)?, hello.take(32)?);
    let (_session, _suites, _compression) = (hello.counted(1)?, hello.counted(2)?, hello.counted(1)?);
    let mut extensions = Bytes(hello.counted(2)?);
    hello.ends()?;
    loop {
        let kind = extensions.number(2)?;
        let extension = extensions.counted(2)?;
        if kind == usize::from(PRE_SHARED_KEY) {
            extensions.ends()?;
            let mut shown = Bytes(extension);
            let mut tickets = Bytes(shown.counted(2)?);
            return tickets.counted(2).filter(|ticket| !ticket.is_empty());
        }
    }
}

/// What is left to read.
struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(taken)
    }

    /// A number of so many bytes.
    fn number(&mut self, bytes: usize) -> Option<usize> {
        Some(self.take(bytes)?.iter().fold(0, |number, byte| number << 8 | usize::from(*byte)))
    }

    /// Bytes after their count, which is a number of so many bytes.
    fn counted(&mut self, bytes: usize) -> Option<&'a [u8]> {
        let count = self.number(bytes)?;
        self.take(count)
    }

    fn ends(&self) -> Option<()> {
        self.0.is_empty().then_some(())
    }
}

#[cfg(test)]
mod tests {
    use super::{HELLO_MAX_BYTES, Hello};

    fn counted(bytes: usize, of: &[u8]) -> Vec<u8> {
        [&of.len().to_be_bytes()[8 - bytes..], of].concat()
    }

    /// A hello with these extensions.
    fn hello(extensions: &[(u16, Vec<u8>)]) -> Vec<u8> {
        let extensions = extensions.iter().map(|(kind, of)| [&kind.to_be_bytes()[..], &counted(2, of)].concat());
        let extensions: Vec<u8> = extensions.collect::<Vec<_>>().concat();
        let random = [&[3, 3][..], &[7; 32]].concat();
        let body =
            [random, counted(1, &[9; 32]), counted(2, &[19, 1]), counted(1, &[0]), counted(2, &extensions)].concat();
        [&[1][..], &counted(3, &body)].concat()
    }

    fn shown(tickets: &[&[u8]]) -> (u16, Vec<u8>) {
        let tickets: Vec<u8> =
            tickets.iter().map(|ticket| [&counted(2, ticket)[..], &[0; 4]].concat()).collect::<Vec<_>>().concat();
        (41, [counted(2, &tickets), counted(2, &[33; 33])].concat())
    }

    /// A message in records of so many bytes.
    fn records(message: &[u8], bytes: usize) -> Vec<u8> {
        message.chunks(bytes).map(|part| [&[22, 3, 1][..], &counted(2, part)].concat()).collect::<Vec<_>>().concat()
    }

    #[test]
    fn a_ticket_is_found_once_all_of_the_hello_is_there() {
        let message = hello(&[(0, vec![1; 40]), (43, vec![2, 3, 4]), shown(&[b"first", b"second"])]);
        for bytes in [1, 7, message.len()] {
            let whole = records(&message, bytes);
            assert_eq!(Hello::of(&whole), Hello::Again(b"first".to_vec()));
            assert_eq!(Hello::of(&[&whole[..], b"more"].concat()), Hello::Again(b"first".to_vec()));
            for cut in 0..whole.len() {
                assert_eq!(Hello::of(&whole[..cut]), Hello::Begun, "{cut} of {}", whole.len());
            }
        }
    }

    #[test]
    fn what_is_no_hello_or_has_no_ticket_is_known_at_once() {
        let whole = |extensions: &[(u16, Vec<u8>)]| records(&hello(extensions), HELLO_MAX_BYTES);
        let table = [
            b"GET / HTTP/1.1\r\n".to_vec(),
            vec![22, 2, 0],
            vec![22, 3, 1, 0, 0],
            vec![22, 3, 1, 0, 4, 2, 0, 0, 0],
            vec![22, 3, 1, 0, 4, 1, 255, 255, 255],
            whole(&[]),
            whole(&[(0, vec![])]),
            whole(&[(41, vec![])]),
            whole(&[(41, vec![255, 255, 0])]),
            whole(&[shown(&[])]),
            whole(&[shown(&[b""])]),
            whole(&[shown(&[b"first"]), (0, vec![])]),
        ];
        for bytes in table {
            assert_eq!(Hello::of(&bytes), Hello::Unknown, "{bytes:?}");
        }
        assert_eq!(Hello::of(&[]), Hello::Begun);
        let drip = records(&hello(&[(0, vec![0; HELLO_MAX_BYTES - 100])]), 1);
        assert_eq!(Hello::of(&drip[..HELLO_MAX_BYTES]), Hello::Unknown, "a hello in small pieces ends too");
    }

    #[test]
    fn no_byte_that_is_wrong_does_harm() {
        let whole = records(&hello(&[(43, vec![2, 3, 4]), shown(&[b"first"])]), 50);
        for at in 0..whole.len() {
            for wrong in [0, 1, 127, 128, 255] {
                let mut bytes = whole.clone();
                bytes[at] = wrong;
                for cut in [at, bytes.len() / 2, bytes.len()] {
                    if let Hello::Again(ticket) = Hello::of(&bytes[..cut]) {
                        assert!(ticket.len() < whole.len());
                    }
                }
            }
        }
    }
}
