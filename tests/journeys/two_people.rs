//! Two people at one thing: each place where one types, and a colleague who saves, renames, removes or takes back the same
//! meanwhile. Who comes second is told by name who is at it; where no lock could be had, who types is told who was first,
//! no field is overwritten under their hands, and nothing of what they typed is lost.

use behaviour::{
    Behaviour, Change, Edit, Group, Helper, Id, Kind, LockToken, Note, Procedure, Record, RecordId, Settings,
};
use house::{Outcome, Page, Switch, skip};
use protocol::{LIBRARY, Refused, answer, request};
use serde_json::json;

use crate::steps::*;
use crate::together::call_myself;
use crate::visitor::{Opened, Visitor, id};

/// What Aiko types, where a text is typed and where a number is.
const WORDS: &str = "Aiko wrote this";
const NUMBER: &str = "0.35";
/// How long a change may take until the server has it.
const PATIENCE: std::time::Duration = std::time::Duration::from_secs(30);

/// A place where one types: what it changes, how one comes to it, how what is typed is saved, and what it is about.
#[derive(Clone, Copy)]
struct Where {
    name: &'static str,
    record: &'static str,
    /// What gets the keyboard first, then the keys that open the field.
    from: &'static str,
    keys: &'static [&'static str],
    /// The button that is pressed after that.
    press: Option<&'static str>,
    /// The field, and what is typed in it.
    field: &'static str,
    typed: &'static str,
    save: &'static str,
    /// What a comparison calls it.
    what: &'static str,
    /// What becomes of the place when a colleague removes what it is about.
    removed: Removed,
}

/// What becomes of a place of which the thing is gone.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Removed {
    /// The question comes by itself, with what was typed.
    Asks,
    /// One types on, and the question comes when that is saved.
    Stays,
    /// It says so, and brings it back with what was typed.
    Says,
    /// It cannot be removed.
    Never,
}

const PLACES: &[Where] = &[
    Where {
        name: "the control beside a chip",
        record: "connector/near",
        from: "[data-chip='near']",
        keys: &["Enter"],
        press: None,
        field: ".flyout .stepper input",
        typed: NUMBER,
        save: "Enter",
        what: "filter",
        removed: Removed::Asks,
    },
    Where {
        name: "a sentence",
        record: "connector/near",
        from: ".told .inline[role=button]",
        keys: &["Enter"],
        press: None,
        field: ".inline.open input",
        typed: NUMBER,
        save: "Enter",
        what: "filter",
        removed: Removed::Stays,
    },
    Where {
        name: "the dialog of a connector",
        record: "connector/near",
        from: "[data-chip='near']",
        keys: &["Space"],
        press: Some("More…"),
        field: ".dialog textarea",
        typed: "distance < 0.35",
        save: "Control+Enter",
        what: "filter",
        removed: Removed::Says,
    },
    Where {
        name: "the panel of a stream",
        record: "stream/alone",
        from: "[data-node='alone']",
        keys: &["Space"],
        press: None,
        field: ".settings input",
        typed: WORDS,
        save: "Enter",
        what: "stream",
        removed: Removed::Asks,
    },
    Where {
        name: "the settings of an action",
        record: "stream/say",
        from: "[data-node='say']",
        keys: &["Space"],
        press: Some("Edit"),
        field: ".dialog input",
        typed: WORDS,
        save: "Control+Enter",
        what: "stream",
        removed: Removed::Says,
    },
    Where {
        name: "a name on the canvas",
        record: "stream/alone",
        from: "[data-node='alone']",
        keys: &["F2"],
        press: None,
        field: "input.rename",
        typed: WORDS,
        save: "Enter",
        what: "stream",
        removed: Removed::Stays,
    },
    Where {
        name: "a note",
        record: "note/note",
        from: "[data-note='note']",
        keys: &["F2"],
        press: None,
        field: ".note-field",
        typed: WORDS,
        save: "Control+Enter",
        what: "note",
        removed: Removed::Asks,
    },
    Where {
        name: "the title of a group",
        record: "group/group",
        from: "[data-group='group']",
        keys: &["F2"],
        press: None,
        field: "input.rename",
        typed: WORDS,
        save: "Enter",
        what: "group",
        removed: Removed::Stays,
    },
    Where {
        name: "the name of the program",
        record: "settings/behaviour",
        from: "#stage",
        keys: &[],
        press: Some("Two people*"),
        field: ".dialog input",
        typed: WORDS,
        save: "Enter",
        what: "program",
        removed: Removed::Never,
    },
];

