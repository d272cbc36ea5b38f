//! Arguments that a file names with a word which Rhai keeps for itself without using it: they get a leading underscore.

use crate::rhai::fields::is_idle_word;
use behaviour::{BehaviourFile, rename_identifier};
use std::borrow::Cow;

/// The file with names that Rhai takes for the parameters of its helpers and the arguments of its bodies.
pub(super) fn without_reserved(file: &BehaviourFile) -> Cow<'_, BehaviourFile> {
    let arguments = file.connectors.iter().filter_map(|connector| connector.args.as_ref());
    let mut names = file.helpers.iter().map(|helper| &helper.params).chain(arguments).flatten();
    if !names.any(|name| is_idle_word(name)) {
        return Cow::Borrowed(file);
    }
    let mut file = file.clone();
    for helper in &mut file.helpers {
        rename(&mut helper.params, &mut helper.body);
    }
    for connector in &mut file.connectors {
        if let (Some(args), Some(body)) = (&mut connector.args, &mut connector.body) {
            rename(args, body);
        }
    }
    Cow::Owned(file)
}

fn rename(names: &mut [String], body: &mut String) {
    for at in 0..names.len() {
        let old = names[at].clone();
        if is_idle_word(&old) {
            let mut new = format!("_{old}");
            while names.contains(&new) || body.contains(&new) {
                new.insert(0, '_');
            }
            *body = rename_identifier(body, &old, &new);
            names[at] = new;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::rename;

    #[test]
    fn a_reserved_argument_is_renamed_where_it_is_a_variable() {
        let mut names = vec!["old".to_owned(), "new".to_owned()];
        let mut body = "if new.new > old { #{new: new} } else { \"new\" }".to_owned();
        rename(&mut names, &mut body);
        assert_eq!(names, ["old", "_new"]);
        assert_eq!(body, "if _new.new > old { #{new: _new} } else { \"new\" }");
        let (mut taken, mut body) = (vec!["new".to_owned(), "_new".to_owned()], "new + _new".to_owned());
        rename(&mut taken, &mut body);
        assert_eq!((taken.join(" ").as_str(), body.as_str()), ("__new _new", "__new + _new"));
    }
}
