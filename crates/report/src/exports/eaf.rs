//! A document of ELAN (EAF 3.0): a tier each for marks, for what people and the program did, and for what went wrong. In a tier no
//! annotation overlaps another and none is without a length; all ids are of this document alone.

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesText, Event};
use recording::{Span, SpanTrack, Timeline, tracks};
use std::io;

/// The address at which ELAN finds the schema.
const SCHEMA: &str = "http://www.mpi.nl/tools/elan/EAFv3.0.xsd";
/// The only type of tier.
const TYPE: &str = "default-lt";

type To = Writer<Vec<u8>>;

/// The document.
///
/// # Errors
/// If it could not be written.
pub(super) fn written(timeline: &Timeline) -> io::Result<Vec<u8>> {
    let tracks = tracks(timeline);
    let mut to = Writer::new_with_indent(Vec::new(), b' ', 2);
    to.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let root = to.create_element("ANNOTATION_DOCUMENT").with_attributes([
        ("AUTHOR", "rrp"),
        ("DATE", timeline.header.began.as_str()),
        ("FORMAT", "3.0"),
        ("VERSION", "3.0"),
        ("xmlns:xsi", "http://www.w3.org/2001/XMLSchema-instance"),
        ("xsi:noNamespaceSchemaLocation", SCHEMA),
    ]);
    root.write_inner_content(|to| {
        let header = [("MEDIA_FILE", ""), ("TIME_UNITS", "milliseconds")];
        to.create_element("HEADER").with_attributes(header).write_empty()?;
        times(to, &tracks)?;
        let mut number = 0;
        tracks.iter().try_for_each(|track| tier(to, track, &mut number))?;
        let of_type = [("GRAPHIC_REFERENCES", "false"), ("LINGUISTIC_TYPE_ID", TYPE), ("TIME_ALIGNABLE", "true")];
        to.create_element("LINGUISTIC_TYPE").with_attributes(of_type).write_empty().map(drop)
    })?;
    Ok(to.into_inner())
}

/// Two times for each annotation, in its order.
fn times(to: &mut To, tracks: &[SpanTrack]) -> io::Result<()> {
    to.create_element("TIME_ORDER").write_inner_content(|to| {
        let spans = tracks.iter().flat_map(|track| &track.spans);
        let times = spans.flat_map(|span| [span.from_ms, span.until_ms]);
        (1_usize..).zip(times).try_for_each(|(number, ms)| {
            let (id, value) = (format!("ts{number}"), ms.to_string());
            let slot = [("TIME_SLOT_ID", id.as_str()), ("TIME_VALUE", value.as_str())];
            to.create_element("TIME_SLOT").with_attributes(slot).write_empty().map(drop)
        })
    })?;
    Ok(())
}

fn tier(to: &mut To, track: &SpanTrack, number: &mut usize) -> io::Result<()> {
    let name = plain(&track.name);
    let of = [("LINGUISTIC_TYPE_REF", TYPE), ("TIER_ID", name.as_str())];
    to.create_element("TIER").with_attributes(of).write_inner_content(|to| {
        track.spans.iter().try_for_each(|span| {
            *number += 1;
            annotation(to, span, *number)
        })
    })?;
    Ok(())
}

fn annotation(to: &mut To, span: &Span, number: usize) -> io::Result<()> {
    let by = if span.by.is_empty() { String::new() } else { format!(" ({})", span.by) };
    let (id, from, until) = (format!("a{number}"), format!("ts{}", 2 * number - 1), format!("ts{}", 2 * number));
    let of = [("ANNOTATION_ID", id.as_str()), ("TIME_SLOT_REF1", from.as_str()), ("TIME_SLOT_REF2", until.as_str())];
    to.create_element("ANNOTATION").write_inner_content(|to| {
        to.create_element("ALIGNABLE_ANNOTATION").with_attributes(of).write_inner_content(|to| {
            let says = plain(&format!("{}{by}", span.says));
            to.create_element("ANNOTATION_VALUE").write_text_content(BytesText::new(&says)).map(drop)
        })?;
        Ok(())
    })?;
    Ok(())
}

/// A text without the signs that XML cannot have.
fn plain(text: &str) -> String {
    let can_stand = |letter: &char| !letter.is_control() && !matches!(letter, '\u{fffe}' | '\u{ffff}');
    let spaced = text.chars().map(|letter| if letter.is_whitespace() { ' ' } else { letter });
    spaced.filter(can_stand).collect()
}
