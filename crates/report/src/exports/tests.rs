//! A recording in the forms of other programs, each read again by its own rules.

use super::{boris, csv, eaf, vtt};
use quick_xml::Reader;
use quick_xml::events::Event;
use recording::{PrivateParts, Timeline, timeline};
use std::collections::{BTreeMap, BTreeSet};

/// Names that stand in the recording: of who pressed, of a face, and a word that was recognised.
const NAMES: [&str; 6] = ["Aiko", "Ben", "Cleo", "Emma", "banana", "hello Emma"];

const RECORDING: &str = include_str!("../../tests/data/greet.jsonl");
const MARKS: &str = include_str!("../../tests/data/greet.marks.jsonl");

fn told(keep: PrivateParts) -> Timeline {
    timeline(RECORDING, MARKS, keep).unwrap()
}

/// Every form of a recording, as a text.
fn all_forms(of: &Timeline) -> Vec<(&'static str, String)> {
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    vec![
        ("csv", csv::written(of, ',')),
        ("csv;", csv::written(of, ';')),
        ("eaf", text(eaf::written(of).unwrap())),
        ("boris", boris::written(of)),
        ("vtt", vtt::written(of)),
    ]
}

#[test]
fn no_name_is_in_any_of_them_unless_it_is_wanted() {
    for (form, text) in all_forms(&told(PrivateParts::default())) {
        for name in NAMES {
            assert!(!text.contains(name), "{name} is in {form}:\n{text}");
        }
        assert!(text.contains("P1") && text.contains("(left out)"), "{form}:\n{text}");
    }
    let all = told(PrivateParts { names: true, personal: true });
    let csv = csv::written(&all, ',');
    assert!(NAMES.iter().all(|name| csv.contains(name)), "{csv}");
    let old = RECORDING.replacen("rrp-recording/2", "rrp-recording/1", 1);
    let old: String = old.lines().filter(|line| !line.contains("\"file\"")).map(|line| format!("{line}\n")).collect();
    let csv = csv::written(&timeline(&old, "", PrivateParts::default()).unwrap(), ',');
    assert!(
        NAMES.iter().all(|name| !csv.contains(name)),
        "an old recording does not say which texts are personal: {csv}"
    );
}

/// The rows of a CSV, as a spreadsheet reads them.
fn rows(text: &str, separator: char) -> Vec<Vec<String>> {
    let (mut rows, mut row, mut field, mut quoted) = (Vec::new(), Vec::new(), String::new(), false);
    let mut letters = text.strip_prefix('\u{feff}').expect("it begins with the mark of UTF-8").chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '"' if quoted && letters.peek() == Some(&'"') => field.extend(letters.next()),
            '"' => quoted = !quoted,
            letter if letter == separator && !quoted => row.push(std::mem::take(&mut field)),
            '\n' if !quoted => {
                row.push(std::mem::take(&mut field).trim_end_matches('\r').to_owned());
                rows.push(std::mem::take(&mut row));
            }
            letter => field.push(letter),
        }
    }
    rows
}

#[test]
fn a_table_is_the_same_with_commas_and_with_semicolons() {
    let of = told(PrivateParts::default());
    let table = rows(&csv::written(&of, ','), ',');
    assert_eq!(table, rows(&csv::written(&of, ';'), ';'));
    assert_eq!(table[0], ["t_ms", "clock", "what", "subject", "value", "by", "until_ms", "verdict"]);
    assert!(table.iter().all(|row| row.len() == 8));
    assert!(table[1..].iter().all(|row| row[0].parse::<u64>().is_ok() && !row[0].contains(['.', ','])));
    let has = |row: [&str; 8]| assert!(table.iter().any(|known| known == &row), "{row:?} is not in {table:#?}");
    has(["50", "0:00:00.050", "pretended", "Ball", r#"{"x":0.1}"#, "P4", "", ""]
        .map(|field| if field == "P4" { code(&of, "Ball") } else { field }));
    has(["10", "0:00:00.010", "action", "Say, \"loud\"", "(left out)", "", "", ""]);
    has(["3000", "0:00:03.000", "by hand", "SayInput", "'=1+1; <b>--> & \"so\"", code(&of, "SayInput"), "", ""]);
    has(["1000", "0:00:01.000", "mark", "laughs", "", code(&of, "SayInput"), "1500", "good"]);
}

/// Returns the name or code of the one who did something with `subject`; empty if nobody did.
fn code<'t>(of: &'t Timeline, subject: &str) -> &'t str {
    let event = of.events.iter().find(|event| event.subject == subject && !event.by.is_empty());
    event.map_or("", |event| event.by.as_str())
}

