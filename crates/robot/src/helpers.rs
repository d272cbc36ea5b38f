//! The helpers a fresh library has.

use behaviour::{Declared, Helper, Signature, Unit, ValueType};

/// A helper of a fresh library.
struct Shipped {
    name: &'static str,
    /// The name that people call it by.
    label: &'static str,
    /// The name of a stream that it makes.
    stream: &'static str,
    param: &'static str,
    body: &'static str,
    says: &'static str,
    takes: Declared,
    gives: Declared,
}

/// NAO's red ball has a radius of 0.03 metres; a ball's `size` is the angle of this radius.
const SHIPPED: [Shipped; 5] = [
    Shipped {
        name: "distance",
        label: "Distance in cm",
        stream: "Distance",
        param: "ball",
        body: "100.0 * 0.03 / sin(ball.size)",
        says: "The distance to a ball in centimetres.",
        takes: Declared::Ball,
        gives: Declared::In(Unit::Centimetres),
    },
    Shipped {
        name: "ball_to_distance",
        label: "Distance in m",
        stream: "Distance in m",
        param: "ball",
        body: "0.03 / sin(ball.size)",
        says: "The distance to a ball in metres.",
        takes: Declared::Ball,
        gives: Declared::In(Unit::Metres),
    },
    Shipped {
        name: "ball_x_and_distance",
        label: "Side and distance",
        stream: "Side and distance",
        param: "ball",
        body: "#{x: ball.x, d: 0.03 / sin(ball.size)}",
        says: "The angle x to a ball in radians, left positive, and its distance d in metres.",
        takes: Declared::Ball,
        gives: Declared::Auto,
    },
    Shipped {
        name: "distance_to_brightness",
        label: "Brightness by distance",
        stream: "Brightness",
        param: "d",
        body: "min(1.0, max(0.0, 1.2 - d))",
        says: "A brightness from 0 to 1 for a distance in metres: brighter when nearer.",
        takes: Declared::In(Unit::Metres),
        gives: Declared::In(Unit::Fraction),
    },
    Shipped {
        name: "select_arm",
        label: "Arm on that side",
        stream: "Arm",
        param: "angle",
        body: r#"if angle > 0.0 { "left" } else { "right" }"#,
        says: "The arm on the side of an angle.",
        takes: Declared::In(Unit::Radians),
        gives: Declared::Text,
    },
];

impl Shipped {
    fn helper(&self) -> Helper {
        let [name, body, says] = [self.name, self.body, self.says].map(str::to_owned);
        Helper { name, params: vec![self.param.to_owned()], body, says, takes: vec![self.takes], gives: self.gives }
    }

    /// The one of that name, if its procedure is still the same.
    fn of(helper: &Helper) -> Option<&'static Self> {
        let shipped = SHIPPED.iter().find(|shipped| shipped.name == helper.name)?;
        (helper.body == shipped.body && helper.params == [shipped.param]).then_some(shipped)
    }
}

/// The helpers every library starts with.
#[must_use]
pub fn shipped_helpers() -> Vec<Helper> {
    SHIPPED.iter().map(Shipped::helper).collect()
}

/// Returns the name by which people call one of these helpers: “Distance in cm”; none for a helper of that name with
/// another procedure.
#[must_use]
pub fn helper_label(helper: &Helper) -> Option<&'static str> {
    Shipped::of(helper).map(|shipped| shipped.label)
}

/// Returns the names by which people call these helpers.
pub fn helper_labels() -> impl Iterator<Item = &'static str> {
    SHIPPED.iter().map(|shipped| shipped.label)
}

/// Returns the names of the streams that these helpers make.
pub fn helper_streams() -> impl Iterator<Item = &'static str> {
    SHIPPED.iter().map(|shipped| shipped.stream)
}

/// Returns the name by which people call the helper of this name, if it is one of these: “Distance in cm” of
/// `distance`.
#[must_use]
pub fn helper_label_of(name: &str) -> Option<&'static str> {
    SHIPPED.iter().find(|shipped| shipped.name == name).map(|shipped| shipped.label)
}

/// Returns the name of a stream that the helper of this name makes, if it is one of these.
#[must_use]
pub fn helper_stream(name: &str) -> Option<&'static str> {
    SHIPPED.iter().find(|shipped| shipped.name == name).map(|shipped| shipped.stream)
}

/// Returns what one of these helpers takes and gives, also where a library of before does not say so; none for a helper
/// of that name with another procedure.
#[must_use]
pub fn shipped_signature(helper: &Helper) -> Option<Signature> {
    let shipped = Shipped::of(helper)?;
    let pair =
        || ValueType::record([("x", Unit::Radians), ("d", Unit::Metres)].map(|(at, of)| (at, ValueType::in_unit(of))));
    let takes = vec![shipped.takes.value_type().unwrap_or_default()];
    Some(Signature { takes, gives: shipped.gives.value_type().unwrap_or_else(pair) })
}

#[cfg(test)]
mod tests {
    use super::{shipped_helpers, shipped_signature};
    use behaviour::Helper;

    #[test]
    fn every_shipped_helper_says_what_it_takes_and_gives() {
        for helper in shipped_helpers() {
            let signature = shipped_signature(&helper).unwrap();
            assert_eq!(signature.takes.len(), helper.params.len(), "{}", helper.name);
            assert_eq!(helper.takes.len(), helper.params.len(), "{}", helper.name);
            let changed = Helper { body: "1".to_owned(), ..helper };
            assert_eq!(shipped_signature(&changed), None, "{}", changed.name);
        }
    }
}