/// What the colleague does meanwhile.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Event {
    Saves,
    Renames,
    Removes,
    TakesBack,
}

const EVENTS: [Event; 4] = [Event::Saves, Event::Renames, Event::Removes, Event::TakesBack];

impl Where {
    fn key(&self) -> Outcome<RecordId> {
        Ok(self.record.parse()?)
    }

    /// What can happen here.
    fn events(&self) -> impl Iterator<Item = Event> + use<> {
        let stays = self.removed == Removed::Never;
        EVENTS.into_iter().filter(move |event| !stays || *event != Event::Removes)
    }
}

/// A red ball whose distance passes a test, and the head follows it; a stream alone, an action, a note and a group.
fn program() -> Outcome<Behaviour> {
    let stream = |kind: &str, name: &str, device: Option<&str>, order: u32| {
        let params = if device == Some("SayParameter") { json!({ "text": "Hello" }) } else { json!({}) };
        json!({ "stream": { "kind": kind, "name": name, "device": device, "params": params, "order": order } })
    };
    let connector = |operation: serde_json::Value, from: &str, to: &str, order: u32| json!({ "connector": { "operation": operation, "inputs": [from], "output": to, "order": order } });
    let place = |x: f64, y: f64| json!({ "place": { "x": x, "y": y } });
    let test = json!({ "filter": { "body": { "body": "distance < 0.5" } } });
    let records = json!({
        "stream/ball": stream("sensor", "Red ball", Some("RedBall"), 0),
        "stream/distance": stream("ordinary", "Distance", None, 1),
        "stream/close": stream("ordinary", "Close ball", None, 2),
        "stream/head": stream("actuator", "Tracker", Some("Tracker"), 3),
        "stream/alone": stream("ordinary", "Alone", None, 4),
        "stream/say": stream("actuator", "Say it", Some("SayParameter"), 5),
        "connector/far": connector(json!({ "map": { "helper": "ball_to_distance" } }), "ball", "distance", 6),
        "connector/near": connector(test, "distance", "close", 7),
        "connector/follow": connector(json!("subscribe"), "close", "head", 8),
        "place/ball": place(0.0, 0.0),
        "place/distance": place(0.0, 140.0),
        "place/close": place(0.0, 280.0),
        "place/head": place(0.0, 420.0),
        "place/alone": place(340.0, 0.0),
        "place/say": place(340.0, 140.0),
        "place/note": place(340.0, 300.0),
    });
    let mut whole = Behaviour::default();
    for (key, record) in records.as_object().into_iter().flatten() {
        whole.records.insert(key.parse()?, serde_json::from_value(record.clone())?);
    }
    whole.records.insert("note/note".parse()?, Record::Note(Note::new("Ask Yuki".into())));
    let group = Group { title: "Group".into(), streams: [id("distance")?].into(), folded: false };
    whole.records.insert("group/group".parse()?, Record::Group(group));
    Ok(whole)
}

/// Aiko with the program open, and Ben, who has no page.
struct Two<'a> {
    aiko: &'a Page,
    ben: Visitor,
    program: Id,
    /// As it is before each cell of the table.
    first: Behaviour,
    /// Names the next change.
    next: u32,
}

