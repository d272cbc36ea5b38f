//! Functions of texts that Rhai would let grow without a bound before it looks at the size.

use crate::cost::limits::TEXT_BYTES;
use rhai::{EvalAltResult, FuncRegistration, ImmutableString, Module, Position};

type Replaced = Result<(), Box<EvalAltResult>>;

/// Puts them over Rhai's own.
pub(crate) fn register(module: &mut Module) {
    FuncRegistration::new("replace")
        .set_into_module(module, |text: &mut ImmutableString, old: &str, new: &str| replace(text, old, new));
    FuncRegistration::new("replace").set_into_module(module, |text: &mut ImmutableString, old: char, new: &str| {
        replace(text, old.encode_utf8(&mut [0; 4]), new)
    });
    FuncRegistration::new("replace").set_into_module(module, |text: &mut ImmutableString, old: &str, new: char| {
        replace(text, old, new.encode_utf8(&mut [0; 4]))
    });
    FuncRegistration::new("replace").set_into_module(module, |text: &mut ImmutableString, old: char, new: char| {
        replace(text, old.encode_utf8(&mut [0; 4]), new.encode_utf8(&mut [0; 4]))
    });
}

/// Counts before it builds: one call could make 16 MiB from two texts of 4 KiB.
fn replace(text: &mut ImmutableString, old: &str, new: &str) -> Replaced {
    let found = text.matches(old).count();
    let kept = text.len().saturating_sub(found * old.len());
    if kept + found * new.len() > TEXT_BYTES {
        return Err(EvalAltResult::ErrorDataTooLarge("Length of string".to_owned(), Position::NONE).into());
    }
    *text = text.replace(old, new).into();
    Ok(())
}

#[cfg(test)]
mod tests {
    use crate::{Limits, try_body};
    use behaviour::Value;

    #[test]
    fn replace_does_what_it_says_within_its_bound() {
        let run = |body: &str| try_body(&[], &[], body, &[], &Limits::default());
        assert_eq!(run(r#"let t = "a-b-c"; t.replace("-", "+"); t"#), Ok(Value::text("a+b+c")));
        assert_eq!(run(r#"let t = "a-b-c"; t.replace('-', '+'); t"#), Ok(Value::text("a+b+c")));
        let bomb = r#"let t = "a"; t.pad(4000, "a"); let u = t; t.replace("a", u); t"#;
        assert!(run(bomb).is_err_and(|fault| fault.to_string().contains("too large")));
    }
}
