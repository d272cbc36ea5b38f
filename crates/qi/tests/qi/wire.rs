//! Headers, frames however they are broken up, and bytes that claim too much.

use qi::{
    DEPTH_MAX, FRAME_MAX_BYTES, Framer, HEADER_BYTES, Layout, Malformed, MessageFrame, MessageHeader, MessageKind,
    MetaObject, PeerAddress, TypeMismatch, Value, ValueSignature, decode, encode,
};

fn header(id: u32) -> MessageHeader {
    MessageHeader { kind: MessageKind::Call, flags: 1, id, service: 2, object: 3, action: 4 }
}

fn signature(text: &str) -> ValueSignature {
    text.parse().unwrap()
}

#[test]
fn a_header_is_28_bytes_little_endian() {
    let bytes = header(7).to_bytes(5);
    let expected =
        super::golden::bytes("42dead420700000005000000000001010200000003000000 04000000".replace(' ', "").as_str());
    assert_eq!(bytes.to_vec(), expected);
    assert_eq!(MessageHeader::from_bytes(&bytes), Ok((header(7), 5)));
}

#[test]
fn messages_come_byte_by_byte_and_all_at_once() {
    let frames: Vec<MessageFrame> =
        (0..5).map(|id| MessageFrame { header: header(id), payload: vec![7; id as usize * 100] }).collect();
    let bytes: Vec<u8> = frames.iter().flat_map(|frame| frame.to_bytes().unwrap()).collect();
    for size in [1, 3, 27, 28, 29, bytes.len()] {
        let (mut framer, mut seen) = (Framer::default(), Vec::new());
        for chunk in bytes.chunks(size) {
            framer.feed(chunk);
            while let Some(frame) = framer.next_frame().unwrap() {
                seen.push(frame);
            }
        }
        assert_eq!(seen, frames, "in pieces of {size}");
    }
}

#[test]
fn a_size_beyond_the_bound_ends_the_stream_at_its_header() {
    let too_much = u32::try_from(FRAME_MAX_BYTES).unwrap() + 1;
    for (size, result) in [(too_much, Err(Malformed::TooLarge { size: too_much })), (too_much - 1, Ok(None))] {
        let mut framer = Framer::default();
        framer.feed(&header(1).to_bytes(size));
        assert_eq!(framer.next_frame(), result);
    }
    let large = MessageFrame { header: header(1), payload: vec![0; FRAME_MAX_BYTES + 1] };
    assert_eq!(large.to_bytes(), None);
}

#[test]
fn other_bytes_than_ours_are_told_apart() {
    let mut framer = Framer::default();
    framer.feed(b"HTTP/1.1 400 Bad Request\r\n\r\n");
    assert!(matches!(framer.next_frame(), Err(Malformed::Magic { .. })));
    let mut bytes = header(1).to_bytes(0);
    bytes[14] = 9;
    assert_eq!(MessageHeader::from_bytes(&bytes), Err(Malformed::Kind { found: 9 }));
    assert_eq!(HEADER_BYTES, bytes.len());
}

#[test]
fn counts_and_texts_never_exceed_what_is_there() {
    let much = [0xFF, 0xFF, 0xFF, 0xFF, 0, 0];
    let read = |text: &str| decode(&much, &signature(text), Layout::default());
    assert_eq!(read("[i]"), Err(Malformed::Count { count: u32::MAX, left: 2 }));
    assert_eq!(read("[v]"), Err(Malformed::Count { count: u32::MAX, left: 2 }));
    assert_eq!(read("{si}"), Err(Malformed::Count { count: u32::MAX, left: 2 }));
    assert!(matches!(read("s"), Err(Malformed::Short { left: 2, .. })));
    assert!(matches!(read("m"), Err(Malformed::Short { left: 2, .. })));
    assert!(MetaObject::decode(&much).is_err());
}

#[test]
fn many_values_of_no_size_are_too_many() {
    let count: u32 = 2_000_000;
    let mut bytes = count.to_le_bytes().to_vec();
    bytes.resize(4 + count as usize, 0);
    for text in ["[v]", "[()]", "[b]"] {
        assert_eq!(decode(&bytes, &signature(text), Layout::default()), Err(Malformed::TooMany), "{text}");
    }
}

#[test]
fn nesting_ends_at_32() {
    let lists = |depth: usize| "[".repeat(depth - 1) + "i" + &"]".repeat(depth - 1);
    assert!(lists(32).parse::<ValueSignature>().is_ok());
    assert_eq!(lists(33).parse::<ValueSignature>(), Err(Malformed::TooDeep));
    // Dynamics in dynamics: each brings the signature of the next.
    let nested = |depth: usize| (1..depth).fold(Value::from(1), |inner, _| Value::dynamic(inner));
    assert_eq!(DEPTH_MAX, 32);
    let deepest = encode(&nested(32), &ValueSignature::Dynamic, Layout::default()).unwrap();
    assert_eq!(decode(&deepest, &ValueSignature::Dynamic, Layout::default()).unwrap(), nested(32));
    assert_eq!(encode(&nested(33), &ValueSignature::Dynamic, Layout::default()), Err(TypeMismatch::TooDeep));
    let deeper = [&[1, 0, 0, 0, b'm'], deepest.as_slice()].concat();
    assert_eq!(decode(&deeper, &ValueSignature::Dynamic, Layout::default()), Err(Malformed::TooDeep));
}

#[test]
fn signatures_keep_their_names_and_refuse_the_rest() {
    for text in ["(ff)<Point,x,y>", "{s[m]}", "+i", "#m", "(s(ii)<P<a,b>,x,y>[r])", "()", "X"] {
        assert_eq!(signature(text).to_string(), text);
    }
    for text in ["", "[", "[]", "[i", "(i", "{s}", "{sii}", "q", "ii", "i]", "(i)<Open", "é", "+", "#"] {
        assert!(matches!(text.parse::<ValueSignature>(), Err(Malformed::Signature { .. })), "{text}");
    }
}

#[test]
fn addresses_are_read_and_written() {
    for text in ["tcp://10.0.0.5:9559", "tcps://robot.local:9503", "tcp://[fe80::1]:9559"] {
        assert_eq!(text.parse::<PeerAddress>().unwrap().to_string(), text);
    }
    for text in
        ["", "robot", "http://a:1", "tcp://a", "tcp://:1", "tcp://a:0", "tcp://a:99999", "tcp://a b:1", "tcp://::1:5"]
    {
        assert!(text.parse::<PeerAddress>().is_err(), "{text}");
    }
}