impl Two<'_> {
    async fn now(&mut self) -> Outcome<Opened> {
        // Somebody who looks again and again is asked to wait.
        let began = std::time::Instant::now();
        loop {
            match self.ben.open(&self.program).await {
                Err(trouble) if trouble.to_string().contains("TooFast") && began.elapsed() < PATIENCE => {
                    self.aiko.frames().await?;
                }
                other => return other,
            }
        }
    }

    fn change(&mut self) -> Outcome<Change> {
        self.next += 1;
        Ok(Change::of(id(&format!("ben-{}", self.next))?, "Ben", "Edit"))
    }

    async fn propose(&mut self, behaviour: Id, change: Change) -> Outcome<Result<answer::Saved, Refused>> {
        self.ben.try_to(request::Propose { behaviour, change, tokens: Vec::new() }).await
    }

    /// Ben puts everything back as it was at first.
    async fn reset(&mut self) -> Outcome<()> {
        let now = self.now().await?.records;
        let mut change = self.change()?;
        let all =
            now.records.keys().chain(self.first.records.keys()).cloned().collect::<std::collections::BTreeSet<_>>();
        for id in all {
            let (before, after) = (now.records.get(&id).cloned(), self.first.records.get(&id).cloned());
            if before != after {
                change.edits.push(Edit { id, before, after });
            }
        }
        if change.edits.is_empty() {
            return Ok(());
        }
        agreed(self.propose(self.program.clone(), change).await?, "putting all back")
    }

    /// Ben tries something, and is answered.
    async fn tries(&mut self, event: Event, record: &RecordId) -> Outcome<Result<answer::Saved, Refused>> {
        let change = self.change()?;
        if event == Event::TakesBack {
            let (behaviour, op) = (self.program.clone(), change.op);
            return self.ben.try_to(request::TakeBack { behaviour, op, again: false, tokens: Vec::new() }).await;
        }
        let now = self.now().await?.records;
        let number = self.next;
        self.propose(self.program.clone(), made(change, &now, event, record, number)).await
    }

    /// Comes to a place.
    async fn comes(&self, place: &Where) -> Outcome<()> {
        let aiko = self.aiko;
        let from = json!(place.from);
        let focus = format!(
            "(() => {{ const it = document.querySelector({from}); it?.focus(); return document.activeElement === it; }})()"
        );
        aiko.until(&focus, place.name).await?;
        for key in place.keys {
            aiko.key(key).await?;
        }
        if let Some(button) = place.press {
            // The panel at the right may have another one of that name.
            let name = json!(button.trim_end_matches('*'));
            let within = if button.ends_with('*') { "header" } else { "#stage" };
            let press = format!(
                "(() => {{ const all = [...document.querySelectorAll('{within} button')];
                    const it = all.find(one => (one.ariaLabel ?? one.innerText).trim().startsWith({name}));
                    it?.click(); return !!it; }})()"
            );
            self.aiko.until(&press, &format!("{}: {button}", place.name)).await?;
        }
        Ok(())
    }

    /// Comes to a place and types there.
    async fn types(&self, place: &Where) -> Outcome<()> {
        self.comes(place).await?;
        let field = json!(place.field);
        let come = format!(
            "(() => {{ const it = document.querySelector({field}); if (!it || it.matches(':disabled')) return false; it.focus();
                it.select(); return document.activeElement === it; }})()"
        );
        self.aiko.until(&come, &format!("{}: the field", place.name)).await?;
        self.aiko.type_text(place.typed).await
    }

    /// What was typed is in the field still, and the keyboard too.
    async fn is_untouched(&self, place: &Where) -> Outcome<()> {
        let js = format!(
            "document.activeElement.matches({}) && document.activeElement.value === {}",
            json!(place.field),
            json!(place.typed)
        );
        self.aiko.until(&js, &format!("{}: what is typed stays", place.name)).await.map(drop)
    }

    /// Goes away from the place.
    async fn leaves(&self) -> Outcome<()> {
        self.aiko.eval("document.activeElement?.blur(), 0").await?;
        Ok(())
    }

    /// Waits until the server has what Aiko typed.
    async fn until_kept(&mut self, place: &Where, what: &str) -> Outcome<()> {
        let key = place.key()?;
        // What a renamed stream is called there follows.
        let typed = if key.kind == Kind::Connector { NUMBER } else { place.typed };
        let began = std::time::Instant::now();
        while began.elapsed() < PATIENCE {
            saved(self.aiko).await?;
            self.aiko.frames().await?;
            let now = self.now().await?.records;
            if now.records.get(&key).is_some_and(|record| format!("{record:?}").contains(typed)) {
                return Ok(());
            }
        }
        let there = self.now().await?.records.records.get(&key).cloned();
        Err(format!("{what}: what Aiko typed is not saved, but {there:?}").into())
    }
}

