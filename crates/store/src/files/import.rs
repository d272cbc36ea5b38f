//! The changes of an import: the behaviour that the file makes, and the helpers that join the library.

mod helpers;

use behaviour::labels::import as import_label;
use behaviour::{Behaviour, BehaviourFile, Change, EDITS_MAX, Edit, Id, Record, RecordId};
use helpers::Shelved;
use phrase::{Phrase, Phrased, phrase};

/// Whose ids the imported behaviour gets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImportMode {
    /// New ones: a second behaviour beside the first.
    Copy,
    /// The file's own: the same behaviour again, in a store that does not have it.
    Restore,
}

/// The changes to save so that a file is imported: first the library, then the behaviour from nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Import {
    /// The behaviour's id.
    pub behaviour: Id,
    /// The name of the behaviour in the file.
    pub name: String,
    /// The change to the library; none if it has all helpers already.
    pub library: Option<Change>,
    /// The changes that make the behaviour, in order, from revision 1. Almost always one.
    pub changes: Vec<Change>,
    /// Helpers whose names meant something else here: the name in the file and the one they have now.
    pub renamed: Vec<(String, String)>,
}

impl Import {
    /// This import under a name that is free where it goes.
    #[must_use]
    pub fn named(mut self, name: &str) -> Self {
        for change in &mut self.changes {
            change.label = import_label(name);
            for edit in &mut change.edits {
                if let Some(Record::Settings(settings)) = &mut edit.after {
                    name.clone_into(&mut settings.name);
                }
            }
        }
        Self { name: name.to_owned(), ..self }
    }
}

/// The reasons why a file cannot be imported; said with the id of what it is about first, `id: reason`.
#[derive(Clone, Debug, PartialEq, Eq, Phrased)]
pub enum ImportError {
    /// A helper of this name calls itself, also through others.
    #[error("{id}: {reason}", id = _0, reason = phrase!("ImportError.Itself", "it calls itself, also through others. Change its body."))]
    Circle(String),
    /// The behaviour's own id is none; with the reason.
    #[error("{id}: {reason}", id = "id", reason = _0)]
    OwnId(Phrase),
    /// The records are not as they should be; with what `behaviour` says, id first.
    #[error("{0}")]
    Record(Phrase),
}

/// Returns the changes of importing `file`, given the library as it is now and a source of new ids.
///
/// # Errors
/// Every reason.
pub fn import(
    file: &BehaviourFile,
    mode: ImportMode,
    library: &Behaviour,
    by: &str,
    mut new_id: impl FnMut() -> Id,
) -> Result<Import, Vec<ImportError>> {
    let mut file = file.clone();
    file.read_as_meant();
    let Shelved { names, change } = helpers::shelve(&file, library, by, &mut new_id).map_err(|reason| vec![reason])?;
    let file = helpers::renamed(&file, &names);
    let records = match mode {
        ImportMode::Copy => file.records(|_| Some(new_id())),
        ImportMode::Restore => file.records(|_| None),
    };
    let mut records = records.map_err(|faults| unfit(&faults))?;
    if mode == ImportMode::Copy {
        records.use_names_of_today();
    }
    let own = file.id.as_deref().filter(|_| mode == ImportMode::Restore);
    let behaviour =
        own.map_or_else(|| Ok(new_id()), Id::new).map_err(|reason| vec![ImportError::OwnId(reason.phrase())])?;
    let changes = from_nothing(&records, &file.name, by, &mut new_id);
    let renamed = names.into_iter().filter(|(old, new)| old != new).collect();
    let library = Some(change).filter(|change| !change.edits.is_empty());
    Ok(Import { behaviour, name: file.name, library, changes, renamed })
}

fn unfit(records: &[impl Phrased]) -> Vec<ImportError> {
    records.iter().map(|fault| ImportError::Record(fault.phrase())).collect()
}

/// The changes that make all records, streams before what needs them.
fn from_nothing(records: &Behaviour, name: &str, by: &str, new_id: &mut impl FnMut() -> Id) -> Vec<Change> {
    debug_assert!(records.records.contains_key(&RecordId::settings()), "a file always has settings");
    let all: Vec<(&RecordId, &Record)> = records.records.iter().collect();
    let mut changes = Vec::new();
    for part in all.chunks(EDITS_MAX) {
        let edit = |(id, record): &(&RecordId, &Record)| {
            let (id, after) = ((*id).clone(), Some((*record).clone()));
            Edit { id, before: None, after }
        };
        changes.push(Change { edits: part.iter().map(edit).collect(), ..Change::of(new_id(), by, import_label(name)) });
    }
    changes
}

