//! A bench: a simulated robot with a clock, so that tests read like sentences.

use behaviour::{Id, Params, Value};
use robot::{Millis, Reading, Robot, RobotFault, SceneEdit, Touchable, Use};
use simulation::SimulatedNao;

/// A robot and the readings so far.
pub(crate) struct Bench {
    pub(crate) nao: SimulatedNao,
    pub(crate) now: u64,
    pub(crate) readings: Vec<Reading>,
}

pub(crate) fn user(name: &str) -> Use {
    Use { run: 1, stream: Id::new(name).expect("a short name") }
}

impl Bench {
    pub(crate) fn new() -> Self {
        Self { nao: SimulatedNao::new(7), now: 0, readings: Vec::new() }
    }

    /// Opens a device under the name of its stream; parameters are texts.
    pub(crate) fn open(&mut self, stream: &str, device: &str, params: &[(&str, &str)]) {
        let params: Vec<(&str, Value)> = params.iter().map(|(name, value)| (*name, Value::text(value))).collect();
        self.open_with(stream, device, &params);
    }

    /// Opens a device with parameters of any kind.
    pub(crate) fn open_with(&mut self, stream: &str, device: &str, params: &[(&str, Value)]) {
        let params: Params = params.iter().map(|(name, value)| ((*name).to_owned(), value.clone())).collect();
        self.nao.open(&user(stream), device, &params).expect("it has this device");
    }

    pub(crate) fn tell(&mut self, stream: &str, value: impl Into<Value>) {
        self.try_tell(stream, value).expect("it takes this value");
    }

    pub(crate) fn try_tell(&mut self, stream: &str, value: impl Into<Value>) -> Result<(), RobotFault> {
        self.nao.command(&user(stream), &value.into(), Millis(self.now))
    }

    /// Tells a value that is refused in these words.
    pub(crate) fn tell_refused(&mut self, stream: &str, value: impl Into<Value>, words: &str) {
        assert_eq!(self.try_tell(stream, value).expect_err("it is refused").to_string(), words);
    }

    /// Lets robot time pass.
    pub(crate) fn wait(&mut self, ms: u64) {
        self.now += ms;
        self.nao.poll(Millis(self.now), &mut self.readings);
    }

    /// Lets time pass while a stream is told a value ten times a second.
    pub(crate) fn keep(&mut self, stream: &str, value: impl Into<Value>, ms: u64) {
        let value = value.into();
        for _ in 0..ms / 100 {
            self.tell(stream, value.clone());
            self.wait(100);
        }
    }

    pub(crate) fn ball(&mut self, id: &str, at: [f32; 3]) {
        self.nao.edit(&SceneEdit::MoveBall { id: id.to_owned(), at }).expect("there is this ball");
    }

    pub(crate) fn person(&mut self, at: [f32; 2], present: bool) {
        let id = "person".to_owned();
        self.nao.edit(&SceneEdit::MovePerson { id: id.clone(), at }).expect("there is a person");
        self.nao.edit(&SceneEdit::SetPresent { id, present }).expect("there is a person");
    }

    /// Something a person does in the room.
    pub(crate) fn edit(&mut self, edit: &SceneEdit) {
        self.nao.edit(edit).expect("that can be done");
    }

    /// Brings somebody or something in, or sends it out.
    pub(crate) fn present(&mut self, id: &str, present: bool) {
        self.edit(&SceneEdit::SetPresent { id: id.to_owned(), present });
    }

    pub(crate) fn obstacle(&mut self, id: &str, at: [f32; 2]) {
        self.edit(&SceneEdit::MoveObstacle { id: id.to_owned(), at });
        self.present(id, true);
    }

    pub(crate) fn touch(&mut self, part: Touchable, down: bool) {
        self.edit(&SceneEdit::Touch { part, down });
    }

    pub(crate) fn speak(&mut self, words: &str) {
        self.edit(&SceneEdit::Speak { words: words.to_owned() });
    }

    pub(crate) fn joint(&self, name: &str) -> f32 {
        self.nao.joint(name).expect("there is this joint")
    }

    /// Returns what a stream read since last asked.
    pub(crate) fn values(&mut self, stream: &str) -> Vec<Value> {
        self.read(stream).into_iter().map(|reading| reading.value).collect()
    }

    /// Readings of a stream since last asked.
    pub(crate) fn read(&mut self, stream: &str) -> Vec<Reading> {
        let (taken, kept) = self.readings.drain(..).partition(|reading| reading.to == user(stream));
        self.readings = kept;
        taken
    }

    /// Returns how far a place is to the side of where the robot stands and faces, in radians.
    pub(crate) fn bearing(&self, at: [f32; 3]) -> f32 {
        let base = self.nao.scene().body.base;
        libm::atan2f(at[1] - base[1], at[0] - base[0]) - base[2]
    }
}

pub(crate) fn number(value: &Value, field: &str) -> f32 {
    value.field(field).and_then(Value::as_number).expect("a number") as f32
}
