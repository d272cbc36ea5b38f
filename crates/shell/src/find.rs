//! Finding what a person means by a name typed in part, in any case.

use crate::refusal::NotFound;
use behaviour::as_looks;

/// The one thing meant. Whole names win over beginnings, and these over parts.
///
/// # Errors
/// The choices, if it could be several, or all there are, if it is none.
pub(crate) fn find<T: Clone>(what: &'static str, wanted: &str, all: &[(String, T)]) -> Result<(String, T), NotFound> {
    let wanted = unquoted(wanted.trim());
    if wanted.is_empty() {
        return Err(NotFound::Nameless { what, names: names(all.iter()) });
    }
    let lower = as_looks(wanted).to_lowercase();
    let fits: [fn(&str, &str) -> bool; 3] =
        [|name, wanted| name == wanted, |name, wanted| name.starts_with(wanted), |name, wanted| name.contains(wanted)];
    for fit in fits {
        let found: Vec<_> = all.iter().filter(|(name, _)| fit(&as_looks(name).to_lowercase(), &lower)).collect();
        match found.as_slice() {
            [] => {}
            [one] => return Ok((*one).clone()),
            several => {
                let names = names(several.iter().copied());
                return Err(NotFound::Several { wanted: wanted.to_owned(), names });
            }
        }
    }
    Err(NotFound::Unknown { what, wanted: wanted.to_owned(), names: names(all.iter()) })
}

fn names<'a, T: 'a>(of: impl Iterator<Item = &'a (String, T)>) -> Vec<String> {
    of.map(|(name, _)| name.clone()).collect()
}

/// Without the quotation marks around it.
pub(crate) fn unquoted(text: &str) -> &str {
    text.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).unwrap_or(text)
}

#[cfg(test)]
mod tests {
    use super::find;

    #[test]
    fn names_are_found_by_their_beginning_in_any_case() {
        let all: Vec<(String, ())> = ["Red ball", "Far", "Far away", "Head"].map(|name| (name.to_owned(), ())).to_vec();
        let found = |wanted| find("stream", wanted, &all).map(|(name, ())| name).map_err(|why| why.to_string());
        assert_eq!(found("RED"), Ok("Red ball".into()));
        assert_eq!(found("far"), Ok("Far".into()), "a whole name wins");
        assert_eq!(found("ball"), Ok("Red ball".into()));
        assert_eq!(found("fa"), Err("“fa” could be one of these: Far, Far away. Type more of the name.".into()));
        assert_eq!(found("x"), Err("There is no stream “x”. There are: Red ball, Far, Far away, Head.".into()));
        assert_eq!(found(" "), Err("Which stream? There are: Red ball, Far, Far away, Head.".into()));
    }
}
