//! Functions of lists and objects that Rhai computes by calling itself: with a bound on nesting, and quicker.

use crate::cost::limits::{TEXT_BYTES, VALUE_DEPTH};
use rhai::{Array, Dynamic, EvalAltResult, FuncRegistration, Map, Module, NativeCallContext, Position};
use std::fmt::Write;

type ListResult = Result<bool, Box<EvalAltResult>>;

/// Puts them over Rhai's own.
pub(crate) fn register(module: &mut Module) {
    let pure = |name: &str| FuncRegistration::new(name).with_purity(true);
    pure("==")
        .set_into_module(module, |ctx: NativeCallContext, a: &mut Array, b: Array| lists(&ctx, a, b, VALUE_DEPTH));
    pure("!=").set_into_module(module, |ctx: NativeCallContext, a: &mut Array, b: Array| {
        lists(&ctx, a, b, VALUE_DEPTH).map(|equal| !equal)
    });
    pure("==").set_into_module(module, |ctx: NativeCallContext, a: &mut Map, b: Map| objects(&ctx, a, b, VALUE_DEPTH));
    pure("!=").set_into_module(module, |ctx: NativeCallContext, a: &mut Map, b: Map| {
        objects(&ctx, a, b, VALUE_DEPTH).map(|equal| !equal)
    });
    FuncRegistration::new("pad").set_into_module(module, pad);
    for name in ["print", "debug", "to_string", "to_debug"] {
        pure(name).set_into_module(module, |ctx: NativeCallContext, list: &mut Array| text(&ctx, |to| to.list(list)));
        pure(name).set_into_module(module, |ctx: NativeCallContext, map: &mut Map| text(&ctx, |to| to.object(map)));
    }
}

/// Counts before it copies, and without overflow: Rhai's own sum could wrap around to a small one.
fn pad(ctx: NativeCallContext, list: &mut Array, length: i64, item: Dynamic) -> Result<(), Box<EvalAltResult>> {
    let length = usize::try_from(length).unwrap_or(0);
    let copies = length.saturating_sub(list.len());
    let engine = ctx.engine();
    let (items, fields, bytes) = sizes(&item);
    let fits = |many: usize, bound: usize| many.saturating_mul(copies) <= bound;
    let all_fit = fits(items + 1, engine.max_array_size())
        && fits(fields, engine.max_map_size())
        && fits(bytes, engine.max_string_size());
    if !all_fit {
        return Err(EvalAltResult::ErrorDataTooLarge("Size of array".to_owned(), Position::NONE).into());
    }
    list.extend(std::iter::repeat_n(item, copies));
    Ok(())
}

/// Items, fields and bytes of texts in a value.
fn sizes(value: &Dynamic) -> (usize, usize, usize) {
    let sum = |(a, b, c), value: &Dynamic| {
        let (items, fields, bytes) = sizes(value);
        (a + items, b + fields, c + bytes)
    };
    if let Ok(items) = value.as_array_ref() {
        return items.iter().fold((items.len(), 0, 0), sum);
    }
    if let Ok(fields) = value.as_map_ref() {
        return fields.values().fold((0, fields.len(), 0), sum);
    }
    (0, 0, value.as_immutable_string_ref().map_or(0, |text| text.len()))
}

fn lists(ctx: &NativeCallContext, a: &mut Array, mut b: Array, depth: usize) -> ListResult {
    if a.len() != b.len() {
        return Ok(false);
    }
    all(a.iter_mut().zip(&mut b), |(a, b)| equal(ctx, a, b, depth))
}

fn objects(ctx: &NativeCallContext, a: &mut Map, mut b: Map, depth: usize) -> ListResult {
    if a.len() != b.len() {
        return Ok(false);
    }
    all(a, |(name, a)| b.get_mut(name).map_or(Ok(false), |b| equal(ctx, a, b, depth)))
}

fn all<T>(pairs: impl IntoIterator<Item = T>, mut equal: impl FnMut(T) -> ListResult) -> ListResult {
    for pair in pairs {
        if !equal(pair)? {
            return Ok(false);
        }
    }
    Ok(true)
}

fn equal(ctx: &NativeCallContext, a: &mut Dynamic, b: &mut Dynamic, depth: usize) -> ListResult {
    if let (Ok(a), Ok(b)) = (a.as_int(), b.as_int()) {
        return Ok(a == b);
    }
    if a.is_array() && b.is_array() {
        let (Some(mut a), b) = (a.write_lock::<Array>(), b.take()) else { return Ok(false) };
        return lists(ctx, &mut a, b.cast(), deeper(depth)?);
    }
    if a.is_map() && b.is_map() {
        let (Some(mut a), b) = (a.write_lock::<Map>(), b.take()) else { return Ok(false) };
        return objects(ctx, &mut a, b.cast(), deeper(depth)?);
    }
    by_rhai(ctx, a, b)
}

