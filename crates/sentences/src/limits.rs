//! The numbers with which a condition compares.

use crate::body::SpokenBodyPart;
use crate::test::comparisons;

/// A number with which a condition compares the value that it tests, or a field of it.
#[derive(Clone, Debug, PartialEq)]
pub struct TestedNumber {
    /// The field; none for the value itself.
    pub field: Option<String>,
    /// The number.
    pub number: f64,
}

/// The numbers of a body that compares its one argument with literals, in the order in which they stand; none of any other body.
#[must_use]
pub fn tested_numbers(body: &str, args: &[String]) -> Vec<TestedNumber> {
    let sides = comparisons(body, args).map(|(sides, _)| sides).unwrap_or_default();
    let number = |literal: SpokenBodyPart| match literal {
        SpokenBodyPart::Number(number) => Some(number),
        SpokenBodyPart::Name(..) | SpokenBodyPart::Text(_) | SpokenBodyPart::Sign(_) => None,
    };
    sides
        .into_iter()
        .filter_map(|side| Some(TestedNumber { field: side.field, number: number(side.literal)? }))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::tested_numbers;

    #[test]
    fn each_number_of_a_test_is_told_with_its_field() {
        let told = |body: &str| {
            let all = tested_numbers(body, &["face".to_owned()]);
            all.into_iter().map(|one| (one.field.unwrap_or_default(), one.number)).collect::<Vec<_>>()
        };
        assert_eq!(told("face < 40"), [(String::new(), 40.0)]);
        assert_eq!(
            told("face.distance > 0.5 && face.distance <= 1.25"),
            [("distance".to_owned(), 0.5), ("distance".to_owned(), 1.25)]
        );
        assert_eq!(told("face.size < 2 || face.x > -1.5"), [("size".to_owned(), 2.0), ("x".to_owned(), -1.5)]);
        for body in ["face", "face == \"red\"", "face + 1 < 3", "abs(face) < 3", ""] {
            assert!(told(body).is_empty(), "{body}");
        }
    }
}
