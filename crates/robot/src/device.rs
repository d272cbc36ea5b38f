//! A sense or an action, as the catalogue declares it: its words, parameters, values and parts of the body.

use crate::Shape::{Object, ObjectOrFirst};
use crate::params::{Param, ParamKind};
use behaviour::connectors::Carries;
use behaviour::{FillFrom, Params, StreamKind, Unit, Value};
use phrase::{Phrase, Phrased};

/// A sense or an action.
#[derive(Clone, Copy, Debug)]
pub struct Device {
    /// The name of the device in files and in the thesis: `RedBall`.
    pub name: &'static str,
    /// Sensor or actuator.
    pub kind: StreamKind,
    /// The name on the page; the thesis and its figures use it too.
    pub label: &'static str,
    /// Says what the device does, in a sentence.
    pub says: &'static str,
    /// The picture of the device: a name in the icon set.
    pub icon: &'static str,
    /// The parameters of the device.
    pub params: &'static [Param],
    /// The shape of the values it gives, or takes.
    pub shape: Shape,
    /// The parts of the body it uses.
    pub resources: Resources,
    /// Which of its values count when several wait: readings of a sense for a behaviour, commands of an action for the
    /// robot.
    pub waiting: Waiting,
    /// The way in which its values come, or the time for which one of them keeps it busy.
    pub pace: Pace,
    /// The parameter that says what stands on the button by which an operator gives its values; none if there is no button.
    pub button: Option<&'static str>,
    /// The way in which an action is offered as the next step of a stream.
    pub next_step: NextStep,
    /// An example value in JSON, for stimulating by hand.
    pub example: JsonExample,
    /// The values of a sense that can be pretended at one press; empty for an action.
    pub pretend: &'static [Pretend],
}

/// Which values count when several wait.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Waiting {
    /// Only the newest: how something is now, or shall be.
    Newest,
    /// Every one, up to a bound: what happened, or is said.
    Every,
}

/// The way in which values of a sense come, or the time for which an action is busy with one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// A sense that reads many times a second, always.
    Steady,
    /// A sense that reads many times a second for as long as there is something to sense.
    WhileThere,
    /// A sense that tells when something happens.
    Happening,
    /// A sense with the beat of this parameter, in milliseconds.
    Beat(&'static str),
    /// An action that is done at once, or goes on until told otherwise.
    Brief,
    /// An action that is busy for a second or longer with each value.
    Lasting,
}

/// The way in which an action is offered as the next step of a stream.
#[derive(Clone, Copy, Debug)]
pub struct NextStep {
    /// For streams that carry one of these, with what is chosen for its parameters then.
    pub for_streams: &'static [(Carries, &'static [(&'static str, &'static str)])],
    /// The words on the button, if not the action's name.
    pub label: Option<&'static str>,
    /// The name of the action's new stream, if not the action's own.
    pub stream: Option<&'static str>,
    /// True if its parameters are asked for at once.
    pub asks: bool,
}

impl NextStep {
    /// Only where all actions are.
    pub const NEVER: Self = Self { for_streams: &[], label: None, stream: None, asks: false };

    /// Returns the parameters that are chosen for a stream that carries this; none if the action is not offered there.
    #[must_use]
    pub fn params(&self, carries: Carries) -> Option<Params> {
        let (_, chosen) = self.for_streams.iter().find(|(one, _)| *one == carries)?;
        Some(chosen.iter().map(|&(name, value)| (name.to_owned(), Value::text(value))).filled())
    }
}

/// Devices are told apart by kind and name.
impl PartialEq for Device {
    fn eq(&self, other: &Self) -> bool {
        (self.kind, self.name) == (other.kind, other.name)
    }
}

/// Which parts of the body a device uses.
#[derive(Clone, Copy, Debug)]
pub enum Resources {
    /// Always these.
    Always(&'static [Resource]),
    /// Those that its parameters ask for; what is left open counts as used.
    By(fn(&Params) -> Vec<Resource>),
}

/// Something that can be pretended: what a sense would tell then.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pretend {
    /// Says what there would be, behind "as if": `ball near`.
    pub says: &'static str,
    /// The value.
    pub value: JsonExample,
}

/// A value written as JSON.
pub type JsonExample = &'static str;

/// A part of the body that one command at a time may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Resource {
    /// The head's two joints.
    Head,
    /// The left arm.
    LeftArm,
    /// The right arm.
    RightArm,
    /// Both legs, and so standing and walking.
    Legs,
    /// Speaking.
    Voice,
    /// The eye lights.
    Eyes,
    /// The memory of faces.
    Memory,
}

/// The shape of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// Any value; it only matters that one comes.
    Anything,
    /// A number with its unit, if it has one.
    Number(Option<Unit>),
    /// A text.
    Text,
    /// True or false.
    Truth,
    /// An object with these fields.
    Object(&'static [Field]),
    /// An object with these fields, or a number: the first of them.
    ObjectOrFirst(&'static [Field]),
    /// A list of such values.
    List(&'static Shape),
    /// The shape that a parameter says.
    By {
        /// The parameter.
        param: &'static str,
        /// The shapes by what is chosen for it.
        cases: &'static [(&'static str, Shape)],
        /// The shape if it is none of these.
        usual: &'static Shape,
    },
}

/// A field of an object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Field {
    /// The name of the field.
    pub name: &'static str,
    /// Says what the field is, with its unit.
    pub says: &'static str,
    /// The shape of the field.
    pub of: Shape,
}

impl Shape {
    /// The fields of an object, else none.
    #[must_use]
    pub fn fields(&self) -> &'static [Field] {
        if let Object(fields) | ObjectOrFirst(fields) = self.usual() { fields } else { &[] }
    }

    /// The shape where no parameter says another.
    #[must_use]
    pub fn usual(&self) -> &Shape {
        if let Self::By { usual, .. } = self { usual } else { self }
    }
}

impl Device {
    /// Returns the words on its button with these parameters, if it has one: as somebody wrote them, else its own.
    #[must_use]
    pub fn button_words(&self, params: &Params) -> Option<Phrase> {
        let param = self.params.iter().find(|param| Some(param.name) == self.button)?;
        let chosen = params.get(param.name).and_then(Value::as_text).filter(|text| !text.trim().is_empty());
        let usual = || match param.kind {
            ParamKind::Text { default, .. } => Some(self.usual_on_button(param, default).phrase()),
            ParamKind::Choice(_) | ParamKind::Number { .. } => None,
        };
        chosen.map(Phrase::from).or_else(usual)
    }
}
