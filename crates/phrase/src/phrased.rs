//! Types that can stand in a sentence.

use crate::{Phrase, phrase};
use std::borrow::Cow;
use std::io;

/// Something that is said in words.
pub trait Phrased {
    /// The words.
    fn phrase(&self) -> Phrase;
}

impl<T: Phrased + ?Sized> Phrased for &T {
    fn phrase(&self) -> Phrase {
        (**self).phrase()
    }
}

impl<T: Phrased + ?Sized> Phrased for Box<T> {
    fn phrase(&self) -> Phrase {
        (**self).phrase()
    }
}

impl Phrased for Phrase {
    fn phrase(&self) -> Phrase {
        self.clone()
    }
}

impl Phrased for str {
    fn phrase(&self) -> Phrase {
        Phrase::Text(self.to_owned())
    }
}

impl Phrased for String {
    fn phrase(&self) -> Phrase {
        Phrase::Text(self.clone())
    }
}

impl Phrased for Cow<'_, str> {
    fn phrase(&self) -> Phrase {
        Phrase::Text(self.clone().into_owned())
    }
}

impl Phrased for char {
    fn phrase(&self) -> Phrase {
        Phrase::Text(self.to_string())
    }
}

impl<T: Phrased> Phrased for [T] {
    fn phrase(&self) -> Phrase {
        Phrase::List(self.iter().map(Phrased::phrase).collect())
    }
}

impl<T: Phrased> Phrased for Vec<T> {
    fn phrase(&self) -> Phrase {
        self.as_slice().phrase()
    }
}

impl Phrased for std::path::Display<'_> {
    fn phrase(&self) -> Phrase {
        Phrase::Text(self.to_string())
    }
}

/// In the words of the system.
impl Phrased for io::Error {
    fn phrase(&self) -> Phrase {
        Phrase::Text(self.to_string())
    }
}

impl Phrased for io::ErrorKind {
    fn phrase(&self) -> Phrase {
        match self {
            Self::ConnectionRefused => phrase!("io.refused", "connection refused"),
            Self::ConnectionReset => phrase!("io.reset", "connection reset"),
            Self::HostUnreachable => phrase!("io.host", "host unreachable"),
            Self::NetworkUnreachable => phrase!("io.network", "network unreachable"),
            Self::TimedOut => phrase!("io.late", "timed out"),
            other => Phrase::Text(other.to_string()),
        }
    }
}

macro_rules! numbers {
    ($($kind:ty)*) => {$(
        impl Phrased for $kind {
            #[allow(clippy::cast_lossless, clippy::cast_precision_loss, reason = "numbers that are said are small")]
            fn phrase(&self) -> Phrase {
                Phrase::Number(*self as f64)
            }
        }
    )*};
}

numbers!(u8 u16 u32 u64 u128 usize i32 i64 f32 f64);
