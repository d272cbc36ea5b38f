//! Faces: seeing them, and remembering one.

use super::{NaoDriver, OpenActuator, OpenDevice, Sense, at, float, time, within};
use crate::deed::{Action, ServiceCall};
use behaviour::Value;
use robot::RobotFault;
use std::collections::BTreeMap;
use std::time::Duration;

pub(super) const DETECTION: NaoDriver = NaoDriver {
    name: "FaceDetection",
    services: &["ALMemory", "ALFaceDetection"],
    joints: &[],
    open: |_| OpenDevice::sense(Detection::default()),
};
pub(super) const REMEMBER: NaoDriver = NaoDriver {
    name: "RememberFace",
    services: &["ALFaceDetection"],
    joints: &[],
    open: |_| OpenDevice::act(Remember),
};

/// Names that are kept of faces in view: a name is told again only after a pause.
const LABELS_MAX: usize = 32;
/// The number `recognised` when one face has a name, `[2, [name]]`.
const RECOGNISED: f64 = 2.0;
/// The number `recognised` when a face was looked at for long and is not known.
const UNKNOWN: f64 = 4.0;
/// The longest that learning a face may take.
const LEARN: Duration = Duration::from_secs(20);

#[derive(Default)]
struct Detection {
    labels: BTreeMap<i64, String>,
    unknown: bool,
}

impl Sense for Detection {
    fn keys(&self) -> Vec<&'static str> {
        vec!["FaceDetected"]
    }

    fn extractor(&self) -> Option<&'static str> {
        Some("ALFaceDetection")
    }

    /// `[[s, us], [face, ..., recognised], ...]` with a face `[[0, x, y, width, height], [id, sureness, label, ...]]`; empty
    /// when there is none. The nearest face counts: the largest.
    fn read(&mut self, _: &str, value: &qi::Value, at_ms: u64) -> Option<Value> {
        let Some(faces) = within(value, &[1]).and_then(qi::Value::items).filter(|faces| faces.len() > 1) else {
            (self.labels, self.unknown) = Default::default();
            return None;
        };
        let (recognised, faces) = faces.split_last()?;
        self.unknown |= at(recognised, &[0]) == Some(UNKNOWN);
        let height = |face: &&qi::Value| at(face, &[0, 4]).unwrap_or_default();
        let face = faces.iter().max_by(|one, other| height(one).total_cmp(&height(other)))?;
        let id = at(face, &[1, 0]).map_or(0, |id| id as i64);
        let label_of = |face: &qi::Value| {
            let label = within(face, &[1, 2])?.as_text()?.into_owned();
            Some(label).filter(|label| !label.is_empty())
        };
        // A single name is told beside the faces too, and on some robots only there.
        let beside = || {
            let label = within(recognised, &[1, 0]).and_then(|label| label.as_text())?.into_owned();
            let is_single =
                at(recognised, &[0]) == Some(RECOGNISED) && faces.iter().all(|face| label_of(face).is_none());
            Some(label).filter(|label| is_single && !label.is_empty())
        };
        let told = label_of(face).or_else(beside);
        if let Some(label) = told
            && (self.labels.len() < LABELS_MAX || self.labels.contains_key(&id))
        {
            self.labels.insert(id, label);
            self.unknown = false;
        }
        let label = self.labels.get(&id).cloned().unwrap_or_default();
        let new = label.is_empty();
        Some(Value::object([
            ("id", Value::Int(id)),
            ("label", Value::text(label)),
            ("new", Value::Bool(new)),
            ("recognized_new_face", Value::Bool(new && self.unknown)),
            ("x", float(at(face, &[0, 1])?)),
            ("y", float(at(face, &[0, 2])?)),
            ("size", float(at(face, &[0, 4])? / 2.0)),
            ("time", time(at_ms)),
        ]))
    }
}

/// The number of a face in view: two are not learned under one name.
fn number_of(face: &Value) -> Option<i64> {
    match face.field("id") {
        Some(Value::Int(id)) if *id > 0 => Some(*id),
        _ => None,
    }
}

/// Under the text of the value, else under the number of the face that it is, else under 1.
struct Remember;

impl OpenActuator for Remember {
    fn deed(&self, value: &Value) -> Result<Action, RobotFault> {
        let name = match value.as_text().map(str::trim).filter(|text| !text.is_empty()) {
            Some(text) => text.chars().take(60).collect(),
            None => format!("face {}", number_of(value).unwrap_or(1)),
        };
        Ok(Action::Lasting {
            what: "RememberFace".to_owned(),
            calls: vec![ServiceCall::new("ALFaceDetection", "learnFace", [name.into()])],
            end: Vec::new(),
            within: LEARN,
            moves: false,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{Detection, Sense};
    use behaviour::Value;
    use qi::Value as Told;

    #[test]
    fn a_name_beside_the_faces_is_that_of_the_one_that_is_nearest() {
        let list = |items: Vec<Told>| Told::List(items);
        let numbers = |numbers: &[f64]| list(numbers.iter().map(|number| Told::F64(*number)).collect());
        let face = |height: f64, id: f64, label: &str| {
            list(vec![numbers(&[0.0, 0.1, 0.1, 0.2, height]), list(vec![Told::F64(id), Told::F64(0.5), label.into()])])
        };
        let named = |name: &str| list(vec![Told::F64(2.0), list(vec![name.into()])]);
        let see = |faces: Vec<Told>| {
            let mut detection = Detection::default();
            let value = list(vec![numbers(&[0.0, 0.0]), list(faces)]);
            detection.read("FaceDetected", &value, 1).and_then(|face| face.field("label").cloned())
        };
        assert_eq!(see(vec![face(0.3, 1.0, ""), face(0.2, 2.0, ""), named("Aiko")]), Some(Value::text("Aiko")));
        assert_eq!(see(vec![face(0.3, 1.0, ""), face(0.2, 2.0, "Aiko"), named("Aiko")]), Some(Value::text("")));
        assert_eq!(see(vec![face(0.3, 1.0, "Ken"), list(Vec::new())]), Some(Value::text("Ken")));
    }
}
