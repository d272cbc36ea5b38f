//! The choice of the method that is called, and how far the directory is believed.

use qi::{
    EndpointChoice, Layout, MetaMethod, MetaObject, ServiceInfo, Value, ValueSignature, choose_endpoint, encode, fit,
};

fn object(parameters: &[&str]) -> MetaObject {
    let methods = parameters.iter().zip(100..).map(|(parameters, uid)| MetaMethod {
        uid,
        name: "set".to_owned(),
        returns: ValueSignature::Void,
        parameters: parameters.parse().unwrap(),
        description: String::new(),
    });
    MetaObject { methods: methods.collect(), ..MetaObject::default() }
}

fn chosen(parameters: &[&str], arguments: &[Value]) -> Option<String> {
    object(parameters).choose("set", arguments).map(|chosen| chosen.method.parameters.to_string())
}

#[test]
fn the_method_that_fits_best_is_called() {
    let all = ["(m)", "(i)", "(f)", "(s)", "([f])", "(si)"];
    let cases: [(&[Value], Option<&str>); 9] = [
        (&[Value::from(1)], Some("(i)")),
        (&[Value::from(1_i64)], Some("(i)")),
        (&[Value::from(1.5)], Some("(f)")),
        (&[Value::from("a")], Some("(s)")),
        (&[Value::from(vec![1.5])], Some("([f])")),
        (&[Value::from(true)], Some("(m)")),
        (&[Value::dynamic("a")], Some("(m)")),
        (&["a".into(), 1.into()], Some("(si)")),
        (&["a".into(), "b".into()], None),
    ];
    for (arguments, expected) in cases {
        assert_eq!(chosen(&all, arguments).as_deref(), expected, "{arguments:?}");
    }
    assert_eq!(chosen(&["(d)", "(f)"], &[Value::from(1)]).as_deref(), Some("(d)"), "of equals the first");
    assert_eq!(chosen(&["m", "(i)"], &[Value::from(1)]).as_deref(), Some("(i)"));
    assert_eq!(chosen(&["m"], &["a".into(), 1.into(), true.into()]).as_deref(), Some("m"));
}

#[test]
fn numbers_go_only_where_they_fit() {
    let fits = |value: Value, text: &str| fit(&value, &text.parse().unwrap()).is_some();
    assert!(fits(255.into(), "C") && !fits(256.into(), "C") && !fits((-1).into(), "I"));
    assert!(fits(2.0.into(), "i") && !fits(2.5.into(), "i") && !fits(f64::NAN.into(), "l") && !fits(1e30.into(), "l"));
    assert!(!fits(true.into(), "i") && !fits(1.into(), "b") && !fits("1".into(), "i") && fits(().into(), "+i"));
    // What fits can be written, and nothing else.
    let values: [Value; 8] = [
        1.into(),
        2.5.into(),
        "a".into(),
        true.into(),
        vec![1, 300].into(),
        Value::Tuple(vec![1.into(), "a".into()]),
        Value::map([("a", 1.into())]),
        ().into(),
    ];
    for value in &values {
        for text in ["i", "C", "f", "s", "b", "m", "[C]", "[i]", "[m]", "(is)", "(mm)", "{si}", "{sm}", "+i", "v", "r"]
        {
            let signature: ValueSignature = text.parse().unwrap();
            let is_written = encode(value, &signature, Layout::default()).is_ok();
            assert_eq!(fit(value, &signature).is_some(), is_written, "{value:?} as {text}");
        }
    }
}

fn info(machine: &str, endpoints: &[&str]) -> ServiceInfo {
    let endpoints = endpoints.iter().map(|text| (*text).to_owned()).collect();
    ServiceInfo { name: "A".to_owned(), service_id: 5, machine_id: machine.to_owned(), process_id: 1, endpoints }
}

#[test]
fn a_directory_is_believed_for_the_dialled_host_only() {
    let directory = info("m", &["tcp://127.0.0.1:9559", "tcp://10.0.0.5:9559"]);
    let way = |endpoints: &[&str], machine: &str, dialled: &str| {
        let dialled = dialled.parse().unwrap();
        choose_endpoint(&info(machine, endpoints), Some(&directory), &dialled, "10.0.0.5".parse().unwrap(), true)
    };
    let dial = |text: &str| EndpointChoice::Dial(text.parse().unwrap());
    let robot = "tcp://robot.local:9559";
    assert_eq!(way(&["tcp://10.0.0.5:9559"], "m", robot), EndpointChoice::SameLink);
    assert_eq!(way(&["qi:ServiceDirectory"], "x", robot), EndpointChoice::SameLink);
    assert_eq!(
        way(&["tcp://127.0.0.1:9559"], "m", robot),
        EndpointChoice::SameLink,
        "what the directory says of itself"
    );
    assert_eq!(way(&["tcp://127.0.0.1:9559"], "x", robot), EndpointChoice::Nowhere, "another computer's own");
    assert_eq!(way(&["tcp://127.0.0.1:22"], "m", robot), EndpointChoice::Nowhere, "never our own computer");
    assert_eq!(way(&["tcp://[::1]:22"], "m", robot), EndpointChoice::Nowhere);
    assert_eq!(way(&["tcp://10.0.0.9:4000", "tcp://evil.example:1"], "m", robot), EndpointChoice::Nowhere);
    assert_eq!(way(&["tcp://127.0.0.1:4000", "tcp://10.0.0.5:4000"], "m", robot), dial("tcp://robot.local:4000"));
    assert_eq!(
        way(&["tcp://10.0.0.5:4000"], "m", "tcps://10.0.0.5:9503"),
        EndpointChoice::Nowhere,
        "no password without TLS"
    );
    assert_eq!(way(&["tcps://10.0.0.5:4000"], "m", "tcps://10.0.0.5:9503"), dial("tcps://10.0.0.5:4000"));
    assert_eq!(way(&["nonsense", "qi:Other", ""], "m", robot), EndpointChoice::Nowhere);
}
