//! Recordings in the forms of other programs.

mod boris;
mod csv;
mod eaf;
#[cfg(test)]
mod tests;
mod vtt;

use recording::Timeline;
use std::io;

/// The form of another program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A table for spreadsheets, with this sign between its columns.
    Csv(char),
    /// ELAN (EAF 3.0).
    Eaf,
    /// Events to paste into BORIS.
    Boris,
    /// Subtitles (WebVTT).
    Vtt,
}

impl Form {
    /// The ending of its files.
    #[must_use]
    pub fn ending(self) -> &'static str {
        match self {
            Self::Csv(_) => "csv",
            Self::Eaf => "eaf",
            Self::Boris => "boris.tsv",
            Self::Vtt => "vtt",
        }
    }

    /// The media type of its files.
    #[must_use]
    pub fn media_type(self) -> &'static str {
        match self {
            Self::Csv(_) => "text/csv; charset=utf-8",
            Self::Eaf => "application/xml",
            Self::Boris => "text/tab-separated-values; charset=utf-8",
            Self::Vtt => "text/vtt; charset=utf-8",
        }
    }

    /// The bytes of a recording in this form.
    ///
    /// # Errors
    /// If they could not be written.
    pub fn written(self, timeline: &Timeline) -> io::Result<Vec<u8>> {
        Ok(match self {
            Self::Csv(separator) => csv::written(timeline, separator).into_bytes(),
            Self::Eaf => eaf::written(timeline)?,
            Self::Boris => boris::written(timeline).into_bytes(),
            Self::Vtt => vtt::written(timeline).into_bytes(),
        })
    }
}

/// A time as `0:01:02.350`.
#[must_use]
pub fn clock(ms: u64) -> String {
    format!("{}:{:02}:{:02}.{:03}", ms / 3_600_000, ms / 60_000 % 60, ms / 1_000 % 60, ms % 1_000)
}
