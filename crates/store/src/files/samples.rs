//! Behaviours for tests: the templates of the house, and ones made by chance.

use behaviour::{
    Behaviour, BehaviourFile, Declared, Engine, FORMAT, FileConnector, FileGroup, FileHelper, FileNote, FileStream,
    FileTile, Helper, Params, Place, StreamKind, Value, connectors,
};
use proptest::collection::{btree_map, vec};
use proptest::option;
use proptest::prelude::*;

/// Every template with its file name.
pub(super) fn templates() -> Vec<(String, String)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/behaviours");
    let mut all: Vec<_> =
        std::fs::read_dir(folder).expect("the templates").map(|entry| entry.expect("a file").path()).collect();
    all.sort();
    let read = |path: &std::path::PathBuf| {
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        (name, std::fs::read_to_string(path).expect("a text"))
    };
    let all: Vec<_> = all.iter().map(read).collect();
    assert!(all.len() >= 8, "the templates are there");
    all
}

/// Texts that files find hard, without control characters.
pub(super) fn any_text() -> impl Strategy<Value = String> {
    let hard = [
        "<",
        ">",
        "&",
        "\"",
        "'",
        "]]>",
        "<!--",
        "&lt;",
        "&#0;",
        "\n",
        "\r",
        "\r\n",
        "\t",
        " ",
        "  ",
        "\u{a0}",
        "שלום",
        "مرحبا",
        "\u{202e}",
        "🤖",
        "👩‍🔬",
        "é",
        "e\u{301}",
        "赤いボール",
        "\\",
        "\\u0041",
        "{",
        "}",
        "/",
        "\u{feff}",
        "a",
        "b",
        "1",
        "<script>alert(1)</script>",
        "<![CDATA[",
        "\u{e000}",
    ];
    vec(prop_oneof![4 => proptest::sample::select(hard.to_vec()).prop_map(str::to_owned), 1 => any::<char>().prop_map(plain)], 0..8)
        .prop_map(|parts| parts.concat())
}

fn plain(c: char) -> String {
    behaviour::without_control(&c.to_string(), '\n').into_owned()
}

fn any_value() -> impl Strategy<Value = Value> {
    let float = any::<f64>().prop_filter("finite", |float| float.is_finite());
    let leaf = prop_oneof![
        Just(Value::Null),
        any::<bool>().prop_map(Value::Bool),
        any::<i64>().prop_map(Value::Int),
        float.prop_map(Value::Float),
        Just(Value::Float(-0.0)),
        Just(Value::Float(42.699_999_999_999_996)),
        any_text().prop_map(Value::text),
    ];
    leaf.prop_recursive(3, 12, 4, |inner| {
        prop_oneof![
            vec(inner.clone(), 0..4).prop_map(Value::list),
            btree_map(any_text(), inner, 0..4).prop_map(|fields| {
                let fields: Vec<_> = fields.into_iter().collect();
                Value::object(fields.iter().map(|(name, value)| (name.as_str(), value.clone())))
            }),
        ]
    })
}

fn any_coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<f64>().prop_filter("finite", |float| float.is_finite()),
        (-5000_i32..5000).prop_map(f64::from),
        Just(-0.0),
        Just(9_007_199_254_740_993.0),
    ]
}

fn any_names(most: usize) -> impl Strategy<Value = Vec<String>> {
    (0..=most).prop_map(|many| (0..many).map(|n| format!("arg_{n}")).collect())
}

fn any_stream(at: usize) -> impl Strategy<Value = FileStream> {
    let kind = prop_oneof![Just(StreamKind::Sensor), Just(StreamKind::Ordinary), Just(StreamKind::Actuator)];
    let params = btree_map(any_text(), any_value(), 0..3);
    let rest = (option::of(any_text()), params, option::of(vec(any_text(), 0..3)), option::of(any::<i64>()));
    (kind, any_text(), rest, option::of(0..=i64::MAX.cast_unsigned())).prop_map(
        move |(kind, name, (device, params, resources, priority), hold_ms)| FileStream {
            id: format!("s{at}"),
            kind,
            name,
            device,
            params: Some(params).filter(|params: &Params| !params.is_empty()),
            resources,
            priority,
            hold_ms,
        },
    )
}

fn any_connector(at: usize) -> impl Strategy<Value = FileConnector> {
    let inputs = vec((0_usize..4).prop_map(|n| format!("s{n}")), 0..4);
    let body = (option::of(any_text()), option::of(any_names(3)), option::of(any_text()));
    let rest = (1_u64..=3_600_000, any_value());
    (proptest::sample::select(connectors::ALL), inputs, body, rest).prop_map(
        move |(spec, inputs, (body, args, helper), (period_ms, start))| {
            let takes = spec.takes.procedure.is_some();
            let helper = helper.filter(|_| takes && body.is_none());
            let body = body.filter(|_| takes);
            FileConnector {
                id: format!("c{at}"),
                operation: spec.word.to_owned(),
                inputs,
                output: format!("s{at}"),
                args: args.filter(|_| body.is_some()),
                body,
                helper,
                period_ms: spec.takes.period.map(|_| period_ms),
                start: spec.takes.start.map(|_| start).filter(|start| *start != Value::Null),
            }
        },
    )
}

