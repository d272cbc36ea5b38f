//! Scenes of edits while a robot runs the program: what it does not use yet, whose that is, and who is still at it.

use crate::known::{BALLS, program};
use crate::server::{Server, id};
use crate::sketch::{connector, filter};
use crate::table::{AIKO, BEN, Table};
use behaviour::{
    Accepted, Behaviour, Change, Helper, Id, Kind, Place, Procedure, Record, RecordId, Stream, connectors,
};
use editor::graph::{ConnectPlan, NewSpot, Output};
use editor::unused::{Unused, UnusedAuthors, authors, before, unused, unused_changes, whose};
use std::collections::BTreeSet;

/// Two people at a program that runs, and how long its log was when the robot took it.
struct Running {
    table: Table,
    since: usize,
}

impl Running {
    fn start() -> Self {
        Self { table: Table::knowing(BALLS), since: 0 }
    }

    /// The robot takes the program as it is now.
    fn apply(&mut self) {
        self.since = self.table.server.log.len();
    }

    fn since(&self) -> &[Accepted] {
        &self.table.server.log[self.since..]
    }

    /// Returns the changes that the robot would take, as somebody sees them.
    fn unused(&self, who: usize) -> Vec<Unused> {
        let now = |id: &RecordId| self.table.program().records.get(id).cloned();
        unused_changes(&before(self.since()), &authors(self.since()), Some(&Server::client(who)), now)
    }

    /// Returns the parts of the graph that are marked as not used yet.
    fn marked(&self) -> BTreeSet<Id> {
        unused(&before(self.since()), self.table.program(), &Behaviour::default())
    }

    /// Names somebody else who is still at something that the robot would take, and that, as Aiko hears it.
    fn unfinished(&self) -> Option<(String, Id)> {
        let theirs = self.unused(AIKO).into_iter().filter(|unused| unused.by.is_some());
        let editor = self.table.editor(AIKO);
        let at = |unused: Unused| {
            let (_, lock) = editor.edited_by_others().find(|(record, _)| **record == unused.id)?;
            Some((lock.name.clone(), unused.id.id))
        };
        theirs.into_iter().find_map(at)
    }
}

#[test]
fn edits_wait_until_they_are_applied_and_it_is_said_whose_they_are() {
    let mut run = Running::start();
    assert_eq!((run.unused(AIKO), run.marked()), (Vec::new(), BTreeSet::new()), "the robot runs this version");
    let output = Output::New { name: "Tracker".to_owned(), device: Some("Tracker".to_owned()), params: [].into() };
    let (operation, inputs) = (connectors::to_action().with(()), vec![id("distance")]);
    run.table.gesture(BEN, |editor, op| {
        editor.connect(op, ConnectPlan { operation, inputs, output, spot: NewSpot::Below });
    });
    let made = run.table.named("Tracker");
    let of: Vec<(Kind, Option<String>)> = run.unused(AIKO).into_iter().map(|one| (one.id.kind, one.by)).collect();
    assert_eq!(of, [(Kind::Stream, Some("Ben".to_owned())), (Kind::Connector, Some("Ben".to_owned()))]);
    assert!(run.unused(AIKO).iter().all(|one| one.was.is_none() && one.is.is_some()), "it was added");
    assert!(run.marked().contains(&made) && run.marked().len() == 2, "{:?}", run.marked());
    let said = |run: &Running| [AIKO, BEN].map(|who| whose(&run.unused(who)));
    assert_eq!(said(&run), [UnusedAuthors::One("Ben".to_owned()), UnusedAuthors::Me]);
    run.table.operates(AIKO, "c4", filter("distance < 0.4"));
    assert_eq!(said(&run), [UnusedAuthors::Several, UnusedAuthors::Several]);
    run.apply();
    assert_eq!((run.unused(AIKO), run.unused(BEN), run.marked()), (Vec::new(), Vec::new(), BTreeSet::new()));
}

#[test]
fn only_what_would_run_differently_is_an_edit() {
    let mut run = Running::start();
    run.table.does(AIKO, |page| page.input(|editor| editor.move_to(&[(id("ball"), Place { x: 0.0, y: 0.0 })])));
    run.table.sets("head", |seen| Stream { name: "Follow".to_owned(), ..seen });
    run.table.gesture(BEN, |editor, op| drop(editor.add_note(op, "Ask Yuki", Place { x: 0.0, y: 0.0 })));
    assert_eq!(run.table.server.log.len(), 3, "all of it is saved");
    assert_eq!((run.unused(BEN), run.marked()), (Vec::new(), BTreeSet::new()), "and nothing to the robot");
    run.table.sets("head", |mut seen| {
        seen.params.insert("mode".to_owned(), behaviour::Value::text("WholeBody"));
        seen
    });
    assert_eq!(run.marked(), [id("head")].into());
    run.table.undo(AIKO);
    assert_eq!((run.unused(BEN), run.marked()), (Vec::new(), BTreeSet::new()), "it is as the robot has it again");

    // A helper that it uses makes a difference to what uses it, until it works as before.
    let key = RecordId::new(Kind::Helper, &id("metres"));
    let helper = |body: &str| {
        let (name, params) = ("ball_to_distance".to_owned(), vec!["ball".to_owned()]);
        Record::Helper(Helper { name, params, body: body.to_owned(), ..Helper::default() })
    };
    let mut library = Behaviour::default();
    library.records.insert(key.clone(), helper("0.03 / sin(ball.size)"));
    let mut writes = |body: &str| {
        let change = Change::of(id("write"), "Aiko", "Edit helper").put(&library, key.clone(), helper(body));
        library.apply(&change);
        let was = before(&[Accepted { revision: 1, change }]);
        (was, library.clone())
    };
    let (was, now) = writes("1000");
    assert_eq!(unused(&was, &program(BALLS), &now), [id("c1")].into());
    let (_, now) = writes("0.03 / sin(ball.size)");
    assert!(unused(&was, &program(BALLS), &now).is_empty());
}

#[test]
fn what_somebody_else_is_still_at_is_said_with_who_and_from_what_to_what() {
    let mut run = Running::start();
    run.table.operates(BEN, "c4", filter("distance < 0.4"));
    let number = run.table.does(BEN, |page| page.input(|editor| editor.open_editor(connector("c4").record())));
    assert_eq!(run.unfinished(), Some(("Ben".to_owned(), id("c4"))));
    run.table.does(BEN, |page| page.input(|editor| editor.close_editor(number)));
    assert_eq!(run.unfinished(), None);
    run.apply();
    run.table.operates(BEN, "c4", filter("distance < 0.6"));
    let [unused] = &run.unused(AIKO)[..] else { panic!("{:?}", run.unused(AIKO)) };
    let body = |record: &Option<Record>| match record {
        Some(Record::Connector(one)) => one.operation.procedure().cloned(),
        other => panic!("{other:?}"),
    };
    let bodies = ["distance < 0.4", "distance < 0.6"].map(|body| Some(Procedure::body(body)));
    assert_eq!([body(&unused.was), body(&unused.is)], bodies);
    let mine = run.table.does(AIKO, |page| page.input(|editor| editor.open_editor(connector("c4").record())));
    assert_eq!(run.unfinished(), None, "one's own editor is nobody else's");
    run.table.does(AIKO, |page| page.input(|editor| editor.close_editor(mine)));
}