fn agreed<A>(outcome: Result<A, Refused>, what: &str) -> Outcome<()> {
    outcome.map(drop).map_err(|no| format!("{what}: Ben could not: {no}").into())
}

/// Other words or another number in a record, by Ben.
fn made(change: Change, now: &Behaviour, event: Event, key: &RecordId, number: u32) -> Change {
    let words = format!("Ben {number}");
    let Some(record) = now.records.get(key).cloned() else { return change };
    let other = |connector: behaviour::Connector, body: &str| {
        let mut operation = connector.operation;
        if let Some(procedure) = operation.procedure_mut() {
            *procedure = Procedure::body(body);
        }
        Record::Connector(behaviour::Connector { operation, ..connector })
    };
    match (record, event) {
        (_, Event::Removes) => change.take(now, key.clone()),
        (Record::Connector(connector), Event::Renames) => {
            let stream = RecordId::new(Kind::Stream, &connector.inputs[0]);
            let Some(Record::Stream(mut renamed)) = now.records.get(&stream).cloned() else { return change };
            renamed.name = words;
            let connector = other(connector, &format!("ben{number} < 0.6"));
            change.put(now, stream, Record::Stream(renamed)).put(now, key.clone(), connector)
        }
        (Record::Connector(connector), _) => {
            let connector = other(connector, &format!("distance < {}.5", number + 1));
            change.put(now, key.clone(), connector)
        }
        (Record::Stream(stream), _) => {
            change.put(now, key.clone(), Record::Stream(behaviour::Stream { name: words, ..stream }))
        }
        (Record::Note(_), _) => change.put(now, key.clone(), Record::Note(Note::new(words))),
        (Record::Group(group), _) => change.put(now, key.clone(), Record::Group(Group { title: words, ..group })),
        (Record::Settings(settings), _) => {
            let name = format!("Two people {number}");
            change.put(now, key.clone(), Record::Settings(Settings { name, ..settings }))
        }
        (Record::Place(_) | Record::Helper(_) | Record::Pad(_), _) => change,
    }
}

/// Ben makes the program, and Aiko opens it.
async fn two<'a>(stage: &Stage, aiko: &'a Page) -> Outcome<Two<'a>> {
    let (mut ben, program) = (Visitor::enter_as(&stage.server, "Ben").await?, id("two-people")?);
    let create = request::Create { behaviour: program.clone(), name: "Two people".into(), template: None };
    ben.ask(create).await?;
    let mut first = program_with(&ben.open(&program).await?.records)?;
    let mut two = Two { aiko, ben, program, first: first.clone(), next: 0 };
    two.reset().await?;
    // As the server wrote it down: with who wrote the note, and when.
    first = two.now().await?.records;
    two.first = first;
    aiko.eval(&format!("location.hash = '#/b/{}', 0", two.program)).await?;
    let all = "['.told .inline[role=button]', '[data-note]', '[data-group]'].every(one => document.querySelector(one))";
    aiko.until(all, "the program is open").await?;
    call_myself(aiko, "Aiko").await?;
    Ok(two)
}

/// The records of the program with what a new one has already.
fn program_with(now: &Behaviour) -> Outcome<Behaviour> {
    let mut whole = now.clone();
    whole.records.extend(program()?.records);
    Ok(whole)
}