/// Compares two values that hold no others as the language does. Different kinds differ.
fn by_rhai(ctx: &NativeCallContext, a: &mut Dynamic, b: &mut Dynamic) -> ListResult {
    let kinds_differ = a.type_id() != b.type_id();
    match ctx.call_native_fn_raw("==", true, &mut [a, b]) {
        Ok(answer) => Ok(answer.as_bool().unwrap_or(false)),
        Err(error) if kinds_differ && matches!(*error, EvalAltResult::ErrorFunctionNotFound(..)) => Ok(false),
        Err(error) => Err(error),
    }
}

fn deeper(depth: usize) -> Result<usize, Box<EvalAltResult>> {
    let words = "a list or object is nested too deep; put fewer into each other";
    let too_deep = || EvalAltResult::ErrorRuntime(words.into(), Position::NONE).into();
    depth.checked_sub(1).filter(|left| *left > 0).ok_or_else(too_deep)
}

fn text(ctx: &NativeCallContext, write: impl FnOnce(&mut TextWriter)) -> String {
    let mut to = TextWriter { ctx, made: String::new(), depth: VALUE_DEPTH };
    write(&mut to);
    to.made
}

/// Writes as Rhai does. What is nested too deep becomes `…`, and it ends once the text is too large to be kept.
struct TextWriter<'c, 'e> {
    ctx: &'c NativeCallContext<'e>,
    made: String,
    depth: usize,
}

impl TextWriter<'_, '_> {
    fn list(&mut self, list: &mut Array) {
        self.made.push('[');
        for (at, item) in list.iter_mut().enumerate() {
            self.comma(at);
            if self.made.len() > TEXT_BYTES {
                return;
            }
            self.value(item);
        }
        self.made.push(']');
    }

    fn object(&mut self, object: &mut Map) {
        self.made.push_str("#{");
        for (at, (name, value)) in object.iter_mut().enumerate() {
            self.comma(at);
            if self.made.len() > TEXT_BYTES {
                return;
            }
            let _ = write!(self.made, "{name:?}: ");
            self.value(value);
        }
        self.made.push('}');
    }

    fn comma(&mut self, at: usize) {
        if at > 0 {
            self.made.push_str(", ");
        }
    }

    fn value(&mut self, value: &mut Dynamic) {
        if !value.is_array() && !value.is_map() {
            return self.leaf(value);
        }
        if self.depth <= 1 {
            return self.made.push('…');
        }
        self.depth -= 1;
        if let Some(mut list) = value.write_lock::<Array>() {
            self.list(&mut list);
        } else if let Some(mut object) = value.write_lock::<Map>() {
            self.object(&mut object);
        }
        self.depth += 1;
    }

    fn leaf(&mut self, value: &mut Dynamic) {
        if let Ok(whole) = value.as_int() {
            let _ = write!(self.made, "{whole}");
            return;
        }
        let made = self.ctx.call_native_fn_raw("to_debug", true, &mut [value]);
        self.made.push_str(&made.ok().and_then(|made| made.into_string().ok()).unwrap_or_default());
    }
}

#[cfg(test)]
mod tests {
    use crate::{Limits, TrialFault, try_body};
    use behaviour::Value;

    fn run(body: &str) -> Result<Value, TrialFault> {
        try_body(&[], &[], body, &[], &Limits::default())
    }

    #[test]
    fn lists_and_objects_are_equal_as_their_parts_are() {
        for (body, equal) in [
            ("[1, [2, #{a: 'x'}], \"t\"] == [1, [2, #{a: 'x'}], \"t\"]", true),
            ("[1] == [1.0]", true),
            ("[0.1 + 0.2] == [0.3]", true),
            ("[1] != [2]", true),
            ("[1] == [[1]]", false),
            ("[1, 2] == [1]", false),
            ("#{a: 1} == #{b: 1}", false),
            ("#{a: [1]} != #{a: [1]}", false),
            ("#{a: ()} == #{a: ()}", true),
            ("[1, \"1\"] == [\"1\", 1]", false),
            ("const L = [1]; L == [1]", true),
        ] {
            assert_eq!(run(body), Ok(Value::Bool(equal)), "{body}");
        }
    }

    #[test]
    fn texts_of_lists_and_objects_are_those_of_the_language() {
        let nested = r#"[1, 2.0, "a\"b", 'c', true, (), [], #{}, #{a: [1], "b c": 1.5}]"#;
        let text = Value::text(r##"[1, 2.0, "a\"b", c, true, (), [], #{}, #{"a": [1], "b c": 1.5}]"##);
        for way in ["l.to_string()", "l.to_debug()", "\"\" + l", "`${l}`"] {
            assert_eq!(run(&format!("let l = {nested}; {way}")), Ok(text.clone()), "{way}");
        }
    }

    #[test]
    fn deep_nesting_ends_neither_the_stack_nor_the_time() {
        let deep = "let l = []; for i in 0..60 { l = [l]; } ";
        assert!(run(&format!("{deep} l == l")).is_err_and(|fault| fault.to_string().contains("nested too deep")));
        let text = run(&format!("{deep} l.to_string()")).map(|text| text.to_string().contains("[…]"));
        assert_eq!(text, Ok(true));
    }
}
