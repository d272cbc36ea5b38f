//! The kind of a file, as far as its beginning tells: whoever chose another one is told so before its inside is judged.

use super::text::text_of;
use super::xml::first_name;
use phrase::{Phrase, Phrased, Word, phrase, word};
use serde::de::{DeserializeSeed, Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;
use std::fmt;

/// The most bytes of a text of which the beginning is looked at.
const LOOKED_AT_BYTES: usize = 64 << 10;

/// A kind of file other than a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// Not text at all: a picture, an archive, and others that say by their first bytes what they are.
    Binary(BinaryKind),
    /// A recording of a run, `rrp-recording`.
    Recording,
    /// Readings to replay, one a line.
    Readings,
    /// All programs of a server, `rrp-backup`.
    Backup,
    /// A part that was copied on the canvas, `rrp-part`.
    Part,
    /// A page of the web, often the one around the file that was meant.
    WebPage,
    /// A drawing of a program, or any other.
    Drawing,
    /// Of Choregraphe, with the boxes of a robot's behaviour.
    Choregraphe,
    /// Flows of Node-RED.
    NodeRed,
    /// Blocks of Scratch.
    Scratch,
    /// Blocks of Blockly, Open Roberta or Snap!.
    Blocks,
    /// A notebook of Jupyter.
    Notebook,
    /// Formatted text.
    RichText,
    /// Rows and columns.
    Table,
    /// A script.
    Script,
    /// The place of a file in Git LFS, which was not fetched.
    LfsPointer,
    /// JSON that is none of ours.
    Json,
}

phrase::shown!(FileKind);

impl Phrased for FileKind {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Binary(what) => what.phrase(),
            Self::Recording => phrase!("FileKind.a.Recording", "a recording of a run"),
            Self::Readings => phrase!("FileKind.a.Readings", "a list of readings"),
            Self::Backup => phrase!("FileKind.a.Backup", "a backup of a whole library"),
            Self::Part => phrase!("FileKind.a.Part", "a part of a program that was copied"),
            Self::WebPage => phrase!("FileKind.a.WebPage", "a web page"),
            Self::Drawing => phrase!("FileKind.a.Drawing", "a drawing (SVG)"),
            Self::Choregraphe => phrase!("FileKind.a.Choregraphe", "a Choregraphe project"),
            Self::NodeRed => phrase!("FileKind.a.NodeRed", "a file of Node-RED flows"),
            Self::Scratch => phrase!("FileKind.a.Scratch", "a Scratch project"),
            Self::Blocks => phrase!("FileKind.a.Blocks", "a file of blocks (Blockly)"),
            Self::Notebook => phrase!("FileKind.a.Notebook", "a Jupyter notebook"),
            Self::RichText => phrase!("FileKind.a.RichText", "a formatted text (RTF)"),
            Self::Table => phrase!("FileKind.a.Table", "a table (CSV)"),
            Self::Script => phrase!("FileKind.a.Script", "a script"),
            Self::LfsPointer => phrase!("FileKind.a.LfsPointer", "a pointer of Git LFS"),
            Self::Json => phrase!("FileKind.a.Json", "another kind of JSON"),
        }
    }
}

impl FileKind {
    /// Says that it is no program, and what to do.
    pub(super) fn no_program(self) -> Phrase {
        match self {
            Self::WebPage => {
                phrase!(
                    "FileKind.WebPage",
                    "This is {what}, no program of rrp. Save the file itself, not the page that shows it.",
                    what = self
                )
            }
            Self::Drawing => phrase!(
                "FileKind.Drawing",
                "This is {what}, no program of rrp. Export the program as JSON or XML.",
                what = self
            ),
            Self::Part => {
                phrase!("FileKind.Part", "This is {what}, no program of rrp. Paste it on the canvas.", what = self)
            }
            Self::Backup => phrase!(
                "FileKind.Backup",
                "This is {what}, no program of rrp. Bring it back with rrp restore.",
                what = self
            ),
            Self::Binary(BinaryKind::Packed("zip")) => {
                phrase!(
                    "FileKind.Packed",
                    "This is {what}, no program of rrp. Unpack it first, or choose another file.",
                    what = self
                )
            }
            _ => phrase!("FileKind.Other", "This is {what}, no program of rrp. Choose another file.", what = self),
        }
    }

    /// The kind of a file that is no program; none if it may be one, or if nobody knows.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Option<Self> {
        binary(bytes).map(Self::Binary).or_else(|| {
            let text = text_of(beginning(bytes)).ok()?.trim_start();
            match text.as_bytes().first()? {
                b'<' => of_markup(text),
                b'{' | b'[' => of_json(text),
                _ => of_text(text),
            }
        })
    }
}

