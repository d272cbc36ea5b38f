//! The helpers a fresh library has.

use behaviour::Helper;

/// Radius of NAO's red ball in metres; a ball's `size` is the angle of this radius.
const BALL_RADIUS: &str = "0.03";

/// The helpers every library starts with.
#[must_use]
pub fn shipped_helpers() -> Vec<Helper> {
    let distance = format!("{BALL_RADIUS} / sin(ball.size)");
    vec![
        helper("distance", &["ball"], &format!("100.0 * {distance}"), "The distance to a ball in centimetres."),
        helper("ball_to_distance", &["ball"], &distance, "The distance to a ball in metres."),
        helper(
            "ball_x_and_distance",
            &["ball"],
            &format!("#{{x: ball.x, d: {distance}}}"),
            "The angle x to a ball in radians, left positive, and its distance d in metres.",
        ),
        helper(
            "distance_to_brightness",
            &["d"],
            "min(1.0, max(0.0, 1.2 - d))",
            "A brightness from 0 to 1 for a distance in metres: brighter when nearer.",
        ),
        helper(
            "select_arm",
            &["angle"],
            r#"if angle > 0.0 { "left" } else { "right" }"#,
            "The arm on the side of an angle.",
        ),
    ]
}

fn helper(name: &str, params: &[&str], body: &str, says: &str) -> Helper {
    let params = params.iter().map(|param| (*param).to_owned()).collect();
    Helper { name: name.to_owned(), params, body: body.to_owned(), says: says.to_owned() }
}
