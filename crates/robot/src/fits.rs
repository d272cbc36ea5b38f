//! Checks if a behaviour can run on a robot, and what is missing if not.

use crate::{DeviceFault, Lacking, device};
use behaviour::{Behaviour, Id, StreamKind};
use phrase::{Phrase, Phrased, phrase};

/// A stream that a robot cannot serve. [`std::fmt::Display`] says it in one English sentence.
#[derive(Clone, Debug, PartialEq)]
pub struct UnfitStream {
    /// The stream.
    pub stream: Id,
    /// The name of the stream.
    pub name: String,
    /// Why not.
    pub why: UnfitReason,
}

/// Why a robot cannot serve a stream.
#[derive(Clone, Debug, PartialEq)]
pub enum UnfitReason {
    /// No device is chosen.
    NotChosen,
    /// The robot does not have this device, for this reason if it gives one.
    NotThere(String, Option<Phrase>),
    /// The device does not fit.
    DoesNotFit(DeviceFault),
}

phrase::shown!(UnfitStream);

impl Phrased for UnfitStream {
    fn phrase(&self) -> Phrase {
        let name = &self.name;
        match &self.why {
            UnfitReason::NotChosen => phrase!("UnfitStream.NotChosen", "“{name}” has no device yet. Choose one."),
            UnfitReason::NotThere(device, None) => {
                phrase!("UnfitStream.NotThere", "“{name}” needs {device}, which this robot does not have.")
            }
            UnfitReason::NotThere(device, Some(why)) => {
                phrase!("UnfitStream.NotThere2", "“{name}” needs {device}, which this robot does not have: {why}.")
            }
            UnfitReason::DoesNotFit(reason) => phrase!("UnfitStream.DoesNotFit", "“{name}” does not fit: {reason}."),
        }
    }
}

/// Returns what a robot with these devices lacks to run a behaviour, in file order; nothing if it can run it. The reasons
/// why devices are not there come from `lacking`.
#[must_use]
pub fn missing<D: AsRef<str>>(behaviour: &Behaviour, devices: &[D], lacking: &[Lacking]) -> Vec<UnfitStream> {
    let why = |name: &str| lacking.iter().find(|one| one.device == name).map(|one| one.why.clone());
    let mut found = Vec::new();
    for (id, stream) in behaviour.streams_in_order() {
        let why = match (stream.kind, &stream.device) {
            (StreamKind::Ordinary, _) => None,
            (_, None) => Some(UnfitReason::NotChosen),
            (_, Some(name)) if !devices.iter().any(|device| device.as_ref() == name) => {
                Some(UnfitReason::NotThere(name.clone(), why(name)))
            }
            (kind, Some(name)) => {
                let checked = device(kind, name).and_then(|device| device.check(&stream.params));
                checked.err().map(UnfitReason::DoesNotFit)
            }
        };
        found.extend(why.map(|why| UnfitStream { stream: id.clone(), name: stream.name.clone(), why }));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::{Lacking, missing};
    use behaviour::{Behaviour, Id, Kind, Params, Record, RecordId, Stream, StreamKind, Value};

    fn behaviour(devices: &[(StreamKind, Option<&str>, Params)]) -> Behaviour {
        let mut behaviour = Behaviour::default();
        for (order, (kind, device, params)) in (0..).zip(devices) {
            let (kind, name, params) = (*kind, format!("S{order}"), params.clone());
            let device = device.map(str::to_owned);
            let stream = Stream { kind, name, device, params, order, resources: None, priority: None, hold_ms: None };
            let id = RecordId::new(Kind::Stream, &Id::new(&format!("s{order}")).unwrap());
            behaviour.records.insert(id, Record::Stream(stream));
        }
        behaviour
    }

    #[test]
    fn what_is_missing_is_said_stream_by_stream() {
        let odd = Params::from([("mode".to_owned(), Value::text("Fly"))]);
        let made = behaviour(&[
            (StreamKind::Sensor, Some("RedBall"), Params::new()),
            (StreamKind::Sensor, Some("Sonar"), Params::new()),
            (StreamKind::Ordinary, None, Params::new()),
            (StreamKind::Actuator, Some("Tracker"), odd),
            (StreamKind::Actuator, None, Params::new()),
        ]);
        let said: Vec<_> = missing(&made, &["RedBall", "Tracker"], &[]).iter().map(ToString::to_string).collect();
        assert_eq!(said[0], "“S1” needs Sonar, which this robot does not have.");
        assert!(said[1].starts_with("“S3” does not fit: What follows must be one of:"), "{}", said[1]);
        assert_eq!(said[2..], ["“S4” has no device yet. Choose one."]);
        let sonar = Lacking { device: "Sonar".into(), why: "it has no sonars".into() };
        let said = missing(&made, &["RedBall", "Tracker"], &[sonar])[0].to_string();
        assert_eq!(said, "“S1” needs Sonar, which this robot does not have: it has no sonars.");
    }

    #[test]
    fn a_robot_with_all_devices_lacks_nothing() {
        let made = behaviour(&[
            (StreamKind::Sensor, Some("RedBall"), Params::new()),
            (StreamKind::Actuator, Some("Tracker"), Params::new()),
        ]);
        assert!(missing(&made, &["RedBall", "Tracker"], &[]).is_empty());
    }
}