/// A kind of file that is not text. The names of formats are the same in every language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BinaryKind {
    /// A picture of this format.
    Picture(&'static str),
    /// Files that were packed in this format.
    Packed(&'static str),
    /// A sound of this format.
    Audio(&'static str),
    /// A film of this format.
    Film(&'static str),
    /// Another file, which has no format to tell.
    Other(Word),
}

impl Phrased for BinaryKind {
    fn phrase(&self) -> Phrase {
        match self {
            Self::Picture(format) => phrase!("FileKind.Picture", "a picture ({format})"),
            Self::Packed(format) => phrase!("FileKind.PackedFile", "a packed file ({format})"),
            Self::Audio(format) => phrase!("FileKind.Sound", "a sound ({format})"),
            Self::Film(format) => phrase!("FileKind.Film", "a film ({format})"),
            Self::Other(word) => word.phrase(),
        }
    }
}

const SOUND_OR_FILM: BinaryKind = BinaryKind::Other(word!("FileKind.SoundOrFilm", "a sound or film"));

/// First bytes that say what a file is.
const BINARY: [(&[u8], BinaryKind); 22] = [
    (b"\x89PNG\r\n", BinaryKind::Picture("PNG")),
    (b"\xff\xd8\xff", BinaryKind::Picture("JPEG")),
    (b"GIF8", BinaryKind::Picture("GIF")),
    (b"BM", BinaryKind::Picture("BMP")),
    (b"II*\0", BinaryKind::Picture("TIFF")),
    (b"MM\0*", BinaryKind::Picture("TIFF")),
    (b"%PDF", BinaryKind::Other(word!("FileKind.Pdf", "a PDF"))),
    (b"PK\x03\x04", BinaryKind::Packed("zip")),
    (b"PK\x05\x06", BinaryKind::Packed("zip")),
    (b"\x1f\x8b", BinaryKind::Packed("gzip")),
    (b"7z\xbc\xaf\x27\x1c", BinaryKind::Packed("7z")),
    (b"Rar!", BinaryKind::Packed("rar")),
    (b"BZh", BinaryKind::Packed("bzip2")),
    (b"\xfd7zXZ", BinaryKind::Packed("xz")),
    (b"SQLite format 3\0", BinaryKind::Other(word!("FileKind.Database", "a database (SQLite)"))),
    (b"\xd0\xcf\x11\xe0", BinaryKind::Other(word!("FileKind.OldOffice", "a document of an older Office"))),
    (b"OggS", SOUND_OR_FILM),
    (b"ID3", BinaryKind::Audio("MP3")),
    (b"fLaC", BinaryKind::Audio("FLAC")),
    (b"\x1aE\xdf\xa3", BinaryKind::Film("Matroska")),
    (b"\x7fELF", BinaryKind::Other(word!("FileKind.LinuxProgram", "a program for Linux"))),
    (b"MZ", BinaryKind::Other(word!("FileKind.WindowsProgram", "a program for Windows"))),
];

fn binary(bytes: &[u8]) -> Option<BinaryKind> {
    let is_text = |beginning: &[u8]| beginning.is_ascii() && !beginning.contains(&0);
    // Two or three letters may begin a text as well.
    let all_text = is_text(beginning(bytes));
    let known = BINARY.iter().find(|(first, _)| bytes.starts_with(first) && (first.len() > 3 || !all_text));
    known.map(|(_, what)| *what).or_else(|| match (bytes.get(..4)?, bytes.get(4..12)?) {
        (b"RIFF", rest) if rest.ends_with(b"WAVE") => Some(BinaryKind::Audio("WAV")),
        (b"RIFF", rest) if rest.ends_with(b"WEBP") => Some(BinaryKind::Picture("WebP")),
        (b"RIFF", _) => Some(SOUND_OR_FILM),
        (_, rest) if rest.starts_with(b"ftyp") => Some(SOUND_OR_FILM),
        _ => None,
    })
}

/// The first part of it, which ends between two characters.
fn beginning(bytes: &[u8]) -> &[u8] {
    let most = bytes.len().min(LOOKED_AT_BYTES);
    if most == bytes.len() {
        return bytes;
    }
    let within = |at: &usize| bytes.get(*at).is_none_or(|byte| (byte & 0xC0) != 0x80);
    let end = (most.saturating_sub(3)..=most).rev().find(within).unwrap_or(most);
    &bytes[..end]
}

/// Finds the kind of markup by the first element, or by what is said before it.
fn of_markup(text: &str) -> Option<FileKind> {
    if text.get(..14).is_some_and(|first| first.eq_ignore_ascii_case("<!doctype html")) {
        return Some(FileKind::WebPage);
    }
    let (_, name) = first_name(text)?;
    of_element(name.rsplit(':').next().unwrap_or_default())
}

/// Finds the kind by the first element. The name of another element is told by who reads the whole.
fn of_element(name: &str) -> Option<FileKind> {
    match name.to_ascii_lowercase().as_str() {
        "html" | "head" | "body" => Some(FileKind::WebPage),
        "svg" => Some(FileKind::Drawing),
        "choregrapheproject" => Some(FileKind::Choregraphe),
        "xml" | "export" | "block" | "block_set" | "blockset" => Some(FileKind::Blocks),
        _ => None,
    }
}

/// Finds the kind of JSON by the names in its first object: a program is never a list, and has some of its own fields.
fn of_json(text: &str) -> Option<FileKind> {
    if text.starts_with("{\\rtf") {
        return Some(FileKind::RichText);
    }
    let is_list = text.starts_with('[');
    let first = fields(text.trim_start_matches(['[', ' ', '\t', '\r', '\n']));
    let has = |names: &[&str]| names.iter().all(|name| first.iter().any(|(known, _)| known == name));
    let format = first.iter().find(|(name, _)| name == "format").map_or("", |(_, format)| format.as_str());
    match format.split('/').next().unwrap_or_default() {
        "rrp-recording" => return Some(FileKind::Recording),
        "rrp-part" => return Some(FileKind::Part),
        "rrp-behaviour" if !is_list => return None,
        _ => {}
    }
    match () {
        () if has(&["start"]) && text.starts_with("{\"start\":{\"format\":\"rrp-backup/") => Some(FileKind::Backup),
        () if has(&["t", "stream"]) => Some(FileKind::Readings),
        () if has(&["targets", "meta"]) || has(&["objName", "children"]) => Some(FileKind::Scratch),
        () if has(&["cells", "nbformat"]) => Some(FileKind::Notebook),
        () if has(&["blocks", "variables"]) => Some(FileKind::Blocks),
        () if has(&["flows", "rev"]) || (is_list && has(&["id", "type"])) => Some(FileKind::NodeRed),
        () if !is_list && OWN.iter().any(|name| has(&[name])) => None,
        () => Some(FileKind::Json),
    }
}

/// Fields by which a program is known, however much of it is missing.
const OWN: [&str; 7] = ["format", "streams", "connectors", "helpers", "layout", "notes", "groups"];

/// The names and texts in the object that a text begins with, as far as it can be read; none if that is no object.
fn fields(text: &str) -> Vec<(String, String)> {
    let mut all = Vec::new();
    if text.starts_with('{') {
        // What is cut off or broken is judged by who reads the whole.
        let _ = ObjectNames(&mut all).deserialize(&mut serde_json::Deserializer::from_str(text));
    }
    all
}

/// Reads the names of an object, and its values where they are texts.
struct ObjectNames<'a>(&'a mut Vec<(String, String)>);

impl<'t> DeserializeSeed<'t> for ObjectNames<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'t>>(self, from: D) -> Result<(), D::Error> {
        from.deserialize_map(self)
    }
}

