//! The kind of value on every stream of a behaviour, told before it runs.

use super::{Declared, DeviceType, Fit, Signature, ValueType};
use crate::connectors::{Passes, Takes};
use crate::{Behaviour, Connector, FillFrom, Graph, Helper, Id, Knowledge, Lookup, Procedure, StreamKind};
use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;

/// The most bytes of procedures that are read for one behaviour; streams behind further ones carry [`ValueType::Any`].
const READ_MAX_BYTES: usize = 256 << 10;
/// The depth to which helpers that call helpers are followed.
const HELPERS_MAX_DEPTH: usize = 4;
/// The most answers about helpers that are kept.
const KNOWN_MAX: usize = 1_000;
/// The most arguments of a procedure of which something is told.
const ARGUMENTS_MAX: usize = 32;

/// The kind of value on every stream; of an action, what it takes.
#[must_use]
pub fn infer(behaviour: &Behaviour, helpers: &[&Helper], knowledge: &dyn Knowledge) -> BTreeMap<Id, ValueType> {
    infer_seeing(behaviour, helpers, knowledge, &SeenKinds::new())
}

/// Infers the kinds, where what nobody knows is of the kind that was seen last.
#[must_use]
pub fn infer_seeing(
    behaviour: &Behaviour,
    helpers: &[&Helper],
    knowledge: &dyn Knowledge,
    seen: &SeenKinds,
) -> BTreeMap<Id, ValueType> {
    let inference = Inference::seeing(behaviour, helpers, knowledge, seen);
    let mut types = inference.types;
    behaviour.streams().map(|(id, _)| (id.clone(), types.remove(id).unwrap_or_default())).filled()
}

/// The kinds of the newest values of a running program, by stream.
pub type SeenKinds = BTreeMap<Id, ValueType>;

/// The knowledge about a behaviour: the kinds on its streams, its devices, and the results of its helpers.
pub struct Inference<'a> {
    helpers: HelperResults<'a>,
    devices: Lookup<&'a Id, DeviceType>,
    types: Lookup<&'a Id, ValueType>,
    /// The number of bytes that may still be read to look for names.
    unnamed: Cell<usize>,
}

/// The results of helpers, by the kinds of their arguments.
struct HelperResults<'a> {
    library: Lookup<&'a str, &'a Helper>,
    names: Vec<&'a str>,
    knowledge: &'a dyn Knowledge,
    /// The results that were found out, by a call as text.
    known: RefCell<BTreeMap<String, ValueType>>,
    /// The number of bytes that may still be read.
    left: Cell<usize>,
    depth: Cell<usize>,
}

