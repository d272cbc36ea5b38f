//! Random damage: what comes from a peer never panics, and what is written is read as it was.
//!
//! `QI_FUZZ_RUNS=10000000 cargo test -p qi --release fuzz -- --nocapture` is the long run; `QI_FUZZ_SEED` begins elsewhere.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use qi::{
    Framer, Layout, Malformed, MessageHeader, MessageKind, MetaMethod, MetaObject, MetaSignal, ObjectRef, PeerAddress,
    Value, ValueSignature,
};
use qi::{decode, decode_arguments, encode};

use crate::golden;

const RUNS: u64 = 100_000;
const SEED: u64 = 1;

/// SplitMix64: a number is the whole state, so that every run can be told and repeated.
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut word = self.0;
        word = (word ^ (word >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        word = (word ^ (word >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        word ^ (word >> 31)
    }

    fn below(&mut self, bound: usize) -> usize {
        usize::try_from(self.next() % bound.max(1) as u64).unwrap()
    }
}

fn from_environment(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).ok().map_or(otherwise, |text| text.parse().unwrap())
}

#[test]
fn damaged_bytes_never_panic() {
    let (runs, seed) = (from_environment("QI_FUZZ_RUNS", RUNS), from_environment("QI_FUZZ_SEED", SEED));
    let corpus = corpus();
    for run in 0..runs {
        let mut chance = Chance(seed.wrapping_add(run.wrapping_mul(0xD134_2543_DE82_EF95)));
        let (signature, bytes) = &corpus[chance.below(corpus.len())];
        let (mut signature, mut bytes) = (signature.clone(), bytes.clone());
        damage(&mut bytes, &mut chance);
        if chance.below(4) == 0 {
            damage(&mut signature, &mut chance);
        }
        let tried = catch_unwind(AssertUnwindSafe(|| read(&signature, &bytes, run)));
        assert!(tried.is_ok(), "run {run} of seed {seed}: {:?} {bytes:?}", String::from_utf8_lossy(&signature));
    }
    eprintln!("{runs} runs of seed {seed} without a panic");
}

/// All ways that bytes come in by.
fn read(signature: &[u8], bytes: &[u8], run: u64) {
    let layout = Layout { object_uid: run.is_multiple_of(2) };
    if let Ok(signature) = ValueSignature::parse(signature) {
        if let Ok(value) = decode(bytes, &signature, layout) {
            let _ = value.signature();
            // What was read can be written, and read once more.
            if let Ok(again) = encode(&value, &signature, layout) {
                match decode(&again, &signature, layout) {
                    Ok(value) => assert_eq!(encode(&value, &signature, layout).unwrap(), again),
                    // Only a list of nothing at all, which had bytes behind it to be believed by.
                    Err(refused) => assert!(matches!(refused, Malformed::Count { .. }), "{refused:?}"),
                }
            }
        }
        let _ = decode_arguments(bytes, &signature, layout);
    }
    let _ = MetaObject::decode(bytes);
    let _ = String::from_utf8_lossy(signature).parse::<PeerAddress>();
    let mut framer = Framer::default();
    for chunk in bytes.chunks(1 + bytes.len() / 3) {
        framer.feed(chunk);
        while let Ok(Some(frame)) = framer.next_frame() {
            let _ = decode(&frame.payload, &ValueSignature::Dynamic, layout);
        }
    }
}

fn damage(bytes: &mut Vec<u8>, chance: &mut Chance) {
    const ODD: [u8; 12] = [0, 1, 0x7F, 0x80, 0xFF, b'[', b'm', b'(', b'{', b'o', b'<', b'+'];
    for _ in 0..chance.below(6) {
        let at = chance.below(bytes.len() + 1);
        match chance.below(7) {
            0 => bytes.truncate(at),
            1 if at < bytes.len() => bytes[at] ^= 1 << chance.below(8),
            2 if at < bytes.len() => bytes[at] = ODD[chance.below(ODD.len())],
            3 => bytes.insert(at, ODD[chance.below(ODD.len())]),
            4 if at + 4 <= bytes.len() => bytes[at..at + 4].copy_from_slice(&u32::MAX.to_le_bytes()),
            5 if bytes.len() < 4096 => {
                let part = bytes[at.min(bytes.len() / 2)..].to_vec();
                bytes.splice(at..at, part);
            }
            6 if at < bytes.len() => drop(bytes.remove(at)),
            _ => {}
        }
    }
}

/// Recorded values, messages, an object with everything, and deep and odd things.
fn corpus() -> Vec<(Vec<u8>, Vec<u8>)> {
    let mut corpus: Vec<(Vec<u8>, Vec<u8>)> = Vec::new();
    for line in golden::VECTORS.lines() {
        let vector: serde_json::Value = serde_json::from_str(line).unwrap();
        let bytes = golden::bytes(vector["hex"].as_str().unwrap());
        let header = MessageHeader { kind: MessageKind::Event, flags: 0, id: 1, service: 1, object: 1, action: 106 };
        let frame = [&header.to_bytes(u32::try_from(bytes.len()).unwrap())[..], &bytes].concat();
        corpus.push((vector["signature"].as_str().unwrap().as_bytes().to_vec(), bytes));
        corpus.push((b"m".to_vec(), frame));
    }
    let meta = meta();
    let object = Value::Object(Arc::new(ObjectRef { meta: meta.clone(), service: 3, object: 2, uid: Some([9; 20]) }));
    corpus.push((b"m".to_vec(), encode(&object, &ValueSignature::Dynamic, Layout { object_uid: true }).unwrap()));
    corpus.push((b"({I(Issss[(ss)]s)}{I(Iss)}{I(Iss)}s)".to_vec(), meta.encode().unwrap()));
    let shallow = (0..6).fold(Value::from(1), |inner, _| Value::dynamic(Value::List(vec![inner.clone(), inner])));
    corpus.push((b"m".to_vec(), encode(&shallow, &ValueSignature::Dynamic, Layout::default()).unwrap()));
    corpus
}

fn meta() -> MetaObject {
    let signature = |text: &str| text.parse::<ValueSignature>().unwrap();
    let method = |uid, name: &str, parameters| MetaMethod {
        uid,
        name: name.to_owned(),
        returns: signature("[m]"),
        parameters: signature(parameters),
        description: "does it".to_owned(),
    };
    let signal = MetaSignal { uid: 102, name: "told".to_owned(), signature: signature("(s)") };
    MetaObject {
        methods: vec![method(100, "set", "(sff)"), method(101, "set", "([s][f]f)"), method(104, "any", "m")],
        signals: vec![signal.clone()],
        properties: vec![MetaSignal { uid: 103, signature: signature("{s(ff)<P,x,y>}"), ..signal }],
        description: "all of it".to_owned(),
    }
}

#[test]
fn what_an_object_can_do_is_read_as_it_was_written() {
    assert_eq!(MetaObject::decode(&meta().encode().unwrap()), Ok(meta()));
}

#[test]
fn any_value_of_any_type_is_read_as_it_was_written() {
    for seed in 0..from_environment("QI_FUZZ_VALUES", 20_000) {
        let mut chance = Chance(seed);
        let signature = some_type(&mut chance, 5);
        let value = some_value(&signature, &mut chance, 4);
        let bytes = encode(&value, &signature, Layout::default()).unwrap();
        let read = decode(&bytes, &signature, Layout::default()).unwrap();
        let again = encode(&read, &signature, Layout::default()).unwrap();
        assert_eq!(again, bytes, "seed {seed}: {signature}");
        assert_eq!(signature.to_string().parse(), Ok(signature), "seed {seed}");
    }
}

fn some_type(chance: &mut Chance, depth: u32) -> ValueSignature {
    const PLAIN: [&str; 14] = ["b", "c", "C", "w", "W", "i", "I", "l", "L", "f", "d", "s", "r", "m"];
    if depth == 0 || chance.below(2) == 0 {
        return PLAIN[chance.below(PLAIN.len())].parse().unwrap();
    }
    match chance.below(4) {
        0 => ValueSignature::list(some_type(chance, depth - 1)),
        1 => ValueSignature::Map(Box::new(some_type(chance, depth - 1)), Box::new(some_type(chance, depth - 1))),
        2 => ValueSignature::Optional(Box::new(some_type(chance, depth - 1))),
        // At least one field: a list of nothing at all is refused by its count.
        _ => ValueSignature::tuple((0..1 + chance.below(3)).map(|_| some_type(chance, depth - 1)).collect()),
    }
}

#[expect(clippy::cast_possible_truncation, reason = "any bits will do")]
fn some_value(signature: &ValueSignature, chance: &mut Chance, depth: u32) -> Value {
    let word = chance.next();
    match signature {
        ValueSignature::Void | ValueSignature::Object | ValueSignature::Unknown => Value::Unit,
        ValueSignature::Bool => (word.is_multiple_of(2)).into(),
        ValueSignature::I8 => (word as i8).into(),
        ValueSignature::U8 => (word as u8).into(),
        ValueSignature::I16 => (word as i16).into(),
        ValueSignature::U16 => (word as u16).into(),
        ValueSignature::I32 => (word as i32).into(),
        ValueSignature::U32 => (word as u32).into(),
        ValueSignature::I64 => (word as i64).into(),
        ValueSignature::U64 => word.into(),
        ValueSignature::F32 => (word as f32 / 3.0).into(),
        ValueSignature::F64 => (word as f64 / 3.0).into(),
        ValueSignature::Str => Value::Str(word.to_le_bytes()[..chance.below(9)].to_vec()),
        ValueSignature::Raw => Value::Raw(word.to_le_bytes()[..chance.below(9)].to_vec()),
        ValueSignature::Dynamic => {
            let inner = some_type(chance, depth.min(2));
            if depth == 0 { Value::dynamic(1) } else { Value::dynamic(some_value(&inner, chance, depth - 1)) }
        }
        ValueSignature::List(of) | ValueSignature::VarArgs(of) => {
            Value::List((0..chance.below(4)).map(|_| some_value(of, chance, depth)).collect())
        }
        ValueSignature::Map(key, of) => {
            let entries = (0..chance.below(4)).map(|_| (some_value(key, chance, depth), some_value(of, chance, depth)));
            Value::Map(entries.collect())
        }
        ValueSignature::Tuple(fields, _) => {
            Value::Tuple(fields.iter().map(|field| some_value(field, chance, depth)).collect())
        }
        ValueSignature::Optional(of) => {
            Value::Optional((word.is_multiple_of(2)).then(|| Box::new(some_value(of, chance, depth))))
        }
    }
}