impl<'t> Visitor<'t> for ObjectNames<'_> {
    type Value = ();

    fn expecting(&self, words: &mut fmt::Formatter) -> fmt::Result {
        words.write_str("an object")
    }

    fn visit_map<A: MapAccess<'t>>(self, mut map: A) -> Result<(), A::Error> {
        while let Some(name) = map.next_key::<String>()? {
            self.0.push((name, String::new()));
            let value: &RawValue = map.next_value()?;
            if let (Some((_, text)), Ok(said)) = (self.0.last_mut(), serde_json::from_str(value.get())) {
                *text = said;
            }
        }
        Ok(())
    }
}

/// Finds the kind by the first lines of other text.
fn of_text(text: &str) -> Option<FileKind> {
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let first = lines.next()?;
    if first.starts_with("version https://git-lfs") {
        return Some(FileKind::LfsPointer);
    }
    let is_script = first.starts_with("#!") || ["import ", "from ", "def "].iter().any(|word| first.starts_with(word));
    if is_script {
        return Some(FileKind::Script);
    }
    let columns = |line: &str, by: char| line.matches(by).count();
    let second = lines.next()?;
    let in_columns = |by: &char| columns(first, *by) > 0 && columns(first, *by) == columns(second, *by);
    [',', ';', '\t'].iter().any(in_columns).then_some(FileKind::Table)
}

#[cfg(test)]
mod tests {
    use super::FileKind;
    use crate::files::{look, samples::templates};