fn any_helper(at: usize) -> impl Strategy<Value = FileHelper> {
    let all = || (0..Declared::all().len()).prop_map(|at| Declared::all()[at]);
    let declared = (vec(all(), 0..4), all());
    (any_names(3), any_text(), any_text(), declared).prop_map(move |(params, body, says, (mut takes, gives))| {
        takes.truncate(params.len());
        FileHelper { name: format!("helper_{at}"), params, body, says, takes, gives }
    })
}

fn any_note(at: usize) -> impl Strategy<Value = FileNote> {
    let known = (option::of(any_text()), option::of(0..=i64::MAX.cast_unsigned()));
    (any_text(), known).prop_map(move |(text, (by, at_ms))| FileNote { id: format!("n{at}"), text, by, at: at_ms })
}

/// Each has streams of its own, one of which is gone.
fn any_group(at: usize) -> impl Strategy<Value = FileGroup> {
    let streams =
        proptest::sample::subsequence(vec![format!("gone{at}"), format!("s{at}"), format!("s{}", at + 2)], 0..=3);
    (any_text(), streams, option::of(any::<bool>())).prop_map(move |(title, streams, folded)| FileGroup {
        id: format!("g{at}"),
        title,
        streams,
        folded,
    })
}

/// A tile of each kind, by the key.
fn any_tile(at: usize) -> impl Strategy<Value = FileTile> {
    let value = || option::of(any_value()).prop_map(|value| value.filter(|value| *value != Value::Null));
    let params = btree_map(any_text(), any_value(), 0..3);
    (any_text(), (any_text(), params), value(), any::<bool>()).prop_map(move |(label, (name, params), value, span)| {
        let plain = FileTile { key: u8::try_from(at + 1).unwrap_or(9), label, ..FileTile::default() };
        match at % 3 {
            0 => {
                let params = Some(params).filter(|params: &Params| !params.is_empty());
                FileTile { device: Some(name), params, value, asks: span.then_some(true), ..plain }
            }
            1 => FileTile { stream: Some(format!("s{at}")), value, ..plain },
            _ => FileTile { word: Some(name), span: span.then_some(true), ..plain },
        }
    })
}

fn numbered<T, S: Strategy<Value = T>>(most: usize, one: fn(usize) -> S) -> impl Strategy<Value = Vec<T>>
where
    T: std::fmt::Debug,
{
    (0..=most).prop_flat_map(move |many| (0..many).map(one).collect::<Vec<_>>())
}

/// Any file whose form is right, whether it makes sense or not.
pub(super) fn any_file() -> impl Strategy<Value = BehaviourFile> {
    let engine = prop_oneof![Just(Engine::Event), (1_u64..=1000).prop_map(|frame_ms| Engine::Frame { frame_ms })];
    let tags = vec(any_text().prop_map(|tag| tag.chars().take(24).collect::<String>()), 0..=3);
    let head = (
        option::of("[a-z]{1,8}"),
        any_text(),
        (option::of(any_text()), option::of(any_text())),
        option::of(engine),
        tags,
    );
    let graph = (numbered(3, any_helper), numbered(5, any_stream), numbered(5, any_connector));
    let place = (any_coordinate(), any_coordinate()).prop_map(|(x, y)| Place { x, y });
    let beside = (numbered(2, any_note), numbered(2, any_group), option::of(numbered(4, any_tile)));
    (head, graph, beside, btree_map(any_text(), place, 0..4), any::<i64>()).prop_map(
        |((id, name, (robot, exercise), engine, tags), (helpers, streams, connectors), beside, layout, order)| {
            BehaviourFile {
                format: FORMAT.to_owned(),
                id,
                name,
                robot,
                engine,
                exercise,
                tags,
                order: streams.iter().take(2).map(|stream| (stream.id.clone(), order)).collect(),
                notes: beside.0,
                groups: beside.1,
                pad: beside.2,
                helpers,
                streams,
                connectors,
                layout,
            }
        },
    )
}

/// Any behaviour with its library, as records: everything that can be kept.
pub(super) fn any_behaviour() -> impl Strategy<Value = (Behaviour, Vec<Helper>)> {
    any_file().prop_map(|mut file| {
        let ids: Vec<String> = file.streams.iter().map(|stream| stream.id.clone()).collect();
        file.connectors
            .retain(|connector| connector.inputs.iter().chain([&connector.output]).all(|id| ids.contains(id)));
        file.order = ids.iter().zip(0_i64..).map(|(id, at)| (id.clone(), at * 3 - 5)).collect();
        let beside = file.notes.iter().map(|note| &note.id).chain(file.groups.iter().map(|group| &group.id));
        let owners = ids.into_iter().chain(beside.cloned());
        file.layout = owners.zip(file.layout.into_values()).collect();
        (file.records(|_| None).expect("a behaviour"), file.library())
    })
}