#[cfg(test)]
mod tests {
    use super::{Import, ImportError, ImportMode, import};
    use crate::files::samples::templates;
    use behaviour::{
        Behaviour, BehaviourFile, Change, FileHelper, Helper, Id, Kind, Procedure, Record, RecordId, StreamKind,
    };

    fn ids() -> impl FnMut() -> Id {
        let mut next = 0;
        move || {
            next += 1;
            Id::new(&format!("new{next}")).expect("an id")
        }
    }

    fn helper(name: &str, body: &str) -> FileHelper {
        FileHelper {
            name: name.to_owned(),
            params: vec!["x".to_owned()],
            body: body.to_owned(),
            ..FileHelper::default()
        }
    }

    fn library(helpers: &[(&str, &str)]) -> Behaviour {
        let record = |(at, (name, body)): (usize, &(&str, &str))| {
            let FileHelper { name, params, body, .. } = helper(name, body);
            let id = Id::new(&format!("h{at}")).expect("an id");
            (RecordId::new(Kind::Helper, &id), Record::Helper(Helper { name, params, body, ..Helper::default() }))
        };
        Behaviour { records: helpers.iter().enumerate().map(record).collect() }
    }

    /// A sensor, and one map after the other.
    fn file(helpers: Vec<FileHelper>, maps: &[Procedure]) -> BehaviourFile {
        let text = r#"{"format":"rrp-behaviour/1","id":"own","name":"Near","helpers":[],
            "streams":[{"id":"s0","kind":"sensor","name":"Near","device":"RedBall"}],"connectors":[]}"#;
        let mut file = crate::files::read(text.as_bytes()).expect("a file");
        file.helpers = helpers;
        for (at, procedure) in maps.iter().enumerate() {
            let (mut stream, mut text) = (file.streams[0].clone(), (None, None));
            stream.kind = StreamKind::Ordinary;
            stream.id = format!("s{}", at + 1);
            file.streams.push(stream);
            match procedure {
                Procedure::Body { body, .. } => text.0 = Some(body.clone()),
                Procedure::Helper(name) => text.1 = Some(name.clone()),
            }
            file.connectors.push(behaviour::FileConnector {
                id: format!("c{at}"),
                operation: "map".to_owned(),
                inputs: vec!["s0".to_owned()],
                output: format!("s{}", at + 1),
                body: text.0,
                args: None,
                helper: text.1,
                period_ms: None,
                start: None,
            });
        }
        file
    }

    fn said(refused: &[ImportError]) -> Vec<String> {
        refused.iter().map(ImportError::to_string).collect()
    }

    fn done(made: &Import) -> Behaviour {
        let mut behaviour = Behaviour::default();
        made.changes.iter().for_each(|change| behaviour.apply(change));
        behaviour
    }

    /// Name and body of what the library gets.
    fn added(change: Option<&Change>) -> Vec<(String, String)> {
        let edits = change.map_or(&[][..], |change| &change.edits);
        let helper = |edit: &behaviour::Edit| match &edit.after {
            Some(Record::Helper(helper)) => (helper.name.clone(), helper.body.clone()),
            other => panic!("{other:?}"),
        };
        let mut all: Vec<_> = edits.iter().map(helper).collect();
        all.sort();
        all
    }

    fn added_in_order(change: Option<&Change>) -> Vec<String> {
        let edits = change.map_or(&[][..], |change| &change.edits).iter();
        let name = |edit: &behaviour::Edit| match &edit.after {
            Some(Record::Helper(helper)) => helper.name.clone(),
            other => panic!("{other:?}"),
        };
        edits.map(name).collect()
    }

    fn procedures(made: &Import) -> Vec<Procedure> {
        let behaviour = done(made);
        let all = behaviour.connectors_in_order();
        all.into_iter().filter_map(|(_, connector)| connector.operation.procedure().cloned()).collect()
    }

    #[test]
    fn a_helper_that_is_there_with_the_same_meaning_is_used() {
        let file = file(vec![helper("near", "x < 1")], &[Procedure::Helper("near".into())]);
        let made = import(&file, ImportMode::Copy, &library(&[("near", "x < 1")]), "Aiko", ids()).unwrap();
        assert_eq!((made.library.as_ref(), made.renamed.len()), (None, 0));
        assert_eq!(procedures(&made), [Procedure::Helper("near".into())]);
        assert_eq!(made.changes[0].author, "Aiko");
    }

    #[test]
    fn a_helper_that_means_something_else_here_gets_a_free_name_wherever_it_is_used() {
        let helpers = vec![helper("near", "x < 1"), helper("near3", "1"), helper("close", "near(x) && far(x)")];
        let maps = [Procedure::Helper("near".into()), Procedure::body("near < 1 || near(near) || close(near)")];
        let there = library(&[("near", "x < 2"), ("near2", "x < 3")]);
        let made = import(&file(helpers, &maps), ImportMode::Copy, &there, "Aiko", ids()).unwrap();
        assert_eq!(made.renamed, [("near".to_owned(), "near4".to_owned())]);
        let wanted = [("close", "near4(x) && far(x)"), ("near3", "1"), ("near4", "x < 1")];
        assert_eq!(added(made.library.as_ref()), wanted.map(|(name, body)| (name.to_owned(), body.to_owned())));
        let wanted = [Procedure::Helper("near4".into()), Procedure::body("near < 1 || near4(near) || close(near)")];
        assert_eq!(procedures(&made), wanted);
    }

    #[test]
    fn what_a_robot_says_keeps_the_name_of_a_helper_that_gets_another() {
        let (said, called) = ("`You are near (about ${near} m)`", "`near (${`near ${near(near)}`})`");
        let maps = [Procedure::body(said), Procedure::body(called)];
        let there = library(&[("near", "x < 1")]);
        let made =
            import(&file(vec![helper("near", "x < 2")], &maps), ImportMode::Copy, &there, "Aiko", ids()).unwrap();
        assert_eq!(made.renamed, [("near".to_owned(), "near2".to_owned())]);
        let wanted = [Procedure::body(said), Procedure::body("`near (${`near ${near2(near)}`})`")];
        assert_eq!(procedures(&made), wanted);
    }

    #[test]
    fn a_helper_whose_name_looks_the_same_is_that_one() {
        let (composed, decomposed) = ("n\u{e9}ar", "ne\u{301}ar");
        let maps = [Procedure::body(&format!("{decomposed}(near)"))];
        let file = file(vec![helper(decomposed, "x < 1")], &maps);
        let same = import(&file, ImportMode::Copy, &library(&[(composed, "x < 1")]), "Aiko", ids()).unwrap();
        assert_eq!(procedures(&same), [Procedure::body(&format!("{composed}(near)"))]);
        assert!(same.library.is_none());
        let other = import(&file, ImportMode::Copy, &library(&[(composed, "x < 2")]), "Aiko", ids()).unwrap();
        assert_eq!(procedures(&other), [Procedure::body(&format!("{composed}2(near)"))]);
    }

    #[test]
    fn procedures_are_read_as_they_are_meant() {
        let mut texts = ["near.size\u{3000}＜ ０．５", "near.size ≤ 0,5 && “é” != `0,5 “×”`", "near.size < 1,000"]
            .map(Procedure::body);
        let file = crate::files::write_json(&file(vec![helper("far", "x ≥ 1,5")], &texts));
        let made =
            import(&crate::files::read(file.as_bytes()).unwrap(), ImportMode::Copy, &library(&[]), "Aiko", ids())
                .unwrap();
        texts[0] = Procedure::body("near.size < 0.5");
        texts[1] = Procedure::body("near.size <= 0.5 && \"é\" != `0,5 “×”`");
        assert_eq!(procedures(&made), texts, "what may be read in two ways stays, to be asked about");
        assert_eq!(added(made.library.as_ref()), [("far".to_owned(), "x >= 1.5".to_owned())]);
    }

    #[test]
    fn a_helper_whose_own_helper_differs_means_something_else() {
        let helpers = vec![helper("close", "near(x)"), helper("near", "x < 1")];
        let there = library(&[("near", "x < 2"), ("close", "near(x)")]);
        let made = import(&file(helpers, &[]), ImportMode::Copy, &there, "Aiko", ids()).unwrap();
        let pair = |a: &str, b: &str| (a.to_owned(), b.to_owned());
        assert_eq!(made.renamed, [pair("close", "close2"), pair("near", "near2")]);
        assert_eq!(added(made.library.as_ref()), [pair("close2", "near2(x)"), pair("near2", "x < 1")]);
    }

    #[test]
    fn imported_again_the_numbered_helper_is_found() {
        let file = file(vec![helper("near", "x < 1")], &[Procedure::Helper("near".into())]);
        let mut there = library(&[("near", "x < 2")]);
        let first = import(&file, ImportMode::Copy, &there, "Aiko", ids()).unwrap();
        there.apply(&first.library.unwrap());
        let again = import(&file, ImportMode::Copy, &there, "Aiko", ids()).unwrap();
        assert_eq!((again.library, again.renamed), (None, first.renamed));
    }

    #[test]
    fn a_copy_has_new_ids_and_a_restored_one_its_own() {
        for (name, text) in templates() {
            let mut file = crate::files::read(text.as_bytes()).unwrap();
            file.id = Some("own".to_owned());
            let restored = import(&file, ImportMode::Restore, &library(&[]), "Aiko", ids()).unwrap();
            assert_eq!(done(&restored), file.records(|_| None).unwrap(), "{name}");
            assert_eq!(restored.behaviour.as_str(), "own");
            let copied = import(&file, ImportMode::Copy, &library(&[]), "Aiko", ids()).unwrap();
            assert!(copied.behaviour.as_str().starts_with("new") && copied.name == file.name);
            let library = file.library();
            let mut again = BehaviourFile::of(&done(&copied), &library.iter().collect::<Vec<_>>());
            assert!(again.streams.iter().all(|stream| stream.id.starts_with("new")), "{name}");
            let mut plain = file.clone();
            for one in [&mut again, &mut plain] {
                one.streams.iter_mut().for_each(|stream| stream.id.clear());
                one.layout.clear();
            }
            assert_eq!(again.streams, plain.streams, "{name}");
        }
    }

    #[test]
    fn helpers_that_call_each_other_in_a_circle_and_missing_streams_are_refused() {
        let circle = file(vec![helper("a", "b(x)"), helper("b", "a(x)")], &[]);
        let refused = import(&circle, ImportMode::Copy, &library(&[]), "Aiko", ids()).unwrap_err();
        assert_eq!(said(&refused), ["a: it calls itself, also through others. Change its body."]);
        let mut dangling = file(vec![], &[Procedure::body("1")]);
        dangling.connectors[0].inputs = vec!["nobody".to_owned()];
        let refused = import(&dangling, ImportMode::Copy, &library(&[]), "Aiko", ids()).unwrap_err();
        assert_eq!(said(&refused), ["c0: there is no stream \"nobody\""]);
    }

    #[test]
    fn it_can_have_another_name_than_in_the_file() {
        let made = import(&file(vec![], &[]), ImportMode::Copy, &library(&[]), "Aiko", ids()).unwrap().named("Near 2");
        assert_eq!(
            (done(&made).name(), made.name.as_str(), made.changes[0].label.to_string().as_str()),
            ("Near 2", "Near 2", "Import Near 2")
        );
    }

    #[test]
    fn chained_and_dense_helpers_are_sorted_with_each_body_read_once() {
        let chain =
            |at: usize| helper(&format!("h{at}"), &if at == 0 { "x".to_owned() } else { format!("h{}(x)", at - 1) });
        let dense = |at: usize| helper(&format!("h{at}"), &(0..at).map(|to| format!("h{to}(x);")).collect::<String>());
        for helpers in [(0..1_000).rev().map(chain).collect::<Vec<_>>(), (0..1_000).rev().map(dense).collect()] {
            let made = import(&file(helpers, &[]), ImportMode::Copy, &library(&[]), "Aiko", ids()).unwrap();
            let names: Vec<_> = added_in_order(made.library.as_ref());
            assert!(names.iter().eq((0..1_000).map(|at| format!("h{at}")).collect::<Vec<_>>().iter()));
        }
    }

    #[test]
    fn a_behaviour_too_large_for_one_change_is_made_by_several() {
        let mut file = file(vec![], &vec![Procedure::body("1"); 1_500]);
        for (at, prefix) in
            [("s", 1_501), ("c", 1_500), ("x", 6_000)].into_iter().flat_map(|(p, n)| (0..n).map(move |at| (at, p)))
        {
            file.layout.insert(format!("{prefix}{at}"), behaviour::Place { x: 0.0, y: 0.0 });
        }
        let made = import(&file, ImportMode::Restore, &library(&[]), "Aiko", ids()).unwrap();
        assert_eq!(made.changes.len(), 2);
        assert_eq!(done(&made), file.records(|_| None).unwrap());
    }
}
