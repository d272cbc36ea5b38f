//! Rhai's functions of texts, lists and objects, each behind one that counts what the call costs.
//!
//! They are found in Rhai's own library, so none is forgotten, and one that a later version adds is counted too.

use crate::cost::Limits;
use crate::cost::callers::is_caller;
use crate::cost::meter::{self, copying, list_length, owe, text_bytes};
use rhai::{
    Array, Dynamic, Engine, FnPtr, FuncInfo, FuncRegistration, ImmutableString, Map, Module, NativeCallContext,
    Position, RhaiFunc, Shared,
};
use std::any::TypeId;
use std::rc::Rc;

/// The cost of looking the function up once more.
const CALL_NANOS: usize = 200;
/// Looking at a byte of a text.
const BYTE_NANOS: usize = 12;
/// Making an item of a list, a text perhaps.
const MADE_ITEM_NANOS: usize = 40;
/// Comparing an item of a list with another, by the rules of the language.
const COMPARED_NANOS: usize = 250;
/// Comparing two numbers or texts for their order.
const SORTED_NANOS: usize = 15;

/// Functions of lists and objects that touch an item or two: that the variable is looked at pays for them.
const LIGHT: [&str; 11] =
    ["len", "is_empty", "push", "pop", "set", "clear", "truncate", "chop", "shift", "insert", "remove"];
/// Functions of texts that touch a letter or two.
const LIGHT_OF_TEXTS: [&str; 4] = ["len", "is_empty", "bytes", "clear"];
/// Functions that compare each item with one other.
const COMPARING: [&str; 5] = ["contains", "index_of", "dedup", "==", "!="];
/// Functions that compare items until they are in order.
const SORTING: [&str; 4] = ["sort", "sort_desc", "order", "order_desc"];

/// A function of the library.
pub(crate) type LibraryFunction = (String, Vec<TypeId>);

/// Registers a counting function in front of each that works on texts, lists and objects.
pub(crate) fn register(module: &mut Module, library: &[Shared<Module>]) {
    let engine = Rc::new(bare_engine(library));
    for (name, types) in engine.collect_fn_metadata(None, known, true) {
        if is_counted(&name, &types) {
            let function = counting(engine.clone(), name.clone());
            FuncRegistration::new(name).set_into_module_raw(module, types, function);
        }
    }
}

/// An engine with nothing but the library.
fn bare_engine(library: &[Shared<Module>]) -> Engine {
    let limits = Limits::default();
    let mut engine = Engine::new_raw();
    for module in library {
        engine.register_global_module(module.clone());
    }
    engine.set_max_string_size(limits.text_bytes).set_max_array_size(limits.list_items);
    engine.set_max_map_size(limits.map_fields);
    engine
}

pub(crate) fn known(function: FuncInfo) -> Option<LibraryFunction> {
    Some((function.metadata.name.to_string(), function.metadata.param_types.to_vec()))
}

/// True for what works on texts, lists or objects and takes longer with larger ones. What is handed a closure, or its
/// name, is paid by the steps of the closure, an operator of texts by the variables around it.
pub(crate) fn is_counted(name: &str, types: &[TypeId]) -> bool {
    let [text, list, object] = [TypeId::of::<ImmutableString>(), TypeId::of::<Array>(), TypeId::of::<Map>()];
    let takes = |wanted: TypeId| types.contains(&wanted);
    let named_closure = is_caller(name) && types.first() == Some(&list) && takes(text);
    if named_closure || takes(TypeId::of::<FnPtr>()) {
        return false;
    }
    if !takes(list) && !takes(object) {
        let is_operator = name.starts_with(|c: char| !c.is_alphabetic() && c != '_');
        return takes(text) && !is_operator && !LIGHT_OF_TEXTS.contains(&name);
    }
    types.first() == Some(&text) || !LIGHT.contains(&name)
}

fn counting(engine: Rc<Engine>, name: String) -> RhaiFunc {
    let function = move |context: Option<NativeCallContext>, arguments: &mut [&mut Dynamic]| {
        let before: usize = arguments.iter().map(|argument| looking_through(&name, argument)).sum();
        let compared = arguments.first().map_or(0, |first| comparing(&name, first));
        owe(CALL_NANOS + before + compared);
        let Some(context) = context else { return Ok(Dynamic::UNIT) };
        let global = context.global_runtime_state();
        let inner = NativeCallContext::from((&*engine, &*name, None, global, Position::NONE));
        let made = inner.call_native_fn_raw(&name, true, arguments)?;
        let grown = arguments.first().map_or(0, |first| looking_through(&name, first));
        let items = list_length(&made) * MADE_ITEM_NANOS;
        owe(looking_through(&name, &made) + items + grown.saturating_sub(before));
        Ok(made)
    };
    RhaiFunc::Method { func: Shared::new(function), has_context: true, is_pure: true, is_volatile: false }
}

/// Returns the cost of going through a value, and making it.
fn looking_through(name: &str, value: &Dynamic) -> usize {
    if meter::is_small(value) {
        return 0;
    }
    // A text is written with its letters one by one.
    let times = if name.ends_with("debug") { 3 } else { 1 };
    text_bytes(value) * BYTE_NANOS * times + copying(value)
}

/// Returns the cost of comparing the items of a list.
fn comparing(name: &str, value: &Dynamic) -> usize {
    let items = list_length(value);
    if COMPARING.contains(&name) {
        items * COMPARED_NANOS
    } else if SORTING.contains(&name) {
        items * (items.checked_ilog2().unwrap_or(0) as usize + 1) * SORTED_NANOS
    } else {
        0
    }
}