#[tokio::test]
async fn what_one_types_into_nobody_else_changes_and_they_are_told_who_types() -> Outcome<()> {
    skip::unless!(ready("journey: two people, with a lock"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    let mut two = two(&stage, &aiko).await?;
    for place in PLACES {
        let record = place.key()?;
        two.reset().await?;
        agreed(two.tries(Event::Saves, &record).await?, place.name)?;
        // She types over what she sees.
        let now = two.now().await?.records;
        shows(&aiko, &now, &record).await?;
        two.types(place).await?;
        two.ben.edited(&record, "Aiko").await?;
        for event in place.events() {
            let said = match two.tries(event, &record).await? {
                Err(no) => no.to_string(),
                Ok(other) => return Err(format!("{}: {event:?} was answered with {other:?}", place.name).into()),
            };
            assert!(said.starts_with("Aiko is editing "), "{}, {event:?}: {said}", place.name);
            two.is_untouched(place).await?;
        }
        aiko.key(place.save).await?;
        two.leaves().await?;
        two.until_kept(place, place.name).await?;
        two.ben.freed(&record).await?;
    }
    calm(&aiko)
}

/// Aiko types without a connection, so without a lock, and Ben is first. She goes on typing when the connection is back.
async fn comes_late(two: &mut Two<'_>, socket: &Switch<'_>, place: &Where, event: Event) -> Outcome<()> {
    let cell = format!("{}, {event:?}", place.name);
    let (aiko, record) = (two.aiko, place.key()?);
    two.leaves().await?;
    two.ben.freed(&record).await?;
    two.reset().await?;
    if event == Event::TakesBack {
        agreed(two.tries(Event::Saves, &record).await?, &cell)?;
    }
    let now = two.now().await?.records;
    shows(aiko, &now, &record).await?;
    socket.cut().await?;
    says(aiko, "Offline").await?;
    two.types(place).await?;
    agreed(two.tries(event, &record).await?, &cell)?;
    socket.mend().await?;
    let removed = event == Event::Removes;
    match (removed, place.removed) {
        (true, Removed::Says) => says(aiko, "Ben removed this. What you wrote is still here").await?,
        (true, Removed::Asks) => {}
        (true, _) => says(aiko, "Ben removed this while you were typing. What you typed is kept.").await?,
        (false, _) => {
            let words = "Ben changed this while you were typing. What you typed stays: save it to see both.";
            says(aiko, words).await.map_err(|trouble| house::Trouble(format!("{cell}: {trouble}")))?;
        }
    }
    if !removed || place.removed == Removed::Stays {
        two.is_untouched(place).await?;
        aiko.key(place.save).await?;
        two.leaves().await?;
    }
    if removed && place.removed == Removed::Says {
        aiko.press("button", "Bring it back").await?;
        aiko.until("!document.querySelector('.dialog')", &format!("{cell}: it is back")).await?;
        return two.until_kept(place, &cell).await;
    }
    let did = if removed {
        format!("Ben removed this {}", place.what)
    } else {
        format!("Ben changed this {} too", place.what)
    };
    aiko.find("dialog", &did).await.map_err(|trouble| house::Trouble(format!("{cell}: {trouble}")))?;
    let typed = format!("document.querySelector('.compare')?.innerText.includes({})", json!(place.typed));
    aiko.until(&typed, &format!("{cell}: what Aiko typed is shown")).await?;
    aiko.press("button", if removed { "Bring it back" } else { "Keep mine" }).await?;
    aiko.gone("dialog", &did).await?;
    two.until_kept(place, &cell).await
}

/// Waits until Aiko sees a record as it is now.
async fn shows(aiko: &Page, now: &Behaviour, record: &RecordId) -> Outcome<()> {
    let words = match now.records.get(record) {
        Some(Record::Stream(stream)) => stream.name.clone(),
        Some(Record::Connector(connector)) => {
            let procedure = connector.operation.procedure();
            let number = procedure.and_then(|procedure| match procedure {
                Procedure::Body { body, .. } => body.rsplit(' ').next().map(str::to_owned),
                Procedure::Helper(_) => None,
            });
            let number = number.ok_or("a test without a number")?.replace('.', "\\.");
            let shown = format!("/(^|\\s){number}\\s/.test(document.querySelector('.told')?.innerText ?? '')");
            return aiko.until(&shown, "what Ben did is in the sentence").await.map(drop);
        }
        Some(Record::Note(note)) => note.text.clone(),
        Some(Record::Group(group)) => group.title.clone(),
        Some(Record::Settings(settings)) => settings.name.clone(),
        _ => return Ok(()),
    };
    says(aiko, &words).await
}

#[tokio::test]
async fn who_types_without_a_lock_is_told_who_was_first_and_keeps_what_they_typed() -> Outcome<()> {
    skip::unless!(ready("journey: two people, without a lock"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    let socket = stage.enter_with_switch(&aiko).await?;
    let mut two = two(&stage, &aiko).await?;
    for place in PLACES {
        for event in place.events() {
            comes_late(&mut two, &socket, place, event).await?;
        }
    }
    calm(&aiko)
}

/// The one helper of the library that is edited.
fn helper(name: &str, body: &str) -> Record {
    Record::Helper(Helper { name: name.into(), params: vec!["value".into()], body: body.into(), ..Helper::default() })
}

/// Helpers are everybody's and have no locks: who types is told at once who saved, and decides.
#[tokio::test]
async fn a_helper_that_a_colleague_edits_too_is_never_overwritten() -> Outcome<()> {
    skip::unless!(ready("journey: two people at a helper"));
    let stage = Stage::set().await?;
    let aiko = stage.person("aiko").await?;
    let mut two = two(&stage, &aiko).await?;
    let (library, key): (Id, RecordId) = (id(LIBRARY)?, "helper/ours".parse()?);
    let dialog = || aiko.within("dialog", "Edit helper");
    for event in EVENTS {
        let put = |two: &mut Two, before: Option<Record>, after: Option<Record>| {
            let edit = Edit { id: key.clone(), before, after };
            two.change().map(|change| Change { edits: vec![edit], ..change })
        };
        let first = helper("ours", "value * 2");
        let change = put(&mut two, None, Some(first.clone()))?;
        agreed(two.propose(library.clone(), change).await?, "a helper")?;
        let saves = helper("ours", "value * 3");
        if event == Event::TakesBack {
            let change = put(&mut two, Some(first.clone()), Some(saves.clone()))?;
            agreed(two.propose(library.clone(), change).await?, "a helper")?;
        }
        aiko.press("button", "Edit helper").await?;
        aiko.press("menuitem", "ours*").await?;
        let shown = if event == Event::TakesBack { "value * 3" } else { "value * 2" };
        aiko.until(&format!("document.querySelector('.dialog textarea').value === '{shown}'"), "it is shown").await?;
        dialog().fill("textbox", "Procedure", "value * 100").await?;
        let change = match event {
            Event::Saves => put(&mut two, Some(first.clone()), Some(saves))?,
            Event::Renames => put(&mut two, Some(first.clone()), Some(helper("bens", "value * 2")))?,
            Event::Removes => put(&mut two, Some(first.clone()), None)?,
            Event::TakesBack => put(&mut two, Some(saves), Some(first.clone()))?,
        };
        agreed(two.propose(library.clone(), change).await?, "a helper")?;
        let told = if event == Event::Removes { "Ben removed this." } else { "Ben changed this helper too" };
        says(&aiko, told).await.map_err(|trouble| house::Trouble(format!("{event:?}: {trouble}")))?;
        let stays = "document.activeElement.value === 'value * 100'";
        aiko.until(stays, &format!("{event:?}: what is typed stays")).await?;
        if event == Event::Removes {
            dialog().press("button", "Save").await?;
        } else {
            dialog().press("button", "Keep mine").await?;
        }
        aiko.gone("dialog", "Edit helper").await?;
        // Whatever it is called now, what Aiko typed is what it does.
        aiko.press("button", "Edit helper").await?;
        aiko.press("menuitem", "ours*").await?;
        aiko.until("document.querySelector('.dialog textarea').value === 'value * 100'", "it is saved").await?;
        dialog().press("button", "Remove").await?;
        aiko.gone("dialog", "Edit helper").await?;
        saved(&aiko).await?;
    }
    calm(&aiko)
}

/// Adds what the test keeps out: the head follows that, too.
async fn add_otherwise(two: &mut Two<'_>) -> Outcome<()> {
    let records = json!({
        "stream/rest": { "stream": { "kind": "ordinary", "name": "Otherwise", "order": 7 } },
        "connector/rest": { "connector": { "operation": { "filter": { "body": { "body": "distance >= 0.5" } } },
            "inputs": ["distance"], "output": "rest", "order": 9 } },
        "place/rest": { "place": { "x": 170.0, "y": 280.0 } },
    });
    for (key, record) in records.as_object().into_iter().flatten() {
        two.first.records.insert(key.parse()?, serde_json::from_value(record.clone())?);
    }
    Ok(())
}

/// Returns what a filter of the program asks now.
fn asks(now: &Behaviour, connector: &str) -> Outcome<String> {
    match now.connector(&id(connector)?).and_then(|one| one.operation.procedure()) {
        Some(Procedure::Body { body, .. }) => Ok(body.clone()),
        other => Err(format!("{connector} is {other:?}").into()),
    }
}

impl Two<'_> {
    /// Ben edits a filter; an otherwise follows, as it does in a page.
    async fn edits(&mut self, connector: &str, body: &str) -> Outcome<Result<answer::Saved, Refused>> {
        let (now, change) = (self.now().await?.records, self.change()?);
        let key = RecordId::new(Kind::Connector, &id(connector)?);
        let mut record = now.records.get(&key).cloned().ok_or("no filter")?;
        if let Record::Connector(one) = &mut record
            && let Some(procedure) = one.operation.procedure_mut()
        {
            *procedure = Procedure::body(body);
        }
        let change = behaviour::with_otherwise(&now, change.put(&now, key, record));
        self.propose(self.program.clone(), change).await
    }

    /// Aiko types at a test without a connection, and Ben edits a filter meanwhile.
    async fn types_offline(&mut self, socket: &Switch<'_>, test: &Where, theirs: (&str, &str)) -> Outcome<()> {
        let aiko = self.aiko;
        self.reset().await?;
        self.both("distance < 0.5", "distance >= 0.5", "as it was").await?;
        shows(aiko, &self.now().await?.records, &test.key()?).await?;
        socket.cut().await?;
        says(aiko, "Offline").await?;
        self.types(test).await?;
        aiko.key(test.save).await?;
        self.leaves().await?;
        agreed(self.edits(theirs.0, theirs.1).await?, theirs.0)?;
        socket.mend().await
    }

    /// Waits until the server has both sides like this.
    async fn both(&mut self, test: &str, rest: &str, what: &str) -> Outcome<()> {
        let began = std::time::Instant::now();
        let mut there = (String::new(), String::new());
        while began.elapsed() < PATIENCE {
            saved(self.aiko).await?;
            self.aiko.frames().await?;
            let now = self.now().await?.records;
            there = (asks(&now, "near")?, asks(&now, "rest")?);
            if there == (test.to_owned(), rest.to_owned()) {
                return Ok(());
            }
        }
        Err(format!("{what}: the two sides are {there:?}").into())
    }
}

/// Two people at a test and at its otherwise: the two sides never overlap or leave a gap that nobody made.
#[tokio::test]
async fn an_otherwise_follows_whoever_is_first_and_nobody_who_types_at_it_loses_that() -> Outcome<()> {
    skip::unless!(ready("journey: two people at an otherwise"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    let socket = stage.enter_with_switch(&aiko).await?;
    let mut two = two(&stage, &aiko).await?;
    add_otherwise(&mut two).await?;
    two.reset().await?;
    says(&aiko, "Otherwise").await?;
    let test = &PLACES[0];
    let rest = Where { record: "connector/rest", from: "[data-chip='rest']", ..PLACES[0] };

    // Aiko types at the otherwise: who edits the test, which would change it, is told by name.
    two.types(&rest).await?;
    two.ben.edited(&rest.key()?, "Aiko").await?;
    match two.edits("near", "distance < 0.6").await? {
        Err(no) => assert!(no.to_string().starts_with("Aiko is editing "), "{no}"),
        Ok(other) => return Err(format!("the test was edited: {other:?}").into()),
    }
    two.is_untouched(&rest).await?;
    aiko.key("Escape").await?;
    two.leaves().await?;
    two.ben.freed(&rest.key()?).await?;
    agreed(two.edits("near", "distance < 0.6").await?, "the test")?;
    two.both("distance < 0.6", "distance >= 0.6", "Ben was first").await?;

    // Aiko types at the test: its otherwise is what Ben makes of it.
    two.reset().await?;
    two.both("distance < 0.5", "distance >= 0.5", "as it was").await?;
    two.types(test).await?;
    two.ben.edited(&test.key()?, "Aiko").await?;
    agreed(two.edits("rest", "distance > 0.9").await?, "the otherwise")?;
    two.is_untouched(test).await?;
    aiko.key(test.save).await?;
    two.leaves().await?;
    two.both("distance < 0.35", "distance > 0.9", "Ben has one of his own").await?;
    two.ben.freed(&test.key()?).await?;

    // Without a connection, at the test that Ben changes with its otherwise: both follow what Aiko keeps.
    two.types_offline(&socket, test, ("near", "distance < 0.7")).await?;
    aiko.find("dialog", "Ben changed this filter too").await?;
    aiko.press("button", "Keep mine").await?;
    aiko.gone("dialog", "Ben changed this filter too").await?;
    two.both("distance < 0.35", "distance >= 0.35", "Aiko keeps hers").await?;

    // Without a connection, at the test whose otherwise Ben makes one of his own: hers is saved, and his stays.
    two.types_offline(&socket, test, ("rest", "distance > 0.9")).await?;
    two.both("distance < 0.35", "distance > 0.9", "each has their own").await?;
    calm(&aiko)
}

impl Two<'_> {
    /// Aiko changes a filter without a connection, Ben locks it, and Aiko hears of that when she is back. Returns the records
    /// as they were before and Ben's token.
    async fn locked_meanwhile(&mut self, socket: &Switch<'_>, place: &Where) -> Outcome<(Behaviour, LockToken)> {
        let (aiko, record) = (self.aiko, place.key()?);
        self.reset().await?;
        shows(aiko, &self.now().await?.records, &record).await?;
        socket.cut().await?;
        says(aiko, "Offline").await?;
        self.types(place).await?;
        aiko.key(place.save).await?;
        self.leaves().await?;
        // A person who opens a program once more gives back their locks there, so Ben looks before.
        let now = self.now().await?.records;
        let (behaviour, records) = (self.program.clone(), [record].into());
        let grant = self.ben.ask(request::Lock { behaviour, records }).await?.grant;
        socket.mend().await?;
        says(aiko, "Ben is editing this. What you changed is kept").await?;
        says(aiko, "All other changes saved").await?;
        Ok((now, grant.token))
    }
}

/// A change that was made without a connection waits for the colleague who is editing the same: it is neither lost nor put
/// over what they save.
#[tokio::test]
async fn what_was_changed_offline_waits_for_who_is_editing_it() -> Outcome<()> {
    skip::unless!(ready("journey: two people, one offline and one editing"));
    let stage = Stage::set().await?;
    let aiko = stage.nobody("aiko").await?;
    let socket = stage.enter_with_switch(&aiko).await?;
    let mut two = two(&stage, &aiko).await?;
    let place = &PLACES[0];
    let record = place.key()?;
    for saves in [false, true] {
        let (now, token) = two.locked_meanwhile(&socket, place).await?;
        let behaviour = two.program.clone();
        if saves {
            // Refused if hers was saved before.
            let change = made(two.change()?, &now, Event::Saves, &record, 0);
            let (behaviour, tokens) = (behaviour.clone(), vec![token]);
            agreed(two.ben.try_to(request::Propose { behaviour, change, tokens }).await?, "Ben saves")?;
        }
        agreed(two.ben.try_to(request::Unlock { behaviour, token }).await?, "Ben is done")?;
        if saves {
            aiko.find("dialog", "Ben changed this filter too").await?;
            aiko.press("button", "Keep mine").await?;
        }
        two.until_kept(place, "Ben is done").await?;
        two.ben.freed(&record).await?;
    }
    calm(&aiko)
}