    /// Returns what is said of a file, without its place.
    fn said(bytes: &[u8]) -> String {
        let looked = look(bytes);
        assert!(looked.file.is_none());
        looked.faults.iter().map(|fault| fault.reason.to_string()).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn another_kind_of_file_is_named_before_its_inside_is_judged() {
        let deep = format!(
            "<ChoregrapheProject xmlns=\"x\">{}{}</ChoregrapheProject>",
            "<Box>".repeat(20),
            "</Box>".repeat(20)
        );
        let table: [(&[u8], &str); 27] = [
            (deep.as_bytes(), "a Choregraphe project"),
            (
                b"\xef\xbb\xbf<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<ChoregrapheProject/>",
                "a Choregraphe project",
            ),
            (b"<!DOCTYPE html>\n<html><head></head></html>", "a web page"),
            (b"\n <html lang=en><p>no end", "a web page"),
            (b"[{\"id\":\"a1\",\"type\":\"tab\",\"label\":\"Flow\"}]", "a file of Node-RED flows"),
            (b"{\"targets\":[],\"monitors\":[],\"meta\":{}}", "a Scratch project"),
            (b"<xml xmlns=\"https://developers.google.com/blockly/xml\"><block/></xml>", "a file of blocks"),
            (b"{\"cells\":[],\"metadata\":{},\"nbformat\":4}", "a Jupyter notebook"),
            (b"<svg xmlns=\"http://www.w3.org/2000/svg\"></svg>", "a drawing (SVG)"),
            (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "a picture (PNG)"),
            (b"\xff\xd8\xff\xe0\0\x10JFIF", "a picture (JPEG)"),
            (b"PK\x03\x04\x14\0\0\0", "a packed file (zip)"),
            (b"\x1f\x8b\x08\0\0\0\0\0", "a packed file (gzip)"),
            (b"%PDF-1.7\n%\xe2\xe3", "a PDF"),
            (b"SQLite format 3\0\x10\0", "a database (SQLite)"),
            (b"RIFF\x24\0\0\0WAVEfmt ", "a sound (WAV)"),
            (b"{\\rtf1\\ansi Hello}", "a formatted text (RTF)"),
            (b"{\"format\":\"rrp-recording/1\",\"name\":\"P\"}\n{\"t\":0}\n", "a recording of a run"),
            (b"{\"t\":0,\"stream\":\"s\",\"value\":1}\n{\"t\":9,\"stream\":\"s\",\"value\":1}", "a list of readings"),
            (b"{\"start\":{\"format\":\"rrp-backup/1\",\"epoch\":3}}\n", "a backup of a whole library"),
            (b"{\"format\":\"rrp-part/1\",\"records\":{}}", "a part of a program"),
            (b"{\"name\":\"x\",\"dependencies\":{}}", "another kind of JSON"),
            (b"[1, 2, 3]", "another kind of JSON"),
            (b"t,stream,value\n0,s,1\n", "a table (CSV)"),
            (b"#!/usr/bin/env python3\nprint(1)\n", "a script"),
            (b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n", "a pointer of Git LFS"),
            (b"BM\x36\0\0\0\0\0", "a picture (BMP)"),
        ];
        for (bytes, what) in table {
            let said = said(bytes);
            assert!(
                said.starts_with(&format!("This is {what}")) && said.contains("no program of rrp"),
                "{what}: {said}"
            );
        }
    }

    #[test]
    fn an_unknown_element_is_named_however_its_inside_is() {
        let deep = format!("<plan>{}{}</plan>", "<a>".repeat(20), "</a>".repeat(20));
        for text in [deep, "<plan><a></plan>".to_owned(), "<!DOCTYPE plan><plan/>".to_owned()] {
            assert_eq!(said(text.as_bytes()), "This is no program but <plan>. Choose another file.");
        }
    }

    #[test]
    fn what_may_be_a_program_is_none_of_them() {
        for (name, text) in templates() {
            assert_eq!(FileKind::of(text.as_bytes()), None, "{name}");
            assert_eq!(FileKind::of(&text.as_bytes()[..text.len() / 2]), None, "{name}, cut off");
        }
        let others: [&[u8]; 5] =
            [b"", b"MZ is text, too", b"<behaviour format=\"1\">", b"{\"format\":\"other/1\"}", b"name: x"];
        assert_eq!(others.map(FileKind::of), [None; 5]);
    }

    #[test]
    fn a_long_file_is_known_by_its_beginning() {
        let long = format!("<html><p>{}", "あ".repeat(100_000));
        assert_eq!(FileKind::of(long.as_bytes()), Some(FileKind::WebPage));
    }
}
