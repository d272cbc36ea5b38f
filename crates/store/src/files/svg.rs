//! The drawing of a behaviour as a picture that needs nothing else: shapes and colours as in the thesis.

mod layout;
mod shapes;

use behaviour::BehaviourFile;
use layout::SvgDrawing;

/// The drawing as SVG, readable on white paper. Names and bodies are only ever text in it.
#[must_use]
pub fn write_svg(file: &BehaviourFile) -> String {
    let drawing = SvgDrawing::of(file);
    let (left, top, width, height) = drawing.bounds();
    let mut lines = vec![
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-labelledby=\"title summary\" \
             viewBox=\"{left:.0} {top:.0} {width:.0} {height:.0}\" width=\"{width:.0}\" height=\"{height:.0}\" \
             font-family=\"Inter, 'Noto Sans', 'Noto Sans CJK JP', system-ui, sans-serif\" font-size=\"15\">"
        ),
        format!("<title id=\"title\">{}</title>", shapes::text(&file.name)),
        format!("<desc id=\"summary\">{}</desc>", summary(file)),
        format!(
            "<rect x=\"{left:.0}\" y=\"{top:.0}\" width=\"{width:.0}\" height=\"{height:.0}\" fill=\"{}\"/>",
            shapes::PAPER
        ),
    ];
    lines.extend(drawing.groups.iter().map(|(group, frame)| shapes::group(group, *frame)));
    lines.extend(drawing.edges().into_iter().map(|(from, to)| shapes::edge(from, to)));
    lines.extend(drawing.notes.iter().map(|(note, corner)| shapes::note(note, *corner)));
    lines.extend(drawing.streams.iter().map(|(stream, top)| shapes::stream(stream, *top)));
    lines.extend(drawing.chips.iter().map(|chip| shapes::chip(&chip.label, chip.middle)));
    lines.push("</svg>\n".to_owned());
    lines.join("\n")
}

/// Writes the summary that a screen reader says after the name.
fn summary(file: &BehaviourFile) -> String {
    let count = |many: usize, one: &str| format!("{many} {one}{}", if many == 1 { "" } else { "s" });
    let (streams, connectors) = (count(file.streams.len(), "stream"), count(file.connectors.len(), "connector"));
    format!("A robot program with {streams} and {connectors}. Values flow from top to bottom.")
}

#[cfg(test)]
mod tests {
    use super::write_svg;
    use crate::files::samples::{any_file, templates};
    use behaviour::BehaviourFile;
    use proptest::prelude::*;
    use quick_xml::events::Event;

    /// The names of all elements and all texts in the picture; panics unless it is well-formed.
    fn parts(svg: &str) -> (Vec<String>, Vec<String>) {
        let (mut names, mut texts, mut text) = (Vec::new(), Vec::new(), String::new());
        let mut reader = quick_xml::Reader::from_str(svg);
        loop {
            match reader.read_event().expect("well-formed") {
                Event::Start(start) | Event::Empty(start) => {
                    for attribute in start.attributes() {
                        let key = attribute.expect("an attribute").key;
                        assert!(!key.as_ref().starts_with(b"on") && !key.as_ref().ends_with(b"href"), "{svg}");
                    }
                    names.push(String::from_utf8_lossy(start.name().as_ref()).into_owned());
                    text.clear();
                }
                Event::Text(part) => text.push_str(&part.decode().expect("UTF-8")),
                Event::GeneralRef(name) => {
                    let name = name.decode().expect("UTF-8").into_owned();
                    text.push(crate::files::xml::reference(&name).expect("a known reference"));
                }
                Event::End(_) => texts.push(std::mem::take(&mut text)),
                Event::Eof => return (names, texts),
                other => panic!("{other:?} has no place in a picture"),
            }
        }
    }

    fn check(file: &BehaviourFile) {
        const KNOWN: [&str; 9] = ["svg", "title", "desc", "rect", "ellipse", "path", "text", "tspan", "g"];
        let (names, texts) = parts(&write_svg(file));
        assert!(names.iter().all(|name| KNOWN.contains(&name.as_str())), "{names:?}");
        let many = |name: &str| names.iter().filter(|one| *one == name).count();
        let shown = file.streams.len() + file.connectors.len();
        let lines: usize = file.notes.iter().map(|note| super::shapes::note_lines(&note.text).len()).sum();
        let is_there = |id: &String| file.streams.iter().any(|stream| stream.id == *id);
        let groups = file.groups.iter().filter(|group| group.streams.iter().any(is_there)).count();
        assert_eq!(many("text"), shown + lines + groups, "one text each");
        for stream in &file.streams {
            let name = super::shapes::one_line(&stream.name);
            let same = file.streams.iter().filter(|other| super::shapes::one_line(&other.name) == name).count();
            let found = texts.iter().filter(|text| **text == name).count();
            assert!(found >= same, "{name:?} is missing in {texts:?}");
        }
    }

    #[test]
    fn every_stream_and_connector_of_the_templates_is_shown_once() {
        for (name, text) in templates() {
            let file = crate::files::read(text.as_bytes()).expect("a template");
            check(&file);
            let svg = write_svg(&file);
            for stream in &file.streams {
                assert_eq!(svg.matches(&format!(">{}</text>", stream.name)).count(), 1, "{name}: {}", stream.name);
            }
            for connector in &file.connectors {
                let label = super::shapes::text(&super::layout::label(connector));
                let same = file.connectors.iter().filter(|c| super::shapes::text(&super::layout::label(c)) == label);
                assert_eq!(svg.matches(&format!(">{label}</text>")).count(), same.count(), "{name}: {label}");
            }
        }
    }

    #[test]
    fn no_label_of_a_template_covers_another() {
        for (name, text) in templates() {
            let file = crate::files::read(text.as_bytes()).expect("a template");
            let drawing = super::layout::SvgDrawing::of(&file);
            for (at, one) in drawing.chips.iter().enumerate() {
                for other in &drawing.chips[at + 1..] {
                    let wide = super::shapes::chip_width(&one.label) + super::shapes::chip_width(&other.label);
                    let apart = (one.middle.0 - other.middle.0).abs() * 2.0 >= wide;
                    let above = (one.middle.1 - other.middle.1).abs() >= super::shapes::CHIP_HEIGHT;
                    assert!(apart || above, "{name}: {} {}", one.label, other.label);
                }
            }
        }
    }

    #[test]
    fn without_places_values_still_flow_downwards_and_nothing_overlaps() {
        for (name, text) in templates() {
            let mut file = crate::files::read(text.as_bytes()).expect("a template");
            file.layout.clear();
            let drawing = super::layout::SvgDrawing::of(&file);
            for (from, to) in drawing.edges() {
                assert!(from.1 < to.1, "{name}: {from:?} {to:?}");
            }
            for (at, (one, a)) in drawing.streams.iter().enumerate() {
                for (other, b) in &drawing.streams[at + 1..] {
                    let apart = (a.0 - b.0).abs() * 2.0 >= super::shapes::width(one) + super::shapes::width(other);
                    assert!(
                        apart || (a.1 - b.1).abs() >= behaviour::layout::STREAM_HEIGHT,
                        "{name}: {} {}",
                        one.name,
                        other.name
                    );
                }
            }
        }
    }

    proptest! {
        #[test]
        fn whatever_the_names_the_picture_holds_only_shapes_and_text(file in any_file()) {
            check(&file);
        }
    }
}
