//! The signs by which people are told apart, also when two of them have one name. Pure.

use behaviour::Id;
use protocol::Person;

/// The sign by which somebody is shown to this person.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Sign {
    pub client: Id,
    /// The name, with a number if somebody who came before has it too.
    pub name: String,
    /// Two letters, or a letter and a number; nobody else here has them.
    pub letters: String,
    /// The number of the colour, of the eight for people.
    pub color: u8,
}

/// A sign for each, in their order.
pub fn signs(people: &[Person]) -> Vec<Sign> {
    let mut signs: Vec<Sign> = Vec::with_capacity(people.len());
    for (at, person) in people.iter().enumerate() {
        let namesakes = people[..at].iter().filter(|before| behaviour::look_same(&before.name, &person.name)).count();
        let name = free(names(&person.name, namesakes), |name| {
            signs.iter().any(|sign| behaviour::look_same(&sign.name, name))
        });
        let letters =
            free(letters(&person.name, namesakes > 0), |letters| signs.iter().any(|sign| sign.letters == *letters));
        signs.push(Sign { client: person.client.clone(), name, letters, color: person.color % 8 });
    }
    signs
}

/// The first that nobody has.
fn free(mut wishes: impl Iterator<Item = String>, is_taken: impl Fn(&String) -> bool) -> String {
    wishes.find(|wish| !is_taken(wish)).unwrap_or_default()
}

/// "Aiko", then "Aiko (2)" and so on.
fn names(name: &str, namesakes: usize) -> impl Iterator<Item = String> {
    let first = (namesakes == 0).then(|| name.to_owned());
    first.into_iter().chain((namesakes + 1..).map(move |number| format!("{name} ({number})")))
}

/// Returns the letters that may stand for a name, best first; a person with the name of somebody else gets a number.
fn letters(name: &str, is_namesake: bool) -> impl Iterator<Item = String> {
    let letters: Vec<char> = name.trim().chars().collect();
    let first = letters.first().copied();
    let ends = (letters.len() > 2).then(|| first.into_iter().chain(letters.last().copied()).collect::<String>());
    let of_name = [Some(initials(name)), ends.map(|ends| ends.to_uppercase())];
    let of_name = of_name.into_iter().flatten().filter(move |_| !is_namesake);
    let first: String = first.map(|first| first.to_uppercase().to_string()).unwrap_or_default();
    of_name.chain((2..).map(move |number| format!("{first}{number}")))
}

/// Two letters for a name: "AI" for Aiko, "YT" for Yuki Tanaka, "G4" for Guest 42.
pub fn initials(name: &str) -> String {
    let mut words = name.split_whitespace().filter_map(|word| word.chars().next());
    let letters: String = match (words.next(), words.next_back()) {
        (Some(first), Some(last)) => [first, last].into_iter().collect(),
        _ => name.trim().chars().take(2).collect(),
    };
    letters.to_uppercase()
}

#[cfg(test)]
mod tests {
    use super::{initials, signs};
    use behaviour::Id;
    use protocol::Person;

    fn told_apart(names: &[&str]) -> Vec<(String, String)> {
        let person = |(at, name): (usize, &&str)| Person {
            client: Id::new(&format!("c{at}")).unwrap(),
            name: (*name).to_owned(),
            color: u8::try_from(at).unwrap(),
            pointer: None,
            selected: None,
            view: None,
            looks_at: None,
        };
        let people: Vec<Person> = names.iter().enumerate().map(person).collect();
        signs(&people).into_iter().map(|sign| (sign.letters, sign.name)).collect()
    }

    fn pairs(expected: &[(&str, &str)]) -> Vec<(String, String)> {
        expected.iter().map(|(letters, name)| ((*letters).to_owned(), (*name).to_owned())).collect()
    }

    #[test]
    fn initials_are_two_letters() {
        assert_eq!(["Aiko", "Yuki Tanaka", "a b c", "愛子", ""].map(initials), ["AI", "YT", "AC", "愛子", ""]);
    }

    #[test]
    fn two_with_one_name_have_a_number() {
        let three = [("AI", "Aiko"), ("A2", "Aiko (2)"), ("A3", "Aiko (3)")];
        assert_eq!(told_apart(&["Aiko", "Aiko", "Aiko"]), pairs(&three));
        assert_eq!(told_apart(&["Aiko (2)", "Aiko", "Aiko"])[2].1, "Aiko (3)", "also beside who calls herself that");
    }

    #[test]
    fn two_guests_are_told_apart() {
        assert_eq!(told_apart(&["Guest 42", "Guest 47"]), pairs(&[("G4", "Guest 42"), ("G7", "Guest 47")]));
        assert_eq!(
            told_apart(&["Aiko", "Airi", "Aimi"]).into_iter().map(|(letters, _)| letters).collect::<Vec<_>>(),
            ["AI", "A2", "A3"]
        );
    }

    #[test]
    fn nobody_has_the_letters_of_somebody_else() {
        let names: Vec<&str> =
            ["Guest 42", "Guest 43", "Guest 42", "", "", "é", "愛子"].into_iter().cycle().take(60).collect();
        let mut letters: Vec<String> = told_apart(&names).into_iter().map(|(letters, _)| letters).collect();
        letters.sort();
        letters.dedup();
        assert_eq!(letters.len(), 60);
    }
}
