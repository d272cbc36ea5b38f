//! Reading signatures.

use super::{TupleNames, ValueSignature};
use crate::malformed::Malformed;
use crate::malformed::{DEPTH_MAX, VALUES_MAX};

/// The most of a wrong signature that is repeated in an error, in bytes.
const SHOWN_MAX_BYTES: usize = 80;

impl ValueSignature {
    /// Reads one whole signature.
    ///
    /// # Errors
    /// [`Malformed::Signature`] for anything else, [`Malformed::TooDeep`] beyond [`DEPTH_MAX`].
    pub fn parse(text: &[u8]) -> Result<Self, Malformed> {
        Self::parse_within(text, DEPTH_MAX, &mut VALUES_MAX.clone())
    }

    /// Reads one whole signature of at most so many types within each other; each type is taken off `left`.
    pub(crate) fn parse_within(text: &[u8], depth: u32, left: &mut u32) -> Result<Self, Malformed> {
        let mut parser = SignatureParser { text, at: 0, left };
        let signature = parser.one(depth)?;
        if parser.at == text.len() { Ok(signature) } else { Err(parser.wrong()) }
    }
}

struct SignatureParser<'a> {
    text: &'a [u8],
    at: usize,
    left: &'a mut u32,
}

impl SignatureParser<'_> {
    fn one(&mut self, depth: u32) -> Result<ValueSignature, Malformed> {
        let deeper = depth.checked_sub(1).ok_or(Malformed::TooDeep)?;
        *self.left = self.left.checked_sub(1).ok_or(Malformed::TooMany)?;
        let letter = self.peek().ok_or_else(|| self.wrong())?;
        self.at += 1;
        Ok(match letter {
            b'[' => {
                let of = self.one(deeper)?;
                self.expect(b']')?;
                ValueSignature::list(of)
            }
            b'{' => {
                let (key, value) = (self.one(deeper)?, self.one(deeper)?);
                self.expect(b'}')?;
                ValueSignature::Map(Box::new(key), Box::new(value))
            }
            b'(' => self.tuple(deeper)?,
            b'+' => ValueSignature::Optional(Box::new(self.one(deeper)?)),
            b'#' => ValueSignature::VarArgs(Box::new(self.one(deeper)?)),
            letter => {
                let plain = ValueSignature::from_letter(letter).ok_or_else(|| self.wrong())?;
                // libqi notes the name of a type behind any of its letters.
                self.names()?;
                plain
            }
        })
    }

    fn tuple(&mut self, depth: u32) -> Result<ValueSignature, Malformed> {
        let mut fields = Vec::new();
        while self.peek().ok_or_else(|| self.wrong())? != b')' {
            fields.push(self.one(depth)?);
        }
        self.at += 1;
        Ok(ValueSignature::Tuple(fields, self.names()?))
    }

    /// `<Name,field,..>`, if it stands here. Names may hold such brackets themselves: `<std::pair<int,int>,first,second>`.
    fn names(&mut self) -> Result<Option<TupleNames>, Malformed> {
        if self.peek() != Some(b'<') {
            return Ok(None);
        }
        let (mut parts, mut part, mut open) = (Vec::new(), Vec::new(), 0u32);
        loop {
            let byte = self.peek().ok_or_else(|| self.wrong())?;
            self.at += 1;
            match byte {
                b'<' if open == 0 => open = 1,
                b'>' if open == 1 => break,
                b',' if open == 1 => {
                    // Counted, as each text is far larger than its comma.
                    *self.left = self.left.checked_sub(1).ok_or(Malformed::TooMany)?;
                    parts.push(std::mem::take(&mut part));
                }
                byte => {
                    open = if byte == b'<' { open.saturating_add(1) } else { open - u32::from(byte == b'>') };
                    part.push(byte);
                }
            }
        }
        parts.push(part);
        let mut parts = parts.into_iter().map(|part| String::from_utf8_lossy(&part).into_owned());
        let name = parts.next().unwrap_or_default();
        Ok(Some(TupleNames { name, fields: parts.collect() }))
    }

    fn peek(&self) -> Option<u8> {
        self.text.get(self.at).copied()
    }

    fn expect(&mut self, byte: u8) -> Result<(), Malformed> {
        if self.peek() != Some(byte) {
            return Err(self.wrong());
        }
        self.at += 1;
        Ok(())
    }

    fn wrong(&self) -> Malformed {
        let shown = self.text.get(..SHOWN_MAX_BYTES).unwrap_or(self.text);
        Malformed::Signature { text: String::from_utf8_lossy(shown).into_owned(), at: self.at }
    }
}
