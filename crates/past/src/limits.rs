//! The numbers with which conditions of two programs compare, where they are not the same.

use behaviour::{BehaviourFile, FileConnector, connectors};
use protocol::{CHANGED_LIMITS_MAX, ChangedLimit, LaneName};
use sentences::{TestedNumber, tested_numbers};

/// The numbers of all conditions that are not the same in both programs, in the order of the new one, then those that are gone.
pub(crate) fn changed_limits(before: &BehaviourFile, now: &BehaviourFile) -> Vec<ChangedLimit> {
    let find = |file: &BehaviourFile, id: &str| file.connectors.iter().position(|one| one.id == id);
    let kept = now.connectors.iter().map(|one| (find(before, &one.id).map(|at| &before.connectors[at]), Some(one)));
    let gone = before.connectors.iter().filter(|one| find(now, &one.id).is_none()).map(|one| (Some(one), None));
    let told =
        |file: &BehaviourFile, one: Option<&FileConnector>| one.map(|one| numbers(file, one)).unwrap_or_default();
    let all = kept.chain(gone).flat_map(|(old, new)| {
        let id = new.or(old).map(|one| one.id.clone()).unwrap_or_default();
        changed(&id, told(before, old), told(now, new))
    });
    all.take(CHANGED_LIMITS_MAX).collect()
}

/// The numbers of one condition that are not the same. Numbers of one lane are compared by the order in which they stand.
fn changed(connector: &str, mut old: Vec<(LaneName, f64)>, new: Vec<(LaneName, f64)>) -> Vec<ChangedLimit> {
    let mut all = Vec::new();
    let limit = |of: LaneName, before, now| ChangedLimit { connector: connector.to_owned(), of, before, now };
    for (of, number) in new {
        let at = old.iter().position(|(lane, _)| *lane == of);
        let before = at.map(|at| old.remove(at).1);
        if before != Some(number) {
            all.push(limit(of, before, Some(number)));
        }
    }
    all.extend(old.into_iter().map(|(of, number)| limit(of, Some(number), None)));
    all
}

/// The lanes and the numbers of a condition over one stream.
fn numbers(file: &BehaviourFile, connector: &FileConnector) -> Vec<(LaneName, f64)> {
    let (Some(body), [input]) = (&connector.body, &connector.inputs[..]) else { return Vec::new() };
    let Some(spec) = connectors::spec(&connector.operation).filter(|spec| spec.is_test()) else { return Vec::new() };
    // Where the names of its arguments are not written, they are those of its streams.
    let name = file.streams.iter().find(|stream| stream.id == *input).map(|stream| stream.name.as_str());
    let args = connector.args.clone().unwrap_or_else(|| spec.arguments_of(body, name));
    let lane = |TestedNumber { field, number }| (LaneName { stream: input.clone(), field }, number);
    tested_numbers(body, &args).into_iter().map(lane).collect()
}

#[cfg(test)]
mod tests {
    use super::changed_limits;
    use behaviour::BehaviourFile;

    fn file(conditions: &[(&str, &str)]) -> BehaviourFile {
        let connector = |(id, body): &(&str, &str)| {
            let operation = if body.is_empty() { "map" } else { "filter" };
            serde_json::json!({"id": id, "type": operation, "inputs": ["face"], "output": "near", "args": ["face"], "body": body})
        };
        serde_json::from_value(serde_json::json!({"format": "rrp-behaviour/1", "name": "N", "helpers": [],
            "streams": [{"id": "face", "kind": "sensor", "name": "Face", "device": "FaceDetection"},
                {"id": "near", "kind": "ordinary", "name": "Near"}],
            "connectors": conditions.iter().map(connector).collect::<Vec<_>>()}))
        .unwrap()
    }

    fn told(before: &[(&str, &str)], now: &[(&str, &str)]) -> Vec<(String, Option<f64>, Option<f64>)> {
        let all = changed_limits(&file(before), &file(now));
        let one = |one: protocol::ChangedLimit| {
            (format!("{}.{}", one.connector, one.of.field.unwrap_or_default()), one.before, one.now)
        };
        all.into_iter().map(one).collect()
    }

    #[test]
    fn numbers_that_are_others_are_told_with_those_of_before() {
        let before = [("a", "face.distance < 0.75"), ("b", "face.size > 3"), ("c", "face.x > 1 && face.x < 2")];
        assert!(told(&before, &before).is_empty());
        let now = [("a", "face.distance < 0.6"), ("c", "face.x > 1 && face.x < 4"), ("d", "face.y < 5")];
        let limit = |name: &str, before, now| (name.to_owned(), before, now);
        assert_eq!(
            told(&before, &now),
            [
                limit("a.distance", Some(0.75), Some(0.6)),
                limit("c.x", Some(2.0), Some(4.0)),
                limit("d.y", None, Some(5.0)),
                limit("b.size", Some(3.0), None),
            ]
        );
        assert_eq!(told(&[("a", "face.size > 3")], &[("a", "face.x > 3")]).len(), 2, "another field is another lane");
        assert_eq!(told(&[("a", "face.size > 3")], &[("a", "")]), [limit("a.size", Some(3.0), None)]);
    }

    #[test]
    fn a_condition_needs_no_names_of_its_arguments() {
        let bare = |body: &str| {
            let mut file = file(&[("a", body)]);
            file.connectors[0].args = None;
            file
        };
        let all = changed_limits(&bare("face.size > 3"), &file(&[("a", "face.size > 4")]));
        assert_eq!(all.iter().map(|one| (one.before, one.now)).collect::<Vec<_>>(), [(Some(3.0), Some(4.0))]);
    }
}