impl<'a> Inference<'a> {
    /// Finds out what every stream carries. `helpers` is the library.
    #[must_use]
    pub fn of(behaviour: &'a Behaviour, helpers: &[&'a Helper], knowledge: &'a dyn Knowledge) -> Self {
        Self::seeing(behaviour, helpers, knowledge, &SeenKinds::new())
    }

    /// Infers the kinds, where what nobody knows is of the kind that was seen last.
    #[must_use]
    pub fn seeing(
        behaviour: &'a Behaviour,
        helpers: &[&'a Helper],
        knowledge: &'a dyn Knowledge,
        seen: &SeenKinds,
    ) -> Self {
        let or_seen = |id: &Id, of: ValueType| match of {
            ValueType::Any => seen.get(id).cloned().unwrap_or_default(),
            known => known,
        };
        let library: Lookup<_, _> = helpers.iter().map(|helper| (helper.name.as_str(), *helper)).filled();
        let names = helpers.iter().map(|helper| helper.name.as_str()).distinct();
        let (left, depth) = (Cell::new(READ_MAX_BYTES), Cell::new(0));
        let helpers = HelperResults { library, names, knowledge, known: RefCell::default(), left, depth };
        let (devices, types, unnamed) = (Lookup::new(), Lookup::new(), Cell::new(READ_MAX_BYTES));
        let mut made = Self { helpers, devices, types, unnamed };
        for (id, stream) in behaviour.streams() {
            if let Some(device) = &stream.device {
                let known = knowledge.device_type(stream.kind, device, &stream.params);
                let is_sense = stream.kind == StreamKind::Sensor;
                let of = if is_sense { or_seen(id, known.value.clone()) } else { known.value.clone() };
                made.types.insert(id, of.bounded());
                made.devices.insert(id, known);
            }
        }
        let graph = Graph::of(behaviour);
        let mut ordinary: Vec<(usize, &Id)> = graph.ranks(behaviour).into_iter().map(|(id, rank)| (rank, id)).collect();
        ordinary.retain(|(_, id)| behaviour.stream(id).is_some_and(|stream| stream.kind == StreamKind::Ordinary));
        ordinary.sort_unstable();
        for (_, id) in ordinary {
            if let [(_, connector)] = graph.into_stream(id) {
                let of = made.made_by(behaviour, connector);
                made.types.insert(id, or_seen(id, of).bounded());
            }
        }
        for (id, _) in behaviour.streams() {
            made.types.entry(id).or_default();
        }
        made
    }

    /// Returns the kind that a stream carries; of an action, the kind that it takes.
    #[must_use]
    pub fn of_stream(&self, id: &Id) -> &ValueType {
        self.types.get(id).unwrap_or(&ValueType::Any)
    }

    /// Returns what is known of the device of a stream.
    #[must_use]
    pub fn device(&self, id: &Id) -> Option<&DeviceType> {
        self.devices.get(id)
    }

    /// The arguments of a connector's procedure with their kinds; of more than 32 no kind is told.
    #[must_use]
    pub fn arguments(&self, behaviour: &Behaviour, connector: &Connector) -> Vec<(String, ValueType)> {
        let names = behaviour.arguments(connector);
        let before = names.len().saturating_sub(connector.inputs.len());
        let told = connector.inputs.len() <= ARGUMENTS_MAX;
        let kind = |id: &Id| if told { self.of_stream(id).clone() } else { ValueType::Any };
        let inputs = connector.inputs.iter().map(kind);
        let kinds = std::iter::repeat_n(ValueType::Any, before).chain(inputs);
        names.into_iter().zip(kinds).collect()
    }

    /// The names of all helpers, in order.
    pub(crate) fn helper_names(&self) -> &[&'a str] {
        &self.helpers.names
    }

    /// Returns the signature of a helper, as far as somebody declared it.
    #[must_use]
    pub fn signature(&self, helper: &str) -> Option<Signature> {
        self.helpers.signature(helper)
    }

    /// Returns the kind that a helper makes of arguments of these kinds; [`ValueType::Any`] if there is none.
    #[must_use]
    pub fn helper_gives(&self, helper: &str, arguments: &[ValueType]) -> ValueType {
        self.helpers.call(helper, arguments).unwrap_or_default()
    }

    /// A name in a body that means nothing with these arguments, with those that would in its place.
    #[must_use]
    pub fn unknown_name(&self, arguments: &[(String, ValueType)], body: &str) -> Option<(String, Vec<String>)> {
        if arguments.len() > ARGUMENTS_MAX {
            return None;
        }
        self.unnamed.set(self.unnamed.get().checked_sub(body.len())?);
        self.helpers.knowledge.unknown_name(arguments, body, &self.helpers.names)
    }

    /// An object in a body that stands where only a number makes sense: its name, and how often.
    #[must_use]
    pub fn misused(&self, arguments: &[(String, ValueType)], body: &str) -> Option<(String, usize)> {
        if arguments.len() > ARGUMENTS_MAX || !arguments.iter().any(|(_, of)| matches!(of, ValueType::Record(_))) {
            return None;
        }
        self.unnamed.set(self.unnamed.get().checked_sub(body.len())?);
        self.helpers.knowledge.misused(arguments, body, &|name, kinds| self.helpers.call(name, kinds))
    }

    fn made_by(&self, behaviour: &Behaviour, connector: &Connector) -> ValueType {
        let spec = connector.operation.spec();
        let mut inputs = connector.inputs.iter().map(|id| self.of_stream(id));
        match spec.passes {
            Passes::Same => inputs.cloned().reduce(|one, other| one.or(&other)).unwrap_or_default(),
            // Only the time is put beside a value without a procedure.
            Passes::Other if spec.takes == Takes::NOTHING => {
                inputs.next().cloned().unwrap_or_default().bounded().with_time()
            }
            Passes::Other => ValueType::Any,
            Passes::Result => self.result(behaviour, connector),
        }
    }

    /// Returns the kind that the procedure of a connector gives.
    pub(crate) fn result(&self, behaviour: &Behaviour, connector: &Connector) -> ValueType {
        let Some(procedure) = connector.operation.procedure() else { return ValueType::Any };
        if connector.inputs.len() > ARGUMENTS_MAX {
            return ValueType::Any;
        }
        let mut arguments = self.arguments(behaviour, connector);
        let make = |arguments: &[(String, ValueType)]| match procedure {
            Procedure::Body { body, .. } => self.helpers.read(arguments, body),
            Procedure::Helper(name) => {
                let kinds: Vec<_> = arguments.iter().map(|(_, of)| of.clone()).collect();
                self.helper_gives(name, &kinds)
            }
        };
        let (Some(start), true) = (connector.operation.start(), arguments.len() > connector.inputs.len()) else {
            return make(&arguments);
        };
        // What was made last is what it begins with or what it makes of that; if that does not settle, nobody knows.
        arguments[0].1 = ValueType::of(start);
        let first = make(&arguments);
        arguments[0].1 = arguments[0].1.or(&first);
        let made = make(&arguments);
        if arguments[0].1.or(&made) == arguments[0].1 { made } else { ValueType::Any }
    }
}