/// The rules of the schema of EAF 3.0 for what is written of it.
#[test]
fn a_document_of_elan_keeps_to_its_schema() {
    let bytes = eaf::written(&told(PrivateParts::default())).unwrap();
    let mut reader = Reader::from_reader(&bytes[..]);
    let (mut path, mut order, mut ids) = (Vec::<String>::new(), Vec::new(), BTreeSet::new());
    let (mut times, mut annotations, mut tier) =
        (BTreeMap::new(), BTreeMap::<String, Vec<(u64, u64)>>::new(), String::new());
    loop {
        let (event, is_empty) = match reader.read_event().unwrap() {
            Event::Eof => break,
            Event::End(_) => {
                path.pop();
                continue;
            }
            Event::Start(start) => (start.into_owned(), false),
            Event::Empty(start) => (start.into_owned(), true),
            _ => continue,
        };
        let name = String::from_utf8(event.name().as_ref().to_vec()).unwrap();
        let all: BTreeMap<String, String> = event
            .attributes()
            .map(|one| {
                let one = one.unwrap();
                let key = String::from_utf8(one.key.as_ref().to_vec()).unwrap();
                (key, one.unescape_value().unwrap().into_owned())
            })
            .collect();
        let under = path.last().map_or("", String::as_str);
        let may_stand_under = match name.as_str() {
            "ANNOTATION_DOCUMENT" => "",
            "HEADER" | "TIME_ORDER" | "TIER" | "LINGUISTIC_TYPE" => "ANNOTATION_DOCUMENT",
            "TIME_SLOT" => "TIME_ORDER",
            "ANNOTATION" => "TIER",
            "ALIGNABLE_ANNOTATION" => "ANNOTATION",
            "ANNOTATION_VALUE" => "ALIGNABLE_ANNOTATION",
            other => panic!("{other} is not in the schema as we know it"),
        };
        assert_eq!(under, may_stand_under, "{name}");
        match name.as_str() {
            "ANNOTATION_DOCUMENT" => {
                assert_eq!((all["FORMAT"].as_str(), all["VERSION"].as_str()), ("3.0", "3.0"));
                assert_eq!(all["DATE"], "2026-11-21T18:34:06Z");
                assert!(all.contains_key("AUTHOR") && all["xsi:noNamespaceSchemaLocation"].ends_with("EAFv3.0.xsd"));
            }
            "TIME_SLOT" => {
                assert!(ids.insert(all["TIME_SLOT_ID"].clone()), "ids are unique");
                times.insert(all["TIME_SLOT_ID"].clone(), all["TIME_VALUE"].parse::<u64>().unwrap());
            }
            "TIER" => {
                tier = all["TIER_ID"].clone();
                assert!(
                    annotations.insert(tier.clone(), Vec::new()).is_none(),
                    "tiers have names of their own: {tier}"
                );
                assert_eq!(all["LINGUISTIC_TYPE_REF"], "default-lt");
            }
            "ALIGNABLE_ANNOTATION" => {
                assert!(ids.insert(all["ANNOTATION_ID"].clone()), "ids are unique");
                let span = (times[&all["TIME_SLOT_REF1"]], times[&all["TIME_SLOT_REF2"]]);
                annotations.get_mut(&tier).unwrap().push(span);
            }
            "LINGUISTIC_TYPE" => assert_eq!(all["LINGUISTIC_TYPE_ID"], "default-lt"),
            _ => {}
        }
        if under == "ANNOTATION_DOCUMENT" {
            order
                .push(["HEADER", "TIME_ORDER", "TIER", "LINGUISTIC_TYPE"].iter().position(|one| *one == name).unwrap());
        }
        if !is_empty {
            path.push(name);
        }
    }
    assert!(order.is_sorted() && order.contains(&3), "elements come in the order of the schema: {order:?}");
    assert_eq!(
        annotations["action: Eyes"],
        [(100, 900), (2_900, 2_901), (2_901, 3_400)],
        "bars are joined below a second"
    );
    let laughs = ["mark: laughs", "mark: laughs 2"].map(|tier| annotations[tier][0]);
    assert_eq!(laughs, [(1_000, 1_500), (1_000, 2_500)], "marks that overlap stand on two tiers");
    for (tier, spans) in annotations {
        assert!(spans.iter().all(|(from, until)| from < until), "{tier} has one without a length: {spans:?}");
        assert!(spans.windows(2).all(|pair| pair[0].1 <= pair[1].0), "{tier} has some that overlap: {spans:?}");
    }
}

#[test]
fn a_table_for_boris_has_its_columns_and_pairs_states() {
    let text = boris::written(&told(PrivateParts::default()));
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split('\t').collect()).collect();
    assert!(rows.iter().all(|row| row.len() == 5), "{text}");
    assert!(rows.iter().all(|row| row[0].split('.').all(|part| part.parse::<u64>().is_ok())), "{text}");
    let times: Vec<f64> = rows.iter().map(|row| row[0].parse().unwrap()).collect();
    assert!(times.is_sorted(), "{times:?}");
    let of = |code: &str| rows.iter().filter(|row| row[2] == code).map(|row| (row[0], row[1])).collect::<Vec<_>>();
    assert_eq!(of("laughs"), [("1.000", "C-07"), ("1.500", "C-07")]);
    assert_eq!(of("laughs 2"), [("1.000", "C-07"), ("2.500", "C-07")]);
    assert_eq!(of("marks"), [("2.000", "C-07")], "a moment is no state");
    assert_eq!(of("action: Eyes")[..2], [("0.100", "robot"), ("0.900", "robot")]);
}

#[test]
fn subtitles_can_be_parsed() {
    let text = vtt::written(&told(PrivateParts::default()));
    let mut blocks = text.split("\n\n");
    assert_eq!(blocks.next(), Some("WEBVTT"));
    let ms = |clock: &str| {
        let (time, rest) = clock.split_once('.').unwrap();
        let parts: Vec<u64> = time.split(':').map(|part| part.parse().unwrap()).collect();
        assert_eq!((parts.len(), rest.len()), (3, 3), "{clock}");
        (parts[0] * 3_600 + parts[1] * 60 + parts[2]) * 1_000 + rest.parse::<u64>().unwrap()
    };
    let mut last = 0;
    for (number, block) in (1..).zip(blocks) {
        let lines: Vec<&str> = block.trim_end().lines().collect();
        let [name, times, says] = lines[..] else { panic!("{block}") };
        assert_eq!(name, number.to_string());
        let (from, until) = times.split_once(" --> ").unwrap();
        assert!(last <= ms(from) && ms(from) < ms(until), "{block}");
        assert!(!says.contains("-->") && !says.contains('<'), "{says}");
        last = ms(from);
    }
    assert!(text.contains("by hand: SayInput: =1+1; &lt;b&gt;--&gt; &amp; \"so\"\n"), "{text}");
}