/// Returns the kind of an argument: as it comes, unless the helper says more of it.
fn told(declared: Declared, comes: &ValueType) -> ValueType {
    match declared.value_type() {
        None | Some(ValueType::Any) => comes.clone(),
        Some(wants) if wants == ValueType::NUMBER && matches!(comes, ValueType::Number { .. }) => comes.clone(),
        Some(wants @ (ValueType::Record(_) | ValueType::List(_))) => {
            let is_told = *comes != ValueType::Any && wants.takes(comes) == Fit::Good;
            if is_told { comes.clone() } else { wants }
        }
        Some(wants) => wants,
    }
}

impl HelperResults<'_> {
    fn signature(&self, name: &str) -> Option<Signature> {
        let helper = self.library.get(name)?;
        let known = self.knowledge.signature(helper);
        if known.is_none() && helper.gives.is_auto() && helper.takes.iter().all(Declared::is_auto) {
            return None;
        }
        let of_before = |at: usize| known.as_ref()?.takes.get(at).cloned();
        let taken = |at: usize| helper.taken(at).value_type().or_else(|| of_before(at)).unwrap_or_default().bounded();
        let takes: Vec<ValueType> = (0..helper.params.len()).map(taken).collect();
        let gives = helper.gives.value_type().or_else(|| Some(known.as_ref()?.gives.clone()));
        let gives = gives.or_else(|| self.call(name, &takes)).unwrap_or_default();
        Some(Signature { takes, gives: gives.bounded() })
    }

    /// Returns the kind that a helper makes, if one of that name has so many parameters.
    fn call(&self, name: &str, arguments: &[ValueType]) -> Option<ValueType> {
        let helper = self.library.get(name).filter(|helper| helper.params.len() == arguments.len())?;
        let known = || self.knowledge.signature(helper).map(|signature| signature.gives);
        if let Some(gives) = helper.gives.value_type().or_else(known) {
            return Some(gives.bounded());
        }
        let arguments: Vec<_> = arguments.iter().enumerate().map(|(at, of)| told(helper.taken(at), of)).collect();
        let question = format!("{name} {arguments:?}");
        if let Some(known) = self.known.borrow().get(&question) {
            return Some(known.clone());
        }
        if self.depth.get() >= HELPERS_MAX_DEPTH {
            return Some(ValueType::Any);
        }
        let arguments: Vec<_> = helper.params.iter().cloned().zip(arguments.iter().cloned()).collect();
        self.depth.set(self.depth.get() + 1);
        let made = self.read(&arguments, &helper.body);
        self.depth.set(self.depth.get() - 1);
        let mut known = self.known.borrow_mut();
        if known.len() < KNOWN_MAX {
            known.insert(question, made.clone());
        }
        Some(made)
    }

    fn read(&self, arguments: &[(String, ValueType)], body: &str) -> ValueType {
        let Some(left) = self.left.get().checked_sub(body.len()) else { return ValueType::Any };
        self.left.set(left);
        self.knowledge.result(arguments, body, &|name, kinds| self.call(name, kinds)).bounded()
    }
}
